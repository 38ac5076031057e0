"""The periodic state under a pull that is shaken in the plane, spring by spring in closed form: no march.

shaken_spring.py has the compiled half, one spring. The indenter moves rigidly: its depth is u_z0 + unit z(phase), its
place in the plane v_0 t + x(phase), phase = omega t, z and x sums of harmonics. Tangential lengths are in mu_0 kappa
unit, v = v_0/(mu_0 kappa omega unit), T = omega tau, the gap of a spring c = (g - u_z0)/unit. Its compression s and its
extension e obey, with X = v phase + x,

    s = z - c in contact; it leaves where s + T s' falls to 0 and is free, s' = -s/T, until z - c meets s again;
    e' = X', or less where it slips forward, (s - e)' = -(s - e)/T, or more where it slips backward,
    (s + e)' = -(s + e)/T; free, e' = -e/T; |e + T e'| <= s + T s'.

T = 0 is the elastic contact: |e| <= s. The mean friction is mu_0 kappa times the sum of the mean e, as the mean of
e + T e' is that of e. Three facts make every mean a short sum.

1. In contact let y = e - X, which is constant in stick. With w^T = w + T w', A = z - X and B = z + X, a spring

       slips forward while y > A^T - c,   y' = (A^T - c - y)/T,
       and backward while  y < c - B^T,   y' = (c - B^T - y)/T;   for T = 0: y = A - c, or c - B.

   It is in contact until z^T = (A^T + B^T)/2 falls to c. Between two neighbouring extremes of A^T, B^T and z^T it
   therefore leaves or touches once at most, each slip ends once at most (its barrier recedes: it lags by an
   exponential) and begins once at most (its barrier comes nearer). Each of these instants is the only root of a
   harmonic sum with a drift and one exponential. All integrals between them are known functions.
2. The period maps e(0) to e(2 pi) = P(e(0)) with 0 <= dP/de = exp(-(slip + flight)/T) <= 1, so that P(e) - e falls and
   Newton's method, kept within a bracket, solves it; what its last step changes in the mean of e is the derivative of
   that times the step. For T = 0 the map is a clip of e + 2 pi v: for v > 0 one period
   from e = s is exact, and for v = 0 it gives the limit v -> +0. The period begins where z is greatest, as every spring
   that ever touches is in contact there.
3. The mean of e is an analytic function of c but where the sequence of touches, leaves and slips changes: where one of
   the numbers whose signs tell how a spring goes on is zero, which finds such a c. Next to it the mean goes with powers
   of its square root. Between two of them, and kinks of the shape, x = x_1 + (x_2 - x_1) sin²(theta/2) makes it
   analytic in theta, and the Chebyshev series in theta through 9 springs, or 17 where these do not do, is integrated.
   Its last coefficients bound the error. Where they are too large still the interval is halved.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import ArrayLike, NDArray

from mdr.case.contact import SlidingContact
from mdr.case.depth_cycle import harmonic_sum, lost_in_digits, turns
from mdr.case.domain import COULOMB, GIVEN_DEPTH, NO_ARMS, RIGID, Condition, Domain
from mdr.indenters.base import Indenter
from mdr.indenters.mapping.inversion import invert
from mdr.tools.arrays import EPS, EXACT, Array, beyond
from mdr.tools.records import ArrayRecord

if TYPE_CHECKING:
    from mdr.closed_forms.shaken_spring import Complex, Harmonics

TOLERANCE = 2e-10  #: of the sum over an interval of springs, over that of the compression of all


@dataclass(frozen=True, eq=False, repr=False)
class ShakenPull(ArrayRecord):
    """A rigid indenter of which depth and place in the plane are given: numbers only, scaled as above."""

    shape: Indenter
    u_z0: float  #: mean depth [m]
    unit: float  #: of the depth [m]
    Z: Complex  #: z = Re of sum Z_n exp(i n phase), n = 1 ... N; may be empty
    X: Complex  #: x likewise, in mu_0 kappa unit
    T: float = 0.0  #: omega tau

    @classmethod
    def of(cls, case: SlidingContact) -> ShakenPull:
        """The numbers of a case in CLOSED_FORM."""
        cycle = case.cycle
        way = case.way / (case.mu_0 * case.material.mindlin_ratio * cycle.unit)
        return cls(case.indenter, cycle.u_z0, cycle.unit, cycle.harmonics, way, case.T)

    @cached_property
    def _start(self) -> tuple[float, float]:
        """Phase at which z is greatest, and its value there."""
        tops = _turns(np.asarray(self.Z, dtype=complex))
        phase, z = max(tops, key=lambda top: top[1], default=(0.0, 0.0))
        return float(phase), float(z)

    @property
    def mirrored(self) -> ShakenPull:
        """The pull the other way, seen from there."""
        return replace(self, X=-np.asarray(self.X))

    @property
    def _harmonics(self) -> Harmonics:
        """The motion from the greatest z on."""
        from mdr.closed_forms.shaken_spring import Harmonics

        N = max(len(self.Z), len(self.X))
        n = np.arange(1, N + 1)
        turn = np.exp(1j * n * self._start[0])
        Z, X = (turn * np.pad(np.asarray(row, dtype=complex), (0, N - len(row))) for row in (self.Z, self.X))
        A, B = Z - X, Z + X
        T, rate = float(self.T), 1j * n
        lag = 1 + T * rate
        sides = np.array([A, B])
        rates = rate * lag * sides
        turns = _turns(rates[0]), _turns(rates[1])
        return Harmonics(T, Z, X, lag * Z, lag * sides, T * rate * sides, rates, turns, _turns(lag * Z))


def _resolves_springs(case: SlidingContact) -> bool:
    """Whether the digits of the way leave those of the springs."""
    reach = case.mu_0 * case.material.mindlin_ratio * case.cycle.unit
    return bool(np.abs(case.way).max(initial=0.0) * EPS <= TOLERANCE * reach)


#: cases whose friction is known here; with more harmonics a run is as fast
CLOSED_FORM = Domain(
    (
        COULOMB,
        RIGID,
        NO_ARMS,
        GIVEN_DEPTH,
        Condition("shake", "a shake along the pull alone", lambda case: not case.moves_across),
        Condition("cycle", "at most 64 harmonics", lambda case: max(case.cycle.cos.size, case.way.size) <= 64),
        Condition("shake", "a way that rounding leaves the deflection of springs", _resolves_springs),
    ),
    instead="cof_curve(case, [0]), or blocked_cof(case)",
)


def average_friction(pull: ShakenPull, v: ArrayLike) -> tuple[Array, Array, Array]:
    """Mean friction over mu_0 times mean force, bound of its error, and share of stick, at velocities v >= 0 (n_v,).

    The share of stick is that of the contact time, weighted by force. v = 0 is the limit of a pull ever slower forward.
    """
    v = np.asarray(v, dtype=float)
    if np.any(v < 0):
        raise ValueError(f"v must not be negative, got {float(v.min())!r}: ask the mirrored pull")
    from mdr.closed_forms.shaken_spring import all_changes

    harmonics = pull._harmonics
    marks = _marks(pull)
    gaps = _gaps(pull, marks)
    changes = all_changes(harmonics, v, gaps.min(), gaps.max(), _SCAN)
    owner, low, high = _intervals(pull, marks, gaps, changes)
    total, error = np.zeros((3, v.size)), np.zeros(v.size)
    allowed = TOLERANCE * _compression(pull)
    while owner.size:
        sums, missed = _integrals(pull, harmonics, v, owner, low, high, allowed)
        # so many intervals are halved at most; beyond, the error is larger than wanted
        done = (missed <= allowed) | (np.sum(missed > allowed) > 2000 + 20 * v.size)
        for row, found in zip(total, sums, strict=True):
            row += np.bincount(owner[done], found[done], v.size)
        error += np.bincount(owner[done], missed[done], v.size)
        owner, low, high = owner[~done], low[~done], high[~done]
        middle = 0.5 * (low + high)
        owner = np.repeat(owner, 2)
        low, high = np.column_stack([low, middle]).ravel(), np.column_stack([middle, high]).ravel()
    error = error / total[1] + TOLERANCE + _lost_in_digits(pull, v)
    return beyond(EXACT, total[0] / total[1]), error, np.clip(total[2] / total[1], 0, 1)


def _lost_in_digits(pull: ShakenPull, v: Array) -> Array:
    """Error that the digits of the depth leave, and those of the way of the top: its integrals up to either end of a
    contact are subtracted, which lasts for about the root of twice the greatest depth.
    """
    mean, deepest = pull.u_z0 / pull.unit, pull.u_z0 / pull.unit + pull._start[1]
    way, lasts = 2 * np.pi * v + np.abs(pull.X).sum(), np.sqrt(min(max(2 * deepest, 0.0), 1.0))
    return np.asarray(lost_in_digits(max(-mean, deepest), deepest) + lost_in_digits(way, deepest * lasts))


# --- the array: intervals of x, and the rule within -----------------------------------------------------------------


def _marks(pull: ShakenPull) -> Array:
    """Ends of the pieces in which g is smooth and the springs touch [m], from 0 to the greatest radius of contact."""
    shape, deepest = pull.shape, pull.u_z0 + pull.unit * pull._start[1]
    a = float(shape.contact_radius(deepest))
    if not a > 0:
        raise ValueError(f"u_z0 + unit max z = {deepest:.6g} m: the indenter never touches; raise u_z0")
    return np.array([0.0, *sorted({x for x in shape.joints if 0 < x < a}), a])


def _compression(pull: ShakenPull) -> float:
    """Sum over elastic springs of their mean compression [m]: half of the mean force over E* and the unit."""
    z = harmonic_sum(np.asarray(pull.Z, dtype=complex), np.linspace(0, 2 * np.pi, 64, endpoint=False))
    force = pull.shape.force(np.maximum(pull.u_z0 + pull.unit * z, 0), 1.0)
    return float(np.mean(force)) / (2 * pull.unit)


def _gaps(pull: ShakenPull, x: Array) -> Array:
    return np.minimum((np.asarray(pull.shape.profile_1d(x)) - pull.u_z0) / pull.unit, pull._start[1])


def _intervals(pull: ShakenPull, marks: Array, gaps: Array, changes: Array) -> tuple[NDArray[np.intp], Array, Array]:
    """Pieces of the array between marks and changes: the velocity they belong to, and their ends [m]."""
    changes = changes[:, : max(int(np.isfinite(changes).sum(axis=1).max(initial=0)), 1)]
    x = np.full(changes.shape, marks[-1])
    inside = (changes > gaps.min()) & (changes < gaps.max())
    x[inside] = _radius(pull, changes[inside], marks[-1])
    ends = np.sort(np.concatenate([x, np.broadcast_to(marks, (len(x), marks.size))], axis=1), axis=1)
    low, high = ends[:, :-1], ends[:, 1:]
    real = high - low > 1e-14 * marks[-1]
    return np.nonzero(real)[0], low[real], high[real]


def _radius(pull: ShakenPull, c: Array, end: float) -> Array:
    """Where the gap is c, up to the end of the row [m]."""
    g = pull.u_z0 + pull.unit * c
    if pull.shape.least_depth == 0:
        return np.asarray(pull.shape.contact_radius(np.maximum(g, 0)))
    x, _ = invert(lambda x: -np.asarray(pull.shape.profile_1d(x)), -g, np.full_like(c, end), end)  # g of a hollow falls
    return x


def _integrals(
    pull: ShakenPull, harmonics: Harmonics, v: Array, owner: NDArray[np.intp], low: Array, high: Array, allowed: float
) -> tuple[Array, Array]:
    """Integrals of e, s and the force in stick over the intervals (3, n), and a bound of the error of the first.

    The finer rule takes the springs of the coarser one and those between, where the coarser errs by more than allowed.
    """
    from mdr.closed_forms.shaken_spring import all_springs

    found, missed = np.empty((3, low.size)), np.empty(low.size)
    left, means = np.arange(low.size), np.empty((3, low.size, 0))
    for rule in _RULES:
        width = (high - low)[left]
        x = np.minimum(low[left, None] + width[:, None] * rule.share, high[left, None])
        more = all_springs(harmonics, v, np.repeat(owner[left], rule.share.size), _gaps(pull, x.ravel()))
        means = np.concatenate([means, more.reshape(3, *x.shape)], axis=2)
        found[:, left] = (means @ rule.weight) * width
        last = np.abs(means[:2] @ rule.tail).max(axis=2).sum(axis=0)
        missed[left] = width * last
        again = missed[left] > allowed
        left, means = left[again], means[:, again]
        if not left.size:
            break
    return found, missed


class _Rule(NamedTuple):
    """An integral through Chebyshev points, of which the first are those of the coarser rule."""

    share: Array  # of the interval: where the further nodes are, sin²(theta/2) for theta in [0, pi]
    weight: Array  # of all nodes
    tail: Array  # (nodes, 2): the last coefficients in theta

    @classmethod
    def of(cls, order: int, nested: bool) -> _Rule:
        """The rule of so many nodes and one; nested: within it that of half the order."""
        j = np.arange(order + 1)
        half = np.where((j == 0) | (j == order), 0.5, 1.0)
        coefficients = 2 / order * np.cos(np.pi * np.outer(j, j) / order) * half * half[:, None]
        u, w = leggauss(4 * order)
        moments = np.cos(np.outer(j, np.arccos(u))) @ (w * np.pi / 4 * np.cos(np.pi / 2 * u))
        share = np.sin(0.25 * np.pi * (1 - np.cos(np.pi * j / order))) ** 2
        nodes = np.r_[j[::2], j[1::2]] if nested else j
        tail = np.ascontiguousarray(coefficients[-2:, nodes].T)
        return cls(share[1::2] if nested else share, (moments @ coefficients)[nodes], tail)


_RULES = (_Rule.of(8, nested=False), _Rule.of(16, nested=True))
_SCAN = np.unique(np.r_[1e-9, 1e-5, np.sin(np.linspace(0, np.pi / 2, 16)[1:-1]) ** 2, 1 - 1e-5, 1 - 1e-9])


def _turns(C: Complex) -> Array:
    """Phases in [0, 2 pi) at which Re of sum C_n exp(i n phase) is extreme, and its values there (n, 2)."""
    phase = turns(C)
    return np.column_stack([phase, harmonic_sum(C, phase)])
