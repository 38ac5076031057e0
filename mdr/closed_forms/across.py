"""Laws of a contact that is shaken across its way: friction turns with the direction of slip."""

from __future__ import annotations

import numpy as np

from mdr.case.contact import SlidingContact, require_case
from mdr.case.depth_cycle import peak
from mdr.indenters.base import Indenter
from mdr.normal.resolved import resolved
from mdr.tools.arrays import Array
from mdr.tools.checks import finite, instance, not_negative, positive

NODES = 64  #: of Gauss's rule on a piece of the contact; the integrand ends like a root, which its map removes


def rigid_across(r: float) -> float:
    """mu/mu_0 [-] of a contact that is shaken across by far more than its springs yield: (2/pi) r/q K(1/q²).

    q² = 1 + r², K the complete elliptic integral of the parameter m: the mean cosine of the direction of slip. The
    limit of eta = du_y/(mu_0 kappa u_z0) -> infinity at constant depth. It comes to 1 at no r, and is 1 - 1/(4 r²) for
    r >> 1.

    Parameters
    ----------
    r : float
        Pulling velocity over the greatest velocity of a harmonic shake, v_0/(omega du_y) [-].

    Returns
    -------
    float
        mu/mu_0 [-], of the sign of r.

    Examples
    --------
    >>> round(mdr.laws.rigid_across(0.5), 4)
    0.6426
    """
    from scipy.special import ellipkm1

    r = finite("r", r)
    square = 1 + r * r
    return float(2 / np.pi * r / np.sqrt(square) * ellipkm1(r * r / square)) if r else 0.0


def held_across(indenter: Indenter, d: float, reach: float) -> float:
    """Static friction [-] of a contact of constant depth that is shaken across, over mu_0.

    A spring at g can be deflected by mu_0 kappa (d - g), of which the shake takes du_y across, so that along the way
    the root of the difference of squares is left. The mean over the springs::

        integral of sqrt((d - g)² - d_y²) over that of d - g,   d_y = du_y/(mu_0 kappa)

    For a flat face sqrt(1 - (d_y/d)²). The limit v_0 -> 0 of runs; zero from d_y = d on. On a material with memory a
    harmonic shake counts abs(E*(omega))/E* times as much.

    Parameters
    ----------
    indenter : Indenter
        Shape of the contact.
    d : float
        Depth [m].
    reach : float
        d_y [m].

    Returns
    -------
    float
        The load over mu_0 F_N [-].

    Examples
    --------
    >>> round(mdr.laws.held_across(mdr.Paraboloid(R=5e-3), 20e-6, 10e-6), 4)
    0.69
    """
    instance("indenter", indenter, Indenter)
    d, reach = positive("d", d, "depth in m"), not_negative("reach", reach, "du_y/(mu_0 kappa) in m")
    if reach >= d:
        return 0.0
    held, pressed = (_over_contact(indenter, d, depth, lost) for depth, lost in ((d - reach, reach), (d, 0.0)))
    return held / pressed


def lost_across(case: SlidingContact, v_0: float) -> float:
    """Friction 1 - mu/mu_0 [-] that a shake across takes from a fast slide, at constant depth.

    The direction of slip turns by y'/v_0, and the force of a spring of deflection mu_0 kappa s follows it with a lag.
    With Y_n the harmonics of y and E* the dynamic modulus over the long-time one::

        1 - mu/mu_0 = mean of (1/4) sum over n of abs(n omega Y_n)²/abs(v_0 + i n omega mu_0 kappa s/E*(n omega))²

    over the springs, by their force. What is left out is of fourth order in n omega Y_n/v_0. Any linear material.

    Parameters
    ----------
    case : SlidingContact
        The contact, under a rigid pull, at a constant depth, shaken across alone.
    v_0 : float
        Pulling velocity [m/s].

    Returns
    -------
    float
        The friction that is lost, over mu_0 [-].

    Raises
    ------
    TypeError
        For a body on a spring.
    ValueError
        For a depth that oscillates, or a shake along the pull.

    Examples
    --------
    >>> depth, shake = mdr.ConstantDepth(u_z0=20e-6), mdr.InPlaneOscillation(omega=300.0, du_y=2e-6)
    >>> case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), mdr.Elastic(3e6, 0.5), 0.4, depth, shake=shake)
    >>> print(f"{mdr.laws.lost_across(case, 5e-3):.5f}")
    0.00322
    """
    case, v_0 = across_alone(case), positive("v_0", v_0, "pulling velocity in m/s")
    d, way = case.cycle.u_z0, case.way_across
    n_omega = case.omega * np.arange(1, way.size + 1)
    modulus = np.asarray(case.material.dynamic_modulus(n_omega)) / case.material.E_star
    x, weight = _places(case.indenter, d)
    s = np.maximum(d - case.indenter.profile_1d(x), 0.0)
    lag = n_omega * case.mu_0 * case.material.mindlin_ratio * s[:, None] / modulus
    lost = 0.25 * np.sum(np.abs(n_omega * way) ** 2 / np.abs(v_0 + 1j * lag) ** 2, axis=1)
    return float(weight @ (s * lost) / (weight @ s))


def full_across(case: SlidingContact, share: float) -> float:
    """Velocity [m/s] from which such a shake takes no more than a share of mu_0, by `lost_across`; 0 if never more."""
    from scipy.optimize import brentq

    case = across_alone(case)
    fastest = case.fastest_across
    if lost_across(case, 0.01 * fastest) <= share:
        return 0.0
    return float(brentq(lambda v: lost_across(case, v) - share, 0.01 * fastest, fastest / np.sqrt(share)))


def static_across(case: SlidingContact) -> float:
    """Static friction [-] of such a contact, by `held_across`, on any linear material and for any shake across."""
    case = across_alone(case)
    way = case.way_across
    n_omega = case.omega * np.arange(1, way.size + 1)
    borne = way * np.asarray(case.material.dynamic_modulus(n_omega)) / case.material.E_star
    reach = 0.5 * (peak(borne) + peak(-borne)) / (case.mu_0 * case.material.mindlin_ratio)
    return case.mu_0 * held_across(case.indenter, case.cycle.u_z0, reach)


def is_across_alone(case: SlidingContact) -> bool:
    """Whether a case of known depth is pulled rigidly, and nothing moves besides but across."""
    still = not case.way.any() and not case.cycle.harmonics.any()
    return case.pull.is_rigid and case.moves_across and still


def across_alone(case: SlidingContact) -> SlidingContact:
    """The case, resolved, if it is pulled rigidly at a constant depth and shaken across alone; else an error."""
    if not require_case(case).pull.is_rigid:
        raise TypeError(f"this law is that of a rigid pull, got {case.pull!r}")
    case = resolved(case)
    if not is_across_alone(case):
        raise ValueError("this law is that of a constant depth and a shake across the pull alone")
    return case


def _over_contact(indenter: Indenter, d: float, depth: float, lost: float) -> float:
    """Integral of sqrt((d - g)² - lost²) over the contact at a smaller depth, where it is zero."""
    x, weight = _places(indenter, depth)
    s = np.maximum(d - indenter.profile_1d(x), 0.0)
    return float(weight @ np.sqrt(np.maximum(s * s - lost * lost, 0.0)))


def _places(indenter: Indenter, depth: float) -> tuple[Array, Array]:
    """Nodes and weights over the contact at a depth, between its kinks; crowded to both ends of each piece."""
    a = float(indenter.contact_radius(depth))
    ends = np.array([0.0, *(kink for kink in indenter.kinks if kink < a), a])
    u, w = np.polynomial.legendre.leggauss(NODES)
    u = 0.5 * (1 + u)
    place, share = u * u * (3 - 2 * u), 3 * w * u * (1 - u)
    length = np.diff(ends)[:, None]
    return (ends[:-1, None] + length * place).ravel(), (length * share).ravel()
