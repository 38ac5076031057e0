"""What users wait for: a run, a curve, a measurement, a verdict, a study, a fit; and how long, in two checkouts.

`python -m validation.performance --against PATH` starts this file twice, with the `mdr` of either checkout, and asks
both in turn for one task after the other. So it knows public names alone, and no other file of this folder.
"""

import json
import math
import os
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

OMEGA = 300.0  #: rad/s
RADIUS, DEPTH = 1e-3, 2e-5  #: of contact, and mean depth [m]


def _case(shape: str, material: Any, alpha: float, body: tuple[float, float, float] | None) -> Any:
    """A contact of RADIUS at DEPTH; body: k_x/k_xc, omega_0/omega, damping ratio, or None for a rigid pull."""
    import mdr

    indenter = {
        "punch": mdr.FlatPunch(a=RADIUS),
        "cone": mdr.Cone(theta=math.atan(2 * DEPTH / (math.pi * RADIUS))),
        "paraboloid": mdr.Paraboloid(R=RADIUS**2 / DEPTH),
    }[shape]
    pull = mdr.RigidPull()
    if body is not None:
        k, ratio, damping = body
        k_x = k * 2 * material.G_star * RADIUS
        m = k_x / (ratio * OMEGA) ** 2
        pull = mdr.SpringPull(k_x=k_x, m=m, c_x=2 * damping * math.sqrt(k_x * m))
    return mdr.SlidingContact(indenter, material, 0.5, mdr.NormalOscillation(DEPTH, alpha * DEPTH, OMEGA), pull)


def _material(kind: str) -> Any:
    import mdr

    return {
        "elastic": mdr.Elastic(E=3e6, nu=0.5),
        "Kelvin": mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1 / OMEGA),
        "two arms": mdr.Prony(E_inf=3e6, arms=((2e6, 0.3 / OMEGA), (3e6, 2 / OMEGA)), nu=0.5),
    }[kind]


#: shape, material, du_z/u_z0 and body of the standing cases
STANDING: dict[str, tuple[str, str, float, tuple[float, float, float] | None]] = {
    "rigid pull, elastic": ("cone", "elastic", 0.3, None),
    "rigid pull, two arms": ("paraboloid", "two arms", 0.3, None),
    "damped body, elastic": ("paraboloid", "elastic", 0.3, (2.0, 1.6, 0.05)),
    "damped body, Kelvin": ("paraboloid", "Kelvin", 0.3, (2.0, 0.7, 0.05)),
    "undamped body, Kelvin": ("cone", "Kelvin", 0.3, (2.0, 1.6, 0.0)),
    "damped body, two arms": ("punch", "two arms", 0.3, (2.0, 0.7, 0.05)),
}


def _drawn(number: int) -> Any:
    """A random contact, rigid or with a body off resonance."""
    rng = np.random.default_rng(7000 + number)
    shape = str(rng.choice(["punch", "cone", "paraboloid"]))
    kind = str(rng.choice(["elastic", "Kelvin", "two arms"], p=[0.4, 0.4, 0.2]))
    body = None
    if number % 4:
        body = float(rng.uniform(0.3, 3)), float(rng.choice([0.7, 1.3, 1.6, 2.4])), float(rng.choice([0.0, 0.03, 0.1]))
    return _case(shape, _material(kind), float(rng.uniform(0.05, 1.2)), body)


def case_of(name: str) -> Any:
    """A standing case by its name, or a random one by its number."""
    if name.isdigit():
        return _drawn(int(name))
    shape, kind, alpha, body = STANDING[name]
    return _case(shape, _material(kind), alpha, body)


def _study(case: Any, n: int) -> Any:
    import mdr

    axes = {
        "oscillation.du_z": case.oscillation.du_z * np.linspace(0.5, 1, n // 20),
        "v_0/v_c": np.linspace(0.1, 1, 20),
    }
    return mdr.sweep(case, axes)


def _fit(case: Any, scale: float) -> Any:
    import mdr

    v_0 = scale * np.linspace(0.1, 1.1, 12)
    noise = 1 + 1e-3 * np.sin(np.arange(12.0))
    data = mdr.FrictionData(v_0, mdr.cof_curve(case, v_0, n_springs=64, steps_per_period=256).cof * noise)
    begin = mdr.SlidingContact(case.indenter, case.material, 1.1 * case.mu_0, case.oscillation, case.pull)
    start = time.process_time()
    mdr.fit(begin, data, ["mu_0", "du_z"])
    return time.process_time() - start


def seconds_of(task: str, case: Any, v_0: float) -> float:
    """Processor time [s] of a task; `fit` times itself, without its data."""
    import mdr

    start = time.process_time()
    if task == "default run":
        mdr.slide(case, 0.5 * v_0)
    elif task == "curve of 20":
        mdr.cof_curve(case, v_0 * np.linspace(0.05, 1.2, 20))
    elif task == "measurement":
        mdr.measure_critical_velocity(case)
    elif task == "verdict":
        mdr.verdict(case)
    elif task.startswith("study of "):
        _study(case, int(task.split()[2]))
    else:
        return float(_fit(case, v_0))
    return time.process_time() - start


def _serve() -> None:
    """Answer tasks on standard input, one line each, by seconds."""
    import mdr

    print(json.dumps(str(Path(mdr.__file__).parent)), flush=True)
    for line in sys.stdin:
        task, name = json.loads(line)
        case = case_of(name)
        full = mdr.full_slip_critical_velocity(case)
        v_0 = full if math.isfinite(full) else mdr.critical_velocity(case)
        print(json.dumps(seconds_of(task, case, v_0)), flush=True)


class Checkout:
    """A process with the mdr of one checkout."""

    def __init__(self, folder: Path) -> None:
        path = os.pathsep.join([str(folder.resolve()), os.environ.get("PYTHONPATH", "")])
        self.process = subprocess.Popen(
            [sys.executable, __file__],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            env={**os.environ, "PYTHONPATH": path, "OPENBLAS_NUM_THREADS": "1"},
        )
        at = Path(str(self._answer()))
        if at.parent != folder.resolve():
            raise RuntimeError(f"{folder}: holds no mdr; python took that of {at.parent}")

    def _answer(self) -> Any:
        assert self.process.stdout is not None
        line = self.process.stdout.readline()
        if not line:
            raise RuntimeError("the process of a checkout has ended")
        return json.loads(line)

    def seconds(self, task: str, name: str) -> float:
        """Processor time [s] that a task takes there."""
        assert self.process.stdin is not None
        self.process.stdin.write(json.dumps([task, name]) + "\n")
        self.process.stdin.flush()
        return float(self._answer())

    def __enter__(self) -> "Checkout":
        return self

    def __exit__(self, *_: object) -> None:
        self.process.kill()
        self.process.wait()


def alternately(
    here: Path, there: Path, tasks: Sequence[str], names: Sequence[str], repeats: int
) -> Iterator[tuple[str, str, np.ndarray, np.ndarray]]:
    """Task, case, and seconds (repeats,) here and there, taken in turn after one of each that does not count."""
    with Checkout(here) as one, Checkout(there) as other:
        for task in tasks:
            for name in names:
                print(f"{task}: {name}", file=sys.stderr)
                if repeats > 1 or name == names[0]:  # the first one loads compiled code
                    one.seconds(task, name), other.seconds(task, name)
                pairs = [(one.seconds(task, name), other.seconds(task, name)) for _ in range(repeats)]
                ours, theirs = np.array(pairs).T
                yield task, name, ours, theirs


if __name__ == "__main__":
    _serve()
