"""A picture of a motion over time, and of its phase portrait."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, overload

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .. import _labels
from .._data import Data, Shown
from . import _style
from ._checks import checked

_ANGLES = ("stroke_deg", "pitch_deg")


@overload
def trajectory(
    table: Any,
    signals: str | Sequence[str] = ...,
    *,
    portrait: Sequence[str] | None = ...,
    time: str = ...,
    label: str | None = ...,
    legend: bool | str = ...,
    ax: None = ...,
) -> Figure: ...
@overload
def trajectory(
    table: Any,
    signals: str | Sequence[str] = ...,
    *,
    portrait: Sequence[str] | None = ...,
    time: str = ...,
    label: str | None = ...,
    legend: bool | str = ...,
    ax: Axes,
) -> Axes: ...
@checked
def trajectory(
    table: Any,
    signals: str | Sequence[str] = _ANGLES,
    *,
    portrait: Sequence[str] | None = None,
    time: str = "time_s",
    label: str | None = None,
    legend: bool | str = True,
    ax: Axes | None = None,
) -> Figure | Axes:
    """Draw signals over time. Beside these curves, draw phase portraits: the rate of each angle against the angle.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        A trajectory from `flapwing.trajectory` or ``flap run --trajectory``.
    signals : str or sequence of str
        The columns to draw over time. Columns with the same unit share axes. Default: stroke and pitch.
    portrait : sequence of str, optional
        The columns with a phase portrait. Default: stroke and pitch, if these columns are among the signals. If the
        table has no column for a rate, the rate is computed from the samples.
    time : str
        The column that contains the time.
    label : str, optional
        The name of the motion in the legend, with which you compare motions in the same axes. By default, later motions
        get numbers.
    legend : bool or str
        False for no legend, or a place inside the axes such as ``"upper left"``. By default, the legend is above new
        axes, but inside axes that you give.
    ax : matplotlib Axes, optional
        Axes for signals of one unit, without a portrait. If the axes already have motions, the new lines have other
        colours, and the legend has all lines.

    Returns
    -------
    matplotlib Figure, or Axes if `ax` is given
        The axes of the figure are the axes over time, from top to bottom, then the portraits.

    Raises
    ------
    ValueError
        A column is unknown. With `ax`, there are portraits, or signals of several units, or another unit than in `ax`.

    Examples
    --------
    >>> import numpy as np
    >>> phase = np.linspace(0.0, 2.0 * np.pi, 101)
    >>> table = {"time_s": phase / 754.0, "stroke_deg": 60.0 * np.sin(phase), "pitch_deg": 45.0 * np.cos(phase)}
    >>> [each.get_xlabel() for each in trajectory(table).axes]
    ['Time (ms)', 'Stroke (°)', 'Pitch (°)']

    Two motions in the same axes:

    >>> import matplotlib.pyplot as plt
    >>> ax = trajectory(table, "stroke_deg", label="80 V", ax=plt.subplots()[1])
    >>> ax = trajectory({**table, "stroke_deg": 0.5 * table["stroke_deg"]}, "stroke_deg", label="60 V", ax=ax)
    >>> [line.get_label() for line in ax.lines]
    ['80 V', '60 V']
    """
    data = Data.of(table)
    names = [signals] if isinstance(signals, str) else list(signals)
    if not names:
        raise ValueError("`signals` is empty: give at least one column")
    t = data.numbers(time)
    groups: dict[str, list[str]] = {}
    for name in names:
        data.numbers(name)
        groups.setdefault(data.shown(name).unit, []).append(name)
    portraits = [name for name in _ANGLES if name in names] if portrait is None else list(portrait)
    if ax is not None:
        if len(groups) > 1 or portrait:
            raise ValueError("`ax` is for signals of one unit; omit it for several units or portraits")
        portraits = []
    rates = {name: _rate(data, name, t) for name in portraits}

    with _style.style(ax):
        if ax is not None:
            over_time, beside = [ax], list[Axes]()
        else:
            over_time, beside = _layout(len(groups), len(portraits))
        drawn = dict.fromkeys([*names, *portraits])
        colours = dict(zip(drawn, _style.further_shades(ax, len(drawn))))
        x = data.shown(time)
        for each, (unit, members) in zip(over_time, groups.items()):
            earlier = _earlier(each, unit)
            factor = _factor(each, x)
            for name in members:
                shown = data.shown(name)
                told = shown.words if label is None else label if len(members) == 1 else f"{shown.words}, {label}"
                each.plot(factor * x.values, shown.values, color=colours[name], label=_numbered(told, each))
            words = list(dict.fromkeys([*earlier, *(data.shown(name).words for name in members)]))
            each.set_ylabel(_labels.titled(words[0] if len(words) == 1 else _common(words, unit), unit))
            each.margins(x=0.0)
            if len(each.lines) > 1 or label is not None:
                _style.legend(each, legend, ax is not None, ncols=3, borderaxespad=0.1)
        if factor == 1.0:
            over_time[-1].set_xlabel(x.label)
        for each, name in zip(beside, portraits):
            shown = data.shown(name)
            rate, unit = rates[name]
            each.plot(shown.values, rate, color=colours[name])
            each.plot(shown.values[:1], rate[:1], "o", color=colours[name], markersize=_style.size(0.7), label="start")
            _direction(each, shown.values, rate, colours[name])
            each.set_xlabel(shown.label)
            each.set_ylabel(_labels.titled(f"{shown.words} rate", unit))
    return _style.figure_of(over_time[0]) if ax is None else ax


def _earlier(ax: Axes, unit: str) -> list[str]:
    """Return the label of the vertical axis, if the axes already have motions in this unit."""
    told = ax.get_ylabel()
    if not told or not ax.lines:
        return []
    words, bracket, other = told.removesuffix(")").rpartition(" (")
    if bracket and other != unit:
        raise ValueError(
            f"`ax` has the vertical axis {told!r}, but the signals are in {unit or 'no unit'}\ndraw them in other axes"
        )
    return [words if bracket else told]


def _factor(ax: Axes, time: Shown) -> float:
    """Return the factor from the displayed unit of time to the unit of the motions that are already in the axes."""
    sizes = {"s": 1.0, "ms": 1e3, "µs": 1e6}
    there = [unit for unit in sizes if ax.get_xlabel() == _labels.titled(time.words, unit)]
    return sizes[there[0]] / sizes[time.unit] if there and time.unit in sizes else 1.0


def _numbered(label: str, ax: Axes) -> str:
    """Return a label that no line of the axes has yet."""
    taken = [line.get_label() for line in ax.lines]
    numbers = (number for number in range(2, len(taken) + 2) if f"{label} ({number})" not in taken)
    return f"{label} ({next(numbers)})" if label in taken else label


def _layout(signals: int, portraits: int) -> tuple[list[Axes], list[Axes]]:
    """Return axes over time, one below the other, and axes of portraits beside them."""
    rows = max(signals, portraits)
    height = 1.0 + 1.9 * rows
    if not portraits:
        figure = _style.new_figure(6.4, height)
        return list(np.atleast_1d(figure.subplots(signals, 1, sharex=True))), []
    figure = _style.new_figure(8.6, max(height, 3.2))
    parts: Any = figure.subfigures(1, 2, width_ratios=[1.7, 1.0])
    left, right = parts
    over_time = list(np.atleast_1d(left.subplots(signals, 1, sharex=True)))
    return over_time, list(np.atleast_1d(right.subplots(portraits, 1)))


def _rate(data: Data, name: str, t: np.ndarray) -> tuple[np.ndarray, str]:
    """Return the rate of a signal, and the unit of the rate. If there is no column with the rate, compute it from the
    samples.
    """
    values = data.numbers(name)
    if data.unit(name) == "deg":
        stem = name[: -len("_deg")] if name.endswith("_deg") else name
        for column in (f"{stem}_rate_rad_s", f"{stem}_rate"):
            if column in data:
                return np.degrees(data.numbers(column)) / 1000.0, "°/ms"
        return np.gradient(values, t) / 1000.0, "°/ms"
    shown = data.shown(name)
    return np.gradient(shown.values, t * 1000.0), f"{shown.unit}/ms" if shown.unit else "1/ms"


def _common(words: list[str], unit: str) -> str:
    """Return the label of an axis: "Angle" for degrees, the names of up to two signals, or the common last word of all
    names.
    """
    if unit == "°":
        return "Angle"
    if len(words) <= 2:
        return ", ".join([words[0], *(word[:1].lower() + word[1:] for word in words[1:])])
    last = {word.split(",")[0].split(" ")[-1].lower() for word in words}
    return last.pop().capitalize() if len(last) == 1 else "Value"


def _direction(ax: Axes, x: np.ndarray, y: np.ndarray, colour: str) -> None:
    """Draw an arrow along the curve of a portrait, after a third of the first turn."""
    i = max(1, len(x) // 12)
    if i + 1 < len(x):
        ax.annotate(
            "",
            xy=(x[i + 1], y[i + 1]),
            xytext=(x[i - 1], y[i - 1]),
            arrowprops={"arrowstyle": "-|>", "color": colour, "mutation_scale": 13, "shrinkA": 0, "shrinkB": 0},
        )
