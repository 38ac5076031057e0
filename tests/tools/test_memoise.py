"""What is remembered is what would be computed again."""

from dataclasses import dataclass, replace

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


@dataclass
class Loose(mdr.Indenter):
    """A shape that can be written to."""

    R: float

    def profile_1d(self, x):
        return np.asarray(x) ** 2 / self.R


class Dial(mdr.Motion):
    """A motion that can be turned."""

    omega = 300.0

    @property
    def cycle(self):
        return mdr.NormalOscillation(u_z0=20e-6, du_z=8e-6, omega=self.omega).cycle


def test_what_can_be_changed_is_not_remembered_nor_a_case_that_has_it():
    rubber, motion = mdr.Elastic(E=3e6, nu=0.5), mdr.NormalOscillation(20e-6, 8e-6, 300.0)
    turned = mdr.SlidingContact(mdr.Cone(theta=0.1), rubber, 0.5, oscillation=Dial())
    for record in (Loose(5e-3), turned, replace(turned, indenter=mdr.Cone(theta=0.2))):
        function, calls = counted()
        function(record, 1)
        function(record, 1)
        assert len(calls) == 2
    function, calls = counted()
    for case in (replace(turned, oscillation=motion), replace(turned, oscillation=motion)):
        function(case, 1)
    assert len(calls) == 1
