"""find(): the values of one number of a case at which friction, or the critical velocity, is what is asked for.

The range is scanned, each change of sign is solved for by Brent's method, and where the scan comes nearest to what is
asked without reaching it, the nearest point is sought first: a pair of roots may hide there.

A run is as accurate as its place needs: coarse while it misses what is asked by more than its error, which tells the
side, and with full accuracy from there on, so that every value and every end of the range is as good as a single run.

Whether a body slides without stick-slip is yes or no, and may change more than once: each change from no to yes that
the scan sees is halved to, and the value is the last that was yes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from mdr.case.contact import SlidingContact, as_given
from mdr.case.domain import ALIKE, Domain
from mdr.case.paths import facts_at
from mdr.closed_forms.critical_velocity import critical_velocity, velocity_scale
from mdr.friction.cof_curve import friction_at
from mdr.friction.free_parameters import allowed, case_of, changed, path_of, value_of
from mdr.friction.inputs import OF_RUN
from mdr.given.mean_load import warn_of_mean_loads
from mdr.given.vary import load_asked, still_held
from mdr.march.periodic.steady import BUDGET, LEAST_ACCURATE
from mdr.march.result.slowest import least_velocity
from mdr.normal.normal_force import full_cof, mean_normal_force
from mdr.normal.resolved import at_rest, resolved
from mdr.tools.arrays import EXACT
from mdr.tools.checks import between, ends, finite, positive
from mdr.tools.keywords import offering
from mdr.tools.notation import shown
from mdr.tools.progress import Ticker
from mdr.tools.ranges import Range
from mdr.tools.summary import Printed

LAW = Domain((ALIKE,), instead="slide(case, v_0) at each velocity; find with smooth=True is where stick-slip ends")
SMOOTH = 0.5  #: of v_0, which a body is above that does not stick and slip, averaged over each period of the vibration
LOOKS, HALVED = 17, 7  #: places where a scan asks for it, and how often the way between two is halved


@dataclass(frozen=True)
class Found(Printed):
    """Values of one number of a case that bring about what was asked for."""

    path: str  #: of the number
    values: tuple[float, ...]  #: in SI, rising; empty where there is none
    why: str  #: why there is none, or may be others; "" where there is nothing to say
    cases: tuple[SlidingContact, ...] = field(repr=False)  #: the case at each value
    mean_F_N: tuple[float, ...]  #: mean normal force [N] of each case

    def __str__(self) -> str:
        unit = facts_at(self.path).unit
        found = [
            f"{self.path} = {shown(value, unit, 6)}, mean load {shown(load, 'N')}"
            for value, load in zip(self.values, self.mean_F_N, strict=True)
        ]
        return "\n".join([*found, *([self.why] if self.why else [])])


@offering
def find(
    case: SlidingContact,
    path: str,
    *,
    v_0: float | None = None,
    cof: float | None = None,
    share: float | None = None,
    v_c: float | None = None,
    smooth: bool = False,
    within: tuple[float, float] | None = None,
    held: Mapping[str, Any] | None = None,
) -> Found:
    """Values [SI] of one number of a case at which friction, or the critical velocity, is what is asked for.

    Or from which on a body slides without stick-slip, where friction falls.

    Parameters
    ----------
    case : SlidingContact
        The contact.
    path : str
        The number: a path ("oscillation.du_z"), its last part where that is unique ("du_z"), a group ("alpha"),
        "load" [N], "frequency" [Hz], "tan_delta", or "v_0", the pulling velocity.
    v_0 : float, optional
        Pulling velocity [m/s] at which friction is asked for; not where it is searched for.
    cof : float, optional
        The coefficient of friction [-] that is wanted at v_0.
    share : float, optional
        The share of the friction of full slip [-] that is wanted at v_0, in the place of cof: of mu_0, or of what a
        shear strength of the face makes of it.
    v_c : float, optional
        The critical velocity [m/s] that is wanted, as `critical_velocity` gives it. Give this, or v_0 and cof or share.
    smooth : bool
        Ask from which value on a body that v_0 pulls from rest slides without stick-slip: its `least_velocity` is more
        than half of v_0. A run just below does not. Between two of 17 places that are looked at more may hide.
    within : (float, float), optional
        Lowest and highest value. None: a tenth to ten times that of the case, as far as the case can have it; of v_0 a
        thousandth to ten times the critical velocity, or of Eq. (1) where that is infinite or zero.
    held : mapping of str to float, optional
        "load" [N], "frequency" [Hz] or "tan_delta" [-], which hold meanwhile, as in `sweep`. Beside a load "hold" says
        what stays: "depth", at which it rests, or "load", its mean. Without it a warning says where the mean differs.

    Returns
    -------
    Found
        All values that the scan saw, rising, the case at each, and in words why there is none.

    Raises
    ------
    ValueError
        For no wish or two, and for what is no number of the case.
    TypeError
        For a case that is no SlidingContact.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.4, oscillation=vibration)
    >>> print(mdr.find(case, "du_z", v_0=1e-4, cof=0.2))
    oscillation.du_z = 7.2068 µm, mean load 85.407 mN
    >>> print(mdr.find(case, "v_0", share=0.9))
    v_0 = 84.9517 µm/s, mean load 80.601 mN
    """
    case = as_given(case) if smooth else LAW.seen(case, "find")
    at_rest(case)  # warns of what is unlikely
    path = searched_path(case, path)
    held = still_held(held or {}, [path])

    if path == OF_RUN:
        case = case_of(case, held)

    def at(value: float) -> SlidingContact:
        return case if path == OF_RUN else changed(case, path, value, held)

    wish = _wish(case, path, v_0, cof, share, v_c, smooth)
    search = (_Changes if smooth else _Search)(at, wish, *_range(case, path, within, held))
    values = tuple(search.values())
    cases = tuple(map(at, values))
    loads = tuple(map(mean_normal_force, cases))
    asked = [load_asked({**held, path: value}, one) for value, one in zip(values, cases, strict=True)]
    told = [(load, mean) for load, mean in zip(asked, loads, strict=True) if load is not None]
    warn_of_mean_loads(told, "at {n} of {of} values found " if len(told) > 1 else "at the value found ")
    return Found(path, values, search.why(path, bool(values)), cases, loads)


def searched_path(case: SlidingContact, name: Any) -> str:
    """The path of a parameter in the case, or the pulling velocity."""
    return OF_RUN if name == OF_RUN else path_of(case, name)


class _Wish(NamedTuple):
    """What is asked of a case."""

    ask: Callable[[SlidingContact, float, float], tuple[float, float]]  #: of a value: what there is, and its error
    wanted: float
    what: str
    unit: str

    def miss(self, found: float) -> float:
        """What was found less what is wanted; of a velocity over their sum, as v_c may be infinite."""
        if not self.unit:
            return found - self.wanted
        return 1 - 2 * self.wanted / (found + self.wanted)


def _wish(case: SlidingContact, path: str, v_0: Any, cof: Any, share: Any, v_c: Any, smooth: Any) -> _Wish:
    """What was asked for."""
    searched = path == OF_RUN
    if not isinstance(smooth, bool):
        raise TypeError(f"smooth must be True or False, got {smooth!r}")
    wishes = [cof, share, v_c, smooth or None]
    if searched and (v_0 is not None or v_c is not None or wishes.count(None) != 3):
        raise ValueError("of v_0 give one wish: cof, share or smooth; critical_velocity(case) is v_c")
    if not searched and (wishes.count(None) != 3 or (v_c is None) == (v_0 is None)):
        raise ValueError("give one wish: cof, share or smooth at a velocity v_0, or v_c")
    if v_c is not None:
        wanted = positive("v_c", v_c, "critical velocity in m/s")
        return _Wish(lambda one, *_: (critical_velocity(one), 0.0), wanted, "v_c", "m/s")
    speed = 0.0 if searched else finite("v_0", v_0)
    where = "" if searched else f" at {shown(speed, 'm/s')}"

    def friction(one: SlidingContact, value: float, accuracy: float) -> tuple[float, float]:
        return _settled(one, value if searched else speed, accuracy, in_full_slip=share is not None)

    if smooth:

        def slowest(one: SlidingContact, value: float, _accuracy: float) -> tuple[float, float]:
            pull = value if searched else speed
            return least_velocity(one, pull) / pull, 0.0

        return _Wish(slowest, SMOOTH, f"the least velocity over v_0{where}", "")
    if share is not None:
        return _Wish(friction, between("share", share, -1, 1, "of full friction"), f"the share{where}", "")
    wanted = finite("cof", cof)
    if case.friction.is_coulomb and path not in case.friction.numbers and abs(wanted) >= case.mu_0:
        raise ValueError(
            f"cof must be below mu_0 = {case.mu_0:.6g}, got {wanted:.6g}: from v_c on friction is mu_0; ask for v_c, "
            "or for share=, which is that of mu_0"
        )
    return _Wish(friction, wanted, f"the COF{where}", "")


def _settled(case: SlidingContact, v_0: float, accuracy: float, in_full_slip: bool = False) -> tuple[float, float]:
    """Friction [-], or over that of full slip, and its error. Raises ValueError where the run does not settle."""
    cof, error, why = friction_at(case, v_0, accuracy)
    if why:
        raise ValueError(why)
    unit = full_cof(resolved(case)) if in_full_slip else 1.0
    return cof / unit, error / unit


def _range(case: SlidingContact, path: str, within: Any, held: Mapping[str, Any]) -> tuple[float, float]:
    """The ends of the range."""
    if within is None and path == OF_RUN:
        scale = velocity_scale(case)
        return 1e-3 * scale, 10 * scale
    if within is None:
        start = value_of(case, path, held)
        if start == 0:
            raise ValueError(f"{path} is zero in this case: give the range to search as within=(low, high)")
        low, high = (allowed(case, path, start, end, held) for end in sorted((start / 10, start * 10)))
        return low, high
    return ends("within", within)


class _Search:
    """The search along a range, over a coordinate from 0 to 1."""

    def __init__(self, at: Callable[[float], SlidingContact], wish: _Wish, low: float, high: float) -> None:
        self.at, self.wish, self.low, self.high = at, wish, low, high
        self.value = Range(low, high).value  # at a coordinate
        self.found: dict[float, tuple[float, float, float]] = {}  #: by coordinate: what was asked, its error, accuracy
        self.refused = ""  #: why one of them cannot be
        self.ticker = Ticker("find", parts="cases")

    def miss(self, x: float, accuracy: float = LEAST_ACCURATE) -> float:
        """How far the case at a coordinate is from the wish, its side for sure; NaN where there is no such case."""
        if x not in self.found or self.found[x][2] > accuracy:
            self.ticker.tick()
            try:
                value = self.value(x)
                self.found[x] = *self.wish.ask(self.at(value), value, accuracy), accuracy
            except ValueError as refusal:
                self.refused = str(refusal)
                return np.nan
        found, error, accuracy = self.found[x]
        miss = self.wish.miss(found)
        if accuracy > BUDGET and abs(miss) <= error:
            return self.miss(x, BUDGET)
        # reached: the miss is small against the error of an accurate run
        return 0.0 if abs(miss) <= 1e-2 * error else miss

    def values(self) -> list[float]:
        """The value at each root, rising."""
        from scipy.optimize import brentq

        known = {x: self.miss(x) for x in np.linspace(0, 1, 33).tolist()}  # a first look
        if self.is_flat:
            return []
        known |= {x: self.miss(x) for x in list(self._turns(known))}
        places = sorted(known)
        roots = [x for x in places if known[x] == 0]
        for one, two in pairwise(places):
            if known[one] * known[two] < 0:
                with suppress(ValueError):  # a case on the way that cannot be
                    x = float(brentq(self.miss, one, two, xtol=EXACT))
                    # else what is asked is only jumped over
                    roots += [x] if abs(self.miss(x, BUDGET)) < 1e-3 else []
        return [self.value(x) for x in sorted(roots)]

    def _turns(self, known: dict[float, float]) -> Iterator[float]:
        """Coordinates between those known where the wish is missed least, without a change of sign."""
        places = sorted(known)
        for one, x, two in zip(places, places[1:], places[2:], strict=False):
            side = np.sign(known[x])
            before, here, behind = (side * known[at] for at in (one, x, two))
            if 0 < here <= min(before, behind) and here < max(before, behind):
                x = self._nearest(side, one, two, LEAST_ACCURATE)
                found, error, _ = self.found.get(x, (np.nan, 0.0, 0.0))
                # within a few bounds on the error the nearest point of coarse runs may hide a pair of roots
                if abs(self.wish.miss(found)) <= 3.0 * error:
                    x = self._nearest(side, one, two, BUDGET)
                yield x

    def _nearest(self, side: float, one: float, two: float, accuracy: float) -> float:
        """The coordinate between two where the wish is missed least."""
        from scipy.optimize import minimize_scalar

        limit = {"maxiter": 20}  # enough for the nearest point between three values
        return float(minimize_scalar(lambda at: side * self.miss(at, accuracy), bounds=(one, two), options=limit).x)

    @property
    def is_flat(self) -> bool:
        """Whether what is asked is the same everywhere."""
        found = [one for one, *_ in self.found.values()]
        return not found or max(found) - min(found) <= EXACT * abs(found[0])

    def _accurate(self, x: float) -> float:
        """What is asked, at a coordinate that was looked at."""
        self.miss(x, BUDGET)
        return self.found[x][0]

    def why(self, path: str, is_found: bool) -> str:
        """Why there is no value, or why there may be others."""
        if is_found:
            return f"not looked at everywhere, as a case cannot be: {self.refused}" if self.refused else ""
        unit, wish = facts_at(path).unit, self.wish
        where = f"from {shown(self.low, unit)} to {shown(self.high, unit)}"
        if not self.found:
            return f"none: there is no such case {where}: {self.refused}"
        least, most = (
            shown(self._accurate(end(self.found, key=self.found.__getitem__)), wish.unit) for end in (min, max)
        )
        between = f"is {least}" if self.is_flat else f"lies between {least} and {most}"
        limit = ", unless this is the limit as v_0 -> 0" if path == "v_0" else ""
        gaps = f"; `within` may be widened{limit}"
        gaps += f"; where there is a case, as not everywhere: {self.refused}" if self.refused else ""
        return f"none: {wish.what} {between} for {path} {where}, and {shown(wish.wanted, wish.unit)} is asked for{gaps}"


class _Changes(_Search):
    """The search for where stick-slip ends: what is asked jumps there."""

    again: tuple[float, ...] = ()  #: the last values without stick-slip below one with it

    def values(self) -> list[float]:
        """The first value without stick-slip above one with it, of each change that a scan sees."""
        known = {x: self.miss(x) for x in np.linspace(0, 1, LOOKS).tolist()}
        ends = [self._change(*sides) for sides in pairwise(known) if known[sides[0]] * known[sides[1]] < 0]
        self.again = tuple(self.value(x) for rises, x in ends if not rises)
        return [self.value(x) for rises, x in ends if rises]

    def _change(self, low: float, high: float) -> tuple[bool, float]:
        """Whether stick-slip ends or begins between two coordinates, and the one next to the change that is without."""
        rises = self.miss(low) < 0
        for _ in range(HALVED):
            middle = (low + high) / 2
            low, high = (low, middle) if (self.miss(middle) > 0) == rises else (middle, high)
        return rises, high if rises else low

    def why(self, path: str, is_found: bool) -> str:
        """Why there is no value, or where there is stick-slip above one."""
        unit = facts_at(path).unit
        if self.again:
            told = f"stick-slip again from {' and from '.join(shown(one, unit) for one in self.again)} on"
            return "; ".join(filter(None, (told, super().why(path, True))))
        if is_found or not self.found:
            return super().why(path, is_found)
        is_smooth = max(self.found.values())[0] > SMOOTH
        what = "no stick-slip, pulled from rest," if is_smooth else "stick-slip"
        return f"none: {what} from {shown(self.low, unit)} to {shown(self.high, unit)}; `within` may be widened"
