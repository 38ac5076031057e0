"""The periodic normal motion of a row of springs."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from rows import MATERIALS

from mdr.materials.operator import Rheology
from mdr.spring.law import law_of
from mdr.spring.settle import period, settled

every_material = pytest.mark.parametrize("material", MATERIALS.values(), ids=MATERIALS)
SLOW = {"slow": (0.0, (1.5,), (1e5,)), "stiff and slow": (0.13, (1300.0, 480.0), (54.0, 0.038))}
GAP = np.array([-3.0, -0.9, -0.2, 0.4, 0.95, 1 - 1e-5, 1.3])
W = np.full(GAP.size, 1 / GAP.size)


def depth(n):
    """One harmonic and its rate, (n + 1,)."""
    t = 2 * np.pi * np.arange(n + 1) / n
    return np.cos(t), -np.sin(t)


@pytest.mark.parametrize("material", [*MATERIALS.values(), *SLOW.values()], ids=[*MATERIALS, *SLOW])
def test_it_comes_back_after_a_period(material):
    law, z = law_of(*material), depth(64)
    found = settled(GAP, W, *z, law, each=True)
    known = np.array([found.area, found.moment, found.end, found.compression, found.flight])
    s, again = found.s.copy(), np.empty_like(known)
    none = np.empty((0, GAP.size))
    period(s, GAP, W, *z, *law, again, none, none)
    assert_allclose(s, found.s, rtol=0, atol=1e-12 * np.abs(found.s).max())
    assert_allclose(again, known, rtol=0, atol=1e-11 * np.abs(known).max())
    pressed = found.pressed_for > 0
    assert np.all(found.force[~pressed] == 0)
    assert np.all(found.force >= 0)
    assert pressed[:, 0].any()
    assert not pressed[:, -1].any()


@pytest.mark.parametrize("material", [*MATERIALS.values(), SLOW["slow"]], ids=[*MATERIALS, "slow"])
def test_springs_that_keep_contact_answer_with_the_dynamic_modulus(material):
    gap, w, n = np.array([-200.0, -300.0]), np.array([0.3, 0.7]), 256
    found, t = settled(gap, w, *depth(n), law_of(*material), each=True), 2 * np.pi * np.arange(n + 1) / n
    response = complex(Rheology(*material).response(1.0))
    exact = (response * np.exp(1j * t)).real - w @ gap
    assert_allclose(found.mean, -w @ gap, rtol=1e-12)
    h = t[1]  # parabolas that meet at the nodes have the right rates to h**2, and the right area to h**4
    assert_allclose(found.force @ w, exact[1:], rtol=0, atol=abs(response) * h**2 / 12)
    areas = (response / 1j * np.diff(np.exp(1j * t))).real - w @ gap * h
    assert_allclose(found.area, areas, rtol=0, atol=abs(response) * h**4 / 12)
    assert np.all(found.pressed_for == 1)


def test_stiff_arms_that_hardly_relax_have_their_mean_at_zero():
    """The change of an arm over a period, divided by what it forgets, is its distance from there."""
    law, z = law_of(0.0, (80.0, 20.0, 60.0, 30.0, 50.0), (1e6, 2e5, 4e4, 1e3, 6e2)), depth(64)
    gap, w, none = np.linspace(-0.9, 0.99, 40), np.ones(40), np.empty((0, 40))
    found = settled(gap, w, *z, law).s
    s = found.copy()
    period(s, gap, w, *z, *law, np.empty((5, 64)), none, none)
    off = (s - found)[1:] / -np.expm1(-2 * np.pi * law.arms.rate)[:, None]
    assert np.abs(off).max() < 5e-8  # a change of 1e-13 of s in a period is none: 3e-8 of the slowest arm


@pytest.mark.parametrize("gap", [-0.3, 0.6])
def test_an_elastic_spring_presses_while_the_indenter_is_below_it(gap):
    exact = (np.sin(np.arccos(gap)) - gap * np.arccos(gap)) / np.pi
    errors = [abs(settled(np.array([gap]), np.ones(1), *depth(n), law_of(0.0)).mean - exact) for n in (64, 256)]
    assert errors[1] < 1e-9
    assert errors[1] < errors[0] / 60  # fourth order is 256, at times by chance less
