"""The command line that all peers share: POINTS RTOL OUT."""

from __future__ import annotations

import csv
import json
import sys
import time
from typing import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Forces (N), frequencies (Hz) and tolerance to measures by point, and how often the right-hand side was evaluated in
#: all, where that is known.
Solve = Callable[[Array, Array, float], tuple[Array, float | None]]


def sweep(solve: Solve) -> None:
    """Runs all points; says how long that took, without what is compiled once."""
    points, rtol, out = sys.argv[1:]
    with open(points, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    force = np.array([float(row["F0"]) for row in rows])
    frequency = np.array([float(row["f"]) for row in rows])

    solve(force[:1], frequency[:1], float(rtol))
    begin = time.process_time()
    found, evaluations = solve(force, frequency, float(rtol))
    seconds = time.process_time() - begin

    with open(out, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["id", "max_x", "max_psi", "lift"])
        for row, values in zip(rows, found):
            writer.writerow([row["id"], *map(float, values)])
    per_point = None if evaluations is None else evaluations / len(rows)
    print(json.dumps({"cpu_s": seconds, "rhs_per_point": per_point}))
