"""Compilation by numba. The compiled code is kept on disk for the next process, wherever a folder can be written.

What takes long in this process is said on standard error. Most often another one compiles, see `tiers.py`.
"""

# mypy: disallow-untyped-calls=false
from __future__ import annotations

import gc
import pickle
import time
import warnings
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from hashlib import sha256
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
    """What numba keeps of one function: a file for each set of types, which begins with what it is of.

    numba itself names files in an index: one of older sources, or of other types, answers where two processes write at
    once, or a disk is full. What cannot be read, as after a type was renamed, counts as not there; what cannot be
    written is not kept.
    """

    def save(self, key: Any, data: Any) -> None:
        """Keep code, if it can be."""
        with suppress(OSError), self._open_for_write(self._path(key)) as file:
            file.write(self._dump(self._of(key)) + self._dump(data))

    def load(self, key: Any) -> Any:
        """Code that is kept, or None."""
        with suppress(Exception), open(self._path(key), "rb") as file:  # unpickling may raise any
            return pickle.load(file) if pickle.load(file) == self._of(key) else None

    def holds(self, key: Any) -> bool:
        """Whether code is kept."""
        with suppress(Exception), open(self._path(key), "rb") as file:
            return bool(pickle.load(file) == self._of(key))
        return False

    def _of(self, key: Any) -> Any:
        return self._version, self._source_stamp, key

    def _path(self, key: Any) -> str:
        number = int(sha256(repr(key).encode()).hexdigest()[:12], 16)
        return str(self._data_path(self._data_name(number)))


class _Cache(FunctionCache):
    """numba's cache of one function, fresh as long as no compiled source of this package changes.

    numba by itself looks at the file of the function alone, and not at those of the functions that it calls.
    """

    _cache_file: _Files

    def __init__(self, function: Function) -> None:
        super().__init__(function)
        stamp = (self._impl.locator.get_source_stamp(), _STAMP)
        self._cache_file = _Files(self._cache_path, self._impl.filename_base, stamp)

    def holds(self, signature: Any, context: Any) -> bool:
        """Whether code for these types is on disk."""
        return self._cache_file.holds(self._index_key(signature, context.codegen()))


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
        self.line = Ticker("compiling, once on this machine for each kind of run, functions", clock=time.monotonic)
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
