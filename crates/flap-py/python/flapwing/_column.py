"""A column of a table."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np


class Column(NamedTuple):
    """A column as the native part hands it over."""

    unit: str
    doc: str
    #: float64 and uint64 as they are; int8 for flags (1, 0, -1 for unknown); uint32 places among `words` for text.
    cells: np.ndarray[Any, Any]
    words: list[str] | None

    @property
    def is_flag(self) -> bool:
        """True for a column of True, False and unknown."""
        return self.words is None and self.cells.dtype == np.int8

    def values(self) -> np.ndarray[Any, Any]:
        """The cells as they are shown, read-only: a table stays as it was computed."""
        if self.words is not None:
            words: np.ndarray[Any, Any] = np.array(self.words, dtype=np.str_)
            values = words[self.cells]
        elif self.is_flag:
            known = self.known()
            # Like an array of pandas: flags are numbers where one of them is missing.
            values = self.flags() if known.all() else np.where(known, self.cells, np.nan)
        else:
            values = self.cells.view()
        values.flags.writeable = False
        return values

    def flags(self) -> np.ndarray[Any, Any]:
        """A column of flags as True and False; unknown ones, which `known` tells apart, are False."""
        return np.equal(self.cells, 1)

    def known(self) -> np.ndarray[Any, Any]:
        """A mask, True for cells that hold a value."""
        if self.is_flag:
            return np.greater_equal(self.cells, 0)
        if self.cells.dtype == np.float64:
            return ~np.isnan(self.cells)
        return np.ones(len(self.cells), dtype=np.bool_)
