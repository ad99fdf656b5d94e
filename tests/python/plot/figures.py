"""Tables to be drawn, and what a picture shows."""

import itertools

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.figure import Figure

VOLTS = [60.0, 80.0, 100.0]
HERTZ = [95.0, 100.0, 105.0, 110.0, 115.0]


def grid(**axes):
    """Columns of a full grid: parameters, a status, and two measures that are their own for each row."""
    rows = list(itertools.product(*axes.values()))
    columns = {name: np.array([row[i] for row in rows]) for i, name in enumerate(axes)}
    count = np.arange(len(rows), dtype=float)
    return {
        "point": np.arange(len(rows)),
        **columns,
        "status": np.array(["periodic"] * len(rows), dtype="U12"),
        "lift_mean_mn": 1.0 + count,
        "power_mean_mw": 50.0 - count**1.5,
    }


def fails(table, rows, status="unsettled"):
    """The table with rows that have no measures."""
    table = {name: column.copy() for name, column in table.items()}
    table["status"][rows] = status
    for name in ("lift_mean_mn", "power_mean_mw"):
        table[name][rows] = np.nan
    return table


def drawn(axes):
    """The figure is drawn without a warning, and no text leaves it."""
    figure = axes if isinstance(axes, Figure) else axes.figure
    figure.draw_without_rendering()
    box = figure.get_tightbbox()
    width, height = figure.get_size_inches()
    assert box.x0 >= -0.02 and box.y0 >= -0.02
    assert box.x1 <= width + 0.02 and box.y1 <= height + 0.02
    return axes


def lines(ax):
    """The lines that hold data."""
    return [line for line in ax.lines if not line.get_label().startswith("_not")]


def legend(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def message(error, function, *arguments, **keywords):
    before = plt.get_fignums()
    with pytest.raises(error) as caught:
        function(*arguments, **keywords)
    assert plt.get_fignums() == before, "a figure was begun before the mistake was found"
    return str(caught.value)


def loop():
    """A response that is bistable from 3 to 5 Hz."""
    hertz = np.arange(1.0, 8.0)
    up, down = np.where(hertz <= 5, 10 + hertz, 2.0), np.where(hertz < 3, 10 + hertz, 2.0)
    x = np.concatenate([hertz, hertz[::-1], [5.0, 4.0, 3.0]])
    return {
        "curve": np.zeros(len(x)),
        "branch": np.array(["up"] * 7 + ["down"] * 7 + ["unstable"] * 3),
        "drive_frequency": x,
        "status": np.array(["periodic"] * 14 + ["unstable"] * 3),
        "bistable": ((x >= 3) & (x <= 5)) & (np.arange(len(x)) < 14),
        "stroke_pp_deg": np.concatenate([up, down[::-1], [14.0, 8.0, 3.0]]),
    }
