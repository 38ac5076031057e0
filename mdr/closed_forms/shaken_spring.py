"""One elastic or Kelvin spring under a pull that is shaken in the plane: its periodic state, event by event, compiled.

shaken_pull.py derives the three facts that this rests on, and has the symbols.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mdr.tools.arrays import Array
from mdr.tools.jit import compiled

Complex = NDArray[np.complex128]

MOST_CHANGES = 96  #: of the sequence of modes along the array; further ones are left to the halving
NEAR = 1e-7  #: of the range of gaps, to which a change is found
PERIODS = 100  #: at most, of Newton's method for the periodic state
CLOSE = 1e-7  #: its last step, over the compression and (1 - P')²: the error after it is a rounding
CLOSEST = 1e-14  #: over the compression, a step that is always the last: for v = 0 the slope P' is 1
_PRIME = 9007199254740881  #: of a sequence of modes as a number

_jit = compiled(nogil=True, error_model="numpy")


class Motion(NamedTuple):
    """Harmonics of the motion, without the drift."""

    T: float
    rows: Complex  # of z, x, z^T, A^T, B^T, T A', T B' (7, N)
    rates: Complex  # of the rates of A^T and B^T (2, N)
    turns: tuple[Array, Array]  # phases and values (n, 2) of the extremes of these rates
    tops: Array  # and of those of z^T


_Z, _X, _Z_T, _BARRIER, _LEAD = 0, 1, 2, 3, 5  # in rows
_FREE = 7  # column of a table of instants


class Instant(NamedTuple):
    """What is known at one phase."""

    t: float
    z: float
    X: float
    A_T: float
    B_T: float
    sum_z: float  # integral of z
    sum_X: float


# --- harmonic sums ----------------------------------------------------------------------------------------


@_jit
def root(
    rows: Complex, row: int, drift: float, level: float, decaying: float, since: float, T: float,
    low: float, high: float, f_low: float, f_high: float,
) -> float:  # fmt: skip
    """Root between low and high of Re sum rows[row]_n exp(i n t) + drift t + level + decaying exp(-(t - since)/T)."""
    if (f_low > 0) == (f_high > 0):
        return low if abs(f_low) < abs(f_high) else high
    t = low + (high - low) * math.acos(1 - 2 * f_low / (f_low - f_high)) / math.pi
    for _ in range(100):
        w = complex(math.cos(t), math.sin(t))
        power, f, slope = w, drift * t + level, drift
        for n in range(rows.shape[1]):
            turn = rows[row, n] * power
            f += turn.real
            slope -= (n + 1) * turn.imag
            power *= w
        if decaying != 0:
            left = decaying * math.exp(-(t - since) / T)
            f += left
            slope -= left / T
        if (f > 0) == (f_low > 0):
            low = t
        else:
            high = t
        new = t - f / slope if slope != 0 else high
        if not low < new < high:
            if abs(new - t) < 1e-14 or high - low < 1e-14:
                return t
            new = 0.5 * (low + high)
        elif abs(new - t) < 1e-8:  # the next error is the square of this one
            return new
        t = new
    return t


@_jit
def instant_at(rows: Complex, T: float, v: float, t: float) -> Instant:
    """The motion at phase t."""
    w = complex(math.cos(t), math.sin(t))
    power = w
    z, x, z_rate, x_rate, sum_z, sum_x = 0.0, 0.0, 0.0, v, 0.0, 0.0
    for n in range(rows.shape[1]):
        in_z, in_x = rows[_Z, n] * power, rows[_X, n] * power
        z += in_z.real
        x += in_x.real
        z_rate -= (n + 1) * in_z.imag
        x_rate -= (n + 1) * in_x.imag
        sum_z += in_z.imag / (n + 1)
        sum_x += in_x.imag / (n + 1)
        power *= w
    x += v * t
    return Instant(
        t, z, x, z - x + T * (z_rate - x_rate), z + x + T * (z_rate + x_rate), sum_z, sum_x + 0.5 * v * t * t
    )


@_jit
def _get(points: Array, k: int) -> Instant:
    row = points[k]
    return Instant(row[0], row[1], row[2], row[3], row[4], row[5], row[6])


@_jit
def _put(points: Array, k: int, now: Instant) -> None:
    row = points[k]
    row[0], row[1], row[2], row[3], row[4], row[5], row[6] = now
    row[_FREE] = 0.0


@_jit
def _cuts(m: Motion, v: float) -> tuple[Array, Array, Array]:
    """Instants of the extremes of A^T, B^T and z^T in a period, with its ends (n, 8), and room for the instants and
    the margins of a spring.

    A row has the fields of an Instant and whether the spring is free from there to the next.
    """
    t = np.empty(len(m.turns[0]) + len(m.turns[1]) + len(m.tops) + 2)
    t[0], t[1], count = 0.0, 2 * math.pi, 2
    for row in range(2):
        turns, level = m.turns[row], -v if row == 0 else v
        for i in range(len(turns)):
            low, high = turns[i - 1, 0] - (2 * math.pi if i == 0 else 0.0), turns[i, 0]
            f_low, f_high = turns[i - 1, 1] + level, turns[i, 1] + level
            if (f_low > 0) != (f_high > 0):
                found = root(m.rates, row, 0.0, level, 0.0, 0.0, 0.0, low, high, f_low, f_high)
                t[count] = found % (2 * math.pi)
                count += 1
    for i in range(len(m.tops)):
        t[count + i] = m.tops[i, 0]
    t = np.sort(t[: count + len(m.tops)])
    cuts, count = np.empty((t.size, _FREE + 1)), 0
    for i in range(t.size):
        if i == 0 or t[i] > t[i - 1] + 1e-14:
            _put(cuts, count, instant_at(m.rows, m.T, v, t[i]))
            count += 1
    return cuts[:count], np.empty((3 * count, _FREE + 1)), np.empty(24 * count)


# --- one spring -------------------------------------------------------------------------------------------


@_jit
def _note(margins: Array, value: float) -> None:
    """One more margin, whose sign decides which way a spring goes on; margins[0] counts them. Empty: none are kept."""
    if margins.size > 0:
        margins[0] += 1
        margins[int(margins[0])] = value


@_jit
def _follow(
    rows: Complex, T: float, v: float, c: float, cuts: Array, points: Array, margins: Array
) -> tuple[int, float, int]:
    """Normal motion: puts the instants of contact, with those of touch and leave, into points.

    Returns their number, the integral of s, and the sequence of touches and leaves as a number.
    """
    a = _get(cuts, 0)
    _put(points, 0, a)
    n, flies, left_at, s_left, s_sum, sequence = 1, False, 0.0, 0.0, 0.0, 0
    for k in range(len(cuts) - 1):
        b = _get(cuts, k + 1)
        z_a, z_b = 0.5 * (a.A_T + a.B_T) - c, 0.5 * (b.A_T + b.B_T) - c
        begin, end, code = a, b, 0  # of the part in which z^T > c
        _note(margins, z_b)
        if z_b < 0:
            end = a
            _note(margins, z_a)
            if z_a > 0:
                end = instant_at(rows, T, v, root(rows, _Z_T, 0.0, -c, 0.0, 0.0, T, a.t, b.t, z_a, z_b))
        if flies and end.t > a.t:
            h_a, h_end = a.z - c, end.z - c
            if T > 0:
                h_a -= s_left * math.exp(-(a.t - left_at) / T)
                h_end -= s_left * math.exp(-(end.t - left_at) / T)
            _note(margins, h_end)
            if h_end > 0:
                flies, code = False, 1
                _note(margins, h_a)
                if h_a < 0:
                    t = root(rows, _Z, 0.0, -c, -s_left, left_at, T, a.t, end.t, h_a, h_end)
                    begin = instant_at(rows, T, v, t)
                if T > 0:
                    s_sum -= s_left * T * math.expm1(-(begin.t - left_at) / T)
                _put(points, n, begin)
                n += 1
        if not flies:
            code += 2
            if end.t > begin.t:
                s_sum += end.sum_z - begin.sum_z - c * (end.t - begin.t)
                _put(points, n, end)
                n += 1
            if z_b < 0:
                flies, left_at, s_left = True, end.t, max(end.z - c, 0.0) if T > 0 else 0.0
                points[n - 1, _FREE] = 1.0
                code += 4
        sequence = (sequence * 11 + code) % _PRIME
        a = b
    if flies:  # for a moment at the top, by rounding alone
        _put(points, n, a)
        n += 1
    return n, s_sum, sequence


@_jit
def _slip(T: float, c: float, side: float, y: float, a: Instant, b: Instant) -> tuple[float, float, float]:
    """Slip from a to b, forward for side = 1, backward for -1: y at its end, integral of e, share of y that is lost."""
    s = b.sum_z - a.sum_z - c * (b.t - a.t)
    if T == 0:
        return side * (b.z - c) - b.X, side * s, 1.0
    lag, lost = a.z - side * (a.X + y) - c, -math.expm1(-(b.t - a.t) / T)
    return side * (b.z - c - lag + lag * lost) - b.X, side * (s - lag * T * lost), lost


@_jit
def _slide(
    rows: Complex, T: float, v: float, c: float, y: float, a: Instant, b: Instant, measure: bool, margins: Array
) -> tuple[float, float, float, float, float, int]:
    """Contact from a to b, no extreme between: y at b, integrals of e and of the force in stick; of more y at a, the
    share that is lost at b, and how much more the integral of e is; modes.
    """
    e, lost, more_e, modes = 0.0, 0.0, 0.0, 0
    stick = a  # its first instant
    for row in range(2):
        side, W_a, W_b = (1.0, a.A_T, b.A_T) if row == 0 else (-1.0, a.B_T, b.B_T)
        over = side * y - (W_a - c)
        _note(margins, over)
        if over >= 0 and W_b < W_a:
            y, e, lost = _slip(T, c, side, y, a, b)
            return y, e, 0.0, lost, T * lost, 1 + row
        if over > 0 and T == 0:
            y = side * (W_a - c)
        elif over > 0:
            lag = a.z - side * (a.X + y) - c
            f_b = lag * math.exp(-(b.t - a.t) / T) + W_b - (b.z - side * b.X)
            _note(margins, f_b)
            if f_b <= 0:
                y, e, lost = _slip(T, c, side, y, a, b)
                return y, e, 0.0, lost, T * lost, 3 + row
            t = root(rows, _LEAD + row, 0.0, -side * v * T, lag, a.t, T, a.t, b.t, -over, f_b)
            stick = instant_at(rows, T, v, t)
            y, e, lost = _slip(T, c, side, y, a, stick)
            more_e, modes = T * lost, 5 + row
            break
    end, again = b, 0.0
    for row in range(2):
        side, W_a, W_b = (1.0, stick.A_T, b.A_T) if row == 0 else (-1.0, stick.B_T, b.B_T)
        level = -side * y - c
        if W_b < W_a:
            _note(margins, W_b + level)
        if W_b + level < 0 and W_b < W_a:
            if T == 0 and not measure:
                return side * (W_b - c), 0.0, 0.0, 1.0, 0.0, 1 + row
            # an elastic spring that touches while its barrier comes nearer slips at once, but for rounding
            modes = 8 * modes + 6 + row if T > 0 else 1 + row
            t = root(
                rows, _BARRIER + row, -side * v, level - side * v * T, 0.0, 0.0, T,
                stick.t, b.t, W_a + level, W_b + level,
            )  # fmt: skip
            end, again = instant_at(rows, T, v, t), side
            break
    length = end.t - stick.t
    e += end.sum_X - stick.sum_X + y * length
    more_e += (1 - lost) * length
    pressed = end.sum_z - stick.sum_z + T * (end.z - stick.z) - c * length
    if again != 0:
        y, more, share = _slip(T, c, again, y, end, b)
        e += more
        more_e += (1 - lost) * T * share
        lost += (1 - lost) * share
    return y, e, pressed, lost, more_e, modes


@_jit
def _period(
    rows: Complex, T: float, v: float, c: float, points: Array, n: int, e: float, measure: bool, margins: Array
) -> tuple[float, float, float, float, float, int]:
    """A period from extension e on: e at its end; integrals of e and of the force in stick; of more e at the beginning,
    the share that is lost at the end, 1 - P', and how much more the integral of e is; modes.
    """
    e_sum, pressed, lost, more_e, modes = 0.0, 0.0, 0.0, 0.0, 0
    b = _get(points, 0)
    y = e - b.X
    for k in range(n - 1):
        a, b = b, _get(points, k + 1)
        if points[k, _FREE] == 0:
            y, more, stuck, share, of_y, code = _slide(rows, T, v, c, y, a, b, measure, margins)
            e_sum += more
            pressed += stuck
            more_e += (1 - lost) * of_y
            lost += (1 - lost) * share
            modes = (modes * 71 + code) % _PRIME
        elif T > 0:
            e, share = y + a.X, -math.expm1(-(b.t - a.t) / T)
            e_sum += e * T * share
            more_e += (1 - lost) * T * share
            lost += (1 - lost) * share
            y = e - e * share - b.X
        else:
            y = -b.X
    return y + b.X, e_sum, pressed, lost, more_e, modes


@_jit
def _spring(
    rows: Complex, T: float, v: float, c: float, cuts: Array, points: Array, margins: Array, measure: bool, share: float
) -> tuple[float, float, float, int, float]:
    """The periodic state of a spring: integrals of e, s and force in stick over a period, its modes as a number, and
    its extension at the beginning over its compression there; sought from that of another spring, `share`.
    """
    top = cuts[0, 1] - c
    kept = margins.size > 0
    if kept:
        margins[0] = 0.0
    if not top > 0:
        return 0.0, 0.0, 0.0, 0, share
    n, s_sum, sequence = _follow(rows, T, v, c, cuts, points, margins)
    n_margins = margins[0] if kept else 0.0
    # for v = 0 there may be many fixed points, of which v -> +0 leads to the highest
    low, high, e, before = -top, top, top * share if T > 0 and v > 0 and share < 1 - 1e-9 else top, 0
    e_sum, pressed, modes = 0.0, 0.0, 0
    for k in range(PERIODS):
        if kept:
            margins[0] = n_margins
        after, e_sum, pressed, lost, more_e, modes = _period(
            rows, T, v, c, points, n, e, measure and (T > 0 or k > 0), margins
        )
        if T == 0:
            if k == 1:
                break
            e, before = after, modes if v == 0 else 0  # a spring that never slips is where the first period left it
            continue
        if after > e:
            low = e
        else:
            high = e
        step = (after - e) / lost if lost > 0 else 2 * top
        if abs(step) <= max(CLOSE * lost * lost, CLOSEST) * top:
            e, e_sum = e + step, e_sum + more_e * step
            break
        if abs(after - e) <= 1e-15 * top or high - low <= 1e-15 * top:
            break
        e = e + step if low < e + step < high else 0.5 * (low + high)
    return e_sum, s_sum, pressed, (sequence + 7 * modes + 31 * before) % _PRIME, e / top


@_jit
def all_springs(m: Motion, v: Array, owner: NDArray[np.intp], c: Array) -> Array:
    """Means of e, s and force in stick (3, n) of springs of gaps c, ordered by the velocity v[owner]."""
    found = np.empty((3, c.size))
    last, share, before, none = owner[0], 1.0, 1.0, np.empty(0)
    cuts, points, _ = _cuts(m, v[last])
    for i in range(c.size):
        if owner[i] != last:
            last = owner[i]
            cuts, points, _ = _cuts(m, v[last])
        guess = share
        if i > 1 and abs(c[i] - c[i - 1]) < 4 * abs(c[i - 1] - c[i - 2]):  # as it changed between the two before
            guess += (share - before) * (c[i] - c[i - 1]) / (c[i - 1] - c[i - 2])
        before = share
        e, s, pressed, _, share = _spring(
            m.rows, m.T, v[last], c[i], cuts, points, none, True, min(max(guess, -1.0), 1.0)
        )
        found[0, i], found[1, i], found[2, i] = e / (2 * math.pi), s / (2 * math.pi), pressed / (2 * math.pi)
    return found


@_jit
def _between(near: Array, far: Array, least: float) -> float:
    """Where to look next for a change between two springs, as a share of the way from one to the other.

    near, far: their margins. The first that differs in sign has its zero at the change, nearly where its secant has
    it; a little beyond, on the side of the farther end, so that both ends come near. least: of that little.
    """
    for k in range(1, int(min(near[0], far[0])) + 1):
        if (near[k] > 0) != (far[k] > 0):
            zero = near[k] / (near[k] - far[k])
            beyond = max(0.05 * zero * (1 - zero), least)
            return float(min(zero + beyond, 0.5) if zero < 0.5 else max(zero - beyond, 0.5))
    return 0.5


@_jit
def all_changes(m: Motion, v: Array, c_low: float, c_high: float, scan: Array) -> Array:
    """Gaps between c_low and c_high at which the sequence of modes changes (n_v, MOST_CHANGES), NaN where no more."""
    found = np.full((v.size, MOST_CHANGES), np.nan)
    for i in range(v.size):
        cuts, points, at_near = _cuts(m, v[i])
        at_low, at_high, at_far, at_middle = np.zeros((4, at_near.size))
        # deeper springs never meet the lower barrier, as long as they are kept
        A, B, z = cuts[:, 3].min(), cuts[:, 4].min(), (cuts[:, 3] + cuts[:, 4]).min()
        share_low = 1.0
        start = max(c_low, min(0.5 * (A + B) - math.pi * v[i], 0.5 * z) - 1e-3)
        span, count, modes = c_high - start, 0, 0
        low = start
        for k in range(scan.size):
            high = start + scan[k] * span
            _, _, _, target, share_high = _spring(m.rows, m.T, v[i], high, cuts, points, at_high, False, share_low)
            while k > 0 and modes != target and count < MOST_CHANGES:
                near, far, other, share_near, share_far = low, high, target, share_low, share_high
                at_near[:], at_far[:] = at_low, at_high
                halve = False
                while far - near > NEAR * span:
                    width = far - near
                    part = 0.5 if halve else _between(at_near, at_far, 0.3 * NEAR * span / width)
                    middle = near + part * width
                    share = share_near + part * (share_far - share_near)
                    _, _, _, there, share = _spring(m.rows, m.T, v[i], middle, cuts, points, at_middle, False, share)
                    if there == modes:
                        near, share_near = middle, share
                        at_near[:] = at_middle
                    else:
                        far, other, share_far = middle, there, share
                        at_far[:] = at_middle
                    halve = far - near > 0.51 * width
                if count == 0 or near > found[i, count - 1] + 4 * NEAR * span:
                    found[i, count] = 0.5 * (near + far)
                    count += 1
                low, modes, share_low = far, other, share_far
                at_low[:] = at_far
            low, modes, share_low = high, target, share_high
            at_low[:] = at_high
    return found
