"""What is legal but unlikely is warned of, once, where a user asks; and nothing usual is."""

import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from conftest import contact
from numpy.testing import assert_allclose

import mdr
from mdr.case.doubts import doubts_of, edge
from mdr.files.examples import MATERIALS, MOTIONS, PULLS, SHAPES, example
from mdr.given.vary import case_at
from mdr.indenters.from_force import DEPTHS, FORCES
from mdr.normal.resolved import with_depth
from mdr.tools.fields import fields_of

USUAL = mdr.read_case(Path(__file__).parents[2] / "docs/example.toml")
STEEL = mdr.Elastic(2.1e11, 0.3)
#: what is set in the usual contact, and words of the doubt
ABSURD = {
    "a cone of 57 degrees": ({"indenter": mdr.Cone(theta=1.0)}, "slope 1.56"),
    "a sphere pressed four radii deep": ({"indenter": mdr.Sphere(R=5e-6)}, "slope"),
    "a paraboloid with a/R = 63": ({"indenter.R": 5e-9}, "slope 63.2"),
    "a punch pressed two radii deep": ({"indenter": mdr.FlatPunch(a=1e-5)}, "2 times the radius"),
    "du_z and u_z0 swapped": ({"oscillation.u_z0": 2e-6, "oscillation.du_z": 20e-6}, "du_z and u_z0 may be swapped"),
    "friction in per cent": ({"mu_0": 50.0}, "percentage"),
    "E = 3 for 3 MPa": ({"material.E": 3.0}, "softer than a gel: is a modulus in MPa"),
    "E = 210e12 for 210 GPa": ({"material": mdr.Elastic(2.1e14, 0.3)}, "stiffer than diamond"),
    "E in kPa": ({"material": mdr.Elastic(2e3, 0.5)}, "modulus in MPa, or k_x"),
    "a load that the modulus does not bear": (
        {"material": mdr.Elastic(2e3, 0.5), "oscillation": mdr.LoadOscillation(0.2, 0.02, USUAL.omega, 1e-6)},
        "slope",
    ),
    "R = 3 for 3 mm": ({"indenter": mdr.Sphere(R=3.0)}, "indenter: R = 3 m is 1 m or more: is it in mm"),
    "a steel ball pressed in by its radius": (
        {"indenter": mdr.Sphere(1e-4), "material": STEEL, "pull": mdr.RigidPull()},
        "no solid but rubber bears that",
    ),
    "omega = 20e3 for 20 kHz": (
        {"oscillation.omega": 20e3},
        "oscillation: omega = 20000 rad/s is a round number, and 3183.1 Hz is none: was a frequency of 20000 Hz meant",
    ),
    "an amplitude below an atom": ({"oscillation.du_z": 2e-12}, "oscillation: du_z = 2e-12 m is below the size of an"),
    "a load in mN": (
        {"oscillation": mdr.LoadOscillation(1e-9, 1e-10, USUAL.omega), "material": STEEL},
        "less than the size of an atom",
    ),
    "an amplitude too small": ({"oscillation.du_z": 5e-9}, "no effect"),
    "tau in ks": ({"material.tau": 1e-6}, "next to no effect: is tau"),
    "a shake too small": ({"shake": mdr.InPlaneOscillation(USUAL.omega, du_x=1e-9)}, "of the shake is 6.67e-05"),
    "an acceleration of which a tool breaks": (
        {"oscillation.omega": 4.01e7, "material": STEEL},
        r"the acceleration of the depth is 3.28e\+08 g",
    ),
    "waves in the contact": (
        {"oscillation.omega": 4.01e5, "material": mdr.Elastic(3e6, 0.5)},
        "shear waves in the half-space are at most 0.000495 m long at this frequency",
    ),
    "friction in kilo": ({"mu_0": 5e-4}, "that of a joint"),
    "a body in grams": ({"pull.m": 100.0}, "the weight of the body, 980.7 N, is 2.9"),
    "a damper of N s/mm": ({"pull.c_x": 4e3}, "damping ratio of the body is 44"),
    "tau in ms": ({"material.tau": 1.0}, "tau in ms"),
    "a modulus of a force curve in MPa": (
        {
            "indenter": mdr.FromForce(DEPTHS, FORCES, 4.0, tip="round"),
            "oscillation": mdr.NormalOscillation(1e-6, 1e-7, 300.0),
        },
        "indenter: E_star = 4 Pa is no modulus of a solid",
    ),
    "k_x a million times too small": ({"pull.k_x": 1e-3}, "k_x in N/mm"),
    "grams for kilograms": (
        {"oscillation": mdr.LoadOscillation(0.03, 0.003, USUAL.omega, 100.0)},
        "of m_z, 980.7 N, is 3.27e\\+04 times",
    ),
    "a spool that presses less deep than its roughness": (
        {
            "indenter": mdr.Sphere(1e-2),
            "material": STEEL,
            "oscillation": mdr.ConstantLoad(5.0),
            "pull": mdr.RigidPull(),
            "shake": mdr.InPlaneOscillation(1256.6, 1e-6),
        },
        r"the depth, 2.98e-07 m, is below the roughness of machined steel, .* take a rough face, RoughFace",
    ),
    "an ultrasonic amplitude below the roughness": (
        {
            "indenter": mdr.Sphere(1e-2),
            "material": STEEL,
            "oscillation": mdr.ConstantLoad(50.0),
            "pull": mdr.RigidPull(),
            "shake": mdr.InPlaneOscillation(163363.0, 0.35e-6),
        },
        "amplitude of the shake, 3.5e-07 m at 2.6e\\+04 Hz, is below the roughness",
    ),
    "a mass in wrong units": ({"pull.m": 1e-6}, "is it in the right unit"),
}


@pytest.mark.parametrize("what", ABSURD)
def test_an_absurd_contact_is_warned_of_and_computed(what):
    changed, words = ABSURD[what]
    case = case_at(USUAL, changed)
    with pytest.warns(mdr.PlausibilityWarning, match=words) as said:
        assert mdr.critical_velocity(case) > 0
    assert {one.filename for one in said} == {__file__}  # the user's line
    assert tuple(str(one.message) for one in said) == mdr.plausibility(case)


@pytest.mark.parametrize("changed", [
    {"indenter": mdr.Sphere(30e-9), "oscillation": mdr.NormalOscillation(2e-9, 5e-10, 6e5)},  # a tip: one asperity
    {"indenter": mdr.Sphere(1e-2), "oscillation": mdr.NormalOscillation(8e-6, 3e-7, 125663.7)},  # deeper than all
    {"indenter": mdr.RoughFace(1e-6, 1e-5), "oscillation": mdr.NormalOscillation(3e-7, 3e-8, 300.0)},
])  # fmt: skip
def test_of_roughness_nothing_is_said_where_it_is_not_felt_or_known(changed):
    case = case_at(USUAL, {"material": STEEL, "pull": mdr.RigidPull(), **changed})
    assert not [said for said in mdr.plausibility(case) if "rough" in said]


def ball(R, material, mu_0, motion, *more):
    return mdr.SlidingContact(mdr.Paraboloid(R), material, mu_0, motion, *more)


RADII = np.linspace(0, 3e-3, 31)
SOUND = {
    "docs": USUAL,
    "cone": mdr.SlidingContact(
        mdr.Cone(0.0127), mdr.Elastic(3e6, 0.5), 0.4, mdr.NormalOscillation(30e-6, 10e-6, 502.7)
    ),
    "steel": ball(5e-3, STEEL, 0.15, mdr.LoadOscillation(20.0, 5.0, 125663.7), mdr.SpringPull(1e5, 0.2)),
    "punch": mdr.SlidingContact(
        mdr.FlatPunch(2e-3), mdr.KelvinVoigt(2e9, 0.4, 1e-5), 0.3, mdr.NormalOscillation(1e-6, 2e-7, 3141.6)
    ),
    "shaken": ball(
        1e-2, mdr.KelvinVoigt(2e6, 0.5, 2e-4), 0.6, mdr.ConstantDepth(50e-6), mdr.RigidPull(),
        mdr.InPlaneOscillation(628.3, 20e-6),
    ),
    "profile": mdr.SlidingContact(
        mdr.SampledProfile(RADII, RADII**2 / 0.016), mdr.KelvinVoigt(3e6, 0.5, 1e-3), 0.5,
        mdr.NormalOscillation(20e-6, 5e-6, 188.5),
    ),
    "gel": ball(8e-3, mdr.KelvinVoigt(4e4, 0.5, 1e-3), 0.05, mdr.NormalOscillation(60e-6, 20e-6, 125.7)),
}  # fmt: skip
#: what is looked at: E, k_x, m and a load a thousand times off are most often another contact that may be meant
SCALED = ("mu_0", "R", "a", "r", "tau", "u_z0", "du_z", "omega", "dF_z", "du_x")


def scaled(case, part, key, factor):
    """The case with one number of it, or a profile, times the factor."""
    record = getattr(case, part)
    if key == "r":
        return case_at(case, {f"{part}.{one}": factor * np.array(getattr(record, one)) for one in ("r", "f")})
    return case_at(case, {f"{part}.{key}": factor * getattr(record, key)})


def slips():
    """Eighty slips: numbers a thousand times too great or too small, and frequencies given for angular ones."""
    for name, case in SOUND.items():
        parts = {part: record for part in ("friction", "indenter", "material", "oscillation", "shake")
                 if (record := getattr(case, part)) is not None}  # fmt: skip
        for part, record in parts.items():
            for key in SCALED:
                if key in fields_of(record) and getattr(record, key):
                    yield from ((f"{name}: {key} times {factor:g}", case, part, key, factor) for factor in (1e3, 1e-3))
    for hertz in (4e3, 20e3, 35e3, 40e3):
        yield f"omega = {hertz:g}", SOUND["steel"], "oscillation", "omega", hertz / SOUND["steel"].omega


def test_of_eighty_factors_of_a_thousand_seventy_five_are_seen():
    missed, seen = [], 0
    for what, case, *changed in slips():
        try:
            told = mdr.plausibility(scaled(case, *changed))
        except ValueError:  # refused outright
            told = ("refused",)
        seen += bool(told)
        missed += [] if told else [what]
    assert seen + len(missed) == 80
    assert missed == [
        "cone: omega times 0.001", "steel: omega times 0.001", "steel: dF_z times 0.001", "shaken: u_z0 times 0.001",
        "shaken: du_x times 1000",
    ]  # fmt: skip


def sensible(rng):
    """A contact such as is built: of rubber, a polymer or metal, whose waves are long and whose body is no wreck."""
    while True:
        kind = rng.integers(3)
        E = 10 ** rng.uniform(*((4.5, 7.5), (8.5, 9.7), (10.7, 11.6))[kind])
        slope = 10 ** rng.uniform(-2.5, (-0.5, -1.0, -1.6)[kind])
        a, alpha, mu_0 = 10 ** rng.uniform(-5, -2.3), 10 ** rng.uniform(-2, 0.3), 10 ** rng.uniform(-1.7, 0.2)
        omega, nu = 2 * np.pi * 10 ** rng.uniform(0.7, 4.6), (0.5, 0.4, 0.3)[kind]
        T = rng.choice([0.0, 10 ** rng.uniform(-2, 0.3)])
        of_body = ()  # a rigid pull
        if rng.integers(2):
            k, ratio, zeta = 10 ** rng.uniform(-3, 2), 10 ** rng.uniform(-1.5, 1), 10 ** rng.uniform(-2, 0)
            of_body = (k, ratio, 2 * zeta * k / ratio) if rng.integers(2) else (k, np.inf)
        shape = (mdr.Paraboloid(a / slope), mdr.Cone(np.arctan(slope)), mdr.FlatPunch(a))[rng.integers(3)]
        depth = float(shape.profile_1d(a)) if not isinstance(shape, mdr.FlatPunch) else slope * a
        waves = 2 * np.pi / omega * np.sqrt(E / 3e3)
        g = alpha * depth * omega**2 / 9.81
        deep = kind < 2 or min(depth, alpha * depth) > 1e-6  # a metal has roughness
        if waves < 20 * a or g > 1e5 or a / slope > 0.5 or depth * min(alpha, 1) < 1e-9 or not deep:
            continue
        case = contact(shape, 1 / alpha, T, *of_body, du_z=alpha * depth, omega=omega, mu_0=mu_0, nu=nu, E=E)
        force = float(shape.force(depth, case.material.E_star))
        if 9.81 * case.pull.coefficients[0] > 1e3 * force:
            continue
        if alpha < 0.9 and rng.integers(2):
            case = replace(case, oscillation=mdr.LoadOscillation(force, min(alpha, 0.5) * force, omega))
        return case


def test_nothing_is_said_of_five_hundred_sensible_contacts():
    rng = np.random.default_rng(1)
    cases = [sensible(rng) for _ in range(500)]
    assert [(case, said) for case in cases if (said := doubts_of(with_depth(case, moving=False)))] == []


def test_an_unstable_mass_under_its_load_is_warned_of_where_its_depth_is_asked_for():
    load = mdr.LoadOscillation(F_z0=1.0, dF_z=2.0, omega=314.0, m_z=0.1)
    case = mdr.SlidingContact(mdr.Sphere(5e-3), mdr.KelvinVoigt(3e6, 0.5, 6e-4), 0.8, load)
    with pytest.warns(mdr.PlausibilityWarning, match="dF_z = 2 N, is above its mean"):
        mdr.critical_velocity(case)
    with pytest.warns(mdr.PlausibilityWarning, match="unstable: a deviation grows 2.0"):
        mdr.full_slip_critical_velocity(case)


def test_a_mass_that_bounces_under_its_load_is_warned_of():
    case = beside_resonance(2.0, 1.5, mdr.Paraboloid(5e-3), 1e-3)
    with pytest.warns(mdr.PlausibilityWarning, match="leaves the surface in every period"):
        mdr.full_slip_critical_velocity(case)


def test_nothing_is_said_of_the_standing_examples():
    cases = [USUAL]
    cases += [example(shape, "Elastic", motion) for shape in SHAPES for motion in MOTIONS]
    cases += [example(material=material, motion=motion) for material in MATERIALS for motion in MOTIONS]
    cases += [example(pull=pull) for pull in PULLS]
    assert [(case, doubts_of(known)) for case in cases if doubts_of(known := mdr.resolved(case))] == []


def test_it_is_said_of_what_a_user_asks_and_not_of_what_the_package_asks_itself():
    steep = replace(USUAL, indenter=mdr.Cone(theta=1.0))
    doors = [mdr.critical_velocity, mdr.full_slip_critical_velocity, mdr.static_cof, mdr.resolved]
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        for door in doors:
            door(steep)
        mdr.slide(steep, 1e-3, n_periods=1)
        mdr.cof_curve(replace(steep, pull=mdr.RigidPull(), material=mdr.Elastic(3e9, 0.5)), [1e-3, 2e-3])
    assert [one.filename for one in said if "slope" in str(one.message)] == [__file__] * (len(doors) + 2)


def test_two_frequencies_are_each_their_own():
    """The frequency after which both repeat, here 10 Hz, is that of neither."""
    shake = mdr.InPlaneOscillation(omega=USUAL.omega * 16 / 15, du_x=1e-6)
    assert doubts_of(replace(USUAL, shake=shake, pull=mdr.SpringPull(k_x=1e5, m=0.01))) == ()
    lossy = mdr.KelvinVoigt(E=3e6, nu=0.5, tau=0.02)  # omega tau = 6.3, and 0.4 at the common frequency
    assert "omega tau = 6.7" in doubts_of(replace(USUAL, shake=shake, material=lossy))[0]


def test_studies_and_fits_warn_of_their_base_case():
    absurd = replace(USUAL, mu_0=50.0, material=mdr.Elastic(3e6, 0.5), pull=mdr.RigidPull())
    with pytest.warns(mdr.PlausibilityWarning, match="percentage"):
        mdr.sweep(absurd, {"v_0": [1.0]}, n_springs=32, steps_per_period=32)
    data = mdr.FrictionData([1e-3, 2e-3, 3e-3], [0.4, 0.45, 0.5])
    with pytest.warns(mdr.PlausibilityWarning, match="percentage"):
        mdr.fit(absurd, data, ["mu_0"])
    with pytest.warns(mdr.PlausibilityWarning, match="in per cent"):
        mdr.FrictionData([1e-3], [40.0])


@pytest.mark.parametrize("shape", SHAPES)
def test_the_slope_at_the_edge_is_that_of_the_shape(shape):
    indenter, d = SHAPES[shape], 2e-5
    a, slope = edge(indenter, d)
    r = a * (1 - np.array([1e-6, 3e-6]))
    f = np.asarray(indenter.profile_3d(r))
    assert_allclose(slope, abs(f[0] - f[1]) / (r[0] - r[1]), rtol=1e-3, atol=1e-6)  # rounding of f over 2e-6 a


def beside_resonance(detuning, share, shape, tau):
    """m_z omega² = detuning times the stiffness of the contact."""
    material = mdr.KelvinVoigt(3e6, 0.5, tau) if tau else mdr.Elastic(3e6, 0.5)
    F_z0, k_zc = (float(of(20e-6, material.E_star)) for of in (shape.force, shape.stiffness))
    load = mdr.LoadOscillation(F_z0, share * F_z0, 300.0, detuning * k_zc / 300.0**2)
    return mdr.SlidingContact(shape, material, 0.4, load)


@pytest.mark.parametrize("detuning", [0.95, 1.05, 1.3, 2.0])
@pytest.mark.parametrize("share", [0.005, 0.02])
@pytest.mark.parametrize("shape", [mdr.Cone(0.02), mdr.FlatPunch(1e-3)])
@pytest.mark.parametrize("tau", [0.0, 1e-4])
def test_near_the_resonance_of_a_load_the_closed_form_is_doubted_where_it_is_wrong(detuning, share, shape, tau):
    case = beside_resonance(detuning, share, shape, tau)
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        v_c = mdr.critical_velocity(case)
    doubted = any("natural frequency of m_z" in str(one.message) for one in said)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            off = abs(v_c / mdr.full_slip_critical_velocity(case) - 1)
        except ValueError:  # no periodic depth at all
            off = np.inf
    assert doubted or off < 0.03
    assert not doubted or off > 0.01
