"""Labels, colours and defaults are those of the command's pictures."""

import re

import numpy as np
from figures import HERTZ, VOLTS, drawn, grid, legend, loop
from flapwing import _flapwing, analysis, plot
from matplotlib.colors import to_hex


def svg(flap, folder, table, *options):
    """The command's picture of a table."""
    file = folder / "table.csv"
    names = list(table)
    rows = [
        ",".join(names),
        *(
            ",".join(str(cell).lower() if isinstance(cell, np.bool_) else str(cell) for cell in row)
            for row in zip(*table.values())
        ),
    ]
    file.write_text("\n".join(rows) + "\n", encoding="utf-8")
    out = folder / "out.svg"
    flap("plot", file, "--force", "--out", out, *options)
    return out.read_text(encoding="utf-8")


def texts(picture):
    return re.findall(r"<text[^>]*>([^<]*)<", picture)


def test_default_measures_axes_and_colours_of_a_response(flap, tmp_path):
    table = grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ)
    table["stroke_pp_deg"] = table["lift_mean_mn"] * 2.0
    picture = svg(flap, tmp_path, table)
    ax = drawn(plot.response(table))
    assert {ax.get_xlabel(), ax.get_ylabel(), "60", "80", "100"} <= set(texts(picture))
    shades = set(re.findall(r'stroke="(#[0-9a-fA-F]{6})" stroke-width="2"', picture))
    assert len(shades) == len(ax.lines) == 3
    for line in ax.lines:
        # The two libraries round the same map differently.
        mine = channels(to_hex(line.get_color()))
        assert min(max(abs(a - b) for a, b in zip(mine, channels(shade))) for shade in shades) < 12


def channels(colour):
    return [int(colour[at : at + 2], 16) for at in (1, 3, 5)]


def test_the_default_of_a_map_and_of_a_scatter(flap, tmp_path):
    table = grid(drive_voltage_pp=VOLTS, hinge_stiffness=[1e-4, 2e-4])
    ax = drawn(plot.heatmap(table))
    labels = {ax.get_xlabel(), ax.get_ylabel(), ax.figure.axes[1].get_ylabel()}
    assert labels <= set(texts(svg(flap, tmp_path, table, "--kind", "map")))
    ax = drawn(plot.scatter(table))
    assert {ax.get_xlabel(), ax.get_ylabel()} <= set(texts(svg(flap, tmp_path, table, "--kind", "scatter")))


def test_the_default_objectives_and_their_directions(flap, tmp_path):
    table = grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ)
    picture = svg(flap, tmp_path, table, "--kind", "pareto")
    ax = drawn(plot.pareto(table))
    assert {ax.get_xlabel(), ax.get_ylabel()} <= set(texts(picture))
    assert ax.lines[0].get_label() == "front (1 of 15 designs)"
    for name in ("lift_mean_mn", "power_mean_mw", "drive_frequency"):
        assert _flapwing.better(name) == {"lift_mean_mn": 1, "power_mean_mw": -1}.get(name, 0)


def test_branches_have_the_same_names_colours_and_jumps(flap, tmp_path):
    table = loop()
    picture = svg(flap, tmp_path, table)
    ax = drawn(plot.hysteresis(table))
    assert set(legend(ax)[1:]) <= set(texts(picture))
    assert "shaded: bistable, 3 to 5 Hz" in texts(picture)
    for line in ax.lines:
        assert to_hex(line.get_color()).upper() in picture.upper()
        assert to_hex(line.get_color()).upper() == _flapwing.colours()["branches"][line.get_label()].upper()
    # Two jumps, halfway between their rows: neither picture has a line there.
    assert sum(np.isnan(line.get_ydata()).sum() for line in ax.lines) == 2


def test_a_histogram_has_the_same_percentiles(flap, tmp_path):
    table = grid(drive_frequency=list(range(101)))
    picture = svg(flap, tmp_path, table, "--kind", "histogram")
    assert {text.get_text() for text in drawn(plot.histogram(table)).texts} <= set(texts(picture))
    found = analysis.rank_correlations(table)
    assert f"{found[0].correlation:+.2f}" in texts(svg(flap, tmp_path, table, "--kind", "tornado"))
