"""Theorems that the friction of any contact obeys, whatever its shape, material and pull; asked of every settled run.

Under a given normal motion two motions never move apart, and with them friction never falls with velocity
(validation/uniqueness.py). So mean F_x over mean F_z lies between its limit at v_0 -> 0, mu_0 min F_N/mean F_N, and
mu_0; it is the same from any start; and of two velocities the higher one has no less. A run that says otherwise has not
settled, however steady it looks.

All this ends where friction falls as springs are let go: then a COF is not above the static coefficient, and no more.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mdr.tools.arrays import Array


def outside(cof: float, least: float, slack: float, most: float = 1.0) -> str:
    """Why a COF over mu_0 cannot be that of a steady motion; nothing if it can.

    least: the static limit over mu_0, or -1 where a shake may drive. slack: error of cof and least together. most: that
    up to which springs stick.
    """
    if cof < least - slack:
        if least <= -1:
            return f"cof = {cof:.6g} mu_0 is more than the springs can push"
        return f"cof = {cof:.6g} mu_0 lies below the static limit {least:.6g} mu_0, which no steady motion does"
    if cof > most + slack:
        return f"cof = {cof:.6g} mu_0 is more than the springs can hold"
    return ""


def disordered(v_0: Array, cof: Array, error: Array, settled: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Which points of a curve, arrays of shape (n,), contradict another one: settled, and friction falls between them.

    error: bound on that of each cof, absolute.
    """
    order = np.argsort(v_0, kind="stable")
    low, high = (cof - error)[order], (cof + error)[order]
    before = np.maximum.accumulate(np.where(settled[order], low, -np.inf))
    after = np.minimum.accumulate(np.where(settled[order], high, np.inf)[::-1])[::-1]
    slower, faster = np.r_[-np.inf, before[:-1]], np.r_[after[1:], np.inf]
    wrong = np.zeros(v_0.shape, dtype=bool)
    wrong[order] = settled[order] & ((high < slower) | (low > faster))
    return wrong
