"""Relaxation and creep in files, in tension and in shear."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr

T = [0.1, 1.0, 10.0]


@pytest.fixture
def write(tmp_path):
    def file(text):
        path = tmp_path / "data.csv"
        path.write_text(text, encoding="utf-8")
        return path

    return file


@pytest.mark.parametrize(
    ("text", "nu"),
    [
        ("t [s], E [MPa]\n0.1, 3\n1, 2\n10, 1.5\n", None),
        ("Probe 3\nTime;E(t)\nms;kPa\n100,0;3000,0\n1000,0;2000,0\n10000,0;1500,0\n", None),
        ("Step time (s)\tG(t) (Pa)\tTorque (mN·m)\n0.1\t1e6\t1\n1\t666666.6666666666\t1\n10\t5e5\t1\n", 0.5),
    ],
)
def test_a_relaxation_is_read(write, text, nu):
    found = mdr.read_relaxation(write(text), nu=nu)
    assert_allclose(found.t, T, rtol=1e-14)
    assert_allclose(found.modulus, [3e6, 2e6, 1.5e6], rtol=1e-14)


@pytest.mark.parametrize(
    ("text", "nu"),
    [
        ("t [s], D [1/MPa]\n0.1, 1\n1, 1.5\n10, 2\n", None),
        ("time, J\ns, MPa^-1\n0.1, 3\n1, 4.5\n10, 6\n", 0.5),
    ],
)
def test_a_creep_is_read(write, text, nu):
    found = mdr.read_creep(write(text), nu=nu)
    assert_allclose(found.t, T, rtol=1e-14)
    assert_allclose(found.compliance, [1e-6, 1.5e-6, 2e-6], rtol=1e-14)


@pytest.mark.parametrize(
    ("read", "text", "words"),
    [
        (mdr.read_creep, "t [s], J [1/MPa]\n1, 1\n", "of shear and needs Poisson's ratio: give nu=; if it is one in"),
        (mdr.read_relaxation, "t [s], Er [MPa]\n1, 1\n", 'columns={"E": "Er"}'),
        (mdr.read_relaxation, "t [s], E [MPa], G [MPa]\n1, 1, 1\n", 'leave one out, columns={"G": ""}'),
        (mdr.read_relaxation, "t [s], E [MPa]\n1, 0\n", "line 2: E must be positive"),
        (mdr.read_creep, "t [s], D [1/MPa]\n-1, 2\n", "t counts from the step"),
    ],
)
def test_what_is_wrong_is_told(write, read, text, words):
    with pytest.raises(ValueError, match=r"data\.csv") as refused:
        read(write(text))
    assert words in str(refused.value)


def test_a_body_comes_back_from_a_file(write):
    body = mdr.StandardLinearSolid(1e6, 2e6, 0.1, 0.5)
    t = np.geomspace(1e-2, 10, 31)
    rows = "".join(f"{a:.6g}\t{1e-6 * 0.75 * E:.6g}\n" for a, E in zip(t, body.relaxation_modulus(t), strict=True))
    found = mdr.Prony.fit_relaxation(*mdr.read_relaxation(write("t [s]\tE [MPa]\n" + rows)), nu=0.5)
    assert_allclose(found.relaxation_modulus(t), body.relaxation_modulus(t), rtol=1e-3)
