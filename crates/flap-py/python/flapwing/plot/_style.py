"""The style of pictures. The settings of matplotlib are changed only while flap draws a picture, and are restored
afterwards.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from numbers import Real
from typing import TYPE_CHECKING, Any, cast

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import same_color
from matplotlib.figure import Figure
from matplotlib.legend import Legend

from .. import _flapwing, _labels
from .._mistakes import refused

if TYPE_CHECKING:

    class Drawn(Axes):
        """The type of axes with a picture: type checkers accept ``ax.figure.savefig`` for this type."""

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


#: Units of length in inches.
_INCHES = {"in": 1.0, "cm": 1.0 / 2.54, "mm": 1.0 / 25.4}

#: The height of a figure with one Axes object (inches).
_HEIGHT = 4.0

#: Width of a figure (inches) below which the figure is narrow: axes are then below each other, not beside each other.
NARROW = 5.0


@contextmanager
def style(
    *, width: float | str | None = None, height: float | str | None = None, font_size: float = 8.0
) -> Iterator[None]:
    """Set the size of pictures and of the letters in pictures, for example for a paper or for slides.

    The settings apply to figures that are drawn and saved in the ``with`` block. `style` sets settings of matplotlib,
    such as ``figure.figsize`` and ``font.size``, so figures that you draw with matplotlib also change.

    Parameters
    ----------
    width, height : float or str, optional
        Size of a figure: numbers in inches, or text such as ``"3.3 in"``, ``"84 mm"`` or ``"8.4 cm"``. The default of
        the width is 6.4 inches. The default of the height is 1 inch plus 0.42 times the width. A figure with several
        axes below each other is higher than `height`. If you give neither `width` nor `height`, flap's functions use
        their default sizes.
    font_size : float, optional
        Size of the letters (points). If the letters are smaller than 9.5 points, lines are thinner and markers are
        smaller. The default of `font_size` is 8 points.

    Returns
    -------
    context manager
        A context manager that restores the settings at the end of the ``with`` block.

    Raises
    ------
    ValueError
        Raised if a length or a font size is zero or less, or has an unknown unit.
    TypeError
        Raised if a value has the wrong type.

    Examples
    --------
    >>> import numpy as np
    >>> from flapwing import plot
    >>> table = {"lift_mean_mn": np.linspace(1.0, 2.0, 101)}
    >>> with plot.style(width="3.3 in", font_size=8):
    ...     figure = plot.histogram(table).figure
    >>> [float(round(side, 1)) for side in figure.get_size_inches()]
    [3.3, 2.4]
    """
    if isinstance(font_size, bool) or not isinstance(font_size, Real):
        raise refused("font_size", font_size, "it must be a number of points")
    if not 0.0 < font_size < float("inf"):
        raise ValueError(f"`font_size` must be more than 0 points, not {font_size}")
    letters = float(font_size)
    thin = min(1.0, letters / _SETTINGS["font.size"])
    settings: dict[str, Any] = {
        # A size that equals matplotlib's default would count as not set.
        "font.size": letters + 1e-9,
        "axes.linewidth": 0.8 * thin,
        "grid.linewidth": 0.7 * thin,
        "lines.linewidth": 1.6 * thin,
        "lines.markersize": 6.0 * thin,
        **{f"{each}tick.major.size": 3.5 * thin for each in "xy"},
        **{f"{each}tick.major.width": 0.8 * thin for each in "xy"},
        "savefig.dpi": 300,
        # Journals require letters as outlines of TrueType, which can be searched.
        "pdf.fonttype": 42,
    }
    if width is not None or height is not None:
        across = 6.4 if width is None else _inches("width", width)
        settings["figure.figsize"] = (across, 1.0 + 0.42 * across if height is None else _inches("height", height))
    with mpl.rc_context(settings):
        yield


def _inches(name: str, length: Any) -> float:
    """Return the length that an argument gives as a number or as text, in inches."""
    allowed = 'it must be a number of inches, or text such as "3.3 in", "84 mm" or "8.4 cm"'
    if isinstance(length, str):
        found = re.fullmatch(r"\s*([0-9.]+)\s*([a-z]+)\s*", length)
        if found is None or found[2] not in _INCHES or found[1].count(".") > 1 or found[1] == ".":
            raise ValueError(f"`{name}` is {length!r}\n{allowed}")
        length = float(found[1]) * _INCHES[found[2]]
    elif isinstance(length, bool) or not isinstance(length, Real):
        raise refused(name, length, allowed)
    if not 0.0 < length < float("inf"):
        raise ValueError(f"`{name}` must be more than 0, not {length}")
    return float(length)


@contextmanager
def applied(ax: Axes | None = None) -> Iterator[None]:
    """Apply the style of flap's pictures while a picture is drawn.

    A setting of matplotlib is not changed if the user has set it to a value that differs from the default of
    matplotlib. Axes that the user gives keep the style of the user's figure.
    """
    own = {} if ax is not None else {name: value for name, value in _SETTINGS.items() if _is_default(name)}
    before = plt.get_fignums()
    with mpl.rc_context(own):
        try:
            yield
            if is_narrow():
                for number in plt.get_fignums():
                    if number not in before:
                        _fit_labels(plt.figure(number))
        finally:
            interactive = mpl.is_interactive()
    # In a notebook, the first figure switches this on, and later figures are shown only with it.
    mpl.interactive(interactive)


def is_narrow() -> bool:
    """Return True if the user's settings make new figures as narrow as a column of a paper."""
    return not _is_default("figure.figsize") and bool(mpl.rcParams["figure.figsize"][0] < NARROW)


def _is_default(name: str) -> bool:
    settings: Any = mpl.rcParams
    return bool(settings[name] == mpl.rcParamsDefault[name])


def ink(ax: Axes) -> Any:
    """Return the colour of texts and thin lines: the colour in the user's settings of matplotlib, or by default flap's
    dark grey.
    """
    for colour in (ax.xaxis.label.get_color(), mpl.rcParams["text.color"]):
        if not same_color(colour, "black"):
            return colour
    return DARK


def width(factor: float) -> float:
    """Return a line width in points: `factor` times the line width in the user's settings."""
    return factor * float(mpl.rcParams["lines.linewidth"])


def size(factor: float) -> float:
    """Return a marker size in points: `factor` times the marker size in the user's settings."""
    return factor * float(mpl.rcParams["lines.markersize"])


def new_figure(width: float = 6.4, height: float = _HEIGHT) -> Figure:
    """Return a new figure whose layout leaves room for the labels. If the user has set a size of figures in matplotlib,
    the new figure has the width in this setting. A figure with one Axes object also has the height that the user has
    set in matplotlib.
    """
    if not _is_default("figure.figsize"):
        sides = mpl.rcParams["figure.figsize"]
        width, height = sides[0], sides[1] * max(1.0, height / _HEIGHT)
    return plt.figure(figsize=(width, height), layout="constrained")


def axes_of(ax: Axes | None, width: float = 6.4, height: float = _HEIGHT) -> Drawn:
    """Return `ax`, or axes in a new figure if `ax` is None."""
    return cast("Drawn", new_figure(width, height).add_subplot() if ax is None else ax)


def figure_of(ax: Axes) -> Figure:
    """Return the figure that contains the given axes."""
    figure: Any = ax.figure
    while not isinstance(figure, Figure):  # a part of a figure
        figure = figure.figure
    return figure


#: The place of a legend above axes, aligned with the left edge of the axes.
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
    """Draw a legend, unless `wanted` is False. The legend is outside of axes that flap has made, and inside axes that
    the user gives. If `wanted` is a position such as ``"upper left"``, the legend is always inside the axes.
    """
    if wanted is False:
        return
    if wanted is True and not given:
        fitted(ax, lambda columns: ax.legend(**{**outside, **options, "ncols": columns}), options.get("ncols", 1))
        return
    for name in ("borderaxespad", "ncols"):
        options.pop(name, None)
    ax.legend(loc=wanted if isinstance(wanted, str) else inside, frameon=True, **options)


def colour_bar(ax: Axes | list[Axes], mappable: Any, wanted: bool | Axes = True, **options: Any) -> Any:
    """Draw a colour bar for a map or for coloured points. If `wanted` is Axes, the colour bar is drawn in these axes,
    otherwise beside `ax`. If `wanted` is False, no colour bar is drawn.
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
    """If the label of a colour bar is longer than the bar, divide the label into several lines, or make its letters
    smaller.
    """
    if not bar.ax.yaxis.label.get_text() or bar.orientation != "vertical":
        return
    figure_of(bar.ax).draw_without_rendering()
    # Labels of axes are added later and take a tenth of the height.
    _shorten(bar.ax.yaxis.label, "height", 0.9 * bar.ax.get_window_extent().height)


def _shorten(label: Any, side: str, room: float) -> None:
    """Divide a label into several lines, or make its letters smaller, until its size is at most `room` (pixels). `side`
    is ``"width"`` or ``"height"``.
    """
    text, letters = label.get_text(), label.get_fontsize()
    if getattr(label.get_window_extent(), side) <= room:
        return
    for factor in (1.0, 0.85, 0.7, 0.6):
        label.set_fontsize(factor * letters)
        for lines in _labels.wrapped(text):
            label.set_text(lines)
            if getattr(label.get_window_extent(), side) <= room:
                return


def _fit_labels(figure: Figure) -> None:
    """Divide or shrink each axis label that is longer than the space for this label in the figure."""
    figure.draw_without_rendering()
    for ax in figure.axes:
        place = ax.get_subplotspec()
        if place is None:
            continue
        whole, inside, grid = ax.figure.bbox, ax.get_window_extent(), place.get_gridspec()
        middle = 0.5 * (inside.x0 + inside.x1)
        room = 2.0 * min(middle - whole.x0, whole.x1 - middle)
        if grid.ncols > 1:
            room = min(room, whole.width / grid.ncols)
        elif ax.xaxis.label.get_window_extent().width > room:
            # There is more room to the left, below the numbers of the vertical axis.
            ax.set_xlabel(ax.get_xlabel(), loc="right")
            room = inside.x1 - whole.x0
        _shorten(ax.xaxis.label, "width", room)
        _shorten(ax.yaxis.label, "height", min(1.2 * inside.height, whole.height / grid.nrows))


def fitted(ax: Any, draw: Callable[[int], Legend], columns: int) -> Legend:
    """Draw a legend with at most `columns` columns. If the legend is too wide, the function reduces the number of
    columns.
    """
    part = ax.figure if isinstance(ax, Axes) else ax
    legend = draw(columns)
    if legend.get_window_extent().width <= 0.7 * part.bbox.width:
        return legend
    room = part.bbox.width
    if isinstance(ax, Axes):
        # The width of the axes without the legend.
        legend.set_in_layout(False)
        figure_of(ax).draw_without_rendering()
        room = ax.get_window_extent().width
    for count in range(columns, 0, -1):
        legend.remove()
        legend = draw(count)
        if legend.get_window_extent().width <= room:
            return legend
    # One column is too wide: the letters become smaller.
    factor = max(0.8, room / legend.get_window_extent().width)
    for text in (*legend.get_texts(), legend.get_title()):
        text.set_fontsize(factor * float(text.get_fontsize()))
    return legend


def marks(ax: Axes, x: np.ndarray, height: float, **options: Any) -> None:
    """Draw short vertical lines at the horizontal positions `x`. All lines have the same vertical position `height`, as
    a fraction of the height of the axes.
    """
    heights = np.full(len(x), height)
    ax.plot(x, heights, linestyle="none", marker="|", transform=ax.get_xaxis_transform(), **options)


def series() -> list[Any]:
    """Return the colours for successive lines. If the user has changed the setting `axes.prop_cycle` of matplotlib,
    return the colours in this setting.
    """
    cycle = [] if _is_default("axes.prop_cycle") else mpl.rcParams["axes.prop_cycle"].by_key().get("color", [])
    return list(cycle) or COLOURS


def further_shades(ax: Axes | None, count: int) -> list[Any]:
    """Return colours for new lines that differ from the colours of the existing lines in the axes."""
    every = series()
    taken = [] if ax is None else [line.get_color() for line in ax.lines]
    free = [colour for colour in every if not any(same_color(colour, other) for other in taken)] or every
    return [free[place % len(free)] for place in range(count)]


def shades(values: Sequence[Any] | np.ndarray, text: bool) -> list[Any]:
    """Return a colour for each value. Numbers get colours from a colour map, and words get colours that are easy to
    distinguish.
    """
    if text:
        colours = series()
        return [colours[i % len(colours)] for i in range(len(values))]
    places = _flapwing.line_shades(len(values))
    return [BLUE] if places is None else list(mpl.colormaps[mpl.rcParams["image.cmap"]](places))
