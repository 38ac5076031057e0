"""What every indenter must answer: f(r), g(x), a(d), F_N(d), dF_N/dd, p(r).

The three-dimensional shape f(r) is mapped to the one-dimensional profile g(x), and everything else follows from g
(Popov and Heß 2015, Method of Dimensionality Reduction, ch. 3):

    g(x) = |x| int_0^|x| f'(r)/sqrt(x² - r²) dr,      d = g(a),      F_N = 2 E* int_0^a (d - g) dx,
    dF_N/dd = 2 E* a,      p(r) = -(1/pi) int_r^a q'(x)/sqrt(x² - r²) dx + q(a)/(pi sqrt(a² - r²)),  q = E* (d - g).

A shape of your own gives `profile_3d` and `profile_1d`; contact radius, force and pressure then come from g by root
finding and quadrature, and each may be overridden by a closed form. Valid for a half-space and small slopes, and
while the contact is a full disc: g must not decrease.

Symbols: r, x radius and position [m], d indentation depth [m], a contact radius [m], E_star contact modulus [Pa].
Arrays go in and come out in their common shape; a scalar gives a float.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import ArrayLike, NDArray

from mdr.checks import positive

Array = NDArray[np.float64]

N_NODES = 48  #: of a Gauss-Legendre panel


def unit_nodes(n: int) -> tuple[Array, Array]:
    """Nodes and weights (n,) of Gauss-Legendre quadrature on [0, 1]."""
    x, w = leggauss(n)
    return 0.5 * (x + 1), 0.5 * w


class Indenter(ABC):
    """A rigid axisymmetric indenter with its apex at the origin."""

    @abstractmethod
    def profile_3d(self, r: ArrayLike) -> Any:
        """Shape f(r) [m]: height of the surface over the apex at radius r [m]; infinite beyond a rim."""

    @abstractmethod
    def profile_1d(self, x: ArrayLike) -> Any:
        """MDR profile g(x) [m] at position x [m], even in x; infinite beyond a rim."""

    @property
    def kinks(self) -> tuple[float, ...]:
        """Positions x > 0 [m] at which g is not smooth."""
        return ()

    @property
    def max_radius(self) -> float:
        """Largest contact radius [m] that the shape can take."""
        return np.inf

    def contact_radius(self, d: ArrayLike) -> Any:
        """Contact radius a [m] at depth d [m], d = g(a); zero for d <= 0.

        Raises ValueError for a depth that the shape does not reach.
        """
        return each(self._contact_radius, depth(d))

    def force(self, d: ArrayLike, E_star: float) -> Any:
        """Normal force F_N [N] at depth d [m] for the contact modulus E_star [Pa]; zero for d <= 0."""
        E_star = positive("E_star", E_star, "contact modulus in Pa")
        return each(lambda d: 2 * E_star * self._area(d, np.asarray(self.contact_radius(d))), depth(d))

    def stiffness(self, d: ArrayLike, E_star: float) -> Any:
        """Contact stiffness dF_N/dd = 2 E* a(d) [N/m]."""
        return 2 * positive("E_star", E_star, "contact modulus in Pa") * self.contact_radius(d)

    def pressure(self, r: ArrayLike, d: float, E_star: float) -> Any:
        """Pressure p [Pa] at radii r [m] of the elastic contact at depth d [m]; zero outside, and at the rim of a
        punch itself.
        """
        E_star = positive("E_star", E_star, "contact modulus in Pa")
        a = float(self.contact_radius(d))
        return each(lambda r: E_star * self._pressure(r, float(depth(d)), a), np.abs(radius(r)))

    # --- from g alone ---

    def _contact_radius(self, d: Array) -> Array:
        """Bracket the root of g(a) = d by doubling, then halve it down to rounding."""
        high = np.full(d.shape, min(1.0, self.max_radius))
        for grow in (2.0, 0.5):
            for _ in range(2000):
                g = np.asarray(self.profile_1d(high))
                off = (d > 0) & ((g < d) & (high < self.max_radius) if grow > 1 else g >= d)
                if not off.any():
                    break
                high = np.where(off, np.minimum(high * grow, self.max_radius), high)
        low, high = (high, np.minimum(2 * high, self.max_radius))
        if np.any((d > 0) & (np.asarray(self.profile_1d(high)) < d)):
            raise ValueError(
                f"{self!r} ends at radius {self.max_radius:.6g} m: "
                f"a depth of {d.max():.6g} m is beyond it; press less deep"
            )
        low = np.where(np.asarray(self.profile_1d(low)) < d, low, 0.0)
        for _ in range(90):
            middle = 0.5 * (low + high)
            below = np.asarray(self.profile_1d(middle)) < d
            low, high = np.where(below, middle, low), np.where(below, high, middle)
        return np.where(d > 0, 0.5 * (low + high), 0.0)

    def _area(self, d: Array, a: Array) -> Array:
        """int_0^a (d - g) dx, panel by panel between the kinks."""
        t, weight = unit_nodes(N_NODES)
        total = np.zeros(d.shape)
        ends = [0.0, *self.kinks, np.inf]
        for start, end in pairwise(ends):
            low, high = np.minimum(start, a), np.minimum(end, a)
            # x = low + span t²(3 - 2t) softens root-like ends on both sides
            x = low[..., None] + (high - low)[..., None] * t**2 * (3 - 2 * t)
            below = np.where(x < a[..., None], d[..., None] - np.asarray(self.profile_1d(x)), 0)
            total += (high - low) * (below @ (weight * 6 * t * (1 - t)))
        return np.where(d > 0, total, 0.0)

    def _pressure(self, r: Array, d: float, a: float) -> Array:
        """p/E* = (1/pi) int_r^a g'(x)/sqrt(x² - r²) dx + (d - g(a))/(pi sqrt(a² - r²)); x = r cosh s."""
        inside = r < a
        safe = np.where(inside, r, 0.5 * a) if a > 0 else np.ones_like(r)
        if a <= 0:
            return np.zeros_like(r)
        t, weight = unit_nodes(N_NODES)
        total = np.zeros(r.shape)
        ends = [0.0, *[x for x in self.kinks if x < a], a]
        for start, end in pairwise(ends):
            low, high = np.maximum(start, safe), np.maximum(end, safe)
            low = np.maximum(low, 1e-12 * a)
            high = np.maximum(high, low)
            # through u with x = sqrt(r² + u²): dx/sqrt(x² - r²) = du/x, smooth for r > 0; graded towards small u
            u_lo, u_hi = np.sqrt(low**2 - np.minimum(safe, low) ** 2), np.sqrt(high**2 - np.minimum(safe, high) ** 2)
            scale = np.maximum(safe, 1e-9 * a)
            s_lo, s_hi = np.arcsinh(u_lo / scale), np.arcsinh(u_hi / scale)
            s = s_lo[..., None] + (s_hi - s_lo)[..., None] * (t**2 * (3 - 2 * t))  # soft at a kink
            x = np.hypot(safe[..., None], scale[..., None] * np.sinh(s))
            rate = scale[..., None] * np.cosh(s) / x
            total += (s_hi - s_lo) * ((np.asarray(self._slope_1d(x, start, end)) * rate) @ (weight * 6 * t * (1 - t)))
        jump = d - float(self.profile_1d(np.nextafter(a, 0)))
        edge = jump / np.sqrt(np.maximum(a**2 - safe**2, np.finfo(float).tiny)) if jump > 1e-9 * d else 0.0
        result: Array = np.where(inside, (total + edge) / np.pi, 0.0)
        return result

    def _slope_1d(self, x: Array, low: float = 0.0, high: float = np.inf) -> Array:
        """g'(x) for x > 0 between two kinks, by a polynomial in sqrt(x - low) through nearby values of g."""
        if low == 0:
            return slope(lambda x: np.asarray(self.profile_1d(x)), x, low, high)
        root = np.sqrt(np.maximum(x - low, 1e-24 * low))  # behind a kink of f, g is smooth in this root
        by_root = slope(lambda u: np.asarray(self.profile_1d(low + u**2)), root, 0.0, float(np.sqrt(high - low)))
        return np.asarray(by_root / (2 * root))


# --- shared by the shapes ---


def depth(d: ArrayLike) -> Array:
    """Depths as a float array; ValueError for NaN and infinity."""
    return _finite(d, "d", "depths in m")


def radius(r: ArrayLike, name: str = "r") -> Array:
    """Radii or positions as a float array; ValueError for NaN and infinity."""
    return _finite(r, name, "radii in m")


def _finite(values: ArrayLike, name: str, meaning: str) -> Array:
    try:
        array = np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise TypeError(f"{name} must be a number or an array of {meaning}, got {values!r}") from None
    if not np.all(np.isfinite(array)):
        raise ValueError(f"{name} must be finite ({meaning}), got {values!r}")
    return array


def each(function: Callable[[Array], Array], values: Array) -> Any:
    """Apply an array function; a scalar in gives a float out."""
    result = np.asarray(function(np.atleast_1d(values)))
    return float(result.reshape(-1)[0]) if values.ndim == 0 else result


_CHEB = np.cos(np.pi * (np.arange(17) + 0.5) / 17)  # Chebyshev points on (-1, 1)
_TO_COEFFICIENTS = np.linalg.inv(np.polynomial.chebyshev.chebvander(_CHEB, 16))
_DERIVATIVE = np.polynomial.chebyshev.chebder(np.eye(17))  # coefficients of the derivative, column by column


def slope(function: Callable[[Array], Array], x: Array, low: float = 0.0, high: float = np.inf) -> Array:
    """Derivative of a function that is smooth between low and high, from 17 values around each x > 0.

    The values lie on [3x/4, 5x/4], cut at low and high: no length scale enters, and a power law is met to about 1e-13.
    """
    start = np.maximum(0.75 * x, low)
    end = np.minimum(1.25 * x, high)
    half = 0.5 * (end - start)
    half = np.where(half > 0, half, 0.25 * x)
    centre = start + half
    values = function(centre[..., None] + half[..., None] * _CHEB)
    coefficients = (values @ _TO_COEFFICIENTS.T) @ _DERIVATIVE.T
    basis = np.polynomial.chebyshev.chebvander((x - centre) / half, 15)
    result: Array = (coefficients * basis).sum(axis=-1) / half
    return result
