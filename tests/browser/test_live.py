"""Journeys on the page of `flap live`: sliders, axes, files, the address, the keyboard, errors, phones.

Numbers that need no browser are tested in tests/web.
"""

import math
import signal
import subprocess
import time
from pathlib import Path

import pytest
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.select import Select
from support import COMMAND, Page, command, downloaded, rows_of, screen

ROOT = Path(__file__).parents[2]

# A soft hinge: two motions between 124 and 128 Hz at 160 V.
BISTABLE = """\
preset = "jafferis2016"
[params]
hinge_stiffness = "0.7486 uN*m/rad"
drive_voltage_pp = "160 V"
[axes]
drive_frequency = { from = "118 Hz", to = "132 Hz", step = "1 Hz" }
"""


class Server:
    """A server of the page, in a process of its own."""

    def __init__(self, opened, port=0):
        arguments = [COMMAND, "live", str(opened), "--no-open", "--port", str(port)]
        self.process = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.address = self.process.stdout.readline().strip()
        assert self.address.startswith("http://127.0.0.1:"), "the command has not printed an address"

    @property
    def port(self):
        return int(self.address.split(":")[2].split("/")[0])

    def stop(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
        self.process.wait(timeout=20)
        self.process.stdout.close()


class LivePage(Page):
    """The live page."""

    def rest(self):
        self.wait("window.flapTestHook?.isSettled() === true")
        return self

    def row(self, name):
        return self.find(f'.parameter[data-name="{name}"]')

    def show(self, name):
        """Opens the group of a parameter."""
        group = self.find(f'details:has([data-name="{name}"])')
        if group.get_attribute("open") is None:
            group.find_element(By.TAG_NAME, "summary").click()

    def slider(self, name):
        self.show(name)
        return self.row(name).find_element(By.CSS_SELECTOR, "input[type=range]")

    def give(self, name, text):
        """Types the value of a parameter."""
        self.show(name)
        self.type(f"#p-{name}", text)

    def changed(self):
        """The parameters that are marked as changed, and their values as they are shown."""
        return self.script(
            """
            const rows = [...document.querySelectorAll(".parameter.changed")];
            return Object.fromEntries(rows.map(({ dataset: { name } }) => [name, document.getElementById(`p-${name}`).value]))
            """
        )

    def choose(self, name, value):
        Select(self.find(f"#{name}")).select_by_value(value)
        self.rest()

    def rows(self):
        """Names of the columns, and the rows behind the picture."""
        return self.script("const { columns, rows } = flapTestHook.rows(); return [columns, rows]")

    def names(self):
        """The names of the family's lines."""
        return [line["name"] for line in self.lines() if not line["ghost"]]

    def saved(self, kind):
        """The text of a kind in the dialog, which is opened if it is not."""
        if not self.find("#save-dialog").is_displayed():
            self.click("#save")
        self.click(f'#save-dialog [data-kind="{kind}"]')
        kinds = {"# flap": "grid", "import": "python", "": None}
        self.wait(lambda: kinds.get(self.text("#saved")[:6], "device") == kind)
        return self.text("#saved")

    def number(self, name, part="value"):
        """A number of the design, as its cell shows it."""
        return self.text(f'#main-numbers [data-name="{name}"] .{part}')

    def problem(self, name):
        """The problem of a field; empty if none is shown."""
        return self.property(f'.parameter[data-name="{name}"] .problem', "innerText")

    def wait_for_motion(self):
        self.wait(lambda: self.text("#motion-of") != "" and len(self.find_all("#series .u-over")) >= 3)


@pytest.fixture(scope="module")
def server():
    made = Server("jafferis2016")
    yield made
    made.stop()


@pytest.fixture
def page(browser, server):
    browser.get_log("browser")
    opened = LivePage(browser).open(server.address)
    yield opened
    noise = [entry["message"] for entry in browser.get_log("browser") if " 422 " not in entry["message"]]
    assert noise == [], "the console is not empty"


@pytest.fixture
def other(browser):
    """Opens the page of something else."""
    servers = []

    def start(opened):
        servers.append(Server(opened))
        return LivePage(browser).open(servers[-1].address)

    yield start
    for each in servers:
        each.stop()


def assert_same(found, expected):
    """Rows that agree bit for bit."""
    names, rows = found
    assert names == expected[0]
    assert len(rows) == len(expected[1])
    for one, other_one in zip(rows, expected[1]):
        for name, a, b in zip(names, one, other_one):
            both_missing = b is None and (a is None or a == "")
            assert both_missing or a == b or (isinstance(b, float) and math.isinf(b) and a in (None, "inf")), (
                name,
                a,
                b,
            )


# ---- sliders and axes ----


def test_a_slider_moves_the_family(page):
    """The family follows, coarse and then fine; the earlier one stays as ghosts; the numbers show what has changed."""
    before = page.rows()
    assert len(before[1]) == 5 * 81
    page.script(
        """
        window.tips = [];
        const tip = document.querySelector("#tip");
        new MutationObserver(() => window.tips.push(tip.textContent)).observe(tip, { childList: true });
        """
    )
    page.slider("hinge_stiffness").send_keys(*[Keys.ARROW_RIGHT] * 20)
    page.rest()
    assert page.rows()[1] != before[1]
    assert list(page.changed()) == ["hinge_stiffness"]
    change = page.number("lift_mean_mn", "change")
    assert change.endswith("%") and change[0] in "+−"
    assert [line["ghost"] for line in page.lines()] == [True] * 5 + [False] * 5
    assert page.durations("flap-slider-to-picture")
    assert any(tip.endswith("coarse, refining …") for tip in page.script("return window.tips"))
    assert "coarse" not in page.text("#tip")


def test_the_picture_ends_at_the_last_of_many_fast_steps(page):
    """Requests in between are left out, and no picture is older than the one before."""
    page.slider("wing_length")
    page.script(
        """
        const [chart] = flapTestHook.charts, { draw } = chart, slider = document.querySelector("[data-name=wing_length] input[type=range]");
        window.drawn = [];
        chart.draw = (scene) => { window.drawn.push(flapTestHook.rows().request.design.wing_length ?? 0); draw.call(chart, scene); };
        window.step = 502;
        const move = () => {
          slider.value = window.step;
          slider.dispatchEvent(new Event("input", { bubbles: true }));
          window.step += 2;
          if (window.step <= 900) setTimeout(move, 2); else slider.dispatchEvent(new Event("change", { bubbles: true }));
        };
        move();
        """
    )
    page.wait("window.step > 900")
    page.rest()
    drawn = page.script("return window.drawn")
    assert drawn == sorted(drawn)
    assert 1000 * drawn[-1] == pytest.approx(float(page.value("#p-wing_length")), rel=1e-5)
    assert len(drawn) < 200


def test_a_measure_and_axes_are_chosen(page):
    page.choose("measure", "stroke_amplitude_deg")
    assert page.chart("chart.scene.y.label") == "Stroke, amplitude"
    assert page.text("#gradient-title").startswith("Effects on stroke, amplitude")
    page.choose("x", "hinge_stiffness")
    assert page.rows()[0][2] == "hinge_stiffness"
    page.type("#x-from", "1")
    page.type("#x-to", "3")
    page.rest()
    along = [row[2] for row in page.rows()[1]]
    assert (min(along), max(along)) == (pytest.approx(1e-6), pytest.approx(3e-6))
    page.type("#by-values", "100, 0.15 kV")
    page.rest()
    assert page.names() == ["100 V", "150 V"] == page.texts("#chart .legend button")
    page.click("#log-x")
    page.click("#log-y")
    assert page.chart("[chart.scene.x.log, chart.scene.y.log]") == [True, True]
    for axis in ("x", "y"):
        labels = page.labels(axis)
        assert len(labels) >= 4 and max(map(len, labels)) <= 7, labels


def test_ends_of_the_axis_are_typed_with_units_or_refused_with_words(page):
    page.type("#x-from", "0.1 kHz")
    page.rest()
    assert page.range("x")[0] == pytest.approx(100)
    for text, words in [
        ("1,400", "may be 1400 or 1.4"),
        ("5 cats", "is not a unit"),
        ("many", "number"),
        (page.value("#x-to"), "must differ"),
    ]:
        page.type("#x-from", text)
        assert words in page.text("#x-problem"), text
        assert page.range("x")[0] == pytest.approx(100)
    page.type("#x-from", "")
    assert page.value("#x-from") == "100"
    assert not page.find("#x-problem").is_displayed()


def test_lines_and_axes_are_within_the_allowed_values(page):
    for menu in ("by", "x"):
        page.choose(menu, "actuator_width_ratio")
        assert not page.find("#banner").is_displayed()
    assert float(page.value("#x-to")) == 1.98


def test_lines_and_sliders_of_a_whole_number_have_whole_values(other):
    page = other("arabagi2013-75hz")
    assert page.find_all("#by [value=strips]") and not page.find_all("#x [value=strips]")
    page.choose("by", "strips")
    assert page.names() == ["10", "13", "16", "19", "22"]
    page.slider("strips").send_keys(Keys.ARROW_RIGHT)
    page.rest()
    assert page.changed() == {"strips": "17"}


def test_points_without_a_motion_are_marks_at_the_foot(page):
    page.give("drive_voltage_pp", "1e5")
    page.type("#by-values", "100, 4000")
    page.rest()
    names, rows = page.rows()
    statuses = [row[names.index("status")] for row in rows]
    missing = sum(status != "periodic" for status in statuses)
    assert missing == page.chart("chart.scene.gaps.length") > 0
    assert page.text("#tip").startswith(f"{missing} of {len(rows)} points have no settled motion")
    counts = [
        f"{statuses.count(status)} {status.replace('_', ' ')}"
        for status in dict.fromkeys(statuses)
        if status != "periodic"
    ]
    assert page.texts("#chart .statuses span") == counts
    gap = page.point_at_gap()
    page.wait(lambda: page.text("#tip").startswith("No settled motion at"))
    assert f"{gap['name']} {gap['status'].replace('_', ' ')}" in page.text("#tip")


def test_parameters_that_follow_others_can_be_set_and_unset(other):
    page = other("ozaki2018-large")
    assert "drive_voltage_pp" in page.find("#p-drive_bias").get_attribute("placeholder")
    page.give("drive_bias", "60")
    page.rest()
    assert page.changed() == {"drive_bias": "60"}
    page.type("#p-drive_bias", "")
    page.rest()
    assert page.changed() == {}


# ---- the numbers, the motion, pins ----


def test_numbers_lead_to_their_parameters(page):
    bars = page.find_all("#gradient .slope")
    assert len(bars) == 10
    slopes = [abs(float(text.replace("−", "-"))) for text in page.texts("#gradient .value")]
    assert slopes == sorted(slopes, reverse=True)
    name = bars[0].find_element(By.CSS_SELECTOR, ".name").text
    bars[0].click()
    assert page.focused().get_attribute("aria-label") == f"{name}, slider"
    page.give("drive_voltage_pp", "200160")
    page.rest()
    assert "times the preset's" in page.text("#banner")
    page.give("drive_voltage_pp", "60")
    page.rest()
    assert "times the preset's" not in page.text("#banner")


def test_the_motion_is_that_of_the_point_under_the_pointer(page):
    page.wait_for_motion()
    assert page.text("#motion-of") == "of the design"
    page.point_at_value(4, 20)
    page.wait(lambda: "250 V" in page.text("#motion-of"))
    frequency = page.chart("chart.scene.lines[4].x[20]")
    assert page.text("#motion-of") == f"at {frequency:g} Hz, 250 V"
    assert page.text("#tip").startswith("Lift, mean ") and page.text("#tip").endswith(
        f" at {frequency:g} Hz, 250 V: periodic"
    )
    ActionChains(page.browser).move_to_element(page.find("h1")).perform()
    page.wait(lambda: page.text("#motion-of") == "of the design")


def test_the_wing_stands_still_and_goes_on(browser, server):
    page = LivePage(browser).open(server.address)
    page.wait_for_motion()
    time_line = "#series .chart-time"
    page.wait(lambda: page.find_all(time_line))
    page.click("#play")
    still = page.box(time_line)
    time.sleep(0.2)
    assert page.box(time_line) == still
    page.click("#play")
    page.wait(lambda: page.box(time_line) != still)
    assert page.text("#above-caption").startswith("from above · stroke ")
    assert page.text("#tip-caption").startswith("from the tip · pitch ")
    painted = "const { data } = arguments[0].getContext('2d').getImageData(0, 0, 9999, 9999); return data.some((part) => part > 0)"
    assert all(page.script(painted, page.find(canvas)) for canvas in ("#above", "#tip-view"))

    browser.execute_cdp_cmd(
        "Emulation.setEmulatedMedia", {"features": [{"name": "prefers-reduced-motion", "value": "reduce"}]}
    )
    try:
        page.open(server.address)
        assert page.text("#play") == "Play"
        page.wait_for_motion()
        page.wait(lambda: page.find_all(time_line))
        assert page.find(time_line).value_of_css_property("left") == "0px"
    finally:
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})


def test_up_and_down_of_a_bistable_design(other, tmp_path):
    """The bands are those of the column `bistable`, for every measure."""
    grid = tmp_path / "soft.toml"
    grid.write_text(BISTABLE, encoding="utf-8")
    page = other(grid)
    page.click("#hysteresis")
    page.rest()
    assert page.names() == ["up", "down"]
    names, rows = page.rows()
    frequencies = [row[names.index("drive_frequency")] for row in rows if row[names.index("bistable")] is True]
    bands = page.chart("chart.scene.bands")
    assert bands == [{"from": pytest.approx(min(frequencies)), "to": pytest.approx(max(frequencies))}]
    assert 123 < bands[0]["from"] < bands[0]["to"] < 129
    assert page.text("#tip").startswith("Bistable between ")
    # The motion under the pointer is the motion of its branch.
    page.script("flapTestHook.showMoment(0.25)")
    middle = page.chart("chart.scene.lines[0].rows.findIndex((row) => row.x > 126)")
    captions = set()
    for line, branch in enumerate(("up", "down")):
        page.point_at_value(line, middle)
        page.wait(lambda branch=branch: page.text("#motion-of").endswith(f", {branch}"))
        page.script("return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        captions.add(page.text("#above-caption"))
    assert len(captions) == 2, captions
    # A measure with the same values on both ways.
    page.choose("measure", "field_max_v_per_um")
    assert page.chart("chart.scene.bands") == bands
    grid = page.saved("grid")
    assert grid.startswith("# flap respond") and "drive_voltage_pp = [" not in grid
    page.click("#save-dialog form > .bar:last-child button:last-child")
    page.reload()
    assert page.find("#hysteresis").get_attribute("aria-pressed") == "true"
    assert page.names() == ["up", "down"]
    page.click("#hysteresis")
    page.rest()
    assert page.chart("chart.scene.bands") == []


def test_pins_stand_side_by_side(page):
    for length in ("19", "15"):
        page.give("wing_length", length)
        page.rest()
        page.click("#pin")
    assert len(page.find_all("#pin-table thead th")) == 4
    page.wait(lambda: not any("–" in text for text in page.texts("#pin-table tbody tr")))
    assert page.texts("#pin-table tbody tr:first-child td") == ["Wing length", "19 mm", "15 mm", "15 mm"]
    lift = page.texts("#pin-table tbody tr:nth-child(2) td")
    assert lift[2] == lift[3] == page.number("lift_mean_mn").split()[0] != lift[1]
    page.click("#pin-table [aria-label='restore A']")
    page.rest()
    assert page.changed() == {"wing_length": "19"}
    page.click("#pin-table [aria-label='remove A']")
    assert page.texts("#pin-table thead th") == ["", "B Restore ×", "now"]


# ---- files ----


def test_saved_texts_give_what_is_shown(page, tmp_path):
    """The grid gives the rows bit for bit, the device and the lines of Python the design."""
    page.give("wing_length", "18")
    Select(page.find("#p-drive_shape")).select_by_value("square")
    page.type("#by-values", "120, 180")
    page.rest()
    shown, lift = page.rows(), page.number("lift_mean_mn")
    grid = tmp_path / "family.toml"
    grid.write_text(page.saved("grid"), encoding="utf-8")
    command("check", grid)
    command("sweep", grid, "--out", tmp_path / "rows.csv")
    assert_same(shown, rows_of(tmp_path / "rows.csv"))

    device = tmp_path / "design.toml"
    device.write_text(page.saved("device"), encoding="utf-8")
    ended = command("run", device).stdout
    value = next(line.split()[1] for line in ended.splitlines() if line.split()[:1] == ["lift_mean_mn"])
    assert float(value) == pytest.approx(float(lift.split()[0]), rel=1e-4)

    lines = page.saved("python")
    compile(lines, "family.py", "exec")
    assert "0.018" in lines and "flapwing.sweep" in lines
    pytest.importorskip("flapwing", exc_type=ImportError)
    found = {}
    exec(lines, found)  # the lines that the page offers
    assert len(found["table"]) == 2 * 81


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_files_and_pictures_are_downloaded(browser, server, tmp_path, scheme):
    with screen(browser, 1600, 1000, scheme):
        page = LivePage(browser).open(server.address)
        page.downloads(tmp_path)
        background = page.background()
        assert background == ("rgba(255, 255, 255, 1)" if scheme == "light" else "rgba(21, 24, 28, 1)")
        text = page.saved("grid")
        page.click("#download")
        page.click('#save-dialog [data-kind="svg"]')
        page.click('#save-dialog [data-kind="png"]')
        assert downloaded(tmp_path / "family.toml").decode() == text
        picture = downloaded(tmp_path / "family.svg").decode()
        assert picture.startswith("<svg") and 'fill="#ffffff"' in picture.split("<clipPath")[0]
        assert all(f">{volts} V</text>" in picture for volts in (50, 100, 150, 200, 250))
        assert downloaded(tmp_path / "family.png").startswith(b"\x89PNG")
        assert page.background() == background


# ---- the address ----


def test_the_address_keeps_the_design_and_the_back_button_undoes_a_step(page):
    page.give("wing_length", "19")
    page.rest()
    page.choose("measure", "power_mean_mw")
    page.click("#pin")
    rows = page.rows()
    page.reload()
    assert page.changed() == {"wing_length": "19"}
    assert page.rows() == rows
    assert page.value("#measure") == "power_mean_mw"
    assert page.texts("#pin-table thead th")[-1] == "now"
    page.give("wing_length", "20")
    page.rest()
    page.browser.back()
    page.wait(lambda: page.value("#p-wing_length") == "19")
    page.rest()
    page.browser.forward()
    page.wait(lambda: page.value("#p-wing_length") == "20")


def test_the_back_button_leaves_an_address_that_was_written_by_hand(page):
    page.give("wing_length", "19")
    page.rest()
    page.script("location.hash = arguments[0]", '{"design":{"wing_length":0.018}}')
    page.wait(lambda: page.value("#p-wing_length") == "18")
    page.rest()
    page.browser.back()
    page.wait(lambda: page.value("#p-wing_length") == "19")
    page.rest()


def test_lines_that_are_switched_off_stay_so(page):
    page.click("#chart .legend button")
    assert page.names() == ["100 V", "150 V", "200 V", "250 V"]
    page.reload()
    assert page.names() == ["100 V", "150 V", "200 V", "250 V"]
    assert page.find("#chart .legend button").get_attribute("aria-pressed") == "false"
    page.click("#reset-all")
    page.rest()
    assert page.find("#chart .legend button").get_attribute("aria-pressed") == "true"
    assert len(page.names()) == 5


def test_addresses_of_other_presets_and_nonsense(page, server):
    page.give("wing_length", "19")
    page.rest()
    address = page.browser.current_url
    assert "jafferis2016" in address
    page.open(address.replace("jafferis2016", "ozaki2018-large"))
    assert "preset ozaki2018-large" in page.text("#banner")
    page.click("#reset-all")
    page.rest()
    assert not page.find("#banner").is_displayed()
    nonsense = "%7B%22design%22%3A%7B%22no_such%22%3A1%2C%22wing_length%22%3A%7B%7D%7D%2C%22pins%22%3A7%7D"
    for text in (nonsense, "%"):
        page.open(f"{server.address}#{text}")
        assert page.changed() == {}


# ---- the panel and the keyboard ----


def test_search_and_reset(page):
    page.find("#search").send_keys("hinge stiff")
    shown = [row for row in page.find_all(".parameter") if row.is_displayed()]
    assert "hinge_stiffness" in [row.get_attribute("data-name") for row in shown]
    for row in shown:
        row.find_element(By.CSS_SELECTOR, "[aria-label^='Help']").click()
        text = " ".join([row.text, row.get_attribute("data-name")]).lower()
        group = row.find_element(By.XPATH, "..").get_attribute("data-group")
        assert all(word in f"{text} {group}" for word in ("hinge", "stiff")), text
    page.type("#search", "")
    page.give("wing_length", "19")
    page.give("air_density", "1")
    page.rest()
    page.row("wing_length").find_element(By.CSS_SELECTOR, "[aria-label^='Reset']").click()
    page.rest()
    assert page.changed() == {"air_density": "1"}
    page.click("#reset-all")
    page.rest()
    assert page.changed() == {}
    assert page.value("#p-air_density") == "1.2"
    assert len(page.find_all(".symbol sub")) > 5


def test_the_keyboard_alone_changes_and_pins_a_design(page):
    """Skip buttons come first and can be seen; a slider, the buttons, the chart and the help are in reach."""
    page.keys(Keys.TAB)
    assert page.focused().text == "To the chart"
    assert page.focused().size["width"] > 50
    page.keys(Keys.ENTER)
    assert "u-over" in page.focused().get_attribute("class")
    page.keys(Keys.ARROW_RIGHT)
    page.wait(lambda: "Lift, mean" in page.text("#tip"))
    page.reload()
    page.keys(Keys.TAB, Keys.TAB, Keys.ENTER)
    assert page.focused().get_attribute("id") == "measure"
    page.reload()
    names = []
    while len(names) < 12 and not (names and names[-1].endswith("slider")):
        page.keys(Keys.TAB)
        names.append(page.focused().get_attribute("aria-label") or page.focused().get_attribute("id"))
    assert names[-1].endswith("slider"), names
    page.keys(Keys.ARROW_LEFT, Keys.ARROW_LEFT)
    page.rest()
    assert len(page.changed()) == 1
    page.find("#pin").send_keys(Keys.ENTER)
    assert page.texts("#pin-table thead th")[-1] == "now"
    page.find("#reset-all").send_keys(Keys.ENTER)
    page.rest()
    assert page.changed() == {}
    page.find(".parameter [aria-label^=Help]").send_keys(Keys.ENTER)
    assert page.find(".parameter .help").is_displayed()


def test_every_field_has_a_name(page):
    nameless = page.script(
        """
        return [...document.querySelectorAll("input, select, button, canvas")].filter((part) =>
          !(part.getAttribute("aria-label") || part.textContent.trim() || part.labels?.length || part.closest(".u-wrap"))).map((part) => part.outerHTML)
        """
    )
    assert nameless == []


# ---- errors ----


def test_impossible_values_are_marked_and_the_page_stays(page):
    page.wait_for_motion()
    page.click("#pin")
    page.rest()
    rows, lift = page.rows(), page.number("lift_mean_mn")
    assert page.chart("chart.scene.marker").keys() == {"x", "y"}
    page.give("wing_length", "-3")
    page.wait(lambda: page.find("#p-wing_length").get_attribute("aria-invalid") == "true")
    message = page.problem("wing_length")
    assert "must be more than zero" in message
    for part in ("numbers", "motion"):
        page.wait(lambda: "old" in page.find(f"#{part}").get_attribute("class").split())
        assert "last possible design" in page.text(f"#{part} .old-note")
    assert page.property("body", "innerText").count(message) == 1
    assert page.rows() == rows and page.number("lift_mean_mn") == lift
    # The page does not show numbers of the earlier design beside the present design.
    page.wait(lambda: page.chart("chart.scene.marker") is None)
    assert set(page.texts("#pin-table tbody tr:not(:first-child) td:last-child")) == {"–"}
    # The picture keeps the names of its own axes.
    refused = page.resources()
    Select(page.find("#x")).select_by_value("wing_area")
    Select(page.find("#measure")).select_by_value("power_mean_mw")
    page.wait(lambda: any(name.endswith("/point") for name in page.resources()[len(refused) :]))
    time.sleep(0.1)
    assert page.chart("[chart.scene.x.label, chart.scene.y.label]") == ["Drive frequency", "Lift, mean"]
    page.give("wing_length", "3 cats")
    page.wait(lambda: "cats" in page.problem("wing_length"))
    page.give("wing_length", "0.019 m")
    page.rest()
    page.wait(lambda: not page.find_all(".old"))
    assert page.find("#p-wing_length").get_attribute("aria-invalid") is None
    assert not page.find("#banner").is_displayed()
    assert not page.find("#numbers .old-note").is_displayed()
    assert page.chart("[chart.scene.x.label, chart.scene.y.label]") == ["Wing area", "Power, mean"]
    assert page.text("#wing text").startswith("19 mm")


def test_an_ambiguous_comma_is_refused_with_words(page):
    page.give("wing_length", "1,400")
    assert "may be 1400 or 1.4" in page.problem("wing_length")
    assert page.changed() == {}
    page.give("wing_length", "18,5")
    page.rest()
    assert page.changed() == {"wing_length": "18.5"}
    assert page.problem("wing_length") == ""


def test_the_page_waits_for_its_server(browser):
    server = Server("jafferis2016")
    page = LivePage(browser).open(server.address)
    port = server.port
    server.stop()
    page.give("wing_length", "19")
    page.wait(lambda: page.find("#banner").is_displayed() and "server" in page.text("#banner"))
    assert len(page.names()) == 5
    server = Server("jafferis2016", port)
    try:
        page.wait(lambda: "address" in page.text("#banner") or not page.find("#banner").is_displayed())
        page.open(server.address + "#" + page.browser.current_url.split("#")[1])
        assert page.changed() == {"wing_length": "19"}
    finally:
        server.stop()
        browser.get_log("browser")


# ---- the window, other designs ----


def test_nothing_is_fetched_from_elsewhere(browser, server, tmp_path):
    page = LivePage(browser).open(server.address)
    page.downloads(tmp_path)
    page.click("#save")
    page.click('#save-dialog [data-kind="png"]')
    downloaded(tmp_path / "family.png")
    own = server.address.split("?")[0]
    names = [name for name in page.resources() if not name.startswith(f"blob:{own}")]
    assert names and all(name.startswith(own + "api/") for name in names), names
    parts = [part.get_attribute("src") or part.get_attribute("href") for part in page.find_all("[src], link[href]")]
    assert all(part.startswith("data:") for part in parts), parts


@pytest.mark.parametrize("width, height", [(1600, 1000), (1024, 768), (768, 1024), (375, 800)])
def test_the_page_fits_its_width(browser, server, width, height):
    with screen(browser, width, height):
        page = LivePage(browser).open(server.address)
        assert page.fits_width()
        assert page.box("#chart .chart-box")[2] > 0.4 * min(width, 900)
        outside = page.script(
            """
            return [...document.querySelectorAll(".parameter .unit, .number .value, .slope .name")].filter((part) =>
              part.offsetParent && part.scrollWidth > part.clientWidth + 1 && getComputedStyle(part).display !== "inline").map((part) => part.textContent)
            """
        )
        assert outside == []


def test_a_phone_keeps_the_chart_in_sight_and_zooms_with_two_fingers(browser, server):
    with screen(browser, 390, 844, mobile=True):
        page = LivePage(browser).open(server.address)
        page.show("air_density")
        page.script("arguments[0].scrollIntoView({ block: 'center' })", page.row("air_density"))
        _, top, _, height = page.box("#chart")
        assert -1 <= top and top + height < page.box("[data-name=air_density] input[type=range]")[1] < 844
        page.script("arguments[0].scrollIntoView({ block: 'start' })", page.find("#chart"))
        left, top, width, height = page.box("#chart .u-over")
        low, high = page.range("x")
        page.pinch(left + width / 2, top + height / 2)
        zoomed = page.range("x")
        assert zoomed[1] - zoomed[0] == pytest.approx((high - low) / 2, rel=0.05)


@pytest.mark.parametrize("preset", ["ozaki2018-large", "arabagi2013-75hz"])
def test_every_model_has_a_page(other, preset):
    page = other(preset)
    page.slider("wing_length").send_keys(*[Keys.ARROW_RIGHT] * 3)
    page.rest()
    assert list(page.changed()) == ["wing_length"]
    assert len(page.rows()[1]) == 5 * 81
    page.wait_for_motion()


def test_a_vehicle_has_a_page(other):
    page = other(ROOT / "examples/vehicle.toml")
    assert page.text("h1") == "vehicle.toml"
    shown = [row.get_attribute("data-name") for row in page.find_all("#main-numbers .number")]
    assert {"force_up_mn", "torque_roll_unm", "lift_to_weight"} <= set(shown)
    assert not page.find(".scene").is_displayed() and not page.find("#play").is_displayed()
    assert page.text("#motion-of").startswith("There is no single motion")
    # A value of [vehicle] cannot be removed: an empty field resets it.
    mass = page.value("#p-total_mass")
    page.give("total_mass", "95")
    page.rest()
    page.give("total_mass", "")
    page.rest()
    assert page.changed() == {} and page.value("#p-total_mass") == mass


def test_pictures_of_the_documentation_are_there_and_small():
    text = (ROOT / "docs/how-to/live.md").read_text(encoding="utf-8")
    names = {path.name for path in (ROOT / "docs/pictures").glob("live*")}
    assert names and all(f"](../pictures/{name})" in text for name in names)
    assert all((ROOT / "docs/pictures" / name).stat().st_size < 60_000 for name in names)
