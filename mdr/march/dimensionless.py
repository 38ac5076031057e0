"""The scaled form of a sliding contact: what is left of it when units, mu_0 and the moduli are divided out.

Time is omega t, normal lengths are in du_z, tangential lengths in mu_0 kappa du_z, stiffnesses in that of the whole
array. In this form Coulomb's law has no coefficient and everything is a function of

    depth ratio u_z0/du_z,  v = v_0/(mu_0 kappa omega du_z),  T = omega tau,  body/contact stiffness ratios,  shape.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.case.depth_cycle import harmonic_sum
from mdr.march import loop
from mdr.march.body import N_BODY, RATE, RESOLVED, Body, Y, body_of, harmonics_of, light_harmonics_of
from mdr.materials.operator import Rheology
from mdr.normal.springs import SpringArray
from mdr.spring.law import Law, law_of
from mdr.spring.settle import NormalPeriod, settled
from mdr.tools.arrays import Array
from mdr.tools.memoise import remembered

RINGING_PASSES = 20  #: of the iteration for the oscillation of a body on springs with arms
FASTEST_START = 100.0  #: velocity of the body, over v_0, with which a march from full slip begins at most


@dataclass(frozen=True, eq=False)
class ScaledContact:
    """Arrays and floats that the march needs."""

    gap: Array  #: (n,) depth of each foot below the mean surface position, over du_z
    w: Array  #: (n,) share of each spring in the stiffness
    z: Array  #: (n_steps + 1,) normal motion over one period
    z_dot: Array  #: (n_steps + 1,) its rate
    x: Array  #: (n_steps + 1,) way on which a shake takes the indenter along the pull
    x_dot: Array  #: (n_steps + 1,) its rate
    far_end: Array  #: (n_steps + 1,) motion of the pulling point besides the pull; zero where the tool is shaken
    far_end_dot: Array  #: (n_steps + 1,) its rate
    is_shaken: bool  #: whether there is one
    rheology: Rheology  #: operator of the material, its times in units of 1/omega
    law: Law  #: the same, with its modes
    body: Body  #: the body over a step
    M: float  #: mass
    C: float  #: damping
    K: float  #: system stiffness; infinite under a rigid pull
    n_lumped: int  #: how many springs that stand alike the only one stands for
    n_core: int  #: how many of its own springs never lose contact
    length_x: float  #: tangential unit mu_0 kappa du_z [m]
    length_z: float  #: normal unit du_z [m]
    stiffness_x: float  #: tangential stiffness unit [N/m]
    stiffness_z: float  #: normal stiffness unit [N/m]
    omega: float  #: inverse time unit [rad/s]

    @property
    def steps(self) -> int:
        """Steps per period."""
        return self.z.size - 1

    @property
    def h(self) -> float:
        """Step of the phase."""
        return 2 * np.pi / self.steps

    @property
    def T(self) -> float:
        """omega tau of the Kelvin branch."""
        return self.rheology.T

    @property
    def remembers(self) -> bool:
        """Whether springs have a memory, dashpots or arms."""
        return self.rheology.remembers

    @property
    def rigid(self) -> bool:
        """Whether the body moves as it is pulled, whatever the force."""
        return self.body.rigid

    @property
    def pull_time(self) -> float:
        """Relaxation time c_x/k_x of the pull, in periods; 0 under a rigid pull."""
        return 0.0 if self.rigid else self.C / (2 * np.pi * self.K)

    @property
    def light(self) -> bool:
        """Whether the body takes at once, for these steps, the velocity that a spring gives it as it touches."""
        return self.body.light

    @property
    def ringing(self) -> float:
        """omega_1/omega of the body on springs that stick; infinite without mass, zero under a rigid pull."""
        return 0.0 if self.rigid else _ringing(self.M, self.K, self.rheology)

    @property
    def n_arms(self) -> int:
        """Maxwell arms of the material."""
        return len(self.rheology.rho)

    @property
    def first_look(self) -> int:
        """Periods after which it makes sense to ask whether a run has settled, or to look for its periodic state."""
        return 32 if self.M else 8

    @property
    def speed(self) -> float:
        """Unit of velocity mu_0 kappa omega du_z [m/s], which is Eq. (1)."""
        return self.length_x * self.omega

    @classmethod
    def of(cls, case: SlidingContact, springs: SpringArray, steps: int, lump: bool) -> ScaledContact:
        """Scale a case, its springs and its motion; lump the core that never leaves into its first spring if asked."""
        cycle, kappa, rheology = case.cycle, case.material.mindlin_ratio, case.rheology
        width = float(springs.width.sum())
        gap, w, n_lumped = springs.gap / cycle.unit, springs.width / width, 1
        n_core = springs.n_core
        if lump and gap.max() == gap.min():  # springs that stand alike do alike
            gap, w, n_lumped, n_core = gap[:1], np.ones(1), gap.size, min(n_core, 1)
        length_x = case.mu_0 * kappa * cycle.unit
        z, z_dot = cycle.over_a_period(steps)
        way = case.way
        if not np.isfinite(way).all():
            raise ValueError(
                "the pulling point is shaken at the undamped natural frequency of the body: in full slip there is no "
                "periodic motion to begin with; give the pull a damper c_x, or move omega or m"
            )
        x, x_dot = _over_a_period(way / length_x, steps)
        at_pull = case.shake is not None and case.shake.at == "pull" and not case.pull.is_rigid
        far_end, far_end_dot = _over_a_period(case.shake_harmonics[: None if at_pull else 0] / length_x, steps)
        M, C, K = _body_groups(case, springs.G_star * width)
        law = law_of(rheology.T, rheology.rho, rheology.theta)
        return cls(
            gap=gap,
            w=w,
            z=z,
            z_dot=z_dot,
            x=x,
            x_dot=x_dot,
            far_end=far_end,
            far_end_dot=far_end_dot,
            is_shaken=case.is_shaken,
            rheology=rheology,
            law=law,
            body=body_of(
                M, C, K, law, 2 * np.pi / steps, _ringing(M, K, rheology) * 2 * np.pi / steps > 2 * np.pi / RESOLVED
            ),
            M=M,
            C=C,
            K=K,
            n_lumped=n_lumped,
            n_core=n_core,
            length_x=length_x,
            length_z=cycle.unit,
            stiffness_x=springs.G_star * width,
            stiffness_z=springs.E_star * width,
            omega=cycle.omega,
        )

    @cached_property
    def normal(self) -> NormalPeriod:
        """The springs in their periodic normal motion."""
        found = settled(self.gap, self.w, self.z, self.z_dot, self.law)
        if found is None:
            raise ValueError(
                f"steps_per_period = {self.steps} is too coarse for the normal motion of springs with these arms, "
                "which does not become periodic; raise it"
            )
        return found

    @property
    def springs(self) -> loop.Springs:
        """The springs as the march takes them."""
        return loop.Springs(self.gap, self.w)

    def motion(self, v: float) -> loop.Motion:
        """The way of the indenter over a period, in the plane that of a pull at the velocity v and of a shake."""
        return loop.Motion(self.z, self.z_dot, v, self.x, self.x_dot)

    def trace(self, n_periods: int = 1) -> loop.Trace:
        """Room for what a march leaves of its steps."""
        return loop.Trace(*np.empty((4, n_periods * self.steps)))

    def pace(self, v: float) -> float:
        """A scale of velocities where the pull is at v: this, or that of the shake if it is faster."""
        return max(v, float(np.abs(self.x_dot).max()))

    def full_slip_state(self, v: float = np.inf) -> Array:
        """State (N_BODY,) of the body at phase 0 that repeats itself under the force of full slip.

        Harmonic by harmonic, with the response of the steps themselves, so that the march starts without any
        free oscillation. On an undamped resonance the resonant harmonic is left out: no periodic motion has it. Near a
        resonance a harmonic that would carry the body back faster than FASTEST_START v is cut to that velocity.
        """
        if self.rigid:
            return np.zeros(N_BODY)
        most = FASTEST_START * self.pace(v)
        motion, _ = self._full_slip_motion
        cut = most / np.maximum(self._velocities, most) if np.isfinite(most) else 1.0
        return self._state(motion * cut)

    def resonant_state(self, v: float) -> Array | None:
        """State of the body at phase 0 on an undamped resonance or beside one. The resonant harmonic, the n-th, swings
        as far as stick lets it: y' reaches -v, once in each of its own periods, when that harmonic of the force is
        greatest.
        None where no harmonic moves the body faster than FASTEST_START v, and where the force does not contain it.
        """
        if self.rigid:
            return None
        motion, resonant = self._full_slip_motion
        n = int(np.flatnonzero(resonant)[0]) if resonant.any() else int(np.argmax(self._velocities))
        F_n = complex(self._force[n])
        far = resonant[n] or self._velocities[n] > FASTEST_START * self.pace(v)
        if n == 0 or abs(F_n) < 1e-10 * abs(self.normal.mean) or not far:
            return None
        motion = motion.copy()
        motion[:, n] = 0
        state, phase = self._state(motion), np.angle(F_n)
        state[Y] += abs(F_n) / self.K - v / n * np.sin(phase)  # and the mean force it takes away
        state[RATE] -= v * np.cos(phase)
        return state

    @cached_property
    def end_of_full_slip(self) -> float:
        """Velocity below which the periodic motion of full slip would stick, to the accuracy of the steps; infinite on
        a resonance that the force drives.

        In full slip for good the body has this motion and a free oscillation. That is in another phase in every period,
        so that it cannot keep all of them from stick: below this velocity full slip does not last (but where the free
        oscillation is a whole multiple of the drive).
        """
        if self.rigid:
            return 0.0
        motion, resonant = self._full_slip_motion
        if (resonant & (np.abs(self._force) > 1e-10 * abs(self.normal.mean)))[1:].any():
            return np.inf
        y_dot = np.fft.irfft(motion[1], self.steps)
        presses = self.normal.area > 0
        touching = presses & np.roll(presses, 1)  # contact at the node between two steps
        return float((self.z_dot[:-1] - self.x_dot[:-1] - y_dot)[touching].max(initial=0.0))

    def _state(self, motion: NDArray[np.complex128]) -> Array:
        """State at phase 0 of a body with these harmonics (2, N), under the force of full slip."""
        return np.asarray(np.fft.irfft(motion, self.steps)[:, 0])

    @cached_property
    def _force(self) -> NDArray[np.complex128]:
        """Harmonics of the mean force of each step in full slip, as of rfft over the number of steps."""
        return np.asarray(np.fft.rfft(self.normal.area) / (self.h * self.steps))

    @cached_property
    def _full_slip_motion(self) -> tuple[NDArray[np.complex128], NDArray[np.bool_]]:
        """Harmonics (2, N) of y and its rate in full slip, as of rfft, and which of them are resonances."""
        if self.light:
            return light_harmonics_of(self.body, np.fft.rfft(self.normal.area), np.fft.rfft(self.normal.end))
        return harmonics_of(self.body, np.fft.rfft(self.normal.area), np.fft.rfft(self.normal.moment))

    @property
    def _velocities(self) -> Array:
        """Amplitude of the velocity that each harmonic of the motion has."""
        y = self._full_slip_motion[0][0]
        return np.asarray(2 * np.arange(y.size) * np.abs(y) / self.steps)

    def rest_state(self, v: float) -> Array:
        """State of a body at rest with nothing stretched, from which the pull sets off at v."""
        state = np.zeros(N_BODY)
        state[RATE] = 0.0 if self.rigid else -v
        return state


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
    M, _, K = _body_groups(case, float(case.indenter.stiffness(case.u_z_max, case.material.G_star)))
    return _ringing(M, K, case.rheology)


def _ringing(M: float, K: float, rheology: Rheology) -> float:
    """omega_1/omega of a body on springs that stick, infinite without mass: its oscillation is so fast that arms which
    relax more slowly add their stiffness.

    Stiffness rises with frequency, so that the iteration falls from that of all arms to the greatest solution.
    """
    if M == 0:
        return np.inf
    fast = float(np.sqrt((K + 1 + sum(rheology.rho)) / M))
    for _ in range(RINGING_PASSES if rheology.rho else 0):
        fast = float(np.sqrt((K + rheology.response(fast).real) / M))
    return fast


def _body_groups(case: SlidingContact, stiffness: float) -> tuple[float, float, float]:
    (m, c_x, k_x), omega = case.pull.coefficients, case.omega
    return m * omega**2 / stiffness, c_x * omega / stiffness, k_x / stiffness
