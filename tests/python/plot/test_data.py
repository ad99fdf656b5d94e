"""The kinds of tables that pictures take."""

import flapwing
import numpy as np
import pandas
from figures import HERTZ, VOLTS, fails, grid, legend, lines
from flapwing import analysis, plot
from numpy.testing import assert_array_equal


def test_tables_frames_mappings_and_files_draw_the_same(sweep, tmp_path):
    path = tmp_path / "rows.csv"
    sweep.to_pandas().to_csv(path, index=False)
    wanted = [line.get_ydata() for line in plot.response(sweep, "lift_mean_mn").lines]
    for same in (sweep.to_pandas(), dict(sweep), path, str(path)):
        ax = plot.response(same, "lift_mean_mn")
        assert_array_equal([line.get_ydata() for line in ax.lines], wanted)
        assert ax.get_xlabel() == "Drive frequency (Hz)"
        assert legend(ax) == ["60", "80", "100"]


def test_frames_of_polars_and_files_in_parquet_are_drawn(sweep, tmp_path):
    path = tmp_path / "rows.parquet"
    written = flapwing.sweep(sweep.meta["grid"], out=path)
    wanted = [line.get_ydata() for line in plot.response(sweep, "lift_mean_mn").lines]
    for same in (written.to_polars(), path):
        assert_array_equal([line.get_ydata() for line in plot.response(same, "lift_mean_mn").lines], wanted)


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


def test_pandas_words_and_flags_with_gaps():
    table = pandas.DataFrame(fails(grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ), [3]))
    table["status"] = table["status"].astype("category")
    table["stable"] = pandas.array([True, None] * 7 + [False], dtype="boolean")
    ax = plot.response(table, "lift_mean_mn")
    assert np.isnan(lines(ax)[0].get_ydata()[3])


def test_masked_cells_are_left_out():
    """Such as the columns of NetCDF files."""
    table = {
        "hinge_stiffness": np.array([1.0, 2.0, 3.0, 4.0]),
        "status": np.array(["periodic"] * 4),
        "lift_mean_mn": np.ma.array([1.0, -999.0, 4.0, 3.0], mask=[False, True, False, False]),
        "cycles": np.ma.array([8, 9, 9, 0], mask=[False, False, False, True]),
    }
    found = analysis.describe(table)
    assert (found["lift_mean_mn"].designs, found["lift_mean_mn"].smallest) == (3, 1.0)
    assert (found["cycles"].designs, found["cycles"].smallest) == (3, 8.0)
    (one,) = analysis.rank_correlations(table)
    assert one.designs == 3 and one.correlation == 0.5
    assert len(plot.scatter(table, "hinge_stiffness", "lift_mean_mn").collections[0].get_offsets()) == 3
    table["status"] = np.ma.array(table["status"], mask=[True, False, False, False])
    assert analysis.describe(table, "lift_mean_mn")["lift_mean_mn"].designs == 2
