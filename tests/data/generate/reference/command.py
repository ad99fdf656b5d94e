"""The command line: `python3 tests/data/generate`."""

from __future__ import annotations

import argparse
import csv
import sys
import time
from collections.abc import Sequence
from itertools import zip_longest
from pathlib import Path

import numpy as np

from .motion import Results, Row
from .tables import DATA, PEAK, TABLES, Size, Table


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        prog="python3 tests/data/generate",
        description="Recomputes the reference data in tests/data with SciPy, without flap. The cases are the given columns "
        "of the committed files; tests/data/README.md names these columns.",
        epilog="Exit status: 0 done, 1 a difference above its bound, 2 usage.",
    )
    parser.add_argument("file", nargs="*", help="a file or folder below tests/data; without one, all files")
    parser.add_argument("--check", action="store_true", help="compare with the committed numbers and write nothing")
    parser.add_argument("--quick", action="store_true", help="with --check: a few rows of the files that take long")
    parser.add_argument(
        "--data",
        type=lambda text: Path(text).resolve(),
        default=DATA,
        metavar="FOLDER",
        help="another folder with these files",
    )
    given = parser.parse_args(arguments)
    if given.quick and not given.check:
        parser.error("--quick needs --check: a file is written with all rows")
    tables = [
        table for table in TABLES if not given.file or any(within(table, name, given.data) for name in given.file)
    ]
    for name in given.file:
        if not any(within(table, name, given.data) for table in TABLES):
            paths = ", ".join(table.path for table in TABLES)
            parser.error(f"{name}: no file or folder of this name is computed; the files are {paths}")
    if not given.check:
        for table in tables:
            write(table, given.data / table.path)
        return 0
    wrong = [table.path for table in tables if not check(table, given.data / table.path, given.quick)]
    if wrong:
        print(f"Differences above their bounds in {', '.join(wrong)}.", file=sys.stderr)
    return 1 if wrong else 0


def within(table: Table, name: str, data: Path) -> bool:
    """True if a path on the command line, from the working directory or from tests/data, is this table or contains it."""
    path = data / table.path
    return any(named in (path, *path.parents[:-1]) for named in (Path(name).resolve(), (data / name).resolve()))


def read(path: Path) -> tuple[list[str], list[Row]]:
    """Columns and rows of a file."""
    with path.open(newline="", encoding="utf-8") as file:
        reader = csv.DictReader(file)
        rows = list(reader)
    return list(reader.fieldnames or ()), rows


def check(table: Table, path: Path, quick: bool) -> bool:
    """Recomputes a file and prints the largest difference of each column. Returns whether all are within their bounds."""
    columns, rows = read(path)
    everything = len(rows)
    peaks = {name: max(abs(float(row[name])) for row in rows) for name, size in table.sizes.items() if size == PEAK}
    if quick:
        rows = [rows[number] for number in table.quick]
    if not rows:
        return True
    begin = time.process_time()
    computed = [name for name in columns if name not in {*table.inputs, *table.second}]
    largest = dict.fromkeys(computed, 0.0)
    for row, found in zip_longest(rows, table.compute(rows)):
        for name in computed:
            if name in table.residuals:
                difference = abs(found[name])
            else:
                difference = relative(found[name], row, name, peaks.get(name, table.sizes.get(name)))
            # NumPy's maximum keeps a difference that is not a number.
            largest[name] = float(np.maximum(difference, largest[name]))
    seconds = time.process_time() - begin
    print(f"{table.path}: {len(rows)} of {everything} rows, {seconds:.1f} s")
    good = True
    for name, difference in largest.items():
        bound = table.bounds.get(name, table.bound)
        fits = difference <= bound
        print(f"  {name:32} {difference:.1e}" + ("" if fits else f"  ABOVE {bound:.0e}"))
        good = good and fits
    sys.stdout.flush()
    return good


def relative(value: float, row: Row, column: str, size: Size | None) -> float:
    """The difference to the committed number, relative to the size."""
    committed = float(row[column])
    difference = abs(value - committed)
    if difference == 0.0:
        return 0.0
    if size is None:
        size = committed
    elif isinstance(size, str):
        size = float(row.get(size, committed))
    return difference / abs(size) if size else float("inf")


def write(table: Table, path: Path) -> None:
    """Writes a file anew: given columns as they are, computed ones with all digits."""
    columns, rows = read(path)
    lines = []
    for row, found in zip_longest(rows, table.compute(rows)):
        if table.again:
            found = found | table.again(row, found)
        lines.append([cell(row, found, name) for name in columns])
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(lines)
    print(f"{table.path}: {len(rows)} rows written")


def cell(row: Row, found: Results, name: str) -> str:
    if name not in found:
        return row[name]
    value = found[name]
    return repr(value) if isinstance(value, int) else repr(float(value))
