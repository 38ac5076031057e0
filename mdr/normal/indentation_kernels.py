"""A row of springs at depths g of the profile, compiled: its step, and the sum over it, force and radius of a contact.

The load q of the springs that press is taken as linear in g between two nodes. By parts

    F_z = 2 ∫ q dx = 2 [q x - ∫ x dq] at the edge of the contact,    ∫ x dg = F_N/(2 E*) of the shape,

so that an elastic force is exact for any number of springs. What is left is extrapolated from every second node.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.spring.contact import Each, Springs, press
from mdr.spring.path import Path
from mdr.spring.times import new_tools
from mdr.tools.arrays import Array
from mdr.tools.jit import compiled


class Row(NamedTuple):
    """Springs from the centre outwards, at x >= 0."""

    g: Array  #: (n,) depths of the profile
    x: Array  #: (n,) radii
    power: Array  #: (n - 1,) x - x[0] ~ g^power in a cell
    mean: Array  #: (n - 1,) mean of x over a cell
    better: Array  #: (n - 1,) the same, extrapolated from two cells as one


@compiled(nogil=True, error_model="numpy")
def step(s, g, u, v, h, law):
    """Move the springs s (1 + J, n), which are updated, under an indenter that goes from the depth u at the rate v for
    a time: how long each has pressed at its end, (n,), over that time.
    """
    T, modes, arms = law
    each = Each(np.empty(g.size), np.empty(g.size), np.empty(g.size))
    tools = new_tools(h, modes, arms, 0.0, np.int64(0))
    press(s, Springs(g, g), Path(u, v, 0.0, 0.0, 0.0), v, T, modes, arms, tools, each)
    return each.pressed_for


@compiled(nogil=True, error_model="numpy")
def force_of(s, u, v, row, T, arms):
    """Force and radius of the contact of springs s (1 + J, n), with the indenter at the depth u, of the rate v.

    The edge of the contact is where the gap outside closes if the next spring would press too, as dashpots do that
    advance; else it is where the load inside has fallen to zero.
    """
    g, x, n, stiffness = row.g, row.x, row.g.size, 1.0
    q = np.empty(n)
    for k in range(n):
        q[k] = s[0, k] + T * v
    if arms is not None:
        for j in range(arms.rho.size):
            stiffness += arms.rho[j]
            for k in range(n):
                q[k] += arms.rho[j] * s[1 + j, k]
    i = n - 1
    while i >= 0 and not (s[0, i] <= u - g[i] and q[i] > 0.0):
        i -= 1
    if i < 0:
        return 0.0, 0.0
    g_e, q_e, a, o = g[i], q[i], x[i], i + 1
    if o < n:
        slope = q_slope = 0.0
        if T > 0.0 and q[o] > 0.0:
            if o + 1 < n:
                slope = (s[0, o + 1] - s[0, o]) / (g[o + 1] - g[o])
                q_slope = (q[o + 1] - q[o]) / (g[o + 1] - g[o])
            gap = s[0, o] - (u - g[o])
            g_e = g[o] - gap / (1.0 + slope) if slope > -1.0 else g[i]
            g_e = min(max(g_e, g[i]), g[o])
            q_e = q[o] + q_slope * (g_e - g[o])
        else:
            slope = (q[i - 1] - q[i]) / (g[i] - g[i - 1]) if i > 0 else stiffness
            g_e = min(g[i] + q[i] / slope, g[o]) if slope > 0.0 else g[o]
            q_e = 0.0
    total = 0.0
    if g_e > g[i]:
        p, base = row.power[i], max(i, 1)
        a = x[0] + (x[base] - x[0]) * (g_e / g[base]) ** p
        dP = x[0] * (g_e - g[i]) + (g_e * (a - x[0]) - g[i] * (x[i] - x[0])) / (1.0 + p)
        total = (q[i] - q_e) * dP / (g_e - g[i])
    ring = False  # of springs that are free inside: no smooth row
    for k in range(i):
        if s[0, k] > u - g[k]:
            q[k], ring = 0.0, True
    for k in range(i):
        alone = ring or (k == i - 1 and k % 2 == 0)
        total += (q[k] - q[k + 1]) * (row.mean[k] if alone else row.better[k])
    return max(2.0 * (q_e * a + total), 0.0), a
