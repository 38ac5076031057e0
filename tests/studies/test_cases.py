"""Cases of points: every axis sets what it says, groups have their value in the end."""

import re
from dataclasses import replace

import numpy as np
import pytest
from grids import BODY, RIGID
from numpy.testing import assert_allclose

import mdr
from mdr.given.vary import case_at

PARTS = {
    "mu_0": 0.3,
    "indenter": mdr.Cone(theta=0.1),
    "material": mdr.Elastic(E=1e6, nu=0.3),
    "oscillation": mdr.NormalOscillation(1e-6, 2e-6, 30.0),
    "pull": mdr.RigidPull(),
}
FIELDS = ("indenter.R", "material.E", "material.tau", "oscillation.u_z0", "oscillation.omega", "pull.k_x", "pull.m")


def test_parts_are_replaced_and_fields_set():
    for path, value in PARTS.items():
        assert case_at(BODY, {path: value}) == replace(BODY, **{path: value})
    for path in FIELDS:
        slot, field = path.split(".")
        value = 1.25 * getattr(getattr(BODY, slot), field)
        assert case_at(BODY, {path: value}) == replace(BODY, **{slot: replace(getattr(BODY, slot), **{field: value})})


def test_a_field_is_set_in_the_record_of_another_axis():
    case = case_at(BODY, {"indenter.R": 7e-3, "indenter": mdr.Sphere(R=1.0)})
    assert case.indenter == mdr.Sphere(R=7e-3)


def test_groups_have_their_value_in_the_end():
    settings = {
        "omega_0/omega": 1.6, "k_x/k_xc": 0.7, "T": 0.3, "alpha": 0.4,
        "oscillation.omega": 500.0, "oscillation.u_z0": 9e-6, "material.E": 7e6, "indenter.R": 1e-3,
    }  # fmt: skip
    case = case_at(BODY, settings)
    assert_allclose(case.alpha, 0.4, rtol=1e-15)
    assert_allclose(case.T, 0.3, rtol=1e-15)
    assert_allclose(case.pull.k_x / case.k_xc, 0.7, rtol=1e-15)
    assert_allclose(case.pull.omega_0 / case.oscillation.omega, 1.6, rtol=1e-15)
    assert (case.oscillation.omega, case.oscillation.u_z0, case.material.E) == (500.0, 9e-6, 7e6)
    assert case.pull.c_x == BODY.pull.c_x


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"indenter": mdr.Cone(theta=0.1), "indenter.R": 1e-3}, "indenter.R: Cone has no R"),
        ({"pull": mdr.RigidPull(), "pull.m": 0.1}, "pull.m: RigidPull has no m"),
        ({"pull": mdr.RigidPull(), "k_x/k_xc": 1.0}, "k_x/k_xc: RigidPull has no k_x"),
        ({"pull": mdr.RigidPull(), "omega_0/omega": 1.0}, "omega_0/omega: RigidPull has no k_x"),
        ({"material": mdr.Elastic(E=1e6, nu=0.3), "T": 1.0}, "T: Elastic has no tau"),
        ({"oscillation": mdr.LoadOscillation(1, 0.5, 300), "alpha": 0.1}, "alpha: LoadOscillation has no du_z"),
        ({"omega_0/omega": 0.0}, "omega_0/omega must be positive"),
        ({"oscillation.u_z0": -1e-6, "k_x/k_xc": 1.0}, "the contact has no stiffness at its mean depth"),
        ({"oscillation.u_z0": -1.0}, "the indenter never touches"),
        ({"mu_0": -0.1}, "mu_0 must not be negative"),
        ({"T": -0.1}, "tau must not be negative"),
    ],
)
def test_what_cannot_be_built_says_why(settings, words):
    with pytest.raises(ValueError, match=re.escape(words)):
        case_at(BODY, settings)


def test_fields_of_one_record_are_set_together():
    """A depth of -4e-6 with the old amplitude would never touch, nor does one of its fields alone."""
    case = case_at(BODY, {"oscillation.u_z0": -3e-6, "oscillation.du_z": 4e-6})
    assert (case.oscillation.u_z0, case.oscillation.du_z) == (-3e-6, 4e-6)
    motion = case_at(RIGID, {"oscillation.u_z0": -4e-6, "alpha": -1.5, "frequency": 50.0}).oscillation
    assert_allclose([motion.u_z0, motion.du_z, motion.omega], [-4e-6, 6e-6, 100 * np.pi], rtol=1e-15)
