"""Pictures in axes of the user's own, in the look of their figure."""

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pytest
from figures import HERTZ, VOLTS, fails, grid, loop, message
from flapwing import plot
from matplotlib.colors import same_color

PAPER = {"font.size": 7.0, "lines.linewidth": 0.9}


def gaps():
    table = fails(grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ), [7, 8])
    return {name: column[:-1] for name, column in table.items()}


def many():
    return fails(grid(hinge_stiffness=np.geomspace(1e-5, 1e-3, 21), drive_frequency=HERTZ), [3, 9])


def front(table, **options):
    return plot.pareto(table, maximize="lift_mean_mn", minimize="power_mean_mw", **options)


PICTURES = {
    "response": lambda ax: plot.response(gaps(), "lift_mean_mn", ax=ax),
    "many lines": lambda ax: plot.response(many(), "lift_mean_mn", ax=ax),
    "heatmap": lambda ax: plot.heatmap(gaps(), "lift_mean_mn", ax=ax),
    "pareto": lambda ax: front(gaps(), color="drive_frequency", ax=ax),
    "hysteresis": lambda ax: plot.hysteresis(loop(), ax=ax),
    "tornado": lambda ax: plot.tornado("ozaki2018-large", "lift_mean_mn", ["wing_length", "drive_frequency"], ax=ax),
}


def within(inner, outer):
    """One box is in the other, but for a pixel."""
    low, high = inner.min - outer.min, outer.max - inner.max
    assert (low > -1.5).all() and (high > -1.5).all(), (inner, outer)


def check(ax, slot):
    """Nothing but labels is outside the axes, and nothing at all outside their slot."""
    box = ax.get_window_extent()
    legend = ax.get_legend()
    unclipped = [line for line in ax.lines if not line.get_clip_on()]
    for artist in [*ax.texts, *unclipped, *([] if legend is None else [legend])]:
        within(artist.get_window_extent(), box)
    within(ax.get_tightbbox(), slot)


@pytest.mark.parametrize("name", PICTURES)
def test_pictures_stay_within_their_axes(name):
    with mpl.rc_context(PAPER):
        figure = plt.figure(figsize=(7.0, 5.0), layout="constrained")
        panels = figure.subfigures(2, 2).flat
        ax = panels[0].subplots()
        assert PICTURES[name](ax) is ax
        figure.canvas.draw()
        for each in panels[0].axes:
            check(each, panels[0].bbox)
        assert not any(panel.axes for panel in panels[1:])


@pytest.mark.parametrize("given", [False, True])
def test_texts_and_lines_are_seen_on_black(given):
    with plt.style.context("dark_background"):
        rows = grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ)

        def ax():
            return plt.subplots()[1] if given else None

        bars = plot.histogram(rows, "lift_mean_mn", ax=ax())
        rings = front(rows, ax=ax())
        ranks = plot.tornado(rows, "lift_mean_mn", ax=ax())
        for each in (*bars.texts, *bars.lines[:3], *rings.lines, *ranks.texts, *ranks.lines):
            assert same_color(each.get_color(), "white")
        entry = front(rows, color="drive_frequency", ax=ax()).get_legend().get_texts()[0]
        assert same_color(entry.get_color(), "white")
    # The look of axes is that which they were made with.
    black = plt.subplots()[1]
    for label in (black.xaxis.label, black.yaxis.label):
        label.set_color("white")
    assert same_color(plot.histogram(rows, "lift_mean_mn", ax=black).texts[0].get_color(), "white")


def test_the_users_colours_go_first():
    words = grid(lift_sign=["corrected", "printed"], drive_frequency=HERTZ)
    assert same_color(plot.response(words, "lift_mean_mn").lines[0].get_color(), "#0072b2")
    with mpl.rc_context({"axes.prop_cycle": mpl.cycler(color=["#123456", "#654321"]), "image.cmap": "magma"}):
        assert same_color(plot.response(words, "lift_mean_mn").lines[1].get_color(), "#654321")
        table = grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ)
        assert plot.heatmap(table, "lift_mean_mn").collections[0].cmap.name == "magma"


def test_legends_and_colour_bars_are_off_or_elsewhere():
    table = grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ)
    _, (left, right) = plt.subplots(1, 2)
    plot.response(table, "lift_mean_mn", legend=False, ax=left)
    assert left.get_legend() is None
    plot.heatmap(table, "lift_mean_mn", ax=left, colorbar=right)
    assert right.get_ylabel() == "Lift, mean (mN)" and len(left.figure.axes) == 2
    plot.heatmap(table, "lift_mean_mn", ax=left, colorbar=False)
    front(table, color="drive_frequency", colorbar=False, ax=right)
    assert len(left.figure.axes) == 2
    own = plot.response(table, "lift_mean_mn", legend="lower right")
    own.figure.canvas.draw()
    within(own.get_legend().get_window_extent(), own.get_window_extent())


def test_options_of_legends_and_colour_bars_are_checked():
    table = grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ)
    assert "'top'" in message(ValueError, plot.response, table, "lift_mean_mn", legend="top")
    assert "upper left" in message(TypeError, plot.hysteresis, loop(), legend=3)
    assert "matplotlib Axes" in message(TypeError, plot.heatmap, table, "lift_mean_mn", colorbar="right")


@pytest.mark.parametrize("given", [False, True])
def test_the_users_settings_go_first(given):
    with mpl.rc_context({**PAPER, "lines.linewidth": 0.5, "axes.grid": False}):
        ax = plt.subplots()[1] if given else None
        ax = plot.response(grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ), "lift_mean_mn", ax=ax)
        assert {line.get_linewidth() for line in ax.lines} == {0.5}
        texts = [ax.xaxis.label, *ax.get_xticklabels(), *ax.get_legend().get_texts(), ax.get_legend().get_title()]
        assert {text.get_fontsize() for text in texts} == {7.0}
        # The right spine is flap's choice, and in axes of the user's own the user's.
        assert ax.spines["right"].get_visible() == given


def test_measures_of_both_signs_have_a_diverging_map_and_a_line_at_zero():
    table = grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ)
    table["lift_mean_mn"] = table["lift_mean_mn"] - 5.0
    ax = plot.heatmap(table, "lift_mean_mn")
    mesh = ax.collections[0]
    assert min(mesh.to_rgba(0.0)[:3]) > 0.96, "white at zero"
    red, _, blue, _ = mesh.to_rgba(4.0)
    assert red > blue and mesh.to_rgba(-4.0)[2] > mesh.to_rgba(-4.0)[0]
    # The colour bar ends where the values do.
    assert mesh.norm.vmin == -4.0 and mesh.norm.vmax == 10.0
    assert any(set(line.get_ydata()) == {0.0} for line in mesh.colorbar.ax.lines)
    assert len(ax.collections) == 2, "the contour at zero"
    for cmap, lowest in (("viridis", -4.0), (None, 1.0), (None, -0.05)):
        table["lift_mean_mn"][0] = lowest
        table["lift_mean_mn"][1:] = np.abs(table["lift_mean_mn"][1:])
        ax = plot.heatmap(table, "lift_mean_mn", cmap=cmap)
        assert ax.collections[0].cmap.name == "viridis" and len(ax.collections) == 1


@pytest.mark.parametrize(
    ("ends", "extend"),
    [({}, "neither"), ({"vmin": 3.0}, "min"), ({"vmax": 9.0}, "max"), ({"vmin": 3.0, "vmax": 9.0}, "both")],
)
def test_an_arrow_says_that_values_are_beyond_the_colours(ends, extend):
    ax = plot.heatmap(grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ), "lift_mean_mn", **ends)
    assert ax.collections[0].colorbar.extend == extend


def test_the_front_is_behind_the_colours():
    table = grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ)
    ax = front(table, color="drive_frequency")
    (line,), points = ax.lines, ax.collections[0]
    assert line.get_zorder() < points.get_zorder() and line.get_markerfacecolor() == "none"
    assert line.get_markersize() > np.sqrt(points.get_sizes()[0])


@pytest.mark.parametrize("height", [2.0, 3.0, 6.0])
def test_numbers_of_logarithmic_colour_bars_do_not_overlap(height):
    with mpl.rc_context(PAPER):
        figure, ax = plt.subplots(figsize=(3.0, height), layout="constrained")
        plot.response(many(), "lift_mean_mn", ax=ax)
        figure.canvas.draw()
        (bar,) = [each for each in figure.axes if each is not ax]
        boxes = sorted((text.get_window_extent() for text in bar.get_yticklabels()), key=lambda box: box.y0)
        assert len(boxes) >= 2
        assert all(below.y1 < above.y0 for below, above in zip(boxes, boxes[1:]))
