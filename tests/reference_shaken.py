"""The independent twin of a contact shaken along its way: the laws of one spring in tiny steps, and nothing else.

Nothing here comes from the library. Units as in reference.py, where the unit of normal lengths is one that the caller
chooses: tangential lengths in mu_0 kappa of it, stiffness in that of all springs at rest depth, 2 G* a(u_z0), time in
1/omega. The shape is g ~ x**n with a(u_z0) = 1, so that g = u_z0 x**n; infinite n is a flat punch.

Per spring and step: s = z - gap while that lies above the freely relaxing surface s exp(-h/T). The force L[e] is what
it would be in stick, held within the normal force L[s] at the middle of the step; for T = 0 e is held within s at the
end. The body moves by the leap-frog method under the force of the step. Two numbers of steps, one twice the other, are
extrapolated, and what they differ by tells how good that is.

Kelvin springs under a rigid pull also by scipy's solver of differential equations, from one change of mode to the next:
far more exact, and far slower.
"""

import math

import numpy as np
from numba import njit
from scipy.integrate import solve_ivp


@njit(nogil=True)
def periods(gap, w, z, x, T, v, M, C, K, n_periods):
    """Mean of sum w e over that of sum w s in each of n_periods, z and x over one period with both ends."""
    n, steps = gap.size, z.size - 1
    h = 2 * math.pi / steps
    e, s = np.empty(n), np.empty(n)
    for i in range(n):
        s[i] = max(z[0] - gap[i], 0.0)
        e[i] = s[i]
    S = 0.0
    for i in range(n):
        S += w[i] * e[i]
    y, y_rate = -S / K if math.inf > K else 0.0, 0.0
    out = np.empty(n_periods)
    decay, half = (math.exp(-h / T), math.exp(-0.5 * h / T)) if T > 0 else (0.0, 0.0)
    for period in range(n_periods):
        total_e, total_s = 0.0, 0.0
        for k in range(steps):
            z_0, z_1 = z[k], z[k + 1]
            middle, rate = 0.5 * (z_0 + z_1), (z_1 - z_0) / h
            dy = h * y_rate if math.inf > K else 0.0
            du = v * h + x[k + 1] - x[k] + dy
            sum_e, sum_s, force = 0.0, 0.0, 0.0
            for i in range(n):
                e_0, s_0 = e[i], s[i]
                if T == 0.0:
                    s_1 = max(z_1 - gap[i], 0.0)
                    touched = s_1 / (z_1 - z_0) if s_0 == 0.0 and s_1 > 0.0 else 1.0
                    e_1 = min(max(e_0 + min(touched, 1.0) * du, -s_1), s_1)
                    force += w[i] * 0.5 * (e_0 + e_1)
                else:
                    touches = middle - gap[i] >= s_0 * half
                    load = max(middle - gap[i] + T * rate, 0.0) if touches else 0.0
                    drag = min(max(e_0 + T * du / h, -load), load)
                    sticks = load > 0.0 and abs(drag) < load
                    e_1 = e_0 + du if sticks else drag + (e_0 - drag) * decay
                    s_1 = max(z_1 - gap[i], s_0 * decay)
                    force += w[i] * (0.5 * (e_0 + e_1) + T * (e_1 - e_0) / h)
                e[i], s[i] = e_1, s_1
                sum_e += w[i] * 0.5 * (e_0 + e_1)
                sum_s += w[i] * 0.5 * (s_0 + s_1)
            total_e += sum_e
            total_s += sum_s
            if math.inf > K:
                y_new = y + dy
                # at the end of the step: its own force, the spring at its end, the damper at the mean velocity
                y_rate = (y_rate * (M - 0.5 * h * C) - h * (force + K * 0.5 * (y + y_new))) / (M + 0.5 * h * C)
                y = y_new
        out[period] = total_e / total_s
    return out


def springs(n, depth, greatest, count):
    """Gaps and shares of `count` cells by the middle rule; depth and greatest depth in the unit."""
    if math.isinf(n):
        return np.array([-depth]), np.array([1.0])
    reach = (greatest / depth) ** (1 / n) if depth > 0 else 1.0
    edges = reach * np.arange(count + 1) / count
    mean = depth * np.diff(edges ** (n + 1)) / ((n + 1) * np.diff(edges))
    return mean - depth, np.diff(edges)


def friction(n, depth, z_n, x_n, T, v, body=None, steps=8192, count=600, n_periods=3):
    """COF over mu_0 and how far it may be off: extrapolated from `steps` and twice as many, from full slip on.

    z_n, x_n: complex amplitudes of harmonics 1, 2, ... of depth and shake. v > 0. body: M, C, K or None. Springs of
    dashpots forget a touch slowly, so that contacts that slip throughout are better known from their v_c.
    """
    found = []
    for fine in (steps, 2 * steps):
        phase = 2 * np.pi * np.arange(fine + 1) / fine
        z, x = (sum((a * np.exp(1j * (j + 1) * phase)).real for j, a in enumerate(each)) for each in (z_n, x_n))
        z, x = np.zeros(fine + 1) + z, np.zeros(fine + 1) + x
        gap, w = springs(n, depth, depth + z.max(), count)
        M, C, K = body if body is not None else (0.0, 0.0, math.inf)
        found.append(periods(gap, w, z, x, T, v, M, C, K, n_periods))
    one, two = found
    order = 2 if T == 0 and body is None else 1
    best = two[-1] + (two[-1] - one[-1]) / (2**order - 1)
    return float(best), 2 * float(abs(best - two[-1]) + abs(two[-1] - two[-2]))


# --- by a solver of differential equations ---

#: steps so short that hardly a change and its undoing fall within one, unseen
PRECISE = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-13, "max_step": 0.05}


def spring(gap, z_n, x_n, T, v, most=60):
    """Means over a period of e and s of one Kelvin spring (T > 0) that is pulled at v of either sign, once the period
    repeats itself.
    """

    def of(harmonics, t, order):
        return sum((a * (1j * n) ** order * np.exp(1j * n * t)).real for n, a in enumerate(harmonics, start=1))

    def force(t):
        return of(z_n, t, 0) - gap + T * of(z_n, t, 1)

    def rate(t):
        return v + of(x_n, t, 1)

    laws = {  # e' and s' of each mode; s is z - gap in contact
        "stick": lambda t, y: (rate(t), of(z_n, t, 1)),
        "slip": lambda t, y: ((force(t) - y[0]) / T, of(z_n, t, 1)),
        "back": lambda t, y: ((-force(t) - y[0]) / T, of(z_n, t, 1)),
        "free": lambda t, y: (-y[0] / T, -y[1] / T),
    }
    over = {  # what ends a mode as it rises above zero, and what follows
        "stick": {
            "slip": lambda t, y: y[0] + T * rate(t) - force(t),
            "back": lambda t, y: -y[0] - T * rate(t) - force(t),
        },
        "slip": {"stick": lambda t, y: force(t) - y[0] - T * rate(t), "free": lambda t, y: -force(t)},
        "back": {"stick": lambda t, y: force(t) + y[0] + T * rate(t), "free": lambda t, y: -force(t)},
        "free": {"touch": lambda t, y: of(z_n, t, 0) - gap - y[1]},
    }

    def mode_in_contact(t, y):
        return "slip" if over["stick"]["slip"](t, y) >= 0 else "back" if over["stick"]["back"](t, y) >= 0 else "stick"

    def ends(mode):
        for next_one, value in over[mode].items():

            def event(t, y, value=value):
                return value(t, y)

            event.terminal, event.direction = True, 1
            yield next_one, event

    phases = np.linspace(0, 2 * np.pi, 4001)
    t = start = phases[np.argmax(of(z_n, phases, 0) * np.ones(phases.size))]  # pressed there, if ever
    y = np.array([0.0, max(of(z_n, t, 0) - gap, 0.0)])
    mode, means = mode_in_contact(t, y) if y[1] > 0 else "free", None
    for k in range(1, most + 1):
        end, state, before = start + 2 * np.pi * k, np.array([*y, 0.0, 0.0]), y[0]
        while t < end:
            named = list(ends(mode))

            def law(t, y, mode=mode):
                return (*laws[mode](t, y), y[0], y[1])

            part = solve_ivp(law, (t, end), state, events=[event for _, event in named], **PRECISE)
            t, state = part.t[-1], part.y[:, -1]
            if part.status == 1:
                mode = next(name for (name, _), hits in zip(named, part.t_events, strict=True) if hits.size)
            if mode == "touch":
                mode = mode_in_contact(t, state)
        y, means = state[:2], state[2:] / (2 * np.pi)
        if abs(y[0] - before) < 1e-12:
            break
    else:
        raise ValueError(f"the spring does not repeat itself within {most} periods")
    return float(means[0]), float(means[1])
