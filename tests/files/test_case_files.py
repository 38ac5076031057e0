"""Case files: what is written reads back, and what is wrong is named, all of it at once."""

import inspect
import re
from dataclasses import dataclass, replace
from pathlib import Path

import pytest

import mdr
from mdr import materials
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


# --- round trip ---

CASES = {
    "the example": {},
    "cone, rigid": {"indenter": mdr.Cone(theta=0.05), "pull": mdr.RigidPull()},
    "punch, elastic": {"indenter": mdr.FlatPunch(a=1 / 3), "material": mdr.Elastic(E=2.1e11, nu=0.3)},
    "power law, pair": {
        "indenter": mdr.PowerLaw(n=3.7, c=1e22), "material": mdr.ElasticPair(E_1=1e-300, nu_1=-0.2, E_2=7e9, nu_2=0.0),
    },
    "tapping": {"oscillation": mdr.NormalOscillation(u_z0=-1e-9, du_z=0.1 + 0.2, omega=1e300)},
    "damped": {"pull": mdr.SpringPull(k_x=5e-324, m=3, c_x=2**0.5)},
}  # fmt: skip


@pytest.mark.parametrize("changes", CASES.values(), ids=CASES)
def test_what_is_written_reads_back(changes):
    original = case(**changes)
    assert parse_case(write_case(original)) == original


def test_a_key_left_out_takes_the_default_of_the_record():
    assert parse_case(changed("m = 0.1\nc_x = 4.0\n", "")).pull == mdr.SpringPull(k_x=2e4)
    assert parse_case(GOOD.split("[pull]")[0]).pull == mdr.RigidPull()


@dataclass(frozen=True)
class Layered(materials.base.OneBody):
    """A material of later: sequences, a word, a flag, a count and a value that may be absent."""

    arms: tuple[tuple[float, float], ...]
    name: str
    fitted: bool = False
    n_arms: int = 0
    tau: float | None = None
    E, nu = 1.0, 0.3

    def __post_init__(self):
        object.__setattr__(self, "arms", tuple(tuple(arm) for arm in self.arms))


def test_a_new_record_needs_no_line_here(monkeypatch):
    monkeypatch.setattr(materials, "Layered", Layered, raising=False)
    monkeypatch.setattr(materials, "__all__", [*materials.__all__, "Layered"])
    layered = case(material=Layered(((1.0, 2.0), (3.0, 1e-5)), 'R²: "a\\b"\n\x7f😀', fitted=True, n_arms=2))
    assert parse_case(write_case(layered)) == layered


MOTIONS = {
    "load": mdr.LoadOscillation(0.1, 0.02, 300.0, 0.1),
    "load without mass": mdr.LoadOscillation(0.1, 0.02, 300.0),
    "series": mdr.PeriodicMotion(300.0, 2e-5, (1e-6, 2e-6), (0.0, 1e-6)),
    "Eq. (3)": mdr.NormalOscillation(2e-5, 1e-6, 300.0),
}


@pytest.mark.parametrize("motion", MOTIONS.values(), ids=MOTIONS)
@pytest.mark.parametrize(
    "material",
    [mdr.Prony(3e6, [(1e6, 1e-3), (2e6, 0.1)], 0.5, 1e-4), mdr.StandardLinearSolid(3e6, 6e6, 2e-3, 0.5)],
    ids=["Prony", "StandardLinearSolid"],
)
def test_arms_and_motions_come_back(motion, material):
    whole = case(material=material, oscillation=motion)
    assert parse_case(write_case(whole)) == whole


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


def test_every_public_shape_and_material_is_known():
    known = {**case_files._TABLES["indenter"].records(), **case_files._TABLES["material"].records()}
    public = {name: getattr(mdr, name, None) for name in mdr.__all__}
    records = {
        name for name, one in public.items()
        if inspect.isclass(one) and issubclass(one, (mdr.Indenter, mdr.Material)) and not inspect.isabstract(one)
    }  # fmt: skip
    assert records - {"Indenter"} <= set(known)
    assert "Profile" not in case_files._TABLES["indenter"].writable()


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
    "key with strange letters": (R, rf'{R}{chr(10)}"\u001b\n" = 1', r'[indenter] "\u001b\n" is no key of Paraboloid'),
    "missing key": (R, "", "[indenter] R is missing"),
    "missing shape": (SHAPE, "", f"[indenter] shape is missing; choose one of {SHAPES}"),
    "shape in capitals": (SHAPE, 'Shape = "Cone"', "[indenter] shape is missing, and Shape unknown; choose one of"),
    "unknown shape": (SHAPE, 'shape = "Kone"', '[indenter] shape "Kone" is unknown; did you mean Cone?'),
    "shape without likeness": (SHAPE, 'shape = "Q"', f'[indenter] shape "Q" is unknown; there are {SHAPES}'),
    "abstract shape": (SHAPE, 'shape = "Indenter"', '[indenter] shape "Indenter" is unknown; '),
    "function": (SHAPE, 'shape = "Profile"', '[indenter] shape "Profile": its shape is a Python function, which'),
    "shape no string": (SHAPE, "shape = 3", "[indenter] shape must be a name in quotes, got 3; choose one of"),
    "array of tables": ("[indenter]", "[[indenter]]", "[indenter] must be one table of keys, got an array"),
    "unknown model": ('"KelvinVoigt"', '"Kelvin"', '[material] model "Kelvin" is unknown; did you mean KelvinVoigt?'),
    "true for a number": (R, "R = true", "[indenter] R must be a real number, got True (bool)"),
    "list for a number": (R, "R = [1, 2]", "[indenter] R must be a real number, got [1, 2] (list)"),
    "infinity": (R, "R = 1e999", "[indenter] R must be a finite number, got inf"),
    "integer past floats": (R, f"R = {10**400}", "[indenter] R must be a finite number, got inf"),
    "two values together": ("u_z0 = 2e-05", "u_z0 = -2", "[oscillation] u_z0 + du_z = -2 m: the indenter never"),
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


def test_a_whole_that_is_refused_keeps_the_words_of_the_record(monkeypatch):
    @dataclass(frozen=True)
    class Ball(mdr.Paraboloid):
        def contact_radius(self, d):
            if d > self.R:
                raise ValueError(f"{self!r} ends at its radius; press less deep")
            return super().contact_radius(d)

    Ball.__qualname__ = "Ball"
    monkeypatch.setattr(mdr.indenters, "Ball", Ball, raising=False)
    monkeypatch.setattr(mdr.indenters, "__all__", ["Ball"])
    text = GOOD.replace(f"{SHAPE}\n{R}", 'shape = "Ball"\nR = 1e-9')
    assert faults(text) == ["Ball(R=1e-09) ends at its radius; press less deep"]
    assert faults(text.replace("mu_0 = 0.5", "mu_0 = 0")) == [
        "mu_0 must be positive, got 0.0 (coefficient of friction)",
        "Ball(R=1e-09) ends at its radius; press less deep",
    ]


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
