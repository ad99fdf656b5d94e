"""Forward selection of free parameters: a search for the parameters that must be fitted to explain the readings."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, SupportsIndex

import numpy as np

from .. import _arguments, _flapwing
from .._progress import Progress, shown
from .._types import Design, Value
from . import _data, _fit, _held, _parameters, _report, _search
from ._candidates import is_number
from ._names import Names
from ._result import Fit
from ._subsets import Effect, Subset, Subsets

#: A step runs a fit only with candidates whose predicted gain is at least this share of the largest gain so far.
_WORTH = 0.5


@dataclass(frozen=True)
class SelectionStep:
    """One step of a selection. The step makes a parameter free or fixes a parameter, and fits all free parameters.

    Attributes
    ----------
    freed : str
        The parameter that becomes free in this step. `freed` is empty for the first step, and for a step that fixes a
        parameter.
    removed : str
        The parameter that becomes fixed at the design's value in this step, because parameters that became free later
        make the fixed parameter unnecessary. `removed` is empty in most steps.
    parameters : list of str
        All free parameters after this step of the selection.
    chi_square : float
        Sum of the squares of (residual / standard error) over all readings and priors. If standard errors are estimated
        from the residuals, chi-square does not show the quality of the fit.
    criterion : float
        The value of the criterion of the selection (AICc or BIC) after this step.
    gain : float
        The decrease of the criterion (AICc or BIC) in this step. For the first step, `gain` is nan.
    p : float
        The probability that noise alone improves the fit as much as the parameter that becomes free in this step. If
        all standard errors are given, `p` is computed by a chi-square test. If a standard error is estimated, `p` is
        computed by an F test that treats all measures as one measure. The F test also counts readings with given
        standard errors, so `p` can be too small if most readings have given standard errors. `p` is nan if no parameter
        becomes free in this step.
    held_out : float
        Root mean square of the prediction errors of all held-out readings. Each prediction error is divided by the
        standard error of its reading. `held_out` is nan if you do not give `hold_out`.
    alternatives : dict of str to float
        The candidate parameters that were fitted in this step but not chosen. A value in `alternatives` is the
        criterion of the fit with the candidate, minus the criterion of the fit with the chosen parameter. If the value
        of a candidate in `alternatives` is below 2, the candidate explains the readings about as well as the chosen
        parameter.
    """

    freed: str
    removed: str
    parameters: list[str]
    chi_square: float
    criterion: float
    gain: float
    p: float
    held_out: float
    alternatives: dict[str, float]


@dataclass(frozen=True)
class Selection:
    """The result of `select`. ``print(selection)`` shows all steps of the selection.

    Attributes
    ----------
    steps : list of SelectionStep
        The steps of the selection. The first step fits the parameters in the argument `start`.
    final : Fit or None
        The final fit of all selected parameters, with several searches and with profile likelihoods. `final` is None if
        no parameter is free.
    remaining : dict of str to float
        The candidate parameters that are not free at the end of the selection. The value of a candidate is the
        predicted decrease of chi-square if this candidate also becomes free. The candidate with the largest decrease is
        first.
    stopped : str
        The reason for the end of the selection.
    at_bounds : list of str
        Parameters whose estimate is at a bound in at least one of the fits. With wider bounds of the parameters in
        `at_bounds`, the fit could be better.
    criterion : str
        The name of the criterion of the selection: ``"AICc"`` or ``"BIC"``.
    fits : int
        Number of fits, without the final fit.
    points, rhs_evals : int
        Number of simulated points, and number of evaluations of the equations of motion, in all fits including the
        final fit.
    seconds : float
        Time of the selection (s).
    """

    steps: list[SelectionStep]
    final: Fit | None
    remaining: dict[str, float]
    stopped: str
    at_bounds: list[str]
    criterion: str
    fits: int
    points: int
    rhs_evals: int
    seconds: float

    @property
    def fit(self) -> Fit:
        """The final fit. Raises ValueError if no parameter is free."""
        if self.final is None:
            raise ValueError("the selection freed no parameter, so there is no fit\ngive `start`, or more candidates")
        return self.final

    @property
    def parameters(self) -> list[str]:
        """The names of the selected parameters. The parameters in the argument `start` are first."""
        return self.steps[-1].parameters

    def __str__(self) -> str:
        with_held = any(np.isfinite(step.held_out) for step in self.steps)
        heads = ["freed", "parameters", "chi-square", self.criterion, "gain", "p"]
        heads += ["held-out rms"] * with_held + ["also fitted"]
        rows = []
        for step in self.steps:
            cells = [
                step.freed or (f"{step.removed} removed" if step.removed else "start"),
                str(len(step.parameters)),
                f"{step.chi_square:.1f}",
                f"{step.criterion:.1f}",
            ]
            numbers = [(step.gain, ".1f"), (step.p, ".1g")]
            cells += [format(number, form) if np.isfinite(number) else "" for number, form in numbers]
            cells += [f"{step.held_out:.2f}"] * with_held
            rows.append([*cells, ", ".join(f"{name} {more:+.1f}" for name, more in step.alternatives.items())])
        effort = f"{self.fits} fits, {self.points:,} points with {self.rhs_evals:.3g} right-hand sides"
        lines = [_report.table(heads, rows), f"stopped: {self.stopped}"]
        if self.at_bounds:
            lines.append(f"at a bound in a fit: {', '.join(self.at_bounds)}; give wider bounds and select again")
        return "\n".join([*lines, f"{effort} in {self.seconds:.1f} s"])


def select(
    design: Design,
    data: Any,
    /,
    candidates: Sequence[str] | Mapping[str, Any],
    *,
    start: Sequence[str] | Mapping[str, Any] = (),
    budget: int | None = None,
    rhs_budget: float | None = None,
    criterion: str = "AICc",
    significance: float = 0.05,
    tries: int = 3,
    sigma: Any = None,
    starts: int = 4,
    seed: int = 0,
    hold_out: Any = None,
    profile: bool = True,
    threads: SupportsIndex | None = None,
    progress: Progress = False,
    **keywords: Value,
) -> Selection:
    """Select the parameters that must be fitted to explain the readings. `select` adds free parameters to the fit, one
    at a time, until the fit does not improve.

    Use `select` to find an effect that is missing in a model. Each step predicts the decrease of chi-square by each
    candidate parameter, from derivatives at the present fit (score test). Each step runs a fit with each of the best
    candidates, and chooses the candidate whose fit has the lowest criterion. The selection ends if no candidate lowers
    the criterion, or if the improvement is not significant. At the end, `select` fits all selected parameters once
    more, with several searches and profile likelihoods, like `fit`.

    Parameters
    ----------
    design : str, path, dict or Grid
        A preset, a device, or a grid without axes.
    data : dict, Table, DataFrame, path of a CSV file, or Readings; or a list of these
        The readings, in the same forms as for `flapwing.fit`.
    candidates : list of str, or dict
        The parameters that can become free, with bounds in the same forms as for `flapwing.fit`. `flapwing.candidates`
        returns a suitable dictionary. A candidate that is not free has its value in the design.
    start : list of str, or dict
        The parameters that are free from the first step, with bounds in the same forms as for `flapwing.fit`.
    budget : int, optional
        Largest number of free parameters, including the parameters in `start`. The default of `budget` is a fifth of
        the number of fitted readings, but at least one more than the number of parameters in `start`.
    rhs_budget : float, optional
        Limit for the number of evaluations of the equations of motion. If a step exceeds the limit, no new step begins,
        but `select` still runs the final fit.
    criterion : {"AICc", "BIC"}
        The information criterion that each step of the selection must lower.
    significance : float
        Limit of the probability that noise alone explains the improvement by a step. If the probability is above
        `significance`, the selection ends. The probability accounts for the choice of the best among all candidate
        parameters (Bonferroni correction). With ``significance=1``, only the criterion ends the selection, and
        therefore too many parameters become free.
    tries : int
        Largest number of candidate parameters for which a step runs a fit. Candidates with the same predicted effect on
        the readings count as one candidate.
    sigma, seed, hold_out, threads, progress
        These arguments have the same meaning as for `flapwing.fit`. The selection does not use the readings in
        `hold_out`.
    starts : int
        Number of searches of the final fit, in addition to the search from the parameter values at the end of the
        selection.
    profile : bool
        True if the final fit computes profile likelihoods.
    **keywords : float or str
        Parameters that have the same value in all data sets, and solver settings, as for `flapwing.fit`.

    Returns
    -------
    Selection
        The steps of the selection, the final fit, and the predicted effects of the candidate parameters that are not
        free.

    Raises
    ------
    ValueError
        Raised if an argument is invalid, as for `flapwing.fit`. Raised if `criterion` is unknown. Raised if a candidate
        has a `spread`, or no value in the design. Raised if `budget` is below the number of parameters in `start`.
    TypeError
        Raised if an argument has the wrong type.
    ImportError
        Raised if SciPy is not installed.

    Examples
    --------
    >>> points = {"drive_frequency": [100.0, 105.0, 110.0, 115.0, 120.0, 125.0], "drive_voltage_pp": 160.0}
    >>> table = flapwing.evaluate("jafferis2016", points, hinge_stiffness=1.3e-6)
    >>> data = {name: table[name] for name in ("drive_frequency", "drive_voltage_pp", "stroke_pp_deg")}
    >>> found = flapwing.select("jafferis2016", data, ["hinge_stiffness", "wing_area"], sigma="1 deg", starts=1)
    >>> found.parameters
    ['hinge_stiffness']
    """
    _fit.check_options("linear", starts, seed)
    _check(criterion, significance, tries, budget)
    begun = time.perf_counter()
    _flapwing.check(design, keywords=dict(keywords))
    names = Names(design)
    sets = _data.resolve(data, names, sigma)
    first = _parameters.listed("start", start, names)
    wanted = _parameters.listed("candidates", candidates, names)
    more = [name for name in wanted if name not in first]
    if not more:
        raise ValueError("`candidates` has no parameter that is not in `start`\ngive at least one")
    space = _parameters.space({**wanted, **first}, names, sets, keywords)
    if space.groups:
        raise ValueError(
            f"`{space.groups[0].parameter}` has a `spread`, which a selection cannot have\n"
            "select with per_set=True, then fit the selected parameters with the spread"
        )
    _check_values(names, more)
    readings = sum(len(one) * len(one.measured) for one in sets)
    held = _held.held_out_readings(hold_out, sets, seed, readings, names)
    most = max(len(first) + 1, int((~held).sum()) // 5) if budget is None else int(budget)
    if most < len(first):
        raise ValueError(f"`budget` is {budget}, but `start` has {len(first)} parameters\nraise the budget")
    coordinates = {name: [one for one in space.coordinates if one.parameter == name] for name in space.parameters}
    with shown(progress) as show:
        show_points = None if show is None else lambda ran: show(ran, ran)
        work = Subsets(names, sets, coordinates, keywords, held, criterion, threads, show_points)
        free = work.space(list(first))
        begin = np.clip(np.zeros(len(free)), free.low, free.high)
        unknown = np.full(readings, np.nan)
        state = work.fitted(list(first), begin, _search.first_guesses(sets), unknown)
        steps = [_step_of("", state, np.nan, np.nan, work, {})]
        while True:
            predicted = work.predicted(state, more) if more else {}
            if len(state.names) >= most or not more:
                stopped = f"the budget of {most} parameters is used" if more else "all candidates are free"
                break
            if rhs_budget is not None and work.rhs_evals >= rhs_budget:
                stopped = f"the budget of {rhs_budget:.3g} right-hand sides is used"
                break
            best, others = _best(work, state, predicted, tries)
            p = _chance(state, best, len(more))
            name = best.names[-1]
            if best.criterion >= state.criterion:
                stopped = f"no candidate lowers the {criterion}"
                break
            if p > significance:
                stopped = (
                    f"{name} lowers the {criterion} by {state.criterion - best.criterion:.1f}, "
                    f"but noise alone does so with probability {p:.2g}"
                )
                break
            differences = {one.names[-1]: one.criterion - best.criterion for one in others}
            steps.append(_step_of(name, best, state.criterion - best.criterion, p, work, differences))
            state, more = best, [one for one in more if one != name]
            for earlier in state.names[len(first) : -1]:
                without = work.without(state, earlier)
                if without is not None and without.criterion < state.criterion:
                    gain = state.criterion - without.criterion
                    steps.append(_step_of("", without, gain, np.nan, work, {}, removed=earlier))
                    state, more = without, [*more, earlier]
        found = _final(work, state, int(starts), seed, _arguments.flag("profile", profile))
    return Selection(
        steps,
        found,
        {name: one.gain for name, one in predicted.items()},
        stopped,
        list(work.at_bounds),
        criterion,
        work.fits,
        work.points,
        work.rhs_evals,
        time.perf_counter() - begun,
    )


def _best(work: Subsets, state: Subset, predicted: Mapping[str, Effect], tries: int) -> tuple[Subset, list[Subset]]:
    """Return the best fit with one more free parameter, and a list of the other fits that were computed to find the
    best fit.
    """
    fitted: list[Subset] = []
    distinct: list[Effect] = []
    reached = 0.0
    for name, effect in predicted.items():
        if fitted and effect.gain < _WORTH * reached:
            break
        if not any(effect.is_like(other) for other in distinct):
            if len(distinct) == tries:
                break
            distinct.append(effect)
        names = [*state.names, name]
        one = work.fitted(names, effect.begin, state.guesses, state.answer.values)
        if one.criteria.deviance > state.criteria.deviance:
            # The predicted step was too long.
            nearby = np.concatenate([state.x, work.at_design(name)])
            again = work.fitted(names, nearby, state.guesses, state.answer.values)
            one = min(one, again, key=lambda other: other.criteria.deviance)
        fitted.append(one)
        reached = max(reached, state.criteria.deviance - one.criteria.deviance)
    fitted.sort(key=lambda one: one.criterion)
    return fitted[0], fitted[1:]


def _chance(state: Subset, best: Subset, count: int) -> float:
    """Return the probability that noise alone improves the fit as much as the best of `count` candidate parameters."""
    from scipy.stats import chi2, f

    more, less = best.criteria, state.criteria
    freedom, fall = more.parameters - less.parameters, max(0.0, less.deviance - more.deviance)
    if freedom < 1:
        return 1.0
    if more.estimated:
        # The F test, exact for one measure. Several measures count as one.
        readings = int(np.isfinite(more.log).sum())
        left = max(1, readings - more.parameters + more.estimated)
        return float(min(1.0, count * f.sf(left / freedom * np.expm1(fall / readings), freedom, left)))
    return float(min(1.0, count * chi2.sf(fall, freedom)))


def _step_of(
    freed: str, state: Subset, gain: float, p: float, work: Subsets, alternatives: dict[str, float], removed: str = ""
) -> SelectionStep:
    return SelectionStep(
        freed,
        removed,
        list(state.names),
        state.criteria.chi_square,
        state.criterion,
        gain,
        p,
        work.held_out(state),
        alternatives,
    )


def _final(work: Subsets, state: Subset, starts: int, seed: int, profile: bool) -> Fit | None:
    """Return the fit of the selected parameters. One search starts at the parameter values of `state`, and `starts`
    searches start at other values.
    """
    if not state.names:
        return None
    begun = time.perf_counter()
    model = work.model(work.space(state.names))
    guesses = dict(state.guesses)
    target = replace(state.target, used=~work.held)
    begins = [state.x, *_search.starts(model, target, starts, seed)]
    ends = _search.from_all(model, target, begins)
    return _fit.finish(model, work.sets, target, ends, guesses, work.held, profile, seed, begun)


def _check_values(names: Names, more: Sequence[str]) -> None:
    for name in more:
        value = names.nominal.get(name)
        if not is_number(value) or not np.isfinite(value):
            raise ValueError(
                f"`{name}` has no value in the design, so it has no value before it is freed\nset it in the design"
            )


def _check(criterion: Any, significance: Any, tries: Any, budget: Any) -> None:
    if criterion not in ("AICc", "BIC"):
        raise ValueError(f'`criterion` is {criterion!r}\nit must be "AICc" or "BIC"')
    if not is_number(significance) or not 0 < significance <= 1:
        raise ValueError(f"`significance` is {significance!r}\nit must be more than 0 and at most 1")
    _arguments.count("tries", tries)
    _arguments.count("budget", 1 if budget is None else budget)
