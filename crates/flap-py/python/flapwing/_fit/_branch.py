"""Branches of designs with hysteresis: every motion begins where that of the point before it has settled."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, Mapping, Sequence

import numpy as np

from .._table import Table
from ._types import Array, Places

#: The longest step along a way, as a share of the parameter: between readings that are farther apart there are more.
_STEP = 0.02


@dataclass(frozen=True)
class Way:
    """Points that were run one after another, as a parameter rises or falls."""

    along: str
    falls: bool
    rows: Places


def states_along(
    ways: Sequence[Way],
    columns: Mapping[str, Any],
    rows: int,
    times: int,
    names: Sequence[str],
    run: Callable[..., Table],
) -> dict[str, Array] | None:
    """The states from which motions on the ways begin; None if there are no ways.

    Of `columns`, each has the points `times` over, for so many sets of parameters; states have the components `names`. The
    ways of all of them are followed side by side, a point of each in a batch.
    """
    if not ways:
        return None
    curves = [curve for way in ways for copy in range(times) for curve in _curves(way, columns, copy * rows)]
    begin = {name: np.full(rows * times, np.nan) for name in names}
    last: dict[int, dict[str, float]] = {}
    for step in range(max(len(curve) for curve in curves)):
        here = [(number, curve[step]) for number, curve in enumerate(curves) if step < len(curve)]
        chosen = [place for _, (place, _, _) in here]
        batch = {name: _taken(values, chosen) for name, values in columns.items()}
        for position, (_, (_, along, value)) in enumerate(here):
            batch[along][position] = value
        states = {
            name: np.array([last[number][name] if number in last else np.nan for number, _ in here]) for name in names
        }
        table = run(batch, states=True, begin=states)
        for position, (number, (place, along, value)) in enumerate(here):
            state = {name: float(table[name][position]) for name in names}
            if all(np.isfinite(component) for component in state.values()):
                last[number] = state
            if value == columns[along][place]:
                for name in names:
                    begin[name][place] = last.get(number, state)[name]
    return begin


def _curves(way: Way, columns: Mapping[str, Any], offset: int) -> list[list[tuple[int, str, float]]]:
    """The points along a way, for each group that differs in other parameters: the row, the parameter and its value."""
    groups: dict[tuple[Any, ...], list[int]] = {}
    for row in way.rows + offset:
        key = tuple(values[row] for name, values in columns.items() if name != way.along)
        groups.setdefault(key, []).append(int(row))
    curves = []
    for group in groups.values():
        group.sort(key=lambda row: float(columns[way.along][row]), reverse=way.falls)
        curve: list[tuple[int, str, float]] = []
        for row in group:
            value = float(columns[way.along][row])
            if curve:
                before = curve[-1][2]
                between = int(abs(value - before) / (_STEP * max(abs(value), abs(before), 1e-300)))
                curve += [(row, way.along, one) for one in np.linspace(before, value, between + 2)[1:-1].tolist()]
            curve.append((row, way.along, value))
        curves.append(curve)
    return curves


def _taken(values: Any, places: list[int]) -> Any:
    return values[places].copy() if isinstance(values, np.ndarray) else [values[place] for place in places]
