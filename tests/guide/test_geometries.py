"""The scripts in geometries/: each draws its figure, and what its caption says is so.

That the library's numbers are right is asked of the library; here each script is asked for its own point.
"""

import sys
from dataclasses import replace
from importlib import import_module
from pathlib import Path

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr
from mdr.element.fmu import NoCompiler, compiler

FOLDER = Path(__file__).parents[2] / "geometries"
NAMES = sorted(path.stem for path in FOLDER.glob("*.py"))
KAPPA = 1.5  # incompressible, (2 - nu)/(2 (1 - nu))


def script(name):
    """The module geometries/<name>.py, run once."""
    if name == "host_co_simulation":
        pytest.importorskip("fmpy", reason="fmpy, of the extra export, drives the unit")
        try:
            compiler()
        except NoCompiler as fault:
            pytest.skip(str(fault))
    if name == "depths":
        sys.modules["gallery"] = script("gallery")  # it imports the script beside it
    return import_module(f"geometries.{name}")


def rising(*values):
    return np.all(np.diff(np.concatenate([np.atleast_1d(one) for one in values])) > 0)


def psi(v_hat):
    """Mean lag of one spring behind full slip: its extension is inf over theta >= 0 of cos(t - theta) + v_hat theta."""
    t, theta = 2 * np.pi * np.arange(360) / 360, np.linspace(0, 2 * np.pi, 1441)
    return -np.mean(np.min(np.cos(t[:, None] - theta) + v_hat * theta, axis=1))


def test_every_shape_has_its_script():
    shapes = {path.stem for path in Path(mdr.indenters.__file__).parent.glob("*.py")}
    assert shapes - {"__init__", "base", "mapped", "worn"} <= set(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_figure_is_a_figure_and_leaves_no_style_behind(name):
    size = mpl.rcParams["font.size"]
    fig = script(name).figure()
    fig.set_layout_engine("none")  # which measures all texts once more
    fig.canvas.draw()
    panels = [ax for ax in fig.axes if ax.get_label() != "<colorbar>" and not ax.get_ylabel().startswith("off")]
    assert all(ax.get_title() and ax.has_data() for ax in panels)
    assert mpl.rcParams["font.size"] == size
    plt.close(fig)


@pytest.mark.parametrize("name", sorted({*NAMES} - {"sphere", "hyperboloid"}))  # far too steep, on purpose
def test_no_contact_of_a_script_is_unlikely(name):
    cases = [one for one in vars(script(name)).values() if isinstance(one, mdr.SlidingContact)]
    assert [said for case in cases for said in mdr.plausibility(case)] == []


def test_flat_punch_has_its_friction_back_above_v_c_and_loses_it_all_where_contact_is_lost():
    s = script("flat_punch")
    for curve in s.curves:
        assert rising(curve.cof)
        assert_allclose(curve.cof[s.shares > 1], 0.8, rtol=1e-6)
        assert np.all(curve.cof[s.shares < 1] < 0.8 * (1 - 1e-4))
    assert_allclose(s.static, [0.8 * (1 - 0.3 * np.sqrt(1 + T**2)) for T in s.loss_tangents], rtol=1e-6)  # Eq. (7)
    assert max(s.at_rest_beyond) == 0


def test_cone_is_slowest_where_stiffness_and_inertia_balance_and_slips_from_the_edge():
    s = script("cone")
    assert abs(s.depths[np.argmin(s.eq_15)] - s.balanced) <= 0.5e-6 * 1.01  # half the step of the depths
    for depth, verdict in s.verdicts.items():
        assert_allclose(verdict.measured, verdict.full_slip, rtol=1e-4)  # accuracy of a measured v_c
        assert_allclose(np.interp(depth, s.depths, s.full), verdict.full_slip, rtol=1e-3)
    assert -0.01 < s.verdicts[s.shallow].deviation < -0.001 < 0.01 < s.verdicts[s.deep].deviation < 0.02
    centre, edge = (s.run.state[:, i] == mdr.State.SLIP for i in (0, np.searchsorted(s.run.x, 0.75 * s.run.x[-1])))
    assert 0 < np.argmax(edge) < np.argmax(centre)


def test_paraboloid_friction_is_lowered_where_v_c_exceeds_the_speed():
    s = script("paraboloid")
    ratio, lowered = s.eq_15 / s.eq_1, np.interp(s.shaken, s.sweep, s.eq_15) > s.v_0
    assert_allclose(s.sweep[np.argmax(ratio)], s.f_0, rtol=0.05)  # the damper, 10 % of critical, moves both a little
    assert_allclose(s.sweep[np.argmin(ratio)], s.f_1, rtol=0.05)
    assert 0 < lowered.sum() < lowered.size
    assert np.array_equal(s.cof < 0.7 - 1e-4, lowered)


def test_power_laws_collapse_on_psi_in_proportion_to_the_amplitude():
    s = script("power_law")
    large, small = s.amplitudes
    assert_allclose(s.psi, [psi(v) for v in s.v_hat], atol=1e-4)
    assert max(s.departure[np.inf, alpha] for alpha in s.amplitudes) < 1e-5 / 0.03  # the budget of the COF, scaled
    for n in s.exponents[:-1]:
        assert s.departure[n, small] < 0.3 * small / n  # the cone at rest: alpha/4, and 1/n for the others
        assert 8 < s.departure[n, large] / s.departure[n, small] < 20  # first power of ten times the amplitude
    assert rising([s.curves[n, large].cof[0] for n in s.exponents])  # blunter tips keep more


def test_sphere_leaves_the_parabola_as_its_series_says():
    """F_N = Hertz (1 - d/10R + ...) and a = a_p (1 - d/6R + ...); v_c has the share k_xc/(k_x + k_xc) of the latter."""
    s, shallow = script("sphere"), slice(0, 8)
    d, share = s.depths[shallow], 1 - s.eq_1 / s.velocities[shallow]
    assert_allclose(s.errors["force $F_N$"][shallow], d / 50e-6, rtol=0.05)
    assert_allclose(s.errors["$v_c$, Eq. (15)"][shallow], share * d / 30e-6, rtol=0.05)
    assert s.limits[0] < s.force_limit < s.limits[1]
    assert rising(s.limits)  # a stiff lever hides it
    ball, parabola = ([run.cof for run in s.runs[shape]] for shape in (s.ball, s.parabola))
    assert np.all(np.array(parabola) < ball)


def test_ellipsoid_fools_a_light_touch_at_any_speed_and_a_firm_one_at_none_but_the_lowest():
    s = script("ellipsoid")
    assert np.all(np.array(s.cof[s.light]) < s.noticed)
    assert np.array_equal(np.array(s.cof[s.firm]) < s.noticed, s.speeds < 2e-3)
    assert s.at_rest[0] == 0  # contact is lost: 30 of 50 µm, and the skin comes back late
    assert rising(s.at_rest)
    assert_allclose(s.of_parabola, s.at_rest[-1], rtol=2e-3)


def test_hyperboloid_goes_from_cone_to_paraboloid_with_one_critical_velocity():
    s = script("hyperboloid")
    assert_allclose([mdr.critical_velocity(case) for case in s.worn], 0.5 * KAPPA * 2 * np.pi * 200 * 40e-9, rtol=1e-12)
    assert_allclose([s.at_rest[0], s.at_rest[-1]], [s.of_cone, s.of_ball[-1]], rtol=0.01)
    assert rising(s.at_rest[::-1])


def test_rough_faces_lose_up_to_a_velocity_in_proportion_to_their_length():
    s = script("rough_face")
    assert_allclose(s.v_c, s.law, rtol=1.1e-4)  # the patch of first touch bears a ten thousandth of the load
    assert_allclose([curve.static_cof for curve in s.curves.values()], 0.4 * 0.8, rtol=1e-3)


def test_truncated_cone_worn_loses_more_friction_as_it_is_less_deep():
    s = script("truncated_cone")
    assert_allclose(s.full, s.eq_15[s.marked], rtol=0.01)
    assert rising(s.eq_15)
    assert rising(s.at_rest[::-1])
    assert rising(s.at_rest[0], s.runs[1].cof, s.runs[0].cof, 0.8)


def test_truncated_paraboloid_at_rest_has_the_least_load_and_velocities_go_with_one_over_the_radius():
    s = script("truncated_paraboloid")
    assert_allclose(list(s.at_rest.values()), 0.7 * 0.1, rtol=1e-6)
    assert all(rising(0.07, values, 0.1) for values in s.cof.values())
    E_star, kappa = 0.5e9 / (1 - 0.46**2), (2 - 0.46) / (2 * (1 - 0.46))
    a = (3 * 10 * 3e-3 / (4 * E_star)) ** (1 / 3)  # of Hertz, not yet worn
    assert_allclose(s.v_c[0], 0.1 * kappa * 2 * np.pi * 25 * 3 / (2 * E_star * a * np.sqrt(1.01)), rtol=1e-8)
    assert_allclose(np.interp(s.halved, s.flats, s.v_c), s.v_c[0] / 2, rtol=1e-3)


def test_rounded_punch_goes_from_punch_to_paraboloid():
    s = script("rounded_punch")
    unit = 0.6 * (2 - 0.32) / (2 * (1 - 0.32)) * 2 * np.pi * 20 * 300 * (1 - 0.32**2) / 115e9
    assert_allclose(s.v_c["sharp punch"], unit / 1e-3, rtol=1e-10)
    assert_allclose(s.psi, [1 - 0.6 * psi(v) for v in s.shares], atol=1e-4)
    assert rising(s.departure["sharp punch"], s.departure["rounded punch"], s.departure["paraboloid"], 0.01)


def test_capped_cone_loses_what_the_small_amplitude_says_once_it_is_deep():
    s = script("capped_cone")
    assert_allclose(s.approximate[0.0], 2 * 5e-9 / s.depths * psi(1e-6 / s.v_c), rtol=1e-3)
    deep = s.depths > 200e-9
    for R in s.caps:
        assert_allclose(s.lost[R][deep], s.approximate[R][deep], rtol=0.01)
    assert rising([*s.one_per_cent.values()][::-1])  # blunt tips sooner
    assert s.one_per_cent[1000e-9] > 0.8 * s.one_per_cent[0.0]  # but not by much


def test_capped_paraboloid_slides_most_easily_on_a_rubber_in_between():
    s = script("capped_paraboloid")
    middle = np.mean([abs(s.K_z).min(), abs(s.K_z).max()])
    assert_allclose(abs(s.K_z - middle), abs(s.K_z - middle)[0], rtol=1e-2)  # the stiffness runs on a half circle
    assert 0 < np.argmin(s.cof) < s.cof.size - 1
    assert_allclose(s.full, [np.interp(tau, s.times, s.v_c) for tau in s.some], rtol=0.05)


def test_constant_pressure_punch_and_ball_share_eq_15_and_eq_1_and_part_in_full_slip():
    s = script("constant_pressure")
    assert np.ptp(s.eq_15, axis=1).max() < 1e-12 * s.eq_15.max()
    seal, punch, ball = np.abs(s.full / s.eq_15 - 1)[-1]
    assert rising(punch, 1e-5, ball, 1e-3, 0.005, seal)
    assert rising(s.at_rest[-1][[1, 0, 2]])


def test_concave_punch_is_a_flat_punch_in_all_but_its_force():
    s, h, root = script("concave_punch"), 250e-6, np.sqrt(1 + 0.3**2)
    assert_allclose([s.h, s.limit], [h, 150e-6 / root], rtol=1e-12)
    assert_allclose(s.at_rest, 0.9 * (1 - s.amplitudes * root / (400e-6 + h / 3)), rtol=1e-8)
    assert_allclose(s.full, s.v_c[[0, -1]], rtol=1e-8)
    assert_allclose(s.of_punch.cof, s.curves[1.0].cof, atol=2e-5)


def test_sampled_profile_without_noise_is_the_shape_and_with_it_scatters():
    s = script("sampled_profile")
    exact = mdr.SampledProfile(s.r, s.truth.profile_3d(s.r), kinks=(s.edge,))
    assert_allclose(s.predictions(exact), s.true, rtol=1e-8)
    scatter = np.array([s.scatter[noise] for noise in s.noises])
    assert np.all(np.diff(scatter, axis=0) > 0)
    assert np.all(scatter[:, 0] > scatter[:, 1:].max(axis=1))  # the force is the hardest to tell


def test_from_force_foretells_friction_better_than_a_fitted_ball():
    s = script("from_force")
    truth = s.predicted["the tip"]
    curve, ball = (np.abs(s.predicted[name] / truth - 1) for name in ("from the curve", "fitted ball"))
    assert np.all((curve < 3e-3) & (ball > 5 * curve))
    assert np.all(s.scatter < 3e-3)


def test_profile_of_more_facets_comes_closer_to_the_ball():
    s, force = script("profile"), np.array([off[0] for off in script("profile").errors.values()])
    order = -np.diff(np.log(force)) / np.diff(np.log(list(s.errors)))
    assert np.all((order > 1.7) & (order < 3))  # two, but for where the edge falls between corners
    assert_allclose(s.force(s.shapes[1]), s.force(mdr.Cone(np.arctan(0.7e-3 / 20e-3))), rtol=1e-8)


def test_elasticities_are_greatest_where_contact_is_just_kept_and_then_those_of_a_damper():
    s = script("elasticities")
    amplitude, velocity = (s.elasticity[name] for name in ("amplitude", "velocity"))
    assert s.study.count(mdr.studies.Status.DONE) == s.study.status.size
    assert amplitude[:, 0].min() < -2
    assert 0.8 <= s.alpha[np.argmin(amplitude[:, 0])] < 1
    assert np.all(amplitude[:, s.speed > 1] == 0)
    assert np.all(amplitude[s.alpha > 1.2] > -1)
    lost = s.alpha > 1.2  # a damper, but for a slip before the ball is lifted off, whose velocity is sqrt(1 - 1/alpha²)
    assert np.all(np.abs(velocity[lost, 0] - 1) < s.speed[0] / np.sqrt(1 - s.alpha[lost] ** -2))
    lag, slope, unit = psi(0.05), (psi(0.06) - psi(0.04)) / 0.02, 1.5 * 0.1  # k_zc du_z over the load of a ball
    assert_allclose(amplitude[0, 0], -unit * (lag - 0.05 * slope) / (1 - unit * lag), rtol=0.1)  # alpha = 0.1


def test_half_the_friction_of_a_pad_takes_a_fifth_of_the_power_and_no_room():
    s = script("quiet_slide")
    for found in (s.roomy, s.sparing):
        run = mdr.slide(found.case, s.up_to)
        assert found.met
        assert_allclose(run.cof, found.reached["cof_at_most"], atol=1e-5)
        assert_allclose(run.power["normal"], found.power, rtol=1e-6)
    assert s.sparing.power < 0.25 * s.roomy.power
    assert s.sparing.values["frequency"] < 0.5 * s.roomy.values["frequency"]
    frequency = [one.values["frequency"] for one in s.front.designs]
    assert np.ptp(s.front.power / np.square(frequency)) < 0.01 * s.front.power[0] / frequency[0] ** 2
    assert s.met(s.known["most room"]) > 0.9
    assert abs(s.met(s.known["least power"]) - 0.5) < 0.1


def test_gallery_shapes_are_equally_stiff_and_lose_by_what_they_carry():
    s = script("gallery")
    share = {"flat punch": 1, "cone": 1 / 2, "paraboloid": 2 / 3, "power law $r^4$": 4 / 5, "from force": 1 / 1.7}
    assert_allclose([s.share[name] for name in share], list(share.values()), rtol=1e-9)
    assert_allclose([shape.contact_radius(40e-6) for shape in s.shapes.values()], 1e-3, rtol=1e-9)
    for name, curve in s.curves().items():  # (k_zc du_z/F_N) psi(0), for a small amplitude: here a quarter
        assert_allclose(1 - curve[0], 0.25 / s.share[name], rtol=0.1)
        assert_allclose(curve[s.v_hat > 1], 1, rtol=1e-8)
    assert_allclose(list(s.full().values()), s.eq_15, rtol=0.01)


def test_depths_matter_to_all_but_punches_and_most_to_the_cone():
    s = script("depths")
    for name, touching in (("flat punch", 4), ("concave punch", 3)):
        full = s.full[s.ordered.index(name)]
        assert_allclose(full[np.isfinite(full)], s.eq_15[0, 2], rtol=1e-9)
        assert np.isfinite(full).sum() == touching
    assert s.ordered[-1] == "cone"
    assert np.nanmax(np.abs(s.full / s.eq_15 - 1)) < 0.01


def test_rubber_slider_has_half_its_friction_where_the_table_says():
    s = script("rubber_slider")
    amplitudes, omegas = s.coarse.axes["oscillation.du_z"], s.coarse.axes["oscillation.omega"]
    for omega, needed in zip(omegas, s.needed, strict=True):
        # 6 % about the amplitude that halves the static friction: linear between 27 and 50 % of the depth
        near = [mdr.NormalOscillation(s.depth, needed / share, omega) for share in (1.06, 0.94)]
        low, high = (mdr.static_cof(replace(s.foot, oscillation=motion)) for motion in near)
        assert low >= 0.4 >= high
    for i, j in ((0, 4), (1, 2), (2, 3)):
        run = mdr.slide(
            replace(s.foot, oscillation=mdr.NormalOscillation(s.depth, amplitudes[j], omegas[i])), s.fastest[i, j]
        )
        assert run.cof == pytest.approx(0.4, abs=0.05)  # linear between velocities that differ by a factor of 2.7
    assert np.max(s.share_of_v_c) < 0.3


def test_ultrasonic_sliding_is_near_the_rigid_law_up_to_the_knee():
    s = script("ultrasonic_sliding")
    assert rising(s.knees[::-1])
    for load in s.loads:
        assert_allclose(s.held[load] / 0.2, np.maximum(1 - s.some_chi, 0) ** 1.5, atol=1e-5)  # BUDGET of a run
    for curve, knee, chi in zip(s.curves, s.knees, s.chi, strict=True):
        more = curve.cof / 0.2 - s.rigid_law(s.shares)
        assert np.all(more > -1e-5)
        assert chi < 4 or more[s.shares <= knee].max() < 0.06
    energy = s.run.energy_balance
    assert energy.pull_work + energy.shake_work > 2 * np.pi / s.omega * 0.2 * 20 * 0.1  # nothing is saved


def test_piezo_drive_pushes_by_time_shares_less_the_deflection():
    s = script("piezo_drive")
    assert_allclose([s.even.low, s.even.high], 0, atol=1e-6)
    assert 1.5 * s.deflection < s.least_stroke < 2.1 * s.deflection
    for drive in s.sawtooths:
        assert rising(drive.thrust[0], s.stiff.thrust[0], 1 - 2 * 0.1)
        assert drive.efficiency.max() < s.stiff.efficiency.max() < 0.8 / 1.8
    rigid, heavy, _, light = s.of_mass
    assert_allclose(heavy, rigid, rtol=0.01)
    assert light < 0.5 * rigid
    for values in zip(*((d.thrust[0], d.no_load, d.efficiency.max()) for d in s.ellipses), strict=True):
        assert rising(values[::-1])  # an ellipse gives more the more it taps
    for drive in (*s.sawtooths, *s.ellipses):
        assert_allclose(drive.thrust[-1], 0, atol=2e-4)  # runs good to 1e-4
        assert rising(drive.thrust[::-1])


def test_other_laws_miss_what_springs_meet():
    s = script("other_laws")
    assert len(s.errors) == 20
    for path, (springs, smoothed, dahl, one, rescaled) in s.errors.items():
        assert springs < 5e-5
        assert min(smoothed, dahl) > 0.09
        elastic_punch = path in ("punch_legs", "punch_circle")
        assert (max(one, rescaled) < 5e-3) == elastic_punch
    assert_allclose([s.lost["exact"], s.lost["springs"], s.lost["one spring"]], 0, atol=1e-12)
    assert 0.1 < s.lost["Dahl"] < 0.2


def test_implicit_host_is_of_second_order_and_holds_and_rk45_is_not_helped_by_its_tolerance():
    s = script("host_implicit")
    order = -np.diff(np.log(s.errors)) / np.diff(np.log(s.per_period))
    assert_allclose(order[1:], 2, atol=0.15)
    assert rising(s.errors[::-1])
    assert s.unbalanced[-1] < 1e-3
    for n, run in s.runs.items():
        with_K, at_rest = (len(one) for one in run.newton)
        assert with_K <= min(4, at_rest), n
    first, second, *_ = s.runs[12].newton[0]
    assert second < 1e-3 * first
    assert abs(s.creep) < 1e-5
    for rtol in s.tolerances[1:]:
        way, loss = s.wrong[rtol]
        assert way > 2 * s.errors[2]
        assert loss > 0.03


def test_host_co_simulation_is_as_good_as_its_steps_are_short():
    s = script("host_co_simulation")
    assert_allclose(s.error[:4] / s.steps[:4], 0.7, rtol=0.3)  # first order
    assert min(s.error[5:]) > 0.3
    assert rising(s.error)
    assert rising(s.of_rolled)
    for (*_, calls), off in zip(s.rolled, s.of_rolled, strict=True):  # within a factor of two of equal steps
        assert 0.5 < off / np.exp(np.interp(np.log(calls), np.log([c for *_, c in s.fixed[::-1]]),
                                            np.log(s.error[::-1]))) < 2  # fmt: skip


def test_steel_slide_meets_all_bars_with_a_rough_face_or_with_a_punch_whose_friction_falls():
    s = script("steel_slide")
    for (face, limit, bar), (forces, deflection) in s.found.items():
        assert_allclose(forces[s.bars[bar]], s.vibrated[s.bars[bar]], rtol=1e-6)
        if limit == "constant":
            assert rising(forces)
            assert_allclose(deflection, deflection[0])
        elif bar == "at rest":
            meets = "flat punch" if limit == "falling" else "rough face"
            assert (np.abs(forces - s.vibrated).max() < 0.08) == (face == meets)
    # a flat punch at rest: mu_0 F_N less the force of the amplitude, Eq. (6) of the author's later paper
    assert_allclose(s.kept("flat punch", 0.7, 0.0), 0.3, rtol=1e-9)
