"""Pictures of the forces and torques of a vehicle: the control matrix as a map, and curves against a parameter."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .. import _labels
from .._data import Data, scattered
from .._mistakes import unknown
from . import _style
from ._checks import checked
from ._response import Family, along

#: Names of the columns with the components of the force (mN) and of the torque (µN·m).
FORCES = ("force_forward_mn", "force_left_mn", "force_up_mn")
TORQUES = ("torque_roll_unm", "torque_pitch_unm", "torque_yaw_unm")

# A change with a smaller share of its input's largest change is shown as ≈0.
_LEAST = 1e-3


class _Effects(NamedTuple):
    """The change of each force and torque per unit of each input."""

    #: Columns of force and torque, one for each row of `values`.
    outputs: list[str]
    #: Names and units of inputs, one for each column of `values`.
    inputs: list[tuple[str, str]]
    values: np.ndarray


@checked
def control_matrix(
    table: Any,
    *,
    inputs: Sequence[str] | None = None,
    where: Mapping[str, Any] | None = None,
    colorbar: bool | Axes = True,
    ax: Axes | None = None,
    **slices: Any,
) -> _style.Drawn:
    """Draw the control matrix of a vehicle as a map: the derivative of each mean force and torque with respect to each
    input.

    Each column of the map shows the effects of one input, and each row shows the effects on one component of force or
    torque. The number in a cell of the map is the change of the force or torque per unit of the input. In each column,
    the strongest colour shows the force or torque that the input changes most. For the colours, a torque of 1 µN·m
    counts as much as a force of 1 mN. The picture shows ``≈0`` for a number below 0.1 % of the largest number in the
    same column.

    Parameters
    ----------
    table : Table, array, data frame, mapping of columns, or path
        One row of `evaluate` with ``gradient=``, the output of ``flap vehicle --format csv``, or an array of
        derivatives. An array has one column for each input, and six rows. The rows are the forces forward, left and up
        (mN), and the torques of roll, pitch and yaw (µN·m).
    inputs : list of str, optional
        The inputs to show, from left to right. If `table` is an array, `inputs` contains the names of its columns.
    where, **slices
        Values of columns that select rows, as in `flapwing.plot.response`.
    colorbar, ax
        These arguments have the same meaning as in `flapwing.plot.response`.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    ValueError
        Raised if the table has no derivatives of a force or torque, or several rows with derivatives. Raised if an
        input is unknown. Raised if `table` is an array that does not have six rows, and one column for each name in
        `inputs`.

    Examples
    --------
    >>> import numpy as np
    >>> effects = np.array([[0, 0], [0, 3e-4], [7e-3, 0], [0, 7e-3], [0, 0], [0, 0]])
    >>> ax = control_matrix(effects, inputs=["amplitude", "amplitude_difference"])
    >>> [label.get_text() for label in ax.get_yticklabels()][3]
    'Roll torque (µN·m)'
    """
    effects = _of_array(table, inputs)
    if effects is None:
        data = Data.of(table).slice(where, slices)
        effects = _of_gradient(data, inputs) or _of_command(data, inputs)
    if effects is None:
        raise ValueError(
            "the table has no derivatives of force and torque\n"
            "call evaluate with gradient=, or draw the rows with plot.force_panels"
        )
    return _map(effects, colorbar, ax)


@checked
def force_panels(table: Any, *, x: str | None = None, where: Mapping[str, Any] | None = None, **slices: Any) -> Figure:
    """Draw the forces and torques of a vehicle against one parameter, in six small panels: three forces above three
    torques.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        Results of a vehicle, with the columns of forces and torques.
    x : str, optional
        The parameter on the horizontal axes of the panels. The default of `x` is the axis of the grid.
    where, **slices
        Values of columns that select rows, as in `flapwing.plot.response`.

    Returns
    -------
    matplotlib Figure

    Raises
    ------
    ValueError
        Raised if the results do not contain the columns of forces and torques, or if a column or value is unknown.
    """
    data = Data.of(table).slice(where, slices)
    outputs = (*FORCES, *TORQUES)
    missing = [name for name in outputs if name not in data]
    if missing:
        raise ValueError(f"the table has no columns {', '.join(missing)}: it has no results of a vehicle")
    x = along(data, None) if x is None else x
    if not data.on_a_grid(x):
        raise scattered(x)
    data.numbers(x)
    data = data.for_picture([x])
    with _style.applied():
        if _style.is_narrow():
            # Forces are in the left column, torques in the right.
            axes = _style.new_figure(7.2, 7.2).subplots(3, 2, sharex=True).T
        else:
            axes = _style.new_figure(7.2, 3.9).subplots(2, 3, sharex=True)
        figure: Figure = _style.figure_of(axes[0, 0])
        family = Family(data, data, x, None)
        for each, name in zip(axes.flat, outputs):
            family.draw(each, name)
            each.axhline(0.0, color=_style.GREY, linewidth=_style.width(0.5), zorder=1)
        lowest = axes[:, 2] if _style.is_narrow() else axes[1]
        family.mark(axes[1, 0] if _style.is_narrow() else axes[0, 2])
        for each in lowest:
            each.set_xlabel(family.x.label)
        figure.align_ylabels()
    return figure


def _of_array(table: Any, inputs: Sequence[str] | None) -> _Effects | None:
    """Return the effects of the inputs from an array of derivatives. `inputs` contains the names of the columns of the
    array.
    """
    if not isinstance(table, (np.ndarray, list, tuple)):
        return None
    values = np.asarray(table, dtype=float)
    if values.ndim != 2 or values.shape[0] != 6:
        raise ValueError(
            f"the array has the shape {values.shape}; force and torque require six rows, one column per input"
        )
    names = [] if inputs is None else list(inputs)
    if len(names) != values.shape[1]:
        raise ValueError(f"`inputs` has {len(names)} names, but the array has {values.shape[1]} columns")
    return _Effects([*FORCES, *TORQUES], [(name, "") for name in names], values)


def _of_gradient(data: Data, inputs: Sequence[str] | None) -> _Effects | None:
    """Return the effects of the inputs from a table with derivatives. The table must have exactly one row."""
    gradient = data.meta.get("gradient")
    if not gradient:
        return None
    if len(data) != 1:
        raise ValueError(f"the table has {len(data)} rows with derivatives: choose one, such as table[:1]")
    outputs = [name for name in (*FORCES, *TORQUES) if name in gradient["of"]]
    if not outputs:
        raise ValueError(f"the table has derivatives of {', '.join(gradient['of'])}, but of no force or torque")
    names = dict(zip(((of, by) for of in gradient["of"] for by in gradient["with_respect_to"]), gradient["columns"]))
    by = _chosen(inputs, gradient["with_respect_to"])
    values = np.array([[float(data[names[of, name]][0]) for name in by] for of in outputs])
    return _Effects(outputs, [(name, _per(data.unit(names[outputs[0], name]))) for name in by], values)


def _per(unit: str) -> str:
    """Return the unit of an input, which is the denominator in the unit of the input's effect."""
    return unit.partition("/")[2].strip("()")


def _of_command(data: Data, inputs: Sequence[str] | None) -> _Effects | None:
    """Return the effects of the inputs from a table that the command `flap vehicle` prints. A table of `flap vehicle`
    has one row of means, followed by one row for each input.
    """
    if "input" not in data:
        return None
    names = [str(name) for name in data["input"]]
    outputs = [name for name in (*FORCES, *TORQUES) if name in data]
    if not outputs:
        raise ValueError("the table has no column of a force or torque")
    places = [names.index(name) for name in _chosen(inputs, [name for name in names if name != "mean"])]
    units = [str(unit) for unit in data["unit"]] if "unit" in data else [""] * len(names)
    values = np.array([[float(data[output][place]) for place in places] for output in outputs])
    return _Effects(outputs, [(names[place], units[place]) for place in places], values)


def _chosen(inputs: Sequence[str] | None, known: Sequence[str]) -> list[str]:
    """Return the names of the inputs that the picture shows."""
    for name in inputs or ():
        if name not in known:
            raise unknown("input", name, known)
    return list(known if inputs is None else inputs)


def _map(effects: _Effects, colorbar: bool | Axes, ax: Axes | None) -> _style.Drawn:
    """Draw the control matrix as a map, with a number in each cell."""
    values = effects.values
    sizes = np.abs(values)
    largest = np.max(np.where(np.isfinite(sizes), sizes, 0.0), axis=0)
    shares = values / np.where(largest > 0, largest, 1.0)
    own = ax is None
    with _style.applied(ax):
        ax = drawn = _style.axes_of(ax, 2.4 + 1.15 * len(effects.inputs), 3.6)
        ax.grid(False)
        mesh = ax.imshow(shares, cmap="RdBu_r", vmin=-1.0, vmax=1.0, aspect="auto")
        for row, column in np.ndindex(values.shape):
            share = abs(float(shares[row, column]))
            colour = "white" if share > 0.6 else _style.DARK
            text = _cell(float(values[row, column]), share)
            ax.text(column, row, text, ha="center", va="center", color=colour, fontsize="small")
        is_narrow = own and _style.is_narrow()
        turned: Any = {"rotation": 90, "fontsize": "small"} if is_narrow else {}
        ax.set_xticks(range(len(effects.inputs)), labels=[_input(*each) for each in effects.inputs], **turned)
        ax.set_yticks(range(len(effects.outputs)), labels=[_labels.label(name) for name in effects.outputs])
        for line in np.arange(0.5, len(effects.inputs) - 1):
            ax.axvline(line, color="white", linewidth=_style.width(1.0))
        ax.tick_params(length=0)
        above: Any = {"location": "top"} if is_narrow and colorbar is True else {}
        _style.colour_bar(ax, mesh, colorbar, label="Share of the input's largest change", **above)
    return drawn


def _input(name: str, unit: str) -> str:
    """Return the name and the unit of an input as text with several short lines."""
    text = _labels.words(name, unit).replace(", ", ",\n").replace(" ", "\n", 1)
    return f"{text}\nper {_labels.printed(unit)}" if unit else text


def _cell(value: float, share: float) -> str:
    """Return the number in a cell of the control matrix, with three digits."""
    if not np.isfinite(value):
        return "?"
    return "≈0" if share < _LEAST else _labels.number(float(f"{value:.3g}"))
