"""A step of springs whose friction turns: a straight way, turned axes, the interval as the limit of the disc."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from mdr.spring.law import law_of
from mdr.spring.settle import tools_for
from mdr.spring.step import Path, row
from mdr.spring.turning import row_turning

LAWS = {"elastic": law_of(0.0), "kelvin": law_of(0.4), "two arms": law_of(0.0, (1.0, 0.5), (1.0, 5.0))}
H = 0.05


def some_springs(law, rng, n=40):
    """Springs at their depth, stretched within friction; the top is at z = 0 and sinks slowly."""
    J = 1 if law.arms is None else 1 + law.arms.rho.size
    gap = -rng.uniform(0.5, 2.0, n)
    s = np.zeros((J, n))
    s[0] = -gap
    e, angle = np.zeros((2 * J, n)), rng.uniform(0, 2 * np.pi, n)
    size = rng.uniform(0.0, 0.9, n) * s[0]
    e[0], e[J] = size * np.cos(angle), size * np.sin(angle)
    return gap, np.full(n, 1 / n), s, e


def stepped(law, springs, x, y, h=H, z_1=0.05):
    """Sums, compressions and extensions after a step on x_1 t + x_2 t², y likewise."""
    gap, w, s, e = springs
    s, e, tools = s.copy(), e.copy(), tools_for(law, h)
    of = row_turning(s, e, gap, w, Path(0.0, z_1, 0.0, *x), *y, law.T, law.modes, law.arms, tools, None)
    return of, s, e


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_turned_axes_turn_the_answer(law):
    springs = some_springs(law, np.random.default_rng(1))
    J = len(springs[2])

    def turned(a, b, angle=0.7):
        return np.cos(angle) * a - np.sin(angle) * b, np.sin(angle) * a + np.cos(angle) * b

    speed = 10.0 if law.T == 0 else 1.0  # so that some stick and some slip
    x, y = speed * np.array([0.9, -3.0]), speed * np.array([-1.2, 5.0])
    of, _, e = stepped(law, springs, x, y)
    gap, w, s, start = springs
    there, _, e_there = stepped(law, (gap, w, s, np.concatenate(turned(start[:J], start[J:]))), *turned(x, y))
    assert_allclose(e_there, np.concatenate(turned(e[:J], e[J:])), atol=1e-13)
    for one in ("area", "moment", "end"):
        pair = [getattr(of, f"{one}_{way}") for way in "xy"], [getattr(there, f"{one}_{way}") for way in "xy"]
        assert_allclose(pair[1], turned(*pair[0]), atol=1e-13)


def a_period(law, springs, angle, n_steps=24):
    """A period that is turned by an angle: areas of the force and extensions at its end, both turned back; and after
    each step the shares of springs that stick and that do not touch.
    """
    gap, w, s, e = springs
    s, e, J, h = s.copy(), e.copy(), len(s), 2 * np.pi / n_steps
    turn, tools, areas = np.exp(1j * angle), tools_for(law, h), []
    shares = []
    start = (e[:J] + 1j * e[J:]) * turn
    e[:J], e[J:] = start.real, start.imag
    way = [0.4, 0.8j, 0.3 + 0.2j]  # pull, shake, and its second harmonic

    def rate(t):
        return turn * (way[0] + way[1] * np.cos(t) + 2 * way[2] * np.cos(2 * t + 1))

    for k in range(n_steps):
        t = k * h
        x, z = [rate(u) for u in (t, t + h)], [np.cos(u) for u in (t, t + h)]
        q, z_2 = (x[1] - x[0]) / (2 * h), (z[1] - z[0]) / (2 * h)
        path = Path(np.sin(t), (np.sin(t + h) - np.sin(t)) / h - z_2 * h, z_2, x[0].real, q.real)
        of = row_turning(s, e, gap, w, path, x[0].imag, q.imag, law.T, law.modes, law.arms, tools, None)
        areas.append(complex(of.area_x, of.area_y))
        shares.append((of.sticking, np.mean(s[0] > np.sin(t + h) - gap + 1e-9)))
    return np.array(areas) / turn, (e[:J] + 1j * e[J:]) / turn, np.array(shares)


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_turned_axes_turn_a_period_with_all_events(law):
    springs = some_springs(law, np.random.default_rng(4))
    areas, e, shares = a_period(law, springs, 0.0)
    assert (np.ptp(shares, axis=0) > 0.05).all()  # some stick and slip, some leave and touch
    for angle in (0.5, np.pi / 2, 4.0):
        turned, e_turned, _ = a_period(law, springs, angle)
        assert_allclose(turned, areas, atol=1e-12)
        assert_allclose(e_turned, e, atol=1e-12)


def test_a_straight_way_may_be_split():
    law = LAWS["elastic"]
    gap, w, s, e = some_springs(law, np.random.default_rng(2))
    whole = stepped(law, (gap, w, s, e), (30.0, 0.0), (40.0, 0.0), z_1=0.0)[2]
    for _ in range(7):
        e = stepped(law, (gap, w, s, e), (30.0, 0.0), (40.0, 0.0), h=H / 7, z_1=0.0)[2]
    assert_allclose(e, whole, atol=1e-11)


def test_the_end_of_a_leash_is_a_tractrix():
    law = LAWS["elastic"]
    springs = np.array([-1.0]), np.ones(1), np.array([[1.0]]), np.array([[np.cos(2.0)], [np.sin(2.0)]])
    way = 3.0
    e = stepped(law, springs, (way / H, 0.0), (0.0, 0.0), z_1=0.0)[2][:, 0]
    # it is pulled back into the disc first, until the chord along the way has been gone through
    left = way - (-2 * np.cos(2.0))
    assert np.tan(np.arctan2(e[1], e[0]) / 2) == pytest.approx(np.tan((np.pi - 2.0) / 2) * np.exp(-left), rel=1e-9)


@pytest.mark.parametrize(("law", "tolerance"), list(zip(LAWS.values(), (1e-13, 2e-4, 1e-5), strict=True)), ids=LAWS)
@pytest.mark.parametrize("sign", [1, -1])
def test_along_one_line_it_is_the_scalar_row(law, tolerance, sign):
    gap, w, s, e = some_springs(law, np.random.default_rng(3))
    J = len(s)
    e[J:] = 0.0
    of, _, after = stepped(law, (gap, w, s, e), (sign * 20.0, 10.0), (0.0, 0.0))
    s_1, e_1 = s.copy(), e[:J].copy()
    path = Path(0.0, 0.05, 0.0, sign * 20.0, 10.0)
    rate = sign * 20.0 + 20.0 * H
    known = row(s_1, e_1, gap, w, path, law.T, law.modes, law.arms, tools_for(law, H), 0.05, rate, None)
    assert_allclose(after[J:], 0.0, atol=1e-15)
    assert_allclose(after[:J], e_1, atol=tolerance)
    assert_allclose([of.area_x, of.moment_x, of.end_x], [known[0], known[1], known[4]], atol=tolerance)


def test_slip_ends_where_the_top_turns_back_whatever_is_across():
    """A spring that slips back is stuck from the turn on, also where next to nothing moves across."""
    rng, law = np.random.default_rng(4), LAWS["elastic"]
    for _ in range(300):
        across, turn, bend = 10 ** rng.uniform(-12, -4), rng.uniform(0.1, 0.9) * H, rng.uniform(0.1, 3.0)
        e = np.array([[-1.0], [across * rng.uniform(-1, 1)]])
        springs = np.array([-1.0]), np.array([1.0]), np.ones((1, 1)), e / np.hypot(*e)
        end = stepped(law, springs, (-2 * bend * turn, bend), (across * rng.uniform(-1, 1), 0.0), z_1=0.0)[2]
        assert end[0, 0] == pytest.approx(-1 + bend * (H - turn) ** 2, abs=1e-8)  # of the square of the way across


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
        x, y = np.array([0.3, 0.06 / H]) * fall, np.array([-0.21, 0.0]) * fall
        of, _, end = stepped(law, (gap, w, s, e), x, y, z_1=-fall)
        area, h = np.zeros(2), H / parts
        for t in h * np.arange(parts):
            way = [(one[0] + 2 * t * one[1], one[1]) for one in (x, y)]
            path = Path(-fall * t, -fall, 0.0, *way[0])
            part = row_turning(s, e, gap, w, path, *way[1], law.T, law.modes, law.arms, tools_for(law, h), None)
            area += part.area_x, part.area_y
        assert_allclose([of.area_x, of.area_y], area, atol=3e-5 * H)
        assert_allclose(end, e, atol=4e-4)


def test_what_relaxes_with_its_limit_does_not_slip():
    """At the rim, with arms stretched like the spring, under a top that rests: force and limit fall alike."""
    law, excess, rng = law_of(0.25, (0.5,), (1.0,)), 1e-9, np.random.default_rng(2)
    gap, _, s, _ = some_springs(law, rng)
    s[1] = 0.99 * s[0]
    angle = rng.uniform(0, 2 * np.pi, gap.size)
    e = (1 + excess) * np.concatenate([s * np.cos(angle), s * np.sin(angle)])
    _, _, after = stepped(law, (gap, np.full(gap.size, 1 / gap.size), s, e), (0.0, 0.0), (0.0, 0.0), h=0.5, z_1=0.0)
    assert_allclose(after[::2], e[::2], rtol=0, atol=2 * excess * s.max())  # the excess alone is shed
