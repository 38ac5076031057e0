"""The most that friction bears, spring by spring over a period, in scaled form: the normal force, and what a shear
strength of the face adds (spring/face.py), which hangs on the radius of contact at every instant (normal_force.py).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.march.dynamics.loop import full_slip
from mdr.normal.normal_force import contact_radius, first_radius
from mdr.spring.contact import Springs
from mdr.spring.face import Faces
from mdr.spring.law import Law
from mdr.spring.settle import NormalPeriod
from mdr.tools.arrays import Array

SEEN = 4.0  #: steps that the stick of a spring at the edge has to last for steps to see it


@dataclass(frozen=True, eq=False)
class Limit:
    """The most that n springs with J arms bear over a period of n_t steps; not to be written to."""

    s: Array  #: (1 + J, n) extensions, and arms, of springs in full slip at its start
    most: Array  #: (n,) the longest that extensions can be there
    greatest: Array  #: (n,) bound on the extension at the limit in the period
    area: Array  #: (n_t,) area of the force of full slip over each step
    moment: Array  #: (n_t,) its moment about the start of the step
    end: Array  #: (n_t,) the force at the end of each step

    @cached_property
    def mean(self) -> float:
        """Mean force of full slip over the period."""
        return float(self.area.sum()) / (2 * np.pi)

    @classmethod
    def of(cls, normal: NormalPeriod, springs: Springs, z: Array, z_dot: Array, law: Law, faces: Faces | None) -> Limit:
        """That of springs in this normal motion."""
        deepest = np.maximum(z.max() - springs.gap, 0.0)
        if faces is None or springs.x2 is None:
            return cls(normal.s, normal.s[0], deepest, normal.area, normal.moment, normal.end)
        strength = np.sqrt(np.maximum(faces.a2[0, 0] - springs.x2, 0.0)) * (normal.s[0] <= z[0] - springs.gap)
        e, sums = faces.coulomb * normal.s, np.empty((3, z.size - 1))
        e[0] += strength
        if law.modes is not None:  # what a period leaves of a difference is forgotten mode by mode
            after, left = e.copy(), np.exp(-2 * np.pi * law.modes.mu)
            full_slip(after, normal.s.copy(), springs, z, z_dot, law, faces, sums)
            e += after - e + law.modes.out @ ((left / (1 - left))[:, None] * law.modes.into) @ (after - e)
        full_slip(e.copy(), normal.s.copy(), springs, z, z_dot, law, faces, sums)
        greatest = faces.coulomb * deepest + np.sqrt(np.maximum(faces.a2[:, 0].max() - springs.x2, 0.0))
        return cls(e, np.maximum(e[0], 0.0), greatest, *sums)


def borne(faces: Faces, gap: float, x2: float, press: Array) -> Array:
    """The most that a spring bears at the ends of steps at which L[z] is press, (n_t,): nothing in flight."""
    strength = np.sqrt(np.maximum(np.roll(faces.a2[:, 0], -1) - x2, 0.0))
    return np.where(press > gap, faces.coulomb * (press - gap) + strength, 0.0)


def unseen(faces: Faces | None, rate: Array, top: Array, modulus: float, limit: Limit) -> float:
    """Share of full slip that springs lose which the edge of contact has just reached, in steps too long to see it.

    Such a spring has the limit sqrt(2 a a' t), and sticks until its top, less Coulomb's part, has stretched it so far:
    at the velocity v for 2 a a'/v² at this modulus. That costs a sixth of v times its square. top (n_t,): how fast the
    tops move, whatever moves them; rate (n_t,): of Coulomb's part.
    """
    if faces is None or not np.isfinite(modulus):
        return 0.0
    a2, h = faces.a2, 2 * np.pi / len(faces.a2)
    pull, grows = modulus * np.maximum(top - rate, 0.0), np.maximum(a2[:, 1], 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        lasts = grows / pull**2
        passed = h * grows / (2 * np.sqrt(a2[:, 0] * a2[:, 0].max()))  # share of the springs
        lost = np.where((lasts < SEEN * h) & (grows > 0), passed * pull * lasts**2 / 6, 0.0)
    return float(lost.sum()) / (2 * np.pi * limit.mean)


def faces_of(case: SlidingContact, unit: float, coulomb: float, steps: int) -> Faces | None:
    """The face of a contact over a period; None without a shear strength.

    unit: radius [m] that adds one unit of tangential length to the limit of the spring in the middle.
    """
    if not case.tau_0:
        return None
    # without contact that of a first touch: a flat face has all of its radius at once, whenever in a step that is
    radius = contact_radius(case, np.pi / steps * np.arange(2 * steps + 1.0))
    a2 = (np.maximum(radius, first_radius(case)) / unit) ** 2
    begin, middle, end, h = a2[:-1:2], a2[1::2], a2[2::2], 2 * np.pi / steps
    parabola = np.column_stack([begin, (4 * middle - 3 * begin - end) / h, 2 * (begin + end - 2 * middle) / h**2])
    return Faces(coulomb, parabola)
