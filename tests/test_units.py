"""Any units will do: in other ones an answer is the same number, times what its own unit has become. Runs: tests/march.

A nanometre tip and a railway wheel give the same digits in scaled form.
"""

from functools import cache

import numpy as np
import pytest
from conftest import contact
from numpy.testing import assert_allclose
from random_records import case_in_units

import mdr

#: lengths, times and forces are so many times larger
UNITS = {"nanometres": (1e-6, 1e-6, 1e-9), "kilometres": (1e3, 1e5, 1e6), "lengths alone": (1e-9, 1.0, 1e-18)}
BODY = contact("paraboloid", 1.3, 0.5, 0.7, 1.6, 0.15)
SOLID = mdr.StandardLinearSolid(1e6, 9e6, 1e-2, 0.5)
LOADED = mdr.SlidingContact(mdr.Cone(theta=0.02), SOLID, 0.4, mdr.LoadOscillation(0.02, 0.01, 300.0))
PULSE = np.abs(np.sin(np.linspace(0, 1.5, 201) * np.pi))


def answers(case, length, time, force):
    """Each with its powers of length, time and force, and to how many digits it is the same."""
    shape, body, d = case.indenter, case.material, 2e-5 * length
    near = 1e-7 if isinstance(case.oscillation, mdr.LoadOscillation) else 1e-12  # whose depth is solved for
    yield mdr.critical_velocity(case), (1, -1, 0), near
    yield mdr.full_slip_critical_velocity(case), (1, -1, 0), near
    yield mdr.static_cof(case), (0, 0, 0), near
    t = np.linspace(0, 0.03, PULSE.size) * time
    pressed = mdr.indent(shape, body, t, d * PULSE, record=True)
    yield pressed.F_z, (0, 0, 1), 1e-11
    fields = mdr.surface_fields(pressed)
    yield fields.pressure, (-2, 0, 1), 1e-9
    yield fields.u_z, (1, 0, 0), 1e-11
    yield mdr.indent(shape, body, t, F_z=0.1 * force * PULSE).u_z, (1, 0, 0), 1e-9  # to 1e-12 of the force
    loop = mdr.tangential_loop(shape, body, case.mu_0, d, 4e-6 * length)
    yield loop.F_x, (0, 0, 1), 1e-9
    yield loop.loss, (1, 0, 1), 1e-9


@cache
def ours(case):
    return list(answers(case, 1.0, 1.0, 1.0))


@pytest.mark.parametrize("units", UNITS.values(), ids=UNITS)
@pytest.mark.parametrize("case", [BODY, LOADED], ids=["body", "load"])
def test_an_answer_in_other_units_is_the_same(case, units):
    theirs = answers(case_in_units(case, *units), *units)
    for (one, powers, near), (other, *_) in zip(ours(case), theirs, strict=True):
        scale = np.abs(one).max()
        assert_allclose(other / np.prod(np.power(units, powers)), one, rtol=0, atol=near * scale, err_msg=str(powers))
