"""A face with a shear strength alone whose area of contact grows and shrinks, on annuli of a half-space of nu = 0.

The edge of contact passes the annuli one by one; each step ends where it has come to the next. So what happens behind
an edge that grows is resolved as finely as there are annuli, and the error falls with their width. Each annulus sticks
or slips by itself; no spring, and no equation of mdr, is in it.
"""

import numpy as np

from mdr.tools.arrays import Array
from validation.half_space.annuli import disc

INNER = 40  #: annuli of the disc that is always in contact
NEXT = 1e-12  #: of a limit, which is rounding
TURNS = 80  #: of stick and slip of a step, at most


def lost(a: Array, pull: float, T: float = 0.0, n: int = 300) -> float:
    """Share of the friction of full slip [-] that is lost; a: radius of contact (n_t,) at phases of a period.

    From its least on it rises, and then falls. pull: v_0 G*/(tau_0 omega), in the unit of a; T: omega tau of a Kelvin
    material; n: annuli that the edge passes.
    """
    a = np.roll(a, -int(np.argmin(a)))
    a = np.append(a, a[0])
    phase, top = 2 * np.pi / (a.size - 1) * np.arange(a.size), int(np.argmax(a))
    edges = np.concatenate([np.linspace(0, a[0], INNER, endpoint=False), np.linspace(a[0], a[top], n + 1)])
    up = np.interp(edges[INNER:], a[: top + 1], phase[: top + 1])
    down = np.interp(edges[INNER:], a[top:][::-1], phase[top:][::-1])
    steps = np.diff(np.concatenate([up, down[-2::-1]]))
    touching = INNER + np.concatenate([np.arange(1, n + 1), np.arange(n - 1, -1, -1)])  # annuli during a step

    r, area = 0.5 * (edges[1:] + edges[:-1]), np.diff(edges**2)
    moved = np.diff([disc(r, R) for R in edges], axis=0).T  # times G*/tau_0, by a traction of tau_0
    q = np.where(np.arange(r.size) < INNER, 1.0, 0.0)
    u = moved @ q
    for _ in range(2):  # the second period is that of all others, as each begins with full slip
        left = 0.0
        for step, m in zip(steps, touching, strict=True):
            follows = -np.expm1(-step / T) if T else 1.0  # of what u lacks
            rest = (1 - follows) * u
            new = np.zeros_like(q)
            new[:m] = _tractions(follows * moved[:m, :m], u[:m] + pull * step - rest[:m], q[:m])
            left += step * float(area @ (new + q)) / 2
            q, u = new, rest + follows * (moved @ new)
    ends = area.cumsum()[touching - 1]
    full = float(steps @ (ends + np.roll(ends, 1))) / 2
    return 1 - left / full


def _tractions(moved: Array, asked: Array, q: Array) -> Array:
    """Tractions (m,) of annuli that move by as much as is asked, or by less and slip, at a traction of 1."""
    sticks = np.abs(q) < 1 - NEXT
    for _ in range(TURNS):
        q = np.where(sticks, 0.0, np.where(q < 0, -1.0, 1.0))
        if sticks.any():
            q[sticks] = np.linalg.solve(moved[np.ix_(sticks, sticks)], (asked - moved @ q)[sticks])
        over = sticks & (np.abs(q) > 1 + NEXT)
        back = ~sticks & ((asked - moved @ q) * np.sign(q) < -NEXT * np.abs(asked).max())
        if not (over | back).any():
            return q
        q, sticks = np.where(over, np.sign(q), q), (sticks & ~over) | back
    raise RuntimeError("which annuli stick is not found: take more of them")
