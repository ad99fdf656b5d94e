"""Types of arguments that several modules use."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol, SupportsFloat, Union

import numpy as np

from ._flapwing import Grid

if TYPE_CHECKING:
    from ._table import Table

#: A design: the name of a preset, the path or the text of a grid file, a dictionary of entries, or a Grid.
Design = str | os.PathLike[str] | Mapping[str, Any] | Grid

#: A parameter or a solver setting: a number in SI units, text with a unit, or the name of an option.
Value = SupportsFloat | str

#: A waveform or a motion over time: the path of a CSV file, columns by name, or a pair of times (s) and values.
Record = Union[str, os.PathLike[str], Mapping[str, Any], "Table", "tuple[Any, Any]"]


class Frame(Protocol):
    """A pandas or polars DataFrame, or an Arrow table."""

    @property
    def columns(self) -> Any: ...


class FrameRow(Protocol):
    """The type of a row of a pandas DataFrame."""

    def to_dict(self) -> Any: ...


class Executor(Protocol):
    """An object that runs functions on workers: an executor, or the client of a Dask cluster."""

    def submit(self, function: Callable[..., Any], /, *arguments: Any, **keywords: Any) -> Any:
        """Return a future, whose method `result` returns the result of the function."""


#: A state at the start of a drive period: components by name, a row with the components, or a table of one row.
InitialState = Union[Mapping[str, Any], "Table", Frame, FrameRow]

#: Names of measures.
Measures = Sequence[str]

#: An array of numbers.
Array = np.ndarray[Any, np.dtype[np.float64]]

#: An array of truth values.
Mask = np.ndarray[Any, np.dtype[np.bool_]]

#: An array of indices.
Places = np.ndarray[Any, np.dtype[np.intp]]
