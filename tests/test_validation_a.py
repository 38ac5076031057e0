"""The claims on the mapping, on motion in full slip, on the static limit and on the rigid pull, in their quick form."""

import numpy as np
import pytest

from validation import run_claim, static_cof
from validation.cases import RADIUS, SHAPES, contact
from validation.rigid_pull import amplitude_limit, edge_band, late


@pytest.mark.parametrize("name", ["mapping", "full_slip_motion", "static_cof", "rigid_pull"])
def test_every_check_of_the_claim_holds(name):
    outcome = run_claim(name, "quick")
    missed = [f"{c.name}: got {c.got}, expected {c.expected}" for c in outcome.claim.checks if not c.held]
    assert not missed, "\n".join([outcome.trace, *missed])
    assert outcome.claim.figures
    assert all(figure.caption and figure.alt for figure in outcome.claim.figures)


def test_a_claim_fails_when_the_physics_is_wrong(monkeypatch):
    """A static limit that is one part in a thousand off is seen, both in closed form and in the slow runs."""
    right = static_cof.mdr.static_cof
    monkeypatch.setattr(static_cof.mdr, "static_cof", lambda case: 1.001 * right(case))
    missed = [check.name for check in static_cof.claim("quick").checks if not check.held]
    assert any("Eq. (7)" in name for name in missed)
    assert any("COF − static over the derived law" in name for name in missed)


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


def test_late_return_lowers_v_c_continuously_and_only_beyond_its_limit():
    limit = amplitude_limit(10.0)
    assert late(1 / (limit * (1 - 1e-9)), 10.0) == 1.0
    assert late(1 / (limit * 1.01), 10.0) == pytest.approx(1.0, abs=1e-3)  # 1 - cos of a small angle
    ratios = [late(1 / (limit * k), 10.0) for k in (1.01, 1.5, 2.0, 4.0)]
    assert np.all(np.diff(ratios) < 0)


def test_the_edge_band_tends_to_its_static_value():
    """At v = 0 a foot never advances: the lag of a gap is its mean compression, since the least is zero."""
    gap, weight = np.polynomial.legendre.leggauss(200)
    mean = (np.sin(np.arccos(gap)) - gap * np.arccos(gap)) / np.pi
    assert edge_band(1e-9) == pytest.approx(float(weight @ mean) - 1, abs=1e-3)
