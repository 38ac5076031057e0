"""Springs of a recorded run seen from the side: an indenter goes up and down on them, and they lean as sheared.

Records are read by attribute only.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.plots.figures import prefix

MARGIN = 1.15  #: half the width of the picture, over that of the contact


class SideView:
    """Places in the units of a picture: along in `unit`, heights in `unit_z`; both sides of the contact."""

    def __init__(self, run: Any, most: int = 24) -> None:
        """most: springs on each side."""
        even = np.linspace(run.x[-1] / most / 2, run.x[-1], most)  # springs stand closer at the edge
        self.run, self.every = run, np.unique(np.abs(run.x[:, None] - even).argmin(axis=0))
        (self.per_x, self.unit), (self.per_z, self.unit_z) = prefix(run.x, "m"), prefix(run.s, "m")
        x, (flanks, image) = run.x[self.every] * self.per_x, _image(run)
        self.x, self.reach = np.concatenate([-x[::-1], x]), MARGIN * float(run.x[-1]) * self.per_x
        self.flanks = np.concatenate([-flanks[::-1], flanks]) * self.per_x
        self.image = np.concatenate([image[::-1], image]) * self.per_z
        deepest, sheared = float(run.s.max()) * self.per_z, float(np.abs(run.e).max())
        # a spring leans by 0.08 of the width of the picture at most
        self.lean = 0.08 * 2.2 * float(run.x[-1]) * self.per_x / sheared if sheared else 0.0
        self.ground, self.top = -2.2 * deepest, deepest * float(np.clip(0.3 - run.u_z.min() / run.s.max(), 0.6, 1.5))

    @property
    def label(self) -> str:
        """What stands below the picture: the unit, and how far the shear is exaggerated."""
        drawn = f", shear drawn {self.lean / self.per_x:.2g} times" if self.lean else ""
        return f"[{self.unit}]{drawn}"

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


def _image(run: Any) -> tuple[NDArray[Any], NDArray[Any]]:
    """Places x >= 0 and the image g(x), as the springs felt it [m]; straight on where a growing contact ends."""
    x, image = run.x, np.max(run.u_z[:, None] - run.s, axis=0)  # no spring reaches through the indenter: s >= u_z - g
    # a contact that grows with depth ends in springs that are hardly pressed
    if run.s[:, -1].max() > 0.1 * run.s.max():
        return x, image  # a wall
    back = -1 - x.size // 10
    slope = (image[-1] - image[back]) / (x[-1] - x[back])
    return np.append(x, MARGIN * x[-1]), np.append(image, image[-1] + slope * (MARGIN - 1) * x[-1])
