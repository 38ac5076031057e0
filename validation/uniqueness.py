"""One COF for one velocity, and never less at a higher one: a given normal motion leaves no room for hysteresis.

Coulomb's law under a given normal force N is monotone: of two tangential states of a spring with forces f_1, f_2 and
slip velocities g_1, g_2, where |f| <= N and f = N sign(g) in slip, always (f_1 - f_2)(g_1 - g_2) >= 0. Take any two
motions of one contact, at pulling velocities that differ by dv, and call all differences d. With the body
m u'' = P - F, pulled by P = k_x (v_0 t - u) + c_x (v_0 - u'), and springs f = k (e + tau e'), u' = e' + g, their
distance

    D = [m du'² + k_x (du - dv t)² + sum of k de²]/2

changes by

    D' <= dv dP - c_x (du' - dv)² - sum of k tau de'²,                                                          (*)

where all that friction does is in the sign <=: the sum of df dg was left out. Hence

* dv = 0: two motions at one velocity never move apart. Where damping sees them differ, they approach.
* D is never negative, so over a long time t the mean of dv dP is at least -D(0)/t: the mean pull, and with it the mean
  friction, at a higher velocity is never less, whatever the two motions are. (<P> = <F> as long as the velocity of the
  body stays bounded.) With cof <= mu_0 it stays at mu_0 above any velocity at which it is mu_0.
* Two motions at one v_0 both lie between those at v_0 - dv and v_0 + dv: the COF is unique where it does not jump. With
  any damping it is unique there too: in the end D stays constant, so c_x du' = 0, tau de' = 0 and df = 0 wherever one
  of the two slips. With c_x, du is constant, and so is de = 0 after the first slip of each spring; with tau, de is
  constant, and zero as of that slip. Either way both have the same forces.

It is the COF that is unique, not the motion: in full slip all motions have the same forces, and without c_x a free
oscillation of the body lasts for ever. Nothing was used of shape, amplitude, contact kept or lost, or the body, which
may be any passive linear system; only that the normal motion is given and mu_0 constant. Hysteresis seen in an
experiment is therefore the sign of what these springs leave out: a normal motion that feels the tangential one, or a
local friction that depends on slip velocity or time.

Symbols: alpha = du_z/u_z0, T = omega tau, omega_0² = k_x/m, v_c of the full-slip condition.
"""

from dataclasses import dataclass, replace
from functools import cache
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

import mdr
from mdr.closed_forms.rigid_pull import average_friction
from mdr.march.dynamics.body import U
from mdr.march.dynamics.dimensionless import ScaledContact
from mdr.march.dynamics.stepper import TOLERANCE, Stepper
from mdr.march.periodic.search import search_from_full_slip
from mdr.march.periodic.settling import Settling
from mdr.march.periodic.waiting import Waiting, pre_sliding
from mdr.tools.arrays import Array
from mdr.tools.progress import progress
from validation.cases import SHAPES, contact
from validation.figures import COLOURS, figure
from validation.report import Check, Checks, Claim, Equation, told
from validation.uniqueness_in_the_plane import checks as checks_in_the_plane
from validation.uniqueness_in_the_plane import falls, growth

SPRINGS, STEPS = 96, 512  # of the random systems: every start of one has the same, so the COFs must agree without them
SYSTEMS = {"quick": 6, "full": 60, "long": 200}
CURVES = {"quick": 2, "full": 12, "long": 40}
RIGID = {"quick": 30, "full": 300, "long": 1000}
STARTS = ("full slip", "rest", "random", "random", "random")
MOST = 3000  # periods a start may take
PERIODS = 40  # of the distances
ROUNDING = 1e-11  # of a distance, over PERIODS * STEPS steps
FASTER = (0.1, 0.3, 0.5, 0.7, 0.85, 0.95, 1.05, 1.5)  # v_0/v_c of a curve
SWEEP = tuple(np.linspace(0.1, 1.2, 12))  # v_0/v_c up and down
SHORT = 12  # periods at each of them


@dataclass(frozen=True)
class System:
    """A random contact under a body, and the velocity at which it is pulled."""

    shape: str
    alpha: float
    T: float
    ratio: float  #: omega_0/omega
    k_ratio: float  #: k_x/k_xc
    damping_ratio: float
    v_hat: float  #: v_0/v_c

    @property
    def case(self) -> mdr.SlidingContact:
        """The contact."""
        groups = {"k_ratio": self.k_ratio, "omega_0_ratio": self.ratio, "damping_ratio": self.damping_ratio}
        return contact(self.shape, self.alpha, self.T, **groups)

    @property
    def v_0(self) -> float:
        """Pulling velocity [m/s]."""
        return self.v_hat * mdr.full_slip_critical_velocity(self.case)

    def march(self, start: str, rng: np.random.Generator) -> Waiting:
        """A march about to begin in full slip, at rest or anywhere."""
        case = self.case
        scaled = ScaledContact.of(case, mdr.SpringArray.of(case, SPRINGS), STEPS, lump=False)
        stepper = Stepper(scaled, self.v_0 / scaled.units.speed)
        if start == "rest":
            return Waiting(stepper, stepper.rest(), pre_sliding(scaled, stepper.v))
        march = Waiting(stepper, stepper.full_slip())
        if start == "random":
            scatter(march, rng)
        return march


def scatter(march: Waiting, rng: np.random.Generator) -> None:
    """Stretch every spring at random within its cone of friction, and push the body by some units both ways."""
    e, s, body = march.state.e, march.state.s, march.state.body
    e[0] = rng.uniform(-1, 1, e[0].size) * s[0]
    body[:] = body[U] + rng.normal(), march.stepper.v * rng.normal()


def distance(one: Waiting, two: Waiting) -> float:
    """D of the module, in scaled form."""
    scaled, e, (y, y_dot) = one.scaled, one.state.e[0] - two.state.e[0], one.state.body - two.state.body
    return float(0.5 * (scaled.body.M * y_dot**2 + scaled.body.K * y**2 + scaled.springs.w @ e**2))


@cache
def distances(system: System) -> Array:
    """D of two random motions at the ends of so many periods, shape (PERIODS + 1,)."""
    rng = np.random.default_rng(7)
    return _followed(system.march("random", rng), system.march("random", rng))


def swinging() -> Array:
    """The same for an undamped body in full slip and one that swings a little besides, so that neither sticks."""
    system, rng = System("r^4", 0.5, 0.0, 1.3, 1.5, 0.0, 1.5), np.random.default_rng(0)
    one, two = (system.march("full slip", rng) for _ in range(2))
    two.state.body[U] += 0.1
    return _followed(one, two)


def _followed(one: Waiting, two: Waiting) -> Array:
    found = [distance(one, two)]
    for _ in range(PERIODS):
        one.advance(1)
        two.advance(1)
        found.append(distance(one, two))
    return np.array(found)


def drawn(n: int) -> list[System]:
    """Random systems with damping ratio 0.005 to 0.1, one in three undamped, one in five beside a whole multiple."""
    rng, near = np.random.default_rng(2016), np.random.default_rng(2026)
    names, systems = tuple(SHAPES), []
    for i in range(n):
        log = rng.uniform(size=4)
        shape, alpha = names[int(rng.integers(4))], float(0.05 * 30 ** log[0])
        T = float((0.0, 0.1 * 30 ** log[1])[int(rng.integers(2))])
        ratio = _beside(i, near) if i % 5 == 4 else float(0.4 * 6 ** rng.uniform())
        k_ratio, damping_ratio = float(0.3 * 10 ** log[2]), 0.0 if i % 3 == 0 else float(0.005 * 20 ** log[3])
        systems.append(System(shape, alpha, T, ratio, k_ratio, damping_ratio, float(rng.uniform(0.1, 1.2))))
    return systems


def _beside(i: int, rng: np.random.Generator) -> float:
    """omega_0/omega within 1e-2 of a whole multiple, where a body beats with the drive for long."""
    return float((1 + i // 5 % 3) * (1 + rng.choice([-1, 1]) * 10 ** rng.uniform(-4, -2)))


@dataclass(frozen=True)
class Ends:
    """Where a system ended from each of its starts."""

    system: System
    settlings: tuple[Settling, ...]

    @property
    def settled(self) -> list[Settling]:
        """Those that ended."""
        return [s for s in self.settlings if s.settled]

    @property
    def excess(self) -> float:
        """Largest difference of two COFs over mu_0 less what their spreads allow, of all pairs that settled."""
        pairs = combinations(self.settled, 2)
        return max((abs(a.mean - b.mean) - a.spread - b.spread for a, b in pairs), default=-np.inf)


@cache
def ends(system: System) -> Ends:
    """March from every start until settled, or give up; three times as long again if it still changes its period."""
    rng = np.random.default_rng(5)
    found = []
    for start in STARTS:
        march = system.march(start, rng)
        orbit = search_from_full_slip(march.stepper) if start == "full slip" else None
        settling = (orbit or march.wait(MOST)).settling
        if settling.settled and settling.kind != "periodic":
            march.advance(3 * march.n)
            settling = march.assess()
        found.append(settling)
    return Ends(system, tuple(found))


@cache
def swept(n_periods: int | None) -> tuple[Array, Array, NDArray[np.bool_]]:
    """COF over mu_0 of one lightly damped system up and down the velocities, each going on from the former's state.

    n_periods: at each velocity; None waits until settled. Returns (2, n) means, spreads and whether settled.
    """
    base = System("paraboloid", 0.5, 0.0, 0.97, 0.5, 0.01, 1.0)
    rng = np.random.default_rng(0)
    runs: list[Settling] = []
    state = None
    for v_hat in (*SWEEP, *SWEEP[::-1]):
        march = replace(base, v_hat=v_hat).march("full slip", rng)
        march.state = state or march.state
        if n_periods is None:
            orbit = march.wait(MOST)
            settling, state = orbit.settling, orbit.state
        else:
            march.advance(n_periods)
            settling = replace(march.assess(), mean=float(march.periods.cof[n_periods // 2 :].mean()))
            state = march.state
        runs.append(settling)
    n, found = len(SWEEP), (np.array([getattr(r, k) for r in runs]) for k in ("mean", "spread", "settled"))
    means, spreads, settled = (np.stack([values[:n], values[n:][::-1]]) for values in found)
    return means, spreads, settled


_EQUATION = Equation(
    "D",
    r"\dot{D} \le \delta v \, \delta P - c_x (\delta \dot{u} - \delta v)^2 - \sum k \tau \delta \dot{e}^2, \quad D ="
    r" \frac{1}{2} \left[ m \delta \dot{u}^2 + k_x (\delta u - \delta v \, t)^2 + \sum k \delta e^2 \right]",
    "Distance of two motions of one contact, δ the difference of the two: of the velocity v_0, the pull P,"
    " the body u and the extensions e of the springs. With δv = 0 it never grows.",
)


def claim(effort: str) -> Claim:
    """One coefficient of friction for one velocity, and never less at a higher one

    How: Follow motions of random systems from several starts, and friction over velocity.

    Quote: Second, the coefficient of friction increases monotonically (again, barring exceptional system-dynamical
    circumstances) until it reaches the microscopic value at some critical velocity. (Section 3)

    Range: {n_systems} random systems (four shapes, α = 0.05 … 1.5, elastic and ωτ = 0.1 … 3, ω_0/ω = 0.4 … 2.4, one in
    five within 1e-2 of 1, 2 or 3, k_x/k_x,c = 0.3 … 3, damping ratio 0 to 0.1, v_0/v_c = 0.1 … 1.2) from {n_starts}
    states each: full slip, rest and {n_random} random ones; {n_curves} of them over {n_velocities} velocities, and
    {n_rigid} rigid pulls in closed form.

    Measured: The exceptions do not exist. Under a given normal motion Coulomb’s law is monotone, and from this alone it
    follows that two motions of one contact never move apart, that the mean friction at a higher velocity is never less,
    and that the COF is unique (of an undamped elastic body: except where the curve jumps): no hysteresis, no coexisting
    states, for any shape, amplitude, relaxation time and body, on a resonance too. Of {n_runs} runs {n_settled}
    settled, and those of one system agree to {apart:.1e}, each pair within its own spreads{others}. The motion is not
    unique: in full slip an undamped body keeps its free oscillation for ever, with the same friction. Sweeping the
    velocity up and down with {SHORT} periods at each step shows a loop of {loop:.2f} μ_0, made of transients that no
    run calls settled; waiting closes it to {closed:.1e}. Shaken across, where friction is a vector, all of this holds
    but for the force to the side, which may rise and fall.

    Verdict: holds

    Sentence: Under a given normal motion, with constant μ_0, one velocity has one COF (except where the curve of an
    undamped elastic body jumps), which never falls with velocity; so there is one v_c.
    """
    found = [ends(system) for system in progress(drawn(SYSTEMS[effort]), "uniqueness")]
    curves = _curves(effort)
    n_runs, n_settled = sum(len(e.settlings) for e in found), sum(len(e.settled) for e in found)
    rest = sum(len(e.settled) < len(STARTS) for e in found)
    others = f"; the rest, {rest} of the undamped systems, still changed, said so, and is not compared" if rest else ""
    short, waited = swept(SHORT), swept(None)
    loop = float(np.abs(short[0][0] - short[0][1]).max())
    n_systems, n_starts, n_random = len(found), len(STARTS), STARTS.count("random")
    n_curves, n_velocities, n_rigid = len(curves), len(FASTER), RIGID[effort]
    apart = max(np.ptp([s.mean for s in e.settled] or [0.0]) for e in found)
    closed = np.abs(waited[0][0] - waited[0][1]).max()
    return Claim(
        **told(claim, locals()),
        checks=(
            *_distance_checks(found),
            *_end_checks(found),
            *_curve_checks(curves, effort),
            *_sweep_checks(),
            *checks_in_the_plane(effort),
        ),
        figures=(_distance_figure(), _sweep_figure()),
        equations=(_EQUATION,),
    )


def _distance_checks(found: list[Ends]) -> Checks:
    fastest = max(growth(distances(e.system), 1e-16) for e in found)
    why = "springs and body are exact on the parabolas of a step, so that only rounding can move them apart"
    name = f"largest growth of the distance of two motions over a period, {len(found)} systems"
    yield Check.at_most(name, fastest, ROUNDING, why)
    name = f"undamped body in full slip: change of the distance in {PERIODS} periods, over it"
    D = swinging()
    yield Check.at_most(name, np.ptp(D) / D[0], ROUNDING, "no force sees them differ; rounding")


def _end_checks(found: list[Ends]) -> Checks:
    compared = [e for e in found if len(e.settled) > 1]
    why = "spreads that the runs state of themselves; rounding"
    name = f"largest difference of the COFs of one system over μ_0, less both spreads, {len(compared)} systems"
    damped = [e for e in found if e.system.damping_ratio]
    yield Check.at_most(name, max(e.excess for e in compared), 1e-12, why)
    name = f"starts of {len(damped)} damped systems that did not settle"
    got = sum(len(STARTS) - len(e.settled) for e in damped)
    yield Check(name, got, 0, 0, "a damper of 0.5 % lets a free oscillation die out in some hundred periods")
    name = f"settled motions of {len(damped)} damped systems that do not repeat after one period"
    why = "two motions one period apart merge like any other two; what alternates is followed for four times as long"
    yield Check(name, sum(s.kind != "periodic" for e in damped for s in e.settled), 0, 0, why)


def _curves(effort: str) -> list[tuple[System, list[mdr.SlidingRun]]]:
    """Runs over FASTER velocities: the first on an undamped resonance, the others random and damped."""
    resonant = System("cone", 0.3, 0.0, 2.0, 1.5, 0.0, 1.0)
    systems = [resonant, *(s for s in drawn(3 * CURVES[effort]) if s.damping_ratio)][: CURVES[effort]]
    out = []
    for system in progress(systems, "uniqueness, curves"):
        case = system.case
        v_c = mdr.full_slip_critical_velocity(case)
        v_c = v_c if np.isfinite(v_c) else mdr.critical_velocity(case)
        out.append((system, [mdr.slide(case, v * v_c, n_springs=SPRINGS, steps_per_period=STEPS) for v in FASTER]))
    return out


def _curve_checks(curves: list[tuple[System, list[mdr.SlidingRun]]], effort: str) -> Checks:
    n_settled = sum(run.settled for _, runs in curves for run in runs)
    damped = [run.settled for system, runs in curves if system.damping_ratio for run in runs]
    name = f"largest fall of COF/μ_0 with velocity, less both errors, {n_settled} runs of {len(curves)} systems"
    rng = np.random.default_rng(3)
    drops, names, v_hat = [], tuple(SHAPES), np.sort(np.r_[np.geomspace(1e-3, 1, 60), np.linspace(0.05, 1.2, 60)])
    for _ in range(RIGID[effort]):
        T = float((0.0, 0.03 * 1000 ** rng.uniform())[int(rng.integers(2))])
        case = contact(names[int(rng.integers(4))], float(0.02 * 250 ** rng.uniform()), T)
        cof = average_friction(case, v_hat * mdr.critical_velocity(case)).cof / case.mu_0
        drops.append(np.max(-np.diff(cof)))
    most = max(falls(runs for _, runs in curves))
    yield Check.at_most(name, most, 1e-12, "the errors that the runs state; rounding")
    yield Check(f"settled of the {len(damped)} runs with a damper", sum(damped), len(damped), 0, "transients die out")
    name = f"largest fall in {len(drops)} closed-form curves of rigid pulls"
    yield Check.at_most(name, max(drops), 1e-8, "accuracy of the closed form")


def _sweep_checks() -> Checks:
    short, waited = swept(SHORT), swept(None)
    up, down = waited[0]
    off = np.abs(short[0] - waited[0])
    name = "velocity swept up and down, each run until settled: largest |COF up − down|/μ_0 less spreads"
    got = np.max(np.abs(up - down) - waited[1].sum(axis=0))
    yield Check.at_most(name, got, 1e-12, "spreads that the runs state of themselves")
    yield Check("of these runs settled", float(waited[2].mean()), 1.0, 0.0, "the damper ends every transient")
    name = f"the same with {SHORT} periods at each velocity: largest |COF up − down|/μ_0"
    yield Check.at_least(name, np.abs(short[0][0] - short[0][1]).max(), 0.01, "a loop made of transients")
    name = f"of those runs called settled, but off by more than {TOLERANCE:g} μ_0"
    got = np.sum(short[2] & (off > TOLERANCE))
    yield Check(name, got, 0.0, 0.0, "what settled means: a transient is not taken for an end")


@figure("distance", size=(7.4, 4.4))
def _distance_figure(fig, ax):
    """Distance of two motions over forty periods on a logarithmic axis: falling in four cases, constant for an
    undamped body in full slip.

    Two motions of one contact from random states never move apart. Below v_c stick takes part of their difference in
    every period, with or without a damper; above v_c they slip with the same forces, only a damper sees them differ,
    and without one the free oscillation of the body stays as it is.
    """
    shown = (
        ("damper 1 %, 0.5 $v_c$", System("paraboloid", 0.5, 0.0, 1.7, 1.5, 0.01, 0.5)),
        ("no damper, 0.5 $v_c$", System("paraboloid", 0.5, 0.0, 1.7, 1.5, 0.0, 0.5)),
        (r"no damper, 0.5 $v_c$, $\omega\tau$ = 1", System("cone", 1.5, 1.0, 0.6, 0.7, 0.0, 0.5)),
        ("damper 1 %, 1.5 $v_c$", System("r^4", 0.5, 0.0, 1.3, 1.5, 0.01, 1.5)),
        ("no damper, 1.5 $v_c$", System("r^4", 0.5, 0.0, 1.3, 1.5, 0.0, 1.5)),
    )
    for colour, (label, system) in zip(COLOURS, shown, strict=False):
        D = distances(system)
        ax.semilogy(np.maximum(D / D[0], 1e-18), "o-", ms=3, lw=1.1, color=colour, label=label)
    ax.set(xlabel="periods", ylabel="distance $D$ of two motions, over its start", ylim=(1e-10, 10))
    ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


@figure("sweep", size=(6.8, 4.2))
def _sweep_figure(fig, ax):
    """Coefficient of friction over velocity: two separate branches for short runs, one curve for settled ones.

    A loop that is none: velocity swept up and down on a lightly damped body (paraboloid, elastic, α = 0.5, ω_0 = 0.97
    ω, damper 1 %), each run going on from the state of the last. With {short} periods at each velocity (triangles)
    friction seems to depend on the direction; when each run is awaited (circles and dots) the two ways coincide.
    """
    short, waited, v = swept(SHORT)[0], swept(None)[0], np.array(SWEEP)
    ax.plot(v, short[0], ">-", color=COLOURS[1], lw=1, label=f"up, {SHORT} periods each")
    ax.plot(v, short[1], "<-", color=COLOURS[2], lw=1, label=f"down, {SHORT} periods each")
    ax.plot(v, waited[0], "o", ms=9, mfc="none", color=COLOURS[0], label="up, until settled")
    ax.plot(v, waited[1], ".", color=COLOURS[0], label="down, until settled")
    ax.axvline(1.0, color="0.5", lw=0.9, ls=":")
    ax.set(xlabel="pulling velocity $v_0/v_c$", ylabel=r"coefficient of friction $\mu/\mu_0$")
    ax.legend(loc="lower right")
    return {"short": SHORT}
