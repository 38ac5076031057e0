"""tolerance(): every number is that of the case in which it is written down; inputs are those that were given."""

import csv
import io
from dataclasses import replace

import numpy as np
import pytest
from conftest import contact
from horn import HORN, written
from numpy.testing import assert_allclose

import mdr
from mdr.friction import tolerance as module
from mdr.friction.cof_curve import friction_at
from mdr.given.case_file import case_of
from mdr.tools.notation import shown

V_0, BY = 0.01, 0.1
#: what the file gives, and the velocity
INPUTS = {
    "mu_0": 0.3, "indenter.R": 3e-3, "material.E": 3e9, "material.nu": 0.4, "oscillation.du_z": 3e-6,
    "tan_delta": 0.03, "frequency": 20e3, "load": 5.0, "v_0": V_0,
}  # fmt: skip


def test_numbers_are_those_of_a_loop_over_files():
    said = case_of(HORN)
    found = mdr.tolerance(said.case, V_0, by=BY, held=said.held)
    assert set(found.cof) == set(found.v_c) == set(found.inputs) == set(INPUTS)
    for path, given in INPUTS.items():
        for end, value in enumerate((given * (1 - BY), given * (1 + BY))):
            case, v_0 = (said.case, value) if path == "v_0" else (written(HORN, {path: value}), V_0)
            assert_allclose(found.inputs[path][end], value, rtol=1e-14)
            assert_allclose(found.cof[path][end], mdr.cof_curve(case, v_0).cof[0], rtol=1e-10)
            assert_allclose(found.v_c[path][end], mdr.critical_velocity(case), rtol=1e-10)
    assert found.base_cof == mdr.cof_curve(said.case, V_0).cof[0]
    assert found.base_v_c == mdr.critical_velocity(said.case)
    spread = [abs(less - more) for less, more in found.cof.values()]
    assert spread == sorted(spread, reverse=True)
    assert found.warnings == ()


def test_small_steps_are_the_derivative_of_eq_1():
    """Under a rigid pull v_c = mu_0 kappa omega du_z: each factor moves it by its own share, and R, E not at all."""
    found = mdr.tolerance(case_of({**HORN, "material": {"model": "Elastic", "E": 3e9, "nu": 0.4}}).case, V_0, by=1e-3)
    for path, power in {"mu_0": 1, "frequency": 1, "oscillation.du_z": 1, "indenter.R": 0, "material.E": 0}.items():
        assert_allclose(
            np.array(found.v_c[path]) / found.base_v_c, [(1 - 1e-3) ** power, (1 + 1e-3) ** power], rtol=1e-12
        )


def test_the_amplitude_of_a_waveform_is_an_input():
    wave = mdr.waveforms.pulse(20e-6, 2e-6, 300.0, width=0.25, n_harmonics=4)
    case = mdr.SlidingContact(mdr.Cone(0.0127), mdr.Elastic(E=3e6, nu=0.5), 0.4, wave)
    assert "alpha" in mdr.tolerance(case, 1e-4, by=0.1).cof


def test_what_a_case_cannot_have_is_moved_to_what_it_can():
    found = mdr.tolerance(contact("flat", 1.005, nu=0.48), 1e-3, by=0.5)
    assert found.inputs["material.nu"] == pytest.approx((0.24, 0.5), rel=1e-8)


def test_a_body_is_varied_by_runs_and_a_run_that_does_not_settle_is_named(monkeypatch):
    case = replace(contact("paraboloid", 5.0, du_z=4e-6), pull=mdr.SpringPull(2e3, 0.1))
    v_0 = 0.5 * mdr.critical_velocity(case)
    found = mdr.tolerance(case, v_0, fields=["m"])
    heavy = replace(case, pull=mdr.SpringPull(2e3, 0.11))
    assert found.cof["pull.m"][1] == pytest.approx(mdr.slide(heavy, v_0).cof, rel=1e-9)  # 0.1 x 1.1 is not quite 0.11
    assert found.v_c["pull.m"][1] == pytest.approx(mdr.critical_velocity(heavy), rel=1e-12)
    monkeypatch.setattr(module, "friction_at", lambda *of: (*friction_at(*of)[:2], "the run did not settle"))
    loose = mdr.tolerance(replace(case, pull=mdr.RigidPull()), v_0, fields=["oscillation.du_z"])
    assert loose.warnings[1] == "oscillation.du_z = 3.6 µm: the run did not settle"


def test_it_prints_and_is_written_as_csv(tmp_path):
    said = case_of(HORN)
    found = mdr.tolerance(said.case, V_0, fields=["load", "v_0"], held=said.held)
    found.to_csv(tmp_path / "t.csv")
    load, v_0 = csv.DictReader(io.StringIO((tmp_path / "t.csv").read_text()))
    assert (load["input"], load["unit"], v_0["unit"]) == ("load", "N", "m/s")
    assert float(load["minus: cof [-]"]) == found.cof["load"][0]
    assert float(load["plus: input"]) == 5.5
    assert "Tolerance: each input 10 % less and more, at v_0 = 10 mm/s" in str(found)
    assert shown(found.v_c["load"][0], "m/s", 4) in str(found)
