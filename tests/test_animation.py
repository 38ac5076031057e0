"""The moving picture: its frames, and what it needs."""

import numpy as np
import pytest
from conftest import contact
from PIL import Image

import mdr
from mdr.animation import animate_springs


@pytest.fixture(scope="module")
def run():
    case = contact("paraboloid", 1.5, 0.5)
    return mdr.slide(case, 0.3 * case.unit_velocity, n_springs=64, steps_per_period=64, record=1)


def test_a_gif_with_as_many_frames(run, tmp_path):
    path = animate_springs(run, tmp_path / "springs.gif", frames=6)
    with Image.open(path) as gif:
        assert gif.n_frames == 6
        first = np.asarray(gif.convert("RGB"))
        gif.seek(3)
        assert np.count_nonzero(np.any(np.asarray(gif.convert("RGB")) != first, axis=2)) > 200


def test_what_it_cannot_draw_is_refused(run, tmp_path):
    with pytest.raises(ValueError, match="call slide"):
        animate_springs(mdr.slide(contact("cone"), 1e-4, n_springs=32, steps_per_period=32), tmp_path / "a.gif")
    with pytest.raises(ValueError, match=r"path must end in \.gif"):
        animate_springs(run, tmp_path / "a.mp4")
    with pytest.raises(ValueError, match="frames must be at least 2"):
        animate_springs(run, tmp_path / "a.gif", frames=1)
