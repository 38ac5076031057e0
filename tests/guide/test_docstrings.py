"""Docstrings of what users call: sections that name each argument, and examples that run."""

import doctest
import inspect
import pkgutil
import re
import sys
from dataclasses import fields, is_dataclass
from enum import Enum

import pages
import pytest

import mdr
from mdr import plots
from mdr.plots import animation

numpydoc = pytest.importorskip("numpydoc.docscrape")
sys.path.append(str(pages.DOCS / "extensions"))


def functions():
    """Public functions, and the public methods of public classes where they are first defined, {path: function}."""
    drawing = (plots.plot_curve, plots.plot_fit, plots.plot_spring_map, plots.plot_traces, plots.plot_profile)
    found = {f"plots.{one.__name__}": one for one in (*drawing, animation.animate_springs)}
    for name in mdr.__all__:
        one = getattr(mdr, name)
        if inspect.isfunction(one):
            found[name] = one
        elif inspect.isclass(one):
            homes = [home for home in reversed(one.__mro__) if home.__module__.startswith("mdr.")]
            for home in homes:
                for method, raw in vars(home).items():
                    function = getattr(raw, "__func__", raw)
                    first = next(base for base in homes if method in vars(base))
                    if inspect.isfunction(function) and not method.startswith("_") and first is home:
                        found[f"{home.__name__}.{method}"] = function
    return found


FUNCTIONS = functions()
CLASSES = {name: one for name in mdr.__all__ if inspect.isclass(one := getattr(mdr, name)) and ">>>" in one.__doc__}
RECORDS = [one for name in mdr.__all__ if is_dataclass(one := getattr(mdr, name))]
WITH_EXAMPLES = [name for name in mdr.__all__ if inspect.isfunction(getattr(mdr, name))]


def faults(function):
    """What a docstring lacks."""
    found = []
    doc = numpydoc.FunctionDoc(function)
    given = [name for name in inspect.signature(function).parameters if name not in ("self", "cls")]
    named = [name.strip(" *") for one in doc["Parameters"] for name in one.name.split(",")]
    if named != given:
        found.append(f"Parameters names {named}, the function takes {given}")
    if inspect.signature(function).return_annotation not in (None, "None") and not doc["Returns"]:
        found.append("no Returns")
    if any(not one.desc for section in ("Parameters", "Returns", "Raises") for one in doc[section]):
        found.append("an entry without a word")
    if len(" ".join(doc["Summary"])) > 120 or len(doc["Summary"]) != 1:
        found.append("the summary is not one line")
    return found


@pytest.mark.parametrize("path", FUNCTIONS)
def test_sections_name_the_arguments(path):
    assert not faults(FUNCTIONS[path])


def test_every_name_of_the_reference_has_an_example():
    """In its docstring, on its page, in the starting files; a result where it is returned."""
    facts = pytest.importorskip("facts")
    without = []
    for page in sorted((pages.DOCS / "api").glob("*.md")):
        blocks = pages.blocks(page)
        code = "".join(block.text for block in blocks if block.language == "python")
        for path in (one for block in blocks for one in pages.documented(block.text)):
            one, name = pkgutil.resolve_name(path), path.rpartition(".")[2]
            is_shown = ">>>" in (one.__doc__ or "") or re.search(rf"\b{name}\(", code)
            if inspect.isclass(one):
                exempt = inspect.isabstract(one) or issubclass(one, Exception | Enum)
                is_shown = is_shown or exempt or facts.example_of(one) or [*facts.makers(one)]
            if not (is_shown or inspect.ismodule(one)):
                without.append(path)
    assert not without


@pytest.mark.parametrize("record", RECORDS, ids=lambda record: record.__name__)
def test_types_of_fields_are_in_plain_words(record):
    facts = pytest.importorskip("facts")
    for field in fields(record):
        assert "." not in facts.type_of(field.type).replace("...", ""), field.name


@pytest.mark.parametrize("path", [*FUNCTIONS, *CLASSES])
def test_examples_run(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    function = FUNCTIONS.get(path) or CLASSES[path]
    tests = doctest.DocTestFinder(recurse=False).find(function, path, module=False, globs={})
    examples = [one for test in tests for one in test.examples]
    assert examples or path not in WITH_EXAMPLES
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    for test in tests:
        runner.run(test, out=sys.stdout.write)
    assert runner.summarize(verbose=False).failed == 0
