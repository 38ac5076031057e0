"""Measured friction: read with its units, or refused with file and line."""

import numpy as np
import pytest
from conftest import contact
from numpy.testing import assert_allclose

import mdr


def test_columns_in_any_order_with_units_and_comments(tmp_path):
    text = "# rubber on steel\nerror;note;COF [-];v_0 [mm/s]\n0.02;b;0.35;2.0\n\n0.01;a;0.31;0.5\n"
    (tmp_path / "data.csv").write_text(text, encoding="utf-8")
    data = mdr.read_friction_data(tmp_path / "data.csv")
    assert_allclose(data.v_0, [0.5e-3, 2e-3], rtol=1e-15)
    assert_allclose(data.cof, [0.31, 0.35])
    assert_allclose(data.error, [0.01, 0.02])


def test_what_a_curve_writes_is_read(tmp_path):
    curve = mdr.cof_curve(contact("cone"), [1e-4, 2e-4, 3e-4])
    curve.to_csv(tmp_path / "curve.csv")
    data = mdr.read_friction_data(tmp_path / "curve.csv")
    assert_allclose(data.cof, curve.cof, rtol=1e-15)
    head, *rows = (tmp_path / "curve.csv").read_text(encoding="utf-8").splitlines()
    assert head == "v_0 [m/s],cof [-],cof_error [-],settled,stick_share [-]"
    columns = [curve.v_0, curve.cof, curve.cof_error, curve.settled, curve.stick_share]
    assert np.array_equal([[float(cell) for cell in row.split(",")] for row in rows], np.transpose(columns))


def test_forces_stand_for_their_ratio(tmp_path):
    (tmp_path / "data.csv").write_text("v [mm/s],Ft [mN],Fn [N]\n0.1,1000,5\n0.5,1500,5\n")
    with pytest.warns(mdr.PlausibilityWarning, match=r"cof = F_t/F_n is taken; the mean load is 5 N"):
        data = mdr.read_friction_data(tmp_path / "data.csv")
    assert_allclose(data.cof, [0.2, 0.3])


@pytest.mark.parametrize(("head", "over", "scale"), [
    ("du_x [um]", "du_x", 1e-6), ("shake.du_y / nm", "du_y", 1e-9), ("oscillation.du_z (mm)", "du_z", 1e-3),
    ("load [mN]", "load", 1e-3), ("f [kHz]", "frequency", 1e3),
])  # fmt: skip
def test_friction_over_another_number_of_the_case(tmp_path, head, over, scale):
    (tmp_path / "data.csv").write_text(f"COF;{head}\n0.2;2\n0.3;1\n")
    with pytest.raises(ValueError, match="or give v_0=, of friction over another column"):
        mdr.read_friction_data(tmp_path / "data.csv")
    data = mdr.read_friction_data(tmp_path / "data.csv", v_0=1e-3)
    assert data.over == over
    assert_allclose([data.values, data.cof, data.v_0], [[scale, 2 * scale], [0.3, 0.2], [1e-3, 1e-3]], rtol=1e-12)


def test_a_turning_speed_needs_the_radius_of_the_track(tmp_path):
    (tmp_path / "data.csv").write_text("Speed [rpm],Friction coefficient\n1,0.32\n10,0.43\n")
    with pytest.raises(ValueError, match="a speed of rotation, times the radius of the track, radius= of"):
        mdr.read_friction_data(tmp_path / "data.csv")
    data = mdr.read_friction_data(tmp_path / "data.csv", radius=12e-3)
    assert_allclose(data.v_0, 12e-3 * 2 * np.pi / 60 * np.array([1, 10]))
    (tmp_path / "torque.csv").write_text("v [rad/s],torque [N m]\n1,0.32\n10,0.43\n")
    with pytest.raises(ValueError, match="names no"):
        mdr.read_friction_data(tmp_path / "torque.csv")
