"""Springs of a recorded run seen from the side: an indenter goes up and down on them, and they lean as sheared.

Records are read by attribute only.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.plots.figures import prefix

MOST_DRAWN = 24  #: springs on each side
LEAN = 0.06  #: greatest lean of a spring, over the width of the picture


class SideView:
    """Places in the units of a picture: along in `unit`, heights in `unit_z`; both sides of the contact."""

    def __init__(self, run: Any) -> None:
        even = np.linspace(run.x[-1] / MOST_DRAWN / 2, run.x[-1], MOST_DRAWN)  # springs stand closer at the edge
        self.run, self.every = run, np.unique(np.abs(run.x[:, None] - even).argmin(axis=0))
        (self.per_x, self.unit), (self.per_z, self.unit_z) = prefix(run.x, "m"), prefix(run.s, "m")
        x = run.x * self.per_x
        self.x, self.flanks = np.concatenate([-x[self.every][::-1], x[self.every]]), np.concatenate([-x[::-1], x])
        image = np.max(run.u_z[:, None] - run.s, axis=0) * self.per_z  # none reaches through the indenter: s >= u_z - g
        self.image = np.concatenate([image[::-1], image])
        deepest, sheared = float(run.s.max()) * self.per_z, float(np.abs(run.e).max())
        self.lean = LEAN * 2.2 * float(x.max()) / sheared if sheared else 0.0
        self.ground, self.top = -2.2 * deepest, deepest * float(np.clip(0.3 - run.u_z.min() / run.s.max(), 0.6, 1.5))

    def both(self, values: NDArray[Any]) -> NDArray[Any]:
        """Values (..., n_springs) of the springs that are drawn, on both sides."""
        one = values[..., self.every]
        return np.concatenate([one[..., ::-1], one], axis=-1)

    def tops(self, k: int) -> NDArray[Any]:
        """Heights at the instant k of the record."""
        return -self.both(self.run.s[k]) * self.per_z

    def feet(self, k: int) -> NDArray[Any]:
        """Places of the feet."""
        return self.x - self.both(self.run.e[k]) * self.lean

    def surface(self, k: int) -> NDArray[Any]:
        """Heights of the indenter's surface at the flanks."""
        return np.asarray(self.image - self.run.u_z[k] * self.per_z)
