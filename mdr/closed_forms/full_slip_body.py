"""The body in full slip: its periodic motion under mu_0 F_N(t), and the velocity above which no spring ever sticks.

In full slip every spring in contact slips at u_x' - mu_0 kappa u_z', so with the motion y of the body relative to the
pull, m y'' + c_x y' + k_x y = -mu_0 F_N(t),

    v_c = max over instants with contact of [mu_0 kappa u_z' - y'].

With harmonics F_n of F_N and the receptance H this is y = -mu_0 sum F_n H(n omega) exp(i n omega t); one harmonic gives
Eq. (15), and H = 0, a rigid pull, gives Eq. (1) if the centre of the contact has touched by phase 3 pi/2.

Method. F_N is analytic between the phases at which the edge turns or crosses the tip, a kink or the rim; there it bends
like a power, or jumps (a punch on dashpots). The period is cut there, and panels shrink geometrically towards each cut.
In every panel the body is solved by Gauss-Legendre collocation, which neither damps nor excites its free oscillation;
the panels are chained to a map over the period, whose fixed point is the periodic motion.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.polynomial import legendre
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact, require_case
from mdr.case.depth_cycle import harmonic_sum, peaks
from mdr.case.in_plane import sign_of
from mdr.case.pull import Pull
from mdr.closed_forms.full_slip import edge_marks, followed, force_of, mean_normal_force, normal_force
from mdr.normal.followed_force import N_STEPS
from mdr.normal.kelvin_edges import kept_gap, leaving_phase, touching_phase, turning_phase
from mdr.normal.resolved import resolved
from mdr.tools.arrays import Array

N_NODES = 20
SHRINK = 0.3  #: of neighbouring panels towards a cut: 20 nodes leave 3.4**-20 = 2e-11 of a power that begins there
SMALLEST = 1e-11  #: panel beside a cut, of the stretch between cuts
SMALLEST_RATE = 1e-5  #: the same where F_N is differentiated
MOST_PANELS = 4000  #: to follow the free oscillation of a light body
RESONANT_FOLLOWED = 1e-8  #: the same of a force followed spring by spring
RESONANT = 1e-10  #: share of F_N that a harmonic on an undamped resonance may have and count as none


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
        with a harmonic F_n that is not zero. Infinite too for a body without mass and damper whose contact is lost and
        touches again with a jump of F_N' (a Kelvin material, unless the tip is sharp): for an instant its velocity has
        no bound.

    Raises
    ------
    TypeError
        For what is no SlidingContact.
    ValueError
        For another direction.

    Notes
    -----
    A shake along the pull takes off its velocity x' forward, and adds it the other way: v_c is the greatest
    mu_0 kappa u_z' - y' -+ x' while any spring is in contact.

    The error is 1e-8 for a harmonic depth on an elastic or Kelvin material. Other materials and motions have their
    normal force computed spring by spring. The error is then 1e-6 under a rigid pull or while contact is kept, and 1e-3
    where contact is lost and springs touch again on slow dashpots. For a body with neither mass nor damper it is 1e-3
    while contact is kept, and some per cent where contact is lost.

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
    direction, X_n = sign_of(direction), require_case(case).way
    if not np.isfinite(X_n).all():
        return np.inf
    case, X_n = resolved(case), direction * X_n
    if not case.is_of_the_paper:
        return _by_harmonics(case, X_n)
    omega, unit = case.omega, case.unit_velocity
    on, off = contact_span(case)
    if case.pull.is_rigid and case.is_shaken:
        harmonics = -1j * omega * np.arange(1, X_n.size + 1) * X_n
        harmonics[0] += 1j * unit
        return _greatest(harmonics, on, off + 2 * np.pi if off < on else off)
    if case.pull.is_rigid:
        return unit * (1.0 if on <= 1.5 * np.pi else -float(np.sin(on)))
    panels = _time_panels(case, SMALLEST_RATE if case.pull.coefficients[:2] == (0, 0) else SMALLEST)
    resonant = _resonant_harmonic(case.pull, omega)
    if _velocity_unbounded_at_touch(case) or (
        resonant and abs(panels.harmonic(panels.force, resonant)) > RESONANT * panels.mean
    ):
        return np.inf
    y_dot = _velocity(case.pull, panels, case.mu_0, omega)
    if resonant:  # the force does not contain it, so neither does the periodic motion
        y_dot -= 2 * (panels.harmonic(y_dot, resonant) * np.exp(1j * resonant * panels.phase)).real
    middle = 0.5 * (panels.low + panels.high)
    touching = (middle >= on) | (middle <= off)
    shaken = harmonic_sum(1j * omega * np.arange(1, X_n.size + 1) * X_n, panels.phase)
    rates = (-unit * np.sin(panels.phase) - y_dot - shaken)[touching]
    return max(_peak(rates[k]) for k in np.argsort(rates.max(axis=1))[-3:])


def _by_harmonics(case: SlidingContact, X_n: NDArray[np.complex128]) -> float:
    """Full-slip critical velocity [m/s] of any material and motion, from the harmonics of the normal force.

    X_n: of the way [m] of the shake in the direction of the pull.
    """
    cycle, pull, omega = case.cycle, case.pull, case.omega
    known = followed(case, N_STEPS)
    rates = np.zeros(N_STEPS // 2 - 1, dtype=complex)  # of mu_0 kappa u_z - y
    n = np.arange(1, rates.size + 1)
    rates[: cycle.cos.size] += case.unit_velocity * (1j * n * np.resize(cycle.harmonics, n.size))[: cycle.cos.size]
    rates[: X_n.size] -= 1j * n[: X_n.size] * omega * X_n
    if not pull.is_rigid:
        F_n = np.fft.rfft(force_of(case, known))[1:-1] / N_STEPS
        resonant = _resonant_harmonic(pull, omega)
        drives = resonant and abs(F_n[resonant - 1]) > RESONANT_FOLLOWED * known.F_N.mean() * case.material.E_star
        if drives or _velocity_unbounded_at_touch(case):
            return np.inf
        H = np.asarray(pull.receptance(n * omega))
        if resonant:
            H[resonant - 1] = 0
        rates += 2 * case.mu_0 * 1j * n * omega * H * F_n
    at_touch = (rates * np.exp(1j * np.outer(known.touches, n))).real.sum(axis=1)
    return float(max(peaks(rates, within=known.in_contact).max(), at_touch.max(initial=-np.inf)))


def _greatest(rates: NDArray[np.complex128], low: float, high: float) -> float:
    """Greatest value of Re of sum rates_n exp(i n phase), n = 1 ... N, between two phases, both included."""
    from scipy.optimize import minimize_scalar

    phase = np.linspace(low, high, 64 * rates.size + 1)
    values = harmonic_sum(rates, phase)
    k = int(np.argmax(values))
    ends = phase[max(k - 1, 0)], phase[min(k + 1, phase.size - 1)]
    refined = minimize_scalar(
        lambda at: -float(harmonic_sum(rates, at)), bounds=ends, method="bounded", options={"xatol": 1e-12}
    )
    return max(float(values[k]), -float(refined.fun))


def contact_span(case: SlidingContact) -> tuple[float, float]:
    """Phases (touch, leave) of the centre: contact from touch to leave + 2 pi; (0, 2 pi) where it is never lost."""
    gap = -case.cycle.u_z0 / case.cycle.unit
    if gap <= kept_gap(case.T):
        return 0.0, 2 * np.pi
    return touching_phase(gap, case.T), float(leaving_phase(gap, case.T))


@dataclass(frozen=True, eq=False)
class _TimePanels:
    """The period, cut into panels of time, and the normal force [N] on the Gauss nodes of each."""

    low: Array  # (n_panels,) phases
    high: Array
    phase: Array  # (n_panels, N_NODES)
    force: Array  # (n_panels, N_NODES)
    mean: float

    def harmonic(self, values: Array, n: int) -> complex:
        """Complex Fourier coefficient of values on the nodes."""
        across = _collocation()[2]
        return complex(np.sum((values * np.exp(-1j * n * self.phase)) @ across * (self.high - self.low)) / (2 * np.pi))


def _time_panels(case: SlidingContact, smallest: float) -> _TimePanels:
    T, pull = case.T, case.pull
    cuts = {0.0, turning_phase(T), 2 * np.pi}
    for gap in edge_marks(case):
        cuts |= {float(leaving_phase(gap, T)), touching_phase(gap, T)}
    levels = SHRINK ** np.arange(1, 1 + int(np.ceil(np.log(smallest) / np.log(SHRINK))))
    graded = np.concatenate([[0.0], levels[::-1], [0.5], 1 - levels, [1.0]])
    ends = np.unique(np.concatenate([low + (high - low) * graded for low, high in pairwise(sorted(cuts))]))
    if np.isfinite(pull.omega_0):
        most = max(np.pi * case.omega / pull.omega_0, 2 * np.pi / MOST_PANELS)
        length = np.diff(ends)
        parts = np.ceil(length / most).astype(int)
        part = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)  # 0, 1, ... in each stretch
        ends = np.append(np.repeat(ends[:-1], parts) + part * np.repeat(length / parts, parts), 2 * np.pi)
    low, high = ends[:-1], ends[1:]
    phase = low[:, None] + (high - low)[:, None] * _collocation()[0]
    return _TimePanels(low, high, phase, normal_force(case, phase), mean_normal_force(case))


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


def _velocity(pull: Pull, panels: _TimePanels, mu_0: float, omega: float) -> Array:
    """y' [m/s] of the body on the nodes, shape (n_panels, N_NODES); the phase is its time, so that all are lengths."""
    nodes, into, across = _collocation()
    force = -mu_0 * (panels.force - panels.mean)
    m, c_x, K = pull.coefficients
    M, C = m * omega**2, c_x * omega
    h = (panels.high - panels.low)[:, None, None]
    one, unit = np.ones_like(force), np.eye(nodes.size)
    if M > 0:  # the rate of w = y' is r: w = w_0 + h into r, y = y_0 + h nodes w_0 + h² into² r
        matrix = M * unit + h * (C * into + K * h * (into @ into))
        r = np.linalg.solve(matrix, np.stack([force, -K * one, -C * one - K * h[:, 0] * nodes], axis=2))
        w = h * (into @ r) + np.array([0, 0, 1])
        y_end = h[:, 0] * (across @ w) + np.array([0, 1, 0])
        w_end = h[:, 0] * (across @ r) + np.array([0, 0, 1])
        start = _periodic(np.stack([y_end, w_end], axis=1))
        return np.asarray(w[:, :, 0] + w[:, :, 1] * start[:, :1] + w[:, :, 2] * start[:, 1:]) * omega
    if C > 0:  # C w + K (y_0 + h into w) = force
        w = np.linalg.solve(C * unit + K * h * into, np.stack([force, -K * one], axis=2))
        start = _periodic((h[:, 0] * (across @ w) + np.array([0, 1]))[:, None, :])
        return np.asarray(w[:, :, 0] + w[:, :, 1] * start) * omega
    x = 2 * nodes - 1
    slope = legendre.legvander(x, N_NODES - 2) @ legendre.legder(_series())
    return np.asarray(force @ slope.T * 2 / h[:, 0] / K) * omega


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
    return n if abs(m * (n * omega) ** 2 / k_x - 1) < 1e-12 else 0


def _velocity_unbounded_at_touch(case: SlidingContact) -> bool:
    """True if a body without mass and damper has unbounded velocity as dashpots touch: a(d) rises faster than d."""
    m, c_x, _ = case.pull.coefficients
    if case.pull.is_rigid or m > 0 or c_x > 0 or case.T == 0 or case.keeps_contact:
        return False
    low, high = (float(case.indenter.contact_radius(share * case.u_z_max)) for share in (1e-9, 1e-8))
    return bool(np.log10(high / low) < 0.999)


def _peak(values: Array) -> float:
    """Largest value in a panel, ends included, of the polynomial through the nodes."""
    series = _series() @ values
    turns = legendre.legroots(legendre.legder(series))
    inner = turns.real[(abs(turns.imag) < 1e-6) & (abs(turns.real) < 1)]
    return float(legendre.legval(np.concatenate([[-1.0, 1.0], inner]), series).max())
