"""The types of arguments, checked before a picture is begun: what the annotations of a function say is what it takes."""

from __future__ import annotations

import functools
import inspect
from numbers import Real
from typing import Any, Callable, Collection, Iterable, Mapping, NamedTuple, TypeVar, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Colormap
from matplotlib.legend import Legend

from .._mistakes import refused

_F = TypeVar("_F", bound=Callable[..., object])


class _Kind(NamedTuple):
    """A kind of argument."""

    fits: Callable[[Any], bool]
    #: What is allowed, for messages.
    allowed: str


def _is_number(value: Any) -> bool:
    return isinstance(value, Real) and not isinstance(value, (bool, np.bool_))


def _is_whole(value: Any) -> bool:
    return isinstance(value, (int, np.integer)) and not isinstance(value, bool)


def _are_names(value: Any) -> bool:
    if isinstance(value, (str, bytes, Mapping)) or not isinstance(value, Collection):
        return False
    return all(isinstance(name, str) for name in value)


def _are_parameters(value: Any) -> bool:
    return isinstance(value, str) or (isinstance(value, Iterable) and not isinstance(value, bytes))


_NAME = _Kind(lambda value: isinstance(value, str), 'it must be a name, such as "lift_mean_mn"')
_NAMES = _Kind(_are_names, 'it must be a list of names, such as ["lift_mean_mn"]')
_ONE_OR_MORE = _Kind(
    lambda value: isinstance(value, str) or _are_names(value), 'it must be a name, such as "lift_mean_mn", or a list of names'
)
_NUMBER = _Kind(_is_number, "it must be a number")
_WHOLE = _Kind(_is_whole, "it must be a whole number")

#: The kinds by their annotations, without `None`.
_KINDS = {
    "str": _NAME,
    "Sequence[str]": _NAMES,
    "str | Sequence[str]": _ONE_OR_MORE,
    "float": _NUMBER,
    "int": _WHOLE,
    "str | Colormap": _Kind(
        lambda value: isinstance(value, (str, Colormap)), 'it must be a colour map of matplotlib, such as "viridis"'
    ),
    "Mapping[str, Any]": _Kind(
        lambda value: isinstance(value, Mapping), 'it must be a mapping of columns, such as {"drive_voltage_pp": 100}'
    ),
    "Mapping[str, float | tuple[float, float]] | Iterable[str]": _Kind(
        _are_parameters, "it must be names of parameters, or a mapping of names to changes"
    ),
    "Axes": _Kind(lambda value: isinstance(value, Axes), "it must be axes of matplotlib: one of those of plt.subplots()"),
    "bool | Axes": _Kind(
        lambda value: isinstance(value, (bool, Axes)), "it must be True, False or axes of matplotlib to draw it in"
    ),
    "bool | str": _Kind(
        lambda value: isinstance(value, (bool, str)), 'it must be True, False or a place such as "upper left"'
    ),
}


def checked(function: _F) -> _F:
    """The function, which first raises TypeError or ValueError for arguments that are not of its annotations."""
    signature = inspect.signature(function)
    kinds = {}
    for name, parameter in signature.parameters.items():
        annotation = str(parameter.annotation)
        kind = _KINDS.get(annotation.removesuffix(" | None"))
        if kind is not None and parameter.kind is not parameter.VAR_KEYWORD:
            kinds[name] = (kind, annotation.endswith(" | None"))

    @functools.wraps(function)
    def checking(*arguments: Any, **keywords: Any) -> object:
        given = {**dict(zip(signature.parameters, arguments)), **keywords}
        for name, (kind, is_optional) in kinds.items():
            if name not in given or (is_optional and given[name] is None):
                continue
            if not kind.fits(given[name]):
                raise refused(name, given[name], kind.allowed)
        place = given.get("legend", True)
        if isinstance(place, str) and place not in Legend.codes:
            raise ValueError(f"`legend` is {place!r}\nit must be True, False or one of {', '.join(Legend.codes)}")
        return function(*arguments, **keywords)

    return cast(_F, checking)
