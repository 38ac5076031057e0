"""What the tests of the element share: materials of every kind, an element, its motion, the arrays of a call in C."""

import ctypes

import numpy as np
import pytest

import mdr

ELASTIC = mdr.Elastic(E=3e6, nu=0.5)
KELVIN = mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-3)
ARMS = mdr.Prony(E_inf=3e6, arms=((2e6, 1e-3), (3e6, 5e-3)), nu=0.5)
MATERIALS = {"elastic": ELASTIC, "Kelvin": KELVIN, "arms": ARMS}
every_material = pytest.mark.parametrize("material", MATERIALS.values(), ids=MATERIALS)
in_c = pytest.mark.parametrize("material", [ELASTIC, KELVIN], ids=["elastic", "Kelvin"])  #: that a header knows
BALL, DEPTH, MU_0 = mdr.Paraboloid(R=5e-3), 40e-6, 0.5
REACH = MU_0 * ELASTIC.mindlin_ratio * DEPTH  #: way that brings the deepest spring from rest to slip
DOUBLES = ctypes.POINTER(ctypes.c_double)


def element(material=ELASTIC, shape=BALL, n_springs=48):
    return mdr.ContactElement(shape, material, MU_0, u_z_max=DEPTH, n_springs=n_springs)


def walk(seed, n=60):
    """Step of time and positions: turned or reversed ways, tapping or steady, with pauses, small and large steps."""
    rng = np.random.default_rng(seed)
    size = 0.2 * 10.0 ** rng.uniform(-2, 1.2, n) * (rng.random(n) < 0.9)
    angle = np.cumsum(rng.normal(0, 0.7, n)) if seed % 4 else np.pi * (rng.random(n) < 0.5)
    depth = 0.4 + 0.6 * np.sin(0.5 * np.arange(n) + np.cumsum(rng.normal(0, 0.3, n)))
    if seed % 4 == 1:
        depth[:] = rng.uniform(0.1, 1)
    us = np.column_stack([*np.cumsum(REACH * size * np.stack([np.cos(angle), np.sin(angle)]), axis=1), DEPTH * depth])
    us[20:24] = us[20]  # a pause in all
    return 10.0 ** rng.uniform(-5, -1), us


def at(values):
    return values.ctypes.data_as(DOUBLES)
