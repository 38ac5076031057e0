"""TOML as text: what cannot be read, what is no TOML, and values as they are written."""

import pytest

from mdr.files import toml_text
from mdr.files.toml_text import CaseFileError, parse_toml, read_text, toml_value

SYNTAX = {
    "unit": (
        "a = 1\nR = 5 mm",
        "line 2: R = 5 mm: more than one value; write one number in SI, or a quantity in quotes",
    ),
    "arithmetic": (
        "R = 5*1e-3",
        "line 1: R = 5*1e-3: more than one value; write one number in SI, or a quantity in quotes",
    ),
    "name without quotes": ("[indenter]\nshape = Cone", 'line 2: shape = Cone: a name is written in quotes, "Cone"'),
    "point without a digit": ("R = 2000.  # m", "line 1: R = 2000. # m: a number has a digit after its point, 2.0"),
    "no value": ("R = ", "line 1: R =: no number, name in quotes or list"),
    "key given twice": ("a = 1\na = 2\n[b]", "line 2: a = 2: Cannot overwrite a value; is it given twice?"),
    "key given twice at the end": ("a = 1\na = 2", "line 2: a = 2: Cannot overwrite a value; is it given twice?"),
    "table given twice": ("[a]\n[a]\n", "line 2: [a]: Cannot declare ('a',) twice; is it given twice?"),
    "open string": ('a = "', 'line 1: a = ": '),
    "no TOML": ("{}", "line 1: {}: "),
    "digits": ("a = " + "1" * 5000, "a number has thousands of digits"),
    "nesting": ("a = " + "[" * 100_000, "nested too deeply"),
    "nesting by dots": ("R" + ".a" * 200_000 + " = 1", "nested too deeply"),
    "nesting by dots, with blanks": ("[" + "a . " * 20_000 + "a]", "nested too deeply"),
}


@pytest.mark.parametrize(("text", "message"), SYNTAX.values(), ids=SYNTAX)
def test_what_is_no_toml_is_shown_with_its_line(text, message):
    with pytest.raises(CaseFileError) as refused:
        parse_toml(text, source="x.toml")
    (fault,) = refused.value.faults
    assert fault.startswith(f"x.toml: {message}")


def test_what_cannot_be_read_is_one_line(tmp_path):
    for path, message in [
        (tmp_path / "none.toml", "cannot be read: No such file or directory"),
        (tmp_path, "cannot be read: Is a directory"),
        ("a\0b", "cannot be read: embedded null byte"),
    ]:
        with pytest.raises(CaseFileError) as refused:
            read_text(path)
        assert len(refused.value.faults) == 1
        assert message in str(refused.value)


def test_encodings(tmp_path):
    path = tmp_path / "case.toml"
    path.write_bytes(b"\xef\xbb\xbf# \xce\xbc\r\na = 1\r\n")  # as editors on Windows save it
    assert read_text(path) == "# μ\r\na = 1\r\n"
    path.write_bytes(b"a = 1\n# \xb5m\n")
    with pytest.raises(CaseFileError, match=r"line 2 is not UTF-8 text \(byte 0xb5\); save the file as UTF-8"):
        read_text(path)


def test_a_file_too_large_is_no_case(tmp_path, monkeypatch):
    monkeypatch.setattr(toml_text, "MAX_BYTES", 100)
    path = tmp_path / "case.toml"
    path.write_text("#" * 101)
    with pytest.raises(CaseFileError, match="no case file"):
        read_text(path)


@pytest.mark.parametrize("value", ['μ "quoted" \\ \x7f\n', True, 3, 10**30, 0.1, 5e-324, [1.0, [2.0, "a"]]])
def test_a_value_comes_back(value):
    assert parse_toml(f"a = {toml_value(value)}")["a"] == value
