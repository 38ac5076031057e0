"""Anderson's method (1965; Walker & Ni 2011): of the last few iterates the combination that changes least."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.tools.arrays import Array


def shares(changes: Sequence[NDArray[Any]], measure: Callable[[NDArray[Any]], Array], rcond: float) -> Array:
    """Shares (n - 1,) of the differences between n changes, to be taken off the last one so that least is left of it.

    measure: makes changes (..., m) real vectors (..., k) whose length measures them, linearly. rcond: singular values
    below it, over the greatest, count as none. Taken off the iterates alike, the shares make the next one.
    """
    steps = np.diff(np.array(changes), axis=0)
    return np.asarray(np.linalg.lstsq(measure(steps).T, measure(changes[-1]), rcond=rcond)[0])
