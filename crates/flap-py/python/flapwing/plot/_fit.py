"""Pictures of fits: readings and the model's 95 % bands, profile likelihoods of the parameters, and correlations of the
parameters.
"""

from __future__ import annotations

from itertools import cycle
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from .. import _labels
from .._flapwing import printed, scale, words
from ..fitting import Estimate, Fit
from . import _style

#: Names of the pictures of a fit.
_PARTS = ("data", "profiles", "correlations")

#: Number of points in a curve of the model.
_CURVE = 80


def fit(result: Fit, show: str | None = None) -> Figure:
    """Draw a fit: readings with the model's 95 % bands, profile likelihoods of the parameters, and correlations of the
    parameters.

    Parameters
    ----------
    result : Fit
        The result of `flapwing.fit`.
    show : {"data", "profiles", "correlations"}, optional
        The part of the picture to draw: readings, profile likelihoods or correlations. By default, all three parts are
        drawn.

    Returns
    -------
    matplotlib Figure
        The figure. The 95 % bands show the uncertainty of the model's prediction, without the noise of a reading. If a
        profile does not reach the dashed line on one side, the data give no limit for the parameter on this side.

    Raises
    ------
    ValueError
        Raised if `show` is not an allowed name. Raised if `show` is ``"profiles"`` and the fit did not compute profile
        likelihoods.
    TypeError
        Raised if `result` is not a `Fit`.
    """
    if not isinstance(result, Fit):
        raise TypeError(f"`result` is {type(result).__name__}\nit must be the result of flapwing.fit")
    if show is not None and show not in _PARTS:
        raise ValueError(f"`show` is {show!r}\nit must be one of {', '.join(_PARTS)}")
    profiled = [(name, one) for name, one in result.estimates.items() if one.profile is not None]
    if show == "profiles" and not profiled:
        raise ValueError("profiles were not computed\ncall flapwing.fit with profile=True")
    has_pairs = len(result.estimates) > 1
    shown = [show] if show else ["data", *(["profiles"] if profiled else []), *(["correlations"] if has_pairs else [])]
    measures = list(dict.fromkeys(measure for one in result._sets for measure in one.measured))
    with _style.applied():
        heights = {"data": 2.9 * len(measures), "profiles": 2.6 * _rows(len(profiled)), "correlations": 3.2}
        figure = _style.new_figure(7.2, sum(heights[part] for part in shown))
        parts = figure.subfigures(len(shown), 1, height_ratios=[heights[part] for part in shown], squeeze=False)[:, 0]
        for part, name in zip(parts, shown):
            if name == "data":
                for ax, measure in zip(part.subplots(len(measures), 1, squeeze=False)[:, 0], measures):
                    _data(result, measure, ax)
            elif name == "profiles":
                _profiles(profiled, result._quantile, part)
            else:
                _correlations(result, part)
    return figure


def _columns() -> int:
    """Return the number of profile likelihoods in one row of a figure."""
    return 2 if _style.is_narrow() else 3


def _rows(count: int) -> int:
    return -(-count // _columns())


def _data(result: Fit, measure: str, ax: Axes) -> None:
    """Draw the readings of a measure and the model's 95 % bands. The horizontal axis is the parameter that has the most
    different values in the data.
    """
    sets = [one for one in result._sets if measure in one.measured]
    numbers = {name: values for one in sets for name, values in one.points.items() if isinstance(values, np.ndarray)}
    if not numbers:
        raise ValueError("the data have no operating points to draw over")
    along = max(numbers, key=lambda name: len(np.unique(numbers[name])))
    colours = cycle(_style.series())
    residuals = {(one.data_set, one.measure): one for one in result.goodness.residuals}
    for one in sets:
        values = np.asarray(one.points[along], np.float64)
        others = {name: column for name, column in one.points.items() if name != along}
        noise = residuals[one.name, measure]
        with np.errstate(invalid="ignore", divide="ignore"):
            sigma = np.abs(noise.values / noise.scaled)
        for key in dict.fromkeys(zip(*(list(column) for column in others.values()))) if others else [()]:
            mine = np.ones(len(one), np.bool_)
            for column, cell in zip(others.values(), key):
                mine &= np.asarray(column) == cell
            colour = next(colours)
            label = _label(one.name if len(sets) > 1 else "", dict(zip(others, key)), result)
            ax.errorbar(
                values[mine],
                one.measured[measure][mine],
                np.nan_to_num(sigma[mine]),
                fmt="o",
                ms=3,
                lw=0.8,
                color=colour,
                label=label or "readings",
            )
            points: dict[str, Any] = {along: np.linspace(values[mine].min(), values[mine].max(), _CURVE)}
            points.update({name: [cell] * _CURVE for name, cell in zip(others, key)})
            band = result.predict(points, measure, data_set=one.name)
            ax.plot(points[along], band.value, color=colour, lw=1.2)
            ax.fill_between(points[along], band.low, band.high, color=colour, alpha=0.25, lw=0)
    ax.set_xlabel(_labels.label(along, result._model.names.unit(along)))
    ax.set_ylabel(_labels.label(measure, result._model.names.unit(measure)))
    handles, labels = ax.get_legend_handles_labels()
    shade = (Patch(color=_style.GREY, alpha=0.25, lw=0), Line2D([], [], color=_style.GREY, lw=1.2))
    entries: Any = ([*handles, shade], [*labels, "model with its 95 % band"])
    if _style.is_narrow():
        # Inside, it would cover the curves.
        ax.legend(*entries, loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.1)
    else:
        ax.legend(*entries)


def _label(name: str, others: dict[str, Any], result: Fit) -> str:
    """Return a label for readings: the name of the data set, and the parameters that have several values in the
    data.
    """
    varied = {
        parameter: value
        for parameter, value in others.items()
        if len(set(np.asarray(result._model.points[parameter]).tolist())) > 1
    }
    units = {parameter: printed(result._model.names.unit(parameter)) for parameter in varied}
    values = [
        value if isinstance(value, str) else f"{value:g} {units[parameter]}".rstrip()
        for parameter, value in varied.items()
    ]
    return ", ".join([*([name] if name else []), *values])


def _profiles(profiled: list[tuple[str, Estimate]], height: float, part: Any) -> None:
    """Draw the profile likelihoods of a fit. A profile shows how much the cost of the fit increases if one parameter is
    fixed at different values.
    """
    rows = _rows(len(profiled))
    axes = part.subplots(rows, min(_columns(), len(profiled)), squeeze=False).ravel()
    for ax, (name, one) in zip(axes, profiled):
        profile = one.profile
        assert profile is not None
        factor, unit = scale(one.unit, float(np.abs(profile.value).max()))
        ax.plot(factor * profile.value, np.abs(profile.rise), "o-", ms=3, color=_style.BLUE)
        ax.axvline(factor * one.value, color=_style.GREY, lw=0.8)
        ax.axhline(height, color=_style.VERMILLION, lw=0.8, ls="--")
        for value, is_open in ((profile.low, profile.open_below), (profile.high, profile.open_above)):
            if not is_open:
                ax.axvline(factor * value, color=_style.VERMILLION, lw=0.8, ls=":")
        ax.set_xlabel(_labels.titled(words(name, one.unit), unit))
        ax.set_ylim(bottom=0)
        # More ticks would make neighbouring numbers overlap.
        ax.xaxis.set_major_locator(MaxNLocator(3))
    axes[0].set_ylabel("Rise of the cost\n(standard errors)")
    for ax in axes[len(profiled) :]:
        ax.remove()
    explained = [
        Line2D([], [], marker="o", ms=3, color=_style.BLUE, label="profile"),
        Line2D([], [], color=_style.GREY, lw=0.8, label="estimate"),
        Line2D([], [], color=_style.VERMILLION, lw=0.8, ls="--", label="95 % limit"),
        Line2D([], [], color=_style.VERMILLION, lw=0.8, ls=":", label="ends of the interval"),
    ]
    look: Any = {"handles": explained, "loc": "outside upper left"}
    _style.fitted(part, lambda columns: part.legend(ncols=columns, **look), 4)


def _correlations(result: Fit, part: Any) -> None:
    """Draw the correlations of the fitted parameters as a coloured matrix with numbers."""
    names = [words(name, one.unit) for name, one in result.estimates.items()]
    values = result.correlations
    ax = part.subplots()
    ax.imshow(np.nan_to_num(values), cmap=mpl.colormaps["RdBu_r"], vmin=-1, vmax=1)
    ax.grid(False)
    ax.set_xticks(range(len(names)), names, rotation=30, ha="right", rotation_mode="anchor")
    ax.set_yticks(range(len(names)), names)
    for row in range(len(names)):
        for column in range(len(names)):
            text = f"{values[row, column]:+.2f}".replace("-", "−") if np.isfinite(values[row, column]) else "?"
            dark = abs(np.nan_to_num(values[row, column])) > 0.6
            ax.text(column, row, text, ha="center", va="center", color="white" if dark else _style.DARK)
