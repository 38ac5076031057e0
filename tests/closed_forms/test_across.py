"""What a contact holds that is shaken across: by springs, and by Coulomb's law in every point of the surface."""

import numpy as np
import pytest
from scipy.integrate import quad

import mdr
from mdr.closed_forms.across import held_across

DEPTH = 20e-6
SHARES = (0.1, 0.3, 0.5, 0.7)


def test_a_paraboloid_on_springs():
    """Numbers of an independent evaluation of the mean over springs."""
    found = [held_across(mdr.Paraboloid(R=5e-3), DEPTH, share * DEPTH) for share in SHARES]
    assert found == pytest.approx([0.98168, 0.87176, 0.68997, 0.45041], abs=1e-5)


@pytest.mark.parametrize("share", SHARES)
def test_the_surface_under_a_paraboloid(share):
    """Hertz: p ~ sqrt(1 - r²), and sqrt(1 - share - r²) where it sticks; t = r²."""

    def held(t):
        stuck = max(1 - share - t, 0.0)
        return 1.5 * np.sqrt(2 * np.sqrt((1 - t) * stuck) - stuck)

    expected = quad(held, 0, 1 - share, epsabs=1e-10)[0]
    assert held_across(mdr.Paraboloid(R=5e-3), DEPTH, share * DEPTH, surface=True) == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("surface", [False, True])
def test_a_flat_face_is_one_spring(surface):
    for share in SHARES:
        found = held_across(mdr.FlatPunch(a=1e-3), DEPTH, share * DEPTH, surface=surface)
        assert found == pytest.approx(np.sqrt(1 - share**2), rel=1e-9)


@pytest.mark.parametrize("shape", [mdr.Cone(theta=0.02), mdr.TruncatedCone(b=5e-4, theta=0.05), mdr.PowerLaw(4, 1e7)])
def test_the_surface_holds_less_than_springs_and_nothing_if_all_of_it_slips(shape):
    for share in SHARES:
        by_springs, at_surface = (held_across(shape, DEPTH, share * DEPTH, surface=s) for s in (False, True))
        assert 0.3 * by_springs < at_surface < by_springs
    assert held_across(shape, DEPTH, 0.0, surface=True) == pytest.approx(1.0, abs=1e-9)
    assert held_across(shape, DEPTH, DEPTH, surface=True) == 0.0
