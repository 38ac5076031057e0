"""Points of a profile: heights in one column with a pitch. Sides and apex are in test_measurements.py."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr

HEIGHTS = 0.4 * (np.arange(41) - 20.0) ** 2  # um, of R = 5 um at steps of 2 um
R = 2.0**2 / (2 * 0.4)  # um
SAID = {"columns": {"f": 1}, "units": {"f": "um"}, "apex": 40e-6}


@pytest.mark.parametrize("above", ["", "Pitch,2.0,um\nUnit,um\n", "# profile\n"])
def test_heights_in_one_column_have_a_pitch(tmp_path, above):
    path = tmp_path / "data.csv"
    path.write_text(above + "".join(f"{one:g}\n" for one in HEIGHTS))
    shape = mdr.SampledProfile.read(path, pitch=2e-6, **SAID)
    assert_allclose(shape.contact_radius(5e-6), 1e-6 * np.sqrt(R * 5), rtol=1e-6)
    with pytest.raises(ValueError, match="pitch must be positive"):
        mdr.SampledProfile.read(path, pitch=0.0, **SAID)


def test_a_pitch_beside_places_that_say_another_is_told(tmp_path):
    path = tmp_path / "data.csv"
    path.write_text("x [um],z [um]\n" + "".join(f"{2 * i},{one:g}\n" for i, one in enumerate(HEIGHTS)))
    with pytest.warns(
        mdr.PlausibilityWarning, match="its r goes over 80 µm, at this pitch over 40 µm: the pitch is taken"
    ):
        mdr.SampledProfile.read(path, pitch=1e-6, apex=20e-6)
    counted, read = (mdr.SampledProfile.read(path, apex=40e-6, **given) for given in ({"pitch": 2e-6}, {}))
    assert_allclose(counted.r, read.r, rtol=1e-12)
