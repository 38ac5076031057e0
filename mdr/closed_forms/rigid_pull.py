"""The periodic state under a rigid pull in closed form: any shape, any amplitude, elastic or Kelvin, no march.

Scaled form (phase = omega t, v = v_0/(mu_0 kappa omega du_z), T = omega tau, gap c = (g - u_z0)/du_z). A spring has the
normal motion s (normal/kelvin_edges.py) and the extension e; its lag behind full slip p = s - e obeys

    p' = max(s' - v, -p/T) in contact,   p' = -p/T in flight,   0 <= p <= s,

and the COF is mu_0 (1 - sum of the mean lags / sum of the mean s). In contact s' = -sin(phase) is the same for all
springs, so they differ only in the phase theta at which they touch. Three facts make the mean a single integral.

1. A spring sticks at most once in a period. D = s' - v + p/T is positive in stick. The core, all springs that press as
   their D rises through zero, starts to stick there, at a phase that is called theta again. Springs that touch
   later stick at once, from theta to b = theta + sigma, if D(theta) > 0, and never otherwise.
2. The periodic stick is known. Q = exp(-(2 pi - sigma)/T) is the share of a lag that is left from b to the next stick:

       p(b) (1 - Q) = cos b - cos theta - v sigma,   p(b) = T (v + sin b)  [D(b) = 0],

   which for a given sigma is linear in sin b and cos b: b(sigma) and theta(sigma) are explicit. The lengths run from
   sigma = 0, where sin b = -v, to that of the core, the longest, where D(theta) = 0.
3. Neighbouring springs differ only at their touch. A spring that touches d theta earlier has the lag D d theta more at
   once. This difference is constant through its stick and decays through its slip. The mean of its lag is larger by
   D [T + sigma/(1 - Q)] d theta/(2 pi).

Summed by parts over the array, with k_zc the stiffness 2 E* a of the contact at the instant theta,

    1 - mu/mu_0 = du_z/(2 pi <F_N>) integral of k_zc(theta) D(theta) [T + sigma/(1 - Q)] d theta,       (*)

d theta = (D/G - 1) d sigma with G = T (1 - Q) cos b + sin b - sin theta. T = 0 is the limit Q = 0: D = -sin theta - v,
and mu/mu_0 = 1 - du_z/(2 pi <F_N>) integral of k_zc(theta) sigma(theta) (-sin theta - v) d theta.

What follows from (*):

* near v = 1, if the centre presses at phase 3 pi/2, the instant of fastest approach: 1 - mu/mu_0 ->
  9/(4 pi) k_zc du_z/<F_N> (1 - v)² for an elastic contact, and 2 sqrt(2) T/(3 pi) k_zc du_z/<F_N> (1 - v)^(3/2) for a
  Kelvin one, whose lag outlives the stick by the time T; k_zc is that of the springs in contact at this instant;
* near v = 0: mu/mu_0 -> min F_N/<F_N> + c v^q. Elastic q = 1 with
  c = (2/pi) du_z/<F_N> integral from 0 to pi of phi k_zc(u_z0 + du_z cos phi) d phi. Kelvin with a kept core q = 2/3
  with c = ½ R^(1/3) (3 pi T)^(2/3) k_zc(u_z0 - R du_z) du_z/<F_N>, R = sqrt(1 + T²): at its least force
  the core slips for a time ~ v^(1/3), during which it gives back what it was pulled in the rest of the period.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.case.contact import SlidingContact
from mdr.case.domain import COULOMB, HARMONIC, NO_ARMS, RIGID, UNSHAKEN, holds_for
from mdr.indenters.mapping.quadrature import Rule, double_exponential
from mdr.normal.kelvin_edges import contact_edge, edge_rate, kept_gap, touching_phase
from mdr.normal.normal_force import edge_marks, mean_normal_force
from mdr.tools.arrays import Array
from mdr.tools.checks import finite_array
from mdr.tools.records import ArrayRecord

LEAST_PULL = 1e-15  #: velocity, over mu_0 kappa omega du_z, below which a period less its stick is lost in rounding
of_a_rigid_pull = holds_for(COULOMB, RIGID, HARMONIC, NO_ARMS, UNSHAKEN, instead="slide or cof_curve")
AT_ONCE = 128  #: numbers that an array operation takes hardly longer for than for one


@dataclass(frozen=True, eq=False, repr=False)
class RigidPullFriction(ArrayRecord):
    """Average friction under a rigid pull; arrays in the shape of v_0."""

    cof: Array  #: average coefficient of friction [-]
    cof_error: Array  #: bound on its error, of quadrature and rounding [-]
    stick_share: Array  #: force-weighted share of contact time spent sticking [-]


@dataclass(frozen=True)
class Asymptote:
    """A leading term coefficient * x**power."""

    power: float  #: [-]
    coefficient: float  #: [-]


@dataclass(frozen=True, eq=False)
class _Stick:
    """One stick phase, as a function of its length; arrays of one shape."""

    sigma: Array  # its length
    begin: Array  # phase of its start
    end: Array
    D: Array  # excess of s' over what slip allows, at its start
    kept: Array  # Q: the share of a lag that outlives the slip
    slope: Array  # d end/d sigma


@of_a_rigid_pull
def average_friction(case: SlidingContact, v_0: ArrayLike) -> RigidPullFriction:
    """Average COF under a rigid pull at velocities v_0 > 0 [m/s], any shape; (*) above.

    Raises ValueError for velocities that are not positive and finite, or below 1e-15 of mu_0 kappa omega du_z, and
    OutsideDomain for another pull, depth, material or law of friction, and for a shake.

    Examples
    --------
    >>> import mdr
    >>> from mdr.closed_forms.rigid_pull import average_friction
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=4e-6, omega=300.0)
    >>> case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5), 0.4, vibration)
    >>> print(average_friction(case, [0.3e-3, 0.6e-3]).cof.round(4))
    [0.3672 0.3976]
    """
    v_0 = finite_array("v_0", v_0, "m/s")
    if np.any(v_0 <= 0):
        raise ValueError(f"v_0 must be positive, got {float(v_0.min())!r} m/s; its limit 0 is static_cof(case)")
    if np.any(v_0 < LEAST_PULL * case.unit_velocity):
        least = f"{LEAST_PULL:g} of mu_0 kappa omega du_z = {case.unit_velocity:.4g} m/s"
        raise ValueError(f"v_0 = {float(v_0.min()):g} m/s is below {least}, and lost in rounding: ask static_cof(case)")
    v = v_0.ravel() / case.unit_velocity
    fine, coarse, sticks = _integrals(case, v, double_exponential())
    # half the step squares the error of the rule: the power 2, of which 1.5 is on the safe side; 1e-13 is rounding
    error = np.abs(fine - coarse) ** 1.5 + 1e-13 + np.where(v < 1, case.cycle.lost_in_digits, 0.0)
    shape = v_0.shape
    return RigidPullFriction(
        cof=case.mu_0 * (1 - fine).reshape(shape),
        cof_error=case.mu_0 * error.reshape(shape),
        stick_share=np.clip(sticks, 0, 1).reshape(shape),  # outside by rounding alone, in contact of an instant
    )


@of_a_rigid_pull
def near_critical(case: SlidingContact) -> Asymptote:
    """Leading term of 1 - cof/mu_0 in 1 - v_0/v_c, if the centre presses at phase 3 pi/2; else ValueError.

    Examples
    --------
    >>> import mdr
    >>> from mdr.closed_forms.rigid_pull import near_critical
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=4e-6, omega=300.0)
    >>> case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5), 0.4, vibration)
    >>> law = near_critical(case)
    >>> print(f"{law.coefficient:.3g} times the power {law.power:.3g}")
    0.213 times the power 2
    """
    k_zc, F_N = _stiffness(case, contact_edge(np.array(1.5 * np.pi), case.T)), mean_normal_force(case)
    share = float(k_zc) * case.cycle.unit / F_N
    if share == 0:
        raise ValueError(
            "the contact is open at the instant of fastest approach: v_c is less than mu_0 kappa omega du_z, Eq. (1)"
        )
    if case.T == 0:
        return Asymptote(2.0, 9 / (4 * np.pi) * share)
    return Asymptote(1.5, 2 * np.sqrt(2) * case.T / (3 * np.pi) * share)


@of_a_rigid_pull
def small_velocity(case: SlidingContact) -> Asymptote:
    """Leading term of (cof - static cof)/mu_0 in v_0/(mu_0 kappa omega du_z); ValueError for a Kelvin
    contact that is lost entirely, whose term is not known.

    Examples
    --------
    >>> import mdr
    >>> from mdr.closed_forms.rigid_pull import small_velocity
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=4e-6, omega=300.0)
    >>> case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5), 0.4, vibration)
    >>> law = small_velocity(case)
    >>> print(f"{law.coefficient:.3g} times the power {law.power:.3g}")
    0.895 times the power 1
    """
    cycle, T, F_N = case.cycle, case.T, mean_normal_force(case)
    R = -kept_gap(T)
    core = float(_stiffness(case, np.array(-R))) * cycle.unit / F_N
    if T > 0 and core > 0:
        return Asymptote(2 / 3, 0.5 * np.cbrt(R) * (3 * np.pi * T) ** (2 / 3) * core)
    if T > 0:
        raise ValueError("the leading term of a Kelvin contact that is lost entirely is not known in closed form")
    marks = np.array([0.0, *np.arccos(edge_marks(case, joints=True))[::-1], np.pi])
    total = double_exponential().integral(lambda phi: phi * _stiffness(case, np.cos(phi)), marks)
    return Asymptote(1.0, 2 / np.pi * cycle.unit / F_N * total)


def _stiffness(case: SlidingContact, gap: Array) -> Array:
    """k_zc [N/m] of a contact whose edge stands at this gap."""
    depth = case.cycle.u_z0 + case.cycle.unit * gap
    return np.asarray(case.indenter.stiffness(depth, case.material.E_star))


def _integrals(case: SlidingContact, v: Array, rule: Rule) -> Array:
    """1 - mu/mu_0 by the rule between the marks and by the coarser one, and the share of stick, shape (3, n_v); for
    v >= 1 nothing sticks.
    """
    out, slow = np.zeros((3, v.size)), v < 1
    if not slow.any():
        return out
    v, T, cycle = v[slow], case.T, case.cycle
    longest = _longest_stick(v, T)
    # the greater the gap, the later the touch and the shorter the stick
    marks = sorted(edge_marks(case, joints=True), reverse=True)
    ends = [0 * v, *(_stick_of_touch(touching_phase(gap, T), v, T, longest) for gap in marks), longest]
    fine, coarse, sticks = np.zeros((3, v.size))
    for low, high in pairwise(ends):
        stick = _stick(rule.between(low, high), v[:, None], T)
        gap = contact_edge(stick.begin, T)
        weight = (high - low)[:, None] * _stiffness(case, gap)
        lag = weight * stick.D * (T + stick.sigma / (1 - stick.kept)) * (1 - stick.slope)
        fine, coarse = fine + lag @ rule.weight, coarse + lag[:, ::2] @ rule.coarser.weight
        sticks += weight * _impulse_rate(stick, gap, T) @ rule.weight
    depth = cycle.u_z0 + cycle.unit * contact_edge(_stick(longest, v, T).begin, T)
    sticks += longest * np.asarray(case.indenter.force(depth, case.material.E_star)) / cycle.unit
    out[:, slow] = np.array([fine, coarse, sticks]) * cycle.unit / (2 * np.pi * mean_normal_force(case))
    return out


def _stick(sigma: Array, v: Array, T: float) -> _Stick:
    """The periodic stick phase of this length. D is negative, or NaN, if no spring sticks so long."""
    rest = 2 * np.pi - sigma
    kept = np.exp(-rest / T) if T else np.zeros_like(sigma)
    lost = -T * np.expm1(-rest / T) if T else np.zeros_like(sigma)  # T (1 - E)
    across, along = lost + np.sin(sigma), 2 * np.sin(sigma / 2) ** 2
    reach = np.hypot(across, along)
    with np.errstate(invalid="ignore", divide="ignore"):
        end = 2 * np.pi + np.arctan2(along, across) - np.arcsin(np.where(reach > 0, v * (sigma + lost) / reach, v))
        begin = end - sigma
        D = (v + np.sin(end)) * kept - np.sin(begin) - v
        G = lost * np.cos(end) + np.sin(end) - np.sin(begin)
        slope = np.where(G > 0, D / G, 0.0)
    return _Stick(sigma, begin, end, D, kept, slope)


def _longest_stick(v: Array, T: float) -> Array:
    """Length of the stick of the core, which begins where D rises through zero; shape (n_v,)."""
    return _last(lambda sigma: _stick(sigma, v, T).D > 0, np.full_like(v, 2 * np.pi))


def _stick_of_touch(begin: float, v: Array, T: float, longest: Array) -> Array:
    """Length of the stick of a spring that touches at `begin`; 0 or the longest if it does not stick at once."""
    return _last(lambda sigma: _stick(sigma, v, T).begin > begin, longest)


def _last(holds: Callable[[Array], NDArray[np.bool_]], high: Array) -> Array:
    """How far from 0 to `high` (n,) a condition holds, to rounding: the interval that has the end in it is cut in
    sections again and again, in as many as one array operation tries at little cost.
    """
    sections = int(np.clip(AT_ONCE // high.size, 2, 64))
    low, section, inner = np.zeros_like(high), high / sections, np.arange(1.0, sections)
    for _ in range(int(np.ceil(54 / np.log2(sections)))):
        within = holds(low + np.multiply.outer(inner, section))
        low, section = low + np.logical_and.accumulate(within).sum(axis=0) * section, section / sections
    return low


def _impulse_rate(stick: _Stick, gap: Array, T: float) -> Array:
    """d J/d sigma, J the normal impulse of a spring during its stick, in units of stiffness times du_z/omega."""
    at_begin, at_end = (np.cos(t) - T * np.sin(t) - gap for t in (stick.begin, stick.end))
    begin_rate = stick.slope - 1
    return np.asarray(at_end * stick.slope - (at_begin + stick.sigma * edge_rate(stick.begin, gap, T)) * begin_rate)
