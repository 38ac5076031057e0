"""The contact as one record: what it derives from its parts, what it refuses, and how every record behaves."""

import math
from dataclasses import replace

import pytest
from conftest import contact
from numpy.testing import assert_allclose

import mdr

CASE = contact("paraboloid", depth_ratio=10.0, T=0.5, k_ratio=0.7, c_ratio=0.1)
TAPPING = contact("paraboloid", depth_ratio=-0.3)


# --- what the contact derives ---


def test_stiffness_and_damping_belong_to_the_mean_depth():
    a = math.sqrt(5e-3 * 20e-6)
    material = CASE.material
    assert_allclose(CASE.k_zc, 2 * material.E_star * a, rtol=1e-14)
    assert_allclose(CASE.k_xc, 2 * material.G_star * a, rtol=1e-14)
    assert_allclose([CASE.gamma_zc, CASE.gamma_xc], [material.tau * CASE.k_zc, material.tau * CASE.k_xc], rtol=1e-14)
    assert_allclose(CASE.gamma_xc / CASE.gamma_zc, CASE.k_xc / CASE.k_zc, rtol=1e-14)  # Eq. (11)
    assert_allclose([CASE.alpha, CASE.T, CASE.u_z_max], [0.1, 0.5, 22e-6], rtol=1e-14)


def test_tapping_is_legal():
    assert TAPPING.k_zc == TAPPING.k_xc == 0
    assert TAPPING.alpha < 0
    assert not TAPPING.keeps_contact
    assert math.isinf(contact("cone", depth_ratio=0.0).alpha)


class Rope(mdr.case.pull.Pull):
    """A pull of one's own: a spring and a damper without mass."""

    coefficients = 0.0, 3.0, 2e4


class Worn(Rope):
    """A damper that drives."""

    coefficients = 0.0, -3.0, 2e4


class Stiff(Rope):
    """A mass on a spring that does not yield."""

    coefficients = 1.0, 0.0, math.inf


class Jelly(mdr.Material):
    """A material whose dynamic modulus is not that of E_star, tau and contact_arms."""

    E_star = G_star = 1e6
    dundurs_beta = tau = 0.0

    def dynamic_modulus(self, omega):
        return self.E_star * (1j * omega) ** 0.5


class Timeless(mdr.Material):
    E_star = G_star = 1e6
    dundurs_beta = 0.0


class Still(mdr.Motion):
    cycle = CASE.cycle


@pytest.mark.parametrize(
    ("change", "error", "message"),
    [
        ({"pull": Stiff()}, ValueError, r"rigid pull, whose mass and damping are 0"),
        ({"pull": Worn()}, ValueError, r"damping must be finite and not negative"),
        ({"material": Jelly()}, ValueError, r"springs know a material by these three; .* Prony.fit"),
        ({"material": Timeless()}, TypeError, r"Timeless must answer tau, the relaxation time \[s\]"),
        ({"oscillation": Still()}, TypeError, r"Still must answer omega, its angular frequency"),
    ],
)
def test_a_part_is_refused_for_what_it_answers(change, error, message):
    with pytest.raises(error, match=message):
        replace(CASE, **change)


def test_a_pull_is_known_by_what_it_answers():
    """Not by its class: one of a user's own goes the same ways."""
    own, known = (replace(CASE, pull=pull) for pull in (Rope(), mdr.SpringPull(k_x=2e4, c_x=3.0)))
    assert mdr.critical_velocity(own) == pytest.approx(mdr.critical_velocity(known), rel=1e-12)
    runs = [mdr.slide(one, 1e-3, n_springs=32, steps_per_period=64, n_periods=3) for one in (own, known)]
    assert runs[0].cof == pytest.approx(runs[1].cof, rel=1e-12)
