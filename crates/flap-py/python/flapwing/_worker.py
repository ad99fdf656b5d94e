"""Single calls on a worker of a Dask cluster, and the check that a worker computes as this process does."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Callable, Mapping

import numpy as np

from . import _arguments, _flapwing
from ._flapwing import Grid

if TYPE_CHECKING:
    from distributed import Client


def call(client: Client | None, function: Callable[..., Any], design: Any, *arguments: Any, **keywords: Any) -> Any:
    """The result of a native function about a design, called here or, with a client, by a worker."""
    if client is None:
        return function(design, *arguments, **keywords)
    client = _arguments.cluster(client)
    keywords = {name: _found(value) if name in ("waveform", "stroke") else value for name, value in keywords.items()}
    future = client.submit(_task, function.__name__, sent(design), arguments, keywords, pure=False)
    try:
        identity, result = future.result()
    finally:
        client.cancel([future], force=True)
    check(_flapwing.identity(), identity)
    return result


def _task(name: str, design: Any, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> tuple[dict[str, str], Any]:
    """The task of a worker: what it is, and the result of the native function with this name."""
    keywords = {key: aligned(value) if isinstance(value, dict) else value for key, value in keywords.items()}
    return _flapwing.identity(), getattr(_flapwing, name)(design, *arguments, **keywords)


def aligned(columns: Mapping[str, Any]) -> dict[str, Any]:
    """The columns as the native part takes them: arrays may lie anywhere in a message."""
    return {
        name: np.require(values, requirements=["C", "A"]) if isinstance(values, np.ndarray) else values
        for name, values in columns.items()
    }


def _found(record: Any) -> Any:
    """A record as workers find it: a path is where this process looks for it."""
    return os.path.abspath(record) if isinstance(record, str) else record


def sent(design: Any) -> Any:
    """The design as workers take it: a name as it is, and a grid whose files are where this process looks for them."""
    if isinstance(design, str) and design in _flapwing.presets():
        return design
    try:
        grid = Grid(design)
    except ValueError:
        _flapwing.states(design)  # a model; for anything else the same error
        return design
    return Grid._named(os.path.abspath(grid.name), grid.text)


def check(ours: Mapping[str, Any], theirs: Mapping[str, Any]) -> None:
    """Raises RuntimeError if a worker's rows may have other bits."""
    for name in ("build", "arithmetic"):
        if ours[name] != theirs[name]:
            raise RuntimeError(
                f"a worker's {name} of flapwing is {theirs[name]}, and here it is {ours[name]}\n"
                "install the same build everywhere, on processors that round alike"
            )
