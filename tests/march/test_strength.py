"""Faces with a shear strength: runs beside the twin, the elastic paraboloid in closed form, the flat punch, limits."""

from dataclasses import replace

import numpy as np
import pytest
from conftest import SHAPES, Spot
from numpy.testing import assert_allclose
from tables import strength as table

import mdr
from mdr.march.periodic.steady import at_hand, steady
from mdr.march.result.refinement import resolution_of

OMEGA, DEPTH, ALPHA = table.OMEGA, table.DEPTH, 0.3
ELASTIC, KELVIN, ARMS = (one[0] for one in table.MATERIALS.values())
MOTION = mdr.NormalOscillation(DEPTH, ALPHA * DEPTH, OMEGA)
BALL = mdr.SlidingContact(SHAPES["paraboloid"][0], ELASTIC, 0.0, MOTION, tau_0=1e4)
#: of the velocity, 2 tau_0/G* omega a at the mean depth
UNIT = 2 * BALL.tau_0 / ELASTIC.G_star * OMEGA * np.sqrt(5e-3 * DEPTH)
KNOBS = {"n_springs": 64, "steps_per_period": 256}

ROUND, LEVEL = ({name: known for name, *known in table.drawn(60, level)} for level in (False, True))


def named(random, *numbers):
    return [name for name in random if int(name.split(":")[0]) in numbers]


@pytest.mark.parametrize(
    "name", [*named(ROUND, 1, 2, 3, 6, 8, 16, 18, 21, 28, 30, 32, 33, 36, 42), *named(LEVEL, 3, 9, 10, 18, 21, 33)]
)
def test_runs_agree_with_the_twin(name):
    """Elastic shapes, contact kept and lost; punches that keep it; level in the middle, where springs of one gap differ
    by their place; rigid, under a body, shaken along and across.
    """
    row = table.row_of(name, *(ROUND | LEVEL)[name], steps=2048, count=64)
    assert row.settled
    assert row.doubt < 1e-4
    assert row.error <= row.bound, row


@pytest.mark.parametrize("material", [mdr.KelvinVoigt(3e6, 0.4, 5e-3), ARMS], ids=["Kelvin", "arms"])
def test_a_search_ends_where_a_march_does(material):
    case = replace(BALL, mu_0=0.2, material=material)
    v_0 = 0.15 * case.unit_velocity
    run, march = (mdr.slide(case, v_0, n_periods=n, **KNOBS) for n in (None, 40))
    assert run.settled
    assert run.cof == pytest.approx(march.cof, abs=1e-7)


@pytest.mark.parametrize("name", named(ROUND, 15, 16))
def test_cof_error_covers_an_edge_that_comes_from_nothing(name):
    """A round face, whose radius grows at once, and a punch, whose radius jumps."""
    row = table.row_of(name, *ROUND[name])
    assert row.error <= row.bound, row


def test_cof_error_covers_what_few_springs_do_not_see():
    run = mdr.slide(BALL, 4 * UNIT)
    assert abs(1 - run.share - 2 / (9 * np.pi**2) * (ALPHA / 4) ** 3) <= run.cof_error / run.full_cof


@pytest.mark.parametrize(("v_hat", "lost", "digit"), [(0.1, 0.0940, 1e-4), (0.3, 0.0163, 1e-4), (1.0, 6.1e-4, 1e-5)])
def test_what_an_elastic_paraboloid_loses(v_hat, lost, digit):
    run = mdr.slide(BALL, v_hat * UNIT)
    assert 1 - run.share == pytest.approx(lost, abs=digit / 2 + run.cof_error / run.full_cof)


def test_fast_slides_lose_by_the_cube_of_the_velocity():
    """(2/9 pi²)(alpha/v_hat)³; the springs that stick lie close to the edge, and many are needed to see them."""
    off = []
    for v_hat, n, steps in ((0.5, 256, 1024), (1.0, 256, 1024), (2.0, 512, 4096)):
        run = mdr.slide(BALL, v_hat * UNIT, n_springs=n, steps_per_period=steps)
        law = 2 / (9 * np.pi**2) * (ALPHA / v_hat) ** 3
        off.append(abs(1 - run.share - law) / law)
        within = run.cof_error / run.full_cof / law
    assert off[0] > off[1] > off[2] - within
    assert off[2] < 0.02


@pytest.mark.parametrize("material", [ELASTIC, KELVIN, ARMS], ids=["elastic", "Kelvin", "arms"])
def test_a_punch_in_contact_loses_as_by_coulomb_friction(material):
    """The limit of each of its springs is higher by a constant."""
    plain = mdr.SlidingContact(SHAPES["flat"][0], material, 0.4, MOTION)
    v_0, lost = 0.4 * plain.unit_velocity, []
    for case in (plain, replace(plain, tau_0=2e4)):
        run = mdr.slide(case, v_0, n_periods=60, **KNOBS)
        lost.append(run.full_cof * run.mean_F_z - run.mean_F_x)
        assert run.full_cof == pytest.approx(0.4 + case.tau_0 * np.pi * 1e-6 / run.mean_F_z, rel=1e-12)
    assert lost[0] > 0.01 * run.mean_F_x
    assert lost[1] == pytest.approx(lost[0], abs=1e-12 * run.mean_F_x)


@pytest.mark.parametrize("material", [ELASTIC, KELVIN], ids=["elastic", "Kelvin"])
@pytest.mark.parametrize("mu_0", [0.0, 0.4])
def test_energies_close_where_contact_is_kept(material, mu_0):
    """Of a rigid pull all is exact but the bend of the limit over a step, which work and heat both see."""
    case = replace(BALL, material=material, mu_0=mu_0)
    run = mdr.slide(case, 0.3 * case.unit_velocity, **KNOBS)
    assert run.energy_balance.friction_loss > 0
    assert abs(run.energy_balance.relative) < 1e-6


@pytest.mark.parametrize("shape", [SHAPES["flat"][0], mdr.TruncatedCone(b=5e-4, theta=0.02)], ids=["punch", "cone"])
@pytest.mark.parametrize("mu_0", [0.0, 0.3])
def test_a_contact_that_is_lost_holds_nothing(shape, mu_0):
    """Whatever its strength: it rests in one state, from any start."""
    lost = mdr.NormalOscillation(DEPTH, 1.3 * DEPTH, OMEGA)
    case = mdr.SlidingContact(shape, ELASTIC, mu_0, lost, tau_0=2e4)
    case = replace(case, shake=mdr.InPlaneOscillation(OMEGA, 0.3 * case.unit_length, 0.7))
    runs = [mdr.slide(case, 0.0, start=start, **KNOBS) for start in ("full_slip", "rest")]
    assert [(run.settled, run.kind, run.why) for run in runs] == [(True, "periodic", "")] * 2
    assert runs[0].cof == pytest.approx(runs[1].cof, abs=1e-9)


@pytest.mark.parametrize("mu_0", [0.3, 0.03])
def test_a_punch_slips_as_fast_as_coulombs_part_leaves_it(mu_0):
    """By v_0 less the greatest rate of its limit, Eq. (1), to which a constant adds nothing."""
    case = mdr.SlidingContact(SHAPES["flat"][0], ELASTIC, mu_0, MOTION, tau_0=5e4)
    v_c = mdr.critical_velocity(case)
    assert mdr.slide(case, 1.3 * v_c, **KNOBS).least_slip == pytest.approx(0.3 * v_c, rel=1e-9)


@pytest.mark.parametrize("material", [ELASTIC, KELVIN, ARMS], ids=["elastic", "Kelvin", "arms"])
def test_a_march_knows_where_full_slip_of_a_punch_ends(material):
    case = mdr.SlidingContact(SHAPES["flat"][0], material, 0.05, MOTION, tau_0=5e4)
    case = replace(case, pull=mdr.SpringPull(k_x=0.7 * case.k_xc, m=0.4 * case.k_xc / OMEGA**2))
    _, scaled = at_hand(case, resolution_of(case, 32, 1024))
    end = scaled.full_slip.end * scaled.units.speed
    # a parabola through the nodes of arms misses the greatest rate by h²/8 of its bend
    assert end == pytest.approx(mdr.full_slip_critical_velocity(case), rel=1e-5)


def test_what_no_step_sees_follows_from_the_velocity_of_the_top():
    """Not from that of the pull, 10, nor of the shake, 8: while the contact grows the top moves by 2 to 10."""
    case = replace(BALL, shake=mdr.InPlaneOscillation(OMEGA, 8 * UNIT / OMEGA, np.pi))
    fine = steady(case, 10 * UNIT, resolution_of(case, 512, 4096))
    coarse = steady(case, 10 * UNIT, resolution_of(case, 64, 128))
    # the law of a single edge, summed over the steps: of first order in the step, 5 % here
    assert coarse.stepper.unseen(coarse.orbit.state) == pytest.approx(1 - fine.cof, rel=0.1)


def limit_of(case):
    _, scaled = at_hand(case, resolution_of(case, 16, 32))
    return scaled, scaled.limit


def test_of_coulomb_friction_the_gap_tells_the_limit():
    scaled, limit = limit_of(replace(BALL, mu_0=0.3, tau_0=0.0, pull=mdr.SpringPull(k_x=BALL.k_xc, m=1e-3)))
    assert limit.gap_tells
    assert limit.order == 2
    assert np.array_equal(limit.force.area, scaled.normal.area)
    assert np.array_equal(limit.rate, scaled.drive.z_dot)
    assert not limit.hides_stick
    assert limit.unseen(np.ones(32), scaled.drive.z_dot[:-1]) == 0
    assert limit.beside(np.arange(3)) == {}
    press, gap = scaled.drive.z[1:], scaled.springs.gap
    assert np.array_equal(list(limit.borne(press)), np.maximum(press - gap[:, None], 0))


@pytest.mark.parametrize(("material", "hides"), [(ELASTIC, True), (KELVIN, False), (ARMS, True)])
def test_with_a_strength_each_spring_has_a_limit_of_its_own(material, hides):
    """That of all together is mu_0 F_z + tau_0 pi a²; of each, mu_0 and its force, and the strength on its chord."""
    case = replace(BALL, mu_0=0.3, material=material, pull=mdr.SpringPull(k_x=BALL.k_xc, m=1e-3))
    scaled, limit = limit_of(case)
    assert not limit.gap_tells
    assert limit.order == 1.5
    assert limit.force is None
    assert limit.hides_stick is hides
    share, force = scaled.springs.w, scaled.units.stiffness_x * scaled.units.length_x
    of_strength = limit.beside(np.arange(32))["strength"].mean(axis=0) @ share * force
    assert of_strength <= 1.01 * strong_force(case)  # the edge of what remembers comes back early
    if material is ELASTIC:  # nodes of 16 springs miss some of the disc at the edge
        assert of_strength == pytest.approx(strong_force(case), rel=1e-2)
        assert limit.mean * force == pytest.approx(case.mu_0 * mean_force(scaled) + strong_force(case), rel=1e-2)
        end = sum(w * of for w, of in zip(share, limit.borne(scaled.drive.z[1:]), strict=True))
        assert_allclose(end, limit.end, rtol=1e-9)


def mean_force(scaled):
    return scaled.normal.mean * scaled.units.stiffness_z * scaled.units.length_z


def strong_force(case):
    """tau_0 times the mean area of a paraboloid that keeps contact, pi R d."""
    return case.tau_0 * np.pi * case.indenter.R * case.oscillation.u_z0


@pytest.mark.parametrize("share", [1e-5, 0.02, 0.3])
def test_a_strength_is_borne_on_a_disc_that_no_spring_stands_in(share):
    """It is tau_0 pi b² in full slip, of the few springs within or of the innermost one."""
    law = Spot(0.3, 1e4, share * BALL.indenter.contact_radius(BALL.oscillation.u_z0))
    run = mdr.slide(replace(BALL, friction=law), 20 * UNIT, n_springs=16, steps_per_period=32, n_periods=2)
    borne = law.tau_0 * np.pi * law.b**2 / run.mean_F_z
    assert run.cof - 0.3 == pytest.approx(borne, rel=1e-5)  # as 16 springs know the mean load
