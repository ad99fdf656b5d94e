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
