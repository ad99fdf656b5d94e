"""Counts the instructions of small sweeps, and compares the counts with the counts in baseline.toml.

    python3 benches/instructions/count.py target/release/flap
    python3 benches/instructions/count.py target/release/flap --renew

Valgrind's callgrind counts the instructions of the computation of rows. The counts leave out the start of the program
and the writing of files. Callgrind supports AVX2 but not AVX-512, so the AVX2 lanes are counted on every processor with
AVX2. The counts do not depend on the load of the machine. The counts change with the source, the compiler and the
dependencies. The versions of compiler and dependencies are fixed.

A count that differs from the baseline by more than the tolerance is an error, also if the new count is smaller. Store
smaller counts in the baseline, so that later increases are found.
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

BASELINE = Path(__file__).with_name("baseline.toml")

# Counts repeat to the last digit or nearly so; the C library's copying differs a little between its versions.
TOLERANCE = 0.01

PRESETS = [
    "jafferis2016",
    "jafferis2016-improved",
    "ozaki2018-small",
    "ozaki2018-large",
    "arabagi2013-75hz",
    "arabagi2013-30hz",
]

# Settings that keep the emulated sweeps short: what a step costs depends neither on its length nor on their number.
MARCHING = "newton = false\nmax_cycles = 6"
NEWTON = "rtol = 1e-4\nsettle_tol = 1e-2"
PROGRESSIVE = "rtol = 1e-6\nsettle_tol = 1e-6"

# The function in which counting begins and ends, as callgrind writes it.
COUNTED = "*Runner*Rows>::run"

# Large copies with repeated string instructions, which some processors prefer, would be counted otherwise than loops.
LOOPS_COPY = "glibc.cpu.x86_rep_movsb_threshold=0x7fffffff:glibc.cpu.x86_rep_stosb_threshold=0x7fffffff"

HEAD = """\
# Instructions of small sweeps on AVX2 lanes: see count.py beside this file, which `.ci/run` calls.
#
# Renew after a change that is meant to change them, and commit the new numbers with that change:
#
#     just count-instructions --renew
"""


class Count(NamedTuple):
    """The number of instructions of a sweep."""

    instructions: int
    rhs_evals: int


class NotComparableError(Exception):
    """The error for a machine whose counts cannot be compared with the baseline."""


def grids() -> dict[str, str]:
    """Return the grids by name, in the order of the report."""
    texts = {}
    ways = (("marching", MARCHING, 16), ("newton", NEWTON, 8), ("progressive", PROGRESSIVE, 8))
    for way, solver, points in ways:
        for preset in PRESETS:
            texts[f"{preset}-{way}"] = grid(preset, "", solver, points)
    blades = 'flow_direction = "blade"'
    texts["ozaki2018-large-blades"] = grid("ozaki2018-large", blades, MARCHING, 16)
    return texts


def grid(preset: str, params: str, solver: str, points: int) -> str:
    """Return a grid file with voltages at which every preset has a periodic motion."""
    axis = f"drive_voltage_pp = {{ from = 100, to = 150, n = {points} }}"
    return f'preset = "{preset}"\n\n[params]\n{params}\n\n[axes]\n{axis}\n\n[solver]\n{solver}\n'


def count(flap: Path, text: str) -> Count:
    """Count the instructions of the sweep of a grid file on one thread."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "grid.toml").write_text(text)
        command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", f"--toggle-collect={COUNTED}"]
        command += [str(flap), "sweep", "--grid", "grid.toml", "--out", "rows.csv", "--threads", "1"]
        environment = os.environ | {"GLIBC_TUNABLES": LOOPS_COPY}
        ended = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
        collected = re.search(r"Collected : (\d+)", ended.stderr)
        if ended.returncode != 0 or collected is None:
            sys.exit(f"{' '.join(command)}: ended with {ended.returncode}\n{ended.stderr}\nThe grid:\n{text}")
        told = tomllib.loads(Path(folder, "rows.csv.meta.toml").read_text())
    if told["instructions"] != "avx2":
        raise NotComparableError(f"the lanes ran on {told['instructions']}, and the baseline is of avx2")
    instructions = int(collected[1])
    if instructions == 0:
        sys.exit(f"no function of {flap} matches {COUNTED}: has it a new name? Then change COUNTED in {__file__}.")
    return Count(instructions, told["summary"]["rhs_evals"])


def read_baseline() -> dict[str, Count]:
    """Return the stored counts by grid."""
    return {name: Count(**one) for name, one in tomllib.loads(BASELINE.read_text()).items()}


def write_baseline(counts: dict[str, Count]) -> None:
    """Store the counts in baseline.toml."""
    tables = (
        f"\n[{name}]\ninstructions = {one.instructions:_}\nrhs_evals = {one.rhs_evals:_}\n"
        for name, one in counts.items()
    )
    BASELINE.write_text(HEAD + "".join(tables))


def change(new: float, old: float) -> float:
    """Return the relative change from `old` to `new`."""
    return new / old - 1


def compare(counts: dict[str, Count], baseline: dict[str, Count]) -> list[str]:
    """Print one line per grid, and return the error messages."""
    wrong = []
    for name, new in counts.items():
        if name not in baseline:
            wrong.append(f"{name} has no baseline")
            continue
        old = baseline[name]
        total = change(new.instructions, old.instructions)
        per_rhs = change(new.instructions / new.rhs_evals, old.instructions / old.rhs_evals)
        verdict = "" if abs(total) <= TOLERANCE else "  <-- more" if total > 0 else "  <-- fewer"
        print(
            f"{name:32} {old.instructions:12,} -> {new.instructions:12,}  {total:+8.2%}"
            f"  (per right-hand side {per_rhs:+.2%}){verdict}"
        )
        if verdict:
            wrong.append(f"{name} takes {total:+.2%} instructions")
    wrong += [f"{name} is in the baseline and not counted" for name in baseline.keys() - counts.keys()]
    return wrong


def main() -> None:
    """Count the instructions, and compare the counts with the baseline or store the counts."""
    parser = argparse.ArgumentParser(description="Counts the instructions of small sweeps.")
    parser.add_argument("flap", type=Path, help="the command as `cargo build --release` has made it")
    parser.add_argument("--renew", action="store_true", help="store the counts as the new baseline")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="sweeps at a time")
    args = parser.parse_args()

    texts = grids()
    flap = args.flap.resolve()
    try:
        with ThreadPoolExecutor(args.jobs) as pool:
            counts = dict(zip(texts, pool.map(lambda text: count(flap, text), texts.values()), strict=True))
    except NotComparableError as reason:
        print(f"Instructions are not compared: {reason}.")
        return

    wrong = compare(counts, read_baseline() if BASELINE.exists() else {})
    if args.renew:
        write_baseline(counts)
        print(f"{BASELINE.name} is renewed: commit it with the change that explains it.")
    elif wrong:
        sys.exit(
            f"Instruction counts are off by more than {TOLERANCE:.1%}:\n  "
            + "\n  ".join(wrong)
            + "\nMore: find out what has become slower (what the lane functions do, or how often: see the change per "
            "right-hand side).\nFewer, or more for a good reason: `just count-instructions --renew`, and commit "
            "baseline.toml with the change."
        )


if __name__ == "__main__":
    main()
