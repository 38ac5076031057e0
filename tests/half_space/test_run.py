"""mdr.half_space.slide and curve: friction with its errors against closed forms, and what they refuse and say."""

from dataclasses import replace

import numpy as np
import pytest
from conftest import Spot
from numpy.testing import assert_allclose, assert_array_equal

import mdr
from mdr.half_space import NotConverged, friction, run, slide
from mdr.half_space.friction import Settings, in_three_dimensions
from mdr.half_space.run import SETTLED
from mdr.normal.normal_force import full_cof, mean_area

BALL = mdr.SlidingContact(
    mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.3), 0.3, mdr.NormalOscillation(u_z0=20e-6, du_z=6e-6, omega=300.0)
)
OF_SPRINGS = replace(BALL, material=mdr.Elastic(E=3e6, nu=0.0))  # which springs know exactly, but for coupling
UNIT = BALL.unit_velocity
ALONG = replace(
    BALL, oscillation=mdr.ConstantDepth(20e-6), shake=mdr.InPlaneOscillation(omega=300.0, du_x=10e-6, phi_x=0.3)
)
ACROSS = replace(ALONG, shake=mdr.InPlaneOscillation(omega=300.0, du_y=6e-6))
FEW = {"cells": 9, "steps_per_period": 12}


@pytest.fixture(scope="module")
def found():
    return slide(ACROSS, 0.3 * UNIT, **FEW)


@pytest.mark.parametrize("v", [0.2, 0.6])
def test_a_shake_along_the_pull_has_the_friction_of_the_springs(v):
    """An incompressible body knows no coupling; slip across, which springs lack, is left out here."""
    case = replace(ALONG, material=mdr.Elastic(E=3e6, nu=0.5))
    settings = Settings(cells=27, steps=100, cycles=2, transverse=False)
    found = in_three_dimensions(case, v * UNIT, settings)
    assert abs(found.cof - mdr.cof_curve(case, [v * UNIT]).cof[0]) < 5e-4 * case.mu_0
    assert abs(found.cof_y) < 1e-9 * case.mu_0


KNOWN = {  # contacts that springs know in closed form, and velocities
    "normal": (OF_SPRINGS, 0.05),
    "along": (replace(ALONG, material=OF_SPRINGS.material), 0.6),
    "cone, along": (replace(ALONG, material=OF_SPRINGS.material, indenter=mdr.Cone(theta=0.05)), 0.6),
    "punch": (replace(OF_SPRINGS, indenter=mdr.FlatPunch(a=3e-4)), 0.05),
    "Kelvin, both": (replace(BALL, material=mdr.KelvinVoigt(E=3e6, nu=0.0, tau=2e-3), shake=ALONG.shake), 0.2),
}


@pytest.mark.parametrize(("case", "v"), KNOWN.values(), ids=KNOWN)
def test_the_error_bounds_what_contacts_in_closed_form_are_off_by(case, v):
    found = slide(case, v * case.unit_velocity, cells=17, steps_per_period=32, coupled=False)
    assert abs(found.cof - mdr.cof_curve(case, [found.v_0]).cof[0]) <= found.cof_error


def test_a_coarser_run_across_the_pull_is_off_by_less_than_its_error():
    """No closed form: against more steps and cells."""
    coarse = slide(ACROSS, 0.3 * UNIT, cells=9, steps_per_period=18)
    fine = in_three_dimensions(ACROSS, 0.3 * UNIT, Settings(cells=17, steps=48, cycles=3))
    assert abs(coarse.cof - fine.cof) < coarse.cof_error


def test_a_shake_across_the_pull_lowers_friction_and_drives_nothing(found):
    assert 0 < found.cof < 0.3
    assert abs(slide(ACROSS, 0, start="rest", n_periods=1, **FEW).cof) < 1e-6  # by symmetry


def test_shakes_along_the_pull_and_across_it_change_places():
    """Without a pull, from rest: the square grid is its own image."""
    shakes = ({"du_x": 9e-6, "phi_x": 0.4, "du_y": 3e-6}, {"du_y": 9e-6, "phi_y": 0.4, "du_x": 3e-6})
    cases = (replace(BALL, shake=mdr.InPlaneOscillation(omega=300.0, **shake)) for shake in shakes)
    along, across = (slide(case, 0.0, start="rest", n_periods=1, **FEW) for case in cases)
    assert abs(along.mean_F_x) > 1e-2 * along.mean_F_z
    scale = 1e-6 * along.mean_F_z  # to which the turns of pressure and friction are solved
    assert_allclose([along.mean_F_x, along.mean_F_y], [across.mean_F_y, across.mean_F_x], atol=scale)
    assert_allclose(along.q_x, across.q_y.swapaxes(1, 2), atol=1e-5 * along.pressure.max())


def test_a_fast_pull_slips_all_over_without_a_shake_across():
    found = slide(OF_SPRINGS, 3 * UNIT, coupled=False, **FEW)
    assert (found.kind, found.stick_share, found.settled) == ("full slip", 0.0, True)
    assert_allclose(found.cof, 0.3, rtol=1e-9)


@pytest.mark.parametrize(
    ("shape", "cells", "off"), [(BALL.indenter, 17, 6e-3), (mdr.FlatPunch(1e-3), 33, 1e-3)], ids=["ball", "punch"]
)
def test_a_shear_strength_acts_on_the_true_area(shape, cells, off):
    """Cells that touch a ball have 1.04 of the area; those of a punch are its own."""
    case = replace(OF_SPRINGS, tau_0=1e4, indenter=shape)
    found = in_three_dimensions(case, 50 * UNIT, Settings(cells=cells, steps=12, cycles=2, coupled=False))
    known = case.mu_0 * found.mean_F_z + case.tau_0 * mean_area(case)
    assert_allclose(found.mean_F_x, known, rtol=off)


@pytest.mark.parametrize("share", [0.3, 0.99, 2.0])
def test_a_strength_of_a_spot_acts_within_it_alone(share):
    """Beyond the contact it is that of the whole; the mean force is that of the springs' area."""
    face = replace(OF_SPRINGS, tau_0=1e4)
    a = float(face.indenter.contact_radius(face.u_z_max))
    case = replace(face, friction=Spot(face.mu_0, 1e4, share * a))
    settings = Settings(cells=33, steps=12, cycles=2, coupled=False)
    found = in_three_dimensions(case, 50 * UNIT, settings)
    assert_allclose(found.mean_F_x / found.mean_F_z, full_cof(case), rtol=4e-3)  # a cell is 6 % of the radius
    if share > 1:
        assert_allclose(found.mean_F_x, in_three_dimensions(face, 50 * UNIT, settings).mean_F_x, rtol=1e-12)
        assert_allclose(full_cof(case), full_cof(face), rtol=1e-12)


@pytest.mark.parametrize(
    ("case", "coupled"), [(BALL, True), (ACROSS, True), (ACROSS, False)], ids=["normal", "across", "uncoupled"]
)
def test_the_tolerance_of_a_step_is_fine_enough_for_the_slowest_pull(case, coupled, monkeypatch):
    """Halved, it changes the COF by less than the least error that is ever stated."""
    v_0, contact_of, found = 1e-3 * UNIT, friction.contact_of, []
    settings = Settings(cells=11, steps=16, cycles=4, coupled=coupled)
    for share in (1.0, 0.5):

        def tighter(*given, share=share):
            contact = contact_of(*given)
            return replace(contact, tolerance=share * contact.tolerance)

        monkeypatch.setattr(friction, "contact_of", tighter)
        found.append(in_three_dimensions(case, v_0, settings).cof)
    least = run._least(case, Settings(cells=101, steps=1000))
    assert abs(found[0] - found[1]) < 0.1 * sum(least)


# --- the record ---


def test_the_fields_of_the_last_period_have_its_forces(found):
    cell = (found.x[1] - found.x[0]) ** 2
    for field, mean in ((found.q_x, "mean_F_x"), (found.q_y, "mean_F_y"), (found.pressure, "mean_F_z")):
        assert field.shape == (12, 9, 9)
        assert_allclose(cell * field.sum(axis=(1, 2)).mean(), getattr(found, mean), atol=1e-12 * found.mean_F_z)
    assert_allclose(found.cof, found.mean_F_x / found.mean_F_z, rtol=1e-12)
    limit = found.mu_0 * found.pressure
    assert np.all(np.hypot(found.q_x, found.q_y) <= limit * (1 + 1e-9))
    assert_array_equal(found.stick, (found.pressure > 0) & (np.hypot(found.q_x, found.q_y) < limit * (1 - 1e-5)))
    assert 0 < found.stick_share < 1
    assert_allclose(found.t[-1], ACROSS.period)


def test_a_curve_is_made_of_runs(found, tmp_path):
    curve = mdr.half_space.curve(ACROSS, [0.3 * UNIT, -0.3 * UNIT, 0.9 * UNIT], n_periods=2, **FEW)
    assert curve.settled.shape == (3,)
    # the other way is the mirror image
    assert_allclose(curve.cof[:2], [found.cof, -found.cof], atol=curve.cycle_error[:2].max() + SETTLED)
    assert curve.cof[2] > curve.cof[0] > 0
    assert_allclose(curve.cof_error, curve.grid_error + curve.step_error + curve.cycle_error)
    curve.to_csv(tmp_path / "curve.csv")
    assert (tmp_path / "curve.csv").read_text().startswith("v_0 [m/s],cof [-],cof_y [-],cof_error [-]")
    assert "3 velocities" in str(curve)
    assert curve.plot().get_xlabel().startswith("pulling velocity")


def test_a_number_of_periods_is_kept_to():
    one = slide(ACROSS, 0.3 * UNIT, n_periods=1, **FEW)
    assert (one.n_periods, one.settled, one.cof_error) == (1, False, 0.6)  # 2 mu_0: nothing is known
    assert "raise n_periods" in one.why
    assert slide(ACROSS, 0.3 * UNIT, n_periods=2, **FEW).n_periods == 2


@pytest.mark.parametrize(("case", "start"), [(ACROSS, "full_slip"), (BALL, "rest")])
def test_a_pull_that_has_hardly_moved_has_not_settled_however_little_changes(case, start):
    found = slide(case, 1e-7 * UNIT, start=start, n_periods=4, **FEW)
    assert (found.settled, found.cof_error) == (False, 0.6)
    assert "still change" in found.why


def test_a_time_limit_ends_a_run_unsettled():
    found = slide(ACROSS, 0.3 * UNIT, limit_s=1e-9, **FEW)
    assert (found.settled, found.n_periods, found.kind) == (False, 1, "unsettled")
    assert "raise limit_s" in found.why
    assert_allclose(found.cof_error, 2 * 0.3)


# --- refusals ---


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"pull": mdr.SpringPull(k_x=1e4)}, r"takes a rigid pull, got pull = SpringPull.*ask mdr.slide"),
        (
            {"material": mdr.StandardLinearSolid(1e6, 1e6, 1e-3, 0.3)},
            "takes an elastic or Kelvin material, got material = Standard",
        ),
        (
            {"oscillation": mdr.LoadOscillation(0.03, 0.01, 300.0)},
            r"takes a depth that is known, got oscillation = Load.*mdr.resolved\(case\)",
        ),
    ],
)
def test_what_the_half_space_cannot_judge_is_refused_by_name(change, words):
    case = replace(BALL, **change)
    with pytest.raises(ValueError, match=words):
        slide(case, 1e-4)
    if "oscillation" not in change:
        with pytest.raises(ValueError, match=words):
            mdr.verdict(case, three_dimensions=True)


def test_a_load_is_resolved_first():
    case = mdr.resolved(replace(BALL, oscillation=mdr.LoadOscillation(0.03, 0.005, 300.0)))
    found = slide(case, 0.3 * UNIT, **FEW)
    assert_allclose(found.mean_F_z, 0.03, rtol=0.03)  # of springs, which leave out coupling and cells


def test_a_step_that_does_not_converge_has_its_own_error(monkeypatch):
    contact_of = friction.contact_of
    monkeypatch.setattr(friction, "contact_of", lambda *given: replace(contact_of(*given), turns=1))
    with pytest.raises(NotConverged, match="in 1 turns"):
        slide(BALL, 1e-4, **FEW)


def test_both_starts_end_alike(found):
    rest = slide(ACROSS, 0.3 * UNIT, start="rest", **FEW)
    assert_allclose(found.cof, rest.cof, atol=found.cycle_error + rest.cycle_error)
