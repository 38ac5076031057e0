"""The independent twin of a contact with a shear strength: springs in tiny steps, in SI, and nothing else.

Nothing here comes from the library. A shape is its profile g = c x**n (Popov and Hess 2015), or a flat face. Springs of
a cell of the width dx at +x and at -x have the stiffness 2 dx E* in the normal direction and 2 dx G* in the plane, with
E* = E/(1 - nu²), G* = 4 G/(2 - nu). With L[q] = q + T q' + sum_j rho_j q_j, q_j' = q' - q_j/theta_j, they bear

    f_z = 2 dx E* L[s],    f = 2 dx G* L[e],    |f| <= mu_0 f_z + 4 tau_0 sqrt(a² - x²) dx,

a the radius of contact: it reaches as far out as springs press. A spring presses from where z - g meets s to where
L[s] = 0. In flight L[s] = L[e] = 0. The body yields by y, m y'' + c y' + k y = -F in each direction.

Backward Euler makes of L a multiple of what it acts on plus something known. A step in which a spring touches or is let
go is cut in two there. The edge lies where a line through the two outermost forces, or through the two next gaps, comes
to zero: the former counts where contact ends, the latter where it begins, and each is too far out where the other
counts. The body moves by the leap-frog method. All this is of first order; three numbers of steps are extrapolated.
"""

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numba import njit

FLAT = math.inf  #: exponent of a flat face
RIGID = (1.0, 0.0, math.inf)  #: m, c, k of what does not yield


class Contact(NamedTuple):
    """What slides, in SI."""

    shape: tuple[float, float]  #: n, c of g = c x**n; FLAT, a of a flat face
    E: float
    nu: float
    tau: float  #: Kelvin time
    arms: tuple[tuple[float, float], ...]  #: modulus and time of each
    mu_0: float
    tau_0: float
    omega: float
    u_z0: float
    du_z: float
    v_0: float
    shake: tuple[complex, complex] = (0.0, 0.0)  #: amplitudes along and across, Re of x exp(i omega t)
    bodies: tuple[tuple[float, float, float], tuple[float, float, float]] = (RIGID, RIGID)  #: m, c, k of each way


def paraboloid(R):
    return 2.0, 1 / R


def cone(theta):
    return 1.0, math.pi / 2 * math.tan(theta)


def fourth_power(c):
    return 4.0, 8 / 3 * c


class Row(NamedTuple):
    """Springs, the last two of them out of reach; the sums over them are those of both sides."""

    x: np.ndarray  #: (n,)
    gap: np.ndarray  #: (n,) profile there
    w: np.ndarray  #: (n,) 2 dx
    flat: float  #: radius of a flat face, else zero
    c: float
    n: float


class Law(NamedTuple):
    """Material and friction; times in 1/omega."""

    E_star: float
    G_star: float
    T: float
    rho: np.ndarray
    theta: np.ndarray
    of_pressure: float  #: extension that the limit bears, over L[s]
    of_radius: float  #: the same, over sqrt(a² - x²)


class Motion(NamedTuple):
    """At equidistant instants of a period with both ends."""

    z: np.ndarray  #: (steps + 1,)
    u: np.ndarray  #: (2, steps + 1), with neither pull nor body
    v: float  #: pull over omega


class Body(NamedTuple):
    """m omega², c omega and k of what yields along and across, (2,) each."""

    M: np.ndarray
    C: np.ndarray
    K: np.ndarray


class State(NamedTuple):
    """Springs and body at an instant; changed in place."""

    q: np.ndarray  #: (1 + J, 3, n): e_x, e_y, s of each spring, then the same of each arm
    p: np.ndarray  #: (n,) L[s] of springs that press, zero of others
    y: np.ndarray  #: (2,)
    rate: np.ndarray  #: (2,), half a step later


# --- one step ---


@njit(nogil=True, error_model="numpy")
def linear(q, m, i, h, law):
    """L at the end of a time h as k q + known: k and known of component m of spring i."""
    k, known = 1 + law.T / h, -law.T / h * q[0, m, i]
    for j in range(law.rho.size):
        stiff = law.rho[j] / (1 + h / law.theta[j])
        k, known = k + stiff, known + stiff * (q[1 + j, m, i] - q[0, m, i])
    return k, known


@njit(nogil=True, error_model="numpy")
def move(q, m, i, h, law, to):
    """Component m of spring i goes there in a time h."""
    for j in range(law.rho.size):
        q[1 + j, m, i] = (q[1 + j, m, i] + to - q[0, m, i]) / (1 + h / law.theta[j])
    q[0, m, i] = to


@njit(nogil=True, error_model="numpy")
def relax(q, m, i, h, law):
    """The same without force."""
    if h > 0:
        k, known = linear(q, m, i, h, law)
        move(q, m, i, h, law, -known / k)


@njit(nogil=True, error_model="numpy")
def press(state, i, z_0, z_1, h, law):
    """Normal motion of spring i, of which z - g goes from z_0 to z_1: when contact begins and when it ends. A spring
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


@njit(nogil=True, error_model="numpy")
def radius(row, state, z, begin):
    """Radius of contact."""
    gap, p, last = row.gap, state.p, row.x.size - 1
    while last >= 0 and p[last] == 0:
        last -= 1
    if last < 0 or row.flat > 0:
        return row.flat if last >= 0 else 0.0
    edge, s = gap[last + 1], state.q[0, 2]
    near, far = s[last + 1] - z + gap[last + 1], s[last + 2] - z + gap[last + 2]
    if far > near:
        edge = min(edge, gap[last + 1] - near * (gap[last + 2] - gap[last + 1]) / (far - near))
    if last > 0 and begin[last] == 0 and begin[last - 1] == 0 and p[last - 1] > p[last]:
        edge = min(edge, gap[last] + p[last] * (gap[last] - gap[last - 1]) / (p[last - 1] - p[last]))
    return (max(edge, gap[last]) / row.c) ** (1 / row.n)


@njit(nogil=True, error_model="numpy")
def rub(q, i, h, law, most, du_x, du_y):
    """Force over stiffness of spring i, in contact for a time h in which its top moves by du; its limit is `most`."""
    k, x = linear(q, 0, i, h, law)
    _, y = linear(q, 1, i, h, law)
    e_x, e_y = q[0, 0, i] + du_x, q[0, 1, i] + du_y
    f_x, f_y = k * e_x + x, k * e_y + y
    size = math.hypot(f_x, f_y)
    if size > most:
        f_x, f_y = f_x * most / size, f_y * most / size
        e_x, e_y = (f_x - x) / k, (f_y - y) / k
    move(q, 0, i, h, law, e_x)
    move(q, 1, i, h, law, e_y)
    return f_x, f_y


@njit(nogil=True, error_model="numpy")
def period(row, law, motion, body, state):
    """Mean F_x, F_y, F_z over a period; moves the state on by it."""
    n, steps, q, p = row.x.size, motion.z.size - 1, state.q, state.p
    h, total, now, du = 2 * math.pi / steps, np.zeros(3), np.zeros(3), np.zeros(2)
    begin, end = np.empty(n), np.empty(n)
    for step in range(steps):
        z_0, z_1 = motion.z[step], motion.z[step + 1]
        for i in range(n):
            begin[i], end[i] = press(state, i, z_0 - row.gap[i], z_1 - row.gap[i], h, law)
        a = radius(row, state, z_1, begin)
        for m in range(2):
            du[m] = motion.u[m, step + 1] - motion.u[m, step] + h * state.rate[m]
        du[0] += motion.v * h
        now[:] = 0.0
        for i in range(n):
            rest, of_step = h - end[i], (end[i] - begin[i]) / h
            for m in range(2):
                relax(q, m, i, begin[i], law)
            if of_step > 0:
                reach = row.flat if rest > 0 else a  # a spring of a round face is let go at the edge
                c = math.sqrt(max(reach * reach - row.x[i] * row.x[i], 0.0))
                most = law.of_pressure * p[i] + law.of_radius * c
                f_x, f_y = rub(q, i, of_step * h, law, most, of_step * du[0], of_step * du[1])
                share = of_step * row.w[i]
                now[0], now[1] = now[0] + share * law.G_star * f_x, now[1] + share * law.G_star * f_y
                now[2] += share * law.E_star * p[i]
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


def law_of(contact):
    E_star = contact.E / (1 - contact.nu**2)
    G_star = 4 * contact.E / (2 * (1 + contact.nu)) / (2 - contact.nu)
    rho, theta = np.array(contact.arms).reshape(-1, 2).T * np.array([[1 / contact.E], [contact.omega]])
    friction = contact.mu_0 * E_star / G_star, 2 * contact.tau_0 / G_star
    return Law(E_star, G_star, contact.tau * contact.omega, rho.copy(), theta.copy(), *friction)


def motion_of(contact, steps):
    phase = 2 * np.pi * np.arange(steps + 1) / steps
    u = np.array([(x * np.exp(1j * phase)).real for x in contact.shake])
    return Motion(contact.u_z0 + contact.du_z * np.cos(phase), u, contact.v_0 / contact.omega)


def body_of(contact):
    omega = contact.omega
    return Body(*np.array([(m * omega**2, c * omega, k) for m, c, k in contact.bodies]).T.copy())


def row_of(contact, law, count):
    """`count` cells, crowded towards the edge where contact is least and greatest, by the middle rule."""
    n, c = contact.shape
    if n == FLAT:
        edges = c * np.sin(np.linspace(0, np.pi / 2, count + 1))
        x = (edges[1:] + edges[:-1]) / 2
        return Row(x, np.zeros(count), 2 * np.diff(edges), c, 1.0, 1.0)
    response = 1 + 1j * law.T + sum(r * 1j * t / (1 + 1j * t) for r, t in zip(law.rho, law.theta, strict=True))
    ends = [contact.u_z0 - contact.du_z * abs(response), contact.u_z0 - contact.du_z, contact.u_z0 + contact.du_z]
    ends = np.unique((np.maximum([0.0, *ends], 0.0) / c) ** (1 / n))
    ends = ends[np.diff(ends, prepend=-1.0) > 1e-6 * ends[-1]]
    part = np.linspace(0, 1, count // (ends.size - 1), endpoint=False)
    edges = np.concatenate([a + (b - a) * part**2 * (3 - 2 * part) for a, b in pairwise(ends)])
    beyond = ends[-1] + (ends[-1] - edges[-1]) * np.arange(3)
    edges = np.append(edges, beyond)
    x = (edges[1:] + edges[:-1]) / 2
    return Row(x, c * x**n, 2 * np.diff(edges), 0.0, c, n)


def full_slip(contact, row, law, body):
    """All springs ahead at their limit of the mean depth, the body where this leaves it."""
    s = np.maximum(contact.u_z0 + contact.du_z - row.gap, 0.0)
    a = row.flat or (max(contact.u_z0, 0.0) / row.c) ** (1 / row.n)
    e = law.of_pressure * np.maximum(contact.u_z0 - row.gap, 0.0)
    e += law.of_radius * np.sqrt(np.maximum(a * a - row.x**2, 0.0))
    q = np.zeros((1 + law.rho.size, 3, row.x.size))
    q[0, 0], q[0, 2] = e, s
    F = law.G_star * float(row.w @ e)
    y = np.array([0.0 if math.isinf(body.K[0]) else -F / body.K[0], 0.0])
    return State(q, np.where(s > 0, s, 0.0), y, np.zeros(2))


# --- until it repeats itself ---


class Settled(NamedTuple):
    """A march that repeats itself."""

    mean: np.ndarray  #: (3,): F_x/F_z, F_y/F_z, F_z
    left: float  #: what the first two would still change
    n_periods: int
    state: State


def settled(row, law, motion, body, state, tolerance, most):
    """March whole periods until three in turn change no mean by more than the tolerance."""
    means, changes = [], [math.inf]
    while len(means) < most and not (len(means) > 3 and max(changes[-3:]) < tolerance):
        F_x, F_y, F_z = period(row, law, motion, body, state)
        means.append(np.array([F_x / F_z, F_y / F_z, F_z]))
        if len(means) > 1:
            changes.append(float(np.abs(means[-1] - means[-2])[:2].max()))
    last, before = max(changes[-3:]), max([*changes[-6:-3], 0.0])
    shrinks = min((last / before) ** (1 / 3), 0.999) if 0 < before < math.inf else 0.5
    return Settled(means[-1], last * shrinks / (1 - shrinks), len(means), state)


class Friction(NamedTuple):
    """Mean forces of a settled period."""

    along: float  #: mean F_x over mean F_z
    across: float  #: mean F_y over mean F_z
    F_z: float  #: [N]
    doubt: float  #: how far along and across may be off
    doubt_F_z: float  #: how far F_z may be off [N]
    n_periods: int  #: at the longest


def friction(contact, steps=8192, count=96, tolerance=1e-8, most=400):
    """Friction of a contact, once it repeats itself, begun ahead of the pull.

    steps: of a period, of the finest of four marches. count: springs; what four times as many change is found with few
    steps.
    """
    law, body = law_of(contact), body_of(contact)

    def march(level, times=1, state=None):
        row, motion = row_of(contact, law, times * count), motion_of(contact, steps >> level)
        refuse_too_few(steps >> level, row, law, body)
        return settled(row, law, motion, body, state or full_slip(contact, row, law, body), tolerance, most)

    found = [march(3)]
    for level in (2, 1, 0):
        found.append(march(level, 1, State(*(one.copy() for one in found[-1].state))))
    means = np.array([one.mean for one in found])
    first = 2 * means[1:] - means[:-1]  # without errors of first order
    last, before = np.abs(np.diff(first, axis=0))[::-1]
    best, doubt = first[-1] + (first[-1] - first[-2]) / 3, 2 * np.maximum(last, before / 4)
    few = np.array([means[0], *(march(3, times).mean for times in (2, 4))])
    known = few[1:] + np.diff(few, axis=0) / 3  # the middle rule is of second order
    best += known[1] - few[0]
    doubt += np.maximum(np.abs(known[1] - known[0]), np.abs(few[2] - few[1]) / 3)
    left = 4 * max(one.left for one in found) + tolerance
    n_periods = max(one.n_periods for one in found)
    return Friction(*best.tolist(), float(doubt[:2].max()) + left, float(doubt[2]), n_periods)


def refuse_too_few(steps, row, law, body):
    """The leap-frog method needs steps that are short beside the oscillation of the body on springs that stick."""
    h, k = 2 * math.pi / steps, law.G_star * row.w.sum()
    for M, C, K in zip(*body, strict=True):
        damping, stiffness = C + law.T * k, K + (1 + law.rho.sum()) * k
        if math.inf > K and h * (damping + 0.5 * h * stiffness) > M:
            raise ValueError(f"m omega² = {M} N/m: {steps} steps are too few for so light a body")
