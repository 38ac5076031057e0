"""The step of a row of springs with friction, `row`: along a line, or in the plane where e is complex. Lengths are
scaled so that Coulomb's law has no coefficient. Without friction it is `press` (contact.py). Without arms and a look,
under Coulomb's limit, springs that do one thing for all of the step go first (whole.py), then the others (contact.py).

springs: Springs. limit: of friction in the step (limit.py). s, e (1 + J, n), updated: row 0 is compression and
extension, row j the stretch of arm j. zd, xd: rates of the top at the end of the step. tools: of the step and of so
many springs (times.py). lumped, along a line: None, or a state (1 + J, 1) for `as_they_are`, filled with the sum of
w (e - s) of springs that stick at the end, and of -2 w s of those that slip back. each: None or Each. look: None or
Look. Out comes an Answer.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import Any

import numpy as np

from mdr.spring.contact import Answer, one_row
from mdr.spring.disc import rub_disc
from mdr.spring.line import rub_line
from mdr.spring.motion import end_force, hold
from mdr.spring.path import FAST, LENT
from mdr.spring.times import ALONE, STEP
from mdr.spring.whole import whole_in_plane, whole_on_line
from mdr.tools.compiler import Complex, NoneType, overload
from mdr.tools.jit import inner
from mdr.tools.linked import LINKED

_inline = inner(forceinline=True, error_model="numpy", fastmath=FAST, **LENT)
# inlined by LLVM: a call copies every array descriptor, which costs as much as the step
_LENT: Any = {"forceinline": True, "error_model": "numpy", "fastmath": FAST, **LENT, **LINKED}
_lent = inner(error_model="numpy", fastmath=FAST, **LENT)


def row(s, e, springs, limit, path, zd, xd, T, modes, arms, tools, lumped, each, look):
    """The step; a compiled function calls it."""
    lean = arms is None and look is None and limit is None
    of = _row(np.iscomplexobj(e), lean, lean and each is None)
    return of(s, e, springs, limit, path, zd, xd, T, modes, arms, tools, lumped, each, look)


@overload(row, inline="never", jit_options=_LENT)
def _(s, e, springs, limit, path, zd, xd, T, modes, arms, tools, lumped, each, look):
    lean = all(isinstance(one, NoneType) for one in (arms, look, limit))
    return _row(isinstance(e.dtype, Complex), lean, lean and isinstance(each, NoneType))


def _row(in_plane, lean_in_plane, lean):
    """The function for a kind of row; lean: whether springs that do one thing for all of the step go first."""
    if in_plane:
        return _in_plane_lean if lean_in_plane else _in_plane
    return _on_line_lean if lean else _on_line


def _on_line(s, e, springs, limit, path, zd, xd, T, modes, arms, tools, lumped, each, look):
    if lumped is not None:
        lumped[:] = 0.0
    return one_row(rub_line, None, s, e, springs, limit, path, (zd, xd), T, modes, arms, tools, lumped, each, look)


def _on_line_lean(s, e, springs, limit, path, zd, xd, T, modes, arms, tools, lumped, each, look):
    if lumped is not None:
        lumped[:] = 0.0
    gap, w, made = springs.gap, springs.w, tools.room.whole
    require_room(made, gap)
    of = whole_on_line(s[0], e[0], gap, w, path, zd, xd, tools.times.h, T, modes, lumped, made)
    rest = one_row(rub_line, made, s, e, springs, limit, path, (zd, xd), T, modes, arms, tools, lumped, each, look)
    return both(of, rest)


def _in_plane(s, e, springs, limit, path, zd, xd, T, modes, arms, tools, lumped, each, look):
    return one_row(rub_disc, None, s, e, springs, limit, path, (zd, xd), T, modes, arms, tools, None, each, look)


def _in_plane_lean(s, e, springs, limit, path, zd, xd, T, modes, arms, tools, lumped, each, look):
    gap, w, made = springs.gap, springs.w, tools.room.whole
    require_room(made, gap)
    of = whole_in_plane(s[0], e[0], gap, w, path, zd, xd, tools.times.h, T, modes, each, made)
    for i in range(gap.size):
        whole = made[4 * i + 3]
        if whole != 0.0:
            s[0, i], e[0, i] = made[4 * i], complex(made[4 * i + 1], made[4 * i + 2])
        made[i] = whole
    rest = one_row(rub_disc, made, s, e, springs, limit, path, (zd, xd), T, modes, arms, tools, None, each, look)
    return both(of, rest)


@_inline
def require_room(made, gap):
    """Refuse tools of a row of fewer springs."""
    if made.size < 4 * gap.size:
        raise ValueError("the tools are of a row of fewer springs")


@_inline
def both(a, b):
    """The answer of two rows together."""
    force = a.area + b.area, a.moment + b.moment, a.end + b.end
    stick = a.stuck + b.stuck, a.stuck_moment + b.stuck_moment, a.sticking + b.sticking, a.back + b.back
    normal = a.normal_area + b.normal_area, a.normal_moment + b.normal_moment, a.normal_end + b.normal_end
    return Answer(*force, *stick, *normal, a.pressed + b.pressed)


@_lent
def as_they_are(path, last, T, arms, tools, lumped, zd, xd):
    """The force over a step in which every spring keeps the mode that it had at the end of the last one, less that of
    full slip forward. A spring that sticks bears L[e] - L[s] more, one that slips back -2 L[s]. As L is linear and the
    same for all, they are together one spring, with the state `lumped`, which is used up.

    last: has the shares of the springs that stuck and slipped back, as of `row` for the last step; the others are those
    of `row` for this step.
    Answers area, moment and force at the end.
    """
    h, sticking, part = tools.times.h, last.sticking, last.sticking + 2.0 * last.back
    p, q = sticking * path.x_1 - part * path.z_1, sticking * path.x_2 - part * path.z_2
    area, moment = hold(lumped, ALONE, p, q, h, STEP, T, tools, arms)
    return area, moment, end_force(lumped, ALONE, sticking * xd - part * zd, T, arms)
