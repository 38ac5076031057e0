"""What must not matter: at fixed dimensionless groups mu_0, E, nu and every unit drop out of cof/mu_0.

The groups are shape, u_z0/du_z, omega tau, v_0/(mu_0 kappa omega du_z), k_x/k_xc, omega_0/omega and c_x omega/k_xc.
"""

import math
from dataclasses import replace

import pytest
from conftest import contact, unit_of_velocity
from numpy.testing import assert_allclose

import mdr

KNOBS = {"n_springs": 96, "steps_per_period": 256, "n_periods": 24}  # any knobs will do, as long as both use them
#: the same arithmetic on other magnitudes rounds differently: 24 periods of 256 steps of 1e-16 each, and the springs
#: at the edge, whose place a - g(a) loses up to u_z0/du_z digits' worth, stay far below
TOLERANCE = 1e-9
BODY = {"k_ratio": 0.7, "omega_0_ratio": 1.6, "c_ratio": 0.06}
#: omega, du_z, E and the radius of contact at the mean depth
SIZES = {
    "AFM tip": (2 * math.pi * 3e5, 4e-11, 7e10, 2e-9),
    "rubber ball": (300.0, 2e-6, 3e6, 1e-3),
    "railway wheel": (60.0, 2e-5, 2.1e11, 6e-3),
    "unit contact": (1.0, 1.0, 1.0, 10.0),
    "millimetres and tonnes": (300.0, 2e-3, 3.0, 1.0),
}
PULLS = {
    "rigid elastic": (0.0, {}),
    "rigid Kelvin": (0.6, {}),
    "body elastic": (0.0, BODY),
    "body Kelvin": (0.6, BODY),
    "massless Kelvin": (0.6, {"k_ratio": 0.7, "omega_0_ratio": math.inf, "c_ratio": 0.3}),
}


def shape_of(name, a_0, depth):
    """The shape with contact radius a_0 at a depth."""
    return {
        "flat": lambda: mdr.FlatPunch(a=a_0),
        "cone": lambda: mdr.Cone(theta=math.atan(2 * depth / (math.pi * a_0))),
        "paraboloid": lambda: mdr.Paraboloid(R=a_0**2 / depth),
        "r4": lambda: mdr.PowerLaw(n=4, c=depth / (8 / 3 * a_0**4)),  # kappa_4 = 8/3
    }[name]()


def cof(case, v_hat, **knobs):
    return mdr.slide(case, v_hat * unit_of_velocity(case), **(KNOBS | knobs)).cof / case.mu_0


@pytest.mark.parametrize("pull", PULLS)
@pytest.mark.parametrize("shape", ["flat", "cone", "paraboloid", "r4"])
def test_units_and_sizes_drop_out(shape, pull):
    T, body = PULLS[pull]
    depth_ratio, v_hat = 1.7, 0.43
    values = {}
    for name, (omega, du_z, E, a_0) in SIZES.items():
        indenter = shape_of(shape, a_0, depth_ratio * du_z)
        case = contact(indenter, depth_ratio, T, **body, omega=omega, du_z=du_z, E=E)
        values[name] = cof(case, v_hat)
    assert 0.2 < values["rubber ball"] < 0.95  # partial slip, in which every group counts
    assert_allclose(list(values.values()), values["rubber ball"], rtol=0, atol=TOLERANCE)


def test_E_does_not_drop_out_of_a_given_spring():
    """With k_x and m in SI the groups change with E: the invariance above is no triviality."""
    soft = contact("paraboloid", 2.5, **BODY)
    hard = replace(soft, material=replace(soft.material, E=1.3 * soft.material.E))
    assert abs(cof(soft, 0.5) - cof(hard, 0.5)) > 1e-3


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
    """The whole chain of runs, not one of them: v_c over Eq. (1) is that of the rubber ball."""
    measured = []
    for omega, du_z, E, a_0 in (SIZES["rubber ball"], SIZES["AFM tip"], SIZES["railway wheel"]):
        case = contact(shape_of("cone", a_0, 3 * du_z), 3.0, 0.0, **BODY, omega=omega, du_z=du_z, E=E)
        measured.append(mdr.measure_critical_velocity(case).v_c / unit_of_velocity(case))
    assert_allclose(measured, measured[0], rtol=TOLERANCE)


@pytest.mark.parametrize("n", [2, 3, 8])
def test_a_motion_as_harmonic_of_a_lower_frequency_is_the_same(n):
    """Steps are chosen for the oscillation: of half as many companions agreed by chance, 2.5e-5 from the limit."""
    case = contact("flat", 1 / 1.09)
    cos = (*(0.0,) * (n - 1), case.oscillation.du_z)
    motion = mdr.PeriodicMotion(case.omega / n, case.oscillation.u_z0, cos)
    one, other = (mdr.slide(each, 0.4 * unit_of_velocity(case)) for each in (case, replace(case, oscillation=motion)))
    assert other.steps_per_period == n * one.steps_per_period
    assert_allclose(other.cof, one.cof, rtol=TOLERANCE)
