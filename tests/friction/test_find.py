"""find(): every value that does what is asked, against closed forms and a fine grid; and why there is none."""

from dataclasses import replace

import numpy as np
import pytest
from conftest import contact
from numpy.testing import assert_allclose

import mdr
from mdr.friction import find as module
from mdr.friction.cof_curve import friction_at
from mdr.given.vary import case_at
from mdr.march.periodic.steady import BUDGET, LEAST_ACCURATE

BALL, RUBBER, OMEGA = mdr.Paraboloid(R=5e-3), mdr.KelvinVoigt(E=3e6, nu=0.5, tau=2e-4), 314.0
CASE = mdr.SlidingContact(BALL, RUBBER, 0.5, mdr.NormalOscillation(20e-6, 4e-6, OMEGA))
BODY = replace(CASE, material=mdr.Elastic(E=3e6, nu=0.3), pull=mdr.SpringPull(k_x=2e3, m=0.1))


@pytest.mark.parametrize(
    ("path", "within"),
    [("du_z", (1e-6, 18e-6)), ("oscillation.u_z0", None), ("alpha", (0.1, 0.9)), ("frequency", (5.0, 500.0)),
     ("load", None), ("mu_0", (0.1, 2.0)), ("material.tau", (1e-5, 1e-1))],
)  # fmt: skip
def test_friction_is_found_where_a_fine_grid_passes_it(path, within):
    v_0, cof = 0.4 * mdr.critical_velocity(CASE), 0.42
    found = mdr.find(CASE, path, v_0=v_0, cof=cof, within=within)
    low, high = within or (1e-1 * found.values[0], 10 * found.values[0])
    grid = np.geomspace(low, high, 30)
    beside = np.array([mdr.cof_curve(case_at(CASE, {found.path: value}), v_0).cof[0] for value in grid]) - cof
    passed = np.flatnonzero(beside[1:] * beside[:-1] < 0)
    if within:
        assert len(found.values) == len(passed) > 0
        assert all(grid[i] <= value <= grid[i + 1] for i, value in zip(passed, found.values, strict=True))
    for case in found.cases:
        assert_allclose(mdr.cof_curve(case, v_0).cof[0], cof, rtol=1e-9)
    assert found.why == ""


def eq_15_roots(v_c):
    """Both stiffnesses at which Eq. (15) of an undamped body is v_c."""
    size = v_c / (BODY.mu_0 * BODY.oscillation.du_z * OMEGA * BODY.k_zc / BODY.k_xc)
    return sorted(BODY.pull.m * OMEGA**2 - BODY.k_xc / (1 + sign * size) for sign in (-1, 1))


def test_the_amplitude_of_a_waveform_is_found():
    """alpha sets the amplitudes of a series together: the waveform stays, and so does its mean."""
    wave = mdr.waveforms.sawtooth(20e-6, 2e-6, 300.0, n_harmonics=4)
    case = replace(contact("paraboloid", nu=0.5), oscillation=wave)
    found = mdr.find(case, "alpha", cof=0.33, v_0=1e-4)
    (case,), (alpha,) = found.cases, found.values
    larger = case.oscillation
    assert_allclose(mdr.cof_curve(case, [1e-4]).cof, 0.33, rtol=1e-4)
    assert_allclose(larger.cycle.du_z, alpha * 20e-6, rtol=1e-9)
    assert_allclose(np.array(larger.sin) / larger.sin[0], np.array(wave.sin) / wave.sin[0], rtol=1e-12)
    assert larger.u_z0 == wave.u_z0
    study = mdr.sweep(
        case, {"alpha": [alpha, 2 * alpha]}, quantities=["static_cof"], held={"load": 0.05, "hold": "load"}
    )
    assert study["static_cof"][1] < study["static_cof"][0]
    held = case_at(case, {"alpha": 2 * alpha, "load": 0.05, "hold": "load"})
    assert study["static_cof"][1] == mdr.static_cof(held)
    assert_allclose([mdr.resolved(held).alpha, mdr.studies.CATALOGUE["mean_F_N"].of(held)], [2 * alpha, 0.05])
    with pytest.raises(ValueError, match="alpha must be positive about a depth above zero"):
        case_at(case, {"alpha": -0.1})


@pytest.mark.parametrize("share", [0.5, 1e-2, 1e-4])
def test_two_stiffnesses_have_one_critical_velocity_however_near_they_are(share):
    """Between them v_c falls to zero: a thousandth of their value apart, they lie between two points of the scan."""
    v_c = share * mdr.critical_velocity(replace(BODY, pull=mdr.RigidPull()))
    found = mdr.find(BODY, "k_x", v_c=v_c, within=(1e3, 2e4))
    expected = [k_x for k_x in eq_15_roots(v_c) if 1e3 < k_x < 2e4]
    assert len(expected) == 2
    assert_allclose(found.values, expected, rtol=1e-7)


def test_a_resonance_is_jumped_over_by_no_root():
    """v_c is infinite at k_x = m omega²: above the wish on both sides, and no value of it."""
    v_c = 50 * mdr.critical_velocity(replace(BODY, pull=mdr.RigidPull()))
    found = mdr.find(BODY, "k_x", v_c=v_c, within=(1e3, 2e4))
    assert_allclose(found.values, [k_x for k_x in eq_15_roots(v_c) if 1e3 < k_x < 2e4], rtol=1e-7)


def test_a_load_is_held_while_the_modulus_is_sought():
    load, v_0 = 0.05, 0.3 * mdr.critical_velocity(CASE)
    rested = mdr.parse_case(mdr.write_case(CASE).replace("u_z0 = 2e-05", f"load = {load}"))
    softer = case_at(rested, {"material.E": 2e6, "load": load})
    wanted = mdr.cof_curve(softer, v_0).cof[0]
    found = mdr.find(rested, "E", v_0=v_0, cof=wanted, within=(1e6, 1e7), held={"load": load})
    (case,), (E,) = found.cases, found.values
    assert case.material.E == E
    assert_allclose(E, 2e6, rtol=1e-7)
    assert_allclose(case.oscillation.u_z0, mdr.static_depth(BALL, case.material, load), rtol=1e-12)


def test_trial_runs_are_coarse_and_the_answer_is_not(monkeypatch):
    """The side of a value needs a run whose error is less than what it misses; the value itself full accuracy."""
    asked = []

    def friction(one, v, accuracy):
        asked.append(accuracy)
        return friction_at(one, v, accuracy)

    monkeypatch.setattr(module, "friction_at", friction)
    v_0 = 0.5 * mdr.critical_velocity(BODY)
    (value,) = mdr.find(BODY, "du_z", v_0=v_0, cof=0.45, within=(1e-6, 5e-6)).values
    run = mdr.slide(case_at(BODY, {"oscillation.du_z": value}), v_0)
    assert abs(run.cof - 0.45) <= 0.02 * run.cof_error
    assert asked.count(BUDGET) <= 8 < asked.count(LEAST_ACCURATE)


@pytest.mark.parametrize("case", [CASE, BODY], ids=["rigid", "body"])
def test_the_velocity_of_a_share(case):
    found = mdr.find(case, "v_0", share=0.95)
    assert found.cases == (case,) * len(found.values)
    for v_0 in found.values:
        assert_allclose(mdr.slide(case, v_0).share, 0.95, atol=1e-6)
    assert_allclose(mdr.find(case, "v_0", cof=0.95 * case.mu_0).values, found.values, rtol=1e-6)


def test_the_velocity_of_a_share_is_that_of_what_is_held():
    (found,) = mdr.find(CASE, "v_0", share=0.9, held={"frequency": 100.0}).cases
    assert_allclose(found.omega, 200 * np.pi)
    assert found == mdr.find(found, "v_0", share=0.9).cases[0]


def test_of_the_velocity_there_is_one_wish():
    for wish in ({"v_0": 1e-3, "share": 0.9}, {"v_c": 1e-3}, {"cof": 0.1, "share": 0.9}, {}):
        with pytest.raises(ValueError, match="of v_0 give one wish: cof, share or smooth"):
            mdr.find(CASE, "v_0", **wish)


NONE = [
    ({"path": "v_0", "share": 0.1},
     "none: the share lies between 0.71"),
    ({"path": "du_z", "v_0": 1e-2, "cof": 0.1, "within": (1e-6, 2e-6)},
     "none: the COF at 10 mm/s is 0.5 for oscillation.du_z from 1 µm to 2 µm, and 0.1 is asked for"),
    ({"path": "du_z", "v_0": 1e-4, "cof": 0.1, "within": (1e-6, 2e-6)}, "none: the COF at 100 µm/s lies between 0.4"),
    ({"path": "E", "v_c": 1.0}, "none: v_c is 942 µm/s for material.E from 300 kPa to 30 MPa, and 1 m/s is asked for"),
    ({"path": "nu", "v_c": 1.0, "within": (0.6, 0.9)}, "none: there is no such case from 0.6 to 0.9: nu must lie in"),
    ({"path": "nu", "v_c": 1.0, "within": (0.1, 0.9)}, "not everywhere: nu must lie in"),
]  # fmt: skip


@pytest.mark.parametrize(("asked", "words"), NONE)
def test_it_says_why_there_is_none(asked, words):
    found = mdr.find(CASE, **asked)
    assert found.values == found.cases == ()
    assert words in found.why
    assert str(found) == found.why


def test_a_run_that_does_not_settle_is_no_answer(monkeypatch):
    v_0 = 0.4 * mdr.critical_velocity(CASE)

    def friction(one, v, accuracy):
        cof, error, _ = friction_at(one, v, accuracy)
        return cof, error, "" if one.oscillation.du_z < 4.5e-6 else "the run did not settle"

    monkeypatch.setattr(module, "friction_at", friction)
    wanted = [mdr.cof_curve(case_at(CASE, {"oscillation.du_z": du_z}), v_0).cof[0] for du_z in (4e-6, 5e-6)]
    seen, unseen = (mdr.find(CASE, "du_z", v_0=v_0, cof=cof, within=(3e-6, 6e-6)) for cof in wanted)
    assert_allclose(seen.values, [4e-6], rtol=1e-9)
    assert seen.why == "not looked at everywhere, as a case cannot be: the run did not settle"
    assert unseen.values == ()
    assert unseen.why.endswith("where there is a case, as not everywhere: the run did not settle")


def test_a_strength_is_found_from_the_friction_that_it_leaves():
    motion = mdr.NormalOscillation(20e-6, 5e-6, 300.0)
    case = mdr.SlidingContact(mdr.Paraboloid(5e-3), mdr.Elastic(3e6, 0.4), 0.2, motion, tau_0=1e4)
    study = mdr.sweep(case, {"tau_0": [0.0, 1e4], "v_0": [1e-3]})
    assert np.all(np.diff(study["cof"].ravel()) > 0)
    found = mdr.find(case, "tau_0", v_0=1e-3, share=0.99)
    assert mdr.slide(found.cases[0], 1e-3).share == pytest.approx(0.99, abs=1e-5)


def stage(vibration, size, over_swing=10.0, spring=2500.0, damping=0.1, velocity=0.3):
    """A body on a spring over a damped contact, mu_s = 1.5 mu_k, that a vibration of so many times its natural
    frequency takes `size` off the breakaway; its velocity, over Delta omega_0/k_x.
    """
    punch, omega_0 = mdr.FlatPunch(1e-3), 600.0
    k_xc, full = 2 * mdr.Elastic(3e6, 0.4).G_star * punch.a, 0.5 * punch.force(20e-6, mdr.Elastic(3e6, 0.4).E_star)
    k, omega = k_xc / spring, over_swing * omega_0
    m, material = k / omega_0**2, mdr.KelvinVoigt(3e6, 0.4, 1 / (omega_0 * np.sqrt(spring)))
    pull = mdr.SpringPull(k_x=k, m=m, c_x=2 * damping * m * omega_0)
    motion, shake = mdr.ConstantDepth(20e-6), None
    if vibration == "up and down":
        motion = mdr.NormalOscillation(20e-6, size * 20e-6, omega)
    elif vibration == "tool":
        shake = mdr.InPlaneOscillation(omega, du_x=size * 1.5 * full * abs(1 / k_xc - 1 / (m * omega**2)))
    else:
        du_x = size * 1.5 * full / np.hypot(k, omega * pull.c_x)
        shake = mdr.InPlaneOscillation(omega, du_x=du_x, at="pull")
    law = mdr.StaticKinetic(0.75, 0.5)
    case = mdr.SlidingContact(punch, material, oscillation=motion, pull=pull, friction=law, shake=shake)
    wanted = mdr.laws.dither_force(velocity * 0.5 * full * omega_0 / k, 1.5 * full, full, k, m, pull.c_x)
    return case, velocity * 0.5 * full * omega_0 / k, wanted / (1.5 * full)


@pytest.mark.parametrize(
    ("vibration", "path", "why"),
    [("up and down", "du_z", ""), ("tool", "du_x", ""), ("up and down", "frequency", "stick-slip again from 12")],
)
def test_where_stick_slip_ends_runs_beside_it_do_and_do_not_stick(vibration, path, why):
    case, v_0, _ = stage(vibration, 0.25)
    found = mdr.find(case, path, v_0=v_0, smooth=True)
    assert found.why[:24] == why
    (value,) = found.values
    for factor, sticks in ((0.98, True), (1.0, False), (1.02, False)):
        one = case_at(case, {found.path: factor * value})
        periods = round(12 * 2 * np.pi / 600.0 / one.period)
        run = mdr.slide(one, v_0, start="rest", n_periods=4 * periods, record=periods)
        went = np.diff(run.u_x.reshape(periods, -1)[:, -1]) / one.period
        assert (went.min() < 0.3 * v_0) == sticks
        assert (mdr.least_velocity(one, v_0) < 0.5 * v_0) == sticks


def test_the_faster_the_vibration_the_nearer_is_stick_slip_to_end_where_the_law_has_it():
    missed = []
    for over_swing in (10.0, 20.0):
        case, v_0, law = stage("up and down", 0.2, over_swing, spring=1e4)
        (alpha,) = mdr.find(case, "alpha", v_0=v_0, smooth=True, within=(law, 1.4 * law)).values
        missed.append(alpha / law - 1)
    assert 0 < missed[1] < 0.4 * missed[0] < 0.1


def test_a_vibration_across_the_slide_ends_stick_slip_too():
    case, v_0, _ = stage("up and down", 0.25, over_swing=5.0, spring=100.0)
    bears = case.friction.mu_s * case.material.mindlin_ratio * 20e-6  # the deflection at which springs slip
    for size, sticks in ((0.1, True), (0.8, False)):
        shake = mdr.InPlaneOscillation(3000.0, du_y=size * bears)
        across = replace(case, oscillation=mdr.ConstantDepth(20e-6), material=mdr.Elastic(3e6, 0.4), shake=shake)
        assert (mdr.least_velocity(across, v_0) < 0.5 * v_0) == sticks


@pytest.mark.filterwarnings("ignore::mdr.PlausibilityWarning")
def test_there_is_no_end_of_stick_slip_where_all_is_smooth_or_nothing():
    case, v_0, law = stage("up and down", 0.25)
    for within, words in (((0.01, 0.5 * law), "none: stick-slip from"), ((0.5, 0.6), "none: no stick-slip, pulled")):
        found = mdr.find(case, "alpha", v_0=v_0, smooth=True, within=within)
        assert found.values == ()
        assert found.why.startswith(words)
    plain = replace(case, friction=mdr.Coulomb(0.5))
    assert mdr.find(plain, "alpha", v_0=v_0, smooth=True, within=(0.1, 0.2)).why.startswith("none: no stick-slip")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"pull": mdr.RigidPull()}, "least_velocity takes a body with a mass"),
        ({"v_0": 1e-12}, "takes .* periods of the vibration, more than 1000000: raise v_0"),
        ({"v_0": -1.0}, "v_0 must be positive"),
    ],
)
def test_what_least_velocity_does_not_take_is_refused(change, words):
    case, v_0, _ = stage("up and down", 0.25)
    v_0 = change.pop("v_0", v_0)
    with pytest.raises(ValueError, match=words):
        mdr.least_velocity(replace(case, **change), v_0)
