"""The explorer in a real browser: chromium without a window, driven by its driver, against `mdr explore` itself."""

import http.client
import importlib.util
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from urllib.parse import urlsplit

import pytest

import mdr

REQUIRED = os.environ.get("MDR_BROWSER") == "required"  #: a browser that is missing is then a failure
PATIENCE = 30.0  #: s, for a machine that is busy
CASE = mdr.SlidingContact(
    mdr.FlatPunch(a=1e-3),
    mdr.Elastic(E=3e6, nu=0.5),
    mu_0=0.4,
    oscillation=mdr.NormalOscillation(u_z0=20e-6, du_z=10e-6, omega=300.0),
    pull=mdr.SpringPull(k_x=2e4, m=0.05, c_x=4.0),
)
#: every element that a selector finds, also inside shadow roots
FIND = """
const found = [], selector = arguments[0];
(function walk(root) {
  for (const one of root.querySelectorAll('*')) {
    if (one.matches(selector)) found.push(one);
    if (one.shadowRoot) walk(one.shadowRoot);
  }
})(document);
"""


def lacking():
    """What is not installed of all that a test in a browser takes."""
    modules = [name for name in ("panel", "bokeh", "selenium") if importlib.util.find_spec(name) is None]
    return modules + [name for name in ("chromium", "chromedriver") if shutil.which(name) is None]


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    """Address and process of the explorer of CASE."""
    if missing := lacking():
        (pytest.fail if REQUIRED else pytest.skip)(f"no test in a browser without {', '.join(missing)}")
    path = tmp_path_factory.mktemp("explorer") / "case.toml"
    path.write_text(mdr.write_case(CASE), encoding="utf-8")
    command = [sys.executable, "-m", "mdr", "explore", str(path), "--port", "0", "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        line = process.stdout.readline()
        try:
            yield re.search(r"http://\S+", line)[0], process
        finally:
            if process.poll() is None:
                process.kill()


class Browser:
    """One page of the explorer."""

    def __init__(self, driver, address, folder):
        self.driver, self.address, self.folder = driver, address, folder
        self.open()

    def open(self, query=""):
        self.driver.get(f"{self.address}{query}")
        self.until(lambda: self.shown().startswith("error of friction"))

    def until(self, true):
        """Wait until something is so, and return it."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if answer := true():
                return answer
            time.sleep(0.02)
        raise AssertionError(f"not so after {PATIENCE:g} s: {self.shown()}")

    def find(self, selector):
        return self.driver.execute_script(FIND + "return found", selector)

    def inside(self, selector, part):
        """A part of a widget, in its shadow."""
        script = "return arguments[0].shadowRoot.querySelector(arguments[1])"
        return self.until(lambda: self.driver.execute_script(script, self.find(selector)[0], part))

    def text(self, selector):
        """Words of all elements that are not hidden."""
        return self.driver.execute_script(FIND + "return found.map(one => one.innerText).filter(Boolean)", selector)

    def shown(self):
        """What the page says of its curve."""
        return " ".join(self.text(".status"))

    def curve(self):
        """Friction over velocity, as drawn."""
        return self.driver.execute_script("return [...Bokeh.documents[0].get_model_by_name('curve').data.cof]")

    def value(self, path):
        return self.inside(named("box", path), "input").get_attribute("value")

    def type(self, path, text):
        from selenium.webdriver.common.keys import Keys

        box = self.inside(named("box", path), "input")
        box.clear()
        box.send_keys(text + Keys.ENTER)

    def move(self, path, steps):
        from selenium.webdriver.common.keys import Keys

        self.inside(named("slider", path), ".noUi-handle").send_keys(Keys.ARROW_RIGHT * steps)

    def state(self):
        """The query of the address, which carries the state of the last picture."""
        return self.driver.execute_script("return location.search")

    def button(self, label):
        next(one for one in self.find("button, a") if label in one.text).click()

    def errors(self):
        return [line["message"] for line in self.driver.get_log("browser") if line["level"] == "SEVERE"]

    def requests(self):
        """Addresses of all that the page asked for."""
        for line in self.driver.get_log("performance"):
            message = json.loads(line["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                yield message["params"]["request"]["url"]
            elif message["method"] == "Network.webSocketCreated":
                yield message["params"]["url"]


def named(kind, path):
    return f"[class~='{kind}'][class~='{path}']"


@pytest.fixture(scope="module")
def browser(server, tmp_path_factory):
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    folder = tmp_path_factory.mktemp("chromium")
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for flag in (
        "headless=new", "no-sandbox", "disable-gpu", "disable-quic", "no-first-run", "disable-background-networking",
        "disable-component-update", "disable-sync", "disable-dev-shm-usage", "window-size=1400,1300",
        f"user-data-dir={folder / 'profile'}",
    ):  # fmt: skip
        options.add_argument(f"--{flag}")
    options.add_experimental_option("prefs", {"download.default_directory": str(folder)})
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    with webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver"))) as driver:
        yield Browser(driver, server[0], folder)


def test_the_page_opens_with_its_pictures(browser):
    drawn = mdr.cof_curve(CASE, [0.0]).cof[0]
    assert browser.curve()[0] == pytest.approx(drawn, abs=1e-3 * CASE.mu_0)
    assert len(browser.find(".bk-Figure")) == 3
    assert browser.value("indenter.a") == "0.001"
    assert any("critical velocity in closed form" in line for line in browser.text("table"))


def test_a_slider_moves_the_curve(browser):
    before, state = browser.curve(), browser.state()
    browser.move("oscillation.du_z", 20)
    browser.until(lambda: browser.state() != state and browser.curve() != before)
    amplitude = float(browser.value("oscillation.du_z"))
    assert amplitude > CASE.oscillation.du_z
    browser.until(lambda: f"du_z={amplitude!r}" in browser.state())  # of all moves the last is drawn
    assert browser.curve()[0] < before[0]


@pytest.mark.parametrize(
    ("path", "text", "words"),
    [
        ("indenter.a", "-1", "a must be positive, got -1.0"),
        ("mu_0", "rough", "mu_0 must be a real number, got 'rough'"),
        ("oscillation.u_z0", "nan", "u_z0 must be a finite number"),
        ("oscillation.u_z0", "-1", "the indenter never touches"),
        ("material.nu", "0.7", "nu must lie in"),
    ],
)
def test_a_wrong_number_is_refused_with_words_and_the_picture_stays(browser, path, text, words):
    before, state, value = browser.curve(), browser.state(), browser.value(path)
    browser.type(path, text)
    browser.until(lambda: any(words in one for one in browser.text(".refused")))
    assert (browser.curve(), browser.state()) == (before, state)
    browser.type(path, value)
    browser.until(lambda: not browser.text(".refused"))


def test_another_kind_brings_its_own_controls(browser):
    browser.inside(named("kind", "shake"), "option[value='InPlaneOscillation']").click()
    browser.until(lambda: browser.find(named("slider", "shake.du_x")))
    browser.until(lambda: "shake.du_x" in browser.state())
    assert browser.curve()[0] < 0 < browser.curve()[-1]  # friction of both ways
    assert any("holds at rest" in line for line in browser.text("table"))


def test_groups_are_held(browser):
    browser.button("dimensionless groups")
    browser.until(lambda: browser.find(named("slider", "alpha")))
    alpha = browser.value("alpha")
    browser.type("oscillation.u_z0", "30e-6")
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


def test_a_wrong_link_is_refused_with_words(browser):
    browser.open("?mu_0=-1&indenter.shape=%22Kone%22")
    words = " ".join(browser.text(".refused"))
    assert "did you mean Cone?" in words
    assert "mu_0 must be positive" in words


def test_the_case_is_downloaded_and_loaded_again(browser):
    browser.type("indenter.a", "2e-3")
    browser.until(lambda: "indenter.a=0.002" in browser.state())
    browser.button("Case (TOML)")
    path = Path(browser.folder / "case.toml")
    browser.until(path.exists)
    case = browser.until(lambda: path.read_text(encoding="utf-8") and mdr.read_case(path))
    assert case == mdr.parse_case(mdr.write_case(CASE).replace("a = 0.001", "a = 0.002"))
    browser.type("indenter.a", "3e-3")
    browser.until(lambda: "indenter.a=0.003" in browser.state())
    browser.inside(named("upload", "case"), "input[type=file]").send_keys(str(path))
    browser.until(lambda: "indenter.a=0.002" in browser.state())
    assert browser.value("indenter.a") == "0.002"


def test_the_verdict_when_asked(browser):
    browser.button("Judge")
    said = browser.until(lambda: [line for line in browser.text(".verdict") if line.startswith("Eq. (15)")])
    assert "m/s" in said[0]


def test_it_listens_on_this_machine_alone(server):
    """The socket is bound to 127.0.0.1, and a page of another origin gets no connection."""
    address = urlsplit(server[0])
    tables = [Path("/proc/net/tcp"), Path("/proc/net/tcp6")]
    rows = [line.split() for table in tables if table.exists() for line in table.read_text().splitlines()[1:]]
    listening = {row[1].split(":")[0] for row in rows if int(row[1].split(":")[1], 16) == address.port and row[3] == "0A"}
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
