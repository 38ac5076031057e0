"""A step of the body together with its springs: it moves as their force makes it, and they move with it (`stepped`).

Scaled form (dimensionless.py). What it does with mass, and light, without one or ringing too fast for the steps, is
said in body.py.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.march.dynamics.body import RATE, U
from mdr.march.dynamics.broyden import correct
from mdr.spring.copies import put
from mdr.spring.limit import Strength, limit_later
from mdr.spring.motion import glassy
from mdr.spring.path import FAST, LENT, OWN, ROUNDING, Path
from mdr.spring.row import as_they_are, row
from mdr.spring.times import tools_of
from mdr.tools.jit import inner

_inner = inner(error_model="numpy", fastmath=FAST, **OWN)
_lent = inner(error_model="numpy", fastmath=FAST, **LENT)
_inline = inner(forceinline=True, error_model="numpy", fastmath=FAST, **LENT)

#: share of a step below which a part of it is not followed by itself: a step is cut at a first touch
SHORTEST_PART = 1e-6
MOST_ITERATIONS = 32  #: of a step: the slowest solution, of springs on stiff dashpots, gains half a digit in each
PLAIN = 2  #: iterations of a step in the plane, before the coupling of the two directions is updated in the Jacobian
MOST_PLACES = 99  #: in the search for a zero of one unknown
BALANCED = 1e-11  #: of the forces in a step, that may be missing in their balance; a periodic state may change by more


class Here(NamedTuple):
    """The motion of the indenter in a step, without the body; the limit of friction, and its force in full slip, where
    it is known.
    """

    path: Path
    limit: Strength | None  #: limit.py
    z_dot: float  #: its rates at the end, of which those of the parabolas are off by h²/12 of a third derivative
    x_dot: complex
    v: float  #: velocity of the pull
    area: float  #: of the force of full slip over the step
    moment: float
    end: float  #: this force at its end


class Last(NamedTuple):
    """Modes of the springs at the end of the step before."""

    sticking: float  #: share of them that stuck
    back: float  #: share that slipped back


class BodyMotion(NamedTuple):
    """The body in one direction over a step."""

    u: float  #: its motion relative to the pull, at the end
    q: float  #: the second unknown of Newton's method: its rate there, or u'' h²/2 of a light body
    rate: float
    b_1: float  #: it moves by b_1 t + b_2 t²
    b_2: float


@_inline
def later(path, t):
    """A motion, its time counted from t on."""
    z_0 = path.z_0 + t * (path.z_1 + t * path.z_2)
    z_1, x_1 = path.z_1 + 2.0 * path.z_2 * t, path.x_1 + 2.0 * path.x_2 * t
    return Path(z_0, z_1, path.z_2, x_1, path.x_2)


@_inline
def note(trace, j, part, t, path):
    """Record the displacement of the top over a part, 0 or 1, of step j."""
    trace.parts[j, part, 0], trace.parts[j, part, 1], trace.parts[j, part, 2] = t, path.x_1, path.x_2


@_inline
def stepped(e, s, room, of_body, last, body, side, springs, here, slip, flight, law, tools):
    """A step of springs and body: it moves as their force makes it, and they move with it.

    Newton's method on its motion at the end, by the stiffness of what sticks. Along a line iteration 0 takes the force
    that the springs have if none changes its mode (`last`), which most often is the true one; and where other springs
    stick under a light body at every iteration, `enclosed` finds them. In the plane both directions go `together` after
    the first iterations.

    room: for e, s, and the lumped state of `row`, or for `correct`. flight: here it only tells a light body along a
    line. The others as of `march`. Returns path, area, moment, what springs do at the end, as far as a next step asks
    for it, and whether this was solved; e, s, of_body are updated.
    """
    (T, modes, arms), (e_0, s_0, lumped) = law, room
    h, path, limit, z_dot, found = tools.times.h, here.path, here.limit, here.z_dot, False
    u_0, rate_0, fresh = of_body[U], of_body[RATE], True
    ahead, aside = motion_on(u_0.real, rate_0.real, body, h), BodyMotion(0.0, 0.0, 0.0, 0.0, 0.0)
    if side is not None:
        aside = motion_on(u_0.imag, rate_0.imag, side, h)
    area = moment = 0.0 * e[0, 0]
    put(e, e_0)
    put(s, s_0)
    for iteration in range(MOST_ITERATIONS + 1):
        if flight is not None and iteration == MOST_ITERATIONS:
            ahead = enclosed(e, s, room, of_body, body, springs, here, law, tools)
        path, rate = moved(here.path, ahead, aside, side)
        if slip is not None and iteration == 0:
            area, moment, end = as_they_are(path, last, T, arms, tools, lumped, z_dot, here.x_dot + rate)
            area, moment, end = here.area + area, here.moment + moment, here.end + end
            stick = last.sticking * h, 0.5 * last.sticking * h * h, last.sticking
        else:
            if not fresh:
                put(e_0, e)
                put(s_0, s)
            of = row(s, e, springs, limit, path, z_dot, here.x_dot + rate, T, modes, arms, tools, lumped, None, None)
            fresh, last = False, Last(of.sticking, of.back)
            area, moment, end = of.area, of.moment, of.end
            if side is None or iteration <= PLAIN:
                stick = of.stuck, of.stuck_moment, of.sticking
        next_ahead, found = newton_step(
            ahead, u_0.real, rate_0.real, area.real, moment.real, end.real, stick, here.v, body, law, h
        )
        if side is not None:
            next_aside, other = newton_step(
                aside, u_0.imag, rate_0.imag, area.imag, moment.imag, end.imag, stick, here.v, side, law, h
            )
            found = found and other
            if iteration >= PLAIN and not found:
                next_ahead, next_aside = together(
                    ahead, aside, next_ahead, next_aside, u_0, rate_0, body, side, lumped, iteration == PLAIN, h
                )
            aside = next_aside
        ahead = next_ahead
        if found and not fresh:
            break
    of_body[U], of_body[RATE] = ahead.u, ahead.rate
    if side is not None:
        of_body[U], of_body[RATE] = complex(ahead.u, aside.u), complex(ahead.rate, aside.rate)
    return path, area, moment, last, found


@_lent
def together(ahead, aside, next_ahead, next_aside, u_0, rate_0, body, side, past, begins, h):
    """The motion of a body in both directions nearer to where the forces take it. ahead, aside: the motion now; next_:
    what Newton's method makes of each direction for itself. Broyden's method updates the coupling of both in
    the Jacobian.

    past, begins: of `correct`.
    """
    unit, unit_aside = 1.0 if body.light else h, 1.0 if side.light else h
    left = (
        ahead.u - next_ahead.u,
        (ahead.q - next_ahead.q) * unit,
        aside.u - next_aside.u,
        (aside.q - next_aside.q) * unit_aside,
    )
    correct(past, left, begins)
    change = past[4]
    return (
        motion_to(ahead.u + change[0], ahead.q + change[1] / unit, u_0.real, rate_0.real, body, h),
        motion_to(aside.u + change[2], aside.q + change[3] / unit_aside, u_0.imag, rate_0.imag, side, h),
    )


@_inline
def motion_on(u_0, rate_0, body, h):
    """Motion of a body that keeps its velocity: the first guess."""
    return motion_to(u_0 + h * rate_0, 0.0 if body.light else rate_0, u_0, rate_0, body, h)


@_inline
def motion_to(u, q, u_0, rate_0, body, h):
    """Motion of a body from u_0 to u."""
    du = u - u_0
    b_2, rate = (q - rate_0) / (2.0 * h), q
    if body.light:
        b_2, rate = q / (h * h), (du + q) / h
    if body.rigid:
        return BodyMotion(0.0, 0.0, 0.0, 0.0, 0.0)
    return BodyMotion(u, q, rate, du / h - b_2 * h, b_2)


@_inline
def moved(path, ahead, aside, side):
    """The motion of the indenter with a body that moves so, and the rate of the body at the end."""
    b_1, b_2, rate = ahead.b_1, ahead.b_2, ahead.rate
    if side is not None:
        b_1, b_2, rate = complex(b_1, aside.b_1), complex(b_2, aside.b_2), complex(rate, aside.rate)
    return Path(path.z_0, path.z_1, path.z_2, path.x_1 + b_1, path.x_2 + b_2), rate


@_inline
def newton_step(one, u_0, rate_0, area, moment, end, stick, v, body, law, h):
    """A body nearer to where these forces take it, and whether it was there."""
    stuck, stuck_moment, sticking = stick
    if body.rigid:
        return one, True
    if body.light:
        impulse, force, close = residual_light(one.u, one.q, one.rate, u_0, rate_0, area, end, body, law, h)
        du, dq = newton_light(impulse, force, stuck, stuck_moment, sticking, body, law, h)
        is_close = abs(impulse) + abs(force) <= close
    else:
        off, off_rate, is_close = residual_heavy(one.u, one.q, u_0, rate_0, area, moment, v, body, h)
        du, dq = newton_heavy(off, off_rate, stuck / h, body)
    if is_close:
        return one, True
    return motion_to(one.u - du, one.q - dq, u_0, rate_0, body, h), False


@_inline
def residual_heavy(u, rate, u_0, rate_0, area, moment, v, body, h):
    """Residual of a body with mass: its distance, in u and rate, from where area and moment of the force take it; and
    whether that is nothing.
    """
    free = body.free
    push = body.area[0] * area + body.moment[0] * moment
    push_rate = body.area[1] * area + body.moment[1] * moment
    off = u - (free[0][0] * u_0 + free[0][1] * rate_0) + push
    off_rate = rate - (free[1][0] * u_0 + free[1][1] * rate_0) + push_rate
    least = ROUNDING * (abs(u) + h * (abs(rate) + abs(v)))
    return off, off_rate, abs(off) + h * abs(off_rate) <= BALANCED * (abs(push) + h * abs(push_rate)) + least


@_inline
def newton_heavy(off, off_rate, share, body):
    """Newton correction of a body with mass, to be taken from u and rate, by the stiffness of what sticks."""
    a, b = 1.0 + share * body.stuck[0][0], share * body.stuck[0][1]
    c, d = share * body.stuck[1][0], 1.0 + share * body.stuck[1][1]
    det = a * d - b * c
    return (d * off - b * off_rate) / det, (a * off_rate - c * off) / det


@_inner
def follow(e, s, room, of_body, last, body, springs, here, slip, flight, flown, law, tools, j, trace):
    """Step j of a light body, in two parts where the first spring touches within it, after the time `flown`: a touch
    changes the velocity of the body at once.

    The parts are left in the trace; the others as of `stepped`. Returns area and moment of the force, what
    springs do at the end and whether all was solved.
    """
    h, area, moment, solved, begin, first = tools.times.h, 0.0, 0.0, True, 0.0, 1
    if SHORTEST_PART * h < flown < (1.0 - SHORTEST_PART) * h:
        begin, first = flown, 0
    rest = later(here.path, begin)
    for part in range(first, 2):
        one, now = Here(rest, limit_later(here.limit, begin), *here[2:]), tools
        if part == 0:
            one = Here(here.path, here.limit, rest.z_1, rest.x_1, here.v, 0.0, 0.0, 0.0)
            now = tools_of(begin, law.modes, law.arms, tools)
        elif first == 0:
            now = tools_of(h - begin, law.modes, law.arms, tools)
        path, of_area, of_moment, last, found = stepped(
            e, s, room, of_body, last, body, None, springs, one, slip, flight, law, now
        )
        note(trace, j, part, now.times.h, path)
        later_by = 0.0 if part == 0 else begin
        area, moment, solved = area + of_area, moment + of_moment + later_by * of_area, solved and found
    return area, moment, last, solved


@_inline
def residual_light(u, q, rate, u_0, rate_0, area, end, body, law, h):
    """Residual of a light body that moves to u with q: impulse (over h) and force that are left, under the area of a
    force and the force at the end; and how little of them counts as none.
    """
    M, C, K = body.M, body.C, body.K
    impulse = M * (rate - rate_0) / h + C * (u - u_0) / h + K * (0.5 * (u_0 + u) - q / 6.0) + area / h
    force = 2.0 * M * q / (h * h) + C * rate + K * u + end
    size, slope = abs(K * u) + abs(end) + h, steepest(body, law, h)  # a spring that is pressed gains some h in a step
    return impulse, force, BALANCED * (size + slope * (abs(u - u_0) + abs(q))) + ROUNDING * slope * abs(u)


@_inline
def newton_light(impulse, force, stuck, stuck_moment, sticking, body, law, h):
    """Newton correction of a light body, to be taken from u and q, by the stiffness of what sticks."""
    M, C, K, T, stiff, share = body.M, body.C, body.K, law.T, glassy(law.arms), stuck / h
    a = M / (h * h) + C / h + 0.5 * (K + share * stiff) + T * share / h
    b = M / (h * h) - (K + share * stiff) / 6.0 + T * (2.0 * stuck_moment / h - stuck) / (h * h)
    c, d = C / h + K + sticking * (stiff + T / h), 2.0 * M / (h * h) + (C + sticking * T) / h
    det = a * d - b * c
    return (d * impulse - b * force) / det, (a * force - c * impulse) / det


@_lent
def residual_at(u, q, e, s, room, of_body, body, springs, here, law, tools):
    """Residual of a light body that moves to u with q, for its springs are stepped with it: e, s are updated. Also its
    motion.
    """
    (T, modes, arms), (e_0, s_0, lumped) = law, room
    put(e_0, e)
    put(s_0, s)
    one = motion_to(u, q, of_body[U], of_body[RATE], body, tools.times.h)
    path, rate = moved(here.path, one, one, None)
    of = row(s, e, springs, here.limit, path, here.z_dot, here.x_dot + rate, T, modes, arms, tools, lumped, None, None)
    left = residual_light(u, q, rate, of_body[U], of_body[RATE], of.area, of.end, body, law, tools.times.h)
    return left, one


@_lent
def steepest(body, law, h):
    """The most by which force or impulse of a light body can change with its motion over a step."""
    return body.M / (h * h) + (body.C + law.T) / h + body.K + glassy(law.arms)


@_inner
def enclosed(e, s, room, of_body, body, springs, here, law, tools):
    """The step of a light body by two searches, one within the other: the force at the end rises with u, and
    where it is zero, the impulse falls as q grows.
    """
    u, q, slope = of_body[U], 0.0, steepest(body, law, tools.times.h)
    ends_u, ends_q = np.empty(4), np.full(4, np.nan)
    for _ in range(MOST_PLACES):
        ends_u[:] = np.nan
        for _ in range(MOST_PLACES):
            (impulse, force, close), one = residual_at(u, q, e, s, room, of_body, body, springs, here, law, tools)
            if abs(force) <= 0.1 * close:
                break
            u = next_place(u, force, slope, ends_u)
        if abs(impulse) <= 0.9 * close:
            break
        q = next_place(q, -impulse, slope, ends_q)
    return one


@_lent
def next_place(x, f, most, ends):
    """Next place to look for the zero of a function, f at x, that rises by no more than `most`: ever farther until its
    sign has changed, then by regula falsi (the Pegasus method).

    ends (4,): a place on the other side of the zero and f there, then the last place and f there; NaN where there is
    none yet. Updated.
    """
    a, f_a, b, f_b = ends
    if f * f_b < 0.0:
        a, f_a = b, f_b
    else:
        f_a *= f_b / (f_b + f)
    ends[0], ends[1], ends[2], ends[3] = a, f_a, x, f
    if not np.isnan(a):
        return x - f * (x - a) / (f - f_a)
    return x - f / most if np.isnan(b) else x + 4.0 * (x - b)
