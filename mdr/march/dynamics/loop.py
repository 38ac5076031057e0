"""The compiled march: springs and body step by step, period by period.

Scaled form (dimensionless.py): time is omega t, normal lengths are in du_z, tangential ones in mu_0 kappa du_z,
stiffnesses in that of the array. Ways, extensions and tangential forces are real numbers where all moves along the
pull, and complex ones, along and across it, where something moves across it too. A state are extensions (1 + J, n) of
the springs and their arms, and the body (body.py). The compressions go beside it, as friction has no part in them.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.march.dynamics.body import RATE, Y
from mdr.march.dynamics.broyden import ROOM, correct
from mdr.spring.contact import Look, within
from mdr.spring.energies import SHEAR_WORK, Nodes, nodes_of
from mdr.spring.motion import glassy
from mdr.spring.path import FAST, LENT, OWN, ROUNDING, Path, along
from mdr.spring.row import as_they_are, row
from mdr.spring.times import tools_of
from mdr.tools.arrays import Array
from mdr.tools.jit import compiled, inner

_jit = compiled(nogil=True, error_model="numpy", fastmath=FAST)
_inner = inner(error_model="numpy", fastmath=FAST, **OWN)
_lent = inner(error_model="numpy", fastmath=FAST, **LENT)
_inline = inner(forceinline=True, error_model="numpy", fastmath=FAST, **LENT)

SHORTEST_PART = (
    1e-6  #: share of a step below which a part of it is not followed by itself: a step is cut at a first touch
)
MOST_ITERATIONS = (
    32  #: of the solution of a step: the slowest, of springs on stiff dashpots, gains half a digit in each
)
PLAIN = 2  #: iterations of a step in the plane, before what slip along one direction does to the other is learned
MOST_PLACES = 99  #: in the search for a zero of one unknown
BALANCED = 1e-11  #: of the forces in a step, that may be missing in their balance; a periodic state may change by more


class Motion(NamedTuple):
    """The way of the indenter over one period of n_t steps, without the body."""

    z: Array  #: (n_t + 1,) normal motion
    z_dot: Array  #: (n_t + 1,) its rate
    v: float  #: steady velocity of the pull
    x: Array  #: (n_t + 1,) way of a shake in the plane
    x_dot: Array  #: (n_t + 1,) its rate


class FullSlipForce(NamedTuple):
    """The force of the springs over each of the n_t steps of a period, if they all slip forward: bodies with mass
    follow its moment, light ones the force at the end.
    """

    area: Array  #: (n_t,)
    moment: Array  #: (n_t,) about the start of the step
    end: Array  #: (n_t,) force at its end


class Here(NamedTuple):
    """The motion of the indenter in a step, without the body, and the force of full slip, where it is known."""

    path: Path
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


class Springs(NamedTuple):
    """The row of springs."""

    gap: Array  #: (n,) depth of each foot below the mean surface position
    w: Array  #: (n,) share of each spring in the stiffness


class BodyMotion(NamedTuple):
    """The body in one direction over a step."""

    y: float  #: its motion relative to the pull, at the end
    q: float  #: the second unknown of Newton's method: its rate there, or u = y'' h²/2 of a light body
    rate: float
    b_1: float  #: it moves by b_1 t + b_2 t²
    b_2: float


class Trace(NamedTuple):
    """Record of each step of a march, numbers or vectors."""

    area: Array  #: (n_steps,) of the tangential force
    moment: Array  #: (n_steps,) of it
    y: Array  #: (n_steps,) motion of the body relative to the pull, at the end of the step
    rate: Array  #: (n_steps,) its rate there
    parts: (
        Array  #: (n_steps, 2, 3) length, x_1, x_2 of the top in two parts; if the first has no length, no more is set
    )


class Seen(NamedTuple):
    """Record that a close look at a period fills, of n_t steps and n springs; f and e are vectors in the plane."""

    nodes: Nodes  #: over a step
    sums: Array  #: (N_SUMS,)
    F: Array  #: (n_t, 4) at the end of each step: force along and normal, least slip velocity, force across
    mode: Array  #: (n_t or 0, n) of each spring
    f: Array  #: (n_t or 0, n) its force over its stiffness
    f_z: Array  #: (n_t or 0, n)
    e: Array  #: (n_t or 0, n)
    s: Array  #: (n_t or 0, n)


@_inline
def put(x, out):
    """Copy x into out, of the same shape (k, n)."""
    for j in range(x.shape[0]):
        for i in range(x.shape[1]):
            out[j, i] = x[j, i]


@_inline
def copy(x, out):
    """Copy x into out, of the same shape (n,)."""
    for i in range(x.size):
        out[i] = x[i]


@_inline
def path_of(motion, k, h):
    """The parabolas of step k, without the body."""
    z, zd, x, xd = motion.z, motion.z_dot, motion.x, motion.x_dot
    z_2, x_2 = (zd[k + 1] - zd[k]) / (2.0 * h), (xd[k + 1] - xd[k]) / (2.0 * h)
    return Path(z[k], (z[k + 1] - z[k]) / h - z_2 * h, z_2, motion.v + (x[k + 1] - x[k]) / h - x_2 * h, x_2)


@_inline
def later(path, t):
    """A motion, its time counted from t on."""
    z_0 = path.z_0 + t * (path.z_1 + t * path.z_2)
    return Path(z_0, path.z_1 + 2.0 * path.z_2 * t, path.z_2, path.x_1 + 2.0 * path.x_2 * t, path.x_2)


@_jit
def march(e, s, of_body, body, side, springs, slip, flight, motion, law, tools, n_steps, trace):
    """March n_steps from the begin of a period; e, s (1 + J, n) and of_body (N_BODY,) are updated in place.

    body, side: Body along the pull and across it; along a line side is None. slip: the FullSlipForce of a body along a
    line, else None; flight (n_t,): of a light one there, time to the first touch in a step that begins without contact,
    else zero. What is None is compiled away. trace: filled.
    Returns whether every step was solved for.
    """
    h, n_t, solved, last = tools.times.h, motion.z.size - 1, True, Last(0.0, 0.0)
    # in the plane, where a row has no excess, the room of `correct`: one more array costs a fifth of a step on a line
    excess = np.zeros((s.shape[0], 1) if side is None else (4 + ROOM, 4))
    room = np.empty_like(e), np.empty_like(s), excess
    for j in range(n_steps):
        k = j % n_t
        trace.parts[j, 0, 0] = 0.0  # one part, unless `follow` cuts the step
        if k == 0:  # as if in full slip, so that no state depends on how many periods are marched at once
            last = Last(0.0, 0.0)
            excess[:] = 0.0
        here = Here(path_of(motion, k, h), motion.z_dot[k + 1], motion.v + motion.x_dot[k + 1], motion.v, 0.0, 0.0, 0.0)
        if slip is not None:
            here = Here(*here[:4], slip.area[k], slip.moment[k], slip.end[k])
        if flight is not None:
            area, moment, last, found = follow(
                e, s, room, of_body, last, body, springs, here, slip, flight, flight[k], law, tools, j, trace
            )
        else:
            path, area, moment, last, found = stepped(
                e, s, room, of_body, last, body, side, springs, here, slip, flight, law, tools
            )
            note(trace, j, 1, h, path)
        solved = solved and found
        trace.area[j], trace.moment[j], trace.y[j], trace.rate[j] = area, moment, of_body[Y], of_body[RATE]
    return solved


@_lent
def stepped(e, s, room, of_body, last, body, side, springs, here, slip, flight, law, tools):
    """A step of springs and body: it moves as their force makes it, and they move with it.

    Newton's method on its motion at the end, by the stiffness of what sticks. Along a line iteration 0 takes the force
    that the springs have if none changes its mode (`last`), which most often is the true one; and where other springs
    stick under a light body at every iteration, `enclosed` finds them. In the plane both directions go `together` after
    the first iterations.

    room: for e, s, and the excess of `row` or `correct`. flight: here it only tells a light body along a line. The
    others as of `march`. Returns path, area, moment, what springs do at the end, as far as a next step asks for it, and
    whether this was solved; e, s, of_body are updated.
    """
    (gap, w), (T, modes, arms), (e_0, s_0, excess) = springs, law, room
    h, path, found = tools.times.h, here.path, False
    y_0, rate_0, fresh = of_body[Y], of_body[RATE], True
    ahead, aside = motion_on(y_0.real, rate_0.real, body, h), BodyMotion(0.0, 0.0, 0.0, 0.0, 0.0)
    if side is not None:
        aside = motion_on(y_0.imag, rate_0.imag, side, h)
    area = moment = 0.0 * e[0, 0]
    put(e, e_0)
    put(s, s_0)
    for iteration in range(MOST_ITERATIONS + 1):
        if flight is not None and iteration == MOST_ITERATIONS:
            ahead = enclosed(e, s, room, of_body, body, springs, here, law, tools)
        path, rate = moved(here.path, ahead, aside, side)
        if slip is not None and iteration == 0:
            area, moment, end = as_they_are(
                path, last.sticking, last.back, law.T, law.arms, tools, excess, here.z_dot, here.x_dot + rate
            )
            area, moment, end = here.area + area, here.moment + moment, here.end + end
            stick = last.sticking * h, 0.5 * last.sticking * h * h, last.sticking
        else:
            if not fresh:
                put(e_0, e)
                put(s_0, s)
            of = row(s, e, gap, w, path, here.z_dot, here.x_dot + rate, T, modes, arms, tools, excess, None, None)
            fresh, last = False, Last(of.sticking, of.back)
            area, moment, end = of.area, of.moment, of.end
            if side is None or iteration <= PLAIN:
                stick = of.stuck, of.stuck_moment, of.sticking
        next_ahead, found = newton_step(
            ahead, y_0.real, rate_0.real, area.real, moment.real, end.real, stick, here.v, body, law, h
        )
        if side is not None:
            next_aside, other = newton_step(
                aside, y_0.imag, rate_0.imag, area.imag, moment.imag, end.imag, stick, here.v, side, law, h
            )
            found = found and other
            if iteration >= PLAIN and not found:
                next_ahead, next_aside = together(
                    ahead, aside, next_ahead, next_aside, y_0, rate_0, body, side, excess, iteration == PLAIN, h
                )
            aside = next_aside
        ahead = next_ahead
        if found and not fresh:
            break
    of_body[Y], of_body[RATE] = ahead.y, ahead.rate
    if side is not None:
        of_body[Y], of_body[RATE] = complex(ahead.y, aside.y), complex(ahead.rate, aside.rate)
    return path, area, moment, last, found


@_lent
def together(ahead, aside, next_ahead, next_aside, y_0, rate_0, body, side, past, begins, h):
    """The motion of a body in both directions nearer to where the forces take it. ahead, aside: the motion now; next_:
    what Newton's method makes of each direction for itself. Broyden's method learns from iteration to iteration what a
    motion along one direction does to the force along the other.

    past, begins: of `correct`.
    """
    unit, unit_aside = 1.0 if body.light else h, 1.0 if side.light else h
    left = (
        ahead.y - next_ahead.y,
        (ahead.q - next_ahead.q) * unit,
        aside.y - next_aside.y,
        (aside.q - next_aside.q) * unit_aside,
    )
    correct(past, left, begins)
    change = past[4]
    return (
        motion_to(ahead.y + change[0], ahead.q + change[1] / unit, y_0.real, rate_0.real, body, h),
        motion_to(aside.y + change[2], aside.q + change[3] / unit_aside, y_0.imag, rate_0.imag, side, h),
    )


@_inline
def motion_on(y_0, rate_0, body, h):
    """Motion of a body that keeps its velocity: the first guess."""
    return motion_to(y_0 + h * rate_0, 0.0 if body.light else rate_0, y_0, rate_0, body, h)


@_inline
def motion_to(y, q, y_0, rate_0, body, h):
    """Motion of a body from y_0 to y."""
    dy = y - y_0
    b_2, rate = (q - rate_0) / (2.0 * h), q
    if body.light:
        b_2, rate = q / (h * h), (dy + q) / h
    if body.rigid:
        return BodyMotion(0.0, 0.0, 0.0, 0.0, 0.0)
    return BodyMotion(y, q, rate, dy / h - b_2 * h, b_2)


@_inline
def moved(path, ahead, aside, side):
    """The motion of the indenter with a body that moves so, and the rate of the body at the end."""
    b_1, b_2, rate = ahead.b_1, ahead.b_2, ahead.rate
    if side is not None:
        b_1, b_2, rate = complex(b_1, aside.b_1), complex(b_2, aside.b_2), complex(rate, aside.rate)
    return Path(path.z_0, path.z_1, path.z_2, path.x_1 + b_1, path.x_2 + b_2), rate


@_inline
def newton_step(one, y_0, rate_0, area, moment, end, stick, v, body, law, h):
    """A body nearer to where these forces take it, and whether it was there."""
    stuck, stuck_moment, sticking = stick
    if body.rigid:
        return one, True
    if body.light:
        impulse, force, close = residual_light(one.y, one.q, one.rate, y_0, rate_0, area, end, body, law, h)
        dy, dq = newton_light(impulse, force, stuck, stuck_moment, sticking, body, law, h)
        is_close = abs(impulse) + abs(force) <= close
    else:
        off, off_rate, is_close = residual_heavy(one.y, one.q, y_0, rate_0, area, moment, v, body, h)
        dy, dq = newton_heavy(off, off_rate, stuck / h, body)
    if is_close:
        return one, True
    return motion_to(one.y - dy, one.q - dq, y_0, rate_0, body, h), False


@_inline
def residual_heavy(y, rate, y_0, rate_0, area, moment, v, body, h):
    """Residual of a body with mass: its distance, in y and rate, from where area and moment of the force take it; and
    whether that is nothing.
    """
    free = body.free
    push = body.area[0] * area + body.moment[0] * moment
    push_rate = body.area[1] * area + body.moment[1] * moment
    off = y - (free[0][0] * y_0 + free[0][1] * rate_0) + push
    off_rate = rate - (free[1][0] * y_0 + free[1][1] * rate_0) + push_rate
    least = ROUNDING * (abs(y) + h * (abs(rate) + abs(v)))
    return off, off_rate, abs(off) + h * abs(off_rate) <= BALANCED * (abs(push) + h * abs(push_rate)) + least


@_inline
def newton_heavy(off, off_rate, share, body):
    """Newton correction of a body with mass, to be taken from y and rate, by the stiffness of what sticks."""
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
        one, now = Here(rest, *here[1:]), tools
        if part == 0:
            one = Here(here.path, rest.z_1, rest.x_1, here.v, 0.0, 0.0, 0.0)
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
def residual_light(y, q, rate, y_0, rate_0, area, end, body, law, h):
    """Residual of a light body that moves to y with q: impulse (over h) and force that are left, under the area of a
    force and the force at the end; and how little of them counts as none.
    """
    M, C, K = body.M, body.C, body.K
    impulse = M * (rate - rate_0) / h + C * (y - y_0) / h + K * (0.5 * (y_0 + y) - q / 6.0) + area / h
    force = 2.0 * M * q / (h * h) + C * rate + K * y + end
    size, slope = abs(K * y) + abs(end) + h, steepest(body, law, h)  # a spring that is pressed gains some h in a step
    return impulse, force, BALANCED * (size + slope * (abs(y - y_0) + abs(q))) + ROUNDING * slope * abs(y)


@_inline
def newton_light(impulse, force, stuck, stuck_moment, sticking, body, law, h):
    """Newton correction of a light body, to be taken from y and q, by the stiffness of what sticks."""
    M, C, K, T, stiff, share = body.M, body.C, body.K, law.T, glassy(law.arms), stuck / h
    a = M / (h * h) + C / h + 0.5 * (K + share * stiff) + T * share / h
    b = M / (h * h) - (K + share * stiff) / 6.0 + T * (2.0 * stuck_moment / h - stuck) / (h * h)
    c, d = C / h + K + sticking * (stiff + T / h), 2.0 * M / (h * h) + (C + sticking * T) / h
    det = a * d - b * c
    return (d * impulse - b * force) / det, (a * force - c * impulse) / det


@_lent
def residual_at(y, q, e, s, room, of_body, body, springs, here, law, tools):
    """Residual of a light body that moves to y with q, for its springs are stepped with it: e, s are updated. Also its
    motion.
    """
    (gap, w), (T, modes, arms), (e_0, s_0, excess) = springs, law, room
    put(e_0, e)
    put(s_0, s)
    one = motion_to(y, q, of_body[Y], of_body[RATE], body, tools.times.h)
    path, rate = moved(here.path, one, one, None)
    of = row(s, e, gap, w, path, here.z_dot, here.x_dot + rate, T, modes, arms, tools, excess, None, None)
    left = residual_light(y, q, rate, of_body[Y], of_body[RATE], of.area, of.end, body, law, tools.times.h)
    return left, one


@_lent
def steepest(body, law, h):
    """The most by which force or impulse of a light body can change with its motion over a step."""
    return body.M / (h * h) + (body.C + law.T) / h + body.K + glassy(law.arms)


@_inner
def enclosed(e, s, room, of_body, body, springs, here, law, tools):
    """The step of a light body by two searches, one within the other: the force at the end rises with y, and
    where it is zero, the impulse falls as q grows.
    """
    y, q, slope = of_body[Y], 0.0, steepest(body, law, tools.times.h)
    ends_y, ends_q = np.empty(4), np.full(4, np.nan)
    for _ in range(MOST_PLACES):
        ends_y[:] = np.nan
        for _ in range(MOST_PLACES):
            (impulse, force, close), one = residual_at(y, q, e, s, room, of_body, body, springs, here, law, tools)
            if abs(force) <= 0.1 * close:
                break
            y = next_place(y, force, slope, ends_y)
        if abs(impulse) <= 0.9 * close:
            break
        q = next_place(q, -impulse, slope, ends_q)
    return one


@_jit
def next_place(x, f, most, ends):
    """Where to look next for the zero of a function, f at x, that rises by no more than `most`: ever farther until its
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


@_inline
def note(trace, j, part, t, path):
    """Leave the way of the top over a part, 0 or 1, of step j."""
    trace.parts[j, part, 0], trace.parts[j, part, 1], trace.parts[j, part, 2] = t, path.x_1, path.x_2


@_jit
def within_friction(e, s):
    """Bring the extensions into the cone of friction: combinations of states may leave it."""
    for i in range(s.shape[1]):
        e[0, i] = within(e[0, i], s[0, i])


@_jit
def look(e, s, springs, motion, law, tools, trace, seen):
    """A close look at a period that was marched from e, s (1 + J, n), which are updated, and left this trace."""
    (gap, w), (T, modes, arms) = springs, law
    h, n, kept = tools.times.h, gap.size, seen.mode.shape[0]
    mode, f_z, f, F = np.empty(n), np.empty(n), np.empty_like(e[0]), np.empty(4)
    for k in range(motion.z.size - 1):
        path = path_of(motion, k, h)
        for part in range(2):
            t, x_1, x_2 = trace.parts[k, part, 0].real, trace.parts[k, part, 1], trace.parts[k, part, 2]
            if t == 0.0:
                continue
            now, nodes, here = tools, seen.nodes, Path(path.z_0, path.z_1, path.z_2, x_1, x_2)
            if t < h:
                now, nodes = tools_of(t, law.modes, law.arms, tools), nodes_of(t, law.modes, law.arms)
            path = later(here, t)
            zd, xd = path.z_1, path.x_1
            if part == 1:
                zd, xd = motion.z_dot[k + 1], motion.v + motion.x_dot[k + 1] + trace.rate[k]
            into = Look(nodes, seen.sums, F, mode, f, f_z)
            of = row(s, e, gap, w, here, zd, xd, T, modes, arms, now, None, None, into)
            seen.sums[SHEAR_WORK] += along(x_1, of.area) + 2.0 * along(x_2, of.moment)
        copy(F, seen.F[k])
        if kept > 0:
            for one, out in ((mode, seen.mode), (f_z, seen.f_z), (s[0], seen.s)):
                copy(one, out[k])
            for one, out in ((f, seen.f), (e[0], seen.e)):
                copy(one, out[k])
