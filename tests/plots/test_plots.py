"""Figures draw what the records say; small made-up records stand in for runs and curves."""

from dataclasses import replace
from types import SimpleNamespace

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

import mdr
from mdr import plots
from mdr.plots.curves import PIECES, smooth

FREE, STICK, SLIP, SLIP_BACK = range(4)


def made_up_curve(v_c=0.04, static=0.3, **changes):
    v_0 = np.linspace(0.0, 0.05, 6)
    cof = np.minimum(0.5, static + 5 * v_0)
    known = {"cof_error": np.full(6, 1e-5), "settled": np.ones(6, dtype=bool), "stick_share": np.zeros(6)}
    scales = {"v_c": v_c, "mu_0": 0.5, "full_cof": 0.5, "static_cof": static}
    return replace(mdr.CofCurve(v_0, cof, **known, **scales), **changes)


def made_up_run(n_t=64, v_0=1e-3):
    """Two periods of a rigid body over three springs: the outer one sticks while it touches."""
    omega = 2 * np.pi * 50
    t = 7.25 * 0.02 + np.arange(n_t) * 0.04 / n_t
    u_x = v_0 * t
    state = np.full((n_t, 3), SLIP, dtype=np.uint8)
    state[:, 2] = np.where(np.cos(omega * t) > -0.4, STICK, FREE)
    e = np.stack([1e-6 * np.cos(omega * t), 1e-6 * np.cos(omega * t), u_x - u_x[0]], axis=1)
    F_z = 2 + np.cos(omega * t)
    return SimpleNamespace(
        t=t, u_x=u_x, F_x=0.4 * F_z, F_z=F_z, x=np.array([1e-5, 1e-4, 4e-4]), e=e, state=state, v_0=v_0,
        mu_0=0.5, full_cof=0.5, strength=None, omega=omega, mean_F_x=0.8, mean_F_z=2.0,
    )  # fmt: skip


def line(ax, label):
    return next(drawn for drawn in ax.lines if drawn.get_label() == label)


def points(ax, label):
    """Of the smooth line with this label, those that were computed: x and y."""
    return np.asarray(line(ax, label).get_data())[:, ::PIECES]


def legend_texts(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def test_a_curve_is_drawn_over_v_c_and_mu_0():
    curve = made_up_curve()
    ax = plots.plot_curve(curve, labels=["cone"])
    assert_allclose(points(ax, "cone"), [curve.v_0 / 0.04, curve.cof / 0.5])
    assert legend_texts(ax) == ["cone", "static limit"]
    assert any(np.allclose(drawn.get_ydata(), 0.3 / 0.5) for drawn in ax.lines)
    assert "v_c" in ax.get_xlabel()


def test_the_line_through_a_curve_is_smooth_and_goes_no_further_than_its_points():
    def closed_form(v):
        return 1 - (1 - np.minimum(v, 1)) ** 2

    v = np.linspace(0, 1.3, 9)
    at, drawn = smooth(v, closed_form(v))
    assert_array_equal(drawn[::PIECES], closed_form(v))
    assert np.all(np.diff(drawn) >= 0)
    off, straight = (np.abs(one - closed_form(at)).max() for one in (drawn, np.interp(at, v, closed_form(v))))
    assert off < 0.4 * straight
    gap = smooth(v, np.where(v == v[4], np.nan, v))[1]
    assert_array_equal(np.flatnonzero(np.isnan(gap)), np.arange(3 * PIECES + 1, 5 * PIECES))
    assert_allclose(smooth(v[:2], v[:2] ** 2)[1], np.linspace(v[0], v[1] ** 2, PIECES + 1))


def test_unsettled_points_are_hollow_and_their_error_shows():
    settled = np.array([True, True, False, True, True, True])
    curve = made_up_curve(settled=settled, cof_error=np.where(settled, 1e-5, 0.05))
    ax = plots.plot_curve(curve)
    hollow = [drawn for drawn in ax.lines if drawn.get_markerfacecolor() == "white"]
    assert_allclose(np.concatenate([drawn.get_xdata() for drawn in hollow]), curve.v_0[2] / 0.04)
    assert len(ax.containers) == 1
    assert "not settled" in legend_texts(ax)
    assert not plots.plot_curve(made_up_curve()).containers


@pytest.mark.parametrize("v_c", [np.inf, np.nan, None, 0.0])
def test_without_a_finite_v_c_the_axis_is_the_velocity_itself(v_c):
    ax = plots.plot_curve([made_up_curve(v_c=v_c), made_up_curve()], labels=["a", "b"])
    assert "[mm/s]" in ax.get_xlabel()
    assert_allclose(points(ax, "b")[0], 1e3 * made_up_curve().v_0)


def test_several_curves_are_drawn_as_they_are_unless_asked_otherwise():
    curves = [made_up_curve(v_c=0.02), made_up_curve(v_c=0.04, static=0.2)]
    ax = plots.plot_curve(curves, labels=["a", "b"])
    assert_allclose(points(ax, "a"), [1e3 * curves[0].v_0, curves[0].cof])
    assert ("[mm/s]" in ax.get_xlabel(), "mu_0" in ax.get_ylabel()) == (True, False)
    dotted = {float(drawn.get_xdata()[0]): drawn.get_color() for drawn in ax.lines if drawn.get_linestyle() == ":"}
    assert dotted == {20.0: plots.COLOURS[0], 40.0: plots.COLOURS[1]}  # v_c of each, in its colour
    over = plots.plot_curve(curves, labels=["a", "b"], absolute=False)
    assert_allclose(points(over, "a")[0], curves[0].v_0 / 0.02)
    assert len([drawn for drawn in over.lines if drawn.get_linestyle() == ":"]) == 1
    alone = plots.plot_curve(curves[0], labels=["a"], absolute=True)
    assert_allclose(points(alone, "a")[1], curves[0].cof)
    faster = made_up_curve(v_c=9.0, v_0=1e3 * curves[0].v_0)  # on axes that show velocities in mm/s
    plots.plot_curve(faster, alone, ["b"])
    assert_allclose(points(alone, "b"), [1e3 * faster.v_0, faster.cof])
    assert "[mm/s]" in alone.get_xlabel()


def test_too_few_labels_are_refused():
    with pytest.raises(ValueError, match="2 curves, got 1"):
        plots.plot_curve([made_up_curve(), made_up_curve()], labels=["a"])


def test_spring_map_shows_every_spring_at_its_place():
    run = made_up_run()
    ax = plots.plot_spring_map(run)
    mesh = ax.collections[0]
    assert mesh.get_rasterized()
    assert_allclose(np.asarray(mesh.get_array()).reshape(3, -1), run.state.T)
    corners = np.asarray(mesh.get_coordinates())
    assert_allclose(corners[:, 0, 1], [0, 20, 180, 620])  # cells from 0 on whose centres the springs are [µm]
    assert_allclose(corners[0, [0, -1], 0], [0.25 - 1 / 64, 2.25 - 1 / 64])  # the record begins at 7.25 periods
    assert legend_texts(ax) == ["free", "stick", "slip"]
    assert "[µm]" in ax.get_ylabel()


def test_spring_map_of_one_spring_out_of_order_and_of_a_long_record():
    run = made_up_run(n_t=9000)
    run.x, run.state = run.x[::-1], run.state[:, ::-1]
    mesh = plots.plot_spring_map(run).collections[0]
    cells = np.asarray(mesh.get_array()).reshape(3, -1)
    assert cells.shape[1] <= 2000
    assert set(np.unique(cells[2])) == {FREE, STICK}
    run.x, run.state = run.x[:1], run.state[:, :1]
    plots.plot_spring_map(run).figure.canvas.draw()


def test_traces_show_forces_and_feet():
    run = made_up_run()
    forces, places, velocities = plots.plot_traces(run).axes
    assert_allclose(line(forces, "$F_x$").get_ydata(), run.F_x)
    assert_allclose(line(places, "body").get_ydata(), 0.0, atol=1e-9)
    edge = line(velocities, "foot, mean edge").get_ydata()
    assert np.all(np.isnan(edge[run.state[:, 2] == FREE]))
    assert_allclose(edge[np.isfinite(edge)], 0.0, atol=1e-9)  # it sticks whenever it touches
    centre = line(velocities, "foot, centre").get_ydata()
    slip = 1 + 1e-6 * run.omega * np.sin(run.omega * run.t) / run.v_0
    assert_allclose(centre[1:-1], slip[1:-1], atol=0.01)  # differences over 1/32 period: (2 pi/32)²/6 of 0.3


def test_forces_show_the_gap_and_its_share():
    run = made_up_run()
    ax = plots.plot_forces(run)
    assert_allclose(line(ax, "$F_x$").get_ydata(), run.F_x)
    assert_allclose(line(ax, r"$\mu_0 F_z$, the limit").get_ydata(), 0.5 * run.F_z)
    assert legend_texts(ax)[0] == "20 % missing"  # F_x = 0.4 F_z, mu_0 = 0.5
    assert_allclose(ax.get_xlim(), [0.25 - 1 / 32, 2.25 - 1 / 32])  # from the start of the first of 64 steps
    run.F_x, run.mean_F_x = 0.5 * run.F_z, 1.0
    assert legend_texts(plots.plot_forces(run))[0] == "nothing missing"


def test_a_run_is_its_map_above_its_forces():
    run = made_up_run()
    above, below = plots.plot_run(run).axes
    assert_allclose(np.asarray(above.collections[0].get_array()).reshape(3, -1), run.state.T)
    assert_allclose(line(below, "$F_x$").get_ydata(), run.F_x)
    assert above.get_xlim() == below.get_xlim()
    assert not above.get_xlabel()


def test_a_run_without_a_record_is_refused():
    bare = SimpleNamespace(t=None)
    for draw in (plots.plot_spring_map, plots.plot_traces, plots.plot_forces, plots.plot_run):
        with pytest.raises(ValueError, match="record=2"):
            draw(bare)
    with pytest.raises(ValueError, match="record=2"):
        plots.plot_spring_maps([made_up_run(), bare], ["one", "two"])


@pytest.mark.parametrize(("d", "unit"), [(2e-5, 1e-6), (8e-4, 1e-3)])
def test_profile_shows_springs_down_to_the_indenter(d, unit):
    ball = mdr.Sphere(R=1e-3)  # a shape that ends
    left, right = plots.plot_profile(ball, d).axes
    springs = {drawn.get_label(): drawn for drawn in right.collections if drawn.get_label() in ("in contact", "free")}
    tops = np.array([segment[1] for segment in springs["in contact"].get_segments()]) * [unit, 1e-6]
    assert_allclose(tops[:, 1], ball.profile_1d(np.abs(tops[:, 0])) - d, atol=1e-12)
    assert np.all(np.abs(tops[:, 0]) < ball.contact_radius(d))
    assert len(springs["in contact"].get_segments()) + len(springs["free"].get_segments()) == 40
    assert left.get_title() != right.get_title()


@pytest.mark.parametrize("back", [None, -0.1])
def test_a_curve_of_both_ways_jumps_at_rest_or_is_broken_there(back):
    v_0 = np.array([-0.02, -0.01, 0.01, 0.02])
    both = {"cof": np.array([-0.5, -0.4, 0.4, 0.5]), "cof_error": np.zeros(4), "settled": np.ones(4, bool)}
    ax = plots.plot_curve(made_up_curve(v_0=v_0, static_cof_back=back, **both), absolute=True)
    line = max(ax.lines, key=lambda one: len(one.get_xdata()))
    at_rest = line.get_ydata()[np.asarray(line.get_xdata()) == 0]
    assert_array_equal(at_rest, [np.nan if back is None else back, 0.3])


def test_a_figure_is_saved_beside_its_script(tmp_path):
    script = tmp_path / "some_shape.py"
    figure = plt.figure()
    path = mdr.plots.save(figure, str(script), "_more")
    assert path == tmp_path / "figures" / "some_shape_more.png"
    assert path.stat().st_size > 0


def shaken_across():
    """Two periods of three springs whose forces turn once in a period; the inner one sticks at first."""
    run = made_up_run()
    turn = 2 * np.pi * np.arange(64)[:, None] / 32 + np.zeros(3)
    run.state[:8, 0] = STICK
    run.f_x, run.f_y = np.cos(turn), np.sin(turn)
    run.F_y = 0.3 * run.F_z
    return run


def test_shaken_across_the_colour_of_a_slip_is_its_direction():
    run = shaken_across()
    above, below, bar = plots.plot_run(run).axes
    modes, turned = above.collections
    drawn = turned.get_array()
    slips = run.state.T >= SLIP
    assert_array_equal(~np.ma.getmaskarray(drawn), slips)
    assert_allclose(drawn[slips], np.degrees(np.arctan2(run.f_y, run.f_x)).T[slips])
    ends = turned.cmap([0.0, 1.0, 0.5])
    assert_allclose(ends[0], ends[1])  # it closes
    assert_allclose(ends[2], matplotlib.colors.to_rgba(plots.MODES[SLIP][1]), atol=0.01)
    assert_array_equal(modes.get_array(), run.state.T)
    assert legend_texts(above) == ["free", "stick"]
    assert "0 along the pull, 90 across" in bar.get_ylabel()
    assert_allclose(line(below, "$F_y$").get_ydata(), run.F_y)


def test_a_cof_across_is_a_line_of_its_own_where_there_is_one():
    ax = plots.plot_curve(made_up_curve(cof_y=np.full(6, 0.1)))
    drawn = [one.get_ydata() for one in ax.lines if one.get_linestyle() == "-."]
    assert_allclose(np.concatenate(drawn), 0.1 / 0.5)
    assert legend_texts(ax) == ["static limit", "across the pull"]
    assert legend_texts(plots.plot_curve(made_up_curve(cof_y=np.full(6, 1e-6)))) == ["static limit"]


def test_a_static_limit_is_named_where_there_is_one():
    assert legend_texts(plots.plot_curve(made_up_curve(), labels=["cone"])) == ["cone", "static limit"]
    assert plots.plot_curve(made_up_curve(static_cof=np.nan)).get_legend() is None


def test_modes_follow_the_library():
    assert [name for name, _ in plots.MODES] == [mdr.State(i).name.lower().replace("_", " ") for i in range(4)]
