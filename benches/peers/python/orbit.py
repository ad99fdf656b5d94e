"""Settled motions: the condition for the end of a march, and the measures of the next period."""

from __future__ import annotations

import math
from typing import Any

import bimorph
import numpy as np
from numpy.typing import NDArray

#: Largest change of a state over a period of a settled motion.
RESIDUAL = 1e-6
#: Number of periods within which the residual of a march with error control must fall.
PATIENCE = 32
MOST_PERIODS = 1000
#: Number of samples per drive period.
SAMPLES = 64

COLUMNS = ("stroke_pp_deg", "pitch_pp_deg", "lift_mean_mn", "power_mean_mw")


def measures(samples: NDArray[np.float64], frequency: Any) -> NDArray[np.float64]:
    """Return the measures of settled periods. The dimensions of `samples` are point, phase and state, and `frequency`
    is the drive frequency (Hz)."""
    tip = samples[:, :, 0] * bimorph.TIP_SCALE
    speed = samples[:, :, 1] * bimorph.TIP_SCALE * 2.0 * math.pi * np.asarray(frequency)[:, None]
    pitch = samples[:, :, 2] * bimorph.PITCH_SCALE
    flow = speed * np.abs(speed)
    lift = bimorph.PRESSURE * bimorph.LIFT * flow * np.sin(2.0 * pitch)
    power = bimorph.TIP_DRAG * (bimorph.DRAG_MEAN + bimorph.DRAG_SWING * np.cos(2.0 * pitch)) * flow * speed
    stroke = bimorph.TRANSMISSION * peak_to_peak(tip)
    return np.stack(
        [np.degrees(stroke), np.degrees(peak_to_peak(pitch)), 1e3 * lift.mean(1), 1e3 * power.mean(1)], axis=1
    )


def peak_to_peak(values: NDArray[np.float64]) -> NDArray[np.float64]:
    return peak(values) + peak(-values)


def peak(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the largest value of each row, from a parabola through the three samples around the largest sample. A row
    is one period."""
    before, after = np.roll(values, 1, axis=1), np.roll(values, -1, axis=1)
    bend = before - 2.0 * values + after
    turns = (values >= before) & (values >= after) & (bend < 0.0)
    above = np.where(turns, -((before - after) ** 2) / (8.0 * np.where(turns, bend, 1.0)), 0.0)
    return np.max(values + above, axis=1)
