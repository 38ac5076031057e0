"""Copies of arrays, in loops: numba's assignment of an array to a slice compiles the writing of an error message too,
which takes seconds.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from mdr.spring.path import FAST, LENT
from mdr.tools.jit import inner

_inline = inner(forceinline=True, error_model="numpy", fastmath=FAST, **LENT)


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
