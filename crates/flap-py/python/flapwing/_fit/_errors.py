"""Standard errors of readings that depend on the fit: shares of the model's values, and those estimated from residuals."""

from __future__ import annotations

from typing import Mapping

import numpy as np

from ._model import Answer
from ._readings import DataSet
from ._search import Target
from ._types import Array, Mask


def first_guesses(sets: list[DataSet]) -> dict[str, float]:
    """Standard errors of measures for which none is known, before a fit: a share of the largest reading."""
    largest: dict[str, float] = {}
    for one in sets:
        for measure, values in one.measured.items():
            largest[measure] = max(largest.get(measure, 0.0), float(np.abs(values).max()))
    return {measure: 0.03 * size or 1.0 for measure, size in largest.items()}


def new_guesses(
    sets: list[DataSet], target: Target, used: Mask, answer: Answer, parameters: int, guesses: dict[str, float]
) -> None:
    """Standard errors of such measures, from the residuals."""
    which = np.array([measure for one in sets for measure in one.measured for _ in range(len(one))])
    freedom = max(1, int(used.sum()) - parameters) / max(1, int(used.sum()))
    for measure in guesses:
        mine = used & (which == measure)
        residuals = (answer.values - target.measured)[mine]
        if len(residuals):
            robust = 1.4826 * float(np.median(np.abs(residuals)))
            spread = float(np.sqrt(np.mean(residuals**2))) if target.loss == "linear" else robust
            guesses[measure] = max(spread / np.sqrt(freedom), 1e-9 * float(np.abs(target.measured[mine]).max()), 1e-300)


def sigmas(sets: list[DataSet], values: Array, guesses: Mapping[str, float]) -> Array:
    parts, begin = [], 0
    for one in sets:
        for measure, measured in one.measured.items():
            parts.append(one.noise[measure].of(values[begin : begin + len(one)], measured, guesses[measure]))
            begin += len(one)
    return np.concatenate(parts)
