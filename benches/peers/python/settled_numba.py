"""numba: a simple handwritten sweep with fixed-step Runge-Kutta 4 in a compiled loop, until the motions settle.

The program does not control the error. The forces of the plates depend only on the phase of the drive, and come from
tables.
"""

from __future__ import annotations

import math
from typing import Any

import bimorph
import numba
import numpy as np
from orbit import COLUMNS, MOST_PERIODS, RESIDUAL, SAMPLES, measures
from sweep import Answers, Array, sweep

compiled = numba.njit(fastmath=True)
rates = compiled(bimorph.rates)


@compiled
def step(omega: float, h: float, plates: Any, x: float, v: float, psi: float, w: float) -> Any:
    """Return the state after one step of `h` radians. `plates` has the forces at the beginning, the middle and the end
    of the step."""
    k = 0.5 * h
    x1, v1, psi1, w1 = rates(omega, plates[0, 0], plates[1, 0], x, v, psi, w)
    x2, v2, psi2, w2 = rates(omega, plates[0, 1], plates[1, 1], x + k * x1, v + k * v1, psi + k * psi1, w + k * w1)
    x3, v3, psi3, w3 = rates(omega, plates[0, 1], plates[1, 1], x + k * x2, v + k * v2, psi + k * psi2, w + k * w2)
    x4, v4, psi4, w4 = rates(omega, plates[0, 2], plates[1, 2], x + h * x3, v + h * v3, psi + h * psi3, w + h * w3)
    k = h / 6.0
    x += k * (x1 + 2.0 * x2 + 2.0 * x3 + x4)
    v += k * (v1 + 2.0 * v2 + 2.0 * v3 + v4)
    psi += k * (psi1 + 2.0 * psi2 + 2.0 * psi3 + psi4)
    w += k * (w1 + 2.0 * w2 + 2.0 * w3 + w4)
    return x, v, psi, w


@compiled
def settle(omega: float, steps: int, plates: Array, samples: Array) -> int:
    """Integrate until a period changes the state by less than the limit, and sample the next period. Return the number
    of periods, or 0 if the motion does not settle."""
    every = steps // SAMPLES
    h = 2.0 * math.pi / steps
    y = (0.0, 0.0, 0.0, 0.0)
    measured = False
    for periods in range(1, MOST_PERIODS + 1):
        before = y
        for n in range(steps):
            if measured and n % every == 0:
                samples[n // every] = y
            y = step(omega, h, plates[:, 2 * n : 2 * n + 3], *y)
        if measured:
            return periods
        change = 0.0
        for i in range(4):
            change = max(change, abs(y[i] - before[i]))
        measured = change <= RESIDUAL
    return 0


def solve(volts_pp: Array, frequency: Array, rtol: float) -> Answers:
    # As many steps as keep the error about that of an adaptive solver at this tolerance: 128 per period at 1e-6.
    steps = SAMPLES * math.ceil(2.0 * (1e-6 / rtol) ** 0.25 - 1e-9)
    sine = np.sin(math.pi * np.arange(2 * steps + 1) / steps)
    samples = np.empty((len(frequency), SAMPLES, 4))
    periods = 0
    for point, (volts, hertz) in enumerate(zip(volts_pp, frequency)):
        taken = settle(2.0 * math.pi * hertz, steps, np.stack(bimorph.push(volts, sine, np.exp)), samples[point])
        if taken == 0:
            samples[point] = np.nan
        periods += taken or MOST_PERIODS
    return Answers(measures(samples, frequency), rhs=4.0 * steps * periods, periods=periods)


if __name__ == "__main__":
    sweep(solve, COLUMNS)
