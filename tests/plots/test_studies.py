"""Pictures of studies: what they show is what the study holds, and what is not there shows too."""

from dataclasses import replace

import numpy as np
import pytest
from conftest import contact
from numpy.testing import assert_allclose

import mdr
from mdr.plots import studies
from mdr.tools.status import Status

CASE = contact("paraboloid", 4.0, 0.3, mu_0=0.5)
SHAPES = [mdr.Paraboloid(R=5e-3), mdr.Cone(theta=0.05)]
ALPHA, V, T = [0.6, 0.1, 0.3], [0.2, 0.4, 0.8, 1.2], [0.1, 1.0]


@pytest.fixture(scope="module")
def study():
    return mdr.sweep(CASE, {"alpha": ALPHA, "v_0/v_c": V, "T": T})


@pytest.fixture(scope="module")
def flat(study):
    return study.select({"T": 1.0})


@pytest.fixture(scope="module")
def shapes():
    return mdr.sweep(CASE, {"indenter": SHAPES, "v_0/v_c": V})


def broken(study, where, status):
    """The study with one point that ended otherwise."""
    values, fate = study.values.copy(), study.status.copy()
    fate[where] = status
    if status != Status.UNSETTLED:
        values[(slice(None), *where)] = np.nan
    return replace(study, values=values, status=fate)


def labels(ax):
    legend = ax.get_legend()
    return [text.get_text() for text in legend.get_texts()] if legend else []


def test_a_map_shows_the_values_where_they_belong(flat):
    ax = flat.plot_map("cof", x="v_0/v_c")
    mesh = ax.collections[0]
    ordered = flat["cof"][np.argsort(ALPHA)]
    assert_allclose(mesh.get_array().reshape(3, 4), ordered)
    assert "v_0/v_c" in ax.get_xlabel()
    assert r"\alpha" in ax.get_ylabel()
    corners = mesh.get_coordinates()
    inside = (corners[:-1, :-1] + corners[1:, 1:]) / 2
    assert np.all(np.diff(corners[:, 0, 1]) > 0)
    assert abs(inside[0, 0, 0] - 0.2) < 0.11
    assert labels(ax) == []
    assert_allclose(flat.plot_map("cof", x="alpha").collections[0].get_array().reshape(4, 3), ordered.T)


@pytest.mark.parametrize(
    ("status", "word"), [(Status.FAILED, "failed"), (Status.MISSING, "not computed"), (Status.UNSETTLED, "not settled")]
)
def test_what_is_not_there_shows(flat, status, word):
    one = broken(flat, (1, 2), status)
    assert any(word in text for text in labels(one.plot_map("cof")))
    assert any(word in text for text in labels(one.plot_curves("cof", x="v_0/v_c")))
    one.plot_map("cof").figure.canvas.draw()


def test_curves_of_a_family_are_rows(flat):
    ax = flat.plot_curves("cof", x="v_0/v_c")
    for row, alpha in zip(flat["cof"], ALPHA, strict=True):
        line = next(line for line in ax.lines if line.get_label() == f"{alpha:.3g}")
        assert_allclose(line.get_xdata(), V)
        assert_allclose(line.get_ydata(), row)
    assert r"\alpha" in ax.get_legend().get_title().get_text()


def test_small_multiples_share_their_colours(study):
    fig = study.plot_multiples("cof", over="T", x="v_0/v_c")
    maps = [ax.collections[0] for ax in fig.axes if ax.get_title()]
    assert len(maps) == 2
    assert len({one.get_clim() for one in maps}) == 1
    assert_allclose(maps[0].get_clim(), [study["cof"].min(), study["cof"].max()])
    assert [ax.get_title().endswith(value) for ax, value in zip(fig.axes, ("0.1", "1"), strict=False)] == [True, True]


def test_small_multiples_name_an_axis_at_the_rim_alone(flat):
    fig = flat.plot_multiples("cof", over="alpha", columns=2)
    named = [(bool(ax.get_xlabel()), bool(ax.get_ylabel()), ax.get_visible()) for ax in fig.axes]
    assert [len(ax.lines) > 0 for ax in fig.axes] == [True, True, True, False]
    assert named == [(False, True, True), (True, False, True), (True, True, True), (False, False, False)]


def test_axes_that_grow_by_a_factor_are_logarithmic():
    axes = {"oscillation.omega": np.geomspace(100, 1e4, 5), "alpha": [0.1, 0.2, 0.3]}
    study = mdr.sweep(CASE, axes, quantities=("v_c",))
    ax = study.plot_map("v_c", x="oscillation.omega", log=True)
    assert (ax.get_xscale(), ax.get_yscale()) == ("log", "linear")
    assert "krad/s" in ax.get_xlabel()
    assert_allclose(ax.collections[0].get_coordinates()[0, :2, 0], [0.1 / 10**0.25, 0.1 * 10**0.25])


def test_no_cell_of_a_map_lies_beyond_zero_and_colours_that_nearly_begin_there_do():
    axes = {"alpha": [0.1, 0.5, 0.95], "v_0": [0.0, 1e-5, 2e-5]}
    study = mdr.sweep(replace(CASE, material=mdr.Elastic(3e6, 0.5)), axes, n_springs=32, steps_per_period=32)
    ax = study.plot_map("cof")
    assert (ax.get_xlim()[0], ax.get_ylim()[0]) == (0.0, 0.0)
    assert ax.get_xlim()[1] == pytest.approx(25.0)  # µm/s, half a cell beyond the last
    bar = next(one for one in ax.figure.axes if one is not ax)
    assert 0 < study["cof"].min() < 0.1 * study["cof"].max()
    assert ax.collections[0].get_clim()[0] == 0.0
    assert 0.0 in bar.get_yticks()
    shaken = replace(contact("paraboloid"), shake=mdr.InPlaneOscillation(omega=300.0, du_x=1e-5))
    both = mdr.sweep(shaken, {"alpha": [0.1, 0.2], "v_0": [-1e-4, 0.0, 1e-4]}, n_springs=32, steps_per_period=32)
    assert both.plot_map("cof").get_xlim()[0] < -1e-4


def critical(ax):
    """Places of the dashed line of a map."""
    return [np.asarray(line.get_data()) for line in ax.lines if line.get_linestyle() == "--"]


def test_a_map_over_velocity_shows_the_critical_one(flat):
    x, _ = critical(flat.plot_map("cof", x="v_0/v_c"))[0]
    assert_allclose(x, 1.0)
    _, y = critical(flat.plot_map("cof", x="alpha"))[0]
    assert_allclose(y, 1.0)
    slow = mdr.sweep(CASE, {"alpha": [0.1, 0.2], "v_0/v_c": [0.2, 0.4]})
    assert critical(slow.plot_map("cof")) == []  # out of sight


def test_the_picture_of_a_map_has_contours_round_or_chosen(study, flat):
    def contours(fig):
        return [one for ax in fig.axes for one in ax.collections if hasattr(one, "levels")]

    round_ones = contours(flat.plot("cof"))[0].levels
    assert len(round_ones) >= 2
    assert_allclose(round_ones, np.round(round_ones, 2))
    assert_allclose(contours(flat.plot("cof", levels=[0.4, 0.35]))[0].levels, [0.35, 0.4])
    assert contours(flat.plot("cof", levels=[])) == []
    assert len(contours(study.plot())) == 2


def test_small_multiples_name_what_failed_once_beside_the_titles(study):
    fig = broken(study, (1, 2, 1), Status.FAILED).plot_multiples("cof", over="T", x="v_0/v_c")
    assert [text.get_text() for text in fig.legends[0].get_texts()] == ["failed"]
    assert all(ax.get_legend() is None for ax in fig.axes)
    curves = broken(study, (1, 2, 1), Status.FAILED).select({"T": 1.0}).plot_multiples("cof", over="alpha")
    assert [text.get_text() for text in curves.legends[0].get_texts()] == ["1 failed"]
    assert study.select({"T": 1.0}).plot_multiples("cof", over="alpha").legends == []


def test_a_map_of_nothing_is_drawn(flat):
    empty = replace(flat, values=np.full_like(flat.values, np.nan), status=np.full_like(flat.status, Status.FAILED))
    assert labels(empty.plot_map("cof", log=True)) == ["failed"]


def test_named_axes_and_quantities_exist():
    assert set(studies.LABELS) <= set(mdr.studies.CATALOGUE)


# --- the picture that suits ---


def test_the_picture_that_suits(study, flat, shapes):
    """A map of two axes of numbers, a curve of one, multiples of three; an axis of one value is left out."""
    ax = flat.plot("cof").axes[0]
    assert "v_0/v_c" in ax.get_xlabel()
    assert r"\alpha" in ax.get_ylabel()
    assert len(ax.collections)
    one = study.select({"alpha": 0.1})
    assert_allclose(one.select({"T": 1.0}).plot().axes[0].lines[0].get_ydata(), flat.select({"alpha": 0.1})["cof"])
    assert "v_0/v_c" in mdr.sweep(CASE, {"T": [0.5], "v_0/v_c": V}).plot().axes[0].get_xlabel()
    assert labels(shapes.plot().axes[0]) == [repr(shape) for shape in SHAPES]
    three = mdr.sweep(CASE, {"indenter": SHAPES, "v_0/v_c": V, "T": T})
    assert [ax.get_title() for ax in three.plot().axes[:2]] == ["Paraboloid(R=0.005)", "Cone(theta=0.05)"]
    by_number = study.plot()
    assert sum(ax.get_title() != "" for ax in by_number.axes) == len(T)  # over the shortest axis
