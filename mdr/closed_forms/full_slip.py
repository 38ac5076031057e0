"""The full-slip periodic solution: any shape, any amplitude, any material, any periodic depth.

While every spring slides forward, e_i = mu_0 kappa s_i for all of them, through loss and return of contact too,
because the same operator acts on both sides of Coulomb's law. The tangential force is then mu_0 F_N(t), whatever the
velocity, and every spring in contact slips at the same velocity u_x' - mu_0 kappa u_z'. They all reach the stick
limit together: this is why one closed form can hold for an array.

Contact edge. A spring of depth g has s(t) = sup over theta >= 0 of (u_z - g)(t - theta) exp(-theta/tau) and is in
contact when the supremum is attained at theta = 0, i.e. for all g below

    g_c(t) = inf over theta of [u_z(t) - u_z(t - theta) exp(-theta/tau)] / [1 - exp(-theta/tau)],

whose limits are u_z + tau u_z' (theta -> 0, the retreating edge, released while still compressed) and u_z (full
relaxation). The force follows from the elastic law alone, F_N = E* [2 a(g_c) (u_z - g_c + tau u_z') + F(g_c)/E*].

That is for a harmonic depth on an elastic or Kelvin material, the case of the paper. Materials with arms and other
motions have no such closed form: followed_force.py follows their springs, to 1e-6 or better of mean F_N. Under an
oscillating load the force is known beforehand, F_N = F_z(t) - m_z u_z''.

Body and critical velocity. With harmonics F_n of F_N and the receptance H, y = -mu_0 sum F_n H(n omega) exp(i n omega
t), and

    v_c = max over instants with contact of [mu_0 kappa u_z' - y'].

One harmonic gives Eq. (15); a rigid pull, H = 0, gives Eq. (1) when contact is kept.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.case.motion import LoadOscillation
from mdr.closed_forms.shaken_pull import ShakenPull, band, has_shaken_form
from mdr.indenters.mapping.quadrature import double_exponential
from mdr.normal.followed_force import N_STEPS, NormalCycle, normal_cycle, of_harmonics
from mdr.normal.kelvin_edges import contact_edge, kept_gap, leaving_phase, touching_phase, turning_phase
from mdr.normal.resolved import resolved
from mdr.tools.arrays import Array
from mdr.tools.checks import count
from mdr.tools.memoise import remembered
from mdr.tools.records import ArrayRecord

N_INSTANTS = 8192  #: of the period; harmonics up to half of it
NONE = 1e-9  #: of Eq. (1): a critical velocity that no pull is slower than


@dataclass(frozen=True, eq=False, repr=False)
class FullSlip(ArrayRecord):
    """One period of full slip at equidistant instants; arrays of shape (n_t,)."""

    t: Array  #: time [s]
    F_N: Array  #: normal force [N]
    contact_radius: Array  #: edge of the contact a(g_c) [m]
    u_z_dot: Array  #: rate of the depth [m/s]
    in_contact: NDArray[np.bool_]  #: whether any spring touches


def full_slip(case: SlidingContact, n_t: int = N_INSTANTS) -> FullSlip:
    """The normal force and the contact of a case over one period, at n_t instants."""
    case = resolved(case)
    cycle = case.cycle
    n_t = count("n_t", n_t, 16)
    phase = 2 * np.pi * np.arange(n_t) / n_t
    u_z_dot = cycle.omega * cycle.unit * cycle.over_a_period(n_t)[1][:-1]
    if not case.is_of_the_paper:
        known = followed(case, n_t)
        return FullSlip(phase / cycle.omega, force_of(case, known), known.contact_radius, u_z_dot, known.in_contact)
    edge = contact_edge(phase, case.T)
    g_c = np.maximum(cycle.u_z0 + cycle.unit * edge, 0)
    F_N = _force(case, phase, edge)
    return FullSlip(phase / cycle.omega, F_N, np.asarray(case.indenter.contact_radius(g_c)), u_z_dot, g_c > 0)


@remembered(maxsize=8)
def followed(case: SlidingContact, n_t: int) -> NormalCycle:
    """The normal contact of a case that has no closed form, at n_t instants."""
    known = normal_cycle(case.indenter, case.rheology, case.cycle, n_t)
    if not known.in_contact.any() or not known.F_N.any():
        raise ValueError(
            f"u_z0 = {case.cycle.u_z0:.6g} m: the contact lasts less than 1/{n_t} of a period, as its springs are "
            "touched so late, or released so soon, by their dashpots; press deeper, or lower tau"
        )
    return known


def force_of(case: SlidingContact, known: NormalCycle) -> Array:
    """F_N [N] at its instants."""
    load, n_t = case.oscillation.load, known.F_N.size
    if load is None:
        return case.material.E_star * known.F_N
    if not isinstance(load, LoadOscillation):
        return np.full(n_t, load.F_z0)
    F_z = load.F_z0 + load.dF_z * np.cos(2 * np.pi * case.repeats[0] * np.arange(n_t) / n_t)
    if not load.m_z:
        return F_z
    cycle = case.cycle
    n = np.arange(1.0, cycle.cos.size + 1)
    return F_z + load.m_z * case.omega**2 * cycle.unit * of_harmonics(n**2 * cycle.harmonics, n_t)


def normal_force(case: SlidingContact, phase: Array) -> Array:
    """F_N [N] in full slip at phases omega t in [0, 2 pi], of a case of the paper."""
    return _force(case, phase, contact_edge(phase, case.T))


def _force(case: SlidingContact, phase: Array, edge: Array) -> Array:
    cycle, E_star = case.cycle, case.material.E_star
    g_c = cycle.u_z0 + cycle.unit * edge
    above = cycle.unit * (np.cos(phase) - edge - case.T * np.sin(phase))  # u_z - g_c + tau u_z'
    elastic = np.asarray(case.indenter.force(g_c, E_star))
    return np.maximum(elastic + np.asarray(case.indenter.stiffness(g_c, E_star)) * above, 0)


def edge_marks(case: SlidingContact, joints: bool = False) -> tuple[float, ...]:
    """Gaps at which the edge of the contact crosses the tip, a kink or the rim, where a(d) is not smooth; with joints
    also those at which pieces of a curve meet, where it is as smooth as a spline.
    """
    shape, cycle = case.indenter, case.cycle
    radii = [*(shape.joints if joints else shape.kinks), *([shape.max_radius] if np.isfinite(shape.max_radius) else [])]
    depths = {0.0, *(shape.profile_1d(np.array(radii)).tolist() if radii else ())}
    gaps, kept = {(depth - cycle.u_z0) / cycle.unit for depth in depths}, kept_gap(case.T)
    return tuple(sorted(gap for gap in gaps if kept < gap < 1))


def mean_normal_force(case: SlidingContact) -> float:
    """Mean of F_N over the period [N], by the double-exponential rule between the instants at which it is not smooth.

    While springs slide, stick or fly their mean force is that of their mean compression: it is the same in any run.
    """
    case = resolved(case)
    if not case.is_of_the_paper:
        return float(force_of(case, followed(case, N_STEPS)).mean())
    T, rule = case.T, double_exponential()
    turn, marks = turning_phase(T), edge_marks(case, joints=True)
    ends = [0.0, *(float(leaving_phase(gap, T)) for gap in marks), turn, *(touching_phase(gap, T) for gap in marks)]
    instants = np.sort([*ends, 2 * np.pi])
    phase = rule.between(instants[:-1], instants[1:])
    force = normal_force(case, phase.ravel()).reshape(phase.shape)
    return float(np.diff(instants) @ (force @ rule.weight)) / (2 * np.pi)


def static_cof(case: SlidingContact) -> float:
    """Coefficient of friction [-] in the limit v_0 -> 0: mu_0 min F_N/mean F_N over the period.

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
        For a contact that is shaken in the plane under a spring pull or on a material with arms, where no closed form
        is known: `holding_band` and `cof_curve` march it.

    Notes
    -----
    Eq. (7) for any shape. On an elastic or Kelvin material under a harmonic depth every spring presses least, or not at
    all, at the same phase pi - arctan T, T = omega tau. Springs shallower than u_z0 - du_z sqrt(1 + T²) are lost there.
    The others press as elastic springs at that depth would. So min F_N is the elastic force there. For materials with
    arms and for other motions the least force is computed.

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
    if case.is_shaken:
        if not has_shaken_form(case):
            raise ValueError(
                "the static limit of a contact that is shaken in the plane is known in closed form under a rigid pull "
                "on an elastic or Kelvin material: ask holding_band(case), or cof_curve(case, [0])"
            )
        return case.mu_0 * band(ShakenPull.of(case))[1]
    if _slips_at_any_pull(case):
        return case.mu_0
    if not case.is_of_the_paper:
        F_N = force_of(case, followed(case, N_STEPS))
        return case.mu_0 * max(_least(F_N), 0.0) / float(F_N.mean())
    cycle = case.cycle
    least = case.indenter.force(cycle.u_z0 + cycle.unit * kept_gap(case.T), case.material.E_star)
    return case.mu_0 * float(least) / mean_normal_force(case)


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
    return bool(left.sum() <= NONE * case.material.mindlin_ratio * case.cycle.unit)


def _least(values: Array) -> float:
    """Minimum over a period of equidistant values, by the parabola through the least one and its neighbours."""
    k = int(np.argmin(values))
    before, least, after = values[k - 1], values[k], values[(k + 1) % values.size]
    bend = before - 2 * least + after
    return float(least - (after - before) ** 2 / (8 * bend) if bend > 0 else least)


def normal_force_harmonics(case: SlidingContact, n_t: int = N_INSTANTS) -> NDArray[np.complex128]:
    """F_n [N] for n = 0 ... n_t/2 of F_N(t) = sum over all n of F_n exp(i n omega t), in full slip."""
    return np.asarray(np.fft.rfft(full_slip(case, n_t).F_N) / n_t)
