"""A keyword that a function does not take is met with the one that was meant."""

import pickle

import mdr
from mdr.tools.keywords import offering


def test_a_function_stays_what_it_was():
    assert offering(pow)(2, 3) == 8
    assert mdr.slide.__name__ == "slide"
    assert pickle.loads(pickle.dumps(mdr.slide)) is mdr.slide
