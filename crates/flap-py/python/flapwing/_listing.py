"""Lists of parameters, measures and states."""

from __future__ import annotations

from typing import NamedTuple

from . import _flapwing
from ._types import Design

__all__ = ["Parameter", "measures", "params", "states"]


class Parameter(NamedTuple):
    """A parameter of a model."""

    #: Name in grids, on the command line and as a keyword.
    name: str
    #: Value in the design, in SI units, or the name of an option. None if it is not set and follows others, or if a grid
    #: varies it.
    value: float | str | None
    #: SI unit; ``""`` for pure numbers and options.
    unit: str
    #: Symbol in the paper; ``""`` if it has none.
    symbol: str
    #: One line of meaning, with its source.
    doc: str
    #: The allowed values, in words.
    allowed: str
    #: Its options, if it is a choice; else empty.
    options: tuple[str, ...]


def params(design: Design, /) -> dict[str, Parameter]:
    """The parameters of a design, with their values, or of a model, without.

    Parameters
    ----------
    design : str, path, dict, Grid or Vehicle
        A preset, such as ``"ozaki2018-large"``, a device, a grid or a `Vehicle` (of its first point), or a model, such as
        ``"direct-drive"``.

    Returns
    -------
    dict of str to Parameter
        By name, in the order of the model's table. Those of a vehicle follow those of its model.

    Raises
    ------
    ValueError
        There is no such preset or model. GridError if there are mistakes in a device or a grid.

    Examples
    --------
    >>> flapwing.params("ozaki2018-large")["drive_frequency"].unit
    'Hz'
    """
    listed = (Parameter(*row[:-1], options=tuple(row[-1])) for row in _flapwing.params(design))
    return {parameter.name: parameter for parameter in listed}


def measures(design: Design, /) -> dict[str, tuple[str, str]]:
    """The measures in rows of a design or a model: the unit and the meaning of each column.

    Parameters
    ----------
    design : str, path, dict, Grid or Vehicle
        As for `params`.

    Returns
    -------
    dict of str to (str, str)
        Unit and meaning by column, in the order of the rows.

    Raises
    ------
    ValueError
        As for `params`.

    Examples
    --------
    >>> flapwing.measures("ozaki2018-large")["lift_mean_mn"][0]
    'mN'
    """
    return {column: (unit, doc) for column, unit, doc in _flapwing.measures(design)}


def states(design: Design, /) -> dict[str, str]:
    """The states of the equations of motion of a design or a model: the components of `begin`, each with its unit.

    Parameters
    ----------
    design : str, path, dict, Grid or Vehicle
        As for `params`. A vehicle has those of each wing, with the wing's name in front.

    Returns
    -------
    dict of str to str
        Unit by component, in the order of the state. Columns of `trajectory` have the same names with the unit behind.

    Raises
    ------
    ValueError
        As for `params`.

    Examples
    --------
    >>> flapwing.states("ozaki2018-large")["pitch_rate"]
    'rad/s'
    """
    return dict(_flapwing.split_unit(state) for state in _flapwing.states(design))
