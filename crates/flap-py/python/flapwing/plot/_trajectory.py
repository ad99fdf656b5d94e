"""A picture of a motion over time, with phase portraits of the motion."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, overload

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .. import _labels
from .._data import Data, Shown, joined, several
from .._flapwing import quantity
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
    label: str | Sequence[str] | None = ...,
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
    label: str | Sequence[str] | None = ...,
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
    label: str | Sequence[str] | None = None,
    legend: bool | str = True,
    ax: Axes | None = None,
) -> Figure | Axes:
    """Draw columns of a trajectory over time, and phase portraits of the motion. A phase portrait shows the rate of
    change of an angle against the angle.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        A trajectory from `flapwing.trajectory` or ``flap run --trajectory``. To compare designs, give a trajectory of
        each design: a mapping of names to trajectories, or a list of trajectories. If you compare designs, all lines of
        a design have the same colour.
    signals : str or sequence of str
        The columns to draw over time. If you give one trajectory, columns with the same unit are drawn in the same
        axes. If you give several trajectories, each column has separate axes. By default, stroke and pitch are drawn.
    portrait : sequence of str, optional
        The columns for which a phase portrait is drawn. By default, phase portraits of stroke and pitch are drawn, if
        `signals` contains these columns. If the table has no column for the rate of an angle, the rate is computed by
        finite differences.
    time : str
        The column that contains the time. If the name of the time column has no unit, the time is in seconds.
    label : str or sequence of str, optional
        The name of the trajectory in the legend. If `table` is a list of trajectories, give a list of names. By
        default, the second and later trajectories have names with numbers.
    legend
        This argument has the same meaning as in `flapwing.plot.response`.
    ax : matplotlib Axes, optional
        Axes in which the columns are drawn over time, without phase portraits. All columns in `signals` must have the
        same unit. If you give several trajectories, you can draw only one column in `ax`. If `ax` already contains
        lines, new lines get different colours, and the legend contains all lines.

    Returns
    -------
    matplotlib Figure, or Axes if `ax` is given
        The list ``figure.axes`` contains the axes over time, from top to bottom, and then the phase portraits.

    Raises
    ------
    ValueError
        Raised if a column is unknown. Raised if the number of names differs from the number of trajectories. Raised if
        you give `ax` and the columns in `signals` have several units, or if you give `ax` and `portrait`. Raised if
        `ax` already contains motions with a different unit. Raised if a phase portrait is drawn and the unit of the
        column `time` is not a unit of time.

    Examples
    --------
    >>> import numpy as np
    >>> phase = np.linspace(0.0, 2.0 * np.pi, 101)
    >>> table = {"time_s": phase / 754.0, "stroke_deg": 60.0 * np.sin(phase), "pitch_deg": 45.0 * np.cos(phase)}
    >>> [each.get_xlabel() for each in trajectory(table).axes]
    ['Time (ms)', 'Stroke (°)', 'Pitch (°)']

    Two motions in one picture:

    >>> smaller = {**table, "stroke_deg": 0.5 * table["stroke_deg"]}
    >>> figure = trajectory({"80 V": table, "60 V": smaller}, "stroke_deg")
    >>> [line.get_label() for line in figure.axes[0].lines]
    ['80 V', '60 V']
    """
    names = [signals] if isinstance(signals, str) else list(signals)
    if not names:
        raise ValueError("`signals` is empty: give at least one column")
    designs = several(table, label)
    if designs is None and not isinstance(label, (str, type(None))):
        raise ValueError("`label` has several names, but `table` is one trajectory\ngive one name")
    runs = designs or {"": Data.of(table)}
    portraits = [name for name in _ANGLES if name in names] if portrait is None else list(portrait)
    for run in runs.values():
        for name in (time, *names, *portraits):
            run.numbers(name)
    # One unit of each signal for all designs.
    data = joined(runs)
    groups: dict[str, list[str]] = {}
    for name in names:
        groups.setdefault(data.shown(name).unit if designs is None else name, []).append(name)
    if ax is not None:
        if len(groups) > 1 or portrait:
            raise ValueError(
                "`ax` is for signals of one unit; omit it for several units or portraits"
                if designs is None
                else "`ax` is for one signal of several trajectories; omit it for several signals or portraits"
            )
        portraits = []
    # A time without a unit is in seconds.
    seconds = quantity("time", f"1 {data.unit(time) or 's'}", "s") if portraits else 1.0

    with _style.applied(ax):
        if ax is not None:
            over_time, beside = [ax], list[Axes]()
        else:
            over_time, beside = _layout(len(groups), len(portraits))
        # Colours stand for signals, or for designs if there are several.
        drawn = dict.fromkeys([*names, *portraits] if designs is None else designs)
        colours = dict(zip(drawn, _style.further_shades(ax, len(drawn))))
        x = data.shown(time)
        for each, members in zip(over_time, groups.values()):
            unit = data.shown(members[0]).unit
            earlier = _earlier(each, unit)
            factor = _factor(each, x)
            for design, run in runs.items():
                for name in members:
                    shown = data.shown(name)
                    if designs is not None:
                        text = design
                    elif label is None:
                        text = shown.words
                    else:
                        text = str(label) if len(members) == 1 else f"{shown.words}, {label}"
                    each.plot(
                        factor * x.factor * run.numbers(time),
                        shown.factor * run.numbers(name),
                        color=colours[name if designs is None else design],
                        label=_numbered(text, each),
                    )
            words = list(dict.fromkeys([*earlier, *(data.shown(name).words for name in members)]))
            each.set_ylabel(_labels.titled(words[0] if len(words) == 1 else _common(words, unit), unit))
            each.margins(x=0.0)
            # The first legend is sufficient for all axes if colours stand for designs.
            if (len(each.lines) > 1 or label is not None) and (designs is None or each is over_time[0]):
                _style.legend(each, legend, ax is not None, ncols=3, borderaxespad=0.1)
        # Axes whose motions have another unit of time keep their label.
        if factor == 1.0:
            over_time[-1].set_xlabel(x.label)
        for each, name in zip(beside, portraits):
            shown = data.shown(name)
            for design, run in runs.items():
                colour = colours[name if designs is None else design]
                angle = shown.factor * run.numbers(name)
                rate, unit = _rate(run, name, seconds * run.numbers(time), shown)
                each.plot(angle, rate, color=colour)
                each.plot(angle[:1], rate[:1], "o", color=colour, markersize=_style.size(0.7), label="start")
                _direction(each, angle, rate, colour)
            each.set_xlabel(shown.label)
            each.set_ylabel(_labels.titled(f"{shown.words} rate", unit))
    return _style.figure_of(over_time[0]) if ax is None else ax


def _earlier(ax: Axes, unit: str) -> list[str]:
    """Return a list with the label of the vertical axis, without the unit. Return an empty list if the axes contain no
    lines. Raise ValueError if the axes contain motions with a unit that differs from `unit`.
    """
    text = ax.get_ylabel()
    if not text or not ax.lines:
        return []
    words, bracket, other = text.removesuffix(")").rpartition(" (")
    if bracket and other != unit:
        raise ValueError(
            f"`ax` has the vertical axis {text!r}, but the signals are in {unit or 'no unit'}\ndraw them in other axes"
        )
    return [words if bracket else text]


def _factor(ax: Axes, time: Shown) -> float:
    """Return the factor that converts `time` to the unit of time of the motions that the axes already contain."""
    sizes = {"s": 1.0, "ms": 1e3, "µs": 1e6}
    there = [unit for unit in sizes if ax.get_xlabel() == _labels.titled(time.words, unit)]
    return sizes[there[0]] / sizes[time.unit] if there and time.unit in sizes else 1.0


def _numbered(label: str, ax: Axes) -> str:
    """Return a label for a new line that differs from the labels of all lines in the axes. If `label` exists, the new
    label is `label` with a number.
    """
    taken = [line.get_label() for line in ax.lines]
    numbers = (number for number in range(2, len(taken) + 2) if f"{label} ({number})" not in taken)
    return f"{label} ({next(numbers)})" if label in taken else label


def _layout(signals: int, portraits: int) -> tuple[list[Axes], list[Axes]]:
    """Return the axes of a new figure: first the axes over time, from top to bottom, then the axes of the phase
    portraits.
    """
    rows = max(signals, portraits)
    height = 1.0 + 1.9 * rows
    if not portraits:
        figure = _style.new_figure(6.4, height)
        return list(np.atleast_1d(figure.subplots(signals, 1, sharex=True))), []
    if _style.is_narrow():
        # The portraits are beside each other, below the axes over time.
        figure = _style.new_figure(6.4, 3.0 + 1.9 * signals)
        parts: Any = figure.subfigures(2, 1, height_ratios=[0.6 + 1.2 * signals, 1.6])
        return (
            list(np.atleast_1d(parts[0].subplots(signals, 1, sharex=True))),
            list(np.atleast_1d(parts[1].subplots(1, portraits))),
        )
    figure = _style.new_figure(8.6, max(height, 3.2))
    parts = figure.subfigures(1, 2, width_ratios=[1.7, 1.0])
    left, right = parts
    over_time = list(np.atleast_1d(left.subplots(signals, 1, sharex=True)))
    return over_time, list(np.atleast_1d(right.subplots(portraits, 1)))


def _rate(data: Data, name: str, t: np.ndarray, shown: Shown) -> tuple[np.ndarray, str]:
    """Return the rate of change of a column, and the unit of the rate. If the table has no column for the rate of
    change, the rate is computed by finite differences.
    """
    values = data.numbers(name)
    if data.unit(name) == "deg":
        stem = name[: -len("_deg")] if name.endswith("_deg") else name
        for column in (f"{stem}_rate_rad_s", f"{stem}_rate"):
            if column in data:
                return np.degrees(data.numbers(column)) / 1000.0, "°/ms"
        return np.gradient(values, t) / 1000.0, "°/ms"
    return np.gradient(shown.factor * values, t * 1000.0), f"{shown.unit}/ms" if shown.unit else "1/ms"


def _common(words: list[str], unit: str) -> str:
    """Return the label of a vertical axis that shows several columns. If the unit is degrees, the label is "Angle". For
    two columns, the label consists of the names of the two columns. For more than two columns, the label is the last
    word that all names have in common, or "Value" if the last words differ.
    """
    if unit == "°":
        return "Angle"
    if len(words) <= 2:
        return ", ".join([words[0], *map(_labels.lowered, words[1:])])
    last = {word.split(",")[0].split(" ")[-1].lower() for word in words}
    return last.pop().capitalize() if len(last) == 1 else "Value"


def _direction(ax: Axes, x: np.ndarray, y: np.ndarray, colour: str) -> None:
    """Draw an arrow that shows the direction of a phase portrait's curve, after the first twelfth of the samples."""
    i = max(1, len(x) // 12)
    if i + 1 < len(x):
        ax.annotate(
            "",
            xy=(x[i + 1], y[i + 1]),
            xytext=(x[i - 1], y[i - 1]),
            arrowprops={"arrowstyle": "-|>", "color": colour, "mutation_scale": 13, "shrinkA": 0, "shrinkB": 0},
        )
