"""Normal-tangential coupling, which the springs leave out: what it does to friction under a rigid pull, and how much.

On a compressible body pressing drags the surface to the middle of the contact. At the edge the surface moves radially
at 2 |beta|/pi times the rate of the depth, with Dundurs' beta, under any shape on an elastic body; over the velocity of
Eq. (1) that is, at most,

    lambda = 2 |beta| / (pi mu_0 kappa),    kappa = E*/G*.

Three-dimensional computations (validation/coupled.py, end_of_stick.py and coupling_law.py, where this is derived and
measured) show: something sticks up to about 1 + lambda times the velocity at which the last spring does, and below
friction is lower than that of the springs, by a share of what they lose at rest, 1 - static_cof/mu_0, that depends on
lambda and beta²/kappa.
"""

from __future__ import annotations

import math

from mdr.case.contact import SlidingContact, as_given, require_case
from mdr.case.motion import NormalOscillation
from mdr.closed_forms.full_slip import static_cof
from mdr.closed_forms.full_slip_body import full_slip_critical_velocity

SHARE, BEND, PULL = 0.210, 0.313, 0.122  #: of the greatest loss, fitted and tried in validation/coupling_law.py
FARTHEST = 1.1  #: lambda, up to which they hold for flat faces too
TRIED_RUB, TRIED_BETA = 3.2, 0.5  #: greatest lambda and |beta| that were computed


def radial_rub(case: SlidingContact) -> float:
    """Lambda [-]: greatest radial velocity of the surface at the edge of the contact, over that of Eq. (1).

    lambda = 2 |beta|/(pi mu_0 kappa), from Boussinesq's radial displacement (1 - 2 nu)/(4 pi G r) of the surface.
    """
    material = require_case(case).material
    return 2 * abs(material.dundurs_beta) / (math.pi * case.mu_0 * material.mindlin_ratio)


def coupled_critical_velocity(case: SlidingContact) -> float:
    """Pulling velocity [m/s] up to which about something sticks, with normal-tangential coupling.

    (1 + lambda) times the full-slip critical velocity, (mu_0 kappa + 2 |beta|/pi) omega du_z where that is Eq. (1): an
    estimate of lowest order in mu_0 and lambda, from the radial velocity of the surface at the edge. In three
    dimensions (elastic, mu_0 from 0.1 to 0.6, lambda up to 1.5) stick ended within 12 % of it. Friction is not full
    above, only free of stick. Raises ValueError for a case unlike those that were computed (`coupling_loss`).
    """
    _require_known(case)
    return (1 + radial_rub(case)) * full_slip_critical_velocity(case)


def coupling_loss(case: SlidingContact) -> float:
    """About how much of mu_0 [-] the springs are too high by, at the velocity where it is most.

    (1 - static_cof/mu_0) [0.210 lambda²/(0.313 + lambda) + 0.122 beta²/kappa], to some 25 % of itself for lambda up to
    1.1; beyond, a flat punch lost 1.9 to 2.4 times as much, at the lowest velocity tried. Raises ValueError unless the
    pull is rigid, the depth harmonic about u_z0 > 0, the material elastic or Kelvin, |beta| <= 0.5 and lambda <= 3.2.
    """
    _require_known(case)
    rub, material = radial_rub(case), case.material
    share = SHARE * rub**2 / (BEND + rub) + PULL * material.dundurs_beta**2 / material.mindlin_ratio
    return share * (1 - static_cof(case) / case.mu_0)


def unlike(case: SlidingContact) -> str:
    """What sets a case apart from those that were computed in three dimensions; empty for none."""
    case = as_given(case)
    if not case.pull.is_rigid:
        return f"a {type(case.pull).__name__}, not a rigid pull"
    if not isinstance(case.oscillation, NormalOscillation):
        return f"a {type(case.oscillation).__name__}, not a harmonic depth"
    if not case.oscillation.u_z0 > 0:
        return f"u_z0 = {case.oscillation.u_z0:g} m, not above 0"
    if case.material.contact_arms:
        return "a material with arms, neither elastic nor Kelvin"
    if not abs(case.material.dundurs_beta) <= TRIED_BETA * (1 + 1e-12):
        return f"Dundurs' beta = {case.material.dundurs_beta:.3g}, beyond {TRIED_BETA}"
    if not radial_rub(case) <= TRIED_RUB:
        return f"lambda = {radial_rub(case):.3g}, beyond {TRIED_RUB}"
    return ""


def _require_known(case: SlidingContact) -> None:
    if what := unlike(case):
        raise ValueError(f"what coupling does was not computed for this case: {what}")
