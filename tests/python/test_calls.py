"""One shape of calls: designs, keywords, columns and errors are the same for all functions."""

from pathlib import Path

import flapwing
import numpy as np
import pandas
import polars
import pyarrow
import pytest
from compare import is_same

PRESET = "ozaki2018-large"
TEXT = f'preset = "{PRESET}"\n[params]\ndrive_voltage_pp = "80 V"\n'
DICTIONARY = {"preset": PRESET, "params": {"drive_voltage_pp": "80 V"}}
THREE = {"preset": PRESET, "axes": {"drive_frequency": [100, 105, 110]}}


def designs(folder):
    path = Path(folder) / "grid.toml"
    path.write_text(TEXT, encoding="utf-8")
    return [TEXT, path, str(path), DICTIONARY, flapwing.Grid(DICTIONARY)]


def test_every_form_of_a_design_is_taken_by_every_function(tmp_path):
    row = flapwing.run(PRESET, drive_voltage_pp=80)
    for design in designs(tmp_path):
        assert is_same(flapwing.run(design), row)
        assert flapwing.sweep(design)["lift_mean_mn"].tolist() == [row["lift_mean_mn"]]
        assert (
            flapwing.evaluate(design, {"drive_frequency": [row_frequency()]})["lift_mean_mn"][0] == row["lift_mean_mn"]
        )
        assert len(flapwing.trajectory(design, cycles=1, samples=4)) == 5
        assert len(flapwing.respond(design, start=100, stop=110, step=5, tolerance=5)) == 6
        assert flapwing.resonance(design, start=100, stop=120).driven
        assert len(flapwing.impulse(design, duration="10 ms")) > 100
        assert len(flapwing.chirp(design, start=100, stop=110, rate=100)) > 5


def row_frequency():
    return flapwing.params(PRESET)["drive_frequency"].value


def test_a_preset_is_a_grid_of_one_point():
    assert len(flapwing.Grid(PRESET)) == 1
    assert flapwing.sweep(PRESET)["lift_mean_mn"][0] == flapwing.run(PRESET)["lift_mean_mn"]
    with pytest.raises(ValueError, match="there is no preset `ozaki2018-larg`, did you mean `ozaki2018-large`"):
        flapwing.sweep("ozaki2018-larg")


def test_a_point_of_a_grid_is_run():
    rows = flapwing.sweep(THREE)
    for point in (1, -2):
        assert flapwing.run(THREE, point=point)["lift_mean_mn"] == rows["lift_mean_mn"][1]
    with pytest.raises(ValueError, match="the grid has 3 points, but this call takes one\ngive point=0 to point=2"):
        flapwing.run(THREE)
    with pytest.raises(IndexError, match="there is no point 3: the grid has 3"):
        flapwing.trajectory(THREE, point=3)
    with pytest.raises(TypeError, match="`point` is float\nit must be a whole number"):
        flapwing.run(THREE, point=1.0)


def test_a_run_has_the_measures_of_its_grid():
    grid = {"preset": PRESET, "measure": {"double": "2 * lift_mean_mn", "strong": "lift_mean_mn > 2"}}
    row = flapwing.run(grid)
    assert row["double"] == 2 * row["lift_mean_mn"] and row["strong"] is True
    assert np.isnan(flapwing.run(grid, max_cycles=3)["double"])


def test_a_design_at_its_resonance():
    grid = {
        "preset": "ozaki2018-small",
        "params": {"drive_frequency": "resonance"},
        "resonance": {"from": 180, "to": 210},
    }
    row = flapwing.run(grid)
    assert row["resonance_hz"] == flapwing.sweep(grid)["resonance_hz"][0]
    motion = flapwing.trajectory(grid, cycles=1, samples=4)
    assert motion["time_s"][-1] == pytest.approx(1 / row["resonance_hz"])
    with pytest.raises(ValueError, match="each design at its resonance, which excludes derivatives and initial states"):
        flapwing.run(grid, initial_state={"pitch": "10 deg"})
    wings = [{"name": "left"}, {"name": "right", "mirrored": True}]
    hover = {"preset": "jafferis2016", "vehicle": {"total_mass": "85 mg", "trim": "hover", "wings": wings}}
    with pytest.raises(ValueError, match="rows at hover, and rows with the damping matrix, have no states"):
        flapwing.run(hover, initial_state={"left_pitch": "10 deg"})
    with pytest.raises(ValueError, match="`drive_voltage_pp` is a column, but the search for hover changes it"):
        flapwing.evaluate(hover, {"drive_voltage_pp": [100.0, 140.0]})


def test_formulas_use_the_frequency_of_a_record():
    time = np.linspace(0, 0.01, 51)
    record = (time, np.sin(2 * np.pi * time / 0.01))
    grid = {"preset": PRESET, "derived": {"drive_voltage_pp": "0.8 * drive_frequency"}}
    row = flapwing.run(grid, waveform=record)
    assert row["stroke_pp_deg"] == flapwing.run(PRESET, waveform=record, drive_voltage_pp=80)["stroke_pp_deg"]
    grid["derived"] = {"drive_voltage_pp": "105 - drive_frequency - 10"}
    assert flapwing.run(grid, waveform=record)["status"] == "invalid"
    grid["derived"] = {"drive_frequency": "100"}
    with pytest.raises(ValueError, match="the grid derives drive_frequency, but the record sets it\nremove"):
        flapwing.run(grid, waveform=record)


def test_a_model_runs_with_all_its_parameters():
    values = {
        name: p.value
        for name, p in flapwing.params(PRESET).items()
        if p.is_number or p.options and isinstance(p.value, str)
    }
    assert is_same(flapwing.run("direct-drive", **values), flapwing.run(PRESET))
    with pytest.raises(ValueError, match="model `direct-drive` has no default values: also give drive_voltage_pp, "):
        flapwing.run("direct-drive")


def test_sweeps_take_parameters_and_settings(tmp_path):
    path = tmp_path / "grid.toml"
    path.write_text(f'preset = "{PRESET}"\n[axes]\ndrive_frequency = [100, 105]\n', encoding="utf-8")
    table = flapwing.sweep(path, drive_voltage_pp="80 V", rtol=1e-5, measures=["lift_mean_mn"])
    rows = flapwing.evaluate(PRESET, {"drive_frequency": [100.0, 105.0]}, drive_voltage_pp=80, rtol=1e-5)
    np.testing.assert_array_equal(table["lift_mean_mn"], rows["lift_mean_mn"])
    assert "stroke_pp_deg" not in table and table.meta["keywords"] == {"drive_voltage_pp": "80 V", "rtol": 1e-5}
    assert table.meta["solver"]["rtol"] == 1e-5 and "80 V" in table.meta["grid"]


def test_settings_of_a_grid_stay_with_another_rtol():
    for solver in ({"accuracy": 1e-4}, {"atol": 1e-9}, {"rtol": 1e-4}, {}):
        grid = {"preset": PRESET, "solver": solver, "axes": {"drive_frequency": [100]}}
        table = flapwing.sweep(grid, rtol=1e-5)
        rows = flapwing.evaluate(grid, {"wing_length": [0.03]}, rtol=1e-5)
        assert rows.meta["solver"] == table.meta["solver"]
        assert rows.meta["solver"]["accuracy"] == pytest.approx(solver.get("accuracy", 1e-2))
        assert rows.meta["solver"]["atol"] == pytest.approx(solver.get("atol", 1e-7))


def test_files_of_such_sweeps_can_be_resumed_and_read(tmp_path):
    out = tmp_path / "rows.csv"
    flapwing.sweep(THREE, out=out, drive_voltage_pp="80 V")
    again = flapwing.sweep(THREE, out=out, drive_voltage_pp="80 V")
    assert len(again) == 3 and 'drive_voltage_pp = "80 V"' in flapwing.read(out).meta["grid"]
    with pytest.raises(FileExistsError, match="restart=True"):
        flapwing.sweep(THREE, out=out, drive_voltage_pp="81 V")


def test_keywords_keep_the_text_of_the_grid():
    grid = (
        f'preset = "{PRESET}"  # the large one\n[[zip]]\nwing_length = [0.03, 0.031]\n[axes]\n'
        "drive_frequency = [100, 105]\n[[zip]]\nair_density = [1.1, 1.2]\n"
    )
    table = flapwing.sweep(grid, rtol=1e-5)
    assert table.meta["grid"].replace("\n[solver]\nrtol = 0.00001\n", "") == grid
    assert [list(axis) for axis in table.axes] == [list(axis) for axis in flapwing.Grid(grid).axes]
    for params in ('[params]\ndrive_voltage_pp = "70 V"  # high', 'params.drive_voltage_pp = "70 V"', "params = {}"):
        text = f'{params}\npreset = "{PRESET}"' if params[0] == "p" else f'preset = "{PRESET}"\n{params}'
        row = flapwing.sweep(text, drive_voltage_pp="80 V", wing_length=0.03)
        assert row["lift_mean_mn"][0] == flapwing.run(PRESET, drive_voltage_pp=80, wing_length=0.03)["lift_mean_mn"]


FREQUENCIES = [100.0, 105.0, 110.0]


@pytest.mark.parametrize(
    "values",
    [
        np.array(FREQUENCIES),
        np.array([100, 105, 110]),
        range(100, 111, 5),
        tuple(FREQUENCIES),
        pandas.Series(FREQUENCIES, index=[4, 5, 6]),
        pandas.Index(FREQUENCIES),
        polars.Series(FREQUENCIES),
        pyarrow.array(FREQUENCIES),
        pyarrow.chunked_array([FREQUENCIES]),
        ["100 Hz", 105, np.float64(110)],
    ],
    ids=lambda values: type(values).__name__,
)
def test_axes_and_columns_come_from_every_library(values):
    expected = flapwing.sweep(THREE)["lift_mean_mn"]
    np.testing.assert_array_equal(
        flapwing.sweep({"preset": PRESET, "axes": {"drive_frequency": values}})["lift_mean_mn"], expected
    )
    np.testing.assert_array_equal(flapwing.evaluate(PRESET, {"drive_frequency": values})["lift_mean_mn"], expected)


@pytest.mark.parametrize("make", [pandas.DataFrame, polars.DataFrame, pyarrow.table, dict])
def test_frames_are_columns(make):
    columns = {
        "drive_frequency": [100.0, 105.0],
        "drive_voltage_pp": [80.0, 90.0],
        "lift_sign": ["corrected", "printed"],
    }
    frame = make(columns)
    rows = flapwing.evaluate(PRESET, frame)
    assert rows["lift_sign"].tolist() == columns["lift_sign"]
    zipped = flapwing.sweep({"preset": PRESET, "zip": frame})
    np.testing.assert_array_equal(zipped["lift_mean_mn"], rows["lift_mean_mn"])


def test_a_table_goes_back_in():
    table = flapwing.sweep(
        {"preset": PRESET, "axes": {"drive_voltage_pp": [60, 80], "lift_sign": ["corrected", "printed"]}}
    )
    for rows in (table, table[1:], table[table["lift_sign"] == "printed"], table[["drive_voltage_pp", "lift_sign"]]):
        again = flapwing.evaluate(PRESET, rows)
        assert again["drive_voltage_pp"].tolist() == rows["drive_voltage_pp"].tolist()
    np.testing.assert_array_equal(flapwing.evaluate(PRESET, table)["lift_mean_mn"], table["lift_mean_mn"])
    with pytest.raises(
        ValueError, match="`columns` has no column of a parameter: add one, or give a dictionary\nthere is lift_mean_mn"
    ):
        flapwing.evaluate(PRESET, table[["lift_mean_mn"]])


def test_measures_are_chosen():
    table = flapwing.evaluate(PRESET, {"drive_frequency": [100, 105]}, measures=["lift_mean_mn", "power_mean_mw"])
    assert table.columns[:5] == ["point", "drive_frequency", "status", "lift_mean_mn", "power_mean_mw"]
    assert "stroke_pp_deg" not in table
    whole = flapwing.evaluate(PRESET, {"drive_frequency": [100, 105]})
    np.testing.assert_array_equal(table["lift_mean_mn"], whole["lift_mean_mn"])
    for call in (
        lambda names: flapwing.evaluate(PRESET, {"drive_frequency": [100]}, measures=names),
        lambda names: flapwing.sweep(THREE, measures=names),
    ):
        told = "no measure `lift_mean`, did you mean `lift_mean_mn`\\?\nmeasures: stroke_amplitude_deg, .* and [0-9]+ more measures$"
        with pytest.raises(ValueError, match=told):
            call(["lift_mean"])
        with pytest.raises(ValueError, match="has lift_mean_mn twice\nkeep one"):
            call(["lift_mean_mn", "lift_mean_mn"])
        with pytest.raises(TypeError, match="`measures` is str\nit must be a list of names such as"):
            call("lift_mean_mn")


def test_progress_of_responses_is_told():
    told = []
    grid = {"preset": PRESET, "axes": {"drive_voltage_pp": [60, 80]}}
    flapwing.respond(grid, start=100, stop=110, step=5, progress=lambda done, designs: told.append((done, designs)))
    assert told[-1] == (2, 2)


@pytest.mark.parametrize(
    ("call", "given"),
    [
        (lambda: flapwing.run(3), "int"),
        (lambda: flapwing.run(None), "NoneType"),
        (lambda: flapwing.sweep([1]), "list"),
        (lambda: flapwing.sweep({"preset": PRESET, "axes": {"drive_frequency": object()}}), "object"),
        (lambda: flapwing.sweep(THREE, client="me"), "str"),
        (lambda: flapwing.sweep(THREE, progress="yes"), "str"),
        (lambda: flapwing.sweep(THREE, out="rows.csv", restart=1), "int"),
        (lambda: flapwing.evaluate(PRESET, [1.0]), "list"),
        (lambda: flapwing.evaluate(PRESET, "drive_frequency"), "str"),
        (lambda: flapwing.evaluate(PRESET, {"drive_frequency": {1.0, 2.0}, "wing_length": [0.03]}), "set"),
        (lambda: flapwing.evaluate(PRESET, {"drive_frequency": None, "wing_length": [0.03]}), "NoneType"),
        (lambda: flapwing.evaluate(PRESET, {3: [1.0]}), "int"),
        (lambda: flapwing.evaluate(PRESET, {"drive_frequency": [1.0]}, client=3), "int"),
        (lambda: flapwing.respond(PRESET, 3), "int"),
        (lambda: flapwing.edges(PRESET, 3, edge_start=1, edge_stop=2), "int"),
        (lambda: flapwing.trajectory(PRESET, initial_state=[0.1]), "list"),
        (lambda: flapwing.trajectory(PRESET, from_rest="no"), "str"),
        (lambda: flapwing.run(PRESET, waveform=3), "int"),
        (lambda: flapwing.run(PRESET, waveform=(["a", "b"], [1, 2])), "list"),
        (lambda: flapwing.forces_along(PRESET, 3), "int"),
        (lambda: flapwing.track_wing(None), "NoneType"),
        (lambda: flapwing.read(3), "int"),
        (lambda: flapwing.sweep(THREE)[3], "int"),
        (lambda: flapwing.sweep(THREE)[None], "NoneType"),
        (lambda: flapwing.sweep(THREE)[[0.5]], "numbers with a fraction"),
        (lambda: flapwing.sweep(THREE)["a":"b"], "whole numbers"),
    ],
)
def test_a_wrong_type_is_told_in_two_lines(call, given):
    with pytest.raises(TypeError) as caught:
        call()
    lines = str(caught.value).splitlines()
    assert len(lines) == 2 and given in lines[0], lines
