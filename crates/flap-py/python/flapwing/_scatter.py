"""Batches of points and responses on a Dask cluster: their parts are joined in order."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any, Callable, SupportsIndex

import numpy as np

from . import _flapwing
from ._cluster import RETRIES, TASK_POINTS, TASKS_PER_THREAD
from ._worker import aligned, check, sent

if TYPE_CHECKING:
    from distributed import Client

#: Reasons kept of invalid points, as of a batch on one machine.
MOST_REASONS = 5


def task(
    design: Any, options: dict[str, Any], given: dict[str, Any], threads: SupportsIndex | None
) -> dict[str, Any]:
    """The task of a worker: the rows of a stretch of the columns."""
    return _flapwing.evaluate(design, aligned(given), threads=threads, **aligned(options))


def _stretch(options: dict[str, Any], begin: int, end: int) -> dict[str, Any]:
    """The options for some of the points."""
    states = options["begin"]
    return options if states is None else {**options, "begin": states[begin:end]}


def scattered(
    client: Client,
    design: Any,
    options: dict[str, Any],
    given: dict[str, Any],
    threads: SupportsIndex | None,
    show: Callable[[int, int], object] | None,
) -> dict[str, Any]:
    """The rows of the columns `given`, computed by the workers of a cluster."""
    # Mistakes are told here, and rows are empty: their columns and axes are those of all.
    nothing = task(design, _stretch(options, 0, 0), {name: values[:0] for name, values in given.items()}, 1)
    lengths = {name: len(values) for name, values in given.items()}
    length = next(iter(lengths.values()))
    each = int(np.prod([len(next(iter(axis.values()))) for axis in nothing["axes"][1:]]))
    states = options["begin"]
    if len(set(lengths.values())) > 1 or (states is not None and len(states) != length * each):
        return task(design, options, given, 1)
    workers = max(1, sum(client.nthreads().values()))
    most = max(1, TASK_POINTS // max(1, each))
    size = max(1, min(most, -(-length // (TASKS_PER_THREAD * workers))))
    design = sent(design)
    count = 1 if threads is None else threads
    begins = range(0, length, size)
    futures = [
        client.submit(
            task,
            design,
            _stretch(options, begin * each, (begin + size) * each),
            {name: values[begin : begin + size] for name, values in given.items()},
            count,
            pure=False,
            retries=RETRIES,
        )
        for begin in begins
    ]
    parts = [nothing]
    try:
        for begin, future in zip(begins, futures):
            part = future.result()
            check(nothing["meta"], part["meta"])
            parts.append(_moved(part, begin * each))
            if show is not None:
                show(min(length, begin + size) * each, length * each)
    finally:
        client.cancel(futures, force=True)
    return _joined(parts)


def _moved(part: dict[str, Any], offset: int) -> dict[str, Any]:
    """The rows with the points of the whole batch, which begin at `offset` here."""
    columns = [
        (name, unit, doc, cells + np.uint64(offset) if name == "point" else cells, words)
        for name, unit, doc, cells, words in part["columns"]
    ]
    invalid = [(point + offset, reason) for point, reason in part["summary"]["invalid"]]
    return {**part, "columns": columns, "summary": {**part["summary"], "invalid": invalid}}


def _joined(parts: list[dict[str, Any]]) -> dict[str, Any]:
    """All rows as one batch."""
    first = parts[0]
    axes = list(first["axes"])
    if axes:
        rows = {name: [value for part in parts for value in part["axes"][0][name]] for name in axes[0]}
        axes[0] = {**rows, "row": np.arange(len(rows["row"]), dtype=np.uint64)}
    summary = _summed([part["summary"] for part in parts])
    return {"columns": _columns(parts), "summary": summary, "axes": axes, "meta": first["meta"]}


def _columns(parts: list[dict[str, Any]]) -> list[tuple[Any, ...]]:
    """The columns of all rows."""
    columns = []
    for place, (name, unit, doc, _, words) in enumerate(parts[0]["columns"]):
        cells = [part["columns"][place][3] for part in parts]
        if words is not None:
            words = list(dict.fromkeys(word for part in parts for word in part["columns"][place][4]))
            places = [
                np.array([words.index(word) for word in part["columns"][place][4]], dtype=np.uint32) for part in parts
            ]
            cells = [place_of[one] if len(place_of) else one for place_of, one in zip(places, cells)]
        columns.append((name, unit, doc, np.concatenate(cells), words))
    return columns


def _summed(summaries: list[dict[str, Any]]) -> dict[str, Any]:
    """The summary of the whole batch."""
    whole = dict(summaries[0])
    for name, value in whole.items():
        if isinstance(value, dict):
            total: Counter[str] = Counter()
            for summary in summaries:
                total.update(summary[name])
            whole[name] = dict(total)
        elif isinstance(value, int):
            whole[name] = sum(summary[name] for summary in summaries)
    whole["invalid"] = [entry for summary in summaries for entry in summary["invalid"]][:MOST_REASONS]
    return whole


def respond_task(
    design: Any, along: str, options: dict[str, Any], curve: int, threads: SupportsIndex | None
) -> dict[str, Any]:
    """The task of a worker: the curve of one design."""
    return _flapwing.respond(design, along, threads=threads, curves=[curve], **options)


def responses(
    client: Client,
    design: Any,
    along: str,
    options: dict[str, Any],
    threads: SupportsIndex | None,
    show: Callable[[int, int], object] | None,
) -> dict[str, Any]:
    """The responses of designs, each computed by a worker of a cluster."""
    # Mistakes are told here, and there are no rows.
    nothing = _flapwing.respond(design, along, threads=threads, curves=[], **options)
    designs = nothing["designs"]
    design = sent(design)
    count = 1 if threads is None else threads
    futures = [
        client.submit(respond_task, design, along, options, curve, count, pure=False, retries=RETRIES)
        for curve in range(designs)
    ]
    parts = [nothing]
    try:
        for done, future in enumerate(futures, 1):
            part = future.result()
            check(nothing["meta"], part["meta"])
            parts.append(part)
            if show is not None:
                show(done, designs)
    finally:
        client.cancel(futures, force=True)
    verdicts = [verdict for part in parts for verdict in part["meta"]["verdicts"]]
    return {"columns": _columns(parts), "meta": {**nothing["meta"], "verdicts": verdicts}}
