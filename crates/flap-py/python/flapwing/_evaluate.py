"""Batches of points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, SupportsIndex

import numpy as np

from . import _arguments, _flapwing, _mistakes, _workers
from ._progress import Progress, shown
from ._table import Table
from ._types import Design, Executor, Measures, Value

if TYPE_CHECKING:
    import pandas
    import polars
    import pyarrow


def evaluate(
    design: Design,
    columns: Mapping[str, Any] | Table | pandas.DataFrame | polars.DataFrame | pyarrow.Table,
    /,
    *,
    threads: SupportsIndex | None = None,
    progress: Progress = False,
    client: Executor | None = None,
    points_per_task: SupportsIndex | None = None,
    measures: Measures | None = None,
    gradient: Sequence[str] | None = None,
    initial_state: Mapping[str, Any] | Table | pandas.DataFrame | polars.DataFrame | pyarrow.Table | None = None,
    return_states: bool = False,
    **keywords: Value,
) -> Table:
    """Simulate many design points, given as columns of parameters.

    Use `evaluate` in optimisers, samplers and fits. You give the parameters of all points as arrays. `evaluate` returns
    the measures of the points as arrays, in the order of the points. The points are computed in parallel, on all cores.
    The row of a point does not depend on the other points of the same call.

    Parameters
    ----------
    design : str, path, dict or Grid
        The design that all points start from: a preset, a model, or a grid (see `Grid`). For a model, give all
        parameters of the model. The tables ``[derived]``, ``[where]``, ``[measure]``, ``[solver]`` and ``[output]`` of
        a grid apply to every point. If the grid has axes, all points of the axes are computed for each row of
        `columns`, for example all frequencies for each design.
    columns : dict, Table or DataFrame
        The parameters of n points, by name. The values of a parameter are an array, a Series or a range of n numbers in
        SI units. A list of texts with units, or a list of options, is accepted too. A single value of a parameter
        applies to all points. A masked array must have no masked values. If `columns` is a `Table`, only the columns of
        parameters are used, not the measures.
    threads, progress
        The number of threads and the progress report, as for `sweep`.
    client, points_per_task
        The executor and the number of points in a task, as for `sweep`. The argument `client` does not change the rows.
    measures : list of str, optional
        The measures that the rows contain. By default, the rows contain the measures that ``[output]`` of the grid
        chooses, or all measures if the grid has no ``[output]``.
    gradient : list of str, optional
        Parameters with respect to which the measures of the settled motion are differentiated. `Table.gradient` has the
        derivatives, with the shape points × measures × parameters. The unit of a derivative is the unit of the
        measure's column per SI unit of the parameter. If you give `gradient`, the table ``[gradient]`` of a grid has no
        effect. The computation of the derivatives with respect to one parameter takes about as long as the simulation
        of three drive periods.
    initial_state : Table, dict or DataFrame, optional
        The state in which each motion begins, at the start of a drive period. The columns of `initial_state` are the
        components of the state (see `states`), with one row per point. Each column's name ends in the unit of the
        column. If a row of `initial_state` contains nan, the motion of the row's point begins at rest. If a design has
        several orbits, the state determines the orbit that is found. By default, the motion begins at rest.
    return_states : bool, optional
        If True, the table also has columns with the state of the motion at the beginning of a drive period. You can
        pass the table as `initial_state` of the next call.
    **keywords : float or str
        Parameters of all points and solver settings, as for `run`. A parameter must not be given twice, as a keyword
        argument and as a column of `columns`.

    Returns
    -------
    Table
        One row for each row of `columns`, in the order of `columns`. If the grid has axes, the table has one row for
        each combination of a row of `columns` and a point of the axes. In the table, all points of the axes for one row
        of `columns` come before the points of the next row. With a grid that has axes, `Table.axes` begins with the
        axis `row`. Points that ``[where]`` excludes have no row, but the indices in the column `point` count the
        excluded points too. A row has the status ``"invalid"`` if a value is out of range, infinite or not a number. A
        row is also invalid if the combination of parameter values is impossible. ``table.meta["invalid"]`` has the
        first few invalid points, with the reason why each point is invalid. With `gradient`, a missing derivative is
        nan, and the column ``gradient_gap`` has the reason.

    Raises
    ------
    ValueError
        Raised if a preset, parameter, option or unit is unknown. Raised if columns have different lengths or masked
        values. Raised if a parameter is given as a column and as a keyword argument. Raised if a parameter of a model
        is missing. Raised if derivatives are requested with respect to a choice, a whole number or a derived parameter.
        A grid with mistakes raises GridError.
    TypeError
        Raised if an argument has the wrong type.

    Examples
    --------
    >>> rows = flapwing.evaluate("ozaki2018-large", {"drive_frequency": [100.0, 105.0, 110.0]})
    >>> rows["lift_mean_mn"].round(2)
    array([2.79, 3.84, 4.73])
    >>> again = flapwing.evaluate("ozaki2018-large", rows[1:], rtol=1e-8, measures=["lift_mean_mn"])
    >>> again.columns[:4]
    ['point', 'drive_frequency', 'status', 'lift_mean_mn']

    The next function returns the negative lift and the derivatives of the negative lift, for
    ``scipy.optimize.minimize(…, jac=True)``:

    >>> def negative_lift(x):
    ...     columns = {"hinge_stiffness": x[:1], "drive_frequency": x[1:]}
    ...     table = flapwing.evaluate("ozaki2018-large", columns, measures=["lift_mean_mn"], gradient=list(columns))
    ...     return -table["lift_mean_mn"][0], -table.gradient[0, 0]
    >>> value, slopes = negative_lift(np.array([1e-4, 105.0]))
    >>> slopes.shape
    (2,)
    """
    given = _columns_of_points(design, columns)
    options: dict[str, Any] = {
        "measures": _arguments.measures(measures),
        "gradient": _arguments.gradient(gradient),
        "initial_state": _arguments.states(design, initial_state),
        "return_states": _arguments.flag("return_states", return_states),
        "keywords": dict(keywords),
    }
    batch = _flapwing.batch(design, given, **options)
    with shown(progress) as show:
        if client is None:
            native = _flapwing.sweep(batch, threads=threads, progress=show)
        else:
            there = _arguments.executor(client)
            with _workers.batch_chunks(batch, design, options, given, there, threads, points_per_task) as chunks:
                native = _flapwing.sweep(batch, progress=show, chunks=chunks.next)
    # Without axes, the table has no grid.
    return Table._of(native if len(native["axes"]) > 1 else {**native, "axes": []}, keywords=keywords)


def _columns_of_points(design: Design, columns: Any) -> dict[str, Any]:
    """Return the parameters of the points by name: arrays of float64, or lists of values that are not numbers. A single
    value is repeated for every point. The compiled module checks that the columns have equal lengths.
    """
    lists: dict[str, Any] = {}
    constants: dict[str, Any] = {}
    found = _parameters(design, columns) if isinstance(columns, Table) else _arguments.columns_of("columns", columns)
    for name, values in found.items():
        _arguments.refuse_missing(name, values)
        if isinstance(values, (str, bytes)) or _dimensions(name, values) == 0:
            constants[name] = values
        else:
            lists[name] = _column(name, values)
    if constants and lists:
        length = len(next(iter(lists.values())))
        for name, value in constants.items():
            lists[name] = [value] * length if isinstance(value, str) else np.full(length, _number(name, value))
        return {name: lists[name] for name in found}
    return lists or {name: [value] for name, value in constants.items()}


def _parameters(design: Design, table: Table) -> dict[str, Any]:
    """Return the columns of a table that are parameters of the design or of the table's model. If the model of the
    table is unknown, the parameters of all models are returned."""
    models = [table.meta["model"]] if table.meta.get("model") else _flapwing.presets()
    known = {parameter["name"] for model in [*models, design] for parameter in _flapwing.params(model)}
    found = {name: table[name] for name in table if name in known}
    if not found:
        raise ValueError(
            f"`columns` has no column of a parameter: add one, or give a dictionary\n{_mistakes.known_names(table)}"
        )
    return found


def _dimensions(name: str, values: Any) -> int:
    with _mistakes.reading(name, values, "it must be one value, or a list of values"):
        try:
            return np.ndim(values)
        except ValueError:
            pass
    raise _mistakes.refused(name, values, "its lists differ in length: it must be one value, or a list of values")


def _column(name: str, values: Any) -> np.ndarray[Any, Any] | list[Any]:
    """Return a column as an array of float64, or as a list if the values are not numbers."""
    if isinstance(values, (list, tuple)) and any(isinstance(value, (str, bool, np.bool_)) for value in values):
        # NumPy would convert numbers next to text to text, and True next to numbers to 1.
        return list(values)
    if isinstance(values, (dict, set, frozenset)):
        raise _mistakes.refused(name, values, "it must be one value, or a list, an array or a Series of values")
    with _mistakes.reading(name, values, "it must be one value, or a list, an array or a Series of values"):
        array = np.asarray(values)
    if array.ndim != 1:
        raise ValueError(f"`{name}` must be one value or have one dimension, not {array.ndim}")
    if array.dtype.kind in "fiu":
        return np.require(array, np.float64, ["C", "A"])
    listed: list[Any] = array.tolist()
    return listed


def _number(name: str, value: Any) -> float:
    if isinstance(value, (bool, np.bool_, bytes)):
        raise TypeError(f"`{name}` must be a number or text with a unit, not {type(value).__name__}")
    allowed = "it must be a number, text with a unit, or a column of these"
    with _mistakes.reading(name, value, allowed):
        try:
            return float(value)
        except (TypeError, ValueError):
            pass
    raise _mistakes.refused(name, value, allowed)
