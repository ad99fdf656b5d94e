"""Comparison of fits of the same readings: information criteria, readings that decide between fits, and next readings
that would decide."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._types import Array, Mask
from . import _assess, _report, _search
from ._data import DataSet
from ._noise import Noise
from ._points import answers_at, cell, points_of
from ._result import Fit

#: Smallest difference of AICc at which readings decide between two fits.
DECIDED = 2.0

#: Difference of AICc from which the verdict has the word "clearly".
_CLEAR = 10.0


@dataclass(frozen=True)
class ComparedFit:
    """The criteria of one fit in a comparison. Lower values of all criteria are better.

    Attributes
    ----------
    name : str
        The name of the fit.
    parameters : int
        Number of free parameters. Each standard error that was estimated from the residuals counts as one parameter.
    chi_square : float
        Chi-square: the sum of the squared residuals in standard errors, with the residuals of priors. If standard
        errors were estimated, chi-square contains no information about the fit.
    deviance : float
        Minus two times the log likelihood of the compared readings, with the residuals of priors. Unknown standard
        errors have their most likely value (concentrated likelihood).
    aicc, bic : float
        Akaike's information criterion with the correction for few readings, and the Bayesian information criterion.
    delta_aicc, delta_bic : float
        Differences between the criteria of the fit and the lowest criteria of all fits.
    weight : float
        Akaike weight: the probability of the fit among the compared fits.
    held_out_rms : dict of str to float
        Root mean square of the prediction errors of each measure, in the unit of the measure; empty without `hold_out`.
    held_out_score : float
        Mean logarithm of the predicted probability density of a reading that was not fitted. Higher values are better.
        The value is nan without `hold_out`.
    """

    name: str
    parameters: int
    chi_square: float
    deviance: float
    aicc: float
    bic: float
    delta_aicc: float
    delta_bic: float
    weight: float
    held_out_rms: dict[str, float]
    held_out_score: float


@dataclass(frozen=True)
class DecidingReading:
    """A reading that one of two fits predicts better.

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
        The values of the best fit and of the second best fit, in the unit of the measure.
    difference : float
        Log likelihood of the reading in the best fit minus log likelihood of the reading in the second best fit. A
        positive difference supports the best fit.
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
    """Operating points at which readings would decide between two fits, with the best point first.

    Attributes
    ----------
    names : tuple of str
        The names of the best and the second best fit.
    points : list of dict
        The operating points: values of parameters, in SI units.
    measures : list of str
        The measure to read at each point.
    values : list of tuple of float
        The predictions of the two fits at each point, in the unit of the measure.
    errors : list of float
        The standard error of the difference at each point, from the noise of a reading and the errors of the
        parameters.
    expected : list of float
        The expected difference between the chi-squares of the two fits, if one of the two models is right. The
        difference includes the readings at a point and at all points before this point. Both models are fitted again
        after each reading.
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


def log_likelihoods(sets: Sequence[DataSet], values: Array, counted: Mask) -> tuple[Array, Array, int]:
    """Return the log likelihood of each reading, its standard error, and the number of estimated standard errors.

    The log likelihood is nan for readings that are not counted. An unknown standard error is the root mean square of
    the residuals of its measure. For a motion that does not settle, the value of the model is zero, as for a wing at
    rest.
    """
    measured = np.concatenate([readings for one in sets for readings in one.measured.values()])
    error = np.where(np.isfinite(values), values, 0.0) - measured
    which = np.array([measure for one in sets for measure in one.measured for _ in range(len(one))])
    unknown = np.concatenate(
        [np.full(len(one), one.noise[measure].kind == "unknown") for one in sets for measure in one.measured]
    )
    sigma = _search.sigmas(list(sets), values, dict.fromkeys(which.tolist(), 1.0))
    estimated = list(dict.fromkeys(which[unknown & counted].tolist()))
    for measure in estimated:
        mine = unknown & (which == measure)
        least = 1e-9 * float(np.abs(measured[mine]).max())
        sigma[mine] = max(float(np.sqrt(np.mean(error[mine & counted] ** 2))), least)
    log = -0.5 * (error / sigma) ** 2 - np.log(np.sqrt(2.0 * np.pi) * sigma)
    return np.where(counted, log, np.nan), sigma, len(estimated)


def criteria(deviance: float, parameters: int, readings: int) -> dict[str, float]:
    """Return AICc and BIC of a fit with a deviance, i.e. minus two times its log likelihood. AICc is infinite for too
    few readings.
    """
    left = readings - parameters - 1
    correction = 2.0 * parameters * (parameters + 1) / left if left > 0 else np.inf
    return {
        "AICc": deviance + 2.0 * parameters + correction,
        "BIC": deviance + parameters * float(np.log(readings)),
    }


@dataclass(frozen=True)
class _Side:
    """One of the compared fits, with the values of its model at all readings."""

    name: str
    fit: Fit
    values: Array
    #: Derivatives of the values with respect to the coordinates of the fit.
    slopes: Array
    counted: Mask


class Comparison:
    """The comparison of several fits of the same readings. ``print(comparison)`` shows a table and the verdict.

    Attributes
    ----------
    fits : list of ComparedFit
        The fits with their criteria, with the lowest AICc first.
    readings : int
        Number of compared readings: the readings that all fits use.
    left_out : int
        Number of readings that are not compared, because at least one of the fits has no settled motion at the reading.
    chosen : str
        The name of the fit with the fewest parameters among the fits whose AICc is at most 2 above the lowest AICc.
    is_decided : bool
        True if the AICc of the second best fit is more than 2 above the lowest AICc.
    verdict : str
        The result in words.
    """

    def __init__(self, sides: Sequence[_Side]) -> None:
        held = sides[0].fit._held
        common = np.logical_and.reduce([side.counted for side in sides])
        self.readings = int(common.sum())
        self.left_out = int((~held).sum()) - self.readings
        made = []
        for side in sides:
            log, sigma, estimated = log_likelihoods(side.fit._sets, side.values, common)
            priors = side.fit._model.space.prior(side.fit._x)[0]
            error = (side.values - _measured(side.fit)) / sigma
            chi_square = float(np.sum(error[common] ** 2) + priors @ priors)
            deviance = float(-2.0 * np.sum(log[common]) + priors @ priors)
            parameters = len(side.fit._model.space) + estimated
            found = criteria(deviance, parameters, self.readings)
            made.append((side, log, parameters, chi_square, deviance, found["AICc"], found["BIC"], sigma))
        made.sort(key=lambda one: one[5])
        aicc, bic = np.array([one[5] for one in made]), np.array([one[6] for one in made])
        with np.errstate(invalid="ignore"):
            delta = np.nan_to_num(aicc - aicc.min(), nan=0.0, posinf=np.inf)
        weights = np.exp(-0.5 * delta)
        self.fits = [
            ComparedFit(
                side.name,
                parameters,
                chi_square,
                deviance,
                float(aicc[place]),
                float(bic[place]),
                float(delta[place]),
                float(bic[place] - bic.min()),
                float(weights[place] / weights.sum()),
                dict(side.fit.held_out.rms) if side.fit.held_out is not None else {},
                _held_out_score(side, sigma),
            )
            for place, (side, _, parameters, chi_square, deviance, _, _, sigma) in enumerate(made)
        ]
        self._sides, self._logs = [one[0] for one in made], [one[1] for one in made]
        near = [one for one in self.fits if one.delta_aicc <= DECIDED]
        self.chosen = min(near, key=lambda one: one.parameters).name
        self.is_decided = len(near) == 1
        self.verdict = "\n".join(self._verdict(near))

    def _verdict(self, near: list[ComparedFit]) -> list[str]:
        best, second = self.fits[:2]
        if self.is_decided:
            clearly = "clearly " if second.delta_aicc > _CLEAR else ""
            lines = [f"{best.name} is {clearly}better: the AICc of {second.name} is higher by {second.delta_aicc:.1f}"]
        else:
            named = ", ".join(one.name for one in near[:-1]) + f" and {near[-1].name}"
            lines = [
                f"the readings do not decide between {named}: their AICc differ by {near[-1].delta_aicc:.1f} or less"
            ]
            if sum(one.parameters == min(each.parameters for each in near) for one in near) == 1:
                lines.append(f"{self.chosen} has the fewest parameters of them")
        by_bic = min(self.fits, key=lambda one: one.bic)
        if by_bic.name not in (best.name, self.chosen):
            lines.append(f"BIC prefers {by_bic.name}, which has {by_bic.parameters} parameters")
        scored = [one for one in self.fits if np.isfinite(one.held_out_score)]
        if scored:
            first = max(scored, key=lambda one: one.held_out_score)
            if first.name != best.name:
                lines.append(f"{first.name} predicts the readings that were held out best")
        good = self._sides[0].fit.goodness
        if good.p < _assess.POOR or good.is_structured:
            lines.append(f"{best.name} does not agree with the readings either: all fits lack an effect")
        return lines

    def deciding_readings(self, count: int = 5) -> list[DecidingReading]:
        """Return the readings whose log likelihoods in the two best fits differ most, in falling order.

        Parameters
        ----------
        count : int
            Number of readings.

        Returns
        -------
        list of DecidingReading
            At most `count` readings.

        Raises
        ------
        ValueError
            `count` is not a whole number of 1 or more.
        """
        _check_count(count)
        first, second = self._sides[:2]
        difference = self._logs[0] - self._logs[1]
        order = np.argsort(-np.abs(np.nan_to_num(difference)), kind="stable")[: min(int(count), self.readings)]
        measured = _measured(first.fit)
        places = [(one, name, row) for one in first.fit._sets for name in one.measured for row in range(len(one))]
        found = []
        for reading in order:
            one, measure, row = places[reading]
            point = {name: cells[row] for name, cells in one.points.items()}
            point = {name: cell if isinstance(cell, str) else float(cell) for name, cell in point.items()}
            found.append(
                DecidingReading(
                    one.name,
                    measure,
                    first.fit._model.names.unit(measure),
                    row + 1,
                    point,
                    float(measured[reading]),
                    (float(first.values[reading]), float(second.values[reading])),
                    float(difference[reading]),
                )
            )
        return found

    def next_measurements(
        self, candidates: Any, *, count: int = 5, measures: list[str] | None = None
    ) -> DecidingMeasurements:
        """Return the operating points at which new readings would decide best between the two best fits.

        A reading decides if the predictions of both fits differ by many standard errors. The standard error contains
        the noise of the reading and the errors of the fitted parameters. The choice ignores differences that new
        estimates of the parameters could remove. Each reading is chosen after both fits are updated with the readings
        before. The updates of the fits use derivatives at the estimates.

        Parameters
        ----------
        candidates : dict, DataFrame or Grid
            Operating points that could be measured, as columns of parameters.
        count : int
            Number of readings to choose. A point may occur twice.
        measures : list of str, optional
            Measures that can be read. Default: the measures of the data.

        Returns
        -------
        DecidingMeasurements
            Operating points and measures, with the best first, and the expected difference of chi-square. A difference
            of 10 clearly supports one fit.

        Raises
        ------
        ValueError
            A name is unknown, the data have no readings of a measure, or both fits settle at no point.
        """
        _check_count(count)
        fits = [side.fit for side in self._sides[:2]]
        noises = {measure: noise for one in fits[0]._sets for measure, noise in one.noise.items()}
        points = [points_of(fit._model.names, "candidates", candidates) for fit in fits]
        rows: list[tuple[int, str]] = []
        values: list[list[Array]] = [[], []]
        slopes: list[list[Array]] = [[], []]
        variances = []
        for measure in measures if measures is not None else list(noises):
            if measure not in noises:
                raise ValueError(
                    f"the data have no readings of `{measure}`, so their error is unknown\n"
                    f"choose among {', '.join(noises)}"
                )
            found = [answers_at(fit._model, given, measure, fit._x) for fit, given in zip(fits, points)]
            known = np.logical_and.reduce([np.isfinite(answer.values) & ~answer.gaps for answer in found])
            rows += [(int(row), measure) for row in np.flatnonzero(known)]
            sigmas = [_sigma(fit, noises[measure], measure, answer.values) for fit, answer in zip(fits, found)]
            variances.append(np.mean(np.square(sigmas), axis=0)[known])
            for place, answer in enumerate(found):
                values[place].append(answer.values[known])
                slopes[place].append(answer.slopes[known])
        if not rows:
            raise ValueError("no candidate has a settled motion with derivatives in both fits\ngive other points")
        at = [np.concatenate(parts) for parts in values]
        chosen, errors, expected = _decide(
            at, [np.concatenate(parts) for parts in slopes], np.concatenate(variances), fits, int(count)
        )
        return DecidingMeasurements(
            (self._sides[0].name, self._sides[1].name),
            [{name: cells[rows[one][0]] for name, cells in points[0].items()} for one in chosen],
            [rows[one][1] for one in chosen],
            [(float(at[0][one]), float(at[1][one])) for one in chosen],
            errors,
            expected,
        )

    def __str__(self) -> str:
        measures = list(self.fits[0].held_out_rms)
        heads = ["fit", "parameters", "chi-square", "AICc", "difference", "weight", "BIC", "difference"]
        heads += [f"held-out rms ({measure})" for measure in measures] + ["held-out log score"] * bool(measures)
        rows = []
        for one in self.fits:
            cells = [one.name, str(one.parameters), f"{one.chi_square:.1f}", f"{one.aicc:.1f}"]
            cells += [f"{one.delta_aicc:.1f}", f"{one.weight:.2g}", f"{one.bic:.1f}", f"{one.delta_bic:.1f}"]
            cells += [f"{one.held_out_rms.get(measure, np.nan):.3g}" for measure in measures]
            rows.append(cells + [f"{one.held_out_score:.2f}"] * bool(measures))
        lines = [_report.table(heads, rows)]
        if self.left_out:
            lines.append(f"{self.left_out} readings are not compared: at least one fit has no settled motion there")
        return "\n".join([*lines, self.verdict])

    def __repr__(self) -> str:
        return f"<flapwing.Comparison of {', '.join(one.name for one in self.fits)}: {self.chosen}>"


def compare(fits: Sequence[Fit], /, names: Sequence[str] | None = None) -> Comparison:
    """Compare fits of the same readings, to decide which model or which set of free parameters describes a robot.

    The fits can differ in their design, model, keywords and free parameters. The comparison uses AICc (Hurvich and Tsai
    1989) and BIC (Schwarz 1978). A fit with more parameters is better only if the likelihood rises by more than noise
    can explain. If standard errors are unknown, each fit uses the standard errors that are most likely for this fit.

    Parameters
    ----------
    fits : list of Fit
        Two or more results of `fit`. All fits must have the same readings, standard errors and `hold_out`, and
        ``loss="linear"``.
    names : list of str, optional
        A name for each fit. Default: ``"fit 1"``, ``"fit 2"``, and so on.

    Returns
    -------
    Comparison
        The criteria of all fits, the verdict, the readings that decide between the fits, and next measurements that
        would decide.

    Raises
    ------
    ValueError
        Fewer than two fits; fits of different readings; a robust loss; parameters with a `spread`; too few readings in
        common.
    TypeError
        `fits` contains something other than a `Fit`.

    Examples
    --------
    >>> data = {"frequency_hz": [100, 104, 108, 112, 116, 120], "stroke_pp_deg": [69.6, 78.8, 86.1, 90.4, 91.1, 88.3]}
    >>> fits = [flapwing.fit("ozaki2018-large", data, [name], sigma="1 deg", starts=1, profile=False)
    ...         for name in ("hinge_stiffness", "air_density")]
    >>> flapwing.compare(fits, names=["hinge", "air"]).chosen
    'air'
    """
    listed = list(fits)
    for one in listed:
        if not isinstance(one, Fit):
            raise TypeError(f"`fits` has an entry that is {type(one).__name__}\nit must have results of flapwing.fit")
    if len(listed) < 2:
        raise ValueError(f"`fits` has {len(listed)} fit{'s' * (len(listed) != 1)}\ngive two or more fits")
    named = [f"fit {place + 1}" for place in range(len(listed))] if names is None else [str(name) for name in names]
    if len(named) != len(listed) or len(set(named)) != len(named):
        raise ValueError(f"`names` has {len(set(named))} different names for {len(listed)} fits\ngive one name per fit")
    for name, one in zip(named, listed):
        if one._loss != "linear":
            raise ValueError(f'{name} has loss="{one._loss}", which has no likelihood\nfit again with loss="linear"')
        if one.spreads:
            raise ValueError(
                f"{name} has a `spread` of {', '.join(one.spreads)}, so its number of parameters is not defined\n"
                "compare fits with per_set=True in place of the spread"
            )
        _check_same(named[0], listed[0], name, one)
    sides = []
    for name, one in zip(named, listed):
        answer = one._model.everything(one._x)
        sides.append(_Side(name, one, answer.values, answer.slopes, ~one._held & np.isfinite(answer.values)))
    if not np.logical_and.reduce([side.counted for side in sides]).any():
        raise ValueError("no reading has a settled motion in all fits\ncompare fits that settle at the same readings")
    return Comparison(sides)


def _check_same(first_name: str, first: Fit, name: str, other: Fit) -> None:
    """Raise ValueError if two fits have different readings, standard errors, or readings that are not fitted."""
    told = f"{first_name} and {name} have different"
    remedy = "compare fits of the same data, sigma and hold_out"
    if len(first._sets) != len(other._sets):
        raise ValueError(f"{told} data sets: {len(first._sets)} and {len(other._sets)}\n{remedy}")
    for one, two in zip(first._sets, other._sets):
        if one.measured.keys() != two.measured.keys():
            raise ValueError(
                f"{told} measures in {one.name}: {', '.join(one.measured)} and {', '.join(two.measured)}\n{remedy}"
            )
        points = one.points.keys() == two.points.keys() and len(one) == len(two) and one.branch == two.branch
        if not points or not all(_equal(cells, two.points[key]) for key, cells in one.points.items()):
            raise ValueError(f"{told} operating points or branches in {one.name}\n{remedy}")
        for measure, readings in one.measured.items():
            if not _equal(readings, two.measured[measure]):
                raise ValueError(f"{told} readings of {measure} in {one.name}\n{remedy}")
            noise, beside = one.noise[measure], two.noise[measure]
            if noise.kind != beside.kind or not _equal(noise.size, beside.size):
                raise ValueError(f"{told} standard errors of {measure} in {one.name}\n{remedy}")
    if not _equal(first._held, other._held):
        raise ValueError(f"{told} readings that are held out\n{remedy}")


def _equal(one: Any, other: Any) -> bool:
    return bool(np.array_equal(np.asarray(one), np.asarray(other)))


def _check_count(count: Any) -> None:
    if isinstance(count, bool) or not isinstance(count, (int, np.integer)) or count < 1:
        raise ValueError(f"`count` is {count!r}\nit must be a whole number, 1 or more")


def _measured(fit: Fit) -> Array:
    return np.concatenate([values for one in fit._sets for values in one.measured.values()])


def _held_out_score(side: _Side, sigma: Array) -> float:
    """Return the mean log density of the readings that were not fitted. The mean is nan if none of these readings has a
    settled motion."""
    held = side.fit._held & np.isfinite(side.values)
    if not held.any():
        return float("nan")
    known = np.where(np.isfinite(side.fit._covariance), side.fit._covariance, 0.0)
    slopes = side.slopes[held]
    variance = sigma[held] ** 2 + np.maximum(0.0, np.einsum("ij,jk,ik->i", slopes, known, slopes))
    error = side.values[held] - _measured(side.fit)[held]
    return float(np.mean(-0.5 * error**2 / variance - 0.5 * np.log(2.0 * np.pi * variance)))


def _sigma(fit: Fit, noise: Noise, measure: str, values: Array) -> Array:
    """Return the standard errors of new readings. If each reading has its own standard error, return the median of
    these standard errors."""
    common = Noise(noise.kind, float(np.median(noise.size)))
    return common.of(values, np.nan_to_num(values), fit._guesses[measure])


def _decide(
    values: Sequence[Array], slopes: Sequence[Array], variance: Array, fits: Sequence[Fit], count: int
) -> tuple[list[int], list[float], list[float]]:
    """Return the candidates that decide best between two fits, their standard errors, and the expected differences.

    If the first model is right, a reading increases the chi-square of the second fit. The increase is the square of the
    difference of both predictions, divided by the variance of the reading and of the second prediction. This increase
    already contains the new fit of the second model, whose predictions at all candidates move towards the first model.
    The expected difference is the mean of this increase and of the increase with exchanged fits.
    """
    # A weak prior, as in Fit.next_measurements, keeps undetermined variances finite.
    covariances = [np.linalg.inv(fit._information + 1e-4 * np.eye(len(fit._information))) for fit in fits]
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
