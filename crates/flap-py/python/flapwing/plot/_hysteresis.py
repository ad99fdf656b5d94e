"""A picture of the hysteresis of a response, with the branches `up`, `down` and `unstable`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from .. import _flapwing
from .._data import Data, Shown, distinct, listed
from . import _style
from ._checks import checked


@checked
def hysteresis(
    table: Any,
    y: str | None = None,
    *,
    parameter: str | None = None,
    curve: int | None = None,
    where: Mapping[str, Any] | None = None,
    legend: bool | str = True,
    ax: Axes | None = None,
    **slices: Any,
) -> _style.Drawn:
    """Draw the branches `up` and `down` of a response. If the table contains the branch `unstable`, the picture also
    shows this branch.

    An arrowhead on each branch shows the direction in which the parameter changes. Vertical arrows show jumps from
    branch to branch. Bistable bands are shaded.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        Results of `flapwing.respond` or ``flap respond --out``.
    y : str, optional
        The measure to draw. The default of `y` is the peak-to-peak stroke.
    parameter : str, optional
        The parameter that rises or falls along the branches, on the horizontal axis. The default of `parameter` is the
        parameter that `flapwing.respond` changed.
    curve : int, optional
        The number of one design in the column ``curve``, if the table contains several designs.
    where, **slices
        Values of columns that select rows, as in `flapwing.plot.response`.
    legend, ax
        These arguments have the same meaning as in `flapwing.plot.response`.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    ValueError
        Raised if the table contains several designs, and you do not select one. Raised if a column or value is unknown.
        Raised if the table contains neither the branch `up` nor the branch `down`.
    """
    data = Data.of(table)
    if "branch" not in data or "bistable" not in data:
        raise ValueError("the table must be a result of `respond`, with the columns `branch` and `bistable`")
    data = data.slice(where, slices)
    if curve is not None:
        data = data.slice({"curve": curve}, {})
    _one_design(data)
    y = data.usual("response", "y") if y is None else y
    data.numbers(y)
    parameter = parameter or data.followed() or "drive_frequency"
    data.numbers(parameter)
    x, shown = data.shown(parameter), data.shown(y)
    values = np.where(data.measured(), shown.values, np.nan)
    names = data["branch"].astype(str)
    bistable = data.numbers("bistable") == 1.0
    rows = {name: names == name for name in ("up", "down", "unstable")}
    branches = {name: _Branch(x.values[mask], values[mask], bistable[mask]) for name, mask in rows.items()}
    up, down = branches["up"], branches["down"]
    if not up.x.size and not down.x.size:
        raise ValueError("the table has neither a branch up nor a branch down")
    bands, (up.jumps, down.jumps) = _flapwing.ways((up.x, up.y, up.bistable), (down.x, down.y, down.bistable))

    given = ax is not None
    with _style.applied(ax):
        ax = _style.axes_of(ax)
        for i, (low, high) in enumerate(bands):
            ends = f", {low:.7g} to {high:.7g} {x.unit}".rstrip() if len(bands) == 1 and not given else ""
            text = f"bistable{ends}"
            ax.axvspan(low, high, color=_style.BISTABLE, alpha=0.75, linewidth=0, label=text if i == 0 else f"_{text}")
        # The branch down often coincides with the branch up, so the line below is wider.
        for name, width in (("up", 1.9), ("down", 0.8)):
            colour = _style.BRANCHES[name]
            branch = branches[name]
            if not branch.x.size:
                continue
            xs, ys = _with_gaps(branch.x, branch.y, branch.jumps)
            ax.plot(
                xs,
                ys,
                color=colour,
                linewidth=_style.width(width),
                marker="o",
                markersize=_style.size(0.6 if name == "up" else 0.4),
                label=name,
            )
            for i in branch.jumps:
                _jump(ax, branch, i, colour)
            _arrow_along(ax, branch, colour, bands)
        unstable = branches["unstable"]
        if unstable.x.size:
            ax.plot(
                unstable.x,
                unstable.y,
                color=_style.BRANCHES["unstable"],
                linewidth=_style.width(0.75),
                linestyle=(0, (4, 2.5)),
                label="unstable",
            )
        _mark_missing(ax, data, x, names)
        ax.set_xlabel(x.label)
        ax.set_ylabel(shown.label)
        ax.margins(x=0.02, y=0.08)
        _style.legend(ax, legend, given, ncols=2, borderaxespad=0.1)
    return ax


class _Branch:
    """The rows of a branch, in the order in which they were computed."""

    def __init__(self, x: np.ndarray, y: np.ndarray, bistable: np.ndarray) -> None:
        self.x, self.y = np.ascontiguousarray(x, float), np.ascontiguousarray(y, float)
        self.bistable = np.ascontiguousarray(bistable)
        #: The indices of the rows after which the branch jumps to a different motion.
        self.jumps: list[int] = []


def _one_design(data: Data) -> None:
    """Raise ValueError if the results contain several designs. The error message lists the parameters that differ
    between the designs.
    """
    if "curve" not in data:
        return
    curves = distinct(data["curve"])
    if len(curves) < 2:
        return
    names = list(data.columns)
    varied = [name for name in names[names.index("curve") + 1 : names.index("branch")] if len(distinct(data[name])) > 1]
    lines = [f"  {data.described(name)}: {listed(distinct(data[name]))}" for name in varied]
    raise ValueError(
        "\n".join([f"choose one of {len(curves)} designs: curve={curves[0]:g}, or by its parameters", *lines])
    )


def _with_gaps(x: np.ndarray, y: np.ndarray, after: list[int]) -> tuple[np.ndarray, np.ndarray]:
    """Return the points of a line. The line has a gap after each point whose index is in `after`."""
    places = [i + 1 for i in after]
    return np.insert(x, places, np.nan), np.insert(y, places, np.nan)


def _jump(ax: Axes, branch: _Branch, i: int, colour: str) -> None:
    """Draw a light vertical arrow where a branch jumps to a different motion, halfway between the rows before and after
    the jump.
    """
    x = 0.5 * (branch.x[i] + branch.x[i + 1])
    before, after = (x, branch.y[i]), (x, branch.y[i + 1])
    look = {"arrowstyle": "->", "color": colour, "linestyle": (0, (3, 3)), "alpha": 0.7, "shrinkA": 0, "shrinkB": 0}
    ax.annotate("", xy=after, xytext=before, arrowprops={**look, "linewidth": _style.width(0.5)})


def _arrow_along(ax: Axes, branch: _Branch, colour: str, bands: list[tuple[float, float]]) -> None:
    """Draw an arrowhead on the line of a branch. The arrowhead is in the widest bistable band. Without a bistable band,
    the arrowhead is at a third of the branch's length.
    """
    count = len(branch.x)
    if count < 3:
        return
    place = count // 3
    if bands:
        low, high = max(bands, key=lambda band: band[1] - band[0])
        place = int(np.argmin(np.abs(branch.x - 0.5 * (low + high))))
    i = min(max(place, 1), count - 2)
    if not np.isfinite(branch.y[i - 1 : i + 2]).all() or {i - 1, i} & set(branch.jumps):
        return
    head = {
        "arrowstyle": "-|>",
        "color": colour,
        "linewidth": 0,
        "mutation_scale": _style.size(3.0),
        "shrinkA": 0,
        "shrinkB": 0,
    }
    ax.annotate("", xy=(branch.x[i + 1], branch.y[i + 1]), xytext=(branch.x[i - 1], branch.y[i - 1]), arrowprops=head)


def _mark_missing(ax: Axes, data: Data, x: Shown, names: np.ndarray) -> None:
    """Draw marks at the upper edge of the axes, at those values of the parameter at which a branch has no periodic
    motion.
    """
    without = ~data.measured()
    shown = False
    for place, name in enumerate(("up", "down")):
        mask = without & (names == name)
        if mask.any():
            label = "_" if shown else "no periodic motion"
            _style.marks(
                ax,
                x.values[mask],
                0.985 - 0.025 * place,
                markersize=_style.size(0.8),
                color=_style.BRANCHES[name],
                label=label,
            )
            shown = True
