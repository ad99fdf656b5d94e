"""A picture of flights over time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, overload

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from .. import _flapwing, _labels
from .._data import Data, several
from .._mistakes import unknown
from . import _style
from ._checks import checked
from ._forces import FORCES, TORQUES


class _Panel(NamedTuple):
    """The contents of one panel of the picture: columns with the same unit."""

    words: str
    #: The unit for printing, and the factor from the unit of the columns to the unit for printing.
    unit: str
    factor: float
    #: Columns, each with the name in the legend.
    columns: dict[str, str]


_ALONG, _ABOUT = ("forward", "left", "up"), ("roll", "pitch", "yaw")


def _states(words: str, unit: str, factor: float, stem: str, ending: str, names: tuple[str, ...]) -> _Panel:
    return _Panel(words, unit, factor, {f"{stem}_{name}_{ending}": name for name in names})


#: The groups of columns that every flight has.
GROUPS = {
    "velocity": _states("Velocity", "m/s", 1.0, "velocity", "m_s", _ALONG),
    "rate": _states("Rate", "rad/s", 1.0, "rate", "rad_s", _ABOUT),
    "position": _states("Position", "mm", 1e3, "position", "m", _ALONG),
    "angle": _states("Angle", "°", 180.0 / np.pi, "angle", "rad", _ABOUT),
    "force": _Panel("Force", "mN", 1.0, dict(zip(FORCES, _ALONG))),
    "torque": _Panel("Torque", "µN·m", 1.0, dict(zip(TORQUES, _ABOUT))),
}

#: Line styles of flights, in the order of the flights.
_STYLES = ("-", "--", ":", "-.")


@overload
def flight(
    table: Any,
    groups: str | Sequence[str] | None = ...,
    *,
    label: Sequence[str] | None = ...,
    legend: bool | str = ...,
    ax: None = ...,
) -> Figure: ...
@overload
def flight(
    table: Any,
    groups: str | Sequence[str] | None = ...,
    *,
    label: Sequence[str] | None = ...,
    legend: bool | str = ...,
    ax: Axes,
) -> Axes: ...
@checked
def flight(
    table: Any,
    groups: str | Sequence[str] | None = None,
    *,
    label: Sequence[str] | None = None,
    legend: bool | str = True,
    ax: Axes | None = None,
) -> Figure | Axes:
    """Draw a flight of a vehicle over time, with one panel for each group of columns. You can draw several flights in
    the same panels.

    The colour of a line shows the component, such as forward or left, and the line style shows the flight. Circles at
    the time zero show the initial states that the argument `disturbance` of `flapwing.fly` sets. For an input, the
    picture shows the change from its value at the beginning of the flight. An input is constant during a wing beat.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        A flight from `flapwing.fly` or ``flap vehicle --fly``. To compare up to four flights, give a mapping of names
        to flights, or a list of flights.
    groups : str or sequence of str, optional
        The groups of columns to draw: ``"velocity"`` (m/s), ``"rate"`` (rad/s), ``"position"`` (mm), ``"angle"``
        (degrees), ``"force"`` (mN), ``"torque"`` (µN·m) and ``"inputs"``. The group ``"inputs"`` has one panel for each
        unit. The default of `groups` is velocity, rate, position and angle, and the inputs if the flights have inputs.
    label : sequence of str, optional
        The name of each flight, if `table` is a list of flights.
    legend, ax
        These arguments have the same meaning as in `flapwing.plot.response`. If you give `ax`, choose one group, and
        the group must have only one panel.

    Returns
    -------
    matplotlib Figure, or Axes if `ax` is given
        The axes in the figure are in the order of `groups`.

    Raises
    ------
    ValueError
        Raised if a table does not contain a flight, or if a group is unknown. Raised if you give more than four
        flights, or if the number of names differs from the number of flights. Raised if you give `ax` and the picture
        has several panels.

    Examples
    --------
    >>> import numpy as np
    >>> names = ["velocity_forward_m_s", "velocity_left_m_s", "velocity_up_m_s"]
    >>> table = {"time_s": np.linspace(0.0, 1.0, 5), **{name: np.zeros(5) for name in names}}
    >>> flight(table, "velocity").axes[0].get_ylabel()
    'Velocity (m/s)'
    """
    runs = several(table, label)
    if runs is None:
        if label is not None:
            raise ValueError("`label` has the names of the flights of a list, but `table` is one flight\nomit `label`")
        runs = {"": Data.of(table)}
    if len(runs) > len(_STYLES):
        raise ValueError(f"`table` has {len(runs)} flights\nthe line styles are sufficient for {len(_STYLES)}")
    panels = _panels(runs, [groups] if isinstance(groups, str) else groups)
    if ax is not None and len(panels) != 1:
        raise ValueError(
            f'`ax` is for one panel, but there are {len(panels)}\nname one group, such as `groups="angle"`'
        )
    with _style.applied(ax):
        axes = _layout(len(panels)) if ax is None else [ax]
        axes[-1].set_xlabel("Time (s)")
        for each, panel in zip(axes, panels):
            handles = _draw(each, panel, runs)
            if each is axes[0] and len(runs) > 1:
                handles += [
                    Line2D([], [], color=_style.ink(each), linestyle=style, label=name)
                    for name, style in zip(runs, _STYLES)
                ]
            _style.legend(each, legend, ax is not None, handles=handles, ncols=3, borderaxespad=0.1)
    return _style.figure_of(axes[0]) if ax is None else ax


def _panels(runs: Mapping[str, Data], groups: Sequence[str] | None) -> list[_Panel]:
    """Return the panels for the given groups of columns."""
    inputs: dict[str, dict[str, str]] = {}
    states = {name for panel in GROUPS.values() for name in panel.columns}
    for run in runs.values():
        for name in run.columns:
            if name not in states and name != "time_s":
                unit = _labels.printed(run.unit(name))
                inputs.setdefault(unit, {})[name] = _labels.lowered(_labels.words(name, run.unit(name)))
    if groups is None:
        groups = ["velocity", "rate", "position", "angle", *(["inputs"] if inputs else [])]
    if not groups:
        raise ValueError(f"`groups` is empty\nname at least one of {', '.join([*GROUPS, 'inputs'])}")
    panels: list[_Panel] = []
    for group in groups:
        if group == "inputs":
            if not inputs:
                raise ValueError("the flights have no inputs\ngive the argument `inputs` to flapwing.fly")
            panels += [_Panel("Change of inputs", unit, 1.0, columns) for unit, columns in inputs.items()]
            continue
        if group not in GROUPS:
            raise unknown("group", group, [*GROUPS, "inputs"])
        for run in runs.values():
            for name in ("time_s", *GROUPS[group].columns):
                if name not in run:
                    raise ValueError(
                        f"the table has no column `{name}`\nit must be a flight, such as from flapwing.fly"
                    )
        panels.append(GROUPS[group])
    return panels


def _layout(count: int) -> list[Axes]:
    """Return new axes in two columns of panels, or in one column if the figure is narrow. If the number of panels is
    odd, the last panel has the width of both columns.
    """
    columns = 1 if count == 1 or _style.is_narrow() else 2
    rows = -(-count // columns)
    figure = _style.new_figure(3.2 + 2.8 * columns, 1.2 + 2.0 * rows)
    grid = figure.add_gridspec(rows, columns)
    last_is_wide = columns == 2 and count % 2 == 1
    axes: list[Axes] = []
    for place in range(count):
        row, column = divmod(place, columns)
        cell = grid[row, :] if last_is_wide and place == count - 1 else grid[row, column]
        axes.append(figure.add_subplot(cell, sharex=axes[0] if axes else None))
        # The panel below has the same times at the same places, unless it is wider.
        if place + columns < count - last_is_wide:
            axes[-1].tick_params(labelbottom=False)
        else:
            axes[-1].set_xlabel("Time (s)")
    return axes


def _draw(ax: Axes, panel: _Panel, runs: Mapping[str, Data]) -> list[Line2D]:
    """Draw one panel, and return the lines for the legend of this panel."""
    entries: list[Line2D] = []
    is_input = panel not in GROUPS.values()
    for (name, label), colour in zip(panel.columns.items(), _style.further_shades(ax, len(panel.columns))):
        for style, run in zip(_STYLES, runs.values()):
            if name not in run or not len(run):
                continue
            time, values = run.numbers("time_s"), panel.factor * run.numbers(name)
            options: dict[str, Any] = {"color": colour, "linestyle": style}
            if is_input:
                # Rows of means are at the middle of their beats; samples begin with their beat.
                options["drawstyle"] = "steps-mid" if time[0] > 0.0 else "steps-post"
                values = values - values[0]
            (line,) = ax.plot(time, values, label=label, **options)
            if all(entry.get_color() != colour for entry in entries):
                entries.append(line)
            stem = _labels.split_unit(name)[0]
            start = run.meta.get("disturbance", {}).get(stem)
            if start is not None:
                value = _flapwing.quantity(stem, start, run.unit(name)) if isinstance(start, str) else float(start)
                ax.plot(
                    [0.0], [panel.factor * value], "o", color=colour, fillstyle="none", label="_disturbance", zorder=3
                )
    ax.set_ylabel(_labels.titled(panel.words, panel.unit))
    return entries
