"""Chromium without a window, driven by its driver, on a page of `mdr explore`, for tests."""

import importlib.util
import json
import re
import shutil
import subprocess
import sys
import time
from contextlib import contextmanager

PATIENCE = 240.0  #: s, until a wait is given up: the server may compile, on a machine that is busy
FLAGS = (
    "headless=new", "no-sandbox", "disable-gpu", "disable-quic", "no-first-run", "disable-background-networking",
    "disable-component-update", "disable-sync", "disable-dev-shm-usage", "window-size=1400,1300",
)  # fmt: skip
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


@contextmanager
def explorer(path):
    """Address and process of `mdr explore` on a case file."""
    command = [sys.executable, "-m", "mdr", "explore", str(path), "--port", "0", "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        line = process.stdout.readline()
        try:
            yield re.search(r"http://\S+", line)[0], process
        finally:
            if process.poll() is None:
                process.kill()


@contextmanager
def chromium(folder):
    """The driver of a browser that keeps its files in a folder."""
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for flag in (*FLAGS, f"user-data-dir={folder / 'profile'}"):
        options.add_argument(f"--{flag}")
    options.add_experimental_option("prefs", {"download.default_directory": str(folder)})
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    with webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver"))) as driver:
        yield driver


class Browser:
    """One page of the explorer."""

    def __init__(self, driver, address, folder):
        self.driver, self.address, self.folder = driver, address, folder
        self.open()

    def open(self, query=""):
        self.driver.get(f"{self.address}{query}")
        self.until(self.is_complete)

    def is_complete(self):
        """Whether the error of the curve is bounded."""
        return self.shown().startswith("error of friction")

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
        script = f"{FIND}return found.length ? found[0].shadowRoot.querySelector(arguments[1]) : null"
        return self.until(lambda: self.driver.execute_script(script, selector, part))

    def text(self, selector):
        """Words of all elements that are not hidden."""
        return self.driver.execute_script(FIND + "return found.map(one => one.innerText).filter(Boolean)", selector)

    def shown(self):
        """What the page says of its curve."""
        return " ".join(self.text(".status"))

    def curve(self, name="curve", column="cof"):
        """Friction over velocity, or another column of data, as drawn."""
        script = "return [...Bokeh.documents[0].get_model_by_name(arguments[0]).data[arguments[1]]]"
        return self.driver.execute_script(script, name, column)

    def value(self, path):
        return self.inside(named("box", path), "input").get_attribute("value")

    def type(self, path, text):
        from selenium.webdriver.common.keys import Keys

        box = self.inside(named("box", path), "input")
        before = box.get_attribute("value")

        def entered():
            # typed over what stands there: to empty the box first would be a change; an answer may overwrite the text,
            # until it is entered
            box.send_keys(Keys.CONTROL + "a" + Keys.NULL + text)
            if box.get_attribute("value") != text:
                return False
            box.send_keys(Keys.ENTER)
            time.sleep(0.2)
            return text == before or box.get_attribute("value") != before

        self.until(entered)

    def move(self, path, steps):
        from selenium.webdriver.common.keys import Keys

        self.inside(f".slider[class~='{path}']", ".noUi-handle").send_keys(Keys.ARROW_RIGHT * steps)

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
