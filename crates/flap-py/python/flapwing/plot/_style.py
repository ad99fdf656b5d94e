"""The style of pictures. The settings apply only while a picture is drawn, and are then restored."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, cast

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import same_color
from matplotlib.figure import Figure

from .. import _flapwing, _labels

if TYPE_CHECKING:

    class Drawn(Axes):
        """The type of axes with a picture: type checkers then accept that their figure is saved."""

        @property
        def figure(self) -> Figure: ...
        @figure.setter
        def figure(self, value: Any) -> None: ...

else:
    Drawn = Axes

# The colours of `flap plot`. Series have the colours of Okabe and Ito, which colour-blind readers can distinguish.
_TABLE = _flapwing.colours()
COLOURS = _TABLE["series"]
BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY = COLOURS[:6]
DARK = _TABLE["dark"]
PLAIN = _TABLE["plain"]
MISSING = _TABLE["missing"]
BISTABLE = _TABLE["bistable"]
BRANCHES = _TABLE["branches"]
GREY = "#777777"

# If there are more lines, they get a colour bar instead of a legend.
LEGEND_LINES = 8

# Text sizes are not set here: matplotlib derives them from `font.size`.
_SETTINGS: Any = {
    "axes.axisbelow": True,
    "axes.edgecolor": "#444444",
    # Strains are printed as 2 ×10⁻³, not as 0.002.
    "axes.formatter.limits": [-3, 6],
    "axes.formatter.use_mathtext": True,
    "axes.grid": True,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "font.size": 9.5,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.7,
    "legend.framealpha": 0.9,
    "legend.frameon": False,
    "lines.linewidth": 1.6,
}


@contextmanager
def style(ax: Axes | None = None) -> Iterator[None]:
    """Apply the style of flap's pictures while a picture is drawn.

    Settings of matplotlib that the user has changed stay. A setting counts as changed if it differs from the default of
    matplotlib. Axes that the user gives keep the style of their figure.
    """
    own = {} if ax is not None else {name: value for name, value in _SETTINGS.items() if _is_default(name)}
    with mpl.rc_context(own):
        try:
            yield
        finally:
            interactive = mpl.is_interactive()
    # In a notebook, the first figure switches this on, and later figures are shown only with it.
    mpl.interactive(interactive)


def _is_default(name: str) -> bool:
    settings: Any = mpl.rcParams
    return bool(settings[name] == mpl.rcParamsDefault[name])


def ink(ax: Axes) -> Any:
    """Return the colour of texts and thin lines: the user's colour of labels, or the colour of flap by default."""
    for colour in (ax.xaxis.label.get_color(), mpl.rcParams["text.color"]):
        if not same_color(colour, "black"):
            return colour
    return DARK


def width(factor: float) -> float:
    """Return a line width, given as a multiple of the line width in the user's settings."""
    return factor * float(mpl.rcParams["lines.linewidth"])


def size(factor: float) -> float:
    """Return a marker size, given as a multiple of the marker size in the user's settings."""
    return factor * float(mpl.rcParams["lines.markersize"])


def new_figure(width: float = 6.4, height: float = 4.0) -> Figure:
    """Return a new figure whose layout fits its labels."""
    return plt.figure(figsize=(width, height), layout="constrained")


def axes_of(ax: Axes | None, width: float = 6.4, height: float = 4.0) -> Drawn:
    """Return the given axes, or axes of a new figure."""
    return cast("Drawn", new_figure(width, height).add_subplot() if ax is None else ax)


def figure_of(ax: Axes) -> Figure:
    """Return the figure of axes."""
    figure: Any = ax.figure
    while not isinstance(figure, Figure):  # a part of a figure
        figure = figure.figure
    return figure


#: The place of a legend above axes, aligned with their left edge.
_ABOVE: Mapping[str, Any] = {"loc": "lower left", "bbox_to_anchor": (0.0, 1.0)}


def legend(
    ax: Axes,
    wanted: bool | str,
    given: bool,
    *,
    inside: str = "best",
    outside: Mapping[str, Any] = _ABOVE,
    **options: Any,
) -> None:
    """Draw a legend if `wanted` is true: outside of new axes, or inside given axes. If `wanted` is a place, the legend
    is inside in both cases.
    """
    if wanted is False:
        return
    if wanted is True and not given:
        ax.legend(**{**outside, **options})
        return
    for name in ("borderaxespad", "ncols"):
        options.pop(name, None)
    ax.legend(loc=wanted if isinstance(wanted, str) else inside, frameon=True, **options)


def colour_bar(ax: Axes | list[Axes], mappable: Any, wanted: bool | Axes = True, **options: Any) -> Any:
    """Draw a colour bar for a map or for coloured points: beside `ax`, or in the axes `wanted`. If `wanted` is False,
    draw none.
    """
    if wanted is False:
        return None
    first = ax[0] if isinstance(ax, list) else ax
    if wanted is True:
        bar = figure_of(first).colorbar(mappable, ax=ax, pad=0.02, **options)
    else:
        bar = figure_of(first).colorbar(mappable, cax=wanted, **options)
    bar.ax.grid(False)
    _fit_label(bar)
    return bar


def _fit_label(bar: Any) -> None:
    """If the label of a colour bar is longer than the bar, break the label into lines or make its letters smaller."""
    label = bar.ax.yaxis.label
    text, letters = label.get_text(), label.get_fontsize()
    if not text or bar.orientation != "vertical":
        return
    figure_of(bar.ax).draw_without_rendering()
    # Labels of axes are added later and take a tenth of the height.
    room = 0.9 * bar.ax.get_window_extent().height
    for factor in (1.0, 0.85, 0.7, 0.6):
        label.set_fontsize(factor * letters)
        for lines in _labels.wrapped(text):
            label.set_text(lines)
            if label.get_window_extent().height <= room:
                return


def marks(ax: Axes, x: np.ndarray, height: float, **options: Any) -> None:
    """Draw short vertical lines at values of x, all at the same `height`, a share of the height of the axes."""
    heights = np.full(len(x), height)
    ax.plot(x, heights, linestyle="none", marker="|", transform=ax.get_xaxis_transform(), **options)


def series() -> list[Any]:
    """Return the colours of series. If the user changed `axes.prop_cycle`, the colours of this cycle are returned."""
    cycle = [] if _is_default("axes.prop_cycle") else mpl.rcParams["axes.prop_cycle"].by_key().get("color", [])
    return list(cycle) or COLOURS


def further_shades(ax: Axes | None, count: int) -> list[Any]:
    """Return colours for new series, which differ from the colours of the lines in the axes."""
    every = series()
    taken = [] if ax is None else [line.get_color() for line in ax.lines]
    free = [colour for colour in every if not any(same_color(colour, other) for other in taken)] or every
    return [free[place % len(free)] for place in range(count)]


def shades(values: Sequence[Any] | np.ndarray, text: bool) -> list[Any]:
    """Return a colour for each value: ordered colours for numbers, distinct colours for words."""
    if text:
        colours = series()
        return [colours[i % len(colours)] for i in range(len(values))]
    places = _flapwing.line_shades(len(values))
    return [BLUE] if places is None else list(mpl.colormaps[mpl.rcParams["image.cmap"]](places))
