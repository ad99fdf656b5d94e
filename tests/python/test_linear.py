"""Linear models about hover: exported files load in SciPy and python-control, with the printed eigenvalues."""

import csv
import importlib.util
import io
import json

import control
import flapwing
import numpy as np
import pytest
import scipy.io

GRID = """
preset = "jafferis2016"
[vehicle]
about = [0, 0, "-3 mm"]
total_mass = "69 mg"
[[vehicle.wings]]
name = "left"
position = [0, "2 mm", 0]
[[vehicle.wings]]
name = "right"
position = [0, "2 mm", 0]
mirrored = true
[params]
drive_voltage_pp = "140 V"
drive_frequency = "120 Hz"
"""
INERTIA = {"body_inertia_roll": 1.5e-9, "body_inertia_pitch": 1.5e-9, "body_inertia_yaw": 0.5e-9}
SET = [word for name, value in INERTIA.items() for word in ("--set", f"{name}={value}")]


def ordered(eigenvalues):
    """Eigenvalues in an order that does not depend on rounding."""
    eigenvalues = np.asarray(eigenvalues, dtype=complex)
    return eigenvalues[np.lexsort((eigenvalues.imag.round(6), eigenvalues.real.round(6)))]


@pytest.fixture
def grid(tmp_path):
    path = tmp_path / "robot.toml"
    path.write_text(GRID, encoding="utf-8")
    return path


def printed(flap, grid):
    rows = csv.DictReader(io.StringIO(flap("vehicle", grid, *SET, "--hover", "--format", "csv").stdout))
    pairs = []
    for row in rows:
        value = complex(float(row["eigenvalue_real"]), float(row["eigenvalue_imag"]))
        pairs += [value, value.conjugate()] if value.imag else [value]
    return ordered(pairs)


def test_exported_models_have_the_printed_eigenvalues(flap, grid, tmp_path):
    expected = printed(flap, grid)
    for ending in ("json", "mat", "py"):
        flap("vehicle", grid, *SET, "--export", tmp_path / f"hover.{ending}")
    as_json = json.loads((tmp_path / "hover.json").read_text(encoding="utf-8"))
    as_matlab = scipy.io.loadmat(tmp_path / "hover.mat", squeeze_me=True)
    spec = importlib.util.spec_from_file_location("hover", tmp_path / "hover.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert isinstance(module.system, control.StateSpace)
    for matrix in (as_json["A"], as_matlab["A"], module.A, module.system.A):
        assert np.allclose(ordered(np.linalg.eigvals(matrix)), expected, rtol=1e-9, atol=1e-9)
    for name, value in as_json.items():
        other, theirs = as_matlab[name], getattr(module, name)
        if isinstance(value, (str, float)):
            assert other == value == theirs, name
        else:
            assert np.array_equal(np.asarray(other), np.asarray(value)), name
            assert np.array_equal(np.asarray(theirs), np.asarray(value)), name
    assert module.system.state_labels == as_json["states"]
    assert module.system.input_labels == as_json["inputs"]
    assert as_json["total_mass"] == pytest.approx(69e-6)


def test_a_file_is_not_overwritten_unasked(flap, grid, tmp_path):
    out = tmp_path / "hover.json"
    out.write_text("mine", encoding="utf-8")
    with pytest.raises(Exception, match="hover.json"):
        flap("vehicle", grid, *SET, "--export", out)
    assert out.read_text(encoding="utf-8") == "mine"


@pytest.fixture
def robot():
    """The vehicle of GRID."""
    place = ["0 mm", "2 mm", "0 mm"]
    wings = [flapwing.Wing("left", position=place), flapwing.Wing("right", position=place, mirrored=True)]
    return flapwing.Vehicle("jafferis2016", wings, about=["0 mm", "0 mm", "-3 mm"], total_mass="69 mg")


def test_linear_is_the_exported_model(flap, grid, robot, tmp_path):
    flap("vehicle", grid, *SET, "--export", tmp_path / "hover.json")
    file = json.loads((tmp_path / "hover.json").read_text(encoding="utf-8"))
    model = robot.linear(drive_voltage_pp="140 V", drive_frequency="120 Hz", **INERTIA)
    for name in ("A", "B", "damping", "control_matrix", "W0", "inputs", "states"):
        assert np.array_equal(np.asarray(getattr(model, name)), np.asarray(file[name])), name
    system = model.statespace()
    assert np.allclose(ordered(system.poles()), ordered(model.eigenvalues), rtol=1e-9, atol=1e-9)
    assert model.modes[0] == "pitch and forward velocity (longitudinal oscillation)"
    assert model == model and model in {model} and model != robot.linear(drive_voltage_pp="140 V", **INERTIA)
    with pytest.raises(ValueError, match="body_inertia_roll"):
        robot.linear()


def test_control_matrices_are_in_si_units(robot):
    """The command shows these inputs in mm and deg."""
    inputs = ["about_x", "left_plane_pitch"]
    values = {"drive_voltage_pp": 140.0, "drive_frequency": 120.0, "about_x": 1e-3}
    model = robot.linear(inputs=inputs, **values, **INERTIA)
    assert model.input_units == ["m", "rad"] and model.input_values == pytest.approx([1e-3, 0.0], rel=1e-12)
    wrench = [f"force_{name}_mn" for name in ("forward", "left", "up")]
    wrench += [f"torque_{name}_unm" for name in ("roll", "pitch", "yaw")]
    table = flapwing.evaluate(robot, values, measures=wrench, gradient=inputs)
    to_si = np.repeat([1e-3, 1e-6], 3)[:, None]
    assert np.allclose(model.control_matrix, to_si * table.gradient[0], rtol=1e-6, atol=1e-15)
    # The lift has the lever about_x, and the pitch of a stroke plane turns the lift of its wing forward.
    assert model.control_matrix[4, 0] == pytest.approx(model.W0[2], rel=1e-5)
    assert model.control_matrix[0, 1] == pytest.approx(model.W0[2] / 2, rel=1e-5)
