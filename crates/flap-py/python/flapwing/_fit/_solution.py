"""The solution of a fit, of which its predictions, its report and its device are made."""

from __future__ import annotations

from typing import Any, Mapping

import numpy as np

from ._estimate import Effort, Estimate, HeldOut, Unsettled
from ._goodness import Goodness
from ._model import Model
from ._readings import DataSet
from ._types import Array


class Solution:
    """Estimates with their uncertainty, and the model and the data that they are of; see `Fit`."""

    def __init__(
        self,
        *,
        model: Model,
        sets: list[DataSet],
        x: Array,
        covariance: Array,
        information: Array,
        estimates: dict[str, Estimate],
        quantile: float,
        sigma_known: bool,
        guesses: Mapping[str, float],
        combinations: list[str],
        indistinct: list[str],
        goodness: Goodness,
        unsettled: list[Unsettled],
        without_slopes: int,
        converged: bool,
    ) -> None:
        self.estimates, self.combinations, self.indistinct = estimates, combinations, indistinct
        self.goodness, self.unsettled, self.without_slopes, self.converged = (
            goodness,
            unsettled,
            without_slopes,
            converged,
        )
        self.sigma_known = sigma_known
        self.held_out: HeldOut | None = None
        self.effort = Effort(1, 1, 0, 0, 0.0)
        self._model, self._sets, self._x, self._quantile = model, sets, x, quantile
        self._covariance, self._information, self._guesses = covariance, information, dict(guesses)

    @property
    def values(self) -> dict[str, Any]:
        """The fitted values of parameters that all data sets share, in SI units: ``run(design, **fit.values)``."""
        space = self._model.space
        return {one.parameter: self.estimates[one.label].value for one in space.coordinates if one.of_set is None}

    @property
    def covariance(self) -> Array:
        """The covariance of the estimates in SI units; infinite for what is not known."""
        slopes = self._model.space.slopes(self._x)
        return np.asarray(self._covariance * np.outer(slopes, slopes))

    @property
    def correlations(self) -> Array:
        """The correlations of the estimates."""
        errors = np.sqrt(np.diag(self._covariance))
        with np.errstate(invalid="ignore"):
            return np.asarray(self._covariance / np.outer(errors, errors))
