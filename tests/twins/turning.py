"""The independent twin of a contact shaken along and across its way, whose friction is a vector: the laws of one spring
in tiny steps, and nothing else.

Nothing here comes from the library. Units: normal lengths in one that the caller chooses, tangential lengths in
mu_0 kappa of it, stiffness in that of the whole row, time in 1/omega. With the operator

    L[x] = x + T x' + sum_j rho_j x_j,    x_j' = x' - x_j/theta_j,

a spring in contact has s = z - gap and presses with p = L[s] >= 0; free, L[s] = 0 until z - gap meets s. Its end is
dragged by e = (e_x, e_y), with the force f = L[e] in each direction and |f| <= p; in stick e' = u', in slip |f| = p and
u' - e' has the direction of f. The body yields by y in each direction, M y'' + C y' + K y = -sum w f.

Backward Euler turns L into a multiple of what it acts on plus something known, so that one line is the law of every
material: the force is what it would be in stick, cut to the length p. The step in which a spring touches is cut in two
at the touch. The body moves by the leap-frog method under the force at the end of the step. All this is of first order.
Three numbers of steps, each twice the one before, are extrapolated, and what they differ by tells how good that is.

One Kelvin spring that moves along its way only is also followed by scipy's solver of differential equations, from one
change of mode to the next: far more exact, and far slower.
"""

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numba import njit
from scipy.integrate import solve_ivp

NEVER = -math.inf  #: of a plane that a spring does not meet
ELASTIC = 0.0, (), ()  #: T, rho, theta


class Row(NamedTuple):
    """Springs."""

    gap: np.ndarray  #: (n,)
    w: np.ndarray  #: (n,), shares of the stiffness


class Material(NamedTuple):
    """The operator L."""

    T: float
    rho: np.ndarray
    theta: np.ndarray


class Motion(NamedTuple):
    """Depth, and way along and across, at equidistant instants of a period with both ends: (steps + 1,)."""

    z: np.ndarray
    u: np.ndarray  #: (2, steps + 1), without the pull
    v: np.ndarray  #: (2,), the pull


class Body(NamedTuple):
    """What yields along and across: arrays (2,); an infinite K does not."""

    M: np.ndarray
    C: np.ndarray
    K: np.ndarray


class State(NamedTuple):
    """Springs and body at an instant; changed in place."""

    x: np.ndarray  #: (3, n): e_x, e_y, s of each spring
    arms: np.ndarray  #: (number of arms, 3, n): the same of its arms
    y: np.ndarray  #: (2,), place of the body
    rate: np.ndarray  #: (2,), half a step later


# --- one spring ---


@njit(nogil=True, error_model="numpy")
def advance(x, arms, i, material, h, plane, du_x, du_y):
    """Forces f_x, f_y, p of spring i at the end of h, where z - gap is `plane`; its top moves by du. Moves it on."""
    # L at the end is stiffness * x + what is known
    T_h, count = material.T / h, material.rho.size
    stiffness, known_x, known_y, known_s = 1.0 + T_h, -T_h * x[0, i], -T_h * x[1, i], -T_h * x[2, i]
    for j in range(count):
        stiff = material.rho[j] / (1.0 + h / material.theta[j])
        stiffness += stiff
        known_x += stiff * (arms[j, 0, i] - x[0, i])
        known_y += stiff * (arms[j, 1, i] - x[1, i])
        known_s += stiff * (arms[j, 2, i] - x[2, i])
    free = -known_s / stiffness
    s = max(plane, free)
    p = stiffness * s + known_s if plane > free else 0.0
    e_x, e_y = x[0, i] + du_x, x[1, i] + du_y
    f_x, f_y = stiffness * e_x + known_x, stiffness * e_y + known_y
    square = f_x * f_x + f_y * f_y
    if square > p * p:
        cut = p / math.sqrt(square)
        f_x, f_y = cut * f_x, cut * f_y
        e_x, e_y = (f_x - known_x) / stiffness, (f_y - known_y) / stiffness
    for j in range(count):
        fade = 1.0 / (1.0 + h / material.theta[j])
        arms[j, 0, i] = fade * (arms[j, 0, i] + e_x - x[0, i])
        arms[j, 1, i] = fade * (arms[j, 1, i] + e_y - x[1, i])
        arms[j, 2, i] = fade * (arms[j, 2, i] + s - x[2, i])
    x[0, i], x[1, i], x[2, i] = e_x, e_y, s
    return f_x, f_y, p


@njit(nogil=True, error_model="numpy")
def time_in_contact(x, arms, i, material, h, plane_0, plane_1):
    """Share of a step after the touch; 1 if spring i does not touch within it. `plane`: z - gap at both ends."""
    s = x[2, i]
    if plane_0 >= s - 1e-13:
        return 1.0  # in contact at the beginning
    stiffness, known = 1.0 + material.T / h, -material.T / h * s
    for j in range(material.rho.size):
        stiff = material.rho[j] / (1.0 + h / material.theta[j])
        stiffness += stiff
        known += stiff * (arms[j, 2, i] - s)
    above = plane_1 + known / stiffness  # z - gap less the free surface, at the end
    return above / (above + s - plane_0) if above > 0.0 else 1.0


# --- the row ---


@njit(nogil=True, error_model="numpy")
def period(row, material, motion, body, state):
    """Mean of sum w f_x, sum w f_y and sum w p over one period; moves the state on by it."""
    gap, w, z, u, x, arms = row.gap, row.w, motion.z, motion.u, state.x, state.arms
    steps = z.size - 1
    h = 2 * math.pi / steps
    total, now, du = np.zeros(3), np.zeros(3), np.zeros(2)
    for k in range(steps):
        z_0, z_1 = z[k], z[k + 1]
        for m in range(2):
            du[m] = motion.v[m] * h + u[m, k + 1] - u[m, k] + h * state.rate[m]
        du_x, du_y = du[0], du[1]
        F_x, F_y, F_z = 0.0, 0.0, 0.0
        for i in range(gap.size):
            after = time_in_contact(x, arms, i, material, h, z_0 - gap[i], z_1 - gap[i])
            if 1e-9 < after < 1 - 1e-9:
                advance(x, arms, i, material, (1 - after) * h, NEVER, 0.0, 0.0)
                f_x, f_y, p = advance(x, arms, i, material, after * h, z_1 - gap[i], after * du_x, after * du_y)
                f_x, f_y, p = after * f_x, after * f_y, after * p
            else:
                f_x, f_y, p = advance(x, arms, i, material, h, z_1 - gap[i], du_x, du_y)
            F_x, F_y, F_z = F_x + w[i] * f_x, F_y + w[i] * f_y, F_z + w[i] * p
        now[0], now[1], now[2] = F_x, F_y, F_z
        for m in range(3):
            total[m] += now[m]
        for m in range(2):
            if math.inf > body.K[m]:
                state.y[m] += h * state.rate[m]
                drag, M = 0.5 * h * body.C[m], body.M[m]
                state.rate[m] = (state.rate[m] * (M - drag) - h * (now[m] + body.K[m] * state.y[m])) / (M + drag)
    return total / steps


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
    u = np.linspace(0, 1, count // (ends.size - 1), endpoint=False)
    edges = np.append(np.concatenate([a + (b - a) * u**2 * (3 - 2 * u) for a, b in pairwise(ends)]), ends[-1])
    mean = size * np.diff(edges ** (n + 1)) / ((n + 1) * np.diff(edges))
    return Row(mean - depth, np.diff(edges))


# --- until it repeats itself ---


class Settled(NamedTuple):
    """Mean forces once they repeat themselves."""

    mean: np.ndarray  #: (2,), along and across, over the mean normal force
    remainder: float  #: what they would still change
    n_periods: int
    state: State


def settled(row, material, motion, body, state, tolerance=1e-9, most=400):
    """March whole periods until three in turn change no mean by more than tolerance."""
    means, changes = [], []
    while len(means) < most:
        f_x, f_y, p = period(row, material, motion, body, state)
        means.append(np.array([f_x, f_y]) / p)
        changes.append(np.abs(means[-1] - means[-2]).max() if len(means) > 1 else math.inf)
        if len(means) > 3 and max(changes[-3:]) < tolerance:
            break
    last, before = max(changes[-3:]), max([*changes[-6:-3], 0.0])
    q = min((last / before) ** (1 / 3), 0.999) if 0 < before < math.inf else 0.5  # by which a change shrinks
    return Settled(means[-1], last * q / (1 - q), len(means), state)


def at_rest(row, material, motion, body):
    """Full slip along the pull, relaxed, and the body where that force leaves it."""
    n, arms = row.gap.size, material.rho.size
    s = np.maximum(motion.z[0] - row.gap, 0.0)
    x = np.stack([math.copysign(1.0, motion.v[0]) * s, np.zeros(n), s])
    y = np.where(np.isinf(body.K), 0.0, -(x[:2] @ row.w) / body.K)
    return State(x, np.zeros((arms, 3, n)), y, np.zeros(2))


def motion_of(z_n, x_n, y_n, v, steps):
    """Motion of harmonics 1, 2, ... given by their complex amplitudes, Re of sum a_n exp(i n t)."""
    phase = 2 * np.pi * np.arange(steps + 1) / steps
    z, x, y = (
        sum(((a * np.exp(1j * (j + 1) * phase)).real for j, a in enumerate(each)), np.zeros(steps + 1))
        for each in (z_n, x_n, y_n)
    )
    return Motion(z, np.stack([x, y]), np.array([v, 0.0] if np.isscalar(v) else v, dtype=float))


def response(material, n):
    """L of exp(i n t), over it."""
    arms = sum(r * 1j * n * t / (1 + 1j * n * t) for r, t in zip(material.rho, material.theta, strict=True))
    return 1 + 1j * n * material.T + arms


def bends(depth, z_n, material):
    """Depths at which the row bends: the least one, that of a spring that never leaves, and the greatest."""
    phase, n = 2 * np.pi * np.arange(4096) / 4096, np.arange(1, len(z_n) + 1)[:, None]
    z = np.array(z_n)[:, None] * np.exp(1j * n * phase)
    p = np.array([response(material, one) for one in n]) * z
    z, p = z.real.sum(axis=0), p.real.sum(axis=0)
    return depth + z.min(), depth + p.min(), depth + z.max()


class Friction(NamedTuple):
    """COF over mu_0."""

    along: float
    across: float
    doubt: float  #: how far either may be off
    n_periods: int  #: at the longest


def friction(
    n,
    depth,
    z_n,
    x_n,
    y_n,
    v,
    material=ELASTIC,
    body=None,
    across=None,
    steps=16384,
    count=128,
    tolerance=1e-9,
    most=400,
):
    """COF over mu_0 along and across, in the state that repeats itself, which is begun with full slip along the pull.

    n, depth: exponent of the shape, infinite for a flat punch, and mean depth. z_n, x_n, y_n: complex amplitudes of
    harmonics 1, 2, ... of depth and motion; of a shaken pulling point, those of the body without friction. v: pull, of
    either sign. material: T, rho, theta. body, across: (M, C, K) along and across the pull, None where nothing yields.
    steps: per period, of the finest of three marches. count: springs; what four times as many would change is found
    with few steps.
    """
    material = Material(float(material[0]), *(np.array(one, dtype=float) for one in material[1:]))
    given = np.array([(1.0, 0.0, math.inf) if one is None else one for one in (body, across)], dtype=float)
    body = Body(*np.ascontiguousarray(given.T))
    parts = bends(depth, z_n, material)

    def march(level, times=1, state=None):
        motion, row = motion_of(z_n, x_n, y_n, v, steps >> level), springs(n, depth, parts, times * count)
        refuse_too_few(steps >> level, material, body, row)
        state = at_rest(row, material, motion, body) if state is None else state
        return settled(row, material, motion, body, state, tolerance, most)

    found = [march(4)]
    for level in (3, 2, 1, 0):  # each begins with what the states before it tend to
        before, last = found[max(-2, -len(found))].state, found[-1].state
        start = State(*(np.array(new + 0.5 * (new - old)) for old, new in zip(before, last, strict=True)))
        found.append(march(level, 1, start))
    means = np.array([one.mean for one in found])
    first = 2 * means[1:] - means[:-1]  # errors of first order gone
    best, last, before = first[-1] + (first[-1] - first[-2]) / 3, first[-1] - first[-2], first[-2] - first[-3]
    doubt = 2 * max(np.abs(last).max(), np.abs(before).max() / 4)
    if not math.isinf(n):
        rows = [means[0], *(march(4, times).mean for times in (2, 4))]
        known = [new + (new - old) / 3 for old, new in pairwise(rows)]  # the middle rule is of second order
        best = best + known[1] - rows[0]
        doubt += max(np.abs(known[1] - known[0]).max(), np.abs(rows[2] - rows[1]).max() / 3)
    doubt += 4 * found[-1].remainder + tolerance
    return Friction(float(best[0]), float(best[1]), float(doubt), max(one.n_periods for one in found))


def refuse_too_few(steps, material, body, row):
    """The leap-frog method needs steps that are short beside the oscillation of the body on springs that stick."""
    h = 2 * math.pi / steps
    for M, C, K in zip(*body, strict=True):
        damping, stiffness = C + material.T * row.w.sum(), K + (1 + material.rho.sum()) * row.w.sum()
        if math.inf > K and h * (damping + 0.5 * h * stiffness) > M:
            raise ValueError(f"M = {M}: {steps} steps are too few for so light a body")


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
