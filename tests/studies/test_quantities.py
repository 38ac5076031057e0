"""Quantities: those of the catalogue are what the functions of the library return; one's own are checked."""

import pickle

import numpy as np
import pytest
from grids import BODY, COARSE, RIGID, depth
from numpy.testing import assert_array_equal

import mdr
from mdr.closed_forms.full_slip import mean_normal_force
from mdr.studies.quantities import CATALOGUE, CurveQuantity, Quantity, read_quantities

OF_CASE = {
    "v_c": mdr.critical_velocity,
    "full_slip_v_c": mdr.full_slip_critical_velocity,
    "static_cof": mdr.static_cof,
    "measured_v_c": lambda case: mdr.measure_critical_velocity(case).v_c,
    "k_zc": lambda case: case.k_zc,
    "k_xc": lambda case: case.k_xc,
    "alpha": lambda case: case.alpha,
    "T": lambda case: case.T,
    "mean_F_N": mean_normal_force,
}
OF_CURVE = {
    "cof": lambda case, curve: curve.cof,
    "cof_error": lambda case, curve: curve.cof_error,
    "stick_share": lambda case, curve: curve.stick_share,
    "settled": lambda case, curve: curve.settled,
    "mean_F_x": lambda case, curve: curve.cof * mean_normal_force(case),
    "mean_F_z": lambda case, curve: np.full(curve.v_0.shape, mean_normal_force(case)),
}


def test_the_catalogue_is_tested_whole():
    assert set(CATALOGUE) == {*OF_CASE, *OF_CURVE}
    for name, one in CATALOGUE.items():
        assert one.name == name
        assert one.unit
        assert one.meaning
        assert one.per_velocity == isinstance(one, CurveQuantity) == (name in OF_CURVE)
        assert pickle.loads(pickle.dumps(one)) == one


@pytest.mark.parametrize("name", OF_CASE)
def test_quantities_of_a_case(name):
    case = RIGID if name == "measured_v_c" else BODY
    assert CATALOGUE[name].of(case) == OF_CASE[name](case)


@pytest.mark.parametrize("name", OF_CURVE)
def test_quantities_of_a_curve(name):
    curve = mdr.cof_curve(RIGID, [0.0, 1e-4, 1e-3])
    assert_array_equal(CATALOGUE[name].of(RIGID, curve), OF_CURVE[name](RIGID, curve))


def test_mean_forces_are_those_of_a_run():
    """To the error of its springs and steps: 1e-5 of mu_0 by default."""
    v_0 = 0.5 * mdr.critical_velocity(BODY)
    run, curve = mdr.slide(BODY, v_0), mdr.cof_curve(BODY, [v_0])
    for name in ("mean_F_x", "mean_F_z"):
        assert CATALOGUE[name].of(BODY, curve)[0] == pytest.approx(getattr(run, name), rel=1e-5)


def test_no_critical_velocity_is_a_reason(monkeypatch):
    nothing = mdr.MeasuredVelocity(None, None, None, "none", "friction stays reduced")
    monkeypatch.setattr("mdr.studies.quantities.measure_critical_velocity", lambda case: nothing)
    with pytest.raises(ValueError, match="there is none: friction stays reduced"):
        CATALOGUE["measured_v_c"].of(BODY)


@pytest.mark.parametrize(
    ("quantities", "paths", "kind", "words"),
    [
        (["coef"], ["v_0"], ValueError, "coef is no quantity of the catalogue; did you mean cof?"),
        (["zzz"], ["v_0"], ValueError, "there are v_c, full_slip_v_c"),
        (["cof"], ["mu_0"], ValueError, 'cof needs a velocity: give an axis "v_0" [m/s] or "v_0/v_c"'),
        ([Quantity("own", "-", depth, per_velocity=True)], ["mu_0"], ValueError, "own needs a velocity"),
        (["v_c", "v_c"], ["mu_0"], ValueError, "quantities has v_c twice"),
        (["T"], ["T"], ValueError, "T is an axis of the study already"),
        ([], ["mu_0"], ValueError, "quantities must name at least one"),
        ("v_c", ["mu_0"], TypeError, "quantities must be a list of names, got 'v_c'"),
        ([3], ["mu_0"], TypeError, "quantities must be names or Quantity records, got 3"),
        ([mdr.critical_velocity], ["mu_0"], TypeError, "quantities must be names or Quantity records"),
        ([Quantity("v_c", "m/s", depth)], ["mu_0"], ValueError, "v_c is the name of another quantity"),
    ],
)
def test_what_cannot_be_computed_is_refused(quantities, paths, kind, words):
    with pytest.raises(kind) as caught:
        read_quantities(quantities, paths)
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ("make", "kind", "words"),
    [
        (lambda: Quantity("a b", "-", depth), ValueError, "name must be of letters"),
        (lambda: Quantity("v_0/v_c", "-", depth), ValueError, "name must be of letters"),
        (lambda: Quantity("status", "-", depth), ValueError, "name must be of letters"),
        (lambda: Quantity("", "-", depth), ValueError, "name must be of letters"),
        (lambda: Quantity(3, "-", depth), TypeError, "name must be a string"),
        (lambda: Quantity("depth", None, depth), TypeError, "unit must be a string"),
        (lambda: Quantity("depth", "m", 3.0), TypeError, "of must be a function"),
        (lambda: Quantity("depth", "m", depth, per_velocity="no"), TypeError, "per_velocity must be True or False"),
    ],
)
def test_a_quantity_is_checked(make, kind, words):
    with pytest.raises(kind, match=words):
        make()


def test_a_quantity_of_one_s_own():
    def slip(case, v_0):
        return v_0 / case.unit_velocity

    own = [Quantity("depth", "m", depth, "mean depth"), Quantity("slip", "-", slip, per_velocity=True)]
    axes = {"v_0": [0.0, 1e-4], "oscillation.u_z0": [5e-6, 6e-6]}
    study = mdr.sweep(BODY, axes, quantities=[*own, CATALOGUE["v_c"]], **COARSE)
    assert_array_equal(study["depth"], [[5e-6, 6e-6]] * 2)
    assert_array_equal(study["slip"], [[0.0] * 2, [1e-4 / BODY.unit_velocity] * 2])
    assert study.units["depth"] == "m"
