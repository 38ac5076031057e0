"""What a contact does that is shaken along its way: critical velocities by direction, at rest, without load."""

import math
from dataclasses import replace

import numpy as np
import pytest
from conftest import SHAPES
from numpy.testing import assert_allclose

import mdr
from mdr.friction import shaken
from mdr.friction.cof_curve import friction_without_bound
from mdr.friction.shaken import band_of_pull
from mdr.march.dynamics.body import U
from mdr.march.dynamics.dimensionless import ScaledContact
from mdr.march.dynamics.stepper import Stepper

OMEGA, MU_0, DEPTH = 300.0, 0.4, 20e-6
RUBBER = mdr.Elastic(E=3e6, nu=0.5)
RIGID = mdr.RigidPull()
REACH = MU_0 * RUBBER.mindlin_ratio * DEPTH


def contact(shape="paraboloid", alpha=0.0, chi=1.0, phi=0.7, material=RUBBER, pull=RIGID, at="tool"):
    motion = mdr.NormalOscillation(DEPTH, alpha * DEPTH, OMEGA) if alpha else mdr.ConstantDepth(DEPTH)
    shake = mdr.InPlaneOscillation(OMEGA, chi * REACH, phi, at=at)
    return mdr.SlidingContact(SHAPES[shape][0], material, MU_0, motion, pull, shake)


def body(case, k=1.0, ratio=0.7, zeta=0.3):
    k_x = k * mdr.resolved(case).k_xc
    m = k_x / (ratio * OMEGA) ** 2
    return replace(case, pull=mdr.SpringPull(k_x, m, 2 * zeta * math.sqrt(k_x * m)))


# --- critical velocities ---


@pytest.mark.parametrize("way", [1, -1])
@pytest.mark.parametrize("phi", [0.0, np.pi / 2, np.pi, 0.7])
def test_the_critical_velocity_is_that_of_depth_and_shake_together(phi, way):
    """|mu_0 kappa du_z -+ du_x exp(i phi)| omega, by the law of cosines."""
    case = contact(alpha=0.4, chi=0.3, phi=phi)
    a, b = 0.4 * REACH, 0.3 * REACH
    expected = OMEGA * math.sqrt(a**2 + b**2 - way * 2 * a * b * math.cos(phi))
    assert mdr.critical_velocity(case, way) == pytest.approx(expected, rel=1e-13)
    assert mdr.full_slip_critical_velocity(case, way) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("way", [1, -1])
@pytest.mark.parametrize(
    "case",
    [
        body(contact("cone", alpha=0.3, chi=2.0, at="pull", phi=4.0)),
        body(contact("cone", chi=0.5, material=mdr.StandardLinearSolid(3e6, 2e6, 2e-3, 0.5), at="pull")),
    ],
    ids=["pull", "arms"],
)
def test_measured_velocities_are_those_of_full_slip(case, way):
    found = mdr.measure_critical_velocity(case, way)
    full = mdr.full_slip_critical_velocity(case, way)
    assert found.kind == "end of stick"
    assert found.v_c == pytest.approx(full, rel=1e-4)
    assert found.low <= full <= found.high


def test_contact_that_is_lost_may_drive_at_full_friction():
    """The tool runs on while it presses and comes back in flight: springs slip forward at rest, v_c is below zero."""
    case = contact("flat", alpha=3.0, chi=20.0, phi=-np.pi / 2)
    case = replace(case, oscillation=replace(case.oscillation, u_z0=-DEPTH))
    least = mdr.full_slip_critical_velocity(case)
    assert least < 0
    assert mdr.slide(case, 0.9 * least).cof == pytest.approx(MU_0, rel=1e-9)
    assert mdr.slide(case, 1.2 * least).cof < MU_0 * (1 - 1e-4)


@pytest.mark.parametrize("way", [1, -1])
def test_the_formula_of_a_kept_punch_knows_the_sign_of_the_phase(way):
    """Under a body the phase of its receptance stands beside that of the shake: the other sign is another velocity."""
    kelvin, body = mdr.KelvinVoigt(E=3e6, nu=0.4, tau=1e-3), mdr.SpringPull(k_x=2e4, m=0.1, c_x=10.0)
    one, other = (contact("flat", 0.3, 1.0, phi, kelvin, body) for phi in (0.7, -0.7))
    v_c = mdr.critical_velocity(one, way)
    assert v_c == pytest.approx(mdr.full_slip_critical_velocity(one, way), rel=1e-9)
    assert v_c != pytest.approx(mdr.critical_velocity(other, way), rel=1e-3)


# --- curves ---


@pytest.mark.parametrize("pull", ["rigid", "body"])
def test_the_curve_of_both_ways_is_that_of_single_runs(pull):
    case = contact(alpha=0.5, chi=1.5, phi=1.0)
    case = body(case) if pull == "body" else case
    v_0 = np.array([2e-3, -4e-3, 0.0, -1e-4, 1e-2])
    curve = mdr.cof_curve(case, v_0, method="march")
    assert_allclose(mdr.cof_curve(case, v_0).cof, curve.cof, rtol=0, atol=1e-5 * MU_0)
    runs = [mdr.slide(case, v) for v in v_0]
    assert_allclose(curve.cof, [run.cof for run in runs], rtol=0, atol=1e-5 * MU_0)
    assert curve.settled.all()
    assert np.all(np.diff(curve.cof[np.argsort(v_0)]) > 0)
    assert curve.static_cof == curve.cof[2]
    assert (curve.v_c, curve.v_c_back) == (mdr.critical_velocity(case), mdr.critical_velocity(case, -1))
    quick = friction_without_bound(case, v_0, 192, 512)
    assert_allclose(quick, curve.cof, rtol=0, atol=5e-5 * MU_0)


def test_a_curve_of_both_ways_knows_what_the_contact_holds_at_rest():
    case = contact(chi=0.3)
    curve, band = mdr.cof_curve(case, [-1e-3, 2e-3]), mdr.holding_band(case)
    assert_allclose([curve.static_cof_back, curve.static_cof], [band.low, band.high], rtol=0, atol=1e-9)
    assert mdr.cof_curve(case, [1e-3]).static_cof_back is None


# --- at rest ---


@pytest.mark.parametrize("shape", SHAPES)
def test_a_shake_alone_leaves_the_band_that_its_amplitude_does_not_take(shape):
    """mu_0 F_N(d - du_x/(mu_0 kappa))/F_N(d): each spring holds what is left of its reach."""
    for chi in (0.3, 0.8):
        case = contact(shape, chi=chi)
        force = case.indenter.force(np.array([DEPTH, (1 - chi) * DEPTH]), RUBBER.E_star)
        band = mdr.holding_band(case)
        assert band.high == pytest.approx(MU_0 * force[1] / force[0], abs=1e-9)
        assert band.low == pytest.approx(-band.high, abs=1e-9)
        assert mdr.static_cof(case) == pytest.approx(band.high, abs=1e-9)
        assert mdr.slide(case, 0.0).cof == pytest.approx(band.high, abs=1e-5 * MU_0)
        assert mdr.no_load_velocity(case) == 0
        with pytest.raises(ValueError, match="holds any mean F_x over mean F_z between"):
            mdr.blocked_cof(case)
    gone = contact(shape, chi=1.01)
    assert mdr.holding_band(gone).is_one_number
    assert mdr.blocked_cof(gone) == pytest.approx(0, abs=1e-9)


def test_what_is_alike_both_ways_has_no_load_at_rest_and_no_run_is_needed(monkeypatch):
    monkeypatch.setattr(shaken, "slide", None)
    monkeypatch.setattr(shaken, "cof_curve", None)
    across = mdr.InPlaneOscillation(omega=OMEGA, du_y=2 * REACH)
    for shake in (None, across):
        assert mdr.no_load_velocity(replace(body(contact(alpha=0.75)), shake=shake)) == 0


@pytest.mark.parametrize("pull", ["rigid", "body"])
def test_a_drive_pushes_when_held_and_runs_free_at_no_load(pull):
    case = contact(alpha=0.75, chi=5.0, phi=np.pi / 2)
    case = body(case) if pull == "body" else case
    blocked, free = mdr.blocked_cof(case), mdr.no_load_velocity(case)
    assert blocked < -0.1
    assert free > 0
    assert abs(mdr.slide(case, free).cof) < 2e-5
    mirror = case.mirrored
    assert mdr.blocked_cof(mirror) == pytest.approx(-blocked, abs=1e-5)
    assert mdr.no_load_velocity(mirror) == pytest.approx(-free, rel=1e-6)


MASS, DAMPING = 1000.0, 63.0  # of the contact's stiffness over omega**2 and over omega


def creeping(case, load, e_share, n_periods):
    """Mean velocity, over that of the shake, of a contact under a constant load over its mean normal force, begun with
    its springs at a share of their reach: a body so heavy that it hardly moves within a period, without spring.
    """
    springs = mdr.SpringArray.of(case, 64)
    scaled = ScaledContact.of(case, springs, 512, lump=False)
    spring = 1e-7  # of the contact's stiffness; the load is what the spring pulls with
    unit = scaled.units.stiffness_x / scaled.units.omega
    held = replace(
        case, pull=mdr.SpringPull(spring * scaled.units.stiffness_x, MASS * unit / scaled.units.omega, DAMPING * unit)
    )
    scaled = ScaledContact.of(held, springs, 512, lump=False)
    stepper = Stepper(scaled, 0.0)
    state = stepper.full_slip()
    state.e[:] = e_share * scaled.normal.s
    start = -load / MU_0 * scaled.normal.mean / spring  # y of a spring that pulls with the load
    state.body[:] = start, 0.0
    stepper.within_friction(state)
    state, _ = stepper.advance(state, 5 * n_periods)  # until it rests, but for a swing within the period
    before = state.body[U]
    state, _ = stepper.advance(state, n_periods)
    return (state.body[U] - before) / (2 * np.pi * n_periods) / np.abs(scaled.drive.along.x_dot).max()


@pytest.mark.parametrize(
    ("case", "side"),
    [
        (contact(chi=0.5), "high"),  # of a shake alone the other end is its mirror
        *((contact("cone", alpha=0.3, chi=0.4, phi=1.2), side) for side in ("low", "high")),
    ],
    ids=["alone", "both, low", "both, high"],
)
def test_inside_the_band_nothing_creeps_and_outside_it_does(case, side):
    band = mdr.holding_band(case)
    width, end = band.high - band.low, getattr(band, side)
    inward = -1 if side == "high" else 1
    inside, outside = end + 0.05 * inward * width, end - 0.05 * inward * width
    for start in (-0.9, 0.0, 0.9):
        assert abs(creeping(case, inside, start, 100)) < 1e-5
    drift = -inward * creeping(case, outside, 0.0, 100)
    assert drift > 1e-4
    # friction at this velocity and the damper together carry the load
    scaled = ScaledContact.of(case, mdr.SpringArray.of(case, 64), 512, lump=False)
    velocity = -inward * drift * np.abs(scaled.drive.along.x_dot).max()
    carried = mdr.slide(case, velocity * scaled.units.speed).cof + MU_0 * DAMPING * velocity / scaled.normal.mean
    assert carried == pytest.approx(outside, abs=0.03 * width)


# --- the verdict ---


def test_a_verdict_says_what_the_shake_does_forward_the_other_way_and_at_rest():
    found = mdr.verdict(contact("flat", alpha=0.4, chi=0.4, phi=0.0))
    assert found.other_way is not None
    assert found.other_way.other_way is None
    assert found.other_way.eq_15 == pytest.approx(0.8 * REACH * OMEGA)
    text = str(found)
    for part in ("Forward: Eq. (1) with the shake", "The other way: Eq. (1)", "At rest it"):
        assert part in text
    assert replace(found, within=0.5).other_way.within == 0.5


@pytest.mark.parametrize(
    ("case", "said"),
    [
        (contact("flat", chi=0.4), "At rest it holds up to 0.24 of the load pulled forward and 0.24 the other way"),
        (contact(alpha=0.75, chi=5.0, phi=np.pi / 2), "At rest it drives itself forward: held, it pushes with 0.22"),
        (contact(alpha=0.75, chi=5.0, phi=-np.pi / 2), "At rest it drives itself backward: held, it pushes with 0.22"),
        (contact(chi=3.0), "At rest it holds nothing, as every spring slips in every period, and drives nothing"),
    ],
)
def test_what_a_verdict_says_of_rest(case, said):
    assert mdr.verdict(case, accuracy=1e-3).at_rest.startswith(said)


def test_what_is_said_of_rest_is_under_the_own_pull():
    """A body on a spring is driven by friction too: slow pulls of it, not of a rigid pull, tell what it holds."""
    case = body(contact("flat", alpha=0.4, chi=0.8), k=0.3, zeta=0.5)
    held = band_of_pull(case)
    with pytest.raises(ValueError, match="is no single number"):
        mdr.blocked_cof(case)
    slow = [way * mdr.slide(one, 1e-5 * case.pace).cof for way, one in ((-1, case.mirrored), (1, case))]
    assert_allclose([held.low, held.high], slow, rtol=0, atol=1e-4 * MU_0)
    assert abs(mdr.holding_band(case).high - slow[1]) > 0.05 * MU_0
    assert f"{slow[1]:.2g}" in mdr.verdict(case, accuracy=1e-3).at_rest


SPOOL = mdr.SlidingContact(
    mdr.FlatPunch(a=1e-3), mdr.Elastic(E=115e9, nu=0.3), 0.15, mdr.ConstantLoad(5.0), mdr.SpringPull(20e3, 0.03, 5.0),
    mdr.InPlaneOscillation(2 * math.pi * 120, du_x=20e-6, at="pull"),
)  # fmt: skip
SPOOL_HOLDS = 0.15 - 20e-6 * abs(20e3 + 5j * 2 * math.pi * 120) / 5  # what its spring and damper leave of friction


def test_a_spool_that_its_spring_shakes_and_that_sticks_is_an_answer():
    """All that is said of rest is of its own pull; at 20 um its spring passes on a half of what friction bears."""
    band, run = mdr.holding_band(SPOOL), mdr.slide(SPOOL, 0.0, start="rest")
    assert_allclose([band.low, band.high], [-SPOOL_HOLDS, SPOOL_HOLDS], rtol=1e-4)  # contacts are not rigid
    assert band.contains(run.cof)
    assert run.kind == "holds"
    assert "ask blocked_cof(case)" in run.why
    with pytest.raises(ValueError, match=r"between -0\.06859\d* and 0\.06859"):
        mdr.blocked_cof(SPOOL)
    assert mdr.no_load_velocity(SPOOL) == 0.0
    assert mdr.cof_curve(SPOOL, [0.0, 0.1]).static_cof == mdr.static_cof(SPOOL) == band.high
    assert mdr.resolved(SPOOL).chi == pytest.approx(1 - SPOOL_HOLDS / 0.15, rel=1e-3)
    held = "At rest it holds up to 0.0686 of the load pulled forward and 0.0686 the other way"
    assert mdr.verdict(SPOOL, accuracy=1e-3).at_rest.startswith(held)


def test_under_a_rigid_pull_a_run_at_rest_leads_to_the_band():
    assert "ask holding_band(case)" in mdr.slide(contact(chi=0.3), 0.0).why


# --- what is refused, and what an answer must not depend on ---


@pytest.mark.parametrize(
    "case",
    [
        body(contact(chi=0.4, phi=np.pi / 2)),
        contact(chi=0.4, phi=np.pi / 2, material=mdr.Prony(3e6, ((1e6, 1e-3), (2e6, 1e-1)), 0.5)),
    ],
    ids=["body", "arms"],
)
def test_friction_at_rest_is_the_limit_of_slow_pulls(case):
    """A harmonic shake alone is its own mirror half a period on: the band is even, whatever a run at rest ends in."""
    one, other = (mdr.cof_curve(each, [0.0]) for each in (case, case.mirrored))
    assert abs(one.cof[0] - other.cof[0]) <= one.cof_error[0] + other.cof_error[0]
    slow = mdr.slide(case, 1e-5 * case.pace)
    assert 0 <= slow.cof - one.cof[0] + slow.cof_error < 3e-4 * MU_0


@pytest.mark.parametrize(
    "material", [mdr.Elastic(3e6, 0.5), mdr.KelvinVoigt(3e6, 0.5, 1e-3)], ids=["elastic", "Kelvin"]
)
@pytest.mark.parametrize(
    "load", [mdr.ConstantDepth(20e-6), mdr.ConstantLoad(0.05), mdr.NormalOscillation(2e-5, 5e-6, 600.0)]
)
def test_what_cancels_is_zero_and_no_rounding(material, load):
    """A shake that is the same both ways, and wide enough that every spring slips: nothing is held."""
    for phase in (0.0, 0.5 * np.pi):
        shake = mdr.InPlaneOscillation(300.0, du_x=60e-6, phi_x=phase)
        case = mdr.SlidingContact(mdr.Paraboloid(5e-3), material, 0.4, load, shake=shake)
        band = mdr.holding_band(case)
        assert (band.low, band.high, mdr.blocked_cof(case)) == (0.0, 0.0, 0.0)


def test_contact_lost_on_an_elastic_face_is_exact():
    """The greatest slip rate stands at the instant of touch, arccos(1/3) before the deepest point."""
    ball, depth = SHAPES["paraboloid"][0], mdr.NormalOscillation(-5e-6, 15e-6, OMEGA)
    case = mdr.SlidingContact(ball, RUBBER, MU_0, depth, shake=mdr.InPlaneOscillation(OMEGA, 1e-5, 2.0))
    touch = -math.acos(1 / 3)
    rate = MU_0 * RUBBER.mindlin_ratio * OMEGA * 15e-6 * -math.sin(touch) - OMEGA * 1e-5 * math.sin(touch + 2.0)
    assert mdr.full_slip_critical_velocity(case, -1) == pytest.approx(rate, rel=1e-10)
