"""Calls, sweeps, batches and responses on the workers of an executor, such as a process pool or a Dask cluster."""

from __future__ import annotations

import os
from collections import Counter, deque
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
#: Number of invalid points whose reasons are kept, as for a batch on one machine.
_MOST_REASONS = 5


def call(client: Executor | None, function: Callable[..., Any], design: Any, *arguments: Any, **keywords: Any) -> Any:
    """Return the result of a native function for a design. If a client is given, a worker calls the function."""
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
    """Run the task of a worker: return the identity of the worker and the result of the native function `name`."""
    keywords = {key: _aligned(value) if isinstance(value, dict) else value for key, value in keywords.items()}
    return _flapwing.identity(), getattr(_flapwing, name)(design, *arguments, **keywords)


def _aligned(columns: Mapping[str, Any]) -> dict[str, Any]:
    """Return columns whose arrays are aligned, as the compiled module requires. An array that Dask has transferred can
    begin at any byte.
    """
    return {
        name: np.require(values, requirements=["C", "A"]) if isinstance(values, np.ndarray) else values
        for name, values in columns.items()
    }


def _absolute(record: Any) -> Any:
    """Return a waveform or a motion that workers can read. A path to a file is made absolute."""
    return os.path.abspath(record) if isinstance(record, str) else record


def _portable(design: Any) -> Any:
    """Return a design that workers can read. The name of a preset is unchanged, and the files in a grid get absolute
    paths.
    """
    if isinstance(design, str) and design in _flapwing.presets():
        return design
    try:
        grid = Grid(design)
    except ValueError:
        _flapwing.states(design)  # accepts a model; raises the same error for anything else
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
    """The points of a grid in ranges that workers compute. The rows are returned in the order of the points."""

    def __init__(
        self, grid: Grid, client: Executor, threads: SupportsIndex | None, points_per_task: SupportsIndex | None
    ) -> None:
        self._client = client
        # Workers resolve the files of the grid to the same absolute paths as this process.
        self._grid = (os.path.abspath(grid.name), grid.text)
        self._points = len(grid)
        self._threads = 1 if threads is None else threads
        self._size = _task_size(client, self._points, self._threads, points_per_task)
        self._results: Generator[bytes, None, None] | None = None

    def __enter__(self) -> Chunks:
        return self

    def __exit__(self, *_: object) -> None:
        # The results of the submitted tasks are not needed.
        if self._results is not None:
            self._results.close()

    def next(self, done: int) -> bytes | None:
        """Return the next chunk of rows. The first chunk begins after the first `done` points, which are already
        computed."""
        if self._results is None:
            begins = range(done, self._points, self._size)
            tasks = ((*self._grid, begin, min(self._points, begin + self._size), self._threads) for begin in begins)
            self._results = _results(self._client, _part_task, tasks)
        return next(self._results, None)


def _part_task(name: str, text: str, begin: int, end: int, threads: SupportsIndex | None) -> bytes:
    """Run the task of a worker: return the rows of a range of points of a grid, as bytes."""
    return _flapwing.part(Grid._named(name, text), begin, end, threads=threads)


def _task_size(client: Executor, points: int, threads: SupportsIndex, points_per_task: SupportsIndex | None) -> int:
    """Return the number of points of a task. By default, a task is so small that every worker gets points, even if the
    number of points is small.
    """
    if points_per_task is not None:
        return _arguments.count("points_per_task", points_per_task)
    most = _TASK_POINTS * _arguments.count("threads", threads)
    return max(1, min(most, -(-points // (_TASKS_PER_WORKER * _number_of_workers(client)))))


def _evaluate_task(
    design: Any, options: dict[str, Any], given: dict[str, Any], threads: SupportsIndex | None
) -> dict[str, Any]:
    """Run the task of a worker: return the rows for a range of points. The points are given as columns of
    parameters."""
    return _flapwing.evaluate(design, _aligned(given), threads=threads, **_aligned(options))


def _options_of(options: dict[str, Any], begin: int, end: int) -> dict[str, Any]:
    """Return the options of a batch for the points from `begin` up to, but not including, `end`."""
    states = options["initial_state"]
    return options if states is None else {**options, "initial_state": states[begin:end]}


def evaluate(
    client: Executor,
    design: Any,
    options: dict[str, Any],
    given: dict[str, Any],
    threads: SupportsIndex | None,
    points_per_task: SupportsIndex | None,
    show: Callable[[int, int], object] | None,
) -> dict[str, Any]:
    """Return the rows of the points in the columns `given`. Workers compute the rows."""
    # This call reports mistakes. An empty selection has the same columns and axes as all rows.
    empty = _evaluate_task(design, _options_of(options, 0, 0), {name: values[:0] for name, values in given.items()}, 1)
    lengths = {name: len(values) for name, values in given.items()}
    length = next(iter(lengths.values()))
    points_per_row = int(np.prod([len(next(iter(axis.values()))) for axis in empty["axes"][1:]]))
    states = options["initial_state"]
    if len(set(lengths.values())) > 1 or (states is not None and len(states) != length * points_per_row):
        return _evaluate_task(design, options, given, 1)
    threads_per_task = 1 if threads is None else threads
    size = max(
        1, _task_size(client, length * points_per_row, threads_per_task, points_per_task) // max(1, points_per_row)
    )
    design = _portable(design)
    begins = range(0, length, size)
    tasks = (
        (
            design,
            _options_of(options, begin * points_per_row, (begin + size) * points_per_row),
            {name: values[begin : begin + size] for name, values in given.items()},
            threads_per_task,
        )
        for begin in begins
    )
    parts = [empty]
    with closing(_results(client, _evaluate_task, tasks)) as results:
        for begin, part in zip(begins, results):
            _check_identity(empty["meta"], part["meta"])
            parts.append(_renumbered(part, begin * points_per_row))
            if show is not None:
                show(min(length, begin + size) * points_per_row, length * points_per_row)
    return _joined(parts)


def _renumbered(part: dict[str, Any], offset: int) -> dict[str, Any]:
    """Return the rows of a part of a batch, with the point numbers of the whole batch. The first point of the part has
    the number `offset`.
    """
    point = Column(*part["columns"]["point"])
    columns = {**part["columns"], "point": point._replace(cells=point.cells + np.uint64(offset))}
    invalid = [(point + offset, reason) for point, reason in part["summary"]["invalid"]]
    return {**part, "columns": columns, "summary": {**part["summary"], "invalid": invalid}}


def _joined(parts: list[dict[str, Any]]) -> dict[str, Any]:
    """Join the rows of all parts of a batch, and return the whole batch."""
    first = parts[0]
    axes = list(first["axes"])
    if axes:
        rows = {name: [value for part in parts for value in part["axes"][0][name]] for name in axes[0]}
        axes[0] = {**rows, "row": np.arange(len(rows["row"]), dtype=np.uint64)}
    summary = _summed([part["summary"] for part in parts])
    return {"columns": _columns(parts), "summary": summary, "axes": axes, "meta": first["meta"]}


def _columns(parts: list[dict[str, Any]]) -> dict[str, Column]:
    """Join the columns of all parts of a batch, and return the joined columns."""
    return {name: _column([Column(*part["columns"][name]) for part in parts]) for name in parts[0]["columns"]}


def _column(parts: list[Column]) -> Column:
    """Join one column of all parts of a batch. The parts of a text column can have different lists of words."""
    cells = [one.cells for one in parts]
    if parts[0].words is None:
        return parts[0]._replace(cells=np.concatenate(cells))
    listed = [one.words or [] for one in parts]
    words = list(dict.fromkeys(word for some in listed for word in some))
    places = [np.array([words.index(word) for word in some], dtype=np.uint32) for some in listed]
    cells = [place_of[one] if len(place_of) else one for place_of, one in zip(places, cells)]
    return parts[0]._replace(cells=np.concatenate(cells), words=words)


def _summed(summaries: list[dict[str, Any]]) -> dict[str, Any]:
    """Return the summary of the whole batch: the sum of the summaries of all parts."""

    def total(counts: list[dict[str, int]]) -> dict[str, int]:
        summed: Counter[str] = Counter()
        for one in counts:
            summed.update(one)
        return dict(summed)

    return {
        "rows": sum(summary["rows"] for summary in summaries),
        "counts": total([summary["counts"] for summary in summaries]),
        "excluded": sum(summary["excluded"] for summary in summaries),
        "unsatisfied": total([summary["unsatisfied"] for summary in summaries]),
        "cycles": sum(summary["cycles"] for summary in summaries),
        "rhs_evals": sum(summary["rhs_evals"] for summary in summaries),
        "invalid": [entry for summary in summaries for entry in summary["invalid"]][:_MOST_REASONS],
    }


def _respond_task(
    design: Any, parameter: str, options: dict[str, Any], curve: int, threads: SupportsIndex | None
) -> dict[str, Any]:
    """Run the task of a worker: return the curve of one design."""
    return _flapwing.respond(design, parameter, threads=threads, curves=[curve], **options)


def responses(
    client: Executor,
    design: Any,
    parameter: str,
    options: dict[str, Any],
    threads: SupportsIndex | None,
    show: Callable[[int, int], object] | None,
) -> dict[str, Any]:
    """Return the responses of designs. Workers compute the responses."""
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
    """Return the number of tasks that run at the same time."""
    if hasattr(client, "nthreads"):
        return sum(client.nthreads().values()) or _UNKNOWN_WORKERS
    # `num_workers` is mpi4py's; process pools and thread pools have only the private attribute.
    number = getattr(client, "num_workers", None) or getattr(client, "_max_workers", None)
    return number if isinstance(number, int) and number > 0 else _UNKNOWN_WORKERS
