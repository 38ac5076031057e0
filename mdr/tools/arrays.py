"""The one kind of array that carries quantities, and the rounding of its numbers."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
EPS = float(np.finfo(float).eps)  #: rounding of a number, relative to it
EXACT = 1e-12  #: relative error that is left to what is exact but for rounding: a sum, a series, a root
SAME = 1e-9  #: of two numbers, up to which they differ by rounding alone: theirs, or that of sums they come from


def beyond(error: ArrayLike, values: ArrayLike) -> Array:
    """The values, and 0 for those within their error of it: what is left of terms that cancel is noise."""
    return np.where(np.abs(values) <= error, 0.0, values)
