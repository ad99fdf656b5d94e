"""Laws of lift, drag and centre of pressure from tables."""

import flapwing
import numpy as np
import pytest
from flapwing._coefficients import _solve

ATTACK = np.linspace(0.0, 90.0, 13)
SIN, COS = np.sin(np.radians(2 * ATTACK)), np.cos(np.radians(2 * ATTACK))
TABLE = {
    "attack_deg": ATTACK,
    "lift_coefficient": SIN * (1.7 + 0.3 * COS - 0.2 * COS**2),
    "drag_coefficient": 1.9 - 1.5 * COS + SIN**2 * (-0.2 + 0.1 * COS),
    "pressure": 0.1 + 0.3 * ATTACK / 90 + SIN * (0.04 - 0.02 * COS),
}
TERMS = {
    "lift_term_1": 0.3,
    "lift_term_2": -0.2,
    "drag_term_0": -0.2,
    "drag_term_1": 0.1,
    "pressure_term_0": 0.04,
    "pressure_term_1": -0.02,
}
SLOPE = {"pressure_offset": 0.1, "pressure_slope": 0.6 / np.pi}
LIMITS = {"lift_coefficient_max": 1.7, "drag_coefficient_max": 3.4, "drag_coefficient_min": 0.4}
SINES = {"lift_offset": 0, "lift_amplitude": 1.7, "lift_slope": 2, "lift_phase": 0}
SINES |= {"drag_offset": 1.9, "drag_amplitude": 1.5, "drag_slope": 2, "drag_phase": 0}
EXPECTED = {
    "jafferis2016": LIMITS | {"pressure_min": 0.1, "pressure_max": 0.4} | TERMS,
    "ozaki2018-large": LIMITS | SLOPE | TERMS,
    "arabagi2013-75hz": SINES | SLOPE | TERMS,
}


@pytest.mark.parametrize("design", EXPECTED)
def test_a_law_of_the_model_is_found_exactly(design):
    law = flapwing.fit_coefficients(design, TABLE)
    assert law.params == pytest.approx(EXPECTED[design], abs=1e-12)
    assert max(law.largest_error.values()) < 1e-12
    assert np.allclose(law.fitted["pressure"], TABLE["pressure"], rtol=0, atol=1e-12)


@pytest.mark.parametrize("design", EXPECTED)
@pytest.mark.parametrize("place", range(1, 13, 3))
def test_the_forces_have_the_ratio_of_the_table(design, place):
    """Along a stroke at constant pitch, lift over drag is the ratio of the coefficients."""
    law = flapwing.fit_coefficients(design, TABLE)
    time = np.linspace(0.0, 0.02, 81)
    motion = {
        "time_s": time,
        "stroke_deg": 30 * np.sin(2 * np.pi * 100 * time),
        "pitch_deg": np.full(len(time), (90 - ATTACK[place]) * (-1 if "arabagi" in design else 1)),
    }
    forces = flapwing.forces_along(design, motion, samples=50, **law.params)
    lift = forces["lift_mn" if design == "jafferis2016" else "lift_translational_mn"]
    ratio = TABLE["lift_coefficient"][place] / TABLE["drag_coefficient"][place]
    # The wing moves in the direction of a positive stroke.
    forwards = forces["drag_mn"] > 1e-3
    assert forwards.sum() > 10
    assert lift[forwards] / forces["drag_mn"][forwards] == pytest.approx(ratio, rel=1e-9, abs=1e-12)


def test_tables_come_from_files_in_degrees_or_radians(tmp_path):
    rows = zip(np.radians(ATTACK).tolist(), TABLE["lift_coefficient"].tolist(), strict=True)
    path = tmp_path / "table.csv"
    path.write_text("attack_rad,lift_coefficient\n" + "".join(f"{a!r},{c!r}\n" for a, c in rows))
    law = flapwing.fit_coefficients("direct-drive", path)
    lift = {name: value for name, value in EXPECTED["ozaki2018-large"].items() if name.startswith("lift_")}
    assert law.params == pytest.approx(lift, abs=1e-12)
    assert str(law).startswith("# largest error of lift_coefficient: ") and "\nlift_term_1 = 0.3\n" in str(law)


def test_coefficients_that_must_not_be_negative_are_zero():
    drag = TABLE["drag_coefficient"] - 0.5
    law = flapwing.fit_coefficients("bimorph", {"attack_deg": ATTACK, "drag_coefficient": drag})
    assert law.params["drag_coefficient_min"] == 0 and 2.7 < law.params["drag_coefficient_max"] < 3.0
    assert 0.01 < law.largest_error["drag_coefficient"] < 0.15
    flapwing.run("jafferis2016", **law.params)


def test_least_squares_with_bounds_are_exact():
    """Both free unknowns are -0.5, but the first one is 0.4 if the second one is zero."""
    assert _solve(np.array([[1.0, -1.8], [0.0, 1.0]]), np.array([0.4, -0.5]), 2).tolist() == [0.4, 0.0]
    lsq_linear = pytest.importorskip("scipy.optimize").lsq_linear
    draw = np.random.default_rng(1)
    at_bounds = set()
    for _ in range(100):
        columns, values = draw.normal(size=(8, 4)), draw.normal(size=8)
        exact = lsq_linear(columns, values, bounds=([0.0, 0.0, -np.inf, -np.inf], np.inf), method="bvls").x
        solution = _solve(columns, values, 2)
        assert solution == pytest.approx(exact, abs=1e-9)
        at_bounds.add(tuple(solution[:2] == 0))
    assert len(at_bounds) == 4


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"attack_deg": None}, "one column `attack_deg` or `attack_rad`"),
        ({"attack_rad": np.radians(ATTACK)}, "one column `attack_deg` or `attack_rad`"),
        ({"attack_deg": ATTACK + 1}, "from 0 to 90 deg"),
        ({"attack_deg": np.round(ATTACK / 45) * 45}, "four different"),
        ({"attack_deg": np.resize([0, 30, 60, 90], 13)}, "do not determine the 3 coefficients of `lift_coefficient`"),
        ({"attack_deg": ATTACK / 20, "lift_coefficient": None}, "do not determine the 4 coefficients"),
        ({"lift_coefficient": [1.0, 2.0]}, "columns differ in length: `attack_deg` has 13, `lift_coefficient` has 2"),
        ({"pressure": 0.25}, "column `pressure` is a single value"),
        ({"lift_coefficient": np.full(13, np.nan)}, "`lift_coefficient` must contain finite numbers"),
        ({"lift_coefficient": np.ma.masked_less(ATTACK, 1.0)}, "`lift_coefficient` must contain finite numbers"),
        (dict.fromkeys(["lift_coefficient", "drag_coefficient", "pressure"]), "no column to fit"),
    ],
)
def test_mistakes_are_named(change, message):
    table = {name: values for name, values in {**TABLE, **change}.items() if values is not None}
    with pytest.raises(ValueError, match=message):
        flapwing.fit_coefficients("bimorph", table)


def test_an_unknown_design_is_named():
    with pytest.raises(ValueError, match="bimorf"):
        flapwing.fit_coefficients("bimorf", TABLE)
