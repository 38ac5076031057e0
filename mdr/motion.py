"""The imposed normal motion, Eq. (3): u_z(t) = u_z0 + du_z cos(omega t).

Symbols: u_z0 mean indentation depth [m], du_z amplitude [m], omega angular frequency [rad/s].
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.checks import finite, finite_array, positive


@dataclass(frozen=True)
class NormalOscillation:
    """A harmonic normal motion of prescribed depth, Eq. (3).

    The mean depth may be zero or negative as long as the indenter touches in part of the period:
    that is tapping, u_z0 + du_z > 0.
    """

    u_z0: float  #: mean indentation depth [m]
    du_z: float  #: amplitude [m]
    omega: float  #: angular frequency [rad/s]

    def __post_init__(self) -> None:
        object.__setattr__(self, "u_z0", finite("u_z0", self.u_z0))
        object.__setattr__(self, "du_z", positive("du_z", self.du_z, "amplitude in m"))
        object.__setattr__(self, "omega", positive("omega", self.omega, "angular frequency in rad/s"))
        if self.u_z0 + self.du_z <= 0:
            raise ValueError(
                f"u_z0 + du_z = {self.u_z0 + self.du_z:.6g} m: the indenter never touches; "
                f"raise u_z0 above -du_z = {-self.du_z:.6g} m"
            )

    @property
    def period(self) -> float:
        """2 pi/omega [s]."""
        return 2 * np.pi / self.omega

    def u_z(self, t: ArrayLike) -> NDArray[np.float64]:
        """Depth [m] at times t [s], Eq. (3)."""
        return self.u_z0 + self.du_z * np.cos(self.omega * finite_array("t", t, "s"))

    def u_z_dot(self, t: ArrayLike) -> NDArray[np.float64]:
        """Its rate [m/s]."""
        return -self.du_z * self.omega * np.sin(self.omega * finite_array("t", t, "s"))
