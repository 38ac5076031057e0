"""One spring over one step of time whose friction is a vector: a disc in the place of the interval of step.py.

The top moves on parabolas along the pull, across it and down. In scaled form Coulomb's law reads |L[e]| <= R, with the
extension e (a vector), R = L[s] and the law L of the material. Normal motion is that of step.py. In contact:

* *stick*: e goes with the top, L[e] is known (law.py), until its length comes to R;
* *slip*: with the trial force g = L[e] + T (x' - e') of a dashpot that would stick, x' the velocity of the top,

      g = (R + T vel) n,    T vel' + G vel = v.n - R',    n' (R + T vel) = v - (v.n) n,
      v = G x' + T x'' - sum rho_j e_j/theta_j

  with the direction n of slip and force, the slip velocity vel >= 0, and the modulus at once G = 1 + sum rho_j. This is
  Coulomb's law and L, nothing else; it is the clipped trial force of a Kelvin spring, and for T = 0 the end of an
  elastic spring that is dragged on a leash of length R, a tractrix. Slip ends where vel comes to zero.

On a straight way the turn of n is known, however far it turns and however R changes: half the angle between n and the
way has a tangent that falls by exp(-way/leash). Any other way is taken as two straight ones, from two Gauss nodes, that
together are of fourth order (a commutator-free Magnus method, Blanes & Moan 2006). Nothing knows of the axes.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.spring.contact_modes import FREE, SLIP, STICK
from mdr.spring.energies import (
    CONTACT_IMPULSE,
    FRICTION_LOSS,
    LEAST_SLIP,
    NORMAL_VISCOUS,
    NORMAL_WORK,
    SHEAR_VISCOUS,
    STICK_IMPULSE,
    lost_on_parabola,
)
from mdr.spring.law import fill_phi
from mdr.spring.step import MOST_EVENTS, ROUNDING, arms_ends, fill, force, glassy, held, hold_arms, lasts, plus, relax
from mdr.tools.arrays import Array
from mdr.tools.jit import compiled, inner

_FAST = {"reassoc", "contract"}
_inner = inner(error_model="numpy", fastmath=_FAST)
_inline = inner(forceinline=True, error_model="numpy", fastmath=_FAST)

GAUSS = 0.5 / np.sqrt(3.0)  #: of a stretch, by which nodes of Gauss's rule of two lie beside its middle
EARLY, LATE = 0.25 + 1 / np.sqrt(12.0), 0.25 - 1 / np.sqrt(12.0)  #: of two straight ways, of order four together
MOST_HALVINGS = 60  #: in the search for the end of a mode
TOUCHING = 1e-7  #: part of a step for which a spring has touched whose force has the direction of its motion
MOST_RETURNS = 4  #: of the memory of arms at the end of slip, upon which the slip depends


class Sums(NamedTuple):
    """What a row answers of a step, weighted by w."""

    area_x: float  #: of the force along the pull over the time
    area_y: float  #: across
    moment_x: float  #: of it about the begin of the step
    moment_y: float
    end_x: float  #: the force at the end
    end_y: float
    stuck: float  #: time in stick
    when: float  #: its moment
    sticking: float  #: share that sticks at the end


class LookAcross(NamedTuple):
    """What a close look at a step fills, of n springs."""

    sums: Array  #: (N_SUMS,)
    F: Array  #: (4,) at the end of the step: forces along and normal, least slip velocity in contact, force across
    mode: Array  #: (n,)
    f_x: Array  #: (n,) force over stiffness at the end of the step
    f_z: Array  #: (n,)
    f_y: Array  #: (n,)


class Cubic(NamedTuple):
    """a + b t + c t² + d t³."""

    a: complex  #: real of what is a number
    b: complex
    c: complex
    d: complex


class Slip(NamedTuple):
    """Direction and velocity of slip at the middle and at the end of a time."""

    n_m: complex
    l_m: float
    n: complex
    vel: float


@_inline
def cubic(f, t):
    """The cubic with the values and slopes of Ends over a time t."""
    mean = (f.v_1 - f.v_0) / t
    c = (3.0 * mean - 2.0 * f.d_0 - f.d_1) / t
    return Cubic(f.v_0, f.d_0, c, (f.d_0 + f.d_1 - 2.0 * mean) / (t * t))


@_inline
def at(f, t):
    """Value of a cubic."""
    return f.a + t * (f.b + t * (f.c + t * f.d))


@_inline
def slope(f, t):
    """Slope of a cubic."""
    return f.b + t * (2.0 * f.c + 3.0 * t * f.d)


@_inline
def since(f, t):
    """The same cubic from a time on."""
    return Cubic(at(f, t), slope(f, t), f.c + 3.0 * f.d * t, f.d)


@_inline
def size_of(a):
    """Length of a vector; the library's `abs` guards against overflow, and takes several times as long."""
    return np.sqrt(a.real * a.real + a.imag * a.imag)


@_inline
def along(a, b):
    """Scalar product of two vectors, which are complex numbers."""
    return a.real * b.real + a.imag * b.imag


@_inline
def dragged(n, boost):
    """The direction n after a straight way, of this vector over the leash: exact."""
    q = 0.25 * (boost.real * boost.real + boost.imag * boost.imag)
    if q < 0.3:  # half of tanh(x)/x, x² = q, by its continued fraction, to rounding
        share = 0.5 * (135135.0 + q * (17325.0 + q * (378.0 + q)))
        share /= 135135.0 + q * (62370.0 + q * (3150.0 + q * 28.0))
    else:
        root = np.sqrt(q)
        share = 0.5 * np.tanh(root) / root
    half = share * boost
    other = 1.0 + half * n.conjugate()  # as long as n + half
    size = other.real * other.real + other.imag * other.imag
    return (n + half) * other * (1.0 / size) if size > 0.0 else n


@_inline
def turned(n, b_1, b_2, t):
    """The direction n after a time t, under the ways b a time at the two nodes of Gauss's rule."""
    return dragged(dragged(n, t * (EARLY * b_1 + LATE * b_2)), t * (LATE * b_1 + EARLY * b_2))


@_inline
def curved(f, t):
    """Half of the second derivative of a cubic."""
    return f.c + 3.0 * t * f.d


@_inline
def pull_of(n, vel, t, v, R, T, span):
    """v.n - R' of a spring on a dashpot at a time, and its rate; span: of the time it is to serve for."""
    v_t, rho = at(v, t), max(at(R, t) + T * vel, 1e-300)
    across = v_t.imag * n.real - v_t.real * n.imag
    turning = across * across * rho / (rho * rho + across * across * span * span)  # where it turns at once, less
    return along(v_t, n) - slope(R, t), along(slope(v, t), n) + turning - 2.0 * curved(R, t)


@_inline
def driven(vel, c_0, d_0, c_1, d_1, t, T, phi):
    """vel after a time t in which T l' + G vel is the cubic of these values and slopes; phi of law.py, of G t/T."""
    step, first = c_1 - c_0, d_0 * t
    last = first + d_1 * t - 2.0 * step
    of = c_0 * phi[1] + first * phi[2] + 2.0 * (step - first - last) * phi[3] + 6.0 * last * phi[4]
    return vel * phi[0] + t / T * of


@_inline
def slid(n, vel, a, b, v, R, T, G, phi):
    """Direction and velocity of slip at b, from those at a. v, R: cubics. phi: room."""
    t, mid, off = b - a, 0.5 * (a + b), GAUSS * (b - a)
    v_1, v_2, R_1, R_2 = at(v, mid - off), at(v, mid + off), at(R, mid - off), at(R, mid + off)
    tiny = 1e-300
    if T == 0.0:
        n = turned(n, v_1 * (1.0 / max(R_1, tiny)), v_2 * (1.0 / max(R_2, tiny)), t)
        return n, (along(at(v, b), n) - slope(R, b)) / G
    fill_phi(G * t / T, phi)
    c_a, d_a = pull_of(n, vel, a, v, R, T, t)
    r_a, n_b, l_b, r_b = (c_a - G * vel) / T * t, n, vel, 0.0
    l_b = driven(vel, c_a, d_a, c_a + d_a * t, d_a, t, T, phi)
    r_b = (c_a + d_a * t - G * l_b) / T * t
    for _ in range(2):
        l_1 = (0.5 + GAUSS) * vel + (0.5 - GAUSS) * l_b
        l_2 = (0.5 - GAUSS) * vel + (0.5 + GAUSS) * l_b
        if G * t < T:  # the cubic of values and slopes at the nodes of Gauss's rule
            bend, tilt = (r_a - r_b) / 12.0, (r_a + r_b - 2.0 * (l_b - vel)) * GAUSS / 6.0
            l_1, l_2 = l_1 + bend + tilt, l_2 + bend - tilt
        n_b = turned(n, v_1 * (1.0 / max(R_1 + T * l_1, tiny)), v_2 * (1.0 / max(R_2 + T * l_2, tiny)), t)
        c_b, d_b = pull_of(n_b, l_b, b, v, R, T, t)
        l_b = driven(vel, c_a, d_a, c_b, d_b, t, T, phi)
        r_b = (c_b - G * l_b) / T * t
    return n_b, l_b


@_inline
def slides(n, vel, t, v, R, T, G, phi):
    """Slip over a time t."""
    n_m, l_m = slid(n, vel, 0.0, 0.5 * t, v, R, T, G, phi)
    n_1, l_1 = slid(n_m, l_m, 0.5 * t, t, v, R, T, G, phi)
    return Slip(n_m, l_m, n_1, l_1)


@_inline
def excess(x, y, R, t):
    """By how much a force is outside its disc at a time."""
    return size_of(complex(at(x, t), at(y, t))) - at(R, t)


@_inline
def leaves(x, y, R, t):
    """Rate of the square of a force less that of its disc."""
    return at(x, t) * slope(x, t) + at(y, t) * slope(y, t) - at(R, t) * slope(R, t)


@_inline
def nearer(low, high, f_low, f_high, mid, f, side):
    """The bracket of a zero after a look at mid, by regula falsi (the Illinois method)."""
    if (f < 0.0) == (f_low < 0.0):
        return mid, high, f, f_high * (0.5 if side < 0 else 1.0), -1
    return low, mid, f_low * (0.5 if side > 0 else 1.0), f, 1


@_inline
def until_slip(x, y, R, t, tol):
    """When the force (x, y) of a spring that sticks leaves the disc R, all cubics; t if it does not."""
    high = 0.0
    for half in range(2):
        low, high = high, 0.5 * (half + 1) * t
        if excess(x, y, R, high) > tol:
            break
        f_low, f_high, side = leaves(x, y, R, low), leaves(x, y, R, high), 0
        if f_low > 0.0 and f_high < 0.0:  # nearest to the rim in between
            a, b, mid = low, high, low
            for _ in range(MOST_HALVINGS):
                mid = (a * f_high - b * f_low) / (f_high - f_low)
                f = leaves(x, y, R, mid)
                if f == 0.0 or b - a <= 1e-9 * t:
                    break
                a, b, f_low, f_high, side = nearer(a, b, f_low, f_high, mid, f, side)
            if excess(x, y, R, mid) > tol:
                high = mid
                break
        if half == 1:
            return t
    if excess(x, y, R, low) > -tol and leaves(x, y, R, low) < 0.0:  # from the rim inward, and out again later
        part = high - low
        for _ in range(MOST_HALVINGS):
            part *= 0.5
            f = excess(x, y, R, low + part)
            if f < -tol:
                low += part
                break
            if f > tol:
                high = low + part
    f_low, f_high, side = min(excess(x, y, R, low), -0.0), excess(x, y, R, high), 0
    for _ in range(MOST_HALVINGS):
        if high - low <= 1e-15 * t:
            break
        mid = (low * f_high - high * f_low) / (f_high - f_low)
        f = excess(x, y, R, mid)
        if abs(f) <= 0.1 * tol:
            return mid
        if f < 0.0:
            low, f_low = mid, f
            f_high *= 0.5 if side < 0 else 1.0
            side = -1
        else:
            high, f_high = mid, f
            f_low *= 0.5 if side > 0 else 1.0
            side = 1
    return high


@_inline
def sum_of(x, i, of):
    """sum of_j x_j over the arms of x[:, i]."""
    total = 0.0
    for j in range(of.size):
        total += of[j] * x[1 + j, i]
    return total


@_inline
def arms_after(x, i, p, p_fast, q, t, k, keep, tools, arms):
    """What the arms of x[:, i], held on p t + q t² for a time t, come to: the sums of rho_j x_j, of rho_j x_j/theta_j,
    and of the latter at half of the time. Fast arms, of theta_j < h, are held on p_fast t + q t², and their sum changes
    evenly. keep: whether x is to be what it comes to.
    """
    of, half = tools.held[k], tools.held[k + 2]
    one = two = middle = 0.0
    for j in range(arms.rho.size):
        before, rate, is_fast = x[1 + j, i], arms.rate[j], arms.rate[j] * tools.h > 1.0
        first = p_fast if is_fast else p
        after = before * of[0, j] + first * of[1, j] + q * of[2, j]
        mid = before * half[0, j] + first * half[1, j] + q * half[2, j]
        if keep:
            x[1 + j, i] = after
        one += arms.rho[j] * after
        two += arms.rho[j] * rate * after
        middle += arms.rho[j] * rate * (0.5 * (before + after) if is_fast else mid)
    return one, two, middle


@_inline
def arms_give(t, k, tools, arms):
    """By how much the length of an extension over a time t exceeds that of its slow arms, and the memory of its fast
    ones its rate at the end.
    """
    per, back = t, 0.0
    for j in range(arms.rho.size):
        if arms.rate[j] * tools.h > 1.0:
            back += arms.rho[j] * arms.rate[j] * tools.held[k, 2, j] / (2.0 * t)
        else:
            per += arms.rho[j] * tools.held[k, 1, j]
    return per, back


@_inline
def fill_halves(t, modes, arms, tools, k):
    """`fill` of a time for slot k, and of its half for slot k + 2."""
    fill(t, modes, arms, tools, k)
    if arms is not None:
        fill(0.5 * t, modes, arms, tools, k + 2)


@compiled(error_model="numpy", nogil=True, fastmath=_FAST)
def row_turning(s, e, gap, w, path, y_1, y_2, T, modes, arms, tools, look):
    """All springs over a step, as `row` of step.py, with a way y_1 t + y_2 t² across the pull too.

    e: (2 (1 + J), n) extensions and arms along the pull, then those across. look: None or LookAcross.
    """
    h, J, G = tools.h, s.shape[0], glassy(arms)
    e_x, e_y = e[:J], e[J:]
    fill_halves(h, modes, arms, tools, 0)
    area = moment = end = 0.0 + 0.0j
    stuck = when = sticking = 0.0
    least = np.inf
    for i in range(gap.size):
        tol = ROUNDING * (1.0 + abs(gap[i]))
        z_0, z_1, z_2 = path.z_0 - gap[i], path.z_1, path.z_2
        x_1, x_2 = complex(path.x_1, y_1), complex(path.x_2, y_2)
        t, done, k, mode, f, R_end, l_end = h, 0.0, 0, FREE, 0.0j, 0.0, 0.0
        presses = s[0, i] <= z_0 + tol
        if presses:
            s[0, i] = z_0
        for event in range(MOST_EVENTS):
            presses, until = lasts(presses, event, s, i, z_0, z_1, z_2, t, k, tol, G, T, modes, arms, tools)
            ends = until < t
            if ends:
                t, k = until, 1
                fill_halves(t, modes, arms, tools, 1)
            if not presses:
                mode = FREE
                if look is not None:
                    look.sums[NORMAL_VISCOUS] += w[i] * stored(s, i, arms)
                    look.sums[SHEAR_VISCOUS] += w[i] * (stored(e_x, i, arms) + stored(e_y, i, arms))
                relax(s, i, k, modes, arms, tools)
                relax(e_x, i, k, modes, arms, tools)
                relax(e_y, i, k, modes, arms, tools)
                if look is not None:
                    look.sums[NORMAL_VISCOUS] -= w[i] * stored(s, i, arms)
                    look.sums[SHEAR_VISCOUS] -= w[i] * (stored(e_x, i, arms) + stored(e_y, i, arms))
            elif t > 0.0:
                press = held(s[0, i], z_1, z_2, T, t)
                if arms is not None:
                    press = plus(press, 1.0, arms_ends(s, i, z_1, z_2, t, k, tools, arms))
                R = cubic(press, t)
                if look is not None:
                    look.sums[NORMAL_VISCOUS] += w[i] * lost_on_parabola(s, i, z_1, z_2, t, T, arms)
                    for u, share in ((0.0, 1.0 / 6.0), (0.5 * t, 4.0 / 6.0), (t, 1.0 / 6.0)):
                        look.sums[CONTACT_IMPULSE] += w[i] * t * share * at(R, u)
                        look.sums[NORMAL_WORK] += w[i] * t * share * at(R, u) * (z_1 + 2.0 * z_2 * u)
                s[0, i] += t * (z_1 + z_2 * t)
                if arms is not None:
                    hold_arms(s, i, z_1, z_2, k, tools, arms)
                # friction over this time, from event to event
                gone, zeros, begins, mode = 0.0, 0, True, STICK
                for _ in range(MOST_EVENTS):
                    u = t - gone
                    if gone > 0.0:
                        k = 1
                        fill_halves(u, modes, arms, tools, 1)
                    fx = held(e_x[0, i], x_1.real, x_2.real, T, u)
                    fy = held(e_y[0, i], x_1.imag, x_2.imag, T, u)
                    a_0 = 0.0j
                    if arms is not None:
                        fx = plus(fx, 1.0, arms_ends(e_x, i, x_1.real, x_2.real, u, k, tools, arms))
                        fy = plus(fy, 1.0, arms_ends(e_y, i, x_1.imag, x_2.imag, u, k, tools, arms))
                        for j in range(arms.rho.size):
                            a_0 += arms.rho[j] * arms.rate[j] * complex(e_x[1 + j, i], e_y[1 + j, i])
                    g, R_0 = complex(fx.v_0, fy.v_0), max(R.a, 0.0)
                    v_0 = G * x_1 + 2.0 * T * x_2 - a_0
                    rho, fast = size_of(g), size_of(v_0)
                    n = g * (1.0 / rho) if rho > TOUCHING * h * fast else v_0 * (1.0 / max(fast, 1e-300))
                    ahead = along(v_0, n) - R.b
                    if begins:  # in which mode
                        mode = STICK
                        if (rho >= R_0 - tol and ahead > 0.0) or (T > 0.0 and rho > R_0 + tol):
                            mode = SLIP
                    begins = False
                    vel = max(rho - R_0, 0.0) / T if T > 0.0 else max(ahead, 0.0) / G
                    last = True
                    if mode == STICK:
                        until = until_slip(cubic(fx, u), cubic(fy, u), R, u, tol)
                        zeros = zeros + 1 if until <= 0.0 else 0
                        last = until >= u
                        if not last:
                            u, k = until, 1
                            fill_halves(u, modes, arms, tools, 1)
                        if look is not None:
                            look.sums[SHEAR_VISCOUS] += w[i] * (
                                lost_on_parabola(e_x, i, x_1.real, x_2.real, u, T, arms)
                                + lost_on_parabola(e_y, i, x_1.imag, x_2.imag, u, T, arms)
                            )
                            look.sums[STICK_IMPULSE] += w[i] * u * (at(R, 0.0) + 4.0 * at(R, 0.5 * u) + at(R, u)) / 6.0
                            look.sums[LEAST_SLIP] = min(look.sums[LEAST_SLIP], 0.0)
                        A_x, B_x = force(e_x[0, i], x_1.real, x_2.real, T, u)
                        A_y, B_y = force(e_y[0, i], x_1.imag, x_2.imag, T, u)
                        e_x[0, i] += u * (x_1.real + u * x_2.real)
                        e_y[0, i] += u * (x_1.imag + u * x_2.imag)
                        if arms is not None:
                            C_x, D_x = hold_arms(e_x, i, x_1.real, x_2.real, k, tools, arms)
                            C_y, D_y = hold_arms(e_y, i, x_1.imag, x_2.imag, k, tools, arms)
                            A_x, B_x, A_y, B_y = A_x + C_x, B_x + D_x, A_y + C_y, B_y + D_y
                        begun = done + gone
                        area += w[i] * complex(A_x, A_y)
                        moment += w[i] * complex(begun * A_x + B_x, begun * A_y + B_y)
                        stuck += w[i] * u
                        when += w[i] * u * (begun + 0.5 * u)
                    else:
                        low, high, l_low, l_high, side = 0.0, u, vel, 0.0, 0
                        for turn in range(MOST_HALVINGS):
                            # the slip over a time u, of which the memory of arms is part
                            top, rate_0 = x_1 + 2.0 * x_2 * u, x_1 - vel * n
                            p, q, v = rate_0, 0.0j, Cubic(v_0, 2.0 * G * x_2, 0.0j, 0.0j)
                            of = Slip(n, vel, n, vel)
                            if arms is not None:
                                per, back = arms_give(u, k, tools, arms)
                                gives = 1.0 / G
                                if T > 0.0:
                                    fill_phi(0.5 * G * u / T, tools.one)
                                    gives = 0.5 * u / T * tools.one[2]
                                for _ in range(MOST_RETURNS):
                                    _, a_x, m_x = arms_after(
                                        e_x, i, p.real, rate_0.real, q.real, u, k, False, tools, arms
                                    )
                                    _, a_y, m_y = arms_after(
                                        e_y, i, p.imag, rate_0.imag, q.imag, u, k, False, tools, arms
                                    )
                                    m, a = complex(m_x, m_y) - a_0, complex(a_x, a_y) - a_0
                                    v = Cubic(
                                        v_0, 2.0 * G * x_2 - (4.0 * m - a) / u, (4.0 * m - 2.0 * a) / (u * u), 0.0j
                                    )
                                    known = gives * back * of.vel
                                    of = slides(n, vel, u, v, R, T, G, tools.one)
                                    of = Slip(of.n_m, of.l_m, of.n, (of.vel - known) / (1.0 - gives * back))
                                    q = (top - of.vel * of.n - rate_0) / (2.0 * u)
                                    b_x, _, _ = arms_after(
                                        e_x, i, -q.real * u, rate_0.real, q.real, u, k, False, tools, arms
                                    )
                                    b_y, _, _ = arms_after(
                                        e_y, i, -q.imag * u, rate_0.imag, q.imag, u, k, False, tools, arms
                                    )
                                    trial = (max(at(R, u), 0.0) + T * of.vel) * of.n - T * top
                                    p = (trial - complex(e_x[0, i] + b_x, e_y[0, i] + b_y)) / per - q * u
                            else:
                                of = slides(n, vel, u, v, R, T, G, tools.one)
                            if zeros > 1:  # slip and stick hold here alike
                                break
                            if turn == 0:
                                if of.vel >= 0.0:
                                    break
                                if of.l_m < 0.0:
                                    high, l_high = 0.5 * u, of.l_m
                                else:
                                    l_high = of.vel
                                last = False
                            else:
                                if of.vel < 0.0:
                                    high, l_high = u, of.vel
                                    l_low *= 0.5 if side > 0 else 1.0
                                    side = 1
                                else:
                                    low, l_low = u, of.vel
                                    l_high *= 0.5 if side < 0 else 1.0
                                    side = -1
                            if (high - low <= 1e-14 * h and u == high) or l_low <= 0.0 or of.vel == 0.0:
                                break
                            u = (low * l_high - high * l_low) / (l_high - l_low)
                            if high - low <= 1e-14 * h or not (low < u < high):
                                u = high
                            k = 1
                            fill_halves(u, modes, arms, tools, 1)
                        if not last and l_low <= 0.0 and low == 0.0:  # it does not slip at all
                            u = 0.0
                            zeros += 1
                        else:
                            zeros = 0
                        if u > 0.0:
                            l_1 = max(of.vel, 0.0) if last else 0.0
                            R_m, R_1 = max(at(R, 0.5 * u), 0.0), max(at(R, u), 0.0)
                            trial = (R_1 + T * l_1) * of.n - T * top
                            if arms is None:
                                q = (top - l_1 * of.n - rate_0) * (0.5 / u)
                                p = (trial - complex(e_x[0, i], e_y[0, i])) * (1.0 / u) - q * u
                            f_0, f_m, f_1 = R_0 * n, R_m * of.n_m, R_1 * of.n
                            if look is not None:
                                look.sums[SHEAR_VISCOUS] += w[i] * (
                                    lost_on_parabola(e_x, i, p.real, q.real, u, T, arms)
                                    + lost_on_parabola(e_y, i, p.imag, q.imag, u, T, arms)
                                )
                                of_slip = R_0 * vel + 4.0 * R_m * max(of.l_m, 0.0) + R_1 * l_1
                                look.sums[FRICTION_LOSS] += w[i] * u / 6.0 * of_slip
                                look.sums[LEAST_SLIP] = min(look.sums[LEAST_SLIP], vel, l_1)
                            if arms is not None:
                                b_x, _, _ = arms_after(e_x, i, p.real, rate_0.real, q.real, u, k, True, tools, arms)
                                b_y, _, _ = arms_after(e_y, i, p.imag, rate_0.imag, q.imag, u, k, True, tools, arms)
                                trial -= complex(b_x, b_y)
                            e_x[0, i], e_y[0, i] = trial.real, trial.imag
                            A, B = u / 6.0 * (f_0 + 4.0 * f_m + f_1), u * u / 6.0 * (2.0 * f_m + f_1)
                            area += w[i] * A
                            moment += w[i] * ((done + gone) * A + B)
                            f, l_end = f_1, l_1
                    if last:
                        R_end = max(at(R, u), 0.0)
                        break
                    gone += u
                    x_1, R = x_1 + 2.0 * u * x_2, since(R, u)
                    mode = STICK if mode == SLIP else SLIP
                x_1 -= 2.0 * gone * x_2  # of the begin of this time again
            if not ends:
                break
            done += t
            z_0, z_1, presses = z_0 + t * (z_1 + t * z_2), z_1 + 2.0 * z_2 * t, not presses
            x_1 += 2.0 * t * x_2
            if presses:
                s[0, i] = z_0
            t, k = h - done, 1
            fill_halves(t, modes, arms, tools, 1)
        if mode == FREE:
            f, R_end = 0.0j, 0.0
        elif mode == STICK:
            sticking += w[i]
            last_rate = complex(path.x_1, y_1) + 2.0 * h * x_2
            f = complex(e_x[0, i], e_y[0, i]) + T * last_rate
            if arms is not None:
                f += complex(sum_of(e_x, i, arms.rho), sum_of(e_y, i, arms.rho))
            size = size_of(f)
            f = f * (R_end / size) if size > R_end else f
            l_end = 0.0
        end += w[i] * f
        if look is not None:
            if mode != FREE:
                least = min(least, l_end)
            look.mode[i], look.f_x[i], look.f_y[i], look.f_z[i] = mode, f.real, f.imag, R_end
            look.F[0] += w[i] * f.real
            look.F[1] += w[i] * R_end
            look.F[3] += w[i] * f.imag
    if look is not None:
        look.F[2] = least
    return Sums(area.real, area.imag, moment.real, moment.imag, end.real, end.imag, stuck, when, sticking)


@_inner
def stored(x, i, arms):
    """Elastic energy of x[:, i]."""
    energy = x[0, i] ** 2
    if arms is not None:
        for j in range(arms.rho.size):
            energy += arms.rho[j] * x[1 + j, i] ** 2
    return 0.5 * energy
