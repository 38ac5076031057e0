"""A rigid indenter pressed and pulled over the half-space step by step, every cell with its own history.

Depth and position x along the pull are given at the instants of the steps. In each step the pressure, under the
tractions, and the tractions, under the pressure, take turns until the forces no longer change. A Kelvin material is
u + tau u' in the place of u, with u' over the step: as implicit as the rest, of first order in the step.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from mdr.half_space.influence import HalfSpace, X, Y, Z
from mdr.half_space.normal import NotConverged, pressure
from mdr.half_space.tangential import traction
from mdr.tools.arrays import Array


@dataclass(frozen=True)
class Step:
    """What a step ended with: tractions (3, n, n) on and displacement (3, n, n) of the surface, and slip (2, n, n)."""

    tractions: Array
    displacement: Array
    slip: Array  #: of the indenter over the surface in the step; zero where there is no contact

    @property
    def pressure(self) -> Array:
        """Normal traction (n, n)."""
        p: Array = self.tractions[Z]
        return p


@dataclass(frozen=True, eq=False)
class Contact:
    """An indenter of shape f (n, n) [m] at the centres of the cells of a half-space, friction and relaxation time."""

    half_space: HalfSpace
    shape: Array
    mu_0: float
    tau: float = 0.0
    tolerance: float = 1e-6  #: to which forces change no more
    turns: int = 60  #: of pressure and friction in a step, at most
    transverse: bool = True  #: False: tractions and slip along the pull only, as springs have them

    @property
    def cell(self) -> float:
        """Area of a cell."""
        return self.half_space.h**2

    def full_slip(self, depth: float) -> Step:
        """The state at rest at this depth with all cells at their limit along x, to begin with. Raises NotConverged."""
        n = self.half_space.n
        tractions, fine = np.zeros((3, n, n)), self.tolerance * 1e-2

        def slipping(tractions: Array) -> Array:
            return np.stack([self.mu_0 * tractions[Z], np.zeros((n, n))])

        if self._take_turns(tractions, depth - self.shape, slipping, fine):
            raise NotConverged(f"full slip at a depth of {depth:g} m is not found in {self.turns} turns")
        u = self.half_space.displacement(tractions)
        return Step(tractions, u, np.zeros((2, n, n)))

    def forces(self, tractions: Array) -> Array:
        """F_x, F_y, F_z [N]."""
        total: Array = np.sum(tractions, axis=(1, 2)) * self.cell
        return total

    def march(self, start: Step, depth: Array, x: Array, dt: float) -> Iterator[Step]:
        """One step after the other: depth and x [m] at the instants, (n_steps + 1,), from that of `start` on."""
        state = start
        for i in range(1, len(depth)):
            state = self.step(state, float(depth[i]), float(x[i] - x[i - 1]), dt)
            yield state

    def step(self, state: Step, depth: float, moved: float, dt: float) -> Step:
        """The state after one step. Raises NotConverged."""
        theta = self.tau / dt
        before = state.displacement
        tractions, fine = state.tractions.copy(), self.tolerance * 1e-2
        down = (1 + theta) * (depth - self.shape) - theta * before[Z]  # what C p must be where it touches
        stick = before[:2] + (1 + theta) * np.array([moved, 0.0])[:, None, None]  # what C q must be where it sticks

        def sticking_or_not(tractions: Array) -> Array:
            asked = stick - self.half_space.displacement(tractions[Z:], (X, Y), (Z,))
            if not self.transverse:
                asked[Y] = 0.0
            return traction(self._tangential, asked, self.mu_0 * tractions[Z], tractions[:2], fine)

        if change := self._take_turns(tractions, down, sticking_or_not, self.tolerance):
            raise NotConverged(
                f"pressure and friction still change the forces by {change:.1e} after {self.turns} turns"
            )
        u = (self.half_space.displacement(tractions) + theta * before) / (1 + theta)
        slip = np.where(tractions[Z] > 0, np.array([moved, 0.0])[:, None, None] - (u - before)[:2], 0.0)
        return Step(tractions, u, slip)

    def _take_turns(self, tractions: Array, down: Array, friction: Callable[[Array], Array], tolerance: float) -> float:
        """Pressure and friction in turns, written into the tractions, until forces change by less than the tolerance.

        They end at once where neither knows of the other. Returns 0, or by what share forces still change after all
        turns.
        """
        last = np.zeros(3)
        for _ in range(self.turns):
            gap = down - self.half_space.displacement(tractions[:2], (Z,), (X, Y))[0]
            tractions[Z] = pressure(self._normal, gap, tractions[Z], self.tolerance * 1e-2)
            tractions[:2] = friction(tractions)
            if not self.half_space.beta:
                return 0.0
            forces = self.forces(tractions)
            change, scale = np.max(np.abs(forces - last)), np.max(np.abs(forces))
            if change <= tolerance * scale:
                return 0.0
            last = forces
        return float(change / scale)

    # --- products ---

    def _normal(self, p: Array) -> Array:
        u_z: Array = self.half_space.displacement(p[None], (Z,), (Z,))[0]
        return u_z

    def _tangential(self, q: Array) -> Array:
        u = self.half_space.displacement(q, (X, Y), (X, Y))
        if not self.transverse:
            u[Y] = 0.0
        return u
