"""The scatter of a parameter between data sets, for example between robots of the same design."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .._types import Array
from ._model import Answer
from ._parameters import Group, Space
from ._search import Target

#: The smallest standard deviation in the list of possible standard deviations, as a share of the smallest standard
#: error of a data set's value. At this standard deviation, all data sets have practically the same value.
_LEAST = 0.02

#: Number of standard deviations for which the deviance is computed.
_TRIES = 200

#: Rise of the deviance at the ends of a 95 % interval: the quantile of chi-square for one degree of freedom.
_RISE = 3.84

#: Weight of a weak prior that keeps parameters finite if the data do not determine them: a standard error of 100 for
#: each coordinate.
_WEAK = 0.01


@dataclass(frozen=True)
class Spread:
    """The scatter of a parameter between data sets, which a fit computes for each `FreeParameter` with `spread`.

    Attributes
    ----------
    parameter, unit : str
        The parameter, and the SI unit of the parameter.
    mean, error : float
        The common mean of the values of all robots, and the standard error of the mean, in SI units.
    value : float
        The standard deviation of the values of all robots about the common mean, in SI units.
    low, high : float
        Lower and upper end of the 95 % interval of the standard deviation, in SI units. If the standard deviation was
        given, `low` and `high` equal the given standard deviation.
    is_given : bool
        True if the standard deviation was given, and False if the standard deviation was estimated.
    """

    parameter: str
    unit: str
    mean: float
    error: float
    value: float
    low: float
    high: float
    is_given: bool


def new_spreads(space: Space, target: Target, x: Array, answer: Answer) -> dict[str, float]:
    """Return the standard deviation of each parameter with a spread: the given value, or the most likely value."""
    found = {}
    for group in space.groups:
        if group.given is None:
            tried, deviances = _deviances(space, group, target, x, answer)
            found[group.parameter] = _lowest(tried, deviances)
        else:
            mean = float(np.mean(space.values(x)[group.places]))
            found[group.parameter] = group.given * (abs(mean) if group.is_share else 1.0)
    return found


def spreads(space: Space, target: Target, x: Array, answer: Answer, covariance: Array) -> dict[str, Spread]:
    """Return a `Spread` object for each parameter with a spread. `covariance` is the covariance of the values of the
    free parameters, in SI units.
    """
    made = {}
    for group in space.groups:
        name, count = group.parameter, len(group.places)
        value = low = high = space.spreads[name]
        if group.given is None:
            tried, deviances = _deviances(space, group, target, x, answer)
            near = tried[deviances < deviances.min() + _RISE]
            low, high = float(near[0]), float(near[-1])
            value, low = (0.0 if size == tried[0] else size for size in (value, low))
            high = np.inf if high == tried[-1] else high
        mean = float(np.mean(space.values(x)[group.places]))
        # The mean of the robots in the data differs from the mean of all robots.
        error = np.sqrt(covariance[np.ix_(group.places, group.places)].mean() + space.spreads[name] ** 2 / count)
        unit = space.coordinates[group.places[0]].unit
        made[name] = Spread(name, unit, mean, float(error), value, low, high, group.given is not None)
    return made


def _lowest(tried: Array, deviances: Array) -> float:
    """Return the standard deviation with the lowest deviance: the minimum of a parabola through the lowest deviance in
    the list and its two neighbours.
    """
    best = int(np.argmin(deviances))
    if best in (0, len(tried) - 1):
        return float(tried[best])
    before, here, after = deviances[best - 1 : best + 2]
    return float(tried[best] * (tried[1] / tried[0]) ** (0.5 * (before - after) / (before - 2 * here + after)))


def _deviances(space: Space, group: Group, target: Target, x: Array, answer: Answer) -> tuple[Array, Array]:
    """Return a list of possible standard deviations of a parameter between data sets. Also return the deviance for each
    standard deviation. The deviance is minus two times the log likelihood.

    The likelihood is integrated over all free parameters and over the mean of the values (restricted maximum
    likelihood). The integral approximates the residuals by linear functions of the parameters.
    """
    everything = target.residuals(space, x, answer)
    readings = int(target.used.sum())
    others, slopes_of_others = space.prior(x, leave_out=group.parameter)
    residuals = np.concatenate([everything[:readings], others])
    jacobian = np.concatenate([target.jacobian(space, x, answer)[:readings], slopes_of_others])
    weights = np.sqrt(target.losses(residuals**2)[1])
    weak = _WEAK * np.eye(len(space))
    residuals = np.concatenate([residuals * weights, np.zeros(len(space))])
    jacobian = np.concatenate([jacobian * weights[:, np.newaxis], weak])
    # Only the triangular factor of the readings enters, once for all standard deviations.
    base = _triangle(np.column_stack([jacobian, residuals]))
    contrasts, by_x = space.contrasts(group, x)
    across = np.column_stack([by_x, contrasts])
    lengths = np.linalg.norm(jacobian[:, group.places], axis=0)
    errors = np.abs(space.slopes(x)[group.places]) / lengths
    largest = max(one.high - one.low for one in (space.coordinates[place] for place in group.places))
    tried = np.geomspace(min(_LEAST * errors.min(), 0.01 * largest), largest, _TRIES)
    deviances = []
    for size in tried:
        factor = _triangle(np.concatenate([base, across / size]))
        lowest, pivots = factor[-1, -1] ** 2, np.abs(np.diag(factor)[:-1])
        deviances.append(lowest + 2.0 * np.sum(np.log(pivots)) + 2.0 * len(contrasts) * np.log(size))
    return tried, np.array(deviances)


def _triangle(matrix: Array) -> Array:
    """Return the upper triangular factor of the QR decomposition of a matrix."""
    return np.asarray(np.linalg.qr(matrix, mode="r"))
