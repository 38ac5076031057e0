"""The integrals that lead from f(r) to g(x), p(r) and back, for profiles that are smooth between kinks.

g(x) = x ∫₀^{π/2} f'(x sin t) dt                       the one-dimensional image
f(r) = (2/π) ∫₀^{π/2} g(r sin t) dt                    its inverse
∫₀^a g dx = a ∫₀^{π/2} f(a sin t) sin t dt             needed for F_N = 2E*(d a − ∫₀^a g dx)
p(r) = (E*/π) ∫_r^a g'(x) / √(x² − r²) dx              pressure, from g

The first, second and fourth are Popov & Heß, *Method of Dimensionality Reduction* (2015); the third follows
by exchanging the order of integration.
Arrays are one-dimensional here, radii positive; ``edges`` are 0, the kinks and the profile's end (or inf).
"""

from collections.abc import Callable
from itertools import pairwise

import numpy as np

from mdr.indenters.mapping.quadrature import WINDOW, Function, Rule, derivative, double_exponential
from mdr.indenters.mapping.stable_functions import arcosh, leg
from mdr.tools.arrays import EPS, Array

Slope = Callable[[Array, float, float], Array]  #: dg/ds from s and the kinks before and after


def profile_1d(f: Function, edges: tuple[float, ...], x: Array, rule: Rule | None = None) -> Array:
    """g(x) from f."""
    return x * _along_arcs(lambda r, _, *piece: derivative(f, r, WINDOW * r, *piece), edges, x, rule)


def profile_3d(g: Function, edges: tuple[float, ...], r: Array) -> Array:
    """f(r) from g."""
    return 2 / np.pi * _along_arcs(lambda x, *_: g(x), edges, r)


def area_from_f(f: Function, edges: tuple[float, ...], a: Array, rule: Rule | None = None) -> Array:
    """∫₀^a g dx from f, without any derivative."""
    return a * _along_arcs(lambda r, sine, *_: sine * f(r), edges, a, rule)


def area_from_g(g: Function, edges: tuple[float, ...], a: Array, rule: Rule | None = None) -> Array:
    """∫₀^a g dx."""
    rule = rule or double_exponential()
    total = np.zeros_like(a)
    for low, high in pairwise(edges):
        width = np.maximum(np.minimum(high, a) - low, 0)[:, None]
        total += np.sum(width * rule.weight * g(low + width * rule.from_low), axis=1)
    return total


def pressure_from_slope(slope: Slope, edges: tuple[float, ...], r: Array, a: Array) -> Array:
    """p(r)/E* for 0 <= r < a, without the edge term, from dg/ds = slope(s, low, high) behind each kink ``low``.

    Behind a kink b g begins like √(x² − b²); in s = √(x² − b²) it is smooth. What is left of the root,
    √(x² − r²) = √(s² + b² − r²), goes into du: s = √(r² − b²) cosh u, or √(b² − r²) sinh u where r < b.
    """
    r = np.maximum(r, EPS * a)
    rule = double_exponential()
    total = np.zeros_like(r)
    for low, high in pairwise(edges):
        on = (a > low) & (r < high)
        inside = r[on, None]
        behind = inside > low
        gap = leg(np.maximum(inside, low), np.minimum(inside, low))
        gap = np.maximum(gap, np.sqrt(2 * EPS) * low)
        stop = leg(np.minimum(high, a[on, None]), low)
        far = np.where(behind, arcosh(stop, gap), np.arcsinh(stop / gap))
        bend = np.where(low > gap, np.arcsinh(low / gap), 0.0)  # g changes its course at s ~ b: cut there
        bend = np.minimum(bend, far)
        for start, way in ((0.0, bend), (bend, far - bend)):
            u = start + way * rule.from_low
            s = np.minimum(gap * np.where(behind, np.cosh(u), np.sinh(u)), stop)
            total[on] += np.sum(way * rule.weight * slope(s, low, high), axis=1)
    return total / np.pi


def slope_behind(g: Function, s: Array, low: float, high: float) -> Array:
    """dg/ds behind the kink ``low``, at x² = low² + s², from values of g."""
    reach = WINDOW * np.hypot(s, low)
    return derivative(lambda s: g(np.hypot(s, low)), s, reach, 0.0, float(leg(high, low)))


def _along_arcs(integrand: Callable[..., Array], edges: tuple[float, ...], x: Array, rule: Rule | None = None) -> Array:
    """∫₀^{π/2} integrand(r, sin t, low, high) dt along r = x sin t, (n_x,), on each piece from low to high."""
    total, rule = np.zeros_like(x), rule or double_exponential()
    for low, high in pairwise(edges):
        on = x > low
        far = x[on, None]
        stop = np.minimum(high, far)
        begin, end = np.arctan2(low, leg(far, low)), np.arctan2(stop, leg(far, stop))
        sine = np.sin(begin + (end - begin) * rule.from_low)
        values = integrand(np.clip(far * sine, low, stop), sine, low, high)
        total[on] += np.sum((end - begin) * rule.weight * values, axis=1)
    return total
