"""Domain of a closed form: the cases that it takes, said once, at the function that answers.

    @holds_for(COULOMB, RIGID, UNSHAKEN, instead="cof_curve")
    def law(case, v_0): ...

Any other case is refused in words that follow from the domain: what the law takes, what of the case is outside, and
what answers instead. `case in domain_of(law)` asks before. The guide's table of laws is written from the domains.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import wraps
from operator import attrgetter
from typing import Any, NamedTuple, TypeVar, cast

from mdr.case.contact import SlidingContact, require_case
from mdr.case.friction import ShearStrength
from mdr.tools.messages import short

F = TypeVar("F", bound=Callable[..., Any])


class OutsideDomain(ValueError, TypeError):
    """A case that a closed form does not hold for: one of its values, or the kind of one of its parts."""


class Condition(NamedTuple):
    """What a closed form asks of one quantity of a case."""

    quantity: str  #: path from the case, such as "pull" or "pull.damping_ratio"
    words: str  #: what it takes
    holds: Callable[[SlidingContact], bool]


@dataclass(frozen=True)
class Domain:
    """The cases that fulfil all conditions; a condition is asked where those before it are fulfilled."""

    conditions: tuple[Condition, ...]
    instead: str  #: what to ask for another case
    of: Callable[[SlidingContact], SlidingContact] = require_case  #: what is asked, such as the case `resolved`

    def __contains__(self, case: SlidingContact) -> bool:
        return self._missed(self.of(case)) is None

    def _missed(self, case: SlidingContact) -> Condition | None:
        return next((one for one in self.conditions if not one.holds(case)), None)

    def seen(self, case: SlidingContact, name: str) -> SlidingContact:
        """The case as it was asked. OutsideDomain if it is outside; name: of what does not hold for it."""
        case = self.of(case)
        if missed := self._missed(case):
            value = attrgetter(missed.quantity)(case)
            told = f"{value:.6g}" if isinstance(value, float) else short(repr(value))
            raise OutsideDomain(f"{name} takes {missed.words}, got {missed.quantity} = {told}: ask {self.instead}")
        return case


def holds_for(
    *conditions: Condition, instead: str, of: Callable[[SlidingContact], SlidingContact] = require_case
) -> Callable[[F], F]:
    """Decorator of a function whose first argument is a case: it answers in this domain alone, and gets what was asked.

    The arguments are those of `Domain`.
    """
    domain = Domain(conditions, instead, of)

    def gated(function: F) -> F:
        @wraps(function)
        def call(*args: Any, **given: Any) -> Any:
            case = args[0] if args else given.pop("case", None)
            return function(domain.seen(case, function.__name__), *args[1:], **given)

        call.domain = domain  # type: ignore[attr-defined]
        return cast("F", call)

    return gated


def domain_of(function: Callable[..., Any]) -> Domain:
    """Where a function of `holds_for` answers."""
    return cast("Domain", function.domain)  # type: ignore[attr-defined]


COULOMB = Condition("friction", "Coulomb's friction", lambda case: case.friction.is_coulomb)
NO_STRENGTH = Condition("friction", "no shear strength", lambda case: not case.friction.needs_area)
ALIKE = Condition("friction", "friction that does not fall", lambda case: case.friction.stick == 1)
STRENGTH = Condition("friction", "a shear strength", lambda case: isinstance(case.friction, ShearStrength))
RIGID = Condition("pull", "a rigid pull", lambda case: case.pull.is_rigid)
ON_SPRING = Condition("pull", "a body on a spring", lambda case: not case.pull.is_rigid)
WITH_MASS = Condition("pull", "a body with a mass", lambda case: case.pull.coefficients[0] > 0)
UNDERDAMPED = Condition("pull.damping_ratio", "a damping ratio below 1", lambda case: case.pull.damping_ratio < 1)
UNSHAKEN = Condition("shake", "no shake in the plane", lambda case: not case.is_shaken)
SHAKEN = Condition("shake", "a shake in the plane", lambda case: case.is_shaken)
NO_SHAKE = Condition("shake", "no shake", lambda case: case.shake is None)
GIVEN_DEPTH = Condition("oscillation", "a depth that is known", lambda case: case.oscillation.knows_depth)
HARMONIC = Condition(
    "oscillation",
    "a harmonic depth",
    lambda case: case.oscillation.knows_depth and case.oscillation.load is None and case.cycle.is_harmonic,
)
ABOVE_ZERO = Condition("working_depth", "a mean depth above 0", lambda case: case.working_depth > 0)
ELASTIC = Condition("material", "an elastic material", lambda case: not case.rheology.remembers)
NO_ARMS = Condition("material", "an elastic or Kelvin material", lambda case: not case.material.contact_arms)
RIGID_OR_MASS = Condition(
    "pull", "a rigid pull or a body with a mass", lambda case: case.pull.is_rigid or case.pull.coefficients[0] > 0
)
KEPT = Condition("indenter", "a contact whose edge stays where it is", lambda case: not case.edge_moves)


def where_it_falls(*conditions: Condition) -> tuple[Condition, ...]:
    """These conditions, for friction that falls alone."""

    def asked(one: Condition) -> Condition:
        words = f"{one.words} where friction falls"
        return one._replace(words=words, holds=lambda case: case.friction.stick == 1 or one.holds(case))

    return tuple(map(asked, conditions))


MARCHED = where_it_falls(NO_STRENGTH, RIGID_OR_MASS)  #: one without a mass jumps whenever a spring is let go
