"""Maps that show a measure by colours if the points do not form a grid. The maps consist of coloured triangles between
the points.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.tri import TriAnalyzer, Triangulation

from .._data import Data, distinct, is_text
from . import _scales, _style

# Triangles at the outline with a smaller ratio of the radii of their circles are left out: they join distant points.
_FLAT = 0.02

# The share of the range of a parameter that is free beside the points.
_ROOM = 0.03

# The markers of points without a value, by status.
_MARKERS = {"subharmonic": "+", "unsettled": "x", "diverged": "1", "step_limit": "2", "invalid": "3"}


def form_no_grid(data: Data, x: str, y: str) -> bool:
    """Return True if a parameter is sampled, if rows lie between the values of an axis, or if most cells would be
    empty.
    """
    if is_text(data[x]) or is_text(data[y]) or data.followed() in (x, y):
        return False
    if not (data.on_a_grid(x) and data.on_a_grid(y)):
        return True
    axes = [name for axis in data.grid_axes for name in axis]
    if x in axes and y in axes:
        return not (data.on_axis(x).all() and data.on_axis(y).all())
    return 2 * len(np.unique(data.groups([x, y]))) < len(distinct(data[x])) * len(distinct(data[y]))


class Points:
    """A map of a measure for points that do not form a grid, with dots at the points and coloured triangles between the
    points.
    """

    def __init__(self, data: Data, x: str, y: str, scales: tuple[str | None, str | None], values: np.ndarray) -> None:
        self.x, self.y = data.shown(x), data.shown(y)
        self.rows, self.values = np.arange(len(data)), values
        self.logs = tuple(scale == "log" for scale in scales)
        places = []
        for shown, scale, log in zip((self.x, self.y), scales, self.logs):
            if scale not in (None, "linear", "log"):
                raise ValueError(f'a scale is "linear" or "log", not {scale!r}')
            if log and shown.values.min() <= 0:
                raise ValueError(f"`{shown.name}` cannot have a logarithmic scale: its smallest value is not positive")
            place = np.log(shown.values) if log else shown.values
            places.append((place - place.min()) / (np.ptp(place) or 1.0))
        try:
            # The parameters have different units, so triangles are formed in shares of their ranges.
            mesh = Triangulation(*places)
        except (RuntimeError, ValueError):
            raise ValueError(
                f"the points form no triangle over `{x}` and `{y}`: they are fewer than three, or on one line\n"
                "draw them with plot.scatter"
            ) from None
        # Between points of which one has no value, nothing is known.
        unknown = ~np.isfinite(values)[mesh.triangles].all(axis=1)
        flat = TriAnalyzer(mesh).get_flat_tri_mask(_FLAT)
        self.mesh = Triangulation(self.x.values, self.y.values, mesh.triangles, flat | unknown)

    def draw(self, ax: Axes, colours: _scales.Colours) -> Any:
        """Draw the coloured triangles and the points, and return the points for the colour bar."""
        values = np.nan_to_num(self.values)
        there = np.isfinite(self.values)
        look: Any = {"cmap": colours.cmap, "norm": colours.norm}
        if not self.mesh.mask.all():
            ax.tripcolor(self.mesh, values, shading="gouraud", rasterized=True, **look)
            if colours.signed:
                ax.tricontour(self.mesh, values, [0.0], colors=_style.DARK, linewidths=_style.width(0.6))
        # Dots have the colours of their values, so that points outside of all triangles are seen too.
        size = _style.size(0.6 if len(values) < 300 else 0.3)
        return ax.scatter(
            self.x.values[there],
            self.y.values[there],
            s=size**2,
            c=self.values[there],
            edgecolors=_style.DARK,
            linewidths=_style.width(0.25),
            zorder=2.0,
            **look,
        )

    def mark_missing(self, ax: Axes, missing: Mapping[str, np.ndarray]) -> list[Line2D]:
        """Draw markers at the points without a value, and return the entries of the legend for these markers."""
        entries = []
        for status, mask in missing.items():
            look: Any = {"marker": _MARKERS.get(status, "x"), "linestyle": "none", "color": _style.ink(ax)}
            look |= {"markersize": _style.size(0.7), "label": f"{status} ({mask.sum()})"}
            entries += ax.plot(self.x.values[mask], self.y.values[mask], **look)
        return entries

    def finish(self, ax: Axes) -> None:
        """Set the labels, the scales and the limits of the map's axes."""
        for shown, log, which in zip((self.x, self.y), self.logs, "xy"):
            low, high = float(shown.values.min()), float(shown.values.max())
            if log:
                ax.set(**{f"{which}scale": "log"})
                _scales.show_log_ticks(getattr(ax, f"{which}axis"), low, high)
            room = (high / low) ** _ROOM if log else _ROOM * (high - low)
            ends = (low / room, high * room) if log else (low - room, high + room)
            ax.set(**{f"{which}label": shown.label, f"{which}lim": ends})

    def best(self, smallest: bool) -> tuple[int, tuple[float, float]]:
        """Return the number of the row with the best value of the measure, and the position of this row in the map."""
        row = int(np.nanargmin(self.values) if smallest else np.nanargmax(self.values))
        return row, (float(self.x.values[row]), float(self.y.values[row]))
