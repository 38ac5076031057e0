"""Tables of three dimensions: what is written is read again, and says what made it."""

from dataclasses import replace

import pytest
from numpy.testing import assert_allclose

import mdr
from mdr.half_space.friction import Settings, in_three_dimensions
from validation.half_space import kept, tables
from validation.half_space.springs import of_springs
from validation.half_space.tables import Point

POINTS = [Point("paraboloid", 0.3, 0.3, 0.3, 0.0, v) for v in (0.5, 1.5)]
SETTINGS = Settings(cells=11, steps=12, cycles=20, settled=1e-3)


@pytest.fixture(scope="module")
def rows():
    return tables.compute([POINTS], SETTINGS)


def test_a_row_is_what_a_run_by_itself_gives(rows):
    for row in rows:
        case = row.point.case
        v_0 = row.point.v * mdr.critical_velocity(case)
        alone = in_three_dimensions(case, v_0, replace(SETTINGS, cycles=5, settled=0)).cof
        assert_allclose(row.cof, alone / 0.3, atol=1e-3)  # to which the column is settled
        assert_allclose(row.springs, of_springs(case, v_0, replace(SETTINGS, cycles=20)).cof / 0.3, rtol=1e-12)
        assert row.loss > 3 * row.error > 0


def test_a_table_is_read_as_it_was_written(rows, tmp_path, monkeypatch):
    monkeypatch.setattr(kept, "FOLDER", tmp_path / "tables")
    pair = replace(rows[0], point=replace(rows[0].point, nu_2=0.5))
    path = tables.write("some", [*rows, pair], SETTINGS, "for a test")
    again = tables.read("some")
    assert [row.point for row in again] == [row.point for row in (*rows, pair)]
    assert [row.cycles for row in again] == [row.cycles for row in (*rows, pair)]
    assert_allclose([row.loss for row in again], [row.loss for row in (*rows, pair)], atol=1e-6)  # seven digits
    head = path.read_text().splitlines()[:2]
    assert "for a test; 11 x 11 cells, 12 steps a period" in head[0]
    assert "numpy" in head[1]


@pytest.mark.parametrize("name", ["uncoupled", "coupled", "coupling_held_out"])
def test_every_row_that_is_kept_has_its_errors(name):
    kept = tables.read(name)
    assert len({row.point for row in kept}) == len(kept)
    assert all(0 <= row.error < 0.02 and 0 < row.cof <= 1 + 1e-9 for row in kept)
