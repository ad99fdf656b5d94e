"""Data of fits: their units, their errors, several sets, branches, and what is held out."""

import csv
import pickle
from dataclasses import replace
from types import SimpleNamespace

import flapwing
import numpy as np
import pandas
import pytest
from fits import FREQUENCY, PRESET, TRUE, TRUTH, VOLTAGE, readings
from flapwing.fitting import _search, _solution
from flapwing.fitting._parameters import Coordinate, Space
from flapwing.fitting._search import Target


def test_data_have_units(tmp_path):
    """One data set as arrays in SI units, as text with units, with units in the names, as a DataFrame and as a file."""
    data = readings(noise=0.0)
    kilohertz = [f"{value / 1000} kHz" for value in data["drive_frequency"]]
    stroke = np.radians(data["stroke_pp_deg"])
    forms = [
        data,
        {"frequency_hz": data["drive_frequency"], "drive_voltage_pp": VOLTAGE, "stroke_pp_rad": stroke},
        {
            "drive_frequency (kHz)": data["drive_frequency"] / 1000,
            "drive_voltage_pp_v": VOLTAGE,
            "stroke_pp [rad]": stroke,
        },
        {
            "Frequency (Hz)": data["drive_frequency"],
            "Drive voltage pp (V)": VOLTAGE,
            "Stroke pp (deg)": data["stroke_pp_deg"],
        },
        pandas.DataFrame(
            {"drive_frequency": kilohertz, "drive_voltage_pp": VOLTAGE, "stroke_pp_deg": data["stroke_pp_deg"]}
        ),
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
        flapwing.fit(PRESET, one, list(TRUE), starts=1, profile=False).estimates["drag_coefficient_max"].error
        for one in given
    }
    assert max(errors) == pytest.approx(min(errors), rel=1e-6)


def test_sigma_is_a_share_in_a_column_too():
    data = readings(noise=0.0)
    given = [
        flapwing.Readings(data, sigma="3 %"),
        flapwing.Readings({**data, "stroke_pp_deg_sigma": ["3 %"] * 30}),
        flapwing.Readings({**data, "stroke_pp_deg_sigma (%)": np.full(30, 3.0)}),
    ]
    errors = {
        flapwing.fit(PRESET, one, list(TRUE), starts=1, profile=False).estimates["drag_coefficient_max"].error
        for one in given
    }
    assert max(errors) == pytest.approx(min(errors), rel=1e-6)


def test_data_sets_share_parameters_or_have_their_own():
    """Two wings with hinges of their own."""
    sets = [
        flapwing.Readings(readings(hinge_stiffness=TRUTH["hinge_stiffness"] * factor, seed=seed), name=name)
        for seed, (name, factor) in enumerate({"soft": 0.9, "stiff": 1.2}.items())
    ]
    free = {"hinge_stiffness": flapwing.FreeParameter(per_set=True), "drag_coefficient_max": None}
    result = flapwing.fit(PRESET, sets, free, sigma="3 %", starts=1, wing_inertia_stroke=TRUTH["wing_inertia_stroke"])
    assert list(result.estimates) == ["hinge_stiffness of soft", "hinge_stiffness of stiff", "drag_coefficient_max"]
    for name, factor in {"soft": 0.9, "stiff": 1.2}.items():
        one = result.estimates[f"hinge_stiffness of {name}"]
        assert abs(one.value - factor * TRUTH["hinge_stiffness"]) < 4 * one.error
    assert list(result.values) == ["drag_coefficient_max"]
    soft, stiff = (
        result.predict({"drive_frequency": [100.0], "drive_voltage_pp": 160.0}, "stroke_pp_deg", data_set=name)
        for name in ("soft", "stiff")
    )
    assert soft.value[0] != stiff.value[0]


def test_a_keyword_holds_for_data_without_a_column_of_it():
    """One data set has the voltage itself; the other has the voltage, and an option, of the keywords."""
    points = [{"drive_frequency": FREQUENCY[:6], "drive_voltage_pp": np.full(6, size)} for size in (100.0, 160.0)]
    data = [readings(points=one, noise=0.0, field_transition="printed") for one in points]
    bare = [{name: one[name] for name in ("drive_frequency", "stroke_pp_deg")} for one in data]
    sets = [
        flapwing.Readings(bare[0], drive_voltage_pp="100 V", field_transition="printed", name="own"),
        flapwing.Readings(bare[1], name="keyword"),
    ]
    beside = {name: TRUTH[name] for name in ("wing_inertia_stroke", "drag_coefficient_max")}
    keywords = {"drive_voltage_pp": "160 V", "field_transition": "printed", **beside}
    result = flapwing.fit(PRESET, sets, ["hinge_stiffness"], sigma="1 deg", starts=1, profile=False, **keywords)
    assert result.goodness.chi_square < 1e-3
    assert result.values["hinge_stiffness"] == pytest.approx(TRUTH["hinge_stiffness"], rel=1e-4)
    assert list(result._model.points["drive_voltage_pp"]) == [100.0] * 6 + [160.0] * 6
    assert set(result._model.points["field_transition"]) == {"printed"}


def test_data_without_operating_points_are_at_the_frequency_of_the_keyword():
    exact = flapwing.run(PRESET, drive_frequency=100.0, **TRUTH)["stroke_pp_deg"]
    beside = {name: value for name, value in TRUTH.items() if name != "hinge_stiffness"}
    data = {"stroke_pp_deg": [exact + 0.1, exact - 0.1]}
    keywords = {"drive_frequency": "0.1 kHz", "sigma": "1 deg", "starts": 1, "profile": False, **beside}
    result = flapwing.fit(PRESET, data, ["hinge_stiffness"], **keywords)
    assert result.values["hinge_stiffness"] == pytest.approx(TRUTH["hinge_stiffness"], rel=1e-3)


@pytest.mark.parametrize(
    ("given", "low", "high"), [(None, 0.0, 1.0), ((0.0, None), 0.0, 1.0), ((None, "0.1 nN*m*s"), 0.0, None)]
)
def test_a_parameter_that_is_zero_in_the_design_has_the_bounds_of_candidates(given, low, high):
    """The largest damping makes a torque of half of the hinge's, at the drive frequency."""
    params = flapwing.params(PRESET)
    largest = 0.5 * params["hinge_stiffness"].value / (2 * np.pi * params["drive_frequency"].value)
    result = flapwing.fit(PRESET, readings(), {"hinge_damping": given}, sigma="3 %", starts=1, profile=False)
    (one,) = result._model.space.coordinates
    assert one.low == low and one.high == pytest.approx(1e-10 if high is None else high * largest)
    assert flapwing.candidates(PRESET)["hinge_damping"].high == pytest.approx(largest)


def test_terms_of_the_attack_angle_have_default_bounds():
    terms = ["lift_term_1", "drag_term_0", "pressure_term_0"]
    result = flapwing.fit(PRESET, readings(), terms, sigma="3 %", starts=1, profile=False)
    assert [(one.low, one.high) for one in result._model.space.coordinates] == [(-1.0, 1.0), (-1.0, 1.0), (-0.2, 0.2)]


def test_what_is_known_beforehand_counts():
    data = {name: values[:3] for name, values in readings().items()}
    free = {name: flapwing.FreeParameter(prior=(value, "2 %")) for name, value in TRUTH.items()}
    result = flapwing.fit(PRESET, data, free, sigma="3 %", starts=1, profile=False)
    assert result.goodness.freedom == 3
    for name, value in TRUTH.items():
        assert result.estimates[name].error <= 0.0201 * value


def test_priors_and_readings_share_the_parameters():
    """Four readings and a prior with the same information determine half of a parameter each."""
    space = Space([Coordinate("a", None, "a", "", False, -1.0, 1.0, 0.0, (0.0, 0.5))])
    target = Target(np.zeros(4), np.ones(4), np.ones(4, np.bool_), "linear")
    answer = SimpleNamespace(values=np.zeros(4), slopes=np.ones((4, 1)))
    assert _search.effective_parameters(space, target, np.zeros(1), answer) == pytest.approx(0.5)
    assert _search.rank(target.jacobian(space, np.zeros(1), answer)) == 1
    # If priors determine all parameters, the estimated standard error is the root mean square of the residuals.
    free = {name: flapwing.FreeParameter(prior=(value, "0.01 %")) for name, value in TRUTH.items()}
    data = {name: values[:3] for name, values in readings().items()}
    result = flapwing.fit(PRESET, data, free, starts=1, profile=False)
    assert result._guesses["stroke_pp_deg"] == pytest.approx(result.goodness.residuals[0].rms, rel=0.01)


def test_parameters_of_a_data_set_that_is_held_out_do_not_count():
    """Three readings determine two parameters. No reading determines the stiffness of the second wing."""
    sets = [
        flapwing.Readings({key: values[seed:9:4] for key, values in readings(seed=seed).items()}, name=name)
        for seed, name in enumerate(["first", "second"])
    ]
    free = {"hinge_stiffness": flapwing.FreeParameter(per_set=True), "drag_coefficient_max": None}
    options = {"starts": 1, "profile": False, "wing_inertia_stroke": TRUTH["wing_inertia_stroke"]}
    result = flapwing.fit(PRESET, sets, free, hold_out="second", **options)
    assert result.goodness.freedom == 1 and result._quantile == pytest.approx(12.706, rel=1e-4)
    assert result.goodness.chi_square == pytest.approx(1.0, rel=0.02)
    assert np.isinf(result.estimates["hinge_stiffness of second"].error)
    with pytest.raises(ValueError, match="3 free parameters but only 3 readings"):
        flapwing.fit(PRESET, sets, [*TRUE][:2] + ["drag_coefficient_max"], hold_out="second", starts=1)


def test_readings_within_their_bands_are_covered():
    names, values = np.array(["stroke_pp_deg"] * 5), np.array([10.5, 19.1, 31.1, 37.0, 99.0])
    measured, held = np.array([10.0, 20.0, 30.0, 40.0, 50.0]), np.arange(5) < 4
    found = _solution.held_out(names, measured, values, held, np.ones(5))
    assert (found.count, found.covered, found.unsettled) == (4, 0.5, 0)
    assert found.rms["stroke_pp_deg"] == pytest.approx(np.sqrt((0.25 + 0.81 + 1.21 + 9.0) / 4))
    # A prediction without derivatives has no band. A motion that does not settle is outside.
    values[3], reach = np.nan, np.array([1.0, np.nan, 1.0, np.nan, 1.0])
    assert _solution.held_out(names, measured, values, held, reach).covered == pytest.approx(1 / 3)
    assert np.isnan(_solution.held_out(names, measured, values, np.arange(5) == 1, reach).covered)


def test_residuals_leave_out_readings_that_are_held_out():
    data = readings(["stroke_pp_deg", "pitch_amplitude_deg"])
    result = flapwing.fit(PRESET, data, list(TRUE), sigma="3 %", starts=1, profile=False, hold_out=0.2)
    for one in result.goodness.residuals:
        assert 20 < np.isfinite(one.values).sum() == one.count < 30


@pytest.mark.parametrize(
    "hold_out",
    [0.2, {"drive_frequency": (100, 115)}, {"drive_frequency": ("100 Hz", "0.115 kHz")}, "second", ["second"]],
)
def test_readings_can_be_held_out(hold_out):
    sets = [
        flapwing.Readings(readings(), name="first"),
        flapwing.Readings(
            readings(seed=2, points={"drive_frequency": FREQUENCY[:15], "drive_voltage_pp": VOLTAGE[15:]}),
            name="second",
        ),
    ]
    result = flapwing.fit(PRESET, sets, list(TRUE), sigma="3 %", starts=1, profile=False, hold_out=hold_out)
    assert result.held_out.count in (6, 9, 15)
    assert result.held_out.rms["stroke_pp_deg"] < 4 and result.held_out.covered > 0.7
    assert result.goodness.freedom == 45 - result.held_out.count - 3
    assert "held out" in str(result)


#: A design with two motions at some frequencies.
BISTABLE = {"drive_voltage_pp": "160 V"}


def test_readings_are_on_the_branch_of_their_experiment():
    """The two ways differ by up to 57 degrees. A fit that looked for motions from rest would be far off."""
    curve = flapwing.respond(PRESET, start=104, stop=134, step=2, hinge_stiffness="0.7486 uN*m/rad", **BISTABLE)
    sets = []
    for way in ("up", "down"):
        rows = curve[curve["branch"] == way]
        columns = {"drive_frequency": rows["drive_frequency"], "stroke_pp_deg": rows["stroke_pp_deg"]}
        sets.append(flapwing.Readings(columns, name=way, branch=way, sigma="2 %"))
    strokes = {
        one.name: dict(zip(one.columns["drive_frequency"], one.columns["stroke_pp_deg"], strict=True)) for one in sets
    }
    place = max(strokes["up"], key=lambda frequency: strokes["up"][frequency] - strokes["down"][frequency])
    assert strokes["up"][place] - strokes["down"][place] > 55
    free = {"hinge_stiffness": ("0.73 uN*m/rad", "0.77 uN*m/rad")}
    result = flapwing.fit(PRESET, sets, free, starts=1, profile=False, **BISTABLE)
    assert result.values["hinge_stiffness"] == pytest.approx(0.7486e-6, rel=2e-3)
    assert result.goodness.chi_square < 1
    # Predictions in the bistable band follow the branch from the readings outside of the band.
    for frequencies in ([place], [140.0, place]):
        for way, stroke in strokes.items():
            told = result.predict({"drive_frequency": frequencies}, "stroke_pp_deg", data_set=way)
            assert told.value[-1] == pytest.approx(stroke[place], rel=0.02)
            assert len(told.value) == len(told.error) == len(told.status) == len(frequencies)
    # Planned readings, and predictions of plans, are on the branch of their data set.
    goal = {"measure": "stroke_pp_deg", "drive_frequency": place}
    for way, stroke in strokes.items():
        now = result.predict({"drive_frequency": place}, "stroke_pp_deg", data_set=way).error[0]
        plan = result.next_measurements({"drive_frequency": [place]}, goal, count=1, data_set=way)
        assert plan.now == pytest.approx(now, rel=1e-3)
        assert plan.errors[0] == pytest.approx((now**-2 + (0.02 * stroke[place]) ** -2) ** -0.5, rel=1e-3)


def test_readings_without_a_settled_motion_are_told():
    """A voltage at which the plates' law has no solution, among others at which it has one."""
    data = {name: values.copy() for name, values in readings().items()}
    data["drive_voltage_pp"][4] = 1e9
    result = flapwing.fit(PRESET, data, ["hinge_stiffness"], sigma="3 %", starts=1, profile=False)
    assert [(one.data_set, one.measure, one.row, one.status) for one in result.unsettled] == [
        ("set 1", "stroke_pp_deg", 5, "invalid")
    ]
    assert "1 reading does not count" in str(result) and result.goodness.freedom == 28
    told = result.predict({"drive_frequency": 100.0, "drive_voltage_pp": [160.0, 1e9]}, "stroke_pp_deg", reading=True)
    assert 0.03 * told.value[0] < told.error[0] < 0.05 * told.value[0] and np.isnan(told.error[1])
    free, held = ["hinge_stiffness"], {"drive_voltage_pp": (150, None)}
    result = flapwing.fit(PRESET, data, free, sigma="3 %", starts=1, profile=False, hold_out=held)
    assert (result.held_out.count, result.held_out.unsettled) == (16, 1) and result.held_out.covered <= 15 / 16
    assert "no settled motion at 1 of them, which the rms error leaves out" in str(result)
    result.held_out = replace(result.held_out, covered=np.nan)
    assert "none has a 95 % band" in str(result)


def test_readings_can_be_pickled():
    one = flapwing.Readings(readings(), name="first", sigma="3 %")
    assert pickle.loads(pickle.dumps(one)).columns.keys() == one.columns.keys()


def test_readings_that_a_design_excludes_are_told():
    grid = {"preset": PRESET, "where": {"within_the_amplifier": "drive_frequency < 145"}}
    result = flapwing.fit(grid, readings(), ["hinge_stiffness"], sigma="3 %", starts=1, profile=False)
    assert [(one.row, one.status) for one in result.unsettled] == [(15, "excluded"), (30, "excluded")]
    assert result.goodness.freedom == 27


def test_a_design_without_motions_is_told():
    grid = {"preset": PRESET, "solver": {"max_cycles": 1}}
    with pytest.raises(
        ValueError, match="too few readings have a settled motion .*: the others are unsettled\ngive other"
    ):
        flapwing.fit(grid, readings(), ["hinge_stiffness"], sigma="3 %", starts=1, profile=False)
