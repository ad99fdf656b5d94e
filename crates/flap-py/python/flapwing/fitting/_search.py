"""The search for the best parameters: nonlinear least squares, with several searches from different starting points at
the same time.
"""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, TypeVar

import numpy as np

from .._types import Array, Mask
from ._data import DataSet, estimating
from ._model import FINE, Answer, Model
from ._parameters import Space

_Result = TypeVar("_Result")

#: A function that returns the model's predictions for a set of coordinates.
Ask = Callable[[Array], Answer]


class _Ended(Exception):
    """The exception that ends a search, if the thread that computes the model for all searches has ended."""


def together(
    searches: Sequence[Callable[[Ask], _Result]], answer: Callable[[list[Array]], list[Answer]]
) -> list[_Result]:
    """Run several searches at the same time, and return their results. Each search requests the model's predictions for
    one set of coordinates at a time.

    Each search runs in its own thread. The calling thread passes the requests of all running searches to `answer`. If
    Ctrl-C interrupts the calling thread, all searches end.
    """
    inbox: queue.SimpleQueue[tuple[int, str, Any]] = queue.SimpleQueue()
    replies: list[queue.SimpleQueue[Answer | None]] = [queue.SimpleQueue() for _ in searches]

    def work(place: int) -> None:
        def ask(x: Array) -> Answer:
            inbox.put((place, "request", x.copy()))
            reply = replies[place].get()
            if reply is None:
                raise _Ended
            return reply

        try:
            inbox.put((place, "found", searches[place](ask)))
        except _Ended:
            pass
        except BaseException as error:  # raised again by the waiting thread
            inbox.put((place, "failed", error))

    threads = [threading.Thread(target=work, args=(place,), daemon=True) for place in range(len(searches))]
    for thread in threads:
        thread.start()
    found: dict[int, _Result] = {}
    waiting: dict[int, Array] = {}
    try:
        while len(found) < len(searches):
            place, kind, content = inbox.get()
            if kind == "failed":
                raise content
            if kind == "found":
                found[place] = content
            else:
                waiting[place] = content
            if waiting and len(waiting) + len(found) == len(searches):
                places = sorted(waiting)
                answers = answer([waiting[place] for place in places])
                waiting = {}
                for place, one in zip(places, answers):
                    replies[place].put(one)
    finally:
        for reply in replies:
            reply.put(None)
    return [found[place] for place in range(len(searches))]


#: Tolerances of the integration: for the choice of the starting points, and for the first search from each starting
#: point.
LOOK, COARSE = 1e-4, 1e-5

#: Number of points of the Sobol' sequence that are simulated for each search.
_LOOKS = 4

#: Largest number of steps of a search.
_STEPS = 40

#: The largest error of the cost at the end of the last search. An error of this size changes a parameter by at most
#: 0.014 standard errors. The numerical error of the cost has about the same size.
_COST = 1e-4


@dataclass(frozen=True)
class Target:
    """The readings of a fit, with their standard errors and the loss function."""

    measured: Array
    sigma: Array
    #: Mask of the readings that are fitted.
    used: Mask
    loss: str

    def residuals(self, space: Space, x: Array, answer: Answer) -> Array:
        """Return the residuals of the readings, (model - reading) / standard error, followed by the residuals of the
        priors.

        If the motion at a reading does not settle, the model's prediction counts as zero, as for a wing at rest.
        Because a prediction of zero gives a large residual, the search avoids coordinates at which motions do not
        settle.
        """
        values = np.where(np.isfinite(answer.values), answer.values, 0.0)
        residuals = ((values - self.measured) / self.sigma)[self.used]
        return np.concatenate([residuals, space.prior(x)[0]])

    def jacobian(self, space: Space, x: Array, answer: Answer) -> Array:
        """Return the derivatives of the residuals with respect to the coordinates."""
        return np.concatenate([(answer.slopes / self.sigma[:, np.newaxis])[self.used], space.prior(x)[1]])

    def losses(self, squares: Array) -> Array:
        """Return three rows: the loss of each squared residual, and the first and the second derivative of the loss.
        The loss function of priors is ``"linear"``, because priors have normally distributed errors.
        """
        readings = int(self.used.sum())
        pairs = zip(LOSSES[self.loss], LOSSES["linear"])
        return np.array(
            [np.concatenate([loss(squares[:readings]), linear(squares[readings:])]) for loss, linear in pairs]
        )

    def cost(self, residuals: Array) -> float:
        """Return the cost: half of the sum of the losses of all residuals."""
        return float(0.5 * np.sum(self.losses(residuals**2)[0]))


@dataclass(frozen=True)
class Found:
    """The end of a search: coordinates, cost and derivatives of the residuals."""

    x: Array
    #: Half of the sum of the losses of all residuals.
    cost: float
    jacobian: Array
    converged: bool
    steps: int


def minimise(
    ask: Ask,
    space: Space,
    target: Target,
    begin: Array,
    fixed: int | None,
    steps: int = _STEPS,
    tolerance: float = 1e-8,
) -> Found:
    """Search for the coordinates with the lowest cost, beginning at `begin`. The coordinate with the index `fixed` does
    not change.
    """
    from scipy.optimize import least_squares

    moving = np.array([place for place in range(len(space)) if place != fixed], np.intp)
    whole = begin.copy()
    seen: dict[bytes, Answer] = {}

    def answer(part: Array) -> tuple[Array, Answer]:
        x = whole.copy()
        x[moving] = part
        key = x.tobytes()
        if key not in seen:
            seen.clear()
            seen[key] = ask(x)
        return x, seen[key]

    def residuals(part: Array) -> Array:
        return target.residuals(space, *answer(part))

    def jacobian(part: Array) -> Array:
        return target.jacobian(space, *answer(part))[:, moving]

    if not len(moving):
        x, known = answer(whole[moving])
        jacobian_there = target.jacobian(space, x, known)
        return Found(x, target.cost(target.residuals(space, x, known)), jacobian_there, True, 1)
    # The method requires a start inside the bounds. Its first trust region has the size of the start's coordinates, so
    # the coordinates of the method have the value 1 at the start.
    inside = np.clip(begin, space.low + 1e-9, space.high - 1e-9)[moving]
    shift = inside - 1.0
    ended = least_squares(
        lambda y: residuals(y + shift),
        np.ones(len(moving)),
        lambda y: jacobian(y + shift),
        (space.low[moving] - shift, space.high[moving] - shift),
        loss="linear" if target.loss == "linear" else target.losses,
        x_scale="jac",
        ftol=tolerance,
        xtol=1e-5,
        gtol=1e-9,
        max_nfev=steps,
    )
    x, known = answer(ended.x + shift)
    return Found(x, float(ended.cost), target.jacobian(space, x, known), bool(ended.status > 0), int(ended.nfev))


def starts(model: Model, target: Target, count: int, seed: int) -> list[Array]:
    """Return the coordinates at which searches start: the coordinates of the design, and the points of a scrambled
    Sobol' sequence with the lowest costs.
    """
    space = model.space
    own = np.clip(np.zeros(len(space)), space.low, space.high)
    if count == 1:
        return [own]
    looks = [own, *sobol(space, _LOOKS * count, seed)]
    answers = model.at(looks, slopes=False, rtol=LOOK)
    costs = [target.cost(target.residuals(space, x, answer)) for x, answer in zip(looks, answers)]
    best = sorted(range(1, len(looks)), key=lambda place: costs[place])[: count - 1]
    return [own, *(looks[place] for place in best)]


def sobol(space: Space, count: int, seed: int) -> list[Array]:
    """Return sets of coordinates that fill the region within the bounds evenly (Sobol' sequence)."""
    from scipy.stats import qmc

    power = int(np.ceil(np.log2(max(count, 1))))
    drawn = qmc.Sobol(len(space), scramble=True, seed=seed).random_base2(power)[:count]
    return list(space.low + (space.high - space.low) * drawn)


#: The loss functions of `scipy.optimize.least_squares`, and their first and second derivatives: functions of squared
#: residuals.
LOSSES: dict[str, tuple[Callable[[Array], Array], Callable[[Array], Array], Callable[[Array], Array]]] = {
    "linear": (lambda z: z, np.ones_like, np.zeros_like),
    "soft_l1": (lambda z: 2 * (np.sqrt(1 + z) - 1), lambda z: 1 / np.sqrt(1 + z), lambda z: -0.5 * (1 + z) ** -1.5),
    "huber": (
        lambda z: np.where(z <= 1, z, 2 * np.sqrt(z) - 1),
        lambda z: 1 / np.sqrt(np.maximum(z, 1.0)),
        lambda z: np.where(z <= 1, 0.0, -0.5 * np.maximum(z, 1.0) ** -1.5),
    ),
    "cauchy": (np.log1p, lambda z: 1 / (1 + z), lambda z: -1 / (1 + z) ** 2),
    "arctan": (np.arctan, lambda z: 1 / (1 + z**2), lambda z: -2 * z / (1 + z**2) ** 2),
}

#: The variance of the estimates for normally distributed residuals with each loss function, divided by the variance
#: with the linear loss.
NORMAL_VARIANCE = {"linear": 1.0, "soft_l1": 1.079, "huber": 1.107, "cauchy": 1.313, "arctan": 2.055}

#: Smallest curvature of the cost with a robust loss, as a share of the mean weight of the residuals. Far outliers
#: reduce the curvature.
_CURVATURE = 0.1


def robust_factors(residuals: Array, loss: str, freedom: float) -> tuple[float, float]:
    """Return the curvature of the cost and the variance of the estimates, each divided by its value for the linear
    loss.

    The variance is the variance of an M-estimator, E[psi^2] / E[psi']^2 (Huber and Ronchetti 2009, chapter 7). The
    curvature is E[psi']. In the formulas, psi is the derivative of half of the loss with respect to the residual.
    Because the formula underestimates the variance if there are few residuals, the function returns at least the
    variance for normally distributed residuals.
    """
    if loss == "linear":
        return 1.0, 1.0
    squares = residuals**2
    first, second = (function(squares) for function in LOSSES[loss][1:])
    curvature = max(float(np.mean(first + 2 * squares * second)), _CURVATURE * float(np.mean(first)))
    variance = float(np.sum(squares * first**2)) / max(1.0, freedom) / curvature**2
    return curvature, max(variance, NORMAL_VARIANCE[loss])


def m_covariance(covariance: Array, inverse: Array, priors: Array, ratio: float) -> Array:
    """Return the covariance of the coordinates for a robust loss function (M-estimator), with priors.

    `inverse` is the inverse of the curvature of the cost. `covariance` is the covariance of the coordinates if the
    variance of the cost's gradient equals the curvature of the cost. `ratio` is E[psi^2] / E[psi']: the variance of the
    gradient of the readings' cost, divided by the curvature of this cost. For the cost of the priors, the variance of
    the gradient equals the curvature. `priors` contains the derivatives of the residuals of the priors.
    """
    return np.asarray(ratio * covariance - (ratio - 1.0) * inverse @ priors.T @ priors @ inverse)


def from_all(model: Model, target: Target, begins: Sequence[Array]) -> list[Found]:
    """Run a search from each of the coordinates `begins`, and return the ends of the searches with the lowest cost
    first.
    """
    searches = [
        partial(minimise, space=model.space, target=target, begin=begin, fixed=None, steps=25, tolerance=1e-3)
        for begin in begins
    ]
    found = together(searches, lambda xs: model.at(xs, rtol=COARSE))
    return sorted(found, key=lambda one: one.cost)


def polish(model: Model, target: Target, begin: Array, error: float = _COST) -> Found:
    """Search for the coordinates with the lowest cost, beginning at `begin`, with the integration tolerance of the last
    search. `error` is the largest allowed error of the cost.
    """

    def ask(x: Array) -> Answer:
        return model.at([x], slopes=len(x) > 0, rtol=FINE)[0]

    cost = target.cost(target.residuals(model.space, begin, ask(begin)))
    return minimise(ask, model.space, target, begin, None, tolerance=tolerance_of(error, cost))


def tolerance_of(error: float, cost: float) -> float:
    """Return the relative tolerance of the cost for a search with a cost of about `cost` and an allowed absolute error
    of `error`.
    """
    return float(np.clip(error / max(cost, 1e-300), 1e-8, 1e-3))


#: A direction has an effect on the residuals if its singular value is larger than this share of the largest singular
#: value. Derivatives have relative errors of about 1e-4.
RANK_TOLERANCE = 3e-4


def decompose(jacobian: Array) -> tuple[Array, Array, Array, Mask]:
    """Return the lengths of the columns of `jacobian`, and the singular values and right singular vectors of the matrix
    with normalised columns. Each row of the third result is a right singular vector. The fourth result is a mask that
    is True for the vectors with an effect on the residuals.
    """
    lengths = np.linalg.norm(jacobian, axis=0)
    lengths[lengths == 0.0] = 1.0
    _, sizes, directions = np.linalg.svd(jacobian / lengths, full_matrices=True)
    sizes = np.concatenate([sizes, np.zeros(len(directions) - len(sizes))])
    return lengths, sizes, directions, sizes > RANK_TOLERANCE * sizes.max(initial=0.0)


def covariance_of(jacobian: Array) -> tuple[Array, Mask]:
    """Return the covariance of the coordinates, computed from the derivatives of the residuals. The covariance leaves
    out directions without an effect on the residuals. The second result is a mask that is True for coordinates that the
    residuals do not determine.
    """
    lengths, sizes, directions, known = decompose(jacobian)
    scaled = directions[known] / sizes[known, np.newaxis] / lengths
    return scaled.T @ scaled, np.sum(directions[~known] ** 2, axis=0) > 1e-4


def rank(jacobian: Array) -> int:
    """Return the rank of the matrix of the residuals' derivatives: the number of combinations of coordinates that the
    residuals determine.
    """
    return int(decompose(jacobian)[3].sum())


def effective_parameters(space: Space, target: Target, x: Array, answer: Answer) -> float:
    """Return the effective number of parameters that the readings determine: the trace of the hat matrix of the
    readings. A coordinate does not count if only a prior determines the coordinate.
    """
    jacobian = target.jacobian(space, x, answer)
    readings = jacobian[: int(target.used.sum())]
    return float(np.sum(covariance_of(jacobian)[0] * (readings.T @ readings)))


def with_infinite_variances(covariance: Array, lost: Mask) -> Array:
    """Return a copy of `covariance` in which the coordinates in the mask `lost` have infinite variances, and nan as
    covariances with other coordinates.
    """
    found = covariance.copy()
    found[lost, :] = np.nan
    found[:, lost] = np.nan
    found[lost, lost] = np.inf
    return found


def finite_covariance(information: Array) -> Array:
    """Return the covariance of the coordinates: the inverse of the information matrix. A weak prior with a standard
    error of 100 for each coordinate keeps the variances finite, even if the data do not determine a coordinate.
    """
    return np.asarray(np.linalg.inv(information + 1e-4 * np.eye(len(information))))


def first_guesses(sets: list[DataSet]) -> dict[str, float]:
    """Return a first estimate of the standard error of each measure: 3 % of the largest absolute reading of the
    measure.
    """
    largest: dict[str, float] = {}
    for one in sets:
        for measure, values in one.measured.items():
            largest[measure] = max(largest.get(measure, 0.0), float(np.abs(values).max()))
    return {measure: 0.03 * size or 1.0 for measure, size in largest.items()}


def new_guesses(
    sets: list[DataSet], target: Target, used: Mask, answer: Answer, parameters: float, guesses: dict[str, float]
) -> None:
    """Compute the estimates of unknown standard errors in `guesses` again, from the residuals. `parameters` is the
    effective number of parameters that the readings determine (see `effective_parameters`).
    """
    freedom = max(1.0, int(used.sum()) - parameters) / max(1, int(used.sum()))
    for measure in guesses:
        mine = estimating(sets, measure, used)
        residuals = (answer.values - target.measured)[mine]
        if len(residuals):
            robust = 1.4826 * float(np.median(np.abs(residuals)))
            spread = float(np.sqrt(np.mean(residuals**2))) if target.loss == "linear" else robust
            guesses[measure] = max(spread / np.sqrt(freedom), 1e-9 * float(np.abs(target.measured[mine]).max()), 1e-300)


def sigmas(sets: Sequence[DataSet], values: Array, guesses: Mapping[str, float]) -> Array:
    """Return the standard errors of all readings, from the model's predictions `values`. `guesses` contains estimates
    of the unknown standard errors.
    """
    parts, begin = [], 0
    for one in sets:
        for measure, measured in one.measured.items():
            parts.append(one.noise[measure].of(values[begin : begin + len(one)], measured, guesses[measure]))
            begin += len(one)
    return np.concatenate(parts)
