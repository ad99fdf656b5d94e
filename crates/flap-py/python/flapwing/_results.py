"""Classes of results other than tables: rows, optima, resonances, and the parameters, measures and states of a
design."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from typing import Any

from ._mistakes import unknown


def _same(one: Any, other: Any) -> bool:
    """Return True if two values are equal, or if both values are nan."""
    return bool(one == other or (one != one and other != other))


class _Result:
    """The base class of results. Two results are equal if all attributes of the two results are equal. Two values of
    nan count as equal.
    """

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return all(_same(value, getattr(other, name)) for name, value in vars(self).items())


@dataclass(frozen=True, eq=False)
class Row(Mapping[str, Any]):
    """The results of one design point.

    ``row["lift_mean_mn"]`` is the value of a column. A column is a measure, or one of the attributes in the list below.
    ``dict(row)`` has all columns. The order of the columns is the same for every point of a model.

    Attributes
    ----------
    status : str
        ``"periodic"``; ``"subharmonic"`` (repeats every 2 to 8 drive periods); ``"unsettled"`` (not settled after
        `max_cycles` drive periods); ``"diverged"``; ``"step_limit"`` (`max_steps` steps in one drive period, or steps
        too small to advance time); ``"invalid"`` (each parameter is in range, but the combination of parameter values
        is impossible).
    measures : dict of str to float
        The measures by name. A name consists of quantity, kind of measure and unit, such as ``stroke_pp_deg`` or
        ``lift_mean_mn``. The measures that ``[measure]`` of the grid defines come after the measures of the model. A
        measure that is a condition has the type bool. If the status is not ``"periodic"``, all measures are nan. A
        ratio of zero to zero, such as the efficiency at zero power, is nan.
    cycles : int
        Number of drive periods that were integrated, including the periods from which the measures and the error
        estimate are computed.
    residual : float
        Change of the state over the last period of the motion, relative to the typical size of each state. `residual`
        is nan if no period was completed.
    period : int
        Number of drive periods after which the motion repeats: 1 for a periodic motion, 2 to 8 for a subharmonic
        motion, otherwise 0.
    floquet_max : float
        Largest magnitude of a Floquet multiplier. After many periods, a small disturbance of the motion grows or decays
        by the factor `floquet_max` in each period of the orbit. `floquet_max` is nan if no orbit was found, and for a
        wing at rest.
    stable : bool or float
        True if `floquet_max` is below 1. After a small disturbance, a stable motion returns to the orbit. A wing at
        rest is stable. `stable` is nan if no orbit was found.
    error_estimate : float
        Estimate of the relative error of the integration: the largest error of stroke, pitch, mean lift and mean power.
        Without a periodic motion, `error_estimate` is nan. If no estimate is possible, `error_estimate` is infinite.
    rhs_evals : int
        Number of evaluations of the equations of motion.
    reason : str
        The reason why the point is invalid. The reason is ``""`` if the point is valid.
    """

    status: str
    measures: dict[str, float]
    cycles: int
    residual: float
    period: int
    floquet_max: float
    stable: bool | float
    error_estimate: float
    rhs_evals: int
    reason: str

    def __getitem__(self, key: str) -> Any:
        if key in self.measures:
            return self.measures[key]
        if key in _ATTRIBUTES:
            return getattr(self, key)
        raise unknown("column", key, self)

    def __iter__(self) -> Iterator[str]:
        yield "status"
        yield from self.measures
        yield from _ATTRIBUTES[1:]

    def __len__(self) -> int:
        return len(self.measures) + len(_ATTRIBUTES)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Mapping):
            return NotImplemented
        # Rows of the same point are equal; unknown values count as equal.
        return list(self) == list(other) and all(_same(self[key], other[key]) for key in self)

    def _repr_html_(self) -> str:
        """Return the columns as HTML, for notebooks."""
        from html import escape

        cells = "".join(
            f"<tr><th>{escape(key)}</th><td>{escape(cell_text(value))}</td></tr>" for key, value in self.items()
        )
        return f"<table>{cells}</table>"


#: The columns of a row that are not measures.
_ATTRIBUTES = tuple(one.name for one in fields(Row) if one.name != "measures")


def cell_text(value: Any) -> str:
    """Return the value of a cell as text, for notebooks."""
    return f"{value:.6g}" if isinstance(value, float) else str(value)


@dataclass(frozen=True, eq=False)
class Parameter(_Result):
    """A parameter of a model.

    Attributes
    ----------
    name : str
        Name of the parameter in grids, on the command line and as a keyword.
    value : float or str
        Value of the parameter in the design, in SI units, or the name of the chosen option. For a grid, `value` is the
        value at the first point. If a search computes the value for each point, for example the drive frequency of a
        resonance, `value` is nan. `value` is also nan if the parameter is not set, so that the model computes the
        value. For a model without a design, the values of all parameters are nan.
    unit : str
        SI unit of the parameter, or ``""`` for pure numbers and options.
    symbol : str
        Symbol of the parameter in the paper, or ``""`` if the paper has no symbol.
    doc : str
        Meaning and source of the parameter in one line.
    allowed : str
        The allowed values of the parameter, as text.
    options : tuple of str
        Names of the options of a parameter with a choice of options. `options` is empty for a parameter without
        options.
    """

    name: str
    value: float | str
    unit: str
    symbol: str
    doc: str
    allowed: str
    options: tuple[str, ...]

    @property
    def is_number(self) -> bool:
        """True if the value of the parameter is a number and is set."""
        return isinstance(self.value, float) and not math.isnan(self.value)


@dataclass(frozen=True)
class Measure:
    """A measure of a model.

    Attributes
    ----------
    name : str
        Name of the measure's column.
    unit : str
        Unit of the measure's column, or ``""`` for a pure number.
    doc : str
        Meaning of the measure in one line.
    """

    name: str
    unit: str
    doc: str


@dataclass(frozen=True)
class State:
    """A state of the equations of motion.

    Attributes
    ----------
    name : str
        Name of the state, such as ``"pitch_rate"``, for `initial_state`.
    unit : str
        SI unit of the state.
    column : str
        Name of the state's column in tables, with the unit: ``"pitch_rate_rad_s"``.
    """

    name: str
    unit: str
    column: str


@dataclass(frozen=True)
class DampedSine:
    """The damped sine that was fitted to the stroke after an impulse.

    Attributes
    ----------
    frequency_hz : float
        Frequency of the damped sine (Hz).
    decay_1_s : float
        Decay rate of the damped sine (1/s).
    relative_rms : float
        Root mean square of the residuals of the damped sine, relative to the root mean square of the stroke.
    """

    frequency_hz: float
    decay_1_s: float
    relative_rms: float


@dataclass(frozen=True)
class DrivenPeak:
    """A peak of the settled stroke as a function of the drive frequency.

    Attributes
    ----------
    frequency_hz : float
        Drive frequency of the peak (Hz).
    stroke_pp_deg, pitch_pp_deg : float
        Peak-to-peak stroke and peak-to-peak pitch at the frequency of the peak (deg).
    """

    frequency_hz: float
    stroke_pp_deg: float
    pitch_pp_deg: float


@dataclass(frozen=True)
class FrequencyGap:
    """A range of drive frequencies without a periodic motion. In a range without a periodic motion, the search may have
    missed a peak.

    Attributes
    ----------
    start_hz, stop_hz : float
        The lowest and the highest drive frequency of the range (Hz).
    status : str
        The status of the motions in the range of frequencies.
    """

    start_hz: float
    stop_hz: float
    status: str


@dataclass(frozen=True, eq=False)
class Resonances(_Result):
    """The resonances of one design point, which `resonance` returns.

    Attributes
    ----------
    linear_hz : dict of str to float
        Natural frequencies (Hz) of small undamped motions, by the name of the mode.
    impulse_fit : DampedSine or None
        The damped sine that was fitted to the stroke after the impulse, or None if no damped sine fits the stroke.
    stroke_spectrum_hz, pitch_spectrum_hz : list of float
        Frequencies of the highest peaks in the spectra of stroke and pitch after the impulse (Hz).
    driven : list of DrivenPeak
        Peaks of the settled stroke as a function of the drive frequency, with the highest peak first.
    larger_at_hz : float
        The end of the frequency range (Hz) at which the stroke is larger than the stroke at all peaks. `larger_at_hz`
        is nan if the stroke is largest at a peak.
    gaps : list of FrequencyGap
        Ranges of drive frequencies without a periodic motion.
    """

    linear_hz: dict[str, float]
    impulse_fit: DampedSine | None
    stroke_spectrum_hz: list[float]
    pitch_spectrum_hz: list[float]
    driven: list[DrivenPeak]
    larger_at_hz: float
    gaps: list[FrequencyGap]


@dataclass(frozen=True, eq=False)
class ActiveBound(_Result):
    """A bound or condition that limits an optimum. ``str(bound)`` returns the effect of the bound in words.

    Attributes
    ----------
    kind : str
        The kind of the bound: ``"limit"`` for a condition, or ``"smallest"`` or ``"largest"`` for an end of an axis.
    name : str
        The condition that limits the optimum, or the parameter of the axis that limits the optimum.
    limit : float
        The number in the condition, or the value at the end of the axis in SI units.
    multiplier : float
        Change of the optimal value per unit of the limit (Lagrange multiplier).
    percent : float
        Change of the optimal value in per cent, if the limit changes by 1 %.
    text : str
        The effect of the limit in words.
    """

    kind: str
    name: str
    limit: float
    multiplier: float
    percent: float
    text: str

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True, eq=False)
class ConditionValue(_Result):
    """The two sides of a condition, such as a limit on the stroke, at an optimum.

    Attributes
    ----------
    text : str
        The text of a comparison such as ``stroke_pp_deg < 90``, or the name of a condition in the grid.
    smaller, larger : float
        The values of the two sides of the comparison: first the side that must be smaller, then the side that must be
        larger.
    excess : float
        Violation of the condition, as a fraction of the limit. `excess` is 0 if the condition holds.
    """

    text: str
    smaller: float
    larger: float
    excess: float


@dataclass(frozen=True, eq=False)
class LocalOptimum(_Result):
    """An optimum at which one or more searches ended.

    Attributes
    ----------
    value : float
        Value of the goal at the optimum.
    values : dict of str to float or str
        The values of the varied parameters: numbers in SI units, or names of options.
    is_feasible : bool
        True if all conditions hold at the optimum.
    starts : int
        Number of searches that end at the optimum. Each search begins at a different point.
    """

    value: float
    values: dict[str, float | str]
    is_feasible: bool
    starts: int


@dataclass(frozen=True, eq=False)
class Optimum(_Result):
    """The result of `optimise`: the best design within the axes of a grid.

    Attributes
    ----------
    status : str
        `status` is ``"optimal"`` if the derivatives confirm that no small change improves the design. If a derivative
        is missing, `optimise` estimates the derivative from the difference between computed rows. `status` is
        ``"approximate"`` if the derivatives do not confirm that the design is optimal. `status` is ``"infeasible"`` if
        no design satisfies all conditions. If `status` is ``"infeasible"``, the result contains the design with the
        smallest violation of the conditions.
    goal : str
        The expression that was maximised or minimised.
    value : float
        The value of the goal for the best design.
    values : dict of str to float or str
        The values of the varied and derived parameters of the best design: numbers in SI units, or names of options.
    row : Row
        The row of the best design.
    active : list of ActiveBound
        The bounds and conditions that limit the best design, each with its Lagrange multiplier.
    conditions : list of ConditionValue
        All conditions, with the values of both sides of each comparison for the best design.
    optima : list of LocalOptimum
        The distinct optima that were found, with the best optimum first.
    at_end : dict of str to tuple of float
        Parameters whose best value is at an end of the axis, with the smallest and the largest value of the axis. A
        grid with a wider axis could contain a better design.
    starts : int
        Number of points at which searches started.
    points, points_computed : int
        Number of all points of the grid, and number of the grid points that were computed.
    rows, rows_with_derivatives : int
        Number of all rows that were computed, and number of computed rows that have derivatives.
    is_polished : bool
        True if a pattern search followed the search with derivatives, because derivatives were missing or misled the
        search.
    device : str
        The text of a device file that contains the best design. You can write the text to a file or give the text to
        `run`. For a vehicle, `device` is ``""``.
    """

    status: str
    goal: str
    value: float
    values: dict[str, float | str]
    row: Row
    active: list[ActiveBound]
    conditions: list[ConditionValue]
    optima: list[LocalOptimum]
    at_end: dict[str, tuple[float, float]]
    starts: int
    points: int
    points_computed: int
    rows: int
    rows_with_derivatives: int
    is_polished: bool
    device: str

    def __repr__(self) -> str:
        found = ", ".join(f"{name}={cell_text(value)}" for name, value in self.values.items())
        return f"<flapwing.Optimum, {self.status}: {self.goal} = {self.value:.6g} at {found}>"


@dataclass(frozen=True, eq=False)
class BistableBand(_Result):
    """A band of a parameter in which the motion of the rising branch differs from the motion of the falling branch.

    Attributes
    ----------
    start, stop : float
        The smallest and the largest value of the parameter in the band, in SI units.
    stroke_difference_deg : float
        Largest difference between the peak-to-peak strokes of the rising and the falling branch (deg).
        `stroke_difference_deg` is nan if no point of the band has periodic motions on the two branches.
    """

    start: float
    stop: float
    stroke_difference_deg: float


@dataclass(frozen=True)
class Verdict:
    """The verdict on the response of one design. ``str(verdict)`` returns the verdict as text.

    Attributes
    ----------
    text : str
        The text of the verdict in one line.
    bands : list of BistableBand
        The bands with hysteresis, in rising order of the parameter. `bands` is empty if the design has no hysteresis.
    curve : int
        Number of the design, from 0, as in the column ``curve``. Designs that ``where`` excludes have numbers, but no
        verdicts.
    """

    text: str
    bands: list[BistableBand]
    curve: int

    def __str__(self) -> str:
        return self.text
