"""A program that is compared with other programs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol


class Builder(Protocol):
    """An object that builds the command of a peer."""

    def build(self) -> list[str]: ...


@dataclass(frozen=True)
class Peer:
    """A program with the arguments POINTS RTOL OUT."""

    name: str
    what: str
    builder: Builder
    #: True if the peer measures from 64 samples per period, and False if the peer computes exact peaks and means.
    samples: bool = True
    #: True if the peer controls the step by the error.
    adaptive: bool = True
    #: Largest number of points for the peer, so that slow peers end in time.
    most_points: int | None = None
