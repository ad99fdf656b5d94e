"""Changes of a measure with each parameter."""

from __future__ import annotations

import math
import os
from typing import Any, Iterable, Mapping, NamedTuple, Sequence

import numpy as np
from matplotlib.axes import Axes

from .._mistakes import refused, unknown
from . import _correlations, _labels, _legend, _style
from ._checks import checked
from ._docs import completed


class Sensitivity(NamedTuple):
    """The change of a measure with one parameter; numbers are in SI units, and in the measure's own."""

    parameter: str
    """The parameter's name."""
    value: float
    """Its value in the design."""
    below: float
    """The lower value tried."""
    above: float
    """The upper value tried."""
    measure: str
    """The measure's name."""
    base: float
    """The measure of the design itself."""
    low: float
    """The measure with the lower value; NaN if there is no periodic motion."""
    high: float
    """The measure with the upper value; NaN if there is no periodic motion."""
    unit: str
    """The parameter's unit."""
    measure_unit: str
    """The measure's unit."""

    @property
    def swing(self) -> float:
        """The larger of the two changes of the measure, without its sign; infinite if both are unknown."""
        changes = [abs(each - self.base) for each in (self.low, self.high) if not math.isnan(each)]
        return max(changes, default=math.inf)


def sensitivities(
    design: str,
    measure: str,
    parameters: Mapping[str, float | tuple[float, float]] | Iterable[str] | None = None,
    *,
    change: float = 0.05,
    **fixed: Any,
) -> list[Sensitivity]:
    """Change each parameter of a design slightly, down and up, and compute the change of a measure.

    Two points are run for each parameter, and one for the design. All other parameters stay as they are, except those
    that follow the one that is changed, such as the bias that follows the voltage.

    Parameters
    ----------
    design : str
        A preset.
    measure : str
        A measure of its model.
    parameters : mapping or iterable of str, optional
        The parameters to change; in a mapping, each with its own relative change or with the two values to try (SI).
        By default all numbers that are not zero, except those that follow others and those that cannot take such
        values, such as whole numbers.
    change : float
        The relative change of parameters that have none of their own.
    **fixed
        Parameters of the design that differ from the preset: numbers in SI units, text with a unit, or options.
        Solver settings, as for `flapwing.evaluate`.

    Returns
    -------
    list of Sensitivity
        By falling `swing`.

    Raises
    ------
    ValueError
        Unknown design, measure or parameter; a change of zero; a design whose motion is not periodic.
    """
    import flapwing

    known = flapwing.params(design)
    ranges = _ranges(known, parameters, change, fixed)
    # A parameter that is both given and changed has its number from the row of the design itself.
    both = {name: value for name, value in fixed.items() if name in ranges}
    others = {name: value for name, value in fixed.items() if name not in ranges}
    free = (name for name, each in known.items() if isinstance(each.value, float) and name not in fixed)
    base = flapwing.evaluate(design, both or {(name := next(free)): known[name].value}, **others)
    if measure not in base:
        raise unknown("measure", measure, flapwing.measures(design))
    start = float(base[measure][0])
    if math.isnan(start):
        raise ValueError(f"the design itself has no {measure}: its motion is {base['status'][0]}")
    found = []
    for name, spread in ranges.items():
        value = float(base[name][0]) if name in both else _number(known[name].value)
        below, above = spread if isinstance(spread, tuple) else sorted((value * (1 - spread), value * (1 + spread)))
        if below == above and parameters is None:
            continue
        if below == above:
            raise ValueError(f"`{name}` is {value:g}, which no relative change alters: give the two values to try")
        unchanged = {other: given for other, given in fixed.items() if other != name}
        rows = flapwing.evaluate(design, {name: np.array([below, above])}, **unchanged)
        if parameters is None and (rows["status"] == "invalid").all():
            continue
        low, high = (float(each) for each in rows[measure])
        units = (known[name].unit, base.units.get(measure, ""))
        found.append(Sensitivity(name, value, below, above, measure, start, low, high, *units))
    return sorted(found, key=lambda each: (-each.swing, each.parameter))


@checked
@completed
def tornado(
    design: Any,
    measure: str | None = None,
    parameters: Mapping[str, float | tuple[float, float]] | Iterable[str] | None = None,
    *,
    change: float = 0.05,
    top: int = 12,
    legend: bool | str = True,
    ax: Axes | None = None,
    **fixed: Any,
) -> _style.Drawn:
    """Draw how a measure changes with each parameter, as bars in the order of their length.

    Of a preset, each parameter is changed by a little. Of a sample, bars show the rank correlation (Spearman) of each
    parameter with the measure, from -1 to 1.

    Parameters
    ----------
    design : str; sequence of Sensitivity; Table, data frame, mapping of columns, or path
        A preset; or the result of `sensitivities`, and then no points are run; or the results of a sample.
    measure, parameters, change, **fixed
        As for `sensitivities`. Of a sample, as for `rank_correlations`, without `change`.
    top : int
        The largest number of parameters that are drawn.
    %(legend)s
    %(axes)s
        The horizontal axis is the change of the measure in percent of the design's own, or the correlation.

    Raises
    ------
    ValueError
        As `sensitivities` and `rank_correlations`; no sensitivities; a measure that is zero for the design itself.
    """
    if _is_table(design):
        names = None if parameters is None else list(parameters)
        return _correlations.draw(_correlations.rank_correlations(design, measure, names, **fixed), top, ax)
    if isinstance(design, str):
        if measure is None:
            raise TypeError("`measure` is needed: a measure of the model, such as lift_mean_mn")
        found = sensitivities(design, measure, parameters, change=change, **fixed)
    else:
        for each in design:
            if not isinstance(each, Sensitivity):
                allowed = "it must be a preset, the result of `sensitivities`, or results of a sample"
                raise refused("design", design, allowed)
        found = sorted(design, key=lambda each: (-each.swing, each.parameter))
    if not found:
        raise ValueError("there are no sensitivities to draw")
    base = found[0].base
    if base == 0:
        raise ValueError(f"{found[0].measure} is zero for the design itself: its changes have no percentage")
    shown = found[:top]
    low = np.array([100.0 * (each.low - base) / abs(base) for each in shown])
    high = np.array([100.0 * (each.high - base) / abs(base) for each in shown])
    places = np.arange(len(shown))

    given = ax is not None
    with _style.style(ax):
        ax = _style.axes_of(ax, 6.8, 1.5 + 0.32 * len(shown))
        ax.grid(False, axis="y")
        less, more = _names_of_changes(shown)
        # If both changes go the same way, the shorter bar lies on the longer one and is thinner.
        within = np.where(low * high > 0, np.sign(np.abs(low) - np.abs(high)), 0.0)
        for ends, thin, colour, name in ((low, within < 0, _style.BLUE, less), (high, within > 0, _style.ORANGE, more)):
            bars = ax.barh(places, ends, height=np.where(thin, 0.28, 0.62), color=colour, label=name)
            for bar, above in zip(bars, thin):
                bar.set_zorder(1.6 if above else 1.5)
        ax.axvline(0.0, color=_style.ink(ax), linewidth=_style.width(0.6))
        ax.set_yticks(places, labels=[_named(each) for each in shown])
        ax.tick_params(axis="y", length=0)
        ax.set_ylim(len(shown) - 0.4, -0.6)
        unit = _labels.printed(shown[0].measure_unit)
        words = _labels.words(shown[0].measure, shown[0].measure_unit)
        ax.set_xlabel(
            f"Change of {_labels.lowered(words)} (% of {_labels.number(base)} {unit})".replace(" )", ")")
        )
        for place, each in enumerate(shown):
            missing = [name for name, value in ((less, each.low), (more, each.high)) if math.isnan(value)]
            if missing:
                ax.annotate(
                    f"no periodic motion at {' and '.join(missing)}",
                    (0.0, place),
                    xytext=(4, 0),
                    textcoords="offset points",
                    va="center",
                    fontsize="small",
                    color=_style.ink(ax),
                )
        rest = len(found) - len(shown)
        left = f"; {rest} smaller {'one' if rest == 1 else 'ones'} not shown" if rest else ""
        title = f"each parameter alone{left}"
        _legend.legend(ax, legend, given, ncols=2, borderaxespad=0.1, title=title, alignment="left")
    return ax


def _is_table(design: Any) -> bool:
    """True for results: a table of any kind, or the path of a file, whose name has an ending."""
    if isinstance(design, str):
        return bool(os.path.splitext(design)[1])
    return isinstance(design, os.PathLike) or not isinstance(design, Sequence)


def _ranges(
    known: Mapping[str, Any], parameters: Any, change: float, fixed: Mapping[str, Any]
) -> dict[str, float | tuple[float, float]]:
    """The relative change, or the two values, of each parameter."""
    if parameters is None:
        chosen: dict[str, Any] = {
            name: change
            for name, parameter in known.items()
            if isinstance(parameter.value, float) and (name in fixed or parameter.value != 0.0)
        }
    elif isinstance(parameters, Mapping):
        chosen = dict(parameters)
    else:
        chosen = dict.fromkeys([parameters] if isinstance(parameters, str) else parameters, change)
    for name, spread in chosen.items():
        if name not in known:
            raise unknown("parameter", name, known)
        if name not in fixed and not isinstance(known[name].value, float):
            value = known[name].value
            if value is None:
                raise ValueError(f"`{name}` is not set in this preset: give it a value, as in `{name}=…`")
            raise ValueError(f"`{name}` is {value!r}: only numbers can be changed by a little")
        if isinstance(spread, (tuple, list)):
            if len(spread) != 2:
                raise ValueError(f"`{name}` needs two values to try, not {len(spread)}")
            chosen[name] = (float(spread[0]), float(spread[1]))
        elif not 0 < float(spread) < math.inf:
            raise ValueError(f"the change of `{name}` must be more than zero, not {spread}")
    return chosen


def _number(value: float | str | None) -> float:
    assert isinstance(value, float), "`_ranges` lets numbers alone pass"
    return value


def _named(each: Sensitivity) -> str:
    """A parameter with its value in the design."""
    factor, unit = _labels.readable([each.value], each.unit)
    value = f"{_labels.number(each.value * factor)} {unit}".strip()
    return f"{_labels.words(each.parameter, each.unit)}, {value}"


def _names_of_changes(shown: Sequence[Sensitivity]) -> tuple[str, str]:
    """The names of the two changes: their size, if it is the same for all parameters."""
    sizes = {
        round(abs(end - each.value) / abs(each.value), 9)
        for each in shown
        for end in (each.below, each.above)
        if each.value != 0
    }
    if len(sizes) == 1 and all(each.value != 0 for each in shown):
        percent = _labels.number(100.0 * sizes.pop())
        return f"−{percent} %", f"+{percent} %"
    return "lower value", "upper value"
