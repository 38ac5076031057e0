"""propagate(): standard deviations by hand, the samples as cases of their own, and where slopes are not enough."""

import csv
import io
from dataclasses import replace

import numpy as np
import pytest
from conftest import contact
from horn import HORN, written
from numpy.testing import assert_allclose, assert_array_equal

import mdr
from mdr.given.case_file import case_of

CONE = contact("cone", 10.0)
BODY = contact("cone", 5.0, k_ratio=2.0, omega_0_ratio=1.6, c_ratio=0.1)
A, B = 0.03, 0.04
SPREAD = {"mu_0": "3%", "oscillation.du_z": B * 2e-6}
V_C = mdr.critical_velocity(CONE)


def test_v_c_of_a_rigid_pull_is_a_product():
    """v_c = mu_0 kappa omega du_z: (a² + b²)^(1/2) of it by slopes; exactly ((1 + a²)(1 + b²) - 1)^(1/2)."""
    found = mdr.propagate(CONE, SPREAD)
    assert_allclose(found.v_c_sd, V_C * np.hypot(A, B), rtol=1e-9)
    assert found.v_c_share == pytest.approx({"mu_0": 0.36, "oscillation.du_z": 0.64}, rel=1e-9)
    exact, n = V_C * np.sqrt((1 + A**2) * (1 + B**2) - 1), 1000
    assert abs(found.samples["v_c"].sd / exact - 1) < 3 / np.sqrt(2 * n)
    assert abs(found.samples["v_c"].mean - V_C) < 3 * exact / np.sqrt(n)
    assert_allclose(found.samples["v_c"].values, V_C * np.prod(found.drawn, axis=1) / (0.4 * 2e-6), rtol=1e-12)
    assert found.agrees == {"v_c": True}
    assert (found.cof, found.cof_sd, found.cof_share) == (None, None, {})


def test_a_spread_is_said_in_si_with_a_unit_or_in_per_cent():
    same = [mdr.propagate(CONE, {"du_z": one}, samples=30) for one in (8e-8, "0.08um", "80 nm", "4%")]
    assert [one.spread["oscillation.du_z"] for one in same] == pytest.approx(4 * [8e-8], rel=1e-12)
    assert mdr.propagate(CONE, {"mu_0": "0.02"}, samples=30).spread == {"mu_0": 0.02}


def test_a_load_holds_as_others_vary_in_the_slopes_too():
    """A softer cone sinks deeper under its load: modulus and load each have their part, as if the other were exact."""
    load = mdr.static_load(CONE.indenter, CONE.material, CONE.oscillation.u_z0)
    alone = [mdr.propagate(CONE, {one: "4%"}, 0.5 * V_C, held={"load": load}) for one in ("E", "load")]
    both = mdr.propagate(CONE, {"E": "4%", "load": "4%"}, 0.5 * V_C, held={"load": load})
    assert_allclose(both.cof_sd, np.hypot(*(one.cof_sd for one in alone)), rtol=1e-6)
    assert both.cof_share == pytest.approx({"material.E": 0.5, "load": 0.5}, rel=1e-3)  # depth goes with load over E
    assert both.agrees["cof"]


def test_each_sample_is_a_case_of_its_own():
    spread = {"mu_0": "3%", "pull.m": "5%", "v_0": "2%"}
    v_0 = 0.5 * mdr.critical_velocity(BODY)
    found = mdr.propagate(BODY, spread, v_0, samples=30, seed=7)
    assert list(found.spread) == list(spread)
    for (mu_0, m, v), cof, v_c in zip(
        found.drawn[:3].tolist(), found.samples["cof"].values, found.samples["v_c"].values, strict=False
    ):
        case = replace(BODY, mu_0=mu_0, pull=replace(BODY.pull, m=m))
        assert_allclose([cof, v_c], [mdr.slide(case, v).cof, mdr.critical_velocity(case)], rtol=1e-9)
    again, other = (mdr.propagate(BODY, spread, v_0, samples=30, seed=seed) for seed in (7, 8))
    assert again == found
    assert not np.any(other.drawn == found.drawn)


def test_slopes_of_runs_are_their_samples():
    """The slopes are those of sensitivity(), and 300 samples know a standard deviation to 3/sqrt(600) of it."""
    spread = {"mu_0": "3%", "du_z": "4%", "m": "5%", "v_0": "2%"}
    v_0 = 0.5 * mdr.critical_velocity(BODY)
    found, slopes = mdr.propagate(BODY, spread, v_0, samples=300), mdr.sensitivity(BODY, v_0)
    parts = {path: slopes.d_cof[path] * sd for path, sd in found.spread.items()}
    assert_allclose(found.cof_sd, np.linalg.norm([*parts.values()]), rtol=1e-9)
    assert found.cof_share == pytest.approx({path: (one / found.cof_sd) ** 2 for path, one in parts.items()})
    assert sum(found.cof_share.values()) == pytest.approx(1)
    assert "v_0" not in found.v_c_share
    assert abs(found.samples["cof"].sd / found.cof_sd - 1) < 3 / np.sqrt(600)
    assert found.agrees == {"cof": True, "v_c": True}
    assert found.why == {"cof": "", "v_c": ""}


def test_what_a_file_gave_is_held_in_every_sample():
    said = case_of(HORN)
    found = mdr.propagate(said.case, {"load": "5%", "E": "10%", "tan_delta": "10%"}, 0.01, held=said.held, samples=30)
    for (load, E, tan_delta), cof in zip(found.drawn[:3].tolist(), found.samples["cof"].values, strict=False):
        case = written(HORN, {"load": load, "material.E": E, "tan_delta": tan_delta})
        assert_allclose(cof, mdr.cof_curve(case, 0.01).cof[0], rtol=1e-9)
    deep = mdr.propagate(said.case, {"u_z0": "5%", "E": "10%"}, 0.01, held=said.held, samples=30)  # no load is held
    assert deep.cof_share["material.E"] == pytest.approx(0, abs=1e-9)


def test_slopes_and_samples_part_at_v_c_and_over_a_wide_spread():
    at_v_c = mdr.propagate(CONE, {"du_z": "5%"}, V_C, samples=100)
    assert at_v_c.agrees == {"cof": False, "v_c": True}
    assert at_v_c.cof_sd < 1e-6 < at_v_c.samples["cof"].sd
    faster = np.sum(at_v_c.samples["v_c"].values < V_C)
    assert f"v_c lies within the spread, and {faster} of 100 samples are pulled faster" in at_v_c.why["cof"]
    near_resonance = contact("cone", 5.0, k_ratio=2.0, omega_0_ratio=1.2, c_ratio=0.1)
    wide = mdr.propagate(near_resonance, {"m": "15%"})
    assert wide.agrees == {"v_c": False}
    assert "it bends over the spread; trust the samples" in wide.why["v_c"]
    far = mdr.propagate(CONE, {"du_z": "5%"}, 2 * V_C, samples=100)
    assert far.agrees["cof"]  # friction is mu_0 to rounding, whatever du_z
    assert far.samples["cof"].sd < 1e-12


def test_samples_that_cannot_be_are_counted():
    found = mdr.propagate(contact("cone", 10.0, nu=0.48), {"nu": 0.02}, 1e-4, samples=200)
    beyond = int(np.sum(found.drawn > 0.5))
    assert 10 < beyond < 60
    for one in found.samples.values():
        assert one.known.size == 200 - beyond
        assert one.left_out[0].startswith(f"{beyond}: nu must lie in")
        assert_array_equal(np.isnan(one.values), found.drawn[:, 0] > 0.5)
    assert " ".join(str(found).split()).count(f"left out of COF and v_c, {beyond}: nu must lie in") == 1
    slow = mdr.propagate(CONE, {"v_0": "100%"}, 1e-4, samples=200)
    assert slow.samples["v_c"].left_out == ()
    assert "v_0 must not be negative" in slow.samples["cof"].left_out[0]


def test_without_a_slope_the_samples_stand_alone():
    found = mdr.propagate(contact("cone", 10.0, nu=0.5), {"nu": 1e-3, "mu_0": "1%"}, 1e-4, samples=100)
    assert (found.cof_sd, found.cof_share, found.agrees["cof"]) == (None, {}, None)
    assert "the samples stand alone, without a slope: material.nu = 0.5" in found.why["cof"]
    assert found.samples["cof"].sd > 0
    resonant = replace(BODY, pull=mdr.SpringPull(k_x=2e4, m=2e4 / 300.0**2))
    wild = mdr.propagate(resonant, {"k_x": "1%", "nu": "1%"}, samples=100)
    assert (wild.v_c, wild.v_c_sd) == (np.inf, None)
    assert 0 < wild.samples["v_c"].low < wild.samples["v_c"].high < np.inf
    always = mdr.propagate(resonant, {"nu": "1%"}, samples=30)
    assert always.samples["v_c"].mean == np.inf
    assert "infinite" in str(always)
    assert always.plot().get_xlabel().startswith("critical velocity")


def test_it_prints_and_is_written_as_csv(tmp_path):
    found = mdr.propagate(CONE, SPREAD, 1e-4, samples=30)
    lines = str(found).splitlines()
    assert lines[0] == "Propagated: values with their standard deviations, at v_0 = 100 µm/s"
    assert [line.split()[0] for line in lines[1:]] == [
        "COF",
        *lines[2].split()[:1],
        "v_c",
        *lines[4].split()[:1],
        *SPREAD,
    ]
    assert "share: COF" in lines[5]
    found.to_csv(tmp_path / "p.csv")
    rows = list(csv.DictReader(io.StringIO((tmp_path / "p.csv").read_text())))
    assert list(rows[0]) == ["mu_0 [-]", "oscillation.du_z [m]", "cof [-]", "v_c [m/s]"]
    assert [float(row["v_c [m/s]"]) for row in rows] == found.samples["v_c"].values.tolist()
