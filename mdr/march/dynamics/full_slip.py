"""The body in full slip, harmonic by harmonic, with the response of the steps themselves: the state that a march begins
from, without any free oscillation, and the velocity at which stick begins.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mdr.march.dynamics.body import N_BODY, RATE, Body, U, harmonics_of, light_harmonics_of
from mdr.march.dynamics.limit import Limit
from mdr.tools.arrays import Array

FASTEST_START = 100.0  #: velocity of the body, over v_0, with which a march from full slip begins at most


class FullSlip:
    """The periodic motion of a body under the force of full slip."""

    def __init__(self, body: Body, limit: Limit, rate: Array, pace: float) -> None:
        self.body, self.limit, self.steps = body, limit, rate.size - 1
        self.rate = rate  #: (n_steps + 1,) of depth less that of a shake
        self.pace = pace  #: greatest velocity of the shake

    def state(self, v: float = np.inf) -> Array:
        """State (N_BODY,) of the body at phase 0 that repeats itself.

        On an undamped resonance the resonant harmonic is left out: no periodic motion has it. Near a resonance a
        harmonic that would carry the body back faster than FASTEST_START v is cut to that velocity.
        """
        if self.body.rigid:
            return np.zeros(N_BODY)
        most = FASTEST_START * max(v, self.pace)
        motion, _ = self._motion
        cut = most / np.maximum(self._velocities, most) if np.isfinite(most) else 1.0
        return self._at_begin(motion * cut)

    def resonant(self, v: float) -> Array | None:
        """State of the body at phase 0 on an undamped resonance or beside one. The resonant harmonic, the n-th, swings
        as far as stick lets it: y' reaches -v, once in each of its own periods, when that harmonic of the force is
        greatest.
        None where no harmonic moves the body faster than FASTEST_START v, and where the force does not contain it.
        """
        if self.body.rigid:
            return None
        motion, resonant = self._motion
        n = int(np.flatnonzero(resonant)[0]) if resonant.any() else int(np.argmax(self._velocities))
        F_n = complex(self._force[n])
        far = resonant[n] or self._velocities[n] > FASTEST_START * max(v, self.pace)
        if n == 0 or abs(F_n) < 1e-10 * abs(self.limit.mean) or not far:
            return None
        motion = motion.copy()
        motion[:, n] = 0
        state, phase = self._at_begin(motion), np.angle(F_n)
        state[U] += abs(F_n) / self.body.K - v / n * np.sin(phase)  # and the mean force it takes away
        state[RATE] -= v * np.cos(phase)
        return state

    @cached_property
    def end(self) -> float:
        """Velocity below which the periodic motion of full slip would stick, to the accuracy of the steps; infinite on
        a resonance that the force drives.

        In full slip for good the body has this motion and a free oscillation. That is in another phase in every period,
        so that it cannot keep all of them from stick: below this velocity full slip does not last (but where the free
        oscillation is a whole multiple of the drive).
        """
        if self.body.rigid:
            return 0.0
        motion, resonant = self._motion
        if (resonant & (np.abs(self._force) > 1e-10 * abs(self.limit.mean)))[1:].any():
            return np.inf
        y_dot = np.fft.irfft(motion[1], self.steps)
        presses = self.limit.area > 0
        touching = presses & np.roll(presses, 1)  # contact at the node between two steps
        return float((self.rate[:-1] - y_dot)[touching].max(initial=0.0))

    def _at_begin(self, motion: NDArray[np.complex128]) -> Array:
        """State at phase 0 of a body with these harmonics (2, N)."""
        return np.asarray(np.fft.irfft(motion, self.steps)[:, 0])

    @cached_property
    def _force(self) -> NDArray[np.complex128]:
        """Harmonics of the mean force of each step, as of rfft over the number of steps."""
        return np.asarray(np.fft.rfft(self.limit.area) / (2 * np.pi))

    @cached_property
    def _motion(self) -> tuple[NDArray[np.complex128], NDArray[np.bool_]]:
        """Harmonics (2, N) of y and its rate, as of rfft, and which of them are resonances."""
        areas = np.fft.rfft(self.limit.area)
        if self.body.light:
            return light_harmonics_of(self.body, areas, np.fft.rfft(self.limit.end))
        return harmonics_of(self.body, areas, np.fft.rfft(self.limit.moment))

    @cached_property
    def _velocities(self) -> Array:
        """Amplitude of the velocity that each harmonic of the motion has."""
        y = self._motion[0][0]
        return np.asarray(2 * np.arange(y.size) * np.abs(y) / self.steps)
