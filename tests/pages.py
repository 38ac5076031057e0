"""The pages of the guide as programs: their blocks of code are run from top to bottom, and their output compared.

What a block is, its language says; every language has its rule, and one without a rule is refused.

    python        run, in the names that the blocks above it left
    sh            lines of mdr and sed, and validation --quick --only, are run, but mdr explore is only understood;
                  other commands are looked up among those that are run elsewhere
    toml          read as a case or as a study; one that is commented "# name.toml" in its first line is written there
    json          parsed
    text          what the block above it prints: the same words, and numbers to 1 in 1000
    {eval-rst}    the names it documents are there

`python tests/pages.py` writes the output and the figures of all pages anew; read what changed before it is kept.
"""

import contextlib
import io
import json
import os
import pkgutil
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
sys.path.append(str(DOCS / "extensions"))
from navigation import with_records  # noqa: E402

PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted(DOCS.rglob("*.md"))]
FENCE = re.compile(r"^(`{3,})([^\n`]*)\n(.*?)^\1 *$", re.DOTALL | re.MULTILINE)
FIGURE = re.compile(r"!\[[^\]]+\]\((?:\.\./)?figures/([\w.-]+)\)")

RELATIVE = 1e-3  #: tolerance of a number that is shown
SMALL = 1e-4  #: below it a number written with an exponent is an error bound, and its size is compared
PERCENT = 2e-3  #: tolerance of a percentage, absolute


@dataclass(frozen=True)
class Block:
    """A block of code: its language, its text and the line on which it begins."""

    language: str
    text: str
    line: int


def blocks(page: Path) -> list[Block]:
    """The blocks of a page, in their order."""
    source = page.read_text(encoding="utf-8")
    found = [
        Block(match[2].strip(), match[3], source.count("\n", 0, match.start()) + 1) for match in FENCE.finditer(source)
    ]
    assert source.count("\n```") + source.startswith("```") == 2 * len(found), f"{page.name}: a fence is not closed"
    return found


class Run:
    """A page as it runs, in the working directory."""

    def __init__(self, page: Path) -> None:
        self.page = page
        self.names: dict[str, Any] = {"__name__": "__main__"}
        self.printed: list[str | None] = []  #: by each block that runs
        self.shown: list[tuple[Block, str]] = []  #: text blocks and what was printed
        for file in DOCS.glob("*.toml"):
            shutil.copy(file, ".")

    def all(self) -> "Run":
        """Run every block; returns the page itself."""
        for block in blocks(self.page):
            rule = RULES.get(block.language)
            assert rule, f"{self.page.name}:{block.line}: no rule for a block of {block.language!r}"
            try:
                rule(self, block)
            except Exception as fault:
                fault.add_note(f"in the block of {block.language} at {self.page.name}:{block.line}")
                raise
        return self

    def python(self, block: Block) -> None:
        """Run in the page's names."""
        with captured() as out:
            exec(compile("\n" * block.line + block.text, str(self.page), "exec"), self.names)
        self.printed.append(out.getvalue())

    def sh(self, block: Block) -> None:
        """Run line by line."""
        lines = block.text.replace("\\\n", " ").splitlines()
        self.printed.append("".join(self.command(line) for line in lines))

    def command(self, line: str) -> str:
        """What one line prints; AssertionError for a command without a rule."""
        words = shlex.split(line, comments=True)
        if not words:
            assert not line or line.startswith("#"), line
            return ""
        if words[0] in ("mdr", ".venv/bin/mdr"):
            return mdr_command([str(ROOT / word) if word.startswith("docs/") else word for word in words[1:]])
        if words[0] == "sed":
            return subprocess.run(line, shell=True, check=True, capture_output=True, text=True).stdout
        if words[:3] == [".venv/bin/python", "-m", "validation"] and {"--quick", "--only"} <= set(words):
            return validation_command(words[3:])
        for command in line.split("#")[0].split("&&"):
            require_known(command.strip())
        return ""

    def toml(self, block: Block) -> None:
        """A case or a study."""
        from mdr.files.case_files import parse_case
        from mdr.studies.study_files import parse_study

        (parse_study if "[axes]" in block.text else parse_case)(block.text)
        if name := re.match(r"# (\w+\.toml)\n", block.text):
            Path(name[1]).write_text(block.text, encoding="utf-8")

    def json(self, block: Block) -> None:
        """One value."""
        json.loads(block.text)

    def output(self, block: Block) -> None:
        """What the last block printed."""
        assert self.printed, "nothing ran above it"
        assert self.printed[-1], "the block above it prints nothing, or its output is shown already"
        self.shown.append((block, self.printed[-1]))
        self.printed[-1] = None

    def reference(self, block: Block) -> None:
        """Names of the library."""
        documented(block.text)


RULES = {
    "python": Run.python,
    "sh": Run.sh,
    "toml": Run.toml,
    "json": Run.json,
    "text": Run.output,
    "{eval-rst}": Run.reference,
}


@contextlib.contextmanager
def captured() -> Iterator[io.StringIO]:
    """What is printed meanwhile; progress goes nowhere."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(io.StringIO()):
        yield out


def mdr_command(words: list[str]) -> str:
    """The command line, in this process, with > file and $VARIABLES; returns what it prints."""
    from mdr.__main__ import main, parser

    if words[0] == "explore":  # which serves until it is interrupted
        parser().parse_args(words)
        return ""
    target = None
    if ">" in words:
        words, target = words[: words.index(">")], words[words.index(">") + 1]
    with captured() as out:
        status = main([os.path.expandvars(word) for word in words])
    assert status == 0, f"mdr {shlex.join(words)} ends with {status}"
    if target is None:
        return out.getvalue()
    Path(target).write_text(out.getvalue(), encoding="utf-8")
    return ""


def validation_command(words: list[str]) -> str:
    """Some claims, tested as `python -m validation` tests them."""
    from validation.__main__ import main

    with captured() as out:
        assert main(words) == 0, words
    return out.getvalue()


PIP = (r"python3 -m pip --python \.venv", r"\.venv/bin/python -m pip")  #: the second knows dependency groups


def require_known(command: str) -> None:
    """AssertionError for a command that runs nowhere: set-up and tests are those of .ci/run, claims have a parser."""
    ci = (ROOT / ".ci" / "run").read_text(encoding="utf-8")
    words = shlex.split(command)
    installed = re.fullmatch(f"(?:{'|'.join(PIP)}) install -q -e (\\S+)((?: --group \\w+)*)", command)
    if installed:
        extras = re.fullmatch(r"\.(?:\[([\w,]+)\])?", shlex.split(installed[1])[0])
        assert extras, command
        project = pyproject()
        known = project["project"]["optional-dependencies"]
        assert set(filter(None, (extras[1] or "").split(","))) <= known.keys(), command
        assert set(re.findall(r"--group (\w+)", installed[2])) <= project["dependency-groups"].keys(), command
    elif words[:3] == [".venv/bin/python", "-m", "validation"]:
        from validation import CLAIMS
        from validation.__main__ import _arguments

        _arguments(CLAIMS).parse_args(words[3:])
    elif words[0].startswith("geometries/") or words[-1].startswith("geometries/"):
        assert (ROOT / words[-1]).is_file(), command
    elif command in ("git clone <address of this repository> mdr-friction", "cd mdr-friction"):
        pass  # what comes before everything else
    elif command == ".venv/bin/python -m sphinx -W docs site":
        pass  # test_docs.py builds so
    elif words[:2] == [".venv/bin/python", "tests/pages.py"]:
        assert all((ROOT / name).is_file() for name in words[1:]), command
    elif command == ".ci/run":
        assert (ROOT / ".ci" / "run").is_file()
    else:
        assert command in ci, f"{command!r} is run neither here nor by .ci/run"


def pyproject() -> dict[str, Any]:
    """What pyproject.toml says."""
    import tomllib

    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))


def documented(text: str) -> list[str]:
    """Dotted names that autodoc directives of a text document; each is imported."""
    found = []
    for path in re.findall(r"^\.\. \w+:: (\S+)$", with_records(text), re.MULTILINE):
        pkgutil.resolve_name(path)
        found.append(path)
    return found


# --- comparison ---

NUMBER = re.compile(r"(?<![\w.])[-+−]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.]*\w)")


def difference(shown: str, printed: str) -> str:
    """How a text differs from what was printed, "" if it does not; a line ... stands for any lines."""
    rest = [line.rstrip() for line in printed.rstrip().splitlines()]
    skip = False
    for line in shown.rstrip().splitlines():
        if line.strip() == "...":
            skip = True
            continue
        if skip:
            while rest and not same_line(line, rest[0]):
                rest.pop(0)
        if not rest or not same_line(line, rest[0]):
            return f"shown {line!r}, printed {rest[0] if rest else 'nothing'!r}"
        rest.pop(0)
        skip = False
    return f"not shown: {rest[0]!r}" if rest and not skip else ""


def same_line(shown: str, printed: str) -> bool:
    """Whether two lines have the same words and the same numbers."""
    words = [" ".join(NUMBER.sub("#", line).split()) for line in (shown, printed)]
    one, two = NUMBER.findall(shown), NUMBER.findall(printed)
    if words[0] != words[1]:
        return False
    ends = [shown[match.end() :].lstrip() for match in NUMBER.finditer(shown)]
    return all(same_number(a, b, end.startswith("%")) for a, b, end in zip(one, two, ends, strict=True))


def same_number(shown: str, printed: str, percentage: bool = False) -> bool:
    """To 1 in 1000; whole numbers exactly; error bounds within a factor of ten; percentages to 0.002."""
    a, b = (float(number.replace("−", "-")) for number in (shown, printed))
    if a == b:
        return True
    if percentage:
        return abs(a - b) <= PERCENT
    if re.fullmatch(r"[-+−]?\d+", shown):
        return False
    if "e" in shown and abs(a) < SMALL:
        return 0.1 < abs(b / a) < 10
    return abs(a - b) <= RELATIVE * max(abs(a), abs(b))


def figures(page: Path) -> list[str]:
    """Names of the figures from docs/figures/ that the code of a page draws; the paper, without code, borrows one."""
    code = any(block.language == "python" or block.language == "sh" for block in blocks(page))
    return FIGURE.findall(page.read_text(encoding="utf-8")) if code else []


def made(name: str) -> Path:
    """The picture of this name that a page has drawn in the working directory, or in a folder there."""
    found = sorted(Path().rglob(name))
    assert found, f"{name} is shown, and no code of the page draws it"
    return found[0]


def main() -> None:
    """Write output and figures anew."""
    import matplotlib as mpl

    mpl.use("Agg")
    sys.path.insert(0, str(ROOT))
    os.environ["SLURM_ARRAY_TASK_ID"] = "1"
    wanted = [Path(name).resolve() for name in sys.argv[1:]] or PAGES
    for page in wanted:
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            run = Run(page).all()
            source = page.read_text(encoding="utf-8")
            for block, printed in run.shown:
                if difference(block.text, printed):
                    source = source.replace(f"```text\n{block.text}```", f"```text\n{printed.rstrip()}\n```", 1)
                    print(f"{page.name}:{block.line}: output written anew")
            page.write_text(source, encoding="utf-8")
            for name in figures(page):
                (DOCS / "figures").mkdir(exist_ok=True)
                shutil.copy(made(name), DOCS / "figures" / name)
                print(f"{name}: {made(name).stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main()
