"""A keyword that a function does not take is met with the one that was meant."""

import pickle

import pytest

import mdr
from mdr.tools.keywords import offering


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: mdr.slide(None, v=1), "slide takes no v; did you mean v_0?"),
        (lambda: mdr.rig(None, None, 0.3, frequency=5, amplitude=1e-6),
         "rig takes no amplitude; did you mean load_amplitude or depth_amplitude?"),
        (lambda: mdr.cof_curve(None, 1, springs=40), "cof_curve takes no springs; did you mean n_springs?"),
        (lambda: mdr.sweep(None, {}, quantity=["cof"]), "sweep takes no quantity; did you mean quantities?"),
    ],
)  # fmt: skip
def test_the_nearest_is_offered(call, words):
    with pytest.raises(TypeError) as refused:
        call()
    assert str(refused.value) == words


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
