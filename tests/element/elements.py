"""What the tests of the element share: materials of every kind, and the arrays of a call in C."""

import ctypes

import pytest

import mdr

ELASTIC = mdr.Elastic(E=3e6, nu=0.5)
KELVIN = mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-3)
ARMS = mdr.Prony(E_inf=3e6, arms=((2e6, 1e-3), (3e6, 5e-3)), nu=0.5)
MATERIALS = {"elastic": ELASTIC, "Kelvin": KELVIN, "arms": ARMS}
every_material = pytest.mark.parametrize("material", MATERIALS.values(), ids=MATERIALS)
DOUBLES = ctypes.POINTER(ctypes.c_double)


def at(values):
    return values.ctypes.data_as(DOUBLES)
