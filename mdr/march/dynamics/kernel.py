"""The march of any contact as a compiled function of plain arrays: its kernel.

A contact stands in one array of numbers, its *block*; its kind (material, pull, whether it moves in the plane) is
compiled into the kernel. All kernels have one signature. So what is built on the march, such as the search for a
periodic state, is compiled once for all kinds.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from collections.abc import Callable
from functools import cached_property, lru_cache
from typing import Any, Literal, NamedTuple

import numpy as np

from mdr.march.dynamics.body import N_BODY, Body, numbers_of
from mdr.march.dynamics.loop import FullSlipForce, Motion, Trace, march
from mdr.spring.contact import Springs
from mdr.spring.law import Arms, Law, Modes
from mdr.spring.limit import Strengths
from mdr.spring.path import FAST
from mdr.spring.times import new_tools
from mdr.tools.arrays import Array
from mdr.tools.beside import Code
from mdr.tools.compiler import NoneType, overload, register_jitable, tell_if_missing, types
from mdr.tools.jit import compiled
from mdr.tools.tiers import is_due

_ROW, _ROWS = types.float64[::1], types.float64[:, ::1]
#: block, velocity of the pull, state and compressions, updated, number of steps, flat trace; whether all was solved
SIGNATURE = types.boolean(_ROW, types.float64, _ROW, _ROWS, types.int64, _ROW)

#: places in a block, of the numbers of springs, steps, arms, modes, directions; of T of the Kelvin branch; of the body
#: along the pull
N, N_T, N_ARMS, N_MODES, N_AXES, OF_T, ALONG = range(7)
OF_BODY = 19  #: numbers of a body
ACROSS, HEAD = ALONG + OF_BODY, ALONG + 2 * OF_BODY  #: places of the body across, and of the arrays
OF_LIMITS = 4  #: arrays of the limit of friction that are no state
OF_STEP = 10  #: numbers that a flat trace has of a step

Is = Literal[True] | None


class Kind(NamedTuple):
    """Parts that a contact has, True, or lacks, None, which are compiled away."""

    modes: Is  #: of its material
    arms: Is
    slip: Is  #: a force of full slip, as it has a body on a line
    limit: Is  #: a limit of friction other than Coulomb's
    flight: Is  #: times of flight, as the body is light
    plane: Is  #: vectors for extensions


class Kernel(types.WrapperAddressProtocol):
    """The march of contacts of a kind; compiled code knows it by its address."""

    numba_type = types.FunctionType(SIGNATURE)

    def __init__(self, march: Callable[..., bool], kind: Kind | None = None) -> None:
        self.march: Any = march
        self.kind = kind
        self.code = Code(march, SIGNATURE.args)  #: that compiled callers need
        self._is_due = False

    @property
    def _numba_type_(self) -> Any:
        """As compiled functions see it: one that they can call; nothing as long as it runs as Python."""
        self._is_due = self._is_due or is_due([self.code])
        return self.numba_type if self._is_due else types.none

    def __reduce__(self) -> Any:
        """By its kind, as an address is that of a process."""
        return kernel_of, (self.kind,)

    @cached_property
    def address(self) -> int:
        """Of the compiled function."""
        self.march.compile(SIGNATURE.args)
        made = self.march.overloads[SIGNATURE.args]
        return int(made.library.get_pointer_to_function(made.fndesc.llvm_cfunc_wrapper_name))

    def __call__(self, block: Array, v: float, x: Array, s: Array, n_steps: int, trace: Array) -> bool:
        """March it; SIGNATURE."""
        return bool(self.march(block, v, x, s, n_steps, trace))

    def __wrapper_address__(self) -> int:
        return self.address

    def signature(self) -> Any:
        """Of all kernels."""
        return SIGNATURE


def block_of(
    springs: Springs,
    motion: Motion,
    law: Law,
    limits: Strengths | None,
    bodies: tuple[Body, Body],
    slip: FullSlipForce | None,
    flight: Array | None,
) -> tuple[Kernel, Array]:
    """The kernel of a contact, and its block: what `march` takes but for state, velocity and room."""
    T, modes, arms = law
    of_arms, of_modes = (0 if one is None else one[0].size for one in (arms, modes))
    plane = np.iscomplexobj(motion.x)
    sizes = springs.gap.size, motion.z.size - 1, of_arms, of_modes, 1 + plane
    arrays = [springs.gap, springs.w, motion.z, motion.z_dot, motion.x.real, motion.x_dot.real]
    arrays += [motion.x.imag, motion.x_dot.imag] if plane else []
    parts = modes, arms, slip, limits and limits[:OF_LIMITS]
    arrays += [one.ravel() for part in parts if part is not None for one in part]
    arrays += [] if flight is None else [flight]
    kind = Kind(*(None if one is None else True for one in (modes, arms, slip, limits, flight, plane or None)))
    return kernel_of(kind), np.concatenate([sizes, [T], *map(numbers_of, bodies), *arrays])


def new_trace(block: Array, n_periods: int) -> Array:
    """Room for the flat trace of so many periods."""
    return np.zeros(OF_STEP * n_periods * int(block[N_T] * block[N_AXES]))


def if_there(value, whether):
    """The value; None if contacts of this kind have no such part."""
    return None if whether is None else value


@overload(if_there)
def _(value, whether):
    if isinstance(whether, NoneType):
        return lambda value, whether: None
    return lambda value, whether: value


def as_numbers(x, plane):
    """Numbers in one array: pairs as vectors of the plane."""
    return x if plane is None else x.view(np.complex128)


@overload(as_numbers)
def _(x, plane):
    if isinstance(plane, NoneType):
        return lambda x, plane: x
    return lambda x, plane: x.view(np.complex128)


def vectors(along, across, plane):
    """Vectors of the plane of their components; numbers along a line."""
    return along if plane is None else along + 1j * across


@overload(vectors)
def _(along, across, plane):
    if isinstance(plane, NoneType):
        return lambda along, across, plane: along
    return lambda along, across, plane: along + 1j * across


@register_jitable
def taken(block, at, size):
    """An array of a block, and where the next one begins."""
    return block[at : at + size], at + size


@register_jitable
def body_at(block, at):
    """A body of a block."""
    b = block[at : at + OF_BODY]
    free, stuck = ((b[7], b[8]), (b[9], b[10])), ((b[15], b[16]), (b[17], b[18]))
    return Body(b[0] != 0.0, b[1] != 0.0, b[2], b[3], b[4], b[5], b[6], free, (b[11], b[12]), (b[13], b[14]), stuck)


@register_jitable
def trace_of(flat, n_steps, plane):
    """The Trace whose arrays a flat one holds."""
    numbers = as_numbers(flat, plane)
    area, at = taken(numbers, 0, n_steps)
    moment, at = taken(numbers, at, n_steps)
    u, at = taken(numbers, at, n_steps)
    rate, at = taken(numbers, at, n_steps)
    parts, at = taken(numbers, at, 6 * n_steps)
    return Trace(area, moment, u, rate, parts.reshape((n_steps, 2, 3)))


def __getattr__(name: str) -> Any:
    """The compiled function of a kernel by its name."""
    if not name.startswith("kernel_"):
        raise AttributeError(name)
    return kernel_of(Kind(*(True if one == "1" else None for one in name.removeprefix("kernel_")))).march


@lru_cache
def kernel_of(kind: Kind) -> Kernel:
    """The kernel of a kind."""
    tell_if_missing()
    has_modes, has_arms, has_slip, has_limit, has_flight, in_plane = kind

    def kernel(block, v, x, s, n_steps, trace):
        n_t, J, K = int(block[N_T]), int(block[N_ARMS]), int(block[N_MODES])
        gap, at = taken(block, HEAD, int(block[N]))
        w, at = taken(block, at, gap.size)
        z, at = taken(block, at, n_t + 1)
        z_dot, at = taken(block, at, n_t + 1)
        along, at = taken(block, at, n_t + 1)
        along_dot, at = taken(block, at, n_t + 1)
        across, across_dot = along, along_dot
        if in_plane is not None:
            across, at = taken(block, at, n_t + 1)
            across_dot, at = taken(block, at, n_t + 1)
        mu, at = taken(block, at, K)
        out, at = taken(block, at, (1 + J) * K)
        into, at = taken(block, at, (1 + J) * K)
        rho, at = taken(block, at, J)
        rate, at = taken(block, at, J)
        n_slip = 0 if has_slip is None else n_t
        area, at = taken(block, at, n_slip)
        moment, at = taken(block, at, n_slip)
        end, at = taken(block, at, n_slip)
        coulomb, at = taken(block, at, 1 if has_limit is not None else 0)
        x2, at = taken(block, at, gap.size if has_limit is not None else 0)
        a2, at = taken(block, at, 3 * n_t if has_limit is not None else 0)
        stick, at = taken(block, at, 1 if has_limit is not None else 0)
        moves, modes_at = taken(x, 0, (s.size + N_BODY) * int(block[N_AXES]))
        was = x[modes_at:]  # none unless friction falls
        strengths = Strengths(coulomb, x2, a2.reshape((a2.size // 3, 3)), stick, was, np.empty(was.size))
        flight, at = taken(block, at, n_t if has_flight is not None else 0)
        modes = if_there(Modes(mu, out.reshape((1 + J, K)), into.reshape((K, 1 + J))), has_modes)
        law = Law(block[OF_T], modes, if_there(Arms(rho, rate), has_arms))
        shake, shake_dot = vectors(along, across, in_plane), vectors(along_dot, across_dot, in_plane)
        motion = Motion(z, z_dot, v, shake, shake_dot)
        state = as_numbers(moves, in_plane)
        e = state[: s.size].reshape(s.shape)
        body, side = body_at(block, ALONG), if_there(body_at(block, ACROSS), in_plane)
        tools = new_tools(body.h, law.modes, law.arms, 0.0 * e[0, 0], gap.size)
        springs, limits = Springs(gap, w), if_there(strengths, has_limit)
        slip, in_flight = if_there(FullSlipForce(area, moment, end), has_slip), if_there(flight, has_flight)
        traced = trace_of(trace, n_steps, in_plane)
        of_body = state[s.size :]
        return march(e, s, of_body, body, side, springs, limits, slip, in_flight, motion, law, tools, n_steps, traced)

    # the name of its files in the cache, in which all kernels would have one
    kernel.__qualname__ = "kernel_" + "".join("0" if one is None else "1" for one in kind)
    return Kernel(compiled(nogil=True, error_model="numpy", fastmath=FAST, no_cfunc_wrapper=False)(kernel), kind)
