"""The look of pictures. Settings hold while a picture is made and are then as they were."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Iterator, Sequence, cast

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

if TYPE_CHECKING:

    class Drawn(Axes):
        """Axes with a picture, for type checkers: those of a new figure are in a figure that can be saved."""

        @property
        def figure(self) -> Figure: ...
        @figure.setter
        def figure(self, value: Any) -> None: ...

else:
    Drawn = Axes

# Okabe and Ito's colours, which readers with any colour vision tell apart.
BLUE, VERMILLION, GREEN, PURPLE, SKY, ORANGE = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00"
COLOURS = [BLUE, VERMILLION, GREEN, PURPLE, SKY, ORANGE, "#000000"]
DARK, GREY, LIGHT = "#222222", "#777777", "#d9d9d9"

# More lines than this get a colour bar in place of a legend.
LEGEND_LINES = 8

_SETTINGS: Any = {
    "axes.axisbelow": True,
    "axes.edgecolor": "#444444",
    "axes.grid": True,
    "axes.labelsize": 10,
    "axes.linewidth": 0.8,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlesize": 11,
    "figure.dpi": 100,
    "font.size": 9.5,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.7,
    "legend.fontsize": 9,
    "legend.framealpha": 0.9,
    "legend.frameon": False,
    "legend.title_fontsize": 9,
    "lines.linewidth": 1.6,
    "xtick.labelsize": 9,
    "ytick.labelsize": 9,
}


@contextmanager
def style() -> Iterator[None]:
    """The look of flap's pictures, for as long as one is made."""
    with mpl.rc_context(_SETTINGS):
        try:
            yield
        finally:
            interactive = mpl.is_interactive()
    # In a notebook the first figure turns this on, and without it no other would be shown.
    mpl.interactive(interactive)


def new_figure(width: float = 6.4, height: float = 4.0) -> Figure:
    """A figure that makes room for its labels."""
    return plt.figure(figsize=(width, height), layout="constrained")


def axes_of(ax: Axes | None, width: float = 6.4, height: float = 4.0) -> Drawn:
    """The axes given, or those of a new figure."""
    return cast("Drawn", new_figure(width, height).add_subplot() if ax is None else ax)


def figure_of(ax: Axes) -> Figure:
    """The figure that axes are in."""
    figure: Any = ax.figure
    while not isinstance(figure, Figure):  # a part of a figure
        figure = figure.figure
    return figure


def colour_bar(ax: Axes | list[Axes], mappable: Any, **options: Any) -> Any:
    """A colour bar beside axes, for a map or points in colours."""
    first = ax[0] if isinstance(ax, list) else ax
    bar = figure_of(first).colorbar(mappable, ax=ax, **options)
    bar.ax.grid(False)
    return bar


def legend_above(ax: Axes, height: float = 1.0, **options: Any) -> None:
    """A legend above axes, from their left edge; `height` is in heights of the axes."""
    ax.legend(loc="lower left", bbox_to_anchor=(0.0, height), **options)


def marks(ax: Axes, x: np.ndarray, height: float, **options: Any) -> None:
    """Strokes at values of x, all at one height in heights of the axes."""
    heights = np.full(len(x), height)
    ax.plot(x, heights, linestyle="none", marker="|", transform=ax.get_xaxis_transform(), **options)


def shades(values: Sequence[Any] | np.ndarray, text: bool) -> list[Any]:
    """A colour for each value: in an order for numbers, apart for words."""
    if text:
        return [COLOURS[i % len(COLOURS)] for i in range(len(values))]
    if len(values) == 1:
        return [BLUE]
    return list(mpl.colormaps["viridis"](np.linspace(0.0, 0.88, len(values))))
