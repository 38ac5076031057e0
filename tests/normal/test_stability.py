"""Floquet multipliers of a depth under a load: Hill's equation integrated, and a march of the depth that is pushed."""

import numpy as np
import pytest
from conftest import SHAPES
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

import mdr
from mdr.normal.stability import floquet_multiplier

OMEGA, DEPTH = 300.0, 20e-6
pytestmark = pytest.mark.filterwarnings("ignore::mdr.PlausibilityWarning")


def depth_under(shape, material, ratio, share):
    """m_z omega² = ratio times the stiffness at rest."""
    indenter = SHAPES[shape][0]
    F_z0, k_zc = (float(of(DEPTH, material.E_star)) for of in (indenter.force, indenter.stiffness))
    load = mdr.LoadOscillation(F_z0, share * F_z0, OMEGA, ratio * k_zc / OMEGA**2)
    case = mdr.resolved(mdr.SlidingContact(indenter, material, 0.4, load))
    return case, load, case.oscillation.cycle


@pytest.mark.parametrize(
    ("shape", "ratio", "share", "stable"),
    [
        ("flat", 0.6, 0.3, True),
        ("flat", 0.6, 1.5, False),
        ("flat", 1.1, 0.9, True),
        ("flat", 1.1, 1.5, False),
        ("paraboloid", 2.0, 0.9, True),
        ("paraboloid", 4.0, 1.5, False),
        ("cone", 2.0, 0.3, True),
    ],
)
def test_elastic_deviations_obey_hills_equation(shape, ratio, share, stable):
    elastic = mdr.Elastic(3e6, 0.5)
    case, load, cycle = depth_under(shape, elastic, ratio, share)

    phases = np.linspace(0, 2 * np.pi, 2**14 + 1)
    u_z = cycle.u_z0 + cycle.unit * cycle.over_a_period(2**14)[0]
    k = np.where(u_z > 0, case.indenter.stiffness(np.maximum(u_z, 1e-12), elastic.E_star), 0.0)

    def rate(phase, y):
        return np.concatenate([y[2:], -np.interp(phase, phases, k) / (load.m_z * OMEGA**2) * y[:2]])

    end = solve_ivp(rate, (0, 2 * np.pi), [1, 0, 0, 1], rtol=1e-6, atol=1e-8, max_step=0.02).y[:, -1]
    expected = np.abs(np.linalg.eigvals(end.reshape(2, 2))).max()
    assert (expected < 1.001) == stable
    # a touch is told to a step of 2 pi/2048, which at most some of these deviations grow by
    assert_allclose(floquet_multiplier(case.indenter, elastic, load, cycle), expected, rtol=1e-2)


@pytest.mark.parametrize(
    ("shape", "ratio", "share", "T", "n_periods"),
    [
        ("flat", 1.1, 1.5, 0.05, 9),
        ("flat", 4.0, 0.9, 0.3, 9),
        ("paraboloid", 1.1, 1.5, 0.3, 9),
        ("flat", 0.25, 0.9, 0.3, 4),  # what is left after more is rounding
        ("flat", 0.25, 1.3, 0.9, 3),
    ],
)
def test_a_march_stays_on_the_depth_and_leaves_it_if_pushed_as_the_multiplier_says(shape, ratio, share, T, n_periods):
    material = mdr.KelvinVoigt(3e6, 0.5, T / OMEGA)
    case, load, cycle = depth_under(shape, material, ratio, share)
    u_z, grown = marched(case, load, cycle, n_periods)
    z, _ = cycle.over_a_period(u_z.size)
    # from where it is unstable, with a multiplier of 1.6, an error of 1e-5 has grown to 7e-4
    assert_allclose(u_z, cycle.u_z0 + cycle.unit * z[1:], rtol=0, atol=1e-3 * cycle.unit)
    assert_allclose(floquet_multiplier(case.indenter, material, load, cycle), grown[-1] / grown[-2], rtol=0.02)


def marched(case, load, cycle, n_periods, n_springs=32, n_steps=1024, push=1e-7):
    """Depth of a Kelvin contact under its load over the last period, and how far one that was pushed is from it at the
    end of each.
    """
    material, T, h = case.material, case.T, 2 * np.pi / n_steps
    edge = case.indenter.contact_radius(case.u_z_max)
    gap = np.asarray(case.indenter.profile_1d((np.arange(n_springs) + 0.5) / n_springs * edge))
    dk, M = 2 * edge / n_springs * material.E_star, load.m_z * OMEGA**2
    z, z_dot = cycle.over_a_period(n_steps)
    s = np.zeros(n_springs)
    for depth in (cycle.u_z0 + cycle.unit * z).tolist() * 2:  # springs follow the periodic depth
        s = np.maximum(s * np.exp(-h / T), depth - gap)
    u, v = np.full(2, cycle.u_z0 + cycle.unit * z[0]), np.full(2, cycle.unit * z_dot[0])
    u[1] += push * cycle.unit
    s, u_z, apart = np.array([s, s]), [], []
    for i in range(n_periods * n_steps):
        F_z, free, end = load.F_z0 + load.dF_z * np.cos((i + 0.5) * h), s * np.exp(-h / T), u + h * v
        for _ in range(6):  # Newton, for the depth at the end of a step of which the force is that of its middle
            presses = end[:, None] - gap > free
            s_end = np.where(presses, end[:, None] - gap, free)
            F_N = dk * np.where(presses, 0.5 * (s + s_end) + T * (s_end - s) / h, 0).sum(axis=1)
            slope = 1 + h**2 / (2 * M) * dk * presses.sum(axis=1) * (0.5 + T / h)
            end = end - (end - u - h * v - h**2 / (2 * M) * (F_z - F_N)) / slope
        u, v, s = end, 2 * (end - u) / h - v, s_end
        u_z.append(u[0])
        apart.append(np.hypot(u[1] - u[0], v[1] - v[0]))
    return np.array(u_z[-n_steps:]), apart[n_steps - 1 :: n_steps]
