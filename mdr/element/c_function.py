"""The step of an element as a C function in memory, for programs that call one by its address and compile nothing.

numba's `cfunc` wraps the steps of kernels.py, which are called as they are. Pointers are passed as whole numbers.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false, disallow-untyped-decorators=false
from __future__ import annotations

from typing import Any

import numpy as np
from numba import carray, cfunc, float64, int32, intp, njit, types  # type: ignore[attr-defined]
from numba.extending import intrinsic

from mdr.element.kernels import SpringRow, steps
from mdr.spring.copies import put
from mdr.spring.law import Arms, Law, Modes
from mdr.spring.limit import Strength
from mdr.tools.arrays import SAME, Array

REFUSED, GOOD = -1, 1


@intrinsic
def pointer(typing, address):
    """A whole number as a pointer."""

    def cast(context, builder, _, args):
        return builder.inttoptr(args[0], context.get_value_type(types.voidptr))

    return types.voidptr(intp), cast


@njit
def numbers(address, shape):
    """Numbers in memory, as an array of this shape."""
    return carray(pointer(address), shape, np.float64)  # type: ignore[call-arg]


def c_function(row: SpringRow, n_state: int, u_z_max: float, mark: float) -> Any:
    """numba's cfunc of a step of these springs; the arrays of the row are used where they lie."""
    T, modes, arms = row.law
    n, units, deepest = row.gap.size, row[3:7], u_z_max * (1 + SAME)
    stick = None if row.limit is None else row.limit.stick
    gap, w = _at(row.gap), _at(row.w)
    viscous, J = modes is not None, 0 if arms is None else arms.rho.size
    K = 0 if modes is None else modes.mu.size
    of_modes = None if modes is None else tuple(map(_at, modes))
    of_arms = None if arms is None else tuple(map(_at, arms))

    @cfunc(int32(intp, intp, float64, intp, intp, intp))
    def step(state, new_state, dt, u, F, tangent):
        before, to = numbers(state, (1, n_state)), numbers(u, (1, 3))
        if not (np.isfinite(to[0, 0] + to[0, 1] + to[0, 2] + dt) and to[0, 2] <= deepest):
            return REFUSED
        if not (dt > 0.0 if viscous else dt >= 0.0):
            return REFUSED
        held = arms_of = None
        if of_modes is not None:
            held = Modes(numbers(of_modes[0], K), numbers(of_modes[1], (1 + J, K)), numbers(of_modes[2], (K, 1 + J)))
        if of_arms is not None:
            arms_of = Arms(numbers(of_arms[0], J), numbers(of_arms[1], J))
        limit = None
        if stick is not None:
            nothing = np.zeros(n)
            limit = Strength(1.0, nothing, 0.0, 0.0, 0.0, stick, nothing, nothing)
        springs = SpringRow(numbers(gap, n), numbers(w, n), Law(T, held, arms_of), *units, limit)
        after, force = before.copy(), np.empty((1, 3))
        stiff = np.empty((1 if tangent != 0 else 0, 3, 3))
        if steps(after, to.copy(), dt if viscous else 1.0, springs, mark, force, stiff) != 0:
            return REFUSED
        put(after, numbers(new_state, (1, n_state)))
        put(force, numbers(F, (1, 3)))
        if tangent != 0:
            put(stiff[0], numbers(tangent, (3, 3)))
        return GOOD

    return step


def _at(values: Array) -> int:
    return int(values.ctypes.data)
