"""The command line: options, builds, rounds and report."""

from __future__ import annotations

import argparse
import json
import os
import platform
import re
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from re import Pattern
from typing import Any

from . import measure, points, report
from .build import WORK, Unavailable
from .compare import deviation
from .measure import Failed, Task, Timing
from .peer import Peer
from .roster import WORKS
from .work import Work

#: Largest number of points for which the reference is computed. A point of the reference takes about 0.1 s.
MOST_REFERENCES = 256


def main(arguments: Sequence[str] | None = None) -> None:
    options = parse(arguments)
    work = WORKS[options.work]
    task = Task(work, points.grid(options.points, work), options.rtol, WORK / work.name)
    task.folder.mkdir(parents=True, exist_ok=True)

    skipped: list[dict[str, str]] = []
    timings = []
    for peer in chosen(work, options.only):
        say(f"building {peer.name}")
        try:
            command = peer.builder.build()
        except Unavailable as unavailable:
            skipped.append({"name": peer.name, "why": unavailable.why, "remedy": unavailable.remedy})
        else:
            timings.append(Timing(peer, command, min(options.points, peer.most_points or options.points)))
    truth = known(task, skipped)

    if options.core is not None:
        os.sched_setaffinity(0, {options.core})
    begin = load()
    measure.in_turn(timings, task, options.rounds, say)
    for timing in timings:
        if timing.failure is not None:
            skipped.append({"name": timing.peer.name, "why": timing.failure, "remedy": "run it by itself with --only"})

    setting = {
        "work": work.name,
        "what": work.what,
        "date": time.strftime("%Y-%m-%d"),
        "processor": processor(),
        "core": options.core,
        "load": [begin, load()],
        "points": options.points,
        "rtol": options.rtol,
        "rounds": options.rounds,
        "base": work.base.name,
    }
    rows = compared([timing for timing in timings if timing.failure is None], truth, work)
    show(rows, skipped, setting, options.json)


def known(task: Task, skipped: list[dict[str, str]]) -> dict[bool, dict[int, points.Measures]]:
    """Return the reference measures for peers that sample the motion, and for peers that find exact peaks and means."""
    say("computing the reference")
    try:
        path = measure.reference(task.work.reference.build(), task, MOST_REFERENCES)
    except Unavailable as unavailable:
        skipped.append({"name": "reference", "why": unavailable.why, "remedy": unavailable.remedy})
    except Failed as failed:
        skipped.append({"name": "reference", "why": str(failed), "remedy": "report it"})
    else:
        return {True: points.read(path, task.work, "sampled_"), False: points.read(path, task.work)}
    return {True: {}, False: {}}


def compared(timings: Sequence[Timing], truth: dict[bool, dict[int, points.Measures]], work: Work) -> list[report.Row]:
    """Return the lines of the report."""
    base = next((timing.speeds for timing in timings if timing.peer is work.base), [])
    return [
        report.Row(
            timing,
            [speed / of for speed, of in zip(timing.speeds, base)],
            deviation(timing.found, truth[False], timing.points, work),
            deviation(timing.found, truth[timing.peer.samples], timing.points, work),
        )
        for timing in timings
    ]


def show(rows: Sequence[report.Row], skipped: Sequence[dict[str, str]], setting: dict[str, Any], path: Path) -> None:
    """Print the table, and write the JSON file."""
    base = next((row.integration for row in rows if row.timing.peer.name == setting["base"]), None)
    load = "{:.1f} – {:.1f}".format(*setting["load"])
    print(
        f"{setting['work']}: {setting['what']}\n"
        f"{setting['points']} points at rtol {setting['rtol']:g}, {setting['rounds']} rounds in turn"
        f" on core {setting['core']} of {setting['processor']}; load {load}\n"
    )
    print(report.table(rows, base, setting["points"]) if rows else "Nothing could be run.")
    print(f"\nThe base is {setting['base']}; ratios are taken round by round.")
    for row in rows:
        print(f"{row.timing.peer.name}: {row.timing.peer.what}")
    for peer in skipped:
        print(f"Skipped: {peer['name']}: {peer['why']}. What helps: {peer['remedy']}.")
    records = [report.record(row, base, setting["points"]) for row in rows]
    text = json.dumps({**setting, "peers": records, "skipped": skipped}, indent=1, ensure_ascii=False)
    path.write_text(text + "\n", encoding="utf-8")
    say(f"wrote {path}")


def say(text: str) -> None:
    print(text, file=sys.stderr)


def chosen(work: Work, only: Pattern[str]) -> list[Peer]:
    """Return the peers that `only` selects, and always the base."""
    return [peer for peer in work.peers if peer is work.base or only.search(peer.name)]


def parse(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="just peers", description="Runs flap and other solvers on the same points, in turn, on one core."
    )
    parser.add_argument(
        "--work", choices=WORKS, default=next(iter(WORKS)), help=described(WORKS) + f" (default: {next(iter(WORKS))})"
    )
    parser.add_argument("--points", type=int, default=256, metavar="N", help="points of the sweep (default: 256)")
    parser.add_argument("--rtol", type=float, default=1e-6, help="relative tolerance (default: 1e-6)")
    parser.add_argument("--rounds", type=int, default=5, metavar="N", help="runs of each peer (default: 5)")
    parser.add_argument(
        "--only", type=pattern, default=re.compile(""), metavar="REGEX", help="peers whose names match, beside the base"
    )
    parser.add_argument("--core", type=int, default=None, metavar="N", help="where to run (default: the last core)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="default: result.json in target/peers/WORK")
    options = parser.parse_args(arguments)
    for name in ("points", "rounds"):
        if getattr(options, name) < 1:
            parser.error(f"--{name} is {getattr(options, name)}, but must be 1 or more")
    work = WORKS[options.work]
    least, most = work.rtol
    if not least <= options.rtol <= most:
        parser.error(f"--rtol is {options.rtol:g}, but must be {work.rtol_limits}")
    if not any(options.only.search(peer.name) for peer in work.peers):
        names = ", ".join(peer.name for peer in work.peers)
        parser.error(f"--only {options.only.pattern} is none of the peers: {names}")
    if options.json is None:
        options.json = WORK / work.name / "result.json"
    options.json = options.json.resolve()
    if options.json.parent != WORK / work.name and not options.json.parent.is_dir():
        parser.error(f"--json {options.json}: there is no folder {options.json.parent}")
    cores = usable_cores()
    if options.core is None:
        options.core = max(cores, default=None)
    elif options.core not in cores:
        allowed = ", ".join(map(str, sorted(cores))) or "none, because this system does not pin processes"
        parser.error(f"--core {options.core} cannot be used; allowed: {allowed}")
    return options


def described(works: Mapping[str, Work]) -> str:
    """Return the descriptions of all benchmarks as text."""
    return "; ".join(f"{work.name}: {work.what}" for work in works.values())


def pattern(text: str) -> Pattern[str]:
    try:
        return re.compile(text)
    except re.error as error:
        raise argparse.ArgumentTypeError(f"{text} is no regular expression: {error}") from None


def usable_cores() -> set[int]:
    """Return the cores to which the process can be pinned. Return an empty set if the system cannot pin processes."""
    return os.sched_getaffinity(0) if hasattr(os, "sched_getaffinity") else set()


def load() -> float:
    return os.getloadavg()[0]


def processor() -> str:
    """Return the name of the processor."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()
