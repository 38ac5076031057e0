"""Results compare and hash by value, survive pickling, and cannot be written to."""

import pickle

import numpy as np
import pytest
from conftest import contact, unit_of_velocity

import mdr
from mdr.closed_forms.rigid_pull import average_friction

CASE = contact("cone", 2.0)
V_0 = 0.5 * unit_of_velocity(CASE)
BAND = mdr.Spectrum.band(rms=2e-6, f_low=50.0, f_high=100.0)
MAKE = {
    "run": lambda v: mdr.slide(CASE, v, n_springs=32, steps_per_period=64, n_periods=8, record=1),
    "curve": lambda v: mdr.cof_curve(CASE, [0.0, v]),
    "friction": lambda v: average_friction(CASE, [v]),
    "springs": lambda v: mdr.SpringArray.of(CASE, 16 + int(v / V_0)),
    "random": lambda v: mdr.random_cof(CASE, BAND, [v], n_realisations=8),
    "half-space": lambda v: mdr.half_space.slide(CASE, v, cells=9, steps_per_period=12, n_periods=1),
}


@pytest.mark.parametrize("kind", MAKE)
def test_equal_by_value(kind):
    one, two, other = MAKE[kind](V_0), MAKE[kind](V_0), MAKE[kind](1.5 * V_0 if kind != "springs" else 3 * V_0)
    assert one == two
    assert hash(one) == hash(two)
    assert one != other
    again = pickle.loads(pickle.dumps(one))
    assert again == one
    assert hash(again) == hash(one)
    assert len({one, two, other, again}) == 2


def test_arrays_are_read_only():
    run = MAKE["run"](V_0)
    for array in (run.F_x, run.state, mdr.SpringArray.of(CASE).gap):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0


def test_arrays_of_other_shape_or_kind_differ():
    run = MAKE["run"](V_0)
    bare = mdr.slide(CASE, V_0, n_springs=32, steps_per_period=64, n_periods=8)
    assert run != bare  # None against arrays
    assert bare.cof == run.cof
    assert isinstance(run.F_x, np.ndarray)


def test_an_array_that_somebody_gave_stays_his():
    v_0 = V_0 * np.array([0.0, 1.0])
    curve = mdr.cof_curve(CASE, v_0)
    v_0[0] = V_0
    assert curve.v_0[0] == 0
    with pytest.raises(ValueError, match="read-only"):
        pickle.loads(pickle.dumps(curve)).cof[...] = 0
