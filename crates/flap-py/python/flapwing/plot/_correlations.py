"""Rank correlations of the parameters of a sample with a measure."""

from __future__ import annotations

from typing import Any, Iterable, Mapping, NamedTuple

import numpy as np
from matplotlib.axes import Axes

from .._flapwing import correlations
from . import _labels, _style
from ._data import Data, is_text


class RankCorrelation(NamedTuple):
    """The rank correlation (Spearman) of a parameter with a measure."""

    parameter: str
    """The parameter's name."""
    correlation: float
    """From -1 (a larger parameter always means a smaller measure) to 1."""
    measure: str
    """The measure's name."""
    designs: int
    """The number of designs that have the measure."""


def rank_correlations(
    table: Any,
    measure: str | None = None,
    parameters: Iterable[str] | None = None,
    *,
    where: Mapping[str, Any] | None = None,
    **slices: Any,
) -> list[RankCorrelation]:
    """Compute the rank correlation (Spearman) of each parameter of a sample with a measure.

    Equal values share the mean of their ranks. A parameter that follows an earlier one, in its order or in the reverse of
    it, is left out, as is one that has the same value in all designs.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        Results of a sample, or of a grid.
    measure : str, optional
        A column of numbers. By default the mean lift, or another measure of the table.
    parameters : iterable of str, optional
        Parameters, or any columns of numbers. By default all parameters of the table.
    where, **slices
        The rows to compare, as for `histogram`.

    Returns
    -------
    list of RankCorrelation
        By falling size of the correlation.

    Raises
    ------
    ValueError
        An unknown column or value; no design that has the measure; no parameter that varies.

    Examples
    --------
    >>> import numpy as np
    >>> table = {
    ...     "hinge_stiffness": np.array([1.0, 2.0, 3.0, 4.0]),
    ...     "status": np.array(["periodic"] * 4),
    ...     "lift_mean_mn": np.array([9.0, 7.0, 8.0, 5.0]),
    ... }
    >>> [(found.parameter, round(found.correlation, 2)) for found in rank_correlations(table)]
    [('hinge_stiffness', -0.8)]
    """
    data = Data.of(table).slice(where, slices).one_sample()
    measure = data.usual("benefit", "measure") if measure is None else measure
    values = np.where(data.measured(), data.numbers(measure), np.nan)
    designs = int(np.isfinite(values).sum())
    if not designs:
        raise ValueError(f"no row has a number for `{measure}`")
    names = _parameters(data) if parameters is None else list(parameters)
    columns = [np.ascontiguousarray(data.numbers(name)) for name in names]
    found = correlations(columns, np.ascontiguousarray(values))
    if not found:
        raise ValueError("no parameter has several values in these rows: there is nothing to compare")
    return [RankCorrelation(names[place], size, measure, designs) for place, size in found]


def _parameters(data: Data) -> list[str]:
    """The parameters that are numbers, those of a sample first."""
    names = [name for name in data.parameters() if not is_text(data[name])]
    return sorted(names, key=data.on_a_grid)


def draw(found: list[RankCorrelation], top: int, ax: Axes | None) -> _style.Drawn:
    """Bars of correlations, the largest on top."""
    shown = found[:top]
    sizes = np.array([each.correlation for each in shown])
    places = np.arange(len(shown))
    with _style.style(ax):
        ax = _style.axes_of(ax, 6.8, 1.3 + 0.32 * len(shown))
        ax.grid(False, axis="y")
        ax.barh(places, sizes, height=0.62, color=np.where(sizes > 0, _style.VERMILLION, _style.BLUE).tolist())
        for place, size in zip(places, sizes):
            ax.annotate(
                f"{size:+.2f}".replace("-", "−"),
                (size, place),
                xytext=(3 if size > 0 else -3, 0),
                textcoords="offset points",
                ha="left" if size > 0 else "right",
                va="center",
                fontsize="small",
                color=_style.ink(ax),
            )
        ax.axvline(0.0, color=_style.ink(ax), linewidth=_style.width(0.6))
        ax.set_yticks(places, labels=[_labels.words(each.parameter, "") for each in shown])
        ax.tick_params(axis="y", length=0)
        ax.set_ylim(len(shown) - 0.4, -0.6)
        ax.set_xlim(-1.2, 1.2)
        # Of columns that have nothing to do with each other, 95 % of the correlations are smaller.
        chance = 1.96 / np.sqrt(max(found[0].designs, 2) - 1)
        words = _labels.lowered(_labels.words(found[0].measure, _labels.unit_of(found[0].measure)))
        note = f"{found[0].designs} designs; sizes below {chance:.2f} may be chance"
        ax.set_xlabel(f"Rank correlation (Spearman) with {words}\n{note}")
    return ax
