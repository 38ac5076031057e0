"""What no settled run may contradict: on numbers, and on random bodies."""

import math
from itertools import combinations

import numpy as np
import pytest
from conftest import SHAPES
from numpy.testing import assert_array_equal

import mdr
from mdr.march.periodic.theorems import disordered, outside


def test_a_cof_lies_between_the_static_limit_and_mu_0():
    assert outside(0.7, 0.5, 1e-3) == outside(0.4995, 0.5, 1e-3) == outside(1.0005, 0.5, 1e-3) == ""
    assert "below the static limit" in outside(0.49, 0.5, 1e-3)
    assert "below the static limit" in outside(-0.004, 0.0, 1e-3)
    assert "more than the springs can hold" in outside(1.002, 0.5, 1e-3)


def test_friction_that_falls_with_velocity_is_named_at_both_velocities():
    v_0 = np.array([3.0, 1.0, 2.0, 4.0])
    cof, error, settled = np.array([0.7, 0.5, 0.8, 0.9]), np.full(4, 0.01), np.ones(4, dtype=bool)
    assert_array_equal(disordered(v_0, cof, error, settled), [True, False, True, False])
    assert not disordered(v_0, cof, np.full(4, 0.06), settled).any()
    # one that has not settled says nothing, and contradicts nothing
    assert not disordered(v_0, cof, error, np.array([True, True, False, True])).any()


OMEGA, U_Z0, MU_0 = 300.0, 2e-5, 0.5


def drawn(seed):
    """A random contact under a body, and a velocity. A third has no damper, a third stands within 1e-2 of a multiple of
    the drive, some of them on it; loads, arms, amplitudes up to twice the depth, light bodies and heavy ones.
    """
    rng = np.random.default_rng([7, seed])
    name = str(rng.choice(list(SHAPES)))
    nu, alpha = float(rng.choice([0.5, 0.3, rng.uniform(0, 0.5)])), float(0.05 * 40 ** rng.uniform())
    times = [float(0.1 * 50 ** rng.uniform()) / OMEGA for _ in range(3)]
    material = [
        lambda: mdr.Elastic(E=3e6, nu=nu),
        lambda: mdr.KelvinVoigt(E=3e6, nu=nu, tau=times[0]),
        lambda: mdr.StandardLinearSolid(E_inf=3e6, E_1=3e6 * 10 ** rng.uniform(-1, 1), tau_1=times[1], nu=nu),
        lambda: mdr.Prony(E_inf=3e6, arms=((1e6, times[1]), (4e6, times[2])), nu=nu, tau=times[0]),
    ][int(rng.choice(4, p=[0.45, 0.35, 0.1, 0.1]))]()
    shape = SHAPES[name][0]
    k_xc = float(shape.stiffness(U_Z0, material.G_star))
    k_x = k_xc * 10 ** rng.uniform(-1, 1)
    near = int(rng.choice([1, 2, 3])) if seed % 3 == 1 else 0
    ratio = 0.3 * 20 ** rng.uniform()  # omega_0/omega: heavy to light
    if near:
        off = float(rng.choice([0.0, 1.0], p=[0.1, 0.9])) * 10 ** rng.uniform(-6, -2)
        ratio = near * (1 + float(rng.choice([-1, 1])) * off)
    m = k_x / (ratio * OMEGA) ** 2 if near or rng.uniform() > 0.07 else 0.0
    zeta = 0.0 if seed % 3 == 0 or rng.uniform() < 0.3 else float(10 ** rng.uniform(-4, -0.5))
    pull = mdr.SpringPull(k_x=k_x, m=m, c_x=2 * zeta * math.sqrt(k_x * m))
    motion = mdr.NormalOscillation(U_Z0, alpha * U_Z0, OMEGA)
    if rng.uniform() < 0.2:
        load = float(shape.force(U_Z0, material.E_star))
        motion = mdr.LoadOscillation(load, load * min(0.45 * alpha, 0.9), OMEGA)
    case = mdr.SlidingContact(shape, material, MU_0, motion, pull)
    full = mdr.full_slip_critical_velocity(case)
    v_0 = float(rng.uniform(0.05, 1.2)) * (full if math.isfinite(full) else mdr.resolved(case).unit_velocity)
    return case, v_0


@pytest.mark.parametrize("seed", range(12))
def test_no_settled_run_of_a_random_body_contradicts_a_theorem(seed):
    """One velocity has one COF, whatever the start, between the static limit and mu_0, and no less at a higher one."""
    case, v_0 = drawn(seed)
    known = (mdr.slide(case, v_0), mdr.slide(case, v_0, start="rest"), mdr.slide(case, 1.05 * v_0))
    least, ended = mdr.static_cof(case), [run for run in known if run.settled]
    assert all(run.why for run in known if not run.settled)
    for run in ended:
        assert least - 1e-4 * MU_0 <= run.cof + run.cof_error
        assert run.cof - run.cof_error <= MU_0
    for one, two in combinations(ended, 2):
        apart = one.cof - two.cof
        assert apart <= one.cof_error + two.cof_error
        assert one.v_0 < two.v_0 or -apart <= one.cof_error + two.cof_error


@pytest.mark.parametrize("seed", [0, 2, 4, 5, 7])
def test_the_measured_velocity_of_a_random_body_is_where_it_slips_throughout(seed):
    """Or there is none, where settled runs above the full-slip value do not have the full friction."""
    case = mdr.resolved(drawn(seed)[0])
    found, full = mdr.measure_critical_velocity(case), mdr.full_slip_critical_velocity(case)
    if found.kind == "none":
        run = mdr.slide(case, 1.03 * full) if np.isfinite(full) else None
        assert run is None or not run.settled or case.mu_0 - run.cof > run.cof_error
    else:
        assert found.v_c == pytest.approx(full, abs=max(1e-4 * found.v_c, found.high - found.low))
