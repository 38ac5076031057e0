"""The code of README and guide runs as it stands, from top to bottom."""

import re
from pathlib import Path

import matplotlib as mpl
import pytest

ROOT = Path(__file__).parents[1]


@pytest.mark.parametrize("page", ["README.md", "docs/studies.md", "docs/own_data.md"])
def test_the_code_of_a_page_runs(page, tmp_path, monkeypatch):
    mpl.use("Agg")
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(encoding="utf-8"), re.DOTALL)
    assert blocks
    names = {"__name__": "guide"}  # what starts processes stands under if __name__ == "__main__"
    for block in blocks:
        exec(compile(block, page, "exec"), names)
    made = {path.name for path in tmp_path.iterdir()}
    asked = set(re.findall(r'"(\w+\.(?:png|csv|nc))"', "".join(blocks)))
    assert asked <= made
