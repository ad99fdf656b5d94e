"""Legends: outside of axes of flap's own, inside of axes that are given, and there beside the data."""

from __future__ import annotations

from typing import Any, Iterator, Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.legend import Legend

from . import _style

#: Above axes, from their left edge.
ABOVE: Mapping[str, Any] = {"loc": "lower left", "bbox_to_anchor": (0.0, 1.0)}


def legend(
    ax: Axes,
    wanted: bool | str,
    given: bool,
    *,
    inside: str = "best",
    outside: Mapping[str, Any] = ABOVE,
    **options: Any,
) -> None:
    """A legend, if `wanted`: outside of new axes, or inside of axes that are given.

    A place as `wanted` is inside all axes. Axes that are given have it at `inside`; if it covers data there, the limits
    of the vertical axis grow and it is above them.
    """
    if wanted is False:
        return
    if wanted is True and not given:
        ax.legend(**{**outside, **options})
        return
    options = {name: value for name, value in options.items() if name not in ("borderaxespad", "ncols")}
    drawn = ax.legend(loc=wanted if isinstance(wanted, str) else inside, frameon=True, **options)
    if wanted is True and _covers(ax, drawn):
        _make_room(ax, options)


def check(wanted: object) -> None:
    """Raises if the option `legend` of a picture has a value that it cannot have."""
    if isinstance(wanted, str) and wanted not in Legend.codes:
        raise ValueError(f"`legend` is True, False or one of {', '.join(Legend.codes)}, not {wanted!r}")
    if not isinstance(wanted, (bool, str)):
        raise TypeError(f"`legend` is True, False or a place such as 'upper left', not {wanted!r}")


def _make_room(ax: Axes, options: Mapping[str, Any]) -> None:
    """A legend along the upper edge, in as many columns as fit, and room for it above the data."""
    handles = options.get("handles") or ax.get_legend_handles_labels()[0]
    box = ax.get_window_extent()
    for columns in _fewer(len(handles)):
        drawn = ax.legend(loc="upper left", frameon=True, **{**options, "ncols": columns})
        extent = drawn.get_window_extent()
        if extent.width <= box.width:
            break
    taken = min(0.6, 1.1 * (box.y1 - extent.y0) / box.height)
    low, high = ax.get_ylim()
    if ax.get_yscale() == "log":
        ax.set_ylim(low, low * (high / low) ** (1.0 / (1.0 - taken)))
    else:
        ax.set_ylim(low, low + (high - low) / (1.0 - taken))


def _fewer(count: int) -> Iterator[int]:
    """Numbers of columns for so many entries, from one row to one column."""
    while count > 1:
        yield count
        count = (count + 1) // 2
    yield 1


def _covers(ax: Axes, drawn: Legend) -> bool:
    """True if lines, bars or points of the axes are below a legend."""
    _style.figure_of(ax).draw_without_rendering()  # places are known after that
    box = drawn.get_window_extent()
    for line in ax.lines:
        path = line.get_path().transformed(line.get_transform()).cleaned(remove_nans=True)
        if line.get_linestyle() == "None":
            if box.count_contains(path.vertices):
                return True
        elif path.intersects_bbox(box, filled=False):
            return True
    bars = (bar for container in ax.containers for bar in container if hasattr(bar, "get_window_extent"))
    if any(box.overlaps(bar.get_window_extent()) for bar in bars):
        return True
    return any(
        box.count_contains(ax.transData.transform(points.get_offsets()))
        for points in ax.collections
        if np.size(points.get_offsets()) > 2
    )
