"""Numbers come back as floats, fields as their rules keep them; what is refused tests/test_refusals.py asks."""

from dataclasses import dataclass, field

import numpy as np
import pytest

import mdr
from mdr.case.paths import facts_at
from mdr.tools import checks, fields


@pytest.mark.parametrize("check", [checks.finite, checks.positive, checks.not_negative])
@pytest.mark.parametrize("value", [3, 3.0, np.float64(3), np.float32(3), np.int64(3)])
def test_a_real_number_becomes_a_float(check, value):
    assert type(check("R", value)) is float
    assert check("R", value) == 3.0
    assert checks.not_negative("m", 0) == 0.0


@dataclass(frozen=True)
class Block(fields.Record):
    """A record whose fields have facts."""

    length: float = field(metadata=fields.facts("m", "length of an edge"))
    drag: float = field(default=0, metadata=fields.facts("-", "drag", checks.not_negative, note="none is 0"))
    name: str = "block"


def test_fields_are_checked_by_their_facts_and_kept_as_floats():
    block = Block(np.int64(2))
    assert (type(block.length), type(block.drag), block.name) == (float, float, "block")
    with pytest.raises(ValueError, match=r"^length must be positive, got -1\.0 \(length of an edge in m\)$"):
        Block(-1)
    with pytest.raises(ValueError, match=r"^drag must not be negative, got -1\.0 \(none is 0\)$"):
        Block(1, -1)


def test_a_path_has_the_unit_of_its_fields():
    assert facts_at("material.tau").unit == "s"
    assert facts_at("indenter.R").meaning == "radius of curvature"
    assert facts_at("indenter.c").unit == ""  # m of one shape, m^(1-n) of another
    assert facts_at("mu_0").unit == facts_at("T").unit == "-"
    assert facts_at("pull.weight") == fields.NOTHING

    @dataclass(frozen=True)
    class Bare(mdr.Material):
        """A material of a user, whose fields have no facts."""

        tau: float

    assert facts_at("material.tau").unit == "s"
