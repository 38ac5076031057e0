"""The account of energy of one period of a march, in SI."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import astuple, dataclass

import numpy as np

from mdr.march.dynamics.stepper import PeriodRecord, Stepper
from mdr.spring.energies import FRICTION_LOSS, NORMAL_VISCOUS, NORMAL_WORK, SHAKE_WORK, SHEAR_VISCOUS, SHEAR_WORK, gauss
from mdr.tools.arrays import EXACT, Array

OF_QUARTICS = gauss(3)  #: exact for squares of the rate of a cubic
OF_STEPS = 20.0  #: times the square of a step that the energies of a period may miss; 0.5 without arms and dashpots
OF_MEMORY = 0.05  #: of what is lost, that they may miss with arms and dashpots far stiffer than the spring


@dataclass(frozen=True)
class EnergyBalance:
    """Energies [J] of one period, each from its own definition; their means over the periods of a state that comes back
    after several.

    pull_work + normal_work + shake_work = friction_loss + viscous_loss + damper_loss + stored_change, up to the
    residual of the scheme.
    """

    pull_work: float  #: of the far end of the pull, v_0 times the pulling force
    normal_work: float  #: of the normal drive, F_z u_z'
    shake_work: float  #: of the drive in the plane: F_x x' at the tool, the pulling force times x' at the pull
    friction_loss: float  #: mu_0 F_z times the slip velocity
    viscous_loss: float  #: of the springs: their dashpots, gamma s'² and gamma e'², and Maxwell arms
    damper_loss: float  #: of the system damper c_x
    stored_change: float  #: elastic energy of springs and system, kinetic energy of the body

    @property
    def residual(self) -> float:
        """Supply less use [J]."""
        return self.pull_work + self.normal_work + self.shake_work - self.lost - self.stored_change

    @property
    def lost(self) -> float:
        """Energy [J] that friction, material and damper turn into heat."""
        return self.friction_loss + self.viscous_loss + self.damper_loss

    @property
    def relative(self) -> float:
        """Residual over the energy that was lost [-]."""
        return self.residual / self.lost


def does_not_close(balance: EnergyBalance, stepper: Stepper, account: PeriodRecord, error: float) -> str:
    """Why the balance of a period cannot be that of the motion; nothing if it can. error: of the COF, over mu_0.

    What is missing is of second order in h n, over what is lost and what friction takes at the pace of the run; n omega
    is the fastest oscillation that steps resolve: that of the body on the contact, or the drive where steps damp the
    former. Arms and dashpots that are far stiffer than the spring add to it, by a small share of what is lost.
    """
    scaled = stepper.scaled
    unit = scaled.units.energy_x
    of_friction = 2 * np.pi * unit * stepper.mean_limit * scaled.drive.pace(stepper.v)
    fastest = 1.0 if scaled.body.light else max(1.0, scaled.body.ringing)
    of_steps = OF_STEPS * (scaled.drive.h * fastest) ** 2 * (balance.lost + of_friction)
    missing = abs(balance.residual)
    rounding = EXACT * unit * max(account.stored)  # mostly in the motion of the body
    if missing <= max(of_steps, OF_MEMORY * balance.lost) + error * of_friction + rounding:
        return ""
    return f"the energies of a period do not close: {missing:.2g} J are missing where {balance.lost:.2g} J are lost"


def energy_balance(stepper: Stepper, accounts: Sequence[PeriodRecord]) -> EnergyBalance:
    """The mean account of periods that were looked at closely."""
    found = [astuple(_energies(stepper, one)) for one in accounts]
    return EnergyBalance(*np.mean(found, axis=0).tolist())


def _energies(stepper: Stepper, account: PeriodRecord) -> EnergyBalance:
    """The account of a period."""
    scaled = stepper.scaled
    sums, h = account.seen.sums, scaled.drive.h
    unit_x, unit_z = scaled.units.energy_x, scaled.units.energy_z
    shake, damper = float(sums[SHAKE_WORK]), 0.0
    pull = float(sums[SHEAR_WORK]) - shake
    both = stepper.directions(account.u, account.rate)
    at_pull = any(axis.far_end.any() for _, axis, _, _ in both)
    shake = 0.0 if at_pull else shake
    for body, axis, v, (stretch, rate) in both:
        if body.rigid:
            continue
        if axis.far_end.any():  # stretch of the system spring, backward
            stretch, rate = stretch + axis.x - axis.far_end, rate + axis.x_dot - axis.far_end_dot
        u, w = OF_QUARTICS[:, :1], h * OF_QUARTICS[:, 1]
        y, y_dot = _between(stretch, rate, h, u, body.light)
        force = -body.K * y - body.C * y_dot  # of the pull, forward
        pull = v * float(w @ force.sum(axis=1)) if axis is scaled.drive.along else pull
        damper += body.C * float(w @ (y_dot**2).sum(axis=1))
        if at_pull:
            shake += float(w @ (force * _between(axis.far_end, axis.far_end_dot, h, u, False)[1]).sum(axis=1))
    viscous = unit_x * sums[SHEAR_VISCOUS] + unit_z * sums[NORMAL_VISCOUS]
    return EnergyBalance(
        pull_work=unit_x * pull,
        normal_work=unit_z * float(sums[NORMAL_WORK]),
        shake_work=unit_x * shake,
        friction_loss=unit_x * float(sums[FRICTION_LOSS]),
        viscous_loss=float(viscous),
        damper_loss=unit_x * damper,
        stored_change=unit_x * (account.stored[1] - account.stored[0]),
    )


def _between(y: Array, y_dot: Array, h: float, u: Array, bends_evenly: bool) -> tuple[Array, Array]:
    """Value and rate, shares u (m, 1) of each step after its start, of the cubic through values and rates (n + 1,) at
    its ends; of the parabola that a light body moves on in a step, which has the rate at its end. Both (m, n).
    """
    mean, last = np.diff(y) / h, y_dot[1:]
    first = 2 * mean - last if bends_evenly else y_dot[:-1]
    value = first * (u - 2 * u**2 + u**3) + last * (u**3 - u**2) + mean * (3 * u**2 - 2 * u**3)
    return y[:-1] + h * value, first * (1 - 4 * u + 3 * u**2) + last * (3 * u**2 - 2 * u) + mean * 6 * (u - u**2)
