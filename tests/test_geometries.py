"""The scripts in geometries/: what they print, against the formulas written out here."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr

FOLDER = Path(__file__).parents[1] / "geometries"
KAPPA = 1.5  # all scripts: incompressible, (2 - nu)/(2 (1 - nu))
loaded = {}


def script(name):
    """The module geometries/<name>.py, run once."""
    if name not in loaded:
        spec = importlib.util.spec_from_file_location(f"geometries_{name}", FOLDER / f"{name}.py")
        loaded[name] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(loaded[name])
    return loaded[name]


def eq_15(mu_0, E, a, tau, du_z, omega, k_x, m, c_x=0.0):
    """Eq. (15) in complex form, from the numbers on the page; a is the contact radius at the mean depth."""
    K_z = 2 * E / 0.75 * a * (1 + 1j * omega * tau)
    return mu_0 * omega * du_z * abs(KAPPA + K_z / (k_x - m * omega**2 + 1j * omega * c_x))


NAMES = sorted(path.stem for path in FOLDER.glob("*.py"))


def test_every_basic_shape_has_its_script():
    assert {"flat_punch", "cone", "paraboloid", "power_law"} <= set(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_figure_is_a_figure_and_leaves_no_style_behind(name):
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt

    size = mpl.rcParams["font.size"]
    fig = script(name).figure()
    fig.canvas.draw()
    assert all(ax.get_title() and ax.has_data() for ax in fig.axes if not ax.get_ylabel().startswith("off"))
    assert mpl.rcParams["font.size"] == size
    plt.close(fig)


# --- flat punch ---


def test_flat_punch_velocities_are_eq_15():
    s, omega = script("flat_punch"), 2 * np.pi * 100
    expected = [eq_15(0.8, 3e6, 5e-3, T / omega, 15e-6, omega, k_x=2e3, m=0.2) for T in s.loss_tangents]
    assert_allclose(s.v_c, expected, rtol=1e-12)


def test_flat_punch_at_rest_is_eq_7_and_nothing_once_contact_is_lost():
    s = script("flat_punch")
    expected = [0.8 * (1 - 0.3 * np.sqrt(1 + T**2)) for T in s.loss_tangents]
    assert_allclose(s.static, expected, rtol=1e-6)  # the least of 8192 instants: (pi/8192)**2 / 2 of the amplitude
    assert_allclose(s.lost_above, [50e-6 / np.sqrt(1 + T**2) for T in s.loss_tangents], rtol=1e-12)
    assert max(s.at_rest_beyond) == 0


def test_flat_punch_has_its_friction_back_above_v_c_and_not_below():
    s = script("flat_punch")
    for curve in s.curves:
        assert curve.settled.all()
        assert np.all(np.diff(curve.cof) > 0)
        assert_allclose(curve.cof[s.shares > 1], 0.8, rtol=1e-6)
        assert np.all(curve.cof[s.shares < 1] < 0.8 * (1 - 1e-4))


# --- cone ---


def test_cone_velocities_are_eq_15_at_the_stiffness_of_each_depth():
    s, omega = script("cone"), 2 * np.pi * 60
    a = s.depths / (np.pi / 2 * np.tan(0.05))
    assert_allclose(s.eq_15, [eq_15(0.6, 1e6, at, 0, 4e-6, omega, 300, 0.01, 0.8) for at in a], rtol=1e-12)
    assert_allclose(s.eq_1, 0.6 * KAPPA * omega * 4e-6, rtol=1e-12)
    assert np.ptp(s.of_punch) == 0  # its stiffness knows no depth


def test_cone_is_slowest_where_stiffness_and_inertia_balance():
    s = script("cone")
    assert abs(s.depths[np.argmin(s.eq_15)] - s.balanced) <= 0.5e-6 * 1.01  # half the step of the depths
    # with |1 - k_xc/(A - iB)| least at k_xc = A, where it is B/sqrt(A² + B²)
    A, B = 0.01 * s.omega**2 - 300, s.omega * 0.8
    assert_allclose(s.eq_15.min() / s.eq_1, B / np.hypot(A, B), rtol=1e-3)


def test_cone_measured_agrees_with_all_harmonics_and_not_with_eq_15():
    s = script("cone")
    for depth, verdict in s.verdicts.items():
        assert_allclose(verdict.measured, verdict.full_slip, rtol=1e-4)  # accuracy of a measured v_c
        assert_allclose(np.interp(depth, s.depths, s.full), verdict.full_slip, rtol=1e-3)
        assert not verdict.holds
    assert -0.01 < s.verdicts[s.shallow].deviation < -0.001
    assert 0.01 < s.verdicts[s.deep].deviation < 0.02


def test_cone_run_slips_at_the_edge_before_the_centre():
    run = script("cone").run
    first = [np.argmax(run.state[:, i] == mdr.State.SLIP) for i in (0, np.searchsorted(run.x, 0.75 * run.x[-1]))]
    assert 0 < first[1] < first[0]


# --- paraboloid ---


def test_paraboloid_sweep_is_eq_15_through_pole_and_zero():
    s = script("paraboloid")
    a = np.sqrt(2e-3 * 20e-6)
    tau = 0.1 / (2 * np.pi * 1e3)
    expected = [eq_15(0.7, 10e6, a, tau, 3e-6, 2 * np.pi * f, 2e3, 1e-3, 0.3) for f in s.sweep]
    assert_allclose(s.eq_15, expected, rtol=1e-12)
    ratio = s.eq_15 / s.eq_1
    assert_allclose(s.sweep[np.argmax(ratio)], s.f_0, rtol=0.05)  # the damper, 10 % of critical, moves both a little
    assert_allclose(s.sweep[np.argmin(ratio)], s.f_1, rtol=0.05)
    assert_allclose(ratio[-1], 1, rtol=1e-3)  # (omega_1² - omega_0²)/omega² = 6e-4 at 20 kHz


def test_paraboloid_friction_is_lowered_where_v_c_exceeds_the_speed():
    s = script("paraboloid")
    assert all(run.settled for run in s.runs)
    lowered = np.interp(s.shaken, s.sweep, s.eq_15) > s.v_0
    assert lowered.any()
    assert not lowered.all()
    assert np.array_equal(s.cof < 0.7 - 1e-4, lowered)
    for f in (300, 20e3):
        assert s.cof[s.shaken == f] > mdr.static_cof(s.slider(f))


def test_paraboloid_static_limit_of_a_slow_oscillation_is_hertz():
    s, alpha = script("paraboloid"), 3 / 20
    phase = 2 * np.pi * np.arange(64) / 64
    expected = 0.7 * (1 - alpha) ** 1.5 / np.mean((1 + alpha * np.cos(phase)) ** 1.5)
    assert_allclose(s.static[0], expected, rtol=1e-4)  # T = 0.005 at 50 Hz, of second order
    assert_allclose(s.wave_over_radius, np.sqrt(10e6 / 3 / 1100) / 20e3 / 0.2e-3, rtol=1e-12)


# --- power law ---


def brute_psi(v_hat):
    """Mean lag of one spring behind full slip: its extension is inf over theta >= 0 of cos(t - theta) + v_hat theta."""
    t = 2 * np.pi * np.arange(360) / 360
    theta = np.linspace(0, 2 * np.pi, 1441)
    return -np.mean(np.min(np.cos(t[:, None] - theta) + v_hat * theta, axis=1))


def test_power_laws_are_equally_stiff_and_carry_n_over_n_plus_1():
    s = script("power_law")
    for n in s.exponents:
        share = 1 if np.isinf(n) else n / (n + 1)
        assert_allclose(s.tip(n).contact_radius(40e-6), 1e-3, rtol=1e-12)
        assert_allclose(s.tip(n).force(40e-6, 1.0), share * 2e-3 * 40e-6, rtol=1e-12)


@pytest.mark.parametrize("alpha", [0.3, 0.03])
def test_power_laws_at_rest(alpha):
    """F_N ~ d**(1 + 1/n): the least force over the mean one, by the trapezoidal rule."""
    s = script("power_law")
    phase = 2 * np.pi * np.arange(64) / 64
    for n in s.exponents:
        power = 1 + 1 / n
        lost = 1 - (1 - alpha) ** power / np.mean((1 + alpha * np.cos(phase)) ** power)
        assert_allclose(s.collapsed[n, alpha][0], lost / (power * alpha), rtol=1e-8)


def test_power_laws_collapse_on_psi_in_proportion_to_the_amplitude():
    s = script("power_law")
    large, small = s.amplitudes
    assert_allclose(s.psi, [brute_psi(v) for v in s.v_hat], atol=1e-4)
    assert max(s.departure[np.inf, alpha] for alpha in s.amplitudes) < 1e-5 / 0.03  # the budget of the COF, scaled
    for n in s.exponents[:-1]:
        assert s.departure[n, small] < 0.3 * small / n  # the cone at rest: alpha/4, and 1/n for the others
        assert 8 < s.departure[n, large] / s.departure[n, small] < 20  # first power of ten times the amplitude
    at_rest = [s.curves[n, large].cof[0] for n in s.exponents]
    assert np.all(np.diff(at_rest) > 0)  # blunter tips keep more
