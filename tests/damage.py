"""Files that were once right, damaged by chance, and what must become of them: a sound record, or why not.

`FILES` are the files by kind, `READERS` what reads each kind, `damaged` what chance leaves of one.
"""

import contextlib
import io
import re
import tempfile
import warnings
from functools import cache
from pathlib import Path

import anything

import mdr
from mdr.__main__ import main
from mdr.files import examples
from mdr.files.toml_text import CaseFileError
from mdr.studies.study_files import read_study_file

ROOT = Path(__file__).parents[1]
LONGEST = 500  #: characters of a fault, with the name of the file

FRICTION = "v_0 [mm/s], COF, error\n0.5, 0.31, 0.01\n1.0, 0.35, 0.01\n# a remark\n2.0, 0.41, 0.02\n5, 0.47, 0.02\n"
SCAN = "x [um],f [nm],note\n" + "".join(f"{x},{40 * x * x},a\n" for x in range(-6, 7))
PRESS = "d [um];F [mN]\n" + "".join(f"{d};{0.4 * d**1.5:.6f}\n" for d in range(1, 10))
MODULI = "f [Hz],E' [MPa],tan delta\n1,3,0.1\n10,3.5,0.2\n100,4,0.15\n"
ARMS = "E_j [Pa],tau_j [s]\n2e6,1e-2\n4e6,1e-4\n1e5,0.3\n3e6,inf\n"
MATERIAL = """# a rubber at 20 °C, a gel of two arms; E [Pa], tau [s]
[material]
model = "Prony"  # of moduli
E_inf = 3e6
arms = [[2e6, 1e-2], [4e6, 1e-4]]
nu = 0.5
tau = 1e-5
"""

#: what files are made of, and what they are not
SPLINTERS = [
    *("nan", "inf", "-inf", "1e999", "-1e999", "1e-999", "0", "-0.0", "-1", "1_0", "1__0", "0x10", "true", "false"),
    *("{}", "[]", "[[]]", "{a=1}", '"text"', "'text'", '"""', "'''", '"', "'", "1979-05-27", "07:32:00"),
    *("1979-05-27T07:32:00Z", "=", "==", ",", ";", "#", "[", "]", "{", "}", "[[pull]]", "[pull]", "[indenter]"),
    *("[axes]", "[material.arms]", "a.b.c", "tau", "nu", "E", "du_z", "omega", "\\", "\\u0000", "\\ud800", "μ", "∞"),
    *("\u202e", "\ufeff", "\x00", "\x7f", "\t", "\x0b", "\x85", "\u2028", "\r", "\r\n", "\n", "😀"),
]
HUGE = ["9" * 400, "9" * 5000, "1e" + "9" * 30, "[" * 3000, "[" * 200 + "]" * 200, "a." * 500, "{a=" * 300]


def damage_bytes(dice, data):
    where = dice.below(len(data)) if data else 0
    return data[:where] + bytes([dice.below(256)]) + data[where + 1 :]


def damage_bit(dice, data):
    where = dice.below(len(data)) if data else 0
    return data[:where] + bytes(one ^ (1 << dice.below(8)) for one in data[where : where + 1]) + data[where + 1 :]


def cut_out(dice, data):
    low = dice.below(len(data) + 1)
    return data[:low] + data[low + 1 + dice.below(20) :]


def cut_off(dice, data):
    return data[: dice.below(len(data) + 1)]


def put_in(dice, data):
    where = dice.below(len(data) + 1)
    splinter = dice.one_of(HUGE) if dice.happens(0.1) else dice.one_of(SPLINTERS)
    return data[:where] + splinter.encode("utf-8", "surrogatepass") + data[where:]


def another_value(dice, data):
    """One value, of a line or of a list, becomes something else."""
    values = list(re.finditer(rb"(?<=[=,\[])\s*[^,\[\]#\n=]+", data))
    if not values:
        return put_in(dice, data)
    one = dice.one_of(values)
    other = dice.one_of(HUGE) if dice.happens(0.1) else dice.one_of(SPLINTERS)
    if dice.happens(0.5):
        other = repr(dice.one_of([-1.0, 1.0, 1.0]) * dice.size(1e-300, 1e300))
    return data[: one.start()] + b" " + other.encode("utf-8", "surrogatepass") + data[one.end() :]


def lines(change):
    """A change of the lines of a file."""

    def damage(dice, data):
        some = data.split(b"\n")
        change(dice, some)
        return b"\n".join(some)

    damage.__name__ = change.__name__
    return damage


@lines
def line_twice(dice, some):
    some.insert(dice.below(len(some) + 1), dice.one_of(some))


@lines
def line_lost(dice, some):
    some.pop(dice.below(len(some)))


@lines
def lines_swapped(dice, some):
    i, j = dice.below(len(some)), dice.below(len(some))
    some[i], some[j] = some[j], some[i]


@lines
def lines_joined(dice, some):
    i = dice.below(len(some))
    some[i : i + 2] = [b"".join(some[i : i + 2])]


def other_letters(dice, data):
    """As another editor would save it."""
    coding = dice.one_of(["utf-16", "utf-8-sig", "utf-32", "utf-7", "cp037"])
    return data.decode("utf-8", "replace").encode(coding, "replace")


def other_ends(dice, data):
    return data.replace(b"\n", dice.one_of([b"\r\n", b"\r", b"\n\n", b"\x85"]))


def twice(dice, data):
    return data + data


def nothing(dice, data):
    return dice.one_of([b"", b" ", b"\n", b"\x00", b"\xef\xbb\xbf", b"\xff" * 64, bytes(range(256))])


CHANGES = (
    *(damage_bytes, damage_bit, cut_out, cut_off, put_in, put_in, another_value, another_value, another_value),
    *(line_twice, line_lost, lines_swapped, lines_joined, other_letters, other_ends, twice, nothing),
)


def damaged(dice, data):
    """What one to four blows leave."""
    for _ in range(1 if dice.happens(0.6) else 2 + dice.below(3)):
        data = dice.one_of(CHANGES[:-1] if dice.happens(0.9) else CHANGES)(dice, data)
    return data


@cache
def files():
    """Sound files by kind: (name, bytes) each."""
    cases = [
        examples.example(shape, material, motion, pull)
        for shape in examples.SHAPES
        for material, motion, pull in zip(
            list(examples.MATERIALS) * 2, list(examples.MOTIONS) * 4, list(examples.PULLS) * 5, strict=False
        )
        if not (shape == "ConcavePunch" and motion == "LoadOscillation")
    ]
    study = mdr.sweep(examples.example("Cone", "Elastic", pull="RigidPull"), {"v_0/v_c": [0.2, 0.5]})
    with tempfile.TemporaryDirectory() as folder:
        study.to_netcdf(Path(folder) / "study.nc")
        stored = (Path(folder) / "study.nc").read_bytes()
    return {
        "case": [("case.toml", examples.example_file(case).encode()) for case in cases],
        "written case": [("case.toml", mdr.write_case(case).encode()) for case in cases],
        "study": [("study.toml", (ROOT / "docs" / "study.toml").read_bytes())],
        "friction": [("friction.csv", text.encode()) for text in (FRICTION, FRICTION.replace(",", ";"))],
        "profile": [("scan.csv", SCAN.encode())],
        "force": [("press.csv", PRESS.encode())],
        "moduli": [("moduli.csv", MODULI.encode())],
        "arms": [("arms.csv", ARMS.encode())],
        "material": [("arms.toml", MATERIAL.encode())],
        "stored study": [("study.nc", stored)],
    }


READERS = {
    "case": mdr.read_case,
    "written case": mdr.read_case,
    "study": read_study_file,
    "friction": mdr.read_friction_data,
    "profile": mdr.SampledProfile.read,
    "force": lambda path: mdr.FromForce.read(path, E_star=1e6),
    "moduli": mdr.read_moduli,
    "arms": lambda path: mdr.Prony.read(path, nu=0.5),
    "material": mdr.Prony.read,
    "stored study": mdr.read_study,
}
ERRORS = {"case": CaseFileError, "written case": CaseFileError, "study": CaseFileError, "stored study": mdr.StudyError}


def read(kind, path):
    """The record in a file, "" and all it says; or None and why not, in words that name the file and the fault."""
    try:
        record = READERS[kind](path)
    except ERRORS.get(kind, ValueError) as refusal:
        message = str(refusal)
        assert message, "no words"
        for line in message.splitlines() if isinstance(refusal, CaseFileError) else [message]:
            assert line.startswith(str(path)), f"names no file: {line!r}"
            assert len(line) > len(str(path)) + 5, f"names no fault: {line!r}"
            assert len(line) <= LONGEST, f"{len(line)} characters: {line[:200]!r}"
            assert line.isprintable(), f"unprintable: {line!r}"
        return None, message
    if kind != "stored study":  # where a point that failed is NaN
        assert not re.search(r"\b(nan|inf)\b", repr(record)), repr(record)
    assert record == record
    return record, ""


def command(name, path):
    """The command line on a file: its status, and no traceback."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err), warnings.catch_warnings():
        warnings.simplefilter("error")
        status = main([name, str(path)])
    assert status in (0, 1, 2), status
    assert "Traceback" not in err.getvalue(), err.getvalue()
    assert (status == 0) or err.getvalue().strip(), f"status {status} without a word"
    return status


def one(seed, folder, kinds=tuple(READERS)):
    """Damage one file and read it: its kind, the name of what was done, the record and the words."""
    dice = anything.Dice(seed)
    kind = dice.one_of(list(kinds))
    name, data = dice.one_of(files()[kind])
    path = Path(folder) / name
    path.write_bytes(damaged(dice, data))
    return kind, path, *read(kind, path)


def is_sound(record):
    """Whether a case in file form comes back as it is."""
    return not isinstance(record, mdr.SlidingContact) or mdr.parse_case(mdr.write_case(record)) == record


__all__ = ["command", "damaged", "files", "is_sound", "one", "read"]
