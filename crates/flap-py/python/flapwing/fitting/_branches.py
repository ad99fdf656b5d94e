"""Computation of motions on branches of hysteresis: each simulation begins with the periodic state at the previous
point of the branch.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._table import Table
from .._types import Array, Places

#: The largest change of the parameter between two successive points of a branch, as a share of the parameter. If two
#: successive readings are more distant, the branch gets additional points between these readings.
_STEP = 0.02


@dataclass(frozen=True)
class Branch:
    """The points of a branch of hysteresis. The points are simulated in the order in which a parameter rises or
    falls.
    """

    parameter: str
    falls: bool
    rows: Places


def states_along(
    branches: Sequence[Branch],
    columns: Mapping[str, Any],
    rows: int,
    times: int,
    names: Sequence[str],
    run: Callable[..., Table],
) -> dict[str, Array] | None:
    """Return the initial states of the motions on the branches of hysteresis. Return None if the data have no branches.

    The columns in `columns` contain `times` copies of all points: one copy for each set of parameters. `names` contains
    the names of the components of a state. The branches are computed at the same time: each batch of simulations
    contains the next point of every branch.
    """
    if not branches:
        return None
    curves = [curve for branch in branches for copy in range(times) for curve in _curves(branch, columns, copy * rows)]
    begin = {name: np.full(rows * times, np.nan) for name in names}
    last: dict[int, dict[str, float]] = {}
    for step in range(max(len(curve) for curve in curves)):
        here = [(number, curve[step]) for number, curve in enumerate(curves) if step < len(curve)]
        chosen = [place for _, (place, _, _) in here]
        batch = {name: taken(values, chosen) for name, values in columns.items()}
        for position, (_, (_, along, value)) in enumerate(here):
            batch[along][position] = value
        states = {
            name: np.array([last[number][name] if number in last else np.nan for number, _ in here]) for name in names
        }
        table = run(batch, return_states=True, initial_state=states)
        for position, (number, (place, along, value)) in enumerate(here):
            state = {name: float(table[name][position]) for name in names}
            if all(np.isfinite(component) for component in state.values()):
                last[number] = state
            if value == columns[along][place]:
                for name in names:
                    begin[name][place] = last.get(number, state)[name]
    return begin


def _curves(branch: Branch, columns: Mapping[str, Any], offset: int) -> list[list[tuple[int, str, float]]]:
    """Return the curves of a branch. A curve contains the points that differ only in the parameter that rises or falls
    along the branch. Each entry of a curve contains the row of a point, and the name and the value of the parameter.
    """
    groups: dict[tuple[Any, ...], list[int]] = {}
    for row in branch.rows + offset:
        key = tuple(values[row] for name, values in columns.items() if name != branch.parameter)
        groups.setdefault(key, []).append(int(row))
    curves = []
    for group in groups.values():
        group.sort(key=lambda row: float(columns[branch.parameter][row]), reverse=branch.falls)
        curve: list[tuple[int, str, float]] = []
        for row in group:
            value = float(columns[branch.parameter][row])
            if curve:
                before = curve[-1][2]
                between = int(abs(value - before) / (_STEP * max(abs(value), abs(before), 1e-300)))
                curve += [
                    (row, branch.parameter, one) for one in np.linspace(before, value, between + 2)[1:-1].tolist()
                ]
            curve.append((row, branch.parameter, value))
        curves.append(curve)
    return curves


def taken(values: Any, places: list[int]) -> Any:
    """Return the cells of a column at the given indices."""
    return values[places].copy() if isinstance(values, np.ndarray) else [values[place] for place in places]
