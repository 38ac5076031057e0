"""Anderson's method (1965; Walker & Ni 2011): of the last few iterates the combination that changes least."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mdr.tools.arrays import Array


def shares(steps: Sequence[Array], last: Array, rcond: float) -> Array:
    """Shares (n,) of the steps from change to change, to be taken off the last change so that least is left of it.

    steps: n real vectors (k,), whose length measures a change; last: (k,). rcond: singular values below it, over the
    greatest, count as none. Taken off the last iterate alike, the shares make the next one.
    """
    return np.asarray(np.linalg.lstsq(np.array(steps).T, last, rcond=rcond)[0])
