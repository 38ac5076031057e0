"""Friction in the plane: |L[e]| <= R in length, with the extension e (a vector) and R = L[q] (limit.py), over a stretch
of contact: a disc in the place of the interval of line.py.

* *stick*: e goes with the top, L[e] is known, until its length comes to stick R;
* *slip*: |L[e]| = R, along the slip velocity, which turns (dragged.py), until it comes to zero.

Where friction falls, stick is above 1, and the force of a spring that is let go falls to R along itself at once. One
that slips goes on into the next step in any direction: with a dashpot it turns back there without a stop, where the
velocity of the top jumps.

Arms remember the slip, which depends on their memory: the two are brought in line with each other.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import NamedTuple

from mdr.spring.contact import MOST_EVENTS, Friction
from mdr.spring.contact_modes import SLIP, STICK
from mdr.spring.dragged import EVEN, TINY, Slip, slides, yielded
from mdr.spring.energies import FRICTION_LOSS, LEAST_SLIP, SHEAR_VISCOUS, STICK_IMPULSE, lost_on_parabola, stored
from mdr.spring.law import phi_of
from mdr.spring.limit import stick_of
from mdr.spring.motion import end_force, glassy, held_force, hold
from mdr.spring.path import (
    FAST_IN_PLANE,
    LENT,
    NEVER,
    ROUNDING,
    Cubic,
    along,
    at,
    cubic,
    cubic_later,
    multiple,
    size_of,
    slope,
)
from mdr.spring.times import PART, fill
from mdr.spring.whole import TOUCHING
from mdr.tools.jit import inner

_inline = inner(forceinline=True, error_model="numpy", fastmath=FAST_IN_PLANE, **LENT)

BEGINS = -1  #: the mode is still to be found
MOST_HALVINGS = 60  #: in the search for the end of a mode
SHORTEST = 1 / 16  #: part of a step that slip is followed for at once, however its leash changes
SLOW_DASHPOT = 8.0  #: times a time: of a dashpot beside arms, from which on it is slow in it
SOON = 1e-6  #: part of a time: whether a spring on arms slips at once, or leaves the rim inward, is told there
INSIDE = 10.0  #: times what is rounding, by which a force is told from one on the rim
MOST_RETURNS = 4  #: of the memory of arms at the end of slip, upon which the slip depends


class Parabola(NamedTuple):
    """The displacement p t + q t² of the top, or of the end of a spring."""

    p: complex
    q: complex


class Start(NamedTuple):
    """A spring in contact as a stretch of time begins."""

    g: complex  #: force of its trial, if it sticks
    a: complex  #: sum of rho_j e_j/theta_j
    v: complex  #: what drives its slip, of dragged.py
    n: complex  #: direction in which it slips, or would
    vel: float  #: slip velocity
    ahead: float  #: v.n - R'


class Bracket(NamedTuple):
    """Two times between which a function has a zero, and its values there."""

    low: float
    high: float
    f_low: float
    f_high: float  #: not zero
    side: int  #: which of the two the last look has moved


class Stretch(NamedTuple):
    """Friction over a time in one mode."""

    t: float
    lasts: bool  #: whether the mode lasts for all of the time that was given
    n: complex  #: direction of the slip at its end
    vel: float  #: slip velocity there
    area: complex  #: of the force over the time
    moment: complex


@_inline
def memory(e, i, arms):
    """sum rho_j e_j/theta_j of spring i."""
    total = 0.0j
    for j in range(arms.rho.size):
        total += arms.rho[j] * arms.rate[j] * e[1 + j, i]
    return total


# --- brackets ---


@_inline
def between(b):
    """Zero of the line through the two ends of a bracket."""
    return (b.low * b.f_high - b.high * b.f_low) / (b.f_high - b.f_low)


@_inline
def nearer(b, mid, f):
    """A bracket after a look at mid, by regula falsi (the Illinois method)."""
    if (f < 0.0) == (b.f_high < 0.0):
        return Bracket(b.low, mid, b.f_low * (0.5 if b.side > 0 else 1.0), f, 1)
    return Bracket(mid, b.high, f, b.f_high * (0.5 if b.side < 0 else 1.0), -1)


# --- stick ---


@_inline
def outside(f, R, t):
    """Distance of a force from its disc at a time; negative inside."""
    return size_of(at(f, t)) - at(R, t)


@_inline
def leaves(f, R, t):
    """Half the rate of the square of a force less that of its disc."""
    return along(at(f, t), slope(f, t)) - at(R, t) * slope(R, t)


@_inline
def until_outside(f, R, t, tol):
    """Two times between which the force f leaves the disc R, both cubics: inside at the first, or on the rim; outside
    at the second, or beyond t if it does not leave.
    """
    high = 0.0
    for half in range(2):
        low, high = high, 0.5 * (half + 1) * t
        if outside(f, R, high) > tol:
            return low, high
        b = Bracket(low, high, leaves(f, R, low), leaves(f, R, high), 0)
        if b.f_low > 0.0 and b.f_high < 0.0:  # nearest to the rim in between
            mid = low
            for _ in range(MOST_HALVINGS):
                mid = between(b)
                rate = leaves(f, R, mid)
                if rate == 0.0 or b.high - b.low <= 1e-9 * t:
                    break
                b = nearer(b, mid, rate)
            if outside(f, R, mid) > tol:
                return low, mid
    return t, NEVER


@_inline
def until_slip(f, R, t, tol):
    """Time at which the force f of a spring that sticks leaves the disc R, both cubics; t if it does not."""
    low, high = until_outside(f, R, t, tol)
    if high > t:
        return t
    if outside(f, R, low) > -tol and leaves(f, R, low) < 0.0:  # from the rim inward, and out again later
        part = high - low
        for _ in range(MOST_HALVINGS):
            part *= 0.5
            out = outside(f, R, low + part)
            if out < -tol:
                low += part
                break
            if out > tol:
                high = low + part
    b = Bracket(low, high, min(outside(f, R, low), -0.0), outside(f, R, high), 0)
    for _ in range(MOST_HALVINGS):
        if b.high - b.low <= 1e-15 * t:
            break
        mid = between(b)
        out = outside(f, R, mid)
        if abs(out) <= 0.1 * tol:
            return mid
        b = nearer(b, mid, out)
    return b.high


@_inline
def outside_exactly(e, i, top, R, u, T, arms, tools):
    """Distance from its disc of the force of spring i on arms that sticks for a time u: exact."""
    fill(u, None, arms, tools.times, PART)
    return outside(cubic(held_force(e, i, top.p, top.q, u, PART, T, tools, arms), u), R, u)


@_inline
def until_true_slip(e, i, top, f, R, until, t, tol, T, arms, tools):
    """Time at which spring i on arms slips, of which the cubic f over the time t leaves the disc after `until`; before
    that if the cubic is wrong and it does not: arms that relax within t are no cubic.
    """
    until = max(until, SOON * t)
    out, low, high, f_low, f_high = outside_exactly(e, i, top, R, until, T, arms, tools), 0.0, until, -0.0, 0.0
    if until == SOON * t and out >= -tol and outside(f, R, 0.0) >= -tol:
        return 0.0
    if until == SOON * t and out < -tol:
        return until
    if out <= tol:
        low, high, f_low, f_high = until, t, min(out, -0.0), outside(f, R, t)
        if f_high <= tol or out > -tol:
            return until
    else:
        f_low, f_high = min(outside(f, R, 0.0), -0.0), out
        if f_low > -tol and leaves(f, R, 0.0) < 0.0:  # from the rim inward
            for _ in range(MOST_HALVINGS):
                part = 0.5 * high
                out = outside_exactly(e, i, top, R, part, T, arms, tools)
                if out < -tol:
                    low, f_low = part, out
                    break
                if out > tol:
                    f_high = out
                high = part
    b = Bracket(low, high, f_low, f_high, 0)
    for _ in range(MOST_HALVINGS):
        mid = between(b)
        if b.high - b.low <= 1e-15 * t or not b.low < mid < b.high:
            break
        out = outside_exactly(e, i, top, R, mid, T, arms, tools)
        if abs(out) <= tol:
            return mid
        b = nearer(b, mid, out)
    return b.high


@_inline
def sticks(e, i, w, top, R, most, t, k, tol, T, modes, arms, tools, look):
    """Stick from now on, for as long as it lasts: until the force leaves the disc `most`."""
    f = cubic(held_force(e, i, top.p, top.q, t, k, T, tools, arms), t)
    until = until_slip(f, most, t, tol)
    lasts = until >= t
    if not lasts:
        if arms is not None:
            until = until_true_slip(e, i, top, f, most, until, t, tol, T, arms, tools)
            fill(until, None, arms, tools.times, PART)
        t, k = until, PART
    if look is not None:
        impulse = t * (at(R, 0.0) + 4.0 * at(R, 0.5 * t) + at(R, t)) / 6.0
        lost = lost_on_parabola(e, i, top.p, top.q, t, tools.times.h, look.nodes, T, modes, arms)
        look.sums[STICK_IMPULSE] += w * impulse
        look.sums[SHEAR_VISCOUS] += w * lost
        look.sums[LEAST_SLIP] = min(look.sums[LEAST_SLIP], 0.0)
    area, moment = hold(e, i, top.p, top.q, t, k, T, tools, arms)
    return Stretch(t, lasts, 0.0j, 0.0, area, moment)


@_inline
def let_go(e, i, w, g, R, T, arms, look):
    """Let go spring i, of the force g: it falls to the limit R along itself. Without dashpot by a jump of the end of
    the spring, whose energy is heat of friction; with one as it begins to slip.
    """
    rho, before = size_of(g), stored(e, i, arms)
    if T == 0.0 and rho > R:
        jump = g * ((rho - R) / (rho * glassy(arms)))
        for j in range(e.shape[0]):
            e[j, i] -= jump
    if look is not None:
        look.sums[FRICTION_LOSS] += w * (before - stored(e, i, arms))


# --- slip ---


@_inline
def remembered(e, i, p, p_fast, q, t, k, keep, tools, arms):
    """Arms of spring i after a time t on p t + q t²: the sums of rho_j e_j, of rho_j e_j/theta_j,
    and the mean of the latter over the time. Fast arms, of theta_j < h, are held on p_fast t + q t². keep: True stores
    what they come to.
    """
    of = tools.times.arms[k]
    one = two = mean = 0.0j
    for j in range(arms.rho.size):
        before, rate, is_fast = e[1 + j, i], arms.rate[j], arms.rate[j] * tools.times.h > 1.0
        first = p_fast if is_fast else p
        after = before * of[0, j] + first * of[1, j] + q * of[2, j]
        area = before * of[3, j] + first * of[4, j] + q * of[5, j]
        if keep:
            e[1 + j, i] = after
        one += arms.rho[j] * after
        two += arms.rho[j] * rate * after
        mean += rate * area * (1.0 / t)
    return one, two, mean


@_inline
def arms_give(t, k, G, T, tools, arms):
    """Correction for arms over a time t: extension over the one without slow arms; slip velocity at the end that the
    memory of fast ones adds, over it.
    """
    per, back, gives = t, 0.0, 1.0 / G
    for j in range(arms.rho.size):
        if arms.rate[j] * tools.times.h > 1.0:
            back += arms.rho[j] * arms.rate[j] * tools.times.arms[k, 2, j] / (2.0 * t)
        else:
            per += arms.rho[j] * tools.times.arms[k, 1, j]
    if T > 0.0:
        gives = 0.5 * t / T * phi_of(0.5 * G * t / T)[2]
    return per, gives * back


@_inline
def is_slow(t, T, arms):
    """True for a dashpot so slow in a time that its yield is taken from the integral of the force."""
    return t < T if arms is None else SLOW_DASHPOT * t < T


@_inline
def slip_over(e, i, top, start, R, t, k, midway, G, T, arms, tools):
    """Slip over a time, and the path of the end of the spring: a parabola with the true rates at both ends, shifted so
    that |L[e]| = R at the end; on a slow dashpot so that the extension is what the force yields. The memory of arms and
    their slip are brought in line with each other.
    """
    rate_0, rate_1 = top.p - start.vel * start.n, top.p + 2.0 * t * top.q
    v, moved = Cubic(start.v, 2.0 * G * top.q, 0.0j, 0.0j), Parabola(rate_0, 0.0j)
    of, per, back, returns, others = Slip(start.n, start.vel, 0.0j, 0.0j, start.vel), t, 0.0, 1, 0.0j
    last, f_0, f_1 = 0.0j, max(R.a, 0.0) * start.n, max(at(R, t), 0.0)
    if arms is not None:
        per, back = arms_give(t, k, G, T, tools, arms)
        returns = MOST_RETURNS
    for _ in range(returns):
        if arms is not None:
            # by the parabola of both ends and the mean, as R goes: then what relaxes with the disc does not slip
            _, last, mean = remembered(e, i, moved.p, rate_0, moved.q, t, k, False, tools, arms)
            last, mean = last - start.a, mean - start.a
            b, c = (6.0 * mean - 2.0 * last) * (1.0 / t), (6.0 * mean - 3.0 * last) * (1.0 / (t * t))
            v = Cubic(start.v, 2.0 * G * top.q - b, c, 0.0j)
        known = back * of.vel
        of = slides(start.n, start.vel, t, v, R, T, G, midway)
        if arms is not None:
            of = Slip(of.n, (of.vel - known) / (1.0 - back), of.area, of.moment, of.l_m)
        q = (rate_1 - of.vel * of.n - rate_0) * (0.5 / t)
        if arms is not None:
            others, _, _ = remembered(e, i, -t * q, rate_0, q, t, k, False, tools, arms)
        if is_slow(t, T, arms):
            if arms is None:
                end = yielded(e[0, i], f_0, f_1 * of.n, of.area, of.moment, t, T, phi_of(t / T))
                mean = (end - e[0, i]) * (1.0 / t)
            else:  # T x' is what the force leaves to spring and arms, which bear g - T top.p as it begins
                borne = 0.5 * t * (start.g - T * top.p + e[0, i] + others)
                bend = t * t / 12.0 * (G * (rate_0 - rate_1 + of.vel * of.n) + last)
                mean = (of.area - borne - bend) * (1.0 / (t * T + 0.5 * t * per))
        else:
            mean = ((f_1 + T * of.vel) * of.n - T * rate_1 - e[0, i] - others) * (1.0 / per)
        moved = Parabola(mean - t * q, q)
    return of, moved


@_inline
def slips(e, i, w, top, start, R, t, k, forced, G, T, modes, arms, tools, look):
    """Slip from now on, for as long as it lasts: until its velocity falls below zero. forced: it lasts in any case."""
    h, first = tools.times.h, start.vel
    if T > 0.0 and start.ahead > 0.0:  # from stick on it begins at rest, or so: what it is an instant later
        first = max(first, ROUNDING * h * start.ahead / T)
    lasts, b = True, Bracket(0.0, t, first, 0.0, 0)
    of, moved = Slip(start.n, start.vel, 0.0j, 0.0j, start.vel), Parabola(0.0j, 0.0j)
    for iteration in range(MOST_HALVINGS):
        of, moved = slip_over(e, i, top, start, R, t, k, look is not None, G, T, arms, tools)
        if iteration == 0:
            if forced or of.vel >= 0.0:
                break
            lasts = False
            b = Bracket(0.0, t, first, of.vel, 0)
        else:
            b = nearer(b, t, of.vel)
        if (b.high - b.low <= 1e-14 * h and t == b.high) or b.f_low <= 0.0 or abs(of.vel) <= 1e-14 * start.vel:
            break
        t = max(between(b), ROUNDING * h)
        if not b.low < t < b.high:
            t = 0.5 * (b.low + b.high)
        if b.high - b.low <= 1e-14 * h:
            t = b.high
        k = PART
        if arms is not None:
            fill(t, None, arms, tools.times, PART)
    if not lasts and b.f_low <= 0.0 and b.low == 0.0:  # it does not slip at all
        return Stretch(0.0, False, 0.0j, 0.0, 0.0j, 0.0j)
    vel, R_0, R_m, R_1 = max(of.vel, 0.0) if lasts else 0.0, max(R.a, 0.0), max(at(R, 0.5 * t), 0.0), max(at(R, t), 0.0)
    if look is not None:
        lost = lost_on_parabola(e, i, moved.p, moved.q, t, h, look.nodes, T, modes, arms)
        look.sums[SHEAR_VISCOUS] += w * lost
        of_slip = R_0 * start.vel + 4.0 * R_m * max(of.l_m, 0.0) + R_1 * vel
        look.sums[FRICTION_LOSS] += w * t / 6.0 * of_slip
        look.sums[LEAST_SLIP] = min(look.sums[LEAST_SLIP], start.vel, vel)
    end = (R_1 + T * vel) * of.n - T * (top.p + 2.0 * t * top.q)
    if arms is not None:
        others, _, _ = remembered(e, i, moved.p, top.p - start.vel * start.n, moved.q, t, k, True, tools, arms)
        end -= others
    e[0, i] = e[0, i] + t * (moved.p + t * moved.q) if is_slow(t, T, arms) else end
    return Stretch(t, lasts, of.n, vel, of.area, of.moment)


@_inline
def even_part(R, more, t, shortest):
    """Part of a time t that slip is followed for at once, on the leash R + more, R a cubic: two nodes tell how far it
    turns the spring only where it does not change much.
    """
    u, first = t, R.a + more
    while u > shortest:
        middle, last = at(R, 0.5 * u) + more, at(R, u) + more
        if EVEN * min(first, middle, last) >= max(first, middle, last):
            break
        u *= 0.5
    return u


# --- a stretch of contact ---


@_inline
def start_of(e, i, top, R, h, G, T, arms):
    """A spring in contact as a stretch of time begins, under the disc R, a cubic."""
    g, a = end_force(e, i, top.p, T, arms), 0.0j
    if arms is not None:
        a = memory(e, i, arms)
    v = G * top.p + 2.0 * T * top.q - a
    rho, fast = size_of(g), size_of(v)
    n = g * (1.0 / rho) if rho > TOUCHING * h * fast else v * (1.0 / max(fast, TINY))
    ahead = along(v, n) - R.b
    vel = max(rho - max(R.a, 0.0), 0.0) / T if T > 0.0 else max(ahead, 0.0) / G
    return Start(g, a, v, n, vel, ahead)


@_inline
def begins(start, out, T, tol):
    """True if a spring slips at once whose trial force is by `out` beyond the disc of this Start."""
    return (out >= -tol and start.ahead > 0.0) or (T > 0.0 and out > tol)


@_inline
def rub_disc(q, e, limit, i, w, pressing, T, modes, arms, tools, look):
    """Friction of spring i over a stretch of contact, as rub_line of line.py."""
    z, x, t, k, begun, tol, _ = pressing
    h, G, R = tools.times.h, glassy(arms), cubic(held_force(q, i, z[0], z[1], t, k, T, tools, arms), t)
    borne, borne_moment = hold(q, i, z[0], z[1], t, k, T, tools, arms)
    gone, zeros, mode, n, vel, top = 0.0, 0, BEGINS, 0.0j, 0.0, Parabola(x[0], x[1])
    stick, freed = stick_of(limit), False
    area, moment, stuck, stuck_moment = 0.0j, 0.0j, 0.0, 0.0
    for _ in range(MOST_EVENTS):
        left, now = t - gone, begun + gone
        start = start_of(e, i, top, R, h, G, T, arms)
        out = size_of(start.g) - max(R.a, 0.0)
        most, slips_at_once = multiple(stick, R), begins(start, out, T, tol)
        if limit is not None and stick > 1.0 and mode == BEGINS:
            freed = not (slips_at_once and begun == 0.0 and limit.was[i] == SLIP)
        if limit is not None and stick > 1.0 and freed:
            static = start_of(e, i, top, most, h, G, T, arms)
            out = size_of(static.g) - max(most.a, 0.0)
            if begins(static, out, T, tol) if mode == BEGINS else out >= -INSIDE * tol:
                let_go(e, i, w, start.g, max(R.a, 0.0), T, arms, look)
                start, mode = start_of(e, i, top, R, h, G, T, arms), SLIP
            else:
                mode = STICK
        elif arms is not None and mode == SLIP and zeros == 0 and out < -INSIDE * tol:
            mode = STICK  # it has not come to the rim
        if mode == BEGINS:
            mode = SLIP if slips_at_once else STICK
        u = left if mode == STICK else even_part(R, T * start.vel + tol, left, SHORTEST * h)
        if u < t:
            k = PART
        if arms is not None and k == PART:
            fill(u, None, arms, tools.times, PART)
        if mode == STICK:
            of = sticks(e, i, w, top, R, most, u, k, tol, T, modes, arms, tools, look)
            stuck, stuck_moment = stuck + of.t, stuck_moment + of.t * (now + 0.5 * of.t)
        else:  # after two stretches without length slip and stick hold alike
            of = slips(e, i, w, top, start, R, u, k, zeros > 1, G, T, modes, arms, tools, look)
        area, moment = area + of.area, moment + now * of.area + of.moment
        if mode == STICK or of.t > 0.0:
            n, vel = of.n, of.vel
        if (of.lasts and u == left) or left - of.t <= ROUNDING * h:  # what is left is the rounding of the time
            break
        zeros = 0 if of.t > 0.0 else zeros + 1
        gone += of.t
        top, R = Parabola(top.p + 2.0 * of.t * top.q, top.q), cubic_later(R, of.t)
        freed = not of.lasts and mode == STICK
        if not of.lasts:
            mode = STICK if mode == SLIP else SLIP
    return Friction(mode, n, vel, area, moment, stuck, stuck_moment, (borne, begun * borne + borne_moment))
