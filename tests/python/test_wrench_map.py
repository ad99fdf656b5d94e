"""Quadratic maps of a vehicle: the same map as the command's, values at inputs, and mistakes."""

import dataclasses
import json
from concurrent.futures import ThreadPoolExecutor

import flapwing
import numpy as np
import pytest

PLACE = ["0 mm", "2 mm", "0 mm"]
WINGS = [flapwing.Wing("left", position=PLACE), flapwing.Wing("right", position=PLACE, mirrored=True)]
VEHICLE = flapwing.Vehicle(
    {"preset": "jafferis2016", "params": {"drive_frequency": "100 Hz"}}, WINGS, about=["0 mm", "0 mm", "-3 mm"]
)
RANGES = {
    "amplitude": ("190 V", "210 V"),
    "bias": (-5, 5.0),
    "amplitude_difference": ["-10 V", "10 V"],
    "bias_difference": (-5.0, 5.0),
}


@pytest.fixture(scope="module")
def quadratic():
    return flapwing.wrench_map(VEHICLE, ranges=RANGES, samples=200, threads=2)


def test_the_map_is_that_of_the_command(quadratic, flap, tmp_path):
    path = tmp_path / "grid.toml"
    path.write_text(flapwing.Grid(VEHICLE).text, encoding="utf-8")
    ranges = "amplitude=190V:210V,bias=-5V:5V,amplitude_difference=-10V:10V,bias_difference=-5V:5V"
    ended = flap("vehicle", str(path), "--wrench-map", ranges, "--samples", "200", "--format", "json")
    same = json.loads(ended.stdout)
    for name in ("scaled", "physical", "powers"):
        np.testing.assert_array_equal(getattr(quadratic, name), same[name])
    assert quadratic.components == [output["name"] for output in same["outputs"]]
    assert quadratic.parameters == [entry["parameter"] for entry in same["inputs"]]
    assert quadratic.units == ["V"] * 4
    np.testing.assert_array_equal(quadratic.stop, [210.0, 5.0, 10.0, 5.0])
    np.testing.assert_array_equal(quadratic.largest_error, [output["largest_error"] for output in same["outputs"]])
    assert quadratic.rows == same["rows"] == {"fitted": 160, "left_out": 40}
    assert 0 < quadratic.floquet_max < 0.7


def test_values_agree_with_rows_and_physical_coefficients(quadratic):
    generator = np.random.default_rng(1)
    inputs = generator.uniform(quadratic.start, quadratic.stop, (5, 2, 4))
    wrench = quadratic.evaluate(inputs)
    assert wrench.shape == (5, 2, 6)
    np.testing.assert_allclose(quadratic(inputs[1, 1]), wrench[1, 1], rtol=0, atol=1e-15)
    terms = np.prod(inputs[..., np.newaxis, :] ** quadratic.powers, axis=-1)
    np.testing.assert_allclose(terms @ quadratic.physical.T, wrench, rtol=0, atol=1e-11)
    columns = dict(zip(quadratic.parameters, inputs.reshape(10, 4).T, strict=True))
    rows = flapwing.evaluate(VEHICLE, columns)
    for place, name in enumerate(quadratic.components):
        error = np.abs(rows[name] - wrench.reshape(10, 6)[:, place]).max()
        assert error < 1.5 * quadratic.largest_error[place], name


def test_maps_are_frozen(quadratic):
    with pytest.raises(dataclasses.FrozenInstanceError):
        quadratic.rows = {}


def test_an_executor_computes_the_same_map(quadratic):
    with ThreadPoolExecutor(1) as executor:
        same = flapwing.wrench_map(VEHICLE, ranges=RANGES, samples=200, client=executor)
    np.testing.assert_array_equal(same.scaled, quadratic.scaled)


def test_progress_counts_rows():
    seen = []
    ranges = {"bias": ("-10 V", "10 V")}
    flapwing.wrench_map(VEHICLE, ranges=ranges, samples=20, progress=lambda done, total: seen.append((done, total)))
    assert seen[-1] == (20, 20)


def test_poor_maps_warn():
    ranges = {"drive_frequency": (60.0, 160.0), "amplitude": (150.0, 250.0)}
    with pytest.warns(UserWarning) as caught:
        flapwing.wrench_map(VEHICLE, ranges=ranges)
    texts = [str(warning.message) for warning in caught]
    assert any("R^2 below 0.99, for force_up_mn" in text for text in texts)
    assert any("Floquet multiplier of the rows is 0.8" in text for text in texts)
    assert {warning.filename for warning in caught} == {__file__}


@pytest.mark.parametrize(
    ("ranges", "error", "message"),
    [
        ({"bias": ("20 V", "-20 V")}, ValueError, "range of `bias` ends below its beginning\na range has its smaller"),
        ({"bias": (1, 1)}, ValueError, "range of `bias` is empty"),
        ({"bias": (1, 2, 3)}, ValueError, r"`ranges\['bias'\]` has 3 values"),
        ({"bias": "1 V"}, TypeError, r"`ranges\['bias'\]` is str"),
        ({"bias": 3}, TypeError, r"`ranges\['bias'\]` is int"),
        ({1: (1, 2)}, TypeError, "`ranges` is int"),
        ({"biass": (1, 2)}, ValueError, "ranges: the vehicle has no input `biass`\ndid you mean `bias`\\?"),
        ({"bias": ("1 V", "2 mm")}, ValueError, "`mm` is a length"),
        ({"drive_shape": (0, 1)}, ValueError, "`drive_shape` is a choice"),
        ({"bias": (1, 2), "drive_offset": (1, 2)}, ValueError, "`drive_offset` is named twice"),
        ({}, ValueError, "needs 1 to 16 inputs, not 0"),
        ([("bias", 1, 2)], TypeError, "`ranges` is list"),
    ],
)
def test_mistakes_in_ranges(ranges, error, message):
    with pytest.raises(error, match=message):
        flapwing.wrench_map(VEHICLE, ranges=ranges)


def test_other_mistakes(quadratic):
    ranges = {"bias": (-10, 10)}
    with pytest.raises(ValueError, match="5 samples are too few for 3 coefficients .*: at least 10 are needed"):
        flapwing.wrench_map(VEHICLE, ranges=ranges, samples=5)
    with pytest.raises(ValueError, match="4000000000 samples are too many: at most 1000000 are allowed"):
        flapwing.wrench_map(VEHICLE, ranges=ranges, samples=4_000_000_000)
    with pytest.raises(ValueError, match="the design describes one wing, not a vehicle\nadd"):
        flapwing.wrench_map("jafferis2016", ranges=ranges)
    with pytest.raises(ValueError, match="none of the 400 rows are periodic, .*: 400 unsettled\nchoose narrower"):
        flapwing.wrench_map(VEHICLE, ranges=ranges, max_cycles=1)
    with pytest.raises(ValueError, match="has 2 values, not 4\nthe inputs of this map are amplitude, bias"):
        quadratic([200.0, 0.0])
    with pytest.raises(ValueError, match="has one number, not 4"):
        quadratic(200.0)
    with pytest.raises(TypeError, match="`inputs` is str"):
        quadratic("200 V")
