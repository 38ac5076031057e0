"""The compiled march: springs and body step by step, period by period.

Scaled form (dimensionless.py): time is omega t, normal lengths are in du_z, tangential ones in mu_0 kappa du_z,
stiffnesses in that of the array. Displacements, extensions and tangential forces are real numbers where all moves
along the pull, and complex ones, along and across it, where something moves across it too. A state are extensions
(1 + J, n) of the springs and their arms, and the body (body.py). The compressions go beside it, as friction has no part
in them.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.march.dynamics.body import RATE, U
from mdr.march.dynamics.body_step import Here, Last, follow, later, note, stepped
from mdr.march.dynamics.broyden import ROOM
from mdr.spring.contact import Look
from mdr.spring.copies import copy
from mdr.spring.energies import SHEAR_WORK, nodes_of
from mdr.spring.limit import limit_in, limit_later, step_over
from mdr.spring.path import FAST, LENT, OWN, Path, along
from mdr.spring.row import row
from mdr.spring.times import new_tools, tools_of
from mdr.tools.arrays import Array
from mdr.tools.jit import compiled, inner

_jit = compiled(nogil=True, error_model="numpy", fastmath=FAST)
_inner = inner(error_model="numpy", fastmath=FAST, **OWN)
FASTER = 1e9  #: velocity of a pull that no spring outruns

_inline = inner(forceinline=True, error_model="numpy", fastmath=FAST, **LENT)


class Motion(NamedTuple):
    """Motion of the indenter over one period of n_t steps, without the body."""

    z: Array  #: (n_t + 1,) normal motion
    z_dot: Array  #: (n_t + 1,) its rate
    v: float  #: steady velocity of the pull
    x: Array  #: (n_t + 1,) displacement by a shake, in the plane
    x_dot: Array  #: (n_t + 1,) its rate


class FullSlipForce(NamedTuple):
    """The force of the springs over each of the n_t steps of a period, if they all slip forward: bodies with mass
    follow its moment, light ones the force at the end.
    """

    area: Array  #: (n_t,)
    moment: Array  #: (n_t,) about the start of the step
    end: Array  #: (n_t,) force at its end


class Trace(NamedTuple):
    """Record of each step of a march, numbers or vectors."""

    area: Array  #: (n_steps,) of the tangential force
    moment: Array  #: (n_steps,) of it
    u: Array  #: (n_steps,) motion of the body relative to the pull, at the end of the step
    rate: Array  #: (n_steps,) its rate there
    #: (n_steps, 2, 3) length, x_1, x_2 of the top in two parts; if the first has no length, no more is set
    parts: Array


class Seen(NamedTuple):
    """Record that a close look at a period fills, of n_t steps and n springs; f and e are vectors in the plane."""

    sums: Array  #: (N_SUMS,)
    F: Array  #: (n_t, 4) at the end of each step: force along and normal, least slip velocity, force across
    mode: Array  #: (n_t or 0, n) of each spring
    f: Array  #: (n_t or 0, n) its force over its stiffness
    f_z: Array  #: (n_t or 0, n)
    e: Array  #: (n_t or 0, n)
    s: Array  #: (n_t or 0, n)


@_inline
def path_of(motion, k, h):
    """The parabolas of step k, without the body."""
    z, zd, x, xd = motion.z, motion.z_dot, motion.x, motion.x_dot
    z_2, x_2 = (zd[k + 1] - zd[k]) / (2.0 * h), (xd[k + 1] - xd[k]) / (2.0 * h)
    z_1, x_1 = (z[k + 1] - z[k]) / h - z_2 * h, motion.v + (x[k + 1] - x[k]) / h - x_2 * h
    return Path(z[k], z_1, z_2, x_1, x_2)


@_inner
def march(e, s, of_body, body, side, springs, limits, slip, flight, motion, law, tools, n_steps, trace):
    """March n_steps from the begin of a period; e, s (1 + J, n) and of_body (N_BODY,) are updated in place.

    body, side: Body along the pull and across it; along a line side is None. limits: of friction (limit.py). slip: the
    FullSlipForce of a body along a line, else None; flight (n_t,): of a light one there, time to the first touch in a
    step that begins without contact, else zero. What is None is compiled away. trace: filled.
    Returns whether every step was solved for.
    """
    h, n_t, solved, last = tools.times.h, motion.z.size - 1, True, Last(0.0, 0.0)
    # in the plane, where there is no lumped state, room for `correct`: one more array costs a fifth of a step on a line
    lumped = np.zeros((s.shape[0], 1) if side is None else (4 + ROOM, 4))
    room = np.empty_like(e), np.empty_like(s), lumped
    for j in range(n_steps):
        k = j % n_t
        trace.parts[j, 0, 0] = 0.0  # one part, unless `follow` cuts the step
        if k == 0:  # as if in full slip, so that no state depends on how many periods are marched at once
            last = Last(0.0, 0.0)
            lumped[:] = 0.0
        rates = motion.z_dot[k + 1], motion.v + motion.x_dot[k + 1]
        here = Here(path_of(motion, k, h), limit_in(limits, k), *rates, motion.v, 0.0, 0.0, 0.0)
        if slip is not None:
            here = Here(*here[:5], slip.area[k], slip.moment[k], slip.end[k])
        if flight is not None:
            area, moment, last, found = follow(
                e, s, room, of_body, last, body, springs, here, slip, flight, flight[k], law, tools, j, trace
            )
        else:
            path, area, moment, last, found = stepped(
                e, s, room, of_body, last, body, side, springs, here, slip, flight, law, tools
            )
            note(trace, j, 1, h, path)
        step_over(limits)
        solved = solved and found
        trace.area[j], trace.moment[j], trace.u[j], trace.rate[j] = area, moment, of_body[U], of_body[RATE]
    return solved


@_jit
def full_slip(e, s, springs, limits, z, z_dot, law, sums):
    """A period of springs that a pull drags which is faster than any of them: e, s (1 + J, n) are updated, sums
    (3, n_t) filled with area, moment and end of the force of each step.
    """
    h, (T, modes, arms) = 2.0 * np.pi / (z.size - 1), law
    # lumped is unused here; it is passed to reuse the compiled variant
    tools, lumped = new_tools(h, modes, arms, 0.0, springs.gap.size), np.zeros((s.shape[0], 1))
    for k in range(z.size - 1):
        z_2 = (z_dot[k + 1] - z_dot[k]) / (2.0 * h)
        path = Path(z[k], (z[k + 1] - z[k]) / h - z_2 * h, z_2, FASTER, 0.0)
        now = limit_in(limits, k)
        of = row(s, e, springs, now, path, z_dot[k + 1], FASTER, T, modes, arms, tools, lumped, None, None)
        sums[0, k], sums[1, k], sums[2, k] = of.area, of.moment, of.end


@_jit
def look(e, s, springs, limits, motion, law, trace, seen):
    """A close look at a period that was marched from e, s (1 + J, n), which are updated, and left this trace."""
    T, modes, arms = law
    h, n, kept = 2.0 * np.pi / (motion.z.size - 1), springs.gap.size, seen.mode.shape[0]
    tools, nodes_of_step = new_tools(h, modes, arms, 0.0 * e[0, 0], n), nodes_of(h, modes, arms)
    mode, f_z, f, F = np.empty(n), np.empty(n), np.empty_like(e[0]), np.empty(4)
    for k in range(motion.z.size - 1):
        path, limit = path_of(motion, k, h), limit_in(limits, k)
        for part in range(2):
            t, x_1, x_2 = trace.parts[k, part, 0].real, trace.parts[k, part, 1], trace.parts[k, part, 2]
            if t == 0.0:
                continue
            now, nodes, here = tools, nodes_of_step, Path(path.z_0, path.z_1, path.z_2, x_1, x_2)
            if t < h:
                now, nodes = tools_of(t, modes, arms, tools), nodes_of(t, modes, arms)
            path = later(here, t)
            zd, xd = path.z_1, path.x_1
            if part == 1:
                zd, xd = motion.z_dot[k + 1], motion.v + motion.x_dot[k + 1] + trace.rate[k]
            into = Look(nodes, seen.sums, F, mode, f, f_z)
            of = row(s, e, springs, limit, here, zd, xd, T, modes, arms, now, None, None, into)
            limit = limit_later(limit, t)
            step_over(limits)
            seen.sums[SHEAR_WORK] += along(x_1, of.area) + 2.0 * along(x_2, of.moment)
        copy(F, seen.F[k])
        if kept > 0:
            for one, out in ((mode, seen.mode), (f_z, seen.f_z), (s[0], seen.s)):
                copy(one, out[k])
            for one, out in ((f, seen.f), (e[0], seen.e)):
                copy(one, out[k])
