"""Measures of a motion from equally spaced samples, as in typical programs that use the libraries."""

from __future__ import annotations

from typing import Any

import model
import numpy as np
from numpy.typing import NDArray

COLUMNS = ("max_x", "max_psi", "lift")


def times(frequency: Any, per_period: int = model.SAMPLES_PER_PERIOD) -> NDArray[np.float64]:
    """Return the times of the samples (s). The samples cover the measured periods, including the first and the last
    instant."""
    begin = model.PERIODS - model.MEASURED
    return (begin + np.arange(model.MEASURED * per_period + 1) / per_period) / frequency


def measures(samples: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return max |x| (m), max |ψ| (rad) and the mean lift (N). The dimensions of `samples` are point, time and
    state."""
    tip = peak(np.abs(samples[:, :, 0])) * model.SCALE[0]
    psi = peak(np.abs(samples[:, :, 2]))
    v = samples[:, :, 1] * model.SCALE[1]
    lift = v * np.abs(v) * np.sin(2.0 * samples[:, :, 2])
    # Trapezoidal rule.
    mean = (lift.sum(1) - 0.5 * (lift[:, 0] + lift[:, -1])) / (lift.shape[1] - 1)
    return np.stack([tip, psi, model.LIFT * model.PRESSURE * mean], axis=1)


def peak(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the largest value of each row, from a parabola through the three samples around the largest sample."""
    before, middle, after = values[:, :-2], values[:, 1:-1], values[:, 2:]
    bend = before - 2.0 * middle + after
    turns = (middle >= before) & (middle >= after) & (bend < 0.0)
    above = np.where(turns, -((before - after) ** 2) / (8.0 * np.where(turns, bend, 1.0)), 0.0)
    return np.maximum(values.max(1), np.max(middle + above, axis=1))
