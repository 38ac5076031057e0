"""A damaged file holds a sound record, or is refused by its name and its fault."""

import contextlib
import io
import itertools
import re
import warnings
from pathlib import Path

import pytest
from random_records import Dice

import mdr
from mdr.__main__ import main
from mdr.files import examples
from mdr.files.toml_text import CaseFileError
from mdr.studies.study_files import read_study_file

EACH = 60  #: files of a kind
LONGEST = 500  #: characters of a fault, with the name of the file

FRICTION = "v_0 [mm/s], COF, error\n0.5, 0.31, 0.01\n1.0, 0.35, 0.01\n# a remark\n2.0, 0.41, 0.02\n5, 0.47, 0.02\n"
SCAN = "x [um],f [nm],note\n" + "".join(f"{x},{40 * x * x},a\n" for x in range(-6, 7))
PRESS = "d [um];F [mN]\n" + "".join(f"{d};{0.4 * d**1.5:.6f}\n" for d in range(1, 10))
MODULI = "f [Hz],E' [MPa],tan delta\n1,3,0.1\n10,3.5,0.2\n100,4,0.15\n"
RECORD = "t [ms],a [g],u_x [um]\n" + "".join(f"{k},{(-1) ** k},{k * k}\n" for k in range(9))
ARMS = "E_j [Pa],tau_j [s]\n2e6,1e-2\n4e6,1e-4\n1e5,0.3\n3e6,inf\n"
MATERIAL = '[material] # 20 °C\nmodel = "Prony"\nE_inf = 3e6\narms = [[2e6, 1e-2], [4e6, 1e-4]]\nnu = 0.5\ntau = 1e-5\n'
CASES = [
    examples.example(shape, material, motion)
    for shape, material, motion in zip(
        examples.SHAPES, itertools.cycle(examples.MATERIALS), itertools.cycle(examples.MOTIONS), strict=False
    )
]
STUDY = Path(__file__).parents[2] / "docs" / "study.toml"
#: name of the file, what it may hold, what reads it, what it raises
KINDS = {
    "case": ("case.toml", [examples.example_file(one) for one in CASES], mdr.read_case, CaseFileError),
    "written case": ("case.toml", [mdr.write_case(one) for one in CASES], mdr.read_case, CaseFileError),
    "study": ("study.toml", [STUDY.read_text(encoding="utf-8")], read_study_file, CaseFileError),
    "friction": ("v.csv", [FRICTION, FRICTION.replace(",", ";")], mdr.read_friction_data, ValueError),
    "profile": ("scan.csv", [SCAN], mdr.SampledProfile.read, ValueError),
    "force": ("press.csv", [PRESS], lambda path: mdr.FromForce.read(path, E_star=1e6), ValueError),
    "moduli": ("moduli.csv", [MODULI], mdr.read_moduli, ValueError),
    "record": ("shaker.csv", [RECORD], mdr.read_record, ValueError),
    "arms": ("arms.csv", [ARMS], lambda path: mdr.Prony.read(path, nu=0.5), ValueError),
    "material": ("arms.toml", [MATERIAL], mdr.Prony.read, ValueError),
    "stored study": ("study.nc", None, mdr.read_study, mdr.studies.StudyError),
}

#: what files are made of, and what they are not
SPLINTERS = [
    *("nan", "inf", "-inf", "1e999", "-1e999", "1e-999", "0", "-0.0", "-1", "1_0", "1__0", "0x10", "true", "false"),
    *("{}", "[]", "[[]]", "{a=1}", '"text"', "'text'", '"""', "'''", '"', "'", "1979-05-27", "07:32:00"),
    *("1979-05-27T07:32:00Z", "=", "==", ",", ";", "#", "[", "]", "{", "}", "[[pull]]", "[pull]", "[indenter]"),
    *("[axes]", "[material.arms]", "a.b.c", "tau", "nu", "E", "du_z", "omega", "\\", "\\u0000", "\\ud800", "μ", "∞"),
    *("\u202e", "\ufeff", "\x00", "\x7f", "\t", "\x0b", "\x85", "\u2028", "\r", "\r\n", "\n", "😀"),
]
HUGE = ["9" * 400, "9" * 5000, "1e" + "9" * 30, "[" * 3000, "[" * 200 + "]" * 200, "a." * 500, "{a=" * 300]
CODINGS = ["utf-16", "utf-8-sig", "utf-32", "utf-7", "cp037"]  # as another editor would save it
NOTHING = [b"", b" ", b"\n", b"\x00", b"\xef\xbb\xbf", b"\xff" * 64, bytes(range(256))]


def splinter(dice):
    if dice.happens(0.3):
        return repr(dice.one_of([-1.0, 1.0, 1.0]) * dice.size(1e-300, 1e300)).encode()
    return (dice.one_of(HUGE) if dice.happens(0.1) else dice.one_of(SPLINTERS)).encode("utf-8", "surrogatepass")


def blow(dice, data):
    """One thing that happens to a file."""
    low = dice.below(len(data) + 1)
    high, lines = low + dice.below(20), data.split(b"\n")
    i, j = dice.below(len(lines)), dice.below(len(lines))
    values = [one.span() for one in re.finditer(rb"(?<=[=,\[])\s*[^,\[\]#\n=]+", data)] or [(low, low)]
    start, end = dice.one_of(values)
    valued = data[:start] + b" " + splinter(dice) + data[end:]
    lost, swapped = lines[:i] + lines[i + 1 :], [*lines]
    swapped[i], swapped[j] = lines[j], lines[i]
    return dice.one_of(
        [
            *3 * [valued],
            data[:low] + bytes([dice.below(256)]) + data[low + 1 :],
            data[:low] + data[high:],
            data[:low],
            *2 * [data[:low] + splinter(dice) + data[low:]],
            *(b"\n".join(some) for some in ([*lines[:i], lines[j], *lines[i:]], lost, swapped)),
            data.replace(b"\n", b"", 1),
            data.decode("utf-8", "replace").encode(dice.one_of(CODINGS), "replace"),
            data.replace(b"\n", dice.one_of([b"\r\n", b"\r", b"\n\n", b"\x85"])),
            data + data,
            *([dice.one_of(NOTHING)] if dice.happens(0.1) else []),
        ]
    )


def damaged(kind, dice, data, folder):
    """A file after one to four blows."""
    for _ in range(1 if dice.happens(0.6) else 2 + dice.below(3)):
        data = blow(dice, data)
    path = folder / KINDS[kind][0]
    path.write_bytes(data)
    return path


def read(kind, path):
    """The record in a file, or None where it is refused in words that name the file and the fault."""
    _, _, reader, error = KINDS[kind]
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            warnings.simplefilter("ignore", mdr.PlausibilityWarning)  # of a unit
            record = reader(path)
    except error as refusal:
        for line in str(refusal).splitlines():
            shown = line.startswith("  ") and path.suffix == ".csv"  # a line of the file as it was read
            assert shown or line.startswith(str(path)), f"names no file: {line!r}"
            assert shown or len(str(path)) + 5 < len(line)
            assert len(line) <= LONGEST, f"{len(line)} characters: {line[:200]!r}"
            assert line.isprintable(), f"unprintable: {line!r}"
        return None
    if kind != "stored study":  # where a point that failed is NaN
        assert not re.search(r"\b(nan|inf)\b", repr(record)), repr(record)
    assert not isinstance(record, mdr.SlidingContact) or mdr.parse_case(mdr.write_case(record)) == record
    return record


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    """The bytes of a study."""
    path = tmp_path_factory.mktemp("study") / "study.nc"
    mdr.sweep(examples.example("Cone", "Elastic", pull="RigidPull"), {"v_0/v_c": [0.2, 0.5]}).to_netcdf(path)
    return path.read_bytes()


@pytest.mark.parametrize("kind", KINDS)
def test_a_damaged_file_holds_a_sound_record_or_says_what_is_wrong(kind, stored, tmp_path):
    name, texts, _, _ = KINDS[kind]
    whole = [text.encode() for text in texts] if texts else [stored]
    for data in whole:
        (tmp_path / name).write_bytes(data)
        assert read(kind, tmp_path / name) is not None
    found = [read(kind, damaged(kind, dice, dice.one_of(whole), tmp_path)) for dice in map(Dice, range(EACH))]
    assert 0 < sum(one is not None for one in found) < EACH  # neither all nor nothing gets through


@pytest.mark.parametrize("seed", range(12))
def test_the_command_line_ends_with_a_status_and_words_on_any_file(seed, tmp_path):
    path = damaged("case", Dice(seed), KINDS["case"][1][seed].encode(), tmp_path)
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        status = main(["velocity", str(path)])
    assert status in ((2,) if read("case", path) is None else (0, 1))
    assert "Traceback" not in err.getvalue()
    assert status == 0 or err.getvalue().strip()
