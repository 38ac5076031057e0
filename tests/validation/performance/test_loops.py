"""The other ways to write the march go the same way; what is timed is the same physics."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr
from mdr.closed_forms.rigid_pull import average_friction
from validation.cases import contact
from validation.performance import __main__ as performance
from validation.performance.loops import Start, built_in_c, cof_by_solve_ivp, compiled, same_state, vectorised

CASES = {"elastic": (0.5, 0.0), "kelvin": (0.5, 1.0), "lost": (1.6, 0.4), "lost, elastic": (1.6, 0.0)}


@pytest.fixture(params=CASES.values(), ids=CASES)
def start(request):
    return Start(contact("paraboloid", *request.param), 203, 256, 0.4)


def test_the_numpy_loop_goes_the_same_way(start):
    assert same_state(vectorised(start, 512), compiled(start, 512))


def test_the_c_loop_goes_the_same_way(start):
    march = built_in_c()
    if march is None:
        pytest.skip("no C compiler")
    assert same_state(march(start, 512), compiled(start, 512))


def test_the_kernel_is_the_one_of_slide(start):
    run = mdr.slide(
        start.case, start.v * start.case.unit_velocity, n_springs=203, steps_per_period=256, n_periods=20, lump=False
    )
    # the run averages over its last periods, when nothing is left of how it began: exp(-2 pi 10/T)
    S = compiled(start, 20 * 256)[1]
    inner = S[19 * 256 :].mean() - 0.5 * (S[-1] - S[19 * 256 - 1]) / 256  # the trapezoidal mean
    inner += start.scaled.T * (S[-1] - S[19 * 256 - 1]) / (2 * np.pi)
    assert_allclose(inner / start.scaled.normal.mean, run.cof / run.mu_0, rtol=1e-9)


def test_the_ode_solver_solves_the_same_law():
    case = contact("paraboloid", 0.5, 1.0)
    exact = average_friction(case, np.array([0.4 * case.unit_velocity])).cof[0] / case.mu_0
    # 64 springs miss 1e-4; a crude tolerance of the solver would miss 1e-3
    assert cof_by_solve_ivp(case, 0.4, 64, 1e-7) == pytest.approx(exact, abs=2e-4)


def test_memory_does_not_grow_with_the_periods():
    rows = performance.memory("elastic", contact("paraboloid", 0.5))
    # 16 bytes a period for its COF and its swing, beside what a part of the march takes
    assert rows[0]["ratio"] < 1.5
