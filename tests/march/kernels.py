"""Marches as the kernels do them, and kernels of which the fixed points are known."""

from types import SimpleNamespace

import numpy as np
from numba import njit

from mdr.march.dynamics.kernel import HEAD, N_AXES, N_T, Kernel, N, new_trace, trace_of
from mdr.march.dynamics.state import MarchState
from mdr.march.dynamics.stepper import Stepper
from mdr.march.periodic.shooting import Options, Shooting
from mdr.tools.progress import Ticker


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


class OnAMap(Stepper):
    """A stepper of such a map, at rest, so that no spring is late."""

    def __init__(self, A, b, edge, tolerance):
        n = b.size - 2
        head = np.zeros(HEAD)
        head[[N, N_T, N_AXES]] = n, 2, 1
        self.kernel, self.block = Kernel(trimmed), np.concatenate([head, A.ravel(), b, [edge]])
        self.v, self.tolerance, self.mean_limit, self.n_periods = 0.0, tolerance, 1.0, 0
        drive, body = SimpleNamespace(steps=2), SimpleNamespace(M=1.0)
        limit = SimpleNamespace(most=np.full(n, 1e300), gap_tells=True)  # no friction brings a state back
        self.scaled = SimpleNamespace(drive=drive, body=body, limit=limit, in_plane=None, n_axes=1)
        self.ticker = Ticker("map")


def fixed_point(A, b, x, edge=np.inf, close=1e-10):
    """What the search of the march makes of such a map, which it knows to move slowly in the first two parts of x."""
    n_x = x.size
    start = MarchState(x.copy(), np.zeros((1, n_x - 2)))
    how = Options(np.ones(n_x), (0, 1), (), stable=False, memory=8, most=80, at_once=100)
    return Shooting(OnAMap(A, b, edge, 20 * close), start, how, 3).shoot()
