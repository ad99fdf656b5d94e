"""The names of parameters and measures, and the parameter or measure that each column of readings contains."""

from __future__ import annotations

import difflib
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from .. import _flapwing
from .._flapwing import Grid
from .._types import Design

#: Columns of flap's tables that are neither parameters nor measures.
OTHER_COLUMNS = {
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
    """The content of a column of readings: a parameter, a measure, or standard errors of a measure."""

    #: ``"parameter"``, ``"measure"``, or ``"sigma"`` for the standard error of a measure.
    kind: str
    #: The name of the parameter or measure.
    name: str
    #: The factor from the unit of the column to the unit of the parameter (SI) or of the measure.
    factor: float
    #: True if standard errors are in per cent of the model's value.
    is_share: bool = False


def _hint(name: str, known: list[str]) -> str:
    """Return a part of an error message that proposes the most similar known name. Return an empty text if no known
    name is similar.
    """
    near = difflib.get_close_matches(name, known, n=1) or [other for other in known if other.startswith(f"{name}_")]
    return f", did you mean `{near[0]}`?" if near else ""


class Names:
    """The names and units of the parameters and measures of a design."""

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
        """Return True if `name` is a measure of the model, or a measure that the design defines under ``[measure]``. If
        the design defines the measure, the method adds the measure, without a unit, to the attribute `measures`.
        """
        if name in self.measures:
            return True
        try:
            _flapwing.check(self.grid, keywords={}, measures=[name])
        except ValueError:
            return False
        self.measures[name] = ""
        return True

    def parameter(self, name: str) -> str:
        """Return the full name of a parameter. Raise ValueError if no parameter has the given name."""
        return name if name in self.parameters else _flapwing.parameter(self.model, name)

    def unit(self, name: str) -> str:
        """Return the unit of a parameter or a measure."""
        return self.parameters[name] if name in self.parameters else self.measures[name]

    def meaning(self, place: str, header: str) -> Meaning:
        """Return the content of a column of readings: a parameter, a measure, or standard errors of a measure. Raise
        ValueError if the header is neither a parameter nor a measure.
        """
        return self.meanings(place, [header])[0]

    def meanings(self, place: str, headers: Sequence[str]) -> list[Meaning]:
        """Return the content of each column of readings: a parameter, a measure, or standard errors of a measure. Raise
        ValueError if a header is neither a parameter nor a measure.
        """
        found = [self._meaning(place, header) for header in headers]
        unknown = [header for header, one in zip(headers, found) if one is None]
        if unknown:
            known = [*self.parameters, *self.measures]
            if len(unknown) == 1:
                header = unknown[0]
                columns = f"the column `{header}`, which is neither a parameter nor a measure{_hint(header, known)}"
            else:
                listed = "; ".join(f"`{header}`{_hint(header, known)}" for header in unknown)
                columns = f"{len(unknown)} columns that are neither parameters nor measures: {listed}"
            raise ValueError(
                f"{place} has {columns}\nrename or remove {'it' if len(unknown) == 1 else 'them'}: "
                f"flapwing.params({self.model!r}) and flapwing.measures({self.model!r}) list the names"
            )
        return [one for one in found if one is not None]

    def _meaning(self, place: str, header: str) -> Meaning | None:
        match = _IN_BRACKETS.fullmatch(header)
        name, unit = (match[1], match[2]) if match else (header, None)
        name = name.strip().replace(" ", "_")
        if name.lower() != name and not self._is_known(name):
            # "Stroke pp (deg)"
            name = name.lower()
        for mark, rest in (("sigma_", name.removeprefix("sigma_")), ("_sigma", name.removesuffix("_sigma"))):
            if rest != name and mark in name:
                is_share = unit == "%"
                found = self._parameter_or_measure(place, header, rest, None if is_share else unit)
                if found is not None and found.kind == "measure":
                    return Meaning("sigma", found.name, 0.01 if is_share else found.factor, is_share)
        return self._parameter_or_measure(place, header, name, unit)

    def check_measure(self, name: str) -> None:
        """Raise ValueError if `name` is not a measure. The error message proposes the most similar name."""
        if not self.is_measure(name):
            raise ValueError(
                f"there is no measure `{name}`{_hint(name, list(self.measures))}\n"
                f"flapwing.measures({self.model!r}) lists them"
            )

    def _is_known(self, name: str) -> bool:
        return name in self.parameters or self.is_measure(name)

    def _parameter_or_measure(self, place: str, header: str, name: str, unit: str | None) -> Meaning | None:
        """Return the parameter or measure that a column contains. Return None if the name of the column is unknown."""
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
