"""Parts of the result of a fit."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ._profile import Profile


@dataclass(frozen=True)
class Estimate:
    """The estimate of a parameter."""

    parameter: str
    unit: str
    #: In SI units.
    value: float
    #: Standard error, by the derivatives at the estimate.
    error: float
    #: Ends of the 95 % interval, by the profile likelihood if it was computed.
    low: float
    high: float
    #: True where the interval goes on to the end of the range: the data do not bound the parameter there.
    open_below: bool
    open_above: bool
    profile: Profile | None
    #: True if the estimate is at an end of its range.
    at_bound: bool

    @property
    def is_known(self) -> bool:
        """True if the data bound the parameter on both sides."""
        return not (self.open_below or self.open_above) and bool(np.isfinite(self.error))


@dataclass(frozen=True)
class Unsettled:
    """A reading that does not count, because the model's motion does not settle there."""

    set: str
    measure: str
    row: int
    status: str


@dataclass(frozen=True)
class HeldOut:
    """Readings that were held out, and predicted."""

    count: int
    #: Root of the mean square of the errors of prediction by measure, in its unit.
    rms: dict[str, float]
    #: The share of the readings in their 95 % bands, noise included.
    covered: float


@dataclass(frozen=True)
class Effort:
    """The work of a fit."""

    starts: int
    #: Starts whose search ended at the best fit.
    agreed: int
    points: int
    rhs_evals: int
    seconds: float
