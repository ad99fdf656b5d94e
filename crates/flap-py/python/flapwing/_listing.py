"""Lists of parameters, measures and states."""

from __future__ import annotations

from . import _flapwing
from ._results import Measure, Parameter, State
from ._types import Design


def params(design: Design, /) -> dict[str, Parameter]:
    """Return the parameters of a design with their values, or the parameters of a model without values.

    Parameters
    ----------
    design : str, path, dict, Grid or Vehicle
        A preset, such as ``"ozaki2018-large"``, a device, a grid, a `Vehicle`, or a model, such as ``"direct-drive"``.
        For a grid, the values of the parameters are the values at the first point of the grid.

    Returns
    -------
    dict of str to Parameter
        Parameters by name, in the order of the parameter table of the model. For a `Vehicle`, the parameters of the
        vehicle come after the parameters of the model.

    Raises
    ------
    ValueError
        Raised if `design` is neither the name of a preset or a model, nor a readable file. A device or a grid with
        mistakes raises GridError.

    Examples
    --------
    >>> flapwing.params("ozaki2018-large")["drive_frequency"].unit
    'Hz'
    """
    listed = [Parameter(**{**one, "options": tuple(one["options"])}) for one in _flapwing.params(design)]
    return {parameter.name: parameter for parameter in listed}


def measures(design: Design, /) -> dict[str, Measure]:
    """Return the measures in the rows of a design or a model.

    Parameters
    ----------
    design : str, path, dict, Grid or Vehicle
        A design or a model, as for `params`.

    Returns
    -------
    dict of str to Measure
        The measures by the names of their columns, in the order of the columns.

    Raises
    ------
    ValueError
        Raised if the design or model is invalid, as for `params`.

    Examples
    --------
    >>> flapwing.measures("ozaki2018-large")["lift_mean_mn"].unit
    'mN'
    """
    return {one["name"]: Measure(**one) for one in _flapwing.measures(design)}


def states(design: Design, /) -> dict[str, State]:
    """Return the states of the equations of motion of a design or a model. The states are the components of the
    argument `initial_state`.

    Parameters
    ----------
    design : str, path, dict, Grid or Vehicle
        A design or a model, as for `params`. A vehicle has the states of each wing, with the wing's name as a prefix.

    Returns
    -------
    dict of str to State
        The states by name, in the order of the state vector.

    Raises
    ------
    ValueError
        Raised if the design or model is invalid, as for `params`.

    Examples
    --------
    >>> flapwing.states("ozaki2018-large")["pitch_rate"].unit
    'rad/s'
    """
    listed = (State(*_flapwing.split_unit(column), column) for column in _flapwing.states(design))
    return {state.name: state for state in listed}
