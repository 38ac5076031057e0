"""Curves, the measured critical velocity, and the verdict; the value to meet is the full-slip velocity."""

import math
from dataclasses import replace

import numpy as np
import pytest
from conftest import SHAPES, by_groups, contact, unit_of_velocity
from numpy.testing import assert_allclose
from twins import rigid_pull as reference

import mdr
from mdr.closed_forms import rigid_pull
from mdr.friction import measured_velocity

# v_c is measured to 1e-4 away from resonances. The bracket is 2e-5 wide either way, and wider by what the resolution
# still moves.
BUDGET = 1e-4

#: shape, u_z0/du_z, omega tau, and the body as k_x/k_xc, omega_0/omega, damping ratio, or None for a rigid pull
MEASURED = {
    "flat, rigid": ("flat", 3.0, 0.0, None),
    "flat, body, Kelvin": ("flat", 3.0, 0.5, (0.7, 1.6, 0.07)),
    "flat, body, loses contact": ("flat", 1.0, 0.5, (1.5, 0.5, 0.2)),
    "cone, body, elastic": ("cone", 3.0, 0.0, (0.7, 1.6, 0.07)),
    "paraboloid, body, Kelvin": ("paraboloid", 3.0, 1.0, (3.0, 1.2, 0.1)),
    "paraboloid, body, elastic": ("paraboloid", 1.25, 0.0, (0.5, 2.5, 0.2)),
    "r4, body, elastic": ("r4", 3.0, 0.0, (0.5, 2.5, 0.2)),
    # least slip is that of a few springs in the instant of their touch, which falls anywhere within a step
    "paraboloid, body, touches late": ("paraboloid", 0.963, 2.0, (0.528, 1.5, 0.0919)),
}


def make(shape, depth_ratio, T, body=None, **changes):
    if body is None:
        return contact(shape, depth_ratio, T, **changes)
    k, omega_0, zeta = body
    return contact(shape, depth_ratio, T, k, omega_0, reference.damping_for(zeta, k, omega_0), **changes)


def check_found(found, case):
    expected = mdr.full_slip_critical_velocity(case)
    assert found.kind == "end of stick", found.why
    assert_allclose(found.v_c, expected, rtol=BUDGET)
    assert found.low < found.v_c < found.high
    assert found.high - found.low < 2 * BUDGET * found.v_c
    assert found.contains(expected)


# --- the measured velocity --------------------------------------------------------------------------------------


FROM_REST = ("paraboloid, body, Kelvin", "cone, body, elastic", "r4, body, elastic")


@pytest.mark.parametrize(
    ("name", "start"), [*((name, "full_slip") for name in MEASURED), *((name, "rest") for name in FROM_REST)]
)
def test_measured_velocity_is_that_of_full_slip_from_either_start(name, start):
    case = make(*MEASURED[name])
    check_found(mdr.measure_critical_velocity(case, start=start), case)


@pytest.mark.parametrize("factor", [0.031, 0.51, 1 / 1.37, 7.3])
@pytest.mark.parametrize("name", ["flat, rigid", "cone, body, elastic"])
def test_the_answer_does_not_depend_on_where_the_search_begins(monkeypatch, name, factor):
    """1/1.37 makes the first run land on Eq. (1) itself."""
    case = make(*MEASURED[name])
    begin = measured_velocity._Search.__init__

    def elsewhere(self, *args):
        begin(self, *args)
        self.scale *= factor

    monkeypatch.setattr(measured_velocity._Search, "__init__", elsewhere)
    check_found(mdr.measure_critical_velocity(case), case)


def test_the_free_oscillation_of_an_undamped_body_is_no_hysteresis():
    """Its free oscillation, from rest, is trimmed until slip just grazes zero, while friction is full."""
    case = contact("flat", 10.0, 0.0, 0.3, 0.6)
    found = mdr.measure_critical_velocity(case)
    assert found.kind == "end of stick"
    assert_allclose(found.v_c, mdr.critical_velocity(case), rtol=BUDGET)  # flat, contact kept: Eq. (15) is exact
    above = mdr.slide(case, 1.3 * found.v_c, start="rest", record=40, n_springs=64, n_periods=600)
    assert 0 < np.mean(above.state == mdr.State.STICK) < 0.01  # without the free oscillation none sticks
    assert abs(above.mu_0 - above.cof) <= above.cof_error


@pytest.mark.parametrize(
    ("case", "reason"),
    [
        (contact("paraboloid", 10 / 3, 0.3, 0.7, math.inf), "the velocity of a body without inertia jumps"),
        (by_groups("flat", 0.5, 0.0, 0.3, 2.0, 1.0), "the undamped body has omega_0 = 2 omega"),
        (by_groups("flat", 0.5, 1.0, 0.3, 3.0, 1.0), "the undamped body has omega_0 = 3 omega"),
    ],
    ids=["without mass on dashpots", "in step", "in step, Kelvin"],
)
def test_where_stick_does_not_tell_the_end_of_friction_reduction_the_physics_is_named(case, reason):
    told = mdr.verdict(case)
    assert (told.measured, told.holds, told.measurement.kind) == (None, None, "unsettled")
    assert reason in told.measurement.why
    assert reason in told.why


# --- the curve --------------------------------------------------------------------------------------------------


CURVE = contact("paraboloid", 3.0, 0.3, 0.7, 1.6, 0.06)


@pytest.fixture(scope="module")
def curve():
    return mdr.cof_curve(CURVE, mdr.critical_velocity(CURVE) * np.array([0.0, 0.2, 0.6, 0.9, 1.2]))


def test_a_curve_is_its_runs(curve):
    for i, v_0 in enumerate(curve.v_0[1:], 1):
        run = mdr.slide(CURVE, v_0)
        assert_allclose(curve.cof[i], run.cof, rtol=0, atol=min(curve.cof_error[i], 1e-7))  # begun elsewhere
        assert_allclose(curve.stick_share[i], run.stick_share, atol=0.01)
        assert (curve.settled[i], curve.why[i]) == (run.settled, run.why)


def test_a_curve_starts_at_the_static_limit_and_ends_at_mu_0(curve):
    assert curve.cof[0] == curve.static_cof == mdr.static_cof(CURVE)
    assert (curve.stick_share[0], curve.settled[0]) == (1, True)
    assert 0 < curve.cof_error[0] <= 1e-11 * CURVE.mu_0
    assert_allclose(curve.cof[-1], CURVE.mu_0, rtol=1e-9)
    assert curve.stick_share[-1] == 0
    assert np.all(np.diff(curve.cof) > 0)
    assert np.all(curve.settled)
    assert np.all(curve.cof_error <= 1.0001e-5 * CURVE.mu_0)
    assert curve.v_c == mdr.critical_velocity(CURVE)
    assert curve.mu_0 == CURVE.mu_0
    for name in ("v_0", "cof", "cof_error", "settled", "stick_share"):
        assert getattr(curve, name).shape == (5,), name
    assert curve.settled.dtype == bool


@pytest.mark.parametrize("method", [None, "march"])
@pytest.mark.parametrize("tau", [0.0, 1e-3])
def test_the_slowest_pulls_are_known_within_their_error(method, tau):
    """Under dashpots friction rises like the power 2/3 of the velocity, far above the limit at rest."""
    material = mdr.KelvinVoigt(3e6, 0.4, tau) if tau else mdr.Elastic(3e6, 0.4)
    case = mdr.SlidingContact(SHAPES["paraboloid"][0], material, 0.5, mdr.NormalOscillation(4e-6, 2e-6, 300.0))
    v_0 = case.unit_velocity * np.array([1e-12, 9e-10])
    curve, known = mdr.cof_curve(case, v_0, method=method), rigid_pull.average_friction(case, v_0)
    assert np.all(np.abs(curve.cof - known.cof) <= curve.cof_error + known.cof_error)
    assert np.all(curve.cof_error < 1.1e-5 * case.mu_0)
    assert mdr.cof_curve(case, [0.0]).cof[0] == mdr.static_cof(case)
    unshaken = replace(case, shake=mdr.InPlaneOscillation(300.0))  # by which a velocity may be negative
    back = mdr.cof_curve(unshaken, -v_0, method=method)
    assert_allclose([-back.cof, back.cof_error], [curve.cof, curve.cof_error], rtol=1e-12)


def test_the_march_can_be_forced_and_a_number_is_a_list_of_one():
    case = contact("flat", 3.0)
    v_0 = 0.4 * mdr.critical_velocity(case)
    one, forced = mdr.cof_curve(case, v_0), mdr.cof_curve(case, [v_0], method="march")
    assert one.v_0.shape == (1,)
    # a closed form may serve the first; the march meets its own bound
    assert abs(one.cof[0] - forced.cof[0]) <= forced.cof_error[0] + one.cof_error[0]
    assert forced.cof[0] == mdr.slide(case, v_0).cof
    expected = 1 - reference.flat_punch_deficit(0.4) / 3
    assert_allclose(forced.cof[0] / case.mu_0, expected, rtol=0, atol=1e-5)


PERIODIC = {
    "two harmonics, elastic": ("cone", 0.0, mdr.PeriodicMotion(300.0, 6e-6, (2e-6, 5e-7), (0.0, 7e-7))),
    "two harmonics, lost, Kelvin": ("paraboloid", 0.5, mdr.PeriodicMotion(300.0, 1e-6, (2e-6, 5e-7), (0.0, 7e-7))),
}


@pytest.mark.parametrize("name", PERIODIC)
def test_any_periodic_depth_under_a_rigid_pull_has_a_closed_form(monkeypatch, name):
    shape, T, motion = PERIODIC[name]
    case = replace(contact(shape, 3.0, T), oscillation=motion)
    v_0 = case.unit_velocity * np.array([0.0, 0.1, 0.5, 0.9])
    marched = mdr.cof_curve(case, v_0, method="march")
    monkeypatch.setattr("mdr.friction.cof_curve.runs", None)  # no run
    closed = mdr.cof_curve(case, v_0)
    assert np.all(np.abs(closed.cof - marched.cof) <= closed.cof_error + marched.cof_error)
    assert np.all(closed.cof_error < 1e-7)
    assert_allclose(closed.stick_share, marched.stick_share, atol=0.01)
    assert closed.cof[0] == closed.static_cof == mdr.static_cof(case)


#: lightly damped curved contacts beside 2 omega: the full-slip v_c is 240 to 2500 times Eq. (1)
BESIDE = {
    "cone": ("cone", 0.3, 0.0, 0.65, 2.0001, 0.115, 1e-3),
    "paraboloid": ("paraboloid", 0.3, 0.0, 1.456, 1.9996, 2.52, 3e-4),
    "another cone": ("cone", 0.16648, 0.0, 1.38037, 1.9996843, 0.129343, 1e-3),
}


@pytest.mark.parametrize("name", BESIDE)
def test_beside_a_resonance_there_is_a_critical_velocity(name):
    """A run that had not settled by 1.5e-6 counted as reduced friction, and the search began again from Eq. (1)."""
    case = by_groups(*BESIDE[name])
    full = mdr.full_slip_critical_velocity(case)
    told = mdr.verdict(case)
    assert_allclose(told.measured, full, rtol=BUDGET)
    assert told.measurement.kind == "end of stick"
    assert "no critical velocity" not in str(told)
    above, below = (mdr.slide(case, factor * full) for factor in (1.03, 0.97))
    assert abs(above.mu_0 - above.cof) <= above.cof_error
    assert below.stick_share > 0.01


# --- the verdict ------------------------------------------------------------------------------------------------


def test_eq_15_holds_for_a_flat_punch_and_a_body():
    case = make("flat", 3.0, 0.5, (0.7, 1.6, 0.07), nu=0.5)
    verdict = mdr.verdict(case)
    assert verdict.holds
    assert verdict.eq_15 == mdr.critical_velocity(case)
    assert_allclose(verdict.measured, verdict.eq_15, rtol=BUDGET)
    assert_allclose(verdict.full_slip, verdict.eq_15, rtol=1e-8)
    assert_allclose(verdict.deviation, verdict.measured / verdict.eq_15 - 1, rtol=0, atol=1e-15)
    assert verdict.measured == verdict.measurement.v_c
    assert verdict.good
    assert "All springs stop sticking at the velocity that the formula gives for one spring" in str(verdict)
    assert "coupling" not in verdict.why  # of nu = 0.5 there is none


def test_eq_15_fails_for_a_curved_contact_of_finite_amplitude():
    case = make("paraboloid", 1 / 0.3, 0.0, (0.5, 1.6, 0.1), nu=0.5)
    verdict = mdr.verdict(case)
    assert not verdict.holds
    expected = mdr.full_slip_critical_velocity(case)
    assert abs(expected / verdict.eq_15 - 1) > 10 * BUDGET, "the case is to be one in which Eq. (15) is off"
    assert_allclose(verdict.measured, expected, rtol=BUDGET)
    assert "contact stiffness changes within the period" in verdict.why
    assert not verdict.good


def test_on_resonance_the_verdict_names_the_pole_and_the_coupling():
    verdict = mdr.verdict(contact("flat", 10.0, 0.0, 0.7, 1.0))
    found = verdict.measurement
    assert (found.v_c, found.low, found.high, found.kind) == (None, None, None, "none")
    assert "friction stays reduced" in found.why
    assert verdict.eq_15 == verdict.full_slip == math.inf
    assert (verdict.measured, verdict.deviation, verdict.good) == (None, None, None)
    assert verdict.holds, "no critical velocity, and the formula says so"
    assert "undamped natural frequency" in verdict.why
    assert "normal-tangential coupling (Dundurs' beta = 0.17)" in verdict.why  # of nu = 0.4, 1/6
    assert str(verdict).startswith("Eq. (15) holds: no critical velocity, as it says. ")


# --- beyond the usual --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "case",
    [
        contact("flat", 10.0, 0.0, 5e-4, math.inf),
        contact("flat", 10.0, 0.0, 0.01, 1.0, 2e-4),
        contact("flat", 10.0, 0.0, 0.01, 1.0, reference.damping_for(1e-4, 0.01, 1.0)),
    ],
    ids=["soft spring", "damped resonance", "hardly damped"],
)
def test_a_critical_velocity_thousands_of_times_eq_1_is_found(case):
    eq_15 = mdr.critical_velocity(case)  # exact for the punch that keeps contact
    assert eq_15 > 1000 * unit_of_velocity(case)
    verdict = mdr.verdict(case)
    assert_allclose(verdict.measured, eq_15, rtol=BUDGET)
    assert verdict.holds


def test_at_the_zero_of_eq_15_nothing_is_claimed_that_was_not_seen():
    """m omega**2 = k_x + k_xc: the elastic punch has v_c = 0."""
    found = mdr.measure_critical_velocity(contact("flat", 10.0, 0.0, 0.5, math.sqrt(1 / 3)))
    assert 0 <= found.low <= found.v_c <= found.high <= 1.1e-4 * unit_of_velocity(contact("flat", 10.0))
    assert "not told from zero" in found.why


def test_an_oscillation_that_takes_next_to_nothing_away_has_a_critical_velocity():
    case = replace(contact("flat", 1e5, du_z=2e-10), pull=mdr.SpringPull(2e4, 0.02, 4.0))
    found = mdr.measure_critical_velocity(case)
    assert_allclose(found.v_c, mdr.critical_velocity(case), rtol=BUDGET)


@pytest.mark.parametrize("n", [2, 3])
def test_a_curved_contact_on_a_whole_multiple_has_no_critical_velocity(n):
    """The n-th harmonic of its force drives the undamped body; Eq. (15) is finite and false."""
    verdict = mdr.verdict(contact("paraboloid", 3.0, 0.0, 1.5, float(n)))
    assert (verdict.measured, verdict.holds, verdict.full_slip) == (None, False, math.inf)
    assert str(verdict).startswith(f"Eq. (15) fails: no critical velocity, against {verdict.eq_15:.6g} m/s. ")
    assert "a harmonic of the normal force drives the body" in verdict.why
