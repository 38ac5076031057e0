"""The independent twin of a rigid pull: friction of an oscillating contact, written from the physics alone.

Nothing here comes from the library. Normal lengths are measured in du_z, tangential lengths in mu_0 kappa du_z, time in
1/omega, normal forces in 2 E* a(u_z0) du_z, friction in mu_0 times that. Then

    n              shape: profile g ~ x**n, so contact radius a(d) ~ d**(1/n); inf is the flat punch
    depth_ratio    u_z0 / du_z, above -1 (the depth is depth_ratio + cos t)
    v_hat          v_0 / (mu_0 kappa omega du_z), above 0
    T              omega tau of the Kelvin element; 0 is the elastic one
    h              (u_z0 - g) / du_z of one spring, whose indentation is w(t) = h + cos t

One spring. Normal compression s(t) = max(0, sup over theta >= 0 of w(t - theta) exp(-theta / T)), normal force
N = s + T s' in contact and 0 in free flight; shear e with |e + T e'| <= N, where e' = u_x' in stick and equality holds
in slip. Over a period <N> = <s>, so an elastic rigid pull has COF / mu_0 = 1 - <s - e> / <s>, summed over the springs.
"""

import math
from itertools import pairwise

import numpy as np

TWO_PI = 2 * np.pi


# --- tools --------------------------------------------------------------------------------------------------


def bracketed_root(f, low, high):
    """Roots of the array function f, which changes sign between low and high, element by element, by bisection.

    Where rounding leaves f one sign at both ends it is the lower one.
    """
    low, high = (np.array(end, dtype=float) for end in np.broadcast_arrays(low, high))
    after = f(high) < 0
    for _ in range(60):  # to the last digit of a phase
        middle = (low + high) / 2
        beyond = (f(middle) < 0) == after
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    return (low + high) / 2


def gauss_panels(breaks, n_nodes):
    """Gauss nodes and weights on the panels between breaks, crowded to every break.

    x = a + (b - a) u**2 (3 - 2 u) turns a square root at either end of a panel into a smooth function of u.
    """
    z, w = np.polynomial.legendre.leggauss(n_nodes)
    u, w = (z + 1) / 2, w / 2
    a, b = np.asarray(breaks)[:-1, None], np.asarray(breaks)[1:, None]
    return (a + (b - a) * u**2 * (3 - 2 * u)).ravel(), ((b - a) * 6 * u * (1 - u) * w).ravel()


def graded(breaks, ratio, levels):
    """Breaks with geometrically shrinking panels added at both ends of every panel."""
    shrink = ratio ** np.arange(1, levels + 1)
    out = [np.asarray(breaks)]
    for a, b in pairwise(breaks):
        out += [a + (b - a) * shrink, b - (b - a) * shrink]
    return np.unique(np.concatenate(out))


def springs(n, depth_ratio, breaks_h, n_nodes, ratio=0.1, levels=0, reference_depth=None):
    """Springs of a power-law indenter: their h and stiffness share dx / a(reference depth).

    breaks_h lists values of h at which the behaviour of a spring changes; the array ends at h = -1, the
    spring that is just touched at the deepest point. Both are (n_springs,); springs at x and -x are counted
    together.
    """
    if depth_ratio <= -1:
        raise ValueError(f"depth_ratio = {depth_ratio}: the indenter never touches")
    if math.isinf(n):
        return np.array([float(depth_ratio)]), np.array([1.0])
    inside = [h for h in breaks_h if -1 < h < depth_ratio]
    ends = graded(np.unique([-1.0, *inside, float(depth_ratio)]), ratio, levels)
    reach = depth_ratio + 1.0
    breaks_x = np.sort(((depth_ratio - ends) / reach) ** (1 / n))
    x, dx = gauss_panels(breaks_x, n_nodes)
    reference = depth_ratio if reference_depth is None else reference_depth
    x_ref = (reference / reach) ** (1 / n) if reference > 0 else 1.0
    return depth_ratio - reach * x**n, dx / x_ref


# --- normal motion of one spring ----------------------------------------------------------------------------


def always_touches(h, T):
    """Whether a spring never leaves the plane: N = h + cos t - T sin t >= 0 throughout."""
    return np.asarray(h) >= math.hypot(1, T)


def contact_times(h, T):
    """Touch and loss of contact, (t_on, t_off) with t_on < t_off < t_on + 2 pi, for -1 < h < sqrt(1 + T**2).

    Contact is lost where N = w + T w' falls to 0; it returns where w meets the surface that relaxes as
    exp(-t / T). W = w exp(t / T) falls between the zeros of N and rises after, so that root is bracketed.
    Springs that always touch are given the span [0, 2 pi].
    """
    h = np.atleast_1d(np.asarray(h, dtype=float))
    root, delta = math.hypot(1, T), math.atan(T)
    phase = np.arccos(np.clip(-h / root, -1, 1))
    off, rising = phase - delta, TWO_PI - phase - delta
    on = rising
    if T > 0:
        w_off = h + np.cos(off)
        on = bracketed_root(lambda t: h + np.cos(t) - w_off * np.exp(-(t - off) / T), rising, off + TWO_PI)
    always = always_touches(h, T)
    return np.where(always, 0.0, on), np.where(always, TWO_PI, off + TWO_PI)


def mean_compression(h, T):
    """<s> over a period, which is also the mean normal force of the spring."""
    h = np.atleast_1d(np.asarray(h, dtype=float))
    on, off = contact_times(h, T)
    touching = h * (off - on) + np.sin(off) - np.sin(on)
    flying = T * (np.cos(off) - np.cos(on))  # decay from s(t_off) to s(t_on)
    return (touching + flying) / TWO_PI


# --- rigid pull, elastic ------------------------------------------------------------------------------------


def elastic_stick(h, v_hat):
    """Stick interval (t_a, t_b) of an elastic spring under a rigid pull; t_a = t_b where it only slips.

    In forward slip e = s, so stick starts where s' = -sin t grows past v_hat, or at first touch if s' is
    already larger there. It ends where e = e_a + v_hat (t - t_a) meets s again.
    """
    h = np.atleast_1d(np.asarray(h, dtype=float))
    on, off = contact_times(h, 0.0)
    if v_hat >= 1:
        return on, on
    steep, flat = np.pi + math.asin(v_hat), TWO_PI - math.asin(v_hat)  # s' > v_hat between these
    start = np.where(always_touches(h, 0.0), steep, np.maximum(on, steep))
    end = np.where(always_touches(h, 0.0), steep + TWO_PI, np.minimum(off, steep + TWO_PI))
    sticks = start < flat
    stop = bracketed_root(lambda t: np.cos(t) - np.cos(start) - v_hat * (t - start), np.minimum(flat, end), end)
    return start, np.where(sticks, stop, start)


def elastic_lag(h, v_hat):
    """<s - e> of an elastic spring under a rigid pull, in closed form between its two events."""
    start, stop = elastic_stick(h, v_hat)
    span = stop - start
    lag = np.sin(stop) - np.sin(start) - np.cos(start) * span - v_hat * span**2 / 2
    return lag / TWO_PI


def elastic_shear_by_definition(h, v_hat, t, n_theta=200_000):
    """The shear e(t) = inf over theta >= 0 of [s(t - theta) + v_hat theta], by brute force."""
    theta = np.linspace(0, TWO_PI, n_theta)
    return np.array([np.min(np.maximum(h + np.cos(ti - theta), 0) + v_hat * theta) for ti in t])


def rigid_elastic_cof(n, depth_ratio, v_hat, n_nodes=40, levels=2):
    """COF / mu_0 of an elastic power-law indenter under a rigid pull, v_hat > 0.

    Panels are split at h = 1 (contact is lost below) and at h = +-sqrt(1 - v_hat**2) (stick from first
    touch between them, none below, after the start of stick above).
    """
    edge = math.sqrt(max(1 - v_hat**2, 0))
    h, dx = springs(n, depth_ratio, [-edge, 0.0, edge, 1.0], n_nodes, levels=levels)
    return 1 - (elastic_lag(h, v_hat) @ dx) / (mean_compression(h, 0.0) @ dx)


def flat_punch_deficit(v_hat):
    """psi(v_hat) of a flat punch that never leaves the plane: COF / mu_0 = 1 - psi / depth_ratio."""
    return float(elastic_lag(2.0, v_hat)[0])


# --- full slip of the whole array ---------------------------------------------------------------------------


def mean_force(n, depth_ratio, T, reference_depth=None):
    """Mean normal force over a period, from the mean compression of every spring."""
    h, dx = springs(n, depth_ratio, [math.hypot(1, T)], 40, levels=4, reference_depth=reference_depth)
    return float(mean_compression(h, T) @ dx)


# --- spring pull: twins/turning.py has all but a body without mass --------------------------------------


def damping_for(zeta, k_ratio, omega_0_ratio):
    """The c_ratio that gives the damping ratio zeta = c_x / (2 sqrt(k_x m))."""
    return 2 * zeta * k_ratio / omega_0_ratio


def massless_punch(depth, v, T, k, n, n_periods=12):
    """COF over mu_0 of one Kelvin spring under a body without mass on a spring k, by n implicit steps of first order.

    depth: u_z0/du_z; v: over Eq. (1); k: over that of the contact. In units where mu_0, kappa and stiffness are one.
    """
    h, s, e, y = 2 * math.pi / n, 0.0, 0.0, 0.0
    decay, held = math.exp(-h / T), k + 1 + T / h
    for _ in range(n_periods):
        sum_x = sum_z = 0.0
        for i in range(1, n + 1):
            z, free = depth + math.cos(i * h), s * decay
            s, before = max(z, free), s
            f_z = max(s + T * (s - before) / h, 0.0) if s > free else 0.0
            moved = v * h - y
            f_x = k * ((1 + T / h) * (e + moved) - T / h * e) / held  # sticks: k y = -f_x
            f_x = min(max(f_x, -f_z), f_z)
            y, e = -f_x / k, (f_x + T / h * e) / (1 + T / h)
            sum_x, sum_z = sum_x + f_x, sum_z + f_z
    return sum_x / sum_z
