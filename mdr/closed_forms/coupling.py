"""Normal-tangential coupling, which the springs leave out: its effect on friction under a rigid pull.

On a compressible body, pressing moves the surface towards the middle of the contact. At the edge the radial velocity of
the surface is 2 |beta|/pi times the rate of the depth, with Dundurs' beta, under any shape on an elastic body. Over
the velocity of Eq. (1) its greatest value is

    lambda = 2 |beta| / (pi mu_0 kappa),    kappa = E*/G*.

Computations in three dimensions (validation/coupled.py, end_of_stick.py and coupling_law.py, where this is derived and
measured) show two effects. Something sticks up to about 1 + lambda times the velocity at which the last spring does.
Below that velocity friction is lower than that of the springs; the difference is a share, which depends on lambda and
beta²/kappa, of what the springs lose at rest, 1 - static_cof/mu_0.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from mdr.case.contact import SlidingContact
from mdr.case.domain import ABOVE_ZERO, COULOMB, HARMONIC, NO_ARMS, RIGID, UNSHAKEN, Condition, holds_for
from mdr.closed_forms.full_slip import static_cof
from mdr.closed_forms.full_slip_body import full_slip_critical_velocity
from mdr.tools.arrays import EXACT


class LossLaw(NamedTuple):
    """Greatest loss over that at rest, a lambda²/(b + lambda) + c beta²/kappa, and how far it is known to hold."""

    a: float
    b: float
    c: float
    flat: float  #: greatest lambda at which it holds for flat faces too
    rub: float  #: greatest lambda that was computed
    beta: float  #: greatest |beta| that was computed


LOSS = LossLaw(a=0.210, b=0.313, c=0.122, flat=1.1, rub=3.2, beta=0.5)  #: from validation/coupling_law.py
WITH_COUPLING = "mdr.half_space.slide, which has coupling"


@holds_for(COULOMB, instead=WITH_COUPLING)
def radial_rub(case: SlidingContact) -> float:
    """Ratio lambda [-]: greatest radial velocity of the surface at the edge of the contact over that of Eq. (1).

    Parameters
    ----------
    case : SlidingContact
        The contact.

    Returns
    -------
    float
        lambda [-]; zero on an incompressible body, nu = 1/2.

    Notes
    -----
    From Boussinesq's radial displacement (1 - 2 nu)/(4 pi G r) of the surface, with Dundurs' beta ::

        lambda = 2 |beta| / (pi mu_0 kappa),    kappa = E*/G*

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> punch, rubber = mdr.FlatPunch(a=1e-3), mdr.Elastic(E=3e6, nu=0.3)
    >>> case = mdr.SlidingContact(punch, rubber, mu_0=0.4, oscillation=vibration)
    >>> print(f"{mdr.laws.radial_rub(case):.3f}")
    0.374
    """
    material = case.material
    return 2 * abs(material.dundurs_beta) / (math.pi * case.mu_0 * material.mindlin_ratio)


computed = holds_for(
    COULOMB,
    UNSHAKEN,
    RIGID,
    HARMONIC,
    ABOVE_ZERO,
    NO_ARMS,
    Condition(
        "material.dundurs_beta",
        f"abs(beta) <= {LOSS.beta}",
        lambda case: abs(case.material.dundurs_beta) <= LOSS.beta * (1 + EXACT),
    ),
    Condition("mu_0", f"lambda = 2 abs(beta)/(pi mu_0 kappa) <= {LOSS.rub}", lambda case: radial_rub(case) <= LOSS.rub),
    instead=WITH_COUPLING,
)


@computed
def coupled_critical_velocity(case: SlidingContact) -> float:
    """Velocity [m/s] up to which about something sticks, with normal-tangential coupling.

    Parameters
    ----------
    case : SlidingContact
        The contact. The pull is rigid, the depth harmonic about u_z0 > 0, the material elastic or Kelvin with
        ``|beta| <= 0.5`` and lambda <= 3.2 (`radial_rub`): other cases were not computed.

    Returns
    -------
    float
        (1 + lambda) times the full-slip critical velocity [m/s]. Where that is Eq. (1) it is
        (mu_0 kappa + 2 abs(beta)/pi) omega du_z.

    Raises
    ------
    ValueError
        For a case unlike those that were computed.

    Notes
    -----
    An estimate of lowest order in mu_0 and lambda, from the radial velocity of the surface at the edge. In three
    dimensions (elastic, mu_0 from 0.1 to 0.6, lambda up to 1.5) stick ended within 12 % of it. Friction is not full
    above it, only free of stick.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> punch, rubber = mdr.FlatPunch(a=1e-3), mdr.Elastic(E=3e6, nu=0.3)
    >>> case = mdr.SlidingContact(punch, rubber, mu_0=0.4, oscillation=vibration)
    >>> print(f"{mdr.laws.coupled_critical_velocity(case):.3g} m/s, not {mdr.critical_velocity(case):.3g} m/s")
    0.000401 m/s, not 0.000291 m/s
    """
    return (1 + radial_rub(case)) * full_slip_critical_velocity(case)


@computed
def coupling_loss(case: SlidingContact) -> float:
    """Error of the springs [-] that normal-tangential coupling makes: how much of mu_0 they are too high by, at most.

    Parameters
    ----------
    case : SlidingContact
        The contact, with the same limits as in `coupled_critical_velocity`.

    Returns
    -------
    float
        Greatest loss over mu_0 [-], at the velocity where it is most.

    Raises
    ------
    ValueError
        For a case unlike those that were computed.

    Notes
    -----
    A fit to computations in three dimensions, good to some 25 % of itself for lambda up to 1.1 ::

        (1 - static_cof/mu_0) [0.210 lambda²/(0.313 + lambda) + 0.122 beta²/kappa]

    Beyond, a flat punch lost 1.9 to 2.4 times as much, at the lowest velocity tried.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> punch, rubber = mdr.FlatPunch(a=1e-3), mdr.Elastic(E=3e6, nu=0.3)
    >>> case = mdr.SlidingContact(punch, rubber, mu_0=0.4, oscillation=vibration)
    >>> print(f"{mdr.laws.coupling_loss(case):.2g}")
    0.0051
    """
    rub, material = radial_rub(case), case.material
    share = LOSS.a * rub**2 / (LOSS.b + rub) + LOSS.c * material.dundurs_beta**2 / material.mindlin_ratio
    return share * (1 - static_cof(case) / case.mu_0)
