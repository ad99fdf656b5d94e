"""Measures over one parameter."""

import warnings

import flapwing
import matplotlib.pyplot as plt
import numpy as np
import pytest
from figures import HERTZ, VOLTS, drawn, fails, grid, legend, lines, loop, message
from flapwing import plot
from numpy.testing import assert_allclose, assert_array_equal


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


def test_several_measures_have_axes_of_their_own(sweep):
    names = ["stroke_pp_deg", "lift_mean_mn", "power_mean_mw"]
    figure = drawn(plot.response_panels(sweep, names))
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
    assert "`hinge_stiffness` is sampled" in text and "plot.scatter" in text


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


def test_axes_that_are_left_are_at_their_middle():
    table = grid(drive_voltage_pp=VOLTS, hinge_stiffness=[6e-5, 8e-5], drive_frequency=HERTZ)
    for options in ({}, {"by": "drive_voltage_pp"}, {"hinge_stiffness": 8e-5}):
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            ax = plot.response(table, "lift_mean_mn", **options)
        assert ["hinge_stiffness = 8e-05 N*m/rad" in str(each.message) for each in told] == (
            [] if "hinge_stiffness" in options else [True]
        )
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
    ],
)
def test_response_mistakes(sweep, keywords, says):
    assert says.lower() in message(ValueError, plot.response, sweep, **keywords).lower()


def test_panels_need_a_measure(sweep):
    assert "`measures` is empty" in message(ValueError, plot.response_panels, sweep, [])
    assert len(drawn(plot.response_panels(sweep, ["lift_mean_mn"])).axes) == 1


def test_what_is_not_a_table_is_a_type_error():
    assert "data frame" in message(TypeError, plot.response, 5)
    assert "number in SI units" in message(TypeError, plot.response, grid(drive_frequency=HERTZ), drive_frequency=[95])


def test_several_designs_have_a_line_each(sweep):
    weak, strong = sweep[sweep["drive_voltage_pp"] == 60], sweep[sweep["drive_voltage_pp"] == 100]
    ax = drawn(plot.response({"weak": weak, "strong": strong[1:]}, "lift_mean_mn"))
    assert legend(ax) == ["weak", "strong"]
    for line, rows in zip(lines(ax), (weak, strong[1:])):
        assert_array_equal(line.get_xdata(), rows["drive_frequency"])
        assert_array_equal(line.get_ydata(), rows["lift_mean_mn"])
    figure = drawn(plot.response_panels([weak, strong], ["lift_mean_mn", "stroke_pp_deg"], label=["weak", "strong"]))
    assert [len(ax.lines) for ax in figure.axes] == [2, 2] and legend(figure.axes[0]) == ["weak", "strong"]
    assert "`by` is for one result" in message(ValueError, plot.response, [weak, strong], by="drive_voltage_pp")
    assert "one result" in message(ValueError, plot.response, weak, label=["weak"])
