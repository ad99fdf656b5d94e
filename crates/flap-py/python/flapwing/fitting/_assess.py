"""The assessment of a fit: standard errors, discrepancy of the model, patterns in the residuals, and outliers."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from .._types import Array, Mask, Places
from . import _search, _solution
from ._data import DataSet, places_of
from ._discrepancy import Discrepancies, of_residuals
from ._drift import between_sets
from ._model import Answer, Model
from ._search import Found, Target
from ._solution import Assessment, Outlier
from ._structure import Layout, tests

#: Limits of the probability of chi-square. Below the first limit, the report calls the fit poor. Below the second
#: limit, the report calls the fit doubtful. Above the third limit, the given standard errors are too large.
POOR, DOUBTFUL, TOO_GOOD = 0.001, 0.05, 0.99

#: Smallest residual of an outlier, in standard errors. The first number is for the linear loss, and the second number
#: for losses that reduce the weight of outliers.
_OUTLYING, _OUTLYING_ROBUST = 4.0, 3.0


def assess(model: Model, sets: list[DataSet], target: Target, found: Found, answer: Answer) -> Assessment:
    """Return the standard errors of the estimated parameters, and the quality of the fit."""
    counted = target.used & np.isfinite(answer.values)
    difference = np.where(counted, answer.values - target.measured, np.nan)
    scaled = difference / target.sigma
    units = {measure: model.names.unit(measure) for one in sets for measure in one.measured}
    layout = Layout(model.points, model.outputs.row, _branches(sets))
    names = np.array(model.outputs.measure)
    measures = {
        measure: np.flatnonzero(counted & (names == measure)) for measure in dict.fromkeys(names[counted].tolist())
    }
    structure = tests(layout, measures, scaled)
    structured = {one.measure for one in structure if one.is_structured}
    is_outlier = _outlier_mask(measures, structured, scaled, target.loss)
    residuals = _solution.of_residuals(sets, units, difference, scaled, counted, structured)
    jacobian = target.jacobian(model.space, found.x, answer)
    readings = int(target.used.sum())
    slopes = np.zeros((len(scaled), len(model.space)))
    slopes[target.used] = jacobian[:readings]
    parameters = _search.effective_parameters(model.space, target, found.x, answer)
    every = target.residuals(model.space, found.x, answer)
    curvature, variance = _search.robust_factors(every[:readings], target.loss, readings - parameters)
    jacobian[:readings] *= np.sqrt(curvature)
    inverse, lost = _search.covariance_of(jacobian)
    known = _search.rank(jacobian)
    good = _solution.goodness(residuals, structure, every[readings:], known, sigma_known(sets))
    fitted = counted & ~is_outlier
    discrepancy = Discrepancies([], {}, inverse, np.inf)
    if structured or good.p < DOUBTFUL:
        if target.loss != "linear":
            measures = {measure: chosen[~is_outlier[chosen]] for measure, chosen in measures.items()}
        discrepancy = of_residuals(
            layout,
            measures,
            kinds(sets),
            units,
            structured,
            answer.values,
            target.sigma,
            scaled,
            slopes * np.sqrt(curvature),
            inverse,
        )
    if discrepancy.listed:
        # The discrepancy contains the excess of the residuals.
        variance = _search.NORMAL_VARIANCE[target.loss]
    covariance, least = (
        _search.m_covariance(one, inverse, jacobian[readings:], variance * curvature)
        for one in (discrepancy.covariance, inverse)
    )
    with np.errstate(invalid="ignore", divide="ignore"):
        factors = np.sqrt(np.maximum(np.diag(covariance), np.diag(least)) / np.diag(inverse))
    return Assessment(
        _search.with_infinite_variances(inverse, lost),
        _search.with_infinite_variances(covariance, lost),
        np.where(np.isfinite(factors), factors, 1.0),
        jacobian,
        discrepancy,
        good,
        _outliers(sets, scaled, is_outlier),
        between_sets(model.space, model.outputs.of_set[fitted], scaled[fitted], slopes[fitted]),
        _quantile(sigma_known(sets), min(good.freedom, discrepancy.freedom)),
    )


def _outlier_mask(measures: Mapping[str, Places], structured: set[str], scaled: Array, loss: str) -> Mask:
    """Return a mask that is True for readings that are outliers.

    If the typical residual of a measure is larger than the standard error, the limit for outliers is multiplied by
    (typical residual / standard error). The typical residual is computed from the median of the absolute residuals. If
    a pattern in the residuals shows that the model lacks an effect, the typical residual is the root mean square of the
    residuals.
    """
    limit = _OUTLYING if loss == "linear" else _OUTLYING_ROBUST
    mask = np.zeros(len(scaled), np.bool_)
    for measure, chosen in measures.items():
        size = np.abs(scaled[chosen])
        if len(size):
            typical = np.sqrt(np.mean(size**2)) if measure in structured else 1.4826 * np.median(size)
            mask[chosen] = size > limit * max(1.0, float(typical))
    return mask


def _outliers(sets: list[DataSet], scaled: Array, is_outlier: Mask) -> list[Outlier]:
    """Return the readings that are outliers, with the largest residual first."""
    places = places_of(sets)
    found = []
    for reading in sorted(np.flatnonzero(is_outlier).tolist(), key=lambda reading: -abs(scaled[reading])):
        one, measure, row = places[reading]
        found.append(Outlier(one.name, measure, row + 1, float(scaled[reading])))
    return found


def _branches(sets: list[DataSet]) -> Places:
    """Return a number for each reading: 0 without a branch, 1 on the branch ``"up"``, 2 on the branch ``"down"``."""
    known = [None, "up", "down"]
    return np.concatenate([np.full(len(one) * len(one.measured), known.index(one.branch), np.intp) for one in sets])


def _quantile(sigma_known: bool, freedom: float) -> float:
    """Return the half width of a 95 % confidence interval in standard errors: a quantile of the normal distribution or
    of Student's t distribution.
    """
    from scipy.stats import norm, t

    return float(norm.ppf(0.975) if sigma_known else t.ppf(0.975, max(1, freedom)))


def sigma_known(sets: list[DataSet]) -> bool:
    return "unknown" not in {noise.kind for one in sets for noise in one.noise.values()}


def kinds(sets: list[DataSet]) -> dict[str, str]:
    """Return the kind of the standard errors of each measure: ``"unknown"``, ``"relative"`` or ``"absolute"``. If the
    kinds differ between data sets, ``"absolute"`` has priority over ``"relative"``, and ``"relative"`` over
    ``"unknown"``.
    """
    order = ["unknown", "relative", "absolute"]
    found: dict[str, str] = {}
    for one in sets:
        for measure, noise in one.noise.items():
            found[measure] = max(found.get(measure, "unknown"), noise.kind, key=order.index)
    return found
