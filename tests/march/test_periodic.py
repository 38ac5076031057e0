"""The periodic solver on maps whose fixed points are known, and on bodies against a march that waits."""

import math
from dataclasses import replace

import numpy as np
import pytest
from conftest import contact
from kernels import fixed_point
from twins import rigid_pull as reference

import mdr
from mdr.march.periodic.steady import MOST_ACCURATE, Resolution, steady

RNG = np.random.default_rng(11)
POINT = RNG.normal(size=6)


def linear(slow, fast=0.01):
    """A map A x + b with fixed point POINT: a slow block of two, as a body has, and fast ones, as springs are."""
    A = fast * RNG.normal(size=(6, 6)) / 6
    A[:2, :] = 0
    A[:2, :2] = np.atleast_2d(slow)
    return A, POINT - A @ POINT


def turning(size, angle):
    return size * np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])


BLOCKS = {
    "spiralling in": turning(0.9, 1.0),
    "slowly": turning(0.999, 0.3),
    "straight": np.diag([0.99, -0.95]),
    "at once": np.zeros((2, 2)),
    "a beat without end": turning(1.0, 1.0),
    "a slow beat": turning(1.0, 1e-3),
}


@pytest.mark.parametrize("block", BLOCKS.values(), ids=BLOCKS)
def test_a_fixed_point_is_found_with_a_bound_on_its_distance(block):
    """Of a map that does not expand any is an answer, also one that motions turn around for ever."""
    found = fixed_point(*linear(block), POINT + RNG.normal(size=6))
    assert np.linalg.norm(found.state.x - POINT) <= found.settling.spread < 1e-6
    # x - P(x) = (1 - P') (x - x*); the fast motions, a hundredth, may add to it
    assert found.settling.gain == pytest.approx(1 / np.linalg.svd(np.eye(2) - block)[1][-1], rel=0.2)


@pytest.mark.parametrize(
    "block",
    [turning(1.02, 0.3), np.diag([1.02, 0.5]), np.diag([-1.1, 0.5])],
    ids=["spiralling out", "running off", "period of two"],
)
def test_a_map_that_expands_is_none_of_friction(block):
    assert fixed_point(*linear(block), POINT + 1e-3 * RNG.normal(size=6)) is None


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("angle", [0.3, 1e-2])
def test_a_slow_beat_that_stick_trims_is_not_waited_for(angle, seed):
    """A beat around POINT: beyond a line, at some distance from POINT, part of the way is taken back. Both maps do not
    expand, so neither does one after the other; POINT itself lies beyond the line.
    """
    A, b = linear(turning(1.0, angle))
    edge = POINT[0] - 0.1
    found = fixed_point(A, b, POINT + np.random.default_rng(seed).normal(size=6), edge)
    x = found.state.x
    image = A @ x + b
    image[0] -= 0.5 * max(image[0] - edge, 0.0)
    assert np.linalg.norm(image - x) < 1e-8


def test_no_fixed_point_is_no_answer():
    assert fixed_point(np.eye(6), np.ones(6), np.zeros(6)) is None


# --- bodies -----------------------------------------------------------------------------------------------------

#: shape, depth ratio, T, k ratio, omega_0/omega, damping ratio, share of v_c
BODIES = {
    "punch, elastic": ("flat", 6.5, 0.0, 0.34, 1.61, 0.028, 0.37),
    "punch, Kelvin, no damper": ("flat", 4.0, 0.5, 0.35, 1.36, 0.0, 0.55),
    "cone, slow beat": ("cone", 3.7, 0.0, 0.25, 0.42, 0.0025, 0.94),
    "paraboloid, contact lost": ("paraboloid", 0.35, 2.0, 0.55, 1.23, 0.017, 0.17),
    "r4, no mass": ("r4", 3.0, 0.3, 0.7, math.inf, 0.0, 0.5),
}


def without_search(patch):
    """No periodic state is found, as none is looked for."""
    for name in ("steady.search", "steady.search_from_full_slip", "waiting.search"):
        patch.setattr(f"mdr.march.periodic.{name}", lambda *args: None)


def body(shape, depth_ratio, T, k, omega_0, zeta, share):
    c = 0.0 if math.isinf(omega_0) else reference.damping_for(zeta, k, omega_0)
    case = contact(shape, depth_ratio, T, k, omega_0, c)
    return case, share * mdr.full_slip_critical_velocity(case)


@pytest.mark.parametrize("name", BODIES)
def test_the_solved_state_is_the_awaited_one(name, monkeypatch):
    case, v_0 = body(*BODIES[name])
    knobs = Resolution(n_springs=24, steps=128, start="full_slip", lump=True)
    solved = steady(case, v_0, knobs)
    without_search(monkeypatch)
    awaited = steady(case, v_0, knobs)
    assert solved.settling.solved
    assert solved.settling.settled
    assert not awaited.settling.solved
    assert abs(solved.cof - awaited.cof) <= solved.settling.spread + awaited.settling.spread
    # and once more, until nothing moves
    more = steady(case, v_0, knobs, 20 * awaited.n_periods)
    assert abs(solved.cof - more.settling.mean) <= solved.settling.spread + max(more.settling.spread, 1e-12)


def test_a_failed_search_leaves_no_trace(monkeypatch):
    case, v_0 = body(*BODIES["punch, elastic"])
    knobs = Resolution(n_springs=32, steps=128, start="full_slip", lump=True)
    with monkeypatch.context() as patch:
        without_search(patch)
        untouched = steady(case, v_0, knobs)
    monkeypatch.setattr("mdr.march.periodic.search.Shooting.shoot", lambda *args: None)
    failed = steady(case, v_0, knobs)
    assert failed.cof == untouched.cof
    assert failed.n_periods == untouched.n_periods


@pytest.mark.filterwarnings("error")
def test_a_state_of_nothing_can_be_pushed_too():
    """At phase 0 every spring may be in flight and forget all it knew."""
    assert fixed_point(0.1 * np.eye(6), np.zeros(6), np.zeros(6)).settling.gain == pytest.approx(1 / 0.9)


@pytest.mark.parametrize("k_x", [1.0, 0.3, 1e-2, 1e-3, 1e-4, 1e-5])
def test_a_pull_that_creeps_is_not_taken_for_settled(k_x):
    """Spring and damper of a pull let the body creep for c_x/k_x, here up to 2e6 periods; the spring's stiffness does
    not matter to the COF in the end, as it is far softer than damper and contact."""
    case = contact("paraboloid", 10.0, 0.3, k_ratio=1.0)
    v_0 = 0.18 * case.unit_velocity
    knobs = {"n_springs": 32, "steps_per_period": 64}
    soft = [mdr.slide(replace(case, pull=mdr.SpringPull(k, 0.1, 4.0)), v_0, **knobs) for k in (10.0, k_x)]
    assert soft[0].settled
    assert not soft[1].settled or abs(soft[1].cof - soft[0].cof) <= 1e-4 * case.mu_0


@pytest.mark.parametrize(
    ("material", "pull"),
    [
        (mdr.KelvinVoigt(3e6, 0.5, 0.1), mdr.SpringPull(k_x=8e3, m=0.05, c_x=200.0)),
        (mdr.Prony(3e6, ((2e6, 1 / 300), (1e6, 1 / 30)), 0.5), mdr.SpringPull(k_x=8e3, m=0.0, c_x=5.0)),
        (mdr.Prony(3e6, ((2e6, 1.0),), 0.5), mdr.RigidPull()),
    ],
    ids=["slow dashpots, heavy damper", "arms, no mass", "a slow arm"],
)
@pytest.mark.filterwarnings("ignore::mdr.PlausibilityWarning")
def test_what_remembers_long_is_solved_for_and_not_awaited(material, pull):
    """A push is measured from where the state itself goes, so that what the state still changes is not taken for it."""
    case = mdr.SlidingContact(mdr.Cone(0.0127), material, 0.4, mdr.NormalOscillation(20e-6, 6e-6, 300.0), pull)
    run = mdr.slide(case, 0.5 * case.unit_velocity)
    assert run.settled
    assert run.cof_error < 1e-5 * case.mu_0
    assert run.n_periods < 40


def test_a_start_from_rest_goes_its_way_before_the_periodic_state_is_looked_for():
    case, v_0 = body(*BODIES["punch, elastic"])
    run = steady(case, v_0, Resolution(32, 128, "rest", True))
    assert run.n_periods >= max(run.pre_sliding, 32)
    full = steady(case, v_0, Resolution(32, 128, "full_slip", True))
    assert abs(run.cof - full.cof) <= run.settling.spread + full.settling.spread


def test_it_takes_a_fifth_of_the_steps_of_waiting(monkeypatch):
    """Lightly damped bodies, all digits, the median; waiting is stopped as soon as it has the same spread."""
    rng = np.random.default_rng(4)
    shares = []
    for _ in range(12):
        case, v_0 = body(
            rng.choice(["flat", "cone", "paraboloid", "r4"]),
            rng.uniform(1, 8),
            rng.choice([0.0, 0.3, 1.0]),
            10 ** rng.uniform(-0.7, 0.5),
            10 ** rng.uniform(-0.4, 0.6),
            rng.choice([0.0, 0.001, 0.005]),
            rng.uniform(0.1, 0.9),
        )
        knobs = Resolution(n_springs=64, steps=256, start="full_slip", lump=True, accuracy=MOST_ACCURATE)
        solved = steady(case, v_0, knobs)
        with monkeypatch.context() as patch:
            without_search(patch)
            patch.setattr("mdr.march.periodic.waiting.TOLERANCE", max(solved.settling.spread, 1e-13))
            awaited = steady(case, v_0, knobs)
        shares.append(solved.n_periods / awaited.n_periods if solved.settling.solved else 1.0)
    assert np.median(shares) <= 0.2
