"""How the parts of a contact move: the common period, and the harmonics of the shake in the plane."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mdr.case.depth_cycle import Cycle
from mdr.case.friction import Friction
from mdr.case.in_plane import Shake, whole_ratio
from mdr.case.motion import Motion
from mdr.case.pull import Pull
from mdr.indenters.base import Indenter
from mdr.materials.base import Material


class InMotion:
    """What follows from oscillation, shake and pull of a contact."""

    indenter: Indenter
    material: Material
    friction: Friction
    oscillation: Motion
    pull: Pull
    shake: Shake | None
    mu_0: float  #: share of the normal force that friction bears in slip [-], of the law
    tau_0: float  #: shear strength besides [Pa], of the law
    mu_s: float  #: share of the normal force up to which a point at rest stays there [-], of the law

    @property
    def repeats(self) -> tuple[int, int]:
        """Periods of the oscillation, and of the shake, in the period of the case; 0 of what does not move."""
        if self.shake is None or self.shake.is_still:
            return 1, 0
        return whole_ratio(self.oscillation.omega, self.shake.omega) if self.oscillation.omega else (0, 1)

    @property
    def omega(self) -> float:
        """Angular frequency [rad/s] of the period after which oscillation and shake both repeat."""
        if self.shake is None:
            return self.oscillation.omega
        n_z, n_x = self.repeats
        return self.oscillation.omega / n_z if n_z else self.shake.omega / n_x

    @property
    def period(self) -> float:
        """2 pi/omega [s]."""
        return 2 * np.pi / self.omega

    @property
    def is_shaken(self) -> bool:
        """Whether it moves in the plane besides the pull."""
        return self.shake is not None and not self.shake.is_still

    @property
    def cycle(self) -> Cycle:
        """The depth over one period."""
        return self.oscillation.cycle.repeated(max(self.repeats[0], 1), self.omega)

    @property
    def shake_harmonics(self) -> NDArray[np.complex128]:
        """X_n [m], shape (N,), of the shake x(t) = Re of sum X_n exp(i n omega t), n = 1 ... N; empty without one."""
        return self._harmonics(across=False)

    @property
    def harmonics_across(self) -> NDArray[np.complex128]:
        """Y_n [m], shape (N,), of the shake across the pull likewise; empty where nothing moves across."""
        return self._harmonics(across=True)

    def _harmonics(self, across: bool) -> NDArray[np.complex128]:
        if self.shake is None or self.shake.is_still or (across and not self.shake.across.any()):
            return np.zeros(0, dtype=complex)
        n_x, given = self.repeats[1], self.shake.across if across else self.shake.along
        out = np.zeros(n_x * given.size, dtype=complex)
        out[n_x - 1 :: n_x] = given
        return out

    @property
    def moves_across(self) -> bool:
        """Whether it is shaken across the pull, so that friction turns."""
        return self.harmonics_across.size > 0

    @property
    def is_alike_both_ways(self) -> bool:
        """Whether a pull the other way is its mirror image: nothing shakes along the pull."""
        return not self.shake_harmonics.any()

    @property
    def way(self) -> NDArray[np.complex128]:
        """X_n [m] of the way that the shake takes the indenter, without friction; infinite on an undamped resonance.

        Of a shaken pulling point it is what spring, damper and mass pass on: (k_x + i n omega c_x) H(n omega) X_n.
        """
        return self._passed_on(self.shake_harmonics, across=False)

    @property
    def way_across(self) -> NDArray[np.complex128]:
        """Y_n [m] likewise, across the pull, where k_y and c_y pass on."""
        return self._passed_on(self.harmonics_across, across=True)

    def _passed_on(self, given: NDArray[np.complex128], across: bool) -> NDArray[np.complex128]:
        if not given.size or not self.is_shaken_at_pull:
            return given
        _, c, k = self.pull.across if across else self.pull.coefficients
        n_omega = self.omega * np.arange(1, given.size + 1)
        H, out = np.asarray(self.pull.receptance(n_omega, across=across)), np.zeros_like(given)
        passed = (given != 0) & np.isfinite(H)
        out[passed] = (k + 1j * n_omega[passed] * c) * H[passed] * given[passed]
        out[(given != 0) & ~np.isfinite(H)] = np.inf
        return out

    def borne(self, k_xc: float, *, across: bool = False) -> NDArray[np.complex128]:
        """Harmonics of the force that the contact bears while it sticks, and the body with it.

        Parameters
        ----------
        k_xc : float
            Tangential stiffness of the contact [N/m] at long times.
        across : bool
            Across the pull.

        Returns
        -------
        ndarray
            F_n [N], shape (N,), of n = 1 ... N: K P_n/(K + Z), with K the dynamic stiffness of the contact, Z that of
            mass, spring and damper, and P_n what these pass on to a contact that does not yield. Infinite where an
            undamped body resonates on its contact.
        """
        given = self.harmonics_across if across else self.shake_harmonics
        _, c, k = self.pull.across if across else self.pull.coefficients
        n_omega = self.omega * np.arange(1, given.size + 1)
        K = k_xc * np.asarray(self.material.dynamic_modulus(n_omega)) / self.material.E_star
        if np.isinf(k):
            return np.asarray(K * given)
        Z = self.pull.dynamic_stiffness(n_omega, across=across)
        passed = (k + 1j * n_omega * c if self.is_shaken_at_pull else Z) * given
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(passed == 0, 0.0, np.where(K + Z == 0, np.inf, K * passed / (K + Z)))

    @property
    def is_shaken_at_pull(self) -> bool:
        """Whether the shake reaches the body through a spring."""
        return self.shake is not None and self.shake.at == "pull" and not self.pull.is_rigid
