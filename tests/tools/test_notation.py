"""Quantities as people write them: read into the unit of the library, refused in words, and shown as they are read."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from mdr.tools.notation import UNITS, numbers_in, parted, quotient, scale_of, shown, value_in

TURN = 2 * math.pi
READ = {
    "m": {
        "5": 5.0, "2 um": 2e-6, "2um": 2e-6, "2 µm": 2e-6, "2 μm": 2e-6, "2e-6": 2e-6, "2e-6m": 2e-6, "1e3 nm": 1e-6,
        "0.3 cm": 3e-3, ".5 mm": 5e-4, "5. mm": 5e-3, "+4 mm": 4e-3, "-4 mm": -4e-3, "−4 mm": -4e-3, " 7 mm ": 7e-3,
        "1E-3 m": 1e-3, "100 um": 1e-4, "3 Å": 3e-10, "2 inch": 0.0508,
    },
    "m/s²": {"2 m/s²": 2.0, "2 g": 19.6133},
    "1/s": {"2 1/s": 2.0, "2 s^-1": 2.0, "2 1/ms": 2e3, "2 1/us": 2e6, "6 1/min": 0.1},
    "1/Pa": {"2 1/Pa": 2.0, "2 1/kPa": 2e-3, "2 1/MPa": 2e-6, "2 1/GPa": 2e-9},
    "K": {"5 K": 5.0, "5 degC": 278.15, "5 °C": 278.15, "5 C": 278.15},
    "m/s": {"10 mm/s": 0.01, "10mm/s": 0.01, "0.01": 0.01, "6 mm/min": 1e-4, "3 um/s": 3e-6, "1 m/s": 1.0,
            "-2 cm/s": -0.02},
    "rad/s": {"50 Hz": 50 * TURN, "50Hz": 50 * TURN, "20 kHz": 2e4 * TURN, "314.159": 314.159, "3 rad/s": 3.0,
              "5 mHz": 5e-3 * TURN, "2 MHz": 2e6 * TURN, "3000 rpm": 50 * TURN},
    "Hz": {"50": 50.0, "50 Hz": 50.0, "3000 rpm": 50.0, "0.05 kHz": 50.0, "314 rad/s": 314 / TURN},
    "Pa": {"3 MPa": 3e6, "3e6": 3e6, "3e6 Pa": 3e6, "2.5GPa": 2.5e9, "10 kPa": 1e4, "2 N/mm²": 2e6, "2 N/mm^2": 2e6,
           "5 bar": 5e5, "400 psi": 400 * 0.45359237 * 9.80665 / 0.0254**2},
    "W": {"3 W": 3.0, "20 mW": 0.02, "2 kW": 2e3},
    "N": {"5 N": 5.0, "5mN": 5e-3, "0.1 kN": 100.0},
    "rad": {"45 deg": math.pi / 4, "45°": math.pi / 4, "0.1": 0.1, "0.1 rad": 0.1},
    "deg": {"1.5": 1.5, "1.5 deg": 1.5, "2°": 2.0, "1 rad": 360 / TURN},
    "kg": {"100 g": 0.1, "0.1": 0.1, "2 kg": 2.0},
    "N/m": {"20 kN/m": 2e4, "20 N/mm": 2e4, "3 N/um": 3e6, "2 N/m": 2.0},
    "N s/m": {"4 Ns/m": 4.0, "4 N s/m": 4.0, "4 N·s/m": 4.0, "4 N s/mm": 4e3},
    "s": {"3 s": 3.0, "1 ms": 1e-3, "20us": 2e-5, "2 min": 120.0, "0.5 hours": 1800.0, "3 h": 10800.0},
    "1/m": {"3 1/m": 3.0, "2 1/mm": 2e3},
    "N m": {"3 N m": 3.0, "2 mN·m": 2e-3, "2 uN.m": 2e-6, "4 Nm": 4.0, "5 N mm": 5e-3},
    "V": {"3 V": 3.0, "2 mV": 2e-3},
    "Pa s": {"3 Pa s": 3.0, "2 mPa-s": 2e-3, "3 Pa·s": 3.0},
    "-": {"10%": 0.1, "10 %": 0.1, "0.1": 0.1},
    "m^(1-n)": {"3": 3.0},
}  # fmt: skip
REFUSED = {
    "Pa": {
        "3 mm": "E wants Pa (or kPa, MPa, GPa, N/mm2, bar, psi), got '3 mm'", "5 N": "wants Pa", "3 mpa": "wants Pa",
        "3 MPa m": "wants Pa", "MPa": "wants Pa", "": "wants Pa", "soft": "wants Pa", "nan": "wants Pa",
        "inf Pa": "wants Pa", "1e999 Pa": "E: 1e999 is no number", "2,5 MPa": "E: 2,5 is no number, write 2.5 with",
        "1,000 Pa": "write 1000 without a thousands", "1.000,5 Pa": "write 1000.5", "3 MPa 4": "wants Pa",
        "3*2 MPa": "3*2 is no number", "1/3 MPa": "1/3 is no number", "3 4 MPa": "3 4 is no number", "10%": "wants Pa",
        "0x10 Pa": "wants Pa", "1_000 Pa": "1_000 is no number", "--3 MPa": "--3 is no number",
    },
    "m": {"3 m/s": "wants m (or cm", "5 km": "wants m", "3 um2": "wants m", "50 Hz": "wants m", "5 s": "wants m"},
    "m/s": {"5 m": "wants m/s", "5 mm": "wants m/s", "5 km/h": "wants m/s", "0.5 v_c": "wants m/s"},
    "rad/s": {"50 hz": "wants rad/s (or Hz, mHz, kHz, MHz, rpm)", "3 rad": "wants rad/s", "20 ms": "wants rad/s"},
    "rad": {"45 degrees": "wants rad (or mrad, deg, °)"},
    "-": {"0.5 N": "wants a pure number, such as 0.1 or 10%", "10%%": "wants a pure number", "half": "wants a pure"},
    "N": {"3 kg": "wants N", "5 Nm": "wants N"},
    "m^(1-n)": {"3 mm": "wants m^(1-n), got '3 mm'"},
    "": {"3 mm": "wants a number without a unit"},
}  # fmt: skip


def pairs(of):
    return [(unit, text, known) for unit, texts in of.items() for text, known in texts.items()]


@pytest.mark.parametrize(("unit", "text", "value"), pairs(READ))
def test_a_quantity_is_read_in_the_unit_of_the_library(unit, text, value):
    assert_allclose(value_in("E", text, unit), value, rtol=3e-16)


def test_every_symbol_is_pinned():
    """But for prefixes, whose powers others share; the marks of a pure number are no symbols."""
    for unit, symbols in UNITS.items():
        own = {one for one in symbols if one not in {f"{prefix}{base}" for prefix in "pnµmckMG" for base in symbols}}
        known = {parted(text)[1] for text in READ.get(unit, {})}
        assert {scale_of(one, unit) for one in own - {"-", "1", ""}} <= {scale_of(one, unit) for one in known}, unit


@pytest.mark.parametrize(("unit", "text", "words"), pairs(REFUSED))
def test_another_quantity_is_refused_in_words(unit, text, words):
    with pytest.raises(ValueError, match=r"^E") as refused:
        value_in("E", text, unit)
    assert words in str(refused.value)


def test_a_prefix_divides_where_that_is_exact():
    assert value_in("R", "0.3 mm", "m") == 0.3 / 1000
    assert value_in("R", "100 um", "m") == 100e-6


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [(2e-6, "m", "2 µm"), (3e6, "Pa", "3 MPa"), (50 * TURN, "rad/s", "50 Hz"), (0.1, "kg", "100 g"), (0.0, "m", "0 m"),
     (math.pi / 4, "rad", "45 deg"), (0.5, "-", "0.5"), (0.0021, "m/s", "2.1 mm/s"), (-2e-6, "m", "-2 µm"),
     (1e-12, "m", "0.001 nm"), (5e12, "Pa", "5000 GPa"), (1e-3, "m", "1 mm"), (7.0, "m^(1-n)", "7 m^(1-n)")],
)  # fmt: skip
def test_a_value_is_shown_with_the_prefix_that_reads_best(value, unit, text):
    assert shown(value, unit) == text


def test_what_is_shown_is_read_again():
    rng = np.random.default_rng(1)
    for unit in UNITS:
        for value in rng.choice([-1, 1], 50) * 10 ** rng.uniform(-12, 12, 50):
            assert_allclose(value_in("x", shown(value, unit, 15), unit), value, rtol=1e-13)


def test_the_unit_of_a_quotient():
    found = {
        ("-", "m"): "1/m",
        ("m/s", "Pa"): "m/(s Pa)",
        ("-", "m/s"): "s/m",
        ("m/s", "m/s"): "-",
        ("m/s", "m"): "1/s",
        ("-", "N s/m"): "m/(N s)",
        ("-", "-"): "-",
        ("m/(s Pa)", "m"): "1/(s Pa)",
        ("", "m"): "",
        ("m", ""): "",
    }
    assert {units: quotient(*units) for units in found} == found


def test_lists_hold_quantities_and_words_stay():
    assert numbers_in("cos", ["2 um", 1e-6, ["1 mm"]], "m") == [2e-6, 1e-6, [1e-3]]
    assert numbers_in("arms", [["3 MPa", "2 ms"], [1e6, "1 s"]], "Pa, s") == [[3e6, 2e-3], [1e6, 1.0]]
    assert numbers_in("at", "tool", "") == "tool"
    with pytest.raises(ValueError, match=r"^cos\[1\] wants m"):
        numbers_in("cos", [1e-6, "2 s"], "m")
