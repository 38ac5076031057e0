"""The report: what a check holds, what the page and checks.json say, how a run of all claims ends."""

import json
import math
import os
import pickle
import platform
import re
import signal
import subprocess
import sys
import time
from dataclasses import replace
from hashlib import sha256
from pathlib import Path

import matplotlib.pyplot as plt
import pytest

import validation
import validation.__main__ as command
from mdr.tools.provenance import versions
from validation.page import html_page, write_report
from validation.page.answer import answers
from validation.page.made import Made
from validation.report import Check, Claim, Equation, Figure, Part, text_table, told

ROOT = Path(__file__).parents[2]


def made_up_figure(name="curve"):
    fig, ax = plt.subplots(figsize=(2, 1.5))
    ax.pcolormesh([[0, 1], [2, 3]], rasterized=True)
    ax.set_xlabel("$v_0/v_c$")
    return Figure(name, "See the step at v_c.", fig, 'a "step"')


def made_up_claim(name="pull", verdict="holds", **changes):
    parts = {
        "name": name,
        "title": "v_c of a rigid pull",
        "quote": "Eq. (1): v_c = μ_0 ω Δu_z κ",
        "range": "α < 1 & T > 0",
        "measured": "less than 10^-5",
        "verdict": verdict,
        "sentence": "v_c is the same for all.",
        "checks": [Check("v_c", 1.0, 1.0, 1e-4, "the bracket"), Check.at_least("ratio", 3.0, 2.0, "far above")],
    }
    return Claim(**{**parts, **changes})


def ids_of(page):
    return re.findall(r'\bid="?([^" >]+)', page)


@pytest.mark.parametrize(
    ("check", "held"),
    [
        (Check("c", 1.0, 1.1, 0.11, "w"), True),
        (Check("c", 1.0, 1.1, 0.09, "w"), False),
        (Check("c", None, 0, 1, "w"), False),
        (Check("c", math.nan, 0, 1, "w"), False),
        (Check("c", math.inf, math.inf, 0, "w"), True),
        (Check("c", True, True, 0, "w"), True),
        (Check.at_most("c", 1.1, 1, "w"), False),
        (Check.at_most("c", math.nan, 1, "w"), False),
        (Check.at_least("c", 9, 1, "w"), True),
        (Check.at_least("c", None, 1, "w"), False),
        (Check.between("c", 0.5, 0, 1, "w"), True),
        (Check.between("c", 1.5, 0, 1, "w"), False),
    ],
)
def test_when_a_check_holds(check, held):
    assert check.held is held
    assert repr(pickle.loads(pickle.dumps(check))) == repr(check)


@pytest.mark.parametrize(
    ("expected", "tolerance", "side"),
    [(math.nan, 1, "within"), (0, -1, "within"), (0, math.nan, "within"), (0, math.inf, "within"), (0, 1, "up")],
)
def test_a_check_that_cannot_fail_or_cannot_hold_is_refused(expected, tolerance, side):
    with pytest.raises(ValueError, match="check 'c'"):
        Check("c", 0.0, expected, tolerance, "w", side)


@pytest.mark.parametrize("verdict", ["holds", "holds if α < 0.1", "fails when ω = ω_0", "not tested"])
def test_verdicts(verdict):
    assert made_up_claim(verdict=verdict).held


@pytest.mark.parametrize(
    "changes",
    [
        {"verdict": "maybe"},
        {"verdict": "holds ifs"},
        {"verdict": "fails"},
        {"checks": ()},
        {"checks": 2 * [Check("v_c", 1.0, 1.0, 0.0, "w")]},
        {"name": "A b"},
    ],
)
def test_a_claim_without_verdict_checks_or_name_is_refused(changes):
    with pytest.raises(ValueError, match=r"must|proves nothing|two checks have the same name"):
        made_up_claim(**changes)


def test_figures_are_drawn_once_and_travel_as_bytes():
    before = plt.get_fignums()
    first, second = made_up_figure(), made_up_figure()
    assert plt.get_fignums() == before
    assert first == second == pickle.loads(pickle.dumps(first))
    assert first.png.startswith(b"\x89PNG")
    assert b"<svg" in first.svg
    with pytest.raises(ValueError, match="same name"):
        made_up_claim(figures=[first, second])


def test_page_is_well_formed_and_needs_nothing_else():
    claims = [made_up_claim(figures=[made_up_figure()]), made_up_claim("map", figures=[made_up_figure("glance")])]
    page = html_page(claims, "quick")
    links, ids = re.findall(r'\b(?:href|src)="?([^" >]+)', page), ids_of(page)
    assert not re.search(r"https?:|//[a-z]|<script src|url\(", re.sub(r"base64,[^\"]*", "", page))
    assert all(link.startswith(("#", "data:image/svg+xml;base64,")) for link in links)
    assert {link[1:] for link in links if link.startswith("#")} <= set(ids)
    assert len(ids) == len(set(ids))
    assert str(ROOT) not in page
    assert "4 of 4 checks held" in page
    assert "--quick" in page
    assert page.index("<header id=answer>") < page.index('id="glance"') < page.index("<section")
    assert page.count("<img") == page.count("<label class=enlarge><input type=checkbox") == 2


def test_a_failed_check_is_told_everywhere(tmp_path):
    claim = made_up_claim(checks=[Check("F_x <i>mean</i>", math.nan, 1.5, 0.1, "because"), Check("b", 1, 1, 0, "w")])
    write_report([claim], tmp_path)
    record = json.loads((tmp_path / "checks.json").read_text(encoding="utf-8"))
    assert record["checks"][0] == {
        "claim": "pull", "name": "F_x mean", "got": None, "expected": 1.5, "tolerance": 0.1, "why": "because",
        "held": False,
    }  # fmt: skip
    page = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert "<span class=no>1/2</span>" in page
    assert "✗" in page
    assert "NOT HELD F_x mean" in text_table([claim])


def test_a_claim_with_parts_shows_each_with_its_evidence():
    def part(name, held, figures=()):
        check = Check(f"v_c, {name}", 1.0, 1.0 if held else 2.0, 0.1, "w")
        return Part(name, f"Of {name}", "", "α < 1", "much", f"As v_c, {name}.", (check,), figures)

    parts = (part("shape", True, (made_up_figure("glance"),)), part("depth", False, (made_up_figure(),)))
    claim = made_up_claim(parts=parts, checks=())
    assert [check.name for check in claim.checks] == ["v_c, shape", "v_c, depth"]
    assert [figure.name for figure in claim.figures] == ["glance", "curve"]
    assert not claim.held
    page = html_page([claim])
    assert [one for one in ids_of(page) if one.startswith(("pull", "glance"))] == [
        "glance", "pull", "pull-shape", "pull-depth", "pull-curve"
    ]  # fmt: skip
    assert page.count("<details class=claim") == 1
    assert re.findall("<details.*checks held</summary>", page) == [
        "<details><summary>1 of 1 checks held</summary>",
        "<details open><summary>0 of 1 checks held</summary>",
    ]


def test_checks_json_has_exactly_the_promised_keys(tmp_path):
    write_report([made_up_claim(figures=[made_up_figure()])], tmp_path)
    record = json.loads((tmp_path / "checks.json").read_text(encoding="utf-8"))
    assert record["claims"] == [{"name": "pull", "verdict": "holds", "sentence": "v_c is the same for all."}]
    keys = {"claim", "name", "got", "expected", "tolerance", "why", "held"}
    assert [set(check) for check in record["checks"]] == [keys, keys]
    assert record["checks"][1]["why"] == "at least 2: far above"
    assert {path.name for path in tmp_path.iterdir()} == {
        "index.html", "checks.json", "pull-curve.svg", "pull-curve.png",
    }  # fmt: skip


LEAST = 3


def an_example():
    """v_c of a rigid pull

    How: not for the page.

    Range: {n} runs, from
    {LEAST} on.

    Sentence: x^{{2}} holds.
    """
    n = 7
    return told(an_example, locals())


def test_the_docstring_of_a_claim_is_its_text():
    assert an_example() == {
        "name": "test_report", "title": "v_c of a rigid pull", "quote": "", "range": "7 runs, from 3 on.",
        "sentence": "x^{2} holds.",
    }  # fmt: skip


def test_the_answer_takes_its_numbers_from_the_checks_and_says_where_it_has_none():
    kept = Check("measured v_c over Eq. (1), worst of 4 shapes: ωτ = 0 (contact kept)", 1 - 3e-6, 1, 1e-4, "w")
    punch = Check.at_most("flat punch, spring pull: worst |v_c/Eq. (15) − 1| of 9", 8.2e-6, 1e-4, "w")
    claims = [made_up_claim("rigid_pull", checks=[kept]), made_up_claim("generalisation", checks=[punch])]
    first, *others = answers(claims)
    assert "to 8.2·10⁻⁶, except" in first
    assert [one.partition("</b>")[2] for one in others] == [": not asked in this run."] * 3
    off = made_up_claim("generalisation", checks=[replace(punch, got=1e-3)])
    assert answers([claims[0], off])[0].endswith("not confirmed, one check did not hold.")


def test_the_answer_names_checks_that_the_claims_have():
    """Of the last full report, so that a check that is renamed does not silence the answer."""
    record = json.loads((ROOT / "docs" / "checks.json").read_text(encoding="utf-8"))
    number = {None: math.nan, "inf": math.inf}
    checks = {claim["name"]: [] for claim in record["claims"]}
    for one in record["checks"]:
        got, expected = (number.get(one[key], one[key]) for key in ("got", "expected"))
        side = one["why"][:8] if one["why"].startswith(("at most ", "at least")) else "within"
        checks[one["claim"]].append(Check(one["name"], got, expected, one["tolerance"], "w", side.strip()))
    claims = [made_up_claim(name, checks=some) for name, some in checks.items()]
    assert [bool(re.search(r"not (asked|confirmed)", one)) for one in answers(claims)] == [False] * 4


def test_an_equation_that_a_claim_names_is_on_the_page():
    law = Equation("(*)", r"L = \frac{\lambda^2}{b}", "the law")
    page = html_page([made_up_claim(equations=(law,))])
    assert "<mfrac><mrow><msup><mi>λ</mi><mn>2</mn></msup></mrow><mrow><mi>b</mi></mrow></mfrac>" in page
    assert "<span class=tag>(*)</span>" in page


CLAIM = """
from validation.report import Check, Claim, Figure
def claim(effort):
    figures = []
    {body}
    checks = [Check("x", {got}, 1.0, 0.1, "why")]
    return Claim({name!r}, "t", "q", "r", "m", "holds", "Done with " + effort, checks, figures)
"""
DRAWS = """import matplotlib.pyplot as plt
    fig, ax = plt.subplots()
    ax.plot([0, 1])
    figures.append(Figure("f", "c", fig, "a"))"""


@pytest.fixture
def claims(tmp_path, monkeypatch):
    """A folder of made-up claim modules, which processes started here find too: name -> (got, first line)."""

    def make(package, **modules):
        folder = tmp_path / package
        folder.mkdir()
        (folder / "__init__.py").write_text(f"CLAIMS = {tuple(modules)!r}", encoding="utf-8")
        for name, (got, body) in modules.items():
            text = CLAIM.format(body=body, got=got, name=name)
            (folder / f"{name}.py").write_text(text, encoding="utf-8")
        return package

    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.chdir(tmp_path)
    return make


def test_all_held_gives_0_and_the_default_folder(claims, capsys):
    package = claims("all_held", one=(1.0, DRAWS), two=(1.05, "pass"))
    assert command.main(["--jobs", "1", "--long"], package) == 0
    out, err = capsys.readouterr()
    assert "one: holds [1/1 checks held]" in out
    assert "Done with long" in out
    assert re.search(r"claim [12] of 2, two: 1/1 checks held, \d+\.\d s", err)
    assert Path("report/index.html").exists()


def test_a_failed_check_gives_1_and_only_asks_for_some(claims):
    package = claims("one_fails", one=(1.0, "pass"), two=(2.0, "pass"))
    assert command.main(["--jobs", "1", "-o", "out"], package) == 1
    assert command.main(["--jobs", "1", "-o", "out", "--only", "one"], package) == 0
    assert [c["name"] for c in json.loads(Path("out/checks.json").read_text())["claims"]] == ["one"]


def test_claims_that_raise_die_or_are_missing_leave_the_others_alone(claims, capsys):
    package = claims("some_raise", one=(1.0, "pass"), two=(1.0, "import os; os._exit(3)"), four=(1.0, "1 / 0"))
    assert command.main(["-o", "out", "--jobs", "3"], package) == 1
    record = json.loads(Path("out/checks.json").read_text(encoding="utf-8"))
    assert [c["verdict"] for c in record["claims"]] == ["holds", "not tested", "not tested"]
    assert [c["held"] for c in record["checks"]] == [True, False, False]
    assert "ZeroDivisionError" in record["checks"][2]["why"]
    assert "ZeroDivisionError" in Path("out/index.html").read_text(encoding="utf-8")
    assert "Traceback" in capsys.readouterr().err


@pytest.mark.parametrize("argv", [["--only", "nothing"], ["--quick", "--long"], ["--jobs", "0"], ["--effort"]])
def test_wrong_arguments_give_2(argv):
    with pytest.raises(SystemExit) as stop:
        command.main(argv)
    assert stop.value.code == 2


def test_another_process_writes_the_same_bytes(claims):
    package = claims("same", one=(1.0, DRAWS))
    assert command.main(["--jobs", "1", "-o", "out1"], package) == 0
    code = "from validation.__main__ import main; main(['--jobs', '1', '-o', 'out2'], 'same')"
    path = os.pathsep.join([str(Path.cwd()), str(ROOT)])
    environment = {**os.environ, "PYTHONHASHSEED": "2", "PYTHONPATH": path}
    subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, env=environment)
    assert {p.name for p in Path("out1").iterdir()} == {"index.html", "checks.json", "one-f.svg", "one-f.png"}
    for path in Path("out1").iterdir():
        assert path.read_bytes() == Path("out2", path.name).read_bytes()


WAITS = """open("begun", "a").close()
    import os, time
    while not os.path.exists("go"): time.sleep(0.01)"""
COUNTS = 'open("ran", "a").write("1")'


def begun(claims, package, *argv):
    """The report of two claims, stopped or killed by nobody yet, once the first is done and the second at work."""
    code = f"from validation.__main__ import main; raise SystemExit(main(['--jobs', '1', *{argv!r}], {package!r}))"
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(Path.cwd()), str(ROOT)])}
    process = subprocess.Popen([sys.executable, "-c", code], env=environment, stderr=subprocess.PIPE, text=True)
    while not (Path("begun").exists() and Path("report/index.html").exists()) and process.poll() is None:
        time.sleep(0.02)
    return process


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_a_stop_leaves_a_page_and_a_second_start_goes_on(claims, capsys, how):
    package = claims(f"stopped_{how.name.lower()}", one=(1.0, COUNTS), two=(1.0, WAITS))
    process = begun(claims, package, "--quick")
    process.send_signal(how)
    _, said = process.communicate(timeout=60)
    assert process.returncode == (-how if how == signal.SIGKILL else 130)
    assert how == signal.SIGKILL or "stopped with 1 of 2 claims done, from which the same command goes on" in said
    assert "Traceback" not in said
    page = Path("report/index.html").read_text(encoding="utf-8")
    assert "<b>STOPPED</b> 1 of 2 claims are done" in page
    assert [one["name"] for one in json.loads(Path("report/checks.json").read_text())["claims"]] == ["one"]
    Path("go").touch()
    assert command.main(["--quick"], package) == 0
    assert "1 of 2 claims are kept from a run that was stopped" in capsys.readouterr().err
    assert Path("ran").read_text() == "1"
    page = Path("report/index.html").read_text(encoding="utf-8")
    assert "STOPPED" not in page
    assert "1 of the claims by a run before, which was stopped" in page
    assert {path.name for path in Path("report").iterdir()} == {"index.html", "checks.json"}  # nothing is kept of it
    assert command.main(["--quick"], package) == 0
    assert Path("ran").read_text() == "11"  # a complete report tests all claims again


@pytest.mark.parametrize("change", ["source", "effort", "fresh", "bytes", "stranger"])
def test_what_a_claim_was_tested_with_is_what_it_is_kept_for(claims, capsys, change):
    package = claims(f"changed_{change}", one=(1.0, COUNTS), two=(1.0, WAITS))
    process = begun(claims, package)
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=60)
    (kept,) = Path("report/kept").iterdir()
    if change == "source":
        module = Path(package, "one.py")
        module.write_text(module.read_text(encoding="utf-8") + "# another\n", encoding="utf-8")
    elif change == "bytes":
        kept.write_bytes(kept.read_bytes()[:-1] + b"?")
    elif change == "stranger":  # what is no claim is not read
        data = pickle.dumps(Path("somewhere"))
        kept.write_bytes(sha256(data).digest() + data)
    Path("go").touch()
    options = {"effort": ["--quick"], "fresh": ["--fresh"]}.get(change, [])
    assert command.main(options, package) == 0
    assert "are kept" not in capsys.readouterr().err
    assert Path("ran").read_text() == "11"


def test_a_claim_that_broke_off_is_not_kept(claims):
    package = claims("breaks", one=(1.0, "1 / 0"), two=(1.0, WAITS))
    process = begun(claims, package)
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=60)
    assert not Path("report/kept").exists()


def test_the_foot_says_what_made_the_report():
    made = Made(("mapping",), seconds=100.0)
    page = html_page([made_up_claim("mapping")], "quick", made)
    foot = re.search("<footer>(.*)</footer>", page)[1]
    assert "<code>python -m validation --quick --only mapping</code>" in foot
    assert re.search(
        r"(at commit [0-9a-f]{12}( with edits)?|of no known commit), on \d{4}-\d\d-\d\d, in 2 min on \d+ cores? of",
        foot,
    )
    assert platform.node() not in foot
    assert versions() in foot
    assert "The claims that answer this are not among those below" in page
    assert '<a href="#mapping">' in page.partition("<ul class=answers>")[2]


def test_a_verdict_on_the_physics_has_another_colour_than_a_check_that_was_missed():
    css = Path(ROOT, "validation/page/page.css").read_text(encoding="utf-8")
    colour = {name: re.search(rf"\.{name}\b[^{{]*{{ color: (#\w+)", css)[1] for name in ("fails", "no", "yes")}
    assert len(set(colour.values())) == 3
    page = html_page([made_up_claim(verdict="fails when ω = ω_0")])
    assert "<span class=fails>fails when" in page
    assert "<span class=yes>2/2</span>" in page


def test_the_longest_claim_begins_first_and_the_page_keeps_its_order(claims):
    claims("ordered", one=(1.0, "pass"), resonances=(1.0, "pass"))
    first, _ = next(command.run_all(["one", "resonances"], "full", "ordered", 1))
    assert first == "resonances"
    assert command.main(["--jobs", "1"], "ordered") == 0
    record = json.loads(Path("report/checks.json").read_text(encoding="utf-8"))
    assert [claim["name"] for claim in record["claims"]] == ["one", "resonances"]
    assert set(command.LONGEST) <= set(validation.CLAIMS)


def test_a_quick_run_is_marked_and_a_full_one_is_not():
    quick, full = (html_page([made_up_claim()], effort) for effort in ("quick", "full"))
    assert "<title>QUICK Does" in quick
    assert quick.index("<h1>") < quick.index("<b>QUICK</b>") < quick.index("critical velocity")
    assert "QUICK" not in full
    part = html_page([made_up_claim("mapping")])
    assert f"<b>PART</b> {len(validation.CLAIMS) - 1} of the {len(validation.CLAIMS)} claims" in part
