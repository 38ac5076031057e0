"""As accurate as asked: bounds that hold at any accuracy and for what is given, and refusals."""

import math
from dataclasses import replace

import numpy as np
import pytest
from conftest import SHAPES, contact, unit_of_velocity
from numpy.testing import assert_allclose

import mdr
from mdr.closed_forms.rigid_pull import average_friction
from mdr.march.dynamics.stepper import TOLERANCE
from mdr.march.periodic.order import cut_of
from mdr.march.periodic.steady import Resolution, steady
from mdr.march.result import refinement
from mdr.march.result.look import looked_at
from mdr.spring.contact import Springs
from mdr.spring.contact_modes import State
from mdr.spring.energies import LEAST_SLIP

BODY = contact("paraboloid", 3.0, 0.0, 2.0, 1.6, 0.1)
FAST = contact("paraboloid", 3.0, 0.0, 2.0, 6.4, 0.1)  # omega_1/omega is 7.8


def exact(case, v_0):
    return float(average_friction(case, np.array([v_0])).cof[0])


FEW, COARSE = {"n_springs": 32}, {"steps_per_period": 32}
ROUND = ("paraboloid", 10.0), ("paraboloid", 1.43), ("flat", 3.0)
#: shape, depth ratio, T, velocities over Eq. (1), knobs: every shape at small amplitudes, kept and lost; any accuracy,
#: materials faster than a step, the coarsest runs
RIGID = [
    *((shape, 1 / alpha, 0.0, (0.05, 0.37, 0.81, 0.97), {}) for shape in SHAPES for alpha in (0.03, 0.4, 0.9, 1.7)),
    *((shape, 1 / alpha, T, v_hats, {}) for shape in SHAPES for T in (0.3, 1.0, 3.0)
      for alpha, v_hats in ((0.03, (0.37,)), (0.9, (0.05, 0.81)), (1.7, (0.37, 0.81)))),
    *((shape, 3.0, T, (0.3, 0.7), {"accuracy": 10.0**power})
      for shape, T in (("cone", 0.0), ("flat", 0.3), ("paraboloid", 1.0)) for power in range(-7, -2)),
    *((*shape, T, (0.1, 0.25, 0.4, 0.6, 0.8, 0.9), {}) for shape in ROUND for T in (1e-3, 3e-3, 1e-2, 0.1)),
    *(("paraboloid", 1.3, T, (0.2, 0.5, 0.8), knobs) for T in (0.0, 1.0) for knobs in (FEW, COARSE, FEW | COARSE)),
]  # fmt: skip


@pytest.mark.parametrize(("shape", "depth_ratio", "T", "v_hats", "knobs"), RIGID)
def test_a_rigid_pull_is_within_its_error_of_the_closed_form_and_as_accurate_as_asked(
    shape, depth_ratio, T, v_hats, knobs
):
    case = contact(shape, depth_ratio, T)
    for v_hat in v_hats:
        v_0 = v_hat * unit_of_velocity(case)
        run = mdr.slide(case, v_0, **knobs)
        assert abs(run.cof - exact(case, v_0)) <= run.cof_error
        if not {*FEW, *COARSE} & set(knobs):
            assert run.cof_error <= 1.0001 * knobs.get("accuracy", 1e-5) * case.mu_0


def test_less_accuracy_takes_fewer_steps():
    sizes = [(run.n_springs, run.steps_per_period) for run in (mdr.slide(BODY, 5e-4, accuracy=a) for a in (1e-3, 1e-6))]
    assert sizes[0] < sizes[1]


@pytest.mark.parametrize("case", [BODY, FAST, contact("cone", 1.5, 0.0, 2.0, 1.6, 0.1)], ids=["body", "fast", "cone"])
def test_what_is_given_is_kept_and_its_error_within_its_bound(case):
    """The cof is that of the march itself, of so many springs and steps; nothing is added to it."""
    v_0 = 0.4 * mdr.full_slip_critical_velocity(case)
    finest = mdr.slide(case, v_0, n_springs=256, steps_per_period=2048)
    for n_springs, steps in ((32, 64), (48, 32), (64, 256)):
        run = mdr.slide(case, v_0, n_springs=n_springs, steps_per_period=steps)
        assert (run.n_springs, run.steps_per_period) == (n_springs, steps)
        assert abs(run.cof - finest.cof) <= run.cof_error + finest.cof_error
        own = steady(case, v_0, Resolution(n_springs, steps, "full_slip", lump=True))
        # both searches end within TOLERANCE of the periodic state
        assert run.cof == pytest.approx(case.mu_0 * own.cof, abs=2 * TOLERANCE * case.mu_0)


ARM = mdr.StandardLinearSolid(E_inf=3e6, E_1=7795263.970813745, tau_1=0.0005794171745518218, nu=0.1886644152972271)
RESONANT = contact(mdr.CappedCone(1e-4, 0.05), 1 / 0.31784582814, 0.0, 0.23083733833, 2.00030668946, 0.038463567969,
                   nu=ARM.nu)  # fmt: skip
#: contact and velocity over Eq. (1), where runs of two sizes agreed within a part of their error
AGREE = {
    "punch, far above a resonance": (contact("flat", 1 / 1.2, 3.0, 0.7, 1.6, 0.06125), 2.4),
    "punch, lost": (contact("flat", 1 / 1.937631254, 1.185271809, 0.638954114, 1.957400344, 3.986807e-4,
                            nu=0.405475502), 0.928355161),
    "punch, kept": (contact("flat", 1 / 0.448678555, 0.225394062, 1.770696234, 1.896813473, 0.11344749955,
                            nu=0.14802742953), 0.589806498),
    "springs that slip back": (replace(RESONANT, material=ARM), 3.0699340193),
}  # fmt: skip


@pytest.mark.parametrize(("case", "v_hat"), AGREE.values(), ids=AGREE)
def test_the_bound_holds_where_runs_of_two_sizes_agree(case, v_hat):
    v_0 = v_hat * unit_of_velocity(case)
    run, fine = (
        mdr.slide(case, v_0),
        mdr.slide(case, v_0, accuracy=1e-8 if isinstance(case.indenter, mdr.FlatPunch) else 1e-6),
    )
    assert abs(run.cof - fine.cof) <= run.cof_error + fine.cof_error
    assert fine.cof_error < 2e-6 * case.mu_0


def test_the_bound_knows_of_springs_beyond_all_that_were_computed():
    """They slip back between the last computed of those that keep contact and the edge of these: 16 to 48 agree."""
    case = contact("r4", 1 / 0.247044734, 0.0, 0.07611567, 0.329188008, 4.7003212e-5, nu=0.122506923)
    v_0 = 0.3089021054 * unit_of_velocity(case)
    fine, few = mdr.slide(case, v_0), mdr.slide(case, v_0, n_springs=32, steps_per_period=128)
    assert abs(few.cof - fine.cof) > 20 * fine.cof_error
    assert abs(few.cof - fine.cof) <= few.cof_error + fine.cof_error


def test_a_refinement_that_is_too_dear_ends_and_its_error_is_within_its_bound(monkeypatch):
    case = contact("cone", 3.0, 0.3)
    v_0 = 0.3 * unit_of_velocity(case)
    monkeypatch.setattr(refinement, "MOST_CHOSEN", 2**13)
    run = mdr.slide(case, v_0, accuracy=1e-8)
    assert run.n_springs * run.steps_per_period <= 2**13
    assert 1e-8 * case.mu_0 < run.cof_error
    assert abs(run.cof - exact(case, v_0)) <= run.cof_error
    assert run.settled


def test_steps_that_are_chosen_resolve_the_oscillation_of_the_body():
    assert mdr.slide(FAST, 0.5 * mdr.full_slip_critical_velocity(FAST)).steps_per_period >= 16 * 7.8


def test_a_wider_bracket_takes_fewer_runs_and_holds_the_narrow_one():
    wide, narrow = (mdr.measure_critical_velocity(BODY, accuracy=a) for a in (1e-3, 1e-5))
    assert wide.low < narrow.v_c < wide.high
    assert wide.high - wide.low > 10 * (narrow.high - narrow.low)


def test_bodies_without_mass_on_dashpots_begin_with_more_where_they_lose_contact():
    lost, kept = contact("flat", 1 / 1.3, 1.0, 1.0, math.inf), contact("flat", 3.0, 1.0, 1.0, math.inf)
    assert refinement.default_steps(lost) > refinement.default_steps(kept)
    assert refinement.default_springs(lost) > refinement.default_springs(kept)


def test_the_row_is_cut_where_springs_begin_to_slip_back():
    """Under a body that swings back, the outermost of the springs that never lose contact slip back, and those alone.
    Without a cut there it took 512 springs."""
    case = mdr.SlidingContact(
        mdr.Paraboloid(5e-3), mdr.Elastic(3e6, 0.4), 0.4, mdr.NormalOscillation(2e-5, 1.43e-5, 314.0)
    )
    k_x = 0.6 * case.k_xc
    case = replace(case, pull=mdr.SpringPull(k_x, k_x / (0.7 * 314.0) ** 2, 0.1 * k_x / 314.0))
    v_0 = 0.327 * case.unit_velocity
    reach = case.cycle.unit * cut_of(steady(case, v_0, Resolution(64, 128, "full_slip", True)))
    assert reach < case.cycle.unit * case.kept_gap
    fine = mdr.slide(case, v_0, n_springs=2048, steps_per_period=128, record=1)
    gap, back = case.indenter.profile_1d(fine.x) - 2e-5, (fine.state == State.SLIP_BACK).any(axis=0)
    kept = gap < case.cycle.unit * case.kept_gap
    assert back[kept & (gap > reach + 0.01 * case.cycle.unit)].all()
    assert not back[gap < reach - 0.01 * case.cycle.unit].any()
    run = mdr.slide(case, v_0)
    assert run.n_springs <= 128
    assert run.cof_error < 1e-5 * case.mu_0
    assert abs(run.cof - fine.cof) <= run.cof_error + fine.cof_error


LOST = {
    "body": (contact("paraboloid", 1.56, 0.0, 0.3, 0.9, 0.02), 0.5),
    "dashpots": (contact("paraboloid", 1.2, 0.2, 0.3, 0.9, 0.02), 0.4),
    "shaken": (
        replace(contact("cone", 10.0, 0.0, 2.0, 1.6, 0.1), shake=mdr.InPlaneOscillation(omega=300.0, du_x=3e-6)), 0.3
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", LOST)
def test_the_row_is_cut_among_springs_that_leave_and_under_a_shake(name):
    case, share = LOST[name]
    v_0 = share * mdr.critical_velocity(case)
    coarse = cut_of(steady(case, v_0, Resolution(32, 128, "full_slip", True)))
    end = steady(case, v_0, Resolution(512, 512, "full_slip", True))
    gap = end.scaled.springs.gap
    mode, *_ = end.stepper.of_springs(end.orbit.state, end.scaled.springs)
    back = gap[(mode == State.SLIP_BACK).any(axis=0)].min()
    assert coarse == pytest.approx(back, abs=0.02)  # 32 springs stand up to 0.1 apart
    assert cut_of(end) == pytest.approx(back, abs=np.diff(np.sort(gap)).max())


def test_springs_beside_the_row_move_as_those_in_it():
    case, share = LOST["body"]
    end = steady(case, share * mdr.critical_velocity(case), Resolution(32, 128, "full_slip", True))
    row = end.scaled.springs
    some = Springs(row.gap[::-3].copy(), row.w[::-3].copy())
    for of_row, of_some in zip(*(end.stepper.of_springs(end.orbit.state, one) for one in (row, some)), strict=True):
        assert_allclose(of_some, of_row[:, ::-3], atol=1e-9)


@pytest.mark.parametrize("T", [0.0, 0.5])
@pytest.mark.parametrize("share", [1.05, 1.5])
@pytest.mark.parametrize("depth_ratio", [3.0, 0.7])
def test_the_least_slip_of_a_march_is_that_of_a_close_look(depth_ratio, share, T):
    case = contact("paraboloid", depth_ratio, T, 2.0, 1.6, 0.1)
    end = steady(case, share * mdr.full_slip_critical_velocity(case), Resolution(32, 256, "full_slip", True))
    assert end.slips_fully
    seen = looked_at(end)[1][0].seen.sums[LEAST_SLIP] / end.scaled.drive.pace(end.stepper.v)
    assert end.least_slip == pytest.approx(seen, abs=end.scaled.drive.h**2)  # to the parabolas of steps
