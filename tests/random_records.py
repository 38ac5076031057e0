"""Records drawn at random from the facts of their fields: each example varied by its rule, then in any units."""

import math
from dataclasses import fields, replace

import numpy as np

import mdr
from mdr.files.examples import MATERIALS, SHAPES
from mdr.tools.fields import example_of, facts_of

RADIUS = 1e-3  #: [m] of the contact of an example
WILD = 0.15  #: share of contacts whose numbers know nothing of each other
#: what a unit becomes where lengths, times and forces are so many times larger
POWERS = {"m": (1, 0, 0), "1/m": (-1, 0, 0), "s": (0, 1, 0), "rad/s": (0, -1, 0), "N": (0, 0, 1), "N/m": (-1, 0, 1),
          "Pa": (-2, 0, 1), "kg": (-1, 2, 1), "N s/m": (-1, 1, 1), "-": (0, 0, 0), "rad": (0, 0, 0)}  # fmt: skip


class Dice:
    """What chance decides."""

    def __init__(self, seed):
        self.rng = np.random.default_rng(seed)

    def share(self):
        """A number from 0 to 1."""
        return float(self.rng.random())

    def below(self, n):
        """A whole number from 0 to n - 1."""
        return int(self.rng.integers(n))

    def between(self, low, high):
        return low + (high - low) * self.share()

    def size(self, low, high):
        """A number of any magnitude between two."""
        return min(max(low * (high / low) ** self.share(), low), high)

    def one_of(self, some):
        return some[self.below(len(some))]

    def happens(self, chance):
        return self.below(1000) < 1000 * chance


def drawn(dice, record, by):
    """A record like this one: its numbers up to so many times larger or smaller, and none where the rule allows it."""

    def near(value):
        return value * dice.size(1 / by, by)

    rules = {
        "positive": near,
        "_invertible": near,
        "_slope_angle": lambda value: min(near(value), 1.5),
        "not_negative": lambda value: 0.0 if dice.happens(0.1) else near(value),
        "finite": lambda value: dice.one_of([1, 1, 1, 0, -0.1]) * near(value),
        "poisson_ratio": lambda _: dice.one_of([0.5, 0.5, 0.3, 0.0, -0.99, dice.between(-0.999, 0.5)]),
        "amplitudes": lambda values: tuple(near(value) * dice.between(-1, 1) for value in values),
        "column": lambda values: tuple(np.array(values) * near(1.0)),
        "_pairs": lambda pairs: tuple((near(E_j), near(tau_j)) for E_j, tau_j in pairs[dice.below(len(pairs)) :]),
    }
    rule = {one.name: facts_of(one).rule.__name__ for one in fields(record) if facts_of(one).rule}
    known = {name: value for name, value in vars(record).items() if rule.get(name) in rules}
    other = replace(record, **{name: rules[rule[name]](value) for name, value in known.items()})
    if isinstance(record, mdr.PowerLaw):
        other = replace(other, c=other.c * RADIUS ** (record.n - other.n))
    return other


def in_units(record, length, time, force):
    """The record with all lengths, times and forces so many times larger."""
    if isinstance(record, mdr.Profile):
        base, end = in_units(record.f.__self__, length, time, force), record.r_max
        return mdr.Profile(base.profile_3d, kinks=base.kinks, r_max=end and end * length, name=record.name)
    changed = {}
    for one in fields(record):
        value, unit = getattr(record, one.name), facts_of(one).unit
        if one.name == "arms":
            changed["arms"] = [(E_j * force / length**2, tau_j * time) for E_j, tau_j in value]
        elif value is not None and unit:
            of_power = {"m^(1-n)": (1 - record.n, 0, 0)} if isinstance(record, mdr.PowerLaw) else {}
            powers = POWERS | of_power
            assert unit in powers, f"{one.name}: give POWERS in tests/random_records.py a line for the unit {unit}"
            x, t, F = powers[unit]
            factor = length**x * time**t * force**F
            changed[one.name] = tuple(v * factor for v in value) if isinstance(value, tuple) else value * factor
    return replace(record, **changed)


def case_in_units(case, *units):
    named = ("indenter", "material", "oscillation", *(["shake"] if case.is_shaken else []))
    parts = {name: in_units(getattr(case, name), *units) for name in named}
    return replace(case, **parts, pull=case.pull if case.pull.is_rigid else in_units(case.pull, *units))


def shape(dice, by):
    one = drawn(dice, example_of(dice.one_of([type(one) for one in SHAPES.values()])), min(by, 100.0))
    if dice.happens(0.1) and not isinstance(one, mdr.SampledProfile | mdr.FromForce | mdr.RoughFace):  # themselves sums
        end = one.max_radius if math.isfinite(one.max_radius) else None
        one = mdr.Profile(one.profile_3d, kinks=one.kinks, r_max=end, name=dice.one_of([None, "mine"]))
    return one


def pull(dice, by, omega):
    """Rigid, or a spring with or without mass and damper, on and off resonances."""
    if dice.happens(0.35):
        return mdr.RigidPull()
    one = drawn(dice, example_of(mdr.SpringPull), by)
    ratio = dice.one_of([None, None, 1.0, 2.0, 0.5])
    return one if ratio is None else replace(one, m=one.k_x / (ratio * omega) ** 2)


def contact(dice):
    """A contact in units of any size; a ValueError where its parts do not fit each other."""
    by = 1e3 if dice.happens(WILD) else 6.0
    material = drawn(dice, example_of(dice.one_of([type(one) for one in MATERIALS.values()])), by)
    motion = dice.one_of([*3 * [mdr.NormalOscillation], *3 * [mdr.PeriodicMotion], mdr.LoadOscillation])
    motion = drawn(dice, example_of(motion), by)
    if isinstance(motion, mdr.LoadOscillation) and dice.happens(0.3):
        motion = replace(motion, m_z=0.08 * dice.size(1 / by, by))  # kg, near the resonance of the examples
    case = mdr.SlidingContact(shape(dice, by), material, dice.size(1e-3, 10), motion, pull(dice, by, motion.omega))
    return case_in_units(case, *(2.0 ** (dice.below(41) - 20) for _ in range(3)))
