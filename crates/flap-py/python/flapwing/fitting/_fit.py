"""Fits of parameters to readings."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import Any, SupportsIndex

import numpy as np

from .. import _arguments, _flapwing
from .._progress import Progress, shown
from .._types import Array, Design, Mask, Places, Value
from . import _data, _held, _intervals, _parameters, _search
from ._assess import assess, kinds, sigma_known
from ._data import DataSet
from ._model import FINE, Answer, Model
from ._names import Names
from ._result import Fit
from ._search import Found, Target
from ._solution import Effort, Estimate, Unsettled
from ._spread import new_spreads, spreads

#: Largest number of rounds in which standard errors and spreads that depend on the fit are updated.
_ROUNDS = 10


def fit(
    design: Design,
    data: Any,
    /,
    free: Sequence[str] | Mapping[str, Any],
    *,
    sigma: Any = None,
    loss: str = "linear",
    starts: int = 8,
    seed: int = 0,
    hold_out: Any = None,
    profile: bool = True,
    threads: SupportsIndex | None = None,
    progress: Progress = False,
    **keywords: Value,
) -> Fit:
    """Fit parameters of a design to readings, and compute the uncertainty of these parameters.

    `fit` uses nonlinear least squares (`scipy.optimize.least_squares`) from several starting points, with derivatives
    of the settled motions. `fit` requires SciPy.

    Parameters
    ----------
    design : str, path, dict or Grid
        A preset, a device, or a grid without axes.
    data : dict, Table, DataFrame, path of a CSV file, or Readings; or a list of these
        One or several data sets. A data set contains the parameters of operating points and the readings of measures at
        these points (see `Readings`).
    free : list of str, or dict
        The parameters to fit. In a dictionary, the value for a parameter is a pair of bounds ``(low, high)``, a
        `FreeParameter`, or None. Bounds are numbers in SI units or text with units; None stands for the default bounds.
        The default bounds are a third of the design's value and three times the design's value. The page of
        `FreeParameter` describes the default bounds of a parameter whose value in the design is zero.
    sigma : float, str or dict, optional
        The standard error of those readings for which the data have no column of standard errors. `sigma` is a number
        in the measure's unit, text such as ``"1 deg"``, or ``"3 %"`` of the model's value. A dictionary gives one
        standard error for each measure. By default, the standard error is estimated from the residuals.
    loss : {"linear", "soft_l1", "huber", "cauchy", "arctan"}
        The loss function of the readings. All loss functions except ``"linear"`` reduce the weight of outliers. If the
        loss function is not ``"linear"``, standard errors and confidence intervals are computed as for an M-estimator.
        The loss function of priors and spreads is always ``"linear"``.
    starts : int
        Number of searches. The first search starts at the design's values, and the remaining searches start at the best
        points of a Sobol' sequence.
    seed : int
        Seed of the random numbers in the Sobol' sequence of starting points, and in the random choice of held-out
        readings.
    hold_out : float, str, dict, or list of str and dict, optional
        Readings that are predicted instead of fitted: a fraction of all readings, names of data sets, or ranges of
        parameters. The ends of a range such as ``{"drive_frequency": (110, 120)}`` are numbers in SI units, text with
        units, or None. If an end is None, the range has no limit at this end. Operating points with only held-out
        readings are simulated once, after the search, unless the points are on a branch of hysteresis.
    profile : bool
        If True, confidence intervals are computed by the profile likelihood. If False, confidence intervals are
        computed from the derivatives at the estimate, which is faster than the profile likelihood.
    threads : int, optional
        Number of threads, 1 or more. The default of `threads` is one thread per core. The number of threads does not
        change the results.
    progress : bool or function, optional
        If True, `fit` shows the number of computed points. If `progress` is a function, `fit` calls the function with
        two arguments, and each argument is the number of computed points.
    **keywords : float or str
        Parameters that have the same value in all data sets, and solver settings. If a data set has a column of a
        parameter, the column replaces the keyword argument for this data set.

    Returns
    -------
    Fit
        Estimates, standard errors and confidence intervals of the parameters, and the quality of the fit. Print the
        `Fit` to read the report. If the model disagrees with the data, standard errors and intervals include the
        discrepancy of the model (`Fit.discrepancy`).

    Raises
    ------
    ValueError
        Raised if the data have no readings, unknown columns or units, cells that are not numbers, or too few readings.
        Raised if the upper bound of a parameter is not above the lower bound, or if a parameter is unknown.
    TypeError
        Raised if an argument has the wrong type.
    ImportError
        Raised if SciPy is not installed.

    Examples
    --------
    >>> data = {"frequency_hz": [100, 104, 108, 112, 116, 120], "stroke_pp_deg": [69.6, 78.8, 86.1, 90.4, 91.1, 88.3]}
    >>> found = flapwing.fit("ozaki2018-large", data, ["hinge_stiffness"], sigma="1 deg", starts=2)
    >>> found.estimates["hinge_stiffness"].unit
    'N*m/rad'
    """
    check_options(loss, starts, seed)
    begun = time.perf_counter()
    _flapwing.check(design, keywords=dict(keywords))
    names = Names(design)
    sets = _data.resolve(data, names, sigma)
    space = _parameters.space(free, names, sets, keywords)
    measured = _data.all_readings(sets)
    held = _held.held_out_readings(hold_out, sets, seed, len(measured), names)
    with shown(progress) as show:
        model = Model(names, sets, space, keywords, threads, None if show is None else lambda ran: show(ran, ran), held)
        _check_count(model, held)
        guesses = _search.first_guesses(sets)
        target = Target(measured, _search.sigmas(sets, np.full(len(measured), np.nan), guesses), ~held, loss)
        ends = _search.from_all(model, target, _search.starts(model, target, int(starts), seed))
        return finish(model, sets, target, ends, guesses, held, _arguments.flag("profile", profile), seed, begun)


def finish(
    model: Model,
    sets: list[DataSet],
    target: Target,
    ends: Sequence[Found],
    guesses: dict[str, float],
    held: Mask,
    profile: bool,
    seed: int,
    begun: float,
) -> Fit:
    """Return the result of a fit. `ends` contains the points at which the searches ended, with the best point first.
    `begun` is the time in seconds at which the fit began.
    """
    target, found, answer = _settle(model, sets, target, ends[0], guesses)
    readings = int((target.used & np.isfinite(answer.values)).sum()) + len(model.space.prior(found.x)[0])
    if readings <= _search.rank(target.jacobian(model.space, found.x, answer)):
        raise ValueError(_too_few(model, sets, found, answer, held))
    assessment = assess(model, sets, target, found, answer)
    profiles, better = None, None
    if profile:
        profiles, better = _intervals.profiles(
            model, target, found, assessment.plain, assessment.quantile, assessment.factors
        )
        if better is not None:
            # The profile found a lower minimum, which becomes the fit.
            target, found, answer = _settle(model, sets, target, better, guesses)
            assessment = assess(model, sets, target, found, answer)
            profiles, _ = _intervals.profiles(
                model, target, found, assessment.plain, assessment.quantile, assessment.factors
            )
    for measure in assessment.discrepancy.noise:
        if kinds(sets)[measure] == "unknown":
            # The whole of the estimated standard error is discrepancy.
            guesses[measure] = 0.0
    jacobian = assessment.jacobian / assessment.factors
    slopes = model.space.slopes(found.x)
    made = Fit(
        model=model,
        sets=sets,
        x=found.x,
        assessment=assessment,
        information=jacobian.T @ jacobian,
        estimates=_estimates(model, found.x, assessment.covariance, profiles, assessment.quantile),
        spreads=spreads(model.space, target, found.x, answer, assessment.covariance * np.outer(slopes, slopes)),
        sigma_known=sigma_known(sets),
        guesses=guesses,
        combinations=_intervals.combinations(model.space, jacobian),
        indistinct=_intervals.indistinct(model, target, jacobian, seed),
        unsettled=_unsettled(sets, answer, held),
        without_slopes=int((answer.gaps & target.used & np.isfinite(answer.values)).sum()),
        converged=found.converged,
        loss=target.loss,
        held=held,
    )
    if held.any():
        made._predict_held_out(held)
    agreed = 0 if better is not None else sum(one.cost <= ends[0].cost * 1.02 + 0.1 for one in ends)
    made.effort = Effort(len(ends), agreed, model.ran, model.rhs_evals, time.perf_counter() - begun)
    return made


def _settle(
    model: Model, sets: list[DataSet], target: Target, best: Found, guesses: dict[str, float]
) -> tuple[Target, Found, Answer]:
    """Run the last search of a fit. The search is repeated until it hardly changes the standard errors and spreads that
    depend on the fit. Readings without a settled motion are left out.
    """
    found = _search.polish(model, target, best.x)
    for _ in range(_ROUNDS):
        answer = model.at([found.x], rtol=FINE)[0]
        used = target.used & np.isfinite(answer.values)
        parameters = _search.effective_parameters(model.space, target, found.x, answer)
        _search.new_guesses(sets, target, used, answer, parameters, guesses)
        sigma = _search.sigmas(sets, answer.values, guesses)
        after = Target(target.measured, sigma, used, target.loss)
        before, new = model.space.spreads, new_spreads(model.space, after, found.x, answer)
        is_same = bool(np.allclose(sigma, target.sigma, rtol=0.01) and (used == target.used).all())
        if is_same and np.allclose(list(new.values()), list(before.values()), rtol=0.01, atol=0.0):
            break
        target, model.space.spreads = after, new
        found = _search.polish(model, target, found.x)
    return target, found, model.at([found.x], rtol=FINE)[0]


def _estimates(
    model: Model, x: Array, covariance: Array, profiles: list[_intervals.Profile] | None, quantile: float
) -> dict[str, Estimate]:
    estimates = {}
    space = model.space
    for place, one in enumerate(space.coordinates):
        error = float(np.sqrt(covariance[place, place]))
        value = float(one.value(x[place]))
        known = None if profiles is None else profiles[place]
        if known is not None:
            low, high, open_below, open_above = known.low, known.high, known.open_below, known.open_above
        else:
            reach = quantile * error if np.isfinite(error) else np.inf
            below, above = max(x[place] - reach, space.low[place]), min(x[place] + reach, space.high[place])
            ends = [(one.value(below), below == space.low[place]), (one.value(above), above == space.high[place])]
            (low, open_below), (high, open_above) = sorted(ends)
        near = 1e-3 * (space.high[place] - space.low[place])
        at_bound = bool(min(x[place] - space.low[place], space.high[place] - x[place]) < near)
        size = error * abs(one.slope(x[place])) if np.isfinite(error) else np.inf
        estimates[one.label] = Estimate(
            one.parameter,
            one.unit,
            value,
            size,
            float(low),
            float(high),
            bool(open_below),
            bool(open_above),
            known,
            at_bound,
        )
    return estimates


def _unsettled(sets: list[DataSet], answer: Answer, held: Mask) -> list[Unsettled]:
    places = _data.places_of(sets)
    lost = []
    for reading in _lost(answer, held):
        one, measure, row = places[reading]
        lost.append(Unsettled(one.name, measure, row + 1, str(answer.status[reading])))
    return lost


def _lost(answer: Answer, held: Mask) -> Places:
    """Return the indices of fitted readings at whose operating points the motion does not settle."""
    return np.flatnonzero(~np.isfinite(answer.values) & ~held)


def _too_few(model: Model, sets: list[DataSet], found: Found, answer: Answer, held: Mask) -> str:
    """Return the error message for too few readings with a settled motion. If parameters at an operating point are
    invalid, the error message contains the reason.
    """
    lost = _unsettled(sets, answer, held)
    message = "too few readings have a settled motion at the best parameters found: "
    for one, reading in zip(lost, _lost(answer, held)):
        reason = model.reason(int(reading), found.x) if one.status == "invalid" else ""
        if reason:
            count = sum(other.status == "invalid" for other in lost)
            return (
                f"{message}{count} of {len(answer.values)} are invalid, "
                f"first {one.data_set} row {one.row}, because {reason}\n"
                "change these parameters of the design, or give bounds in which they are possible together"
            )
    statuses = ", ".join(sorted({one.status for one in lost}))
    return f"{message}the others are {statuses}\ngive other bounds, or run the design with flapwing.evaluate"


def check_options(loss: Any, starts: Any, seed: Any) -> None:
    """Raise an error if the loss is unknown, if the number of starts or the seed is impossible, or if SciPy is
    missing."""
    try:
        import scipy.optimize  # noqa: F401
    except ImportError:
        raise ImportError("flapwing.fit requires SciPy: pip install scipy") from None
    if loss not in _search.LOSSES:
        raise ValueError(f"`loss` is {loss!r}\nit must be one of {', '.join(_search.LOSSES)}")
    _arguments.count("starts", starts)
    _arguments.count("seed", seed, least=0)


def _check_count(model: Model, held: Mask) -> None:
    """Raise ValueError if the number of readings and priors is not larger than the number of free parameters. A
    separate parameter of a held-out data set does not count as a free parameter, unless the parameter has a prior.
    """
    readings, fitted = int((~held).sum()), [None, *model.outputs.of_set[~held]]
    priors = model.space.prior(np.zeros(len(model.space)))[1]
    has_prior = np.count_nonzero(priors, axis=0)
    free = [one.label for one, known in zip(model.space.coordinates, has_prior) if one.of_set in fitted or known]
    if readings + len(priors) <= len(free):
        counted = f"{readings} reading{'s' * (readings != 1)}" + (f" and {len(priors)} priors" if len(priors) else "")
        parameters = f"{len(free)} free parameter{'s' * (len(free) != 1)}"
        raise ValueError(
            f"{parameters} but only {counted}: {', '.join(free)}\n"
            "a fit requires more readings than parameters: free fewer parameters, add readings, or give priors"
        )
