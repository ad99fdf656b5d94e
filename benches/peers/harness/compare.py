"""The errors of a peer's answers."""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import median

from .points import Measures
from .work import Work


@dataclass(frozen=True)
class Deviation:
    """Over the points, the relative deviation of the measure that is off most."""

    median: float
    largest: float
    #: Points whose answer is missing or no number.
    missing: int


def deviation(found: dict[int, Measures], known: dict[int, Measures], points: int, work: Work) -> Deviation | None:
    """Compares the answers for `points` points with those that are known. A measure that crosses zero counts by its
    size, or that of a typical point where it is smaller; none if nothing can be compared.
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
