"""A step of springs whose friction is a vector: a straight way, turned axes, the interval as the limit of the disc."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from rows import nodes_of, row, tools_for

from mdr.spring.contact import Each, Look, Springs
from mdr.spring.dragged import turned_straight
from mdr.spring.energies import N_SUMS
from mdr.spring.law import law_of
from mdr.spring.limit import Strength
from mdr.spring.path import Path
from mdr.tools.jit import compiled

LAWS = {"elastic": law_of(0.0), "kelvin": law_of(0.4), "two arms": law_of(0.0, (1.0, 0.5), (1.0, 5.0))}
H = 0.05


@compiled(error_model="numpy")
def _turned(n, boost):
    return turned_straight(n, boost)


def some_springs(law, rng, n=40):
    """Springs at their depth, stretched within friction; the top is at z = 0 and sinks slowly."""
    J = 1 if law.arms is None else 1 + law.arms.rho.size
    gap = -rng.uniform(0.5, 2.0, n)
    s = np.zeros((J, n))
    s[0] = -gap
    e, angle = np.zeros((J, n), complex), rng.uniform(0, 2 * np.pi, n)
    e[0] = rng.uniform(0.0, 0.9, n) * s[0] * np.exp(1j * angle)
    return gap, np.full(n, 1 / n), s, e


def answer(law, s, e, gap, w, path, h, rates=None, limit=None):
    """That of the row in the plane; s and e are updated. rates: other ones at the end than those of the parabolas."""
    return answer_and_springs(law, s, e, gap, w, path, h, rates, limit)[0]


def answer_and_springs(law, s, e, gap, w, path, h, rates=None, limit=None):
    """The same, and what each spring does."""
    rates, n = rates or (path.z_1 + 2 * h * path.z_2, path.x_1 + 2 * h * path.x_2), gap.size
    tools, each = tools_for(law, h, n, in_plane=True), Each(np.empty(n), np.empty(n, complex), np.empty(n))
    return row(s, e, Springs(gap, w), limit, path, *rates, *law, tools, None, each, None), each


def stepped(law, springs, x_1, x_2, h=H, z_1=0.05):
    """The answer, compressions and extensions after a step on x_1 t + x_2 t²."""
    gap, w, s, e = springs
    s, e = s.copy(), e.copy()
    return answer(law, s, e, gap, w, Path(0.0, z_1, 0.0, complex(x_1), complex(x_2)), h), s, e


def a_period(law, springs, angle, n_steps=24, limit=None):
    """A period that is turned by an angle: areas of the force and extensions at its end, both turned back; and after
    each step the shares of springs that stick and that do not touch. limit: of friction that falls.
    """
    gap, w, s, e = springs
    h, turn, areas, shares = 2 * np.pi / n_steps, np.exp(1j * angle), [], []
    s, e = s.copy(), e * turn
    way = [0.4, 0.8j, 0.3 + 0.2j]  # pull, shake, and its second harmonic

    def rate(t):
        return turn * (way[0] + way[1] * np.cos(t) + 2 * way[2] * np.cos(2 * t + 1))

    for k in range(n_steps):
        t = k * h
        x, z = [rate(u) for u in (t, t + h)], [np.cos(u) for u in (t, t + h)]
        q, z_2 = (x[1] - x[0]) / (2 * h), (z[1] - z[0]) / (2 * h)
        path = Path(np.sin(t), (np.sin(t + h) - np.sin(t)) / h - z_2 * h, z_2, x[0], q)
        of = answer(law, s, e, gap, w, path, h, limit=limit)
        if limit is not None:
            limit.was[:] = limit.now
        areas.append(of.area)
        shares.append((of.sticking, np.mean(s[0] > np.sin(t + h) - gap + 1e-9)))
    return np.array(areas) / turn, e / turn, np.array(shares)


@pytest.mark.parametrize(("name", "stick"), [*((name, 1.0) for name in LAWS), ("elastic", 1.5)])
def test_turned_axes_turn_a_period_with_all_events(name, stick):
    law = LAWS[name]
    springs = some_springs(law, np.random.default_rng(4))

    def period(angle):
        nothing = np.zeros(springs[0].size)
        falls = Strength(1.0, nothing, 0.0, 0.0, 0.0, stick, nothing.copy(), nothing.copy())
        return a_period(law, springs, angle, limit=falls if stick > 1 else None)

    areas, e, shares = period(0.0)
    assert (np.ptp(shares, axis=0) > 0.05).all()  # some stick and slip, some leave and touch
    for angle in (0.5, np.pi / 2, 4.0):
        turned, e_turned, _ = period(angle)
        assert_allclose(turned, areas, atol=1e-12)
        assert_allclose(e_turned, e, atol=1e-12)


DECADES = law_of(0.0, tuple(np.geomspace(1.0, 0.2, 12)), tuple(np.geomspace(2e-4, 1e3, 12)))


def test_what_a_period_comes_to_is_continuous():
    """Friction brings motions together; a mode that ends where a cubic has it, not the force, throws them apart."""
    gap, w, s, e = some_springs(DECADES, np.random.default_rng(5), 150)
    _, one, shares = a_period(DECADES, (gap, w, s, e), 0.0)
    assert np.ptp(shares[:, 0]) > 0.05
    push = 1e-9 * (np.random.default_rng(6).normal(size=(2, *e.shape)).T @ [1, 1j]).T
    _, other, _ = a_period(DECADES, (gap, w, s, e + push), 0.0)
    assert np.abs(other - one).max() < 1e-6  # norm of energy of the push, 1e-8, and what a step leaves unsolved


def test_a_straight_way_may_be_split():
    law = LAWS["elastic"]
    gap, w, s, e = some_springs(law, np.random.default_rng(2))
    whole = stepped(law, (gap, w, s, e), 30.0 + 40.0j, 0.0, z_1=0.0)[2]
    for _ in range(7):
        e = stepped(law, (gap, w, s, e), 30.0 + 40.0j, 0.0, h=H / 7, z_1=0.0)[2]
    assert_allclose(e, whole, atol=1e-11)


@pytest.mark.parametrize("law", [law_of(1e4), law_of(1e4, (1.0, 0.5), (1.0, 50.0))], ids=["Kelvin", "with arms"])
def test_a_slow_dashpot_yields_what_the_force_gives_it(law):
    gap, w, s, start = some_springs(law, np.random.default_rng(3))

    def after(n):
        """Extensions after n parts of a step in which the way turns by 74 degrees."""
        now, e, h = s.copy(), start.copy(), H / n
        for t in h * np.arange(n):
            answer(law, now, e, gap, w, Path(0.05 * t, 0.05, 0.0, 0.4 + (0.3 - 12.0 * t) * 1j, -6j), h)
        return e[0]

    # no spring yields faster than L[s]/T, and the error is 2 % of that in a step that turns its direction by 74 degrees
    assert_allclose(after(1), after(40), atol=0.02 * 0.05 * H)


def test_a_force_against_the_path_has_a_direction_however_straight_it_is():
    """It turns to the path, or stays where rounding hides to which side; the reciprocal of nothing is not taken."""
    path, aside = np.array([30.0, 40.0, 1e3, 1e6]), 10.0 ** np.arange(-170.0, 0.0, 0.5)
    forces = (-1.0 + 1j * aside) / np.hypot(1.0, aside)
    turned = np.array([_turned(n, complex(x, 0.0)) for x in path for n in forces.tolist()])
    assert_allclose(np.abs(turned), 1.0, atol=1e-9)
    assert (turned.real > 0).any()
    assert (turned.real < 0).any()


@pytest.mark.parametrize("T", [H / 20, H / 50])
def test_slip_on_a_dashpot_that_begins_within_a_step_ends_where_it_does(T):
    """A step is 64 of its parts: where stick ends a velocity of slip is nothing but for rounding, and so its sign."""
    law, errors, n = law_of(T), [], 40
    for seed in range(150):
        rng = np.random.default_rng(seed)
        s = rng.uniform(0.01, 2, (1, n))
        e = rng.uniform(0.5, 1.0, n) * s * np.exp(2j * np.pi * rng.uniform(0, 1, n))
        x_1, x_2 = complex(*rng.normal(0, 3, 2)), complex(*rng.normal(0, 30, 2))
        z_1, z_2, ends = rng.uniform(-2, 3), rng.uniform(-5, 5), []
        for parts in (1, 64):
            t, state = H / parts, (s.copy(), e.copy())
            for u in t * np.arange(parts):
                path = Path(u * (z_1 + z_2 * u), z_1 + 2 * z_2 * u, z_2, x_1 + 2 * x_2 * u, x_2)
                answer(law, *state, -s[0], np.full(n, 1 / n), path, t)
            ends.append(state[1][0])
        errors.append(np.abs(ends[0] - ends[1]) / s[0])
    assert np.sqrt(np.mean(np.square(errors))) < 5e-4


def test_the_end_of_a_leash_is_a_tractrix():
    law = LAWS["elastic"]
    springs = np.array([-1.0]), np.ones(1), np.array([[1.0]]), np.array([[np.exp(2.0j)]])
    way = 3.0
    e = stepped(law, springs, way / H, 0.0, z_1=0.0)[2][0, 0]
    # it is pulled back into the disc first, until the chord along the way has been gone through
    left = way - (-2 * np.cos(2.0))
    assert np.tan(np.angle(e) / 2) == pytest.approx(np.tan((np.pi - 2.0) / 2) * np.exp(-left), rel=1e-9)


@pytest.mark.parametrize(("law", "tolerance"), list(zip(LAWS.values(), (1e-14, 1e-14, 1e-5), strict=True)), ids=LAWS)
@pytest.mark.parametrize("sign", [1, -1])
def test_along_one_line_it_is_the_row_along_a_line(law, tolerance, sign):
    """But for the memory of arms in slip, which is exact along a line alone; and in the plane none slips back."""
    gap, w, s, e = some_springs(law, np.random.default_rng(3))
    e.imag = 0.0
    of, _, after = stepped(law, (gap, w, s, e), sign * 20.0, 10.0)
    s_1, e_1, path = s.copy(), e.real.copy(), Path(0.0, 0.05, 0.0, sign * 20.0, 10.0)
    rates = 0.05, sign * 20.0 + 20.0 * H
    lumped = np.empty((s_1.shape[0], 1))
    known = row(s_1, e_1, Springs(gap, w), None, path, *rates, *law, tools_for(law, H, gap.size), lumped, None, None)
    assert_allclose(after.imag, 0.0, atol=1e-15)
    assert_allclose(after.real, e_1, atol=tolerance)
    assert_allclose(np.real(of._replace(back=0.0)), known._replace(back=0.0), atol=tolerance)


def test_slip_ends_where_the_top_turns_back_whatever_is_across():
    """A spring that slips back is stuck from the turn on, also where next to nothing moves across."""
    rng, law = np.random.default_rng(4), LAWS["elastic"]
    for _ in range(300):
        across, turn, bend = 10 ** rng.uniform(-12, -4), rng.uniform(0.1, 0.9) * H, rng.uniform(0.1, 3.0)
        e = np.array([[complex(-1.0, across * rng.uniform(-1, 1))]])
        springs = np.array([-1.0]), np.array([1.0]), np.ones((1, 1)), e / np.abs(e)
        end = stepped(law, springs, complex(-2 * bend * turn, across * rng.uniform(-1, 1)), bend, z_1=0.0)[2]
        assert end[0, 0].real == pytest.approx(-1 + bend * (H - turn) ** 2, abs=1e-8)  # of the square of the way across


FALLING = {
    "elastic": LAWS["elastic"],
    "two arms": LAWS["two arms"],
    "quick dashpot": law_of(H / 5),
    "both": law_of(H / 5, (1.0, 0.5), (1.0, 5.0)),
}


@pytest.mark.parametrize("law", FALLING.values(), ids=FALLING)
def test_a_step_in_which_a_spring_is_let_go_is_the_sum_of_its_parts(law):
    """The leash falls to a share of itself, or to nothing before the end; slip begins within the step."""
    rng, parts = np.random.default_rng(6), 512
    for share in (0.3, 0.05, 0.0, -0.5):
        _, w, s, e = some_springs(law, rng)
        gap, e, s = -np.ones(w.size), e / s[0], s / s[0]
        fall = (1 - share) / H
        x_1, x_2 = (0.3 - 0.21j) * fall, 0.06 / H * fall + 0j
        of, _, end = stepped(law, (gap, w, s, e), x_1, x_2, z_1=-fall)
        area, h = 0.0j, H / parts
        for t in h * np.arange(parts):
            area += answer(law, s, e, gap, w, Path(-fall * t, -fall, 0.0, x_1 + 2 * t * x_2, x_2), h).area
        assert_allclose(of.area, area, atol=3e-5 * H)
        assert_allclose(end, e, atol=4e-4)


def test_what_relaxes_with_its_limit_does_not_slip():
    """At the rim, with arms stretched like the spring, under a top that rests: force and limit fall alike."""
    law, excess, rng = law_of(0.25, (0.5,), (1.0,)), 1e-9, np.random.default_rng(2)
    gap, _, s, _ = some_springs(law, rng)
    s[1] = 0.99 * s[0]
    angle = rng.uniform(0, 2 * np.pi, gap.size)
    e = (1 + excess) * s * np.exp(1j * angle)
    _, _, after = stepped(law, (gap, np.full(gap.size, 1 / gap.size), s, e), 0.0, 0.0, h=0.5, z_1=0.0)
    assert_allclose(after[0], e[0], rtol=0, atol=2 * excess * s.max())  # the excess alone is shed


@pytest.mark.parametrize(
    "law", [LAWS["elastic"], LAWS["kelvin"], law_of(H / 5)], ids=["elastic", "kelvin", "quick kelvin"]
)
def test_springs_that_do_one_thing_all_step_are_as_from_event_to_event(law):
    """The loop over those beside the row that a look takes, which follows every spring."""
    for seed in range(20):
        rng = np.random.default_rng(seed)
        gap, w, s, e = some_springs(law, rng)
        gap = np.where(rng.random(gap.size) < 0.2, gap + rng.uniform(0, 3, gap.size), gap)  # some fly
        x_1, x_2 = (complex(*rng.normal(0, size, 2)) for size in (3, 20))
        path, n = Path(0.0, rng.uniform(-2, 1), rng.uniform(-5, 5), x_1, x_2), gap.size
        s_1, e_1, s_2, e_2 = s.copy(), e.copy(), s.copy(), e.copy()
        rates = rng.uniform(-2, 1), complex(*rng.normal(0, 3, 2))  # at the end, not those of the parabolas
        nodes, tools = nodes_of(H, law.modes, law.arms), tools_for(law, H, gap.size, in_plane=True)
        look = Look(nodes, np.zeros(N_SUMS), np.zeros(4), np.zeros(n), np.zeros(n, complex), np.zeros(n))
        of, each_1 = answer_and_springs(law, s_1, e_1, gap, w, path, H, rates)
        each = Each(np.empty(n), np.empty(n, complex), np.empty(n))
        known = row(s_2, e_2, Springs(gap, w), None, path, *rates, *law, tools, None, each, look)
        assert len(set(look.mode)) > 1
        assert_allclose(s_1, s_2, rtol=0, atol=1e-14)
        assert_allclose(e_1, e_2, rtol=0, atol=3e-14)
        assert_allclose(of, known, rtol=0, atol=3e-14)
        for one, other in zip(each_1, each, strict=True):
            assert_allclose(one, other, rtol=0, atol=1e-13)
