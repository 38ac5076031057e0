"""The laws that claims are tested with, each against its own definition."""

from dataclasses import replace

import numpy as np
import pytest

from validation import one_curve, rigid_pull
from validation.cases import RADIUS, SHAPES, contact
from validation.lost_contact import amplitude_limit, late, slow_limit, touch_depth
from validation.one_curve import edge_band
from validation.rigid_pull import leading_term, read_off


def test_all_shapes_touch_over_the_same_disc():
    radii = [shape.contact_radius(20e-6) for shape in SHAPES.values()]
    np.testing.assert_allclose(radii, RADIUS, rtol=1e-14)
    stiffness = [contact(shape, 0.1, 1.0, k_ratio=2.0).pull.k_x for shape in SHAPES]
    np.testing.assert_allclose(stiffness, 2 * 8000 / 1.5, rtol=1e-13)  # kappa = 1.5 at nu = 0.5


def test_the_groups_of_a_spring_pull_are_met():
    case = contact("cone", 0.1, 2.0, k_ratio=0.5, omega_0_ratio=1.7, damping_ratio=0.05)
    omega = case.oscillation.omega
    got = case.T, case.alpha, case.pull.k_x / case.k_xc, case.pull.omega_0 / omega, case.pull.damping_ratio
    np.testing.assert_allclose(got, (2.0, 0.1, 0.5, 1.7, 0.05), rtol=1e-14)
    with pytest.raises(ValueError, match="mass"):
        contact("cone", 0.1, k_ratio=0.5, damping_ratio=0.05)


@pytest.mark.parametrize("T", [0.3, 1.0, 10.0, 100.0])
def test_the_centre_touches_from_the_depth_of_which_its_whole_past_allows(T):
    phase, ago = np.linspace(1.5, 1.95, 7) * np.pi, np.linspace(0, 6 * np.pi, 200_001)[1:]
    past = np.cos(phase[:, None] - ago) * np.exp(-ago / T) - np.cos(phase)[:, None]
    expected = np.max(past / -np.expm1(-ago / T), axis=1)
    # a maximum between nodes of the grid: its square over 8, times a curvature of order T
    np.testing.assert_allclose([touch_depth(at, T) for at in phase], expected, rtol=0, atol=ago[0] ** 2 * (1 + T))


def test_late_return_lowers_v_c_continuously_and_only_beyond_its_limit():
    limit = amplitude_limit(10.0)
    assert late(1 / (limit * (1 - 1e-9)), 10.0) == 1.0
    assert late(1 / (limit * 1.01), 10.0) == pytest.approx(1.0, abs=1e-3)  # 1 - cos of a small angle
    ratios = [late(1 / (limit * k), 10.0) for k in (1.01, 1.5, 2.0, 4.0)]
    assert np.all(np.diff(ratios) < 0)


def test_the_limit_of_a_slow_material_is_a_minimum():
    theta = np.linspace(np.pi, 2 * np.pi, 100_001)[1:-1]
    assert slow_limit() == pytest.approx(np.min(theta / -np.sin(theta)), rel=1e-8)


def test_a_leading_term_is_found_under_its_successors():
    x = np.geomspace(1e-4, 1e-3, 25)
    found = leading_term(x, 0.3 * x**1.5 * (1 + 2 * np.sqrt(x) - x + x**2), 1 / 2)
    assert found.power == pytest.approx(1.5, abs=5e-6)
    assert found.coefficient == pytest.approx(0.3, rel=1e-4)


def test_a_curve_is_read_off_where_it_has_come_close():
    case = contact("cone", 0.3)
    v = read_off(case, 1e-3)
    assert 0.9 < v < 1
    found = rigid_pull.average_friction(case, v * rigid_pull.mdr.critical_velocity(case))
    assert float(found.cof) == pytest.approx(case.mu_0 * (1 - 1e-3), rel=1e-9)


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


def test_the_edge_band_is_that_of_the_least_extension_of_the_past():
    """The extension of a spring is the least of its compression then plus the pull since: two passes over a period."""
    n, v = 8192, 0.3
    phase = 2 * np.pi * np.arange(2 * n) / n
    gap, weight = np.polynomial.legendre.leggauss(100)
    pressed = np.maximum(np.cos(phase) - np.r_[gap, -1.0][:, None], 0)
    e = np.minimum.accumulate(pressed - v * phase, axis=1) + v * phase
    lag = np.mean((pressed - e)[:, n:], axis=1)
    # a touch lies between instants, and e misses up to the pull in a step
    assert edge_band(v) == pytest.approx(weight @ lag[:-1] / lag[-1] - 1, abs=v * 2 * np.pi / n)


def test_the_edge_band_tends_to_its_limits():
    assert edge_band(1e-9) == pytest.approx(-0.25, abs=1e-8)
    short = np.array([1e-2, 1e-4])
    ratio = np.array([edge_band(1 - x) for x in short]) / np.sqrt(short)  # the gaps passed during a stick
    assert ratio[1] == pytest.approx(ratio[0], rel=0.02)


def test_a_wrong_correction_is_seen(monkeypatch):
    right = one_curve.edge_band
    monkeypatch.setattr(one_curve, "edge_band", lambda v: 1.05 * right(v))
    missed = [check.name for check in one_curve.claim("quick").checks if not check.held]
    assert sum("elastic cone" in name for name in missed) == 6  # closed form and runs at three amplitudes
    assert not any("flat punch" in name for name in missed)  # which has no such term
    assert sum("first-order term C" in name for name in missed) == 3
    assert sum(name.startswith("power") and "1 + C" in name for name in missed) == 2
