"""The dictionaries that the compiled module returns."""

from __future__ import annotations

from typing import Any, TypedDict

import numpy as np


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


class NativeParameter(TypedDict):
    """A parameter of a model (see `flapwing.Parameter`)."""

    name: str
    value: float | str
    unit: str
    symbol: str
    doc: str
    allowed: str
    options: list[str]


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
    bistable: str


class NativeWays(TypedDict):
    """Bands in which the rising and the falling branch differ, and the rows after which a branch jumps."""

    bands: list[tuple[float, float]]
    up: list[int]
    down: list[int]


class NativeBars(TypedDict):
    """A histogram: the edges and the heights of its bars."""

    edges: np.ndarray[Any, np.dtype[np.float64]]
    counts: np.ndarray[Any, np.dtype[np.float64]]


class NativeIdentity(TypedDict):
    """The build and the arithmetic of a process, which determine the last bits of the computed rows."""

    build: str
    arithmetic: str
