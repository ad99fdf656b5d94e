"""Measures over two parameters."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
from figures import HERTZ, VOLTS, drawn, fails, grid, legend, message
from flapwing import plot
from matplotlib.collections import PolyCollection, QuadMesh
from numpy.testing import assert_allclose, assert_array_equal


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
    assert "two axes" in message(ValueError, plot.heatmap, grid(drive_frequency=HERTZ), "lift_mean_mn")
    assert "both" in message(ValueError, plot.heatmap, table, "lift_mean_mn", x="drive_frequency", y="drive_frequency")
    assert '"linear" or "log"' in message(
        ValueError, plot.heatmap, table, "lift_mean_mn", drive_voltage_pp=60, xscale="logarithmic"
    )


def curves(refined):
    """The way up of two curves, of which each has points of its own beside the common ones."""
    places = [(80.0, [100.0, 101.0, 102.0, 103.0, *refined[0]]), (90.0, [100.0, 101.0, 102.0, 103.0, *refined[1]])]
    volts = np.concatenate([np.full(len(hertz), volts) for volts, hertz in places])
    hertz = np.concatenate([np.sort(hertz) for _, hertz in places])
    return {
        "curve": (volts > 85).astype(int),
        "drive_voltage_pp": volts,
        "branch": np.full(len(volts), "up"),
        "drive_frequency": hertz,
        "status": np.full(len(volts), "periodic", dtype="U12"),
        "lift_mean_mn": hertz,
        "power_mean_mw": hertz,
    }


@pytest.mark.parametrize("transposed", [False, True])
def test_a_map_of_refined_responses_has_no_gaps(transposed):
    table = curves(([101.25, 101.375, 101.4375], [102.75, 102.625]))
    axes = {"x": "drive_voltage_pp", "y": "drive_frequency"} if transposed else {}
    ax = drawn(plot.heatmap(table, "lift_mean_mn", branch="up", **axes))
    assert ax.get_legend() is None
    values = mesh(ax).get_array()
    values = values.T if transposed else values
    assert values.shape == (2, 9) and not np.ma.getmaskarray(values).any()
    every = np.unique(table["drive_frequency"])
    for line, volts in zip(values, (80.0, 90.0)):
        own = table["drive_frequency"][table["drive_voltage_pp"] == volts]
        assert_array_equal(line[np.isin(every, own)], own)
        # Cells between have the nearest point of their own curve.
        assert (np.abs(np.asarray(line) - every) == np.abs(every[:, None] - own).min(axis=1)).all()


def test_unsettled_rows_of_a_refined_response_are_counted_once():
    table = fails(curves(([], [101.25, 101.375, 101.4375])), [1])
    ax = drawn(plot.heatmap(table, "lift_mean_mn", branch="up"))
    assert legend(ax) == ["unsettled (1)"]


@pytest.mark.parametrize("size", [(6.4, 4.4), (3.2, 2.4), (2.4, 1.8)])
def test_the_label_of_a_colour_bar_is_no_longer_than_the_bar(size):
    table = grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ)
    table = {**table, "power_translational_mean_mw": table["lift_mean_mn"]}
    figure, ax = plt.subplots(figsize=size, layout="constrained")
    plot.heatmap(table, "power_translational_mean_mw", ax=ax)
    figure.canvas.draw()
    bar = figure.axes[1]
    assert bar.get_ylabel().replace("\n", " ") == "Translational power, mean (mW)"
    assert bar.yaxis.label.get_window_extent().height <= bar.get_window_extent().height
    assert size[1] > 4 or "\n" in bar.get_ylabel()
