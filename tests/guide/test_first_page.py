"""The first page: its picture is drawn as it stands, its words are few, and its commands are those of the tests."""

import re
import runpy
import shlex

import numpy as np
import pages
import pytest
from matplotlib.testing.compare import compare_images
from PIL import Image
from test_docs import SAME

README = (pages.ROOT / "README.md").read_text(encoding="utf-8")


def prose(page):
    """What is read of a page: no code, no marks, no targets of links, no lists set from the record."""
    text = re.sub(r"<!--= verdicts.*?<!--= end -->", "", pages.FENCE.sub("", page), flags=re.DOTALL)
    return re.sub(r"<!--.*?-->|(?<=\])\([^)]*\)|\*", "", text, flags=re.DOTALL)


@pytest.fixture(scope="module")
def drawn():
    names = runpy.run_path(str(pages.DOCS / "picture.py"))
    run = names["shown"]()
    return names["figure"](run), lambda path: names["animate"](path, run)


def test_the_picture_is_drawn_as_it_stands(drawn, tmp_path):
    stored = pages.DOCS / "picture.png"
    assert stored.stat().st_size < 2e5
    drawn[0].savefig(tmp_path / "picture.png", dpi=150)
    assert compare_images(str(stored), str(tmp_path / "picture.png"), tol=SAME) is None
    assert "docs/picture.png" in README


def test_the_moving_picture_is_drawn_as_it_stands(drawn, tmp_path):
    stored = pages.DOCS / "animation.gif"
    assert stored.stat().st_size < 7e5
    with Image.open(stored) as one, Image.open(drawn[1](tmp_path / "animation.gif")) as other:
        assert one.n_frames == other.n_frames
        for k in (0, 25, 50):
            one.seek(k), other.seek(k)
            difference = np.asarray(one.convert("RGB"), float) - np.asarray(other.convert("RGB"), float)
            assert np.sqrt(np.mean(difference**2)) < SAME
    assert "docs/animation.gif" in README


def test_the_set_up_is_drawn_as_it_stands_and_shown():
    stored = (pages.DOCS / "set_up.svg").read_text(encoding="utf-8")
    drawn = runpy.run_path(str(pages.DOCS / "set_up.py"))["written"]()
    texts = re.compile(r"<!-- (.*) -->")
    assert len(stored) < 4e4
    assert texts.findall(stored) == texts.findall(drawn)
    assert stored.count("<path") == drawn.count("<path")
    for page in ("README.md", "docs/tutorial.md", "docs/paper.md"):
        assert "set_up.svg" in (pages.ROOT / page).read_text(encoding="utf-8")


def test_a_package_index_gets_no_relative_picture_or_link():
    pytest.importorskip("hatchling")
    for_an_index = runpy.run_path(str(pages.ROOT / "hatch_build.py"))["for_an_index"]
    targets = re.findall(r"(!?)\[[^\]]*\]\(([^)]+)\)", README)
    assert targets
    at = for_an_index(README, "https://example.org/a/b", "v1.2.3")
    for picture, target in targets:
        assert f"(https://example.org/a/b/{'raw' if picture else 'blob'}/v1.2.3/{target})" in at
    bare = for_an_index(README, "", "v1.2.3")
    assert "](" not in bare
    assert "![" not in bare
    assert pages.FENCE.findall(bare) == pages.FENCE.findall(at) == pages.FENCE.findall(README)
    kept = "see [Eq](https://x.org), [here](#limits)"
    assert for_an_index(kept, "", "v1") == kept


def test_it_is_read_in_some_minutes():
    assert len(prose(README).split()) <= 820


@pytest.mark.parametrize(("name", "most"), [("dither", 400), ("drive", 400), ("other_contacts", 400), ("design", 700)])
def test_a_page_that_people_look_for_is_short(name, most):
    assert len(prose((pages.DOCS / f"{name}.md").read_text(encoding="utf-8")).split()) <= most


@pytest.mark.parametrize("name", ["README.md", "docs/index.md", "docs/claims.md"])
def test_no_sentence_is_long(name):
    text = prose((pages.ROOT / name).read_text(encoding="utf-8"))
    paragraphs = re.split(r"\n\s*\n|\n- |\|", text)
    sentences = [sentence for one in paragraphs for sentence in re.split(r"(?<=[.?!:;])\s", one)]
    longest = max(sentences, key=lambda sentence: len(sentence.split()))
    assert len(longest.split()) <= 30, longest


def test_its_test_command_is_the_one_that_every_change_runs():
    """Both install the distribution in place with the extra `test`, and run pytest without arguments."""
    ci = (pages.ROOT / ".ci" / "run").read_text(encoding="utf-8")
    command = next(line for line in README.splitlines() if line.endswith("-m pytest"))
    made, installed, tested = command.split(" && ")
    assert made in ci
    assert f"\n{tested}\n" in ci
    (extras,) = re.findall(r"pip install -q --no-compile -e '\.\[([\w,]+)\]'", ci)
    assert shlex.split(installed)[-1] == ".[test]"
    assert "test" in extras.split(",")
