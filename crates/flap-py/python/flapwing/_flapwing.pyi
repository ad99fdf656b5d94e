"""The compiled module of flapwing."""

from collections.abc import Callable
from os import PathLike
from typing import Any, SupportsFloat, SupportsIndex, final, overload

import numpy as np

__all__ = [
    "Diagnostic",
    "Exclusions",
    "Grid",
    "GridError",
    "LiveServer",
    "__version__",
    "bars",
    "batch",
    "better",
    "check",
    "chirp",
    "colours",
    "command",
    "correlations",
    "edges",
    "fly",
    "forces_along",
    "identity",
    "impulse",
    "is_log",
    "is_signed",
    "line_shades",
    "linear",
    "measures",
    "optimise",
    "origins",
    "parameter",
    "params",
    "part",
    "presets",
    "printed",
    "quantity",
    "read",
    "resonance",
    "respond",
    "run",
    "scale",
    "settings",
    "split_unit",
    "states",
    "sweep",
    "track_wing",
    "trajectory",
    "uncertainty",
    "unit_of",
    "usual_measure",
    "value",
    "ways",
    "with_keywords",
    "words",
    "wrench_map",
]

__version__: str

class GridError(ValueError):
    """A grid with mistakes.

    The text of the error shows every mistake with its lines, and `diagnostics` lists the mistakes.
    """

    diagnostics: list[Diagnostic]

@final
class Diagnostic:
    """One mistake in a grid.

    Attributes
    ----------
    file : str
        The grid file, or ``"<grid>"``.
    line, column : int
        The place of the mistake: line and column, counted from 1. Columns are in characters.
    start, end : int
        The place of the mistake as byte offsets in the UTF-8 text. `start` is the first byte of the mistake, and `end`
        is the first byte after the mistake.
    message : str
        The message about the mistake.
    notes, help : list of str
        The allowed values, and ways to correct the mistake.
    """

    def __new__(
        cls,
        file: str,
        line: int,
        column: int,
        start: int,
        end: int,
        message: str,
        notes: list[str],
        help: list[str],
    ) -> Diagnostic: ...
    def __getnewargs__(self) -> tuple[str, int, int, int, int, str, list[str], list[str]]: ...
    @property
    def file(self) -> str: ...
    @property
    def line(self) -> int: ...
    @property
    def column(self) -> int: ...
    @property
    def start(self) -> int: ...
    @property
    def end(self) -> int: ...
    @property
    def message(self) -> str: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def help(self) -> list[str]: ...

@final
class Grid:
    """A grid file that was read and checked.

    A grid is a sequence of design points. The parameters of a point are computed on access::

        grid = Grid({"preset": "ozaki2018-large", "axes": {"drive_frequency": [100.0, 105.0, 110.0]}})
        len(grid)                       # 3
        grid[1]["drive_frequency"]      # 105.0

    Parameters
    ----------
    source : str, path, dict or Grid
        The name of a preset, or the path of a grid file. A str with a line break or ``=`` is the text of a grid file. A
        dictionary has the entries of a grid file, with a dictionary for each table. Lists may be arrays, Series, ranges or
        Arrow columns. A DataFrame has the same meaning as the dictionary of its columns.

    Raises
    ------
    GridError
        The grid has mistakes. The message lists each mistake with the line of the mistake, the allowed values and the
        most similar known name.
    ValueError
        `source` is not the name of a preset.
    OSError
        The file does not exist or cannot be read.
    TypeError
        `source`, or a value in `source`, has the wrong type.
    """

    def __new__(cls, source: Any, /) -> Grid: ...
    def __len__(self) -> int: ...
    @overload
    def __getitem__(self, key: SupportsIndex, /) -> dict[str, float | str]: ...
    @overload
    def __getitem__(self, key: slice, /) -> list[dict[str, float | str]]: ...
    @staticmethod
    def _named(name: str, text: str, /) -> Grid: ...
    def __reduce__(self) -> tuple[Any, tuple[str, str]]: ...
    @property
    def name(self) -> str:
        """The path of the grid file, or ``"<grid>"``. Paths in the grid are relative to the folder of the grid file."""

    @property
    def text(self) -> str:
        """The text of the grid file."""

    @property
    def preset(self) -> str:
        """The name of the preset. Parameters that the grid does not set have the values of the preset."""

    @property
    def model(self) -> str:
        """The name of the model whose parameters the grid sets."""

    @property
    def axes(self) -> list[dict[str, Any]]:
        """The axes of the grid. The last axis varies fastest. Each dictionary has the parameters that vary together along
        an axis, with values in SI units. If the axis is a sample, the first entry
        is `sample`, an array with the numbers of the sampled points, which begin at 0.
        """

    @property
    def varied(self) -> list[str]:
        """The parameters that differ between points: parameters of the axes, and then derived parameters."""

    def exclusions(self) -> Exclusions:
        """Count the points that the conditions of ``[where]`` exclude. If the grid has more than a million points, flap checks
        a million points that are spread over the grid.

        Returns
        -------
        Exclusions
            The numbers of checked and excluded points.
        """

@final
class Exclusions:
    """The points of a grid that the conditions of ``[where]`` exclude.

    Attributes
    ----------
    looked_at : int
        Number of points for which the conditions were evaluated.
    excluded : int
        Number of evaluated points that do not satisfy all conditions.
    unsatisfied : dict of str to int
        Conditions, each with the number of points that do not satisfy the condition.
    """

    @property
    def looked_at(self) -> int: ...
    @property
    def excluded(self) -> int: ...
    @property
    def unsatisfied(self) -> dict[str, int]: ...

def presets() -> list[str]:
    """Return the names of the published parameter sets.

    Returns
    -------
    list of str
        Names for `run`, such as ``"ozaki2018-large"``.
    """

def params(design: Any, /) -> list[dict[str, Any]]: ...
def measures(design: Any, /) -> list[dict[str, Any]]: ...
def uncertainty(design: Any, /) -> tuple[dict[str, float], list[tuple[str, str, float]]]: ...
def origins(design: Any, /) -> tuple[str, dict[str, str]]: ...
def states(design: Any, /) -> list[str]: ...
def value(model: str, parameter: str, value: SupportsFloat | str, /) -> float: ...
def parameter(model: str, parameter: str, /) -> str: ...
def quantity(name: str, text: str, unit: str, /) -> float: ...
def settings() -> list[str]: ...
def run(
    design: Any,
    keywords: dict[str, Any],
    /,
    *,
    point: SupportsIndex | None = None,
    initial_state: dict[str, Any] | None = None,
    waveform: str | dict[str, Any] | None = None,
    stroke: str | dict[str, Any] | None = None,
) -> dict[str, Any]: ...
def trajectory(
    design: Any,
    keywords: dict[str, Any],
    /,
    *,
    point: SupportsIndex | None,
    cycles: SupportsIndex,
    samples: SupportsIndex,
    from_rest: bool,
    initial_state: dict[str, Any] | None = None,
    waveform: str | dict[str, Any] | None = None,
    stroke: str | dict[str, Any] | None = None,
    once: bool = False,
) -> dict[str, Any]: ...

@final
class LiveServer:
    """A running server; see `flapwing.Live`."""

    def __new__(
        cls, design: Any, keywords: dict[str, Any], /, *, port: int, threads: SupportsIndex | None
    ) -> LiveServer: ...
    @property
    def address(self) -> str: ...
    def stop(self) -> None: ...

def resonance(
    design: Any,
    keywords: dict[str, Any],
    /,
    *,
    point: SupportsIndex | None,
    start: SupportsFloat | str | None,
    stop: SupportsFloat | str | None,
    tolerance: SupportsFloat | str,
    impulse: SupportsFloat | str,
    fit_cycles: SupportsIndex,
    spectrum_window: SupportsFloat | str,
) -> dict[str, Any]: ...
def optimise(
    design: Any,
    keywords: dict[str, Any],
    /,
    *,
    goal: str,
    is_largest: bool,
    conditions: list[str],
    starts: SupportsIndex,
    sample: SupportsIndex,
    threads: SupportsIndex | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> dict[str, Any]: ...
def wrench_map(
    design: Any,
    keywords: dict[str, Any],
    /,
    *,
    point: SupportsIndex | None,
    ranges: list[tuple[str, SupportsFloat | str, SupportsFloat | str]],
    samples: SupportsIndex,
    threads: SupportsIndex | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> dict[str, Any]: ...
def linear(
    design: Any,
    keywords: dict[str, Any],
    /,
    *,
    point: SupportsIndex | None = None,
    inputs: list[str] | None = None,
    trim_to_hover: bool = False,
    positions: bool = False,
) -> dict[str, Any]: ...
def fly(
    design: Any,
    keywords: dict[str, Any],
    /,
    *,
    point: SupportsIndex | None,
    seconds: SupportsFloat | str,
    disturbance: list[tuple[str, SupportsFloat | str]],
    gains: list[list[float]] | None,
    inputs: list[str],
    averaged: bool,
    samples: SupportsIndex | None,
) -> dict[str, Any]: ...
def chirp(
    design: Any,
    keywords: dict[str, Any],
    /,
    *,
    point: SupportsIndex | None,
    start: SupportsFloat | str,
    stop: SupportsFloat | str | None,
    rate: SupportsFloat | str,
    samples: SupportsIndex | None,
) -> dict[str, Any]: ...
def impulse(
    design: Any,
    keywords: dict[str, Any],
    /,
    *,
    point: SupportsIndex | None,
    amplitude: SupportsFloat | str,
    duration: SupportsFloat | str | None,
    samples: SupportsIndex,
) -> dict[str, Any]: ...
def forces_along(
    design: Any,
    motion: str | dict[str, Any],
    keywords: dict[str, Any],
    /,
    *,
    point: SupportsIndex | None,
    periodic: bool,
    samples: SupportsIndex,
) -> dict[str, Any]: ...
def track_wing(points: str | dict[str, Any], /, *, chord: SupportsFloat | None = None) -> dict[str, Any]: ...
def check(design: Any, /, *, keywords: dict[str, Any], measures: list[str] | None = None) -> None: ...
def with_keywords(grid: Grid, keywords: dict[str, Any], /, *, measures: list[str] | None = None) -> Grid: ...
def batch(
    design: Any,
    columns: dict[str, Any],
    /,
    *,
    measures: list[str] | None = None,
    gradient: list[str] | None = None,
    initial_state: np.ndarray[Any, np.dtype[np.float64]] | None = None,
    return_states: bool = False,
    keywords: dict[str, Any] | None = None,
) -> Grid: ...
def respond(
    design: Any,
    parameter: str,
    /,
    *,
    start: SupportsFloat | str | None = None,
    stop: SupportsFloat | str | None = None,
    step: SupportsFloat | str | None = None,
    tolerance: SupportsFloat | str | None = None,
    unstable: bool = False,
    return_states: bool = False,
    threads: SupportsIndex | None = None,
    progress: Callable[[int, int], object] | None = None,
    keywords: dict[str, Any] | None = None,
    curves: list[int] | None = None,
) -> dict[str, Any]: ...
def edges(
    design: Any,
    first: str,
    second: str,
    /,
    *,
    first_range: list[SupportsFloat | str | None],
    second_range: list[SupportsFloat | str | None],
    tolerance: SupportsFloat | str | None = None,
    threads: SupportsIndex | None = None,
    keywords: dict[str, Any] | None = None,
) -> dict[str, Any]: ...
def sweep(
    grid: Grid,
    /,
    *,
    out: str | PathLike[str] | None = None,
    restart: bool = False,
    threads: SupportsIndex | None = None,
    progress: Callable[[int, int], object] | None = None,
    chunks: Callable[[int], bytes | None] | None = None,
) -> dict[str, Any]: ...
def part(
    grid: Grid, begin: int, end: int, /, *, first: int | None = None, threads: SupportsIndex | None = None
) -> bytes: ...
def identity() -> dict[str, str]: ...
def command(line: list[str]) -> int: ...
def read(path: str | PathLike[str], /, *, ignore_damage: bool = False) -> dict[str, Any]: ...
def words(name: str, unit: str, /) -> str: ...
def printed(unit: str, /) -> str: ...
def scale(unit: str, largest: float, /) -> tuple[float, str]: ...
def unit_of(name: str, /) -> str: ...
def split_unit(name: str, /) -> tuple[str, str]: ...
def better(name: str, /) -> int: ...
def colours() -> dict[str, Any]: ...
def line_shades(count: int, /) -> list[float] | None: ...
def is_log(values: np.ndarray[Any, Any], /) -> bool: ...
def is_signed(low: float, high: float, /) -> bool: ...
def usual_measure(role: str, columns: list[str], taken: list[str], /) -> str | None: ...
def ways(
    up: tuple[np.ndarray[Any, Any], np.ndarray[Any, Any], np.ndarray[Any, Any]],
    down: tuple[np.ndarray[Any, Any], np.ndarray[Any, Any], np.ndarray[Any, Any]],
    /,
) -> tuple[list[tuple[float, float]], list[list[int]]]: ...
def bars(values: np.ndarray[Any, Any], /) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]] | None: ...
def correlations(
    parameters: list[np.ndarray[Any, Any]], measure: np.ndarray[Any, Any], /
) -> list[tuple[int, float]]: ...
