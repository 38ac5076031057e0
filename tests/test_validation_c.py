"""The claim on finite amplitude and lost contact, in its quick form."""

import pytest

from validation import finite_amplitude, run_claim
from validation.finite_amplitude import FEW, KELVIN, RATIOS, RIDGE, grid, measure, onset, system


def test_every_check_of_the_claim_holds():
    outcome = run_claim("finite_amplitude", "quick")
    missed = [f"{c.name}: got {c.got}, expected {c.expected}" for c in outcome.claim.checks if not c.held]
    assert not missed, "\n".join([outcome.trace, *missed])
    assert {figure.name for figure in outcome.claim.figures} == {"map", "table"}
    assert all(figure.caption and figure.alt for figure in outcome.claim.figures)


def test_a_full_slip_value_that_is_off_is_seen(monkeypatch):
    right = finite_amplitude.mdr.full_slip_critical_velocity
    points = [measure(*knobs) for knobs in FEW]  # from runs alone, so as they were
    monkeypatch.setattr(finite_amplitude.mdr, "full_slip_critical_velocity", lambda case: 1.001 * right(case))
    missed = [c.name for c in finite_amplitude._measured_checks(points) if not c.held]
    assert any("bracket" in name for name in missed)
    assert any("worst |v_c/full-slip" in name for name in missed)
    assert sum("power of α" in c.name and not c.held for c in finite_amplitude._power_checks("quick")) == 12
    assert sum("passes 1e-9" in c.name and not c.held for c in finite_amplitude._onset_checks()) == 4


@pytest.mark.parametrize("wrong", [0.9, 1.1])
def test_an_onset_that_is_off_is_seen(monkeypatch, wrong):
    monkeypatch.setattr(finite_amplitude, "onset", lambda *knobs: wrong * onset(*knobs))
    assert sum("passes 1e-9" in c.name and not c.held for c in finite_amplitude._onset_checks()) >= 2


def test_the_full_grid_loses_contact_with_every_shape():
    known = grid("full")
    assert len(set(known)) == len(known) == 28 + len(KELVIN) + len(RIDGE)
    for T in (0.0, 1.0):
        assert {s for s, alpha, loss, _ in known if alpha == 1.3 and loss == T} == set(finite_amplitude.SHAPES)
    assert {ratio for *_, ratio in known} == {*RATIOS, 2.0}
    assert all(system(*knobs).oscillation.du_z > 0 for knobs in known)
