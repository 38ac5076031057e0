"""Where a table stands: cells of a line, lines above a header, a row of units, several tables, letters of a file."""

from operator import attrgetter

import pytest

from mdr.tools.csv_layout import (
    blocks,
    cells_of,
    decoded,
    is_like_number,
    kind_of,
    lines_of,
    separators_of,
)


@pytest.mark.parametrize(
    ("line", "cells"), [("1, 2", ["1", "2"]), ('1, "2, 3"', ["1", "2, 3"]), ('"open, 2', ["open, 2"]), ("", [])]
)
def test_a_line_is_its_cells(line, cells):
    assert cells_of(line, ",") == cells
    assert cells_of("1,5;2", ";") == ["1,5", "2"]
    assert cells_of(" 1,5   2 ", " ") == ["1,5", "2"]
    assert cells_of('a  "b c"', " ") == ["a", "b c"]


NUMBERS = ["1", "-1.5", "−1,5", ".5", "5.", "1,", "1e-3", "1,5E+3", "1.234,5", "1,234.5", "inf", "NaN"]
OTHERS = ["", "1.2.2024", "12:00", "0,1.0,25", "1 2", "3 mm", "a1"]


@pytest.mark.parametrize("cell", NUMBERS + OTHERS)
def test_spellings_of_a_number_are_known(cell):
    assert is_like_number(cell) == (cell in NUMBERS)


TABLES = {
    "commas": ("t [s],a [g]\n0,1\n1,2\n", []),
    "preamble": ("Rate,1000\nDate;1.2.2024\n\nt [s],a [g]\n0,1\n1,2\n", []),
    "units below": ("made\nt,a\ns,g\n0,1\n1,2\n", ["s", "g"]),
    "units above": ("made\ns,g\nt,a\n0,1\n1,2\n", ["s", "g"]),
    "units in a line": ("# units: s g\nmade\nt a\n0 1\n1 2\n", ["s", "g"]),
    "brackets, tabs, commas": ("t\ta\n[s]\t[g]\n0,0\t1,5\n1,0\t2,5\n", ["s", "g"]),
    "a comment": ("# made\n% t [s] a [g]\n0 1\n1 2\n", []),
    "blanks": ("t [s]  a [g]\n 0  1\n 1  2\n", []),
    "commas above blanks": ("# t [s], a [g]\n0 1\n1 2\n", []),
}


@pytest.mark.parametrize(("text", "below"), TABLES.values(), ids=TABLES)
def test_the_header_stands_above_the_rows(text, below):
    lines = lines_of(text, None)
    found = max((one for by in separators_of(text) for one in blocks(lines, by)), key=attrgetter("share"))
    names = next(found.names())
    assert [head.partition(" ")[0] for head in names.cells] == ["t", "a"]
    assert names.units == below
    assert len(found.rows) == 2


#: lines between two rows of "1,2", and how many rows each table then has
BETWEEN = {
    "nothing": ("", [2]),
    "a blank line": ("\n", [2]),
    "a short row": ("1\n", [3]),
    "a hole": ("1,No Data\n", [3]),
    "a remark": ("# dry\n", [2]),
    "words": ("the end\n", [1, 1]),
    "a header": ("t,a\n", [1, 1]),
    "the comment above": ("# t,a\n", [1, 1]),
}


@pytest.mark.parametrize(("between", "counts"), BETWEEN.values(), ids=BETWEEN)
def test_words_part_tables_and_rows_with_a_fault_do_not(between, counts):
    found = blocks(lines_of(f"# t,a\n1,2\n{between}3,4\n", None), ",")
    assert [len(one.rows) for one in found] == counts
    assert [one.named is None for one in found] == [True, between != "the end\n"][: len(counts)]


def test_skip_is_lines_of_the_file():
    text = "x,y\n\n1,2\nt,a\n3,4\n"
    assert [next(one.names()).cells for one in blocks(lines_of(text, None), ",")] == [["x", "y"], ["t", "a"]]
    assert [next(one.names()).cells for one in blocks(lines_of(text, 3), ",")] == [["t", "a"]]


@pytest.mark.parametrize("coding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-be", "utf-16-le", "cp1252", "shift_jis"])
def test_letters_of_a_file(coding):
    letter = "μ" if coding == "shift_jis" else "µ"
    data = f"{letter}m\n".encode(coding)
    text, said = decoded(b"\xfe\xff" + data if coding == "utf-16-be" else data)
    assert text == f"{letter}m\n"
    known = {"cp1252": "Latin-1", "shift_jis": "Shift-JIS"}
    assert said == (f"line 1 is not UTF-8: letters are read as {known[coding]}" if coding in known else "")


KINDS = {
    b"PK\x03\x04\x14\x00": "an Excel workbook", b"MATLAB 5.0 MAT-file": "a MATLAB file", b"\x89HDF\r\n": "an HDF5",
    b"RIFF\x24\x00WAVE": "a sound file", b"\x1f\x8b\x08": "a gzip archive", b"%PDF-1.7": "a PDF",
    b"\x89PNG\r\n": "an image", b"\xd0\xcf\x11\xe0": "an Excel workbook", b"<html>": "a page of HTML",
    b"a,b\n1\x00,2\n": "no text, it has a zero byte at 5",
}  # fmt: skip


@pytest.mark.parametrize("data", [*KINDS, b"", b"t,a\n", "t,a".encode("utf-16")])
def test_what_is_no_text_is_named(data):
    assert kind_of(data).startswith(KINDS.get(data, ""))
    assert bool(kind_of(data)) == (data in KINDS)
