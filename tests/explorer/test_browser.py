"""The explorer in a real browser: chromium without a window, driven by its driver, against `mdr explore` itself."""

import http.client
import os
import signal
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from chromium import PATIENCE, Browser, chromium, explorer, lacking, named

import mdr
from mdr.tools.notation import value_in

REQUIRED = os.environ.get("MDR_BROWSER") == "required"  #: a browser that is missing is then a failure
CASE = mdr.SlidingContact(
    mdr.FlatPunch(a=1e-3),
    mdr.Elastic(E=3e6, nu=0.5),
    mu_0=0.4,
    oscillation=mdr.NormalOscillation(u_z0=20e-6, du_z=10e-6, omega=300.0),
    pull=mdr.SpringPull(k_x=2e4, m=0.05, c_x=4.0),
)


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    """Address and process of the explorer of CASE."""
    if missing := lacking():
        (pytest.fail if REQUIRED else pytest.skip)(f"no test in a browser without {', '.join(missing)}")
    path = tmp_path_factory.mktemp("explorer") / "case.toml"
    path.write_text(mdr.write_case(CASE), encoding="utf-8")
    with explorer(path) as running:
        yield running


@pytest.fixture(scope="module")
def browser(server, tmp_path_factory):
    folder = tmp_path_factory.mktemp("chromium")
    with chromium(folder) as driver:
        yield Browser(driver, server[0], folder)


def test_the_page_opens_with_its_pictures(browser):
    drawn = mdr.cof_curve(CASE, [0.0]).cof[0]
    assert browser.curve()[0] == pytest.approx(drawn, abs=1e-3 * CASE.mu_0)
    assert len(browser.find(".bk-Figure")) == 4
    assert browser.value("indenter.a") == "1 mm"
    assert all(one.accessible_name for one in browser.find(".noUi-handle") if one.is_displayed())
    assert any("critical velocity in closed form" in line for line in browser.text("table"))


def test_a_slider_moves_the_curve(browser):
    before, state = browser.curve(), browser.state()
    browser.move("oscillation.du_z", 20)
    browser.until(lambda: browser.state() != state and browser.curve() != before)
    amplitude = value_in("du_z", browser.value("oscillation.du_z"), "m")
    assert amplitude > CASE.oscillation.du_z
    browser.until(lambda: f"du_z={amplitude!r}" in browser.state())  # of all moves the last is drawn
    browser.until(browser.is_complete)
    assert browser.curve()[0] < before[0]
    assert browser.curve("before") == pytest.approx(before, abs=1e-9)


def test_back_undoes(browser):
    """The moves of a slider are one step of the history."""
    amplitude, drawn = browser.value("oscillation.du_z"), browser.curve()
    browser.driver.back()
    browser.until(lambda: browser.value("oscillation.du_z") == "10 µm" and browser.curve() != drawn)
    browser.until(browser.is_complete)
    browser.driver.forward()
    browser.until(lambda: browser.value("oscillation.du_z") == amplitude and browser.curve() == drawn)
    browser.until(browser.is_complete)


def test_the_axis_of_friction_begins_at_zero_at_a_click(browser):
    begins = "return Bokeh.documents[0].get_model_by_name('friction').y_range.start"
    before = browser.driver.execute_script(begins)
    assert before > 0
    box = browser.inside(".from-zero", "input")
    for expected in (0, before):
        box.click()
        browser.until(lambda expected=expected: browser.driver.execute_script(begins) == expected)


@pytest.mark.parametrize("width", [320, 480, 500, 721, 1000])
def test_a_narrow_page_has_no_level_bar(browser, width):
    size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    browser.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    try:
        wide = "return [window.innerWidth, document.scrollingElement.scrollWidth]"
        browser.until(lambda: browser.driver.execute_script(wide)[0] == width)
        browser.until(lambda: browser.driver.execute_script(wide)[1] <= width)
    finally:
        browser.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def test_the_phase_moves_the_springs_and_nothing_else(browser):
    state, feet = browser.state(), browser.curve("springs", "foot")
    browser.move("phase", 20)
    browser.until(lambda: browser.curve("springs", "foot") != feet)
    assert browser.state() == state


@pytest.mark.parametrize(
    ("path", "text", "words"),
    [
        ("mu_0", "rough", "mu_0 wants a pure number, such as 0.1 or 10%, got 'rough'"),
        ("oscillation.u_z0", "-30", "the indenter never touches"),
        ("material.E", "3 mm", "E wants Pa (or kPa, MPa, GPa, N/mm2, bar, psi), got '3 mm'"),
    ],
)
def test_a_wrong_number_is_refused_with_words_and_the_picture_stays(browser, path, text, words):
    before, state, value = browser.curve(), browser.state(), browser.value(path)
    browser.type(path, text)
    browser.until(lambda: any(words in one for one in browser.text(".refused")))
    assert (browser.curve(), browser.state()) == (before, state)
    assert any("the pictures are of the last valid case" in one for one in browser.text(".doubted"))
    browser.type(path, value)
    browser.until(lambda: not browser.text(".refused"))
    browser.until(lambda: not any("last valid" in one for one in browser.text(".doubted")))


def test_another_kind_brings_its_own_controls(browser):
    browser.inside(named("kind", "shake"), "option[value='InPlaneOscillation']").click()
    browser.until(lambda: browser.find(named("slider", "shake.du_x")))
    browser.until(lambda: "shake.du_x" in browser.state())
    assert browser.curve()[0] < 0 < browser.curve()[-1]  # friction of both ways
    assert any("at rest, under a rigid pull" in line for line in browser.text("table"))


def test_groups_are_held(browser):
    browser.button("dimensionless groups")
    browser.until(lambda: browser.find(named("slider", "alpha")))
    alpha = browser.value("alpha")
    browser.type("oscillation.u_z0", "30")  # in the unit that the box shows
    browser.until(lambda: "u_z0=3e-05" in browser.state())
    assert browser.value("alpha") == alpha


def test_the_link_restores_the_state(browser):
    state, before = browser.state(), browser.curve()
    browser.type("mu_0", "0.3")
    browser.until(lambda: "mu_0=0.3" in browser.state())
    browser.open(state)
    assert browser.curve() == before
    browser.until(lambda: browser.state() == state)
    assert browser.find(named("slider", "alpha"))


def test_a_file_with_a_load_says_that_the_page_holds_the_depth(browser):
    path = browser.folder / "load.toml"
    path.write_text(mdr.write_case(CASE).replace("u_z0 = 2e-05", 'load = "0.3 N"'), encoding="utf-8")
    browser.inside(named("upload", "case"), "input[type=file]").send_keys(str(path))
    browser.until(lambda: any("load = 300 mN: the page holds the depth" in line for line in browser.text(".doubted")))


def test_a_wrong_link_is_refused_with_words(browser):
    browser.open("?mu_0=-1&indenter.shape=%22Kone%22")
    words = " ".join(browser.text(".refused"))
    assert "did you mean Cone?" in words
    assert "mu_0 must not be negative" in words


def test_the_case_is_downloaded_and_loaded_again(browser):
    browser.type("indenter.a", "2 mm")
    browser.until(lambda: "indenter.a=0.002" in browser.state())
    browser.button("Case (TOML)")
    path = browser.folder / "case.toml"
    browser.until(path.exists)
    case = browser.until(lambda: path.read_text(encoding="utf-8") and mdr.read_case(path))
    assert case == mdr.parse_case(mdr.write_case(CASE).replace("a = 0.001", "a = 0.002"))
    browser.type("indenter.a", "3")
    browser.until(lambda: "indenter.a=0.003" in browser.state())
    browser.inside(named("upload", "case"), "input[type=file]").send_keys(str(path))
    browser.until(lambda: "indenter.a=0.002" in browser.state())
    assert browser.value("indenter.a") == "2 mm"


def test_figures_are_downloaded(browser):
    for label, name in (("Curve (SVG)", "curve.svg"), ("Springs and forces (SVG)", "run.svg")):
        browser.button(label)
        path = browser.folder / name
        browser.until(lambda path=path: path.exists() and path.read_bytes().endswith(b"</svg>\n"))


def test_the_verdict_when_asked(browser):
    browser.button("Judge")
    said = browser.until(lambda: [line for line in browser.text(".verdict") if line.startswith("Eq. (15)")])
    assert "m/s" in said[0]


def test_the_contact_on_a_half_space_when_asked(browser):
    browser.button("See the contact")
    assert "pull" in browser.until(lambda: browser.text(".said.half-space"))[0]  # a body is refused
    browser.inside(named("kind", "pull"), "option[value='RigidPull']").click()
    browser.until(lambda: browser.state() and "pull" not in browser.state())
    browser.button("See the contact")
    said = browser.until(lambda: [line for line in browser.text(".said.half-space") if line.startswith("On ")])
    assert "cells of a half-space the COF is 0." in said[0]
    assert len(browser.find(".said.half-space svg")) == 1


def test_it_listens_on_this_machine_alone(server):
    """The socket is bound to 127.0.0.1, and a page of another origin gets no connection."""
    address = urlsplit(server[0])
    tables = [Path("/proc/net/tcp"), Path("/proc/net/tcp6")]
    rows = [line.split() for table in tables if table.exists() for line in table.read_text().splitlines()[1:]]
    listening = {
        row[1].split(":")[0] for row in rows if int(row[1].split(":")[1], 16) == address.port and row[3] == "0A"
    }
    assert listening == {"0100007F"}
    upgrade = {
        "Upgrade": "websocket", "Connection": "Upgrade", "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==",
        "Sec-WebSocket-Version": "13", "Origin": "http://elsewhere.example",
    }  # fmt: skip
    connection = http.client.HTTPConnection(address.hostname, address.port, timeout=PATIENCE)
    connection.request("GET", "/ws", headers=upgrade)
    assert connection.getresponse().status == 403
    connection.close()


def test_no_error_and_no_request_to_elsewhere(browser):
    """After all that the tests above did."""
    assert browser.errors() == []
    asked = {(urlsplit(url).scheme, urlsplit(url).hostname) for url in browser.requests()}
    assert ("http", "127.0.0.1") in asked
    assert {(scheme, host) for scheme, host in asked if scheme in ("http", "https", "ws", "wss", "ftp")} <= {
        ("http", "127.0.0.1"), ("ws", "127.0.0.1"),
    }  # fmt: skip


def test_it_ends_with_an_interrupt(server):
    process = server[1]
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=PATIENCE)
    assert process.returncode == 0
    assert "Traceback" not in errors
