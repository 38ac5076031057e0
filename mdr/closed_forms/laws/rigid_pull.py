"""Laws of a contact under a rigid pull: when its centre touches again, and the two ends of the COF curve."""

from __future__ import annotations

import numpy as np

from mdr.closed_forms.paper import deficit, lag_of_stick
from mdr.tools.checks import between, finite, not_negative, positive

#: nodes in a time of stick; with them e^(ix), x from 0 to 2 pi, is exact
_NODES = 24

# --- when the centre touches again ---


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


# --- the COF curve ---


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
    v = between("v_hat", v_hat, 0, 1, "v_0/v_c")
    first, last = np.pi + np.arcsin(v), 2 * np.pi - np.arcsin(v)  # touches that are followed by a stick at once
    node, weight = np.polynomial.legendre.leggauss(60)
    theta = first + (last - first) * (node + 1) / 2
    lags = np.array([lag_of_stick(one, v) for one in theta.tolist()])
    total = (last - first) / 2 * weight @ (lags * -np.sin(theta))
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
    return stick_impedance(float((release - touch) / (2 * np.pi) + 1), 1.0, 1.0, tau=T).real


def stick_impedance(stick: float, k_x: float, omega: float, slow: float = 0.0, tau: float = 0.0) -> complex:
    """Mechanical impedance [N s/m] that a vibrated contact has for a small motion besides its pull.

    Springs that stick for d = stick 2 pi/omega once in each period follow the motion meanwhile, and forget it in slip
    and in flight, at once or in the time tau. Their mean force over velocity is, for the slowest motion::

        (k_x omega/2 pi) [d²/2 + tau d + d²/(exp((2 pi/omega - d)/tau) - 1)]

    This is the slope of friction over velocity, F_N dCOF/dv_0, and acts as a damper. For an elastic contact it does so
    up to a share of (slow d)²/12. A faster motion meets the real part as a damper, and -slow times the imaginary one as
    a spring. Rigid pull, any shape and amplitude, elastic or Kelvin, Coulomb's friction or a shear strength; first
    order in the small motion [damping].

    Parameters
    ----------
    stick : float
        Share of the period in stick [-], from 0 to below 1.
    k_x : float
        Tangential stiffness of the springs [N/m].
    omega : float
        Angular frequency of the vibration [rad/s].
    slow : float
        That of the small motion [rad/s], below omega, and not omega/2, at which its phase matters.
    tau : float
        Relaxation time of a Kelvin material [s], 0 for an elastic one.

    Returns
    -------
    complex
        Force over velocity [N s/m], both times exp(i slow t).

    Raises
    ------
    ValueError
        For what is out of these ranges.

    Examples
    --------
    >>> round(mdr.laws.stick_impedance(0.5, 1e7, 2 * np.pi * 1000).real)  # k_x stick² pi/omega
    1250
    """
    stick = between("stick", stick, 0, 1, "share of the period in stick")
    k_x, omega, tau = positive("k_x", k_x), positive("omega", omega), not_negative("tau", tau)
    slow = between("slow", slow, -omega, omega, "angular frequency of a slow motion")
    period, d = 2 * np.pi / omega, stick * 2 * np.pi / omega
    node, weight = np.polynomial.legendre.leggauss(_NODES)
    share, weight = (node + 1) / 2, weight / 2
    turn = np.exp(-1j * slow * d * share)
    kept = np.exp(-(period - d) / tau) if tau else 0.0  # of what a stick has added, when the next begins
    added = kept * abs(weight @ turn) ** 2 / (np.exp(1j * slow * period) - kept)
    return complex(k_x * stick * (d * (weight @ ((1 - share) * turn) + added) + tau))
