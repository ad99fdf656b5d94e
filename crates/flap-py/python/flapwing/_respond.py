"""Responses of designs to a parameter that rises and falls, and the edges of bistable bands."""

from __future__ import annotations

from typing import Any, SupportsIndex

from . import _arguments, _flapwing, _mistakes, _workers
from ._progress import Progress, shown
from ._results import BistableBand, Verdict
from ._table import Table
from ._types import Design, Executor, Value


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

    The first point of each branch (rising or falling parameter) starts at rest. Each later point starts from the
    settled motion of the previous point. If the motions of the rising and of the falling branch differ, the design is
    bistable. A step of the parameter is halved if a bistable band ends within the step. A step is also halved if a
    component of the state changes by more than a tenth of the largest value of the component. If the state changes much
    within a step, the step could contain a narrow bistable band.

    Parameters
    ----------
    design : str, path, dict or Grid
        A preset or a grid (see `Grid`). The grid can have an axis for the parameter that rises and falls. Each
        combination of the values of all other axes is one design with one curve.
    parameter : str, optional
        The parameter that rises and falls. The default of `parameter` is ``"drive_frequency"``.
    start, stop, step : float or str, optional
        First value, last value and step of the parameter that rises and falls: numbers in SI units, or text with units.
        By default, `start`, `stop` and `step` are taken from the axis of `parameter` in the grid.
    tolerance : float or str, optional
        Longest allowed step of the parameter that rises and falls, at the ends of bistable bands and where the response
        is steep. The default of `tolerance` is a sixteenth of the shortest step between the values of the parameter.
    unstable : bool, optional
        If True, the branches are continued around the ends of bistable bands, and the table also has the unstable
        orbits between the branches.
    return_states : bool, optional
        If True, the table also has columns with the state of each motion at the beginning of a drive period. You can
        pass the table as `initial_state` of `evaluate`.
    threads, progress
        The number of threads and the progress report, as for `sweep`. A progress function is called with two numbers:
        the number of finished designs, and the number of all designs.
    client : executor, optional
        An executor, such as a process pool (see `sweep`). Each task of the workers computes the response of one design.
        The argument `client` does not change the rows.
    **keywords : float or str
        Parameters of all designs and solver settings, as for `run`.

    Returns
    -------
    Table
        One row per motion. The columns of the table are `curve` (number of the design), the parameters of the design,
        `branch` (``"up"``, ``"down"`` or ``"unstable"``), the parameter that rises and falls, and `status`. The column
        `bistable` (true if the rising and the falling branch have different motions) and the measures come after
        `status`. `Table.verdicts` has the verdict on each design, and ``meta["parameter"]`` is the name of the
        parameter that rises and falls.

    Raises
    ------
    ValueError
        Raised if a preset, parameter, option or unit is unknown. Raised if the range from `start` to `stop` has no
        steps. Raised if `parameter` is a choice, or varies together with a second parameter. A grid with mistakes
        raises GridError.
    TypeError
        Raised if an argument has the wrong type.

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
        Verdict(verdict["text"], [BistableBand(**band) for band in verdict["bands"]], verdict["curve"])
        for verdict in verdicts
    ]
    return Table._of(native, keywords=keywords)


def edges(
    design: Design,
    first: str = "drive_frequency",
    second: str = "drive_voltage_pp",
    /,
    *,
    edge_start: Value,
    edge_stop: Value,
    edge_step: Value | None = None,
    start: Value | None = None,
    stop: Value | None = None,
    step: Value | None = None,
    tolerance: Value | None = None,
    threads: SupportsIndex | None = None,
    **keywords: Value,
) -> Table:
    """Follow the ends of bistable bands in the plane of two parameters.

    For each design, flap first computes the response to the parameter `first`, in the same way as `respond`. Each end
    of a bistable band in the response is continued through the plane of the parameters `first` and `second`. A cusp is
    a point of the plane at which hysteresis begins, because the two ends of a bistable band meet.

    Parameters
    ----------
    design : str, path, dict or Grid
        A preset or a grid (see `Grid`). If the grid has an axis for the first parameter, each combination of the values
        of all other axes is one design. The value of the second parameter in each design must be between `edge_start`
        and `edge_stop`.
    first, second : str, optional
        The two parameters of the plane. The default of `first` is ``"drive_frequency"``, and the default of `second` is
        ``"drive_voltage_pp"``.
    edge_start, edge_stop : float or str
        Smallest and largest value of the second parameter: numbers in SI units, or text with units.
    edge_step : float or str, optional
        Step of the second parameter. With `edge_step`, the table has only points with a text in the column `mark`, the
        ends of edges, and points at multiples of the step, counted from `edge_start`. Without `edge_step`, the table
        has all computed points.
    start, stop, step : float or str, optional
        First value, last value and step of the first parameter, as for `respond`. By default, `start`, `stop` and
        `step` are taken from the axis of the first parameter in the grid.
    tolerance : float or str, optional
        Longest allowed step of the first parameter at the ends of bistable bands, as for `respond`.
    threads : int, optional
        Number of threads for the responses, 1 or more. The default of `threads` is one thread per core. The number of
        threads does not change the rows.
    **keywords : float or str
        Parameters of all designs and solver settings, as for `run`.

    Returns
    -------
    Table
        One row per point, in order along the edge. The first columns of the table are the parameters of the design,
        `edge` (number of the edge), and `kind` (``"fold"``, ``"period_doubling"`` or ``"torus"``). The last columns of
        the table are `mark`, the two parameters of the plane, `floquet_max`, and the measures. The column `mark` has
        ``"cusp"`` at a cusp, and ``"turn"`` at a local minimum or maximum of the second parameter. ``meta["edges"]``
        has a summary of each edge in one line. A design without hysteresis has no rows. A warning names each end of a
        bistable band at which no edge was found.

    Raises
    ------
    ValueError
        Raised if a preset, parameter, option or unit is unknown. Raised if the range from `start` to `stop` has no
        steps, or the design's value of the second parameter is not between `edge_start` and `edge_stop`. A grid with
        mistakes raises GridError.
    TypeError
        Raised if a value has the wrong type.

    Examples
    --------
    >>> soft = {"hinge_stiffness": "0.7486 uN*m/rad", "drive_voltage_pp": "160 V"}
    >>> edge = flapwing.edges("jafferis2016", edge_start=60, edge_stop=300, start=110, stop=140, step=1, **soft)
    >>> print(edge.meta["edges"][0])
    fold from 300 V, 137.363 Hz to 300 V, 127.432 Hz; hysteresis begins at 80.4053 V, 117.66 Hz (cusp)
    """
    for name, parameter in [("first", first), ("second", second)]:
        if not isinstance(parameter, str):
            raise _mistakes.refused(name, parameter, 'it must be the name of a parameter, such as "drive_frequency"')
    if first in keywords:
        raise ValueError(f"`{first}` is set here and followed: keep one of them")
    native = _flapwing.edges(
        design,
        first,
        second,
        first_range=[start, stop, step],
        second_range=[edge_start, edge_stop, edge_step],
        tolerance=tolerance,
        threads=threads,
        keywords=dict(keywords),
    )
    return Table._of(native, keywords=keywords)
