"""Results of `run`."""

import dataclasses
import math
import pickle
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction

import flapwing
import pytest

PRESET = "ozaki2018-large"
AFTER_MEASURES = ["cycles", "residual", "period", "floquet_max", "stable", "error_estimate", "rhs_evals", "reason"]


def measures(row):
    """The part of a row that is measured."""
    return {key: value for key, value in row.items() if key not in ["status", *AFTER_MEASURES]}


def bits(row):
    """A row as something that is equal only if every bit is."""
    return [(key, value.hex() if isinstance(value, float) else value) for key, value in row.items()]


def test_presets_are_names_that_run_takes():
    assert PRESET in flapwing.presets()
    for preset in flapwing.presets():
        assert flapwing.run(preset)["status"] == "periodic"


@pytest.mark.parametrize(
    ("column", "expected"),
    # Converged: tolerances of 1e-10 and tighter give these digits.
    [("lift_mean_mn", 4.5969343), ("power_mean_mw", 37.150245)],
)
def test_large_actuator_at_50_plus_50_volts(column, expected):
    assert flapwing.run(PRESET)[column] == pytest.approx(expected, rel=2e-4)


def test_keys_and_their_order():
    row = flapwing.run(PRESET)
    keys = list(row)
    assert keys[0] == "status"
    assert keys[-8:] == AFTER_MEASURES
    assert {"stroke_pp_deg", "lift_mean_mn", "power_mean_mw"} <= measures(row).keys()


def test_periodic_point():
    row = flapwing.run(PRESET)
    assert row["status"] == "periodic"
    assert all(isinstance(value, float) for value in measures(row).values())
    assert row["period"] == 1
    assert isinstance(row["cycles"], int) and row["cycles"] > 1
    assert isinstance(row["rhs_evals"], int) and row["rhs_evals"] > 100
    assert 0 <= row["residual"] < 1e-6
    assert 0 < row["floquet_max"] < 1
    assert row["stable"] is True
    assert row.reason == ""


@pytest.mark.parametrize(
    ("arguments", "status"),
    [
        ({"max_cycles": 3}, "unsettled"),
        ({"max_steps": 1}, "step_limit"),
        ({"drive_voltage_pp": 1e300}, "diverged"),
        ({"wing_inertia_product": 1.0}, "invalid"),
    ],
)
def test_other_points_have_the_same_keys_but_no_measures(arguments, status):
    row = flapwing.run(PRESET, **arguments)
    assert row["status"] == status
    assert list(row) == list(flapwing.run(PRESET))
    assert all(math.isnan(value) for value in measures(row).values())
    assert row.period == 0
    assert math.isnan(row.floquet_max)
    assert math.isnan(row.stable)


def test_invalid_point_says_why():
    row = flapwing.run(PRESET, wing_inertia_product=1.0)
    assert "mass matrix" in row["reason"]
    assert math.isnan(row.residual)
    assert row["cycles"] == 0


def test_rows_are_mappings_of_columns_and_attributes():
    row = flapwing.run(PRESET)
    assert row["lift_mean_mn"] == row.measures["lift_mean_mn"] and row["cycles"] == row.cycles
    assert dict(row) == row and len(row) == len(list(row)) and "lift_mean_mn" in row and "reason" in row
    assert list(row.measures) == list(flapwing.measures(PRESET))
    with pytest.raises(KeyError, match="there is no column `lift_mean`, did you mean `lift_mean_mn`"):
        row["lift_mean"]
    with pytest.raises(dataclasses.FrozenInstanceError):
        row.status = "invalid"
    lost = flapwing.run(PRESET, wing_inertia_product=1.0)
    assert lost == flapwing.run(PRESET, wing_inertia_product=1.0) == pickle.loads(pickle.dumps(lost)) != row


def test_conditions_of_the_design_are_true_false_or_nan():
    grid = {"preset": PRESET, "measure": {"strong": "lift_mean_mn > 1", "ratio": "lift_mean_mn / power_mean_mw"}}
    row = flapwing.run(grid)
    assert row["strong"] is True and row["ratio"] == row["lift_mean_mn"] / row["power_mean_mw"]
    assert flapwing.run(grid, drive_voltage_pp="1 V")["strong"] is False
    assert math.isnan(flapwing.run(grid, max_cycles=3)["strong"])


def test_same_call_same_bits():
    assert bits(flapwing.run(PRESET)) == bits(flapwing.run(PRESET))


def test_defaults_are_those_in_the_docstring():
    documented = flapwing.run(PRESET, rtol=1e-6, atol=1e-6 / 100, settle_tol=1e-6, max_cycles=1000, max_steps=20000)
    assert bits(flapwing.run(PRESET)) == bits(documented)


def test_atol_follows_rtol():
    loose = flapwing.run(PRESET, rtol=1e-4)
    assert bits(loose) == bits(flapwing.run(PRESET, rtol=1e-4, atol=1e-4 / 100))
    assert bits(loose) != bits(flapwing.run(PRESET, rtol=1e-4, atol=1e-8))


def test_tighter_tolerance_takes_more_work():
    assert flapwing.run(PRESET, rtol=1e-9)["rhs_evals"] > flapwing.run(PRESET)["rhs_evals"]


@pytest.mark.parametrize("value", [80, 80.0, Fraction(80), "80 V", "0.08 kV"])
def test_a_number_may_be_given_in_several_ways(value):
    assert bits(flapwing.run(PRESET, drive_voltage_pp=value)) == bits(flapwing.run(PRESET, drive_voltage_pp=80.0))


def test_parameters_matter():
    row = flapwing.run(PRESET)
    weaker = flapwing.run(PRESET, drive_voltage_pp="80 V")
    assert weaker["lift_mean_mn"] < row["lift_mean_mn"]


def test_options_by_name():
    row = flapwing.run(PRESET)
    assert bits(flapwing.run(PRESET, lift_sign="corrected")) == bits(row)
    assert flapwing.run(PRESET, lift_sign="printed")["lift_mean_mn"] != row["lift_mean_mn"]


def test_threads_give_what_one_thread_gives():
    volts = range(60, 101, 5)

    def run(volts):
        return bits(flapwing.run(PRESET, drive_voltage_pp=volts))

    with ThreadPoolExecutor(max_workers=4) as pool:
        assert list(pool.map(run, volts)) == [run(one) for one in volts]


def test_other_threads_go_on_meanwhile():
    rows = []

    def run():
        # A motion that never repeats: runs until max_cycles.
        design = {"hinge_stiffness": 0.7486e-6, "drive_voltage_pp": 240, "drive_frequency": 72}
        rows.append(flapwing.run("jafferis2016", **design, max_cycles=5000))

    thread = threading.Thread(target=run)
    thread.start()
    ticks = 0
    while thread.is_alive():
        time.sleep(0.001)
        ticks += 1
    thread.join()
    assert rows[0]["status"] == "unsettled"
    # Without a turn for others, this thread would have woken up once or twice.
    assert ticks > 10
