"""The scaled form of a sliding contact: what is left of it when units, mu_0 and the moduli are divided out.

Time is omega t, normal lengths are in du_z, tangential lengths in mu_0 kappa du_z, stiffnesses in that of the whole
array. In this form Coulomb's law has no coefficient and everything is a function of

    depth ratio u_z0/du_z,  v = v_0/(mu_0 kappa omega du_z),  T = omega tau,  body/contact stiffness ratios,  shape.

The body obeys M y'' + C y' + K y = -(S + T S' + sum_j rho_j P_j), S the sum of w e over the springs and P_j that of
its Maxwell arms. Over a step h it is advanced

* exactly as an oscillator under the mean force of the step, (S_0 + S_1)/2 + T (S_1 - S_0)/h and the means of the arms,
  whose impulse is right even when the force of a dashpot jumps: no dispersion of its own natural frequency, second
  order in the force;
* without mass, or where the step cannot resolve the fast oscillation omega_1 = sqrt((k_x + k_xc)/m), by backward
  differences of second order, which damp what the step does not resolve.

As an arm follows S linearly within a step, either way it is one recursion with five numbers and two for each arm,
y_new = a_1 y + a_2 y_old - (b_1 S_new + b_0 S + b_m S_old) - sum_j (b_j P_j + bm_j P_j,old).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.case.depth_cycle import harmonic_sum
from mdr.march import kernels
from mdr.materials.operator import L_DECAY, L_GAIN, Rheology
from mdr.normal.springs import SpringArray
from mdr.tools.arrays import Array

FASTEST_START = 100.0  #: velocity of the body, over v_0, with which a march from full slip begins at most
RESOLVED = 32  #: steps per fast oscillation from which on it counts as resolved
RINGING_PASSES = 20  #: of the iteration for that oscillation on springs with arms


@dataclass(frozen=True, eq=False)
class NormalState:
    """The springs in their periodic normal motion, in which friction has no part; not to be written to."""

    s: Array  #: (1 + J, n) compressions at phase 0, and their arms
    spans: NDArray[np.int64]  #: (2, n_steps) of springs that press, or are free, throughout a step
    S: Array  #: (n_steps,) sum of w s, as the march has that of w e; in full slip, where e = s, the same
    load: float  #: mean of F_z over the period, of the nodes alone: where springs touch they miss both ways

    @cached_property
    def mean(self) -> float:
        """Mean of S over the period, by which the COF divides: that of F_z but for the second order in the step."""
        return float(self.S.mean())


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
    is_shaken: bool  #: whether there is one
    rheology: Rheology  #: operator of the material, its times in units of 1/omega
    table: Array  #: (L_ROWS, 1 + J) the same over one step
    body: kernels.Body  #: recursion of the body
    M: float  #: mass
    C: float  #: damping
    K: float  #: system stiffness; infinite under a rigid pull
    lump_margin: float  #: the first spring stands for the core while L[e + s] exceeds this
    n_lumped: int  #: how many springs of the array the first one stands for
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
        gap, w, margin, n_lumped = springs.gap / cycle.unit, springs.width / width, -np.inf, 1
        core, n_core = gap[: springs.n_core], springs.n_core
        if lump and gap.max() == gap.min():  # springs that stand alike do alike
            gap, w, n_lumped, n_core = gap[:1], np.ones(1), gap.size, min(n_core, 1)
        elif lump and core.size > 1 and (not case.is_shaken or core.max() == core.min()):  # a shake has edges slip back
            gap, w, margin, n_lumped = _lumped(gap, w, n_core)
            n_core -= n_lumped - 1
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
        far_end = _over_a_period(case.shake_harmonics / length_x, steps)[0] if at_pull else np.zeros(steps + 1)
        M, C, K = _body_groups(case, springs.G_star * width)
        return cls(
            gap=gap,
            w=w,
            z=z,
            z_dot=z_dot,
            x=x,
            x_dot=x_dot,
            far_end=far_end,
            is_shaken=case.is_shaken,
            rheology=rheology,
            table=rheology.over_step(2 * np.pi / steps),
            body=_recursion(M, C, K, rheology, 2 * np.pi / steps),
            M=M,
            C=C,
            K=K,
            lump_margin=margin,
            n_lumped=n_lumped,
            n_core=n_core,
            length_x=length_x,
            length_z=cycle.unit,
            stiffness_x=springs.G_star * width,
            stiffness_z=springs.E_star * width,
            omega=cycle.omega,
        )

    @cached_property
    def normal(self) -> NormalState:
        """The springs in their periodic normal motion."""
        s, spans = np.zeros((1 + self.n_arms, self.gap.size)), np.empty((2, self.steps), dtype=np.int64)
        S = np.empty(self.steps)
        load = kernels.settle_normal(s, self.gap, self.w, self.z, self.z_dot, self.table, spans, S)
        if np.isnan(S).any():
            raise ValueError(
                f"steps_per_period = {self.steps} is too coarse for the normal motion of springs with these arms, "
                "which does not become periodic; raise it"
            )
        return NormalState(s, spans, S, float(load))

    @property
    def springs(self) -> kernels.Springs:
        """The springs as the kernels take them."""
        return kernels.Springs(self.gap, self.w, self.lump_margin)

    def motion(self, v: float) -> kernels.Motion:
        """The way of the indenter over a period, in the plane that of a pull at the velocity v and of a shake."""
        dx, x_dot = v * self.h + self._dx, v + self.x_dot
        return kernels.Motion(self.z, self.z_dot, v, self.is_shaken, dx, x_dot, self.normal.spans)

    @cached_property
    def _dx(self) -> Array:
        """What a shake travels in each step (n_steps,)."""
        return np.diff(self.x)

    def pace(self, v: float) -> float:
        """A scale of velocities where the pull is at v: this, or that of the shake if it is faster."""
        return max(v, float(np.abs(self.x_dot).max()))

    def full_slip_state(self, S: Array, v: float = np.inf) -> kernels.BodyState:
        """State of the body at phase 0 that repeats itself under the full-slip force S (n_steps,).

        Harmonic by harmonic, with the response of the recursion itself, so that the march starts without any
        free oscillation. On an undamped resonance the resonant harmonic is left out: no periodic motion has it. Near a
        resonance a harmonic that would carry the body back faster than FASTEST_START v is cut to that velocity.
        """
        if self.rigid:
            return self._state(S, np.zeros(3))
        y_n = self._full_slip_motion(S)
        most = FASTEST_START * self.pace(v)
        cut = most / np.maximum(self._velocities(y_n), most) if np.isfinite(most) else 1.0
        return self._state(S, self._positions(y_n * cut))

    def resonant_state(self, S: Array, v: float) -> kernels.BodyState | None:
        """State of the body at phase 0 on an undamped resonance or beside one. The resonant harmonic, the n-th, swings
        as far as stick lets it: y' reaches -v, once in each of its own periods, when that harmonic of the force is
        greatest.
        None where no harmonic moves the body faster than FASTEST_START v, and where the force does not contain it.
        """
        if self.rigid:
            return None
        y_n, resonant = self._full_slip_motion(S), self._resonant
        swings = self._velocities(y_n)
        n = int(np.flatnonzero(resonant)[0]) if resonant.any() else int(np.argmax(swings))
        F_n = complex(np.fft.rfft(S)[n]) / self.steps * complex(self.rheology.response(n))
        far = resonant[n] or swings[n] > FASTEST_START * self.pace(v)
        if n == 0 or abs(F_n) < 1e-10 * abs(float(S.mean())) or not far:
            return None
        y_n[n] = 0
        state = self._state(S, self._positions(y_n))
        phase = n * self.h * np.array([0, -1, -2]) + np.angle(F_n)
        state.y[:] -= v / n * np.sin(phase) - abs(F_n) / self.K  # and the mean force it takes away
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
        S = self.normal.S
        y_n = self._full_slip_motion(S)
        driven = np.abs(np.fft.rfft(S)) > 1e-10 * abs(float(S.sum()))
        if (self._resonant & driven)[1:].any():
            return np.inf
        y = np.fft.irfft(y_n, self.steps)
        y_dot = (np.roll(y, -1) - np.roll(y, 1)) / (2 * self.h)
        spans = self.normal.spans
        touching = (spans[1] > 0) & (np.roll(spans[1], 1) > 0)  # contact at the node between two steps
        return float((self.z_dot[:-1] - self.x_dot[:-1] - y_dot)[touching].max(initial=0.0))

    def _state(self, S: Array, y: Array) -> kernels.BodyState:
        """State at phase 0 of a body that was at y (3,), now and before, under the full-slip force S (n_steps,)."""
        arms_n = self._arms_n(self._turn()) if self.n_arms else []
        arms = [np.fft.irfft(arm_n * np.fft.rfft(S), self.steps)[[0, -1]] for arm_n in arms_n]
        return kernels.BodyState(y, S[[0, -1]], np.array(arms).reshape(-1, 2).T.copy())

    def _positions(self, y_n: NDArray[np.complex128]) -> Array:
        """Where a body with these harmonics is at phase 0, one step before and two."""
        return np.asarray(np.fft.irfft(y_n, self.steps)[[0, -1, -2]])

    def _full_slip_motion(self, S: Array) -> NDArray[np.complex128]:
        """Harmonics of the periodic motion under the full-slip force S (n_steps,), as of rfft; none on a resonance."""
        return np.asarray(self._compliance * np.fft.rfft(S))

    @cached_property
    def _compliance(self) -> NDArray[np.complex128]:
        """Harmonics of the periodic motion over those of S, (n_steps // 2 + 1,); zero on a resonance."""
        turn = self._turn()
        force_n = self.body.b_1 * turn + self.body.b_0 + self.body.b_m / turn
        for b, old, arm_n in zip(*self.body.arms, self._arms_n(turn), strict=True):
            force_n += (b + old / turn) * arm_n
        return np.asarray(np.where(self._resonant, 0, -force_n / np.where(self._resonant, 1, self._inertia(turn))))

    @cached_property
    def _resonant(self) -> NDArray[np.bool_]:
        """Whether each harmonic is a resonance without damping, (n_steps // 2 + 1,)."""
        return np.asarray(np.abs(self._inertia(self._turn())) < max(1e-9 * self.h**2, 2e-15))

    def _velocities(self, y_n: NDArray[np.complex128]) -> Array:
        """Amplitude of the velocity that each harmonic of the motion has."""
        return np.asarray(2 * np.arange(y_n.size) * np.abs(y_n) / self.steps)

    def mean_force(self, change: Any, inner: Any, of_arms: Any, time: float) -> Any:
        """Mean of L[e] over times in which S has the mean `inner` and changes by `change`, (n,) or one, and the sums
        over the arms by of_arms (..., J).
        """
        mean = inner + self.T * change / time
        for j, (rho, theta) in enumerate(zip(self.rheology.rho, self.rheology.theta, strict=True)):
            mean = mean + rho * theta / time * (change - of_arms[..., j])  # x_j' = x' - x_j/theta_j
        return mean

    def arms_at_ends(self, S: Array, S_start: float, arms: Array) -> Array:
        """Sums over the arms (n_periods + 1, J) at the ends of periods, from those at the start (J,) and S (n_t,)."""
        out = np.empty((S.size // self.steps + 1, arms.size))
        if not arms.size:
            return out
        steps = np.diff(S, prepend=S_start).reshape(-1, self.steps)
        for j, (decay, gain) in enumerate(self._arms()):
            added = steps @ (gain * decay ** np.arange(self.steps - 1, -1, -1))
            out[0, j] = arms[j]
            for k, one in enumerate(added):
                out[k + 1, j] = decay**self.steps * out[k, j] + one
        return out

    def _arms(self) -> list[tuple[float, float]]:
        """Decay and gain of each arm over a step."""
        return [(float(row[0]), float(row[1])) for row in self.table[[L_DECAY, L_GAIN], 1:].T]

    def _arms_n(self, turn: NDArray[np.complex128]) -> list[NDArray[np.complex128]]:
        """What each arm makes of every harmonic of S: nothing of its mean, however slow it is."""
        return [gain * (turn - 1) / np.where(turn == 1, 1, turn - decay) for decay, gain in self._arms()]

    def _turn(self) -> NDArray[np.complex128]:
        """exp(i n h) of every harmonic."""
        return np.asarray(np.exp(1j * self.h * np.arange(self.steps // 2 + 1)))

    def _inertia(self, turn: NDArray[np.complex128]) -> NDArray[np.complex128]:
        """What the recursion answers every harmonic with."""
        return np.asarray(turn - self.body.a_1 - self.body.a_2 / turn)

    def rest_state(self, v: float) -> kernels.BodyState:
        """State of a body at rest with nothing stretched, from which the pull sets off at v."""
        y = np.zeros(3) if self.rigid else np.array([0.0, 1.0, 2.0]) * v * self.h
        return kernels.BodyState(y, np.zeros(2), np.zeros((2, self.n_arms)))


def _over_a_period(harmonics: NDArray[np.complex128], steps: int) -> tuple[Array, Array]:
    """The sum of harmonics and its rate at equidistant phases, both ends included: (steps + 1,)."""
    if not harmonics.size:
        return np.zeros(steps + 1), np.zeros(steps + 1)
    phase, n = 2 * np.pi * np.arange(steps + 1) / steps, np.arange(1, harmonics.size + 1)
    return harmonic_sum(harmonics, phase), harmonic_sum(1j * n * harmonics, phase)


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


def _lumped(gap: Array, w: Array, n_core: int) -> tuple[Array, Array, float, int]:
    """The core as one spring: all its springs share the lag s - e, so only sums and means of them matter."""
    w_core = float(w[:n_core].sum())
    gap_core = float(w[:n_core] @ gap[:n_core]) / w_core
    margin = 2 * (float(gap[:n_core].max()) - gap_core)  # where the outermost would slip backward
    gap, w = (np.concatenate([[one], rest[n_core:]]) for one, rest in ((gap_core, gap), (w_core, w)))
    return gap, w, margin, n_core


def _recursion(M: float, C: float, K: float, rheology: Rheology, h: float) -> kernels.Body:
    """The recursion of the body; see the module's docstring."""
    T, rho, theta = rheology.T, np.array(rheology.rho), np.array(rheology.theta)
    if np.isinf(K):
        return kernels.Body(True, False, 0.0, 0.0, 0.0, 0.0, 0.0, np.zeros((2, rho.size)))
    table = rheology.over_step(h)
    decay, gain = table[L_DECAY, 1:], table[L_GAIN, 1:]
    if _ringing(M, K, rheology) * h > 2 * np.pi / RESOLVED:  # or no mass
        inertia = M / h**2 + 1.5 * C / h + K
        # the end of an arm whose rate changes within the step, by the second difference of S
        bend = rho * theta / h * (0.5 * (1 + decay) - theta / h * (1 - decay))
        end, second = float(rho @ gain), float(bend.sum())
        return kernels.Body(
            rigid=False,
            light=True,
            a_1=(2 * M / h**2 + 2 * C / h) / inertia,
            a_2=-(M / h**2 + 0.5 * C / h) / inertia,
            b_1=(1 + 1.5 * T / h + end + second) / inertia,
            b_0=(-2 * T / h - end - 2 * second) / inertia,
            b_m=(0.5 * T / h + second) / inertia,
            arms=np.array([rho * decay, np.zeros(rho.size)]) / inertia,
        )
    from scipy.linalg import expm

    A = expm(h * np.array([[0, 1, 0], [-K / M, -C / M, 1 / M], [0, 0, 0]]))  # last column: response to a unit force
    now, before = float(A[0, 2]), float(A[0, 1] * A[1, 2] - A[1, 1] * A[0, 2])
    change = T / h + float(np.sum(rho * theta / h * (1 - gain)))  # weight of S_new - S in the mean force of the step
    new, old = 0.5 + change, 0.5 - change
    return kernels.Body(
        rigid=False,
        light=False,
        a_1=float(A[0, 0] + A[1, 1]),
        a_2=float(-np.exp(-C / M * h)),
        b_1=now * new,
        b_0=now * old + before * new,
        b_m=before * old,
        arms=np.array([now * rho * gain, before * rho * gain]),
    )
