"""The compiled module of flapwing."""

from collections.abc import Callable
from os import PathLike
from typing import Any, SupportsFloat, SupportsIndex, final, overload

import numpy as np

from ._native import (
    NativeBars,
    NativeColours,
    NativeIdentity,
    NativeOrigins,
    NativeParameter,
    NativeTable,
    NativeUncertainty,
    NativeWays,
)

__all__ = [
    "Diagnostic",
    "Exclusions",
    "Grid",
    "GridError",
    "LiveServer",
    "__version__",
    "bars",
    "better",
    "check",
    "chirp",
    "colours",
    "command",
    "correlations",
    "edges",
    "evaluate",
    "fly",
    "forces_along",
    "identity",
    "impulse",
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
    "text_of",
    "track_wing",
    "trajectory",
    "uncertainty",
    "unit_of",
    "usual_measure",
    "value",
    "ways",
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
        is the byte after the last byte.
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
    def _named(name: str, text: str, /) -> Grid:
        """Return the grid for a text that was read from the file `name`."""

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
        an axis, with values in SI units. For an axis of a sample, the first entry is `sample`, with numbers from 0.
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

def params(design: Any, /) -> list[NativeParameter]:
    """Return the parameters of a design or a model; see `flapwing.params`."""

def measures(design: Any, /) -> list[dict[str, Any]]:
    """Return the measures of a design or a model; see `flapwing.measures`."""

def uncertainty(design: Any, /) -> NativeUncertainty:
    """Return the standard errors of a design's parameters by name, in SI units, and the correlations of pairs of parameters."""

def origins(design: Any, /) -> NativeOrigins:
    """Return the description of a design, which may be empty, and the sources of its parameters by name."""

def states(design: Any, /) -> list[str]:
    """Return the names of the states in the equations of motion of a design or a model. Each name ends with the unit."""

def value(model: str, parameter: str, value: SupportsFloat | str, /) -> float:
    """Return the value of a parameter in SI units, from a number or a text with a unit. `model` is a preset or a model."""

def parameter(model: str, parameter: str, /) -> str:
    """Return the name of a parameter of a preset or a model. Raise ValueError for an unknown name."""

def quantity(name: str, text: str, unit: str, /) -> float:
    """Parse a text such as `"3 mm"`, and return the number in `unit`. Both units must measure the same kind of quantity."""

def settings() -> list[str]:
    """Return the names of the solver settings, in the order of the signature of `flapwing.run`."""

def run(
    design: Any,
    keywords: dict[str, Any],
    /,
    *,
    point: SupportsIndex | None = None,
    initial_state: dict[str, Any] | None = None,
    waveform: str | dict[str, Any] | None = None,
    stroke: str | dict[str, Any] | None = None,
) -> dict[str, Any]:
    """Run one point; see `flapwing.run`."""

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
) -> NativeTable:
    """Sample the motion of one point; see `flapwing.trajectory`."""

@final
class LiveServer:
    """A running server; see `flapwing.Live`."""

    def __new__(
        cls, design: Any, keywords: dict[str, Any], /, *, port: int, threads: SupportsIndex | None
    ) -> LiveServer: ...
    @property
    def address(self) -> str:
        """The address of the live page, with a secret token."""

    def stop(self) -> None:
        """Stop the server of the live page."""

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
) -> dict[str, Any]:
    """Compute the resonances of one point; see `flapwing.resonance`."""

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
) -> dict[str, Any]:
    """Find the best design; see `flapwing.optimise`."""

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
) -> dict[str, Any]:
    """Fit a quadratic map of force and torque; see `flapwing.wrench_map`. Each range is a name, a first and a last value."""

def linear(
    design: Any,
    keywords: dict[str, Any],
    /,
    *,
    point: SupportsIndex | None = None,
    inputs: list[str] | None = None,
    trim_to_hover: bool = False,
    positions: bool = False,
) -> dict[str, Any]:
    """Compute the linear model of a vehicle about hover; see `flapwing.Vehicle.linear`."""

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
) -> NativeTable:
    """Simulate the flight of a vehicle; see `flapwing.fly`."""

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
) -> NativeTable:
    """Simulate a chirp; see `flapwing.chirp`."""

def impulse(
    design: Any,
    keywords: dict[str, Any],
    /,
    *,
    point: SupportsIndex | None,
    amplitude: SupportsFloat | str,
    duration: SupportsFloat | str | None,
    samples: SupportsIndex,
) -> NativeTable:
    """Simulate the motion after an impulse; see `flapwing.impulse`."""

def forces_along(
    design: Any,
    motion: str | dict[str, Any],
    keywords: dict[str, Any],
    /,
    *,
    point: SupportsIndex | None,
    periodic: bool,
    samples: SupportsIndex,
) -> NativeTable:
    """Compute the forces on a wing along a given motion; see `flapwing.forces_along`."""

def track_wing(points: str | dict[str, Any], /, *, chord: SupportsFloat | None = None) -> NativeTable:
    """Compute stroke and pitch of a filmed wing; see `flapwing.track_wing`."""

def check(design: Any, /, *, keywords: dict[str, Any], measures: list[str] | None = None) -> None:
    """Check that a design accepts `keywords` and has the measures `measures`. Mistakes raise the errors of `evaluate`."""

def text_of(entries: dict[str, Any], /) -> str:
    """Return the text of a grid file with the entries `entries`."""

def evaluate(
    design: Any,
    columns: dict[str, Any],
    /,
    *,
    threads: SupportsIndex | None = None,
    progress: Callable[[int, int], object] | None = None,
    measures: list[str] | None = None,
    gradient: list[str] | None = None,
    initial_state: np.ndarray[Any, np.dtype[np.float64]] | None = None,
    return_states: bool = False,
    keywords: dict[str, Any] | None = None,
) -> NativeTable:
    """Run a batch of points; see `flapwing.evaluate`.

    `columns` has a one-dimensional array of float64 or a list of text for each varied parameter, all of the same
    length. `initial_state` has one row of state components per point; a row of nan stands for a point that begins at
    rest.
    """

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
) -> NativeTable:
    """Follow responses; see `flapwing.respond`.

    `curves` has the numbers of the designs to follow, in rising order. In the result, `designs` is the number of all designs.
    """

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
) -> NativeTable:
    """Follow the edges of hysteresis; see `flapwing.edges`. Each range is a first value, a last value and a step."""

def sweep(
    grid: Grid,
    /,
    *,
    out: str | PathLike[str] | None = None,
    restart: bool = False,
    threads: SupportsIndex | None = None,
    progress: Callable[[int, int], object] | None = None,
    chunks: Callable[[int], bytes | None] | None = None,
) -> NativeTable:
    """Run a grid; see `flapwing.sweep`.

    `chunks` is a function that returns rows of other processes. The argument of `chunks` is the number of points done, and
    the result is the next chunk of rows as bytes.
    """

def part(grid: Grid, begin: int, end: int, /, *, threads: SupportsIndex | None = None) -> bytes:
    """Run the points from `begin` up to, but not including, `end`. Return the rows as bytes, which the function `chunks`
    of `sweep` may return.
    """

def identity() -> NativeIdentity:
    """Return the identity of this process: `build` (a hash of the sources) and `arithmetic`, which determine the bits of rows."""

def command(line: list[str]) -> int:
    """Run a command line and return its exit code. The first word of the line is the name of the program."""

def read(path: str | PathLike[str], /, *, ignore_damage: bool = False) -> NativeTable:
    """Read a result file; see `flapwing.read`."""

def words(name: str, unit: str, /) -> str:
    """Return the name of a column in words, without the unit: `lift_mean_mn` gives "Lift, mean"."""

def printed(unit: str, /) -> str:
    """Return a unit for printing: `uN*m/rad` gives "µN·m/rad", `mm^2` gives "mm²", `deg` gives "°"."""

def scale(unit: str, largest: float, /) -> tuple[float, str]:
    """Return the factor to a readable unit, and the readable unit for printing. `largest` is the largest of the values in
    `unit`.
    """

def unit_of(name: str, /) -> str:
    """Return the unit of a column, or empty text if the unit is unknown.

    If `name` is a parameter, a measure or a derivative of a model, the unit of the quantity is returned. For all other
    names, the unit at the end of the name is returned.
    """

def split_unit(name: str, /) -> tuple[str, str]:
    """Return the name of a column without the unit at the end, and the unit, which may be empty."""

def better(name: str, /) -> int:
    """Return the better direction of a column: 1 for a benefit such as lift, -1 for a cost such as power, 0 for neither."""

def colours() -> NativeColours:
    """Return the colours of pictures.

    `series` is a list, and `branches` has one colour for each branch. `dark`, `plain` and `bistable` are single
    colours.
    """

def line_shades(count: int, /) -> list[float] | None:
    """Return the positions of `count` ordered lines in the sequential colour map; None for a single line."""

def is_signed(low: float, high: float, /) -> bool:
    """Return True if numbers from `low` to `high` have both signs. Numbers of both signs require a diverging map with zero
    in the middle.
    """

def usual_measure(role: str, columns: list[str], taken: list[str], /) -> str | None:
    """Return the default measure among `columns` that is not in `taken`. Return None if no
    default measure remains.

    `role` is "response", "benefit", "cost" or "motion".
    """

def ways(
    up: tuple[np.ndarray[Any, Any], np.ndarray[Any, Any], np.ndarray[Any, Any]],
    down: tuple[np.ndarray[Any, Any], np.ndarray[Any, Any], np.ndarray[Any, Any]],
    /,
) -> NativeWays:
    """Return the bands in which the branches up and down differ, and the rows after which each branch jumps.

    `up` and `down` are the branches: arrays of the parameter, of the measure, and of the column `bistable`.
    """

def bars(values: np.ndarray[Any, Any], /) -> NativeBars | None:
    """Return a histogram: edges and heights of the bars. Return None if no value is finite."""

def correlations(parameters: list[np.ndarray[Any, Any]], measure: np.ndarray[Any, Any], /) -> list[tuple[int, float]]:
    """Return the index of each parameter and its rank correlation with a measure, in falling order of absolute value.

    Parameters whose order equals the order of an earlier parameter, and parameters without a correlation, are left out.
    """
