"""Fronts of designs."""

import sys

import numpy as np
import pytest
from figures import HERTZ, drawn, fails, grid, legend, message
from flapwing import analysis, plot
from numpy.testing import assert_array_equal


def brute_force(costs):
    """By the definition, point against point."""
    front = []
    for point in costs:
        beaten = any((other <= point).all() and (other < point).any() for other in costs)
        front.append(not beaten and not np.isnan(point).any())
    return front


@pytest.mark.parametrize("objectives", [1, 2, 3, 4])
@pytest.mark.parametrize("coarse", [False, True], ids=["distinct", "ties"])
def test_front_against_brute_force(objectives, coarse):
    random = np.random.default_rng(objectives)
    for count in (0, 1, 2, 30, 200):
        costs = random.normal(size=(count, objectives))
        costs = np.round(2 * costs) if coarse else costs
        if count > 10:
            costs[random.integers(count, size=3), 0] = np.nan
        assert_array_equal(analysis.non_dominated(costs), np.array(brute_force(costs), dtype=bool))


def test_front_of_many_points():
    random = np.random.default_rng(0).random((200_000, 2))
    front = random[analysis.non_dominated(random)]
    order = np.argsort(front[:, 0])
    assert (np.diff(front[order, 1]) < 0).all()


def on_a_sphere(count):
    """Points of which most are on the front of three objectives."""
    points = np.abs(np.random.default_rng(17).normal(size=(count, 3)))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


def test_large_fronts_of_three_objectives():
    points = on_a_sphere(20_000)
    front = analysis.non_dominated(points)
    assert front.sum() > 15_000
    some = points[:400]
    assert_array_equal(analysis.non_dominated(some), np.array(brute_force(some), dtype=bool))


def test_without_the_library_the_error_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "moocore", None)
    with pytest.raises(ImportError, match=r"pip install \"flapwing\[analysis\]\""):
        analysis.non_dominated(on_a_sphere(10))


def test_front_needs_rows_of_objectives():
    assert "(n, k)" in message(ValueError, analysis.non_dominated, [1.0, 2.0])


def test_pareto_draws_all_designs_and_the_front(sweep):
    ax = drawn(plot.pareto(sweep, maximize="lift_mean_mn", minimize="power_mean_mw", color="drive_voltage_pp"))
    lift, power = sweep["lift_mean_mn"], sweep["power_mean_mw"]
    assert_array_equal(ax.collections[0].get_offsets(), np.column_stack([power, lift]))
    assert_array_equal(ax.collections[0].get_array(), sweep["drive_voltage_pp"])
    front = analysis.non_dominated(np.column_stack([power, -lift]))
    order = np.argsort(power[front])
    (line,) = ax.lines
    assert_array_equal(line.get_xdata(), power[front][order])
    assert_array_equal(line.get_ydata(), lift[front][order])
    assert line.get_drawstyle() == "steps-post"
    assert legend(ax) == [f"front ({front.sum()} of 15 designs)"]
    assert ax.get_xlabel() == "Power, mean (mW), less is better"
    assert ax.get_ylabel() == "Lift, mean (mN), more is better"
    assert ax.figure.axes[1].get_ylabel() == "Drive voltage, peak to peak (V)"


def test_pareto_leaves_out_designs_without_measures_and_names_words():
    table = fails(grid(centre_of_pressure=["folded", "directional"], drive_frequency=HERTZ), [2, 3])
    ax = drawn(plot.pareto(table, maximize=["lift_mean_mn", "power_mean_mw"], color="centre_of_pressure"))
    assert sum(len(each.get_offsets()) for each in ax.collections) == 8
    assert legend(ax) == ["folded", "directional", "front (8 of 8 designs)"]
    assert ax.lines[0].get_drawstyle() == "steps-pre"


def test_more_than_two_objectives_ring_the_front(sweep):
    ax = drawn(plot.pareto(sweep, maximize=["lift_mean_mn", "efficiency_gf_per_w"], minimize="strain_surface_max"))
    costs = np.column_stack([sweep["strain_surface_max"], -sweep["lift_mean_mn"], -sweep["efficiency_gf_per_w"]])
    assert len(ax.lines[0].get_xdata()) == analysis.non_dominated(costs).sum()
    assert ax.lines[0].get_linestyle() == "None"
    assert "Efficiency (more)" in ax.get_legend().get_title().get_text()


def test_pareto_mistakes(sweep):
    assert "two different objectives" in message(ValueError, plot.pareto, sweep, maximize="lift_mean_mn")
    text = message(ValueError, plot.pareto, sweep, maximize="lift_mean_mn", minimize="power_mean")
    assert "did you mean `power_mean_mw`?" in text
    table = fails(grid(drive_frequency=HERTZ), slice(None))
    assert "no row" in message(ValueError, plot.pareto, table, maximize="lift_mean_mn", minimize="power_mean_mw")
