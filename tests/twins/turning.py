"""The independent twin of a contact shaken along and across its way, whose friction is a vector: the laws of one spring
in tiny steps (tiny_steps.py), and nothing else.

Nothing here comes from the library. Units: normal lengths in one that the caller chooses, tangential lengths in
mu_0 kappa of it, stiffness in that of the whole row, time in 1/omega.

One Kelvin spring that moves along its way only is also followed by scipy's solver of differential equations, from one
change of mode to the next: far more exact, and far slower.
"""

import math
from functools import partial

import numpy as np
from scipy.integrate import solve_ivp
from twins import tiny_steps
from twins.tiny_steps import Body, Law, Row, crowded, motion_of, pulled, response

ELASTIC = 0.0, (), ()  #: T, rho, theta
RIGID = 0.0, 0.0, math.inf  #: M, C, K of what does not yield


def springs(n, depth, parts, count):
    """Gaps and shares of a shape g ~ x**n that bends at depths `parts` and ends at the greatest of them. a(depth) = 1,
    or that of the greatest depth where the mean is none. `count` cells in all, in each part crowded towards both of its
    ends, by the middle rule.
    """
    if math.isinf(n):
        return Row(np.array([-float(depth)]), np.array([1.0]))
    ends = np.unique(np.maximum([0.0, *parts], 0.0))
    size = depth if depth > 0 else ends[-1]  # in whose radius x is measured
    ends = (ends[np.diff(ends, prepend=-1.0) > 1e-9 * size] / size) ** (1 / n)
    edges = crowded(ends, count)
    mean = size * np.diff(edges ** (n + 1)) / ((n + 1) * np.diff(edges))
    return Row(mean - depth, np.diff(edges))


def at_rest(row, law, motion, body):
    """Full slip along the pull, relaxed, and the body where that force leaves it."""
    s = np.maximum(motion.z[0] - row.gap, 0.0)
    return pulled(row, law, body, s, math.copysign(1.0, motion.v[0]) * s)


def bends(depth, z_n, law):
    """Depths at which the row bends: the least one, that of a spring that never leaves, and the greatest."""
    phase, n = 2 * np.pi * np.arange(4096) / 4096, np.arange(1, len(z_n) + 1)[:, None]
    z = np.array(z_n)[:, None] * np.exp(1j * n * phase)
    p = np.array([response(law, one) for one in n]) * z
    z, p = z.real.sum(axis=0), p.real.sum(axis=0)
    return depth + z.min(), depth + p.min(), depth + z.max()


def friction(n, depth, z_n, x_n, y_n, v, material=ELASTIC, body=RIGID, across=RIGID, steps=16384, count=128):
    """COF over mu_0 along and across, in the state that repeats itself, which is begun with full slip along the pull.

    n, depth: exponent of the shape, infinite for a flat punch, and mean depth. z_n, x_n, y_n: complex amplitudes of
    harmonics 1, 2, ... of depth and motion; of a shaken pulling point, those of the body without friction. v: pull, of
    either sign. material: T, rho, theta. body, across: (M, C, K) along and across the pull.
    steps: per period, of the finest of four marches. count: springs; what four times as many would change is found
    with few steps.
    """
    law = Law(float(material[0]), *(np.array(one, dtype=float) for one in material[1:]))
    body = Body(*np.array([body, across], dtype=float).T.copy())
    row_of, motion_in = partial(springs, n, depth, bends(depth, z_n, law)), partial(motion_of, z_n, x_n, y_n, v)
    return tiny_steps.friction(law, body, row_of, motion_in, at_rest, steps, count)


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
