"""Lines of tables: their cells, and one line for what is wrong."""

import csv

import numpy as np

from mdr.tools.csv_header import fault
from mdr.tools.csv_table import Tabled, csv_text


def test_a_fault_is_one_printable_line():
    assert str(fault("a\nb", "c\x1bd")) == "a b: c d"


class Tables(Tabled):
    def table(self):
        return csv_text({"name": ["a", ""], "x [m]": np.array([np.pi, np.nan]), "n": [1, 2]})


def test_a_table_reads_back_to_the_last_digit():
    head, (name, x, n), second = csv.reader(Tables().table().splitlines())
    assert head == ["name", "x [m]", "n"]
    assert (name, float(x), n) == ("a", np.pi, "1")
    assert second == ["", "nan", "2"]
