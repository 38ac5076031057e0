"""Laws of friction: how much of a contact bears, per normal force and per area, before it slips.

In full slip friction is mu_0 F_N, and on a disc of radius r_s about the middle a shear strength tau_0 besides:
mu_0 F_N + tau_0 pi r_s². Of a spring at x that is 2 tau_0 sqrt(r_s² - x²) dx. A law of one's own says mu_0, tau_0 and
r_s.

A spring at rest may bear more, up to the share mu_s, until it is let go (`StaticKinetic`).

A case, its file and its paths take numbers without the law: mu_0 = 0.5 is Coulomb(0.5), with a tau_0 above zero it is
ShearStrength(0.5, tau_0), and with a mu_s above 0.5 StaticKinetic(mu_s, 0.5).

Symbols: mu_0 [-], tau_0 [Pa], a radius of contact [m].
"""

from __future__ import annotations

from abc import ABC
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from mdr.tools.arrays import Array
from mdr.tools.checks import not_negative, positive
from mdr.tools.fields import Record, facts, fields_of

__all__ = ["Coulomb", "Friction", "ShearStrength", "StaticKinetic"]

SHARE = facts(
    "-", "local coefficient of friction", not_negative, label=r"local friction $\mu_0$", note="coefficient of friction",
    example=0.5,
)  # fmt: skip


class Friction(Record, ABC):
    """What every law of friction must answer: mu_0, tau_0, and the radius on which the strength acts.

    Examples
    --------
    >>> from dataclasses import dataclass
    >>> import numpy as np
    >>> import mdr
    >>> @dataclass(frozen=True)
    ... class StickySpot(mdr.Friction):
    ...     mu_0: float
    ...     tau_0: float
    ...     b: float
    ...     def strong_radius(self, a):
    ...         return np.minimum(a, self.b)
    >>> print(f"{StickySpot(mu_0=0.2, tau_0=1e4, b=5e-4).full(force=0.5, a=1e-3):.4f} N")
    0.1079 N
    """

    if TYPE_CHECKING:  # fields of a law, or properties

        @property
        def mu_0(self) -> float:
            """Friction over the normal force in slip [-]."""

        @property
        def tau_0(self) -> float:
            """Shear strength [Pa] besides, where it acts."""

    @property
    def stick(self) -> float:
        """Friction up to which a point at rest stays there, over that in slip [-]: above 1 where friction falls."""
        return 1.0

    def strong_radius(self, a: ArrayLike) -> Array:
        """Radius of the disc on which the strength acts [m].

        Parameters
        ----------
        a : array_like of float
            Radius of the contact [m].

        Returns
        -------
        ndarray
            The radius [m] in the shape of a, from 0 to a, no smaller of a larger contact: here the whole contact.
        """
        return np.asarray(a, dtype=float)

    @property
    def kinks(self) -> tuple[float, ...]:
        """Radii of contact [m] at which the strong radius is no smooth function of them."""
        return ()

    @property
    def needs_area(self) -> bool:
        """Whether friction depends on the area of contact, which the shape must know then."""
        return self.tau_0 > 0

    @property
    def is_coulomb(self) -> bool:
        """Whether friction is mu_0 times the normal force at every point and instant, as closed forms take it."""
        return False

    def full(self, force: ArrayLike, a: ArrayLike) -> Array:
        """Friction of full slip [N].

        Parameters
        ----------
        force : array_like of float
            Normal force [N].
        a : array_like of float
            Radius of the contact [m]; not asked for unless `needs_area`.

        Returns
        -------
        ndarray
            mu_0 F + tau_0 pi r_s² [N].
        """
        borne = self.mu_0 * np.asarray(force)
        return np.asarray(borne + self.tau_0 * np.pi * self.strong_radius(a) ** 2 if self.needs_area else borne)

    @property
    def numbers(self) -> tuple[str, ...]:
        """Names of what can be set in the law."""
        return fields_of(self)

    @property
    def taken(self) -> tuple[str, ...]:
        """Names that `varied` takes: `numbers`, and those that make another law of it."""
        return self.numbers

    def varied(self, **changes: Any) -> Friction:
        """The law with other numbers.

        Parameters
        ----------
        **changes
            Values by name, of those in `taken`.

        Returns
        -------
        Friction
            A law of the same kind.
        """
        return replace(self, **changes)  # type: ignore[type-var]

    @property
    def simplest(self) -> Friction:
        """The law, or a simpler one that is the same."""
        return self


class _OfNumbers(Friction):
    """A law that is made of mu_0 and tau_0 alone, and changes its kind with them, and with a mu_s."""

    @property
    def mu_s(self) -> float:
        """At rest as in slip: mu_0 [-]."""
        return self.mu_0

    @property
    def numbers(self) -> tuple[str, ...]:
        """Both, as a strength may be set in either."""
        return fields_of(ShearStrength)

    @property
    def taken(self) -> tuple[str, ...]:
        """These, and mu_s."""
        return (*self.numbers, "mu_s")

    @property
    def is_coulomb(self) -> bool:
        """Without a strength."""
        return not self.tau_0

    @property
    def simplest(self) -> Friction:
        """Coulomb's law without a strength."""
        return self if self.tau_0 or isinstance(self, Coulomb) else Coulomb(self.mu_0)

    def varied(self, **changes: Any) -> Friction:
        """The law of these numbers."""
        return of_numbers(**{"mu_0": self.mu_0, "tau_0": self.tau_0, **changes})


@dataclass(frozen=True)
class Coulomb(_OfNumbers):
    """Friction is mu_0 times the normal force."""

    mu_0: float = field(metadata=SHARE)

    def __post_init__(self) -> None:
        super().__post_init__()
        positive("mu_0", self.mu_0, "coefficient of friction; it may be 0 where tau_0 is above")

    @property
    def tau_0(self) -> float:
        """No strength: zero [Pa]."""
        return 0.0


@dataclass(frozen=True)
class ShearStrength(_OfNumbers):
    """Friction is mu_0 times the normal force, and tau_0 times the area of contact; mu_0 may be 0.

    Examples
    --------
    >>> import mdr
    >>> mdr.ShearStrength(mu_0=0.2, tau_0=1e4).full(force=0.5, a=1e-3)
    array(0.13141593)
    """

    mu_0: float = field(metadata=SHARE)
    tau_0: float = field(
        metadata=facts(
            "Pa", "shear strength of the face, beside mu_0", not_negative, label=r"shear strength $\tau_0$", example=1e4
        )
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.tau_0:
            Coulomb(self.mu_0)  # refuses what is no friction at all


@dataclass(frozen=True)
class StaticKinetic(Friction):
    """A point sticks up to mu_s times its normal force, and slips at mu_k times that: friction falls at once.

    `mu_0` of it, the share in slip, is mu_k. With mu_s = mu_k a case has `Coulomb`.

    Examples
    --------
    >>> import mdr
    >>> mdr.StaticKinetic(mu_s=0.6, mu_k=0.5).mu_0
    0.5
    """

    mu_s: float = field(metadata=facts("-", "static coefficient of friction", example=0.6))
    mu_k: float = field(metadata=facts("-", "kinetic coefficient of friction", example=0.5))

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.mu_s < self.mu_k:
            raise ValueError(
                f"mu_s = {self.mu_s:.6g} must not be below mu_k = {self.mu_k:.6g}: friction falls as a point is let "
                "go; raise mu_s, or give mdr.Coulomb(mu_0)"
            )

    @property
    def mu_0(self) -> float:
        """In slip: mu_k."""
        return self.mu_k

    @property
    def tau_0(self) -> float:
        """No strength: zero [Pa]."""
        return 0.0

    @property
    def stick(self) -> float:
        """mu_s over mu_k."""
        return self.mu_s / self.mu_k

    @property
    def taken(self) -> tuple[str, ...]:
        """Both; mu_0 for mu_k; and tau_0, to be refused in words."""
        return (*self.numbers, "mu_0", "tau_0")

    @property
    def simplest(self) -> Friction:
        """Coulomb's law where friction does not fall."""
        return self if self.stick > 1 else Coulomb(self.mu_k)

    def varied(self, **changes: Any) -> Friction:
        """The law with other numbers; mu_0 is mu_k."""
        if changes.pop("tau_0", 0.0):
            raise ValueError(NO_LAW)
        if {"mu_0", "mu_k"} <= set(changes):
            raise ValueError("mu_0 and mu_k say the same: give one of them")
        if "mu_0" in changes:
            changes["mu_k"] = changes.pop("mu_0")
        return super().varied(**changes)


NO_LAW = "tau_0 beside mu_s and mu_k is no law: give mdr.ShearStrength(mu_0, tau_0), or mdr.StaticKinetic(mu_s, mu_k)"
#: laws that a file need not name: the first of which it has a key that Coulomb has not
UNNAMED = (StaticKinetic, ShearStrength, Coulomb)
#: numbers of friction that stand without a law
SHORTHAND = tuple(dict.fromkeys(name for law in reversed(UNNAMED) for name in fields_of(law)))


def of_numbers(mu_0: Any, tau_0: Any = 0.0, mu_s: Any = None) -> Friction:
    """The law of these numbers: Coulomb's without a strength, and without a mu_s above mu_0."""
    if mu_s is None:
        return ShearStrength(mu_0, tau_0).simplest
    law = StaticKinetic(mu_s, mu_0).simplest
    return law.varied(tau_0=tau_0) if tau_0 else law


def law_of(friction: Any, mu_0: Any, tau_0: Any, mu_s: Any = None, known: Friction | None = None) -> Any:
    """The law that is given to a case, by itself or by its numbers; known: the law of the case that this one varies.

    `dataclasses.replace` hands over law and numbers as they stand in the case but for what it changes.
    """
    given, usual = {"mu_0": mu_0, "tau_0": tau_0, "mu_s": mu_s}, {"mu_0": None, "tau_0": 0.0, "mu_s": None}
    if known is not None:
        usual = {"mu_0": known.mu_0, "tau_0": known.tau_0, "mu_s": static_of(known)}
    changed = {name: value for name, value in given.items() if value is not usual[name] and value != usual[name]}
    if known is not None and friction is known:
        return known.varied(**changed) if changed else known
    if friction is None:
        if mu_0 is None:
            raise TypeError("friction is missing: give mu_0, or a law such as friction=mdr.Coulomb(mu_0)")
        return of_numbers(mu_0, tau_0, mu_s)
    if changed:
        names = " and ".join(changed)
        raise ValueError(f"{names} and friction say the same: give {names}, or the law {type(friction).__name__} alone")
    return friction


def static_of(law: Friction) -> float:
    """Friction over the normal force up to which a point at rest stays there [-]."""
    return float(getattr(law, "mu_s", law.mu_0 * law.stick))


def named_full(full: float, mu_0: float) -> str:
    """The COF of full slip, named."""
    return f"mu_0 = {mu_0:.6g}" if full == mu_0 else f"{full:.6g} in full slip"
