"""The law of a material: a spring held on a parabola, and one left alone."""

from decimal import Decimal, localcontext
from math import factorial

import numpy as np
import pytest
from numpy.testing import assert_allclose
from rows import MATERIALS
from scipy.linalg import expm

from mdr.spring.law import N_PHI, fill_phi, law_of

remembering = pytest.mark.parametrize(
    "material", [MATERIALS[name] for name in MATERIALS if name != "elastic"], ids=list(MATERIALS)[1:]
)


@pytest.mark.parametrize("r", [0.0, 1e-12, 1e-3, 0.3, 1.0, 1.0000001, 3.7, 50.0, 1e6])
def test_phi_by_its_recursion_in_a_hundred_digits(r):
    values = np.empty(N_PHI)
    fill_phi(r, values)
    with localcontext() as context:
        context.prec = 100
        one = Decimal(r)
        exact = [(-one).exp()]
        for n in range(1, N_PHI):
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


def test_what_a_material_lacks_is_none():
    assert law_of(0.0)[1:] == (None, None)
    assert law_of(0.5).arms is None
    assert law_of(0.5).modes.mu == [2.0]
