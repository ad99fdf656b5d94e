"""SciPy: `solve_ivp` with RK45 and a right-hand side in plain Python, period by period until the motion has settled."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from bimorph import push, rates
from orbit import COLUMNS, MOST_PERIODS, PATIENCE, RESIDUAL, SAMPLES, measures
from scipy.integrate import solve_ivp
from sweep import Answers, Array, sweep

PERIOD = 2.0 * math.pi
PHASES = PERIOD * np.arange(SAMPLES) / SAMPLES


def rhs(phase: float, y: Any, volts_pp: float, omega: float) -> tuple[float, float, float, float]:
    return rates(omega, *push(volts_pp, math.sin(phase)), *y)


def period(y: Any, point: tuple[float, float], rtol: float, phases: Array | None = None) -> Any:
    """Integrate one period from the state `y`. Each period begins with the same step, so that the final state depends
    only on `y`."""
    return solve_ivp(
        rhs, (0.0, PERIOD), y, t_eval=phases, rtol=rtol, atol=0.1 * rtol, first_step=PERIOD / SAMPLES, args=point
    )


def settle(volts_pp: float, frequency: float, rtol: float, phases: Array = PHASES) -> tuple[Array, int, int]:
    """Return the states of the settled motion at `phases`, the number of evaluations of the right-hand side, and the
    number of periods. Integration errors can prevent the motion from settling. If the residual does not fall, the march
    therefore continues with a tenth of the tolerance.
    """
    point = (volts_pp, PERIOD * frequency)
    y = np.zeros(4)
    evaluations = 0
    least = last_least = math.inf
    for periods in range(1, MOST_PERIODS + 1):
        run = period(y, point, rtol)
        evaluations += run.nfev
        change = np.abs(run.y[:, -1] - y).max()
        y = run.y[:, -1]
        if change <= RESIDUAL:
            run = period(y, point, rtol, phases)
            return run.y.T, evaluations + run.nfev, periods + 1
        least = min(least, change)
        if periods % PATIENCE == 0:
            if least > 0.9 * last_least:
                rtol = max(0.1 * rtol, 1e-13)
            least, last_least = math.inf, least
    return np.full((len(phases), 4), np.nan), evaluations, MOST_PERIODS


def solve(volts_pp: Array, frequency: Array, rtol: float) -> Answers:
    runs = [settle(*point, rtol) for point in zip(volts_pp.tolist(), frequency.tolist())]
    samples = np.stack([states for states, *_ in runs])
    return Answers(measures(samples, frequency), rhs=sum(run[1] for run in runs), periods=sum(run[2] for run in runs))


if __name__ == "__main__":
    sweep(solve, COLUMNS)
