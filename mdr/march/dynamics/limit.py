"""The most that friction bears, spring by spring over a period, in scaled form: the normal force, and what a shear
strength adds (spring/limit.py), which hangs on the radius of contact at every instant (normal_force.py).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.march.dynamics.loop import FullSlipForce, full_slip
from mdr.materials.operator import Rheology
from mdr.normal.normal_force import contact_radius, first_radius
from mdr.normal.springs import SpringArray
from mdr.spring.contact import Springs
from mdr.spring.law import law_of
from mdr.spring.limit import Strengths
from mdr.spring.settle import NormalPeriod
from mdr.tools.arrays import Array

SEEN = 4.0  #: steps that the stick of a spring at the edge has to last for steps to see it


@dataclass(frozen=True, eq=False)
class Limit:
    """The most that n springs with J arms bear over a period of n_t steps; not to be written to."""

    gap: Array  #: (n,) of the springs
    bears: Strengths  #: what they bear; of Coulomb's friction a strength of nothing
    #: whether the gap of a spring tells its limit: one stands for all of a gap, and all have one rate in full slip
    gap_tells: bool
    modulus: float  #: of a spring at once over the long-time one; infinite with a dashpot
    s: Array  #: (1 + J, n) extensions, and arms, of springs in full slip at its start
    most: Array  #: (n,) the longest that extensions can be there
    greatest: Array  #: (n,) bound on the extension at the limit in the period
    area: Array  #: (n_t,) area of the force of full slip over each step
    moment: Array  #: (n_t,) its moment about the start of the step
    end: Array  #: (n_t,) the force at the end of each step
    #: (n_t + 1,) rate of the extension of springs that press, in full slip; beside a strength of the one in the middle
    rate: Array

    @cached_property
    def mean(self) -> float:
        """Mean force of full slip over the period."""
        return float(self.area.sum()) / (2 * np.pi)

    @property
    def falls(self) -> bool:
        """Whether friction falls as springs are let go."""
        return bool(self.bears.stick[0] > 1)

    @property
    def order(self) -> float:
        """Order in the step to which the force is met: a root that bends at the edge of contact lowers it."""
        return 2.0 if self.gap_tells else 1.5

    @property
    def force(self) -> FullSlipForce | None:
        """The force of full slip, where it is that of a step too: with a strength it follows from the motion."""
        return FullSlipForce(self.area, self.moment, self.end) if self.gap_tells else None

    @property
    def hides_stick(self) -> bool:
        """Whether springs may stick at the edge of contact for a time that steps do not see. With a dashpot, no limit
        grows like a root.
        """
        return not self.gap_tells and bool(np.isfinite(self.modulus))

    @classmethod
    def of(
        cls, normal: NormalPeriod, springs: Springs, z: Array, z_dot: Array, rheology: Rheology, bears: Strengths | None
    ) -> Limit:
        """That of springs in this normal motion."""
        deepest, modulus = np.maximum(z.max() - springs.gap, 0.0), np.inf if rheology.T else 1.0 + sum(rheology.rho)
        if bears is None or bears.stick[0] > 1:  # in full slip friction that falls is Coulomb's
            bears, force = bears or coulombs(springs.gap.size, z.size - 1), (normal.area, normal.moment, normal.end)
            most = float(bears.stick[0])
            return cls(springs.gap, bears, True, modulus, normal.s, normal.s[0], most * deepest, *force, z_dot)
        coulomb, x2, a2 = bears[:3]
        law, e, sums = law_of(rheology.T, rheology.rho, rheology.theta), coulomb * normal.s, np.empty((3, z.size - 1))
        e[0] += added(x2, a2[0, 0]) * (normal.s[0] <= z[0] - springs.gap)
        if law.modes is not None:  # what a period leaves of a difference is forgotten mode by mode
            after, left = e.copy(), np.exp(-2 * np.pi * law.modes.mu)
            full_slip(after, normal.s.copy(), springs, bears, z, z_dot, law, sums)
            e += after - e + law.modes.out @ ((left / (1 - left))[:, None] * law.modes.into) @ (after - e)
        full_slip(e.copy(), normal.s.copy(), springs, bears, z, z_dot, law, sums)
        area, moment, end = sums
        c = np.sqrt(a2[:, 0]) * (area > 0)
        r = np.fft.irfft(np.fft.rfft(c) / rheology.response(np.arange(c.size // 2 + 1)), c.size)
        rate = coulomb * z_dot + np.diff(np.append(r, r[:2])) / (2 * np.pi / c.size)
        most, greatest = np.maximum(e[0], 0.0), coulomb * deepest + added(x2, a2[:, 0].max())
        return cls(springs.gap, bears, False, modulus, e, most, greatest, area, moment, end, rate)

    def beside(self, step: NDArray[np.int_]) -> dict[str, Array]:
        """What springs in contact bear besides their share of the normal force, by its name, at the ends of steps (m,)
        of the period: (m, n) over their stiffness.
        """
        a2 = np.roll(self.bears.a2[:, 0], -1)[step, None]
        return {} if self.gap_tells else {"strength": added(self.bears.x2, a2)}

    def borne(self, press: Array) -> Iterator[Array]:
        """The most that each spring bears at the ends of steps at which L[z] is press, (n_t,): nothing in flight."""
        coulomb, x2, a2, stick = self.bears[:4]
        for gap, one in zip(self.gap, x2, strict=True):
            yield stick * np.where(press > gap, coulomb * (press - gap) + added(one, np.roll(a2[:, 0], -1)), 0.0)

    def unseen(self, top: Array, z_dot: Array) -> float:
        """Friction lost at the advancing edge of contact, below the resolution of the steps, over that of full slip.

        Such a spring has the limit sqrt(2 a a' t), and sticks until its top, less Coulomb's part, has stretched it so
        far: at the velocity v for 2 a a'/v² at this modulus. That costs a sixth of v times its square. top, z_dot
        (n_t,): how fast the tops move, whatever moves them, and the depth.
        """
        coulomb, _, a2 = self.bears[:3]
        pull, grows = self.modulus * np.maximum(top - coulomb * z_dot, 0.0), np.maximum(a2[:, 1], 0.0)
        h = 2 * np.pi / len(a2)
        with np.errstate(divide="ignore", invalid="ignore"):
            lasts = grows / pull**2
            passed = h * grows / (2 * np.sqrt(a2[:, 0] * a2[:, 0].max()))  # share of the springs
            lost = np.where((lasts < SEEN * h) & (grows > 0), passed * pull * lasts**2 / 6, 0.0)
        return float(lost.sum()) / (2 * np.pi * self.mean)


def added(x2: Array, a2: Array) -> Array:
    """What a strength adds to the limits of springs at x, at instants at which the radius of contact is a."""
    return np.sqrt(np.maximum(a2 - x2, 0.0))


def coulombs(n: int, steps: int, stick: float = 1.0) -> Strengths:
    """The limit of n springs that bear a share of their normal force alone, and stick up to a multiple of that."""
    return Strengths(np.ones(1), np.zeros(n), np.zeros((steps, 3)), np.array([stick]))


def strengths_of(
    case: SlidingContact, springs: SpringArray, n: int, stiffer: float, length_x: float, steps: int
) -> Strengths | None:
    """The limit of a contact over a period, as steps know it; None of Coulomb's friction.

    n: how many of the springs are marched. stiffer: what slow arms multiply the stiffness of springs by. length_x: unit
    of tangential lengths [m].
    """
    law = case.friction
    if not law.needs_area:
        return coulombs(n, steps, law.stick) if law.stick > 1 else None
    a = float(law.strong_radius(case.indenter.contact_radius(case.u_z_max)))
    x = np.where(springs.x == springs.x.min(), np.minimum(springs.x, 0.5 * a), springs.x)  # one bears the least disc
    # sum of 2 sqrt(a² - x²) over the springs, over its integral pi a²: a strength acts on the whole disc
    share = float(springs.width @ added(x**2, np.asarray(a**2))) * 2 / (np.pi * a**2)
    unit = share * length_x * springs.G_star * stiffer / (2 * law.tau_0)  # radius that adds length_x in the middle
    # without contact that of a first touch: a flat face has all of its radius at once, whenever in a step that is
    radius = contact_radius(case, np.pi / steps * np.arange(2 * steps + 1.0))
    a2 = (law.strong_radius(np.maximum(radius, first_radius(case))) / unit) ** 2
    begin, middle, end, h = a2[:-1:2], a2[1::2], a2[2::2], 2 * np.pi / steps
    parabola = np.column_stack([begin, (4 * middle - 3 * begin - end) / h, 2 * (begin + end - 2 * middle) / h**2])
    coulomb = law.mu_0 * case.material.mindlin_ratio * case.cycle.unit / length_x
    return Strengths(np.array([coulomb]), (x / unit) ** 2, parabola)
