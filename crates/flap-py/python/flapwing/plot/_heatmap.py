"""A picture that shows a measure by colours in the plane of two parameters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import Colormap, to_rgba
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from .. import _labels
from .._data import Data, Shown, distinct, edges, is_text
from .._flapwing import is_log
from .._labels import better
from . import _scales, _style
from ._checks import checked
from ._triangles import Points, form_no_grid

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
    reduce: str | None = None,
    annotate: bool = False,
    where: Mapping[str, Any] | None = None,
    legend: bool | str = True,
    colorbar: bool | Axes = True,
    ax: Axes | None = None,
    **slices: Any,
) -> _style.Drawn:
    """Draw a measure by colours in the plane of two parameters, for example lift, power or efficiency against frequency
    and voltage.

    The picture has a cell for each point of the grid, and the edges of the cells are halfway between neighbouring
    values. On a logarithmic axis, the edges are halfway between the logarithms of the values. Cells without a periodic
    motion are grey. A cell is hatched if ``[where]`` excludes the row of the cell, or if the row is not in the file. A
    legend explains grey and hatched cells. In results of `flapwing.respond`, the curves of different designs have
    different points. If a cell between the ends of a response curve has no row, the cell shows the nearest row of the
    curve.

    If the points do not form a grid, for example in a sample, each point is drawn as a dot. Between the dots, the
    picture shows colours that are interpolated linearly on triangles. A triangle is left out if one of its three
    corners has no value. Markers such as crosses show points without a periodic motion.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        Results of a sweep over a grid or of a sample.
    value : str, optional
        The measure to draw. The default of `value` is the mean lift.
    x, y : str, optional
        The parameters on the horizontal and on the vertical axis. The values of a parameter are numbers or words. The
        default of `x` is ``drive_frequency``. If ``drive_frequency`` does not vary, the default of `x` is the last axis
        of the grid. The default of `y` is the first axis of the grid that is not on the horizontal axis. If the grid
        has fewer than two axes, flap chooses parameters of the sample.
    xscale, yscale : {"linear", "log"}, optional
        The scales of the axes. By default, an axis is logarithmic if its values have a constant ratio and span a factor
        of ten or more. If the points do not form a grid, the default scale is linear.
    cmap : str, optional
        A colour map of matplotlib. The default of `cmap` is viridis. If the measure has positive and negative values,
        the default colour map is white at zero, and a line marks the value zero.
    vmin, vmax : float, optional
        The values at the ends of the colour bar, in the unit of the colour bar. By default, `vmin` is the smallest and
        `vmax` is the largest value of the measure in the picture. An end of the colour bar has an arrow if the measure
        has values beyond this end.
    reduce : {"max", "min", "mean"}, optional
        The value of a cell to which several rows belong: the largest value, the smallest value or the mean of these
        rows. Several rows belong to a cell if the grid has axes that are not drawn. Rows without a value are left out.
    annotate : bool
        If True, a star marks the cell with the best value. The legend contains the value and the parameters of the best
        cell. With ``reduce="max"`` or ``reduce="min"``, the legend also contains the cell's values on the axes that are
        not drawn. The best cell has the largest value with ``reduce="max"``, and the smallest value with
        ``reduce="min"``. If `reduce` is neither ``"max"`` nor ``"min"``, the best cell has the smallest value of a cost
        such as power, and the largest value of other measures.
    where, **slices
        Values of columns that select rows, as in `flapwing.plot.response`. If you give `reduce` and select no value of
        an axis that is not drawn, `reduce` combines the rows at all values of this axis.
    legend, colorbar, ax
        These arguments have the same meaning as in `flapwing.plot.response`.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    ValueError
        Raised if a column or value is unknown. Raised if several rows belong to one cell, and `reduce` is not given.
        Raised if the points do not form a grid, and all points are on one line.

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
    if reduce not in (None, "max", "min", "mean"):
        raise ValueError(f'`reduce` is {reduce!r}\nit must be "max", "min" or "mean"')
    whole = Data.of(table)
    data = whole.slice(where, slices)
    value = data.usual("benefit", "value") if value is None else value
    data.numbers(value)
    x, y = _two_axes(data, x, y)
    unreduced = data
    if reduce is None:
        try:
            data = data.for_picture([x, y], ', and reduce="max" draws the largest of all')
        except ValueError as error:
            raise ValueError(f'{error}\nor combine these rows with reduce="max", "min" or "mean"') from None
    else:
        data = _reduced(data, [x, y], value, reduce)
    picture: _Cells | Points
    if form_no_grid(data, x, y):
        values = np.where(data.measured(), data.shown(value).values, np.nan)
        picture = Points(data, x, y, (xscale, yscale), values)
    else:
        picture = _Cells(data, whole, value, x, y, xscale, yscale)
    colours = _scales.colours(picture.values, cmap, vmin, vmax)

    given = ax is not None
    with _style.applied(ax):
        ax = _style.axes_of(ax, 6.4, 4.4)
        ax.grid(False)
        colours.bar(ax, picture.draw(ax, colours), colorbar, data.shown(value).label)
        entries = picture.mark_missing(ax, _missing(data, picture.rows, picture.values))
        if annotate and np.isfinite(picture.values).any():
            smallest = reduce == "min" or (reduce != "max" and better(value) < 0)
            row, place = picture.best(smallest)
            names = [x, y, *(_combined(unreduced, x, y) if reduce in ("max", "min") else [])]
            entries.append(_star(ax, place, _best_text(data, row, value, names)))
        picture.finish(ax)
        if entries:
            look: Any = {"handles": entries, "handlelength": 1.6, "handleheight": 1.1}
            _style.legend(ax, legend, given, inside="upper left", ncols=3, borderaxespad=0.2, **look)
    return ax


def _reduced(data: Data, names: Sequence[str], value: str, how: str) -> Data:
    """Return one row for each combination of values in the columns `names`. The returned row contains the largest
    value, the smallest value or the mean of all rows with the same combination of values.
    """
    groups = data.groups(names)
    values = np.where(data.measured(), data.numbers(value), np.nan)
    there = np.isfinite(values)
    # Rows without a value are last, so they are chosen only if their cell has no other rows.
    order = np.lexsort((np.where(there, -values if how == "max" else values, np.inf), groups))
    chosen = order[np.unique(groups[order], return_index=True)[1]]
    reduced = data.rows(chosen)
    if how == "mean":
        count = np.bincount(groups[there], minlength=len(chosen))
        total = np.bincount(groups[there], values[there], minlength=len(chosen))
        mean = np.divide(total, count, out=np.full(len(chosen), np.nan), where=count > 0)
        reduced.columns[value] = mean[groups[chosen]]
    return reduced


def _combined(data: Data, x: str, y: str) -> list[str]:
    """Return the parameters that have several values and are not on an axis of the map."""
    drawn = {data.axis(x), data.axis(y)}
    names = [name for name in data.parameters() if name not in (x, y) and len(distinct(data[name])) > 1]
    return [name for name in names if data.axis(name) not in drawn or not data.on_a_grid(name)]


def _best_text(data: Data, row: int, value: str, names: Sequence[str]) -> str:
    """Return the text of the legend for the best row: the value of the measure, and a line for each parameter."""
    lines = []
    for name in (value, *names):
        shown = data.shown(name)
        lines.append(f"{_labels.lowered(shown.words)}: {shown.value(data[name][row])} {shown.unit}".rstrip())
    return "\n".join([f"best {lines[0]}", *(f"  {line}" for line in lines[1:])])


def _star(ax: Axes, place: tuple[float, float], label: str) -> Line2D:
    """Draw a star at a position in the map, and return the star for the legend."""
    look: Any = {"marker": "*", "linestyle": "none", "markersize": _style.size(2.0), "color": "white"}
    (line,) = ax.plot(*place, label=label, markeredgecolor=_style.DARK, markeredgewidth=_style.width(0.5), **look)
    return line


class _Cells:
    """A map of a measure for points that form a grid, with a cell around each point."""

    def __init__(
        self, data: Data, whole: Data, value: str, x: str, y: str, xscale: str | None, yscale: str | None
    ) -> None:
        self.across, self.up = across, up = _Axis(data, whole, x, xscale), _Axis(data, whole, y, yscale)
        rows = np.full((up.count, across.count), -1)
        rows[up.places(data[y]), across.places(data[x])] = np.arange(len(data))
        followed = data.followed()
        if followed == x:
            rows = _along_curves(rows, across)
        elif followed == y:
            rows = _along_curves(rows.T, up).T
        self.rows = rows
        self.values: np.ndarray = np.where((rows >= 0) & data.measured()[rows], data.shown(value).values[rows], np.nan)

    def draw(self, ax: Axes, colours: _scales.Colours) -> Any:
        masked = np.ma.masked_invalid(self.values)
        look: Any = {"cmap": colours.cmap, "norm": colours.norm, "rasterized": True}
        mesh = ax.pcolormesh(self.across.edges, self.up.edges, masked, **look)
        if colours.signed and min(masked.shape) > 1:
            look = {"colors": _style.DARK, "linewidths": _style.width(0.6)}
            ax.contour(self.across.centres, self.up.centres, masked, [0.0], **look)
        return mesh

    def mark_missing(self, ax: Axes, missing: Mapping[str, np.ndarray]) -> list[Any]:
        """Fill the cells without a value with a grey or a hatching, and return the entries of the legend for these
        cells.
        """
        entries = []
        for name, mask in missing.items():
            # Several cells along a curve may show the same row.
            count = int(mask.sum()) if name == _NO_ROW else len(np.unique(self.rows[mask]))
            entries.append(_fill(ax, self.across.edges, self.up.edges, mask, name, count))
        return entries

    def best(self, smallest: bool) -> tuple[int, tuple[float, float]]:
        """Return the number of the row with the best value of the measure, and the centre of this row's cell."""
        cell = int(np.nanargmin(self.values) if smallest else np.nanargmax(self.values))
        line, column = np.unravel_index(cell, self.values.shape)
        return int(self.rows[line, column]), (float(self.across.centres[column]), float(self.up.centres[line]))

    def finish(self, ax: Axes) -> None:
        self.across.finish(ax, "x")
        self.up.finish(ax, "y")


class _Axis:
    """The values along one axis of a map, and the edges of the cells."""

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
        self.log = is_log(values) if scale is None else scale == "log"
        if self.log and values[0] <= 0:
            raise ValueError(f"`{name}` cannot have a logarithmic scale: its smallest value is {self.keys[0]:g}")
        self.edges = edges(values, self.log)

    def places(self, column: np.ndarray) -> np.ndarray:
        """Return, for each row of results, the index of its cell along this axis."""
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
    """Return the number of the row of results that each cell shows. Each line of the array `rows` contains the row
    numbers of one curve.

    A cell without a row between the ends of a curve shows the nearest row of this curve.
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
    """Return the parameters on the horizontal and on the vertical axis. If `x` or `y` is None, an axis of the grid or a
    parameter of the sample is chosen.
    """
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
        numbers = [name for name in data.parameters() if not is_text(data[name]) and len(distinct(data[name])) > 1]
        free = [name for name in numbers if not data.grid_axes or not data.on_a_grid(name)]
        left += [name for name in free if name not in (*left, x, y)]
    if len(left) < 2 - len(named):
        there = ", ".join([*named, *left]) or "none"
        raise ValueError(f"a map requires two axes with more than one value each; the table has: {there}")
    # As in `flap plot`: the drive frequency, else the last axis, along x; the first of the others along y.
    across = x or ("drive_frequency" if "drive_frequency" in left else left[-1])
    return across, y or next(name for name in left if name != across)


def _missing(data: Data, rows: np.ndarray, values: np.ndarray) -> dict[str, np.ndarray]:
    """Return a mask of cells without a value for each possible reason, such as a status of the motion or a missing
    row.
    """
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
    """Fill the cells in `mask` with a grey or a hatching, and return the entry of the legend for these cells."""
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
    """Return rectangles that cover the cells in `mask`. Neighbouring cells in the same line of the map get one
    rectangle.
    """
    outlines = []
    for row, flags in enumerate(mask):
        ends = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(int)))
        for first, behind in zip(ends[::2], ends[1::2]):
            left, right, low, high = across[first], across[behind], up[row], up[row + 1]
            outlines.append([(left, low), (right, low), (right, high), (left, high)])
    return outlines
