"""One spring over one step of time whose friction is a vector: a disc in the place of the interval of step.py.

The top moves on parabolas along the pull, across it and down. In scaled form Coulomb's law reads |L[e]| <= R, with the
extension e (a vector), R = L[s] and the law L of the material. Normal motion is that of step.py. In contact:

* *stick*: e goes with the top, L[e] is known (law.py), until its length comes to R;
* *slip*: |L[e]| = R, along the slip velocity, which turns (dragged.py), until that velocity comes to zero.

Arms remember the slip, which depends on their memory: the two are brought in line with each other.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.spring.contact_modes import FREE, SLIP, STICK
from mdr.spring.dragged import EVEN, TINY, Cubic, Slip, along, at, cubic, since, size_of, slides, slope
from mdr.spring.energies import (
    CONTACT_IMPULSE,
    FRICTION_LOSS,
    LEAST_SLIP,
    NORMAL_VISCOUS,
    NORMAL_WORK,
    SHEAR_VISCOUS,
    STICK_IMPULSE,
    lost_on_parabola,
)
from mdr.spring.law import phi_of
from mdr.spring.step import (
    BEGINS,
    LENT,
    MOST_EVENTS,
    ROUNDING,
    Ends,
    arms_ends,
    fill,
    force,
    glassy,
    held,
    hold_arms,
    lasts,
    plus,
    relax,
)
from mdr.spring.whole import TOUCHING, Whole, whole
from mdr.tools.arrays import Array
from mdr.tools.jit import compiled, inner

_FAST = {"reassoc", "contract"}
_inline = inner(forceinline=True, error_model="numpy", fastmath=_FAST, **LENT)

MOST_HALVINGS = 60  #: in the search for the end of a mode
SHORTEST = 1 / 256  #: part of a step that slip is followed for at once, however its leash changes
MOST_RETURNS = 4  #: of the memory of arms at the end of slip, upon which the slip depends


class Sums(NamedTuple):
    """What a row answers of a step, weighted by w."""

    area_x: float  #: of the force along the pull over the time
    area_y: float  #: across
    moment_x: float  #: of it about the begin of the step
    moment_y: float
    end_x: float  #: the force at the end
    end_y: float
    stuck: float  #: time in stick
    when: float  #: its moment
    sticking: float  #: share that sticks at the end


class LookAcross(NamedTuple):
    """What a close look at a step fills, of n springs."""

    sums: Array  #: (N_SUMS,)
    F: Array  #: (4,) at the end of the step: forces along and normal, least slip velocity in contact, force across
    mode: Array  #: (n,)
    f_x: Array  #: (n,) force over stiffness at the end of the step
    f_z: Array  #: (n,)
    f_y: Array  #: (n,)


class Pair(NamedTuple):
    """Extensions and their arms."""

    x: Array  #: (1 + J, n) along the pull
    y: Array  #: (1 + J, n) across


class Way(NamedTuple):
    """The way p t + q t² of the top, or of the end of a spring."""

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
    """What friction does over a time in one mode."""

    e: complex  #: extension at its end
    t: float
    lasts: bool  #: whether the mode lasts for all of the time that was given
    f: complex  #: force at the end of slip
    vel: float  #: slip velocity at the end
    area: complex  #: of the force over the time
    moment: complex


class Rub(NamedTuple):
    """What friction does over a time in contact."""

    e: complex  #: extension at its end
    mode: int  #: there
    f: complex  #: force there, of slip
    R: float  #: its limit
    vel: float
    area: complex
    moment: complex  #: about the begin of the step
    stuck: float
    when: float


@_inline
def vector(e, j, i):
    """Part j of the state of spring i."""
    return complex(e.x[j, i], e.y[j, i])


@_inline
def put(e, j, i, a):
    """Set it."""
    e.x[j, i], e.y[j, i] = a.real, a.imag


@_inline
def memory(e, i, arms):
    """sum rho_j e_j/theta_j of spring i."""
    total = 0.0j
    for j in range(arms.rho.size):
        total += arms.rho[j] * arms.rate[j] * vector(e, 1 + j, i)
    return total


# --- brackets ---


@_inline
def between(b):
    """Where the line through the two ends of a bracket is zero."""
    return (b.low * b.f_high - b.high * b.f_low) / (b.f_high - b.f_low)


@_inline
def nearer(b, mid, f):
    """A bracket after a look at mid, by regula falsi (the Illinois method)."""
    if (f < 0.0) == (b.f_high < 0.0):
        return Bracket(b.low, mid, b.f_low * (0.5 if b.side > 0 else 1.0), f, 1)
    return Bracket(mid, b.high, f, b.f_high * (0.5 if b.side < 0 else 1.0), -1)


# --- stick ---


@_inline
def excess(f, R, t):
    """By how much a force is outside its disc at a time."""
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
        if excess(f, R, high) > tol:
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
            if excess(f, R, mid) > tol:
                return low, mid
    return t, np.inf


@_inline
def until_slip(f, R, t, tol):
    """When the force f of a spring that sticks leaves the disc R, both cubics; t if it does not."""
    low, high = until_outside(f, R, t, tol)
    if high > t:
        return t
    if excess(f, R, low) > -tol and leaves(f, R, low) < 0.0:  # from the rim inward, and out again later
        part = high - low
        for _ in range(MOST_HALVINGS):
            part *= 0.5
            out = excess(f, R, low + part)
            if out < -tol:
                low += part
                break
            if out > tol:
                high = low + part
    b = Bracket(low, high, min(excess(f, R, low), -0.0), excess(f, R, high), 0)
    for _ in range(MOST_HALVINGS):
        if b.high - b.low <= 1e-15 * t:
            break
        mid = between(b)
        out = excess(f, R, mid)
        if abs(out) <= 0.1 * tol:
            return mid
        b = nearer(b, mid, out)
    return b.high


@_inline
def sticks(e_0, e, i, w, top, R, t, k, tol, T, arms, tools, look):
    """Stick from now on, for as long as it lasts."""
    until, p, q = until_slip(held_force(e_0, e, i, top, t, k, T, arms, tools), R, t, tol), top.p, top.q
    lasts = until >= t
    if not lasts:
        t, k = until, 1
        if arms is not None:
            fill(t, None, arms, tools, 1)
    if look is not None:
        lost = lost_on_parabola(e.x, i, p.real, q.real, t, T, arms)
        look.sums[SHEAR_VISCOUS] += w * (lost + lost_on_parabola(e.y, i, p.imag, q.imag, t, T, arms))
        look.sums[STICK_IMPULSE] += w * t * (at(R, 0.0) + 4.0 * at(R, 0.5 * t) + at(R, t)) / 6.0
        look.sums[LEAST_SLIP] = min(look.sums[LEAST_SLIP], 0.0)
    area, moment = force(e_0, p, q, T, t)
    if arms is not None:
        A_x, B_x = hold_arms(e.x, i, p.real, q.real, k, tools, arms)
        A_y, B_y = hold_arms(e.y, i, p.imag, q.imag, k, tools, arms)
        area, moment = area + complex(A_x, A_y), moment + complex(B_x, B_y)
    return Stretch(e_0 + t * (p + t * q), t, lasts, 0.0j, 0.0, area, moment)


# --- slip ---


@_inline
def remembered(e, i, p, p_fast, q, t, k, keep, tools, arms):
    """What the arms of spring i, held on p t + q t² for a time t, come to: the sums of rho_j e_j, of rho_j e_j/theta_j,
    and the mean of the latter over the time. Fast arms, of theta_j < h, are held on p_fast t + q t². keep: True stores
    what they come to.
    """
    of = tools.held[k]
    one = two = mean = 0.0j
    for j in range(arms.rho.size):
        before, rate, is_fast = vector(e, 1 + j, i), arms.rate[j], arms.rate[j] * tools.h > 1.0
        first = p_fast if is_fast else p
        after = before * of[0, j] + first * of[1, j] + q * of[2, j]
        area = before * of[3, j] + first * of[4, j] + q * of[5, j]
        if keep:
            put(e, 1 + j, i, after)
        one += arms.rho[j] * after
        two += arms.rho[j] * rate * after
        mean += rate * area * (1.0 / t)
    return one, two, mean


@_inline
def arms_give(t, k, G, T, tools, arms):
    """By how much the length of an extension over a time t exceeds that of its slow arms; and the memory of its fast
    ones its slip velocity at the end.
    """
    per, back, gives = t, 0.0, 1.0 / G
    for j in range(arms.rho.size):
        if arms.rate[j] * tools.h > 1.0:
            back += arms.rho[j] * arms.rate[j] * tools.held[k, 2, j] / (2.0 * t)
        else:
            per += arms.rho[j] * tools.held[k, 1, j]
    if T > 0.0:
        gives = 0.5 * t / T * phi_of(0.5 * G * t / T)[2]
    return per, gives * back


@_inline
def slip_over(e_0, e, i, top, start, R, t, k, midway, G, T, arms, tools):
    """Slip over a time, and the way on which it takes the end of the spring: a parabola with the true rates at both
    ends, shifted so that the force is. The memory of arms and their slip are brought in line with each other.
    """
    rate_0, rate_1 = top.p - start.vel * start.n, top.p + 2.0 * t * top.q
    v, way = Cubic(start.v, 2.0 * G * top.q, 0.0j, 0.0j), Way(rate_0, 0.0j)
    of, per, back, turns, others = Slip(start.n, start.vel, 0.0j, 0.0j, start.vel), t, 0.0, 1, 0.0j
    if arms is not None:
        per, back = arms_give(t, k, G, T, tools, arms)
        turns = MOST_RETURNS
    for _ in range(turns):
        if arms is not None:
            # by the parabola of both ends and the mean, as R goes: then what relaxes with the disc does not slip
            _, last, mean = remembered(e, i, way.p, rate_0, way.q, t, k, False, tools, arms)
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
        end = (max(at(R, t), 0.0) + T * of.vel) * of.n - T * rate_1
        way = Way((end - e_0 - others) * (1.0 / per) - t * q, q)
    return of, way


@_inline
def slips(e_0, e, i, w, top, start, R, t, k, forced, h, G, T, arms, tools, look):
    """Slip from now on, for as long as it lasts: until its velocity falls below zero. forced: it lasts in any case."""
    lasts, b = True, Bracket(0.0, t, start.vel, 0.0, 0)
    of, way = Slip(start.n, start.vel, 0.0j, 0.0j, start.vel), Way(0.0j, 0.0j)
    for turn in range(MOST_HALVINGS):
        of, way = slip_over(e_0, e, i, top, start, R, t, k, look is not None, G, T, arms, tools)
        if turn == 0:
            if forced or of.vel >= 0.0:
                break
            lasts = False
            b = Bracket(0.0, t, start.vel, of.vel, 0)
        else:
            b = nearer(b, t, of.vel)
        if (b.high - b.low <= 1e-14 * h and t == b.high) or b.f_low <= 0.0 or abs(of.vel) <= 1e-14 * start.vel:
            break
        t = max(between(b), ROUNDING * h)
        if not b.low < t < b.high:
            t = 0.5 * (b.low + b.high)
        if b.high - b.low <= 1e-14 * h:
            t = b.high
        k = 1
        if arms is not None:
            fill(t, None, arms, tools, 1)
    if not lasts and b.f_low <= 0.0 and b.low == 0.0:  # it does not slip at all
        return Stretch(e_0, 0.0, False, 0.0j, 0.0, 0.0j, 0.0j)
    vel, R_0, R_m, R_1 = max(of.vel, 0.0) if lasts else 0.0, max(R.a, 0.0), max(at(R, 0.5 * t), 0.0), max(at(R, t), 0.0)
    f_1 = R_1 * of.n
    if look is not None:
        lost = lost_on_parabola(e.x, i, way.p.real, way.q.real, t, T, arms)
        look.sums[SHEAR_VISCOUS] += w * (lost + lost_on_parabola(e.y, i, way.p.imag, way.q.imag, t, T, arms))
        of_slip = R_0 * start.vel + 4.0 * R_m * max(of.l_m, 0.0) + R_1 * vel
        look.sums[FRICTION_LOSS] += w * t / 6.0 * of_slip
        look.sums[LEAST_SLIP] = min(look.sums[LEAST_SLIP], start.vel, vel)
    end = (R_1 + T * vel) * of.n - T * (top.p + 2.0 * t * top.q)
    if arms is not None:
        others, _, _ = remembered(e, i, way.p, top.p - start.vel * start.n, way.q, t, k, True, tools, arms)
        end -= others
    return Stretch(end, t, lasts, f_1, vel, of.area, of.moment)


@_inline
def even_part(R, more, t, shortest):
    """How much of a time t to follow slip for at once, on the leash R + more, R a cubic: two nodes tell how far it
    turns the spring only where it does not change much.
    """
    u, first = t, R.a + more
    while u > shortest:
        middle, last = at(R, 0.5 * u) + more, at(R, u) + more
        if EVEN * min(first, middle, last) >= max(first, middle, last):
            break
        u *= 0.5
    return u


# --- a step ---


@_inline
def start_of(e_0, e, i, top, R, h, G, T, arms):
    """A spring in contact as a stretch of time begins, under the disc R, a cubic."""
    g, a = e_0 + T * top.p, 0.0j
    if arms is not None:
        a = memory(e, i, arms)
        for j in range(arms.rho.size):
            g += arms.rho[j] * vector(e, 1 + j, i)
    v = G * top.p + 2.0 * T * top.q - a
    rho, fast = size_of(g), size_of(v)
    n = g * (1.0 / rho) if rho > TOUCHING * h * fast else v * (1.0 / max(fast, TINY))
    ahead = along(v, n) - R.b
    vel = max(rho - max(R.a, 0.0), 0.0) / T if T > 0.0 else max(ahead, 0.0) / G
    return Start(g, a, v, n, vel, ahead)


@_inline
def held_force(e_0, e, i, top, t, k, T, arms, tools):
    """The force of spring i on the way of the top for a time t, a cubic."""
    f = held(e_0, top.p, top.q, T, t)
    if arms is not None:
        a = arms_ends(e.x, i, top.p.real, top.q.real, t, k, tools, arms)
        b = arms_ends(e.y, i, top.p.imag, top.q.imag, t, k, tools, arms)
        v_1, d_1 = f.v_1 + complex(a.v_1, b.v_1), f.d_1 + complex(a.d_1, b.d_1)
        f = Ends(f.v_0 + complex(a.v_0, b.v_0), f.d_0 + complex(a.d_0, b.d_0), v_1, d_1, f.low, f.high)
    return cubic(f, t)


@_inline
def rubs(e_0, e, i, w, top, R, t, k, done, tol, h, G, T, arms, tools, look):
    """Friction over a time t in contact, under the disc R, a cubic, from event to event. done: of the step before."""
    gone, zeros, mode, limit, f, vel = 0.0, 0, BEGINS, 0.0, 0.0j, 0.0
    area, moment, stuck, when = 0.0j, 0.0j, 0.0, 0.0
    for _ in range(MOST_EVENTS):
        left, begun = t - gone, done + gone
        start = start_of(e_0, e, i, top, R, h, G, T, arms)
        if mode == BEGINS:
            out = size_of(start.g) - max(R.a, 0.0)
            mode = SLIP if (out >= -tol and start.ahead > 0.0) or (T > 0.0 and out > tol) else STICK
        u = left if mode == STICK else even_part(R, T * start.vel + tol, left, SHORTEST * h)
        if u < t:
            k = 1
        if arms is not None and k == 1:
            fill(u, None, arms, tools, 1)
        if mode == STICK:
            of = sticks(e_0, e, i, w, top, R, u, k, tol, T, arms, tools, look)
            stuck, when = stuck + of.t, when + of.t * (begun + 0.5 * of.t)
        else:  # after two stretches without length slip and stick hold alike
            of = slips(e_0, e, i, w, top, start, R, u, k, zeros > 1, h, G, T, arms, tools, look)
        e_0, area, moment = of.e, area + of.area, moment + begun * of.area + of.moment
        if mode == STICK or of.t > 0.0:
            f, vel = of.f, of.vel
        if (of.lasts and u == left) or left - of.t <= ROUNDING * h:  # what is left is the rounding of the time
            limit = max(at(R, of.t), 0.0)
            break
        zeros = 0 if of.t > 0.0 else zeros + 1
        gone += of.t
        top, R = Way(top.p + 2.0 * of.t * top.q, top.q), since(R, of.t)
        if not of.lasts:
            mode = STICK if mode == SLIP else SLIP
    return Rub(e_0, mode, f, limit, vel, area, moment, stuck, when)


@_inline
def presses(s, i, w, z_1, z_2, t, k, T, arms, tools, look):
    """Press spring i on z_1 t + z_2 t² for a time t: its normal force, a cubic."""
    press = held(s[0, i], z_1, z_2, T, t)
    if arms is not None:
        press = plus(press, 1.0, arms_ends(s, i, z_1, z_2, t, k, tools, arms))
    R = cubic(press, t)
    if look is not None:
        look.sums[NORMAL_VISCOUS] += w * lost_on_parabola(s, i, z_1, z_2, t, T, arms)
        for u, share in ((0.0, 1.0 / 6.0), (0.5 * t, 4.0 / 6.0), (t, 1.0 / 6.0)):
            look.sums[CONTACT_IMPULSE] += w * t * share * at(R, u)
            look.sums[NORMAL_WORK] += w * t * share * at(R, u) * (z_1 + 2.0 * z_2 * u)
    s[0, i] += t * (z_1 + z_2 * t)
    if arms is not None:
        hold_arms(s, i, z_1, z_2, k, tools, arms)
    return R


@_inline
def relaxes(x, i, k, modes, arms, tools):
    """Let x[:, i] relax for a time in which nothing holds it: the elastic energy that this takes."""
    before = stored(x, i, arms)
    relax(x, i, k, modes, arms, tools)
    return before - stored(x, i, arms)


@_inline
def stored(x, i, arms):
    """Elastic energy of x[:, i]."""
    energy = x[0, i] ** 2
    if arms is not None:
        for j in range(arms.rho.size):
            energy += arms.rho[j] * x[1 + j, i] ** 2
    return 0.5 * energy


@_inline
def stuck_at(e_0, e, i, rate, limit, T, arms):
    """Force of a spring that sticks, under this limit, where its top has this rate."""
    f = e_0 + T * rate
    if arms is not None:
        for j in range(arms.rho.size):
            f += arms.rho[j] * vector(e, 1 + j, i)
    size = size_of(f)
    return f * (limit / size) if size > limit else f


@compiled(error_model="numpy", nogil=True, fastmath=_FAST)
def row_turning(s, e, gap, w, path, y_1, y_2, T, modes, arms, tools, look):
    """All springs over a step, as `row` of step.py, with a way y_1 t + y_2 t² across the pull too.

    e: (2 (1 + J), n) extensions and arms along the pull, then those across. look: None or LookAcross.
    """
    made, did = np.zeros(4 * gap.size), Whole(0.0j, 0.0j, 0.0j, 0.0)
    if look is None:  # noqa: SIM102 - numba leaves out what comes after one such condition, not after two
        if arms is None:
            did = whole(s[0], e[0], e[1], gap, w, path, y_1, y_2, tools.h, T, modes, made)
    return events(s, e, gap, w, path, y_1, y_2, T, modes, arms, tools, look, made, did)


@inner(error_model="numpy", fastmath=_FAST, **LENT)
def events(s, e, gap, w, path, y_1, y_2, T, modes, arms, tools, look, made, did):
    """The springs that are left, from event to event."""
    h, J, G = tools.h, s.shape[0], glassy(arms)
    ext = Pair(e[:J], e[J:])
    area, moment, end, sticking = did
    stuck, when = h * sticking, 0.5 * h * h * sticking
    least = np.inf
    z_2, way_p, way_q = path.z_2, complex(path.x_1, y_1), complex(path.x_2, y_2)
    for i in range(gap.size):
        if made[4 * i + 3] != 0.0:
            s[0, i], e[0, i], e[1, i] = made[4 * i + 0], made[4 * i + 1], made[4 * i + 2]
            continue
        tol = ROUNDING * (1.0 + abs(gap[i]))
        z_0, z_1, t, done, k = path.z_0 - gap[i], path.z_1, h, 0.0, 0
        mode, f, R, vel = FREE, 0.0j, 0.0, 0.0
        touch = s[0, i] <= z_0 + tol
        if touch:
            s[0, i] = z_0
        for event in range(MOST_EVENTS):
            touch, until = lasts(touch, event, s, i, z_0, z_1, z_2, t, k, tol, G, T, modes, arms, tools)
            ends = until < t
            if ends:
                t, k = until, 1
                fill(t, modes, arms, tools, 1)
            if not touch:
                mode, f, R, vel = FREE, 0.0j, 0.0, 0.0
                lost = relaxes(ext.x, i, k, modes, arms, tools) + relaxes(ext.y, i, k, modes, arms, tools)
                normal = relaxes(s, i, k, modes, arms, tools)
                if look is not None:
                    look.sums[NORMAL_VISCOUS] += w[i] * normal
                    look.sums[SHEAR_VISCOUS] += w[i] * lost
            elif t > ROUNDING * h:
                disc = presses(s, i, w[i], z_1, z_2, t, k, T, arms, tools, look)
                top = Way(way_p + 2.0 * done * way_q, way_q)
                of = rubs(vector(ext, 0, i), ext, i, w[i], top, disc, t, k, done, tol, h, G, T, arms, tools, look)
                put(ext, 0, i, of.e)
                mode, f, R, vel = of.mode, of.f, of.R, of.vel
                area += w[i] * of.area
                moment += w[i] * of.moment
                stuck += w[i] * of.stuck
                when += w[i] * of.when
            if not ends:
                break
            done += t
            z_0, z_1, touch = z_0 + t * (z_1 + t * z_2), z_1 + 2.0 * z_2 * t, not touch
            if touch:
                s[0, i] = z_0
            t, k = h - done, 1
            fill(t, modes, arms, tools, 1)
        if mode == STICK:
            sticking += w[i]
            f = stuck_at(vector(ext, 0, i), ext, i, way_p + 2.0 * h * way_q, R, T, arms)
        end += w[i] * f
        if look is not None:
            if mode != FREE:
                least = min(least, vel)
            look.mode[i], look.f_x[i], look.f_y[i], look.f_z[i] = mode, f.real, f.imag, R
            look.F[0] += w[i] * f.real
            look.F[1] += w[i] * R
            look.F[3] += w[i] * f.imag
    if look is not None:
        look.F[2] = least
    return Sums(area.real, area.imag, moment.real, moment.imag, end.real, end.imag, stuck, when, sticking)
