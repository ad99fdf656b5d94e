"""The points of the sweep, and the tables that peers read and write."""

from __future__ import annotations

import csv
import math
import random
from dataclasses import dataclass
from pathlib import Path
from typing import Sequence

#: Amplitude of the force (N) and drive frequency (Hz), from and to.
FORCE = (0.02, 0.2)
FREQUENCY = (60.0, 180.0)

#: The columns of what is measured.
COLUMNS = ("max_x", "max_psi", "lift")

#: max |x| (m), max |ψ| (rad), mean lift (N).
Measures = tuple[float, ...]


@dataclass(frozen=True)
class Point:
    """A drive."""

    id: int
    force: float
    frequency: float


def grid(count: int) -> list[Point]:
    """So many points of a grid of force and frequency, shuffled: the first few are spread over it, too."""
    forces = math.isqrt(count)
    frequencies = -(-count // forces)
    pairs = [(force, frequency) for force in spread(*FORCE, forces) for frequency in spread(*FREQUENCY, frequencies)]
    points = [Point(number, *pair) for number, pair in enumerate(pairs)]
    random.Random(7).shuffle(points)
    return points[:count]


def spread(low: float, high: float, count: int) -> list[float]:
    """Numbers at equal distances."""
    return [low + (high - low) * i / max(1, count - 1) for i in range(count)]


def write(points: Sequence[Point], path: Path) -> None:
    """Writes points as peers read them."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["id", "F0", "f"])
        writer.writerows([point.id, repr(point.force), repr(point.frequency)] for point in points)


def read(path: Path, prefix: str = "") -> dict[int, Measures]:
    """The measures in a table, by point."""
    with path.open(newline="", encoding="utf-8") as file:
        return {int(row["id"]): tuple(float(row[prefix + name]) for name in COLUMNS) for row in csv.DictReader(file)}
