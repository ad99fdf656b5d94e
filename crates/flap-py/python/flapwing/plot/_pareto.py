"""Designs in the plane of two objectives, and those that no other beats."""

from __future__ import annotations

from typing import Any, Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes

from . import _legend, _scales, _style
from ._data import Data, distinct
from ._docs import completed
from ._front import non_dominated


@completed
def pareto(
    table: Any,
    *,
    maximize: str | Sequence[str] = (),
    minimize: str | Sequence[str] = (),
    color: str | None = None,
    cmap: str | None = None,
    where: Mapping[str, Any] | None = None,
    legend: bool | str = True,
    colorbar: bool | Axes = True,
    ax: Axes | None = None,
    **slices: Any,
) -> _style.Drawn:
    """Draw designs in the plane of two objectives, with the Pareto front: the designs that no other design beats.

    Designs without a periodic motion, or with a NaN among the objectives, are left out. The front's designs are
    those of ``non_dominated``. With two objectives a stepped line bounds the values that they reach; with more they have
    rings.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        Results of any kind.
    maximize, minimize : str or sequence of str
        The objectives, two or more in all. The first two are drawn: what is minimised first along x.
    color : str, optional
        A column for the points' colours: numbers with a colour bar, words with a legend.
    cmap : str, optional
        A colour map of matplotlib, for numbers; by default as for `heatmap`.
    %(where)s
    %(legend)s
    %(colorbar)s
    %(axes)s

    Raises
    ------
    ValueError
        Fewer than two objectives; an unknown column or value; no design that has all objectives.

    Examples
    --------
    >>> import numpy as np
    >>> table = {"lift_mean_mn": np.array([1.0, 2.0, 1.5]), "power_mean_mw": np.array([5.0, 9.0, 9.5])}
    >>> ax = pareto(table, maximize="lift_mean_mn", minimize="power_mean_mw")
    >>> ax.lines[0].get_label()
    'front (2 of 3 designs)'
    """
    _legend.check(legend)
    _style.check_bar(colorbar)
    data = Data.of(table).slice(where, slices)
    smaller = [minimize] if isinstance(minimize, str) else list(minimize)
    larger = [maximize] if isinstance(maximize, str) else list(maximize)
    objectives = [*smaller, *larger]
    if len(objectives) < 2 or len(set(objectives)) < len(objectives):
        raise ValueError(f"two different objectives or more are needed, not {objectives}")
    # Cost against benefit reads best with the cost along x; of two alike, the first is.
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
    with _style.style(ax):
        ax = _style.axes_of(ax, 6.4, 4.4)
        size = _style.size(0.62 if len(data) <= 2000 else 0.4)
        _points(ax, data, x.values, y.values, size, color, cmap, colorbar)
        order = np.flatnonzero(front)
        order = order[np.lexsort((y.values[order], x.values[order]))]
        plural = "design" if len(data) == 1 else "designs"
        ax.plot(
            x.values[order],
            y.values[order],
            color=_style.DARK,
            linewidth=_style.width(0.6),
            linestyle="-" if len(objectives) == 2 else "none",
            drawstyle="steps-post" if names[0] in smaller else "steps-pre",
            # Rings around the points, behind them: the points' colours stay visible.
            marker="o",
            markersize=size + _style.size(0.35),
            markerfacecolor="none",
            markeredgewidth=_style.width(0.4),
            zorder=0.9,
            label=f"front ({len(order)} of {len(data)} {plural})",
        )
        for label, shown, which in ((ax.set_xlabel, x, names[0]), (ax.set_ylabel, y, names[1])):
            label(f"{shown.label}, {'less' if which in smaller else 'more'} is better")
        handles, _ = ax.get_legend_handles_labels()
        others = [name for name in objectives if name not in names]
        said = ", ".join(f"{data.shown(name).words} ({'less' if name in smaller else 'more'})" for name in others)
        title: Any = {"title": f"the front is also that of: {said}", "alignment": "left"} if others else {}
        # Inside, in the corner that no design reaches if there is a front.
        corner = f"{'lower' if names[1] in smaller else 'upper'} {'left' if names[0] in smaller else 'right'}"
        _legend.legend(ax, legend, given, inside=corner, handles=handles, ncols=4, borderaxespad=0.2, **title)
    return ax


def _points(
    ax: Axes,
    data: Data,
    x: np.ndarray,
    y: np.ndarray,
    size: float,
    color: str | None,
    cmap: str | None,
    colorbar: bool | Axes,
) -> None:
    """The designs as points, in the colours of a column."""
    look: dict[str, Any] = {"s": size**2, "linewidths": 0, "alpha": 0.9, "rasterized": True}
    if color is None:
        ax.scatter(x, y, color="#9ab8cf", **look)
        return
    shown = data.shown(color)
    if not shown.text:
        colours = _scales.colours(shown.values, cmap, log=_scales.in_ratio(distinct(shown.values)))
        points = ax.scatter(x, y, c=shown.values, cmap=colours.cmap, norm=colours.norm, **{**look, "alpha": None})
        colours.bar(ax, points, colorbar, shown.label)
        return
    words = distinct(data[color])
    for word, shade in zip(words, _style.shades(words, True)):
        mask = data[color].astype(str) == word
        ax.scatter(x[mask], y[mask], color=shade, label=str(word), **look)
