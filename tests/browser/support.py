"""Parts that tests of both pages share: the command, and a page in the browser."""

import base64
import contextlib
import csv
import os
import subprocess
import time
from pathlib import Path

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.wait import WebDriverWait

COMMAND = os.environ.get("FLAP") or str(Path(__file__).parents[2] / "target/debug/flap")


def command(*arguments, code=0):
    """Runs `flap`."""
    ended = subprocess.run([COMMAND, *map(str, arguments)], capture_output=True, text=True, check=False)
    assert ended.returncode == code, ended.stderr
    return ended


def rows_of(path):
    """Names and rows of a file of results: numbers, texts, True and False, and None."""

    def cell(text):
        if text in ("", "true", "false"):
            return {"": None, "true": True, "false": False}[text]
        try:
            return float(text)
        except ValueError:
            return text

    with open(path, encoding="utf-8", newline="") as file:
        names, *lines = csv.reader(line for line in file if not line.startswith("#"))
    return names, [[cell(text) for text in line] for line in lines]


def luminance(colour):
    """The relative luminance of a colour (red, green, blue)."""
    parts = [part / 255 for part in colour]
    red, green, blue = (part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(one, other):
    """The contrast of two colours, from 1 to 21."""
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


class Page:
    """A page in the browser."""

    # A script that says when the page has drawn what it was asked for.
    ready = "return true"

    def __init__(self, browser):
        self.browser = browser

    def open(self, address):
        self.browser.get("about:blank")
        self.browser.get(address)
        return self.rest()

    def script(self, text, *arguments):
        return self.browser.execute_script(text, *arguments)

    def wait(self, text, *arguments, seconds=20):
        """Waits until a script says yes."""
        WebDriverWait(self.browser, seconds, poll_frequency=0.03).until(lambda _: self.script(text, *arguments), text)

    def rest(self):
        self.wait(self.ready)
        return self

    def find(self, selector):
        return self.browser.find_element(By.CSS_SELECTOR, selector)

    def click(self, selector):
        self.find(selector).click()

    def text(self, selector):
        return self.script("return document.querySelector(arguments[0]).textContent", selector)

    def type(self, selector, text):
        field = self.find(selector)
        field.send_keys(Keys.CONTROL, "a")
        if text == "":
            field.send_keys(Keys.DELETE, Keys.TAB)
        else:
            field.send_keys(text, Keys.ENTER)

    def downloads(self, folder):
        """Downloads go to this folder."""
        self.browser.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(folder)})

    def fingers(self, kind, *places):
        """Fingers on a phone's screen: `touchStart`, `touchMove` or `touchEnd`, at places (x, y) of the window."""
        points = [{"x": x, "y": y, "id": number} for number, (x, y) in enumerate(places)]
        self.browser.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    def picture(self):
        """The window as a PNG."""
        return base64.b64decode(self.browser.execute_cdp_cmd("Page.captureScreenshot", {"format": "png"})["data"])


def downloaded(path):
    """The bytes of a file, when the browser has written it."""
    until = time.monotonic() + 20
    while not path.exists():
        assert time.monotonic() < until, sorted(each.name for each in path.parent.iterdir())
        time.sleep(0.05)
    return path.read_bytes()


@contextlib.contextmanager
def screen(browser, width, height, scheme="light", mobile=False):
    """A screen of this size and scheme."""
    size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": mobile}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    browser.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": mobile})
    features = [{"name": "prefers-color-scheme", "value": scheme}]
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})
    try:
        yield
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
        browser.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": False})
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
