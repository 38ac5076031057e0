"""One spring, one step, one run: against the law of friction integrated in tiny steps, and against closed forms."""

import math
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import pytest
import reference
from conftest import SHAPES, contact
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

import mdr
from mdr.march import kernels
from mdr.march.dimensionless import ScaledContact
from mdr.march.stepper import MarchState
from mdr.materials.operator import Rheology

N = 200
RELAXATION = [0.1, 1.0, 5.0]


@dataclass
class Step:
    """A step of smooth motion, z = cos(t_0 + theta), u = u_dot theta + u_ddot theta**2/2, and springs in any state."""

    t_0: float
    u_dot: float
    u_ddot: float
    h: float
    T: float
    gap: np.ndarray
    s: np.ndarray
    e: np.ndarray
    shaken: bool = False

    @classmethod
    def side_by_side(cls, steps):
        """Several steps of one length and one T, one row of springs each, for the tiny steps alone."""
        one = steps[0]
        motion = (np.array([[getattr(step, name)] for step in steps]) for name in ("t_0", "u_dot", "u_ddot"))
        springs = (np.stack([getattr(step, name) for step in steps]) for name in ("gap", "s", "e"))
        return cls(*motion, one.h, one.T, *springs)

    @classmethod
    def draw(cls, rng, h, T, n=N, shaken=False):
        t_0, u_dot, u_ddot = rng.uniform(0, 2 * np.pi), rng.uniform(-1.5, 1.5), rng.uniform(-1, 1)
        step = cls(t_0, u_dot, u_ddot, h, T, *np.empty((3, n)), shaken)
        near = step.z(0) + rng.uniform(-2, 2, n) * h  # about to touch or to leave
        step.gap = np.where(rng.uniform(size=n) < 0.3, near, rng.uniform(-1.5, 1, n))
        pressed = step.z(0) - step.gap
        in_contact = (pressed > 0) & (pressed + T * step.z_dot(0) > 0)  # N = s + T s' > 0
        if T:
            in_contact &= rng.uniform(size=n) < 0.7
            lifted = (
                np.maximum(pressed, 0) + rng.uniform(0.001, 2, n) * h
            )  # free: the surface stands above the indenter
            step.s = np.where(in_contact, pressed, lifted)
        else:
            step.s = np.maximum(pressed, 0)
        # |e| <= s as |L[e]| <= L[s]; in slip forward, backward, just behind slip, or anywhere between
        share = rng.choice([1.0, -1.0, np.nan, 2.0], n)
        share = np.where(np.isnan(share), 1 - rng.uniform(0, 2, n) * h**2, share)
        step.e = step.s * np.where(share > 1, rng.uniform(-1, 1, n), share)
        return step

    def z(self, theta):
        return np.cos(self.t_0 + theta)

    def z_dot(self, theta):
        return -np.sin(self.t_0 + theta)

    def u(self, theta):
        return self.u_dot * theta + self.u_ddot * theta**2 / 2

    def rate(self, theta):
        return self.u_dot + self.u_ddot * theta

    def kernel(self, python=False, ends=False):
        """New e and s, sum and stiffness that stuck, as the kernel has them; ends: where stick may end forward."""
        e_1, s_1, w, h = np.empty_like(self.e), np.empty_like(self.e), np.full(self.e.size, 1 / self.e.size), self.h
        springs, step, move = kernels.Springs(self.gap, w, -np.inf), self.step(), self.move()
        if self.T:
            compiled = kernels.shaken_kelvin_step if self.shaken else kernels.kelvin_step
            advance = compiled.py_func if python else compiled
            state = self.e[None], self.s[None], e_1[None], s_1[None]
            sums = advance(*state, springs, step, move, 1 / self.T, math.exp(-h / self.T))
        else:
            steady = kernels.slipping_elastic_step if ends else kernels.elastic_step
            compiled = kernels.shaken_elastic_step if self.shaken else steady
            advance = compiled.py_func if python else compiled
            sums = advance(self.e[None], e_1[None], springs, step, move)
            s_1 = np.maximum(self.z(h) - self.gap, 0)
        return e_1, s_1, *sums

    def step(self):
        """The step as the kernels take it; any spring may touch or leave in it."""
        spans = 0, self.gap.size, 0, self.gap.size
        return kernels.Step(*spans, self.z(0), self.z(self.h), self.z_dot(0), self.z_dot(self.h), self.h)

    def move(self):
        """What the body does in it."""
        return moved(self.u(self.h), self.rate(0), self.rate(self.h), self.h, self.shaken)

    def mirrored(self):
        """The same the other way round."""
        return replace(self, u_dot=-self.u_dot, u_ddot=-self.u_ddot, e=-self.e)

    def by_tiny_steps(self, n=2000):
        """The law itself in n steps within this one: e' = (clip(e + T u', -N, N) - e)/T; for T = 0 e = clip(e, -s, s).

        Returns e, s, whether the mode (free, stick, slip, slip back) was the same all the way and which it was at
        first, and the mean of e.
        """
        s, e, d, T, mean = self.s.copy(), self.e.copy(), self.h / n, self.T, np.zeros_like(self.e)
        first, same = None, np.ones(s.shape, dtype=bool)
        for i in range(n):
            a, b = i * d, (i + 1) * d
            mean += 0.5 / n * e
            if T == 0:
                s = np.maximum(self.z(b) - self.gap, 0)
                trial = e + self.u(b) - self.u(a)
                e = np.clip(trial, -s, s)
                mode = np.where(s == 0, 0, np.where(trial > s, 2, np.where(trial < -s, 3, 1)))
            else:
                middle, decay = (a + b) / 2, math.exp(-d / T)
                relaxed = s * math.exp(-d / 2 / T)
                touches = self.z(middle) - self.gap >= relaxed
                load = np.where(touches, np.maximum(self.z(middle) - self.gap + T * self.z_dot(middle), 0), 0)
                trial = e + T * self.rate(middle)
                f = np.clip(trial, -load, load)
                e = f + (e - f) * decay  # exact for a constant force
                s = np.maximum(self.z(b) - self.gap, s * decay)
                e = np.clip(e, -s, s)
                mode = np.where(load == 0, 0, np.where(trial > load, 2, np.where(trial < -load, 3, 1)))
            first = mode if first is None else first
            same &= mode == first
            mean += 0.5 / n * e
        return e, s, same, first, mean


def moved(du, ud_0, ud_1, h, shaken=False):
    """What a body does in a step whose velocity changes steadily."""
    return kernels.Move(du, ud_0, ud_1, kernels.surge_of.py_func(du, ud_0, ud_1, h), 0.0, False, shaken)


# --- one step ---


@pytest.mark.parametrize("shaken", [False, True])
@pytest.mark.parametrize("T", [0.0, *RELAXATION])
def test_python_and_compiled_step_agree(T, shaken):
    rng = np.random.default_rng(2)
    for _ in range(2):
        step = Step.draw(rng, 0.05, T, shaken=shaken)
        compiled, plain = step.kernel(), step.kernel(python=True)
        for got, expected in zip(compiled, plain, strict=True):
            # the compiler may contract and reorder: a few roundings
            assert_allclose(got, expected, rtol=0, atol=1e-14)


def test_a_rigid_pull_moves_elastic_springs_alike():
    rng = np.random.default_rng(4)
    for _ in range(5):
        step = Step.draw(rng, 0.05, 0.0)
        step = replace(step, u_dot=abs(step.u_dot), u_ddot=0.0)  # a rigid pull is steady
        e_1, w = step.e[None].copy(), np.full(step.e.size, 1 / step.e.size)
        springs = kernels.Springs(step.gap, w, -np.inf)
        pace = kernels.paces(step.step(), step.move().du)[0]
        ends = bool(pace > 0)  # stick may end forward
        total, _ = kernels.elastic_step_in_place(e_1, springs, step.step(), step.move(), w.size, ends)
        expected, _, sum_expected, _ = step.kernel(ends=ends)
        left = step.z(0) - step.gap - step.e
        kinks = (left > 0) & (left < pace) & (step.gap < min(step.z(0), step.z(step.h)))
        assert_allclose(e_1[0], expected, rtol=0, atol=1e-15)
        assert_allclose(total, sum_expected - pace / 12 * (w @ kinks), rtol=1e-14)  # and what a sum over nodes misses


@pytest.mark.parametrize("h", [0.05, 0.01])
@pytest.mark.parametrize("T", [0.0, *RELAXATION])
def test_a_shaken_step_knows_no_forward(T, h):
    rng = np.random.default_rng(6)
    for _ in range(20):
        step = Step.draw(rng, h, T, shaken=True)
        one, other = step.kernel(), step.mirrored().kernel()
        assert_allclose(other[0], -one[0], rtol=0, atol=2e-15)
        assert_allclose(other[1], one[1], rtol=0, atol=0)
        assert_allclose(other[3], one[3], rtol=0, atol=1e-12)  # the stiffness that stuck


@pytest.mark.parametrize("shaken", [False, True])
@pytest.mark.parametrize("du", [0.3, -0.2])
@pytest.mark.parametrize("dz", [0.1, -0.1])
def test_a_straight_piece_of_path_may_be_cut_into_seven(dz, du, shaken):
    """Elastic springs know no time: they stick, slip, touch and leave where the path says, in however many steps; and
    the sum of those that stay in contact knows where stick ends, so that the mean over the path is the same too.
    """
    rng, h = np.random.default_rng(8), 0.1
    gap = np.sort(rng.uniform(-1, 0.2, 64))
    w = np.where(gap < min(0, dz), 1 / 64, 0)
    springs = kernels.Springs(gap, w, -np.inf)
    start = np.maximum(-gap, 0) * rng.uniform(-1, 1, 64)
    ends, means = [], []
    for parts in (1, 7):
        e, z, k, mean = start[None], 0.0, h / parts, 0.0
        for _ in range(parts):
            after = np.empty_like(e)
            step = kernels.Step(0, 64, 0, 64, z, z + dz / parts, dz / h, dz / h, k)
            move = kernels.moved.py_func(du / parts, du / h, du / h, k, False, shaken)
            may_end = kernels.slipping_elastic_step if du > dz else kernels.elastic_step
            total, _ = (kernels.shaken_elastic_step if shaken else may_end)(e, after, springs, step, move)
            total += kernels.between_elastic(e, springs, step, move.du, False)
            mean += (0.5 * w @ (e[0] - after[0]) + total) / parts
            e, z = after, z + dz / parts
        ends.append(e)
        means.append(mean)
    assert_allclose(ends[1], ends[0], rtol=0, atol=1e-14)
    assert_allclose(means[1], means[0], rtol=1e-13)
    assert abs(means[0] - 0.5 * w @ (start + ends[0][0])) > 1e-3 * abs(means[0])  # of both ends alone
    assert np.abs(ends[0] - start).max() > 0.05


@pytest.mark.parametrize("shaken", [False, True])
@pytest.mark.parametrize("h", [0.1, 0.025, 0.00625])
@pytest.mark.parametrize("T", [0.0, *RELAXATION])
def test_one_step_against_tiny_ones(T, h, shaken):
    rng = np.random.default_rng(1)
    steps = [Step.draw(rng, h, T, shaken=shaken) for _ in range(6)]
    e, s = (np.stack(rows) for rows in zip(*(step.kernel()[:2] for step in steps), strict=True))
    e_fine, s_fine, *_ = Step.side_by_side(steps).by_tiny_steps()
    # an event within the step costs h**2 of the change of its rates; a share of the step counted wrongly would cost
    # h. The rates of a Kelvin spring are s/T and s/T**2 with s < 2.5, and tiny steps miss h/2000 * s/T.
    bound = 0.25 * (1 + 2.5 / T + 2.5 / T**2) * h**2 if T else 0.25 * h**2
    tiny = 3 * h / 2000 * (1 + 2.5 / T) if T else 3 * h / 2000
    assert_allclose(e, e_fine, rtol=0, atol=bound + tiny)
    assert_allclose(s, s_fine, rtol=0, atol=0.1 * bound + 1e-12)
    assert np.abs(e - e_fine).max(axis=1).min() > 0  # each draw has events in it


@pytest.mark.parametrize("side", ["forward", "forward shaken", "backward shaken"])
@pytest.mark.parametrize("T", [0.0, *RELAXATION])
def test_slip_and_stick_may_change_within_a_step(T, side):
    # springs that stay in contact, in forward slip or a little behind it: the instant of the change is known
    rng, h, steps = np.random.default_rng(5), 0.05, []
    for _ in range(20):
        step = Step.draw(rng, h, T, 40)
        step.u_dot = (
            step.z_dot(0) + rng.uniform(-1, 1) * h
        )  # near enough to the closing of the gap to change within the step
        step.gap = -math.hypot(1, T) - rng.uniform(0.5, 3, 40)
        step.s = step.z(0) - step.gap
        step.e = step.s - rng.uniform(0, 1, 40) * rng.integers(0, 2, 40) * min(T, 1) * h
        step.shaken = side != "forward"
        steps.append(step.mirrored() if side == "backward shaken" else step)
    e_fine, _, same, *_ = Step.side_by_side(steps).by_tiny_steps()
    worst = np.abs(np.stack([step.kernel()[0] for step in steps]) - e_fine).max()
    assert np.sum(~same) > 50
    # the rates are known to h**2, and so is the instant; half a step of stick too much would cost 2 to 4 h**3
    assert worst < 0.15 * (1 + 3 / T if T else 1) * h**3


@pytest.mark.parametrize("T", [0.0, *RELAXATION])
def test_a_step_without_an_event_is_exact(T):
    rng, seen = np.random.default_rng(3), set()
    for _ in range(10):
        step = Step.draw(rng, 0.05, T)
        e, *_ = step.kernel()
        _, _, same, mode, _ = step.by_tiny_steps(400)
        decay = math.exp(-step.h / T) if T else 0.0
        pressed = step.z(step.h) - step.gap
        exact_s = np.where(mode == 0, step.s * decay, np.maximum(pressed, 0))
        exact_e = np.select(
            [mode == 0, mode == 1, mode == 2],
            [
                step.e * decay,
                step.e + step.u(step.h),
                exact_s - (step.s - step.e) * decay,
            ],  # L[e] = 0, e' = u', L[s - e] = 0
            (step.s + step.e) * decay - exact_s,  # L[s + e] = 0
        )
        off = np.abs(e - exact_e)[same]
        # tiny steps see the mode at their middle only: now and then a spring changes it unseen, next to an end
        assert np.sum(off > 1e-13) <= 2
        assert off.max() < 1e-3
        seen |= set(mode[same].tolist())
    assert seen == {0, 1, 2, 3}


@pytest.mark.parametrize("h", [0.2, 0.02])
def test_a_first_touch_within_a_step_is_exact_for_linear_motion(h):
    # z rises from 0 to h, springs stand at gaps between; the body runs half as fast, or backward, so all of them stick
    gap = np.linspace(0.01, 0.99, 23) * h
    w, e_0 = np.full(23, 1 / 23), np.zeros(23)
    for v in (0.5, -0.5):
        e_1, s_1 = np.empty(23), np.empty(23)
        old, new, springs = e_0[None], e_1[None], kernels.Springs(gap, w, -np.inf)
        step, move = kernels.Step(0, w.size, 0, w.size, 0.0, h, 1.0, 1.0, h), moved(v * h, v, v, h)
        total, stuck = kernels.elastic_step(old, new, springs, step, move)
        assert_allclose(e_1, v * (h - gap), rtol=0, atol=1e-15)
        # the sum has what the path beside both ends adds to the mean, and a twelfth of the jump of the rate, which the
        # trapezoidal rule misses of a path that bends; the slope of it over the travel
        assert_allclose([total, stuck], [w @ (e_1 * (1 - 0.5 * gap / h) + v * h / 12), w @ (1 - gap / h)], rtol=1e-13)
        rate = 1.0, math.exp(-h)
        kernels.kelvin_step(old, old, new, s_1[None], springs, step, move, *rate)
        assert_allclose(e_1, v * (h - gap), rtol=0, atol=1e-15)
        assert_allclose(s_1, h - gap, rtol=0, atol=1e-15)
    # twice as fast it slips from first touch, e = s
    kernels.elastic_step(e_0[None], e_1[None], springs, step, moved(2 * h, 2.0, 2.0, h))
    assert_allclose(e_1, h - gap, rtol=0, atol=1e-15)


@pytest.mark.parametrize("share", [1e-2, 1e-3, 1e-4])
def test_a_kelvin_step_tends_to_the_elastic_one(share):
    rng, h = np.random.default_rng(4), 0.05
    for _ in range(10):
        elastic = Step.draw(rng, h, 0.0)
        kelvin = Step(**{**vars(elastic), "T": share * h})
        e, s, *_ = elastic.kernel()
        e_kelvin, s_kelvin, *_ = kelvin.kernel()
        # what the dashpot adds: T s' and T u', with rates below 3, and the event within the step
        assert_allclose(s_kelvin, s, rtol=0, atol=3 * share * h)
        assert_allclose(e_kelvin, e, rtol=0, atol=3 * share * h + h**2)


# --- one run ---


def march(scaled, v, n_steps, *, s=None, e=None, z=None, zd=None, keep=True, parts=1, spans=None):
    """March from full slip or from the state given; returns y, S, e and s at every step, and the state after."""
    if s is None:
        s = settled(scaled)
    e, s = (s if e is None else e)[None].copy(), s[None].copy()
    z, zd = (scaled.z, scaled.z_dot) if z is None else (z, zd)
    held = kernels.BodyState(np.zeros(3), np.zeros(2), np.zeros((2, 0)))
    n_z, shape = z.size - 1, (n_steps if keep else 0, *e.shape)
    trace = kernels.Trace(np.empty(n_steps), np.empty(n_steps), np.empty(shape), np.empty(shape))
    springs = kernels.Springs(scaled.gap, scaled.w, -np.inf)
    spans = all_rules(scaled, z.size) if spans is None else spans
    motion = scaled.motion(v)._replace(z=z, z_dot=zd, spans=spans)
    if z.size != scaled.z.size:
        motion = motion._replace(dx=np.full(n_z, v * 2 * np.pi / n_z), x_dot=np.full(n_z + 1, v))
    for low, high in pairwise(np.linspace(0, n_steps, parts + 1).astype(int)):
        part = kernels.Trace(*(values[low:high] for values in trace))
        kernels.march(e, s, held, scaled.body, springs, motion, scaled.table, low % n_z, part)
    out = {"y": trace.y, "S": trace.S, "e_out": trace.e[:, 0], "s_out": trace.s[:, 0], "e": e[0]}
    out |= {"body y": held.y, "body S": held.S}
    return out | ({"s": s[0]} if scaled.T else {})


@pytest.mark.parametrize("body", [{}, {"k_ratio": 0.7, "omega_0_ratio": 0.6}], ids=["rigid", "body"])
@pytest.mark.parametrize("depth_ratio", [3.0, 0.6])
@pytest.mark.parametrize("shape", ["flat", "cone", "paraboloid"])
@pytest.mark.parametrize("T", [0.0, 0.3, 3.0])
@pytest.mark.parametrize("shake", [None, mdr.InPlaneOscillation(300.0, 3e-6, 0.7)], ids=["still", "shaken"])
def test_pressed_and_free_springs_obey_all_the_rules(T, shape, depth_ratio, body, shake):
    """With the springs sorted by what they do in a step, and with all of them taken through all rules."""
    scaled = scaled_of(shape, depth_ratio, T, steps=128, n_springs=77, shake=shake, **body)
    s, spans = scaled.normal.s, scaled.normal.spans
    above = np.array([np.count_nonzero(scaled.gap < z) for z in scaled.z])
    assert np.all(spans[0] <= np.minimum(above[1:], above[:-1]))
    assert np.all(spans[1] <= np.maximum(above[1:], above[:-1]))
    if not T:
        assert_array_equal(spans, [np.minimum(above[1:], above[:-1]), np.maximum(above[1:], above[:-1])])
    one, two = (march(scaled, 0.4, 400, s=s[0], e=0 * s[0], spans=p) for p in (None, spans))
    for name in ("y", "S", "e_out", "s_out", "e"):
        assert_allclose(two[name], one[name], rtol=0, atol=2e-13 * (1 + np.abs(one[name]).max()), err_msg=name)
    seen = [look_at(scaled, out, s[0], 128) for out in (one, two)]
    for got, expected in zip(*seen, strict=True):
        # a rate is a difference over a step
        assert_allclose(got, expected, rtol=1e-10, atol=1e-10)


@pytest.mark.parametrize("T", [0.0, 0.7])
def test_a_close_look_is_the_same_in_parts_and_whatever_it_keeps(T):
    scaled = scaled_of("paraboloid", 0.7, T, n_springs=40, k_ratio=0.7, omega_0_ratio=0.6)
    (_, n), steps = scaled.normal.s.shape, scaled.steps
    whole, parts, sums = (watched(scaled, *how) for how in ((steps, steps), (50, steps), (50, 0)))
    assert whole[0][kernels.CONTACT_TIME] > 0
    assert whole[4].shape == (steps, n)
    # sums over springs at the seams are made in another order; of the normal work of elastic springs rounding is left
    assert_allclose(parts[0], whole[0], rtol=1e-14, atol=1e-14 * whole[0].max())
    for one, other in zip(whole[1:], parts[1:], strict=True):
        assert_allclose(other, one, rtol=1e-14)
    for one, other in zip(parts[:4], sums[:4], strict=True):
        assert_array_equal(other, one)


def watched(scaled, at_once, kept):
    """What a close look at a period fills, so many steps at once, of as many of each spring, and the state then."""
    s, steps = scaled.normal.s, scaled.steps
    state = MarchState.of(s, s, scaled.full_slip_state(scaled.normal.S, 0.4))
    seen = new_look(steps, kept, s.shape[1])
    trace = kernels.Trace(*np.empty((2, steps)), *np.empty((2, kept, *s.shape)))
    way = scaled.springs, scaled.motion(0.4), scaled.table
    kernels.watch(state.e, state.s, state.body, scaled.body, *way, at_once, trace, seen)
    return *seen, *trace, state.x, state.s


def look_at(scaled, out, s, steps):
    """What `observe` makes of the first steps of a march: sums, forces, slip and what it keeps of each spring."""
    e = np.vstack([0 * s, out["e_out"][:steps]])[:, None]
    s = np.vstack([s, out["s_out"][:steps]])[:, None]
    seen = looked_at(scaled, 0.4, e, s, np.concatenate([np.zeros(3), out["y"][:steps]]))
    seen.slip[~np.isfinite(seen.slip)] = 1e9
    return seen.sums[:-1], seen.F_x, seen.F_z, seen.slip, seen.f_x, seen.f_z


def looked_at(scaled, v, e, s, y):
    """A close look at steps from the beginning of the period on; e, s: (m + 1, 1, n), y: (m + 3,)."""
    m, n = e.shape[0] - 1, scaled.gap.size
    seen = new_look(m, m, n)
    kernels.observe(e, s, y, scaled.springs, scaled.motion(v), False, scaled.table, 0, seen)
    return seen


def new_look(n_steps, n_kept, n):
    """What `observe` fills, of so many steps, and of as many of each spring."""
    forces, each = np.empty((3, n_steps)), np.empty((2, n_kept, n))
    seen = kernels.Seen(np.zeros(kernels.N_SUMS), *forces, np.zeros((n_kept, n), dtype=np.uint8), *each)
    seen.sums[kernels.LEAST_SLIP] = np.inf
    return seen


def test_a_spring_with_stiff_slow_arms_that_touches_briefly_becomes_periodic():
    """Its arms change by a thousandth of the way in a period, so that plain passes would not get there."""
    n, gap, law = 3328, 1 - 1e-5, Rheology(0.13, (1300.0, 480.0), (54.0, 0.038))
    t, table, nothing = 2 * np.pi * np.arange(n + 1) / n, law.over_step(2 * np.pi / n), np.empty(0)
    x, z, z_dot, each = np.zeros(3), np.cos(t), -np.sin(t), np.empty((3, n))
    total, change = kernels.settle_spring(x, np.zeros(3), gap, z, z_dot, table, *each)
    assert total > 0
    assert change <= 1e-9 * x[0]
    again = x.copy()
    kernels.press_spring(again, gap, z, z_dot, table, 0, n, nothing, nothing, nothing)
    assert_allclose(again, x, rtol=1e-9)


def all_rules(scaled, n_instants=None):
    """Spans in which any spring may touch or leave in any step."""
    n_steps = (n_instants or scaled.z.size) - 1
    return np.array([[0] * n_steps, [scaled.gap.size] * n_steps])


def settled(scaled):
    """Compressions at phase 0 of the periodic normal motion."""
    return scaled.normal.s[0].copy()


def scaled_of(*groups, steps=256, n_springs=32, lump=False, shake=None, **knobs):
    case = replace(contact(*groups, **knobs), shake=shake)
    return ScaledContact.of(case, mdr.SpringArray.of(case, n_springs), steps, lump)


def elastic_shear(h, v, t):
    """The infimum over theta of s(t - theta) + v theta, where it can lie: now, where s' = v, and at first touch."""
    steep, touch = np.pi + math.asin(v), 2 * np.pi - math.acos(np.clip(-h, -1, 1))
    e = np.maximum(h + np.cos(t), 0)
    for at in (steep, touch):
        back = (t - at) % (2 * np.pi)
        e = np.minimum(e, max(h + math.cos(at), 0.0) + v * back)
    return e


def test_the_infimum_written_out_is_that_by_definition():
    t = np.linspace(0, 2 * np.pi, 40)
    for h in (-0.7, 0.2, 0.9, 3.0):
        brute = reference.elastic_shear_by_definition(h, 0.4, t, 20_001)
        # 20000 values of theta: v times their distance
        assert_allclose(elastic_shear(h, 0.4, t), brute, rtol=0, atol=2 * np.pi / 20_000)


@pytest.mark.parametrize("v", [0.05, 0.5, 0.95])
@pytest.mark.parametrize(("shape", "depth_ratio"), [("paraboloid", 3.0), ("cone", 0.6), ("r4", -0.3), ("flat", 0.5)])
def test_an_elastic_march_under_a_rigid_pull_is_the_infimum(shape, depth_ratio, v):
    errors = []
    for steps in (64, 256, 1024):
        scaled = scaled_of(shape, depth_ratio, steps=steps)
        e = march(scaled, v, 2 * steps)["e_out"][steps:]
        t = scaled.h * np.arange(1, steps + 1)
        exact = np.stack([elastic_shear(-gap, v, t) for gap in scaled.gap], axis=1)
        errors.append(np.abs(e - exact).max() / scaled.h**2)
    # s'' <= 1: an event that is known to h**2 of the way between two steps; the same multiple of h**2 at all steps
    assert max(errors) < 0.3


@pytest.mark.parametrize(
    ("depth_ratio", "T", "v"), [(3.0, 0.3, 0.3), (3.0, 3.0, 0.6), (0.6, 0.5, 0.3), (-0.3, 1.0, 0.2)]
)
def test_a_kelvin_march_under_a_rigid_pull_has_the_lag_of_the_twin(depth_ratio, T, v):
    steps = 1024
    scaled = scaled_of("paraboloid", depth_ratio, T, steps=steps, n_springs=64)
    out = march(scaled, v, 12 * steps)
    lag = (out["s_out"] - out["e_out"])[-steps:].mean(axis=0)
    exact, _ = reference.kelvin_lag(-scaled.gap, v, T)
    # second order, with the rates 1/T and 1/T**2 of the events
    assert_allclose(lag, exact, rtol=0, atol=(1 + 1 / T**2) * scaled.h**2)
    assert exact.max() > 0.02


@pytest.mark.parametrize("T", [0.0, 0.3, 3.0])
@pytest.mark.parametrize("depth_ratio", [3.0, 0.6, -0.3])
def test_settled_normal_motion_is_that_of_the_twin(depth_ratio, T):
    scaled = scaled_of("paraboloid", depth_ratio, T, steps=512)
    s, mean = scaled.normal.s, scaled.normal.mean
    # kinks at touch and release between two steps
    assert_allclose(mean, scaled.w @ reference.mean_compression(-scaled.gap, T), rtol=0, atol=0.25 * scaled.h**2)
    on, off = reference.contact_times(-scaled.gap, T)
    in_contact = reference.always_touches(-scaled.gap, T) | ((-on) % (2 * np.pi) <= off - on)
    assert_allclose(s[0, in_contact], (1 - scaled.gap)[in_contact], rtol=0, atol=1e-14)


@pytest.mark.parametrize("shape", SHAPES)
def test_above_v_c_full_slip_stays_full_slip(shape):
    for T in (0.0, 0.5):
        out = march(scaled_of(shape, 0.6, T), 1.0 + 1e-9, 512)
        assert_allclose(out["e_out"], out["s_out"], rtol=0, atol=1e-13)


def test_a_march_of_no_relaxation_time_to_speak_of_is_elastic():
    elastic = scaled_of("paraboloid", 0.6)
    slow = Rheology(1e-8)
    kelvin = replace(elastic, rheology=slow, table=slow.over_step(elastic.h))
    ours, theirs = march(elastic, 0.4, 512), march(kelvin, 0.4, 512)
    # T s' = 1e-8, and the two loops treat an event within a step in their own ways
    assert_allclose(ours["e_out"], theirs["e_out"], rtol=0, atol=elastic.h**2)
    no_time = Rheology(1e-5 * elastic.h).over_step(elastic.h)  # exp(-h/T) is 0
    vanishing = replace(elastic, table=no_time)
    for name, value in march(vanishing, 0.4, 512).items():
        assert name == "s" or np.array_equal(value, ours[name])


@given(
    seed=st.integers(0, 2**32 - 1),
    T=st.sampled_from([0.0, 0.03, 0.5, 4.0]),
    body=st.sampled_from([None, (0.7, 1.6, 0.1), (0.05, 0.4, 0.0), (0.3, math.inf, 0.0)]),
    v=st.floats(0.01, 3),
)
def test_coulombs_law_holds_whatever_the_motion(seed, T, body, v):
    rng = np.random.default_rng(seed)
    scaled = scaled_of("paraboloid", 0.6, T, *(body or ()), steps=64, n_springs=16)
    t = scaled.h * np.arange(65)
    n = np.arange(1, 5)[:, None]
    a, b = rng.normal(size=(2, 4, 1)) / n**2
    z, zd = (
        (a * np.cos(n * t) + b * np.sin(n * t)).sum(axis=0),
        (n * (b * np.cos(n * t) - a * np.sin(n * t))).sum(axis=0),
    )
    s = np.maximum(z[0] - scaled.gap, 0)
    e = s * rng.uniform(-1, 1, s.size)
    out = march(scaled, v, 128, s=s, e=e, z=z, zd=zd)
    decay = math.exp(-scaled.h / T) if T else 0.0
    e, s = np.vstack([e, out["e_out"]]), np.vstack([s, out["s_out"]])
    # over a step L has the mean (x_1 - x_0 decay)/(1 - decay); dividing by T/h magnifies rounding
    forces = [(x[1:] - x[:-1] * decay) / (1 - decay) for x in (e, s)]
    rounding = 1e-15 * (1 + s.max()) / (1 - decay)
    assert np.all(np.abs(forces[0]) <= forces[1] + 4 * rounding)
    assert np.all(forces[1] >= -rounding)
    assert np.all(np.abs(e) <= s + rounding)
    assert np.all(s[1:] >= np.tile(z[1:], 2)[:, None] - scaled.gap - rounding)  # the indenter does not sink in
    # the sum of w e, with what the paths within a step add to its mean, which is less than half of what moves in it
    within = 0.5 * (np.abs(np.diff(e, axis=0)) + np.abs(np.diff(s, axis=0)) + 2 * (1 - decay) * s[:-1]) @ scaled.w
    within += scaled.h * np.abs(zd).max() / 12  # and a twelfth of the jump of a rate
    assert np.all(np.abs(out["S"] - e[1:] @ scaled.w) <= within + 1e-14 * (1 + s.max()))


@pytest.mark.parametrize(
    ("T", "body"),
    [(T, body) for T in (0.0, 0.5, 3.0) for body in ((0.7, 1.6, 0.1), (0.05, 0.4, 0.0))]
    + [(0.0, (1e-4, 0.02, 0.0)), (0.0, (0.7, math.inf, 0.0)), (0.0, (0.7, 60.0, 0.0))],
    ids=str,
)
def test_body_and_springs_are_solved_together(body, T):
    assert_solved(scaled_of("paraboloid", 3.0, T, *body))


@pytest.mark.parametrize(
    ("T", "body"), [(0.5, (0.7, math.inf, 0.0)), (3.0, (0.05, math.inf, 0.0)), (3.0, (0.7, 60.0, 0.0))], ids=str
)
def test_light_bodies_on_dashpots_are_solved_together_after_a_jolt(body, T):
    assert_solved(scaled_of("paraboloid", 3.0, T, *body))


def assert_solved(scaled, v=0.3):
    """March from a body that stands where no force holds it, and put y and S of every step into the recursion."""
    out = march(scaled, v, 512)
    a_1, a_2, b_1, b_0, b_m = scaled.body[2:7]
    y, S = out["y"], out["S"]
    residual = y[2:] - (a_1 * y[1:-1] + a_2 * y[:-2] - (b_1 * S[2:] + b_0 * S[1:-1] + b_m * S[:-2]))
    b = abs(b_1) + abs(b_0) + abs(b_m)
    scale = np.abs(y).max() + b * (np.abs(S).max() + np.abs(y).max())  # S is a sum of w (e + du): it rounds like y too
    assert_allclose(residual, 0, atol=4e-15 * scale)
    assert np.ptp(y) > 1e-3


@pytest.mark.parametrize("T", [0.0, 0.5])
@pytest.mark.parametrize("body", [(), (0.7, 1.6, 0.1)], ids=["rigid", "spring"])
def test_looking_does_not_disturb(body, T):
    scaled = scaled_of("paraboloid", 0.6, T, *body)
    seen, unseen, cut = (march(scaled, 0.4, 515, **knobs) for knobs in ({}, {"keep": False}, {"parts": 7}))
    for name in seen.keys() - {"e_out", "s_out"}:
        assert np.array_equal(seen[name], unseen[name]), name  # every bit
        # where a march begins anew it asks springs that slip whether their stick ends, and rounds
        assert_allclose(seen[name], cut[name], rtol=1e-14 if name == "S" else 0, atol=0, err_msg=name)
    assert np.array_equal(seen["e_out"], cut["e_out"])
    assert np.array_equal(seen["e_out"][-1], seen["e"])


@pytest.mark.parametrize("gap", [-0.3, 0.6])
def test_the_mean_over_a_period_knows_when_an_elastic_spring_touches_and_lets_go(gap):
    # nodes alone miss up to h²/12 of a jump of the rate, which is at most 1; two of them are in the period
    mean, of_nodes = (math.sin(math.acos(gap)) - gap * math.acos(gap)) / np.pi, []
    for n in (32, 64, 128, 256, 512):
        phase = 2 * np.pi * np.arange(n + 1) / n
        s, spans, S = np.zeros((1, 1)), np.empty((2, n), dtype=np.int64), np.empty(n)
        table = Rheology(0.0).over_step(2 * np.pi / n)
        motion = np.cos(phase), -np.sin(phase)
        at_nodes = kernels.settle_normal(s, np.array([gap]), np.ones(1), *motion, table, spans, S)
        of_nodes.append(abs(at_nodes - mean) * n**2)
        assert abs(S.mean() - mean) < 2 / n**3
    assert max(of_nodes) > 0.15


def test_a_stronger_law_would_be_noticed():
    # half the friction: the same march with half the compression is not the same
    scaled = scaled_of("paraboloid", 3.0)
    t = scaled.h * np.arange(1, 257)
    e = march(scaled, 0.5, 512)["e_out"][256:]
    wrong = 0.99 * np.stack([elastic_shear(-gap, 0.5, t) for gap in scaled.gap], axis=1)
    assert np.abs(e - wrong).max() > 10 * scaled.h**2


# --- looking at a run ---


@pytest.mark.parametrize("T", [0.0, 0.5])
def test_full_slip_as_it_is_observed(T):
    scaled, v, steps = scaled_of("flat", 3.0, T, n_springs=16), 1.5, 256
    out = march(scaled, v, steps)
    s = settled(scaled)
    e, s = np.vstack([s, out["e_out"]])[:, None], np.vstack([s, out["s_out"]])[:, None]
    seen = looked_at(scaled, v, e, s, np.zeros(steps + 3))
    sums, F_x, F_z = seen.sums, seen.F_x, seen.F_z
    assert np.all(seen.mode == kernels.SLIP)
    force = 3 + scaled.z[1:] + T * scaled.z_dot[1:]  # Eq. (4)
    assert_allclose(F_z, force, rtol=1e-13)
    assert_allclose(F_x, force, rtol=1e-13)
    assert sums[kernels.STICK_TIME] == 0
    assert_allclose(sums[kernels.CONTACT_TIME], 2 * np.pi * 3, rtol=1e-12)
    # the mean of s' over the steps beside the steepest instant misses it by h**2/6
    assert_allclose(sums[kernels.LEAST_SLIP], v - 1, rtol=0, atol=1.01 * scaled.h**2 / 6)
    # over a period the pull pays for friction and the tangential dashpots, int T e'**2 = T pi with e' = -sin t
    assert_allclose(sums[kernels.SHEAR_WORK], 2 * np.pi * 3 * v, rtol=1e-12)
    assert_allclose(sums[kernels.SHEAR_VISCOUS], T * np.pi, rtol=scaled.h**2)
    assert_allclose(sums[kernels.NORMAL_VISCOUS], T * np.pi, rtol=scaled.h**2)
    # friction: int N (v - s') dt = 6 pi v + pi T - 0, as <s s'> = 0 and <s'**2> = 1/2: minus T pi
    assert_allclose(sums[kernels.FRICTION_LOSS], 6 * np.pi * v - T * np.pi, rtol=scaled.h**2)
