"""The columns of a table, and the conversion of tables to the types of pandas, Arrow and xarray."""

from __future__ import annotations

import dataclasses
import json
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ._flapwing import split_unit
from ._results import Verdict

if TYPE_CHECKING:
    import pandas
    import pyarrow
    import xarray


class Column(NamedTuple):
    """A column that the compiled module returns."""

    unit: str
    doc: str
    #: float64 or uint64 for numbers; int8 for flags (1, 0, -1 for unknown); uint32 indices of `words` for text.
    cells: np.ndarray[Any, Any]
    words: list[str] | None

    @property
    def is_flag(self) -> bool:
        """True if the column contains flags, which are True, False or unknown."""
        return self.words is None and self.cells.dtype == np.int8

    def values(self) -> np.ndarray[Any, Any]:
        """Return the values of a column as a read-only array."""
        if self.words is not None:
            words: np.ndarray[Any, Any] = np.array(self.words, dtype=np.str_)
            values = words[self.cells]
        elif self.is_flag:
            known = self.known()
            # As in pandas, flags are numbers if one of them is missing.
            values = self.flags() if known.all() else np.where(known, self.cells, np.nan)
        else:
            values = self.cells.view()
        values.flags.writeable = False
        return values

    def flags(self) -> np.ndarray[Any, Any]:
        """Return the flags of the column as an array of True and False. In the returned array, unknown flags are False.
        The function `known` returns a mask that is False for unknown flags."""
        return np.equal(self.cells, 1)

    def known(self) -> np.ndarray[Any, Any]:
        """Return an array that is True for known cells of the column, and False for unknown cells."""
        if self.is_flag:
            return np.greater_equal(self.cells, 0)
        if self.cells.dtype == np.float64:
            return ~np.isnan(self.cells)
        return np.ones(len(self.cells), dtype=np.bool_)


#: The columns of a table by name, the axes of the grid with values, and the origin of the rows.
Columns = dict[str, Column]
Axes = list[dict[str, np.ndarray[Any, Any]]]
Meta = dict[str, Any]


def to_pandas(columns: Columns, meta: Meta) -> pandas.DataFrame:
    """Return a table as a pandas DataFrame (see `Table.to_pandas`)."""
    import pandas

    def series(column: Column) -> Any:
        if column.words is not None:
            return pandas.Categorical.from_codes(column.cells.astype(np.int32), column.words)
        if column.is_flag:
            return pandas.arrays.BooleanArray(column.flags(), ~column.known())
        return column.values()

    frame = pandas.DataFrame({name: series(column) for name, column in columns.items()}, copy=False)
    frame.attrs.update(_origin(meta), units={name: column.unit for name, column in columns.items()})
    return frame


def to_arrow(columns: Columns, meta: Meta) -> pyarrow.Table:
    """Return a table as an Arrow table (see `Table.to_arrow`)."""
    import pyarrow

    arrays, fields = [], []
    for name, column in columns.items():
        unknown = ~column.known()
        if column.words is not None:
            cells = pyarrow.array(column.cells.view(np.int32))
            array = pyarrow.DictionaryArray.from_arrays(cells, pyarrow.array(column.words, pyarrow.string()))
        else:
            cells = column.flags() if column.is_flag else column.values()
            array = pyarrow.array(cells, mask=unknown if unknown.any() else None)
        arrays.append(array)
        about = {"unit": column.unit, "doc": column.doc}
        fields.append(pyarrow.field(name, array.type, metadata={k: v for k, v in about.items() if v}))
    origin = {f"flapwing.{key}": value for key, value in _origin(meta).items()}
    return pyarrow.Table.from_arrays(arrays, schema=pyarrow.schema(fields, metadata=origin or None))


def _origin(meta: Meta) -> dict[str, str]:
    """Return the entries of `meta` as text, because every file format can store text. Entries that are not text are
    written as JSON.
    """
    return {
        name: value if isinstance(value, str) else json.dumps(value, default=_plain) for name, value in meta.items()
    }


def _plain(value: Any) -> Any:
    """Convert a value that JSON cannot express, such as a NumPy number, to a value that JSON can express."""
    if isinstance(value, (np.generic, np.ndarray)):
        return value.tolist()
    return dataclasses.asdict(value) if isinstance(value, Verdict) else str(value)


def to_xarray(columns: Columns, axes: Axes, meta: Meta) -> xarray.Dataset:
    """Return a table as an xarray Dataset (see `Table.to_xarray`)."""
    import xarray

    names, shape, places = _layout(columns, axes)
    along = {name for axis in axes for name in axis}
    is_whole = len(places) == int(np.prod(shape))

    def spread(column: Column) -> np.ndarray[Any, Any]:
        values = column.values()
        if column.is_flag and not is_whole:
            values = values.astype(np.float64)
        empty = np.nan if values.dtype == np.float64 else np.zeros((), values.dtype)
        whole = np.full(int(np.prod(shape)), empty, dtype=values.dtype)
        whole[places] = values
        return whole.reshape(shape)

    def about(name: str) -> dict[str, str]:
        column = columns.get(name)
        if column is None:
            return {}
        words = split_unit(name)[0].replace("_", " ")
        pairs = {"units": column.unit, "long_name": words, "description": column.doc}
        return {key: value for key, value in pairs.items() if value}

    variables = {
        name: (names, spread(column), about(name))
        for name, column in columns.items()
        if name not in along and not (axes and name == "point")
    }
    coordinates: dict[str, Any] = {
        name: (names[place], values, about(name)) for place, axis in enumerate(axes) for name, values in axis.items()
    }
    for name in _places(columns, axes):
        coordinates[name] = variables.pop(name)
    return xarray.Dataset(variables, coordinates, _origin(meta))


def _layout(columns: Columns, axes: Axes) -> tuple[list[str], list[int], np.ndarray[Any, Any]]:
    """Return the names and lengths of the dimensions of a Dataset. Also return, for each row of the table, the index of
    its cell in the flattened arrays of the Dataset."""
    rows = len(next(iter(columns.values())).cells) if columns else 0
    if not axes:
        is_motion = next(iter(columns), None) == "time_s" and bool((np.diff(columns["time_s"].cells) > 0).all())
        return ["time_s" if is_motion else "row"], [rows], np.arange(rows)
    names = [next(iter(axis)) for axis in axes]
    shape = [len(next(iter(axis.values()))) for axis in axes]
    if "point" in columns:
        return names, shape, columns["point"].cells.astype(np.intp)
    indices = [_along(columns, axis, rows) for axis in axes]
    return names, shape, np.ravel_multi_index(indices, shape) if rows else np.zeros(0, np.intp)


def _along(columns: Columns, axis: dict[str, np.ndarray[Any, Any]], rows: int) -> np.ndarray[Any, Any]:
    """Return the index of each row along an axis: the position of the row's parameter values in the list of values of
    the axis."""
    length = len(next(iter(axis.values())))
    if length == 1:
        return np.zeros(rows, np.intp)
    names = [name for name in axis if name in columns]
    places = {key: place for place, key in enumerate(zip(*(axis[name].tolist() for name in names)))}
    keys = list(zip(*(columns[name].values().tolist() for name in names)))
    if len(places) < length or not all(key in places for key in keys):
        raise ValueError(
            f"no column gives the places of the rows along the axis of {', '.join(axis)}\n"
            'keep `point` or the parameters of the axes among the columns: table[["point", …]]'
        )
    return np.array([places[key] for key in keys], np.intp)


def _places(columns: Columns, axes: Axes) -> list[str]:
    """Return the columns that become coordinates of a Dataset for a table without axes. These columns contain the time,
    or identify a point of a curve."""
    if axes:
        return []
    names = list(columns)
    if names[:1] == ["time_s"]:
        return ["time_s"]
    if "branch" in names and "status" in names:
        return names[: names.index("status")]
    return [name for name in ("begin_s", "end_s") if name in names]
