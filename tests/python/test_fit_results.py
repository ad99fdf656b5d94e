"""Results of fits: reports, predictions, plans, devices."""

import tomllib
from dataclasses import replace

import flapwing
import numpy as np
import pytest
from fits import POINTS, PRESET, TRUE, TRUTH, readings


@pytest.fixture(scope="module")
def found():
    return flapwing.fit(PRESET, readings(), list(TRUE), sigma="3 %", starts=3)


def test_the_report_tells_all(found):
    report = str(found)
    for told in [
        "hinge_stiffness",
        "chi-square",
        "best known",
        "worst known",
        "correlations",
        "set 1",
        "right-hand sides",
    ]:
        assert told in report
    assert "<table>" in found._repr_html_() and "drag_coefficient_max" in repr(found)
    np.testing.assert_allclose(np.diag(found.correlations), 1.0)
    # The worst known combination of parameters is nearly the one of the largest errors.
    worst = float(found.combinations[1].split("known to ")[1].split(" %")[0])
    shares = [100 * one.error / one.value for one in found.estimates.values()]
    assert 0.7 * max(shares) < worst <= 1.1 * max(shares)
    errors = [one.error for one in found.estimates.values()]
    np.testing.assert_allclose(np.sqrt(np.diag(found.covariance)), errors)


@pytest.mark.parametrize(
    ("p", "says"),
    [
        (0.06, "p = 0.06: the model agrees with the data"),
        (0.04, "p = 0.04: doubtful, a correct model has such a value once in 25 fits"),
        (0.002, "p = 0.002: doubtful, a correct model has such a value once in 500 fits"),
        (0.0005, "p = 0.0005: POOR, the model lacks an effect"),
        (0.995, "p = 0.9950: the given standard errors are too large"),
    ],
)
def test_the_report_says_how_far_the_model_agrees(found, monkeypatch, p, says):
    monkeypatch.setattr(found, "goodness", replace(found.goodness, p=p))
    assert says in str(found)


def test_predictions_have_bands(found):
    points = {"drive_frequency": [90.0, 110.0, 130.0], "drive_voltage_pp": 140.0}
    told = found.predict(points, "lift_mean_mn")
    exact = flapwing.evaluate(PRESET, points, measures=["lift_mean_mn"], **TRUTH)["lift_mean_mn"]
    assert told.unit == "mN" and (told.error > 0).all()
    assert (np.abs(told.value - exact) < 4 * told.error).all()
    np.testing.assert_allclose(told.high - told.value, 1.96 * told.error, rtol=1e-3)
    assert "lift_mean_mn (mN)" in str(told)
    assert told == told and told != found.predict(points, "lift_mean_mn") and len({told, found.goodness}) == 2
    assert all(one == replace(one) and one in {one} for one in found.estimates.values())
    assert found.goodness != replace(found.goodness, p=0.5)


def test_next_measurements_shrink_the_error(found):
    """The error that is expected after two more readings is that of a fit with them."""
    candidates = {"drive_frequency": np.linspace(70.0, 150.0, 17), "drive_voltage_pp": 160.0}
    told = found.next_measurements(candidates, "drag_coefficient_max", count=2)
    assert told.now == pytest.approx(found.estimates["drag_coefficient_max"].error, rel=1e-3)
    assert told.now > told.errors[0] > told.errors[1]
    extra = {name: np.array([point[name] for point in told.points]) for name in POINTS}
    data = readings()
    exact = flapwing.evaluate(PRESET, extra, measures=["stroke_pp_deg"], **found.values)["stroke_pp_deg"]
    more = {
        **{name: np.concatenate([data[name], extra[name]]) for name in POINTS},
        "stroke_pp_deg": np.concatenate([data["stroke_pp_deg"], exact]),
    }
    again = flapwing.fit(PRESET, more, list(TRUE), sigma="3 %", starts=1, profile=False)
    assert again.estimates["drag_coefficient_max"].error == pytest.approx(told.errors[1], rel=0.02)
    prediction = {"measure": "lift_mean_mn", "drive_frequency": 110.0, "drive_voltage_pp": 160.0}
    assert (
        found.next_measurements(candidates, prediction, count=1).errors[0]
        < found.predict(
            {name: [value] for name, value in prediction.items() if name != "measure"}, "lift_mean_mn"
        ).error[0]
    )
    assert "error now" in str(told)
    axes = {"drive_frequency": {"from": 70, "to": 150, "n": 17}, "drive_voltage_pp": ["160 V"]}
    grid = flapwing.Grid({"preset": PRESET, "axes": axes})
    assert found.next_measurements(grid, "drag_coefficient_max", count=2).points == told.points


def test_next_measurements_are_readings_of_the_targets_data_set():
    """Each of two robots has its own stiffness and its own standard error."""
    points = {"drive_frequency": np.linspace(80.0, 140.0, 6), "drive_voltage_pp": np.full(6, 160.0)}
    stiffness, sigma = {"soft": 0.9, "stiff": 1.2}, {"soft": "3 %", "stiff": "1 deg"}
    sets = [
        flapwing.Readings(
            readings(points=points, hinge_stiffness=factor * TRUTH["hinge_stiffness"]), name=name, sigma=sigma[name]
        )
        for name, factor in stiffness.items()
    ]
    free = {"hinge_stiffness": flapwing.FreeParameter(per_set=True), "drag_coefficient_max": None}
    fixed = {"wing_inertia_stroke": TRUTH["wing_inertia_stroke"]}
    one = flapwing.fit(PRESET, sets, free, starts=1, profile=False, **fixed)
    target = "hinge_stiffness of stiff"
    plan = one.next_measurements({"drive_frequency": [105.0, 130.0]}, target, count=1)
    assert plan.now == pytest.approx(one.estimates[target].error, rel=1e-3)
    (frequency,) = (point["drive_frequency"] for point in plan.points)
    # A fit with the planned reading has the error of the plan.
    extra = {"drive_frequency": [frequency], "drive_voltage_pp": 160.0}
    exact = one.predict(extra, "stroke_pp_deg", data_set="stiff").value
    columns = {name: [*cells, *np.atleast_1d(extra[name])] for name, cells in points.items()}
    columns["stroke_pp_deg"] = [*sets[1].columns["stroke_pp_deg"], *exact]
    more = [sets[0], flapwing.Readings(columns, name="stiff", sigma="1 deg")]
    again = flapwing.fit(PRESET, more, free, starts=1, profile=False, **fixed)
    assert again.estimates[target].error == pytest.approx(plan.errors[0], rel=1e-3)
    # Readings of the other robot reduce this error only through the shared drag.
    other = one.next_measurements({"drive_frequency": [105.0, 130.0]}, target, count=1, data_set="soft")
    assert plan.errors[0] < other.errors[0] < other.now == plan.now
    with pytest.raises(ValueError, match="different standard errors of `stroke_pp_deg`\n.*data_set=: soft, stiff"):
        one.predict({"drive_frequency": 105.0}, "stroke_pp_deg", reading=True)
    for name in stiffness:
        value, new = (
            one.predict({"drive_frequency": 105.0}, "stroke_pp_deg", data_set=name, reading=flag)
            for flag in (False, True)
        )
        noise = {"soft": 0.03 * value.value[0], "stiff": 1.0}[name]
        assert new.error[0] == pytest.approx(np.hypot(value.error[0], noise), rel=1e-12)
    goal = {"measure": "stroke_pp_deg", "drive_frequency": 105.0}
    for name in stiffness:
        now = one.next_measurements({"drive_frequency": 105.0}, goal, count=1, data_set=name).now
        predicted = one.predict({"drive_frequency": 105.0}, "stroke_pp_deg", data_set=name)
        assert now == pytest.approx(predicted.error[0], rel=1e-3)


@pytest.mark.parametrize("loss", ["soft_l1", "cauchy"])
def test_plans_of_robust_fits_begin_with_the_error_of_the_fit(loss):
    one = flapwing.fit(PRESET, readings(), list(TRUE), sigma="3 %", starts=1, profile=False, loss=loss)
    candidates = {"drive_frequency": [90.0, 110.0], "drive_voltage_pp": 160.0}
    for name, estimate in one.estimates.items():
        assert one.next_measurements(candidates, name, count=1).now == pytest.approx(estimate.error, rel=1e-3)


def test_a_grid_of_points_sets_its_fixed_parameters(tmp_path):
    """The data share the voltage and an option; the keyword sets the voltage of the fit."""
    points = {"drive_frequency": np.linspace(90.0, 130.0, 4), "drive_voltage_pp": np.full(4, 160.0)}
    data = {name: cells for name, cells in readings(points=points).items() if name != "drive_voltage_pp"}
    fixed = {name: TRUTH[name] for name in ("wing_inertia_stroke", "drag_coefficient_max")}
    options = {"sigma": "3 %", "starts": 1, "profile": False, "drive_voltage_pp": 160.0, **fixed}
    made = [
        flapwing.fit(PRESET, one, ["hinge_stiffness"], **options)
        for one in (data, flapwing.Readings(data, drive_voltage_pp=160.0))
    ]
    # 200 V is also the voltage of the preset.
    for voltage in (100.0, 200.0):
        params = {"drive_voltage_pp": voltage, "drive_shape": "square", "hinge_stiffness": 1e-6}
        grid = flapwing.Grid({"preset": PRESET, "params": params, "axes": {"drive_frequency": [90.0, 100.0]}})
        columns = {"drive_frequency": [90.0, 100.0], "drive_voltage_pp": voltage, "drive_shape": "square"}
        for one in made:
            told = one.predict(grid, "stroke_pp_deg")
            np.testing.assert_array_equal(told.value, one.predict(columns, "stroke_pp_deg").value)
            assert list(told.points["drive_voltage_pp"]) == [voltage] * 2 and "hinge_stiffness" not in told.points
    single = flapwing.Grid({"preset": PRESET, "params": {"drive_frequency": 90.0}})
    assert (
        made[0].predict(single, "lift_mean_mn").value
        == made[0].predict({"drive_frequency": 90.0}, "lift_mean_mn").value
    )
    bee, bee2 = str(tmp_path / "bee.toml"), str(tmp_path / "bee2.toml")
    for path in (bee, bee2):
        made[0].write_device(path)
    for grid, says in [
        ({"preset": "ozaki2018-large"}, "points is a grid of `direct-drive`, but the fit is of `bimorph`"),
        ({"preset": PRESET, "params": {"drive_frequency": "resonance"}}, "points has no value of `drive_frequency`"),
        ({"preset": [PRESET, "jafferis2016-improved"]}, "points is a grid with several values of `preset`.*\ngive one"),
        (
            {"device": [bee, bee2]},
            "points is a grid with several values of `device`, but a fit has one design\ngive one",
        ),
    ]:
        with pytest.raises(ValueError, match=says):
            made[0].predict(flapwing.Grid(grid), "stroke_pp_deg")


def test_no_set_of_parameters_is_run_twice(found):
    """The last search ends where the profiles and the next round begin."""
    model = found._model
    first = model.at([found._x], rtol=1e-6)[0]
    ran = model.ran
    other = found._x + 1e-3
    again = model.at([other, found._x, other], rtol=1e-6)
    assert model.ran == ran + 30 and again[0] is again[2]
    np.testing.assert_array_equal(again[1].values, first.values)
    model.at([found._x], rtol=1e-5)
    assert model.ran == ran + 60


def test_progress_is_told_and_can_end_a_fit():
    told = []
    flapwing.fit(
        PRESET,
        readings(),
        ["drag_coefficient_max"],
        sigma="3 %",
        starts=2,
        profile=False,
        progress=lambda done, points: told.append(done),
    )
    assert told == sorted(told) and told[-1] > 30

    def stop(done, points):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        flapwing.fit(PRESET, readings(), ["drag_coefficient_max"], sigma="3 %", starts=2, progress=stop)


def test_a_fit_is_a_device(found, tmp_path):
    """The file has the estimates, their errors and correlations: builds drawn from it have them too."""
    found.write_device(tmp_path / "mybee.toml")
    with pytest.raises(FileExistsError, match="already exists\ngive another path, or overwrite=True"):
        found.write_device(tmp_path / "mybee.toml")
    found.write_device(tmp_path / "mybee.toml", overwrite=True)
    grid = tmp_path / "grid.toml"
    grid.write_text('device = "mybee.toml"\n', encoding="utf-8")
    design = flapwing.Grid(grid)[0]
    for name, value in found.values.items():
        assert design[name] == value
    points = {"drive_frequency": [90.0, 110.0], "drive_voltage_pp": 150.0}
    again = flapwing.evaluate(grid, points, measures=["stroke_pp_deg"])
    expected = flapwing.evaluate(PRESET, points, measures=["stroke_pp_deg"], **found.values)
    np.testing.assert_array_equal(again["stroke_pp_deg"], expected["stroke_pp_deg"])
    grid.write_text(
        'device = "mybee.toml"\n[sample]\nmethod = "random"\nof = "device"\nn = 4000\nseed = 1\n', encoding="utf-8"
    )
    drawn = np.array([[build[name] for name in found.estimates] for build in flapwing.Grid(grid)])
    np.testing.assert_allclose(np.corrcoef(drawn.T), found.correlations, atol=0.06)
    np.testing.assert_allclose(drawn.std(axis=0), [one.error for one in found.estimates.values()], rtol=0.06)


def test_a_device_that_is_fitted_keeps_its_texts(tmp_path):
    """Sources of numbers that the fit leaves alone, and the description; also from a device below, and in a second fit."""
    (tmp_path / "below.toml").write_text(
        'description = "the robot \\"B\\" on bench 2"\npreset = "jafferis2016"\n[params]\n'
        'wing_area = { value = "56 mm^2", source = "scan" }\n'
        'vehicle_mass = { value = "90 mg", sd = "1 mg", source = "balance" }\n',
        encoding="utf-8",
    )
    (tmp_path / "old.toml").write_text(
        'device = "below.toml"\n[params]\n'
        'hinge_stiffness = { value = "1.4 uN*m/rad", sd = "0.1 uN*m/rad", source = "bending test" }\n'
        'wing_inertia_stroke = { value = "50 ng*m^2", source = "pendulum" }\nvehicle_mass = { value = "91 mg", sd = "1 mg" }\n',
        encoding="utf-8",
    )
    given, free = {"wing_inertia_stroke": "51 ng*m^2"}, ["hinge_stiffness"]
    found = flapwing.fit(tmp_path / "old.toml", readings(), free, sigma="3 %", starts=1, profile=False, **given)
    found.write_device(tmp_path / "new.toml")
    again = flapwing.fit(
        tmp_path / "new.toml", readings(), ["drag_coefficient_max"], sigma="3 %", starts=1, profile=False
    )
    again.write_device(tmp_path / "again.toml")
    for name, fitted in [("new", ["hinge_stiffness"]), ("again", ["hinge_stiffness", "drag_coefficient_max"])]:
        device = tomllib.loads((tmp_path / f"{name}.toml").read_text(encoding="utf-8"))
        assert device["description"].startswith('the robot "B" on bench 2; fitted to 30 readings, chi-square')
        assert device["description"].count("fitted") == 1
        params = device["params"]
        assert params["wing_area"] == {"value": 56e-6, "source": "scan"}
        assert params["vehicle_mass"] == {"value": 91e-6, "sd": 1e-6}
        assert params["wing_inertia_stroke"] == 51e-12
        assert [one for one in fitted if params[one]["source"] == "fitted"] == fitted
        assert flapwing.Grid(tmp_path / f"{name}.toml")[0]["wing_area"] == 56e-6


def test_a_device_says_what_is_not_known(tmp_path):
    sets = [flapwing.Readings(readings(seed=seed), name=name) for seed, name in enumerate(["one", "two"])]
    free = {"hinge_stiffness": flapwing.FreeParameter(per_set=True), "vehicle_mass": None}
    result = flapwing.fit(PRESET, sets, free, sigma="3 %", starts=1, profile=False, drag_coefficient_max=4.0, rtol=1e-6)
    with pytest.raises(
        ValueError, match="each data set has its own `hinge_stiffness`\ngive data_set=, one of one, two"
    ):
        result.write_device(tmp_path / "bee.toml")
    result.write_device(tmp_path / "bee.toml", data_set="two")
    text = (tmp_path / "bee.toml").read_text(encoding="utf-8")
    assert "drag_coefficient_max = 4.0\n" in text and "rtol" not in text
    assert 'source = "not fixed by the data of the fit"' in text
    (tmp_path / "grid.toml").write_text('device = "bee.toml"\n', encoding="utf-8")
    assert (
        flapwing.Grid(tmp_path / "grid.toml")[0]["hinge_stiffness"] == result.estimates["hinge_stiffness of two"].value
    )
