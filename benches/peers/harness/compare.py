"""The errors of the results of a peer."""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import median

from .points import Measures
from .work import Work


@dataclass(frozen=True)
class Deviation:
    """Statistics of the relative deviation over all points. The deviation of a point is the largest deviation of its
    measures."""

    median: float
    largest: float
    #: Number of points whose result is missing or is not a number.
    missing: int


def deviation(found: dict[int, Measures], known: dict[int, Measures], points: int, work: Work) -> Deviation | None:
    """Compare the results for `points` points with known results. Deviations are relative to the known value. If a
    measure crosses zero, a deviation is relative to the typical size of the measure where the known value is smaller.
    Return None if nothing can be compared.
    """
    if not known:
        return None
    least = [
        median(map(abs, column)) if measure.crosses_zero else 0.0
        for measure, column in zip(work.measures, zip(*known.values()))
    ]
    worst = []
    for number, true in known.items():
        got = found.get(number)
        if got is None or not all(map(math.isfinite, got)):
            continue
        worst.append(max(abs(a - b) / max(abs(b), size) for a, b, size in zip(got, true, least)))
    if not worst:
        return None
    answered = sum(all(map(math.isfinite, measures)) for measures in found.values())
    return Deviation(median(worst), max(worst), points - answered)
