"""Small grids, and quantities that other processes can import."""

import os
import time

import numpy as np

import mdr
from mdr.studies.axes import read_axes
from mdr.studies.quantities import read_quantities
from mdr.studies.work import Work

RUBBER = mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-3)
MOTION = mdr.NormalOscillation(u_z0=6e-6, du_z=2e-6, omega=300.0)
RIGID = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), RUBBER, 0.5, MOTION)
BODY = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), RUBBER, 0.5, MOTION, mdr.SpringPull(k_x=2e4, m=0.1, c_x=4.0))
COARSE = {"n_springs": 32, "steps_per_period": 64}  # for runs whose digits do not matter
SHAPES = [mdr.Paraboloid(R=5e-3), mdr.Cone(theta=0.05), mdr.FlatPunch(a=1e-3)]

#: a study of 120 runs, in 20 units of at most 8 velocities
RUNS = {
    "case": BODY,
    "axes": {"v_0/v_c": np.linspace(0.1, 1.2, 12), "pull.m": [0.05, 0.1, 0.2, 0.3, 0.4], "T": [0.1, 1.0]},
    "quantities": ("cof", "v_c"),
    **COARSE,
}

LOG = "MDR_TEST_LOG"  # the file that computed units are written to
LONG = {"oscillation.u_z0": np.linspace(3e-6, 9e-6, 240).tolist()}


def work(case, axes, quantities=("v_c",), **knobs):
    """The work of a study."""
    return Work(case, read_axes(case, axes), read_quantities(quantities, axes), knobs)


def slow_and_logged(case):
    """The depth in µm, after a while, and a line in the log."""
    log = os.open(os.environ[LOG], os.O_WRONLY | os.O_APPEND | os.O_CREAT)
    os.write(log, f"{case.oscillation.u_z0!r}\n".encode())
    os.close(log)
    pause()
    return case.oscillation.u_z0 * 1e6


def pause():
    """What makes it slow."""
    time.sleep(0.005)


def deadly(case):
    """The end of the process that computes it, but at the first points."""
    if case.oscillation.u_z0 > 5e-6:
        os._exit(9)
    return 1.0


def depth(case):
    """The mean depth."""
    return case.oscillation.u_z0


SLOW = mdr.Quantity("depth", "um", slow_and_logged, "mean depth")


def long_study(store):
    """A study that takes a second or two: 240 units of 5 ms."""
    return mdr.sweep(RIGID, LONG, store, quantities=[SLOW], chunk_seconds=0.02)


if __name__ == "__main__":  # python grids.py store
    import sys

    import grids  # so that the quantity is of a module that has a name

    if hasattr(os, "sched_setaffinity"):  # on many cores it would be over before it can be killed
        os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:2])
    grids.long_study(sys.argv[1])
