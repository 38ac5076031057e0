"""The limit of friction of a face with a shear strength, coulomb L[s] + c, over a stretch of contact.

c = sqrt(a² - x²) in scaled form: to a constant shear stress on a disc of the radius a belongs such a force of the
springs (Popov and Heß 2015). With a compression r of which L[r] = c, the limit is the force of a spring that is
compressed by q = coulomb s + r. So the friction of Coulomb (line.py, disc.py) is asked of q in the place of s.

Over a stretch c is the parabola through its values at the begin, the middle and the end, and r the parabola of which it
is the force. The root bends where the edge of contact passes. Where this advances, the spring sticks, but for a time
that `unseen` bounds (march/dynamics/limit.py); where it comes back, the spring slips, and of its force an area of the
order 3/2 in the step is missed.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.spring.path import FAST, LENT, Face
from mdr.tools.arrays import Array
from mdr.tools.jit import inner

SLOW = 0.01  #: part of its time, up to which an arm hardly relaxes

_inline = inner(forceinline=True, error_model="numpy", fastmath=FAST, **LENT)


class Faces(NamedTuple):
    """A Face over a period of n_t steps."""

    coulomb: float
    a2: Array  #: (n_t, 3) a_0, a_1, a_2 of each step


@_inline
def face_in(faces, k):
    """The face in step k; None where there is none."""
    if faces is None:
        return None
    return Face(faces.coulomb, faces.a2[k, 0], faces.a2[k, 1], faces.a2[k, 2])


@_inline
def face_later(face, t):
    """A face, its time counted from t on."""
    if face is None:
        return None
    a_0, a_1 = face.a_0 + t * (face.a_1 + t * face.a_2), face.a_1 + 2.0 * t * face.a_2
    return Face(face.coulomb, a_0, a_1, face.a_2)


@_inline
def strength(face, x2, t):
    """Addition of the strength to the limit of a spring at a time of the step; x2: its x², in the unit of a²."""
    return np.sqrt(max(face.a_0 + t * (face.a_1 + t * face.a_2) - x2, 0.0))


@_inline
def strengths(face, x2, begun, t):
    """Addition of the strength over a time t, as c_0 + c_1 u + c_2 u²."""
    c_0, middle, end = strength(face, x2, begun), strength(face, x2, begun + 0.5 * t), strength(face, x2, begun + t)
    return c_0, (4.0 * middle - 3.0 * c_0 - end) / t, 2.0 * (c_0 + end - 2.0 * middle) / (t * t)


@_inline
def raise_to_limit(s, i, z, c, t, coulomb, T, arms):
    """Turn the compression s[:, i], which goes on by z_1 u + z_2 u² for a time t, into q. Answers (q_1, q_2), of its
    displacement q_1 u + q_2 u².

    An arm that relaxes in so long a time that it hardly does in this one begins without stretch, as a spring beside the
    long-time one; what it relaxes is met to second order. Any other one goes along with r.
    """
    S, P, D, E = 1.0, 0.0, T, 0.0  # L[r] = S r + D r' - E r'', less P r' u²
    if arms is not None:
        for j in range(arms.rho.size):
            if arms.rate[j] * t < SLOW:
                S, P = S + arms.rho[j], P + 0.5 * arms.rho[j] * arms.rate[j]
            else:
                theta = 1.0 / arms.rate[j]
                D, E = D + arms.rho[j] * theta, E + arms.rho[j] * theta * theta
    r_1 = (c[1] - 2.0 * D * c[2] / S) / (S + 2.0 * D * P / S)
    r_2 = (c[2] + P * r_1) / S
    s[0, i] = coulomb * s[0, i] + c[0] - D * r_1 + 2.0 * E * r_2
    if arms is not None:
        for j in range(arms.rho.size):
            s[1 + j, i] *= coulomb
            if arms.rate[j] * t >= SLOW:
                s[1 + j, i] += (r_1 - 2.0 * r_2 / arms.rate[j]) / arms.rate[j]
    return coulomb * z[0] + r_1, coulomb * z[1] + r_2
