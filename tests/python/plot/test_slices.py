"""Slices of grids with more axes than a picture has: chosen ones, and those that are taken."""

import warnings

import numpy as np
import pytest
from figures import HERTZ, VOLTS, grid, message
from flapwing import plot
from numpy.testing import assert_array_equal
from test_agreement import svg, texts

HINGE = [8e-5, 9e-5, 1e-4]


def drawn_alone(function, *arguments, **keywords):
    """A picture that is drawn without a warning."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return function(*arguments, **keywords)


def test_values_may_have_units():
    table = grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ, hinge_stiffness=HINGE)
    for chosen in ({"hinge_stiffness": "90 uN*m/rad"}, {"where": {"hinge_stiffness": "0.09 mN*m/rad"}}):
        named = drawn_alone(plot.heatmap, table, **chosen).collections[0].get_array()
        number = drawn_alone(plot.heatmap, table, hinge_stiffness=9e-5).collections[0].get_array()
        assert_array_equal(named, number)
    assert "`drive_voltage_pp`" in message(ValueError, plot.heatmap, table, drive_voltage_pp="100 A")
    assert "no row has drive_voltage_pp = 70 V" in message(ValueError, plot.heatmap, table, drive_voltage_pp="70 V")


def test_what_is_left_is_at_its_middle_as_in_the_command(flap, tmp_path):
    table = grid(hinge_stiffness=HINGE, drive_voltage_pp=[60.0, 80.0, 100.0, 120.0], drive_frequency=HERTZ)
    said = (
        "drawn: drive_voltage_pp = 100 V, the middle of 4 values; drive_voltage_pp=60 as a keyword chooses another, "
        'and reduce="max" draws the largest of all'
    )
    with pytest.warns(UserWarning) as told:
        ax = plot.heatmap(table)
    assert [str(each.message) for each in told] == [said]
    assert told[0].filename == __file__
    chosen = plot.heatmap(table, drive_voltage_pp=100)
    assert_array_equal(ax.collections[0].get_array(), chosen.collections[0].get_array())
    picture = svg(flap, tmp_path, table, "--kind", "map")
    assert {ax.get_xlabel(), ax.get_ylabel()} <= set(texts(picture))
    assert any("Drive voltage, peak to peak 100 V" in text for text in texts(picture))
    # A line for each value of the first axis.
    with pytest.warns(UserWarning, match="drive_voltage_pp = 100 V"):
        ax = plot.response(table, "lift_mean_mn")
    assert [line.get_label() for line in ax.lines] == ["80", "90", "100"]
    rows = (table["drive_voltage_pp"] == 100) & (table["hinge_stiffness"] == 9e-5)
    assert_array_equal(ax.lines[1].get_ydata(), table["lift_mean_mn"][rows])


def test_words_are_left_over_too():
    table = grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ)
    table = {name: np.concatenate([column, column]) for name, column in table.items()}
    table = {"lift_sign": np.repeat(["corrected", "printed"], 15), **table}
    with pytest.warns(
        UserWarning, match="drawn: lift_sign = 'printed', the middle of 2 values; lift_sign='corrected' as"
    ):
        plot.heatmap(table, x="drive_frequency", y="drive_voltage_pp")


def test_a_sample_that_is_crossed_with_axes(tmp_path):
    import flapwing

    table = flapwing.sweep(
        {
            "preset": "jafferis2016",
            "sample": {"method": "random", "n": 8, "seed": 1, "parameters": {"wing_area": {"from": 5e-5, "to": 6e-5}}},
            "axes": {"drive_voltage_pp": [150, 200, 250]},
        }
    )
    for function in (plot.scatter, plot.histogram, plot.tornado):
        with pytest.warns(UserWarning, match="drive_voltage_pp = 200 V, the middle of 3 values"):
            function(table)
    assert len(drawn_alone(plot.scatter, table, "drive_voltage_pp", "lift_mean_mn").collections[0].get_offsets()) == 24
