"""How fast the march is: against other ways to write it, against what the machine could do, and how it scales.

    python -m validation.performance [-o folder]
    python -m validation.performance --against PATH [--random 60] [--study 1000]

The second form asks how much faster this checkout is than another one, in what users wait for (waits.py).

Quoted are ratios of times taken in turn in one run, medians with the least and the greatest; absolute times are the
machine's. Before any time is taken, the marches that are compared must end in the same state.

What the loop must do, per spring and step (mdr/march/kernels.py), in doubles:

| springs              | load         | store | operations | divisions |
| -------------------- | ------------ | ----- | ---------- | --------- |
| elastic, pressed     | e, gap, w    | e     | 7          | 0         |
| elastic, at the edge | e, gap, w    | e     | 13         | 0         |
| elastic, free        |              |       | 0          | 0         |
| Kelvin, pressed      | e, s, gap, w | e, s  | 38         | 1         |
| Kelvin, free         | e, s, w      | e, s  | 3          | 0         |

Where stick may end within the step, an elastic spring takes a dozen operations more, and springs that touch or let go
some dozens; neither is in the account, so that the elastic kernel stays behind its least time. An operation is an add,
multiply, multiply-add, minimum, maximum, comparison or choice, each one instruction on a whole vector. The others,
those at the edge, are a few dozen in any step, whatever the number of springs. The least time is the greatest of three,
as loads and stores, operations and divisions go on side by side; `floors` measures what this machine takes for each, on
arrays of the same size, by three loops that do nothing else. Beside it stands what every step costs however few the
springs are. On two cores with vectors of four doubles, otherwise idle, the kernels came to 0.5 (elastic) and 1.0
(Kelvin) of the speed that this least time allows, 0.7 and 1.2 with what a step costs, and to 1.8 and 1.0 of the C
loop's. slide() as a whole went 310 and 97 times as fast as the NumPy loop, 1.6 and 1.0 times as the C loop; two threads
did 1.9 times as much as one; a spring-step cost the same from 1000 to 20 000 springs within 20 %.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
import tracemalloc
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numba import njit

import mdr
from mdr.case.contact import SlidingContact
from mdr.closed_forms.rigid_pull import average_friction
from mdr.studies.engine import cores
from validation.cases import contact
from validation.performance.loops import March, Start, built_in_c, cof_by_solve_ivp, compiled, same_state, vectorised
from validation.performance.waits import STANDING, alternately

N_SPRINGS, STEPS, N_PERIODS = 1000, 1024, 100
V = 0.4  #: pulling velocity over Eq. (1)
REPEATS = 7
OPERATIONS = 22  #: of the loop that measures what one takes
TARGETS = (1e-3, 1e-5, 1e-7)  #: error of cof/mu_0
CASES = {"elastic": contact("paraboloid", 0.5), "Kelvin, T = 1": contact("paraboloid", 0.5, 1.0)}
BODY = contact("paraboloid", 0.1, 1.0, k_ratio=2.0, omega_0_ratio=0.7)

Row = dict[str, Any]


def timed(functions: dict[str, Callable[[], Any]], repeats: int = REPEATS) -> dict[str, np.ndarray]:
    """Seconds (repeats,) of each function, all in turn, after one call of each that does not count."""
    for function in functions.values():
        function()
    seconds: dict[str, list[float]] = {name: [] for name in functions}
    for _ in range(repeats):
        for name, function in functions.items():
            start = time.perf_counter()
            function()
            seconds[name].append(time.perf_counter() - start)
    return {name: np.array(values) for name, values in seconds.items()}


def ratio(name: str, slow: np.ndarray, fast: np.ndarray, scale: float = 1.0) -> Row:
    """A row: how many times faster the second is, pair by pair; scale is work of the second over that of the first."""
    pairs = scale * slow / fast
    return {"what": name, "ratio": float(np.median(pairs)), "least": float(pairs.min()), "most": float(pairs.max())}


def sliding(case: SlidingContact, **knobs: Any) -> Callable[[], mdr.SlidingRun]:
    """A run of exactly so many springs, steps and periods, every spring computed."""
    knobs = {"n_springs": N_SPRINGS, "steps_per_period": STEPS, "n_periods": N_PERIODS, "lump": False} | knobs
    return partial(mdr.slide, case, V * case.unit_velocity, **knobs)


# --- against other ways to write it ---


def against_loops(label: str, case: SlidingContact) -> list[Row]:
    """slide() and its kernel against the NumPy loop and the C loop, in spring-steps per second."""
    start = Start(case, N_SPRINGS, STEPS, V)
    in_c = built_in_c()
    others: dict[str, March] = {"NumPy loop": vectorised, **({"C loop": in_c} if in_c else {})}
    mine = compiled(start, STEPS)
    for name, march in others.items():
        if not same_state(march(start, STEPS), mine):
            raise RuntimeError(f"{label}: the {name} and the compiled march do not end in the same state")
    n = {"NumPy loop": STEPS}
    seconds = timed(
        {name: partial(march, start, n.get(name, N_PERIODS * STEPS)) for name, march in others.items()}
        | {"kernel": partial(compiled, start, N_PERIODS * STEPS), "slide": sliding(case)}
    )
    rows = []
    for name in others:
        work = N_PERIODS * STEPS / n.get(name, N_PERIODS * STEPS)
        rows += [ratio(f"{label}: {one} / {name}", seconds[name], seconds[one], work) for one in ("slide", "kernel")]
    if in_c is None:
        rows.append({"what": f"{label}: no C compiler (cc, gcc, clang) on this machine, so no C loop"})
    return rows


def against_solve_ivp() -> list[Row]:
    """The time to a COF within 1e-5, by march and by solve_ivp, Kelvin springs under a rigid pull."""
    case, n_springs, target = CASES["Kelvin, T = 1"], 400, 1e-5
    exact = float(average_friction(case, np.array([V * case.unit_velocity])).cof[0]) / case.mu_0
    mine = partial(mdr.slide, case, V * case.unit_velocity, n_springs=n_springs, n_periods=4, lump=False)
    steps = next(
        n for n in (128, 256, 512, 1024, 2048) if abs(mine(steps_per_period=n).cof / case.mu_0 - exact) <= target
    )
    rtol = next(
        tol for tol in 10.0 ** -np.arange(3.0, 12.0) if abs(cof_by_solve_ivp(case, V, n_springs, tol) - exact) <= target
    )
    seconds = timed({
        "solver": partial(cof_by_solve_ivp, case, V, n_springs, rtol),
        "slide": partial(mine, steps_per_period=steps),
    }, repeats=3)  # fmt: skip
    return [
        ratio(f"Kelvin: slide ({steps} steps) / solve_ivp (rtol {rtol:.0e})", seconds["solver"], seconds["slide"])
        | {"error": target}
    ]


# --- against the machine ---

_fast = njit(nogil=True, error_model="numpy", fastmath={"reassoc", "contract"})


@_fast
def _streams(a: Any, b: Any, c: Any, d: Any, p: Any, q: Any, n_loads: int, n_stores: int, repeats: int) -> float:
    """Nothing but the loads and stores of a step: 3 and 1, 4 and 2, or 3 and 2."""
    total = 0.0
    for _ in range(repeats):
        if n_stores == 1:
            for i in range(p.size):
                p[i] = a[i] + b[i]
                total += c[i]
        elif n_loads == 3:
            for i in range(p.size):
                p[i], q[i] = a[i], b[i]
                total += c[i]
        else:
            for i in range(p.size):
                p[i], q[i] = a[i] + c[i], b[i]
                total += d[i]
        total *= 1e-9
    return total


@_fast
def _operations(a: Any, p: Any, repeats: int) -> None:
    """OPERATIONS multiply-adds and adds per element, most of them independent of each other."""
    for r in range(repeats):
        x = 1e-3 * r
        for i in range(a.size):
            y = a[i]
            b, c, d, e = y * x + 0.1, y * x + 0.2, y * x + 0.3, y * x + 0.4
            f, g, h, k = y * x + 0.5, y * x + 0.6, y * x + 0.7, y * x + 0.8
            b, c, d, e = b * y + 0.1, c * y + 0.2, d * y + 0.3, e * y + 0.4
            f, g, h, k = f * y + 0.5, g * y + 0.6, h * y + 0.7, k * y + 0.8
            b, c, d, e = b * c + d, d * e + b, f * g + h, h * k + f
            p[i] = (b * c + d) * e + b


@_fast
def _divisions(a: Any, b: Any, p: Any, repeats: int) -> None:
    """One division per element."""
    for r in range(repeats):
        x = 1.0 + r
        for i in range(a.size):
            p[i] = (a[i] + x) / b[i]


ACCOUNT = {  # loads, stores, operations, divisions of a pressed and of a free spring, as in the docstring
    "elastic": ((3, 1, 7, 0), (0, 0, 0, 0)),
    "Kelvin, T = 1": ((4, 2, 38, 1), (3, 2, 3, 0)),
}


def floors(label: str, case: SlidingContact) -> list[Row]:
    """How near the kernel comes to the least time that its loads, operations and divisions take on this machine."""
    start, few = (Start(case, n, STEPS, V) for n in (N_SPRINGS, 16))
    share = float(np.mean(start.normal[1][0])) / N_SPRINGS
    many, rng = 2000, np.random.default_rng(1)
    a, b, c, d, p, q = rng.uniform(1, 2, (6, N_SPRINGS))
    whole = {"kernel": partial(compiled, start, 10 * STEPS), "16 springs": partial(compiled, few, 10 * STEPS)}
    loops: dict[str, Callable[[], Any]] = {
        "operation": partial(_operations, a, p, many),
        "division": partial(_divisions, a, b, p, many),
    }
    for loads, stores in {account[:2] for account in ACCOUNT[label] if account[0]}:
        loops[f"{loads} + {stores}"] = partial(_streams, a, b, c, d, p, q, loads, stores, many)
    seconds = timed(whole | loops)
    per = {name: float(np.median(seconds[name])) / (N_SPRINGS * many) for name in loops}
    per["operation"] /= OPERATIONS
    kernel, overhead = (float(np.median(seconds[name])) / (10 * STEPS) for name in whole)
    least, bound = 0.0, []
    for (loads, stores, operations, divisions), part in zip(ACCOUNT[label], (share, 1 - share), strict=True):
        times = {
            "loads and stores": per.get(f"{loads} + {stores}", 0.0),
            "operations": operations * per["operation"],
            "divisions": divisions * per["division"],
        }
        bound.append(max(times, key=lambda name: times[name]))
        least += part * N_SPRINGS * max(times.values())
    what = f"{label}: least time by {bound[0]} (pressed springs, {share:.0%} of all) / kernel"
    with_step = f"{label}: the same with what a step costs with 16 springs / kernel"
    return [{"what": what, "ratio": least / kernel}, {"what": with_step, "ratio": (least + overhead) / kernel}]


# --- scaling ---


def scaling(label: str, case: SlidingContact) -> list[Row]:
    """Cost per spring-step over springs, steps and periods, each over that of N_SPRINGS, STEPS and N_PERIODS."""
    variants = [
        *({"n_springs": n} for n in (200, 5000, 20_000)),
        *({"steps_per_period": n} for n in (256, 4096)),
        *({"n_periods": n} for n in (10, 1000)),
    ]
    rows = []
    for knobs in variants:
        here = {"n_springs": N_SPRINGS, "steps_per_period": STEPS, "n_periods": N_PERIODS} | knobs
        work = np.prod(list(here.values())) / (N_SPRINGS * STEPS * N_PERIODS)
        seconds = timed({"this": sliding(case, **knobs), "usual": sliding(case)}, repeats=3)
        what = ", ".join(f"{value} {name.removeprefix('n_').replace('_', ' ')}" for name, value in knobs.items())
        rows.append(ratio(f"{label}: cost per spring-step, {what}", seconds["this"], seconds["usual"], 1 / work))
    return rows


def memory(label: str, case: SlidingContact) -> list[Row]:
    """Peak memory of a run that records nothing, over the periods it takes."""
    peaks = []
    for n_periods in (2000, 40_000):
        run = sliding(case, n_springs=100, steps_per_period=128, n_periods=n_periods)
        run()
        tracemalloc.start()
        run()
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    return [{"what": f"{label}: peak memory of 40 000 periods / of 2000", "ratio": peaks[1] / peaks[0]}]


def threads(label: str, case: SlidingContact) -> list[Row]:
    """Eight runs, four times as long, by two threads against one."""
    run = sliding(case, n_periods=4 * N_PERIODS)

    def by(n: int) -> None:
        with ThreadPoolExecutor(n) as pool:
            list(pool.map(lambda _: run(), range(8)))

    seconds = timed({"one": partial(by, 1), "two": partial(by, 2)})
    return [ratio(f"{label}: two threads / one", seconds["one"], seconds["two"])]


def time_to(label: str, case: SlidingContact) -> list[Row]:
    """Time of the coarsest run whose COF is within each target at three velocities, over that of the first target.

    Springs and steps are doubled together from 16 and 64; the reference is the closed form of a rigid pull, or a run
    finer by four than the last.
    """
    v_c = mdr.critical_velocity(case)
    velocities = (0.3 * v_c, 0.6 * v_c, 0.9 * v_c)
    ladder = [{"n_springs": 32 * 2**k, "steps_per_period": 64 * 2**k} for k in range(8)]

    def cofs(knobs: dict[str, int]) -> np.ndarray:
        return np.array([mdr.slide(case, v, **knobs).cof for v in velocities]) / case.mu_0

    if isinstance(case.pull, mdr.RigidPull):
        exact = average_friction(case, np.array(velocities)).cof / case.mu_0
    else:
        exact = cofs({"n_springs": 8192, "steps_per_period": 16_384})
    found: list[tuple[float, dict[str, int]]] = []
    for knobs in ladder:
        error = float(np.abs(cofs(knobs) - exact).max())
        found += [(target, knobs) for target in TARGETS[len(found) :] if error <= target]
        if len(found) == len(TARGETS):
            break
    seconds = timed({str(target): partial(cofs, knobs) for target, knobs in found}, repeats=3)
    first = seconds[str(TARGETS[0])]
    return [
        ratio(f"{label}: time to {target:g} ({knobs['n_springs']} springs, {knobs['steps_per_period']} steps) / to "
              f"{TARGETS[0]:g}", seconds[str(target)], first)
        for target, knobs in found[1:]
    ]  # fmt: skip


def tables() -> dict[str, list[Row]]:
    """All tables by their titles; a minute or two."""
    kelvin = CASES["Kelvin, T = 1"]
    return {
        f"{N_SPRINGS} springs, {STEPS} steps, {N_PERIODS} periods, rigid pull, lump=False, spring-steps a second": [
            row for label, case in CASES.items() for row in against_loops(label, case)
        ],
        "an ODE solver, at equal accuracy": against_solve_ivp(),
        "the least time this machine could take": [
            row for label, case in CASES.items() for row in floors(label, case)
        ],
        "scaling": [
            row
            for label, case in CASES.items()
            for one in (scaling, threads, memory)
            for row in one(label, case)
        ],
        "what digits cost": [*time_to("rigid pull, Kelvin", kelvin), *time_to("body, Kelvin", BODY)],
    }  # fmt: skip


def against(there: Path, n_random: int, n_study: int) -> dict[str, list[Row]]:
    """How many times faster this checkout answers than another, in processor time, both asked in turn."""
    here = Path(__file__).parents[2]

    def say(what: str) -> None:
        print(what, file=sys.stderr)

    tasks = ("default run", "curve of 20", "measurement", "verdict", "fit")
    slow = (f"study of {n_study}",) if n_study else ()
    numbers = [str(i) for i in range(n_random)]
    found: dict[str, list[Row]] = {"medians": []}
    standing = list(STANDING)
    turns = (tasks[:1], standing, 9), (tasks[1:], standing, 3), (slow, standing, 1), (tasks[:4], numbers, 3)
    for asked, names, repeats in turns:
        for task, name, ours, theirs in alternately(here, there, asked, names, repeats, say):
            kind = f"{task}, random cases" if name.isdigit() else task
            row = ratio(f"{name}: {1e3 * float(np.median(ours)):.3g} ms", theirs, ours)
            found.setdefault(kind, []).append(row)
    for kind, rows in found.items():
        if kind != "medians":
            ratios = np.array([row["ratio"] for row in rows])
            spread = {"least": float(ratios.min()), "most": float(ratios.max())}
            found["medians"].append(
                {"what": f"{kind}, {ratios.size} cases", "ratio": float(np.median(ratios)), **spread}
            )
    return found


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the tables; with -o write performance.json too."""
    parser = argparse.ArgumentParser(prog="python -m validation.performance", description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", type=Path, help="folder for performance.json")
    parser.add_argument("--against", type=Path, metavar="PATH", help="another checkout, to be timed beside this one")
    parser.add_argument("--random", type=int, default=0, metavar="N", help="random cases too, with --against")
    parser.add_argument("--study", type=int, default=0, metavar="N", help="a study of N points too, with --against")
    options = parser.parse_args(arguments)
    print(f"{cores()} cores, load before: {', '.join(f'{load:.2f}' for load in os.getloadavg())}")
    all_rows = against(options.against, options.random, options.study) if options.against else tables()
    for title, rows in all_rows.items():
        print(f"\n{title}")
        for row in rows:
            spread = f"   ({row['least']:.3g} ... {row['most']:.3g})" if "least" in row else ""
            value = f"{row['ratio']:8.3g}" if "ratio" in row else " " * 8
            print(f"{value}{spread:22s} {row['what']}")
    if options.output:
        options.output.mkdir(parents=True, exist_ok=True)
        text = json.dumps({"mdr": mdr.__version__, "tables": all_rows}, indent=1)
        (options.output / "performance.json").write_text(text + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
