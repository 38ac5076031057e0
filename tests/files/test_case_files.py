"""Case files: what is written reads back, and what is wrong is named, all of it at once."""

import re
from dataclasses import dataclass, replace
from pathlib import Path

import pytest

import mdr
from mdr.files import case_files, own_records
from mdr.files.case_files import CaseFileError, parse_case, read_case, write_case

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


MOTIONS = {
    "load": mdr.LoadOscillation(0.1, 0.02, 300.0, 0.1),
    "load without mass": mdr.LoadOscillation(0.1, 0.02, 300.0),
    "series": mdr.PeriodicMotion(300.0, 2e-5, (1e-6, 2e-6), (0.0, 1e-6)),
    "Eq. (3)": mdr.NormalOscillation(2e-5, 1e-6, 300.0),
}


def test_the_keys_of_the_oscillation_tell_what_it_is():
    table = "[oscillation]\nF_z0 = 0.1\ndFz = 0.01\nomega = 300.0\n"
    with pytest.raises(mdr.CaseFileError) as caught:
        parse_case(re.sub(r"\[oscillation\][^[]*", table, GOOD))
    assert [fault.split(": ", 1)[1] for fault in caught.value.faults] == [
        "[oscillation] dFz is no key of LoadOscillation; did you mean dF_z?",
        "[oscillation] dF_z is missing",
    ]


OSCILLATION = re.compile(r"\[oscillation\][^[]*")


@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
def test_an_oscillation_may_be_named(motion):
    text = write_case(case(oscillation=motion))
    named = text.replace("[oscillation]\n", f'[oscillation]\nmotion = "{type(motion).__name__}"\n')
    assert parse_case(named) == parse_case(text)


def test_a_named_oscillation_is_held_to_its_name():
    table = '[oscillation]\nmotion = "NormalOscillation"\nF_z0 = 0.1\ndF_z = 0.01\nomega = 300.0\n\n'
    assert [fault.split("; ")[0] for fault in faults(OSCILLATION.sub(table, GOOD))] == [
        "[oscillation] F_z0 is no key of NormalOscillation", "[oscillation] dF_z is no key of NormalOscillation",
        "[oscillation] u_z0 is missing", "[oscillation] du_z is missing",
    ]  # fmt: skip
    (fault,) = faults(changed("[oscillation]", '[oscillation]\nmotion = "Normal"'))
    assert fault == '[oscillation] motion "Normal" is unknown; did you mean NormalOscillation?'


@dataclass(frozen=True)
class Beat(mdr.PeriodicMotion):
    """A motion of later, with the keys of an old one."""


def test_a_motion_of_later_is_named_in_its_file_and_old_files_keep_their_meaning(monkeypatch):
    monkeypatch.setitem(own_records._OWN, "Beat", Beat)
    beat = case(oscillation=Beat(300.0, 2e-5, (1e-6,)))
    assert 'motion = "Beat"' in write_case(beat)
    assert parse_case(write_case(beat)) == beat
    series = case(oscillation=MOTIONS["series"])
    assert parse_case(write_case(series)) == series


def test_what_a_file_cannot_carry_is_refused_with_the_reason():
    with pytest.raises(CaseFileError, match=r"\[indenter\] Profile: its shape is a Python function.*Paraboloid"):
        write_case(case(indenter=mdr.Profile(lambda r: r**2, name="bowl")))

    class Mine(mdr.Paraboloid):
        pass

    with pytest.raises(CaseFileError, match=f"Mine is none of the records a file can name: {SHAPES}"):
        write_case(case(indenter=Mine(R=1.0)))


# --- faults ---


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
        "[material] E must be positive, got -5.0 (Young's modulus in Pa)",
        "[material] nu must be a real number, got 'half' (str)",
        "[material] tau must not be negative, got -1.0 (relaxation time in s)",
        "[oscillation] du_z is missing",
        "[oscillation] u_z0 must be a finite number, got nan",
        "[oscillation] omega must be positive, got -3.0 (angular frequency in rad/s)",
        "[pull] k_x is missing; leave [pull] out for a rigid pull",
        "[pull] m must not be negative, got -1.0 (mass in kg)",
        "mu_0 must be positive, got -1.0 (coefficient of friction)",
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


R = "R = 0.005"
SHAPE = 'shape = "Paraboloid"'
SINGLE = {
    "unknown key": (R, f"{R}\ntheta = 1", "[indenter] theta is no key of Paraboloid; there are shape, R"),
    "key of another table": (R, f"{R}\nk_x = 1", "[indenter] k_x is no key of Paraboloid; it belongs to [pull]"),
    "mu_0 below a table": (R, f"{R}\nmu_0 = 1", "[indenter] mu_0 is no key of Paraboloid; write it at the top"),
    "missing shape": (SHAPE, "", f"[indenter] shape is missing; choose one of {SHAPES}"),
    "shape in capitals": (SHAPE, 'Shape = "Cone"', "[indenter] shape is missing, and Shape unknown; choose one of"),
    "unknown shape": (SHAPE, 'shape = "Kone"', '[indenter] shape "Kone" is unknown; did you mean Cone?'),
    "function": (SHAPE, 'shape = "Profile"', '[indenter] shape "Profile": its shape is a Python function, which'),
    "shape no string": (SHAPE, "shape = 3", "[indenter] shape must be a name in quotes, got 3; choose one of"),
    "array of tables": ("[indenter]", "[[indenter]]", "[indenter] must be one table of keys, got an array"),
    "integer past floats": (R, f"R = {10**400}", "[indenter] R must be a finite number, got inf"),
}  # fmt: skip


@pytest.mark.parametrize(("old", "new", "message"), SINGLE.values(), ids=SINGLE)
def test_a_fault_is_named(old, new, message):
    (fault,) = faults(changed(old, new))
    assert fault.startswith(message)


def test_a_study_and_a_dotted_key_without_end_are_told():
    assert faults("[axes]\nT = [0.1]")[0].startswith(
        "[axes] makes it a study file, not a case file; `mdr sweep` reads it"
    )
    assert faults(GOOD.replace(R, "R" + ".a" * 200_000 + " = 1"))[0].startswith("nested too deeply")


def test_a_message_stays_a_line_of_bearable_length():
    (fault,) = faults(changed(R, f"R = [{'1, ' * 100_000}]"))
    assert len(fault) < 450


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
    text = GOOD.replace(f"{SHAPE}\n{R}", 'shape = "Ring"\nR = -1\ninner = 3')
    assert faults(text) == ["[indenter] R must be positive, got -1.0 (radius of curvature in m)"]
    # refused with every stand-in, but in words that tell of the stand-in: kept back until R is right
    assert len(faults(text.replace("inner = 3", "inner = -3"))) == 1


def test_the_example_gives_a_unit_to_every_number():
    lines = EXAMPLE.read_text(encoding="utf-8").splitlines()
    values = [line for line in lines if "=" in line and '= "' not in line and line[0] != "#"]
    assert len(values) == len(GOOD.split(" = ")) - 3  # all but shape and model
    assert all("# [" in line for line in values)
