"""Runs of single peers, and rounds in which all peers run in turn."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from . import points as tables
from .peer import Peer
from .points import Measures, Point
from .work import Work

#: Time after which a run is stopped (s).
TIMEOUT = 600.0

#: Environment variables that keep libraries from starting threads.
ONE_THREAD = {f"{name}_NUM_THREADS": "1" for name in ("MKL", "NUMBA", "OMP", "OPENBLAS", "RAYON")}


class Failed(Exception):
    """The error for a peer that was built, but failed during the run."""


@dataclass
class Timing:
    """The timings and the results of a peer."""

    peer: Peer
    command: list[str]
    points: int
    #: Points per second of CPU time, for each round.
    speeds: list[float] = field(default_factory=list)
    rhs_per_point: float | None = None
    periods_per_point: float | None = None
    found: dict[int, Measures] = field(default_factory=dict)
    failure: str | None = None


@dataclass(frozen=True)
class Task:
    """The task of every peer."""

    work: Work
    points: Sequence[Point]
    rtol: float
    #: The folder of the files that peers read and write.
    folder: Path


def in_turn(timings: Sequence[Timing], task: Task, rounds: int, say: Callable[[str], None]) -> None:
    """Run every peer once in each round, so that a temporary slowdown of the machine affects all peers."""
    for number in range(1, rounds + 1):
        for timing in timings:
            if timing.failure is None:
                say(f"round {number} of {rounds}: {timing.peer.name}")
                try:
                    once(timing, task)
                except Failed as failed:
                    timing.failure = str(failed)


def once(timing: Timing, task: Task) -> None:
    """Run a peer once."""
    name = timing.peer.name
    given, out = task.folder / f"{name}-points.csv", task.folder / f"{name}-results.csv"
    tables.write(task.points[: timing.points], task.work, given)
    out.unlink(missing_ok=True)
    said = output([*timing.command, str(given), repr(task.rtol), str(out)])
    try:
        told = json.loads(said)
        seconds = float(told["cpu_s"])
        timing.rhs_per_point = told["rhs_per_point"]
        timing.periods_per_point = told.get("periods_per_point")
        timing.found = tables.read(out, task.work)
    except (KeyError, ValueError, OSError) as error:
        raise Failed(f"what it wrote cannot be read: {error!r}") from None
    if not seconds > 0.0:
        raise Failed("the clock saw no time go by: more points are needed")
    timing.speeds.append(timing.points / seconds)


def output(command: Sequence[str]) -> str:
    """Return the output of a command."""
    try:
        ended = subprocess.run(
            command, capture_output=True, text=True, check=False, timeout=TIMEOUT, env={**os.environ, **ONE_THREAD}
        )
    except subprocess.TimeoutExpired:
        raise Failed(f"it ran longer than {TIMEOUT:.0f} s: fewer points are needed") from None
    except OSError as error:
        raise Failed(f"it does not start: {error}") from None
    if ended.returncode != 0:
        last = ended.stderr.strip().splitlines()[-1:] or ["nothing"]
        raise Failed(f"it ended with {ended.returncode} and said: {last[0]}")
    return ended.stdout


def reference(command: Sequence[str], task: Task, most: int) -> Path:
    """Return the path of the reference table for the first `most` points. If a reference table of the same points
    exists, the table is used again."""
    given, out = task.folder / "reference-points.csv", task.folder / "reference.csv"
    before = given.read_text(encoding="utf-8") if given.exists() else ""
    tables.write(task.points[:most], task.work, given)
    program = Path(command[0])
    same = before == given.read_text(encoding="utf-8") and out.exists()
    if not same or out.stat().st_mtime < program.stat().st_mtime:
        out.unlink(missing_ok=True)
        part = out.with_suffix(".part")
        output([*command, str(given), str(part)])
        part.replace(out)
    return out
