"""Scatters, histograms and tornados of samples."""

import warnings

import flapwing
import numpy as np
import pytest
from figures import HERTZ, VOLTS, drawn, fails, grid, legend, message
from flapwing import analysis, plot
from numpy.testing import assert_allclose, assert_array_equal

SAMPLE = {
    "preset": "ozaki2018-large",
    "sample": {
        "n": 40,
        "method": "sobol",
        "parameters": {
            "drive_voltage_pp": {"from": "60 V", "to": "100 V"},
            "hinge_stiffness": {"from": "80 uN*m/rad", "to": "100 uN*m/rad"},
        },
    },
}


@pytest.fixture(scope="module")
def sample():
    """Forty designs that differ in voltage and hinge."""
    return flapwing.sweep(SAMPLE)


@pytest.fixture(scope="module")
def crossed():
    """Forty designs, each at three frequencies."""
    return flapwing.sweep({**SAMPLE, "axes": {"drive_frequency": [100.0, 105.0, 110.0]}})


def test_a_scatter_of_three_measures(sample):
    ax = drawn(plot.scatter(sample))
    places = np.column_stack([sample["power_mean_mw"], sample["lift_mean_mn"]])
    assert_array_equal(ax.collections[0].get_offsets(), places)
    assert_array_equal(ax.collections[0].get_array(), sample["stroke_pp_deg"])
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("Power, mean (mW)", "Lift, mean (mN)")
    assert ax.figure.axes[1].get_ylabel() == "Stroke, peak to peak (°)"
    assert not ax.lines, "no front"


def test_a_scatter_takes_other_columns(sample):
    ax = drawn(plot.scatter(sample, "drive_voltage_pp", "lift_mean_mn", color="hinge_stiffness"))
    assert ax.get_xlabel() == "Drive voltage, peak to peak (V)"
    assert ax.figure.axes[1].get_ylabel() == "Hinge stiffness (µN·m/rad)"
    ax = drawn(plot.scatter(sample, color="power_mean_mw"))
    assert ax.get_xlabel() != "Power, mean (mW)"
    table = fails(grid(centre_of_pressure=["folded", "directional"], drive_frequency=HERTZ), [2, 3])
    ax = drawn(plot.scatter(table, color="centre_of_pressure"))
    assert sum(len(each.get_offsets()) for each in ax.collections) == 8


def test_a_histogram_marks_percentiles(sample):
    ax = drawn(plot.histogram(sample))
    lift = sample["lift_mean_mn"]
    heights = [bar.get_height() for bar in ax.patches]
    assert sum(heights) == 40
    edges = [bar.get_x() for bar in ax.patches] + [ax.patches[-1].get_x() + ax.patches[-1].get_width()]
    assert_allclose(heights, np.histogram(lift, edges)[0])
    percentiles = [line.get_xdata()[0] for line in ax.lines[:3]]
    assert_allclose(percentiles, np.percentile(lift, [5, 50, 95]), rtol=1e-12)
    assert legend(ax) == [f"mean ± standard deviation: {lift.mean():.4g} ± {lift.std(ddof=1):.2g} mN"]
    ends = ax.containers[1].lines[2][0].get_segments()[0][:, 0]
    assert_allclose(ends, lift.mean() + lift.std(ddof=1) * np.array([-1, 1]), rtol=1e-12)
    assert [text.get_text().split(":")[0] for text in ax.texts] == ["5 %", "50 %", "95 %"]
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("Lift, mean (mN)", "Number of designs")
    assert drawn(plot.histogram(sample, "power_mean_mw")).get_xlabel() == "Power, mean (mW)"


def test_a_histogram_has_the_chosen_percentiles(sample):
    ax = drawn(plot.histogram(sample, percentiles=[90, 10, 2.5], legend=False))
    assert_allclose(
        [line.get_xdata()[0] for line in ax.lines[:3]], np.percentile(sample["lift_mean_mn"], [2.5, 10, 90])
    )
    assert [text.get_text().split(":")[0] for text in ax.texts] == ["2.5 %", "10 %", "90 %"]
    assert ax.get_legend() is None
    assert not drawn(plot.histogram(sample, percentiles=[])).texts
    assert "`percentiles` has 101" in message(ValueError, plot.histogram, sample, percentiles=[50, 101])
    assert "list of percentages" in message(TypeError, plot.histogram, sample, percentiles="half")


def test_statistics_need_names_of_measures(sample):
    told = message(TypeError, analysis.describe, sample, measures=3)
    assert told == '`measures` is int\nit must be a list of names such as ["lift_mean_mn"]'


def test_statistics_of_a_sample(sample):
    found = analysis.describe(sample, percentiles=[10, 50])
    assert list(found) == [name for name in sample.columns[4:] if np.isfinite(sample[name]).any()]
    values = sample["lift_mean_mn"]
    one = found["lift_mean_mn"]
    assert (one.measure, one.unit, one.designs) == ("lift_mean_mn", "mN", 40)
    assert one.mean == pytest.approx(sum(values) / 40, rel=1e-14)
    assert one.standard_deviation == pytest.approx(np.sqrt(sum((values - one.mean) ** 2) / 39), rel=1e-12)
    assert one.standard_error == pytest.approx(one.standard_deviation / np.sqrt(40), rel=1e-14)
    assert (one.smallest, one.largest) == (values.min(), values.max())
    ordered = np.sort(values)
    assert one.percentiles == pytest.approx(
        {10: ordered[3] + 0.9 * (ordered[4] - ordered[3]), 50: 0.5 * (ordered[19] + ordered[20])}, rel=1e-12
    )
    assert str(one).startswith(f"lift_mean_mn: {one.mean:.4g} ± {one.standard_deviation:.2g} mN (40 designs; 10 %: ")


def test_statistics_leave_out_designs_without_a_measure():
    table = fails(grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ), [0, 14])
    one = analysis.describe(table, "lift_mean_mn", percentiles=[])["lift_mean_mn"]
    assert one.designs == 13 and one.mean == pytest.approx(8.0) and one.percentiles == {}
    (slice_,) = analysis.describe(table, ["lift_mean_mn"], drive_voltage_pp=80).values()
    assert (slice_.smallest, slice_.largest, slice_.mean) == (6.0, 10.0, 8.0)
    single = analysis.describe(table, "lift_mean_mn", drive_voltage_pp=80, drive_frequency=95)["lift_mean_mn"]
    assert single.designs == 1 and np.isnan(single.standard_error)


def test_mistakes_in_statistics(sample):
    assert "did you mean `lift_mean_mn`?" in message(ValueError, analysis.describe, sample, "lift_mean_m")
    failed = fails(grid(drive_frequency=HERTZ), slice(None))
    assert "no row has a number for `lift_mean_mn`" in message(ValueError, analysis.describe, failed, "lift_mean_mn")
    assert analysis.describe(failed) == {}
    assert "percentages are from 0 to 100" in message(ValueError, analysis.describe, sample, percentiles=[-1])


def ranked(values):
    """Ranks of distinct values."""
    return np.argsort(np.argsort(values)).astype(float)


def test_rank_correlations_are_those_of_ranks(sample):
    found = analysis.rank_correlations(sample, "power_mean_mw")
    assert {each.parameter for each in found} == {"drive_voltage_pp", "hinge_stiffness"}
    sizes = [abs(each.correlation) for each in found]
    assert sizes == sorted(sizes, reverse=True)
    for each in found:
        pearson = np.corrcoef(ranked(sample[each.parameter]), ranked(sample["power_mean_mw"]))[0, 1]
        assert each.correlation == pytest.approx(pearson, rel=1e-12)
        assert (each.measure, each.designs) == ("power_mean_mw", 40)
    for parameters in (["hinge_stiffness"], "hinge_stiffness"):
        (one,) = analysis.rank_correlations(sample, parameters=parameters)
        assert one.parameter == "hinge_stiffness"


def test_a_tornado_of_a_sample(sample, tmp_path):
    ax = drawn(plot.tornado(sample))
    found = analysis.rank_correlations(sample)
    assert_allclose([bar.get_width() for bar in ax.patches], [each.correlation for each in found])
    names = [label.get_text() for label in ax.get_yticklabels()]
    assert names == [plot.label(each.parameter, "") for each in found]
    assert ax.get_xlabel() == (
        "Rank correlation (Spearman) with lift, mean\n40 designs; sizes below 0.31 may be chance"
    )
    file = tmp_path / "sample.csv"
    flapwing.sweep(SAMPLE, out=file)
    for path in (file, str(file)):
        assert len(plot.tornado(path, "power_mean_mw", ["hinge_stiffness"]).patches) == 1


@pytest.mark.parametrize("function", [plot.scatter, plot.histogram, plot.tornado, analysis.describe])
def test_of_axes_beside_a_sample_a_value_is_chosen(crossed, function):
    with pytest.warns(UserWarning, match="drive_frequency = 105 Hz, the middle of 3 values"):
        function(crossed)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        function(crossed, drive_frequency=105.0)


def test_an_axis_that_gives_the_colours_has_all_its_values(crossed):
    (points,) = drawn(plot.scatter(crossed, color="drive_frequency")).collections
    assert len(points.get_offsets()) == 120
    with pytest.warns(UserWarning, match="drive_frequency = 105 Hz"):
        assert len(plot.scatter(crossed).collections[0].get_offsets()) == 40


def test_a_front_has_all_designs(crossed):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        points = plot.pareto(crossed).collections[0]
    assert len(points.get_offsets()) == 120


def test_all_designs_of_a_grid_without_a_sample_are_used():
    table = grid(drive_voltage_pp=VOLTS, drive_frequency=HERTZ)
    assert sum(bar.get_height() for bar in plot.histogram(table).patches) == 15
    assert analysis.describe(table)["lift_mean_mn"].designs == 15


def test_lines_of_a_sample_are_refused(sample):
    text = message(ValueError, plot.response, sample, x="hinge_stiffness")
    assert "draw such designs with plot.scatter" in text


def test_mistakes(sample):
    assert "did you mean `lift_mean_mn`?" in message(ValueError, plot.histogram, sample, "lift_mean_m")
    assert "did you mean `lift_mean_mn`?" in message(ValueError, plot.scatter, sample, y="lift_mean_m")
    failed = fails(grid(drive_frequency=HERTZ), slice(None))
    for function in (plot.scatter, plot.histogram, plot.tornado):
        assert "no row has a number" in message(ValueError, function, failed)
    same = grid(drive_frequency=[100.0])
    assert "nothing to compare" in message(ValueError, plot.tornado, same)
    assert "choose the column" in message(ValueError, plot.histogram, {"point": np.arange(3.0)})


def test_a_large_sample_makes_no_lines_unasked(crossed):
    text = message(ValueError, plot.response, crossed)
    assert "40 lines would cover each other" in text and "draw all lines with by='drive_voltage_pp'" in text
    assert len(plot.response(crossed, by="drive_voltage_pp").lines) >= 40
