"""Runs of contacts that are shaken along their way: against a twin, closed limits, and what must not matter."""

import math
from dataclasses import replace

import numpy as np
import pytest
from conftest import SHAPES
from numpy.testing import assert_allclose

import mdr

OMEGA, MU_0, NU, DEPTH = 300.0, 0.4, 0.4, 20e-6
KAPPA = (2 - NU) / (2 * (1 - NU))
REACH = MU_0 * KAPPA * DEPTH  # deflection at which the deepest spring slips
KNOBS = {"n_springs": 64, "steps_per_period": 256}


def contact(shape="paraboloid", alpha=0.0, T=0.0, chi=1.0, phi=0.7, body=None, at="tool", **others):
    """alpha = du_z/u_z0, chi = du_x/REACH; body: k_x/k_xc, omega_0/omega, damping ratio."""
    indenter = SHAPES[shape][0]
    material = mdr.KelvinVoigt(E=3e6, nu=NU, tau=T / OMEGA) if T else mdr.Elastic(E=3e6, nu=NU)
    motion = mdr.NormalOscillation(DEPTH, alpha * DEPTH, OMEGA) if alpha else mdr.ConstantDepth(DEPTH)
    pull = mdr.RigidPull()
    if body is not None:
        k, ratio, zeta = body
        k_x = k * float(indenter.stiffness(DEPTH, material.G_star))
        m = k_x / (ratio * OMEGA) ** 2 if ratio < np.inf else 0.0
        pull = mdr.SpringPull(k_x, m, 2 * zeta * math.sqrt(k_x * m))
    shake = mdr.InPlaneOscillation(OMEGA, chi * REACH, phi, at=at)
    return replace(mdr.SlidingContact(indenter, material, MU_0, motion, pull, shake), **others)


# --- limits ---


def test_in_phase_with_the_depth_a_shake_leaves_friction_full_forward():
    """x = mu_0 kappa u_z: every spring slips at the velocity of the pull, whatever the instant."""
    case = contact("paraboloid", alpha=0.5, chi=0.5, phi=0.0)
    assert mdr.critical_velocity(case) < 1e-12 * mdr.critical_velocity(case, -1)
    assert mdr.critical_velocity(case, -1) == pytest.approx(2 * case.unit_velocity, rel=1e-14)
    slow = 1e-3 * case.unit_velocity
    assert mdr.slide(case, slow).cof == pytest.approx(MU_0, rel=1e-12)
    assert mdr.slide(case, -slow).cof > -0.9 * MU_0


# --- what must not matter ---


@pytest.mark.parametrize("T", [0.0, 0.5])
@pytest.mark.parametrize("body", [None, (1.0, 0.7, 0.4)])
def test_half_a_period_later_is_the_other_way(T, body):
    """A harmonic shake alone is its own mirror half a period on, and the march knows nothing of that."""
    case = contact("cone", T=T, chi=1.3, body=body)
    later = replace(case, shake=replace(case.shake, phi_x=case.shake.phi_x + np.pi))
    v_0 = 0.4 * mdr.critical_velocity(case)
    assert mdr.slide(case, v_0, **KNOBS).cof == pytest.approx(mdr.slide(later, v_0, **KNOBS).cof, rel=1e-8)
    assert mdr.slide(case, -v_0, **KNOBS).cof == pytest.approx(-mdr.slide(case, v_0, **KNOBS).cof, rel=1e-8)


def test_a_pulling_point_shakes_by_what_spring_and_damper_pass_on():
    far = contact(alpha=0.4, T=0.3, chi=1.0, body=(1.0, 0.7, 0.4), at="pull")
    X = complex(far.way[0])
    near = replace(far, shake=mdr.InPlaneOscillation(OMEGA, abs(X), float(np.angle(X))))
    for v_0 in (1e-3, -2e-3):
        one, other = (mdr.slide(case, v_0, record=1, **KNOBS) for case in (far, near))
        assert one.cof == pytest.approx(other.cof, rel=1e-10)
        assert_allclose(one.u_x, other.u_x, rtol=0, atol=1e-9 * REACH)
        # the drive does not do the same work there
        assert one.energy_balance.shake_work != pytest.approx(other.energy_balance.shake_work, rel=0.1)


# --- accuracy, energy, the ends ---


def test_the_power_of_an_ultrasonic_shake_is_that_of_springs_that_stick_and_slip():
    """Steel on steel at 20 kHz, elastic springs dragged in small steps; the pull gives v_0 times the mean force."""
    omega, v_0, mu_0, amplitude = 2 * np.pi * 20e3, 0.1, 0.3, 5e-6
    steel = mdr.ElasticPair(E_1=210e9, nu_1=0.3, E_2=210e9, nu_2=0.3)
    shake = mdr.InPlaneOscillation(omega, du_x=amplitude)
    case = mdr.SlidingContact(mdr.Paraboloid(R=10e-3), steel, mu_0, mdr.ConstantLoad(F_z0=50.0), shake=shake)
    depth = (3 * 50.0 / (4 * steel.E_star * np.sqrt(10e-3))) ** (2 / 3)  # Hertz
    a, n, steps = np.sqrt(10e-3 * depth), 400, 4000
    x = (np.arange(n) + 0.5) / n * a
    limit = mu_0 * steel.E_star * 2 * a / n * (depth - x**2 / 10e-3)
    t = np.linspace(0, 4 * np.pi / omega, 2 * steps + 1)
    e, lost = np.zeros(n), np.zeros(2 * steps)
    stiff = steel.G_star * 2 * a / n
    for i, step in enumerate(np.diff(v_0 * t + amplitude * np.cos(omega * t))):
        stuck = e + step
        e = np.clip(stuck, -limit / stiff, limit / stiff)
        lost[i] = np.sum(limit * np.abs(stuck - e))
    run = mdr.slide(case, v_0)
    hand = 20e3 * lost[steps:].sum()  # of the second period
    assert hand == pytest.approx(5.31, rel=1e-3)
    assert run.power["lost"] == pytest.approx(hand, rel=1e-3)  # steps of a thousandth of the swing
    assert run.power["pull"] == pytest.approx(v_0 * run.mean_F_x, rel=1e-9)
    assert run.power["pull"] + run.power["shake"] == pytest.approx(run.power["lost"], rel=1e-9)
    assert run.power["normal"] == 0.0
    assert "W from the shake, 0.15984 W from the pull" in str(run)
    assert "normal drive" not in str(run)


def test_a_pulling_point_shaken_on_an_undamped_resonance_sticks_at_any_velocity():
    case = contact(at="pull", pull=mdr.SpringPull(k_x=0.05 * OMEGA**2, m=0.05))
    assert math.isinf(mdr.critical_velocity(case))
    assert math.isinf(mdr.full_slip_critical_velocity(case, -1))


# --- invariances of an elastic contact, whose springs know no time ---


def harmonics_of(values):
    """Amplitudes of cos and sin of a periodic record, those beyond the rounding."""
    found = 2 * np.fft.rfft(values)[1:41] / values.size
    return tuple(found.real), tuple(-found.imag)


@pytest.mark.parametrize("shape", ["flat", "paraboloid"])
@pytest.mark.parametrize("v_0", [4e-4, -3e-3])
def test_the_same_path_in_another_time_moves_no_force(shape, v_0):
    """Depth, shake and pull are all led at another pace, phase + 0.3 sin(phase): the same force at the same place."""
    case, warp = contact(shape, alpha=0.5, chi=0.8), 0.3
    t = 2 * np.pi * np.arange(512) / 512
    phase = t + warp * np.sin(t)
    pulled = warp * np.sin(t) * v_0 / OMEGA  # the pull itself goes at a steady pace
    z, x = 0.5 * DEPTH * np.cos(phase), 0.8 * REACH * np.cos(phase + 0.7) + pulled
    warped = replace(
        case,
        oscillation=mdr.PeriodicMotion(OMEGA, DEPTH + z.mean(), *harmonics_of(z)),
        shake=mdr.InPlaneMotion(OMEGA, *harmonics_of(x)),
    )
    one, other = (mdr.slide(each, v_0, n_springs=48, steps_per_period=2048, record=1) for each in (case, warped))
    at = np.mod(OMEGA * other.t + warp * np.sin(OMEGA * other.t), 2 * np.pi)
    there = np.interp(at, np.mod(OMEGA * one.t, 2 * np.pi), one.F_x, period=2 * np.pi)
    scale = MU_0 * np.max(one.F_z)
    assert_allclose(other.F_x, there, rtol=0, atol=3e-4 * scale)  # where modes change within a step
    losses = [run.energy_balance.friction_loss for run in (one, other)]
    assert losses[1] == pytest.approx(losses[0], rel=1e-4)
    assert np.abs(other.F_x - one.F_x).max() > 0.1 * scale  # at the same time


@pytest.mark.parametrize(
    "case",
    [
        contact("flat", chi=0.5),
        contact("r4", chi=0.4, body=(1.0, 0.7, 0.3)),
        contact("cone", alpha=0.3, T=0.5, chi=0.3),
        contact("paraboloid", chi=0.3, material=mdr.StandardLinearSolid(3e6, 2e6, 2e-3, NU)),
    ],
    ids=["rigid", "body", "kelvin", "arms"],
)
def test_a_contact_that_holds_says_that_it_may_rest_elsewhere(case):
    """From two starts it comes to rest in two states, each of them settled."""
    runs = [mdr.slide(case, 0.0, start=start, n_springs=32, steps_per_period=128) for start in ("full_slip", "rest")]
    assert abs(runs[0].cof - runs[1].cof) > 10 * (runs[0].cof_error + runs[1].cof_error)
    for run in runs:
        assert (run.settled, run.kind) == (True, "holds")
        assert "holding_band(case)" in run.why


@pytest.mark.parametrize("body", [None, (1.0, 0.7, 0.3)], ids=["rigid", "body"])
@pytest.mark.parametrize("T", [0.0, 0.5])
def test_a_contact_that_slips_in_every_period_rests_in_one_state(T, body):
    """So does a punch whose springs are moved to and fro by more than twice the deflection at which they slip."""
    case = contact("flat", alpha=0.3, T=T, chi=4.0, body=body)
    runs = [mdr.slide(case, 0.0, start=start) for start in ("full_slip", "rest")]
    assert [(run.settled, run.kind, run.why) for run in runs] == [(True, "periodic", "")] * 2
    assert runs[0].cof == pytest.approx(runs[1].cof, abs=runs[0].cof_error + runs[1].cof_error)
