"""Held-out readings: readings that do not enter the fit, but are predicted by the fit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .. import _flapwing
from .._types import Mask
from ._data import DataSet
from ._names import Names

_HOLD_OUT = (
    "it must be a share such as 0.2, names of data sets, "
    'or ranges of parameters such as {"drive_frequency": (110, 120)}, or a list of names and ranges'
)


def held_out_readings(hold_out: Any, sets: Sequence[DataSet], seed: int, count: int, names: Names) -> Mask:
    """Return a mask that is True for held-out readings, which the fit predicts, and False for fitted readings."""
    held = np.zeros(count, np.bool_)
    if hold_out is None:
        return held
    if isinstance(hold_out, (int, float)) and not isinstance(hold_out, bool):
        if not 0 < hold_out < 1:
            raise ValueError(f"`hold_out` is {hold_out!r}\n{_HOLD_OUT}")
        held[np.random.default_rng(seed).permutation(count)[: max(1, round(hold_out * count))]] = True
        return held
    for part in hold_out if isinstance(hold_out, (list, tuple)) else [hold_out]:
        if not isinstance(part, (str, Mapping)):
            raise TypeError(f"`hold_out` is {type(hold_out).__name__}, with {part!r}\n{_HOLD_OUT}")
        mine = _of_set(part, sets) if isinstance(part, str) else _in_ranges(part, sets, names)
        if not mine.any():
            raise ValueError(f"`hold_out`: {part!r} holds none of the {count} readings out\n{_HOLD_OUT}")
        held |= mine
    if not held.any() or held.all():
        raise ValueError(f"`hold_out` holds {'all' if held.all() else 'none'} of the {count} readings out\n{_HOLD_OUT}")
    return held


def _of_set(name: str, sets: Sequence[DataSet]) -> Mask:
    known = [one.name for one in sets]
    if name not in known:
        raise ValueError(f"`hold_out` has {name!r}, but the data sets are {', '.join(known)}\n{_HOLD_OUT}")
    return np.concatenate([np.full(len(one) * len(one.measured), one.name == name) for one in sets])


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
    """Return the smallest and the largest value of a range, in SI units. If an end is None, the range has no limit at
    this end.
    """
    place = f"hold_out[{name!r}]"
    if not isinstance(given, (tuple, list)) or len(given) != 2:
        raise TypeError(
            f"{place} is {type(given).__name__}\n"
            "it must be a range (from, to) in SI units, or text with a unit; None is an open end"
        )
    if name not in names.parameters or name in names.options:
        raise ValueError(f"`hold_out` has `{name}`, which is not a parameter with a range\n{_HOLD_OUT}")
    try:
        low, high = (
            open_end if end is None else _flapwing.value(names.model, name, end)
            for end, open_end in zip(given, (-np.inf, np.inf))
        )
    except (TypeError, ValueError) as error:
        raise type(error)(f"{place}: {error}") from None
    if low > high:
        raise ValueError(f"{place}: {low:g} is more than {high:g}\nexchange them")
    return low, high
