"""Sweeps of a grid, in one process or in shards."""

from __future__ import annotations

import math
import tempfile
from dataclasses import dataclass
from pathlib import Path

from .process import Failed, Usage, together

PRESET = "jafferis2016"

#: Drive voltages and frequencies around the values of the preset, at which every motion is periodic.
GRID = """\
preset = "{preset}"

[axes]
drive_voltage_pp = {{ from = "120 V", to = "200 V", n = {voltages} }}
drive_frequency = {{ from = "102 Hz", to = "132 Hz", n = {frequencies} }}

[solver]
rtol = {rtol!r}
settle_tol = {rtol!r}

[output]
columns = ["stroke_pp_deg", "pitch_amplitude_deg", "lift_mean_mn", "power_mean_mw"]
"""


@dataclass(frozen=True)
class Way:
    """The kind of a sweep: one process with several threads, or several shards at the same time, each with one
    thread."""

    name: str
    threads: int
    shards: int = 1


@dataclass(frozen=True)
class Swept:
    """The time and the memory of a sweep: of all processes, and of the merge of the shards."""

    usage: Usage
    merge_s: float
    rows: int
    bytes: int


def grid(points: int, rtol: float) -> str:
    """Return a grid file with `points` points. `points` must be a product of two whole numbers above 1."""
    voltages = next(side for side in range(math.isqrt(points), 0, -1) if points % side == 0)
    return GRID.format(preset=PRESET, voltages=voltages, frequencies=points // voltages, rtol=rtol)


def sweep(flap: Path, points: int, rtol: float, way: Way, folder: Path) -> Swept:
    """Run a sweep that writes a CSV file in a new folder, and delete the folder afterwards."""
    with tempfile.TemporaryDirectory(dir=folder) as name:
        path = Path(name) / "grid.toml"
        path.write_text(grid(points, rtol), encoding="utf-8")
        out = Path(name) / "rows.csv"
        command = [str(flap), "sweep", "--grid", str(path), "--threads", str(way.threads)]
        if way.shards == 1:
            usage, merge_s = together([[*command, "--out", str(out)]]), 0.0
        else:
            parts = [Path(name) / f"part{number}.csv" for number in range(1, way.shards + 1)]
            swept = together(
                [
                    [*command, "--shard", f"{number}/{way.shards}", "--out", str(part)]
                    for number, part in enumerate(parts, 1)
                ]
            )
            merged = together([[str(flap), "results", "merge", str(out), *map(str, parts)]])
            merge_s = merged.wall_s
            usage = Usage(
                swept.wall_s + merged.wall_s, swept.cpu_s + merged.cpu_s, max(swept.peak_mib, merged.peak_mib)
            )
        rows = lines(out) - 1
        if rows != points:
            raise Failed(f"{rows} rows of {points} points")
        return Swept(usage, merge_s, rows, out.stat().st_size)


def lines(path: Path) -> int:
    with path.open("rb") as file:
        return sum(part.count(b"\n") for part in iter(lambda: file.read(2**20), b""))
