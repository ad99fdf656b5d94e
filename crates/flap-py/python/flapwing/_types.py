"""The types of arguments that several functions take."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Mapping, Protocol, Sequence, SupportsFloat, Union

from ._flapwing import Grid

if TYPE_CHECKING:
    from ._table import Table

#: A preset by its name, a grid file by its path, the text of one, its entries as a dictionary, or a Grid.
Design = Union[str, os.PathLike[str], Mapping[str, Any], Grid]

#: A parameter or a solver setting: a number in SI units, text with a unit, or the name of an option.
Value = Union[SupportsFloat, str]

#: A record over time: a CSV file by its path, columns by name, or times (s) and values.
Record = Union[str, os.PathLike[str], Mapping[str, Any], "Table", "tuple[Any, Any]"]


class Frame(Protocol):
    """A DataFrame of pandas or polars, or an Arrow table."""

    @property
    def columns(self) -> Any: ...


class Row(Protocol):
    """A row of a DataFrame of pandas."""

    def to_dict(self) -> Any: ...


#: A state at the start of a drive period: components by name, or a row that has them, also as a table of one row.
State = Union[Mapping[str, Any], "Table", Frame, Row]

#: Names of measures.
Measures = Sequence[str]
