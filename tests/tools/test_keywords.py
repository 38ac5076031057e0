"""A name that there is not is met with the one that was meant: a keyword, an attribute, a name of the package."""

import pickle

import numpy as np
import pytest
from conftest import contact

import mdr
from mdr.tools.keywords import Offering, offering

CASE = contact("cone", 2.0)
CURVE = mdr.cof_curve(CASE, [0.0, 1e-4])
MANY = mdr.slide_many(CASE, [1e-4, 2e-4], n_springs=32, steps_per_period=32)


def test_a_function_stays_what_it_was():
    assert offering(pow)(2, 3) == 8
    assert mdr.slide.__name__ == "slide"
    assert pickle.loads(pickle.dumps(mdr.slide)) is mdr.slide


@pytest.mark.parametrize(
    ("of", "name", "meant"),
    [
        (CURVE, "cofs", "cof"), (CURVE, "stick", "stick_share"), (MANY, "COF", "cof"), (CASE, "mu", "mu_0"),
        (CASE.indenter, "Theta", "theta"), (CASE.material, "Estar", "E_star"), (CASE.oscillation, "uz0", "u_z0"),
        (mdr, "Slide", "slide"), (mdr, "ManyCof", "ManyCofs"), (mdr, "critical_velocities", "critical_velocity"),
        (mdr.Paraboloid(R=1e-3), "radius", "R"),
    ],
)  # fmt: skip
def test_an_attribute_that_there_is_not_is_met_with_the_one_that_was_meant(of, name, meant):
    with pytest.raises(AttributeError, match=f"has no attribute '{name}'; did you mean {meant}\\?") as refused:
        getattr(of, name)
    assert str(pickle.loads(pickle.dumps(refused.value))) == str(refused.value)  # as a helper of a study sends it
    assert not hasattr(of, name)


def test_letters_of_two_sizes_are_told_apart():
    class Forces(Offering):
        F_x, f_x = 1.0, 2.0

    with pytest.raises(AttributeError, match=r"did you mean F_x\?"):
        _ = Forces().F_X


def test_what_fails_within_a_property_is_told():
    class Broken(Offering):
        @property
        def cof(self):
            return {}.nothing

    with pytest.raises(AttributeError, match="'dict' object has no attribute 'nothing'"):
        _ = Broken().cof


def test_a_result_is_no_list_and_says_the_way():
    with pytest.raises(TypeError, match=r"ManyCofs is no list; take .v_0\[1\] or .cof\[1\]"):
        MANY[1]
    with pytest.raises(TypeError, match=r"CofCurve is no list; take .cof$"):
        CURVE["cof"]
    with pytest.raises(TypeError, match=r"Cone is no list; take its values, as .theta"):
        CASE.indenter[0]
    with pytest.raises(TypeError, match=r"RigidPull is no list; take its values$"):
        CASE.pull[0]
    assert np.array([CASE, CASE], dtype=object).shape == (2,)
    assert not np.iterable(CASE)
