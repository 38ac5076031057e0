"""A range of values, along which a search goes evenly: of a wide one values grow by a constant factor."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class Range(NamedTuple):
    """From the lowest to the highest value, over a coordinate from 0 to 1."""

    low: float
    high: float

    @property
    def _is_wide(self) -> bool:
        return 0 < 4.0 * self.low < self.high

    def value(self, x: float) -> float:
        """The value at a coordinate."""
        if self._is_wide:
            return float(self.low ** (1 - x) * self.high**x)
        return float(self.low + (self.high - self.low) * x)

    def coordinate(self, value: float) -> float:
        """The coordinate of a value, of one outside that of the nearer end."""
        value = min(max(value, self.low), self.high)
        if self._is_wide:
            low, high = np.log([self.low, self.high])
            return float((np.log(value) - low) / (high - low))
        return (value - self.low) / (self.high - self.low)
