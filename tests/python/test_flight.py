"""Flights of a vehicle over time, free and with a linear-quadratic regulator."""

import re

import control
import flapwing
import numpy as np
import pytest

PLACE = ["0 mm", "2 mm", "0 mm"]
WINGS = [flapwing.Wing("left", position=PLACE), flapwing.Wing("right", position=PLACE, mirrored=True)]
#: The case t1_140 of tests/data/body. Its weight is the lift.
ROBOT = flapwing.Vehicle("jafferis2016", WINGS, about=["0 mm", "0 mm", "-3 mm"], total_mass=6.915643907926958e-5)
INERTIA = {"body_inertia_roll": 1.5e-9, "body_inertia_pitch": 1.5e-9, "body_inertia_yaw": 0.5e-9}
POINT = {"drive_voltage_pp": "140 V", "drive_frequency": "120 Hz", **INERTIA}
STATES = ["velocity_forward_m_s", "velocity_left_m_s", "velocity_up_m_s"]
STATES += ["rate_roll_rad_s", "rate_pitch_rad_s", "rate_yaw_rad_s"]
STATES += ["angle_roll_rad", "angle_pitch_rad", "angle_yaw_rad"]
SIZES = np.array([0.1, 0.1, 0.1, 5.0, 5.0, 5.0, 0.1, 0.1, 0.5])
DISTURBANCE = {"velocity_forward": "0.1 m/s", "velocity_left": 0.1, "rate_roll": 2.0, "rate_pitch": "2 rad/s"}


@pytest.fixture(scope="module")
def regulator():
    model = ROBOT.linear(**POINT)
    gains, _, _ = control.lqr(model.A, model.B, np.diag(SIZES**-2.0), np.diag(np.power([10.0, 2.0, 10.0, 10.0], -2.0)))
    assert model.inputs == ["amplitude", "amplitude_difference", "bias", "bias_difference"]
    return {"gains": gains, "inputs": model.inputs}


def states(flight):
    return np.column_stack([flight[name] for name in STATES])


def test_a_regulator_holds_hover_and_without_it_the_vehicle_tumbles(regulator):
    held = flapwing.fly(ROBOT, seconds=2, disturbance=DISTURBANCE, **regulator, **POINT)
    assert len(held) == 240
    assert np.all(np.abs(states(held)[60:]) < 0.1 * SIZES)
    assert np.all(np.abs(states(held)[-1]) < 0.07 * SIZES)
    # The first beat has the inputs of the point. The regulator sets the inputs of all later beats.
    inputs = np.column_stack([held[name] for name in regulator["inputs"]])
    changes = inputs - inputs[0]
    np.testing.assert_allclose(inputs[0], [140.0, 0.0, 0.0, 0.0])
    np.testing.assert_allclose(changes[1:], -(states(held)[:-1] @ regulator["gains"].T), atol=1e-9)
    assert np.abs(changes).max() < 20.0
    free = flapwing.fly(ROBOT, seconds=1, disturbance=DISTURBANCE, **POINT)
    last_held, last_free = (np.abs(states(flight)[-24:]).max(axis=0) for flight in (held, free))
    assert np.all(last_free[[0, 1, 3, 4, 6, 7]] > 100 * last_held[[0, 1, 3, 4, 6, 7]])
    assert np.abs(states(free)[:, 6:8]).max() > 0.5


def test_the_linear_model_agrees_while_a_regulator_holds_hover(regulator):
    flights = [
        flapwing.fly(ROBOT, seconds=1, disturbance=DISTURBANCE, averaged=averaged, **regulator, **POINT)
        for averaged in (False, True)
    ]
    coupled, averaged = (states(flight) for flight in flights)
    np.testing.assert_allclose(flights[0]["time_s"], flights[1]["time_s"])
    assert np.all(np.abs(coupled - averaged) < 0.1 * SIZES)
    model = ROBOT.linear(**POINT, positions=True)
    start = np.zeros(12)
    start[:5] = [0.1, 0.1, 0.0, 2.0, 2.0]
    # Means over the first beat, before the regulator acts: from the exact solution at many instants.
    times = np.linspace(0.0, 1 / 120, 2001)
    exact = control.forced_response(model.statespace(), T=times, X0=start).outputs
    np.testing.assert_allclose(averaged[0], np.trapezoid(exact, times)[:9] * 120, atol=1e-6)


def test_samples_show_the_vibration_within_a_beat():
    flight = flapwing.fly(ROBOT, seconds="25 ms", samples=40, **POINT)
    assert len(flight) == 120
    np.testing.assert_allclose(flight["time_s"], np.arange(120) / 4800, atol=1e-12)
    means = flapwing.fly(ROBOT, seconds="25 ms", **POINT)
    beats = flight["force_up_mn"].reshape(3, 40).mean(axis=1)
    np.testing.assert_allclose(beats, means["force_up_mn"], rtol=2e-3)
    assert np.ptp(flight["velocity_forward_m_s"]) > 0.01
    assert np.all(np.abs(means["velocity_forward_m_s"]) < 1e-3)


def test_equal_calls_have_equal_bits():
    one, other = (flapwing.fly(ROBOT, seconds=0.05, disturbance={"angle_roll": "2 deg"}, **POINT) for _ in range(2))
    assert all(np.array_equal(one[name], other[name]) for name in one.columns)


def test_inputs_have_units():
    flight = flapwing.fly(ROBOT, seconds=0.02, inputs=["amplitude", "drag_coefficient_max"], **POINT)
    assert (flight.units["amplitude"], flight.docs["amplitude"]) == ("V", "drive_voltage_pp")
    assert (flight.units["drag_coefficient_max"], flight.docs["drag_coefficient_max"]) == ("", "drag_coefficient_max")
    assert flight.units["force_up_mn"] == "mN"


def test_mistakes(regulator):
    with pytest.raises(ValueError, match="did you mean `rate_pitch`"):
        flapwing.fly(ROBOT, seconds=1, disturbance={"rate_pich": 1.0}, **POINT)
    with pytest.raises(ValueError, match="`gains` require `inputs`"):
        flapwing.fly(ROBOT, seconds=1, gains=regulator["gains"], **POINT)
    with pytest.raises(ValueError, match="4 rows and 8 columns, but must be 4 x 9"):
        flapwing.fly(ROBOT, seconds=1, gains=regulator["gains"][:, :8], inputs=regulator["inputs"], **POINT)
    with pytest.raises(ValueError, match="has 1 dimensions"):
        flapwing.fly(ROBOT, seconds=1, gains=[1.0], inputs=["bias"], **POINT)
    for call in (lambda: flapwing.fly(ROBOT, seconds=1, inputs=3, **POINT), lambda: ROBOT.linear(inputs=3, **POINT)):
        with pytest.raises(TypeError, match="`inputs` is int\nit must be a list of names"):
            call()
    with pytest.raises(TypeError, match="`gains` is list"):
        flapwing.fly(ROBOT, seconds=1, gains=[["much"]], inputs=["bias"], **POINT)
    with pytest.raises(TypeError, match="it must be a dictionary"):
        flapwing.fly(ROBOT, seconds=1, disturbance=1.0, **POINT)
    with pytest.raises(TypeError, match="`gains` has complex numbers\nit must be a matrix of numbers"):
        flapwing.fly(ROBOT, seconds=1, gains=1j * regulator["gains"], inputs=regulator["inputs"], **POINT)
    with pytest.raises(ValueError, match="a flight of 0.1 s has 48000000000 samples, and at most 5e6 are allowed"):
        flapwing.fly(ROBOT, seconds=0.1, samples=4_000_000_000, **POINT)
    with pytest.raises(ValueError, match="a flight of -1 s is impossible"):
        flapwing.fly(ROBOT, seconds=-1, **POINT)
    with pytest.raises(ValueError, match="body_inertia_roll"):
        flapwing.fly(ROBOT, seconds=1, drive_voltage_pp="140 V")
    with pytest.raises(ValueError, match="the design describes one wing, not a vehicle\nadd"):
        flapwing.fly("jafferis2016", seconds=1)
    gains = np.zeros((1, 9))
    gains[0, 0] = 1e6
    with pytest.warns(UserWarning, match="drive_voltage_pp is -"):
        short = flapwing.fly(
            ROBOT, seconds=1, disturbance={"velocity_forward": 0.1}, gains=gains, inputs=["amplitude"], **POINT
        )
    assert len(short) == 1


def test_derived_parameters_are_no_inputs():
    """As for the command, the formula of a derived parameter would be ignored."""
    derived = {"preset": "jafferis2016", "derived": {"drive_offset": "drive_voltage_pp / 20"}}
    robot = flapwing.Vehicle(derived, WINGS, about=["0 mm", "0 mm", "-3 mm"], total_mass="69 mg")
    for call in (
        lambda: flapwing.fly(robot, seconds=0.05, inputs=["bias"], **POINT),
        lambda: robot.linear(inputs=["bias"], **POINT),
        lambda: robot.linear(**POINT),
    ):
        with pytest.raises(ValueError, match="`bias` is derived from other parameters\nchoose the parameters"):
            call()
    warning = "derived parameters .* are held constant while inputs change"
    with pytest.warns(UserWarning, match=warning):
        flapwing.fly(robot, seconds=0.05, inputs=["amplitude"], **POINT)
    assert re.match(warning, robot.linear(inputs=["amplitude"], **POINT).warnings[0])


def test_the_command_prints_the_same_flight(flap, tmp_path):
    grid = tmp_path / "robot.toml"
    grid.write_text(
        """
preset = "jafferis2016"
[vehicle]
about = [0, 0, "-3 mm"]
total_mass = 6.915643907926958e-5
body_inertia_roll = 1.5e-9
body_inertia_pitch = 1.5e-9
body_inertia_yaw = 0.5e-9
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
""",
        encoding="utf-8",
    )
    options = ["--inputs", "bias", "--fly", "50ms", "--disturb", "velocity_forward=0.1m/s", "--format", "csv"]
    lines = flap("vehicle", grid, *options).stdout.splitlines()
    flight = flapwing.fly(grid, seconds=0.05, disturbance={"velocity_forward": 0.1}, inputs=["bias"])
    assert lines[0].split(",") == list(flight.columns)
    printed = np.array([[float(cell) for cell in line.split(",")] for line in lines[1:]])
    assert np.array_equal(printed, np.column_stack([flight[name] for name in flight.columns]))
