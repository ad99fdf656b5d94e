"""Functions that convert the cells of files and columns of readings to numbers in the units of the model."""

from __future__ import annotations

import csv
import os
import re
from collections.abc import Callable
from typing import Any

import numpy as np

from .. import _flapwing
from .._mistakes import raised
from .._types import Array
from ._names import Meaning, Names
from ._noise import Noise

#: Separators of columns other than the comma, with their names.
_OTHERS = {";": "semicolons", "\t": "tabs"}


def file_columns(path: str | os.PathLike[str]) -> dict[str, list[str]]:
    """Return the columns of a CSV file as lists of text. In the file, lines that begin with # are comments."""
    name = os.fspath(path)
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            lines = [line for line in csv.reader(file) if line and not line[0].lstrip().startswith("#")]
    except FileNotFoundError:
        raise FileNotFoundError(
            f"there is no file {name}\ngive the path of a CSV file, a dictionary of columns, or a DataFrame"
        ) from None
    except UnicodeDecodeError:
        raise ValueError(f"{name} is not UTF-8 text\nsave it as CSV in UTF-8") from None
    if not lines:
        raise ValueError(f"{name} is empty\nits first line has the names of the columns")
    headers = [header.strip() for header in lines[0]]
    for mark, separators in _OTHERS.items():
        if len(headers) == 1 and mark in headers[0]:
            raise ValueError(
                f"{name} has {separators} between its columns\nsave it with commas and decimal points, "
                f"or read it with pandas: pandas.read_csv({name!r}, sep={mark!r})"
            )
    twice = sorted({header for header in headers if headers.count(header) > 1})
    if twice:
        raise ValueError(f"{name} has two columns called `{twice[0]}`\nrename or remove one")
    for number, line in enumerate(lines[1:], 1):
        if len(line) != len(headers):
            raise ValueError(
                f"{name}, row {number} has {len(line)} cells, and the header has {len(headers)}\nadd or remove cells"
            )
    return {header: [line[place].strip() for line in lines[1:]] for place, header in enumerate(headers)}


#: The help in the error message for a cell without a number.
_MISSING = "remove the row, or put the other measures into a separate data set"

#: The help in the error message for a value outside its parameter's range.
_IMPOSSIBLE = "correct the cell, or remove the row"

#: A pattern for the beginning of a number.
_NUMBER = re.compile(r"\s*[-+]?\.?\d")


def parameter_cells(names: Names, place: str, header: str, meaning: Meaning, cells: list[Any]) -> Array | list[str]:
    """Return the values in a column that contains a parameter: numbers in SI units, or names of options. Raise
    ValueError if a value is outside of the parameter's range.
    """

    def value(cell: Any) -> float:
        try:
            return _flapwing.value(names.model, meaning.name, cell)
        except ValueError as error:
            message = str(error)
            raise ValueError(message if "\n" in message else f"{message}\n{_IMPOSSIBLE}") from None

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


def measure_cells(names: Names, place: str, header: str, meaning: Meaning, cells: list[Any]) -> Array:
    """Return the readings in a column that contains a measure, in the unit of the measure."""
    unit = names.unit(meaning.name)

    def read(cell: str) -> float:
        if "%" in cell and unit:
            raise ValueError(f"`{meaning.name}` is in {unit}, but `{cell}` is a share\nwrite readings in {unit}")
        return _flapwing.quantity(meaning.name, cell, unit)

    return _numbers(place, header, meaning, cells, read)


def sigma_cells(names: Names, place: str, header: str, meaning: Meaning, cells: list[Any]) -> Noise:
    """Return the standard errors in a column that contains standard errors of a measure. The standard errors are in the
    unit of the measure, or are shares of the model's value.
    """
    shares = [isinstance(cell, str) and cell.strip().endswith("%") for cell in cells]
    if all(shares) and not meaning.is_share:
        meaning = Meaning(meaning.kind, meaning.name, 0.01, True)
        cells = [cell.strip()[:-1] for cell in cells]
    found = measure_cells(names, place, header, meaning, cells)
    if not (found > 0).all():
        row = int(np.argmin(found > 0)) + 1
        raise ValueError(
            f"{place}, standard error of `{meaning.name}`, row {row}: it must be more than zero\n"
            "if errors are unknown, leave the column out: then they are estimated"
        )
    return Noise("relative" if meaning.is_share else "absolute", found)


def _numbers(place: str, header: str, meaning: Meaning, cells: list[Any], read: Callable[[str], float]) -> Array:
    found = []
    help = _IMPOSSIBLE if meaning.kind == "parameter" else _MISSING
    for row, cell in enumerate(cells):
        where = f"{place}, column `{header}`, row {row + 1}"
        if not isinstance(cell, str) or _is_number(cell):
            found.append(meaning.factor * _number(where, cell, help))
        elif not cell.strip():
            raise ValueError(f"{where}: the cell is empty, but a number is required\n{help}")
        elif not _NUMBER.match(cell):
            raise ValueError(f"{where}: {cell!r} is not a number\nwrite a number, or text with a unit; or {help}")
        else:
            try:
                found.append(read(cell))
            except ValueError as error:
                raise ValueError(f"{where}: {error}") from None
    return np.array(found)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _number(where: str, cell: Any, help: str) -> float:
    if isinstance(cell, (bool, np.bool_)) or cell is None:
        raise ValueError(f"{where} is {cell}, which is not a number\n{help}")
    try:
        number = float(cell)
    except OverflowError:
        raise ValueError(f"{where} is too large for a 64-bit float\nwrite a number, or text with a unit") from None
    except (TypeError, ValueError):
        raise ValueError(f"{where} is {cell!r}, which is not a number\nwrite a number, or text with a unit") from None
    except Exception as error:
        found = f"{type(cell).__name__}, which raised {raised(error)}"
        raise TypeError(f"{where} is {found}\nwrite a number, or text with a unit") from error
    if not np.isfinite(number):
        raise ValueError(f"{where} is {number}, but must be a finite number\n{help}")
    return number
