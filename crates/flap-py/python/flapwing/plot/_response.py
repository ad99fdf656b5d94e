"""Pictures of measures against one parameter, with one line for each value of a second parameter."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from .._data import DESIGN, Data, Shown, distinct, edges, joined, scattered, several
from .._flapwing import is_log
from .._mistakes import unknown
from . import _style
from ._checks import checked

# Largest number of lines that a sample gets by default: more cannot be distinguished.
_MOST_SAMPLED = 16


@checked
def response(
    table: Any,
    y: str | None = None,
    *,
    x: str | None = None,
    by: str | None = None,
    where: Mapping[str, Any] | None = None,
    label: Sequence[str] | None = None,
    legend: bool | str = True,
    colorbar: bool | Axes = True,
    ax: Axes | None = None,
    **slices: Any,
) -> _style.Drawn:
    """Draw a measure against one parameter, with one line for each value of a second parameter.

    A line has a gap at points without a periodic motion. Above the picture, marks in the colour of a line show the
    points without a periodic motion.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        Results of `sweep`, `evaluate` or `respond`, or the path of a file of results. To compare designs, give the
        results of each design: a mapping of names to results, or a list of results. If you give several results, the
        picture has one line for each of the results.
    y : str, optional
        The measure to draw. The default of `y` is the peak-to-peak stroke.
    x : str, optional
        The parameter on the horizontal axis. The default of `x` is ``drive_frequency``. If ``drive_frequency`` does not
        vary, the default of `x` is the last axis of the grid.
    by : str, optional
        The picture has one line for each value of the parameter `by`. If the grid has two or more axes, the default of
        `by` is the first axis that is not on the horizontal axis. If you give several results, you cannot give `by`,
        because the picture has one line for each of the results.
    where, **slices
        Values of columns, which select the rows to draw: numbers in SI units, text with units, or words. Give the
        values in the mapping `where`, or as keyword arguments such as ``drive_voltage_pp="100 V"``. If you select no
        value of an axis that is not drawn, the picture shows only the rows at the middle value of this axis. A warning
        shows the middle value that was used.
    label : sequence of str, optional
        The name of each result in the legend, if `table` is a list of results. By default, the names are the numbers of
        the results in the list.
    legend : bool or str
        If `legend` is False, the picture has no legend. If `legend` is text such as ``"upper left"``, the legend is at
        this position inside the axes. By default, the legend is outside of the axes of a new figure. If `ax` is given,
        the legend is inside the axes by default.
    colorbar : bool or matplotlib Axes
        If `colorbar` is False, the picture has no colour bar. If `colorbar` is Axes, the colour bar is in these axes.
        By default, the colour bar is beside the picture, and the picture becomes narrower.
    ax : matplotlib Axes, optional
        Axes for the picture. If you give `ax`, the picture has the style of the existing figure, and only labels and a
        colour bar are drawn outside of `ax`. By default, the picture is drawn in a new figure.

    Returns
    -------
    matplotlib Axes
        The axes of the picture. Parameters are in readable units, which the labels of the axes contain.

    Raises
    ------
    ValueError
        Raised if a column or value is unknown. Raised if several rows have the same parameters. Raised if a column has
        text instead of numbers.

    Examples
    --------
    >>> import numpy as np
    >>> table = {
    ...     "drive_frequency": np.array([90.0, 100.0, 90.0, 100.0]),
    ...     "drive_voltage_pp": np.array([100.0, 100.0, 200.0, 200.0]),
    ...     "stroke_pp_deg": np.array([20.0, 40.0, 35.0, 60.0]),
    ... }
    >>> ax = response(table, by="drive_voltage_pp")
    >>> [line.get_ydata().tolist() for line in ax.lines]
    [[20.0, 40.0], [35.0, 60.0]]
    """
    whole, by = _together(table, label, by)
    data = whole.slice(where, slices)
    measure = data.usual("response", "y") if y is None else y
    family = _family(whole, data, [measure], x, by)
    given = ax is not None
    with _style.applied(ax):
        drawn = _style.axes_of(ax)
        family.draw(drawn, measure)
        (family.mark_inside if given else family.mark)(drawn)
        drawn.set_xlabel(family.x.label)
        family.explain([drawn], given, legend, colorbar)
    return drawn


@checked
def response_panels(
    table: Any,
    measures: Sequence[str],
    *,
    x: str | None = None,
    by: str | None = None,
    where: Mapping[str, Any] | None = None,
    label: Sequence[str] | None = None,
    legend: bool | str = True,
    colorbar: bool | Axes = True,
    **slices: Any,
) -> Figure:
    """Draw several measures against one parameter, in axes below each other. Each measure is drawn in the same way as
    by `flapwing.plot.response`.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        Results of `sweep`, `evaluate` or `respond`, or the path of a file of results. To compare designs, give the
        results of each design: a mapping of names to results, or a list of results. If you give several results, the
        picture has one line for each of the results.
    measures : sequence of str
        The measures to draw, from top to bottom.
    x : str, optional
        The parameter on the horizontal axis. The default of `x` is ``drive_frequency``. If ``drive_frequency`` does not
        vary, the default of `x` is the last axis of the grid.
    by : str, optional
        The picture has one line for each value of the parameter `by`. If the grid has two or more axes, the default of
        `by` is the first axis that is not on the horizontal axis. If you give several results, you cannot give `by`,
        because the picture has one line for each of the results.
    where, **slices
        Values of columns that select rows, as in `flapwing.plot.response`.
    label : sequence of str, optional
        The name of each result in the legend, if `table` is a list of results. By default, the names are the numbers of
        the results in the list.
    legend, colorbar
        These arguments have the same meaning as in `flapwing.plot.response`.

    Returns
    -------
    matplotlib Figure

    Raises
    ------
    ValueError
        Raised if an argument is invalid (see `response`), or `measures` is empty.

    Examples
    --------
    >>> import numpy as np
    >>> table = {
    ...     "drive_frequency": np.array([90.0, 100.0]),
    ...     "stroke_pp_deg": np.array([20.0, 40.0]),
    ...     "lift_mean_mn": np.array([0.2, 0.5]),
    ... }
    >>> len(response_panels(table, ["stroke_pp_deg", "lift_mean_mn"]).axes)
    2
    """
    if not measures:
        raise ValueError("`measures` is empty: give at least one measure")
    whole, by = _together(table, label, by)
    family = _family(whole, whole.slice(where, slices), measures, x, by)
    with _style.applied():
        figure = _style.new_figure(6.4, 4.0 if len(measures) == 1 else 1.2 + 2.1 * len(measures))
        axes = list(np.atleast_1d(figure.subplots(len(measures), 1, sharex=True)))
        for each, name in zip(axes, measures):
            family.draw(each, name)
        family.mark(axes[0])
        axes[-1].set_xlabel(family.x.label)
        family.explain(axes, False, legend, colorbar)
        figure.align_ylabels(axes)
    return figure


def _together(table: Any, label: Sequence[str] | None, by: str | None) -> tuple[Data, str | None]:
    """Return all results in one table, and the column whose values distinguish the lines of the picture. If `table`
    contains several results, the column that distinguishes the lines contains the names of the results.
    """
    designs = several(table, label)
    if designs is None:
        if label is not None:
            raise ValueError("`label` has names for a list of results, but `table` is one result")
        return Data.of(table), by
    if by is not None:
        raise ValueError("`by` is for one result; several results have one line for each")
    return joined(designs), DESIGN


def _family(whole: Data, data: Data, measures: Sequence[str], x: str | None, by: str | None) -> Family:
    """Return the lines of a picture that shows the measures `measures`."""
    for name in measures:
        data.numbers(name)
    x = along(data, by) if x is None else x
    if by is None:
        by = _beside(data, x)
        if by is not None and not data.on_a_grid(by) and len(distinct(data[by])) > _MOST_SAMPLED:
            raise ValueError(
                f"`{by}` is sampled, and {len(distinct(data[by]))} lines would cover each other: choose a value of "
                f"`{x}` and draw plot.scatter, plot.histogram or plot.tornado, or draw all lines with by={by!r}"
            )
    if not data.on_a_grid(x):
        raise scattered(x)
    data.numbers(x)
    if by is not None:
        data = data.rows(data.on_axis(by))
    data = data.for_picture([x] if by is None else [x, by])
    return Family(data, whole, x, by)


class Family:
    """The lines of one picture. If the picture shows several measures, a line has the same rows and the same colour for
    each measure.
    """

    def __init__(self, data: Data, whole: Data, x: str, by: str | None) -> None:
        self.data, self.x = data, data.shown(x)
        self.by: Shown | None = None if by is None else data.shown(by)
        self.values: np.ndarray = np.array([0.0]) if by is None else distinct(data[by])
        keys = np.zeros(len(data)) if by is None else data[by]
        self.every_x = data.values_along(x, whole)
        self.rows = [self._ordered(np.flatnonzero(keys == value)) for value in self.values]
        self.colours = _style.shades(self.values, self.by is not None and self.by.text)

    def _ordered(self, rows: np.ndarray) -> np.ndarray:
        """Return the numbers of the rows of one line, in rising order of the parameter on the horizontal axis. The
        number -1 stands for a point of the grid that has no row.
        """
        xs = self.data[self.x.name]
        rows = rows[np.argsort(xs[rows], kind="stable")]
        if [self.x.name] not in self.data.grid_axes or not self.data.on_axis(self.x.name).all():
            return rows
        placed = np.full(len(self.every_x), -1)
        placed[np.searchsorted(self.every_x, xs[rows])] = rows
        return placed

    def draw(self, ax: Axes, name: str) -> None:
        measured = self.data.measured()
        shown = self.data.shown(name)
        every_x = self.every_x * self.x.factor
        for value, rows, colour in zip(self.values, self.rows, self.colours):
            there = rows >= 0
            xs = np.where(there, self.x.values[rows], every_x if len(every_x) == len(rows) else np.nan)
            ys = np.where(there & measured[rows], shown.values[rows], np.nan)
            alone = _alone(ys)
            text = None if self.by is None else self.by.value(value)
            ax.plot(
                xs,
                ys,
                color=colour,
                label=text,
                marker="o",
                markersize=_style.size(0.6),
                markevery=list(np.flatnonzero(alone)),
            )
        ax.set_ylabel(shown.label)
        ax.margins(x=0.02)

    def mark(self, ax: Axes) -> None:
        """Draw marks above the axes at points without a periodic motion. The marks of each line of the picture are at a
        separate height.
        """
        lines = self._not_periodic()
        if not lines:
            return
        step = min(0.022, 0.16 / len(lines))
        for place, (rows, colour) in enumerate(lines):
            self._strokes(ax, rows, 1.02 + place * step, colour, clip_on=False)
        statuses = self.data["status"].astype(str)[np.concatenate([rows for rows, _ in lines])]
        counts = ", ".join(f"{np.sum(statuses == status)} {status}" for status in distinct(statuses))
        text = f"marks: no periodic motion ({counts})"
        ax.annotate(
            text.replace(" (", "\n(") if _style.is_narrow() else text,
            (1.0, 1.02 + len(lines) * step),
            xycoords="axes fraction",
            xytext=(0, 2),
            textcoords="offset points",
            ha="right",
            va="bottom",
            fontsize="medium",
            color=_style.ink(ax),
        )

    def mark_inside(self, ax: Axes) -> None:
        """Draw marks for points without a periodic motion inside the axes, along the lower edge. The method extends the
        limits of the axes to make room for the marks.
        """
        lines = self._not_periodic()
        if not lines:
            return
        step = min(0.035, 0.2 / len(lines))
        low, high = ax.get_ylim()
        ax.set_ylim(high - (high - low) / (1.0 - step * (len(lines) + 0.5)), high)
        for place, (rows, colour) in enumerate(lines):
            self._strokes(ax, rows, (place + 0.75) * step, colour)

    def _not_periodic(self) -> list[tuple[np.ndarray, Any]]:
        """Return a list of lines that have points without a periodic motion. The entry for a line contains the row
        numbers of the points without a periodic motion, and the colour of the line.
        """
        without = ~self.data.measured()
        marked = [rows[(rows >= 0) & without[rows]] for rows in self.rows]
        return [(rows, colour) for rows, colour in zip(marked, self.colours) if rows.size]

    def _strokes(self, ax: Axes, rows: np.ndarray, height: float, colour: Any, **options: Any) -> None:
        look = {"markersize": _style.size(0.75), "markeredgewidth": _style.width(0.7), "color": colour}
        _style.marks(ax, self.x.values[rows], height, label="_not periodic", **look, **options)

    def explain(self, axes: list[Axes], given: bool, legend: bool | str, colorbar: bool | Axes) -> None:
        """Draw a legend that explains the lines. If the lines show many values of a parameter, draw a colour bar
        instead.
        """
        handles: list[Any] = []
        if given and self._not_periodic():
            look: Any = {"marker": "|", "linestyle": "none", "color": _style.ink(axes[0])}
            handles = [Line2D([], [], label="no periodic motion", markersize=_style.size(0.75), **look)]
        if self.by is None:
            if handles:
                _style.legend(axes[0], legend, given, handles=handles)
            return
        if self.by.text or len(self.values) <= _style.LEGEND_LINES:
            handles = [
                Line2D([], [], color=colour, label=self.by.value(value))
                for value, colour in zip(self.values, self.colours)
            ] + handles
            # The legend is beside new axes, because a family of responses fills all corners.
            beside = {"loc": "upper left", "bbox_to_anchor": (1.01, 1.0)}
            # A legend outside of the axes has a title in short lines.
            title = self.by.label if given else self.by.label.replace(", ", ",\n").replace(" (", "\n(")
            look = {"handles": handles, "title": title, "alignment": "left", "borderaxespad": 0.0}
            _style.legend(axes[0], legend, given, outside=beside, **look)
            return
        if handles:
            _style.legend(axes[0], legend, given, handles=handles)
        numbers = self.values.astype(float) * self.by.factor
        log = is_log(numbers)
        colours = ListedColormap(self.colours)
        mappable = ScalarMappable(BoundaryNorm(edges(numbers, log), colours.N), colours)
        spacing = "uniform" if log else "proportional"
        bar = _style.colour_bar(axes, mappable, colorbar, label=self.by.label, spacing=spacing)
        if bar is None:
            return
        # Each number takes at least two lines of text, if numbers are evenly spaced along the bar.
        height = 72.0 * bar.ax.get_window_extent().height / _style.figure_of(axes[0]).dpi
        room = max(2, min(12, int(height / (2.0 * bar.ax.yaxis.get_ticklabels()[0].get_fontsize()))))
        shown = numbers[:: -(-len(numbers) // room)]
        bar.set_ticks(list(shown), labels=[f"{number:{'.3g' if log else '.4g'}}" for number in shown])
        bar.minorticks_off()


def along(data: Data, by: str | None) -> str:
    """Return the parameter that is on the horizontal axis by default."""
    axes = [name for name in data.axes() if by is None or name != data.axis(by)]
    if "drive_frequency" in data and ("drive_frequency" in axes or not axes):
        return "drive_frequency"
    numbers = [name for name in axes if not data.shown(name).text]
    if numbers:
        return next((name for name in reversed(numbers) if data.on_a_grid(name)), numbers[0])
    raise unknown("parameter for", "x", data.columns)


def _beside(data: Data, x: str) -> str | None:
    """Return the default parameter that distinguishes the lines: the first axis of the grid that is not on the
    horizontal axis. Return None if the only axis is the horizontal axis.
    """
    left = [name for name in data.axes() if name != data.axis(x)]
    if x not in data.parameters():
        return None
    return left[0] if left else None


def _alone(ys: np.ndarray) -> np.ndarray:
    """Return a mask that is True for a value whose neighbours are missing. A line cannot show a value without
    neighbours, so the picture shows the value with a marker.
    """
    there = np.isfinite(ys)
    before = np.concatenate([[False], there[:-1]])
    after = np.concatenate([there[1:], [False]])
    return there & ~before & ~after
