"""Laws of a face with a shear strength, |tau| <= tau_0 + mu_0 p: what is left of the critical velocity."""

from __future__ import annotations

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.case.domain import ELASTIC, NO_ARMS, RIGID, STRENGTH, UNSHAKEN, Condition, holds_for
from mdr.case.friction import Coulomb, ShearStrength
from mdr.closed_forms.full_slip_face import greatest_rate_of_half_space
from mdr.normal.normal_force import contact_radius, mean_area, mean_normal_force
from mdr.normal.resolved import resolved
from mdr.tools.arrays import SAME, Array
from mdr.tools.checks import between, positive

INSTANTS = 4096  #: of a period, over which the passage of the edge is summed
EITHER = Condition(
    "friction",
    "Coulomb's friction or a shear strength",
    lambda case: isinstance(case.friction, Coulomb | ShearStrength),
)
at_the_edge = holds_for(
    STRENGTH,
    RIGID,
    UNSHAKEN,
    ELASTIC,
    Condition("indenter", "a curved face, whose edge of contact moves", lambda case: case.edge_moves),
    Condition("keeps_contact", "a contact that is kept", lambda case: case.keeps_contact),
    of=resolved,
    instead="slide(case, v_0)",
)


@at_the_edge
def lost_at_the_edge(case: SlidingContact, v_0: float, *, half_space: bool = False) -> float:
    """Share of full friction [-] that a curved elastic face with a shear strength loses in a fast slide.

    A spring that the edge of contact has just reached bears (2 tau_0/G*) sqrt(2 a a' t), which no pull outruns: it
    sticks until v_0 t is as much. With v = v_0 - mu_0 kappa u_z' this takes 2 a a' (2 tau_0/G*)²/v², and costs a sixth
    of G* v times its square. Over all springs that the edge passes::

        loss of F_x = (4/3) G* (2 tau_0/G*)^4 mean over the period of a² a'³/v³ where a' > 0

    For a paraboloid and mu_0 = 0 it is (2/(9 pi²)) (alpha/v)³ of the whole at small alpha, v being
    v_0/((2 tau_0/G*) omega sqrt(R u_z0)).

    Well above v_c of Coulomb's part a half-space loses less: a strength tau_0 on a disc moves the surface by
    (4 tau_0/(pi G*)) a E(r/a), whose rate, by (4 tau_0/(pi G*)) a' K(r/a), grows like a logarithm towards the edge, and
    not like a root. What sticks is a ring of the width 32 a exp(-pi G* v/(2 tau_0 a')) within the edge, in which
    tau/tau_0 = (2/pi) arcsin sqrt(s) over the share s of the width. It bears half of the strength::

        loss of F_x = 32 pi tau_0 mean over the period of a² exp(-pi G* v/(2 tau_0 a')) where a' > 0

    Either way a rigid pull, and to leading order in fast slides, above v_c of Coulomb's part, next to which it says too
    much. For the same du_z, the deeper the contact, the slower the pull at which friction is back [shear_strength].

    Parameters
    ----------
    case : SlidingContact
        An elastic contact that is kept, under a rigid pull, which nothing shakes in the plane.
    v_0 : float
        Pulling velocity [m/s], above mu_0 kappa omega du_z.
    half_space : bool
        False is the law of springs, True that of a half-space without coupling: exact for nu = 0, and close to it else.

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
    >>> for half_space in (False, True):
    ...     print(f"{mdr.laws.lost_at_the_edge(case, 3e-4, half_space=half_space):.2e}")
    8.17e-03
    6.32e-04
    """
    v_0 = positive("v_0", v_0, "pulling velocity in m/s")
    a, a_rate, slip = _passage(case)
    v = v_0 - slip
    if not v.min() > 0:
        raise ValueError(
            f"v_0 = {v_0:.6g} m/s is below mu_0 kappa omega du_z = {float(slip.max()):.4g} m/s, where springs stick "
            "that the edge does not pass: ask slide(case, v_0)"
        )
    G_star, outwards = case.material.G_star, np.maximum(a_rate, 0.0)
    if half_space:
        with np.errstate(divide="ignore"):
            sticks = 32 * np.exp(-np.pi * G_star / (2 * case.tau_0) * (v / outwards))
        lost = np.pi * case.tau_0 * float(np.mean(a**2 * sticks))
    else:
        lost = 4 / 3 * G_star * (2 * case.tau_0 / G_star) ** 4 * float(np.mean(a**2 * outwards**3 / v**3))
    return lost / (case.mu_0 * mean_normal_force(case) + case.tau_0 * mean_area(case))


@at_the_edge
def velocity_of_share(case: SlidingContact, share: float, *, half_space: bool = False) -> float:
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
    half_space : bool
        Which law, as there.

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
    >>> for half_space in (False, True):
    ...     print(f"{1e3 * mdr.laws.velocity_of_share(case, 0.99, half_space=half_space):.3f} mm/s")
    0.280 mm/s
    0.210 mm/s
    """
    from scipy.optimize import brentq

    share = between("share", share, 0.9, 1, "of full friction, such as 0.99")
    slowest = float(_passage(case)[2].max())
    unit, lost = case.unit_velocity, 1 - share

    def loss(v_0: float) -> float:
        return lost_at_the_edge(case, v_0, half_space=half_space)

    # the loss is between that at mu_0 = 0 and one that grows without bound towards the slowest velocity
    high = slowest + unit
    while loss(high) > lost:
        high = slowest + 2 * (high - slowest)
    low, least = high, max(SAME * slowest, 1e-9 * unit)
    while loss(low) <= lost:
        if low - slowest < least:
            return slowest  # next to nothing is lost beside Coulomb's part
        low = slowest + 0.5 * (low - slowest)
    return float(brentq(lambda v: loss(v) / lost - 1, low, high, xtol=1e-15 * high, rtol=1e-13))


@holds_for(
    EITHER,
    RIGID,
    UNSHAKEN,
    NO_ARMS,
    of=resolved,
    instead="full_slip_critical_velocity, which is that of springs",
)
def full_slip_of_half_space(case: SlidingContact) -> float:
    """Velocity of full slip [m/s] of a face with a shear strength on a half-space without coupling.

    `full_slip_critical_velocity` is that of springs, which it is on a flat face that keeps contact too. On a curved
    viscous one springs say too much: at small amplitudes the half-space slips all over from a fraction of it on, and
    its velocity depends on the depth. Found on a grid, to about 2e-3; exact for nu = 0 [shear_strength].

    Parameters
    ----------
    case : SlidingContact
        An elastic or Kelvin contact under a rigid pull, which nothing shakes in the plane.

    Returns
    -------
    float
        v_c [m/s]; infinite on a curved elastic face, where a ring at the edge always sticks.

    Raises
    ------
    ValueError
        For a material with relaxation times, another pull, or a shake.

    Examples
    --------
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=6e-6, omega=300.0)
    >>> ball, rubber = mdr.Paraboloid(R=5e-3), mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-3)
    >>> case = mdr.SlidingContact(ball, rubber, 0.0, vibration, tau_0=1e4)
    >>> for v_c in (mdr.full_slip_critical_velocity(case), mdr.laws.full_slip_of_half_space(case)):
    ...     print(f"{1e3 * v_c:.3f} mm/s")
    0.385 mm/s
    0.203 mm/s
    """
    return greatest_rate_of_half_space(case, lambda phase: _slip(case, phase))


def _passage(case: SlidingContact) -> tuple[Array, Array, Array]:
    """Radius of contact [m], its rate [m/s] and mu_0 kappa u_z' [m/s] over a period, (INSTANTS,)."""
    phase = 2 * np.pi / INSTANTS * (np.arange(float(INSTANTS)) + 0.5)
    half = np.pi / INSTANTS
    ends = contact_radius(case, np.append(phase - half, phase[-1] + half))
    rate = np.diff(ends) * case.omega / (2 * half)
    return contact_radius(case, phase), rate, _slip(case, phase)


def _slip(case: SlidingContact, phase: Array) -> Array:
    return np.asarray(case.mu_0 * case.material.mindlin_ratio * case.omega * case.cycle.unit * case.cycle.rate(phase))
