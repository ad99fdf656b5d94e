"""Devices: files with a preset and parameters of one's own, wherever a design is named."""

import os

import flapwing
import pytest

DEVICE = """\
preset = "jafferis2016"

[params]
hinge_stiffness = { value = "2 uN*m/rad", relative_sd = "5 %", source = "bending test" }
wing_inertia_stroke = { value = "50 ng*m^2", sd = "1 ng*m^2" }
drive_voltage_pp = "160 V"

[[correlation]]
between = ["hinge_stiffness", "wing_inertia_stroke"]
coefficient = 0.6
"""
SET = {"hinge_stiffness": 2e-6, "wing_inertia_stroke": 50e-12, "drive_voltage_pp": 160.0}


@pytest.fixture
def bee(tmp_path):
    path = tmp_path / "mybee.toml"
    path.write_text(DEVICE, encoding="utf-8")
    return path


def run(design, **keywords):
    """The row without the measures that it lacks, which differ from themselves."""
    return {name: value for name, value in flapwing.run(design, **keywords).items() if value == value}


def test_calls_take_a_device_for_a_preset(bee):
    assert run(bee) == run("jafferis2016", **SET) == run(str(bee)) == run({"device": str(bee)})
    assert run(bee, hinge_stiffness=3e-6) == run("jafferis2016", **{**SET, "hinge_stiffness": 3e-6})
    at = {"drive_frequency": [110.0, 120.0]}
    rows, same = flapwing.evaluate(bee, at), flapwing.evaluate("jafferis2016", at, **SET)
    assert rows["lift_mean_mn"].tolist() == same["lift_mean_mn"].tolist()
    curve = flapwing.respond(bee, start=110, stop=120, step=5, tolerance=5)
    assert len(curve) == 6 and curve["stroke_pp_deg"][2] == pytest.approx(rows["stroke_pp_deg"][1], rel=1e-6)
    assert flapwing.resonance(bee) == flapwing.resonance("jafferis2016", **SET)
    assert len(flapwing.trajectory(bee, cycles=1, samples=10)) == 11
    table = flapwing.sweep({"device": str(bee), "axes": at})
    assert table["lift_mean_mn"].tolist() == rows["lift_mean_mn"].tolist()


def test_a_device_is_listed_with_its_values(bee):
    listed, preset = flapwing.params(bee), flapwing.params("jafferis2016")
    assert {name: listed[name].value for name in SET} == SET
    assert list(listed) == list(preset) and listed["wing_area"] == preset["wing_area"]
    assert flapwing.params({"device": str(bee)}) == listed == flapwing.params(flapwing.Grid(bee))
    assert flapwing.measures(bee) == flapwing.measures("jafferis2016")
    assert flapwing.states(bee) == flapwing.states("jafferis2016")


def test_a_fit_of_a_device_keeps_what_is_known_of_the_others(bee, tmp_path):
    points = {"drive_frequency": [90.0, 100.0, 110.0, 120.0, 130.0]}
    data = {**points, "stroke_pp_deg": flapwing.evaluate(bee, points)["stroke_pp_deg"]}
    found = flapwing.fit(bee, data, ["drag_coefficient_max"], sigma="3 %", starts=1, profile=False)
    found.write_device(tmp_path / "next.toml")
    text = (tmp_path / "next.toml").read_text(encoding="utf-8")
    assert (
        'hinge_stiffness = { value = 2e-06, sd = 1e-07, source = "bending test" }' in text
        and text.count("[[correlation]]") == 1
    )
    builds = {"device": str(tmp_path / "next.toml"), "sample": {"of": "device", "method": "sobol", "n": 256}}
    table = flapwing.sweep(builds, measures=["lift_mean_mn"])
    assert table["hinge_stiffness"].std() == pytest.approx(1e-7, rel=0.05)
    assert table["drag_coefficient_max"].std() == pytest.approx(found.estimates["drag_coefficient_max"].error, rel=0.05)
    # A value that is fitted, or set by the call, has another error, or none.
    found = flapwing.fit(
        bee, data, ["hinge_stiffness"], sigma="3 %", starts=1, profile=False, wing_inertia_stroke=51e-12
    )
    found.write_device(tmp_path / "last.toml")
    text = (tmp_path / "last.toml").read_text(encoding="utf-8")
    assert "wing_inertia_stroke = 5.1e-11\n" in text and "[[correlation]]" not in text


@pytest.mark.parametrize(
    ("text", "says", "line"),
    [
        ('device = "mybee.toml"\n', "the device refers to itself: ", 1),
        ('device = "none.toml"\n', "none.toml: ", 1),
        ('preset = "jafferis2016"\n[params]\nvehicle_mass = "-80 mg"\n', "`vehicle_mass` must be zero or more", 3),
        ('preset = "jafferis2016"\n[params]\nwing_aera = 1\n', "did you mean `wing_area`?", 3),
        (
            'preset = "jafferis2016"\n[params]\nwing_area = { value = 5e-5, sd = -1 }\n',
            "must give a standard error of more than zero",
            3,
        ),
    ],
)
def test_mistakes_in_devices_are_grid_errors_with_their_place(bee, text, says, line):
    bee.write_text(text, encoding="utf-8")
    data = {"drive_frequency": [100.0, 110.0], "stroke_pp_deg": [60.0, 61.0]}
    for call in (
        lambda: flapwing.run(bee),
        lambda: flapwing.params(bee),
        lambda: flapwing.Grid({"device": str(bee), "axes": {"drive_frequency": [100, 110]}}),
        lambda: flapwing.evaluate(bee, {"drive_frequency": [100.0]}),
        lambda: flapwing.fit(bee, data, ["hinge_stiffness"]),
    ):
        with pytest.raises(flapwing.GridError) as caught:
            call()
        assert says in str(caught.value) and caught.value.diagnostics[0].line == line


def test_a_device_that_is_not_there_is_told(tmp_path):
    for call in (flapwing.run, flapwing.params, flapwing.Grid):
        with pytest.raises(FileNotFoundError, match="none.toml"):
            call(tmp_path / "none.toml")


@pytest.fixture
def two(tmp_path):
    """The paths of two devices, as a list."""
    for name, length in [("short", 15), ("long", 19)]:
        text = f'preset = "jafferis2016"\n[params]\nwing_length = "{length} mm"\n'
        (tmp_path / f"{name}.toml").write_text(text, encoding="utf-8")
    return [str(tmp_path / "short.toml"), str(tmp_path / "long.toml")]


def test_a_list_of_devices_is_an_axis(two, tmp_path):
    at = {"drive_frequency": [110.0, 120.0, 130.0]}
    grid = {"device": two, "axes": at}
    table = flapwing.sweep(grid)
    assert table.columns[:3] == ["point", "device", "drive_frequency"]
    assert table["device"].tolist() == ["short"] * 3 + ["long"] * 3
    each = [flapwing.sweep({"device": path, "axes": at})["lift_mean_mn"] for path in two]
    assert table["lift_mean_mn"].reshape(2, 3).tolist() == [lift.tolist() for lift in each]
    axes = flapwing.Grid(grid).axes
    assert [list(axis) for axis in axes] == [["device"], ["drive_frequency"]]
    assert axes[0]["device"] == ["short", "long"]
    assert [point["wing_length"] for point in flapwing.Grid(grid)[::3]] == [0.015, 0.019]
    assert flapwing.Grid(grid).varied == ["device", "drive_frequency"]
    # The same table from a file, also after the devices are gone.
    written = tmp_path / "rows.parquet"
    flapwing.sweep(grid, out=written)
    for path in two:
        os.remove(path)
    again = flapwing.read(written)
    assert again["device"].tolist() == table["device"].tolist()
    assert again["lift_mean_mn"].tolist() == table["lift_mean_mn"].tolist()


def test_a_list_of_presets_is_an_axis():
    presets = ["jafferis2016", "jafferis2016-improved"]
    table = flapwing.sweep({"preset": presets})
    assert table["preset"].tolist() == presets
    each = [flapwing.run(preset)["stroke_pp_deg"] for preset in presets]
    assert table["stroke_pp_deg"].tolist() == each
