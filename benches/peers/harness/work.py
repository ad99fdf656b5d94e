"""A work: what the peers are asked to do."""

from __future__ import annotations

from dataclasses import dataclass

from .build import Cpp
from .peer import Peer


@dataclass(frozen=True)
class Axis:
    """A quantity of the drive that differs between points: its column in the file of points, and its range."""

    column: str
    low: float
    high: float


@dataclass(frozen=True)
class Measure:
    """A column of the answers. One that `crosses_zero` has errors relative to its typical size where it is small."""

    column: str
    crosses_zero: bool = False


@dataclass(frozen=True)
class Work:
    """The same points for all peers, measured in the same way."""

    name: str
    what: str
    amplitude: Axis
    frequency: Axis
    measures: tuple[Measure, ...]
    #: The tolerances that it can be asked for, and why no smaller and no larger ones.
    rtol: tuple[float, float]
    rtol_limits: str
    #: Gives the true answers: a program that takes POINTS OUT.
    reference: Cpp
    #: The peer that the others are compared with.
    base: Peer
    #: All peers in turn, with the base.
    peers: tuple[Peer, ...]

    @property
    def columns(self) -> tuple[str, ...]:
        """The columns of the answers."""
        return tuple(measure.column for measure in self.measures)
