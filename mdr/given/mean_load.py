"""The mean load of a contact whose depth is driven: the mean depth at which it is the load, or by how much it is not.

As force grows faster than depth, the load that rests at a depth is less than the mean force about it. Of a stiff drive
the depth stays, `hold = "depth"`; of a weight the load, `hold = "load"`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from mdr.case.contact import SlidingContact
from mdr.normal.normal_force import mean_normal_force
from mdr.tools.allowed import last_allowed, refusal_of
from mdr.tools.arrays import EXACT, SAME
from mdr.tools.warned import warn_outside


def under_mean_load(at: Callable[[float], SlidingContact], load: float, least: float, rest: float) -> SlidingContact:
    """The contact `at` the mean depth [m] about which the mean load is the load [N].

    least, rest: the mean depths whose greatest depth, and which themselves, are that at which the load rests. Between
    them, as springs are never compressed by more than at the greatest depth, and on average by more than at the mean.
    Raises ValueError where there is no such contact between them.
    """
    from scipy.optimize import brentq

    def excess(u_z0: float) -> float:
        return mean_normal_force(at(u_z0)) / load - 1

    low, high, refusal = _that_can_be(at, least, rest)
    off = excess(low), excess(high)
    if abs(off[1]) <= SAME:
        return at(high)
    if off[0] > 0 or off[1] < 0:
        than, why = "more" if off[0] > 0 else "less", f": {refusal}" if refusal else ""
        raise ValueError(f"the mean load is {than} than {load:.6g} N about every mean depth that there can be{why}")
    return at(float(brentq(excess, low, high, xtol=EXACT * rest, rtol=EXACT)))


def _that_can_be(at: Callable[[float], SlidingContact], low: float, high: float) -> tuple[float, float, str]:
    """The ends of a range of depths, or what is nearest to them of what can be; and why one of them cannot."""
    of_low, of_high = refusal_of(at, low), refusal_of(at, high)
    if of_low and of_high:
        at(high)  # raises
    if of_low:
        return last_allowed(at, high, low, EXACT), high, of_low
    return low, last_allowed(at, low, high, EXACT), of_high


def warn_of_mean_loads(found: Sequence[tuple[float, float]], where: str = "", way_out: str = "") -> None:
    """Warn where a mean load [N] is another than the load [N] that was asked for: pairs (asked for, found)."""
    # a difference of less than 1 % is left without a word
    off = [(mean / asked, asked, mean) for asked, mean in found if abs(mean / asked - 1) > 0.01]
    if not off:
        return
    ratio, asked, mean = max(off, key=lambda one: abs(one[0] - 1))
    at, upto = (where.format(n=len(off), of=len(found)), "up to " if len(off) > 1 else "") if where else ("", "")
    warn_outside(
        f"{at}the mean load is {upto}{ratio:.3g} times the load of {asked:.4g} N ({mean:.4g} N), as the depth where it "
        f'rests is held: right for a stiff drive; for a weight, which stays, give hold="load"{way_out}'
    )
