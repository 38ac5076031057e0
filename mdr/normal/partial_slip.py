"""Pulled sideways at a fixed depth: how an elastic contact sticks inside and slips from its edge inwards.

A spring at the depth g of the profile slips once its extension u_x has reached mu_0 kappa (d - g), so that (Popov and
Heß 2015; for the sphere Cattaneo 1938 and Mindlin 1949)

    F_x = mu_0 [F_N(d) - F_N(d_c)],    g(c) = d_c = d - u_x/(mu_0 kappa),

for every shape: c is the radius of the disc that still sticks. After a turn of the motion each spring answers with
twice its first force to twice its first stretch (Masing's rule), and a full turn between -U and U costs

    W = 8 ∫_0^U F_x du_x - 4 U F_x(U) = 8 mu_0 [F_N(d) U - mu_0 kappa ∫_{d_c}^d F_N dδ] - 4 U F_x(U).

Long-time moduli of the material count: the pull is slow. Symbols (SI): u_z0 = d depth [m], u_x displacement [m],
kappa = E*/G* [-], F_x, F_z forces [N], W loss [J].
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.base import Indenter
from mdr.indenters.mapping.quadrature import double_exponential
from mdr.materials import Material
from mdr.tools.arrays import Array
from mdr.tools.checks import count, finite_array, in_range, instance, plain, positive
from mdr.tools.messages import short
from mdr.tools.records import ArrayRecord
from mdr.tools.summary import Summarised, Summary, number, span


@dataclass(frozen=True, eq=False, repr=False)
class PartialSlip(Summarised, ArrayRecord):
    """Outcome of partial_slip(), in SI; u_x, F_x and stick_radius in the shape of the u_x given."""

    indenter: Indenter  #: shape
    material: Material  #: half-space
    mu_0: float  #: local coefficient of friction [-]
    u_z0: float  #: depth [m]
    u_x: Array  #: displacement [m]
    F_x: Array  #: tangential force [N]
    F_z: float  #: normal force, the same for all u_x [N]
    stick_radius: Array  #: radius of the disc that sticks, 0 in full slip [m]

    def _summary(self) -> Summary:
        slipping = int(np.count_nonzero(np.asarray(self.stick_radius) == 0))
        return Summary(
            f"PartialSlip of {short(repr(self.indenter))} at the depth {number(self.u_z0, 'm')}",
            [
                ("material", short(repr(self.material)), ""),
                ("u_x", span(self.u_x, "m"), "displacement"),
                ("F_x", span(self.F_x, "N"), f"tangential force; mu_0 F_z = {number(self.mu_0 * self.F_z, 'N')}"),
                ("F_z", number(self.F_z, "N"), f"normal force; mu_0 = {self.mu_0:.6g}"),
                ("c", span(self.stick_radius, "m"), "radius of the disc that sticks"),
                ("full slip", f"{slipping} of {np.size(self.u_x)}", "displacements"),
            ],
        )


@dataclass(frozen=True, eq=False, repr=False)
class TangentialLoop(Summarised, ArrayRecord):
    """Outcome of tangential_loop(), in SI: one turn from U to -U and back."""

    u_x: Array  #: (2 n - 1,) displacement [m]
    F_x: Array  #: (2 n - 1,) tangential force [N]
    F_z: float  #: normal force [N]
    loss: float  #: energy W of one turn [J]

    def _summary(self) -> Summary:
        return Summary(
            f"TangentialLoop of {self.u_x.size} points",
            [
                ("u_x", span(self.u_x, "m"), "displacement"),
                ("F_x", span(self.F_x, "N"), "tangential force"),
                ("F_z", number(self.F_z, "N"), "normal force"),
                ("loss", number(self.loss, "J"), "energy of one turn"),
            ],
        )


def partial_slip(indenter: Indenter, material: Material, mu_0: float, u_z0: float, u_x: ArrayLike) -> PartialSlip:
    """Tangential force [N] and stick radius [m] of an indenter at a fixed depth that is pulled sideways by u_x.

    Parameters
    ----------
    indenter : Indenter
        The shape.
    material : Material
        The half-space. It acts with its long-time moduli: the pull is slow.
    mu_0 : float
        Local coefficient of friction [-].
    u_z0 : float
        Depth [m].
    u_x : array_like of float
        Displacements [m], zero or above. Each is reached from rest, monotonically.

    Returns
    -------
    PartialSlip
        `F_x` and `stick_radius` in the shape of u_x; `F_z` is one number.

    Raises
    ------
    TypeError
        For a wrong kind of input.
    ValueError
        For NaN, for u_x < 0 (after a turn see `tangential_loop`), for mu_0 or u_z0 <= 0, a material that flows (E_star
        = 0), and a shape that ends before the depth or is so hollow that a ring would stick.

    Notes
    -----
    Cattaneo (1938) and Mindlin (1949) for the sphere; for every shape Popov and Heß (2015) ::

        F_x = mu_0 [F_N(d) - F_N(d_c)],    g(c) = d_c = d - u_x/(mu_0 kappa)

    Examples
    --------
    >>> import mdr
    >>> rubber = mdr.Elastic(E=3e6, nu=0.5)
    >>> pulled = mdr.partial_slip(mdr.Paraboloid(R=5e-3), rubber, mu_0=0.4, u_z0=20e-6, u_x=[4e-6, 2e-5])
    >>> pulled.F_x.round(5), pulled.stick_radius.round(5)
    (array([0.00615, 0.01349]), array([0.00026, 0.     ]))
    """
    mu_0, u_z0 = _checked(indenter, material, mu_0, u_z0)
    u_x = finite_array("u_x", u_x, "m")
    if np.any(u_x < 0):
        raise ValueError(f"u_x must not be negative, got {u_x.min():.6g} m: the pull is monotonic; see tangential_loop")
    F_x, c = _pulled(indenter, material, mu_0, u_z0, u_x)
    F_z = float(indenter.force(u_z0, material.E_star))
    return PartialSlip(indenter, material, mu_0, u_z0, plain(u_x), plain(F_x), F_z, plain(c))


def tangential_loop(
    indenter: Indenter, material: Material, mu_0: float, u_z0: float, u_x: float, *, n: int = 201
) -> TangentialLoop:
    """Hysteresis loop of the tangential force [N] and its energy loss [J], at a fixed depth.

    Parameters
    ----------
    indenter, material, mu_0, u_z0
        As in `partial_slip`.
    u_x : float
        Amplitude U [m]: the indenter moves to and fro between U and -U.
    n : int
        Instants on each way.

    Returns
    -------
    TangentialLoop
        One turn from U to -U and back, arrays of shape (2 n - 1,), and its loss.

    Raises
    ------
    TypeError, ValueError
        As in `partial_slip`.

    Notes
    -----
    Masing's rule: after a turn of the motion each spring answers with twice its first force to twice its first stretch.

    Examples
    --------
    >>> import mdr
    >>> loop = mdr.tangential_loop(mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5), mu_0=0.4, u_z0=20e-6, u_x=4e-6)
    >>> print(f"{loop.loss:.3g} J")
    3.29e-09 J
    """
    mu_0, u_z0 = _checked(indenter, material, mu_0, u_z0)
    U, n = positive("u_x", u_x, "amplitude in m"), count("n", n, 2)
    with in_range(f"a loop of u_x = {U:.6g} m"):
        way = 2 * U * np.sin(np.linspace(0, np.pi / 2, n)) ** 2  # travelled since the turn, fine at both ends
    F_x, _ = _pulled(indenter, material, mu_0, u_z0, way / 2)
    d_c = float(_stuck_depth(material, mu_0, u_z0, np.array(U)))
    F_z, area = indenter.force(u_z0, material.E_star), _force_integral(indenter, material.E_star, d_c, u_z0)
    with in_range(f"a loop of u_x = {U:.6g} m"):
        F_way = 2 * F_x
        back, F_back = U - way, F_x[-1] - F_way
        loss = 8 * mu_0 * (F_z * U - mu_0 * material.mindlin_ratio * np.float64(area)) - 4 * U * F_x[-1]
    loop_u, loop_F = np.concatenate([back, -back[1:]]), np.concatenate([F_back, -F_back[1:]])
    return TangentialLoop(loop_u, loop_F, float(F_z), float(loss))


def _pulled(indenter: Indenter, material: Material, mu_0: float, u_z0: float, u_x: Array) -> tuple[Array, Array]:
    """F_x [N] and stick radius [m]."""
    d_c = _stuck_depth(material, mu_0, u_z0, u_x)
    if indenter.max_radius < np.inf and np.any(d_c == 0):
        rim = float(indenter.contact_radius(u_z0))
        if float(indenter.profile_1d(rim)) < 0:
            raise ValueError(
                f"u_x = {u_x.max():.6g} m: {type(indenter).__name__} is pressed harder at its rim than inside: a ring "
                "sticks there, which the method leaves out; pull less"
            )
    E_star = material.E_star
    F_z, F_c = indenter.force(u_z0, E_star), np.asarray(indenter.force(d_c, E_star))
    with in_range("F_x"):
        F_x = mu_0 * (F_z - F_c)
    return F_x, np.asarray(indenter.contact_radius(d_c))


def _stuck_depth(material: Material, mu_0: float, u_z0: float, u_x: Array) -> Array:
    """d_c [m], 0 in full slip, also where u_x/(mu_0 kappa) is beyond the range of floats."""
    with np.errstate(over="ignore"):
        return np.maximum(u_z0 - u_x / mu_0 / material.mindlin_ratio, 0)


def _force_integral(indenter: Indenter, E_star: float, low: float, high: float) -> float:
    """∫ F_N dδ [J] between two depths, cut at the kinks of the shape."""
    kinks = [float(indenter.profile_1d(x)) for x in indenter.kinks if x < indenter.contact_radius(high)]
    ends = np.array([low, *sorted(d for d in kinks if low < d < high), high])
    return double_exponential().integral(lambda d: indenter.force(d, E_star), ends)


def _checked(indenter: Indenter, material: Material, mu_0: float, u_z0: float) -> tuple[float, float]:
    instance("indenter", indenter, Indenter)
    instance("material", material, Material)
    if material.E_star == 0:
        raise ValueError(f"{material!r} flows: with E_star = 0 no tangential force stays; give it a long-time modulus")
    return positive("mu_0", mu_0, "coefficient of friction"), positive("u_z0", u_z0, "depth in m")
