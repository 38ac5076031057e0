"""What the stepper reads off a period."""

import gc

import numba
import numpy as np
import pytest
from numba.core.runtime import _nrt_python, rtsys
from numpy.testing import assert_allclose

import mdr
from mdr.march.dynamics.state import on_other_springs
from mdr.march.dynamics.stepper import Stepper, least_between
from mdr.march.periodic.steady import Resolution, at_hand

PHASE = 2 * np.pi * np.arange(64) / 64


@pytest.mark.parametrize("at", [0.0, 0.02, 0.05, 3.0, 6.27])
def test_the_least_value_of_a_smooth_function_lies_between_its_nodes(at):
    values = 1.3 - np.cos(PHASE - at) + 0.1 * np.sin(2 * (PHASE - at)) ** 2
    assert_allclose(least_between(values), 0.3, rtol=1e-5)
    assert_allclose(least_between(np.where(np.abs(np.sin(0.5 * (PHASE - at))) < 0.5, values, np.inf)), 0.3, rtol=1e-5)


def test_no_value_is_made_up_beside_a_jump():
    values = np.array([1.0, 1.0, 1.0, 0.1, 0.1, 0.1, 1.0, 1.0])
    assert least_between(values) == 0.1
    assert least_between(np.array([3.0, 2.0, 1.0, np.inf, np.inf, np.inf])) == 1.0
    assert least_between(np.array([1.0, 0.0, -0.2, 0.0, 1.0, 2.0])) == -0.2


SHAKES = {"line": None, "plane": mdr.InPlaneOscillation(300.0, 3e-6, 1.0, 6e-6, 2.0)}
on_a_line_and_in_the_plane = pytest.mark.parametrize("shake", SHAKES.values(), ids=SHAKES)


def stepper_of(shake, u_z0, tau):
    """A march of a ball."""
    motion = mdr.NormalOscillation(u_z0, 8e-6, 300.0)
    case = mdr.SlidingContact(mdr.Paraboloid(5e-3), mdr.KelvinVoigt(3e6, 0.4, tau), 0.4, motion, shake=shake)
    return Stepper(at_hand(case, Resolution(32, 64, "full_slip", True))[1], 0.3)


@pytest.mark.skipif(numba.config.DISABLE_JIT, reason="nothing is compiled")
@on_a_line_and_in_the_plane
def test_a_close_look_leaves_no_array_behind(shake):
    """Rules over parts of a step are made in compiled code that lends its arrays."""
    stepper = stepper_of(shake, 5e-6, 1e-3)
    start = stepper.full_slip()
    stepper.observe(start, keep=False)
    _nrt_python.memsys_enable_stats()
    before = rtsys.get_allocation_stats()
    stepper.observe(start, keep=False)
    gc.collect()
    after = rtsys.get_allocation_stats()
    assert after.alloc - before.alloc == after.free - before.free > 0


@on_a_line_and_in_the_plane
def test_a_combination_of_states_is_brought_into_the_cone_of_friction(shake):
    """As long as the compression, in its own direction; what lies within stays as it is."""
    stepper = stepper_of(shake, 20e-6, 0.0)
    state, inside = stepper.full_slip(), stepper.full_slip()
    turned = -1.0 if shake is None else np.exp(2j)
    state.e[:] = 7 * turned * state.s
    inside.e[:] = 0.9 * turned * inside.s
    assert_allclose(stepper.within_friction(state).e, turned * state.s, rtol=1e-15)
    assert_allclose(stepper.within_friction(inside.copy()).e, inside.e, rtol=0)


@pytest.mark.parametrize("n_axes", [1, 2], ids=["line", "plane"])
def test_a_state_goes_to_other_springs_on_straight_lines_over_their_gaps(n_axes):
    rng = np.random.default_rng(n_axes)
    gap, on = rng.permutation(np.linspace(-3.0, 1.0, 7)), np.linspace(-3.5, 1.5, 12)  # some lie beyond
    e, body = rng.normal(size=(2, 3, 7, n_axes)), rng.normal(size=(2, 2 * n_axes))  # two states with two arms
    moved = on_other_springs(np.column_stack([e.reshape(2, -1), body]), gap, np.argsort(gap), on, n_axes)
    assert_allclose(moved[:, -2 * n_axes :], body, rtol=0)
    order = np.argsort(gap)
    known = np.apply_along_axis(lambda one: np.interp(on, gap[order], one[order]), 2, e)
    assert_allclose(moved[:, : -2 * n_axes], known.reshape(2, -1), rtol=1e-12)


@pytest.mark.parametrize("n", [1, 5])
def test_where_all_springs_have_one_gap_the_last_is_taken(n):
    x = np.arange(n + 2.0)[None]
    moved = on_other_springs(x, np.full(n, -2.0), np.arange(n), np.full(3, -2.0), 1)
    assert_allclose(moved, [[n - 1, n - 1, n - 1, n, n + 1]], rtol=0)
