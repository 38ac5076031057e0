"""The contact as a force element with memory, for multibody, finite-element and control programs.

A step takes a state and the position of the indenter at its end, and answers force and new state. Nothing is kept
elsewhere: a state is one array of numbers that the host copies, compares, stores and rolls back. In a step the indenter
moves on a straight line, on which the springs go by the step of the library (mdr/spring/row.py); with arms by a return
map (mdr/spring/returned.py), in parts that are as short as the force needs (cuts.py).

The work that was done on the contact is summed from the area of the force over each step, and what the springs store
is known from the state. The difference is what friction and material have turned into heat.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from hashlib import sha256
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mdr.element.cuts import MOST_PARTS
from mdr.element.kernels import BEYOND, IMPOSSIBLE, N_HEAD, NOT_FINITE, OF_ANOTHER, SpringRow, fault, steps
from mdr.indenters.base import Indenter
from mdr.materials.base import Material, refuse_other_materials
from mdr.materials.operator import Rheology
from mdr.normal.spring_grid import Depths, nodes
from mdr.normal.springs import MIN_SPRINGS
from mdr.spring.law import law_of
from mdr.spring.limit import falling
from mdr.tools.arrays import SAME, Array
from mdr.tools.checks import count, finite_array, instance, not_negative, positive, positive_or_none, real_array
from mdr.tools.compiler import tell_if_missing
from mdr.tools.fields import Record, check_fields, facts

TAKE = "take that of its at_rest() or step()"
FAULTS = {
    NOT_FINITE: f"state must be finite, got NaN or infinity: {TAKE}",
    OF_ANOTHER: f"state must be of this element, got the mark of another as its last number: {TAKE}",
    IMPOSSIBLE: "state must be possible, got a compression that the depth or u_z_max forbids, or an extension that "
    f"friction does not bear: {TAKE}",
}


def _springs(name: str, value: Any, note: str = "") -> int:
    return count(name, value, MIN_SPRINGS)


@dataclass(frozen=True)
class ContactElement(Record):
    """A contact that answers force [N] and new state for each step of a host's own motion.

    Keep the new state only when your step is accepted: a step changes nothing but what it returns.

    A state is one array: the last position u [m], the work done on the contact so far [J], then compressions s of the
    springs over u_z_max, extensions e_x and e_y over mu_0 kappa u_z_max, each with its Maxwell arms, and a mark of the
    element; see `state_names`. Where mu_s is above mu_0 each spring has its mode too, a number of `State`.

    Examples
    --------
    >>> import mdr
    >>> element = mdr.ContactElement(mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5), 0.5, u_z_max=40e-6)
    >>> state = element.at_rest(u=(0.0, 0.0, 20e-6))
    >>> F, state = element.step(state, 1e-3, (1e-6, 0.0, 20e-6))
    >>> print(F.round(5))
    [0.00166 0.      0.03373]
    """

    indenter: Indenter = field(metadata=facts("", "shape", rule=None))
    material: Material = field(metadata=facts("", "half-space, with a long-time modulus", rule=None))
    mu_0: float = field(metadata=facts("-", "local coefficient of friction", example=0.5))
    u_z_max: float = field(kw_only=True, metadata=facts("m", "greatest depth that a step may go to", example=40e-6))
    n_springs: int = field(
        kw_only=True, default=256, metadata=facts("-", "springs at x > 0, each for a pair; at least 16", _springs)
    )
    mu_s: float | None = field(
        kw_only=True, default=None, metadata=facts("-", "static coefficient; none is mu_0", positive_or_none)
    )

    def __post_init__(self) -> None:
        check_fields(self)
        instance("indenter", self.indenter, Indenter)
        instance("material", self.material, Material)
        stick_on(self.material, self.mu_s, self.mu_0, in_plane=True)
        _ = self._row  # its springs refuse what no contact can be

    @property
    def n_state(self) -> int:
        """Numbers of a state."""
        n = self._row.gap.size
        return N_HEAD + 3 * self._rows * n + (0 if self._row.limit is None else n) + 1

    @property
    def state_names(self) -> tuple[str, ...]:
        """A name for each number of a state, such as "u_x" and "e_x[17]"; of an arm "e_x_1[17]"."""
        rows = [f"{name}_{j}" if j else name for name in ("s", "e_x", "e_y") for j in range(self._rows)]
        rows += [] if self._row.limit is None else ["mode"]
        springs = (f"{name}[{i}]" for name in rows for i in range(self._row.gap.size))
        return "u_x", "u_y", "u_z", "work", *springs, "element"

    @property
    def address(self) -> int:
        """Address of a C function that makes a step of one contact, for programs that compile nothing::

            int step(const double *state, double *new_state, double dt, const double *u, double *F, double *K)

        The new state may take the place of the state. K is NULL, or takes dF_i/du_j in K[3 i + j]. Answers 1, or -1
        for what `step` refuses, with nothing written. Valid as long as this element is. The first use compiles for some
        seconds.
        """
        return int(self._c_function.address)

    def at_rest(self, u: ArrayLike = (0.0, 0.0, 0.0)) -> Array:
        """State of a contact that rests at a position, relaxed and without force in the plane.

        Parameters
        ----------
        u : array_like of float, shape (3,) or (m, 3)
            Position x, y and depth z [m]; at z <= 0 nothing touches.

        Returns
        -------
        ndarray, shape (n_state,) or (m, n_state)
            The state, or one for each position.

        Raises
        ------
        TypeError, ValueError
            For what is no position, or deeper than u_z_max.
        """
        u = self._positions(u)
        state = np.zeros((*u.shape[:-1], self.n_state))
        state[..., :3] = u
        n = self._row.gap.size
        state[..., N_HEAD : N_HEAD + n] = np.maximum(u[..., 2:] / self._row.length_z - self._row.gap, 0)
        state[..., 3], state[..., -1] = stored(self._row, state[..., N_HEAD:]), self._mark
        return state

    def step(self, state: ArrayLike, dt: float, u: ArrayLike, tangent: bool = False) -> tuple[Array, ...]:
        """Force [N] at the end of a step, and the new state; for many contacts at once too.

        The indenter moves on a straight line from the last position to u, in a step of any length. Its force is exact
        for an elastic contact in one direction. Otherwise it is that of the same way in many steps to within 1e-3 of
        mu_0 F_z: with Maxwell arms a step is cut inside into parts, until halving one changes its force by no more than
        1e-4. The force of a dashpot, tau > 0, is that of the velocity in the step. No step gains energy with arms.

        Parameters
        ----------
        state : array_like of float, shape (n_state,) or (m, n_state)
            The state at the start; it is not changed.
        dt : float
            Length of the step [s], of all contacts. Without meaning for an elastic contact, where it may be 0.
        u : array_like of float, shape (3,) or (m, 3)
            Position x, y and depth z at the end of the step [m]; at z <= 0 the contact is open.
        tangent : bool
            Whether dF/du is asked for too; it costs up to seven times as much, thirty with many arms.

        Returns
        -------
        F : ndarray, shape (3,) or (m, 3)
            F_x, F_y against the motion of the indenter, F_z that presses it into the half-space [N].
        state : ndarray, shape (n_state,) or (m, n_state)
            The state at the end of the step.
        K : ndarray, shape (3, 3) or (m, 3, 3)
            With `tangent` alone: K[i, j] = dF_i/du_j [N/m] at fixed state and dt. Not symmetric, as slip follows the
            depth. Where a spring switches (touches, leaves, sticks, slips), the derivative beyond, on the side of the
            motion; of an axis without motion on that of the friction.

        Raises
        ------
        TypeError, ValueError
            For NaN, shapes that do not fit, the state of another element, a depth beyond u_z_max, dt < 0, and dt = 0 of
            a viscous contact.

        Notes
        -----
        K is a one-sided difference of second order of the step itself, of each spring for itself and so near that it
        does not switch: its error is some 1e-8 of the stiffness. What a spring does within 2e-9 of u_z_max, or of
        mu_0 kappa u_z_max in the plane, counts as here; nearer still after a way below 1e-4 of these.
        A step with arms keeps its parts meanwhile. Where it would be cut otherwise the force jumps, by its error.

        A step is not cut while it is short beside the times of arms whose force matters, and turns by little. Else
        parts grow from the shortest of these times: ten to a hundred of them, 0.1 to 2 ms for 32 springs.

        A state is refused that is not finite, of another element (its last number is a mark of the springs), or
        impossible: compressions that the depth or u_z_max forbids, extensions that an elastic contact cannot bear.
        """
        states, us = self._states(state), self._positions(u)
        if us.shape[:-1] != states.shape[:-1]:
            raise ValueError(f"u must have the shape {(*states.shape[:-1], 3)} of this state, got {us.shape}")
        dt, h = not_negative("dt", dt, "length of a step in s"), 1.0
        if self._row.law.modes is not None:
            h = positive("dt", dt, "length of a step in s; the force of a viscous contact depends on it")
        if not isinstance(tangent, bool):
            raise TypeError(f"tangent must be True or False, got {tangent!r}")
        answer, flat = np.array(states, order="C"), np.array(us, order="C").reshape(-1, 3)
        F, K = np.empty(flat.shape), np.empty((len(flat) if tangent else 0, 3, 3))
        if wrong := steps(answer.reshape(-1, self.n_state), flat, h, self._row, self._mark, F, K):
            if wrong == BEYOND:
                what = f"force, work or springs are beyond the range of floats, or of {MOST_PARTS} parts of a step"
                raise ValueError(f"{what}: dt = {dt:g} s is too short or too long, or u too far away")
            raise ValueError(FAULTS[wrong])
        return (F.reshape(us.shape), answer, K.reshape(*us.shape, 3)) if tangent else (F.reshape(us.shape), answer)

    def stored(self, state: ArrayLike) -> Array:
        """Elastic energy [J] of the springs.

        Parameters
        ----------
        state : array_like of float, shape (n_state,) or (m, n_state)
            The state.

        Returns
        -------
        ndarray, shape () or (m,)
            The energy.

        Raises
        ------
        TypeError, ValueError
            For the state of another element.
        """
        return stored(self._row, self._checked(state)[..., N_HEAD:])

    def dissipated(self, state: ArrayLike) -> Array:
        """Energy [J] that friction and material have turned into heat since the contact was at rest.

        Parameters
        ----------
        state : array_like of float, shape (n_state,) or (m, n_state)
            The state.

        Returns
        -------
        ndarray, shape () or (m,)
            The energy: work less what is stored.

        Raises
        ------
        TypeError, ValueError
            For the state of another element.
        """
        return np.asarray(self._checked(state)[..., 3] - self.stored(state))

    @cached_property
    def _c_function(self) -> Any:
        from mdr.element.c_function import c_function

        return c_function(self._row, self.n_state, self.u_z_max, self._mark)

    def __getstate__(self) -> dict[str, Any]:  # compiled code has an address in one process alone
        return {name: value for name, value in vars(self).items() if name != "_c_function"}

    @cached_property
    def _row(self) -> SpringRow:
        stick = stick_on(self.material, self.mu_s, self.mu_0, in_plane=True)
        return springs_of(self.indenter, self.material, self.mu_0, self.u_z_max, 0.0, self.n_springs, stick)

    @cached_property
    def _mark(self) -> float:
        return mark_of(self._row)

    @property
    def _rows(self) -> int:
        return ratios_of(self._row).size

    def _states(self, state: ArrayLike) -> Array:
        states = real_array("state", state)
        if states.ndim not in (1, 2) or states.shape[-1] != self.n_state:
            what = f"state must have the shape ({self.n_state},) or (m, {self.n_state}) of this element"
            raise ValueError(f"{what}, got {states.shape}: {TAKE}")
        return states

    def _checked(self, state: ArrayLike) -> Array:
        """States of which each is one of these springs."""
        states = self._states(state)
        for one in states.reshape(-1, self.n_state):
            if wrong := fault(np.ascontiguousarray(one), self._row, self._mark):
                raise ValueError(FAULTS[wrong])
        return states

    def _positions(self, u: ArrayLike) -> Array:
        us = finite_array("u", u, "m")
        if us.ndim not in (1, 2) or us.shape[-1] != 3:
            raise ValueError(f"u must have the shape (3,) or (m, 3), x, y and depth z in m, got {us.shape}")
        deepest = float(us[..., 2].max(initial=0.0))
        if not deepest <= self.u_z_max * (1 + SAME):
            raise ValueError(f"u_z = {deepest:.6g} m is deeper than u_z_max = {self.u_z_max:.6g} m: raise u_z_max")
        return us


def stick_on(material: Material, mu_s: float | None, mu_0: float, in_plane: bool) -> float:
    """Static coefficient over mu_0; refuses one below it, and arms in the plane, where a step cuts itself in parts."""
    if mu_s is None or mu_s == mu_0:
        return 1.0
    if mu_s < mu_0:
        raise ValueError(f"mu_s = {mu_s:.6g} must not be below mu_0 = {mu_0:.6g}: raise mu_s, or leave it out")
    if in_plane and material.contact_arms:
        raise ValueError(
            "mu_s above mu_0 in the plane is for an elastic or a Kelvin material, not one with Maxwell arms, got "
            f"{type(material).__name__}: ask slide_record along x, or mdr.slide"
        )
    return mu_s / mu_0


def springs_of(
    indenter: Indenter, material: Material, mu_0: float, deepest: float, least: float, n: int, stick: float = 1.0
) -> SpringRow:
    """The springs for depths from `least` to `deepest` [m], none of which slips yet; refuses what no case takes.

    They are cut where contact is lost at the least depth, which a dashpot leaves at none. stick: static coefficient
    over mu_0.
    """
    tell_if_missing()
    refuse_other_materials(material, 1.0)
    if material.tau > 0 or not SAME * deepest < least < (1 - SAME) * deepest:
        least = 0.0
    if not material.E_star > 0:
        raise ValueError("material: E_inf = 0, so that a mean load sinks in without end: give it a long-time modulus")
    if indenter.least_depth > least:
        raise ValueError(
            f"indenter: the middle of {type(indenter).__name__} presses only from {indenter.least_depth:.6g} m on, and "
            f"here the depth may be {least:.6g} m: short of that a ring would touch, which the method leaves out"
        )
    _, gap, width, _ = nodes(indenter, Depths(0.0, deepest, least, deepest, -np.inf), n)
    gap, total = gap / deepest, float(width.sum())
    w = width / total
    if gap.max() == gap.min():  # a flat face: one spring stands for all
        gap, w = gap[:1], np.ones(1)
    rheology, length_x = Rheology.of(material, 1.0), mu_0 * material.mindlin_ratio * deepest  # in seconds
    law = law_of(rheology.T, rheology.rho, rheology.theta)
    forces = material.G_star * total * length_x, material.E_star * total * deepest
    return SpringRow(gap, w, law, length_x, deepest, *forces, falling(stick, gap.size))


def mark_of(row: SpringRow) -> float:
    """A whole number for these springs, by which their states are known: to 24 bits, those that processors agree on."""
    falls = () if row.limit is None else (row.limit.stick,)
    numbers = np.concatenate([np.ravel(one) for one in (*row[:2], row.law.T, *(row.law.arms or ()), *row[3:7], *falls)])
    parts, powers = np.frexp(numbers)
    return float(int(sha256(np.stack([np.rint(2**24 * parts), powers]).astype("<i8").tobytes()).hexdigest()[:12], 16))


def ratios_of(row: SpringRow) -> Array:
    """Moduli of a spring and its arms over the long-time one, (1 + J,)."""
    return np.ones(1) if row.law.arms is None else np.concatenate([[1.0], row.law.arms.rho])


def relaxed(row: SpringRow, depth: float) -> Array:
    """Compressions (1 + J, n) of springs and arms that rest at a scaled depth."""
    s = np.zeros((ratios_of(row).size, row.gap.size))
    s[0] = np.maximum(depth - row.gap, 0)
    return s


def stored(row: SpringRow, springs: Array) -> Array:
    """Elastic energy [J] of springs (..., 3 (1 + J) n), whatever follows them."""
    ratios = ratios_of(row)
    springs = springs[..., : 3 * ratios.size * row.gap.size]
    squares = (springs.reshape(*springs.shape[:-1], 3, ratios.size, row.gap.size) ** 2 @ row.w) @ ratios
    units = np.array([row.force_z * row.length_z, *2 * [row.force_x * row.length_x]])
    return np.asarray(0.5 * squares @ units)
