"""Laws of a contact that drags a body: the error of Eq. (15), contact lost, and undamped resonances."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.case.domain import (
    ABOVE_ZERO,
    COULOMB,
    HARMONIC,
    NO_ARMS,
    ON_SPRING,
    UNDERDAMPED,
    UNSHAKEN,
    WITH_MASS,
    Condition,
    holds_for,
)
from mdr.closed_forms.critical_velocity import critical_velocity
from mdr.closed_forms.full_slip import normal_force_harmonics
from mdr.indenters.base import Indenter
from mdr.normal.kelvin_edges import contact_edge, turning_phase
from mdr.normal.normal_force import mean_normal_force
from mdr.normal.springs import SpringArray
from mdr.tools.checks import count, positive

OF_THE_PAPER = (COULOMB, HARMONIC, NO_ARMS, UNSHAKEN)
FLAT = Condition(
    "indenter",
    "a flat punch, whose stiffness is constant",
    lambda case: abs(stiffness_exponent(case.indenter, case.working_depth)) <= 1e-9,
)
VISCOUS = Condition("T", "a slow material, T >> 1", lambda case: case.T > 0)
ANY_AMPLITUDE = "full_slip_critical_velocity"

# --- the error of Eq. (15) at small amplitude ---


def stiffness_exponent(indenter: Indenter, d: float) -> float:
    """Exponent s = d ln k_zc/d ln d [-] with which the contact stiffness of a shape changes about a depth.

    All that v_c knows of a shape at small amplitude (`first_order`): 0 for a flat face, 1/n for f ~ r^n
    [generalisation].

    Parameters
    ----------
    indenter : Indenter
        Any shape.
    d : float
        Depth [m].

    Returns
    -------
    float
        s [-], to 1e-8, by a central difference over 0.02 % of the depth.

    Examples
    --------
    >>> round(mdr.laws.stiffness_exponent(mdr.Paraboloid(R=5e-3), 20e-6), 6)
    0.5
    """
    d, step = positive("d", d, "depth in m"), 1e-4
    low, high = (float(indenter.contact_radius(d * (1 + side * step))) for side in (-1, 1))
    return float(np.log(high / low) / np.log((1 + step) / (1 - step)))


@holds_for(*OF_THE_PAPER, instead=ANY_AMPLITUDE)
def first_order(case: SlidingContact, n_t: int = 4096) -> float:
    """First order C [-] of the error of Eq. (15) in the amplitude: v_c/v_c15 - 1 = C alpha s + O(alpha²).

    s is the `stiffness_exponent` at the mean depth; C knows body and material, not the shape. With q_m the harmonics of
    the force of second order (see the module), at the phase phi where Eq. (15) has its maximum::

        C = sum over m of Re[i m q_m k_zc H(m omega) exp(i m phi)] / |kappa + k_zc (1 + i T) H(omega)|

    A rigid pull has C = 0, and so has a body where nothing dissipates: alpha² is then the leading power. Near omega_0 =
    2 omega the second harmonic resonates, and C is large. Holds for alpha to 0, u_z0 > 0, harmonic depth, elastic or
    Kelvin material [generalisation].

    Parameters
    ----------
    case : SlidingContact
        Body and material count; of the oscillation the frequency and the mean depth.
    n_t : int
        Instants of a period.

    Returns
    -------
    float
        C [-].

    Raises
    ------
    ValueError
        For another motion or material, and on an undamped resonance omega_0 = m omega, where C is infinite.

    Examples
    --------
    >>> case = mdr.SlidingContact(
    ...     mdr.Paraboloid(R=5e-3), mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-3), 0.5,
    ...     mdr.NormalOscillation(u_z0=20e-6, du_z=1e-6, omega=314.0), mdr.SpringPull(k_x=2e4, m=0.1, c_x=4.0),
    ... )
    >>> error = mdr.laws.first_order(case) * case.alpha * mdr.laws.stiffness_exponent(case.indenter, 20e-6)
    >>> truth = mdr.full_slip_critical_velocity(case) / mdr.critical_velocity(case) - 1
    >>> bool(abs(error - truth) < 0.1 * abs(truth))
    True
    """
    q_m = _second_order_force(case.T, n_t)
    m = np.arange(q_m.size)
    H = np.asarray(case.pull.receptance(m * case.omega))
    if not np.all(np.isfinite(H)):
        raise ValueError("the natural frequency of the undamped body is a multiple of omega: C is infinite")
    single = case.material.mindlin_ratio + case.k_zc * (1 + 1j * case.T) * H[1]
    top = np.exp(-1j * np.angle(1j * single))  # exp(i phi) where Eq. (15) has its maximum
    return float(np.sum(np.real(1j * m * q_m * case.k_zc * H * top**m)) / abs(single))


@cache
def _second_order_force(T: float, n_t: int) -> NDArray[np.complex128]:
    """Harmonics q_m of q, the normal force of second order in du_z."""
    phi = 2 * np.pi * np.arange(n_t) / n_t
    edge, p = contact_edge(phi, T), np.cos(phi) - T * np.sin(phi)
    return np.asarray(np.fft.rfft(0.5 * (2 * edge * p - edge**2)) / (n_t / 2))


def load_error(eps: float, n: float) -> float:
    """Error [-] of the linear v_c under an oscillating load and a rigid pull, to second order in dF_z.

    eps²/(2 (n + 1)²) for an elastic shape f ~ r^n whose mass is negligible: the maximum over phi, less 1, of::

        |sin phi| (1 + eps cos phi)^(-p),    p = 1/(n + 1)

    The next term is of order eps⁴ [generalisation].

    Parameters
    ----------
    eps : float
        Relative amplitude dF_z/F_z0 [-], small against 1.
    n : float
        Power of the shape [-], infinite for a flat punch.

    Returns
    -------
    float
        v_c over mu_0 kappa omega dF_z/k_zc, less 1 [-].

    Examples
    --------
    >>> round(mdr.laws.load_error(0.2, 1.0), 6)
    0.005
    """
    return float(eps) ** 2 * (0.5 / (float(n) + 1) ** 2)


# --- what the mean depth does to v_c ---


@holds_for(*OF_THE_PAPER, instead="critical_velocity at two depths")
def depth_sensitivity(case: SlidingContact) -> float:
    """Sensitivity S = d ln v_c/d ln k_xc [-] of Eq. (15) to the contact stiffness, at a given amplitude du_z.

    With q = m omega² - k_x - i omega c_x and z = 1 + i T::

        S = Re[-z k_xc/(q - z k_xc)]

    As the stiffness goes with the depth, d ln v_c/d ln u_z0 = S s, s the `stiffness_exponent`. S is 0 for a rigid pull
    and 1 at k_x = m omega². Holds at small amplitude, harmonic depth, elastic or Kelvin material [generalisation].

    Parameters
    ----------
    case : SlidingContact
        With u_z0 > 0.

    Returns
    -------
    float
        S [-]: per cent of v_c for each per cent of stiffness.

    Raises
    ------
    ValueError
        For another motion or material.

    Examples
    --------
    >>> case = mdr.SlidingContact(
    ...     mdr.Cone(theta=0.05), mdr.Elastic(E=3e6, nu=0.5), 0.5,
    ...     mdr.NormalOscillation(u_z0=20e-6, du_z=1e-6, omega=314.0), mdr.SpringPull(k_x=1e4, m=0.0),
    ... )
    >>> round(mdr.laws.depth_sensitivity(case), 3)  # k_xc/(k_x + k_xc)
    0.119
    """
    if case.pull.is_rigid:
        return 0.0
    q, z = _groups(case)
    return float((-z * case.k_xc / (q - z * case.k_xc)).real)


class LeastOverDepth(NamedTuple):
    """Where v_c is least over the depth."""

    k_xc: float  #: tangential contact stiffness there [N/m]
    over_eq_1: float  #: v_c over Eq. (1) there [-]


@holds_for(*OF_THE_PAPER, ON_SPRING, instead="critical_velocity at several depths")
def least_over_depth(case: SlidingContact) -> LeastOverDepth:
    """Contact stiffness at which Eq. (15) is least over the depth, at a given du_z, and v_c there.

    k_xc = Re(q/z) and ``v_c/v_1 = |Im(q/z)| |z|/|q|``, with q and z of `depth_sensitivity`. There v_c changes only by
    the square of a change in depth. It takes a body above its resonance, q > 0 but for the damper [generalisation].

    Parameters
    ----------
    case : SlidingContact
        Body and material count, and the frequency.

    Returns
    -------
    LeastOverDepth
        k_xc [N/m] and v_c over Eq. (1) [-].

    Raises
    ------
    TypeError
        If the pull has no spring: v_c then depends on no depth.
    ValueError
        For another motion or material, and where no depth has a least v_c.

    Examples
    --------
    >>> case = mdr.SlidingContact(
    ...     mdr.Cone(theta=0.05), mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-3), 0.5,
    ...     mdr.NormalOscillation(u_z0=20e-6, du_z=1e-6, omega=314.0), mdr.SpringPull(k_x=1e3, m=0.1),
    ... )
    >>> mdr.laws.least_over_depth(case).over_eq_1 < 0.5
    True
    """
    q, z = _groups(case)
    k_xc = float((q / z).real)
    if not k_xc > 0:
        raise ValueError("v_c has no minimum over the depth: the body is below its resonance, Re(q/z) <= 0")
    return LeastOverDepth(k_xc, float(abs((q / z).imag) * abs(z) / abs(q)))


# --- contact lost ---


@holds_for(*OF_THE_PAPER, WITH_MASS, UNDERDAMPED, ABOVE_ZERO, FLAT, instead=ANY_AMPLITUDE)
def onset(case: SlidingContact) -> float:
    """Error [-] of Eq. (15) for a flat punch under a body that has just been lost, to leading order.

    With alpha sqrt(1 + T²) = 1 + eps, lambda the free oscillation of the body and t* the time from the loss of contact
    to the maximum of Eq. (15)::

        v_c - v_c15 = mu_0 k_zc u_z0/(m omega_d omega)
                      Im{[A lambda + B lambda²/omega] exp(lambda t*)/(1 - exp(2 pi lambda/omega))}
        elastic: A = (4 sqrt(2)/3) eps^(3/2), B = 0;    Kelvin: A = B/T, B = (9/2) eps²

    over the v_c15 at which contact is lost. The next order is smaller by some eps (elastic) or sqrt(eps) (Kelvin)
    [lost_contact].

    Parameters
    ----------
    case : SlidingContact
        A flat punch, elastic or Kelvin, harmonic depth, under a body with a mass, not over-damped.

    Returns
    -------
    float
        v_c/v_c15 - 1 [-]; 0 while contact is kept, where Eq. (15) is exact.

    Raises
    ------
    TypeError
        If the pull has no spring.
    ValueError
        For another motion or material, a shape whose stiffness depends on the depth, a body without free oscillation.

    Examples
    --------
    >>> case = mdr.SlidingContact(
    ...     mdr.FlatPunch(a=1e-3), mdr.Elastic(E=3e6, nu=0.5), 0.5,
    ...     mdr.NormalOscillation(u_z0=20e-6, du_z=20.02e-6, omega=314.0), mdr.SpringPull(k_x=2e4, m=0.1, c_x=4.0),
    ... )
    >>> truth = mdr.full_slip_critical_velocity(case) / mdr.critical_velocity(case) - 1
    >>> bool(abs(mdr.laws.onset(case) / truth - 1) < 0.01)
    True
    """
    lam, (m, _, _), T = _free_oscillation(case), case.pull.coefficients, case.T
    eps = case.alpha * float(np.hypot(1, T)) - 1
    if eps <= 0:
        return 0.0
    omega, k_zc = case.omega, case.k_zc
    single = case.material.mindlin_ratio + k_zc * (1 + 1j * T) * complex(case.pull.receptance(omega))
    later = (-np.angle(1j * single) - turning_phase(T)) % (2 * np.pi) / omega  # t*
    A, B = (4 * np.sqrt(2) / 3 * eps**1.5, 0.0) if T == 0 else (4.5 * eps**2 / T, 4.5 * eps**2)
    passed_on = (A * lam + B * lam**2 / omega) * np.exp(lam * later) / (1 - np.exp(2 * np.pi * lam / omega))
    faster = case.mu_0 * k_zc * case.working_depth / (m * lam.imag * omega) * passed_on.imag
    return float(faster / (critical_velocity(case) / (1 + eps)))


@holds_for(*OF_THE_PAPER, VISCOUS, WITH_MASS, UNDERDAMPED, instead=ANY_AMPLITUDE)
def blow(case: SlidingContact, n_springs: int = 4096) -> float:
    """Critical velocity [m/s] of a slow material, T >> 1, that loses contact under a body.

    Once in a period the contact gives the body a blow. With k the stiffness and d the greatest compression of a spring,
    and delta = sqrt(4 pi d/(T du_z))::

        v_c = 2 pi mu_0/(m omega omega_d) Im{lambda sum[k d exp(2 lambda delta/3 omega)]/[1 - exp(2 pi lambda/omega)]}

    lambda = -c_x/2m + i omega_d. Good up to terms in 1/T; Eq. (15), whose force keeps pulling in the time of flight,
    grows with T instead. Any shape, harmonic depth, Kelvin material [lost_contact].

    Parameters
    ----------
    case : SlidingContact
        Kelvin material, harmonic depth, under a body with a mass, not over-damped.
    n_springs : int
        Springs of the sum.

    Returns
    -------
    float
        v_c [m/s].

    Raises
    ------
    TypeError
        If the pull has no spring.
    ValueError
        For another motion or material, an elastic one included, and a body without free oscillation.

    Examples
    --------
    >>> case = mdr.SlidingContact(
    ...     mdr.Cone(theta=0.05), mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e3), 0.5,
    ...     mdr.NormalOscillation(u_z0=20e-6, du_z=20e-6, omega=314.0), mdr.SpringPull(k_x=2e4, m=0.1, c_x=4.0),
    ... )
    >>> bool(abs(mdr.laws.blow(case) / mdr.full_slip_critical_velocity(case) - 1) < 1e-4)
    True
    """
    lam, (m, _, _) = _free_oscillation(case), case.pull.coefficients
    omega, du_z = case.omega, case.cycle.du_z
    springs = SpringArray.of(case, n_springs)
    depth = np.maximum(du_z - springs.gap, 0)
    early = 2 / 3 * np.sqrt(4 * np.pi * depth / (case.T * du_z)) / omega
    impulse = 2 * np.pi / omega * case.mu_0 * springs.dk_z * depth
    answer = lam * np.exp(lam * early) / (1 - np.exp(2 * np.pi * lam / omega))
    return float(np.sum(impulse * answer.imag) / (m * lam.imag))


@holds_for(*OF_THE_PAPER, WITH_MASS, instead=ANY_AMPLITUDE)
def half_a_blow(case: SlidingContact) -> float:
    """Limit [m/s] of `blow` for T to infinity under a light damper: pi mu_0 F_N(u_z0 + du_z)/(m omega).

    Half of the velocity that one blow gives to the body, F_N the elastic force at the deepest point: whatever its
    spring and the shape. Not near omega_0 = n omega, where the blows add up: on it v_c is larger by the factor
    2/[1 - exp(-2 pi n zeta)], zeta the damping ratio [lost_contact].

    Parameters
    ----------
    case : SlidingContact
        Harmonic depth, material without arms, under a body with a mass.

    Returns
    -------
    float
        v_c [m/s].

    Raises
    ------
    TypeError
        If the pull has no spring.
    ValueError
        For another motion or material, and a body without mass.

    Examples
    --------
    >>> case = mdr.SlidingContact(
    ...     mdr.FlatPunch(a=1e-3), mdr.KelvinVoigt(E=3e6, nu=0.5, tau=10.0), 0.5,
    ...     mdr.NormalOscillation(u_z0=20e-6, du_z=20e-6, omega=314.0), mdr.SpringPull(k_x=2e4, m=0.1, c_x=4.0),
    ... )
    >>> round(mdr.laws.half_a_blow(case), 4)
    0.016
    """
    F = float(case.indenter.force(case.u_z_max, case.material.E_star))
    return float(np.pi * case.mu_0 * F / (case.pull.coefficients[0] * case.omega))


# --- an undamped body on a multiple of the frequency ---


@holds_for(COULOMB, instead="slide or cof_curve")
def harmonic_share(case: SlidingContact, n: int) -> float:
    """Share ``|F_n|/F_0`` [-] of the n-th harmonic in the normal force: what friction stays short of on a resonance.

    The n-th harmonic drives an undamped body of omega_0 = n omega until it comes to rest on the indenter once in each
    of its own periods; from the velocity of Eq. (15) on, however fast the pull, mu/mu_0 tends to ``1 - |F_n|/F_0``, and
    there is no critical velocity. At finite velocity this is exceeded by a share ~ v_0^(-1/2). The share goes like
    alpha^n for a curved elastic contact, like alpha² for a Kelvin one, and is half the relative amplitude of the force
    of a punch that keeps contact, n = 1; a punch has no others [resonances].

    Parameters
    ----------
    case : SlidingContact
        Any; the pull has no part in it.
    n : int
        Multiple, at least 1.

    Returns
    -------
    float
        ``|F_n|/F_0`` [-].

    Examples
    --------
    >>> case = mdr.SlidingContact(
    ...     mdr.FlatPunch(a=1e-3), mdr.Elastic(E=3e6, nu=0.5), 0.5, mdr.NormalOscillation(20e-6, 6e-6, 314.0)
    ... )
    >>> round(mdr.laws.harmonic_share(case, 1), 6)
    0.15
    """
    n = count("n", n, 1)
    F_n = normal_force_harmonics(case)
    return float(abs(F_n[n]) / F_n[0].real)


@holds_for(COULOMB, WITH_MASS, instead=ANY_AMPLITUDE)
def resonance_residue(case: SlidingContact, n: int) -> float:
    """Limit [m/s] of v_c times the detuning ``|omega_0/omega - n|`` of an undamped body, on its resonance: its pole.

    ``mu_0 |F_n|/(m omega)``. Over Eq. (15) it is half the width of the window, in omega_0/omega, in which v_c exceeds
    Eq. (15) by its own amount [resonances].

    Parameters
    ----------
    case : SlidingContact
        Under a body with a mass.
    n : int
        Multiple, at least 1.

    Returns
    -------
    float
        ``v_c |omega_0/omega - n|`` [m/s].

    Raises
    ------
    TypeError
        If the pull has no spring.
    ValueError
        If the body has no mass.

    Examples
    --------
    >>> case = mdr.SlidingContact(
    ...     mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5), 0.5, mdr.NormalOscillation(20e-6, 6e-6, 314.0),
    ...     mdr.SpringPull(k_x=4e4, m=0.1),
    ... )
    >>> f"{mdr.laws.resonance_residue(case, 2):.3g}"
    '4.56e-06'
    """
    share = harmonic_share(case, n)
    residue = case.mu_0 * share * mean_normal_force(case)
    return float(residue / (case.pull.coefficients[0] * case.omega))


def lock_in(n: int) -> float:
    """Velocity over Eq. (15) [-] from which friction is full where omega_0 = n omega and no harmonic drives the body.

    cos(pi/2n). A force without an n-th harmonic, as a punch has it, does not drive the undamped body, but a free
    oscillation keeps its phase to the drive for ever. What instants of stick leave of it is such that nothing sticks:
    the least maximum of V sin(phi) + b sin(n phi) over b, V that of Eq. (15). Off the multiple, or damped, Eq. (15) is
    left [resonances].

    Parameters
    ----------
    n : int
        Multiple, at least 2; on 1 the body is driven.

    Returns
    -------
    float
        cos(pi/2n) [-].

    Examples
    --------
    >>> round(mdr.laws.lock_in(2), 4)
    0.7071
    """
    return float(np.cos(np.pi / (2 * count("n", n, 2))))


# --- the body of a case ---


def _groups(case: SlidingContact) -> tuple[complex, complex]:
    """Dynamic stiffness q [N/m] of the body and z = 1 + i T."""
    (m, c_x, k_x), omega = case.pull.coefficients, case.omega
    return complex(m * omega**2 - k_x, -c_x * omega), complex(1, case.T)


def _free_oscillation(case: SlidingContact) -> complex:
    """lambda [rad/s] of the free body on its spring and damper."""
    pull = case.pull
    m, c_x, _ = pull.coefficients
    return complex(-c_x / (2 * m), pull.omega_0 * np.sqrt(1 - pull.damping_ratio**2))
