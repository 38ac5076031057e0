"""What the march uses of numba; without it stand-ins, with which the same functions go on in Python.

Closed forms do not feel it. Runs are some hundred times slower, which `tell_if_missing` says once.

MDR_COMPILE says when functions are compiled:

- beside (or nothing): by another process, while they run as Python; by this one where no other can. See `tiers.py`.
- first: before they are called.
- never: as if numba were missing, but nothing is told.
"""

from __future__ import annotations

import os
import warnings
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

LACK = ""  #: why numba cannot be imported
MODES = ("beside", "first", "never")
MODE = os.environ.get("MDR_COMPILE") or MODES[0]
if MODE not in MODES:
    raise ValueError(f"MDR_COMPILE must be one of {', '.join(MODES)}, got {MODE!r}")

try:
    if MODE == "never":
        raise ImportError
    from numba import njit, types
    from numba.core import event
    from numba.core.caching import FunctionCache, IndexDataCacheFile
    from numba.core.types import Complex, NoneType
    from numba.experimental import function_type  # noqa: F401, teaches numba what a WrapperAddressProtocol is
    from numba.extending import overload, register_jitable
except (ImportError, OSError) as fault:  # or a library that it loads
    LACK = str(fault)
    if not TYPE_CHECKING:

        def register_jitable(function: Any) -> Any:
            """The function itself."""
            return function

        def overload(*_: Any, **__: Any) -> Any:
            """Decorator that leaves a function as it is."""
            return register_jitable

        njit = overload

        class _Type:
            """Of a signature, which nobody reads."""

            args = ()

            def __getitem__(self, _: Any) -> Any:
                return self

            def __call__(self, *_: Any) -> Any:
                return self

        types = SimpleNamespace(
            **dict.fromkeys(("boolean", "float64", "int64", "FunctionType", "none"), _Type()),
            WrapperAddressProtocol=object,
        )
        event = SimpleNamespace(Listener=object, register=lambda *_: None)
        FunctionCache = IndexDataCacheFile = Complex = NoneType = object

__all__ = [
    "LACK", "MODE", "Complex", "FunctionCache", "IndexDataCacheFile", "NoneType", "event", "njit", "overload",
    "register_jitable", "tell_if_missing", "types",
]  # fmt: skip


def tell_if_missing() -> None:
    """Warn of a run without numba."""
    if LACK:
        warnings.warn(f"numba cannot be imported ({LACK}): runs go on in Python, some hundred times slower")
