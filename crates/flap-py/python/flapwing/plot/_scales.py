"""Logarithmic ticks of axes, and colours that represent numbers."""

from __future__ import annotations

from typing import Any, NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Colormap, ListedColormap, LogNorm, Normalize
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullFormatter

from .._flapwing import is_signed
from . import _style

#: The colour map for numbers of both signs. Numbers of one sign get the colour map in matplotlib's setting
#: `image.cmap`, by default viridis.
DIVERGING = "RdBu_r"


class Colours(NamedTuple):
    """The colours that represent numbers."""

    cmap: str | Colormap
    norm: Normalize
    #: The ends of the colour bar that have an arrow: "neither", "min", "max" or "both". An arrow shows that numbers
    #: exist beyond the end.
    extend: str
    #: True for a diverging colour map around zero.
    signed: bool

    def bar(self, ax: Axes | list[Axes], mappable: Any, wanted: bool | Axes, label: str) -> None:
        """Draw a colour bar. If the numbers have both signs, the colour bar has a line at zero."""
        bar = _style.colour_bar(ax, mappable, wanted, label=label, extend=self.extend)
        if bar is None:
            return
        if self.signed:
            bar.ax.axhline(0.0, color=_style.DARK, linewidth=_style.width(0.6))
        if isinstance(self.norm, LogNorm):
            ticks = log_ticks(float(self.norm.vmin or 0.0), float(self.norm.vmax or 1.0))
            bar.set_ticks(ticks, labels=[f"{tick:g}" for tick in ticks])
            bar.minorticks_off()


def colours(
    values: np.ndarray,
    cmap: str | Colormap | None,
    vmin: float | None = None,
    vmax: float | None = None,
    log: bool = False,
) -> Colours:
    """Return the colours that represent numbers from `vmin` to `vmax`. By default, `vmin` is the smallest and `vmax` is
    the largest number in `values`.

    If `cmap` is None and the numbers have both signs, the colour map is a diverging colour map whose middle is zero.
    """
    finite = values[np.isfinite(values)]
    smallest, largest = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    low, high = smallest if vmin is None else vmin, largest if vmax is None else vmax
    below, above = bool(finite.size) and smallest < low, bool(finite.size) and largest > high
    extend = {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}[below, above]
    if cmap is None and is_signed(low, high):
        return Colours(_diverging(low, high), Normalize(low, high), extend, True)
    norm = LogNorm(low, high) if log and low > 0 else Normalize(low, high)
    return Colours(cmap or str(mpl.rcParams["image.cmap"]), norm, extend, False)


def _diverging(low: float, high: float) -> Colormap:
    """Return the part of a diverging colour map for numbers from `low` to `high`. Zero is white, and numbers of equal
    magnitude have colours of equal strength.
    """
    size = max(-low, high)
    places = 0.5 + 0.5 * np.linspace(low, high, 257) / size
    return ListedColormap(mpl.colormaps[DIVERGING](places), name="signed")


def log_ticks(low: float, high: float) -> list[float]:
    """Return round numbers for the ticks of a logarithmic scale. A short scale also has ticks at round numbers between
    the powers of ten, for example at 20 and 50.
    """
    subs = [1.0, 2.0, 5.0] if high / low < 300 else [1.0]
    if high / low < 8:
        subs = [1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0]
    return [float(tick) for tick in LogLocator(subs=subs).tick_values(low, high) if low <= tick <= high]


def show_log_ticks(axis: Any, low: float, high: float) -> None:
    """Put ticks at round numbers of a logarithmic axis, with labels such as 200 instead of powers of ten."""
    axis.set_major_locator(FixedLocator(log_ticks(low, high)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())
