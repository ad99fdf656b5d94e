"""The free parameters of a fit, and the coordinates in which the fit searches."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import _flapwing
from .._types import Array, Places, Value
from ._data import DataSet
from ._names import Names
from ._typical import typical_bounds

#: Default bounds of a parameter, as factors on its value in the design.
_REACH = 3.0


@dataclass(frozen=True)
class FreeParameter:
    """A parameter that `fit` estimates, with its bounds, its prior, and its variation between data sets.

    Attributes
    ----------
    low, high : float or str, optional
        Bounds of the parameter, in SI units or as text with units. The default bounds are a third of the design's value
        and three times the design's value. If the design's value is zero or not set, the page of `flapwing.candidates`
        contains the default bounds. If the page of `flapwing.candidates` contains no bounds for a parameter that is
        zero or not set, `low` and `high` are required. The first search begins at the design's value, or at the middle
        of the bounds if the design's value is outside of the bounds. A bound can be zero if the parameter can be zero.
    prior : (value, error), optional
        A value of the parameter that is known before the fit, and the standard error of this value. Give the value and
        the standard error as numbers in SI units or as text with units. The standard error of a prior can also be a
        share of the value, such as ``"5 %"``.
    per_set : bool
        True if each data set has a separate value of the parameter, for example if the wing was changed between
        experiments.
    spread : float, str or True, optional
        The scatter of the parameter between several robots of the same design. Each data set has a separate value of
        the parameter, and the values of all data sets scatter about a common mean (normal distribution). The spread is
        the standard deviation of the scatter: a number in SI units, text with a unit, or text such as ``"5 %"`` of the
        mean. If `spread` is True, the standard deviation is estimated from the data. If you give `spread`, you cannot
        give `prior`.
    """

    low: Value | None = None
    high: Value | None = None
    prior: tuple[Value, Value] | None = None
    per_set: bool = False
    spread: Value | bool | None = None


@dataclass(frozen=True)
class Coordinate:
    """A coordinate of the search. A coordinate describes the value of a free parameter for all data sets, or for one
    data set.
    """

    parameter: str
    #: The index of the data set to which the coordinate applies; None for all data sets.
    of_set: int | None
    label: str
    unit: str
    #: True for a logarithmic coordinate, which requires bounds of the same sign.
    log: bool
    low: float
    high: float
    nominal: float
    prior: tuple[float, float] | None

    def value(self, x: Any) -> Any:
        """Return the value of the parameter in SI units for a value `x` of the coordinate. At ``x = 0``, the parameter
        has the value `nominal`, which is usually the design's value.
        """
        # Rounding must not lead out of the bounds: a parameter may have no values below its bound.
        value = self.nominal * np.exp(x) if self.log else self.nominal + self.width * x
        return np.clip(value, self.low, self.high)

    def at(self, value: float) -> float:
        """Return the value of the coordinate for a value of the parameter in SI units."""
        return float(np.log(value / self.nominal) if self.log else (value - self.nominal) / self.width)

    def slope(self, x: float) -> float:
        """Return the derivative of the parameter's value with respect to the coordinate."""
        return float(self.value(x) if self.log else self.width)

    @property
    def width(self) -> float:
        """The unit of a linear coordinate: half of the difference between the bounds of the parameter."""
        return 0.5 * (self.high - self.low)


@dataclass(frozen=True)
class Group:
    """The coordinates of a parameter with a spread: one value for each data set, and all values scatter about a common
    mean.
    """

    parameter: str
    places: Places
    #: The given standard deviation, in SI units or as a share of the mean; None if the standard deviation is estimated.
    given: float | None
    is_share: bool


class Space:
    """All coordinates in which a fit searches."""

    def __init__(self, coordinates: Sequence[Coordinate], groups: Sequence[Group] = ()) -> None:
        self.coordinates, self.groups = list(coordinates), list(groups)
        #: The present standard deviation of each parameter of `groups`, which a fit updates.
        self.spreads = {one.parameter: _first_spread(one, self.coordinates[one.places[0]]) for one in groups}
        self.parameters = list(dict.fromkeys(one.parameter for one in coordinates))
        self.low = np.array([one.at(one.low) for one in coordinates])
        self.high = np.array([one.at(one.high) for one in coordinates])
        self.labels = [one.label for one in coordinates]

    def __len__(self) -> int:
        return len(self.coordinates)

    def values(self, x: Array) -> Array:
        """Return the values of the free parameters in SI units for the coordinates `x`."""
        return np.array([one.value(place) for one, place in zip(self.coordinates, x)])

    def slopes(self, x: Array) -> Array:
        """Return the derivative of each free parameter's value with respect to the parameter's coordinate."""
        return np.array([one.slope(place) for one, place in zip(self.coordinates, x)])

    def prior(self, x: Array, leave_out: str = "") -> tuple[Array, Array]:
        """Return the residuals of the priors and spreads, and the derivatives of these residuals with respect to the
        coordinates. The result contains no residuals for the spread of the parameter `leave_out`.
        """
        known = [(place, one) for place, one in enumerate(self.coordinates) if one.prior is not None]
        residuals, slopes = np.zeros(len(known)), np.zeros((len(known), len(self)))
        for row, (place, one) in enumerate(known):
            mean, error = one.prior or (0.0, 1.0)
            residuals[row] = (one.value(x[place]) - mean) / error
            slopes[row, place] = one.slope(x[place]) / error
        for group in self.groups:
            if group.parameter != leave_out:
                contrasts, by_x = self.contrasts(group, x)
                residuals = np.concatenate([residuals, contrasts / self.spreads[group.parameter]])
                slopes = np.concatenate([slopes, by_x / self.spreads[group.parameter]])
        return residuals, slopes

    def contrasts(self, group: Group, x: Array) -> tuple[Array, Array]:
        """Return independent differences (contrasts) between the values of a parameter in the data sets, and the
        derivatives of the contrasts with respect to the coordinates. The sum of the squared contrasts equals the sum of
        the squared deviations of the values from their mean.
        """
        from scipy.linalg import helmert

        matrix = helmert(len(group.places))
        by_x = np.zeros((len(matrix), len(self)))
        by_x[:, group.places] = matrix * self.slopes(x)[group.places]
        return matrix @ self.values(x)[group.places], by_x


def _first_spread(group: Group, one: Coordinate) -> float:
    """Return the value of a spread at the beginning of the search: the standard deviation of a parameter's values
    between data sets.
    """
    if group.given is not None and not group.is_share:
        return group.given
    share = 0.1 if group.given is None else group.given
    return share * (abs(one.nominal) if one.log else one.high - one.low)


def space(free: Any, names: Names, sets: Sequence[DataSet], keywords: Mapping[str, Any]) -> Space:
    """Return the coordinates for the parameters in the argument `free` of `fit`."""
    parameters = listed("free", free, names)
    if not parameters:
        raise ValueError("`free` is empty\ngive at least one parameter")
    coordinates: list[Coordinate] = []
    groups: list[Group] = []
    taken = {names.parameter(name) for name in keywords if name not in _flapwing.settings()}
    for name, given in parameters.items():
        _check(name, names, sets, taken)
        parameter = _free_of(name, given)
        made = _coordinates(name, parameter, names, sets)
        if _has_spread(parameter):
            groups.append(_group(name, parameter, names, np.arange(len(coordinates), len(coordinates) + len(made))))
        coordinates += made
    return Space(coordinates, groups)


def listed(argument: str, given: Any, names: Names) -> dict[str, Any]:
    """Return a dictionary from the names of the parameters in an argument such as `free` to their bounds or None."""
    if isinstance(given, str) or not hasattr(given, "__iter__"):
        raise TypeError(
            f"`{argument}` is {type(given).__name__}\n"
            'it must be a list of parameters, or a dictionary with their bounds: {"hinge_stiffness": (1e-6, 3e-6)}'
        )
    found: dict[str, Any] = {}
    for name in given:
        if not isinstance(name, str):
            raise TypeError(
                f"`{argument}` has an entry that is {type(name).__name__}\nit must have names of parameters as text"
            )
        parameter = names.parameter(name)
        if parameter in found:
            raise ValueError(f"`{argument}` has `{parameter}` twice\nremove one")
        found[parameter] = given[name] if isinstance(given, Mapping) else None
    return found


def _check(name: str, names: Names, sets: Sequence[DataSet], taken: set[str]) -> None:
    if name in names.options:
        raise ValueError(
            f"`{name}` is a choice, which cannot be fitted\n"
            f"fit once for each of its options: {', '.join(names.options[name])}"
        )
    if name in taken:
        raise ValueError(f"`{name}` is free and set by a keyword\nkeep one of them")
    for one in sets:
        if name in one.points:
            raise ValueError(
                f"`{name}` is free, but {one.name} has it as a parameter of its operating points\nkeep one of them"
            )


def _free_of(name: str, given: Any) -> FreeParameter:
    if given is None:
        return FreeParameter()
    if isinstance(given, FreeParameter):
        return given
    if isinstance(given, (tuple, list)) and len(given) == 2:
        return FreeParameter(given[0], given[1])
    raise TypeError(
        f"free[{name!r}] is {type(given).__name__}\n"
        "it must be a pair of bounds, a flapwing.FreeParameter, or None for the default bounds"
    )


def _has_spread(free: FreeParameter) -> bool:
    # A spread of 0 equals False, but is a mistake.
    return free.spread is not None and free.spread is not False


def _coordinates(name: str, free: FreeParameter, names: Names, sets: Sequence[DataSet]) -> list[Coordinate]:
    nominal = names.nominal.get(name)
    nominal = float(nominal) if isinstance(nominal, (int, float)) and np.isfinite(nominal) else None
    low, high = (_value(names, name, bound) for bound in (free.low, free.high))
    if nominal is None or nominal == 0.0:
        usual = typical_bounds(names.nominal).get(name)
        if usual is None and (low is None or high is None):
            state = "not set" if nominal is None else "zero"
            missing = "bounds" if low is None and high is None else "lower bound" if low is None else "upper bound"
            raise ValueError(
                f"`{name}` is {state} in the design and has no typical size, so it has no default {missing}\n"
                f"give free={{{name!r}: (low, high)}}"
            )
        ends = usual or (0.0, 0.0)
    else:
        ends = min(nominal / _REACH, nominal * _REACH), max(nominal / _REACH, nominal * _REACH)
    low, high = ends[0] if low is None else low, ends[1] if high is None else high
    _check_bounds(name, low, high, free, names.unit(name))
    log = low * high > 0
    if nominal is None or not low <= nominal <= high:
        nominal = float(np.sign(low) * np.sqrt(low * high)) if log else 0.5 * (low + high)
    prior = None if free.prior is None else _prior(names, name, free.prior)
    unit = names.unit(name)
    if prior is not None and not low <= prior[0] <= high:
        message = f"free[{name!r}]: the prior {prior[0]:g} is outside of the bounds {low:g} to {high:g} {unit}"
        raise ValueError(f"{message.rstrip()}\ngive bounds that contain it, with some standard errors on both sides")
    if not (free.per_set or _has_spread(free)) or len(sets) == 1:
        return [Coordinate(name, None, name, unit, log, low, high, nominal, prior)]
    return [
        Coordinate(name, place, f"{name} of {one.name}", unit, log, low, high, nominal, prior)
        for place, one in enumerate(sets)
    ]


def _check_bounds(name: str, low: float, high: float, free: FreeParameter, unit: str) -> None:
    if low < high:
        return
    lower, upper = (
        f"{end:g} {unit}".rstrip() + " (by default)" * (given is None)
        for end, given in ((low, free.low), (high, free.high))
    )
    message = f"free[{name!r}]: the lower bound {lower} is not less than the upper bound {upper}"
    if free.low is None or free.high is None:
        remedy = "give both bounds"
    elif low == high:
        remedy = f"give a range, or set the parameter by a keyword: fit(..., {name}={low:g})"
    else:
        remedy = "exchange them"
    raise ValueError(f"{message}\n{remedy}")


def _value(names: Names, name: str, given: Any) -> float | None:
    if given is None:
        return None
    try:
        return _flapwing.value(names.model, name, given)
    except (TypeError, ValueError) as error:
        raise type(error)(f"free[{name!r}]: {error}") from None


def _group(name: str, free: FreeParameter, names: Names, places: Places) -> Group:
    """Return the `Group` of a parameter that has a separate value for each robot. Raise ValueError if the `spread` in
    `free` is not allowed.
    """
    if len(places) < 2:
        raise ValueError(f"free[{name!r}]: `spread` requires two or more data sets\ngive one data set for each robot")
    if free.prior is not None:
        raise ValueError(f"free[{name!r}] has a `prior` and a `spread`\nkeep one of them")
    if free.spread is True:
        return Group(name, places, None, False)
    size, is_share = _error(names, name, "the spread", free.spread)
    return Group(name, places, size, is_share)


def _error(names: Names, name: str, subject: str, given: Any) -> tuple[float, bool]:
    """Return the number in a given standard error or standard deviation, and a flag. The flag is True if the number is
    a share of the parameter's value, and False if the number is in SI units.
    """
    text = given.strip() if isinstance(given, str) else ""
    if isinstance(given, (int, float)) and not 0 < given < np.inf:
        raise ValueError(f"free[{name!r}]: {subject} is {given!r}\nit must be finite and more than zero")
    try:
        size = float(text[:-1]) / 100 if text.endswith("%") else _value(names, name, given)
    except ValueError as mistake:
        raise ValueError(f"free[{name!r}]: {subject} is {given!r}\n{mistake}") from None
    if size is None or not 0 < size < np.inf:
        raise ValueError(f"free[{name!r}]: {subject} is {given!r}\nit must be finite and more than zero")
    return size, text.endswith("%")


def _prior(names: Names, name: str, given: Any) -> tuple[float, float]:
    if not isinstance(given, (tuple, list)) or len(given) != 2:
        raise TypeError(
            f"free[{name!r}]: `prior` is {type(given).__name__}\n"
            'it must be a value and its standard error: ("1.5 uN*m/rad", "5 %")'
        )
    mean = _value(names, name, given[0])
    assert mean is not None
    error, is_share = _error(names, name, "the error of the prior", given[1])
    return mean, error * (abs(mean) if is_share else 1.0)
