"""A settled motion: when a march ends, and what is measured of the period after it."""

from __future__ import annotations

import math
from typing import Any

import bimorph
import numpy as np
from numpy.typing import NDArray

#: Largest change of a state over a period of a settled motion.
RESIDUAL = 1e-6
#: Periods in which the residual of a march with error control is to fall.
PATIENCE = 32
MOST_PERIODS = 1000
#: Per period.
SAMPLES = 64

COLUMNS = ("stroke_pp_deg", "pitch_pp_deg", "lift_mean_mn", "power_mean_mw")


def measures(samples: NDArray[np.float64], frequency: Any) -> NDArray[np.float64]:
    """The measures of settled periods, from states by point, phase and state, and the drive's frequencies (Hz)."""
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
    """The largest value of each row, which is one period, with a parabola through the three samples around it."""
    before, after = np.roll(values, 1, axis=1), np.roll(values, -1, axis=1)
    bend = before - 2.0 * values + after
    turns = (values >= before) & (values >= after) & (bend < 0.0)
    above = np.where(turns, -((before - after) ** 2) / (8.0 * np.where(turns, bend, 1.0)), 0.0)
    return np.max(values + above, axis=1)
