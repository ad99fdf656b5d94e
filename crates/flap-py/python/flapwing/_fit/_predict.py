"""Predictions of a fit, and the readings that would tell most."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping, Sequence

import numpy as np

from .. import _arguments
from . import _cells, _noise
from ._branch import Way
from ._columns import Names
from ._model import Answer, Asked, Model
from ._readings import DataSet
from ._search import FINE
from ._types import Array


@dataclass(frozen=True)
class Prediction:
    """A measure at operating points, with its uncertainty by that of the parameters."""

    measure: str
    unit: str
    points: dict[str, Any]
    value: Array
    #: Standard errors, without the noise of a reading.
    error: Array
    #: Ends of the 95 % bands.
    low: Array
    high: Array
    status: np.ndarray[Any, Any]

    def __str__(self) -> str:
        heads = [*self.points, f"{self.measure} ({self.unit})" if self.unit else self.measure, "from", "to"]
        rows = [
            [
                *(_cell(values[row]) for values in self.points.values()),
                *(f"{number[row]:.5g}" for number in (self.value, self.low, self.high)),
            ]
            for row in range(len(self.value))
        ]
        return table(heads, rows)


@dataclass(frozen=True)
class NextMeasurements:
    """Operating points whose readings would shrink an error most, the best first."""

    target: str
    unit: str
    #: The error of the target now.
    now: float
    points: list[dict[str, Any]]
    measures: list[str]
    #: The error of the target after the readings up to each.
    errors: list[float]

    def __str__(self) -> str:
        heads = [
            *(self.points[0] if self.points else []),
            "measure",
            f"error of {self.target} after" + (f" ({self.unit})" if self.unit else ""),
        ]
        rows = [
            [*(_cell(value) for value in point.values()), measure, f"{error:.3g}"]
            for point, measure, error in zip(self.points, self.measures, self.errors)
        ]
        return f"error now: {self.now:.3g} {self.unit}".rstrip() + "\n" + table(heads, rows)


def table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Lines of columns."""
    widths = [max(len(line[place]) for line in [heads, *rows]) for place in range(len(heads))]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() for line in [heads, *rows]
    )


def _cell(value: Any) -> str:
    return value if isinstance(value, str) else f"{value:g}"


def points_of(names: Names, place: str, given: Any) -> dict[str, Any]:
    """Operating points from columns of parameters, a grid, or one point."""
    from .._flapwing import Grid

    if isinstance(given, Grid):
        listed = [given[row] for row in range(len(given))]
        return {name: _column(names, [point[name] for point in listed], name) for name in given.varied}
    found = _arguments.columns_of(place, given)
    lists = {
        name: [cells] if isinstance(cells, str) or np.ndim(cells) == 0 else list(cells) for name, cells in found.items()
    }
    length = max((len(cells) for cells in lists.values()), default=0)
    points: dict[str, Any] = {}
    for header, cells in lists.items():
        meaning = names.meaning(place, header)
        if meaning.kind != "parameter":
            raise ValueError(f"{place} has the column `{header}`, a measure\ngive parameters of operating points only")
        if len(cells) not in (1, length):
            raise ValueError(
                f"{place}: `{header}` has {len(cells)} cells for {length} points\ngive one for each, or one for all"
            )
        values = _cells.parameters(names, place, header, meaning, cells)
        points[meaning.name] = values if len(values) == length else np.resize(np.asarray(values), length)
    if not points or not length:
        raise ValueError(
            f"{place} has no points\ngive columns of parameters, such as {{'drive_frequency': [100, 110]}}"
        )
    return {name: values if np.asarray(values).dtype.kind == "f" else list(values) for name, values in points.items()}


def _column(names: Names, values: list[Any], name: str) -> Any:
    return [str(value) for value in values] if name in names.options else np.array(values, np.float64)


def answers(
    model: Model, points: Mapping[str, Any], measure: str, x: Array, place: int = 0, like: DataSet | None = None
) -> Answer:
    """A measure at other operating points, with the parameters of a data set, and on its way if it is `like` that."""
    count = len(next(iter(points.values())))
    model.names.check_measure(measure)
    asked = Asked(np.full(count, place, np.intp), np.arange(count), [measure] * count)
    ways = []
    if like is not None and like.branch is not None:
        ways = [Way(like.along, like.branch == "down", np.arange(count))]
    return model.answers(points, asked, ways, [x], rtol=FINE)[0]


def predict(
    model: Model, points: dict[str, Any], measure: str, answer: Answer, covariance: Array, quantile: float
) -> Prediction:
    """A measure at other operating points, with bands by the covariance of the coordinates."""
    known = np.where(np.isfinite(covariance), covariance, 0.0)
    error = np.sqrt(np.maximum(0.0, np.einsum("ij,jk,ik->i", answer.slopes, known, answer.slopes)))
    lost = ~np.isfinite(np.diag(covariance))
    error[(np.abs(answer.slopes[:, lost]) > 1e-9).any(axis=1)] = np.inf
    error[answer.gaps | ~np.isfinite(answer.values)] = np.nan
    with np.errstate(invalid="ignore"):
        low, high = answer.values - quantile * error, answer.values + quantile * error
    return Prediction(measure, model.names.unit(measure), points, answer.values, error, low, high, answer.status)


def next_measurements(
    model: Model,
    points: dict[str, Any],
    measures: Mapping[str, _noise.Noise],
    x: Array,
    information: Array,
    target: Array,
    count: int,
    guesses: Mapping[str, float],
) -> tuple[list[int], list[str], list[float], float]:
    """The best readings, one after another: rows of `points`, measures, the error of the target after each, and now.

    A reading adds the square of its derivatives, in standard errors, to the information; each is the one after which the
    variance of the target is least.
    """
    rows, names, sensitivities = [], [], []
    for measure, noise in measures.items():
        answer = answers(model, points, measure, x)
        sigma = noise.of(answer.values, np.nan_to_num(answer.values), guesses[measure])
        for row in np.flatnonzero(np.isfinite(answer.values) & ~answer.gaps):
            rows.append(int(row))
            names.append(measure)
            sensitivities.append(answer.slopes[row] / sigma[row])
    if not rows:
        raise ValueError("no candidate has a settled motion with derivatives\ngive other operating points")
    # A weak belief keeps what is not known at all finite: errors of a hundred times the value.
    covariance = np.linalg.inv(information + 1e-4 * np.eye(len(information)))
    a = np.array(sensitivities)
    now = float(np.sqrt(target @ covariance @ target))
    chosen, errors = [], []
    for _ in range(count):
        moved = a @ covariance
        gains = (moved @ target) ** 2 / (1.0 + np.einsum("ij,ij->i", moved, a))
        best = int(np.argmax(gains))
        covariance = covariance - np.outer(moved[best], moved[best]) / (1.0 + moved[best] @ a[best])
        chosen.append(best)
        errors.append(float(np.sqrt(max(0.0, target @ covariance @ target))))
    return [rows[one] for one in chosen], [names[one] for one in chosen], errors, now
