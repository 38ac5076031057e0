"""The independent twin: friction of an oscillating contact, written from the physics alone.

Nothing here comes from the library. It is slow, it has no options but the
physics, and its schemes differ from the library's march wherever another scheme exists.

Units. Normal lengths are measured in du_z, tangential lengths in mu_0 kappa du_z, time in 1/omega,
tangential stiffness in k_xc0 = 2 G* a(u_z0), normal forces in 2 E* a(u_z0) du_z, friction in mu_0 times
that. Then

    n              shape: profile g ~ x**n, so contact radius a(d) ~ d**(1/n); inf is the flat punch
    depth_ratio    u_z0 / du_z, above -1 (the depth is depth_ratio + cos t)
    v_hat          v_0 / (mu_0 kappa omega du_z), above 0
    T              omega tau of the Kelvin element; 0 is the elastic one
    k_ratio        k_x / k_xc0
    omega_0_ratio  omega_0 / omega with omega_0**2 = k_x / m
    c_ratio        c_x omega / k_xc0
    h              (u_z0 - g) / du_z of one spring, whose indentation is w(t) = h + cos t

One spring. Normal compression s(t) = max(0, sup over theta >= 0 of w(t - theta) exp(-theta / T)), normal
force N = s + T s' in contact and 0 in free flight; shear e with |e + T e'| <= N, where e' = u_x' in stick
and equality holds in slip. Over a period <e + T e'> = <e> and <N> = <s>, so a rigid pull has COF / mu_0 = 1
- <s - e> / <s>, summed over the springs.
"""

import math
from functools import lru_cache
from itertools import pairwise

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import expm
from scipy.optimize import brentq, minimize_scalar

TWO_PI = 2 * np.pi


# --- tools --------------------------------------------------------------------------------------------------


def bracketed_root(f, low, high, tol=4e-16, max_steps=80):
    """Roots of the array function f, which changes sign between low and high, element by element.

    Chandrupatla (1997): inverse quadratic interpolation where it is safe, bisection elsewhere. Where f has
    one sign at both ends the answer is meaningless and the caller discards it.
    """
    a, b = (np.array(end, dtype=float) for end in np.broadcast_arrays(high, low))
    fa, fb = f(a), f(b)
    one_sign = np.sign(fa) * np.sign(fb) > 0
    c, fc, t = a.copy(), fa.copy(), np.full(a.shape, 0.5)
    for _ in range(max_steps):
        x = a + t * (b - a)
        fx = f(x)
        same = np.sign(fx) == np.sign(fa)
        c, fc = np.where(same, a, b), np.where(same, fa, fb)
        b, fb = np.where(same, b, a), np.where(same, fb, fa)
        a, fa = x, fx
        best = np.where(np.abs(fa) < np.abs(fb), a, b)
        smallest = tol * (1 + np.abs(best))
        width = np.abs(b - a)
        if np.all((width <= 2 * smallest) | (fa == 0) | (fb == 0) | one_sign):
            break
        with np.errstate(all="ignore"):
            xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
            smooth = (phi**2 < xi) & ((1 - phi) ** 2 < 1 - xi)
            step = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
            t = np.where(smooth & np.isfinite(step), step, 0.5)
            edge = np.where(width > 0, np.minimum(smallest / width, 0.5), 0.5)
        t = np.clip(t, edge, 1 - edge)
    return np.where(np.abs(fa) < np.abs(fb), a, b)


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


@lru_cache
def tip_times(depth_ratio, T):
    """Touch and loss of contact of the tip, as numbers."""
    on, off = contact_times([depth_ratio], T)
    return float(on[0]), float(off[0])


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
    phi_1 = np.pi + math.asin(v_hat)
    phi_2 = brentq(
        lambda t: math.cos(phi_1) - math.cos(t) + v_hat * (t - phi_1),
        TWO_PI - math.asin(v_hat),
        phi_1 + TWO_PI,
        xtol=1e-15,
    )
    span = phi_2 - phi_1
    return (math.sin(phi_2) - math.sin(phi_1) - math.cos(phi_1) * span - v_hat * span**2 / 2) / TWO_PI


# --- rigid pull, Kelvin -------------------------------------------------------------------------------------


def kelvin_lag(h, v_hat, T):
    """<p> of Kelvin springs under a rigid pull, p = s - e, and the kind of their motion (a small integer).

    e + T e' <= s + T s' is p' >= -p / T, so p' = max(s' - v_hat, -p / T) in contact and p' = -p / T in
    flight. Stick is D > 0, D = s' - v_hat + p / T. In contact s' = -sin t, and in stick and in slip alike D
    rises exactly where sin t + T cos t < -v_hat, i.e. between the angles t_1 and t_2. So every change of
    mode is bracketed:

        until t_1: D falls (stick may end);  t_1 to t_2: D rises (stick may begin);  after t_2: D falls.

    The period map of p is monotone and does not expand distances, and 0 <= p <= s, so its fixed point is
    bracketed.
    """
    h = np.atleast_1d(np.asarray(h, dtype=float))
    if v_hat >= 1:
        return np.zeros_like(h), np.zeros(h.shape, dtype=int)
    root, delta = math.hypot(1, T), math.atan(T)
    t_1, t_2 = np.pi + math.asin(v_hat / root) - delta, TWO_PI - math.asin(v_hat / root) - delta
    on, off = contact_times(h, T)
    always = always_touches(h, T)
    on, off = np.where(always, t_1, on), np.where(always, t_1 + TWO_PI, off)

    def slip(t_0, p_0, t):
        return p_0 * np.exp(-(t - t_0) / T)

    def stick(t_0, p_0, t):
        return p_0 + np.cos(t) - np.cos(t_0) - v_hat * (t - t_0)

    def stick_area(t_0, p_0, t):
        dt = t - t_0
        return np.sin(t) - np.sin(t_0) + (p_0 - np.cos(t_0)) * dt - v_hat * dt**2 / 2

    def drive(t, p):
        return -np.sin(t) - v_hat + p / T

    def falling(t_0, p_0, t_end):
        """From t_0 to t_end while D falls: stick as long as D > 0, then slip."""
        sticks = drive(t_0, p_0) > 0
        still = drive(t_end, stick(t_0, p_0, t_end)) > 0
        change = bracketed_root(lambda t: drive(t, stick(t_0, p_0, t)), t_0, t_end)
        change = np.where(sticks, np.where(still, t_end, change), t_0)
        p = stick(t_0, p_0, change)
        p_end = slip(change, p, t_end)
        return p_end, stick_area(t_0, p_0, change) + T * (p - p_end), sticks & (t_end > t_0)

    def rising(t_0, p_0, t_end):
        """From t_0 to t_end while D rises: slip as long as D < 0, then stick."""
        slips = drive(t_0, p_0) <= 0
        still = drive(t_end, slip(t_0, p_0, t_end)) <= 0
        change = bracketed_root(lambda t: drive(t, slip(t_0, p_0, t)), t_0, t_end)
        change = np.where(slips, np.where(still, t_end, change), t_0)
        p = slip(t_0, p_0, change)
        p_end = stick(change, p, t_end)
        began = np.where(slips & ~still, 1, np.where(~slips, 2, 0)) * (t_end > t_0)
        return p_end, T * (p_0 - p) + stick_area(change, p, t_end), began

    def period(p_0):
        first, second = np.clip(t_1, on, off), np.clip(t_2, on, off)
        p_1, area_1, early = falling(on, p_0, first)
        p_2, area_2, began = rising(first, p_1, second)
        p_3, area_3, late = falling(second, p_2, off)
        p_4 = slip(off, p_3, on + TWO_PI)
        return p_4, area_1 + area_2 + area_3 + T * (p_3 - p_4), early + 2 * began + 6 * late

    p_start = bracketed_root(lambda p: period(p)[0] - p, np.zeros_like(h), h + np.cos(on))
    _, area, kind = period(p_start)
    return area / TWO_PI, np.where(always, 100, kind)


@lru_cache
def kelvin_breaks(depth_ratio, v_hat, T, n_scan=600):
    """Values of h at which the kind of motion of a Kelvin spring changes: a scan, then finer ones."""
    top = min(depth_ratio, math.hypot(1, T))
    u = (1 - np.cos(np.pi * np.arange(1, n_scan) / n_scan)) / 2
    h = -1 + (top + 1) * u
    kind = kelvin_lag(h, v_hat, T)[1]
    at = np.flatnonzero(kind[1:] != kind[:-1])
    low, high, kind_low = h[at], h[at + 1], kind[at]
    for _ in range(3 if at.size else 0):  # to 1e-8: a misplaced break costs its square
        inner = low + (high - low) * np.arange(1, 64)[:, None] / 64
        same = (kelvin_lag(inner.ravel(), v_hat, T)[1].reshape(inner.shape) == kind_low).cumprod(axis=0).sum(axis=0)
        low, high = low + (high - low) * same / 64, low + (high - low) * (same + 1) / 64
    return (*low, math.hypot(1, T))


def rigid_kelvin_cof(n, depth_ratio, v_hat, T, n_nodes=20, levels=5):
    """COF / mu_0 of a Kelvin power-law indenter under a rigid pull, v_hat > 0, T > 0."""
    breaks = [] if math.isinf(n) else kelvin_breaks(depth_ratio, v_hat, T)
    h, dx = springs(n, depth_ratio, breaks, n_nodes, levels=levels)
    return 1 - (kelvin_lag(h, v_hat, T)[0] @ dx) / (mean_compression(h, T) @ dx)


# --- full slip of the whole array ---------------------------------------------------------------------------


def edge_of_contact(t, T):
    """The h of the spring at the edge of contact at time t (springs of larger h touch).

    Springs leave from the edge inwards while w + T w' of the edge spring is 0, until t = pi - arctan T;
    then they come back from the inside out, each on the surface that relaxed since it left.
    """
    t = t % TWO_PI
    root, delta = math.hypot(1, T), math.atan(T)
    if T == 0:
        return -math.cos(t)
    if t <= np.pi - delta:
        return -(math.cos(t) - T * math.sin(t))

    def above_surface(h):
        off = math.acos(max(-1.0, min(1.0, -h / root))) - delta
        return h + math.cos(t) - (h + math.cos(off)) * math.exp(-(t - off) / T)

    low, high = -1.0, root
    if above_surface(low) >= 0:
        return low
    if above_surface(high) <= 0:
        return high
    return brentq(above_surface, low, high, xtol=1e-15)


def full_slip_force(t, n, depth_ratio, T, reference_depth=None):
    """Normal force of the whole array at times t, in units where dF/dd = 1 at the reference depth (u_z0)."""
    t = np.atleast_1d(np.asarray(t, dtype=float))
    reference = depth_ratio if reference_depth is None else reference_depth
    load = depth_ratio + np.cos(t) - T * np.sin(t)  # w + T w' at the tip
    if math.isinf(n):
        on, off = tip_times(depth_ratio, T)
        touching = ((t - on) % TWO_PI <= off - on) | always_touches(depth_ratio, T)
        return np.where(touching, np.maximum(load, 0), 0.0)
    edge = np.array([edge_of_contact(ti, T) for ti in t])
    depth_of_edge = np.maximum(depth_ratio - edge, 0)  # g at the edge
    x = (depth_of_edge / reference) ** (1 / n) if reference > 0 else depth_of_edge ** (1 / n)
    return np.maximum(x * (load - depth_of_edge / (n + 1)), 0)


def mean_force(n, depth_ratio, T, reference_depth=None):
    """Mean normal force over a period, from the mean compression of every spring."""
    h, dx = springs(n, depth_ratio, [math.hypot(1, T)], 40, levels=4, reference_depth=reference_depth)
    return float(mean_compression(h, T) @ dx)


def extreme(f, low, high, n_scan=400):
    """(t, f) of the largest f on [low, high]: a scan, then a bounded search around the best point."""
    t = np.linspace(low, high, n_scan)
    value = np.array([f(ti) for ti in t])
    i = int(np.argmax(value))
    found = minimize_scalar(
        lambda x: -f(x),
        bounds=(t[max(i - 1, 0)], t[min(i + 1, n_scan - 1)]),
        method="bounded",
        options={"xatol": 1e-10},
    )
    return (t[i], value[i]) if value[i] >= -found.fun else (found.x, -found.fun)


def static_cof(n, depth_ratio, T):
    """Static COF / mu_0: least over mean normal force; 0 as soon as the tip leaves the plane."""
    if not always_touches(depth_ratio, T):
        return 0.0
    _, value = extreme(lambda t: -full_slip_force(t, n, depth_ratio, T)[0], 0, TWO_PI, 200)
    return -value / mean_force(n, depth_ratio, T)


def body_matrix(k_ratio, omega_0_ratio, c_ratio):
    """(mass, A) of the body: m y'' + c y' + k y = -F as z' = A z - (0, F / m), z = (y, y')."""
    mass = k_ratio / omega_0_ratio**2
    return mass, np.array([[0.0, 1.0], [-k_ratio / mass, -c_ratio / mass]])


def full_slip_motion(n, depth_ratio, T, k_ratio, omega_0_ratio, c_ratio, reference_depth=None):
    """Periodic motion of the body in full slip: list of (t_low, t_high, z), z = (y, y'), u_x = v_hat t + y.

    The oscillator is linear: one run from rest over the period, split where F_N is not smooth, gives the
    periodic start (1 - exp(2 pi A))**-1 z(2 pi), and the free motion from there is added to it.
    """
    mass, matrix = body_matrix(k_ratio, omega_0_ratio, c_ratio)
    on, off = tip_times(depth_ratio, T)
    if always_touches(depth_ratio, T):
        cuts = sorted({0.0, np.pi - math.atan(T), TWO_PI})
    else:
        cuts = sorted({on, off, TWO_PI, on + TWO_PI})

    mean = mean_force(n, depth_ratio, T, reference_depth)

    def pieces():
        out, z = [], np.zeros(2)
        for low, high in pairwise(cuts):
            inner = 1e-13 * (high - low)  # keep one-sided values of a force that jumps

            def rate(t, z, low=low, high=high, inner=inner):
                at = min(max(t, low + inner), high - inner)
                force = full_slip_force([at], n, depth_ratio, T, reference_depth)[0] - mean
                return matrix @ z - np.array([0.0, force / mass])

            run = solve_ivp(rate, (low, high), z, method="DOP853", rtol=1e-11, atol=1e-12 / mass, dense_output=True)
            out.append((low, high, run.sol))
            z = run.y[:, -1]
        return out, z

    driven, end = pieces()
    start = np.linalg.solve(np.eye(2) - expm(TWO_PI * matrix), end)
    rates, modes = np.linalg.eig(matrix)  # apart: no body is damped critically
    shares = np.linalg.solve(modes, start)
    return [
        (low, high, lambda t, z=z: z(t) + (modes @ (shares * np.exp(rates * (t - cuts[0])))).real)
        for low, high, z in driven
    ]


def full_slip_critical_velocity(
    n, depth_ratio, T, k_ratio=math.inf, omega_0_ratio=1.0, c_ratio=0.0, reference_depth=None
):
    """Critical velocity / (mu_0 kappa omega du_z): the largest du_z/dt - dy/dt over the instants of contact.

    Every spring slides forward as long as v_hat + y' exceeds s' = -sin t of the springs in contact. k_ratio
    = inf is the rigid pull, y = 0: then v_c is 1 if the tip touches at t = 3 pi / 2, and less if it comes
    back later.
    """
    on, off = tip_times(depth_ratio, T)
    if math.isinf(k_ratio):
        return 1.0 if on <= 1.5 * np.pi else max(-math.sin(on), 0.0)
    motion = full_slip_motion(n, depth_ratio, T, k_ratio, omega_0_ratio, c_ratio, reference_depth)
    best = -math.inf
    for low, high, z in motion:
        middle = (low + high) / 2
        if (middle - on) % TWO_PI <= off - on or always_touches(depth_ratio, T):
            best = max(best, extreme(lambda t, z=z: -math.sin(t) - z(t)[1], low, high)[1])
    return float(best)


# --- spring pull: reference_turning.py has all but a body without mass --------------------------------------


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
