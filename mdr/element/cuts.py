"""A step of springs with arms in the plane, cut into parts until their force is right.

Each part is stepped with every stretch of contact at once, and in two halves: what they differ by tells its error, and
the length of the next part. A memory that relaxes within the step is met from the start on, in parts that grow. The
parts depend on nothing but the springs, the motion and the time.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.spring.contact import Springs
from mdr.spring.copies import put
from mdr.spring.motion import glassy
from mdr.spring.path import Path, size_of
from mdr.spring.returned import fill_stages, returned
from mdr.spring.times import STEP, Times, Tools, tools_of
from mdr.tools.arrays import Array
from mdr.tools.jit import inner

_inline = inner(error_model="numpy", fastmath={"reassoc", "contract"})

ACCURACY = 1e-4  #: of the normal force: by which the force in the plane may change when a part of a step is halved
MOST_PARTS = 5000  #: of a step; one that needs more is refused
IN_FLIGHT = 1e-2  #: share of its mean that is added to the normal force at the end of a part: contact may end in it
OF_AREA = 0.1  #: by which an error of the mean force of a part counts less than one at its end
ROUNDING = 1e-10  #: of the unit of depth and of the way in a part, added too
LEAST_SHARE = 1e-15  #: of a step, below which no part is cut


class Pulled(NamedTuple):
    """Force of springs after a step, and its area over the time."""

    end: complex
    normal_end: float
    area: complex
    normal_area: float


class Cuts(NamedTuple):
    """The parts of a step, each a power of two of it: so they stay as they are where the motion changes a little."""

    shares: Array  #: (MOST_PARTS,) of each in the time; contact in it goes in two halves
    n: Array  #: (1,) how many, a whole number


@_inline
def part(s, e, z_0, z_1, x_1, pieces, contact, T, modes, arms, tools, each):
    """A part of a step, each stretch of contact in so many pieces. tools: of the part."""
    (h, of_arms, decay, _), room = tools
    tools = Tools(Times(h, of_arms, decay, pieces), room)
    fill_stages(h, STEP, arms, tools.times)
    path = Path(z_0, z_1, 0.0, x_1, 0.0j)
    of = returned(s, e, Springs(contact.gap, contact.w), path, T, modes, arms, tools, each)
    return Pulled(of.end, of.normal_end, of.area, of.normal_area)


@_inline
def first_length(s, e, z_0, z_1, x_1, dt, contact, T, arms):
    """Length of the first part: the shortest time of an arm whose force matters, and of a dashpot."""
    h, force, fast = dt, 0.0, abs(z_1) + size_of(x_1)
    for i in range(contact.gap.size):
        force += contact.w[i] * max(min(z_0, z_0 + z_1 * dt) - contact.gap[i], 0.0)
    if T > 0.0:
        h = min(h, T / glassy(arms))
    for j in range(arms.rho.size):
        stretch = 0.0
        for i in range(contact.gap.size):
            stretch += contact.w[i] * (abs(s[1 + j, i]) + size_of(e[1 + j, i]))
        if arms.rho[j] * (stretch + fast / arms.rate[j]) > ACCURACY * force:
            h = min(h, 1.0 / arms.rate[j])
    return h


@_inline
def apart(e, other, w, arms):
    """By how much two extensions differ, each as the force that it gives."""
    total = 0.0
    for j in range(e.shape[0]):
        rho = arms.rho[j - 1] if j > 0 else 1.0
        for i in range(w.size):
            total += rho * w[i] * size_of(e[j, i] - other[j, i])
    return total


@_inline
def cut(s, e, z_0, z_1, x_1, contact, T, modes, arms, tools, each, cuts):
    """Springs s, e over a step: what they are Pulled by. cuts: None, or filled."""
    dt, share, done, n = tools.times.h, 1.0, 0.0, 0
    s_1, e_1, s_2, e_2 = np.empty_like(s), np.empty_like(e), np.empty_like(s), np.empty_like(e)
    of = Pulled(0.0j, 0.0, 0.0j, 0.0)
    first = first_length(s, e, z_0, z_1, x_1, dt, contact, T, arms)
    while dt * share > first:
        share *= 0.5
    while done < 1.0 and n < MOST_PARTS:
        share = min(share, 1.0 - done)
        h, z = dt * share, z_0 + done * dt * z_1
        put(s, s_1)
        put(e, e_1)
        put(s, s_2)
        put(e, e_2)
        new = tools_of(h, modes, arms, tools)
        one = part(s_1, e_1, z, z_1, x_1, np.int64(1), contact, T, modes, arms, new, each)
        two = part(s_2, e_2, z, z_1, x_1, np.int64(2), contact, T, modes, arms, new, each)
        mean, least = two.normal_area / h, ROUNDING * (1.0 + h * (abs(z_1) + size_of(x_1)))
        miss = apart(e_1, e_2, contact.w, arms) / (two.normal_end + IN_FLIGHT * mean + least)
        miss = max(miss, OF_AREA * size_of(two.area - one.area) / (h * (mean + least)))
        if not ACCURACY < miss < np.inf:  # what is not finite goes on, and is told
            put(s_2, s)
            put(e_2, e)
            of = Pulled(two.end, two.normal_end, of.area + two.area, of.normal_area + two.normal_area)
            if cuts is not None:
                cuts.shares[n], cuts.n[0] = share, n + 1
            n, done = n + 1, done + share
            share *= 4.0 if 64.0 * miss <= ACCURACY else 2.0 if 8.0 * miss <= ACCURACY else 1.0
        elif share > LEAST_SHARE:
            share *= 0.5 if miss <= 8.0 * ACCURACY else 0.25
        else:
            break
    return of if done == 1.0 else Pulled(of.end * np.nan, of.normal_end, of.area, of.normal_area)


@_inline
def cut_again(s, e, z_0, z_1, x_1, contact, T, modes, arms, tools, each, cuts):
    """The same in the parts that are there."""
    dt, done, of = tools.times.h, 0.0, Pulled(0.0j, 0.0, 0.0j, 0.0)
    for k in range(cuts.n[0]):
        share = cuts.shares[k]
        new, z = tools_of(dt * share, modes, arms, tools), z_0 + done * dt * z_1
        two = part(s, e, z, z_1, x_1, np.int64(2), contact, T, modes, arms, new, each)
        of, done = Pulled(two.end, two.normal_end, of.area + two.area, of.normal_area + two.normal_area), done + share
    return of
