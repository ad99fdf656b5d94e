"""The best design within the axes of a grid: the same answer as the command's, and mistakes."""

import csv
import dataclasses

import flapwing
import numpy as np
import pytest

GRID = {
    "preset": "ozaki2018-large",
    "axes": {
        "drive_shape": ["sine", "square"],
        "drive_voltage_pp": {"from": "60 V", "to": "100 V", "n": 3},
        "drive_frequency": {"from": "95 Hz", "to": "120 Hz", "n": 4},
    },
    "measure": {"is_strong": "lift_mean_mn > 2"},
}
WHERE = ["stroke_pp_deg < 60 deg", "power_mean_mw < 30 mW"]


def test_the_answer_is_that_of_the_command(flap, tmp_path):
    best = flapwing.optimise(GRID, maximise="lift_mean_mn", where=WHERE, threads=1)
    path = tmp_path / "grid.toml"
    path.write_text(flapwing.Grid(GRID).text, encoding="utf-8")
    conditions = [word for condition in WHERE for word in ("--where", condition)]
    ended = flap("optimise", str(path), "--maximise", "lift_mean_mn", *conditions, "--format", "csv")
    rows = list(csv.DictReader(ended.stdout.splitlines()))
    cells = {(row["section"], row["name"]): row["value"] for row in rows}
    assert best.status == cells["answer", "status"] == "optimal"
    assert best.value == float(cells["answer", "lift_mean_mn"]) == best.row["lift_mean_mn"]
    assert best.goal == "lift_mean_mn"
    for name, value in best.values.items():
        cell = cells["parameter", name]
        assert cell == value if isinstance(value, str) else float(cell) == value, name
    for name, value in best.row.measures.items():
        cell = cells["measure", name]
        assert cell == "" if np.isnan(value) else float(cell) == float(value), name
    active = [row for row in rows if row["section"].startswith("active")]
    assert [bound.percent for bound in best.active] == [float(row["percent_per_percent"]) for row in active]
    assert [bound.multiplier for bound in best.active] == [float(row["per_unit"]) for row in active]
    assert best.rows == int(cells["answer", "rows"]) and best.points == 24
    assert sum(optimum.starts for optimum in best.optima) == best.starts


def test_a_device_has_the_same_row():
    best = flapwing.optimise(GRID, minimise="power_mean_mw", where="lift_mean_mn > 1.5 mN")
    row = flapwing.run(best.device)
    np.testing.assert_equal(row.measures, {name: best.row[name] for name in row.measures})
    assert best.row["lift_mean_mn"] == pytest.approx(1.5, rel=1e-4) and best.row["lift_mean_mn"] > 1.5
    assert best.conditions[0].excess == 0 and best.conditions[0].larger == best.row["lift_mean_mn"]
    assert str(best.active[0]).endswith("% more power_mean_mw")
    with pytest.raises(dataclasses.FrozenInstanceError):
        best.value = 0.0


def test_no_design_may_satisfy_the_conditions():
    best = flapwing.optimise(GRID, maximise="lift_mean_mn", where="power_mean_mw < 0.1 mW", starts=2)
    assert best.status == "infeasible" and best.conditions[0].excess > 0 and best.active == []


def test_parameters_and_settings_are_keywords():
    best = flapwing.optimise(
        GRID, maximise="lift_mean_mn", starts=1, sample=6, rtol=1e-7, hinge_stiffness="90 uN*m/rad"
    )
    assert best.points_computed == 6 and best.starts == 1
    assert flapwing.run(best.device, rtol=1e-7)["lift_mean_mn"] == best.value


def test_mistakes_are_told():
    with pytest.raises(ValueError, match="give one of maximise and minimise"):
        flapwing.optimise(GRID)
    with pytest.raises(ValueError, match="give one of maximise and minimise"):
        flapwing.optimise(GRID, maximise="lift_mean_mn", minimise="power_mean_mw")
    with pytest.raises(ValueError, match='maximise "lift": unknown name `lift`\ndid you mean `lift_mean_mn`'):
        flapwing.optimise(GRID, maximise="lift")
    with pytest.raises(ValueError, match='where "stroke_pp_deg < 60 V": `V` is a voltage'):
        flapwing.optimise(GRID, maximise="lift_mean_mn", where="stroke_pp_deg < 60 V")
    with pytest.raises(ValueError, match="no point of the grid has a periodic motion with finite values of the goal"):
        flapwing.optimise(GRID, maximise="1 / (lift_mean_mn - lift_mean_mn)")
    with pytest.raises(ValueError, match="the grid varies no parameter"):
        flapwing.optimise("ozaki2018-large", maximise="lift_mean_mn")
    with pytest.raises(TypeError, match="`maximise` is int"):
        flapwing.optimise(GRID, maximise=1)
    with pytest.raises(TypeError, match="`where` is list"):
        flapwing.optimise(GRID, maximise="lift_mean_mn", where=[1])


def test_progress_is_counted():
    seen = []
    flapwing.optimise(GRID, maximise="lift_mean_mn", progress=lambda done, points: seen.append((done, points)))
    assert seen[-1] == (24 + 8, 24 + 8) and all(done <= points == 24 + 8 for done, points in seen)


def test_the_text_of_an_optimum_is_short():
    best = flapwing.optimise(GRID, maximise="lift_mean_mn", starts=1)
    assert repr(best).startswith(f"<flapwing.Optimum, {best.status}: lift_mean_mn = {best.value:.6g} at ")
    assert f"drive_frequency={best.values['drive_frequency']:.6g}" in repr(best) and len(repr(best)) < 300
