"""Confidence intervals of parameters by the profile likelihood, and combinations of parameters that the data determine
well, badly or not at all.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np

from .._types import Array, Places
from ._model import FINE, Answer, Model
from ._parameters import Coordinate, Space
from ._search import RANK_TOLERANCE, Ask, Found, Target, decompose, minimise, sobol, together, tolerance_of

#: Largest number of points of a profile that are computed to find its end, on each side of the estimate.
_TRIES = 6

#: Positions of the points of a profile between the estimate and its end, as shares of the distance.
_BETWEEN = (1.0 / 3.0, 2.0 / 3.0)

#: Largest relative difference between the required height of a profile and the height at its end. The height is the
#: square root of twice the increase of the cost, in standard errors.
_NEAR = 0.03


@dataclass(frozen=True, eq=False)
class Profile:
    """The profile likelihood of a parameter.

    Attributes
    ----------
    value : array
        Values of the parameter in SI units, in rising order.
    rise : array
        The signed square root of the increase of chi-square at each value, in standard errors of the parameter. If
        `loss` is not ``"linear"``, `rise` is computed from the sum of the losses instead of chi-square. The standard
        errors in `rise` include the discrepancy of the model and the variance of a robust loss. `rise` is 0 at the
        estimate. If the data determine the parameter well, `rise` is nearly a linear function of the parameter.
    low, high : float
        Lower and upper end of the parameter's 95 % interval, in SI units.
    open_below, open_above : bool
        True if the interval extends to the lower or upper bound of the parameter. If the interval extends to a bound,
        the data give no limit for the parameter on the side of the bound.
    """

    value: Array
    rise: Array
    low: float
    high: float
    open_below: bool
    open_above: bool

    @property
    def is_flat(self) -> bool:
        """True if the data give no lower limit or no upper limit for the parameter."""
        return self.open_below or self.open_above


@dataclass(frozen=True)
class _Side:
    """One half of a profile likelihood: the part below or above the estimate."""

    #: The values of the fixed coordinate, and the heights of the profile at these values.
    x: list[float]
    height: list[float]
    #: The coordinate at which the profile has the required height, or the bound of the coordinate.
    end: float
    #: True if the profile reached the bound of the parameter before the required height.
    is_open: bool
    #: The best of the fits along the profile that are better than the estimate; None if no fit is better.
    best: Found | None


@dataclass(frozen=True)
class _ProfileSearch:
    """A finished fit whose profile likelihoods are computed: readings, estimate, and `covariance`, the inverse of the
    curvature of the cost. A profile ends where its height is `quantile` standard errors, which include the discrepancy
    of the model and the variance of a robust loss.
    """

    space: Space
    target: Target
    found: Found
    covariance: Array
    quantile: float
    factors: Array

    def side(self, ask: Ask, fixed: int, way: float) -> _Side:
        """Return the half of a profile below or above the estimate, up to the required height or to the bound of the
        parameter.
        """
        height = self.quantile * float(self.factors[fixed])
        here = self.found.x[fixed]
        end = self.space.high[fixed] if way > 0 else self.space.low[fixed]
        error = np.sqrt(self.covariance[fixed, fixed])
        # The other coordinates change with it, as predicted by the derivatives at the estimate.
        with np.errstate(invalid="ignore", divide="ignore"):
            slope = self.covariance[:, fixed] / self.covariance[fixed, fixed]
        slope = np.where(np.isfinite(slope), slope, 0.0)
        step = height * error if np.isfinite(error) and error > 0 else np.inf
        inner, outer = (0.0, 0.0), None
        values: list[float] = []
        heights: list[float] = []
        best: Found | None = None
        reached, is_open = here, False
        for _ in range(_TRIES):
            limit = abs(end - here)
            step = min(step, limit)
            x = np.clip(self.found.x + slope * way * step, self.space.low, self.space.high)
            x[fixed] = here + way * step
            tried, rise = self._minimum(ask, x, fixed)
            if tried.cost < self.found.cost - 1e-3 and (best is None or tried.cost < best.cost):
                best = tried
            values.append(float(x[fixed]))
            heights.append(rise)
            if rise < height and step >= limit:
                is_open = True
                break
            reached = here + way * step
            if abs(rise - height) < _NEAR * height:
                reached = here + way * step * height / rise
                break
            if rise < height:
                inner = (step, rise)
            else:
                outer = (step, rise)
            if outer is None:
                step = step * min(4.0, height / max(rise, 0.25 * height)) * 1.02
            else:
                share = (height - inner[1]) / (outer[1] - inner[1])
                step = inner[0] + np.clip(share, 0.1, 0.9) * (outer[0] - inner[0])
                reached = here + way * (inner[0] + share * (outer[0] - inner[0]))
        if is_open or (outer is None and heights[-1] < (1 - _NEAR) * height):
            # The profile reaches the end of the range, or hardly rises.
            reached, is_open = end, True
        for share in _BETWEEN:
            x = np.clip(self.found.x + share * (tried.x - self.found.x), self.space.low, self.space.high)
            values.append(float(x[fixed]))
            heights.append(self._minimum(ask, x, fixed)[1])
        return _Side(values, heights, float(reached), is_open, best)

    def _minimum(self, ask: Ask, begin: Array, fixed: int) -> tuple[Found, float]:
        """Return the minimum of the cost near `begin` at a fixed value of one coordinate, and the height of the profile
        at this value.
        """
        # The cost must be known to a fraction of its rise.
        tolerance = tolerance_of(0.02, self.found.cost)
        ended = minimise(ask, self.space, self.target, begin, fixed, steps=6, tolerance=tolerance)
        return ended, float(np.sqrt(max(0.0, 2.0 * (ended.cost - self.found.cost))))


def profiles(
    model: Model, target: Target, found: Found, covariance: Array, quantile: float, factors: Array
) -> tuple[list[Profile], Found | None]:
    """Return the profile likelihoods of all free parameters, up to a height of `quantile` standard errors. If the
    computation of a profile finds a better fit than the estimate, also return the better fit. `factors` contains the
    standard error of each coordinate, divided by the standard error that follows from the curvature of the cost.
    """
    space = model.space
    search = _ProfileSearch(space, target, found, covariance, quantile, factors)
    sides = [partial(search.side, fixed=fixed, way=way) for fixed in range(len(space)) for way in (-1.0, 1.0)]

    def answer(xs: list[Array]) -> list[Answer]:
        return model.at(xs, rtol=FINE)

    ends = together(sides, answer)
    better = min((side.best for side in ends if side.best is not None), key=lambda one: one.cost, default=None)
    made = []
    for fixed, coordinate in enumerate(space.coordinates):
        below, above = ends[2 * fixed], ends[2 * fixed + 1]
        x = np.array([*below.x, found.x[fixed], *above.x])
        rise = np.array([*(-np.array(below.height)), 0.0, *above.height]) / factors[fixed]
        order = np.argsort(x)
        values = np.asarray(coordinate.value(x[order]))
        low, high = coordinate.value(below.end), coordinate.value(above.end)
        if values[0] > values[-1]:
            # The parameter falls along the coordinate, so the sides are exchanged.
            made.append(Profile(values[::-1], -rise[order][::-1], high, low, above.is_open, below.is_open))
        else:
            made.append(Profile(values, rise[order], low, high, below.is_open, above.is_open))
    return made, better


#: Number of random sets of parameters that `indistinct` simulates, and number of the sets whose derivatives it uses.
_SETS_TRIED, _SETS_USED = 6, 4

#: The tolerance of the integration for the random sets of parameters.
_RTOL = 1e-7

#: A parameter has no effect if its whole range changes the residuals by less than this number of standard errors.
_EFFECT = 1e-2

#: Smallest change of a parameter that the text for a combined change contains, as a share of the largest change.
_SHARE = 0.05


def indistinct(model: Model, target: Target, at_estimate: Array, seed: int) -> list[str]:
    """Return a sentence for each combined change of parameters that, at all values of the parameters, changes no
    predicted reading. `at_estimate` contains the derivatives of the residuals at the estimate.

    The derivatives of the readings are computed at several random sets of parameters. If the derivatives have a null
    space at each set, the measured quantities at the operating points of the data cannot determine all parameters. If
    only a product of parameters affects the readings, all sets of parameters have the same null space in the logarithms
    of the parameters. If only a sum of parameters affects the readings, all sets of parameters have the same null space
    in the parameters themselves. To find a null space that all sets of parameters have in common, the derivatives at
    all sets are stacked in one matrix.
    """
    space = model.space
    # A change that affects no reading at any values of the parameters affects none at the estimate.
    if not _idle(space, at_estimate)[0] and not len(_null_space(at_estimate)):
        return []
    tried = sobol(space, _SETS_TRIED, seed)
    answers = model.at(tried, rtol=_RTOL)
    # Motions that do not settle have no derivatives, so the sets with most readings are used.
    used = sorted(range(len(tried)), key=lambda place: -np.isfinite(answers[place].values).sum())[:_SETS_USED]
    jacobians = [target.jacobian(space, tried[place], answers[place]) for place in used]
    idle, active = _idle(space, np.concatenate(jacobians))
    sentences = [f"{label} changes no reading" for label in idle]
    jacobians = [jacobian[:, active] for jacobian in jacobians]
    if not len(active):
        return sentences
    dimension = min(len(_null_space(jacobian)) for jacobian in jacobians)
    slopes = [space.slopes(tried[place])[active] for place in used]
    scales = np.array([one.slope(0.0) for one in space.coordinates])[active]
    linear = [jacobian / slope * scales for jacobian, slope in zip(jacobians, slopes)]
    for matrix, where in (
        (np.concatenate(jacobians), ""),
        (np.concatenate(linear), " of their values in the design"),
        (jacobians[0], " about where they are"),
    ):
        null_space = _null_space(matrix)
        if dimension and len(null_space) >= dimension:
            for direction in _sparse(null_space):
                whole = np.zeros(len(space))
                whole[active] = direction
                sentences.append(f"{_in_words(space, whole)}{where} changes no reading")
            break
    return sentences


def _idle(space: Space, jacobian: Array) -> tuple[list[str], Places]:
    """Return the labels of the parameters that affect no reading, and the indices of the parameters that affect a
    reading.
    """
    is_idle = np.linalg.norm(jacobian, axis=0) * (space.high - space.low) < _EFFECT
    return [label for label, none in zip(space.labels, is_idle) if none], np.flatnonzero(~is_idle)


def _null_space(jacobian: Array) -> Array:
    """Return the directions in the space of the coordinates along which no reading changes."""
    lengths, _, directions, known = decompose(jacobian)
    return np.asarray(directions[~known] / lengths)


def _sparse(directions: Array) -> list[Array]:
    """Return linear combinations of the given directions, such that few parameters change along each combination. The
    combinations are found by Gaussian elimination.
    """
    rows = [row / np.abs(row).max() for row in directions]
    for place in range(len(rows)):
        pivot = int(np.argmax(np.abs(rows[place])))
        rows[place] = rows[place] / rows[place][pivot]
        for other in range(len(rows)):
            if other != place:
                rows[other] = rows[other] - rows[other][pivot] * rows[place]
    return [row / np.abs(row).max() for row in rows if np.abs(row).max() > 0]


def _in_words(space: Space, direction: Array) -> str:
    """Return a text that describes a combined change of parameters, scaled such that the largest change is 1 %."""
    largest = int(np.argmax(np.abs(direction)))
    scaled = direction / direction[largest]
    named = []
    for place in np.argsort(-np.abs(scaled), kind="stable"):
        if abs(scaled[place]) < _SHARE:
            continue
        way = "up" if scaled[place] > 0 else "down"
        one = space.coordinates[place]
        size = _size(one, 0.01 * abs(float(scaled[place])))
        named.append(f"{one.label} {way} by {size}")
    return " with ".join([named[0], ", ".join(named[1:])]) if len(named) > 1 else named[0]


def combinations(space: Space, jacobian: Array) -> list[str]:
    """Return texts that describe the combination of parameters that the data determine best, and the combination that
    the data determine worst. A text contains the standard error of the combination, converted to a change of the first
    parameter in the combination.
    """
    if len(space) < 2:
        return []
    _, sizes, directions = np.linalg.svd(jacobian, full_matrices=False)
    lines = []
    for label, place in (("best known", 0), ("worst known", -1)):
        direction = directions[place]
        if sizes[place] <= RANK_TOLERANCE * sizes[0]:
            error = "not determined"
        else:
            largest = int(np.argmax(np.abs(direction)))
            error = f"known to {_size(space.coordinates[largest], abs(direction[largest]) / sizes[place])}"
        lines.append(f"{label}: {_in_words(space, direction)}, {error}")
    return lines


def _size(one: Coordinate, change: float) -> str:
    """Return the change of a parameter as text, in per cent or with the unit, if its coordinate changes by `change`."""
    if not one.log:
        return f"{change * one.width:.2g} {one.unit}".rstrip()
    return f"{100 * change:.2g} %" if change < 1 else f"{100 * change:.0f} %"
