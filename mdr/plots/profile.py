"""A shape and its springs: the profile pressed into the surface, and the 1D profile with its springs below."""

from __future__ import annotations

from typing import Any

import numpy as np

from mdr.plots.figures import COLOURS, Axes, Figure, prefix, style, subplots


def plot_profile(indenter: Any, d: float) -> Figure:
    """Draw the shape f(r) and its image g(x), pressed to the depth d into its springs, with the contact radius.

    Parameters
    ----------
    indenter : Indenter
        The shape.
    d : float
        Depth [m].

    Returns
    -------
    matplotlib.figure.Figure
        The figure. Heights are exaggerated: the two axes have their own scales.
    """
    a = float(indenter.contact_radius(d))
    x = (np.arange(20) + 0.5) / 20 * 1.5 * a  # of springs, at either side
    units = prefix([1.5 * a], "m"), prefix([d], "m")
    with style():
        fig, (left, right) = subplots(1, 2, sharex=True, sharey=True, figsize=(7.4, 3.6))
        r = np.linspace(0.0, min(1.6 * a, indenter.max_radius), 321)
        _draw_shape(left, r, indenter.profile_3d(r), a, d, units)
        _draw_springs(right, indenter.profile_1d, x, a, d, units)
        _draw_shape(right, r, indenter.profile_1d(r), a, d, units)
        left.set(title="shape $f(r)$", xlabel=f"$r$ [{units[0][1]}]", ylabel=f"height [{units[1][1]}]")
        right.set(title="image $g(x)$ on its springs", xlabel=f"$x$ [{units[0][1]}]")
        reach = 1.52 * a * units[0][0]
        left.set_xlim(-reach, reach)
        fig.legend(loc="outside lower center", ncols=2)
    return fig


def _draw_shape(ax: Axes, r: Any, profile: Any, a: float, d: float, units: Any) -> None:
    """Draw the indenter, pressed down by d into the undeformed surface, and the contact radius.

    Both flanks out to 1.6 a, with a vertical wall where the profile ends before that.
    """
    (per_r, _), (per_z, _) = units
    r, z = r[np.isfinite(profile)], profile[np.isfinite(profile)] - d
    if r[-1] < 1.6 * a:
        r, z = np.append(r, r[-1]), np.append(z, max(z[-1], d))
    r, z = np.concatenate([-r[::-1], r]), np.concatenate([z[::-1], z])
    top = 0.6 * d
    ax.fill_between(r * per_r, np.minimum(z, top) * per_z, top * per_z, color="0.88", linewidth=0, zorder=1)
    ax.plot(r * per_r, z * per_z, color="k", zorder=4)
    ax.axhline(0.0, color="0.4", linewidth=0.8, zorder=0)
    for side in (-a, a):
        ax.axvline(side * per_r, color="0.4", linewidth=1.0, linestyle=":", zorder=0)
    ax.annotate("$a$", (a * per_r, 0.0), (3, 3), ("data", "axes fraction"), "offset points")
    ax.set_ylim(-1.7 * d * per_z, top * per_z)


def _draw_springs(ax: Axes, profile: Any, x: Any, a: float, d: float, units: Any) -> None:
    """One line per spring from the ground up: to the indenter where it presses, to the surface where not."""
    (per_x, _), (per_z, _) = units
    x = np.concatenate([-x[x > 0][::-1], x])
    pressed = np.abs(x) < a
    height = np.zeros_like(x)
    height[pressed] = np.minimum(np.asarray(profile(np.abs(x[pressed])), dtype=float) - d, 0.0)
    for name, these, colour in (("in contact", pressed, COLOURS[0]), ("free", ~pressed, "0.7")):
        ax.vlines(x[these] * per_x, -1.4 * d * per_z, height[these] * per_z, color=colour, lw=1.2, label=name)
        ax.plot(x[these] * per_x, height[these] * per_z, ".", color=colour, markersize=4, zorder=3)
    ax.plot(x[[0, -1]] * per_x, [-1.4 * d * per_z] * 2, color="k", linewidth=2)
