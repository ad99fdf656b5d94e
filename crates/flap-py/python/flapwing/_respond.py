"""Responses of designs to a parameter that rises and falls."""

from __future__ import annotations

from typing import Any, SupportsIndex

from . import _arguments, _flapwing, _mistakes, _workers
from ._progress import Progress, shown
from ._results import BistableBand, Verdict
from ._table import Table
from ._types import Design, Executor, Value

__all__ = ["respond"]


def respond(
    design: Design,
    parameter: str = "drive_frequency",
    /,
    *,
    start: Value | None = None,
    stop: Value | None = None,
    step: Value | None = None,
    tolerance: Value | None = None,
    unstable: bool = False,
    return_states: bool = False,
    threads: SupportsIndex | None = None,
    progress: Progress = False,
    client: Executor | None = None,
    **keywords: Value,
) -> Table:
    """Follow the motions of designs while a parameter rises and falls, and find hysteresis.

    The first point of each branch starts at rest. All later points start from the settled motion of the point before.
    If the branches up and down settle to different motions, the design is bistable. A step is halved if a bistable band
    ends in this step. A step in which the motion changes by more than a tenth is also halved, because such a step may
    hide a narrow band.

    Parameters
    ----------
    design : str, path, dict or Grid
        A preset or a grid (see `Grid`). The axis of the followed parameter is left out. Each remaining point of the
        grid is a design with its own curve.
    parameter : str, optional
        The parameter that rises and falls. Default ``"drive_frequency"``.
    start, stop, step : float or str, optional
        First value, last value and step of the followed parameter: numbers in SI units, or text with units. Default:
        the values of the axis in the grid.
    tolerance : float or str, optional
        Longest step at the ends of bistable bands and where the response is steep. Default: a sixteenth of the shortest
        step.
    unstable : bool, optional
        If True, the branches are continued around the ends of bistable bands. The table then also has the unstable
        orbits between the branches.
    return_states : bool, optional
        Add columns of the state of each motion at the beginning of a drive period, for `initial_state` of `evaluate`.
    threads : int, optional
        Number of threads, 1 or more; with `client`, for each task. Default: one per core; with `client`, 1. The number
        of threads does not change the rows.
    progress : bool or function, optional
        Show a bar (with tqdm, in consoles and notebooks), or call a function with the numbers of designs done and of
        designs in all.
    client : executor, optional
        Follow the designs on the workers of an executor, as for `sweep`; a task is one design. Rows are the same.
    **keywords : float or str
        Parameters of all designs and solver settings, as for `run`.

    Returns
    -------
    Table
        One row per motion. The columns are `curve` (number of the design), its parameters, `branch` (``"up"``,
        ``"down"`` or ``"unstable"``), the followed parameter, and `status`. Then follow `bistable` (true if the
        branches up and down have different motions) and the other columns of a sweep. `Table.verdicts` has the verdict
        on each design, and ``meta["parameter"]`` is the name of the followed parameter.

    Raises
    ------
    ValueError
        A preset, parameter, option or unit is unknown; there are no steps; the followed parameter is a choice, or
        varies together with other parameters. A grid with mistakes raises GridError.
    TypeError
        An argument has the wrong type.

    Examples
    --------
    >>> curve = flapwing.respond("ozaki2018-large", start=100, stop=120, step=5)
    >>> print(curve.verdicts[0])
    no hysteresis from 100 to 120 Hz wider than 1.25 Hz
    (0.3125 Hz where the motion changes by a tenth; branches agree to 1.6e-6 deg)
    >>> curve.verdicts[0].bands
    []
    """
    if not isinstance(parameter, str):
        raise _mistakes.refused("parameter", parameter, 'it must be the name of a parameter, such as "drive_frequency"')
    if parameter in keywords:
        raise ValueError(f"`{parameter}` is set here and followed: keep one of them")
    options: dict[str, Any] = {
        "start": start,
        "stop": stop,
        "step": step,
        "tolerance": tolerance,
        "unstable": _arguments.flag("unstable", unstable),
        "return_states": _arguments.flag("return_states", return_states),
        "keywords": dict(keywords),
    }
    with shown(progress) as show:
        if client is None:
            native = _flapwing.respond(design, parameter, threads=threads, progress=show, **options)
        else:
            native = _workers.responses(_arguments.executor(client), design, parameter, options, threads, show)
    verdicts = native["meta"]["verdicts"]
    native["meta"]["verdicts"] = [
        Verdict(verdict["text"], [BistableBand(**band) for band in verdict["bands"]]) for verdict in verdicts
    ]
    return Table._of(native, keywords=keywords)
