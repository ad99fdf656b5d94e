"""Benchmarks. A benchmark is a task for all peers."""

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
    """A column of the results. If `crosses_zero` is true, errors of small values are relative to the typical size of
    the measure."""

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
    #: The smallest and the largest allowed tolerance, and the reasons for these limits.
    rtol: tuple[float, float]
    rtol_limits: str
    #: The program that computes the true results, with the arguments POINTS OUT.
    reference: Cpp
    #: The peer with which all peers are compared.
    base: Peer
    #: All peers in the order of the runs, including the base.
    peers: tuple[Peer, ...]

    @property
    def columns(self) -> tuple[str, ...]:
        """The columns of the results."""
        return tuple(measure.column for measure in self.measures)
