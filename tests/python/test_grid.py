"""Grids: what they take, what is in them, and what is wrong with them."""

import copy
import pickle
from pathlib import Path

import flapwing
import numpy as np
import pytest
from grids import GRID

DICT = {
    "preset": "ozaki2018-large",
    "params": {"hinge_stiffness": "90 uN*m/rad"},
    "axes": {
        "drive_voltage_pp": [60, 80.0],
        "drive_frequency": {"from": 100, "to": 120, "step": "5 Hz"},
    },
}


def test_a_path_a_text_a_dictionary_and_a_grid_are_the_same(grid):
    of_path = flapwing.Grid(grid)
    assert of_path.text == GRID
    for source in [str(grid), GRID, of_path, pickle.loads(pickle.dumps(of_path)), copy.deepcopy(of_path)]:
        assert flapwing.Grid(source).text == GRID
        assert list(flapwing.Grid(source)) == list(of_path)


def test_mistakes_can_be_pickled():
    with pytest.raises(flapwing.GridError) as caught:
        flapwing.Grid("x = 3\n")
    back = pickle.loads(pickle.dumps(caught.value))
    assert isinstance(back, flapwing.GridError) and str(back) == str(caught.value)
    assert [repr(one) for one in back.diagnostics] == [repr(one) for one in caught.value.diagnostics]


def test_a_dictionary_keeps_its_order():
    axes = {"hinge_stiffness": [9e-5, 1e-4], "drive_frequency": (100.0, 110.0), "air_density": np.array([1.2, 1.3])}
    grid = flapwing.Grid({"preset": "ozaki2018-large", "axes": {k: list(v) for k, v in axes.items()}})
    assert [list(axis) for axis in grid.axes] == [[name] for name in axes]
    # The last axis varies fastest.
    assert [grid[i]["air_density"] for i in range(3)] == [1.2, 1.3, 1.2]
    assert [grid[i]["drive_frequency"] for i in range(4)] == [100.0, 100.0, 110.0, 110.0]


def test_every_part_of_a_grid_file_can_be_a_dictionary():
    grid = flapwing.Grid(
        {
            "preset": "jafferis2016",
            "params": {"drive_voltage_pp": "200 V"},
            "axes": {"drive_frequency": {"from": 60, "to": 200, "n": 3}},
            "zip": [{"wing_area": ["50 mm^2", 55e-6], "wing_length": ["16 mm", "17 mm"]}],
            "sample": {
                "method": "sobol",
                "n": 4,
                "seed": 1,
                "parameters": {"transmission_ratio": {"from": 3000, "to": 3500}},
            },
            "derived": {"hinge_stiffness": "preset.hinge_stiffness * 2"},
            "where": {"not all": "drive_frequency > 100"},
            "measure": {"double": "2 * lift_mean_mn"},
            "solver": {"newton": False, "max_cycles": 100},
            "output": {"columns": ["lift_mean_mn", "double"]},
        }
    )
    assert len(grid) == 3 * 2 * 4
    assert [list(axis) for axis in grid.axes] == [
        ["drive_frequency"],
        ["wing_area", "wing_length"],
        ["sample", "transmission_ratio"],
    ]
    found = grid.exclusions()
    assert (found.looked_at, found.excluded, found.unsatisfied) == (24, 8, {"not all": 8})


def test_a_grid_is_a_sequence():
    grid = flapwing.Grid(DICT)
    assert len(grid) == 10
    points = list(grid)
    assert [point["drive_frequency"] for point in points] == [100.0, 105.0, 110.0, 115.0, 120.0] * 2
    assert grid[-1] == points[-1] == grid[9]
    assert grid[2:9:3] == points[2:9:3]
    assert grid[::-1] == points[::-1]
    assert grid[3]["hinge_stiffness"] == 9e-5
    assert grid[0]["lift_sign"] == "corrected"
    for index in [10, -11]:
        with pytest.raises(IndexError, match="the grid has 10"):
            grid[index]
    with pytest.raises(TypeError):
        grid["drive_frequency"]


def test_a_grid_says_what_it_is():
    grid = flapwing.Grid(DICT)
    assert (grid.model, grid.preset) == ("direct-drive", "ozaki2018-large")
    assert repr(grid) == "<flapwing.Grid of 10 points of ozaki2018-large: drive_voltage_pp (2) x drive_frequency (5)>"
    assert grid.axes[0]["drive_voltage_pp"].tolist() == [60.0, 80.0]
    assert grid.varied == ["drive_voltage_pp", "drive_frequency"]
    assert flapwing.Grid(GRID).varied[-1] == "hinge_stiffness"


def test_a_huge_grid_costs_nothing():
    step = {"from": 1.0, "to": 2.0, "n": 1_000_000}
    grid = flapwing.Grid({"preset": "ozaki2018-large", "axes": {"air_density": step, "drag_coefficient_max": step}})
    assert len(grid) == 10**12
    assert grid[10**12 - 1]["drag_coefficient_max"] == 2.0


def test_an_axis_that_is_too_long_for_an_array_is_refused():
    grid = flapwing.Grid({"preset": "ozaki2018-large", "axes": {"air_density": {"from": 1.0, "to": 2.0, "n": 10**14}}})
    for call in (lambda: grid.axes, lambda: flapwing.sweep(grid)):
        with pytest.raises(ValueError, match="`air_density` has 100000000000000 values: .* at most 100000000\nchoose"):
            call()


def test_flags_of_numpy_are_flags():
    grid = {"preset": "ozaki2018-large", "solver": {"newton": np.bool_(False)}}
    assert "newton = false" in flapwing.Grid(grid).text
    with pytest.raises(flapwing.GridError, match="`drive_frequency` must be .*, not a boolean"):
        flapwing.Grid({"preset": "ozaki2018-large", "params": {"drive_frequency": np.bool_(True)}})


def test_all_mistakes_are_told_with_their_places():
    text = 'preset = "ozaki2018-large"\n[axes]\ndrive_frequenc = ["100 Hz"]\nwing_length = ["3 kg", "1 mm"]\n'
    with pytest.raises(flapwing.GridError) as caught:
        flapwing.Grid(text)
    assert isinstance(caught.value, ValueError)
    first, second = caught.value.diagnostics
    assert (first.file, first.line, first.column) == ("<grid>", 3, 1)
    assert text.encode()[first.start : first.end] == b"drive_frequenc"
    assert "did you mean `drive_frequency`?" in first.help
    assert second.line == 4
    message = str(caught.value)
    assert "3 | drive_frequenc" in message and "did you mean `drive_frequency`?" in message
    assert "\x1b" not in message


def test_mistakes_of_a_dictionary_are_shown_as_a_grid_file():
    with pytest.raises(flapwing.GridError, match=r'1 \| preset = "ozaki2018-larg"'):
        flapwing.Grid({"preset": "ozaki2018-larg", "axes": {"drive_frequency": [100]}})


def test_the_message_is_that_of_the_command(flap, tmp_path):
    path = tmp_path / "bad.toml"
    path.write_text('preset = "ozaki2018-large"\n[axes]\nlift_sign = ["prined"]\nx = 3\n', encoding="utf-8")
    with pytest.raises(flapwing.GridError) as caught:
        flapwing.Grid(path)
    assert flap("check", path, code=2).stderr.strip() == str(caught.value).strip()


def test_what_is_no_grid_is_refused(tmp_path):
    with pytest.raises(FileNotFoundError, match="no such file"):
        flapwing.Grid(tmp_path / "missing.toml")
    with pytest.raises(IsADirectoryError):
        flapwing.Grid(tmp_path)
    with pytest.raises(TypeError, match="a design cannot be int\nit must be the name of a preset, a path"):
        flapwing.Grid(3)
    with pytest.raises(TypeError, match="`axes.drive_frequency` of a grid is NoneType\nit must be a number"):
        flapwing.Grid({"preset": "ozaki2018-large", "axes": {"drive_frequency": [None]}})
    with pytest.raises(TypeError, match="keys of a grid must be text"):
        flapwing.Grid({3: "ozaki2018-large"})
    bad = tmp_path / "latin.toml"
    bad.write_bytes(b"preset = 'caf\xe9'")
    with pytest.raises(ValueError, match="UTF-8"):
        flapwing.Grid(bad)


def test_the_examples_are_grids():
    examples = list((Path(__file__).parents[2] / "examples").glob("*.toml"))
    assert len(examples) > 10
    for example in examples:
        assert len(flapwing.Grid(example)) > 0
