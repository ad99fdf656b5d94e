"""A picture that shows by bars how strongly each parameter changes a measure."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from .. import _labels
from .._mistakes import refused
from ..analysis import RankCorrelation, Sensitivity, rank_correlations, sensitivities
from . import _style
from ._checks import checked


@checked
def tornado(
    design: Any,
    measure: str | None = None,
    parameters: Mapping[str, float | tuple[float, float]] | Iterable[str] | None = None,
    *,
    change: float = 0.05,
    top: int = 12,
    legend: bool | str = True,
    ax: Axes | None = None,
    **fixed: Any,
) -> _style.Drawn:
    """Draw the sensitivity of a measure to each parameter as a bar. The longest bar is at the top.

    If `design` is a preset, flap changes each parameter of the preset slightly, and the bars show the changes of the
    measure. If `design` contains results of a sample, the bars show the rank correlation (Spearman) of each parameter
    with the measure.

    Parameters
    ----------
    design : str; sequence of Sensitivity; Table, data frame, mapping of columns, or path
        A preset, the result of `flapwing.analysis.sensitivities`, or the results of a sample. `tornado` runs
        simulations only if `design` is a preset.
    measure, parameters, change, **fixed
        If `design` is a preset, `tornado` passes these arguments to `flapwing.analysis.sensitivities`. If `design`
        contains results of a sample, `tornado` passes `measure`, `parameters` and `fixed` to
        `flapwing.analysis.rank_correlations`.
    top : int
        The largest number of parameters to draw.
    legend, ax
        These arguments have the same meaning as in `flapwing.plot.response`.

    Returns
    -------
    matplotlib Axes
        The axes of the picture. For a preset, the horizontal axis shows the change of the measure in per cent of its
        value for the unchanged design. For a sample, the horizontal axis shows the rank correlation.

    Raises
    ------
    ValueError
        Raised if an argument is invalid (see `sensitivities` and `rank_correlations`). Raised if the list of
        sensitivities is empty, or if the measure is zero for the unchanged design.
    """
    if _is_table(design):
        return _correlations(rank_correlations(design, measure, parameters, **fixed), top, ax)
    if isinstance(design, str):
        if measure is None:
            raise TypeError("`measure` is required: a measure of the model, such as lift_mean_mn")
        found = sensitivities(design, measure, parameters, change=change, **fixed)
    else:
        for each in design:
            if not isinstance(each, Sensitivity):
                allowed = "it must be a preset, the result of `sensitivities`, or results of a sample"
                raise refused("design", design, allowed)
        found = sorted(design, key=lambda each: (-each.swing, each.parameter))
    if not found:
        raise ValueError("there are no sensitivities to draw")
    base = found[0].base
    if base == 0:
        raise ValueError(f"{found[0].measure} is zero for the unchanged design: its changes have no percentage")
    shown = found[:top]
    low = np.array([100.0 * (each.low - base) / abs(base) for each in shown])
    high = np.array([100.0 * (each.high - base) / abs(base) for each in shown])
    places = np.arange(len(shown))

    given = ax is not None
    with _style.applied(ax):
        ax = _style.axes_of(ax, 6.8, 1.5 + 0.32 * len(shown))
        ax.grid(False, axis="y")
        less, more = _names_of_changes(shown)
        # If both changes have the same sign, the shorter bar is drawn on the longer one and is thinner.
        within = np.where(low * high > 0, np.sign(np.abs(low) - np.abs(high)), 0.0)
        for ends, thin, colour, name in ((low, within < 0, _style.BLUE, less), (high, within > 0, _style.ORANGE, more)):
            bars = ax.barh(places, ends, height=np.where(thin, 0.28, 0.62), color=colour, label=name)
            for bar, above in zip(bars, thin):
                bar.set_zorder(1.6 if above else 1.5)
        ax.axvline(0.0, color=_style.ink(ax), linewidth=_style.width(0.6))
        ax.set_yticks(places, labels=[_named(each) for each in shown])
        ax.tick_params(axis="y", length=0)
        ax.set_ylim(len(shown) - 0.4, -0.6)
        unit = _labels.printed(shown[0].measure_unit)
        words = _labels.words(shown[0].measure, shown[0].measure_unit)
        ax.set_xlabel(f"Change of {_labels.lowered(words)} (% of {_labels.number(base)} {unit})".replace(" )", ")"))
        for place, each in enumerate(shown):
            missing = [name for name, value in ((less, each.low), (more, each.high)) if math.isnan(value)]
            if missing:
                ax.annotate(
                    f"no periodic motion at {' and '.join(missing)}",
                    (0.0, place),
                    xytext=(4, 0),
                    textcoords="offset points",
                    va="center",
                    fontsize="small",
                    color=_style.ink(ax),
                )
        rest = len(found) - len(shown)
        left = f"; {rest} smaller {'one' if rest == 1 else 'ones'} not shown" if rest else ""
        title = f"each parameter alone{left}"
        look: Any = {"borderaxespad": 0.1, "title": title, "alignment": "left"}
        if _style.is_narrow():
            # There is more room to the left, above the names of the parameters.
            look["outside"] = {"loc": "lower right", "bbox_to_anchor": (1.0, 1.0)}
        _style.legend(ax, legend, given, ncols=2, **look)
    return ax


def _correlations(found: list[RankCorrelation], top: int, ax: Axes | None) -> _style.Drawn:
    """Draw rank correlations as bars. The correlation with the largest absolute value is at the top."""
    shown = found[:top]
    sizes = np.array([each.correlation for each in shown])
    places = np.arange(len(shown))
    with _style.applied(ax):
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
        # For independent columns, 95 % of the correlations are smaller.
        chance = 1.96 / np.sqrt(max(found[0].designs, 2) - 1)
        words = _labels.lowered(_labels.words(found[0].measure, _labels.unit_of(found[0].measure)))
        note = f"{found[0].designs} designs; sizes below {chance:.2f} may be chance"
        ax.set_xlabel(f"Rank correlation (Spearman) with {words}\n{note}")
    return ax


def _is_table(design: Any) -> bool:
    """Return True if the argument is a table of results, or the path of a file. Text counts as the path of a file if it
    has an ending such as ``.csv``.
    """
    if isinstance(design, str):
        return bool(os.path.splitext(design)[1])
    return isinstance(design, os.PathLike) or not isinstance(design, Sequence)


def _named(each: Sensitivity) -> str:
    """Return a text with the name of a parameter and its value in the design."""
    factor, unit = _labels.readable([each.value], each.unit)
    value = f"{_labels.number(each.value * factor)} {unit}".strip()
    return f"{_labels.words(each.parameter, each.unit)}, {value}"


def _names_of_changes(shown: Sequence[Sensitivity]) -> tuple[str, str]:
    """Return two texts for the legend, for the lower and for the upper values of the parameters. If all relative
    changes are equal and all parameters are positive, the texts contain the change, such as "+5 %".
    """
    sizes = {
        round(abs(end - each.value) / abs(each.value), 9)
        for each in shown
        for end in (each.below, each.above)
        if each.value != 0
    }
    if len(sizes) == 1 and all(each.value > 0 for each in shown):
        percent = _labels.number(100.0 * sizes.pop())
        return f"−{percent} %", f"+{percent} %"
    return "lower value", "upper value"
