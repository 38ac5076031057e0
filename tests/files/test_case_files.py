"""Case files: what is written reads back, and what is wrong is named, all of it at once."""

import math
import re
import warnings
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest

import mdr
from mdr.files import case_files
from mdr.files.case_files import write_case
from mdr.files.toml_text import CaseFileError
from mdr.given.case_file import parse_case, read_case

EXAMPLE = Path(__file__).parents[2] / "docs" / "example.toml"
GOOD = write_case(read_case(EXAMPLE))
SHAPES = ", ".join(case_files._TABLES["indenter"].writable())


def case(**changes):
    return replace(parse_case(GOOD), **changes)


def faults(text):
    """Messages of a refused text, without the name of the file that each must begin with."""
    with pytest.raises(CaseFileError) as refused:
        parse_case(text, source="x.toml")
    assert all(fault.startswith("x.toml: ") for fault in refused.value.faults)
    return [fault.removeprefix("x.toml: ") for fault in refused.value.faults]


def changed(old, new):
    assert GOOD.count(old) == 1
    return GOOD.replace(old, new)


def test_a_key_left_out_takes_the_default_of_the_record():
    assert parse_case(changed("m = 0.1\nc_x = 4.0\n", "")).pull == mdr.SpringPull(k_x=2e4)
    assert parse_case(GOOD.split("[pull]")[0]).pull == mdr.RigidPull()


OSCILLATION = re.compile(r"\[oscillation\][^[]*")
MOTIONS = {
    "load": mdr.LoadOscillation(0.1, 0.02, 300.0, 0.1),
    "series": mdr.PeriodicMotion(300.0, 2e-5, (1e-6, 2e-6), (0.0, 1e-6)),
    "Eq. (3)": mdr.NormalOscillation(2e-5, 1e-6, 300.0),
}


@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_an_oscillation_is_told_by_its_keys_or_named(motion):
    text = write_case(case(oscillation=motion))
    assert "motion =" not in text
    named = text.replace("[oscillation]\n", f'[oscillation]\nmotion = "{type(motion).__name__}"\n')
    assert parse_case(named) == parse_case(text) == case(oscillation=motion)


def test_a_named_oscillation_is_held_to_its_name():
    table = '[oscillation]\nmotion = "NormalOscillation"\nF_z0 = 0.1\ndF_z = 0.01\nomega = 300.0\n\n'
    assert [fault.split("; ")[0] for fault in faults(OSCILLATION.sub(table, GOOD))] == [
        "[oscillation] F_z0 is no key of NormalOscillation", "[oscillation] dF_z is no key of NormalOscillation",
        "[oscillation] u_z0 is missing", "[oscillation] du_z is missing",
    ]  # fmt: skip
    (fault,) = faults(changed("[oscillation]", '[oscillation]\nmotion = "Normal"'))
    assert fault == '[oscillation] motion "Normal" is unknown; did you mean NormalOscillation?'


def test_what_a_file_cannot_carry_is_refused_with_the_reason():
    with pytest.raises(CaseFileError, match=r"\[indenter\] Profile: its shape is a Python function.*Paraboloid"):
        write_case(case(indenter=mdr.Profile(lambda r: r**2, name="bowl")))

    class Mine(mdr.Paraboloid):
        pass

    with pytest.raises(CaseFileError, match=f"Mine is none of the records a file can name: {SHAPES}"):
        write_case(case(indenter=Mine(R=1.0)))


# --- faults ---


def test_a_file_takes_quantities_in_quotes():
    text = """
        mu_0 = "50%"
        [indenter]
        shape = "Cone"
        theta = "2 deg"
        [material]
        model = "KelvinVoigt"
        E = "3 MPa"
        nu = "50 %"
        tan_delta = "10%"
        [oscillation]
        load = "50 mN"
        du_z = "2 um"
        omega = "50 Hz"
        [pull]
        k_x = "20 N/mm"
        m = "100 g"
        [shake]
        frequency = "50 Hz"
        x_cos = ["1 um", 2e-6]
    """
    omega = 100 * np.pi
    rubber = mdr.KelvinVoigt.from_loss_tangent(E=3e6, nu=0.5, tan_delta=0.1, omega=omega)
    motion = mdr.NormalOscillation(mdr.static_depth(mdr.Cone(np.deg2rad(2)), rubber, 0.05), 2e-6, omega)
    shake, pull = mdr.InPlaneMotion(omega, x_cos=(1e-6, 2e-6)), mdr.SpringPull(2e4, 0.1)
    assert parse_case(text) == mdr.SlidingContact(mdr.Cone(np.deg2rad(2)), rubber, 0.5, motion, pull, shake)


def test_every_fault_is_named_at_once():
    text = """
        mu_0 = -1
        mu0 = 3
        k_x = 2
        [indenter]
        shape = "paraboloid"
        [material]
        model = "KelvinVoigt"
        e = 3e6
        nu = "half"
        tau = -1
        E = -5
        [oscillation]
        u_z0 = nan
        omega = -3
        [pul]
        [pull]
        m = -1
    """
    assert faults(text) == [
        "mu0 is no key outside the tables; did you mean mu_0?",
        "k_x is no key outside the tables; it belongs to [pull]",
        "[pul] is no table of a case; did you mean [pull]?",
        '[indenter] shape "paraboloid" is unknown; did you mean Paraboloid?',
        "[material] e is no key of KelvinVoigt; did you mean E?",
        "[material] nu wants a pure number, such as 0.1 or 10%, got 'half'",
        "[material] E must be positive, got -5.0 (Young's modulus in Pa)",
        "[material] tau must not be negative, got -1.0 (relaxation time in s)",
        "[oscillation] du_z is missing",
        "[oscillation] u_z0 must be a finite number, got nan",
        "[oscillation] omega must be positive, got -3.0 (angular frequency in rad/s)",
        "[pull] k_x is missing; leave [pull] out for a rigid pull",
        "[pull] m must not be negative, got -1.0 (mass in kg)",
        "mu_0 must not be negative, got -1.0 (coefficient of friction)",
    ]


def test_a_misnamed_table_is_offered_its_name_and_its_faults_are_told():
    text = changed("[oscillation]", "[osc]").replace("du_z", "du").replace("u_z0 = 2e-05", "u_z0 = nan")
    assert faults(text) == [
        "[osc] is no table of a case; did you mean [oscillation]?",
        "[oscillation] du is no key of NormalOscillation; did you mean du_z?",
        "[oscillation] du_z is missing",
        "[oscillation] u_z0 must be a finite number, got nan",
    ]
    assert faults(changed("[pull]", "[Pull]")) == ["[Pull] is no table of a case; did you mean [pull]?"]


def test_an_empty_file_lacks_everything():
    assert faults("") == [
        "[indenter] is missing", "[material] is missing", "[oscillation] is missing", "mu_0 is missing",
    ]  # fmt: skip


def test_a_stand_in_for_a_wrong_value_raises_no_fault_of_its_own(monkeypatch):
    @dataclass(frozen=True)
    class Ring(mdr.Paraboloid):
        inner: float

        def __post_init__(self):
            super().__post_init__()
            if not 0 < self.inner < self.R:
                raise ValueError(f"inner must lie between 0 and R = {self.R}, got {self.inner}")

    monkeypatch.setattr(mdr.indenters, "Ring", Ring, raising=False)
    monkeypatch.setattr(mdr.indenters, "__all__", ["Ring"])
    text = changed('shape = "Paraboloid"\nR = 0.005', 'shape = "Ring"\nR = -1\ninner = 3')
    assert faults(text) == ["[indenter] R must be positive, got -1.0 (radius of curvature in m)"]
    # refused with every stand-in, but in words that tell of the stand-in: kept back until R is right
    assert len(faults(text.replace("inner = 3", "inner = -3"))) == 1


# --- what a rig is set to ---

FILE = """
{face}
[indenter]
{shape}
{slope}
[material]
model = "{model}"
E = 3e6
nu = 0.5
{loss}
[oscillation]
{motion}
"""
PLAIN = {"face": "mu_0 = 0.5", "model": "KelvinVoigt", "shape": 'shape = "Cone"', "slope": "theta = 0.02",
         "loss": "tau = 1e-3", "motion": "u_z0=2e-5\ndu_z=2e-6\nomega=300"}  # fmt: skip
OMEGA = 2 * math.pi * 50


def text_of(**parts):
    return FILE.format(**{**PLAIN, **parts})


def read(**parts):
    return parse_case(text_of(**parts))


def test_degrees_hertz_and_loss_tangents():
    found = read(slope="theta_deg = 1.5", loss="tan_delta = 0.2", motion="frequency = 50\nu_z0 = 2e-5\ndu_z = 2e-6")
    assert found.indenter.theta == math.radians(1.5)
    assert found.oscillation.omega == OMEGA
    assert float(found.material.loss_tangent(OMEGA)) == pytest.approx(0.2, rel=1e-15)
    shaken = 'motion="ConstantLoad"\nload=1.0\n[shake]\nfrequency=50\ndu_x=1e-6'
    found = read(motion=shaken, loss="tan_delta = 0.2")
    assert (found.oscillation, found.shake.omega) == (mdr.ConstantLoad(1.0), OMEGA)
    assert found.material.tau == 0.2 / OMEGA  # of the shake, where the load is constant


def test_a_load_is_that_of_an_oscillating_load_or_of_the_depth_at_which_it_rests():
    assert read(motion="frequency=50\nload=1.0\ndF_z=0.1").oscillation == mdr.LoadOscillation(1.0, 0.1, OMEGA)
    found = read(motion="frequency=50\nload=1.0\ndu_z=2e-6")
    depth = mdr.static_depth(found.indenter, found.material, 1.0)
    assert found.oscillation == mdr.NormalOscillation(depth, 2e-6, OMEGA)
    assert found == mdr.rig(found.indenter, found.material, 0.5, frequency=50, load=1.0, depth_amplitude=2e-6)
    assert parse_case(write_case(found)) == found


#: parts of a file, and what is told of them, once and in their own words
FAULTS = [
    # keys and shapes
    ({"slope": "theta = 1\nR = 1"}, "[indenter] R is no key of Cone; there are shape, theta, theta_deg"),
    ({"slope": "theta = 1\nk_x = 1"}, "[indenter] k_x is no key of Cone; it belongs to [pull]"),
    ({"slope": "theta = 1\nmu_0 = 1"}, "[indenter] mu_0 is no key of Cone; write it above the first table"),
    ({"shape": ""}, f"[indenter] shape is missing; choose one of {SHAPES}"),
    ({"shape": 'shape = "Profile"'}, '[indenter] shape "Profile": its shape is a Python function, which'),
    ({"shape": "shape = 3"}, "[indenter] shape must be a name in quotes, got 3; choose one of"),
    ({"motion": PLAIN["motion"] + "\n[[pull]]"}, "[pull] must be one table of keys, got an array"),
    # values
    ({"slope": f"theta = {10**400}"}, "[indenter] theta must be a finite number, got a whole number beyond"),
    ({"slope": f"theta = [{'1, ' * 100_000}]"}, "[indenter] theta must be a real number, got [1, 1, 1"),
    ({"face": 'mu_0 = "1 N"'}, "mu_0 wants a pure number, such as 0.1 or 10%, got '1 N'"),
    # what a rig is set to; of a refused shape no depth is asked
    ({"slope": 'theta_deg = "x"'}, "theta_deg wants"),
    ({"loss": "tan_delta = -1"}, "tan_delta must not"),
    ({"motion": 'frequency = "x"\nu_z0 = 2e-5\ndu_z = 2e-6'}, "frequency wants"),
    ({"slope": "theta = 7", "motion": "frequency=50\nload=1.0\ndu_z=2e-6"}, "theta must lie"),
    ({"slope": "theta_deg = 1.5\ntheta = 0.02"}, "theta_deg and theta say the same"),
    ({"slope": ""}, "theta is missing; or give theta_deg [deg]"),
    ({"shape": 'shape = "Paraboloid"', "slope": "R = 1\ntheta_deg = 2"},
     "theta_deg is no key of Paraboloid; it stands for indenter.theta"),
    ({"model": "Elastic", "loss": "tan_delta = 0.2"}, "tan_delta is no key of Elastic; it stands for material.tau"),
    ({"motion": "omega=300\nu_z0=1e-5\ndu_z=1e-6\n[shake]\nomega=200\ndu_x=1e-6", "loss": "tan_delta=0.2"}, "have two"),
    ({"motion": "omega=300\ndu_z=1e-6\ndF_z=1e-6\nload=1"}, "du_z is no key of LoadOscillation; did you mean dF_z"),
    ({"motion": "omega=300\ndu_z=1e-6"}, "u_z0 is missing; or give load [N]"),
    ({"loss": ""}, "tau is missing; or give tan_delta"),
    ({"loss": "tan_delta = 0.2", "motion": "u_z0 = 2e-5\ndu_z = 2e-6"}, "omega is missing; or give frequency"),
    ({"motion": "omega=300\nf=50\nu_z0=1e-5\ndu_z=1e-6"}, "f is no key of NormalOscillation; did you mean frequency"),
    ({"motion": "frequency = 50\nload = 1\nu_z0 = 1e-5\ndu_z = 2e-6"}, "load and u_z0 say the same"),
]  # fmt: skip


@pytest.mark.parametrize(("parts", "words"), FAULTS, ids=[words[:40] for _, words in FAULTS])
def test_a_fault_is_told_once_in_its_own_words(parts, words):
    (fault,) = faults(text_of(**parts))
    assert words in fault
    assert len(fault) < 450


LOADED = "F_z0 = 1.0\ndF_z = 0.1\nomega = 300\n{}\n[pull]\nk_x = 2e4\nm = 0.2"
MASSES = {
    "of the load": (LOADED.format(""), LOADED.format("m_z = 0"), r"m_z = 0\.2 if it presses on the body itself"),
    "of the pull": (PLAIN["motion"] + "\n[pull]\nk_x = 2e4", PLAIN["motion"] + "\n[pull]\nk_x = 2e4\nm = 0",
                    r"\[pull\] says no mass: give m in kg"),
}  # fmt: skip


@pytest.mark.parametrize(("silent", "said", "words"), MASSES.values(), ids=MASSES)
def test_a_mass_that_is_not_said_is_asked_for(silent, said, words):
    with pytest.warns(mdr.PlausibilityWarning, match=words) as warned:
        asked = read(motion=silent)
    assert [one.filename for one in warned] == [__file__]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert read(motion=said) == asked == parse_case(write_case(asked))


def test_the_example_gives_a_unit_to_every_number():
    lines = EXAMPLE.read_text(encoding="utf-8").splitlines()
    values = [line for line in lines if re.match(r'\w+ = [^"]', line)]
    assert len(values) == len(GOOD.split(" = ")) - 3  # all but shape and model
    assert all("# [" in line for line in values)
