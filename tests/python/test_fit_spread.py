"""Parameters that scatter between robots of the same build."""

import flapwing
import numpy as np
import pytest
from fits import PRESET, TRUTH, readings
from flapwing.fitting._model import Answer
from flapwing.fitting._parameters import Coordinate, Group, Space
from flapwing.fitting._search import Target
from flapwing.fitting._spread import new_spreads, spreads

POINTS = {"drive_frequency": np.linspace(80.0, 140.0, 6), "drive_voltage_pp": np.full(6, 160.0)}
#: Ratios of the robots' stiffness to the mean: their standard deviation is 6 %.
RATIOS = 1 + 0.06 * np.array([-1.2, -0.6, 0.1, 0.4, 1.3]) / np.std([-1.2, -0.6, 0.1, 0.4, 1.3], ddof=1)
BESIDE = {"sigma": "3 %", "starts": 1, "profile": False, "wing_inertia_stroke": TRUTH["wing_inertia_stroke"]}


@pytest.fixture(scope="module")
def robots():
    """The last robot has two readings."""
    sets = []
    for place, ratio in enumerate(RATIOS):
        data = readings(points=POINTS, seed=place, hinge_stiffness=ratio * TRUTH["hinge_stiffness"])
        few = {name: cells[2:4] for name, cells in data.items()} if place == len(RATIOS) - 1 else data
        sets.append(flapwing.Readings(few, name=f"robot {place + 1}"))
    return sets


def fit(sets, **options):
    free = {"hinge_stiffness": flapwing.FreeParameter(**options), "drag_coefficient_max": None}
    return flapwing.fit(PRESET, sets, free, **BESIDE)


@pytest.mark.parametrize("here", [np.zeros(4), np.array([0.3, -0.2, 0.1, 0.4])])
def test_the_spread_of_equal_robots_has_a_closed_form(here):
    """If each robot has one reading of its value, the variance of the readings is the sum of both variances. The
    residuals are linear, so the point at which derivatives are taken does not matter."""
    measured, sigma = np.array([1.0, 2.5, 4.0, 4.5]), np.full(4, 0.5)
    coordinates = [Coordinate("k", place, f"k of {place}", "m", False, -50.0, 50.0, 0.0, None) for place in range(4)]
    space = Space(coordinates, [Group("k", np.arange(4), None, False)])
    target = Target(measured, sigma, np.ones(4, bool), "linear")
    answer = Answer(space.values(here), np.diag(space.slopes(here)), np.full(4, "periodic"), np.zeros(4, bool))
    expected = np.var(measured, ddof=1) - 0.25
    found = new_spreads(space, target, here, answer)["k"]
    assert found == pytest.approx(np.sqrt(expected), rel=1e-3)
    # The deviance of four values about their mean, with three degrees of freedom.
    space.spreads = {"k": found}
    (one,) = spreads(space, target, here, answer, np.diag(sigma**2)).values()
    deviance = {
        size: 3 * np.var(measured, ddof=1) / (size**2 + 0.25) + 3 * np.log(size**2 + 0.25)
        for size in (found, one.low, one.high)
    }
    assert [deviance[size] - deviance[found] for size in (one.low, one.high)] == pytest.approx([3.84, 3.84], abs=0.2)
    # Equal readings show no spread.
    equal = Target(np.full(4, 2.0), sigma, np.ones(4, bool), "linear")
    space.spreads = new_spreads(space, equal, here, answer)
    (one,) = spreads(space, equal, here, answer, np.diag(sigma**2)).values()
    assert one.value == one.low == 0.0 < one.high < 1.0


def test_values_of_robots_move_towards_their_mean(robots):
    own, shared = fit(robots, per_set=True), fit(robots, spread=True)
    one = shared.spreads["hinge_stiffness"]
    assert one.low < 0.06 * TRUTH["hinge_stiffness"] < one.high and not one.is_given
    assert abs(one.mean - TRUTH["hinge_stiffness"]) < 2 * one.error
    assert one.error == pytest.approx(one.value / np.sqrt(5), rel=0.2)
    assert one.mean == pytest.approx(np.mean([part.value for part in list(shared.estimates.values())[:5]]))
    assert all(shared.estimates[name].error < 1.02 * before.error for name, before in own.estimates.items())
    scatter = [np.std([part.value for part in list(found.estimates.values())[:5]]) for found in (own, shared)]
    assert 0.9 * scatter[0] < scatter[1] < 0.999 * scatter[0]
    last = "hinge_stiffness of robot 5"
    moved = own.estimates[last].value - shared.estimates[last].value
    assert moved > 0.05 * own.estimates[last].error
    assert "hinge_stiffness of all robots: mean" in str(shared) and shared.goodness.freedom == own.goodness.freedom + 4


def test_a_given_spread_predicts_a_robot_without_readings(robots):
    """The value of the new robot is the mean of the others, with the scatter of robots."""
    options = {**BESIDE, "hold_out": "robot 4"}
    free = {"hinge_stiffness": flapwing.FreeParameter(spread="6 %"), "drag_coefficient_max": None}
    result = flapwing.fit(PRESET, robots, free, **options)
    one, new = result.spreads["hinge_stiffness"], result.estimates["hinge_stiffness of robot 4"]
    assert one.is_given and one.value == one.low == one.high == pytest.approx(0.06 * one.mean, rel=0.01)
    assert new.value == pytest.approx(one.mean, rel=1e-4)
    others = [part.value for name, part in result.estimates.items() if name.startswith("hinge") and "4" not in name]
    assert one.mean == pytest.approx(np.mean(others), rel=1e-4)
    assert new.error == pytest.approx(one.value * np.sqrt(1 + 1 / 4), rel=0.1)
    assert abs(new.value - RATIOS[3] * TRUTH["hinge_stiffness"]) < 2 * new.error


def test_a_spread_has_limits(robots):
    with pytest.raises(ValueError, match="has a `prior` and a `spread`"):
        fit(robots, spread="5 %", prior=(TRUTH["hinge_stiffness"], "5 %"))
    with pytest.raises(ValueError, match="the spread is '0 %'\\nit must be finite and more than zero"):
        fit(robots, spread="0 %")
    for wrong in (0, 0.0, -1e-8, np.inf):
        with pytest.raises(ValueError, match=f"the spread is {wrong!r}\nit must be finite and more than zero"):
            fit(robots, spread=wrong)
    with pytest.raises(ValueError, match="has a `spread`, which a selection cannot have"):
        start = {"hinge_stiffness": flapwing.FreeParameter(spread=True)}
        flapwing.select(PRESET, robots, ["drag_coefficient_max"], start=start)
    made = fit(robots[:2], spread="5 %")
    with pytest.raises(ValueError, match="has a `spread` of hinge_stiffness"):
        flapwing.compare([made, made])
