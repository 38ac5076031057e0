"""Laws of a contact that is shaken along its way."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.case.domain import COULOMB, ELASTIC, RIGID, Condition, holds_for
from mdr.closed_forms.critical_velocity import critical_velocity
from mdr.closed_forms.paper import deficit
from mdr.indenters.base import Indenter
from mdr.normal.normal_force import mean_normal_force
from mdr.normal.resolved import resolved
from mdr.tools.checks import between, finite, instance, not_negative, positive

ONE_FREQUENCY = Condition("repeats", "depth and shake of one frequency", lambda case: max(case.repeats) == 1)


def rigid_shake(r: float) -> float:
    """mu/mu_0 [-] of a contact that is shaken along its way by far more than its springs yield: (2/pi) arcsin r.

    The share of the period in which it slips forward less that in which it slips back. The limit of chi =
    du_x/(mu_0 kappa u_z0) -> infinity at constant depth [shaken_curves].

    Parameters
    ----------
    r : float
        Pulling velocity over the greatest velocity of a harmonic shake, v_0/(omega du_x) [-].

    Returns
    -------
    float
        mu/mu_0 [-], of the sign of r; 1 from r = 1 on.

    Examples
    --------
    >>> round(mdr.laws.rigid_shake(0.5), 4)
    0.3333
    """
    return float(2 / np.pi * np.arcsin(np.clip(finite("r", r), -1, 1)))


def held_under_shake(indenter: Indenter, d: float, reach: float) -> float:
    """Tangential load [-] that an elastic contact of constant depth holds while it is shaken, over mu_0 F_N.

    F_N(d - d_x)/F_N(d) with d_x = du_x/(mu_0 kappa): a spring at g can be deflected by mu_0 kappa (d - g), of which the
    shake needs du_x. It is 1 less what a monotonic pull by du_x takes to be held. Zero from d_x = d on, whatever the
    shape: there the deepest spring slips in every period, and nothing is held [shaken_curves].

    Parameters
    ----------
    indenter : Indenter
        Shape of the contact.
    d : float
        Depth [m].
    reach : float
        d_x [m].

    Returns
    -------
    float
        The greatest load that is held, over mu_0 times the normal force [-].

    Examples
    --------
    >>> round(mdr.laws.held_under_shake(mdr.Paraboloid(R=5e-3), 20e-6, 10e-6), 4)
    0.3536
    """
    instance("indenter", indenter, Indenter)
    d, reach = positive("d", d, "depth in m"), not_negative("reach", reach, "du_x/(mu_0 kappa) in m")
    return float(indenter.force(max(d - reach, 0.0), 1.0)) / float(indenter.force(d, 1.0))


@holds_for(COULOMB, RIGID, ELASTIC, ONE_FREQUENCY, of=resolved, instead="slide or cof_curve")
def lost_under_shake(case: SlidingContact, v_0: float) -> float:
    """Friction 1 - mu/mu_0 [-] that a small oscillation takes, normal and along the way together, at any phase.

    With A = abs(mu_0 kappa u_1 - X_1) forward, and abs(mu_0 kappa u_1 + X_1) the other way, v_0 < 0, complex amplitudes
    of depth and way, and psi = `mdr.closed_forms.paper.deficit`::

        1 - |mu|/mu_0 = k_xc A/(mu_0 F_N) psi(|v_0|/(omega A))

    One function for all phases, directions and shapes: only the difference of depth and shake counts as long as no
    spring slips back. Elastic, rigid pull, both of one frequency, A small beside mu_0 kappa u_z0 [shaken_curves].

    Parameters
    ----------
    case : SlidingContact
        The contact.
    v_0 : float
        Pulling velocity [m/s], of either sign.

    Returns
    -------
    float
        The friction that is lost, over mu_0 [-].

    Raises
    ------
    TypeError
        For a body on a spring.
    ValueError
        For a material with memory, two frequencies, or an amplitude at which springs slip back.

    Examples
    --------
    >>> depth, shake = mdr.ConstantDepth(u_z0=20e-6), mdr.InPlaneOscillation(omega=300.0, du_x=1e-7)
    >>> case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), mdr.Elastic(3e6, 0.5), 0.4, depth, shake=shake)
    >>> print(f"{mdr.laws.lost_under_shake(case, 1e-5):.5f}")
    0.00471
    """
    v_0 = finite("v_0", v_0)
    v_c = critical_velocity(case, 1 if v_0 >= 0 else -1)
    if v_c == 0:
        return 0.0
    if v_c / case.omega >= case.mu_0 * case.material.mindlin_ratio * case.cycle.u_z0:
        raise ValueError("this law is that of an amplitude below mu_0 kappa u_z0, at which no spring slips back")
    share = case.k_xc * v_c / case.omega / (case.mu_0 * mean_normal_force(case))
    return share * deficit(min(abs(v_0) / v_c, 1.0))


class EllipticDrive(NamedTuple):
    """What a drive does that is shaken along the slide a quarter of a period ahead of its depth."""

    blocked: float  #: push where it is held, over mu_0 times the mean normal force [-]
    free: float  #: velocity without load, over the greatest velocity of the shake [-]


def elliptic_drive(alpha: float) -> EllipticDrive:
    """The ends of the characteristic of an elliptic drive: flat face, springs that yield little beside the shake.

    Pressed by F_N (1 + alpha cos phi) it is moved back at omega du_x cos phi, so that it slips back while it presses
    more. Held, it pushes with (2/pi) alpha; free, it runs at r with arcsin r = alpha sqrt(1 - r²). Contact kept,
    elastic, rigid pull, chi = du_x/(mu_0 kappa u_z0) -> infinity [drive].

    Parameters
    ----------
    alpha : float
        Relative amplitude of the normal force [-], between 0 and 1.

    Returns
    -------
    EllipticDrive
        `blocked` and `free` [-].

    Examples
    --------
    >>> ends = mdr.laws.elliptic_drive(0.5)
    >>> round(ends.blocked, 4), round(ends.free, 4)
    (0.3183, 0.4351)
    """
    from scipy.optimize import brentq

    alpha = between("alpha", alpha, 0, 1, "du_z/u_z0 of a flat face that keeps contact")
    free = brentq(lambda r: np.arcsin(r) - alpha * np.sqrt(1 - r * r), 0.0, 1.0, xtol=1e-15)
    return EllipticDrive(2 / np.pi * alpha, float(free))
