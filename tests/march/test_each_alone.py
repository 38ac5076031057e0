"""Springs that know nothing of each other, each solved for, with many arms, quick and slow."""

import numpy as np
import pytest

import mdr
from mdr.march.dynamics.stepper import Stepper
from mdr.march.periodic.each_alone import search_alone
from mdr.march.periodic.steady import Resolution, at_hand

OMEGA, MU_0, DEPTH = 300.0, 0.4, 20e-6


def stepper(slowest, n_arms=12, eta=2.0, v=0.2):
    """A march of a paraboloid on arms of omega tau from 1e-4 to the slowest, shaken across."""
    arms = zip(np.geomspace(2e6, 1e5, n_arms), np.geomspace(1e-4, slowest, n_arms) / OMEGA, strict=True)
    rubber = mdr.Prony(3e6, tuple(arms), 0.4)
    shake = mdr.InPlaneOscillation(OMEGA, du_y=eta * MU_0 * rubber.mindlin_ratio * DEPTH)
    motion = mdr.NormalOscillation(DEPTH, 8e-6, OMEGA)
    case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), rubber, MU_0, motion, shake=shake)
    _, scaled = at_hand(case, Resolution(32, 32, "full_slip", True))
    return Stepper(scaled, v * case.unit_velocity / scaled.units.speed)


@pytest.mark.parametrize("eta", [0.3, 2.0])
def test_slow_arms_take_no_longer_than_quick_ones(eta):
    for slowest in (10.0, 1e5):
        march = stepper(slowest, eta=eta)
        orbit = search_alone(march, march.full_slip())
        assert orbit is not None
        assert orbit.settling.settled
        assert march.n_periods <= 60  # two steps of Newton, which took hundreds


def test_it_is_what_a_march_comes_to():
    march = stepper(30.0)
    orbit = search_alone(march, march.full_slip())
    _, periods = march.advance(march.full_slip(), 1500)  # 1500 * 2 pi of what creeps with some 100
    assert (orbit.settling.mean, orbit.settling.across) == pytest.approx((periods.cof[-1], periods.cof_y[-1]), abs=1e-8)


@pytest.mark.filterwarnings("error")
def test_springs_that_all_fly_as_a_period_begins_are_pushed_too():
    """The size of a push was that of the compression at that instant, nothing, and the derivative 0/0."""
    motion = mdr.PeriodicMotion(OMEGA, 0.0, cos=(-8e-6,))
    shake = mdr.InPlaneOscillation(OMEGA, du_x=2e-6, du_y=4e-6)
    case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), mdr.Elastic(3e6, 0.4), MU_0, motion, shake=shake)
    _, scaled = at_hand(case, Resolution(32, 64, "full_slip", True))
    assert not scaled.normal.s.any()
    run = mdr.slide(case, 0.3 * case.unit_velocity)
    assert run.settled
    assert run.cof_error < 1e-5 * MU_0
