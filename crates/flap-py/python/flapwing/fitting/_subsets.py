"""Fits in which only a subset of the parameters is free, for the selection of free parameters."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, SupportsIndex

import numpy as np

from .._types import Array, Mask
from . import _search
from ._criteria import Criteria, criteria
from ._data import DataSet, all_readings
from ._model import FINE, Answer, Model
from ._names import Names
from ._parameters import Coordinate, Space
from ._search import Target

#: Largest error of the cost of a fit, and largest number of rounds in which standard errors are updated.
_COST, _ROUNDS = 0.005, 4

#: A fit without a parameter is computed only if the predicted rise of chi-square is at most this number.
_NEEDED = 10.0

#: Two effects are similar if the sum of squares of their difference is below this share of the sum of squares of an
#: effect.
_ALIKE = 0.01


@dataclass(frozen=True)
class Subset:
    """A fit in which only the parameters `names` are free."""

    names: list[str]
    x: Array
    target: Target
    answer: Answer
    guesses: dict[str, float]
    criteria: Criteria
    #: The criterion of the selection: AICc or BIC.
    criterion: float


@dataclass(frozen=True)
class Effect:
    """The predicted effect on a fit if one more parameter becomes free."""

    #: The decrease of chi-square.
    gain: float
    #: The coordinates at which a fit with the parameter begins.
    begin: Array
    #: The predicted changes of the residuals, in standard errors.
    change: Array

    def is_like(self, other: Effect) -> bool:
        """Return True if the effect `other` changes the residuals in almost the same way as this effect."""
        return bool(np.sum((self.change - other.change) ** 2) < min(1.0, _ALIKE * float(other.change @ other.change)))


@dataclass
class Subsets:
    """The data of a selection, with methods that compute fits in which a subset of the parameters is free."""

    names: Names
    sets: list[DataSet]
    #: The coordinates of each parameter.
    coordinates: dict[str, list[Coordinate]]
    keywords: Mapping[str, Any]
    held: Mask
    criterion: str
    threads: SupportsIndex | None
    #: The function that reports the number of points that were run.
    show_points: Callable[[int], object] | None
    fits: int = 0
    at_bounds: dict[str, None] = field(default_factory=dict)
    models: list[Model] = field(default_factory=list)

    @property
    def rhs_evals(self) -> int:
        return sum(model.rhs_evals for model in self.models)

    @property
    def points(self) -> int:
        return sum(model.ran for model in self.models)

    def space(self, names: Sequence[str]) -> Space:
        return Space([one for name in names for one in self.coordinates[name]])

    def model(self, space: Space) -> Model:
        before = self.points
        show = self.show_points
        show_points = None if show is None else lambda ran: show(before + ran)
        made = Model(self.names, self.sets, space, self.keywords, self.threads, show_points)
        self.models.append(made)
        return made

    def fitted(self, names: list[str], begin: Array, guesses: Mapping[str, float], values: Array) -> Subset:
        """Return the fit of the parameters `names`, computed by a search from the coordinates `begin`. At the beginning
        of the search, relative standard errors are computed from the model's predictions `values`.
        """
        space = self.space(names)
        model = self.model(space)
        known = dict(guesses)
        target = Target(all_readings(self.sets), _search.sigmas(self.sets, values, known), ~self.held, "linear")
        self.fits += 1
        x, answer, target = self._searched(model, target, begin, known)
        self._note_bounds(space, x)
        found = criteria(self.sets, space, x, answer, ~self.held)
        return Subset(names, x, target, answer, known, found, found.aicc if self.criterion == "AICc" else found.bic)

    def _searched(
        self, model: Model, target: Target, begin: Array, guesses: dict[str, float]
    ) -> tuple[Array, Answer, Target]:
        """Return the coordinates at the end of a search from `begin`, the model's predictions at these coordinates, and
        a `Target` with the final standard errors.
        """
        x = _search.from_all(model, target, [begin])[0].x if len(begin) else begin
        for _ in range(_ROUNDS):
            x = _search.polish(model, target, x, _COST).x
            answer = model.at([x], slopes=len(x) > 0, rtol=FINE)[0]
            used = target.used & np.isfinite(answer.values)
            parameters = _search.effective_parameters(model.space, target, x, answer)
            _search.new_guesses(self.sets, target, used, answer, parameters, guesses)
            before = target.sigma
            target = replace(target, sigma=_search.sigmas(self.sets, answer.values, guesses))
            if np.allclose(target.sigma, before, rtol=0.01):
                break
        return x, answer, target

    def _note_bounds(self, space: Space, x: Array) -> None:
        """Add the parameters whose estimate is at a bound to `at_bounds`. A bound does not count if it equals the
        design's value. If the design's value is outside of the bounds, the bound nearest to the design's value does not
        count.
        """
        for one, place, low, high in zip(space.coordinates, x, space.low, space.high):
            nominal = np.clip(float(self.names.nominal.get(one.parameter) or 0.0), one.low, one.high)
            for bound in (low, high):
                is_design = abs(one.value(bound) - nominal) < 1e-6 * (one.high - one.low)
                if abs(place - bound) < 1e-3 * (high - low) and not is_design:
                    self.at_bounds[one.parameter] = None

    def held_out(self, state: Subset) -> float:
        """Return the root mean square of the prediction errors of all held-out readings. Each prediction error is
        divided by the standard error of its reading. Return nan if no reading is held out.
        """
        if not self.held.any():
            return float("nan")
        error = (np.nan_to_num(state.answer.values) - state.target.measured) / state.criteria.sigma
        return float(np.sqrt(np.mean(error[self.held] ** 2)))

    def predicted(self, state: Subset, more: Sequence[str]) -> dict[str, Effect]:
        """Return the predicted effect of each parameter in `more` if this parameter becomes free, with the largest
        effect first.

        The prediction is a Gauss-Newton step of the free parameters and one candidate parameter, within the bounds of
        the candidate. One evaluation of the model gives the derivatives for all candidates. In the evaluation for the
        derivatives, the candidates have their values in the design.
        """
        active = self.space(state.names)
        beside = [(name, self._linear(one)) for name in more for one in self.coordinates[name]]
        space = Space([*active.coordinates, *(one for _, one in beside)])
        x = np.concatenate([state.x, np.zeros(len(beside))])
        answer = self.model(space).at([x], rtol=FINE)[0]
        # Motions that do not settle have no derivatives.
        target = replace(state.target, used=~self.held & np.isfinite(answer.values))
        residuals, jacobian = target.residuals(space, x, answer), target.jacobian(space, x, answer)
        free = jacobian[:, : len(active)]
        found = {}
        for name in more:
            place = [len(active) + number for number, (owner, _) in enumerate(beside) if owner == name]
            found[name] = self._step(name, state.x, residuals, free, jacobian[:, place], space, place)
        return dict(sorted(found.items(), key=lambda one: -one[1].gain))

    def without(self, state: Subset, name: str) -> Subset | None:
        """Return the fit in which the parameter `name` is not free. Return None if, according to the derivatives,
        chi-square would rise too much without the parameter.
        """
        space = self.space(state.names)
        mine = np.array([one.parameter == name for one in space.coordinates])
        covariance = _search.with_infinite_variances(
            *_search.covariance_of(state.target.jacobian(space, state.x, state.answer))
        )
        errors = np.sqrt(np.diag(covariance)[mine])
        if np.sum(((state.x[mine] - self.at_design(name)) / errors) ** 2) > _NEEDED:
            return None
        names = [other for other in state.names if other != name]
        return self.fitted(names, state.x[~mine], state.guesses, state.answer.values)

    def at_design(self, name: str) -> Array:
        """Return the coordinates at which a parameter has its value in the design. If the design's value is outside of
        the bounds, return the coordinates of the nearest bound.
        """
        value = float(self.names.nominal[name])
        return np.array([one.at(float(np.clip(value, one.low, one.high))) for one in self.coordinates[name]])

    def _linear(self, one: Coordinate) -> Coordinate:
        """Return a linear coordinate, without a prior, for the parameter of the coordinate `one`. If the coordinate is
        0, the parameter has its value in the design.
        """
        value = float(self.names.nominal[one.parameter])
        return replace(one, nominal=value, log=False, prior=None)

    def _step(
        self, name: str, x: Array, residuals: Array, free: Array, added: Array, space: Space, place: list[int]
    ) -> Effect:
        """Return the predicted effect if one candidate parameter becomes free."""
        own = self.coordinates[name]
        left = np.linalg.pinv(free, rcond=_search.RANK_TOLERANCE) if free.shape[1] else np.zeros((0, len(residuals)))
        # The part of the derivatives and of the residuals that the free parameters cannot change.
        across, rest = added - free @ (left @ added), residuals - free @ (left @ residuals)
        known = np.linalg.norm(across, axis=0) > _search.RANK_TOLERANCE * np.linalg.norm(added, axis=0)
        across[:, ~known] = 0.0
        step = np.linalg.lstsq(across, -rest, rcond=None)[0]
        linear = Space([space.coordinates[number] for number in place])
        step = np.clip(step, np.minimum(linear.low, 0.0), np.maximum(linear.high, 0.0))
        change = across @ step
        gain = float(rest @ rest - np.sum((rest + change) ** 2))
        moved = x - left @ (residuals + added @ step)
        active = Space(space.coordinates[: len(x)])
        added_begin = [one.at(float(value)) for one, value in zip(own, linear.values(step))]
        begin = np.concatenate([np.clip(moved, active.low, active.high), added_begin])
        return Effect(max(0.0, gain), begin, change)
