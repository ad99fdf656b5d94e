"""Measures over two parameters."""

import flapwing
import matplotlib.pyplot as plt
import numpy as np
import pytest
from figures import HERTZ, VOLTS, drawn, fails, grid, legend, message
from flapwing import plot
from matplotlib.collections import PathCollection, PolyCollection, QuadMesh, TriMesh
from numpy.testing import assert_allclose, assert_array_equal
from scipy.spatial import ConvexHull


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
    stiffness = np.geomspace(5e-5, 5e-4, 5)
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
    # As in `flap plot`, equal ratios within a factor of ten are on a linear axis.
    narrow = grid(hinge_stiffness=np.geomspace(5e-5, 2e-4, 5), drive_frequency=HERTZ)
    assert plot.heatmap(narrow, "lift_mean_mn").get_yscale() == "linear"


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


CUBE = {"hinge_stiffness": [6e-5, 8e-5, 9e-5], "drive_voltage_pp": VOLTS, "drive_frequency": HERTZ}


@pytest.mark.parametrize(("how", "function"), [("max", np.nanmax), ("min", np.nanmin), ("mean", np.nanmean)])
def test_axes_that_are_not_drawn_are_reduced(how, function):
    table = grid(**CUBE)
    table["lift_mean_mn"] = np.random.default_rng(2).uniform(1.0, 9.0, 45)
    # One cell has no value at one stiffness, and another at all three.
    table = fails(table, [7, 3, 18, 33])
    ax = drawn(plot.heatmap(table, "lift_mean_mn", y="drive_voltage_pp", reduce=how))
    with np.errstate(all="ignore"), pytest.warns(RuntimeWarning):
        expected = function(table["lift_mean_mn"].reshape(3, 3, 5), axis=0)
    values = mesh(ax).get_array()
    assert_allclose(values.filled(np.nan), expected, rtol=1e-14)
    assert legend(ax) == ["unsettled (1)"]
    across = plot.heatmap(table, "lift_mean_mn", x="drive_frequency", y="hinge_stiffness", reduce=how)
    with np.errstate(all="ignore"):
        assert_allclose(mesh(across).get_array(), function(table["lift_mean_mn"].reshape(3, 3, 5), axis=1), rtol=1e-14)


def test_the_best_cell_is_marked_with_its_parameters():
    table = grid(**CUBE)
    table["lift_mean_mn"] = np.random.default_rng(2).uniform(1.0, 9.0, 45)
    table["power_mean_mw"] = np.random.default_rng(3).uniform(1.0, 9.0, 45)
    for measure, how, row in (
        ("lift_mean_mn", "max", table["lift_mean_mn"].argmax()),
        ("lift_mean_mn", "min", table["lift_mean_mn"].argmin()),
        ("power_mean_mw", "min", table["power_mean_mw"].argmin()),
    ):
        ax = drawn(plot.heatmap(table, measure, y="drive_voltage_pp", reduce=how, annotate=True))
        (star,) = ax.lines
        place = (table["drive_frequency"][row], table["drive_voltage_pp"][row])
        assert (star.get_xdata()[0], star.get_ydata()[0]) == place
        unit = measure[-2:].replace("n", "N").replace("w", "W")
        name = "lift, mean" if "lift" in measure else "power, mean"
        assert legend(ax)[-1].split("\n") == [
            f"best {name}: {table[measure][row]:.4g} {unit}",
            f"  drive frequency: {place[0]:g} Hz",
            f"  drive voltage, peak to peak: {place[1]:g} V",
            f"  hinge stiffness: {1e6 * table['hinge_stiffness'][row]:.4g} µN·m/rad",
        ]
    # Less power is better, and a mean has no stiffness.
    ax = plot.heatmap(table, "power_mean_mw", y="drive_voltage_pp", reduce="mean", annotate=True)
    means = table["power_mean_mw"].reshape(3, 3, 5).mean(axis=0)
    line, column = np.unravel_index(means.argmin(), means.shape)
    assert (ax.lines[0].get_xdata()[0], ax.lines[0].get_ydata()[0]) == (HERTZ[column], VOLTS[line])
    assert len(legend(ax)[-1].split("\n")) == 3


def test_the_best_of_the_rows_that_a_condition_allows():
    table = grid(**CUBE)
    table["allowed"] = np.arange(45) % 2 == 0
    ax = plot.heatmap(table, "lift_mean_mn", y="drive_voltage_pp", reduce="max", allowed=True)
    expected = np.where(table["allowed"], table["lift_mean_mn"], np.nan).reshape(3, 3, 5)
    assert_array_equal(mesh(ax).get_array(), np.nanmax(expected, axis=0))


def test_reduce_is_named_where_it_helps():
    table = grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ)
    twice = {name: np.tile(column, 2) for name, column in table.items()}
    text = message(ValueError, plot.heatmap, twice, "lift_mean_mn", x="drive_frequency", y="drive_voltage_pp")
    assert text.endswith('or combine these rows with reduce="max", "min" or "mean"')
    with pytest.warns(UserWarning, match='and reduce="max" draws the largest of all'):
        plot.heatmap(grid(**CUBE), "lift_mean_mn")
    assert 'it must be "max", "min" or "mean"' in message(ValueError, plot.heatmap, table, reduce="median")


def scattered(count=60):
    """A plane over random points: linear interpolation is exact."""
    rng = np.random.default_rng(4)
    hertz, stiffness = rng.uniform(90.0, 110.0, count), rng.uniform(6e-5, 9e-5, count)
    return {
        "hinge_stiffness": stiffness,
        "drive_frequency": hertz,
        "status": np.array(["periodic"] * count, dtype="U12"),
        "lift_mean_mn": 1.0 + 0.1 * (hertz - 90.0) + 2e4 * stiffness,
        "power_mean_mw": hertz,
    }


def triangles(ax):
    return next(each for each in ax.collections if isinstance(each, TriMesh))


def dots(ax):
    return next(each for each in ax.collections if isinstance(each, PathCollection))


def test_points_that_form_no_grid_are_triangulated():
    table = scattered()
    ax = drawn(plot.heatmap(table, "lift_mean_mn"))
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("Drive frequency (Hz)", "Hinge stiffness (µN·m/rad)")
    assert_allclose(dots(ax).get_offsets(), np.column_stack([table["drive_frequency"], 1e6 * table["hinge_stiffness"]]))
    assert_array_equal(dots(ax).get_array(), table["lift_mean_mn"])
    assert_array_equal(triangles(ax).get_array(), table["lift_mean_mn"])
    # The triangles are a Delaunay triangulation in shares of the ranges: they fill almost the whole hull.
    mesh_ = triangles(ax)._triangulation
    x, y = mesh_.x, mesh_.y
    corners = mesh_.get_masked_triangles()
    a, b, c = (np.column_stack([x, y])[corners[:, i]] for i in range(3))
    area = 0.5 * np.abs(np.cross(np.c_[b - a, 0 * b[:, 0]], np.c_[c - a, 0 * b[:, 0]])[:, 2]).sum()
    hull = ConvexHull(np.column_stack([x, y])).volume
    assert 0.97 * hull < area <= hull * (1 + 1e-12)


def test_triangles_with_an_unknown_corner_are_left_out():
    table = fails(fails(scattered(), [0, 1, 2]), [5], "subharmonic")
    ax = drawn(plot.heatmap(table, "lift_mean_mn", annotate=True))
    assert legend(ax)[:2] == ["unsettled (3)", "subharmonic (1)"]
    corners = triangles(ax)._triangulation.get_masked_triangles()
    assert not np.isin(corners, [0, 1, 2, 5]).any() and len(corners) > 60
    assert len(dots(ax).get_offsets()) == 56
    best = np.nanargmax(table["lift_mean_mn"])
    assert ax.lines[-1].get_xdata()[0] == table["drive_frequency"][best]


def test_a_sample_is_triangulated_and_a_grid_with_gaps_is_not(sweep):
    rows = flapwing.sweep(
        {
            "preset": "ozaki2018-large",
            "sample": {
                "method": "sobol",
                "n": 16,
                "parameters": {"drive_voltage_pp": {"from": 60, "to": 100}, "drive_frequency": {"from": 95, "to": 115}},
            },
        }
    )
    ax = drawn(plot.heatmap(rows, "lift_mean_mn", xscale="log"))
    assert len(dots(ax).get_offsets()) == 16 and ax.get_xscale() == "log"
    mesh(plot.heatmap(sweep[[0, 7, 14]], "lift_mean_mn"))  # cells
    line = {**scattered(), "hinge_stiffness": scattered()["drive_frequency"] * 1e-6}
    text = message(ValueError, plot.heatmap, line, "lift_mean_mn", x="drive_frequency", y="hinge_stiffness")
    assert "on one line\ndraw them with plot.scatter" in text


def test_a_refined_grid_is_triangulated():
    fine = flapwing.sweep(
        {
            "preset": "ozaki2018-large",
            "axes": {
                "drive_voltage_pp": {"from": 60, "to": 100, "n": 5},
                "drive_frequency": {"from": 95, "to": 115, "n": 9},
            },
        }
    )
    volts, hertz = fine["drive_voltage_pp"], fine["drive_frequency"]
    coarse = np.isin(volts, [60, 80, 100]) & np.isin(hertz, [95, 100, 105, 110, 115])
    refined = fine[coarse | ((volts >= 80) & (hertz <= 105))]
    # As `[refine]` writes it: the axes have the values of the grid file.
    refined.axes = [{"drive_voltage_pp": np.array([60.0, 80.0, 100.0])}, {"drive_frequency": np.array(HERTZ)}]
    ax = drawn(plot.heatmap(refined, "lift_mean_mn"))
    assert len(dots(ax).get_offsets()) == len(refined) and ax.get_legend() is None
    # Lines are drawn for the values of the grid file, through all of their points.
    lines = plot.response(refined, "lift_mean_mn").lines
    assert [line.get_label() for line in lines] == ["60", "80", "100"]
    assert [len(line.get_xdata()) for line in lines] == [5, 7, 7]
    assert all(np.isfinite(line.get_ydata()).all() for line in lines)
