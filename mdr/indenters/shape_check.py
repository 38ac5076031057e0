"""What every shape is held to: pressed deeper it touches more, and presses harder.

With the depth d, the radius a of a full disc of contact and V = F_N/E*, from one state of contact to the next

    0 <= a,   a_1 <= a_2,   0 <= d_1 <= d_2,   2 a_1 (d_2 − d_1) <= V_2 − V_1 <= 2 a_2 (d_2 − d_1),

as dF_N/dd = 2E*a. What is made of data, of a function or by a class of a user is asked for such states on a grid.
"""

from collections.abc import Callable

import numpy as np

from mdr.tools.arrays import SAME, Array

GRID = np.unique(np.concatenate([np.linspace(0.01, 1, 64), np.geomspace(1e-6, 0.01, 12)]))  #: radii, many at the tip
FINE = np.unique(np.append(GRID, np.linspace(0, 1, 513)[1:]))  #: where they cost little
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
        if (i := _first((a < 0) | ((a == 0) & (d > near * d.max())))) is not None:
            return f"the contact radius is {a[i]:.6g} m {_place(i, d, a)}, where it must be positive"
        if (i := _first(np.maximum.accumulate(a) - a > near * a.max())) is not None:
            return f"the contact radius falls at d = {d[i]:.6g} m, so that the contact would shrink there"
        if (i := _first(np.maximum.accumulate(np.maximum(d, 0)) - d > near * np.abs(d).max())) is not None:
            return falls_at(a[i])
        if V is not None:
            rise, spare = np.diff(V), max(near, near_V) * a.max() * d.max()
            least, most = 2 * a[:-1] * np.diff(d), 2 * a[1:] * np.diff(d)
            if (i := _first((rise < least - spare) | (rise > most + spare))) is not None:
                return (
                    f"F_N/E* rises by {rise[i]:.6g} m² between d = {d[i]:.6g} and {d[i + 1]:.6g} m, and 2 a, by which "
                    f"it must rise per depth, is {2 * a[i]:.6g} to {2 * a[i + 1]:.6g} m there"
                )
    return ""


def falls_at(x: float) -> str:
    """Words for an image that falls."""
    return (
        f"annular contact: its one-dimensional profile g falls at x = {x:.6g} m, so that a ring touches before the "
        "disc inside it; the method needs a full disc: choose a shape whose g(x) rises"
    )


def bends_down(f: Array, r: Array, most: int = 4) -> Array:
    """Radii, of r (n,), behind where r f' falls most: where it rises g does, as dg/dx = ∫₀^{π/2} (r f')' dt."""
    turn = np.diff((r[1:] + r[:-1]) / 2 * np.diff(f))
    deepest = np.argsort(turn)[:most]
    deepest = deepest[turn[deepest] < -SAME * np.max(np.abs(turn))]
    return np.unique(r[np.minimum(deepest[:, None] + np.arange(1, 5), r.size - 1)])


def noise_of(x: Array, y: Array) -> float:
    """About the standard deviation of the noise of y: its median distance from the line through both neighbours."""
    share = (x[1:-1] - x[:-2]) / (x[2:] - x[:-2])
    off = y[1:-1] - (1 - share) * y[:-2] - share * y[2:]
    return float(np.median(np.abs(off) / np.sqrt(1 + share**2 + (1 - share) ** 2)) / 0.6745)


def told_smoothing(passes: Callable[[float], bool], least: float, noise: float, most: float, unit: str) -> str:
    """What to say of a smoothing above ``least``: the first of some that passes, or that none does."""
    last = least
    for smoothing in max(1.2 * least, 0.5 * noise) * 1.5 ** np.arange(12):
        if not 0 < smoothing < most:
            break
        last = float(f"{smoothing:.2g}")
        if passes(last):
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


def _first(wrong: Array) -> int | None:
    """Number of the first that is true."""
    return int(np.argmax(wrong)) if wrong.any() else None
