"""The account of energy of one period of a march, in SI."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mdr.march import kernels
from mdr.march.march import March


@dataclass(frozen=True)
class EnergyBalance:
    """Energies [J] of one period, each from its own definition.

    pull_work + normal_work + shake_work = friction_loss + viscous_loss + damper_loss + stored_change, up to the
    residual of the scheme.
    """

    pull_work: float  #: of the far end of the pull, v_0 times the pulling force
    normal_work: float  #: of the normal drive, F_z u_z'
    shake_work: float  #: of the drive in the plane: F_x x' at the tool, the pulling force times x' at the pull
    friction_loss: float  #: mu_0 F_z times the slip velocity
    viscous_loss: float  #: gamma s'² and gamma e'² of the springs
    damper_loss: float  #: of the system damper c_x
    stored_change: float  #: elastic energy of springs and system, kinetic energy of the body

    @property
    def residual(self) -> float:
        """Supply less use [J]."""
        used = self.friction_loss + self.viscous_loss + self.damper_loss + self.stored_change
        return self.pull_work + self.normal_work + self.shake_work - used

    @property
    def relative(self) -> float:
        """Residual over the energy that was lost [-]."""
        return self.residual / (self.friction_loss + self.viscous_loss + self.damper_loss)


def energy_balance(march: March) -> EnergyBalance:
    """The account of the period that a march was looked at."""
    scaled, account = march.end.scaled, march.account
    sums, v, h = account.seen.sums, march.end.v_0 / scaled.speed, scaled.h
    unit_x = scaled.stiffness_x * scaled.length_x**2
    unit_z = scaled.stiffness_z * scaled.length_z**2
    shake, damper = float(sums[kernels.SHAKE_WORK]), 0.0
    pull = float(sums[kernels.SHEAR_WORK]) - shake
    if not scaled.rigid:
        stretch = account.y[2:]  # of the system spring, backward
        if at_pull := bool(scaled.far_end.any()):
            stretch = stretch + scaled.x - scaled.far_end
        force = -scaled.K * 0.5 * (stretch[1:] + stretch[:-1]) - scaled.C * np.diff(stretch) / h  # of the pull, forward
        pull = v * h * float(np.sum(force))
        damper = scaled.C * float(np.sum(np.diff(stretch) ** 2)) / h
        shake = float(force @ np.diff(scaled.far_end)) if at_pull else shake
    viscous = unit_x * sums[kernels.SHEAR_VISCOUS] + unit_z * sums[kernels.NORMAL_VISCOUS]
    return EnergyBalance(
        pull_work=unit_x * pull,
        normal_work=unit_z * float(sums[kernels.NORMAL_WORK]),
        shake_work=unit_x * shake,
        friction_loss=unit_x * float(sums[kernels.FRICTION_LOSS]),
        viscous_loss=float(viscous),
        damper_loss=unit_x * damper,
        stored_change=unit_x * (account.stored[1] - account.stored[0]),
    )
