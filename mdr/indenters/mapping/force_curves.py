"""Curves F(d) of a shape, through measured points or near to them.

Points without noise are met: ln F, less a power of d that is known of the tip, is a spline of degree 5. Noisy ones are
passed by: F' = 2E* a is a cubic spline in s = √(d/d_n) with coefficients that rise, so that the contact grows whatever
the noise is. Over s the contact radius of a sphere is next to a straight line, and that of a cone a parabola. The
coefficients follow by non-negative least squares, on as few pieces as come as near to the points as noise lets them.
A tip may have a face where it is said to be flat, or where nothing is said and it takes no more pieces.

Both kinds of curve know

    power       of d, as which F begins at d -> 0,
    power_to    depth [m] up to which F is that power,
    places      depths [m], close enough to see where F' falls,
    why         why it is no curve of a shape; empty where it is one,
    doubt       of what the points leave, what is to be told; empty where chance explains it.
"""

from itertools import product
from typing import Any

import numpy as np

from mdr.indenters.mapping.shape_check import REFUSED, TOLD, Left
from mdr.indenters.mapping.splines import spline
from mdr.tools.arrays import SAME, Array
from mdr.tools.checks import word

TIPS = {"any": 0.0, "round": 1.5, "sharp": 2.0, "flat": 1.0}  #: power of d that is taken out of F
#: how many of the first coefficients of F' a tip makes zero; what is tried one after the other
ZEROS = {"any": (1, 0), "round": (1,), "sharp": (2,), "flat": (0,)}
PIECES, DEGREE = 40, 3  #: of F', pieces at most


def tip_of(name: str, value: Any, note: str = "") -> str:
    """The rule of a field that names a kind of tip."""
    return word(name, value, *TIPS)


class Through:
    """The curve that meets each point (d, F) behind the touch."""

    doubt = ""

    def __init__(self, d: Array, F: Array, tip: str) -> None:
        self.is_any, self.d_1, self.F_1, self.known = tip == "any", float(d[0]), float(F[0]), TIPS[tip]
        z = np.log(d / self.d_1) if self.is_any else d / self.d_1 - 1
        self.y = spline(z, np.log(F / self.F_1) - self.known * np.log(d / self.d_1), 0.0)
        self.slope = self.y.derivative()
        first = float(self.slope(0.0))
        self.power = max(first, 1.0) if self.is_any else self.known
        self.power_to = self.d_1 if self.is_any else 0.0
        falls = self.is_any and first < 1 - SAME
        self.why = f"its slope falls at d = {self.d_1:.6g} m, so that the contact would shrink there" if falls else ""
        z = np.interp(np.arange(8 * z.size - 7) / 8, np.arange(z.size), z)
        near = np.exp(z) if self.is_any else np.concatenate([np.geomspace(1e-9, 0.99, 32), 1 + z])
        self.places = self.d_1 * near

    def force(self, d: Array) -> Array:
        """F [N] at depths d > 0."""
        return self.F_1 * np.exp(self._log(d)[0])

    def rise(self, d: Array) -> Array:
        """dF/dd [N/m] at depths d > 0."""
        y, slope = self._log(d)
        with np.errstate(under="ignore"):
            return np.asarray(self.F_1 / self.d_1 * np.exp(y - np.log(d / self.d_1)) * slope)

    def _log(self, d: Array) -> tuple[Array, Array]:
        """ln(F/F_1) and its slope over ln d."""
        if self.is_any:
            z = np.log(d / self.d_1)
            y, slope = self.y(np.maximum(z, 0)), self.slope(np.maximum(z, 0))
            return y + self.power * np.minimum(z, 0), np.where(z < 0, self.power, slope)
        z = d / self.d_1 - 1
        return self.y(z) + self.known * np.log(d / self.d_1), self.known + self.slope(z) * (1 + z)


class Near:
    """The simplest curve of a growing contact that keeps to points (d, F) behind the touch by their noise [N]."""

    def __init__(self, d: Array, F: Array, tip: str, noise: float) -> None:
        from scipy.interpolate import PPoly

        self.d_n, self.F_n, self.power_to = float(d[-1]), float(np.abs(F).max()) or 1.0, 0.0
        self.places = self.d_n * np.concatenate([np.geomspace(1e-9, 1e-3, 32), np.linspace(1e-3, 1, 8 * PIECES)])
        s, chance = np.sqrt(d / self.d_n), -1.0
        for pieces, zeros in product(range(1, max(1, min(PIECES, d.size // 4)) + 1), ZEROS[tip]):
            found = _fitted(s, F / self.F_n, pieces, zeros)
            left = Left(float(found[0]) * self.F_n, d.size, d.size - int(np.count_nonzero(found[1])))
            if left.chance(noise) > chance:
                chance, best = left.chance(noise), left
                _, share, rises, areas = found
                first = zeros + int(np.argmax(share > 0))
            if chance >= TOLD:
                break
        self.over_s, self.area = (
            PPoly(sum(c * one.c for c, one in zip(share, parts, strict=True)), parts[0].x) for parts in (rises, areas)
        )
        self.power = 1 + first / 2
        begins, self.doubt = max(first - DEGREE, 0) / (self.over_s.x.size - 1), best.doubt(noise, "N")
        if not share.any():
            self.why = "no force is above zero"
        elif chance < REFUSED:
            self.why = f"a growing contact of {PIECES} pieces or less misses the forces by {best.rms:.3g} N on average"
        elif begins:
            self.why = f"there is no force up to d = {self.d_n * begins**2:.3g} m: give depths less that of the touch"
        else:
            self.why = ""

    def force(self, d: Array) -> Array:
        """F [N] at depths d > 0."""
        return np.asarray(self.F_n * self.area(np.sqrt(d / self.d_n)))

    def rise(self, d: Array) -> Array:
        """dF/dd [N/m] at depths d > 0."""
        return np.asarray(self.F_n / self.d_n * self.over_s(np.sqrt(d / self.d_n)))


def _fitted(s: Array, F: Array, pieces: int, zeros: int) -> tuple[float, Array, list[Any], list[Any]]:
    """Root of the sum of squares that a curve of so many pieces misses F by, shares of its parts, these as F' and F."""
    from scipy.optimize import nnls

    rises = [_step(pieces, k) for k in range(zeros, pieces + DEGREE)]
    areas = [_area(one) for one in rises]
    share, norm = nnls(np.column_stack([area(s) for area in areas]), F)
    return float(norm), share, rises, areas


def _step(pieces: int, k: int) -> Any:
    """A spline from 0 to 1, whose coefficients are 0, and 1 from the k-th on."""
    from scipy.interpolate import BSpline, PPoly

    knots = np.concatenate([np.zeros(DEGREE), np.linspace(0, 1, pieces + 1), np.ones(DEGREE)])
    found = PPoly.from_spline(BSpline(knots, 1.0 * (np.arange(pieces + DEGREE) >= k), DEGREE))
    return PPoly(found.c[:, DEGREE:-DEGREE], found.x[DEGREE:-DEGREE])  # without pieces of no width


def _area(rise: Any) -> Any:
    """The integral of 2 s times a spline in s."""
    from scipy.interpolate import PPoly

    none = np.zeros((1, rise.c.shape[1]))
    moved = np.concatenate([rise.c, none]) + np.concatenate([none, rise.c]) * rise.x[:-1]
    return PPoly(2 * moved, rise.x).antiderivative()
