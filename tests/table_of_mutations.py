"""Thousands of files damaged at random: how many still hold a record, how many are refused and for what.

`python tests/table_of_mutations.py [n] [first]` damages n files (10 000 by default), seeds first, first + 1, ...
A fault is any other error than the documented one, a message that names no file or no fault, a record that holds NaN,
or more than ten seconds of processor time. `python tests/table_of_mutations.py 1 <seed>` makes a file again.
"""

import re
import signal
import sys
import tempfile
import time
import traceback
import warnings
from collections import Counter

import damage

from mdr.tools.progress import progress

LATE = 10  #: seconds of processor time
COMMANDS = 0.03  #: share of the cases that the command line is asked about too


def main(n, first):
    """Print the table; 0 if there was no fault."""
    counts, reasons, statuses, slowest, faults = Counter(), Counter(), Counter(), [], 0
    signal.signal(signal.SIGPROF, _too_late)
    damage.files()
    started = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        for seed in progress(range(first, first + n), "files"):
            then = time.process_time()
            signal.setitimer(signal.ITIMER_PROF, LATE)
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("error")
                    kind, path, record, words = damage.one(seed, folder)
                    assert damage.is_sound(record), f"not what was read: {record!r}"
                counts[kind, "refused" if words else "read"] += 1
                reasons.update({_template(line, str(path)) for line in words.splitlines()})
                if kind in ("case", "written case") and seed % round(1 / COMMANDS) == 0:
                    signal.setitimer(signal.ITIMER_PROF, 12 * LATE)
                    statuses[damage.command("velocity", path)] += 1
            except Exception:
                faults += 1
                print(f"\nfault: seed {seed}\n{traceback.format_exc(limit=-5)}", flush=True)
            finally:
                signal.setitimer(signal.ITIMER_PROF, 0)
            slowest = sorted([*slowest, (time.process_time() - then, seed)], reverse=True)[:5]
    print(f"{n} files, seeds {first} to {first + n - 1}, in {time.perf_counter() - started:.0f} s\n")
    for (kind, what), count in sorted(counts.items()):
        print(f"{kind:14s} {what:8s} {count:6d}")
    print("\nrefused because")
    for reason, count in reasons.most_common(60):
        print(f"{count:6d}  {reason}")
    print("\nmdr velocity: " + ", ".join(f"status {one} {count} times" for one, count in sorted(statuses.items())))
    print("slowest: " + ", ".join(f"seed {seed} {spent:.1f} s" for spent, seed in slowest))
    print(f"faults: {faults}")
    return 1 if faults else 0


def _template(line, path):
    """A fault without the file's own words."""
    line = line.removeprefix(path)
    return re.sub(r"'[^']*'|\"[^\"]*\"|-?\d[\w.+-]*", "#", line)[:80]


def _too_late(number, frame):
    raise TimeoutError("no answer in time")


if __name__ == "__main__":
    given = [int(text) for text in sys.argv[1:]]
    sys.exit(main(*given, *(10_000, 0)[len(given) :]))
