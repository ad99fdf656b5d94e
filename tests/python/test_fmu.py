"""Functional mock-up units of linear models: FMPy validates, compiles and simulates them like the exported matrices."""

import json

import fmpy
import numpy as np
import pytest
import scipy.linalg
from fmpy.build import build_platform_binary
from fmpy.fmi3 import FMU3Slave
from fmpy.model_description import ModelDescription, read_model_description
from fmpy.validation import validate_fmu
from test_linear import GRID, SET

START = {"velocity_forward": 0.05, "rate_roll": 0.3, "rate_yaw": -2.0, "angle_pitch": 0.02}
STEP = [5.0, 2.0, -1.0, 0.5]  # V
STEP_TIME = 0.1  # s


@pytest.fixture(scope="module")
def exported(flap, tmp_path_factory):
    """The archive, and the variables of the same model in JSON."""
    folder = tmp_path_factory.mktemp("fmu")
    (folder / "robot.toml").write_text(GRID, encoding="utf-8")
    for name in ("hover.json", "hover.fmu"):
        flap("vehicle", folder / "robot.toml", *SET, "--export", folder / name)
    return folder / "hover.fmu", json.loads((folder / "hover.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def compiled(exported, tmp_path_factory):
    """The folder of the compiled model."""
    folder = tmp_path_factory.mktemp("compiled")
    fmpy.extract(str(exported[0]), unzipdir=folder)
    strict = {"CMAKE_COMPILE_WARNING_AS_ERROR:BOOL": "ON"}
    build_platform_binary(folder, tmp_path_factory.mktemp("build"), all_warnings=True, cmake_options=strict)
    return folder


@pytest.fixture
def instance(compiled):
    description = read_model_description(compiled)
    instance = FMU3Slave(
        guid=description.guid, unzipDirectory=str(compiled), modelIdentifier="hover", instanceName="robot"
    )
    instance.instantiate()
    instance.enterInitializationMode()
    instance.exitInitializationMode()
    yield instance
    instance.terminate()
    instance.freeInstance()


def references(description: ModelDescription):
    return {variable.name: variable.valueReference for variable in description.modelVariables}


def test_the_model_description_is_valid_and_has_names_units_and_values(exported):
    path, model = exported
    assert validate_fmu(str(path)) == []
    description = read_model_description(path)
    variables = {variable.name: variable for variable in description.modelVariables}
    for group, causality in (("states", "output"), ("inputs", "input")):
        found = {name: variable.unit for name, variable in variables.items() if variable.causality == causality}
        assert found == dict(zip(model[group], model[f"{group[:-1]}_units"]))
    assert [one.variable.derivative.name for one in description.derivatives] == model["states"]
    assert variables["der(rate_yaw)"].unit == "rad/s^2" and variables["der(angle_yaw)"].unit == "rad/s"
    for name, value in zip(model["inputs"], model["input_values"]):
        assert float(variables[f"input_values.{name}"].start) == value
    for name in ("drive_frequency", "total_mass", "body_inertia_yaw", "gravity"):
        assert float(variables[f"operating_point.{name}"].start) == model[name]
    units = {unit.name: unit.baseUnit for unit in description.unitDefinitions}
    volt = units["V"]
    assert (volt.kg, volt.m, volt.s, volt.A, volt.rad, volt.factor) == (1, 2, -3, -1, 0, 1)
    assert (units["rad/s^2"].rad, units["rad/s^2"].s, units["kg*m^2"].m) == (1, -2, 2)


@pytest.mark.parametrize(
    ("interface", "tolerance"),
    [("ModelExchange", 1e-7), ("CoSimulation", 1e-12)],  # of the largest value of each state
)
def test_simulations_are_the_matrix_exponential(exported, compiled, interface, tolerance):
    model = exported[1]
    states, inputs = model["states"], model["inputs"]
    # With constant inputs, (x, s)' = [A B; 0 0] (x, s).
    size = len(states) + len(inputs)
    matrix = np.zeros((size, size))
    matrix[: len(states)] = np.hstack([model["A"], model["B"]])

    def exact(time):
        both = np.array([START.get(name, 0.0) for name in states] + [0.0] * len(inputs))
        both = scipy.linalg.expm(matrix * min(time, STEP_TIME)) @ both
        if time > STEP_TIME:
            both[len(states) :] = STEP
        return (scipy.linalg.expm(matrix * max(time - STEP_TIME, 0.0)) @ both)[: len(states)]

    none = (0.0,) * len(inputs)
    signals = np.array(
        [(0.0, *none), (STEP_TIME, *none), (STEP_TIME, *STEP), (0.4, *STEP)],
        dtype=[(name, float) for name in ("time", *inputs)],
    )
    result = fmpy.simulate_fmu(
        compiled,
        fmi_type=interface,
        stop_time=0.4,
        output_interval=0.02,
        relative_tolerance=1e-10,
        start_values=START,
        input=signals,
    )
    assert len(result) > 20
    found = np.array([result[name] for name in states])
    expected = np.array([exact(time) for time in result["time"]]).T
    assert np.all(np.abs(found - expected) <= tolerance * np.abs(expected).max(axis=1, keepdims=True))


def test_directional_derivatives_are_the_matrices(exported, compiled, instance):
    model = exported[1]
    of = references(read_model_description(compiled))
    derivatives = [of[f"der({name})"] for name in model["states"]]
    instance.setFloat64([of["velocity_up"]], [3.0])
    columns = [
        instance.getDirectionalDerivative(derivatives, [of[name]], [1.0]) for name in model["states"] + model["inputs"]
    ]
    assert np.array_equal(np.array(columns).T, np.hstack([model["A"], model["B"]]))
    # The outputs are the states.
    assert instance.getDirectionalDerivative([of["rate_roll"]], [of["rate_roll"]], [2.0]) == [2.0]
    assert instance.getDirectionalDerivative([of["rate_roll"]], [of["bias"]], [2.0]) == [0.0]


def test_values_are_read_set_and_reset(exported, compiled, instance):
    model = exported[1]
    of = references(read_model_description(compiled))
    known = [of["angle_yaw"], of["bias"]]
    instance.setFloat64(known, [0.25, -3.0])
    assert instance.getFloat64([*known, of["input_values.amplitude"], of["operating_point.gravity"]]) == [
        0.25,
        -3.0,
        model["input_values"][0],
        model["gravity"],
    ]
    instance.doStep(currentCommunicationPoint=0.0, communicationStepSize=0.5)
    assert instance.getFloat64([of["time"]]) == [0.5]
    instance.reset()
    assert instance.getFloat64([of["time"], *known]) == [0.0, 0.0, 0.0]


def test_mistakes_are_errors(compiled, instance):
    of = references(read_model_description(compiled))
    for call in (
        lambda: instance.getFloat64([max(of.values()) + 1]),
        lambda: instance.setFloat64([of["time"]], [1.0]),
        lambda: instance.setFloat64([of["der(rate_yaw)"]], [1.0]),
        lambda: instance.setFloat64([of["operating_point.gravity"]], [1.0]),
        lambda: instance.getBoolean([of["bias"]]),
        lambda: instance.doStep(currentCommunicationPoint=0.0, communicationStepSize=-1.0),
    ):
        with pytest.raises(fmpy.fmi1.FMICallException):
            call()
    other = FMU3Slave(guid="other", unzipDirectory=str(compiled), modelIdentifier="hover", instanceName="other")
    with pytest.raises(Exception, match="instantiate"):
        other.instantiate()
