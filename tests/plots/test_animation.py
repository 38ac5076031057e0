"""The moving picture: its frames, and what it needs."""

from base64 import b64decode

import matplotlib.pyplot as plt
import numpy as np
import pytest
from conftest import contact
from PIL import Image

import mdr
from mdr.plots.animation import _Springs, animate_springs


@pytest.fixture(scope="module")
def run():
    case = contact("paraboloid", 1.5, 0.5)
    return mdr.slide(case, 0.3 * case.unit_velocity, n_springs=64, steps_per_period=64, record=1)


def test_a_gif_has_as_many_frames_and_a_notebook_shows_it_without_the_file(run, tmp_path):
    known = plt.get_fignums()
    made = animate_springs(run, tmp_path / "springs.gif", frames=6)
    with Image.open(made) as gif:
        assert gif.n_frames == 6
        first = np.asarray(gif.convert("RGB"))
        gif.seek(3)
        assert np.count_nonzero(np.any(np.asarray(gif.convert("RGB")) != first, axis=2)) > 200
    assert plt.get_fignums() == known  # a notebook would show others
    html = made._repr_html_()
    assert html.startswith('<img alt="springs" ')
    assert b64decode(html.split("base64,")[1].split('"')[0]) == (tmp_path / "springs.gif").read_bytes()


def test_every_period_has_its_frames_and_lasts_as_long(tmp_path):
    case = contact("cone", 1.5, 0.5)
    two = mdr.slide(case, 0.3 * case.unit_velocity, n_springs=32, steps_per_period=32, record=2)
    with Image.open(animate_springs(two, tmp_path / "two.gif", frames=8, title="two periods")) as gif:
        assert gif.n_frames == 16
        assert gif.info["duration"] == 500


def test_springs_end_on_the_indenter_and_lag_by_their_shear(run):
    _, ax = plt.subplots()
    picture = _Springs(ax, run)
    x, R, image = run.x, 5e-3, picture.view.image[-run.x.size - 1 : -1] / picture.view.per_z
    second_order = 1e-3 * 2e-6  # a tenth of (2 pi/64)² du_z: springs leave and touch between steps
    pressed = np.any(run.state != mdr.State.FREE, axis=0)  # others never learn how deep the indenter is
    assert np.max(np.abs(image - x**2 / R)[pressed]) < second_order  # the paraboloid's g, from the run alone
    ax.figure.canvas.draw()
    for k in (0, 20, 40):
        picture.show(k)
        feet, *_, tops = np.swapaxes(picture.lines.get_segments(), 0, 1)
        i = np.argmin(np.abs(x[:, None] - np.abs(tops[:, 0]) / 1e6), axis=0)  # drawn in µm
        here = run.state[k, i] != mdr.State.FREE
        assert np.max(np.abs(tops[:, 1] / 1e6 + run.u_z[k] - x[i] ** 2 / R)[here]) < second_order
        shear = tops[:, 0] - feet[:, 0]
        # the rounding of places
        assert np.max(np.abs(shear - picture.view.lean * run.e[k, i])) < 1e-12 * tops[:, 0].max()


def test_the_ground_takes_along_feet_that_stick_and_is_back_after_a_period(run):
    _, ax = plt.subplots()
    picture = _Springs(ax, run)
    ax.figure.canvas.draw()

    def seen(k):
        picture.show(k)
        feet = np.array(picture.lines.get_segments())[:, 0, 0]
        return feet, np.array(picture.marks.get_segments())[0, 0, 0]

    places = [seen(k) for k in range(run.t.size)]
    moved = [np.diff(one, axis=0) for one in (np.array([feet for feet, _ in places]), [mark for _, mark in places])]
    state = np.concatenate([run.state[:, picture.view.every[::-1]], run.state[:, picture.view.every]], axis=1)
    sticks = np.all(np.stack([state[1:], state[:-1]]) == mdr.State.STICK, axis=0)
    off = (moved[0] - moved[1][:, None]) / picture.apart
    assert np.count_nonzero(sticks) > 100
    assert np.max(np.abs(off - np.round(off))[sticks]) < 1e-9
    turns = run.v_0 * 2 * np.pi / run.omega * picture.view.lean / picture.apart
    assert abs(turns - round(turns)) < 1e-9 < turns


def test_what_it_cannot_draw_is_refused(run, tmp_path):
    with pytest.raises(ValueError, match="call slide"):
        animate_springs(mdr.slide(contact("cone"), 1e-4, n_springs=32, steps_per_period=32), tmp_path / "a.gif")
    with pytest.raises(ValueError, match=r"path must end in \.gif"):
        animate_springs(run, tmp_path / "a.mp4")
    with pytest.raises(ValueError, match="frames must be at least 2"):
        animate_springs(run, tmp_path / "a.gif", frames=1)
