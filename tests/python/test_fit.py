"""Fits of parameters to readings."""

import csv
import pickle

import flapwing
import numpy as np
import pandas
import pytest

PRESET = "jafferis2016"
TRUE = {"hinge_stiffness": 1.15, "wing_inertia_stroke": 0.93, "drag_coefficient_max": 0.90}
TRUTH = {name: ratio * flapwing.params(PRESET)[name].value for name, ratio in TRUE.items()}
FREQUENCY, VOLTAGE = np.tile(np.linspace(70.0, 150.0, 15), 2), np.repeat([120.0, 160.0], 15)
POINTS = {"drive_frequency": FREQUENCY, "drive_voltage_pp": VOLTAGE}


def readings(measures=("stroke_pp_deg",), noise=0.03, seed=1, points=POINTS, **truth):
    table = flapwing.evaluate(PRESET, points, measures=list(measures), **{**TRUTH, **truth})
    draw = np.random.default_rng(seed)
    return {**points, **{name: table[name] * (1 + draw.normal(0.0, noise, len(table))) for name in measures}}


@pytest.fixture(scope="module")
def found():
    return flapwing.fit(PRESET, readings(), list(TRUE), sigma="3 %", starts=3)


def test_a_fit_finds_the_truth(found):
    for name, value in TRUTH.items():
        one = found.estimates[name]
        assert one.is_known and not one.at_bound
        assert abs(one.value - value) < 3.5 * one.error
        assert one.low < one.value < one.high
        # Well known parameters have profiles that are about straight.
        assert one.high - one.low == pytest.approx(2 * 1.96 * one.error, rel=0.15)
    assert found.converged and found.indistinct == [] and found.unsettled == []
    assert found.goodness.freedom == 27 and 0.001 < found.goodness.p < 0.999 and not found.goodness.is_structured
    assert found.effort.agreed >= 2
    row = flapwing.run(PRESET, drive_frequency=100.0, drive_voltage_pp=160.0, **found.values)
    assert row["status"] == "periodic"


def test_the_report_tells_all(found):
    report = str(found)
    for told in ["hinge_stiffness", "chi-square", "best known", "worst known", "correlations", "set 1", "right-hand sides"]:
        assert told in report
    assert "<table>" in found._repr_html_() and "drag_coefficient_max" in repr(found)
    np.testing.assert_allclose(np.diag(found.correlations), 1.0)
    errors = [one.error for one in found.estimates.values()]
    np.testing.assert_allclose(np.sqrt(np.diag(found.covariance)), errors)


def test_a_fit_is_the_same_for_any_number_of_threads():
    one, two = (
        flapwing.fit(PRESET, readings(), list(TRUE), sigma="3 %", starts=2, profile=False, threads=threads) for threads in (1, 2)
    )
    assert one.values == two.values


def test_intervals_cover_the_truth():
    """A small version of examples/python/fit_coverage.py: of 24 intervals 95 % should hold the truth. If they do, 18
    or fewer of them are as good as impossible."""
    inside = 0
    for seed in range(8):
        result = flapwing.fit(PRESET, readings(seed=seed), list(TRUE), sigma="3 %", starts=1, seed=seed)
        inside += sum(one.low <= TRUTH[name] <= one.high for name, one in result.estimates.items())
    assert 19 <= inside


def test_parameters_that_cannot_be_told_are_named():
    """Only the sum of the two inertias is in the equations, and a vehicle's mass moves no wing."""
    free = [*TRUE, "added_inertia_stroke", "vehicle_mass"]
    result = flapwing.fit(PRESET, readings(), free, sigma="3 %", starts=1)
    assert len(result.indistinct) == 2
    assert "vehicle_mass changes no reading" in result.indistinct
    assert any("added_inertia_stroke" in told and "wing_inertia_stroke" in told for told in result.indistinct)
    known = {name: one.is_known for name, one in result.estimates.items()}
    assert known == {
        "hinge_stiffness": True,
        "wing_inertia_stroke": False,
        "drag_coefficient_max": True,
        "added_inertia_stroke": False,
        "vehicle_mass": False,
    }
    assert result.estimates["vehicle_mass"].profile.is_flat
    assert "cannot be told by such data" in str(result) and "not fixed by the data" in str(result)


def test_products_that_cannot_be_told_are_named():
    """Lengths of a tail that no equation has alone: the drag is the product of the air's density and all coefficients."""
    free = ["air_density", "drag_coefficient_max", "drag_coefficient_min", "lift_coefficient_max"]
    data = readings(["stroke_pp_deg", "pitch_amplitude_deg"])
    result = flapwing.fit(PRESET, data, free, sigma="3 %", starts=1, profile=False, rotation_pressure_width=0.0)
    assert len(result.indistinct) == 1
    assert all(f"{name} down by 1 %" in result.indistinct[0] or f"{name} up by 1 %" in result.indistinct[0] for name in free)


def test_a_wrong_model_is_told():
    """Data by another drag law: chi-square is poor, and residuals have a pattern."""
    data = readings(["stroke_pp_deg", "pitch_amplitude_deg"], noise=0.02, drag_coefficient_min=1.5)
    result = flapwing.fit(PRESET, data, list(TRUE), sigma="2 %", starts=1, profile=False)
    assert result.goodness.p < 1e-6 and result.goodness.is_structured
    assert "POOR" in str(result) and "STRUCTURED" in str(result)


def test_readings_of_another_robot_are_told():
    """Data by the four-bar model."""
    points = {"drive_frequency": np.tile(np.linspace(60.0, 90.0, 20), 2), "drive_voltage_pp": np.repeat([120.0, 150.0], 20)}
    table = flapwing.evaluate("arabagi2013-75hz", points)
    draw = np.random.default_rng(1)
    data = {name: table[name] * (1 + draw.normal(0.0, 0.02, 40)) for name in ("stroke_pp_deg", "pitch_amplitude_deg")}
    free = {"hinge_stiffness": None, "wing_inertia_stroke": (1e-11, 1e-9), "drag_coefficient_max": None, "force_factor": (0.05, 3.0)}
    result = flapwing.fit(PRESET, {**points, **data}, free, sigma="2 %", starts=2, profile=False)
    assert result.goodness.p < 1e-6 and result.goodness.is_structured


def test_errors_that_are_not_known_are_estimated():
    data = readings(["stroke_pp_deg", "pitch_amplitude_deg"], noise=0.01)
    result = flapwing.fit(PRESET, data, list(TRUE), starts=1)
    assert not result.sigma_known and np.isnan(result.goodness.p)
    assert result.goodness.chi_square == pytest.approx(result.goodness.freedom, rel=0.05)
    assert "estimated from the residuals" in str(result)
    for name, value in TRUTH.items():
        assert abs(result.estimates[name].value - value) < 4 * result.estimates[name].error


def test_data_have_units(tmp_path):
    """One data set as arrays in SI units, as text with units, with units in the names, as a DataFrame and as a file."""
    data = readings(noise=0.0)
    kilohertz = [f"{value / 1000} kHz" for value in data["drive_frequency"]]
    stroke = np.radians(data["stroke_pp_deg"])
    forms = [
        data,
        {"frequency_hz": data["drive_frequency"], "drive_voltage_pp": VOLTAGE, "stroke_pp_rad": stroke},
        {"drive_frequency (kHz)": data["drive_frequency"] / 1000, "drive_voltage_pp_v": VOLTAGE, "stroke_pp [rad]": stroke},
        pandas.DataFrame({"drive_frequency": kilohertz, "drive_voltage_pp": VOLTAGE, "stroke_pp_deg": data["stroke_pp_deg"]}),
    ]
    path = tmp_path / "measured.csv"
    with open(path, "w", newline="", encoding="utf-8") as file:
        file.write("# by the camera\n")
        csv.writer(file).writerows([data, *zip(*data.values())])
    forms.append(path)
    values = []
    for form in forms:
        result = flapwing.fit(PRESET, form, ["hinge_stiffness"], sigma="1 deg", starts=1, profile=False, **{
            name: TRUTH[name] for name in TRUE if name != "hinge_stiffness"
        })  # fmt: skip
        values.append(result.values["hinge_stiffness"])
    np.testing.assert_allclose(values, TRUTH["hinge_stiffness"], rtol=1e-4)


def test_sigma_is_a_column_or_an_argument():
    data = readings(noise=0.0)
    given = [
        flapwing.Readings({**data, "stroke_pp_deg_sigma": np.full(30, 1.5)}),
        flapwing.Readings(data, sigma={"stroke_pp_deg": "1.5 deg"}),
        flapwing.Readings(data, sigma=1.5),
    ]
    errors = {
        flapwing.fit(PRESET, one, list(TRUE), starts=1, profile=False).estimates["drag_coefficient_max"].error for one in given
    }
    assert max(errors) == pytest.approx(min(errors), rel=1e-6)


def test_data_sets_share_parameters_or_have_their_own():
    """Two wings with hinges of their own."""
    sets = [
        flapwing.Readings(readings(hinge_stiffness=TRUTH["hinge_stiffness"] * factor, seed=seed), name=name)
        for seed, (name, factor) in enumerate({"soft": 0.9, "stiff": 1.2}.items())
    ]
    free = {"hinge_stiffness": flapwing.Free(per_set=True), "drag_coefficient_max": None}
    result = flapwing.fit(PRESET, sets, free, sigma="3 %", starts=1, wing_inertia_stroke=TRUTH["wing_inertia_stroke"])
    assert list(result.estimates) == ["hinge_stiffness of soft", "hinge_stiffness of stiff", "drag_coefficient_max"]
    for name, factor in {"soft": 0.9, "stiff": 1.2}.items():
        one = result.estimates[f"hinge_stiffness of {name}"]
        assert abs(one.value - factor * TRUTH["hinge_stiffness"]) < 4 * one.error
    assert list(result.values) == ["drag_coefficient_max"]
    soft, stiff = (result.predict({"drive_frequency": [100.0], "drive_voltage_pp": 160.0}, "stroke_pp_deg", data_set=name) for name in ("soft", "stiff"))
    assert soft.value[0] != stiff.value[0]


def test_what_is_known_beforehand_counts():
    data = {name: values[:3] for name, values in readings().items()}
    free = {name: flapwing.Free(prior=(value, "2 %")) for name, value in TRUTH.items()}
    result = flapwing.fit(PRESET, data, free, sigma="3 %", starts=1, profile=False)
    assert result.goodness.freedom == 3
    for name, value in TRUTH.items():
        assert result.estimates[name].error <= 0.0201 * value


def test_outliers_count_less_with_a_robust_loss():
    data = readings()
    data["stroke_pp_deg"] = data["stroke_pp_deg"].copy()
    data["stroke_pp_deg"][[3, 20]] *= 1.6
    off = {}
    for loss in ("linear", "cauchy"):
        result = flapwing.fit(PRESET, data, list(TRUE), sigma="3 %", loss=loss, starts=1, profile=False)
        off[loss] = sum(abs(np.log(result.values[name] / value)) for name, value in TRUTH.items())
    assert off["cauchy"] < 0.5 * off["linear"]


@pytest.mark.parametrize("hold_out", [0.2, {"drive_frequency": (100, 115)}, "second", ["second"]])
def test_readings_can_be_held_out(hold_out):
    sets = [
        flapwing.Readings(readings(), name="first"),
        flapwing.Readings(readings(seed=2, points={"drive_frequency": FREQUENCY[:15], "drive_voltage_pp": VOLTAGE[15:]}), name="second"),
    ]
    result = flapwing.fit(PRESET, sets, list(TRUE), sigma="3 %", starts=1, profile=False, hold_out=hold_out)
    assert result.held_out.count in (6, 9, 15)
    assert result.held_out.rms["stroke_pp_deg"] < 4 and result.held_out.covered > 0.7
    assert result.goodness.freedom == 45 - result.held_out.count - 3
    assert "held out" in str(result)


def test_predictions_have_bands(found):
    points = {"drive_frequency": [90.0, 110.0, 130.0], "drive_voltage_pp": 140.0}
    told = found.predict(points, "lift_mean_mn")
    exact = flapwing.evaluate(PRESET, points, measures=["lift_mean_mn"], **TRUTH)["lift_mean_mn"]
    assert told.unit == "mN" and (told.error > 0).all()
    assert (np.abs(told.value - exact) < 4 * told.error).all()
    np.testing.assert_allclose(told.high - told.value, 1.96 * told.error, rtol=1e-3)
    assert "lift_mean_mn (mN)" in str(told)


def test_next_measurements_shrink_the_error(found):
    """The error that is expected after two more readings is that of a fit with them."""
    candidates = {"drive_frequency": np.linspace(70.0, 150.0, 17), "drive_voltage_pp": 160.0}
    told = found.next_measurements(candidates, "drag_coefficient_max", count=2)
    assert told.now == pytest.approx(found.estimates["drag_coefficient_max"].error, rel=1e-3)
    assert told.now > told.errors[0] > told.errors[1]
    extra = {name: np.array([point[name] for point in told.points]) for name in POINTS}
    data = readings()
    exact = flapwing.evaluate(PRESET, extra, measures=["stroke_pp_deg"], **found.values)["stroke_pp_deg"]
    more = {**{name: np.concatenate([data[name], extra[name]]) for name in POINTS}, "stroke_pp_deg": np.concatenate([data["stroke_pp_deg"], exact])}
    again = flapwing.fit(PRESET, more, list(TRUE), sigma="3 %", starts=1, profile=False)
    assert again.estimates["drag_coefficient_max"].error == pytest.approx(told.errors[1], rel=0.02)
    prediction = {"measure": "lift_mean_mn", "drive_frequency": 110.0, "drive_voltage_pp": 160.0}
    assert found.next_measurements(candidates, prediction, count=1).errors[0] < found.predict(
        {name: [value] for name, value in prediction.items() if name != "measure"}, "lift_mean_mn"
    ).error[0]
    assert "error now" in str(told)


#: A design with two motions at some frequencies.
BISTABLE = {"drive_voltage_pp": "160 V"}


def test_readings_are_on_the_branch_of_their_experiment():
    """The two ways differ by up to 89 degrees. A fit that looked for motions from rest would be far off."""
    curve = flapwing.respond(PRESET, start=104, stop=134, step=2, hinge_stiffness="0.7486 uN*m/rad", **BISTABLE)
    sets = []
    for way in ("up", "down"):
        rows = curve[curve["branch"] == way]
        columns = {"drive_frequency": rows["drive_frequency"], "stroke_pp_deg": rows["stroke_pp_deg"]}
        sets.append(flapwing.Readings(columns, name=way, branch=way, sigma="2 %"))
    assert np.abs(np.subtract(sets[0].columns["stroke_pp_deg"], sets[1].columns["stroke_pp_deg"])).max() > 50
    free = {"hinge_stiffness": ("0.73 uN*m/rad", "0.77 uN*m/rad")}
    result = flapwing.fit(PRESET, sets, free, starts=1, profile=False, **BISTABLE)
    assert result.values["hinge_stiffness"] == pytest.approx(0.7486e-6, rel=2e-3)
    assert result.goodness.chi_square < 1


def test_readings_without_a_settled_motion_are_told():
    """A drive frequency that is no frequency, among others that are."""
    data = {name: values.copy() for name, values in readings().items()}
    data["drive_frequency"][4] = -70.0
    result = flapwing.fit(PRESET, data, ["hinge_stiffness"], sigma="3 %", starts=1, profile=False)
    assert [(one.set, one.measure, one.row, one.status) for one in result.unsettled] == [("set 1", "stroke_pp_deg", 5, "invalid")]
    assert "1 readings do not count" in str(result) and result.goodness.freedom == 28


def test_progress_is_told_and_can_end_a_fit():
    told = []
    flapwing.fit(PRESET, readings(), ["drag_coefficient_max"], sigma="3 %", starts=2, profile=False, progress=lambda done, points: told.append(done))
    assert told == sorted(told) and told[-1] > 30

    def stop(done, points):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        flapwing.fit(PRESET, readings(), ["drag_coefficient_max"], sigma="3 %", starts=2, progress=stop)


def test_readings_can_be_pickled():
    one = flapwing.Readings(readings(), name="first", sigma="3 %")
    assert pickle.loads(pickle.dumps(one)).columns.keys() == one.columns.keys()
