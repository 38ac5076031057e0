"""What every shape of indenter must answer, and how a shape answers that knows f(r) or g(x) alone.

f(r) is the shape of the rigid indenter, r from its axis, f(0) = 0; g(x) is its image in one
dimension (Popov & Heß 2015). Pressed to the depth d it touches a full disc of radius a, and

    d = g(a),   F_N = 2E* (d a − ∫₀^a g dx),   k_zc = dF_N/dd = 2E* a,
    p(r) = (E*/π) ∫_r^a g'(x) / √(x² − r²) dx,

where a rim that reaches d before the profile does adds E*(d − g(a)) / (π √(a² − r²)) to p.
Lengths r, x, d, a in m, E* and p in Pa, F_N in N; any other consistent units do as well.

A shape of one's own is a frozen dataclass with ``profile_3d`` or ``profile_1d``; the rest follows by
quadrature (`mdr.indenters.mapping.abel`), to 1e-9 or better, and every closed form it adds makes it faster.
What it has been asked for is kept (`Answers`; g from f in `mdr.indenters.mapping.chebyshev_panels`), so that a
shape must not change.
"""

import warnings
from abc import ABC
from functools import lru_cache
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.mapping import abel, chebyshev_panels, inversion
from mdr.indenters.mapping.quadrature import Function, double_exponential, in_chunks
from mdr.tools.arrays import EPS, Array
from mdr.tools.checks import between, finite_array, plain, positive_array
from mdr.tools.fields import Record, facts
from mdr.tools.memoise import is_frozen

MAPPING_ERROR = 1e-9  #: relative error of a mapped profile that is worth a warning
MOST_DEPTHS, MOST_ANSWERS = 64, 256  #: of a question that is kept, and questions that are
AHEAD = 1.5  #: times the radius of a contact, as far as its shape is looked at
FALL = 1e-9  #: of its height by which g may fall: rounding
COARSE = 1e-11  #: of d, by which g(a) misses it: more than the rounding of a where g is smooth


def _slope_angle(name: str, value: Any, note: str = "") -> float:
    return between(name, value, 0, np.pi / 2, note)


FLANK = facts(
    "rad",
    "angle between flank and plane",
    _slope_angle,
    note="angle between flank and plane in rad; 45 degrees are 0.785",
    example=0.0127,
)


class Answers(NamedTuple):
    """What was found out of a shape, so that it need not be asked twice."""

    radii: dict[bytes, Array]  #: contact radii [m], by the bytes of their depths
    rising: list[float]  #: radii [m] within which g was found to rise
    mapped: list[float]  #: radii [m] within which the map was found to be good
    reach: list[float]  #: g [m] where the shape ends, once it is known


@lru_cache(256)
def _answers(heights: Function) -> Answers:
    """The answers of a shape so far. heights: its method `_f`, which is equal to that of the very same object alone."""
    return Answers({}, [], [], [])


def _add(known: list[float], radius: float) -> None:
    """Keep a radius, and forget the oldest of many."""
    known.append(radius)
    del known[:-16]


def _among(known: list[float], radius: float) -> bool:
    """Whether one of the known radii, no more than twice as great, answers for this one too."""
    return any(radius <= one <= 2 * radius for one in known)


class Indenter(Record, ABC):
    """A rigid axisymmetric shape; give it ``profile_3d`` or ``profile_1d``."""

    _gives_g: ClassVar[bool] = False

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        cls._gives_g = cls.profile_1d is not Indenter.profile_1d
        if not cls._gives_g and cls.profile_3d is Indenter.profile_3d:
            raise TypeError(f"{cls.__name__} is no shape yet: give it profile_3d(r) or profile_1d(x)")

    def __init__(self) -> None:
        if type(self) is Indenter:
            raise TypeError("Indenter is no shape itself: use Cone(...), Profile(f) or a class of your own")

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

    def profile_3d(self, r: ArrayLike) -> Array:
        """Height f(r) of the shape above its tip [m].

        Parameters
        ----------
        r : array_like of float
            Distance from the axis [m].

        Returns
        -------
        float or ndarray
            f [m] in the shape of r.

        Raises
        ------
        ValueError
            Beyond the end of the shape (`max_radius`).
        """
        r = self._within(finite_array("r", r, "m"))
        return in_chunks(lambda r: abel.profile_3d(self.profile_1d, self._edges, r), r)

    def profile_1d(self, x: ArrayLike) -> Array:
        """Height g(x) of the one-dimensional image of the shape [m], even in x.

        Parameters
        ----------
        x : array_like of float
            Position [m].

        Returns
        -------
        float or ndarray
            g [m] in the shape of x.

        Raises
        ------
        ValueError
            Beyond the end of the shape (`max_radius`).

        Notes
        -----
        The mapping of the Method of Dimensionality Reduction (Popov and Heß 2015) ::

            g(x) = |x| ∫₀^|x| f'(r)/√(x² − r²) dr

        Examples
        --------
        >>> import mdr
        >>> mdr.Paraboloid(R=5e-3).profile_1d([1e-4, 2e-4])
        array([2.e-06, 8.e-06])
        """
        x = self._within(finite_array("x", x, "m"))
        g = chebyshev_panels.image(chebyshev_panels.HEIGHT, self._f, self._edges, np.ravel(x))
        self._check_map(np.ravel(x))
        return plain(g.reshape(x.shape))

    def contact_radius(self, d: ArrayLike) -> Array:
        """Radius a of the contact [m]: g(a) = d, and 0 where d <= 0.

        Parameters
        ----------
        d : array_like of float
            Depth [m].

        Returns
        -------
        float or ndarray
            a [m] in the shape of d.

        Raises
        ------
        ValueError
            Deeper than the shape reaches, and where the contact would be a ring.
        """
        d = finite_array("d", d, "m")
        self._refuse_beyond(d)
        asked, known = d.tobytes(), self._known
        if (found := known.radii.get(asked)) is None:
            found = np.zeros(d.size)
            pressed = d.ravel() > 0
            if pressed.any():
                found[pressed] = self._search(d.ravel()[pressed])
                self._refuse_annular(found.max())
                if d.size <= MOST_DEPTHS and _among(known.rising, found.max()):  # else it is warned of each time
                    known.radii[asked] = found
                    if len(known.radii) > MOST_ANSWERS:
                        known.radii.clear()
        return plain(found.reshape(d.shape).copy())

    def profile_area(self, a: ArrayLike) -> Array:
        """Area between the one-dimensional image and its tangent at the tip, ∫₀^a g dx [m²].

        Parameters
        ----------
        a : array_like of float
            Contact radius [m].

        Returns
        -------
        float or ndarray
            The area [m²] in the shape of a.
        """
        a = self._within(finite_array("a", a, "m"))
        if self._gives_g:
            return in_chunks(lambda a: abel.area_from_g(self.profile_1d, self._edges, a), a)
        return plain(chebyshev_panels.image(chebyshev_panels.AREA, self._f, self._edges, np.ravel(a)).reshape(a.shape))

    def force(self, d: ArrayLike, E_star: ArrayLike) -> Array:
        """Normal force F_N [N] of an elastic contact, 0 where d <= 0.

        Parameters
        ----------
        d : array_like of float
            Depth [m].
        E_star : array_like of float
            Contact modulus E* [Pa].

        Returns
        -------
        float or ndarray
            F_N = 2 E* (d a − ∫₀^a g dx) [N]. In this form it is stationary in a, so that the rounding of a does not
            show.

        Raises
        ------
        ValueError
            Deeper than the shape reaches.

        Examples
        --------
        >>> import mdr
        >>> print(f"{mdr.Paraboloid(R=5e-3).force(20e-6, E_star=4e6):.4f} N")
        0.0337 N
        """
        d, E_star = finite_array("d", d, "m"), positive_array("E_star", E_star, "Pa")
        with np.errstate(over="ignore", invalid="ignore"):
            a = self.contact_radius(d)
            F_N = 2 * E_star * (np.maximum(d, 0) * a - self.profile_area(a))
        return plain(np.maximum(self._in_range("F_N", F_N, d), 0))

    def stiffness(self, d: ArrayLike, E_star: ArrayLike) -> Array:
        """Normal stiffness k_zc = dF_N/dd = 2 E* a of the contact [N/m], 0 where d <= 0.

        Parameters
        ----------
        d : array_like of float
            Depth [m].
        E_star : array_like of float
            Contact modulus E* [Pa].

        Returns
        -------
        float or ndarray
            k_zc [N/m].
        """
        with np.errstate(over="ignore"):
            k_zc = 2 * positive_array("E_star", E_star, "Pa") * self.contact_radius(d)
        return plain(self._in_range("k_zc", k_zc, d))

    def pressure(self, r: ArrayLike, d: ArrayLike, E_star: ArrayLike) -> Array:
        """Pressure p [Pa] of an elastic contact, 0 for r >= a.

        Parameters
        ----------
        r : array_like of float
            Distance from the axis [m].
        d : array_like of float
            Depth [m].
        E_star : array_like of float
            Contact modulus E* [Pa].

        Returns
        -------
        float or ndarray
            p [Pa]. It is infinite at a sharp tip, at a kink that points down, and at the rim of a punch. The answer at
            tip and kink is the pressure one rounding away (the infinity is logarithmic); at the rim, r = a, it is 0.
        """
        r, d = np.abs(finite_array("r", r, "m")), finite_array("d", d, "m")
        a = self.contact_radius(d)
        r, d, a, E_star = np.broadcast_arrays(r, d, a, positive_array("E_star", E_star, "Pa"))
        p, inside = np.zeros(r.shape), r < a
        p[inside] = E_star[inside] * self.pressure_inside(r[inside], a[inside], d[inside])
        return plain(p)

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
        step = d - np.asarray(self.profile_1d(a))
        for _ in range(4):  # roundings that the search may be off
            if not np.any(step < -COARSE * d):
                break
            a = np.where(step < -COARSE * d, np.nextafter(a, 0), a)
            step = d - np.asarray(self.profile_1d(a))
        r = np.minimum(r, np.nextafter(a, 0))
        p = in_chunks(self._pressure_of_slope, r, a)
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

    def _pressure_of_slope(self, r: Array, a: Array) -> Array:
        """p/E* without that of a rim. Arrays (n,)."""
        if self._gives_g:
            return abel.pressure_from_slope(self._slope, self._edges, r, a)
        return abel.pressure_from_f(self._f, self._edges, r, a)

    def _slope(self, s: Array, low: float, high: float) -> Array:
        """dg/ds at x² = low² + s² between the kinks ``low`` and ``high``, for a closed form to override."""
        return abel.slope_behind(self.profile_1d, s, low, high)

    @property
    def _edges(self) -> tuple[float, ...]:
        return (0.0, *self.kinks, self.max_radius)

    @property
    def _known(self) -> Answers:
        """What was found out of this shape; nothing of one that can be changed."""
        return _answers(self._f) if is_frozen(type(self)) else Answers({}, [], [], [])

    def _f(self, r: Array) -> Array:
        """f(r) for r >= 0 as it comes out, unchecked."""
        return self.profile_3d(r)

    def _g(self, x: Array) -> Array:
        """g(x) for x >= 0 as it comes out, unchecked. Arrays (n,)."""
        if self._gives_g:
            return self.profile_1d(x)
        return abel.profile_1d(self._f, self._edges, x)

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
                f"{name} of {self!r} is beyond the range of floats at d = {np.max(np.asarray(d)):.6g} m: "
                "the shape is too flat, or pressed too deep"
            )
        return answer

    def _search(self, d: Array) -> Array:
        start = np.array(self.kinks[0] if self.kinks else min(self.max_radius / 2, 1e300))
        start = np.broadcast_to(start if self.kinks or self.max_radius < np.inf else d, d.shape)
        if self._gives_g:
            a, ended = inversion.invert(lambda x: in_chunks(self._g, x), d, start, self.max_radius)
        else:
            a, ended = chebyshev_panels.invert(self._f, self._edges, d, start)
        if ended.any():
            raise ValueError(self._why_no_radius(float(d[ended].min()), float(a[ended].min())))
        return a

    def _why_no_radius(self, d: float, end: float) -> str:
        """Message: why no radius up to ``end`` has the depth d, read off the heights from r = d on."""
        name, height = ("g(x)", self._g) if self._gives_g else ("f(r)", self._f)
        r = np.unique(np.minimum(np.geomspace(min(d, end), end, 2048), end))
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
        if not (known := self._known.reach):
            with np.errstate(all="ignore"):
                known.append(float(self._g(np.array([self.max_radius]))[0]))
        reach = known[-1]
        if d.max() > reach * (1 + 64 * EPS):
            raise ValueError(f"d = {d.max():.6g} m is deeper than {type(self).__name__} {self._why_too_deep(reach)}")

    def _refuse_annular(self, a: float) -> None:
        """A g that falls has no unique a(d): the contact would be a ring, which the method leaves out."""
        known = self._known
        if _among(known.rising, a):
            return
        x = np.unique(a * np.concatenate([np.linspace(0.01, 1, 64), np.geomspace(1e-6, 0.01, 12)]))
        mapped = self._check_map(x[::10])
        ahead = np.linspace(a, min(AHEAD * a, self.max_radius), 33)  # for contacts that are a little wider
        with np.errstate(all="ignore"):
            g, more = in_chunks(self._g, x), in_chunks(self._g, ahead)
            further = float(np.nan_to_num(more[1], posinf=0.0))  # at a flat face g is rounding up to a
            refuse_falling(self, x, g, further)
            rises = np.all(np.diff(more) >= -FALL * np.abs(more[-1]))  # NaN does not
            good = rises and np.isfinite(more[-1]) and self._map_error(ahead[::8]) <= MAPPING_ERROR
        if mapped:
            _add(known.rising, float(ahead[-1]) if good else a)
            _add(known.mapped, known.rising[-1])

    def _check_map(self, x: Array) -> bool:
        """Whether two quadrature rules agree on g(x), with a warning if not; ValueError where g is not finite."""
        known = self._known.mapped
        if self._gives_g or x.size == 0 or _among(known, x.max()):
            return True
        error = self._map_error(np.unique(np.quantile(x, np.linspace(0, 1, 7), method="nearest")))
        if not np.isfinite(error):
            raise ValueError(
                f"{type(self).__name__} has no finite slope within r = {x.max():.6g} m: name its end (r_max)"
            )
        if error > MAPPING_ERROR:
            warnings.warn(
                f"{type(self).__name__} is mapped to g(x) with an error of about "
                f"{error:.1e} of its height: "
                "name every radius where f or its slope is not smooth in kinks=",
                stacklevel=3,
            )
            return False
        _add(known, float(x.max()))
        return True

    def _map_error(self, x: Array) -> float:
        """Difference of two quadrature rules, over the height; infinite where g is not finite."""
        if self._gives_g:
            return 0.0
        g, other = (abel.profile_1d(self._f, self._edges, x, double_exponential(step)) for step in (0.11, 0.077))
        height = np.max(np.abs(g))
        return float(np.max(np.abs(g - other)) / (height or 1.0)) if np.isfinite(height) else np.inf


def rim_pressure(r: Array, a: Array, step: Array) -> Array:
    """p/E* of a rim that stands ``step`` = d − g(a) below the profile: step / (π √(a² − r²))."""
    share = r / a
    answer: Array = step / (np.pi * a * np.sqrt((1 - share) * (1 + share)))
    return answer


def refuse_falling(shape: Indenter, x: Array, g: Array, further: float = 0.0) -> None:
    """ValueError if g falls anywhere along ascending x by more than rounding; ``further`` is g a little further out."""
    highest = np.maximum.accumulate(np.maximum(g, 0))
    fall = highest - g > FALL * np.max(np.abs(g), initial=further)
    if np.any(fall):
        raise ValueError(
            f"annular contact: the one-dimensional profile of {type(shape).__name__} falls at x = "
            f"{x[fall][0]:.6g} m, so that a ring touches before the disc inside it; the method needs a full "
            "disc: choose a shape whose g(x) rises"
        )
