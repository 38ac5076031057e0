"""Compilation by numba. The compiled code is kept on disk for the next process, wherever a folder can be written."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

from numba import njit

Function = Callable[..., Any]


def compiled(**options: Any) -> Callable[[Function], Function]:
    """Decorator: numba's njit with these options.

    What it compiles is kept beside the source, or else in the cache folder of the user, or in NUMBA_CACHE_DIR. Where
    none of them can be written to, as in some containers and on some nodes of clusters, every process compiles for
    itself, and a warning says so.
    """

    def wrap(function: Function) -> Function:
        ready: Function
        try:
            ready = njit(cache=True, **options)(function)
        except RuntimeError:  # "no locator available"
            warnings.warn(
                "compiled kernels cannot be kept, as no folder for them can be written to: every process compiles its "
                "own, which takes half a minute; let NUMBA_CACHE_DIR name a folder that can"
            )
            ready = njit(**options)(function)
        return ready

    return wrap
