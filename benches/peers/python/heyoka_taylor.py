"""heyoka: Taylor series of an order that the tolerance asks for, as many points at a time as a register holds.

Magnitudes have kinks, where a Taylor series means nothing: their arguments are events, at which a sign changes.
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

#: Periods after the start, where all magnitudes have a kink, at which integration begins, on the motion's tangent.
TANGENT = 1e-5
#: The time for which an event is ignored after it has been found (s). The time that heyoka would choose by itself is so
#: long that of two crossings of π/2 in short succession it overlooks the second.
COOLDOWN = 1e-9


class Kinks:
    """Magnitudes as a sign, which is a parameter, times what they are of."""

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
    """Compiles the equations; parameters are force, angular frequency and signs."""
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
    """Puts points at the beginning of their motions; the force grows in proportion to time there. Gives the time."""
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
