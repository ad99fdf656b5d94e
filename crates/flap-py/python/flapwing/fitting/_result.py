"""The result of a fit, with methods that predict measures and propose new readings."""

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


@dataclass(frozen=True, eq=False)
class Prediction:
    """Predictions of a measure at operating points, with the uncertainties of the predictions.

    Attributes
    ----------
    measure, unit : str
        The predicted measure, and the unit of the measure.
    points : dict
        The operating points: values of parameters, in SI units.
    value : array
        The predicted values of the measure. A predicted value is nan if the motion at its operating point does not
        settle.
    error : array
        Standard errors of the predictions, computed from the standard errors of the parameters and the discrepancy of
        the model.
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
        For each `FreeParameter` with `spread`, the mean and the standard deviation of the parameter over all robots.
    correlations : array
        Correlations of the estimates, in the order of `estimates`. A correlation is nan if the data do not determine
        one of the two parameters.
    combinations : list of str
        Texts about two combinations of parameters: the combination that the data determine best, and the combination
        that the data determine worst.
    indistinct : list of str
        Sentences about parameters without an effect on any reading, and about combined changes of parameters that
        change no reading.
    goodness : Goodness
        Chi-square, the probability of chi-square, and the residuals of each data set and measure.
    unsettled : list of Unsettled
        Readings that are ignored, because the motion at the operating point does not settle.
    held_out : HeldOut or None
        The predictions of readings that were not fitted (`hold_out`).
    discrepancy : list of Discrepancy
        The discrepancy of the model for each measure: the part of the residuals that is not noise. `discrepancy` is
        empty if the model agrees with the data.
    outliers : list of Outlier
        Fitted readings that are far from the model, with the largest residual first. The residual of an outlier is
        larger than 4 standard errors. If `loss` is not ``"linear"``, a reading is an outlier if its residual is larger
        than 3 standard errors.
    drifting : str
        The parameter that best explains a disagreement between data sets, because its value probably changed between
        the data sets. `drifting` is empty if the data sets agree.
    effort : Effort
        The cost of the fit: the number of searches, simulated points and evaluations of the equations of motion, and
        the time.
    """

    def predict(self, points: Any, measure: str, *, data_set: str | None = None, reading: bool = False) -> Prediction:
        """Predict a measure at given operating points, with 95 % confidence bands.

        The width of the bands accounts for the standard errors of the parameters. If the model does not agree with the
        data, the width of the bands also accounts for the discrepancy of the model. If the data have no readings of the
        measure, the discrepancy is unknown, and the bands leave out the discrepancy.

        Parameters
        ----------
        points : dict, DataFrame or Grid
            Columns of parameters, as in `Readings`. You can leave out parameters that have the same value in all data
            sets. A grid in `points` sets the parameters of its axes, its derived parameters, and the parameters in
            ``[params]`` that were not fitted. All other parameters of the grid's preset or device are ignored. The grid
            must name only one preset or device, because a fit has only one design.
        measure : str
            The measure to predict. The data need not have readings of the predicted measure.
        data_set : str, optional
            The data set whose parameters and branch are used for the prediction. By default, the prediction uses the
            parameters of the first data set, and all motions start from rest. If the data set has a branch of
            hysteresis, flap computes the motions along the branch, from one operating point to the next. The branch
            contains the points of the data set that differ from a predicted point only in the data set's `parameter`.
            If the data contribute no points to a branch, the branch begins at the first predicted point.
        reading : bool
            If True, the width of the bands also accounts for the noise of readings, such that 95 % of new readings are
            within the bands. The noise has the standard errors of the readings in `data_set`. If `data_set` has no
            readings of the measure, the noise has the standard errors of the first data set with readings of the
            measure.

        Returns
        -------
        Prediction
            The prediction with `value`, `error`, `low` and `high`, in the unit of the measure. If the motion at a point
            does not settle, the prediction at this point is nan.

        Raises
        ------
        ValueError
            Raised if a column, a unit or a measure is unknown. Raised if `reading` is True, and the data have no
            readings of the measure. Raised if `reading` is True, `data_set` is not given, and data sets have different
            standard errors of the measure.
        """
        noise = self._noise(measure, None, data_set) if _arguments.flag("reading", reading) else None
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
        """Return the operating points at which new readings would most reduce the standard error of a parameter or of a
        prediction.

        Parameters
        ----------
        candidates : dict, DataFrame or Grid
            Operating points that could be measured, as columns of parameters. You can leave out parameters that have
            the same value in all data sets.
        target : str or dict
            The parameter or the prediction whose standard error is reduced. A prediction is, for example, ``{"measure":
            "lift_mean_mn", "drive_frequency": 110}``.
        count : int
            Number of readings to choose. A reading is a pair of an operating point and a measure. If `repeats` is False
            and fewer than `count` pairs exist, the result contains all pairs. Points without a settled motion are left
            out.
        measures : list of str, optional
            The measures that new readings can have. The default of `measures` is all measures in the data and in
            `sigma`.
        sigma : dict, optional
            The standard error of new readings of each measure, such as ``{"pitch_amplitude_deg": "2 deg"}``. By
            default, new readings have the standard errors of the data. If the data have no readings of a measure,
            `sigma` must contain a standard error of this measure.
        repeats : bool
            If True, the result can contain several readings of the same measure at the same point.
        data_set : str, optional
            The data set that gives the new readings their parameters, branch and standard errors. For example, choose
            the data set of the robot that you measure next. If `target` is a prediction, the prediction also uses the
            data set `data_set`. The default of `data_set` is the first data set, or the data set of `target` if
            `target` is a parameter of one data set. `Fit.predict` describes the computation of motions on a branch of
            hysteresis. If the data set has no branch, all motions start from rest.

        Returns
        -------
        NextMeasurements
            Operating points and measures, with the best reading first, and the standard error of the target after each
            reading. If `target` is a parameter, the standard error is in the SI unit of the parameter.

        Raises
        ------
        ValueError
            Raised if a name is unknown, a standard error is missing, `candidates` contains no points, or no point has a
            settled motion. Raised if `candidates` contains a fitted parameter, or lacks a parameter that has several
            values in the data.
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
        """Write a device file that contains the design with the fitted parameters, and the standard errors and
        correlations of the fitted parameters.

        If the design of the fit is a device, the new file also contains the description of the device. For parameters
        that were not fitted, the new file also contains the standard errors, correlations and sources of the design's
        device. You can name the new file in a grid, as in ``{"device": "mybee.toml"}``. The key
        ``[sample] of = "device"`` of a grid draws samples of parameters from the standard errors in a device file.

        Parameters
        ----------
        path : str or path
            The path of the device file.
        data_set : str, optional
            The data set whose values are written, if some parameters have a separate value for each data set.
        overwrite : bool
            If True, an existing file is replaced.

        Raises
        ------
        FileExistsError
            Raised if the file exists, and `overwrite` is False.
        ValueError
            Raised if `data_set` is unknown. Raised if some parameters have a separate value for each data set, and
            `data_set` is not given.
        TypeError
            Raised if `path` is not a path.
        """
        _device.write(self, path, data_set, _arguments.flag("overwrite", overwrite))

    def _noise(self, measure: str, sigma: Mapping[str, Any] | None, data_set: str | None = None) -> Noise:
        """Return the standard error of new readings of a measure: a given standard error, or a typical standard error
        of the data. Raise ValueError if `data_set` is None and the data sets have different standard errors of the
        measure.
        """
        self._model.names.check_measure(measure)
        if sigma is not None and measure in sigma:
            return parse_noise("sigma", sigma[measure], measure, self._model.names.unit(measure))
        found = {one.name: one.noise[measure] for one in self._sets if measure in one.noise}
        if not found:
            known = dict.fromkeys(measure for one in self._sets for measure in one.noise)
            # Only `next_measurements` has the argument `sigma`.
            remedy = ", or leave out `reading`" if sigma is None else f", or give sigma={{{measure!r}: ...}}"
            raise ValueError(
                f"the data have no readings of `{measure}`, so their standard error is unknown\n"
                f"choose among {', '.join(known)}{remedy}"
            )
        typical = {name: Noise(noise.kind, float(np.median(noise.size))) for name, noise in found.items()}
        if data_set is None and len(set(typical.values())) > 1:
            raise ValueError(
                f"the data sets have different standard errors of `{measure}`\n"
                f"choose one with data_set=: {', '.join(typical)}"
            )
        return typical.get(data_set or "", next(iter(typical.values())))

    def _discrepancy_of(self, measure: str, values: Array) -> Array:
        """Return the standard deviation of the model's discrepancy for each predicted value of a measure."""
        noise = self._discrepancy.get(measure)
        return np.zeros(len(values)) if noise is None else noise.of(values, np.nan_to_num(values), 1.0)

    def _errors_of_readings(self, answer: Answer) -> Array:
        """Return the standard errors of the predictions of all readings.

        The standard errors account for the standard errors of the parameters, the discrepancy of the model, and the
        noise of the readings. If a prediction depends on a parameter that the data do not determine, the standard error
        of the prediction is infinite.
        """
        error = np.hypot(error_of(answer, self._covariance), _search.sigmas(self._sets, answer.values, self._guesses))
        names = np.array(self._model.outputs.measure)
        for measure in self._discrepancy:
            mine = names == measure
            error[mine] = np.hypot(error[mine], self._discrepancy_of(measure, answer.values[mine]))
        return error

    def _predict_held_out(self, held: Mask) -> None:
        """Set the attribute `held_out`, which describes the predictions of the readings for which the mask `held` is
        True.
        """
        answer = self._model.everything(self._x)
        names, reach = np.array(self._model.outputs.measure), self._quantile * self._errors_of_readings(answer)
        self.held_out = _solution.held_out(names, all_readings(self._sets), answer.values, held, reach)

    def _target(self, target: str | Mapping[str, Any], data_set: str | None) -> tuple[Array, str, str, int]:
        """Return the derivatives of a parameter or prediction with respect to the search coordinates. Also return the
        name and the unit of the parameter or prediction.

        The last element of the result is the index of the data set that gives new readings their parameters and branch.
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
        """Return operating points as columns of parameters. The method adds the parameters that have the same value in
        all data sets.
        """
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
