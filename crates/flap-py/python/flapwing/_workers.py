"""Functions that run simulations on the workers of an executor, such as a process pool or a Dask cluster."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Generator, Iterable, Mapping
from concurrent.futures import BrokenExecutor
from contextlib import closing
from typing import Any, SupportsIndex

import numpy as np

from . import _arguments, _flapwing
from ._columns import Column
from ._flapwing import Grid
from ._types import Executor

#: Number of points of a task for each thread, which take a few seconds. If a worker is lost, little work is lost.
#: Sending rows takes a small share of the time.
_TASK_POINTS = 2048
#: Number of running and waiting tasks per worker, so that no worker is idle and the memory is limited.
_TASKS_PER_WORKER = 4
#: Number of workers of an executor that does not report the number, such as submitit's, and of a cluster whose workers
#: have not started.
_UNKNOWN_WORKERS = 16


def call(client: Executor | None, function: Callable[..., Any], design: Any, *arguments: Any, **keywords: Any) -> Any:
    """Call a function of the compiled module for a design, and return the result. If `client` is given, one of its
    workers calls the function."""
    if client is None:
        return function(design, *arguments, **keywords)
    keywords = {name: _absolute(value) if name in ("waveform", "stroke") else value for name, value in keywords.items()}
    task = (function.__name__, _portable(design), arguments, keywords)
    with closing(_results(_arguments.executor(client), _call_task, [task])) as results:
        identity, result = next(results)
    _check_identity(_flapwing.identity(), identity)
    return result


def _call_task(
    name: str, design: Any, arguments: tuple[Any, ...], keywords: dict[str, Any]
) -> tuple[dict[str, str], Any]:
    """Call the function `name` of the compiled module in a worker. Return the identity of the worker's process and the
    result of the function."""
    keywords = {key: _aligned(value) if isinstance(value, dict) else value for key, value in keywords.items()}
    return _flapwing.identity(), getattr(_flapwing, name)(design, *arguments, **keywords)


def _aligned(columns: Mapping[str, Any]) -> dict[str, Any]:
    """Return columns whose arrays are aligned in memory, as the compiled module requires. An array that Dask has
    transferred can begin at any byte.
    """
    return {
        name: np.require(values, requirements=["C", "A"]) if isinstance(values, np.ndarray) else values
        for name, values in columns.items()
    }


def _absolute(record: Any) -> Any:
    """Return a waveform or a motion in a form that workers can read: the path of a file becomes an absolute path."""
    return os.path.abspath(record) if isinstance(record, str) else record


def _portable(design: Any) -> Any:
    """Return a design in a form that workers can read. The name of a preset or model is unchanged, and the paths of a
    grid become absolute paths.
    """
    if isinstance(design, str) and design in _flapwing.presets():
        return design
    try:
        grid = Grid(design)
    except ValueError as mistake:
        try:
            _flapwing.states(design)  # accepts a model
        except ValueError:
            raise mistake from None
        return design
    return Grid._named(os.path.abspath(grid.name), grid.text)


def _check_identity(ours: Mapping[str, Any], theirs: Mapping[str, Any]) -> None:
    """Raise RuntimeError if rows of a worker could differ in the last bits from rows of the present process."""
    for name in ("build", "arithmetic"):
        if ours[name] != theirs[name]:
            raise RuntimeError(
                f"a worker's {name} of flapwing is {theirs[name]}, but here it is {ours[name]}\n"
                "install the same build everywhere, on processors with the same arithmetic"
            )


class Chunks:
    """Rows that workers compute. Each task computes a range of points, and the rows are in the order of the points."""

    def __init__(
        self,
        client: Executor,
        task: Callable[..., bytes],
        arguments: Callable[[int, int], tuple[Any, ...]],
        points: int,
        size: int,
    ) -> None:
        self._client = client
        self._task = task
        #: Returns the arguments of the task for the points from the first number up to, but not including, the second.
        self._arguments = arguments
        self._points = points
        self._size = size
        self._results: Generator[bytes, None, None] | None = None

    def __enter__(self) -> Chunks:
        return self

    def __exit__(self, *_: object) -> None:
        # The results of the submitted tasks are not needed.
        if self._results is not None:
            self._results.close()

    def next(self, done: int) -> bytes | None:
        """Return the rows of the next task. The first task begins after the first `done` points, which are already
        computed."""
        if self._results is None:
            begins = range(done, self._points, self._size)
            tasks = (self._arguments(begin, min(self._points, begin + self._size)) for begin in begins)
            self._results = _results(self._client, self._task, tasks)
        return next(self._results, None)


def grid_chunks(
    grid: Grid, client: Executor, threads: SupportsIndex | None, points_per_task: SupportsIndex | None
) -> Chunks:
    """Return an object that supplies the rows of a grid. Workers compute the rows."""
    # Workers resolve the files of the grid to the same absolute paths as this process.
    name, text = os.path.abspath(grid.name), grid.text
    threads = 1 if threads is None else threads

    def arguments(begin: int, end: int) -> tuple[Any, ...]:
        return name, text, begin, end, threads

    return Chunks(client, _grid_task, arguments, len(grid), _task_size(client, len(grid), threads, points_per_task))


def _grid_task(name: str, text: str, begin: int, end: int, threads: SupportsIndex) -> bytes:
    """Compute a range of the points of a grid in a worker, and return the rows as bytes."""
    return _flapwing.part(Grid._named(name, text), begin, end, threads=threads)


def batch_chunks(
    batch: Grid,
    design: Any,
    options: dict[str, Any],
    columns: dict[str, Any],
    client: Executor,
    threads: SupportsIndex | None,
    points_per_task: SupportsIndex | None,
) -> Chunks:
    """Return an object that supplies the rows of the points in `columns`. Workers compute the rows. Each task contains
    all points of some rows of `columns`."""
    rows = len(next(iter(columns.values())))
    per_row = max(1, len(batch) // max(1, rows))
    design, states = _portable(design), options["initial_state"]
    threads = 1 if threads is None else threads
    size = max(1, _task_size(client, len(batch), threads, points_per_task) // per_row) * per_row

    def arguments(begin: int, end: int) -> tuple[Any, ...]:
        part = options if states is None else {**options, "initial_state": states[begin:end]}
        given = {name: values[begin // per_row : end // per_row] for name, values in columns.items()}
        return design, part, given, begin, threads

    return Chunks(client, _batch_task, arguments, len(batch), size)


def _batch_task(
    design: Any, options: dict[str, Any], columns: dict[str, Any], first: int, threads: SupportsIndex
) -> bytes:
    """Compute some of the points of `evaluate` in a worker, and return the rows as bytes. The points are given as
    columns of parameters, and `first` is the index of the first point among all points of the call.
    """
    batch = _flapwing.batch(design, _aligned(columns), **_aligned(options))
    return _flapwing.part(batch, 0, len(batch), first=first, threads=threads)


def _task_size(client: Executor, points: int, threads: SupportsIndex, points_per_task: SupportsIndex | None) -> int:
    """Return the number of points in a task. By default, tasks are small enough that every worker gets points, even if
    the number of points is small.
    """
    if points_per_task is not None:
        return _arguments.count("points_per_task", points_per_task)
    most = _TASK_POINTS * _arguments.count("threads", threads)
    return max(1, min(most, -(-points // (_TASKS_PER_WORKER * _number_of_workers(client)))))


def _columns(parts: list[dict[str, Any]]) -> dict[str, Column]:
    """Return the columns of one table that contains the rows of all responses."""
    return {name: _column([Column(*part["columns"][name]) for part in parts]) for name in parts[0]["columns"]}


def _column(parts: list[Column]) -> Column:
    """Join the columns with the same name in all responses to one column. The responses can have different lists of
    words for a column of text."""
    cells = [one.cells for one in parts]
    if parts[0].words is None:
        return parts[0]._replace(cells=np.concatenate(cells))
    listed = [one.words or [] for one in parts]
    words = list(dict.fromkeys(word for some in listed for word in some))
    places = [np.array([words.index(word) for word in some], dtype=np.uint32) for some in listed]
    cells = [place_of[one] if len(place_of) else one for place_of, one in zip(places, cells)]
    return parts[0]._replace(cells=np.concatenate(cells), words=words)


def _respond_task(
    design: Any, parameter: str, options: dict[str, Any], curve: int, threads: SupportsIndex | None
) -> dict[str, Any]:
    """Compute the response of one design in a worker, and return the curve."""
    return _flapwing.respond(design, parameter, threads=threads, curves=[curve], **options)


def responses(
    client: Executor,
    design: Any,
    parameter: str,
    options: dict[str, Any],
    threads: SupportsIndex | None,
    show: Callable[[int, int], object] | None,
) -> dict[str, Any]:
    """Return the responses of all designs of a grid. Each task of the workers computes one response."""
    # This call reports mistakes. It returns no rows.
    empty = _flapwing.respond(design, parameter, threads=threads, curves=[], **options)
    designs = empty["designs"]
    design = _portable(design)
    threads_per_task = 1 if threads is None else threads
    tasks = ((design, parameter, options, curve, threads_per_task) for curve in range(designs))
    parts = [empty]
    with closing(_results(client, _respond_task, tasks)) as results:
        for done, part in enumerate(results, 1):
            _check_identity(empty["meta"], part["meta"])
            parts.append(part)
            if show is not None:
                show(done, designs)
    verdicts = [verdict for part in parts for verdict in part["meta"]["verdicts"]]
    return {"columns": _columns(parts), "meta": {**empty["meta"], "verdicts": verdicts}}


def _results(
    client: Executor, function: Callable[..., Any], tasks: Iterable[tuple[Any, ...]]
) -> Generator[Any, None, None]:
    """Yield the results of a function for several tasks, in the order of the tasks. A task is a set of arguments of the
    function.

    The number of tasks that are submitted at the same time is limited. If the iterator is closed or an
    exception is raised, tasks that have not started are cancelled.
    """
    # A Dask client makes an executor, with tasks that are not cached.
    executor: Any = client.get_executor(pure=False) if hasattr(client, "get_executor") else client
    submitted: deque[Any] = deque()
    remaining = iter(tasks)
    try:
        while True:
            # The workers of a cluster can start after the first tasks.
            ahead = _TASKS_PER_WORKER * _number_of_workers(client)
            while len(submitted) < ahead and (task := next(remaining, None)) is not None:
                submitted.append(executor.submit(function, *task))
            if not submitted:
                return
            result = submitted[0].result()
            submitted.popleft()
            yield result
    except BrokenExecutor as error:
        raise RuntimeError(
            f"a worker of `client` died: {error}\n"
            "check that its workers can import flapwing and have enough memory; in a script, begin with "
            'if __name__ == "__main__":\n'
            "then call again with a new executor; a sweep with `out` continues"
        ) from error
    except Exception as error:
        error.add_note("raised by a task of `client`; a sweep with `out` continues if you call it again")
        raise
    finally:
        for future in submitted:
            future.cancel()


def _number_of_workers(client: Any) -> int:
    """Return the number of tasks that the workers of `client` can run at the same time."""
    if hasattr(client, "nthreads"):
        return sum(client.nthreads().values()) or _UNKNOWN_WORKERS
    # `num_workers` is mpi4py's; process pools and thread pools have only the private attribute.
    number = getattr(client, "num_workers", None) or getattr(client, "_max_workers", None)
    return number if isinstance(number, int) and number > 0 else _UNKNOWN_WORKERS
