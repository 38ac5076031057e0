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

Between samples the history is linear in time. In one of depth nothing else is approximated in time; of a history of
force the depth is found in steps finer than the samples. Springs stand at nodes of the depth g and their loads are
continued between them (indentation_kernels.py), so that an elastic force has no error of the number of springs.

Symbols (SI): t time [s], u_z depth [m], F_z normal force [N], x position [m], q line load of one side [N/m], s
compression of a spring [m].
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.indenters.base import Indenter
from mdr.materials import Material
from mdr.normal import indentation_kernels as kernels
from mdr.tools.arrays import Array
from mdr.tools.checks import count, finite_array, instance
from mdr.tools.messages import short
from mdr.tools.records import ArrayRecord
from mdr.tools.summary import Summarised, Summary, number, span

N_SPRINGS = 512
STEPS = 1200  #: of a history of force, at least; then as many again, twice as fine
LONG = 0.3  #: an interval longer than this share of the time since the last jump is cut finer towards its start


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
    n_springs: int | None = None,
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
    n_springs : int, optional
        Nodes at x >= 0. None: 512.
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
    n_springs = N_SPRINGS if n_springs is None else count("n_springs", n_springs, 16)
    if not isinstance(record, bool):
        raise TypeError(f"record must be True or False, got {record!r}")
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


def _from_depth(indenter: Indenter, material: Material, t: Array, u_z: Array, n: int, record: bool) -> Indentation:
    deepest = float(u_z.max())
    if not deepest > 0:
        return _untouched(indenter, material, t, u_z, n, record)
    indenter.contact_radius(deepest)  # a shape that does not reach so deep says so here
    first = u_z[u_z > 0]
    row = _row(indenter, deepest, float(np.clip(first.min() / deepest, 1e-2, 0.1)), n)
    F_z, a, s, q = kernels.follow_depth(t, u_z, row, _material_arrays(material), record)
    kept = {"x": row[1], "s": s, "q_z": q} if record else {}
    return Indentation(indenter, material, t, u_z, F_z, a, **kept)


def _from_force(indenter: Indenter, material: Material, t: Array, F_z: Array, n: int, record: bool) -> Indentation:
    most = float(F_z.max())
    if not most > 0:
        return _untouched(indenter, material, t, F_z, n, record)
    end = _end_of(indenter)
    reach = min(_depth_under(indenter, most * float(material.creep_compliance(t[-1] - t[0])), end), end)
    loaded = F_z[F_z > 0][0]
    start = _depth_under(indenter, loaded / material.instantaneous_modulus, end) if material.tau == 0 else 0.0
    row = _row(indenter, reach, float(np.clip(start / reach, 1e-3, 0.1)), n)
    n_steps, arrays = int(np.clip(np.ceil(STEPS / t.size), 1, 64)), _material_arrays(material)
    answers = []
    for share in (1, 2):
        fine, force, where = _finer(t, F_z, share * n_steps)
        V = _lee_radok(material, fine, force)
        known = _grown(V, row)
        u, a, s, q = kernels.follow_force(fine, force, known, row, arrays, where if record else where[:0])
        answers.append((u[where], a[where], s, q))
    u_z, a = (2 * two - one for one, two in zip(answers[0][:2], answers[1][:2], strict=True))  # a step errs with dt
    grown = where < known.size
    u_z[grown] = _polished(indenter, V[where[grown]], u_z[grown])
    indenter.contact_radius(u_z.max())  # a shape that does not reach so deep says so here
    kept = {"x": row[1], "s": answers[1][2], "q_z": answers[1][3]} if record else {}
    return Indentation(indenter, material, t, u_z, F_z, np.maximum(a, 0), **kept)


def _lee_radok(material: Material, t: Array, F_z: Array) -> Array:
    """V = ∫ J(t - s) dF_z [m²]: the F_N/E* of an elastic contact of the same radius, while the contact grows."""
    start, rates, times = material._retardation()
    dt = np.diff(t)[:, None]
    z = dt / times
    with np.errstate(divide="ignore", invalid="ignore"):
        mean = np.where(z > 1e-5, -np.expm1(-z) / z, 1 - z / 2 + z * z / 6)
        late = np.where(z > 1e-2, (1 - mean) / z, 0.5 - z / 6 + z * z / 24 - z**3 / 120 + z**4 / 720)
    kept, gain = np.exp(-z), dt * (mean * F_z[:-1, None] + late * np.diff(F_z)[:, None])
    shares = np.zeros((t.size, rates.size))
    for k in range(t.size - 1):
        shares[k + 1] = shares[k] * kept[k] + gain[k]
    return np.asarray(start * F_z + shares @ rates)


def _grown(V: Array, row: tuple[Array, ...]) -> Array:
    """Depths [m] at the first instants, while the contact grows."""
    shrinks = np.diff(V) < -1e-12 * V.max()
    V = np.maximum.accumulate(V[: int(np.argmax(shrinks)) + 1 if shrinks.any() else V.size])
    g, x, area, power = row
    if g.size == 1:
        return np.asarray(V / (2 * x[0]))
    V_row = 2 * (g * x - area)
    with np.errstate(divide="ignore"):
        u = np.exp(np.interp(np.log(V), np.log(V_row[1:]), np.log(g[1:])))
    outer, inner = V_row[-1] < V, V_row[1] > V
    u[outer] = g[-1] + (V[outer] - V_row[-1]) / (2 * x[-1])
    if x[0] > 0:
        u[inner] = V[inner] / (2 * x[0])
    else:
        u[inner] = g[1] * (V[inner] / V_row[1]) ** (1 / (1 + power[0]))
    return u


def _polished(indenter: Indenter, V: Array, u: Array) -> Array:
    """Depths [m] at which F_N/E* = V, by Newton's method; the start is already close."""
    for _ in range(3):
        slope = np.asarray(indenter.stiffness(u, 1.0))
        missed = V - np.asarray(indenter.force(u, 1.0))
        u = np.maximum(u + np.where(slope > 0, missed, 0.0) / np.where(slope > 0, slope, 1.0), 0.0)
    return u


# --- the row of springs ---------------------------------------------------------------------------


def _row(indenter: Indenter, deepest: float, finest: float, n_springs: int) -> tuple[Array, Array, Array, Array]:
    """Nodes up to the depth `deepest`: g [m], x [m], ∫₀^x g dx [m²], and the exponents of x between them.

    Their spacing grows with g + finest deepest; kinks of the shape are nodes, an even number of cells apart.
    """
    kinks = [radius for radius in (*indenter.kinks, indenter.max_radius) if np.isfinite(radius)]
    depths = [_profile(indenter, radius) for radius in kinks]
    core = max((x for x, g in zip(kinks, depths, strict=True) if g <= 1e-14 * deepest), default=0.0)
    top = min(deepest, depths[-1]) if np.isfinite(indenter.max_radius) else deepest
    if core >= indenter.max_radius:
        return np.zeros(1), np.array([core]), np.zeros(1), np.ones(1)
    marks = [0.0, *(g for g in depths if 1e-9 * top < g < top * (1 - 1e-9)), top]
    scale = finest * deepest
    heights = np.log1p(np.array(marks) / scale)
    g_parts = [np.zeros(1)]
    for low, high in pairwise(heights):
        n = 2 * max(1, round(0.5 * n_springs * (high - low) / heights[-1]))
        g_parts.append(scale * np.expm1(np.linspace(low, high, n + 1)[1:]))
    g = np.concatenate(g_parts)
    g[-1] = top
    x = np.concatenate([[core], np.asarray(indenter.contact_radius(g[1:]))])
    area = np.asarray(indenter.profile_area(x))
    rise = np.diff(np.log(np.maximum(x[1:] - core, np.finfo(float).tiny))) / np.diff(np.log(g[1:]))
    return g, x, area, np.concatenate([rise[:1], rise, rise[-1:]])


def _profile(indenter: Indenter, x: float) -> float:
    """Depth g [m] at x, infinite where the shape has none."""
    try:
        g = float(indenter.profile_1d(x))
    except ValueError:
        return np.inf
    return g if np.isfinite(g) else np.inf


def _end_of(indenter: Indenter) -> float:
    """Greatest depth [m] of a shape that ends; infinite for a punch and for a shape without end."""
    end = _profile(indenter, indenter.max_radius) if np.isfinite(indenter.max_radius) else np.inf
    try:
        return np.inf if end <= 0 or end == np.inf or indenter.contact_radius(2 * end) > 0 else end
    except ValueError:
        return end


def _depth_under(indenter: Indenter, V: float, end: float) -> float:
    """A depth [m] less than a percent above that at which F_N/E* = V [m²], or beyond the shape's end."""

    def short(d: float) -> bool:
        return d < end and float(indenter.force(d, 1.0)) < V

    low = high = min(indenter.depth_about(V), end)
    while short(high):
        low, high = high, 2 * high
    while low > 0 and not short(low):
        low, high = low / 2, low
    for _ in range(8):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if short(middle) else (low, middle)
    return float(high)


def _material_arrays(material: Material) -> tuple[Any, ...]:
    """The material as arrays for the kernels: E, E tau, E_j, tau_j, and the modes in which a free spring relaxes.

    A free spring relaxes with the times of retardation. With the roots of the energies as unknowns its matrix is
    symmetric: a diagonal plus a matrix of rank one. Its eigenvalues are known from these times, and its eigenvectors
    from them.
    """
    E, tau = material.E_star, material.tau
    arms = np.array(material.contact_arms).reshape(-1, 2)
    E_j, tau_j = np.ascontiguousarray(arms[:, 0]), np.ascontiguousarray(arms[:, 1])
    relax, m = 1 / material._retardation()[2], E_j.size
    modes, inverse = np.zeros((m + 1, m + 1)), np.zeros((m + 1, m + 1))
    if tau > 0:
        roots = np.sqrt(np.concatenate([[E], E_j]))
        vectors = _eigenvectors(roots, np.concatenate([[0.0], 1 / tau_j]), relax)
        rates, to_own = -relax, np.concatenate([1 / roots[:1], roots[1:]])  # z_0 = sqrt(E) s, z_j = q_j/sqrt(E_j)
        modes, inverse = to_own[:, None] * vectors, vectors.T / to_own
    else:  # E s + sum q_j = 0 all the time
        glassy = E + E_j.sum()
        roots, to_own = np.sqrt(E_j / tau_j), np.sqrt(E_j * tau_j)
        vectors = _eigenvectors(roots, 1 / tau_j, relax)
        rates = np.concatenate([[0.0], -relax])
        still = relax == 0  # of a fluid: never in motion when free
        modes[0, 0] = 1.0
        modes[1:, 1:] = to_own[:, None] * vectors
        modes[0, 1:] = np.where(still, 0.0, -(roots @ vectors) / glassy / np.where(still, 1.0, relax))
        inverse[1:, 1:] = vectors.T / to_own
        inverse[0, 0] = 1.0
        inverse[0, 1:] = -modes[0, 1:] @ inverse[1:, 1:]
    return E, E * tau, E_j, tau_j, rates, np.ascontiguousarray(modes), np.ascontiguousarray(inverse)


# --- time -----------------------------------------------------------------------------------------


def _finer(t: Array, F_z: Array, n: int) -> tuple[Array, Array, NDArray[np.intp]]:
    """Instants with n steps in each interval, the force there, and where the samples are among them."""
    shares = _shares(t, n)

    def along(values: Array) -> Array:
        ends = zip(values[:-1], values[1:], shares, strict=True)
        return np.concatenate([values[:1], *(low + (high - low) * share for low, high, share in ends)])

    return along(t), along(F_z), np.cumsum([0] + [share.size for share in shares])


def _shares(t: Array, n: int) -> list[Array]:
    """Ends of the steps of each interval, as shares of it. After a jump the first steps are fine."""
    even = np.arange(1, n + 1) / n
    shares, jumped = [], t[0]
    for low, high in pairwise(t):
        if high == low:
            jumped = low
            shares.append(np.ones(1))
        else:
            shares.append(even**3 if high - low > LONG * (low - jumped) else even)
    return shares


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


def _untouched(indenter: Indenter, material: Material, t: Array, u_z: Array, n: int, record: bool) -> Indentation:
    """The outcome without contact: u_z never above zero, or no force."""
    zero = np.zeros(t.size)
    kept = {"x": np.zeros(1), "s": np.zeros((t.size, 1)), "q_z": np.zeros((t.size, 1))} if record else {}
    return Indentation(indenter, material, t, u_z, zero, zero, **kept)


def _eigenvectors(roots: Array, relax: Array, own: Array) -> Array:
    """Eigenvectors (n, n), of length one, of a diagonal plus rank-one matrix.

    The diagonal is `relax` (n,), the rank-one part a multiple of roots rootsᵀ; `own` (n,) are the eigenvalues.
    """
    away = relax[:, None] - own
    away[away == 0] = np.finfo(float).tiny ** 0.25  # an arm next to nothing relaxes for itself
    vectors = roots[:, None] / away
    vectors /= np.abs(vectors).max(axis=0, initial=1e-300)
    return np.asarray(vectors / np.linalg.norm(vectors, axis=0))
