"""Results that are no tables: rows of single points, parameters, measures and states of a design, resonances."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from ._mistakes import unknown

__all__ = [
    "BistableBand",
    "DampedSine",
    "DrivenPeak",
    "FrequencyGap",
    "Measure",
    "Parameter",
    "Resonances",
    "Row",
    "State",
    "Verdict",
]


def _same(one: Any, other: Any) -> bool:
    """True for equal values, and for two that are unknown."""
    return bool(one == other or (one != one and other != other))


class _Result:
    """A result that equals another one if all attributes do, whatever is unknown in them."""

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return all(_same(value, getattr(other, name)) for name, value in vars(self).items())


@dataclass(frozen=True, eq=False)
class Row(Mapping[str, Any]):
    """The results of one design point.

    ``row["lift_mean_mn"]`` is a column of a table of results: a measure, or one of the attributes by its name.
    ``dict(row)`` has all columns, in the same order for every point of a model.

    Attributes
    ----------
    status : str
        ``"periodic"``; ``"subharmonic"`` (repeats every 2 to 8 drive periods); ``"unsettled"`` (max_cycles reached);
        ``"diverged"``; ``"step_limit"`` (max_steps reached, or steps too small to advance time); ``"invalid"`` (each
        parameter is in range, but together they are impossible).
    measures : dict of str to float
        The measures, each named after its quantity, its kind of measure and its unit: ``stroke_pp_deg``,
        ``lift_mean_mn``, ``power_mean_mw``; then the measures of the grid's ``[measure]``, of which conditions are
        bool. All are nan unless the point is periodic. A ratio of zero to zero, such as the efficiency without power,
        is nan.
    cycles : int
        Drive periods integrated, including the measurement.
    residual : float
        Change of the state over the last period of the motion, in units of the typical sizes of its components. nan
        if no period was completed.
    period : int
        Drive periods until the motion repeats: 1 if periodic, more if subharmonic, otherwise 0.
    floquet_max : float
        Factor by which a small change of the motion grows or decays per orbit after a long time. nan if no orbit was
        found, and for a wing at rest.
    stable : bool or float
        True if floquet_max is below 1, so that motions near the orbit approach it, and for a wing at rest. nan if no
        orbit was found.
    error_estimate : float
        Estimate of the largest relative error that the integration makes in stroke, pitch, mean lift and mean power;
        infinite if it cannot be estimated. nan unless the point is periodic.
    rhs_evals : int
        Evaluations of the equations of motion.
    reason : str
        The cause if the point is invalid, else ``""``.
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
        # Rows of the same point are equal, whatever is unknown in them.
        return list(self) == list(other) and all(_same(self[key], other[key]) for key in self)

    def _repr_html_(self) -> str:
        """The columns, for notebooks."""
        from html import escape

        cells = "".join(
            f"<tr><th>{escape(key)}</th><td>{escape(_text(value))}</td></tr>" for key, value in self.items()
        )
        return f"<table>{cells}</table>"


#: The columns of a row that are no measures.
_ATTRIBUTES = (
    "status",
    "cycles",
    "residual",
    "period",
    "floquet_max",
    "stable",
    "error_estimate",
    "rhs_evals",
    "reason",
)


def _text(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


@dataclass(frozen=True, eq=False)
class Parameter(_Result):
    """A parameter of a model.

    Attributes
    ----------
    name : str
        Name in grids, on the command line and as a keyword.
    value : float or str
        Value in the design, in SI units, or the name of an option. nan if it is not set and follows others, or if a
        grid varies it.
    unit : str
        SI unit; ``""`` for pure numbers and options.
    symbol : str
        Symbol in the paper; ``""`` if it has none.
    doc : str
        One line of meaning, with its source.
    allowed : str
        The allowed values, in words.
    options : tuple of str
        Its options, if it is a choice; else empty.
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
        """True if the value is a number that is set."""
        return isinstance(self.value, float) and not math.isnan(self.value)


@dataclass(frozen=True)
class Measure:
    """A measure of a model.

    Attributes
    ----------
    name : str
        Name of the column.
    unit : str
        Unit of the column; ``""`` for a pure number.
    doc : str
        One line of meaning.
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
        Name of the component, such as ``"pitch_rate"``, for `initial_state`.
    unit : str
        SI unit.
    column : str
        Name of the column in tables, with the unit: ``"pitch_rate_rad_s"``.
    """

    name: str
    unit: str
    column: str


@dataclass(frozen=True)
class DampedSine:
    """The damped sine that fits the stroke after an impulse.

    Attributes
    ----------
    frequency_hz : float
        Frequency (Hz).
    decay_1_s : float
        Decay (1/s).
    relative_rms : float
        Root mean square of the residuals, relative to the root mean square of the stroke.
    """

    frequency_hz: float
    decay_1_s: float
    relative_rms: float


@dataclass(frozen=True)
class DrivenPeak:
    """A peak of the settled stroke over the drive frequency.

    Attributes
    ----------
    frequency_hz : float
        Drive frequency (Hz).
    stroke_pp_deg, pitch_pp_deg : float
        Stroke and pitch there, peak to peak (deg).
    """

    frequency_hz: float
    stroke_pp_deg: float
    pitch_pp_deg: float


@dataclass(frozen=True)
class FrequencyGap:
    """A range of drive frequencies without a periodic motion: a peak in it is not found.

    Attributes
    ----------
    start_hz, stop_hz : float
        The ends of the range (Hz).
    status : str
        The status of the motions in it.
    """

    start_hz: float
    stop_hz: float
    status: str


@dataclass(frozen=True, eq=False)
class Resonances(_Result):
    """The resonances of one design point, by `resonance`.

    Attributes
    ----------
    linear_hz : dict of str to float
        Small undamped motions: frequency (Hz) by name of the mode.
    impulse_fit : DampedSine or None
        The damped sine through the stroke after the impulse. None if no damped sine fits.
    stroke_spectrum_hz, pitch_spectrum_hz : list of float
        Highest peaks of the spectra after the impulse (Hz).
    driven : list of DrivenPeak
        Peaks of the settled stroke over the drive frequency, the highest first.
    larger_at_hz : float
        The end of the range (Hz) at which the stroke is larger than at any peak; nan if it is not.
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
class BistableBand(_Result):
    """A band of a parameter in which the ways up and down have different motions.

    Attributes
    ----------
    start, stop : float
        The ends of the band, in SI units.
    stroke_difference_deg : float
        Largest difference of the stroke between both motions (deg, peak to peak); nan if everywhere one of them is not
        periodic.
    """

    start: float
    stop: float
    stroke_difference_deg: float


@dataclass(frozen=True)
class Verdict:
    """The verdict on the response of one design. Its text is ``str(verdict)``.

    Attributes
    ----------
    text : str
        The verdict in one line.
    bands : list of BistableBand
        The bands with hysteresis, by rising value of the parameter; empty if there is none.
    """

    text: str
    bands: list[BistableBand]

    def __str__(self) -> str:
        return self.text
