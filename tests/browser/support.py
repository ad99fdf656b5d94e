"""Parts that tests of both pages share: the command, and a page in the browser."""

import contextlib
import csv
import os
import subprocess
import time
from pathlib import Path

from selenium.common.exceptions import NoSuchElementException, StaleElementReferenceException
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.wait import WebDriverWait

# The page has just replaced an element, or not made it yet.
CHANGING = (NoSuchElementException, StaleElementReferenceException, AssertionError)

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
    """A page in the browser.

    Tests look at what a user sees. What is painted on the canvas of a chart is not in the DOM: `chart` reads it from the page's
    `flapTestHook`.
    """

    def __init__(self, browser):
        self.browser = browser

    def open(self, address):
        self.browser.get("about:blank")
        self.browser.get(address)
        return self.rest()

    def reload(self):
        self.browser.refresh()
        return self.rest()

    def rest(self):
        """Waits until the page shows its state."""
        raise NotImplementedError

    def script(self, text, *arguments):
        return self.browser.execute_script(text, *arguments)

    def wait(self, condition, *arguments, seconds=20):
        """Waits until a condition holds: a function, or an expression of the page's language."""
        is_script = isinstance(condition, str)
        holds = (lambda _: self.script(f"return {condition}", *arguments)) if is_script else (lambda _: condition())
        waiting = WebDriverWait(self.browser, seconds, poll_frequency=0.03, ignored_exceptions=CHANGING)
        waiting.until(holds, condition if is_script else "")

    def find(self, selector):
        return self.browser.find_element(By.CSS_SELECTOR, selector)

    def find_all(self, selector):
        return self.browser.find_elements(By.CSS_SELECTOR, selector)

    def click(self, selector):
        self.find(selector).click()

    def text(self, selector):
        return self.property(selector, "textContent")

    def texts(self, selector):
        return self.properties(selector, "textContent")

    def value(self, selector):
        return self.property(selector, "value")

    def property(self, selector, name):
        """A property of the first element."""
        found = self.properties(selector, name)
        assert found, f"no element matches {selector}"
        return found[0]

    def properties(self, selector, name):
        """A property of all elements, read at one moment: the page may replace its elements at any time."""
        return self.script(
            "return [...document.querySelectorAll(arguments[0])].map((each) => each[arguments[1]])", selector, name
        )

    def type(self, selector, text):
        field = self.find(selector)
        field.send_keys(Keys.CONTROL, "a")
        if text == "":
            field.send_keys(Keys.DELETE, Keys.TAB)
        else:
            field.send_keys(text, Keys.ENTER)

    def keys(self, *keys):
        """Keys to the element that has the focus."""
        ActionChains(self.browser).send_keys(*keys).perform()

    def focused(self):
        return self.browser.switch_to.active_element

    def chart(self, expression, number=0):
        """A value of a chart: its `scene`, `view`, `mark`, `ticks`, or its `plot`."""
        return self.script(f"const chart = flapTestHook.charts[arguments[0]]; return {expression}", number)

    def range(self, axis, number=0):
        """The ends of an axis."""
        return self.chart(f"[chart.plot.scales.{axis}.min, chart.plot.scales.{axis}.max]", number)

    def labels(self, axis, number=0):
        """The labels of an axis."""
        return self.chart(f"chart.ticks.{axis}.map((tick) => tick.label)", number)

    def lines(self, number=0):
        """The lines of a chart that the legend has not switched off."""
        keys = "{ key, name, group, x, y, color, ghost: Boolean(ghost) }"
        shown = f"chart.scene.lines.map(({keys.replace(': Boolean(ghost)', '')}) => ({keys}))"
        lines, hidden = self.chart(f"[{shown}, [...chart.hidden]]", number)
        return [line for line in lines if line["ghost"] or line["group"] not in hidden]

    def over(self, number=0):
        """The part of a chart that listens to the pointer."""
        return self.find_all(".chart-box .u-over")[number]

    def point_at(self, left, top, number=0):
        """Moves the pointer to pixels from the top left of a chart."""
        over = self.over(number)
        offset = round(left - over.size["width"] / 2), round(top - over.size["height"] / 2)
        ActionChains(self.browser).move_to_element_with_offset(over, *offset).perform()

    def point_at_value(self, line, place, number=0):
        """Moves the pointer to a value of a line."""
        value = f"{{ x: chart.scene.lines[{line}].x[{place}], y: chart.scene.lines[{line}].y[{place}] }}"
        to_pixels = "[chart.plot.valToPos(x, 'x'), chart.plot.valToPos(y, 'y')]"
        self.point_at(*self.chart(f"(({{ x, y }}) => {to_pixels})({value})", number), number)

    def point_at_gap(self, number=0):
        """Moves the pointer to the first gap, in the lowest row of marks; returns the gap."""
        gap, left, height = self.chart(
            "((gap) => [gap, chart.plot.valToPos(gap.x, 'x'), chart.plot.over.clientHeight])(chart.scene.gaps[0])",
            number,
        )
        self.point_at(left, height - 6, number)
        return gap

    def box(self, selector):
        """Left, top, width and height of an element in the window."""
        place = "const { left, top, width, height } = arguments[0].getBoundingClientRect(); return [left, top, width, height]"
        return self.script(place, self.find(selector))

    def downloads(self, folder):
        """Downloads go to this folder."""
        self.browser.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(folder)})

    def fingers(self, kind, *places):
        """Fingers on a phone's screen: `touchStart`, `touchMove` or `touchEnd`, at places (x, y) of the window."""
        points = [{"x": x, "y": y, "id": number} for number, (x, y) in enumerate(places)]
        self.browser.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    def pinch(self, x, y):
        """Two fingers around a place of the window, from 60 to 120 pixels apart."""
        self.fingers("touchStart", (x - 30, y), (x + 30, y))
        self.fingers("touchMove", (x - 60, y), (x + 60, y))
        self.fingers("touchEnd")

    def fits_width(self):
        return self.script("return document.documentElement.scrollWidth <= innerWidth")

    def background(self):
        return self.find("body").value_of_css_property("background-color")

    def resources(self):
        """The addresses of everything that the page has fetched."""
        return self.script("return performance.getEntriesByType('resource').map((entry) => entry.name)")

    def durations(self, name):
        """Milliseconds of all measures of a name."""
        return self.script("return performance.getEntriesByName(arguments[0]).map((entry) => entry.duration)", name)


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
