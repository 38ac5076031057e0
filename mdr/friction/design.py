"""design(): values of several numbers of a case with which it is inside a target, as far as can be."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mdr.case.contact import SlidingContact, as_given
from mdr.case.domain import ALIKE, Domain
from mdr.friction.room_search import Design, Search, Space
from mdr.friction.target import Target
from mdr.normal.resolved import at_rest
from mdr.tools.checks import instance
from mdr.tools.keywords import offering
from mdr.tools.messages import short

LAW = Domain((ALIKE,), instead="slide(case, v_0) at each velocity; find with smooth=True is where stick-slip ends")


@offering
def design(
    case: SlidingContact,
    target: Target,
    free: Mapping[str, Any],
    *,
    least: str | None = None,
    held: Mapping[str, Any] | None = None,
    limit_s: float | None = None,
) -> Design:
    """Values of some numbers of a case with which it meets a target, as far inside as can be; or comes nearest to it.

    Parameters
    ----------
    case : SlidingContact
        The contact; what is not free stays.
    target : Target
        Limits on friction, critical velocity and power.
    free : dict of str to (low, high)
        Ranges of the numbers that may change, in SI or with units, ("0.1um", "2um"), by paths as in `find`.
    least : {"power"}, optional
        Ask for the least power of the drives with which the target is met, not for the most room.
    held : mapping of str to float, optional
        "load" [N], "frequency" [Hz] or "tan_delta" [-] that hold meanwhile, as in `find`.
    limit_s : float, optional
        Computing time [s] after which the search ends; an interrupt (Ctrl-C) ends it too. The best design so far is
        answered, and `stopped` says so. None: no limit.

    Returns
    -------
    Design
        The case, whether it meets the target, what is reached, and what limits it.

    Raises
    ------
    ValueError
        For a range of what is no number of the case, and where no case of the ranges can be.
    TypeError
        For another type.

    See Also
    --------
    front : least power over friction.
    find : all values of one number.

    Notes
    -----
    The room of a limit is, of friction, its distance over friction of full slip, or over the limit where that is
    greater; of a velocity or a power `L/(1 + |L|)`, L the logarithm of it over its limit, or the negative of that. The
    design has the greatest least room that was found; nothing proves that there is none greater. Friction and power are
    looked at at `up_to`, and at 1/2, 1/4 and 1/8 of it. Where a body or a mass may swing, all limits are to hold at
    frequencies 5 % below and above too, and it keeps 5 % off each resonance.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=1e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.4, oscillation=vibration)
    >>> target = mdr.Target(cof_at_most=0.2, up_to=1e-4)
    >>> found = mdr.design(case, target, {"du_z": ("1um", "15um")})
    >>> found.met, found.active
    (True, ('cof_at_most', 'oscillation.du_z at its highest'))
    """
    case = LAW.seen(as_given(case), "design")
    at_rest(case)  # warns of what is unlikely
    instance("target", target, Target)
    if least not in (None, "power"):
        raise ValueError(f'least must be "power" or None, got {short(repr(least))}')
    if least and target.up_to is None:
        raise ValueError("least power wants up_to of the target, the velocity in m/s at which it is taken")
    space = Space(case, free, held or {})
    search = Search(space, target)

    def work() -> None:
        search.most_room()
        if least and search.is_met:
            search.least_power([*search.ends])

    return search.design(search.stopped(work, limit_s))
