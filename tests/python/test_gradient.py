"""Derivatives of settled measures in batches."""

import pickle

import flapwing
import numpy as np
import pytest

PRESET = "ozaki2018-large"
MEASURES = ["lift_mean_mn", "stroke_pp_deg"]
BY = ["hinge_stiffness", "drive_frequency", "drive_voltage_pp"]
COLUMNS = {"drive_frequency": np.linspace(96.0, 118.0, 9), "drive_voltage_pp": 80.0}


def slopes(**keywords):
    return flapwing.evaluate(PRESET, COLUMNS, measures=MEASURES, gradient=BY, rtol=1e-8, **keywords)


def test_derivatives_are_per_si_unit():
    table = slopes()
    found = table.gradient
    assert found.shape == (9, 2, 3) and found.dtype == np.float64
    assert (table["gradient_gap"] == "").all()
    nominal = {"hinge_stiffness": flapwing.params(PRESET)["hinge_stiffness"].value, **COLUMNS}
    share = 1e-3
    for place, name in enumerate(BY):
        rows = [
            flapwing.evaluate(
                PRESET, {**COLUMNS, name: np.multiply(nominal[name], factor)}, measures=MEASURES, rtol=1e-10
            )
            for factor in (1 + share, 1 - share)
        ]
        for measure, column in enumerate(MEASURES):
            difference = (rows[0][column] - rows[1][column]) / (2 * share * nominal[name])
            size = np.abs(found[:, measure, place]).max()
            np.testing.assert_allclose(found[:, measure, place], difference, rtol=0, atol=1e-4 * size)


def test_columns_tell_what_they_are():
    table = slopes()
    told = table.meta["gradient"]
    assert told["of"] == MEASURES and told["with_respect_to"] == BY and told["per"] == "SI unit"
    assert table.units["d_lift_mean_mn_per_si_hinge_stiffness"] == "mN/(N*m/rad)"
    assert table.units["d_stroke_pp_deg_per_si_drive_frequency"] == "deg/Hz"
    assert (
        table.docs["d_lift_mean_mn_per_si_hinge_stiffness"]
        == "change of lift_mean_mn (mN) per SI unit of hinge_stiffness"
    )
    np.testing.assert_array_equal(table["d_stroke_pp_deg_per_si_drive_frequency"], table.gradient[:, 1, 1])
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(table[2:5])).gradient, table.gradient[2:5])


@pytest.mark.parametrize(
    ("preset", "parameter", "change", "measure"),
    [
        ("ozaki2018-large", "hinge_damping", 1e-12, "stroke_pp_deg"),
        ("ozaki2018-large", "stroke_loss_factor", 1e-5, "stroke_pp_deg"),
        ("ozaki2018-large", "charge_recovery", 1e-3, "power_mean_mw"),
        ("jafferis2016", "hinge_loss_factor", 1e-5, "stroke_pp_deg"),
    ],
)
def test_terms_that_are_zero_have_derivatives(preset, parameter, change, measure):
    found = flapwing.evaluate(preset, {parameter: [0.0]}, measures=[measure], gradient=[parameter], rtol=1e-9)
    assert found["gradient_gap"][0] == ""
    rows = flapwing.evaluate(preset, {parameter: [0.0, change]}, measures=[measure], rtol=1e-10)
    np.testing.assert_allclose(found.gradient[0, 0, 0], np.diff(rows[measure])[0] / change, rtol=1e-2)


def test_derivatives_are_those_of_a_grid():
    grid = {"preset": PRESET, "gradient": {"of": MEASURES, "with_respect_to": BY}}
    per_cent = flapwing.evaluate(grid, COLUMNS, rtol=1e-8)
    assert per_cent.meta["gradient"]["per"] == "per cent"
    values = np.column_stack([np.full(9, flapwing.params(PRESET)[BY[0]].value), COLUMNS[BY[1]], np.full(9, 80.0)])
    np.testing.assert_allclose(per_cent.gradient, 0.01 * slopes().gradient * values[:, np.newaxis, :], rtol=1e-12)


def test_derivatives_do_not_depend_on_threads_or_neighbours():
    one, many = slopes(threads=1), slopes(threads=2)
    np.testing.assert_array_equal(one.gradient, many.gradient)
    alone = flapwing.evaluate(
        PRESET,
        {"drive_frequency": COLUMNS["drive_frequency"][3:4], "drive_voltage_pp": 80.0},
        measures=MEASURES,
        gradient=BY,
        rtol=1e-8,
    )
    np.testing.assert_array_equal(alone.gradient[0], one.gradient[3])


def test_all_measures_have_derivatives_by_default():
    table = flapwing.evaluate(PRESET, {"drive_frequency": [100.0]}, gradient=["hinge_stiffness"])
    assert table.gradient.shape == (1, len(flapwing.measures(PRESET)), 1)


def test_missing_derivatives_have_a_reason():
    table = flapwing.evaluate(
        PRESET, {"drive_frequency": [100.0, -5.0]}, measures=MEASURES, gradient=["hinge_stiffness"]
    )
    assert np.isfinite(table.gradient[0]).all() and np.isnan(table.gradient[1]).all()
    assert table["status"][1] == "invalid"


@pytest.mark.parametrize(
    ("keywords", "error", "says"),
    [
        ({"gradient": ["hinge_stiffnes"]}, ValueError, "did you mean `hinge_stiffness`?"),
        (
            {"gradient": ["lift_sign"]},
            ValueError,
            "`lift_sign` is a choice, so there is no derivative with respect to it",
        ),
        ({"gradient": BY + BY[:1]}, ValueError, "`gradient` has hinge_stiffness twice"),
        ({"gradient": "hinge_stiffness"}, TypeError, "`gradient` is str\nit must be a list of names"),
        ({"gradient": []}, ValueError, "`gradient` is empty"),
        ({"initial_state": {"stroke_rad": [0.0]}}, ValueError, "`initial_state` lacks the columns "),
        ({"return_states": "yes"}, TypeError, "`return_states` is str"),
    ],
)
def test_what_is_refused(keywords, error, says):
    with pytest.raises(error) as caught:
        flapwing.evaluate(PRESET, COLUMNS, **keywords)
    assert says in str(caught.value)


def test_derivatives_by_what_formulas_decide_are_refused():
    grid = {
        "preset": PRESET,
        "derived": {"hinge_stiffness": "1e-6 * drive_frequency"},
        "measure": {"high": "lift_mean_mn > 3"},
    }
    with pytest.raises(
        ValueError, match="is derived from other parameters\nlist these parameters instead: their derivatives include"
    ):
        flapwing.evaluate(grid, COLUMNS, gradient=["hinge_stiffness"])
    with pytest.raises(ValueError, match="`high` is true or false, and has no derivatives\nremove it from `measures`"):
        flapwing.evaluate(grid, COLUMNS, gradient=["drive_frequency"], measures=["high"])
    grid = {"preset": PRESET, "params": {"drive_frequency": "resonance"}, "resonance": {"from": 95, "to": 120}}
    with pytest.raises(ValueError, match="set drive_frequency to a number"):
        flapwing.evaluate(grid, {"drive_voltage_pp": [80.0]}, gradient=["hinge_stiffness"])
    with pytest.raises(ValueError, match="the table has no derivatives"):
        flapwing.evaluate(PRESET, {"drive_frequency": [100.0]}).gradient


#: A design with two motions at some frequencies.
BISTABLE = {"hinge_stiffness": "0.7486 uN*m/rad", "drive_voltage_pp": "160 V"}


def test_states_decide_which_motion_is_found():
    curve = flapwing.respond("jafferis2016", start=116, stop=128, step=1, return_states=True, **BISTABLE)
    way = {name: curve[curve["branch"] == name] for name in ("up", "down")}
    apart = np.abs(way["up"]["stroke_pp_deg"] - way["down"]["stroke_pp_deg"]) > 1
    assert apart.any()
    for rows in way.values():
        at = {"drive_frequency": rows["drive_frequency"]}
        again = flapwing.evaluate("jafferis2016", at, initial_state=rows, **BISTABLE)
        np.testing.assert_allclose(again["stroke_pp_deg"], rows["stroke_pp_deg"], rtol=1e-4)
        assert again["cycles"].sum() < rows["cycles"].sum()
    with pytest.raises(ValueError, match="`initial_state` has 2 rows for 1 points"):
        flapwing.evaluate("jafferis2016", {"drive_frequency": [116.0]}, initial_state=way["up"][:2], **BISTABLE)


def test_a_state_that_is_not_known_is_rest():
    table = flapwing.evaluate(PRESET, COLUMNS, return_states=True)
    begin = {name: np.full(9, np.nan) for name in table.columns if name.startswith(("stroke_ra", "pitch_ra"))}
    assert len(begin) == 4
    again = flapwing.evaluate(PRESET, COLUMNS, initial_state=begin)
    np.testing.assert_array_equal(again["lift_mean_mn"], table["lift_mean_mn"])
