"""A histogram of a measure: the number of designs in each range of the measure, with percentiles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from .. import _labels
from .._data import Data
from .._flapwing import bars
from . import _style
from ._checks import checked

# The share of the axes' height above the bars, for the percentiles.
_ROOM = 0.28


@checked
def histogram(
    table: Any,
    measure: str | None = None,
    *,
    where: Mapping[str, Any] | None = None,
    ax: Axes | None = None,
    **slices: Any,
) -> _style.Drawn:
    """Draw a histogram: the number of designs in each range of a measure, with the 5th, 50th and 95th percentile.

    Designs without a periodic motion are left out. The rule of Freedman and Diaconis gives the width of the bars.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        Results of any kind.
    measure : str, optional
        A column of numbers. Default: the mean lift, or another measure if the table has no mean lift.
    where, **slices
        Values of columns, which select the rows to draw: numbers in SI units, text with units, or words. Give these
        values in the mapping `where`, or as keywords such as ``drive_voltage_pp="100 V"``. If an axis of the grid is
        neither drawn nor selected, the picture has only the rows at its middle value. A warning shows this value.
    ax : matplotlib Axes, optional
        Axes for the picture, in the style of their figure. Only labels and a colour bar are outside of these axes.
        Default: axes of a new figure.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    ValueError
        A column or value is unknown, or no design has the measure.

    Examples
    --------
    >>> import numpy as np
    >>> ax = histogram({"lift_mean_mn": np.linspace(1.0, 2.0, 101)})
    >>> [text.get_text() for text in ax.texts]
    ['5 %: 1.05 mN', '50 %: 1.5 mN', '95 %: 1.95 mN']
    """
    data = Data.of(table).slice(where, slices).one_sample()
    measure = data.usual("benefit", "measure") if measure is None else measure
    data.numbers(measure)
    shown = data.shown(measure)
    found = bars(np.ascontiguousarray(np.where(data.measured(), shown.values, np.nan)))
    if found is None:
        raise ValueError(f"no row has a number for `{measure}`")
    edges, counts, percentiles = found["edges"], found["counts"], found["percentiles"]

    with _style.style(ax):
        ax = _style.axes_of(ax)
        look: Any = {"color": _style.PLAIN, "edgecolor": ax.get_facecolor(), "linewidth": 0.4}
        ax.bar(edges[:-1], counts, np.diff(edges), align="edge", **look)
        ax.set_ylim(0.0, counts.max() / (1.0 - _ROOM))
        ax.margins(x=0.03)
        middle = 0.5 * (edges[0] + edges[-1])
        for line, (percent, value) in enumerate(percentiles):
            # Each percentile has its own line of text, so that close percentiles do not overlap.
            top = 1.0 - _ROOM * line / len(percentiles)
            ax.axvline(value, ymax=top, color=_style.ink(ax), linewidth=_style.width(0.6), linestyle=(0, (4, 3)))
            ax.annotate(
                f"{percent} %: {_labels.number(value)} {shown.unit}".rstrip(),
                (value, top),
                xycoords=("data", "axes fraction"),
                xytext=(3 if value < middle else -3, -1),
                textcoords="offset points",
                ha="left" if value < middle else "right",
                va="top",
                fontsize="small",
                color=_style.ink(ax),
                # The text covers the lines of other percentiles.
                bbox={"facecolor": ax.get_facecolor(), "edgecolor": "none", "pad": 0.6},
            )
        ax.set_xlabel(shown.label)
        ax.set_ylabel("Number of designs")
    return ax
