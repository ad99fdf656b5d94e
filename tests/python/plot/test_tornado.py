"""Sensitivities and their bars."""

import dataclasses

import flapwing
import pytest
from figures import drawn, legend, message
from flapwing import analysis, plot

TRIED = ["drive_frequency", "hinge_stiffness", "wing_length"]


@pytest.fixture(scope="module")
def sensitivities():
    return analysis.sensitivities("ozaki2018-large", "lift_mean_mn", TRIED)


def test_sensitivities_are_those_of_single_runs(sensitivities):
    assert [each.swing for each in sensitivities] == sorted((each.swing for each in sensitivities), reverse=True)
    assert {each.parameter for each in sensitivities} == set(TRIED)
    for each in sensitivities:
        value = flapwing.params("ozaki2018-large")[each.parameter].value
        assert (each.below, each.above) == (pytest.approx(0.95 * value), pytest.approx(1.05 * value))
        assert each.low == flapwing.run("ozaki2018-large", **{each.parameter: each.below})["lift_mean_mn"]
        assert each.high == flapwing.run("ozaki2018-large", **{each.parameter: each.above})["lift_mean_mn"]
        assert each.base == flapwing.run("ozaki2018-large")["lift_mean_mn"]
        assert each.swing == max(abs(each.low - each.base), abs(each.high - each.base))
        assert each.measure_unit == "mN"


def test_what_follows_a_parameter_follows_its_change():
    (each,) = analysis.sensitivities("ozaki2018-large", "lift_mean_mn", ["drive_voltage_pp"])
    assert each.high == flapwing.run("ozaki2018-large", drive_voltage_pp=105.0)["lift_mean_mn"]


def test_fixed_parameters_and_ranges_of_ones_own():
    found = analysis.sensitivities(
        "ozaki2018-large",
        "power_mean_mw",
        {"drive_voltage_pp": 0.1, "drive_frequency": (100.0, 104.0)},
        drive_voltage_pp="80 V",
        rtol=1e-5,
    )
    by_name = {each.parameter: each for each in found}
    volts, hertz = by_name["drive_voltage_pp"], by_name["drive_frequency"]
    assert (volts.value, volts.below, volts.above) == pytest.approx((80.0, 72.0, 88.0))
    assert (hertz.below, hertz.above) == (100.0, 104.0)
    wanted = flapwing.run("ozaki2018-large", drive_voltage_pp=80.0, drive_frequency=104.0, rtol=1e-5)
    assert hertz.high == wanted["power_mean_mw"]
    (falling,) = analysis.sensitivities(
        "ozaki2018-large", "power_mean_mw", {"drive_frequency": (104.0, 100.0)}, drive_voltage_pp=80.0, rtol=1e-5
    )
    assert falling == hertz


def test_tornado_draws_bars_in_order(sensitivities):
    ax = drawn(plot.tornado(sensitivities))
    low, high = ax.containers[:2]
    for i, each in enumerate(sensitivities):
        assert low[i].get_width() == pytest.approx(100 * (each.low / each.base - 1))
        assert high[i].get_width() == pytest.approx(100 * (each.high / each.base - 1))
        assert low[i].get_y() + low[i].get_height() / 2 == pytest.approx(i)
    assert ax.yaxis_inverted()
    assert {bar.get_height() for bar in (*low, *high)} == {0.62}
    labels = [text.get_text() for text in ax.get_yticklabels()]
    assert set(labels) == {"Drive frequency, 109 Hz", "Hinge stiffness, 86.4 µN·m/rad", "Wing length, 32.4 mm"}
    assert legend(ax) == ["−5 %", "+5 %"]
    assert ax.get_xlabel() == "Change of lift, mean (% of 4.597 mN)"
    shorter = drawn(plot.tornado(sensitivities, top=2))
    assert len(shorter.get_yticklabels()) == 2
    assert "1 smaller" in shorter.get_legend().get_title().get_text()


def test_tornado_runs_what_it_draws():
    ax = plot.tornado("ozaki2018-large", "lift_mean_mn", ["wing_length"], change=0.01)
    assert legend(ax) == ["−1 %", "+1 %"]


def test_the_lower_value_of_a_negative_parameter_has_the_larger_size(sensitivities):
    negative = dataclasses.replace(sensitivities[0], value=-10.0, below=-10.5, above=-9.5)
    assert legend(plot.tornado([negative])) == ["lower value", "upper value"]


def test_changes_that_go_the_same_way_are_both_seen(sensitivities):
    first = sensitivities[0]
    ax = plot.tornado([dataclasses.replace(first, low=0.8 * first.base, high=0.9 * first.base)])
    (long,), (short,) = ax.containers[:2]
    assert (long.get_height(), short.get_height()) == (0.62, 0.28)
    assert short.get_zorder() > long.get_zorder()


def test_by_default_all_numbers_that_can_be_changed_are():
    found = {each.parameter for each in analysis.sensitivities("arabagi2013-75hz", "lift_mean_mn", rtol=1e-4)}
    known = flapwing.params("arabagi2013-75hz")
    numbers = {name for name, each in known.items() if each.is_number and each.value != 0}
    assert found == numbers - {"strips"}


def test_a_change_without_a_periodic_motion_is_said(sensitivities):
    lost = [dataclasses.replace(sensitivities[0], high=float("nan")), *sensitivities[1:]]
    ax = drawn(plot.tornado(lost))
    assert [text.get_text() for text in ax.texts] == ["no periodic motion at +5 %"]


@pytest.mark.parametrize(
    ("entries", "measure", "parameters", "says"),
    [
        ({}, "status", ["wing_length"], "there is no measure `status`"),
        ({}, "lift_mean", ["wing_length"], "did you mean `lift_mean_mn`?"),
        ({}, "lift_mean_mn", {"wing_length": (0.03, 0.03)}, "both values of `wing_length` are 0.03: give two"),
        ({"axes": {"drive_bias": [0.0, 1.0]}}, "lift_mean_mn", ["wing_length"], "has 2 points, but one is required"),
        ({"where": {"slow": "drive_frequency < 1"}}, "lift_mean_mn", ["wing_length"], "[where] excludes the design"),
        (
            {"where": {"long": "wing_length > 0.0299"}},
            "lift_mean_mn",
            {"wing_length": 0.5},
            "[where] of the grid excludes the design with `wing_length` = ",
        ),
        (
            {"output": {"columns": ["power_mean_mw"]}},
            "lift_mean_mn",
            ["wing_length"],
            "the rows of the grid have no `lift_mean_mn`\nadd it to `columns` under [output]",
        ),
    ],
)
def test_designs_and_measures_without_sensitivities_are_refused(entries, measure, parameters, says):
    grid = {"preset": "ozaki2018-large", **entries}
    assert says in message(ValueError, analysis.sensitivities, grid, measure, parameters)


def test_tornado_mistakes():
    assert "did you mean `wing_length`?" in message(
        ValueError, plot.tornado, "ozaki2018-large", "lift_mean_mn", ["wing_lengt"]
    )
    assert "did you mean `lift_mean_mn`?" in message(
        ValueError, plot.tornado, "ozaki2018-large", "lift_mean", ["wing_length"]
    )
    assert "only numbers" in message(ValueError, plot.tornado, "ozaki2018-large", "lift_mean_mn", ["lift_sign"])
    assert "set it, as in `drive_bias=…`" in message(
        ValueError, plot.tornado, "ozaki2018-large", "lift_mean_mn", ["drive_bias"]
    )
    assert "more than zero" in message(
        ValueError, plot.tornado, "ozaki2018-large", "lift_mean_mn", ["wing_length"], change=0
    )
    told = message(TypeError, plot.tornado, "ozaki2018-large", "lift_mean_mn", {"drive_voltage_pp": "5 V"})
    assert told.startswith("`parameters['drive_voltage_pp']` is str, which raised ValueError: could not convert")
    assert told.endswith("\nit must be a relative change, or a pair of values in SI units")
    assert "the two values" in message(ValueError, plot.tornado, "jafferis2016", "lift_mean_mn", ["actuator_mass"])
    assert "no sensitivities" in message(ValueError, plot.tornado, [])
    assert "`measure`" in message(TypeError, plot.tornado, "ozaki2018-large")
