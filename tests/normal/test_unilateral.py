"""When springs under one cosine leave and touch again: the root of the twin, and the ends of the period."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from twins import rigid_pull as reference

from mdr.normal.kelvin_edges import contact_edge, edge_rate, kept_gap, leaving_phase, touching_phase, turning_phase

RELAXATION = [0.0, 1e-6, 1e-3, 0.01, 0.1, 0.5, 1.0, 3.0, 30.0, 100.0]


@pytest.mark.parametrize("T", RELAXATION)
def test_contact_edge_against_the_twin(T):
    """A spring is the edge as it touches and as it leaves."""
    h = np.linspace(-1, np.hypot(1, T), 402)[1:-1]
    # near the turn the edge is flat, and a flight is known to rounding over its length
    for phase in reference.contact_times(h, T):
        assert_allclose(contact_edge(phase % (2 * np.pi), T), -h, rtol=0, atol=1e-12 * (1 + T))


@pytest.mark.parametrize("T", RELAXATION)
def test_a_spring_leaves_when_it_is_the_edge(T):
    phase = np.linspace(0.01, turning_phase(T) - 0.01, 60)  # at both ends a phase is the root of a rounded gap
    assert_allclose(leaving_phase(contact_edge(phase, T), T), phase, rtol=0, atol=1e-12)


@pytest.mark.parametrize("T", RELAXATION)
def test_rate_of_the_touching_edge(T):
    phase, step = np.linspace(turning_phase(T) + 0.05, 2 * np.pi - 0.05, 60), 1e-4
    ahead, behind = contact_edge(phase + step, T), contact_edge(phase - step, T)
    # central difference: a third derivative of some (1 + T) / min(T, 1)**3 close to the turn, and rounding
    assert_allclose(
        edge_rate(phase, contact_edge(phase, T), T), (ahead - behind) / (2 * step), rtol=1e-5, atol=1e-7 * (1 + T)
    )


@pytest.mark.parametrize("T", RELAXATION)
def test_the_ends_of_the_period(T):
    assert_allclose(contact_edge(np.array([0.0, 2 * np.pi]), T), 1, rtol=0, atol=1e-12 * (1 + T))
    assert_allclose(contact_edge(np.array([turning_phase(T)]), T), kept_gap(T), rtol=1e-12)
    assert touching_phase(kept_gap(T), T) == pytest.approx(turning_phase(T), abs=1e-7)
    assert touching_phase(1.0, T) == pytest.approx(2 * np.pi, abs=1e-7)
