"""The full-slip periodic solution: any shape, any amplitude, any material, any periodic depth.

While every spring slides forward, e_i = mu_0 kappa s_i for all of them, through loss and return of contact too,
because the same operator acts on both sides of Coulomb's law. The tangential force is then mu_0 F_N(t), whatever the
velocity, and every spring in contact slips at the same velocity u_x' - mu_0 kappa u_z'. They all reach the stick
limit together: this is why one closed form can hold for an array.

F_N is that of normal/normal_force.py. With its harmonics F_n and the receptance H, y = -mu_0 sum F_n H(n omega) exp(i n
omega t), and the critical velocity is

    v_c = max over instants with contact of [mu_0 kappa u_z' - y'].

One harmonic gives Eq. (15); a rigid pull, H = 0, gives Eq. (1) when contact is kept.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.case.depth_cycle import least_of
from mdr.case.domain import ELASTIC, RIGID, UNSHAKEN, domain_of, holds_for, where_it_falls
from mdr.closed_forms.across import static_across
from mdr.closed_forms.held_body import CLOSE, held_forward
from mdr.closed_forms.shaken_pull import CLOSED_FORM, ShakenPull, average_friction
from mdr.normal.followed_force import N_STEPS
from mdr.normal.normal_force import followed, full_cof, known_harmonics, mean_normal_force, normal_force
from mdr.normal.resolved import resolved
from mdr.tools.arrays import SAME


@holds_for(*where_it_falls(RIGID, ELASTIC, UNSHAKEN), instead="slide(case, v_0) at a slow pull")
def static_cof(case: SlidingContact) -> float:
    """Coefficient of friction [-] in the limit v_0 -> 0: mu_0 min F_N/mean F_N over the period.

    With a shear strength of the face it is (mu_0 min F_N + tau_0 pi min a²)/mean F_N, a the radius of contact. Where
    friction falls it is (mu_s + mu_k)/2 min F_N/mean F_N on an elastic material under a rigid pull: in each minimum of
    the load that it comes to, a spring goes from mu_s to mu_k of it, and back on a line in many periods.

    Parameters
    ----------
    case : SlidingContact
        The contact.

    Returns
    -------
    float
        The static limit [-]; 0 where contact is lost in part of the period, mu_0 where the critical velocity is zero.
        Of a contact that is shaken in the plane the limit of a pull forward, v_0 -> +0, which may be negative.

    Raises
    ------
    TypeError
        For what is no SlidingContact.
    ValueError
        For a contact that is shaken in the plane on a material with arms, or under a spring pull that does not hold it
        or is not soft beside the contact, where no closed form is known: ask `cof_curve`, or `blocked_cof`. Where
        friction falls, for any other contact than an elastic one under a rigid pull that nothing shakes.

    Notes
    -----
    Eq. (7) for any shape. On an elastic or Kelvin material every spring presses least, or not at all, at the same
    instant, at which u_z + tau u_z' is least: u_z0 - du_z sqrt(1 + T²) of a harmonic depth, T = omega tau. Springs
    shallower than this are lost there. The others press as elastic springs at that depth would. So min F_N is the
    elastic force there. For materials with arms the least force is computed.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.4, oscillation=vibration)
    >>> print(f"{mdr.static_cof(case):.3f}")
    0.322
    """
    case = resolved(case)
    if case in domain_of(static_across):
        return static_across(case)
    if case.is_shaken:
        end = held_forward(case)
        if end is not None and end.error <= CLOSE * case.mu_0:
            return end.cof
        CLOSED_FORM.seen(case, "static_cof of a contact that is shaken in the plane")
        return case.mu_0 * float(average_friction(ShakenPull.of(case), [0.0])[0][0])
    if _slips_at_any_pull(case):
        return full_cof(case)
    kept = case.cycle.u_z0 + case.cycle.unit * case.kept_gap  # depth at which no spring presses that ever leaves
    if case.material.contact_arms and not followed(case).F_N.all():  # at some instant nothing presses
        least = 0.0
    elif case.material.contact_arms:
        least = max(least_of(normal_force(case, 2 * np.pi * np.arange(N_STEPS) / N_STEPS)), 0.0)
    else:
        least = float(case.indenter.force(kept, case.material.E_star))
    a = float(case.indenter.contact_radius(kept)) if case.friction.needs_area and case.keeps_contact else 0.0
    return float(case.friction.full(least, a)) * (1 + case.friction.stick) / 2 / mean_normal_force(case)


def _slips_at_any_pull(case: SlidingContact) -> bool:
    """Whether the body follows mu_0 kappa u_z by itself, so that the critical velocity is zero: an undamped zero, such
    as m omega² = k_x + k_xc of a flat punch.
    """
    pull = case.pull
    if pull.is_rigid or pull.coefficients[1] > 0 or case.rheology.remembers or not case.keeps_contact:
        return False
    u_n = 0.5 * case.cycle.unit * case.cycle.harmonics
    n = np.arange(1, u_n.size + 1)
    F_n, H = normal_force_harmonics(case)[1 : u_n.size + 1], np.asarray(pull.receptance(n * case.omega))
    if not np.isfinite(H).all():
        return False
    left = np.abs(n * (case.material.mindlin_ratio * u_n + H * F_n))
    return bool(left.sum() <= SAME * case.material.mindlin_ratio * case.cycle.unit)


def normal_force_harmonics(case: SlidingContact, n_t: int = N_STEPS) -> NDArray[np.complex128]:
    """F_n [N] for n = 0 ... n_t/2 of F_N(t) = sum over all n of F_n exp(i n omega t), in full slip."""
    case = resolved(case)
    if (known := known_harmonics(case)) is not None:
        F_n = np.append(known[0], 0.5 * known[1])[: n_t // 2 + 1]
        return np.pad(F_n, (0, n_t // 2 + 1 - F_n.size))
    return np.asarray(np.fft.rfft(normal_force(case, 2 * np.pi * np.arange(n_t) / n_t)) / n_t)
