"""The plane from above: leashes that are taut, feet that stand."""

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

import mdr
from mdr.plots.animation import animate_springs
from mdr.plots.leashes import Leashes


def test_leashes_are_taut_where_feet_slip_and_stuck_feet_stand_still(tmp_path):
    ball, depth = mdr.Paraboloid(R=5e-3), mdr.NormalOscillation(20e-6, 15e-6, 300.0)
    shake = mdr.InPlaneOscillation(300.0, du_y=10e-6)
    kelvin = mdr.SlidingContact(ball, mdr.KelvinVoigt(3e6, 0.5, 3e-3), 0.5, depth, shake=shake)
    size = {"n_springs": 64, "steps_per_period": 64, "record": 1}
    run = mdr.slide(replace(kelvin, material=mdr.Elastic(3e6, 0.5)), -1e-3, **size)
    _, ax = plt.subplots()
    picture = Leashes(ax, run)
    length = np.hypot(*np.moveaxis(picture.feet - picture.path[:, None], 2, 0))
    state = picture.state
    assert np.all(length <= (1 + 1e-6) * picture.reach)
    assert np.max(np.abs(length - picture.reach)[state == mdr.State.SLIP]) < 1e-6 * picture.reach.max()
    stands = np.diff(picture.feet[..., 0], axis=0) + picture.step  # in the plane, not with the pull
    both = (state[1:] == mdr.State.STICK) & (state[:-1] == mdr.State.STICK)
    assert both.any()
    assert np.max(np.abs(stands[both])) < 1e-9 * picture.reach.max()
    assert picture.feet[0, 0, 0] > picture.path[0, 0]  # pulled the other way
    assert not Leashes(ax, mdr.slide(kelvin, 1e-3, **size)).reach.any()  # forces of rubber tell no stretch
    with Image.open(animate_springs(run, tmp_path / "above.gif", frames=3)) as gif:
        assert gif.n_frames == 3
