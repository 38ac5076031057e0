"""Profile: any shape f(r) given as a function, mapped to g(x) by quadrature.

With r = x sin t the map g(x) = |x| int_0^(pi/2) f'(x sin t) dt has no singular end; f' comes from Chebyshev
polynomials through values of f near each point (no length scale enters). Where f has kinks or flat parts the integral
is cut at them, if they are named.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mdr.checks import positive
from mdr.indenters.base import Array, Indenter, each, radius, slope, unit_nodes

ACCURACY = 1e-9  #: of g, relative, for smooth f with its kinks named


@dataclass(frozen=True)
class Profile(Indenter):
    """The indenter of shape f(r).

    f takes and returns arrays in m (wrap a function of one number in numpy.vectorize), is smooth between its kinks,
    and has f(0) = 0. The contact must remain a full disc: where g decreases the contact would be annular, and the
    shape is refused. A warning tells the error of the mapping when it exceeds 1e-9, as with kinks that were not named.
    """

    f: Callable[[Array], Array]  #: shape [m] over radius [m]
    kinks: tuple[float, ...] = ()  #: radii [m] where f or f' is not smooth
    r_max: float | None = None  #: radius [m] up to which f is known; None for everywhere
    name: str | None = None  #: what to call the shape; a stored study asks for it

    def __init__(
        self, f: Callable[[Array], Array], *, kinks: Any = (), r_max: float | None = None, name: str | None = None
    ) -> None:
        if not callable(f):
            raise TypeError(f"f must be a function of the radius, got {f!r}")
        if name is not None and not isinstance(name, str):
            raise TypeError(f"name must be a string, got {name!r}")
        object.__setattr__(self, "f", f)
        object.__setattr__(
            self, "kinks", tuple(sorted(positive("kinks", k, "radii in m") for k in np.atleast_1d(kinks)))
        )
        object.__setattr__(self, "r_max", None if r_max is None else positive("r_max", r_max, "radius in m"))
        object.__setattr__(self, "name", name)
        self._check_apex()

    def _check_apex(self) -> None:
        height = np.asarray(self.f(np.zeros(1)), dtype=float)
        if height.shape != (1,):
            raise TypeError(
                "f must return an array of the shape it is given; wrap a function of one number in numpy.vectorize"
            )
        if height[0] != 0:
            raise ValueError(f"f(0) must be 0, the apex of the indenter, got {height[0]!r}; subtract it")

    @property
    def max_radius(self) -> float:
        """r_max [m], or infinity."""
        return np.inf if self.r_max is None else self.r_max

    def profile_3d(self, r: ArrayLike) -> Any:
        """f(r) [m]; infinite beyond r_max."""
        return each(self._f, np.abs(radius(r)))

    def profile_1d(self, x: ArrayLike) -> Any:
        """g(x) [m] by quadrature; infinite beyond r_max."""
        return each(lambda x: self._g(x, 32), np.abs(radius(x, "x")))

    def contact_radius(self, d: ArrayLike) -> Any:
        """Contact radius a [m] at depth d [m], g(a) = d.

        Raises ValueError if the contact would be annular or beyond r_max; warns when the mapping is less accurate
        than 1e-9.
        """
        a = super().contact_radius(d)
        largest = float(np.max(a, initial=0.0))
        if largest > 0:
            self._check_map(largest)
        return a

    def _check_map(self, a: float) -> None:
        x = a * np.linspace(1 / 64, 1, 64)
        g, rough = self._g(x, 32), self._g(x, 20)
        if np.any(np.diff(g) < -1e-9 * g[-1]) or np.any(g < -1e-9 * abs(g[-1])):
            raise ValueError(
                f"{self!r}: g(x) decreases within radius {a:.6g} m, so the contact is annular, not a full disc; "
                "the springs represent full-disc contacts only"
            )
        error = float(np.max(np.abs(g - rough)) / g[-1])
        if error > ACCURACY:
            warnings.warn(
                f"the mapping of {self!r} to g(x) is accurate to {error:.1g} only; name the kinks of f in kinks=(...)",
                stacklevel=3,
            )

    def _f(self, r: Array) -> Array:
        inside = r <= self.max_radius
        heights = np.where(inside, np.asarray(self.f(np.where(inside, r, 0.0)), dtype=float), np.inf)
        if np.any(~np.isfinite(heights[inside])):
            raise ValueError(
                f"{self!r}: f is not finite at r = {r[inside][~np.isfinite(heights[inside])][0]:.6g} m; give r_max="
            )
        return heights

    def _g(self, x: Array, n_nodes: int) -> Array:
        """x int f'(x sin t) dt, cut at the kinks and graded towards the apex."""
        inside = (x > 0) & (x <= self.max_radius)
        x_in = np.where(inside, x, 1.0 if self.r_max is None else self.r_max)
        u, weight = unit_nodes(n_nodes)
        cuts = [*self.kinks, np.inf]
        total = np.zeros(x.shape)
        low = 0.0
        for high in cuts:
            t_lo, t_hi = (np.arcsin(np.minimum(end / x_in, 1.0)) for end in (low, high))
            # t = t_lo + span u²(3 - 2u)/1: soft at the cut, where f' may jump or start like a root
            span = t_hi - t_lo
            t = t_lo[..., None] + span[..., None] * (u**2 * (3 - 2 * u))
            r = np.maximum(x_in[..., None] * np.sin(t), np.finfo(float).tiny)
            top = min(high, self.max_radius)
            rate = slope(lambda r: np.asarray(self.f(r), dtype=float), np.clip(r, low, top), low, top)
            total += np.where(span > 0, span * (rate @ (weight * 6 * u * (1 - u))), 0.0)
            low = high
        beyond = np.where(x > self.max_radius, np.inf, 0.0)
        return np.where(inside, x * total, beyond)
