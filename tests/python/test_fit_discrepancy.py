"""Fits of data that the model cannot reproduce: discrepancy, patterns in residuals, outliers, drift."""

from types import SimpleNamespace

import flapwing
import numpy as np
import pytest
from fits import PRESET, TRUE, TRUTH, readings
from flapwing.fitting import _assess, _discrepancy, _search, _structure
from flapwing.fitting._criteria import criteria
from flapwing.fitting._data import DataSet
from flapwing.fitting._noise import Noise
from flapwing.fitting._parameters import Space
from flapwing.fitting._search import Target

BOTH = ["stroke_pp_deg", "pitch_amplitude_deg"]
VOLTAGES = [110.0, 130.0, 150.0, 170.0]
POINTS = {"drive_frequency": np.tile(np.linspace(75.0, 145.0, 12), 4), "drive_voltage_pp": np.repeat(VOLTAGES, 12)}
FREE = ["hinge_stiffness", "drag_coefficient_max"]
AS_MADE = {"wing_inertia_stroke": TRUTH["wing_inertia_stroke"]}


@pytest.fixture(scope="module")
def wrong():
    """Data by another drag law, of which one voltage is held out."""
    data = readings(BOTH, noise=0.02, points=POINTS, drag_coefficient_min=1.5)
    held = {"drive_voltage_pp": (149, 151)}
    return flapwing.fit(PRESET, data, FREE, sigma="2 %", starts=1, hold_out=held, **AS_MADE)


def test_errors_intervals_and_bands_of_a_wrong_model_hold_its_discrepancy(wrong):
    assert wrong.goodness.p < 1e-6 and [one.measure for one in wrong.discrepancy] == BOTH
    assert all(one.unit == "%" and 1.0 < one.size < 10.0 for one in wrong.discrepancy)
    # Without discrepancy, 70 % of the readings of this voltage are in their bands.
    assert wrong.held_out.covered >= 0.9
    report = str(wrong)
    assert f"model discrepancy: {wrong.discrepancy[0].size:.2g} % of stroke_pp_deg and " in report
    for one in wrong.estimates.values():
        assert one.error > 0.01 * one.value
        assert one.high - one.low == pytest.approx(2 * wrong._quantile * one.error, rel=0.2)
        np.testing.assert_allclose(
            np.interp([one.low, one.high], one.profile.value, one.profile.rise), [-1.96, 1.96], atol=0.15
        )
    points = {"drive_frequency": [90.0, 120.0], "drive_voltage_pp": 150.0}
    value, reading = (wrong.predict(points, "stroke_pp_deg", reading=flag) for flag in (False, True))
    np.testing.assert_allclose(reading.error**2 - value.error**2, (0.02 * value.value) ** 2, rtol=1e-6)
    assert (value.error > 0.01 * wrong.discrepancy[0].size * value.value).all()
    plan = wrong.next_measurements(points, "drag_coefficient_max", count=1)
    assert plan.now == pytest.approx(wrong.estimates["drag_coefficient_max"].error, rel=1e-3)


def test_the_size_of_a_slow_discrepancy_is_found():
    """1000 residuals: noise of one standard error, and a sine with a root mean square of 3 standard errors."""
    phase = np.linspace(0.0, 8 * np.pi, 1000)
    scaled = np.random.default_rng(1).normal(size=1000) + 3.0 * np.sqrt(2.0) * np.sin(phase)
    layout = _structure.Layout(
        {"drive_frequency": np.geomspace(10.0, 4000.0, 1000)}, np.arange(1000), np.zeros(1000, np.intp)
    )
    name, ones = "stroke_pp_deg", np.ones(1000)
    told = {name: "absolute"}, {name: "deg"}, {name}
    found = _discrepancy.of_residuals(
        layout, {name: np.arange(1000)}, *told, ones, ones, scaled, ones[:, np.newaxis], np.array([[1e-3]])
    )
    assert [(one.unit, one.size) for one in found.listed] == [("deg", pytest.approx(3.0, rel=0.05))]


def test_the_test_for_drift_has_the_derivatives_of_its_residuals(monkeypatch):
    given = {}
    monkeypatch.setattr(
        _assess, "between_sets", lambda space, of_set, scaled, slopes: given.update(scaled=scaled, slopes=slopes) or ""
    )
    data = readings()
    found = flapwing.fit(PRESET, data, FREE, sigma="2 deg", loss="cauchy", starts=1, profile=False, **AS_MADE)
    answer = found._model.everything(found._x)
    np.testing.assert_allclose(given["scaled"], (answer.values - data["stroke_pp_deg"]) / 2.0, atol=1e-6)
    np.testing.assert_allclose(given["slopes"], answer.slopes / 2.0, rtol=1e-6)


def test_a_right_model_has_no_discrepancy():
    data = readings(BOTH, noise=0.02, points=POINTS, seed=2)
    found = flapwing.fit(PRESET, data, FREE, sigma="2 %", starts=1, profile=False, **AS_MADE)
    assert found.discrepancy == [] and found.outliers == [] and "discrepancy" not in str(found)
    unknown = flapwing.fit(PRESET, data, FREE, starts=1, profile=False, **AS_MADE)
    assert unknown.discrepancy == []


def test_estimated_standard_errors_become_discrepancy_if_residuals_have_a_pattern():
    data = readings(BOTH, noise=0.002, points=POINTS, drag_coefficient_min=1.5)
    found = flapwing.fit(PRESET, data, FREE, starts=1, profile=False, **AS_MADE)
    assert [one.unit for one in found.discrepancy] == ["deg", "deg"]
    points = {"drive_frequency": [90.0], "drive_voltage_pp": 150.0}
    value, reading = (found.predict(points, "stroke_pp_deg", reading=flag).error[0] for flag in (False, True))
    assert value == reading > found.discrepancy[0].size


def test_patterns_do_not_depend_on_the_split_into_data_sets():
    data = readings(BOTH, noise=0.02, points=POINTS, drag_coefficient_min=1.5)
    splits = [np.arange(48) // 48, np.arange(48) // 12, np.arange(48) % 4]
    found = []
    for split in splits:
        sets = [
            flapwing.Readings({name: values[split == number] for name, values in data.items()}, name=f"set {number}")
            for number in range(split.max() + 1)
        ]
        one = flapwing.fit(PRESET, sets, ["drag_coefficient_max"], sigma="2 %", starts=1, profile=False, **AS_MADE)
        found.append({(test.measure, test.parameter): test.p for test in one.goodness.structure})
        assert {part.is_structured for part in one.goodness.residuals if part.measure == "stroke_pp_deg"} == {True}
    assert list(found[0]) == [(measure, name) for measure in BOTH for name in POINTS]
    for other in found[1:]:
        assert other == pytest.approx(found[0], rel=1e-3)


@pytest.mark.parametrize("jitter", [0.0, 0.3, 1.0])
def test_patterns_along_each_parameter_are_found(jitter):
    """A pattern along the voltage alone, also if no two points share their frequency."""
    draw = np.random.default_rng(1)
    frequency, voltage = np.tile(np.arange(70.0, 150.0, 10.0), 8), np.repeat(np.arange(100.0, 180.0, 10.0), 8)
    points = {"drive_frequency": frequency + jitter * draw.uniform(0, 9, 64), "drive_voltage_pp": voltage}
    noise = draw.normal(size=64)
    layout = _structure.Layout(points, np.arange(64), np.zeros(64, np.intp))
    measures = {"stroke_pp_deg": np.arange(64)}

    def structured(scaled):
        return [one.parameter for one in _structure.tests(layout, measures, scaled) if one.is_structured]

    assert structured(noise) == []
    assert "drive_voltage_pp" in structured(0.5 * noise + np.sin((voltage - 100.0) / 15.0))


@pytest.mark.parametrize("step", [0.05, 0.5, 1.0])
def test_patterns_along_a_fine_sweep_are_found(step):
    """Steps below 0.5 % of the frequency, at two voltages whose measured values scatter by 0.1 V."""
    draw = np.random.default_rng(1)
    frequency = np.tile(100.0 + step * np.arange(41.0), 2)
    voltage = np.repeat([150.0, 170.0], 41) + draw.uniform(-0.1, 0.1, 82)
    order = draw.permutation(82)
    points = {"drive_frequency": frequency[order], "drive_voltage_pp": voltage[order]}
    layout = _structure.Layout(points, np.arange(82), np.zeros(82, np.intp))
    assert layout.varied == list(points) and layout.ranks["drive_voltage_pp"].max() == 1
    first, second = layout.pairs("drive_voltage_pp", np.arange(82))
    assert len(first) == 41
    np.testing.assert_array_equal(points["drive_frequency"][first], points["drive_frequency"][second])
    sine = 3.0 * np.sin(2.0 * np.pi * (points["drive_frequency"] - 100.0) / (40.0 * step))
    measures = {"stroke_pp_deg": np.arange(82)}
    found = {one.parameter: one for one in _structure.tests(layout, measures, sine)}
    assert found["drive_frequency"].p < 1e-8
    noise = _structure.tests(layout, measures, draw.normal(size=82))
    assert len(noise) == 2 and not any(one.is_structured for one in noise)


def test_a_parameter_that_scatters_about_one_value_does_not_vary():
    draw = np.random.default_rng(1)
    points = {"drive_frequency": np.linspace(100.0, 120.0, 41), "drive_voltage_pp": 150.0 + draw.uniform(-0.3, 0.3, 41)}
    layout = _structure.Layout(points, np.arange(41), np.zeros(41, np.intp))
    assert layout.varied == ["drive_frequency"] and len(layout.pairs("drive_frequency", np.arange(41))[0]) == 40


@pytest.mark.parametrize("loss", ["linear", "soft_l1"])
def test_outliers_are_listed(loss):
    data = readings()
    data["stroke_pp_deg"][[3, 20]] *= [1.6, 0.7]
    found = flapwing.fit(PRESET, data, list(TRUE), sigma="3 %", loss=loss, starts=1, profile=False)
    assert sorted(one.row for one in found.outliers) == [4, 21]
    assert found.outliers[0].row == 4 and found.outliers[0].residual < -8
    assert f"set 1 row 4 stroke_pp_deg ({found.outliers[0].residual:+.1f})" in str(found)
    if loss == "soft_l1":
        # Outliers are not a discrepancy of the model.
        assert found.discrepancy == []


def test_a_drift_between_data_sets_is_explained_by_a_parameter():
    sets = [
        flapwing.Readings(readings(hinge_stiffness=TRUTH["hinge_stiffness"] * factor, seed=seed), name=f"day {seed}")
        for seed, factor in enumerate([0.95, 1.0, 1.05])
    ]
    found = flapwing.fit(PRESET, sets, FREE, sigma="3 %", starts=1, profile=False, **AS_MADE)
    assert found.drifting == "hinge_stiffness"
    assert "data sets disagree: hinge_stiffness explains the difference best" in str(found)
    free = {"hinge_stiffness": flapwing.FreeParameter(per_set=True), "drag_coefficient_max": None}
    apart = flapwing.fit(PRESET, sets, free, sigma="3 %", starts=1, profile=False, **AS_MADE)
    assert apart.drifting == "" and apart.discrepancy == []


def test_a_parameter_that_ends_at_zero_leaves_the_errors_of_others_finite():
    data = readings(BOTH, noise=0.02, seed=3)
    free = {"drag_coefficient_max": None, "hinge_damping": (0, 1e-9)}
    found = flapwing.fit(PRESET, data, free, sigma="2 %", starts=1, hinge_stiffness=TRUTH["hinge_stiffness"], **AS_MADE)
    damping = found.estimates["hinge_damping"]
    assert damping.at_bound and damping.open_below and 0.0 <= damping.value < 1e-15
    # The profile and the derivatives give about the same limit.
    assert 0.5 < damping.high / (1.96 * damping.error) < 1.0 and np.isfinite(found.covariance).all()
    points = {"drive_frequency": [100.0, 120.0], "drive_voltage_pp": 140.0}
    assert np.isfinite(found.predict(points, "lift_mean_mn").error).all()
    plan = found.next_measurements(points, "hinge_damping", count=2)
    assert plan.errors[1] < plan.now == pytest.approx(damping.error, rel=0.01)
    # The derivative at zero is the derivative nearby.
    model = found._model
    zero, near = found._x.copy(), found._x.copy()
    zero[1], near[1] = model.space.low[1], model.space.low[1] + 0.01
    slopes = [model.at([x], rtol=1e-6)[0].slopes[:, 1] for x in (zero, near)]
    np.testing.assert_allclose(slopes[0], slopes[1], atol=0.05 * np.abs(slopes[1]).max())


def test_readings_that_are_held_out_run_only_once():
    data = readings(points=POINTS)
    effort = {}
    for held in (None, [{"drive_voltage_pp": (None, 125)}, {"drive_frequency": (100, None)}]):
        found = flapwing.fit(PRESET, data, FREE, sigma="3 %", starts=1, profile=False, hold_out=held, **AS_MADE)
        effort[held is None] = found.effort.points
    assert found.held_out.count == 12 + 3 * 8 and found.goodness.freedom == 12 - 2
    # 12 of 48 points run in each step, and all points at the end.
    assert effort[False] < 0.45 * effort[True]


def test_a_data_set_that_is_held_out_is_not_among_the_residuals():
    sets = [flapwing.Readings(readings(seed=seed), name=name) for seed, name in enumerate(["first", "second"])]
    found = flapwing.fit(PRESET, sets, FREE, sigma="3 %", starts=1, profile=False, hold_out="second", **AS_MADE)
    assert "30 readings held out" in str(found) and "nan" not in str(found) and "\nsecond" not in str(found)


def test_a_device_has_the_derived_parameters_of_the_fit(tmp_path):
    grid = {"preset": PRESET, "derived": {"wing_inertia_stroke": "4.5e-11 * hinge_stiffness / 1.5e-6"}}
    found = flapwing.fit(grid, readings(), ["hinge_stiffness"], sigma="3 %", starts=1, profile=False)
    found.write_device(tmp_path / "bee.toml")
    points = {"drive_frequency": [100.0, 110.0], "drive_voltage_pp": 150.0}
    again = flapwing.evaluate(tmp_path / "bee.toml", points)["stroke_pp_deg"]
    np.testing.assert_allclose(again, found.predict(points, "stroke_pp_deg").value, rtol=1e-4)
    grid["derived"] = {"wing_inertia_stroke": "5e-11 * drive_frequency / 100"}
    varied = flapwing.fit(grid, readings(), ["hinge_stiffness"], sigma="3 %", starts=1, profile=False)
    with pytest.raises(ValueError, match="`wing_inertia_stroke` differs between the readings, .*\nuse the grid"):
        varied.write_device(tmp_path / "other.toml")


def test_next_measurements_are_distinct_and_may_be_of_other_measures():
    found = flapwing.fit(PRESET, readings(), FREE, sigma="3 %", starts=1, profile=False, **AS_MADE)
    candidates = {"drive_frequency": np.linspace(70.0, 150.0, 5), "drive_voltage_pp": 160.0}
    distinct = found.next_measurements(candidates, "drag_coefficient_max", count=9)
    assert len({point["drive_frequency"] for point in distinct.points}) == len(distinct.points) == 5
    again = found.next_measurements(candidates, "drag_coefficient_max", count=9, repeats=True)
    assert len(again.points) == 9 and again.errors[4] <= distinct.errors[4]
    sigma = {"pitch_amplitude_deg": "0.1 deg"}
    other = found.next_measurements(candidates, "drag_coefficient_max", count=9, sigma=sigma)
    assert other.measures[0] == "pitch_amplitude_deg" and len(other.points) == 9
    with pytest.raises(ValueError, match="no readings of `lift_mean_mn`, .*\nchoose among .*sigma={'lift_mean_mn'"):
        found.next_measurements(candidates, "drag_coefficient_max", measures=["lift_mean_mn"])


def test_the_report_advises_more_starts():
    found = flapwing.fit(PRESET, readings(), FREE, sigma="3 %", starts=1, profile=False, **AS_MADE)
    for starts, agreed, advice in [(1, 1, False), (8, 1, True), (8, 0, True), (8, 3, False)]:
        found.effort = flapwing.fitting.Effort(starts, agreed, 0, 0, 0.0)
        assert f"{agreed} of {starts} starts ended at this fit" in str(found)
        assert ("fit again with starts=32" in str(found)) == advice


def mixed_sets():
    """90 readings with a standard error of 0.1, and 10 readings without a standard error and with large residuals."""
    draw, sets = np.random.default_rng(1), []
    for name, count, noise in [("A", 90, Noise("absolute", 0.1)), ("B", 10, Noise("unknown"))]:
        measured = {"stroke_pp_deg": 50.0 + draw.normal(0.0, 0.1 if name == "A" else 1.85, count)}
        sets.append(DataSet(name, {}, measured, {"stroke_pp_deg": noise}, None, "drive_frequency"))
    return sets


def test_unknown_standard_errors_are_estimated_from_their_own_readings():
    sets, values = mixed_sets(), np.full(100, 50.0)
    readings = np.concatenate([one.measured["stroke_pp_deg"] for one in sets])
    answer = SimpleNamespace(values=values, slopes=np.zeros((100, 0)))
    own, guesses = np.sqrt(np.mean((readings[90:] - 50.0) ** 2)), {"stroke_pp_deg": 1.0}
    everything = np.ones(100, np.bool_)
    target = Target(readings, np.ones(100), everything, "linear")
    _search.new_guesses(sets, target, everything, answer, 2, guesses)
    assert guesses["stroke_pp_deg"] == pytest.approx(own / np.sqrt(0.98)) and own > 1.0
    likely = criteria(sets, Space([]), np.zeros(0), answer, everything)
    np.testing.assert_allclose(likely.sigma, np.repeat([0.1, own], [90, 10]))
    assert likely.parameters == 1
    # If all readings without a standard error are held out, the other readings determine the standard error.
    rest = np.arange(100) < 90
    other = np.sqrt(np.mean((readings[:90] - 50.0) ** 2))
    _search.new_guesses(sets, target, rest, answer, 0, guesses)
    assert guesses["stroke_pp_deg"] == pytest.approx(other)
    likely = criteria(sets, Space([]), np.zeros(0), answer, rest)
    np.testing.assert_allclose(likely.sigma, np.repeat([0.1, other], [90, 10]))
    assert likely.parameters == 0


@pytest.mark.parametrize("flip", [False, True])
def test_the_order_of_data_sets_does_not_change_their_discrepancy(flip):
    """A data set without standard errors does not make the discrepancy of the other data set unknown."""
    data = readings(BOTH, noise=0.02, points=POINTS, drag_coefficient_min=1.5)
    halves = [{name: values[place::2] for name, values in data.items()} for place in range(2)]
    sets = [flapwing.Readings(halves[0], name="known", sigma="2 %"), flapwing.Readings(halves[1], name="unknown")]
    options = {"starts": 1, "profile": False, **AS_MADE}
    found = flapwing.fit(PRESET, sets[::-1] if flip else sets, ["drag_coefficient_max"], **options)
    alone = flapwing.fit(PRESET, data, ["drag_coefficient_max"], sigma="2 %", **options)
    assert [one.unit for one in found.discrepancy] == ["%", "%"]
    sizes = [one.size for one in alone.discrepancy]
    assert [one.size for one in found.discrepancy] == pytest.approx(sizes, rel=0.05)
    assert min(found._guesses.values()) > 0.0


def test_a_measure_that_is_held_out_has_no_discrepancy():
    data = readings(BOTH, noise=0.02, points=POINTS, drag_coefficient_min=1.5)
    sets = [
        flapwing.Readings({**{name: data[name] for name in POINTS}, measure: data[measure]}, name=measure)
        for measure in BOTH
    ]
    options = {"sigma": "2 %", "starts": 1, "profile": False, **AS_MADE}
    found = flapwing.fit(PRESET, sets, ["hinge_stiffness"], hold_out=BOTH[1], **options)
    assert [one.measure for one in found.discrepancy] == BOTH[:1] and found.held_out.count == 48
