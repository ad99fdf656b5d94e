"""Columns of results, and selections of rows of results, for pictures and analysis."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from . import _labels
from ._flapwing import quantity, usual_measure
from ._mistakes import callers_level, known_names, reading, refused, unknown
from ._sweep import read
from ._table import Table

# Statuses whose rows have measures.
MEASURED = ("periodic", "unstable")

_NOT_PARAMETERS = ("point", "curve")


class Data:
    """Columns of equal length, with the units of the columns and the axes of the grid."""

    def __init__(
        self,
        columns: Mapping[str, Any],
        units: Mapping[str, str],
        grid_axes: list[list[str]],
        meta: Mapping[str, Any],
        axis_values: Mapping[str, np.ndarray] | None = None,
    ) -> None:
        self.columns = dict(columns)
        self.units = units
        #: The names of the parameters along each axis of the grid; empty for rows without a grid.
        self.grid_axes = grid_axes
        self.meta = meta
        #: The values of each parameter along an axis of the grid. A refined grid also has rows between these values.
        self.axis_values = axis_values or {}

    @classmethod
    def of(cls, data: Any) -> Data:
        """Return the data from a Table, a data frame, a mapping of columns, or the path of a file with results."""
        if isinstance(data, Data):
            return data
        if isinstance(data, (str, os.PathLike)):
            data = read(data)
        allowed = "it must be a flapwing.Table, a data frame, a mapping of columns or a path"
        with reading("table", data, allowed):
            has_names = hasattr(data, "columns") or hasattr(data, "keys")
        if not hasattr(data, "__getitem__") or not has_names:
            raise refused("table", data, allowed)
        with reading("table", data, allowed):
            names = [str(name) for name in (data.columns if hasattr(data, "columns") else data.keys())]
            columns = {name: _column(data[name]) for name in names}
            units = getattr(data, "units", None)
            meta = getattr(data, "meta", None)
        _check_lengths(columns)
        return cls(
            columns,
            units if isinstance(units, Mapping) else {},
            [list(axis) for axis in data.axes] if isinstance(data, Table) else [],
            meta if isinstance(meta, Mapping) else {},
            {name: values for axis in data.axes for name, values in axis.items()} if isinstance(data, Table) else {},
        )

    def __len__(self) -> int:
        return len(next(iter(self.columns.values()))) if self.columns else 0

    def __contains__(self, name: object) -> bool:
        return name in self.columns

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self.columns:
            raise unknown("column", name, self.columns)
        return self.columns[name]

    def numbers(self, name: str) -> np.ndarray:
        """Return a column as floats. A row without measures contains NaN."""
        column = self[name]
        if is_text(column):
            raise ValueError(f"`{name}` is text, but a column of numbers is required")
        return column.astype(float)

    def rows(self, mask: np.ndarray) -> Data:
        """Return the rows of the data for which `mask` is True."""
        columns = {name: column[mask] for name, column in self.columns.items()}
        return Data(columns, self.units, self.grid_axes, self.meta, self.axis_values)

    def unit(self, name: str) -> str:
        """Return the unit of a column in the notation of flap."""
        known = self.units.get(name)
        # In a file without a sidecar, parameters have no units.
        is_known = known is not None and (known != "" or "model" in self.meta)
        return str(known) if is_known else _labels.unit_of(name)

    def measured(self) -> np.ndarray:
        """Return an array that is True for each row with measures and False for each row without measures."""
        if "status" not in self.columns:
            return np.ones(len(self), dtype=bool)
        return np.isin(self.columns["status"].astype(str), MEASURED)

    def parameters(self) -> list[str]:
        """Return the columns that identify the point of a row: the axes of the grid, or the columns before `status`."""
        names = list(self.columns)
        if self.grid_axes:
            return [name for axis in self.grid_axes for name in axis if name in self.columns]
        if "status" in names:
            names = names[: names.index("status")]
            return [name for name in names if name not in _NOT_PARAMETERS]
        return []

    def measures(self) -> list[str]:
        """Return the columns of measures: the columns after `status`, or the columns whose names end in a unit."""
        names = list(self.columns)
        if "status" in names:
            names = names[names.index("status") + 1 :]
        else:
            names = [name for name in names if _labels.split_unit(name)[1]]
        return [name for name in names if not is_text(self.columns[name])]

    def usual(self, role: str, option: str, taken: Sequence[str] = ()) -> str:
        """Return the measure that a picture shows by default as "response", "benefit", "cost" or "motion". The command
        `flap plot` shows the same measures by default.
        """
        found = usual_measure(role, self.measures(), list(taken))
        if found is None:
            raise ValueError(f"choose the column with `{option}`\n{known_names(self.columns)}")
        return found

    def one_sample(self, shown: Sequence[str] = ()) -> Data:
        """Return one row for each design of a sample. If the grid combines a sample with axes, axes that are not in
        `shown` are fixed at their middle values."""
        left = [name for name in self.axes() if self.on_a_grid(name)]
        if len(left) == len(self.axes()):
            return self
        drawn = [self.axis(name) for name in shown]
        return self._at_the_middle([name for name in left if name not in drawn])

    def for_picture(self, names: Sequence[str], remedy: str = "") -> Data:
        """Return one row for each combination of values in the columns `names`. All axes that are not in `names` are
        fixed at their middle values, as in `flap plot`. If an axis is fixed, a warning names the axis and ends with the
        text `remedy`.
        """
        if self._has_one_row_for(names):
            return self
        shown = [self.axis(name) for name in names]
        data = self._at_the_middle([name for name in self.axes() if name not in shown and self.on_a_grid(name)], remedy)
        if not data._has_one_row_for(names):
            raise data._several_rows(names, [name for name in data.axes() if name not in shown])
        return data

    def _has_one_row_for(self, names: Sequence[str]) -> bool:
        """Return True if no two rows have the same values in all columns `names`."""
        return len(np.unique(self.groups(names))) == len(self)

    def _several_rows(self, names: Sequence[str], left: Sequence[str]) -> ValueError:
        """Return the ValueError for several rows with the same values in all columns `names`. The names in `left` are
        the axes that vary but are not shown in the picture.
        """
        if not left:
            return ValueError(f"several rows have the same {' and '.join(f'`{name}`' for name in names)}")
        first = distinct(self[left[0]])[0]
        value = repr(str(first)) if is_text(self[left[0]]) else f"{first:g}"
        lines = [f"  {self.described(name)}: {listed(distinct(self[name]))}" for name in left]
        return ValueError(
            "\n".join(
                [
                    f"choose one value of each axis that is left, such as {left[0]}={value} as a keyword argument:",
                    *lines,
                ]
            )
        )

    def _at_the_middle(self, axes: Sequence[str], remedy: str = "") -> Data:
        """Return the rows at the middle value of each axis in `axes`, and warn about the choice of the middle
        values."""
        data = self
        for name in axes:
            data = data.rows(data.on_axis(name))
            values = distinct(data[name])
            if len(values) < 2:
                continue
            middle = values[len(values) // 2]
            value, other = (repr(str(each)) if is_text(values) else f"{each:.12g}" for each in (middle, values[0]))
            unit = self.unit(name)
            value = f"{value} {unit}" if unit else value
            warnings.warn(
                f"drawn: {name} = {value}, the middle of {len(values)} values; "
                f"{name}={other} as a keyword chooses another{remedy}",
                stacklevel=callers_level(),
            )
            data = data.rows(data[name].astype(values.dtype) == middle)
        return data

    def axes(self) -> list[str]:
        """Return one parameter for each axis with more than one value. If several parameters vary together, the result
        has only the first of these parameters.
        """
        if self.grid_axes:
            firsts = [next((name for name in axis if name in self.columns), "") for axis in self.grid_axes]
            return [name for name in firsts if name and len(distinct(self.columns[name])) > 1]
        kept: list[str] = []
        combinations = 1
        for name in self.parameters():
            with_it = len(np.unique(self.groups([*kept, name]))) if len(self) else 0
            if with_it > combinations:
                kept.append(name)
                combinations = with_it
        return kept

    def followed(self) -> str | None:
        """Return the parameter that rises and falls in a table of `respond`: the column after ``branch``."""
        names = list(self.columns)
        if "branch" not in names or names[-1] == "branch":
            return None
        return str(self.meta.get("parameter") or names[names.index("branch") + 1])

    def axis(self, name: str) -> str:
        """Return the name of the axis of a parameter. The name of an axis is the first of the parameters that vary
        together along the axis."""
        for axis in self.grid_axes:
            if name in axis:
                return next(member for member in axis if member in self.columns)
        return name

    def values_along(self, name: str, whole: Data) -> np.ndarray:
        """Return the distinct values of a parameter. If the parameter has its own axis, its values are taken from
        `whole`, which contains all rows before the selection of rows.
        """
        return distinct((whole if [name] in self.grid_axes else self)[name])

    def on_a_grid(self, name: str) -> bool:
        """Return True if a parameter has an axis. Parameters of a ``[sample]`` have no axis."""
        return not any(name in axis for axis in self.grid_axes if axis[0] not in self.columns)

    def on_axis(self, name: str) -> np.ndarray:
        """Return an array that is True for each row whose value of `name` is a value of the parameter's axis. A refined
        grid also has rows between the values of the axis.
        """
        values = np.asarray(self.axis_values.get(name, ()))
        if len(values) < 2 or is_text(values) or is_text(self[name]):
            return np.ones(len(self), dtype=bool)
        known, column = np.sort(values.astype(float)), self[name].astype(float)
        after = np.clip(np.searchsorted(known, column), 1, len(known) - 1)
        distance = np.minimum(np.abs(column - known[after - 1]), np.abs(column - known[after]))
        return np.asarray(distance <= 1e-9 * np.ptp(known))

    def groups(self, names: Sequence[str]) -> np.ndarray:
        """Return a group number for each row. Rows with the same values in all columns `names` have the same number."""
        numbers = np.zeros(len(self), dtype=np.int64)
        for name in names:
            values, inverse = np.unique(self[name], return_inverse=True)
            _, numbers = np.unique(numbers * len(values) + inverse.reshape(-1), return_inverse=True)
            numbers = numbers.reshape(-1)
        return numbers

    def slice(self, where: Mapping[str, Any] | None, keywords: Mapping[str, Any]) -> Data:
        """Return the rows in which the columns have the given values."""
        chosen = {**(where or {}), **keywords}
        for name in chosen:
            if name not in self.columns:
                raise unknown("column or option", name, self.columns)
        data = self
        for name, value in chosen.items():
            column = data[name]
            if is_text(column):
                mask = column.astype(str) == str(value)
            elif isinstance(value, (str, int, float, np.number, np.bool_)):
                number = quantity(name, value, self.unit(name)) if isinstance(value, str) else float(value)
                mask = np.isclose(column.astype(float), number, rtol=1e-9, atol=0.0)
            else:
                raise refused(name, value, "it must be a number in SI units, or text with a unit")
            if not mask.any():
                values = listed(distinct(column))
                raise ValueError(f"no row has {name} = {value}; the values of {self.described(name)} are {values}")
            data = data.rows(mask)
        return data

    def described(self, name: str) -> str:
        """Return the name of a column with the unit of the column."""
        unit = self.unit(name)
        return f"{name} ({unit})" if unit else name

    def shown(self, name: str) -> Shown:
        """Return a column in a readable unit, with a label."""
        return Shown(self, name)


#: The column with the names of several results that are drawn together.
DESIGN = "design"


def several(table: Any, label: str | Sequence[str] | None) -> dict[str, Data] | None:
    """Return the data of several designs in a dictionary by the names of the designs. Return None if `table` contains
    the results of only one design."""
    if isinstance(table, (list, tuple)):
        names = [str(place) for place in range(1, len(table) + 1)] if label is None else label
        if isinstance(names, str) or len(names) != len(table):
            count = 1 if isinstance(names, str) else len(names)
            raise ValueError(f"`table` has {len(table)} results, but `label` has {count} names\ngive one name for each")
        found: Mapping[Any, Any] = dict(zip(names, table))
        if len(found) < len(table):
            raise ValueError("`label` has a name twice\ngive each result its own name")
    elif isinstance(table, Mapping) and table and all(_is_table(each) for each in table.values()):
        found = table
        if label is not None:
            raise ValueError("`label` is for a list of results; the names of a mapping are its keys")
    else:
        return None
    if not found:
        raise ValueError("`table` is empty: give at least one result")
    return {str(name): Data.of(each) for name, each in found.items()}


def _is_table(value: Any) -> bool:
    """Return True if `value` is a table of results or the path of a file with results, and False if `value` is a
    column."""
    return isinstance(value, (Data, Table, Mapping, str, os.PathLike)) or hasattr(value, "columns")


def joined(runs: Mapping[str, Data]) -> Data:
    """Return one table with the rows of several results. The first column has the names of the results. The table also
    has all columns that occur in every result.
    """
    first = next(iter(runs.values()))
    names = [name for name in first.columns if all(name in run for run in runs.values())]
    columns = {name: np.concatenate([_plain(run[name]) for run in runs.values()]) for name in names}
    labels = np.repeat(np.array(list(runs)), [len(run) for run in runs.values()])
    for name in names:
        units = {run.unit(name) for run in runs.values()}
        if len(units) > 1:
            raise ValueError(f"`{name}` has the units {listed(sorted(units))} in these results: draw them separately")
    units_of = {name: first.unit(name) for name in names}
    return Data({DESIGN: labels, **columns}, units_of, [], first.meta)


def _plain(column: np.ndarray) -> np.ndarray:
    """Return a column of words as a NumPy array of strings. NumPy strings make it possible to concatenate columns of
    different tables."""
    return column.astype(str) if is_text(column) else column


class Shown:
    """A column for a picture: the values in a readable unit, the factor that converts to the readable unit, and the
    label of the column."""

    def __init__(self, data: Data, name: str) -> None:
        self.name = name
        self.text = is_text(data[name])
        unit = data.unit(name)
        self.factor, self.unit = (1.0, "") if self.text else _labels.readable(data[name], unit)
        self.words = _labels.words(name, unit)
        self.label = _labels.titled(self.words, self.unit)
        self.values = data[name] if self.text else data[name].astype(float) * self.factor

    def value(self, value: Any) -> str:
        """Return a value of the column as text. The text of a number is the value in the readable unit, without the
        name of the unit."""
        return str(value) if self.text else _labels.number(float(value) * self.factor)


def _check_lengths(columns: Mapping[str, np.ndarray]) -> None:
    """Raise ValueError if a column is not a list of cells, or the columns differ in length."""
    for name, column in columns.items():
        if column.ndim != 1:
            kind = "a single value" if column.ndim == 0 else f"an array of shape {column.shape}"
            raise ValueError(f"column `{name}` is {kind}\ngive one column with a cell per row for each name")
    lengths = {len(column) for column in columns.values()}
    if len(lengths) > 1:
        counts = ", ".join(f"`{name}` has {len(column)}" for name, column in columns.items())
        raise ValueError(f"columns differ in length: {counts}\ngive each one cell per row")


def _column(values: Any) -> np.ndarray:
    """Return a column as an array of numbers, flags or words. Masked cells become NaN."""
    if isinstance(values, np.ma.MaskedArray) and values.mask.any():
        values = np.ma.filled(values.astype(object), np.nan)
    column = np.asarray(values)
    if column.dtype.kind not in "OT":
        return column
    # Columns of words in data frames have the type object.
    try:
        return column.astype(float)
    except (TypeError, ValueError):
        return column.astype(str)


def is_text(column: np.ndarray) -> bool:
    """Return True if the cells of a column are text instead of numbers."""
    return column.dtype.kind in "OUST"


def distinct(column: np.ndarray) -> np.ndarray:
    """Return the distinct values of a column: numbers in rising order without NaN, or words in the order of the
    column."""
    if is_text(column):
        words = column.astype(str)
        _, first = np.unique(words, return_index=True)
        return words[np.sort(first)]
    values = np.unique(column)
    return values[~np.isnan(values)] if values.dtype.kind == "f" else values


def edges(values: np.ndarray, log: bool = False) -> np.ndarray:
    """Return the edges of the cells of a picture, with one cell around each value. The values must be in rising order.
    Each inner edge is halfway between two neighbouring values. The first value is in the middle of the first cell, and
    the last value is in the middle of the last cell.
    """
    places = np.log(values) if log else np.asarray(values, dtype=float)
    if len(places) == 1:
        half = 0.05 if log else 0.05 * abs(places[0]) or 0.5
        ends = places[0] + half * np.array([-1.0, 1.0])
    else:
        middle = 0.5 * (places[1:] + places[:-1])
        ends = np.concatenate([[2 * places[0] - middle[0]], middle, [2 * places[-1] - middle[-1]]])
    return np.exp(ends) if log else ends


def scattered(name: str) -> ValueError:
    """Return the ValueError for a picture that requires an axis, if the given parameter belongs to a sample. The values
    of a sampled parameter form no axis."""
    return ValueError(f"`{name}` is sampled, so its values form no axis; draw such designs with plot.scatter")


def listed(values: Sequence[Any] | np.ndarray) -> str:
    """Return values as text for a sentence, separated by commas. If the list has more than 12 values, the text leaves
    out values in the middle of the list."""
    texts = [value if isinstance(value, str) else f"{value:.12g}" for value in values]
    if len(texts) > 12:
        texts = [*texts[:8], "…", *texts[-2:], f"({len(texts)} values)"]
        return ", ".join(texts[:-1]) + " " + texts[-1]
    return ", ".join(texts)
