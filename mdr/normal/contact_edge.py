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
limit c = z.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from mdr.case.depth_cycle import Cycle, harmonic_sum, roots, turns
from mdr.tools.arrays import SAME, Array


@dataclass(frozen=True)
class Piece:
    """A stretch of the period in which the edge is smooth and monotone."""

    begin: float  #: phase
    end: float
    low: float = np.nan  #: of an advance: first phase at which its springs may have left
    high: float = np.nan  #: and the last one


class ContactEdge:
    """The edge for one depth and one T: pieces that cover a period, from the greatest depth on."""

    def __init__(self, T: float, orders: Array, Z: NDArray[np.complex128]) -> None:
        self.T, self._n, self._Z = T, orders, Z
        self.pieces = self._in_pieces()
        self.begins = np.array([piece.begin for piece in self.pieces])
        self._offs: dict[int, tuple[Array, Array]] = {}  # phases in an advance and, to begin with, where springs left
        share = np.sin(np.linspace(0, np.pi / 2, 65)) ** 2
        for k, one in enumerate(self.pieces):
            if not np.isnan(one.low):
                phase = one.begin + (one.end - one.begin) * share
                self._offs[k] = phase, self._tangent(phase, one.low, one.high)[1]
        self._gaps = list(pairwise(self.gap(np.append(self.begins, self.pieces[-1].end)).tolist()))

    @classmethod
    def of(cls, cycle: Cycle, T: float) -> ContactEdge:
        """The edge under a depth."""
        harmonics = cycle.harmonics
        used = np.flatnonzero(harmonics)
        return edge_under(T, tuple((used + 1).tolist()), tuple(harmonics[used].tolist()))

    def gap(self, phase: Array) -> Array:
        """Gap of the spring at the edge, at phases of any shape."""
        phase = self.begins[0] + np.mod(phase - self.begins[0], 2 * np.pi)
        gap = np.asarray(self._R(phase)[0])
        which = np.searchsorted(self.begins, phase, side="right") - 1
        for k, table in self._offs.items():
            here = which == k
            at = phase[here]
            gap[here] = self._tangent(at, self.pieces[k].low, self.pieces[k].high, np.interp(at, *table))[0]
        return gap

    def crossings(self, gap: float) -> tuple[list[float], list[float]]:
        """Phases at which the spring of a gap touches, and at which it leaves; one that just comes to zero stays."""
        touches, leaves = [], []
        for one, (first, last) in zip(self.pieces, self._gaps, strict=True):
            if first < gap <= last:
                touches.append(self._touch(gap, one))
            elif last < gap <= first:
                leaves.append(self._passes(gap, one.begin, one.end, -1))
        return touches, leaves

    def _touch(self, gap: float, one: Piece) -> float:
        """Where the spring of a gap touches within a piece."""
        if np.isnan(one.low):
            return self._passes(gap, one.begin, one.end, 1)
        off = np.array(self._passes(gap, one.low, one.high, -1))

        def ahead(phase: Array) -> tuple[Array, Array]:
            chord, left = self._chord(off, phase)
            return chord - gap, (self._R(phase)[0] - chord) * (left + 1 / self.T)

        return float(roots(ahead, one.begin, one.end))

    def _passes(self, gap: float, low: float, high: float, side: int) -> float:
        """Where R, monotone between two phases, rises (side 1) or falls (-1) through a gap."""

        def past(phase: Array) -> tuple[Array, Array]:
            R, rate = self._R(phase)
            return side * (R - gap), side * rate

        return float(roots(past, low, high))

    def _R(self, phase: Array) -> tuple[Array, Array]:
        """z + T z' and its rate."""
        turn = self._Z * np.exp(1j * np.multiply.outer(phase, self._n))
        lag = self._n * self.T
        return (turn.real - lag * turn.imag).sum(-1), -(self._n * (turn.imag + lag * turn.real)).sum(-1)

    def _chord(self, off: Array, phase: Array) -> tuple[Array, Array]:
        """chord(off, phase), and 1/T over exp((phase - off)/T) - 1."""
        flight = np.maximum(phase - off, 1e-30)
        half = np.multiply.outer(0.5 * flight, self._n)
        turn = np.multiply.outer(phase, self._n)
        rise = -2 * (np.sin(half) * (self._Z * np.exp(1j * (turn - half))).imag).sum(-1)  # no digits are cancelled
        with np.errstate(over="ignore"):
            left = 1 / np.expm1(flight / self.T)
        return (self._Z * np.exp(1j * turn)).real.sum(-1) + rise * left, left / self.T

    def _tangent(self, phase: Array, low: float, high: float, guess: Array | None = None) -> tuple[Array, Array]:
        """Least chord to each phase from a retreat between low and high, and where it begins."""

        def beyond(off: Array) -> tuple[Array, Array]:
            chord, left = self._chord(off, phase)
            R, rate = self._R(off)
            return chord - R, (chord - R) * left - rate

        off = roots(beyond, np.full(phase.shape, low), np.full(phase.shape, high), guess, SAME)
        return self._chord(off, phase)[0], off

    def _in_pieces(self) -> list[Piece]:
        harmonics = np.zeros(int(self._n.max(initial=1)), dtype=complex)
        harmonics[self._n.astype(int) - 1] = self._Z
        tops = turns(harmonics)
        if not tops.size:
            return [Piece(0.0, 2 * np.pi)]
        first = float(tops[np.argmax(harmonic_sum(harmonics, tops))])
        of_R = harmonics * (1 + 1j * self.T * np.arange(1, harmonics.size + 1))
        ends = first + np.mod(turns(of_R) - first, 2 * np.pi)
        ends = np.append(np.sort(ends[ends > first]), first + 2 * np.pi)
        if self.T == 0:
            return [Piece(low, high) for low, high in pairwise([first, *ends.tolist()])]
        return self._events(first, ends)

    def _events(self, at: float, ends: Array) -> list[Piece]:
        """Pieces from the greatest depth on, at phase `at`. ends: the turns of R behind it, and that of the period."""
        R = self._R(ends)[0]
        retreats = [(at, float(ends[0]))]  # those whose springs are still free, and the part of each
        pieces, at = [Piece(*retreats[0])], float(ends[0])
        for k in range(1, ends.size):
            end = float(ends[k])
            while True:
                low, high = retreats[-1]
                leaves = R[k] < R[k - 1] and k + 1 < ends.size and R[k] < self._tangent(ends[k], low, high)[0]
                stop = self._leaves(max(at, float(ends[k - 1])), end, low, high) if leaves else end
                first_left = float(self._R(np.array(low))[0])
                if len(retreats) == 1 or self._chord(np.array(low), np.array(stop))[0] <= first_left:
                    break
                retreats.pop()  # the spring that left first touches before `stop`
                pieces.append(Piece(at, self._touch(first_left, Piece(at, stop, low, low)), low, high))
                at = pieces[-1].end
            if leaves:
                retreats[-1] = low, float(self._tangent(np.array(stop), low, high)[1])
                retreats.append((stop, end))
                pieces += [Piece(at, stop, low, high), Piece(stop, end)]
                at = end
        return [*pieces, Piece(at, float(ends[-1]), *retreats[-1])]

    def _leaves(self, begin: float, end: float, low: float, high: float) -> float:
        """Where R, which falls from begin to end, falls below the advancing edge."""

        def below(phase: Array) -> tuple[Array, Array]:
            edge, off = self._tangent(phase, low, high)
            R, rate = self._R(phase)
            return edge - R, (R - edge) * (self._chord(off, phase)[1] + 1 / self.T) - rate

        return float(roots(below, begin, end))


@lru_cache(maxsize=64)
def edge_under(T: float, orders: tuple[int, ...], Z: tuple[complex, ...]) -> ContactEdge:
    """The edge under these harmonics of the depth."""
    return ContactEdge(T, np.array(orders, dtype=float), np.array(Z, dtype=complex))
