"""Laws that the paper does not have: where Eq. (1) and Eq. (15) end, how large their error is, what v_c is beyond, and
what becomes of friction where the contact is shaken along its way.

They were derived here, and each is tested beside runs or beside the full-slip condition by a claim of the report
(`python -m validation`), named in brackets at its end. "Eq. (n)" alone is the paper, see mdr/closed_forms/paper.py.

Symbols: alpha = du_z/u_z0 [-], T = omega tau [-], the loss tangent of a Kelvin material (0 if elastic), phi = omega t
phase of the oscillation, v_1 = mu_0 kappa omega du_z velocity of Eq. (1) [m/s], kappa = E*/G* [-], k_zc, k_xc contact
stiffness at the mean depth [N/m], F_N normal force [N], H receptance of the pull [m/N], omega_0 natural frequency of
the body [rad/s], n power of a shape f ~ r^n, infinite for a flat punch.

Rigid pull, contact lost
    In full slip every spring in contact slips at v_0 - v_1 (-sin phi). So v_c = v_1 if any spring touches at phi =
    -pi/2, where the depth grows fastest. The centre touches longest. Its surface, once left, relaxes like
    exp(-theta/T), so it is back at the phase phi_c given by `touch_depth`, and v_c = v_1 sin|phi_c| if that is late.

Body, flat punch that has just been lost
    With alpha sqrt(1 + T²) = 1 + eps contact is lost around the phase pi - arctan T, where the punch would press by
    k_zc u_z0 (x² - a²)/2, a² = 2 eps, x the phase from there. Elastic: a pull lasting from -a to a is missing, an
    impulse of k_zc u_z0 times (4 sqrt(2)/3) eps^(3/2). Kelvin: the spring stays off until its relaxed surface is met,
    where the integral of the force times exp(x/T) vanishes, at x = 2 a: what was missing as a pull is missing again as
    pressure. What remains is a doublet, with the impulse and the first moment k_zc u_z0 (9/2) eps² times 1/T and -1.
    The body passes these on by its free oscillation.

Body, slow material, T >> 1
    The surface hardly recovers while it is left. A spring of stiffness k whose greatest compression is d loses
    2 pi d/T of it in a period, and is pressed back through as much from the phase -delta to the deepest point, so
    du_z delta²/2 = 2 pi d/T. It presses like a dashpot, by k T du_z times the phase that is left: a blow, whose impulse
    is that of k d over the whole period. The blows of all springs end together, at the deepest point.

Body, finite amplitude
    A curved contact grows and shrinks within the period. With s = d ln k_zc/d ln d the normal force is, to second order
    in du_z, F(u_z0) + k_zc du_z [p + alpha s q], p = cos(phi) - T sin(phi), q = (2 e p - e²)/2, where u_z0 + du_z e is
    the depth at the edge of the contact. The receptance turns each harmonic of q into a motion of the body.
"""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact, require_case
from mdr.closed_forms.critical_velocity import critical_velocity
from mdr.closed_forms.full_slip import mean_normal_force, normal_force_harmonics
from mdr.closed_forms.paper import deficit
from mdr.indenters.base import Indenter
from mdr.normal.kelvin_edges import contact_edge, turning_phase
from mdr.normal.resolved import resolved
from mdr.normal.springs import SpringArray
from mdr.tools.checks import between, count, finite, instance, not_negative, positive

Array = NDArray[np.float64]


# --- rigid pull: when the centre touches again ---


def touch_depth(phase: float, T: float) -> float:
    """Depth ratio u_z0/du_z [-] from which the centre of a contact is in touch at a phase.

    The maximum over theta > 0, how long ago, of::

        [cos(phase - theta) exp(-theta/T) - cos(phase)]/[1 - exp(-theta/T)]

    Any shape, harmonic depth, elastic or Kelvin [lost_contact].

    Parameters
    ----------
    phase : float
        Phase omega t [rad] in [3 pi/2, 2 pi], where the depth grows.
    T : float
        Loss tangent omega tau [-], 0 for an elastic material.

    Returns
    -------
    float
        Least u_z0/du_z [-].

    Examples
    --------
    >>> float(round(mdr.laws.touch_depth(1.75 * np.pi, 0.0), 6))  # elastic: -cos(phase)
    -0.707107
    """
    from scipy.optimize import minimize_scalar

    phase, T = finite("phase", phase), not_negative("T", T, "omega tau")
    if not 1.5 * np.pi <= phase <= 2 * np.pi:
        raise ValueError(f"phase must lie in [3 pi/2, 2 pi], where the depth grows, got {phase!r}")
    if T == 0:
        return float(-np.cos(phase))
    found = minimize_scalar(
        lambda theta: (np.cos(phase - theta) * np.exp(-theta / T) - np.cos(phase)) / np.expm1(-theta / T),
        bounds=(phase - np.pi + np.arctan(T), phase),  # left while the depth fell
        method="bounded",
        options={"xatol": 1e-12},
    )
    return float(-found.fun)


def late_return(depth: float, T: float) -> float:
    """Critical velocity of a rigid pull over that of Eq. (1) [-]: 1, or less where the surface comes back late.

    It is 1 as long as the centre touches a quarter period before the deepest point, and sin|phi_c| beyond, phi_c the
    phase at which the centre touches again (`touch_depth`). The same for all shapes. Harmonic depth, elastic or Kelvin,
    tapping included [rigid_pull, lost_contact].

    Parameters
    ----------
    depth : float
        Depth ratio u_z0/du_z [-], above -1: the indenter touches.
    T : float
        Loss tangent omega tau [-], 0 for an elastic material.

    Returns
    -------
    float
        v_c/(mu_0 kappa omega du_z) [-], in (0, 1].

    Raises
    ------
    ValueError
        If the indenter never touches.

    Examples
    --------
    >>> mdr.laws.late_return(0.5, 0.0)  # elastic: lost at du_z = 2 u_z0, and back in time
    1.0
    >>> round(mdr.laws.late_return(1.0, 30.0), 3)  # a slow rubber is not
    0.743
    """
    from scipy.optimize import brentq

    depth, T = finite("depth", depth), not_negative("T", T, "omega tau")
    if depth <= -1:
        raise ValueError(f"depth = u_z0/du_z must be above -1, got {depth!r}: the indenter never touches")
    if depth >= touch_depth(1.5 * np.pi, T):
        return 1.0
    return float(-np.sin(brentq(lambda phase: touch_depth(phase, T) - depth, 1.5 * np.pi, 2 * np.pi, xtol=1e-14)))


def amplitude_limit(T: float) -> float:
    """Relative amplitude du_z/u_z0 [-] up to which Eq. (1) holds under a rigid pull.

    alpha_1, the minimum over pi < theta < 2 pi of::

        [exp(theta/T) - 1]/(-sin theta)

    far above the limit 1/sqrt(1 + T²) of Eq. (5), at which contact is lost. Beyond, see `late_return`. Any shape,
    harmonic depth, u_z0 > 0 [lost_contact].

    Parameters
    ----------
    T : float
        Loss tangent omega tau [-], 0 for an elastic material.

    Returns
    -------
    float
        alpha_1 [-]; infinite for an elastic material.

    Examples
    --------
    >>> round(mdr.laws.amplitude_limit(10.0), 3)
    0.58
    """
    depth = touch_depth(1.5 * np.pi, T)
    return 1 / depth if depth > 1e-300 and T > 0 else np.inf


def slow_limit() -> float:
    """Limit of `amplitude_limit` times T for a very slow material, T to infinity [-]: 4.60.

    The minimum of theta/(-sin theta), sqrt(1 + theta²) at tan theta = theta [lost_contact].

    Returns
    -------
    float
        alpha_1 T [-]; at finite T the limit is higher by a share of 2.25/T.

    Examples
    --------
    >>> round(mdr.laws.slow_limit(), 4)
    4.6033
    """
    from scipy.optimize import brentq

    return float(np.hypot(1, brentq(lambda theta: np.sin(theta) - theta * np.cos(theta), 1.1 * np.pi, 1.5 * np.pi)))


# --- rigid pull: the COF curve ---


def edge_band(v_hat: float) -> float:
    """First order C(v_hat) [-] in the amplitude of the COF curve of an elastic contact under a rigid pull.

    For a shape f ~ r^n the friction that is lost is, with psi(v_hat) = `mdr.closed_forms.paper.deficit`::

        (1 - mu/mu_0) <F_N>/(k_zc du_z) = psi(v_hat) [1 + C(v_hat) alpha/n + O(alpha²)]

    C is what the springs at the edge of the contact add: the lag of springs of gaps from -1 to 1 over that of as many
    of the core, less 1. Exact for the flat punch and the cone. Contact kept, alpha < 1 [one_curve].

    Parameters
    ----------
    v_hat : float
        Velocity v_0/v_c [-], between 0 and 1.

    Returns
    -------
    float
        C [-], from -1/4 at rest to 0 at v_c.

    Raises
    ------
    ValueError
        If v_hat is not between 0 and 1.

    Examples
    --------
    >>> round(mdr.laws.edge_band(0.1), 4)
    -0.2285
    """
    from scipy.optimize import brentq

    v = between("v_hat", v_hat, 0, 1, "v_0/v_c")
    first, last = np.pi + np.arcsin(v), 2 * np.pi - np.arcsin(v)  # touches that are followed by a stick at once
    node, weight = np.polynomial.legendre.leggauss(60)
    total = 0.0
    for theta, w in zip(first + (last - first) * (node + 1) / 2, (last - first) / 2 * weight, strict=True):
        turn = 3 * np.pi - np.arcsin(v)  # where the depth falls as fast as the pull; the stick ends before
        end = brentq(lambda t, at=theta: np.cos(t) - np.cos(at) - v * (t - at), last, turn, xtol=1e-14)
        span = end - theta
        lag = (np.sin(end) - np.sin(theta) - np.cos(theta) * span - v * span**2 / 2) / (2 * np.pi)
        total += w * lag * -np.sin(theta)
    return float(total / deficit(v) - np.sqrt(1 - v**2))  # gaps from -1 to cos(first) have the lag psi


def rise_of_lost_punch(depth: float, T: float) -> float:
    """Rise of the COF of a Kelvin punch from its static value zero, contact lost in every period, rigid pull.

    A free spring relaxes and forgets, so friction starts in proportion to the velocity. In contact for D of the period
    and free for 2 pi - D, the punch is dragged, per v_0/v_c, by::

        [D²/2 + D (T + D/(exp((2 pi - D)/T) - 1))]/(2 pi)

    For contacts that are kept see `mdr.closed_forms.rigid_pull.small_velocity` [static_cof].

    Parameters
    ----------
    depth : float
        Depth ratio u_z0/du_z [-], between 0 and sqrt(1 + T²).
    T : float
        Loss tangent omega tau [-], above 0.

    Returns
    -------
    float
        Limit of (mu/mu_0) <F_N>/(k_zc du_z) over v_0/v_c for v_0 to 0 [-].

    Raises
    ------
    ValueError
        If the punch keeps contact, or hangs above the surface on average.

    Examples
    --------
    >>> round(mdr.laws.rise_of_lost_punch(0.5, 1.0), 3)
    1.398
    """
    from scipy.optimize import brentq

    T = positive("T", T, "omega tau")
    depth = between("depth", depth, 0, float(np.hypot(1, T)), "u_z0/du_z of a punch that is lost")
    release = np.arccos(-depth / np.hypot(1, T)) - np.arctan(T)  # where its force vanishes
    left = depth + np.cos(release)
    touch = brentq(lambda p: depth + np.cos(p) - left * np.exp(-(p - release) / T), release + 0.5, 2 * np.pi)
    D = float(release + 2 * np.pi - touch)
    return float((D**2 / 2 + D * (T + D / np.expm1((2 * np.pi - D) / T))) / (2 * np.pi))


# --- a body: the error of Eq. (15) at small amplitude ---


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
    case = _of_the_paper(case)
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


# --- a body: what the mean depth does to v_c ---


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
    case = _of_the_paper(case)
    if case.pull.is_rigid:
        return 0.0
    q, z = _groups(case)
    return float((-z * case.k_xc / (q - z * case.k_xc)).real)


class LeastOverDepth(NamedTuple):
    """Where v_c is least over the depth."""

    k_xc: float  #: tangential contact stiffness there [N/m]
    over_eq_1: float  #: v_c over Eq. (1) there [-]


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
    q, z = _groups(_of_the_paper(case))
    k_xc = float((q / z).real)
    if k_xc <= 0:
        raise ValueError("v_c has no minimum over the depth: the body is below its resonance, Re(q/z) <= 0")
    return LeastOverDepth(k_xc, float(abs((q / z).imag) * abs(z) / abs(q)))


def _groups(case: SlidingContact) -> tuple[complex, complex]:
    """Dynamic stiffness q [N/m] of the body and z = 1 + i T."""
    (m, c_x, k_x), omega = _oscillator(case), case.omega
    return complex(m * omega**2 - k_x, -c_x * omega), complex(1, case.T)


# --- a body: contact lost ---


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
    case = _of_the_paper(case)
    lam, m, T = _free_oscillation(case), _mass(case), case.T
    if abs(stiffness_exponent(case.indenter, case.working_depth)) > 1e-9:
        raise ValueError(f"{case.indenter!r}: the onset is that of a flat punch, whose stiffness is constant")
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
    case = _of_the_paper(case)
    if case.T == 0:
        raise ValueError("T = 0: an elastic surface is back at once; the law is that of a slow material, T >> 1")
    lam, m, omega, du_z = _free_oscillation(case), _mass(case), case.omega, case.cycle.du_z
    springs = SpringArray.of(case, n_springs)
    depth = np.maximum(du_z - springs.gap, 0)
    early = 2 / 3 * np.sqrt(4 * np.pi * depth / (case.T * du_z)) / omega
    impulse = 2 * np.pi / omega * case.mu_0 * springs.dk_z * depth
    answer = lam * np.exp(lam * early) / (1 - np.exp(2 * np.pi * lam / omega))
    return float(np.sum(impulse * answer.imag) / (m * lam.imag))


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
    case = _of_the_paper(case)
    F = float(case.indenter.force(case.u_z_max, case.material.E_star))
    return float(np.pi * case.mu_0 * F / (_mass(case) * case.omega))


# --- an undamped body on a multiple of the frequency ---


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
    F_n = normal_force_harmonics(require_case(case))
    return float(abs(F_n[n]) / F_n[0].real)


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
    return float(residue / (_mass(case) * case.omega))


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


# --- shaken along the slide ---


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
    if not require_case(case).pull.is_rigid:
        raise TypeError(f"this law is that of a rigid pull, got {case.pull!r}")
    if case.rheology.remembers or case.repeats not in ((1, 0), (0, 1), (1, 1)):
        raise ValueError("this law is that of an elastic contact whose depth and way have one frequency")
    v_0 = finite("v_0", v_0)
    v_c = critical_velocity(case, 1 if v_0 >= 0 else -1)
    if v_c == 0:
        return 0.0
    case = resolved(case)
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


# --- what a case must be ---


def _of_the_paper(case: SlidingContact) -> SlidingContact:
    if not require_case(case).is_of_the_paper or case.is_shaken:
        raise ValueError(
            "this law is known for a harmonic depth, a material without arms and no shake in the plane only"
        )
    return case


def _oscillator(case: SlidingContact) -> tuple[float, float, float]:
    """m [kg], c_x [N s/m] and k_x [N/m] of the body on its spring."""
    if case.pull.is_rigid:
        raise TypeError(f"this law is that of a body on a spring; pull must be a SpringPull, got {case.pull!r}")
    return case.pull.coefficients


def _mass(case: SlidingContact) -> float:
    """m [kg] of the body, above 0."""
    m, _, _ = _oscillator(case)
    if m == 0:
        raise ValueError("m = 0: this law is that of a body with a mass")
    return m


def _free_oscillation(case: SlidingContact) -> complex:
    """lambda [rad/s] of the free body on its spring and damper."""
    m, pull = _mass(case), case.pull
    if pull.damping_ratio >= 1:
        raise ValueError(f"damping ratio {pull.damping_ratio:.3g}: it must be below 1 for a free oscillation")
    return complex(-pull.coefficients[1] / (2 * m), pull.omega_0 * np.sqrt(1 - pull.damping_ratio**2))
