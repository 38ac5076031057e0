"""A keyword that a function does not take is met with the one that was meant."""

import pickle

import pytest

import mdr
from mdr.tools.keywords import offering


def test_a_function_stays_what_it_was():
    assert offering(pow)(2, 3) == 8
    assert mdr.slide.__name__ == "slide"
    assert pickle.loads(pickle.dumps(mdr.slide)) is mdr.slide


def test_the_line_outside_is_warned_of():
    with pytest.warns(mdr.PlausibilityWarning) as warned:
        mdr.cof_curve(
            mdr.SlidingContact(mdr.Cone(1.0), mdr.Elastic(3e6, 0.5), 0.5, mdr.NormalOscillation(1e-5, 1e-6, 3.0)), 1e-5
        )
    assert {one.filename for one in warned} == {__file__}
