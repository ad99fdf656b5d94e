"""Profile likelihood: the cost as one parameter is held at values beside its estimate and the others are fitted again."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np

from ._free import Space
from ._model import Answer, Model
from ._search import FINE, Found, Target, minimise
from ._together import Ask, together
from ._types import Array

#: Values that are tried on each side.
_TRIES = 6

#: Values between the estimate and the end of the interval that are added to the ends, as shares of the way.
_BETWEEN = (1.0 / 3.0, 2.0 / 3.0)

#: How near to the wanted height a profile comes.
_NEAR = 0.03


@dataclass(frozen=True)
class Profile:
    """The profile of a parameter."""

    #: Values in SI units, rising.
    value: Array
    #: The signed root of the rise of the cost, in standard errors: 0 at the estimate, about a straight line if it is well known.
    rise: Array
    low: float
    high: float
    #: True where the interval goes on to the end of the range: the data do not bound the parameter there.
    open_below: bool
    open_above: bool

    @property
    def is_flat(self) -> bool:
        """True if the data bound the parameter on neither side, or on one only."""
        return self.open_below or self.open_above


@dataclass(frozen=True)
class _Side:
    """One side of a profile: coordinates, heights and whether the end of the range came first."""

    x: list[float]
    height: list[float]
    end: float
    is_open: bool
    best: Found | None


@dataclass(frozen=True)
class _Walks:
    """The fit from which profiles begin: its target, its estimate, and the height at which they end."""

    space: Space
    target: Target
    found: Found
    covariance: Array
    height: float

    def side(self, ask: Ask, held: int, way: float) -> _Side:
        """The profile to one side, up to the height or to the end of the range."""
        here = self.found.x[held]
        end = self.space.high[held] if way > 0 else self.space.low[held]
        error = np.sqrt(self.covariance[held, held])
        # Others move with it as the derivatives at the estimate say.
        with np.errstate(invalid="ignore", divide="ignore"):
            slope = self.covariance[:, held] / self.covariance[held, held]
        slope = np.where(np.isfinite(slope), slope, 0.0)
        step = self.height * error if np.isfinite(error) and error > 0 else np.inf
        inner, outer = (0.0, 0.0), None
        side = _Side([], [], float(here), False, None)
        best: Found | None = None
        reached, is_open = here, False
        # The cost is to be known to a part of its rise.
        tolerance = float(np.clip(0.02 / max(self.found.cost, 1e-300), 1e-8, 1e-3))
        for _ in range(_TRIES):
            limit = abs(end - here)
            step = min(step, limit)
            x = np.clip(self.found.x + slope * way * step, self.space.low, self.space.high)
            x[held] = here + way * step
            tried = minimise(ask, self.space, self.target, x, held, steps=6, tolerance=tolerance)
            if tried.cost < self.found.cost - 1e-3 and (best is None or tried.cost < best.cost):
                best = tried
            rise = float(np.sqrt(max(0.0, 2.0 * (tried.cost - self.found.cost))))
            side.x.append(float(here + way * step))
            side.height.append(rise)
            if rise < self.height and step >= limit:
                is_open = True
                break
            reached = here + way * step
            if abs(rise - self.height) < _NEAR * self.height:
                reached = here + way * step * self.height / rise
                break
            if rise < self.height:
                inner = (step, rise)
            else:
                outer = (step, rise)
            if outer is None:
                step = step * min(4.0, self.height / max(rise, 0.25 * self.height)) * 1.02
            else:
                share = (self.height - inner[1]) / (outer[1] - inner[1])
                step = inner[0] + np.clip(share, 0.1, 0.9) * (outer[0] - inner[0])
                reached = here + way * (inner[0] + share * (outer[0] - inner[0]))
        if is_open or (outer is None and side.height[-1] < (1 - _NEAR) * self.height):
            # It ends at the end of the range, or hardly rises.
            reached, is_open = end, True
        for share in _BETWEEN:
            self._between(ask, held, share, tried.x, side, tolerance)
        return _Side(side.x, side.height, float(reached), is_open, best)

    def _between(self, ask: Ask, held: int, share: float, far: Array, side: _Side, tolerance: float) -> None:
        """A further value of a profile, on the way to the one that was tried last."""
        x = np.clip(self.found.x + share * (far - self.found.x), self.space.low, self.space.high)
        tried = minimise(ask, self.space, self.target, x, held, steps=6, tolerance=tolerance)
        side.x.append(float(x[held]))
        side.height.append(float(np.sqrt(max(0.0, 2.0 * (tried.cost - self.found.cost)))))


def profiles(
    model: Model, target: Target, found: Found, covariance: Array, height: float
) -> tuple[list[Profile], Found | None]:
    """The profiles of all coordinates up to `height` standard errors; and a better fit, if one came up."""
    space = model.space
    walks = _Walks(space, target, found, covariance, height)
    sides = [partial(walks.side, held=held, way=way) for held in range(len(space)) for way in (-1.0, 1.0)]

    def answer(xs: list[Array]) -> list[Answer]:
        return model.at(xs, rtol=FINE)

    ends = together(sides, answer)
    better = min((side.best for side in ends if side.best is not None), key=lambda one: one.cost, default=None)
    made = []
    for held, coordinate in enumerate(space.coordinates):
        below, above = ends[2 * held], ends[2 * held + 1]
        x = np.array([*below.x, found.x[held], *above.x])
        rise = np.array([*(-np.array(below.height)), 0.0, *above.height])
        order = np.argsort(x)
        values = np.asarray(coordinate.value(x[order]))
        low, high = coordinate.value(below.end), coordinate.value(above.end)
        if values[0] > values[-1]:
            values, rise, order = values[::-1], -rise[order][::-1], np.arange(len(values))
            made.append(Profile(values, rise, high, low, above.is_open, below.is_open))
        else:
            made.append(Profile(values, rise[order], low, high, below.is_open, above.is_open))
    return made, better
