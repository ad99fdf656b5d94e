"""Calls that `run` refuses, and its messages."""

import inspect
import math
import re
import subprocess
import sys
import textwrap

import flapwing
import numpy as np
import pytest

PRESET = "ozaki2018-large"
EXPERIMENTS = [flapwing.resonance, flapwing.chirp, flapwing.impulse, flapwing.forces_along]


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


@pytest.mark.parametrize(
    ("call", "wrong", "meant"),
    [
        (lambda **wrong: flapwing.sweep(PRESET, **wrong), "progres", "progress"),
        (lambda **wrong: flapwing.sweep(PRESET, **wrong), "outt", "out"),
        (lambda **wrong: flapwing.trajectory(PRESET, **wrong), "cycle", "cycles"),
        (lambda **wrong: flapwing.respond(PRESET, **wrong), "steps", "step"),
        (lambda **wrong: flapwing.evaluate(PRESET, {"drive_frequency": [100.0]}, **wrong), "thread", "threads"),
    ],
)
def test_misspelt_argument(call, wrong, meant):
    with pytest.raises(ValueError, match=f"no parameter `{wrong}`, did you mean `{meant}`\\?"):
        call(**{wrong: 1})


def test_the_drive_is_at_resonance_only_in_grids():
    message = refused(ValueError, PRESET, drive_frequency="resonance")
    assert message.startswith("`drive_frequency` must be a number in Hz or text with a unit here\nonly a grid")
    assert '"params": {"drive_frequency": "resonance"}' in message


def test_flags_of_numpy_are_no_numbers():
    for name, wanted in (("drive_frequency", "a number in Hz or text with a unit"), ("max_cycles", "a whole number")):
        assert f"`{name}` must be {wanted}, not bool" in refused(TypeError, PRESET, **{name: np.bool_(True)})
    assert flapwing.run(PRESET, newton=np.bool_(False)) == flapwing.run(PRESET, newton=False)
    assert flapwing.run(PRESET, newton=np.bool_(False)) != flapwing.run(PRESET, newton=np.bool_(True))


def test_names_of_models_are_listed_and_suggested():
    for call in (flapwing.params, flapwing.measures, flapwing.states):
        with pytest.raises(ValueError, match=r"no preset or model `bimorh`, did you mean `bimorph`\?") as caught:
            call("bimorh")
        assert "models: bimorph, direct-drive, four-bar" in str(caught.value)
        assert "ozaki2018-large" in str(caught.value)


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


@pytest.mark.parametrize("name", ["drive_bias", "drive_frequency", "rtol", "atol", "settle_tol"])
@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 10**400])
def test_not_finite(name, value):
    message = refused(ValueError, PRESET, **{name: value})
    assert "values must be finite" in message or "too large" in message


@pytest.mark.parametrize(
    ("value", "says"),
    [
        ("100", "needs a unit"),
        ("100 V", "`V` is a voltage, but `drive_frequency` is in Hz"),
        ("100 hz", "did you mean `Hz`?"),
        ("nan Hz", "values must be finite"),
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
        "a design cannot be int",
        "it must be the name of a preset, a path, the text of a grid file, a dictionary or a Grid",
    ]


def test_preset_is_required_and_positional():
    assert "design" in refused(TypeError)
    assert "design" in refused(TypeError, preset=PRESET)


class Failing:
    """A value whose own code raises an error, wherever it is asked."""

    def __init__(self, name, error):
        def fail(*_):
            raise error

        is_method = name.startswith("__") and name != "__array_struct__" or name in ("tolist", "to_dict")
        self.__class__ = type("Failing", (Failing,), {name: fail if is_method else property(fail)})


def test_errors_of_a_value_itself_name_the_value():
    with pytest.raises(TypeError) as caught:
        flapwing.run(PRESET, drive_frequency=Failing("__float__", RuntimeError("broken")))
    assert str(caught.value).splitlines() == [
        "`drive_frequency` is Failing, which raised RuntimeError: broken",
        "it must be a number in Hz or text with a unit",
    ]
    assert isinstance(caught.value.__cause__, RuntimeError)


FAILING = [RuntimeError("broken"), MemoryError(), SystemError("inside"), RecursionError("deep"), KeyError("key")]


@pytest.mark.parametrize("error", FAILING, ids=lambda error: type(error).__name__)
@pytest.mark.parametrize(
    "method", ["__float__", "__array_struct__", "__array__", "__len__", "__iter__", "tolist", "columns", "to_dict"]
)
def test_objects_that_fail_are_errors_of_two_lines(method, error):
    failing = Failing(method, error)
    grid = {"preset": PRESET, "axes": {"drive_frequency": failing}}
    for call in (
        lambda: flapwing.run(PRESET, drive_frequency=failing),
        lambda: flapwing.run(PRESET, max_cycles=failing),
        lambda: flapwing.run(PRESET, initial_state={"pitch": failing}),
        lambda: flapwing.run(PRESET, initial_state=failing),
        lambda: flapwing.run(PRESET, waveform=failing),
        lambda: flapwing.run(PRESET, stroke=(failing, [1.0, 2.0])),
        lambda: flapwing.evaluate(PRESET, {"drive_frequency": failing}),
        lambda: flapwing.evaluate(PRESET, {"drive_frequency": [failing]}),
        lambda: flapwing.evaluate(PRESET, failing),
        lambda: flapwing.evaluate(PRESET, {"drive_frequency": [100.0]}, measures=failing),
        lambda: flapwing.evaluate(PRESET, {"drive_frequency": [100.0]}, initial_state={"pitch": failing}),
        lambda: flapwing.Grid(grid),
        lambda: flapwing.Grid(failing),
        lambda: flapwing.resonance(PRESET, start=failing),
        lambda: flapwing.live(PRESET, port=failing),
        lambda: flapwing.Grid(PRESET)[failing],
    ):
        with pytest.raises((TypeError, ValueError)) as caught:
            call()
        lines = str(caught.value).splitlines()
        # If the method is not called, the value has the wrong type.
        assert len(lines) == 2 or " must be " in lines[0], lines


@pytest.mark.parametrize("stop", [KeyboardInterrupt, SystemExit, GeneratorExit])
def test_stops_inside_of_a_value_pass_through(stop):
    for call in (
        lambda: flapwing.run(PRESET, drive_frequency=Failing("__float__", stop())),
        lambda: flapwing.evaluate(PRESET, {"drive_frequency": Failing("__array__", stop())}),
        lambda: flapwing.Grid({"preset": PRESET, "axes": {"drive_frequency": Failing("tolist", stop())}}),
    ):
        with pytest.raises(stop):
            call()


@pytest.mark.parametrize(
    "call",
    [
        lambda huge: flapwing.run(PRESET, drive_frequency=huge),
        lambda huge: flapwing.run(PRESET, initial_state={"pitch": huge}),
        lambda huge: flapwing.Grid({"preset": PRESET, "params": {"drive_frequency": huge}}),
        lambda huge: flapwing.evaluate(PRESET, {"drive_frequency": huge}),
        lambda huge: flapwing.evaluate(PRESET, {"drive_frequency": [100.0, huge]}),
        lambda huge: flapwing.run(PRESET, waveform=([0, 1, 2, huge], [0, 1, 0, -1])),
        lambda huge: flapwing.impulse(PRESET, amplitude=huge),
        lambda huge: flapwing.fit(
            PRESET, {"drive_frequency": [100, huge], "stroke_pp_deg": [50, 60]}, ["hinge_stiffness"]
        ),
        lambda huge: flapwing.fit(
            PRESET, {"drive_frequency": [100, 110], "stroke_pp_deg": [50, 60]}, ["hinge_stiffness"], sigma=huge
        ),
    ],
)
def test_whole_numbers_beyond_floats_are_too_large(call):
    with pytest.raises(ValueError, match="too large for a 64-bit float\n"):
        call(10**400)


def test_an_index_beyond_all_points_is_an_index_error():
    grid = flapwing.Grid(PRESET)
    for index in (10**30, -(10**30), 1):
        with pytest.raises(IndexError, match="there is no point"):
            grid[index]
        with pytest.raises(IndexError, match="there is no point"):
            flapwing.run(grid, point=index)


#: Grids of which one part contains itself, or is nested too deep, each as a program that calls `f`.
DEEP = {
    "a dictionary in itself": "d = {'preset': P}; d['params'] = d; f(d)",
    "a dictionary in a table": "d = {}; d['a'] = d; f({'preset': P, 'params': {'x': d}})",
    "a list in itself": "l = [1.0]; l.append(l); f({'preset': P, 'axes': {'drive_frequency': l}})",
    "a list of itself": "l = []; l.append(l); f({'preset': P, 'axes': l})",
    "a tuple of lists": "l = []; l.append((l,)); f({'preset': P, 'axes': {'drive_frequency': l}})",
    "a sample": "d = {'method': 'random'}; d['parameters'] = {'wing_area': d}; f({'preset': P, 'sample': d})",
    "10,000 dictionaries": "d = {}\nfor _ in range(10_000): d = {'a': d}\nf({'preset': P, 'params': d})",
    "10,000 lists": "l = [1.0]\nfor _ in range(10_000): l = [l]\nf({'preset': P, 'axes': {'drive_frequency': l}})",
}


@pytest.mark.parametrize("name", DEEP)
def test_what_contains_itself_is_a_grid_error(name):
    # In a process of its own, in a thread with a small stack.
    program = f"""
import threading, flapwing
P = "jafferis2016"
def told(f):
    try:
{textwrap.indent(DEEP[name], " " * 8)}
    except flapwing.GridError as error:
        lines = str(error).splitlines()
        assert len(lines) == 2 and "more than 64 levels" in lines[0], error
        assert error.diagnostics == [] and len(str(error)) < 400
        return
    raise AssertionError("no error")
def all():
    for f in (flapwing.Grid, flapwing.sweep, flapwing.run, flapwing.params, lambda d: flapwing.evaluate(d, {{"air_density": [1.0]}})):
        told(f)
    told(lambda d: flapwing.Vehicle(d, [flapwing.Wing("left")]))
    print("done")
all()
threading.stack_size(256 * 1024)
thread = threading.Thread(target=all)
thread.start()
thread.join()
"""
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stdout) == (0, "done\ndone\n"), ended.stderr


def test_sixty_levels_are_read():
    nested = [100.0]
    for _ in range(50):
        nested = [nested]
    with pytest.raises(flapwing.GridError) as caught:
        flapwing.Grid({"preset": PRESET, "axes": {"drive_frequency": nested}})
    # A mistake in the grid as any other, with its line.
    assert caught.value.diagnostics[0].line == 4


@pytest.mark.parametrize("preset", flapwing.presets())
def test_no_parameter_is_hidden_by_a_solver_setting(preset):
    message = refused(ValueError, preset, zzz=1)
    parameters = re.search(r"\(parameters: (.*);", message).group(1).split(", ")
    settings = re.search(r"; solver settings: (.*)\)", message).group(1).split(", ")
    kinds = {name: parameter.kind for name, parameter in inspect.signature(flapwing.run).parameters.items()}
    keywords = [name for name, kind in kinds.items() if kind is inspect.Parameter.KEYWORD_ONLY]
    assert keywords == ["point", "initial_state", "waveform", "stroke", "progress", "client", *settings]
    for function in [
        flapwing.run,
        flapwing.sweep,
        flapwing.evaluate,
        flapwing.respond,
        flapwing.edges,
        flapwing.trajectory,
        *EXPERIMENTS,
    ]:
        kinds = {name: parameter.kind for name, parameter in inspect.signature(function).parameters.items()}
        keywords = [name for name, kind in kinds.items() if kind is inspect.Parameter.KEYWORD_ONLY]
        assert not set(parameters) & set(keywords), function
