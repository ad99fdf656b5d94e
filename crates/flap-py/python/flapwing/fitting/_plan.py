"""Proposals for new readings: operating points at which readings would most reduce the standard error of a parameter or
prediction.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._types import Array
from . import _report
from ._data import DataSet
from ._model import Model
from ._points import answers_at, cell
from ._search import finite_covariance


@dataclass(frozen=True)
class NextMeasurements:
    """Operating points at which new readings would most reduce the standard error of a parameter or of a prediction,
    with the best point first.

    Attributes
    ----------
    target, unit : str
        The parameter or measure whose standard error is reduced, and the unit of the standard error.
    now : float
        The standard error of the target (the parameter or the prediction) before the new readings.
    points : list of dict
        The operating points: values of parameters, in SI units.
    measures : list of str
        The measure of the new reading at each point.
    errors : list of float
        The standard errors of the target (the parameter or the prediction). The entry of a point is the standard error
        after the readings at this point and at all earlier points in the list.
    """

    target: str
    unit: str
    now: float
    points: list[dict[str, Any]]
    measures: list[str]
    errors: list[float]

    def __str__(self) -> str:
        heads = [
            *(self.points[0] if self.points else []),
            "measure",
            f"error of {self.target} after" + (f" ({self.unit})" if self.unit else ""),
        ]
        rows = [
            [*(cell(value) for value in point.values()), measure, f"{error:.3g}"]
            for point, measure, error in zip(self.points, self.measures, self.errors)
        ]
        return f"error now: {self.now:.3g} {self.unit}".rstrip() + "\n" + _report.table(heads, rows)


def plan(
    model: Model,
    points: dict[str, Any],
    measures: Sequence[str],
    x: Array,
    place: int,
    like: DataSet,
    information: Array,
    target: Array,
    count: int,
    repeats: bool,
    errors_of: Callable[[str, Array], Array],
) -> tuple[list[int], list[str], list[float], float]:
    """Return proposals for new readings, with the best reading first: the rows of `points`, and the measures. Also
    return the standard error of the target (a parameter or a prediction) after each reading, and before the first
    reading. New readings have the parameters and the branch of the data set `like`, whose index is `place`.

    To add a reading, the outer product of the reading's derivatives, divided by the reading's variance, is added to the
    information matrix. In each step, the function chooses the reading after which the variance of the target parameter
    or prediction is smallest. `errors_of` computes the standard errors of readings from a measure and its predicted
    values.
    """
    rows, names, sensitivities = [], [], []
    for measure in measures:
        answer = answers_at(model, points, measure, x, place, like)
        sigma = errors_of(measure, answer.values)
        for row in np.flatnonzero(np.isfinite(answer.values) & ~answer.gaps):
            rows.append(int(row))
            names.append(measure)
            sensitivities.append(answer.slopes[row] / sigma[row])
    if not rows:
        raise ValueError("no candidate has a settled motion with derivatives\ngive other operating points")
    covariance = finite_covariance(information)
    a = np.array(sensitivities)
    now = float(np.sqrt(target @ covariance @ target))
    chosen: list[int] = []
    errors: list[float] = []
    for _ in range(count if repeats else min(count, len(a))):
        moved = a @ covariance
        gains = (moved @ target) ** 2 / (1.0 + np.einsum("ij,ij->i", moved, a))
        if not repeats:
            gains[chosen] = -1.0
        best = int(np.argmax(gains))
        covariance = covariance - np.outer(moved[best], moved[best]) / (1.0 + moved[best] @ a[best])
        chosen.append(best)
        errors.append(float(np.sqrt(max(0.0, target @ covariance @ target))))
    return [rows[one] for one in chosen], [names[one] for one in chosen], errors, now
