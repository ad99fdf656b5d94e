"""The likelihood of the readings in a fit, and the information criteria AICc and BIC."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .._types import Array, Mask
from ._data import DataSet, all_readings, are_unknown, estimating
from ._model import Answer
from ._parameters import Space
from ._search import Target, rank, sigmas


@dataclass(frozen=True)
class Criteria:
    """The likelihood of the readings in a fit, and the information criteria of the fit."""

    #: The log likelihood of each reading; nan for readings that are not counted.
    log: Array
    #: The standard error of each reading. An unknown standard error has the most likely value.
    sigma: Array
    #: Number of parameters that the readings and priors determine, plus the number of estimated standard errors.
    parameters: int
    estimated: int
    chi_square: float
    deviance: float
    aicc: float
    bic: float


def criteria(sets: Sequence[DataSet], space: Space, x: Array, answer: Answer, counted: Mask) -> Criteria:
    """Return the information criteria of a fit whose estimate has the coordinates `x`. Only readings for which the mask
    `counted` is True enter the criteria. `answer` contains the values that the model predicts for all readings.
    """
    values, measured = answer.values, all_readings(sets)
    log, sigma, estimated = _log_likelihoods(sets, values, counted)
    priors = space.prior(x)[0]
    error = (np.where(np.isfinite(values), values, 0.0) - measured) / sigma
    chi_square = float(np.sum(error[counted] ** 2) + priors @ priors)
    deviance = float(-2.0 * np.sum(log[counted]) + priors @ priors)
    jacobian = Target(measured, sigma, counted, "linear").jacobian(space, x, answer)
    count, readings = rank(jacobian) + estimated, int(counted.sum())
    left = readings - count - 1
    # AICc is infinite for too few readings.
    correction = 2.0 * count * (count + 1) / left if left > 0 else np.inf
    aicc, bic = deviance + 2.0 * count + correction, deviance + count * float(np.log(readings))
    return Criteria(log, sigma, count, estimated, chi_square, deviance, float(aicc), bic)


def _log_likelihoods(sets: Sequence[DataSet], values: Array, counted: Mask) -> tuple[Array, Array, int]:
    """Return the log likelihood and the standard error of each reading, and the number of estimated standard errors.

    The log likelihood is nan for readings at which the mask `counted` is False. An unknown standard error is the root
    mean square of the residuals of those readings of the measure that have no given standard error. If the motion at a
    reading does not settle, the model's value for the reading is zero, as for a wing at rest.
    """
    measured = all_readings(sets)
    error = np.where(np.isfinite(values), values, 0.0) - measured
    measures = list(dict.fromkeys(measure for one in sets for measure in one.measured))
    sigma = sigmas(sets, values, dict.fromkeys(measures, 1.0))
    estimated = 0
    for measure in measures:
        unknown, source = are_unknown(sets, measure), estimating(sets, measure, counted)
        estimated += bool((unknown & counted).any())
        if unknown.any() and source.any():
            least = 1e-9 * float(np.abs(measured[unknown]).max())
            sigma[unknown] = max(float(np.sqrt(np.mean(error[source] ** 2))), least)
    log = -0.5 * (error / sigma) ** 2 - np.log(np.sqrt(2.0 * np.pi) * sigma)
    return np.where(counted, log, np.nan), sigma, estimated
