"""Numbers in prose are those of the record, the record is that of the claims, and a stale number is seen."""

import json
from types import SimpleNamespace

import numpy as np
import pytest

from validation import CLAIMS, GROUPS, written
from validation.written import RECORD, formatted, main, number, pages, verdict_list

CHECKS = [
    {"claim": "one", "name": "worst of 4", "got": 4.9e-6, "expected": 0.0, "held": True},
    {"claim": "one", "name": "v over v_c: cone", "got": 0.998, "expected": 1.0, "held": True},
    {"claim": "one", "name": "v over v_c: punch", "got": 1.001, "expected": 1.0, "held": False},
    {"claim": "maps", "name": "measured v_c over that of full slip: 3", "got": 0.99998, "expected": 1.0, "why": "w"},
]
SAMPLE = {"claims": [{"name": "one", "verdict": "holds if E* | F", "sentence": "As v_c^2."}], "checks": CHECKS}


def test_every_page_is_as_the_record_says():
    assert len(pages()) >= 2
    assert main(["--check"]) == 0


def test_the_record_is_of_all_claims_and_all_checks_held():
    record = json.loads(RECORD.read_text(encoding="utf-8"))
    assert sorted(claim["name"] for claim in record["claims"]) == sorted(CLAIMS)
    assert all(check["held"] for check in record["checks"])
    for claim in record["claims"]:
        assert len(claim["verdict"]) <= 100
        assert len(claim["sentence"]) <= 200, "an item is read at a glance"


def test_a_verdict_that_is_not_quoted_is_named():
    quoted = [SimpleNamespace(**claim) for claim in json.loads(RECORD.read_text(encoding="utf-8"))["claims"]]
    assert written.other_verdicts(quoted) == []
    quoted[3].verdict = "fails when it rains"
    assert written.other_verdicts(quoted) == [quoted[3].name]


@pytest.mark.parametrize(
    ("value", "form", "shown"),
    [
        (4.9e-6, ["2"], "4.9·10⁻⁶"), (4.9e-6, ["2", "tex"], r"$4.9 \times 10^{-6}$"), (0.0, ["2"], "0"),
        (-0.586186, ["2"], "−0.59"), (1.37355, ["3", "%"], "137 %"), (729, ["6"], "729"), (1234.5, ["2"], "1200"),
        (1e-5, ["2"], "10⁻⁵"), (0.0835, ["2", "%"], "8.3 %"),
    ],
)  # fmt: skip
def test_numbers_read_well(value, form, shown):
    assert formatted(value, *form) == shown


@pytest.mark.parametrize(
    ("mark", "shown"),
    [
        ("got :: one :: worst :: 2", "4.9·10⁻⁶"), ("worst :: one :: v over v_c :: 1", "0.002"),
        ("most :: one :: v over v_c :: 4", "1.001"), ("count :: one :: * :: 3", "3"),
        ("most :: one :: *: punch :: 4", "1.001"), ("farthest :: full slip :: 2", "2·10⁻⁵"),
    ],
)  # fmt: skip
def test_a_mark_takes_what_it_names(mark, shown):
    assert number(mark, SAMPLE) == shown
    text = f"about 17<!--= {mark} --> and 12 % of 3"
    assert written.written(text, SAMPLE) == f"about {shown}<!--= {mark} --> and 12 % of 3"


@pytest.mark.parametrize("mark", ["got :: one :: v :: 2", "got :: one :: x :: 2", "got :: two :: worst :: 2", "best",
                                  "farthest :: rigid pull :: 2", "farthest :: pull :: 2"])  # fmt: skip
def test_a_mark_that_names_no_check_or_several_is_refused(mark):
    with pytest.raises(ValueError, match=r"names \d checks|a mark reads|a headline is one of"):
        number(mark, SAMPLE)


def test_the_list_escapes_what_would_set_italics():
    item = verdict_list(SAMPLE, ["one"])
    assert item == "- one: *holds if E\\* | F*. As <i>v</i><sub>c</sub><sup>2</sup>.\n"


def test_a_list_of_no_group_or_of_claims_that_the_record_lacks_is_refused():
    with pytest.raises(ValueError, match="lacks the claims two of a list; it has one"):
        verdict_list(SAMPLE, ["one", "two"])
    with pytest.raises(ValueError, match=r"is that of The model or .*, got 'Nothing'"):
        written.written("<!--= verdicts :: Nothing -->\n<!--= end -->\n", SAMPLE)


def test_a_stale_number_is_seen_and_set(tmp_path, monkeypatch, capsys):
    (tmp_path / "docs").mkdir()
    page, record = tmp_path / "README.md", tmp_path / "docs" / "checks.json"
    text = "17 %<!--= got :: one :: worst :: 2 -->\n<!--= verdicts :: Only -->\nbefore\n<!--= end -->\n"
    page.write_text(text, encoding="utf-8")
    given = tmp_path / "given.json"
    given.write_text(json.dumps(SAMPLE), encoding="utf-8")
    (tmp_path / "one-glance.svg").write_text("<svg/>")
    monkeypatch.setattr(written, "ROOT", tmp_path)
    monkeypatch.setattr(written, "RECORD", record)
    monkeypatch.setattr(written, "CONSTRAINTS", tmp_path / "constraints.txt")
    monkeypatch.setitem(GROUPS, "Only", ("", ("one",)))
    monkeypatch.setattr(written, "CLAIMS", ("one", "of another run"))
    with pytest.raises(SystemExit):
        main([str(given)])
    assert "the record lacks of another run" in capsys.readouterr().err
    assert not record.exists()
    monkeypatch.setattr(written, "CLAIMS", ("one",))
    assert main([str(given), "--check"]) == 1
    assert "is not as the record says" in capsys.readouterr().out
    assert not record.exists()
    assert main([str(given)]) == 0
    assert record.read_text() == given.read_text()
    assert record.with_name("claim.svg").read_text() == "<svg/>"
    assert f"numpy=={np.__version__}\n" in (tmp_path / "constraints.txt").read_text()
    assert page.read_text(encoding="utf-8").startswith("4.9·10⁻⁶<!--=")
    assert "before" not in page.read_text(encoding="utf-8")
    assert main(["--check"]) == 0
