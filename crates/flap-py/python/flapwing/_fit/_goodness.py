"""Tests of residuals: their size and their structure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Mapping, Sequence

import numpy as np

from ._readings import DataSet
from ._types import Array, Mask, Places

#: The probability below which residuals are called structured, shared among all tests.
_SIGNIFICANT = 0.01

#: Residuals below which nothing is tested.
_FEWEST = 8


@dataclass(frozen=True)
class Residuals:
    """The residuals of a measure in a data set."""

    set: str
    measure: str
    unit: str
    #: Model less reading, in the measure's unit, nan where the motion does not settle.
    values: Array
    #: In standard errors.
    scaled: Array
    #: The root of the mean square, in the measure's unit.
    rms: float
    #: Readings that count.
    count: int
    #: The probability of as few changes of sign, or of as much likeness of neighbours, if residuals are noise.
    p_runs: float
    p_neighbours: float
    is_structured: bool = False


@dataclass(frozen=True)
class Goodness:
    """The quality of a fit."""

    chi_square: float
    freedom: int
    #: The probability of so large a sum of squares, if the model is right and standard errors are as given; nan if
    #: standard errors are estimated.
    p: float
    residuals: list[Residuals]

    @property
    def is_structured(self) -> bool:
        """True if residuals follow a pattern: the model lacks something."""
        return any(one.is_structured for one in self.residuals)


def order(points: Mapping[str, Array | list[str]]) -> Places:
    """The order of a data set's rows in which neighbours are alike: along the parameter with most values, others outside."""
    numbers = {name: np.asarray(values) for name, values in points.items() if isinstance(values, np.ndarray)}
    if not numbers:
        return np.arange(len(next(iter(points.values()), [])))
    names = sorted(numbers, key=lambda name: -len(np.unique(numbers[name])))
    return np.lexsort([numbers[name] for name in names])


def of_residuals(
    sets: Sequence[DataSet], units: Mapping[str, str], values: Array, scaled: Array, used: Mask
) -> list[Residuals]:
    """The residuals by data set and measure."""
    found, begin = [], 0
    for one in sets:
        for measure in one.measured:
            part = slice(begin, begin + len(one))
            begin += len(one)
            counts = used[part] & np.isfinite(values[part])
            in_order = order(one.points) if one.points else np.arange(len(one))
            noise = scaled[part][in_order][counts[in_order]]
            rms = float(np.sqrt(np.mean(values[part][counts] ** 2))) if counts.any() else np.nan
            p_runs, p_neighbours = _runs(noise), _neighbours(noise)
            found.append(
                Residuals(
                    one.name,
                    measure,
                    units[measure],
                    values[part].copy(),
                    scaled[part].copy(),
                    rms,
                    int(counts.sum()),
                    p_runs,
                    p_neighbours,
                )
            )
    limit = _SIGNIFICANT / max(1, 2 * len(found))
    return [
        Residuals(**{**vars(one), "is_structured": bool(min(one.p_runs, one.p_neighbours) < limit)}) for one in found
    ]


def _runs(noise: Array) -> float:
    """The probability of so few runs of one sign (Wald and Wolfowitz)."""
    from scipy.stats import norm

    signs = noise[noise != 0] > 0
    above, below = int(signs.sum()), int((~signs).sum())
    count = above + below
    if count < _FEWEST:
        return 1.0
    if min(above, below) == 0:
        return float(2.0**-count)
    runs = 1 + int(np.count_nonzero(signs[1:] != signs[:-1]))
    mean = 1 + 2 * above * below / count
    variance = (mean - 1) * (mean - 2) / (count - 1)
    return float(norm.cdf((runs + 0.5 - mean) / np.sqrt(max(variance, 1e-12))))


def _neighbours(noise: Array) -> float:
    """The probability of neighbours so alike: the correlation of each residual with the next."""
    from scipy.stats import norm

    count = len(noise)
    square = float(noise @ noise)
    if count < _FEWEST or square == 0.0:
        return 1.0
    likeness = float(noise[1:] @ noise[:-1]) / square
    return float(norm.sf(likeness * np.sqrt(count)))


def goodness(residuals: list[Residuals], priors: Array, parameters: int, sigma_known: bool) -> Goodness:
    """The quality of a fit from its residuals, with those of what was known beforehand."""
    from scipy.stats import chi2

    scaled = [one.scaled[np.isfinite(one.scaled)] for one in residuals]
    total = float(sum(part @ part for part in scaled) + priors @ priors)
    freedom = sum(len(part) for part in scaled) + len(priors) - parameters
    p = float(chi2.sf(total, freedom)) if sigma_known and freedom > 0 else np.nan
    return Goodness(total, freedom, p, residuals)
