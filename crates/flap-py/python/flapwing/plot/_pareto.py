"""Designs in the plane of two objectives, and those that no other beats."""

from __future__ import annotations

from typing import Any, Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes

from . import _style
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
    cmap: str = "viridis",
    where: Mapping[str, Any] | None = None,
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
    cmap : str
        A colour map of matplotlib, for numbers.
    %(where)s
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

    with _style.style():
        ax = _style.axes_of(ax, 6.4, 4.4)
        _points(ax, data, x.values, y.values, color, cmap)
        order = np.flatnonzero(front)
        order = order[np.lexsort((y.values[order], x.values[order]))]
        plural = "design" if len(data) == 1 else "designs"
        ax.plot(
            x.values[order],
            y.values[order],
            color=_style.DARK,
            linewidth=1.1,
            linestyle="-" if len(objectives) == 2 else "none",
            drawstyle="steps-post" if names[0] in smaller else "steps-pre",
            marker="o",
            markersize=4.5 if len(order) <= 60 else 3.0,
            markerfacecolor="none",
            markeredgewidth=0.9,
            label=f"front ({len(order)} of {len(data)} {plural})",
        )
        for label, shown, which in ((ax.set_xlabel, x, names[0]), (ax.set_ylabel, y, names[1])):
            label(f"{shown.label}, {'less' if which in smaller else 'more'} is better")
        handles, _ = ax.get_legend_handles_labels()
        # Above the axes: no corner is free of points for certain.
        _style.legend_above(ax, handles=handles, ncols=4, borderaxespad=0.2)
        if len(objectives) > 2:
            others = [name for name in objectives if name not in names]
            said = ", ".join(f"{data.shown(name).words} ({'less' if name in smaller else 'more'})" for name in others)
            ax.annotate(
                f"objectives not drawn: {said}",
                (1.0, 1.0),
                xycoords="axes fraction",
                xytext=(0, 22),
                textcoords="offset points",
                ha="right",
                fontsize=8.5,
            )
    return ax


def _points(ax: Axes, data: Data, x: np.ndarray, y: np.ndarray, color: str | None, cmap: str) -> None:
    """The designs as points, in the colours of a column."""
    look: dict[str, Any] = {"s": 14 if len(x) <= 2000 else 6, "linewidths": 0, "alpha": 0.85, "rasterized": True}
    if color is None:
        ax.scatter(x, y, color="#9ab8cf", **look)
        return
    shown = data.shown(color)
    if not shown.text:
        points = ax.scatter(x, y, c=shown.values, cmap=cmap, **look)
        bar = _style.colour_bar(ax, points, label=shown.label, pad=0.02)
        if bar.solids is not None:
            bar.solids.set_alpha(1.0)
        return
    words = distinct(data[color])
    for word, shade in zip(words, _style.shades(words, True)):
        mask = data[color].astype(str) == word
        ax.scatter(x[mask], y[mask], color=shade, label=str(word), **look)
