"""A picture of a measure against two axes, as a map of colours."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import Colormap, to_rgba
from matplotlib.patches import Patch

from .._data import Data, Shown, distinct, edges, scattered
from . import _scales, _style
from ._checks import checked

# Statuses without measures, and the greys of their cells.
_GREYS = {
    "subharmonic": "#8c8c8c",
    "unsettled": "#b5b5b5",
    "diverged": "#5e5e5e",
    "step_limit": "#454545",
    "invalid": "#2b2b2b",
}
_UNDEFINED, _NO_ROW = "no value", "no row"


@checked
def heatmap(
    table: Any,
    value: str | None = None,
    *,
    x: str | None = None,
    y: str | None = None,
    xscale: str | None = None,
    yscale: str | None = None,
    cmap: str | Colormap | None = None,
    vmin: float | None = None,
    vmax: float | None = None,
    where: Mapping[str, Any] | None = None,
    legend: bool | str = True,
    colorbar: bool | Axes = True,
    ax: Axes | None = None,
    **slices: Any,
) -> _style.Drawn:
    """Draw a measure as a map against two axes, for example lift, power or efficiency against frequency and voltage.

    The edges of cells are halfway between neighbouring values of an axis, or between their logarithms on a logarithmic
    axis. Cells without a periodic motion are grey. Cells without a row, which ``[where]`` excludes or the file does not
    have, are hatched. A legend explains grey and hatched cells. In a table of `respond`, curves were refined at
    different points. In this case, a cell without a row shows the nearest row of the same curve.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        Results of a sweep over a grid.
    value : str, optional
        The measure. Default: the mean lift.
    x, y : str, optional
        The parameters on the axes: numbers or words. Default for x: ``drive_frequency``, or the last axis of the grid
        if ``drive_frequency`` does not vary. Default for y: the first of the other axes.
    xscale, yscale : {"linear", "log"}, optional
        The scales of the axes. By default, a scale is logarithmic if neighbouring values have a constant ratio.
    cmap : str, optional
        A colour map of matplotlib. Default: viridis. For values of both signs, a map that is white at zero, with a line
        at zero.
    vmin, vmax : float, optional
        The ends of the colours, in the unit of the colour bar. Default: the smallest and the largest value. An arrow at
        an end of the colour bar marks values beyond this end.
    where, **slices
        Values of columns, which select the rows to draw: numbers in SI units, text with units, or words. Give these
        values in the mapping `where`, or as keywords such as ``drive_voltage_pp="100 V"``. If an axis of the grid is
        neither drawn nor selected, the picture has only the rows at its middle value. A warning shows this value.
    legend : bool or str
        False for no legend, or a place inside the axes such as ``"upper left"``. By default, the legend is beside new
        axes, but inside axes that you give.
    colorbar : bool or matplotlib Axes
        False for no colour bar, or the axes for the colour bar. By default, the colour bar is beside the picture, which
        becomes smaller.
    ax : matplotlib Axes, optional
        Axes for the picture, in the style of their figure. Only labels and a colour bar are outside of these axes.
        Default: axes of a new figure.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    ValueError
        A column or value is unknown, or several rows are in one cell.

    Examples
    --------
    >>> import numpy as np
    >>> table = {
    ...     "drive_voltage_pp": np.array([100.0, 100.0, 200.0, 200.0]),
    ...     "drive_frequency": np.array([90.0, 100.0, 90.0, 100.0]),
    ...     "status": np.array(["periodic"] * 4),
    ...     "lift_mean_mn": np.array([0.1, 0.2, 0.3, 0.5]),
    ... }
    >>> ax = heatmap(table, "lift_mean_mn")
    >>> [float(end) for end in ax.get_xlim()]
    [85.0, 105.0]
    """
    whole = Data.of(table)
    data = whole.slice(where, slices)
    value = data.usual("benefit", "value") if value is None else value
    data.numbers(value)
    x, y = _two_axes(data, x, y)
    for name in (x, y):
        if not data.on_a_grid(name):
            raise scattered(name)
    data = data.for_picture([x, y])

    shown, across, up = data.shown(value), _Axis(data, whole, x, xscale), _Axis(data, whole, y, yscale)
    rows = np.full((up.count, across.count), -1)
    rows[up.places(data[y]), across.places(data[x])] = np.arange(len(data))
    followed = data.followed()
    if followed == x:
        rows = _along_curves(rows, across)
    elif followed == y:
        rows = _along_curves(rows.T, up).T
    measured = data.measured()
    values = np.where((rows >= 0) & measured[rows], shown.values[rows], np.nan)

    colours = _scales.colours(values, cmap, vmin, vmax)

    given = ax is not None
    with _style.style(ax):
        ax = _style.axes_of(ax, 6.4, 4.4)
        ax.grid(False)
        masked = np.ma.masked_invalid(values)
        mesh = ax.pcolormesh(across.edges, up.edges, masked, cmap=colours.cmap, norm=colours.norm, rasterized=True)
        if colours.signed and min(values.shape) > 1:
            look: Any = {"colors": _style.DARK, "linewidths": _style.width(0.6)}
            ax.contour(across.centres, up.centres, masked, [0.0], **look)
        colours.bar(ax, mesh, colorbar, shown.label)
        missing = []
        for name, mask in _missing(data, rows, values).items():
            # Several cells along a curve may show the same row.
            count = int(mask.sum()) if name == _NO_ROW else len(np.unique(rows[mask]))
            missing.append(_fill(ax, across.edges, up.edges, mask, name, count))
        across.finish(ax, "x")
        up.finish(ax, "y")
        if missing:
            look = {"handles": missing, "handlelength": 1.6, "handleheight": 1.1}
            _style.legend(ax, legend, given, inside="upper left", ncols=3, borderaxespad=0.2, **look)
    return ax


class _Axis:
    """The values along one axis and the edges of their cells."""

    def __init__(self, data: Data, whole: Data, name: str, scale: str | None) -> None:
        self.shown: Shown = data.shown(name)
        self.keys = data.values_along(name, whole)
        self.count = len(self.keys)
        if self.shown.text:
            self.log, self.edges = False, np.arange(self.count + 1) - 0.5
            self.centres = np.arange(self.count, dtype=float)
            return
        if scale not in (None, "linear", "log"):
            raise ValueError(f'a scale is "linear" or "log", not {scale!r}')
        self.centres = values = self.keys.astype(float) * self.shown.factor
        self.log = _scales.in_ratio(values) if scale is None else scale == "log"
        if self.log and values[0] <= 0:
            raise ValueError(f"`{name}` cannot have a logarithmic scale: its smallest value is {self.keys[0]:g}")
        self.edges = edges(values, self.log)

    def places(self, column: np.ndarray) -> np.ndarray:
        """Return the cell of each row."""
        if self.shown.text:
            place = {word: i for i, word in enumerate(self.keys)}
            return np.array([place[word] for word in column.astype(str)])
        return np.searchsorted(self.keys, column)

    def finish(self, ax: Axes, which: str) -> None:
        axis = ax.xaxis if which == "x" else ax.yaxis
        (ax.set_xlabel if which == "x" else ax.set_ylabel)(self.shown.label)
        if self.shown.text:
            axis.set_ticks(range(self.count), labels=list(self.keys))
            return
        if self.log:
            (ax.set_xscale if which == "x" else ax.set_yscale)("log")
            _scales.show_log_ticks(axis, self.edges[0], self.edges[-1])
        (ax.set_xlim if which == "x" else ax.set_ylim)(self.edges[0], self.edges[-1])


def _along_curves(rows: np.ndarray, axis: _Axis) -> np.ndarray:
    """Return the rows of cells, with one curve in each line of cells. Cells between the ends of a curve get the nearest
    row of the curve.
    """
    filled = rows.copy()
    places = np.log(axis.centres) if axis.log else axis.centres
    for line in filled:
        own = np.flatnonzero(line >= 0)
        if own.size:
            between = np.arange(own[0], own[-1] + 1)
            distances = np.abs(places[between, None] - places[own])
            line[between] = line[own[np.argmin(distances, axis=1)]]
    return filled


def _two_axes(data: Data, x: str | None, y: str | None) -> tuple[str, str]:
    """Return the parameters along x and y. If x or y is not given, an axis of the grid is chosen."""
    for name in (x, y):
        if name is not None:
            data[name]
    if x is not None and y is not None:
        if x == y:
            raise ValueError(f"`x` and `y` are both `{x}`")
        return x, y
    named = [data.axis(name) for name in (x, y) if name is not None]
    left = [name for name in data.axes() if name not in named]
    if len(left) < 2 - len(named):
        there = ", ".join([*named, *left]) or "none"
        raise ValueError(f"a map requires two axes with more than one value each; the table has: {there}")
    # As in `flap plot`: the drive frequency, else the last axis, along x; the first of the others along y.
    across = x or ("drive_frequency" if "drive_frequency" in left else left[-1])
    return across, y or next(name for name in left if name != across)


def _missing(data: Data, rows: np.ndarray, values: np.ndarray) -> dict[str, np.ndarray]:
    """Return the masks of cells without a value, one mask for each reason."""
    empty = ~np.isfinite(values)
    reasons: dict[str, np.ndarray] = {}
    if "status" in data:
        statuses = data["status"].astype(str)[rows]
        without = empty & (rows >= 0) & ~data.measured()[rows]
        for status in distinct(statuses[without]):
            reasons[str(status)] = without & (statuses == status)
    undefined = empty & (rows >= 0) & data.measured()[rows]
    for name, mask in ((_UNDEFINED, undefined), (_NO_ROW, empty & (rows < 0))):
        if mask.any():
            reasons[name] = mask
    return reasons


def _fill(ax: Axes, across: np.ndarray, up: np.ndarray, mask: np.ndarray, name: str, count: int) -> Patch:
    """Fill the cells without a value, and return their entry of the legend."""
    text = f"{name} ({count})"
    if name in (_NO_ROW, _UNDEFINED):
        hatch = "////" if name == _NO_ROW else "...."
        # No colour map is used, so that only these cells are drawn.
        ax.add_collection(
            PolyCollection(
                _runs(across, up, mask), facecolors="none", edgecolors="#9a9a9a", linewidths=0.0, hatch=hatch
            )
        )
        return Patch(facecolor=ax.get_facecolor(), edgecolor="#9a9a9a", hatch=hatch, linewidth=0.6, label=text)
    colour = _GREYS.get(name, "#707070")
    layer = np.zeros((*mask.shape, 4))
    layer[mask] = to_rgba(colour)
    ax.pcolormesh(across, up, layer, rasterized=True)
    return Patch(color=colour, label=text)


def _runs(across: np.ndarray, up: np.ndarray, mask: np.ndarray) -> list[list[tuple[float, float]]]:
    """For every row of cells, return the outlines of groups of neighbouring cells."""
    outlines = []
    for row, flags in enumerate(mask):
        ends = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(int)))
        for first, behind in zip(ends[::2], ends[1::2]):
            left, right, low, high = across[first], across[behind], up[row], up[row + 1]
            outlines.append([(left, low), (right, low), (right, high), (left, high)])
    return outlines
