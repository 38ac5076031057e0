"""Records of motion: velocities, sensors in volts, names that may mean two quantities. Units and faults of tables in
general are in test_instrument_files.py.
"""

import warnings

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr

G = 9.80665
T = np.arange(8) * 1e-3
NEWLINE = "\n"
ROWS = "".join(f"{i}e-3,{i}\n" for i in range(8))
N = np.arange(8.0)


@pytest.fixture
def read(tmp_path):
    def record(text, **given):
        path = tmp_path / "data.csv"
        path.write_text(text, encoding="utf-8")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", mdr.PlausibilityWarning)
            return mdr.read_record(path, **given)

    return record


#: header, what is said of it, and the column that it is, in SI
FORMS = {
    "a velocity with its axis": ("t [s],Velocity z [mm/s]", {}, "v_z", 1e-3 * N),
    "a velocity as a vibrometer names it": (
        "Time [s],Vibration velocity [um/s]", {"columns": {"v_z": "Vibration velocity"}}, "v_z", 1e-6 * N),
    "by its letter and its unit": ("t [s],x [mm/s]", {}, "v_x", 1e-3 * N),
    "a velocity of another word": ("t [s],Time Signal [m/s]", {"columns": {"v_z": "Time Signal"}}, "v_z", N),
    "a length of another word": ("t [s],Time Signal [m]", {"columns": {"u_z": "Time Signal"}}, "u_z", N),
    "an accelerometer in mV": ("Time (s),Ch1 (mV)", {"sensitivity": "100 mV/g"}, "a_z", N * G / 100),
    "by its axis, in V": ("Time (s),a_x (V)", {"sensitivity": "10 mV/(m/s²)"}, "a_x", 100 * N),
    "of each a sensitivity": ("Time (s),Acc y (mV)", {"sensitivity": {"a_y": "50 mV/g"}}, "a_y", N * G / 50),
    "a vibrometer in volts": (
        "Time (s),Out (V)", {"sensitivity": "125 mm/s/V", "columns": {"v_z": "Out"}}, "v_z", 0.125 * N),
    "a distance sensor": ("Time (s),Ch 2 (V)", {"sensitivity": "2 um/V", "columns": {"u_z": 2}}, "u_z", 2e-6 * N),
    "a load cell": (
        "Time (s),Load (mV)", {"sensitivity": {"F_z": "-4 mV/N"}}, "F_z", -N / 4),
    "a voltage without a unit": (
        "Time (s),Ch1", {"sensitivity": "1 V/g", "columns": {"a_z": "Ch1"}, "units": {"a_z": "mV"}}, "a_z",
        1e-3 * G * N),
    "stroke of a tribometer": ("t [s],Displacement [um]", {"columns": {"u_x": "Displacement"}}, "u_x", 1e-6 * N),
    "the same, by what is beside": ("t [s],Displacement [um],Friction force [mN]", {}, "u_x", 1e-6 * N),
    "depth": ("t [s],Depth [um]", {}, "u_z", 1e-6 * N),
}  # fmt: skip


@pytest.mark.parametrize(("head", "given", "name", "values"), FORMS.values(), ids=FORMS)
def test_forms_that_owners_have(read, head, given, name, values):
    record = read(f"{head}\n{ROWS if head.count(',') == 1 else ROWS.replace(NEWLINE, ',1' + NEWLINE)}", **given)
    assert record.keys() == {"t", name}
    assert_allclose(record["t"], T, rtol=1e-12)
    assert_allclose(record[name], values, rtol=1e-12)


#: header, what is said of it, and words of the refusal
ASKED = [
    ("t [s],Displacement [um]", {}, 'may be u_x or u_z.* columns={"u_x": "Displacement"}; if it is u_z, columns='),
    ("t [s],Position [mm]", {}, "may be u_x or u_z"),
    ("t [s],z [um]", {}, 'may be u_z, or another quantity: if it is u_z, columns={"u_z": '),
    ("t [s],u [um]", {}, "may be u_x or u_z"),
    ("t [s],Height [nm]", {}, "may be u_z"),
    ("t [s],Piezo [nm]", {}, "may be u_z"),
    ("t [s],Stroke [mm]", {}, "may be u_x"),
    ("t [s],Velocity [mm/s]", {}, "may be v_x or v_z"),
    ("t [s],Time Signal [m/s]", {}, r"Time Signal \[m/s\] may be v_x, v_y, v_z"),
    ("t [s],Time Signal [m]", {}, r"Time Signal \[m\] may be u_x, u_y, u_z"),
    ("t [s],Ch1 [mV]", {}, r'is a voltage: say of which quantity, such as columns={"a_z": "Ch1"}, sensitivity="100'),
    ("t [s],a [g]", {"sensitivity": "100 mV/g"}, "'g' of a_z is none of V, mV"),
    ("t [s],x [um]", {"sensitivity": "100 mV/g"}, "sensitivity has no effect: the file has no a_x"),
    ("t [s],a_z [V]", {"sensitivity": {"a_z": "1 V/g", "a_x": "1 V/g"}}, "no effect: the file has no a_x in V"),
    ("t [s],a_z [V]", {"sensitivity": {"a_z": "125 mm/s/V"}}, "sensitivity: a_z is measured in m/s²"),
    ("t [s],a_z [V]", {"sensitivity": {"b": "1 V/g"}}, "sensitivity: b is measured in nothing here"),
    *(("t [s],a [V]", {"sensitivity": text}, "sensitivity must be as \"100 mV/g\"")
      for text in ("100", "mV/g", "100 pC/g", "0 mV/g", "1 g", "x mV/g", "")),
]  # fmt: skip


@pytest.mark.parametrize(("head", "given", "words"), ASKED, ids=[f"{head} {given}" for head, given, _ in ASKED])
def test_what_may_be_another_quantity_is_asked_and_what_has_no_effect_refused(read, head, given, words):
    with pytest.raises(ValueError, match=words):
        read(f"{head}\n{ROWS}", **given)


def test_a_velocity_and_a_voltage_make_the_motion_that_was_made(tmp_path):
    given = mdr.PeriodicMotion(2 * np.pi * 80.3, 20e-6, (2e-6, 0.0, 1e-7), (0.0, 4e-7))
    t = np.arange(4000) / 4000
    path = tmp_path / "data.csv"
    for head, values, said, make in (
        ("v_z [mm/s]", 1e3 * given.u_z_dot(t), {}, mdr.PeriodicMotion.from_velocity),
        ("a_z [mV]", 100 / G * given.u_z_ddot(t), {"sensitivity": "100 mV/g"}, mdr.PeriodicMotion.from_acceleration),
    ):
        np.savetxt(path, np.column_stack([t, values]), delimiter=",", header=f"t [s],{head}", comments="", fmt="%.12g")
        record = mdr.read_record(path, **said)
        found = make(record["t"], record[head[:3]], u_z0=20e-6)
        assert_allclose(found.u_z(t), given.u_z(t), rtol=0, atol=1e-12)


def test_a_size_that_is_hardly_meant_is_told_of_volts_too(tmp_path):
    path = tmp_path / "data.csv"
    path.write_text(f"t [s],a_z [V]\n{ROWS}")
    with pytest.warns(mdr.PlausibilityWarning, match="a_z is at most 70 Mm/s²|a_z is at most 7e"):
        mdr.read_record(path, sensitivity="0.0001 uV/(mm/s²)")


def test_a_sensitivity_is_a_text_or_a_dict_of_texts(read):
    with pytest.raises(TypeError, match='sensitivity must be a text, "100 mV/g", or a dict of such, got 100'):
        read(f"t [s],a [V]\n{ROWS}", sensitivity=100)
    with pytest.raises(ValueError, match='sensitivity must be as "100 mV/g"'):
        read(f"t [s],a [V]\n{ROWS}", sensitivity={"a_z": 100})
