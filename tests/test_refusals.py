"""Wrong input over the whole public vocabulary: refused, by type or by value, in words that name the quantity.

The rule of a field is data, so every field of every record is given what its rule must refuse; so is every number that
a function or an answer takes. What remains are relations between two values, and slips that people make at a keyboard.
"""

import math
import pickle
import warnings
from dataclasses import FrozenInstanceError, fields, is_dataclass, replace
from functools import partial
from inspect import signature
from types import SimpleNamespace

import numpy as np
import pytest

import mdr
from mdr.closed_forms.rigid_pull import average_friction
from mdr.tools.fields import example_of, facts_of, has_example

NAN, INF = math.nan, math.inf
BALL, RUBBER, SLED = mdr.Paraboloid(5e-3), mdr.KelvinVoigt(3e6, 0.5, 1e-3), mdr.SpringPull(2e4, 0.1, 4.0)
TAPPING = mdr.NormalOscillation(20e-6, 2e-6, 314.0)
CASE = mdr.SlidingContact(BALL, RUBBER, 0.5, TAPPING, SLED)
RIGID = replace(CASE, pull=mdr.RigidPull())
SOLID, LOAD = mdr.StandardLinearSolid(3e6, 3e6, 1e-3, 0.4), mdr.LoadOscillation(1e-3, 1e-4, 314.0)
SOME = mdr.FrictionData([1e-4, 2e-4, 3e-4], [0.4, 0.45, 0.5])
CONE = 'mu_0 = 0.5\n[indenter]\nshape = "Cone"\n'
NINE, SHAKE = np.linspace(0, 1e-6, 9), mdr.InPlaneOscillation(300.0, 1e-6)
PUSHED = mdr.NormalOscillation(20e-6, 30e-6, 314.0)
LOST = replace(CASE, indenter=mdr.FlatPunch(1e-3), material=mdr.Elastic(3e6, 0.5), oscillation=PUSHED)
BAND = mdr.Spectrum.band(rms=2e-6, f_low=30.0, f_high=80.0)
STUDY = mdr.sweep(RIGID, {"v_0/v_c": [0.5], "indenter": [BALL]}, quantities=["cof", "v_c"])
SHAKEN = replace(RIGID, shake=mdr.InPlaneOscillation(314.0, du_x=1e-6))
STILL = replace(RIGID, material=mdr.Elastic(3e6, 0.5), oscillation=mdr.ConstantDepth(2e-5), shake=SHAKEN.shake)
CROSSED = replace(STILL, shake=mdr.InPlaneOscillation(314.0, du_y=4e-6))
AT_PULL = mdr.InPlaneOscillation(314.0, 1e-6, at="pull")
ON_RESONANCE = replace(SHAKEN, pull=mdr.SpringPull(k_x=2e4, m=2e4 / 314.0**2), shake=AT_PULL)
TOUCHING = replace(RIGID, oscillation=mdr.NormalOscillation(-4e-7, 2e-6, 314.0))
MOVED = partial(
    mdr.slide_record, indenter=BALL, material=STILL.material, mu_0=0.5, t=[0, 1, 2], u_x=[0, 1e-6, 0], u_z=1e-6
)
RIG = partial(mdr.rig, indenter=mdr.Sphere(5e-3), material=STILL.material, mu_0=0.8, frequency=50.0, load=1.0)
GRID = np.linspace(0, 2e-3, 201)
TABLE = mdr.sweep(RIGID, {"alpha": [0.1, 0.2], "mu_0": [0.5], "T": [0.1]}, quantities=["v_c"])
T = np.arange(200) / 200
WAVE = np.sin(2 * np.pi * 20 * T)


class Sly(float):
    """A number in name."""

    def __float__(self):
        return NAN


def refused(call, kind=(TypeError, ValueError)):
    """The refusal: of this kind, without a warning on the way, and one line that a person reads."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", mdr.PlausibilityWarning)  # some are absurd too
        with pytest.raises(kind) as caught:
            call()
    message = str(caught.value)
    assert 0 < len(message) < 400, message
    assert "\n" not in message.strip() or isinstance(caught.value, mdr.CaseFileError)
    return caught.value


# --- every field of every record, by the rule that stands at it ---

NO_NUMBER = [(one, TypeError, "must be a real number, got") for one in (True, "1 mm", None, 1j, [1.0], np.ones(1))]
NOT_FINITE = [(one, ValueError, "must be a finite number, got") for one in (NAN, INF, -INF, 10**400, Sly(1.0))]
NUMBER = [*NO_NUMBER, *NOT_FINITE]
POSITIVE = [*NUMBER, *((one, ValueError, "must be positive, got") for one in (0, -1e-300, -3))]
NO_LIST = [(one, TypeError, "must be a list") for one in (3.0, "ab", None)]
ROW = [("a", TypeError, "must"), ([1.0, NAN], ValueError, "finite"), (np.ones((2, 2)), ValueError, "one row")]
ENTRIES = [*NO_LIST, ([NAN], ValueError, "[0] must be a finite number"), ([1, "1"], TypeError, "[1] must be")]
ANGLES = [(one, ValueError, "must lie between 0 and 1.5708, got") for one in (0, -0.1, np.pi / 2, 30)]
RATIOS = [(one, ValueError, "must lie in -1 < nu <= 0.5") for one in (-1, 0.51)]
#: what a rule must refuse: value, error, words
HOSTILE = {
    "finite": NUMBER,
    "positive": POSITIVE,
    "not_negative": [*NUMBER, (-1e-300, ValueError, "must not be negative, got")],
    "poisson_ratio": [*NUMBER, *RATIOS],
    "_slope_angle": [*NUMBER, *ANGLES],
    "_invertible": [*POSITIVE, (1e-320, ValueError, "beyond the range of floats")],
    "amplitudes": ENTRIES,
    "_row": [*ENTRIES, ([-1.0], ValueError, "[0] must not be negative")],
    "positive_or_none": [one for one in POSITIVE if one[0] is not None],
    "_finite_or_none": [one for one in NUMBER if one[0] is not None],
    "column": ROW,
    "radii": [(3, TypeError, "must be a sequence of radii"), ([-1.0], ValueError, "be positive"),
              ("tip", TypeError, "must be")],
    "_pairs": [(5, TypeError, "must be a sequence of"), ([1e6], TypeError, "must be a sequence of pairs"),
               ([(1, 2, 3)], ValueError, "[0] must be a pair"), ([(1, 1), (-1, 1)], ValueError, "[1] modulus must not"),
               ([(1, NAN)], ValueError, "[0] relaxation time must be a finite number")],
    "_place": [("table", ValueError, 'must be "tool"'), (1, TypeError, "must be a word in quotes")],
    **{key: [("blunt", ValueError, "must be "), (None, ValueError, "must be ")] for key in ("_tip", "tip_of")},
    "_springs": [*((one, TypeError, "must be a whole number") for one in (True, 40.5, "many")),
                 (15, ValueError, "must be at least 16")],
    "_function": [("r**2", TypeError, "must be a function"), (3, TypeError, "must be a function")],
    "_name": [(3, TypeError, "must be a string")],
}  # fmt: skip
PARTS = {"indenter": RUBBER, "material": BALL, "friction": SLED, "oscillation": SLED, "pull": TAPPING, "shake": TAPPING}
RECORDS = [
    one
    for name in mdr.__all__
    if is_dataclass(one := getattr(mdr, name)) and any(facts_of(f).meaning for f in fields(one))
]
FIELDS = [(record, field) for record in RECORDS for field in fields(record)]
NAMES = [f"{record.__name__}.{field.name}" for record, field in FIELDS]
#: what the physics allows to be zero, to have a sign, or to have bounds of its own; every other number is positive
NOT_NEGATIVE = {"Coulomb.mu_0", "ShearStrength.mu_0", "ShearStrength.tau_0", "KelvinVoigt.tau", "Prony.tau",
                "Prony.E_inf", "StandardLinearSolid.E_inf", "StandardLinearSolid.E_1",
                "LoadOscillation.m_z", "InPlaneOscillation.du_x", "InPlaneOscillation.du_y", "SpringPull.m",
                "SpringPull.c_x", "SampledProfile.smoothing", "FromForce.smoothing"}  # fmt: skip
SIGNED = {"NormalOscillation.u_z0", "PeriodicMotion.u_z0", "InPlaneOscillation.phi_x", "InPlaneOscillation.phi_y"}
BOUNDED = {"theta": "_slope_angle", "nu": "poisson_ratio", "nu_1": "poisson_ratio", "nu_2": "poisson_ratio"}
OWN = {"Ellipsoid.k": "_invertible", "SpringPull.k_y": "positive_or_none", "SpringPull.c_y": "positive_or_none",
       "ContactElement.mu_s": "positive_or_none"}  # fmt: skip


def sound(record):
    """Arguments of a record that is right."""
    if record is mdr.SlidingContact:
        return vars(CASE)
    if record is mdr.ContactElement:
        return {"indenter": BALL, "material": RUBBER, "mu_0": 0.5, "u_z_max": 4e-5, "n_springs": 32}
    if record is mdr.Target:
        return {one.name: 0.1 if one.name == "cof_at_least" else 0.4 for one in fields(record)}
    if record is mdr.Profile:
        return {"f": np.square}
    made = example_of(record)
    return {one.name: getattr(made, one.name) for one in fields(record)}


@pytest.mark.parametrize(("record", "field"), FIELDS, ids=NAMES)
def test_a_field_refuses_what_its_rule_forbids(record, field):
    rule, known = facts_of(field).rule, sound(record)
    record(**known)
    if rule is None:
        wrong = PARTS[field.name]
        kind, hint = f"{field.name} must be of kind ", f"; write {type(wrong).__name__}(...)"
        hostile = [(wrong, TypeError, kind), (3, TypeError, kind), (type(wrong), TypeError, hint)]
    else:
        told = f"give HOSTILE in this file what {rule.__name__}, the rule of {field.name}, refuses"
        assert rule.__name__ in HOSTILE, told
        hostile = HOSTILE[rule.__name__]
    for value, error, words in hostile:
        refusal = refused(lambda value=value: record(**known | {field.name: value}), error)
        message = str(refusal)
        assert message.startswith(field.name), message
        assert words in message, message
        assert str(pickle.loads(pickle.dumps(refusal))) == message  # it may come from afar
        if words.startswith(("must be positive", "must not be negative")):
            assert facts_of(field).note in message, message


@pytest.mark.parametrize(("record", "field"), FIELDS, ids=NAMES)
def test_a_field_is_frozen_and_told_apart_and_has_the_rule_that_its_physics_asks_for(record, field):
    name, facts = f"{record.__name__}.{field.name}", facts_of(field)
    assert facts.meaning
    made = record(**sound(record))
    with pytest.raises(FrozenInstanceError):
        setattr(made, field.name, 1.0)
    if facts.rule and field.type in ("float", float):
        if value := getattr(made, field.name):
            other = replace(made, **{field.name: value * (1 - 1e-12)})
            assert other != made
            assert hash(other) != hash(made)
        by_sign = "not_negative" if name in NOT_NEGATIVE else "finite" if name in SIGNED else "positive"
        told = f"name {name} in NOT_NEGATIVE, SIGNED, BOUNDED or OWN of this file, where its rule is another"
        assert facts.rule.__name__ == (OWN.get(name) or BOUNDED.get(field.name) or by_sign), told


@pytest.mark.parametrize("three", [3, 3.0, np.float64(3), np.int32(3), np.float32(3)], ids=lambda x: type(x).__name__)
def test_a_record_does_not_tell_an_int_from_a_float(three):
    one, other = mdr.SpringPull(k_x=three), mdr.SpringPull(k_x=3.0)
    assert (one, hash(one), repr(one)) == (other, hash(other), repr(other))
    assert pickle.dumps(one) == pickle.dumps(other)


# --- every number that a function takes, by the name of its parameter ---

SHAPES = [
    mdr.Profile(np.square),
    *(example_of(one) for one in RECORDS if issubclass(one, mdr.Indenter) and has_example(one)),
]
ARRAY = [(NAN, "must be finite"), ([1e-6, INF], "must be finite"), ("deep", "must"), (1j, "must"), (None, "must"),
         ([[1e-3], [1e-3, 2e-3]], "must be")]  # fmt: skip
ONE = [(value, words) for value, _, words in NUMBER if not isinstance(value, Sly | np.ndarray | list)]
ABOVE_ZERO = [(value, words) for value, _, words in POSITIVE if not isinstance(value, Sly | np.ndarray | list)]
COUNT = [(True, "must be a whole number"), (40.5, "must be a whole number"), ("many", "must be a whole number"),
         (0, "must be at least")]  # fmt: skip
FLAG = [("no", "must be True or False"), (1, "must be True or False")]
SAMPLES = [*ARRAY, (NINE, "must have the shape")]
VELOCITY, VELOCITIES = [*ONE, (-1e-3, "must be positive")], [*ARRAY, ([], "list"), ([[1e-3]], "list")]
#: what each must refuse, whatever the function that takes it
RULES = {
    **dict.fromkeys(("d", "r", "x", "omega", "t"), ARRAY),
    **dict.fromkeys(("mu_0", "chunk_seconds", "high_pass"), ABOVE_ZERO),
    "limit_s": [(value, words) for value, words in ABOVE_ZERO if value is not None],
    **dict.fromkeys(("n_springs", "steps_per_period", "n_periods", "n_t", "cells", "n_realisations"), COUNT),
    **dict.fromkeys(("lump", "coupled"), FLAG),
    "E_star": [*ARRAY, (0, "must be positive"), (-1, "must be positive")],
    "v_0": VELOCITY,
    "case": [(one, "must be a SlidingContact, got") for one in (BALL, None, "case.toml", mdr.SlidingContact)],
    "indenter": [(one, "must be of kind") for one in (3, None)] + [(mdr.Cone, "write Cone(...)")],
    "material": [(one, "must be of kind") for one in (3e6, None)] + [(mdr.Elastic, "write Elastic(...)")],
    "spectrum": [([1.0, 2.0], "must be of kind Spectrum")],
    "seed": [(-1, "must be at least 0"), (None, "must be a whole number"), ("x", "must be a whole number")],
    "start": [(one, 'must be "full_slip" or "rest"') for one in ("zero", "Rest", None, ["rest"])],
    "direction": [(one, "must be 1 (forward) or -1") for one in (0, 2, True, "forward")],
    "accuracy": [*((one, "must lie between 1e-08 and 0.001") for one in (0.0, 1e-9, 2e-3, -1e-5)),
                 (NAN, "must be a finite number"), ("high", "must be a real number")],
}  # fmt: skip
PRESSED, SAMPLED = {"indenter": BALL, "material": RUBBER}, {"t": T, "a": WAVE}
#: functions, arguments that are right, and what some of these must refuse here besides or instead
CALLS = [
    *((lambda d, ask=shape.contact_radius: ask(d), {}, {}) for shape in SHAPES),
    *((lambda r, ask=shape.profile_3d: ask(r), {}, {}) for shape in SHAPES),
    *((lambda x, ask=shape.profile_1d: ask(x), {}, {}) for shape in SHAPES),
    (lambda r, d, E_star: BALL.pressure(r, d, E_star), {"r": 1e-4, "d": 1e-6, "E_star": 1e6}, {}),
    *((ask, {"d": 1e-6, "E_star": 1e6}, {}) for ask in (BALL.force, BALL.stiffness)),
    *((ask, {"omega": 1.0}, {}) for ask in (RUBBER.dynamic_modulus, RUBBER.loss_tangent, SLED.receptance)),
    *((ask, {"t": 1.0}, {}) for ask in (RUBBER.relaxation_modulus, TAPPING.u_z, TAPPING.u_z_dot, TAPPING.u_z_ddot)),
    (RUBBER.creep_compliance, {"t": 1.0}, {"t": [*ARRAY, (-1, "must not be negative")]}),
    (mdr.PeriodicMotion.from_acceleration, {**SAMPLED, "u_z0": 2e-5}, {
        "t": SAMPLES, "a": SAMPLES, "u_z0": [(NAN, "finite"), (-1.0, "never")], "frequency": [
            *((value, words) for value, words in ABOVE_ZERO if value is not None),
            (2.0, "holds 2 periods"), (200.0, "below half of the sampling rate, 100 Hz")]}),
    *((make, {"t": SAMPLED["t"], name: SAMPLED["a"], "u_z0": 1e3}, {"t": SAMPLES, name: SAMPLES, "frequency": [
        (2.0, "holds 2 periods")]}) for name, make in (
            ("v", mdr.PeriodicMotion.from_velocity), ("u", mdr.PeriodicMotion.from_displacement))),
    (mdr.displacement_of, {**SAMPLED, "high_pass": 5.0}, {"t": SAMPLES, "a": SAMPLES, "high_pass": [
        *ABOVE_ZERO, (0.5, "must lie between 1 Hz"), (100.0, "100 Hz, half of the sampling rate")]}),
    (mdr.KelvinVoigt.from_shear, {"G": 1.0, "eta": 1.0, "nu": 0.5}, {
        "G": ABOVE_ZERO, "eta": [(-1, "not be negative"), (NAN, "must be")]}),
    (mdr.KelvinVoigt.from_loss_tangent, {"E": 1.0, "nu": 0.5, "tan_delta": 1.0, "omega": 1.0}, {
        "omega": ABOVE_ZERO, "tan_delta": [(-1, "must not be negative"), (NAN, "must be a finite number")]}),
    (mdr.slide, {"case": CASE, "v_0": 1e-3}, {
        "v_0": [*VELOCITY, (0, "static_cof(case)")], "n_springs": [*COUNT, (31, "at least 32"), (10**9, "memory")],
        "n_periods": [*COUNT, (INF, "whole number")]}),
    (partial(mdr.slide, CASE, 1e-3, n_periods=2), {}, {"record": [*COUNT[:-1], (-1, "at least"), (3, "cannot be")]}),
    (mdr.cof_curve, {"case": CASE, "v_0": 1e-3}, {
        "v_0": [*VELOCITIES, ([-1e-3], "negative")], "method": [("exact", 'must be None or "march"')]}),
    *((ask, {"case": CASE}, {}) for ask in (
        mdr.critical_velocity, mdr.full_slip_critical_velocity, mdr.measure_critical_velocity, mdr.static_cof,
        mdr.resolved, mdr.write_case, mdr.laws.radial_rub, mdr.laws.coupling_loss)),
    (mdr.verdict, {"case": CASE}, {"within": [
        *((one, "finite") for one in (NAN, INF)), *((one, "between 0 and 1, got") for one in (1, 0.0, -0.01)),
        (5, "0.01 for 1 %"), *((one, "must be a real number") for one in ("1%", None, True))]}),
    (mdr.SpringArray.of, {"case": CASE}, {}),
    (mdr.tolerance, {"case": CASE, "v_0": 1e-4}, {"v_0": ONE, "by": [(10, "between 0 and 1, got 10.0 (0.1, or 10%)")]}),
    (mdr.sensitivity, {"case": CASE, "v_0": 1e-4}, {
        "v_0": [*((one, "v_0") for one in (NAN, INF, "1e-4", True, [1e-4], -INF)), (-1e-4, "the same both ways")],
        "accuracy": [(NAN, "finite"), (1e-9, "between 1e-08 and 0.001"), ("fine", "must be")],
        "fields": [("mu_0", "must be a list"), (3, "must be a list")],
        "held": [({"u_z0": 1}, "held takes load"), (3, "must be a dict")]}),
    (mdr.propagate, {"case": CASE, "spread": {"mu_0": "5%"}, "v_0": 1e-4}, {
        "v_0": [(one, "v_0") for one in (NAN, INF, "1e-4", True, [1e-4])],
        "spread": [(3, "must be a dict such as"), ({}, "must be a dict"), (["mu_0"], "must be a dict")],
        "samples": [*COUNT, (29, "at least 30"), (10**13, "at most 1000000")],
        "seed": [(-1, "at least 0"), (0.5, "whole number")],
        "accuracy": [(NAN, "finite")], "held": [({"u_z0": 1}, "held takes load")]}),
    (mdr.partial_slip, {**PRESSED, "mu_0": 0.5, "u_z0": 1e-6, "u_x": 1e-7}, {
        "u_x": [*ARRAY, (-1e-7, "must not be negative")], "u_z0": ABOVE_ZERO}),
    (mdr.indent, {**PRESSED, "t": [0, 1], "u_z": [0, 1e-6]}, {
        "u_z": [([0, NAN], "finite"), ([0], "one value for each")], "record": FLAG, "t": [
            ([1, 0], "must not descend"), (["a", "b"], "must be"), ([0, NAN], "finite"),
            *((one, "list of instants") for one in (1.0, []))]}),
    (partial(mdr.indent, BALL, RUBBER, [0, 1]), {}, {"F_z": [([0, -1], "must not be negative")]}),
    (mdr.half_space.slide, {"case": RIGID, "v_0": 1e-4}, {"v_0": [*VELOCITY, (0, "must be positive")]}),
    (mdr.half_space.curve, {"case": RIGID, "v_0": [1e-4]}, {"v_0": [([], "must be a list of velocities")]}),
    (mdr.random_cof, {"case": RIGID, "spectrum": BAND, "v_0": 1e-4}, {
        "v_0": [*VELOCITIES, (0.0, "must be positive")], "n_realisations": [*COUNT, (8.0, "whole number")]}),
    (average_friction, {"case": RIGID, "v_0": 1e-4}, {
        "v_0": [([1e-3, 0.0], "must be positive"), (NAN, "must be finite")]}),
    (mdr.Quantity, {"name": "depth", "unit": "m", "of": len}, {
        "name": [*((one, "must be of letters, digits and _") for one in ("a b", "v_0/v_c", "status", "")),
                 (3, "must be a string")],
        "unit": [(None, "must be a string")], "of": [(3.0, "must be a function")], "per_velocity": FLAG}),
    (mdr.sweep, {"case": CASE, "axes": {"v_0": [1e-3]}, "store": None}, {
        "axes": [({}, "must name at least one path"), (["v_0"], "must map paths to values"), ({3: [1.0]}, "quotes")],
        "held": [({"mu_0": 0.3}, "takes load, frequency, tan_delta, support_acceleration, hold, got 'mu_0'")],
        "store": [(3, "must be a folder, got 3")],
        "executor": [(4, "must be a concurrent.futures.Executor, got 4"),
                     (SimpleNamespace(get_executor=None), "; write client.get_executor()")],
        "quantities": [([], "must name at least one; there are v_c"), ("v_c", "must be a list of names, got"),
                       (["T", "T"], "T twice"),
                       *(([one], "must be names or Quantity records, got") for one in (3, mdr.critical_velocity))]}),
    (lambda load: mdr.sweep(CASE, {"v_0": [1e-3]}, held={"load": load}), {}, {"load": ABOVE_ZERO}),
    (partial(mdr.sweep, CASE, {"v_0": [1e-3]}, "nowhere"), {}, {"shard": [
        *((one, "must be k/n with k from 1 to n, such as 3/16, got") for one in (
            "0/4", "5/4", "1", "1/2/3", "a/b", "", "-1/4", "1.0/4", (0, 4), (1,), (1.0, 2), 3, (True, 2))),
        ("9" * 999 + "/" + "9" * 999, "must be k/n")]}),
    *((lambda of=of, **axis: mdr.sweep(CASE, axis, quantities=of), {}, {name: wrong}) for of, name, wrong in (
        (["cof"], "v_0", [
            *((one, "has no values") for one in ([], np.array([]))), ([0.1, -0.1], "must not be negative, got -0.1"),
            *((one, "must be a list of values, got") for one in (0.1, "slow", {0.1, 0.2})),
            *((one, "must be finite in m/s, got") for one in ([0.1, NAN], [INF])),
            *((one, "must be real numbers") for one in ([0.1, "x"], [True, 0.5], [0.1j], [10**400], [BALL]))]),
        (["v_c"], "mu_0", [
            ([[0.1, 0.2]], "must be a plain list"), ([0.1, 0.2, 0.1], "has the value 0.1 twice")]),
        (["v_c"], "indenter", [
            (BALL, "must be a list of values"), ([BALL] * 2, "has the value Paraboloid(R=0.005) twice"),
            *(([one], "must be a list of records of kind Indenter, got") for one in (0.1, mdr.Cone, SLED))]))),
]  # fmt: skip


def asked_of(call, own):
    """The parameters of a function for which there is a rule."""
    return {**{name: RULES[name] for name in signature(call).parameters if name in RULES}, **own}


ARGUMENTS = [(name, call, known, wrong) for call, known, own in CALLS for name, wrong in asked_of(call, own).items()]


@pytest.mark.parametrize(
    ("name", "call", "known", "hostile"),
    ARGUMENTS,
    ids=[f"{getattr(call, '__qualname__', 'partial')} {name}" for name, call, *_ in ARGUMENTS],
)
def test_an_argument_is_refused_by_name(name, call, known, hostile, monkeypatch):
    monkeypatch.setattr("mdr.friction.measured_velocity.slide", None)  # before any run
    for value, words in hostile:
        message = str(refused(lambda value=value: call(**known | {name: value})))
        assert name in message, message
        assert words in message, message


# --- relations, and slips ---

#: what is written after "mdr.", and what the answer says
SAYINGS = {
    # shapes
    "Indenter()": "Indenter is no shape",
    "FlatPunch()": "missing 1 required positional argument: 'a'",
    "Cone(45)": "45 degrees are 0.785",
    "TruncatedCone(0, 0.1)": "b must be positive, got 0.0 (radius of the face in m; a Cone has none)",
    "Profile(lambda r: r + 1)": "f(0) must be 0",
    "Profile(lambda r: r**2, kinks=(2.0,), r_max=1.0)": "within r_max",
    "Profile(lambda r: np.sin(1e3 * r) * 1e-3, r_max=5e-3).contact_radius(8e-4)": "annular",
    "CappedParaboloid(1.0, 2.0, 1e-3)": "R2 must not exceed R1 = 1 m, got 2 m",
    "SampledProfile(GRID[1:], GRID[1:])": "r must begin at 0, the tip from which the depth counts, got 1e-05 m",
    "SampledProfile(GRID - 1e-3, GRID)": "got -0.001 m: give one side of a mirrored profile",
    "SampledProfile(GRID[::-1], GRID)": "sort the points by r",
    "SampledProfile(GRID, GRID**2, kinks=[1.001e-3])": "got 0.001001 m: the nearest is 0.001 m",
    "SampledProfile(GRID, -(GRID**2))": "annular contact",
    "SampledProfile(GRID, 0 * GRID, smoothing=1e-7)": "f is 0 m at every r, a flat face: use FlatPunch(a=0.002)",
    "SampledProfile(GRID, 0 * GRID + 1e-3)": "f is 0.001 m at every r, a flat face",
    "FromForce(GRID, GRID**0.9, 2e6)": "falls at d = 1e-05 m",
    "FromForce(GRID, np.minimum(GRID, 1e-3 + (GRID - 1e-3) / 2), 2e6)": "F must rise more and more steeply",
    "FromForce(GRID + 1e-9, GRID, 2e6)": "d and F must begin with 0, got 1e-09 m and 0 N",
    "SampledProfile([0, 1e-3], [0, 1e-5])": "at least 6 numbers",
    "SlidingContact(ConcavePunch(1e-3, 0.2), RUBBER, 0.5, NormalOscillation(6e-6, 2e-6, 3))": "its middle presses only",
    # materials
    "KelvinVoigt(3e6, 50, 1e-3)": "rubber is 0.5",
    "KelvinVoigt(E=3e6, nu=0.5, tan_delta=0.2)": "use KelvinVoigt.from_loss_tangent",
    "StandardLinearSolid(0, 0, 1e-3, 0.5)": "nothing carries a load",
    "Prony(0, [(1e6, 1)], 0.5, tau=1)": "tau must be 0 where E_inf = 0",
    "SlidingContact(BALL, Prony(0, [(1e6, 1)], 0.5), 0.5, TAPPING)": "E_inf = 0: a mean load relaxes",
    "NormalOscillation(1e-5, 0.0, 300.0)": "does not oscillate is a ConstantDepth",
    "Prony.fit([1, 2], [1e6, NAN], [0, 0], nu=0.5)": "storage must be finite",
    "Prony.fit([1], [1e6, 1e6], [0, 1], nu=0.5)": "lists of one length, got shapes (1,), (2,), (2,)",
    "Prony.power_law(modulus=1, exponent=1.2, omega=(1, 9), nu=0)": "exponent must lie",
    "Prony.power_law(modulus=1, exponent=0.2, omega=(9, 1), nu=0)": "omega must be a range",
    # motion and pull
    "NormalOscillation(-2e-6, 2e-6, 300)": "never touches; raise u_z0 above -du_z = -2e-06 m",
    "NormalOscillation(uz0=2e-5, du_z=2e-6, omega=3)": "did you mean u_z0?",
    "PeriodicMotion(1, 1e-6)": "nothing oscillates",
    "PeriodicMotion(1, -1e-6, sin=(1e-7,))": "at its deepest: the indenter never touches",
    "PeriodicMotion.of([1.0], 1)": "u_z must be a list of at least 3",
    "PeriodicMotion.from_acceleration(T, WAVE**0, u_z0=1e-5)": "nothing periodic stands out of the noise",
    "PeriodicMotion.from_acceleration(T[::-1], WAVE, u_z0=1e-5)": "t must rise, got 0.99 s after 0.995 s (sample 1)",
    "PeriodicMotion.from_acceleration(T[:25], WAVE[:25], u_z0=1e-5)": "holds 2.5 periods and must hold three or more",
    "PeriodicMotion.from_acceleration([0, 1, 2], [0, 1, 0], u_z0=1e-5)": "t must be a list of 8 instants or more",
    "displacement_of(T**1.1, WAVE, high_pass=5.0)": "t must rise in equal steps, but sample",
    "displacement_of(T, WAVE, high_pass=5.0, order=3)": "order must be 2 of an acceleration, 1 of a velocity or 0 of a",
    "LoadOscillation(0.1, 0.2, 300)": "dF_z = 0.2 N must be less than F_z0 = 0.1 N where nothing has mass",
    "SpringPull(k_x=2e4, c_y=1.0)": "give k_y",
    "replace(CASE, shake=InPlaneOscillation(314.0, du_y=1e-6, at='pull'))": "guided there",
    "FrictionData([1.0, 2.0], [0.3])": "cof must be a list of as many numbers as v_0",
    "SpringPull(0)": "for a rigid pull use RigidPull()",
    # a contact
    "SlidingContact(Paraboloid, RUBBER, 0.5, TAPPING)": "write Paraboloid(...)",
    "SlidingContact(BALL, RUBBER, 0.5, ConstantDepth(2e-5))": "nothing oscillates",
    "SlidingContact(Sphere(1e-5), RUBBER, 0.5, NormalOscillation(1e-3, 1e-6, 300))": "press less",
    "SlidingContact(BALL, RUBBER, 0.5, TAPPING, shake=SHAKE)": "whole numbers up to 16",
    "resolved(SlidingContact(Sphere(1e-6), RUBBER, 1, LoadOscillation(9, 1, 1)))": "carries",
    "replace(CASE, mu_0=0.0)": "mu_0 must be positive",
    # questions
    "slide(CASE)": "missing 1 required positional argument: 'v_0'",
    "slide(CASE, 1e-3, n_periods=200_000, record=200_000)": "more than memory holds",
    "slide(CASE, 1e-15)": "rounding hides the motion",
    "slide(replace(SHAKEN, shake=InPlaneOscillation(314.0, 1e7)), 1.0)": "the shake is more than",
    "no_load_velocity(ON_RESONANCE)": "undamped natural frequency",
    "slide(ON_RESONANCE, 1e-3)": "no periodic motion to begin with; give the pull a damper",
    "slide(CASE, 1e25)": "full slip but for rounding; lower it",
    "cof_curve(CASE, [5e-4], n_springs=10**8)": "more than memory holds",
    "partial_slip(BALL, Prony(0, [(1e6, 1)], 0.5), 0.5, 1e-6, 1e-7)": "flows",
    "surface_fields(3)": "source must be of kind",
    "surface_fields(indent(BALL, RUBBER, [0, 1], [0, 1e-6]))": "record=True",
    "surface_fields(slide(CASE, 1e-3, n_periods=1))": "slide(..., record=1)",
    "indent(Profile(np.square, r_max=1e-3), RUBBER, [0, 1], [0, 1e-5])": "deeper",
    "indent(BALL, RUBBER, [0, 1])": "give either u_z",
    "indent(BALL, RUBBER, [0, 1], [0, 1], F_z=[0, 1])": "give either u_z",
    'sweep(CASE, {"v_0": [1e-3]}, quantities=["coff"])': "did you mean cof?",
    'sweep(CASE, {"v_0": [1e-3]}, quantities=["d cof/d du_z"])': "d cof/d du_z: du_z is no input of a case, such as",
    'sweep(CASE, {"v_0": [1e-3]}, quantities=["d cof/d indenter"])': "indenter is no input of a case",
    'sweep(CASE, {"v_0": [1e-3]}, quantities=["d cof/d v_0/v_c"])': "v_0/v_c is no input of a case",
    'sweep(CASE, {"v_0": [1e-3]}, quantities=["d k_zc/d mu_0"])': "k_zc has no derivative here, but cof, v_c, sta",
    'sweep(CASE, {"v_0": [1e-3]}, quantities=["d band/d mu_0"])': "band has no derivative here, but cof, v_c, sta",
    'sweep(CASE, {"v_0": [1e-3]}, quantities=["d v_c/d v_0"])': "v_c does not depend on v_0",
    'sweep(CASE, {"T": [0.1]}, quantities=["d cof/d mu_0"])': "d cof/d mu_0 needs a velocity",
    'sweep(CASE, {"v_0": [1e-3]}, shard="1/2")': "a shard needs a store",
    'sweep(CASE, {"mu_0": [0.1]})': 'cof needs a velocity: give an axis "v_0" [m/s] or "v_0/v_c"',
    'sweep(CASE, {"T": [0.1]}, quantities=["T"])': "T is an axis of the study already",
    'sweep(CASE, {"T": [0.1]}, quantities=[Quantity("v_c", "m/s", len)])': "v_c is the name of another quantity",
    'sweep(CASE, {"T": [0.1]}, quantities=[Quantity("own", "-", len, per_velocity=True)])': "own needs a velocity",
    'sweep(CASE, dict.fromkeys(("alpha", "T", "v_0"), np.linspace(0.1, 1, 1001)))': "more than memory holds",
    'sweep(CASE, {"v0": [1.0]})': "v0 is no path of this case; did you mean v_0?",
    'sweep(CASE, {"pull.k": [1.0]})': "SpringPull has none; did you mean pull.k_x?",
    'sweep(CASE, {"xyz": [1.0]})': "there are v_0, v_0/v_c, mu_0, tau_0, indenter, material",
    'sweep(CASE, {"v_0": [1.0], "v_0/v_c": [1.0]})': "v_0 and v_0/v_c set the same",
    'sweep(CASE, {"k_x/k_xc": [1], "pull.k_x": [1e4]})': "k_x/k_xc and pull.k_x set the same",
    'sweep(CASE, {"tan_delta": [0.1], "material": [Elastic(1e6, 0.3)]})': "which Elastic has not",
    'sweep(CASE, {"chi": [0.5], "v_0": [1]})': "chi sets shake.du_x, which a case without shake has not",
    'sweep(CASE, {"pull": [RigidPull()], "pull.m": [0.1]})': "pull.m is no path of this case; RigidPull has none",
    'sweep(CASE, {"indenter": [Cone(theta=0.1)], "indenter.R": [1e-3]})': "Cone has none; did you mean indenter",
    'fit(CASE, SOME, "mu_0")': "parameters must be a list of names",
    'fit(RIGID, SOME, ["omega_0/omega"])': "cannot be varied: omega_0/omega: RigidPull has no k_x",
    "fit(CASE, SOME, [])": "must name at least one",
    'fit(CASE, SOME, ["taw"])': "taw is no parameter of this case; did you mean tau?",
    'fit(CASE, SOME, ["tau", "material.tau"])': "tau and material.tau set the same; keep one of the two",
    'fit(CASE, SOME, ["nu", "mindlin_ratio"])': "nu and mindlin_ratio set the same; keep one of the two",
    'fit(CASE, SOME, ["mu_0", "tau", "R"])': "3 parameters need more than 3 measurements",
    'fit(CASE, ((0, 0.3),), ["mu_0"])': "must be FrictionData, as read_friction_data gives, got ((0, 0.3),)",
    'fit(CASE, SOME, ["mu_0"], confidence=95)': "confidence must lie between 0 and 1, got 95",
    'fit(CASE, SOME, ["tau"], bounds={"tau": (1e-5, 1e-4)})': "where the search begins: 0.001 is not",
    'fit(CASE, SOME, ["tau"], bounds={"tau": (1e-1, 1e-5)})': "low < high, got 0.1 and 1e-05",
    'fit(CASE, SOME, ["tau"], bounds={"tau": (-1.0, 1.0)})': "-1 is no value of it: tau must not be negative",
    'fit(CASE, SOME, ["tau"], bounds={"tau": (0.0, NAN)})': "bounds of tau must be a finite number",
    'fit(CASE, SOME, ["tau"], bounds={"k_x": (1, 2)})': "bounds: k_x is not fitted; the parameters are tau",
    'find(CASE, "du_z")': "give one wish: cof, share or smooth at a velocity v_0, or v_c",
    'find(CASE, "du_z", v_0=1e-4, smooth=1)': "smooth must be True or False, got 1",
    'find(CASE, "du_z", v_0=1e-4, cof=0.5)': "cof must be below mu_0 = 0.5, got 0.5: from v_c on friction is mu_0",
    'find(CASE, "du_y", v_c=1e-3)': "du_y is no parameter of this case",
    'find(CASE, "du_z", v_c=1e-3, within=(2, 1))': "within must be (low, high) with low < high, got 2 and 1",
    'find(replace(CASE, pull=replace(SLED, c_x=0)), "c_x", v_c=1e-3)': "pull.c_x is zero in this case: give the range",
    'tolerance(CASE, 1e-4, fields=["taw"])': "did you mean tau?",
    'propagate(CASE, {"taw": 1})': "did you mean tau?",
    "propagate(CASE, {1: 1})": "parameters must be names, got 1",
    'propagate(CASE, {"v_0": "5%"})': "v_0 is no parameter of this case",
    'propagate(CASE, {"mu_0": "5%", "friction.mu_0": 1})': "mu_0 and friction.mu_0 set the same; keep one of the two",
    'propagate(CASE, {"load": 1, "u_z0": 1e-6})': "load and u_z0 set the same; keep one of the two",
    **{
        f'propagate(CASE, {{"mu_0": {one}}})': f"spread of mu_0 {words}"
        for one, words in (
            ("0", "must be positive, got 0.0 (a standard deviation, or per cent of the value, 0.5"),
            ("-0.1", "must be positive, got -0.1"),
            ("NAN", "must be a finite number"),
            ("True", "must be a real number"),
            ("None", "must be a real number"),
            ("'5s'", "wants a pure number"),
            ("'five'", "wants a pure number"),
            ("'-5%'", "must be positive, got -0.025"),
            ("'nan%'", "wants a pure number"),
        )
    },
    'propagate(CASE, {"nu": 1e9}, 1e-4)': "0 of 1000 samples have a ",
    'propagate(CASE, {"nu": 1e9})': "samples have a v_c, and 30 tell a standard deviation: 1000: nu must lie in",
    'sensitivity(CASE, fields=["taw"])': "did you mean tau?",
    "sensitivity(CASE, fields=[1])": "parameters must be names, got 1",
    "sensitivity(CASE, fields=5)": "fields must be a list of paths, got 5",
    'sensitivity(CASE, fields=["T", NAN])': "parameters must be names, got nan",
    'sensitivity(CASE, held={"load": -1.0})': "load must be positive, got -1.0",
    'sensitivity(CASE, held={"load": NAN})': "load must be a finite number",
    'sensitivity(CASE, held={"load": 1.0, "hold": "both"})': "hold must be",
    'sensitivity(CASE, held={"hold": "depth"})': "hold says what stays of a load",
    'sensitivity("CASE")': "SlidingContact",
    'sensitivity(CASE, fields=["v_0"])': "v_0 is no parameter of this case",
    'sensitivity(CASE, 1e-4).elasticity("load")': "of must be one of cof, v_c, static_cof, band,",
    "closed_forms.rigid_pull.average_friction(CASE, 1e-3)": "rigid pull",
    "closed_forms.rigid_pull.average_friction(replace(RIGID, material=SOLID), 1e-4)": "Kelvin material, got",
    # spectra, waveforms and their laws
    "Spectrum((1.0, 2.0), (1.0,))": "of one length, two or more, got 2 and 1",
    "Spectrum((2.0, 2.0), (1.0, 1.0))": "f must rise",
    "Spectrum((1.0, 2.0), (0.0, 0.0))": "nothing vibrates",
    "Spectrum.band(1e-6, 2.0, 1.0)": "f_high must be above f_low",
    "BAND.moment(7)": "at most 6",
    "BAND.realisation(128, 7e-3)": "too long for frequencies up to 80 Hz",
    "waveforms.pulse(2e-5, 5e-6, 300.0, n_harmonics=4, width=1.0)": "width must lie between 0 and 1",
    "waveforms.pulse(-1.0, 5e-6, 300.0, n_harmonics=4, width=0.5)": "never touches",
    "laws.waveform_loss(np.sin, -1.0)": "beta must not be negative",
    "laws.waveform_loss(np.ones(5), 1.0)": "constant",
    "laws.waveform_loss([1.0], 1.0)": "at least 2 samples",
    "laws.waveform_loss([1.0, NAN], 1.0)": "w must be finite",
    "laws.waveform_loss(lambda x: np.sin(1e9 * x**2), 1.0)": "too rough",
    "laws.waveform_loss(lambda x: 1.0, 1.0)": "in the shape of its phases",
    'laws.waveform_loss("saw", 1.0)': "w must be",
    "laws.waveform_critical(lambda x: np.where(x == 0.5, INF, x))": "w",
    "laws.steepest_waveform(0)": "at least 1",
    "random_cof(CASE, BAND, 1e-4)": "a rigid pull, got pull = SpringPull",
    "random_cof(replace(RIGID, shake=InPlaneOscillation(314.0, 1e-6)), BAND, 1e-4)": "shake = InPlaneOscillation",
    "random_cof(replace(RIGID, oscillation=NormalOscillation(-1e-3, 2e-3, 600.0)), BAND, 1e-4)": "never touches",
    "random_cof(RIGID, BAND, 1e-11)": "raise v_0",
    "random_cof(RIGID, BAND, 1e-4, n_realisations=7)": "n_realisations must be at least 8",
    "random_cof(replace(RIGID, material=Prony(3e6, [(3e6, 1e28)], 0.5)), BAND, 1e-4)": "lower it to",
    # laws
    "laws.late_return(-1.0, 0.0)": "never touches",
    "laws.touch_depth(1.0, 0.0)": "phase",
    "laws.edge_band(1.0)": "v_hat",
    "laws.rise_of_lost_punch(2.0, 1.0)": "depth",
    "laws.stick_impedance(1.0, 1.0, 1.0)": "stick must lie between 0 and 1, got 1.0 (share of the period in stick)",
    "laws.stick_impedance(0.5, 1.0, 1.0, 1.0)": "slow must lie between -1 and 1, got 1.0",
    "laws.onset(CASE)": "flat punch, whose stiffness is constant, got indenter = Paraboloid",
    "laws.blow(LOST)": "got T = 0: ask full_slip",
    "laws.blow(replace(LOST, material=KelvinVoigt(3e6, 0.5, 0.03), pull=SpringPull(1e4, 0.1, 1e6)))": "damping",
    "laws.half_a_blow(replace(CASE, pull=SpringPull(k_x=1e4)))": "a body with a mass, got pull = SpringPull",
    "laws.lock_in(1)": "at least 2",
    "laws.first_order(replace(CASE, oscillation=LOAD))": "harmonic",
    "laws.coupling_loss(SHAKEN)": "no shake in the plane, got shake = InPlane",
    "laws.first_order(replace(SHAKEN, pull=SLED))": "shake in the plane",
    "laws.lost_under_shake(SHAKEN, 1e-4)": "takes an elastic material, got material = Kelvin",
    "laws.excess_across(replace(CROSSED, material=RUBBER), 1e-4)": "an elastic material, got material = Kelvin",
    "closed_forms.rigid_pull.small_velocity(replace(LOST, material=RUBBER, pull=RigidPull()))": "lost entirely",
    "closed_forms.rigid_pull.near_critical(TOUCHING)": "open at the instant of fastest approach",
    "laws.random_friction(CASE, BAND, 1e-3)": "ask random_cof",
    # studies
    'STUDY["coff"]': "the study has no quantity 'coff'; did you mean cof?",
    'STUDY.select({"v_0": 0.5})': "'v_0' is no axis of the study; there are v_0/v_c, ind",
    'STUDY.select({"v_0/v_c": 0.49})': "v_0/v_c has no value 0.49; the nearest is 0.5",
    'STUDY.select({"v_0/v_c": None})': "v_0/v_c has numbers for values, got None",
    'STUDY.select({"indenter": Cone(0.06)})': "no value Cone",
    'STUDY.select("v_0/v_c")': "values must map paths to values",
    'sweep(SHAKEN, {"chi": [0.5], "shake.du_x": [1e-6]})': "chi and shake.du_x set the same",
    'TABLE.plot_map("v_c")': "a map needs two axes of numbers, the study has alpha",
    'TABLE.select({"T": 0.1}).plot_map("v_c", x="T")': "no axis of the study",
    'STUDY.select({"v_0/v_c": 0.5}).plot()': "no axis of numbers",
    'TABLE.plot_multiples("v_c", over="T", columns=0)': "columns must be at least 1",
    'TABLE.select({"T": 0.1}).plot_multiples("v_c", over="alpha", levels=[0.3])': "levels is for maps",
    # records of motion
    "MOVED(t=[0, 2, 1])": "t must rise, got 1 s after 2 s",
    "MOVED(t=[0], u_x=[0], u_z=[1e-6])": "two instants",
    "MOVED(u_x=[0, 1e-6])": "u_x must have the shape",
    "MOVED(u_y=[0, 0, 0, 0])": "u_y must have the shape",
    "MOVED(u_z=-1e-6)": "never touches",
    "MOVED(F_z=1.0)": "not both",
    "MOVED(u_z=None, F_z=[0.01, -0.01, 0.01])": "F_z must not be negative",
    "MOVED(indenter=Profile(np.square, r_max=1e-4), u_z=1e-6)": "deeper",
    "MOVED(material=Prony(0.0, [(1e6, 1e-3)], 0.5))": "E_inf = 0",
    # rigs
    "RIG(load=None, load_amplitude=0.1)": "give the load once",
    "RIG(load_amplitude=0.1, acceleration=3.0)": "give one of them",
    "RIG()": "nothing vibrates",
    "RIG(load_amplitude=0.1, k_x=2e4)": "m is missing",
    "RIG(load_amplitude=0.1, c_x=2.0)": "give k_x",
    "RIG(load_amplitude=0.1, k_x=2e4, m=0.2)": "Say load_rides=True",
    "RIG(load_amplitude=0.1, load_rides=True)": "give the mass m of the sled",
    "RIG(load_amplitude=0.1, m=0.1, load_rides=False)": "m has no effect under a rigid pull",
    "RIG(depth_amplitude=1e-6, k_x=2e4, m=0.1, load_rides=True)": "is about an oscillating load",
    "RIG(shake=InPlaneOscillation(628.0, 1e-6))": "nothing vibrates at the frequency of 50 Hz",
    "RIG(load_amplitude=2.0)": "must be less than F_z0",
    "RIG(load=1e6, depth_amplitude=1e-6)": "carries on this material",
    "RIG(material=RUBBER, load_amplitude=0.1, tan_delta=0.1)": "tan_delta turns an Elastic",
    'RIG(depth_amplitude=1e-6, hold="force")': 'hold must be "depth" or "load"',
    'RIG(load_amplitude=0.1, hold="load")': "hold is about a driven depth",
    # keywords
    "rig(None, None, 0.3, frequency=5, amplitude=1e-6)": "did you mean load_amplitude or depth_amplitude?",
    "cof_curve(None, 1, springs=40)": "cof_curve takes no springs; did you mean n_springs?",
    'sweep(None, {}, quantity=["cof"])': "sweep takes no quantity; did you mean quantities?",
    # ends of shapes
    "Sphere(5e-3).profile_1d(5e-3)": "Sphere is touched within its equator only, x < 0.005 m",
    "Sphere(5e-3).profile_3d([0, 5.5e-3])": "Sphere ends at its equator r = 0.005 m, got 0.0055 m",
    "Sphere(5e-3).force(1.0, 1)": "d = 1 m is deeper than Sphere can be pressed",
    "ConstantPressure(1e-3, 1e-5).stiffness(2e-5, 1)": "d_0 = 1e-05 m its whole face touches",
    "ConstantPressure(1e-3, 1e-5).profile_3d(2e-3)": "ConstantPressure ends at r = 0.001 m, got 0.002 m",
    # files
    'read_case("nofile.toml")': "nofile.toml: cannot be read: No such file",
    'Prony.read("arms.txt")': "arms.txt",
    "parse_case(3)": "text must be",
    'parse_case("mu_0 = 0,5")': "write one number in SI",
    'parse_case("mu_0 = 0.5")': "[indenter] is missing",
    'parse_case(CONE + "theta = 1 deg")': "or a quantity in quotes",
    'parse_case(CONE + "angle = 0.1")': "angle is no key of Cone; there are shape, theta, theta_deg",
}


@pytest.mark.parametrize("saying", SAYINGS)
def test_a_slip_is_answered_in_words(saying):
    message = str(refused(lambda: eval(saying, vars(mdr) | globals()), (TypeError, ValueError, OSError, KeyError)))
    assert SAYINGS[saying] in message, message


def test_what_is_right_passes():
    """The same calls with sound values: the table refuses the wrong, not everything."""
    case = mdr.SlidingContact(mdr.Profile(lambda r: r**2 / 1e-2), RUBBER, np.float64(0.5), TAPPING)
    run = mdr.slide(case, np.float32(1e-4), n_springs=np.int64(32), steps_per_period=64, n_periods=9, record=1)
    assert 0 < run.cof < 0.5
    assert mdr.NormalOscillation(u_z0=-1e-6, du_z=2e-6, omega=1).u_z_dot(0.0) == 0
    assert mdr.Elastic(E=1, nu=0).mindlin_ratio == 1
    assert mdr.LoadOscillation(0.1, 0.2, 1.0, m_z=0.1).dF_z == 0.2  # with mass it may let go
    assert mdr.SpringPull(k_x=1).receptance(0) == 1


def test_a_pull_slower_than_rounding_is_its_limit_in_a_curve():
    for pull in (SLED, mdr.RigidPull()):
        case = replace(CASE, pull=pull)
        curve = mdr.cof_curve(case, [1e-30, 1e-15])
        assert np.all(np.abs(curve.cof - mdr.static_cof(case)) <= curve.cof_error)
        assert np.all(curve.cof_error < 1.1e-5 * case.mu_0)
        assert curve.v_0.tolist() == [1e-30, 1e-15]


@pytest.mark.parametrize("v_0", [1e-11, 1e-9, 1e3, 1e9])
def test_extreme_velocities_give_numbers(v_0):
    """Legal however extreme: a friction between the static limit and mu_0, finite in every field."""
    run = mdr.slide(replace(CASE, pull=mdr.RigidPull()), v_0, n_springs=32, steps_per_period=64, n_periods=20)
    assert 0 <= run.cof <= CASE.mu_0 * (1 + 1e-9)
    numbers = [run.cof_error, run.stick_share, run.least_slip, run.mean_F_x, run.mean_F_z]
    assert np.isfinite([*numbers, *vars(run.energy_balance).values()]).all()
