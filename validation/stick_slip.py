"""Stick-slip of a body on a spring, whose friction falls as it is let go, and the vibration that ends it.

Tested here: the limit cycle without vibration (mdr/closed_forms/laws/limit_cycle.py) beside runs; from which vibration
on a body that is pulled from rest no longer sticks and slips (`mdr.find(..., smooth=True)`), up and down and with a
shaken tool, beside `mdr.laws.dither_force`; after how many periods a spring under a rigid pull is let go again, beside
`mdr.laws.falling_friction`.

A flat punch on a Kelvin material, whose contact damps the swing of the body on it.

Symbols: q = k_xc/k_x, zeta damping ratio of the body, v = v_0 k_x/(Delta omega_0), Delta = mu_s F - mu_k F, A force
that the vibration takes off the breakaway.
"""

from itertools import product
from typing import NamedTuple

import numpy as np

import mdr
from mdr import laws
from mdr.given.vary import case_at
from mdr.march.periodic.repeats import COMES_BACK
from mdr.tools.arrays import Array
from mdr.tools.progress import progress
from validation.cases import DEPTH, E
from validation.figures import COLOURS, figure, panel
from validation.report import Check, Checks, Claim, Equation, told
from validation.words import ranged

PUNCH, MU_K, OMEGA_0 = mdr.FlatPunch(1e-3), 0.5, 600.0
SWING = 1.0  #: times that in which the body swings on the contact: relaxation time of this
CYCLES = (
    (1, 0.0, 0.3),
    (10, 0.1, 0.3),
    (1, 0.02, 0.3),
    (10, 0.02, 0.3),
    (100, 0.02, 0.05),
    (100, 0.1, 0.05),
)  #: q, zeta, v
ENDS = ((0.1, 0.3, 1.5), (0.05, 0.5, 1.2), (0.02, 0.3, 1.5), (0.1, 0.1, 1.5), (0.3, 0.2, 2.0))  #: zeta, v, mu_s/mu_k
OVER = (10.0, 20.0)  #: frequency of a vibration over the natural one of the body
SOFT = 1e4  #: k_xc over k_x where a vibration is between the natural frequencies of the body without contact and on it
BESIDE = 0.02  #: of the amplitude that ends stick-slip: how far from it runs are made
LET_GO = tuple(product((0.9, 0.3, 0.1, 0.03), (0.3, 0.8), (1.3, 2.0)))  #: v_0 over that of Eq. (1), alpha, mu_s/mu_k


class Body(NamedTuple):
    """A body on its spring, without its vibration."""

    q: float
    zeta: float
    v: float
    stick: float  #: mu_s/mu_k

    @property
    def elastic(self) -> mdr.Elastic:
        """Of the contact without damping."""
        return mdr.Elastic(E, 0.4)

    @property
    def sliding(self) -> float:
        """mu_k F [N]."""
        return float(MU_K * PUNCH.force(DEPTH, self.elastic.E_star))

    @property
    def pull(self) -> mdr.SpringPull:
        """Spring, mass and damper."""
        k = 2 * self.elastic.G_star * PUNCH.a / self.q
        m = k / OMEGA_0**2
        return mdr.SpringPull(k_x=k, m=m, c_x=2 * self.zeta * m * OMEGA_0)

    @property
    def v_0(self) -> float:
        """Pulling velocity [m/s]."""
        return self.v * (self.stick - 1) * self.sliding * OMEGA_0 / self.pull.k_x

    @property
    def given(self) -> tuple[float, ...]:
        """What the laws take: velocity, breakaway, sliding, k_x, m, c_x."""
        pull = self.pull
        return self.v_0, self.stick * self.sliding, self.sliding, pull.k_x, pull.m, pull.c_x

    def shaken(self, motion: mdr.NormalOscillation, **more: object) -> mdr.SlidingContact:
        """The case under a motion."""
        friction = mdr.StaticKinetic(self.stick * MU_K, MU_K)
        return mdr.SlidingContact(PUNCH, oscillation=motion, pull=self.pull, friction=friction, **more)

    def dithered(self, along: bool, over: float, size: float) -> mdr.SlidingContact:
        """The case under a vibration of `over` times OMEGA_0 that takes so much of the breakaway off it."""
        omega = over * OMEGA_0
        rubber = mdr.KelvinVoigt(E, 0.4, SWING / (OMEGA_0 * np.sqrt(self.q)))
        if not along:
            return self.shaken(mdr.NormalOscillation(DEPTH, size * DEPTH, omega), material=rubber)
        pull, force = self.pull, size * self.stick * self.sliding
        du_x = force * abs(1 / (self.q * pull.k_x) - 1 / (pull.m * omega**2))
        return self.shaken(mdr.ConstantDepth(DEPTH), material=rubber, shake=mdr.InPlaneOscillation(omega, du_x=du_x))


class End(NamedTuple):
    """Where a vibration ends stick-slip, of a body whose spring has a ten-thousandth of k_xc."""

    zeta: float
    v: float
    stick: float
    along: bool
    over: float
    law: float  #: A over the breakaway
    found: float  #: the same from runs
    confirmed: bool  #: whether runs below stick and slip, and runs above do not
    speed: float  #: greatest velocity of the vibration there, over that of the body without it

    @property
    def where(self) -> str:
        """The case in words."""
        way = "shaken tool" if self.along else "up and down"
        return f"{way}, ζ = {self.zeta:g}, v = {self.v:g}, μ_s/μ_k = {self.stick:g}"

    @property
    def excess(self) -> float:
        """What runs need more than the law."""
        return self.found - self.law


def end_of(zeta: float, v: float, stick: float, along: bool, over: float) -> End:
    """Where the runs have the end of stick-slip."""
    body = Body(SOFT, zeta, v, stick)
    law = laws.dither_force(*body.given) / body.given[1]
    case = body.dithered(along, over, law)
    path, now = ("shake.du_x", case.shake.du_x) if along else ("oscillation.du_z", case.oscillation.du_z)
    found = mdr.find(case, path, v_0=body.v_0, smooth=True, within=(0.7 * now, 3.5 * now))
    value = found.values[-1] if found.values else np.nan
    beside = [_sticks(case_at(case, {path: by * value}), body.v_0) for by in (1 - BESIDE, 1 + BESIDE) if found.values]
    speed = over * OMEGA_0 * value / laws.stick_slip(*body.given).speed
    return End(zeta, v, stick, along, over, law, law * value / now, beside == [True, False], speed)


def _sticks(case: mdr.SlidingContact, v_0: float) -> bool:
    """Whether the body is slower than half of the pull in some period of a record."""
    n = round(12 * 2 * np.pi / OMEGA_0 / case.period)
    run = mdr.slide(case, v_0, start="rest", n_periods=4 * n, record=n)
    return bool(np.diff(run.u_x.reshape(n, -1)[:, -1]).min() < 0.5 * v_0 * case.period)


class Cycle(NamedTuple):
    """A run without vibration beside its law, over it less one."""

    where: str
    period: float
    mean_force: float
    rest: float


def cycle(q: float, zeta: float, v: float, steps: int) -> Cycle:
    """A run in the period of the law, next to no vibration."""
    body = Body(q, zeta, v, 1.5)
    law, v_0 = laws.stick_slip(*body.given, k_xc=q * body.pull.k_x), body.v_0
    case = body.shaken(mdr.NormalOscillation(DEPTH, 1e-7 * DEPTH, 2 * np.pi / law.period), material=body.elastic)
    run = mdr.slide(case, v_0, start="rest", n_springs=16, steps_per_period=steps, n_periods=200, record=4)
    stretch = (v_0 * run.t - run.u_x).reshape(4, -1)
    rate = np.gradient(stretch[0], run.t[1] - run.t[0])
    k = np.argmin(rate)  # the farther it is where the body is fastest, the longer a period
    off = (stretch[3] - stretch[0])[k] / rate[k] / (3 * law.period)
    where = f"k_xc = {q:g} k_x, ζ = {zeta:g}, v = {v:g}"
    return Cycle(where, off, run.mean_F_x / law.mean_force - 1, run.stick_share / law.rest - 1)


class LetGo(NamedTuple):
    """A punch under a rigid pull: after how many periods its state comes back, by a run and by the law; None: later
    than a run looks for.
    """

    run: int | None
    law: int | None


def let_go(v: float, alpha: float, stick: float) -> LetGo:
    """A run at v times the velocity of Eq. (1) with mu_k."""
    motion, friction = mdr.NormalOscillation(DEPTH, alpha * DEPTH, OMEGA_0), mdr.StaticKinetic(stick * MU_K, MU_K)
    case = mdr.SlidingContact(PUNCH, mdr.Elastic(E, 0.4), oscillation=motion, friction=friction)
    run = mdr.slide(case, v * case.unit_velocity, n_springs=32, steps_per_period=256)
    law = laws.falling_friction(v, alpha, stick).periods
    return LetGo(run.periods, law if law <= COMES_BACK else None)


def claim(effort: str) -> Claim:
    """Dither ends stick-slip once the force that breaks loose is down to that in motion

    How: Seek the least vibration without stick-slip by runs from rest, and set the laws beside.

    Range: A flat punch with μ_s/μ_k {sticks} on a damped Kelvin contact, k_x = k_xc/10000,
    ζ {zetas}; vibration of 10 and 20 times ω_0, {ways}; {n_cycles} limit cycles without
    vibration; {n_let_go} elastic punches under a rigid pull.

    Measured: Without vibration runs have the limit cycle of the law, event by event, to {worst_cycle:.0e}. A stiff
    elastic contact is none that does not yield: the body swings on it as it comes to stand, and is let go early unless
    that dies out. A vibration takes a force A off the breakaway, and stick-slip ends as the drop of friction that is
    left, Δ − A, is what the damper ends at this velocity. Runs need more, the less the faster the vibration: at 20 ω_0
    {of_20:.3f} of the breakaway more at most, at 10 ω_0 {of_10:.3f}. {along} Under a rigid pull a punch is let go after
    1 to {most_periods} periods, as many as the law has in {agree} of {n_let_go}; more than 12 are not looked for.

    Verdict: holds if dither is fast for the body and slow for it on a damped contact

    Sentence: Stick-slip ends once vibration takes A = μ_s F − μ_k F − v_0 √(k_x m)/V(ζ) off the breakaway, or, at 20
    ω_0, {of_20:.2f} of it more. Without it runs have the limit cycle of the law.
    """
    quick = effort == "quick"
    ways = "up and down" if quick else "up and down, and of the tool along the slide"
    bodies = {False: ENDS[: 1 if quick else None], True: ENDS[: 0 if quick else 2]}
    chosen = [(*one, along, over) for along, some in bodies.items() for one in some for over in OVER]
    ends = [end_of(*one) for one in progress(chosen, "stick_slip")]
    cycles = [cycle(*one, 2048 if quick else 8192) for one in CYCLES[: 2 if quick else None]]
    times = [let_go(*one) for one in LET_GO[:: 2 if quick else 1]]
    slow, fast = ([end for end in ends if end.over == over] for over in OVER)
    of_10, of_20 = (max(end.excess for end in some) for some in (slow, fast))
    zetas, sticks = (ranged(one[k] for one in chosen) for k in (0, 2))
    n_cycles, n_let_go, agree = len(cycles), len(times), sum(one.run == one.law for one in times)
    most_periods, worst_cycle = max(one.law or 0 for one in times), max(max(map(abs, one[1:])) for one in cycles)
    swift = max((end.speed for end in ends if end.along), default=np.nan)
    along = "" if quick else f"The velocity of a shaken tool is then {swift:.2f} of that of a jump at most."
    return Claim(
        **told(claim, locals()),
        checks=(*_cycle_checks(cycles, quick), *_end_checks(slow, fast), *_period_checks(times)),
        figures=(_figure(*_map(7 if quick else 14)),),
        equations=_EQUATIONS,
    )


_EQUATIONS = (
    Equation(
        "dither",
        r"A = \mu_s F - \mu_k F - \frac{v_0 \sqrt{k_x m}}{V(\zeta)}, \quad V = \max_t \frac{c'}{1 + 2\zeta c' - s'}",
        "The force that a fast vibration has to take off the breakaway; c, s free oscillations of the body from y = 1"
        " and from y' = 1, time in 1/ω_0 (<code>mdr.laws.dither_force</code>).",
    ),
)


# --- checks ---


def _cycle_checks(cycles: list[Cycle], quick: bool) -> Checks:
    tolerance, why = (3e-6, "2048 steps") if quick else (1e-6, "8192 steps of a period, and a vibration of 1e-7")
    for one in cycles:
        for name in ("period", "mean_force", "rest"):
            words = {"period": "period", "mean_force": "mean friction", "rest": "share of the time at rest"}[name]
            yield Check(
                f"limit cycle, {words} over the law less 1: {one.where}", getattr(one, name), 0.0, tolerance, why
            )


def _end_checks(slow: list[End], fast: list[End]) -> Checks:
    why = "stick-slip that ends by 2 % of the amplitude is seen by runs beside it"
    for end in (*slow, *fast):
        yield Check(
            f"runs below stick and slip, those above do not: {end.where}, {end.over:g} ω_0", end.confirmed, 1, 0, why
        )
    for one, two in zip(slow, fast, strict=True):
        name = f"force above the law over the breakaway, at 20 ω_0 over that at 10 ω_0: {one.where}"
        yield Check.between(name, two.excess / one.excess, 0.0, 0.5, "what runs need more falls at least like ω_0/ω")
        if two.along:
            name = f"velocity of the shake over that of a jump: {two.where}"
            yield Check.at_most(name, two.speed, 0.5, "the shake need not be as fast as a jump")


def _period_checks(times: list[LetGo]) -> Checks:
    name = f"of {len(times)} punches under a rigid pull: states of as many periods as the law has, or none of up to 12"
    yield Check(name, sum(one.run == one.law for one in times), len(times), 0, "whole numbers")


# --- figure ---


def _map(n: int) -> tuple[Array, Array, Array, float]:
    """Least velocity over v_0 over sizes (n,) and frequencies (n,), and the law."""
    body = Body(SOFT, *ENDS[0])
    sizes, over = np.linspace(0.02, 0.5, n), np.geomspace(4, 40, n)
    least = [
        [mdr.least_velocity(body.dithered(False, o, size), body.v_0) / body.v_0 for o in over]
        for size in progress(sizes.tolist(), "stick_slip")
    ]
    return over, sizes, np.array(least), laws.dither_force(*body.given) / body.given[1]


@figure("map", size=(6.4, 4.4))
def _figure(fig, ax, over: Array, sizes: Array, least: Array, law: float):
    """Map of the least velocity over frequency and amplitude: dark below a line that falls to the law.

    A body that is pulled from rest while its load vibrates up and down: its least velocity, averaged over a period of
    the vibration, over that of the pull. Dark: it sticks and slips. Bright: it slides. Dashed: the law of a fast
    vibration; dotted: 1 − μ_k/μ_s.
    """
    mesh = ax.pcolormesh(over, sizes, least, vmin=0, vmax=1, cmap="viridis", rasterized=True)
    fig.colorbar(mesh, label="least velocity over $v_0$")
    ax.axhline(law, color=COLOURS[1], ls="--")
    ax.axhline(1 - 1 / ENDS[0][2], color="w", ls=":")
    panel(ax, r"frequency $\omega/\omega_0$", r"amplitude $\Delta F_z/F_z$", log="x")
    ax.set_xticks([4, 10, 20, 40], ["4", "10", "20", "40"], minor=False)
    ax.set_xticks([], minor=True)
