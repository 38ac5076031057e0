"""Quantities: those of the catalogue are what the functions of the library return; one's own are checked."""

import pickle
from operator import attrgetter

import numpy as np
import pytest
from grids import BODY, COARSE, RIGID, depth
from numpy.testing import assert_array_equal

import mdr
from mdr.friction.cof_curve import cof_at
from mdr.friction.measured_velocity import MeasuredVelocity
from mdr.normal.normal_force import mean_normal_force
from mdr.studies.quantities import CATALOGUE, CurveQuantity, Quantity

OF_CASE = {
    "v_c": mdr.critical_velocity,
    "full_slip_v_c": mdr.full_slip_critical_velocity,
    "static_cof": mdr.static_cof,
    "mean_F_N": mean_normal_force,
    **{name: attrgetter(name) for name in ("k_zc", "k_xc", "alpha", "T")},
}
OF_CURVE = {
    **{name: attrgetter(name) for name in ("cof", "share", "cof_error", "stick_share", "settled")},
    "cof_y": lambda curve: np.zeros(3),  # nothing moves across
    "mean_F_x": lambda curve: curve.cof * mean_normal_force(RIGID),
    "mean_F_z": lambda curve: np.full(3, mean_normal_force(RIGID)),
}


def test_the_catalogue_is_what_the_functions_return():
    v_0 = [0.0, 1e-4, 1e-3]
    columns, curve = cof_at(RIGID, v_0), mdr.cof_curve(RIGID, v_0)
    assert CATALOGUE["measured_v_c"].of(RIGID) == mdr.measure_critical_velocity(RIGID).v_c
    assert CATALOGUE["least_velocity"].of(BODY, 1e-3) == mdr.least_velocity(BODY, 1e-3)
    assert set(CATALOGUE) == {"measured_v_c", "least_velocity", *OF_CASE, *OF_CURVE}
    for name, one in CATALOGUE.items():
        assert one.name == name
        assert one.unit
        assert one.meaning
        assert isinstance(one, CurveQuantity) == (name in OF_CURVE)
        assert one.per_velocity == (name in OF_CURVE or name == "least_velocity")
        assert pickle.loads(pickle.dumps(one)) == one
        if name in OF_CASE:
            assert one.of(BODY) == OF_CASE[name](BODY)
        elif name in OF_CURVE:
            assert_array_equal(one.of(RIGID, columns), OF_CURVE[name](curve))


def test_mean_forces_are_those_of_a_run():
    """To the error of its springs and steps: 1e-5 of mu_0 by default."""
    v_0 = 0.5 * mdr.critical_velocity(BODY)
    run, columns = mdr.slide(BODY, v_0), cof_at(BODY, [v_0])
    for name in ("mean_F_x", "mean_F_z"):
        assert CATALOGUE[name].of(BODY, columns)[0] == pytest.approx(getattr(run, name), rel=1e-5)


def test_no_critical_velocity_is_a_reason(monkeypatch):
    nothing = MeasuredVelocity(None, None, None, "none", "friction stays reduced")
    monkeypatch.setattr("mdr.studies.quantities.measure_critical_velocity", lambda case: nothing)
    with pytest.raises(ValueError, match="there is none: friction stays reduced"):
        CATALOGUE["measured_v_c"].of(BODY)


def test_a_quantity_of_one_s_own():
    def slip(case, v_0):
        return v_0 / case.unit_velocity

    own = [Quantity("depth", "m", depth, "mean depth"), Quantity("slip", "-", slip, per_velocity=True)]
    axes = {"v_0": [0.0, 1e-4], "oscillation.u_z0": [5e-6, 6e-6]}
    study = mdr.sweep(BODY, axes, quantities=[*own, CATALOGUE["v_c"]], **COARSE)
    assert_array_equal(study["depth"], [[5e-6, 6e-6]] * 2)
    assert_array_equal(study["slip"], [[0.0] * 2, [1e-4 / BODY.unit_velocity] * 2])
    assert study.units["depth"] == "m"
