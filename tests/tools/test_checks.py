"""The checks of numbers: what passes comes back as a float, what does not names quantity, rule and value."""

import pickle
from dataclasses import dataclass, field, is_dataclass
from dataclasses import fields as dataclass_fields

import numpy as np
import pytest

import mdr
from mdr.case.units import facts_at
from mdr.tools import checks, fields

CHECKS = {
    "finite": checks.finite,
    "positive": checks.positive,
    "not_negative": checks.not_negative,
    "between": lambda name, value: checks.between(name, value, 0, 10),
}


@pytest.fixture(params=CHECKS.values(), ids=CHECKS)
def check(request):
    return request.param


@pytest.mark.parametrize("value", [3, 3.0, np.float64(3), np.float32(3), np.int64(3)])
def test_a_real_number_becomes_a_float(check, value):
    assert type(check("R", value)) is float
    assert check("R", value) == 3.0


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, np.float64("nan")])
def test_nan_and_infinity_are_refused(check, value):
    with pytest.raises(ValueError, match=r"^R must be .*(nan|inf)"):
        check("R", value)


@pytest.mark.parametrize(
    "value", [True, False, np.True_, "3", None, 3j, [3], np.array(3.0), np.array([1.0, 2.0])], ids=repr
)
def test_what_is_not_a_number_is_a_type_error(check, value):
    with pytest.raises(TypeError, match=r"^R must be"):
        check("R", value)


@pytest.mark.parametrize(
    ("check", "value", "message"),
    [
        (checks.positive, 0, "R must be positive, got 0.0"),
        (checks.positive, -1e-300, "R must be positive"),
        (checks.not_negative, -1e-300, "R must not be negative"),
        (CHECKS["between"], 0, "R must lie between 0 and 10, got 0.0"),
        (CHECKS["between"], 10, "R must lie between 0 and 10, got 10.0"),
    ],
)
def test_the_bounds_are_named(check, value, message):
    with pytest.raises(ValueError, match=message):
        check("R", value)


def test_not_negative_takes_zero():
    assert checks.not_negative("m", 0) == 0.0


def test_the_meaning_is_told():
    with pytest.raises(ValueError, match=r"\(radius in m\)"):
        checks.positive("R", -1, "radius in m")


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


@pytest.mark.parametrize(
    ("call", "kind", "name"),
    [
        (lambda: Block(0), checks.FieldError, "length"),
        (lambda: Block("1 m"), checks.FieldTypeError, "length"),
        (lambda: mdr.Prony(1e6, [(1e6, -1)], 0.5), checks.FieldError, "arms"),
        (lambda: mdr.PeriodicMotion(1, 1e-6, cos=(np.nan,)), checks.FieldError, "cos"),
        (lambda: mdr.NormalOscillation(-1, 1e-6, 1), checks.FieldError, "u_z0"),
        (lambda: mdr.CappedParaboloid(1, 2, 1), checks.FieldError, "R2"),
    ],
)
def test_an_error_carries_the_field_it_blames(call, kind, name):
    with pytest.raises(kind) as refused:
        call()
    assert refused.value.field == name
    assert pickle.loads(pickle.dumps(refused.value)).field == name  # it may come from another process


def test_every_field_of_the_records_of_a_case_tells_its_meaning():
    for base in (mdr.Indenter, mdr.Material, mdr.Motion, mdr.Pull):
        for record in (one for name in mdr.__all__ if isinstance(one := getattr(mdr, name), type)):
            if issubclass(record, base) and is_dataclass(record):
                assert all(fields.facts_of(one).meaning for one in dataclass_fields(record)), record


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
