"""SpringArray: where the springs stand under the indenter and how stiff each one is.

The half-space becomes a row of independent elements dk_z = E* dx, dk_x = G* dx (Popov and Heß 2015). A spring
here stands for the pair of cells at +x and -x, so its width counts twice.

What sets the accuracy is the *edge band* between a(u_z0 - du_z) and a(u_z0 + du_z), where springs touch and
leave, and for a slow material the wider band out to the depth u_z0 - du_z sqrt(1 + T²) below which contact is
never lost. The row is therefore cut into panels at exactly these radii (and at the kinks of the shape),
each with cells of its own however thin it is, and each spring stands at the mean depth of its cell. Sums over
the springs then equal k_zc and F_N exactly at u_z0 and at both extremes of the motion.

Symbols: x position [m], gap = g(x) - u_z0 depth of a spring's foot relative to the mean depth [m] (kept in this
form because u_z0 may be many orders larger than du_z), width 2 dx [m].
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from mdr.checks import count
from mdr.contact import SlidingContact, require_case
from mdr.indenters.base import Indenter
from mdr.records import ArrayRecord
from mdr.unilateral import kept_gap

Array = NDArray[np.float64]

_NODES, _WEIGHTS = (0.5 * (leggauss(4)[0] + 1), 0.5 * leggauss(4)[1])
MIN_SPRINGS = 16  #: fewer cannot serve all panels


@dataclass(frozen=True, eq=False)
class SpringArray(ArrayRecord):
    """Springs of a contact, from the centre outwards; arrays of shape (n_springs,)."""

    x: Array  #: positions of the cell centres [m]
    gap: Array  #: mean of g over the cell, less u_z0 [m]
    width: Array  #: 2 dx, both sides of the contact [m]
    E_star: float  #: normal modulus [Pa]
    G_star: float  #: tangential modulus [Pa]
    n_core: int  #: the first n_core springs never lose contact

    @classmethod
    def of(cls, case: SlidingContact, n_springs: int = 512) -> SpringArray:
        """The springs of a sliding contact.

        Raises ValueError for n_springs below 16.
        """
        case, n_springs = require_case(case), count("n_springs", n_springs, MIN_SPRINGS)
        panels = _panels(case)
        counts = _share_out(panels, n_springs)
        cells = [_cells(case, panel, n) for panel, n in zip(panels, counts, strict=True)]
        x, gap, width = (np.concatenate(parts) for parts in zip(*cells, strict=True))
        n_core = sum(n for panel, n in zip(panels, counts, strict=True) if panel.permanent)
        return cls(x, gap, width, case.material.E_star, case.material.G_star, n_core)

    @property
    def dk_z(self) -> Array:
        """Normal stiffness of each spring E* 2 dx [N/m]."""
        return self.E_star * self.width

    @property
    def dk_x(self) -> Array:
        """Tangential stiffness of each spring G* 2 dx [N/m]."""
        return self.G_star * self.width

    def normal_stiffness(self, u_z: float, u_z0: float) -> float:
        """Stiffness [N/m] of the springs that reach the surface at depth u_z [m]; u_z0 is the mean depth."""
        return float(np.sum(self.dk_z[self.gap < u_z - u_z0]))

    def normal_force(self, u_z: float, u_z0: float) -> float:
        """Elastic force [N] of the array at depth u_z [m]; u_z0 is the mean depth."""
        return float(np.sum(self.dk_z * np.maximum(u_z - u_z0 - self.gap, 0)))


@dataclass(frozen=True)
class _Panel:
    """A stretch of the row: from x_lo to x_hi, where g rises from u_z0 + gap_lo to u_z0 + gap_hi."""

    x_lo: float
    x_hi: float
    gap_lo: float
    gap_hi: float
    permanent: bool  # in contact through the whole period


def _panels(case: SlidingContact) -> list[_Panel]:
    """The row cut at the depths where the behaviour of a spring changes, and at the kinks of the shape."""
    u_z0, du_z = case.oscillation.u_z0, case.oscillation.du_z
    shape = case.indenter
    kept = du_z * kept_gap(case.T)
    gaps = [gap for gap in (kept, -du_z, 0.0, du_z) if u_z0 + gap > 0]
    marks = [(0.0, -u_z0)] + [(float(shape.contact_radius(u_z0 + gap)), gap) for gap in gaps]
    marks += [(x, float(shape.profile_1d(x)) - u_z0) for x in shape.kinks if x < marks[-1][0]]
    marks.sort()
    return [
        _Panel(x_lo, x_hi, gap_lo, gap_hi, permanent=gap_hi <= kept)
        for (x_lo, gap_lo), (x_hi, gap_hi) in pairwise(marks)
        if x_hi > x_lo
    ]


def _share_out(panels: list[_Panel], n_springs: int) -> list[int]:
    """Springs per panel: an eighth of them to the core that never leaves, the rest evenly."""
    n_permanent = sum(panel.permanent for panel in panels)
    n_band = len(panels) - n_permanent
    if n_springs < 2 * len(panels):
        raise ValueError(f"n_springs must be at least {2 * len(panels)} for this shape with its kinks, got {n_springs}")
    core = n_springs if n_band == 0 else max(2, n_springs // (8 * max(n_permanent, 1))) * n_permanent
    counts = []
    for group, total in ((True, core), (False, n_springs - core)):
        n = n_permanent if group else n_band
        counts.append(iter([total // n + (i < total % n) for i in range(n)]))
    return [next(counts[0] if panel.permanent else counts[1]) for panel in panels]


def _cells(case: SlidingContact, panel: _Panel, n: int) -> tuple[Array, Array, Array]:
    """Centres, mean gaps and widths of the n cells of a panel."""
    span = panel.x_hi - panel.x_lo
    edges = np.arange(n + 1) / n  # shares of the panel
    if panel.x_lo == 0 and not panel.permanent:
        edges = edges**2  # the tip leaves: the instant of its touch counts
    part = np.diff(edges)
    share = edges[:-1, None] + part[:, None] * _NODES  # (n, 4)
    rise = _rise(case.indenter, panel, share, case.oscillation.u_z0)
    gap = panel.gap_lo + (panel.gap_hi - panel.gap_lo) * (rise @ _WEIGHTS)
    gap += _missing_mean(case, panel, float(part @ gap))
    return panel.x_lo + span * (edges[:-1] + 0.5 * part), gap, 2 * span * part


def _rise(shape: Indenter, panel: _Panel, share: Array, u_z0: float) -> Array:
    """How far g has risen through the panel, 0 to 1; linear where the panel is too thin to resolve in x."""
    span = panel.x_hi - panel.x_lo
    height = panel.gap_hi - panel.gap_lo
    if height <= 0 or span < 1e-9 * panel.x_hi or height < 1e-9 * (u_z0 + panel.gap_hi):
        return share
    g_lo, g_hi = u_z0 + panel.gap_lo, u_z0 + panel.gap_hi
    rise: Array = np.clip((shape.profile_1d(panel.x_lo + span * share) - g_lo) / (g_hi - g_lo), 0, 1)
    return rise


def _missing_mean(case: SlidingContact, panel: _Panel, mean: float) -> float:
    """What the quadrature missed of the mean of g over a panel, known exactly from F_N; rounding is left alone."""
    shape, u_z0 = case.indenter, case.oscillation.u_z0
    g_lo, g_hi = u_z0 + panel.gap_lo, u_z0 + panel.gap_hi
    area = panel.x_hi * g_hi - panel.x_lo * g_lo - 0.5 * (float(shape.force(g_hi, 1.0)) - float(shape.force(g_lo, 1.0)))
    missing = area / (panel.x_hi - panel.x_lo) - u_z0 - mean
    noise = 64 * np.finfo(float).eps * panel.x_hi * abs(g_hi) / (panel.x_hi - panel.x_lo)
    return missing if abs(missing) > noise else 0.0
