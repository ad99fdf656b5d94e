"""Forces and torques of vehicles, as a map and as panels."""

import flapwing
import matplotlib.pyplot as plt
import numpy as np
import pytest
from figures import drawn, lines, message
from flapwing import plot
from matplotlib.figure import Figure

OUTPUTS = ["force_forward_mn", "force_left_mn", "force_up_mn", "torque_roll_unm", "torque_pitch_unm", "torque_yaw_unm"]
ROWS = ["Forward force (mN)", "Left force (mN)", "Up force (mN)"]
ROWS += ["Roll torque (µN·m)", "Pitch torque (µN·m)", "Yaw torque (µN·m)"]
EFFECTS = np.array([[0.0, 1e-7], [3e-4, 0.0], [0.0, 0.0], [7.12345e-3, 0.0], [0.0, -0.05], [0.0, 0.0]])


def cells(ax):
    """The numbers in the map, in rows."""
    texts = {tuple(reversed(text.get_position())): text.get_text() for text in ax.texts}
    return [[texts[row, column] for column in range(len(ax.get_xticks()))] for row in range(len(ax.get_yticks()))]


def labels(axis):
    return [label.get_text() for label in axis.get_ticklabels()]


@pytest.fixture(scope="module")
def robot():
    place = ["0 mm", "1.5 mm", "0 mm"]
    wings = [flapwing.Wing("left", position=place), flapwing.Wing("right", position=place, mirrored=True)]
    return flapwing.Vehicle("jafferis2016", wings, about=["0 mm", "0 mm", "-2 mm"])


@pytest.fixture(scope="module")
def slopes(robot):
    by = ["drive_voltage_pp", "difference_drive_voltage_pp", "drive_offset"]
    return flapwing.evaluate(robot, {"drive_frequency": [120.0]}, gradient=by, measures=[*OUTPUTS, "power_mean_mw"])


def course(**columns):
    """Columns of a vehicle's rows."""
    size = len(next(iter(columns.values())))
    made = {name: np.arange(size) + 10.0 * place for place, name in enumerate(OUTPUTS)}
    return {**columns, "status": np.array(["periodic"] * size, dtype="U12"), **made}


def test_an_array_is_a_map_with_its_numbers():
    ax = drawn(plot.control_matrix(EFFECTS, inputs=["amplitude_difference", "bias"]))
    assert labels(ax.yaxis) == ROWS
    assert cells(ax) == [
        ["≈0", "≈0"],
        ["0.0003", "≈0"],
        ["≈0", "≈0"],
        ["0.00712", "≈0"],
        ["≈0", "−0.05"],
        ["≈0", "≈0"],
    ]
    image = ax.images[0]
    # The colours of a column are shares of its largest.
    assert image.get_array()[3, 0] == 1.0 and image.get_array()[4, 1] == -1.0 and image.get_clim() == (-1.0, 1.0)
    assert image.get_array()[1, 0] == pytest.approx(3e-4 / 7.12345e-3)


def test_derivatives_are_a_map(slopes):
    ax = drawn(plot.control_matrix(slopes))
    assert labels(ax.yaxis) == ROWS
    assert [text.replace("\n", " ") for text in labels(ax.xaxis)] == [
        "Drive voltage, peak to peak per V",
        "Difference drive voltage, peak to peak per V",
        "Drive offset per V",
    ]
    shown = cells(ax)
    assert float(shown[2][0]) == pytest.approx(slopes.gradient[0, 2, 0], rel=1e-2)
    assert float(shown[4][2].replace("−", "-")) == pytest.approx(slopes.gradient[0, 4, 2], rel=1e-2)
    assert (np.abs(ax.images[0].get_array()).argmax(axis=0) == [2, 3, 4]).all()
    ax = plot.control_matrix(slopes, inputs=["drive_offset"])
    assert cells(ax) == [[row[2]] for row in shown]


def test_what_the_command_prints_is_the_same_map(flap, tmp_path, robot, slopes):
    grid, file = tmp_path / "grid.toml", tmp_path / "effects.csv"
    grid.write_text(flapwing.Grid(robot).text, encoding="utf-8")
    names = "amplitude,amplitude_difference,bias"
    file.write_text(flap("vehicle", grid, "--inputs", names, "--format", "csv").stdout, encoding="utf-8")
    ax = drawn(plot.control_matrix(file))
    assert [row[1] for row in cells(ax)] == [row[1] for row in cells(plot.control_matrix(slopes))]
    assert labels(ax.xaxis)[0] == "Amplitude\nper V"


def test_rows_over_an_input_are_six_panels(robot):
    table = flapwing.sweep({**robot, "axes": {"drive_offset": {"from": "-20 V", "to": "20 V", "step": "10 V"}}})
    figure = drawn(plot.force_panels(table))
    assert isinstance(figure, Figure)
    assert [ax.get_ylabel() for ax in figure.axes] == ROWS
    assert [ax.get_xlabel() for ax in figure.axes] == [""] * 3 + ["Drive offset (V)"] * 3
    drawn_pitch = lines(figure.axes[4])[0]
    assert drawn_pitch.get_xdata().tolist() == [-20.0, -10.0, 0.0, 10.0, 20.0]
    assert drawn_pitch.get_ydata().tolist() == table["torque_pitch_unm"].tolist()


def test_rows_without_measures_are_gaps():
    table = course(drive_offset=np.arange(4.0))
    table["status"][1] = "unsettled"
    figure = drawn(plot.force_panels(table))
    assert np.isnan(lines(figure.axes[0])[0].get_ydata()[1])


def test_given_axes_take_a_map():
    _, ax = plt.subplots()
    assert plot.control_matrix(EFFECTS, inputs=["a", "b"], ax=ax, colorbar=False) is ax
    assert len(ax.figure.axes) == 1


def test_mistakes_are_told_before_a_figure_is_made(slopes, robot):
    assert "six rows" in message(ValueError, plot.control_matrix, EFFECTS[:5], inputs=["a", "b"])
    assert "`inputs` has 0 names" in message(ValueError, plot.control_matrix, EFFECTS)
    told = message(ValueError, plot.control_matrix, slopes, inputs=["amplitude"])
    assert told.startswith("there is no input `amplitude`\nthere are drive_voltage_pp,")
    two = flapwing.evaluate(robot, {"drive_frequency": [110.0, 120.0]}, gradient=["drive_offset"])
    assert "2 rows with derivatives: choose one, such as table[:1]" in message(ValueError, plot.control_matrix, two)
    table = course(drive_offset=np.tile(np.arange(3.0), 2), drive_voltage_pp=np.repeat([180.0, 200.0], 3))
    with pytest.warns(UserWarning, match="drawn: drive_offset = 1 V, the middle of 3 values"):
        assert len(plot.force_panels(table).axes) == 6
    assert len(plot.force_panels(table, drive_voltage_pp=180.0).axes) == 6
    told = message(ValueError, plot.control_matrix, course(drive_offset=np.arange(3.0)))
    assert told.startswith("the table has no derivatives of force and torque\ncall evaluate with gradient=")
    single = {"drive_frequency": np.arange(3.0), "lift_mean_mn": np.arange(3.0)}
    # The names are in the order of the panels.
    assert (
        "the table has no columns force_forward_mn, force_left_mn, force_up_mn, torque_roll_unm, torque_pitch_unm, "
        "torque_yaw_unm: it has no results of a vehicle"
    ) in message(ValueError, plot.force_panels, single)
    by_power = flapwing.evaluate(robot, {"drive_offset": [0.0]}, gradient=["drive_offset"], measures=["power_mean_mw"])
    assert "of no force or torque" in message(ValueError, plot.control_matrix, by_power)
