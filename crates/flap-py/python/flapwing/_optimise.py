"""The best design within the axes of a grid."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, SupportsIndex

from . import _flapwing, _mistakes, _workers
from ._progress import Progress, one_step, shown
from ._results import ActiveBound, ConditionValue, LocalOptimum, Optimum, Row
from ._types import Design, Executor, Value


def optimise(
    design: Design,
    /,
    *,
    maximise: str | None = None,
    minimise: str | None = None,
    where: str | Sequence[str] = (),
    starts: SupportsIndex = 8,
    sample: SupportsIndex = 4096,
    threads: SupportsIndex | None = None,
    progress: Progress = False,
    client: Executor | None = None,
    **keywords: Value,
) -> Optimum:
    """Find the best design within the axes of a grid, under conditions on measures and parameters.

    The search first computes the points of the grid. In a second stage, the search improves the best points step by
    step, with the derivatives of the measures. The search can choose any value between the smallest and the largest
    value of an axis. Options, whole numbers, and parameters that change together can have only values that the grid
    lists. Every motion begins at rest, as in a sweep.

    Parameters
    ----------
    design : str, path, dict or Grid
        The grid to search (see `Grid`). The ends of the axes of the grid are the bounds of the search.
    maximise, minimise : str, optional
        The quantity that the search makes as large (`maximise`) or as small (`minimise`) as possible: a measure, or an
        expression of measures and parameters. Give either `maximise` or `minimise`.
    where : str or sequence of str, optional
        Conditions that the design must satisfy: comparisons of measures and parameters with ``<``, ``<=``, ``>`` or
        ``>=``. You can join comparisons with ``and``. A number can have a unit: ``"stroke_pp_deg < 100 deg"``.
        A condition on parameters alone can also contain ``or``, ``not``, ``==`` and ``!=``: ``"device == 'long'"``.
    starts : int, optional
        Largest number of searches. Each search begins at one of the best points of the grid. The default of `starts` is
        8 searches.
    sample : int, optional
        Largest number of grid points to compute. If the grid has more than `sample` points, the search computes only
        `sample` points, which are spread over the grid. The default of `sample` is 4096 points.
    threads : int, optional
        Number of threads, 1 or more. The default of `threads` is one thread per core. The number of threads does not
        change the result.
    progress : bool or function, optional
        If True, a progress bar (tqdm) is shown in consoles and notebooks. A progress function is called with two
        numbers: the number of finished points and searches, and the number of all points and searches. With `client`,
        the progress advances only once, at the end of the whole search.
    client : executor, optional
        An executor, such as a process pool (see `sweep`). The search runs on one of the workers of the executor.
    **keywords : float or str
        Parameters of all designs and solver settings, as for `run`.

    Returns
    -------
    Optimum
        The best design, the bounds and conditions that limit the best design, and all optima that the search found. If
        no design satisfies all conditions, the status is ``"infeasible"``.

    Raises
    ------
    ValueError
        Raised if an expression or a condition has a mistake. Raised if no parameter varies in the grid. Raised if no
        point of the grid has a periodic motion. A grid with mistakes raises GridError.
    TypeError
        Raised if an argument has the wrong type.

    Examples
    --------
    >>> grid = {"preset": "ozaki2018-large", "axes": {"drive_frequency": [90, 100, 110, 120]}}
    >>> best = flapwing.optimise(grid, maximise="lift_mean_mn", where="power_mean_mw < 30 mW")
    >>> best.status
    'optimal'
    >>> round(best.row["power_mean_mw"], 2)
    30.0
    """
    goals = {"maximise": maximise, "minimise": minimise}
    given = {name: goal for name, goal in goals.items() if goal is not None}
    if len(given) != 1:
        raise ValueError("give one of maximise and minimise: a measure or an expression")
    [(name, goal)] = given.items()
    if not isinstance(goal, str):
        raise _mistakes.refused(name, goal, 'it must be a measure or an expression, such as "lift_mean_mn"')
    conditions = [where] if isinstance(where, str) else where
    form = 'it must be a condition or a list of conditions, such as "stroke_pp_deg < 100 deg"'
    if not isinstance(conditions, Sequence) or not all(isinstance(condition, str) for condition in conditions):
        raise _mistakes.refused("where", where, form)
    options: dict[str, Any] = {
        "goal": goal,
        "is_largest": name == "maximise",
        "conditions": list(conditions),
        "starts": starts,
        "sample": sample,
        "threads": threads,
    }
    if client is None:
        with shown(progress) as show:
            found = _flapwing.optimise(design, dict(keywords), progress=show, **options)
    else:
        with one_step(progress):
            found = _workers.call(client, _flapwing.optimise, design, dict(keywords), **options)
    found["row"] = Row(**found["row"])
    found["active"] = [ActiveBound(**bound) for bound in found["active"]]
    found["conditions"] = [ConditionValue(**condition) for condition in found["conditions"]]
    found["optima"] = [LocalOptimum(**optimum) for optimum in found["optima"]]
    return Optimum(goal=goal, **found)
