"""Functions that run single calls, sweeps, batches and responses on the workers of a Dask cluster."""

from __future__ import annotations

import os
from collections import Counter, deque
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, SupportsIndex

import numpy as np

from . import _arguments, _flapwing
from ._flapwing import Grid
from ._native import NativeColumn, NativeIdentity, NativeSummary, NativeTable

if TYPE_CHECKING:
    from distributed import Client, Future

#: Points of a task: some seconds of work. A lost worker loses little, and sending rows takes a small share of the time.
_TASK_POINTS = 2048
#: Running and waiting tasks per thread of the cluster: no worker is idle, and memory stays bounded.
_TASKS_PER_THREAD = 4
#: Number of times that a task is repeated on other workers after its worker died.
_RETRIES = 5
#: Number of invalid points whose reasons are kept, as for a batch on one machine.
_MOST_REASONS = 5


def call(client: Client | None, function: Callable[..., Any], design: Any, *arguments: Any, **keywords: Any) -> Any:
    """Return the result of a native function for a design. Without a client, this process calls the function; with a
    client, a worker does.
    """
    if client is None:
        return function(design, *arguments, **keywords)
    client = _arguments.cluster(client)
    keywords = {name: _found(value) if name in ("waveform", "stroke") else value for name, value in keywords.items()}
    future = client.submit(_call_task, function.__name__, _sent(design), arguments, keywords, pure=False)
    try:
        identity, result = future.result()
    finally:
        client.cancel([future], force=True)
    _check(_flapwing.identity(), identity)
    return result


def _call_task(
    name: str, design: Any, arguments: tuple[Any, ...], keywords: dict[str, Any]
) -> tuple[NativeIdentity, Any]:
    """Run the task of a worker: return its identity and the result of the native function with this name."""
    keywords = {key: _aligned(value) if isinstance(value, dict) else value for key, value in keywords.items()}
    return _flapwing.identity(), getattr(_flapwing, name)(design, *arguments, **keywords)


def _aligned(columns: Mapping[str, Any]) -> dict[str, Any]:
    """Return the columns with aligned arrays, which the native part requires. In a message of Dask, an array may begin
    at any byte.
    """
    return {
        name: np.require(values, requirements=["C", "A"]) if isinstance(values, np.ndarray) else values
        for name, values in columns.items()
    }


def _found(record: Any) -> Any:
    """Return a record for workers. If the record is a path, this process makes the path absolute."""
    return os.path.abspath(record) if isinstance(record, str) else record


def _sent(design: Any) -> Any:
    """Return the design for workers. The name of a preset is unchanged, and the files in a grid get absolute paths."""
    if isinstance(design, str) and design in _flapwing.presets():
        return design
    try:
        grid = Grid(design)
    except ValueError:
        _flapwing.states(design)  # accepts a model; raises the same error for anything else
        return design
    return Grid._named(os.path.abspath(grid.name), grid.text)


def _check(ours: Mapping[str, Any], theirs: Mapping[str, Any]) -> None:
    """Raise RuntimeError if the rows of a worker may differ in their bits from the rows of this process."""
    for name in ("build", "arithmetic"):
        if ours[name] != theirs[name]:
            raise RuntimeError(
                f"a worker's {name} of flapwing is {theirs[name]}, but here it is {ours[name]}\n"
                "install the same build everywhere, on processors with the same arithmetic"
            )


def _part_task(name: str, text: str, begin: int, end: int, threads: SupportsIndex | None) -> bytes:
    """Run the task of a worker: return the rows of a range of points of a grid, as bytes."""
    return _flapwing.part(Grid._named(name, text), begin, end, threads=threads)


class Chunks:
    """Ranges of the points of a grid, which a cluster computes. The rows are returned in the order of the points."""

    def __init__(self, grid: Grid, client: Client, threads: SupportsIndex | None) -> None:
        self._client = client
        # Workers resolve the files of the grid to the same absolute paths as this process.
        self._grid = (os.path.abspath(grid.name), grid.text)
        self._points = len(grid)
        self._threads = 1 if threads is None else threads
        self._under_way: deque[tuple[int, Future[Any]]] = deque()
        self._submitted: int | None = None
        # Every worker gets points, even of a small grid.
        workers = max(1, sum(client.nthreads().values()))
        self._size = max(1, min(_TASK_POINTS, -(-self._points // (_TASKS_PER_THREAD * workers))))
        self._ahead = _TASKS_PER_THREAD * workers

    def __enter__(self) -> Chunks:
        return self

    def __exit__(self, *_: object) -> None:
        # The results of these tasks are not needed.
        self._client.cancel([future for _, future in self._under_way], force=True)
        self._under_way.clear()

    def next(self, done: int) -> bytes | None:
        """Return the next chunk of rows, which begins after the points that are already done."""
        if self._submitted is None:
            self._submitted = done
        while self._submitted < self._points and len(self._under_way) < self._ahead:
            end = min(self._points, self._submitted + self._size)
            future = self._client.submit(
                _part_task, *self._grid, self._submitted, end, self._threads, pure=False, retries=_RETRIES
            )
            self._under_way.append((self._submitted, future))
            self._submitted = end
        if not self._under_way:
            return None
        begin, future = self._under_way.popleft()
        assert begin == done, "chunks are requested in order"
        try:
            chunk: bytes = future.result()
        finally:
            future.release()
        return chunk


def _evaluate_task(
    design: Any, options: dict[str, Any], given: dict[str, Any], threads: SupportsIndex | None
) -> NativeTable:
    """Run the task of a worker: return the rows for a range of points, given by their columns."""
    return _flapwing.evaluate(design, _aligned(given), threads=threads, **_aligned(options))


def _stretch(options: dict[str, Any], begin: int, end: int) -> dict[str, Any]:
    """Return the options of a batch for the points from `begin` to before `end`."""
    states = options["initial_state"]
    return options if states is None else {**options, "initial_state": states[begin:end]}


def evaluate(
    client: Client,
    design: Any,
    options: dict[str, Any],
    given: dict[str, Any],
    threads: SupportsIndex | None,
    show: Callable[[int, int], object] | None,
) -> NativeTable:
    """Return the rows of a batch, which the workers of a cluster compute; `given` has the columns of its points."""
    # This call reports mistakes. An empty selection has the same columns and axes as all rows.
    nothing = _evaluate_task(design, _stretch(options, 0, 0), {name: values[:0] for name, values in given.items()}, 1)
    lengths = {name: len(values) for name, values in given.items()}
    length = next(iter(lengths.values()))
    each = int(np.prod([len(next(iter(axis.values()))) for axis in nothing["axes"][1:]]))
    states = options["initial_state"]
    if len(set(lengths.values())) > 1 or (states is not None and len(states) != length * each):
        return _evaluate_task(design, options, given, 1)
    workers = max(1, sum(client.nthreads().values()))
    most = max(1, _TASK_POINTS // max(1, each))
    size = max(1, min(most, -(-length // (_TASKS_PER_THREAD * workers))))
    design = _sent(design)
    count = 1 if threads is None else threads
    begins = range(0, length, size)
    futures = [
        client.submit(
            _evaluate_task,
            design,
            _stretch(options, begin * each, (begin + size) * each),
            {name: values[begin : begin + size] for name, values in given.items()},
            count,
            pure=False,
            retries=_RETRIES,
        )
        for begin in begins
    ]
    parts = [nothing]
    try:
        for begin, future in zip(begins, futures):
            part = future.result()
            _check(nothing["meta"], part["meta"])
            parts.append(_moved(part, begin * each))
            if show is not None:
                show(min(length, begin + size) * each, length * each)
    finally:
        client.cancel(futures, force=True)
    return _joined(parts)


def _moved(part: NativeTable, offset: int) -> NativeTable:
    """Return the rows of a part, numbered as points of the whole batch. The first point of the part has the number
    `offset`.
    """
    columns: list[NativeColumn] = [
        {**one, "cells": one["cells"] + np.uint64(offset)} if one["name"] == "point" else one for one in part["columns"]
    ]
    invalid = [(point + offset, reason) for point, reason in part["summary"]["invalid"]]
    return {**part, "columns": columns, "summary": {**part["summary"], "invalid": invalid}}


def _joined(parts: list[NativeTable]) -> NativeTable:
    """Join the rows of all parts to one batch, and return this batch."""
    first = parts[0]
    axes = list(first["axes"])
    if axes:
        rows = {name: [value for part in parts for value in part["axes"][0][name]] for name in axes[0]}
        axes[0] = {**rows, "row": np.arange(len(rows["row"]), dtype=np.uint64)}
    summary = _summed([part["summary"] for part in parts])
    return {"columns": _columns(parts), "summary": summary, "axes": axes, "meta": first["meta"]}


def _columns(parts: list[NativeTable]) -> list[NativeColumn]:
    """Join the columns of all parts, and return the joined columns."""
    return [_column([part["columns"][place] for part in parts]) for place in range(len(parts[0]["columns"]))]


def _column(parts: list[NativeColumn]) -> NativeColumn:
    """Join a column of all parts, and return it. Each part has its own list of words."""
    cells = [one["cells"] for one in parts]
    if parts[0]["words"] is None:
        return {**parts[0], "cells": np.concatenate(cells)}
    listed = [one["words"] or [] for one in parts]
    words = list(dict.fromkeys(word for some in listed for word in some))
    places = [np.array([words.index(word) for word in some], dtype=np.uint32) for some in listed]
    cells = [place_of[one] if len(place_of) else one for place_of, one in zip(places, cells)]
    return {**parts[0], "cells": np.concatenate(cells), "words": words}


def _summed(summaries: list[NativeSummary]) -> NativeSummary:
    """Return the summary of the whole batch, summed over its parts."""

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
) -> NativeTable:
    """Run the task of a worker: return the curve of one design."""
    return _flapwing.respond(design, parameter, threads=threads, curves=[curve], **options)


def responses(
    client: Client,
    design: Any,
    parameter: str,
    options: dict[str, Any],
    threads: SupportsIndex | None,
    show: Callable[[int, int], object] | None,
) -> NativeTable:
    """Return the responses of designs. Workers of a cluster compute one design each."""
    # This call reports mistakes. It returns no rows.
    nothing = _flapwing.respond(design, parameter, threads=threads, curves=[], **options)
    designs = nothing["designs"]
    design = _sent(design)
    count = 1 if threads is None else threads
    futures = [
        client.submit(_respond_task, design, parameter, options, curve, count, pure=False, retries=_RETRIES)
        for curve in range(designs)
    ]
    parts = [nothing]
    try:
        for done, future in enumerate(futures, 1):
            part = future.result()
            _check(nothing["meta"], part["meta"])
            parts.append(part)
            if show is not None:
                show(done, designs)
    finally:
        client.cancel(futures, force=True)
    verdicts = [verdict for part in parts for verdict in part["meta"]["verdicts"]]
    return {"columns": _columns(parts), "meta": {**nothing["meta"], "verdicts": verdicts}}
