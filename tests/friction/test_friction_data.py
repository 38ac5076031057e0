"""Measured friction: read with its units, or refused with file and line."""

import numpy as np
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
