"""The result of a fit, with methods for predictions, and for the choice of next readings."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import _arguments
from .._flapwing import Grid
from .._types import Array, Mask, Value
from . import _device, _plan, _report, _search, _solution
from ._data import all_readings
from ._model import Answer
from ._noise import Noise, parse_noise
from ._plan import NextMeasurements
from ._points import answers_at, cell, error_of, points_of
from ._solution import Solution


@dataclass(frozen=True)
class Prediction:
    """A predicted measure at operating points, with the uncertainty of the prediction.

    Attributes
    ----------
    measure, unit : str
        The predicted measure, and the unit of the measure.
    points : dict
        The operating points: values of parameters, in SI units.
    value : array
        The predicted values of the measure. A value is nan if the motion does not settle.
    error : array
        Standard errors of the predictions, from the errors of the parameters and the discrepancy of the model.
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
                *(cell(values[row]) for values in self.points.values()),
                *(f"{number[row]:.5g}" for number in (self.value, self.low, self.high)),
            ]
            for row in range(len(self.value))
        ]
        return _report.table(heads, rows)


class Fit(Solution):
    """The result of `fit`: estimates with uncertainties, and the quality of the fit.

    ``print(fit)`` shows the whole report. Use ``**fit.values`` to set the fitted parameters in calls such as
    `flapwing.run`.

    Attributes
    ----------
    estimates : dict of str to Estimate
        Value, standard error, 95 % interval and profile of each fitted parameter, in SI units.
    spreads : dict of str to Spread
        Mean and standard deviation over all robots of each `FreeParameter` with `spread`.
    correlations : array
        Correlations of the estimates, in the order of `estimates`. A correlation is nan if the data do not determine
        one of the two parameters.
    combinations : list of str
        The combinations of parameters that the data determine best and worst.
    indistinct : list of str
        Combined changes of parameters that change no reading: exact scalings of the model, and parameters without
        effect.
    goodness : Goodness
        Chi-square, the probability of chi-square, and the residuals by data set and measure.
    unsettled : list of Unsettled
        Readings that are ignored, because the motion at the operating point does not settle.
    held_out : HeldOut or None
        The predictions of readings that were not fitted (`hold_out`).
    discrepancy : list of Discrepancy
        The discrepancy of the model for each measure. `discrepancy` is empty if the model agrees with the data.
    outliers : list of Outlier
        Fitted readings that are far from the model, with the largest residual first. The residual of an outlier is
        larger than 4 standard errors, or larger than 3 standard errors if `loss` is not ``"linear"``.
    drifting : str
        The parameter that explains a disagreement between data sets best, if each data set has a separate value.
        `drifting` is empty if the data sets agree.
    effort : Effort
        The amount of work of the fit: number of starts, points and evaluations, and the time.
    """

    def predict(self, points: Any, measure: str, *, data_set: str | None = None, reading: bool = False) -> Prediction:
        """Predict a measure at given operating points, with 95 % bands.

        The bands of the predictions contain the errors of the parameters. If the model does not agree with the data,
        the bands also contain the discrepancy of the model for the predicted measure. The discrepancy of a measure
        without readings is unknown.

        Parameters
        ----------
        points : dict, DataFrame or Grid
            Columns of parameters, as in `Readings`. You can leave out parameters that have the same value in all data
            sets. A grid sets the parameters of its axes, its derived parameters, and the parameters in ``[params]``
            that were not fitted. The remaining parameters of the grid's preset or device are not used, so the grid must
            have one preset or device.
        measure : str
            The measure to predict. The data need not have readings of the predicted measure.
        data_set : str, optional
            The data set whose parameters and branch are used for the prediction. By default, the prediction has the
            parameters of the first data set, and motions from rest. A branch is followed through the points of the data
            set that differ only in the parameter of the branch. Without such points, the branch begins at the first
            point of the prediction.
        reading : bool
            If True, the bands also contain the noise of a reading, so that the bands contain 95 % of new readings. The
            standard errors of the noise are the standard errors of `data_set`. If `data_set` has no readings of the
            measure, the standard errors are the standard errors of the first data set with such readings.

        Returns
        -------
        Prediction
            The prediction with `value`, `error`, `low` and `high`, in the unit of the measure. The predictions are nan
            at a point whose motion does not settle.

        Raises
        ------
        ValueError
            Raised if a column, a unit or a measure is unknown. Raised if `reading` is True, and the data have no
            readings of the measure. Raised if `reading` is True, `data_set` is not given, and data sets have different
            standard errors of the measure.
        """
        noise = self._noise(measure, {}, data_set) if _arguments.flag("reading", reading) else None
        given = self._points("points", points)
        place = 0 if data_set is None else self._place(data_set)
        like = None if data_set is None else self._sets[place]
        answer = answers_at(self._model, given, measure, self._x, place, like)
        error = np.hypot(error_of(answer, self._covariance), self._discrepancy_of(measure, answer.values))
        if noise is not None:
            error = np.hypot(error, noise.of(answer.values, np.nan_to_num(answer.values), self._guesses[measure]))
        unit = self._model.names.unit(measure)
        with np.errstate(invalid="ignore"):
            low, high = answer.values - self._quantile * error, answer.values + self._quantile * error
        return Prediction(measure, unit, given, answer.values, error, low, high, answer.status)

    def next_measurements(
        self,
        candidates: Any,
        target: str | Mapping[str, Any],
        *,
        count: int = 5,
        measures: Sequence[str] | None = None,
        sigma: Mapping[str, Value] | None = None,
        repeats: bool = False,
        data_set: str | None = None,
    ) -> NextMeasurements:
        """Return the operating points at which readings would reduce the error of a parameter or a prediction most.

        Parameters
        ----------
        candidates : dict, DataFrame or Grid
            Operating points that could be measured, as columns of parameters. You can leave out parameters that have
            the same value in all data sets.
        target : str or dict
            The parameter whose error is reduced, or a prediction such as ``{"measure": "lift_mean_mn",
            "drive_frequency": 110}``.
        count : int
            Number of readings to choose: pairs of a point and a measure. Fewer readings are returned if `repeats` is
            False and there are fewer pairs. Points without a settled motion are left out.
        measures : list of str, optional
            The allowed measures of the new readings. By default, the measures of the data and of `sigma` are allowed.
        sigma : dict, optional
            Standard errors of readings by measure, such as ``{"pitch_amplitude_deg": "2 deg"}``. By default, the
            standard errors are the standard errors of the data. `sigma` must contain a standard error for measures
            without readings in the data.
        repeats : bool
            If True, a measure can be read several times at the same point.
        data_set : str, optional
            The data set whose parameters, branch and standard errors the new readings have, such as the robot that you
            measure next. A prediction in `target` has the same parameters and branch. By default, the data set is the
            data set of the parameter `target`, or the first data set. `predict` describes how a branch is followed.
            Without a branch, all motions start from rest.

        Returns
        -------
        NextMeasurements
            Operating points and measures, with the best reading first, and the error of the target that remains after
            each reading. The error of a parameter is in the parameter's SI unit.

        Raises
        ------
        ValueError
            Raised if a name is unknown, a standard error is missing, `candidates` has no points, or no point has a
            settled motion. Raised if `candidates` has a fitted parameter, or lacks a parameter that has several values
            in the data.
        """
        repeats = _arguments.flag("repeats", repeats)
        count = _arguments.count("count", count)
        points = self._points("candidates", candidates)
        slopes, name, unit, place = self._target(target, data_set)
        given = {} if sigma is None else dict(sigma)
        known = [measure for one in self._sets for measure in one.measured]
        wanted = list(dict.fromkeys(measures if measures is not None else [*known, *given]))
        noises = {measure: self._noise(measure, given, self._sets[place].name) for measure in wanted}

        def errors_of(measure: str, values: Array) -> Array:
            noise = noises[measure].of(values, np.nan_to_num(values), self._guesses.get(measure, 1.0))
            return np.hypot(noise, self._discrepancy_of(measure, values))

        rows, chosen, errors, now = _plan.plan(
            self._model,
            points,
            wanted,
            self._x,
            place,
            self._sets[place],
            self._information,
            slopes,
            count,
            repeats,
            errors_of,
        )
        return NextMeasurements(
            name, unit, now, [{key: values[row] for key, values in points.items()} for row in rows], chosen, errors
        )

    def write_device(
        self, path: str | os.PathLike[str], *, data_set: str | None = None, overwrite: bool = False
    ) -> None:
        """Write a device file: the design with the fitted parameters, and the standard errors and correlations of these
        parameters.

        If the design is a device, the file keeps the description of the device. The file also keeps the standard
        errors, correlations and sources of the parameters that were not fitted. You can name the file in a grid, as in
        ``{"device": "mybee.toml"}``. ``[sample] of = "device"`` draws samples from the standard errors in the file.

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
            Raised if the file exists, and `overwrite` is False.
        ValueError
            Raised if some parameters differ between data sets, and `data_set` is not one of the data sets.
        """
        _device.write(self, path, data_set, _arguments.flag("overwrite", overwrite))

    def _noise(self, measure: str, sigma: Mapping[str, Any], data_set: str | None = None) -> Noise:
        """Return the standard error of new readings of a measure: a given standard error, or a typical standard error
        of the data. Raise ValueError if `data_set` is None, and the data sets have different standard errors.
        """
        self._model.names.check_measure(measure)
        if measure in sigma:
            return parse_noise("sigma", sigma[measure], measure, self._model.names.unit(measure))
        found = {one.name: one.noise[measure] for one in self._sets if measure in one.noise}
        if not found:
            known = dict.fromkeys(measure for one in self._sets for measure in one.noise)
            raise ValueError(
                f"the data have no readings of `{measure}`, so their standard error is unknown\n"
                f"choose among {', '.join(known)}, or give next_measurements(..., sigma={{{measure!r}: ...}})"
            )
        typical = {name: Noise(noise.kind, float(np.median(noise.size))) for name, noise in found.items()}
        if data_set is None and len(set(typical.values())) > 1:
            raise ValueError(
                f"the data sets have different standard errors of `{measure}`\n"
                f"choose one with data_set=: {', '.join(typical)}"
            )
        return typical.get(data_set or "", next(iter(typical.values())))

    def _discrepancy_of(self, measure: str, values: Array) -> Array:
        """Return the standard deviations of the discrepancy of the model at given values of a measure."""
        noise = self._discrepancy.get(measure)
        return np.zeros(len(values)) if noise is None else noise.of(values, np.nan_to_num(values), 1.0)

    def _errors_of_readings(self, answer: Answer) -> Array:
        """Return the standard errors of the predictions of all readings.

        The errors contain the errors of the parameters, the discrepancy of the model, and the noise of the readings. An
        error is infinite if a prediction depends on a parameter that the data do not determine.
        """
        error = np.hypot(error_of(answer, self._covariance), _search.sigmas(self._sets, answer.values, self._guesses))
        names = np.array(self._model.outputs.measure)
        for measure in self._discrepancy:
            mine = names == measure
            error[mine] = np.hypot(error[mine], self._discrepancy_of(measure, answer.values[mine]))
        return error

    def _predict_held_out(self, held: Mask) -> None:
        """Compute `held_out`: predictions of the readings in the mask `held`."""
        answer = self._model.everything(self._x)
        names, reach = np.array(self._model.outputs.measure), self._quantile * self._errors_of_readings(answer)
        self.held_out = _solution.held_out(names, all_readings(self._sets), answer.values, held, reach)

    def _target(self, target: str | Mapping[str, Any], data_set: str | None) -> tuple[Array, str, str, int]:
        """Return the derivatives of a target with respect to the search coordinates, and the target's name and unit.

        A target is a parameter or a prediction. The last result is the index of the data set of new readings.
        """
        space = self._model.space
        chosen = None if data_set is None else self._place(data_set)
        if isinstance(target, str):
            if target not in space.labels:
                raise ValueError(
                    f"`{target}` was not fitted\nchoose among {', '.join(space.labels)}, or give a prediction"
                )
            place = space.labels.index(target)
            one = space.coordinates[place]
            slopes = np.zeros(len(space))
            slopes[place] = space.slopes(self._x)[place]
            return slopes, target, one.unit, (one.of_set or 0) if chosen is None else chosen
        if not isinstance(target, Mapping) or "measure" not in target:
            raise ValueError(
                '`target` must be a parameter, or a prediction: {"measure": "lift_mean_mn", "drive_frequency": 110}'
            )
        measure = str(target["measure"])
        points = self._points("target", {name: value for name, value in target.items() if name != "measure"})
        answer = answers_at(self._model, points, measure, self._x, chosen or 0, self._sets[chosen or 0])
        if len(answer.values) != 1 or not np.isfinite(answer.values[0]) or answer.gaps[0]:
            raise ValueError(
                f"`{measure}` has no derivatives at this point, or there are several\nchoose another point"
            )
        return answer.slopes[0], measure, self._model.names.unit(measure), chosen or 0

    def _points(self, place: str, given: Any) -> dict[str, Any]:
        """Return operating points, with added columns for the parameters that have the same value in all data sets."""
        points = points_of(self._model, place, given)
        count = len(given) if isinstance(given, Grid) else len(next(iter(points.values())))
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
        values = ", ".join(f"{name}={one.value:.4g}" for name, one in self.estimates.items())
        return f"<flapwing.Fit of {values}>"

    def _repr_html_(self) -> str:
        return _report.html(self)
