"""Mistakes in data and arguments of fits: each message has the place, and help on its second line."""

import flapwing
import numpy as np
import pytest

PRESET = "jafferis2016"
DATA = {"drive_frequency": [90.0, 100.0, 110.0, 120.0], "stroke_pp_deg": [60.0, 62.0, 61.0, 59.0]}


def changed(**columns):
    return {**DATA, **columns}


@pytest.mark.parametrize(
    ("data", "says"),
    [
        ({}, "the data set is empty\ngive columns"),
        ([], "there are no data\ngive columns"),
        ({"drive_frequency": [], "stroke_pp_deg": []}, "the data set is empty"),
        ({"drive_frequency": [90.0]}, "set 1 has no column of a measure\nadd one"),
        (
            changed(strok_pp_deg=[1, 2, 3, 4]),
            "set 1 has the column `strok_pp_deg`, which is neither a parameter nor a measure, did you mean `stroke_pp_deg`?\nrename or remove it",
        ),
        (
            changed(strok_pp_deg=[1, 2, 3, 4], camera=[1, 2, 3, 4]),
            "set 1 has 2 columns that are neither parameters nor measures: `strok_pp_deg`, did you mean `stroke_pp_deg`?; `camera`\nrename or remove them",
        ),
        (
            changed(stroke_pp_deg=[60, 62, np.nan, 59]),
            "set 1, column `stroke_pp_deg`, row 3 is nan, but must be a finite number\nremove the row",
        ),
        (
            changed(stroke_pp_deg=[60, 62, None, 59]),
            "set 1, column `stroke_pp_deg`, row 3 is None, which is not a number",
        ),
        (changed(stroke_pp_deg=["60 deg", "62 mm", "61 deg", "59 deg"]), "set 1, column `stroke_pp_deg`, row 2: "),
        (changed(drive_frequency=["90 Hz", "100 V", "110 Hz", "120 Hz"]), "set 1, column `drive_frequency`, row 2: "),
        (
            {"drive_frequency (furlong)": DATA["drive_frequency"], "stroke_pp_deg": DATA["stroke_pp_deg"]},
            "set 1, column `drive_frequency (furlong)`: ",
        ),
        (
            changed(stroke_pp_deg=[60, 60, 60, 60]),
            "set 1: all 4 readings of `stroke_pp_deg` are 60, so they contain no information\nremove the column",
        ),
        (changed(frequency_hz=[1, 2, 3, 4]), "set 1 has `drive_frequency` twice, once as `frequency_hz`\nkeep one"),
        (changed(stroke_pp_deg=[60, 62]), "columns differ in length: `drive_frequency` has 4, `stroke_pp_deg` has 2\n"),
        (
            {name: values[:1] for name, values in DATA.items()},
            "2 free parameters but only 1 reading: hinge_stiffness, drag_coefficient_max\na fit requires more readings than parameters",
        ),
        ({name: values[:2] for name, values in DATA.items()}, "2 free parameters but only 2 readings"),
        (
            changed(stroke_pp_deg_sigma=[1, 1, 0, 1]),
            "set 1, standard error of `stroke_pp_deg`, row 3: it must be more than zero",
        ),
        ([flapwing.Readings(DATA, name="a"), flapwing.Readings(DATA, name="a")], "data sets share a name: a, a\n"),
        (
            {"drive_frequency (mm)": DATA["drive_frequency"], "stroke_pp_deg": DATA["stroke_pp_deg"]},
            "set 1, column `drive_frequency (mm)`: `mm` is a length, but `drive_frequency (mm)` is in Hz\nuse Hz, kHz",
        ),
        (
            {"drive_frequency": DATA["drive_frequency"], "stroke_pp_mm": DATA["stroke_pp_deg"]},
            "set 1, column `stroke_pp_mm`: `mm` is a length, but `stroke_pp_mm` is in deg\nuse deg, rad, mrad",
        ),
        (
            {"drive_frequency": DATA["drive_frequency"], "stroke_pp (%)": DATA["stroke_pp_deg"]},
            "set 1, column `stroke_pp (%)`: per cent is no unit of `stroke_pp_deg`, which is in deg\n",
        ),
        (
            changed(stroke_pp_deg=["60 %", "62 %", "61 %", "59 %"]),
            "set 1, column `stroke_pp_deg`, row 1: `stroke_pp_deg` is in deg, but `60 %` is a share\nwrite readings in deg",
        ),
        (
            changed(stroke_pp_deg=["60", "", "61", "59"]),
            "set 1, column `stroke_pp_deg`, row 2: the cell is empty, but a number is required\nremove the row",
        ),
        (
            changed(stroke_pp_deg=["60", "n/a", "61", "59"]),
            "set 1, column `stroke_pp_deg`, row 2: 'n/a' is not a number\nwrite a number, or text with a unit; or remove",
        ),
        (
            changed(drive_frequency=[90.0, np.nan, 110.0, 120.0]),
            "set 1, column `drive_frequency`, row 2 is nan, but must be a finite number\ncorrect the cell",
        ),
        (
            changed(drive_frequency=[90.0, 100.0, -100.0, 120.0]),
            "set 1, column `drive_frequency`, row 3: `drive_frequency` must be more than zero, not -100.0 Hz\ncorrect the cell",
        ),
        (
            {"frequency_khz": ["0.09", "0", "0.11", "0.12"], "stroke_pp_deg": DATA["stroke_pp_deg"]},
            "set 1, column `frequency_khz`, row 2: `drive_frequency` must be more than zero, not 0.0 Hz\ncorrect the cell",
        ),
        (
            changed(drive_voltage_pp=[160.0, 160.0, 160.0, "-160 V"]),
            "set 1, column `drive_voltage_pp`, row 4: `drive_voltage_pp` must be zero or more, not -160.0 V\ncorrect the cell",
        ),
        (
            changed(actuator_stiffness=["constant", "stiff", "constant", "constant"]),
            "set 1, column `actuator_stiffness`, row 2: `actuator_stiffness` has no option `stiff`",
        ),
        (
            changed(stroke_pp_deg=[60, np.inf, 61, 59]),
            "set 1, column `stroke_pp_deg`, row 2 is inf, but must be a finite number",
        ),
        (
            {"drive_frequency": [90.0, 100.0], "stroke_pp_deg": [60.0, 60.0]},
            "set 1: all 2 readings of `stroke_pp_deg` are 60, so they contain no information\nremove the column",
        ),
        (
            {"drive_frequency": [90.0, 100.0], "stroke_pp_deg": [0.0, 0.0]},
            "set 1: all 2 readings of `stroke_pp_deg` are 0, so they contain no information\nremove the column",
        ),
        (
            changed(stroke_pp_deg_sigma=[1, -1, 1, 1]),
            "set 1, standard error of `stroke_pp_deg`, row 2: it must be more than zero\nif errors are unknown, leave the column out",
        ),
        (
            changed(stroke_pp_deg_sigma=["3 %", "1 deg", "3 %", "3 %"]),
            "set 1, column `stroke_pp_deg_sigma`, row 1: `stroke_pp_deg` is in deg, but `3 %` is a share\n",
        ),
        (
            changed(stroke_pp_deg_sigma=[1, np.nan, 1, 1]),
            "set 1, column `stroke_pp_deg_sigma`, row 2 is nan, but must be a finite number\n",
        ),
        (
            flapwing.Readings(DATA, sigma={"lift_mean_mn": 0.1}, name="Monday"),
            "`sigma` of Monday has `lift_mean_mn`, but there are no readings of it\nchoose among stroke_pp_deg",
        ),
        (flapwing.Readings(DATA, sigma=0), "`sigma` is 0 for stroke_pp_deg\nstandard errors must be finite"),
        (flapwing.Readings(DATA, drive_voltage="160 V"), "did you mean `drive_voltage_pp`?"),
        (flapwing.Readings(DATA, drive_voltage_pp="160 mm"), "`mm` is a length, but `drive_voltage_pp` is in V"),
    ],
)
def test_data_that_are_refused(data, says):
    with pytest.raises(ValueError) as caught:
        flapwing.fit(PRESET, data, ["hinge_stiffness", "drag_coefficient_max"])
    assert says in str(caught.value)


@pytest.mark.parametrize(
    ("free", "error", "says"),
    [
        ([], ValueError, "`free` is empty\ngive at least one"),
        ("drag_coefficient_max", TypeError, "`free` is str\nit must be a list"),
        (["drag_coefficient_mx"], ValueError, "did you mean `drag_coefficient_max`?"),
        (
            ["actuator_stiffness"],
            ValueError,
            "`actuator_stiffness` is a choice, which cannot be fitted\nfit once for each of its options",
        ),
        (
            ["drive_frequency"],
            ValueError,
            "`drive_frequency` is free, but set 1 has it as a parameter of its operating points\nkeep one",
        ),
        (
            ["actuator_mass"],
            ValueError,
            "`actuator_mass` is zero in the design and has no typical size, so it has no default bounds\ngive free=",
        ),
        (
            {"drag_coefficient_max": (5.0, 3.0)},
            ValueError,
            "free['drag_coefficient_max']: the lower bound 5 is not less than the upper bound 3\nexchange them",
        ),
        ({"hinge_stiffness": ("1 mm", "2 mm")}, ValueError, "free['hinge_stiffness']: "),
        (
            {"drag_coefficient_max": (3.0, 3.0)},
            ValueError,
            "the lower bound 3 is not less than the upper bound 3\ngive a range, or set the parameter by a keyword: fit(",
        ),
        (
            {"hinge_stiffness": flapwing.FreeParameter(low="9 uN*m/rad")},
            ValueError,
            "the lower bound 9e-06 N*m/rad is not less than the upper bound 4.4916e-06 N*m/rad (by default)\ngive both",
        ),
        ({"hinge_stiffness": (np.nan, 2e-6)}, ValueError, "free['hinge_stiffness']: `hinge_stiffness` cannot be nan"),
        (
            {"hinge_stiffness": (-1e-6, 2e-6)},
            ValueError,
            "free['hinge_stiffness']: `hinge_stiffness` must be more than",
        ),
        (
            {"drag_coefficient_max": flapwing.FreeParameter(2.0, 3.0, prior=(4.0, "3 %"))},
            ValueError,
            "free['drag_coefficient_max']: the prior 4 is outside of the bounds 2 to 3\ngive bounds that contain it",
        ),
        (["hinge_stiffness", "hinge_stiffness"], ValueError, "`free` has `hinge_stiffness` twice\nremove one"),
        ([3], TypeError, "`free` has an entry that is int\nit must have names"),
        (
            {"drag_coefficient_max": 3.0},
            TypeError,
            "free['drag_coefficient_max'] is float\nit must be a pair of bounds",
        ),
        (
            {"drag_coefficient_max": flapwing.FreeParameter(prior=(4.0, 0.0))},
            ValueError,
            "free['drag_coefficient_max']: the error of the prior is 0.0\n",
        ),
        (
            {"drag_coefficient_max": flapwing.FreeParameter(prior=4.0)},
            TypeError,
            "free['drag_coefficient_max']: `prior` is float\n",
        ),
        (
            {"hinge_stiffness": flapwing.FreeParameter(spread="5 %")},
            ValueError,
            "free['hinge_stiffness']: `spread` requires two or more data sets\ngive one data set for each robot",
        ),
    ],
)
def test_free_parameters_that_are_refused(free, error, says):
    with pytest.raises(error) as caught:
        flapwing.fit(PRESET, DATA, free)
    assert says in str(caught.value)


@pytest.mark.parametrize(
    ("keywords", "error", "says"),
    [
        ({"loss": "square"}, ValueError, "`loss` is 'square'\nit must be one of linear"),
        ({"starts": 0}, ValueError, "`starts` must be 1 or more, not 0"),
        ({"seed": -1}, ValueError, "`seed` must be 0 or more, not -1"),
        ({"sigma": -1.0}, ValueError, "`sigma` is -1.0 for stroke_pp_deg\nstandard errors must be finite"),
        ({"sigma": "3 mm"}, ValueError, "`sigma`"),
        (
            {"sigma": 0.0},
            ValueError,
            "`sigma` is 0.0 for stroke_pp_deg\nstandard errors must be finite and more than zero",
        ),
        ({"sigma": np.nan}, ValueError, "`sigma` is nan for stroke_pp_deg\nstandard errors must be finite"),
        ({"sigma": True}, TypeError, "`sigma` is bool\nit must be a number in deg, or text such as"),
        ({"sigma": [1, 1, 1, 1]}, TypeError, "for errors of single readings, add a column stroke_pp_deg_sigma"),
        (
            {"sigma": {"stroke": 1.0}},
            ValueError,
            "`sigma` has `stroke`, but there are no readings of it\nchoose among stroke_pp_deg",
        ),
        ({"sigma": "x %"}, ValueError, "`sigma` is 'x %'\nit must be"),
        ({"hold_out": 1.5}, ValueError, "`hold_out` is 1.5\nit must be a share"),
        ({"hold_out": "nowhere"}, ValueError, "`hold_out` has 'nowhere', but the data sets are set 1\n"),
        (
            {"hold_out": {"drive_frequency": ("1 mm", "2 mm")}},
            ValueError,
            "hold_out['drive_frequency']: `mm` is a length",
        ),
        (
            {"hold_out": {"drive_frequency": (120, 110)}},
            ValueError,
            "hold_out['drive_frequency']: 120 is more than 110\n",
        ),
        ({"hold_out": {"drive_frequency": 100}}, TypeError, "hold_out['drive_frequency'] is int\nit must be a range"),
        (
            {"hold_out": {"drive_shape": (1, 2)}},
            ValueError,
            "`hold_out` has `drive_shape`, which is not a parameter with",
        ),
        ({"hold_out": {"drive_frequency": (1, 2)}}, ValueError, "(1, 2)} holds none of the 4 readings out\nit must be"),
        (
            {"hold_out": [{"drive_frequency": (105, None)}, {"drive_frequency": (None, 105)}]},
            ValueError,
            "`hold_out` holds all of the 4 readings out\n",
        ),
        ({"hold_out": [{"drive_frequency": (95, 105)}, 3]}, TypeError, "`hold_out` is list, with 3\nit must be"),
        (
            {"hold_out": {"drive_voltage_pp": (1, 2)}},
            ValueError,
            "`hold_out` has `drive_voltage_pp`, but set 1 has no such column",
        ),
        (
            {"drag_coefficient_max": 3.0},
            ValueError,
            "`drag_coefficient_max` is free and set by a keyword\nkeep one of them",
        ),
        ({"drag_mix": 3.0}, ValueError, "has no parameter `drag_mix`"),
        ({"profile": 3}, TypeError, "`profile` is int"),
    ],
)
def test_arguments_that_are_refused(keywords, error, says):
    with pytest.raises(error) as caught:
        flapwing.fit(PRESET, DATA, ["drag_coefficient_max"], **keywords)
    assert says in str(caught.value)


def test_designs_that_are_refused():
    grid = {"preset": PRESET, "axes": {"drive_frequency": [100, 110]}}
    with pytest.raises(ValueError, match="the design has 2 points, but a fit takes one\nleave out its axes"):
        flapwing.fit(grid, DATA, ["drag_coefficient_max"])
    with pytest.raises(ValueError, match="did you mean `jafferis2016`"):
        flapwing.fit("jafferis2017", DATA, ["drag_coefficient_max"])
    derived = {"preset": PRESET, "derived": {"drag_coefficient_max": "3 * drag_coefficient_min"}}
    with pytest.raises(ValueError, match="`drag_coefficient_max` is a column, but the grid varies or derives it"):
        flapwing.fit(derived, DATA, ["drag_coefficient_max"])


@pytest.mark.parametrize(
    ("preset", "keywords", "says"),
    [
        (
            "ozaki2018-large",
            {"wing_inertia_product": "1 g*m^2"},
            "4 of 4 are invalid, first set 1 row 1, because the mass matrix is not positive definite: the wing's inertias",
        ),
        (PRESET, {"drive_voltage_pp": 1e9}, "4 of 4 are invalid, first set 1 row 1, because a transition is too steep"),
    ],
)
def test_impossible_designs_are_refused_with_the_reason(preset, keywords, says):
    with pytest.raises(ValueError) as caught:
        flapwing.fit(preset, DATA, ["hinge_stiffness"], sigma="1 deg", starts=1, **keywords)
    assert says in str(caught.value)
    assert str(caught.value).endswith(
        "\nchange these parameters of the design, or give bounds in which they are possible together"
    )


def test_readings_that_are_refused(tmp_path):
    with pytest.raises(ValueError, match="`branch` is 'left'\nit must be"):
        flapwing.Readings(DATA, branch="left")
    with pytest.raises(ValueError, match="set 1 is on the branch up along `drive_frequency`, but has no column of it"):
        flapwing.fit(PRESET, flapwing.Readings({"stroke_pp_deg": [1.0, 2.0]}, branch="up"), ["drag_coefficient_max"])
    with pytest.raises(ValueError, match="set 1 has `drive_frequency` as a column and as an argument"):
        flapwing.fit(PRESET, flapwing.Readings(DATA, drive_frequency=3.0), ["drag_coefficient_max"])
    with pytest.raises(TypeError, match="column `drive_frequency` is float\nit must be a list"):
        flapwing.Readings({"drive_frequency": 3.0})
    with pytest.raises(TypeError, match="`data` is int"):
        flapwing.Readings(3)
    path = tmp_path / "rows.csv"
    path.write_text("frequency_hz,stroke_pp_deg\n100,60\n110\n", encoding="utf-8")
    with pytest.raises(ValueError, match="row 2 has 1 cells, and the header has 2\nadd or remove cells"):
        flapwing.Readings(path)
    path.write_text("frequency_hz,stroke_pp_deg\n100,60\n110,many\n120,50\n", encoding="utf-8")
    with pytest.raises(ValueError, match="rows.csv, column `stroke_pp_deg`, row 2: "):
        flapwing.fit(PRESET, path, ["drag_coefficient_max"])
    path.write_text("", encoding="utf-8")
    with pytest.raises(ValueError, match="rows.csv is empty\nits first line has the names"):
        flapwing.Readings(path)
    with pytest.raises(
        FileNotFoundError, match="there is no file .*none.csv\ngive the path of a CSV file, a dictionary"
    ):
        flapwing.Readings(tmp_path / "none.csv")
    path.write_text("frequency_hz;stroke_pp_deg\n100;60,5\n110;61,5\n", encoding="utf-8")
    with pytest.raises(
        ValueError, match="has semicolons between its columns\nsave it with commas and decimal points, or"
    ):
        flapwing.Readings(path)
    path.write_text("frequency_hz,stroke_pp_deg,stroke_pp_deg\n100,60,61\n", encoding="utf-8")
    with pytest.raises(ValueError, match="has two columns called `stroke_pp_deg`\nrename or remove one"):
        flapwing.Readings(path)
    path.write_bytes("frequency_hz,stroke_pp (°)\n100,60\n".encode("latin-1"))
    with pytest.raises(ValueError, match="is not UTF-8 text\nsave it as CSV in UTF-8"):
        flapwing.Readings(path)


def test_what_results_refuse():
    data = {
        "drive_frequency": [90.0, 100.0, 110.0, 120.0],
        "drive_voltage_pp": [120.0, 120.0, 160.0, 160.0],
        "stroke_pp_deg": [52, 51, 60, 59],
    }
    found = flapwing.fit(PRESET, data, ["drag_coefficient_max"], sigma="3 %", starts=1, profile=False)
    for call, says in [
        (lambda: found.predict({"drive_frequency": [100]}, "stroke_pp_deg"), "points lacks `drive_voltage_pp`, which has 2 values in the data\nadd a column"),
        (lambda: found.predict({"drive_frequency": [100], "drive_voltage_pp": 120}, "stroke_pq_deg"), "there is no measure `stroke_pq_deg`, did you mean `stroke_pp_deg`?\nflapwing.measures('bimorph') lists"),
        (lambda: found.predict({"drive_frequency": [100], "drive_voltage_pp": 120}, "power"), "there is no measure `power`, did you mean `power_mean_mw`?"),
        (lambda: found.predict({"drive_frequency": [100], "drive_voltage_pp": 120, "drag_coefficient_max": 3}, "stroke_pp_deg"), "points has `drag_coefficient_max`, which was fitted\nleave it out"),
        (lambda: found.predict({"drive_frequency": [100], "drive_voltage_pp": 120}, "stroke_pp_deg", data_set="x"), "there is no data set 'x'\nchoose among set 1"),
        (lambda: found.predict({}, "stroke_pp_deg"), "points has no points\n"),
        (lambda: found.predict({"drive_frequency": [np.nan], "drive_voltage_pp": 120}, "stroke_pp_deg"), "points, column `drive_frequency`, row 1 is nan, but must be a finite number\ncorrect the cell, or remove the row"),
        (lambda: found.predict({"drive_frequency": [100], "drive_voltage_pp": 120}, "lift_mean_mn", reading=True), "the data have no readings of `lift_mean_mn`, so their standard error is unknown\nchoose among stroke_pp_deg, or leave out `reading`"),
        (lambda: found.next_measurements({"drive_frequency": [100], "drive_voltage_pp": 120}, "drag_coefficient_min"), "`drag_coefficient_min` was not fitted\nchoose among drag_coefficient_max"),
        (lambda: found.next_measurements({"drive_frequency": [100], "drive_voltage_pp": 120}, {"drive_frequency": 3}), "`target` must be a parameter"),
        (lambda: found.next_measurements({"drive_frequency": [100], "drive_voltage_pp": 120}, "drag_coefficient_max", count=0), "`count` must be 1 or more, not 0"),
        (lambda: found.next_measurements({"drive_frequency": [100], "drive_voltage_pp": 120}, "drag_coefficient_max", measures=["lift_mean_mn"]), "choose among stroke_pp_deg, or give sigma={'lift_mean_mn': ...}"),
    ]:  # fmt: skip
        with pytest.raises(ValueError) as caught:
            call()
        assert says in str(caught.value)
    with pytest.raises(TypeError, match="`path` is int\nit must be the path of a device file"):
        found.write_device(1)


def test_scipy_is_needed_and_told(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "scipy", None)
    monkeypatch.setitem(__import__("sys").modules, "scipy.optimize", None)
    with pytest.raises(ImportError, match="flapwing.fit requires SciPy: pip install scipy"):
        flapwing.fit(PRESET, DATA, ["drag_coefficient_max"])


def test_bounds_that_leave_out_the_design_are_searched_from_their_middle():
    free = {"hinge_stiffness": ("3 uN*m/rad", "12 uN*m/rad")}
    found = flapwing.fit(PRESET, DATA, free, sigma="3 %", starts=1, profile=False)
    assert 3e-6 <= found.values["hinge_stiffness"] <= 12e-6
    assert found._model.space.coordinates[0].nominal == pytest.approx(6e-6)


def test_one_operating_point_fixes_nothing_and_is_told():
    """Readings of one point, many times: the interval ends with the range, and the report says so."""
    data = {"drive_frequency": [150.0] * 4, "stroke_pp_deg": [30.0, 31.0, 29.0, 30.5]}
    for profile in (False, True):
        found = flapwing.fit(PRESET, data, ["pressure_max"], sigma="50 %", starts=1, profile=profile)
        one = found.estimates["pressure_max"]
        assert not one.is_known and (one.open_below or one.open_above)
        assert "open" in str(found) and "not fixed by the data" in str(found)
        assert 0.151 / 3.0001 < one.low < one.high < 0.151 * 3.0001
