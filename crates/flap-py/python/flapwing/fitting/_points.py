"""Operating points of predictions and plans, and the measures of the model at these points."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from .. import _arguments
from .._flapwing import Grid
from .._types import Array
from ._branches import Branch
from ._cells import parameter_cells
from ._data import DataSet
from ._model import FINE, Answer, Asked, Model
from ._names import Names


def cell(value: Any) -> str:
    """Return a value of a parameter as a cell of a table."""
    return value if isinstance(value, str) else f"{value:g}"


def points_of(names: Names, place: str, given: Any) -> dict[str, Any]:
    """Return operating points, given as columns of parameters, a grid, or one point."""
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
            raise ValueError(f"{place} has the column `{header}`, a measure\ngive only parameters of operating points")
        if len(cells) not in (1, length):
            raise ValueError(
                f"{place}: `{header}` has {len(cells)} cells for {length} points\ngive one per point, or one for all"
            )
        values = parameter_cells(names, place, header, meaning, cells)
        points[meaning.name] = values if len(values) == length else np.resize(np.asarray(values), length)
    if not points or not length:
        raise ValueError(
            f"{place} has no points\ngive columns of parameters, such as {{'drive_frequency': [100, 110]}}"
        )
    return {name: values if np.asarray(values).dtype.kind == "f" else list(values) for name, values in points.items()}


def _column(names: Names, values: list[Any], name: str) -> Any:
    return [str(value) for value in values] if name in names.options else np.array(values, np.float64)


def answers_at(
    model: Model, points: Mapping[str, Any], measure: str, x: Array, place: int = 0, like: DataSet | None = None
) -> Answer:
    """Return a measure at operating points outside the data, with the parameters of a data set. If `like` is given, use
    the branch of the data set `like`.
    """
    count = len(next(iter(points.values())))
    model.names.check_measure(measure)
    asked = Asked(np.full(count, place, np.intp), np.arange(count), [measure] * count)
    branches = []
    if like is not None and like.branch is not None:
        branches = [Branch(like.parameter, like.branch == "down", np.arange(count))]
    return model.answers(points, asked, branches, [x], rtol=FINE)[0]


def error_of(answer: Answer, covariance: Array) -> Array:
    """Return the standard errors of measures that result from the covariance of the coordinates."""
    known = np.where(np.isfinite(covariance), covariance, 0.0)
    error = np.sqrt(np.maximum(0.0, np.einsum("ij,jk,ik->i", answer.slopes, known, answer.slopes)))
    lost = ~np.isfinite(np.diag(covariance))
    error[(np.abs(answer.slopes[:, lost]) > 1e-9).any(axis=1)] = np.inf
    error[answer.gaps | ~np.isfinite(answer.values)] = np.nan
    return np.asarray(error)
