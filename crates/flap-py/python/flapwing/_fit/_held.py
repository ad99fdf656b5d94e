"""Readings that are held out of a fit, and predicted by it."""

from __future__ import annotations

from typing import Any, Mapping, Sequence

import numpy as np

from .. import _flapwing
from ._columns import Names
from ._estimate import HeldOut
from ._model import Answer
from ._readings import DataSet
from ._search import Target
from ._types import Array, Mask

_ALLOWED = 'it must be a share such as 0.2, names of data sets, or ranges of parameters such as {"drive_frequency": (110, 120)}'


def held_rows(hold_out: Any, sets: Sequence[DataSet], seed: int, count: int, names: Names) -> Mask:
    """A mask of the readings that are held out."""
    if hold_out is None:
        return np.zeros(count, np.bool_)
    if isinstance(hold_out, Mapping):
        held = _in_ranges(hold_out, sets, names)
    elif isinstance(hold_out, (int, float)) and not isinstance(hold_out, bool):
        if not 0 < hold_out < 1:
            raise ValueError(f"`hold_out` is {hold_out!r}\n{_ALLOWED}")
        held = np.zeros(count, np.bool_)
        chosen = np.random.default_rng(seed).permutation(count)[: max(1, round(hold_out * count))]
        held[chosen] = True
    else:
        named = [hold_out] if isinstance(hold_out, str) else hold_out
        if not isinstance(named, (list, tuple)) or not all(isinstance(name, str) for name in named):
            raise TypeError(f"`hold_out` is {type(hold_out).__name__}\n{_ALLOWED}")
        known = [one.name for one in sets]
        for name in named:
            if name not in known:
                raise ValueError(f"`hold_out` names {name!r}, and the data sets are {', '.join(known)}\n{_ALLOWED}")
        held = np.concatenate([np.full(len(one) * len(one.measured), one.name in named) for one in sets])
    if not held.any() or held.all():
        raise ValueError(f"`hold_out` holds {'all' if held.all() else 'none'} of the {count} readings out\n{_ALLOWED}")
    return held


def _in_ranges(ranges: Mapping[Any, Any], sets: Sequence[DataSet], names: Names) -> Mask:
    parts = []
    ends = {name: _range(name, given, names) for name, given in ranges.items()}
    for one in sets:
        inside = np.ones(len(one), np.bool_)
        for name, (low, high) in ends.items():
            values = one.points.get(name)
            if not isinstance(values, np.ndarray):
                raise ValueError(f"`hold_out` names `{name}`, and {one.name} has no such column of numbers\n{_ALLOWED}")
            inside &= (values >= low) & (values <= high)
        parts += [inside] * len(one.measured)
    return np.concatenate(parts)


def _range(name: Any, given: Any, names: Names) -> tuple[float, float]:
    """The ends of a range in SI units."""
    place = f"hold_out[{name!r}]"
    if not isinstance(given, (tuple, list)) or len(given) != 2:
        raise TypeError(
            f"{place} is {type(given).__name__}\nit must be a range (from, to) in SI units, or text with a unit"
        )
    if name not in names.parameters or name in names.options:
        raise ValueError(f"`hold_out` names `{name}`, which is no parameter with a range\n{_ALLOWED}")
    try:
        low, high = (_flapwing.value(names.model, name, end) for end in given)
    except (TypeError, ValueError) as error:
        raise type(error)(f"{place}: {error}") from None
    if low > high:
        raise ValueError(f"{place}: {low:g} is more than {high:g}\nexchange them")
    return low, high


def held_out(
    sets: Sequence[DataSet], target: Target, answer: Answer, held: Mask, covariance: Array, quantile: float
) -> HeldOut:
    """The errors of prediction of readings that were held out."""
    which = np.array([measure for one in sets for measure in one.measured for _ in range(len(one))])
    error = answer.values - target.measured
    known = np.where(np.isfinite(covariance), covariance, 0.0)
    of_model = np.einsum("ij,jk,ik->i", answer.slopes, known, answer.slopes)
    inside = np.abs(error) <= quantile * np.sqrt(target.sigma**2 + np.maximum(0.0, of_model))
    settled = held & np.isfinite(error)
    rms = {
        str(measure): float(np.sqrt(np.mean(error[settled & (which == measure)] ** 2)))
        for measure in dict.fromkeys(which[settled].tolist())
    }
    return HeldOut(int(held.sum()), rms, float(np.mean(inside[held])))
