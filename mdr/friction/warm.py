"""Compile ahead what runs of Coulomb's friction need: small ones of every material and pull, still and shaken."""

from __future__ import annotations

import os
import subprocess
import sys
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from functools import partial
from queue import Queue
from threading import Thread

from mdr.case.contact import SlidingContact
from mdr.case.in_plane import InPlaneOscillation
from mdr.case.motion import NormalOscillation
from mdr.case.pull import Pull, RigidPull, SpringPull
from mdr.closed_forms.full_slip_body import full_slip_critical_velocity
from mdr.element.contact_element import ContactElement
from mdr.element.record import slide_record
from mdr.friction.cof_curve import cof_curve
from mdr.indenters.paraboloid import Paraboloid
from mdr.march.result.slide import slide
from mdr.materials import Elastic, KelvinVoigt, Material, Prony
from mdr.normal.indentation import indent
from mdr.tools.beside import cores
from mdr.tools.compiling import unsaid
from mdr.tools.fields import example_of
from mdr.tools.progress import progress, silent

MATERIALS: tuple[Material, ...] = (example_of(Prony), example_of(KelvinVoigt), example_of(Elastic))  # longest first
OTHER = f"import sys; sys.path[:] = {sys.path!r}; from mdr.friction.warm import main; main()"  #: what a process does
BODY, MOTION, ALONG = example_of(SpringPull), example_of(NormalOscillation), example_of(InPlaneOscillation)
ACROSS = replace(ALONG, du_y=ALONG.du_x)
PULLS = (RigidPull(), BODY, replace(BODY, m=0.0))
CASE = SlidingContact(example_of(Paraboloid), MATERIALS[0], 0.5, MOTION)


def compile_all() -> int:
    """Number of kinds of run that are compiled from now on; with progress.

    By one process for each of two cores; they begin at either end of the list, so that they have little in common.
    """
    n = len(kinds_of_run())
    todo = deque(range(n))
    done: Queue[Exception | None] = Queue()
    ends = (todo.popleft, todo.pop)[: cores()]
    for take in ends:
        Thread(target=_compile, args=(take, done.put), daemon=True).start()
    for _ in progress(range(n), "compiling, once on this machine", "kinds of run", alike=False):
        if (fault := done.get()) is not None:
            raise fault
    return n


def _compile(take: Callable[[], int], done: Callable[[Exception | None], None]) -> None:
    """Let another process compile kinds of run, by their numbers, until there are no more."""
    command, env = [sys.executable, "-c", OTHER], {**os.environ, "MDR_COMPILE": "first"}
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=env) as other:
        assert other.stdin is not None
        assert other.stdout is not None
        with suppress(IndexError):
            while True:
                print(take(), file=other.stdin, flush=True)
                if not other.stdout.readline():
                    done(RuntimeError(f"a process that compiles ended with status {other.wait()}"))
                    return
                done(None)


def main() -> None:
    """Compile the kinds of run whose numbers are read, and say of each that it is done."""
    kinds = kinds_of_run()
    with unsaid(), silent(lambda: None):
        for line in sys.stdin:
            kinds[int(line)]()
            print(flush=True)


def kinds_of_run(materials: tuple[Material, ...] = MATERIALS) -> list[Callable[[], object]]:
    """Small runs, each of which compiles what it needs, material by material."""
    others = (_shaken, _shaken_body, _shaken_along, _indent, _record)
    runs: list[Callable[[], object]] = []
    for material in materials:
        runs += [*(partial(_slide, material, pull) for pull in PULLS), *(partial(one, material) for one in others)]
    return runs


def _slide(material: Material, pull: Pull) -> None:
    case = replace(CASE, material=material, pull=pull)
    v_0 = 0.5 * full_slip_critical_velocity(case)
    slide(case, v_0, accuracy=1e-3, record=1)
    slide(case, v_0, n_springs=32, steps_per_period=32, n_periods=16, start="rest")


def _shaken(material: Material) -> None:
    slide(replace(CASE, material=material, shake=ACROSS), 1e-3, n_springs=32, steps_per_period=32)


def _shaken_body(material: Material) -> None:
    slide(replace(CASE, material=material, pull=BODY, shake=ACROSS), 1e-3, accuracy=1e-3)


def _shaken_along(material: Material) -> None:
    cof_curve(replace(CASE, material=material, shake=ALONG), [1e-3], accuracy=1e-3)


def _indent(material: Material) -> None:
    indent(CASE.indenter, material, [0.0, 1.0], F_z=[0.0, 1.0], n_springs=32)


def _record(material: Material) -> None:
    element = ContactElement(CASE.indenter, material, CASE.mu_0, u_z_max=20e-6)
    element.step(element.at_rest(), 1e-3, (0.0, 0.0, 10e-6))
    _ = element.address
    for u_y in (None, [0.0, 1e-6]):
        slide_record(CASE.indenter, material, CASE.mu_0, [0.0, 1.0], [0.0, 1e-6], u_y, u_z=20e-6)
