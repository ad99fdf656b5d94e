"""Readings, and proposals for new readings, that show which of two fits is better."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._types import Array
from . import _report
from ._criteria import Criteria
from ._data import all_readings, are_unknown, places_of
from ._points import answers_at, cell
from ._result import Fit
from ._search import finite_covariance


@dataclass(frozen=True)
class Side:
    """One of the compared fits, with the values that its model predicts for all readings."""

    name: str
    fit: Fit
    values: Array
    #: Standard errors of the predictions of all readings, with discrepancy and noise.
    errors: Array
    criteria: Criteria


@dataclass(frozen=True)
class DecidingReading:
    """A reading that the best fit and the second best fit predict differently.

    Attributes
    ----------
    data_set, measure, unit : str
        The data set and the measure of the reading, and the unit of the measure.
    row : int
        The row of the reading in the data set, counted from 1.
    point : dict
        The operating point: values of parameters, in SI units.
    reading : float
        The reading, in the unit of the measure.
    values : tuple of float
        The predictions of the reading by the best fit and by the second best fit, in the unit of the measure.
    difference : float
        The log likelihood of the reading in the best fit, minus the log likelihood of the reading in the second best
        fit. If `difference` is positive, the reading supports the best fit.
    """

    data_set: str
    measure: str
    unit: str
    row: int
    point: dict[str, Any]
    reading: float
    values: tuple[float, float]
    difference: float


@dataclass(frozen=True)
class DecidingMeasurements:
    """Operating points at which new readings would most clearly show which of two fits is correct, with the best point
    first.

    Attributes
    ----------
    names : tuple of str
        The names of the best and the second best fit.
    points : list of dict
        The operating points: values of parameters, in SI units.
    measures : list of str
        The measure of the new reading at each point.
    values : list of tuple of float
        The predictions of the best fit and of the second best fit at each point, in the unit of the measure.
    errors : list of float
        The standard error of the difference between the predictions of the two fits at each point. The standard error
        in `errors` accounts for the noise of a reading and the standard errors of the parameters.
    expected : list of float
        The expected difference between the chi-squares of the two fits, if the model of one of the two fits is correct.
        The entry of a point is the expected difference after the readings at this point and at all earlier points in
        the list. The computation updates both fits after each reading.
    """

    names: tuple[str, str]
    points: list[dict[str, Any]]
    measures: list[str]
    values: list[tuple[float, float]]
    errors: list[float]
    expected: list[float]

    def __str__(self) -> str:
        heads = [*(self.points[0] if self.points else []), "measure", *self.names, "error", "expected difference"]
        rows = [
            [*map(cell, point.values()), measure, *(f"{value:.4g}" for value in values), f"{error:.2g}", f"{sum_:.3g}"]
            for point, measure, values, error, sum_ in zip(
                self.points, self.measures, self.values, self.errors, self.expected
            )
        ]
        return _report.table(heads, rows)


def deciding_readings(sides: Sequence[Side], count: int) -> list[DecidingReading]:
    """Return the readings whose log likelihoods differ most between two fits, with the largest difference first."""
    first, second = sides
    difference = first.criteria.log - second.criteria.log
    order = np.argsort(-np.abs(np.nan_to_num(difference)), kind="stable")[: min(count, np.isfinite(difference).sum())]
    measured, places = all_readings(first.fit._sets), places_of(first.fit._sets)
    found = []
    for reading in order:
        one, measure, row = places[reading]
        point = {name: cells[row] for name, cells in one.points.items()}
        found.append(
            DecidingReading(
                one.name,
                measure,
                first.fit._model.names.unit(measure),
                row + 1,
                {name: cell if isinstance(cell, str) else float(cell) for name, cell in point.items()},
                float(measured[reading]),
                (float(first.values[reading]), float(second.values[reading])),
                float(difference[reading]),
            )
        )
    return found


def deciding_measurements(
    sides: Sequence[Side], candidates: Any, count: int, measures: Sequence[str] | None
) -> DecidingMeasurements:
    """Return the operating points at which new readings would most clearly show which of two fits is correct."""
    fits = [side.fit for side in sides]
    read = list(dict.fromkeys(fits[0]._model.outputs.measure))
    points = [fit._points("candidates", candidates) for fit in fits]
    rows: list[tuple[int, str]] = []
    values: list[list[Array]] = [[], []]
    slopes: list[list[Array]] = [[], []]
    variances = []
    for measure in measures if measures is not None else read:
        if measure not in read:
            raise ValueError(
                f"the data have no readings of `{measure}`, so their error is unknown\nchoose among {', '.join(read)}"
            )
        found = [answers_at(fit._model, given, measure, fit._x, 0, fit._sets[0]) for fit, given in zip(fits, points)]
        known = np.logical_and.reduce([np.isfinite(answer.values) & ~answer.gaps for answer in found])
        rows += [(int(row), measure) for row in np.flatnonzero(known)]
        sigmas = [_sigma(side, measure, answer.values) for side, answer in zip(sides, found)]
        variances.append(np.mean(np.square(sigmas), axis=0)[known])
        for place, answer in enumerate(found):
            values[place].append(answer.values[known])
            slopes[place].append(answer.slopes[known])
    if not rows:
        raise ValueError("no candidate has a settled motion with derivatives in both fits\ngive other points")
    first, second = (np.concatenate(parts) for parts in values)
    chosen, errors, expected = _decide(
        [first, second], [np.concatenate(parts) for parts in slopes], np.concatenate(variances), fits, count
    )
    return DecidingMeasurements(
        (sides[0].name, sides[1].name),
        [{name: cells[rows[one][0]] for name, cells in points[0].items()} for one in chosen],
        [rows[one][1] for one in chosen],
        [(float(first[one]), float(second[one])) for one in chosen],
        errors,
        expected,
    )


def _sigma(side: Side, measure: str, values: Array) -> Array:
    """Return the standard errors of new readings. If the standard error of a measure is unknown, the most likely value
    is used.
    """
    unknown = are_unknown(side.fit._sets, measure)
    likely = float(np.median(side.criteria.sigma[unknown])) if unknown.any() else 1.0
    return side.fit._noise(measure, {}, side.fit._sets[0].name).of(values, np.nan_to_num(values), likely)


def _decide(
    values: Sequence[Array], slopes: Sequence[Array], variance: Array, fits: Sequence[Fit], count: int
) -> tuple[list[int], list[float], list[float]]:
    """Return the candidate points at which readings most clearly show which of two fits is correct. For each chosen
    point, also return the standard error and the expected difference of chi-square.

    If the model of the first fit is correct, a reading raises the chi-square of the second fit. Chi-square rises by the
    squared difference of the two predictions, divided by the sum of two variances. The two variances are the variance
    of the reading and the variance of the second fit's prediction. The variance of the prediction reduces the rise of
    chi-square, because a new fit that includes the reading moves its prediction towards the reading. The rise of
    chi-square is computed twice: assuming that the first fit is correct, and assuming that the second fit is correct.
    The expected difference of chi-square is the mean of the two computed rises of chi-square.
    """
    covariances = [finite_covariance(fit._information) for fit in fits]
    differences = [values[1] - values[0], values[0] - values[1]]
    chosen: list[int] = []
    errors: list[float] = []
    expected: list[float] = []
    total = 0.0
    for _ in range(min(count, len(variance))):
        moved = [slope @ covariance for slope, covariance in zip(slopes, covariances)]
        spreads = [variance + np.einsum("ij,ij->i", one, slope) for one, slope in zip(moved, slopes)]
        # differences[0] is the error of the second fit if the first law is right.
        rises = 0.5 * (differences[0] ** 2 / spreads[1] + differences[1] ** 2 / spreads[0])
        rises[chosen] = -np.inf
        best = int(np.argmax(rises))
        total += float(rises[best])
        chosen.append(best)
        errors.append(float(np.sqrt(0.5 * (spreads[0][best] + spreads[1][best]))))
        expected.append(total)
        for place, other in ((0, 1), (1, 0)):
            gain = moved[place][best] / spreads[place][best]
            differences[other] = differences[other] - slopes[place] @ gain * differences[other][best]
        covariances = [
            covariance - np.outer(one[best], one[best]) / spread[best]
            for covariance, one, spread in zip(covariances, moved, spreads)
        ]
    return chosen, errors, expected
