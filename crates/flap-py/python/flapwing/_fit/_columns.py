"""The meaning of a column of readings: a parameter or a measure, in some unit."""

from __future__ import annotations

import difflib
import re
from dataclasses import dataclass
from typing import Any

from .. import _flapwing
from .._flapwing import Grid
from .._types import Design

#: Columns of flap's own tables that are neither.
COURSE = {
    "point", "curve", "branch", "bistable", "status", "cycles", "residual", "period", "floquet_max", "stable", "error_estimate",
    "rhs_evals", "gradient_gap",
}  # fmt: skip

#: Short names that other tables of flap use.
_SHORT = {"frequency": "drive_frequency"}

_IN_BRACKETS = re.compile(r"(.*?)\s*[(\[]\s*(.*?)\s*[)\]]\s*")


@dataclass(frozen=True)
class Meaning:
    """The meaning of a column."""

    #: ``"parameter"``, ``"measure"``, or ``"sigma"`` for the standard error of a measure.
    kind: str
    #: The parameter or measure.
    name: str
    #: The factor from the column's unit to that of the parameter (SI) or of the measure.
    factor: float
    #: True for standard errors in per cent of the model's value.
    is_share: bool = False


def _hint(name: str, known: list[str]) -> str:
    """The nearest of the known names, for messages; empty if none is near."""
    near = difflib.get_close_matches(name, known, n=1) or [other for other in known if other.startswith(f"{name}_")]
    return f", did you mean `{near[0]}`?" if near else ""


class Names:
    """The names of a design: its parameters and measures with their units."""

    def __init__(self, design: Design) -> None:
        self.grid = Grid(design)
        if len(self.grid) != 1:
            raise ValueError(
                f"the design has {len(self.grid)} points, and a fit is about one\nleave out its axes: data give the points"
            )
        self.model = self.grid.model
        self.states = _flapwing.states(self.model)
        self.nominal: dict[str, Any] = self.grid[0]
        self.parameters = {name: unit for name, _, unit, *_ in _flapwing.params(self.model)}
        self.options = {name: options for name, *_, options in _flapwing.params(self.model) if options}
        self.measures = {name: unit for name, unit, _ in _flapwing.measures(self.model)}

    def is_measure(self, name: str) -> bool:
        """True for a measure of the model, or of the design's ``[measure]``."""
        if name in self.measures:
            return True
        try:
            _flapwing.check(self.grid, keywords={}, measures=[name])
        except ValueError:
            return False
        self.measures[name] = ""
        return True

    def parameter(self, name: str) -> str:
        """The name of a parameter, which may be given by its former name; a ValueError with the nearest name for another."""
        return name if name in self.parameters else _flapwing.parameter(self.model, name)

    def unit(self, name: str) -> str:
        """The unit of a parameter or a measure."""
        return self.parameters[name] if name in self.parameters else self.measures[name]

    def meaning(self, place: str, header: str) -> Meaning:
        """The meaning of a column; a ValueError for a name that is neither a parameter nor a measure."""
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
                f"rename or remove it: flapwing.params({self.model!r}) and flapwing.measures({self.model!r}) list the names"
            )
        return found

    def check_measure(self, name: str) -> None:
        """A ValueError with the nearest name for what is no measure."""
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
