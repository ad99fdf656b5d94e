"""Comparisons of fits choose the right law, and selections find the parameter that the data require."""

from dataclasses import replace
from types import SimpleNamespace

import flapwing
import numpy as np
import pytest
from fits import PRESET, TRUE, TRUTH, readings
from flapwing.fitting import _deciding, _select, _subsets
from flapwing.fitting._compare import Comparison
from flapwing.fitting._criteria import criteria
from flapwing.fitting._data import DataSet
from flapwing.fitting._noise import Noise
from flapwing.fitting._parameters import Coordinate, Space
from scipy.stats import linregress, norm

BOTH = ["stroke_pp_deg", "pitch_amplitude_deg"]
POINTS = {
    "drive_frequency": np.tile(np.linspace(75.0, 145.0, 8), 2),
    "drive_voltage_pp": np.repeat([120.0, 160.0], 8),
}
LOSS = {"stroke_loss_factor": (0.0, 0.5)}
DAMPING = {"hinge_damping": (0.0, 1e-9)}
FAST = {"sigma": "3 %", "starts": 1, "profile": False}


def fits(data, *added, **options):
    return [flapwing.fit(PRESET, data, {**dict.fromkeys(TRUE), **more}, **{**FAST, **options}) for more in added]


@pytest.fixture(scope="module")
def lossy():
    """Readings of a robot whose stroke loses energy."""
    return readings(BOTH, points=POINTS, stroke_loss_factor=0.2)


@pytest.fixture(scope="module")
def compared(lossy):
    made = fits(lossy, {}, DAMPING, LOSS, hold_out={"drive_frequency": (100, 115)})
    return flapwing.compare(made, names=["paper", "hinge", "stroke"])


def test_the_right_law_is_chosen(compared):
    best, second, third = compared.fits
    assert compared.chosen == best.name == "stroke" and compared.is_decided and compared.readings == 24
    assert [second.name, third.name] == ["hinge", "paper"] and third.delta_aicc > second.delta_aicc > 5
    assert best.held_out_score > third.held_out_score
    assert sum(one.weight for one in compared.fits) == pytest.approx(1.0)
    assert "stroke is clearly better" in str(compared) and "held-out rms (stroke_pp_deg)" in str(compared)


def test_the_held_out_score_is_the_density_of_the_predictions(compared, lossy):
    """The density contains the discrepancy of the law that lacks the loss."""
    held = (lossy["drive_frequency"] >= 100) & (lossy["drive_frequency"] <= 115)
    points = {name: lossy[name][held] for name in POINTS}
    assert [bool(side.fit.discrepancy) for side in compared._sides] == [False, False, True]
    for one, side in zip(compared.fits, compared._sides):
        predicted = [(lossy[name][held], side.fit.predict(points, name, reading=True)) for name in BOTH]
        scores = [norm.logpdf(measured, found.value, found.error) for measured, found in predicted]
        assert one.held_out_score == pytest.approx(np.mean(scores), rel=1e-3)


def test_predictions_with_an_undetermined_parameter_have_no_score():
    sets = [flapwing.Readings(readings(points=POINTS, seed=seed), name=f"wing {seed}") for seed in range(2)]
    free = {"hinge_stiffness": flapwing.FreeParameter(per_set=True)}
    options = {**FAST, "hold_out": "wing 1", "wing_inertia_stroke": TRUTH["wing_inertia_stroke"]}
    made = [flapwing.fit(PRESET, sets, {**free, **dict.fromkeys(more)}, **options) for more in ([], list(TRUE)[2:])]
    compared = flapwing.compare(made)
    assert all(np.isnan(one.held_out_score) for one in compared.fits)
    assert sorted(one.parameters for one in compared.fits) == [1, 2]
    assert "fit 1 has no log score: the errors of some held-out predictions are unknown" in str(compared)


@pytest.mark.parametrize("sigma", [None, 0.8])
def test_the_chance_of_a_step_is_exact_for_a_line(sigma):
    """A constant and a line, with the p value of the t test of the slope for an estimated standard error."""
    draw, x = np.random.default_rng(5), np.linspace(-1.0, 1.0, 9)
    y = x + draw.normal(size=9)
    noise = {"stroke_pp_deg": Noise("unknown") if sigma is None else Noise("absolute", sigma)}
    sets = [DataSet("set 1", {}, {"stroke_pp_deg": y}, noise, None, "drive_frequency")]
    line = linregress(x, y)
    states = []
    for values, columns in [(np.full(9, y.mean()), [x**0]), (line.intercept + line.slope * x, [x**0, x])]:
        slopes = np.stack(columns, axis=1)
        space = Space([Coordinate(name, None, name, "", False, -9.0, 9.0, 0.0, None) for name in "ab"[: len(columns)]])
        answer = SimpleNamespace(values=values, slopes=slopes)
        found = criteria(sets, space, np.zeros(len(columns)), answer, np.ones(9, np.bool_))
        states.append(SimpleNamespace(criteria=found))
    p = line.pvalue if sigma is None else 2 * norm.sf(abs(line.slope) * np.sqrt(x @ x) / sigma)
    assert 1e-4 < p < 0.4 and _select._chance(*states, 1) == pytest.approx(p)
    assert _select._chance(*states, 2) == pytest.approx(2 * p)
    assert _select._chance(states[0], states[0], 1) == 1.0


def test_plans_of_fits_with_unknown_noise_contain_the_noise_of_both_fits():
    """The wrong law leaves a pattern, so its residuals are discrepancy. Its standard error is still not zero."""
    points = {
        "drive_frequency": np.tile(np.linspace(75.0, 145.0, 15), 2),
        "drive_voltage_pp": np.repeat([120.0, 160.0], 15),
    }
    data = readings(BOTH, points=points, noise=0.01, drag_coefficient_min=1.5)
    compared = flapwing.compare(fits(data, {}, {"drag_coefficient_min": (0.05, 2.0)}, sigma=None))
    assert compared._sides[1].fit.goodness.is_structured
    points = {"drive_frequency": [100.0, 120.0], "drive_voltage_pp": 180.0}
    plan = compared.next_measurements(points, count=1)
    measured = np.array(BOTH).repeat(30) == plan.measures[0]
    sizes = [np.sqrt(np.mean((side.values[measured] - data[plan.measures[0]]) ** 2)) for side in compared._sides[:2]]
    assert plan.errors[0] > np.sqrt(np.mean(np.square(sizes)))


def test_criteria_follow_from_the_residuals(lossy):
    first, second = fits(lossy, {}, LOSS, sigma={"stroke_pp_deg": 2.0, "pitch_amplitude_deg": "1 deg"})
    compared = flapwing.compare([first, second])
    for one, fit in zip(sorted(compared.fits, key=lambda one: one.name), (first, second)):
        count, free = 32, len(fit.estimates)
        residuals = [part.values for part in fit.goodness.residuals]
        chi_square = sum(float(np.sum((part / size) ** 2)) for part, size in zip(residuals, (2.0, 1.0)))
        assert one.chi_square == pytest.approx(chi_square) and one.parameters == free
        deviance = chi_square + 16 * np.log(2 * np.pi * 4.0) + 16 * np.log(2 * np.pi)
        assert one.deviance == pytest.approx(deviance)
        assert one.aicc == pytest.approx(deviance + 2 * free + 2 * free * (free + 1) / (count - free - 1))
        assert one.bic == pytest.approx(deviance + free * np.log(count))
    deciding = compared.deciding_readings(count=1000)
    differences = [one.difference for one in deciding]
    assert len(differences) == 32 and np.all(np.diff(np.abs(differences)) <= 0)
    assert sum(differences) == pytest.approx(0.5 * (compared.fits[1].deviance - compared.fits[0].deviance))
    one = deciding[0]
    assert lossy[one.measure][one.row - 1] == one.reading
    assert one.point == {name: values[one.row - 1] for name, values in POINTS.items()}


def test_unknown_standard_errors_have_a_concentrated_likelihood(lossy):
    pair = fits(lossy, {}, LOSS, sigma=None)
    compared = flapwing.compare(pair)
    assert compared.chosen == "fit 2" and compared.is_decided
    for one, fit in zip(sorted(compared.fits, key=lambda one: one.name), pair):
        spreads = [np.mean(part.values**2) for part in fit.goodness.residuals]
        assert one.deviance == pytest.approx(sum(16 * (np.log(2 * np.pi * spread) + 1) for spread in spreads))
        assert one.parameters == len(fit.estimates) + 2


@pytest.mark.parametrize("best", [0, 1])
def test_held_out_errors_are_compared_over_readings_that_all_fits_predict(best):
    """Errors of 1, 1, 1, 1, 8, and of 1.2 at four readings without a motion at the fifth."""
    noise = {"stroke_pp_deg": Noise("absolute", 1.0)}
    sets = [DataSet("set 1", {}, {"stroke_pp_deg": np.zeros(10)}, noise, None, "drive_frequency")]
    held, sides = np.arange(10) >= 5, []
    for place, errors in enumerate([[1.0, -1.0, 1.0, -1.0, 8.0], [1.2, -1.2, 1.2, -1.2, np.nan]]):
        values = np.concatenate([np.zeros(5), errors])
        answer = SimpleNamespace(values=values, slopes=np.zeros((10, 0)))
        fit = SimpleNamespace(
            _held=held,
            _sets=sets,
            _model=SimpleNamespace(outputs=SimpleNamespace(measure=["stroke_pp_deg"] * 10)),
            goodness=SimpleNamespace(p=0.5, is_structured=False),
        )
        found = criteria(sets, Space([]), np.zeros(0), answer, ~held)
        found = replace(found, aicc=found.aicc + 5.0 * (place != best))
        sides.append(_deciding.Side(f"fit {place + 1}", fit, values, np.ones(10), found))
    compared = Comparison(sides)
    first, second = sorted(compared.fits, key=lambda one: one.name)
    assert first.held_out_rms == {"stroke_pp_deg": pytest.approx(1.0)}
    assert second.held_out_rms == {"stroke_pp_deg": pytest.approx(1.2)}
    constant = 0.5 * np.log(2 * np.pi)
    assert first.held_out_score == pytest.approx(-0.5 - constant)
    assert second.held_out_score == pytest.approx(-0.72 - constant)
    assert (compared.readings, compared.left_out, compared.held_out_left_out) == (5, 0, 1)
    told = "held-out readings that are not compared, because a fit has no settled motion there: 1"
    assert told in str(compared).splitlines()
    assert ("fit 1 predicts the compared readings that were held out best" in compared.verdict) == (best == 1)
    assert "fit 2 predicts" not in compared.verdict


def test_readings_that_do_not_decide():
    """Readings of the paper's law: a further parameter explains only noise."""
    compared = flapwing.compare(fits(readings(BOTH, points=POINTS, seed=5), LOSS, {}), names=["losses", "paper"])
    assert not compared.is_decided and compared.chosen == "paper"
    assert "do not decide between" in compared.verdict and "paper has the fewest parameters" in compared.verdict


def test_next_measurements_are_where_predictions_differ(compared):
    candidates = {"drive_frequency": np.linspace(70, 150, 9), "drive_voltage_pp": 180.0}
    found = compared.next_measurements(candidates, count=3, measures=["stroke_pp_deg"])
    stroke, hinge = (side.fit.predict(candidates, "stroke_pp_deg") for side in compared._sides[:2])
    noise = 0.5 * 0.03**2 * (hinge.value**2 + stroke.value**2)
    gains = 0.5 * (hinge.value - stroke.value) ** 2
    gains = gains / (noise + hinge.error**2) + gains / (noise + stroke.error**2)
    best = int(np.argmax(gains))
    assert found.points[0] == {"drive_frequency": candidates["drive_frequency"][best], "drive_voltage_pp": 180.0}
    assert found.values[0] == (stroke.value[best], hinge.value[best]) and found.names == ("stroke", "hinge")
    assert found.expected[0] == pytest.approx(gains[best], rel=1e-3)
    assert found.expected[0] < found.expected[1] < found.expected[2]
    assert "expected difference" in str(found)


def test_candidates_have_the_parameters_that_all_data_share():
    points = {"drive_frequency": np.linspace(75.0, 145.0, 8), "drive_voltage_pp": np.full(8, 120.0)}
    data = readings(BOTH, points=points, stroke_loss_factor=0.2)
    shared = flapwing.Readings(
        {name: data[name] for name in ("drive_frequency", *BOTH)}, drive_voltage_pp="120 V", name="shared"
    )
    options = {**FAST, "wing_inertia_stroke": TRUTH["wing_inertia_stroke"]}
    made = [
        flapwing.fit(PRESET, shared, ["hinge_stiffness", *more], **options) for more in ([], ["drag_coefficient_max"])
    ]
    compared = flapwing.compare(made)
    plan = compared.next_measurements({"drive_frequency": [110.0]}, count=1, measures=["stroke_pp_deg"])
    assert plan.points == [{"drive_frequency": 110.0, "drive_voltage_pp": 120.0}]
    predicted = [side.fit.predict({"drive_frequency": [110.0]}, "stroke_pp_deg").value[0] for side in compared._sides]
    assert list(plan.values[0]) == predicted
    with pytest.raises(ValueError, match="candidates has `hinge_stiffness`, which was fitted\nleave it out"):
        compared.next_measurements({"drive_frequency": [110.0], "hinge_stiffness": 1e-6})


def test_expected_differences_contain_the_new_fits():
    """For linear laws, the expected difference is the rise of chi-square after a new fit of the wrong law."""
    draw = np.random.default_rng(3)
    slopes = [draw.normal(size=(4, 2)), draw.normal(size=(4, 3))]
    values = [draw.normal(size=4), draw.normal(size=4)]
    roots = [np.vstack([draw.normal(size=(6, width)), 0.01 * np.eye(width)]) for width in (2, 3)]
    variance = draw.uniform(0.5, 2.0, 4)
    # Without the weak prior of the method, which the last rows of `roots` replace.
    informations = [root.T @ root - 1e-4 * np.eye(root.shape[1]) for root in roots]
    laws = [SimpleNamespace(_information=one) for one in informations]
    chosen, _, expected = _deciding._decide(values, slopes, variance, laws, 3)
    rises = []
    for place, other in ((0, 1), (1, 0)):
        weights = 1.0 / np.sqrt(variance[chosen])
        matrix = np.vstack([roots[place], slopes[place][chosen] * weights[:, np.newaxis]])
        wanted = np.concatenate([np.zeros(len(roots[place])), (values[other] - values[place])[chosen] * weights])
        rises.append(np.linalg.lstsq(matrix, wanted, rcond=None)[1][0])
    assert expected[-1] == pytest.approx(np.mean(rises))


def test_select_finds_the_missing_term(lossy):
    data = flapwing.Readings(lossy, sigma="3 %")
    candidates = flapwing.candidates(PRESET)
    held = {"drive_frequency": (100, 115)}
    found = flapwing.select(PRESET, data, candidates, start=list(TRUE), starts=1, profile=False, hold_out=held)
    assert found.parameters == [*TRUE, "stroke_loss_factor"]
    first, second = found.steps
    assert second.gain == pytest.approx(first.criterion - second.criterion) and second.gain > 10 and second.p < 1e-3
    assert second.held_out < first.held_out and second.held_out < 1.5
    estimate = found.fit.estimates["stroke_loss_factor"]
    assert abs(estimate.value - 0.2) < 3 * estimate.error
    # The path and the final fit agree, also with a fit of its own.
    assert found.fit.goodness.chi_square == pytest.approx(second.chi_square, abs=0.1)
    alone = fits(lossy, LOSS, hold_out=held)[0]
    assert found.fit.goodness.chi_square == pytest.approx(alone.goodness.chi_square, abs=0.1)
    assert found.rhs_evals < 3e7 and set(found.remaining) == set(candidates) - set(found.parameters)
    told = str(found)
    assert "start" in told and "stroke_loss_factor" in told and "stopped: " in told and "right-hand sides" in told


@pytest.mark.parametrize(
    ("measures", "added", "term", "value"),
    [
        (BOTH, [], "pressure_term_1", 0.06),
        ([*BOTH, "lift_mean_mn"], ["lift_term_1", "lift_term_2", "drag_term_0", "drag_term_1"], "lift_term_1", -0.3),
    ],
)
def test_select_finds_another_law_of_the_attack_angle(measures, added, term, value):
    data = readings(measures, points=POINTS, **{term: value})
    candidates = flapwing.candidates(PRESET) | dict.fromkeys(added)
    found = flapwing.select(PRESET, data, candidates, start=list(TRUE), **FAST)
    assert [step.freed for step in found.steps] == ["", term] and found.steps[1].gain > 10
    estimate = found.fit.estimates[term]
    assert abs(estimate.value - value) < 3 * estimate.error < abs(value)


def test_select_from_nothing_within_a_budget(lossy):
    candidates = {**dict.fromkeys(TRUE), **LOSS}
    found = flapwing.select(PRESET, lossy, candidates, budget=2, criterion="BIC", **FAST)
    assert len(found.parameters) == 2 and "the budget of 2 parameters is used" in found.stopped
    criteria = [step.criterion for step in found.steps]
    assert criteria == sorted(criteria, reverse=True) and found.criterion == "BIC"
    short = flapwing.select(PRESET, lossy, candidates, rhs_budget=1, **FAST)
    assert short.final is None and short.parameters == [] and "right-hand sides" in short.stopped


def test_select_removes_what_later_parameters_replace(monkeypatch):
    """Readings by another drag law, which first seem to require another lift."""
    predicted = _subsets.Subsets.predicted

    def lift_first(work, state, more):
        return dict(sorted(predicted(work, state, more).items(), key=lambda one: one[0] != "lift_coefficient_max"))

    monkeypatch.setattr(_subsets.Subsets, "predicted", lift_first)
    data = readings(BOTH, points=POINTS, noise=0.02, drag_coefficient_min=1.0)
    candidates = {"lift_coefficient_max": None, "drag_coefficient_min": (0.05, 2.0)}
    found = flapwing.select(PRESET, data, candidates, start=list(TRUE), tries=1, **{**FAST, "sigma": "2 %"})
    assert [step.freed for step in found.steps] == ["", "lift_coefficient_max", "drag_coefficient_min", ""]
    assert found.steps[-1].removed == "lift_coefficient_max" and found.parameters == [*TRUE, "drag_coefficient_min"]
    assert "lift_coefficient_max removed" in str(found) and found.at_bounds == []
    narrow = {"drag_coefficient_min": (0.1, 0.4)}
    assert flapwing.select(PRESET, data, narrow, start=list(TRUE), **FAST).at_bounds == ["drag_coefficient_min"]


def test_candidates_with_the_same_effect_count_as_one():
    stiffer = 1.3 * flapwing.params(PRESET)["transmission_stiffness"].value
    data = readings(BOTH, points=POINTS, transmission_stiffness=stiffer)
    names = ["stiffness_factor", "deflection_factor", "drag_coefficient_min"]
    first, second = flapwing.select(PRESET, data, names, start=list(TRUE), tries=1, **FAST).steps
    (difference,) = second.alternatives.values()
    assert {second.freed, *second.alternatives} == {"stiffness_factor", "deflection_factor"} and difference < 0.5


def test_select_frees_nothing_for_noise():
    data = readings(BOTH, points=POINTS)
    found = flapwing.select(PRESET, data, flapwing.candidates(PRESET), start=list(TRUE), **FAST)
    assert found.parameters == list(TRUE) and len(found.steps) == 1


@pytest.mark.parametrize("preset", ["jafferis2016", "ozaki2018-small", "arabagi2013-75hz"])
def test_candidates_are_fitted_numbers_and_terms(preset, flap):
    """Parameters with a star in the table of the model, and terms with bounds that contain the design's value."""
    candidates, params = flapwing.candidates(preset), flapwing.params(preset)
    listed = flap("models", preset).stdout
    starred = {line.split()[0] for line in listed.splitlines() if " * " in line}
    assert starred & set(params) <= set(candidates) <= set(params)
    assert {"hinge_stiffness", "hinge_damping", "stroke_loss_factor", "pressure_term_1"} <= set(candidates)
    assert "drag_term_0" in params and "drag_term_0" not in candidates
    for name, free in candidates.items():
        assert free.low is None or free.low <= params[name].value <= free.high


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"seed": 2}, "fit 1 and fit 2 have different readings of stroke_pp_deg in set 1"),
        ({"sigma": "2 %"}, "have different standard errors of stroke_pp_deg"),
        ({"hold_out": 0.3}, "have different readings that are held out"),
        ({"loss": "cauchy"}, 'fit 2 has loss="cauchy", which has no likelihood'),
        ({"measures": BOTH}, "have different measures in set 1"),
    ],
)
def test_fits_of_other_readings_are_refused(change, message):
    def fit(seed=1, measures=("stroke_pp_deg",), **options):
        points = {name: values[:6] for name, values in POINTS.items()}
        data = readings(measures, points=points, seed=seed)
        return flapwing.fit(PRESET, data, ["hinge_stiffness"], **{**FAST, **options})

    with pytest.raises(ValueError, match=message):
        flapwing.compare([fit(), fit(**change)])


def test_mistakes_in_calls():
    with pytest.raises(TypeError, match="`fits` has an entry that is str"):
        flapwing.compare(["one", "two"])
    with pytest.raises(TypeError, match="(?s)`fits` is int.*it must be a list of results of flapwing.fit"):
        flapwing.compare(3)
    with pytest.raises(ValueError, match="`fits` has 0 fits"):
        flapwing.compare([])
    for keywords, message in [
        ({"criterion": "AIC"}, "`criterion` is 'AIC'"),
        ({"significance": 0}, "`significance` is 0"),
        ({"budget": 0}, "`budget` must be 1 or more, not 0"),
        ({"budget": 1, "start": ["wing_area", "wing_length"]}, "`start` has 2 parameters"),
        ({"start": ["hinge_stiffness"]}, "no parameter that is not in `start`"),
    ]:
        with pytest.raises(ValueError, match=message):
            flapwing.select(PRESET, readings(), ["hinge_stiffness"], sigma="3 %", **keywords)
    with pytest.raises(ValueError, match="`candidates` has `hinge_stiffness` twice\nremove one"):
        flapwing.select(PRESET, readings(), ["hinge_stiffness", "hinge_stiffness"], sigma="3 %")
    with pytest.raises(ValueError, match="`actuator_mass` is zero in the design"):
        flapwing.select(PRESET, readings(), ["actuator_mass"], sigma="3 %")
    with pytest.raises(ValueError, match="`wing_radius_1` has no value in the design"):
        flapwing.select(PRESET, readings(), {"wing_radius_1": (0.3, 0.7)}, sigma="3 %")
