"""Named waveforms: the fall of the depth, no overshoot, the ideal form as harmonics grow."""

import doctest
from functools import partial

import numpy as np
import pytest

from mdr.case import waveforms

PHASE = np.arange(4096) / 4096
MADE = {
    "rising saw": (waveforms.sawtooth, lambda x: 2 * x - 1),
    "falling saw": (partial(waveforms.sawtooth, falling=True), lambda x: 1 - 2 * x),
    "square": (waveforms.square, lambda x: np.where(np.abs(x - 0.5) > 0.25, 1.0, -1.0)),
    "pulse": (partial(waveforms.pulse, width=0.2), lambda x: np.where(np.abs(x - 0.5) > 0.4, 4.0, -1.0)),
}


def test_the_examples_run():
    found = doctest.testmod(waveforms)
    assert found.attempted >= 6
    assert not found.failed


@pytest.mark.parametrize("name", MADE)
@pytest.mark.parametrize("n_harmonics", [1, 2, 7, 64])
def test_the_depth_falls_by_du_z_and_nothing_overshoots(name, n_harmonics):
    make, ideal = MADE[name]
    motion = make(u_z0=20e-6, du_z=5e-6, omega=300.0, n_harmonics=n_harmonics)
    w = (motion.u_z(PHASE * motion.period) - 20e-6) / 5e-6
    assert len(motion.cos) <= n_harmonics
    assert w.mean() == pytest.approx(0, abs=1e-12)
    assert motion.cycle.unit * motion.cycle.least == pytest.approx(-5e-6, rel=1e-12)
    if n_harmonics > 1:
        assert w.max() <= ideal(PHASE).max() + 2 / PHASE.size  # the ideal saw peaks between instants


@pytest.mark.parametrize("name", MADE)
def test_with_more_harmonics_it_is_the_ideal_waveform(name):
    make, ideal = MADE[name]
    off = []
    for n_harmonics in (32, 64, 128):
        motion = make(u_z0=2.0, du_z=1.0, omega=1.0, n_harmonics=n_harmonics)
        off.append(np.mean(np.abs(motion.u_z(PHASE * motion.period) - 2 - ideal(PHASE))))
    assert off[0] > 1.3 * off[1] > 1.69 * off[2]  # a smoothed saw misses its least value by nearly a share of N^(-1/2)
