"""SciPy: `solve_ivp` with RK45 and a right-hand side in plain Python, point by point."""

from __future__ import annotations

import math
from typing import Any

import model
import numpy as np
from measures import COLUMNS, measures, times
from scipy.integrate import solve_ivp
from sweep import Answers, Array, sweep

rates = model.equations(math.sin, math.cos, abs)


def rhs(t: float, y: Any, force: float, omega: float) -> tuple[float, float, float, float]:
    return rates(force * math.sin(omega * t), *y)


def motion(force: float, frequency: float, rtol: float, at: Array) -> Any:
    """Return the states at the times `at`."""
    return solve_ivp(
        rhs,
        (0.0, at[-1]),
        [0.0, 0.0, 0.0, 0.0],
        t_eval=at,
        rtol=rtol,
        atol=0.1 * rtol,
        first_step=1e-3 / frequency,
        args=(force, 2.0 * math.pi * frequency),
    )


def solve(force: Array, frequency: Array, rtol: float) -> Answers:
    runs = [motion(*point, rtol, times(point[1])) for point in zip(force.tolist(), frequency.tolist())]
    return Answers(measures(np.stack([run.y.T for run in runs])), rhs=sum(run.nfev for run in runs))


if __name__ == "__main__":
    sweep(solve, COLUMNS)
