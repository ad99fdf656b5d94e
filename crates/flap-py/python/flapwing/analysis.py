"""Sensitivities, rank correlations and Pareto fronts of results. `flapwing.plot` draws pictures of these results.

    >>> from flapwing import analysis
    >>> analysis.non_dominated([[1.0, 5.0], [2.0, 3.0], [2.0, 4.0]]).tolist()
    [True, True, False]

`non_dominated` requires moocore: ``pip install "flapwing[analysis]"``.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ._data import Data, is_text
from ._evaluate import evaluate
from ._flapwing import correlations
from ._listing import measures, params
from ._mistakes import unknown
from ._results import Parameter
from ._types import Mask

__all__ = ["RankCorrelation", "Sensitivity", "non_dominated", "rank_correlations", "sensitivities"]


@dataclass(frozen=True)
class Sensitivity:
    """The sensitivity of a measure to one parameter: the values of the measure at a lower and at a higher value of the
    parameter.

    Attributes
    ----------
    parameter : str
        The parameter's name.
    value : float
        The parameter's value in the design, in SI units.
    below, above : float
        The lower and the upper value of the parameter at which the measure was computed, in SI units.
    measure : str
        The measure's name.
    base : float
        The value of the measure for the unchanged design, in the unit of the measure.
    low, high : float
        The values of the measure at the lower and at the upper value of the parameter; nan without a periodic motion.
    unit, measure_unit : str
        The units of the parameter and of the measure.
    """

    parameter: str
    value: float
    below: float
    above: float
    measure: str
    base: float
    low: float
    high: float
    unit: str
    measure_unit: str

    @property
    def swing(self) -> float:
        """The larger absolute value of the two changes of the measure; infinite if both changes are unknown."""
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
    """Decrease and increase each parameter of a design slightly, and compute the changes of a measure.

    Two points are run for each parameter, and one point for the unchanged design. All other parameters keep their
    values, except parameters that follow the changed parameter, as the bias follows the voltage.

    Parameters
    ----------
    design : str
        A preset.
    measure : str
        A measure of its model.
    parameters : mapping or iterable of str, optional
        The parameters to change. A mapping gives each parameter its own relative change, or the two values to compute
        (in SI units). Default: all parameters with a number that is not zero. Parameters that follow other parameters,
        and parameters that cannot have the changed values, such as whole numbers, are left out.
    change : float
        The relative change of parameters for which `parameters` gives no change.
    **fixed
        Parameters of the design that differ from the preset: numbers in SI units, text with a unit, or options. You can
        also give solver settings, as for `flapwing.evaluate`.

    Returns
    -------
    list of Sensitivity
        The sensitivities, in falling order of `swing`.

    Raises
    ------
    ValueError
        The design, the measure or a parameter is unknown; a change is zero; the motion of the design is not periodic.

    Examples
    --------
    >>> (found,) = sensitivities("ozaki2018-large", "lift_mean_mn", {"drive_voltage_pp": 0.1})
    >>> found.high > found.base > found.low
    True
    """
    known = params(design)
    ranges = _ranges(known, parameters, change, fixed)
    # If a parameter is both fixed and changed, its value is read from the row of the design.
    both = {name: value for name, value in fixed.items() if name in ranges}
    others = {name: value for name, value in fixed.items() if name not in ranges}
    free = (name for name, each in known.items() if each.is_number and name not in fixed)
    base = evaluate(design, both or {(name := next(free)): known[name].value}, **others)
    if measure not in base:
        raise unknown("measure", measure, measures(design))
    start = float(base[measure][0])
    if math.isnan(start):
        raise ValueError(f"the unchanged design has no {measure}: its motion is {base['status'][0]}")
    found = []
    for name, spread in ranges.items():
        value = float(base[name][0]) if name in both else float(known[name].value)
        below, above = spread if isinstance(spread, tuple) else sorted((value * (1 - spread), value * (1 + spread)))
        if below == above and parameters is None:
            continue
        if below == above:
            raise ValueError(f"`{name}` is {value:g}, so a relative change has no effect: give the two values to run")
        unchanged = {other: given for other, given in fixed.items() if other != name}
        rows = evaluate(design, {name: np.array([below, above])}, **unchanged)
        if parameters is None and (rows["status"] == "invalid").all():
            continue
        low, high = (float(each) for each in rows[measure])
        units = (known[name].unit, base.units.get(measure, ""))
        found.append(Sensitivity(name, value, below, above, measure, start, low, high, *units))
    return sorted(found, key=lambda each: (-each.swing, each.parameter))


def _ranges(
    known: Mapping[str, Parameter], parameters: Any, change: float, fixed: Mapping[str, Any]
) -> dict[str, float | tuple[float, float]]:
    """Return the relative change or the two values of each parameter."""
    if parameters is None:
        chosen: dict[str, Any] = {
            name: change
            for name, parameter in known.items()
            if parameter.is_number and (name in fixed or parameter.value != 0.0)
        }
    elif isinstance(parameters, Mapping):
        chosen = dict(parameters)
    else:
        chosen = dict.fromkeys([parameters] if isinstance(parameters, str) else parameters, change)
    for name, spread in chosen.items():
        if name not in known:
            raise unknown("parameter", name, known)
        if name not in fixed and not known[name].is_number:
            value = known[name].value
            if isinstance(value, float):
                raise ValueError(f"`{name}` is not set in this preset: set it, as in `{name}=…`")
            raise ValueError(f"`{name}` is {value!r}: only numbers can be changed slightly")
        if isinstance(spread, (tuple, list)):
            if len(spread) != 2:
                raise ValueError(f"`{name}` requires two values to run, not {len(spread)}")
            chosen[name] = (float(spread[0]), float(spread[1]))
        elif not 0 < float(spread) < math.inf:
            raise ValueError(f"the change of `{name}` must be more than zero, not {spread}")
    return chosen


@dataclass(frozen=True)
class RankCorrelation:
    """The rank correlation (Spearman) of a parameter with a measure.

    Attributes
    ----------
    parameter : str
        The parameter's name.
    correlation : float
        The correlation, from -1 (a larger parameter always gives a smaller measure) to 1 (a larger parameter always
        gives a larger measure).
    measure : str
        The measure's name.
    designs : int
        The number of designs that have the measure.
    """

    parameter: str
    correlation: float
    measure: str
    designs: int


def rank_correlations(
    table: Any,
    measure: str | None = None,
    parameters: Iterable[str] | None = None,
    *,
    where: Mapping[str, Any] | None = None,
    **slices: Any,
) -> list[RankCorrelation]:
    """Compute the rank correlation (Spearman) of each parameter of a sample with a measure.

    Equal values get the mean of their ranks. A parameter is left out if all designs have the same value. A parameter is
    also left out if it ranks the designs in the order, or the reverse order, of an earlier parameter.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        Results of a sample, or of a grid.
    measure : str, optional
        A column of numbers. Default: the mean lift, or another measure if the table has no mean lift.
    parameters : iterable of str, optional
        The parameters to correlate, or other columns of numbers. Default: all parameters of the table.
    where, **slices
        The selection of rows, as for `flapwing.plot.histogram`.

    Returns
    -------
    list of RankCorrelation
        Correlations in falling order of absolute value.

    Raises
    ------
    ValueError
        A column or value is unknown; no design has the measure; no parameter varies.

    Examples
    --------
    >>> import numpy as np
    >>> table = {
    ...     "hinge_stiffness": np.array([1.0, 2.0, 3.0, 4.0]),
    ...     "status": np.array(["periodic"] * 4),
    ...     "lift_mean_mn": np.array([9.0, 7.0, 8.0, 5.0]),
    ... }
    >>> [(found.parameter, round(found.correlation, 2)) for found in rank_correlations(table)]
    [('hinge_stiffness', -0.8)]
    """
    data = Data.of(table).slice(where, slices).one_sample()
    measure = data.usual("benefit", "measure") if measure is None else measure
    values = np.where(data.measured(), data.numbers(measure), np.nan)
    designs = int(np.isfinite(values).sum())
    if not designs:
        raise ValueError(f"no row has a number for `{measure}`")
    names = _parameters(data) if parameters is None else list(parameters)
    columns = [np.ascontiguousarray(data.numbers(name)) for name in names]
    found = correlations(columns, np.ascontiguousarray(values))
    if not found:
        raise ValueError("no parameter has several values in these rows: there is nothing to compare")
    return [RankCorrelation(names[place], size, measure, designs) for place, size in found]


def _parameters(data: Data) -> list[str]:
    """Return the parameters that are numbers, with sampled parameters first."""
    names = [name for name in data.parameters() if not is_text(data[name])]
    return sorted(names, key=data.on_a_grid)


def non_dominated(costs: Any) -> Mask:
    """Return a mask of the points that no other point dominates. In every column, smaller values are better.

    One point dominates another point if no column is larger and at least one column is smaller. Equal points do not
    dominate each other.

    Parameters
    ----------
    costs : array_like, shape (n, k)
        One row per point and one column per objective, k >= 1. Change the sign of objectives that should be large.

    Returns
    -------
    ndarray of bool, shape (n,)
        True for the points of the front; False if a cost is NaN.

    Raises
    ------
    ValueError
        `costs` is not two-dimensional.
    ImportError
        moocore is not installed.

    Examples
    --------
    >>> non_dominated([[1.0, 5.0], [2.0, 3.0], [2.0, 4.0], [3.0, 3.0]]).tolist()
    [True, True, False, False]
    """
    try:
        import moocore
    except ImportError:
        raise ImportError(
            'non_dominated requires moocore: pip install "flapwing[analysis]", or pip install moocore'
        ) from None
    costs = np.asarray(costs, dtype=float)
    if costs.ndim != 2 or costs.shape[1] < 1:
        raise ValueError(f"costs must have shape (n, k), not {costs.shape}")
    front: Mask = ~np.isnan(costs).any(axis=1)
    if front.any():
        front[front] = moocore.is_nondominated(costs[front], keep_weakly=True)
    return front
