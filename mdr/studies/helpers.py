"""Processes that help to compute a study, as Python lets only one thread of a process go on at a time.

A helper is this Python with `main` as its script, so that nothing of the user's own script is run again. It reads
pickles from its standard input, at first that of the work, then those of ranges of units, and answers each on its
standard output; it ends where its input does, also if the process that asked is gone.
"""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import warnings
from contextlib import suppress
from io import BytesIO
from threading import Event, Thread
from typing import IO, Any

from mdr.studies.points import Points, compute
from mdr.studies.work import Work
from mdr.tools.compiler import MODE

CUT_OFF = (EOFError, pickle.UnpicklingError)  #: where a pipe ends before a pickle, or within
ONE_THREAD = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
COMPILES = "never" if MODE == "never" else "first"  #: as a helper has many points to compute, and takes its core
KNOWN = {"mdr", "numpy", "builtins"}  #: packages that are the same in every process


class Lost(RuntimeError):
    """A helper ended in the middle of its work."""


class Helper:
    """A process that computes units of a work, for one thread of this one."""

    def __init__(self, work: Work, ended: Event) -> None:
        self.ended = ended
        script = f"import sys; sys.path[:] = {sys.path!r}; from mdr.studies import helpers; helpers.main()"
        command, env = [sys.executable, "-c", script], {**os.environ, **ONE_THREAD, "MDR_COMPILE": COMPILES}
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=env)
        Thread(target=self._end_with, daemon=True).start()
        self.ready = self._ask(work) is True

    def _end_with(self) -> None:
        """End the process as soon as the study has been ended; one that has ended by itself is left alone."""
        self.ended.wait()
        self.process.kill()

    def compute(self, units: range) -> Points:
        """The points of some units. Raises what computing them raised, or Lost."""
        answer = self._ask(units)
        if isinstance(answer, BaseException):
            raise answer
        assert isinstance(answer, Points)
        return answer

    def _ask(self, what: Any) -> Any:
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        try:
            send(self.process.stdin, what)
            return pickle.load(self.process.stdout)
        except Exception as error:  # the pipe is cut off, or something printed stands where the answer is read
            self.process.kill()
            raise Lost(f"a process that helped ended with status {self.process.wait()}") from error

    def close(self) -> None:
        """Let it go."""
        self.process.kill()
        self.process.wait()
        for pipe in (self.process.stdin, self.process.stdout):
            assert pipe is not None
            with suppress(BrokenPipeError):  # of what was not sent
                pipe.close()


class _Packages(pickle.Unpickler):
    """Notes the packages that a pickle needs."""

    def __init__(self, pickled: bytes) -> None:
        super().__init__(BytesIO(pickled))
        self.packages: set[str] = set()

    def find_class(self, module: str, name: str) -> Any:
        """What has this name."""
        self.packages.add(module.partition(".")[0])
        return super().find_class(module, name)


def helper_for(work: Work, ended: Event) -> Helper | None:
    """A helper; None where there can be none, or it might compute something else: a module of the user's may have been
    changed since it was imported, as by a number that a quantity takes.
    """
    if not sys.executable or getattr(sys, "frozen", False):
        return None
    try:
        needs = _Packages(pickle.dumps(work))
        needs.load()
        if not needs.packages <= KNOWN:
            return None
        helper = Helper(work, ended)
    except (pickle.PicklingError, AttributeError, TypeError, OSError, Lost):
        return None
    if helper.ready:
        return helper
    helper.close()
    return None


def send(pipe: IO[bytes], what: Any) -> None:
    """Write a pickle, which tells by itself where it ends; nothing is written of what cannot be pickled."""
    pipe.write(pickle.dumps(what))
    pipe.flush()


def main() -> None:
    """What a helper does."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the process that asks
    warnings.simplefilter("ignore")  # that one warns, of points that it computes
    asked, answers = sys.stdin.buffer, os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what is printed
    try:
        work = pickle.load(asked)
    except CUT_OFF:
        return
    except Exception as error:  # it cannot be read here
        send(answers, error)
        return
    send(answers, True)
    while True:
        try:
            units = pickle.load(asked)
        except CUT_OFF:
            return
        try:
            answer: Any = compute(work, units)
        except Exception as error:
            answer = error
        try:
            pickle.loads(pickle.dumps(answer))
        except Exception:  # an error that cannot be sent
            answer = RuntimeError(f"{type(answer).__name__}: {answer}")
        try:
            send(answers, answer)
        except BrokenPipeError:  # the process that asked is gone, and what is left in the pipe with it
            os._exit(0)
