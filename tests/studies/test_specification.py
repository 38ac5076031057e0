"""What makes two studies the same: the data of their records, and nothing of where and when they were made."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from grids import BODY, RIGID

import mdr
from mdr.studies.axes import read_axes
from mdr.studies.quantities import CATALOGUE
from mdr.studies.specification import described, identity_of, specification
from mdr.studies.work import Work
from mdr.tools.sources import texts


def identity(case=RIGID, axes=None, quantities=("v_c",), **knobs):
    known = read_axes(case, axes or {"mu_0": [0.1, 0.2]})
    return identity_of(specification(Work(case, known, tuple(CATALOGUE[name] for name in quantities), **knobs)))


def test_the_identity_is_that_of_what_was_asked():
    assert identity() == identity(replace(RIGID, mu_0=np.float64(0.5)), {"mu_0": np.array([0.1, 0.2])})
    others = [
        identity(BODY),
        identity(axes={"mu_0": [0.1, 0.3]}),
        identity(axes={"mu_0": [0.2, 0.1]}),
        identity(axes={"T": [0.1, 0.2]}),
        identity(quantities=("v_c", "static_cof")),
        identity(quantities=("static_cof", "v_c")),
        identity(n_springs=64),
        identity(steps_per_period=64),
    ]
    assert len({identity(), *others}) == 9


@pytest.mark.parametrize(
    ("module", "counts"),
    [
        ("mdr.march.kernels", True),
        ("mdr.closed_forms.paper", True),
        ("mdr.tools.anderson", True),
        ("mdr.studies.quantities", True),
        ("mdr.plots.figures", False),
        ("mdr.commands.sweep", False),
    ],
)
def test_a_study_is_of_the_sources_that_can_move_its_values(module, counts, monkeypatch):
    known = identity()
    monkeypatch.setitem(texts(), module, texts()[module] + "\n")
    assert (identity() != known) == counts


def test_values_as_trees():
    assert described(mdr.Prony(1e6, [(1e6, 1e-3)], 0.5)) == {
        "record": "Prony", "E_inf": 1e6, "arms": [[1e6, 1e-3]], "nu": 0.5, "tau": 0.0,
    }  # fmt: skip
    assert described((np.float64(0.1), np.arange(2), None, "a", True)) == [0.1, [0, 1], None, "a", True]


@dataclass(frozen=True)
class Bowl(mdr.Indenter):
    """A shape of one's own."""

    curvature: float

    def profile_1d(self, x):
        return self.curvature * np.square(x)


class Plain(mdr.Indenter):
    """One that is no dataclass."""

    def profile_1d(self, x):
        return 100.0 * np.square(x)


def test_a_shape_of_one_s_own_is_told_by_its_module(tmp_path):
    axes = {"indenter": [Bowl(100.0), Bowl(200.0)], "mu_0": [0.5]}
    found = mdr.sweep(RIGID, axes, tmp_path, quantities=["k_zc"])
    assert found["k_zc"][0, 0] > found["k_zc"][1, 0]
    assert described(Bowl(100.0))["record"] == f"{Bowl.__module__}.Bowl"


def test_what_cannot_be_told_by_its_data_is_refused_in_a_store_alone(tmp_path):
    with pytest.raises(ValueError, match="cannot be told by its data, as a store must"):
        mdr.sweep(RIGID, {"indenter": [Plain()]}, tmp_path / "store", quantities=["k_zc"])
    assert mdr.sweep(RIGID, {"indenter": [Plain()]}, quantities=["k_zc"]).complete


def test_a_case_that_no_file_can_carry_is_told_in_words(tmp_path):
    bowl = mdr.Profile(lambda r: 100 * r**2, name="bowl")
    study = mdr.sweep(replace(RIGID, indenter=bowl), {"mu_0": [0.5]}, tmp_path, quantities=["k_zc"])
    assert study.case.startswith("SlidingContact(indenter=Profile(f=<function")
    assert "name='bowl'" in study.case
    assert " at 0x" not in study.case
    assert mdr.read_study(tmp_path) == study
