"""Groups are what counts, each of them; that nothing else does, test_dimensionless asks of what a run sees.

The groups are shape, u_z0/du_z, omega tau, v_0/(mu_0 kappa omega du_z), k_x/k_xc, omega_0/omega and c_x omega/k_xc.
"""

from dataclasses import replace

import pytest
from conftest import contact, unit_of_velocity
from numpy.testing import assert_allclose
from random_records import case_in_units

import mdr

KNOBS = {"n_springs": 96, "steps_per_period": 256, "n_periods": 24}  # any knobs will do, as long as both use them
#: the same arithmetic on other magnitudes rounds differently: 24 periods of 256 steps of 1e-16 each, and the springs
#: at the edge, whose place a - g(a) loses up to u_z0/du_z digits' worth, stay far below
TOLERANCE = 1e-9
BODY = {"k_ratio": 0.7, "omega_0_ratio": 1.6, "c_ratio": 0.06}


def cof(case, v_hat, **knobs):
    return mdr.slide(case, v_hat * unit_of_velocity(case), **(KNOBS | knobs)).cof / case.mu_0


@pytest.mark.parametrize("group", ["depth_ratio", "T", "k_ratio", "omega_0_ratio", "c_ratio", "v_hat", "shape"])
def test_every_group_counts(group):
    groups = {"shape": "paraboloid", "depth_ratio": 2.5, "T": 0.6, **BODY}
    changed = groups | ({"shape": "cone"} if group == "shape" else {})
    if group in groups and group != "shape":
        changed[group] = 1.05 * groups[group]
    v_hat = 0.5 * (1.05 if group == "v_hat" else 1)
    # five per cent of damping ratio move the COF by more than 1e-5, thousands of times the invariance's tolerance
    assert abs(cof(contact(**changed), v_hat) - cof(contact(**groups), 0.5)) > 1e-5


def test_measured_velocity_scales():
    """The whole chain of runs, not one of them."""
    case = contact("cone", 3.0, **BODY)
    v_c = mdr.measure_critical_velocity(case).v_c
    for length, time, force in ((1e-6, 1e-3, 1e-9), (6.0, 5.0, 7e6)):
        found = mdr.measure_critical_velocity(case_in_units(case, length, time, force))
        assert_allclose(found.v_c * time / length, v_c, rtol=TOLERANCE)


@pytest.mark.parametrize("n", [2, 3, 8])
def test_a_motion_as_harmonic_of_a_lower_frequency_is_the_same(n):
    """Steps are chosen for the oscillation: of half as many companions agreed by chance, 2.5e-5 from the limit."""
    case = contact("flat", 1 / 1.09)
    cos = (*(0.0,) * (n - 1), case.oscillation.du_z)
    motion = mdr.PeriodicMotion(case.omega / n, case.oscillation.u_z0, cos)
    one, other = (mdr.slide(each, 0.4 * unit_of_velocity(case)) for each in (case, replace(case, oscillation=motion)))
    assert other.steps_per_period == n * one.steps_per_period
    assert_allclose(other.cof, one.cof, rtol=TOLERANCE)


def test_E_does_not_drop_out_of_a_given_spring():
    """With k_x and m in SI the groups change with E: the invariance above is no triviality."""
    soft = contact("paraboloid", 2.5, **BODY)
    hard = replace(soft, material=replace(soft.material, E=1.3 * soft.material.E))
    assert abs(cof(soft, 0.5) - cof(hard, 0.5)) > 1e-3
