"""Tables as those of other libraries."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from ._flapwing import split_unit

if TYPE_CHECKING:
    import pandas
    import pyarrow
    import xarray

    from ._table import Column, Table


def to_pandas(table: Table) -> pandas.DataFrame:
    """See `Table.to_pandas`."""
    import pandas

    def series(column: Column) -> Any:
        if column.words is not None:
            return pandas.Categorical.from_codes(column.cells.astype(np.int32), column.words)
        if column.cells.dtype == np.int8:
            return pandas.arrays.BooleanArray(column.values().copy(), ~column.known())
        return column.values()

    frame = pandas.DataFrame({name: series(column) for name, column in table._columns.items()}, copy=False)
    frame.attrs.update(_origin(table), units=table.units)
    return frame


def to_arrow(table: Table) -> pyarrow.Table:
    """See `Table.to_arrow`."""
    import pyarrow

    arrays, fields = [], []
    for name, column in table._columns.items():
        unknown = ~column.known()
        if column.words is not None:
            cells = pyarrow.array(column.cells.view(np.int32))
            array = pyarrow.DictionaryArray.from_arrays(cells, pyarrow.array(column.words, pyarrow.string()))
        else:
            array = pyarrow.array(column.values(), mask=unknown if unknown.any() else None)
        arrays.append(array)
        about = {"unit": column.unit, "doc": column.doc}
        fields.append(pyarrow.field(name, array.type, metadata={k: v for k, v in about.items() if v}))
    origin = {f"flapwing.{key}": value for key, value in _origin(table).items()}
    return pyarrow.Table.from_arrays(arrays, schema=pyarrow.schema(fields, metadata=origin or None))


def _origin(table: Table) -> dict[str, str]:
    """The entries of `meta` as text, which every format keeps: JSON, but for text itself."""
    return {
        name: value if isinstance(value, str) else json.dumps(value, default=_plain) for name, value in table.meta.items()
    }


def _plain(value: Any) -> Any:
    """A value that JSON does not know, such as a number of NumPy, as one that it knows."""
    return value.tolist() if isinstance(value, (np.generic, np.ndarray)) else str(value)


def to_xarray(table: Table) -> xarray.Dataset:
    """See `Table.to_xarray`."""
    import xarray

    dims, shape, places = _layout(table)
    axes = {name for dim in table.dims for name in dim}

    def spread(values: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
        empty = np.nan if values.dtype == np.float64 else np.zeros((), values.dtype)
        whole = np.full(int(np.prod(shape)), empty, dtype=values.dtype)
        whole[places] = values
        return whole.reshape(shape)

    def about(name: str) -> dict[str, str]:
        column = table._columns.get(name)
        if column is None:
            return {}
        words = split_unit(name)[0].replace("_", " ")
        pairs = {"units": column.unit, "long_name": words, "description": column.doc}
        return {key: value for key, value in pairs.items() if value}

    variables = {
        name: (dims, spread(column.values()), about(name))
        for name, column in table._columns.items()
        if name not in axes and not (table.dims and name == "point")
    }
    coordinates: dict[str, Any] = {
        name: (dims[place], values, about(name))
        for place, dim in enumerate(table.dims)
        for name, values in dim.items()
    }
    for name in _places(table):
        coordinates[name] = variables.pop(name)
    return xarray.Dataset(variables, coordinates, _origin(table))


def _layout(table: Table) -> tuple[list[str], list[int], np.ndarray[Any, Any]]:
    """The dimensions, their lengths, and the place of each row among all cells."""
    if not table.dims:
        is_motion = table.columns[:1] == ["time_s"] and bool((np.diff(table["time_s"]) > 0).all())
        return ["time_s" if is_motion else "row"], [len(table)], np.arange(len(table))
    dims = [next(iter(dim)) for dim in table.dims]
    shape = [len(next(iter(dim.values()))) for dim in table.dims]
    if "point" in table:
        return dims, shape, table["point"].astype(np.intp)
    indices = [_along(table, dim) for dim in table.dims]
    return dims, shape, np.ravel_multi_index(indices, shape) if len(table) else np.zeros(0, np.intp)


def _along(table: Table, dim: dict[str, np.ndarray[Any, Any]]) -> np.ndarray[Any, Any]:
    """The place of each row along an axis, by the columns of its parameters."""
    length = len(next(iter(dim.values())))
    if length == 1:
        return np.zeros(len(table), np.intp)
    names = [name for name in dim if name in table]
    places = {key: place for place, key in enumerate(zip(*(dim[name].tolist() for name in names)))}
    keys = list(zip(*(table[name].tolist() for name in names)))
    if len(places) < length or not all(key in places for key in keys):
        raise ValueError(
            f"no column tells where the rows are along the axis of {', '.join(dim)}\n"
            'keep `point` or the parameters of the axes among the columns: table[["point", …]]'
        )
    return np.array([places[key] for key in keys], np.intp)


def _places(table: Table) -> list[str]:
    """The columns that say where a row is on its curve or in time, in a table without axes."""
    if table.dims:
        return []
    names = table.columns
    if names[:1] == ["time_s"]:
        return ["time_s"]
    if "branch" in names and "status" in names:
        return names[: names.index("status")]
    return [name for name in ("begin_s", "end_s") if name in names]
