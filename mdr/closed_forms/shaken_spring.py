"""One elastic or Kelvin spring under a pull that is shaken in the plane: its periodic state, event by event, compiled.

shaken_pull.py derives the three facts that this rests on, and has the symbols.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mdr.tools.arrays import Array
from mdr.tools.jit import compiled, inner

Complex = NDArray[np.complex128]

MOST_CHANGES = 96  #: of the sequence of modes along the array; further ones are left to the halving
MOST_TURNS = 100  #: of Newton's method, for an instant and for the periodic state
#: half of the digits: last step of Newton's method, over the compression and (1 - P')², whose square is a rounding; and
#: share of the range of gaps to which a change is found, as far as gaps have digits
CLOSE = 1e-7

_jit = compiled(nogil=True, error_model="numpy")
_inner = inner(error_model="numpy")


class Harmonics(NamedTuple):
    """The motion without the drift; of two rows the first is of slip forward, the second of slip backward."""

    T: float
    z: Complex  # (N,)
    x: Complex
    z_T: Complex
    barriers: Complex  # A^T and B^T (2, N)
    leads: Complex  # T A' and T B' (2, N)
    rates: Complex  # of the barriers (2, N)
    turns: tuple[Array, Array]  # phases and values (n, 2) of the extremes of these rates
    tops: Array  # and of those of z^T


class Instant(NamedTuple):
    """What is known at one phase."""

    t: float
    z: float
    X: float
    A_T: float
    B_T: float
    sum_z: float  # integral of z
    sum_X: float


_FREE = len(Instant._fields)  # column of a table of instants


# --- harmonic sums ----------------------------------------------------------------------------------------


@_inner
def root(
    C: Complex, drift: float, level: float, decaying: float, since: float, T: float,
    low: float, high: float, f_low: float, f_high: float,
) -> float:  # fmt: skip
    """Root between low and high of Re sum C_n exp(i n t) + drift t + level + decaying exp(-(t - since)/T)."""
    if (f_low > 0) == (f_high > 0):
        return low if abs(f_low) < abs(f_high) else high
    t = low + (high - low) * math.acos(1 - 2 * f_low / (f_low - f_high)) / math.pi
    for _ in range(MOST_TURNS):
        w = complex(math.cos(t), math.sin(t))
        power, f, slope = w, drift * t + level, drift
        for n in range(C.size):
            turn = C[n] * power
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


@_inner
def instant_at(m: Harmonics, v: float, t: float) -> Instant:
    """The motion at phase t, at the velocity v."""
    w = complex(math.cos(t), math.sin(t))
    power = w
    z, x, z_rate, x_rate, sum_z, sum_x = 0.0, 0.0, 0.0, v, 0.0, 0.0
    for n in range(m.z.size):
        in_z, in_x = m.z[n] * power, m.x[n] * power
        z += in_z.real
        x += in_x.real
        z_rate -= (n + 1) * in_z.imag
        x_rate -= (n + 1) * in_x.imag
        sum_z += in_z.imag / (n + 1)
        sum_x += in_x.imag / (n + 1)
        power *= w
    x += v * t
    A_T, B_T = z - x + m.T * (z_rate - x_rate), z + x + m.T * (z_rate + x_rate)
    return Instant(t, z, x, A_T, B_T, sum_z, sum_x + 0.5 * v * t * t)


@_inner
def _get(points: Array, k: int) -> Instant:
    row = points[k]
    return Instant(row[0], row[1], row[2], row[3], row[4], row[5], row[6])


@_inner
def _put(points: Array, k: int, now: Instant) -> None:
    row = points[k]
    row[0], row[1], row[2], row[3], row[4], row[5], row[6] = now
    row[_FREE] = 0.0


@_jit
def _cuts(given: Harmonics, v: float) -> tuple[Array, Array]:
    """Instants (n, 8) of the extremes of A^T, B^T and z^T and of the ends of a period; room for those of a spring.

    A row has the fields of an Instant and whether the spring is free from there to the next.
    """
    t = np.empty(len(given.turns[0]) + len(given.turns[1]) + len(given.tops) + 2)
    t[0], t[1], count = 0.0, 2 * math.pi, 2
    for row in range(2):
        turns, level = given.turns[row], -v if row == 0 else v
        for i in range(len(turns)):
            low, high = turns[i - 1, 0] - (2 * math.pi if i == 0 else 0.0), turns[i, 0]
            f_low, f_high = turns[i - 1, 1] + level, turns[i, 1] + level
            if (f_low > 0) != (f_high > 0):
                found = root(given.rates[row], 0.0, level, 0.0, 0.0, 0.0, low, high, f_low, f_high)
                t[count] = found % (2 * math.pi)
                count += 1
    for i in range(len(given.tops)):
        t[count + i] = given.tops[i, 0]
    t = np.sort(t[: count + len(given.tops)])
    cuts, count = np.empty((t.size, _FREE + 1)), 0
    for i in range(t.size):
        if i == 0 or t[i] > t[i - 1] + 1e-14:
            _put(cuts, count, instant_at(given, v, t[i]))
            count += 1
    return cuts[:count], np.empty((3 * count, _FREE + 1))


# --- one spring -------------------------------------------------------------------------------------------


@_jit
def _follow(m: Harmonics, v: float, c: float, cuts: Array, points: Array) -> tuple[int, float, int]:
    """Normal motion: puts the instants of contact, with those of touch and leave, into points.

    Returns their number, the integral of s, and the sequence of touches and leaves as a number.
    """
    T, a = m.T, _get(cuts, 0)
    _put(points, 0, a)
    n, flies, left_at, s_left, s_sum, sequence = 1, False, 0.0, 0.0, 0.0, 0
    for k in range(len(cuts) - 1):
        b = _get(cuts, k + 1)
        z_a, z_b = 0.5 * (a.A_T + a.B_T) - c, 0.5 * (b.A_T + b.B_T) - c
        begin, end, code = a, b, 0  # of the part in which z^T > c
        if z_b < 0:
            end = a
            if z_a > 0:
                end = instant_at(m, v, root(m.z_T, 0.0, -c, 0.0, 0.0, T, a.t, b.t, z_a, z_b))
        if flies and end.t > a.t:
            h_a, h_end = a.z - c, end.z - c
            if T > 0:
                h_a -= s_left * math.exp(-(a.t - left_at) / T)
                h_end -= s_left * math.exp(-(end.t - left_at) / T)
            if h_end > 0:
                flies, code = False, 1
                if h_a < 0:
                    t = root(m.z, 0.0, -c, -s_left, left_at, T, a.t, end.t, h_a, h_end)
                    begin = instant_at(m, v, t)
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
        sequence = sequence * 11 + code
        a = b
    if flies:  # for a moment at the top, by rounding alone
        _put(points, n, a)
        n += 1
    return n, s_sum, sequence


@_inner
def _slip(T: float, c: float, side: float, y: float, a: Instant, b: Instant) -> tuple[float, float, float]:
    """Slip from a to b, forward for side = 1, backward for -1: y at its end, integral of e, share of y that is lost."""
    s = b.sum_z - a.sum_z - c * (b.t - a.t)
    if T == 0:
        return side * (b.z - c) - b.X, side * s, 1.0
    lag, lost = a.z - side * (a.X + y) - c, -math.expm1(-(b.t - a.t) / T)
    return side * (b.z - c - lag + lag * lost) - b.X, side * (s - lag * T * lost), lost


@_inner
def _slide(
    m: Harmonics, v: float, c: float, y: float, a: Instant, b: Instant
) -> tuple[float, float, float, float, float, int]:
    """Contact from a to b, no extreme between: y at b, integrals of e and of the force in stick; of more y at a, the
    share that is lost at b, and how much more the integral of e is; modes.
    """
    T, e, lost, more_e, modes = m.T, 0.0, 0.0, 0.0, 0
    stick = a  # its first instant
    for row in range(2):
        side, W_a, W_b = (1.0, a.A_T, b.A_T) if row == 0 else (-1.0, a.B_T, b.B_T)
        over = side * y - (W_a - c)
        if over >= 0 and W_b < W_a:
            y, e, lost = _slip(T, c, side, y, a, b)
            return y, e, 0.0, lost, T * lost, 1 + row
        if over > 0 and T == 0:
            y = side * (W_a - c)
        elif over > 0:
            lag = a.z - side * (a.X + y) - c
            f_b = lag * math.exp(-(b.t - a.t) / T) + W_b - (b.z - side * b.X)
            if f_b <= 0:
                y, e, lost = _slip(T, c, side, y, a, b)
                return y, e, 0.0, lost, T * lost, 3 + row
            t = root(m.leads[row], 0.0, -side * v * T, lag, a.t, T, a.t, b.t, -over, f_b)
            stick = instant_at(m, v, t)
            y, e, lost = _slip(T, c, side, y, a, stick)
            more_e, modes = T * lost, 5 + row
            break
    end, again = b, 0.0
    for row in range(2):
        side, W_a, W_b = (1.0, stick.A_T, b.A_T) if row == 0 else (-1.0, stick.B_T, b.B_T)
        level = -side * y - c
        if W_b + level < 0 and W_b < W_a:
            # an elastic spring that touches while its barrier comes nearer slips at once, but for rounding
            modes = 8 * modes + 6 + row if T > 0 else 1 + row
            t = root(
                m.barriers[row], -side * v, level - side * v * T, 0.0, 0.0, T,
                stick.t, b.t, W_a + level, W_b + level,
            )  # fmt: skip
            end, again = instant_at(m, v, t), side
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
    m: Harmonics, v: float, c: float, points: Array, n: int, e: float
) -> tuple[float, float, float, float, float, int]:
    """A period from extension e on: e at its end; integrals of e and of the force in stick; of more e at the beginning,
    the share that is lost at the end, 1 - P', and how much more the integral of e is; modes.
    """
    T, e_sum, pressed, lost, more_e, modes = m.T, 0.0, 0.0, 0.0, 0.0, 0
    b = _get(points, 0)
    y = e - b.X
    for k in range(n - 1):
        a, b = b, _get(points, k + 1)
        if points[k, _FREE] == 0:
            y, more, stuck, share, of_y, code = _slide(m, v, c, y, a, b)
            e_sum += more
            pressed += stuck
            more_e += (1 - lost) * of_y
            lost += (1 - lost) * share
            modes = modes * 71 + code
        elif T > 0:
            e, share = y + a.X, -math.expm1(-(b.t - a.t) / T)
            e_sum += e * T * share
            more_e += (1 - lost) * T * share
            lost += (1 - lost) * share
            y = e - e * share - b.X
        else:
            y = -b.X
    return y + b.X, e_sum, pressed, lost, more_e, modes


@_inner
def _spring(
    m: Harmonics, v: float, c: float, cuts: Array, points: Array, share: float
) -> tuple[float, float, float, int, float]:
    """The periodic state of a spring: integrals of e, s and force in stick over a period, its modes as a number, and
    its extension at the beginning over its compression there; sought from that of another spring, `share`.
    """
    T, top = m.T, cuts[0, 1] - c
    if not top > 0:
        return 0.0, 0.0, 0.0, 0, share
    n, s_sum, sequence = _follow(m, v, c, cuts, points)
    # for v = 0 there may be many fixed points, of which v -> +0 leads to the highest
    low, high, e, before = -top, top, top * share if T > 0 and v > 0 and share < 1 - 1e-9 else top, 0
    e_sum, pressed, modes = 0.0, 0.0, 0
    for k in range(MOST_TURNS):
        after, e_sum, pressed, lost, more_e, modes = _period(m, v, c, points, n, e)
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
        if abs(step) <= CLOSE * max(lost * lost, CLOSE) * top:
            e, e_sum = e + step, e_sum + more_e * step
            break
        if abs(after - e) <= 1e-15 * top or high - low <= 1e-15 * top:
            break
        e = e + step if low < e + step < high else 0.5 * (low + high)
    return e_sum, s_sum, pressed, sequence + 7 * modes + 31 * before, e / top


@_jit
def all_springs(given: Harmonics, v: Array, owner: NDArray[np.intp], c: Array) -> Array:
    """Means of e, s and force in stick (3, n) of springs of gaps c, ordered by the velocity v[owner]."""
    found = np.empty((3, c.size))
    last, share, before = owner[0], 1.0, 1.0
    cuts, points = _cuts(given, v[last])
    for i in range(c.size):
        if owner[i] != last:
            last = owner[i]
            cuts, points = _cuts(given, v[last])
        guess = share
        if i > 1 and abs(c[i] - c[i - 1]) < 4 * abs(c[i - 1] - c[i - 2]):  # as it changed between the two before
            guess += (share - before) * (c[i] - c[i - 1]) / (c[i - 1] - c[i - 2])
        before = share
        guess = min(max(guess, -1.0), 1.0)
        e, s, pressed, _, share = _spring(given, v[last], c[i], cuts, points, guess)
        found[0, i], found[1, i], found[2, i] = e / (2 * math.pi), s / (2 * math.pi), pressed / (2 * math.pi)
    return found


@_jit
def all_changes(given: Harmonics, v: Array, c_low: float, c_high: float, scan: Array) -> Array:
    """Gaps between c_low and c_high at which the sequence of modes changes (n_v, MOST_CHANGES), NaN where no more."""
    found = np.full((v.size, MOST_CHANGES), np.nan)
    for i in range(v.size):
        cuts, points = _cuts(given, v[i])
        # deeper springs never meet the lower barrier, as long as they are kept
        A, B, z = cuts[:, 3].min(), cuts[:, 4].min(), (cuts[:, 3] + cuts[:, 4]).min()
        start = max(c_low, min(0.5 * (A + B) - math.pi * v[i], 0.5 * z) - 1e-3)
        span, count, low, modes, share = c_high - start, 0, start, 0, 1.0
        close = max(CLOSE * span, 1e-15 * max(abs(start), abs(c_high)))
        for k in range(scan.size):
            high = start + scan[k] * span
            _, _, _, target, share_high = _spring(given, v[i], high, cuts, points, share)
            while k > 0 and modes != target and count < MOST_CHANGES:
                near, far, beyond = low, high, target
                while far - near > close:
                    middle = 0.5 * (near + far)
                    _, _, _, there, share = _spring(given, v[i], middle, cuts, points, share)
                    if there == modes:
                        near = middle
                    else:
                        far, beyond = middle, there
                if count == 0 or near > found[i, count - 1] + 4 * close:
                    found[i, count] = 0.5 * (near + far)
                    count += 1
                low, modes = far, beyond
            low, modes, share = high, target, share_high
    return found
