"""Functions that compute statistics, sensitivities, rank correlations and Pareto fronts from results of flap.
`flapwing.plot` draws pictures of distributions, sensitivities and Pareto fronts.

    >>> from flapwing import analysis
    >>> analysis.non_dominated([[1.0, 5.0], [2.0, 3.0], [2.0, 4.0]]).tolist()
    [True, True, False]

`non_dominated` requires moocore: ``pip install "flapwing[analysis]"``.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ._arguments import name_list
from ._data import Data, is_text
from ._evaluate import evaluate
from ._flapwing import correlations, printed
from ._listing import measures, params
from ._mistakes import reading, unknown
from ._results import Parameter
from ._types import Array, Design, Mask

__all__ = [
    "RankCorrelation",
    "Sensitivity",
    "Statistics",
    "describe",
    "non_dominated",
    "rank_correlations",
    "sensitivities",
]


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
        The lower and the upper value of the parameter at which the measure is computed, in SI units.
    measure : str
        The measure's name.
    base : float
        The value of the measure for the unchanged design, in the unit of the measure.
    low, high : float
        The values of the measure at the lower and at the upper value of the parameter. If the motion at the lower or at
        the upper value of the parameter is not periodic, `low` or `high` is nan.
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
        """The largest absolute change of the measure when the parameter changes from its value in the design to `below`
        or to `above`. If the motion is periodic at neither `below` nor `above`, `swing` is infinite.
        """
        changes = [abs(each - self.base) for each in (self.low, self.high) if not math.isnan(each)]
        return max(changes, default=math.inf)


def sensitivities(
    design: Design,
    measure: str,
    parameters: Mapping[str, float | tuple[float, float]] | Iterable[str] | None = None,
    *,
    change: float = 0.05,
    **fixed: Any,
) -> list[Sensitivity]:
    """Compute the change of a measure when each parameter of a design is slightly decreased and slightly increased.

    flap simulates the unchanged design, and two changed designs for each parameter: with a lower and with a higher
    value of the parameter. Only one parameter is changed at a time, together with parameters that flap computes from
    the changed parameter. For example, the bias of a preset can depend on the drive voltage.

    Parameters
    ----------
    design : str, path, dict or Grid
        A preset, or a grid with one point.
    measure : str
        A measure of the design's model, or a measure that the grid defines.
    parameters : mapping or iterable of str, optional
        The parameters to change. A mapping contains, for each parameter, a relative change such as ``0.1``, or a pair
        of values in SI units. The measure is computed at both values of the pair, which can be in any order. The
        default of `parameters` is all parameters whose value is a number other than zero. By default, flap leaves out
        parameters whose values the model computes. By default, flap also leaves out a parameter if the changed values
        are not allowed, for example because the parameter must be a whole number.
    change : float
        The relative change of each parameter for which the argument `parameters` contains no change and no pair of
        values.
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
        Raised if the design, the measure or a parameter is unknown. Raised if the change of a parameter is zero. Raised
        if the motion of the unchanged design is not periodic. Raised if the design is a grid with several points, or
        if the grid excludes a design or leaves out the measure.
    TypeError
        Raised if `parameters` is not a name, a list of names or a mapping.

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
    if len(base) != 1:
        count = f"{len(base)} points, but one is required" if len(base) else "no point: [where] excludes the design"
        raise ValueError(f"the design has {count}\ngive a preset, or a grid with one point")
    names = Data.of(base).measures()
    if measure not in names and measure in measures(design):
        raise ValueError(f"the rows of the grid have no `{measure}`\nadd it to `columns` under [output] of the grid")
    if measure not in names:
        raise unknown("measure", measure, names)
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
        if parameters is None and (len(rows) != 2 or (rows["status"] == "invalid").all()):
            continue
        if len(rows) != 2:
            raise ValueError(
                f"[where] of the grid excludes the design with `{name}` = {below:g} or {above:g}\n"
                "choose a smaller change, or remove the condition"
            )
        low, high = (float(each) for each in rows[measure])
        units = (known[name].unit, base.units.get(measure, ""))
        found.append(Sensitivity(name, value, below, above, measure, start, low, high, *units))
    return sorted(found, key=lambda each: (-each.swing, each.parameter))


def _ranges(
    known: Mapping[str, Parameter], parameters: Any, change: float, fixed: Mapping[str, Any]
) -> dict[str, float | tuple[float, float]]:
    """Return the relative change, or the lower and the upper value, of each parameter that is changed."""
    if parameters is None:
        chosen: dict[str, Any] = {
            name: change
            for name, parameter in known.items()
            if parameter.is_number and (name in fixed or parameter.value != 0.0)
        }
    elif isinstance(parameters, Mapping):
        chosen = dict(parameters)
    else:
        chosen = dict.fromkeys(_names("parameters", parameters, "hinge_stiffness"), change)
    for name, spread in chosen.items():
        if name not in known:
            raise unknown("parameter", name, known)
        if name not in fixed and not known[name].is_number:
            value = known[name].value
            if isinstance(value, float):
                raise ValueError(f"`{name}` is not set in this preset: set it, as in `{name}=…`")
            raise ValueError(f"`{name}` is {value!r}: only numbers can be changed slightly")
        if isinstance(spread, (tuple, list)) and len(spread) != 2:
            raise ValueError(f"`{name}` requires two values to run, not {len(spread)}")
        with reading(f"parameters[{name!r}]", spread, "it must be a relative change, or a pair of values in SI units"):
            values = sorted(map(float, spread)) if isinstance(spread, (tuple, list)) else [float(spread)]
        if len(values) == 2 and values[0] == values[1]:
            raise ValueError(f"both values of `{name}` are {values[0]:g}: give two different values to run")
        if len(values) == 2:
            chosen[name] = (values[0], values[1])
        elif not 0 < values[0] < math.inf:
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
        The rank correlation, from -1 to 1. At 1, the measure always rises if the parameter rises, and at -1, the
        measure always falls if the parameter rises.
    measure : str
        The measure's name.
    designs : int
        The number of designs for which the measure has a finite value.
    """

    parameter: str
    correlation: float
    measure: str
    designs: int


def rank_correlations(
    table: Any,
    measure: str | None = None,
    parameters: str | Iterable[str] | None = None,
    *,
    where: Mapping[str, Any] | None = None,
    **slices: Any,
) -> list[RankCorrelation]:
    """Compute the rank correlation (Spearman) of each parameter of a sample with a measure.

    Designs with the same value of a column get the mean of their ranks. A parameter is left out if all designs have the
    same value of the parameter. A parameter is also left out if an earlier parameter ranks the designs in the same
    order, or in exactly the opposite order.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        Results of a sample, or of a grid.
    measure : str, optional
        A column of numbers. The default of `measure` is the mean lift. If the table has no mean lift, flap chooses a
        different measure.
    parameters : str or iterable of str, optional
        The parameters whose correlation with the measure is computed. You can also give other columns of numbers. The
        default of `parameters` is all parameters of the table.
    where, **slices
        Values of columns that select rows, as in `flapwing.plot.response`. In results of a grid without a sample, all
        values of an axis are used if you select no value. If a sample is combined with an axis and you select no value
        of the axis, only the axis's middle value is used.

    Returns
    -------
    list of RankCorrelation
        The rank correlations of the parameters with the measure, in falling order of absolute value.

    Raises
    ------
    ValueError
        Raised if a column or value is unknown. Raised if no design has a value of the measure. Raised if no parameter
        varies.
    TypeError
        Raised if `parameters` is not a name or a list of names.

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
    names = _parameters(data) if parameters is None else _names("parameters", parameters, "hinge_stiffness")
    columns = [np.ascontiguousarray(data.numbers(name)) for name in names]
    found = correlations(columns, np.ascontiguousarray(values))
    if not found:
        raise ValueError("no parameter has several values in these rows: there is nothing to compare")
    return [RankCorrelation(names[place], size, measure, designs) for place, size in found]


def _names(argument: str, given: str | Iterable[str], example: str) -> list[str]:
    """Return a list of names from an argument that contains one name or several names."""
    return [given] if isinstance(given, str) else name_list(argument, given, example) or []


def _parameters(data: Data) -> list[str]:
    """Return the names of the parameters whose values are numbers. The parameters of a sample precede the parameters on
    the axes of a grid.
    """
    names = [name for name in data.parameters() if not is_text(data[name])]
    return sorted(names, key=data.on_a_grid)


@dataclass(frozen=True)
class Statistics:
    """The statistics of a measure over designs. ``str(statistics)`` returns the statistics as text.

    Attributes
    ----------
    measure : str
        The measure's name.
    unit : str
        The unit of the measure and of its statistics, or ``""`` if the measure is a pure number.
    designs : int
        The number of designs for which the measure has a finite value.
    mean : float
        The mean of the measure.
    standard_deviation : float
        The sample standard deviation (divisor ``designs - 1``). The standard deviation is nan for a single design.
    standard_error : float
        The standard error of the mean, for independently drawn designs: the standard deviation divided by the square
        root of `designs`. For a Latin hypercube or a Sobol' sequence, `standard_error` is an upper estimate. For a
        grid, `standard_error` has no meaning.
    smallest, largest : float
        The smallest and the largest value of the measure.
    percentiles : dict of float to float
        The chosen percentiles of the measure. The keys of the dictionary are percentages from 0 to 100.
    """

    measure: str
    unit: str
    designs: int
    mean: float
    standard_deviation: float
    standard_error: float
    smallest: float
    largest: float
    percentiles: dict[float, float]

    def __str__(self) -> str:
        unit = f" {printed(self.unit)}" if self.unit else ""
        shown = ", ".join(f"{percent:g} %: {value:.4g}" for percent, value in self.percentiles.items())
        designs = f"{self.designs} designs" + (f"; {shown}" if shown else "")
        return f"{self.measure}: {self.mean:.4g} ± {self.standard_deviation:.2g}{unit} ({designs})"


def percentages(given: Any) -> list[float]:
    """Return the given percentages in rising order. Raise ValueError if a percentage is not from 0 to 100."""
    with reading("percentiles", given, "it must be a list of percentages, such as [5, 50, 95]"):
        chosen = sorted(dict.fromkeys(given))
        outside = [percent for percent in chosen if not 0 <= percent <= 100]
    if outside:
        raise ValueError(f"`percentiles` has {outside[0]:g}\npercentages are from 0 to 100")
    return chosen


def statistics(measure: str, unit: str, values: Array, percentiles: Sequence[float]) -> Statistics:
    """Return the statistics of the values of a measure. The array `values` must contain at least one number, and only
    finite numbers.
    """
    deviation = float(values.std(ddof=1)) if len(values) > 1 else math.nan
    return Statistics(
        measure=measure,
        unit=unit,
        designs=len(values),
        mean=float(values.mean()),
        standard_deviation=deviation,
        standard_error=deviation / math.sqrt(len(values)),
        smallest=float(values.min()),
        largest=float(values.max()),
        percentiles={percent: float(np.percentile(values, percent)) for percent in percentiles},
    )


def describe(
    table: Any,
    measures: str | Iterable[str] | None = None,
    *,
    percentiles: Iterable[float] = (5.0, 50.0, 95.0),
    where: Mapping[str, Any] | None = None,
    **slices: Any,
) -> dict[str, Statistics]:
    """Compute mean, standard deviation, standard error and percentiles of measures over designs.

    The statistics leave out designs without a periodic motion and values that are not finite.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        Results of a sample, or of a grid.
    measures : str or iterable of str, optional
        Columns of numbers. The default of `measures` is all measures of the table.
    percentiles : iterable of float, optional
        Percentages from 0 to 100. If a percentile is between the values of two designs, the percentile is interpolated
        linearly, as in the command ``flap describe``.
    where, **slices
        Values of columns that select rows, as in `flapwing.plot.response`. In results of a grid without a sample, all
        values of an axis are used if you select no value. If a sample is combined with an axis and you select no value
        of the axis, only the axis's middle value is used.

    Returns
    -------
    dict of str to Statistics
        The statistics of each measure, in the order of `measures`. If you do not give `measures`, measures that have no
        finite value are left out.

    Raises
    ------
    ValueError
        Raised if a column or value is unknown. Raised if no design has a value of a measure that you give. Raised if a
        percentage is not from 0 to 100.
    TypeError
        Raised if `measures` is not a name or a list of names.

    Examples
    --------
    >>> import numpy as np
    >>> found = describe({"lift_mean_mn": np.array([1.0, 2.0, 3.0, 4.0])}, percentiles=[50])
    >>> found["lift_mean_mn"].mean, found["lift_mean_mn"].percentiles
    (2.5, {50: 2.5})
    >>> print(found["lift_mean_mn"])
    lift_mean_mn: 2.5 ± 1.3 mN (4 designs; 50 %: 2.5)
    """
    data = Data.of(table).slice(where, slices).one_sample()
    chosen = percentages(percentiles)
    names = data.measures() if measures is None else _names("measures", measures, "lift_mean_mn")
    found = {}
    for name in names:
        values = np.where(data.measured(), data.numbers(name), np.nan)
        values = values[np.isfinite(values)]
        if len(values):
            found[name] = statistics(name, data.unit(name), values, chosen)
        elif measures is not None:
            raise ValueError(f"no row has a number for `{name}`")
    return found


def non_dominated(costs: Any) -> Mask:
    """Return a mask of the Pareto front: the points that no other point dominates. In every column of `costs`, a
    smaller cost is better.

    Point A dominates point B if no cost is larger for A than for B, and at least one cost is smaller for A. Equal
    points do not dominate each other.

    Parameters
    ----------
    costs : array_like, shape (n, k)
        The costs, with one row for each of n points and one column for each of k objectives. If a larger value of an
        objective is better, change the sign of the objective.

    Returns
    -------
    ndarray of bool, shape (n,)
        True for the points of the Pareto front. A point with a cost of NaN is not on the front.

    Raises
    ------
    ValueError
        Raised if `costs` is not two-dimensional.
    ImportError
        Raised if moocore is not installed.

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
