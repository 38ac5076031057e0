"""Headlines read every check that sets a measured critical velocity beside its formula, and take the worst."""

import json
import re

import pytest

from validation.headlines import HEADLINES, difference, reads
from validation.written import RECORD

CHECKS = json.loads(RECORD.read_text(encoding="utf-8"))["checks"]


@pytest.mark.parametrize("place", sorted({place for places in HEADLINES.values() for place in places}))
def test_a_pattern_names_checks_that_the_claims_have(place):
    assert any(check["claim"] == place[0] and re.match(place[1], check["name"]) for check in CHECKS)


def test_no_comparison_with_full_slip_is_left_out():
    beside = [
        c for c in CHECKS if re.search(r"v_c.*full.slip|measured v_c over Eq\. \(1\)|v_c measured over", c["name"])
    ]
    missed = {c["name"] for c in beside if not reads("full slip", c["claim"], c["name"])}
    assert all("whose bracket misses" in name for name in missed)


@pytest.mark.parametrize(
    ("name", "got", "expected", "why", "found"),
    [
        ("measured v_c over Eq. (1)", 0.995, 0.996, "w", 0.001 / 0.996),
        ("worst |v_c/full-slip value − 1| of 9", 3e-6, 1e-4, "w", 3e-6),
        ("v_c measured over ω Δu_x, less 1, worst: two", -3e-6, 0.0, "w", 3e-6),
        ("worst |measured/Eq. (15) − 1|", 0.1, 1.0, "over its tolerance; greatest difference 7.2e-06 of v_c", 7.2e-6),
    ],
)
def test_a_difference_is_relative_to_the_formula(name, got, expected, why, found):
    assert difference(name, got, expected, why) == pytest.approx(found, rel=1e-9)
