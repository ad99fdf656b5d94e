"""Motions over time and their phase portraits."""

import flapwing
import matplotlib.pyplot as plt
import numpy as np
import pytest
from figures import drawn, legend, message
from flapwing import plot
from numpy.testing import assert_allclose, assert_array_equal


@pytest.mark.parametrize("preset", ["jafferis2016", "ozaki2018-large", "arabagi2013-75hz"])
def test_trajectory_over_time_and_phase_portraits(preset):
    table = flapwing.trajectory(preset)
    figure = drawn(plot.trajectory(table))
    over_time, stroke, pitch = figure.axes
    assert over_time.get_xlabel() == "Time (ms)" and over_time.get_ylabel() == "Angle (°)"
    assert legend(over_time) == ["Stroke", "Pitch"]
    for line, name in zip(over_time.lines, ("stroke_deg", "pitch_deg")):
        assert_allclose(line.get_xdata(), 1e3 * table["time_s"])
        assert_array_equal(line.get_ydata(), table[name])
    assert_array_equal(stroke.lines[0].get_xdata(), table["stroke_deg"])
    assert_array_equal(pitch.lines[0].get_xdata(), table["pitch_deg"])
    assert stroke.get_xlabel() == "Stroke (°)" and stroke.get_ylabel() == "Stroke rate (°/ms)"
    slope = np.gradient(table["stroke_deg"], 1e3 * table["time_s"])
    assert_allclose(stroke.lines[0].get_ydata(), slope, atol=0.02 * np.ptp(slope))


def test_phase_portraits_do_not_depend_on_the_unit_of_time(motion):
    signals = {name: motion[name] for name in ("stroke_deg", "lift_mn")}
    names = ["stroke_deg", "lift_mn"]
    expected = plot.trajectory({"time_s": motion["time_s"], **signals}, names, portrait=names).axes[2:]
    for column, factor in (("time_ms", 1e3), ("time_us", 1e6), ("t", 1.0)):
        table = {column: factor * motion["time_s"], **signals}
        for ax, there in zip(plot.trajectory(table, names, portrait=names, time=column).axes[2:], expected):
            assert_allclose(ax.lines[0].get_ydata(), there.lines[0].get_ydata())
    table = {"angle_deg": motion["time_s"], **signals}
    assert "`deg` is an angle, but `time` is in s" in message(
        ValueError, plot.trajectory, table, "stroke_deg", time="angle_deg"
    )


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


def larger(motion, factor):
    return {
        **{name: motion[name] for name in motion},
        **{name: factor * motion[name] for name in ("stroke_deg", "pitch_deg")},
    }


def test_motions_in_the_same_axes_are_told_apart(motion):
    _, ax = plt.subplots()
    for factor in (1.0, 2.0, 0.5):
        plot.trajectory(larger(motion, factor), ax=ax)
    assert len({line.get_color() for line in ax.lines}) == len(ax.lines) == 6
    assert legend(ax) == ["Stroke", "Pitch", "Stroke (2)", "Pitch (2)", "Stroke (3)", "Pitch (3)"]
    ax.figure.canvas.draw()
    low, high = ax.get_ylim()
    assert low < 2.0 * min(motion[name].min() for name in ("stroke_deg", "pitch_deg"))
    assert high > 2.0 * max(motion[name].max() for name in ("stroke_deg", "pitch_deg"))
    assert ax.get_ylabel() == "Angle (°)"


def test_motions_have_labels_of_their_own(motion):
    _, ax = plt.subplots()
    plot.trajectory(motion, "stroke_deg", label="80 V", ax=ax)
    plot.trajectory(larger(motion, 0.5), "stroke_deg", label="60 V", ax=ax)
    assert legend(ax) == ["80 V", "60 V"] and ax.get_ylabel() == "Stroke (°)"
    assert legend(plot.trajectory(motion, label="80 V").axes[0]) == ["Stroke, 80 V", "Pitch, 80 V"]
    with pytest.raises(
        ValueError, match="`ax` has the vertical axis 'Stroke \\(°\\)', but the signals are in mN\ndraw them"
    ):
        plot.trajectory(motion, "lift_mn", ax=ax)


def test_a_longer_motion_in_the_same_axes_has_the_same_time(motion):
    _, ax = plt.subplots()
    plot.trajectory(motion, "stroke_deg", ax=ax)
    assert ax.get_xlabel() == "Time (ms)"
    slow = {**{name: motion[name] for name in motion}, "time_s": 1e3 * motion["time_s"]}
    plot.trajectory(slow, "stroke_deg", ax=ax)
    assert ax.get_xlabel() == "Time (ms)"
    assert_allclose(ax.lines[1].get_xdata(), 1e3 * slow["time_s"])


def test_lines_of_the_user_stay(motion):
    _, ax = plt.subplots()
    ax.plot([0.0, 1.0], [0.0, 1.0], color="black", label="measured")
    ax.set_ylabel("mine")
    ax.set_ylim(-200.0, 200.0)
    plot.trajectory(motion, ax=ax)
    plot.trajectory(motion, ax=ax)
    ax.figure.canvas.draw()
    assert legend(ax)[0] == "measured" and ax.get_ylim()[0] == -200.0


def test_each_design_has_one_colour_in_all_axes(motion):
    designs = {"80 V": motion, "60 V": larger(motion, 0.5)}
    for arguments, options in ((designs, {}), (list(designs.values()), {"label": ["80 V", "60 V"]})):
        figure = drawn(plot.trajectory(arguments, ["stroke_deg", "pitch_deg", "lift_mn"], **options))
        *over_time, stroke, pitch = figure.axes
        assert [ax.get_ylabel() for ax in over_time] == ["Stroke (°)", "Pitch (°)", "Lift (mN)"]
        assert [legend(ax) if ax.get_legend() else None for ax in over_time] == [["80 V", "60 V"], None, None]
        colours = [line.get_color() for line in over_time[0].lines]
        assert len(set(colours)) == 2
        assert all([line.get_color() for line in ax.lines] == colours for ax in over_time)
        for ax, name in ((stroke, "stroke_deg"), (pitch, "pitch_deg")):
            curves = [line for line in ax.lines if len(line.get_xdata()) > 1]
            assert [line.get_color() for line in curves] == colours
            assert_array_equal(curves[1].get_xdata(), 0.5 * motion[name])


def test_designs_share_the_units_of_their_axes(motion):
    slow = {**{name: motion[name] for name in motion}, "time_s": 1e3 * motion["time_s"]}
    weak = {**slow, "lift_mn": 1e-4 * motion["lift_mn"]}
    ax = plot.trajectory({"fast": motion, "slow": weak}, "lift_mn").axes[0]
    factor = 1.0 if ax.get_xlabel() == "Time (s)" else 1e3
    assert ax.get_ylabel() == "Lift (mN)"
    assert_allclose(ax.lines[0].get_xdata(), factor * motion["time_s"])
    assert_allclose(ax.lines[1].get_xdata(), factor * slow["time_s"])
    assert_allclose(ax.lines[1].get_ydata(), weak["lift_mn"])


def test_several_designs_in_given_axes(motion):
    _, ax = plt.subplots()
    plot.trajectory({"80 V": motion, "60 V": larger(motion, 0.5)}, "stroke_deg", ax=ax)
    assert legend(ax) == ["80 V", "60 V"]
    with pytest.raises(ValueError, match="`ax` is for one signal of several trajectories"):
        plot.trajectory([motion, motion], ["stroke_deg", "pitch_deg"], ax=ax)


def test_mistakes_in_several_trajectories(motion):
    assert "`table` has 2 results, but `label` has 1 names" in message(
        ValueError, plot.trajectory, [motion, motion], label="80 V"
    )
    assert "a name twice" in message(ValueError, plot.trajectory, [motion, motion], label=["a", "a"])
    assert "its keys" in message(ValueError, plot.trajectory, {"a": motion}, label=["a"])
    assert "`table` is empty" in message(ValueError, plot.trajectory, [])
    assert "one trajectory" in message(ValueError, plot.trajectory, motion, label=["a"])
    without = {name: motion[name] for name in motion if name != "lift_mn"}
    assert "there is no column `lift_mn`" in message(ValueError, plot.trajectory, [motion, without], "lift_mn")


def test_trajectory_mistakes(motion):
    assert "did you mean `lift_mn`?" in message(ValueError, plot.trajectory, motion, "lift_m")
    assert "`signals` is empty" in message(ValueError, plot.trajectory, motion, [])
