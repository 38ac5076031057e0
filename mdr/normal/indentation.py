"""Normal contact alone: depth and force of an indenter on a half-space with memory, for any history of either.

Each spring is an independent element (Popov and Heß 2015) that carries the line load

    q = L[s] = E* (s + tau s') + sum_j q_j >= 0,    q_j' = E*_j s' - q_j/tau_j,

E*_j, tau_j the Maxwell arms. In contact s = u_z - g(x). A spring is released where q has fallen to 0 - for a body with
memory while it is still compressed -, relaxes with q = 0, and is touched again by the indenter where that reaches the
*relaxed* surface. F_z = 2 ∫ q dx.

While the contact grows this is the half-space of Lee and Radok (1960); for the first retreat it is that of Ting
(1966): the springs touched at t_1 and released at t obey ∫_{t_1}^t E*(t - s) u_z'(s) ds = 0, which is Ting's equation
for a(t) = a(t_1), and what the springs inside carry is his force. More generally the springs satisfy every condition
of the half-space, which their displacement s(x) and load q(x) stand for by Abel's transform at any instant, as long as
those in contact fill a disc and p(r) from their loads (`mdr.surface_fields`) is nowhere tensile.

Between samples the history is linear in time, and so the step of a spring (mdr/spring/contact.py) is exact for one of
depth; of a history of force the depth is found in steps finer than the samples. Springs stand at nodes of the depth g
and their loads are continued between them (indentation_kernels.py), so that an elastic force has no error of the number
of springs.

Symbols (SI): t time [s], u_z depth [m], F_z normal force [N], x position [m], q line load of one side [N/m], s
compression of a spring [m].
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.indenters.base import Indenter
from mdr.materials import Material
from mdr.normal.indentation_kernels import Row, force_of, step
from mdr.normal.load_control import static_depths
from mdr.spring.law import N_PHI, Law, law_of, phi_of
from mdr.tools.arrays import EPS, EXACT, SAME, Array
from mdr.tools.checks import count, finite_array, instance, truth
from mdr.tools.messages import short
from mdr.tools.records import ArrayRecord
from mdr.tools.summary import Summarised, Summary, number, span

STEPS = 1200  #: of a history of force, at least; then as many again, twice as fine


@dataclass(frozen=True, eq=False, repr=False)
class Indentation(Summarised, ArrayRecord):
    """Outcome of indent(), in SI. The springs are kept only with `record=True`; otherwise x, s and q_z are None."""

    indenter: Indenter  #: shape
    material: Material  #: half-space
    t: Array  #: (n_t,) instants [s]
    u_z: Array  #: (n_t,) depth [m]
    F_z: Array  #: (n_t,) normal force [N]
    contact_radius: Array  #: (n_t,) [m]
    x: Array | None = None  #: (n_springs,) positions [m]
    s: Array | None = None  #: (n_t, n_springs) compressions, of free springs that of the relaxed surface [m]
    q_z: Array | None = None  #: (n_t, n_springs) line loads [N/m]

    def _summary(self) -> Summary:
        kept = "none; indent(..., record=True) keeps them" if self.x is None else f"{self.x.size} at every instant"
        return Summary(
            f"Indentation of {short(repr(self.indenter))} at {self.t.size} instants",
            [
                ("material", short(repr(self.material)), ""),
                ("t", span(self.t, "s"), ""),
                ("depth", span(self.u_z, "m"), f"at the end {number(self.u_z[-1], 'm')}"),
                ("F_z", span(self.F_z, "N"), f"at the end {number(self.F_z[-1], 'N')}"),
                ("a", span(self.contact_radius, "m"), f"at the end {number(self.contact_radius[-1], 'm')}"),
                ("springs", kept, ""),
            ],
        )


def indent(
    indenter: Indenter,
    material: Material,
    t: ArrayLike,
    u_z: ArrayLike | None = None,
    *,
    F_z: ArrayLike | None = None,
    n_springs: int = 512,
    record: bool = False,
) -> Indentation:
    """Normal force [N], or depth [m], of an indenter pressed on a half-space by any history of the other.

    The half-space is relaxed at the start. Between samples the given history is linear in time.

    Parameters
    ----------
    indenter : Indenter
        The shape.
    material : Material
        The half-space.
    t : array_like of float, shape (n_t,)
        Instants [s], ascending, in steps of any size. Two samples at one instant are a jump; the second one is the
        state just after it. A first value other than zero is a jump too.
    u_z : array_like of float, shape (n_t,), optional
        History of depth [m]; below zero the indenter is above the surface. Give either u_z or F_z.
    F_z : array_like of float, shape (n_t,), optional
        History of normal force [N], zero or above: there is no adhesion.
    n_springs : int
        Nodes at x >= 0; an elastic force is exact with any number.
    record : bool
        Keep the compressions and loads of the springs at every sample.

    Returns
    -------
    Indentation
        Depth, force and contact radius at the instants, arrays of shape (n_t,).

    Raises
    ------
    TypeError
        For a wrong kind of input.
    ValueError
        For NaN, infinity, lists of different lengths, instants that descend, a negative force, both or neither of u_z
        and F_z, a shape that ends before the depth, or a hollow one.

    Notes
    -----
    While the contact grows this is the half-space of Lee and Radok (1960), in the first retreat that of Ting (1966).

    With a dashpot (tau > 0) the force follows the velocity, which jumps at a sample. The force given there is the mean
    of both sides. For samples of a smooth history its error falls with the square of their distance. At a jump of depth
    the impulse of force is left out; a jump of force changes no depth at that instant. Under F_z = 0 the indenter lies
    on the surface without pressing it, at the greatest depth where this is possible.

    Examples
    --------
    >>> import mdr
    >>> pressed = mdr.indent(mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5), t=[0, 1, 2], u_z=[0, 20e-6, 10e-6])
    >>> pressed.F_z.round(4)
    array([0.    , 0.0337, 0.0119])
    """
    instance("indenter", indenter, Indenter)
    instance("material", material, Material)
    if indenter.least_depth > 0:
        raise ValueError(
            f"annular contact: pressed from rest, {indenter!r} touches by its rim first, and only from the depth "
            f"{indenter.least_depth:.6g} m on by its whole face; indent() takes shapes whose contact is always a disc"
        )
    n_springs = count("n_springs", n_springs, 16)
    truth("record", record)
    if (u_z is None) == (F_z is None):
        raise ValueError("give either u_z, a history of depth, or F_z, one of force, and not both")
    t = _instants(t)
    if u_z is not None:
        return _from_depth(indenter, material, t, _history("u_z", u_z, t, "m"), n_springs, record)
    F_z = _history("F_z", F_z, t, "N")
    if np.any(F_z < 0):
        raise ValueError(
            f"F_z must not be negative, got {F_z.min():.6g} N: an indenter without adhesion cannot be pulled"
        )
    return _from_force(indenter, material, t, F_z, n_springs, record)


# --- a history ------------------------------------------------------------------------------------


def _from_depth(indenter: Indenter, material: Material, t: Array, u_z: Array, n: int, record: bool) -> Indentation:
    deepest = float(u_z.max())
    if not deepest > 0:
        return _untouched(indenter, material, t, u_z, record)
    indenter.contact_radius(deepest)  # a shape that does not reach so deep says so here
    springs = _Springs.of(indenter, material, deepest, np.clip(u_z[u_z > 0].min() / deepest, 1e-2, 0.1), n)
    u, dt = (u_z / deepest).tolist(), np.diff(t, prepend=t[0]).tolist()
    s, was, answers, seen = springs.at_rest, 0.0, [], []
    for k in range(t.size):
        s = springs.moved(s, was, u[k], dt[k])
        sides = [(u[j] - u[j - 1]) / dt[j] for j in (k, k + 1) if j < t.size and dt[j] > 0]
        sides = sides if sides and material.tau > 0 else [0.0]  # only a dashpot feels the velocity
        answers.append(np.mean([springs.force(s, u[k], v) for v in sides], axis=0))
        was = u[k]
        if record:
            seen.append((s, u[k], sum(sides) / len(sides)))
    F_z, a = np.transpose(answers)
    return Indentation(indenter, material, t, u_z, F_z, a, **springs.kept(seen))


def _from_force(indenter: Indenter, material: Material, t: Array, F_z: Array, n: int, record: bool) -> Indentation:
    most = F_z.max(keepdims=True)
    if not most > 0:
        return _untouched(indenter, material, t, F_z, record)
    compliance = float(material.creep_compliance(t[-1] - t[0])) or 1 / material.E_star  # a dashpot takes no jump
    try:
        reach = float(static_depths(indenter, 1 / compliance, most)[0])
    except ValueError:  # more than the whole shape carries, if the load lasts
        reach = float(indenter.profile_1d(indenter.max_radius))
    start = 0.0
    if material.tau == 0:
        start = float(static_depths(indenter, material.instantaneous_modulus, F_z[F_z > 0][:1])[0])
    springs = _Springs.of(indenter, material, reach, np.clip(start / reach, 1e-3, 0.1), n)
    n_steps = int(np.clip(np.ceil(STEPS / t.size), 1, 64))
    answers = []
    for share in (1, 2):
        fine, force, where = _finer(t, F_z, share * n_steps)
        known = _grown(indenter, _lee_radok(material, fine, force), float(most[0]))
        u, a, seen = _depths(springs, fine, force, known / reach, where if record else where[:0])
        answers.append((reach * u[where], a[where]))
    u_z, a = (2 * two - one for one, two in zip(*answers, strict=True))  # a step errs with dt
    grown = where < known.size
    u_z[grown] = known[where[grown]]
    indenter.contact_radius(u_z.max())  # a shape that does not reach so deep says so here
    return Indentation(indenter, material, t, u_z, F_z, np.maximum(a, 0), **springs.kept(seen))


def _lee_radok(material: Material, t: Array, F_z: Array) -> Array:
    """V = ∫ J(t - s) dF_z [m²]: the F_N/E* of an elastic contact of the same radius, while the contact grows."""
    start, rates, times = material._retardation()
    shares = np.zeros((t.size, times.size))
    for k, dt in enumerate(np.diff(t)):
        phi = np.reshape([phi_of(dt / time) for time in times], (times.size, N_PHI))
        shares[k + 1] = shares[k] * phi[:, 0] + dt * (F_z[k] * phi[:, 1] + (F_z[k + 1] - F_z[k]) * phi[:, 2])
    return np.asarray(start * F_z + shares @ rates)


def _grown(indenter: Indenter, V: Array, most: float) -> Array:
    """Depths [m] at the first instants, while the contact grows, under loads of up to `most` [N]."""
    shrinks = np.diff(V) < -EXACT * V.max()
    V = np.maximum.accumulate(V[: int(np.argmax(shrinks)) + 1 if shrinks.any() else V.size])
    depths = np.zeros(V.size)
    if V[-1] > 0:
        E = most / V[-1]
        depths[V > 0] = static_depths(indenter, E, E * V[V > 0])
    return depths


def _depths(
    springs: _Springs, t: Array, F_z: Array, known: Array, record: NDArray[np.intp]
) -> tuple[Array, Array, list[tuple[Array, float, float]]]:
    """Depth and contact radius under a force, and what springs.kept() takes, of the instants on record.

    known: the depths at the first instants, while the contact has only grown.
    """
    T, off = springs.law.T, EXACT * float(F_z.max())
    depth, radius, seen = np.zeros(t.size), np.zeros(t.size), []
    s, u, a, v, before = springs.at_rest, 0.0, 0.0, 0.0, 0.0
    for k, (dt, F) in enumerate(zip(np.diff(t, prepend=t[0]).tolist(), F_z.tolist(), strict=True)):
        was = u
        if F == before == 0 and k >= known.size:
            s, u = springs.lifted(s, dt)
        elif dt > 0 or T == 0:
            u = float(known[k]) if k < known.size else springs.depth_under(max(F, 10 * off), off, s, u, v, a, dt)
            s = springs.moved(s, was, u, dt)
            if F == 0 and k >= known.size:
                s, u = springs.lifted(s, 0.0)
        v = (u - was) / dt if dt > 0 else v
        a = springs.force(s, u, v)[1] if F > 0 else 0.0
        depth[k], radius[k], before = u, a, F
        if k in record:
            rate = springs.rate_under(F, off, s, u, v, a) if F > 0 and T > 0 else 0.0
            seen.append((s, u if F > 0 else -np.inf, rate))
    return depth, radius, seen


def _root(rising: Callable[[float], float], x: float, slope: float, off: float) -> float:
    """Where a rising function is zero, but for `off`: by secants from x on, within the bracket that they leave."""
    low, high, value = -np.inf, np.inf, rising(x)
    for turn in range(400):
        low, high = (low, x) if value > 0 else (x, high)
        trial = x - value / slope
        if abs(value) <= off or min(abs(trial - x), high - low) <= 4 * EPS * abs(x):
            break
        if not low < trial < high or (turn % 5 == 4 and high - low < np.inf):
            trial = 0.5 * (low + high)
        last, value = value, rising(trial)
        rise = (value - last) / (trial - x)
        x, slope = trial, rise if rise > 0 else slope / 4  # flat where nothing touches: go further
    return x


# --- the springs ----------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Springs:
    """A row of springs; depths in `unit`. Their state (1 + J, n), compressions and arms, is passed on."""

    row: Row
    law: Law
    unit: float  #: of depths [m]
    modulus: float  #: of a spring, times this unit [N/m]

    @classmethod
    def of(cls, indenter: Indenter, material: Material, deepest: float, finest: float, n: int) -> _Springs:
        """Springs up to the depth `deepest` [m]. A body that flows has a long-time modulus that no sum feels."""
        modulus, arms = material.E_star or EPS**2 * material.instantaneous_modulus, material.contact_arms
        law = law_of(material.tau, tuple(E_j / modulus for E_j, _ in arms), tuple(tau_j for _, tau_j in arms))
        return cls(_row(indenter, deepest, finest, n), law, deepest, modulus * deepest)

    @property
    def rho(self) -> Array:
        """Moduli of the arms, (J,)."""
        return np.empty(0) if self.law.arms is None else self.law.arms.rho

    @property
    def at_rest(self) -> Array:
        """The state of a surface that was never touched."""
        return np.zeros((1 + self.rho.size, self.row.g.size))

    def moved(self, s: Array, u_0: float, u_1: float, dt: float) -> Array:
        """The springs after the indenter has moved from u_0 to u_1 in a time; at once in no time."""
        s, g = s.copy(), self.row.g
        if dt == 0:
            moves = (s[0] < u_1 - g) | ((self.law.T == 0) & (s[0] <= u_0 - g))  # a dashpot does not follow back
            s[1:, moves] += (u_1 - g - s[0])[moves]
            s[0, moves] = (u_1 - g)[moves]
            step(s, g, u_1, 0.0, 0.0, self.law)  # what has no load left is free
        else:
            presses = step(s, g, u_0, (u_1 - u_0) / dt, dt, self.law) > 0
            np.copyto(s[0], u_1 - g, where=presses)
        return s

    def lifted(self, s: Array, dt: float) -> tuple[Array, float]:
        """The springs after a time without indenter, and the depth at which it lies on them then."""
        above = float(np.min(s[0] + self.row.g)) - 1.0
        s = self.moved(s, above, above, dt)
        return s, float(np.min(s[0] + self.row.g))

    def force(self, s: Array, u: float, v: float) -> tuple[float, float]:
        """Force [N] and radius [m] of the contact at the depth u, of the rate v."""
        F, a = force_of(s, u, v, self.row, self.law.T, self.law.arms)
        return self.modulus * F, a

    def depth_under(self, F: float, off: float, s: Array, u: float, v: float, a: float, dt: float) -> float:
        """Depth after a time from u at which the force is F [N]; v and a [m] are what rate and radius were before."""

        def excess(end: float) -> float:
            return self.force(self.moved(s, u, end, dt), end, (end - u) / dt if dt else 0.0)[0] - F

        stiffness = 1 + float(self.rho.sum()) + (self.law.T / dt if dt else 0.0)
        return _root(excess, u + v * dt, 2 * max(a, 1e-6 * self.row.x[-1]) * self.modulus * stiffness, off)

    def rate_under(self, F: float, off: float, s: Array, u: float, v: float, a: float) -> float:
        """Rate at which the force is F [N]: dashpots, all of one rate, take up what the rest does not carry."""
        slope = 2 * max(a, 1e-6 * self.row.x[-1]) * self.modulus * self.law.T
        return _root(lambda rate: self.force(s, u, rate)[0] - F, v, slope, off)

    def kept(self, seen: list[tuple[Array, float, float]]) -> dict[str, Array]:
        """Places, compressions and line loads of these states at depths of some rate; empty for none."""
        if not seen:
            return {}
        g, T = self.row.g, self.law.T
        loads = [np.where(s[0] <= u - g, np.maximum(s[0] + T * v + self.rho @ s[1:], 0), 0) for s, u, v in seen]
        s = np.array([s[0] for s, _, _ in seen])
        return {"x": self.row.x, "s": self.unit * s, "q_z": self.modulus * np.array(loads)}


def _row(indenter: Indenter, deepest: float, finest: float, n_springs: int) -> Row:
    """Springs up to the depth `deepest` [m], which is the unit of depths.

    Their spacing grows with g + finest; kinks of the shape are nodes, an even number of cells apart.
    """
    kinks = [radius for radius in (*indenter.kinks, indenter.max_radius) if np.isfinite(radius)]
    depths = [_profile(indenter, radius) / deepest for radius in kinks]
    core = max((x for x, g in zip(kinks, depths, strict=True) if g <= 1e-14), default=0.0)
    none = np.empty(0)
    if core >= indenter.max_radius:
        return Row(np.zeros(1), np.array([core]), none, none, none)
    top = min(1.0, depths[-1]) if np.isfinite(indenter.max_radius) else 1.0
    marks = [0.0, *(g for g in depths if SAME * top < g < top * (1 - SAME)), top]
    heights = np.log1p(np.array(marks) / finest)
    parts = [np.zeros(1)]
    for low, high in pairwise(heights):
        n = 2 * max(1, round(0.5 * n_springs * (high - low) / heights[-1]))
        parts.append(finest * np.expm1(np.linspace(low, high, n + 1)[1:]))
    g = np.concatenate(parts)
    g[-1] = top
    x = np.concatenate([[core], np.asarray(indenter.contact_radius(deepest * g[1:]))])
    rise = np.diff(np.log(np.maximum(x[1:] - core, np.finfo(float).tiny))) / np.diff(np.log(g[1:]))
    dP = np.diff(g * x - np.asarray(indenter.profile_area(x)) / deepest)
    mean, as_one = dP / np.diff(g), (dP[::2] + dP[1::2]) / (g[2::2] - g[:-2:2])
    return Row(g, x, np.append(rise[:1], rise), mean, (4 * mean - np.repeat(as_one, 2)) / 3)


def _profile(indenter: Indenter, x: float) -> float:
    """Depth g [m] at x, infinite where the shape has none."""
    try:
        g = float(indenter.profile_1d(x))
    except ValueError:
        return np.inf
    return g if np.isfinite(g) else np.inf


# --- time -----------------------------------------------------------------------------------------


def _finer(t: Array, F_z: Array, n: int) -> tuple[Array, Array, NDArray[np.intp]]:
    """Instants with n steps in each interval, fine after a jump; the force there; where the samples are among them."""
    even, jumped = np.arange(1, n + 1) / n, t[0]
    fine, force = [t[:1]], [F_z[:1]]
    for (low, high), (before, after) in zip(pairwise(t), pairwise(F_z), strict=True):
        # an interval that is long for the time since the last jump is cut finer towards its start
        share = even**3 if high - low > 0.3 * (low - jumped) else even
        if high == low:
            jumped, share = low, np.ones(1)
        fine.append(low + (high - low) * share)
        force.append(before + (after - before) * share)
    return np.concatenate(fine), np.concatenate(force), np.cumsum([steps.size for steps in fine]) - 1


# --- what comes in --------------------------------------------------------------------------------


def _instants(t: ArrayLike) -> Array:
    t = finite_array("t", t, "s")
    if t.ndim != 1 or t.size == 0:
        raise ValueError(f"t must be a list of instants, shape (n_t,), got shape {t.shape}")
    if np.any(np.diff(t) < 0):
        k = int(np.argmax(np.diff(t) < 0))
        raise ValueError(f"t must not descend, got {t[k + 1]:.6g} s after {t[k]:.6g} s: sort the samples")
    return t


def _history(name: str, values: ArrayLike | None, t: Array, unit: str) -> Array:
    history = finite_array(name, values, unit)  # type: ignore[arg-type]
    if history.shape != t.shape:
        raise ValueError(f"{name} must have one value for each of the {t.size} instants t, got shape {history.shape}")
    return history


def _untouched(indenter: Indenter, material: Material, t: Array, u_z: Array, record: bool) -> Indentation:
    """The outcome without contact: u_z never above zero, or no force."""
    zero = np.zeros(t.size)
    kept = {"x": np.zeros(1), "s": np.zeros((t.size, 1)), "q_z": np.zeros((t.size, 1))} if record else {}
    return Indentation(indenter, material, t, u_z, zero, zero, **kept)
