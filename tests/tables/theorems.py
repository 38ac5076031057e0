"""What a settled run must obey, asked of random systems: `python tests/tables theorems [n] [first seed]`.

A third of the systems has no damper, a third stands within 1e-2 of a whole multiple of the drive (some of them on it);
loads, arms, amplitudes up to twice the depth, light bodies and heavy ones. No settled run may contradict

* another start: one velocity has one COF;
* the static limit, below which friction never falls, and mu_0, above which it never rises;
* its neighbour in velocity: friction is never less at a higher one;
* its own continuation by ten times as many periods.

Prints what contradicts, how many settled, why the others did not, and how long it took.
"""

import math
import re
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from itertools import combinations
from multiprocessing import get_context

import numpy as np
from conftest import SHAPES

import mdr
from mdr.march.dynamics.stepper import Stepper
from mdr.march.periodic.search import search_from_full_slip
from mdr.march.periodic.steady import MAX_PERIODS, Resolution, at_hand
from mdr.march.periodic.waiting import Waiting
from mdr.tools.progress import progress

OMEGA, U_Z0, MU_0 = 300.0, 2e-5, 0.5
LONGER = 10  #: times the periods of a run, for which it is continued
MOST_WORK = 1e8  #: of it: periods times steps times springs
FASTER = 1.05  #: velocity of the neighbour


@dataclass(frozen=True)
class System:
    """A random contact under a body, and a velocity at which it is pulled."""

    name: str
    case: mdr.SlidingContact
    v_0: float


def drawn(seed: int) -> System:
    """The system of a seed; every third undamped, every third beside a whole multiple."""
    rng = np.random.default_rng([7, seed])
    name = str(rng.choice(list(SHAPES)))
    nu, alpha = float(rng.choice([0.5, 0.3, rng.uniform(0, 0.5)])), float(0.05 * 40 ** rng.uniform())
    times = [float(0.1 * 50 ** rng.uniform()) / OMEGA for _ in range(3)]
    material = [
        lambda: mdr.Elastic(E=3e6, nu=nu),
        lambda: mdr.KelvinVoigt(E=3e6, nu=nu, tau=times[0]),
        lambda: mdr.StandardLinearSolid(E_inf=3e6, E_1=3e6 * 10 ** rng.uniform(-1, 1), tau_1=times[1], nu=nu),
        lambda: mdr.Prony(E_inf=3e6, arms=((1e6, times[1]), (4e6, times[2])), nu=nu, tau=times[0]),
    ][int(rng.choice(4, p=[0.45, 0.35, 0.1, 0.1]))]()
    shape = SHAPES[name][0]
    k_xc = float(shape.stiffness(U_Z0, material.G_star))
    k_x = k_xc * 10 ** rng.uniform(-1, 1)
    near = int(rng.choice([1, 2, 3])) if seed % 3 == 1 else 0
    ratio = 0.3 * 20 ** rng.uniform()  # omega_0/omega: heavy to light
    if near:
        off = float(rng.choice([0.0, 1.0], p=[0.1, 0.9])) * 10 ** rng.uniform(-6, -2)
        ratio = near * (1 + float(rng.choice([-1, 1])) * off)
    m = k_x / (ratio * OMEGA) ** 2 if near or rng.uniform() > 0.07 else 0.0
    zeta = 0.0 if seed % 3 == 0 or rng.uniform() < 0.3 else float(10 ** rng.uniform(-4, -0.5))
    pull = mdr.SpringPull(k_x=k_x, m=m, c_x=2 * zeta * math.sqrt(k_x * m))
    motion = mdr.NormalOscillation(U_Z0, alpha * U_Z0, OMEGA)
    if rng.uniform() < 0.2:
        load = float(shape.force(U_Z0, material.E_star))
        motion = mdr.LoadOscillation(load, load * min(0.45 * alpha, 0.9), OMEGA)
    case = mdr.SlidingContact(shape, material, MU_0, motion, pull)
    full = mdr.full_slip_critical_velocity(case)
    v_0 = float(rng.uniform(0.05, 1.2)) * (full if math.isfinite(full) else mdr.resolved(case).unit_velocity)
    said = f"{seed}: {name}, {type(material).__name__}, nu {nu:.4g}, alpha {alpha:.4g}, omega_0 {ratio:.8g}"
    said += f", k {k_x / k_xc:.4g}, zeta {zeta:.3g}, {type(motion).__name__}, {v_0 / full:.4g} v_c"
    return System(said, case, v_0)


@dataclass(frozen=True)
class Row:
    """What became of one system."""

    name: str
    contradictions: tuple[str, ...]
    settled: int
    reasons: tuple[str, ...]  #: of the runs that did not settle
    seconds: tuple[float, ...]  #: of each run


def row(seed: int) -> Row:
    """Run a system from both starts, a little faster, and on."""
    try:
        system = drawn(seed)
    except ValueError as refusal:
        return Row(f"{seed}: refused", (), 0, (f"refused: {str(refusal)[:60]}",), ())
    case, v_0, told, seconds = system.case, system.v_0, [], []

    def timed(v: float, start: str) -> mdr.SlidingRun:
        begin = time.perf_counter()
        run = mdr.slide(case, v, start=start)
        seconds.append(time.perf_counter() - begin)
        return run

    runs = {
        "full slip": timed(v_0, "full_slip"),
        "rest": timed(v_0, "rest"),
        "faster": timed(FASTER * v_0, "full_slip"),
    }
    ended = {name: run for name, run in runs.items() if run.settled}
    least = mdr.static_cof(case)
    for name, run in ended.items():
        if run.cof < least - run.cof_error - 1e-4 * MU_0:
            told.append(f"{name}: {run.cof:.8g} +- {run.cof_error:.1g} is below the static limit {least:.8g}")
        if run.cof > MU_0 + run.cof_error:
            told.append(f"{name}: {run.cof:.8g} is above mu_0")
    for (first, one), (then, two) in combinations(ended.items(), 2):
        falls, slack = one.cof - two.cof, one.cof_error + two.cof_error
        if falls > slack or (one.v_0 == two.v_0 and -falls > slack):
            cofs = f"{one.cof:.8g} +- {one.cof_error:.1g} and {two.cof:.8g} +- {two.cof_error:.1g}"
            told.append(f"{first}, then {then}: {cofs}")
    told += continued(case, v_0, runs["full slip"])
    reasons = tuple(run.why for run in runs.values() if not run.settled)
    return Row(system.name, tuple(told), len(ended), reasons, tuple(seconds))


def continued(case: mdr.SlidingContact, v_0: float, run: mdr.SlidingRun) -> list[str]:
    """What a settled run says, against the mean of ten times as many periods from there on."""
    if not run.settled:
        return []
    scaled = at_hand(mdr.resolved(case), Resolution(run.n_springs, run.steps_per_period, "full_slip", True))[1]
    stepper = Stepper(scaled, v_0 / scaled.units.speed)
    orbit = search_from_full_slip(stepper) or Waiting(stepper, stepper.full_slip()).wait(MAX_PERIODS["spring"])
    settling = orbit.settling
    if not settling.settled:
        return []
    most = max(1, int(MOST_WORK / (scaled.drive.steps * scaled.springs.gap.size)))
    n = min(max(64, LONGER * stepper.n_periods), most)
    mean = float(stepper.advance(orbit.state, n)[1].cof.mean())
    off = abs(mean - settling.mean)
    return [f"continued: {settling.mean:.8g} +- {settling.spread:.1g}, then {mean:.8g}"] if off > LEEWAY else []


LEEWAY = 2e-6  #: of the COF over mu_0: twice what a run takes for settled, as both means may miss it


def main(n: int = 600, first: int = 0) -> int:
    """Print the table; 0 if nothing contradicts."""
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        waiting = [pool.submit(row, seed) for seed in range(first, first + n)]
        rows = [one.result() for one in progress(waiting, "theorems")]
    seconds = np.array([s for r in rows for s in r.seconds])
    reasons = Counter(re.sub(r"\S*\d\S*", "...", why) for r in rows for why in r.reasons)
    print(f"{n} systems, {seconds.size} runs, {sum(r.settled for r in rows)} settled")
    median, rare = np.quantile(seconds, (0.5, 0.99))
    print(f"seconds a run: median {median:.3g}, 99 % {rare:.3g}, worst {seconds.max():.3g}")
    for why, count in reasons.most_common():
        print(f"  {count} x {why}")
    against = [r for r in rows if r.contradictions]
    print(f"{len(against)} systems contradict")
    for r in against:
        print(f"  {r.name}", *r.contradictions, sep="\n      ")
    for r in sorted(rows, key=lambda r: max(r.seconds, default=0))[-5:]:
        print(f"  {max(r.seconds, default=0):.3g} s: {r.name}")
    return 1 if against else 0
