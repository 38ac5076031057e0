"""What a point of a study costs, by kind of contact: a default run of a new case, and the part of it in compiled code.

Repeats deceive, as much of a case is remembered: every run here is of another amplitude, depth and velocity.
"""

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
from numba.core.dispatcher import Dispatcher

import mdr
from mdr.march.dynamics.kernel import Kernel
from validation.cases import DEPTH, OMEGA, SHAPES, any_contact, reach

MATERIALS: dict[str, mdr.Material] = {
    "elastic": mdr.Elastic(E=3e6, nu=0.4),
    "Kelvin": mdr.KelvinVoigt(E=3e6, nu=0.4, tau=1e-3),
    "two arms": mdr.Prony(E_inf=3e6, arms=((2e6, 1e-3), (1e6, 2e-2)), nu=0.4),
}
PULLS = "rigid", "body", "light"
SHAKES = "", "shaken along", "shaken across"
N_POINTS = 7  #: of each kind


class Clock:
    """Processor time [s] of the compiled functions of the library that Python calls."""

    def __init__(self) -> None:
        self.seconds = 0.0

    @contextmanager
    def watching(self) -> Iterator[None]:
        """With a timer in the place of every compiled function that is there; what is to run has to be compiled."""
        modules = [module for name, module in sys.modules.items() if name.startswith("mdr.")]
        known = [(of, name, one) for of in modules for name, one in vars(of).items() if isinstance(one, Dispatcher)]
        known += [(Kernel, "__call__", Kernel.__call__)]
        for of, name, one in known:
            setattr(of, name, self._timed(one))
        try:
            yield
        finally:
            for of, name, one in known:
                setattr(of, name, one)

    def _timed(self, function: Any) -> Any:
        def call(*given: Any) -> Any:
            start = time.thread_time()
            try:
                return function(*given)
            finally:
                self.seconds += time.thread_time() - start

        return call


def case_of(material: str, pull: str, shake: str, dice: np.random.Generator) -> mdr.SlidingContact:
    """A case of a kind, at an amplitude and a depth of its own."""
    depth = DEPTH * dice.uniform(0.8, 1.2)
    motion = mdr.NormalOscillation(u_z0=depth, du_z=dice.uniform(0.1, 0.9) * depth, omega=OMEGA)
    case = any_contact(SHAPES["paraboloid"], MATERIALS[material], motion)
    if shake:
        ways = ("du_x",) if shake == "shaken along" else ("du_x", "du_y")
        given = {name: dice.uniform(0.2, 1.0) * reach(case) for name in ways}
        case = replace(case, shake=mdr.InPlaneOscillation(omega=OMEGA, phi_x=dice.uniform(0, 6), **given))
    if pull != "rigid":
        k = 0.6 * case.k_xc
        both = {"k_x": k, "m": k / (0.7 * OMEGA) ** 2 if pull == "body" else 0.0, "c_x": 0.1 * k / OMEGA}
        if shake == "shaken across":
            both |= {"k_y": k, "c_y": both["c_x"]}
        case = replace(case, pull=mdr.SpringPull(**both))
    return case


def costs() -> Iterator[tuple[str, float, float]]:
    """Each kind, processor time [s] of a point, and that in compiled code, medians of N_POINTS."""
    kinds, dice, clock = list(product(MATERIALS, PULLS, SHAKES)), np.random.default_rng(1), Clock()

    def run(kind: tuple[str, str, str]) -> tuple[float, float]:
        case, v = case_of(*kind, dice), dice.uniform(0.2, 0.8)
        start, clock.seconds = time.thread_time(), 0.0
        mdr.slide(case, v * case.unit_velocity, limit_s=30)
        return time.thread_time() - start, clock.seconds

    for _, kind in product(range(2), kinds):
        run(kind)  # compiles what it needs
    with clock.watching():
        for kind in kinds:
            whole, compiled = np.median([run(kind) for _ in range(N_POINTS)], axis=0)
            yield ", ".join(filter(None, kind)), float(whole), float(compiled)
