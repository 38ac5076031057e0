"""The compiled march: one spring, one step, one run. Arrays and floats only, in scaled form.

Scaled form (dimensionless.py makes it): time is omega t, normal lengths are divided by du_z, tangential lengths by
mu_0 kappa du_z, spring stiffnesses by their sum. Then mu_0, E* and G* are gone, Coulomb's law
|dk_x L[e]| <= mu_0 dk_z L[s] reads |L[e]| <= L[s], and the same operator L = 1 + T d/dt acts on both sides.

One spring in one step, with compression s and extension e at its start:

* Contact. s follows the indenter, z - gap, as long as that lies above the freely relaxing surface s exp(-h/T);
  this one rule holds the unilateral contact of a Kelvin spring, its release while still compressed
  (L[s] = 0) and its return to the relaxed surface. It is s(t) = sup (z - gap)(t - theta) exp(-theta/T), step by step.
* Friction. The trial step sticks: e moves with the body. Sliding forward all the time keeps L[e] = L[s], so the
  lag p = s - e decays like exp(-h/T); sliding backward, so does s + e. The new e is the trial value clipped between
  these two, which is exact whenever the mode does not change within the step.
* A change of mode within the step: the two competing rates differ by D, which changes sign. With D linear over the
  step, what the new mode adds after the change is D_1²/(|D_0| + |D_1|) h/2 (`after_change`). So the scheme knows when
  slip gave way to stick, stick to slip and contact to flight, not only between which two steps.
* First touch. A spring that touched at a fraction of the step has travelled only the rest of it; without
  this the scheme is of first order.
* Between both ends. Where a rate jumps within a step, as stick ends without a dashpot, or an elastic spring touches or
  lets go, the mean of e over the step is not that of its ends. What is missing follows from what was left to slip, or
  to open, and is added to the sum of the forces at the end of the step. So the body gets the impulse, and the mean over
  a period, that belong to the instant of the change, and their error falls smoothly with the second power of the step,
  wherever between two nodes the changes fall. Arms relax along that path too.

T = 0 is the limit exp(-h/T) = 0, where the bounds become the return mapping |e| <= s; it has a leaner loop.

Friction has no part in the normal motion, which is periodic from the start. So it is known, for every step of the
period, which springs press throughout it and which are free throughout it; as springs stand with rising gap, these are
stretches at the beginning and at the end of the row (`spans`; a hollow face, whose gaps fall, presses as a whole).
Pressed springs need no share of the step and one division, free ones a multiplication; only those between, few but for
fast motions of many springs, go through all the rules.

Materials with Maxwell arms add a state for each arm and direction, x_j' = x' - x_j/theta_j, and go by the same rules
with what the general operator L makes of a spring, or a lag, that is left alone: linear functionals of its state, from
the table of operator.py. Without dashpot, T = 0, the force L[e] itself tells when stick gives way to slip, as in the
elastic loop, and only the end of slip is told by a rate.

The body is a linear oscillator under the force of the springs, with its motion relative to the pull
y_new = a_1 y + a_2 y_old - (b_1 S_new + b_0 S + b_m S_old), S = sum of w e; dimensionless.py derives the five
numbers. S_new depends on y_new, monotonically and piecewise linearly, and is solved for together with it by
Newton's method inside a bracket, halved when that does not get on, to rounding.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import njit
from numba.extending import register_jitable
from numpy.typing import NDArray

from mdr.materials.operator import (
    L_DECAY,
    L_END,
    L_FREE,
    L_GAIN,
    L_RATE,
    L_RATIO,
    L_SHED,
    L_STIFFNESS,
    L_TIME,
)
from mdr.tools.anderson import shares
from mdr.tools.jit import compiled

Array = NDArray[np.float64]

_FAST = {"reassoc", "contract"}  # sums may vectorise; NaN and infinity keep their meaning
_jit = compiled(nogil=True, error_model="numpy", fastmath=_FAST)
# taken in by LLVM, not by numba (inline="always"): it compiles in two thirds of the time, and most steps are faster
_inline = njit(forceinline=True, error_model="numpy", fastmath=_FAST)

# --- what the functions take: arrays and floats by name -------------------------------------------


class Springs(NamedTuple):
    """The row of springs, with rising gap (a hollow face, whose gaps fall, presses as a whole)."""

    gap: Array  #: (n,) depth of each foot below the mean surface position
    w: Array  #: (n,) share of each spring in the stiffness
    lump_margin: float  #: the first one stands for others of its core while L[e + s] exceeds this; negative: no watch


class Motion(NamedTuple):
    """The way of the indenter over one period of n_z steps: normal to the plane, and in the plane, without the body."""

    z: Array  #: (n_z + 1,) normal motion
    z_dot: Array  #: (n_z + 1,) its rate
    v: float  #: steady velocity of the pull
    shaken: bool  #: whether it moves in the plane besides the pull
    dx: Array  #: (n_z,) travel in the plane in each step
    x_dot: Array  #: (n_z + 1,) velocity in the plane
    spans: NDArray[np.int64]  #: (2, n_z) springs before the first press throughout a step, from the second on none does


class Body(NamedTuple):
    """How the body yields: y_new = a_1 y + a_2 y_old - (b_1 S_new + b_0 S + b_m S_old) - what the arms add."""

    rigid: bool  #: whether it does not yield at all
    light: bool  #: whether its velocity jumps as a flat face touches (`growth_of`)
    a_1: float
    a_2: float
    b_1: float
    b_0: float
    b_m: float
    arms: Array  #: (2, J) weights of the sums of w e over each arm, now and one step before


class BodyState(NamedTuple):
    """The memory of the body and of the force on it, updated in place."""

    y: Array  #: (3,) its motion relative to the pull: now, one step before, two steps before
    S: Array  #: (2,) sum of w e, with what paths add to its mean over a step, now and one step before
    arms: Array  #: (2, J) sums of w e over each arm, now and one step before


class Trace(NamedTuple):
    """What a march leaves of each of its steps."""

    y: Array  #: (n_steps,) motion of the body relative to the pull
    S: Array  #: (n_steps,) sum of w e, with what paths add to its mean over the step
    e: Array  #: (n_steps, 1 + J, n) extensions, or (0, 1 + J, n) for none
    s: Array  #: (n_steps, 1 + J, n) compressions, or (0, 1 + J, n) for none


class Step(NamedTuple):
    """One step of the motion."""

    n_in: int  #: the springs before it press throughout the step
    n_out: int  #: those from it on are free throughout
    first: int  #: those from it on may touch or let go
    last: int  #: those before it
    z_0: float
    z_1: float
    zd_0: float
    zd_1: float
    h: float


class Move(NamedTuple):
    """What the body does in a step."""

    du: float  #: its travel
    ud_0: float  #: its velocity at both ends
    ud_1: float
    surge: float  #: how its velocity changes within the step (`growth_of`)
    jump: float
    jumps: bool
    shaken: bool  #: whether slip backward is the rule, so that its beginning and end within a step are told too


class Law(NamedTuple):
    """The material over a step, as far as it tells when a mode changes."""

    dashpot: bool  #: whether the force of x' bounds its jumps; then stiffness is that of the static force over T
    stiffness: float
    damping: float  #: rate at which the lead of one mode over another is damped


class Free(NamedTuple):
    """What the compression s and the lag s - e of a spring do if left alone over a step."""

    s: float  #: compression at the end of the step
    s_rate: float  #: rate at which it falls at the start
    s_end: float  #: and at the end
    s_shed: float  #: with a dashpot, what the arms leave of it at the end without static force; else its elastic part
    lag: float  #: the same of the lag
    lag_rate: float
    lag_end: float
    lag_shed: float


class Flight(NamedTuple):
    """How a spring spends a step: a part in flight, to where it moves if left alone, and a part in contact."""

    e: float  #: extension at the end of a step in flight
    s: float  #: compression likewise
    touched: float  #: share of the step in contact
    per_time: float  #: 1/(touched h), 0 for none


class Seen(NamedTuple):
    """What `observe` fills, of m steps and n springs."""

    sums: Array  #: (N_SUMS,) of which it adds up
    F_x: Array  #: (m,) forces at the end of each step
    F_z: Array  #: (m,)
    slip: Array  #: (m,) least slip velocity of a spring in contact, see `observe`
    mode: NDArray[np.uint8]  #: (m, n) of each spring, or (0, n) for none
    f_x: Array  #: (m, n) force of each spring over its stiffness, or (0, n)
    f_z: Array  #: (m, n)


UNSEEN = 1e-4  #: of a step: elastic lag that springs which slip may have, as arms are followed to the third order
VECTOR = 16  #: springs that a loop takes at once, or a multiple of it
MOST_PASSES = 400  #: over a period, for arms to find their periodic state
STEADY = 1e-12  #: change over a period up to which a spring does the same in every period, of du_z
SETTLED = 1e-3  #: change over a period that a spring may be left with, of du_z: at the edge it may alternate


# --- one spring -----------------------------------------------------------------------------------


@_inline
def after_change(D_0, D_1, h, rate):
    """What the new mode adds in a step through which its lead D runs from D_0 < 0 to D_1 > 0; rate = 1/T damps it."""
    lead = max(D_1, 0.0)  # the rest of the step, after the change, is h lead/(lead + max(-D_0, 0))
    return 0.5 * h * lead * lead / (lead + max(-D_0, 0.0) + 0.5 * rate * h * lead + 1e-300)


@_inline
def end_of_stick(trial, least, most, left_back, left):
    """What the end of stick within a step adds to the mean of the extension over it, and how much of a further move of
    the body goes into that. least, most: extensions of slip, backward and forward, at the end of the step; left_back,
    left: how far from them the spring begins. The path is taken as two straight lines, along stick and along slip.
    """
    over = trial - max(min(trial, most), least)
    before = max(left if over > 0.0 else left_back, 0.0)
    share = before / (before + abs(over) + 1e-300)
    return 0.5 * over * share, 0.5 * share * share


TWELFTH = 1.0 / 12.0  #: of h times the jump of a rate within a step, that the sum over nodes misses where paths bend


@_inline
def end_of_touch(force, limit, du, opened):
    """What the end of contact within a step adds to that mean, of an elastic spring: its force falls from `force` to
    zero with its limit, which is positive at the start. opened: by how much the contact is open at the end of the step,
    du: travel of the body in it.
    """
    share = limit / (limit + opened)  # of the step in contact
    ahead, behind = max(limit + share * du, 1e-300), max(limit - share * du, 1e-300)
    slips = share * min((limit - force) / ahead, (limit + force) / behind, 1.0)
    met = force + du * slips
    jump = TWELFTH * (limit + opened)
    return 0.5 * (force * (slips - 1.0) + met * share) + (jump if met >= 0.0 else -jump)


@_inline
def bend_of(closing_0, closing_1):
    """How much the closing of a gap speeds up within a step: what turns a share of the way into a share of the time."""
    mean = abs(closing_0 + closing_1) + 1e-300
    return min(max((closing_1 - closing_0) / mean, -0.5), 0.5)


@_inline
def surge_of(du, ud_0, ud_1, h):
    """How far the body gets ahead of half its step in the second half: what it gains while its velocity grows.

    A spring that touches for the last share of a step sees the body travel share * (du + (1 - share) * surge).
    """
    most = abs(du)  # no more than reversal within the step
    return min(max(0.5 * h * (ud_1 - ud_0), -most), most)


@_inline
def growth_of(du, ud_0, ud_1, h, jumps):
    """How the velocity of the body changes within a step: steadily (surge), or all at once as it touches (jump).

    A body without mass takes at once the velocity that a flat face gives it as it touches. Until then it goes on as
    before: springs that touch for the last share of a step see it travel du - (1 - share) ud_0 h, which is
    share * du + (1 - share) * jump.
    """
    return (0.0, du - ud_0 * h) if jumps else (surge_of(du, ud_0, ud_1, h), 0.0)


@_inline
def touches_flat(gap, w, z):
    """Whether at least half of the springs that the indenter has reached at z stand alike, and so touch at once."""
    flat = reached = 0.0
    for i in range(gap.size):
        if gap[i] >= z:
            break
        reached += w[i]
        flat += w[i] if gap[i] <= gap[0] + 1e-12 else 0.0
    return flat > 0.5 * reached


@_inline
def moved(du, ud_0, ud_1, h, jumps, shaken):
    """What the body does in a step, from its travel and its velocities at both ends."""
    surge, jump = growth_of(du, ud_0, ud_1, h, jumps)
    return Move(du, ud_0, ud_1, surge, jump, jumps, shaken)


@_inline
def latenesses(step, move, shaken):
    """What elastic springs that turned from slip to stick within the step fall behind, forward and backward."""
    late = after_change(step.zd_0 - move.ud_0, step.zd_1 - move.ud_1, step.h, 0.0) if step.zd_0 < move.ud_0 else 0.0
    back = shaken and step.zd_0 < -move.ud_0
    return late, after_change(step.zd_0 + move.ud_0, step.zd_1 + move.ud_1, step.h, 0.0) if back else 0.0


@_inline
def elastic_spring(e, gap, z_1, move, inverse_dz, bend, late, late_back):
    """One elastic spring over one step: new extension, compression, share of the step in contact, trial extension.

    late, late_back: of `latenesses`.
    """
    s = max(z_1 - gap, 0.0)
    way = min(s * inverse_dz, 1.0)
    travelled = way * ((1.0 - bend) + bend * way)
    trial = e + travelled * ((move.du + move.surge) - travelled * move.surge) + (1.0 - travelled) * move.jump
    return max(min(trial, s - travelled * late), travelled * late_back - s), s, travelled, trial


@_inline
def first_touch(x, travelled):
    """What the path of an elastic spring adds to that mean which touches and goes to x in the last share of the step,
    `travelled`.
    """
    return x * (TWELFTH / max(travelled, 1e-9) - 0.5 * (1.0 - travelled)) if travelled > 0.0 else 0.0


@_inline
def slip_or_stick(s, trial, travelled, step, move, law, free, shaken):
    """New extension of a spring with memory that is compressed to s and would stick at `trial`.

    travelled: share of the step in contact. shaken: as of Move, known when this is compiled.
    """
    D_0 = (step.zd_0 - move.ud_0) + free.lag_rate  # lead of the sinking indenter over the body; > 0: sticks at first
    sticks = D_0 > 0.0
    held = law.stiffness * (max(s - trial, 0.0) - free.lag_shed)
    D_1 = (step.zd_1 - move.ud_1) + (held if sticks else free.lag_end)
    turn = -1.0 if sticks else 1.0
    change = after_change(turn * D_0, turn * D_1, step.h, law.damping) if (law.dashpot or not sticks) else 0.0
    forward, backward = s - free.lag, (free.s + free.s) - free.lag - s
    if not shaken:
        first = min((trial if (sticks and law.dashpot) else forward) - travelled * change, forward)
        first = first if law.dashpot else min(first, trial)
        return max(first, backward)
    # the same of slip backward, seen in a mirror: e and the motion in the plane turned, the lag s + e
    B_0 = (step.zd_0 + move.ud_0) + (free.s_rate + free.s_rate - free.lag_rate)
    sticks_back = B_0 > 0.0
    held_back = law.stiffness * (max(s + trial, 0.0) - (free.s_shed + free.s_shed - free.lag_shed))
    B_1 = (step.zd_1 + move.ud_1) + (held_back if sticks_back else free.s_end + free.s_end - free.lag_end)
    turn_back = -1.0 if sticks_back else 1.0
    change_back = after_change(turn_back * B_0, turn_back * B_1, step.h, law.damping)
    if law.dashpot:
        at_first = (trial if sticks_back else backward) if sticks else forward
        at_first -= travelled * change if sticks_back else 0.0
        at_first += travelled * change_back if sticks else 0.0
        return max(min(at_first, forward), backward)
    most = forward if sticks else forward - travelled * change
    least = backward if sticks_back else backward + travelled * change_back
    return max(min(trial, most), least)


@_inline
def viscous_spring(e, s_0, gap, step, move, law, free, shaken):
    """One spring with memory over one step: new extension, compression, share of it in contact, trial extension."""
    pressed = step.z_1 - gap
    ahead = s_0 - (step.z_0 - gap)  # height of the relaxed surface over the indenter at the start
    leaves = law.dashpot and ahead <= 0.0
    opening = step.zd_1 + law.stiffness * (pressed - free.s_shed)
    leaving = after_change(-(step.zd_0 + free.s_rate), -opening, step.h, law.damping) if leaves else 0.0
    s = max(pressed + leaving, free.s)
    rise = s - free.s
    way = rise / (rise + max(ahead, 0.0) + 1e-300)
    travelled = way * (1.0 - bend_of(step.zd_0 + free.s_rate, step.zd_1 + free.s_end) * (1.0 - way))
    flown = 1.0 - travelled
    trial = e + flown * (free.s - free.lag - e + move.jump) + travelled * (move.du + flown * move.surge)
    return slip_or_stick(s, trial, travelled, step, move, law, free, shaken), s, travelled, trial


@_inline
def kelvin_free(e, s, rate, decay):
    """What a Kelvin spring does if left alone: one exponential. rate = 1/T, decay = exp(-h/T)."""
    lag = s - e
    s_free, lag_free = s * decay, lag * decay
    return Free(s_free, s * rate, s_free * rate, 0.0, lag_free, lag * rate, lag_free * rate, 0.0)


# --- one step -------------------------------------------------------------------------------------
# e, s: (1 + J, n), of which a step fills the first row


@register_jitable(inline="always")
def indices(first, last):
    """The numbers first ... last - 1, known not to be negative: else a loop over them is not vectorised."""
    return range(np.uint64(first), np.uint64(last))


@_inline
def at_edge(e_0, e_1, above, travelled, inverse_fall):
    """What an elastic spring that may touch or let go within a step adds to the mean of its extension, where it slips
    until it lets go. above: z - gap at the start; inverse_fall: 1/(z_0 - z_1), or 0 of an indenter that sinks.
    """
    share = above * inverse_fall  # of the step in contact
    if 0.0 < share <= 1.0:
        return 0.5 * e_0 * (share - 1.0) + (TWELFTH if e_0 >= 0.0 else -TWELFTH) / inverse_fall
    return first_touch(e_1, travelled) if above <= 0.0 else 0.0


@_inline
def paces(step, du):
    """How fast the limits of slip close in on pressed elastic springs that stick, over a step: forward and backward;
    not positive where they draw away.
    """
    sinks = step.z_1 - step.z_0
    return du - sinks, -du - sinks


@_inline
def elastic_step_in_place(e, springs, step, move, n_at_rest, ends):
    """All elastic springs over one step of a rigid pull, which asks for no state twice: updates e, returns sum(w e) and
    how far those that stick are from slipping forward, all together.

    n_at_rest: the springs from it on were free in the step before. ends: whether some may have stuck and slip forward
    by now, known when this is compiled; then that is told, and the sum has what the end of stick adds, with what a jump
    of the rate costs a sum over nodes. A body gets no more than the impulse: its force must not fall as it moves on.
    """
    gap, w, z_0, z_1, du = springs.gap, springs.w, step.z_0, step.z_1, move.du
    inverse_dz = 1.0 / (z_1 - z_0) if z_1 > z_0 else 1e300
    inverse_fall = 1.0 / (z_0 - z_1) if z_1 < z_0 else 0.0
    bend = bend_of(step.zd_0, step.zd_1)
    late, late_back = latenesses(step, move, move.shaken)
    pace = paces(step, du)[0]
    total, away, added, ended = 0.0, 0.0, 0.0, 0.0
    for i in indices(0, step.n_in):
        s = z_1 - gap[i]
        if ends:
            left = (z_0 - gap[i]) - e[0, i]
            more = w[i] * max(left * (pace - left), 0.0)
            added += more
            ended += w[i] if more > 0.0 else 0.0
            away += max(left - pace, 0.0)
        e[0, i] = max(min(e[0, i] + du, s - late), late_back - s)
        total += w[i] * e[0, i]
    for i in indices(step.n_in, step.n_out):
        if ends:
            left = (z_0 - gap[i]) - e[0, i]
            more = w[i] * (max(left * (pace - left), 0.0) if gap[i] < min(z_0, z_1) else 0.0)
            added += more
            ended += w[i] if more > 0.0 else 0.0
            away += max(left - pace, 0.0)
        e_0 = e[0, i]
        e_1, _, travelled, _ = elastic_spring(e_0, gap[i], z_1, move, inverse_dz, bend, late, late_back)
        e[0, i] = e_1
        total += w[i] * (e_1 + at_edge(e_0, e_1, z_0 - gap[i], travelled, inverse_fall))
    for i in indices(step.n_out, n_at_rest):
        e[0, i] = 0.0
    return total + (0.5 * added / pace - TWELFTH * ended * pace if ends else 0.0), away


@_jit
def elastic_step(e_0, e_1, springs, step, move):
    """All elastic springs over one step: fills e_1 and returns sum(w e) and the stiffness that stuck."""
    return elastic_springs(e_0, e_1, springs, step, move, False, False)


@_jit
def slipping_elastic_step(e_0, e_1, springs, step, move):
    """The same where springs that stuck may slip forward; functions of their own, as the march is faster where it can
    take one of them in.
    """
    return elastic_springs(e_0, e_1, springs, step, move, False, True)


@_jit
def shaken_elastic_step(e_0, e_1, springs, step, move):
    """The same under a shake."""
    return elastic_springs(e_0, e_1, springs, step, move, True, True)


@_inline
def elastic_springs(e_0, e_1, springs, step, move, shaken, ends):
    """As `elastic_step`; whether they are shaken, and whether springs that stuck may slip forward, is known when this
    is compiled.
    """
    gap, w, z_0, z_1, du = springs.gap, springs.w, step.z_0, step.z_1, move.du
    inverse_dz = 1.0 / (z_1 - z_0) if z_1 > z_0 else 1e300
    inverse_fall = 1.0 / (z_0 - z_1) if z_1 < z_0 else 0.0
    bend = bend_of(step.zd_0, step.zd_1)
    late, late_back = latenesses(step, move, shaken)
    pace = paces(step, du)[0]
    half = 0.5 / pace if pace > 0.0 else 0.0
    given = 0.0 if shaken else 2.0 * half * half  # how much of a further move goes into the sum where stick ends
    total = 0.0
    stuck = 0.0
    for i in indices(0, step.n_in):
        s = z_1 - gap[i]
        e = max(min(e_0[0, i] + du, s - late), late_back - s)
        e_1[0, i] = e
        turned = (late > 0.0 and e > 0.0) or (shaken and late_back > 0.0 and e < 0.0)
        if ends:
            left = max((z_0 - gap[i]) - e_0[0, i], 0.0)
            total += w[i] * (e + max(left * (pace - left), 0.0) * half)
            stuck += w[i] * (1.0 if (e == e_0[0, i] + du or turned) else given * left * left)
        else:
            total += w[i] * e
            stuck += w[i] if (e == e_0[0, i] + du or turned) else 0.0
    for i in indices(step.n_in, step.n_out):
        e, _, travelled, trial = elastic_spring(e_0[0, i], gap[i], z_1, move, inverse_dz, bend, late, late_back)
        e_1[0, i] = e
        total += w[i] * (e + at_edge(e_0[0, i], e, z_0 - gap[i], travelled, inverse_fall))
        turned = (late > 0.0 and e > 0.0) or (shaken and late_back > 0.0 and e < 0.0)
        stuck += w[i] * (1.0 if move.jumps else travelled) if (e == trial or turned) else 0.0
        if ends:
            left = max((z_0 - gap[i]) - e_0[0, i], 0.0)
            presses = gap[i] < min(z_0, z_1)
            total += w[i] * (max(left * (pace - left), 0.0) * half if presses else 0.0)
            stuck += w[i] * (given * left * left if presses and not (e == trial or turned) else 0.0)
    for i in indices(step.n_out, gap.size):
        e_1[0, i] = 0.0
    return total, stuck


@_jit
def kelvin_step(e_0, s_0, e_1, s_1, springs, step, move, rate, decay):
    """All Kelvin springs over one step: fills e_1 and s_1, returns sum(w e) and the stiffness that stuck."""
    return kelvin_springs(e_0, s_0, e_1, s_1, springs, step, move, rate, decay, False)


@_jit
def shaken_kelvin_step(e_0, s_0, e_1, s_1, springs, step, move, rate, decay):
    """The same under a shake."""
    return kelvin_springs(e_0, s_0, e_1, s_1, springs, step, move, rate, decay, True)


@_inline
def kelvin_springs(e_0, s_0, e_1, s_1, springs, step, move, rate, decay, shaken):
    """As `kelvin_step`; whether they are shaken is known when this is compiled."""
    gap, w, du, law = springs.gap, springs.w, move.du, Law(True, rate, rate)
    total = 0.0
    stuck = 0.0
    for i in indices(0, step.n_in):
        s = step.z_1 - gap[i]
        trial = e_0[0, i] + du
        free = kelvin_free(e_0[0, i], s_0[0, i], rate, decay)
        e = slip_or_stick(s, trial, 1.0, step, move, law, free, shaken)
        e_1[0, i] = e
        s_1[0, i] = s
        total += w[i] * e
        stuck += w[i] if abs(e - trial) <= 1e-9 * abs(du) else 0.0
    for i in indices(step.n_in, step.n_out):
        free = kelvin_free(e_0[0, i], s_0[0, i], rate, decay)
        e, s, travelled, trial = viscous_spring(e_0[0, i], s_0[0, i], gap[i], step, move, law, free, shaken)
        e_1[0, i] = e
        s_1[0, i] = s
        total += w[i] * e
        stuck += w[i] * (1.0 if move.jumps else travelled) if abs(e - trial) <= 1e-9 * abs(du) else 0.0
    for i in indices(step.n_out, gap.size):
        e_1[0, i] = e_0[0, i] * decay
        s_1[0, i] = s_0[0, i] * decay
        total += w[i] * e_1[0, i]
    return total, stuck


@_inline
def put(x, out):
    """Copy x (n,) into out (n,): a loop compiles in a hundredth of the time that out[:] = x takes."""
    for i in indices(0, x.size):
        out[i] = x[i]


class Column(NamedTuple):
    """The weights of one row of a state, x or an arm, in the functionals of the operator's table (operator.py)."""

    free: float
    rate: float
    end: float
    shed: float


@_inline
def column_of(table, k):
    """Column k of the table; all zero beyond its last."""
    j, weight = min(k, table.shape[1] - 1), 1.0 if k < table.shape[1] else 0.0
    free, rate, end, shed = table[L_FREE, j], table[L_RATE, j], table[L_END, j], table[L_SHED, j]
    return Column(weight * free, weight * rate, weight * end, weight * shed)


@_inline
def add_three(e, s, table, k, first, n_out, sheds, adds, out):
    """What rows k to k + 2 of the state have in `free_response`; sheds: whether to fill rows 3 and 7, adds: whether to
    add to what is there, both known when this is compiled. Beyond its end the last row stands again, without weight.
    """
    a, b, c, last = column_of(table, k), column_of(table, k + 1), column_of(table, k + 2), e.shape[0] - 1
    s_a, s_b, s_c = s[k], s[min(k + 1, last)], s[min(k + 2, last)]
    e_a, e_b, e_c = e[k], e[min(k + 1, last)], e[min(k + 2, last)]
    for i in indices(0, n_out):
        x, y, z = s_a[i], s_b[i], s_c[i]
        p, q, r = x - e_a[i], y - e_b[i], z - e_c[i]
        out[0, i] = (out[0, i] if adds else 0.0) + (a.free * x + b.free * y + c.free * z)
        out[4, i] = (out[4, i] if adds else 0.0) + (a.free * p + b.free * q + c.free * r)
        out[5, i] = (out[5, i] if adds else 0.0) + (a.rate * p + b.rate * q + c.rate * r)
        out[6, i] = (out[6, i] if adds else 0.0) + (a.end * p + b.end * q + c.end * r)
        if sheds:
            out[3, i] = (out[3, i] if adds else 0.0) + (a.shed * x + b.shed * y + c.shed * z)
            out[7, i] = (out[7, i] if adds else 0.0) + (a.shed * p + b.shed * q + c.shed * r)
    for i in indices(first, n_out):
        x, y, z = s_a[i], s_b[i], s_c[i]
        out[1, i] = (out[1, i] if adds else 0.0) + (a.rate * x + b.rate * y + c.rate * z)
        out[2, i] = (out[2, i] if adds else 0.0) + (a.end * x + b.end * y + c.end * z)
    for i in indices(n_out, e.shape[1]):
        x, y, z = s_a[i], s_b[i], s_c[i]
        p, q, r = x - e_a[i], y - e_b[i], z - e_c[i]
        out[0, i] = (out[0, i] if adds else 0.0) + (a.free * x + b.free * y + c.free * z)
        out[4, i] = (out[4, i] if adds else 0.0) + (a.free * p + b.free * q + c.free * r)


@_jit
def free_response(e, s, table, first, n_out, sheds, out):
    """What compression and lag of every spring do if left alone over the step: fills out (8, n), rows as in Free; of
    springs from n_out on, which are free throughout, only the ends; of those before `first` not the rates of the
    compression; without `sheds` not what is shed.
    """
    if sheds:
        add_three(e, s, table, 0, first, n_out, True, False, out)
        for k in range(3, e.shape[0], 3):
            add_three(e, s, table, k, first, n_out, True, True, out)
    else:
        add_three(e, s, table, 0, first, n_out, False, False, out)
        for k in range(3, e.shape[0], 3):
            add_three(e, s, table, k, first, n_out, False, True, out)


@_inline
def free_of(look, i):
    """Column i of what `free_response` filled."""
    return Free(look[0, i], look[1, i], look[2, i], look[3, i], look[4, i], look[5, i], look[6, i], look[7, i])


@_jit
def arms_step(e_0, s_0, e_1, s_1, look, springs, step, move, law):
    """All springs of a material with arms over one step: fills e_1 and s_1, returns sum(w e) and what stuck, and
    whether the stick of any ends in the step.

    look (8, n): of `free_response`, without what is shed: with a dashpot see `dashpot_arms_step`.
    """
    return arms_springs(e_0, s_0, e_1, s_1, look, springs, step, move, Law(False, 0.0, law.damping), False, False)


@_jit
def slipping_arms_step(e_0, s_0, e_1, s_1, look, springs, step, move, law):
    """The same where springs that stuck may slip by the end; look is full."""
    return arms_springs(e_0, s_0, e_1, s_1, look, springs, step, move, Law(False, 0.0, law.damping), False, True)


@_jit
def dashpot_arms_step(e_0, s_0, e_1, s_1, look, springs, step, move, law):
    """The same with a dashpot; look is full."""
    law = Law(True, law.stiffness, law.damping)
    return arms_springs(e_0, s_0, e_1, s_1, look, springs, step, move, law, False, False)


@_jit
def shaken_arms_step(e_0, s_0, e_1, s_1, look, springs, step, move, law):
    """The same under a shake; look is full."""
    return arms_springs(e_0, s_0, e_1, s_1, look, springs, step, move, law, True, True)


@_inline
def arms_springs(e_0, s_0, e_1, s_1, look, springs, step, move, law, shaken, ends):
    """As `arms_step`; whether they are shaken, and whether springs that stuck may slip by the end, is known when this
    is compiled.
    """
    gap, w, du = springs.gap, springs.w, move.du
    total, stuck, ended = 0.0, 0.0, 0.0
    for i in indices(0, step.n_in):
        s = step.z_1 - gap[i]
        trial = e_0[0, i] + du
        free = free_of(look, i)
        e = slip_or_stick(s, trial, 1.0, step, move, law, free, shaken)
        e_1[0, i] = e
        s_1[0, i] = s
        total += w[i] * e
        sticks = abs(e - trial) <= 1e-9 * abs(du)
        stuck += w[i] if sticks else 0.0
        if ends:
            ended += 0.0 if sticks else w[i] * min(free.lag_shed, 2.0 * free.s_shed - free.lag_shed)
    for i in indices(step.n_in, step.n_out):
        free = free_of(look, i)
        e, s, travelled, trial = viscous_spring(e_0[0, i], s_0[0, i], gap[i], step, move, law, free, shaken)
        e_1[0, i] = e
        s_1[0, i] = s
        total += w[i] * e
        sticks = abs(e - trial) <= 1e-9 * abs(du)
        stuck += w[i] * (1.0 if move.jumps else travelled) if sticks else 0.0
        if ends:
            ended += 0.0 if sticks else w[i] * min(free.lag_shed, 2.0 * free.s_shed - free.lag_shed)
    for i in indices(step.n_out, gap.size):
        e_1[0, i] = look[0, i] - look[4, i]
        s_1[0, i] = look[0, i]
        total += w[i] * e_1[0, i]
    return total, stuck, ended > UNSEEN * step.h and not law.dashpot


# --- what happens between both ends of a step: by how much the mean of sum(w e) over it is more than they tell ---


@_jit
def between_elastic(e, springs, step, du, rigid):
    """What elastic springs that stick as a step begins add more, where they let go in it or slip backward by its end;
    e: at its start. rigid: whether the pull is, see `elastic_step_in_place`.
    """
    gap, w, total, pace, added, ended = springs.gap, springs.w, 0.0, paces(step, du)[1], 0.0, 0.0
    for i in range(step.first, step.last if step.z_1 < step.z_0 else step.first):
        above, opened = step.z_0 - gap[i], gap[i] - step.z_1
        if above > 0.0 and opened >= 0.0:  # beyond what `at_edge` knows
            known = at_edge(e[0, i], 0.0, above, 0.0, 1.0 / (above + opened))
            total += w[i] * (end_of_touch(e[0, i], above, du, opened) - known)
    if pace > 0.0:
        for i in indices(0, step.last):
            left = (step.z_0 - gap[i]) + e[0, i]
            more = w[i] * (max(left * (pace - left), 0.0) if gap[i] < min(step.z_0, step.z_1) else 0.0)
            added += more
            ended += w[i] if more > 0.0 else 0.0
        total -= 0.5 * added / pace - (TWELFTH * ended * pace if rigid else 0.0)
    return total


@_inline
def end_of_pressed_stick(trial, s, free):
    """`end_of_stick` of a spring with arms and no dashpot that presses throughout a step."""
    flown, reach, limit, force = free.s - free.lag, s - free.s, free.s_shed, free.s_shed - free.lag_shed
    return end_of_stick(trial, flown - reach, flown + reach, limit + force, limit - force)


@_jit
def between_arms(e, s_0, s_1, look, along, springs, step, du):
    """What springs with arms and no dashpot add that end their stick in a step, and how much of a further move of the
    body goes into that. e, s_0, s_1: extension at its start, compression at both ends. Puts what each path adds into
    along (n,).

    Where they touch or let go nothing is added: in a brief contact slow arms magnify what is not known of the path.
    """
    gap, w, total, given = springs.gap, springs.w, 0.0, 0.0
    for i in indices(0, step.last):
        free = free_of(look, i)
        presses = s_0[0, i] - (step.z_0 - gap[i]) <= 1e-14 * (1.0 + abs(gap[i])) and step.z_1 - gap[i] > free.s
        more, part = end_of_pressed_stick(e[0, i] + du, s_1[0, i], free)
        along[i] = more if presses else 0.0
        total += w[i] * along[i]
        given += w[i] * (part if presses else 0.0)
    return total, given


@_jit
def relax_more(x, along, table, last):
    """What arms, the rows 1 to J of x, relax more in a step whose path adds `along` (n,) to the mean of a straight one,
    of the springs before `last`.
    """
    for k in range(1, x.shape[0]):
        share = table[L_GAIN, k] * (1.0 - table[L_DECAY, k])
        for i in indices(0, last):
            x[k, i] -= share * along[i]


@_jit
def stretch_arms(e_0, e_1, s_0, s_1, table):
    """The arms (rows 1 to J) of all springs at the end of a step, from their start and from the path of row 0."""
    for k in range(1, e_0.shape[0]):
        decay, gain = table[L_DECAY, k], table[L_GAIN, k]
        before, after, path_0, path_1 = e_0[k], e_1[k], e_0[0], e_1[0]
        below, pressed, way_0, way_1 = s_0[k], s_1[k], s_0[0], s_1[0]
        for i in indices(0, e_0.shape[1]):
            after[i] = decay * before[i] + gain * (path_1[i] - path_0[i])
            pressed[i] = decay * below[i] + gain * (way_1[i] - way_0[i])


@_inline
def law_of(table):
    """The law of a material from its table over a step."""
    stiffness = table[L_STIFFNESS, 0]
    damping = stiffness
    if stiffness <= 0.0:
        damping = 0.0
        for k in range(1, table.shape[1]):
            damping -= table[L_RATE, k]
    return Law(stiffness > 0.0, stiffness, damping)


# --- one run --------------------------------------------------------------------------------------


@_jit
def press_spring(x, gap, z, zd, table, k_0, n_steps, force, touches, path):
    """One spring through normal motion from step k_0 on: x (1 + J,) is updated, the sum of its compressions returned.

    force, touches, path (n_z,), or empty: at z[0] ... z[n_z - 1] its normal force, the share of the step before in
    which it was in contact (-1 where it follows the indenter without pressing, 0 where it is free), its compression.
    """
    n_z = z.size - 1
    h = 2.0 * np.pi / n_z
    law, at_rest = law_of(table), Move(0.0, 0.0, 0.0, 0.0, 0.0, False, False)
    total = 0.0
    for j in range(n_steps):
        k = (k_0 + j) % n_z
        free = rate = end = shed = 0.0
        for a in range(x.size):
            free += table[L_FREE, a] * x[a]
            rate += table[L_RATE, a] * x[a]
            end += table[L_END, a] * x[a]
            shed += table[L_SHED, a] * x[a]
        step = Step(0, 0, 0, 0, z[k], z[k + 1], zd[k], zd[k + 1], h)
        alone = Free(free, rate, end, shed, 0.0, 0.0, 0.0, 0.0)
        _, value, share, _ = viscous_spring(0.0, x[0], gap, step, at_rest, law, alone, False)
        for a in range(1, x.size):
            x[a] = table[L_DECAY, a] * x[a] + table[L_GAIN, a] * (value - x[0])
        x[0] = value
        total += value
        if force.size > 0:
            normal = value + table[L_TIME, 0] * zd[k + 1]
            for a in range(1, x.size):
                normal += table[L_RATIO, a] * x[a]
            follows = value > 0.0 and value <= z[k + 1] - gap
            presses = follows and normal > 0.0
            force[(k + 1) % n_z] = normal if presses else 0.0
            touches[(k + 1) % n_z] = share if presses else (-1.0 if follows else 0.0)
            path[(k + 1) % n_z] = value
    return total


@_jit
def settle_spring(x, guess, gap, z, zd, table, force, touches, path):
    """One spring in its periodic normal motion: x (1 + J,) at z[0]; returns its sum of compressions, NaN if none is
    found, and what it still changes by over a period.

    Without arms one period is its memory. With arms the passes go on, from the greatest depth, where it presses: what
    an arm changed in one, over the share 1 - exp(-2 pi/theta) that it forgets in it, is added to its start, which is
    exact for a spring that keeps contact; where changes grow, half as much of what is beyond the plain change. Every
    third time, where the last two changes are alike, what they tend to is added at once. guess (1 + J,): arms to begin
    with, zero or those of a neighbour; becomes this spring's.
    """
    start, move, last = np.empty(x.size), np.zeros(x.size), np.zeros(x.size)
    total = 0.0
    n_z = z.size - 1
    deepest = np.argmax(z[:n_z])
    put(guess, x)
    x[0] = max(z[deepest] - gap, 0.0)
    trust, before, change, size = 1.0, np.inf, 0.0, 0.0
    for turn in range(MOST_PASSES):
        put(x, start)
        total = press_spring(x, gap, z, zd, table, deepest, n_z, force, touches, path)
        change, size = 0.0, 0.0
        for j in range(x.size):
            change = max(change, abs(x[j] - start[j]))
            size = max(size, abs(x[j]))
        if turn > 0 and change <= 1e-13 * size + 1e-15 * abs(gap):  # z - gap is known to its rounding
            break
        grows = change > before
        trust = 0.5 * trust if grows else trust
        before = change
        shared = length = 0.0
        for j in range(1, x.size):
            plain = x[j] - start[j]
            far = -plain / np.expm1(-2.0 * np.pi / table[L_TIME, j])
            last[j], move[j] = move[j], plain + trust * (far - plain)
            shared += table[L_RATIO, j] * last[j] * move[j]
            length += table[L_RATIO, j] * last[j] * last[j]
        rate = shared / length if turn % 3 == 2 and length > 0.0 and not grows else 0.0
        more = 1.0 / (1.0 - rate) if 0.0 < rate < 0.9999 else 1.0
        for j in range(1, x.size):
            x[j] = start[j] + more * move[j]
    if not change <= SETTLED:
        total = np.nan
    put(x, guess)
    press_spring(x, gap, z, zd, table, deepest, (n_z - deepest) % n_z, np.empty(0), np.empty(0), np.empty(0))
    return total, change


@_jit
def settle_normal(s, gap, w, z, zd, table, spans, S):
    """Put every spring into the periodic normal motion, at its start z[0]; fills S (n_z,) with sum(w s) at z[0] to
    z[n_z - 1] and what the paths in the step before add to the mean of it, NaN if springs with arms find none. Returns
    the mean of sum(w s) alone.

    s: (1 + J, n). Without arms one period is the memory of a spring in the normal direction, so a second pass over the
    period is periodic; springs with arms are settled one by one. Fills spans (2, n_z): how many of the first springs
    follow the indenter at both ends of a step, and from which one on none does at either.
    """
    n_z, n = z.size - 1, gap.size
    h = 2.0 * np.pi / n_z
    n_x = table.shape[1]
    decay, rate = table[L_DECAY, 0], table[L_RATE, 0]
    steady, found, mean = True, True, 0.0
    S[:] = 0.0
    inner, outer = np.full(n_z + 1, n), np.zeros(n_z + 1, dtype=np.int64)  # at z[0] ... z[n_z]
    if n_x > 1:
        force, touches, path = np.empty(n_z), np.empty(n_z), np.empty(n_z)
        x, guess = np.empty(n_x), np.zeros(n_x)
        for i in range(n):
            total, change = settle_spring(x, guess, gap[i], z, zd, table, force, touches, path)
            for a in range(n_x):
                s[a, i] = x[a]
            found = found and not np.isnan(total)
            steady = steady and change <= STEADY
            for k in range(n_z):
                S[k] += w[i] * path[k]
                mean += w[i] * path[k]
                if touches[k] == 0.0:
                    inner[k] = min(inner[k], i)
                else:
                    outer[k] = i + 1
        inner[n_z], outer[n_z] = inner[0], outer[0]
    else:
        for i in range(n):
            s[0, i] = max(z[0] - gap[i], 0.0)
        once = np.empty(n)
        law, at_rest = Law(True, rate, rate), Move(0.0, 0.0, 0.0, 0.0, 0.0, False, False)
        for turn in range(1 if decay == 0.0 else 3):  # the third is for spans, and tells whether it is like the second
            put(s[0], once)
            mean = 0.0
            for k in range(n_z):
                step = Step(0, 0, 0, 0, z[k], z[k + 1], zd[k], zd[k + 1], h)
                inverse_dz = 1.0 / (z[k + 1] - z[k]) if z[k + 1] > z[k] else 1e300
                bend = bend_of(zd[k], zd[k + 1])
                total = 0.0
                least, most = n, 0
                for i in range(n):
                    above, pressed, more = z[k] - gap[i], z[k + 1] - gap[i], 0.0
                    if decay == 0.0:
                        value = max(pressed, 0.0)
                        if above <= 0.0 and pressed > 0.0:
                            share = elastic_spring(0.0, gap[i], z[k + 1], at_rest, inverse_dz, bend, 0.0, 0.0)[2]
                            more = first_touch(value, share)
                        elif above > 0.0 and pressed <= 0.0:
                            more = end_of_touch(above, above, 0.0, -pressed)
                    else:
                        alone = kelvin_free(s[0, i], s[0, i], rate, decay)
                        _, value, _, _ = viscous_spring(s[0, i], s[0, i], gap[i], step, at_rest, law, alone, False)
                    s[0, i] = value
                    total += w[i] * (value + more)
                    mean += w[i] * value
                    follows = value > 0.0 and value <= z[k + 1] - gap[i]
                    least = min(least, n if follows else i)
                    most = max(most, i + 1 if follows else 0)
                S[(k + 1) % n_z] = total
                if turn > 0 or decay == 0.0:
                    inner[k + 1], outer[k + 1] = min(inner[k + 1], least), max(outer[k + 1], most)
        inner[0], outer[0] = inner[n_z], outer[n_z]
        for i in range(n):
            steady = steady and (decay == 0.0 or abs(s[0, i] - once[i]) <= STEADY * (1.0 + s[0, i]))
    if not steady:  # in coarse steps the touches of springs at the edge may alternate
        inner[:], outer[:] = 0, n
    for k in range(n_z):
        spans[0, k], spans[1, k] = min(inner[k], inner[k + 1]), max(outer[k], outer[k + 1])
    if not found:
        S[:] = np.nan
    return mean / n_z


@_inline
def step_of(motion, k, n, h):
    """Step k of the period; n_in rounded down, unless all press, and n_out up, so that whole vectors go through each
    loop.
    """
    first, last, z, zd = motion.spans[0, k], motion.spans[1, k], motion.z, motion.z_dot
    n_in = n if first == n else first // VECTOR * VECTOR
    n_out = min((last + VECTOR - 1) // VECTOR * VECTOR, n)
    return Step(n_in, n_out, first, last, z[k], z[k + 1], zd[k], zd[k + 1], h)


@_jit
def glide(e, held, springs, motion, k_0, out):
    """The march of elastic springs under a rigid pull, where no spring knows of another; arguments as of `march`."""
    z, n_z, n = motion.z, motion.dx.size, springs.gap.size
    h = 2.0 * np.pi / n_z
    k, n_at_rest = k_0 % n_z, n
    S_0, S_m = held.S[0], held.S[1]
    as_one, sticks = True, True
    v = motion.v
    for j in range(out.S.size):
        step = step_of(motion, k, n, h)
        S_m = S_0
        shaken = motion.shaken
        if shaken:
            move = moved(motion.dx[k], motion.x_dot[k], motion.x_dot[k + 1], h, False, True)
        else:  # of a steady pull most of it is known to be zero as this is compiled
            move = Move(motion.dx[k], v, v, 0.0, 0.0, False, False)
        pace, pace_back = paces(step, move.du)
        sought = sticks and (step.z_1 < step.z_0 or pace_back > 0.0)
        more = between_elastic(e, springs, step, move.du, True) if sought else 0.0
        if sticks and pace > 0.0:
            S_0, away = elastic_step_in_place(e, springs, step, move, n_at_rest, True)
            sticks = away > 0.0
        else:
            S_0, _ = elastic_step_in_place(e, springs, step, move, n_at_rest, False)
            sticks = pace <= 0.0
        S_0 += more
        n_at_rest = step.n_out
        out.S[j] = S_0
        as_one = as_one and e[0, 0] + max(z[k + 1] - springs.gap[0], 0.0) >= springs.lump_margin
        if j < out.e.shape[0]:
            for i in indices(0, n):
                out.e[j, 0, i] = e[0, i]
                out.s[j, 0, i] = max(z[k + 1] - springs.gap[i], 0.0)
        k = k + 1 if k + 1 < n_z else 0
    out.y[:] = 0.0
    held.y[:] = 0.0
    held.S[0], held.S[1] = S_0, S_m
    return as_one


@_inline
def sum_of(w, x):
    """Sum of x (n,) over springs of the shares w."""
    total = 0.0
    for i in indices(0, w.size):
        total += w[i] * x[i]
    return total


@_jit
def begin(e, pressed, held, springs, table):
    """Bring extensions e (1 + J, n) into the cone of friction, within the compressions pressed (n,), and the sums in
    held with them: a combination of states may leave that cone.

    S also has what the path in the step before added to the mean, which goes again in the next; so have the sums over
    arms, which are not carried from state to state: a slow arm would magnify what is wrong in them.
    """
    added = held.S[0] - sum_of(springs.w, e[0])
    for i in indices(0, pressed.size):
        e[0, i] = max(min(e[0, i], pressed[i]), -pressed[i])
    held.S[0] = sum_of(springs.w, e[0]) + added
    for a in range(1, e.shape[0]):
        held.arms[0, a - 1] = sum_of(springs.w, e[a]) + table[L_GAIN, a] * (2.0 - table[L_DECAY, a]) * added


@_jit
def march(e, s, held, body, springs, motion, table, k_0, out):
    """March out.y.size steps from step k_0 of the period; e, s and held are updated in place.

    e, s: (1 + J, n) extension and compression, with the arms of the material in the rows below. held: BodyState, body:
    Body, springs: Springs, motion: Motion, out: Trace. table: of the material over a step (operator.py). Returns
    whether the core moved as one all the way.
    """
    gap, z, n_z = springs.gap, motion.z, motion.dx.size
    n_arms = table.shape[1] - 1
    h = 2.0 * np.pi / n_z
    rigid, b_1 = body.rigid, body.b_1
    y_0, y_m, y_mm, S_0, S_m = held.y[0], held.y[1], held.y[2], held.S[0], held.S[1]
    e_0, e_1 = e, np.empty_like(e)
    s_0, s_1 = s, np.empty_like(s)
    decay, rate = table[L_DECAY, 0], table[L_RATE, 0]
    law = law_of(table)
    elastic = n_arms == 0 and decay == 0.0
    look = np.zeros((8, gap.size if n_arms > 0 else 0))
    along = np.zeros(look.shape[1])
    if elastic and rigid:
        return glide(e, held, springs, motion, k_0, out)
    as_one, sticks = True, True  # whether any spring may stick as the step begins
    for j in range(out.y.size):
        k = (k_0 + j) % n_z
        z_1, v_0, v_1 = z[k + 1], motion.x_dot[k], motion.x_dot[k + 1]
        step = step_of(motion, k, gap.size, h)
        jumps = body.light and motion.spans[1, k - 1] == 0 and touches_flat(gap, springs.w, z_1)  # in flight before
        pull = 0.0 if rigid else body.a_1 * y_0 + body.a_2 * y_m - body.b_0 * S_0 - body.b_m * S_m
        for a in range(n_arms):
            pull -= body.arms[0, a] * held.arms[0, a] + body.arms[1, a] * held.arms[1, a]
        if n_arms > 0:
            sheds = law.dashpot or motion.shaken or sticks
            free_response(e_0, s_0, table, 0 if motion.shaken else step.n_in, step.n_out, sheds, look)
        y_1 = 0.0 if rigid else 3.0 * (y_0 - y_m) + y_mm
        low, high = -np.inf, np.inf
        ud_0 = v_0 + (1.5 * y_0 - 2.0 * y_m + 0.5 * y_mm) / h
        ended = False
        for turn in range(80):
            ud_1 = v_1 + (1.5 * y_1 - 2.0 * y_0 + 0.5 * y_m) / h
            move = moved(motion.dx[k] + (y_1 - y_0), ud_0, ud_1, h, jumps, motion.shaken)
            pace, pace_back = paces(step, move.du)
            if elastic and not motion.shaken and sticks and pace > 0.0:
                S_1, stuck = slipping_elastic_step(e_0, e_1, springs, step, move)
            elif elastic and not motion.shaken:
                S_1, stuck = elastic_step(e_0, e_1, springs, step, move)
            elif elastic:
                S_1, stuck = shaken_elastic_step(e_0, e_1, springs, step, move)
            elif n_arms == 0 and not motion.shaken:
                S_1, stuck = kelvin_step(e_0, s_0, e_1, s_1, springs, step, move, rate, decay)
            elif n_arms == 0:
                S_1, stuck = shaken_kelvin_step(e_0, s_0, e_1, s_1, springs, step, move, rate, decay)
            elif not motion.shaken and law.dashpot:
                S_1, stuck, ended = dashpot_arms_step(e_0, s_0, e_1, s_1, look, springs, step, move, law)
            elif not motion.shaken and sticks:
                S_1, stuck, ended = slipping_arms_step(e_0, s_0, e_1, s_1, look, springs, step, move, law)
            elif not motion.shaken:
                S_1, stuck, ended = arms_step(e_0, s_0, e_1, s_1, look, springs, step, move, law)
            else:
                S_1, stuck, ended = shaken_arms_step(e_0, s_0, e_1, s_1, look, springs, step, move, law)
            if elastic and sticks and (step.z_1 < step.z_0 or pace_back > 0.0):
                S_1 += between_elastic(e_0, springs, step, move.du, False)
            if ended:
                more, given = between_arms(e_0, s_0, s_1, look, along, springs, step, move.du)
                S_1, stuck = S_1 + more, stuck + given
            excess = y_1 - pull + b_1 * S_1
            rounding = 2e-15 * (abs(y_1) + abs(pull) + abs(b_1 * S_1))
            if abs(excess) <= rounding:
                break
            if excess > 0.0:  # the slope is at least 1, so the root is no further than the excess
                low, high = max(low, y_1 - excess), y_1
            else:
                low, high = y_1, min(high, y_1 - excess)
            y_new = y_1 - excess / (1.0 + b_1 * stuck)
            if turn > 7 or not low <= y_new <= high:
                y_new = 0.5 * (low + high)
            if abs(y_new - y_1) <= 0.1 * rounding:
                break
            y_1 = y_new
        for a in range(n_arms):
            held.arms[1, a] = held.arms[0, a]
            held.arms[0, a] = table[L_DECAY, 1 + a] * held.arms[0, a] + table[L_GAIN, 1 + a] * (S_1 - S_0)
        if elastic:
            core = e_1[0, 0] + max(z_1 - gap[0], 0.0)
        elif n_arms == 0:
            core = (e_1[0, 0] + s_1[0, 0] - (e_0[0, 0] + s_0[0, 0]) * decay) / (1.0 - decay)
        else:
            stretch_arms(e_0, e_1, s_0, s_1, table)
            if ended:
                relax_more(e_1, along, table, step.last)
            core = table[L_TIME, 0] * (e_1[0, 0] + s_1[0, 0] - e_0[0, 0] - s_0[0, 0]) / h
            for a in range(n_arms + 1):
                core += table[L_RATIO, a] * (e_1[a, 0] + s_1[a, 0])
        as_one = as_one and core >= springs.lump_margin
        sticks = stuck > 1e-12
        y_mm, y_m, y_0, S_m, S_0 = y_m, y_0, y_1, S_0, S_1
        e_0, e_1 = e_1, e_0
        s_0, s_1 = s_1, s_0
        out.y[j] = y_1
        out.S[j] = S_1
        if j < out.e.shape[0]:
            for a in range(n_arms + 1):
                put(e_0[a], out.e[j, a])
                put(s_0[a], out.s[j, a])
            if elastic:
                for i in range(gap.size):
                    out.s[j, 0, i] = max(z_1 - gap[i], 0.0)
    if out.y.size % 2 == 1:
        for a in range(n_arms + 1):
            put(e_0[a], e_1[a])
            put(s_0[a], s_1[a])
    held.y[0], held.y[1], held.y[2], held.S[0], held.S[1] = y_0, y_m, y_mm, S_0, S_m
    return as_one


# --- the periodic state ---------------------------------------------------------------------------

PERIODS, KEPT, SINCE = range(3)  # counts of a search: periods so far, those combined now, the one that moved least
LEAST, BEST = range(2)  # its changes over a period, over the size of the state: least of those combined, and of all


class Search(NamedTuple):
    """Anderson's method on its way to a state that returns after a period, updated in place. Measured is a state as a
    vector whose length is the root of its energy.
    """

    x: Array  #: (n_x,) the state that the next period starts from
    measured: Array  #: (n_x,) the same, measured
    start: Array  #: (n_x,) the one that the last period started from
    image: Array  #: (n_x,) what it came to
    moved: Array  #: (n_x,) how far that was, measured
    best: Array  #: (n_x,) the image that moved least
    ways: Array  #: (memory, n_x) from image to image, oldest first
    turns: Array  #: (memory, n_x) from move to move, measured
    counts: NDArray[np.int64]  #: (3,)
    changes: Array  #: (2,)
    close: float  #: change at which the search ends
    plain: int  #: periods before the first combination, while springs find their modes
    patience: int  #: periods without a smaller change, after which it ends as well
    growth: float  #: of the change over the least, at which combinations start anew


@_jit
def measure(x, roots, n_e, out):
    """A state (n_x,), measured: roots has those of the stiffness of its n_e extensions and of the pull, and of the
    mass over a step, as what the body travelled in the last step tells its velocity.
    """
    for i in range(x.size):
        out[i] = x[i] * roots[i]
    out[n_e + 1] = roots[n_e + 1] * (x[n_e] - x[n_e + 1])


@_jit
def combine(at, image, reached):
    """Take into a search what a period has made of at.x, and the same measured; whether the search has come to its end.

    If not, at.x is the state to go on from, which the caller has to measure.
    """
    counts, changes = at.counts, at.changes
    size = change = 0.0
    for i in range(reached.size):
        size += reached[i] ** 2
        change += (reached[i] - at.measured[i]) ** 2
    if not np.isfinite(size):
        changes[BEST] = np.nan
        return True
    change = np.sqrt(change) / (np.sqrt(size) + 1e-300)
    period = counts[PERIODS]
    counts[PERIODS] += 1
    if change < changes[BEST]:
        put(image, at.best)
        changes[BEST], counts[SINCE] = change, period
    if change <= at.close or period - counts[SINCE] > at.patience:
        return True
    if change > at.growth * changes[LEAST] or period == 0:
        counts[KEPT], changes[LEAST] = 0, np.inf
    else:
        if counts[KEPT] == at.ways.shape[0]:
            for j in range(1, counts[KEPT]):
                put(at.ways[j], at.ways[j - 1])
                put(at.turns[j], at.turns[j - 1])
            counts[KEPT] -= 1
        way, turn = at.ways[counts[KEPT]], at.turns[counts[KEPT]]
        for i in range(image.size):
            way[i] = image[i] - at.image[i]
            turn[i] = (reached[i] - at.measured[i]) - at.moved[i]
        counts[KEPT] += 1
    changes[LEAST] = min(changes[LEAST], change)
    for i in range(image.size):
        at.image[i] = at.x[i] = image[i]
        at.moved[i] = reached[i] - at.measured[i]
    if period >= at.plain and counts[KEPT] > 0:
        share = shares(at.turns[: counts[KEPT]], at.moved, 1e-10)
        for j in range(share.size):
            for i in range(image.size):
                at.x[i] -= share[j] * at.ways[j, i]
    return False


@_inline
def parts_of(x, s):
    """Views of a state vector: extensions, as s (1 + J, n), and body."""
    n_x, n_e = s.shape[0], s.size
    held = BodyState(x[n_e : n_e + 3], x[n_e + 3 : n_e + 5], x[n_e + 5 :].reshape((2, n_x - 1)))
    return x[:n_e].reshape(s.shape), held


@_jit
def settle_in(states, s, pressed, body, springs, motion, table, n_periods, out, before, after):
    """March states (k, n_x) for some periods and one more, each on its own: fills before and after, of that shape.

    s, pressed, out: as of `search`.
    """
    now, first = np.empty_like(s), np.int64(0)
    for j in range(states.shape[0]):
        x = after[j]
        put(states[j], x)
        e, held = parts_of(x, s)
        for turn in range(n_periods + 1):
            if turn == n_periods:
                put(x, before[j])
            for a in range(s.shape[0]):
                put(s[a], now[a])
            begin(e, pressed, held, springs, table)
            march(e, now, held, body, springs, motion, table, first, out)


@_jit
def search(at, s, pressed, roots, body, springs, motion, table, n_periods, out):
    """Go on with a search for so many periods, each begun within the cone of friction; whether it has come to its end,
    and whether the core moved as one in the last period.

    s: (1 + J, n) compressions at the start of a period, pressed (n,) those of the springs, also where s keeps none.
    out: Trace of the last period.
    """
    n_x, n_e, first = s.shape[0], s.size, np.int64(0)  # a plain 0 would have the march compiled once more
    now, image, reached = np.empty_like(s), np.empty(at.x.size), np.empty(at.x.size)
    e, held = parts_of(image, s)
    as_one, ended = True, False
    while n_periods > 0 and not ended:
        n_periods -= 1
        put(at.x, image)
        for a in range(n_x):
            put(s[a], now[a])
        begin(e, pressed, held, springs, table)
        put(image, at.start)
        as_one = march(e, now, held, body, springs, motion, table, first, out)
        measure(image, roots, n_e, reached)
        added = held.S[0] - sum_of(springs.w, e[0])
        ended = combine(at, image, reached)
        if not ended:
            found, body_found = parts_of(at.x, s)
            body_found.S[0] = sum_of(springs.w, found[0]) + added  # no combination of what no length measures
            measure(at.x, roots, n_e, at.measured)
    return ended, as_one


# --- looking at a run -----------------------------------------------------------------------------

FREE, STICK, SLIP, SLIP_BACK = 0, 1, 2, 3

# what `observe` adds up, in the order of its `sums`
N_SUMS = 9
(
    STICK_TIME,
    CONTACT_TIME,
    SHEAR_WORK,
    SHAKE_WORK,
    NORMAL_WORK,
    FRICTION_LOSS,
    SHEAR_VISCOUS,
    NORMAL_VISCOUS,
    LEAST_SLIP,
) = range(N_SUMS)


@_inline
def mode_of(normal, excess, limit):
    """Mode of a spring whose `excess` beyond +-limit says that it slips."""
    slips = SLIP if excess >= limit else (SLIP_BACK if excess <= -limit else STICK)
    return slips if normal > 0.0 else FREE


@_inline
def contact_share(s_0, s_free, s_rate, s_end, s_1, gap, step):
    """Share of a step that a spring spends in contact, as the march has it: 1 in contact throughout, 0 in flight."""
    rise = max(s_1 - s_free - 1e-14 * abs(s_1), 0.0)  # no rounding, of a spring that lets go
    way = rise / (rise + max(s_0 - (step.z_0 - gap), 0.0) + 1e-300)
    return way * (1.0 - bend_of(step.zd_0 + s_rate, step.zd_1 + s_end) * (1.0 - way))


@_jit
def add_arms(e_0, e_1, s_0, s_1, w, table, h, out):
    """What the arms add to a step, out (8, n): to the free motion of s and e, the rates of s at both ends, the forces
    at the end and the impulses in the step; returns their losses in shear and pressure. e, s: (1 + J, n) at both ends.
    """
    out[:] = 0.0
    shear = press = 0.0
    for j in range(1, e_0.shape[0]):
        ratio, theta = table[L_RATIO, j], table[L_TIME, j]
        free, rate, end = table[L_FREE, j], table[L_RATE, j], table[L_END, j]
        for i in range(e_0.shape[1]):
            p_0, p_1, q_0, q_1 = e_0[j, i], e_1[j, i], s_0[j, i], s_1[j, i]
            out[0, i] += free * q_0
            out[1, i] += free * p_0
            out[2, i] += rate * q_0
            out[3, i] += end * q_0
            out[4, i] += ratio * q_1
            out[5, i] += ratio * p_1
            out[6, i] += ratio * theta * ((e_1[0, i] - e_0[0, i]) - (p_1 - p_0))
            out[7, i] += ratio * theta * ((s_1[0, i] - s_0[0, i]) - (q_1 - q_0))
            shear += w[i] * ratio / theta * 0.5 * h * (p_0 * p_0 + p_1 * p_1)
            press += w[i] * ratio / theta * 0.5 * h * (q_0 * q_0 + q_1 * q_1)
    return shear, press


@_inline
def elastic_force(e, s):
    """Tangential force of an elastic spring under the normal force s > 0; what tells its mode and the limit of that."""
    limit = s * (1.0 - 1e-12)
    return s if e >= limit else (-s if e <= -limit else e), e, limit


@_inline
def close_look(e_0, e_1, s_0, s_1, flight, normal, trial, arms_s, move, h, T, dashpot):
    """One spring in one step, of normal force `normal` at its end; trial: the force that it would take to stick.

    Returns its tangential force at the end; what tells its mode and the limit of that (`mode_of`); its slip velocity,
    stretch and squeeze while in contact; and the impulse of its normal force.
    """
    flown = 1.0 - flight.touched
    stretched = e_1 - e_0 - flown * (flight.e - e_0)
    squeezed = s_1 - s_0 - flown * (flight.s - s_0)
    travel = flight.touched * (move.du + flown * move.surge) + flown * move.jump
    slip_rate = (travel - stretched) * flight.per_time
    # where arms make the static force, what a spring did in the step tells its mode, beyond the rounding of its
    # extension, else its trial force
    pace = (1e-9 * abs(move.du) + 4e-15 * (abs(e_0) + abs(e_1))) / h
    excess, limit = (trial, normal * (1.0 - 1e-12)) if dashpot else (slip_rate, pace)
    sticks_at = min(max(trial, -normal), normal)
    tangential = normal if excess >= limit else (-normal if excess <= -limit else sticks_at)
    impulse = max(0.5 * h * (s_0 + s_1) + T * (s_1 - s_0) + arms_s, 0.0)
    return tangential, excess, limit, slip_rate, stretched, squeezed, impulse


@_inline
def least_of(values, n):
    """Least of the first n values, infinite for none; by halves, which vectorises. Changes values."""
    while n > 1:
        half = n // 2
        low, high = values[:half], values[n - half : n]
        for i in range(half):
            low[i] = min(low[i], high[i])
        n -= half
    return values[0] if n == 1 else np.inf


@_jit
def observe(e, s, y, springs, motion, light, table, k_0, seen):
    """Forces, modes and energies of a marched stretch of m steps from step k_0, each energy from its own definition.

    e, s: (m + 1, 1 + J, n) states at the instants. y: (m + 3,) body, from two steps before the first. Adds to
    seen.sums; fills the rest of seen, F_x and F_z with the forces at the end of each step, slip with the least slip
    velocity of a spring in contact through the step, or else at the touch of those that touched in it (infinite
    without contact).
    """
    gap, w, n_z = springs.gap, springs.w, motion.dx.size
    T, n_x, n, h = table[L_TIME, 0], table.shape[1], gap.size, 2.0 * np.pi / motion.dx.size
    remembers = n_x > 1 or T > 0.0
    dashpot = n_x == 1 or table[L_STIFFNESS, 0] > 0.0
    slips, first_slips = np.empty(n), np.empty(n)
    f_z, f_x, excesses, limits = np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n)  # kept or not: the same sums
    arms = np.zeros((8, n))
    free_0, rate_0, end_0 = table[L_FREE, 0], table[L_RATE, 0], table[L_END, 0]
    keep, elastic, per_step = seen.mode.shape[0] > 0, not remembers, 1.0 / h
    S_0, P_0 = 0.0, 0.0  # sums of w e and of w s
    presses_0 = False  # whether any spring is in contact as the step begins
    for i in range(n):
        presses_0 = presses_0 or 0.0 < s[0, 0, i] <= motion.z[k_0 % n_z] - gap[i]
        S_0 += w[i] * e[0, 0, i]
        P_0 += w[i] * s[0, 0, i]
    sums = seen.sums
    for j in range(e.shape[0] - 1):
        k = (k_0 + j) % n_z
        step = step_of(motion, k, n, h)
        n_in, n_out, z_1, zd_1 = step.n_in, step.n_out, step.z_1, step.zd_1
        ux_dot_0 = motion.x_dot[k] + (3.0 * y[j + 2] - 4.0 * y[j + 1] + y[j]) / (2.0 * h)
        ux_dot = motion.x_dot[k + 1] + (3.0 * y[j + 3] - 4.0 * y[j + 2] + y[j + 1]) / (2.0 * h)
        jumps = light and not presses_0 and touches_flat(gap, w, z_1)
        move = moved(motion.dx[k] + (y[j + 3] - y[j + 2]), ux_dot_0, ux_dot, h, jumps, motion.shaken)
        growth = max(((ux_dot - zd_1) - (ux_dot_0 - step.zd_0)) / h, 0.0)  # of the common slip velocity
        S_1 = P_1 = sum_x = sum_z = stick = friction = shear_viscous = normal_viscous = shear_arms = press_arms = 0.0
        if n_x > 1:
            shear_viscous, normal_viscous = add_arms(e[j], e[j + 1], s[j], s[j + 1], w, table, h, arms)
            for i in range(n):
                shear_arms += w[i] * arms[6, i]
                press_arms += w[i] * arms[7, i]
        e_here, e_next, s_here, s_next = e[j, 0], e[j + 1, 0], s[j, 0], s[j + 1, 0]
        n_lean = n_in if elastic else 0
        for i in indices(0, n_lean):
            tangential, excess, limit = elastic_force(e_next[i], s_next[i])
            slip_rate = (move.du - (e_next[i] - e_here[i])) * per_step
            sum_x += w[i] * tangential
            sum_z += w[i] * s_next[i]
            stick += w[i] * s_next[i] if abs(excess) < limit else 0.0
            friction += w[i] * (s_here[i] + s_next[i]) * abs(slip_rate)
            S_1 += w[i] * e_next[i]
            P_1 += w[i] * s_next[i]
            slips[i] = slip_rate
        friction *= 0.5 * h
        for i in indices(n_lean, n_in):
            e_0, e_1, s_0, s_1 = e_here[i], e_next[i], s_here[i], s_next[i]
            normal, trial = max(s_1 + T * zd_1 + arms[4, i], 0.0), e_1 + T * ux_dot + arms[5, i]
            flight = Flight(e_0, s_0, 1.0, 1.0 / h)
            tangential, excess, limit, slip_rate, stretched, squeezed, impulse = close_look(
                e_0, e_1, s_0, s_1, flight, normal, trial, arms[7, i], move, h, T, dashpot
            )
            sum_x += w[i] * tangential
            sum_z += w[i] * normal
            stick += w[i] * normal if abs(excess) < limit else 0.0
            friction += w[i] * impulse * abs(slip_rate)
            shear_viscous += w[i] * T * (stretched * stretched / h)
            normal_viscous += w[i] * T * (squeezed * squeezed / h)
            S_1 += w[i] * e_1
            P_1 += w[i] * s_1
            slips[i] = slip_rate
            f_z[i], f_x[i], excesses[i], limits[i] = normal, tangential, excess, limit
        for i in indices(n_in, n_out):
            e_0, e_1, s_0, s_1 = e_here[i], e_next[i], s_here[i], s_next[i]
            s_free, e_free = free_0 * s_0 + arms[0, i], free_0 * e_0 + arms[1, i]
            rate, end = rate_0 * s_0 + arms[2, i], end_0 * s_0 + arms[3, i]
            touched = contact_share(s_0, s_free, rate, end, s_1, gap[i], step)
            per_time = 1.0 / (max(touched, 1e-9) * h) if touched > 1e-9 else 0.0
            follows = s_1 <= z_1 - gap[i]
            normal = max(s_1 + T * zd_1 + arms[4, i], 0.0) if follows else 0.0
            trial, flight = e_1 + T * ux_dot + arms[5, i], Flight(e_free, s_free, touched, per_time)
            tangential, excess, limit, slip_rate, stretched, squeezed, impulse = close_look(
                e_0, e_1, s_0, s_1, flight, normal, trial, arms[7, i], move, h, T, dashpot
            )
            flown = (1.0 - touched) / h
            sum_x += w[i] * tangential
            sum_z += w[i] * normal
            stick += w[i] * normal if abs(excess) < limit else 0.0
            friction += w[i] * impulse * abs(slip_rate)
            shear_viscous += w[i] * T * (stretched * stretched * per_time + (e_free - e_0) ** 2 * flown)
            normal_viscous += w[i] * T * (squeezed * squeezed * per_time + (s_free - s_0) ** 2 * flown)
            S_1 += w[i] * e_1
            P_1 += w[i] * s_1
            presses = follows and s_1 > 0.0
            slips[i] = slip_rate if presses and touched > 0.999999 else np.inf
            first_slips[i] = slip_rate - 0.5 * touched * h * growth if presses and touched > 1e-6 else np.inf
            f_z[i], f_x[i], excesses[i], limits[i] = normal, tangential, excess, limit
        if remembers:
            for i in indices(n_out, n):
                shear_viscous += w[i] * T * ((e_next[i] - e_here[i]) ** 2 / h)
                normal_viscous += w[i] * T * ((s_next[i] - s_here[i]) ** 2 / h)
                S_1 += w[i] * e_next[i]
                P_1 += w[i] * s_next[i]
        if keep:
            for i in range(n_lean):
                f_z[i] = s_next[i]
                f_x[i], excesses[i], limits[i] = elastic_force(e_next[i], s_next[i])
            f_z[n_out:], f_x[n_out:] = 0.0, 0.0
            for i in range(n):
                seen.f_z[j, i], seen.f_x[j, i] = f_z[i], f_x[i]
                seen.mode[j, i] = mode_of(f_z[i], excesses[i], limits[i])
        least = least_of(slips, n_out)
        if least == np.inf:  # all that press slip alike, so only the first touch of all adds
            least = least_of(first_slips[n_in:], n_out - n_in)
        shear = 0.5 * h * (S_0 + S_1) + T * (S_1 - S_0) + shear_arms
        press = 0.5 * h * (P_0 + P_1) + T * (P_1 - P_0) + press_arms
        seen.F_x[j], seen.F_z[j], seen.slip[j] = sum_x, sum_z, least
        sums[STICK_TIME] += stick * h
        sums[CONTACT_TIME] += sum_z * h
        sums[SHEAR_WORK] += shear * move.du / h
        sums[SHAKE_WORK] += shear * (motion.dx[k] / h - motion.v)
        sums[NORMAL_WORK] += press * (z_1 - step.z_0) / h
        sums[FRICTION_LOSS] += friction
        sums[SHEAR_VISCOUS] += shear_viscous
        sums[NORMAL_VISCOUS] += normal_viscous
        sums[LEAST_SLIP] = min(sums[LEAST_SLIP], least)
        S_0, P_0 = S_1, P_1
        presses_0 = sum_z > 0.0


@_jit
def watch(e, s, held, body, springs, motion, table, at_once, out, seen):
    """March one period as `march` does, with a close look at every step; arrays of at_once steps are in use at a time.

    out: Trace of the period, with as many rows of e and s as are to be kept, or none; seen: as of `observe`.
    """
    (n_x, n), n_steps = e.shape, out.y.size
    elastic = n_x == 1 and table[L_DECAY, 0] == 0.0
    e_all, s_all = np.empty((at_once + 1, n_x, n)), np.empty((at_once + 1, n_x, n))
    y, y_0 = np.empty(n_steps + 3), held.y
    y[0], y[1], y[2] = y_0[2], y_0[1], y_0[0]
    done, as_one = np.int64(0), True
    while done < n_steps:
        end = min(done + at_once, n_steps)
        m = end - done
        for a in range(n_x):
            put(e[a], e_all[0, a])
            put(s[a], s_all[0, a])
        if elastic:
            for i in range(n):
                s_all[0, 0, i] = max(motion.z[done] - springs.gap[i], 0.0)
        part = Trace(out.y[done:end], out.S[done:end], e_all[1 : m + 1], s_all[1 : m + 1])
        as_one = march(e, s, held, body, springs, motion, table, done, part) and as_one
        put(part.y, y[done + 3 : end + 3])
        last = end if seen.mode.shape[0] > 0 else 0
        first = min(done, last)
        look = Seen(
            seen.sums,
            seen.F_x[done:end],
            seen.F_z[done:end],
            seen.slip[done:end],
            seen.mode[first:last],
            seen.f_x[first:last],
            seen.f_z[first:last],
        )
        observe(e_all[: m + 1], s_all[: m + 1], y[done : end + 3], springs, motion, body.light, table, done, look)
        if out.e.shape[0] > 0:
            for j in range(m):
                for a in range(out.e.shape[1]):
                    put(e_all[j + 1, a], out.e[done + j, a])
                    put(s_all[j + 1, a], out.s[done + j, a])
        done = end
    return as_one
