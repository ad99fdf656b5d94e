"""Batches of points."""

import time

import flapwing
import numpy as np
import pandas
import polars
import pyarrow
import pytest
from compare import is_same

PRESET = "ozaki2018-large"
FREQUENCIES = np.linspace(95, 120, 21)


def test_rows_are_those_of_single_runs_bit_for_bit():
    stiffness = np.linspace(8e-5, 1.2e-4, 21)
    table = flapwing.evaluate(PRESET, {"drive_frequency": FREQUENCIES, "hinge_stiffness": stiffness}, rtol=1e-5)
    assert table["point"].tolist() == list(range(21))
    for row, (frequency, spring) in enumerate(zip(FREQUENCIES, stiffness)):
        alone = flapwing.run(PRESET, drive_frequency=frequency, hinge_stiffness=spring, rtol=1e-5)
        for name, value in alone.items():
            if name != "reason":
                assert is_same(value, table[name][row]), name


def test_a_row_does_not_depend_on_its_neighbours():
    whole = flapwing.evaluate(PRESET, {"drive_frequency": FREQUENCIES})
    backwards = flapwing.evaluate(PRESET, {"drive_frequency": FREQUENCIES[::-1]}, threads=1)
    np.testing.assert_array_equal(whole["lift_mean_mn"], backwards["lift_mean_mn"][::-1])


@pytest.mark.parametrize(
    "columns",
    [
        {"drive_frequency": [100, 105], "drive_voltage_pp": 80},
        {"drive_frequency": np.array([100, 105], dtype=np.int32), "drive_voltage_pp": np.float32(80)},
        {"drive_voltage_pp": "80 V", "drive_frequency": ["100 Hz", "0.105 kHz"]},
        pandas.DataFrame({"drive_frequency": [100.0, 105.0], "drive_voltage_pp": [80.0, 80.0]}),
        {"drive_frequency": pandas.Series([100, 105], index=[7, 8]), "drive_voltage_pp": (80.0, "80 V")},
        flapwing.sweep(
            {"preset": PRESET, "axes": {"drive_voltage_pp": [80], "drive_frequency": [100, 105]}}
        ).to_pandas()[["drive_voltage_pp", "drive_frequency"]],
    ],
)
def test_columns_come_in_many_shapes(columns):
    expected = flapwing.evaluate(PRESET, {"drive_frequency": [100.0, 105.0]}, drive_voltage_pp=80)
    table = flapwing.evaluate(PRESET, columns)
    np.testing.assert_array_equal(table["lift_mean_mn"], expected["lift_mean_mn"])


def test_options_and_constants():
    table = flapwing.evaluate(PRESET, {"lift_sign": ["corrected", "printed"]}, drive_frequency="105 Hz")
    assert table["lift_sign"].tolist() == ["corrected", "printed"]
    assert table["lift_mean_mn"][0] != table["lift_mean_mn"][1]
    assert len(flapwing.evaluate(PRESET, {"lift_sign": "printed", "drive_frequency": 105})) == 1
    assert len(flapwing.evaluate(PRESET, {"drive_frequency": []})) == 0
    assert table.meta["keywords"] == {"drive_frequency": "105 Hz"}


def test_a_parameter_is_a_column_or_a_keyword():
    for columns in ({"drive_frequency": [100.0]}, {"drive_frequency": 100.0, "hinge_stiffness": [1e-4]}):
        with pytest.raises(ValueError, match="`drive_frequency` is a column and a keyword: keep one of them"):
            flapwing.evaluate(PRESET, columns, drive_frequency=110)


@pytest.mark.parametrize(
    "values",
    [
        pandas.array([100, None, 110], dtype="Int64"),
        pandas.Series([100.0, None, 110.0], dtype="Float64"),
        polars.Series([100.0, None, 110.0]),
        pyarrow.array([100.0, None, 110.0]),
        pyarrow.chunked_array([[100.0, None], [110.0]]),
    ],
    ids=lambda values: type(values).__name__,
)
def test_nulls_are_refused(values):
    with pytest.raises(
        ValueError, match="`drive_frequency` has 1 null of 3 values, but a point needs all of them\nleave"
    ):
        flapwing.evaluate(PRESET, {"drive_frequency": values})
    time = np.array([0.0, 0.004, 0.01])
    with pytest.raises(ValueError, match=r"`waveform\['wave'\]` has 1 null of 3 values"):
        flapwing.run(PRESET, waveform={"time_s": time, "wave": values})


def test_ragged_lists_and_lazy_frames_are_told_in_two_lines():
    for call in (
        lambda: flapwing.evaluate(PRESET, {"drive_frequency": [[100.0], [105.0, 110.0]]}),
        lambda: flapwing.evaluate(PRESET, polars.LazyFrame({"drive_frequency": [100.0]})),
        lambda: flapwing.sweep({"preset": PRESET, "zip": polars.LazyFrame({"drive_frequency": [100.0]})}),
        lambda: flapwing.run(PRESET, initial_state=polars.LazyFrame({"pitch_rad": [0.1]})),
    ):
        with pytest.raises(TypeError) as caught:
            call()
        assert len(str(caught.value).splitlines()) == 2, caught.value


def test_masked_values_are_refused():
    masked = np.ma.masked_array([100.0, 105.0, 110.0], mask=[False, True, False])
    with pytest.raises(ValueError, match="`drive_frequency` has 1 masked of 3 values"):
        flapwing.evaluate(PRESET, {"drive_frequency": masked})
    with pytest.raises(ValueError, match="`hinge_stiffness` has 1 masked of 1 values"):
        flapwing.evaluate(PRESET, {"drive_frequency": [100.0], "hinge_stiffness": np.ma.masked})
    whole = flapwing.evaluate(PRESET, {"drive_frequency": np.ma.masked_array([100.0, 105.0])})
    assert whole["drive_frequency"].tolist() == [100, 105]
    assert len(flapwing.evaluate(PRESET, {"drive_frequency": masked.compressed()})) == 2


def test_values_out_of_range_are_rows():
    table = flapwing.evaluate(PRESET, {"drive_frequency": [105, -5, np.nan, np.inf, 0, 106]})
    assert table["status"].tolist() == ["periodic", "invalid", "invalid", "invalid", "invalid", "periodic"]
    assert np.isnan(table["lift_mean_mn"][1:5]).all()
    reasons = dict(table.meta["invalid"])
    assert reasons[1] == "`drive_frequency` is computed as -5.0 Hz, but must be more than zero"
    assert reasons[2] == "`drive_frequency` is computed as not a number"


def test_a_grid_without_axes_is_a_design():
    grid = {
        "preset": PRESET,
        "derived": {"hinge_stiffness": "1e-6 * drive_frequency"},
        "where": {"low": "drive_frequency < 110"},
        "measure": {"double": "2 * lift_mean_mn"},
    }
    table = flapwing.evaluate(grid, {"drive_frequency": [100, 120, 105]})
    assert table["point"].tolist() == [0, 2] and table.meta["excluded"] == 1
    np.testing.assert_array_equal(table["hinge_stiffness"], 1e-6 * table["drive_frequency"])
    np.testing.assert_array_equal(table["double"], 2 * table["lift_mean_mn"])


def test_a_grid_with_axes_is_run_for_every_row():
    grid = {"preset": PRESET, "axes": {"drive_frequency": [100, 110]}, "output": {"columns": ["lift_mean_mn"]}}
    stiffness = [8e-5, 9e-5, 1e-4]
    table = flapwing.evaluate(grid, {"hinge_stiffness": stiffness, "drive_voltage_pp": "80 V"})
    assert table["point"].tolist() == list(range(6))
    assert table["hinge_stiffness"].tolist() == np.repeat(stiffness, 2).tolist()
    assert table["drive_frequency"].tolist() == [100, 110] * 3
    lift = table.to_xarray()["lift_mean_mn"]
    assert lift.dims == ("row", "drive_frequency") and lift["hinge_stiffness"].dims == ("row",)
    alone = flapwing.run(PRESET, hinge_stiffness=9e-5, drive_frequency=110, drive_voltage_pp=80)
    assert lift[1, 1] == alone["lift_mean_mn"]
    huge = {"preset": PRESET, "axes": {"air_density": {"from": 1, "to": 2, "n": 4 * 10**18}}}
    with pytest.raises(ValueError, match="too many points"):
        flapwing.evaluate(huge, {"hinge_stiffness": stiffness})


def test_each_design_at_its_own_resonance():
    grid = {
        "preset": "ozaki2018-small",
        "params": {"drive_frequency": "resonance"},
        "resonance": {"from": 150, "to": 250},
    }
    table = flapwing.evaluate(grid, {"drive_voltage_pp": [20.0, 30.0]})
    assert ((table["resonance_hz"] > 180) & (table["resonance_hz"] < 210)).all()


def test_a_model_needs_all_its_parameters():
    with pytest.raises(ValueError, match="model `direct-drive` has no default values: also give drive_voltage_pp, "):
        flapwing.evaluate("direct-drive", {"drive_frequency": [100.0]})
    values = {
        name: p.value
        for name, p in flapwing.params(PRESET).items()
        if p.is_number or p.options and isinstance(p.value, str)
    }
    table = flapwing.evaluate("direct-drive", {**values, "drive_frequency": FREQUENCIES})
    expected = flapwing.evaluate(PRESET, {"drive_frequency": FREQUENCIES})
    np.testing.assert_array_equal(table["lift_mean_mn"], expected["lift_mean_mn"])


@pytest.mark.parametrize(
    ("design", "columns", "error", "says"),
    [
        (PRESET, {"drive_frequenc": [1.0]}, ValueError, "did you mean `drive_frequency`?"),
        ("ozaki2018-larg", {"drive_frequency": [1.0]}, ValueError, "did you mean `ozaki2018-large`?"),
        (PRESET, {}, ValueError, "there are no columns"),
        (PRESET, {"drive_frequency": [1.0, 2.0], "wing_length": [1.0]}, ValueError, "columns differ in length"),
        (PRESET, {"drive_frequency": [[1.0]]}, ValueError, "one dimension, not 2"),
        (PRESET, {"drive_frequency": ["100 V"]}, ValueError, "`drive_frequency`"),
        (PRESET, {"lift_sign": ["prined"]}, ValueError, "did you mean `printed`?"),
        (PRESET, {"lift_sign": [1.0]}, TypeError, "`lift_sign` must be one of"),
        (PRESET, {"drive_frequency": [True]}, TypeError, "`drive_frequency` must be a number in Hz"),
        (PRESET, {"drive_frequency": True}, TypeError, "`drive_frequency` must be a number"),
        (PRESET, {"drive_frequency": [True, 105.0]}, TypeError, "`drive_frequency` must be a number in Hz"),
        (PRESET, {"drive_frequency": [np.bool_(True), 105.0]}, TypeError, "`drive_frequency` must be a number in Hz"),
        (PRESET, {"rtol": [1e-6]}, ValueError, "`rtol` is a solver setting, not a parameter"),
        (PRESET, {"drive_frequency": [None]}, TypeError, "`drive_frequency` must be a number in Hz"),
        (
            {"preset": PRESET, "axes": {"wing_length": [0.03]}},
            {"wing_length": [1]},
            ValueError,
            "the grid varies or derives it",
        ),
        (
            {"preset": PRESET, "derived": {"wing_length": "0.03"}},
            {"wing_length": [1]},
            ValueError,
            "the grid varies or derives it",
        ),
    ],
)
def test_what_is_refused(design, columns, error, says):
    with pytest.raises(error) as caught:
        flapwing.evaluate(design, columns)
    assert says in str(caught.value)


def test_keywords_do_not_compete_with_the_grid():
    with pytest.raises(ValueError, match="`wing_length` is set here, but the grid varies or derives it"):
        flapwing.evaluate(
            {"preset": PRESET, "derived": {"wing_length": "0.03"}}, {"drive_frequency": [1]}, wing_length=1
        )


def test_progress_is_told():
    told = []
    flapwing.evaluate(PRESET, {"drive_frequency": FREQUENCIES}, progress=lambda *counts: told.append(counts))
    assert told[-1] == (21, 21) and {points for _, points in told} == {21}


def fastest(call):
    """The shortest time (s) of several calls: others on the machine make it longer, never shorter."""

    def once():
        begin = time.perf_counter()
        call()
        return time.perf_counter() - begin

    return min(once() for _ in range(20))


def test_one_point_costs_about_what_run_costs():
    alone = fastest(lambda: flapwing.run(PRESET, drive_frequency=105.0))
    batch = fastest(lambda: flapwing.evaluate(PRESET, {"drive_frequency": [105.0]}))
    assert batch < 3 * alone + 0.0005


@pytest.mark.parametrize("points", [1, 2, 3, 5])
def test_few_points_have_the_rows_of_many(points):
    few = flapwing.evaluate(PRESET, {"drive_frequency": FREQUENCIES[:points]}, threads=2)
    many = flapwing.evaluate(PRESET, {"drive_frequency": FREQUENCIES})
    for name in many:
        np.testing.assert_array_equal(few[name], many[name][:points])
