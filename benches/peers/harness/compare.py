"""The errors of a peer's answers."""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import median

from .points import Measures


@dataclass(frozen=True)
class Deviation:
    """Over the points, the relative deviation of the measure that is off most."""

    median: float
    largest: float
    #: Points whose answer is missing or no number.
    missing: int


def deviation(found: dict[int, Measures], known: dict[int, Measures], points: int) -> Deviation | None:
    """Compares the answers for `points` points with those that are known. Lift is measured by its size, or that of a
    typical point where it is smaller; none if nothing can be compared."""
    if not known:
        return None
    typical = median(abs(lift) for *_, lift in known.values())
    worst = []
    for number, (tip, psi, lift) in known.items():
        got = found.get(number)
        if got is None or not all(map(math.isfinite, got)):
            continue
        sizes = (abs(tip), abs(psi), max(abs(lift), typical))
        worst.append(max(abs(a - b) / size for a, b, size in zip(got, (tip, psi, lift), sizes)))
    if not worst:
        return None
    answered = sum(all(map(math.isfinite, measures)) for measures in found.values())
    return Deviation(median(worst), max(worst), points - answered)
