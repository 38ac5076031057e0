"""The compiled march of springs whose friction turns, with a body that moves along the pull and across it.

State: extensions (2 (1 + J), n), those along first; then the body along, and the body across.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.march.body import N_BODY, RATE, Body, Y
from mdr.march.loop import (
    MOST_TURNS,
    Trace,
    corrected_balance,
    corrected_way,
    not_balanced,
    note,
    off_way,
    path_of,
    put,
)
from mdr.spring.energies import SHEAR_WORK
from mdr.spring.step import Path
from mdr.spring.turning import LookAcross, row_turning
from mdr.tools.arrays import Array
from mdr.tools.jit import compiled, inner

_jit = compiled(nogil=True, error_model="numpy", fastmath={"reassoc", "contract"})
_inline = inner(forceinline=True, error_model="numpy", fastmath={"reassoc", "contract"})


class Across(NamedTuple):
    """What moves across the pull, and what a march leaves of it."""

    x: Array  #: (n_t + 1,) way of the shake across
    x_dot: Array  #: (n_t + 1,) its rate
    body: Body  #: rigid where the body is guided
    trace: Trace


class One(NamedTuple):
    """The body in one direction at the end of a step."""

    y: float
    q: float  #: its rate; y'' h²/2 of a light body
    rate: float
    b_1: float  #: it moves by b_1 t + b_2 t²
    b_2: float


@_inline
def moved(y, q, y_0, rate_0, body, h):
    """A body that moves from y_0 to y."""
    dy = y - y_0
    b_2, rate = (q - rate_0) / (2.0 * h), q
    if body.light:
        b_2, rate = q / (h * h), (dy + q) / h
    if body.rigid:
        return One(0.0, 0.0, 0.0, 0.0, 0.0)
    return One(y, q, rate, dy / h - b_2 * h, b_2)


@_inline
def better(one, y_0, rate_0, area, moment, end, stuck, when, sticking, v, body, law, h):
    """A body nearer to where these forces take it, and whether it was there."""
    if body.rigid:
        return one, True
    if body.light:
        impulse, force, close = not_balanced(one.y, one.q, one.rate, y_0, rate_0, area, end, body, law, h)
        dy, dq = corrected_balance(impulse, force, stuck, when, sticking, body, law, h)
        is_close = abs(impulse) + abs(force) <= close
    else:
        off, off_rate, is_close = off_way(one.y, one.q, y_0, rate_0, area, moment, v, body, h)
        dy, dq = corrected_way(off, off_rate, stuck / h, body)
    if is_close:
        return one, True
    return moved(one.y - dy, one.q - dq, y_0, rate_0, body, h), False


@_jit
def march_turning(e, s, held, body, springs, motion, law, tools, n_steps, trace, across):
    """March n_steps from the begin of a period, as `march` of loop.py."""
    h, n_t, solved = tools.h, motion.z.size - 1, True
    e_0, s_0 = np.empty_like(e), np.empty_like(s)
    (gap, w), (T, modes, arms), side = springs, law, across.body
    yields = not (body.rigid and side.rigid)
    for j in range(n_steps):
        k = j % n_t
        trace.way[j, 0, 0] = 0.0
        path = path_of(motion, k, h, 0.0, 0.0, 0.0, 0.0)
        y_2 = (across.x_dot[k + 1] - across.x_dot[k]) / (2.0 * h)
        y_1 = (across.x[k + 1] - across.x[k]) / h - y_2 * h
        x_0, x_rate, y_0, y_rate = held[Y], held[RATE], held[N_BODY + Y], held[N_BODY + RATE]
        ahead = moved(x_0 + h * x_rate, 0.0 if body.light else x_rate, x_0, x_rate, body, h)
        aside = moved(y_0 + h * y_rate, 0.0 if side.light else y_rate, y_0, y_rate, side, h)
        if yields:
            put(e, e_0)
            put(s, s_0)
        for turn in range(MOST_TURNS):
            if turn > 0:
                put(e_0, e)
                put(s_0, s)
            here = Path(path.z_0, path.z_1, path.z_2, path.x_1 + ahead.b_1, path.x_2 + ahead.b_2)
            w_1, w_2 = y_1 + aside.b_1, y_2 + aside.b_2
            of = row_turning(s, e, gap, w, here, w_1, w_2, T, modes, arms, tools, None)
            held[Y], held[RATE], held[N_BODY + Y], held[N_BODY + RATE] = ahead.y, ahead.rate, aside.y, aside.rate
            rest = of.stuck, of.when, of.sticking
            ahead, found = better(ahead, x_0, x_rate, of.area_x, of.moment_x, of.end_x, *rest, motion.v, body, law, h)
            aside, other = better(aside, y_0, y_rate, of.area_y, of.moment_y, of.end_y, *rest, motion.v, side, law, h)
            found = found and other
            if found:
                break
        solved = solved and found
        note(trace, j, 1, h, here)
        across.trace.way[j, 1, 0], across.trace.way[j, 1, 1], across.trace.way[j, 1, 2] = h, w_1, w_2
        trace.area[j], trace.moment[j], trace.y[j], trace.rate[j] = of.area_x, of.moment_x, held[Y], held[RATE]
        beside = across.trace
        beside.area[j], beside.moment[j], beside.y[j] = of.area_y, of.moment_y, held[N_BODY + Y]
        beside.rate[j] = held[N_BODY + RATE]
    return solved


@_jit
def look_turning(e, s, springs, motion, law, tools, trace, across, seen):
    """A close look at a period that was marched from e, s, which are updated, and left these traces."""
    n, kept = springs.gap.size, seen.mode.shape[0]
    mode, f_x, f_z, f_y, F = np.empty(n), np.empty(n), np.empty(n), np.empty(n), np.empty(4)
    for k in range(motion.z.size - 1):
        path, side = path_of(motion, k, tools.h, 0.0, 0.0, 0.0, 0.0), across.trace.way
        here = Path(path.z_0, path.z_1, path.z_2, trace.way[k, 1, 1], trace.way[k, 1, 2])
        F[:] = 0.0
        into = LookAcross(seen.sums, F, mode, f_x, f_z, f_y)
        of = row_turning(
            s, e, springs.gap, springs.w, here, side[k, 1, 1], side[k, 1, 2], law.T, law.modes, law.arms, tools, into
        )
        seen.sums[SHEAR_WORK] += here.x_1 * of.area_x + 2.0 * here.x_2 * of.moment_x
        seen.sums[SHEAR_WORK] += side[k, 1, 1] * of.area_y + 2.0 * side[k, 1, 2] * of.moment_y
        for m in range(4):
            seen.F[k, m] = F[m]
        if kept > 0:
            for i in range(n):
                seen.mode[k, i], seen.f_x[k, i], seen.f_z[k, i], seen.f_y[k, i] = mode[i], f_x[i], f_z[i], f_y[i]
                seen.e[k, i], seen.s[k, i], seen.e_y[k, i] = e[0, i], s[0, i], e[s.shape[0], i]
