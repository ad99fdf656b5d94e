"""Native part of flapwing."""

from collections.abc import Callable
from os import PathLike
from typing import Any, SupportsFloat, SupportsIndex, final, overload

import numpy as np

from ._native import (
    NativeBars,
    NativeColours,
    NativeIdentity,
    NativeMeasure,
    NativeOrigins,
    NativeParameter,
    NativeResonances,
    NativeRow,
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
    "evaluate",
    "forces_along",
    "identity",
    "impulse",
    "is_signed",
    "line_shades",
    "measures",
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
]

__version__: str

class GridError(ValueError):
    """A grid with mistakes.

    The text shows every mistake with its lines; `diagnostics` lists them.
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
        The place of the mistake, from 1; columns count characters.
    start, end : int
        The same place in bytes of the text in UTF-8: first, and behind the last.
    message : str
        The mistake.
    notes, help : list of str
        The allowed values, and ways to mend the mistake.
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
    """A design space: a checked grid file.

    A grid is a sequence of design points, computed when asked for::

        grid = Grid({"preset": "ozaki2018-large", "axes": {"drive_frequency": [100.0, 105.0, 110.0]}})
        len(grid)                       # 3
        grid[1]["drive_frequency"]      # 105.0

    Parameters
    ----------
    source : str, path, dict or Grid
        A preset by its name; a grid file by its path; the text of one (a str with a line break or ``=``); or its entries
        as a dictionary of dictionaries. Lists in it may be arrays, Series, ranges, or columns of Arrow; a DataFrame
        stands for the dictionary of its columns.

    Raises
    ------
    GridError
        Mistakes in the grid: all of them, each with its line, what is allowed and the nearest name.
    ValueError
        There is no such preset.
    OSError
        The file is not there or cannot be read.
    TypeError
        `source`, or something in it, is of another type.
    """

    def __new__(cls, source: Any, /) -> Grid: ...
    def __len__(self) -> int: ...
    @overload
    def __getitem__(self, key: SupportsIndex, /) -> dict[str, float | str]: ...
    @overload
    def __getitem__(self, key: slice, /) -> list[dict[str, float | str]]: ...
    @staticmethod
    def _named(name: str, text: str, /) -> Grid:
        """The grid of a text that was read from the file `name`."""

    def __reduce__(self) -> tuple[Any, tuple[str, str]]: ...
    @property
    def name(self) -> str:
        """The path of the grid file, or ``"<grid>"``. Files that the grid names are in its folder."""

    @property
    def text(self) -> str:
        """The text of the grid file."""

    @property
    def preset(self) -> str:
        """The name of the preset that parameters start from."""

    @property
    def model(self) -> str:
        """The name of the model."""

    @property
    def axes(self) -> list[dict[str, Any]]:
        """The axes, the last of which varies fastest: one dictionary each, of the parameters that move together along it
        with their values in SI units. An axis of a sample begins with the entry `sample`, numbers from 0.
        """

    @property
    def varied(self) -> list[str]:
        """The parameters that differ from point to point: those of the axes, then the derived ones."""

    def exclusions(self) -> Exclusions:
        """Counts the points that the conditions of ``[where]`` exclude: among all points or, if there are more than a million,
        among a million spread over the grid.

        Returns
        -------
        Exclusions
            The numbers of points.
        """

@final
class Exclusions:
    """The points of a grid that the conditions of ``[where]`` exclude.

    Attributes
    ----------
    looked_at : int
        Number of points for which the conditions were evaluated.
    excluded : int
        Number of points among them that do not satisfy all conditions.
    unsatisfied : dict of str to int
        For each condition, the number of points that do not satisfy it.
    """

    @property
    def looked_at(self) -> int: ...
    @property
    def excluded(self) -> int: ...
    @property
    def unsatisfied(self) -> dict[str, int]: ...

def presets() -> list[str]:
    """The names of the published parameter sets, each with its model.

    Returns
    -------
    list of str
        Names that `run` takes, such as ``"ozaki2018-large"``.
    """

def params(design: Any, /) -> list[NativeParameter]:
    """The parameters of a design or a model; see `flapwing.params`."""

def measures(design: Any, /) -> list[NativeMeasure]:
    """The measures of a design or a model; see `flapwing.measures`."""

def uncertainty(design: Any, /) -> NativeUncertainty:
    """The standard errors of the parameters of a design in SI units, by name, and the correlations of pairs of parameters."""

def origins(design: Any, /) -> NativeOrigins:
    """The description of a design, empty if it has none, and the source of each parameter that has one."""

def states(design: Any, /) -> list[str]:
    """The names of the states of a design's or a model's equations of motion, with their units at the end."""

def value(model: str, parameter: str, value: SupportsFloat | str, /) -> float:
    """The value in SI units of a parameter of a preset or a model: of a number, or of text with a unit."""

def parameter(model: str, parameter: str, /) -> str:
    """The name of a parameter of a preset or a model, which may be given by its former name."""

def quantity(name: str, text: str, unit: str, /) -> float:
    """The number of `unit` in a text such as `"3 mm"`, which must measure the same."""

def settings() -> list[str]:
    """The names of the solver settings, in the order of the signature of `flapwing.run`."""

def run(
    design: Any,
    keywords: dict[str, Any],
    /,
    *,
    point: SupportsIndex | None = None,
    initial_state: dict[str, Any] | None = None,
    waveform: str | dict[str, Any] | None = None,
    stroke: str | dict[str, Any] | None = None,
) -> NativeRow:
    """Runs one point; see `flapwing.run`."""

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
    """Samples the motion of one point; see `flapwing.trajectory`."""

@final
class LiveServer:
    """A running server; see `flapwing.Live`."""

    def __new__(
        cls, design: Any, keywords: dict[str, Any], /, *, port: int, threads: SupportsIndex | None
    ) -> LiveServer: ...
    @property
    def address(self) -> str:
        """The address of the page, with its token."""

    def stop(self) -> None:
        """Ends the server."""

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
) -> NativeResonances:
    """Finds the resonances of one point; see `flapwing.resonance`."""

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
    """Runs a chirp; see `flapwing.chirp`."""

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
    """Follows the motion after an impulse; see `flapwing.impulse`."""

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
    """Forces along a given motion; see `flapwing.forces_along`."""

def track_wing(points: str | dict[str, Any], /, *, chord: SupportsFloat | None = None) -> NativeTable:
    """Computes stroke and pitch; see `flapwing.track_wing`."""

def check(design: Any, /, *, keywords: dict[str, Any], measures: list[str] | None = None) -> None:
    """Checks that a design takes these keywords and has these measures, with the messages of `evaluate`."""

def text_of(entries: dict[str, Any], /) -> str:
    """The text of a grid file with these entries."""

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
    """Runs a batch of points; see `flapwing.evaluate`. `columns` has a one-dimensional array of float64, or a list of text,
    for each parameter that varies, all as long. `initial_state` has a row of state
    components per point, nan for a point at rest.
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
    """Follows responses; see `flapwing.respond`. `curves` chooses designs by their numbers, rising; `designs` of the result is the
    number of all.
    """

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
    """Runs a grid; see `flapwing.sweep`. `chunks` gives the rows of other processes: called with the number of points done,
    it gives the bytes of the next chunk.
    """

def part(grid: Grid, begin: int, end: int, /, *, threads: SupportsIndex | None = None) -> bytes:
    """Runs the points from `begin` to before `end`, and gives their rows as bytes that `sweep` takes as chunks."""

def identity() -> NativeIdentity:
    """The identity of this process, which decides the bits of its rows: `build`, a hash of the sources, and `arithmetic`."""

def command(line: list[str]) -> int:
    """Runs a command line, whose first word is the name of the program, and returns the exit code."""

def read(path: str | PathLike[str], /, *, ignore_damage: bool = False) -> NativeTable:
    """Reads a result file; see `flapwing.read`."""

def words(name: str, unit: str, /) -> str:
    """A column's name in words, without its unit: `lift_mean_mn` is "Lift, mean"."""

def printed(unit: str, /) -> str:
    """A unit as it is printed: `uN*m/rad` is "µN·m/rad", `mm^2` is "mm²", `deg` is "°"."""

def scale(unit: str, largest: float, /) -> tuple[float, str]:
    """The factor to a readable unit, and that unit as it is printed, for values in `unit` of which `largest` is the largest."""

def unit_of(name: str, /) -> str:
    """The unit of a column: that of the parameter or measure with this name in any model, or of the derivative of one by another,
    else the ending of the name; empty for none.
    """

def split_unit(name: str, /) -> tuple[str, str]:
    """A column's name without the unit that it ends in, and that unit; empty if there is none."""

def better(name: str, /) -> int:
    """The better direction of a column: 1 for a benefit such as lift, -1 for a cost such as power, 0 for neither."""

def colours() -> NativeColours:
    """The colours of pictures: `series` is a list, `branches` has a colour for each branch, and `dark`, `plain`, `missing` and
    `bistable` are one colour each.
    """

def line_shades(count: int, /) -> list[float] | None:
    """The place in the sequential map of each of `count` lines that have an order; None for a line alone."""

def is_signed(low: float, high: float, /) -> bool:
    """True if numbers from `low` to `high` have both signs: then the map is a diverging one, with zero in its middle."""

def usual_measure(role: str, columns: list[str], taken: list[str], /) -> str | None:
    """The measure that is drawn if none is named: the usual one among `columns` for a part, which is "response", "benefit",
    "cost" or "motion", and not in `taken`; None if there is none.
    """

def ways(
    up: tuple[np.ndarray[Any, Any], np.ndarray[Any, Any], np.ndarray[Any, Any]],
    down: tuple[np.ndarray[Any, Any], np.ndarray[Any, Any], np.ndarray[Any, Any]],
    /,
) -> NativeWays:
    """The bands in which the ways up and down of a response differ, and the rows of each after which it jumps to the other.
    `up` and `down` have the parameter, the measure, and the column `bistable`.
    """

def bars(values: np.ndarray[Any, Any], /) -> NativeBars | None:
    """The ends of a histogram's bars, their heights, and the values at its percentiles; None if no value is finite."""

def correlations(parameters: list[np.ndarray[Any, Any]], measure: np.ndarray[Any, Any], /) -> list[tuple[int, float]]:
    """The rank correlation of each parameter with a measure, by falling size, with the place of the parameter. Those that follow
    an earlier parameter, and those without a correlation, are left out.
    """
