"""Lines of tables: their cells, and one line for what is wrong."""

import sys

import numpy as np
import pytest

from mdr.tools.csv_header import fault
from mdr.tools.csv_table import Tabled, csv_text


def test_a_fault_is_one_printable_line():
    assert str(fault("a\nb", "c\x1bd")) == "a b: c d"


class Tables(Tabled):
    def table(self):
        return csv_text({"name": ["a", ""], "x [m]": np.array([np.pi, np.nan]), "n": [1, 2]})


def test_a_record_is_a_data_frame_to_the_last_digit():
    pytest.importorskip("pandas")
    frame = Tables().to_dataframe()
    assert [*frame.columns] == ["name", "x [m]", "n"]
    assert [*frame["name"]] == ["a", ""]
    assert frame["x [m]"][0] == np.pi
    assert np.isnan(frame["x [m]"][1])
    assert frame["n"].dtype.kind == "i"


def test_without_pandas_it_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match="to_dataframe needs pandas: pip install pandas"):
        Tables().to_dataframe()
