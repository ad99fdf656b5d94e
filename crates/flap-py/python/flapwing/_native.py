"""The dictionaries that the compiled module returns."""

from __future__ import annotations

from typing import Any, TypedDict

import numpy as np

Floats = np.ndarray[Any, np.dtype[np.float64]]


class NativeColumn(TypedDict):
    """A column of a table."""

    name: str
    unit: str
    doc: str
    #: float64 or uint64 for numbers; int8 for flags (1, 0, -1 for unknown); uint32 indices of `words` for text.
    cells: np.ndarray[Any, Any]
    words: list[str] | None


class NativeSummary(TypedDict, total=False):
    """Counts of the rows and points of a run. `NativeSummary` is empty if all rows of the run already existed in the
    file."""

    rows: int
    counts: dict[str, int]
    excluded: int
    unsatisfied: dict[str, int]
    cycles: int
    rhs_evals: int
    #: The first few invalid points, with the reasons why they are invalid.
    invalid: list[tuple[int, str]]


class NativeTable(TypedDict, total=False):
    """A table of results. If the rows are in a file, the dictionary has no entry `columns`."""

    columns: list[NativeColumn]
    summary: NativeSummary
    axes: list[dict[str, Any]]
    meta: dict[str, Any]
    #: The total number of designs whose responses are computed.
    designs: int
    #: The units that a file of results records, by column.
    units: dict[str, str]
    warnings: list[str]
    verified: bool


class NativeRow(TypedDict):
    """The row of a point (see `flapwing.Row`)."""

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


class NativeParameter(TypedDict):
    """A parameter of a model (see `flapwing.Parameter`)."""

    name: str
    value: float | str
    unit: str
    symbol: str
    doc: str
    allowed: str
    options: list[str]


class NativeMeasure(TypedDict):
    """A measure of a model (see `flapwing.Measure`)."""

    name: str
    unit: str
    doc: str


class NativePeak(TypedDict):
    """See `flapwing.DrivenPeak`."""

    frequency_hz: float
    stroke_pp_deg: float
    pitch_pp_deg: float


class NativeSine(TypedDict):
    """See `flapwing.DampedSine`."""

    frequency_hz: float
    decay_1_s: float
    relative_rms: float


class NativeGap(TypedDict):
    """See `flapwing.FrequencyGap`."""

    start_hz: float
    stop_hz: float
    status: str


class NativeResonances(TypedDict):
    """See `flapwing.Resonances`."""

    linear_hz: dict[str, float]
    impulse_fit: NativeSine | None
    stroke_spectrum_hz: list[float]
    pitch_spectrum_hz: list[float]
    driven: list[NativePeak]
    larger_at_hz: float
    gaps: list[NativeGap]


class NativeActive(TypedDict):
    """See `flapwing.ActiveBound`."""

    kind: str
    name: str
    limit: float
    multiplier: float
    percent: float
    text: str


class NativeCondition(TypedDict):
    """See `flapwing.ConditionValue`."""

    text: str
    smaller: float
    larger: float
    excess: float


class NativeLocalOptimum(TypedDict):
    """See `flapwing.LocalOptimum`."""

    value: float
    values: dict[str, float | str]
    is_feasible: bool
    starts: int


class NativeOptimum(TypedDict):
    """See `flapwing.Optimum`."""

    status: str
    value: float
    values: dict[str, float | str]
    row: NativeRow
    active: list[NativeActive]
    conditions: list[NativeCondition]
    optima: list[NativeLocalOptimum]
    at_end: dict[str, tuple[float, float]]
    starts: int
    points: int
    points_computed: int
    rows: int
    rows_with_derivatives: int
    is_polished: bool
    device: str


class NativeWrenchMap(TypedDict):
    """See `flapwing.WrenchMap`."""

    inputs: list[str]
    parameters: list[str]
    units: list[str]
    start: list[float]
    stop: list[float]
    components: list[str]
    powers: list[list[int]]
    scaled: list[list[float]]
    physical: list[list[float]]
    r_squared: list[float]
    largest_error: list[float]
    rows: dict[str, int]
    floquet_max: float
    warnings: list[str]


class NativeCorrelation(TypedDict):
    """The correlation of two parameters."""

    between: list[str]
    coefficient: float


class NativeUncertainty(TypedDict):
    """Standard errors of parameters in SI units, by name, and correlations of pairs of parameters."""

    errors: dict[str, float]
    correlations: list[NativeCorrelation]


class NativeOrigins(TypedDict):
    """The description of a design, and the sources of its parameters by name."""

    description: str
    sources: dict[str, str]


class NativeColours(TypedDict):
    """The colours of flap's pictures."""

    series: list[str]
    branches: dict[str, str]
    dark: str
    plain: str
    missing: str
    bistable: str


class NativeWays(TypedDict):
    """Bands in which the rising and the falling branch differ, and the rows after which a branch jumps."""

    bands: list[tuple[float, float]]
    up: list[int]
    down: list[int]


class NativeBars(TypedDict):
    """A histogram: the edges of the bars, the heights of the bars, and percentiles as pairs of a percentage and a
    value.
    """

    edges: Floats
    counts: Floats
    percentiles: list[tuple[int, float]]


class NativeIdentity(TypedDict):
    """The build and the arithmetic of a process, which determine the last bits of the computed rows."""

    build: str
    arithmetic: str
