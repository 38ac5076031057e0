"""Numbers come back as floats, fields as their rules keep them; what is refused tests/test_refusals.py asks."""

from dataclasses import dataclass

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
