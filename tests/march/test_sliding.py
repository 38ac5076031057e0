"""slide(): what a run says of itself agrees with its own records, with its limits, and with what it says otherwise."""

import math
import re
import tracemalloc
from dataclasses import fields, replace

import numpy as np
import pytest
from conftest import SHAPES, by_groups, contact, unit_of_velocity
from contacts import BODY, STILL
from numpy.testing import assert_allclose, assert_array_equal
from twins import rigid_pull as reference

import mdr
from mdr import State
from mdr.march.dynamics import full_slip
from mdr.march.periodic import steady

#: light body on a soft damped spring: it swings so widely that it comes back over the surface
BACKWARD = {"shape": "paraboloid", "depth_ratio": 10 / 3, "k_ratio": 0.02, "omega_0_ratio": 2.0, "c_ratio": 0.001}
COARSE = {"n_springs": 96, "steps_per_period": 256}
RECORDS = ("t", "u_x", "u_z", "F_x", "F_z", "x", "width", "e", "s", "f_x", "f_z", "state")
SCALARS = [field.name for field in fields(mdr.SlidingRun) if field.name not in RECORDS]


def run_at(case, v_hat, **knobs):
    return mdr.slide(case, v_hat * unit_of_velocity(case), **knobs)


def coarse(case, v_hat, n_periods=12, **knobs):
    return run_at(case, v_hat, n_periods=n_periods, **(COARSE | knobs))


CONTACTS = {name: case for name, (_, case) in STILL.items()}
on_all = pytest.mark.parametrize("case", CONTACTS.values(), ids=CONTACTS.keys())


# --- looking does not disturb -------------------------------------------------------------------------------


@on_all
@pytest.mark.parametrize("lump", [True, False])
def test_recording_changes_no_bit(case, lump):
    blind, seeing = (coarse(case, 0.43, record=record, lump=lump) for record in (0, 1))
    for name in SCALARS:
        assert getattr(blind, name) == getattr(seeing, name), name
    longer = coarse(case, 0.43, record=3, lump=lump)
    for name in SCALARS:
        assert getattr(blind, name) == getattr(longer, name), name
    for name in ("F_x", "F_z", "u_z", "e", "s", "f_x", "f_z", "state"):
        assert_array_equal(getattr(longer, name)[-256:], getattr(seeing, name), err_msg=name)
    assert_allclose(longer.t[-256:], seeing.t, rtol=4e-16)  # worked out from the first instant kept, afresh


@pytest.mark.parametrize("name", ["rigid Kelvin", "body elastic"])
@pytest.mark.parametrize("lump", [True, False])
def test_recording_changes_no_bit_of_a_run_that_waits_and_refines(name, lump):
    blind, seeing = (run_at(CONTACTS[name], 0.43, record=record, lump=lump) for record in (0, 2))
    for quantity in ("cof", "cof_error", "settled", "kind", "n_springs", "steps_per_period"):
        assert getattr(blind, quantity) == getattr(seeing, quantity), quantity
    assert seeing.n_periods == blind.n_periods + 1  # marched on to keep a second period, after all was decided


def test_a_period_costs_two_numbers_of_memory():
    """Its COF and its swing, whatever the number of steps and springs."""
    peaks, numbers = [], (10_000, 40_000)
    for n_periods in numbers:
        coarse(CONTACTS["rigid elastic"], 0.43, n_periods, n_springs=32, steps_per_period=32)
        tracemalloc.start()
        coarse(CONTACTS["rigid elastic"], 0.43, n_periods, n_springs=32, steps_per_period=32)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] - peaks[0] < 5 * 8 * (numbers[1] - numbers[0])  # the two, and what judges them


# --- the lumped core ----------------------------------------------------------------------------------------


def test_springs_that_stand_alike_are_marched_as_one():
    """Nothing tells one spring of a flat punch from another; the records have all of them."""
    for case in (contact("flat"), contact("flat", 1 / 1.3, 1.0, **BODY)):
        one, all_of_them = (coarse(case, 0.43, 40, record=1, lump=lump) for lump in (True, False))
        assert_allclose(one.cof, all_of_them.cof, rtol=1e-11)
        assert_allclose(one.e, all_of_them.e, rtol=0, atol=1e-9 * np.max(np.abs(one.e)))
        assert np.mean(one.state == all_of_them.state) > 0.99  # where a force meets its limit to rounding: a toss-up


# --- start --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("groups", "share", "most", "knobs"),
    [
        # near resonance a body swings up over 1/(2 pi zeta) periods, and full slip until then is no end state
        *(((10.0, 0.0, 0.7, 1.0, 2 * 0.01 * 0.7), share, 0.995, {}) for share in (0.5, 0.8)),
        # what the start left dies out while the drive builds up; in between the swing stands still for some periods
        ((1.16, 2.0, 0.045, 1.0, 2 * 0.006 * 0.045), 0.78, 0.9, {"n_springs": 64, "steps_per_period": 256}),
    ],
    ids=["half", "near v_c", "turns round"],
)
def test_a_swing_from_rest_is_waited_for(groups, share, most, knobs):
    case = contact("flat", *groups)
    v_0 = share * mdr.full_slip_critical_velocity(case)
    full_slip, rest = (mdr.slide(case, v_0, start=start, **knobs) for start in ("full_slip", "rest"))
    assert full_slip.cof < most * case.mu_0
    assert_allclose(rest.cof, full_slip.cof, rtol=0, atol=rest.cof_error + full_slip.cof_error)


# --- the COF ------------------------------------------------------------------------------------------------


@on_all
def test_cof_is_the_mean_force_over_the_mean_load(case):
    run = coarse(case, 0.43, 16, record=8, steps_per_period=1024)
    assert_allclose(run.cof, run.mean_F_x / run.mean_F_z, rtol=1e-14)
    # F_x = L[e] at the nodes; its jumps at touch and release are seen to a step, (2 pi / 1024) times half a jump of the
    # few springs that touch there at once, and of a whole flat punch
    tolerance = 1e-2 if SHAPES["flat"][0] == case.indenter else 1e-3
    assert_allclose(np.mean(run.F_x) / np.mean(run.F_z), run.cof, rtol=tolerance)
    assert_allclose(np.mean(run.F_z), run.mean_F_z, rtol=tolerance)


@pytest.mark.parametrize("name", CONTACTS)
def test_above_v_c_nothing_sticks_and_friction_is_full(name):
    case = CONTACTS[name]
    v_c = mdr.full_slip_critical_velocity(case)
    run = mdr.slide(case, 1.02 * v_c)
    assert run.kind == "full slip"
    assert run.settled
    assert run.stick_share == 0
    # in full slip e = s spring by spring, to rounding
    assert_allclose(run.cof, case.mu_0, rtol=1e-9)
    # the slip velocity exceeds v_0 - v_c; its minimum is missed by slip'' h²/8 between two nodes at most. A spring
    # that touches throws a body without mass by its share of the force, 1/32, of which others soften a part
    assert_allclose(run.least_slip, 0.02 * v_c, rtol=0, atol=(1e-2 if name == "massless Kelvin" else 5e-4) * v_c)
    below = mdr.slide(case, 0.97 * v_c)
    assert below.stick_share > 0
    assert case.mu_0 - below.cof > 10 * below.cof_error


# --- forces and modes ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("case", "v_hat"),
    [(CONTACTS["rigid elastic"], 0.43), (CONTACTS["body elastic"], 0.43), (contact(**BACKWARD), 21.6)],
    ids=["rigid", "body", "backward slip"],
)
def test_modes_and_forces_of_elastic_springs(case, v_hat):
    """Force by force from the records and the positions alone: nothing here knows the march."""
    run, springs = coarse(case, v_hat, 40, record=2), mdr.SpringArray.of(case, 96)
    assert (run.state == State.SLIP_BACK).any() == (v_hat > 20)
    assert_array_equal(run.x, springs.x)
    s = np.maximum(run.u_z[:, None] - case.oscillation.u_z0 - springs.gap, 0)
    normal, shear = springs.dk_z * s, springs.dk_x * run.e
    stick, slip, back, free = (run.state == mode for mode in (State.STICK, State.SLIP, State.SLIP_BACK, State.FREE))
    bound = case.mu_0 * normal
    assert stick.any()
    assert slip.any()
    assert np.all(np.abs(shear[stick]) < bound[stick])
    assert_allclose(shear[slip], bound[slip], rtol=1e-9, atol=1e-14 * bound.max())
    assert_allclose(shear[back], -bound[back], rtol=1e-9, atol=1e-14 * bound.max())
    assert_allclose(normal[free], 0, atol=1e-14 * bound.max())
    assert_allclose(shear[free], 0, atol=1e-14 * bound.max())
    assert_allclose(run.F_x, shear.sum(axis=1), rtol=1e-9, atol=1e-12 * np.max(run.F_z))
    assert_allclose(run.F_z, normal.sum(axis=1), rtol=1e-9, atol=1e-12 * np.max(run.F_z))
    # stick goes with the body: from node to node the foot rests
    both = stick[1:] & stick[:-1]
    moved = np.diff(run.e, axis=0) - np.diff(run.u_x)[:, None]
    assert np.mean(np.abs(moved[both]) < 1e-9 * case.mu_0 * case.oscillation.du_z) > 0.98


def test_stick_share_is_the_force_weighted_share_of_time():
    """Of the modes at the nodes that is a sum of first order; the share itself is exact."""
    case, off = CONTACTS["rigid elastic"], []
    for steps in (256, 4096):
        run, springs = coarse(case, 0.43, 8, record=1, steps_per_period=steps), mdr.SpringArray.of(case, 96)
        normal = springs.dk_z * np.maximum(run.u_z[:, None] - case.oscillation.u_z0 - springs.gap, 0)
        off.append(abs(run.stick_share - np.sum(normal[run.state == State.STICK]) / np.sum(normal)))
    assert off[0] < 1 / 128
    assert off[1] < off[0] / 4


# --- settling -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("n_periods", [1, 2, 7, 8, 13])
@pytest.mark.parametrize("start", ["full_slip", "rest"])
def test_n_periods_is_exact(n_periods, start):
    case = CONTACTS["rigid Kelvin"]
    run = coarse(case, 0.43, n_periods, start=start, record=1)
    assert run.n_periods == n_periods
    assert_allclose(run.t[-1], n_periods * case.oscillation.period, rtol=1e-14)
    assert run.settled == (run.cof_error <= 1.00001e-6 * case.mu_0)  # the tolerance of settling, and 1e-12
    assert ("n_periods" in run.why) == (not run.settled) == ("no companion run" not in run.why)


UNDAMPED, MASSLESS = contact("paraboloid", k_ratio=0.7, omega_0_ratio=1.6), contact("flat", 3.0, 1.0, 1e-7, math.inf)
REST, REST_9 = {"start": "rest"}, {"start": "rest", "n_periods": 9}
#: contact, velocity over Eq. (1), knobs, and what is said
UNSETTLED = {
    # u_z0 + du_z is 21 du_z, over 2 pi 0.05
    "springs not stretched": (contact("cone", 20.0), 0.05, REST_9, "takes 6[4-9].* periods to stretch the springs"),
    "nor in a longer run": (contact("cone", 1e8), 0.5, REST, "periods to stretch the springs"),
    "free oscillation": (UNDAMPED, 0.3, REST_9, "still changes by.* after 9 periods.* raise n_periods, or add c_x"),
    "without mass none": (MASSLESS, 0.5, REST | {"n_periods": 40}, "^(?!.*add c_x)"),
    "too short": (contact("cone", 3.0), 0.5, {"n_periods": 3}, "raise n_periods to 8"),
    "too short, from rest": (UNDAMPED, 0.3, REST | {"n_periods": 3}, "raise n_periods to 8"),
}


@pytest.mark.parametrize(("case", "v_hat", "knobs", "words"), UNSETTLED.values(), ids=UNSETTLED)
def test_a_run_that_has_not_settled_says_why_and_knows_of_friction_that_it_is_friction(case, v_hat, knobs, words):
    """Windows that agree, or an error of step and springs, bound nothing there."""
    run = run_at(case, v_hat, **COARSE, **knobs)
    assert (run.settled, run.kind, run.cof_error) == (False, "unsettled", 2 * case.mu_0)
    assert re.search(words, run.why)


# --- found by trying to break it --------------------------------------------------------------------------------


def test_an_amplitude_lost_in_rounding_is_refused():
    case = contact("cone", 1e12)
    with pytest.raises(ValueError, match="lost in the rounding of a march"):
        mdr.slide(case, 0.5 * unit_of_velocity(case))
    assert mdr.cof_curve(case, 0.5 * unit_of_velocity(case)).cof[0] < case.mu_0  # the closed form does not mind


# --- runs that need no companions ---


def test_full_slip_clear_of_stick_has_no_error_of_step():
    case = contact("cone", 3.0, 0.0, 0.7, 1.6, 0.1)
    run = mdr.slide(case, 3 * mdr.full_slip_critical_velocity(case))
    assert run.kind == "full slip"
    assert run.cof_error < 1e-10


def test_a_slip_velocity_that_falls_with_every_finer_step_is_not_clear_of_stick():
    """A punch on dashpots touches with a jump, and a body without mass follows at once, however fast it is pulled."""
    case = contact("flat", 1 / 1.3, 1.0, 1.0, math.inf)
    run = mdr.slide(case, 200 * unit_of_velocity(case))
    assert run.mu_0 - run.cof > 1e-4 * run.mu_0
    assert run.steps_per_period > 1024  # at the first it slips throughout


@pytest.mark.parametrize("pull", [mdr.RigidPull(), mdr.SpringPull(2e3, 0.02, 1.0)], ids=["rigid", "body"])
def test_a_contact_that_begins_and_ends_within_a_step_has_a_friction_too(pull):
    """It presses for 2e-3 of phase about the instant at which it is deepest."""
    phase = 0.01  # within the first step
    cos, sin = 2e-6 * math.cos(phase), 2e-6 * math.sin(phase)
    motion = mdr.PeriodicMotion(300.0, -2e-6 * math.cos(1e-3), (cos,), (sin,))
    case = mdr.SlidingContact(SHAPES["paraboloid"][0], mdr.Elastic(3e6, 0.4), 0.4, motion, pull)
    for v_0 in (0.2 * case.unit_velocity, case.unit_velocity):
        with pytest.raises(ValueError, match="steps_per_period = 32 is too coarse"):
            mdr.slide(case, v_0, n_springs=32, steps_per_period=32)
        given, run = mdr.slide(case, v_0, n_springs=32, steps_per_period=512), mdr.slide(case, v_0, n_springs=32)
        assert run.settled
        assert abs(run.cof - given.cof) <= run.cof_error + given.cof_error
        assert math.isfinite(run.stick_share)
        assert math.isfinite(run.least_slip)


def test_a_swing_that_rings_for_ages_is_not_settled_however_steady_friction_is(monkeypatch):
    """On a resonance of Q = 5e5 a body that set out in full slip presses only while it swings back: mu = -mu_0 until
    the swing has died away, long after the run. The periodic state is solved for from elsewhere.
    """
    monkeypatch.setattr(full_slip, "FASTEST_START", np.inf)
    case = contact("cone", 0.01, k_ratio=1e4, omega_0_ratio=1.0, c_ratio=0.02)
    knobs = {"n_springs": 32, "steps_per_period": 64}
    run = run_at(case, 1.0, n_periods=12, **knobs)
    assert run.cof < 0
    assert not run.settled
    monkeypatch.undo()
    solved = run_at(case, 1.0, **knobs)
    assert solved.settled
    assert mdr.static_cof(case) <= solved.cof <= case.mu_0


# --- settled means periodic ---------------------------------------------------------------------------------

#: bodies beside a whole multiple of the drive, share of the full-slip v_c, and 1 - cof/mu_0 after some thousand periods
BEATS = {
    "punch beside 2": (by_groups("flat", 0.1176, 2.6539, 1.5991, 1.998051, 6.5115), 0.5, 0.3961671, 1e-5),
    "cone beside 3": (by_groups("cone", 0.123, 0.0, 0.2841, 2.999333, 0.1977), 0.9, 9.33e-6, 1e-7),
    "load beside 2": (by_groups("paraboloid", 0.3, 0.0, 0.3, 2.003, 1.0, load=0.4), 0.8, 1.742e-4, 1e-6),
    "punch at 1/2, above v_c": (by_groups("flat", 0.5, 0.0, 0.3, 0.5, 1.0), 1.03, 0.0, 1e-9),
}


@pytest.mark.parametrize("start", ["full_slip", "rest"])
@pytest.mark.parametrize("name", BEATS)
def test_a_beat_is_seen_out_or_its_periodic_state_solved_for(name, start):
    """For 33 periods, a fraction of the beat, they slip throughout, and were called settled there."""
    case, share, missing, tolerance = BEATS[name]
    run = mdr.slide(case, share * mdr.full_slip_critical_velocity(case), start=start)
    assert run.settled
    assert abs(1 - run.cof / case.mu_0 - missing) <= tolerance + run.cof_error / case.mu_0


@pytest.mark.parametrize("off", [1e-7, -1e-7, 1e-6, -1e-6, 1e-5])
def test_a_start_beside_a_resonance_does_not_swing_at_hundreds_of_times_v_0(off):
    """The periodic motion of full slip would carry the body back at 1e5 v_0; its COF of zero was called settled."""
    omega = 314.159
    pull = mdr.SpringPull(k_x=0.1 * omega**2 * (1 + off), m=0.1)
    kelvin, motion = mdr.KelvinVoigt(3e6, 0.5, 1e-3), mdr.NormalOscillation(2e-5, 2e-6, omega)
    case = mdr.SlidingContact(mdr.Cone(theta=0.0127), kelvin, 0.5, motion, pull)
    runs = [mdr.slide(case, 1e-3, n_springs=64, steps_per_period=256, start=start) for start in ("full_slip", "rest")]
    for run in runs:
        assert run.settled
        assert_allclose(run.cof, 0.4386, atol=1e-4)
        assert run.cof > mdr.static_cof(case)


def test_a_state_that_may_be_far_from_the_periodic_one_is_not_settled_and_says_so():
    """An undamped body on an arm that relaxes in 3e3 s: what is missing to the limit is not seen in some periods."""
    solid = mdr.StandardLinearSolid(3e6, 3e6, 3e3, 0.5)
    cone, motion = mdr.Cone(0.05), mdr.NormalOscillation(2e-5, 1e-5, 300.0)
    k_x = 0.1 * float(cone.stiffness(2e-5, solid.G_star))
    case = mdr.SlidingContact(cone, solid, 0.5, motion, mdr.SpringPull(k_x, k_x / 510.0**2))
    run = run_at(case, 0.5, n_springs=64, steps_per_period=512)
    assert (run.settled, run.kind) == (False, "unsettled")
    assert run.cof_error <= 2.1 * case.mu_0
    assert "too far from the exact one" in run.why


def test_a_march_that_contradicts_the_static_limit_has_not_settled(monkeypatch):
    case = CONTACTS["body elastic"]
    search = steady.search_from_full_slip

    def wrong(stepper):
        orbit = search(stepper)
        return replace(orbit, settling=replace(orbit.settling, mean=-0.004))

    monkeypatch.setattr(steady, "search_from_full_slip", wrong)
    monkeypatch.setattr(steady, "search", lambda *args, **knobs: None)
    run = run_at(case, 0.43, **COARSE)
    assert not run.settled
    assert "below the static limit" in run.why


@pytest.mark.parametrize("T", [0.0, 2.0])
@pytest.mark.parametrize("damper", [0.0, 0.3])
def test_a_flat_face_throws_a_body_without_mass_at_second_order(T, damper):
    """The velocity of the body jumps as the punch touches, anywhere within a step; the error was 5e-4 at 1024 steps."""
    case = by_groups("flat", 0.4, T, 1.5, math.inf, 3.0)
    case = replace(case, pull=mdr.SpringPull(case.pull.k_x, 0.0, damper * case.pull.k_x / 300.0))
    knobs = {"n_springs": 32, "steps_per_period": 8192, "n_periods": 24}
    exact = run_at(case, 0.8, **knobs).cof
    for steps in (300, 512, 700, 1024):  # in no simple ratio: at powers of two errors used to agree by chance
        cof = run_at(case, 0.8, **(knobs | {"steps_per_period": steps})).cof
        assert abs(cof - exact) < 8 * case.mu_0 / steps**2, steps


def test_the_body_without_mass_on_dashpots_is_the_twin():
    """0.584068 mu_0, by an integration in a million steps of first order (tests/twins/rigid_pull.py)."""
    case = by_groups("flat", 0.4, 2.0, 1.5, math.inf, 3.0)
    run = run_at(case, 0.8)
    twin = reference.massless_punch(1 / 1.5, 0.8, 2.0, 3.0, 64_000)
    assert run.cof_error < 1e-5 * case.mu_0
    assert_allclose(run.cof / case.mu_0, twin, atol=2e-5)  # of the twin: 1/64000 times some e-folds


def test_a_time_limit_ends_a_run_unsettled_with_the_reason():
    case = by_groups("cone", 0.123, 0.0, 0.2841, 2.999333, 0.1977)
    run = mdr.slide(case, 0.9 * mdr.full_slip_critical_velocity(case), limit_s=1e-6)
    assert (run.settled, run.cof_error) == (False, 2 * case.mu_0)
    assert "the time limit is over" in run.why
    assert "limit_s" in run.why
    found = mdr.measure_critical_velocity(case, limit_s=1e-6)
    assert (found.v_c, found.kind) == (None, "unsettled")
    assert "the time limit is over" in found.why
    assert mdr.verdict(case, limit_s=1e-6).holds is None


def test_a_run_without_time_for_its_companions_states_no_bound(monkeypatch):
    case = contact("cone", k_ratio=1.0, c_ratio=0.3)
    monkeypatch.setattr("mdr.march.result.refinement.time_is_over", lambda: True)
    run = mdr.slide(case, 0.5 * mdr.critical_velocity(case))
    assert not run.settled
    assert "which bound cof_error" in run.why


def test_an_array_too_large_to_be_kept_is_that_of_any_other_run():
    case, knobs = contact("cone"), {"steps_per_period": 32, "n_periods": 2}
    few, many = (mdr.slide(case, 0.4 * unit_of_velocity(case), n_springs=n, **knobs) for n in (8192, 8193))
    assert many.n_springs == 8193
    assert many.cof == pytest.approx(few.cof, abs=1e-8)


@on_all
def test_records_have_their_shapes(case):
    run = coarse(case, 0.43, record=2)
    n_t, n_x = 2 * 256, 96
    for name in ("t", "u_x", "u_z", "F_x", "F_z"):
        assert getattr(run, name).shape == (n_t,), name
    assert run.x.shape == (n_x,)
    assert run.e.shape == run.state.shape == (n_t, n_x)
    assert run.state.dtype == np.uint8
    assert set(np.unique(run.state)) <= set(State)
    assert_allclose(run.t[-1], 12 * case.oscillation.period, rtol=1e-14)
    assert_allclose(np.diff(run.t), case.oscillation.period / 256, rtol=1e-9)  # a difference of t, so rtol 1e-16 n_t
    assert_allclose(run.u_z, case.oscillation.u_z(run.t), rtol=0, atol=1e-12 * abs(case.u_z_max))
    assert np.all(np.diff(run.x) > 0)
    nothing = coarse(case, 0.43)
    assert all(getattr(nothing, name) is None for name in RECORDS)


@pytest.mark.parametrize("name", ["rigid elastic", "rigid Kelvin", "flat, contact lost", "body elastic", "body Kelvin"])
@pytest.mark.parametrize("v_hat", [0.3, 0.8])
def test_the_start_is_forgotten(name, v_hat):
    knobs = {"n_springs": 96, "steps_per_period": 256}
    full_slip, rest = (run_at(CONTACTS[name], v_hat, start=start, **knobs) for start in ("full_slip", "rest"))
    assert full_slip.settled
    assert rest.settled
    # a settled run is settled to 1e-6 of mu_0, either of them
    assert_allclose(rest.cof, full_slip.cof, rtol=0, atol=2e-6 * rest.mu_0)
