"""What follows of a shape that knows f(r) or g(x) alone, by quadrature: the other one, the area, the radius of contact.

A shape is mapped within a radius at a time, and surveyed there: whether it is a shape, and how well it is mapped. What
a frozen shape has been asked for is kept (`survey`, `image_of`).
"""

import warnings
from abc import ABC
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.mapping import abel, inversion
from mdr.indenters.mapping.chebyshev_panels import Chart
from mdr.indenters.mapping.quadrature import double_exponential, in_chunks
from mdr.indenters.mapping.shape_check import AGREE, FINE, GRID, bends_down, why_no_shape
from mdr.tools.arrays import EPS, SAME, Array
from mdr.tools.fields import Record
from mdr.tools.memoise import remembered

SAMPLES = 2048  #: heights among which a step, or a dip, stands out
COARSE = 1e-11  #: of d, by which g(a) misses it: more than the rounding of a where g is smooth


class Mapped(Record, ABC):
    """A shape by its `_f` or `_g`, asked for distances from the axis that are checked; each follows from the other."""

    _gives_g: ClassVar[bool] = False

    @property
    def kinks(self) -> tuple[float, ...]:
        """Radii > 0 where f, and with it g, is not smooth [m]; springs, quadrature and plots take account of them."""
        return ()

    @property
    def joints(self) -> tuple[float, ...]:
        """Kinks, and the radii at which the pieces of a curve meet as smoothly as those of a spline [m]."""
        return self.kinks

    @property
    def max_radius(self) -> float:
        """Largest contact radius the shape can have [m]; inf for a shape without end."""
        return np.inf

    @property
    def least_depth(self) -> float:
        """Depth [m] from which the contact is a full disc: 0 but for a hollow shape, which begins as a ring."""
        return 0.0

    def pressure_inside(self, r: Array, a: Array, d: Array) -> Array:
        """Pressure over E* [-] where the shape touches; a shape may override it by a closed form.

        Parameters
        ----------
        r : ndarray, shape (n,)
            Distance from the axis [m], 0 <= r < a.
        a : ndarray, shape (n,)
            Contact radius a(d) [m].
        d : ndarray, shape (n,)
            Depth [m].

        Returns
        -------
        ndarray, shape (n,)
            p/E* [-].

        Notes
        -----
        Just outside a flat face g rises to d within a rounding of a. The step left to d presses like a rim.
        """
        step = d - self._g(a)
        for _ in range(4):  # roundings that the search may be off
            if not np.any(step < -COARSE * d):
                break
            a = np.where(step < -COARSE * d, np.nextafter(a, 0), a)
            step = d - self._g(a)
        r = np.minimum(r, np.nextafter(a, 0))
        edges = (0.0, *self.joints, self.max_radius)
        p = in_chunks(lambda r, a: abel.pressure_from_slope(self._slope, edges, r, a), r, a)
        rim = (a >= self.max_radius) | (step > COARSE * d)
        p[rim] += rim_pressure(r[rim], a[rim], step[rim])
        return p

    def depth_about(self, V: float) -> float:
        """A depth [m] of the size of that at which F_N/E* = V, to begin a search with.

        Only heights are asked for: far from its tip a shape may have none, and raise an error if it is pressed too
        deep.

        Parameters
        ----------
        V : float
            Normal force over E* [m²].

        Returns
        -------
        float
            V ~ a d with d ~ f(a) [m].
        """
        height = self._g if self._gives_g else self._f

        def short(r: float) -> bool:
            with np.errstate(all="ignore"):
                return bool(r * height(np.array([r]))[0] < V)

        r = min(float(np.sqrt(V)), self.max_radius)
        while r < min(self.max_radius, 1e150) and short(r):
            r = min(2 * r, self.max_radius)
        while V / r < np.inf and not short(r):
            r /= 2
        return V / r

    def _slope(self, s: Array, low: float, high: float) -> Array:
        """dg/ds at x² = low² + s² between the kinks ``low`` and ``high``, for a closed form to override."""
        return abel.slope_behind(self._g, s, low, high)

    @property
    def _edges(self) -> tuple[float, ...]:
        return (0.0, *self.kinks, self.max_radius)

    def _f(self, r: Array) -> Array:
        """f(r) as it comes out."""
        return in_chunks(lambda r: abel.profile_3d(self._g, self._edges, r), r)

    def _g(self, x: Array) -> Array:
        """g(x) as it comes out."""
        return image_of(self)(x)

    def _area(self, a: Array) -> Array:
        """∫₀^a g dx as it comes out."""
        if self._gives_g:
            return in_chunks(lambda a: abel.area_from_g(self._g, self._edges, a), a)
        return area_of(self)(a)

    def _directly(self, x: Array) -> Array:
        """g(x) without the panels of a mapped shape, which are many where few places are asked for."""
        return self._g(x) if self._gives_g else image_of(self).direct(x)

    def _within(self, r: Array) -> Array:
        """Distance from the axis, refused where the shape has ended."""
        r = np.abs(r)
        if np.any(r > self.max_radius):
            raise ValueError(
                f"{type(self).__name__} ends at r = {self.max_radius:.6g} m, got {np.max(r):.6g} m: "
                "stay within it or describe the shape further out"
            )
        return r

    def _in_range(self, name: str, answer: Array, d: ArrayLike) -> Array:
        """The answer; ValueError where it is not finite, as one of its terms is beyond the range of floats."""
        if not np.all(np.isfinite(answer)):
            raise ValueError(
                f"{name} of {self!r} is beyond the range of floats at {np.max(np.asarray(d)):.6g} m: "
                "the shape is too flat, or pressed too deep"
            )
        return answer

    def _search(self, d: Array) -> Array:
        start = np.array(self.kinks[0] if self.kinks else min(self.max_radius / 2, 1e300))
        start = np.broadcast_to(start if self.kinks or self.max_radius < np.inf else d, d.shape)
        if self._gives_g:
            a, ended = inversion.invert(lambda x: in_chunks(self._g, x), d, start, self.max_radius)
        else:
            a, ended = image_of(self).invert(d, start)
        if ended.any():
            raise ValueError(self._why_no_radius(float(d[ended].min()), float(a[ended].min())))
        return a

    def _why_no_radius(self, d: float, end: float) -> str:
        """Message: why no radius up to ``end`` has the depth d, read off the heights from r = d on."""
        name, height = ("g(x)", self._g) if self._gives_g else ("f(r)", self._f)
        r = np.unique(np.minimum(np.geomspace(min(d, end), end, SAMPLES), end))
        with np.errstate(all="ignore"):
            heights, further = height(r), height(np.array([min(2 * end, np.finfo(float).max)]))[0]
        known = np.isfinite(heights)
        below = known & (heights < 0)
        if below.any():
            return (
                f"{type(self).__name__} falls below its tip, from which the depth counts: {name} = "
                f"{heights[below][0]:.6g} m at {r[below][0]:.6g} m from the axis; check its sign, "
                "or end it before (r_max)"
            )
        highest = np.max(heights[known], initial=further)
        if highest < d:  # not where nothing is known further out
            return (
                f"{type(self).__name__} never gets as high as d = {d:.6g} m: {name} stays at or below "
                f"{highest:.6g} m however far out; press less"
            )
        return (
            f"{type(self).__name__} has no finite height beyond r = {end:.6g} m, but at the depth d = {d:.6g} m "
            "more of it touches: press less, or give r_max"
        )

    def _why_too_deep(self, reach: float) -> str:
        """Second half of the message about a depth beyond ``reach``, where the whole face touches."""
        return (
            f"reaches: its whole face, r <= {self.max_radius:.6g} m, touches at {reach:.6g} m; "
            "press less or describe more of it"
        )

    def _refuse_beyond(self, d: Array) -> None:
        if d.size == 0 or not d.max() > 0 or self.max_radius == np.inf:
            return
        with np.errstate(all="ignore"):
            reach = float(self._directly(np.array([self.max_radius]))[0])
        if d.max() > reach * (1 + 64 * EPS):
            raise ValueError(f"d = {d.max():.6g} m is deeper than {type(self).__name__} {self._why_too_deep(reach)}")

    def _refuse_annular(self, a: float) -> None:
        """ValueError unless it is a shape up to the contact radius a [m]; a g that falls has no unique a(d)."""
        if found := self._mapped(a).why_not:
            raise ValueError(f"{type(self).__name__} is no shape within r = {a:.6g} m: {found}")

    def _refuse_other_radii(self, d: Array, a: Array) -> None:
        """ValueError unless radii are those of a shape at depths, and those that g has there."""
        order = np.argsort(d, axis=None)
        d, a = np.clip(d.ravel()[order], 0, None), np.broadcast_to(a, d.shape).ravel()[order]
        if not np.any(d > 0):
            return
        wrong = why_no_shape(d, a)
        if not wrong and self.least_depth == 0:
            self._refuse_annular(float(a[-1]))
            inner, outer = self._g(a * (1 - AGREE)), self._g(np.minimum(a * (1 + AGREE), self.max_radius))
            off = (inner > d + AGREE * d[-1]) | ((outer < d - AGREE * d[-1]) & (a < self.max_radius * (1 - AGREE)))
            if np.any(off):
                i = int(np.argmax(off))
                wrong = f"its contact_radius is {a[i]:.6g} m at d = {d[i]:.6g} m, where g(x) = {self._g(a)[i]:.6g} m"
        if wrong:
            raise ValueError(f"{type(self).__name__} is no shape: {wrong}")

    def _mapped(self, radius: float) -> "Survey":
        """How g is within a radius > 0 [m], or to the next power of two where all is well that far.

        Warns where two quadrature rules disagree, refuses where g is not finite.
        """
        with np.errstate(all="ignore"):
            further = float(min(2 ** np.ceil(np.log2(radius)), self.max_radius))
        found = survey(self, further)
        if found.why_not or found.error > SAME:
            found = survey(self, radius)
        if not np.isfinite(found.error):
            why = found.why_not or "it has no finite slope: name its end (r_max)"
            raise ValueError(f"{type(self).__name__} is no shape within r = {radius:.6g} m: {why}")
        if found.error > SAME:
            warnings.warn(
                f"{type(self).__name__} is mapped to g(x) with an error of about {found.error:.1e} of its height: "
                "name every radius where f or its slope is not smooth in kinks=",
                stacklevel=4,
            )
        return found


@remembered(64)
def image_of(shape: Mapped) -> Chart:
    """The image g(x) of a shape that gives f."""
    return Chart(abel.profile_1d, shape._f, shape._edges)


@remembered(64)
def area_of(shape: Mapped) -> Chart:
    """The area below it."""
    return Chart(abel.area_from_f, shape._f, shape._edges)


class Survey(NamedTuple):
    """How a shape is mapped within a radius."""

    why_not: str  #: what is wrong with it there, and where; empty for a shape
    error: float  #: difference of two quadrature rules, over the height; infinite where g is not finite


@remembered(256)
def survey(shape: Mapped, radius: float) -> Survey:
    """What g, and F_N with it, are at places within a radius [m], and how good g is."""
    with np.errstate(all="ignore"):
        r = radius * (np.append(0, FINE) if shape._gives_g else np.linspace(0, 1, SAMPLES + 1))
        heights = (shape._g if shape._gives_g else shape._f)(r)
        if not (known := np.isfinite(heights)).all():
            end = r[np.argmin(known)]
            return Survey(f"it has no finite height at {end:.6g} m from the axis: name its end (r_max)", np.inf)
        if abs(heights[0]) > SAME * np.max(np.abs(heights)):
            return Survey(f"its height is {heights[0]:.6g} m on the axis, where the depth counts from 0", np.inf)
        error = _error_of_map(shape, radius)
        further = shape._directly(np.array([min(1.02 * radius, shape.max_radius)]))
        x = radius * (FINE if shape._gives_g else GRID)
        g, area = shape._directly(x), shape._area(x) if shape._gives_g else area_of(shape).direct(x)
        if not shape._gives_g and (some := bends_down(heights, r)).size:
            edges = tuple(np.unique([*shape._edges, *some]).tolist())  # windows of a derivative may miss a dip
            more = some, abel.profile_1d(shape._f, edges, some), abel.area_from_f(shape._f, edges, some)
            x, g, area = (np.append(*two) for two in zip((x, g, area), more, strict=True))
            x, g, area = (one[np.argsort(x)] for one in (x, g, area))
        V = 2 * (g * x - area)
    height = max(float(np.max(np.abs(g))), float(np.nan_to_num(further[0], posinf=0.0)))
    near = SAME * height / (np.max(np.abs(g)) or 1.0)  # at a flat face g is rounding up to a
    # F_N may be off by up to 1e-3 where a warning tells of a kink that is not named
    return Survey(why_no_shape(g, x, V, near, min(10 * error, 1e-3)), error)


def _error_of_map(shape: Mapped, radius: float) -> float:
    """Difference of two quadrature rules for g, or for the area below a given g, over its height."""
    x, rule = radius * GRID[::10], double_exponential(0.077)
    if shape._gives_g and type(shape)._area is not Mapped._area:
        return 0.0
    if shape._gives_g:
        one, other = shape._area(x), in_chunks(lambda a: abel.area_from_g(shape._g, shape._edges, a, rule), x)
    else:
        one, other = shape._directly(x), abel.profile_1d(shape._f, shape._edges, x, rule)
    return float(np.nan_to_num(np.max(np.abs(one - other)) / (np.max(np.abs(one)) or 1.0), nan=np.inf))


def rim_pressure(r: Array, a: Array | float, step: Array | float) -> Array:
    """p/E* of a rim that stands ``step`` = d − g(a) below the profile: step / (π √(a² − r²))."""
    share = r / a
    answer: Array = step / (np.pi * a * np.sqrt((1 - share) * (1 + share)))
    return answer
