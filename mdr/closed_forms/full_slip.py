"""The full-slip periodic solution: any shape, any amplitude, any material, any periodic depth.

While every spring slides forward, e_i = mu_0 kappa s_i for all of them, through loss and return of contact too,
because the same operator acts on both sides of Coulomb's law. The tangential force is then mu_0 F_N(t), whatever the
velocity, and every spring in contact slips at the same velocity u_x' - mu_0 kappa u_z'. They all reach the stick
limit together: this is why one closed form can hold for an array.

Force. On an elastic or Kelvin material contact_edge.py knows the gap g_c of the spring at the edge of the contact at
any instant, under any periodic depth. The force follows from the elastic law alone,

    F_N = E* [2 a(g_c) (u_z - g_c + tau u_z') + F(g_c)/E*].

What arms add to it is followed spring by spring: the difference between the material and the same one without its arms
(followed_force.py). Under an oscillating load the force is known beforehand, F_N = F_z(t) - m_z u_z''.

Body and critical velocity. With harmonics F_n of F_N and the receptance H, y = -mu_0 sum F_n H(n omega) exp(i n omega
t), and

    v_c = max over instants with contact of [mu_0 kappa u_z' - y'].

One harmonic gives Eq. (15); a rigid pull, H = 0, gives Eq. (1) when contact is kept.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.case.depth_cycle import harmonic_sum
from mdr.case.motion import LoadOscillation
from mdr.closed_forms.across import is_across_alone, static_across
from mdr.closed_forms.shaken_pull import ShakenPull, average_friction, has_closed_form
from mdr.indenters.mapping.quadrature import double_exponential
from mdr.materials.operator import Rheology
from mdr.normal.contact_edge import ContactEdge
from mdr.normal.followed_force import N_STEPS, NormalCycle, normal_cycle
from mdr.normal.resolved import resolved
from mdr.tools.arrays import SAME, Array
from mdr.tools.checks import count
from mdr.tools.memoise import remembered
from mdr.tools.records import ArrayRecord

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline


@dataclass(frozen=True, eq=False, repr=False)
class FullSlip(ArrayRecord):
    """One period of full slip at equidistant instants; arrays of shape (n_t,)."""

    t: Array  #: time [s]
    F_N: Array  #: normal force [N]
    contact_radius: Array  #: edge of the contact a(g_c) [m]
    u_z_dot: Array  #: rate of the depth [m/s]
    in_contact: NDArray[np.bool_]  #: whether any spring touches


def full_slip(case: SlidingContact, n_t: int = N_STEPS) -> FullSlip:
    """The normal force and the contact of a case over one period, at n_t instants."""
    case = resolved(case)
    cycle = case.cycle
    n_t = count("n_t", n_t, 16)
    phase = 2 * np.pi * np.arange(n_t) / n_t
    u_z_dot = cycle.omega * cycle.unit * cycle.over_a_period(n_t)[1][:-1]
    if case.material.contact_arms:
        known = followed(case, n_t)
        radius, in_contact = known.contact_radius, known.in_contact
    else:
        g_c = np.maximum(cycle.u_z0 + cycle.unit * edge_of(case).gap(phase), 0)
        radius, in_contact = np.asarray(case.indenter.contact_radius(g_c)), g_c > 0
    return FullSlip(phase / cycle.omega, normal_force(case, phase), radius, u_z_dot, in_contact)


@remembered(maxsize=8)
def followed(case: SlidingContact, n_t: int = N_STEPS) -> NormalCycle:
    """The normal contact of a case spring by spring, at n_t instants."""
    known = normal_cycle(case.indenter, case.rheology, case.cycle, n_t, beside=Rheology(case.T))
    if not known.in_contact.any() or not known.F_N.any():
        raise ValueError(
            f"u_z0 = {case.cycle.u_z0:.6g} m: the contact lasts less than 1/{n_t} of a period, as its springs are "
            "touched so late, or released so soon, by their dashpots; press deeper, or lower tau"
        )
    return known


@remembered(maxsize=8)
def _added_by_arms(case: SlidingContact) -> Array:
    """What the arms of a material add to F_N [N], at N_STEPS instants."""
    bare = normal_cycle(case.indenter, Rheology(case.T), case.cycle, beside=case.rheology)
    return case.material.E_star * (followed(case).F_N - bare.F_N)


def edge_of(case: SlidingContact) -> ContactEdge:
    """The edge of the contact without what arms change of it."""
    return ContactEdge.of(case.cycle, case.T)


def normal_force(case: SlidingContact, phase: Array) -> Array:
    """F_N [N] in full slip at phases omega t of any shape, of a case of known depth."""
    if case.oscillation.load is not None:
        mean, F_n = load_harmonics(case)
        return mean + harmonic_sum(F_n, phase)
    F_N = _without_arms(case, phase)[0]
    return np.maximum(F_N + _of_arms(case)(phase) if case.material.contact_arms else F_N, 0)


def normal_force_rate(case: SlidingContact, phase: Array, slope: Callable[[Array], Array]) -> Array:
    """dF_N/dphase [N], with 2 E* a(g_c) [d(u_z + tau u_z') + (u_z - g_c + tau u_z') d ln a(g_c)]: only the contact
    radius has no derivative in closed form, which `slope` answers from its values at the phases.
    """
    n, cycle = np.arange(1, case.cycle.cos.size + 1), case.cycle
    if case.oscillation.load is not None:
        F_n = load_harmonics(case)[1]
        return harmonic_sum(1j * np.arange(1, F_n.size + 1) * F_n, phase)
    _, k_zc, above = _without_arms(case, phase)
    rate = k_zc * cycle.unit * harmonic_sum(1j * n * (1 + 1j * n * case.T) * cycle.harmonics, phase) + above * slope(
        k_zc
    )
    return np.asarray(rate + _of_arms(case)(phase, 1) if case.material.contact_arms else rate)


def _without_arms(case: SlidingContact, phase: Array) -> tuple[Array, Array, Array]:
    """F_N [N], 2 E* a(g_c) [N/m] and u_z - g_c + tau u_z' [m] of the material without its arms."""
    cycle, E_star = case.cycle, case.material.E_star
    edge = edge_of(case).gap(phase)
    g_c = cycle.u_z0 + cycle.unit * edge
    above = cycle.unit * (cycle.z(phase) - edge + case.T * cycle.rate(phase))
    k_zc = np.asarray(case.indenter.stiffness(g_c, E_star))
    return np.asarray(case.indenter.force(g_c, E_star)) + k_zc * above, k_zc, above


def _of_arms(case: SlidingContact) -> CubicSpline:
    """What the arms of a material add to F_N [N], over the phase."""
    from scipy.interpolate import CubicSpline

    added = _added_by_arms(case)
    return CubicSpline(2 * np.pi * np.arange(added.size + 1) / added.size, [*added, added[0]], bc_type="periodic")


def load_harmonics(case: SlidingContact) -> tuple[float, NDArray[np.complex128]]:
    """Mean [N] and harmonics F_n [N], n = 1 ... N, of F_N = F_z(t) - m_z u_z'' under a load."""
    load, cycle = case.oscillation.load, case.cycle
    if not isinstance(load, LoadOscillation):
        return getattr(load, "F_z0", 0.0), np.zeros(0, dtype=complex)
    n = np.arange(1, cycle.cos.size + 1)
    F_n = load.m_z * case.omega**2 * cycle.unit * n**2 * cycle.harmonics
    F_n[case.repeats[0] - 1] += load.dF_z
    return load.F_z0, F_n


def edge_marks(case: SlidingContact, joints: bool = False) -> tuple[float, ...]:
    """Gaps at which the edge of the contact crosses the tip, a kink or the rim, where a(d) is not smooth; with joints
    also those at which pieces of a curve meet, where it is as smooth as a spline.
    """
    shape, cycle = case.indenter, case.cycle
    radii = [*(shape.joints if joints else shape.kinks), *([shape.max_radius] if np.isfinite(shape.max_radius) else [])]
    depths = {0.0, *(shape.profile_1d(np.array(radii)).tolist() if radii else ())}
    gaps, kept = {(depth - cycle.u_z0) / cycle.unit for depth in depths}, cycle.kept_gap(Rheology(case.T).response)
    return tuple(sorted(gap for gap in gaps if kept < gap < cycle.greatest))


def corners(case: SlidingContact, joints: bool = False) -> Array:
    """Phases at which F_N without arms is not smooth, ascending: the edge turns, or crosses one of the marks."""
    edge = edge_of(case)
    crossed = [phase for gap in edge_marks(case, joints) for some in edge.crossings(gap) for phase in some]
    return np.unique(np.mod([*edge.begins, *crossed], 2 * np.pi))


def mean_normal_force(case: SlidingContact) -> float:
    """Mean of F_N over the period [N], by the double-exponential rule between the instants at which it is not smooth.

    While springs slide, stick or fly their mean force is that of their mean compression: it is the same in any run.
    """
    case = resolved(case)
    if case.oscillation.load is not None:
        return load_harmonics(case)[0]
    instants = corners(case, joints=True)
    instants = np.append(instants, instants[0] + 2 * np.pi)
    mean = double_exponential().integral(lambda phase: _without_arms(case, phase)[0], instants) / (2 * np.pi)
    return mean + float(_added_by_arms(case).mean()) if case.material.contact_arms else mean


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
    if case.moves_across and is_across_alone(case):
        return static_across(case)
    if case.is_shaken:
        if not has_closed_form(case):
            raise ValueError(
                "the static limit of a contact that is shaken in the plane is known in closed form under a rigid pull, "
                "along the pull on an elastic or Kelvin material, across it at a constant depth: ask "
                "holding_band(case), or cof_curve(case, [0])"
            )
        return case.mu_0 * float(average_friction(ShakenPull.of(case), [0.0])[0][0])
    if _slips_at_any_pull(case):
        return case.mu_0
    if case.material.contact_arms and not followed(case).F_N.all():  # at some instant nothing presses
        least = 0.0
    elif case.material.contact_arms:
        least = max(_least(normal_force(case, 2 * np.pi * np.arange(N_STEPS) / N_STEPS)), 0.0)
    else:
        least = float(case.indenter.force(case.cycle.u_z0 + case.cycle.unit * case.kept_gap, case.material.E_star))
    return case.mu_0 * least / mean_normal_force(case)


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


def _least(values: Array) -> float:
    """Minimum over a period of equidistant values, by the parabola through the least one and its neighbours."""
    k = int(np.argmin(values))
    before, least, after = values[k - 1], values[k], values[(k + 1) % values.size]
    bend = before - 2 * least + after
    return float(least - (after - before) ** 2 / (8 * bend) if bend > 0 else least)


def normal_force_harmonics(case: SlidingContact, n_t: int = N_STEPS) -> NDArray[np.complex128]:
    """F_n [N] for n = 0 ... n_t/2 of F_N(t) = sum over all n of F_n exp(i n omega t), in full slip."""
    return np.asarray(np.fft.rfft(full_slip(case, n_t).F_N) / n_t)
