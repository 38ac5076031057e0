"""Test every claim, write the report, and say by the exit status whether all checks held."""

import argparse
import importlib
import multiprocessing
import os
import signal
import sys
import time
from collections.abc import Generator, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import closing
from dataclasses import replace
from multiprocessing import resource_tracker
from pathlib import Path
from typing import Any

from validation import Outcome, not_tested, send_claim
from validation.kept import Kept
from validation.page import write_report
from validation.page.made import Made
from validation.report import text_table
from validation.written import other_verdicts

os.environ.setdefault("MDR_COMPILE", "first")  # as claims make many runs, on all cores
#: begun first, so that none is alone at the end
LONGEST = ("generalisation", "shear_strength", "coupled", "end_of_stick", "judge", "transverse_slip", "resonances")


def main(argv: Sequence[str] | None = None, package: str = "validation") -> int:
    """Test the claims of `package`; 0 if every check held and docs/claims.md quotes every verdict, 1 if not, 2 for
    wrong arguments, 130 if it was stopped.
    """
    known, begin = importlib.import_module(package).CLAIMS, time.monotonic()
    args = _arguments(known).parse_args(argv)
    names = [name for name in known if name in (args.only or known)]
    kept = Kept(args.output, package, args.effort)
    if args.fresh:
        kept.forget(names)
    outcomes = kept.read(names)
    made = Made(tuple(names), n_kept=len(outcomes))
    if outcomes:
        print(f"{len(outcomes)} of {len(names)} claims are kept from a run that was stopped", file=sys.stderr)

    def written() -> Path:
        """The page of what there is."""
        now = replace(made, seconds=time.monotonic() - begin)
        claims = [outcomes[name].claim for name in names if name in outcomes]
        return write_report(claims, args.output, args.effort, now)

    before = signal.signal(signal.SIGTERM, signal.default_int_handler)  # a kill stops it as Ctrl-C does
    try:
        left = [name for name in names if name not in outcomes]
        with closing(run_all(left, args.effort, package, args.jobs)) as ended:
            for name, outcome in _progress(ended, len(names), len(outcomes)):
                outcomes[name] = outcome
                kept.write(name, outcome)
                written()
    except KeyboardInterrupt:
        where = f"; report: {written()}" if outcomes else ""
        done = f"stopped with {len(outcomes)} of {len(names)} claims done"
        print(f"{done}, from which the same command goes on{where}", file=sys.stderr)
        return 130
    finally:
        signal.signal(signal.SIGTERM, before)
    page = written()
    kept.forget(names)
    claims = [outcomes[name].claim for name in names]
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
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # of the processes: claims share the cores
    order = sorted(names, key=lambda name: LONGEST.index(name) if name in LONGEST else len(LONGEST))
    processes: list[Any] = []
    with ThreadPoolExecutor(jobs, initializer=_hear_no_interrupt) as threads:
        tasks = {threads.submit(_in_a_process, name, effort, package, processes): name for name in order}
        try:
            for task in as_completed(tasks):
                yield tasks[task], task.result()
        finally:
            threads.shutdown(wait=False, cancel_futures=True)
            while not all(task.done() for task in tasks):  # a thread may begin one even now
                for process in processes:
                    process.kill()
                time.sleep(0.01)


def _hear_no_interrupt() -> None:
    """Leave Ctrl-C to the main thread; a process inherits this from the thread that begins it."""
    if hasattr(signal, "pthread_sigmask"):
        resource_tracker.ensure_running()  # would hear interrupts again when begun later
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})


def _in_a_process(name: str, effort: str, package: str, processes: list[Any]) -> Outcome:
    """What a fresh process finds of a claim, or how it died; it is added to the processes."""
    begin, context = time.perf_counter(), _context()
    here, there = context.Pipe(duplex=False)
    process = context.Process(target=send_claim, args=(there, name, effort, package), name=name)
    process.start()
    there.close()  # the process then holds the only one: its death is the end of the pipe
    processes.append(process)
    try:
        outcome: Outcome = here.recv()
    except (EOFError, OSError):
        process.join()
        code = process.exitcode
        how = f"exit code {code}" if code >= 0 else f"signal {signal.Signals(-code).name}"
        error = RuntimeError(f"the process of this claim died with {how}")
        return not_tested(name, error, time.perf_counter() - begin)
    process.join()
    return outcome


def _context() -> Any:
    """Processes begin as copies of one that has imported what all claims share, and done nothing else; where a system
    cannot copy, from nothing.
    """
    if "forkserver" not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context("spawn")
    context = multiprocessing.get_context("forkserver")
    shared = ["mdr.friction.verdict", "validation.cases", "validation.report", "matplotlib.pyplot"]
    context.set_forkserver_preload(shared)
    return context


def _progress(ended: Iterator[tuple[str, Outcome]], total: int, done: int) -> Iterator[tuple[str, Outcome]]:
    """Show a bar on a terminal, and one line per claim either way, both on stderr."""
    from tqdm import tqdm

    with tqdm(total=total, initial=done, desc="claims", unit="claim", disable=not sys.stderr.isatty()) as bar:
        for n, (name, outcome) in enumerate(ended, start=done + 1):
            claim, seconds, trace = outcome
            count = f"{claim.n_held}/{len(claim.checks)} checks held"
            place = f"claim {n} of {total}, " if total > 1 else ""
            tqdm.write(f"{trace}{place}{name}: {count}, {seconds:.1f} s", file=sys.stderr)
            bar.update()
            yield name, outcome


def _arguments(known: Sequence[str]) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("python -m validation", description=__doc__)
    parser.set_defaults(effort="full")
    effort = parser.add_mutually_exclusive_group()
    for name, told in (("quick", "small grids"), ("long", "large tables too")):
        effort.add_argument(f"--{name}", dest="effort", action="store_const", const=name, help=told)
    parser.add_argument("-o", "--output", type=Path, default=Path("report"), help="folder (default: report)")
    parser.add_argument("--only", nargs="+", choices=known, metavar="name", help=", ".join(known))
    fresh = "begin anew, and forget the claims that a stopped run has done"
    parser.add_argument("--fresh", action="store_true", help=fresh)
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
