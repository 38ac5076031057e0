"""The student's notebook: its cells run from top to bottom, without Jupyter, and its stored outputs are what comes out.

Where they differ, `python tests/notebook_outputs.py` stores them anew.
"""

import io
import json
from base64 import b64decode
from contextlib import redirect_stdout
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pages
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq

FILE = pages.DOCS / "springs.ipynb"
NOTEBOOK = json.loads(FILE.read_text(encoding="utf-8"))
CODE = {cell["id"]: "".join(cell["source"]) for cell in NOTEBOOK["cells"] if cell["cell_type"] == "code"}


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    """Names after the last cell, and for each cell the number of figures it showed and what it printed."""
    names, shown, printed = {}, dict.fromkeys(CODE, 0), {}
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(tmp_path_factory.mktemp("notebook"))
        plt.close("all")
        for cell, source in CODE.items():
            patch.setattr(plt, "show", lambda cell=cell: _show(shown, cell))
            with redirect_stdout(io.StringIO()) as out:
                exec(compile(source, f"cell {cell}", "exec"), names)
            printed[cell] = out.getvalue()
        names["folder"] = Path.cwd()
    return names, shown, printed


def _show(shown, cell):
    shown[cell] += len(plt.get_fignums())
    for number in plt.get_fignums():
        plt.figure(number).canvas.draw()
    plt.close("all")


def test_it_is_stored_with_what_comes_out(session):
    _, shown, printed = session
    assert (NOTEBOOK["nbformat"], NOTEBOOK["nbformat_minor"]) == (4, 5)
    code = [cell for cell in NOTEBOOK["cells"] if cell["cell_type"] == "code"]
    assert [cell["execution_count"] for cell in code] == list(range(1, len(CODE) + 1))
    for cell in code:
        texts = ["".join(one["text"]) for one in cell["outputs"] if one.get("name") == "stdout"]
        assert pages.difference("".join(texts), printed[cell["id"]]) == ""
        assert sum("image/png" in one.get("data", ()) for one in cell["outputs"]) == shown[cell["id"]]
        assert not [one for one in cell["outputs"] if one["output_type"] == "error" or one.get("name") == "stderr"]
    (moving,) = next(cell["outputs"] for cell in code if cell["id"] == "animation")
    assert b64decode("".join(moving["data"]["text/html"]).split("base64,")[1].split('"')[0])[:6] == b"GIF89a"
    assert FILE.stat().st_size < 1e6


def test_its_cells_run_and_show_their_figures(session):
    names, shown, _ = session
    draws = {cell: "plots.plot" in source or "slide_all(" in source for cell, source in CODE.items()}
    assert shown == draws
    assert sum(draws.values()) == 6
    assert (names["folder"] / "springs.gif").stat().st_size > 1e5


def test_what_it_says_of_the_numbers_given_is_so(session):
    names, *_ = session
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
    names, *_ = session
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
