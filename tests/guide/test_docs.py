"""The guide: its code runs and prints what is shown, its links lead somewhere, its formulas are those of the code."""

import os
import pkgutil
import re
import runpy
import shlex
import subprocess
import sys
from inspect import isfunction

import gallery_page
import laws_page
import matplotlib.pyplot as plt
import pages
import pytest
from matplotlib.testing.compare import compare_images

import mdr

ROOT, DOCS = pages.ROOT, pages.DOCS
SAME = 12.0  #: root mean square over the pixels, of 255: letters of another font or version make a few


@pytest.mark.parametrize("page", pages.PAGES, ids=lambda page: page.name)
def test_a_page_does_what_it_says(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(ROOT)
    monkeypatch.setattr("mdr.files.own_records._OWN", {})  # what a page registers is its own
    shown = pages.run(page)
    plt.close("all")
    wrong = {f"{page.name}:{block.line}": why for block, out in shown if (why := pages.difference(block.text, out))}
    assert not wrong
    source = "".join(block.text for block in pages.blocks(page) if block.language == "python")
    for name in re.findall(r'"(\w+\.(?:png|csv|nc|gif))"', source):
        assert (tmp_path / name).exists(), f"{name} is written by the code of the page"
    for name in pages.figures(page):
        assert (DOCS / "figures" / name).stat().st_size < 1e5
        assert compare_images(str(DOCS / "figures" / name), str(pages.made(name)), tol=SAME) is None


@pytest.mark.parametrize(
    ("shown", "printed", "same"),
    [
        ("v_c = 0.5 m/s", "v_c = 0.50001 m/s", True),
        ("v_c = 0.5 m/s", "v_c = 0.51 m/s", False),
        ("24 points", "25 points", False),
        ("error 2.7e-07 (-0.0002 %)", "error 4.1e-07 (-0.0004 %)", True),
        ("one\n...\nfour", "one\ntwo\nthree\nfour", True),
        ("one", "one\ntwo", False),
    ],
)
def test_shown_output_is_compared(shown, printed, same):
    assert (pages.difference(shown, printed) == "") is same


# --- links, names, navigation ---


def prose(page):
    """A page without its blocks of code."""
    return pages.FENCE.sub("", page.read_text(encoding="utf-8"))


@pytest.mark.parametrize("page", pages.PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)\s]+)\)", prose(page)):
        if not re.match(r"[a-z]+:", target):
            assert (page.parent / target.split("#")[0]).exists(), target


@pytest.mark.parametrize("page", pages.PAGES, ids=lambda page: page.name)
def test_files_and_commands_in_a_line_are_there(page):
    """Inline code: paths of the repository exist, commands of mdr are understood."""
    from mdr.__main__ import parser

    for code in re.findall(r"(?<!`)`([^`\n]+)`(?!`)", prose(page)):
        if re.fullmatch(r"(?:mdr|docs|tests|validation|geometries|\.ci)/[\w./-]*", code):
            assert (ROOT / code).exists(), code
        if re.match(r"(?:\.venv/bin/)?mdr [a-z]+ .*[\w>-]", code) and "..." not in code:
            words = shlex.split(code.split(">")[0])
            parser().parse_args(words[1:])


def test_every_page_is_in_the_navigation(monkeypatch):
    monkeypatch.setattr(sys, "path", [*sys.path])  # conf.py adds to it
    listed = [one for heading in runpy.run_path(str(DOCS / "conf.py"))["PAGES"].values() for one in heading]
    assert len(set(listed)) == len(listed)
    known = {str(path.relative_to(DOCS).with_suffix("")) for path in DOCS.rglob("*.md")}
    assert known - {"index", "paper"} <= set(listed)
    assert set(listed) - known <= {"springs"}


def test_every_public_name_is_documented():
    documented = [
        path
        for page in sorted((DOCS / "api").glob("*.md"))
        for block in pages.blocks(page)
        for path in pages.documented(block.text)
    ]
    assert len(set(documented)) == len(documented)
    laws = {f"laws.{name}" for name in mdr.laws.__all__ if isfunction(getattr(mdr.laws, name))}
    space = {f"half_space.{name}" for name in mdr.half_space.__all__}
    waves = {f"waveforms.{name}" for name in mdr.waveforms.__all__}
    names = {*mdr.__all__, *laws, *space, *waves} - {"laws", "half_space", "waveforms"}
    assert {f"mdr.{name}" for name in names} <= set(documented)
    for path in documented:
        assert (pkgutil.resolve_name(path).__doc__ or "").strip(), path


def test_the_site_builds_without_a_warning_and_needs_no_network(tmp_path):
    for name in ("sphinx", "myst_nb", "numpydoc", "furo"):
        pytest.importorskip(name)
    options = ["-q", "-W", "--keep-going", "-d", tmp_path / "trees"]
    command = [sys.executable, "-m", "sphinx", *options, DOCS, tmp_path / "site"]
    built = subprocess.run(command, capture_output=True, text=True, env=os.environ | {"PYTHONWARNINGS": "ignore"})
    assert built.returncode == 0, built.stderr
    elsewhere = (
        r"""<(?:script|img|source|iframe|link)\b[^>]*\b(?:src|href)="(?:https?:)?//|@import|url\(['"]?(?:https?:)?//"""
    )
    for path in (tmp_path / "site").rglob("*.*"):
        if path.suffix in (".html", ".css"):
            assert not re.search(elsewhere, path.read_text(encoding="utf-8")), f"{path.name} loads from the network"
    theory = (tmp_path / "site" / "theory.html").read_text(encoding="utf-8")
    assert theory.count("<math") > 100
    assert "\\frac" not in theory


# --- what stands on the pages ---


def test_figures_are_all_shown():
    shown = {name for page in pages.PAGES for name in pages.figures(page)}
    assert {path.name for path in (DOCS / "figures").iterdir() if path.is_file()} == shown


def test_the_gallery_has_every_script():
    """Where this fails, `python tests/gallery_page.py` draws what is missing and writes the page."""
    assert gallery_page.PAGE.read_text(encoding="utf-8") == gallery_page.page()
    assert {path.stem for path in gallery_page.PICTURES.iterdir()} == set(gallery_page.names())
    assert all(path.stat().st_size < gallery_page.MOST_BYTES for path in gallery_page.PICTURES.iterdir())


def test_the_table_of_laws_is_that_of_their_domains():
    """Where this fails, `python tests/laws_page.py` writes the table anew."""
    assert laws_page.PAGE.read_text(encoding="utf-8") == laws_page.page()


def test_the_paper_has_the_form_that_its_journal_asks_for():
    """Sections and length of the Journal of Open Source Software; every reference is cited, and the other way round."""
    paper = (DOCS / "paper.md").read_text(encoding="utf-8").split("\n---\n", 1)[1]
    sections = ["Summary", "Statement of need", "State of the field", "Software design", "Research impact statement"]
    sections += ["AI usage disclosure", "Acknowledgements", "References"]
    assert re.findall(r"^# (.*)$", paper, re.MULTILINE) == sections
    assert 750 <= len(re.sub(r"<!--.*?-->", "", paper).split()) <= 1750
    assert len(re.findall(r"^!\[.*\]\((\S+)\)", paper, re.MULTILINE)) == 2
    bib = (DOCS / "paper.bib").read_text(encoding="utf-8")
    assert set(re.findall(r"@(\w+)", paper)) == set(re.findall(r"^@\w+\{(\w+),", bib, re.MULTILINE))
