"""The body in full slip: its periodic motion under mu_0 F_N(t), and the velocity above which no spring ever sticks.

In full slip every spring in contact slips at u_x' - mu_0 kappa u_z', so with the motion y of the body relative to the
pull, m y'' + c_x y' + k_x y = -mu_0 F_N(t),

    v_c = max over instants with contact of [mu_0 kappa u_z' - y'].

With harmonics F_n of F_N and the receptance H this is y = -mu_0 sum F_n H(n omega) exp(i n omega t); one harmonic gives
Eq. (15), and H = 0, a rigid pull, gives Eq. (1) if the centre of the contact has touched by phase 3 pi/2.

Method. Without arms F_N is analytic between the phases at which the edge turns or crosses the tip, a kink or the rim;
there it bends like a power, or jumps (a punch on dashpots). The period is cut there, and panels shrink geometrically
towards each cut. In every panel the body is solved by Gauss-Legendre collocation, which neither damps nor excites its
free oscillation; the panels are chained to a map over the period, whose fixed point is the periodic motion. A rigid
pull needs none of this, unless friction falls: the velocity is the greatest of a harmonic sum, at its turns and at the
ends of the contact.

Where friction falls, mu_0 is mu_k, and a spring that touches anew sticks first if its force would grow to less than
mu_s f_z in stick. In full slip its end is at mu_k kappa s, in flight too. So it slips at once if

    v_0 + y' - mu_k kappa s' > mu_s kappa (u_z' - s'),

s' the rate of the free surface before the touch, 0 of an elastic material and -s/tau of a Kelvin material. The body
moves as before, as nothing sticks. Another motion may go on beside this one, in which a body sticks and slips.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.polynomial import legendre
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.case.depth_cycle import harmonic_sum, stick_limit, turns
from mdr.case.domain import NO_ARMS, NO_STRENGTH, holds_for, where_it_falls
from mdr.case.pull import Pull
from mdr.closed_forms.full_slip_face import greatest_rate
from mdr.normal.followed_force import N_STEPS
from mdr.normal.normal_force import (
    contact_radius,
    corners,
    edge_of,
    followed,
    known_harmonics,
    normal_force,
    normal_force_rate,
)
from mdr.normal.resolved import resolved
from mdr.tools.arrays import EXACT, SAME, Array

N_NODES = 20  #: Gauss points of a panel: half a wave on it is exact to rounding
BESIDE = 1e-5  #: phase around which a contact is looked at for whether it grows
SHRINK = 0.3  #: of neighbouring panels towards a cut: 20 nodes leave 3.4**-20 = 2e-11 of a power that begins there
MISSED = SHRINK**N_NODES  #: of the whole: no panel beside a cut need be smaller, and no smaller harmonic counts


@holds_for(*where_it_falls(NO_STRENGTH, NO_ARMS), instead="critical_velocity, or slide(case, v_0)")
def full_slip_critical_velocity(case: SlidingContact, direction: int = 1) -> float:
    """Velocity [m/s] above which no spring ever sticks, for any amplitude and shape.

    It is Eq. (15) with all harmonics of the normal force in the place of the first one.

    Parameters
    ----------
    case : SlidingContact
        The contact.
    direction : {1, -1}
        1 is the pull forward, -1 the pull the other way, whose velocity is given as a positive number too.

    Returns
    -------
    float
        v_c [m/s]. Negative where friction is full at any pull in this direction, and some way into the other one, as
        of a shaken contact that is lost in part of the period. Infinite on an undamped resonance, k_x = m (n omega)²
        with a harmonic F_n that is not zero. Infinite where something shakes the contact across the pull, as friction
        is full at no velocity then, and on curved elastic faces with a shear strength, where springs that the edge of
        contact reaches stick at any velocity (full_slip_face.py; a viscous half-space slips from a lower one on,
        `mdr.laws.full_slip_of_half_space`). Infinite too for a body without mass and damper whose
        contact is lost and touches again with a jump of F_N' (a Kelvin material, unless the tip is sharp): for an
        instant its velocity has no bound.
        Where friction falls, springs that touch anew stick longer, up to mu_s.

    Raises
    ------
    TypeError
        For what is no SlidingContact.
    ValueError
        For another direction, and for arms where friction falls.

    Notes
    -----
    A shake along the pull takes off its velocity x' forward, and adds it the other way: v_c is the greatest
    mu_0 kappa u_z' - y' -+ x' while any spring is in contact.

    On an elastic or Kelvin material, and under a load, one method serves every motion, so that a motion written in
    another way has the same velocity. Its error, over v_c or a tenth of the greatest mu_0 kappa u_z', is at most 1e-7
    under a rigid pull, 2e-7 for a body with mass or damper, contact kept or lost, and 1e-6 for a body with neither.
    Under a load comes the error of the depth that was found for it.

    A force that oscillates by less than 1.5e-8 of its mean follows its linear law, which misses no more than that.

    What Maxwell arms add to the force is followed spring by spring, and its error goes with their weight. Arms as stiff
    as E_inf leave 1e-6 under a rigid pull, 2e-4 with a mass and 1e-3 with a light one. A body with a damper alone has
    1e-3, and some per cent where contact is lost on dashpots, as the force jumps between two instants. For one with
    neither v_c is the greatest rate of a force that is known at instants: off by a fifth at worst.
    On a curved face with a shear strength arms leave some 1e-4, rigid pull or body.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> slider = mdr.SpringPull(k_x=2e4, m=0.05)
    >>> rubber = mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-3)
    >>> case = mdr.SlidingContact(mdr.Cone(theta=0.0127), rubber, 0.4, oscillation=vibration, pull=slider)
    >>> print(f"{mdr.full_slip_critical_velocity(case):.3g} m/s")
    0.000516 m/s
    """
    case = resolved(case).pulled(direction)
    if case.moves_across or not np.isfinite(case.way).all() or case.always_sticks:
        return np.inf
    strengthened = case.strength_moves
    rates = _slip_rates(case)
    touches, leaves = contact_ends(case)
    if case.pull.is_rigid and strengthened:
        return greatest_rate(case, lambda phase: harmonic_sum(rates, phase))
    touch_anew = case.friction.stick > 1 and case.edge_moves
    if case.pull.is_rigid and not touch_anew:
        phase = np.append(turns(rates), 0.0)  # a sum that is still has no turns
        phase = np.concatenate([phase[_in_contact(phase, touches, leaves)], touches, leaves])
        return float(harmonic_sum(rates, phase).max())
    panels = _time_panels(case, rates, np.concatenate([touches, leaves]))
    resonant = _resonant_harmonic(case.pull, case.omega)
    none = SAME * float(np.abs(panels.force).max()) + case.cycle.missing * panels.rest
    if _velocity_unbounded_at_touch(case) or (resonant and abs(panels.harmonic(panels.force, resonant)) > none):
        return np.inf
    y_dot = np.zeros(panels.phase.shape) if case.pull.is_rigid else _velocity(case, panels)
    if resonant:  # the force does not contain it, so neither does the periodic motion
        y_dot -= 2 * (panels.harmonic(y_dot, resonant) * np.exp(1j * resonant * panels.phase)).real
    if strengthened:
        from scipy.interpolate import PchipInterpolator

        y_rate = PchipInterpolator(panels.phase.ravel(), y_dot.ravel())
        begin = float(panels.low[0])
        return greatest_rate(
            case, lambda phase: harmonic_sum(rates, phase) - y_rate(begin + np.mod(phase - begin, 2 * np.pi))
        )
    needed, middle = harmonic_sum(rates, panels.phase) - y_dot, 0.5 * (panels.low + panels.high)
    v_c = _greatest(needed[_in_contact(middle, touches, leaves)])
    if not touch_anew:
        return v_c
    needed += _closing_in(case, panels.phase)
    of_flat = _at_begin(needed[_grows(case, panels.low)])  # it touches at an instant
    return max(v_c, _greatest(needed[_grows(case, middle)]), float(of_flat.max(initial=-np.inf)))


def _closing_in(case: SlidingContact, phase: Array) -> Array:
    """(mu_s - mu_k) kappa (u_z' - s') [m/s] at phases of a spring that touches there."""
    cycle, T = case.cycle, case.T
    rate = cycle.rate(phase) + ((cycle.z(phase) - edge_of(case).gap(phase)) / T if T else 0.0)
    return (
        (case.friction.stick - 1) * stick_limit(case.mu_0, cycle.unit, case.omega, case.material.mindlin_ratio) * rate
    )


def _grows(case: SlidingContact, phase: Array) -> NDArray[np.bool_]:
    """Whether the contact grows at phases (n,), just before or just after."""
    before, now, after = contact_radius(case, phase + np.array([[-BESIDE], [0.0], [BESIDE]]))
    return np.asarray((now > before) | (after > now))


def _slip_rates(case: SlidingContact) -> NDArray[np.complex128]:
    """Harmonics 1 ... N of mu_0 kappa u_z' - x' [m/s]."""
    unit = stick_limit(case.mu_0, case.cycle.unit, case.omega, case.material.mindlin_ratio)
    Z, X = unit * case.cycle.harmonics, case.omega * case.way
    size = max(Z.size, X.size)
    Z, X = (np.pad(row, (0, size - row.size)) for row in (Z, X))
    return np.asarray(1j * np.arange(1, size + 1) * (Z - X))


def contact_ends(case: SlidingContact) -> tuple[Array, Array]:
    """Phases at which the centre of the contact touches, and at which it leaves; empty where it is never lost."""
    if case.keeps_contact:
        return np.zeros(0), np.zeros(0)
    if case.material.contact_arms:
        known = followed(case)
        return known.touches, known.leaves
    touches, leaves = edge_of(case).crossings(-case.cycle.u_z0 / case.cycle.unit)
    return np.mod(touches, 2 * np.pi), np.mod(leaves, 2 * np.pi)


def _in_contact(phase: Array, touches: Array, leaves: Array) -> NDArray[np.bool_]:
    """Whether the centre touches at phases (n,)."""
    if not touches.size:
        return np.ones(phase.size, dtype=bool)
    touched, left = (np.mod(phase[:, None] - ends, 2 * np.pi).min(axis=1) for ends in (touches, leaves))
    return np.asarray(touched < left)


@dataclass(frozen=True, eq=False)
class _TimePanels:
    """The period, cut into panels of time, and the friction of full slip [N], less a part that does not change, on the
    Gauss nodes of each.
    """

    low: Array  # (n_panels,) phases
    high: Array
    phase: Array  # (n_panels, N_NODES)
    force: Array  # (n_panels, N_NODES)
    rest: float  # what does not change: the mean where the harmonics of the force are known, else zero

    def harmonic(self, values: Array, n: int) -> complex:
        """Complex Fourier coefficient of values on the nodes."""
        across = _collocation()[2]
        return complex(np.sum((values * np.exp(-1j * n * self.phase)) @ across * (self.high - self.low)) / (2 * np.pi))

    def slope(self, values: Array) -> Array:
        """Derivative with respect to phase of values on the nodes."""
        x = 2 * _collocation()[0] - 1
        slope = legendre.legvander(x, N_NODES - 2) @ legendre.legder(_series())
        return np.asarray(values @ slope.T * 2 / (self.high - self.low)[:, None])


def _time_panels(case: SlidingContact, rates: NDArray[np.complex128], cuts: Array) -> _TimePanels:
    """Panels between the corners of the force and other cuts, short enough for harmonics, arms and free oscillation."""
    pull, known = case.pull, known_harmonics(case)
    smallest = MISSED if any(pull.coefficients[:2]) else np.sqrt(MISSED)  # a derivative costs half the digits
    fastest = float(_highest(rates))
    if np.isfinite(pull.omega_0):
        fastest = max(fastest, pull.omega_0 / case.omega)
    if known is None:
        cuts = np.append(cuts, corners(case))
    else:
        fastest = max(fastest, _highest(known[1]))
    most = np.pi / fastest  # half a period of what is fastest in a panel, at most; of arms, as many steps as nodes
    if case.material.contact_arms and known is None:
        most = min(most, N_NODES * 2 * np.pi / N_STEPS)
    cuts = np.unique(np.mod(cuts, 2 * np.pi))
    cuts = cuts[np.diff(cuts, append=np.inf) > smallest] if cuts.size else np.zeros(1)
    stretches = pairwise([*cuts, cuts[0] + 2 * np.pi])
    ends = np.concatenate([_graded(low, high, smallest) for low, high in stretches] + [cuts[:1] + 2 * np.pi])
    length = np.diff(ends)
    parts = np.ceil(length / max(most, 2 * np.pi / 4000)).astype(int)  # follows a light body's
    part = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)  # 0, 1, ... in each stretch
    ends = np.append(np.repeat(ends[:-1], parts) + part * np.repeat(length / parts, parts), ends[-1])
    low, high = ends[:-1], ends[1:]
    phase = low[:, None] + (high - low)[:, None] * _collocation()[0]
    rest, F = (0.0, normal_force(case, phase)) if known is None else (known[0], harmonic_sum(known[1], phase))
    law = case.friction
    friction = law.full(F, contact_radius(case, phase)) if case.strength_moves else law.mu_0 * F
    return _TimePanels(low, high, phase, friction, law.mu_0 * rest)


def _graded(low: float, high: float, smallest: float) -> Array:
    """Starts of panels that shrink towards both ends."""
    levels = SHRINK ** np.arange(1, 1 + max(int(np.ceil(np.log(smallest / (high - low)) / np.log(SHRINK))), 1))
    return np.asarray(low + (high - low) * np.concatenate([[0.0], levels[::-1], [0.5], 1 - levels]))


def _highest(harmonics: NDArray[np.complex128]) -> int:
    """Highest order that counts, 1 at least."""
    size = np.abs(harmonics)
    return int(np.flatnonzero(size > MISSED * size.max(initial=0.0)).max(initial=0)) + 1


@lru_cache
def _collocation() -> tuple[Array, Array, Array]:
    """Gauss nodes on (0, 1); matrix from values there to integrals from 0 to each node; weights of the whole."""
    x, weights = leggauss(N_NODES)
    integrals = legendre.legvander(x, N_NODES) @ legendre.legint(np.eye(N_NODES), lbnd=-1)
    return (x + 1) / 2, integrals @ _series() / 2, weights / 2


@lru_cache
def _series() -> Array:
    """Matrix from values on the Gauss nodes to Legendre coefficients."""
    return np.asarray(np.linalg.inv(legendre.legvander(leggauss(N_NODES)[0], N_NODES - 1)))


def _velocity(case: SlidingContact, panels: _TimePanels) -> Array:
    """y' [m/s] of the body on the nodes, shape (n_panels, N_NODES).

    Over the phase it is the first rate of x' = A x + b force, with the state x = (y, y') of a mass, x = (y) of a damper
    alone. Collocation solves for the rates on the nodes, as they are linear in the state at the start of the panel.
    """
    (m, c_x, K), omega = case.pull.coefficients, case.omega
    M, C = m * omega**2, c_x * omega
    if M == C == 0:
        rate = case.mu_0 * normal_force_rate(case, panels.phase, panels.slope)
        if case.strength_moves:
            strong = case.friction.strong_radius(contact_radius(case, panels.phase))
            rate = rate + case.friction.tau_0 * np.pi * panels.slope(strong**2)
        return -omega / K * rate
    A, b = (
        (np.array([[0, 1], [-K / M, -C / M]]), np.array([0, 1 / M])) if M else (np.array([[-K / C]]), np.array([1 / C]))
    )
    _, into, across = _collocation()
    force = panels.harmonic(panels.force, 0).real - panels.force
    (n_panels, n), d = force.shape, b.size
    h = (panels.high - panels.low)[:, None, None]
    right = np.empty((n_panels, n, d, 1 + d))  # of the force, and of each state at the start
    right[..., 0], right[..., 1:] = force[..., None] * b, A
    rates = np.linalg.solve(np.eye(n * d) - h * np.kron(into, A), right.reshape(n_panels, n * d, 1 + d))
    rates = rates.reshape(right.shape)
    start = _periodic(np.eye(d, 1 + d, 1) + h * np.einsum("n,pndk->pdk", across, rates))
    return np.asarray(rates[:, :, 0, 0] + np.einsum("pnk,pk->pn", rates[:, :, 0, 1:], start)) * omega


def _periodic(maps: Array) -> Array:
    """Fixed point of the map over one period: the state at the start of every panel, (n_panels, d).

    maps (n_panels, d, 1 + d) carry a state x from the start of a panel to its end: x -> q + P x.
    """
    d = maps.shape[1]
    q, P = np.zeros(d), np.eye(d)
    for step in maps:
        q, P = step[:, 0] + step[:, 1:] @ q, step[:, 1:] @ P
    x = np.linalg.lstsq(np.eye(d) - P, q, rcond=1e-10)[0]
    out = np.empty((maps.shape[0], d))
    for k, step in enumerate(maps):
        out[k] = x
        x = step[:, 0] + step[:, 1:] @ x
    return out


def _resonant_harmonic(pull: Pull, omega: float) -> int:
    """The n with k_x = m (n omega)² for a body without damper; 0 if there is none."""
    m, c_x, k_x = pull.coefficients
    if c_x > 0 or m == 0:
        return 0
    n = round(pull.omega_0 / omega)
    return n if abs(m * (n * omega) ** 2 / k_x - 1) < EXACT else 0


def _velocity_unbounded_at_touch(case: SlidingContact) -> bool:
    """True if a body without mass and damper has unbounded velocity as dashpots touch: a(d) rises faster than d."""
    m, c_x, _ = case.pull.coefficients
    if case.pull.is_rigid or m > 0 or c_x > 0 or case.T == 0 or case.keeps_contact:
        return False
    low, high = (float(case.indenter.contact_radius(share * case.u_z_max)) for share in (1e-9, 1e-8))
    return bool(np.log10(high / low) < 0.999)


def _at_begin(values: Array) -> Array:
    """Values at the start of panels of the polynomials through the nodes."""
    return np.asarray(values @ _series().T @ (-1.0) ** np.arange(N_NODES))


def _greatest(values: Array) -> float:
    """Greatest value in all panels, ends included, of the polynomials through the nodes; -inf without panels."""
    if not len(values):
        return -np.inf
    series = values @ _series().T
    x = np.cos(np.linspace(np.pi, 0, 4 * N_NODES))
    dense = series @ legendre.legvander(x, N_NODES - 1).T
    rises = (legendre.legvander(x, N_NODES - 2) @ legendre.legder(series.T)).T > 0
    tops = np.where(rises[:, :-1] & ~rises[:, 1:], np.maximum(dense[:, :-1], dense[:, 1:]), -np.inf).max(axis=1)
    best = float(dense.max())
    for k in np.argsort(tops)[-8:]:
        if np.isfinite(tops[k]):
            at = legendre.legroots(legendre.legder(series[k]))
            at = at.real[(abs(at.imag) < 1e-6) & (abs(at.real) < 1)]
            best = max(best, float(legendre.legval(at, series[k]).max(initial=-np.inf)))
    return best
