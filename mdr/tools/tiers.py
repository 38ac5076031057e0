"""What answers a call of a compiled function: machine code where there is some, else the function as Python.

It runs as Python at once, while another process compiles, and by machine code as soon as that is on disk. Where no
other process can (one core, a disk that takes nothing, a process that was killed) this one compiles, once its functions
have run as Python for some seconds; and where the other is late, as on a busy machine.
"""

# mypy: disallow-untyped-calls=false
from __future__ import annotations

import time
from functools import partial
from typing import Any

from mdr.tools.beside import BESIDE, Code
from mdr.tools.compiler import MODE
from mdr.tools.compiling import TALLY
from mdr.tools.plain import Left, called, is_outermost

ALONE = 2.5  #: s that functions run as Python where no other process compiles, before this one does
LATE = 25.0  #: s where one does, but is late, as on a busy machine, where it has the lower priority


def code_for(function: Any, *args: Any) -> Any:
    """Where no machine code in memory fits the arguments, numba asks here for what to call.

    An argument that is a function has its own machine code as `code`, and `numba_type`.
    """
    codes = [one.code for one in args if hasattr(one, "code")]
    types = tuple(one.numba_type if hasattr(one, "code") else function.typeof_pyval(one) for one in args)
    codes.append(Code(function, types))
    by_machine = partial(type(function)._compile_for_args, function)
    if is_due(codes):
        return by_machine(*args)
    return partial(_in_python, function, codes, by_machine)


def is_due(codes: list[Code], since: float = float("inf")) -> bool:
    """Whether machine code is to be called now; what is not there is asked for. since: when it began as Python."""
    if MODE == "first" or all(code.is_there() for code in codes):
        return True
    BESIDE.ask(codes)
    waited = TALLY.in_python + max(0.0, time.monotonic() - since)
    return waited > (LATE if BESIDE.is_alive() else ALONE)


def _in_python(function: Any, codes: list[Code], by_machine: Any, *args: Any) -> Any:
    """What the function answers as Python, or by its machine code as soon as that is due."""
    since, counts = time.monotonic(), is_outermost()
    if counts:
        TALLY.begin()
    try:
        return called(function.py_func, args, partial(is_due, codes, since))
    except Left:
        pass
    finally:
        if counts:
            TALLY.in_python += time.monotonic() - since
            TALLY.end(done=0)
    by_machine(*args)
    return function(*args)
