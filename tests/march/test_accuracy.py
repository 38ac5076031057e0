"""slide() with default knobs meets its budget, 1e-5 of cof/mu_0, and its own bound; truth is the independent twin."""

import numpy as np
import pytest
import reference
from conftest import SHAPES, contact, unit_of_velocity
from tables.twin import BODIES, rigid_elastic, rigid_kelvin, spring_pull

import mdr

BUDGET = 1e-5  # the accuracy budget of cof/mu_0 of a march with default knobs


def check(rows):
    assert all(row.error <= BUDGET for row in rows), max(rows, key=lambda row: row.error)
    assert all(row.error <= row.bound for row in rows), max(rows, key=lambda row: row.error / row.bound)
    assert all(row.bound <= 1.0001 * BUDGET for row in rows), max(rows, key=lambda row: row.bound)


def test_rigid_pull_elastic():
    rows = list(rigid_elastic())
    assert len(rows) == 64
    assert min(row.truth for row in rows) < 0.15  # the cases are far from full slip and close to it
    assert max(row.truth for row in rows) > 0.9999
    check(rows)


@pytest.mark.parametrize("T", [0.3, 1.0, 3.0])
def test_rigid_pull_kelvin(T):
    """Small amplitude, contact kept, and contact lost; every shape; slow and near v_c."""
    rows = [
        *rigid_kelvin(alphas=(0.03,), v_hats=(0.37,), Ts=(T,)),
        *rigid_kelvin(alphas=(0.9,), v_hats=(0.05, 0.81), Ts=(T,)),
        *rigid_kelvin(shapes=("flat", "paraboloid"), alphas=(1.7,), v_hats=(0.37, 0.81), Ts=(T,)),
    ]
    check(rows)


@pytest.mark.parametrize(
    ("shape", "alpha", "T", "body"),
    [("flat", 1.2, 0.3, BODIES[0]), ("paraboloid", 0.3, 1.0, BODIES[0]), ("cone", 0.3, 0.0, BODIES[1])],
)
def test_mass_and_spring(shape, alpha, T, body):
    rows = list(spring_pull((shape,), (alpha,), (T,), (body,), (0.3, 0.8), steps=8192))
    assert all(row.doubt < BUDGET for row in rows), rows
    assert all(row.truth < 0.995 for row in rows), "the march must have something to get wrong"
    check(rows)


def test_the_bound_holds_where_two_runs_agree_by_chance():
    rows = list(spring_pull(("flat",), (1.2,), (3.0,), (BODIES[0],), (0.8,), steps=65536))
    assert rows[0].doubt < 5e-7
    check(rows)


@pytest.mark.parametrize("T", [0.0, 1.0])
@pytest.mark.parametrize("shape", ["flat", "paraboloid"])
def test_the_scheme_is_of_third_order_in_the_step(shape, T):
    """Slope of a least-squares line over a factor of 16: single ratios are erratic, as kinks cross the nodes."""
    case = contact(shape, 1 / 0.9, T)
    n = SHAPES[shape][1]
    steps, v_hats = 16 * 2 ** np.arange(5), (0.21, 0.37, 0.63)
    errors = np.zeros(steps.size)
    for v_hat in v_hats:
        truth = (
            reference.rigid_kelvin_cof(n, 1 / 0.9, v_hat, T) if T else reference.rigid_elastic_cof(n, 1 / 0.9, v_hat)
        )
        for i, n_steps in enumerate(steps):
            run = mdr.slide(
                case, v_hat * unit_of_velocity(case), n_springs=3072, steps_per_period=int(n_steps), n_periods=12
            )
            errors[i] += abs(run.cof / case.mu_0 - truth)
    slope = np.polyfit(np.log(steps), np.log(errors), 1)[0]
    # three velocities average out some of the scatter; what is left of it tilts a line over 16 by 0.45 at most
    assert slope < -2.5, errors
    assert errors[-1] < 3e-7


def test_a_wrong_case_is_seen():
    """The comparison can fail: a relaxation time wrong by one per cent is fifty budgets away."""
    truth = reference.rigid_kelvin_cof(2, 3.0, 0.4, 1.01)
    case = contact("paraboloid", 3.0, 1.0)
    run = mdr.slide(case, 0.4 * unit_of_velocity(case))
    assert abs(run.cof / case.mu_0 - truth) > 50 * BUDGET
