"""Operating points at which a user predicts measures or plans readings, and the model's predictions at these points."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from typing import Any

import numpy as np

from .. import _arguments
from .._flapwing import Grid
from .._types import Array
from ._branches import Branch, taken
from ._cells import parameter_cells
from ._data import DataSet
from ._model import FINE, Answer, Model, Outputs


def cell(value: Any) -> str:
    """Return the text of a parameter's value in a printed table."""
    return value if isinstance(value, str) else f"{value:g}"


def points_of(model: Model, place: str, given: Any) -> dict[str, Any]:
    """Return operating points as columns of parameters. `given` contains columns of parameters, a grid, or the
    parameters of one point.
    """
    if isinstance(given, Grid):
        return _of_grid(model, place, given)
    names = model.names
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


def _of_grid(model: Model, place: str, grid: Grid) -> dict[str, Any]:
    """Return the points of a grid as columns of parameters. The columns are the parameters that vary, and the
    parameters in ``[params]`` whose values differ from the values in the fit's design. Fitted parameters in
    ``[params]`` are ignored, because they have the values of the fit.
    """
    names = model.names
    if grid.model != names.model:
        raise ValueError(
            f"{place} is a grid of `{grid.model}`, but the fit is of `{names.model}`\ngive a grid of `{names.model}`"
        )
    for name in ("device", "preset"):
        if name in grid.varied:
            raise ValueError(
                f"{place} is a grid with several values of `{name}`, but a fit has one design\n"
                f"give one `{name}`, or columns of parameters"
            )
    listed = [grid[row] for row in range(len(grid))]
    fixed = [
        name
        for name in tomllib.loads(grid.text).get("params", {})
        if name not in grid.varied and name not in model.space.parameters
    ]
    for name in fixed:
        if name not in listed[0]:
            raise ValueError(f"{place} has no value of `{name}`, which a sweep computes for each point\ngive a value")
    chosen = [name for name in fixed if name in model.points or listed[0][name] != model.nominal[name]]
    columns = {name: [point[name] for point in listed] for name in [*grid.varied, *chosen]}
    return {
        name: [str(value) for value in values] if name in names.options else np.array(values, np.float64)
        for name, values in columns.items()
    }


def answers_at(
    model: Model, points: Mapping[str, Any], measure: str, x: Array, place: int = 0, like: DataSet | None = None
) -> Answer:
    """Return the predictions of a measure at given operating points, with the parameters of the data set with the index
    `place`. If the data set `like` is given and has a branch of hysteresis, the motions are computed along the branch.
    """
    model.names.check_measure(measure)
    count = len(next(iter(points.values())))
    branches = []
    if like is not None and like.branch is not None:
        points = _with_data(model, points, place, like.parameter)
        branches = [Branch(like.parameter, like.branch == "down", np.arange(len(points[like.parameter])))]
    every = len(next(iter(points.values())))
    outputs = Outputs(np.full(every, place, np.intp), np.arange(every), [measure] * every)
    answer = model.answers(points, outputs, branches, [x], rtol=FINE)[0]
    new = slice(every - count, None)
    return Answer(answer.values[new], answer.slopes[new], answer.status[new], answer.gaps[new])


def _with_data(model: Model, points: Mapping[str, Any], place: int, along: str) -> dict[str, Any]:
    """Return columns that contain operating points of a data set, followed by the given points. The data set
    contributes the points that differ from a given point in no parameter except `along`.
    """
    others = [name for name in points if name != along]
    wanted = {tuple(points[name][row] for name in others) for row in range(len(points[along]))}
    own = [
        row
        for row in np.unique(model.outputs.row[model.outputs.of_set == place]).tolist()
        if tuple(model.points[name][row] if name in model.points else model.nominal[name] for name in others) in wanted
    ]
    whole = {}
    for name, values in points.items():
        cells = taken(model.points[name], own) if name in model.points else [model.nominal[name]] * len(own)
        whole[name] = np.concatenate([cells, values]) if isinstance(values, np.ndarray) else [*cells, *values]
    return whole


def error_of(answer: Answer, covariance: Array) -> Array:
    """Return the standard errors of predictions, computed from the covariance of the search coordinates."""
    known = np.where(np.isfinite(covariance), covariance, 0.0)
    error = np.sqrt(np.maximum(0.0, np.einsum("ij,jk,ik->i", answer.slopes, known, answer.slopes)))
    lost = ~np.isfinite(np.diag(covariance))
    error[(np.abs(answer.slopes[:, lost]) > 1e-9).any(axis=1)] = np.inf
    error[answer.gaps | ~np.isfinite(answer.values)] = np.nan
    return np.asarray(error)
