"""A program that takes part."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol


class Builder(Protocol):
    """A peer that can be built into a command."""

    def build(self) -> list[str]: ...


@dataclass(frozen=True)
class Peer:
    """A program that takes POINTS RTOL OUT."""

    name: str
    what: str
    builder: Builder
    #: True if it measures by 64 samples a period, as users of libraries do; else it finds peaks and means exactly.
    samples: bool = True
    #: True if it chooses its steps by the error.
    adaptive: bool = True
    #: Points that it gets at most, so that slow peers end.
    most_points: int | None = None
