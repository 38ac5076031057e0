"""Where a table stands: cells of a line, lines above a header, a row of units, letters of a file."""

import pytest

from mdr.tools.csv_layout import cells_of, decoded, is_like_number, layouts, likely, lines_of, told_separator


@pytest.mark.parametrize(
    ("line", "cells"), [("1, 2", ["1", "2"]), ('1, "2, 3"', ["1", "2, 3"]), ('"open, 2', ["open, 2"]), ("", [])]
)
def test_a_line_is_its_cells(line, cells):
    assert cells_of(line, ",") == cells
    assert cells_of("1,5;2", ";") == ["1,5", "2"]
    assert cells_of(" 1,5   2 ", " ") == ["1,5", "2"]


NUMBERS = ["1", "-1.5", "−1,5", ".5", "5.", "1,", "1e-3", "1,5E+3", "1.234,5", "1,234.5", "inf", "NaN"]
OTHERS = ["", "1.2.2024", "12:00", "0,1.0,25", "1 2", "3 mm", "a1"]


@pytest.mark.parametrize("cell", NUMBERS + OTHERS)
def test_spellings_of_a_number_are_known(cell):
    assert is_like_number(cell) == (cell in NUMBERS)


TABLES = {
    "commas": ("t [s],a [g]\n0,1\n1,2\n", []),
    "preamble": ("Rate,1000\nDate;1.2.2024\n\nt [s],a [g]\n0,1\n1,2\n", []),
    "units below": ("made\nt,a\ns,g\n0,1\n1,2\n", ["s", "g"]),
    "brackets, tabs, commas": ("t\ta\n[s]\t[g]\n0,0\t1,5\n1,0\t2,5\n", ["s", "g"]),
    "a comment": ("# made\n% t [s] a [g]\n0 1\n1 2\n", []),
    "blanks": ("t [s]  a [g]\n 0  1\n 1  2\n", []),
    "commas above blanks": ("# t [s], a [g]\n0 1\n1 2\n", []),
}


@pytest.mark.parametrize(("text", "below"), TABLES.values(), ids=TABLES)
def test_the_likely_header_stands_above_the_rows(text, below):
    found = max(likely(lines_of(text, None), told_separator(text)), key=lambda one: one[1])[0]
    assert [head.partition(" ")[0] for head in found.heads] == ["t", "a"]
    assert found.below == below
    assert len(found.rows) == 2


def test_skip_is_lines_of_the_file_and_the_header_is_the_next():
    text = "x,y\n\n1,2\nt,a\n3,4\n"
    found = [one.heads for one in layouts(lines_of(text, None), "", None)]
    assert ["x", "y"] in found
    assert {tuple(one.heads) for one in layouts(lines_of(text, 2), "", 2)} == set()
    assert ["t", "a"] in [one.heads for one in layouts(lines_of(text, 3), "", 3)]


@pytest.mark.parametrize("coding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-be", "cp1252"])
def test_letters_of_a_file(coding):
    data = "µm\n".encode(coding)
    text, said = decoded(b"\xfe\xff" + data if coding == "utf-16-be" else data)
    assert text == "µm\n"
    assert said == ("line 1 is not UTF-8: letters are read as Latin-1" if coding == "cp1252" else "")
