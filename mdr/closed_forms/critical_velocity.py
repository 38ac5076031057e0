"""The critical velocity of a case in closed form: Eq. (15), or what takes its place, with the numbers of the case."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact, require_case
from mdr.case.motion import LoadOscillation
from mdr.closed_forms.full_slip_body import full_slip_critical_velocity
from mdr.closed_forms.paper import linear_critical_velocity
from mdr.normal.resolved import at_rest, resolved

UP_TO = 1.3  #: of `velocity_scale`, at which friction has become mu_0: end of a curve
NEARLY = 0.01  #: share of mu_0 that a fast slide still lacks where friction counts as full again
POINTS = 24  #: of a curve: its corner at v_c is seen to a twentieth


def critical_velocity(case: SlidingContact, direction: int = 1) -> float:
    """Critical velocity [m/s] in closed form, Eq. (15): pulled faster, the oscillation no longer lowers friction.

    The stiffnesses k_zc, k_xc and the damping gamma_zc of the contact are those at the mean depth.

    Parameters
    ----------
    case : SlidingContact
        The contact.
    direction : {1, -1}
        1 is the pull forward, -1 the pull the other way, whose velocity is given as a positive number too. They differ
        only where something shakes in the plane and in the normal direction.

    Returns
    -------
    float
        v_c [m/s]. Infinite on an undamped resonance, k_x = m omega² or k_zc = m_z omega².

    Raises
    ------
    TypeError
        For what is no SlidingContact.
    ValueError
        For another direction.

    See Also
    --------
    full_slip_critical_velocity : for any amplitude.
    measure_critical_velocity : from runs alone.
    verdict : how good Eq. (15) is.

    Notes
    -----
    With kappa = k_zc/k_xc and D = m omega² - k_x - i omega c_x ::

        v_c = mu_0 du_z omega |kappa (D - k_xc) - i gamma_zc omega| / |D|

    Without the damper of the system, c_x = 0, this is Eq. (15) as M. Popov wrote it (Facta Universitatis, Series:
    Mechanical Engineering 14 (2016) 335) ::

        v_c = mu_0 du_z omega sqrt((gamma_zc omega)² + (kappa (m omega² - k_xc - k_x))²) / |m omega² - k_x|

    and c_x enters as k_x + i omega c_x in the place of k_x. A rigid pull is the limit k_x -> infinity, Eq. (1):
    v_c = mu_0 du_z omega kappa. Eq. (1) is also left with u_z0 <= 0 (tapping), where the contact has no stiffness at
    the mean depth.

    Materials with arms enter by their dynamic stiffness K_z(omega) = 2 a E*(omega). A periodic motion enters with all
    its harmonics (`mdr.closed_forms.paper.linear_critical_velocity`). An oscillating load enters by the depth that it
    causes at small amplitude, with K_z at the depth of F_z0 ::

        v_c = mu_0 omega dF_z |kappa + K_z H|/|K_z - m_z omega²|

    A shake along the pull adds its own velocity. With X exp(i omega t) the way on which it takes the indenter, at the
    tool du_x exp(i phi_x), at the pull this times (k_x + i omega c_x) H, and the upper sign forward ::

        v_c = omega |mu_0 (kappa + K_z H) du_z -+ X|

    Alone it has v_c = omega abs(X), which knows neither shape nor depth nor material. Shaken across the pull a contact
    has full friction at no velocity, and v_c is infinite.

    A shear strength of the face changes nothing on a flat face that keeps contact. On a curved elastic one there is no
    critical velocity, and v_c is infinite. On a dashpot it is back, known by the full-slip condition alone, which is
    answered then: it knows depth, relaxation time and amplitude.

    Where friction falls, mu_s > mu_k, mu_0 is mu_k: springs that keep contact do not know mu_s. Just below v_c friction
    is above that of sliding, and on an elastic material under a rigid pull it falls there by a jump
    (`mdr.laws.falling_friction`). Springs that touch anew stick up to a higher velocity, which
    `full_slip_critical_velocity` has.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> slider = mdr.SpringPull(k_x=2e4, m=0.05)
    >>> rubber = mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-3)
    >>> case = mdr.SlidingContact(mdr.Cone(theta=0.0127), rubber, 0.4, oscillation=vibration, pull=slider)
    >>> print(f"{mdr.critical_velocity(case):.3g} m/s")
    0.000486 m/s
    """
    if _knows_full_slip_alone(require_case(case)):
        return full_slip_critical_velocity(case, direction)
    case = at_rest(case).pulled(direction)
    u_n, X_n = _depth_harmonics(case), case.way
    if case.moves_across or not (np.isfinite(u_n).all() and np.isfinite(X_n).all()):
        return float("inf")
    size = max(u_n.size, X_n.size)
    u_n, X_n = (np.pad(values, (0, size - values.size)) for values in (u_n, X_n))
    n_omega = case.omega * np.arange(1, size + 1)
    H_n = np.asarray(case.pull.receptance(n_omega)) if case.k_zc else np.zeros(size)
    K_n = case.dynamic_stiffness(n_omega)
    return linear_critical_velocity(case.mu_0, case.omega, u_n, case.material.mindlin_ratio, K_n, H_n, X_n)


def _knows_full_slip_alone(case: SlidingContact) -> bool:
    """Whether a shear strength leaves the condition of full slip alone: where its edge moves."""
    return case.friction.needs_area and resolved(case).strength_moves


def velocity_scale(case: SlidingContact) -> float:
    """Velocity [m/s] that a curve is scaled by: v_c in closed form, or Eq. (1) where that is infinite or zero.

    Of a rigid pull on a curved face with a shear strength it is the less of both, as friction is back long before v_c.
    """
    v_c, known = critical_velocity(case), resolved(case)
    pace = known.pace if np.isfinite(known.pace) else known.unit_velocity
    if case.pull.is_rigid and _knows_full_slip_alone(case):
        return min(v_c, pace)
    return v_c if np.isfinite(v_c) and v_c > 0 else pace


def _depth_harmonics(case: SlidingContact) -> NDArray[np.complex128]:
    """u_n [m], (N,), of the depth over the period of the case; under a load those that it causes at small amplitude."""
    load, n_z = case.oscillation.load, case.repeats[0]
    if load is None:
        return np.asarray(case.cycle.unit * case.cycle.harmonics)
    if not isinstance(load, LoadOscillation):
        return np.zeros(1, dtype=complex)
    u_n = np.zeros(n_z, dtype=complex)
    impedance = complex(case.dynamic_stiffness(load.omega)) - load.m_z * load.omega**2
    u_n[-1] = load.dF_z / impedance if impedance else np.inf
    return u_n


def formula_of(case: SlidingContact) -> str:
    """Which closed form critical_velocity(case) is, in words; without stiffness at the mean depth Eq. (1) is left."""
    if _knows_full_slip_alone(case):
        return "full slip with tau_0"
    case = at_rest(case)
    plain = case.pull.is_rigid or case.k_zc == 0
    if case.is_shaken:
        return f"Eq. ({1 if plain else 15}) with the shake"
    if case.oscillation.load is not None:
        return "Eq. (15) at the depth that the load brings about"
    if plain:
        return "Eq. (1)"
    return "Eq. (15)" + (" with the dynamic stiffness of the material" if case.material.contact_arms else "")
