"""What every shape is held to: pressed deeper it touches more, and presses harder.

With the depth d, the radius a of a full disc of contact and V = F_N/E*, from one state of contact to the next

    0 <= a,   a_1 <= a_2,   0 <= d_1 <= d_2,   2 a_1 (d_2 − d_1) <= V_2 − V_1 <= 2 a_2 (d_2 − d_1),

as dF_N/dd = 2E*a. What is made of data, of a function or by a class of a user is asked for such states on a grid.
"""

from collections.abc import Callable
from copy import copy
from functools import wraps
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mdr.tools.arrays import SAME, Array
from mdr.tools.checks import finite_array

Method = Callable[..., Array]

GRID = np.unique(np.concatenate([np.linspace(0.01, 1, 64), np.geomspace(1e-6, 0.01, 12)]))  #: radii, many at the tip
FINE = np.unique(np.append(GRID, np.linspace(0, 1, 513)[1:]))  #: where they cost little
NEGATIVE = "the contact radius is {a:.6g} m {place}, where it must be positive"
SHRINKS = "the contact radius falls at d = {d:.6g} m, so that the contact would shrink there"
FALLS = (
    "annular contact: its one-dimensional profile g falls at x = {a:.6g} m, so that a ring touches before the disc "
    "inside it; the method needs a full disc: choose a shape whose g(x) rises"
)
MANY = 300  #: points; through fewer a spline that follows the noise is found at once; its time goes as their square
#: chances of what points leave, of two and three standard deviations: it is told, or the curve is none
TOLD, REFUSED = 0.0455, 0.0027
AGREE = 1e-6  #: of the greatest: by which two ways to one quantity may differ in a user's class


def why_no_shape(d: Array, a: Array, V: Array | None = None, near: float = SAME, near_V: float = 0.0) -> str:
    """What is wrong with ascending states of contact (n,), and where; empty where they are those of a shape.

    near, near_V: of the greatest value, by which one may be off, and V at least.
    """
    known = {"g": d, "a": a} | ({} if V is None else {"F_N/E*": V})
    with np.errstate(all="ignore"):
        for name, values in known.items():
            if not np.isfinite(values).all():
                i = int(np.argmin(np.isfinite(values)))
                return f"{name} is {values[i]:.6g} {_place(i, d, a)}, where it must be finite"
        below = (a < 0) | ((a == 0) & (d > near * d.max()))
        shrinks = np.maximum.accumulate(a) - a > near * a.max()
        falls = np.maximum.accumulate(np.maximum(d, 0)) - d > near * np.abs(d).max()
        for wrong, words in ((below, NEGATIVE), (shrinks, SHRINKS), (falls, FALLS)):
            if wrong.any():
                i = int(np.argmax(wrong))
                return words.format(d=d[i], a=a[i], place=_place(i, d, a))
        return "" if V is None else _not_the_force(d, a, V, max(near, near_V) * a.max() * d.max())


def _not_the_force(d: Array, a: Array, V: Array, spare: float) -> str:
    """What is wrong with forces over E*, by more than is spare."""
    rise, least, most = np.diff(V), 2 * a[:-1] * np.diff(d), 2 * a[1:] * np.diff(d)
    wrong = (rise < least - spare) | (rise > most + spare)
    if not wrong.any():
        return ""
    i = int(np.argmax(wrong))
    return (
        f"F_N/E* rises by {rise[i]:.6g} m² between d = {d[i]:.6g} and {d[i + 1]:.6g} m, where 2 a, by which it must "
        f"rise per depth, is {2 * a[i]:.6g} to {2 * a[i + 1]:.6g} m"
    )


def bends_down(f: Array, r: Array) -> Array:
    """Radii, of r (n,), behind where r f' falls most: where it rises g does, as dg/dx = ∫₀^{π/2} (r f')' dt."""
    turn = np.diff((r[1:] + r[:-1]) / 2 * np.diff(f))
    deepest = np.argsort(turn)[:4]
    deepest = deepest[turn[deepest] < -SAME * np.max(np.abs(turn))]
    return np.unique(r[np.minimum(deepest[:, None] + np.arange(1, 5), r.size - 1)])


def real(name: str, own: Method) -> Method:
    """A profile of a user's class, which must answer as many real numbers as it is asked for."""

    @wraps(own)
    def answered(self: Any, r: Array) -> Array:
        return as_heights(f"{name} of {type(self).__name__}", own(self, r), r)

    return answered


def as_heights(who: str, answer: Any, r: Array) -> Array:
    """What a user's function answers to radii, as float64 in their shape."""
    heights = np.asarray(answer)
    if heights.dtype.kind not in "iufb" or heights.shape not in ((), np.shape(r)):
        raise TypeError(f"{who} must answer an array of radii with as many real heights, got {heights!r}")
    return np.broadcast_to(heights.astype(np.float64, copy=False), np.shape(r))


def held(own: Method, expected: Method) -> Method:
    """A method of a user's class, held to what follows from g whenever it is asked."""
    name = expected.__name__

    @wraps(own)
    def answered(self: Any, d: ArrayLike, *given: Any, **named: Any) -> Array:
        answer = own(self, d, *given, **named)
        with np.errstate(all="ignore"):
            if name == "contact_radius":
                self._refuse_other_radii(finite_array("d", d, "m"), np.asarray(answer, dtype=float))
                return answer
            follows = expected(self, d, *given, **named)
            off = np.abs(np.asarray(answer) - follows)
            if not np.all(off <= AGREE * np.max(np.abs(follows), initial=0.0)):
                i = np.unravel_index(np.argmax(np.nan_to_num(off, nan=np.inf)), np.shape(off))
                raise ValueError(
                    f"{name} of {type(self).__name__} answers {np.asarray(answer)[i]:.6g} where its g(x) makes it "
                    f"{np.asarray(follows)[i]:.6g}, at d = {np.broadcast_to(d, np.shape(off))[i]:.6g} m: correct it, "
                    "or leave it out"
                )
        return answer

    return answered


def finite_answer(own: Method) -> Method:
    """A method of a shape that refuses an answer beyond the range of floats, and does not warn of it."""

    @wraps(own)
    def answered(self: Any, at: ArrayLike, *given: Any, **named: Any) -> Array:
        with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
            answer = own(self, at, *given, **named)
        return np.asarray(self._in_range(own.__name__, answer, at))[()]

    return answered


def noise_of(x: Array, y: Array) -> float:
    """About the standard deviation of the noise of y: the median of its fourth differences, over what noise of 1 makes.

    These are how far the distances from the line through both neighbours are from such a line themselves.
    """
    s = (x[1:-1] - x[:-2]) / (x[2:] - x[:-2])
    off = y[1:-1] - (1 - s) * y[:-2] - s * y[2:]
    t = s[1:-1]
    off = off[1:-1] - (1 - t) * off[:-2] - t * off[2:]
    shares = (1 - t) * (1 - s[:-2]), 2 * t - 2, 1 + (1 - t) * s[:-2] + t * (1 - s[2:]), -2 * t, t * s[2:]
    return float(np.median(np.abs(off) / np.sqrt(sum(share**2 for share in shares))) / 0.6745)


class Left(NamedTuple):
    """What points leave of a curve that passes by them."""

    norm: float  #: root of the sum of squares, in the unit of the points
    n: int  #: points
    spare: float  #: points less the free numbers of the curve

    @property
    def rms(self) -> float:
        """Root mean square distance of the points."""
        return float(self.norm / np.sqrt(self.n))

    def chance(self, noise: float) -> float:
        """That noise of this standard deviation leaves as much or more: chi squared."""
        from scipy.stats import chi2

        return float(chi2.sf((self.norm / noise) ** 2, self.spare)) if self.spare > 0 else 0.0

    def doubt(self, noise: float, unit: str) -> str:
        """What to say where it is more than noise explains; empty where it is not."""
        if self.chance(noise) >= TOLD:
            return ""
        of_size = f"a curve of {self.n - self.spare:.0f} free numbers"
        free = f"{of_size} passes {self.n} points by {self.rms:.2g} {unit} on average"
        if self.spare <= 0:
            return f"smoothing = {noise:.6g} {unit} smooths nothing: {free}; measure more points"
        likely = self.norm / np.sqrt(self.spare)
        return (
            f"smoothing = {noise:.6g} {unit} is less than the noise of the points, about {likely:.2g} {unit}: {free}, "
            f"{likely / noise:.2g} times as much as such noise leaves it; give smoothing={likely:.2g} {unit}"
        )


def why_not(shape: Any, x: Array, y: Array, unit: str) -> str:
    """What is wrong with the shape of measured points (x, y); empty for a shape.

    A smoothing of many points by which their spline follows the noise is refused before it does. The noise is known to
    1.7/√n of it, of which four times are left out.
    """
    if x.size >= MANY and 0 < shape.smoothing < (1 - 7 / np.sqrt(x.size)) * noise_of(x, y):
        known = f"smoothing = {shape.smoothing:.6g} {unit} is less than the noise of the points"
        return f"{known}; without it the spline meets each"
    return str(shape._why_no_shape())


def told_smoothing(shape: Any, x: Array, y: Array, unit: str) -> str:
    """What to say of more smoothing: the first of some with which these points make a shape, or that none does."""
    noise, last = noise_of(x, y), shape.smoothing
    for smoothing in max(1.2 * last, (0.5 if x.size < MANY else 1.1) * noise) * 1.5 ** np.arange(12):
        if not 0 < smoothing < 0.3 * np.ptp(y):
            break
        last = float(f"{smoothing:.2g}")
        object.__setattr__(other := copy(shape), "smoothing", last)
        if not other._why_no_shape() and not other._doubt:
            return (
                f"if it is noise, give its standard deviation as smoothing=: {last!r} {unit} is enough for a shape, "
                f"the points look like noise of {noise:.2g} {unit}"
            )
    return (
        f"if it is noise, no smoothing= up to {last:.2g} {unit} makes it a shape: measure it more often, or leave out "
        "what is no more than noise"
    )


def _place(i: int, d: Array, a: Array) -> str:
    return f"at d = {d[i]:.6g} m" if np.isfinite(d[i]) and d[i] != 0 else f"at x = {a[i]:.6g} m"
