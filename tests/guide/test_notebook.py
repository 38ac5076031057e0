"""The student's notebook: stored without outputs, and its cells run from top to bottom, without Jupyter."""

import json
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq

mpl.use("Agg")
import matplotlib.pyplot as plt

NOTEBOOK = json.loads((Path(__file__).parents[2] / "docs/springs.ipynb").read_text(encoding="utf-8"))
CODE = {cell["id"]: "".join(cell["source"]) for cell in NOTEBOOK["cells"] if cell["cell_type"] == "code"}


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    """Names after the last cell, and for each cell the number of figures it showed."""
    names, shown = {}, dict.fromkeys(CODE, 0)
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(tmp_path_factory.mktemp("notebook"))
        plt.close("all")
        for cell, source in CODE.items():
            patch.setattr(plt, "show", lambda cell=cell: _show(shown, cell))
            exec(compile(source, f"cell {cell}", "exec"), names)
        names["folder"] = Path.cwd()
    return names, shown


def _show(shown, cell):
    shown[cell] += len(plt.get_fignums())
    for number in plt.get_fignums():
        plt.figure(number).canvas.draw()
    plt.close("all")


def test_it_is_stored_without_outputs():
    assert (NOTEBOOK["nbformat"], NOTEBOOK["nbformat_minor"]) == (4, 5)
    code = [cell for cell in NOTEBOOK["cells"] if cell["cell_type"] == "code"]
    assert all((cell["execution_count"], cell["outputs"]) == (None, []) for cell in code)
    assert len(CODE) == len(code)


def test_its_cells_run_and_show_their_figures(session):
    names, shown = session
    draws = {cell: "plots.plot" in source or "slide_all(" in source for cell, source in CODE.items()}
    assert shown == draws
    assert sum(draws.values()) == 6
    assert (names["folder"] / "springs.gif").stat().st_size > 1e5


def test_what_it_says_of_the_numbers_given_is_so(session):
    names, _ = session
    run, v_c = names["run"], names["v_c"]
    assert_allclose(v_c, names["case"].mu_0 * 1.5 * names["omega"] * names["du_z"])  # Eq. (1), E*/G* = 3/2 for nu = 1/2
    assert run.v_0 < v_c
    assert run.cof < run.mu_0
    sticks = [np.any(one.state == names["mdr"].State.STICK) for one in names["runs"]]
    assert sticks == [True, True, True, False]  # 0.1, 0.5, 0.9 and 1.1 of v_c
    assert not np.any(names["at_amplitudes"][0].state == names["mdr"].State.STICK)
    assert np.any(names["at_amplitudes"][-1].F_z == 0)
    punch, ball = names["curves"]  # of the last figure
    assert_allclose(punch.v_c, ball.v_c)
    faster = ball.v_0 > 1.01 * ball.v_c
    assert_allclose(punch.cof[faster], punch.mu_0)
    assert 0 < np.max(ball.mu_0 - ball.cof[faster]) < 0.01 * ball.mu_0


def contact_is_back(product, u_z0, du_z):
    """Relaxed depth of the spring under the tip less u_z0, a quarter period before the deepest point."""

    def load(phase):
        return u_z0 + du_z * np.cos(phase) - product * du_z * np.sin(phase)

    left = brentq(load, 0, np.pi / 2 + np.arctan(1 / product))
    return (u_z0 + du_z * np.cos(left)) * np.exp((left - 1.5 * np.pi) / product) - u_z0


def test_the_exercises_accept_the_right_answers_alone(session, capsys):
    names, _ = session
    u_z0, du_z = names["u_z0"], names["du_z"]
    hertz = (u_z0 + du_z * np.cos(np.arange(360) * np.pi / 180)) ** 1.5
    right = {
        "answer-1": hertz.min() / hertz.mean(),
        "answer-2": 2.0,
        "answer-3": brentq(contact_is_back, 5, 100, args=(u_z0, du_z)),
    }
    for cell, answer in right.items():
        for given, word in ((answer, "Yes"), (1.1 * answer, "too high"), (0.9 * answer, "too low")):
            capsys.readouterr()
            exec(CODE[cell].replace("answer = None", f"answer = {float(given)!r}"), dict(names))
            assert word in capsys.readouterr().out
