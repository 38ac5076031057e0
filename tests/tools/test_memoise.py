"""What is remembered is what would be computed again."""

from dataclasses import dataclass

import numpy as np

import mdr
from mdr.tools.memoise import remembered


def counted():
    calls = []

    @remembered(maxsize=4)
    def function(shape, n):
        calls.append((shape, n))
        return n

    return function, calls


def test_equal_records_are_computed_once():
    function, calls = counted()
    for _ in range(3):
        assert function(mdr.Cone(theta=0.1), 2) == 2
    function(mdr.Cone(theta=0.2), 2)
    function(mdr.Cone(theta=0.2), 3)
    assert len(calls) == 3


def test_a_profile_is_remembered_for_itself_alone():
    function, calls = counted()
    profiles = [mdr.Profile(np.square) for _ in range(2)]
    assert profiles[0] == profiles[1]
    for profile in [*profiles, *profiles]:
        function(profile, 1)
    assert len(calls) == 2


def test_a_shape_that_can_be_written_to_is_not_remembered():
    @dataclass
    class Loose(mdr.Indenter):
        R: float

        def profile_1d(self, x):
            return np.asarray(x) ** 2 / self.R

    function, calls = counted()
    shape = Loose(5e-3)
    function(shape, 1)
    function(shape, 1)
    assert len(calls) == 2


class Dial(mdr.Motion):
    """A motion that can be turned."""

    omega, depth = 300.0, 20e-6

    @property
    def cycle(self):
        return mdr.NormalOscillation(u_z0=self.depth, du_z=8e-6, omega=self.omega).cycle


def test_a_motion_that_can_be_changed_is_asked_anew():
    dial = Dial()
    case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5), 0.5, oscillation=dial)
    knobs = {"n_springs": 32, "steps_per_period": 64, "n_periods": 2}
    before = mdr.slide(case, 1e-4, **knobs).cof
    dial.depth = 10e-6
    fixed = mdr.NormalOscillation(u_z0=10e-6, du_z=8e-6, omega=300.0)
    expected = mdr.slide(mdr.SlidingContact(case.indenter, case.material, 0.5, oscillation=fixed), 1e-4, **knobs).cof
    assert mdr.slide(case, 1e-4, **knobs).cof == expected != before
