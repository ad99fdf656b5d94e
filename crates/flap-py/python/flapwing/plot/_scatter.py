"""A picture of designs as points in the plane of two measures. The colours of the points show a third measure."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Colormap

from .._data import Data, distinct
from .._flapwing import is_log
from . import _scales, _style
from ._checks import checked


@checked
def scatter(
    table: Any,
    x: str | None = None,
    y: str | None = None,
    *,
    color: str | None = None,
    cmap: str | Colormap | None = None,
    where: Mapping[str, Any] | None = None,
    legend: bool | str = True,
    colorbar: bool | Axes = True,
    ax: Axes | None = None,
    **slices: Any,
) -> _style.Drawn:
    """Draw designs as points in the plane of two measures. The colour of a point shows a third measure.

    Designs without a periodic motion are left out.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        Results of any flap computation, with one row for each design.
    x, y : str, optional
        Columns of numbers. The default of `x` is the mean power, and the default of `y` is the mean lift. If the table
        has no mean power or no mean lift, flap chooses a different measure.
    color : str, optional
        The column that sets the colours of the points. A colour bar explains the colours of numbers, and a legend
        explains the colours of words. The default of `color` is the peak-to-peak stroke. If the table has no
        peak-to-peak stroke, flap chooses a different measure.
    cmap : str, optional
        A colour map of matplotlib, if `color` is a column of numbers. The default of `cmap` is the same as in
        `flapwing.plot.heatmap`.
    where, **slices
        Values of columns that select rows, as in `flapwing.plot.response`. In results of a grid without a sample, all
        values of an axis are used if you select no value. If a sample is combined with an axis that is not drawn and
        you select no value, only the axis's middle value is used.
    legend, colorbar, ax
        These arguments have the same meaning as in `flapwing.plot.response`.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    ValueError
        Raised if a column or value is unknown, or if no design has values of both measures on the axes.

    Examples
    --------
    >>> import numpy as np
    >>> table = {"lift_mean_mn": np.array([1.0, 2.0, 1.5]), "power_mean_mw": np.array([5.0, 9.0, 9.5])}
    >>> ax = scatter(table)
    >>> (ax.get_xlabel(), ax.get_ylabel())
    ('Power, mean (mW)', 'Lift, mean (mN)')
    """
    data = Data.of(table).slice(where, slices)
    named = [name for name in (x, y, color) if name is not None]
    data = data.one_sample(named)
    x = data.usual("cost", "x", named) if x is None else x
    y = data.usual("benefit", "y", [*named, x]) if y is None else y
    if color is None:
        color = _third(data, [*named, x, y])
    there = data.measured() & np.isfinite(data.numbers(x)) & np.isfinite(data.numbers(y))
    if not there.any():
        raise ValueError(f"no row has a number for `{x}` and `{y}`")
    if color is not None:
        data[color]
    data = data.rows(there)
    across, up = data.shown(x), data.shown(y)

    given = ax is not None
    with _style.applied(ax):
        ax = _style.axes_of(ax, 6.4, 4.4)
        points(ax, data, across.values, up.values, color, cmap, colorbar)
        ax.set_xlabel(across.label)
        ax.set_ylabel(up.label)
        if color is not None and data.shown(color).text:
            _style.legend(ax, legend, given, ncols=4, borderaxespad=0.2)
    return ax


def _third(data: Data, taken: list[str]) -> str | None:
    """Return the measure that sets the colours by default. The measure for the colours differs from the measures on the
    two axes. Return None if the table contains no other measure.
    """
    try:
        return data.usual("motion", "color", taken)
    except ValueError:
        return None


def points(
    ax: Axes,
    data: Data,
    x: np.ndarray,
    y: np.ndarray,
    color: str | None,
    cmap: str | Colormap | None,
    colorbar: bool | Axes,
) -> float:
    """Draw designs as points with colours that show the values in a column, and return the size of the points."""
    size = _style.size(0.62 if len(data) <= 2000 else 0.4)
    look: dict[str, Any] = {"s": size**2, "linewidths": 0, "alpha": 0.9, "rasterized": True}
    if color is None:
        ax.scatter(x, y, color=_style.PLAIN, **look)
        return size
    shown = data.shown(color)
    if not shown.text:
        colours = _scales.colours(shown.values, cmap, log=is_log(distinct(shown.values)))
        drawn = ax.scatter(x, y, c=shown.values, cmap=colours.cmap, norm=colours.norm, **{**look, "alpha": None})
        colours.bar(ax, drawn, colorbar, shown.label)
        return size
    words = distinct(data[color])
    for word, shade in zip(words, _style.shades(words, True)):
        mask = data[color].astype(str) == word
        ax.scatter(x[mask], y[mask], color=shade, label=str(word), **look)
    return size
