"""The result of a fit, with predictions and with readings that would reduce errors most."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import _arguments
from .._flapwing import Grid
from .._types import Array
from . import _device, _report
from ._data import DataSet, Names, Noise, parameter_cells
from ._model import Answer, Asked, Model, Way
from ._search import FINE
from ._solution import Solution


@dataclass(frozen=True)
class Prediction:
    """A predicted measure at operating points, with the uncertainty that results from the errors of the parameters.

    Attributes
    ----------
    measure, unit : str
        The predicted measure and its unit.
    points : dict
        The operating points: values of parameters, in SI units.
    value : array
        The predicted values of the measure; nan if the motion does not settle.
    error : array
        Standard errors of the predictions, without the noise of a reading.
    low, high : array
        Lower and upper ends of the 95 % bands of the predictions.
    status : array of str
        The status of the motion at each operating point.
    """

    measure: str
    unit: str
    points: dict[str, Any]
    value: Array
    error: Array
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
        return _report.table(heads, rows)


@dataclass(frozen=True)
class NextMeasurements:
    """Operating points whose readings would reduce an error most, with the best point first.

    Attributes
    ----------
    target, unit : str
        The parameter or measure whose error is reduced, and its unit.
    now : float
        The present error of the target.
    points : list of dict
        The operating points: values of parameters, in SI units.
    measures : list of str
        The measure to read at each point.
    errors : list of float
        The error of the target after the readings at a point and at all points before this point.
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
            [*(_cell(value) for value in point.values()), measure, f"{error:.3g}"]
            for point, measure, error in zip(self.points, self.measures, self.errors)
        ]
        return f"error now: {self.now:.3g} {self.unit}".rstrip() + "\n" + _report.table(heads, rows)


def _cell(value: Any) -> str:
    return value if isinstance(value, str) else f"{value:g}"


def _points_of(names: Names, place: str, given: Any) -> dict[str, Any]:
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


def _answers(
    model: Model, points: Mapping[str, Any], measure: str, x: Array, place: int = 0, like: DataSet | None = None
) -> Answer:
    """Return a measure at other operating points, with the parameters of a data set. If `like` is given, use the branch
    of the data set `like`.
    """
    count = len(next(iter(points.values())))
    model.names.check_measure(measure)
    asked = Asked(np.full(count, place, np.intp), np.arange(count), [measure] * count)
    ways = []
    if like is not None and like.branch is not None:
        ways = [Way(like.parameter, like.branch == "down", np.arange(count))]
    return model.answers(points, asked, ways, [x], rtol=FINE)[0]


def _predict(
    model: Model, points: dict[str, Any], measure: str, answer: Answer, covariance: Array, quantile: float
) -> Prediction:
    """Return a measure at other operating points, with bands from the covariance of the coordinates."""
    known = np.where(np.isfinite(covariance), covariance, 0.0)
    error = np.sqrt(np.maximum(0.0, np.einsum("ij,jk,ik->i", answer.slopes, known, answer.slopes)))
    lost = ~np.isfinite(np.diag(covariance))
    error[(np.abs(answer.slopes[:, lost]) > 1e-9).any(axis=1)] = np.inf
    error[answer.gaps | ~np.isfinite(answer.values)] = np.nan
    with np.errstate(invalid="ignore"):
        low, high = answer.values - quantile * error, answer.values + quantile * error
    return Prediction(measure, model.names.unit(measure), points, answer.values, error, low, high, answer.status)


def _next_measurements(
    model: Model,
    points: dict[str, Any],
    measures: Mapping[str, Noise],
    x: Array,
    information: Array,
    target: Array,
    count: int,
    guesses: Mapping[str, float],
) -> tuple[list[int], list[str], list[float], float]:
    """Return the best next readings in order: rows of `points`, measures, errors of the target after each reading, and
    the present error of the target.

    A reading adds the outer product of its derivatives, in standard errors, to the information matrix. The next reading
    is the candidate after which the variance of the target is smallest.
    """
    rows, names, sensitivities = [], [], []
    for measure, noise in measures.items():
        answer = _answers(model, points, measure, x)
        sigma = noise.of(answer.values, np.nan_to_num(answer.values), guesses[measure])
        for row in np.flatnonzero(np.isfinite(answer.values) & ~answer.gaps):
            rows.append(int(row))
            names.append(measure)
            sensitivities.append(answer.slopes[row] / sigma[row])
    if not rows:
        raise ValueError("no candidate has a settled motion with derivatives\ngive other operating points")
    # A weak prior, with errors of a hundred times the value, keeps undetermined variances finite.
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


class Fit(Solution):
    """The result of `fit`: estimates, their uncertainty, and the quality of the fit.

    ``print(fit)`` shows the whole report. Use ``**fit.values`` to set the fitted parameters in other calls.

    Attributes
    ----------
    estimates : dict of str to Estimate
        Value, standard error, 95 % interval and profile of each fitted parameter, in SI units.
    correlations : array
        Correlations of the estimates, in the order of `estimates`; nan for parameters that the data do not determine.
    combinations : list of str
        The combinations of parameters that the data determine best and worst.
    indistinct : list of str
        Combined changes of parameters that change none of the readings: exact scalings of the model, and parameters
        without effect.
    goodness : Goodness
        Chi-square, its probability, and the residuals by data set and measure.
    unsettled : list of Unsettled
        Readings that are ignored, because the motion at their operating point does not settle.
    held_out : HeldOut or None
        The predictions of readings that were not fitted (`hold_out`).
    effort : Effort
        The work of the fit: number of starts, points and evaluations, and the time.
    """

    def predict(self, points: Any, measure: str, *, data_set: str | None = None) -> Prediction:
        """Predict a measure at other operating points, with 95 % bands.

        The 95 % bands are for the value of the model, without the noise of a reading.

        Parameters
        ----------
        points : dict, DataFrame or Grid
            Columns of parameters, as in `Readings`. You may leave out parameters that have the same value in all data
            sets.
        measure : str
            The measure to predict. The data need not have readings of the predicted measure.
        data_set : str, optional
            The data set whose parameters and branch are used. Default: the parameters of the first data set, and
            motions from rest.

        Returns
        -------
        Prediction
            `value`, `error`, `low` and `high`, in the unit of the measure; nan if the motion does not settle.

        Raises
        ------
        ValueError
            A column, a unit or a measure is unknown.
        """
        given = self._points("points", points)
        place, like = 0, None
        if data_set is not None:
            known = [one.name for one in self._sets]
            if data_set not in known:
                raise ValueError(f"there is no data set {data_set!r}\nchoose among {', '.join(known)}")
            place = known.index(data_set)
            like = self._sets[place]
        answer = _answers(self._model, given, measure, self._x, place, like)
        return _predict(self._model, given, measure, answer, self._covariance, self._quantile)

    def next_measurements(
        self, candidates: Any, target: str | Mapping[str, Any], *, count: int = 5, measures: list[str] | None = None
    ) -> NextMeasurements:
        """Return the operating points at which readings would reduce the error of a parameter or a prediction most.

        Parameters
        ----------
        candidates : dict, DataFrame or Grid
            Operating points that could be measured, as columns of parameters.
        target : str or dict
            The parameter whose error is reduced, or a prediction: ``{"measure": "lift_mean_mn", "drive_frequency":
            110}``.
        count : int
            Number of readings to choose. A point may occur twice, because a repeated reading adds information.
        measures : list of str, optional
            Measures that can be read. Default: the measures of the data.

        Returns
        -------
        NextMeasurements
            Operating points and measures, with the best first, and the remaining error of the target after each
            reading. The error of a parameter is in the parameter's SI unit.

        Raises
        ------
        ValueError
            A name is unknown, there are no points, or no point has a settled motion.
        """
        if isinstance(count, bool) or not isinstance(count, (int, np.integer)) or count < 1:
            raise ValueError(f"`count` is {count!r}\nit must be a whole number, 1 or more")
        points = self._points("candidates", candidates)
        slopes, name, unit = self._target(target)
        known = {measure: noise for one in self._sets for measure, noise in one.noise.items()}
        noises = {}
        for measure in measures if measures is not None else list(known):
            if measure not in known:
                raise ValueError(
                    f"the data have no readings of `{measure}`, so their error is unknown\n"
                    f"choose among {', '.join(known)}"
                )
            noise = known[measure]
            noises[measure] = noise if np.ndim(noise.size) == 0 else Noise(noise.kind, float(np.median(noise.size)))
        rows, chosen, errors, now = _next_measurements(
            self._model, points, noises, self._x, self._information, slopes, int(count), self._guesses
        )
        return NextMeasurements(
            name, unit, now, [{key: values[row] for key, values in points.items()} for row in rows], chosen, errors
        )

    def write_device(
        self, path: str | os.PathLike[str], *, data_set: str | None = None, overwrite: bool = False
    ) -> None:
        """Write a device file: the design with the fitted parameters, their standard errors and correlations.

        If the design is a device, the file keeps the description of the device, and the standard errors, correlations
        and sources of other parameters. ``{"device": "mybee.toml"}`` uses the file in a grid. ``[sample] of =
        "device"`` draws samples from the standard errors in the file.

        Parameters
        ----------
        path : str or path
            The path of the device file.
        data_set : str, optional
            The data set whose parameters are written, if some parameters differ between data sets.
        overwrite : bool
            If True, an existing file is replaced.

        Raises
        ------
        FileExistsError
            The file exists, and `overwrite` is False.
        ValueError
            Some parameters differ between data sets, and `data_set` is not one of the data sets.
        """
        _device.write(self, path, data_set, _arguments.flag("overwrite", overwrite))

    def _target(self, target: str | Mapping[str, Any]) -> tuple[Array, str, str]:
        """Return the derivatives of a target with respect to the coordinates, and the name and the unit of the target.
        A target is a parameter or a prediction.
        """
        space = self._model.space
        if isinstance(target, str):
            if target not in space.labels:
                raise ValueError(
                    f"`{target}` was not fitted\nchoose among {', '.join(space.labels)}, or give a prediction"
                )
            place = space.labels.index(target)
            slopes = np.zeros(len(space))
            slopes[place] = space.slopes(self._x)[place]
            return slopes, target, space.coordinates[place].unit
        if not isinstance(target, Mapping) or "measure" not in target:
            raise ValueError(
                '`target` must be a parameter, or a prediction: {"measure": "lift_mean_mn", "drive_frequency": 110}'
            )
        measure = str(target["measure"])
        points = self._points("target", {name: value for name, value in target.items() if name != "measure"})
        answer = _answers(self._model, points, measure, self._x)
        if len(answer.values) != 1 or not np.isfinite(answer.values[0]) or answer.gaps[0]:
            raise ValueError(
                f"`{measure}` has no derivatives at this point, or there are several\nchoose another point"
            )
        return answer.slopes[0], measure, self._model.names.unit(measure)

    def _points(self, place: str, given: Any) -> dict[str, Any]:
        """Return operating points, with added columns for the parameters that have the same value in all data sets."""
        points = _points_of(self._model.names, place, given)
        count = len(next(iter(points.values())))
        for name, values in self._model.points.items():
            if name in points:
                continue
            distinct = set(np.asarray(values).tolist())
            if len(distinct) > 1:
                raise ValueError(f"{place} lacks `{name}`, which has {len(distinct)} values in the data\nadd a column")
            value = distinct.pop()
            points[name] = [value] * count if isinstance(value, str) else np.full(count, value)
        for name in self._model.space.parameters:
            if name in points:
                raise ValueError(f"{place} has `{name}`, which was fitted\nleave it out")
        return points

    def __str__(self) -> str:
        return _report.text(self)

    def __repr__(self) -> str:
        told = ", ".join(f"{name}={one.value:.4g}" for name, one in self.estimates.items())
        return f"<flapwing.Fit of {told}>"

    def _repr_html_(self) -> str:
        return _report.html(self)
