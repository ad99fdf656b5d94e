"""The points of the comparison, and the tables that peers read and write."""

from __future__ import annotations

import csv
import itertools
import math
import random
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from .work import Axis, Work

#: The measures of the motion at a point, in the order of the benchmark.
Measures = tuple[float, ...]


@dataclass(frozen=True)
class Point:
    """A point: the amplitude and the frequency of the drive."""

    id: int
    amplitude: float
    frequency: float


def grid(count: int, work: Work) -> list[Point]:
    """Return `count` shuffled points of a grid of amplitude and frequency. The first few points are also spread over
    the whole grid."""
    amplitudes = math.isqrt(count)
    frequencies = -(-count // amplitudes)
    pairs = itertools.product(spread(work.amplitude, amplitudes), spread(work.frequency, frequencies))
    points = [Point(number, *pair) for number, pair in enumerate(pairs)]
    random.Random(7).shuffle(points)
    return points[:count]


def spread(axis: Axis, count: int) -> list[float]:
    """Return `count` evenly spaced numbers of an axis."""
    return [axis.low + (axis.high - axis.low) * i / max(1, count - 1) for i in range(count)]


def write(points: Sequence[Point], work: Work, path: Path) -> None:
    """Write the table of points that peers read."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["id", work.amplitude.column, work.frequency.column])
        writer.writerows([point.id, repr(point.amplitude), repr(point.frequency)] for point in points)


def read(path: Path, work: Work, prefix: str = "") -> dict[int, Measures]:
    """Return the measures in a table, by point."""
    with path.open(newline="", encoding="utf-8") as file:
        rows = csv.DictReader(file)
        return {int(row["id"]): tuple(float(row[prefix + name]) for name in work.columns) for row in rows}
