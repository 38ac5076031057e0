"""Numbers and verdicts in prose: taken from the record of the checks, never written by hand.

`python -m validation.written report/checks.json`, where the report was just made, keeps that record as
docs/checks.json, the figure that opens the report as docs/claim.svg and the versions that made them as constraints.txt
beside this file, and sets every marked place of README and docs from the record; `--check` changes nothing and fails
where a place is not what the record says. Places are marked by comments, which no reader sees:

    0.47<!--= got :: resolution :: true error over cof_error :: 2 -->
    2.4·10⁻⁵<!--= farthest :: full slip :: 2 -->
    <!--= verdicts :: The model --> ... <!--= end -->

A number stands right before its mark, which says what of the checks (`got`; `worst`, the greatest |got − expected|;
`most`, the greatest got; `count`, how many there are) of a claim, by how their names begin (`*` for any letters), with
how many digits; `%` behind the digits makes it per cent, `tex` sets powers for TeX. `farthest` is the greatest relative
difference of a measured critical velocity from a formula, over all checks of a headline (validation/headlines.py). A
list of verdicts has the claims of the group (`validation.GROUPS`) that its mark names.
"""

import argparse
import json
import re
import shutil
import sys
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

from mdr.tools.provenance import PARTS, version_of
from validation import CLAIMS, GROUPS, headlines, words
from validation.report import Claim
from validation.typeset import markup, plain

ROOT = Path(__file__).parents[1]
RECORD = ROOT / "docs" / "checks.json"
CONSTRAINTS = Path(__file__).with_name("constraints.txt")

_NUMBER = re.compile(r"(\$[^$\n]+\$|[-−\d.·⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+(?: %)?)<!--= (\S.*?) -->", re.DOTALL)
_LIST = re.compile(r"(<!--= verdicts :: ([\w ]+) -->\n).*?(<!--= end -->)", re.DOTALL)

#: what a mark takes of the checks that it names
_TAKEN: dict[str, Callable[[Sequence[dict[str, Any]]], float]] = {
    "got": lambda checks: float(checks[0]["got"]),
    "worst": lambda checks: max(abs(float(one["got"]) - float(one["expected"])) for one in checks),
    "most": lambda checks: max(float(one["got"]) for one in checks),
    "count": len,
}


def main(argv: Sequence[str] | None = None) -> int:
    """Set the places, or check them; 0 if all is as the record says, 1 if not, 2 for wrong arguments."""
    parser = argparse.ArgumentParser("python -m validation.written", description=__doc__.partition("\n\n")[0])
    parser.add_argument(
        "record", nargs="?", type=Path, help="checks.json of a full report, to be kept and written from"
    )
    parser.add_argument(
        "--check", action="store_true", help="change nothing; fail where a place is not as it should be"
    )
    args = parser.parse_args(argv)
    record = json.loads((args.record or RECORD).read_text(encoding="utf-8"))
    if missing := [name for name in CLAIMS if name not in {claim["name"] for claim in record["claims"]}]:
        parser.error(f"the record lacks {', '.join(missing)}: give checks.json of a full report, python -m validation")
    if args.record is not None and not args.check:
        shutil.copyfile(args.record, RECORD)
        for glance in args.record.parent.glob("*-glance.svg"):
            shutil.copyfile(glance, RECORD.with_name("claim.svg"))
        pins = "".join(f"{name}=={version_of(name)}\n" for name in sorted(PARTS))
        CONSTRAINTS.write_text(pins, encoding="utf-8")
    stale = 0
    for page in pages():
        text = page.read_text(encoding="utf-8")
        new = written(text, record)
        if new != text:
            stale += 1
            print(f"{page.relative_to(ROOT)}: {'is not as the record says' if args.check else 'set'}")
            if not args.check:
                page.write_text(new, encoding="utf-8")
    return 1 if args.check and stale else 0


def other_verdicts(claims: Iterable[Claim]) -> list[str]:
    """Names of the claims whose verdict is not the one that docs/claims.md quotes."""
    recorded = json.loads(RECORD.read_text(encoding="utf-8"))["claims"]
    quoted = {claim["name"]: claim["verdict"] for claim in recorded}
    return [claim.name for claim in claims if plain(claim.verdict) != quoted.get(claim.name)]


def pages() -> list[Path]:
    """The pages with marked places."""
    known = (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")))
    return [page for page in known if "<!--= " in page.read_text(encoding="utf-8")]


def written(text: str, record: dict[str, Any]) -> str:
    """The text with all its marked places set from a record of checks."""
    text = _LIST.sub(lambda place: place[1] + verdict_list(record, _of_group(place[2])) + place[3], text)
    return _NUMBER.sub(lambda place: f"{number(place[2], record)}<!--= {place[2]} -->", text)


def number(mark: str, record: dict[str, Any]) -> str:
    """The number that a mark asks for; ValueError for a mark that names no check, or too many."""
    parts = [part.strip() for part in " ".join(mark.split()).split(" :: ")]
    if len(parts) == 3 and parts[0] == "farthest":
        return formatted(_farthest(parts[1], record), *parts[2].split())
    if len(parts) != 4 or parts[0] not in _TAKEN:
        raise ValueError(
            f"a mark reads '{' or '.join(_TAKEN)} :: claim :: check :: digits' or 'farthest :: headline :: digits',"
            f" got {mark!r}"
        )
    what, claim, name, form = parts
    begins = re.compile(".*".join(re.escape(part) for part in name.split("*")))
    found = [c for c in record["checks"] if claim in (c["claim"], "*") and begins.match(c["name"])]
    if not found or (what == "got" and len(found) > 1):
        raise ValueError(f"{mark!r} names {len(found)} checks: {[one['name'] for one in found[:5]]}")
    return formatted(float(_TAKEN[what](found)), *form.split())


def _farthest(headline: str, record: dict[str, Any]) -> float:
    """The greatest relative difference over the checks of a headline; ValueError where the record has none of them."""
    found = [one for one in record["checks"] if headlines.reads(headline, one["claim"], one["name"])]
    if not found:
        raise ValueError(f"the headline {headline!r} names 0 checks")
    return max(headlines.difference(c["name"], float(c["got"]), float(c["expected"]), c["why"]) for c in found)


def formatted(value: float, digits: str, style: str = "") -> str:
    """A number with so many significant digits, small and large ones as powers of ten."""
    if style == "%":
        return words.percent(value, int(digits))
    if style == "tex" and value and not 1e-3 <= abs(value) < 1e5:
        mantissa, exponent = f"{value:.{int(digits) - 1}e}".split("e")
        return rf"${mantissa} \times 10^{{{int(exponent)}}}$"
    return words.number(value, int(digits))


def _of_group(title: str) -> Sequence[str]:
    """The claims of a group; ValueError for a title that is none."""
    if title not in GROUPS:
        raise ValueError(f"a list of verdicts is that of {' or '.join(GROUPS)}, got {title!r}")
    return GROUPS[title][1]


def verdict_list(record: dict[str, Any], names: Sequence[str]) -> str:
    """The claims of these names with verdict and conclusion in a sentence, as items of a list in Markdown."""
    claims = {claim["name"]: claim for claim in record["claims"]}
    if missing := [name for name in names if name not in claims]:
        raise ValueError(f"the record lacks the claims {', '.join(missing)} of a list; it has {', '.join(claims)}")
    told = ((name.replace("_", " "), claims[name]["verdict"], claims[name]["sentence"]) for name in names)
    return "".join(f"- {name}: *{_words(verdict)}*. {_words(sentence)}\n" for name, verdict, sentence in told)


def _words(text: str) -> str:
    """Text with symbols as the report sets them; a star could set italics."""
    return markup(text).replace("*", r"\*")


if __name__ == "__main__":
    sys.exit(main())
