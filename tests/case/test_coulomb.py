"""What knows Coulomb's friction alone refuses a shear strength by its name."""

import numpy as np
import pytest

import mdr

BALL = mdr.SlidingContact(
    mdr.Paraboloid(5e-3), mdr.Elastic(3e6, 0.4), 0.2, mdr.NormalOscillation(20e-6, 5e-6, 300.0), tau_0=1e4
)
SPECTRUM = mdr.Spectrum(f=(30.0, 50.0), density=(1e-14, 1e-14))
REFUSED = {
    "first_order": lambda: mdr.laws.first_order(BALL),
    "coupling_loss": lambda: mdr.laws.coupling_loss(BALL),
    "lost_across": lambda: mdr.laws.lost_across(case=BALL, v_0=1e-3),
    "holding_band": lambda: mdr.holding_band(BALL),
    "no_load_velocity": lambda: mdr.no_load_velocity(BALL),
    "random_cof": lambda: mdr.random_cof(BALL, SPECTRUM, [1e-3]),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_knows_coulombs_friction_alone_says_so(name):
    with pytest.raises(ValueError, match=f"{name} knows Coulomb's friction alone, .* tau_0 = 10000 Pa"):
        REFUSED[name]()


def test_a_strength_stands_in_files_and_paths():
    assert mdr.parse_case(mdr.write_case(BALL)) == BALL
    assert "tau_0" not in mdr.write_case(mdr.parse_case(mdr.write_case(BALL).replace("tau_0 = 10000.0\n", "")))
    study = mdr.sweep(BALL, {"tau_0": [0.0, 1e4], "v_0": [1e-3]})
    assert np.all(np.diff(study["cof"].ravel()) > 0)
    found = mdr.find(BALL, "tau_0", v_0=1e-3, share=0.99)
    assert mdr.slide(found.cases[0], 1e-3).share == pytest.approx(0.99, abs=1e-5)
