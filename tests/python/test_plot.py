"""`flapwing.plot`: what is drawn is what was given, with labels that say so."""

import doctest
import importlib
import itertools
import re
import subprocess
import sys
import textwrap
from pathlib import Path

import flapwing
import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pandas
import pytest
from flapwing import plot
from matplotlib.collections import PolyCollection, QuadMesh
from matplotlib.figure import Figure
from numpy.testing import assert_allclose, assert_array_equal
from PIL import Image

REPOSITORY = Path(__file__).parents[2]
VOLTS = [60.0, 80.0, 100.0]
HERTZ = [95.0, 100.0, 105.0, 110.0, 115.0]


@pytest.fixture(autouse=True)
def nothing_is_left():
    """No picture changes matplotlib's settings; figures are closed."""
    before = matplotlib.rcParams.copy()
    yield
    assert matplotlib.rcParams == before
    plt.close("all")


@pytest.fixture(scope="module")
def sweep():
    """A small sweep of the direct drive: voltage by frequency."""
    return flapwing.sweep({"preset": "ozaki2018-large", "axes": {"drive_voltage_pp": VOLTS, "drive_frequency": HERTZ}})


@pytest.fixture(scope="module")
def motion():
    """Two cycles of the direct drive."""
    return flapwing.trajectory("ozaki2018-large")


def grid(**axes):
    """Columns of a full grid: parameters, a status, and two measures that are their own for each row."""
    rows = list(itertools.product(*axes.values()))
    columns = {name: np.array([row[i] for row in rows]) for i, name in enumerate(axes)}
    count = np.arange(len(rows), dtype=float)
    return {
        "point": np.arange(len(rows)),
        **columns,
        "status": np.array(["periodic"] * len(rows), dtype="U12"),
        "lift_mean_mn": 1.0 + count,
        "power_mean_mw": 50.0 - count**1.5,
    }


def fails(table, rows, status="unsettled"):
    """The table with rows that have no measures."""
    table = {name: column.copy() for name, column in table.items()}
    table["status"][rows] = status
    for name in ("lift_mean_mn", "power_mean_mw"):
        table[name][rows] = np.nan
    return table


def drawn(axes):
    """The figure is drawn without a warning, and no text leaves it."""
    figure = axes if isinstance(axes, Figure) else axes.figure
    figure.canvas.draw()
    box = figure.get_tightbbox()
    width, height = figure.get_size_inches()
    assert box.x0 >= -0.02 and box.y0 >= -0.02
    assert box.x1 <= width + 0.02 and box.y1 <= height + 0.02
    return axes


def lines(ax):
    """The lines that hold data."""
    return [line for line in ax.lines if not line.get_label().startswith("_not")]


def legend(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def message(error, function, *arguments, **keywords):
    before = plt.get_fignums()
    with pytest.raises(error) as caught:
        function(*arguments, **keywords)
    assert plt.get_fignums() == before, "a figure was begun before the mistake was found"
    return str(caught.value)


# --- the package ---------------------------------------------------------------------------------------------------


def test_importing_flapwing_does_not_import_matplotlib():
    code = "import sys, flapwing; sys.exit('matplotlib' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_without_matplotlib_the_error_says_what_to_install():
    code = textwrap.dedent("""
        import sys
        sys.modules["matplotlib"] = None
        try:
            import flapwing.plot
        except ImportError as error:
            assert "[plot]" in str(error) and "matplotlib>=3.7" in str(error), error
        else:
            sys.exit("imported")
    """)
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@pytest.mark.parametrize("name", ["", "._front", "._heatmap", "._labels", "._pareto", "._response", "._trajectory"])
def test_examples_in_docstrings(name):
    module = importlib.import_module(f"flapwing.plot{name}")
    result = doctest.testmod(module)
    assert result.attempted > 0 and result.failed == 0


def test_everything_has_a_docstring():
    for name in plot.__all__:
        assert getattr(plot, name).__doc__


# --- labels --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "unit", "expected"),
    [
        ("lift_mean_mn", None, "Lift, mean (mN)"),
        ("stroke_pp_deg", None, "Stroke, peak to peak (°)"),
        ("stroke_pp_deg_per_v", None, "Stroke, peak to peak (°/V)"),
        ("efficiency_gf_per_w", None, "Efficiency (gf/W)"),
        ("efficiency_capacitive_gf_per_w", None, "Capacitive efficiency (gf/W)"),
        ("power_translational_mean_mw", None, "Translational power, mean (mW)"),
        ("lift_added_mass_mean_mn", None, "Added mass lift, mean (mN)"),
        ("current_1_rms_ma", None, "Current 1, rms (mA)"),
        ("field_max_v_per_um", None, "Field, largest (V/µm)"),
        ("mode_1_hz", None, "Mode 1 (Hz)"),
        ("energy_audit", None, "Energy audit"),
        ("drive_voltage_pp", "V", "Drive voltage, peak to peak (V)"),
        ("hinge_stiffness", "N*m/rad", "Hinge stiffness (N·m/rad)"),
        ("air_density", "kg/m^3", "Air density (kg/m³)"),
        ("drag_max", "", "Drag max"),
        ("force_factor", "", "Force factor"),
        ("lift_slope", "", "Lift slope"),
        ("strain_surface_max", "", "Surface strain, largest"),
    ],
)
def test_labels(name, unit, expected):
    assert plot.label(name, unit) == expected


def test_every_column_of_every_model_has_a_label_without_underscores():
    for preset in flapwing.presets():
        for name, (unit, _) in flapwing.measures(preset).items():
            text = plot.label(name, unit)
            assert "_" not in text and text[0].isupper()
            assert (f"({unit.replace('deg', '°').replace('um', 'µm')})" in text) == bool(unit), text
        for name, parameter in flapwing.params(preset).items():
            assert "_" not in plot.label(name, parameter.unit)


@pytest.mark.parametrize(
    ("value", "unit", "shown"),
    [
        (8.64e-5, "N*m/rad", (86.4, "µN·m/rad")),
        (1.4972e-6, "N*m/rad", (1.4972, "µN·m/rad")),
        (0.0324, "m", (32.4, "mm")),
        (5.459e-5, "m^2", (54.59, "mm²")),
        (5.11e-11, "kg*m^2", (51.1, "mg·mm²")),
        (8e-5, "kg", (80.0, "mg")),
        (6.2e10, "Pa", (62.0, "GPa")),
        (3.2e-10, "m/V", (320.0, "pm/V")),
        (197.7, "N/m", (197.7, "N/m")),
        (1.2, "kg/m^3", (1.2, "kg/m³")),
        (120.0, "Hz", (120.0, "Hz")),
        (np.pi / 6, "rad", (30.0, "°")),
        (0.0, "m", (0.0, "m")),
        (0.5, "", (0.5, "")),
        (4.2, "mN", (4.2, "mN")),
        (1e-3, "mW", (1e-3, "mW")),
    ],
)
def test_si_values_are_shown_in_readable_units(value, unit, shown):
    from flapwing.plot import _labels

    factor, text = _labels.scale([value], unit)
    assert text == shown[1]
    assert value * factor == pytest.approx(shown[0], rel=1e-12)


# --- response ------------------------------------------------------------------------------------------------------


def test_response_draws_a_line_for_each_value(sweep):
    ax = drawn(plot.response(sweep, "lift_mean_mn"))
    assert len(ax.lines) == len(VOLTS)
    for line, volts in zip(ax.lines, VOLTS):
        rows = sweep["drive_voltage_pp"] == volts
        assert_array_equal(line.get_xdata(), HERTZ)
        assert_array_equal(line.get_ydata(), sweep["lift_mean_mn"][rows])
    assert ax.get_xlabel() == "Drive frequency (Hz)"
    assert ax.get_ylabel() == "Lift, mean (mN)"
    assert legend(ax) == ["60", "80", "100"]
    assert ax.get_legend().get_title().get_text().replace("\n", " ") == "Drive voltage, peak to peak (V)"
    assert (
        len({line.get_color() if isinstance(line.get_color(), str) else tuple(line.get_color()) for line in ax.lines})
        == 3
    )


def test_response_the_other_way_round(sweep):
    ax = drawn(plot.response(sweep, "lift_mean_mn", x="drive_voltage_pp", by="drive_frequency"))
    assert len(ax.lines) == len(HERTZ)
    assert_array_equal(ax.lines[0].get_xdata(), VOLTS)
    assert ax.get_xlabel() == "Drive voltage, peak to peak (V)"


def test_response_of_a_slice_is_one_line_without_a_legend(sweep):
    for ax in (
        plot.response(sweep, "lift_mean_mn", drive_voltage_pp=80),
        plot.response(sweep, "lift_mean_mn", where={"drive_voltage_pp": 80.0}),
    ):
        (line,) = ax.lines
        assert_array_equal(line.get_ydata(), sweep["lift_mean_mn"][sweep["drive_voltage_pp"] == 80.0])
        assert ax.get_legend() is None


def test_tables_frames_mappings_and_files_draw_the_same(sweep, tmp_path):
    path = tmp_path / "rows.csv"
    sweep.to_pandas().to_csv(path, index=False)
    wanted = [line.get_ydata() for line in plot.response(sweep, "lift_mean_mn").lines]
    for same in (sweep.to_pandas(), dict(sweep), path, str(path)):
        ax = plot.response(same, "lift_mean_mn")
        assert_array_equal([line.get_ydata() for line in ax.lines], wanted)
        assert ax.get_xlabel() == "Drive frequency (Hz)"
        assert legend(ax) == ["60", "80", "100"]


def test_several_measures_have_axes_of_their_own(sweep):
    names = ["stroke_pp_deg", "lift_mean_mn", "power_mean_mw"]
    figure = drawn(plot.response(sweep, names))
    assert [ax.get_ylabel() for ax in figure.axes] == [
        "Stroke, peak to peak (°)",
        "Lift, mean (mN)",
        "Power, mean (mW)",
    ]
    for ax, name in zip(figure.axes, names):
        assert_array_equal(ax.lines[1].get_ydata(), sweep[name][sweep["drive_voltage_pp"] == 80.0])
    assert [bool(ax.get_xlabel()) for ax in figure.axes] == [False, False, True]


def test_many_lines_have_a_colour_bar():
    table = grid(drive_voltage_pp=np.arange(10.0, 110.0, 10.0), drive_frequency=HERTZ)
    ax = drawn(plot.response(table, "lift_mean_mn"))
    assert len(ax.lines) == 10 and ax.get_legend() is None
    (bar,) = [each for each in ax.figure.axes if each is not ax]
    assert bar.get_ylabel() == "Drive voltage, peak to peak (V)"
    assert_allclose(bar.get_yticks(), np.arange(10.0, 110.0, 10.0))


def test_rows_that_are_not_periodic_are_gaps_and_marked():
    table = fails(grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ), [7, 8])
    table = fails(table, [12], "subharmonic")
    ax = drawn(plot.response(table, "lift_mean_mn"))
    family = lines(ax)
    assert_array_equal(family[0].get_ydata(), [1, 2, 3, 4, 5])
    assert_array_equal(family[1].get_ydata(), [6, 7, np.nan, np.nan, 10])
    assert_array_equal(family[2].get_ydata(), [11, 12, np.nan, 14, 15])
    marks = [line for line in ax.lines if line not in family]
    assert [list(mark.get_xdata()) for mark in marks] == [[105.0, 110.0], [105.0]]
    assert [text.get_text() for text in ax.texts] == ["marks: no periodic motion (2 unsettled, 1 subharmonic)"]
    # A value without neighbours would be invisible as a line.
    assert list(family[1].get_markevery()) == [4]


def test_points_that_the_grid_excludes_are_gaps():
    rows = flapwing.sweep(
        {
            "preset": "ozaki2018-large",
            "axes": {"drive_voltage_pp": [60.0, 80.0], "drive_frequency": HERTZ},
            "where": {"kept": "drive_frequency != 105 or drive_voltage_pp > 70"},
        }
    )
    assert len(rows) == 9
    ax = plot.response(rows, "lift_mean_mn")
    assert_array_equal(ax.lines[0].get_xdata(), HERTZ)
    assert_array_equal(np.isnan(ax.lines[0].get_ydata()), [False, False, True, False, False])
    alone = plot.response(rows, "lift_mean_mn", drive_voltage_pp=60)
    assert_array_equal(np.isnan(alone.lines[0].get_ydata()), [False, False, True, False, False])
    assert legend(plot.heatmap(rows, "lift_mean_mn")) == ["no row (1)"]


def test_a_response_up_and_down_has_a_line_for_each_way():
    ax = drawn(plot.response(loop()))
    assert legend(ax) == ["up", "down", "unstable"]
    assert_array_equal(ax.lines[2].get_xdata(), [3, 4, 5])


def test_samples_have_axes_only_where_they_are_crossed_with_some():
    rows = flapwing.sweep(
        {
            "preset": "ozaki2018-large",
            "sample": {"method": "sobol", "n": 4, "parameters": {"hinge_stiffness": {"from": 6e-5, "to": 1e-4}}},
            "axes": {"drive_frequency": HERTZ},
        }
    )
    ax = drawn(plot.response(rows, "lift_mean_mn"))
    assert len(ax.lines) == 4
    assert_array_equal(ax.lines[0].get_xdata(), HERTZ)
    text = message(ValueError, plot.response, rows, "lift_mean_mn", x="hinge_stiffness")
    assert "`hinge_stiffness` is sampled" in text and "plot.pareto" in text
    assert "is sampled" in message(ValueError, plot.heatmap, rows, "lift_mean_mn")


def test_frames_of_polars_and_files_in_parquet_are_drawn(sweep, tmp_path):
    path = tmp_path / "rows.parquet"
    written = flapwing.sweep(sweep.meta["grid"], out=path)
    wanted = [line.get_ydata() for line in plot.response(sweep, "lift_mean_mn").lines]
    for same in (written.to_polars(), path):
        assert_array_equal([line.get_ydata() for line in plot.response(same, "lift_mean_mn").lines], wanted)


def test_si_parameters_are_shown_with_prefixes():
    table = grid(hinge_stiffness=np.array([6e-5, 8e-5]), wing_length=np.array([0.03, 0.031, 0.032]))
    ax = drawn(plot.response(table, "lift_mean_mn"))
    assert ax.get_xlabel() == "Wing length (mm)"
    assert_allclose(ax.lines[0].get_xdata(), [30, 31, 32])
    assert ax.get_legend().get_title().get_text().replace("\n", " ") == "Hinge stiffness (µN·m/rad)"
    assert legend(ax) == ["60", "80"]


def test_words_make_a_family():
    table = grid(centre_of_pressure=["folded", "directional"], drive_frequency=HERTZ)
    assert legend(drawn(plot.response(table, "lift_mean_mn"))) == ["folded", "directional"]


def test_parameters_that_move_together_are_one_axis():
    table = grid(actuator_length=[0.020, 0.021], drive_frequency=HERTZ)
    table = {
        **dict(list(table.items())[:2]),
        "piezo_thickness": table["actuator_length"] / 200,
        **dict(list(table.items())[2:]),
    }
    ax = plot.response(table, "lift_mean_mn")
    assert legend(ax) == ["20", "21"]
    assert legend(plot.response(table, "lift_mean_mn", by="piezo_thickness")) == ["100", "105"]


def test_axes_that_are_given_are_used():
    table = grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ)
    _, (left, right) = plt.subplots(1, 2)
    assert plot.response(table, "lift_mean_mn", ax=right) is right
    assert not left.lines and len(right.lines) == 3


def test_axes_that_are_left_are_an_error_that_lists_them():
    table = grid(drive_voltage_pp=VOLTS, hinge_stiffness=[6e-5, 8e-5], drive_frequency=HERTZ)
    text = message(ValueError, plot.response, table, "lift_mean_mn")
    assert "drive_voltage_pp (V): 60, 80, 100" in text
    assert "hinge_stiffness (N*m/rad): 6e-05, 8e-05" in text
    text = message(ValueError, plot.response, table, "lift_mean_mn", by="drive_voltage_pp")
    assert "such as hinge_stiffness=6e-05" in text and "drive_frequency" not in text
    ax = plot.response(table, "lift_mean_mn", hinge_stiffness=8e-5)
    assert_array_equal(ax.lines[0].get_ydata(), table["lift_mean_mn"][5:10])


def test_a_slice_that_no_row_is_in_lists_the_values(sweep):
    text = message(ValueError, plot.response, sweep, "lift_mean_mn", drive_voltage_pp=70)
    assert "no row has drive_voltage_pp = 70" in text and "(V) are 60, 80, 100" in text


@pytest.mark.parametrize(
    ("keywords", "says"),
    [
        ({"y": "lift_men_mn"}, "did you mean `lift_mean_mn`?"),
        ({"y": "lift_mean_mn", "by": "drive_voltage"}, "did you mean `drive_voltage_pp`?"),
        ({"y": "lift_mean_mn", "drive_frequenzy": 100}, "did you mean `drive_frequency`?"),
        ({"y": "status"}, "`status` is text"),
        ({"y": []}, "names no measure"),
    ],
)
def test_response_mistakes(sweep, keywords, says):
    assert says.lower() in message(ValueError, plot.response, sweep, **keywords).lower()


def test_what_is_not_a_table_is_a_type_error():
    assert "data frame" in message(TypeError, plot.response, 5)
    assert "number in SI units" in message(
        TypeError, plot.response, grid(drive_frequency=HERTZ), drive_frequency="95 Hz"
    )


# --- heatmap -------------------------------------------------------------------------------------------------------


def mesh(ax):
    return next(each for each in ax.collections if isinstance(each, QuadMesh))


def test_heatmap_draws_each_row_in_its_cell(sweep):
    ax = drawn(plot.heatmap(sweep, "efficiency_gf_per_w"))
    values = mesh(ax).get_array()
    assert values.shape == (3, 5)
    assert_array_equal(values, sweep["efficiency_gf_per_w"].reshape(3, 5))
    edges = mesh(ax).get_coordinates()
    assert_allclose(edges[0, :, 0], [92.5, 97.5, 102.5, 107.5, 112.5, 117.5])
    assert_allclose(edges[:, 0, 1], [50, 70, 90, 110])
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("Drive frequency (Hz)", "Drive voltage, peak to peak (V)")
    assert ax.figure.axes[1].get_ylabel() == "Efficiency (gf/W)"
    assert ax.get_legend() is None


def test_heatmap_transposed_and_shuffled(sweep):
    order = np.random.default_rng(1).permutation(len(sweep))
    ax = plot.heatmap(sweep[order], "lift_mean_mn", x="drive_voltage_pp")
    assert_array_equal(mesh(ax).get_array(), sweep["lift_mean_mn"].reshape(3, 5).T)


def test_edges_of_uneven_and_logarithmic_axes():
    stiffness = np.geomspace(5e-5, 2e-4, 5)
    table = grid(hinge_stiffness=stiffness, drive_frequency=np.array([90.0, 100.0, 120.0]))
    ax = drawn(plot.heatmap(table, "lift_mean_mn"))
    assert ax.get_yscale() == "log" and ax.get_xscale() == "linear"
    edges = mesh(ax).get_coordinates()
    assert_allclose(edges[0, :, 0], [85, 95, 110, 130])
    ratio = stiffness[1] / stiffness[0]
    assert_allclose(edges[:, 0, 1], 1e6 * stiffness[0] * ratio ** (np.arange(6) - 0.5))
    assert ax.get_ylabel() == "Hinge stiffness (µN·m/rad)"
    linear = plot.heatmap(table, "lift_mean_mn", yscale="linear")
    assert_allclose(mesh(linear).get_coordinates()[1:-1, 0, 1], 5e5 * (stiffness[1:] + stiffness[:-1]))


def test_words_along_an_axis():
    ax = drawn(plot.heatmap(grid(centre_of_pressure=["folded", "directional"], drive_frequency=HERTZ), "lift_mean_mn"))
    assert [text.get_text() for text in ax.get_yticklabels()] == ["folded", "directional"]
    assert_array_equal(mesh(ax).get_array(), 1.0 + np.arange(10).reshape(2, 5))


def test_cells_without_a_value_are_shown_and_counted():
    table = fails(fails(grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ), [0, 1]), [7], "subharmonic")
    table["lift_mean_mn"][10] = np.nan  # periodic, and not defined
    table = {name: column[:-3] for name, column in table.items()}
    ax = drawn(plot.heatmap(table, "lift_mean_mn"))
    assert legend(ax) == ["unsettled (2)", "subharmonic (1)", "no value (1)", "no row (3)"]
    masked = np.ma.getmaskarray(mesh(ax).get_array())
    assert_array_equal(np.flatnonzero(masked), [0, 1, 7, 10, 12, 13, 14])
    hatched = [each for each in ax.collections if isinstance(each, PolyCollection) and each.get_hatch()]
    outlines = [path.get_extents().bounds for each in hatched for path in each.get_paths()]
    assert_allclose(outlines, [(92.5, 90, 5, 20), (102.5, 90, 15, 20)])


def test_heatmap_mistakes():
    table = grid(drive_voltage_pp=VOLTS, hinge_stiffness=[6e-5, 8e-5], drive_frequency=HERTZ)
    text = message(ValueError, plot.heatmap, table, "lift_mean_mn")
    assert "drive_voltage_pp (V): 60, 80, 100" in text and "hinge_stiffness" in text
    text = message(ValueError, plot.heatmap, table, "lift_mean_mn", x="drive_frequency", y="hinge_stiffness")
    assert "such as drive_voltage_pp=60" in text
    assert "two axes" in message(ValueError, plot.heatmap, grid(drive_frequency=HERTZ), "lift_mean_mn")
    assert "both" in message(ValueError, plot.heatmap, table, "lift_mean_mn", x="drive_frequency", y="drive_frequency")
    assert '"linear" or "log"' in message(
        ValueError, plot.heatmap, table, "lift_mean_mn", drive_voltage_pp=60, xscale="logarithmic"
    )


# --- Pareto front --------------------------------------------------------------------------------------------------


def brute_force(costs):
    """By the definition, point against point."""
    front = []
    for point in costs:
        beaten = any((other <= point).all() and (other < point).any() for other in costs)
        front.append(not beaten and not np.isnan(point).any())
    return front


@pytest.mark.parametrize("objectives", [1, 2, 3, 4])
@pytest.mark.parametrize("coarse", [False, True], ids=["distinct", "ties"])
def test_front_against_brute_force(objectives, coarse):
    random = np.random.default_rng(objectives)
    for count in (0, 1, 2, 30, 200):
        costs = random.normal(size=(count, objectives))
        costs = np.round(2 * costs) if coarse else costs
        if count > 10:
            costs[random.integers(count, size=3), 0] = np.nan
        assert_array_equal(plot.non_dominated(costs), np.array(brute_force(costs), dtype=bool))


def test_front_of_many_points():
    random = np.random.default_rng(0).random((200_000, 2))
    front = random[plot.non_dominated(random)]
    order = np.argsort(front[:, 0])
    assert (np.diff(front[order, 1]) < 0).all()


def test_front_needs_rows_of_objectives():
    assert "(n, k)" in message(ValueError, plot.non_dominated, [1.0, 2.0])


def test_pareto_draws_all_designs_and_the_front(sweep):
    ax = drawn(plot.pareto(sweep, maximize="lift_mean_mn", minimize="power_mean_mw", color="drive_voltage_pp"))
    lift, power = sweep["lift_mean_mn"], sweep["power_mean_mw"]
    assert_array_equal(ax.collections[0].get_offsets(), np.column_stack([power, lift]))
    assert_array_equal(ax.collections[0].get_array(), sweep["drive_voltage_pp"])
    front = plot.non_dominated(np.column_stack([power, -lift]))
    order = np.argsort(power[front])
    (line,) = ax.lines
    assert_array_equal(line.get_xdata(), power[front][order])
    assert_array_equal(line.get_ydata(), lift[front][order])
    assert line.get_drawstyle() == "steps-post"
    assert legend(ax) == [f"front ({front.sum()} of 15 designs)"]
    assert ax.get_xlabel() == "Power, mean (mW), less is better"
    assert ax.get_ylabel() == "Lift, mean (mN), more is better"
    assert ax.figure.axes[1].get_ylabel() == "Drive voltage, peak to peak (V)"


def test_pareto_leaves_out_designs_without_measures_and_names_words():
    table = fails(grid(centre_of_pressure=["folded", "directional"], drive_frequency=HERTZ), [2, 3])
    ax = drawn(plot.pareto(table, maximize=["lift_mean_mn", "power_mean_mw"], color="centre_of_pressure"))
    assert sum(len(each.get_offsets()) for each in ax.collections) == 8
    assert legend(ax) == ["folded", "directional", "front (8 of 8 designs)"]
    assert ax.lines[0].get_drawstyle() == "steps-pre"


def test_more_than_two_objectives_ring_the_front(sweep):
    ax = drawn(plot.pareto(sweep, maximize=["lift_mean_mn", "efficiency_gf_per_w"], minimize="strain_surface_max"))
    costs = np.column_stack([sweep["strain_surface_max"], -sweep["lift_mean_mn"], -sweep["efficiency_gf_per_w"]])
    assert len(ax.lines[0].get_xdata()) == plot.non_dominated(costs).sum()
    assert ax.lines[0].get_linestyle() == "None"
    assert "Efficiency (more)" in ax.texts[0].get_text()


def test_pareto_mistakes(sweep):
    assert "two different objectives" in message(ValueError, plot.pareto, sweep, maximize="lift_mean_mn")
    text = message(ValueError, plot.pareto, sweep, maximize="lift_mean_mn", minimize="power_mean")
    assert "Did you mean `power_mean_mw`?" in text
    table = fails(grid(drive_frequency=HERTZ), slice(None))
    assert "no row" in message(ValueError, plot.pareto, table, maximize="lift_mean_mn", minimize="power_mean_mw")


# --- trajectory ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("preset", ["jafferis2016", "ozaki2018-large", "arabagi2013-75hz"])
def test_trajectory_over_time_and_phase_portraits(preset):
    table = flapwing.trajectory(preset)
    figure = drawn(plot.trajectory(table))
    over_time, stroke, pitch = figure.axes
    assert over_time.get_xlabel() == "Time (ms)"
    assert legend(over_time) == ["Stroke", "Pitch"]
    for line, name in zip(over_time.lines, ("stroke_deg", "pitch_deg")):
        assert_allclose(line.get_xdata(), 1e3 * table["time_s"])
        assert_array_equal(line.get_ydata(), table[name])
    assert_array_equal(stroke.lines[0].get_xdata(), table["stroke_deg"])
    assert_array_equal(pitch.lines[0].get_xdata(), table["pitch_deg"])
    assert stroke.get_xlabel() == "Stroke (°)" and stroke.get_ylabel() == "Stroke rate (°/ms)"
    slope = np.gradient(table["stroke_deg"], 1e3 * table["time_s"])
    assert_allclose(stroke.lines[0].get_ydata(), slope, atol=0.02 * np.ptp(slope))


def test_signals_with_the_same_unit_share_axes(motion):
    figure = drawn(plot.trajectory(motion, ["stroke_deg", "lift_mn", "drag_mn", "power_mw"]))
    assert [ax.get_ylabel() for ax in figure.axes] == [
        "Stroke (°)",
        "Lift, drag (mN)",
        "Power (mW)",
        "Stroke rate (°/ms)",
    ]
    assert [len(ax.lines) for ax in figure.axes[:3]] == [1, 2, 1]


def test_one_signal_in_axes_that_are_given(motion):
    _, ax = plt.subplots()
    assert plot.trajectory(motion, "lift_mn", ax=ax) is ax
    assert ax.get_ylabel() == "Lift (mN)"


def test_trajectory_mistakes(motion):
    assert "Did you mean `lift_mn`?" in message(ValueError, plot.trajectory, motion, "lift_m")
    assert "no column" in message(ValueError, plot.trajectory, motion, [])


# --- wing path -----------------------------------------------------------------------------------------------------


def test_wing_path_is_saved_as_gif(motion, tmp_path):
    path = tmp_path / "cycle.gif"
    plot.wing_path(motion, frames=6).save(path, dpi=40)
    with Image.open(path) as image:
        assert image.n_frames == 6
        assert image.format == "GIF" and image.info["loop"] == 0
        assert image.convert("RGB").getpixel((0, 0)) == (255, 255, 255)


def test_wing_path_is_saved_as_a_page(motion, tmp_path):
    path = tmp_path / "cycle.html"
    plot.wing_path(motion, frames=2).save(path, dpi=40)
    page = path.read_text(encoding="utf-8")
    assert page.count("data:image/png;base64") == 2


@pytest.mark.parametrize("preset", ["jafferis2016", "ozaki2018-large", "arabagi2013-75hz"])
def test_the_trailing_edge_lags_in_every_model(preset):
    animation = plot.wing_path(flapwing.trajectory(preset, samples=100), frames=20)
    scene = animation._scene
    chord = np.hypot(*(scene.leading - scene.trailing).T)
    assert_allclose(chord, 1.0)
    assert_allclose(scene.leading[:, 0], 3.0 * np.radians(scene.cycle.stroke))
    rate = np.roll(scene.leading[:, 0], -1) - np.roll(scene.leading[:, 0], 1)
    behind = scene.leading[:, 0] - scene.trailing[:, 0]
    assert np.sum(behind * rate) > 0.5 * np.linalg.norm(behind) * np.linalg.norm(rate)
    animation._draw_was_started = True  # never shown


def test_every_frame_is_where_the_wing_is(motion):
    animation = plot.wing_path(motion, frames=10, pitch_sign=-1)
    scene = animation._scene
    assert scene.cycle.seconds == pytest.approx(1 / 109, rel=1e-6)
    once = motion["time_s"] >= motion["time_s"][-1] - 1.0001 / 109
    assert_allclose(
        scene.cycle.stroke, np.interp(scene.cycle.phase / 109, motion["time_s"], motion["stroke_deg"]), atol=1e-3
    )
    assert once.sum() == 201
    for frame in (0, 7):
        scene.draw(frame)
        assert_allclose(scene.edge.get_xydata()[0], scene.leading[frame])
        assert_allclose(scene.chord.get_xydata(), [scene.leading[frame], scene.trailing[frame]])
        assert scene.now.get_xdata()[0] == frame / 10
    animation._draw_was_started = True


def test_the_cycle_is_found_after_a_start_from_rest():
    table = flapwing.trajectory("ozaki2018-large", cycles=40, samples=50, from_rest=True)
    animation = plot.wing_path(table, frames=4)
    assert animation._scene.cycle.seconds == pytest.approx(1 / 109, rel=1e-6)
    animation._draw_was_started = True


def test_wing_path_mistakes(motion):
    half = motion[:100]
    assert "does not repeat" in message(ValueError, plot.wing_path, half)
    assert "less than one cycle" in message(ValueError, plot.wing_path, half, frequency=109)
    assert "two frames" in message(ValueError, plot.wing_path, motion, frames=1)
    assert "1 or -1" in message(ValueError, plot.wing_path, motion, pitch_sign=2)
    assert "Did you mean `lift_mn`?" in message(ValueError, plot.wing_path, motion, lift="lift_m")


# --- hysteresis ----------------------------------------------------------------------------------------------------


def loop():
    """A response that is bistable from 3 to 5 Hz."""
    hertz = np.arange(1.0, 8.0)
    up, down = np.where(hertz <= 5, 10 + hertz, 2.0), np.where(hertz < 3, 10 + hertz, 2.0)
    x = np.concatenate([hertz, hertz[::-1], [5.0, 4.0, 3.0]])
    return {
        "curve": np.zeros(len(x)),
        "branch": np.array(["up"] * 7 + ["down"] * 7 + ["unstable"] * 3),
        "drive_frequency": x,
        "status": np.array(["periodic"] * 14 + ["unstable"] * 3),
        "stroke_pp_deg": np.concatenate([up, down[::-1], [14.0, 8.0, 3.0]]),
    }


def test_hysteresis_loop():
    table = loop()
    ax = drawn(plot.hysteresis(table))
    up, down, unstable = ax.lines
    assert_array_equal(up.get_xdata(), [1, 2, 3, 4, 5, np.nan, 6, 7])
    assert_array_equal(up.get_ydata(), [11, 12, 13, 14, 15, np.nan, 2, 2])
    assert_array_equal(down.get_xdata(), [7, 6, 5, 4, 3, np.nan, 2, 1])
    assert_array_equal(unstable.get_ydata(), [14, 8, 3])
    assert unstable.get_linestyle() == "--"
    assert legend(ax) == ["bistable, 3 to 5 Hz", "way up", "way down", "unstable orbits"]
    band = ax.patches[0].get_extents().transformed(ax.transData.inverted())
    assert (band.x0, band.x1) == (pytest.approx(3.0), pytest.approx(5.0))
    # Two jumps, and an arrow on each way.
    assert sum(each.arrow_patch is not None for each in ax.texts) == 4
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("Drive frequency (Hz)", "Stroke, peak to peak (°)")


def test_a_response_without_hysteresis_has_no_band():
    table = flapwing.respond("ozaki2018-large", start=100, stop=120, step=5)
    ax = drawn(plot.hysteresis(table, "lift_mean_mn"))
    assert legend(ax) == ["way up", "way down"]
    rows = table["branch"] == "up"
    assert_array_equal(ax.lines[0].get_xdata(), table["drive_frequency"][rows])
    assert_array_equal(ax.lines[0].get_ydata(), table["lift_mean_mn"][rows])


def test_a_way_without_periodic_motions_has_a_gap():
    table = loop()
    table["status"][3], table["stroke_pp_deg"][3] = "unsettled", np.nan
    ax = drawn(plot.hysteresis(table))
    assert np.isnan(ax.lines[0].get_ydata()[3])
    assert "no periodic motion" in legend(ax)


def test_several_designs_are_an_error_until_one_is_chosen():
    one = loop()
    two = {name: np.concatenate([column, column]) for name, column in one.items()}
    two["curve"] = np.repeat([0.0, 1.0], len(one["curve"]))
    two = {"curve": two.pop("curve"), "drive_voltage_pp": np.repeat([80.0, 160.0], len(one["curve"])), **two}
    text = message(ValueError, plot.hysteresis, two)
    assert "one of 2 designs" in text and "drive_voltage_pp (V): 80, 160" in text
    for chosen in ({"curve": 1}, {"drive_voltage_pp": 160}):
        assert len(plot.hysteresis(two, **chosen).lines) == 3
    assert "`respond`" in message(ValueError, plot.hysteresis, grid(drive_frequency=HERTZ))


# --- tornado -------------------------------------------------------------------------------------------------------

TRIED = ["drive_frequency", "hinge_stiffness", "wing_length"]


@pytest.fixture(scope="module")
def sensitivities():
    return plot.sensitivities("ozaki2018-large", "lift_mean_mn", TRIED)


def test_sensitivities_are_those_of_single_runs(sensitivities):
    assert [each.swing for each in sensitivities] == sorted((each.swing for each in sensitivities), reverse=True)
    assert {each.parameter for each in sensitivities} == set(TRIED)
    for each in sensitivities:
        value = flapwing.params("ozaki2018-large")[each.parameter].value
        assert (each.below, each.above) == (pytest.approx(0.95 * value), pytest.approx(1.05 * value))
        assert each.low == flapwing.run("ozaki2018-large", **{each.parameter: each.below})["lift_mean_mn"]
        assert each.high == flapwing.run("ozaki2018-large", **{each.parameter: each.above})["lift_mean_mn"]
        assert each.base == flapwing.run("ozaki2018-large")["lift_mean_mn"]
        assert each.measure_unit == "mN"


def test_what_follows_a_parameter_follows_its_change():
    (each,) = plot.sensitivities("ozaki2018-large", "lift_mean_mn", ["drive_voltage_pp"])
    assert each.high == flapwing.run("ozaki2018-large", drive_voltage_pp=105.0)["lift_mean_mn"]


def test_fixed_parameters_and_ranges_of_ones_own():
    found = plot.sensitivities(
        "ozaki2018-large",
        "power_mean_mw",
        {"drive_voltage_pp": 0.1, "drive_frequency": (100.0, 104.0)},
        drive_voltage_pp="80 V",
        rtol=1e-5,
    )
    by_name = {each.parameter: each for each in found}
    volts, hertz = by_name["drive_voltage_pp"], by_name["drive_frequency"]
    assert (volts.value, volts.below, volts.above) == pytest.approx((80.0, 72.0, 88.0))
    assert (hertz.below, hertz.above) == (100.0, 104.0)
    wanted = flapwing.run("ozaki2018-large", drive_voltage_pp=80.0, drive_frequency=104.0, rtol=1e-5)
    assert hertz.high == wanted["power_mean_mw"]


def test_tornado_draws_bars_in_order(sensitivities):
    ax = drawn(plot.tornado(sensitivities))
    low, high = ax.containers[:2]
    for i, each in enumerate(sensitivities):
        assert low[i].get_width() == pytest.approx(100 * (each.low / each.base - 1))
        assert high[i].get_width() == pytest.approx(100 * (each.high / each.base - 1))
        assert low[i].get_y() + low[i].get_height() / 2 == pytest.approx(i)
    assert ax.yaxis_inverted()
    assert {bar.get_height() for bar in (*low, *high)} == {0.62}
    labels = [text.get_text() for text in ax.get_yticklabels()]
    assert set(labels) == {"Drive frequency, 109 Hz", "Hinge stiffness, 86.4 µN·m/rad", "Wing length, 32.4 mm"}
    assert legend(ax) == ["−5 %", "+5 %"]
    assert ax.get_xlabel() == "Change of lift, mean (% of 4.597 mN)"
    shorter = drawn(plot.tornado(sensitivities, top=2))
    assert len(shorter.get_yticklabels()) == 2
    assert "1 smaller" in shorter.get_legend().get_title().get_text()


def test_tornado_runs_what_it_draws():
    ax = plot.tornado("ozaki2018-large", "lift_mean_mn", ["wing_length"], change=0.01)
    assert legend(ax) == ["−1 %", "+1 %"]


def test_changes_that_go_the_same_way_are_both_seen(sensitivities):
    first = sensitivities[0]
    ax = plot.tornado([first._replace(low=0.8 * first.base, high=0.9 * first.base)])
    (long,), (short,) = ax.containers[:2]
    assert (long.get_height(), short.get_height()) == (0.62, 0.28)
    assert short.get_zorder() > long.get_zorder()


def test_by_default_all_numbers_that_can_be_changed_are():
    found = {each.parameter for each in plot.sensitivities("arabagi2013-75hz", "lift_mean_mn", rtol=1e-4)}
    known = flapwing.params("arabagi2013-75hz")
    numbers = {name for name, each in known.items() if isinstance(each.value, float) and each.value != 0}
    assert found == numbers - {"strips"}


def test_a_change_without_a_periodic_motion_is_said(sensitivities):
    lost = [sensitivities[0]._replace(high=float("nan")), *sensitivities[1:]]
    ax = drawn(plot.tornado(lost))
    assert [text.get_text() for text in ax.texts] == ["no periodic motion at +5 %"]


def test_tornado_mistakes():
    assert "Did you mean `wing_length`?" in message(
        ValueError, plot.tornado, "ozaki2018-large", "lift_mean_mn", ["wing_lengt"]
    )
    assert "Did you mean `lift_mean_mn`?" in message(
        ValueError, plot.tornado, "ozaki2018-large", "lift_mean", ["wing_length"]
    )
    assert "only numbers" in message(ValueError, plot.tornado, "ozaki2018-large", "lift_mean_mn", ["lift_sign"])
    assert "follows" in message(ValueError, plot.tornado, "ozaki2018-large", "lift_mean_mn", ["drive_bias"])
    assert "more than zero" in message(
        ValueError, plot.tornado, "ozaki2018-large", "lift_mean_mn", ["wing_length"], change=0
    )
    assert "the two values" in message(ValueError, plot.tornado, "jafferis2016", "lift_mean_mn", ["actuator_mass"])
    assert "no sensitivities" in message(ValueError, plot.tornado, [])
    assert "`measure`" in message(TypeError, plot.tornado, "ozaki2018-large")


def test_pandas_words_and_flags_with_gaps():
    table = pandas.DataFrame(fails(grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ), [3]))
    table["status"] = table["status"].astype("category")
    table["stable"] = pandas.array([True, None] * 7 + [False], dtype="boolean")
    ax = plot.response(table, "lift_mean_mn")
    assert np.isnan(lines(ax)[0].get_ydata()[3])


# --- the page ------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def page():
    """The part of docs/plots.md that is about Python."""
    text = (REPOSITORY / "docs" / "plots.md").read_text(encoding="utf-8")
    return text.split("\n## In Python\n")[1].split("\n## ")[0]


def test_the_examples_of_the_page_run(page, tmp_path, monkeypatch):
    (tmp_path / "examples").symlink_to(REPOSITORY / "examples")
    monkeypatch.chdir(tmp_path)
    saved = []

    def save(animation, path):
        animation._draw_was_started = True
        saved.append(path)

    monkeypatch.setattr(plot.WingPath, "save", save)
    names = {}
    for example in re.findall(r"^```python\n(.*?)^```", page, re.MULTILINE | re.DOTALL):
        exec(compile(example, "docs/plots.md", "exec"), names)
    assert saved == ["cycle.gif"] and Path("lift.png").is_file()
    text = message(ValueError, plot.heatmap, names["large"], "efficiency_gf_per_w")
    assert f"ValueError: {text}\n" in page


def test_pictures_of_the_page_are_there_and_small(page):
    shown = set(re.findall(r"\]\((pictures/py-.*?)\)", page))
    files = {f"pictures/{path.name}": path for path in (REPOSITORY / "docs" / "pictures").glob("py-*")}
    assert shown == set(files)
    sizes = [path.stat().st_size for path in files.values()]
    assert max(sizes) < 80_000 and sum(sizes) < 500_000
    script = (REPOSITORY / "examples" / "python" / "pictures.py").read_text(encoding="utf-8")
    for name in files:
        function = name.split("py-")[1].split(".")[0].replace("-", "_")
        assert f"def {function}(" in script


def test_the_pictures_of_the_page_are_made(tmp_path):
    """By the script that makes them, all of them and no others."""
    script = Path(__file__).parents[2] / "examples/python/pictures.py"
    subprocess.run([sys.executable, "-W", "error", script, tmp_path], check=True, capture_output=True, text=True)
    kept = {picture.name for picture in (script.parents[2] / "docs/pictures").glob("py-*")}
    assert {picture.name for picture in tmp_path.iterdir()} == kept
