"""Vehicles: their entries, rows equal to those of the command, and mistakes."""

import pickle
from pathlib import Path

import flapwing
import numpy as np
import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"
PLACE = ["0 mm", "1.5 mm", "0 mm"]
TORQUES = ["torque_roll_unm", "torque_pitch_unm", "torque_yaw_unm"]
FORCES = ["force_forward_mn", "force_left_mn", "force_up_mn"]


def pair(design="jafferis2016", **options):
    wings = [flapwing.Wing("left", position=PLACE), flapwing.Wing("right", position=PLACE, mirrored=np.True_)]
    return flapwing.Vehicle(design, wings, about=["0 mm", "0 mm", "-2 mm"], total_mass="85 mg", **options)


def same(one, other):
    assert list(one) == list(other)
    for name in one:
        assert np.array_equal(one[name], other[name], equal_nan=one[name].dtype.kind == "f"), name


def test_rows_are_those_of_the_command_bit_for_bit(flap, tmp_path):
    axes = {"difference_drive_voltage_pp": ["-20 V", "0 V", "20 V"], "left_drive_offset": [0, "10 V"]}
    out, theirs = tmp_path / "python.csv", tmp_path / "command.csv"
    flapwing.sweep({**pair(), "axes": axes}, out=out)
    grid = tmp_path / "vehicle.toml"
    grid.write_text(
        """
preset = "jafferis2016"
[vehicle]
about = ["0 mm", "0 mm", "-2 mm"]
total_mass = "85 mg"
[[vehicle.wings]]
name = "left"
position = ["0 mm", "1.5 mm", "0 mm"]
[[vehicle.wings]]
name = "right"
position = ["0 mm", "1.5 mm", "0 mm"]
mirrored = true
[axes]
difference_drive_voltage_pp = ["-20 V", "0 V", "20 V"]
left_drive_offset = [0, "10 V"]
""",
        encoding="utf-8",
    )
    flap("sweep", grid, "--out", theirs)
    assert out.read_bytes() == theirs.read_bytes()
    same(flapwing.sweep(grid), flapwing.sweep({**pair(), "axes": axes}))


def test_a_vehicle_goes_wherever_a_design_is_named():
    robot = pair()
    row = flapwing.run(robot, difference_drive_voltage_pp="20 V", rtol=1e-7)
    table = flapwing.sweep(robot, difference_drive_voltage_pp="20 V", rtol=1e-7)
    batch = flapwing.evaluate(robot, {"difference_drive_voltage_pp": [20.0, -20.0]}, rtol=1e-7)
    for column in [*FORCES, *TORQUES, "lift_to_weight", "left_stroke_pp_deg", "power_mean_mw"]:
        assert row[column] == table[column][0] == batch[column][0], column
    assert row["torque_roll_unm"] > 0.1
    assert batch["torque_roll_unm"][0] == -batch["torque_roll_unm"][1]
    grid = flapwing.Grid(robot)
    assert len(grid) == 1 and grid.model == "bimorph" and grid[0]["left_position_y"] == 1.5e-3
    again = flapwing.evaluate(grid, batch, measures=TORQUES, rtol=1e-7)
    assert np.array_equal(again["torque_roll_unm"], batch["torque_roll_unm"])


def test_wings_may_be_dictionaries_and_have_designs_of_their_own(tmp_path):
    device = tmp_path / "wing.toml"
    device.write_text('preset = "jafferis2016"\n[params]\nhinge_stiffness = "1.4 uN*m/rad"\n', encoding="utf-8")
    turned = {"pitch": "5 deg"}
    wings = [
        {"name": "left", "position": PLACE, "plane": turned, "params": {"wing_area": 55e-6}},
        flapwing.Wing("right", position=(0, 1.5e-3, 0), plane=turned, mirrored=True, device=device),
    ]
    robot = flapwing.Vehicle(device, wings)
    values = flapwing.params(robot)
    assert values["hinge_stiffness"].value == 1.4e-6
    assert values["right_position_y"].value == 1.5e-3 and values["left_wing_area"].value == 55e-6
    assert values["left_plane_pitch"].value == pytest.approx(np.radians(5.0), rel=1e-15)
    of_grid = flapwing.Vehicle({"preset": "jafferis2016", "params": {"hinge_stiffness": "1.4 uN*m/rad"}}, wings)
    same(flapwing.sweep(robot), flapwing.sweep(of_grid))
    assert robot["vehicle"]["wings"][1]["device"] == str(device)


def test_derivatives_of_torques_are_those_of_differences():
    robot = pair()
    inputs = ["difference_drive_voltage_pp", "drive_offset", "left_hinge_stiffness", "about_z"]
    columns = {"drive_voltage_pp": [200.0], "left_hinge_stiffness": [1.5e-6]}
    options = {"measures": [*FORCES, *TORQUES], "rtol": 1e-8, "settle_tol": 1e-9}
    table = flapwing.evaluate(robot, columns, gradient=inputs, **options)
    assert table.gradient.shape == (1, 6, 4)
    assert table.units["d_torque_roll_unm_per_si_difference_drive_voltage_pp"] == "uN*m/V"
    values = {"difference_drive_voltage_pp": 0.0, "drive_offset": 0.0, "left_hinge_stiffness": 1.5e-6, "about_z": -2e-3}
    steps = {"difference_drive_voltage_pp": 0.5, "drive_offset": 0.5, "left_hinge_stiffness": 1e-9, "about_z": 1e-4}
    for place, name in enumerate(inputs):
        around = {**columns, name: [values[name] - steps[name], values[name] + steps[name]]}
        around = {key: np.resize(column, 2) for key, column in around.items()}
        rows = flapwing.evaluate(robot, around, **options)
        for output, column in enumerate([*FORCES, *TORQUES]):
            difference = np.diff(rows[column])[0] / (2 * steps[name])
            scale = np.abs(table.gradient[0, :, place]).max()
            assert table.gradient[0, output, place] == pytest.approx(difference, rel=1e-3, abs=2e-4 * scale), (
                column,
                name,
            )


def test_derivatives_at_almost_nothing_are_those_at_zero():
    robot = pair()
    options = {"measures": [*FORCES, *TORQUES], "gradient": ["drive_offset"]}
    almost = 0.1 + 0.2 - 0.3  # a remainder of rounding, as steps of axes leave it
    assert almost != 0.0
    found = [
        flapwing.evaluate(robot, {"drive_offset": [value]}, **options).gradient[0, 4, 0]
        for value in (0.0, almost, 1e-9)
    ]
    assert found[0] < -0.01
    assert found[1] == pytest.approx(found[0], rel=1e-5) and found[2] == pytest.approx(found[0], rel=1e-5)
    # A wing's own value that is not set is that of all wings.
    own = flapwing.evaluate(robot, {"drive_offset": [5.0]}, measures=TORQUES, gradient=["left_drive_offset"])
    given = flapwing.evaluate(
        robot, {"drive_offset": [5.0], "left_drive_offset": [5.0]}, measures=TORQUES, gradient=["left_drive_offset"]
    )
    np.testing.assert_allclose(own.gradient, given.gradient, rtol=1e-9, atol=1e-12)


def test_values_that_reach_no_wing_are_warned_of():
    wings = [flapwing.Wing("left", preset="jafferis2016"), flapwing.Wing("right", mirrored=True, preset="jafferis2016")]
    with pytest.warns(UserWarning, match="`hinge_stiffness` has no effect") as caught:
        flapwing.sweep({**flapwing.Vehicle("jafferis2016", wings), "params": {"hinge_stiffness": 1.2e-6}})
    assert {warning.filename for warning in caught} == {__file__}


def test_states_of_a_vehicle_begin_its_motions():
    robot = pair()
    names = list(flapwing.states(robot))
    assert len(names) == 2 * len(flapwing.states("jafferis2016")) and names[0].startswith("left_")
    first = flapwing.evaluate(robot, {"drive_offset": [0.0, 10.0]}, return_states=True)
    second = flapwing.evaluate(robot, {"drive_offset": [0.0, 10.0]}, initial_state=first)
    assert second["cycles"].sum() < first["cycles"].sum()
    assert second["torque_pitch_unm"][1] == pytest.approx(first["torque_pitch_unm"][1], rel=1e-4)


def test_lists_know_vehicles():
    robot = pair()
    assert {*FORCES, *TORQUES, "lift_to_weight", "left_lift_mean_mn"} <= set(flapwing.measures(robot))
    assert flapwing.measures(robot)["torque_yaw_unm"].unit == "uN*m"
    parameters = flapwing.params(robot)
    assert parameters["difference_drive_offset"].unit == "V" and parameters["total_mass"].value == 85e-6
    # A parameter that follows that of all wings has no value; one that a grid varies has that of the first point.
    assert np.isnan(parameters["left_drive_voltage_pp"].value)
    varied = flapwing.params({**robot, "axes": {"drive_offset": [1, 2]}})
    assert varied["drive_offset"].value == 1.0 and varied["drive_voltage_pp"].value == 200.0


def test_a_vehicle_is_a_mapping_of_entries():
    robot = pair()
    assert list(robot) == ["preset", "vehicle"] and len(robot) == 2
    assert dict(pickle.loads(pickle.dumps(robot))) == dict(robot)
    assert repr(robot) == "<flapwing.Vehicle of jafferis2016: left, right (mirrored)>"
    assert (
        repr(flapwing.Wing("left", position=PLACE)) == "flapwing.Wing(name='left', position=['0 mm', '1.5 mm', '0 mm'])"
    )
    text = flapwing.Grid({**robot, "axes": {"drive_offset": ["0 V"]}}).text
    assert '[[vehicle.wings]]\nname = "left"' in text and text.count("[[vehicle.wings]]") == 2


def test_keywords_go_over_the_grid_of_a_vehicle(tmp_path):
    robot = {**pair(), "axes": {"drive_offset": ["-10 V", "10 V"]}}
    out = tmp_path / "rows.csv"
    table = flapwing.sweep(robot, out=out, drive_voltage_pp="180 V", left_wing_area="55 mm^2", measures=TORQUES)
    assert len(table) == 2 and list(table)[-3:] == TORQUES
    assert "left_wing_area" in flapwing.read(out).meta["grid"]


@pytest.mark.parametrize(
    ("arguments", "error", "says"),
    [
        ((3, []), TypeError, "`design` is int\nit must be the name of a preset, the path of a device"),
        (("jafferis2016", []), ValueError, "`wings` is empty\na vehicle has at least one wing"),
        (("jafferis2016", "left"), TypeError, "`wings` is str\nit must be a list of wings"),
        (("jafferis2016", ["left"]), TypeError, r"`wings\[0\]` is str\nit must be a flapwing.Wing"),
        (("jafferis2016", [{"mirrored": True}]), flapwing.GridError, "the wing has no `name`"),
        (("jafferis2016", [{"name": "left", "positon": PLACE}]), flapwing.GridError, "unknown key `positon`"),
        (("jafferis201", [{"name": "left"}]), flapwing.GridError, "there is no preset `jafferis201`"),
        (("no/such.toml", [{"name": "left"}]), flapwing.GridError, "no/such.toml"),
        (("jafferis2016", [{"name": "left"}] * 2), flapwing.GridError, "two wings are called `left`"),
        (({"preset": "jafferis2016", "vehicle": {}}, [{"name": "left"}]), ValueError, "already has a vehicle"),
        (
            ("jafferis2016", [flapwing.Wing("left", params={"hinge_stifness": 1e-6})]),
            flapwing.GridError,
            "did you mean `hinge_stiffness`",
        ),
        (
            ("jafferis2016", [flapwing.Wing("left", preset="ozaki2018-large")]),
            flapwing.GridError,
            "has the model direct-drive",
        ),
    ],
)
def test_mistakes_are_told(arguments, error, says):
    with pytest.raises(error, match=says):
        flapwing.Vehicle(*arguments)


def test_flags_of_a_vehicle_are_true_or_false():
    wings = [flapwing.Wing("left")]
    assert flapwing.Vehicle("jafferis2016", wings, damping=np.True_)["vehicle"]["damping"] is True
    with pytest.raises(TypeError, match="`damping` is str\nit must be True or False"):
        flapwing.Vehicle("jafferis2016", wings, damping="yes")
    for name in ("trim", "positions"):
        with pytest.raises(TypeError, match=f"`{name}` is str\nit must be True or False"):
            flapwing.Vehicle("jafferis2016", wings).linear(**{name: "yes"})


@pytest.mark.parametrize(
    ("options", "error", "says"),
    [
        ({"name": 3}, TypeError, "`name` is int\nit must be the name of a wing"),
        ({"mirrored": "yes"}, TypeError, "`mirrored` is str\nit must be True or False"),
        ({"position": "4 mm"}, TypeError, "`position` is str\nit must be three lengths along x, y and z"),
        ({"position": [0, 1]}, ValueError, "`position` has 2 entries\nit must be three lengths"),
        ({"plane": 3}, TypeError, "`plane` is int\nit must be a dictionary of angles"),
        ({"plane": {"tilt": 3}}, ValueError, "`plane` has no entry 'tilt'\nits entries are roll, pitch, yaw"),
        ({"params": [3]}, TypeError, "`params` is list\nit must be a dictionary of parameters"),
        ({"device": 3}, TypeError, "`device` is int\nit must be the path of a device file"),
        ({"preset": 3}, TypeError, "`preset` is int\nit must be the name of a preset"),
    ],
)
def test_mistakes_of_wings_are_told(options, error, says):
    with pytest.raises(error, match=says):
        flapwing.Wing(**{"name": "left", **options})


def test_a_vehicle_has_no_single_motion():
    says = "the design is a vehicle of 2 wings, but this call requires one wing"
    for call in (flapwing.trajectory, flapwing.resonance, flapwing.chirp, flapwing.impulse):
        with pytest.raises(ValueError, match=says):
            call(pair())
    with pytest.raises(ValueError, match=says):
        flapwing.respond(pair(), "drive_frequency", start=90.0, stop=100.0, step=5.0)


def test_the_examples_are_vehicles():
    for name, wings in (("vehicle", 2), ("four_wings", 4)):
        grid = flapwing.Grid(EXAMPLES / f"{name}.toml")
        row = flapwing.run(grid, point=len(grid) // 2)
        assert sum(column.endswith("_lift_mean_mn") for column in row) == wings
        assert row["lift_to_weight"] > 1.0 and abs(row["torque_roll_unm"]) < 1e-9
