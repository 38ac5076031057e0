"""A shape known at measured points: a spline through them, whose image g follows exactly (`mapping.splines`)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from os import PathLike, fsdecode
from typing import Any

import numpy as np

from mdr.indenters.base import Indenter
from mdr.indenters.mapping.quadrature import in_chunks
from mdr.indenters.mapping.shape_check import FINE, Left, told_smoothing, why_no_shape, why_not
from mdr.indenters.mapping.splines import DEGREE, SplineImage, fit
from mdr.tools.arrays import SAME, Array
from mdr.tools.checks import finite, finite_array, in_range, not_negative, positive, word
from mdr.tools.csv_header import Columns, Reading, Units, fault
from mdr.tools.fields import facts
from mdr.tools.warned import warn_outside

MOST_JOINTS = 100  #: pieces of a spline that quadratures heed one by one; what they miss of more is little
NOISE = "standard deviation of the noise of the data"
RADII = tuple(round(2e-4 * i, 9) for i in range(8))  #: of the example [m]
HEIGHTS = tuple(round(4e-7 * i**2, 9) for i in range(8))  #: of a paraboloid [m]


def column(name: str, values: Any, unit: str) -> tuple[float, ...]:
    """Measured numbers in a row (n,)."""
    array = finite_array(name, values, unit)
    if array.ndim != 1:
        raise ValueError(f"{name} must be one row of numbers in {unit}, got an array of shape {array.shape}")
    return tuple(array.tolist())


def radii(name: str, values: Any, note: str = "") -> tuple[float, ...]:
    """Different radii > 0 in ascending order."""
    try:
        return tuple(sorted({positive(name, b, "radius in m") for b in values}))
    except TypeError as not_radii:
        raise TypeError(f"{name} must be a sequence of radii in m, got {values!r}") from not_radii


def _tip(name: str, value: Any, note: str = "") -> str:
    return word(name, value, "round", "sharp")


@dataclass(frozen=True, repr=False)
class SampledProfile(Indenter):
    """A shape through measured points (r, f): a quintic spline in r, four times continuously differentiable.

    r ascends from 0. Heights count from f at r = 0, wherever the zero of the instrument is. A "round" tip has no
    corner: the spline is even in r, as f ~ r² needs. A "sharp" tip may begin with any slope, like a cone. Where the
    slope jumps, name that r in ``kinks``. For noisy heights ``smoothing`` is their standard deviation: the spline keeps
    that far from the points on average, and a warning says where it has to bend more for this than noise explains.
    Without it the spline follows the noise, until g falls and is refused.

    200 even points of a sphere up to a = R/2 give g and F_N to 1e-11, 50 to 1e-8, 20 to 1e-6. Nothing is known beyond
    r[-1]: a contact that would reach further is refused.

    Examples
    --------
    >>> import mdr, numpy as np
    >>> r = np.linspace(0, 2e-3, 21)
    >>> tip = mdr.SampledProfile(r, r**2 / 10e-3)
    >>> print(f"{tip.contact_radius(20e-6):.3g} m, {mdr.Paraboloid(R=5e-3).contact_radius(20e-6):.3g} m")
    0.000316 m, 0.000316 m
    """

    r: tuple[float, ...] = field(metadata=facts("m", "radii of the points", column, note="m", example=RADII))
    f: tuple[float, ...] = field(metadata=facts("m", "heights at them", column, note="m", example=HEIGHTS))
    tip: str = field(default="round", kw_only=True, metadata=facts("", "round or sharp", _tip))
    kinks: tuple[float, ...] = field(
        default=(), kw_only=True, metadata=facts("m", "radii of points at which the slope jumps", radii)
    )
    smoothing: float = field(default=0.0, kw_only=True, metadata=facts("m", NOISE, not_negative))

    def __post_init__(self) -> None:
        super().__post_init__()
        require_pairs("r", self.r, "f", self.f, DEGREE + 1)
        if (first := self.r[0]) != 0:
            way_out = (
                "give one side of a mirrored profile" if first < 0 else "sort the points by r and add f at the tip"
            )
            what = f"r must begin at 0, the tip from which the depth counts, got {first:.6g} m: {way_out}"
            raise ValueError(what)
        require_ascent("r", self.r)
        if (range_of_f := max(self.f) - min(self.f)) == 0:
            raise ValueError(f"f is {self.f[0]:.6g} m at every r, a flat face: use FlatPunch(a={self.r[-1]!r})")
        if self.smoothing >= range_of_f:
            raise ValueError(
                f"smoothing = {self.smoothing:.6g} m is the noise of the heights, which differ by {range_of_f:.6g} m "
                "in all: give it in m"
            )
        self._require_points(self.kinks)
        r, f = np.array(self.r), np.array(self.f)
        with in_range(f"a shape of the height {range_of_f:.6g} m and the radius {r[-1]:.6g} m"):
            if why := why_not(self, r, f, "m"):
                raise ValueError(f"{why}; {self._way_out_of_a_kink()}; {told_smoothing(self, r, f, 'm')}")
        if self._doubt:
            warn_outside(self._doubt)

    def _why_no_shape(self) -> str:
        """What is wrong with the contact at the ends of all pieces, in their middles and between; empty for a shape."""
        ends = self._image.ends
        x = np.unique(np.concatenate([ends[1:], (ends[1:] + ends[:-1]) / 2, ends[-1] * FINE]))
        g, V = self._image.contacts(x)
        return why_no_shape(g, x, V)

    def _refuse_annular(self, a: float) -> None:
        """Asked when it was made."""

    @classmethod
    def read(
        cls,
        path: str | PathLike[str],
        *,
        units: Units = None,
        columns: Columns = None,
        skip: int | None = None,
        table: int | str | None = None,
        pitch: float | None = None,
        apex: float = 0.0,
        side: str = "both",
        flip: bool = False,
        tip: str = "round",
        kinks: Sequence[float] = (),
        smoothing: float = 0.0,
    ) -> SampledProfile:
        r"""The shape of a measured profile in a CSV file.

        Parameters
        ----------
        path : str or path-like
            The file. Its header names radius and height with their units: `r [um], f [nm]`. Rows in any order.
        units : dict of str, optional
            Units of columns whose header has none: {"r": "um", "f": "nm"}.
        columns : dict of str or int, optional
            What the header calls a column, {"r": "Position", "f": "Z"}, or its number, from 1.
        skip : int, optional
            Lines above the header. None finds it.
        table : int or str, optional
            Which table of a file with several, from 1, or words above it.
        pitch : float, optional
            Step from height to height [m], in the place of radii: they are even, from 0.
        apex : float
            Where the tip is along the scan [m]; one of the points.
        side : str
            "right" or "left" of the tip, or "both": a scan across the tip is laid upon its mirror image, and the mean
            is taken of two heights at one radius.
        flip : bool
            True for a tip that was measured pointing up, so that heights fall away from it.
        tip : str
            "round" or "sharp".
        kinks : sequence of float
            Radii of points at which the slope jumps [m].
        smoothing : float
            Standard deviation of the noise of the heights [m].

        Returns
        -------
        SampledProfile
            The shape.

        Raises
        ------
        ValueError
            With file and line of what is wrong.

        Examples
        --------
        >>> from pathlib import Path
        >>> import mdr
        >>> points = "".join(f"{x}, {50 * x * x}\n" for x in range(-6, 7))
        >>> _ = Path("scan.csv").write_text("x [um], height [nm]\n" + points)
        >>> mdr.SampledProfile.read("scan.csv")
        SampledProfile(7 points to r = 6e-06 m, tip='round')
        """
        from mdr.files.profiles import profile_points

        r, f = profile_points(path, Reading(units, columns, skip, table), finite("apex", apex), side, flip, pitch)
        nearest = {b: float(r[np.argmin(np.abs(r - b))]) for b in radii("kinks", kinks)}
        named = tuple(to if abs(to - b) <= SAME * r[-1] else b for b, to in nearest.items())
        try:
            return cls(r, f, tip=tip, kinks=named, smoothing=smoothing)  # type: ignore[arg-type]
        except ValueError as refusal:
            raise fault(fsdecode(path), str(refusal)) from None

    @property
    def joints(self) -> tuple[float, ...]:
        """The radii of the points [m], or the kinks where there are so many points that what they miss is little."""
        return self.r[1:-1] if len(self.r) <= MOST_JOINTS else self.kinks

    @property
    def max_radius(self) -> float:
        """r[-1] [m]."""
        return self.r[-1]

    def _f(self, r: Array) -> Array:
        return in_chunks(self._image.height, r)

    def _g(self, x: Array) -> Array:
        return in_chunks(self._image.image, x)

    def _area(self, a: Array) -> Array:
        return in_chunks(self._image.area, a)

    def _slope(self, s: Array, low: float, high: float) -> Array:
        return self._image.slope(s, low)

    def __repr__(self) -> str:
        known = [f"{len(self.r)} points to r = {self.r[-1]:.6g} m", f"tip={self.tip!r}"]
        known += [f"kinks={self.kinks!r}"] if self.kinks else []
        known += [f"smoothing={self.smoothing!r}"] if self.smoothing else []
        return f"SampledProfile({', '.join(known)})"

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_fitted"}

    @property
    def _image(self) -> SplineImage:
        return self._fitted[0]

    @property
    def _doubt(self) -> str:
        """What is to be told of what the points leave."""
        return self._fitted[1].doubt(self.smoothing, "m") if self.smoothing else ""

    @cached_property
    def _fitted(self) -> tuple[SplineImage, Left]:
        """The spline with its image, and what it leaves of the points."""
        r, f = np.array(self.r), np.array(self.f)
        cuts = [0, *np.searchsorted(r, self.kinks), r.size - 1]
        ends, pieces, lefts, height = [np.zeros(1)], [], [], 0.0
        for first, last in pairwise(cuts):
            even = first == 0 and self.tip == "round"
            x, y = r[first : last + 1] - (0 if even else r[first]), f[first : last + 1]
            some, c, left = fit(x, y, self.smoothing, even)
            lefts.append(left)
            c[:, 0] += height - c[0, 0]  # begins where the one before ended, at 0 in the first place
            height = float(c[-1].sum())
            ends.append(some[1:] + (0 if even else r[first]))
            pieces.append(np.pad(c, ((0, 0), (0, 6 - c.shape[1]))))
        radii = np.concatenate(ends)
        radii[-1] = r[-1]
        radii[np.cumsum([0, *map(len, pieces)])] = r[cuts]
        norms, points, spare = zip(*lefts, strict=True)
        left = Left(float(np.linalg.norm(norms)), sum(points), sum(spare))
        return SplineImage(radii, np.concatenate(pieces), self.kinks), left

    def _way_out_of_a_kink(self) -> str:
        """What to name, and where, if a change of slope stands out among those at the inner points."""
        r, slopes = np.array(self.r), np.diff(self.f) / np.diff(self.r)
        turns = np.where(np.isin(r[1:-1], self.kinks), 0.0, np.abs(np.diff(slopes)))
        # a kink stands out by 10 median changes of slope; noise of 200 points stays below 8
        if turns.max() <= max(10.0 * np.median(turns), SAME * np.abs(slopes).max()):
            return "if its slope jumps at one of the r, name that in kinks="
        b = float(r[1 + turns.argmax()])
        named = tuple(sorted({*self.kinks, b}))
        return f"if its slope jumps at r = {b!r} m, where it changes most, give kinks={named!r}"

    def _require_points(self, kinks: Sequence[float]) -> None:
        """ValueError unless each is one of the points between the first and the last."""
        strange = [b for b in kinks if b not in self.r[1:-1]]
        if strange:
            nearest = min(self.r, key=lambda r: abs(r - strange[0]))
            raise ValueError(
                f"kinks must be among the r between the first and the last, got {strange[0]!r} m: "
                f"the nearest is {nearest!r} m; add a point there"
            )


def require_pairs(name: str, x: Sequence[float], other: str, y: Sequence[float], least: int) -> None:
    """ValueError unless there are as many of the one as of the other, and enough."""
    if len(x) != len(y):
        raise ValueError(f"{other} must have as many numbers as {name}, got {len(y)} and {len(x)}")
    if len(x) < least:
        raise ValueError(f"{name} must have at least {least} numbers, got {len(x)}")


def require_ascent(name: str, x: Sequence[float]) -> None:
    """ValueError unless each number is above the one before."""
    if why := not_ascending(name, x):
        raise ValueError(f"{why}: sort the points by {name} and take the mean of those at the same {name}")


def not_ascending(name: str, x: Sequence[float]) -> str:
    """Where a number is not above the one before; empty if each is."""
    falls = np.flatnonzero(np.less_equal(x[1:], x[:-1]))
    if not falls.size:
        return ""
    i = int(falls[0])
    return f"{name} must ascend, got {x[i]:.6g} and then {x[i + 1]:.6g} (numbers {i + 1} and {i + 2})"
