"""The sliding contact: indenter, material, friction, motion and pull in one frozen record; what it refuses.

A script, a TOML file and a study describe the same thing, and all of them end here. Stiffnesses belong to
the mean depth u_z0 (under an oscillating load, to the depth at which the mean load rests): k_zc = 2 E* a(u_z0),
k_xc = 2 G* a(u_z0), and gamma = tau k in both directions, Eq. (11). E* and G* are long-time moduli; what Maxwell arms
add is in the dynamic stiffness K_z(omega) = k_zc E*(omega)/E*.

Every property is computed from the fields, in `in_motion` and `scales`. Under a LoadOscillation the depth is none of
them, and what depends on it is asked of `mdr.resolved(case)`.
"""

from __future__ import annotations

from dataclasses import InitVar, dataclass, field, fields, is_dataclass, replace
from inspect import signature
from typing import Any

import numpy as np

from mdr.case.friction import UNNAMED, Friction, law_of, static_of
from mdr.case.in_plane import Shake, sign_of
from mdr.case.motion import Motion
from mdr.case.pull import Pull, RigidPull
from mdr.case.scales import Scales
from mdr.indenters.base import Indenter
from mdr.materials.base import Material, answers, refuse_other_materials
from mdr.tools.arrays import SAME
from mdr.tools.checks import instance, not_negative, positive
from mdr.tools.fields import Record, check_fields, facts, facts_of
from mdr.tools.messages import short
from mdr.tools.summary import Row, Summarised, Summary, number

#: abstract base class of each part
KINDS: dict[str, type[Any]] = {
    "indenter": Indenter,
    "material": Material,
    "friction": Friction,
    "oscillation": Motion,
    "pull": Pull,
    "shake": Shake,
}
OPTIONAL = ("shake",)  #: parts that may be None
SAMPLES = 33  #: radii of contact of which a law of friction is asked


@dataclass(frozen=True)
class SlidingContact(Scales, Record, Summarised):
    """An indenter that slides on a half-space while it is shaken, in the normal direction or in the plane.

    Friction is a law, ``friction=mdr.Coulomb(0.5)``, or given by its numbers: mu_0, and tau_0, the shear strength of a
    face [Pa], or mu_s, up to which a point at rest stays there. All can be read of every case.

    Examples
    --------
    >>> import mdr
    >>> case = mdr.SlidingContact(
    ...     indenter=mdr.Paraboloid(R=5e-3),
    ...     material=mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-3),
    ...     mu_0=0.5,
    ...     oscillation=mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=314.0),
    ...     pull=mdr.SpringPull(k_x=2e4, m=0.1, c_x=4.0),
    ... )
    >>> print(f"k_zc = {case.k_zc:.0f} N/m, alpha = {case.alpha:.2g}")
    k_zc = 2530 N/m, alpha = 0.1
    """

    indenter: Indenter = field(metadata=facts("", "shape", rule=None))
    material: Material = field(metadata=facts("", "half-space", rule=None))
    mu_0: InitVar[float] = None
    oscillation: Motion = field(default=None, metadata=facts("", "normal motion", rule=None))  # type: ignore[assignment]
    pull: Pull = field(default_factory=RigidPull, metadata=facts("", "what pulls in the plane", rule=None))
    shake: Shake | None = field(default=None, metadata=facts("", "shake in the plane, besides the pull", rule=None))
    tau_0: InitVar[float] = 0.0
    friction: Friction = field(default=None, metadata=facts("", "law of friction", rule=None))  # type: ignore[assignment]
    mu_s: InitVar[float | None] = field(default=None, kw_only=True)
    _law: InitVar[Friction | None] = field(default=None, kw_only=True)  # handed over by dataclasses.replace

    def __post_init__(self, mu_0: Any, tau_0: Any, mu_s: Any, _law: Friction | None) -> None:
        self._keep(law_of(self.friction, mu_0, tau_0, mu_s, _law))
        for name, kind in KINDS.items():
            if name not in OPTIONAL or getattr(self, name) is not None:
                instance(name, getattr(self, name), kind)
        self._refuse_what_springs_do_not_know()
        check_fields(self)
        if self.friction.needs_area and not self.indenter.is_body:
            raise ValueError(
                f"tau_0 = {self.tau_0:.6g} Pa acts on an area of contact, which {type(self.indenter).__name__} does "
                "not know: set tau_0 = 0"
            )
        if self.material.E_star == 0:
            raise ValueError(
                "E_inf = 0: a mean load relaxes to nothing, or sinks in without end, so that there is no periodic "
                "state whose friction could be averaged; give the material a long-time modulus, or use indent()"
            )
        if not self.oscillation.omega and (self.shake is None or self.shake.is_still):
            raise ValueError(
                f"nothing oscillates: {self.oscillation!r} is constant, and shake = {self.shake!r}; friction is then "
                "what it is without vibration; give a shake with an amplitude, or an oscillation"
            )
        _ = self.repeats  # refuses frequencies in no ratio
        guided = np.isinf(self.pull.across[2]) and not self.pull.is_rigid
        if self.shake is not None and self.shake.at == "pull" and self.moves_across and guided:
            raise ValueError(
                "the pulling point is shaken across, and the body is guided there, so that nothing moves: give the "
                'pull a stiffness k_y, or shake at = "tool"'
            )
        object.__setattr__(self, "oscillation", self.oscillation.on(self.indenter, self.material))
        if self.oscillation.knows_depth:
            if not self.u_z_max > 0:
                motion = type(self.oscillation).__name__
                raise ValueError(
                    f"the indenter never touches: the greatest depth of {motion} is {self.u_z_max:.6g} m; raise its "
                    "mean depth or its amplitude"
                )
            a = float(self.indenter.contact_radius(self.u_z_max))  # a shape that does not reach so deep says so here
            if self.friction.needs_area:
                self._refuse_other_radii(a)
            if self.indenter.least_depth > 0:
                self._refuse_incomplete()

    def _keep(self, law: Friction) -> None:
        """Keep the law, and its numbers beside it. One of a user's own may answer what is no friction."""
        instance("friction", law, Friction)
        answers("friction", law, "mu_0", "the share of the normal force that it bears in slip [-]")
        answers("friction", law, "tau_0", "its shear strength [Pa], 0.0 for none")
        law = law.simplest
        mu_0, tau_0 = (not_negative(f"{one} of {type(law).__name__}", getattr(law, one)) for one in ("mu_0", "tau_0"))
        if not mu_0 + tau_0 > 0 or (law.is_coulomb and tau_0 > 0):
            raise ValueError(
                f"friction = {law!r} answers mu_0 = {mu_0!r}, tau_0 = {tau_0!r} Pa, is_coulomb = {law.is_coulomb!r}: "
                "one of the numbers must be above 0, and Coulomb's friction has no strength"
            )
        stick = positive(f"stick of {type(law).__name__}", law.stick, "static over kinetic friction, 1 where it stays")
        if stick < 1 or (stick > 1 and (law.is_coulomb or not mu_0)):
            raise ValueError(
                f"friction = {law!r} answers stick = {stick!r}, mu_0 = {mu_0!r}, is_coulomb = {law.is_coulomb!r}: "
                "stick must not be below 1; where it is above, mu_0 must be above 0 and the law is not Coulomb's"
            )
        kept = {"friction": law, "_law": law, "mu_0": mu_0, "tau_0": tau_0, "mu_s": static_of(law)}
        for name, value in kept.items():
            object.__setattr__(self, name, value)

    def _refuse_other_radii(self, greatest: float) -> None:
        """A law of a user's own may answer no radius in the contact, or one of a single contact alone."""
        law, a = self.friction, np.linspace(0.0, greatest, SAMPLES)
        try:
            radius, kinks = np.asarray(law.strong_radius(a), dtype=float), np.array([*law.kinks], dtype=float)
        except (TypeError, ValueError) as fault:
            raise TypeError(
                f"friction = {law!r} must answer strong_radius(a) of an array a, such as np.minimum(a, b) where min(a, "
                f"b) is meant, and a tuple of kinks: {fault}"
            ) from fault
        miss = SAME * greatest
        if radius.shape != a.shape or not (
            radius[-1] > 0 and np.all((radius >= 0) & (radius <= a + miss)) and np.all(np.diff(radius) >= -miss)
        ):
            raise ValueError(
                f"friction = {law!r} answers strong_radius(a) = {short(repr(radius.tolist()))} m of contacts of the "
                f"radii a = {short(repr(a.tolist()))} m: a strength acts within each, from 0 to a, on no less of a "
                "larger one, and not nowhere; set tau_0 = 0 where there is none"
            )
        if not np.all(kinks >= 0):
            raise ValueError(f"friction = {law!r} answers kinks = {law.kinks!r}: they must be radii of contact [m]")

    def _summary(self) -> Summary:
        parts = [(name, getattr(self, name)) for name in KINDS]
        rows = [row for name, part in parts if part is not None for row in _told(name, part)]
        if not self.oscillation.knows_depth:
            return Summary("SlidingContact", [*rows, ("contact", "under a load", "mdr.resolved(case) finds its depth")])
        a = float(self.indenter.contact_radius(max(self.working_depth, 0.0)))
        stiff = f"k_zc = {number(self.k_zc, 'N/m')}, k_xc = {number(self.k_xc, 'N/m')}, at the mean depth"
        return Summary("SlidingContact", [*rows, ("contact", f"a = {number(a, 'm')}", stiff)])

    def _refuse_what_springs_do_not_know(self) -> None:
        """Parts of a user's own may answer what no march computes with."""
        answers("oscillation", self.oscillation, "omega", "its angular frequency [rad/s]")
        m, c_x, k_x = self.pull.coefficients
        if not (0 <= m < np.inf and 0 <= c_x < np.inf and k_x > 0) or (np.isinf(k_x) and (m > 0 or c_x > 0)):
            raise ValueError(
                f"pull = {self.pull!r} answers coefficients m = {m!r} kg, c_x = {c_x!r} N s/m, k_x = {k_x!r} N/m: mass "
                "and damping must be finite and not negative, stiffness above 0; infinite for a rigid pull, whose mass "
                "and damping are 0"
            )
        refuse_other_materials(self.material, self.omega)

    def _refuse_incomplete(self) -> None:
        """A hollow face must press everywhere at every instant."""
        cycle, needed = self.cycle, self.indenter.least_depth
        least = cycle.u_z0 + cycle.unit * self.kept_gap
        if least < needed:
            raise ValueError(
                f"u_z0 = {cycle.u_z0:.6g} m is too shallow for {type(self.indenter).__name__}: with this oscillation "
                f"and material its middle presses only from {needed + cycle.u_z0 - least:.6g} m on; short of that a "
                "ring would touch, which the method leaves out"
            )

    @property
    def mirrored(self) -> SlidingContact:
        """The contact seen from the other side: what it does forward, this one does backward."""
        return self if self.shake is None else replace(self, shake=self.shake.mirrored)

    def pulled(self, direction: int) -> SlidingContact:
        """The contact whose pull forward is the pull of this one in a direction.

        Parameters
        ----------
        direction : int
            1 for the pull forward, -1 for the pull the other way.

        Returns
        -------
        SlidingContact
            This one, or its mirror image.

        Raises
        ------
        ValueError
            For any other direction.
        """
        return self if sign_of(direction) == 1 else self.mirrored


#: the argument of `dataclasses.replace` alone is none of its users
SlidingContact.__signature__ = signature(SlidingContact).replace(  # type: ignore[attr-defined]
    parameters=[one for one in signature(SlidingContact).parameters.values() if one.name != "_law"]
)


def _told(name: str, part: Any) -> list[Row]:
    """A part of a case in a row: its kind, and its numbers with their units; a row each of those that are a law."""
    if isinstance(part, UNNAMED):
        return [
            (one.name, number(getattr(part, one.name), facts_of(one).unit), facts_of(one).meaning)
            for one in fields(part)
        ]
    part = getattr(part, "load", None) or part  # of a depth that was solved for, what it was solved from
    if not is_dataclass(part):
        return [(name, type(part).__name__, short(repr(part)))]
    given = [(one, getattr(part, one.name)) for one in fields(part) if one.init]
    values = [_written(one.name, value, facts_of(one).unit) for one, value in given if value not in (None, ())]
    return [(name, type(part).__name__, ", ".join(values))]


def _written(name: str, value: Any, unit: str) -> str:
    """A field and its value; a list by its length, an angular frequency in hertz too."""
    if callable(value):
        return f"{name} = {getattr(value, '__name__', type(value).__name__)}"
    if isinstance(value, tuple):
        return f"{name} of {len(value)}"
    if isinstance(value, bool) or not isinstance(value, int | float):
        return f"{name} = {short(repr(value), 40)}"
    hertz = f" ({value / (2 * np.pi):.6g} Hz)" if unit == "rad/s" else ""
    return f"{name} = {number(value, unit)}{hertz}"


def require_case(case: object) -> SlidingContact:
    """The case itself; TypeError for anything that is not a SlidingContact."""
    if not isinstance(case, SlidingContact):
        raise TypeError(f"case must be a SlidingContact, got {case!r}")
    return case


def as_given(case: object) -> SlidingContact:
    """The case with the motion that imposes its depth: of a resolved case, its load."""
    case = require_case(case)
    return case if case.oscillation.load is None else replace(case, oscillation=case.oscillation.load)
