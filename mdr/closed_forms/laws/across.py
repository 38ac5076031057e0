"""Laws of a contact that is shaken across its way: friction turns with the direction of slip."""

from __future__ import annotations

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.case.depth_cycle import harmonic_sum
from mdr.case.domain import COULOMB, ELASTIC, RIGID, Condition, holds_for
from mdr.closed_forms.across import ACROSS_ALONE, extent_across, held_across, places, static_across
from mdr.materials.base import Material
from mdr.normal.followed_force import N_STEPS
from mdr.normal.normal_force import normal_force
from mdr.normal.resolved import resolved
from mdr.tools.checks import finite, instance, not_negative, positive

FADES = 0.012  #: of mu_0 kappa omega u_z0, velocity over which `excess_across` fades at eta = 1; fitted
STIFFER = 0.36  #: of beta²/kappa, by which coupling stiffens a contact; fitted
ACROSS = Condition("shake", "a shake across the pull", lambda case: case.moves_across)


def rigid_across(r: float) -> float:
    """mu/mu_0 [-] of a contact that is shaken across by far more than its springs yield: (2/pi) r/q K(1/q²).

    q² = 1 + r², K the complete elliptic integral of the parameter m: the mean cosine of the direction of slip. The
    limit of eta = du_y/(mu_0 kappa u_z0) -> infinity at constant depth. It comes to 1 at no r, and is 1 - 1/(4 r²) for
    r >> 1 [shaken_across].

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
    share = r / np.hypot(1.0, r)
    return float(2 / np.pi * share * ellipkm1(max(share * share, 1e-300)))  # a square may underflow


@holds_for(COULOMB, RIGID, ACROSS_ALONE, of=resolved, instead="slide or cof_curve")
def lost_across(case: SlidingContact, v_0: float) -> float:
    """Friction 1 - mu/mu_0 [-] that a shake across takes from a fast slide, at constant depth.

    The direction of slip turns by y'/v_0, and the force of a spring of deflection mu_0 kappa s follows it with a lag.
    With Y_n the harmonics of y and E* the dynamic modulus over the long-time one::

        1 - mu/mu_0 = mean of (1/4) sum over n of abs(n omega Y_n)²/abs(v_0 + i n omega mu_0 kappa s/E*(n omega))²

    over the springs, by their force. What is left out is of fourth order in n omega Y_n/v_0. Any linear material
    [shaken_across].

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
    0.00269
    """
    v_0 = positive("v_0", v_0, "pulling velocity in m/s")
    d, way = case.cycle.u_z0, case.way_across
    n_omega = case.omega * np.arange(1, way.size + 1)
    modulus = np.asarray(case.material.dynamic_modulus(n_omega)) / case.material.E_star
    x, weight = places(case.indenter, float(case.indenter.contact_radius(d)))
    s = np.maximum(d - case.indenter.profile_1d(x), 0.0)
    lag = n_omega * case.mu_0 * case.material.mindlin_ratio * s[:, None] / modulus
    lost = 0.25 * np.sum(np.abs(n_omega * way) ** 2 / np.abs(v_0 + 1j * lag) ** 2, axis=1)
    return float(weight @ (s * lost) / (weight @ s))


@holds_for(COULOMB, RIGID, ACROSS, of=resolved, instead="slide")
def steered_across(case: SlidingContact, v_0: float) -> float:
    """COF across [-] of a fast slide whose normal force oscillates too: mu_0 mean of F_N y'/(v_0 mean of F_N).

    The direction of slip turns by y'/v_0 and counts more while the contact is pressed more: shaken up and down and
    across a quarter of a period apart a contact is pushed aside, for one harmonic each and F_N = F_0 + dF cos(omega t),
    y = du_y cos(omega t + phi) by -mu_0 dF/F_0 omega du_y sin(phi)/(2 v_0). What is left out falls like 1/v_0², and is
    the whole force if depth and shake are in phase. Any shape and linear material, contact kept or lost
    [shaken_across].

    Parameters
    ----------
    case : SlidingContact
        The contact, under a rigid pull, shaken across.
    v_0 : float
        Pulling velocity [m/s].

    Returns
    -------
    float
        Mean force across over the mean normal force [-].

    Raises
    ------
    TypeError
        For a body on a spring.
    ValueError
        For a contact that is not shaken across.

    Examples
    --------
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=6e-6, omega=300.0)
    >>> shake = mdr.InPlaneOscillation(omega=300.0, du_y=2e-6, phi_y=-np.pi / 2)
    >>> case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), mdr.Elastic(3e6, 0.5), 0.4, vibration, shake=shake)
    >>> print(f"{mdr.laws.steered_across(case, 5e-3):.5f}")
    0.01059
    """
    v_0 = positive("v_0", v_0, "pulling velocity in m/s")
    phase = 2 * np.pi * np.arange(N_STEPS) / N_STEPS
    n = np.arange(1, case.way_across.size + 1)
    rate = harmonic_sum(1j * n * case.omega * case.way_across, phase)
    F = normal_force(case, phase)
    return float(case.mu_0 * (F @ rate) / (v_0 * F.sum()))


@holds_for(COULOMB, RIGID, ACROSS_ALONE, ELASTIC, of=resolved, instead="mdr.half_space.slide")
def excess_across(case: SlidingContact, v_0: float) -> float:
    """What springs are too high by, over mu_0 [-], where a contact is shaken across: beside a half-space uncoupled.

    Springs of different directions do not obey Coulomb's law in every point of the surface. Where a part of the contact
    never slips, with eta = du_y/(mu_0 kappa u_z0) < 1, slow slides tell that::

        (difference of `held_across` by springs and by the surface) exp(-(v_0/v_1)^(2/3)),
        v_1 = 0.012 sqrt(eta) mu_0 kappa omega u_z0

    and 0 from eta = 1 on. The first factor is derived, the second a fit to a paraboloid. From v_0 = 0.005 mu_0 kappa
    omega u_z0 on it had cone and r^4 of eta < 1 within 0.02 of mu_0; from eta = 1 on springs were off by up to 0.03
    [vector_springs].

    Parameters
    ----------
    case : SlidingContact
        The contact, elastic, under a rigid pull, at a constant depth, shaken across alone.
    v_0 : float
        Pulling velocity [m/s].

    Returns
    -------
    float
        COF of springs less that of a half-space without coupling, over mu_0 [-].

    Raises
    ------
    TypeError
        For a body on a spring.
    ValueError
        For a depth that oscillates, a shake along the pull, and a material with memory.

    Examples
    --------
    >>> depth, shake = mdr.ConstantDepth(u_z0=20e-6), mdr.InPlaneOscillation(omega=300.0, du_y=6e-6)
    >>> case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), mdr.Elastic(3e6, 0.5), 0.4, depth, shake=shake)
    >>> [round(mdr.laws.excess_across(case, v_0), 3) for v_0 in (0, 3e-5, 3e-4)]
    [0.126, 0.047, 0.001]
    """
    v_0 = not_negative("v_0", v_0, "pulling velocity in m/s")
    d, d_y = case.cycle.u_z0, extent_across(case)
    if not 0 < d_y < d:
        return 0.0
    by_springs, at_surface = (held_across(case.indenter, d, d_y, surface=surface) for surface in (False, True))
    v_1 = FADES * np.sqrt(d_y / d) * case.mu_0 * case.material.mindlin_ratio * case.omega * d
    return float((by_springs - at_surface) * np.exp(-((v_0 / v_1) ** (2 / 3))))


def stiffened_by_coupling(material: Material) -> float:
    """By what share [-] coupling stiffens a contact of constant depth along its surface: 0.36 beta²/kappa.

    Tractions along the surface change the pressure, which moves the surface back. So a half-space that is shaken across
    has with coupling the friction that it has without at a shake and a velocity this share larger. A fit to a
    paraboloid of nu = mu_0 = 0.3; others were within 0.015 of mu_0, where coupling took up to 0.066. The share was 0.3
    at mu_0 = 0.1, 0.5 at 0.6, and half as much under a flat punch [vector_springs].

    Parameters
    ----------
    material : Material
        What the contact is made of.

    Returns
    -------
    float
        The share [-]; zero for two alike bodies, or nu = 1/2 under a rigid indenter.

    Examples
    --------
    >>> print(f"{mdr.laws.stiffened_by_coupling(mdr.Elastic(3e6, 0.3)):.3f}")
    0.024
    """
    instance("material", material, Material)
    return float(STIFFER * material.dundurs_beta**2 / material.mindlin_ratio)


@holds_for(COULOMB, RIGID, ACROSS_ALONE, of=resolved, instead="slide or cof_curve")
def full_across(case: SlidingContact, share: float) -> float:
    """Velocity [m/s] from which such a shake takes no more than a share of mu_0; 0 if never more, NaN if not known.

    By `lost_across`, which may say too little of slow slides.
    """
    from scipy.optimize import brentq

    fastest = case.fastest_across
    if lost_across(case, 0.01 * fastest) <= share:
        return 0.0 if static_across(case) >= (1 - share) * case.mu_0 else np.nan
    return float(brentq(lambda v: lost_across(case, v) - share, 0.01 * fastest, fastest / np.sqrt(share)))
