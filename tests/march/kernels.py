"""Marches as the kernels do them, and kernels of which the fixed points are known."""

import numpy as np
from numba import njit

from mdr.march.dynamics.kernel import HEAD, N_T, N_WAYS, Kernel, N, new_trace, trace_of
from mdr.march.dynamics.marches import Marches
from mdr.march.dynamics.state import MarchState
from mdr.march.periodic.shooting import Shots


def marched(scaled, v, n_periods):
    """State and trace after so many periods at v from full slip along a line, and whether every step was solved."""
    (kernel, block), n_steps = scaled.in_numbers, n_periods * scaled.drive.steps
    state = MarchState.of(scaled.normal.s, scaled.normal.s, scaled.full_slip.state(v))
    flat = new_trace(n_steps, 1)
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
    """What the search of the march makes of such a map, which it knows to move slowly in the first two parts of x."""
    n_x = x.size
    head = np.zeros(HEAD + 2 * (n_x - 2) + 6)  # springs that stand at 0, and a motion of two steps
    head[[N, N_T, N_WAYS]] = n_x - 2, 2, 1
    marches = Marches(
        kernel=Kernel(trimmed),
        blocks=np.concatenate([head, A.ravel(), b, [edge]])[None],
        v=np.zeros(1),
        s=np.full((1, 1, n_x - 2), 1e300),  # no friction brings a state back
        roots=np.ones((1, n_x)),
        pushes=np.eye(n_x)[None, :2].copy(),
        mean_F_z=np.ones(1),
        slow=np.zeros(1),
        n_slow=0,
        stable=np.zeros(1, dtype=bool),
    )
    shots = Shots(marches, np.array([20 * close]))
    shots.shoot(x[None], 3, 8, 80, 100)
    return shots
