"""The periodic normal motion of a row of springs, in which friction has no part."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mdr.spring.contact import Each, Springs, press
from mdr.spring.law import Law
from mdr.spring.path import Path
from mdr.spring.times import new_tools
from mdr.tools.arrays import Array
from mdr.tools.jit import compiled

MOST_PASSES = 400  #: over a period, for arms to find their periodic state
NOT_PERIODIC = 1e-3  #: change over a period, of the unit of lengths, that a spring may be left with
EARLY = 1e-9  #: of a step, by which a flight ends before the touch, so that by no rounding a spring touches in it
MEMORY = 6  #: moves of a spring that are combined
ALIKE = 1e-3  #: ratio of lengths below which moves are not told apart


@dataclass(frozen=True, eq=False)
class NormalPeriod:
    """A row of n springs over a period of n_t steps, with J arms; not to be written to."""

    s: Array  #: (1 + J, n) compressions at its start, and their arms
    area: Array  #: (n_t,) area of the normal force over each step
    moment: Array  #: (n_t,) its moment about the start of the step
    end: Array  #: (n_t,) the force at the end of each step
    compression: Array  #: (n_t,) sum of w s at the start of each step
    flight: Array  #: (n_t,) time to the first touch of a step that begins without one and ends in contact; else zero
    force: Array  #: (n_t, n) normal force of each spring over its stiffness at the end of each step, where asked for
    #: (n_t, n) share of the step for which it has pressed at its end, zero in flight, where asked for
    pressed_for: Array

    @cached_property
    def mean(self) -> float:
        """Mean of the normal force over the period."""
        return float(self.area.sum()) / (2 * np.pi)


def settled(gap: Array, w: Array, z: Array, z_dot: Array, law: Law, each: bool = False) -> NormalPeriod | None:
    """The periodic motion under the depth z (n_t + 1,), of rate z_dot; None if springs with arms find none.

    Without arms a spring forgets its start within a period. With arms the passes go on. After each pass the start of
    an arm moves by its change in the period, divided by the share 1 - exp(-2 pi/theta) that it forgets in it. This is
    exact for a spring that keeps contact. Each time the change of a spring grows, the part of its moves beyond the
    plain change is halved for good, and its past is forgotten. Of the last moves of a spring the combination is taken
    of which least is left (Anderson's method, each spring by itself), as a spring that loses contact moves by less.

    each: whether force and pressed_for are asked for.
    """
    n_t, n, w = z.size - 1, gap.size, np.array(w)  # not a read-only one, for which all would be compiled once more
    sums, none = np.empty((5, n_t)), np.empty((0, n))
    s = np.zeros((1 if law.arms is None else 1 + law.arms.rho.size, n))
    s[0] = np.maximum(z[0] - gap, 0)
    if law.arms is not None:
        if not _settle(s, gap, w, z, z_dot, law, sums):
            return None
    elif law.modes is not None:
        period(s, gap, w, z, z_dot, *law, sums, none, none)
    force, pressed_for = np.empty((2, n_t if each else 0, n))
    period(s.copy(), gap, w, z, z_dot, *law, sums, force, pressed_for)
    area, moment, end, compression, flight = sums
    return NormalPeriod(s, area, moment, end, compression, flight, force, pressed_for)


def _settle(s: Array, gap: Array, w: Array, z: Array, z_dot: Array, law: Law, sums: Array) -> bool:
    """Bring springs with arms (1 + J, n) to the state that returns after a period; whether that is found."""
    rho, rate = law.arms or (np.empty(0), np.empty(0))
    n, memory, roots = gap.size, min(rho.size, MEMORY), np.sqrt(np.append(1.0, rho))[:, None]
    forgotten, none = np.append(1.0, -np.expm1(-2 * np.pi * rate))[:, None], np.empty((0, n))
    who, trust, before, change = np.arange(n), np.ones(n), np.full(n, np.inf), np.zeros(n)
    (tried, move), (tries, moves) = np.zeros((2, *s.shape)), np.zeros((2, memory, *s.shape))
    for turn in range(MOST_PASSES):
        start, x = s[:, who], s[:, who].copy()
        period(x, gap[who], w[who], z, z_dot, *law, sums, none, none)
        s[:, who] = x
        change[who] = np.abs(x - start).max(axis=0)
        stays = change[who] <= 1e-13 * np.abs(x).max(axis=0) + 1e-15 * np.abs(gap[who])  # z - gap: its rounding
        who, start, x = who[~stays], start[:, ~stays], x[:, ~stays]
        if not who.size:
            break
        grows = change[who] > before[who]
        trust[who] *= np.where(grows, 0.5, 1.0)
        before[who] = change[who]
        now = (1 + trust[who] * (1 / forgotten - 1)) * (x - start)
        slot = turn % memory
        tries[slot, :, who], moves[slot, :, who] = (start - tried[:, who]).T, (now - move[:, who]).T
        moves[:, :, who[grows] if turn else who] = 0
        tried[:, who], move[:, who] = start, now
        past = moves[:, :, who]
        shares = np.linalg.pinv((roots * past).transpose(2, 1, 0), rcond=ALIKE) @ (roots * now).T[:, :, None]
        now = now - np.einsum("kjn,nk->jn", past + tries[:, :, who], shares[:, :, 0])
        s[:, who] = start + now
    return bool(change.max(initial=0) <= NOT_PERIODIC)


@compiled(nogil=True, error_model="numpy", fastmath={"reassoc", "contract"})
def period(s, gap, w, z, z_dot, T, modes, arms, sums, force, pressed_for):  # type: ignore[no-untyped-def]
    """One period of the normal motion: s (1 + J, n) is updated, the rest filled, as of NormalPeriod; sums (5, n_t)."""
    n_t, n = z.size - 1, gap.size
    h = 2.0 * np.pi / n_t
    tools = new_tools(h, modes, arms, 0.0, np.int64(0))
    each = Each(np.empty(n), np.empty(n), np.empty(n))
    for k in range(n_t):
        z_2 = (z_dot[k + 1] - z_dot[k]) / (2.0 * h)
        path = Path(z[k], (z[k + 1] - z[k]) / h - z_2 * h, z_2, 0.0, 0.0)
        before, flies = 0.0, True
        for i in range(n):
            before += w[i] * s[0, i]
            flies = flies and s[0, i] > z[k] - gap[i]
        of = press(s, Springs(gap, w), path, z_dot[k + 1], T, modes, arms, tools, each)
        pressed, flight = 0.0, 0.0
        for i in range(n):
            pressed = max(pressed, each.pressed_for[i])
            if force.shape[0] > 0:
                force[k, i], pressed_for[k, i] = each.f_z[i], each.pressed_for[i]
        if flies and pressed > 0.0:
            flight = h * max(1.0 - pressed - EARLY, 0.0)
        sums[0, k], sums[1, k], sums[2, k] = of.normal_area, of.normal_moment, of.normal_end
        sums[3, k], sums[4, k] = before, flight
