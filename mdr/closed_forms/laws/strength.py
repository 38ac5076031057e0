"""Laws of a face with a shear strength, |tau| <= tau_0 + mu_0 p: what is left of the critical velocity."""

from __future__ import annotations

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.normal.normal_force import contact_radius, mean_area, mean_normal_force
from mdr.normal.resolved import resolved
from mdr.tools.arrays import SAME, Array
from mdr.tools.checks import between, positive

INSTANTS = 4096  #: of a period, over which the passage of the edge is summed


def lost_at_the_edge(case: SlidingContact, v_0: float) -> float:
    """Share of full friction [-] that a curved elastic face with a shear strength loses in a fast slide.

    A spring that the edge of contact has just reached bears (2 tau_0/G*) sqrt(2 a a' t), which no pull outruns: it
    sticks until v_0 t is as much. With v = v_0 - mu_0 kappa u_z' this takes 2 a a' (2 tau_0/G*)²/v², and costs a sixth
    of G* v times its square. Over all springs that the edge passes::

        loss of F_x = (4/3) G* (2 tau_0/G*)^4 mean over the period of a² a'³/v³ where a' > 0

    A rigid pull. To leading order in 1/v_0, above v_c of Coulomb's part, next to which it says too much. For a
    paraboloid and mu_0 = 0 it is (2/(9 pi²)) (alpha/v)³ of the whole at small alpha, v being
    v_0/((2 tau_0/G*) omega sqrt(R u_z0)): for the same du_z, the deeper the contact, the slower the pull at
    which friction is back [shear_strength].

    Parameters
    ----------
    case : SlidingContact
        An elastic contact that is kept, under a rigid pull, which nothing shakes in the plane.
    v_0 : float
        Pulling velocity [m/s], above mu_0 kappa omega du_z.

    Returns
    -------
    float
        1 - F_x/(friction of full slip) [-].

    Raises
    ------
    ValueError
        For another material, pull or shake, no shear strength, or a velocity at which Coulomb's part sticks.

    Examples
    --------
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=6e-6, omega=300.0)
    >>> ball, rubber = mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(ball, rubber, 0.0, vibration, tau_0=1e4)
    >>> print(f"{mdr.laws.lost_at_the_edge(case, 1e-3):.2e}")
    2.20e-04
    """
    case, v_0 = _edge_case(case), positive("v_0", v_0, "pulling velocity in m/s")
    a, a_rate, slip = _passage(case)
    v = v_0 - slip
    if not v.min() > 0:
        raise ValueError(
            f"v_0 = {v_0:.6g} m/s is below mu_0 kappa omega du_z = {float(slip.max()):.4g} m/s, where springs stick "
            "that the edge does not pass: ask slide(case, v_0)"
        )
    G_star = case.material.G_star
    lost = 4 / 3 * G_star * (2 * case.tau_0 / G_star) ** 4 * float(np.mean(a**2 * np.maximum(a_rate, 0.0) ** 3 / v**3))
    return lost / (case.mu_0 * mean_normal_force(case) + case.tau_0 * mean_area(case))


def velocity_of_share(case: SlidingContact, share: float) -> float:
    """Pulling velocity [m/s] at which a share of the friction of a curved elastic face with a shear strength is back.

    It stands in the place of a critical velocity, which is infinite: where `lost_at_the_edge` comes to 1 - share. As
    that law says too much at low velocities, more may be back: with mu_0 = 0 the loss at a share of 0.99 is nine tenths
    of 1 %; beside a strong Coulomb's part, whose own v_c is near, it may be far less. `find` asks runs
    [shear_strength].

    Parameters
    ----------
    case : SlidingContact
        An elastic contact that is kept, under a rigid pull, which nothing shakes in the plane.
    share : float
        F_x over the friction of full slip [-], above 0.9 and below 1.

    Returns
    -------
    float
        v_0 [m/s].

    Raises
    ------
    ValueError
        For another material, pull or shake, no shear strength, or a share out of range.

    Examples
    --------
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=6e-6, omega=300.0)
    >>> ball, rubber = mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(ball, rubber, 0.0, vibration, tau_0=1e4)
    >>> print(f"{1e3 * mdr.laws.velocity_of_share(case, 0.99):.3f} mm/s")
    0.280 mm/s
    """
    from scipy.optimize import brentq

    case, share = _edge_case(case), between("share", share, 0.9, 1, "of full friction, such as 0.99")
    slowest = float(_passage(case)[2].max())
    unit, lost = case.unit_velocity, 1 - share
    # the loss is between that at mu_0 = 0 and one that grows without bound towards the slowest velocity
    high = slowest + unit
    while lost_at_the_edge(case, high) > lost:
        high = slowest + 2 * (high - slowest)
    low, least = high, max(SAME * slowest, 1e-9 * unit)
    while lost_at_the_edge(case, low) <= lost:
        if low - slowest < least:
            return slowest  # next to nothing is lost beside Coulomb's part
        low = slowest + 0.5 * (low - slowest)
    return float(brentq(lambda v: lost_at_the_edge(case, v) / lost - 1, low, high, xtol=1e-15 * high, rtol=1e-13))


def has_edge_law(case: SlidingContact) -> bool:
    """Whether the laws are known: a curved elastic face that keeps contact, under a rigid pull and nothing else."""
    return case.always_sticks and case.keeps_contact and not case.rheology.remembers and _is_pulled_alone(case)


def _is_pulled_alone(case: SlidingContact) -> bool:
    return case.pull.is_rigid and not case.is_shaken


def _edge_case(case: SlidingContact) -> SlidingContact:
    case = resolved(case)
    if not has_edge_law(case):
        lost = "kept" if case.keeps_contact else "lost in part of the period"
        raise ValueError(
            "the law is that of a curved elastic face with tau_0 > 0 that keeps contact, under a rigid pull without a "
            f"shake, got tau_0 = {case.tau_0:.6g} Pa, {type(case.indenter).__name__}, {type(case.material).__name__}, "
            f"{type(case.pull).__name__}, shake = {case.shake!r}, contact {lost}: ask slide(case, v_0)"
        )
    return case


def _passage(case: SlidingContact) -> tuple[Array, Array, Array]:
    """Radius of contact [m], its rate [m/s] and mu_0 kappa u_z' [m/s] over a period, (INSTANTS,)."""
    phase = 2 * np.pi / INSTANTS * (np.arange(float(INSTANTS)) + 0.5)
    half = np.pi / INSTANTS
    ends = contact_radius(case, np.append(phase - half, phase[-1] + half))
    rate = np.diff(ends) * case.omega / (2 * half)
    slip = case.mu_0 * case.material.mindlin_ratio * case.omega * case.cycle.unit * case.cycle.rate(phase)
    return contact_radius(case, phase), rate, slip
