"""Kill a study again and again, and watch what it computes."""

import os
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from grids import LOG, LONG

import mdr
from mdr.studies.store import Store

HERE = Path(__file__).parent


@dataclass(frozen=True)
class Life:
    """One run of the study, from its start to its end by whatever hand."""

    lasted: float  #: s
    killed: bool  #: or it came to its end
    before: int  #: chunks that were there
    after: int
    computed: int  #: units
    twice: int  #: units of chunks that were there


def live(store, log, lifetime, at_work=True):
    """Run the study in a process of its own, and kill it so long [s] after its first chunk begins, or its start."""
    known, seen = finished_units(store), size(log)
    before, plan = len(Store(store).finished()), store / "chunks" / "plan.json"
    command = [sys.executable, str(HERE / "grids.py"), str(store)]
    start = time.monotonic()
    with subprocess.Popen(command, env={**os.environ, LOG: str(log)}, stderr=subprocess.PIPE) as process:
        while at_work and process.poll() is None and (size(log) == seen or not plan.exists()):
            time.sleep(0.001)
        try:
            process.wait(lifetime)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
        said = process.stderr.read().decode()
    assert process.returncode in (0, -signal.SIGKILL), said
    computed = lines(log)[seen:]
    return Life(
        lasted=time.monotonic() - start,
        killed=process.returncode != 0,
        before=before,
        after=len(Store(store).finished()),
        computed=len(computed),
        twice=len(known & set(computed)),
    )


def finished_units(store):
    """What the log says of the units of finished chunks."""
    cut = Store(store).plan()
    if cut is None:
        return set()
    depths = [f"{depth!r}" for depth in LONG["oscillation.u_z0"]]
    return {depths[unit] for chunk in Store(store).finished() for unit in range(*cut.units(chunk))}


def lines(log):
    """Units in the order in which they were computed."""
    return log.read_text().splitlines() if log.exists() else []


def size(log):
    return len(lines(log))


def same_values(store):
    """Whether a finished store holds what it should."""
    return np.array_equal(mdr.read_study(store)["depth"], np.array(LONG["oscillation.u_z0"]) * 1e6)
