"""Journeys on the page of `flap plot --html`: zoom, axes, views, filters, the legend, files, the address, phones.

Numbers that need no browser are tested in tests/web.
"""

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

LOOP = [
    "--set",
    "hinge_stiffness=0.7486 uN*m/rad",
    "--set",
    "drive_voltage_pp=160 V",
    "--from",
    "118 Hz",
    "--to",
    "132 Hz",
    "--step",
    "1 Hz",
    "--unstable",
]


class Results(Page):
    """A page of results."""

    def rest(self):
        self.wait("window.flapTestHook?.charts.length === 2 && document.querySelector('#status').textContent !== ''")
        return self

    def choose(self, name, text):
        """Chooses an entry of a menu: the beginning of a column's title."""
        menu = Select(self.find(f"#{name}"))
        menu.select_by_value(
            next(option.get_attribute("value") for option in menu.options if option.text.startswith(text))
        )

    def chosen(self, name):
        return Select(self.find(f"#{name}")).first_selected_option.text

    def cells(self, column):
        """The texts of a column of the table."""
        place = 1 + self.properties("#table th", "title").index(column)
        return self.texts(f"#table tbody td:nth-child({place})")

    def drag(self, begin, end, number=0, shift=False):
        """Drags over a picture, between shares of its width and height from the top left."""
        over = self.over(number)
        size = over.size
        offsets = [(round((x - 0.5) * size["width"]), round((y - 0.5) * size["height"])) for x, y in (begin, end)]
        actions = ActionChains(self.browser)
        if shift:
            actions.key_down(Keys.SHIFT)
        actions.move_to_element_with_offset(over, *offsets[0]).click_and_hold().move_to_element_with_offset(
            over, *offsets[1]
        ).release()
        if shift:
            actions.key_up(Keys.SHIFT)
        actions.perform()

    def focus(self, number=0):
        """Moves the focus to a picture, as the tabulator key does."""
        self.script("arguments[0].focus()", self.over(number))

    def switch(self, name):
        """Clicks on an entry of the legend."""
        next(button for button in self.find_all("#chart-0 .legend button") if button.text == name).click()

    def slide(self, side, value):
        """Moves a slider of the first filter: 0 for the lower bound, 1 for the upper one."""
        slider = self.find_all(".filter input[type=range]")[side]
        self.script("arguments[0].value = arguments[1]; arguments[0].dispatchEvent(new Event('input'))", slider, value)


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


# ---- zoom and axes ----


def test_zoom_with_the_mouse(page):
    """Drag, double click, Shift and drag, Ctrl and the wheel, and the button that shows everything."""
    whole = page.range("x")
    width = whole[1] - whole[0]
    page.drag((0.25, 0.5), (0.5, 0.5))
    low, high = page.range("x")
    assert low == pytest.approx(whole[0] + 0.25 * width, abs=0.02 * width)
    assert high == pytest.approx(whole[0] + 0.5 * width, abs=0.02 * width)
    assert not page.find("#rows").is_displayed(), "the click of a drag pins nothing"
    ActionChains(page.browser).double_click(page.over()).perform()
    assert page.range("x") == whole

    page.drag((0.5, 0.5), (0.25, 0.5), shift=True)
    moved = page.range("x")
    assert moved[0] == pytest.approx(whole[0] + 0.25 * width, abs=0.02 * width)
    assert moved[1] - moved[0] == pytest.approx(width, rel=0.01)
    page.script(
        """
        const { left, top, width } = arguments[0].getBoundingClientRect();
        const place = { clientX: left + width / 2, clientY: top + 9 };
        arguments[0].dispatchEvent(new WheelEvent("wheel", { deltaY: -100, ctrlKey: true, cancelable: true, ...place }));
        """,
        page.over(),
    )
    zoomed = page.range("x")
    assert zoomed[1] - zoomed[0] == pytest.approx(width / 1.2, rel=0.01)
    page.click("#whole")
    assert page.range("x") == whole


def test_logarithmic_axes_of_lines_and_maps(page):
    page.click("#log-x")
    page.click("#log-y")
    for axis in ("x", "y"):
        labels = page.labels(axis)
        assert len(labels) >= 4, labels
        assert all(len(label.replace(".", "").lstrip("0")) <= 4 for label in labels), labels
    page.choose("kind", "Map")
    assert page.find("#log-x").is_selected() and page.find("#log-y").is_selected()
    assert page.chart("chart.scene.cells.rows.length") == 7 * 21
    assert all(len(page.labels(axis)) >= 4 for axis in ("x", "y")), [page.labels(axis) for axis in ("x", "y")]


def test_points_at_one_x_are_all_in_the_picture(browser, tmp_path):
    (tmp_path / "one.csv").write_text("a,b,status\n1,5,periodic\n1,7,periodic\n1,30,periodic\n", encoding="utf-8")
    command("plot", tmp_path / "one.csv", "--html", tmp_path / "one.html", "--kind", "scatter", "--x", "a", "--y", "b")
    page = Results(browser).open((tmp_path / "one.html").as_uri())
    assert page.range("x") == pytest.approx([0.95, 1.05])
    low, high = page.range("y")
    assert low < 5 and 30 < high < 33


# ---- views, slices and filters ----


def test_rows_selected_in_one_view_are_marked_in_the_other(page):
    page.click("#two")
    assert page.find("#chart-1").is_displayed()
    page.choose("x", "Power, mean")
    page.choose("y", "Lift, mean")
    assert page.chart("chart.scene.x.label", 1) == "Power, mean"
    page.click("#drag")
    page.drag((0.02, 0.02), (0.4, 0.98), number=0)
    selected = page.chart("[...chart.selectedRows]")
    assert len(selected) > 10
    assert set(page.chart("[...chart.selectedRows]", 1)) == set(selected)
    assert page.text("#rows-title").startswith(f"{len(selected)} selected rows")
    assert len(page.find_all("#table tbody tr")) == min(len(selected), 100)
    low, high = page.range("x")
    frequencies = page.cells("drive_frequency")
    assert max(map(float, frequencies)) <= low + 0.4 * (high - low) + 1


def test_slices_and_what_they_leave(page):
    """A line for each value that no slice holds; a sentence that both views would say is said once."""
    assert page.text("#status").startswith(f"{7 * 21} of {7 * 21 * 2} rows shown")
    for menu in page.find_all("#slices select"):
        Select(menu).select_by_visible_text("all")
    lines = page.lines()
    assert len(lines) == 7 * 2
    assert all(line["x"] == sorted(set(line["x"])) for line in lines)
    page.click("#chart-0 .legend button")
    assert len(page.lines()) == 7 * 2 - 2, "the legend switches both lines of a voltage"
    page.click("#reset")
    assert len(page.lines()) == 7

    page.click("#two")
    for number in (0, 1):
        page.click(f"#view-{number}")
        page.choose("kind", "Lines")
        page.choose("by", "one line")
    page.click("#add")
    Select(page.find(".filter select")).select_by_visible_text("Drive frequency (Hz)")
    page.type(".filter .bounds input:last-child", "61")
    page.type(".filter .bounds input:first-child", "60.5")
    page.wait(lambda: page.text("#status").startswith("0 of"))
    parts = page.text("#status").split(" · ")
    assert parts.count("no row has both values: nothing is drawn") == 1
    assert len(set(parts)) == len(parts)


def test_filters_are_typed_and_slid(page):
    page.click("#add")
    Select(page.find(".filter select")).select_by_visible_text("Drive frequency (Hz)")
    low, high = ".filter .bounds input:first-child", ".filter .bounds input:last-child"
    page.type(low, "0.1 kHz")
    assert page.value(low) == "100"
    page.type(high, "150")
    page.wait(lambda: page.text("#status").startswith(f"{7 * 7} of"))
    shown = {x for line in page.lines() for x in line["x"]}
    assert 100 <= min(shown) and max(shown) <= 150
    page.type(low, "180")
    assert page.value(low) == "150"
    page.type(high, "90 Hz")
    assert page.value(high) == "150"
    page.type(low, "99,5")
    assert page.value(low) == "99.5"

    for text, words in [
        ("1,400", "may be 1400 or 1.4"),
        ("5 cats", "is not a unit"),
        ("much", "does not begin with a number"),
    ]:
        page.type(low, text)
        assert words in page.text(".filter .problem")
        assert page.find(low).get_attribute("aria-invalid") == "true"
        assert min(x for line in page.lines() for x in line["x"]) == 102
    page.type(low, "")
    assert not page.find(".filter .problem").is_displayed()
    assert page.value(low) == "99.5"

    page.slide(1, 1000)
    page.slide(0, 600)
    page.slide(1, 300)
    sliders = [slider.get_attribute("value") for slider in page.find_all(".filter input[type=range]")]
    assert sliders == ["600", "600"]
    assert page.value(low) == page.value(high) == "144"


def test_axes_and_filters_have_the_shown_unit(page):
    """The rows are in N·m/rad, and the page shows µN·m/rad."""
    page.choose("x", "Hinge stiffness")
    assert sorted({x for line in page.lines() for x in line["x"]}) == [90, 110]
    for menu in page.find_all("#slices select"):
        Select(menu).select_by_visible_text("all")
    page.click("#add")
    Select(page.find(".filter select")).select_by_visible_text("Hinge stiffness (µN·m/rad)")
    low, high = ".filter .bounds input:first-child", ".filter .bounds input:last-child"
    assert (page.value(low), page.value(high)) == ("90", "110")
    page.type(low, "100")
    assert page.value(low) == "100"
    page.wait(lambda: page.text("#status").startswith(f"{7 * 21} of {7 * 21 * 2} rows shown"))
    assert {x for line in page.lines() for x in line["x"]} == {110}


def test_a_filter_that_is_wide_open_keeps_rows_without_a_value(open_page):
    page = open_page("unsettled", UNSETTLED, "--y", "lift_mean_mn")
    page.click("#add")
    Select(page.find(".filter select")).select_by_visible_text("Lift, mean (mN)")
    assert page.text("#status").startswith("60 of 60 rows")


# ---- the legend ----


def test_the_legend_switches_lines_for_good(page):
    button = page.find("#chart-0 .legend button")
    assert button.text == "40 V"
    button.click()
    assert [line["name"] for line in page.lines()] == [f"{volts} V" for volts in range(50, 101, 10)]
    assert page.find("#chart-0 .legend button").get_attribute("aria-pressed") == "false"
    page.reload()
    assert len(page.lines()) == 6
    page.click("#chart-0 .legend button")
    assert len(page.lines()) == 7
    page.browser.back()
    page.wait(lambda: len(page.lines()) == 6)


def test_branches_of_a_response_are_switched_and_come_back(browser, tmp_path):
    command("respond", "jafferis2016", *LOOP, "--out", tmp_path / "loop.csv")
    command("plot", tmp_path / "loop.csv", "--html", tmp_path / "loop.html")
    page = Results(browser).open((tmp_path / "loop.html").as_uri())
    assert page.texts("#chart-0 .legend button") == ["up", "down", "unstable"]
    page.switch("up")
    assert {line["name"] for line in page.lines()} == {"down", "unstable"}
    page.choose("by", "one line")
    assert len(page.lines()) == 3
    page.click("#chart-0 .legend button")
    assert len(page.lines()) == 2
    page.click("#reset")
    assert len(page.lines()) == 3


def test_rows_without_a_motion_are_counted_and_marked(open_page):
    page = open_page("unsettled", UNSETTLED, "--y", "lift_mean_mn")
    names, rows = rows_of(page.rows)
    statuses = [row[names.index("status")] for row in rows]
    counts = [f"{statuses.count('unsettled')} unsettled"]
    assert page.texts("#chart-0 .statuses span") == counts
    legend = page.texts("#chart-0 .legend > *")
    assert legend == ["Drive voltage, peak to peak:", "100 V", "200 V", "1500 V", "4000 V", *counts]
    gap = page.point_at_gap()
    page.wait(lambda: page.find("#tip").is_displayed())
    assert "unsettled" in page.text("#tip")
    point = int(page.text("#tip > div").split(": ")[1])
    assert statuses[point] == "unsettled" and rows[point][names.index("drive_frequency")] == pytest.approx(gap["x"])


def test_many_lines_are_capped_and_can_be_told_apart(browser, open_page):
    for scheme, ground in [("light", (255, 255, 255)), ("dark", (0x15, 0x18, 0x1C))]:
        with screen(browser, 1600, 1000, scheme):
            page = open_page("many", MANY)
            assert "60 of 80 lines are drawn" in page.text("#status")
            lines = page.lines()
            assert len(lines) == 60
            colours = [tuple(int(part) for part in line["color"][4:-1].split(",")) for line in lines]
            assert len(set(colours)) > 50
            assert min(contrast(colour, ground) for colour in colours) >= 3


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
    assert len(found) - 1 == 7 * 21
    by_point = {int(row[0]): row for row in rows}
    for cells in found[1:]:
        expected = by_point[int(float(cells[0]))]
        for cell, value in zip(cells, expected):
            assert (cell == "" and value is None) or (
                float(cell) == value if isinstance(value, float) else cell == str(value).lower()
            )


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
        assert all(
            float(text.get("x")) + 7 * len(text.text) < width and float(text.get("y")) < height for text in texts
        )
        assert len({text.get("y") for text in texts}) > 2
        assert picture.find(f"{name}rect").get("fill") == "#ffffff"
        ticks = {text.text for text in picture.iter(f"{name}text") if text.get("text-anchor") != "start"}
        assert {*page.labels("x"), *page.labels("y"), "Drive frequency (Hz)"} <= ticks
        colours = {path.get("stroke") for path in picture.iter(f"{name}path")}
        assert len(colours) > 50
        assert all(
            contrast([int(part) for part in colour[4:-1].split(",")], (255, 255, 255)) >= 3 for colour in colours
        )
        data = downloaded(tmp_path / "picture.png")
        assert png_size(data) == pytest.approx((width, height), abs=2)
        corner = page.browser.execute_async_script(
            """
            const [url, done] = arguments, image = new Image();
            image.onload = () => {
              const pen = document.createElement("canvas").getContext("2d");
              pen.drawImage(image, 0, 0);
              done([...pen.getImageData(3, 3, 1, 1).data]);
            };
            image.src = url;
            """,
            "data:image/png;base64," + base64.b64encode(data).decode(),
        )
        assert corner == [255, 255, 255, 255]
        assert page.background() == ("rgba(255, 255, 255, 1)" if scheme == "light" else "rgba(21, 24, 28, 1)")
        assert page.find("html").get_attribute("class") == ""


def test_pictures_have_the_points_between_two_gaps(open_page, tmp_path):
    page = open_page("unsettled", UNSETTLED, "--y", "lift_mean_mn")
    page.downloads(tmp_path)
    page.click("#svg")
    picture = downloaded(tmp_path / "picture.svg").decode()
    values = [y for line in page.lines() for y in line["y"] if y is not None]
    assert picture.count("<circle") == len(values) > 0
    assert picture.count('transform="translate(') == 1 + len(page.chart("chart.scene.gaps")) + 1, (
        "the y axis, gaps and their entry"
    )


# ---- the address ----


def test_the_address_keeps_what_is_shown(page):
    page.choose("y", "Lift, mean")
    page.click("#log-y")
    page.click("#add")
    page.click("#two")
    page.choose("kind", "Map")

    def state():
        menus = [page.chosen(name) for name in ("kind", "x", "y", "color")]
        labels = [page.chart("[chart.scene.x, chart.scene.y, chart.scene.lines.length]", number) for number in (0, 1)]
        return (
            menus,
            labels,
            page.text("#status"),
            [select.get_attribute("value") for select in page.find_all("#slices select")],
        )

    page.click("#view-0")
    before = state()
    page.reload()
    assert state() == before
    assert page.find("#chart-1").is_displayed() and len(page.find_all(".filter")) == 1


def test_the_back_button_undoes_a_step(page):
    first = page.chosen("y")
    page.choose("y", "Lift, mean")
    page.browser.back()
    page.wait(lambda: page.chart("chart.scene.y.label") == first.split(" (")[0])
    assert page.chosen("y") == first
    page.browser.forward()
    page.wait(lambda: page.chart("chart.scene.y.label") == "Lift, mean")


def test_the_back_button_undoes_a_slide_of_a_filter(page):
    page.click("#add")
    whole = page.text("#status")
    page.slide(0, 600)
    page.wait(lambda: page.text("#status") != whole)
    page.script("arguments[0].dispatchEvent(new Event('change'))", page.find(".filter input[type=range]"))
    page.browser.back()
    page.wait(lambda: page.text("#status") == whole)
    assert len(page.find_all(".filter")) == 1


def test_an_address_with_nonsense_opens_the_page(page):
    address = page.browser.current_url.split("#")[0]
    nonsense = {"views": [{"x": "no_such", "hidden": 3, "zoom": {"x": [1]}}], "slices": 5, "filters": {}}
    for text in ("#%", "#7", "#" + json.dumps(nonsense)):
        page.open(address + text)
        assert len(page.lines()) == 7


# ---- the keyboard ----


def test_the_keyboard_alone_reads_rows_and_zooms(page):
    page.focus()
    page.keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.ARROW_UP)
    assert page.chart("chart.mark.name") == "50 V"
    tip = page.texts("#tip > div")
    assert "Drive voltage, peak to peak: 50 V" in tip and "Drive frequency: 67 Hz" in tip
    assert not page.find("#rows").is_displayed()
    page.keys(Keys.ENTER)
    assert page.text("#rows-title") == "Row that was clicked"
    assert page.find("#rows").is_displayed()
    assert tip[0].split(": ")[1].strip() == page.text("#table tbody td")
    whole = page.range("x")
    page.keys("+")
    assert page.range("x")[1] - page.range("x")[0] == pytest.approx(0.8 * (whole[1] - whole[0]))
    page.keys(Keys.ESCAPE)
    assert page.range("x") == whole

    page.choose("kind", "Map")
    page.focus()
    place = "[chart.scene.cells.i[chart.mark.index], chart.scene.cells.j[chart.mark.index]]"
    page.keys(Keys.ARROW_RIGHT)
    column, row = page.chart(place)
    page.keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.ARROW_UP)
    assert page.chart(place) == [column + 2, row + 1]
    assert page.find("#tip").is_displayed()
    page.keys(*[Keys.ARROW_DOWN] * 12)
    assert page.chart(place)[1] == 0


# ---- the window ----


@pytest.mark.parametrize("width, height", [(1600, 1000), (1024, 768), (820, 1180), (390, 844)])
def test_the_page_fits_its_window(browser, open_page, width, height):
    with screen(browser, width, height, mobile=width < 500):
        page = open_page("settled", SETTLED)
        assert page.fits_width()
        assert (page.box("#view")[1] < page.box("#controls")[1]) == (width <= 760)
        if width > 760:
            _, top, _, hint_height = page.box("#hint")
            assert height - top - hint_height < 0.08 * height, "an empty foot"
        page.script("scrollTo(0, 500)")
        assert width > 760 or page.script("return scrollY") > 100


def test_two_fingers_zoom_and_one_scrolls(browser, open_page):
    with screen(browser, 390, 844, mobile=True):
        page = open_page("settled", SETTLED)
        whole = page.range("x")
        left, top, width, height = page.box("#chart-0 .u-over")
        x, y = left + width / 2, top + height / 2
        page.pinch(x, y)
        low, high = page.range("x")
        assert high - low == pytest.approx((whole[1] - whole[0]) / 2, rel=0.05)
        assert (low + high) / 2 == pytest.approx(sum(whole) / 2, rel=0.02)
        page.fingers("touchStart", (x, y))
        for step in range(1, 9):
            page.fingers("touchMove", (x, y - 25 * step))
        page.fingers("touchEnd")
        page.wait("scrollY > 50")
        assert page.range("x") == [low, high]


def test_nothing_is_fetched_from_elsewhere(page):
    page.click("#two")
    assert page.resources() == []
    assert page.find_all("[src]") == []
    refused = page.browser.execute_async_script(
        "fetch('data:,x').then(() => arguments[0](false), () => arguments[0](true))"
    )
    assert refused is True
    page.browser.get_log("browser")  # the refusal itself


def test_a_large_page_draws_soon(browser, tmp_path):
    """126,000 rows: the first picture, lines of all slices, and steps of a filter."""
    axes = [
        (voltage, frequency, hinge)
        for voltage in range(40, 100, 2)
        for frequency in range(95, 137)
        for hinge in range(60, 160)
    ]
    assert len(axes) == 126_000
    lines = (f"{v},{f},{h}e-6,periodic,{math.sin(0.1 * f) * v * h:.6g}" for v, f, h in axes)
    text = "drive_voltage_pp,drive_frequency,hinge_stiffness,status,lift_mean_mn\n" + "\n".join(lines) + "\n"
    (tmp_path / "large.csv").write_text(text, encoding="utf-8")
    command(
        "plot",
        tmp_path / "large.csv",
        "--html",
        tmp_path / "large.html",
        "--x",
        "drive_frequency",
        "--y",
        "lift_mean_mn",
        "--by",
        "drive_voltage_pp",
    )
    page = Results(browser).open((tmp_path / "large.html").as_uri())
    page.wait(lambda: page.durations("flap-first-picture"))
    assert "of 126000 rows" in page.text("#status")
    assert page.durations("flap-first-picture")[0] < 2000
    took = page.browser.execute_async_script(
        """
        const [menu, done] = arguments, begun = performance.now();
        menu.value = "";
        menu.dispatchEvent(new Event("change"));
        requestAnimationFrame(() => done(performance.now() - begun));
        """,
        page.find("#slices [data-column=hinge_stiffness]"),
    )
    assert took < 2000
    assert "60 of 3000 lines are drawn" in page.text("#status")
    page.click("#add")
    for step in (200, 400, 600):
        page.slide(0, step)
        page.wait(lambda: page.durations("flap-filter-to-picture"))
    assert min(page.durations("flap-filter-to-picture")) < 500
