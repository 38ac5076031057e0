"""The law of a material: a spring held on a parabola, and one left alone."""

from decimal import Decimal, localcontext
from math import factorial

import numpy as np
import pytest
from numpy.testing import assert_allclose
from rows import MATERIALS
from scipy.linalg import expm

from mdr.spring.law import law_of, phi_of

remembering = pytest.mark.parametrize(
    "material", [MATERIALS[name] for name in MATERIALS if name != "elastic"], ids=list(MATERIALS)[1:]
)


@pytest.mark.parametrize("r", [0.0, 1e-12, 1e-3, 0.3, 1.0, 1.0000001, 3.7, 50.0, 1e6])
def test_phi_by_its_recursion_in_a_hundred_digits(r):
    values = phi_of(r)
    with localcontext() as context:
        context.prec = 100
        one = Decimal(r)
        exact = [(-one).exp()]
        for n in range(1, len(values)):
            exact.append((1 / Decimal(factorial(n - 1)) - exact[-1]) / one if r else 1 / Decimal(factorial(n)))
        assert_allclose(values, [float(value) for value in exact], rtol=5e-14)


def motion(material):
    """Matrix of free motion, (1 + J, 1 + J), and what sheds the force of a state without dashpot."""
    T, rho, theta = material[0], np.array(material[1]), np.array(material[2])
    first = np.concatenate([[1.0], rho]) / -T if T else np.concatenate([[0.0], rho / theta]) / (1 + rho.sum())
    matrix = np.tile(first, (1 + rho.size, 1))
    matrix[1:, 1:] -= np.diag(1 / theta)
    stiffness = np.concatenate([[1.0], rho])
    shed = np.eye(1 + rho.size) - (0 if T else np.outer(np.ones(1 + rho.size), stiffness / stiffness.sum()))
    return matrix, shed


@remembering
@pytest.mark.parametrize("t", [0.0, 0.01, 0.3, 5.0])
def test_a_spring_left_alone_relaxes_as_its_equations_say(material, t):
    mu, out, into = law_of(*material).modes
    matrix, shed = motion(material)
    assert_allclose(out @ np.diag(np.exp(-mu * t)) @ into, expm(t * matrix) @ shed, rtol=0, atol=1e-13)


@remembering
def test_modes_measure_energy(material):
    """Without dashpot, what a state has beside the force that it sheds."""
    mu, out, into = law_of(*material).modes
    moduli, (_, shed) = np.concatenate([[1.0], material[1]]), motion(material)
    x = np.random.default_rng(1).uniform(-1, 1, moduli.size)
    assert_allclose(np.sum((into @ x) ** 2), moduli @ (shed @ x) ** 2, rtol=1e-13)
    assert_allclose(into @ out, np.eye(mu.size), rtol=0, atol=1e-13)
    assert mu.min() > 0


@pytest.mark.parametrize("T", [0.0, 1e-3])
@pytest.mark.parametrize("rho", [np.full(30, 1 / 30), np.full(30, 300.0), np.geomspace(1e-9, 1e3, 30), [1e30, 3e29]])
def test_arms_of_many_decades_do_not_disturb_one_another(T, rho):
    """In each mode the parts of a spring fall at one rate, and carry no force; the last ones are of a fluid."""
    rho, theta = np.array(rho), np.logspace(9, -9, len(rho))
    mu, out, into = law_of(T, tuple(rho), tuple(theta)).modes
    assert_allclose(into @ out, np.eye(mu.size), rtol=0, atol=1e-13)
    for rate, (x, *x_j) in zip(mu, out.T, strict=True):
        force = np.array([x, -T * rate * x, *(rho * x_j)])
        # x' - x_j/theta_j - x_j'
        motion = np.array([-rate * x + 0 * rho, rate * np.array(x_j), -np.array(x_j) / theta])
        for terms in (force, motion):  # beside an arm as weak as 1e-9 a rate is known to 1e-16, a difference to 1e-7
            assert np.all(np.abs(terms.sum(axis=0)) < 1e-6 * np.abs(terms).max(axis=0))
        with localcontext() as context:
            context.prec = 100
            low, high = (secular(Decimal(float(rate * near)), T, rho, theta) for near in (1 - 1e-13, 1 + 1e-13))
            assert low * high < 0


def secular(x, T, rho, theta):
    """L of exp(-x t), over it, in a hundred digits."""
    arms = zip(map(Decimal, rho.tolist()), map(Decimal, theta.tolist()), strict=True)
    return 1 - x * Decimal(T) + sum(modulus * x / (x - 1 / time) for modulus, time in arms)


def test_what_a_material_lacks_is_none():
    assert law_of(0.0)[1:] == (None, None)
    assert law_of(0.5).arms is None
    assert law_of(0.5).modes.mu == [2.0]
