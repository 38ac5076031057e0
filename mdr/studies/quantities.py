"""What a study can compute: a catalogue of quantities, their derivatives, and quantities of one's own.

Those of the first list follow from a case alone, those of the second from its COF curve and need an axis of velocity.
A derivative is named as it is written, "d cof/d oscillation.du_z", with any number of a case, or v_0, below.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mdr.case.contact import KINDS, SlidingContact
from mdr.case.paths import HOLD, RIG, VELOCITIES, facts_at
from mdr.closed_forms.critical_velocity import critical_velocity
from mdr.closed_forms.full_slip import static_cof
from mdr.closed_forms.full_slip_body import full_slip_critical_velocity
from mdr.friction.cof_curve import Columns
from mdr.friction.inputs import OF_RUN
from mdr.friction.measured_velocity import measure_critical_velocity
from mdr.friction.sensitivity import QUANTITIES, sensitivity
from mdr.given.vary import value_at
from mdr.march.periodic.steady import BUDGET
from mdr.march.result.slowest import least_velocity
from mdr.normal.normal_force import full_cof, mean_normal_force
from mdr.normal.resolved import at_rest, resolved
from mdr.tools.allowed import refusal_of
from mdr.tools.arrays import Array
from mdr.tools.checks import truth
from mdr.tools.messages import offer, short
from mdr.tools.notation import quotient

_DERIVATIVE = re.compile(r"d (\S+)/d (.+)")


@dataclass(frozen=True)
class Quantity:
    """A quantity of one's own: of(case), or of(case, v_0) with per_velocity, returns a float.

    Its name is its identity in a store, which cannot look into a function: a function that is changed needs a new name,
    or a new store. For other processes `of` must be defined at the top of a module.

    Examples
    --------
    >>> import mdr
    >>> radius = mdr.Quantity("a", "m", lambda case: case.indenter.contact_radius(case.oscillation.u_z0))
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> case = mdr.SlidingContact(mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5), 0.4, vibration)
    >>> mdr.sweep(case, {"oscillation.u_z0": [10e-6, 20e-6]}, quantities=(radius,))["a"].round(6)
    array([0.000501, 0.001002])
    """

    name: str  #: letters, digits and _
    unit: str  #: "-" for a pure number
    of: Callable[..., float]  #: of(case), or of(case, v_0) with v_0 >= 0 in m/s
    meaning: str = ""  #: in a few words
    per_velocity: bool = field(default=False, kw_only=True)  #: whether it depends on the pulling velocity

    def __post_init__(self) -> None:
        """What is given is checked; a derivative has its name from the reader of names."""
        for name in ("name", "unit", "meaning"):
            if not isinstance(getattr(self, name), str):
                raise TypeError(f"{name} must be a string, got {getattr(self, name)!r}")
        if not re.fullmatch(r"[A-Za-z]\w*", self.name, re.ASCII) or self.name in ("status", "why", "reason", "reasons"):
            raise ValueError(f"name must be of letters, digits and _, and not that of a status, got {self.name!r}")
        if not callable(self.of):
            raise TypeError(f"of must be a function of the case, got {self.of!r}")
        truth("per_velocity", self.per_velocity)


@dataclass(frozen=True)
class CurveQuantity(Quantity):
    """A quantity of all velocities of a case: of(case, curve) returns an array in their shape, curve being Columns."""

    of: Callable[..., Any]
    per_velocity: bool = field(default=True, kw_only=True)
    closely: bool = field(default=True, kw_only=True)  #: whether it reads stick_share, for which springs are looked at


@dataclass(frozen=True)
class _Attribute:
    """An attribute of what a case is known by, or of its curve, as a function that can be sent to other processes."""

    name: str
    known: Callable[[SlidingContact], Any] | None = None

    def __call__(self, case: SlidingContact, curve: Columns | None = None) -> Any:
        return getattr(self.known(case) if self.known else case if curve is None else curve, self.name)


@dataclass(frozen=True)
class Derivative(Quantity):
    """A derivative in SI of a quantity with respect to an input of the case, by `mdr.sensitivity`."""

    of: Slope

    def __post_init__(self) -> None:
        """Its name is that of a derivative, and was read."""


@dataclass(frozen=True)
class Slope:
    """What a derivative is, as a function that can be sent to other processes."""

    quantity: str  #: of those that `sensitivity` has
    path: str  #: of the input
    held: Mapping[str, Any] = field(default_factory=dict)  #: while the input varies; None: as the case has it
    accuracy: float = BUDGET  #: as in `sensitivity`

    def __call__(self, case: SlidingContact, v_0: float | None = None) -> float:
        """The derivative; ValueError says why there is none."""
        hold = self.held.get(HOLD, "depth")
        held = {path: value_at(case, path, hold) if one is None else one for path, one in self.held.items()}
        found = sensitivity(case, v_0, [self.path], held=held, accuracy=self.accuracy)
        for slope in getattr(found, f"d_{self.quantity}").values():
            return float(slope)
        raise ValueError(next(iter(found.why[self.quantity].values()), None) or refusal_of(static_cof, case))


def _share(case: SlidingContact, curve: Columns) -> Array:
    return curve.cof / full_cof(case)


def _mean_F_x(case: SlidingContact, curve: Columns) -> Array:
    return curve.cof * mean_normal_force(case)


def _mean_F_z(case: SlidingContact, curve: Columns) -> Array:
    return np.full(curve.cof.shape, mean_normal_force(case))


def _measured(case: SlidingContact) -> float:
    found = measure_critical_velocity(case)
    if found.v_c is None:
        raise ValueError(f"{'there is none' if found.kind == 'none' else 'not measured'}: {found.why}")
    return found.v_c


CATALOGUE: dict[str, Quantity] = {
    one.name: one
    for one in (
        Quantity("v_c", "m/s", critical_velocity, "critical velocity, Eq. (15)"),
        Quantity("full_slip_v_c", "m/s", full_slip_critical_velocity, "critical velocity with all harmonics of F_N"),
        Quantity("measured_v_c", "m/s", _measured, "critical velocity measured from runs"),
        Quantity("static_cof", "-", static_cof, "coefficient of friction in the limit v_0 -> 0"),
        Quantity("k_zc", "N/m", _Attribute("k_zc", at_rest), "normal contact stiffness at the mean depth"),
        Quantity("k_xc", "N/m", _Attribute("k_xc", at_rest), "tangential contact stiffness at the mean depth"),
        Quantity("alpha", "-", _Attribute("alpha", resolved), "relative amplitude du_z/u_z0"),
        Quantity("T", "-", _Attribute("T"), "omega tau of the long-time branch"),
        Quantity("mean_F_N", "N", mean_normal_force, "mean normal force"),
        Quantity(
            "least_velocity",
            "m/s",
            least_velocity,
            "least velocity of a body that is pulled from rest, each averaged over a period of the vibration",
            per_velocity=True,
        ),
        CurveQuantity("cof", "-", _Attribute("cof"), "average coefficient of friction", closely=False),
        CurveQuantity(
            "cof_y", "-", _Attribute("cof_y"), "the same across the pull, mean F_y over mean F_z", closely=False
        ),
        CurveQuantity("share", "-", _share, "cof over that of full slip, cof/mu_0 by Coulomb's law", closely=False),
        CurveQuantity("cof_error", "-", _Attribute("cof_error"), "bound on the numerical error of cof", closely=False),
        CurveQuantity("stick_share", "-", _Attribute("stick_share"), "force-weighted share of contact time in stick"),
        CurveQuantity("settled", "-", _Attribute("settled"), "1 where the run settled, else 0", closely=False),
        CurveQuantity(
            "mean_F_x", "N", _mean_F_x, "mean tangential force, cof times the mean normal force", closely=False
        ),
        CurveQuantity("mean_F_z", "N", _mean_F_z, "mean normal force, the same at any velocity", closely=False),
    )
}


def read_quantities(
    quantities: Iterable[str | Quantity],
    paths: Iterable[str],
    beside: Iterable[str] = (),
    held: Mapping[str, Any] | None = None,
    accuracy: float = BUDGET,
) -> tuple[Quantity, ...]:
    """The quantities of a study with axes of these paths, over v_0 with the critical velocity that maps are read by,
    and some besides. held, accuracy: of derivatives; what an axis sets a rig to is held, too.

    Raises ValueError or TypeError for what cannot be computed.
    """
    if isinstance(quantities, str | Quantity) or not isinstance(quantities, Iterable):
        raise TypeError(f"quantities must be a list of names, got {short(repr(quantities))}; write [...]")
    paths = list(paths)
    kept = {**(held or {}), **{path: None for path in paths if path in RIG}}
    found = tuple(_known(one, {HOLD: "depth", **kept} if "load" in kept else kept, accuracy) for one in quantities)
    if not found:
        raise ValueError(f"quantities must name at least one; there are {', '.join(CATALOGUE)}")
    names = [one.name for one in found]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"quantities has {name} twice; give each once")
        if name in paths:
            raise ValueError(f"{name} is an axis of the study already; leave it out of quantities")
    if not any(path in VELOCITIES for path in paths) and (moving := [one.name for one in found if one.per_velocity]):
        asks = "needs" if len(moving) == 1 else "need"
        raise ValueError(f'{" and ".join(moving)} {asks} a velocity: give an axis "v_0" [m/s] or "v_0/v_c"')
    others = [*(("v_c",) if "v_0" in paths else ()), *beside]
    return found + tuple(CATALOGUE[name] for name in others if name not in [*names, *paths])


def _known(one: Any, held: Mapping[str, Any], accuracy: float) -> Quantity:
    if isinstance(one, str) and (parts := _DERIVATIVE.fullmatch(one)):
        return _derivative(one, parts[1], Slope(parts[1], parts[2], held, accuracy))
    if isinstance(one, str):
        if one not in CATALOGUE:
            raise ValueError(f"{short(one)} is no quantity of the catalogue; {offer(one, list(CATALOGUE))}")
        return CATALOGUE[one]
    if not isinstance(one, Quantity):
        raise TypeError(f"quantities must be names or Quantity records, got {short(repr(one))} among them")
    if CATALOGUE.get(one.name, one) != one:
        raise ValueError(f"{one.name} is the name of another quantity of the catalogue; give yours one of its own")
    return one


def _derivative(name: str, quantity: str, of: Slope) -> Derivative:
    """The derivative of this name. ValueError for a quantity that has none, and for what is no input."""
    known = [one for one in QUANTITIES if one in CATALOGUE]
    if quantity not in known:
        raise ValueError(f"{short(name)}: {short(quantity)} has no derivative here, but {', '.join(known)} have")
    above, below, moves = CATALOGUE[quantity], facts_at(of.path), quantity == "cof"
    if of.path == OF_RUN and not moves:
        raise ValueError(f"{name}: {quantity} does not depend on {OF_RUN}")
    if not below.meaning or of.path in {*KINDS, *VELOCITIES} - {OF_RUN}:
        such = "oscillation.du_z, material.E, load or v_0"
        raise ValueError(f"{short(name)}: {short(of.path)} is no input of a case, such as {such}")
    meaning = f"derivative of the {above.meaning} with respect to the {below.meaning}"
    return Derivative(name, quotient(above.unit, below.unit), of, meaning, per_velocity=moves)
