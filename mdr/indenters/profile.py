"""Any profile f(r), mapped by quadrature: g, a, F_N and p to 1e-9 (`mapping.chebyshev_panels`, `mapping.abel`)."""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.base import Indenter
from mdr.indenters.mapped import SAMPLES
from mdr.indenters.mapping.shape_check import as_heights
from mdr.indenters.sampled_profile import radii
from mdr.tools.arrays import Array
from mdr.tools.checks import finite_array, plain, positive_or_none
from mdr.tools.fields import facts


def _function(name: str, value: Any, note: str = "") -> Any:
    if not callable(value):
        raise TypeError(f"{name} must be a function of the radius, got {value!r}")
    return value


def _name(name: str, value: Any, note: str = "") -> str | None:
    if value is not None and not isinstance(value, str):
        raise TypeError(f"{name} must be a string, got {value!r}")
    return value


@dataclass(frozen=True, eq=False)
class Profile(Indenter):
    """A shape given as a function f(r) with f(0) = 0, smooth except at the radii named in ``kinks``.

    ``f`` takes an array of radii and returns as many heights; a function of single numbers works too, slowly. It is
    called within [0, r_max] only, or to beyond the edge of contact if r_max is None. It must return the same each time:
    g is kept once mapped. To change a parameter of f make a new Profile. ``kinks`` are the radii where the slope jumps
    or a flat part ends. A kink that is not named costs accuracy, and a warning says how much. ``name`` is what the
    shape is called in print and in stored studies, as a function has no such text. Two profiles are equal if they hold
    the same function object, kinks, r_max and name.

    Examples
    --------
    >>> import mdr, numpy as np
    >>> worn = mdr.Profile(lambda r: 0.02 * np.maximum(r - 4e-4, 0), kinks=(4e-4,), name="worn cone")
    >>> print(f"{worn.contact_radius(20e-6):.2g} m, {worn.force(20e-6, E_star=4e6):.3g} N")
    0.0009 m, 0.0979 N
    """

    f: Callable[..., Any] = field(metadata=facts("m", "height over radius", _function))
    kinks: tuple[float, ...] = field(
        default=(), kw_only=True, metadata=facts("m", "radii at which the slope jumps", radii)
    )
    r_max: float | None = field(
        default=None,
        kw_only=True,
        metadata=facts("m", "radius at which the shape ends", positive_or_none, note="radius in m"),
    )
    name: str | None = field(default=None, kw_only=True, metadata=facts("", "what it is called", _name))

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.kinks and self.kinks[-1] >= self.max_radius:
            raise ValueError(f"kinks must lie within r_max = {self.max_radius:.6g} m, got {self.kinks[-1]!r}")
        self._refuse_offset()
        self._refuse_steps()
        if self.r_max is not None:
            self._refuse_annular(self.r_max)

    @property
    def max_radius(self) -> float:
        """r_max [m], or inf."""
        return np.inf if self.r_max is None else self.r_max

    def profile_3d(self, r: ArrayLike) -> Array:
        """f(r), even in r."""
        r = self._within(finite_array("r", r, "m"))
        heights = self._f(r)
        if not np.all(np.isfinite(heights)):
            bad = r[~np.isfinite(heights)].min()
            raise ValueError(f"f(r) is not finite at r = {bad:.6g} m: name its end (r_max)")
        return plain(heights)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Profile) and self._identity() == other._identity()

    def __hash__(self) -> int:
        return hash(self._identity())

    def _identity(self) -> tuple[object, ...]:
        return (id(self.f), self.kinks, self.r_max, self.name)

    def _f(self, r: Array) -> Array:
        with np.errstate(all="ignore"):
            try:
                heights = self.f(r)
            except (TypeError, ValueError):  # f knows single numbers only
                heights = np.vectorize(self.f, otypes=[float])(r)
        return as_heights("f", heights, r)

    def _refuse_offset(self) -> None:
        offset = float(self._f(np.zeros(1))[0])
        if offset != 0:
            raise ValueError(
                f"f(0) must be 0, the tip that depth counts from, got {offset!r}: give f(r) - f(0) instead"
            )

    def _search(self, d: Array) -> Array:
        """As of any shape, which a step that is not named would leave wrong: no quadrature sees it."""
        a = super()._search(d)
        if (wall := step_within(self._f, float(a.max()))) is not None:
            raise ValueError(_wall(*wall))
        return a

    def _refuse_steps(self) -> None:
        """A step in f is a vertical wall: g is infinite above it."""
        for b in self.kinks:
            inside, outside = self._f(b * np.array([1 - 1e-9, 1 + 1e-9]))
            step = abs(outside - inside)
            if step > 1e-5 * max(abs(outside), abs(inside)) and step > 1e-5 * b:
                raise ValueError(_wall(b, outside - inside))


def _wall(r: float, step: float) -> str:
    return (
        f"f steps by {step:.6g} m at r = {r:.6g} m: a vertical wall ends the contact like the rim of a punch; end the "
        "profile there (r_max)"
    )


@lru_cache(64)
def step_within(heights: Callable[[Array], Array], a: float) -> tuple[float, float] | None:
    """Radius [m] and height [m] of a step of f within the radius a [m], of those that stand out of SAMPLES heights.

    heights: of the shape, an array for an array. The interval of the greatest rise is halved until it has no
    middle: the rise of a step stays.
    """
    r = np.linspace(0, a, SAMPLES + 1)
    rises = np.abs(np.diff(heights(r)))
    i = int(np.argmax(rises))
    low, high = r[i], r[i + 1]
    while low < (middle := 0.5 * (low + high)) < high:
        left, right = np.abs(np.diff(heights(np.array([low, middle, high]))))
        low, high = (low, middle) if left > right else (middle, high)
    (rise,) = np.diff(heights(np.array([low, high])))
    return (float(high), float(rise)) if abs(rise) > 0.5 * rises[i] > 0 else None
