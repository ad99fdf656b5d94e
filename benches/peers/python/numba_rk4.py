"""numba: a simple handwritten sweep with fixed-step Runge-Kutta 4 in a compiled loop.

The program does not control the error. The unit of time is the drive period, so that one table has the sines of the
drive for all points.
"""

from __future__ import annotations

import math
from typing import Any

import model
import numba
import numpy as np
from measures import COLUMNS, measures
from model import MEASURED, PERIODS, SAMPLES_PER_PERIOD
from sweep import Answers, Array, sweep

compiled = numba.njit(fastmath=True)
rates = compiled(model.equations(math.sin, math.cos, abs))


@compiled
def step(force: float, period: float, h: float, drive: Any, x: float, v: float, psi: float, w: float) -> Any:
    """Return the state after one step of `h` drive periods. `drive` has the drive at the beginning, the middle and the
    end of the step."""
    h *= period
    x1, v1, psi1, w1 = rates(force * drive[0], x, v, psi, w)
    k = 0.5 * h
    x2, v2, psi2, w2 = rates(force * drive[1], x + k * x1, v + k * v1, psi + k * psi1, w + k * w1)
    x3, v3, psi3, w3 = rates(force * drive[1], x + k * x2, v + k * v2, psi + k * psi2, w + k * w2)
    x4, v4, psi4, w4 = rates(force * drive[2], x + h * x3, v + h * v3, psi + h * psi3, w + h * w3)
    k = h / 6.0
    x += k * (x1 + 2.0 * x2 + 2.0 * x3 + x4)
    v += k * (v1 + 2.0 * v2 + 2.0 * v3 + v4)
    psi += k * (psi1 + 2.0 * psi2 + 2.0 * psi3 + psi4)
    w += k * (w1 + 2.0 * w2 + 2.0 * w3 + w4)
    return x, v, psi, w


@compiled
def run(force: Array, frequency: Array, steps: int, drive: Array, samples: Array) -> None:
    every = steps // SAMPLES_PER_PERIOD
    begin = (PERIODS - MEASURED) * steps
    for point in range(len(force)):
        y = (0.0, 0.0, 0.0, 0.0)
        for n in range(PERIODS * steps + 1):
            if n >= begin and n % every == 0:
                samples[point, (n - begin) // every] = y
            phase = 2 * (n % steps)
            y = step(force[point], 1.0 / frequency[point], 1.0 / steps, drive[phase : phase + 3], *y)


def solve(force: Array, frequency: Array, rtol: float) -> Answers:
    # As many steps as keep the error about that of an adaptive solver at this tolerance: 128 per period at 1e-6.
    steps = SAMPLES_PER_PERIOD * math.ceil(2.0 * (1e-6 / rtol) ** 0.25 - 1e-9)
    drive = np.sin(math.pi * np.arange(2 * steps + 1) / steps)
    samples = np.empty((len(force), MEASURED * SAMPLES_PER_PERIOD + 1, 4))
    run(force, frequency, steps, drive, samples)
    return Answers(measures(samples), rhs=4.0 * PERIODS * steps * len(force))


if __name__ == "__main__":
    sweep(solve, COLUMNS)
