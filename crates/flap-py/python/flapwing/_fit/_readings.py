"""Data of a fit: readings of measures at operating points."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Mapping

import numpy as np

from .. import _arguments, _flapwing
from .._mistakes import reading
from .._types import Value
from . import _cells, _file, _noise
from ._columns import COURSE, Names
from ._noise import Noise
from ._types import Array

#: The forms that data may have, for messages.
_ALLOWED = f"{_arguments.COLUMNS}, the path of a CSV file, or flapwing.Readings"


class Readings:
    """The readings of one experiment, for `fit`.

    Parameters
    ----------
    columns : dict, Table, DataFrame or path
        Columns of the operating points and of measures, or a CSV file of them. A column has the name of a parameter or a
        measure; its unit is SI or that of the measure, another one in the name (``drive_frequency_khz``,
        ``hinge_stiffness (uN*m/rad)``), or one in each cell (``"0.12 kHz"``). ``frequency_hz`` stands for
        ``drive_frequency``. A column with ``_sigma`` behind the name of a measure has its standard errors, in the measure's
        unit or as ``"3 %"``.
    name : str, optional
        The name in reports. Default: that of the file, or the number of the data set.
    sigma : float, str or dict, optional
        The standard error of a reading: a number in the measure's unit, ``"1 deg"`` or ``"3 %"`` of the model's value; or
        such by measure. Without one it is estimated from the residuals.
    branch : {"up", "down"}, optional
        The way on which the readings were taken where the design has hysteresis: as `along` rises or as it falls.
    along : str, optional
        The parameter that was moved. Default ``"drive_frequency"``.
    **params : float or str
        Parameters of all operating points, such as ``drive_voltage_pp="160 V"``.

    Examples
    --------
    >>> flapwing.Readings({"frequency_hz": [100, 110], "stroke_pp_deg": [50.0, 61.0]}, drive_voltage_pp="100 V", sigma="2 %")
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
        along: str = "drive_frequency",
        **params: Value,
    ) -> None:
        if branch not in (None, "up", "down"):
            raise ValueError(
                f'`branch` is {branch!r}\nit must be "up" or "down": the way on which the readings were taken'
            )
        if isinstance(columns, (str, os.PathLike)):
            self.name = name or Path(columns).name
            self.columns: dict[str, list[Any]] = dict(_file.columns_of(columns))
        else:
            self.name = name or ""
            try:
                given: dict[str, Any] = _arguments.columns_of("data", columns)
            except TypeError as error:
                told = str(error).replace(_arguments.COLUMNS, _ALLOWED)
                raise TypeError(told) from None
            self.columns = {header: _listed(header, cells) for header, cells in given.items()}
        self.sigma, self.branch, self.along, self.params = sigma, branch, along, params
        lengths = {header: len(cells) for header, cells in self.columns.items()}
        if len(set(lengths.values())) > 1:
            told = ", ".join(f"`{header}` has {length}" for header, length in lengths.items())
            raise ValueError(f"columns differ in length: {told}\ngive each one cell per row")
        if not lengths or not next(iter(lengths.values())):
            raise ValueError(
                f"{self.name or 'the data set'} is empty\ngive columns of parameters and measures with a row per reading"
            )

    def __repr__(self) -> str:
        rows = len(next(iter(self.columns.values())))
        return f"<flapwing.Readings of {rows} row{'s' * (rows != 1)}: {', '.join(self.columns)}>"


@dataclass(frozen=True)
class DataSet:
    """Readings in the units of the model: a row per operating point."""

    name: str
    #: Parameters of the operating points: numbers in SI units, or options.
    points: dict[str, Array | list[str]]
    #: The readings by measure, in its unit.
    measured: dict[str, Array]
    noise: dict[str, Noise]
    branch: str | None
    along: str

    def __len__(self) -> int:
        return len(next(iter(self.measured.values())))


_READERS = {"parameter": _cells.parameters, "measure": _cells.measures, "sigma": _cells.errors}


def resolve(data: Any, names: Names, sigma: Any) -> list[DataSet]:
    """The data sets of a call."""
    listed = list(data) if isinstance(data, (list, tuple)) else [data]
    if not listed:
        raise ValueError("there are no data\ngive columns of readings, or a list of data sets")
    sets = []
    for number, one in enumerate(listed):
        readings = one if isinstance(one, Readings) else Readings(one)
        sets.append(_resolved(readings, readings.name or f"set {number + 1}", names, sigma))
    if len({one.name for one in sets}) < len(sets):
        raise ValueError(f"data sets share a name: {', '.join(one.name for one in sets)}\ngive each one of its own")
    _check_sigma("`sigma`", sigma, list(dict.fromkeys(measure for one in sets for measure in one.measured)))
    return sets


def _resolved(readings: Readings, name: str, names: Names, sigma: Any) -> DataSet:
    points: dict[str, Array | list[str]] = {}
    measured: dict[str, Array] = {}
    errors: dict[str, Noise] = {}
    rows = len(next(iter(readings.columns.values())))
    for header, cells in readings.columns.items():
        if header in COURSE:
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
                f"{name}: all {rows} readings of `{measure}` are {values[0]:g}, and tell nothing about parameters\n"
                "remove the column, or check where it comes from"
            )
    _check_along(name, readings, points)
    _check_sigma(f"`sigma` of {name}", readings.sigma, list(measured))
    noise = {measure: _noise_of(name, measure, errors, readings.sigma, sigma, names) for measure in measured}
    return DataSet(name, points, measured, noise, readings.branch, readings.along)


def _check_along(name: str, readings: Readings, points: Mapping[str, Any]) -> None:
    if readings.branch is not None and not isinstance(points.get(readings.along), np.ndarray):
        raise ValueError(
            f"{name} is on the way {readings.branch} along `{readings.along}`, and has no column of it\n"
            "add the column, or give along= the parameter that was moved"
        )


def _check_sigma(place: str, given: Any, measured: list[str]) -> None:
    for measure in given if isinstance(given, Mapping) else ():
        if measure not in measured:
            raise ValueError(
                f"{place} names `{measure}`, of which there are no readings\nchoose among {', '.join(measured)}"
            )


def _noise_of(name: str, measure: str, errors: Mapping[str, Noise], own: Any, common: Any, names: Names) -> Noise:
    if measure in errors:
        return errors[measure]
    for given in (own, common):
        found = given.get(measure) if isinstance(given, Mapping) else given
        if found is not None:
            return _noise.of("sigma", found, measure, names.unit(measure))
    return _noise.UNKNOWN


def _listed(header: str, cells: Any) -> list[Any]:
    if isinstance(cells, (str, bytes)) or not hasattr(cells, "__iter__"):
        raise TypeError(
            f"column `{header}` is {type(cells).__name__}\nit must be a list, an array or a Series with a cell per row"
        )
    with reading(f"column {header}", cells, "it must be a list, an array or a Series with a cell per row"):
        return list(cells.tolist() if isinstance(cells, np.ndarray) else cells)
