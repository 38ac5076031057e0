"""Quantities: those of the catalogue are what the functions of the library return; one's own are checked."""

import pickle
from dataclasses import replace
from operator import attrgetter

import numpy as np
import pytest
from grids import BODY, COARSE, RIGID, depth
from numpy.testing import assert_array_equal
from scipy.io import netcdf_file

import mdr
from mdr.friction.cof_curve import cof_at
from mdr.friction.measured_velocity import MeasuredVelocity
from mdr.given.vary import case_at
from mdr.normal.normal_force import mean_normal_force
from mdr.studies.quantities import CATALOGUE, CurveQuantity, Quantity
from mdr.tools.status import Status

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


AMPLITUDE, VELOCITY, MODULUS = "d cof/d oscillation.du_z", "d cof/d v_0", "d v_c/d material.E"


def test_derivatives_are_those_of_sensitivity_each_in_its_unit():
    v_0, masses = [1e-4, 2e-4], [0.1, 0.2]
    axes = {"v_0": [0.0, *v_0], "pull.m": masses}
    study = mdr.sweep(BODY, axes, quantities=["d static_cof/d mu_0", AMPLITUDE, VELOCITY, MODULUS])
    names = ("d static_cof/d mu_0", AMPLITUDE, VELOCITY, MODULUS)
    assert [study.units[name] for name in names] == ["-", "1/m", "s/m", "m/(s Pa)"]
    for j, m in enumerate(masses):
        case = replace(BODY, pull=replace(BODY.pull, m=m))
        for i, v in enumerate(v_0, 1):
            found = mdr.sensitivity(case, v)
            known = (
                found.d_static_cof["mu_0"],
                *map(found.d_cof.get, ("oscillation.du_z", "v_0")),
                found.d_v_c["material.E"],
            )
            assert [study[name][i, j] for name in names] == pytest.approx(known, rel=1e-9)
    assert np.isnan(study[VELOCITY][0]).all()
    assert np.isfinite(study[AMPLITUDE][0]).all()
    assert study.status[0].tolist() == [Status.FAILED] * 2
    assert (
        study.why[0, 0]
        == "d cof/d v_0: v_0 = 0 m/s is the limit of a pull forward, which may be another than that of a pull back"
    )


@pytest.mark.parametrize("axes", [{}, {"load": [0.01]}])
def test_what_is_held_stays_while_an_input_of_a_derivative_varies(axes):
    held = {"load": 0.01, "hold": "depth", "tan_delta": 0.2}
    study = mdr.sweep(RIGID, {"v_0": [1e-4], **axes}, quantities=["d cof/d material.E"], held=held)
    found = mdr.sensitivity(case_at(RIGID, held), 1e-4, ["material.E"], held=held)
    assert found.d_cof["material.E"] != pytest.approx(mdr.sensitivity(RIGID, 1e-4).d_cof["material.E"])
    assert study["d cof/d material.E"].ravel() == pytest.approx([found.d_cof["material.E"]], rel=1e-9)


def test_a_derivative_keeps_its_name_in_files(tmp_path):
    study = mdr.sweep(
        RIGID, {"alpha": [0.1, 0.3], "v_0/v_c": [0.5]}, tmp_path / "store", quantities=[AMPLITUDE, MODULUS]
    )
    study.to_netcdf(tmp_path / "study.nc")
    assert mdr.read_study(tmp_path / "study.nc") == mdr.read_study(tmp_path / "store") == study
    assert study.table().startswith(f"alpha [-],v_0/v_c [-],{AMPLITUDE} [1/m],{MODULUS} [m/(s Pa)],status")
    assert study.plot_map(AMPLITUDE).figure.axes[1].get_ylabel() == f"{AMPLITUDE} [1/m]"
    with netcdf_file(tmp_path / "study.nc", mmap=False) as file:
        assert {"d_cof_over_d_oscillation.du_z", "d_v_c_over_d_material.E"} < set(file.variables)
