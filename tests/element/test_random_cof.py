"""Friction under a random depth: its bookkeeping against recorded motion, invariances, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest
from elements import every_material
from numpy.testing import assert_allclose

import mdr

ELASTIC, MU_0, DEPTH = mdr.Elastic(E=3e6, nu=0.5), 0.5, 20e-6
STEADY = mdr.NormalOscillation(u_z0=DEPTH, du_z=1e-6, omega=600.0)
PUNCH = mdr.SlidingContact(mdr.FlatPunch(a=1e-3), ELASTIC, MU_0, STEADY)
BALL = replace(PUNCH, indenter=mdr.Paraboloid(R=0.05))
BAND = mdr.Spectrum.band(rms=2e-6, f_low=50.0, f_high=100.0)
UNIT = MU_0 * ELASTIC.mindlin_ratio * BAND.rms_velocity


@pytest.mark.parametrize("rms", [2e-6, 15e-6], ids=["kept", "lost"])
@every_material
def test_a_history_is_a_recorded_motion(material, rms):
    """The third period of a record less its second, with the same springs; steps are extrapolated in one of them."""
    case, spectrum, v_0 = replace(BALL, material=material), mdr.Spectrum.band(rms, 50.0, 100.0), UNIT
    found = mdr.random_cof(case, spectrum, v_0, n_realisations=8, seed=4, n_springs=32)
    n_t, dt = found.n_t, found.duration / found.n_t
    u_z = DEPTH + np.tile(spectrum.realisation(n_t, dt, seed=4, k=2), 3)
    impulses = []
    for n in (2 * n_t + 1, 3 * n_t):
        t = dt * np.arange(n)
        run = mdr.slide_record(case.indenter, material, MU_0, t, v_0 * t, u_z=u_z[:n], n_springs=32)
        impulses.append(run.mean_F_z * t[-1] * np.array([run.cof, 1]))
    F_x, F_z = impulses[1] - impulses[0]
    assert_allclose(found.realisations[2, 0], F_x / F_z, rtol=0, atol=4 * found.cof_error[0])
    assert found.cof_error[0] < 0.01 * MU_0


def test_friction_that_falls_in_a_history_is_that_of_a_recorded_motion():
    """Springs are let go within a period, and forget then."""
    law, v_0 = mdr.StaticKinetic(1.5 * MU_0, MU_0), 0.5 * UNIT
    case = replace(BALL, friction=law)
    found, plain = (mdr.random_cof(one, BAND, v_0, n_realisations=8, seed=4, n_springs=32) for one in (case, BALL))
    n_t, dt, impulses = found.n_t, found.duration / found.n_t, []
    u_z = DEPTH + np.tile(BAND.realisation(n_t, dt, seed=4, k=2), 3)
    for n in (2 * n_t + 1, 3 * n_t):
        t = dt * np.arange(n)
        run = mdr.slide_record(BALL.indenter, ELASTIC, MU_0, t, v_0 * t, u_z=u_z[:n], n_springs=32, mu_s=law.mu_s)
        impulses.append(run.mean_F_z * t[-1] * np.array([run.cof, 1]))
    F_x, F_z = impulses[1] - impulses[0]
    assert_allclose(found.realisations[2, 0], F_x / F_z, rtol=0, atol=4 * found.cof_error[0] + 1e-4)
    assert found.cof[0] > plain.cof[0] + 0.01 * MU_0


def test_friction_and_its_standard_error_are_those_of_the_realisations():
    """To the first order in the spread of the mean force: a ratio of means beside a mean of ratios."""
    found = mdr.random_cof(PUNCH, BAND, UNIT * np.array([0.3, 1.0, 2.0]), n_realisations=32)
    spread = found.realisations.std(axis=0, ddof=1) / np.sqrt(32)
    assert_allclose(found.standard_error, spread, rtol=0.02)
    assert_allclose(found.cof, found.realisations.mean(axis=0), rtol=0, atol=0.05 * spread.max())
    assert np.all(np.diff(found.cof) > 0)
    more = mdr.random_cof(PUNCH, BAND, UNIT, n_realisations=64)
    assert_allclose(more.realisations[:32], found.realisations[:, 1:2], rtol=0, atol=found.cof_error.max())


def test_seeds_draw_anew_and_standard_errors_tell_by_how_much():
    cofs, told, wide = [], [], mdr.Spectrum.band(rms=2e-6, f_low=0.0, f_high=100.0)
    for seed in range(40):
        one = mdr.random_cof(PUNCH, wide, UNIT, n_realisations=8, seed=seed)
        cofs.append(one.cof[0])
        told.append(one.standard_error[0])
    assert_allclose(np.std(cofs), np.mean(told), rtol=3 / np.sqrt(2 * 40))


def test_a_contact_that_seldom_touches_has_numbers():
    """Some histories never touch: they have no friction, and all others full friction or less."""
    case = replace(BALL, oscillation=mdr.NormalOscillation(-7e-6, 8e-6, 600.0))
    found = mdr.random_cof(case, BAND, UNIT, n_realisations=16, n_springs=32)
    never = np.isnan(found.realisations[:, 0])
    assert 0 < never.sum() < 16
    assert np.all(found.realisations[~never] <= MU_0 + found.cof_error)  # a step less is extrapolated
    assert np.all(np.isfinite([found.cof, found.standard_error, found.cof_error]))


@pytest.mark.parametrize("case", [PUNCH, BALL], ids=["punch", "ball"])
def test_only_ratios_matter(case):
    """Stiffer, larger and faster by any factor."""
    found = mdr.random_cof(case, BAND, UNIT, n_realisations=8)
    k, w = 50.0, 4.0  # of lengths, and of frequencies by a power of two, which keeps the steps
    shape = mdr.FlatPunch(a=1e-2) if case is PUNCH else mdr.Paraboloid(R=1.0)
    larger = mdr.SlidingContact(shape, mdr.Elastic(E=7e8, nu=0.5), MU_0, replace(STEADY, u_z0=k * DEPTH))
    faster = mdr.Spectrum.band(k * 2e-6, w * 50.0, w * 100.0)
    other = mdr.random_cof(larger, faster, k * w * UNIT, n_realisations=8)
    assert_allclose(other.cof, found.cof, rtol=1e-9)


def test_its_words_its_table_and_its_figure():
    found = mdr.random_cof(PUNCH, BAND, [UNIT, 2 * UNIT], n_realisations=8)
    assert "of 8 realisations" in str(found)
    assert found.table().splitlines()[0] == "v_0 [m/s],cof [-],standard_error [-],cof_error [-]"
    assert len(found.table().splitlines()) == 3
    ax = found.plot()
    assert found.plot(ax) is ax
