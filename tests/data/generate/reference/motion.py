"""Motions between switching surfaces, and periodic orbits by Newton shooting.

The equations of motion contain magnitudes and signs, such as |v| v. They are smooth between the surfaces where their
arguments are zero. A `Motion` gets the sides of these surfaces as numbers +1 or -1 and replaces |v| by side * v. The
integration ends at each crossing, which is located on the interpolant of the method, and starts again on the other
side. DOP853 then keeps its order.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]
#: A row of a table, by column, and what is computed for it.
Row = dict[str, str]
Results = dict[str, float]
#: Time, state and sides to the derivative of the state, or to integrands.
Rates = Callable[[float, Any, Sequence[float]], Sequence[float]]
#: Time and state to a number whose sign is the side.
Surface = Callable[[float, Any], float]

RTOL = 1e-11
#: Absolute tolerance as a fraction of a state's typical size and of `rtol`.
ATOL = 1e-2
#: Largest residual of an orbit over one period, as a fraction of each state's typical size.
RESIDUAL = 1e-10


@dataclass(frozen=True)
class Motion:
    """Equations of motion."""

    rates: Rates
    #: Surfaces that `rates` has sides of, in the order of `sides`.
    surfaces: Sequence[Surface]
    #: Typical size of each state.
    scale: Sequence[float]

    def distance(self, one: Array, other: Array) -> float:
        """The largest difference of two states, in units of their typical sizes."""
        return float(np.abs((one - other) / np.asarray(self.scale)).max())


@dataclass
class Run:
    """A motion from `begin` to `end`."""

    y: Array
    #: Integrals of the integrands over the time of the run.
    integrals: Array
    #: Times and states at the crossings of each surface, and at both ends.
    crossings: list[tuple[int, float, Array]] = field(default_factory=list)
    ends: list[Array] = field(default_factory=list)
    #: States at the requested times.
    samples: list[Array] = field(default_factory=list)

    def extremes(self, surface: int, value: Callable[[Array], float]) -> tuple[float, float]:
        """Least and largest value where its derivative, which is `surface`, is zero, and at both ends."""
        values = [value(y) for number, _, y in self.crossings if number == surface] + [value(y) for y in self.ends]
        return min(values), max(values)


def sides_at(motion: Motion, surfaces: Sequence[Surface], t: float, y: Array, step: float) -> list[float]:
    """The sides on which a motion begins. A state on a surface goes to the side where a short step leads."""
    values = [surface(t, y) for surface in surfaces]
    if 0.0 in values:
        guess = [float(np.sign(value)) or 1.0 for value in values]
        first = y + 0.5 * step * np.array(motion.rates(t, y, guess))
        moved = y + step * np.array(motion.rates(t + 0.5 * step, first, guess))
        later = [surface(t + step, moved) for surface in surfaces]
        values = [value or other for value, other in zip(values, later)]
    return [float(np.sign(value)) or 1.0 for value in values]


def run(
    motion: Motion,
    begin: float,
    end: float,
    y: Sequence[float] | Array,
    *,
    rtol: float = RTOL,
    integrands: Rates | None = None,
    watched: Sequence[Surface] = (),
    at: Sequence[float] | Array = (),
) -> Run:
    """Integrates a motion with DOP853.

    `integrands` are integrated beside the states. Their sides are those of the motion's surfaces and then those of
    `watched`, further surfaces where the integration starts again. `at` are times of samples.
    """
    surfaces = [*motion.surfaces, *watched]
    size = len(motion.scale)
    state = np.array(y, dtype=float)
    sides = sides_at(motion, surfaces, begin, state, 1e-7 * (end - begin))
    count = len(integrands(begin, state, sides)) if integrands else 0
    # The integrands follow from the states, so the step size is controlled by the states alone.
    atol = np.concatenate([ATOL * rtol * np.asarray(motion.scale), np.full(count, np.inf)])
    full = np.concatenate([state, np.zeros(count)])
    found = Run(state, np.zeros(count), ends=[state])
    at = np.asarray(at, dtype=float)
    taken = 0
    t, step = begin, 0.0
    while t < end:

        def slope(t: float, z: Array) -> Sequence[float]:
            # Python's own floats are faster than NumPy's.
            values = z.tolist()
            rates = motion.rates(t, values[:size], sides)
            return [*rates, *integrands(t, values[:size], sides)] if integrands else rates

        events = [crossing(surface, side) for surface, side in zip(surfaces, sides)]
        first = min(step, end - t) if step else None
        for _ in range(12):
            part = solve_ivp(
                slope,
                (t, end),
                full,
                "DOP853",
                rtol=rtol,
                atol=atol,
                events=events,
                dense_output=taken < len(at),
                # Integrands can vary faster than states.
                max_step=(end - begin) / 200.0 if integrands else np.inf,
                # Behind a crossing the motion goes on as before.
                first_step=first,
            )
            if not part.success:
                raise ArithmeticError(f"the integration stopped at {part.t[-1]} s: {part.message}")
            if stays(part, surfaces, sides):
                break
            # A motion that turns back at once has crossed again within the first step, and events do not notice that.
            first = float(part.t[1] - part.t[0]) / 10.0
        else:
            raise ArithmeticError(f"the motion grazes a surface at {t} s")
        if len(part.t) > 2:
            step = float(np.median(np.diff(part.t)))
        full, t = part.y[:, -1], float(part.t[-1])
        while taken < len(at) and at[taken] <= t:
            found.samples.append(part.sol(at[taken])[:size])
            taken += 1
        for number, times in enumerate(part.t_events):
            if len(times):
                found.crossings.append((number, t, full[:size]))
                sides[number] = -sides[number]
    found.y, found.integrals = full[:size], full[size:]
    found.ends.append(found.y)
    return found


def crossing(surface: Surface, side: float) -> Any:
    """The event that a motion leaves this side of a surface."""

    def event(t: float, z: Array) -> float:
        return surface(t, z)

    event.terminal, event.direction = True, -side  # type: ignore[attr-defined]
    return event


def stays(part: Any, surfaces: Sequence[Surface], sides: Sequence[float]) -> bool:
    """True if all steps end on the sides with which the part was integrated. The last step of a part ends on a surface."""
    ends = [len(part.t) - (1 if len(times) else 0) for times in part.t_events]
    steps = list(zip(part.t.tolist(), part.y.T.tolist()))
    return all(
        side * surface(t, y) >= 0.0 for surface, side, end in zip(surfaces, sides, ends) for t, y in steps[1:end]
    )


@dataclass(frozen=True)
class Orbit:
    """A periodic motion: its state at time 0, the largest residual and the monodromy matrix in units of `scale`."""

    y: Array
    residual: float
    monodromy: Array

    @property
    def multiplier(self) -> float:
        """The largest modulus of a Floquet multiplier."""
        return float(np.abs(np.linalg.eigvals(self.monodromy)).max())


def unsplit(
    motion: Motion,
    begin: float,
    end: float,
    y: Sequence[float] | Array,
    method: str,
    rtol: float,
    integrands: Rates | None = None,
) -> Run:
    """Integrates a motion without regard to its surfaces: quick at loose tolerances, a second solver at tight ones."""
    size, count = len(motion.scale), 0

    def slope(t: float, z: Array) -> Sequence[float]:
        values = z.tolist()
        sides = [1.0 if surface(t, values) >= 0.0 else -1.0 for surface in motion.surfaces]
        rates = motion.rates(t, values[:size], sides)
        return [*rates, *integrands(t, values[:size], sides)] if integrands else rates

    if integrands:
        count = len(slope(begin, np.array(y, dtype=float))) - size
    atol = np.concatenate([ATOL * rtol * np.asarray(motion.scale), np.full(count, 1e300)])
    part = solve_ivp(slope, (begin, end), np.concatenate([y, np.zeros(count)]), method, rtol=rtol, atol=atol)
    if not part.success:
        raise ArithmeticError(f"the integration stopped at {part.t[-1]} s: {part.message}")
    return Run(part.y[:size, -1], part.y[size:, -1])


def settle(motion: Motion, period: float, y: Sequence[float] | Array, change: float = 3e-2, periods: int = 60) -> Array:
    """The state at the end of the first period that changes no state by more than `change` of its typical size.

    Newton's iteration can begin there.
    """
    for _ in range(periods):
        before, y = y, unsplit(motion, 0.0, period, y, "DOP853", 1e-5).y
        if motion.distance(y, np.asarray(before)) < change:
            break
    return np.asarray(y)


def periodic(motion: Motion, period: float, y: Sequence[float] | Array) -> Orbit:
    """The periodic motion near a state, by Newton's iteration on the map of one period.

    The Jacobian is that of central differences. It is used for four iterations.
    """
    scale = np.asarray(motion.scale)

    def after(z: Array) -> Array:
        return run(motion, 0.0, period, z * scale).y / scale

    def jacobian(z: Array) -> Array:
        step = 1e-5
        columns = [(after(z + step * unit) - after(z - step * unit)) / (2.0 * step) for unit in np.eye(len(z))]
        return np.array(columns).T

    z = np.asarray(y) / scale
    monodromy = jacobian(z)
    best, kept = np.inf, z
    for iteration in range(24):
        change = after(z) - z
        residual = float(np.abs(change).max())
        if residual < best:
            best, kept = residual, z
        elif best < RESIDUAL:
            break
        if residual < 1e-13:
            break
        if iteration % 4 == 3 and residual > RESIDUAL:
            monodromy = jacobian(z)
        z = z - np.linalg.solve(monodromy - np.eye(len(z)), change)
    if best > RESIDUAL:
        raise ArithmeticError(f"Newton's iteration ended with a residual of {best:.1e} of the states' sizes")
    return Orbit(kept * scale, best, jacobian(kept))


def wrapped(degrees: float) -> float:
    """An angle in (-180, 180] degrees."""
    return 180.0 - (180.0 - degrees) % 360.0
