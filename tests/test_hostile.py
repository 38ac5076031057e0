"""Wrong input over the whole public vocabulary: refused, by type or by value, in words that name the quantity.

`python tests/test_hostile.py` prints what each says, as a Markdown table.
"""

import inspect
import math
import re
import warnings
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_array_equal

import mdr
from mdr.closed_forms.full_slip import full_slip

NAN, INF = math.nan, math.inf
RUBBER = mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-3)
MOTION = mdr.NormalOscillation(u_z0=6e-6, du_z=2e-6, omega=300.0)
BALL = mdr.Paraboloid(R=5e-3)
CASE = mdr.SlidingContact(BALL, RUBBER, 0.5, MOTION)
V_C = 1e-3
NINE = np.linspace(0, 1e-6, 9)


def contact(**changes):
    parts = {"indenter": BALL, "material": RUBBER, "mu_0": 0.5, "oscillation": MOTION} | changes
    return mdr.SlidingContact(**parts)


def bent(r):
    """A ring: f falls again towards larger radii."""
    return np.sin(1e3 * r) * 1e-3


class Sly(float):
    """A number in name."""

    def __float__(self):
        return NAN


#: call, expected exception, what the message must contain
HOSTILE = [
    # indenters
    (lambda: mdr.Indenter(), TypeError, "Indenter is no shape"),
    (lambda: mdr.FlatPunch(a=0), ValueError, "a must be positive"),
    (lambda: mdr.FlatPunch(a=-1e-3), ValueError, "a must be positive"),
    (lambda: mdr.FlatPunch(a=NAN), ValueError, "a must be a finite number"),
    (lambda: mdr.FlatPunch(a=INF), ValueError, "a must be a finite number"),
    (lambda: mdr.FlatPunch(a="1 mm"), TypeError, "a must be a real number"),
    (lambda: mdr.FlatPunch(a=None), TypeError, "a must be a real number"),
    (lambda: mdr.FlatPunch(a=np.array([1e-3])), TypeError, "a must be a real number"),
    (lambda: mdr.FlatPunch(a=Sly(1.0)), ValueError, "a must be a finite number"),
    (lambda: mdr.Cone(theta=np.pi / 2), ValueError, "theta must lie between"),
    (lambda: mdr.Cone(theta=-0.1), ValueError, "theta must lie between"),
    (lambda: mdr.Cone(theta=30), ValueError, "theta must lie between"),
    (lambda: mdr.Cone(theta=0.1 + 0j), TypeError, "theta must be a real number"),
    (lambda: mdr.Paraboloid(R=True), TypeError, "R must be a real number"),
    (lambda: mdr.Paraboloid(R=-5e-3), ValueError, "R must be positive"),
    (lambda: mdr.PowerLaw(n=0, c=1), ValueError, "n must be positive"),
    (lambda: mdr.PowerLaw(n=2, c=NAN), ValueError, "c must be a finite number"),
    (lambda: mdr.PowerLaw(n=[2], c=1), TypeError, "n must be a real number"),
    (lambda: mdr.Profile("r**2"), TypeError, "f must be a function"),
    (lambda: mdr.Profile(lambda r: r + 1), ValueError, "f(0) must be 0"),
    (lambda: mdr.Profile(lambda r: r**2, kinks=(-1e-3,)), ValueError, "kinks must be positive"),
    (lambda: mdr.Profile(lambda r: r**2, kinks="tip"), TypeError, "kinks must be"),
    (lambda: mdr.Profile(lambda r: r**2, r_max=0), ValueError, "r_max must be positive"),
    (lambda: mdr.Profile(lambda r: r**2, name=3), TypeError, "name must be a string"),
    (lambda: mdr.Profile(bent, r_max=5e-3).contact_radius(8e-4), ValueError, "annular"),
    (lambda: mdr.Profile(lambda r: r**2, r_max=1e-3).contact_radius(1.0), ValueError, "d = 1 m is deeper than"),
    (lambda: mdr.Profile(lambda r: r * NAN), ValueError, "f(0) must be"),
    (lambda: BALL.contact_radius(NAN), ValueError, "d must be finite"),
    (lambda: BALL.contact_radius([1e-6, INF]), ValueError, "d must be finite"),
    (lambda: BALL.contact_radius("deep"), TypeError, "d must be"),
    (lambda: BALL.contact_radius(1j), TypeError, "d must be"),
    (lambda: BALL.contact_radius(None), TypeError, "d must be"),
    (lambda: BALL.force(1e-6, E_star=0), ValueError, "E_star must be positive"),
    (lambda: BALL.force(1e-6, E_star="soft"), TypeError, "E_star must be"),
    (lambda: BALL.stiffness(1e-6, E_star=NAN), ValueError, "E_star must be"),
    (lambda: BALL.profile_3d(NAN), ValueError, "r must be finite"),
    (lambda: BALL.profile_1d([0, -INF]), ValueError, "x must be finite"),
    (lambda: BALL.profile_1d([[1e-3], [1e-3, 2e-3]]), TypeError, "x must be"),
    (lambda: BALL.pressure(INF, 1e-6, 1e6), ValueError, "r must be finite"),
    (lambda: BALL.pressure(1e-4, NAN, 1e6), ValueError, "d must be"),
    (lambda: BALL.pressure(1e-4, 1e-6, -1), ValueError, "E_star must be positive"),
    # the rest of the catalogue
    (lambda: mdr.Sphere(R=0), ValueError, "R must be positive"),
    (lambda: mdr.Sphere(R=1e-3).contact_radius(1.0), ValueError, "deeper than Sphere can be pressed"),
    (lambda: mdr.Ellipsoid(R=1e-3, k=NAN), ValueError, "k must be a finite number"),
    (lambda: mdr.Hyperboloid(h=-1, c=1), ValueError, "h must be positive"),
    (lambda: mdr.TruncatedCone(b=0, theta=0.1), ValueError, "b must be positive"),
    (lambda: mdr.TruncatedParaboloid(b=1e-3, R="5 mm"), TypeError, "R must be a real number"),
    (lambda: mdr.RoundedPunch(b=INF, R=1), ValueError, "b must be a finite number"),
    (lambda: mdr.CappedCone(b=1e-3, theta=2), ValueError, "theta must lie between"),
    (lambda: mdr.CappedParaboloid(R1=1e-3, R2=5e-3, b=1e-4), ValueError, "R2"),
    (lambda: mdr.ConstantPressure(a_0=1e-3, d_0=0), ValueError, "d_0 must be positive"),
    (lambda: mdr.ConcavePunch(a=1e-3, R=0.1).contact_radius(1e-6), ValueError, "ring"),
    (lambda: contact(indenter=mdr.ConcavePunch(a=1e-3, R=0.2)), ValueError, "its middle presses only from"),
    (lambda: mdr.SampledProfile([0, 1e-3], [0, NAN]), ValueError, "f must be finite"),
    (lambda: mdr.SampledProfile([0, 2e-3, 1e-3], [0, 1e-6, 2e-6]), ValueError, "r must"),
    (lambda: mdr.SampledProfile([0, 1e-3], [0, 1e-6, 2e-6]), ValueError, "r"),
    (lambda: mdr.FromForce(NINE, -NINE, 1e6), ValueError, "F must"),
    (lambda: mdr.FromForce(NINE, NINE**0.5, 1e6), ValueError, "F"),
    (lambda: mdr.FromForce(NINE, NINE**1.5, NAN), ValueError, "E_star must be"),
    # materials with memory
    (lambda: mdr.StandardLinearSolid(3e6, -1, 1e-3, 0.5), ValueError, "E_1 must not be negative"),
    (lambda: mdr.StandardLinearSolid(3e6, 1e6, 0, 0.5), ValueError, "tau_1 must be positive"),
    (lambda: mdr.StandardLinearSolid(0, 0, 1e-3, 0.5), ValueError, "nothing carries a load"),
    (lambda: mdr.Prony(3e6, [(1e6, NAN)], 0.5), ValueError, "arms[0] relaxation time must be a finite number"),
    (lambda: mdr.Prony(3e6, [(1e6, 1), (-1e6, 1)], 0.5), ValueError, "arms[1] modulus must not be negative"),
    (lambda: mdr.Prony(3e6, [1e6], 0.5), TypeError, "arms must be a sequence of pairs"),
    (lambda: mdr.Prony(3e6, [(1, 2, 3)], 0.5), ValueError, "arms[0] must be a pair"),
    (lambda: mdr.Prony(3e6, 5, 0.5), TypeError, "arms must be a sequence of pairs"),
    (lambda: mdr.Prony(0, [(1e6, 1)], 0.5, tau=1), ValueError, "tau must be 0 where E_inf = 0"),
    (lambda: contact(material=mdr.Prony(0, [(1e6, 1)], 0.5)), ValueError, "E_inf = 0: a mean load relaxes"),
    (lambda: mdr.Prony.fit([1, 2], [1e6, NAN], [0, 0], nu=0.5), ValueError, "storage must be finite"),
    (lambda: mdr.Prony.fit([1, 2], [1e6, 1e6], [0, -1], nu=0.5), ValueError, "loss must not be negative"),
    (lambda: mdr.Prony.fit([1], [1e6, 1e6], [0, 1], nu=0.5), ValueError, "lists of one length"),
    (lambda: mdr.Prony.power_law(modulus=1, exponent=1.2, omega=(1, 9), nu=0), ValueError, "exponent must lie"),
    (lambda: mdr.Prony.power_law(modulus=1, exponent=0.2, omega=(9, 1), nu=0), ValueError, "omega must be a range"),
    (lambda: mdr.Prony.read("arms.txt"), (ValueError, OSError), "arms.txt"),
    (lambda: RUBBER.creep_compliance(-1), ValueError, "t must not be negative"),
    (lambda: RUBBER.relaxation_modulus(NAN), ValueError, "t must be finite"),
    # materials
    (lambda: mdr.Elastic(E=0, nu=0.3), ValueError, "E must be positive"),
    (lambda: mdr.Elastic(E=1e6, nu=0.51), ValueError, "nu must lie in"),
    (lambda: mdr.Elastic(E=1e6, nu=-1), ValueError, "nu must lie in"),
    (lambda: mdr.Elastic(E=1e6, nu=NAN), ValueError, "nu must be a finite number"),
    (lambda: mdr.KelvinVoigt(E=1e6, nu=0.5, tau=-1e-3), ValueError, "tau must not be negative"),
    (lambda: mdr.KelvinVoigt(E=1e6, nu=0.5, tau=INF), ValueError, "tau must be a finite number"),
    (lambda: mdr.KelvinVoigt(E="3 MPa", nu=0.5, tau=0), TypeError, "E must be a real number"),
    (lambda: mdr.KelvinVoigt.from_shear(G=-1, eta=1, nu=0.5), ValueError, "G must be positive"),
    (lambda: mdr.KelvinVoigt.from_shear(G=1e6, eta=NAN, nu=0.5), ValueError, "eta must be"),
    (
        lambda: mdr.KelvinVoigt.from_loss_tangent(E=1e6, nu=0.5, tan_delta=-0.1, omega=1),
        ValueError,
        "tan_delta must not be negative",
    ),
    (
        lambda: mdr.KelvinVoigt.from_loss_tangent(E=1e6, nu=0.5, tan_delta=0.1, omega=0),
        ValueError,
        "omega must be positive",
    ),
    (lambda: mdr.ElasticPair(E_1=1e9, nu_1=0.3, E_2=-1, nu_2=0.3), ValueError, "E_2 must be positive"),
    (lambda: mdr.ElasticPair(E_1=1e9, nu_1=0.7, E_2=1e9, nu_2=0.3), ValueError, "nu_1 must lie in"),
    (lambda: RUBBER.dynamic_modulus(NAN), ValueError, "omega must be finite"),
    (lambda: RUBBER.loss_tangent(INF), ValueError, "omega must be finite"),
    # motion and pull
    (lambda: mdr.NormalOscillation(u_z0=NAN, du_z=1e-6, omega=1), ValueError, "u_z0 must be a finite number"),
    (lambda: mdr.NormalOscillation(u_z0=1e-6, du_z=0, omega=1), ValueError, "du_z must be positive"),
    (lambda: mdr.NormalOscillation(u_z0=1e-6, du_z=1e-6, omega=-1), ValueError, "omega must be positive"),
    (lambda: mdr.NormalOscillation(u_z0=-2e-6, du_z=1e-6, omega=1), ValueError, "u_z0 + du_z = -1e-06 m: the"),
    (lambda: mdr.NormalOscillation(u_z0=-1e-6, du_z=1e-6, omega=1), ValueError, "never touches"),
    (lambda: mdr.NormalOscillation(u_z0="deep", du_z=1e-6, omega=1), TypeError, "u_z0 must be a real number"),
    (lambda: mdr.PeriodicMotion(1, 1e-6), ValueError, "nothing oscillates"),
    (lambda: mdr.PeriodicMotion(1, 1e-6, cos=(NAN,)), ValueError, "cos[0] must be a finite number"),
    (lambda: mdr.PeriodicMotion(1, 1e-6, sin=None), TypeError, "sin must be a list"),
    (lambda: mdr.PeriodicMotion(1, -1e-6, sin=(1e-7,)), ValueError, "never touches"),
    (lambda: mdr.PeriodicMotion.of([1.0], 1), ValueError, "u_z must be a list of at least 3"),
    (lambda: mdr.LoadOscillation(0, 1, 1), ValueError, "F_z0 must be positive"),
    (lambda: mdr.LoadOscillation(1, 1, 1), ValueError, "dF_z = 1 N must be less than"),
    (lambda: mdr.LoadOscillation(1, NAN, 1), ValueError, "dF_z must be a finite number"),
    (
        lambda: mdr.resolved(contact(indenter=mdr.Sphere(1e-6), oscillation=mdr.LoadOscillation(9, 1, 1))),
        ValueError,
        "carries",
    ),
    # normal contact alone, and a pull at fixed depth
    (lambda: mdr.indent(BALL, RUBBER, [0, 1]), (TypeError, ValueError), "u_z"),
    (lambda: mdr.indent(BALL, RUBBER, [0, 1], [0, 1], F_z=[0, 1]), (TypeError, ValueError), "F_z"),
    (lambda: mdr.indent(BALL, RUBBER, [0, 1], [0, NAN]), ValueError, "u_z must be finite"),
    (lambda: mdr.indent(BALL, RUBBER, [1, 0], [0, 1e-6]), ValueError, "t must"),
    (lambda: mdr.indent(BALL, RUBBER, [0, 1], F_z=[0, -1]), ValueError, "F_z must not be negative"),
    (lambda: mdr.indent("ball", RUBBER, [0, 1], [0, 1e-6]), TypeError, "indenter"),
    (lambda: mdr.partial_slip(BALL, RUBBER, 0, 1e-6, 1e-7), ValueError, "mu_0 must be positive"),
    (lambda: mdr.partial_slip(BALL, RUBBER, 0.5, 1e-6, -1e-7), ValueError, "u_x must not be negative"),
    (lambda: mdr.surface_fields(None), TypeError, "source"),
    (lambda: mdr.SpringPull(k_x=0), ValueError, "k_x must be positive"),
    (lambda: mdr.SpringPull(k_x=INF), ValueError, "k_x must be a finite number"),
    (lambda: mdr.SpringPull(k_x=1e4, m=-0.1), ValueError, "m must not be negative"),
    (lambda: mdr.SpringPull(k_x=1e4, c_x=NAN), ValueError, "c_x must be a finite number"),
    (lambda: mdr.SpringPull(k_x=None), TypeError, "k_x must be a real number"),
    # the contact
    (lambda: contact(mu_0=0), ValueError, "mu_0 must be positive"),
    (lambda: contact(mu_0=-0.3), ValueError, "mu_0 must be positive"),
    (lambda: contact(mu_0=NAN), ValueError, "mu_0 must be a finite number"),
    (lambda: contact(mu_0=[0.5]), TypeError, "mu_0 must be a real number"),
    (lambda: contact(indenter="ball"), TypeError, "indenter must be of kind Indenter"),
    (lambda: contact(indenter=mdr.Paraboloid), TypeError, "write Paraboloid(...)"),
    (lambda: contact(material=3e6), TypeError, "material must be of kind Material"),
    (lambda: contact(oscillation=None), TypeError, "oscillation must be of kind Motion"),
    (lambda: contact(pull=mdr.RigidPull), TypeError, "write RigidPull(...)"),
    (lambda: contact(pull=1e4), TypeError, "pull must be of kind Pull"),
    (lambda: contact(indenter=mdr.Profile(lambda r: r**2, r_max=1e-5)), ValueError, "d = 8e-06 m is deeper than"),
    # springs
    (lambda: mdr.SpringArray.of(CASE, 15), ValueError, "n_springs must be at least 16"),
    # a run
    (lambda: mdr.slide(CASE, 0), ValueError, "static_cof(case)"),
    (lambda: mdr.slide(CASE, -V_C), ValueError, "v_0 must be positive"),
    (lambda: mdr.slide(CASE, NAN), ValueError, "v_0 must be a finite number"),
    (lambda: mdr.slide(CASE, INF), ValueError, "v_0 must be a finite number"),
    (lambda: mdr.slide(CASE, np.array([V_C])), TypeError, "v_0 must be a real number"),
    (lambda: mdr.slide(CASE, V_C + 0j), TypeError, "v_0 must be a real number"),
    (lambda: mdr.slide(CASE, V_C, n_springs=31), ValueError, "n_springs must be at least 32"),
    (lambda: mdr.slide(CASE, V_C, n_springs=64.0), TypeError, "n_springs must be a whole number"),
    (lambda: mdr.slide(CASE, V_C, n_springs=True), TypeError, "n_springs must be a whole number"),
    (lambda: mdr.slide(CASE, V_C, n_springs=10**9), ValueError, "more than memory holds"),
    (lambda: mdr.slide(CASE, V_C, n_periods=20_000, record=10_000), ValueError, "more than memory holds"),
    (lambda: mdr.slide(CASE, V_C, lump="no"), TypeError, "lump must be True or False"),
    (lambda: mdr.slide(CASE, V_C, steps_per_period=8), ValueError, "steps_per_period must be at least 32"),
    (lambda: mdr.slide(CASE, V_C, steps_per_period="fine"), TypeError, "steps_per_period must be a whole number"),
    (lambda: mdr.slide(CASE, V_C, n_periods=0), ValueError, "n_periods must be at least 1"),
    (lambda: mdr.slide(CASE, V_C, n_periods=INF), TypeError, "n_periods must be a whole number"),
    (lambda: mdr.slide(CASE, V_C, record=-1), ValueError, "record must be at least 0"),
    (lambda: mdr.slide(CASE, V_C, record=None), TypeError, "record must be a whole number"),
    (lambda: mdr.slide(CASE, V_C, n_periods=2, record=3), ValueError, "record = 3 periods cannot be kept"),
    (lambda: mdr.slide(CASE, V_C, start="zero"), ValueError, "start must be"),
    (lambda: mdr.slide(CASE, V_C, start=None), (TypeError, ValueError), "start must be"),
    (lambda: mdr.slide(CASE, V_C, start=["rest"]), (TypeError, ValueError), "start must be"),
    # curves, measurement, verdict, closed forms
    (lambda: mdr.cof_curve(CASE, []), ValueError, "v_0 must be"),
    (lambda: mdr.cof_curve(CASE, [V_C, NAN]), ValueError, "v_0 must be finite"),
    (lambda: mdr.cof_curve(CASE, [-V_C]), ValueError, "v_0 must not be negative"),
    (lambda: mdr.cof_curve(CASE, [[V_C]]), ValueError, "v_0 must be a list of velocities"),
    (lambda: mdr.cof_curve(CASE, V_C, method="exact"), ValueError, "method must be"),
    (lambda: mdr.measure_critical_velocity(CASE, start="full"), ValueError, "start must be"),
    (lambda: mdr.verdict(CASE, within=NAN), ValueError, "within must be a finite number"),
    (lambda: mdr.verdict(CASE, within=1), ValueError, "within must lie between 0 and 1, got 1.0"),
    (lambda: mdr.verdict(CASE, within="1%"), TypeError, "within must be a real number"),
    # studies
    (lambda: mdr.sweep(BALL, {"v_0": [V_C]}), TypeError, "case must be a SlidingContact"),
    (lambda: mdr.sweep(CASE, {}), ValueError, "axes must name at least one path"),
    (lambda: mdr.sweep(CASE, [V_C]), TypeError, "axes must map paths to values"),
    (lambda: mdr.sweep(CASE, {"v_o": [V_C]}), ValueError, "v_o is no path of this case; did you mean v_0?"),
    (lambda: mdr.sweep(CASE, {"v_0": []}), ValueError, "v_0 has no values"),
    (lambda: mdr.sweep(CASE, {"v_0": V_C}), TypeError, "v_0 must be a list of values"),
    (lambda: mdr.sweep(CASE, {"v_0": [V_C, NAN]}), ValueError, "v_0 must be finite"),
    (lambda: mdr.sweep(CASE, {"v_0": [-V_C]}), ValueError, "v_0 must not be negative"),
    (lambda: mdr.sweep(CASE, {"v_0": [V_C, V_C]}), ValueError, "v_0 has the value 0.001 twice"),
    (lambda: mdr.sweep(CASE, {"pull.m": [1.0]}), ValueError, "RigidPull has none"),
    (lambda: mdr.sweep(CASE, {"indenter": ["ball"]}), TypeError, "indenter must be a list of records"),
    (lambda: mdr.sweep(CASE, {"mu_0": [0.5]}), ValueError, 'cof needs a velocity: give an axis "v_0"'),
    (lambda: mdr.sweep(CASE, {"v_0": [V_C]}, quantities=["coff"]), ValueError, "did you mean cof?"),
    (lambda: mdr.sweep(CASE, {"v_0": [V_C]}, quantities="cof"), TypeError, "quantities must be a list of names"),
    (lambda: mdr.sweep(CASE, {"v_0": [V_C]}, shard="1/2"), ValueError, "a shard needs a store"),
    (lambda: mdr.sweep(CASE, {"v_0": [V_C]}, executor="threads"), TypeError, "executor must be a concurrent"),
    (lambda: mdr.sweep(CASE, {"v_0": [V_C]}, chunk_seconds=0), ValueError, "chunk_seconds must be positive"),
    (lambda: mdr.sweep(CASE, {"v_0": [V_C]}, n_springs=8), ValueError, "n_springs must be at least 32"),
    (lambda: mdr.cof_curve(CASE, [V_C], steps_per_period=8), ValueError, "steps_per_period must be at least 32"),
    (lambda: mdr.Quantity("a b", "-", abs), ValueError, "name must be of letters"),
    (lambda: mdr.Quantity("depth", "m", 3.0), TypeError, "of must be a function"),
    # files
    (lambda: mdr.parse_case("mu_0 = nan"), ValueError, "mu_0 must be a finite number"),
    (lambda: mdr.parse_case("mu_0 = 0.5"), ValueError, "[indenter] is missing"),
    (lambda: mdr.read_case("/nowhere/case.toml"), ValueError, "/nowhere/case.toml"),
    (lambda: mdr.write_case(contact(indenter=mdr.Profile(lambda r: r**2 / 1e-2))), ValueError, "Profile"),
]


#: not yet refused, or not by name
OPEN = [
    (lambda: mdr.FlatPunch(a=10**400), (ValueError, TypeError), "a must be"),
    (lambda: RUBBER.dynamic_modulus("fast"), TypeError, "omega must be"),
    (lambda: MOTION.u_z(NAN), ValueError, "t must be finite"),
    (lambda: MOTION.u_z_dot("now"), TypeError, "t must be"),
    (lambda: mdr.SpringPull(k_x=1e4).receptance(NAN), ValueError, "omega must be finite"),
    (lambda: mdr.SpringArray.of(CASE, 100.5), TypeError, "n_springs must be"),
    (lambda: mdr.SpringArray.of(CASE, "many"), TypeError, "n_springs must be"),
    (lambda: mdr.SpringArray.of(BALL), TypeError, "case must be"),
    (lambda: mdr.slide(BALL, V_C), TypeError, "case must be"),
    (lambda: mdr.cof_curve(CASE, "slow"), TypeError, "v_0 must be"),
    (lambda: mdr.cof_curve(CASE, None), TypeError, "v_0 must be"),
    (lambda: mdr.cof_curve(CASE, [1j]), TypeError, "v_0 must be"),
    (lambda: mdr.cof_curve("case", V_C), TypeError, "case must be"),
    (lambda: mdr.measure_critical_velocity(None), TypeError, "case must be"),
    (lambda: mdr.verdict(MOTION), TypeError, "case must be"),
    (lambda: mdr.critical_velocity(BALL), TypeError, "case must be"),
    (lambda: mdr.static_cof(0.5), TypeError, "case must be"),
    (lambda: mdr.full_slip_critical_velocity(mdr.SlidingContact), TypeError, "case must be"),
    (lambda: mdr.parse_case(3), TypeError, "text must be"),
    (lambda: mdr.write_case(BALL), TypeError, "case must be"),
    (lambda: full_slip(CASE, n_t=0), ValueError, "n_t must be"),
    (lambda: full_slip(CASE, n_t=64.5), TypeError, "n_t must be"),
]


def source_of(call):
    """The text of each lambda, in the order of the table."""
    return _SOURCES[call.__code__.co_firstlineno]


def _sources():
    lines, start = inspect.getsourcelines(inspect.getmodule(contact))
    return {
        number: re.sub(r"^\(?lambda: (.*?)(, \(?(Type|Value)Error.*)?,?$", r"\1", line.strip())
        for number, line in enumerate(lines, max(start, 1))
    }


_SOURCES = _sources()


def test_the_table_is_long_and_each_call_is_there_once():
    calls = [source_of(call) for call, _, _ in HOSTILE + OPEN]
    assert len(calls) >= 45
    assert len(set(calls)) == len(calls)


@pytest.mark.parametrize(("call", "kind", "words"), HOSTILE, ids=[source_of(call) for call, _, _ in HOSTILE])
def test_wrong_input_is_refused_by_name(call, kind, words):
    check_refused(call, kind, words)


@pytest.mark.parametrize(("call", "kind", "words"), OPEN, ids=[source_of(call) for call, _, _ in OPEN])
def test_what_was_once_let_through(call, kind, words):
    check_refused(call, kind, words)


def check_refused(call, kind, words):
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # a warning on the way is no refusal
        with pytest.raises(kind) as caught:
            call()
    message = str(caught.value)
    assert words in message
    assert "\n" not in message.strip() or isinstance(caught.value, mdr.CaseFileError)
    assert len(message) < 400


def test_what_is_right_passes():
    """The same calls with sound values: the table refuses the wrong, not everything."""
    case = contact(indenter=mdr.Profile(lambda r: r**2 / 1e-2), mu_0=np.float64(0.5))
    run = mdr.slide(case, np.float32(1e-4), n_springs=np.int64(32), steps_per_period=64, n_periods=9, record=1)
    assert 0 < run.cof < 0.5
    assert mdr.NormalOscillation(u_z0=-1e-6, du_z=2e-6, omega=1).u_z_dot(0.0) == 0
    assert mdr.Elastic(E=1, nu=0).mindlin_ratio == 1
    assert mdr.SpringPull(k_x=1).receptance(0) == 1


def test_a_pull_slower_than_rounding_is_its_limit_in_a_curve_and_refused_by_a_run():
    with pytest.raises(ValueError, match="rounding hides the motion"):
        mdr.slide(CASE, 1e-12 * V_C)
    for case in (CASE, replace(CASE, pull=mdr.RigidPull())):
        curve = mdr.cof_curve(case, [1e-30, 1e-12 * V_C])
        assert_array_equal(curve.cof, mdr.static_cof(case))
        assert_array_equal(curve.v_0, [1e-30, 1e-12 * V_C])


@pytest.mark.parametrize("v_hat", [1e-8, 1e-6, 1e6, 1e12])
def test_extreme_velocities_give_numbers(v_hat):
    """Legal however extreme: a friction between the static limit and mu_0, finite in every field."""
    run = mdr.slide(CASE, v_hat * V_C, n_springs=32, steps_per_period=64, n_periods=20)
    assert 0 <= run.cof <= CASE.mu_0 * (1 + 1e-9)
    for name in ("cof_error", "stick_share", "least_slip", "mean_F_x", "mean_F_z"):
        assert math.isfinite(getattr(run, name)), name
    for name in ("pull_work", "normal_work", "friction_loss", "viscous_loss", "damper_loss", "stored_change"):
        assert math.isfinite(getattr(run.energy_balance, name)), name


if __name__ == "__main__":
    print("| input | answer |\n| --- | --- |")
    for call, _, _ in HOSTILE + OPEN:
        try:
            answer = f"**accepted**: {call()!r}"
        except Exception as error:
            answer = f"{type(error).__name__}: {error}"
        cell = " ".join(answer.split()).replace("|", "\\|")
        print(f"| `{source_of(call)}` | {cell} |")
