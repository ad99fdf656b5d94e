"""Tables of results, with one array for each column."""

from __future__ import annotations

import copy
import warnings
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from . import _columns, _flapwing
from ._columns import Column
from ._mistakes import callers_level, raised, unknown
from ._results import Verdict, cell_text

if TYPE_CHECKING:
    import pandas
    import polars
    import pyarrow
    import xarray

#: Number of rows that a notebook shows.
_SHOWN_ROWS = 10
#: Number of column names that the text of a table shows in one line.
_SHOWN_NAMES = 8

#: Allowed keys of a table, for error messages.
_KEYS = (
    "columns are chosen by a name or a list of names, "
    "rows by a slice or by an array of one dimension: a mask or indices"
)


def _columns_of(native: dict[str, Any]) -> dict[str, Column]:
    units = native.get("units", {})
    columns = {name: Column(*parts) for name, parts in native["columns"].items()}
    return {name: column._replace(unit=units.get(name, column.unit)) for name, column in columns.items()}


def _read_only(values: Any) -> np.ndarray[Any, Any]:
    """Return values as a read-only array. If a table is a selection of rows of another table, the two tables can share
    memory, so writing is not allowed."""
    array = np.asarray(values).view()
    array.flags.writeable = False
    return array


class Table:
    """A table of results. Each column is a NumPy array, and all columns have the same length.

    ``table["lift_mean_mn"]`` is a column. ``table[["drive_frequency", "lift_mean_mn"]]`` is a table of some of the
    columns. ``table[rows]`` is a table of some of the rows, where `rows` is a slice, a mask or indices. ``len(table)``
    is the number of rows. A loop over a table yields the names of the columns, as for a DataFrame. Columns are
    read-only. To change values, use a copy such as ``table["lift_mean_mn"].copy()``.

    Numbers are float64, with nan for unknown values such as the measures of a point that is not periodic. Counts are
    uint64, flags are bool, options and words are text. If the flag of any row is unknown, the column of the flag is
    float64: 1 for True, 0 for False, nan for unknown. ``table[table["stable"] == 1]`` selects stable rows in a bool
    column and in a float64 column. `units` has the units of the columns, and `docs` has the meanings of the columns.

    Attributes
    ----------
    axes : list of dict
        The axes of the grid. Along the rows, the last axis varies fastest. The dictionary of an axis has the parameters
        that vary together along the axis, with the values of all these parameters. The arrays of the parameter values
        are read-only. `axes` is empty if the rows do not come from a grid with axes.
    meta : dict
        The origin of the rows. The entries are `flap` (version), `build` (a hash of the sources), `model`, `preset`,
        `solver`, `arithmetic` and `grid` (the text of the grid file). Further entries are `counts` (number of rows by
        status), `excluded` (number of points without a row) and `invalid` (the first few invalid points, with reasons).
        `keywords` has the keywords of the call, which replace values of the grid. If you select some of the rows or
        columns, the new table has the entries of the original table, except new values of `rows` and `counts`.
    """

    axes: list[dict[str, np.ndarray[Any, Any]]]
    meta: dict[str, Any]
    #: The columns; None until they are read from the file `_path`.
    _loaded: dict[str, Column] | None
    _path: str

    def __init__(self, *_: object) -> None:
        raise TypeError("a Table is returned by sweep, evaluate, respond, trajectory or read\ncall one of them")

    @classmethod
    def _of(cls, native: dict[str, Any], path: str | None = None, keywords: Mapping[str, Any] | None = None) -> Table:
        """Return a table of the results of the compiled module. `keywords` contains the keyword arguments of the user's
        call. If `path` is given, a column is read from the file `path` when the column is first used.
        """
        meta = {**native.get("meta", {}), **native.get("summary", {})}
        if keywords is not None:
            meta["keywords"] = dict(keywords)
        if path is None:
            return cls._new(_columns_of(native), native.get("axes", []), meta)
        table = cls._new(None, native["axes"], meta)
        table._path = path
        return table

    @classmethod
    def _new(cls, columns: dict[str, Column] | None, axes: list[dict[str, Any]], meta: dict[str, Any]) -> Table:
        table = object.__new__(cls)
        table._loaded = columns
        table.axes = [{name: _read_only(values) for name, values in axis.items()} for axis in axes]
        table.meta = meta
        return table

    @property
    def _columns(self) -> dict[str, Column]:
        if self._loaded is None:
            native = _flapwing.read(self._path)
            # Another sweep may have replaced the rows since the call that returned this table.
            # Without a sidecar or a file of points, the origin of the rows in the file is unknown.
            found = native.get("meta", self.meta)
            changed = [name for name in ("build", "arithmetic", "solver", "grid") if found[name] != self.meta[name]]
            if changed:
                raise ValueError(
                    f"{self._path} does not have the rows of this table: {', '.join(changed)} in `meta` differ\n"
                    "read the file with flapwing.read, or repeat the sweep with another `out`"
                )
            for text in native["warnings"]:
                warnings.warn(text, stacklevel=callers_level())
            self._loaded = _columns_of(native)
        return self._loaded

    def __getstate__(self) -> dict[str, Any]:
        # A pickle contains the rows, because the file may be missing or different where the pickle is read.
        return {"_loaded": self._columns, "axes": self.axes, "meta": self.meta}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._loaded, self.meta = state["_loaded"], state["meta"]
        self.axes = [{name: _read_only(values) for name, values in axis.items()} for axis in state["axes"]]

    def __len__(self) -> int:
        return next((len(column.cells) for column in self._columns.values()), 0)

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __contains__(self, name: object) -> bool:
        return name in self._columns

    @overload
    def __getitem__(self, key: str) -> np.ndarray[Any, Any]: ...
    @overload
    def __getitem__(self, key: list[str] | tuple[str, ...]) -> Table: ...
    @overload
    def __getitem__(self, key: slice | np.ndarray[Any, Any] | Sequence[int] | Sequence[bool]) -> Table: ...
    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, str):
            return self._column(key).values()
        if isinstance(key, slice):
            try:
                return self._rows(key)
            except TypeError:
                raise TypeError(f"rows are sliced by whole numbers\n{_KEYS}") from None
        if isinstance(key, (list, tuple)) and key and all(isinstance(name, str) for name in key):
            chosen = {name: self._column(name) for name in key}
            return self._new(chosen, self.axes, copy.deepcopy(self.meta))
        if isinstance(key, np.ma.MaskedArray) and np.ma.is_masked(key):
            raise ValueError(
                f"the selection of rows has {np.count_nonzero(key.mask)} masked of {key.size} values\n"
                "leave out rows with an unknown value: table[mask.filled(False)]"
            )
        try:
            rows = np.asarray(key)
        except Exception as error:
            raise TypeError(
                f"a table is not indexed by {type(key).__name__}, which raised {raised(error)}\n{_KEYS}"
            ) from error
        if rows.ndim == 1 and rows.size == 0:
            rows = rows.astype(np.intp)
        if rows.ndim == 1 and rows.dtype.kind == "f":
            raise TypeError(
                "rows are not selected by numbers with a fraction or nan\n"
                'if this is a column of flags, of which some are unknown, compare it: table[table["stable"] == 1]'
            )
        if rows.ndim != 1 or rows.dtype.kind not in "biu":
            raise TypeError(f"a table is not indexed by {type(key).__name__}: {key!r:.60}\n{_KEYS}")
        return self._rows(rows)

    def _column(self, name: str) -> Column:
        try:
            return self._columns[name]
        except KeyError:
            raise unknown("column", name, self._columns) from None

    def _rows(self, key: slice | np.ndarray[Any, Any]) -> Table:
        """Return a table with the rows that `key` selects. The attribute `meta` of the new table has the counts of the
        selected rows.
        """
        columns = {name: column._replace(cells=column.cells[key]) for name, column in self._columns.items()}
        table = self._new(columns, self.axes, copy.deepcopy(self.meta))
        if "counts" in table.meta:
            table.meta.update(rows=len(table), counts=table.counts)
        return table

    def keys(self) -> list[str]:
        """Return the names of the columns, so that ``dict(table)`` has all columns."""
        return list(self._columns)

    @property
    def columns(self) -> list[str]:
        """The names of the columns, from left to right."""
        return list(self._columns)

    @property
    def units(self) -> dict[str, str]:
        """The unit of each column, or ``""`` for a column without a unit."""
        return {name: column.unit for name, column in self._columns.items()}

    @property
    def docs(self) -> dict[str, str]:
        """The meaning of each column in one line. The meaning of an unknown column is ``""``."""
        return {name: column.doc for name, column in self._columns.items()}

    @property
    def counts(self) -> dict[str, int]:
        """The number of rows with each status. Statuses that do not occur are left out."""
        if "status" not in self:
            return {}
        statuses, counts = np.unique(self["status"], return_counts=True)
        return {str(status): int(count) for status, count in zip(statuses, counts)}

    @property
    def gradient(self) -> np.ndarray[Any, np.dtype[np.float64]]:
        """Derivatives of the measures, with the shape rows x measures x parameters.

        ``meta["gradient"]`` has the names of the measures, of the parameters and of the columns, in order. The unit of
        a derivative is the unit of the measure's column per SI unit of the parameter. Derivatives that ``[gradient]``
        of a grid requests are per 1 % of the parameter. A missing derivative is nan, and the column ``gradient_gap``
        has the reason.
        """
        names = self.meta.get("gradient")
        if names is None:
            raise ValueError('the table has no derivatives\ncall evaluate with gradient=["hinge_stiffness"]')
        columns = [self._column(name).cells for name in names["columns"]]
        return np.stack(columns, axis=-1).reshape(len(self), len(names["of"]), len(names["with_respect_to"]))

    @property
    def verdicts(self) -> list[Verdict]:
        """The verdicts on the responses in a table of `respond`: one verdict for each design with rows. `verdicts` is
        empty for a table that `respond` did not return.
        """
        return list(self.meta.get("verdicts", []))

    @property
    def periodic(self) -> Table:
        """The rows that have the status ``"periodic"``, as a table. Rows with a different status have no measures,
        except unstable orbits of `respond`.
        """
        return self[self["status"] == "periodic"]

    def to_pandas(self) -> pandas.DataFrame:
        """Return the table as a pandas DataFrame. Numbers are not copied if pandas allows shared memory.

        Flags have the type ``boolean``, and text is categorical. ``frame.attrs`` has `units`, and the entries of `meta`
        as text, or as JSON if an entry is not text. Columns that are not copied are read-only. To change values, use
        ``frame.copy()``.
        """
        return _columns.to_pandas(self._columns, self.meta)

    def to_polars(self) -> polars.DataFrame:
        """Return the table as a polars DataFrame, which is converted through Arrow and has null for unknown values."""
        import polars

        frame = polars.from_arrow(self.to_arrow())
        assert isinstance(frame, polars.DataFrame)
        return frame

    def to_arrow(self) -> pyarrow.Table:
        """Return the table as an Arrow table. Numbers share memory with the table, and unknown values are null.

        The metadata of the fields have the units and meanings of the columns. The metadata of the schema have the
        entries of `meta`, as ``flapwing.build``, ``flapwing.grid`` and so on. Entries that are not text are written as
        JSON. Parquet files keep the metadata of the fields and of the schema.
        """
        return _columns.to_arrow(self._columns, self.meta)

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """Return the table through the Arrow C stream interface, which requires pyarrow."""
        return self.to_arrow().__arrow_c_stream__(requested_schema)

    def to_xarray(self) -> xarray.Dataset:
        """Return the table as an xarray Dataset. The dimensions of the Dataset are the axes of the grid, in the order
        of the grid.

        Each dimension has the name of the first parameter of an axis. If several parameters change together along an
        axis, the Dataset contains the second and later parameters as coordinates along the dimension of the axis. A
        table with a motion over time has the dimension ``time_s``. A table with neither axes nor times has the
        dimension ``row``. For a response, the coordinates along ``row`` are `curve`, the design's parameters, `branch`,
        and the parameter that rises and falls. Columns are variables with the attributes `units`, `long_name` and
        `description`. Points that the grid excludes have no row. The cells of an excluded point are nan, 0 or empty
        text, and columns of flags become float64. The column `point`, or the parameters of the axes, determines the
        cell of each row. If a table has neither `point` nor the parameters of the axes, ValueError is raised. The
        attributes of the Dataset are the entries of `meta`, as JSON if an entry is not text.
        """
        return _columns.to_xarray(self._columns, self.axes, self.meta)

    def __repr__(self) -> str:
        try:
            self._columns
        except Exception as error:
            # The rows are in a file that is missing or has changed.
            return f"<flapwing.Table, whose rows cannot be read: {raised(error)}>"
        counts = ", ".join(f"{count} {status}" for status, count in self.counts.items())
        statuses = f" ({counts})" if counts else ""
        names = list(self._columns)
        shown = ", ".join(names[:_SHOWN_NAMES]) + (", …" if len(names) > _SHOWN_NAMES else "")
        return f"<flapwing.Table of {len(self)} rows{statuses}, {len(names)} columns: {shown}>"

    def _repr_html_(self) -> str:
        """Return the first rows of the table as HTML, for notebooks."""
        from html import escape

        units = self.units
        heads = "".join(
            f"<th>{escape(name)}{f' ({escape(units[name])})' if units[name] else ''}</th>" for name in self._columns
        )
        first = self[:_SHOWN_ROWS]
        shown = [first[name].tolist() for name in self._columns]
        rows = "".join(
            "<tr>" + "".join(f"<td>{escape(cell_text(column[row]))}</td>" for column in shown) + "</tr>"
            for row in range(len(first))
        )
        return (
            f"<p>{len(self)} rows, {len(self._columns)} columns</p>"
            f'<div style="overflow-x:auto"><table><tr>{heads}</tr>{rows}</table></div>'
        )
