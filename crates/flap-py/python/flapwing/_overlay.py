"""Grids with the keywords of a call in them, so that files of results record both."""

from __future__ import annotations

import tomllib
from typing import Any, Mapping, Sequence

from . import _flapwing
from ._flapwing import Grid
from ._types import Design, Value



def grid_of(design: Design, keywords: Mapping[str, Value], measures: Sequence[str] | None) -> Grid:
    """The grid of a design, with parameters and solver settings of keywords, and with these measures alone."""
    grid = design if isinstance(design, Grid) else Grid(design)
    if not keywords and measures is None:
        return grid
    # Mistakes are told as those of other calls.
    _flapwing.check(grid, keywords=dict(keywords), measures=None if measures is None else list(measures))
    entries: dict[str, Any] = tomllib.loads(grid.text)
    settings = _flapwing.settings()
    for name, value in keywords.items():
        if name not in settings:
            entries.setdefault("params", {})[name] = value
        elif value is not None:
            entries.setdefault("solver", {})[name] = value
    if measures is not None:
        entries.setdefault("output", {})["columns"] = list(measures)
    overlaid = Grid._named(grid.name, _flapwing.text_of(entries))
    if [list(axis) for axis in overlaid.axes] != [list(axis) for axis in grid.axes]:
        # Several [[zip]] tables with others between them: a dictionary does not keep such an order.
        raise ValueError("keywords would change the order of the grid's axes\nwrite them into its [params] and [solver]")
    return overlaid
