"""Lines of tables: their cells, and one line for what is wrong."""

import pytest

from mdr.tools.csv_table import cells_of, fault


@pytest.mark.parametrize(
    ("line", "cells"), [("1, 2", ["1", "2"]), ('1, "2, 3"', ["1", "2, 3"]), ('"open, 2', ["open, 2"]), ("", [])]
)
def test_a_line_is_its_cells(line, cells):
    assert cells_of(line, "here") == cells


def test_a_line_may_be_cut_elsewhere():
    assert cells_of("1,5;2", "here", ";") == ["1,5", "2"]


def test_a_line_that_cannot_be_cut_says_where_it_stands():
    with pytest.raises(ValueError, match=r"^data\.csv: line 3: field larger than field limit"):
        cells_of("3" * 140_000, "data.csv: line 3")


def test_a_fault_is_one_printable_line():
    assert str(fault("a\nb", "c\x1bd")) == "a b: c d"
