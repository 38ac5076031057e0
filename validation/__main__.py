"""Test every claim, write the report, and say by the exit status whether all checks held."""

import argparse
import importlib
import multiprocessing
import os
import signal
import sys
import time
from collections import deque
from collections.abc import Generator, Iterator, Sequence
from contextlib import closing, contextmanager
from multiprocessing import connection, resource_tracker
from pathlib import Path
from typing import Any, NamedTuple

from validation import Outcome, not_tested, send_claim
from validation.page import write_report
from validation.report import text_table
from validation.written import other_verdicts

LONGEST = (
    "generalisation",
    "coupled",
    "end_of_stick",
    "judge",
    "transverse_slip",
    "maps",
    "uncoupled",
    "resonances",
)  #: begun first, so that none is alone at the end


def main(argv: Sequence[str] | None = None, package: str = "validation") -> int:
    """Test the claims of `package`; 0 if every check held and docs/claims.md quotes every verdict, 1 if not, 2 for
    wrong arguments, 130 if interrupted.
    """
    known = importlib.import_module(package).CLAIMS
    args = _arguments(known).parse_args(argv)
    names = [name for name in known if name in (args.only or known)]
    try:
        with closing(run_all(names, args.effort, package, args.jobs)) as ended:
            outcomes = dict(_progress(ended, len(names)))
        claims = [outcomes[name].claim for name in names]
        page = write_report(claims, args.output, args.effort)
    except KeyboardInterrupt:
        print("interrupted before the report was complete", file=sys.stderr)
        return 130
    print(text_table(claims))
    print(f"report: {page}")
    other = other_verdicts(claims) if package == "validation" else []
    if other:
        print(f"verdicts other than docs/claims.md quotes (validation.written): {', '.join(other)}", file=sys.stderr)
    return 0 if all(claim.held for claim in claims) and not other else 1


def run_all(names: Sequence[str], effort: str, package: str, jobs: int) -> Generator[tuple[str, Outcome]]:
    """Each claim's name and outcome as it ends, `jobs` at a time, each in a process whose death is its alone.

    Closed early, as at Ctrl-C, it kills what still runs. Should this process be killed, those end by themselves.
    """
    waiting = deque(sorted(names, key=lambda name: LONGEST.index(name) if name in LONGEST else len(LONGEST)))
    running: dict[Any, _Running] = {}
    try:
        while waiting or running:
            while waiting and len(running) < jobs:
                with _interrupts_held():
                    pipe, claim = _start(waiting.popleft(), effort, package)
                    running[pipe] = claim
            for pipe in connection.wait(list(running)):
                claim = running[pipe]
                outcome = _received(pipe, claim)
                del running[pipe]
                yield claim.name, outcome
    finally:
        for claim in running.values():
            claim.process.kill()
        for claim in running.values():
            claim.process.join()


class _Running(NamedTuple):
    name: str
    process: Any
    begin: float


def _start(name: str, effort: str, package: str) -> tuple[Any, _Running]:
    """The end of a pipe at which a claim's outcome will arrive, and the fresh process that tests it."""
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # of the fresh process: claims share the cores
    context = _context()
    here, there = context.Pipe(duplex=False)
    process = context.Process(target=send_claim, args=(there, name, effort, package), name=name)
    process.start()
    there.close()  # the process then holds the only one: its death is the end of the pipe
    return here, _Running(name, process, time.perf_counter())


def _context() -> Any:
    """Processes begin as copies of one that has imported what all claims share, and done nothing else; where a system
    cannot copy, from nothing.
    """
    if "forkserver" not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context("spawn")
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(["mdr", "validation.cases", "validation.report", "matplotlib.pyplot"])
    return context


def _received(pipe: Any, claim: _Running) -> Outcome:
    """What the process of a claim sent, or how it died."""
    try:
        outcome: Outcome = pipe.recv()
    except (EOFError, OSError):
        claim.process.join()
        code = claim.process.exitcode
        how = f"exit code {code}" if code >= 0 else f"signal {signal.Signals(-code).name}"
        error = RuntimeError(f"the process of this claim died with {how}")
        return not_tested(claim.name, error, time.perf_counter() - claim.begin)
    claim.process.join()
    return outcome


@contextmanager
def _interrupts_held() -> Iterator[None]:
    """Let Ctrl-C wait until the process begun here is listed; it and its threads inherit that they do not hear it."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    resource_tracker.ensure_running()  # would end the wait when begun later
    held = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, held)


def _progress(ended: Iterator[tuple[str, Outcome]], total: int) -> Iterator[tuple[str, Outcome]]:
    """Show a bar on a terminal, and one line per claim either way, both on stderr."""
    from tqdm import tqdm

    with tqdm(total=total, desc="claims", unit="claim", disable=not sys.stderr.isatty()) as bar:
        for n, (name, outcome) in enumerate(ended, start=1):
            claim, seconds, trace = outcome
            count = f"{claim.n_held}/{len(claim.checks)} checks held"
            place = f"claim {n} of {total}, " if total > 1 else ""
            tqdm.write(f"{trace}{place}{name}: {count}, {seconds:.1f} s", file=sys.stderr)
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
