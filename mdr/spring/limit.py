"""The limit of friction: the most that a spring bears over a stretch of contact, as the force of a state q.

A spring slips at |L[e]| = L[q], and sticks within |L[e]| <= stick L[q]; stick is 1 unless friction falls. `rub`
(line.py, disc.py, returned.py) is given q, and the parabola on which q is held. Here the laws stand:

* *Coulomb*, None: q is the compression s itself. `rub` holds it, and all of this is compiled away.
* *Strength*, a shear strength beside it: coulomb L[s] + c, with c = sqrt(a² - x²) in scaled form. To a constant shear
  stress on a disc of the radius a belongs such a force of the springs (Popov and Heß 2015). With a compression r of
  which L[r] = c, q is coulomb s + r.
* *Falling*, a static coefficient above the kinetic one, is Strength too: stick is their ratio, and nothing is added.
  Forces between L[q] and stick L[q] are those of springs that stick and of none that slip. Yet with a dashpot the force
  of a spring jumps with the mode, and it may stick or slip with the same extension: where friction falls, each spring
  keeps its mode from step to step, in `was` and `now`.

Over a stretch c is the parabola through its values at the begin, the middle and the end, and r the parabola of which it
is the force. The root bends where the edge of contact passes. Where this advances, the spring sticks, but for a time
that `Limit.unseen` bounds (march/dynamics/limit.py); where it comes back, the spring slips, and of its force an area of
the order 3/2 in the step is missed.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.spring.motion import hold
from mdr.spring.path import FAST, LENT, OWN, ROUNDING, size_of
from mdr.tools.arrays import Array
from mdr.tools.jit import inner

SLOW_ARM = 0.01  #: part of its time, up to which an arm hardly relaxes

_inline = inner(forceinline=True, error_model="numpy", fastmath=FAST, **LENT)
_own = inner(forceinline=True, error_model="numpy", fastmath=FAST, **OWN)  # what gives an array to those that own some


NO_MODES, STICKS_ALIKE = np.zeros(0), np.ones(1)


class Strength(NamedTuple):
    """The limit of n springs in a step, where it is not Coulomb's: a share of the normal force, and sqrt(a² - x²) of a
    spring at x, a the radius on which a shear strength acts; and what falls where springs are let go.
    """

    coulomb: float  #: share of the normal force of a spring, over its stiffness, that friction bears
    x2: Array  #: (n,) x² of each spring, in the unit of a²
    a_0: float  #: a² = a_0 + a_1 t + a_2 t², in a unit in which the root is a force over the stiffness
    a_1: float
    a_2: float
    stick: float = 1.0  #: of the limit in slip, up to which a spring sticks
    was: Array = NO_MODES  #: (n,) modes of the springs as the step begins; none unless stick is above 1
    now: Array = NO_MODES  #: (n,) as it ends


class Strengths(NamedTuple):
    """A Strength over a period of n_t steps."""

    coulomb: Array  #: (1,)
    x2: Array  #: (n,)
    a2: Array  #: (n_t, 3) a_0, a_1, a_2 of each step
    stick: Array = STICKS_ALIKE  #: (1,)
    was: Array = NO_MODES  #: as of a Strength; they are none of what a block holds
    now: Array = NO_MODES


class Pressing(NamedTuple):
    """A stretch of contact: what moves q and the top of a spring in it, and what counts as zero."""

    z: tuple[float, float]  #: z_1, z_2 of the parabola of q, with the time from the start of the stretch
    x: tuple[complex, complex]  #: x_1, x_2 of the displacement of the top
    t: float  #: length of the stretch
    k: np.int64  #: row of tools.times that is filled for t, STEP or PART
    begun: float  #: when it begins in the step
    tol: float  #: rounding of a length: what is less counts as zero, of forces and velocities too
    rate_miss: tuple[float, complex]  #: true rates of q and top at the end of the step, less those of the parabolas


@_own
def limit_in(limits, k):
    """The limit in step k of a period."""
    if limits is None:
        return None
    a_0, a_1, a_2 = limits.a2[k, 0], limits.a2[k, 1], limits.a2[k, 2]
    return Strength(limits.coulomb[0], limits.x2, a_0, a_1, a_2, limits.stick[0], limits.was, limits.now)


@_own
def limit_later(limit, t):
    """A limit, its time counted from t on."""
    if limit is None:
        return None
    a_0, a_1 = limit.a_0 + t * (limit.a_1 + t * limit.a_2), limit.a_1 + 2.0 * t * limit.a_2
    return Strength(limit.coulomb, limit.x2, a_0, a_1, limit.a_2, limit.stick, limit.was, limit.now)


def falling(stick: float, n: int) -> Strength | None:
    """The limit of n springs whose friction falls, none of which slips yet; None of Coulomb's, with a stick of 1."""
    if stick == 1.0:
        return None
    return Strength(1.0, np.zeros(n), 0.0, 0.0, 0.0, stick, np.zeros(n), np.zeros(n))


@_own
def of_springs(limit, first, end):
    """The limit of some springs of a row, with modes of their own."""
    if limit is None:
        return None
    coulomb, a_0, a_1, a_2, was = limit.coulomb, limit.a_0, limit.a_1, limit.a_2, limit.was[first:end].copy()
    return Strength(coulomb, limit.x2[first:end], a_0, a_1, a_2, limit.stick, was, np.empty(was.size))


@_inline
def take_modes(limit, state):
    """Modes of the springs from a state (n,), as a step begins."""
    if limit is not None:
        for i in range(limit.was.size):
            limit.was[i] = state[i]


@_inline
def give_modes(limit, state):
    """Modes of the springs into a state (n,), as a step ends."""
    if limit is not None:
        for i in range(limit.now.size):
            state[i] = limit.now[i]


@_inline
def step_over(limits):
    """The modes at the end of a step are those at the start of the next."""
    if limits is not None:
        for i in range(limits.was.size):
            limits.was[i] = limits.now[i]


@_inline
def keep_mode(limit, i, mode):
    """Keep the mode of spring i at the end of a step."""
    if limit is not None and limit.stick > 1.0:
        limit.now[i] = mode


@_inline
def stick_of(limit):
    """The multiple of L[q] up to which springs stick."""
    if limit is None:
        return 1.0
    return limit.stick


@_inline
def limit_at(limit, i, R, t):
    """The limit of spring i at a time of the step, where its normal force is R."""
    if limit is None:
        return R
    return limit.coulomb * R + strength(limit, i, t)


@_inline
def at_limit(limit, s, e, i, pressing, T, arms, tools):
    """The state q, of which q[:, i] has the limit of spring i for its force; a stretch of contact in which that is held
    in the place of s; and area and moment of the normal force, if s is another state, for it is held here.
    """
    if limit is None:
        return s, pressing, (0.0, 0.0)
    q, (z, x, t, k, begun, tol, rate_miss) = tools.room.q, pressing
    c = strengths(limit, i, begun, t)
    for j in range(s.shape[0]):
        q[j, i] = limit.coulomb * s[j, i]
    r_1, r_2 = add_force(q, i, c, t, T, arms)
    area, moment = hold(s, i, z[0], z[1], t, k, T, tools, arms)
    tol += ROUNDING * (abs(q[0, i]) + size_of(e[0, i]))
    moves = limit.coulomb * z[0] + r_1, limit.coulomb * z[1] + r_2
    of_q = Pressing(moves, x, t, k, begun, tol, (limit.coulomb * rate_miss[0], rate_miss[1]))
    return q, of_q, (area, begun * area + moment)


@_inline
def normal_part(limit, borne, beside):
    """Area and moment of the normal force, of those of L[q] that `rub` has found, and those that `at_limit` has."""
    if limit is None:
        return borne
    return beside


@_inline
def strength(limit, i, t):
    """What the strength adds to the limit of spring i at a time of the step."""
    return np.sqrt(max(limit.a_0 + t * (limit.a_1 + t * limit.a_2) - limit.x2[i], 0.0))


@_inline
def strengths(limit, i, begun, t):
    """What the strength adds over a time t, as c_0 + c_1 u + c_2 u²."""
    c_0, middle, end = strength(limit, i, begun), strength(limit, i, begun + 0.5 * t), strength(limit, i, begun + t)
    return c_0, (4.0 * middle - 3.0 * c_0 - end) / t, 2.0 * (c_0 + end - 2.0 * middle) / (t * t)


@_inline
def add_force(q, i, c, t, T, arms):
    """Add the state r to q[:, i] whose force is c_0 + c_1 u + c_2 u² for a time t; its displacement is r_1 u + r_2 u².

    An arm that relaxes in so long a time that it hardly does in this one begins without stretch, as a spring beside the
    long-time one; what it relaxes is met to second order. Any other one goes along with r.
    """
    S, P, D, E = 1.0, 0.0, T, 0.0  # L[r] = S r + D r' - E r'', less P r' u²
    if arms is not None:
        for j in range(arms.rho.size):
            if arms.rate[j] * t < SLOW_ARM:
                S, P = S + arms.rho[j], P + 0.5 * arms.rho[j] * arms.rate[j]
            else:
                theta = 1.0 / arms.rate[j]
                D, E = D + arms.rho[j] * theta, E + arms.rho[j] * theta * theta
    r_1 = (c[1] - 2.0 * D * c[2] / S) / (S + 2.0 * D * P / S)
    r_2 = (c[2] + P * r_1) / S
    q[0, i] = q[0, i] + c[0] - D * r_1 + 2.0 * E * r_2
    if arms is not None:
        for j in range(arms.rho.size):
            if arms.rate[j] * t >= SLOW_ARM:
                q[1 + j, i] += (r_1 - 2.0 * r_2 / arms.rate[j]) / arms.rate[j]
    return r_1, r_2
