"""Unilateral motion of one Kelvin spring under u_z0 + du_z cos(phase): when it leaves and when it touches again.

A spring of gap c (the depth of its foot below the mean surface position, over du_z) has the compression w = cos(phase)
- c while in contact. Its force w + T w' vanishes while it is still compressed. It then relaxes like exp(-phase/T), and
touches again where w reaches this relaxed surface, not zero. Both edges of an array follow:

* leaving, c = cos(phase) - T sin(phase), which is sqrt(1 + T²) cos(phase + arctan T). It begins at phase 0, where every
  spring that ever touches is in contact, and ends at pi - arctan T, where only those with c <= -sqrt(1 + T²) are;
* touching, from there to 2 pi. The spring that touches at this phase left at an earlier one, `off`, with

      T sin(off) [1 - exp(-(phase - off)/T)] = cos(off) - cos(phase).

For T = 0 both are c = cos(phase).
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from mdr.tools.arrays import Array


def turning_phase(T: float) -> float:
    """Phase at which the contact is smallest and every spring in it presses least: pi - arctan T."""
    return float(np.pi - np.arctan(T))


def kept_gap(T: float) -> float:
    """Gap of the shallowest spring that never leaves, -sqrt(1 + T²): Eq. (5) for each spring."""
    return -float(np.hypot(1, T))


def leaving_phase(gap: Array | float, T: float) -> Array:
    """Phase in [0, pi - arctan T] at which springs of these gaps, between kept_gap(T) and 1, leave."""
    return np.asarray(np.arccos(np.clip(np.asarray(gap) / np.hypot(1, T), -1, 1)) - np.arctan(T))


def touching_phase(gap: float, T: float) -> float:
    """Phase in [pi - arctan T, 2 pi] at which a spring of this gap, between kept_gap(T) and 1, touches again."""
    off = float(leaving_phase(gap, T))
    if T == 0 or off <= 0:
        return 2 * np.pi - off
    first = 2 * turning_phase(T) - off  # where its force would rise through zero, had it stayed
    if first <= off or _ahead(2 * np.pi - off, 2 * np.pi, T) >= 0:
        return first if first <= off else 2 * np.pi
    from scipy.optimize import brentq

    return float(brentq(lambda phase: -_ahead(phase - off, phase, T), first, 2 * np.pi, xtol=1e-15))


def contact_edge(phase: Array, T: float) -> Array:
    """Gap of the spring at the edge of contact, for phases in [0, 2 pi], any shape."""
    phase = np.asarray(phase, dtype=float)
    if T == 0:
        return np.asarray(np.cos(phase))
    off = np.where(phase <= turning_phase(T), phase, phase - _flight(phase, T))
    return np.asarray(np.hypot(1, T) * np.cos(off + np.arctan(T)))


def edge_rate(phase: Array, gap: Array, T: float) -> Array:
    """d gap/d phase of the touching edge, where its gap is known."""
    if T == 0:
        return np.asarray(-np.sin(phase))
    lost = -np.expm1(-(phase - leaving_phase(gap, T)) / T)
    return np.asarray(((np.cos(phase) - gap) / T - np.sin(phase)) / lost)


def _ahead(flight: Array | float, phase: Array | float, T: float) -> Array:
    """Height of the relaxed surface above the indenter at `phase`, for a spring that left at phase - flight."""
    off = np.asarray(phase - flight)
    rise = 2 * np.sin(off + flight / 2) * np.sin(flight / 2)  # cos(off) - cos(phase) without cancellation
    return np.asarray(rise + T * np.sin(off) * np.expm1(-flight / T))


def _flight(phase: Array, T: float) -> Array:
    """Duration, in phase, for which the spring that touches at `phase` was free, by Newton's method from a table."""
    flights, phases = _flights(T)
    flight = np.interp(phase, phases, flights)
    turn = turning_phase(T)
    for _ in range(5):
        off, left = phase - flight, np.exp(-flight / T)
        slope = (np.sin(off) + T * np.cos(off)) * (1 - left)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = _ahead(flight, phase, T) / slope
        flight = np.clip(flight - np.where(np.isfinite(step), step, 0), np.maximum(phase - turn, 0), phase)
    return np.asarray(flight)


@lru_cache(maxsize=64)
def _flights(T: float) -> tuple[Array, Array]:
    """Table of free durations and of the phases at which they end, in closed form."""
    flight = np.concatenate([min(T, 1) * np.geomspace(1e-2, 1, 200)[:-1], np.linspace(min(T, 1), 2 * np.pi, 400)])
    lag = -T * np.expm1(-flight / T)
    across, along = lag * np.sin(flight) - 2 * np.sin(flight / 2) ** 2, lag * np.cos(flight) - np.sin(flight)
    phase = np.mod(np.arctan2(across, along), 2 * np.pi)
    flight, phase = np.r_[0, flight], np.r_[turning_phase(T), phase]
    phase[-1] = 2 * np.pi
    return flight, np.maximum.accumulate(phase)
