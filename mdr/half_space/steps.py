"""A rigid indenter pressed and pulled over the half-space step by step, every cell with its own history.

Depth and position in the plane, x along the pull and y across, are given at the instants of the steps. In each step the
pressure, under the tractions, and the tractions, under the pressure, take turns until the forces no longer change. A
Kelvin material is u + tau u' in the place of u, with u' over the step: as implicit as the rest, of first order in the
step.

Friction that turns is of first order as well, as traction takes the direction of slip over the whole step. An elastic
contact that moves across is therefore first taken to the middle of a step; the displacement there, extrapolated to the
end, is what sticking would ask for at the end, and where traction exceeds its limit cells slip the rest: second order.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mdr.case.friction import Friction
from mdr.half_space.influence import HalfSpace, X, Y, Z
from mdr.half_space.normal import NotConverged, pressure
from mdr.half_space.tangential import stiffness_of, traction
from mdr.tools.arrays import EXACT, Array

RIM = (np.pi - 1 + np.log(2)) / 24  #: of a cell's area, for a side at the edge of contact (Yastrebov et al. 2017)


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
    """An indenter of shape f (n, n) [m] at the centres of the cells of a half-space, its friction, relaxation time."""

    half_space: HalfSpace
    shape: Array
    friction: Friction
    tau: float = 0.0
    tolerance: float = 1e-6  #: to which forces change no more
    turns: int = 60  #: of pressure and friction in a step, at most
    transverse: bool = True  #: False: tractions and slip along the pull only, as springs have them
    turning: bool = False  #: True: two stages in a step, of second order where friction turns; tau must be 0

    def limit(self, pressure: Array) -> Array:
        """The greatest traction along the surface [Pa] in cells of this pressure, (n, n).

        A shear strength acts on the area of contact, of which cells have too much: each side of a cell at an edge that
        is free to move takes the part RIM of it away. An edge of the shape is where its cells end. Where it acts on
        less, on a disc, cells at its edge have the share of them that is within.
        """
        borne: Array = self.friction.mu_0 * pressure
        if not self.friction.needs_area:
            return borne
        touches = pressure > 0
        bound = np.pad(touches | np.isinf(self.shape), 1).astype(float)
        sides = 4 - bound[2:, 1:-1] - bound[:-2, 1:-1] - bound[1:-1, 2:] - bound[1:-1, :-2]
        share = touches * (1 - RIM * sides)
        a = self.half_space.h * np.sqrt(share.sum() / np.pi)
        if (strong := float(self.friction.strong_radius(a))) < a:
            share = np.minimum(share, np.clip((strong - self.half_space.radii) / self.half_space.h + 0.5, 0.0, 1.0))
        return np.asarray(borne + self.friction.tau_0 * share)

    def full_slip(self, depth: float, way: float = 1.0) -> Step:
        """The state at rest at this depth with all cells at their limit along x, to begin with; way: 1, or -1.

        Zero gives the state without friction. Raises NotConverged.
        """
        n = self.half_space.n
        tractions = np.zeros((3, n, n))

        def slipping(tractions: Array, _: float) -> Array:
            return np.stack([way * self.limit(tractions[Z]), np.zeros((n, n))])

        if self._take_turns(tractions, depth - self.shape, slipping, self.tolerance * 1e-2):
            raise NotConverged(
                f"full slip at a depth of {depth:g} m is not found in {self.turns} turns: start from rest"
            )
        u = self.half_space.displacement(tractions)
        return Step(tractions, u, np.zeros((2, n, n)))

    def forces(self, tractions: Array) -> Array:
        """F_x, F_y, F_z [N]."""
        total: Array = np.sum(tractions, axis=(1, 2)) * self.half_space.h**2
        return total

    def march(self, start: Step, depth: Array, way: Array, dt: float) -> Iterator[Step]:
        """One step after the other: depth (n_steps + 1,) and way (2, n_steps + 1) [m] at the instants, from `start` on.

        From the second step on the tractions are looked for where the last two lead to.
        """
        state, before = start, start
        for i in range(1, len(depth)):
            guess, moved = 2 * state.tractions - before.tractions, way[:, i] - way[:, i - 1]
            if self.turning:
                end = self._two_stages(state, float(depth[i - 1] + depth[i]) / 2, float(depth[i]), moved, guess)
            else:
                end = self.step(state, float(depth[i]), moved, dt, guess)
            state, before = end, state
            yield state

    def _two_stages(self, state: Step, halfway: float, depth: float, moved: Array, guess: Array) -> Step:
        """The state after a step, by that in its middle at the depth `halfway`; time plays no part."""
        # ten tolerances at the middle of a step are far within the error of the step
        middle = self.step(state, halfway, moved / 2, 1.0, (state.tractions + guess) / 2, 10 * self.tolerance)
        onward = replace(middle, displacement=2 * middle.displacement - state.displacement)
        end = self.step(onward, depth, np.zeros(2), 1.0, 2 * middle.tractions - state.tractions)
        slip = moved[:, None, None] - (end.displacement - state.displacement)[:2]
        return replace(end, slip=np.where(end.pressure > 0, slip, 0.0))

    def step(
        self,
        state: Step,
        depth: float,
        moved: Array,
        dt: float,
        guess: Array | None = None,
        tolerance: float | None = None,
    ) -> Step:
        """The state after one step in which the indenter moves by `moved` (2,) [m]. Raises NotConverged.

        guess: tractions (3, n, n) from which on those at the end of the step are looked for; None takes the first ones.
        tolerance: in the place of that of the contact.
        """
        theta, moved = self.tau / dt, np.asarray(moved)[:, None, None]
        before = state.displacement
        tractions = (state.tractions if guess is None else guess).copy()
        down = (1 + theta) * (depth - self.shape) - theta * before[Z]  # what C p must be where it touches
        stick = before[:2] + (1 + theta) * moved  # what C q must be where it sticks
        slips = self._at_limit(state.tractions)

        def sticking_or_not(tractions: Array, fine: float) -> Array:
            nonlocal slips
            asked = stick - self.half_space.displacement(tractions[Z:], (X, Y), (Z,))
            if not self.transverse:
                asked[Y] = 0.0
            bound, q = self.limit(tractions[Z]), tractions[:2]
            start = np.where(slips, _on_rims(q, bound), q)  # what slips does so under another pressure too
            found = traction(self._tangential, asked, bound, start, fine, stiff=self._stiff)
            slips = self._at_limit(np.stack([*found, tractions[Z]]))
            return found

        if change := self._take_turns(tractions, down, sticking_or_not, tolerance or self.tolerance):
            raise NotConverged(
                f"pressure and friction still change the forces by {change:.1e} after {self.turns} turns: take "
                "more steps"
            )
        u = (self.half_space.displacement(tractions) + theta * before) / (1 + theta)
        slip = np.where(tractions[Z] > 0, moved - (u - before)[:2], 0.0)
        return Step(tractions, u, slip)

    def _take_turns(
        self, tractions: Array, down: Array, friction: Callable[[Array, float], Array], tolerance: float
    ) -> float:
        """Pressure and friction in turns, written into the tractions, until forces change by less than the tolerance.

        Early turns are as fine as what the next one will change is large. They end at once where neither knows of the
        other. Returns 0, or by what share forces still change after all turns.
        """
        last, finest = self.forces(tractions), max(tolerance, self.tolerance) * 1e-2
        # the first turn of a step is solved coarsely: the next ones correct it
        fine = 1e-4 if self.half_space.beta else finest
        for _ in range(self.turns):
            gap = down - self.half_space.displacement(tractions[:2], (Z,), (X, Y))[0]
            tractions[Z] = pressure(self._normal, gap, tractions[Z], fine)
            tractions[:2] = friction(tractions, fine)
            if not self.half_space.beta:
                return 0.0
            forces = self.forces(tractions)
            change, scale = np.max(np.abs(forces - last)), np.max(np.abs(forces))
            if change <= tolerance * scale and fine <= finest:
                return 0.0
            fine = max(finest, min(fine, 1e-2 * change / scale if scale else 0.0))
            last = forces
        return float(change / scale)

    def _at_limit(self, tractions: Array) -> NDArray[np.bool_]:
        """Which cells slip, (n, n), but for rounding."""
        size = np.hypot(*tractions[:2])
        limit: NDArray[np.bool_] = (size > 0) & (size >= (1 - EXACT) * self.limit(tractions[Z]))
        return limit

    # --- products ---

    @cached_property
    def _stiff(self) -> float:
        return stiffness_of(self._tangential, np.zeros((2, self.half_space.n, self.half_space.n)))

    def _normal(self, p: Array) -> Array:
        u_z: Array = self.half_space.displacement(p[None], (Z,), (Z,))[0]
        return u_z

    def _tangential(self, q: Array) -> Array:
        u = self.half_space.displacement(q, (X, Y), (X, Y))
        if not self.transverse:
            u[Y] = 0.0
        return u


def _on_rims(q: Array, bound: Array) -> Array:
    """Tractions (2, n, n) of the same directions at their bound (n, n)."""
    size = np.hypot(*q)
    return q * (bound / np.where(size > 0, size, 1.0))
