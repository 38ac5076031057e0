"""From the springs back to three dimensions: pressure, traction and displacement of the surface.

A line load q(x) on each side of the centre stands for the pressure, and a displacement w(x) for that of the surface,

    p(r) = -(1/π) ∫_r^a q'(x) / √(x² - r²) dx + q(a) / (π √(a² - r²)),    u(r) = (2/π) ∫_0^r w(x) / √(r² - x²) dx.

The last term of p counts where the load ends with a jump: at the rim of a punch, or at an edge that a dashpot advances
(Popov and Heß 2015). The traction and its displacement follow from q_x and e by the same rule, along the pull and
without the small transverse parts. Outside the contact q = 0 and w is the compression of the free springs.

Loads and displacements are taken as linear between knots, for which both integrals are closed. 2 ∫ q dx = F_N and
2π ∫ p r dr = F_N are then the same number.

Symbols (SI): x position of a spring [m], r distance from the axis [m], q_z, q_x line loads of one side [N/m], w_z, w_x
displacements of springs [m], p, tau pressure and traction [Pa], a contact radius, c stick radius [m].
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.indenters.mapped import rim_pressure
from mdr.indenters.mapping.quadrature import in_chunks
from mdr.indenters.mapping.stable_functions import arcosh, leg
from mdr.march.result.run import SlidingRun
from mdr.normal.indentation import Indentation
from mdr.normal.partial_slip import PartialSlip
from mdr.spring.contact_modes import State
from mdr.tools.arrays import EPS, Array
from mdr.tools.checks import finite_array, plain
from mdr.tools.records import ArrayRecord
from mdr.tools.summary import Summarised, Summary, number, span


@dataclass(frozen=True, eq=False, repr=False)
class SurfaceFields(Summarised, ArrayRecord):
    """The surface at one instant, in SI; r, pressure, traction, u_z and u_x are of the shape of r."""

    r: Array  #: distances from the axis [m]
    pressure: Array  #: p [Pa], > 0 presses
    traction: Array  #: on the surface, along the pull [Pa]; > 0 holds the indenter back
    u_z: Array  #: displacement of the surface into the half-space [m]
    u_x: Array | None  #: displacement of the surface along the pull [m]; None without one
    contact_radius: float  #: a [m]
    stick_radius: float  #: c, outermost radius that sticks [m]
    F_z: float  #: 2π ∫ p r dr [N]
    F_x: float  #: 2π ∫ traction r dr [N]

    def _summary(self) -> Summary:
        return Summary(
            f"SurfaceFields at {np.size(self.r)} distances, {span(self.r, 'm')}",
            [
                ("a", number(self.contact_radius, "m"), "contact radius"),
                ("c", number(self.stick_radius, "m"), "radius that sticks"),
                ("pressure", span(self.pressure, "Pa"), "normal"),
                ("traction", span(self.traction, "Pa"), "along the pull"),
                ("F_z", number(self.F_z, "N"), "normal force"),
                ("F_x", number(self.F_x, "N"), "tangential force"),
            ],
        )


def surface_fields(
    source: Indentation | PartialSlip | SlidingRun, r: ArrayLike | None = None, *, i: int = -1
) -> SurfaceFields:
    """Pressure and traction [Pa] and displacements [m] of the surface at one instant.

    Parameters
    ----------
    source : Indentation, PartialSlip or SlidingRun
        An Indentation made with `record=True`, any PartialSlip, or a SlidingRun made with `record=1` or more.
    r : array_like of float, optional
        Distances from the axis [m]. None: 301 of them from 0 to 1.5 contact radii.
    i : int
        Which sample: of the time, or of the displacements u_x of a PartialSlip. The last by default.

    Returns
    -------
    SurfaceFields
        Arrays in the shape of r.

    Raises
    ------
    TypeError
        For another source.
    ValueError
        For a source that was not recorded.
    IndexError
        For a sample that the source does not have.

    Notes
    -----
    From the springs back to the half-space by Abel's transform (Popov and Heß 2015). At a rim where the pressure is
    infinite the answer is 0; at a sharp tip it is the pressure one rounding away.

    Examples
    --------
    >>> import mdr
    >>> rubber = mdr.Elastic(E=3e6, nu=0.5)
    >>> pulled = mdr.partial_slip(mdr.Paraboloid(R=5e-3), rubber, mu_0=0.4, u_z0=20e-6, u_x=4e-6)
    >>> mdr.surface_fields(pulled, r=[0, 1e-4]).pressure.round(-2)
    array([161100., 152800.])
    """
    if isinstance(source, Indentation):
        return _of_indentation(source, r, i)
    if isinstance(source, PartialSlip):
        return _of_partial_slip(source, r, i)
    if isinstance(source, SlidingRun):
        return _of_run(source, r, i)
    raise TypeError(f"source must be of kind Indentation, PartialSlip or SlidingRun, got {source!r}")


def from_line_load(x: ArrayLike, q: ArrayLike, r: ArrayLike) -> Array:
    """Pressure [Pa] at r [m] of a line load q [N/m] (n,) on each side, linear between the knots x >= 0 [m] (n,).

    It is constant from the axis to x[0], and ends with a jump at x[-1] if q[-1] is not 0.
    """
    x, q, r = _knots("q", x, q, "N/m", r)
    x, q = _distinct(x, q)

    def pressure(r: Array) -> Array:
        near = np.maximum(r, EPS * x[-1])[:, None]
        reach = arcosh(x, near)
        p = -(np.diff(reach, axis=1) @ (np.diff(q) / np.diff(x))) / np.pi
        inside = r < x[-1]
        p[inside] += rim_pressure(r[inside], x[-1], q[-1])
        return np.asarray(np.where(inside, p, 0.0))

    return np.asarray(in_chunks(pressure, r))


def from_displacement(x: ArrayLike, w: ArrayLike, r: ArrayLike) -> Array:
    """Displacement [m] of the surface at r [m] of springs displaced by w [m] (n,), linear between the knots x [m] (n,).

    It is constant from the axis to x[0], and 0 beyond x[-1].
    """
    x, w, r = _knots("w", x, w, "m", r)
    x, w = np.concatenate([[0.0], x]), np.concatenate([w[:1], w])
    x, w = _distinct(x, w)
    slope = np.diff(w) / np.diff(x)
    start = w[:-1] - slope * x[:-1]

    def displacement(r: Array) -> Array:
        with np.errstate(invalid="ignore", divide="ignore"):
            share = np.where(r[:, None] > 0, np.minimum(x / r[:, None], 1), 1.0)
        chord = leg(1.0, share) * r[:, None]
        u = 2 / np.pi * (np.diff(np.arcsin(share), axis=1) @ start - np.diff(chord, axis=1) @ slope)
        return np.asarray(np.where(r > 0, u, w[0]))

    return np.asarray(in_chunks(displacement, r))


# --- sources --------------------------------------------------------------------------------------


def _of_indentation(source: Indentation, r: ArrayLike | None, i: int) -> SurfaceFields:
    """Loads and compressions of the springs are straight lines in the depth g between them: knots are added there."""
    if source.x is None or source.q_z is None or source.s is None:
        raise ValueError("the springs of this Indentation were not kept: call indent(..., record=True)")
    a, F_z = float(source.contact_radius[i]), float(source.F_z[i])
    own = np.concatenate([[0.0], source.x]) if source.x[0] > 0 else source.x
    r = _distances(r, a or float(own[-1]))
    share = np.arange(6) / 6  # knots for each spring
    x = np.append((own[:-1, None] + np.diff(own)[:, None] * share).ravel(), own[-1])
    x = np.union1d(x, [a]) if a < x[-1] else x
    g, g_own = (np.asarray(source.indenter.profile_1d(at)) for at in (x, source.x))
    w = np.interp(g, g_own, source.s[i])
    p = 0 * r
    if a > 0:
        ends = a >= own[-1] * (1 - 4 * EPS)
        n = g_own.size if ends else 1 + int(np.max(np.flatnonzero((source.q_z[i] > 0) & (source.x < a)), initial=0))
        g_in, q_in = g_own[:n], source.q_z[i][:n]
        if not ends:
            g_a = float(source.indenter.profile_1d(a))
            q_a = max(_extended(g_in, q_in, g_a), 0.0) if source.material.tau > 0 else 0.0
            g_in, q_in = np.append(g_in, g_a), np.append(q_in, q_a)
        x_in = x[x <= a]
        p = _scaled(x_in, np.interp(g[x <= a], g_in, q_in), F_z, r)
    u_z = from_displacement(x, w, r)
    return SurfaceFields(plain(r), plain(p), plain(0 * r), plain(u_z), None, a, a, F_z, 0.0)


def _of_partial_slip(source: PartialSlip, r: ArrayLike | None, i: int) -> SurfaceFields:
    """Pressure and traction by the shape itself: a traction mu_0 [p(d) - p(d_c)]."""
    shape, d, mu_0 = source.indenter, source.u_z0, source.mu_0
    u_x, c, F_x = (float(np.ravel(values)[i]) for values in (source.u_x, source.stick_radius, source.F_x))
    a, unit = float(shape.contact_radius(d)), mu_0 * source.material.mindlin_ratio
    r = _distances(r, a)
    p = np.asarray(shape.pressure(r, d, source.material.E_star))
    d_c = max(d - u_x / unit, 0.0)
    stuck = np.asarray(shape.pressure(r, d_c, source.material.E_star)) if d_c > 0 else 0 * p
    stuck = np.minimum(stuck, p)  # at a rim, which either radius may miss by a rounding, p is 0 or huge
    # knots of the displacement
    x = np.unique([*(a * np.sin(np.linspace(0, np.pi / 2, 2048))), c, *(k for k in shape.kinks if k < a)])
    w_z = d - np.asarray(shape.profile_1d(x))
    u_z = np.where(r <= a, d - np.asarray(shape.profile_3d(np.minimum(r, a))), from_displacement(x, w_z, r))
    u_x_of_r = from_displacement(x, np.minimum(u_x, unit * w_z), r)
    tau = mu_0 * (p - stuck)
    return SurfaceFields(plain(r), plain(p), plain(tau), plain(u_z), plain(u_x_of_r), a, c, source.F_z, F_x)


def _of_run(run: SlidingRun, r: ArrayLike | None, i: int) -> SurfaceFields:
    kept: tuple[Any, ...] = (run.x, run.width, run.e, run.s, run.state, run.f_z, run.f_x)
    if any(values is None for values in kept):
        raise ValueError("the springs of this SlidingRun were not kept: call slide(..., record=1) or more")
    x, width, *springs = kept
    e, s, state, f_z, f_x = (np.asarray(values)[i] for values in springs)
    faces = np.cumsum(width) / 2  # of the cells that the weights of the springs make
    pressed = f_z > 0
    sticks = np.flatnonzero((state == State.STICK) & pressed)
    c = float(faces[sticks[-1]]) if sticks.size else 0.0
    a = _edge(x, faces, f_z / width, pressed) if pressed.any() else 0.0
    r = _distances(r, a or float(faces[-1]))
    F_z, F_x = float(f_z.sum()), float(f_x.sum())
    p, tau = (
        _scaled(*_ended(x[pressed], (f / width)[pressed], a), F, r) if a else 0 * r for f, F in ((f_z, F_z), (f_x, F_x))
    )
    u_z = plain(from_displacement(*_from_axis(x, s), r))
    u_x = plain(from_displacement(*_from_axis(x, e), r))
    return SurfaceFields(plain(r), plain(p), plain(tau), u_z, u_x, a, c, F_z, F_x)


# --- knots ----------------------------------------------------------------------------------------


def _edge(x: Array, faces: Array, q: Array, pressed: NDArray[np.bool_]) -> float:
    """Contact radius [m]: where the load, continued from the last two springs, vanishes; else the last face."""
    last = int(np.flatnonzero(pressed)[-1])
    slope = (q[last] - q[last - 1]) / (x[last] - x[last - 1]) if last else 0.0
    zero = x[last] - q[last] / slope if slope < 0 else np.inf
    reach = x[last + 1] if last + 1 < x.size else faces[last] + (faces[last] - x[last])
    return float(zero if zero <= reach else faces[last])


def _ended(x: Array, q: Array, a: float) -> tuple[Array, Array]:
    """Knots from the axis to the edge. The load there is 0, or the continued load if that is not small."""
    x, q = _from_axis(x, q)
    end = _extended(x, q, a)
    return np.append(x, a), np.append(q, end if abs(end) > 0.5 * abs(q[-1]) else 0.0)


def _from_axis(x: Array, values: Array) -> tuple[Array, Array]:
    """Knots with one more on the axis: continued as an even function that is smooth there, or as a straight line."""
    if x.size < 3 or x[0] == 0:
        return x, values
    first, second = np.diff(values[:3]) / np.diff(x[:3])
    rounded = abs(first) < 0.75 * abs(second)
    rise = first * (x[0] ** 2 / (x[0] + x[1]) if rounded else x[0])
    return np.concatenate([[0.0], x]), np.concatenate([[values[0] - rise], values])


def _extended(x: Array, values: Array, a: float) -> float:
    """The values continued to a by their last slope."""
    if x.size < 2:
        return float(values[-1])
    return float(values[-1] + (values[-1] - values[-2]) / (x[-1] - x[-2]) * (a - x[-1]))


def _scaled(x: Array, q: Array, force: float, r: Array) -> Array:
    """Pressure of the load, with the force that the springs carry: straight lines between knots miss a little."""
    between = float(np.sum((q[1:] + q[:-1]) * np.diff(x))) + 2 * float(q[0] * x[0])
    near = between != 0 and abs(force / between - 1) < 0.1
    return np.asarray(from_line_load(x, q * (force / between if near else 1.0), r))


def _distances(r: ArrayLike | None, a: float) -> Array:
    if r is None:
        return a * np.linspace(0, 1.5, 301)
    return np.abs(finite_array("r", r, "m"))


def _knots(name: str, x: ArrayLike, values: ArrayLike, unit: str, r: ArrayLike) -> tuple[Array, Array, Array]:
    x, values = finite_array("x", x, "m"), finite_array(name, values, unit)
    if x.ndim != 1 or x.size == 0 or x.shape != values.shape:
        raise ValueError(f"x and {name} must be lists of one length, got shapes {x.shape} and {values.shape}")
    if x[0] < 0 or np.any(np.diff(x) < 0):
        raise ValueError("x must ascend from the axis, x >= 0: each spring stands for both sides")
    return x, values, np.abs(finite_array("r", r, "m"))


def _distinct(x: Array, values: Array) -> tuple[Array, Array]:
    """Knots without those that are closer to the one before than a rounding."""
    kept = np.concatenate([[True], np.diff(x) > 4 * EPS * x[-1]])
    return x[kept], values[kept]
