"""The slip of a spring whose friction is a vector: which way it turns, and how fast it slips.

With the trial force g = L[e] + T (x' - e') of a dashpot that would stick, x' the velocity of the top,

    g = (R + T vel) n,    T vel' + G vel = v.n - R',    n' (R + T vel) = v - (v.n) n,
    v = G x' + T x'' - sum rho_j e_j/theta_j

with the direction n of slip and force, the slip velocity vel >= 0, the disc R = L[s] and the modulus at once
G = 1 + sum rho_j. This is Coulomb's law and L, nothing else; it is the clipped trial force of a Kelvin spring, and for
T = 0 the end of an elastic spring that is dragged on a leash of length R, a tractrix.

On a straight way the turn of n is known, however far it turns and however R changes: half the angle between n and the
way has a tangent that falls by exp(-way/leash). Any other way is taken as two straight ones, from two Gauss nodes, that
together are of fourth order (a commutator-free Magnus method, Blanes & Moan 2006). Vectors are complex numbers, and
nothing knows of the axes.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.spring.law import phi_of
from mdr.tools.jit import inner

_inline = inner(forceinline=True, error_model="numpy", fastmath={"reassoc", "contract"})

GAUSS = 0.5 / np.sqrt(3.0)  #: of a stretch, by which nodes of Gauss's rule of two lie beside its middle
EARLY, LATE = 0.25 + 1 / np.sqrt(12.0), 0.25 - 1 / np.sqrt(12.0)  #: of two straight ways, of order four together
TINY = 1e-300  #: of a leash


class Cubic(NamedTuple):
    """a + b t + c t² + d t³, a number or a vector."""

    a: complex
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
    mean = (f.v_1 - f.v_0) * (1.0 / t)
    c = (3.0 * mean - 2.0 * f.d_0 - f.d_1) * (1.0 / t)
    return Cubic(f.v_0, f.d_0, c, (f.d_0 + f.d_1 - 2.0 * mean) * (1.0 / (t * t)))


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
    """Scalar product of two vectors."""
    return a.real * b.real + a.imag * b.imag


@_inline
def straight(n, boost):
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
def turned(n, v_1, v_2, rho_1, rho_2, t):
    """The direction n after a time t, under these ways a time and on these leashes at the two nodes of Gauss's rule."""
    b_1, b_2 = v_1 * (t / max(rho_1, TINY)), v_2 * (t / max(rho_2, TINY))
    return straight(straight(n, EARLY * b_1 + LATE * b_2), LATE * b_1 + EARLY * b_2)


@_inline
def driving(n, vel, t, v, R, T, span):
    """v.n - R' of a spring on a dashpot at a time, and its rate; span: of the time it is to serve for."""
    v_t, rho = at(v, t), max(at(R, t) + T * vel, TINY)
    across = v_t.imag * n.real - v_t.real * n.imag
    turning = across * across * rho / (rho * rho + across * across * span * span)  # where it turns at once, less
    return along(v_t, n) - slope(R, t), along(slope(v, t), n) + turning - 2.0 * (R.c + 3.0 * t * R.d)


@_inline
def driven(vel, c_0, d_0, c_1, d_1, t, T, phi):
    """vel after a time t in which T l' + G vel is the cubic of these values and slopes; phi of law.py, of G t/T."""
    step, first = c_1 - c_0, d_0 * t
    last = first + d_1 * t - 2.0 * step
    of = c_0 * phi[1] + first * phi[2] + 2.0 * (step - first - last) * phi[3] + 6.0 * last * phi[4]
    return vel * phi[0] + t / T * of


@_inline
def slid(n, vel, a, b, v, R, T, G):
    """Direction and velocity of slip at b, from those at a. v, R: cubics."""
    t, mid, off = b - a, 0.5 * (a + b), GAUSS * (b - a)
    v_1, v_2, R_1, R_2 = at(v, mid - off), at(v, mid + off), at(R, mid - off), at(R, mid + off)
    if T == 0.0:
        n = turned(n, v_1, v_2, R_1, R_2, t)
        return n, (along(at(v, b), n) - slope(R, b)) / G
    phi = phi_of(G * t / T)
    c_a, d_a = driving(n, vel, a, v, R, T, t)
    r_a, n_b = (c_a - G * vel) / T * t, n
    l_b = driven(vel, c_a, d_a, c_a + d_a * t, d_a, t, T, phi)
    r_b = (c_a + d_a * t - G * l_b) / T * t
    for _ in range(2):
        l_1 = (0.5 + GAUSS) * vel + (0.5 - GAUSS) * l_b
        l_2 = (0.5 - GAUSS) * vel + (0.5 + GAUSS) * l_b
        if G * t < T:  # the cubic of values and slopes at the nodes of Gauss's rule
            bend, tilt = (r_a - r_b) / 12.0, (r_a + r_b - 2.0 * (l_b - vel)) * GAUSS / 6.0
            l_1, l_2 = l_1 + bend + tilt, l_2 + bend - tilt
        n_b = turned(n, v_1, v_2, R_1 + T * l_1, R_2 + T * l_2, t)
        c_b, d_b = driving(n_b, l_b, b, v, R, T, t)
        l_b = driven(vel, c_a, d_a, c_b, d_b, t, T, phi)
        r_b = (c_b - G * l_b) / T * t
    return n_b, l_b


@_inline
def slides(n, vel, t, v, R, T, G):
    """Slip over a time t."""
    n_m, l_m = slid(n, vel, 0.0, 0.5 * t, v, R, T, G)
    n_1, l_1 = slid(n_m, l_m, 0.5 * t, t, v, R, T, G)
    return Slip(n_m, l_m, n_1, l_1)
