"""The COF of slide() with default knobs beside the independent twin, by families; march/test_accuracy.py asks.

The twin is converged to 1e-11 under a rigid pull. Under a spring pull it estimates its own error, the doubt; an error
counts by what exceeds the doubt.
"""

import itertools

import reference
from conftest import SHAPES, contact, unit_of_velocity
from tables import turning
from tables.beside import row

import mdr

ALPHAS = (0.03, 0.4, 0.9, 1.7)
V_HATS = (0.05, 0.37, 0.81, 0.97)
TS = (0.3, 1.0, 3.0)
#: k_x/k_xc, omega_0/omega, damping ratio: above resonance, stiff and near it, heavy and below
BODIES = ((0.7, 1.6, 0.07), (3.0, 1.1, 0.1), (0.3, 0.6, 0.05))


def compare(groups, truth, doubt, case, v_hat):
    run = mdr.slide(case, v_hat * unit_of_velocity(case))
    assert run.settled, f"{groups}: {run.why}"
    return row(str(groups), run, truth, doubt)


# --- families -----------------------------------------------------------------------------------------------


def rigid_elastic(shapes=tuple(SHAPES), alphas=ALPHAS, v_hats=V_HATS):
    for shape, alpha, v_hat in itertools.product(shapes, alphas, v_hats):
        truth = reference.rigid_elastic_cof(SHAPES[shape][1], 1 / alpha, v_hat)
        yield compare((shape, alpha, v_hat), truth, 1e-11, contact(shape, 1 / alpha), v_hat)


def rigid_kelvin(shapes=tuple(SHAPES), alphas=ALPHAS, v_hats=V_HATS, Ts=TS):
    for shape, alpha, T, v_hat in itertools.product(shapes, alphas, Ts, v_hats):
        truth = reference.rigid_kelvin_cof(SHAPES[shape][1], 1 / alpha, v_hat, T)
        yield compare((shape, alpha, T, v_hat), truth, 1e-11, contact(shape, 1 / alpha, T), v_hat)


def spring_pull(
    shapes=tuple(SHAPES), alphas=(0.3, 1.2), Ts=(0.0, *TS), bodies=BODIES, shares=(0.2, 0.5, 0.8, 0.97), **knobs
):
    """Mass and damper; shares are of v_c, knobs are those of the twin."""
    for shape, alpha, T, body, share in itertools.product(shapes, alphas, Ts, bodies, shares):
        k, omega_0, zeta = body
        case = contact(shape, 1 / alpha, T, k, omega_0, reference.damping_for(zeta, k, omega_0))
        v_0 = share * mdr.full_slip_critical_velocity(case)
        known = turning.by_twin(shape, case, v_0, **knobs)
        yield compare((shape, alpha, T, body, share), known.along, known.doubt, case, v_0 / unit_of_velocity(case))
