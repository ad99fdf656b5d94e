"""The page of `flap plot --html` in a browser: zoom, axes, views, filters, the legend, files, the address, phones."""

import base64
import csv
import io
import json
import math
import struct
import xml.etree.ElementTree as ElementTree
import zlib

import pytest
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.select import Select
from support import Page, command, contrast, downloaded, rows_of, screen

# 7 voltages, 21 frequencies and 2 hinges of a device that settles everywhere.
SETTLED = """\
preset = "ozaki2018-large"
[axes]
drive_voltage_pp = { from = "40 V", to = "100 V", step = "10 V" }
drive_frequency = { from = "60 Hz", to = "200 Hz", step = "7 Hz" }
hinge_stiffness = ["90 uN*m/rad", "110 uN*m/rad"]
"""

# Statuses of two kinds: impossible parameters, and too few periods to settle.
UNSETTLED = """\
preset = "jafferis2016"
[solver]
max_cycles = 60
[axes]
drive_voltage_pp = [100, 200, 1500, 4000]
drive_frequency = { from = "60 Hz", to = "200 Hz", step = "10 Hz" }
"""

# A line for each of 80 voltages.
MANY = """\
preset = "ozaki2018-large"
[axes]
drive_voltage_pp = { from = "21 V", to = "100 V", step = "1 V" }
drive_frequency = { from = "95 Hz", to = "110 Hz", step = "5 Hz" }
"""

LOOP = ["--set", "hinge_stiffness=0.7486 uN*m/rad", "--set", "drive_voltage_pp=160 V", "--from", "118 Hz", "--to", "132 Hz", "--step", "1 Hz", "--unstable"]


class Results(Page):
    """A page of results."""

    ready = "return charts.length === 2 && charts[0].plot !== null"

    def choose(self, name, column):
        """Chooses a column, by its name, or a word of a menu."""
        menu = Select(self.find(f"#{name}"))
        place = self.script("return placeOf.get(arguments[0])", column)
        menu.select_by_value(column if place is None else str(place))

    def view(self, number=0):
        return self.script("return shown.views[arguments[0]]", number)

    def range(self, axis, number=0):
        """What an axis shows."""
        return self.script("const { min, max } = charts[arguments[1]].plot.scales[arguments[0]]; return [min, max]", axis, number)

    def labels(self, axis, number=0):
        """The labels that an axis has drawn."""
        return self.script("return charts[arguments[1]].plot.axes[arguments[0]]._values", 0 if axis == "x" else 1, number)

    def drag(self, begin, end, number=0, shift=False):
        """Drags over a picture, between shares of its width and height from the top left."""
        over = self.find(f"#chart-{number} .u-over")
        size = over.size
        offsets = [(round((x - 0.5) * size["width"]), round((y - 0.5) * size["height"])) for x, y in (begin, end)]
        actions = ActionChains(self.browser)
        if shift:
            actions.key_down(Keys.SHIFT)
        actions.move_to_element_with_offset(over, *offsets[0]).click_and_hold().move_to_element_with_offset(over, *offsets[1]).release()
        if shift:
            actions.key_up(Keys.SHIFT)
        actions.perform()

    def keys(self, *keys, number=0):
        self.script("document.querySelector(arguments[0]).focus()", f"#chart-{number} .u-over")
        ActionChains(self.browser).send_keys(*keys).perform()


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    """Makes the page of a grid once: its address and the file of its rows."""
    folder, made = tmp_path_factory.mktemp("results"), {}

    def page(name, grid, *wishes):
        if (name, wishes) not in made:
            rows, page = folder / f"{name}.csv", folder / f"{name}-{len(made)}.html"
            if not rows.exists():
                (folder / f"{name}.toml").write_text(grid, encoding="utf-8")
                command("sweep", folder / f"{name}.toml", "--out", rows)
            command("plot", rows, "--html", page, *wishes)
            made[name, wishes] = page.as_uri(), rows
        return made[name, wishes]

    return page


@pytest.fixture
def open_page(browser, pages):
    """Opens the page of a grid; its console must stay empty."""
    browser.get_log("browser")

    def opened(name, grid, *wishes):
        address, rows = pages(name, grid, *wishes)
        page = Results(browser).open(address)
        page.rows = rows
        return page

    yield opened
    assert [entry["message"] for entry in browser.get_log("browser")] == []


@pytest.fixture
def page(open_page):
    return open_page("settled", SETTLED)


@pytest.fixture
def loop(browser, tmp_path_factory):
    """The page of a response with an unstable branch."""
    folder = tmp_path_factory.mktemp("loop")
    command("respond", "jafferis2016", *LOOP, "--out", folder / "loop.csv")
    command("plot", folder / "loop.csv", "--html", folder / "loop.html")
    return Results(browser).open((folder / "loop.html").as_uri())


# ---- zoom, movement and axes ----


def test_a_drag_zooms_and_a_double_click_shows_everything(page):
    whole = page.range("x")
    page.drag((0.25, 0.5), (0.5, 0.5))
    low, high = page.range("x")
    width = whole[1] - whole[0]
    assert low == pytest.approx(whole[0] + 0.25 * width, abs=0.02 * width)
    assert high == pytest.approx(whole[0] + 0.5 * width, abs=0.02 * width)
    ActionChains(page.browser).double_click(page.find("#chart-0 .u-over")).perform()
    assert page.range("x") == whole


def test_shift_and_drag_moves_and_the_wheel_zooms(page):
    whole = page.range("x")
    page.drag((0.5, 0.5), (0.25, 0.5), shift=True)
    moved, width = page.range("x"), whole[1] - whole[0]
    assert moved[0] == pytest.approx(whole[0] + 0.25 * width, abs=0.02 * width)
    assert moved[1] - moved[0] == pytest.approx(width, rel=0.01)
    page.script("""
      const over = document.querySelector("#chart-0 .u-over"), box = over.getBoundingClientRect();
      over.dispatchEvent(new WheelEvent("wheel", { deltaY: -100, ctrlKey: true, clientX: box.left + box.width / 2, clientY: box.top + 9, cancelable: true }));
    """)
    zoomed = page.range("x")
    assert zoomed[1] - zoomed[0] == pytest.approx(width / 1.2, rel=0.01)


def test_logarithmic_axes_have_labels(page):
    page.click("#log-x")
    page.click("#log-y")
    assert page.script("return charts[0].plot.scales.x.distr") == 3
    for axis in ("x", "y"):
        labels = page.labels(axis)
        assert len(labels) >= 4, labels
        assert all(len(label.replace(".", "").lstrip("0")) <= 4 for label in labels), labels
    page.choose("kind", "map")
    page.script("for (const axis of ['x', 'y']) if (!byId(`log-${axis}`).checked) byId(`log-${axis}`).click()")
    assert page.script("return charts[0].scene.cells.i.length") == 7 * 21
    assert all(len(page.labels(axis)) >= 4 for axis in ("x", "y")), [page.labels(axis) for axis in ("x", "y")]


def test_ticks_of_all_sizes(page):
    cases = page.script("""
      const ranges = [[60, 200], [72, 168], [2.02651e-4, 0.02], [1e-9, 1e9], [3, 31], [0.98, 1.01], [1e5, 3e7]];
      return ranges.map(([low, high]) => [low, high, tickLabels(logTicks(low, high, 8)), logTicks(low, high, 8)]);
    """)
    for low, high, labels, ticks in cases:
        assert 3 <= len(ticks) <= 10, (low, high, labels)
        assert all(low <= tick <= high for tick in ticks), (low, high, ticks)
        assert len(set(labels)) == len(labels) and max(map(len, labels)) <= 7, labels
    assert page.script("return tickLabels(evenTicks(100.01, 100.05, 4))") == ["100.01", "100.02", "100.03", "100.04", "100.05"]
    for low, high in [(0.9, 1.1), (-1, 1), (0, 7e-4), (99, 100.3)]:
        assert len(page.script("return evenTicks(arguments[0], arguments[1], 2)", low, high)) >= 2


# ---- two views ----


def test_rows_selected_in_one_view_are_those_of_the_other(page):
    page.click("#two")
    assert page.find("#chart-1").is_displayed()
    page.choose("x", "power_mean_mw")
    page.choose("y", "lift_mean_mn")
    assert page.view(1)["x"] == page.script("return placeOf.get('power_mean_mw')")
    page.click("#drag")
    page.drag((0.02, 0.02), (0.4, 0.98), number=0)
    selected = set(page.script("return [...shown.selected]"))
    assert len(selected) > 10
    assert set(page.script("return [...charts[1].selectedRows]")) == selected
    assert page.text("#rows-title").startswith(f"{len(selected)} selected rows")
    assert page.script("return document.querySelectorAll('#table tbody tr').length") == min(len(selected), 100)


def test_a_sentence_about_both_views_is_said_once(page):
    page.click("#two")
    for number in (0, 1):
        page.click(f"#view-{number}")
        page.choose("kind", "line")
        page.choose("by", "")
    page.script("shown.filters.push({ place: placeOf.get('drive_frequency'), low: 1, high: 2 }); refresh(false)")
    parts = page.text("#status").split(" · ")
    assert "no row has both values: nothing is drawn" in parts
    assert len(set(parts)) == len(parts)


# ---- filters ----


def test_bounds_of_a_filter_are_typed_and_do_not_cross(page):
    page.click("#add")
    page.script("const select = document.querySelector('.filter select'); select.value = placeOf.get('drive_frequency'); select.onchange()")
    low, high = ".filter .bounds input:first-child", ".filter .bounds input:last-child"
    page.type(low, "0.1 kHz")
    assert page.find(low).get_attribute("value") == "100"
    page.type(high, "150")
    kept = page.script("return Array.from(shown.rows, (row) => columns[placeOf.get('drive_frequency')].cells[row])")
    assert 100 <= min(kept) and max(kept) <= 150
    page.type(low, "180")
    assert page.find(low).get_attribute("value") == "150"
    page.type(high, "90 Hz")
    assert page.find(high).get_attribute("value") == "150"
    page.type(low, "99,5")
    assert page.find(low).get_attribute("value") == "99.5"


@pytest.mark.parametrize("text, words", [("1,400", "may be 1400 or 1.4"), ("5 cats", "is not a unit"), ("much", "does not begin with a number")])
def test_a_bound_that_is_not_understood_is_refused_with_words(page, text, words):
    page.click("#add")
    before = page.script("return shown.filters[0].low")
    page.type(".filter .bounds input:first-child", text)
    assert words in page.text(".filter .problem")
    assert page.find(".filter .bounds input").get_attribute("aria-invalid") == "true"
    assert page.script("return shown.filters[0].low") == before
    page.type(".filter .bounds input:first-child", "")
    assert not page.find(".filter .problem").is_displayed()
    assert page.find(".filter .bounds input").get_attribute("value") != ""


def test_sliders_of_a_filter_stop_at_each_other(page):
    page.click("#add")
    place = "document.querySelectorAll('.filter input[type=range]')[arguments[0]]"
    move = f"const slider = {place}; slider.value = arguments[1]; slider.oninput()"
    page.script(move, 0, 600)
    page.script(move, 1, 300)
    low, high = page.script("const { low, high } = shown.filters[0]; return [low, high]")
    assert low == high
    assert page.script(f"return {place}.value", 1) == page.script(f"return {place}.value", 0)


# ---- the legend ----


def test_the_legend_switches_lines(page):
    button = page.find("#chart-0 .legend button")
    assert button.text == "40 V"
    button.click()
    assert page.script("return charts[0].plot.series[1].show") is False
    assert page.find("#chart-0 .legend button").get_attribute("aria-pressed") == "false"
    page.browser.refresh()
    page.rest()
    assert page.script("return charts[0].plot.series[1].show") is False
    page.click("#chart-0 .legend button")
    assert page.script("return charts[0].plot.series[1].show") is True
    page.browser.back()
    page.wait("return charts[0].plot.series[1].show === false")


def test_a_line_that_is_switched_off_comes_back(loop):
    loop.script("[...document.querySelectorAll('#chart-0 .legend button')].find((button) => button.textContent === 'up').click()")
    assert loop.script("return charts[0].plot.series.slice(1).filter(({ show }) => !show).length") == 1
    loop.choose("by", "")
    assert loop.script("return charts[0].plot.series.slice(1).every(({ show }) => show)")
    loop.script("[...document.querySelectorAll('#chart-0 .legend button')][0].click()")
    assert loop.script("return charts[0].plot.series.slice(1).some(({ show }) => !show)")
    loop.click("#reset")
    assert loop.script("return charts[0].plot.series.slice(1).every(({ show }) => show)")


def test_statuses_stand_apart_in_the_legend_and_at_the_foot(open_page):
    page = open_page("unsettled", UNSETTLED, "--y", "lift_mean_mn")
    counts = page.script("return [...document.querySelectorAll('#chart-0 .statuses span')].map((entry) => entry.textContent)")
    names, rows = rows_of(page.rows)
    statuses = [row[names.index("status")] for row in rows]
    assert counts == [f"{statuses.count('unsettled')} unsettled"]
    texts = page.script("return [...document.querySelector('#chart-0 .legend').children].map((entry) => entry.textContent)")
    assert texts[0] == "Drive voltage, peak to peak:"
    assert texts[1:5] == ["100 V", "200 V", "1500 V", "4000 V"]
    assert texts[5:] == counts
    gap = page.script("""
      const chart = charts[0], [{ gap, at, lane }] = placedGaps(chart);
      return [gap.row, at - chart.plot.over.clientWidth / 2, chart.plot.over.clientHeight / 2 - GAP_FOOT - lane * GAP_LANE];
    """)
    ActionChains(page.browser).move_to_element_with_offset(page.find("#chart-0 .u-over"), round(gap[1]), round(gap[2])).perform()
    page.wait("return !byId('tip').hidden")
    assert "unsettled" in page.text("#tip")
    assert page.script("return shown.hover") == gap[0]


def test_a_filter_that_is_wide_open_leaves_out_nothing(open_page):
    page = open_page("unsettled", UNSETTLED, "--y", "lift_mean_mn")
    page.click("#add")
    page.script("const select = document.querySelector('.filter select'); select.value = placeOf.get('lift_mean_mn'); select.onchange()")
    assert page.text("#status").startswith("60 of 60 rows")


def test_statuses_have_marks_of_their_own(page):
    marks = page.script("return [Object.values(STATUS_MARKS).map(({ shape }) => shape), Object.values(STATUS_MARKS).map(({ light }) => light)]")
    assert all(len(set(each)) == len(each) for each in marks)


# ---- many lines ----


def test_lines_of_a_column_with_many_values_are_capped(open_page):
    page = open_page("many", MANY)
    assert page.script("return charts[0].scene.lines.length") == 60
    assert "60 of 80 lines are drawn" in page.text("#status")


@pytest.mark.parametrize("scheme, ground", [("light", (255, 255, 255)), ("dark", (0x15, 0x18, 0x1C))])
def test_every_line_is_read_on_its_ground(browser, open_page, scheme, ground):
    with screen(browser, 1600, 1000, scheme):
        page = open_page("many", MANY)
        colours = page.script("return charts[0].scene.lines.map(({ color }) => color.match(/\\d+/g).map(Number))")
        assert len({tuple(colour) for colour in colours}) > 50
        assert min(contrast(colour, ground) for colour in colours) >= 3


def test_values_that_no_slice_holds_have_lines_of_their_own(page):
    page.script("for (const { place } of slicedAxes) shown.slices[place] = null; refresh(false)")
    lines = page.script("return charts[0].scene.lines.map(({ x }) => x)")
    assert len(lines) == 7 * 2
    assert all(x == sorted(set(x)) for x in lines)
    page.click("#chart-0 .legend button")
    assert page.script("return charts[0].plot.series.slice(1).filter(({ show }) => !show).length") == 2


# ---- files ----


def png_size(data):
    """Width and height of a PNG whose checksums hold."""
    assert data.startswith(b"\x89PNG\r\n\x1a\n")
    at, size = 8, None
    while at < len(data):
        (length,) = struct.unpack(">I", data[at : at + 4])
        kind, content = data[at + 4 : at + 8], data[at + 8 : at + 8 + length]
        assert struct.unpack(">I", data[at + 8 + length : at + 12 + length])[0] == zlib.crc32(kind + content)
        if kind == b"IHDR":
            size = struct.unpack(">II", content[:8])
        at += 12 + length
    return size


def test_rows_are_saved_as_they_are_in_the_file(page, tmp_path):
    page.downloads(tmp_path)
    page.click("#csv")
    found = list(csv.reader(io.StringIO(downloaded(tmp_path / "rows.csv").decode())))
    names, rows = rows_of(page.rows)
    assert found[0] == names
    assert len(found) - 1 == page.script("return shown.rows.length") == 7 * 21
    by_point = {int(row[0]): row for row in rows}
    for cells in found[1:]:
        expected = by_point[int(float(cells[0]))]
        for cell, value in zip(cells, expected):
            assert (cell == "" and value is None) or (float(cell) == value if isinstance(value, float) else cell == str(value).lower())


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_pictures_have_the_whole_legend_and_are_light(browser, open_page, tmp_path, scheme):
    with screen(browser, 1300, 900, scheme):
        page = open_page("many", MANY)
        page.downloads(tmp_path)
        page.click("#svg")
        page.click("#png")
        picture = ElementTree.fromstring(downloaded(tmp_path / "picture.svg").decode())
        width, height = float(picture.get("width")), float(picture.get("height"))
        name = "{http://www.w3.org/2000/svg}"
        texts = [text for text in picture.iter(f"{name}text") if text.get("text-anchor") == "start"]
        assert [text.text for text in texts][:3] == ["Drive voltage, peak to peak:", "21 V", "22 V"]
        assert len(texts) == 61
        assert all(float(text.get("x")) + 7 * len(text.text) < width and float(text.get("y")) < height for text in texts)
        assert len({text.get("y") for text in texts}) > 2
        assert picture.find(f"{name}rect").get("fill") == "#ffffff"
        colours = {path.get("stroke") for path in picture.iter(f"{name}path")}
        assert len(colours) > 50
        assert all(contrast([int(part) for part in colour[4:-1].split(",")], (255, 255, 255)) >= 3 for colour in colours)
        data = downloaded(tmp_path / "picture.png")
        assert png_size(data) == pytest.approx((width, height), abs=2)
        corner = page.browser.execute_async_script("""
          const [url, done] = arguments, image = new Image();
          image.onload = () => {
            const pen = document.createElement("canvas").getContext("2d");
            pen.drawImage(image, 0, 0);
            done([...pen.getImageData(3, 3, 1, 1).data]);
          };
          image.src = url;
        """, "data:image/png;base64," + base64.b64encode(data).decode())
        assert corner == [255, 255, 255, 255]
        ground = "rgb(255, 255, 255)" if scheme == "light" else "rgb(21, 24, 28)"
        assert page.script("return getComputedStyle(document.body).backgroundColor") == ground
        assert page.script("return document.documentElement.className") == ""


# ---- the address ----


def test_a_reload_keeps_what_is_shown(page):
    page.choose("y", "lift_mean_mn")
    page.click("#log-y")
    page.click("#add")
    page.click("#two")
    page.choose("kind", "map")
    before = page.script("return JSON.stringify([shown.views, shown.two, shown.slices, shown.filters])")
    status = page.text("#status")
    page.browser.refresh()
    page.rest()
    assert page.script("return JSON.stringify([shown.views, shown.two, shown.slices, shown.filters])") == before
    assert page.text("#status") == status


def test_the_back_button_undoes_a_step(page):
    first = page.view()["y"]
    page.choose("y", "lift_mean_mn")
    page.browser.back()
    page.wait("return shown.views[0].y === arguments[0]", first)
    assert page.find("#y").get_attribute("value") == str(first)
    page.browser.forward()
    page.wait("return shown.views[0].y === placeOf.get('lift_mean_mn')")


def test_an_address_with_nonsense_opens_the_page(page):
    address = page.browser.current_url.split("#")[0]
    for text in ("#%", "#7", "#" + json.dumps({"views": [{"x": "no_such", "hidden": 3, "zoom": {"x": [1]}}], "slices": 5, "filters": {}})):
        page.open(address + text)
        assert page.script("return charts[0].scene.lines.length") == 7


# ---- the keyboard ----


def test_arrow_keys_go_from_mark_to_mark(page):
    page.keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.ARROW_UP)
    assert page.script("return charts[0].mark.name") == "50 V"
    row = page.script("return shown.hover")
    assert not page.find("#rows").is_displayed()
    page.keys(Keys.ENTER)
    assert page.text("#rows-title") == "Row that was clicked"
    assert page.script("return shown.pinned") == row
    assert page.find("#rows").is_displayed()
    whole = page.range("x")
    page.keys("+")
    assert page.range("x")[1] - page.range("x")[0] == pytest.approx(0.8 * (whole[1] - whole[0]))
    page.keys(Keys.ESCAPE)
    assert page.range("x") == whole


def test_arrow_keys_go_from_cell_to_cell_in_maps(page):
    page.choose("kind", "map")
    page.keys(Keys.ARROW_RIGHT)
    column, row = page.script("const { i, j } = charts[0].scene.cells, at = charts[0].mark.index; return [i[at], j[at]]")
    page.keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.ARROW_UP)
    after = page.script("const { i, j } = charts[0].scene.cells, at = charts[0].mark.index; return [i[at], j[at]]")
    assert after == [column + 2, row + 1]
    assert not page.script("return byId('tip').hidden")
    page.keys(*[Keys.ARROW_DOWN] * 12)
    assert page.script("return charts[0].scene.cells.j[charts[0].mark.index]") == 0


# ---- the window ----


@pytest.mark.parametrize("width, height", [(1600, 1000), (1024, 768), (820, 1180), (390, 844)])
def test_the_page_fits_its_window(browser, open_page, width, height):
    with screen(browser, width, height, mobile=width < 500):
        page = open_page("settled", SETTLED)
        assert page.script("return document.documentElement.scrollWidth <= innerWidth")
        picture, controls = (page.script("return byId(arguments[0]).getBoundingClientRect().top", name) for name in ("view", "controls"))
        assert (picture < controls) == (width <= 760)
        if width > 760:
            foot = page.script("return innerHeight - byId('hint').getBoundingClientRect().bottom")
            assert foot < 0.08 * height, "an empty foot"
        page.script("scrollTo(0, 500)")
        assert width > 760 or page.script("return scrollY") > 100


def test_two_fingers_zoom_and_one_scrolls(browser, open_page):
    with screen(browser, 390, 844, mobile=True):
        page = open_page("settled", SETTLED)
        whole = page.range("x")
        box = page.script("const { left, top, width, height } = document.querySelector('#chart-0 .u-over').getBoundingClientRect(); return [left, top, width, height]")
        x, y = box[0] + box[2] / 2, box[1] + box[3] / 2
        page.fingers("touchStart", (x - 30, y), (x + 30, y))
        page.fingers("touchMove", (x - 60, y), (x + 60, y))
        page.fingers("touchEnd")
        low, high = page.range("x")
        assert high - low == pytest.approx((whole[1] - whole[0]) / 2, rel=0.05)
        assert (low + high) / 2 == pytest.approx(sum(whole) / 2, rel=0.02)
        page.fingers("touchStart", (x, y))
        for step in range(1, 9):
            page.fingers("touchMove", (x, y - 25 * step))
        page.fingers("touchEnd")
        page.wait("return scrollY > 50")
        assert page.range("x") == [low, high]


def test_nothing_is_fetched_from_elsewhere(page):
    page.click("#two")
    assert page.script("return performance.getEntriesByType('resource').length") == 0
    assert page.script("return [...document.querySelectorAll('[src]')].length") == 0
    refused = page.browser.execute_async_script("fetch('data:,x').then(() => arguments[0](false), () => arguments[0](true))")
    assert refused is True
    page.browser.get_log("browser")  # the refusal itself


def test_a_large_page_draws_soon(browser, tmp_path):
    """126,000 rows: the first picture, lines of all slices, and steps of a filter."""
    axes = [(voltage, frequency, hinge) for voltage in range(40, 100, 2) for frequency in range(95, 137) for hinge in range(60, 160)]
    lines = (f"{v},{f},{h}e-6,periodic,{math.sin(0.1 * f) * v * h:.6g}" for v, f, h in axes)
    text = "drive_voltage_pp,drive_frequency,hinge_stiffness,status,lift_mean_mn\n" + "\n".join(lines) + "\n"
    (tmp_path / "large.csv").write_text(text, encoding="utf-8")
    command("plot", tmp_path / "large.csv", "--html", tmp_path / "large.html", "--x", "drive_frequency", "--y", "lift_mean_mn", "--by", "drive_voltage_pp")
    page = Results(browser).open((tmp_path / "large.html").as_uri())
    page.wait("return performance.getEntriesByName('flap-first-picture').length > 0")
    assert page.script("return results.rows") == len(axes) == 126_000
    assert page.script("return performance.getEntriesByName('flap-first-picture')[0].duration") < 2000
    took = page.browser.execute_async_script("""
      const begun = performance.now();
      for (const { place } of slicedAxes) shown.slices[place] = null;
      refresh(false);
      requestAnimationFrame(() => arguments[0](performance.now() - begun));
    """)
    assert took < 2000
    assert "60 of 3000 lines are drawn" in page.text("#status")
    page.click("#add")
    for step in (200, 400, 600):
        page.script("const slider = document.querySelector('.filter input[type=range]'); slider.value = arguments[0]; slider.oninput()", step)
        page.wait("return performance.getEntriesByName('flap-filter-to-picture').length > 0")
    times = page.script("return performance.getEntriesByName('flap-filter-to-picture').map((entry) => entry.duration)")
    assert min(times) < 500


def test_a_value_between_two_gaps_is_a_point(open_page):
    page = open_page("unsettled", UNSETTLED, "--y", "lift_mean_mn")
    cases = [[1, None, 2, None, 3, 4], [None, 1, None], [1, 2], [5], [None], [1, 2, None, 3]]
    assert [page.script("return alone(arguments[0])", case) for case in cases] == [[0, 2], [1], None, [0], None, [3]]
    svg = page.browser.execute_async_script("charts[0].svg().then(arguments[0])")
    lines = page.script("charts[0].scene.lines.forEach((line) => { line.marks = false; }); return charts[0].scene.lines.map(({ y }) => (alone(y) ?? []).length)")
    assert svg.count("<circle") > sum(lines) > 0
    svg = page.browser.execute_async_script("const lines = charts[0].scene.lines; charts[0].restyle = () => {}; charts[0].svg().then(arguments[0])")
    assert svg.count("<circle") == sum(lines)
