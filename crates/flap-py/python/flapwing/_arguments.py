"""Conversion of arguments to the types that the compiled module takes."""

from __future__ import annotations

import operator
import os
from collections.abc import Mapping
from typing import Any

import numpy as np

from . import _flapwing
from ._mistakes import reading, refused
from ._table import Table
from ._types import Design, Executor

#: The forms that a set of columns may have, for messages.
COLUMNS = "it must be a dictionary of columns, a Table, a DataFrame (pandas, polars) or an Arrow table"


def columns_of(name: str, given: Any) -> dict[str, Any]:
    """Return a dictionary of the columns of a mapping, a Table, a DataFrame or an Arrow table."""
    found: dict[Any, Any] | None = None
    with reading(name, given, COLUMNS):
        is_lazy = not isinstance(given, Mapping) and hasattr(given, "collect")
        if isinstance(given, Mapping):
            found = dict(given)
        elif not is_lazy and not isinstance(given, (str, bytes)) and hasattr(given, "__getitem__"):
            names = getattr(given, "column_names", getattr(given, "columns", None))
            found = None if names is None else {column: given[column] for column in names}
    if is_lazy:
        raise refused(name, given, "it has no columns yet: call its method collect() first")
    if found is None:
        raise refused(name, given, COLUMNS)
    for column in found:
        if not isinstance(column, str):
            raise TypeError(
                f"`{name}` has a column called {column!r}, which is {type(column).__name__}\nnames are text"
            )
    return found


def numbers(name: str, values: Any, *, unknown: bool = False) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Return a column of numbers as float64. If `unknown` is true, nulls and masked values become nan. If `unknown` is
    false, nulls and masked values raise ValueError.
    """
    if isinstance(values, np.ma.MaskedArray) or not unknown:
        refuse_missing(name, values)
    allowed = "it must be numbers: a list, an array or a Series"
    with reading(name, values, allowed):
        try:
            array = np.asarray(values)
            if array.dtype.kind == "O":
                array = array.astype(np.float64)
        except (TypeError, ValueError):
            array = np.empty((0, 0))
    if array.ndim != 1 or array.dtype.kind not in "fiu":
        raise refused(name, values, "it must be numbers in one dimension: a list, an array or a Series")
    return np.require(array, np.float64, ["C", "A"])


def refuse_missing(name: str, values: Any) -> None:
    """Raise ValueError if a column has masked values or nulls, because every point requires a value."""
    kind, missing = "masked", 0
    with reading(name, values, "it must be a list, an array or a Series"):
        if isinstance(values, np.ma.MaskedArray):
            missing = int(np.count_nonzero(values.mask))
        elif isinstance(getattr(values, "null_count", None), int):  # Arrow
            kind, missing = "null", values.null_count
        elif callable(getattr(values, "null_count", None)):  # polars
            kind, missing = "null", int(values.null_count())
        elif hasattr(values, "isna") and not isinstance(getattr(values, "dtype", None), np.dtype):  # pandas
            kind, missing = "null", int(np.count_nonzero(values.isna()))
    if missing:
        count = values.size if kind == "masked" else len(values)
        remedy = ".filled(...)" if kind == "masked" else "the library's fill_null or fillna"
        raise ValueError(
            f"`{name}` has {missing} {kind} of {count} values, but a point needs all of them\n"
            f"leave these rows out of every column, or replace the missing values with {remedy}"
        )


def record(name: str, given: Any, *headings: str) -> str | dict[str, Any]:
    """If a waveform or a motion is given as the path of a file, return the path. Otherwise return the columns as a
    dictionary of arrays. A record with one column besides the time can also be a pair of arrays. `headings` are the
    names of the columns besides the time, as examples.
    """
    if isinstance(given, (str, os.PathLike)):
        return os.fspath(given)
    is_pair = len(headings) == 1
    if is_pair and isinstance(given, tuple):
        if len(given) != 2:
            raise ValueError(f"`{name}` has {len(given)} arrays\nit must have two: times (s) and values")
        given = {"time_s": given[0], headings[0]: given[1]}
    forms = "a path, a pair (times, values)," if is_pair else "a path,"
    allowed = f"it must be {forms} or columns such as {', '.join(['time_s', *headings[:-1]])} and {headings[-1]}"
    if not isinstance(given, Mapping) and not _is_table(name, given, allowed):
        raise refused(name, given, allowed)
    columns = columns_of(name, given)
    if isinstance(given, Table):
        # Columns of words, and columns with unknown values, do not describe the motion.
        columns = {column: values for column, values in columns.items() if _is_known(values)}
    return {column: numbers(f"{name}[{column!r}]", values) for column, values in columns.items()}


def _is_table(name: str, given: Any, allowed: str) -> bool:
    """Return True if the argument is a table with columns, for example a LazyFrame of polars."""
    with reading(name, given, allowed):
        return any(hasattr(given, attribute) for attribute in ("collect", "columns", "column_names"))


def _is_known(values: Any) -> bool:
    return values.dtype.kind in "fiu" and bool(np.isfinite(values).all())


def waves(waveform: Any, stroke: Any) -> dict[str, Any]:
    """Return the arguments `waveform` and `stroke` in the form that the compiled module requires."""
    return {
        "waveform": None if waveform is None else record("waveform", waveform, "wave"),
        "stroke": None if stroke is None else record("stroke", stroke, "stroke_rad"),
    }


def state(design: Design, initial_state: Any) -> dict[str, Any] | None:
    """Return the components of the initial state by name. If `initial_state` is a row of a table, return only the
    columns that are states of the design's model.
    """
    if initial_state is None:
        return None
    allowed = 'it must be a dictionary of components such as {"pitch": "10 deg"}, or a table of one row'
    if not isinstance(initial_state, Mapping) and not _is_table("initial_state", initial_state, allowed):
        row = initial_state
        with reading("initial_state", initial_state, allowed):
            initial_state = row.to_dict() if hasattr(row, "to_dict") else None
        if not isinstance(initial_state, Mapping):
            raise refused("initial_state", row, allowed)
    found = columns_of("initial_state", initial_state)
    names = _flapwing.states(design)
    missing = [name for name in names if name not in found]
    if isinstance(initial_state, Mapping) and missing:
        return found
    if missing:
        raise ValueError(
            f"`initial_state` lacks the columns {', '.join(missing)}\na trajectory of the same model has them"
        )
    components = {name: _only_value(f"initial_state[{name!r}]", found[name]) for name in names}
    if any(_is_missing(f"initial_state[{name!r}]", value) for name, value in components.items()):
        # As in batches, the motion begins at rest if a component is unknown.
        return {}
    return components


def _only_value(name: str, value: Any) -> Any:
    """Return the value of a column that has one row. A value that is not a column is returned unchanged."""
    with reading(name, value, "it must be a number, text with a unit, or a column of one row"):
        rows = len(value) if not isinstance(value, str) and hasattr(value, "__len__") else None
    if rows is None:
        return value
    if rows != 1:
        raise ValueError(f"`initial_state` has {rows} rows\nchoose one of them: table[-1:] is the last")
    return numbers(name, value, unknown=True)[0]


def _is_missing(name: str, value: Any) -> bool:
    with reading(name, value, "it must be a number or text with a unit"):
        return value is None or bool(value != value)


def states(design: Design, initial_state: Any) -> np.ndarray[Any, np.dtype[np.float64]] | None:
    """Return the initial states of many points as an array: one row per point, and one column per component of the
    state. Return None if no initial state is given, so that all motions begin at rest.
    """
    if initial_state is None:
        return None
    found = columns_of("initial_state", initial_state)
    names = _flapwing.states(design)
    missing = [name for name in names if name not in found]
    if missing:
        raise ValueError(
            f"`initial_state` lacks the columns {', '.join(missing)}\nrows of a call with return_states=True have them"
        )
    listed = [numbers(f"initial_state[{name!r}]", found[name], unknown=True) for name in names]
    if len({len(values) for values in listed}) > 1:
        raise ValueError("the columns of `initial_state` differ in length\neach must have one value per point")
    return np.column_stack(listed)


def measures(names: Any) -> list[str] | None:
    """Return names of measures as a list."""
    return name_list("measures", names, "lift_mean_mn")


def gradient(names: Any) -> list[str] | None:
    """Return names of parameters as a list. An empty list raises ValueError."""
    listed = name_list("gradient", names, "hinge_stiffness")
    if listed == []:
        raise ValueError('`gradient` is empty\nit must be a list of names such as ["hinge_stiffness"]')
    return listed


def name_list(argument: str, names: Any, example: str) -> list[str] | None:
    """Return names as a list, or None if `names` is None."""
    if names is None:
        return None
    if isinstance(names, str) or not hasattr(names, "__iter__"):
        raise refused(argument, names, f'it must be a list of names such as ["{example}"]')
    with reading(argument, names, f'it must be a list of names such as ["{example}"]'):
        listed = list(names)
    for name in listed:
        if not isinstance(name, str):
            raise refused(argument, name, f'its entries must be names such as "{example}"')
    return [str(name) for name in listed]


def flag(name: str, value: Any) -> bool:
    """Return `value` as a bool. Raise TypeError if `value` is not True or False."""
    if not isinstance(value, (bool, np.bool_)):
        raise refused(name, value, "it must be True or False")
    return bool(value)


def executor(client: Any) -> Executor:
    """Return `client`, an executor such as the client of a Dask cluster. Raise TypeError if `client` is not an
    executor."""
    if not callable(getattr(client, "submit", None)) or isinstance(client, type):
        raise refused(
            "client",
            client,
            "it must be an executor, such as concurrent.futures.ProcessPoolExecutor(), or the client of a Dask cluster",
        )
    checked: Executor = client
    return checked


def count(name: str, value: Any, least: int = 1) -> int:
    """Return a whole number. Raise TypeError if the value is not a whole number, and ValueError if the number is less
    than `least`."""
    if isinstance(value, (bool, np.bool_)) or not hasattr(value, "__index__"):
        raise TypeError(f"`{name}` must be a whole number, not {type(value).__name__}")
    number = operator.index(value)
    if number < least:
        raise ValueError(f"`{name}` must be {least} or more, not {number}")
    return number
