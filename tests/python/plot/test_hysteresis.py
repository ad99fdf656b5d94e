"""Loops between the way up and the way down."""

import flapwing
import numpy as np
import pytest
from figures import HERTZ, drawn, grid, legend, loop, message
from flapwing import plot
from numpy.testing import assert_array_equal


def test_hysteresis_loop():
    table = loop()
    ax = drawn(plot.hysteresis(table))
    up, down, unstable = ax.lines
    assert_array_equal(up.get_xdata(), [1, 2, 3, 4, 5, np.nan, 6, 7])
    assert_array_equal(up.get_ydata(), [11, 12, 13, 14, 15, np.nan, 2, 2])
    assert_array_equal(down.get_xdata(), [7, 6, 5, 4, 3, np.nan, 2, 1])
    assert_array_equal(unstable.get_ydata(), [14, 8, 3])
    assert unstable.get_linestyle() == "--"
    assert legend(ax) == ["bistable, 3 to 5 Hz", "up", "down", "unstable"]
    band = ax.patches[0].get_extents().transformed(ax.transData.inverted())
    assert (band.x0, band.x1) == (pytest.approx(3.0), pytest.approx(5.0))
    # Two jumps, and an arrow on each way.
    assert sum(each.arrow_patch is not None for each in ax.texts) == 4
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("Drive frequency (Hz)", "Stroke, peak to peak (°)")


def test_a_response_without_hysteresis_has_no_band():
    table = flapwing.respond("ozaki2018-large", start=100, stop=120, step=5)
    ax = drawn(plot.hysteresis(table, "lift_mean_mn"))
    assert legend(ax) == ["up", "down"]
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
