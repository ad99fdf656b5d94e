"""Comparison of fits of the same readings, by information criteria."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import _arguments
from .._mistakes import reading
from .._types import Mask
from . import _assess, _report, _solution
from ._criteria import criteria
from ._data import all_readings
from ._deciding import DecidingMeasurements, DecidingReading, Side, deciding_measurements, deciding_readings
from ._result import Fit

#: Smallest difference of AICc at which readings show that one of two fits is better.
_DECIDED = 2.0

#: Smallest difference of AICc at which the verdict contains the word "clearly".
_CLEAR = 10.0


@dataclass(frozen=True)
class ComparedFit:
    """The criteria of one fit in a comparison of fits. A lower value of a criterion is better.

    Attributes
    ----------
    name : str
        The name of the fit.
    parameters : int
        Number of free parameters, or, if the readings and priors determine only some combinations of the free
        parameters, the number of these combinations. Each measure whose standard error was estimated from the residuals
        adds 1 to `parameters`.
    chi_square : float
        Chi-square: the sum of the squares of (residual / standard error) over all readings. Chi-square includes the
        residuals of the priors. If standard errors were estimated from the residuals, chi-square does not show the
        quality of the fit.
    deviance : float
        Minus two times the log likelihood of the compared readings, including the residuals of priors. If a standard
        error is unknown, the likelihood uses the most likely value of the standard error (concentrated likelihood).
    aicc, bic : float
        Akaike's information criterion with the correction for few readings, and the Bayesian information criterion.
    delta_aicc, delta_bic : float
        The AICc and the BIC of the fit, minus the lowest AICc and the lowest BIC of all compared fits.
    weight : float
        Akaike weight: the probability of the fit among the compared fits.
    held_out_rms : dict of str to float
        Root mean square of the prediction errors of each measure, in the unit of the measure. `held_out_rms` uses only
        held-out readings that have a settled motion in all compared fits. `held_out_rms` is empty if no held-out
        reading has a settled motion in all compared fits.
    held_out_score : float
        Mean of the logarithm of the predicted probability density at each held-out reading that `held_out_rms` uses. A
        higher `held_out_score` is better. The width of the probability density accounts for the standard errors of the
        parameters, the discrepancy of the model, and the noise of the reading. `held_out_score` is nan if
        `held_out_rms` is empty. `held_out_score` is also nan if the standard error of a prediction is unknown, for
        example because the fitted readings do not determine a parameter.
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


class Comparison:
    """The comparison of several fits of the same readings. ``print(comparison)`` shows a table and the verdict.

    Attributes
    ----------
    fits : list of ComparedFit
        The criteria of the fits, with the lowest AICc first.
    readings : int
        Number of readings that enter the comparison: the fitted readings that have a settled motion in all fits.
    left_out : int
        Number of readings that are not compared, because at least one of the fits has no settled motion at the reading.
    held_out_left_out : int
        Number of held-out readings that are not compared, because at least one of the fits has no settled motion at the
        reading.
    chosen : str
        The name of the fit with the fewest parameters among the fits whose AICc is at most 2 above the lowest AICc.
    is_decided : bool
        True if the AICc of the second best fit is more than 2 above the lowest AICc.
    verdict : str
        The result of the comparison as text.
    """

    def __init__(self, sides: Sequence[Side]) -> None:
        self._sides = sorted(sides, key=lambda side: side.criteria.aicc)
        held = sides[0].fit._held
        predicted = held & np.logical_and.reduce([np.isfinite(side.values) for side in sides])
        self.readings = int(np.isfinite(sides[0].criteria.log).sum())
        self.left_out = int((~held).sum()) - self.readings
        self.held_out_left_out = int(held.sum() - predicted.sum())
        best = self._sides[0].criteria.aicc
        # If all criteria are infinite, no fit is better.
        delta = np.array([0.0 if one.criteria.aicc == best else one.criteria.aicc - best for one in self._sides])
        weights = np.exp(-0.5 * delta) / np.exp(-0.5 * delta).sum()
        lowest = min(side.criteria.bic for side in sides)
        self.fits = [
            ComparedFit(
                side.name,
                side.criteria.parameters,
                side.criteria.chi_square,
                side.criteria.deviance,
                side.criteria.aicc,
                side.criteria.bic,
                float(delta[place]),
                side.criteria.bic - lowest,
                float(weights[place]),
                _held_out_rms(side, predicted),
                _held_out_score(side, predicted),
            )
            for place, side in enumerate(self._sides)
        ]
        near = [one for one in self.fits if one.delta_aicc <= _DECIDED]
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
                compared = "compared " if self.held_out_left_out else ""
                lines.append(f"{first.name} predicts the {compared}readings that were held out best")
        good = self._sides[0].fit.goodness
        if good.p < _assess.POOR or good.is_structured:
            lines.append(f"{best.name} does not agree with the readings either: all fits lack an effect")
        return lines

    def deciding_readings(self, count: int = 5) -> list[DecidingReading]:
        """Return the readings whose log likelihoods differ most between the two best fits, with the largest difference
        first.

        Parameters
        ----------
        count : int
            Number of readings.

        Returns
        -------
        list of DecidingReading
            At most `count` readings, with the largest difference of the log likelihoods first.

        Raises
        ------
        TypeError
            Raised if `count` is not a whole number.
        ValueError
            Raised if `count` is less than 1.
        """
        return deciding_readings(self._sides[:2], _arguments.count("count", count))

    def next_measurements(
        self, candidates: Any, *, count: int = 5, measures: list[str] | None = None
    ) -> DecidingMeasurements:
        """Return the operating points at which new readings would most clearly show which of the two best fits is
        correct.

        A reading shows which of two fits is correct if the predictions of the two fits differ by many standard errors.
        The standard error of the difference contains the noise of the reading and the standard errors of the fitted
        parameters. A difference of the predictions does not count if it would disappear in new fits that include the
        reading. Before flap chooses a reading, it updates the two fits with all readings that it has chosen before. To
        update a fit, flap uses the derivatives at the estimated parameters. flap assumes that new readings have the
        parameters, the branch and the standard errors of the first data set.

        Parameters
        ----------
        candidates : dict, DataFrame or Grid
            Operating points that could be measured, as columns of parameters. You can leave out parameters that have
            the same value in all data sets.
        count : int
            Number of readings to choose. At one operating point, flap can choose one reading of each measure.
        measures : list of str, optional
            The measures that the new readings can have. The default of `measures` is all measures in the data.

        Returns
        -------
        DecidingMeasurements
            The operating points and measures of the new readings, with the best reading first, and the expected
            difference of chi-square. A difference of 10 in chi-square clearly supports one of the two fits.

        Raises
        ------
        ValueError
            Raised if the name of a parameter or measure is unknown, or if the data have no readings of a measure.
            Raised if `candidates` contains a fitted parameter, or lacks a parameter that has several values in the
            data. Raised if no operating point has a settled motion with the parameters of both fits.
        """
        return deciding_measurements(self._sides[:2], candidates, _arguments.count("count", count), measures)

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
        for count, kind in ((self.left_out, "readings"), (self.held_out_left_out, "held-out readings")):
            if count:
                lines.append(f"{kind} that are not compared, because a fit has no settled motion there: {count}")
        for one in self.fits:
            if measures and np.isnan(one.held_out_score):
                lines.append(f"{one.name} has no log score: the errors of some held-out predictions are unknown")
        return "\n".join([*lines, self.verdict])

    def __repr__(self) -> str:
        return f"<flapwing.Comparison of {', '.join(one.name for one in self.fits)}: {self.chosen}>"


def compare(fits: Sequence[Fit], /, names: Sequence[str] | None = None) -> Comparison:
    """Compare fits of the same readings, to decide which model or which set of free parameters describes a robot.

    The compared fits can differ in design, model, keyword arguments and free parameters. The comparison uses AICc
    (Hurvich and Tsai 1989) and BIC (Schwarz 1978). A fit with more parameters is better only if its likelihood is
    higher by more than noise can explain. If the standard errors of readings are unknown, each fit uses the standard
    errors that maximise its likelihood.

    Parameters
    ----------
    fits : list of Fit
        Two or more results of `fit`. All compared fits must have the same readings, the same standard errors and the
        same `hold_out`. The loss function of all fits must be ``"linear"``.
    names : list of str, optional
        A name for each fit. The default of `names` is ``"fit 1"``, ``"fit 2"``, and so on.

    Returns
    -------
    Comparison
        The criteria of all fits, and the verdict. The methods of `Comparison` return readings that show which fit is
        better.

    Raises
    ------
    ValueError
        Raised if `fits` has fewer than two entries. Raised if the fits have different readings, a loss other than
        ``"linear"``, or parameters with a `spread`. Raised if no reading has a settled motion in all fits.
    TypeError
        Raised if `fits` is not a list, or an entry of `fits` is not a `Fit`.

    Examples
    --------
    >>> data = {"frequency_hz": [100, 104, 108, 112, 116, 120], "stroke_pp_deg": [69.6, 78.8, 86.1, 90.4, 91.1, 88.3]}
    >>> fits = [flapwing.fit("ozaki2018-large", data, [name], sigma="1 deg", starts=1, profile=False)
    ...         for name in ("hinge_stiffness", "air_density")]
    >>> flapwing.compare(fits, names=["hinge", "air"]).chosen
    'air'
    """
    with reading("fits", fits, "it must be a list of results of flapwing.fit"):
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
    answers = [one._model.everything(one._x) for one in listed]
    common = np.logical_and.reduce([~one._held & np.isfinite(answer.values) for one, answer in zip(listed, answers)])
    if not common.any():
        raise ValueError("no reading has a settled motion in all fits\ncompare fits that settle at the same readings")
    sides = []
    for name, one, answer in zip(named, listed, answers):
        found = criteria(one._sets, one._model.space, one._x, answer, common)
        sides.append(Side(name, one, answer.values, one._errors_of_readings(answer), found))
    return Comparison(sides)


def _check_same(first_name: str, first: Fit, name: str, other: Fit) -> None:
    """Raise ValueError if two fits have different readings, different standard errors, or different held-out
    readings."""
    subject = f"{first_name} and {name} have different"
    remedy = "compare fits of the same data, sigma and hold_out"
    if len(first._sets) != len(other._sets):
        raise ValueError(f"{subject} data sets: {len(first._sets)} and {len(other._sets)}\n{remedy}")
    for one, two in zip(first._sets, other._sets):
        if one.measured.keys() != two.measured.keys():
            raise ValueError(
                f"{subject} measures in {one.name}: {', '.join(one.measured)} and {', '.join(two.measured)}\n{remedy}"
            )
        points = one.points.keys() == two.points.keys() and len(one) == len(two) and one.branch == two.branch
        if not points or not all(_equal(cells, two.points[key]) for key, cells in one.points.items()):
            raise ValueError(f"{subject} operating points or branches in {one.name}\n{remedy}")
        for measure, readings in one.measured.items():
            if not _equal(readings, two.measured[measure]):
                raise ValueError(f"{subject} readings of {measure} in {one.name}\n{remedy}")
            noise, beside = one.noise[measure], two.noise[measure]
            if noise.kind != beside.kind or not _equal(noise.size, beside.size):
                raise ValueError(f"{subject} standard errors of {measure} in {one.name}\n{remedy}")
    if not _equal(first._held, other._held):
        raise ValueError(f"{subject} readings that are held out\n{remedy}")


def _equal(one: Any, other: Any) -> bool:
    return bool(np.array_equal(np.asarray(one), np.asarray(other)))


def _held_out_rms(side: Side, predicted: Mask) -> dict[str, float]:
    """Return the root mean square of the prediction errors of each measure. The mean is over the readings for which the
    mask `predicted` is True.
    """
    names = np.array(side.fit._model.outputs.measure)
    return _solution.rms_errors(names, side.values - all_readings(side.fit._sets), predicted)


def _held_out_score(side: Side, predicted: Mask) -> float:
    """Return the mean log probability density of the readings for which the mask `predicted` is True. Return nan if the
    mask selects no reading, or if the standard error of a prediction is unknown.
    """
    variance = side.errors[predicted] ** 2
    if not predicted.any() or not np.isfinite(variance).all():
        return float("nan")
    error = side.values[predicted] - all_readings(side.fit._sets)[predicted]
    return float(np.mean(-0.5 * error**2 / variance - 0.5 * np.log(2.0 * np.pi * variance)))
