"""A histogram of a measure over designs, which also shows mean, standard deviation and percentiles."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from .. import _labels
from .._data import Data
from .._flapwing import bars
from ..analysis import percentages, statistics
from . import _style
from ._checks import checked

# The share of the axes' height above the bars for each percentile, and the largest share for all.
_LINE, _ROOM = 0.28 / 3.0, 0.5


@checked
def histogram(
    table: Any,
    measure: str | None = None,
    *,
    percentiles: Iterable[float] = (5, 50, 95),
    where: Mapping[str, Any] | None = None,
    legend: bool | str = True,
    ax: Axes | None = None,
    **slices: Any,
) -> _style.Drawn:
    """Draw a histogram of the values of a measure in many designs, and show mean, standard deviation and percentiles.

    Designs without a periodic motion are left out. The width of the bars is computed by the rule of Freedman and
    Diaconis. `flapwing.analysis.describe` returns mean, standard deviation and percentiles as numbers.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        Results of any flap computation, with one row for each design.
    measure : str, optional
        A column of numbers. The default of `measure` is the mean lift. If the table has no mean lift, flap chooses a
        different measure.
    percentiles : iterable of float, optional
        Percentages from 0 to 100. For each percentage, a line in the picture shows the percentile. The default of
        `percentiles` is 5 %, 50 % and 95 %.
    where, **slices
        Values of columns that select rows, as in `flapwing.plot.response`. In results of a grid without a sample, all
        values of an axis are used if you select no value. If a sample is combined with an axis and you select no value
        of the axis, only the axis's middle value is used.
    legend, ax
        These arguments have the same meaning as in `flapwing.plot.response`. The legend contains the mean and the
        standard deviation of the measure.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    ValueError
        Raised if a column or value is unknown. Raised if no design has a value of the measure. Raised if a percentage
        is not from 0 to 100.

    Examples
    --------
    >>> import numpy as np
    >>> ax = histogram({"lift_mean_mn": np.linspace(1.0, 2.0, 101)})
    >>> [text.get_text() for text in ax.texts]
    ['5 %: 1.05 mN', '50 %: 1.5 mN', '95 %: 1.95 mN']
    >>> ax.get_legend().get_texts()[0].get_text()
    'mean ± standard deviation: 1.5 ± 0.29 mN'
    """
    data = Data.of(table).slice(where, slices).one_sample()
    chosen = percentages(percentiles)
    measure = data.usual("benefit", "measure") if measure is None else measure
    data.numbers(measure)
    shown = data.shown(measure)
    values = np.ascontiguousarray(np.where(data.measured(), shown.values, np.nan))
    found = bars(values)
    if found is None:
        raise ValueError(f"no row has a number for `{measure}`")
    edges, counts = found
    summary = statistics(measure, shown.unit, values[np.isfinite(values)], chosen)

    given = ax is not None
    with _style.applied(ax):
        ax = _style.axes_of(ax)
        look: Any = {"color": _style.PLAIN, "edgecolor": ax.get_facecolor(), "linewidth": 0.4}
        ax.bar(edges[:-1], counts, np.diff(edges), align="edge", **look)
        room = min(_ROOM, _LINE * max(1, len(chosen)))
        ax.set_ylim(0.0, counts.max() / (1.0 - room))
        ax.margins(x=0.03)
        middle = 0.5 * (edges[0] + edges[-1])
        for line, (percent, value) in enumerate(summary.percentiles.items()):
            # Each percentile has its own line of text, so that close percentiles do not overlap.
            top = 1.0 - room * line / len(chosen)
            ax.axvline(value, ymax=top, color=_style.ink(ax), linewidth=_style.width(0.6), linestyle=(0, (4, 3)))
            ax.annotate(
                f"{percent:g} %: {_labels.number(value)} {shown.unit}".rstrip(),
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
        # A bar of errors below the highest bars: from one standard deviation below the mean to one above.
        text = f"mean ± standard deviation: {_labels.number(summary.mean)}"
        if np.isfinite(summary.standard_deviation):
            text = f"{text} ± {summary.standard_deviation:.2g}"
        spread = np.nan_to_num(summary.standard_deviation)
        bar = ax.errorbar(
            summary.mean,
            0.06 * counts.max(),
            xerr=spread,
            fmt="o",
            color=_style.VERMILLION,
            markersize=_style.size(0.8),
            capsize=_style.size(0.5),
            linewidth=_style.width(0.9),
            label=f"{text} {shown.unit}".rstrip(),
        )
        ax.set_xlabel(shown.label)
        ax.set_ylabel("Number of designs")
        _style.legend(ax, legend, given, handles=[bar], borderaxespad=0.1)
    return ax
