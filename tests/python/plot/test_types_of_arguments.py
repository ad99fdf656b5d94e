"""Arguments of the wrong type: two lines that say what is allowed, before a figure is begun."""

import matplotlib.pyplot as plt
import pytest
from figures import HERTZ, VOLTS, grid, loop, message
from flapwing import plot
from flapwing.plot._checks import checked
from matplotlib import colormaps

TABLE = grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ)


def given(kind):
    """An `ax` that is none."""
    return {"number": 3, "figure": plt.figure(), "array": plt.subplots(1, 2)[1]}[kind]


@pytest.mark.parametrize("kind", ["number", "figure", "array"])
@pytest.mark.parametrize(
    "function",
    [
        plot.response,
        plot.heatmap,
        plot.pareto,
        plot.scatter,
        plot.histogram,
        plot.trajectory,
        plot.flight,
        plot.wing_path,
        plot.control_matrix,
    ],
)
def test_what_is_no_axes(function, kind):
    ax = given(kind)
    told = message(TypeError, function, TABLE, ax=ax)
    assert told == f"`ax` is {type(ax).__name__}\nit must be matplotlib Axes, such as from plt.subplots()"


@pytest.mark.parametrize(
    ("function", "arguments", "keywords", "says"),
    [
        (plot.tornado, ([1],), {}, "`design` is list\nit must be a preset, the result of `sensitivities`, or"),
        (plot.tornado, ("ozaki2018-large", 3), {}, "`measure` is int\nit must be a name"),
        (plot.tornado, ("ozaki2018-large", "lift_mean_mn", 3), {}, "`parameters` is int\nit must be names"),
        (plot.tornado, ("ozaki2018-large", "lift_mean_mn"), {"top": 1.5}, "`top` is float\nit must be a whole number"),
        (plot.response, (TABLE, 3), {}, "`y` is int\nit must be a name, such as"),
        (plot.response, (TABLE, ["lift_mean_mn"]), {}, "`y` is list\nit must be a name, such as"),
        (plot.response_panels, (TABLE, "lift_mean_mn"), {}, "`measures` is str\nit must be a list of names"),
        (plot.response_panels, (TABLE, [3]), {}, "`measures` is list\nit must be a list of names"),
        (plot.response, (TABLE,), {"where": [1]}, "`where` is list\nit must be a mapping of columns"),
        (plot.response, (TABLE,), {"legend": 3}, "`legend` is int\nit must be True, False or a place"),
        (plot.pareto, (TABLE,), {"maximize": 3}, "`maximize` is int\nit must be a name"),
        (plot.pareto, (TABLE,), {"color": ["a"]}, "`color` is list\nit must be a name"),
        (plot.heatmap, (TABLE,), {"vmin": "1"}, "`vmin` is str\nit must be a number"),
        (plot.heatmap, (TABLE,), {"vmax": True}, "`vmax` is bool\nit must be a number"),
        (plot.heatmap, (TABLE,), {"cmap": 3}, "`cmap` is int\nit must be a colour map"),
        (plot.heatmap, (TABLE,), {"colorbar": "right"}, "`colorbar` is str\nit must be True, False or matplotlib Axes"),
        (plot.heatmap, (TABLE,), {"drive_voltage_pp": [1]}, "`drive_voltage_pp` is list\nit must be a number"),
        (plot.hysteresis, (loop(),), {"curve": "0"}, "`curve` is str\nit must be a whole number"),
        (plot.control_matrix, ([[0]] * 6,), {"inputs": "a"}, "`inputs` is str\nit must be a list of names"),
        (plot.flight, (TABLE, 3), {}, "`groups` is int\nit must be a name"),
        (plot.flight_film, (TABLE, TABLE), {"views": "side"}, "`views` is str\nit must be a list of names"),
        (plot.flight_film, (TABLE, TABLE), {"scale": "2"}, "`scale` is str\nit must be a number"),
        (plot.wing_path, (TABLE,), {"frames": "many"}, "`frames` is str\nit must be a whole number"),
        (plot.scatter, (5,), {}, "`table` is int\nit must be a flapwing.Table, a data frame"),
    ],
)
def test_what_is_of_no_allowed_type(function, arguments, keywords, says):
    told = message(TypeError, function, *arguments, **keywords)
    assert told.startswith(says) and len(told.splitlines()) == 2


def test_every_argument_has_a_kind():
    def picture(table, colour): ...

    with pytest.raises(KeyError, match="colour"):
        checked(picture)


def test_what_is_allowed_is_taken():
    assert plot.heatmap(TABLE, cmap=colormaps["magma"]).collections[0].cmap.name == "magma"
    assert plot.pareto(TABLE, maximize=("lift_mean_mn",), minimize=["power_mean_mw"]).get_xlabel()
    with pytest.raises(TypeError, match="missing 1 required positional argument: 'table'"):
        plot.response()
