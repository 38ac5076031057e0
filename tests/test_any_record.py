"""Any record that constructs gives finite, bounded answers, or refuses in the library's own words.

Hypothesis draws the records, and shrinks what fails.
"""

import contextlib

import anything
import pytest
import questions
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

EVERYTHING = list(HealthCheck)


@st.composite
def contacts(draw):
    """A contact that slides, or None where it is refused as it is made, and the dice for further questions."""
    dice = anything.Chosen(draw)
    try:
        case = questions.asked(anything.contact, dice)
        questions.asked(getattr, case, "cycle")
    except questions.Refused:
        case = None
    return case, anything.Dice(draw(st.integers(0, 2**16)))


def answer(question, drawn):
    case, dice = drawn
    if case is not None:
        with contextlib.suppress(questions.Refused):
            questions.asked(question, case, dice)


@pytest.mark.parametrize("question", questions.QUICK, ids=lambda one: one.__name__)
@settings(max_examples=12, suppress_health_check=EVERYTHING)
@given(drawn=contacts())
def test_any_record_answers_or_says_why_not(question, drawn):
    answer(question, drawn)


@pytest.mark.parametrize("question", [questions.pressed, *questions.RUNS], ids=lambda one: one.__name__)
@settings(max_examples=4, suppress_health_check=EVERYTHING)
@given(drawn=contacts())
def test_any_record_runs_within_the_bounds_of_physics_or_says_why_not(question, drawn):
    answer(question, drawn)


def test_what_is_drawn_is_of_every_kind():
    """The dice reach every shape, material, motion and pull, and most contacts slide; each prints as a few lines."""
    kinds, slide = set(), 0
    for seed in range(200):
        try:
            case = questions.asked(anything.contact, anything.Dice(seed))
        except questions.Refused:
            continue
        slide += 1
        assert 6 <= len(str(case).splitlines()) <= 8
        kinds |= {type(part).__name__ for part in (case.indenter, case.material, case.oscillation, case.pull)}
    assert slide > 100
    assert kinds >= {*anything.SHAPES, "Elastic", "ElasticPair", "KelvinVoigt", "StandardLinearSolid", "Prony"}
    assert kinds >= {"NormalOscillation", "PeriodicMotion", "LoadOscillation", "RigidPull", "SpringPull"}
