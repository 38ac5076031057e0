"""Measurements in files: the body that was measured comes back. Units and faults are in test_instrument_files.py."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr

R = 5e-3
X = np.linspace(-200, 200, 41)  # um
HEIGHTS = 1e3 * X**2 / (2 * R * 1e6)  # nm


def table(*columns):
    return "\n".join(", ".join(f"{one!r}" for one in row) for row in zip(*[c.tolist() for c in columns], strict=True))


@pytest.fixture
def write(tmp_path):
    def file(text):
        path = tmp_path / "data.csv"
        path.write_text(text, encoding="utf-8")
        return path

    return file


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


def test_a_material_comes_back_from_its_moduli(write):
    body = mdr.StandardLinearSolid(1e6, 2e6, 1e-2, 0.5)
    f = np.geomspace(1, 1e3, 13)
    E = 0.75 * body.dynamic_modulus(2 * np.pi * f)
    moduli = mdr.read_moduli(write(f"f [Hz], E' [MPa], tan delta\n{table(f, E.real / 1e6, E.imag / E.real)}\n"))
    assert mdr.Prony.fit(*moduli, nu=0.5).misfit(*moduli) < 0.01


def test_a_body_comes_back_from_its_relaxation(write):
    body = mdr.StandardLinearSolid(1e6, 2e6, 0.1, 0.5)
    t = np.geomspace(1e-2, 10, 31)
    path = write(f"t [s], E [MPa]\n{table(t, 0.75e-6 * body.relaxation_modulus(t))}\n")
    found = mdr.Prony.fit_relaxation(*mdr.read_relaxation(path), nu=0.5)
    assert_allclose(found.relaxation_modulus(t), body.relaxation_modulus(t), rtol=1e-3)


def test_arguments_of_a_reader_are_checked(write):
    path = write(f"r [um], f [nm]\n{table(X, HEIGHTS)}\n")
    for wrong, error, words in [
        ({"units": {"h": "um"}}, ValueError, "units: h is no column; there are r, f"),
        ({"side": "top"}, ValueError, 'side must be "both", "left" or "right"'),
        ({"units": "um"}, TypeError, "units must be a dict from columns to words"),
        ({"apex": "x"}, TypeError, "apex"),
        ({"kinks": 3}, TypeError, "kinks"),
    ]:
        with pytest.raises(error, match=words):
            mdr.SampledProfile.read(path, **wrong)
    with pytest.raises(ValueError, match="touch must be a finite number"):
        mdr.FromForce.read(path, E_star=1e6, touch=np.nan)
