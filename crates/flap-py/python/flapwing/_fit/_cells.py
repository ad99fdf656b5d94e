"""The cells of a column of readings: numbers, or text with a unit."""

from __future__ import annotations

import re
from typing import Any, Callable

import numpy as np

from .. import _flapwing
from .._mistakes import raised
from . import _noise
from ._columns import Meaning, Names
from ._noise import Noise
from ._types import Array

#: The help for a cell without a number.
_MISSING = "remove the row, or put the other measures into a data set of their own"

#: The help for a value outside of its parameter's range.
_IMPOSSIBLE = "correct the cell, or remove the row"

#: The beginning of a number.
_NUMBER = re.compile(r"\s*[-+]?\.?\d")


def parameters(names: Names, place: str, header: str, meaning: Meaning, cells: list[Any]) -> Array | list[str]:
    """A column of a parameter in SI units; of options, as they are. Each value is in the parameter's range."""

    def value(cell: Any) -> float:
        try:
            return _flapwing.value(names.model, meaning.name, cell)
        except ValueError as error:
            told = str(error)
            raise ValueError(told if "\n" in told else f"{told}\n{_IMPOSSIBLE}") from None

    if meaning.name in names.options:
        found: Any = [str(cell) for cell in cells]
    else:
        found = _numbers(place, header, meaning, cells, value)
    known: set[Any] = set()
    for row, cell in enumerate(found if isinstance(found, list) else found.tolist()):
        if cell not in known:
            try:
                value(cell)
            except ValueError as error:
                raise ValueError(f"{place}, column `{header}`, row {row + 1}: {error}") from None
            known.add(cell)
    return found


def measures(names: Names, place: str, header: str, meaning: Meaning, cells: list[Any]) -> Array:
    """A column of a measure, in the measure's unit."""
    unit = names.unit(meaning.name)

    def read(cell: str) -> float:
        if "%" in cell and unit:
            raise ValueError(f"`{meaning.name}` is in {unit}, and `{cell}` is a share\nwrite readings in {unit}")
        return _flapwing.quantity(meaning.name, cell, unit)

    return _numbers(place, header, meaning, cells, read)


def errors(names: Names, place: str, header: str, meaning: Meaning, cells: list[Any]) -> Noise:
    """A column of the standard errors of a measure: in its unit, or all of them in per cent of the model's value."""
    shares = [isinstance(cell, str) and cell.strip().endswith("%") for cell in cells]
    if all(shares) and not meaning.is_share:
        meaning = Meaning(meaning.kind, meaning.name, 0.01, True)
        cells = [cell.strip()[:-1] for cell in cells]
    found = measures(names, place, header, meaning, cells)
    if not (found > 0).all():
        row = int(np.argmin(found > 0)) + 1
        raise ValueError(
            f"{place}, standard error of `{meaning.name}`, row {row}: it must be more than zero\n"
            "leave the column out where errors are not known: then they are estimated"
        )
    return _noise.Noise("relative" if meaning.is_share else "absolute", found)


def _numbers(place: str, header: str, meaning: Meaning, cells: list[Any], read: Callable[[str], float]) -> Array:
    found = []
    for row, cell in enumerate(cells):
        told = f"{place}, column `{header}`, row {row + 1}"
        if not isinstance(cell, str) or _is_number(cell):
            found.append(meaning.factor * _number(told, cell))
        elif not cell.strip():
            raise ValueError(f"{told}: the cell is empty, and a reading needs a number\n{_MISSING}")
        elif not _NUMBER.match(cell):
            raise ValueError(f"{told}: {cell!r} is no number\nwrite a number, or text with a unit; or {_MISSING}")
        else:
            try:
                found.append(read(cell))
            except ValueError as error:
                raise ValueError(f"{told}: {error}") from None
    return np.array(found)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _number(told: str, cell: Any) -> float:
    if isinstance(cell, (bool, np.bool_)) or cell is None:
        raise ValueError(f"{told} is {cell}, which is no number\n{_MISSING}")
    try:
        number = float(cell)
    except OverflowError:
        raise ValueError(f"{told} is too large for a 64-bit float\nwrite a number, or text with a unit") from None
    except (TypeError, ValueError):
        raise ValueError(f"{told} is {cell!r}, which is no number\nwrite a number, or text with a unit") from None
    except Exception as error:
        found = f"{type(cell).__name__}, which raised {raised(error)}"
        raise TypeError(f"{told} is {found}\nwrite a number, or text with a unit") from error
    if not np.isfinite(number):
        raise ValueError(f"{told} is {number}, and readings are finite numbers\n{_MISSING}")
    return number
