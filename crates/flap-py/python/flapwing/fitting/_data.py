"""The data of a fit: readings of measures at operating points, in the model's units, with standard errors."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .. import _arguments, _flapwing
from .._mistakes import reading
from .._types import Array, Mask, Value
from ._cells import file_columns, measure_cells, parameter_cells, sigma_cells
from ._names import OTHER_COLUMNS, Names
from ._noise import UNKNOWN_NOISE, Noise, parse_noise

#: The allowed forms of the argument `data`, for error messages.
_ALLOWED = f"{_arguments.COLUMNS}, the path of a CSV file, or flapwing.Readings"


class Readings:
    """The readings of one experiment, to which `flapwing.fit` fits parameters.

    Parameters
    ----------
    columns : dict, Table, DataFrame or path
        Columns of operating points and measures, or the path of a CSV file with these columns. The name of a column is
        the name of a parameter or a measure. Parameters are in SI units, and measures are in the unit at the end of the
        measure's name. If a column does not have the default unit, write the unit in the name of the column
        (``drive_frequency_khz``, ``hinge_stiffness (uN*m/rad)``) or in each cell (``"0.12 kHz"``). A column with the
        name ``frequency_hz`` contains the parameter ``drive_frequency``, in hertz. A column with a measure's name and
        the suffix ``_sigma`` contains standard errors, in the measure's unit or as ``"3 %"``.
    name : str, optional
        The name of the data set in the report of a fit. The default of `name` is the name of the CSV file, or text such
        as ``"set 1"``.
    sigma : float, str or dict, optional
        The standard error of a reading: a number in the measure's unit, text such as ``"1 deg"``, or ``"3 %"`` of the
        model's value. A dictionary gives one standard error for each measure. By default, the standard error is
        estimated from the residuals.
    branch : {"up", "down"}, optional
        The branch of hysteresis on which the readings were taken: ``"up"`` if the value of `parameter` was increased
        during the experiment, ``"down"`` if the value was decreased.
    parameter : str, optional
        The parameter that was increased or decreased during the experiment, if you give `branch`. The default of
        `parameter` is ``"drive_frequency"``.
    **params : float or str
        Parameters that have the same value at all operating points of the experiment, such as ``drive_voltage_pp="160
        V"``.

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
            self.columns: dict[str, list[Any]] = dict(file_columns(columns))
        else:
            self.name = name or ""
            try:
                given: dict[str, Any] = _arguments.columns_of("data", columns)
            except TypeError as error:
                raise TypeError(str(error).replace(_arguments.COLUMNS, _ALLOWED)) from None
            self.columns = {header: _listed(header, cells) for header, cells in given.items()}
        self.sigma, self.branch, self.parameter, self.params = sigma, branch, parameter, params
        lengths = {header: len(cells) for header, cells in self.columns.items()}
        if len(set(lengths.values())) > 1:
            counts = ", ".join(f"`{header}` has {length}" for header, length in lengths.items())
            raise ValueError(f"columns differ in length: {counts}\ngive each one cell per row")
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
    """The readings of one data set, converted to the units of the model. Each row of a data set is an operating
    point.
    """

    name: str
    #: Parameters of the operating points: numbers in SI units, or options.
    points: dict[str, Array | list[str]]
    #: The readings of each measure, in the unit of the measure.
    measured: dict[str, Array]
    noise: dict[str, Noise]
    branch: str | None
    #: The parameter that was increased or decreased during the experiment, if `branch` is given.
    parameter: str

    def __len__(self) -> int:
        return len(next(iter(self.measured.values())))


def all_readings(sets: Sequence[DataSet]) -> Array:
    """Return the readings of all data sets in one array, in the order in which `places_of` lists the readings."""
    return np.concatenate([readings for one in sets for readings in one.measured.values()])


def places_of(sets: Sequence[DataSet]) -> list[tuple[DataSet, str, int]]:
    """Return the data set, the measure and the row of each reading. The first row has the number 0."""
    return [(one, measure, row) for one in sets for measure in one.measured for row in range(len(one))]


def are_unknown(sets: Sequence[DataSet], measure: str) -> Mask:
    """Return a mask with one entry for each reading. An entry is True if the reading is of the given measure and has no
    given standard error.
    """
    return np.concatenate(
        [
            np.full(len(one), name == measure and one.noise[name].kind == "unknown")
            for one in sets
            for name in one.measured
        ]
    )


def estimating(sets: Sequence[DataSet], measure: str, counted: Mask) -> Mask:
    """Return a mask that selects readings of a measure. The unknown standard error of the measure is estimated from the
    residuals of the selected readings.

    The result selects readings of the measure that have no given standard error and for which the mask `counted` is
    True. If all counted readings of the measure have given standard errors, the result selects all counted readings of
    the measure.
    """
    mine = counted & are_unknown(sets, measure)
    return mine if mine.any() else counted & np.array([name == measure for _, name, _ in places_of(sets)])


_READERS = {"parameter": parameter_cells, "measure": measure_cells, "sigma": sigma_cells}


def resolve(data: Any, names: Names, sigma: Any) -> list[DataSet]:
    """Return the data sets that are described by the arguments `data` and `sigma` of `fit`."""
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
    headers = [header for header in readings.columns if header not in OTHER_COLUMNS]
    for header, meaning in zip(headers, names.meanings(name, headers)):
        places: dict[str, dict[str, Any]] = {"parameter": points, "measure": measured, "sigma": errors}
        target = places[meaning.kind]
        if meaning.name in target:
            raise ValueError(f"{name} has `{meaning.name}` twice, once as `{header}`\nkeep one of the columns")
        read: Callable[..., Any] = _READERS[meaning.kind]
        target[meaning.name] = read(names, name, header, meaning, readings.columns[header])
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
