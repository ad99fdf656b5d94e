"""The command line: options, sweeps and results."""

from __future__ import annotations

import argparse
import json
import os
import platform
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from statistics import median
from typing import Any

from . import picture
from .picture import tolerance
from .process import Failed
from .sweep import PRESET, Swept, Way, sweep

REPOSITORY = Path(__file__).resolve().parents[3]
TARGET = Path(os.environ.get("CARGO_TARGET_DIR") or REPOSITORY / "target").resolve()

FEWEST = 1_000
#: Number of points above which a sweep runs only once.
REPEATED = 100_000

TIGHT, LOOSE = 1e-6, 1e-3


def main(arguments: Sequence[str] | None = None) -> None:
    options = parse(arguments)
    if options.draw is None:
        options.json.parent.mkdir(parents=True, exist_ok=True)
        measured = measure(options)
        options.json.write_text(json.dumps(measured, indent=1) + "\n", encoding="utf-8")
        say(f"wrote {options.json}")
    else:
        measured = json.loads(options.draw.read_text(encoding="utf-8"))
    print(table(measured["runs"]))
    if options.picture is not None:
        options.picture.write_text(picture.draw(measured["runs"]), encoding="utf-8")
        say(f"wrote {options.picture}")


def measure(options: argparse.Namespace) -> dict[str, Any]:
    """Run all sweeps, with the smallest sweep first, and return the results."""
    flap = options.flap or build()
    ways = [Way(f"{count} thread{'s' * (count > 1)}", count) for count in options.threads]
    if options.shards > 1:
        ways.append(Way(f"{options.shards} shards", 1, options.shards))
    tasks = [
        (points, rtol) for rtol, most in ((TIGHT, options.most), (LOOSE, options.most_loose)) for points in sizes(most)
    ]
    runs = []
    for points, rtol in sorted(tasks):
        rounds = options.rounds if points <= REPEATED else 1
        done: list[list[Swept]] = [[] for _ in ways]
        # In turn, so that whatever slows the machine down slows all ways.
        for number in range(rounds):
            for way, swept in zip(ways, done):
                say(f"{points:,} points at rtol {tolerance(rtol)}, {way.name}: round {number + 1} of {rounds}")
                try:
                    swept.append(sweep(flap, points, rtol, way, options.json.parent))
                except Failed as failed:
                    sys.exit(f"{points} points, {way.name}: {failed}")
        runs += [record(points, rtol, way, swept) for way, swept in zip(ways, done)]
    return {
        "date": time.strftime("%Y-%m-%d"),
        "processor": processor(),
        "hardware_threads": os.cpu_count(),
        "load": os.getloadavg()[0],
        "preset": PRESET,
        "runs": runs,
    }


def sizes(most: int) -> list[int]:
    """Return the numbers of points of the sweeps, which are powers of ten."""
    found = [FEWEST]
    while found[-1] * 10 <= most:
        found.append(found[-1] * 10)
    return [size for size in found if size <= most]


def record(points: int, rtol: float, way: Way, swept: Sequence[Swept]) -> dict[str, Any]:
    """Return the rounds of a sweep as entries for a JSON file."""
    return {
        "points": points,
        "rtol": rtol,
        "way": way.name,
        "threads": way.threads,
        "shards": way.shards,
        "wall_s": [each.usage.wall_s for each in swept],
        "cpu_s": [each.usage.cpu_s for each in swept],
        "merge_s": [each.merge_s for each in swept],
        "peak_mib": [each.usage.peak_mib for each in swept],
        "rows": swept[0].rows,
        "bytes": swept[0].bytes,
    }


def table(runs: Sequence[dict[str, Any]]) -> str:
    """Return a table of the medians."""
    lines = [["points", "rtol", "way", "points/s", "CPU time per point (us)", "peak memory (MiB)", "file (MB)"]]
    for run in runs:
        lines.append(
            [
                f"{run['points']:,}",
                tolerance(run["rtol"]),
                run["way"],
                f"{run['points'] / median(run['wall_s']):,.0f}",
                f"{1e6 * median(run['cpu_s']) / run['points']:.1f}",
                f"{median(run['peak_mib']):.1f}",
                f"{run['bytes'] / 1e6:,.1f}",
            ]
        )
    widths = [max(len(line[column]) for line in lines) for column in range(len(lines[0]))]
    return "\n".join("  ".join(map(str.rjust, line, widths)) for line in lines)


def build() -> Path:
    """Build the command `flap`, and return its path."""
    say("building flap")
    ended = subprocess.run(["cargo", "build", "--release", "--locked", "-p", "flap-cli"], check=False, cwd=REPOSITORY)
    if ended.returncode != 0:
        sys.exit("error: flap could not be built")
    return TARGET / "release" / "flap"


def parse(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="just growth", description="Measures how cost and memory of `flap sweep` grow with the number of points."
    )

    def number(name: str, default: int, text: str) -> None:
        parser.add_argument(name, type=count, metavar="N", default=default, help=text)

    number("--most", 10**6, f"points at rtol {tolerance(TIGHT)} at most (default: 1e6)")
    number("--most-loose", 10**7, f"points at rtol {tolerance(LOOSE)} at most (default: 1e7)")
    number("--shards", 2, "shards at the same time (default: 2; 1: none)")
    number("--rounds", 3, f"runs of each sweep of up to {REPEATED:,} points (default: 3)")
    parser.add_argument("--threads", type=counts, default=[1, 2], metavar="N,N", help="threads (default: 1,2)")
    parser.add_argument("--flap", type=Path, metavar="FILE", help="the command (default: built by cargo)")
    default = TARGET / "growth" / "result.json"
    parser.add_argument(
        "--json",
        type=Path,
        default=default,
        metavar="FILE",
        help="results (default: target/growth/result.json); rows are written beside it for a while",
    )
    parser.add_argument("--picture", type=Path, metavar="FILE", help="an SVG of the results")
    parser.add_argument("--draw", type=Path, metavar="FILE", help="take these results, measure nothing")
    options = parser.parse_args(arguments)
    if max(options.most, options.most_loose) < FEWEST:
        parser.error(f"--most and --most-loose are below {FEWEST}: there is nothing to measure")
    for given in (options.flap, options.draw):
        if given is not None and not given.is_file():
            parser.error(f"there is no file {given}")
    return options


def count(text: str) -> int:
    """Return a number of 1 or more from text such as ``1000`` or ``1e6``."""
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if value < 1.0 or value != int(value):
        raise argparse.ArgumentTypeError(f"{text} is no whole number of 1 or more")
    return int(value)


def counts(text: str) -> list[int]:
    return [count(part) for part in text.split(",")]


def processor() -> str:
    """Return the name of the processor."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


def say(text: str) -> None:
    print(text, file=sys.stderr)
