"""design() and front(): the most room by hand where it is known, targets met by runs, and what cannot be met."""

from dataclasses import replace

import numpy as np
import pytest
from conftest import contact

import mdr
from mdr.friction import room_search
from mdr.friction.target import DETUNED

CONE = contact("cone", 10.0, nu=0.5)  # elastic, under a rigid pull: in closed form
RUBBER = contact("cone", 10.0, T=0.3)
BODY = contact("cone", 5.0, k_ratio=0.5, omega_0_ratio=1.6)
UM = 1e-6


def v_c(case):
    return mdr.critical_velocity(case)


def test_a_target_of_one_limit_is_met_with_the_most_room():
    """Eq. (1) is a product of frequency and amplitude: both are at their highest."""
    target = mdr.Target(v_c_at_least=v_c(CONE))
    found = mdr.design(CONE, target, {"du_z": (1 * UM, 4 * UM), "oscillation.omega": ("10Hz", "200Hz")})
    assert found.met
    assert found.values == pytest.approx({"oscillation.du_z": 4e-6, "oscillation.omega": 400 * np.pi})
    assert found.reached["v_c_at_least"] == pytest.approx(v_c(found.case), rel=1e-9)
    times = np.log(found.reached["v_c_at_least"] / target.v_c_at_least)
    assert found.room["v_c_at_least"] == pytest.approx(times / (1 + times))
    assert found.active == ("v_c_at_least", "oscillation.du_z at its highest", "oscillation.omega at its highest")
    assert (found.why, found.stopped, found.power) == ("", "", None)


def test_two_limits_meet_where_their_rooms_are_alike():
    """Friction between 0.2 and 0.3 mu_0: in the middle, as friction falls with the amplitude."""
    low, high, v_0 = 0.2 * CONE.mu_0, 0.3 * CONE.mu_0, 0.2 * v_c(CONE)
    found = mdr.design(CONE, mdr.Target(cof_at_most=high, cof_at_least=low, up_to=v_0), {"du_z": ("1um", "19um")})
    assert found.room["cof_at_most"] == pytest.approx(found.room["cof_at_least"], abs=1e-3)
    assert found.active == ("cof_at_most", "cof_at_least")
    slow, fast = (mdr.slide(found.case, part * v_0).cof for part in (0.125, 1.0))
    assert (found.reached["cof_at_least"], found.reached["cof_at_most"]) == pytest.approx((slow, fast), abs=1e-5)
    assert found.met == (slow >= low and fast <= high)


def test_what_cannot_be_met_is_said_with_what_limits_it():
    v_0 = v_c(CONE)
    found = mdr.design(CONE, mdr.Target(cof_at_most=0.05, up_to=v_0), {"du_z": (1 * UM, 3 * UM)})
    assert not found.met
    assert found.active == ("cof_at_most", "oscillation.du_z at its highest")
    assert found.why.startswith("cof_at_most = 0.05 is missed: ")
    assert found.reached["cof_at_most"] == pytest.approx(mdr.slide(found.case, v_0).cof, abs=1e-5)
    assert "the target is not met" in str(found)


@pytest.mark.parametrize(
    ("limit", "at"), [({"cof_at_most": -5.0}, 19), ({"cof_at_least": 5.0}, 1), ({"cof_at_most": 5.0}, 19)]
)
def test_limits_beyond_all_friction_are_answered(limit, at):
    """Missed or met, with the least friction or the most: no room is taken for that of what is no case."""
    found = mdr.design(CONE, mdr.Target(**limit, up_to=0.2 * v_c(CONE)), {"du_z": (1 * UM, 19 * UM)})
    assert found.values["oscillation.du_z"] == pytest.approx(at * UM, rel=1e-3)
    assert found.met == (limit == {"cof_at_most": 5.0})
    assert all(-2 <= room <= 2 for room in found.room.values())


def test_no_design_is_on_a_resonance():
    """Eq. (2) is infinite at omega_0 of an undamped body, which lies within the range."""
    at = BODY.pull.omega_0
    found = mdr.design(BODY, mdr.Target(v_c_at_least=v_c(BODY)), {"oscillation.omega": (0.5 * at, 2 * at)})
    assert found.met
    assert abs(at / found.values["oscillation.omega"] - 1) >= DETUNED
    assert "a resonance" in found.active
    assert "off a resonance" in found.why
    off = [replace(found.case.oscillation, omega=found.case.omega * part) for part in (0.95, 1.0, 1.05)]
    least = min(mdr.full_slip_critical_velocity(replace(found.case, oscillation=one)) for one in off)
    assert found.reached["v_c_at_least"] == pytest.approx(least, rel=1e-9)


def test_a_body_holds_at_each_velocity_and_frequency_beside():
    """Friction of a body may be less at higher velocities: it is looked at where it is worst."""
    v_0 = 0.3 * v_c(BODY)
    found = mdr.design(BODY, mdr.Target(cof_at_most=0.8 * BODY.mu_0, up_to=v_0), {"omega": (150.0, 900.0)})
    assert found.met
    for part in (0.95, 1.0, 1.05):
        case = replace(found.case, oscillation=replace(found.case.oscillation, omega=part * found.case.omega))
        for v in (0.25 * v_0, 0.5 * v_0, v_0):
            assert mdr.slide(case, v).cof <= found.reached["cof_at_most"] + 2e-3


def test_the_least_power_meets_friction_exactly():
    v_0 = 0.5 * v_c(RUBBER)
    target = mdr.Target(cof_at_most=0.8 * RUBBER.mu_0, up_to=v_0)
    free = {"du_z": (0.5 * UM, 9 * UM)}
    roomy, sparing = (mdr.design(RUBBER, target, free, least=least) for least in (None, "power"))
    assert roomy.met
    assert sparing.met
    assert sparing.power < roomy.power
    assert 0 <= sparing.room["cof_at_most"] < 2e-3
    run = mdr.slide(sparing.case, v_0)
    assert sparing.power == pytest.approx(run.power["normal"])
    assert run.cof <= target.cof_at_most + run.cof_error


def test_a_drive_runs_as_fast_as_is_asked():
    shake = mdr.InPlaneOscillation(omega=300.0, du_x=5 * UM, phi_x=1.5)
    drive = replace(contact("paraboloid", 1.5), shake=shake)
    wanted = 0.5 * abs(mdr.no_load_velocity(replace(drive, shake=replace(shake, du_x=50 * UM))))
    target = mdr.Target(no_load_velocity_at_least=wanted)
    found = mdr.design(drive, target, {"du_x": (5 * UM, 50 * UM), "phi_x": (0.0, 6.28)})
    assert found.met
    assert mdr.no_load_velocity(found.case) == pytest.approx(found.reached["no_load_velocity_at_least"])
    assert found.reached["no_load_velocity_at_least"] > wanted


def test_a_grid_finds_nothing_better():
    v_0 = 0.4 * v_c(CONE)
    free = {"du_z": (1 * UM, 19 * UM), "load": (0.5, 4.0)}
    unit = mdr.static_load(CONE.indenter, CONE.material, CONE.oscillation.u_z0)
    free["load"] = (0.5 * unit, 4 * unit)
    target = mdr.Target(cof_at_most=0.7 * CONE.mu_0, cof_at_least=0.5 * CONE.mu_0, up_to=v_0)
    found = mdr.design(CONE, target, free)
    best = -np.inf
    for du_z in np.geomspace(*free["du_z"], 12):
        for load in np.geomspace(*free["load"], 12):
            depth = mdr.static_depth(CONE.indenter, CONE.material, load)
            case = replace(CONE, oscillation=replace(CONE.oscillation, du_z=du_z, u_z0=depth))
            if du_z < depth:
                share = mdr.cof_curve(case, [0.125 * v_0, v_0]).cof / CONE.mu_0
                best = max(best, min(share[0] - 0.5, 0.7 - share[1]))
    assert min(found.room.values()) >= best - 0.01


def test_what_is_held_stays():
    load = 2 * mdr.static_load(CONE.indenter, CONE.material, CONE.oscillation.u_z0)
    found = mdr.design(
        CONE, mdr.Target(v_c_at_least=1e-3), {"theta": (0.01, 0.02), "du_z": (1 * UM, 2 * UM)}, held={"load": load}
    )
    assert mdr.static_load(found.case.indenter, found.case.material, found.case.oscillation.u_z0) == pytest.approx(load)


def test_the_best_so_far_is_answered(monkeypatch):
    class Impatient(room_search.Answer):
        asked = 0

        def __init__(self, *args):
            Impatient.asked += 1
            if Impatient.asked == 40:
                raise KeyboardInterrupt
            super().__init__(*args)

    monkeypatch.setattr(room_search, "Answer", Impatient)
    found = mdr.design(CONE, mdr.Target(cof_at_most=0.1, up_to=1e-4), {"du_z": (1 * UM, 19 * UM)})
    assert found.stopped == "an interrupt"
    assert found.reached["cof_at_most"] == pytest.approx(mdr.slide(found.case, 1e-4).cof, abs=1e-5)
    with pytest.raises(ValueError, match="limit_s = 1e-09 s is over before the first case is done; raise it"):
        mdr.design(CONE, mdr.Target(v_c_at_least=1e-3), {"du_z": (1e-6, 2e-6)}, limit_s=1e-9)


def test_a_front_falls_and_its_designs_are_runs():
    v_0 = 0.5 * v_c(RUBBER)
    found = mdr.front(RUBBER, v_0, {"du_z": ("1um", "15um"), "frequency": (10.0, 200.0)}, n=3)
    assert np.all(np.diff(found.cof) > 0)
    assert np.all(np.diff(found.power) < 0)
    for cof, power, one in zip(found.cof, found.power, found.designs, strict=True):
        run = mdr.slide(one.case, v_0)
        assert (cof, power) == pytest.approx((run.cof, run.power["normal"]), rel=1e-3)
    assert found.table().splitlines()[0] == "cof [-],power [W],oscillation.du_z [m],frequency [Hz]"
    assert len(found.plot().axes) == 3


def test_a_front_ends_where_nothing_lowers_friction():
    """Above the critical velocity of all cases friction is full, which no search can mend."""
    found = mdr.front(RUBBER, 1e3 * v_c(RUBBER), {"du_z": (1 * UM, 15 * UM)}, n=3)
    assert found.cof == pytest.approx(3 * [RUBBER.mu_0])
    assert "no vibration in these ranges lowers friction" in found.why


def test_an_elastic_contact_takes_no_power():
    assert "gives back" in mdr.front(CONE, 1e-4, {"du_z": (1 * UM, 15 * UM)}, n=2).why


FREE = {"du_z": (1 * UM, 2 * UM)}


@pytest.mark.parametrize(
    ("limits", "why"),
    [
        ({}, "a target wants a limit: cof_at_most, .*, power_at_most$"),
        ({"cof_at_most": 0.2}, "cof_at_most wants up_to"),
        ({"power_at_most": 1.0}, "power_at_most wants up_to"),
        ({"v_c_at_least": 1.0, "up_to": 1.0}, "up_to is of friction or power"),
        ({"cof_at_most": 0.2, "cof_at_least": 0.3, "up_to": 1.0}, "cof_at_least must be below cof_at_most"),
        ({"v_c_at_least": np.nan}, "v_c_at_least must be a finite number"),
        ({"v_c_at_least": 0.0}, "v_c_at_least must be positive"),
        ({"cof_at_most": 0.2, "up_to": -1.0}, "up_to must be positive"),
        ({"power_at_most": -1.0, "up_to": 1.0}, "power_at_most must be positive"),
        ({"cof_at_most": 0.2, "cof_at_least": 0.2, "up_to": 1.0}, "cof_at_least must be below cof_at_most"),
        ({"power_at_most": np.inf, "up_to": 1.0}, "power_at_most must be a finite number"),
    ],
)
def test_targets_that_are_none(limits, why):
    with pytest.raises(ValueError, match=why):
        mdr.Target(**limits)


@pytest.mark.parametrize(
    ("change", "error", "why"),
    [
        ({"up_to": None}, TypeError, "up_to must be a real number"),
        ({"up_to": -1.0}, ValueError, "up_to must be positive"),
        ({"n": 1}, ValueError, "n must be at least 2"),
        ({"n": 2.5}, TypeError, "n must be a whole number"),
        ({"free": {}}, TypeError, "free must be a dict"),
        ({"limit_s": 1e-9}, ValueError, "is over before the first case is done; raise it"),
    ],
)
def test_what_is_no_front(change, error, why):
    with pytest.raises(error, match=why):
        mdr.front(**{"case": CONE, "up_to": 1e-4, "free": FREE, "n": 2, **change})


def test_a_case_that_stays_on_its_resonance_is_none():
    """The frequency is not free, and that of the body is the same."""
    case = replace(BODY, pull=replace(BODY.pull, m=BODY.pull.k_x / BODY.omega**2))
    with pytest.raises(ValueError, match="each is less than 5% of the frequency off a resonance; give other ranges"):
        mdr.design(case, mdr.Target(v_c_at_least=1e-3), FREE)


def test_a_word_that_is_no_limit_is_met_with_the_one_meant():
    with pytest.raises(TypeError, match="takes no cof_at_mst; did you mean cof_at_most"):
        mdr.Target(cof_at_mst=0.2, up_to=1.0)


@pytest.mark.parametrize(
    ("change", "error", "why"),
    [
        ({"target": None}, TypeError, "target must be of kind Target"),
        ({"free": {}}, TypeError, "free must be a dict"),
        ({"free": ["du_z"]}, TypeError, "free must be a dict"),
        ({"free": {"duz": (1.0, 2.0)}}, ValueError, "duz is no parameter of this case; did you mean du_z?"),
        ({"free": {"v_0": (1.0, 2.0)}}, ValueError, "v_0 is no parameter"),
        ({"free": {"du_z": 1.0}}, TypeError, "range of oscillation.du_z must be a pair"),
        ({"free": {"du_z": (2e-6, 1e-6)}}, ValueError, "range of oscillation.du_z must be \\(low, high\\)"),
        ({"free": {"du_z": (np.nan, 1e-6)}}, ValueError, "range of oscillation.du_z must be a finite number"),
        ({"free": {"du_z": ("1s", "2s")}}, ValueError, "oscillation.du_z wants m"),
        ({"free": {"du_z": (1e-6, 2e-6), "oscillation.du_z": (1e-6, 2e-6)}}, ValueError, "du_z set the same; keep one"),
        ({"free": {"load": (1.0, 2.0), "u_z0": (1e-6, 2e-6)}}, ValueError, "load and u_z0 set the same; keep one"),
        ({"free": {"nu": (0.6, 0.9)}}, ValueError, "of 32 cases in these ranges none can be: .*nu.*other ranges"),
        ({"least": "cost"}, ValueError, "least must be"),
        ({"least": True}, ValueError, 'least must be "power" or None, got True'),
        ({"least": "power"}, ValueError, "least power wants up_to"),
        ({"free": {"du_z": (1e-6, np.inf)}}, ValueError, "range of oscillation.du_z must be a finite number"),
        ({"free": {"du_z": (False, True)}}, TypeError, "range of oscillation.du_z must be a real number"),
        ({"free": {"du_z": (1e-6, 1e-6)}}, ValueError, "with low < high, got 1e-06 and 1e-06"),
        ({"free": {"du_z": "1um:2um"}}, TypeError, "range of oscillation.du_z must be a pair"),
        ({"free": {1: (1.0, 2.0)}}, TypeError, "parameters must be names, got 1"),
        ({"free": {"tau_0": (-2e4, -1e4)}}, ValueError, "of 33 cases .* none can be: tau_0 must not be negative"),
        (
            {"case": BODY, "target": mdr.Target(cof_at_most=0.2, up_to=1e-300)},
            ValueError,
            "v_0 = 1e-300 m/s is below 1e-09 of",
        ),
        ({"held": "load"}, TypeError, "held must be a dict"),
        ({"held": {"load": np.nan}}, ValueError, "load must be a finite number"),
        ({"limit_s": "1s"}, TypeError, "limit_s must be a real number"),
        ({"limit_s": 0.0}, ValueError, "limit_s must be positive"),
        ({"held": {"du_z": 1.0}}, ValueError, "held takes load"),
        ({"case": 1}, TypeError, "SlidingContact"),
        ({"case": replace(CONE, friction=mdr.StaticKinetic(0.6, 0.5))}, ValueError, "friction that does not fall"),
    ],
)
def test_what_is_no_question(change, error, why):
    asked = {"case": CONE, "target": mdr.Target(v_c_at_least=1e-3), "free": FREE, **change}
    with pytest.raises(error, match=why):
        mdr.design(**asked)
