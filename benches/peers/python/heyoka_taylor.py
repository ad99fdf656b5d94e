"""heyoka: Taylor series whose order follows from the tolerance, with one point in each lane of a register.

A magnitude |x| has a kink at x = 0, where a Taylor series is not valid. The zeros of x are events, at which a sign
changes.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import heyoka
import model
import numpy as np
from measures import COLUMNS, measures, times
from sweep import Answers, Array, sweep

#: Time after the start at which the integration begins (drive periods). Before the integration begins, the motion
#: follows a tangent, because all magnitudes have a kink at the start.
TANGENT = 1e-5
#: The time for which an event is ignored after the event was found (s). The default time of heyoka is so long that
#: heyoka misses the second of two crossings of π/2 in short succession.
COOLDOWN = 1e-9


class Kinks:
    """Magnitudes |x| in the form s x, where the sign s is a parameter."""

    def __init__(self, first: int) -> None:
        self.first = first
        self.events: list[Any] = []

    def magnitude(self, of: Any) -> Any:
        sign = self.first + len(self.events)
        self.events.append(heyoka.t_event_batch(of, callback=turned(sign), cooldown=COOLDOWN))
        return heyoka.par[sign] * of


def turned(sign: int) -> Callable[..., bool]:
    def callback(integrator: Any, direction: int, lane: int) -> bool:
        integrator.pars[sign, lane] = direction
        return True

    return callback


def integrator(rtol: float) -> Any:
    """Compile the equations. The parameters are force, angular frequency and signs."""
    states = heyoka.make_vars("x", "v", "psi", "w")
    kinks = Kinks(first=2)
    rates = model.equations(heyoka.sin, heyoka.cos, kinks.magnitude)
    drive = heyoka.par[0] * heyoka.sin(heyoka.par[1] * heyoka.time)
    lanes = heyoka.recommended_simd_size()
    return heyoka.taylor_adaptive_batch(
        list(zip(states, rates(drive, *states))),
        np.zeros((4, lanes)),
        pars=np.ones((2 + len(kinks.events), lanes)),
        tol=rtol,
        t_events=kinks.events,
    )


def begin(system: Any, force: Array, frequency: Array) -> Array:
    """Set the states of all points at the beginning of the integration, and return the time. At the beginning, the
    force grows in proportion to time."""
    system.reset_cooldowns()
    system.pars[:] = 1.0
    system.pars[0] = force
    system.pars[1] = 2.0 * math.pi * frequency
    time = TANGENT / frequency
    system.set_time(time)
    a = force * system.pars[1] * time / model.MASS
    alpha = model.COUPLING * model.TRANSMISSION * a / model.INERTIA
    motion = [a * time**2 / 6.0, a * time / 2.0, alpha * time**2 / 6.0, alpha * time / 2.0]
    system.state[:] = np.array(motion) / np.array(model.SCALE)[:, None]
    return time


def solver() -> Callable[[Array, Array, float], Answers]:
    compiled = {}

    def solve(force: Array, frequency: Array, rtol: float) -> Answers:
        system = compiled.get(rtol)
        if system is None:
            system = compiled[rtol] = integrator(rtol)
        lanes = system.state.shape[1]
        found = []
        for first in range(0, len(force), lanes):
            # Lanes without a point repeat the last.
            points = np.minimum(np.arange(first, first + lanes), len(force) - 1)
            time = begin(system, force[points], frequency[points])
            at = np.stack([times(each) for each in frequency[points]], axis=1)
            states = system.propagate_grid(np.vstack([time, at]))[1]
            found.append(measures(np.ascontiguousarray(states[1:].transpose(2, 0, 1))))
        # Taylor coefficients are not evaluations of a right-hand side.
        return Answers(np.concatenate(found)[: len(force)], rhs=None)

    return solve


if __name__ == "__main__":
    sweep(solver(), COLUMNS)
