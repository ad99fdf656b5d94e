"""CyRK: the integrator RK45, called from a loop that numba compiles."""

from __future__ import annotations

import math
from typing import Any

import model
import numba
import numpy as np
from CyRK import nb_diffeq_addr, nbsolve2_ivp
from measures import COLUMNS, measures, times
from sweep import Answers, Array, sweep

rates = numba.njit(model.equations(math.sin, math.cos, abs))


def rhs(dy: Any, t: float, y: Any, drive: Any) -> None:
    rate, state, constants = numba.carray(dy, (4,)), numba.carray(y, (4,)), numba.carray(drive, (2,))
    force = constants[0] * math.sin(constants[1] * t)
    rate[0], rate[1], rate[2], rate[3] = rates(force, state[0], state[1], state[2], state[3])


address = nb_diffeq_addr(rhs)


@numba.njit
def run(address: int, force: Array, frequency: Array, rtol: float, at: Array, samples: Array) -> bool:
    for point in range(len(force)):
        found = nbsolve2_ivp(
            address,
            (0.0, at[point, -1]),
            np.zeros(4),
            method="RK45",
            t_eval=at[point],
            args=np.array([force[point], 2.0 * math.pi * frequency[point]]),
            rtol=rtol,
            atol=0.1 * rtol,
            first_step=1e-3 / frequency[point],
            max_num_steps=1_000_000,
        )
        ended = found.success
        if ended:
            samples[point] = found.y.T
        found.free()
        if not ended:
            return False
    return True


def solve(force: Array, frequency: Array, rtol: float) -> Answers:
    at = np.stack([times(each) for each in frequency])
    samples = np.empty((*at.shape, 4))
    if not run(address, force, frequency, rtol, at, samples):
        raise SystemExit("CyRK did not reach the end of a run")
    # CyRK counts steps, not evaluations.
    return Answers(measures(samples), rhs=None)


if __name__ == "__main__":
    sweep(solve, COLUMNS)
