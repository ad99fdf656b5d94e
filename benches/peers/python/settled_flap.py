"""flap: the command `flap sweep` on one thread. The CPU time is the time of the whole process, which reads the points
and writes rows with all columns.

Arguments: FLAP NEWTON POINTS RTOL OUT, where NEWTON is `true` or `false`. The script requires only Python's standard
library.
"""

from __future__ import annotations

import csv
import json
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

#: Largest change of the state over a drive period of a settled motion. All peers have the same limit.
RESIDUAL = 1e-6

GRID = """\
preset = "jafferis2016"

[sample]
method = "file"
path = "points.csv"

[solver]
rtol = {rtol!r}
settle_tol = {residual!r}
newton = {newton}
"""

Row = dict[str, str]


def cpu_seconds() -> float:
    """Return the CPU time of all child processes that have ended (s)."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def sweep(flap: str, newton: str, points: list[Row], rtol: float) -> tuple[list[Row], float]:
    """Return the rows of `points`, and the CPU time of the sweep (s)."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        with (folder / "points.csv").open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["drive_voltage_pp", "drive_frequency"])
            writer.writerows([point["drive_voltage_pp"], point["drive_frequency"]] for point in points)
        grid, rows = folder / "grid.toml", folder / "rows.csv"
        grid.write_text(GRID.format(rtol=rtol, residual=RESIDUAL, newton=newton), encoding="utf-8")
        begin = cpu_seconds()
        command = [flap, "sweep", "--grid", grid, "--out", rows, "--threads", "1"]
        ended = subprocess.run(command, capture_output=True, text=True, check=False)
        seconds = cpu_seconds() - begin
        if ended.returncode != 0:
            sys.exit(ended.stderr)
        with rows.open(newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file)), seconds


def main() -> None:
    flap, newton, given, rtol, out = sys.argv[1:]
    with open(given, newline="", encoding="utf-8") as file:
        points = list(csv.DictReader(file))
    rows, seconds = sweep(flap, newton, points, float(rtol))
    with open(out, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["id", "stroke_pp_deg", "pitch_pp_deg", "lift_mean_mn", "power_mean_mw"])
        for point, row in zip(points, rows, strict=True):
            if row["status"] == "periodic":
                pitch = 2.0 * float(row["pitch_amplitude_deg"])
                writer.writerow([point["id"], row["stroke_pp_deg"], pitch, row["lift_mean_mn"], row["power_mean_mw"]])
    means = {
        name: sum(int(row[column]) for row in rows) / len(rows)
        for name, column in (("rhs_per_point", "rhs_evals"), ("periods_per_point", "cycles"))
    }
    print(json.dumps({"cpu_s": seconds, **means}))


if __name__ == "__main__":
    main()
