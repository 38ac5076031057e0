"""Test every claim, write the report, and say by the exit status whether all checks held."""

import argparse
import importlib
import multiprocessing
import os
import sys
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor, as_completed
from pathlib import Path

from validation import Outcome, not_tested, run_claim
from validation.report import text_table, write_report


def main(argv: Sequence[str] | None = None, package: str = "validation") -> int:
    """Test the claims of `package`; 0 if every check held, 1 if not, 2 for wrong arguments."""
    known = importlib.import_module(package).CLAIMS
    args = _arguments(known).parse_args(argv)
    names = [name for name in known if name in (args.only or known)]
    outcomes = {}
    for name, outcome in _progress(run_all(names, args.effort, package, args.jobs), len(names)):
        outcomes[name] = outcome.claim
    claims = [outcomes[name] for name in names]
    page = write_report(claims, args.output, args.effort)
    print(text_table(claims))
    print(f"report: {page}")
    return 0 if all(claim.held for claim in claims) else 1


def run_apart(name: str, effort: str, package: str) -> Outcome:
    """Run one claim in a fresh process, whose death is this claim's alone."""
    begin = time.perf_counter()
    try:
        with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as process:
            return process.submit(run_claim, name, effort, package).result()
    except Exception as error:
        return not_tested(name, error, time.perf_counter() - begin)


def run_all(names: Sequence[str], effort: str, package: str, jobs: int) -> Iterator[tuple[str, Outcome]]:
    """Each claim's name and outcome as it ends; one job runs them in this process, one after the other."""
    if jobs == 1:
        yield from ((name, run_claim(name, effort, package)) for name in names)
        return
    with ThreadPoolExecutor(jobs) as threads:
        running = {threads.submit(run_apart, name, effort, package): name for name in names}
        yield from ((running[done], done.result()) for done in as_completed(running))


def _progress(ended: Iterator[tuple[str, Outcome]], total: int) -> Iterator[tuple[str, Outcome]]:
    """Show a bar on a terminal, and one line per claim either way, both on stderr."""
    from tqdm import tqdm

    with tqdm(total=total, desc="claims", unit="claim", disable=not sys.stderr.isatty()) as bar:
        for name, outcome in ended:
            claim, seconds, trace = outcome
            count = f"{claim.n_held}/{len(claim.checks)} checks held"
            tqdm.write(f"{trace}{name}: {count}, {seconds:.1f} s", file=sys.stderr)
            bar.update()
            yield name, outcome


def _arguments(known: Sequence[str]) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("python -m validation", description=__doc__)
    effort = parser.add_mutually_exclusive_group()
    effort.add_argument(
        "--quick", dest="effort", action="store_const", const="quick", default="full", help="small grids"
    )
    effort.add_argument("--long", dest="effort", action="store_const", const="long", help="large tables too")
    parser.add_argument("-o", "--output", type=Path, default=Path("report"), help="folder (default: report)")
    parser.add_argument("--only", nargs="+", choices=known, metavar="name", help=", ".join(known))
    jobs = min(os.cpu_count() or 1, len(known))
    parser.add_argument("--jobs", type=_positive, default=jobs, metavar="N", help="claims at a time")
    return parser


def _positive(text: str) -> int:
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError(f"must be at least 1, got {value}")
    return value


if __name__ == "__main__":
    sys.exit(main())
