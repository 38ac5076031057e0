"""Springs and a body in tiny steps, until they repeat themselves: what the twins turning.py and strength.py march.

Nothing here comes from the library. Time is in 1/omega, and forces are over the stiffness, that of the body too. With

    L[x] = x + T x' + sum_j rho_j x_j,    x_j' = x' - x_j/theta_j,

a spring presses with p = L[s] from where z - gap meets s to where L[s] = 0. In flight L[s] = L[e] = 0. Its end is
dragged by e = (e_x, e_y), with the force f = L[e] in each direction and

    |f| <= most = of_pressure p + of_radius sqrt(a² - x²),

a the radius of contact: it reaches as far out as springs press. In stick e' = u', in slip |f| is the most, and u' - e'
has the direction of f. The body yields by y in each direction, M y'' + C y' + K y = -sum w f.

Backward Euler makes of L a multiple of what it acts on plus something known, so that one line is the law of every
material: the force is what it would be in stick, cut to the most. A step in which a spring touches or is let go is cut
in two there. The edge of contact lies where a line through the two outermost forces, or through the two next gaps,
comes to zero: the former counts where contact ends, the latter where it begins, and each is too far out where the other
counts. The body moves by the leap-frog method under the force at the end of the step. All this is of first order.
Numbers of steps, each twice the one before, are extrapolated, and what they differ by tells how good that is.
"""

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numba import njit

TOLERANCE, MOST = 1e-9, 400  #: change of a mean over a period that is none; periods at most
COARSEST = 3  #: halvings of the number of steps that a march begins with

_inline = njit(error_model="numpy", forceinline=True)


class Row(NamedTuple):
    """Springs; where friction has a strength, the last two of them are out of reach."""

    gap: np.ndarray  #: (n,)
    w: np.ndarray  #: (n,) their stiffness
    x: np.ndarray = np.zeros(0)  #: (n,) their places; none where friction has no strength
    depths: np.ndarray = np.zeros(1)  #: ascending, at which the radius of contact is known; one of a face with a rim
    radii: np.ndarray = np.zeros(1)  #: these radii; the first is that of a level part, or of a tip, or of the rim


class Law(NamedTuple):
    """The operator L, and friction."""

    T: float
    rho: np.ndarray
    theta: np.ndarray
    of_pressure: float = 1.0
    of_radius: float = 0.0


class Motion(NamedTuple):
    """Depth, and way along and across, at equidistant instants of a period with both ends: (steps + 1,)."""

    z: np.ndarray
    u: np.ndarray  #: (2, steps + 1), with neither pull nor body
    v: np.ndarray  #: (2,), the pull


class Body(NamedTuple):
    """What yields along and across: arrays (2,); an infinite K does not."""

    M: np.ndarray
    C: np.ndarray
    K: np.ndarray


class State(NamedTuple):
    """Springs and body at an instant; changed in place."""

    q: np.ndarray  #: (1 + J, 3, n): e_x, e_y, s of each spring, then the same of each arm
    p: np.ndarray  #: (n,) L[s] of springs that press, zero of others
    y: np.ndarray  #: (2,), place of the body
    rate: np.ndarray  #: (2,), half a step later


# --- one step ---


@_inline
def linear(q, m, i, h, law):
    """L at the end of a time h as k q + known: k and known of component m of spring i."""
    k, known = 1 + law.T / h, -law.T / h * q[0, m, i]
    for j in range(law.rho.size):
        stiff = law.rho[j] / (1 + h / law.theta[j])
        k, known = k + stiff, known + stiff * (q[1 + j, m, i] - q[0, m, i])
    return k, known


@_inline
def move(q, m, i, h, law, to):
    """Component m of spring i goes there in a time h."""
    for j in range(law.rho.size):
        q[1 + j, m, i] = (q[1 + j, m, i] + to - q[0, m, i]) / (1 + h / law.theta[j])
    q[0, m, i] = to


@_inline
def relax(q, m, i, h, law):
    """The same without force."""
    if h > 0:
        k, known = linear(q, m, i, h, law)
        move(q, m, i, h, law, -known / k)


@_inline
def press(state, i, z_0, z_1, h, law):
    """Normal motion of spring i, of which z - gap goes from z_0 to z_1: when contact begins and when it ends. A spring
    that is not in contact at all begins at h.
    """
    q, p = state.q, state.p
    k, known = linear(q, 2, i, h, law)
    force, begin, end = k * z_1 + known, 0.0, h
    if p[i] > 0 and force > 0:
        move(q, 2, i, h, law, z_1)
        p[i] = force
    elif p[i] > 0:
        end = h * p[i] / (p[i] - force)
        if end > 0:
            move(q, 2, i, end, law, z_0 + (z_1 - z_0) * end / h)
        relax(q, 2, i, h - end, law)
        p[i] = 0.0
    elif force > 0:
        above, below = force / k, max(q[0, 2, i] - z_0, 0.0)
        begin = min(h * below / (above + below), (1 - 1e-9) * h)
        relax(q, 2, i, begin, law)
        k, known = linear(q, 2, i, h - begin, law)
        p[i] = max(k * z_1 + known, 0.0)
        move(q, 2, i, h - begin, law, z_1)
    else:
        begin = h
        relax(q, 2, i, h, law)
    return begin, end


@_inline
def radius(row, state, z, begin):
    """Radius of contact."""
    gap, p, last = row.gap, state.p, row.gap.size - 1
    while last >= 0 and p[last] == 0:
        last -= 1
    if last < 0 or row.depths.size == 1:
        return row.radii[0] if last >= 0 else 0.0
    edge, s = gap[last + 1], state.q[0, 2]
    near, far = s[last + 1] - z + gap[last + 1], s[last + 2] - z + gap[last + 2]
    if far > near:
        edge = min(edge, gap[last + 1] - near * (gap[last + 2] - gap[last + 1]) / (far - near))
    if last > 0 and begin[last] == 0 and begin[last - 1] == 0 and p[last - 1] > p[last]:
        edge = min(edge, gap[last] + p[last] * (gap[last] - gap[last - 1]) / (p[last - 1] - p[last]))
    edge = max(edge, gap[last])
    k = min(max(np.searchsorted(row.depths, edge), 1), row.depths.size - 1)
    d_0, d_1, a_0, a_1 = row.depths[k - 1], row.depths[k], row.radii[k - 1], row.radii[k]
    return a_0 + (a_1 - a_0) * (edge - d_0) / (d_1 - d_0)


@_inline
def rub(q, i, h, law, most, du_x, du_y):
    """Force over stiffness of spring i, in contact for a time h in which its top moves by du."""
    k, x = linear(q, 0, i, h, law)
    _, y = linear(q, 1, i, h, law)
    e_x, e_y = q[0, 0, i] + du_x, q[0, 1, i] + du_y
    f_x, f_y = k * e_x + x, k * e_y + y
    size = math.sqrt(f_x * f_x + f_y * f_y)
    if size > most:
        f_x, f_y = f_x * most / size, f_y * most / size
        e_x, e_y = (f_x - x) / k, (f_y - y) / k
    move(q, 0, i, h, law, e_x)
    move(q, 1, i, h, law, e_y)
    return f_x, f_y


@njit(nogil=True, error_model="numpy")
def period(row, law, motion, body, state):
    """Mean of sum w f_x, sum w f_y and sum w p over a period; moves the state on by it."""
    n, steps, q, p = row.gap.size, motion.z.size - 1, state.q, state.p
    h, total, now, du = 2 * math.pi / steps, np.zeros(3), np.zeros(3), np.zeros(2)
    begin, end, a = np.empty(n), np.empty(n), 0.0
    for step in range(steps):
        z_0, z_1 = motion.z[step], motion.z[step + 1]
        for i in range(n):
            begin[i], end[i] = press(state, i, z_0 - row.gap[i], z_1 - row.gap[i], h, law)
        if law.of_radius > 0:
            a = radius(row, state, z_1, begin)
        for m in range(2):
            du[m] = motion.v[m] * h + motion.u[m, step + 1] - motion.u[m, step] + h * state.rate[m]
        now[:] = 0.0
        for i in range(n):
            rest, of_step = h - end[i], (end[i] - begin[i]) / h
            for m in range(2):
                relax(q, m, i, begin[i], law)
            if of_step > 0:
                most = law.of_pressure * p[i]
                if law.of_radius > 0:
                    reach = max(a, row.radii[0]) if rest > 0 else a  # a spring of a round face is let go at the edge
                    most += law.of_radius * math.sqrt(max(reach**2 - row.x[i] ** 2, 0.0))
                f_x, f_y = rub(q, i, of_step * h, law, most, of_step * du[0], of_step * du[1])
                share = of_step * row.w[i]
                now[0], now[1], now[2] = now[0] + share * f_x, now[1] + share * f_y, now[2] + share * p[i]
            if rest > 0:
                for m in range(2):
                    relax(q, m, i, rest, law)
        total += now
        for m in range(2):
            if body.K[m] < math.inf:
                state.y[m] += h * state.rate[m]
                drag, M = 0.5 * h * body.C[m], body.M[m]
                state.rate[m] = (state.rate[m] * (M - drag) - h * (now[m] + body.K[m] * state.y[m])) / (M + drag)
    return total / steps


# --- the parts of a contact ---


def crowded(ends, count):
    """Edges of `count` cells in all, in each part between ends crowded towards both of these."""
    u = np.linspace(0, 1, count // (ends.size - 1), endpoint=False)
    return np.append(np.concatenate([a + (b - a) * u**2 * (3 - 2 * u) for a, b in pairwise(ends)]), ends[-1])


def response(law, n):
    """L of exp(i n t), over it."""
    arms = sum(r * 1j * n * t / (1 + 1j * n * t) for r, t in zip(law.rho, law.theta, strict=True))
    return 1 + 1j * n * law.T + arms


def motion_of(z_n, x_n, y_n, v, steps):
    """Motion of harmonics 1, 2, ... given by their complex amplitudes, Re of sum a_n exp(i n t)."""
    phase = 2 * np.pi * np.arange(steps + 1) / steps
    z, x, y = (
        sum(((a * np.exp(1j * (j + 1) * phase)).real for j, a in enumerate(each)), np.zeros(steps + 1))
        for each in (z_n, x_n, y_n)
    )
    return Motion(z, np.stack([x, y]), np.array([v, 0.0] if np.isscalar(v) else v, dtype=float))


def pulled(row, law, body, s, e):
    """Springs with these compressions, and extensions along the pull, relaxed; and the body where these leave it."""
    q = np.zeros((1 + law.rho.size, 3, row.gap.size))
    q[0, 0], q[0, 2] = e, s
    return State(q, s.copy(), np.array([-row.w @ e, 0.0]) / body.K, np.zeros(2))


# --- until it repeats itself ---


class Settled(NamedTuple):
    """A march that repeats itself."""

    mean: np.ndarray  #: (2,) sums of w f over that of w p, along and across
    left: float  #: what they would still change
    state: State


def settled(row, law, motion, body, state):
    """March whole periods until three in turn change no mean by more than TOLERANCE."""
    means, changes = [], [math.inf]
    while len(means) < MOST and not (len(means) > 3 and max(changes[-3:]) < TOLERANCE):
        *forces, p = period(row, law, motion, body, state)
        means.append(np.array(forces) / p)
        if len(means) > 1:
            changes.append(float(np.abs(means[-1] - means[-2]).max()))
    last, before = max(changes[-3:]), max([*changes[-6:-3], 0.0])
    shrinks = min((last / before) ** (1 / 3), 0.999) if 0 < before < math.inf else 0.5
    return Settled(means[-1], last * shrinks / (1 - shrinks), state)


class Friction(NamedTuple):
    """Mean forces over the mean normal force, in the state that repeats itself."""

    along: float
    across: float
    doubt: float  #: how far either may be off


def friction(law, body, row_of, motion_in, begun, steps, count):
    """Friction of a contact, in the state that repeats itself.

    row_of: the springs of so many cells. motion_in: the motion in so many steps. begun: the state to begin with, of
    row, law, motion and body. steps: of a period, of the finest of four marches. count: springs; what four times as
    many change is found with few steps.
    """

    def march(level, times=1, state=None):
        row, motion = row_of(times * count), motion_in(steps >> level)
        refuse_too_few(steps >> level, row, law, body)
        return settled(row, law, motion, body, state or begun(row, law, motion, body))

    found = [march(COARSEST)]
    for level in reversed(range(COARSEST)):  # each begins with what the states before it tend to
        before, last = found[max(-2, -len(found))].state, found[-1].state
        start = State(*(np.array(new + 0.5 * (new - old)) for old, new in zip(before, last, strict=True)))
        found.append(march(level, 1, start))
    means = np.array([one.mean for one in found])
    first = 2 * means[1:] - means[:-1]  # without errors of first order
    before, last = np.abs(np.diff(first, axis=0))[-2:]
    best, doubt = first[-1] + (first[-1] - first[-2]) / 3, 2 * np.maximum(last, before / 4)
    few = np.array([means[0], *(march(COARSEST, times).mean for times in (2, 4))])
    known = few[1:] + np.diff(few, axis=0) / 3  # the middle rule is of second order
    best += known[1] - few[0]
    doubt += np.maximum(np.abs(known[1] - known[0]), np.abs(few[2] - few[1]) / 3)
    left = 4 * max(one.left for one in found) + TOLERANCE
    return Friction(*best.tolist(), float(doubt.max()) + left)


def refuse_too_few(steps, row, law, body):
    """The leap-frog method needs steps that are short beside the oscillation of the body on springs that stick."""
    h, k = 2 * math.pi / steps, row.w.sum()
    for M, C, K in zip(*body, strict=True):
        damping, stiffness = C + law.T * k, K + (1 + law.rho.sum()) * k
        if math.inf > K and h * (damping + 0.5 * h * stiffness) > M:
            raise ValueError(f"M = {M}: {steps} steps are too few for so light a body")
