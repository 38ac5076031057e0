"""Stick-slip of a body on a spring without vibration: its limit cycle from event to event, and what ends it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mdr.closed_forms.laws.falling import EXACT_TIME
from mdr.tools.arrays import EXACT, Array
from mdr.tools.checks import not_negative, positive

SAMPLES = 64  #: of an oscillation, between which an event is looked for
MOST = 2000  #: slips, after which a motion that does not repeat itself is given up


class StickSlip(NamedTuple):
    """The limit cycle of stick-slip."""

    period: float  #: from slip to slip [s]
    stroke: float  #: way of the body in a period [m], which the contact slips at once
    speed: float  #: greatest velocity of the body in slip [m/s]
    mean_force: float  #: mean friction [N]
    rest: float  #: share of the time in which the contact sticks [-]


def stick_slip(
    v_0: float, breakaway: float, sliding: float, k_x: float, m: float, c_x: float = 0.0, k_xc: float = np.inf
) -> StickSlip | None:
    """Stick-slip of a body that is pulled by a spring over a face whose friction falls; None where it comes to an end.

    The load is constant. With y the stretch of the spring less that of friction in slip, over Delta/k_x, Delta =
    mu_s F - mu_k F, time in 1/omega_0, v = v_0 k_x/(Delta omega_0) and zeta = c_x/(2 sqrt(k_x m))::

        slip    y'' + 2 zeta y' + y = 0    until the body stands, y' = v
        stick   y' = v                     until y + 2 zeta v = 1

    of a contact that does not yield. Undamped, slip lasts (2/omega_0) [pi - arctan(1/v)] and stick 2 Delta/(k_x v_0),
    the greatest velocity is v_0 + sqrt(v_0² + (Delta omega_0/k_x)²), and mean friction that of slip. A damper ends it
    from `stick_slip_end` on.

    A flat elastic contact yields, by k_xc: the body swings on it as it comes to stand, by nearly Delta in force. Where
    nothing damps that, it is let go too early, with half of Delta or less, and may end in steady sliding. So a stiff
    contact is one that does not yield only if that swing dies out in each stick. The motion is that from rest, then,
    each event to rounding.

    Parameters
    ----------
    v_0 : float
        Pulling velocity [m/s].
    breakaway, sliding : float
        Friction [N] at which the body is let go, mu_s F, and in slip, mu_k F.
    k_x, m, c_x : float
        Stiffness [N/m], mass [kg] and damping [N s/m] of the body on its spring.
    k_xc : float
        Stiffness [N/m] of the contact in stick.

    Returns
    -------
    StickSlip or None
        The cycle; None where the body comes to slide without a stop.

    Raises
    ------
    ValueError
        For a number out of range, and where there is no cycle of one slip: friction acts backwards in the swing, or
        slips differ for ever.

    Examples
    --------
    >>> jumps = mdr.laws.stick_slip(1e-4, breakaway=3.0, sliding=2.0, k_x=1e5, m=1.0)
    >>> print(f"{1e6 * jumps.stroke:.1f} µm each {jumps.period:.2f} s, up to {1e3 * jumps.speed:.1f} mm/s")
    21.0 µm each 0.21 s, up to 3.3 mm/s
    """
    fall, speed, zeta = _groups(breakaway, sliding, k_x, m, c_x)
    v, q = positive("v_0", v_0, "pulling velocity in m/s") / speed, k_xc / k_x
    if not k_xc > 0:
        raise ValueError(f"k_xc = {k_xc!r} N/m must be above 0, and infinite where the contact does not yield")
    if zeta >= 1:
        return None
    least = -(breakaway + sliding) / fall
    stuck = _stick(-sliding / fall, -sliding / fall, least, v, zeta, q)
    for _ in range(MOST):
        slip = _Free(zeta, 1.0, stuck.y, stuck.y_dot)
        turn = 2 * np.pi / slip.omega
        time = _first(lambda t, slip=slip: slip.rate(t) - v, 0.0, turn, 1)  # type: ignore[misc]
        if time is None:
            return None
        stuck = _stick(float(slip.place(time)), 0.0, least, v, zeta, q)
        if abs(stuck.y - slip.y) + abs(stuck.y_dot - slip.y_dot) <= EXACT:
            period, fastest = time + stuck.time, _first(slip.bend, 0.0, turn, 1) or 0.0
            return StickSlip(
                period=float(period * np.sqrt(m / k_x)),
                stroke=float(v_0 * period * np.sqrt(m / k_x)),
                speed=float(v_0 - speed * slip.rate(fastest)),
                mean_force=sliding + fall * stuck.impulse / period,
                rest=stuck.time / period,
            )
    raise ValueError(f"slips still differ after {MOST} of them: there is no cycle of one slip; add c_x")


def stick_slip_end(breakaway: float, sliding: float, k_x: float, m: float, c_x: float = 0.0) -> float:
    """Pulling velocity [m/s] from which a damper ends stick-slip, of a contact that does not yield.

    The velocity of the body v - y' touches zero again after a slip that begins with y = 1 - 2 zeta v, y' = v. With the
    free oscillation c(t) from y = 1 and s(t) from y' = 1 that is the greatest of c'/(1 + 2 zeta c' - s') over the time,
    1/sqrt(4 pi zeta) for a light damper.

    Parameters
    ----------
    breakaway, sliding, k_x, m, c_x : float
        As of `stick_slip`.

    Returns
    -------
    float
        Pulling velocity [m/s]: infinite without a damper, 0 if the damper is critical or more.

    Examples
    --------
    >>> print(f"{1e3 * mdr.laws.stick_slip_end(3.0, 2.0, k_x=1e5, m=1.0, c_x=30.0):.2f} mm/s")
    3.95 mm/s
    """
    from scipy.optimize import minimize_scalar

    _, speed, zeta = _groups(breakaway, sliding, k_x, m, c_x)
    if zeta >= 1 or zeta == 0:
        return np.inf if zeta == 0 else 0.0
    of_place, of_rate = _Free(zeta, 1.0, 1.0, 0.0), _Free(zeta, 1.0, 0.0, 1.0)

    def touches(t: float) -> float:
        rate = of_place.rate(t)
        return float(rate / (1 + 2 * zeta * rate - of_rate.rate(t)))

    bounds = np.pi / of_place.omega, 2 * np.pi / of_place.omega
    return speed * touches(minimize_scalar(lambda t: -touches(t), bounds=bounds, options={"xatol": 1e-9}).x)


def dither_force(v_0: float, breakaway: float, sliding: float, k_x: float, m: float, c_x: float = 0.0) -> float:
    """Force [N] that a fast vibration has to take off the breakaway, to end stick-slip.

    The contact is let go where the vibration helps most, at the breakaway less this force A, and slips against the mean
    friction mu_k F, so that the drop of friction is Delta - A. Stick-slip ends as `stick_slip_end` comes down to v_0::

        A = Delta - v_0 sqrt(k_x m)/V(zeta),    V = stick_slip_end sqrt(k_x m)/Delta, infinite without a damper

    Up and down A is mu_s dF_z, so that dF_z/F_z = A/(mu_s F); never more than 1 - mu_k/mu_s. Along the slide it is what
    shakes the body that sticks: du_x/(1/k_xc - 1/(m omega²)) of a tool, du_x (k_x² + omega² c_x²)^(1/2) of a pulling
    point, 1/k_xc left out.

    The limit of a vibration that is fast for the body and slow for it on the contact, whose swing dies out in each
    stick: omega_0 << omega << sqrt(k_xc/m), where it is faster than v_c of the vibration, too. Nearer to omega_0 more
    is needed, as the vibration rocks the body; where the swing lasts, less [stick_slip].

    Parameters
    ----------
    v_0, breakaway, sliding, k_x, m, c_x : float
        As of `stick_slip`.

    Returns
    -------
    float
        Force [N]; 0 where there is no stick-slip without vibration.

    Examples
    --------
    >>> print(f"{mdr.laws.dither_force(1e-4, breakaway=3.0, sliding=2.0, k_x=1e5, m=1.0, c_x=60.0):.3f} N")
    0.954 N
    """
    fall, *_ = _groups(breakaway, sliding, k_x, m, c_x)
    positive("v_0", v_0, "pulling velocity in m/s")
    end = stick_slip_end(breakaway, sliding, k_x, m, c_x)
    return fall * max(1 - v_0 / end, 0.0) if end else 0.0


def _groups(breakaway: float, sliding: float, k_x: float, m: float, c_x: float) -> tuple[float, float, float]:
    """Delta [N], the unit of velocity Delta omega_0/k_x [m/s], and zeta."""
    fall = positive("breakaway", breakaway, "N") - positive("sliding", sliding, "N")
    if not fall > 0:
        raise ValueError(f"breakaway = {breakaway:.6g} N must be above sliding = {sliding:.6g} N: friction falls")
    root = np.sqrt(positive("k_x", k_x, "N/m") * positive("m", m, "kg"))
    return fall, fall / root, not_negative("c_x", c_x, "N s/m") / (2 * root)


class _Free(NamedTuple):
    """A free oscillation y'' + 2 zeta y' + k y = 0, from its place and its rate."""

    zeta: float
    k: float
    y: float
    y_dot: float

    @property
    def omega(self) -> float:
        return float(np.sqrt(self.k - self.zeta**2))

    def place(self, t: ArrayLike) -> Array:
        phase, shrunk = self.omega * np.asarray(t), np.exp(-self.zeta * np.asarray(t))
        return shrunk * (self.y * np.cos(phase) + (self.y_dot + self.zeta * self.y) / self.omega * np.sin(phase))

    def rate(self, t: ArrayLike) -> Array:
        return self._replace(y=self.y_dot, y_dot=self._bent(self.y, self.y_dot)).place(t)

    def bend(self, t: ArrayLike) -> Array:
        return np.asarray(self._bent(self.place(t), self.rate(t)))

    def _bent(self, y: Any, y_dot: Any) -> Any:
        return -2 * self.zeta * y_dot - self.k * y

    def reach(self, t: float) -> float:
        """The most that its place is from t on."""
        return float(np.exp(-self.zeta * t) * np.hypot(self.y, (self.y_dot + self.zeta * self.y) / self.omega))


class _Stuck(NamedTuple):
    """A stick, from a body that stands until it is let go."""

    time: float
    impulse: float  #: of friction less that of slip
    y: float  #: at its end
    y_dot: float


def _stick(y: float, force: float, least: float, v: float, zeta: float, q: float) -> _Stuck:
    """The stick of a body that stands with the stretch y and this force of the contact, both less those of slip, and
    forces over Delta; the contact is let go backwards at `least`.
    """
    if np.isinf(q):
        time = max(1 - 2 * zeta * v - y, 0.0) / v
        return _Stuck(time, time * (1 + y + 2 * zeta * v) / 2, 1 - 2 * zeta * v, v)
    # y = held + drift t + swing solves y'' + 2 zeta y' + y = force + q (v t - y + y_0)
    drift = v * q / (1 + q)
    held = (force + q * y - 2 * zeta * drift) / (1 + q)
    swing = _Free(zeta, 1 + q, y - held, v - drift)
    rest, slope, turn = force + q * (y - held), q * (v - drift), 2 * np.pi / swing.omega

    def borne(t: ArrayLike) -> Array:
        return np.asarray(rest + slope * np.asarray(t) - q * swing.place(t))

    if borne(np.linspace(0, turn, SAMPLES + 1)).min() < least:
        raise ValueError("the contact is let go backwards as the body swings on it: there is no cycle of one slip")
    begin, later = -turn, 0.0
    while later > begin + turn / SAMPLES:  # before, ramp and swing together do not come to 1
        begin = later
        later = (1 - rest - q * swing.reach(begin)) / slope
    time = _first(lambda t: borne(t) - 1, begin, turn) or 0.0
    end, end_dot = float(swing.place(time)), float(swing.rate(time))
    swung = end_dot - swing.y_dot + 2 * zeta * (end - swing.y)
    impulse = rest * time + slope * time**2 / 2 + q / (1 + q) * swung
    return _Stuck(time, impulse, held + drift * time + end, drift + end_dot)


def _first(f: Callable[[Any], Any], start: float, turn: float, most: float = np.inf) -> float | None:
    """When f, which swings once in a turn, first comes above zero; None if it does not in so many turns."""
    from scipy.optimize import brentq, minimize_scalar

    k = 0
    while k < most:
        t = start + turn * (k + np.arange(SAMPLES + 2) / SAMPLES)
        values = f(t)
        for j in range(1, SAMPLES + 1):
            before, here, after = values[j - 1 : j + 2]
            last = t[j]
            if before <= here >= after and here <= 0 < 3 * here - before - after:  # the crest may be above
                last = minimize_scalar(lambda at: -float(f(at)), bounds=(t[j - 1], t[j + 1])).x
            if f(last) > 0:
                return float(t[j - 1] if before > 0 else brentq(f, t[j - 1], last, xtol=EXACT_TIME))
        k += 1
    return None
