"""Marches as the kernels do them, and kernels of which the fixed points are known."""

import numpy as np
from numba import njit

from mdr.march.dynamics.kernel import HEAD, N_T, N_WAYS, Kernel, N, new_trace, trace_of
from mdr.march.dynamics.state import MarchState
from mdr.march.periodic.period_map import PeriodMap
from mdr.march.periodic.shooting import Shooting


def marched(scaled, v, n_periods):
    """State and trace after so many periods at v from full slip along a line, and whether every step was solved."""
    (kernel, block), n_steps = scaled.in_numbers, n_periods * scaled.drive.steps
    state = MarchState.of(scaled.normal.s, scaled.normal.s, scaled.full_slip.state(v))
    flat = new_trace(block, n_periods)
    solved = kernel(block, v, state.x, state.s, n_steps, flat)
    return state, trace_of(flat, n_steps, None), solved


@njit
def trimmed(block, v, x, s, n_steps, trace):
    """x becomes A x + b, of which beyond an edge half of the first part is taken back; all at the end of the block."""
    n = x.size
    A, b, edge = block[-n * n - n - 1 : -n - 1].reshape((n, n)), block[-n - 1 : -1], block[-1]
    image = b.copy()
    for i in range(n):
        for j in range(n):
            image[i] += A[i, j] * x[j]
    image[0] -= 0.5 * max(image[0] - edge, 0.0)
    x[:] = image
    trace[:] = 0.0
    return True


def fixed_point(A, b, x, edge=np.inf, close=1e-10):
    """What the search of the march makes of such a map at rest, where no spring is late and no friction brings a state
    back; it knows that it moves slowly in the first two parts of x.
    """
    n_x, n = x.size, x.size - 2
    head = np.zeros(HEAD)
    head[[N, N_T, N_WAYS]] = n, 2, 1
    block = np.concatenate([head, A.ravel(), b, [edge]])
    springs = np.zeros(n), np.arange(n), np.zeros((1, n)), np.full(n, 1e300), np.zeros(n)
    numbers = {"n_slow": 0, "slowest": 0.0, "stable": False, "mean_limit": 1.0, "hidden_pull": 0.0, "inertia": 1.0}
    how = {"v": 0.0, "tolerance": 20 * close, "kernel": Kernel(trimmed)}
    of = PeriodMap(block, *springs, np.ones(n_x), np.eye(n_x)[:2], **numbers, has_face=False, **how)
    shooting = Shooting.begun(of, x, new_trace(block, 1).size, memory=8, plain=3, most=80)
    while not shooting.ended:
        shooting.go_on(100)
    return shooting.found
