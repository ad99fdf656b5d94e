"""Legends: outside of axes of flap's own, inside of axes that are given, and there beside the data."""

from __future__ import annotations

from typing import Any, Iterator, Mapping

import matplotlib as mpl
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.font_manager import FontProperties
from matplotlib.legend import Legend
from matplotlib.transforms import Bbox

from . import _labels, _style

#: Above axes, from their left edge.
ABOVE: Mapping[str, Any] = {"loc": "lower left", "bbox_to_anchor": (0.0, 1.0)}

#: Sizes of letters that are tried one after another, as multiples of the user's.
_LETTERS = (1.0, 0.85, 0.7, 0.6)

#: Settings of matplotlib on which the look of a legend depends.
_LOOKS = ("axes.", "font.", "legend.", "lines.", "mathtext.", "patch.", "text.")

#: Axes that have grown by this factor get a new legend, whose letters may be larger.
_GROWN = 1.2

#: The largest share of the axes' height that a legend above the data takes.
_HIGHEST = 0.6


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
    if given:
        _withdraw(ax)
    if wanted is False:
        return
    if wanted is True and not given:
        ax.legend(**{**outside, **options})
        return
    options = {name: value for name, value in options.items() if name not in ("borderaxespad", "ncols")}
    if isinstance(wanted, str):
        ax.legend(loc=wanted, frameon=True, **options)
        return
    figure = _style.figure_of(ax)
    figure.add_artist(_Fitted(ax, inside, options))
    figure.draw_without_rendering()


def _withdraw(ax: Axes) -> None:
    """Removes the space for an earlier legend, so that the limits of the axes follow from the drawn data."""
    for earlier in [artist for artist in _style.figure_of(ax).artists if isinstance(artist, _Fitted)]:
        earlier.withdraw(ax)


class _Fitted(Artist):
    """A legend inside axes, fitted to them whenever their figure is drawn: only then is it known how large they are.

    It belongs to the figure and draws nothing. It comes before everything else that is drawn, and after the layout.
    """

    def __init__(self, ax: Axes, inside: str, options: Mapping[str, Any]) -> None:
        super().__init__()
        self._ax, self._inside, self._options = ax, inside, dict(options)
        self._made: Legend | None = None
        # When the figure is drawn, the user's settings may be others.
        self._settings: Any = {name: value for name, value in mpl.rcParams.items() if name.startswith(_LOOKS)}
        #: The limits without room for the legend, and those with it.
        self._limits = self._roomy = ax.get_ylim()
        self._is_automatic = ax.get_autoscaley_on()
        #: The size for which the legend was made, in points.
        self._size: tuple[float, float] | None = None
        self.set_zorder(-np.inf)
        self.set_in_layout(False)

    def withdraw(self, ax: Axes) -> None:
        """Gives up the room of the legend in `ax`, for one of more entries."""
        if ax is not self._ax:
            return
        if ax.get_ylim() == self._roomy:
            ax.set_ylim(self._limits)
            ax.set_autoscaley_on(self._is_automatic)
            ax.autoscale_view(scalex=False)
        self.remove()

    def draw(self, renderer: Any) -> None:
        """Fits the legend, if it is still there and the size of the axes is another."""
        ax = self._ax
        is_others = ax.figure is None or (self._made is not None and ax.get_legend() is not self._made)
        if is_others or ax.get_ylim() != self._roomy:
            # The user has changed the axes: they stay as they are.
            self.remove()
            return
        if ax.get_axes_locator() is None:
            ax.apply_aspect()
        box = ax.get_window_extent(renderer)
        scale = 72.0 / _style.figure_of(ax).dpi
        size = (round(scale * box.width, 1), round(scale * box.height, 1))
        if size == self._size:
            return
        has_grown = self._size is None or size[0] > _GROWN * self._size[0] or size[1] > _GROWN * self._size[1]
        if self._made is None or has_grown or not _within(self._made, box, renderer) or _covers(ax, self._made, renderer):
            self._size = size
            with mpl.rc_context(self._settings):
                self._fit(renderer)

    def _fit(self, renderer: Any) -> None:
        ax = self._ax
        ax.set_ylim(self._limits)
        box = ax.get_window_extent(renderer)
        drawn = self._make(1.0, loc=self._inside)
        if not _within(drawn, box, renderer) or _covers(ax, drawn, renderer):
            extent = self._along_the_edge(box, renderer).get_window_extent(renderer)
            self._make_room(min(_HIGHEST, 1.1 * (box.y1 - extent.y0) / box.height))
        self._roomy = ax.get_ylim()

    def _make(self, letters: float, **place: Any) -> Legend:
        """The legend with letters of this size, as a multiple of the user's."""
        size = letters * FontProperties(size=mpl.rcParams["legend.fontsize"]).get_size_in_points()
        options = {"fontsize": size, "title_fontsize": mpl.rcParams["legend.title_fontsize"] or size} if letters < 1.0 else {}
        self._made = self._ax.legend(frameon=True, **{**self._options, **place, **options})
        return self._made

    def _along_the_edge(self, box: Bbox, renderer: Any) -> Legend:
        """The legend along the upper edge: in as many columns as fit, its title in lines, in smaller letters if need be."""
        handles = self._options.get("handles") or self._ax.get_legend_handles_labels()[0]
        title = self._options.get("title")
        for letters in _LETTERS:
            for columns in _fewer(len(handles)):
                for lines in [title] if title is None else _labels.wrapped(title):
                    drawn = self._make(letters, loc="upper left", ncols=columns, title=lines)
                    if _within(drawn, box, renderer) and drawn.get_window_extent(renderer).height < _HIGHEST * box.height:
                        return drawn
        return drawn

    def _make_room(self, taken: float) -> None:
        """Limits that leave this share of the height to the legend, above the data."""
        ax, (low, high) = self._ax, self._limits
        if ax.get_yscale() == "log":
            ax.set_ylim(low, low * (high / low) ** (1.0 / (1.0 - taken)))
        else:
            ax.set_ylim(low, low + (high - low) / (1.0 - taken))


def _within(drawn: Legend, box: Bbox, renderer: Any) -> bool:
    """True if a legend is inside the axes."""
    extent = drawn.get_window_extent(renderer)
    return bool(extent.x0 >= box.x0 and extent.x1 <= box.x1 and extent.y0 >= box.y0 and extent.y1 <= box.y1)


def _fewer(count: int) -> Iterator[int]:
    """Numbers of columns for so many entries, from one row to one column."""
    while count > 1:
        yield count
        count = (count + 1) // 2
    yield 1


def _covers(ax: Axes, drawn: Legend, renderer: Any) -> bool:
    """True if lines, bars or points of the axes are below a legend."""
    box = drawn.get_window_extent(renderer)
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
