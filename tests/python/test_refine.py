"""Grids with [refine]: rows in memory, in files and in pictures."""

from __future__ import annotations

from pathlib import Path

import flapwing
import numpy as np
from flapwing import plot

GRID = """
preset = "jafferis2016"

[axes]
drive_voltage_pp = { from = "40 V", to = "240 V", n = 4 }
drive_frequency = { from = "60 Hz", to = "180 Hz", n = 7 }

[refine]
measure = "stroke_pp_deg"
error = "4 %"
max_points = 120

[solver]
max_cycles = 2000
settle_tol = 1e-4

[output]
columns = ["stroke_pp_deg", "power_mean_mw"]
"""


def test_a_sweep_adds_points_where_the_measure_bends(tmp_path: Path) -> None:
    assert len(flapwing.Grid(GRID)) == 28
    seen: list[tuple[int, int]] = []
    rows = flapwing.sweep(GRID, progress=lambda done, points: seen.append((done, points)))
    assert 28 < len(rows) <= 120
    assert seen[-1] == (len(rows), len(rows))
    assert rows["point"].tolist() == list(range(len(rows)))
    # The resonance at 200 V and more is steep, the response at 60 V is not.
    added = rows["drive_voltage_pp"][28:]
    assert (added > 140).sum() > 2 * (added < 140).sum()

    written = flapwing.sweep(GRID, out=tmp_path / "rows.csv", threads=1)
    read = flapwing.read(tmp_path / "rows.csv")
    for name in rows.columns:
        np.testing.assert_array_equal(written[name], rows[name])
        np.testing.assert_array_equal(read[name], rows[name])
    assert read.meta["grid"] == rows.meta["grid"]


def test_a_map_interpolates_between_all_points() -> None:
    rows = flapwing.sweep(GRID)
    ax = plot.heatmap(rows, "stroke_pp_deg")
    dots = {tuple(place) for part in ax.collections for place in np.round(np.asarray(part.get_offsets()), 9).tolist()}
    points = np.column_stack([rows["drive_frequency"], rows["drive_voltage_pp"]])
    assert {tuple(place) for place in np.round(points, 9).tolist()} <= dots
