"""Unilateral motion of one Kelvin spring under u_z0 + du_z cos(phase): when it leaves and when it touches again.

A spring of gap c (the depth of its foot below the mean surface position, over du_z) has the compression w = cos(phase)
- c while in contact. Its force w + T w' vanishes while it is still compressed. It then relaxes like exp(-phase/T), and
touches again where w reaches this relaxed surface, not zero. Both edges of an array follow:

* leaving, c = cos(phase) - T sin(phase), which is sqrt(1 + T²) cos(phase + arctan T). It begins at phase 0, where every
  spring that ever touches is in contact, and ends at pi - arctan T, where only those with c <= -sqrt(1 + T²) are;
* touching, from there to 2 pi. The spring that touches at this phase left at an earlier one, `off`, with

      T sin(off) [1 - exp(-(phase - off)/T)] = cos(off) - cos(phase).

For T = 0 both are c = cos(phase). The second equation is solved by contact_edge.py, which takes any depth.
"""

from __future__ import annotations

import numpy as np

from mdr.normal.contact_edge import ContactEdge, edge_under
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
    touches, _ = _edge(T).crossings(gap)
    return touches[0] if touches else (2 * np.pi if gap > 0 else turning_phase(T))


def contact_edge(phase: Array, T: float) -> Array:
    """Gap of the spring at the edge of contact, for phases in [0, 2 pi], any shape."""
    return _edge(T).gap(np.asarray(phase, dtype=float))


def edge_rate(phase: Array, gap: Array, T: float) -> Array:
    """d gap/d phase of the touching edge, where its gap is known."""
    if T == 0:
        return np.asarray(-np.sin(phase))
    lost = -np.expm1(-(phase - leaving_phase(gap, T)) / T)
    return np.asarray(((np.cos(phase) - gap) / T - np.sin(phase)) / lost)


def _edge(T: float) -> ContactEdge:
    return edge_under(T, (1,), (1 + 0j,))
