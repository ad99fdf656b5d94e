"""Rows that the workers of a Dask cluster compute, in the order of the points."""

from __future__ import annotations

import os
from collections import deque
from typing import TYPE_CHECKING, Any, SupportsIndex

from . import _flapwing
from ._flapwing import Grid

if TYPE_CHECKING:
    from distributed import Client, Future

#: Points of a task: some seconds of work, so that little is lost with a worker and sending rows takes no time.
TASK_POINTS = 2048
#: Tasks per thread of the cluster that are under way or waiting, so that no worker is idle and memory stays bounded.
TASKS_PER_THREAD = 4
#: Times that a task is tried on other workers after its own has died.
RETRIES = 5


def part(name: str, text: str, begin: int, end: int, threads: SupportsIndex | None) -> bytes:
    """The task of a worker: the rows of a stretch of points, as bytes."""
    return _flapwing.part(Grid._named(name, text), begin, end, threads=threads)


class Parcels:
    """Stretches of a grid, computed by a cluster; their rows come in the order of the points."""

    def __init__(self, grid: Grid, client: Client, threads: SupportsIndex | None) -> None:
        self._client = client
        # Workers look for files that the grid names where this process does.
        self._grid = (os.path.abspath(grid.name), grid.text)
        self._points = len(grid)
        self._threads = 1 if threads is None else threads
        self._under_way: deque[tuple[int, Future[Any]]] = deque()
        self._submitted: int | None = None
        # Every worker gets some of a small grid.
        workers = max(1, sum(client.nthreads().values()))
        self._size = max(1, min(TASK_POINTS, -(-self._points // (TASKS_PER_THREAD * workers))))
        self._ahead = TASKS_PER_THREAD * workers

    def __enter__(self) -> Parcels:
        return self

    def __exit__(self, *_: object) -> None:
        # Nobody waits for these results.
        self._client.cancel([future for _, future in self._under_way], force=True)
        self._under_way.clear()

    def next(self, done: int) -> bytes | None:
        """The parcel that begins after the points that are done."""
        if self._submitted is None:
            self._submitted = done
        while self._submitted < self._points and len(self._under_way) < self._ahead:
            end = min(self._points, self._submitted + self._size)
            future = self._client.submit(
                part, *self._grid, self._submitted, end, self._threads, pure=False, retries=RETRIES
            )
            self._under_way.append((self._submitted, future))
            self._submitted = end
        if not self._under_way:
            return None
        begin, future = self._under_way.popleft()
        assert begin == done, "parcels are asked for in order"
        try:
            parcel: bytes = future.result()
        finally:
            future.release()
        return parcel
