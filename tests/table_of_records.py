"""Thousands of records drawn at random, each asked what its kind can answer: how many answer, refuse and why, or fail.

`python tests/table_of_records.py [n] [first]` draws n records (10 000 by default), seeds first, first + 1, ... on two
processes. A fault is a wrong answer, an error or warning in words that are not the library's own, or more than a minute
of processor time; one prints the record, and `python tests/table_of_records.py 1 <seed>` draws it again.
"""

import os

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # the records are spread over processes; threads would stand in their way

import multiprocessing
import re
import signal
import sys
import time
import traceback
from collections import Counter

import anything
import questions

import mdr
from mdr.tools.progress import Meter

LATE, LATER = 60, 600  #: seconds of processor time for a question, and for a dear one
#: share of the records that are asked
SHARES = (
    dict.fromkeys(questions.QUICK, 1.0)
    | dict.fromkeys((questions.pressed, questions.short_run), 0.15)
    | {questions.coarse_run: 0.2, questions.other_units: 0.02, questions.fine_run: 0.01}
    | {questions.swept: 0.002, questions.fitted: 0.002, questions.measured: 0.001, questions.judged_by_name: 0.0005}
)
FOLLOWED = 0.25  #: the same share, of questions that follow every spring where there is no closed form


def ask(seed):
    """What became of one record: rows of question, outcome, words and seconds."""
    dice, rows = anything.Dice(seed), []
    case = outcome(rows, "record", anything.contact, dice)
    if case is None or outcome(rows, "depth under load", mdr.resolved, case) is None:
        return seed, repr(case), rows
    for number, (question, share) in enumerate(SHARES.items()):
        own = anything.Dice([seed, number])
        if question in (questions.velocities, questions.static) and not case.is_of_the_paper:
            share = FOLLOWED
        if own.rng.random() < share:
            outcome(rows, question.__name__, question, case, own, limit=LATER if share < 0.01 else LATE)
    return seed, repr(case), rows


def outcome(rows, name, call, *args, limit=LATE):
    """The answer, or None, and a row of what became of it."""
    started = time.process_time()
    signal.setitimer(signal.ITIMER_PROF, limit)
    answer = None
    try:
        answer = questions.asked(call, *args)
        kind, words = "answered", answer if isinstance(answer, str) else ""
    except questions.Refused as refusal:
        kind, words = "refused", str(refusal)
    except Exception as error:
        kind, words = "fault", "".join(traceback.format_exception_only(error)) + traceback.format_exc(limit=-4)
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
    rows.append((name, kind, words, time.process_time() - started))
    return answer


def _begin():
    def too_late(number, frame):
        raise TimeoutError("no answer in time")

    signal.signal(signal.SIGPROF, too_late)


def template(words):
    """A refusal without its numbers and the records it prints."""
    words = re.sub(r"\b(F_z = )?\S+ N is more than .* carries", "# N is more than ... carries", words)
    words = re.sub(r"(pressed from rest, ).*?( touches)", r"\1...\2", words)
    names = "|".join((*anything.SHAPES, "Profile"))
    words = re.sub(rf"\b({names})\b(\(.*?\)(?= is| at| flows))?", "...", words)
    return re.sub(r"-?\b\d[\d.]*(e[+-]?\d+)?", "#", words)[:150]


def main(n, first):
    """Print the table; 0 if there was no fault."""
    counts, seconds, reasons, slowest, faults = Counter(), Counter(), Counter(), [], 0
    started = time.perf_counter()
    with multiprocessing.get_context("spawn").Pool(2 if n > 100 else 1, _begin) as pool:
        meter = Meter("records", n)
        for seed, record, rows in pool.imap_unordered(ask, range(first, first + n), 8):
            meter.tick()
            for name, kind, words, spent in rows:
                counts[name, kind, words if kind == "answered" else ""] += 1
                seconds[name] += spent
                slowest.append((spent, name, seed))
                if kind == "refused":
                    reasons[template(words)] += 1
                if kind == "fault":
                    faults += 1
                    print(f"\nfault: seed {seed}, {name}\n{record}\n{words}", flush=True)
            slowest = sorted(slowest, reverse=True)[:10]
    meter.close()
    print(f"{n} records, seeds {first} to {first + n - 1}, in {time.perf_counter() - started:.0f} s")
    print(f"\n{'question':18s} {'outcome':40s} {'count':>7}")
    for (name, kind, words), count in sorted(counts.items()):
        print(f"{name:18s} {f'{kind}: {words}' if words else kind:40s} {count:7d}")
    print("\nrefused because")
    for reason, count in reasons.most_common():
        print(f"{count:7d}  {reason}")
    print("\nseconds of processor time: " + ", ".join(f"{name} {spent:.0f}" for name, spent in seconds.most_common()))
    print("slowest: " + ", ".join(f"{name} of seed {seed} {spent:.1f} s" for spent, name, seed in slowest))
    print(f"faults: {faults}")
    return 1 if faults else 0


if __name__ == "__main__":
    given = [int(text) for text in sys.argv[1:]]
    sys.exit(main(*given, *(10_000, 0)[len(given) :]))
