"""The data of a fit: readings of measures at operating points, in the model's units, with standard errors."""

from __future__ import annotations

import csv
import difflib
import os
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .. import _arguments, _flapwing
from .._flapwing import Grid
from .._mistakes import raised, reading
from .._types import Array, Design, Mask, Value

#: Columns of flap's tables that are neither parameters nor measures.
_COURSE = {
    "bistable",
    "branch",
    "curve",
    "cycles",
    "error_estimate",
    "floquet_max",
    "gradient_gap",
    "period",
    "point",
    "residual",
    "rhs_evals",
    "stable",
    "status",
}

#: Short names of columns in other tables of flap.
_SHORT = {"frequency": "drive_frequency"}

_IN_BRACKETS = re.compile(r"(.*?)\s*[(\[]\s*(.*?)\s*[)\]]\s*")


@dataclass(frozen=True)
class Meaning:
    """The meaning of a column of readings."""

    #: ``"parameter"``, ``"measure"``, or ``"sigma"`` for the standard error of a measure.
    kind: str
    #: The name of the parameter or measure.
    name: str
    #: The factor from the unit of the column to the unit of the parameter (SI) or of the measure.
    factor: float
    #: True if standard errors are in per cent of the model's value.
    is_share: bool = False


def _hint(name: str, known: list[str]) -> str:
    """Return the nearest known name as part of an error message; empty if no known name is near."""
    near = difflib.get_close_matches(name, known, n=1) or [other for other in known if other.startswith(f"{name}_")]
    return f", did you mean `{near[0]}`?" if near else ""


class Names:
    """The names of a design: its parameters and measures with their units."""

    def __init__(self, design: Design) -> None:
        self.grid = Grid(design)
        if len(self.grid) != 1:
            raise ValueError(
                f"the design has {len(self.grid)} points, but a fit takes one\n"
                "leave out its axes: the data contain the points"
            )
        self.model = self.grid.model
        self.states = _flapwing.states(self.model)
        self.nominal: dict[str, Any] = self.grid[0]
        listed = _flapwing.params(self.model)
        self.parameters = {parameter["name"]: parameter["unit"] for parameter in listed}
        self.options = {parameter["name"]: parameter["options"] for parameter in listed if parameter["options"]}
        self.measures = {measure["name"]: measure["unit"] for measure in _flapwing.measures(self.model)}

    def is_measure(self, name: str) -> bool:
        """Return True for a measure of the model or of the design's ``[measure]``."""
        if name in self.measures:
            return True
        try:
            _flapwing.check(self.grid, keywords={}, measures=[name])
        except ValueError:
            return False
        self.measures[name] = ""
        return True

    def parameter(self, name: str) -> str:
        """Return the name of a parameter. Raise ValueError for an unknown name."""
        return name if name in self.parameters else _flapwing.parameter(self.model, name)

    def unit(self, name: str) -> str:
        """Return the unit of a parameter or a measure."""
        return self.parameters[name] if name in self.parameters else self.measures[name]

    def meaning(self, place: str, header: str) -> Meaning:
        """Return the meaning of a column. Raise ValueError for a name that is neither a parameter nor a measure."""
        match = _IN_BRACKETS.fullmatch(header)
        name, unit = (match[1], match[2]) if match else (header, None)
        name = name.strip().replace(" ", "_")
        if name.lower() != name and not self._is_known(name):
            # "Stroke pp (deg)"
            name = name.lower()
        for mark, rest in (("sigma_", name.removeprefix("sigma_")), ("_sigma", name.removesuffix("_sigma"))):
            if rest != name and mark in name:
                is_share = unit == "%"
                found = self._found(place, header, rest, None if is_share else unit)
                if found is not None and found.kind == "measure":
                    return Meaning("sigma", found.name, 0.01 if is_share else found.factor, is_share)
        found = self._found(place, header, name, unit)
        if found is None:
            raise ValueError(
                f"{place} has the column `{header}`, which is neither a parameter nor a measure"
                f"{_hint(name, [*self.parameters, *self.measures])}\n"
                f"rename or remove it: flapwing.params({self.model!r}) and flapwing.measures({self.model!r}) "
                "list the names"
            )
        return found

    def check_measure(self, name: str) -> None:
        """Raise ValueError with the nearest name if `name` is not a measure."""
        if not self.is_measure(name):
            raise ValueError(
                f"there is no measure `{name}`{_hint(name, list(self.measures))}\n"
                f"flapwing.measures({self.model!r}) lists them"
            )

    def _is_known(self, name: str) -> bool:
        return name in self.parameters or self.is_measure(name)

    def _found(self, place: str, header: str, name: str, unit: str | None) -> Meaning | None:
        stem, ending = _flapwing.split_unit(name)
        for candidate, own in ((name, None), (stem, ending)):
            candidate = self._renamed(_SHORT.get(candidate, candidate))
            if candidate in self.parameters:
                return Meaning("parameter", candidate, self._factor(place, header, candidate, unit or own))
        if self.is_measure(name):
            return Meaning("measure", name, self._factor(place, header, name, unit))
        for measure in self.measures:
            if (ending or unit) and _flapwing.split_unit(measure)[0] == stem:
                return Meaning("measure", measure, self._factor(place, header, measure, unit or ending))
        return None

    def _renamed(self, name: str) -> str:
        try:
            return self.parameter(name)
        except ValueError:
            return name

    def _factor(self, place: str, header: str, name: str, unit: str | None) -> float:
        wanted = self.unit(name)
        if unit is None or unit == wanted:
            return 1.0
        if "%" in unit and wanted:
            raise ValueError(
                f"{place}, column `{header}`: per cent is no unit of `{name}`, which is in {wanted}\nconvert it"
            )
        try:
            return _flapwing.quantity(header, f"1 {unit}", wanted)
        except ValueError as error:
            raise ValueError(f"{place}, column `{header}`: {error}") from None


@dataclass(frozen=True)
class Noise:
    """The standard errors of the readings of a measure."""

    #: ``"absolute"``, ``"relative"`` to the model's value, or ``"unknown"``: estimated from the residuals.
    kind: str
    #: The standard error in the measure's unit, or as a share of the model's value.
    size: Array | float = 1.0

    def of(self, values: Array, measured: Array, guess: float) -> Array:
        """Return the standard errors of readings, given the model's values of these readings. `guess` replaces unknown
        standard errors.
        """
        if self.kind == "unknown":
            return np.full(len(measured), guess)
        if self.kind == "absolute":
            return np.broadcast_to(self.size, len(measured)).astype(np.float64)
        # A share of a value near zero is too small, so an error is at least a hundredth of the largest value's error.
        size = np.where(np.isfinite(values), np.abs(values), np.abs(measured))
        return np.asarray(self.size * np.maximum(size, 0.01 * np.abs(measured).max()))


UNKNOWN_NOISE = Noise("unknown")


def parse_noise(name: str, given: Any, measure: str, unit: str) -> Noise:
    """Parse the standard error of a measure: a number in the unit of the measure, or text such as ``"1 deg"`` or ``"3
    %"``.
    """
    wanted = (
        f'it must be a number in {unit or "the unit of the measure"}, or text such as "3 %"; '
        f"for errors of single readings, add a column {measure}_sigma"
    )
    relative = isinstance(given, str) and given.strip().endswith("%")
    if isinstance(given, str) and not relative:
        size = _flapwing.quantity(name, given, unit)
    else:
        try:
            size = float(given.strip()[:-1]) / 100 if isinstance(given, str) else float(given)
        except ValueError:
            raise ValueError(f"`{name}` is {given!r}\n{wanted}") from None
        except OverflowError:
            raise ValueError(f"`{name}` is too large for a 64-bit float\n{wanted}") from None
        except TypeError:
            raise TypeError(f"`{name}` is {type(given).__name__}\n{wanted}") from None
    if not (size > 0 and np.isfinite(size)):
        raise ValueError(f"`{name}` is {given!r} for {measure}\nstandard errors must be finite and more than zero")
    return Noise("relative" if relative else "absolute", size)


#: Separators of columns other than the comma, with their names.
_OTHERS = {";": "semicolons", "\t": "tabs"}


def _file_columns(path: str | os.PathLike[str]) -> dict[str, list[str]]:
    """Return the columns of a CSV file, whose cells are text. Lines that begin with # are comments."""
    name = os.fspath(path)
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            lines = [line for line in csv.reader(file) if line and not line[0].lstrip().startswith("#")]
    except FileNotFoundError:
        raise FileNotFoundError(
            f"there is no file {name}\ngive the path of a CSV file, a dictionary of columns, or a DataFrame"
        ) from None
    except UnicodeDecodeError:
        raise ValueError(f"{name} is not UTF-8 text\nsave it as CSV in UTF-8") from None
    if not lines:
        raise ValueError(f"{name} is empty\nits first line has the names of the columns")
    headers = [header.strip() for header in lines[0]]
    for mark, told in _OTHERS.items():
        if len(headers) == 1 and mark in headers[0]:
            raise ValueError(
                f"{name} has {told} between its columns\nsave it with commas and decimal points, "
                f"or read it with pandas: pandas.read_csv({name!r}, sep={mark!r})"
            )
    twice = sorted({header for header in headers if headers.count(header) > 1})
    if twice:
        raise ValueError(f"{name} has two columns called `{twice[0]}`\nrename or remove one")
    for number, line in enumerate(lines[1:], 1):
        if len(line) != len(headers):
            raise ValueError(
                f"{name}, row {number} has {len(line)} cells, and the header has {len(headers)}\nadd or remove cells"
            )
    return {header: [line[place].strip() for line in lines[1:]] for place, header in enumerate(headers)}


#: The help in the error message for a cell without a number.
_MISSING = "remove the row, or put the other measures into a separate data set"

#: The help in the error message for a value outside its parameter's range.
_IMPOSSIBLE = "correct the cell, or remove the row"

#: A pattern for the beginning of a number.
_NUMBER = re.compile(r"\s*[-+]?\.?\d")


def parameter_cells(names: Names, place: str, header: str, meaning: Meaning, cells: list[Any]) -> Array | list[str]:
    """Return the values in a column of a parameter: numbers in SI units, or names of options. Raise ValueError for
    values out of range.
    """

    def value(cell: Any) -> float:
        try:
            return _flapwing.value(names.model, meaning.name, cell)
        except ValueError as error:
            told = str(error)
            raise ValueError(told if "\n" in told else f"{told}\n{_IMPOSSIBLE}") from None

    if meaning.name in names.options:
        found: Any = [str(cell) for cell in cells]
    else:
        found = _numbers(place, header, meaning, cells, value)
    known: set[Any] = set()
    for row, cell in enumerate(found if isinstance(found, list) else found.tolist()):
        if cell not in known:
            try:
                value(cell)
            except ValueError as error:
                raise ValueError(f"{place}, column `{header}`, row {row + 1}: {error}") from None
            known.add(cell)
    return found


def measure_cells(names: Names, place: str, header: str, meaning: Meaning, cells: list[Any]) -> Array:
    """Return the values in a column of a measure, in the unit of the measure."""
    unit = names.unit(meaning.name)

    def read(cell: str) -> float:
        if "%" in cell and unit:
            raise ValueError(f"`{meaning.name}` is in {unit}, but `{cell}` is a share\nwrite readings in {unit}")
        return _flapwing.quantity(meaning.name, cell, unit)

    return _numbers(place, header, meaning, cells, read)


def sigma_cells(names: Names, place: str, header: str, meaning: Meaning, cells: list[Any]) -> Noise:
    """Return the standard errors in a column: in the unit of the measure, or in per cent of the model's value."""
    shares = [isinstance(cell, str) and cell.strip().endswith("%") for cell in cells]
    if all(shares) and not meaning.is_share:
        meaning = Meaning(meaning.kind, meaning.name, 0.01, True)
        cells = [cell.strip()[:-1] for cell in cells]
    found = measure_cells(names, place, header, meaning, cells)
    if not (found > 0).all():
        row = int(np.argmin(found > 0)) + 1
        raise ValueError(
            f"{place}, standard error of `{meaning.name}`, row {row}: it must be more than zero\n"
            "if errors are unknown, leave the column out: then they are estimated"
        )
    return Noise("relative" if meaning.is_share else "absolute", found)


def _numbers(place: str, header: str, meaning: Meaning, cells: list[Any], read: Callable[[str], float]) -> Array:
    found = []
    for row, cell in enumerate(cells):
        told = f"{place}, column `{header}`, row {row + 1}"
        if not isinstance(cell, str) or _is_number(cell):
            found.append(meaning.factor * _number(told, cell))
        elif not cell.strip():
            raise ValueError(f"{told}: the cell is empty, but a reading needs a number\n{_MISSING}")
        elif not _NUMBER.match(cell):
            raise ValueError(f"{told}: {cell!r} is not a number\nwrite a number, or text with a unit; or {_MISSING}")
        else:
            try:
                found.append(read(cell))
            except ValueError as error:
                raise ValueError(f"{told}: {error}") from None
    return np.array(found)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _number(told: str, cell: Any) -> float:
    if isinstance(cell, (bool, np.bool_)) or cell is None:
        raise ValueError(f"{told} is {cell}, which is not a number\n{_MISSING}")
    try:
        number = float(cell)
    except OverflowError:
        raise ValueError(f"{told} is too large for a 64-bit float\nwrite a number, or text with a unit") from None
    except (TypeError, ValueError):
        raise ValueError(f"{told} is {cell!r}, which is not a number\nwrite a number, or text with a unit") from None
    except Exception as error:
        found = f"{type(cell).__name__}, which raised {raised(error)}"
        raise TypeError(f"{told} is {found}\nwrite a number, or text with a unit") from error
    if not np.isfinite(number):
        raise ValueError(f"{told} is {number}, but readings must be finite numbers\n{_MISSING}")
    return number


#: The allowed forms of the argument `data`, for error messages.
_ALLOWED = f"{_arguments.COLUMNS}, the path of a CSV file, or flapwing.Readings"


class Readings:
    """The readings of one experiment, for `fit`.

    Parameters
    ----------
    columns : dict, Table, DataFrame or path
        Columns of operating points and measures, or a CSV file with such columns. The name of a column is the name of a
        parameter or a measure. Parameters are in SI units and measures in their own unit. The name of a column
        (``drive_frequency_khz``, ``hinge_stiffness (uN*m/rad)``) or each cell (``"0.12 kHz"``) may have another unit.
        ``frequency_hz`` means ``drive_frequency``. A measure's name with the suffix ``_sigma`` is a column of standard
        errors, in the measure's unit or as ``"3 %"``.
    name : str, optional
        The name of the data set in reports. Default: the name of the file, or the number of the data set.
    sigma : float, str or dict, optional
        The standard error of a reading: a number in the measure's unit, text such as ``"1 deg"``, or ``"3 %"`` of the
        model's value. A dictionary gives one standard error for each measure. Default: the standard error is estimated
        from the residuals.
    branch : {"up", "down"}, optional
        For a design with hysteresis, the branch of the readings: ``"up"`` if `parameter` rose during the experiment,
        ``"down"`` if `parameter` fell.
    parameter : str, optional
        The parameter that rose or fell during the experiment. Default ``"drive_frequency"``.
    **params : float or str
        Parameters of all operating points, such as ``drive_voltage_pp="160 V"``.

    Examples
    --------
    >>> columns = {"frequency_hz": [100, 110], "stroke_pp_deg": [50.0, 61.0]}
    >>> flapwing.Readings(columns, drive_voltage_pp="100 V", sigma="2 %")
    <flapwing.Readings of 2 rows: frequency_hz, stroke_pp_deg>
    """

    def __init__(
        self,
        columns: Mapping[str, Any] | str | os.PathLike[str] | Any,
        /,
        *,
        name: str | None = None,
        sigma: Any = None,
        branch: str | None = None,
        parameter: str = "drive_frequency",
        **params: Value,
    ) -> None:
        if branch not in (None, "up", "down"):
            raise ValueError(
                f'`branch` is {branch!r}\nit must be "up" or "down", the direction in which the parameter was changed'
            )
        if isinstance(columns, (str, os.PathLike)):
            self.name = name or Path(columns).name
            self.columns: dict[str, list[Any]] = dict(_file_columns(columns))
        else:
            self.name = name or ""
            try:
                given: dict[str, Any] = _arguments.columns_of("data", columns)
            except TypeError as error:
                told = str(error).replace(_arguments.COLUMNS, _ALLOWED)
                raise TypeError(told) from None
            self.columns = {header: _listed(header, cells) for header, cells in given.items()}
        self.sigma, self.branch, self.parameter, self.params = sigma, branch, parameter, params
        lengths = {header: len(cells) for header, cells in self.columns.items()}
        if len(set(lengths.values())) > 1:
            told = ", ".join(f"`{header}` has {length}" for header, length in lengths.items())
            raise ValueError(f"columns differ in length: {told}\ngive each one cell per row")
        if not lengths or not next(iter(lengths.values())):
            raise ValueError(
                f"{self.name or 'the data set'} is empty\n"
                "give columns of parameters and measures with a row per reading"
            )

    def __repr__(self) -> str:
        rows = len(next(iter(self.columns.values())))
        return f"<flapwing.Readings of {rows} row{'s' * (rows != 1)}: {', '.join(self.columns)}>"


@dataclass(frozen=True)
class DataSet:
    """The readings of one data set in the model's units, with one row per operating point."""

    name: str
    #: Parameters of the operating points: numbers in SI units, or options.
    points: dict[str, Array | list[str]]
    #: The readings of each measure, in the unit of the measure.
    measured: dict[str, Array]
    noise: dict[str, Noise]
    branch: str | None
    #: The parameter that rose or fell during the experiment.
    parameter: str

    def __len__(self) -> int:
        return len(next(iter(self.measured.values())))


_READERS = {"parameter": parameter_cells, "measure": measure_cells, "sigma": sigma_cells}


def resolve(data: Any, names: Names, sigma: Any) -> list[DataSet]:
    """Return the data sets of a call of `fit`."""
    listed = list(data) if isinstance(data, (list, tuple)) else [data]
    if not listed:
        raise ValueError("there are no data\ngive columns of readings, or a list of data sets")
    sets = []
    for number, one in enumerate(listed):
        readings = one if isinstance(one, Readings) else Readings(one)
        sets.append(_resolved(readings, readings.name or f"set {number + 1}", names, sigma))
    if len({one.name for one in sets}) < len(sets):
        raise ValueError(f"data sets share a name: {', '.join(one.name for one in sets)}\ngive each its own name")
    _check_sigma("`sigma`", sigma, list(dict.fromkeys(measure for one in sets for measure in one.measured)))
    return sets


def _resolved(readings: Readings, name: str, names: Names, sigma: Any) -> DataSet:
    points: dict[str, Array | list[str]] = {}
    measured: dict[str, Array] = {}
    errors: dict[str, Noise] = {}
    rows = len(next(iter(readings.columns.values())))
    for header, cells in readings.columns.items():
        if header in _COURSE:
            continue
        meaning = names.meaning(name, header)
        places: dict[str, dict[str, Any]] = {"parameter": points, "measure": measured, "sigma": errors}
        target = places[meaning.kind]
        if meaning.name in target:
            raise ValueError(f"{name} has `{meaning.name}` twice, once as `{header}`\nkeep one of the columns")
        read: Callable[..., Any] = _READERS[meaning.kind]
        target[meaning.name] = read(names, name, header, meaning, cells)
    for parameter, value in ((names.parameter(given), value) for given, value in readings.params.items()):
        if parameter in points:
            raise ValueError(f"{name} has `{parameter}` as a column and as an argument\nkeep one of them")
        if parameter in names.options:
            points[parameter] = [str(value)] * rows
        else:
            points[parameter] = np.full(rows, _flapwing.value(names.model, parameter, value))
    if not measured:
        raise ValueError(f"{name} has no column of a measure\nadd one, such as stroke_pp_deg")
    for measure, values in measured.items():
        if np.ptp(values) == 0.0 and (rows >= 2 or values[0] == 0.0):
            raise ValueError(
                f"{name}: all {rows} readings of `{measure}` are {values[0]:g}, so they contain no information\n"
                "remove the column, or check where it comes from"
            )
    _check_branch(name, readings, points)
    _check_sigma(f"`sigma` of {name}", readings.sigma, list(measured))
    noise = {measure: _noise_of(name, measure, errors, readings.sigma, sigma, names) for measure in measured}
    return DataSet(name, points, measured, noise, readings.branch, readings.parameter)


def _check_branch(name: str, readings: Readings, points: Mapping[str, Any]) -> None:
    if readings.branch is not None and not isinstance(points.get(readings.parameter), np.ndarray):
        raise ValueError(
            f"{name} is on the branch {readings.branch} along `{readings.parameter}`, but has no column of it\n"
            "add the column, or give the changed parameter as parameter="
        )


def _check_sigma(place: str, given: Any, measured: list[str]) -> None:
    for measure in given if isinstance(given, Mapping) else ():
        if measure not in measured:
            raise ValueError(
                f"{place} has `{measure}`, but there are no readings of it\nchoose among {', '.join(measured)}"
            )


def _noise_of(name: str, measure: str, errors: Mapping[str, Noise], own: Any, common: Any, names: Names) -> Noise:
    if measure in errors:
        return errors[measure]
    for given in (own, common):
        found = given.get(measure) if isinstance(given, Mapping) else given
        if found is not None:
            return parse_noise("sigma", found, measure, names.unit(measure))
    return UNKNOWN_NOISE


def _listed(header: str, cells: Any) -> list[Any]:
    if isinstance(cells, (str, bytes)) or not hasattr(cells, "__iter__"):
        raise TypeError(
            f"column `{header}` is {type(cells).__name__}\nit must be a list, an array or a Series with a cell per row"
        )
    with reading(f"column {header}", cells, "it must be a list, an array or a Series with a cell per row"):
        return list(cells.tolist() if isinstance(cells, np.ndarray) else cells)


_HOLD_OUT = (
    "it must be a share such as 0.2, names of data sets, "
    'or ranges of parameters such as {"drive_frequency": (110, 120)}'
)


def held_rows(hold_out: Any, sets: Sequence[DataSet], seed: int, count: int, names: Names) -> Mask:
    """Return a mask, which is True for readings that are predicted instead of fitted."""
    if hold_out is None:
        return np.zeros(count, np.bool_)
    if isinstance(hold_out, Mapping):
        held = _in_ranges(hold_out, sets, names)
    elif isinstance(hold_out, (int, float)) and not isinstance(hold_out, bool):
        if not 0 < hold_out < 1:
            raise ValueError(f"`hold_out` is {hold_out!r}\n{_HOLD_OUT}")
        held = np.zeros(count, np.bool_)
        chosen = np.random.default_rng(seed).permutation(count)[: max(1, round(hold_out * count))]
        held[chosen] = True
    else:
        named = [hold_out] if isinstance(hold_out, str) else hold_out
        if not isinstance(named, (list, tuple)) or not all(isinstance(name, str) for name in named):
            raise TypeError(f"`hold_out` is {type(hold_out).__name__}\n{_HOLD_OUT}")
        known = [one.name for one in sets]
        for name in named:
            if name not in known:
                raise ValueError(f"`hold_out` has {name!r}, but the data sets are {', '.join(known)}\n{_HOLD_OUT}")
        held = np.concatenate([np.full(len(one) * len(one.measured), one.name in named) for one in sets])
    if not held.any() or held.all():
        raise ValueError(f"`hold_out` holds {'all' if held.all() else 'none'} of the {count} readings out\n{_HOLD_OUT}")
    return held


def _in_ranges(ranges: Mapping[Any, Any], sets: Sequence[DataSet], names: Names) -> Mask:
    parts = []
    ends = {name: _range(name, given, names) for name, given in ranges.items()}
    for one in sets:
        inside = np.ones(len(one), np.bool_)
        for name, (low, high) in ends.items():
            values = one.points.get(name)
            if not isinstance(values, np.ndarray):
                raise ValueError(f"`hold_out` has `{name}`, but {one.name} has no such column of numbers\n{_HOLD_OUT}")
            inside &= (values >= low) & (values <= high)
        parts += [inside] * len(one.measured)
    return np.concatenate(parts)


def _range(name: Any, given: Any, names: Names) -> tuple[float, float]:
    """Return the smallest and the largest value of a range, in SI units."""
    place = f"hold_out[{name!r}]"
    if not isinstance(given, (tuple, list)) or len(given) != 2:
        raise TypeError(
            f"{place} is {type(given).__name__}\nit must be a range (from, to) in SI units, or text with a unit"
        )
    if name not in names.parameters or name in names.options:
        raise ValueError(f"`hold_out` has `{name}`, which is not a parameter with a range\n{_HOLD_OUT}")
    try:
        low, high = (_flapwing.value(names.model, name, end) for end in given)
    except (TypeError, ValueError) as error:
        raise type(error)(f"{place}: {error}") from None
    if low > high:
        raise ValueError(f"{place}: {low:g} is more than {high:g}\nexchange them")
    return low, high
