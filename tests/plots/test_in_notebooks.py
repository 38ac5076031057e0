"""Pictures in Jupyter: each appears exactly once, ours and the user's, with and without `%matplotlib inline`."""

from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

ROOT = Path(__file__).parents[2]
BEGIN = """
import numpy as np
import mdr
from mdr import plots
motion = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
case = mdr.SlidingContact(mdr.FlatPunch(a=1e-3), mdr.Elastic(E=3e6, nu=0.5), 0.5, motion)
curve = mdr.cof_curve(case, np.linspace(0, 1e-3, 4))
run = mdr.slide(case, 3e-4, n_springs=32, steps_per_period=32, record=1)
study = mdr.sweep(case, {"oscillation.du_z": [1e-6, 2e-6], "v_0/v_c": [0.2, 0.6]}, quantities=("cof",))
"""
#: source of a cell, and how many pictures it has
CELLS = {
    "curve.plot()": 1,
    "curve.plot()  # again": 1,
    "import matplotlib.pyplot as plt\nplt.plot([1, 2])": 1,
    "run.plot()": 1,
    "shown = run.plot()": 1,
    "shown": 1,
    "plots.plot_profile(case.indenter, 20e-6)": 1,
    "study.plot()": 1,
    "study.plot_multiples('cof', over='oscillation.du_z')": 1,
    "curve.plot().figure": 1,
    "for _ in range(2): run.plot()": 2,
    "run.plot()\nplt.show()": 1,
    "with plots.style({'font.size': 8}): plt.subplots()": 1,
    "plt.plot([2, 1])": 1,
    "run.mu_0": 0,
}

AGAIN = ("curve.plot()", "run.plot()", "plt.plot([2, 1])")


@pytest.fixture
def cells(monkeypatch):
    """The cells of a notebook that was run, as its file has them: first without `%matplotlib inline`, then with it."""
    sources = [BEGIN, *CELLS, "%matplotlib inline", *AGAIN]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(source) for source in sources])
    monkeypatch.delenv("MPLBACKEND", raising=False)
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    NotebookClient(notebook, kernel_name="python3", timeout=240).execute()
    return notebook.cells


def test_each_picture_appears_once(cells):
    drawn = [sum("image/png" in output.get("data", ()) for output in cell.outputs) for cell in cells]
    assert drawn == [0, *CELLS.values(), 0, 1, 1, 1]
