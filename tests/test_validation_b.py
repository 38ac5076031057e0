"""The claims of the report whose numbers come from long chains, in their quick form: every check holds, every figure
is drawn."""

import importlib

import pytest

from validation.report import Claim


@pytest.mark.parametrize("name", ["spring_pull", "generalisation", "resonances", "resolution", "energy"])
def test_every_check_of_the_claim_holds(name: str) -> None:
    claim = importlib.import_module(f"validation.{name}").claim("quick")
    assert isinstance(claim, Claim)
    assert claim.name == name
    assert claim.figures
    failed = [(check.name, check.got, check.expected, check.tolerance) for check in claim.checks if not check.held]
    assert not failed
