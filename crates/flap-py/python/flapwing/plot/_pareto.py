"""A picture of designs as points in the plane of two objectives, with the Pareto front."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Colormap

from .._data import Data
from ..analysis import non_dominated
from . import _style
from ._checks import checked
from ._scatter import points


@checked
def pareto(
    table: Any,
    *,
    maximize: str | Sequence[str] = (),
    minimize: str | Sequence[str] = (),
    color: str | None = None,
    cmap: str | Colormap | None = None,
    where: Mapping[str, Any] | None = None,
    legend: bool | str = True,
    colorbar: bool | Axes = True,
    ax: Axes | None = None,
    **slices: Any,
) -> _style.Drawn:
    """Draw designs as points in the plane of two objectives, and mark the Pareto front: the designs that no other
    design dominates.

    A design is left out if it has no periodic motion, or if one of its objectives is NaN.
    `flapwing.analysis.non_dominated` computes the front. Rings mark the designs on the Pareto front. If you give two
    objectives, a stepped line also connects the designs on the Pareto front.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        Results of any flap computation, with one row for each design.
    maximize, minimize : str or sequence of str
        At least two measures whose values are to be maximised or minimised. The axes show the first measure that is
        minimised and the first measure that is maximised. If all measures are minimised or all are maximised, the axes
        show the first two measures. By default, the mean lift is maximised and the mean power is minimised.
    color : str, optional
        The column that sets the colours of the points. A colour bar explains the colours of numbers, and a legend
        explains the colours of words.
    cmap : str, optional
        A colour map of matplotlib, if `color` is a column of numbers. The default of `cmap` is the same as in
        `flapwing.plot.heatmap`.
    where, **slices
        Values of columns that select rows, as in `flapwing.plot.response`. If you select no value of an axis, the
        picture shows the designs at all values of this axis. If a sample is combined with an axis, the picture also
        shows the designs at all values of the axis.
    legend, colorbar, ax
        These arguments have the same meaning as in `flapwing.plot.response`.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    ValueError
        Raised if fewer than two objectives are given. Raised if a column or value is unknown. Raised if no design has a
        value of every objective.

    Examples
    --------
    >>> import numpy as np
    >>> table = {"lift_mean_mn": np.array([1.0, 2.0, 1.5]), "power_mean_mw": np.array([5.0, 9.0, 9.5])}
    >>> ax = pareto(table, maximize="lift_mean_mn", minimize="power_mean_mw")
    >>> ax.lines[0].get_label()
    'front (2 of 3 designs)'
    """
    data = Data.of(table).slice(where, slices)
    smaller = [minimize] if isinstance(minimize, str) else list(minimize)
    larger = [maximize] if isinstance(maximize, str) else list(maximize)
    if not smaller and not larger:
        larger = [data.usual("benefit", "maximize")]
        smaller = [data.usual("cost", "minimize", larger)]
    objectives = [*smaller, *larger]
    if len(objectives) < 2 or len(set(objectives)) < len(objectives):
        raise ValueError(f"at least two different objectives are required, not {objectives}")
    # A cost is drawn along x. If both objectives are costs or benefits, the first is.
    names = [smaller[0], larger[0]] if smaller and larger else objectives[:2]
    costs = np.column_stack([data.numbers(name) for name in smaller] + [-data.numbers(name) for name in larger])
    there = data.measured() & ~np.isnan(costs).any(axis=1)
    if not there.any():
        raise ValueError("no row has a number for each objective")
    if color is not None:
        data[color]
    data, front = data.rows(there), non_dominated(costs[there])
    x, y = data.shown(names[0]), data.shown(names[1])

    given = ax is not None
    with _style.applied(ax):
        ax = _style.axes_of(ax, 6.4, 4.4)
        size = points(ax, data, x.values, y.values, color, cmap, colorbar)
        order = np.flatnonzero(front)
        order = order[np.lexsort((y.values[order], x.values[order]))]
        designs = "design" if len(data) == 1 else "designs"
        ax.plot(
            x.values[order],
            y.values[order],
            color=_style.ink(ax),
            linewidth=_style.width(0.6),
            linestyle="-" if len(objectives) == 2 else "none",
            drawstyle="steps-post" if names[0] in smaller else "steps-pre",
            # Rings are drawn behind the points, so that the points' colours stay visible.
            marker="o",
            markersize=size + _style.size(0.35),
            markerfacecolor="none",
            markeredgewidth=_style.width(0.4),
            zorder=0.9,
            label=f"front ({len(order)} of {len(data)} {designs})",
        )
        for label, shown, which in ((ax.set_xlabel, x, names[0]), (ax.set_ylabel, y, names[1])):
            label(f"{shown.label}, {'less' if which in smaller else 'more'} is better")
        handles, _ = ax.get_legend_handles_labels()
        others = [name for name in objectives if name not in names]
        further = ", ".join(f"{data.shown(name).words} ({'less' if name in smaller else 'more'})" for name in others)
        title: Any = {"title": f"further objectives of the front: {further}", "alignment": "left"} if others else {}
        # Inside, in a corner without designs.
        corner = f"{'lower' if names[1] in smaller else 'upper'} {'left' if names[0] in smaller else 'right'}"
        _style.legend(ax, legend, given, inside=corner, handles=handles, ncols=4, borderaxespad=0.2, **title)
    return ax
