"""Columns of a CSV file."""

from __future__ import annotations

import csv
import os

#: Other marks between columns, with their names.
_OTHERS = {";": "semicolons", "\t": "tabs"}


def columns_of(path: str | os.PathLike[str]) -> dict[str, list[str]]:
    """The columns of a CSV file, cells as text; lines that begin with # are comments."""
    name = os.fspath(path)
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            lines = [line for line in csv.reader(file) if line and not line[0].lstrip().startswith("#")]
    except FileNotFoundError:
        raise FileNotFoundError(
            f"there is no file {name}\ngive the path of a CSV file, a dictionary of columns, or a DataFrame"
        ) from None
    except UnicodeDecodeError:
        raise ValueError(f"{name} is no text in UTF-8\nsave it as CSV in UTF-8") from None
    if not lines:
        raise ValueError(f"{name} is empty\nits first line has the names of the columns")
    headers = [header.strip() for header in lines[0]]
    for mark, told in _OTHERS.items():
        if len(headers) == 1 and mark in headers[0]:
            raise ValueError(
                f"{name} has {told} between its columns\nsave it with commas and decimal points, "
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
