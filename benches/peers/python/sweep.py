"""The command line that all peers share: POINTS RTOL OUT."""

from __future__ import annotations

import csv
import json
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Answers:
    """The results of a peer for all points."""

    #: The measures of each point.
    measures: Array
    #: Evaluations of the right-hand side, if the library counts them.
    rhs: float | None
    #: Number of drive periods, or None if all points have the same number of periods.
    periods: float | None = None


#: A function that returns the results from the amplitudes of the drive (N or V), the frequencies (Hz) and the
#: tolerance.
Solve = Callable[[Array, Array, float], Answers]


def sweep(solve: Solve, columns: Sequence[str]) -> None:
    """Run all points, and write the measures with the names `columns`. Print the time of the run without the time of
    the compilation."""
    points, rtol, out = sys.argv[1:]
    with open(points, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))[1:]
    amplitude = np.array([float(row[1]) for row in rows])
    frequency = np.array([float(row[2]) for row in rows])

    solve(amplitude[:1], frequency[:1], float(rtol))
    begin = time.process_time()
    found = solve(amplitude, frequency, float(rtol))
    seconds = time.process_time() - begin

    with open(out, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["id", *columns])
        for row, values in zip(rows, found.measures):
            writer.writerow([row[0], *map(float, values)])
    rhs, periods = (None if total is None else total / len(rows) for total in (found.rhs, found.periods))
    print(json.dumps({"cpu_s": seconds, "rhs_per_point": rhs, "periods_per_point": periods}))
