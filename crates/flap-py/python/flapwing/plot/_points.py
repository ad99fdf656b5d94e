"""Designs as points in the plane of two columns, in the colours of a third."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Colormap

from . import _scales, _style
from ._data import Data, distinct


def points(
    ax: Axes,
    data: Data,
    x: np.ndarray,
    y: np.ndarray,
    color: str | None,
    cmap: str | Colormap | None,
    colorbar: bool | Axes,
) -> float:
    """Draws designs as points, in the colours of a column, and gives the size of the points."""
    size = _style.size(0.62 if len(data) <= 2000 else 0.4)
    look: dict[str, Any] = {"s": size**2, "linewidths": 0, "alpha": 0.9, "rasterized": True}
    if color is None:
        ax.scatter(x, y, color=_style.PLAIN, **look)
        return size
    shown = data.shown(color)
    if not shown.text:
        colours = _scales.colours(shown.values, cmap, log=_scales.in_ratio(distinct(shown.values)))
        drawn = ax.scatter(x, y, c=shown.values, cmap=colours.cmap, norm=colours.norm, **{**look, "alpha": None})
        colours.bar(ax, drawn, colorbar, shown.label)
        return size
    words = distinct(data[color])
    for word, shade in zip(words, _style.shades(words, True)):
        mask = data[color].astype(str) == word
        ax.scatter(x[mask], y[mask], color=shade, label=str(word), **look)
    return size
