"""Calls that `run` refuses, and its messages."""

import inspect
import math
import re

import flapwing
import pytest

PRESET = "ozaki2018-large"
EXPERIMENTS = [flapwing.resonance, flapwing.chirp, flapwing.impulse, flapwing.lift]


def refused(error, *arguments, **keywords):
    """The message of the error that `run` raises."""
    with pytest.raises(error) as caught:
        flapwing.run(*arguments, **keywords)
    return str(caught.value)


def test_unknown_preset():
    message = refused(ValueError, "ozaki2018-larg")
    assert "did you mean `ozaki2018-large`?" in message
    for preset in flapwing.presets():
        assert preset in message


def test_nothing_is_suggested_for_what_resembles_nothing():
    assert "did you mean" not in refused(ValueError, "zzz")


def test_unknown_parameter():
    message = refused(ValueError, PRESET, drive_voltage=50)
    assert "model `direct-drive` has no parameter `drive_voltage`" in message
    assert "did you mean `drive_voltage_pp`?" in message
    assert "hinge_stiffness" in message


def test_misspelt_solver_setting():
    assert "did you mean `max_cycles`?" in refused(ValueError, PRESET, max_cycle=50)


def test_unknown_option():
    message = refused(ValueError, PRESET, lift_sign="prined")
    assert "did you mean `printed`?" in message
    assert 'options: "corrected", "printed"' in message


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ({"drive_frequency": 0}, "`drive_frequency` must be more than zero, not 0.0 Hz"),
        ({"drive_frequency": "-1 kHz"}, "`drive_frequency` must be more than zero, not -1000.0 Hz"),
        ({"drag_coefficient_max": -1}, "`drag_coefficient_max` must be zero or more, not -1.0"),
        ({"rtol": 0}, "`rtol` must be more than zero and less than 0.1, not 0.0"),
        ({"rtol": 0.5}, "`rtol` must be more than zero and less than 0.1, not 0.5"),
        ({"atol": -1e-9}, "`atol` must be more than zero, not -1e-9"),
        ({"settle_tol": 0.0}, "`settle_tol` must be more than zero, not 0.0"),
        ({"max_cycles": 0}, "`max_cycles` must be from 1 to 4294967295, not 0"),
        ({"max_steps": -1}, "`max_steps` must be from 1 to 4294967295, not -1"),
        ({"max_steps": 2**32}, "`max_steps` must be from 1 to 4294967295, not 4294967296"),
    ],
)
def test_out_of_range(arguments, says):
    assert refused(ValueError, PRESET, **arguments) == says


def test_former_names_warn_and_work():
    now = flapwing.evaluate("jafferis2016", {"drag_coefficient_max": [3.0]})
    with pytest.warns(FutureWarning, match="`drag_max` is called `drag_coefficient_max` now"):
        former = flapwing.evaluate("jafferis2016", {"drag_max": [3.0]})
    assert former["lift_mean_mn"] == now["lift_mean_mn"]
    with pytest.warns(FutureWarning, match="`drag_min` is called"):
        flapwing.Grid({"preset": "jafferis2016", "params": {"drag_min": 0.2}})


@pytest.mark.parametrize("name", ["drive_bias", "drive_frequency", "rtol", "atol", "settle_tol"])
@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 10**400])
def test_not_finite(name, value):
    message = refused(ValueError, PRESET, **{name: value})
    assert "values are finite" in message or "too large" in message


@pytest.mark.parametrize(
    ("value", "says"),
    [
        ("100", "needs a unit"),
        ("100 V", "`V` is a voltage, but `drive_frequency` is in Hz"),
        ("100 hz", "did you mean `Hz`?"),
        ("nan Hz", "values are finite"),
        ("fast", "must start with a number"),
        ("", "must start with a number"),
    ],
)
def test_text_that_is_no_quantity(value, says):
    assert says in refused(ValueError, PRESET, drive_frequency=value)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ({"drive_frequency": None}, "`drive_frequency` must be a number in Hz or text with a unit, not NoneType"),
        ({"drive_frequency": [100.0]}, "`drive_frequency` must be a number in Hz or text with a unit, not list"),
        ({"drive_frequency": True}, "`drive_frequency` must be a number in Hz or text with a unit, not bool"),
        ({"drive_frequency": 1j}, "`drive_frequency` must be a number in Hz or text with a unit, not complex"),
        ({"drag_coefficient_max": b"5"}, "`drag_coefficient_max` must be a number, not bytes"),
        ({"lift_sign": 1}, '`lift_sign` must be one of "corrected", "printed", not int'),
        ({"rtol": "1e-6"}, "`rtol` must be a number, not str"),
        ({"atol": True}, "`atol` must be a number, not bool"),
        ({"max_cycles": 10.0}, "`max_cycles` must be a whole number, not float"),
        ({"max_cycles": "10"}, "`max_cycles` must be a whole number, not str"),
        ({"max_steps": True}, "`max_steps` must be a whole number, not bool"),
    ],
)
def test_wrong_type(arguments, says):
    assert refused(TypeError, PRESET, **arguments) == says


def test_preset_of_the_wrong_type():
    assert refused(TypeError, 3).splitlines() == [
        "a design is not int",
        "it is the name of a preset, a path, the text of a grid file, a dictionary or a Grid",
    ]


def test_preset_is_required_and_positional():
    assert "design" in refused(TypeError)
    assert "design" in refused(TypeError, preset=PRESET)


def test_errors_of_a_value_itself_pass_through():
    class Broken:
        def __float__(self):
            raise RuntimeError("broken")

    assert refused(RuntimeError, PRESET, drive_frequency=Broken()) == "broken"


@pytest.mark.parametrize("preset", flapwing.presets())
def test_no_parameter_is_hidden_by_a_solver_setting(preset):
    message = refused(ValueError, preset, zzz=1)
    parameters = re.search(r"\(parameters: (.*);", message).group(1).split(", ")
    settings = re.search(r"; solver settings: (.*)\)", message).group(1).split(", ")
    kinds = {name: parameter.kind for name, parameter in inspect.signature(flapwing.run).parameters.items()}
    keywords = [name for name, kind in kinds.items() if kind is inspect.Parameter.KEYWORD_ONLY]
    assert keywords == ["point", "begin", "waveform", "stroke", "progress", "client", *settings]
    for function in [flapwing.run, flapwing.sweep, flapwing.evaluate, flapwing.respond, flapwing.trajectory, *EXPERIMENTS]:
        kinds = {name: parameter.kind for name, parameter in inspect.signature(function).parameters.items()}
        keywords = [name for name, kind in kinds.items() if kind is inspect.Parameter.KEYWORD_ONLY]
        assert not set(parameters) & set(keywords), function
