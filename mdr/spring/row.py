"""The step of a row of springs with friction: along a line, or in the plane. Lengths are scaled so that Coulomb's law
has no coefficient. Without friction it is `press` (contact.py).

gap, w (n,): depth of each foot, share in the stiffness. s, e (1 + J, n), updated: row 0 is compression and extension,
row j the stretch of arm j; e is complex in the plane. zd, xd: rates of the top at the end of the step. tools: of the
step (times.py). each: None or Each. look: None or Look. Each row answers an Answer.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

import numpy as np
from numba.core.types import Complex
from numba.extending import overload

from mdr.spring.contact import Answer, one_row
from mdr.spring.disc import rub_disc
from mdr.spring.line import rub_line
from mdr.spring.motion import hold
from mdr.spring.path import FAST, LENT, OWN
from mdr.spring.times import STEP
from mdr.spring.whole import whole
from mdr.tools.jit import compiled, inner

_inline = inner(forceinline=True, error_model="numpy", fastmath=FAST, **LENT)
_call = compiled(error_model="numpy", nogil=True, fastmath=FAST, **LENT)


@_call
def row(s, e, gap, w, path, zd, xd, T, modes, arms, tools, excess, each, look):
    """The step along a line. excess: None, or (1 + J, 1), filled with the sum of w (e - s) of springs that stick at the
    end, and of -2 w s of those that slip back, for `as_they_are`.
    """
    return one_row(rub_line, None, s, e, gap, w, path, zd, xd, T, modes, arms, tools, excess, each, look)


@compiled(error_model="numpy", nogil=True, fastmath=FAST, **OWN)
def row_in_plane(s, e, gap, w, path, zd, xd, T, modes, arms, tools, each, look):
    """The step in the plane."""
    if look is None:  # noqa: SIM102 - numba leaves out what comes after one such condition, not after two
        if arms is None:
            made, others, n = np.empty(4 * gap.size), np.empty(gap.size, np.int64), 0
            of = whole(s[0], e[0], gap, w, path, tools.times.h, T, modes, each, made)
            for i in range(gap.size):
                if made[4 * i + 3] != 0.0:
                    s[0, i], e[0, i] = made[4 * i], complex(made[4 * i + 1], made[4 * i + 2])
                else:
                    others[n] = i
                    n += 1
            indices = others[:n]
            return both(
                of, one_row(rub_disc, indices, s, e, gap, w, path, zd, xd, T, modes, arms, tools, None, each, look)
            )
    return one_row(rub_disc, None, s, e, gap, w, path, zd, xd, T, modes, arms, tools, None, each, look)


def any_row(s, e, gap, w, path, zd, xd, T, modes, arms, tools, excess, each, look):
    """The step along a line, or in the plane, without the excess: as the type of e says."""
    if np.iscomplexobj(e):
        return row_in_plane(s, e, gap, w, path, zd, xd, T, modes, arms, tools, each, look)
    return row(s, e, gap, w, path, zd, xd, T, modes, arms, tools, excess, each, look)


@overload(any_row, inline="never")
def _(s, e, gap, w, path, zd, xd, T, modes, arms, tools, excess, each, look):
    def along_a_line(s, e, gap, w, path, zd, xd, T, modes, arms, tools, excess, each, look):
        return one_row(rub_line, None, s, e, gap, w, path, zd, xd, T, modes, arms, tools, excess, each, look)

    def in_the_plane(s, e, gap, w, path, zd, xd, T, modes, arms, tools, excess, each, look):
        return row_in_plane(s, e, gap, w, path, zd, xd, T, modes, arms, tools, each, look)

    return in_the_plane if isinstance(e.dtype, Complex) else along_a_line


@_inline
def both(a, b):
    """The answer of two rows together."""
    force = a.area + b.area, a.moment + b.moment, a.end + b.end
    stick = a.stuck + b.stuck, a.stuck_moment + b.stuck_moment, a.sticking + b.sticking, a.back + b.back
    normal = a.normal_area + b.normal_area, a.normal_moment + b.normal_moment, a.normal_end + b.normal_end
    return Answer(*force, *stick, *normal, a.pressed + b.pressed)


@_call
def as_they_are(path, sticking, back, T, arms, tools, excess, zd, xd):
    """The force over a step in which every spring keeps the mode that it had at the end of the last one, less that of
    full slip forward. A spring that sticks bears L[e] - L[s] more, one that slips back -2 L[s]. As L is linear and the
    same for all, they are together one spring, with the state `excess`, which is used up.

    sticking, back: shares of the springs, as of `row` for the last step; the others are those of `row` for this step.
    Answers area, moment and force at the end.
    """
    h, part = tools.times.h, sticking + 2.0 * back
    p, q = sticking * path.x_1 - part * path.z_1, sticking * path.x_2 - part * path.z_2
    end = excess[0, 0] + h * (p + q * h) + T * (sticking * xd - part * zd)
    area, moment = hold(excess, 0, p, q, h, STEP, T, tools, arms)
    if arms is not None:
        for j in range(arms.rho.size):
            end += arms.rho[j] * excess[1 + j, 0]
    return area, moment, end
