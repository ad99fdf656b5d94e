"""Designs in the plane of two measures, in the colours of a third."""

from __future__ import annotations

from typing import Any, Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Colormap

from . import _legend, _style
from ._checks import checked
from ._data import Data
from ._docs import completed
from ._points import points


@checked
@completed
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
    """Draw designs, such as those of a sample, in the plane of two measures and in the colours of a third.

    Designs without a periodic motion are left out.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        Results of any kind.
    x, y : str, optional
        Columns of numbers. By default the mean power along x and the mean lift along y, or other measures of the table.
    color : str, optional
        A column for the points' colours: numbers with a colour bar, words with a legend. By default the stroke, peak to
        peak, or another measure.
    cmap : str, optional
        A colour map of matplotlib, for numbers; by default as for `heatmap`.
    %(where)s
    %(legend)s
    %(colorbar)s
    %(axes)s

    Raises
    ------
    ValueError
        An unknown column or value; no design that has both columns.

    Examples
    --------
    >>> import numpy as np
    >>> table = {"lift_mean_mn": np.array([1.0, 2.0, 1.5]), "power_mean_mw": np.array([5.0, 9.0, 9.5])}
    >>> ax = scatter(table)
    >>> (ax.get_xlabel(), ax.get_ylabel())
    ('Power, mean (mW)', 'Lift, mean (mN)')
    """
    data = Data.of(table).slice(where, slices)
    data = data.one_sample([name for name in (x, y) if name is not None])
    named = [name for name in (x, y, color) if name is not None]
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
    with _style.style(ax):
        ax = _style.axes_of(ax, 6.4, 4.4)
        points(ax, data, across.values, up.values, color, cmap, colorbar)
        ax.set_xlabel(across.label)
        ax.set_ylabel(up.label)
        if color is not None and data.shown(color).text:
            _legend.legend(ax, legend, given, ncols=4, borderaxespad=0.2)
    return ax


def _third(data: Data, taken: list[str]) -> str | None:
    """The usual measure beside two others; None if the table has no other."""
    try:
        return data.usual("motion", "color", taken)
    except ValueError:
        return None
