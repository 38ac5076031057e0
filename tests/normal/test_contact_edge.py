"""The edge of the contact under any depth, the definition as an infimum; and under one cosine, by its twin."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from twins import full_slip as twin
from twins import rigid_pull as reference

from mdr.case.depth_cycle import Cycle
from mdr.normal.contact_edge import ContactEdge
from mdr.normal.kelvin_edges import contact_edge, edge_rate, kept_gap, touching_phase, turning_phase

RELAXATION = [0.0, 1e-6, 1e-3, 0.01, 0.1, 0.5, 1.0, 3.0, 30.0, 100.0]
PHASE = np.linspace(0, 2 * np.pi, 401)


def some_series():
    rng = np.random.default_rng(11)
    for _ in range(24):
        n = rng.integers(2, 7)
        Z = (rng.normal(size=n) + 1j * rng.normal(size=n)) / np.arange(1, n + 1) ** rng.choice([0, 1, 2])
        yield Cycle.series(0.0, 1.0, Z.real, -Z.imag), float(10 ** rng.uniform(-2.5, 1.5))


@pytest.mark.parametrize("T", RELAXATION)
@pytest.mark.parametrize(("n", "shift"), [(1, 1.3), (3, 0.0), (3, -2.0)])
def test_a_cosine_has_the_same_edge_however_written(T, n, shift):
    Z = np.zeros(n, dtype=complex)
    Z[-1] = np.exp(1j * shift)
    edge = ContactEdge.of(Cycle.series(0.0, 1.0, Z.real, -Z.imag), T / n)
    closed = contact_edge(np.mod(n * PHASE + shift, 2 * np.pi), T)
    assert_allclose(edge.gap(PHASE), closed, rtol=0, atol=1e-13 * (1 + T))


def test_the_edge_is_the_least_chord():
    for cycle, T in some_series():
        edge, _ = twin.edge(cycle.harmonics, T, PHASE)
        # a parabola through three flights of the search, 2e-3 apart: 1e-9 of a bend of some N**3 (1 + T)
        assert_allclose(ContactEdge.of(cycle, T).gap(PHASE), edge, rtol=0, atol=1e-7 * (1 + T))


def test_it_is_continuous_and_monotone_in_pieces():
    several = 0
    for cycle, T in some_series():
        edge = ContactEdge.of(cycle, T)
        several += len(edge.pieces) > 4
        for one in edge.pieces:
            gap = edge.gap(np.linspace(one.begin, one.end, 103)[1:-1])
            side = 1 if not np.isnan(one.low) else -1
            assert np.all(side * np.diff(gap) >= -1e-12 * (1 + T))
        before, after = edge.gap(edge.begins - 1e-9), edge.gap(edge.begins + 1e-9)
        assert_allclose(before, after, rtol=0, atol=1e-7 * (1 + T))
    assert several > 6


@pytest.mark.parametrize("T", [0.0, 0.2, 4.0])
def test_a_spring_touches_and_leaves_when_it_is_the_edge(T):
    rng = np.random.default_rng(2)
    for cycle, _ in some_series():
        edge, kept = ContactEdge.of(cycle, T), cycle.kept_gap(lambda n: 1 + 1j * T * n)
        gap = float(rng.uniform(kept, cycle.greatest))
        touches, leaves = edge.crossings(gap)
        assert len(touches) == len(leaves) > 0
        assert_allclose(edge.gap(np.array(touches + leaves)), gap, rtol=0, atol=1e-12 * (1 + T))
        assert np.all(edge.gap(np.array(touches) + 1e-6) > gap)
        assert np.all(edge.gap(np.array(leaves) + 1e-6) < gap)


@pytest.mark.parametrize("T", [0.0, 0.2, 4.0])
def test_a_spring_at_a_turn_of_the_edge_touches_as_often_as_it_leaves(T):
    """Exactly there: a depth of several zeros, as the steepest waveforms have, lost its returns."""
    for cycle, _ in some_series():
        edge = ContactEdge.of(cycle, T)
        for gap in edge.gap(edge.begins)[1:]:
            touches, leaves = edge.crossings(float(gap))
            assert len(touches) == len(leaves)


def test_a_constant_depth_has_a_still_edge():
    assert_allclose(ContactEdge.of(Cycle.constant(1.0), 0.5).gap(PHASE), 0, atol=0)


# --- under one cosine ---


@pytest.mark.parametrize("T", RELAXATION)
def test_contact_edge_against_the_twin(T):
    """A spring is the edge as it touches and as it leaves."""
    h = np.linspace(-1, np.hypot(1, T), 402)[1:-1]
    # near the turn the edge is flat, and a flight is known to rounding over its length
    for phase in reference.contact_times(h, T):
        assert_allclose(contact_edge(phase % (2 * np.pi), T), -h, rtol=0, atol=1e-12 * (1 + T))


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
