"""What no settled run may contradict: on numbers, and on random bodies."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from tables import theorems

import mdr
from mdr.march.periodic.theorems import disordered, outside


def test_a_cof_lies_between_the_static_limit_and_mu_0():
    assert outside(0.7, 0.5, 1e-3) == outside(0.4995, 0.5, 1e-3) == outside(1.0005, 0.5, 1e-3) == ""
    assert "below the static limit" in outside(0.49, 0.5, 1e-3)
    assert "below the static limit" in outside(-0.004, 0.0, 1e-3)
    assert "more than the springs can hold" in outside(1.002, 0.5, 1e-3)


def test_friction_that_falls_with_velocity_is_named_at_both_velocities():
    v_0 = np.array([3.0, 1.0, 2.0, 4.0])
    cof, error, settled = np.array([0.7, 0.5, 0.8, 0.9]), np.full(4, 0.01), np.ones(4, dtype=bool)
    assert_array_equal(disordered(v_0, cof, error, settled), [True, False, True, False])
    assert not disordered(v_0, cof, np.full(4, 0.06), settled).any()
    # one that has not settled says nothing, and contradicts nothing
    assert not disordered(v_0, cof, error, np.array([True, True, False, True])).any()


@pytest.mark.parametrize("seed", range(12))
def test_no_settled_run_of_a_random_body_contradicts_a_theorem(seed):
    """Three runs of each: from both starts, and a little faster."""
    row = theorems.row(seed)
    assert row.contradictions == ()
    assert all(row.reasons)
    assert row.settled + len(row.reasons) == 3


@pytest.mark.parametrize("seed", [0, 2, 4, 5, 7])
def test_the_measured_velocity_of_a_random_body_is_where_it_slips_throughout(seed):
    """Or there is none, where settled runs above the full-slip value do not have the full friction."""
    case = mdr.resolved(theorems.drawn(seed).case)
    found, full = mdr.measure_critical_velocity(case), mdr.full_slip_critical_velocity(case)
    if found.kind == "none":
        run = mdr.slide(case, 1.03 * full) if np.isfinite(full) else None
        assert run is None or not run.settled or case.mu_0 - run.cof > run.cof_error
    else:
        assert found.v_c == pytest.approx(full, abs=max(1e-4 * found.v_c, found.high - found.low))
