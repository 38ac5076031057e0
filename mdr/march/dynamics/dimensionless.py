"""The scaled form of a sliding contact: what is left of it when units, mu_0 and the moduli are divided out.

Time is omega t, normal lengths are in du_z, tangential lengths in mu_0 kappa du_z (with a shear strength in more, see
Units), stiffnesses in that of the whole array. In this form Coulomb's law alone has no coefficient, and everything is a
function of

    depth ratio u_z0/du_z,  v = v_0/(mu_0 kappa omega du_z),  T = omega tau,  body/contact stiffness ratios,  shape.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.case.depth_cycle import harmonic_sum
from mdr.march.dynamics import loop
from mdr.march.dynamics.body import Body, body_of
from mdr.march.dynamics.full_slip import FullSlip
from mdr.march.dynamics.kernel import Is, Kernel, block_of
from mdr.march.dynamics.limit import Limit, strengths_of
from mdr.materials.operator import SLOWEST, Rheology
from mdr.normal.springs import SpringArray
from mdr.spring.contact import Springs
from mdr.spring.law import Law, law_of
from mdr.spring.limit import Strengths
from mdr.spring.path import ROUNDING
from mdr.spring.settle import NormalPeriod, settled
from mdr.tools.arrays import Array
from mdr.tools.memoise import remembered

LOST = 10 * ROUNDING  #: of a length, displacement of a spring in a step that is not told from rounding
RINGING_PASSES = 20  #: of the iteration for the oscillation of a body on springs with arms


@dataclass(frozen=True)
class Units:
    """Units of the scaled form, in SI."""

    length_x: float  #: tangential: mu_0 kappa du_z, and with a shear strength 2 tau_0 a/G* more [m]
    length_z: float  #: normal: du_z [m]
    stiffness_x: float  #: of all springs, tangential [N/m]
    stiffness_z: float  #: normal [N/m]
    omega: float  #: inverse time [rad/s]

    @property
    def speed(self) -> float:
        """Velocity [m/s] of this length: mu_0 kappa omega du_z of Eq. (1)."""
        return self.length_x * self.omega

    @property
    def energy_x(self) -> float:
        """Energy [J] of tangential springs."""
        return self.stiffness_x * self.length_x**2

    @property
    def energy_z(self) -> float:
        """Energy [J] of normal springs."""
        return self.stiffness_z * self.length_z**2


@dataclass(frozen=True, eq=False)
class AxisMotion:
    """A shake along one axis over one period of n_steps steps: arrays (n_steps + 1,), both ends included."""

    x: Array  #: displacement of the indenter
    x_dot: Array  #: its rate
    far_end: Array  #: motion of the pulling point besides the pull; zero where the tool is shaken
    far_end_dot: Array  #: its rate


@dataclass(frozen=True, eq=False)
class Drive:
    """Imposed motion over one period of n_steps steps: arrays (n_steps + 1,), both ends included."""

    z: Array  #: normal motion
    z_dot: Array  #: its rate
    along: AxisMotion  #: shake along the pull
    across: AxisMotion | None  #: across it; None where friction does not turn
    is_shaken: bool  #: whether there is a shake

    @property
    def steps(self) -> int:
        """Steps per period."""
        return self.z.size - 1

    @property
    def h(self) -> float:
        """Step of the phase."""
        return 2 * np.pi / self.steps

    def pace(self, v: float) -> float:
        """A scale of velocities where the pull is at v: this, or that of the shake if it is faster."""
        axes = [self.along] if self.across is None else [self.along, self.across]
        return max(v, *(float(np.abs(axis.x_dot).max()) for axis in axes))

    def with_pull(self, v: float) -> loop.Motion:
        """Motion of the indenter over a period, in the plane that of a pull at the velocity v and of a shake."""
        x, x_dot = self.along.x, self.along.x_dot
        if self.across is not None:
            x, x_dot = x + 1j * self.across.x, x_dot + 1j * self.across.x_dot
        return loop.Motion(self.z, self.z_dot, v, x, x_dot)

    @classmethod
    def of(cls, case: SlidingContact, length_x: float, steps: int) -> Drive:
        """The imposed motion of a contact."""
        axes = [(case.way, case.shake_harmonics)]
        if case.moves_across:
            axes += [(case.way_across, case.harmonics_across)]
        if not all(np.isfinite(x).all() for x, _ in axes):
            raise ValueError(
                "the pulling point is shaken at the undamped natural frequency of the body: in full slip there is no "
                "periodic motion to begin with; give the pull a damper, or move omega or m"
            )
        at_pull = case.shake is not None and case.shake.at == "pull" and not case.pull.is_rigid
        along, *across = (
            AxisMotion(*_over_a_period(x / length_x, steps), *_over_a_period(at_pull * far_end / length_x, steps))
            for x, far_end in axes
        )
        return cls(*case.cycle.over_a_period(steps), along, across[0] if across else None, case.is_shaken)


@dataclass(frozen=True, eq=False)
class Slow:
    """Slow arms: a period does not tell them from springs, which have relaxed about the mean of their spring.

    Such an arm bears rho (s - m), m the mean of s over a period; and so across. Beside the spring it is a stiffer one,
    1 + rho, of a compression s - rho m/(1 + rho), under which the surface lies as much deeper; and of an extension that
    is less by a constant as well, which does not matter to friction.
    """

    rho: float  #: their stiffness over the long-time one
    sunk: Array  #: (n,) by which gaps are greater

    @property
    def error(self) -> float:
        """Of the COF over mu_0: what these arms, of 1/SLOWEST or less, relax within a period."""
        return self.rho / (1 + self.rho) / SLOWEST

    @classmethod
    def of(cls, rheology: Rheology, row: Springs, drive: Drive) -> Slow:
        """Of springs in their periodic normal motion."""
        if not rheology.slow:
            return cls(0.0, np.zeros_like(row.gap))
        s = _settled(row, drive, law_of(rheology.T, rheology.rho, rheology.theta)).s
        return cls(rheology.slow, rheology.slow / (1 + rheology.slow) * (s[0] - s[1]))


@dataclass(frozen=True, eq=False)
class ScaledContact:
    """The parts of a contact that the march needs."""

    units: Units
    springs: Springs
    strengths: Strengths | None  #: the limit of friction, as steps know it
    slow: Slow  #: what slow arms have made of stiffness and gaps
    n_alike: int  #: how many springs that stand alike the only one stands for
    drive: Drive
    rheology: Rheology  #: operator of the material, its times in units of 1/omega
    law: Law  #: the same, with its modes
    body: Body  #: the body over a step
    body_across: Body  #: across the pull; rigid where it is guided

    @property
    def n_axes(self) -> int:
        """Directions in the plane in which springs are stretched."""
        return 1 if self.drive.across is None else 2

    @property
    def light(self) -> bool:
        """Whether a body moves as a light one (body.py) in some direction."""
        return self.body.light or self.body_across.light

    @property
    def in_plane(self) -> Is:
        """Whether they are vectors of the plane, as a kernel is told."""
        return None if self.drive.across is None else True

    @classmethod
    def of(cls, case: SlidingContact, springs: SpringArray, steps: int, lump: bool) -> ScaledContact:
        """Scale a case, its springs and its motion; springs that all stand alike become one if asked."""
        unit, width, rheology = case.cycle.unit, float(springs.width.sum()), case.rheology
        row, n_alike = Springs(springs.gap / unit, springs.width / width), 1
        if lump and case.gap_tells_limit and row.gap.max() == row.gap.min():
            row, n_alike = Springs(row.gap[:1], np.ones(1)), row.gap.size
        length_x = case.unit_length
        drive = Drive.of(case, length_x, steps)
        slow = Slow.of(rheology, row, drive)
        row, rheology, width = Springs(row.gap + slow.sunk, row.w), rheology.without_slow, width * (1 + slow.rho)
        units = Units(length_x, unit, springs.G_star * width, springs.E_star * width, case.omega)
        law = law_of(rheology.T, rheology.rho, rheology.theta)
        strengths = strengths_of(case, springs, row.gap.size, 1 + slow.rho, length_x, steps)
        body, across = (
            body_of(M, C, K, law, drive.h, _ringing(M, K, rheology))
            for M, C, K in (
                _body_groups(case, units.stiffness_x, across) if moves else (0.0, 0.0, np.inf)
                for across, moves in ((False, True), (True, case.moves_across))
            )
        )
        return cls(units, row, strengths, slow, n_alike, drive, rheology, law, body, across)

    @cached_property
    def normal(self) -> NormalPeriod:
        """The springs in their periodic normal motion."""
        return _settled(self.springs, self.drive, self.law)

    @cached_property
    def limit(self) -> Limit:
        """The most that friction bears."""
        return Limit.of(self.normal, self.springs, self.drive.z, self.drive.z_dot, self.rheology, self.strengths)

    @cached_property
    def greatest_force(self) -> Array:
        """Bound on the friction of each spring in the period, (n,)."""
        return self.springs.w * self.limit.greatest

    @cached_property
    def order(self) -> NDArray[np.intp]:
        """Of the springs by rising gaps, (n,)."""
        return np.argsort(self.springs.gap, kind="stable")

    @cached_property
    def hidden_pull(self) -> float:
        """Displacement of a pull over a period that is not told from rounding."""
        return self.drive.steps * LOST * (1.0 + float(np.abs(self.springs.gap).max()))

    @cached_property
    def at_stake(self) -> float:
        """Share of full slip that the oscillation can take: where there is no shake, what the least force lacks."""
        return 1.0 if self.drive.is_shaken else max(1 - float(self.limit.end.min()) / self.limit.mean, 0.0)

    @property
    def full_slip_force(self) -> tuple[loop.FullSlipForce | None, Array | None]:
        """Force of the springs over each step, if all slip forward, and times of flight; None where not needed."""
        if self.body.rigid or self.n_axes == 2:
            return None, None
        limit, flight = self.limit, self.normal.flight if self.body.light else None
        return limit.force, flight

    @cached_property
    def full_slip(self) -> FullSlip:
        """The body in full slip."""
        return FullSlip(self.body, self.limit, self.limit.rate - self.drive.along.x_dot, self.drive.pace(0.0))

    @cached_property
    def in_numbers(self) -> tuple[Kernel, Array]:
        """The kernel that marches it, and its block: all that this has to know but the velocity."""
        bodies = self.body, self.body_across
        motion = self.drive.with_pull(0.0)
        return block_of(self.springs, motion, self.law, self.strengths, bodies, *self.full_slip_force)


def _settled(row: Springs, drive: Drive, law: Law) -> NormalPeriod:
    found = settled(row.gap, row.w, drive.z, drive.z_dot, law)
    if found is None:
        raise ValueError(
            f"steps_per_period = {drive.steps} is too coarse for the normal motion of springs with these "
            "arms, which does not become periodic; raise it"
        )
    return found


def _over_a_period(harmonics: NDArray[np.complex128], steps: int) -> tuple[Array, Array]:
    """The sum of harmonics and its rate at equidistant phases, both ends included: (steps + 1,)."""
    if not harmonics.size:
        return np.zeros(steps + 1), np.zeros(steps + 1)
    phase, n = 2 * np.pi * np.arange(steps + 1) / steps, np.arange(1, harmonics.size + 1)
    return harmonic_sum(harmonics, phase), harmonic_sum(1j * n * harmonics, phase)


@remembered(maxsize=64)
def fast_ratio(case: SlidingContact) -> float:
    """omega_1/omega of the body on the fully pressed contact; infinite without mass, zero for a rigid pull."""
    if case.pull.is_rigid:
        return 0.0
    return max(_ringing(M, K, case.rheology) for M, K in _bodies(case))


@remembered(maxsize=64)
def stopping_rate(case: SlidingContact) -> float:
    """Rate over omega at which the dashpots of the fully pressed contact stop the body; infinite without mass."""
    return 0.0 if case.pull.is_rigid else max(case.T / M if M else np.inf for M, _ in _bodies(case))


def _bodies(case: SlidingContact) -> list[tuple[float, float]]:
    """Mass and stiffness, in scaled form on the fully pressed contact, in each direction in which a body moves."""
    stiffness = float(case.indenter.stiffness(case.u_z_max, case.material.G_star))
    groups = [_body_groups(case, stiffness, across) for across in (False, True)][: 1 + case.moves_across]
    return [(M, K) for M, _, K in groups if np.isfinite(K)]


def _ringing(M: float, K: float, rheology: Rheology) -> float:
    """omega_1/omega of a body on springs that stick, infinite without mass: its oscillation is so fast that arms which
    relax more slowly add their stiffness.

    Stiffness rises with frequency, so that the iteration falls from that of all arms to the greatest solution.
    """
    if M == 0 or np.isinf(K):
        return np.inf
    fast = float(np.sqrt((K + 1 + sum(rheology.rho)) / M))
    for _ in range(RINGING_PASSES if rheology.rho else 0):
        fast = float(np.sqrt((K + rheology.response(fast).real) / M))
    return fast


def _body_groups(case: SlidingContact, stiffness: float, across: bool) -> tuple[float, float, float]:
    (m, c, k), omega = case.pull.across if across else case.pull.coefficients, case.omega
    return m * omega**2 / stiffness, c * omega / stiffness, k / stiffness
