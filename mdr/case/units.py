"""What a path of a study is called and measured in: a field of a record tells itself, a dimensionless group here."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any

from mdr.case.contact import KINDS, SlidingContact
from mdr.tools.fields import NOTHING, Facts, facts, facts_of

NO_FIELDS = {
    "v_0": facts("m/s", "pulling velocity", label="pulling velocity $v_0$"),
    "v_0/v_c": facts(
        "-", "pulling velocity over the critical velocity of the case, Eq. (15)", label="pulling velocity $v_0/v_c$"
    ),
    "load": facts("N", "mean load; of a prescribed depth, the load that rests at its mean", label="load"),
    "frequency": facts("Hz", "frequency", label="frequency"),
    "tan_delta": facts("-", "loss tangent at the frequency", label=r"loss tangent $\tan\delta$"),
    "alpha": facts("-", "relative amplitude du_z/u_z0", label=r"amplitude $\alpha = \Delta u_z/u_{z0}$"),
    "T": facts("-", "omega tau, the loss tangent of a Kelvin material", label=r"loss tangent $T = \omega\tau$"),
    "k_x/k_xc": facts(
        "-", "stiffness of the system spring over that of the contact", label="system stiffness $k_x/k_{xc}$"
    ),
    "chi": facts(
        "-",
        "amplitude along the pull over the deflection at which springs slip, du_x/(mu_0 kappa u_z0)",
        label=r"amplitude $\chi$",
    ),
    "eta": facts(
        "-",
        "amplitude across the pull over the deflection at which springs slip, du_y/(mu_0 kappa u_z0)",
        label=r"amplitude across $\eta$",
    ),
    "omega_0/omega": facts(
        "-", "natural frequency of the body over that of the oscillation", label=r"natural frequency $\omega_0/\omega$"
    ),
}  #: paths of a study that are none of a record


def facts_at(path: str) -> Facts:
    """The facts at a path such as "material.tau"; `NOTHING` of an unknown one.

    Where several kinds of a part have the field, its unit is "" if they differ in it, and its meaning that of most.
    """
    if path in NO_FIELDS:
        return NO_FIELDS[path]["facts"]
    slot, _, name = path.rpartition(".")
    records = set(_kinds_of(KINDS[slot])) if slot in KINDS else {SlidingContact} if not slot else set()
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
