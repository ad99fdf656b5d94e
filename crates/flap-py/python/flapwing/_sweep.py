"""Sweeps on this machine and on a cluster, and files with results."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping, Sequence
from typing import Any, SupportsIndex

from . import _arguments, _flapwing, _mistakes, _workers
from ._flapwing import Grid
from ._progress import Progress, shown
from ._table import Table
from ._types import Design, Executor, Measures, Value


def sweep(
    design: Design,
    /,
    *,
    out: str | os.PathLike[str] | None = None,
    restart: bool = False,
    threads: SupportsIndex | None = None,
    progress: Progress = False,
    client: Executor | None = None,
    points_per_task: SupportsIndex | None = None,
    measures: Measures | None = None,
    **keywords: Value,
) -> Table:
    """Simulate every point of a grid and return the rows.

    Parameters
    ----------
    design : str, path, dict or Grid
        The grid whose points are computed (see `Grid`). A preset counts as a grid with one point. The table
        ``[output]`` of the grid chooses the columns, but the entry `path` of ``[output]`` is not used.
    out : path, optional
        File for the rows: ``.csv``, ``.csv.zst`` or ``.parquet``. The sweep writes each row to the file `out` as soon
        as possible. For the same grid, the command ``flap sweep --out`` writes a file with the same bytes as the
        function `sweep`. The sidecar, which is a file in the folder of `out`, records the origin of the rows. If `out`
        has unfinished results of the grid, the sweep continues after the last row in `out`. If `out` already has all
        rows, no point is computed. If `out` has anything except results of the grid, the sweep raises an error. By
        default, rows are kept in memory, with about half a kilobyte for each row.
    restart : bool, optional
        If True, the sweep computes all rows again, and replaces the results in `out` when the new results are complete.
    threads : int, optional
        Number of threads, 1 or more. With `client`, `threads` is the number of threads of each task. The default of
        `threads` is one thread per core, or with `client` one thread per task. The number of threads does not change
        the rows.
    progress : bool or function, optional
        If True, a progress bar (tqdm) is shown in consoles and notebooks. A progress function is called with two
        numbers: the number of finished points, and the number of all points.
    client : executor, optional
        Compute the points on the workers of an executor: any object whose ``submit(function, *arguments)`` returns a
        future with the method `result`. For example, `client` can be an executor of `concurrent.futures`, submitit or
        mpi4py, or the client of a Dask cluster. The workers must have the same build of flapwing. The argument `client`
        changes neither the order nor the bytes of the rows. If a worker of a Dask cluster dies, other workers compute
        the points of the lost worker again. If the executor is not a Dask cluster, a lost worker raises an error. A
        worker whose processor rounds numbers differently from this machine's processor also raises an error, because
        the last bits of the rows could differ. The points that ``[refine]`` adds to a grid are computed in the process
        that calls `sweep`.
    points_per_task : int, optional
        Number of points in a task of `client`, 1 or more. The default of `points_per_task` is at most 2,048 points for
        each thread of a task. A task of the default size takes a few seconds. If each task is a job of a queue, set a
        number that is larger than the default.
    measures : list of str, optional
        The measures that the rows contain. By default, the rows contain the columns of the grid's ``[output]``.
    **keywords : float or str
        Parameters of all points and solver settings, as for `run`. Keywords have the same effect as entries of
        ``[params]`` and ``[solver]`` in the grid. The results record keywords as entries of ``[params]`` and
        ``[solver]``.

    Returns
    -------
    Table
        One row per point in the order of the grid, without points that ``[where]`` excludes. The columns are `point`,
        the varied and derived parameters in SI units, `status`, the measures, `cycles`, `residual`, `period`,
        `floquet_max`, `stable`, `error_estimate`, and `rhs_evals`. The entry ``columns`` of ``[output]`` chooses among
        the columns after `status`. A point without a periodic motion has a row with a status and without measures. If
        `out` is given, the table reads the file when a column is used for the first time. If another sweep replaces the
        rows in the file before the table has read the file, ValueError is raised.

    Raises
    ------
    GridError
        Raised if the grid has mistakes. The error message lists each mistake with the line of the mistake, the allowed
        values and the most similar known name. GridError is a ValueError.
    FileExistsError
        Raised if `restart` is not given, and `out` has complete rows of a different grid or is not a result file.
    OSError
        Raised if a file cannot be read or written.
    ValueError
        Raised if `out` cannot be continued, because the unfinished rows in `out` belong to a different grid or were
        changed. Raised if a preset, parameter, option, unit or measure is unknown. Raised if a keyword is a parameter
        that the grid varies or derives.
    TypeError
        Raised if an argument has the wrong type.
    KeyboardInterrupt
        Raised if Ctrl-C was pressed. After Ctrl-C, the rows in `out` are kept, and the same call of `sweep` continues
        the sweep.

    Examples
    --------
    >>> rows = flapwing.sweep({
    ...     "preset": "ozaki2018-large",
    ...     "axes": {"drive_voltage_pp": [60.0, 80.0], "drive_frequency": {"from": 100, "to": 110, "step": 5}},
    ... }, rtol=1e-5)
    >>> len(rows), rows.counts
    (6, {'periodic': 6})
    """
    chosen = _arguments.measures(measures)
    if chosen == []:
        raise ValueError('`measures` is empty\nleave it out for all measures, or give names such as ["lift_mean_mn"]')
    checked = _with_keywords(design, keywords, chosen)
    given: dict[str, Any] = {
        "out": out,
        "restart": _arguments.flag("restart", restart),
    }
    with shown(progress) as show:
        if client is None:
            native = _flapwing.sweep(checked, threads=threads, progress=show, **given)
        else:
            with _workers.grid_chunks(checked, _arguments.executor(client), threads, points_per_task) as chunks:
                native = _flapwing.sweep(checked, progress=show, chunks=chunks.next, **given)
    return Table._of(native, None if out is None else os.path.abspath(out), keywords)


def _with_keywords(design: Design, keywords: Mapping[str, Value], measures: Sequence[str] | None) -> Grid:
    """Return the grid of a design with the parameters and solver settings in `keywords`. Rows of the grid have only the
    measures in `measures`.
    """
    grid = design if isinstance(design, Grid) else Grid(design)
    if not keywords and measures is None:
        return grid
    return _flapwing.with_keywords(grid, dict(keywords), measures=None if measures is None else list(measures))


def read(path: str | os.PathLike[str], /, *, ignore_damage: bool = False) -> Table:
    """Read results of flap and compare the results with the checksums that flap stored.

    Parameters
    ----------
    path : path
        Results of a sweep or a response (``.csv``, ``.csv.zst``, ``.parquet``), or a CSV table of a command such as
        ``flap run --trajectory``. You can also read Parquet tables that are not from flap (Zstandard, Snappy or no
        compression). Units, meanings and axes are read from the sidecar of the results, or from the metadata of flap's
        Parquet files. Without a sidecar or metadata, units are taken from the names of the columns. If results are
        unfinished, flap reads the rows up to the last checkpoint and gives a warning.
    ignore_damage : bool, optional
        If True, damaged results raise a warning instead of an error, and only readable rows are returned. By default,
        damaged results raise an error.

    Returns
    -------
    Table
        The rows of the file. Numbers are equal, to the last bit, to the numbers that were written. ``meta["verified"]``
        is True if the checksums agree with the rows. ``meta["verified"]`` is False for unfinished or damaged results,
        and for results without checksums. For a finished sweep with a sidecar, ``meta["invalid"]`` has the first few
        invalid points, each with the reason why the point is invalid.

    Raises
    ------
    OSError
        Raised if the file cannot be read.
    ValueError
        Raised if the file is not a table of results, or the file is damaged. For a damaged file, the error message
        gives the place of the damage.
    """
    if not isinstance(path, (str, os.PathLike)):
        raise _mistakes.refused("path", path, "it must be the path of a file of results")
    damaged = _arguments.flag("ignore_damage", ignore_damage)
    native = _flapwing.read(os.fspath(path), ignore_damage=damaged)
    for text in native["warnings"]:
        warnings.warn(text, stacklevel=_mistakes.callers_level())
    table = Table._of(native)
    table.meta["verified"] = native["verified"]
    return table
