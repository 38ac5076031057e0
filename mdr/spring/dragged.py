"""The slip of a spring whose friction is a vector: in which direction it turns, and how fast it slips.

With the trial force g = L[e] + T (x' - e') of a dashpot that would stick, x' the velocity of the top,

    g = (R + T vel) n,    T vel' + G vel = v.n - R',    n' (R + T vel) = v - (v.n) n,
    v = G x' + T x'' - sum rho_j e_j/theta_j

with the direction n of slip and force, the slip velocity vel >= 0, the disc R = L[q] and the modulus at once
G = 1 + sum rho_j. This is Coulomb's law and L, nothing else; it is the clipped trial force of a Kelvin spring, and for
T = 0 the end of an elastic spring that is dragged on a leash of length R, a tractrix.

On a straight path the turn of n is known, however far it turns and however R changes: half the angle between n and the
path has a tangent that falls by exp(-path/leash). Any other path is taken as two straight ones, from two Gauss nodes,
that together are of fourth order (a commutator-free Magnus method, Blanes & Moan 2006). The area of the force follows
from its values and rates at both ends, or from Simpson's rule where the path is longer than the leash. Vectors are
complex numbers, and nothing knows of the axes.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.spring.law import phi_of
from mdr.spring.path import FAST_IN_PLANE, LENT, along, at, cubic_later, size_of, slope
from mdr.tools.jit import inner

_inline = inner(forceinline=True, error_model="numpy", fastmath=FAST_IN_PLANE, **LENT)

GAUSS = 0.5 / np.sqrt(3.0)  #: of a stretch, by which nodes of Gauss's rule of two lie beside its middle
EARLY, LATE = 0.25 + 1 / np.sqrt(12.0), 0.25 - 1 / np.sqrt(12.0)  #: of two straight paths, of order four together
TINY = 1e-100  #: of a leash, and of a velocity; its square, and a path over it, are numbers too
SHORT = 1.0  #: square of a path over the leash that counts as short
EVEN = 2.0  #: times the least leash that the greatest may be, for two nodes to tell how far a path turns a spring
NO_PHI = (1.0, 1.0, 0.5, 0.0, 0.0)  #: in the place of phi where nothing is viscous


class Slip(NamedTuple):
    """Slip over a time."""

    n: complex  #: direction at its end
    vel: float  #: velocity there
    area: complex  #: of the force
    moment: complex
    l_m: float


@_inline
def point(f, t):
    """Value of a cubic of vectors."""
    a, b, c, d = f
    return complex(a.real + t * (b.real + t * (c.real + t * d.real)), a.imag + t * (b.imag + t * (c.imag + t * d.imag)))


@_inline
def velocity(f, t):
    """Slope of a cubic of vectors."""
    _, b, c, d = f
    return complex(b.real + t * (2.0 * c.real + 3.0 * t * d.real), b.imag + t * (2.0 * c.imag + 3.0 * t * d.imag))


@_inline
def scaled(r, a):
    """A number times a vector: numba's product takes the number for a vector too."""
    return complex(r * a.real, r * a.imag)


@_inline
def cross(a, b):
    """Vector product of two vectors."""
    return a.real * b.imag - a.imag * b.real


@_inline
def times(n, cos, sin):
    """A direction turned by an angle."""
    return complex(cos * n.real - sin * n.imag, cos * n.imag + sin * n.real)


@_inline
def turned_straight(n, boost):
    """The direction n after a straight path, of this vector over the leash: exact."""
    root = 0.5 * size_of(boost)
    half = scaled(0.5 * np.tanh(root) / max(root, TINY), boost)
    x, y = 1.0 + along(half, n), cross(n, half)
    size = x * x + y * y
    return times(n, (x * x - y * y) / size, 2.0 * x * y / size) if size > TINY else n


@_inline
def parts(boost):
    """tanh(x)/x of a short path, 2 x long, by its continued fraction: numerator and denominator."""
    q = 0.25 * (boost.real * boost.real + boost.imag * boost.imag)
    return 945.0 + q * (105.0 + q), 945.0 + q * (420.0 + q * 15.0)


@_inline
def turned_twice(n, a, b):
    """The direction n after two short straight paths; the same, with one division."""
    (of_a, per_a), (of_b, per_b) = parts(a), parts(b)
    a, b = scaled(0.5 * of_a, a), scaled(0.5 * of_b, b)
    both = scaled(per_b, a) + scaled(per_a, b)
    x, y = per_a * per_b + along(a, b) + along(both, n), cross(a, b) + cross(n, both)
    per = 1.0 / (x * x + y * y)
    return times(n, per * (x * x - y * y), per * 2.0 * x * y)


@_inline
def turned(n, v_1, v_2, rho_1, rho_2, t, short, sure):
    """The direction n after a time t, under these velocities and on these leashes at the two nodes of Gauss's rule.

    short: at the ends of the time; sure: at the nodes too, where a leash may have come to nothing.
    """
    b_1, b_2 = scaled(t / max(rho_1, TINY), v_1), scaled(t / max(rho_2, TINY), v_2)
    a, b = scaled(EARLY, b_1) + scaled(LATE, b_2), scaled(LATE, b_1) + scaled(EARLY, b_2)
    if short and (sure or along(b_1, b_1) + along(b_2, b_2) < 4.0 * SHORT):
        return turned_twice(n, a, b)
    return turned_straight(turned_straight(n, a), b)


@_inline
def driving(n, vel, v, v_dot, R, R_dot, R_bend, T, span):
    """v.n - R' of a spring on a dashpot, and its rate; span: of the time it is to serve for."""
    rho, across = max(R + T * vel, TINY), cross(v, n)
    turning = across * across * rho / (rho * rho + across * across * span * span)  # where it turns at once, less
    return along(v, n) - R_dot, along(v_dot, n) + turning - R_bend


@_inline
def driven(vel, c_0, d_0, c_1, d_1, t, T, phi):
    """vel after a time t in which T l' + G vel is the cubic of these values and slopes; phi of law.py, of G t/T."""
    step, first = c_1 - c_0, d_0 * t
    last = first + d_1 * t - 2.0 * step
    of = c_0 * phi[1] + first * phi[2] + 2.0 * (step - first - last) * phi[3] + 6.0 * last * phi[4]
    return vel * phi[0] + t / T * of


@_inline
def slid(n, vel, t, v, R, T, G, phi, viscous, short, sure):
    """Direction and velocity of slip after a time t. v, R: cubics. phi: of law.py, of G t/T. short, sure: of turned."""
    early, late = (0.5 - GAUSS) * t, (0.5 + GAUSS) * t
    v_1, v_2, R_1, R_2 = point(v, early), point(v, late), at(R, early), at(R, late)
    v_b, R_dot = point(v, t), slope(R, t)
    if not viscous:
        n = turned(n, v_1, v_2, R_1, R_2, t, short, sure)
        return n, (along(v_b, n) - R_dot) / G
    v_dot, R_b, bend, per = velocity(v, t), at(R, t), 2.0 * (R.c + 3.0 * t * R.d), t / T
    c_a, d_a = driving(n, vel, v.a, v.b, R.a, R.b, 2.0 * R.c, T, t)
    n_b, c_b, d_b = n, c_a + d_a * t, d_a
    l_b = driven(vel, c_a, d_a, c_b, d_b, t, T, phi)
    r_a, r_b = per * (c_a - G * vel), per * (c_b - G * l_b)
    for _ in range(2):  # the mean of the velocity, and its tilt between the nodes of Gauss's rule
        if G * t < T:  # of the cubic of values and slopes
            mean = 0.5 * (vel + l_b) + (r_a - r_b) / 12.0
            tilt = GAUSS * (l_b - vel + (2.0 * (l_b - vel) - r_a - r_b) / 6.0)
        else:  # as T l' + G l = c has them, however soon l comes to c/G
            mean = (0.5 * (c_a + c_b) + t * (d_a - d_b) / 12.0 - (l_b - vel) / per) / G
            tilt = (0.1 * (c_b - c_a) - t * (d_a + d_b) / 120.0 - (0.5 * (vel + l_b) - mean) / per) / (G * GAUSS)
        n_b = turned(n, v_1, v_2, R_1 + T * (mean - tilt), R_2 + T * (mean + tilt), t, short, sure)
        c_b, d_b = driving(n_b, l_b, v_b, v_dot, R_b, R_dot, bend, T, t)
        l_b = driven(vel, c_a, d_a, c_b, d_b, t, T, phi)
        r_b = per * (c_b - G * l_b)
    return n_b, l_b


@_inline
def force_and_rates(n, vel, v, v_dot, R, R_dot, R_bend, T, G):
    """Force R n of a spring that slips, its rate, and the rate of that."""
    per = 1.0 / max(R + T * vel, TINY)
    ahead, turn = along(n, v), per * cross(n, v)  # n' = turn i n
    aside = 2.0 * R_dot * turn + R * per * (cross(n, v_dot) - turn * (2.0 * ahead - G * vel))
    f = scaled(R, n)
    return f, times(n, R_dot, R * turn), times(n, R_bend - R * turn * turn, aside)


@_inline
def area_and_moment(f_0, f_1, t):
    """Area and moment over a time of the polynomial with these values, rates and second derivatives at its ends."""
    (a, b, c), (d, e, f) = f_0, f_1
    area = scaled(0.5 * t, a + d) + scaled(t * t / 10.0, b - e) + scaled(t * t * t / 120.0, c + f)
    moment = scaled(1.0 / 7.0, a) + scaled(5.0 / 14.0, d) + scaled(4.0 / 105.0 * t, b) - scaled(13.0 / 210.0 * t, e)
    return area, scaled(t * t, moment + scaled(t * t / 280.0, c) + scaled(t * t / 210.0, f))


@_inline
def yielded(x, f_0, f_1, area, moment, t, T, phi):
    """The extension x of a spring on a dashpot after a time t under a force with these values at both ends, this area
    and moment, taken for a cubic; phi of law.py, of t/T.

    It is the force less T x' too. But that multiplies what is missed of a velocity by T, which the integral divides by
    T: where t < T this is the one to take.
    """
    mean, lever, last = scaled(1.0 / t, area) - f_0, scaled(1.0 / (t * t), moment) - scaled(0.5, f_0), f_1 - f_0
    b = scaled(3.0, last) + scaled(36.0, mean) - scaled(60.0, lever)
    c = scaled(180.0, lever) - scaled(12.0, last) - scaled(96.0, mean)
    d = scaled(10.0, last) + scaled(60.0, mean) - scaled(120.0, lever)
    of = scaled(phi[1], f_0) + scaled(phi[2], b) + scaled(2.0 * phi[3], c) + scaled(6.0 * phi[4], d)
    return scaled(phi[0], x) + scaled(t / T, of)


@_inline
def is_short(v, rho, t):
    """True for a path that is short beside the leash."""
    return along(v, v) * (t * t) < SHORT * (rho * rho)


@_inline
def slides(n, vel, t, v, R, T, G, midway):
    """Slip over a time t. midway: whether its velocity in the middle is asked for."""
    v_1, R_0, R_m, R_1 = point(v, t), max(R.a, 0.0), max(at(R, 0.5 * t), 0.0), max(at(R, t), 0.0)
    short = is_short(v.a, R_0 + T * vel, t) and is_short(v_1, R_1, t)
    f_0 = force_and_rates(n, vel, v.a, v.b, R_0, R.b, 2.0 * R.c, T, G)
    n_m, l_m, n_1, l_1 = n, vel, n, vel
    v_dot, R_dot, R_bend = velocity(v, t), slope(R, t), 2.0 * (R.c + 3.0 * t * R.d)
    for half in range(1 if short and not midway else 0, 2):
        u, n_1, l_1 = t if half == 1 and short else 0.5 * t, n, vel
        if half == 1 and not short:
            n_1, l_1, v, R = n_m, l_m, cubic_later(v, u), cubic_later(R, u)
        phi = phi_of(G * u / T) if T > 0.0 else NO_PHI
        n_1, l_1 = slid(n_1, l_1, u, v, R, T, G, phi, T > 0.0, short, False)
        if half == 0:
            n_m, l_m = n_1, l_1
    f_1 = force_and_rates(n_1, l_1, v_1, v_dot, R_1, R_dot, R_bend, T, G)
    area, moment = area_and_moment(f_0, f_1, t)
    if not short:  # Simpson's rule
        f_m, end = scaled(4.0 * R_m, n_m), f_1[0]
        area, moment = scaled(t / 6.0, f_0[0] + f_m + end), scaled(t * t / 6.0, scaled(0.5, f_m) + end)
    return Slip(n_1, l_1, area, moment, l_m)
