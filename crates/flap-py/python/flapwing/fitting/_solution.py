"""The solution of a fit, which contains all data for predictions, for the report and for the device file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._types import Array, Mask
from ._data import DataSet
from ._discrepancy import Discrepancies
from ._intervals import Profile
from ._model import Model
from ._spread import Spread
from ._structure import Structure


@dataclass(frozen=True)
class Estimate:
    """The estimate of a parameter.

    Attributes
    ----------
    parameter, unit : str
        The estimated parameter, and the SI unit of the parameter.
    value : float
        The estimated value of the parameter, in SI units.
    error : float
        Standard error of the parameter in SI units, computed from the derivatives at the estimate. If the model
        disagrees with the data, the standard error includes the discrepancy of the model.
    low, high : float
        Lower and upper end of the parameter's 95 % confidence interval, in SI units. If the fit computed profile
        likelihoods, the interval is computed from the profile likelihood.
    open_below, open_above : bool
        True if the interval extends to the lower or upper bound of the parameter. If the interval extends to a bound,
        the data give no limit for the parameter on the side of the bound.
    profile : Profile or None
        The profile likelihood of the parameter. `profile` is None if the fit did not compute profile likelihoods.
    at_bound : bool
        True if the estimate of the parameter is at a bound of the parameter.
    """

    parameter: str
    unit: str
    value: float
    error: float
    low: float
    high: float
    open_below: bool
    open_above: bool
    profile: Profile | None
    at_bound: bool

    @property
    def is_known(self) -> bool:
        """True if the data give a lower and an upper limit for the parameter."""
        return not (self.open_below or self.open_above) and bool(np.isfinite(self.error))


@dataclass(frozen=True)
class Unsettled:
    """A reading that is ignored, because the motion of the model at the operating point does not settle.

    Attributes
    ----------
    data_set, measure : str
        The data set and the measure of the reading.
    row : int
        The row of the reading in the data set, counted from 1.
    status : str
        The status of the motion at the reading's operating point.
    """

    data_set: str
    measure: str
    row: int
    status: str


@dataclass(frozen=True)
class HeldOut:
    """Predictions of readings that were not fitted (`hold_out`).

    Attributes
    ----------
    count : int
        Number of readings that were not fitted.
    rms : dict of str to float
        Root mean square of the prediction errors of each measure, in the unit of the measure. Readings whose motion
        does not settle do not count in `rms`.
    covered : float
        The fraction of the held-out readings that are within the 95 % bands of their predictions. The width of the
        bands accounts for the standard errors of the parameters, the discrepancy of the model, and the noise of the
        readings. A reading whose motion does not settle counts as outside of its band. A held-out reading does not
        count if its prediction has no derivatives, because the band of the prediction is unknown. `covered` is nan if
        no held-out reading counts.
    unsettled : int
        Number of readings without a prediction, because the motion of the model at the operating point does not settle.
    """

    count: int
    rms: dict[str, float]
    covered: float
    unsettled: int


@dataclass(frozen=True)
class Effort:
    """The cost of the computation of a fit.

    Attributes
    ----------
    starts : int
        Number of searches.
    agreed : int
        Number of searches that ended at the best fit. `agreed` is 0 if the computation of a profile likelihood found a
        better fit than all searches.
    points : int
        Number of simulated points.
    rhs_evals : int
        Number of evaluations of the equations of motion.
    seconds : float
        Time of the fit (s).
    """

    starts: int
    agreed: int
    points: int
    rhs_evals: int
    seconds: float


@dataclass(frozen=True)
class Outlier:
    """A fitted reading with a very large residual.

    Attributes
    ----------
    data_set, measure : str
        The data set and the measure of the reading.
    row : int
        The row of the reading in the data set, counted from 1.
    residual : float
        The model's prediction minus the reading, divided by the standard error of the reading.
    """

    data_set: str
    measure: str
    row: int
    residual: float


@dataclass(frozen=True, eq=False)
class Residuals:
    """The residuals of a measure in a data set.

    Attributes
    ----------
    data_set : str
        Name of the data set.
    measure, unit : str
        The measure whose residuals are listed, and the unit of the measure.
    values : array
        The residuals: the model's prediction minus each reading, in the measure's unit. A residual is nan if its
        reading was not fitted, or if the motion does not settle.
    scaled : array
        The residuals divided by the standard errors of the readings.
    rms : float
        Root mean square of the residuals, in the measure's unit.
    count : int
        Number of fitted readings of the measure in the data set.
    is_structured : bool
        True if the residuals of the measure in all data sets together have a pattern (see `Structure`).
    """

    data_set: str
    measure: str
    unit: str
    values: Array
    scaled: Array
    rms: float
    count: int
    is_structured: bool = False


@dataclass(frozen=True, eq=False)
class Goodness:
    """The quality of a fit.

    Attributes
    ----------
    chi_square : float
        Sum of the squares of (residual / standard error) over all readings and priors.
    freedom : int
        Degrees of freedom of the fit: the number of readings and priors, less the number of parameters that the
        readings and priors determine.
    p : float
        The probability of a chi-square of at least `chi_square`, if the model and the given standard errors are
        correct. `p` is nan if standard errors are estimated from the residuals.
    residuals : list of Residuals
        The residuals of each measure in each data set.
    structure : list of Structure
        Tests of the residuals of each measure for patterns along each parameter of the operating points.
    """

    chi_square: float
    freedom: int
    p: float
    residuals: list[Residuals]
    structure: list[Structure]

    @property
    def is_structured(self) -> bool:
        """True if the residuals have a pattern, which suggests that the model lacks an effect."""
        return any(one.is_structured for one in self.residuals)


@dataclass(frozen=True)
class Assessment:
    """The standard errors of the estimated parameters, and the quality of the fit."""

    #: The inverse of the curvature of the cost, and the covariance of the coordinates, which includes the discrepancy
    #: of the model. If the data do not determine a coordinate, its variance in both matrices is infinite.
    plain: Array
    covariance: Array
    #: The standard error of each coordinate, divided by the standard error that follows from the curvature of the cost.
    #: The factor is 1 for the linear loss without discrepancy.
    factors: Array
    #: The derivatives of the residuals and priors with respect to the coordinates, scaled to the curvature of the cost.
    jacobian: Array
    discrepancy: Discrepancies
    goodness: Goodness
    outliers: list[Outlier]
    #: The parameter that best explains a disagreement between data sets; empty if the data sets agree.
    drifting: str
    quantile: float


def of_residuals(
    sets: Sequence[DataSet],
    units: Mapping[str, str],
    values: Array,
    scaled: Array,
    counted: Mask,
    structured: set[str],
) -> list[Residuals]:
    """Return the residuals of a fit: one `Residuals` object for each measure in each data set."""
    found, begin = [], 0
    for one in sets:
        for measure in one.measured:
            part = slice(begin, begin + len(one))
            begin += len(one)
            mine = values[part][counted[part]]
            rms = float(np.sqrt(np.mean(mine**2))) if len(mine) else np.nan
            unit, is_structured = units[measure], measure in structured
            residuals = values[part].copy(), scaled[part].copy()
            found.append(Residuals(one.name, measure, unit, *residuals, rms, len(mine), is_structured))
    return found


def goodness(
    residuals: list[Residuals], structure: list[Structure], priors: Array, parameters: int, sigma_known: bool
) -> Goodness:
    """Return the quality of a fit from the residuals of the readings and of the priors."""
    from scipy.stats import chi2

    scaled = [one.scaled[np.isfinite(one.scaled)] for one in residuals]
    total = float(sum(part @ part for part in scaled) + priors @ priors)
    freedom = sum(len(part) for part in scaled) + len(priors) - parameters
    p = float(chi2.sf(total, freedom)) if sigma_known and freedom > 0 else np.nan
    return Goodness(total, freedom, p, residuals, structure)


def held_out(names: np.ndarray[Any, Any], measured: Array, values: Array, held: Mask, reach: Array) -> HeldOut:
    """Return a summary of the prediction errors of held-out readings. `names` contains the measure of each reading.
    `reach` contains half of the width of each reading's 95 % band, or nan if the width is unknown.
    """
    difference = values - measured
    settled = held & np.isfinite(difference)
    banded = held & ~(settled & np.isnan(reach))
    covered = float(np.mean((np.abs(difference) <= reach)[banded])) if banded.any() else np.nan
    return HeldOut(int(held.sum()), rms_errors(names, difference, settled), covered, int((held & ~settled).sum()))


def rms_errors(names: np.ndarray[Any, Any], difference: Array, chosen: Mask) -> dict[str, float]:
    """Return the root mean square of `difference` for each measure, over the readings in the mask `chosen`. `names`
    contains the measure of each reading.
    """
    return {
        str(measure): float(np.sqrt(np.mean(difference[chosen & (names == measure)] ** 2)))
        for measure in dict.fromkeys(names[chosen].tolist())
    }


class Solution:
    """The estimates of a fit with their uncertainties, and the model and data of the fit. The public class `Fit`
    inherits from `Solution` and adds methods.
    """

    def __init__(
        self,
        *,
        model: Model,
        sets: list[DataSet],
        x: Array,
        assessment: Assessment,
        information: Array,
        estimates: dict[str, Estimate],
        spreads: dict[str, Spread],
        sigma_known: bool,
        guesses: Mapping[str, float],
        combinations: list[str],
        indistinct: list[str],
        unsettled: list[Unsettled],
        without_slopes: int,
        converged: bool,
        loss: str,
        held: Mask,
    ) -> None:
        self.estimates, self.spreads = estimates, spreads
        self.combinations, self.indistinct = combinations, indistinct
        self.goodness, self.unsettled, self.without_slopes = assessment.goodness, unsettled, without_slopes
        self.converged, self.sigma_known = converged, sigma_known
        self.held_out: HeldOut | None = None
        self.effort = Effort(1, 1, 0, 0, 0.0)
        self._model, self._sets, self._x, self._quantile = model, sets, x, assessment.quantile
        self._covariance, self._information, self._guesses = assessment.covariance, information, dict(guesses)
        self.discrepancy, self._discrepancy = assessment.discrepancy.listed, assessment.discrepancy.noise
        self.outliers, self.drifting = assessment.outliers, assessment.drifting
        self._loss, self._held = loss, held

    @property
    def values(self) -> dict[str, Any]:
        """The fitted values of the parameters that have one value for all data sets, in SI units. Example:
        ``run(design, **fit.values)``.
        """
        space = self._model.space
        return {one.parameter: self.estimates[one.label].value for one in space.coordinates if one.of_set is None}

    @property
    def covariance(self) -> Array:
        """The covariance matrix of the estimates, in SI units. If the data do not determine a parameter, the variance
        of the parameter is infinite, and its covariances are nan.
        """
        slopes = self._model.space.slopes(self._x)
        return np.asarray(self._covariance * np.outer(slopes, slopes))

    @property
    def correlations(self) -> Array:
        """The correlation matrix of the estimates."""
        errors = np.sqrt(np.diag(self._covariance))
        with np.errstate(invalid="ignore"):
            return np.asarray(self._covariance / np.outer(errors, errors))

    def _place(self, data_set: str) -> int:
        """Return the index of the data set with the given name. Raise ValueError if no data set has the given name."""
        known = [one.name for one in self._sets]
        if data_set not in known:
            raise ValueError(f"there is no data set {data_set!r}\nchoose among {', '.join(known)}")
        return known.index(data_set)
