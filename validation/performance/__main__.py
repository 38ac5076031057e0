"""How fast the library is: by kind of contact, over springs, steps and periods, for a digit more; beside a checkout.

    python -m validation.performance [-o folder]
    python -m validation.performance --against PATH [--random 60] [--study 1000]

The second form asks how much faster this checkout is than another one, in what users wait for (waits.py). Quoted are
ratios of times taken in turn in one run, medians with the least and the greatest; absolute times are the machine's.
"""

import argparse
import json
import os
import sys
import time
import tracemalloc
from collections import defaultdict
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

import mdr
from mdr.case.contact import SlidingContact
from mdr.studies.engine import cores
from validation.cases import contact
from validation.performance.points import costs
from validation.performance.waits import STANDING, alternately

N_SPRINGS, STEPS, N_PERIODS = 1000, 1024, 100
V = 0.4  #: pulling velocity over Eq. (1)
REPEATS = 7
ACCURACIES = (1e-3, 1e-5, 1e-7)
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


def summed_up(what: str, ratios: np.ndarray) -> Row:
    """A row: the median of some ratios, with the least and the greatest."""
    return {"what": what, "ratio": float(np.median(ratios)), "least": float(ratios.min()), "most": float(ratios.max())}


def ratio(name: str, slow: np.ndarray, fast: np.ndarray, scale: float = 1.0) -> Row:
    """How many times faster the second is, pair by pair; scale is work of the second over that of the first."""
    return summed_up(name, scale * slow / fast)


def sliding(case: SlidingContact, **knobs: Any) -> Callable[[], mdr.SlidingRun]:
    """A run of exactly so many springs, steps and periods, every spring computed."""
    knobs = {"n_springs": N_SPRINGS, "steps_per_period": STEPS, "n_periods": N_PERIODS, "lump": False} | knobs
    return partial(mdr.slide, case, V * case.unit_velocity, **knobs)


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


def digits(label: str, case: SlidingContact) -> list[Row]:
    """Time of a run for each accuracy asked for, over that of the first."""
    v_0 = 0.6 * mdr.critical_velocity(case)
    seconds = timed({f"{one:g}": partial(mdr.slide, case, v_0, accuracy=one) for one in ACCURACIES}, repeats=3)
    first, *others = seconds
    return [ratio(f"{label}: time to {one} of mu_0 / to {first}", seconds[one], seconds[first]) for one in others]


def points() -> list[Row]:
    """Milliseconds of a point of a study by kind, and the part of compiled code."""
    whats = ((f"{kind}: {1e3 * compiled:.3g} ms of them compiled", whole) for kind, whole, compiled in costs())
    return [{"what": what, "ms": 1e3 * whole} for what, whole in whats]


def tables() -> dict[str, list[Row]]:
    """All tables by their titles; a few minutes."""
    return {
        "milliseconds of a point": points(),
        "scaling": [
            row for label, case in CASES.items() for one in (scaling, threads, memory) for row in one(label, case)
        ],
        "what digits cost": [*digits("rigid pull, Kelvin", CASES["Kelvin, T = 1"]), *digits("body, Kelvin", BODY)],
    }


def against(there: Path, n_random: int, n_study: int) -> dict[str, list[Row]]:
    """How many times faster this checkout answers than another, in processor time, both asked in turn."""
    here, found = Path(__file__).parents[2], defaultdict[str, list[Row]](list)
    tasks = ("default run", "curve of 20", "measurement", "verdict", "fit")
    slow = (f"study of {n_study}",) if n_study else ()
    numbers = [str(i) for i in range(n_random)]
    standing = list(STANDING)
    turns = (tasks[:1], standing, 9), (tasks[1:], standing, 3), (slow, standing, 1), (tasks[:4], numbers, 3)
    for asked, names, repeats in turns:
        for task, name, ours, theirs in alternately(here, there, asked, names, repeats):
            kind = f"{task}, random cases" if name.isdigit() else task
            found[kind].append(ratio(f"{name}: {1e3 * float(np.median(ours)):.3g} ms", theirs, ours))
    ratios = {f"{kind}, {len(rows)} cases": np.array([one["ratio"] for one in rows]) for kind, rows in found.items()}
    return {"medians": [summed_up(what, some) for what, some in ratios.items()], **found}


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
            value = f"{row.get('ratio', row.get('ms')):8.3g}"
            print(f"{value}{spread:22s} {row['what']}")
    if options.output:
        options.output.mkdir(parents=True, exist_ok=True)
        text = json.dumps({"mdr": mdr.__version__, "tables": all_rows}, indent=1)
        (options.output / "performance.json").write_text(text + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
