"""What of uniqueness and order is left where friction is a vector: all of it, but for the force to the side.

Coulomb's law of a vector is monotone as well, as its set of friction, a disc, is convex: (f_1 - f_2)·(g_1 - g_2) >= 0.
So with vectors in the place of numbers (*) of validation/uniqueness.py holds word for word: two motions under one given
normal motion never move apart, and for two pulling velocities V, which are vectors,
(V_1 - V_2)·(<F_1> - <F_2>) >= 0. Friction along the pull never falls with v_0; of the force across nothing is said.

The disc is strictly convex: equality needs f_1 = f_2 where one of the two slips. Under a rigid pull each elastic spring
is alone, and keeps its part of the distance in the end. So from its first slip on a spring has one state, and with it
the mean forces; those that never slip, which is so only at v_0 = 0, may keep any.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cache
from itertools import combinations

import numpy as np

import mdr
from mdr.march.dynamics.dimensionless import ScaledContact
from mdr.march.dynamics.state import MarchState
from mdr.march.dynamics.stepper import Stepper
from mdr.spring.contact_modes import SLIP
from mdr.tools.arrays import Array
from validation.cases import DEPTH, OMEGA, SHAPES, contact
from validation.report import Check, Checks

SPRINGS, STEPS, PERIODS = 48, 256, 60
SYSTEMS, CURVES = {"quick": 4, "full": 24, "long": 100}, {"quick": 2, "full": 8, "long": 30}
FASTER = (0.02, 0.1, 0.3, 0.6, 1.0, 1.6)  #: v_0 over omega times the shake
STEP = 1e-9  #: by which an error of fourth order in the step may move two motions apart in a period, over the distance


@dataclass(frozen=True)
class System:
    """A random contact shaken along and across, pulled rigidly."""

    shape: str
    alpha: float
    eta: float
    slope: float  #: angle between the shake and the pull
    phases: tuple[float, float]
    v: float  #: v_0 over omega times the shake
    T: float = 0.0  #: omega tau

    @property
    def case(self) -> mdr.SlidingContact:
        """The contact."""
        case = contact(self.shape, self.alpha or 0.1, self.T)
        size = self.eta * case.mu_0 * case.material.mindlin_ratio * DEPTH
        along, across = size * np.cos(self.slope), size * np.sin(self.slope)
        shake = mdr.InPlaneOscillation(OMEGA, float(along), self.phases[0], float(across), self.phases[1])
        oscillation = case.oscillation if self.alpha else mdr.ConstantDepth(DEPTH)
        return replace(case, oscillation=oscillation, shake=shake)

    @property
    def v_0(self) -> float:
        """Pulling velocity [m/s]."""
        case = self.case
        return self.v * OMEGA * self.eta * case.mu_0 * case.material.mindlin_ratio * DEPTH


def drawn(n: int) -> list[System]:
    """Random systems, every third at a constant depth, every fourth a Kelvin one."""
    rng, names, out = np.random.default_rng(2027), tuple(SHAPES), []
    for i in range(n):
        alpha = 0.0 if i % 3 == 0 else float(rng.uniform(0.1, 1.4))
        phases = tuple(rng.uniform(0, 2 * np.pi, 2).tolist())
        eta, slope, v = float(0.3 * 10 ** rng.uniform()), float(rng.uniform(0.2, 1.4)), float(rng.uniform(0.05, 1.2))
        out.append(System(names[i % 4], alpha, eta, slope, (phases[0], phases[1]), v, 0.3 if i % 4 == 3 else 0.0))
    return out


@cache
def followed(system: System) -> tuple[Array, float]:
    """Squares of the distance of two random motions over the periods; and of springs that slip at last, at the end."""
    case, rng = system.case, np.random.default_rng(11)
    scaled = ScaledContact.of(case, mdr.SpringArray.of(case, SPRINGS), STEPS, lump=False)
    stepper = Stepper(scaled, system.v_0 / scaled.units.speed)
    motions, out = [_scattered(stepper, rng) for _ in range(2)], []
    for _ in range(PERIODS):
        out.append(_apart(motions, scaled.springs.w))
        motions = [stepper.advance(motion, 1)[0] for motion in motions]
    out.append(_apart(motions, scaled.springs.w))
    record = stepper.observe(motions[0], keep=True)[1]
    slips = (np.asarray(record.seen.mode) == SLIP).any(axis=0)
    gap = np.abs(motions[0].e - motions[1].e).max(axis=0)
    return np.array(out), float(gap[slips].max())


def _scattered(stepper: Stepper, rng: np.random.Generator) -> MarchState:
    """Full slip, but every spring stretched anywhere within its disc."""
    state = stepper.full_slip()
    size, angle = np.sqrt(rng.uniform(size=state.s[0].size)), rng.uniform(0, 2 * np.pi, state.s[0].size)
    state.e[:] = state.s[0] * size * np.exp(1j * angle)
    return state


def _apart(motions: list[MarchState], w: Array) -> float:
    one, two = motions
    return float((np.abs(one.e - two.e) ** 2).sum(axis=0) @ w)


def checks(effort: str) -> Checks:
    """Two motions, and curves."""
    systems = drawn(SYSTEMS[effort])
    growths, gaps = zip(*((growth(followed(one)[0], 1e-12), followed(one)[1]) for one in systems), strict=True)
    name = f"in the plane: largest growth of the distance of two motions over a period, {len(systems)} systems"
    yield Check.at_most(name, max(growths), STEP, "turns are of fourth order in the step")
    name = "in the plane: largest difference of two motions, in springs that slip in the last period"
    yield Check.at_most(name, max(gaps), 1e-6, "a slow slide takes its time: they still approach")
    still = replace(systems[0], shape="paraboloid", alpha=0.0, eta=0.2, slope=1.5, v=0.0)
    D = followed(still)[0]
    name = "in the plane: distance of two motions at v_0 = 0, shaken by a fifth of what springs follow, over its start"
    yield Check.between(name, D[-1] / D[0], 0.05, 0.95, "springs that never slip keep their part of it")
    yield Check.at_most("its change in the last period", abs(D[-1] / D[-2] - 1), STEP, "the others have one state")
    curves = [[mdr.slide(one.case, v * one.v_0 / one.v) for v in FASTER] for one in systems[: CURVES[effort]]]
    name = f"in the plane: largest fall of COF/μ_0 with velocity, less both errors, {len(curves)} systems"
    yield Check.at_most(name, max(falls(curves)), 1e-12, "the errors that the runs state; rounding")
    both = sum(bool(np.ptp(np.sign(np.diff([run.cof_y for run in runs])))) for runs in curves)
    yield Check.at_least("curves of which the force across rises and falls", both, 1, "nothing orders it")


def growth(D: Array, rounding: float) -> float:
    """Largest growth of a distance over a period, over it, while it is more than this share of that at the start."""
    told = D[:-1] > rounding * D[0]
    return float(np.max(D[1:][told] / D[:-1][told]) - 1)


def falls(curves: Iterable[list[mdr.SlidingRun]]) -> list[float]:
    """By how much COF/mu_0 falls from one velocity to a higher one, less both errors; runs that settled."""
    pairs = [pair for runs in curves for pair in combinations([run for run in runs if run.settled], 2)]
    return [(a.cof - b.cof - a.cof_error - b.cof_error) / a.mu_0 for a, b in pairs]
