"""The model of a fit, which predicts the readings for many sets of parameters in one batch of simulations."""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, SupportsIndex

import numpy as np

from .. import _flapwing
from .._evaluate import evaluate
from .._point import run
from .._table import Table
from .._types import Array, Mask, Places
from ._branches import Branch, states_along, taken
from ._data import DataSet
from ._names import Names
from ._parameters import Space

#: The tolerance of the integration of the last search.
FINE = 1e-6

#: The tolerances of integration and settling for the computation of initial states, which must only be close to the
#: orbit.
_NEARBY, _SETTLED = 1e-4, 1e-4

#: Limit for values near zero, as a share of the parameter's range. If a parameter is nearer to zero than the limit,
#: relative changes give no derivative. The derivative is then computed from a step of the size of the limit.
_NEAR_ZERO = 1e-3

#: Number of answers of the model that are stored, because a search often begins at the point at which an earlier search
#: ended.
_KEPT = 16


@dataclass(frozen=True)
class Outputs:
    """A list of the values that the model computes. Each entry is the value of a measure at an operating point."""

    #: The index of the data set of each output, because parameters can differ between data sets.
    of_set: Places
    #: The operating point of each output, as an index into the columns of points.
    row: Places
    #: The measure of each output.
    measure: list[str]


@dataclass(frozen=True)
class Answer:
    """The predictions of the model for one set of parameters."""

    #: The predicted values of the measures; nan if the motion does not settle.
    values: Array
    #: Derivatives of the measures with respect to the coordinates; zero if a derivative is unknown.
    slopes: Array
    #: The status of the motion at each operating point.
    status: np.ndarray[Any, Any]
    #: True for each predicted value with an unknown derivative.
    gaps: Mask


@dataclass(frozen=True)
class Part:
    """The operating points that are simulated during a search: all points with a fitted reading, and all points on
    branches of hysteresis.
    """

    points: dict[str, Any]
    branches: list[Branch]
    outputs: Outputs
    #: The index of each entry of `outputs` among all readings.
    places: Places


class Model:
    """The model of a fit: predictions of the readings of all data sets, as functions of the free parameters."""

    def __init__(
        self,
        names: Names,
        sets: Sequence[DataSet],
        space: Space,
        keywords: Mapping[str, Any],
        threads: SupportsIndex | None = None,
        show_points: Callable[[int], object] | None = None,
        held: Mask | None = None,
    ) -> None:
        self.names, self.space, self.threads, self.show_points = names, space, threads, show_points
        settings = _flapwing.settings()
        self.keywords = {
            name if name in settings else names.parameter(name): value
            for name, value in keywords.items()
            if value is not None
        }
        #: The parameters of the design and of the keywords, in SI units.
        self.nominal = {**names.nominal, **_si(names, self.keywords)}
        self.points, self.branches = _points(names.options, sets, self.nominal)
        self.outputs = _outputs(sets)
        self.part = _part(self.points, self.branches, self.outputs, held)
        #: Number of points that were run, and number of evaluations of the right-hand side.
        self.ran = 0
        self.rhs_evals = 0
        self._known: dict[tuple[bytes, bool, float | None], Answer] = {}

    def at(self, xs: Sequence[Array], *, slopes: bool = True, rtol: float | None = None) -> list[Answer]:
        """Return the predictions of the readings for each vector of search coordinates in `xs`.

        The prediction of a reading is nan if searches do not simulate the reading's operating point (see `Part`).
        """
        keys = [(x.tobytes(), slopes, rtol) for x in xs]
        new = {key: x for key, x in zip(keys, xs) if key not in self._known}
        known = {key: self._known[key] for key in keys if key not in new}
        if new:
            part = self.part
            found = self.answers(part.points, part.outputs, part.branches, list(new.values()), slopes=slopes, rtol=rtol)
            known.update(zip(new, (self._whole(answer) for answer in found)))
        self._known.update(known)
        for key in list(self._known)[:-_KEPT]:
            del self._known[key]
        return [known[key] for key in keys]

    def answers(
        self,
        points: Mapping[str, Any],
        outputs: Outputs,
        branches: Sequence[Branch],
        xs: Sequence[Array],
        *,
        slopes: bool = True,
        rtol: float | None = None,
    ) -> list[Answer]:
        """Return the predictions of the model at the given operating points, for each vector of search coordinates in
        `xs`.
        """
        rows = _length(points)
        columns: dict[str, Any] = {
            name: np.tile(values, len(xs)) if isinstance(values, np.ndarray) else list(values) * len(xs)
            for name, values in points.items()
        }
        columns.update(self._free(outputs, rows, xs))
        keywords = {name: value for name, value in self.keywords.items() if name not in columns}
        if rtol is not None:
            keywords.setdefault("rtol", rtol)
        measures = list(dict.fromkeys(outputs.measure))
        loose = {
            "rtol": max(_NEARBY, float(keywords.get("rtol", 0.0))),
            "settle_tol": max(_SETTLED, float(keywords.get("settle_tol", 0.0))),
        }
        nearby = self._run({**keywords, **loose}, measures[:1])
        begin = states_along(branches, columns, rows, len(xs), self.names.states, nearby)
        table = self._run(keywords, measures)(
            columns, initial_state=begin, gradient=self.space.parameters if slopes else None
        )
        answers = self._split(table, outputs, rows, xs, slopes)
        near = [(place, column) for place, x in enumerate(xs) for column in self._near_zero(x)] if slopes else []
        if near:
            moved = [xs[place] + self._step(xs[place], column) for place, column in near]
            there = self.answers(points, outputs, branches, moved, slopes=False, rtol=rtol)
            for (place, column), x, other in zip(near, moved, there):
                here = answers[place]
                difference = (other.values - here.values) / (x[column] - xs[place][column])
                here.slopes[:, column] = np.nan_to_num(difference)
                here.gaps[:] |= ~np.isfinite(difference) & np.isfinite(here.values)
        return answers

    def everything(self, x: Array) -> Answer:
        """Return the predictions of all readings at the coordinates `x`, including held-out readings."""
        return self.answers(self.points, self.outputs, self.branches, [x], rtol=FINE)[0]

    def _whole(self, answer: Answer) -> Answer:
        """Return the predictions of all readings. Readings without a prediction in `answer` get nan and the status
        ``"held out"``.
        """
        count, places = len(self.outputs.row), self.part.places
        if len(places) == count:
            return answer
        values, slopes = np.full(count, np.nan), np.zeros((count, len(self.space)))
        status, gaps = np.full(count, "held out", dtype="U11"), np.zeros(count, np.bool_)
        values[places], slopes[places], status[places], gaps[places] = (
            answer.values,
            answer.slopes,
            answer.status,
            answer.gaps,
        )
        return Answer(values, slopes, status, gaps)

    def _near_zero(self, x: Array) -> list[int]:
        """Return the indices of the coordinates whose parameter is close to zero. If a parameter is zero, a relative
        change of the parameter gives no derivative.
        """
        coordinates = self.space.coordinates
        return [
            column
            for column, one in enumerate(coordinates)
            if not one.log and abs(one.value(x[column])) < _NEAR_ZERO * (one.high - one.low)
        ]

    def _step(self, x: Array, column: int) -> Array:
        """Return a small step of one coordinate, in the direction that does not leave the bounds of the coordinate."""
        step = np.zeros(len(x))
        # The coordinate of a parameter changes by 2 over the range of the parameter.
        size = 2 * _NEAR_ZERO
        step[column] = size if x[column] + size <= self.space.high[column] else -size
        return step

    def reason(self, reading: int, x: Array) -> str:
        """Return the reason why the parameters at the operating point of a reading are invalid. Return an empty text if
        the parameters are valid.
        """
        of_set, row = self.outputs.of_set[reading], self.outputs.row[reading]
        free = {
            one.parameter: float(value)
            for one, value in zip(self.space.coordinates, self.space.values(x))
            if one.of_set in (None, of_set)
        }
        point = {name: values[row] for name, values in self.points.items()}
        return run(self.names.grid, **{**self.keywords, **point, **free}).reason

    def _run(self, keywords: Mapping[str, Any], measures: list[str]) -> Callable[..., Table]:
        def rows(columns: Mapping[str, Any], **options: Any) -> Table:
            table = evaluate(self.names.grid, columns, measures=measures, threads=self.threads, **options, **keywords)
            self.ran += len(table)
            self.rhs_evals += int(table.meta["rhs_evals"])
            if self.show_points is not None:
                self.show_points(self.ran)
            return table

        return rows

    def _free(self, outputs: Outputs, rows: int, xs: Sequence[Array]) -> dict[str, Array]:
        """Return a column of values for each free parameter, with one row for each operating point and each vector in
        `xs`.
        """
        of_row = np.zeros(rows, np.intp)
        of_row[outputs.row] = outputs.of_set
        columns = {name: np.empty((len(xs), rows)) for name in self.space.parameters}
        for place, x in enumerate(xs):
            for coordinate, value in zip(self.space.coordinates, self.space.values(x)):
                where = slice(None) if coordinate.of_set is None else of_row == coordinate.of_set
                columns[coordinate.parameter][place, where] = value
        return {name: values.ravel() for name, values in columns.items()}

    def _split(self, table: Table, outputs: Outputs, rows: int, xs: Sequence[Array], slopes: bool) -> list[Answer]:
        measures = list(dict.fromkeys(outputs.measure))
        which = np.array([measures.index(name) for name in outputs.measure], np.intp)

        def whole(found: Any, empty: Any) -> Any:
            """Return an array with one row for each point. The row of a point that a condition in ``[where]`` excludes
            contains the value `empty`.
            """
            everything = np.full((len(xs) * rows, *found.shape[1:]), empty, dtype=found.dtype)
            everything[table["point"].astype(np.intp)] = found
            return everything.reshape(len(xs), rows, *found.shape[1:])

        values = whole(np.stack([table[name] for name in measures], axis=-1), np.nan)
        status = whole(table["status"].astype("U11"), "excluded")
        gradient = whole(table.gradient, np.nan) if slopes else None
        answers = []
        for place, x in enumerate(xs):
            found = np.zeros((len(outputs.row), len(self.space)))
            gaps = np.zeros(len(outputs.row), np.bool_)
            if gradient is not None:
                near = self._near_zero(x)
                by = gradient[place, outputs.row, which]
                for column, (one, factor) in enumerate(zip(self.space.coordinates, self.space.slopes(x))):
                    mine = True if one.of_set is None else outputs.of_set == one.of_set
                    slope = by[:, self.space.parameters.index(one.parameter)] * factor
                    found[:, column] = 0.0 if column in near else np.where(mine, slope, 0.0)
                settled = np.isfinite(values[place, outputs.row, which])
                gaps = ~np.isfinite(found).all(axis=1) & settled
                found = np.nan_to_num(found, nan=0.0, posinf=0.0, neginf=0.0)
            answers.append(Answer(values[place, outputs.row, which], found, status[place, outputs.row], gaps))
        return answers


def _length(points: Mapping[str, Any]) -> int:
    return len(next(iter(points.values())))


def _si(names: Names, keywords: Mapping[str, Any]) -> dict[str, Any]:
    """Return the keyword arguments that are parameters of the design, as numbers in SI units or names of options."""
    return {
        name: value if name in names.options else _flapwing.value(names.model, name, value)
        for name, value in keywords.items()
        if name in names.parameters
    }


def _points(
    options: Container[str], sets: Sequence[DataSet], nominal: Mapping[str, Any]
) -> tuple[dict[str, Any], list[Branch]]:
    """Return the operating points of all data sets as columns of parameters, and the branches of hysteresis in the data
    sets. If a data set has no values of a parameter, the column contains the value in `nominal`.
    """
    varied = list(dict.fromkeys(name for one in sets for name in one.points)) or ["drive_frequency"]
    points: dict[str, Any] = {}
    for name in varied:
        parts = [one.points.get(name, [nominal[name]] * len(one)) for one in sets]
        if name in options:
            points[name] = [cell for part in parts for cell in part]
        else:
            points[name] = np.concatenate([np.asarray(part, np.float64) for part in parts])
    branches, begin = [], 0
    for one in sets:
        if one.branch is not None:
            branches.append(Branch(one.parameter, one.branch == "down", np.arange(begin, begin + len(one))))
        begin += len(one)
    return points, branches


def _outputs(sets: Sequence[DataSet]) -> Outputs:
    of_set, row, measure = [], [], []
    begin = 0
    for place, one in enumerate(sets):
        for name in one.measured:
            of_set += [place] * len(one)
            row += list(range(begin, begin + len(one)))
            measure += [name] * len(one)
        begin += len(one)
    return Outputs(np.array(of_set, np.intp), np.array(row, np.intp), measure)


def _part(points: dict[str, Any], branches: list[Branch], outputs: Outputs, held: Mask | None) -> Part:
    if held is None or not held.any():
        return Part(points, branches, outputs, np.arange(len(outputs.row)))
    runs = np.zeros(_length(points), np.bool_)
    runs[outputs.row[~held]] = True
    for branch in branches:
        runs[branch.rows] = True
    places = np.flatnonzero(runs[outputs.row])
    number = np.cumsum(runs) - 1
    chosen = np.flatnonzero(runs).tolist()
    return Part(
        {name: taken(values, chosen) for name, values in points.items()},
        [Branch(branch.parameter, branch.falls, number[branch.rows]) for branch in branches],
        Outputs(outputs.of_set[places], number[outputs.row[places]], [outputs.measure[place] for place in places]),
        places,
    )
