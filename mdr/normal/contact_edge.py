"""The edge of the contact of elastic and Kelvin springs under any periodic depth.

A spring of gap c (the depth of its foot below the mean surface position, in the unit of the depth) has the compression
s(phase) = sup over theta >= 0 of (z - c)(phase - theta) exp(-theta/T), T = omega tau, and presses where the supremum is
that of theta = 0. So the edge stands at

    c(phase) = inf over theta of chord(phase - theta, phase),
    chord(off, phase) = z(phase) + [z(phase) - z(off)]/[exp((phase - off)/T) - 1].

With r = exp(phase/T) this chord is the slope, in the plane of r and r z, of the line between two points of the motion,
and R = z + T z' is that of its tangent. The edge retreats along R, or it advances along the line from the present
point that touches the past motion, at the phase `off` at which the spring at the edge had left. From the greatest z on,
where every spring that ever touches presses, this is followed event by event:

* R turns up: the advance begins. Springs that left in this last retreat touch again, the last one first;
* all springs that left in a retreat have touched again: those of the retreat before follow;
* R falls below the edge: the next retreat begins. It does so once at most while R falls, and never while R rises.

Between two events the edge is smooth and monotone, and each event is the only root between two turns of R. T = 0 is the
limit c = z. kelvin_edges.py has the closed form of one cosine.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from mdr.case.depth_cycle import Cycle, roots, turns
from mdr.tools.arrays import Array

NEAR = 1e-9  #: of a phase `off`, in which a chord is stationary


@dataclass(frozen=True)
class Piece:
    """A stretch of the period in which the edge is smooth and monotone."""

    begin: float  #: phase
    end: float
    low: float = np.nan  #: of an advance: first phase at which its springs may have left
    high: float = np.nan  #: and the last one


class ContactEdge:
    """The edge for one depth and one T: pieces that cover a period from the greatest depth on, which is piece 0."""

    def __init__(self, T: float, orders: Array, Z: NDArray[np.complex128]) -> None:
        self.T, self.orders, self.Z = T, orders, Z
        self.pieces = self._in_pieces()
        self.begins = np.array([piece.begin for piece in self.pieces])
        self._advances: list[int] = [k for k, piece in enumerate(self.pieces) if not np.isnan(piece.low)]
        share = np.sin(np.linspace(0, np.pi / 2, 65)) ** 2
        self._tables = {}
        for k in self._advances:
            one = self.pieces[k]
            phase = one.begin + (one.end - one.begin) * share
            self._tables[k] = phase, self._tangent(phase, one.low, one.high)[1]
        ends = self.gap(np.append(self.begins, self.pieces[-1].end)).tolist()
        self.ends = list(zip(ends[:-1], ends[1:], strict=True))  #: gaps at both ends of the pieces

    @classmethod
    def of(cls, cycle: Cycle, T: float) -> ContactEdge:
        """The edge under a depth."""
        harmonics = cycle.harmonics
        orders = np.flatnonzero(harmonics)
        return _edge(T, tuple((orders + 1).tolist()), tuple(harmonics[orders].tolist()))

    def gap(self, phase: Array) -> Array:
        """Gap of the spring at the edge, at phases of any shape."""
        at = self._within(np.asarray(phase, dtype=float))
        out = np.asarray(self._R(at)[0])
        which = np.searchsorted(self.begins, at, side="right") - 1
        for k in self._advances:
            here, one = which == k, self.pieces[k]
            out[here] = self._tangent(at[here], one.low, one.high, np.interp(at[here], *self._tables[k]))[0]
        return out

    def crossings(self, gap: float) -> tuple[list[float], list[float]]:
        """Phases at which the spring of a gap touches, and at which it leaves."""
        touches, leaves = [], []
        for one, (first, last) in zip(self.pieces, self.ends, strict=True):
            if first < gap <= last:
                touches.append(self._touch(gap, one))
            elif last <= gap < first:
                leaves.append(self._passes(gap, one.begin, one.end, -1))
        return touches, leaves

    def _touch(self, gap: float, one: Piece) -> float:
        if np.isnan(one.low):
            return self._passes(gap, one.begin, one.end, 1)
        off = np.array(self._passes(gap, one.low, one.high, -1))

        def ahead(phase: Array) -> tuple[Array, Array]:
            chord, rate = self._chord(off, phase)
            return chord - gap, (self._R(phase)[0] - chord) * (rate + 1 / self.T)

        return float(roots(ahead, one.begin, one.end))

    def _passes(self, gap: float, low: float, high: float, side: int) -> float:
        """Where R, monotone between two phases, rises (side 1) or falls through a gap."""

        def past(phase: Array) -> tuple[Array, Array]:
            R, rate = self._R(phase)
            return side * (R - gap), side * rate

        return float(roots(past, low, high))

    def _within(self, phase: Array) -> Array:
        first = self.begins[0]
        return first + np.mod(phase - first, 2 * np.pi)

    def _R(self, phase: Array) -> tuple[Array, Array]:
        """z + T z' and its rate."""
        turn = self.Z * np.exp(1j * np.multiply.outer(phase, self.orders))
        lag = self.orders * self.T
        return (turn.real - lag * turn.imag).sum(-1), -(self.orders * (turn.imag + lag * turn.real)).sum(-1)

    def _chord(self, off: Array, phase: Array) -> tuple[Array, Array]:
        """chord(off, phase) and 1/T over exp((phase - off)/T) - 1."""
        flight = np.maximum(phase - off, 1e-30)
        half = np.multiply.outer(0.5 * flight, self.orders)
        middle = self.Z * np.exp(1j * (np.multiply.outer(phase, self.orders) - half))
        rise = -2 * (np.sin(half) * middle.imag).sum(-1)
        z = (self.Z * np.exp(1j * np.multiply.outer(phase, self.orders))).real.sum(-1)
        with np.errstate(over="ignore"):
            left = 1 / np.expm1(flight / self.T)
        return z + rise * left, left / self.T

    def _tangent(self, phase: Array, low: float, high: float, guess: Array | None = None) -> tuple[Array, Array]:
        """Least chord to each phase from a retreat between low and high, and where it begins."""

        def beyond(off: Array) -> tuple[Array, Array]:
            chord, rate = self._chord(off, phase)
            R, slope = self._R(off)
            return chord - R, (chord - R) * rate - slope

        low, high = np.full(phase.shape, low), np.full(phase.shape, high)
        off = roots(beyond, low, high, guess, NEAR)
        return self._chord(off, phase)[0], off

    def _in_pieces(self) -> list[Piece]:
        harmonics = np.zeros(int(self.orders.max(initial=1)), dtype=complex)
        harmonics[self.orders.astype(int) - 1] = self.Z
        tops = turns(harmonics)
        if not tops.size:
            return [Piece(0.0, 2 * np.pi)]
        z = (self.Z * np.exp(1j * np.multiply.outer(tops, self.orders))).real.sum(-1)
        first = float(tops[np.argmax(z)])
        n = np.arange(1, harmonics.size + 1)
        ends = first + np.mod(turns(harmonics * (1 + 1j * n * self.T)) - first, 2 * np.pi)
        ends = np.append(np.sort(ends[ends > first]), first + 2 * np.pi)
        if self.T == 0:
            ends[:-1][ends[:-1] > first + 2 * np.pi - 1e-12] = 0
            return [Piece(low, high) for low, high in zip([first, *ends], ends, strict=False)]
        return self._events(first, ends)

    def _events(self, at: float, ends: Array) -> list[Piece]:
        """From the greatest depth at phase `at`, and the turns of R behind it, the last of `ends` one period later."""
        pieces, left = [Piece(at, float(ends[0]))], [(at, float(ends[0]))]
        at, R = left[0][1], self._R(ends)[0]
        for k in range(1, ends.size):
            end = stop = float(ends[k])
            falls = R[k] < R[k - 1] and k + 1 < ends.size
            again = falls and R[k] < self._tangent(ends[k], *left[-1])[0]
            while True:
                low, high = left[-1]
                if again:
                    stop = float(roots(lambda phase, arc=(low, high): self._under(phase, *arc), max(at, ends[k - 1]), end))
                if len(left) == 1 or self._chord(np.array(low), np.array(stop))[0] <= self._R(np.array(low))[0]:
                    break
                caught_up = self._touch(float(self._R(np.array(low))[0]), Piece(at, stop, low, low))
                pieces.append(Piece(at, caught_up, low, high))
                left.pop()
                at = caught_up
                again = falls and R[k] < self._tangent(ends[k], *left[-1])[0]
            if again:
                pieces += [Piece(at, stop, low, high), Piece(stop, end)]
                left[-1:] = [(low, float(self._tangent(np.array(stop), low, high)[1])), (stop, end)]
                at = end
        return [*pieces, Piece(at, float(ends[-1]), *left[-1])] if at < ends[-1] else pieces

    def _under(self, phase: Array, low: float, high: float) -> tuple[Array, Array]:
        """How far R is below the advancing edge, and the rate of that."""
        chord, off = self._tangent(phase, low, high)
        R, slope = self._R(phase)
        return chord - R, (R - chord) * (self._chord(off, phase)[1] + 1 / self.T) - slope


@lru_cache(maxsize=64)
def _edge(T: float, orders: tuple[int, ...], Z: tuple[complex, ...]) -> ContactEdge:
    return ContactEdge(T, np.array(orders, dtype=float), np.array(Z, dtype=complex))
