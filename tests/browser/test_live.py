"""The page of `flap live` in a browser: sliders, rows, files, the address, the keyboard, errors."""

import json
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

# The picture, the numbers and the motion are those of the state.
AT_REST = """
return family.rested !== null && !family.isBusy
  && family.rested.text === JSON.stringify([state.design, state.x, state.by, state.measure, family.isUpDown])
  && numbers.design === JSON.stringify([state.design, state.measure])
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

    ready = AT_REST

    def row(self, name):
        return self.find(f'.parameter[data-name="{name}"]')

    def slider(self, name):
        self.script("panel.focus(arguments[0])", name)
        return self.row(name).find_element(By.CSS_SELECTOR, "input[type=range]")

    def give(self, name, text):
        """Types the value of a parameter."""
        self.script("panel.focus(arguments[0])", name)
        self.type(f"#p-{name}", text)

    def meaning(self, name):
        """What the search of the panel looks through."""
        return self.script("const { name, label, doc } = parameterOf.get(arguments[0]); return `${name} ${label} ${doc}`.toLowerCase()", name)

    def design(self):
        return self.script("return state.design")

    def rows(self):
        """Names of the columns, and the rows behind the picture."""
        return self.script("return [family.answer.columns, family.answer.rows]")

    def saved(self, kind):
        """The text of a kind in the dialog."""
        if not self.script("return byId('save-dialog').open"):
            self.click("#save")
        self.script("saving.text = ''")
        self.click(f'#save-dialog [data-kind="{kind}"]')
        self.wait("return saving.text !== ''")
        return self.script("return saving.text")

    def number(self, name):
        """A number of the design, as its cell shows it."""
        return self.text(f'#main-numbers [data-name="{name}"] .value')


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
            assert both_missing or a == b or (isinstance(b, float) and math.isinf(b) and a in (None, "inf")), (name, a, b)


# ---- sliders ----


def test_a_slider_moves_the_family_and_marks_its_parameter(page):
    before = page.rows()
    assert len(before[1]) == 5 * 81
    slider = page.slider("hinge_stiffness")
    slider.send_keys(*[Keys.ARROW_RIGHT] * 20)
    page.rest()
    assert page.rows()[1] != before[1]
    assert list(page.design()) == ["hinge_stiffness"]
    assert "changed" in page.row("hinge_stiffness").get_attribute("class")
    assert page.number("lift_mean_mn") != ""
    change = page.text('#main-numbers [data-name="lift_mean_mn"] .change')
    assert change.endswith("%") and change[0] in "+−"
    assert page.script("return family.ghost.length") == 5
    assert page.script("return performance.getEntriesByName('flap-slider-to-picture').length") > 0


def test_the_picture_ends_at_the_last_of_many_fast_steps(page):
    page.script("""
      window.drawn_widths = [];
      const slider = panel.rows.get("wing_length").slider, before = family.draw;
      family.draw = (answer, isFine) => { window.drawn_widths.push(answer.request.design.wing_length); before(answer, isFine); };
      window.step = 502;
      const move = () => {
        slider.value = window.step;
        slider.dispatchEvent(new Event("input", { bubbles: true }));
        window.step += 2;
        if (window.step <= 900) setTimeout(move, 2); else slider.dispatchEvent(new Event("change", { bubbles: true }));
      };
      move();
    """)
    page.wait("return window.step > 900")
    page.rest()
    last = page.design()["wing_length"]
    drawn = page.script("return window.drawn_widths")
    assert drawn == sorted(drawn)
    assert drawn[-1] == last
    assert len(drawn) < 200, "requests in between are left out"
    assert page.script("return family.answer.request.design.wing_length") == last


def test_a_measure_and_axes_are_chosen(page):
    Select(page.find("#measure")).select_by_value("stroke_amplitude_deg")
    page.rest()
    assert page.script("return family.chart.scene.y.label") == "Stroke, amplitude"
    Select(page.find("#x")).select_by_value("hinge_stiffness")
    page.rest()
    assert page.rows()[0][2] == "hinge_stiffness"
    page.type("#x-from", "1")
    page.type("#x-to", "3")
    page.rest()
    along = [row[2] for row in page.rows()[1]]
    assert (min(along), max(along)) == (pytest.approx(1e-6), pytest.approx(3e-6))
    page.type("#by-values", "100, 0.15 kV")
    page.rest()
    names = page.script("return family.lines.map((line) => line.name)")
    assert names == ["100 V", "150 V"]
    page.click("#log-x")
    page.click("#log-y")
    assert page.script("return family.chart.scene.x.log && family.chart.scene.y.log")


def test_points_without_a_motion_are_gaps(page):
    page.give("drive_voltage_pp", "1e5")
    page.type("#by-values", "100, 4000")
    page.rest()
    statuses = page.script("return family.answer.rows.map((row) => row[family.answer.columns.indexOf('status')])")
    gaps = page.script("return family.gaps.length")
    assert gaps == sum(status != "periodic" for status in statuses) > 0
    assert "no settled motion" in page.text("#tip")


def test_a_gap_under_the_pointer_tells_its_status(page):
    page.type("#by-values", "100, 4000")
    page.rest()
    page.script("""
      const gap = { x: family.lines[0].x[40], text: "unsettled", name: "100 V", row: { ...family.lines[0].rows[40], status: "unsettled" } };
      family.gaps = [gap, { ...gap, text: "step_limit", name: "4000 V" }];
      family.repaint();
    """)
    place = page.script("""
      const chart = family.chart, [{ at, lane }] = placedGaps(chart);
      return [at - chart.plot.over.clientWidth / 2, chart.plot.over.clientHeight / 2 - GAP_FOOT - lane * GAP_LANE];
    """)
    ActionChains(page.browser).move_to_element_with_offset(page.find("#chart .u-over"), *map(round, place)).perform()
    page.wait("return byId('tip').textContent.startsWith('No settled motion at')")
    assert page.text("#tip").endswith("100 V unsettled, 4000 V step limit")
    assert page.script("return [...document.querySelectorAll('#chart .statuses span')].map((entry) => entry.textContent)") == ["1 unsettled", "1 step limit"]


def test_logarithmic_axes_have_labels(page):
    page.click("#log-x")
    page.click("#log-y")
    for axis in (0, 1):
        labels = page.script("return family.chart.plot.axes[arguments[0]]._values", axis)
        assert len(labels) >= 4 and max(map(len, labels)) <= 7, labels


def test_small_charts_have_two_ticks_at_least(page):
    page.wait("return motion.charts.length >= 3")
    ticks = page.script("return motion.charts.map(({ plot }) => plot.axes[1]._splits.filter((tick) => tick >= plot.scales.y.min && tick <= plot.scales.y.max).length)")
    assert min(ticks) >= 2


def test_a_coarse_curve_says_so(page):
    page.script("family.draw(family.answer, false)")
    assert page.text("#tip").endswith("coarse, refining …")
    page.script("family.draw(family.answer, true)")
    assert "coarse" not in page.text("#tip")


def test_parameters_that_follow_others_can_be_set_and_unset(other):
    page = other("ozaki2018-large")
    assert "drive_voltage_pp" in page.find("#p-drive_bias").get_attribute("placeholder")
    page.give("drive_bias", "60")
    page.rest()
    assert page.design() == {"drive_bias": 60}
    page.type("#p-drive_bias", "")
    page.give("drive_bias", Keys.BACKSPACE)
    page.rest()
    assert page.design() == {}


# ---- what is shown is what the sweep gives ----


def test_the_saved_grid_gives_the_rows_shown(page, tmp_path):
    page.give("wing_length", "18")
    Select(page.find("#p-drive_shape")).select_by_value("square")
    page.type("#by-values", "120, 180")
    page.rest()
    shown = page.rows()
    grid = tmp_path / "family.toml"
    grid.write_text(page.saved("grid"), encoding="utf-8")
    command("check", grid)
    command("sweep", grid, "--out", tmp_path / "rows.csv")
    assert_same(shown, rows_of(tmp_path / "rows.csv"))


def test_the_saved_device_and_line_have_the_design(page, tmp_path):
    page.give("wing_length", "18")
    page.rest()
    shown = page.number("lift_mean_mn")
    device = tmp_path / "design.toml"
    device.write_text(page.saved("device"), encoding="utf-8")
    ended = command("run", device).stdout
    value = next(line.split()[1] for line in ended.splitlines() if line.split()[:1] == ["lift_mean_mn"])
    assert float(value) == pytest.approx(float(shown.split()[0]), rel=1e-4)

    line = page.saved("python")
    compile(line, "family.py", "exec")
    assert "0.018" in line and "flapwing.sweep" in line
    flapwing = pytest.importorskip("flapwing", exc_type=ImportError)
    assert flapwing is not None
    found = {}
    exec(line, found)  # the line that the page offers
    assert len(found["table"]) == 5 * 81


def test_files_and_pictures_are_downloaded(page, tmp_path):
    page.downloads(tmp_path)
    text = page.saved("grid")
    page.click("#download")
    page.click('#save-dialog [data-kind="svg"]')
    page.click('#save-dialog [data-kind="png"]')
    assert downloaded(tmp_path / "family.toml").decode() == text
    assert downloaded(tmp_path / "family.svg").startswith(b"<svg")
    assert downloaded(tmp_path / "family.png").startswith(b"\x89PNG")


# ---- the address ----


def test_a_reload_keeps_the_design(page):
    page.give("wing_length", "19")
    Select(page.find("#measure")).select_by_value("power_mean_mw")
    page.rest()
    page.click("#pin")
    rows = page.rows()
    page.browser.refresh()
    page.rest()
    assert page.design() == {"wing_length": 0.019}
    assert page.rows() == rows
    assert page.script("return state.measure") == "power_mean_mw"
    assert page.script("return state.pins.length") == 1


def test_the_address_holds_up_and_down_and_lines_switched_off(page):
    page.click("#chart .legend button")
    assert page.script("return family.chart.plot.series.filter(({ show }) => show === false).length") == 1
    page.browser.refresh()
    page.rest()
    assert page.script("return state.hidden.length") == 1
    assert page.find("#chart .legend button").get_attribute("aria-pressed") == "false"
    page.click("#reset-all")
    page.rest()
    assert page.find("#chart .legend button").get_attribute("aria-pressed") == "true"
    page.click("#hysteresis")
    page.rest()
    page.browser.refresh()
    page.rest()
    assert page.find("#hysteresis").get_attribute("aria-pressed") == "true"
    assert page.script("return family.lines.map((line) => line.key)") == ["up", "down"]
    asked = page.script("""
      const asked = [], before = server.ask;
      server.ask = (kind, body) => { asked.push([kind, body]); return { name: "x", text: "y" }; };
      saving.ask("grid");
      server.ask = before;
      return asked;
    """)
    assert asked[0][0] == "save" and asked[0][1]["updown"] is True and "by" not in asked[0][1]


def test_an_address_of_another_preset_says_so(page, server):
    page.give("wing_length", "19")
    page.rest()
    text = page.script("return location.hash")
    assert "jafferis2016" in text
    page.open(server.address + text.replace("jafferis2016", "ozaki2018-large"))
    assert "preset ozaki2018-large" in page.text("#banner")
    page.click("#reset-all")
    page.rest()
    assert not page.find("#banner").is_displayed()


def test_the_back_button_undoes_a_step(page):
    page.give("wing_length", "19")
    page.rest()
    page.give("wing_length", "20")
    page.rest()
    page.browser.back()
    page.wait("return state.design.wing_length === 0.019")
    page.rest()
    assert page.find("#p-wing_length").get_attribute("value") == "19"
    page.browser.forward()
    page.wait("return state.design.wing_length === 0.02")


def test_an_address_with_nonsense_opens_the_page(page, server):
    page.open(server.address + "#%7B%22design%22%3A%7B%22no_such%22%3A1%2C%22wing_length%22%3A%7B%7D%7D%2C%22pins%22%3A7%7D")
    assert page.design() == {}
    page.open(server.address + "#%")
    assert page.design() == {}


# ---- the panel ----


def test_search_and_reset(page):
    page.find("#search").send_keys("hinge stiff")
    shown = page.script("return [...document.querySelectorAll('.parameter')].filter((row) => row.offsetParent).map((row) => row.dataset.name)")
    assert "hinge_stiffness" in shown
    assert all({"hinge", "stiff"} <= {word for word in ("hinge", "stiff") if word in meaning} for meaning in map(page.meaning, shown))
    page.type("#search", "")
    page.give("wing_length", "19")
    page.give("air_density", "1")
    page.rest()
    page.row("wing_length").find_element(By.CSS_SELECTOR, "[aria-label^='Reset']").click()
    page.rest()
    assert page.design() == {"air_density": 1}
    page.click("#reset-all")
    page.rest()
    assert page.design() == {}
    assert page.find("#p-air_density").get_attribute("value") == "1.2"


def test_the_keyboard_alone_changes_and_pins_a_design(page):
    names = []
    for _ in range(12):
        ActionChains(page.browser).send_keys(Keys.TAB).perform()
        names.append(page.script("return document.activeElement.getAttribute('aria-label') ?? document.activeElement.id"))
        if names[-1].endswith("slider"):
            break
    assert names[-1].endswith("slider"), names
    ActionChains(page.browser).send_keys(Keys.ARROW_LEFT, Keys.ARROW_LEFT).perform()
    page.rest()
    assert len(page.design()) == 1
    for label, expected in [("#pin", "return state.pins.length === 1"), ("#reset-all", "return Object.keys(state.design).length === 0")]:
        page.script("document.querySelector(arguments[0]).focus()", label)
        ActionChains(page.browser).send_keys(Keys.ENTER).perform()
        page.wait(expected)
    page.script("document.querySelector('#chart .u-over').focus()")
    ActionChains(page.browser).send_keys(Keys.ARROW_RIGHT).perform()
    page.wait("return byId('tip').textContent.includes('Lift, mean')")
    page.script("document.querySelector('.parameter [aria-label^=Help]').focus()")
    ActionChains(page.browser).send_keys(Keys.ENTER).perform()
    assert page.script("return !document.querySelector('.parameter .help').hidden")


def test_skip_buttons_come_first(page):
    for label, expected in [("To the chart", "return document.activeElement.classList.contains('u-over')"), ("To the measure", "return document.activeElement.id === 'measure'")]:
        page.script("document.activeElement.blur(); getSelection().removeAllRanges(); scrollTo(0, 0)")
        names = page.script("return [...document.querySelectorAll('button, input, select, a')].slice(0, 3).map((part) => part.textContent)")
        assert names == ["To the chart", "To the measure", "To the numbers"]
        page.script("[...document.querySelectorAll('.skip button')].find((button) => button.textContent === arguments[0]).focus()", label)
        assert page.script("return document.activeElement.getBoundingClientRect().width > 50"), "seen while it has the keyboard"
        ActionChains(page.browser).send_keys(Keys.ENTER).perform()
        assert page.script(expected)


def test_symbols_are_printed_with_subscripts(page):
    html = page.script("return ['kappa_wh', 'I_zz', 'tan delta', 'f_31,max', 'R'].map((text) => symbolOf(text).innerHTML)")
    assert html == ["κ<sub>wh</sub>", "I<sub>zz</sub>", "tan δ", "f<sub>31,max</sub>", "R"]
    assert page.script("return document.querySelectorAll('.symbol sub').length") > 5


def test_natural_frequencies_show_their_difference(page):
    page.script("""
      const [mode] = numbers.answer.modes;
      numbers.answer.published_modes = [{ name: mode.name, frequency_hz: mode.frequency_hz / 1.1 }];
      numbers.show(true);
      window.modeName = mode.name;
    """)
    assert page.text(f"#main-numbers [data-name='{page.script('return window.modeName')}'] .change") == "+10 %"


def test_every_field_has_a_name(page):
    nameless = page.script("""
      return [...document.querySelectorAll("input, select, button, canvas")].filter((part) =>
        !(part.getAttribute("aria-label") || part.textContent.trim() || part.labels?.length || part.closest(".u-wrap"))).map((part) => part.outerHTML)
    """)
    assert nameless == []


def test_a_bar_leads_to_its_parameter(page):
    bars = page.browser.find_elements(By.CSS_SELECTOR, "#gradient .slope")
    assert len(bars) == 10
    sizes = page.script("return numbers.answer.gradient.slice(0, 10).map((slope) => Math.abs(slope.per_percent))")
    assert sizes == sorted(sizes, reverse=True)
    bars[0].click()
    name = page.script("return numbers.answer.gradient[0].parameter")
    assert page.script("return document.activeElement.closest('.parameter').dataset.name") == name


# ---- motion, hysteresis, pins ----


def test_the_motion_is_that_of_the_point_under_the_pointer(page):
    page.wait("return motion.signals !== null && motion.signals !== undefined")
    assert page.text("#motion-of") == "of the design"
    before = page.script("return motion.signals.stroke_deg")
    place = page.script("""
      const line = family.lines[4], i = 20, plot = family.chart.plot;
      return [plot.valToPos(line.x[i], "x") - plot.over.clientWidth / 2, plot.valToPos(line.y[i], "y") - plot.over.clientHeight / 2]
    """)
    over = page.find("#chart .u-over")
    ActionChains(page.browser).move_to_element_with_offset(over, *map(round, place)).perform()
    page.wait("return byId('motion-of').textContent.includes('250 V')")
    assert page.script("return motion.signals.stroke_deg") != before
    assert page.script("return motion.design.drive_voltage_pp") == 250
    ActionChains(page.browser).move_to_element(page.find("h1")).perform()
    page.wait("return byId('motion-of').textContent === 'of the design'")


def test_the_wing_stands_still_and_goes_on(page):
    page.wait("return motion.signals !== null && motion.signals !== undefined")
    page.click("#play")
    still = page.script("return motion.share")
    time.sleep(0.2)
    assert page.script("return motion.share") == still
    page.click("#play")
    page.wait("return motion.share !== arguments[0]", still)


def test_reduced_motion_is_respected(browser, server):
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-reduced-motion", "value": "reduce"}]})
    try:
        page = LivePage(browser).open(server.address)
        assert page.text("#play") == "Play"
        assert page.script("return motion.share") == 0
    finally:
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})


def test_up_and_down_of_a_bistable_design(other, tmp_path):
    grid = tmp_path / "soft.toml"
    grid.write_text(BISTABLE, encoding="utf-8")
    page = other(grid)
    page.click("#hysteresis")
    page.rest()
    assert page.script("return family.lines.map((line) => line.key)") == ["up", "down"]
    bands = page.script("return family.bands")
    assert len(bands) == 1
    assert 123 < bands[0]["from"] < bands[0]["to"] < 129
    assert "Two motions" in page.text("#tip")
    # The bands are those of the motions: a measure that is the same on both ways has them too.
    same = "return bistable((state.measure = 'field_max_v_per_um', linesOf(family.answer).lines))"
    measure = page.script("return state.measure")
    assert page.script(same) == bands
    page.script("state.measure = arguments[0]", measure)
    page.click("#hysteresis")
    page.rest()
    assert page.script("return family.bands") == []


def test_typed_numbers_keep_their_digits(page):
    numbers = "return [inSI(156, 1000), inSI(0.7, 1e3), inSI(55, 1e6), inSI(1.1, 1e9)]"
    assert page.script(numbers) == [0.156, 0.0007, 5.5e-5, 1.1e-9]


def test_a_value_far_from_the_preset_has_a_warning(page):
    page.give("drive_voltage_pp", "200160")
    page.rest()
    assert "times the preset's" in page.text("#banner")
    page.give("drive_voltage_pp", "60")
    page.rest()
    assert "times the preset's" not in page.text("#banner")


def test_pins_stand_side_by_side(page):
    page.give("wing_length", "19")
    page.rest()
    page.click("#pin")
    page.give("wing_length", "15")
    page.rest()
    page.click("#pin")
    page.wait("return document.querySelectorAll('#pin-table thead th').length === 4")
    page.wait("return ![...document.querySelectorAll('#pin-table tbody tr')].some((row) => row.textContent.includes('–'))")
    first = page.script("return [...document.querySelectorAll('#pin-table tbody tr')][0].innerText")
    assert "19 mm" in first and "15 mm" in first
    page.click("#pin-table [aria-label='restore A']")
    page.rest()
    assert page.design() == {"wing_length": 0.019}
    page.click("#pin-table [aria-label='remove A']")
    page.wait("return state.pins.length === 1 && state.pins[0].name === 'B'")


# ---- errors ----


def test_impossible_values_are_marked_and_the_picture_stays(page):
    rows = page.rows()
    page.give("wing_length", "-3")
    page.wait("return byId('p-wing_length').getAttribute('aria-invalid') === 'true'")
    problem = page.row("wing_length").find_element(By.CSS_SELECTOR, ".problem")
    assert "must be more than zero" in problem.text
    assert page.rows() == rows
    page.give("wing_length", "3 cats")
    page.wait("return document.querySelector('.parameter[data-name=wing_length] .problem').textContent.includes('cats')")
    page.give("wing_length", "0.019 m")
    page.rest()
    assert page.script("return byId('p-wing_length').getAttribute('aria-invalid')") is None
    assert page.script("return byId('banner').hidden")


def test_numbers_and_motion_of_an_earlier_design_are_marked(page):
    page.wait("return motion.signals !== null && motion.signals !== undefined")
    before = page.number("lift_mean_mn")
    page.give("wing_length", "-3")
    for part in ("numbers", "motion"):
        page.wait("return byId(arguments[0]).classList.contains('old')", part)
        assert "last possible design" in page.text(f"#{part} .old-note")
    assert page.number("lift_mean_mn") == before
    message = page.row("wing_length").find_element(By.CSS_SELECTOR, ".problem").text
    assert page.script("return document.body.innerText").count(message) == 1
    page.give("wing_length", "19")
    page.rest()
    page.wait("return !document.querySelector('.old')")
    assert not page.find("#numbers .old-note").is_displayed()


def test_an_ambiguous_comma_is_refused_with_words(page):
    page.give("wing_length", "1,400")
    problem = page.row("wing_length").find_element(By.CSS_SELECTOR, ".problem")
    assert "may be 1400 or 1.4" in problem.text
    assert page.design() == {}
    page.give("wing_length", "18,5")
    page.rest()
    assert page.design() == {"wing_length": pytest.approx(0.0185)}
    assert not problem.is_displayed()


def test_ends_of_the_axis_are_typed_with_units_or_refused_with_words(page):
    page.type("#x-from", "0.1 kHz")
    page.rest()
    assert page.script("return state.x.from") == pytest.approx(100)
    for text, words in [("1,400", "may be 1400 or 1.4"), ("5 cats", "is not a unit"), ("many", "number"), (page.find("#x-to").get_attribute("value"), "must differ")]:
        page.type("#x-from", text)
        assert words in page.text("#x-problem"), text
        assert page.script("return state.x.from") == pytest.approx(100)
    page.type("#x-from", "")
    assert page.find("#x-from").get_attribute("value") == "100"
    assert not page.find("#x-problem").is_displayed()


def test_the_page_waits_for_its_server(browser):
    server = Server("jafferis2016")
    page = LivePage(browser).open(server.address)
    port = server.port
    server.stop()
    page.give("wing_length", "19")
    page.wait("return !byId('banner').hidden && byId('banner').textContent.includes('server')")
    assert page.script("return family.lines.length") == 5
    server = Server("jafferis2016", port)
    try:
        page.wait("return byId('banner').textContent.includes('address') || byId('banner').hidden")
        page.open(server.address + "#" + page.script("return location.hash.slice(1)"))
        assert page.design() == {"wing_length": 0.019}
    finally:
        server.stop()
        browser.get_log("browser")


def test_nothing_is_fetched_from_elsewhere(browser, server):
    page = LivePage(browser).open(server.address)
    page.script("family.chart.png()")
    names = page.script("return performance.getEntriesByType('resource').map((entry) => entry.name)")
    own = server.address.split("?")[0]
    assert names and all(name.startswith(own + "api/") for name in names), names
    assert "http" not in json.dumps(page.script("return [...document.querySelectorAll('[src],link[href]')].map((part) => part.src || part.href)")).replace(own, "")


@pytest.mark.parametrize("width, height", [(1600, 1000), (1024, 768), (768, 1024), (375, 800)])
def test_the_page_fits_its_width(browser, server, width, height):
    with screen(browser, width, height):
        page = LivePage(browser).open(server.address)
        assert page.script("return document.documentElement.scrollWidth <= innerWidth")
        assert page.script("return family.chart.plot.width > 0.4 * Math.min(innerWidth, 900)")
        outside = page.script("""
          return [...document.querySelectorAll(".parameter .unit, .number .value, .slope .name")].filter((part) =>
            part.offsetParent && part.scrollWidth > part.clientWidth + 1 && getComputedStyle(part).display !== "inline").map((part) => part.textContent)
        """)
        assert outside == []


def test_the_chart_stays_in_sight_on_a_phone(browser, server):
    with screen(browser, 390, 844, mobile=True):
        page = LivePage(browser).open(server.address)
        page.script("panel.rows.get('air_density').row.closest('details').open = true; panel.rows.get('air_density').row.scrollIntoView({ block: 'center' })")
        top, bottom = page.script("const { top, bottom } = byId('chart').getBoundingClientRect(); return [top, bottom]")
        field = page.script("return panel.rows.get('air_density').slider.getBoundingClientRect().top")
        assert -1 <= top and bottom < field < 844


def test_two_fingers_zoom_the_chart(browser, server):
    with screen(browser, 390, 844, mobile=True):
        page = LivePage(browser).open(server.address)
        page.script("byId('chart').scrollIntoView({ block: 'start' })")
        x, y, low, high = page.script("""
          const { left, top, width, height } = document.querySelector("#chart .u-over").getBoundingClientRect(), { min, max } = family.chart.plot.scales.x;
          return [left + width / 2, top + height / 2, min, max];
        """)
        page.fingers("touchStart", (x - 30, y), (x + 30, y))
        page.fingers("touchMove", (x - 60, y), (x + 60, y))
        page.fingers("touchEnd")
        zoomed = page.script("return state.view.x")
        assert zoomed[1] - zoomed[0] == pytest.approx((high - low) / 2, rel=0.05)


@pytest.mark.parametrize("preset", ["ozaki2018-large", "arabagi2013-75hz"])
def test_every_model_has_a_page(other, preset):
    page = other(preset)
    page.slider("wing_length").send_keys(*[Keys.ARROW_RIGHT] * 3)
    page.rest()
    assert list(page.design()) == ["wing_length"]
    assert len(page.rows()[1]) == 5 * 81
    page.wait("return motion.signals !== null && motion.signals !== undefined && motion.charts.length >= 3")


def test_a_vehicle_has_a_page(other):
    page = other(ROOT / "examples/vehicle.toml")
    assert page.text("h1") == "vehicle.toml"
    shown = page.script("return [...document.querySelectorAll('#main-numbers .number')].map((row) => row.dataset.name)")
    assert {"force_up_mn", "torque_roll_unm", "lift_to_weight"} <= set(shown)
    assert not page.find(".scene").is_displayed() and not page.find("#play").is_displayed()
    assert page.find("#motion-of").text.startswith("There is no single motion")


def test_pictures_of_a_dark_page_are_light(browser, server):
    with screen(browser, 1600, 1000, "dark"):
        page = LivePage(browser).open(server.address)
        dark = page.script("return getComputedStyle(document.body).backgroundColor")
        svg = browser.execute_async_script("family.chart.svg().then(arguments[0])")
        assert 'fill="#ffffff"' in svg.split("<clipPath")[0]
        assert all(f">{volts} V</text>" in svg for volts in (50, 100, 150, 200, 250))
        assert page.script("return getComputedStyle(document.body).backgroundColor") == dark != "rgb(255, 255, 255)"


def test_pictures_of_the_documentation_are_there_and_small():
    text = (ROOT / "docs/live.md").read_text(encoding="utf-8")
    names = {path.name for path in (ROOT / "docs/pictures").glob("live*")}
    assert names and all(f"](pictures/{name})" in text for name in names)
    assert all((ROOT / "docs/pictures" / name).stat().st_size < 60_000 for name in names)
