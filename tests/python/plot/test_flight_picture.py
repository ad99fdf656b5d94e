"""Pictures and animations of flights."""

import flapwing
import matplotlib.pyplot as plt
import numpy as np
import pytest
from figures import drawn, legend, message
from flapwing import plot
from numpy.testing import assert_allclose, assert_array_equal
from PIL import Image

PLACE = ["1 mm", "2 mm", "3 mm"]
WINGS = [flapwing.Wing("left", position=PLACE), flapwing.Wing("right", position=PLACE, mirrored=True)]
ROBOT = flapwing.Vehicle("jafferis2016", WINGS, about=["1 mm", "0 mm", "0 mm"], total_mass="69 mg")
DRIVE = {"drive_voltage_pp": "140 V", "drive_frequency": "120 Hz"}
POINT = {**DRIVE, "body_inertia_roll": 1.5e-9, "body_inertia_pitch": 1.5e-9, "body_inertia_yaw": 0.5e-9}
START = {"velocity_forward": "10 cm/s", "rate_pitch": 2.0, "angle_roll": "2 deg"}
#: Panels by their label, with their columns in the displayed unit.
PANELS = {
    "Velocity (m/s)": (1.0, ["velocity_forward_m_s", "velocity_left_m_s", "velocity_up_m_s"]),
    "Rate (rad/s)": (1.0, ["rate_roll_rad_s", "rate_pitch_rad_s", "rate_yaw_rad_s"]),
    "Position (mm)": (1e3, ["position_forward_m", "position_left_m", "position_up_m"]),
    "Angle (°)": (180.0 / np.pi, ["angle_roll_rad", "angle_pitch_rad", "angle_yaw_rad"]),
}


def fly(**options):
    gains = np.zeros((2, 9))
    gains[0, 2], gains[1, 0] = 20.0, 5.0
    chosen = {"gains": gains, "inputs": ["amplitude", "bias"], "disturbance": START, "seconds": 0.1, **options}
    return flapwing.fly(ROBOT, **chosen, **POINT)


@pytest.fixture(scope="module")
def coupled():
    return fly()


@pytest.fixture(scope="module")
def averaged():
    return fly(averaged=True)


@pytest.fixture(scope="module")
def wing():
    return flapwing.trajectory("jafferis2016", **DRIVE)


def curves(ax):
    return [line for line in ax.lines if not line.get_label().startswith("_")]


def test_each_group_has_a_panel_with_its_columns(coupled):
    figure = drawn(plot.flight(coupled))
    *states, inputs = figure.axes
    assert {ax.get_ylabel() for ax in states} == set(PANELS)
    for ax in states:
        factor, names = PANELS[ax.get_ylabel()]
        assert len(curves(ax)) == 3
        for line, name in zip(curves(ax), names):
            assert_array_equal(line.get_xdata(), coupled["time_s"])
            assert_allclose(line.get_ydata(), factor * coupled[name], rtol=1e-14)
    assert [ax.get_xlabel() for ax in figure.axes] == ["", "", "Time (s)", "Time (s)", "Time (s)"]
    assert inputs.get_ylabel() == "Change of inputs (V)" and coupled.units["amplitude"] == "V"
    for line, name, start in zip(curves(inputs), ("amplitude", "bias"), (140.0, 0.0)):
        assert_allclose(line.get_ydata(), coupled[name] - start, atol=1e-12)
        assert np.ptp(line.get_ydata()) > 0.1 and line.get_drawstyle() == "steps-mid"


def test_circles_are_the_disturbance(coupled):
    assert coupled.meta["disturbance"] == START
    circles = {}
    for ax in plot.flight(coupled).axes:
        for line in ax.lines:
            if line.get_label() == "_disturbance":
                circles.setdefault(ax.get_ylabel(), []).append((line.get_color(), *line.get_xydata()[0]))
    colours = plot._style.COLOURS
    assert circles == {
        "Velocity (m/s)": [(colours[0], 0.0, 0.1)],
        "Rate (rad/s)": [(colours[1], 0.0, 2.0)],
        "Angle (°)": [(colours[0], 0.0, pytest.approx(2.0))],
    }


def test_flights_share_panels_with_their_own_line_styles(coupled, averaged):
    for figure in (
        plot.flight({"coupled": coupled, "averaged": averaged}),
        plot.flight([coupled, averaged], label=["coupled", "averaged"]),
    ):
        velocity = drawn(figure).axes[0]
        assert legend(velocity) == ["forward", "left", "up", "coupled", "averaged"]
        assert [line.get_linestyle() for line in curves(velocity)] == ["-", "--"] * 3
        for line, flight in zip(curves(velocity), (coupled, averaged)):
            assert_array_equal(line.get_ydata(), flight["velocity_forward_m_s"])
        assert legend(figure.axes[1]) == ["roll", "pitch", "yaw"]


def test_groups_and_given_axes(coupled):
    figure = drawn(plot.flight(coupled, ["torque", "force"]))
    assert [ax.get_ylabel() for ax in figure.axes] == ["Torque (µN·m)", "Force (mN)"]
    assert_array_equal(curves(figure.axes[0])[1].get_ydata(), coupled["torque_pitch_unm"])
    _, ax = plt.subplots()
    assert plot.flight(coupled, "angle", ax=ax) is ax
    assert ax.get_xlabel() == "Time (s)" and len(curves(ax)) == 3
    assert "there are 5\nname one group" in message(ValueError, plot.flight, coupled, ax=ax)


def test_samples_of_inputs_begin_with_their_beat():
    flight = fly(samples=4)
    inputs = plot.flight(flight, "inputs").axes[0]
    assert curves(inputs)[0].get_drawstyle() == "steps-post"


def test_the_output_of_the_command_is_a_flight(coupled, tmp_path):
    path = tmp_path / "flight.csv"
    coupled.to_pandas().to_csv(path, index=False)
    figure = plot.flight(path)
    assert_allclose(curves(figure.axes[0])[0].get_ydata(), coupled["velocity_forward_m_s"], rtol=1e-12)


def test_mistakes_of_flights(coupled, motion):
    assert "must be a flight, such as from flapwing.fly" in message(ValueError, plot.flight, motion)
    assert "did you mean `velocity`?" in message(ValueError, plot.flight, coupled, "velocty")
    assert "`groups` is empty" in message(ValueError, plot.flight, coupled, [])
    assert "has 5 flights" in message(ValueError, plot.flight, [coupled] * 5)
    assert "`table` is one flight\nomit `label`" in message(ValueError, plot.flight, coupled, label=["a"])
    free = coupled[[name for name in coupled if name not in ("amplitude", "bias")]]
    assert "the flights have no inputs" in message(ValueError, plot.flight, free, "inputs")
    assert len(plot.flight(free).axes) == 4


def rotation(roll, pitch, yaw):
    x = [[1, 0, 0], [0, np.cos(roll), -np.sin(roll)], [0, np.sin(roll), np.cos(roll)]]
    y = [[np.cos(pitch), 0, np.sin(pitch)], [0, 1, 0], [-np.sin(pitch), 0, np.cos(pitch)]]
    z = [[np.cos(yaw), -np.sin(yaw), 0], [np.sin(yaw), np.cos(yaw), 0], [0, 0, 1]]
    return np.array(z) @ np.array(y) @ np.array(x)


def turned(coupled, **angles):
    """A flight with constant angles (rad)."""
    columns = {name: np.array(coupled[name]) for name in coupled}
    for name, angle in angles.items():
        columns[f"angle_{name}_rad"][:] = angle
    return columns


def test_a_film_shows_the_vehicle_where_it_is(coupled, wing):
    angles = {"roll": 0.3, "pitch": -0.2, "yaw": 1.0}
    flight = turned(coupled, **angles)
    animation = plot.flight_film(flight, wing, vehicle=ROBOT, views=["side", "top", "front"], frames=12, scale=1)
    scene = animation._scene
    assert_allclose(scene.times[[0, -1]], coupled["time_s"][[0, -1]])
    place = np.array([coupled[f"position_{name}_m"] for name in ("forward", "left", "up")])
    assert_allclose(scene.path[[0, -1]], 1e3 * place.T[[0, -1]])
    for frame in (0, 7, 11):
        # The axes of the body, computed with other matrices.
        back = (scene.wings[frame] - scene.path[frame]) @ rotation(*angles.values())
        assert_allclose(back[:, 0], [[0.0, 2.0, 3.0], [0.0, -2.0, 3.0]], atol=1e-12)
        # Wings of 17 mm are mirror images of each other.
        leading = back[:, 1] - back[:, 0]
        assert_allclose(np.linalg.norm(leading, axis=1), 17.0)
        assert_allclose(back[1], back[0] * [1.0, -1.0, 1.0], atol=1e-12)
        phase = (scene.times[frame] - scene.times[0]) * 120.0 / scene.slower
        cycle = wing[:201]
        stroke = np.interp(phase % 1.0, np.linspace(0.0, 1.0, 201), cycle["stroke_deg"])
        assert np.degrees(np.arctan2(leading[0, 0], leading[0, 1])) == pytest.approx(stroke, abs=3.0)
        scene.draw(frame)
        side = scene.views[0]
        assert_allclose(side.body.get_xydata(), scene.body[frame][:, [0, 2]])
        assert_allclose(side.centre.get_xydata()[0], scene.path[frame][[0, 2]])
        assert_allclose(scene.views[1].path.get_xydata(), scene.path[: frame + 1, :2])
        assert_allclose(side.wings.get_paths()[1].vertices[:4], scene.wings[frame][1][:, [0, 2]])
    animation._draw_was_started = True


def test_a_film_tells_the_time_and_how_slow_the_wings_are(coupled, wing):
    animation = plot.flight_film(coupled, wing, frames=12, scale=2.0)
    scene = animation._scene
    # 11 of 12 beats pass in 11 steps: one frame for each beat, instead of at least ten.
    assert scene.slower == pytest.approx(10.0, rel=1e-6)
    assert scene._caption(11) == f"{coupled['time_s'][-1]:.3f} s, wing beats 10 times slower, vehicle 2 times larger"
    quick = plot.flight_film(coupled, wing, frames=200)
    assert quick._scene.slower == 1.0 and quick._scene._caption(0) == f"{coupled['time_s'][0]:.3f} s"
    animation._draw_was_started = quick._draw_was_started = True


def test_a_vehicle_that_flies_far_is_drawn_larger(coupled, wing):
    far = turned(coupled)
    far["position_forward_m"] = np.linspace(0.0, 2.0, len(coupled))
    animation = plot.flight_film(far, wing, vehicle=ROBOT, frames=3)
    size = 2.0 * np.linalg.norm(animation._scene.wings[0] - animation._scene.path[0], axis=-1).max()
    assert size == pytest.approx(0.15 * 2000.0, rel=0.05)
    animation._draw_was_started = True


def test_wings_move_differently(coupled, wing):
    still = {**{name: wing[name] for name in wing}, "stroke_deg": 0.5 * wing["stroke_deg"]}
    animation = plot.flight_film(coupled, {"left": wing, "right": still}, frames=20, scale=1)
    spans = animation._scene.wings[:, :, 1] - animation._scene.wings[:, :, 0]
    swept = np.ptp(np.degrees(np.arctan2(spans[..., 0], np.abs(spans[..., 1]))), axis=0)
    assert swept[1] == pytest.approx(0.5 * swept[0], abs=5.0)
    animation._draw_was_started = True


def test_a_film_is_saved_as_gif(coupled, wing, tmp_path):
    path = tmp_path / "flight.gif"
    plot.flight_film(coupled, wing, frames=5).save(path, dpi=40)
    with Image.open(path) as image:
        assert image.format == "GIF" and image.n_frames == 5


def test_mistakes_of_films(coupled, wing):
    film = plot.flight_film
    columns = {name: coupled[name] for name in coupled}
    assert "the flight has no vehicle\ngive the vehicle" in message(ValueError, film, columns, wing)
    assert "`vehicle` has one wing" in message(ValueError, film, columns, wing, vehicle="jafferis2016")
    assert "must be a flight" in message(ValueError, film, wing, wing)
    assert "has 1 rows" in message(ValueError, film, coupled[:1], wing)
    assert "two frames" in message(ValueError, film, coupled, wing, frames=1)
    assert "`scale` must be more than 0" in message(ValueError, film, coupled, wing, scale=0.0)
    assert "did you mean `front`?" in message(ValueError, film, coupled, wing, views=["frnt"])
    assert "`views` is empty" in message(ValueError, film, coupled, wing, views=[])
    assert "did you mean `left`?" in message(ValueError, film, coupled, {"lft": wing, "right": wing})
    assert "no trajectory of the wing `right`" in message(ValueError, film, coupled, {"left": wing})
