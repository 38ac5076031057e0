"""Compilation by numba. The compiled code is kept on disk for the next process, wherever a folder can be written.

What takes long is said on standard error: the first run of a kind on a machine waits for it, 5 to 20 s on one core.
"""

# mypy: disallow-untyped-calls=false
from __future__ import annotations

import gc
import os
import time
import warnings
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from typing import Any

from mdr.tools import sources
from mdr.tools.compiler import FunctionCache, IndexDataCacheFile, event, njit
from mdr.tools.compiling import TALLY
from mdr.tools.linked import LINKED
from mdr.tools.progress import PATIENCE, Ticker
from mdr.tools.tiers import code_for

Function = Callable[..., Any]

_njit: Any = njit  # its types do not name all of its options

_STAMP = sources.hash_of(sources.compiled())


class _Files(IndexDataCacheFile):
    """What numba keeps of one function. What cannot be read, as after a type was renamed, counts as not there; what
    cannot be written, as on a full disk, is not kept.
    """

    def save(self, key: Any, data: Any) -> None:
        """Keep code, if it can be."""
        with suppress(OSError):
            super().save(key, data)

    def _load_index(self) -> Any:
        try:
            return super()._load_index()
        except OSError:
            raise
        except Exception:  # unpickling may raise any
            return {}

    def _load_data(self, name: str) -> Any:
        try:
            return super()._load_data(name)
        except Exception as fault:
            raise FileNotFoundError(name) from fault


class _Cache(FunctionCache):
    """numba's cache of one function, fresh as long as no compiled source of this package changes.

    numba by itself looks at the file of the function alone, and not at those of the functions that it calls.
    """

    def __init__(self, function: Function) -> None:
        super().__init__(function)
        stamp = (self._impl.locator.get_source_stamp(), _STAMP)
        self._cache_file = _Files(self._cache_path, self._impl.filename_base, stamp)

    def holds(self, signature: Any, context: Any) -> bool:
        """Whether code for these types is on disk."""
        try:
            name = self._cache_file._load_index().get(self._index_key(signature, context.codegen()))
        except OSError:
            return False
        return name is not None and os.path.exists(self._cache_file._data_path(name))


def inner(**options: Any) -> Callable[[Function], Function]:
    """Decorator of a function that compiled ones alone may call. Its code is made and kept with those that call it."""
    decorator: Callable[[Function], Function] = _njit(
        no_cpython_wrapper=True, no_cfunc_wrapper=True, **LINKED, **options
    )
    return decorator


def compiled(**options: Any) -> Callable[[Function], Function]:
    """Decorator: numba's njit with these options.

    What it compiles is kept beside the source, or else in the cache folder of the user, or in NUMBA_CACHE_DIR, until
    a compiled file of this package changes, or a file that one of them imports. Where none of the folders can be
    written to, as in some containers and on some nodes of clusters, every process compiles for itself, and a warning
    says so.
    """

    def wrap(function: Function) -> Any:
        ready = _njit(**{"no_cfunc_wrapper": True, **options})(function)
        if ready is function:  # NUMBA_DISABLE_JIT
            return function
        try:
            ready._cache = _Cache(function)
        except RuntimeError:  # "no locator available"
            warnings.warn(
                "compiled kernels cannot be kept, as no folder for them can be written to: every process compiles its "
                "own, which takes 5 to 20 s of one core; let NUMBA_CACHE_DIR name a folder that can"
            )
        ready._compile_for_args = partial(code_for, ready)
        return ready

    return wrap


class Compiling(event.Listener):
    """Counts what is compiled of this package, and says on standard error how many functions, if it takes long.

    It puts off Python's search for cycles of objects meanwhile: numba makes very many that live as long, and a seventh
    of its time went into the search.
    """

    def __init__(self) -> None:
        self.line = Ticker("compiling, once on this machine for each kind of run, functions")
        self.searched = False

    def on_start(self, event: Any) -> None:
        """A function begins to be compiled, perhaps within another."""
        if _own(event):
            if not TALLY.open:
                self.line.next = max(self.line.next, time.monotonic() + PATIENCE)
                self.searched = gc.isenabled()
                gc.disable()
            TALLY.begin()

    def on_end(self, event: Any) -> None:
        """It is compiled, or was refused."""
        if _own(event):
            TALLY.end()
            if self.searched and not TALLY.open:
                gc.enable()
            if TALLY.is_told:
                self.line.tick()


def _own(event: Any) -> bool:
    return str(event.data["dispatcher"].py_func.__module__).startswith("mdr.")


event.register("numba:compile", Compiling())
