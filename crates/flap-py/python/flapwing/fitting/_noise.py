"""The standard errors of readings."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import _flapwing
from .._mistakes import refused
from .._types import Array


@dataclass(frozen=True)
class Noise:
    """The standard errors of the readings of a measure."""

    #: ``"absolute"``, ``"relative"`` to the model's value, or ``"unknown"``: estimated from the residuals.
    kind: str
    #: The standard error in the measure's unit, or as a share of the model's value.
    size: Array | float = 1.0

    def of(self, values: Array, measured: Array, guess: float) -> Array:
        """Return the standard errors of readings. Relative standard errors are multiplied by the model's predictions
        `values`. If the standard errors are unknown, return `guess` for each reading.
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
    """Return a `Noise` object with the standard error that a user gives for a measure. The user gives a number in the
    unit of the measure, or text such as ``"1 deg"`` or ``"3 %"``.
    """
    wanted = (
        f'it must be a number in {unit or "the unit of the measure"}, or text such as "3 %"; '
        f"for errors of single readings, add a column {measure}_sigma"
    )
    if isinstance(given, (bool, np.bool_)):
        raise refused(name, given, wanted)
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
            raise refused(name, given, wanted) from None
    if not (size > 0 and np.isfinite(size)):
        raise ValueError(f"`{name}` is {given!r} for {measure}\nstandard errors must be finite and more than zero")
    return Noise("relative" if relative else "absolute", size)
