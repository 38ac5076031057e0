"""Study files: read as they are written, and refused with every fault at once."""

from pathlib import Path

import numpy as np
import pytest
from grids import BODY
from numpy.testing import assert_array_equal

import mdr
from mdr.studies.study_files import parse_study, read_study_file

EXAMPLE = Path(__file__).parents[2] / "docs" / "study.toml"
CASE = mdr.write_case(BODY).removeprefix("mu_0 = 0.5\n")


def text(axes='"v_0/v_c" = [0.5]', top="", case=CASE):
    return f"mu_0 = 0.5\n{top}\n{case}\n[axes]\n{axes}\n"


def faults(*parts, **changes):
    with pytest.raises(mdr.CaseFileError) as caught:
        parse_study(text(*parts, **changes), "study.toml")
    for line in caught.value.faults:
        assert line.startswith("study.toml: ")
    return [line.removeprefix("study.toml: ") for line in caught.value.faults]


def test_the_example_reads_and_runs():
    file = read_study_file(EXAMPLE)
    assert list(file.axes) == ["T", "v_0/v_c", "indenter"]
    assert file.quantities == ("cof", "stick_share")
    study = mdr.sweep(**vars(file) | {"axes": {path: values[:2] for path, values in file.axes.items()}})
    assert study.shape == (2, 2, 2)
    assert study.count(0) == 8


def test_every_way_to_write_values():
    file = parse_study(
        text(
            '"T" = { from = 0.01, to = 10, n = 4, spacing = "log" }\n'
            '"v_0/v_c" = { from = 0, to = 1, n = 3 }\n'
            '"oscillation.u_z0" = [6e-6, 7e-6]\n'
            'indenter = [{ shape = "Cone", theta = 0.05 }, { shape = "FlatPunch", a = 1e-3 }]\n'
            "pull = [{}, { k_x = 1e4, m = 0.2 }]\n"
            "oscillation = [{ u_z0 = 1e-6, du_z = 2e-6, omega = 3.0 }]\n",
            'quantities = ["cof", "v_c"]\nn_springs = 64\nsteps_per_period = 128',
        )
    )
    np.testing.assert_allclose(file.axes["T"], [0.01, 0.1, 1, 10], rtol=1e-14)
    assert_array_equal(file.axes["v_0/v_c"], [0, 0.5, 1])
    assert file.axes["oscillation.u_z0"] == [6e-6, 7e-6]
    assert file.axes["indenter"] == [mdr.Cone(theta=0.05), mdr.FlatPunch(a=1e-3)]
    assert file.axes["pull"] == [mdr.RigidPull(), mdr.SpringPull(k_x=1e4, m=0.2)]
    assert file.axes["oscillation"] == [mdr.NormalOscillation(1e-6, 2e-6, 3.0)]
    assert file.case.pull == BODY.pull
    assert (file.quantities, file.n_springs, file.steps_per_period) == (("cof", "v_c"), 64, 128)


FAULTS = [  # what stands under [axes] and at the top, and how the faults begin
    ('"v_0" = 0.1', "", ["[axes] v_0 must be a list of values or { from = , to = , n = }, got 0.1"]),
    ('"v_0" = { from = 0, too = 1, n = 1, spacing = "logarithmic" }', "", [
        "[axes] v_0: too is no key of a range; did you mean to?", "[axes] v_0: to is missing from the range",
        "[axes] v_0: n must be at least 2, got 1", '[axes] v_0: spacing must be "linear" or "log", got \'logarithmic\'',
    ]),
    ('"v_0" = { from = 0, to = 1, n = 1000000000000 }', "", ["[axes] v_0: n must be at most 100000000, got 10000"]),
    ('"T" = { from = 0, to = 1, n = 3, spacing = "log" }', "", ['[axes] T: a range with spacing = "log" must']),
    ('oscillation = [{ load = 3.0, du_z = 1e-6, frequency = 2e4 }]\n"v_0" = [1]', "", [
        "[axes] [oscillation] load cannot stand in a list of tables: give oscillation.F_z0 or oscillation.u_z0"]),
    ('material = [{ model = "KelvinVoigt", E = 1e6, nu = 0.4, tan_delta = 0.1 }]\n"v_0" = [1]', "", [
        "[axes] [material] tan_delta cannot stand in a list of tables: give material.tau"]),
    ('"v_0" = { from = "a", to = inf, n = 3 }', "", [
        "[axes] v_0: from wants m/s (or cm/s, mm/s, um/s, nm/s, mm/min), got 'a'",
        "[axes] v_0: to must be a finite number, got inf"]),
    ('oscillation.u_z0 = [1e-6]\n"v_0" = [1]', "", [
        '[axes] oscillation.u_z0 must be in quotes, "oscillation.u_z0" = [...]; oscillation itself a list of tables']),
    ('"v_0" = [1]\nindenter = [{ shape = "Cone" }, { shape = "Kone", theta = 1 }]', "", [
        "[axes] [indenter] theta is missing", '[axes] [indenter] shape "Kone" is unknown; did you mean Cone?']),
    ('"mu_0" = [0.1, 0.1]\n"v_0" = [-1]', "", [
        "[axes] mu_0 has the value 0.1 twice; give each once",
        "[axes] v_0 must not be negative, got -1.0; 0 is the static limit"]),
    ('"v_0" = [1]', 'quantities = ["coff", "stick"]', [
        "coff is no quantity of the catalogue; did you mean cof?",
        "stick is no quantity of the catalogue; did you mean stick_share?"]),
    ('"v_0" = [1]', "quantites = []\nmu0 = 3", [
        "quantites is no key outside the tables; did you mean quantities?",
        "mu0 is no key outside the tables; did you mean mu_0?"]),
    ("", "", ["[axes] must be a table of paths and their values"]),
]  # fmt: skip


@pytest.mark.parametrize(("axes", "top", "told"), FAULTS, ids=str)
def test_faults_are_named(axes, top, told):
    found = faults(axes, top)
    assert len(found) == len(told)
    assert all(map(str.startswith, found, told))


def test_axes_are_judged_behind_a_case_that_is_refused():
    unsound = CASE.replace("E = 3000000.0", "E = -1")
    axes = '"oscillation.u_z" = [1e-6]\n"pull.m" = [0.1, 0.1]\n"material.tua" = [1]\n"alfa" = [1]'
    found = faults(axes, case=unsound)
    assert [line.split(";")[0] for line in found] == [
        "[material] E must be positive, got -1.0 (Young's modulus in Pa)",
        "[axes] oscillation.u_z is no path of this case",
        "[axes] pull.m has the value 0.1 twice",
        "[axes] alfa is no path of this case",
    ]  # material.tua waits for a material that can be read


def test_no_axes_at_all():
    with pytest.raises(mdr.CaseFileError, match=r"\[axes\] is missing; a study varies something"):
        parse_study("mu_0 = 0.5\n" + CASE)
    with pytest.raises(mdr.CaseFileError, match=r"\[axis\] is no table of a case; did you mean \[axes\]?"):
        parse_study("mu_0 = 0.5\n" + CASE + "[axis]\nv_0 = [1]\n")


@pytest.mark.parametrize("content", ["mu_0 = ", "axes = 3\n", "axes = [[1]]", "deep = " + "[" * 5000 + "]" * 5000])
def test_what_is_no_study_file_is_refused(content):
    with pytest.raises(mdr.CaseFileError):
        parse_study(content)
    with pytest.raises(mdr.CaseFileError, match="cannot be read"):
        read_study_file("/nowhere/study.toml")


def test_axes_take_quantities():
    given = (
        '"oscillation.du_z" = ["1 um", 2e-6]\nv_0 = { from = "1 mm/s", to = "3 mm/s", n = 3 }\nfrequency = ["50 Hz"]'
    )
    axes = parse_study(text(given)).axes
    assert axes["oscillation.du_z"] == [1e-6, 2e-6]
    assert axes["v_0"].tolist() == [1e-3, 2e-3, 3e-3]
    assert axes["frequency"] == [50.0]
