"""Critical velocity in full slip in plain NumPy: any depth, elastic, Kelvin or with arms, on any body, g = x**exponent.

Scaled as in rigid_pull.py: lengths in a unit of the depth, time as phase omega t, forces over the stiffness of a
contact one unit deep, tangential lengths in mu_0 kappa units. Without arms the edge of the contact is the least chord
of its definition, by search over a grid of flights; of a punch, and with arms, springs are followed in small steps, s
never less than z - gap, and L[s] = 0 where it is more. The sum S of all s gives F = L[S]. The body moves by
M y'' + C y' + K y = -(F - mean F), harmonic by harmonic; without mass y' is what this equation says of y and F.
"""

import math

import numpy as np

FLIGHTS = np.concatenate([np.geomspace(1e-5, 0.02, 700)[:-1], np.linspace(0.02, 2 * np.pi, 3000)])


def harmonic_sum(Z, phase):
    n = np.arange(1, len(Z) + 1)
    return (np.asarray(Z) * np.exp(1j * np.multiply.outer(phase, n))).real.sum(-1)


def rate(Z):
    return 1j * np.arange(1, len(Z) + 1) * np.asarray(Z)


def edge(Z, T, phase):
    """Gap of the spring at the edge, by the definition, and the share of its deflection that its flight left."""
    z, tangent = harmonic_sum(Z, phase), harmonic_sum(Z, phase) + T * harmonic_sum(rate(Z), phase)
    if T == 0:
        return z, np.zeros_like(z)
    n = np.arange(1, len(Z) + 1)
    there, back = np.asarray(Z) * np.exp(1j * np.multiply.outer(phase, n)), np.exp(-1j * np.outer(n, FLIGHTS))
    past = there.real @ back.real - there.imag @ back.imag
    with np.errstate(over="ignore"):
        chord = z[:, None] + (z[:, None] - past) / np.expm1(FLIGHTS / T)
    k = np.clip(chord.argmin(axis=1), 1, FLIGHTS.size - 2)
    rows = np.arange(phase.size)
    x, f = FLIGHTS[k[:, None] + [-1, 0, 1]], chord[rows[:, None], k[:, None] + [-1, 0, 1]]
    a, b = (f[:, 1] - f[:, 0]) / (x[:, 1] - x[:, 0]), (f[:, 2] - f[:, 1]) / (x[:, 2] - x[:, 1])
    bend = (b - a) / (x[:, 2] - x[:, 0])
    with np.errstate(all="ignore"):
        flight = np.where(bend > 0, 0.5 * (x[:, 0] + x[:, 1] - a / bend), x[:, 1])
    flight = np.clip(flight, x[:, 0], x[:, 2])
    with np.errstate(over="ignore"):
        least = z + (z - harmonic_sum(Z, phase - flight)) / np.expm1(flight / T)
    least = np.minimum(least, chord.min(axis=1))
    return np.minimum(least, tangent), np.where(least < tangent, np.exp(-flight / T), 1.0)


class Row:
    """Springs of g = x**exponent without arms: force, its rate and contact at any phases."""

    def __init__(self, Z, exponent, depth, T):
        self.Z, self.power, self.depth, self.T = np.asarray(Z), 0.0 if math.isinf(exponent) else 1 / exponent, depth, T

    def __call__(self, phase):
        Z, T, p = self.Z, self.T, self.power
        c, left = edge(Z, T, phase)
        d = np.maximum(c + self.depth, 0)
        inside = c + self.depth > 0
        radius = np.where(inside, d**p, 0)
        above = harmonic_sum(Z, phase) - c + T * harmonic_sum(rate(Z), phase)
        F = radius * above + d ** (1 + p) / (1 + p)
        lag = harmonic_sum(rate(Z), phase) + T * harmonic_sum(rate(rate(Z)), phase)
        with np.errstate(all="ignore"):
            advance = np.where(left < 1, p * d ** (p - 1) * above**2 / (T * (1 - left)) if T else 0.0, 0.0)
        return F, radius * lag + np.where(inside, np.nan_to_num(advance), 0), inside


def springs(exponent, depth, deepest, n):
    """Gaps and widths of n springs; a punch is one spring."""
    if math.isinf(exponent):
        return np.array([-depth]), np.array([1.0])
    ends = np.linspace(0, 1, n + 1) ** 2 * (depth + deepest) ** (1 / exponent)
    middle, width = 0.5 * (ends[1:] + ends[:-1]), np.diff(ends)
    return middle**exponent + width**2 / 24 * exponent * (exponent - 1) * middle ** (exponent - 2) - depth, width


def compression(Z, gap, width, T, arms, n_t):
    """Sum S of s at n_t instants of the periodic state, and how far the last spring's foot is above itself, if free."""
    phase, h = 2 * np.pi * np.arange(n_t) / n_t, 2 * np.pi / n_t
    z = harmonic_sum(Z, phase)
    rho, theta = (np.array(x)[:, None] for x in arms)
    E, gain = np.exp(-h / theta), -np.expm1(-h / theta) * theta / h
    stiff = 1 + T / h + (rho * gain).sum(0)
    start = int(np.argmax(z))
    s, x = np.maximum(z[start] - gap, 0), np.zeros((len(rho), gap.size))
    S, ahead = np.empty((2, n_t))
    decay = math.exp(-h / T) if T else 0.0
    periods = 2 if not len(rho) else 2 + int(np.ceil(25 * max(theta.max() / (2 * np.pi), 0.2)))
    for k in range(start + 1, start + 1 + periods * n_t):
        k %= n_t
        free = ((stiff - 1) * s - (rho * E * x).sum(0)) / stiff if len(rho) else s * decay
        new = np.maximum(z[k] - gap, free)
        x = E * x + gain * (new - s)
        s = new
        S[k], ahead[k] = width @ s, z[k] - gap[-1] - free[-1]
    return S, ahead


def critical_velocity(Z, X, exponent, depth, T, arms, M, C, K, n_t, n):
    """Greatest z' - y' - x' in contact."""
    phase, order = 2 * np.pi * np.arange(n_t) / n_t, np.arange(n_t // 2)
    row, punch = Row(Z, exponent, depth, T), math.isinf(exponent)
    if arms or punch:
        gap, width = springs(exponent, depth, harmonic_sum(Z, phase).max(), n)
        S, ahead = compression(Z, np.append(gap, -depth), np.append(width, 0.0), T, arms or ((), ()), n_t)
        pairs = zip(*arms, strict=True) if arms else ()
        L = 1 + 1j * order * T + sum(r * 1j * order * t / (1 + 1j * order * t) for r, t in pairs)
        F_n = L * np.fft.rfft(S)[: n_t // 2] / n_t
        inside = ahead > -1e-13
    else:
        F, _, inside = row(phase)
        F_n = np.fft.rfft(F)[: n_t // 2] / n_t
    y_n = np.zeros(order.size, dtype=complex)
    if math.isfinite(K):
        y_n[1:] = -2 * F_n[1:] / (K - M * order[1:] ** 2 + 1j * order[1:] * C)

    def given(phase):
        return harmonic_sum(rate(Z), phase) - harmonic_sum(rate(X), phase)

    def values(phase):
        """The slip rate at any phases."""
        if M > 0 or arms or math.isinf(K):
            return given(phase) - harmonic_sum(1j * order[1:] * y_n[1:], phase)
        F, F_dot, here = row(phase)
        out = (F - F_n[0].real + K * harmonic_sum(y_n[1:], phase)) / C if C > 0 else F_dot / K
        return np.where(here, given(phase) + out, -np.inf)

    if M == 0 and not arms and math.isfinite(K):
        first = values(phase)
        best, at, reach = first.max(), phase[np.argmax(first)], 2 * np.pi / n_t
        for _ in range(4):
            near = at + reach * np.linspace(-1.5, 1.5, 301)
            found = values(near)
            at, best, reach = near[np.argmax(found)], max(best, found.max()), reach / 50
        return best
    fine = 8 * n_t
    v_n = -1j * order * y_n
    v_n[1 : len(Z) + 1] += rate(Z)
    v_n[1 : len(X) + 1] -= rate(X)
    dense = np.fft.irfft(np.concatenate([v_n * fine / 2, np.zeros(fine // 2 + 1 - v_n.size)]), fine)
    if inside.all():
        return peak(dense)
    ends = crossings(row, inside, n_t) if not (arms or punch) else touches_of(ahead, inside, n_t)
    at = 2 * np.pi * np.arange(fine) / fine
    since, left = (np.mod(at[:, None] - one, 2 * np.pi).min(1) for one in ends)
    return max(dense[since <= left].max(), values(np.concatenate(ends)).max())


def peak(values):
    """Greatest of a smooth periodic function, by a parabola through the greatest of its values."""
    k = int(np.argmax(values))
    before, top, after = values[k - 1], values[k], values[(k + 1) % values.size]
    return top + (after - before) ** 2 / (8 * (2 * top - before - after))


def crossings(row, inside, n_t):
    """Phases at which the tip touches and leaves, by bisection."""
    out = []
    for kind in (False, True):  # touches: from no contact to contact
        k = np.flatnonzero((inside == kind) & (np.roll(inside, -1) != kind))
        low, high = 2 * np.pi / n_t * k, 2 * np.pi / n_t * (k + 1)
        for _ in range(40):
            middle = 0.5 * (low + high)
            same = row(middle)[2] == kind
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        out.append(low if kind else high)
    return out


def touches_of(ahead, inside, n_t):
    """The same of a followed spring: linear between instants, and from before where it leaves."""
    touch = np.flatnonzero(~inside & np.roll(inside, -1))
    after = (touch + 1) % n_t
    leave = np.flatnonzero(inside & ~np.roll(inside, -1))
    fall = ahead[leave - 1] - ahead[leave]
    step = 2 * np.pi / n_t
    return step * (touch + ahead[touch] / (ahead[touch] - ahead[after])), step * (
        leave + np.clip(ahead[leave] / fall, 0, 1)
    )


def converged(*case, wanted=3e-7, n_t=2048, n=500, most=3):
    """The velocity, refined until two grids differ by less, and what they differ by."""
    floor = 0.1 * np.abs(rate(case[0])).sum()
    last = critical_velocity(*case, n_t, n)
    for _ in range(most):
        n_t, n = 2 * n_t, 2 * n
        found = critical_velocity(*case, n_t, n)
        off = abs(found - last) / max(abs(found), floor)
        if off < wanted:
            break
        last = found
    return found, off
