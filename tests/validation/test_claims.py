"""Checks of claims do not hold where something is wrong. That they hold else, `python -m validation --quick` asks."""

from dataclasses import replace

import numpy as np
import pytest

import mdr
from mdr import laws
from mdr.march.periodic.settling import Settling
from validation import (
    coupling_law,
    damping,
    end_of_stick,
    falling_in_space,
    judge,
    lost_contact,
    one_curve,
    random_vibration,
    rigid_pull,
    shaken_across,
    static_cof,
    steel_slide,
    stick_slip,
    transverse_slip,
    uncoupled,
    uniqueness,
    vector_springs,
    waveforms,
)
from validation.cases import SHAPES, contact
from validation.generalisation import finite_amplitude, indentation
from validation.generalisation.finite_amplitude import FEW, measure
from validation.half_space import benchmarks, tables
from validation.sequel import at_rest, energy, full_slip


def scale(patch, room, name, by):
    """A function that answers so many times what it should."""
    right = getattr(room, name)
    patch.setattr(room, name, lambda *knobs: by * right(*knobs))


def test_a_claim_fails_when_the_physics_is_wrong(monkeypatch):
    """A static limit that is one part in a thousand off is seen, both in closed form and in the slow runs."""
    scale(monkeypatch, static_cof.mdr, "static_cof", 1.001)
    missed = [check.name for check in static_cof.claim("quick").checks if not check.held]
    assert any("Eq. (7)" in name for name in missed)
    assert any("COF − static over the derived law" in name for name in missed)


def test_a_full_slip_value_that_is_off_is_seen(monkeypatch):
    points = [measure(*knobs) for knobs in FEW]  # from runs alone, so as they were
    scale(monkeypatch, finite_amplitude.mdr, "full_slip_critical_velocity", 1.001)
    missed = [c.name for c in finite_amplitude._measured_checks(points) if not c.held]
    assert any("bracket" in name for name in missed)
    assert any("worst |v_c/full-slip" in name for name in missed)
    assert sum("power of α" in c.name and not c.held for c in finite_amplitude._power_checks("quick")) == 12
    assert sum("passes 1e-9" in c.name and not c.held for c in lost_contact._onset_checks()) == 4
    assert sum("over (**)" in c.name and not c.held for c in lost_contact._slow_checks()) >= 4


@pytest.mark.parametrize("wrong", [0.9, 1.1])
def test_an_onset_that_is_off_is_seen(monkeypatch, wrong):
    scale(monkeypatch, laws, "onset", wrong)
    assert sum("passes 1e-9" in c.name and not c.held for c in lost_contact._onset_checks()) == 4


def test_limits_of_lost_contact_that_are_off_are_seen(monkeypatch):
    points = [lost_contact.measure(shape, alpha, T) for alpha, T, shape in lost_contact.RIGID["quick"]]
    assert all(c.held for c in lost_contact._rigid_checks(points))
    scale(monkeypatch, laws, "late_return", 1.0001)
    scale(monkeypatch, laws, "amplitude_limit", 1.001)
    assert not any(c.held for c in lost_contact._rigid_checks(points))
    assert not any(c.held for c in lost_contact._limit_checks())


def test_a_limit_cycle_that_is_off_is_seen(monkeypatch):
    q, zeta, v = stick_slip.CYCLES[0]
    assert all(c.held for c in stick_slip._cycle_checks([stick_slip.cycle(q, zeta, v, 1024)], quick=True))
    right = laws.stick_slip

    def wrong(*given, **knobs):
        told = right(*given, **knobs)
        return told._replace(period=1.001 * told.period, mean_force=1.001 * told.mean_force, rest=1.001 * told.rest)

    monkeypatch.setattr(laws, "stick_slip", wrong)
    assert not any(c.held for c in stick_slip._cycle_checks([stick_slip.cycle(q, zeta, v, 1024)], quick=True))


def test_a_slope_over_depth_that_is_off_is_seen(monkeypatch):
    least = laws.least_over_depth
    scale(monkeypatch, laws, "depth_sensitivity", 1.001)
    monkeypatch.setattr(laws, "least_over_depth", lambda case: (1.01 * least(case)[0], 1.001 * least(case)[1]))
    assert not any(c.held for c in indentation._slope_checks("quick"))
    assert not any(c.held for c in indentation._minimum_checks())


def test_two_friction_coefficients_at_one_velocity_would_be_seen():
    system = uniqueness.drawn(2)[1]
    one = Settling(0.5, 1e-7, True, "periodic")
    alike, other = replace(one, mean=0.5 + 1e-7), replace(one, mean=0.5 + 1e-6, kind="period-2")
    assert all(c.held for c in uniqueness._end_checks([uniqueness.Ends(system, (one, alike, one, alike, one))]))
    found = [uniqueness.Ends(system, (one, alike, one, other, replace(one, settled=False)))]
    assert not any(c.held for c in uniqueness._end_checks(found))


def test_friction_that_falls_with_velocity_would_be_seen():
    system = uniqueness.drawn(2)[1]
    run = mdr.slide(system.case, system.v_0, n_springs=32, steps_per_period=64)
    less = replace(run, cof=run.cof - 3 * run.cof_error)
    assert next(uniqueness._curve_checks([(system, [less, run])], "quick")).held
    assert not next(uniqueness._curve_checks([(system, [run, less])], "quick")).held


def test_motions_that_move_apart_would_be_seen(monkeypatch):
    system = uniqueness.drawn(2)[1]
    right = uniqueness.distances(system)
    monkeypatch.setattr(uniqueness, "distances", lambda system: right * 1.3 ** np.arange(right.size) ** 2)
    assert not next(uniqueness._distance_checks([uniqueness.Ends(system, ())])).held


def test_a_half_space_whose_coupling_is_off_is_seen(monkeypatch):
    """Dundurs' beta two parts in a hundred off: a bonded punch is too stiff by two parts in a thousand."""
    right = benchmarks.body

    def wrong(n, nu, side):
        body, r = right(n, nu, side)
        return replace(body, beta=1.02 * body.beta), r

    monkeypatch.setattr(benchmarks, "body", wrong)
    monkeypatch.setattr(judge, "punch", benchmarks.punch.__wrapped__)
    missed = [check.name for check in judge._normal_checks(quick=True) if not check.held]
    assert [name for name in missed if "bonded" in name] == missed != []


def test_springs_that_are_off_would_be_seen_beside_three_dimensions():
    rows = tables.read("uncoupled")
    off = [replace(row, springs=row.springs + 4.5e-4) for row in rows]
    assert all(check.held for check in uncoupled._table_checks(rows))
    assert not any(check.held for check in uncoupled._table_checks(off))


def test_a_radial_velocity_that_is_off_is_seen(monkeypatch):
    scale(monkeypatch, end_of_stick, "radial_rub", 1.1)
    assert not any(check.held for check in end_of_stick._tail_checks(quick=True))
    ends = dict.fromkeys(end_of_stick.ENDS[:2], 1.0)  # that of the springs
    assert not any(check.held for check in end_of_stick._end_checks(ends, 17))


def test_a_law_that_is_off_is_seen(monkeypatch):
    columns = coupling_law.columns_of([*tables.read("coupled"), *tables.read("coupling_held_out")])
    training = [column for column in columns if coupling_law._is_training(column[0].point)]
    constants = coupling_law.fitted(training, None)
    assert all(check.held for check in coupling_law._constant_checks(constants))
    assert not any(check.held for check in coupling_law._constant_checks(1.02 * constants))
    every = dict.fromkeys((*coupling_law.FITTED, None), 1.6 * constants)
    trials = [trial for trial in coupling_law.tried(columns, every) if trial.groups.rub <= 1.1]
    checks = coupling_law._trial_checks(trials, coupling_law.tried(columns, every))
    assert sum("greatest loss" in check.name and not check.held for check in checks) == 5


def test_slip_across_that_does_something_by_itself_would_be_seen():
    right = transverse_slip.Losses(0.3, 1.6, 3e-3, 0.0, 1e-5, 0.0)
    below = transverse_slip.Losses(0.3, 0.6, 0.03, 0.018, 1e-5, 0.0)
    assert all(check.held for check in transverse_slip._checks([right, below]))
    wrong = [replace(right, along=1e-4, coupled=1e-4), replace(below, uncoupled=1e-3, along=0.029)]
    assert not any(check.held for check in transverse_slip._checks(wrong))


def test_a_closed_form_that_is_off_is_seen_by_the_runs(monkeypatch):
    right, marched = rigid_pull.average_friction, rigid_pull._marched("quick")[:3]
    assert all(check.held for check in rigid_pull._march_checks(marched))
    monkeypatch.setattr(
        rigid_pull, "average_friction", lambda case, v_0: replace(known := right(case, v_0), cof=1.0001 * known.cof)
    )
    assert not any(check.held for check in rigid_pull._march_checks(marched))


@pytest.mark.parametrize(("end", "where"), [("near_critical", "near v_c"), ("small_velocity", "near rest")])
@pytest.mark.parametrize("wrong", ["coefficient", "power"])
def test_an_asymptote_that_is_off_is_seen(monkeypatch, end, where, wrong):
    right = getattr(rigid_pull, end)

    def off(case):
        law = right(case)
        return replace(law, **{wrong: 1.001 * getattr(law, wrong)})

    monkeypatch.setattr(rigid_pull, end, off)
    missed = [check.name for check in rigid_pull._end_checks() if not check.held]
    assert len(missed) == 2  # elastic and Kelvin
    assert all(name.startswith(wrong) and where in name for name in missed)


def test_a_wrong_correction_is_seen(monkeypatch):
    scale(monkeypatch, laws, "edge_band", 1.05)
    missed = [check.name for check in one_curve.claim("quick").checks if not check.held]
    assert sum("elastic cone" in name for name in missed) == 6  # closed form and runs at three amplitudes
    assert not any("flat punch" in name for name in missed)  # which has no such term
    assert sum("first-order term C" in name for name in missed) == 3
    assert sum(name.startswith("power") and "1 + C" in name for name in missed) == 2


def test_laws_of_a_shake_across_that_are_off_are_seen(monkeypatch):
    scale(monkeypatch, laws, "lost_across", 1.01)
    scale(monkeypatch, laws, "steered_across", -1)
    missed = [c.name for c in shaken_across._fast_checks(quick=True) if not c.held]
    missed += [c.name for c in shaken_across._side_checks(True, {}) if not c.held]
    assert sum("lost friction over its law" in name for name in missed) == 4
    assert sum("less its law" in name for name in missed) == 2


def test_a_contact_at_rest_that_holds_what_it_cannot_is_seen(monkeypatch):
    """Springs in the place of the surface."""
    right = laws.held_across
    monkeypatch.setattr(laws, "held_across", lambda shape, d, reach, surface: right(shape, d, reach))
    missed = [c.name for c in vector_springs._rest_checks(quick=True) if not c.held]
    assert sum("from its own state" in name for name in missed) == 1


def test_what_springs_are_too_high_by_counts(monkeypatch):
    rows = vector_springs.kept.read("across_annuli", vector_springs.Row)
    off = {shape: [row for row in rows if row.point.shape == shape] for shape in SHAPES}
    left = {shape: np.array([row.off for row in off[shape]]) for shape in vector_springs.CURVED}  # no law at all
    monkeypatch.setattr(vector_springs, "FADES", 0.02)
    missed = [c.name for c in vector_springs._table_checks(off, left) if not c.held]
    assert sum("less the law" in name for name in missed) == 3
    assert "constant of the law by least squares" in missed


WIDE = random_vibration.Series("all below", (0.3, 2.0), 64)


@pytest.mark.parametrize("wrong", [0.8, 1.2])
def test_a_law_of_random_vibration_that_is_off_is_seen(monkeypatch, wrong):
    narrow = random_vibration.Series("narrow band", (1.0,), 32)  # whose standard error is 3 % of the loss
    assert all(c.held for c in random_vibration._law_checks([random_vibration.follow(narrow)]))
    right, slow = laws.random_loss, laws.slow_random_loss
    for room in (laws, laws.random):
        monkeypatch.setattr(room, "random_loss", lambda *knobs: wrong * right(*knobs))
    monkeypatch.setattr(laws, "slow_random_loss", lambda b: wrong * slow(b))
    missed = [c.name for c in random_vibration._law_checks([random_vibration.follow(narrow)]) if not c.held]
    assert len(missed) == 1
    assert "loss less the law" in missed[0]
    assert not any(c.held for c in random_vibration._limit_checks())
    at_rest = random_vibration.follow(WIDE._replace(b=(0.01, 0.03), n=8))
    assert not any(c.held for c in random_vibration._slow_checks([at_rest]))


def test_a_queue_that_is_off_is_seen(monkeypatch):
    found, right, mu_0 = random_vibration.follow(WIDE._replace(n=8)), random_vibration.queue, random_vibration.MU_0
    assert all(c.held for c in random_vibration._queue_checks(found))
    monkeypatch.setattr(random_vibration, "queue", lambda *knobs: mu_0 - 1.02 * (mu_0 - right(*knobs)))
    assert not any(c.held for c in random_vibration._queue_checks(found))


def test_spectra_claim_as_far_as_their_spread_allows():
    """A law that claimed less, or all, would pass more easily or not at all."""
    series = [random_vibration.Series(one, (0.1, 1.0, 1.5, 2.0, 2.5), 8) for one in random_vibration.SPECTRA]
    first = [random_vibration.claimed(one) for one in series]
    assert [one.index(True) if any(one) else None for one in first] == [1, 2, 3, None, 4]


def test_a_loss_of_a_waveform_that_is_off_is_seen(monkeypatch):
    right = laws.waveform_loss
    assert all(
        c.held for c in (*waveforms._form_checks(waveforms.fit_error()[0]), *waveforms._march_checks(quick=True))
    )
    monkeypatch.setattr(laws, "waveform_loss", lambda w, beta: right(w, 1.001 * np.asarray(beta)))
    checks = [*waveforms._form_checks(0.0144), *waveforms._march_checks(quick=True)]
    assert sum(not c.held for c in checks) == len(checks) - 1  # all but the fit
    monkeypatch.setattr(laws, "waveform_loss", lambda w, beta: right(w, beta) + 1e-9 * np.sin(np.asarray(beta)))
    assert not any(c.held for c in waveforms._convex_checks(quick=True))


def test_friction_that_bends_the_wrong_way_would_be_seen():
    case = contact("flat punch", 0.3, k_ratio=1.0, omega_0_ratio=2.2, damping_ratio=0.1)  # a body, in the place of none
    rise, bend, error = waveforms.bends(case, 6)
    found = list(waveforms._bend_checks("here", [(rise, bend, error), (rise, -bend, error)]))
    assert [c.held for c in found] == [True, False]
    assert not any(c.held for c in waveforms._bend_checks("here", [(-rise, bend, error)]))


def test_a_steepest_waveform_that_is_not_is_seen(monkeypatch):
    right = laws.steepest_waveform

    def less(N):
        """Its sines a hundredth too small."""
        gain, cos, sin = right(N)
        return 0.99 * gain, cos, 0.99 * sin

    monkeypatch.setattr(laws, "steepest_waveform", less)
    missed = [c.name for c in waveforms._steepest_checks(quick=True) if not c.held]
    assert sum("random depths" in name for name in missed) == 3  # each finds a steeper one
    monkeypatch.setattr(laws, "steepest_waveform", lambda N: (1.01 * right(N)[0], *right(N)[1:]))
    missed = [c.name for c in waveforms._steepest_checks(quick=True) if not c.held]
    assert sum("by runs" in name or "full slip" in name for name in missed) == 6


def test_a_named_waveform_that_costs_another_amount_is_seen(monkeypatch):
    with_gibbs = {name: (lambda m=make, **k: m(**k | {"n_harmonics": 12}), *told) for name, (make, *told) in
                  waveforms.SMOOTH.items()}  # fmt: skip
    monkeypatch.setattr(waveforms, "SMOOTH", with_gibbs)
    assert sum(not c.held for c in waveforms._named_checks()) >= 7


def test_a_waveform_that_is_not_the_best_is_seen():
    _, cos, sin = laws.steepest_waveform(2)
    loss = laws.waveform_loss(mdr.PeriodicMotion(1.0, 1.0, tuple(cos), tuple(sin)), 2 * np.pi)
    found = list(waveforms._best_checks({2: (loss, cos, sin)}))
    assert [c.held for c in found] == [True, False]


def test_a_measured_bar_or_a_contact_that_is_off_is_seen(monkeypatch):
    assert all(check.held for check in (*steel_slide._met_checks(), *steel_slide._falling_checks()))
    right = steel_slide.measured.found
    monkeypatch.setattr(steel_slide.measured, "found", {at: (1.6 * F, length) for at, (F, length) in right.items()})
    assert sum(not check.held for check in steel_slide._met_checks()) >= 4
    assert sum(not check.held for check in steel_slide._falling_checks()) >= 4
    monkeypatch.setattr(steel_slide.measured, "vibrated", np.linspace(0.5, 0.55, 6))
    assert not any("fall" in check.name and check.held for check in steel_slide._constant_checks())


def test_a_damper_that_is_off_would_be_seen(monkeypatch):
    """With the slope of friction, the times of stick, or the law that ties them, a little wrong."""
    case = damping.CASES["flat punch, α = 0.5"]
    sway, stick = damping.sway(*damping.SWAYED[0], 1, 4), damping.stick(case, 0.4)
    assert all(c.held for c in damping._impedance_checks([sway]))
    assert not any(c.held for c in damping._impedance_checks([sway._replace(by_run=1.002 * sway.by_run)]))
    found = list(damping._stick_checks([("", case, 0.4)], [stick._replace(by_stick=1.01 * stick.by_stick)], {}, stick))
    assert [c.held for c in found[:2]] == [False, True]
    scale(monkeypatch, laws, "stick_impedance", 1.001)
    assert not any(c.held for c in damping._lost_checks())


def test_a_half_space_that_let_go_as_springs_do_would_be_seen():
    sizes, by_springs = (20, 40, 80), 0.036
    added = {d_c: np.full(3, by_springs) for d_c in falling_in_space.DISTANCES}
    assert sum(not c.held for c in falling_in_space._size_checks(sizes, added, by_springs)) == 4
    assert sum(not c.held for c in falling_in_space._distance_checks({(0.5, 1.5): np.ones(6)})) == 2
    assert sum(not c.held for c in falling_in_space._peak_checks(sizes, np.full(3, 0.19))) == 3
    assert not any("left" in c.name and c.held for c in falling_in_space._punch_checks(sizes, np.ones(3)))


def test_signs_and_sizes_that_are_wrong_in_the_later_paper_would_be_seen(monkeypatch):
    """Each equation of `sequel`, and each sentence on energy, with what it is compared with turned or moved."""
    held, law = laws.held_under_shake, laws.lost_across
    monkeypatch.setattr(laws, "held_under_shake", lambda *knobs: held(*knobs) + 0.01)
    monkeypatch.setattr(laws, "lost_across", lambda *knobs: -law(*knobs))
    assert not any(c.held for c in at_rest._along_checks(True) if "by the motion" in c.name)
    assert not all(c.held for c in at_rest._across_checks())
    assert not any(c.held for c in full_slip._checks(True) if "over its law" in c.name)
    run = mdr.slide
    monkeypatch.setattr(mdr, "slide", lambda *knobs, **more: replace(run(*knobs, **more), cof=0.49))
    assert not any(c.held for c in at_rest._normal_checks(True))
    assert not any(c.held for c in full_slip._checks(True) if "(12)" in c.name)
    paid = {
        ("flat punch", 0.0, way): [energy.Account(0.1 * i, 1.0, 0.3, 1.2, -1.0) for i in range(5)]
        for way in energy.WAYS
    }
    missed = [c.name for c in energy._elastic_checks(paid) if not c.held]
    assert {name.split(":")[0] for name in missed} >= {"work of a normal oscillation", "greatest dissipation under it"}
    cheap = {("flat punch", T, way): 0.3 for T in energy.TIMES for way in energy.WAYS}
    assert not any(c.held for c in energy._order_checks(cheap))
