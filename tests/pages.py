"""The pages of the guide as programs: their blocks of code are run from top to bottom, and their output compared.

    python        run, in the names that the blocks above it left
    sh            lines of mdr and sed, and of validation --quick --only, are run by a shell; set-up is that of .ci/run
    toml          read as a case or as a study; one that is commented "# name.toml" in its first line is written there
    text          what the block above it prints: the same words, and numbers to 1 in 1000
    {eval-rst}    the names it documents are there

`python tests/pages.py docs/tutorial.md` writes output and figures of a page anew; read what changed before it is kept.
"""

import contextlib
import io
import os
import pkgutil
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path
from typing import Any, NamedTuple

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
sys.path.append(str(DOCS / "extensions"))
from navigation import with_records  # noqa: E402

PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "EXTENDING.md", *sorted(DOCS.rglob("*.md"))]
FENCE = re.compile(r"^(`{3,})([^\n`]*)\n(.*?)^\1 *$", re.DOTALL | re.MULTILINE)
FIGURE = re.compile(r"!\[[^\]]+\]\((?:\.\./)?figures/([\w.-]+)\)")
RUN = re.compile(r"(\.venv/bin/)?(mdr (?!explore)|sed |python -m validation --quick --only)")  # lines of sh
MDR = re.compile(r"mdr [^$|&;<>]*(> [\w.]+)?")  # those that need no shell
PATH = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
SHELL = {**os.environ, "PATH": PATH, "PYTHONPATH": str(ROOT), "PYTHONWARNINGS": "ignore", "SLURM_ARRAY_TASK_ID": "1"}

RELATIVE = 1e-3  #: tolerance of a number that is shown
SMALL = 1e-4  #: below it a number written with an exponent is an error bound, and its size is compared
PERCENT = 2e-3  #: tolerance of a percentage, absolute


class Block(NamedTuple):
    """A block of code: its language, its text and the line on which it begins."""

    language: str
    text: str
    line: int


def blocks(page: Path) -> list[Block]:
    """The blocks of a page, in their order."""
    source = page.read_text(encoding="utf-8")
    found = FENCE.finditer(source)
    return [Block(match[2].strip(), match[3], source.count("\n", 0, match.start()) + 1) for match in found]


def run(page: Path) -> list[tuple[Block, str]]:
    """Run a page in the working directory: its text blocks, and what was printed above each."""
    from mdr.given.case_file import parse_case
    from mdr.studies.study_files import parse_study

    names: dict[str, Any] = {"__name__": "__main__"}
    printed, shown = "", []
    for file in DOCS.glob("*.toml"):
        shutil.copy(file, ".")
    Path("docs").symlink_to(DOCS)
    for block in blocks(page):
        where = f"{page.name}:{block.line}"
        if block.language == "python":
            with captured() as out:
                exec(compile("\n" * block.line + block.text, str(page), "exec"), names)
            printed = out.getvalue()
        elif block.language == "sh":
            lines = block.text.replace("\\\n", " ").splitlines()
            wanted = [line.replace(".venv/bin/", "") for line in lines if RUN.match(line)]
            printed = "".join(by_mdr(line) if MDR.fullmatch(line) else by_shell(line) for line in wanted)
        elif block.language == "toml":
            (parse_study if "[axes]" in block.text else parse_case)(block.text)
            if name := re.match(r"# (\w+\.toml)\n", block.text):
                Path(name[1]).write_text(block.text, encoding="utf-8")
        elif block.language == "text":
            assert printed, f"{where}: nothing was printed above it"
            shown.append((block, printed))
            printed = ""
        else:
            assert block.language == "{eval-rst}", f"{where}: a block of {block.language!r}"
            documented(block.text)
    return shown


def by_shell(line: str) -> str:
    """What a line of shell prints."""
    return subprocess.run(["bash", "-ec", line], check=True, stdout=subprocess.PIPE, text=True, env=SHELL).stdout


def by_mdr(line: str) -> str:
    """What a line of mdr prints, or writes to the file that it names: in this process, which has imported it."""
    from mdr.__main__ import main

    words, _, file = line.partition(" > ")
    with captured() as out, warnings.catch_warnings(action="ignore"):
        assert main(shlex.split(words)[1:]) == 0, line
    if file:
        Path(file).write_text(out.getvalue(), encoding="utf-8")
    return "" if file else out.getvalue()


@contextlib.contextmanager
def captured():
    """What is printed meanwhile; progress goes nowhere."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(io.StringIO()):
        yield out


def documented(text: str) -> list[str]:
    """Dotted names that autodoc directives of a text document; each is imported."""
    found = re.findall(r"^\.\. \w+:: (\S+)$", with_records(text), re.MULTILINE)
    for path in found:
        pkgutil.resolve_name(path)
    return found


# --- comparison ---

NUMBER = re.compile(r"(?<![\w.])[-+−]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.]*\w)")


def difference(shown: str, printed: str) -> str:
    """How a text differs from what was printed, "" if it does not; a line ... stands for any lines."""
    rest, skip = [line.rstrip() for line in printed.rstrip().splitlines()], False
    for line in shown.rstrip().splitlines():
        if skip := skip or line.strip() == "...":
            if line.strip() == "...":
                continue
            while rest and not same_line(line, rest[0]):
                rest.pop(0)
            skip = False
        if not rest or not same_line(line, rest[0]):
            return f"shown {line!r}, printed {rest[0] if rest else 'nothing'!r}"
        rest.pop(0)
    return f"not shown: {rest[0]!r}" if rest and not skip else ""


def same_line(shown: str, printed: str) -> bool:
    """Whether two lines have the same words and the same numbers."""
    words = [NUMBER.sub("#", line).split() for line in (shown, printed)]
    pairs = zip(NUMBER.finditer(shown), NUMBER.findall(printed), strict=words[0] == words[1])
    return words[0] == words[1] and all(
        same_number(one[0], other, shown[one.end() :].lstrip().startswith("%")) for one, other in pairs
    )


def same_number(shown: str, printed: str, percentage: bool) -> bool:
    """To 1 in 1000; whole numbers exactly; error bounds within a factor of ten; percentages to 0.002."""
    a, b = (float(number.replace("−", "-")) for number in (shown, printed))
    if a == b or re.fullmatch(r"[-+−]?\d+", shown):
        return a == b
    if percentage:
        return abs(a - b) <= PERCENT
    if "e" in shown and abs(a) < SMALL:
        return 0.1 < abs(b / a) < 10
    return abs(a - b) <= RELATIVE * max(abs(a), abs(b))


def figures(page: Path) -> list[str]:
    """Names of the figures from docs/figures/ that the code of a page draws; the paper, without code, borrows one."""
    code = any(block.language in ("python", "sh") for block in blocks(page))
    return FIGURE.findall(page.read_text(encoding="utf-8")) if code else []


def made(name: str) -> Path:
    """The picture of this name that a page has drawn in the working directory, or in a folder there."""
    return next(path for path in sorted(Path().rglob(name)) if path.parts[0] != "docs")


def main() -> None:
    """Write output and figures anew."""
    import matplotlib as mpl

    mpl.use("Agg")
    for page in [Path(name).resolve() for name in sys.argv[1:]] or PAGES:
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            source = page.read_text(encoding="utf-8")
            for block, printed in run(page):
                if difference(block.text, printed):
                    source = source.replace(f"```text\n{block.text}```", f"```text\n{printed.rstrip()}\n```", 1)
            page.write_text(source, encoding="utf-8")
            for name in figures(page):
                shutil.copy(made(name), DOCS / "figures" / name)


if __name__ == "__main__":
    sys.path.insert(0, str(ROOT))
    main()
