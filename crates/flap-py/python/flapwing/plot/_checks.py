"""Checks of the arguments of functions that draw pictures."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Collection, Iterable, Mapping
from numbers import Real
from typing import Any, NamedTuple, TypeVar, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Colormap
from matplotlib.legend import Legend

from .._mistakes import refused

_F = TypeVar("_F", bound=Callable[..., object])


class _Kind(NamedTuple):
    """A kind of argument: a function that checks the argument, and a text that describes the allowed values."""

    fits: Callable[[Any], bool]
    #: The allowed values of the argument, for error messages.
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
    lambda value: isinstance(value, str) or _are_names(value),
    'it must be a name, such as "lift_mean_mn", or a list of names',
)
_NUMBER = _Kind(_is_number, "it must be a number")
_WHOLE = _Kind(_is_whole, "it must be a whole number")

#: The kind of each argument of a picture, by its name; None for arguments that are checked elsewhere.
_KINDS: dict[str, _Kind | None] = {
    "table": None,
    "models": None,
    "motion": None,
    "vehicle": None,
    "design": None,
    "percentiles": None,
    **dict.fromkeys(
        ["by", "color", "measure", "parameter", "reduce", "time", "value", "x", "xscale", "y", "yscale"], _NAME
    ),
    "lift": _Kind(
        lambda value: value is None or isinstance(value, str), 'it must be a name, such as "lift_mn", or None'
    ),
    **dict.fromkeys(["inputs", "measures", "portrait", "views"], _NAMES),
    **dict.fromkeys(["groups", "label", "maximize", "minimize", "signals"], _ONE_OR_MORE),
    **dict.fromkeys(["change", "frequency", "radius", "scale", "vmax", "vmin"], _NUMBER),
    **dict.fromkeys(["curve", "frames", "pitch_sign", "top"], _WHOLE),
    "cmap": _Kind(
        lambda value: isinstance(value, (str, Colormap)), 'it must be a colour map of matplotlib, such as "viridis"'
    ),
    "where": _Kind(
        lambda value: isinstance(value, Mapping), 'it must be a mapping of columns, such as {"drive_voltage_pp": 100}'
    ),
    "parameters": _Kind(_are_parameters, "it must be names of parameters, or a mapping of names to changes"),
    "annotate": _Kind(lambda value: isinstance(value, bool), "it must be True or False"),
    "ax": _Kind(lambda value: isinstance(value, Axes), "it must be matplotlib Axes, such as from plt.subplots()"),
    "colorbar": _Kind(
        lambda value: isinstance(value, (bool, Axes)), "it must be True, False or matplotlib Axes to draw it in"
    ),
    "legend": _Kind(
        lambda value: isinstance(value, (bool, str)), 'it must be True, False or a place such as "upper left"'
    ),
}


def checked(function: _F) -> _F:
    """Return a function that checks its arguments and then calls `function`. The check raises TypeError or ValueError
    if an argument is not allowed.

    `_KINDS` must contain the name of each argument of `function`, otherwise `checked` raises KeyError. If the default
    of an argument is None, None is allowed.
    """
    signature = inspect.signature(function)
    named = [each for each in signature.parameters.values() if each.kind is not each.VAR_KEYWORD]
    kinds = {each.name: (_KINDS[each.name], each.default is None) for each in named}

    @functools.wraps(function)
    def checking(*arguments: Any, **keywords: Any) -> object:
        given = {**dict(zip(signature.parameters, arguments)), **keywords}
        for name, (kind, is_optional) in kinds.items():
            if kind is None or name not in given or (is_optional and given[name] is None):
                continue
            if not kind.fits(given[name]):
                raise refused(name, given[name], kind.allowed)
        place = given.get("legend", True)
        if isinstance(place, str) and place not in Legend.codes:
            raise ValueError(f"`legend` is {place!r}\nit must be True, False or one of {', '.join(Legend.codes)}")
        return function(*arguments, **keywords)

    return cast(_F, checking)
