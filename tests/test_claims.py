"""Every claim in its quick form: all checks hold, and they do not where something is wrong."""

import json
import os
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import mdr
from mdr.settling import Settling
from validation import CLAIMS, finite_amplitude, indentation, lost_contact, static_cof, uniqueness
from validation.__main__ import run_all
from validation.finite_amplitude import FEW, KELVIN, RATIOS, RIDGE, grid, measure, system
from validation.report import plain
from validation.written import RECORD


@pytest.fixture(scope="module")
def outcomes(request):
    """Name and outcome of the claims that tests have been asked for, each tested in a process of its own."""
    asked = {item.callspec.params["name"] for item in request.session.items if "outcomes" in item.fixturenames}
    names = [name for name in CLAIMS if name in asked]
    return dict(run_all(names, "quick", "validation", os.cpu_count() or 1))


@cache
def recorded_verdicts():
    """The verdicts that README and docs quote."""
    return {claim["name"]: claim["verdict"] for claim in json.loads(RECORD.read_text(encoding="utf-8"))["claims"]}


@pytest.mark.parametrize("name", CLAIMS)
def test_every_check_of_the_claim_holds(outcomes, name):
    claim, _, trace = outcomes[name]
    missed = [f"{c.name}: got {c.got}, expected {c.expected}" for c in claim.checks if not c.held]
    assert not missed, "\n".join([trace, *missed])
    assert plain(claim.verdict) == recorded_verdicts()[name], "run python -m validation, then validation.written"
    assert claim.figures
    assert all(figure.caption and figure.alt for figure in claim.figures)


def test_a_claim_fails_when_the_physics_is_wrong(monkeypatch):
    """A static limit that is one part in a thousand off is seen, both in closed form and in the slow runs."""
    right = static_cof.mdr.static_cof
    monkeypatch.setattr(static_cof.mdr, "static_cof", lambda case: 1.001 * right(case))
    missed = [check.name for check in static_cof.claim("quick").checks if not check.held]
    assert any("Eq. (7)" in name for name in missed)
    assert any("COF − static over the derived law" in name for name in missed)


def test_a_full_slip_value_that_is_off_is_seen(monkeypatch):
    right = finite_amplitude.mdr.full_slip_critical_velocity
    points = [measure(*knobs) for knobs in FEW]  # from runs alone, so as they were
    monkeypatch.setattr(finite_amplitude.mdr, "full_slip_critical_velocity", lambda case: 1.001 * right(case))
    missed = [c.name for c in finite_amplitude._measured_checks(points) if not c.held]
    assert any("bracket" in name for name in missed)
    assert any("worst |v_c/full-slip" in name for name in missed)
    assert sum("power of α" in c.name and not c.held for c in finite_amplitude._power_checks("quick")) == 12
    assert sum("passes 1e-9" in c.name and not c.held for c in lost_contact._onset_checks()) == 4
    assert sum("over (**)" in c.name and not c.held for c in lost_contact._slow_checks()) >= 4


@pytest.mark.parametrize("wrong", [0.9, 1.1])
def test_an_onset_that_is_off_is_seen(monkeypatch, wrong):
    right = lost_contact.onset
    monkeypatch.setattr(lost_contact, "onset", lambda *knobs: wrong * right(*knobs))
    assert sum("passes 1e-9" in c.name and not c.held for c in lost_contact._onset_checks()) == 4


def test_limits_of_lost_contact_that_are_off_are_seen(monkeypatch):
    points = [lost_contact.measure(shape, alpha, T) for alpha, T, shape in lost_contact.RIGID["quick"]]
    assert all(c.held for c in lost_contact._rigid_checks(points))
    late, limit = lost_contact.late, lost_contact.amplitude_limit
    monkeypatch.setattr(lost_contact, "late", lambda *knobs: 1.0001 * late(*knobs))
    monkeypatch.setattr(lost_contact, "amplitude_limit", lambda T: 1.001 * limit(T))
    assert not any(c.held for c in lost_contact._rigid_checks(points))
    assert not any(c.held for c in lost_contact._limit_checks())


def test_a_slope_over_depth_that_is_off_is_seen(monkeypatch):
    right, flat = indentation.sensitivity, indentation.flattest
    monkeypatch.setattr(indentation, "sensitivity", lambda case: 1.001 * right(case))
    monkeypatch.setattr(indentation, "flattest", lambda case: (1.01 * flat(case)[0], 1.001 * flat(case)[1]))
    assert not any(c.held for c in indentation._slope_checks("quick"))
    assert not any(c.held for c in indentation._minimum_checks())


def test_two_friction_coefficients_at_one_velocity_would_be_seen():
    system = uniqueness.drawn(2)[1]
    one = Settling(0.5, 1e-7, True, "periodic")
    alike, other = replace(one, mean=0.5 + 1e-7), replace(one, mean=0.5 + 1e-6, kind="period-2")
    assert all(c.held for c in uniqueness._end_checks([uniqueness.Ends(system, (one, alike, one, alike, one))]))
    found = [uniqueness.Ends(system, (one, alike, one, other, replace(one, settled=False)))]
    assert not any(c.held for c in uniqueness._end_checks(found))


def test_friction_that_falls_with_velocity_would_be_seen():
    system = uniqueness.drawn(2)[1]
    run = mdr.slide(system.case, system.v_0, n_springs=32, steps_per_period=64)
    less = replace(run, cof=run.cof - 3 * run.cof_error)
    assert uniqueness._curve_checks([(system, [less, run])], "quick")[0].held
    assert not uniqueness._curve_checks([(system, [run, less])], "quick")[0].held


def test_motions_that_move_apart_would_be_seen(monkeypatch):
    system = uniqueness.drawn(2)[1]
    right = uniqueness.distances(system)
    monkeypatch.setattr(uniqueness, "distances", lambda system: right * 1.3 ** np.arange(right.size) ** 2)
    assert not uniqueness._distance_checks([uniqueness.Ends(system, ())])[0].held


def test_the_full_grid_loses_contact_with_every_shape():
    known = grid("full")
    assert len(set(known)) == len(known) == 28 + len(KELVIN) + len(RIDGE)
    for T in (0.0, 1.0):
        assert {s for s, alpha, loss, _ in known if alpha == 1.3 and loss == T} == set(finite_amplitude.SHAPES)
    assert {ratio for *_, ratio in known} == {*RATIOS, 2.0}
    assert all(system(*knobs).oscillation.du_z > 0 for knobs in known)
