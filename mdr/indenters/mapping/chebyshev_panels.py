"""g(x), the area below it and its inverse a(d) from f(r), by polynomials on panels, each made by quadrature once.

What is said of g here holds of the area too, but for the power of t behind a kink.

The x axis is cut at powers of two, at the kinks b, and behind each of them at b + h, b + 2h, b + 4h … with h
the way back to the kink before (or to the tip): no length is special. On a panel [x_lo, x_hi]

    g = (x/x_hi)^p G(t),  x = x_lo + (x_hi − x_lo) t,     p from both ends: a power law leaves G constant,
    g = g(b) + t G(t),    x = b + (x_hi − b) t²           behind a kink b, where g begins like √(x − b); area: t²,

with a polynomial G through Chebyshev points. Where its last coefficients do not vanish the panel is halved, and
what is left after N_HALVINGS, as where the slope of f has no bound, is mapped point by point. A panel is made when
first asked for and kept: f must stay the function it is.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev

from mdr.indenters.mapping import abel, inversion
from mdr.indenters.mapping.quadrature import N_HALVINGS, Function, Rule, chebyshev_fit, double_exponential, in_chunks
from mdr.tools.arrays import EXACT, Array

Edges = tuple[float, ...]
Integral = Callable[[Function, Edges, Array, Rule | None], Array]  #: one that leads from f to a height over x


class Panel(NamedTuple):
    """One panel of g, and the polynomial G if one of this degree fits."""

    low: float
    high: float
    at_kink: bool
    base: float  #: g(b) behind a kink, else 0
    power: float  #: p; behind a kink that of t
    coefficients: Array = np.empty(0)
    fits: bool = False

    @property
    def middle(self) -> float:
        """Where t = 1/2."""
        return self.low + (self.high - self.low) * (0.25 if self.at_kink else 0.5)

    def place(self, x: Array) -> Array:
        """The t of x, from 0 to 1."""
        share: Array = np.clip((x - self.low) / (self.high - self.low), 0, 1)
        return np.sqrt(share) if self.at_kink else share

    def factor(self, x: Array) -> Array:
        """What stands before G: a power of t or of x/x_hi."""
        return np.asarray((self.place(x) if self.at_kink else x / self.high) ** self.power)

    def heights(self, x: Array) -> Array:
        """g(x) from the polynomial."""
        G = chebyshev.chebval(2 * self.place(x) - 1, self.coefficients)
        return np.asarray(self.base + self.factor(x) * G)


class Chart:
    """What an integral makes of a profile f [m]: its image g [m], or the area below that [m²], over x >= 0 [m]."""

    def __init__(self, integral: Integral, f: Function, edges: Edges) -> None:
        self.integral, self.f, self.edges = integral, f, edges
        self.cuts = cuts(edges)
        self.panels: dict[tuple[float, float], Panel] = {}
        self.at_cuts: dict[int, float] = {}

    def __call__(self, x: Array) -> Array:
        """g(x) from its panels, in the shape of x."""
        flat, g = x.ravel(), np.zeros(x.size)
        panel = np.minimum(np.searchsorted(self.cuts, flat, side="right") - 1, self.cuts.size - 2)
        with np.errstate(all="ignore"):
            for i in np.unique(panel[flat > 0]):
                on = panel == i
                g[on] = self._heights(self.cuts[i], self.cuts[i + 1], flat[on])
        return g.reshape(x.shape)

    def direct(self, x: Array) -> Array:
        """g(x) by quadrature at every x, without panels."""
        return in_chunks(lambda x: self.integral(self.f, self.edges, x, None), x)

    def invert(self, d: Array, start: Array) -> tuple[Array, inversion.BoolArray]:
        """Radius a with g(a) = d for depths d > 0 (n,), as `inversion.invert` answers; start: about where it is."""
        with np.errstate(all="ignore"):
            about = int(np.searchsorted(self.cuts, start[np.argmin(d)]))
            first, last = self._cut_around(float(d.min()), about), self._cut_around(float(d.max()), about) + 1
            ladder = self.cuts[first : last + 1]
            heights = np.maximum.accumulate([self._height(i) for i in range(first, last + 1)])
            panel = np.clip(np.searchsorted(heights, d) - 1, 0, ladder.size - 2)
            a, ended = np.empty_like(d), np.zeros(d.shape, dtype=bool)
            for i in np.unique(panel):
                on = panel == i
                a[on], ended[on] = self._invert_between(ladder[i : i + 2], heights[i : i + 2], d[on])
        return a, ended

    def _cut_around(self, d: float, about: int) -> int:
        """The panel in which g rises to d: the number of its lower end. Strides of 1, 2, 4 … panels lead there."""
        low, high = 0, self.cuts.size - 1
        i, stride = min(max(about, low + 1), high - 1), 1
        while high - low > 1:
            if self._height(i) <= d:
                low, i = i, i + stride
            else:
                high, i = i, i - stride
            stride *= 2
            if not low < i < high:
                i = (low + high) // 2
        return low

    def _height(self, i: int) -> float:
        """g at an end of a panel, infinite where it is no number."""
        if i not in self.at_cuts:
            (g,) = self.direct(self.cuts[i : i + 1])
            self.at_cuts[i] = float("inf" if np.isnan(g) else g)
        return self.at_cuts[i]

    def _invert_between(self, ends: Array, heights: Array, d: Array) -> tuple[Array, inversion.BoolArray]:
        """Radii in one panel whose ends have these heights."""
        (low, high), (y_low, y_high) = np.broadcast_to(ends[:, None], (2, d.size)), heights[:, None] - d
        y_low, y_high = np.minimum(y_low, 0), np.maximum(y_high, 0)
        return inversion.refine(lambda x: self._heights(ends[0], ends[1], x), d, low, high, y_low, y_high)

    def _heights(self, low: float, high: float, x: Array, n_halvings: int = N_HALVINGS) -> Array:
        """g at x in [low, high], from its panel or the halves of it."""
        if (low, high) not in self.panels:
            self.panels[low, high] = self._panel(float(low), float(high))
        panel = self.panels[low, high]
        if panel.fits:
            return panel.heights(x)
        if n_halvings == 0 or not low < panel.middle < high:
            return self.direct(x)
        g, left = np.empty_like(x), x < panel.middle
        for on, ends in ((left, (low, panel.middle)), (~left, (panel.middle, high))):
            if on.any():
                g[on] = self._heights(*ends, x[on], n_halvings - 1)
        return g

    def _panel(self, low: float, high: float) -> Panel:
        """The panel from low to high, with its polynomial."""
        at_kink = low in self.edges
        g_low, g_high = self.direct(np.array([low, high]))
        rises = not at_kink and min(g_low, g_high) > 0
        power = np.log(g_high / g_low) / np.log(high / low) if rises else 0.0
        if at_kink:
            power = 2.0 if self.integral is abel.area_from_f else 1.0
        panel = Panel(low, high, at_kink, g_low if at_kink else 0.0, power)
        # the tip is three half-widths away, 5.8**-24 = 4e-19; in t kinks before are at ±i, 4.6**-24 = 1e-16
        nodes, to_coefficients = chebyshev_fit(24)
        t = (nodes + 1) / 2
        x = low + (high - low) * (t * t if at_kink else t)
        g, factor = self.direct(x), panel.factor(x)
        G = (g - panel.base) / factor
        coefficients = to_coefficients @ G
        tail = np.max(np.abs(coefficients[-3:]))
        scale = np.min(np.abs(G)) if rises else np.fmax(np.max(np.abs(G)), g_high)
        fits = tail <= EXACT * scale or not np.isfinite(g).any() or tail <= self._quadrature_error(x, g, factor)
        return panel._replace(coefficients=coefficients, fits=bool(fits))

    def _quadrature_error(self, x: Array, g: Array, factor: Array) -> float:
        """Difference of a second quadrature rule from g, over ``factor``: a polynomial need not be closer."""
        some = slice(2, None, 5)
        other = self.integral(self.f, self.edges, x[some], double_exponential(0.077))
        return float(np.median(np.abs(g[some] - other) / factor[some]))


def cuts(edges: Edges) -> Array:
    """Ends of all panels from the smallest number to the profile's end or to the largest number."""
    powers = np.ldexp(1.0, np.arange(-1074, 1024))
    rows = [powers[powers < edges[1]]]
    with np.errstate(over="ignore"):
        for before, b, stop in zip(edges, edges[1:-1], edges[2:], strict=False):
            row = b + (b - before) * powers[powers >= 1]
            rows.append(np.append(b, row[row < stop]))
    return np.unique(np.concatenate([*rows, [min(edges[-1], np.finfo(float).max)]]))
