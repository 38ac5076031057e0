"""Paths: what can be set in a case, and what it is called and measured in.

A path is a part ("indenter"), a field ("material.tau"; of the law of friction "mu_0", or "friction.mu_0"), or one of
`SET`: a number that sets fields, a dimensionless group or what a rig is set to. The way there and back, for which a
contact may have to be solved, is in `mdr.given.vary`. A case file may give what a rig is set to in the place of the
field:

    [indenter]     theta_deg = 1.5     for theta [rad]
    [material]     tan_delta = 0.2     for tau [s] of a KelvinVoigt: the loss tangent at the frequency of the case
    [oscillation]  frequency = 50      for omega [rad/s], in Hz; so in [shake]
    [oscillation]  load = 1.0          for F_z0 [N]; of a prescribed depth for u_z0, at which this load rests, or with
                   hold = "load"       about which it is the mean load
    [oscillation]  support_acceleration = 5    for dF_z [N]: of what the half-space or a mass on it stands on, in m/s²
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import fields, is_dataclass
from itertools import combinations
from typing import Any, NamedTuple

from mdr.case.contact import KINDS, SlidingContact
from mdr.case.friction import Friction
from mdr.materials import KelvinVoigt
from mdr.tools.checks import not_negative, positive, word
from mdr.tools.fields import NOTHING, Facts, Rule, facts, facts_of, fields_of


class SetPath(NamedTuple):
    """A number that sets fields."""

    facts: Facts  #: the rule is for what a rig is set to; a group is refused as its field is
    fields: tuple[str, ...]  #: of which the first that is there (load, alpha) or all that are (frequency) are set
    in_field: Callable[[float], float]  #: from its unit to that of the field; where more is needed, the number itself
    of: type[Any]  #: record that alone has it

    def checked(self, name: str, value: Any) -> float:
        """The value as its rule keeps it."""
        assert self.facts.rule is not None
        return float(self.facts.rule(name, value, self.facts.note))

    def told(self, name: str, value: Any) -> float:
        """The value in the unit of the field."""
        return self.in_field(self.checked(name, value))

    def field_of(self, part: str, record: type[Any]) -> str | None:
        """The field that it stands for in such a part of a case."""
        known = [f"{part}.{field}" for field in fields_of(record)] if issubclass(record, self.of) else []
        return next((path.partition(".")[2] for path in self.fields if path in known), None)


def _sets(
    *fields: str, unit: str = "-", meaning: str, label: str = "", rule: Rule = positive, note: str | None = None,
    in_field: Callable[[float], float] = float, of: type[Any] = object,
) -> SetPath:  # fmt: skip
    return SetPath(facts(unit, meaning, rule, label=label or meaning, note=note)["facts"], fields, in_field, of)


SET = {
    "load": _sets(
        "oscillation.F_z0", "oscillation.u_z0", unit="N", label="load", note="load in N",
        meaning="mean load; of a prescribed depth, the load that rests at its mean",
    ),
    "frequency": _sets("oscillation.omega", "shake.omega", unit="Hz", meaning="frequency", note="in Hz",
                       in_field=lambda frequency: 2 * math.pi * frequency),
    "tan_delta": _sets("material.tau", meaning="loss tangent at the frequency", label=r"loss tangent $\tan\delta$",
                       rule=not_negative, note="loss tangent", of=KelvinVoigt),
    "support_acceleration": _sets("oscillation.dF_z", unit="m/s²", note="in m/s²",
                                  meaning="amplitude of the acceleration of what a mass stands on"),
    "alpha": _sets("oscillation.du_z", "oscillation.cos", meaning="relative amplitude du_z/u_z0",
                   label=r"amplitude $\alpha = \Delta u_z/u_{z0}$"),
    "chi": _sets("shake.du_x", label=r"amplitude $\chi$", meaning="amplitude along the pull over that at which "
                 "every spring slips at rest, of a tool du_x/(mu_0 kappa u_z0)"),
    "eta": _sets("shake.du_y", label=r"amplitude across $\eta$", meaning="amplitude across the pull over "
                 "that at which every spring slips at rest, of a tool du_y/(mu_0 kappa u_z0)"),
    "T": _sets("material.tau", meaning="omega tau, the loss tangent of a Kelvin material",
               label=r"loss tangent $T = \omega\tau$"),
    "k_x/k_xc": _sets("pull.k_x", meaning="stiffness of the system spring over that of the contact",
                      label="system stiffness $k_x/k_{xc}$"),
    "omega_0/omega": _sets("pull.m", meaning="natural frequency of the body over that of the oscillation",
                           label=r"natural frequency $\omega_0/\omega$"),
    "theta_deg": _sets("indenter.theta", unit="deg", meaning="angle in degrees", in_field=math.radians),
}  # fmt: skip
RIG = ("load", "frequency", "tan_delta", "support_acceleration")  #: what rigs are set to
GROUPS = ("alpha", "chi", "eta", "T", "k_x/k_xc", "omega_0/omega")  #: in the order in which they are set
#: fields that others decide about too: load, tan_delta, support_acceleration hold for them in a whole study
OPEN = ("u_z0", "tau", "dF_z")
HOLD = "hold"  #: beside a load: whether the depth at which it rests stays, or the mean load
VELOCITIES = {
    "v_0": facts("m/s", "pulling velocity", label="pulling velocity $v_0$")["facts"],
    "v_0/v_c": facts(
        "-", "pulling velocity over the critical velocity of the case, Eq. (15)", label="pulling velocity $v_0/v_c$"
    )["facts"],
}  #: of a run, not of a case
STANDS_FOR = {"v_0/v_c": "v_0", "mindlin_ratio": "material.nu"}  #: what else sets one other


def fields_set(path: str) -> tuple[str, ...]:
    """The fields, of which one or all are set by a path."""
    return SET[path].fields if path in (*RIG, *GROUPS) else (one_name(path),)


def require_apart(paths: Sequence[str], names: Sequence[str] = ()) -> None:
    """ValueError where two of these paths set the same; names: as they were given, of other words."""
    sets = [set(fields_set(STANDS_FOR.get(path, path))) for path in paths]
    for (one, its), (two, other) in combinations(zip(names or paths, sets, strict=True), 2):
        if its & other:
            raise ValueError(f"{one} and {two} set the same; keep one of the two")


def one_name(path: str) -> str:
    """The path without the slot of friction, whose fields have two paths."""
    return path.removeprefix("friction.")


def fields_at(slot: str, part: Any) -> list[str]:
    """Paths of the fields that can be set in a part of a case; those of a law of friction stand without their slot."""
    names = part.numbers if isinstance(part, Friction) else fields_of(part)
    return [field if slot == "friction" else f"{slot}.{field}" for field in names]


def set_in(part: Any) -> tuple[str, ...]:
    """Names of all that can be set in a part of a case; of a law of friction also what makes another law of it."""
    return part.taken if isinstance(part, Friction) else fields_of(part)


def paths_of(case: SlidingContact) -> list[str]:
    """Paths of all fields that can be set in a case, those of the law of friction first."""
    found = [path for slot in KINDS for path in fields_at(slot, getattr(case, slot))]
    return sorted(found, key=lambda path: "." in path)


def slot_of(path: str) -> tuple[str, str]:
    """The part of a case and the field that a path of a field says; the field is empty of a part."""
    slot, _, field = path.partition(".")
    return (slot, field) if field or slot in KINDS else ("friction", slot)


def settings_of(part: str) -> dict[str, SetPath]:
    """What a file may give for the fields of a part."""
    given = {name: one for name, one in SET.items() if name not in GROUPS}
    return {name: one for name, one in given.items() if any(path.startswith(f"{part}.") for path in one.fields)}


def hold_of(value: Any) -> str:
    """What stays of a driven depth, "depth" or "load". ValueError for anything else."""
    return word("hold", value, "depth", "load")


def facts_at(path: str) -> Facts:
    """The facts at a path such as "material.tau"; `NOTHING` of an unknown one.

    Where several kinds of a part have the field, its unit is "" if they differ in it, and its meaning that of most.
    """
    if path in (*RIG, *GROUPS):
        return SET[path].facts
    if path in VELOCITIES:
        return VELOCITIES[path]
    slot, name = slot_of(path)
    records = set(_kinds_of(KINDS[slot])) if slot in KINDS else set()
    if not name:
        records, name = {SlidingContact}, slot
    named = sorted((one for one in records if is_dataclass(one)), key=lambda one: one.__name__)
    known = [facts_of(field) for record in named for field in fields(record) if field.name == name]
    found = Counter(one._replace(example=None) for one in known if one.meaning)
    if not found:
        return NOTHING
    usual = found.most_common(1)[0][0]
    return usual if len({one.unit for one in found}) == 1 else usual._replace(unit="")


def _kinds_of(base: type[Any]) -> Iterator[type[Any]]:
    """A class and all that are derived from it."""
    yield base
    for one in base.__subclasses__():
        yield from _kinds_of(one)
