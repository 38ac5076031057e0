"""Friction that falls as springs are let go: against its closed form, small steps, the balance of energies."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from twins.falling import cofs

import mdr
from mdr.case.depth_cycle import harmonic_sum
from mdr.march.periodic.steady import at_hand
from mdr.march.result.refinement import resolution_of

MATERIALS = {
    "elastic": mdr.Elastic(3e6, 0.4),
    "Kelvin": mdr.KelvinVoigt(3e6, 0.4, 1e-3),
    "slow Kelvin": mdr.KelvinVoigt(3e6, 0.4, 1e-2),
    "arms": mdr.Prony(E_inf=3e6, nu=0.4, arms=((1e6, 2e-3), (5e5, 1e-2))),
    "arm and dashpot": mdr.Prony(E_inf=3e6, nu=0.4, arms=((1e6, 2e-3),), tau=5e-4),
}
SHAPES = {"punch": mdr.FlatPunch(1e-3), "cone": mdr.Cone(0.02), "ball": mdr.Paraboloid(5e-3)}


def contact(alpha, stick, shape="punch", material="elastic", pull=None):
    motion = mdr.NormalOscillation(20e-6, alpha * 20e-6, 300.0)
    law = mdr.StaticKinetic(0.5 * stick, 0.5)
    parts = SHAPES[shape], MATERIALS[material]
    return mdr.SlidingContact(*parts, oscillation=motion, friction=law, pull=pull or mdr.RigidPull())


def slide(case, v, **knobs):
    """A run at v over Eq. (1)."""
    return mdr.slide(case, v * case.unit_velocity, **knobs)


def of_twin(case, v, periods, count):
    """COF over mu_k, along and across as a complex number, by small steps from rest, extrapolated: mean of the last
    periods.
    """
    _, scaled = at_hand(case, resolution_of(case, 32, 128))
    springs, material = scaled.springs, scaled.rheology
    law, found = (material.T, np.array(material.rho, dtype=float), np.array(material.theta, dtype=float)), []
    bodies = [(body.M, body.C, body.K) for body in (scaled.body, scaled.body_across)]
    for steps in (2**13, 2**15):
        z, way = case.cycle.over_a_period(steps)[0], np.zeros(steps + 1, complex)
        for unit, harmonics in ((1, case.way), (1j, case.way_across)):
            way += unit * harmonic_sum(harmonics / case.unit_length, np.linspace(0, 2 * np.pi, steps + 1))
        parts = case.friction.stick, law, *bodies
        found.append(cofs(springs.gap, springs.w, z, way, v, *parts, steps, periods)[-count:].mean())
    return (4 * found[1] - found[0]) / 3


@pytest.mark.parametrize("alpha", [0.05, 0.4, 0.95])
@pytest.mark.parametrize("stick", [1.1, 1.5, 2.0])
def test_friction_falls_by_a_jump_at_the_critical_velocity_of_the_kinetic_coefficient(alpha, stick):
    case, knobs = contact(alpha, stick), {"n_springs": 32, "steps_per_period": 4096}
    below, above = (slide(case, v, **knobs) for v in (1 - 1e-6, 1 + 1e-6))
    law = mdr.laws.falling_friction(1 - 1e-6, alpha, stick)
    assert_allclose(below.share, law.share, rtol=0, atol=1e-8)
    assert below.periods == law.periods
    assert above.kind == "full slip"
    assert_allclose(above.cof, 0.5, rtol=1e-12)
    assert law.share > 1


@pytest.mark.parametrize("v", [0.9, 0.5, 0.2, 0.1, 0.03])
def test_a_punch_below_it_is_the_closed_form(v):
    run, law = slide(contact(0.4, 1.5), v), mdr.laws.falling_friction(v, 0.4, 1.5)
    assert abs(run.share - law.share) <= run.cof_error / 0.5
    assert run.periods == law.periods
    assert run.settled


DRAWN = [  # alpha, stick, v, shape, material
    (0.73, 1.84, 0.296, "punch", "elastic"),
    (1.33, 1.70, 0.804, "punch", "elastic"),
    (1.55, 1.54, 0.136, "punch", "arms"),
    (0.70, 1.24, 0.200, "punch", "arm and dashpot"),
    (0.89, 1.49, 0.118, "punch", "Kelvin"),
    (1.38, 1.61, 0.199, "cone", "Kelvin"),
    (0.47, 1.78, 0.175, "cone", "elastic"),
    (1.19, 1.56, 0.208, "ball", "arms"),
    (0.52, 1.25, 0.544, "ball", "Kelvin"),
]


@pytest.mark.parametrize(("alpha", "stick", "v", "shape", "material"), DRAWN)
def test_runs_agree_with_small_steps(alpha, stick, v, shape, material):
    """Contact kept and lost; from rest, as two states may be."""
    case = contact(alpha, stick, shape, material)
    run = slide(case, v, n_springs=32, steps_per_period=128, start="rest")
    assert run.settled
    assert abs(run.share - of_twin(case, v, 24, 12).real) <= run.cof_error / 0.5 + 5e-5
    assert abs(run.energy_balance.relative) < 1e-12


@pytest.mark.parametrize(
    ("alpha", "stick", "v", "du_x", "material"),
    [(0.6, 1.4, 0.3, 15e-6, "elastic"), (1.3, 1.7, 0.1, 25e-6, "elastic"), (0.5, 1.5, 0.2, 20e-6, "Kelvin")],
)
def test_runs_shaken_along_agree_with_small_steps(alpha, stick, v, du_x, material):
    """Springs are let go both ways."""
    case = replace(contact(alpha, stick, material=material), shake=mdr.InPlaneOscillation(du_x=du_x, omega=300.0))
    run = slide(case, v, n_springs=32, steps_per_period=256, start="rest")
    assert run.settled
    assert abs(run.share - of_twin(case, v, 24, 12).real) <= run.cof_error / 0.5 + 5e-5
    assert abs(run.energy_balance.relative) < 1e-12


@pytest.mark.parametrize(
    ("alpha", "stick", "v", "du_x", "du_y", "shape", "material"),
    [
        (0.6, 1.4, 0.3, 0.0, 15e-6, "punch", "elastic"),
        (1.3, 1.7, 0.1, 5e-6, 25e-6, "punch", "elastic"),
        (1.2, 1.3, 0.3, 0.0, 10e-6, "cone", "elastic"),
        (0.5, 1.5, 0.2, 0.0, 20e-6, "punch", "Kelvin"),
        (0.7, 1.5, 0.2, 0.0, 12e-6, "punch", "arms"),
        (0.7, 1.5, 0.2, 0.0, 12e-6, "punch", "arm and dashpot"),
    ],
)
def test_runs_shaken_across_agree_with_small_steps(alpha, stick, v, du_x, du_y, shape, material):
    """The force of a spring that is let go keeps its direction. Slip that turns is met to an order of the step."""
    shake = mdr.InPlaneOscillation(du_x=du_x, du_y=du_y, phi_y=0.7, omega=300.0)
    case = replace(contact(alpha, stick, shape, material), shake=shake)
    run = slide(case, v, n_springs=32, steps_per_period=128, start="rest")
    assert run.settled
    assert run.stick_share > 0
    missed = complex(run.cof, run.cof_y) / 0.5 - of_twin(case, v, 24, 12)
    assert abs(missed) <= run.cof_error / 0.5 + 5e-5
    assert abs(run.energy_balance.relative) < 1e-5
    turned = slide(replace(case, shake=replace(shake, phi_y=0.7 + np.pi)), v, n_springs=32, n_periods=4, start="rest")
    straight = slide(case, v, n_springs=32, n_periods=4, start="rest")
    assert_allclose([turned.cof, turned.cof_y], [straight.cof, -straight.cof_y], rtol=0, atol=1e-9)


def test_a_body_shaken_across_agrees_with_small_steps():
    k = contact(0.51, 1.6).k_xc
    pull = mdr.SpringPull(k_x=k, m=k / 600.0**2, c_x=0.4 * k / 600.0, k_y=0.5 * k, c_y=0.3 * k / 600)
    shake = mdr.InPlaneOscillation(du_y=10e-6, phi_y=0.7, omega=300.0)
    case = replace(contact(0.51, 1.6), pull=pull, shake=shake)
    run = slide(case, 0.2, n_springs=32, steps_per_period=256, start="rest")
    assert run.settled
    missed = complex(run.cof, run.cof_y) / 0.5 - of_twin(case, 0.2, 60, 12)
    assert abs(missed) <= run.cof_error / 0.5 + 5e-5


@pytest.mark.filterwarnings("ignore::mdr.PlausibilityWarning")
def test_next_to_no_shake_across_it_is_the_line():
    """What a shake does across goes with its amplitude, what it does along with the square of that."""
    case, knobs = contact(0.6, 1.5), {"n_springs": 32, "steps_per_period": 128, "start": "rest"}
    shaken = replace(case, shake=mdr.InPlaneOscillation(du_y=1e-9, omega=300.0))
    run, line = slide(shaken, 0.3, **knobs), slide(case, 0.3, **knobs)
    assert_allclose(run.cof, line.cof, rtol=0, atol=1e-9)
    assert abs(run.cof_y) < 1e-4
    assert run.periods == line.periods


@pytest.mark.parametrize(("alpha", "stick", "v"), [(0.51, 1.95, 0.146), (0.76, 1.44, 0.429), (0.26, 1.30, 0.729)])
def test_a_body_agrees_with_small_steps(alpha, stick, v):
    """Its motion is on parabolas, so that energies close to the second order of a step."""
    k = contact(alpha, stick).k_xc
    case = contact(alpha, stick, pull=mdr.SpringPull(k_x=k, m=k / 600.0**2, c_x=0.4 * k / 600.0))
    run = slide(case, v, n_springs=32, steps_per_period=256, start="rest")
    assert run.settled
    assert run.stick_share > 0
    assert abs(run.share - of_twin(case, v, 60, 12).real) <= run.cof_error / 0.5 + 5e-5
    assert abs(run.energy_balance.relative) < 1e-6


@pytest.mark.filterwarnings("ignore::mdr.PlausibilityWarning")
@pytest.mark.parametrize(("damping", "share"), [(0.0, 1.0), (0.02, 1.0203)])
def test_stick_slip_of_a_body_next_to_no_vibration(damping, share):
    """In a rhythm of its own, from rest; without a damper it ends on a contact that yields. Small steps agree."""
    case = contact(1e-6, 1.5)
    k, omega_0, fall = 0.1 * case.k_xc, 600.0, 0.25 * case.indenter.force(20e-6, case.material.E_star)
    m = k / omega_0**2
    case = replace(case, pull=mdr.SpringPull(k_x=k, m=m, c_x=2 * damping * m * omega_0))
    v_0 = 0.3 * fall * omega_0 / k
    knobs = {"n_springs": 32, "steps_per_period": 256, "accuracy": 1e-3}
    run = mdr.slide(case, v_0, start="rest", **knobs)
    assert run.settled
    assert (run.kind, run.periods) == (("averaged", None) if damping else ("full slip", 1))
    assert ('from start = "full_slip" the COF is 0.5' in run.why) == bool(damping)  # a body that slides on may do so
    assert abs(run.share - share) <= run.cof_error / 0.5 + 5e-5
    periods = of_twin(case, v_0 / case.unit_velocity, 1200, 1000)
    assert abs(run.share - periods) <= run.cof_error / 0.5 + 2e-4


def test_shares_and_energies_are_means_over_the_periods_of_a_state():
    """A record has each of them; the pull does the same work in all, the vibration not."""
    case = contact(0.4, 1.5, "punch")
    run = slide(case, 0.1, n_springs=32, steps_per_period=128, record=2)
    assert run.periods == 2
    stuck = (run.state == mdr.State.STICK) * run.f_z
    assert_allclose(run.stick_share, stuck.sum() / run.f_z.sum(), atol=0.02)
    halves = (run.state == mdr.State.STICK).reshape(2, -1).mean(axis=1)
    assert halves[0] != halves[1]
    balance = run.energy_balance
    assert_allclose(balance.pull_work, run.mean_F_x * run.v_0 * case.period, rtol=1e-12)
    assert abs(balance.stored_change) < 1e-12 * balance.lost


@pytest.mark.parametrize("material", MATERIALS)
def test_the_heat_of_the_instant_at_which_springs_are_let_go_closes_the_balance(material):
    for shape in SHAPES:
        run = slide(contact(1.2, 1.6, shape, material), 0.4, n_periods=4, n_springs=32, steps_per_period=64)
        assert run.stick_share > 0
        assert abs(run.energy_balance.relative) < 1e-12


def body_on(case, tau=0.4):
    """The case with a body that swings at 600 rad/s."""
    return replace(case, pull=mdr.SpringPull(k_x=case.k_xc, m=case.k_xc / 600.0**2, c_x=tau * case.k_xc / 600.0))


@pytest.mark.parametrize("alpha", [0.5, 1.3])
@pytest.mark.parametrize(
    "case",
    [
        contact(0.5, 1.6, "ball"),
        contact(0.5, 1.6, "ball", "slow Kelvin"),
        contact(0.5, 1.6, "punch", "slow Kelvin"),
        body_on(contact(0.5, 1.6, "ball", "Kelvin")),
        replace(contact(0.5, 1.6), shake=mdr.InPlaneOscillation(du_x=15e-6, omega=300.0, phi_x=0.7)),
    ],
    ids=["ball", "slow ball", "slow punch", "ball on a body", "shaken punch"],
)
def test_full_slip_begins_where_a_spring_that_touches_anew_slips_at_once(case, alpha):
    """It sticks as long as its force would grow to less than mu_s f_z: on a dashpot, against the free surface."""
    case = replace(case, oscillation=replace(case.oscillation, du_z=alpha * case.oscillation.u_z0))
    v, knobs = mdr.full_slip_critical_velocity(case), {"n_springs": 128, "steps_per_period": 512}
    below, above = (mdr.slide(case, share * v, **knobs) for share in (0.999, 1.001))
    assert above.kind == "full slip"
    assert below.kind != "full slip"
    plain = mdr.full_slip_critical_velocity(replace(case, friction=mdr.Coulomb(0.5)))
    assert v >= (1 - 1e-12) * plain
    assert isinstance(case.indenter, mdr.FlatPunch) or v > 1.001 * plain


def test_a_pull_beside_the_jump_is_followed_with_more_steps_or_has_it_in_its_error():
    case = contact(0.4, 1.5)
    for side, share in ((-1, mdr.laws.falling_friction(1 - 1e-7, 0.4, 1.5).share), (1, 1.0)):
        run = slide(case, 1 + side * 1e-7)
        assert abs(run.share - share) <= run.cof_error / 0.5
        coarse = slide(case, 1 + side * 1e-7, steps_per_period=128)
        assert coarse.cof_error >= 0.25


def test_friction_is_coulombs_where_it_does_not_fall():
    case = contact(0.4, 1.0)
    assert case == replace(case, friction=mdr.Coulomb(0.5))
    assert slide(case, 0.5).cof == slide(replace(case, friction=mdr.Coulomb(0.5)), 0.5).cof


def test_where_nothing_comes_back_the_mean_has_a_statistical_error():
    """Springs of a ball are let go after different numbers of periods each."""
    knobs = {"n_springs": 32, "steps_per_period": 64, "accuracy": 1e-3}
    run, again = (slide(contact(0.1, 1.9, "ball"), 0.021, start=one, **knobs) for one in ("full_slip", "rest"))
    assert (run.kind, run.periods, run.settled) == ("averaged", None, True)
    assert abs(run.cof - again.cof) <= run.cof_error + again.cof_error


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (
            {"pull": mdr.SpringPull(k_x=2e3)},
            "slide takes a rigid pull or a body with a mass where friction falls",
        ),
    ],
)
def test_what_is_not_done_is_refused_by_name(change, words):
    case = replace(contact(0.4, 1.5), **change)
    with pytest.raises(ValueError, match=rf"{words}.*ask for one coefficient, friction=mdr.Coulomb\(mu_0\)"):
        mdr.slide(case, 1e-4)


def test_steps_that_do_not_resolve_the_body_are_refused():
    case = contact(0.4, 1.5)
    case = replace(case, pull=mdr.SpringPull(k_x=case.k_xc, m=case.k_xc / (90 * 300.0) ** 2))
    with pytest.raises(ValueError, match="steps_per_period = 64 is too coarse for friction that falls"):
        slide(case, 0.5, steps_per_period=64)


@pytest.mark.parametrize("n_t", [48, 64])
def test_runs_beside_one_that_just_resolves_the_body_have_more_steps(n_t):
    """Half of the steps would not resolve it."""
    k = contact(0.26, 1.3).k_xc
    case = contact(0.26, 1.3, pull=mdr.SpringPull(k_x=k, m=k / 600.0**2, c_x=0.4 * k / 600.0))
    run, fine = (slide(case, 0.729, n_springs=32, steps_per_period=n, start="rest") for n in (n_t, 1024))
    assert run.settled
    assert abs(run.cof - fine.cof) <= run.cof_error < 2e-5


def stage(contact_over_spring, damping, velocity, alpha, stick=1.5):
    """A punch on an undamped or damped spring: the case, its pulling velocity over Delta omega_0/k_x, and its law."""
    punch, material = SHAPES["punch"], MATERIALS["elastic"]
    full, k_xc = 0.5 * punch.force(20e-6, material.E_star), 2 * material.G_star * punch.a
    k, omega_0, fall = k_xc / contact_over_spring, 600.0, (stick - 1) * full
    m = k / omega_0**2
    c, v_0 = 2 * damping * m * omega_0, velocity * fall * omega_0 / k
    law = mdr.laws.stick_slip(v_0, stick * full, full, k, m, c, k_xc)
    motion = mdr.NormalOscillation(20e-6, alpha * 20e-6, 2 * np.pi / law.period)
    friction = mdr.StaticKinetic(0.5 * stick, 0.5)
    pull = mdr.SpringPull(k_x=k, m=m, c_x=c)
    return mdr.SlidingContact(punch, material, oscillation=motion, friction=friction, pull=pull), v_0, law


@pytest.mark.filterwarnings("ignore::mdr.PlausibilityWarning")
@pytest.mark.parametrize(
    ("contact_over_spring", "damping", "velocity"),
    [(1, 0.0, 0.3), (1, 0.02, 0.3), (10, 0.02, 0.3), (10, 0.1, 0.3), (100, 0.02, 0.05), (100, 0.1, 0.05)],
)
def test_stick_slip_without_vibration_is_its_closed_form(contact_over_spring, damping, velocity):
    """Next to no vibration, of the period of the law: the body is where it was, period after period."""
    case, v_0, law = stage(contact_over_spring, damping, velocity, alpha=1e-7)
    run = mdr.slide(case, v_0, start="rest", n_springs=16, steps_per_period=8192, n_periods=200, record=4)
    stretch = v_0 * run.t.reshape(4, -1) - run.u_x.reshape(4, -1)
    rate = np.gradient(stretch[0], run.t[1] - run.t[0])
    steepest = np.argmin(rate)
    assert abs(stretch[3] - stretch[0])[steepest] < 1e-6 * 3 * law.period * abs(rate[steepest])
    assert_allclose(run.mean_F_x, law.mean_force, rtol=1e-6)
    assert_allclose(run.stick_share, law.rest, rtol=1e-6)
    assert_allclose(np.diff(run.u_x).max() / (run.t[1] - run.t[0]), law.speed, rtol=3e-6)  # means over steps


@pytest.mark.filterwarnings("ignore::mdr.PlausibilityWarning")
def test_small_steps_agree_with_stick_slip_whose_slips_differ_for_ever():
    """Where there is no closed form: an undamped body whose swing on the contact never dies out."""
    full, k_xc = 0.5 * SHAPES["punch"].force(20e-6, MATERIALS["elastic"].E_star), contact(1e-6, 1.5).k_xc
    m, v_0 = 0.1 * k_xc / 600.0**2, 0.01 * 0.5 * full * 600.0 / (0.1 * k_xc)
    with pytest.raises(ValueError, match="slips still differ"):
        mdr.laws.stick_slip(v_0, 1.5 * full, full, 0.1 * k_xc, m, k_xc=k_xc)
    case = contact(1e-6, 1.5, pull=mdr.SpringPull(k_x=0.1 * k_xc, m=m))
    run = mdr.slide(case, v_0, start="rest", n_springs=32, steps_per_period=256)
    assert run.kind == "averaged"
    assert abs(run.share - of_twin(case, v_0 / case.unit_velocity, 1200, 1000)) <= run.cof_error / 0.5 < 0.02
