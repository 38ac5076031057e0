"""Measurements in files: units and spellings that are read, and what each typical fault is told."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr

R = 5e-3
X = np.linspace(-200, 200, 41)  # um
HEIGHTS = 1e3 * X**2 / (2 * R * 1e6)  # nm
D = np.linspace(1, 20, 20)  # um
FORCES = 1e3 * 4 / 3 * 4e6 * R**0.5 * (1e-6 * D) ** 1.5  # mN


def table(*columns):
    return "\n".join(", ".join(f"{one!r}" for one in row) for row in zip(*[c.tolist() for c in columns], strict=True))


@pytest.fixture
def write(tmp_path):
    def file(text):
        path = tmp_path / "data.csv"
        path.write_text(text, encoding="utf-8")
        return path

    return file


# --- profiles ---


@pytest.mark.parametrize(
    ("head", "arguments"),
    [
        ("r [um], f [nm]", {}),
        ("Radius (µm), Height (nm)", {}),
        ("x / um, z / nm", {}),
        ("x/um,z/nm", {}),
        ("# r [um], f [nm]", {}),  # as numpy.savetxt writes it
        ("r, f", {"units": {"r": "um", "f": "nm"}}),
        ("Weg [um], Hoehe [nm]", {"columns": {"r": "Weg", "f": "Hoehe"}}),
    ],
)
def test_a_scan_across_the_tip_is_a_profile(write, head, arguments):
    shape = mdr.SampledProfile.read(write(f"{head}\n{table(X, HEIGHTS)}\n"), **arguments)
    assert_allclose(shape.contact_radius(2e-6), np.sqrt(R * 2e-6), rtol=1e-9)
    assert shape.r[-1] == 200e-6


def test_sides_apex_and_a_tip_that_points_up(write):
    worn = np.where(X > 0, 2 * HEIGHTS, HEIGHTS)
    path = write(f"r [um], f [nm]\n{table(X + 30, 7 - worn)}\n")
    sides = {
        side: mdr.SampledProfile.read(path, apex=30e-6, side=side, flip=True) for side in ("left", "right", "both")
    }
    depth = 1e-6
    left, right, both = (sides[side].contact_radius(depth) for side in ("left", "right", "both"))
    assert_allclose([left, right, both], np.sqrt(depth * R * np.array([1, 1 / 2, 1 / 1.5])), rtol=1e-9)


def test_a_rough_profile_is_smoothed(write):
    x = np.linspace(-200, 200, 201)
    heights = 1e-3 * x**2 / (2 * R) + np.random.default_rng(1).normal(0, 20, x.size)  # nm
    path = write(f"r [um], f [nm]\n{table(x, heights)}\n")
    with pytest.raises(ValueError, match=r"data\.csv: .*smoothing="):
        mdr.SampledProfile.read(path)
    smooth = mdr.SampledProfile.read(path, smoothing=20e-9 / np.sqrt(2))  # the mean of two sides
    assert_allclose(smooth.contact_radius(2e-6), np.sqrt(R * 2e-6), rtol=0.02)


# --- force over depth ---


def test_moduli_at_several_temperatures_are_shifted_to_one(write):
    """A body that is known, as a rheometer sees it: three temperatures, two decades each, make one of four decades."""
    rubber, C_1, C_2 = mdr.Prony(2e6, [(3e6, 1e-3), (2e6, 1e-1)], 0.5), 8.86, 101.6
    rows = []
    for T in (0.0, 20.0, 60.0):
        for hertz in np.geomspace(0.1, 10, 9):
            at_20 = 2 * np.pi * hertz * 10 ** (-C_1 * (T - 20) / (C_2 + T - 20))
            E = 0.75 * complex(rubber.dynamic_modulus(at_20))
            rows.append(f"{hertz:.10g}, {T}, {E.real:.10g}, {E.imag:.10g}")
    path = write("f [Hz], T [degC], E' [Pa], E'' [Pa]\n" + "\n".join(rows) + "\n")
    omega, storage, loss = mdr.read_moduli(path, temperature=20, wlf=(C_1, C_2))
    assert omega[-1] / omega[0] > 1e4
    assert_allclose(storage + 1j * loss, 0.75 * rubber.dynamic_modulus(omega), rtol=1e-8)
    for given, words in (
        ({"wlf": (8.86, 101.6)}, "give temperature="),
        ({"temperature": 170, "wlf": (8, 100)}, "too far below"),
    ):
        with pytest.raises(ValueError, match=words):
            mdr.read_moduli(path, **given)


@pytest.mark.parametrize("touch", [None, 30e-6])
def test_force_over_depth_is_a_shape(write, touch):
    before = "" if touch is None else "10, 0\n20, 0\n30, 0\n"
    rows = table(D + (0 if touch is None else 30), FORCES)
    shape = mdr.FromForce.read(write(f"d [um], F [mN]\n{before}{rows}\n"), E_star=4e6, touch=touch, tip="round")
    assert_allclose(shape.contact_radius(10e-6), np.sqrt(R * 10e-6), rtol=1e-8)
    assert_allclose(shape.force(10e-6, 8e6), 2e-3 * FORCES[9], rtol=1e-8)


# --- dynamic moduli ---


@pytest.mark.parametrize(
    ("head", "rows", "nu"),
    [
        ("f [Hz], E' [MPa], E'' [MPa]", "1, 3, 0.3\n10, 4, 0.8", None),
        ("frequency (Hz), storage modulus (kPa), tan δ", "10, 4000, 0.2\n1, 3000, 0.1", None),
        ("omega [rad/s], E′ [N/mm²], tan(delta) [-]", "6.283185307179586, 3, 0.1\n62.83185307179586, 4, 0.2", None),
        ("f [kHz], G' [MPa], G'' [MPa]", "0.001, 1, 0.1\n0.01, 1.3333333333333333, 0.26666666666666666", 0.5),
        ("f [Hz], G' [MPa], tan delta", "1, 1, 0.1\n10, 1.3333333333333333, 0.2", 0.5),
    ],
)
def test_moduli_in_every_form_are_the_same(write, head, rows, nu):
    moduli = mdr.read_moduli(write(f"{head}\n{rows}\n"), nu=nu)
    assert_allclose(moduli.omega, 2 * np.pi * np.array([1, 10]), rtol=1e-14)
    assert_allclose(moduli.storage, [3e6, 4e6], rtol=1e-14)
    assert_allclose(moduli.loss, [3e5, 8e5], rtol=1e-14)


def test_a_material_comes_back_from_its_moduli(write):
    body = mdr.StandardLinearSolid(1e6, 2e6, 1e-2, 0.5)
    f = np.geomspace(1, 1e3, 13)
    E = 0.75 * body.dynamic_modulus(2 * np.pi * f)
    moduli = mdr.read_moduli(write(f"f [Hz], E' [MPa], tan delta\n{table(f, E.real / 1e6, E.imag / E.real)}\n"))
    assert mdr.Prony.fit(*moduli, nu=0.5).misfit(*moduli) < 0.01


# --- records ---


def test_a_motion_is_read_as_slide_record_takes_it(write):
    record = mdr.read_record(write("t [s], x [mm], displacement [um]\n0, 1, 2\n1, 2, 3\n"))
    assert {name: values.tolist() for name, values in record.items()} == {
        "t": [0, 1], "u_x": [1e-3, 2e-3], "u_z": [2e-6, 3e-6],
    }  # fmt: skip


# --- what is wrong ---

SCAN = table(np.arange(0, 60.0, 10), np.arange(0, 60.0, 10) ** 2)


def friction(path):
    return mdr.read_friction_data(path)


def profile(path):
    return mdr.SampledProfile.read(path)


def force(path):
    return mdr.FromForce.read(path, E_star=1e6)


FAULTS = [
    # numbers
    (friction, "v [m/s];mu\n1.5;0,1\n", "0,1 and 1.5 stand in one file: write one decimal mark"),
    (
        friction,
        "v [m/s], mu\n0,5, 0,31\n",
        "line 2: has 4 cells, the header 2; if a comma is the decimal mark, separate",
    ),
    (friction, "v [um/s];mu\n1,234;0.1\n", "write 1234 without a thousands separator or, if the comma is the decimal"),
    (
        friction,
        "v [um/s];mu\n1,234;2,345\n",
        "write 1234 without a thousands separator or, if the comma is the decimal",
    ),
    (friction, "v [m/s], mu\n0.5 mm/s, 0.1\n", "write 0.5 and the unit in the header (column v_0)"),
    (friction, "v [m/s], mu\n1, \n", "line 2: the cell is empty, leave the line out (column cof)"),
    (friction, "v [m/s], mu\n1, high\n", "line 2: high is no number"),
    (friction, 'v [m/s], mu\n1, "0.3\n2, 0.4\n3, high\n', "line 4: high is no number"),  # an open quote ends its line
    (friction, f"v [m/s], mu\n1, {'3' * 140_000}\n", "is no number (column cof)"),
    # headers
    (friction, "", "holds no table; a header such as v_0 [mm/s], cof, and a row a measurement"),
    (friction, "1, 0.3\n2, 0.4\n", "there is no header, which names no v_0 and no cof; write v_0 [mm/s], cof"),
    (friction, "v [m/s], mu [N]\n1, 0.3\n", "cof is a pure number, got the unit 'N'"),
    (friction, "v [m/s], y\n1, 0.3\n", "the header names no cof; write v_0 [mm/s], cof"),
    (friction, "v, mu\n1, 0.3\n", "v_0 needs a unit in its header, one of m/s, cm/s, mm/s, um/s"),
    (friction, "v [km/h], mu\n1, 0.3\n", "the unit 'km/h' of v_0 is none of m/s"),
    (friction, "v [m/s], v [mm/s], mu\n1, 1, 0.3\n", "the header names v_0 twice"),
    (mdr.read_moduli, "f [Hz], E' [mPa], E'' [mPa]\n1, 3, 0.3\n", "'mPa' of storage is none of Pa, kPa, MPa, GPa"),
    (mdr.read_moduli, "f [Hz], E' [MPa]\n1, 3\n", "neither E'' nor tan delta"),
    (mdr.read_moduli, "f [Hz], G' [MPa], G'' [MPa]\n1, 3, 0.3\n", "need Poisson's ratio, as E = 2 (1 + nu) G"),
    (
        mdr.read_record,
        "t [s], b [V]\n0, 1\n",
        "the header names a time, and nothing else by a name known here; write t [s], a [m/s²], or",
    ),
    # rows
    (mdr.read_moduli, "f [Hz], E' [MPa], E'' [MPa]\n1, 3, 1\n2, 3, -0.1\n", "line 3: loss must not be negative"),
    (profile, f"r [um], f [nm]\n{SCAN}\n10.0, 90\n", "lines 3 and 8 both have r = 1e-05 m; give one, or their mean"),
    (profile, f"r [um], f [nm]\n{SCAN[9:]}\n", "no point at the tip, r = 0 m; the nearest is at 1e-05 m"),
    (profile, "r [um], f [nm]\n" + SCAN.replace(", ", ", -"), "heights fall away from the tip; of a tip that was"),
    (force, f"d [um], F [mN]\n{SCAN}\n50.0, 2400\n", "line 8: d must ascend, got 5e-05 m after 5e-05 m"),
    (force, "d [um], F [mN]\n" + SCAN.replace(", ", ", -"), "compression must be positive, turn the sign of F"),
    (force, "d [um], F [mN]\n1001, 1\n1002, 2\n1003, 4\n1004, 7\n1005, 11\n1006, 16\n", "far from 0; give the depth"),
    (
        force,
        "d [um], F [mN]\n-10, 0\n0, 1\n10, 3\n",
        "m, above the surface; give the depth of the first touch",
    ),
    (force, f"d [um], F [mN]\n{SCAN}\n60, 2600\n", "F must rise more and more steeply"),
]


@pytest.mark.parametrize(("read", "text", "words"), FAULTS, ids=[words[:40] for _, _, words in FAULTS])
def test_what_is_wrong_is_told_with_what_to_write(write, read, text, words):
    with pytest.raises(ValueError, match=r"data\.csv: ") as caught:
        read(write(text))
    assert words in str(caught.value)
    for line in str(caught.value).splitlines():
        assert line.isprintable()
        assert len(line) < 500


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(ValueError, match="cannot be read"):
        friction(tmp_path / "none.csv")


def test_arguments_of_a_reader_are_checked(write):
    path = write(f"r [um], f\n{SCAN}\n")
    for arguments, words in [
        ({"units": {"h": "um"}}, "units: h is no column; there are r, f"),
        ({"units": {"f": "yard"}}, "units: f = 'yard' is none of m, cm"),
        ({"units": {"r": "mm", "f": "nm"}}, "gives r in um, units= in mm; give one"),
        ({"columns": {"f": "Z"}}, "the header names no Z; columns= must name one of these"),
        ({"side": "top"}, 'side must be "both", "left" or "right"'),
    ]:
        with pytest.raises(ValueError) as caught:  # noqa: PT011
            mdr.SampledProfile.read(path, **arguments)
        assert words in str(caught.value)
    for wrong in ({"apex": "x"}, {"kinks": 3}):
        with pytest.raises(TypeError, match=next(iter(wrong))):
            mdr.SampledProfile.read(write(f"r [um], f [nm]\n{SCAN}\n"), **wrong)
    with pytest.raises(ValueError, match="touch must be a finite number"):
        mdr.FromForce.read(path, E_star=1e6, touch=np.nan)
    with pytest.raises(TypeError, match="units must be a dict from columns to words"):
        mdr.SampledProfile.read(path, units="um")
