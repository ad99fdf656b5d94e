"""Fits find parameters, and say how well they are known."""

import flapwing
import numpy as np
import pytest
from fits import FREQUENCY, PRESET, TRUE, TRUTH, readings
from flapwing.fitting import _fit, _search
from flapwing.fitting._parameters import Coordinate, Space
from flapwing.fitting._search import Target
from scipy.stats import norm

#: The true parameters without the hinge stiffness.
BESIDE = {name: value for name, value in TRUTH.items() if name != "hinge_stiffness"}


@pytest.fixture(scope="module")
def found():
    return flapwing.fit(PRESET, readings(), list(TRUE), sigma="3 %", starts=3)


def test_a_fit_finds_the_truth(found):
    for name, value in TRUTH.items():
        one = found.estimates[name]
        assert one.is_known and not one.at_bound
        assert abs(one.value - value) < 3.5 * one.error
        assert one.low < one.value < one.high
        # Well known parameters have profiles that are about straight.
        assert one.high - one.low == pytest.approx(2 * 1.96 * one.error, rel=0.15)
    assert found.converged and found.indistinct == [] and found.unsettled == []
    assert found.goodness.freedom == 27 and 0.001 < found.goodness.p < 0.999 and not found.goodness.is_structured
    assert found.effort.agreed >= 2
    row = flapwing.run(PRESET, drive_frequency=100.0, drive_voltage_pp=160.0, **found.values)
    assert row["status"] == "periodic"


def test_a_fit_is_the_same_for_any_number_of_threads():
    one, two = (
        flapwing.fit(PRESET, readings(), list(TRUE), sigma="3 %", starts=2, profile=False, threads=threads)
        for threads in (1, 2)
    )
    assert one.values == two.values


def test_a_search_that_begins_at_a_bound_moves_away():
    """The damping is zero in the design, which is the lower bound."""
    free = {"hinge_stiffness": None, "hinge_damping": (0.0, "1 nN*m*s")}
    data = readings(hinge_damping="0.3 nN*m*s")
    result = flapwing.fit(PRESET, data, free, sigma="2 deg", starts=1, profile=False, **BESIDE)
    one = result.estimates["hinge_damping"]
    assert abs(one.value - 0.3e-9) < 3.5 * one.error < 0.4e-9 and result.converged
    assert result.effort.points < 15 * len(FREQUENCY)


def test_intervals_cover_the_truth():
    """A small version of benches/fit/coverage.py: of 24 intervals 95 % should hold the truth. If they do, 18
    or fewer of them are as good as impossible."""
    inside = 0
    for seed in range(8):
        data = readings(seed=seed)
        result = flapwing.fit(PRESET, data, list(TRUE), sigma="3 %", starts=1, seed=seed, profile=False)
        inside += sum(one.low <= TRUTH[name] <= one.high for name, one in result.estimates.items())
    assert 19 <= inside


def test_parameters_that_cannot_be_told_are_named():
    """Only the sum of the two inertias is in the equations, and a vehicle's mass moves no wing."""
    free = [*TRUE, "added_inertia_stroke", "vehicle_mass"]
    data = {name: values[::3] for name, values in readings().items()}
    result = flapwing.fit(PRESET, data, free, sigma="3 %", starts=1)
    assert len(result.indistinct) == 2
    assert "vehicle_mass changes no reading" in result.indistinct
    assert any("added_inertia_stroke" in told and "wing_inertia_stroke" in told for told in result.indistinct)
    known = {name: one.is_known for name, one in result.estimates.items()}
    assert known == {
        "hinge_stiffness": True,
        "wing_inertia_stroke": False,
        "drag_coefficient_max": True,
        "added_inertia_stroke": False,
        "vehicle_mass": False,
    }
    assert result.estimates["vehicle_mass"].profile.is_flat
    assert "no such data can determine this" in str(result) and "not fixed by the data" in str(result)


def test_products_that_cannot_be_told_are_named():
    """Lengths of a tail that no equation has alone: the drag is the product of the air's density and all coefficients."""
    free = ["air_density", "drag_coefficient_max", "drag_coefficient_min", "lift_coefficient_max"]
    data = readings(["stroke_pp_deg", "pitch_amplitude_deg"])
    result = flapwing.fit(PRESET, data, free, sigma="3 %", starts=1, profile=False, rotation_pressure_width=0.0)
    assert len(result.indistinct) == 1
    assert all(
        f"{name} down by 1 %" in result.indistinct[0] or f"{name} up by 1 %" in result.indistinct[0] for name in free
    )


def test_a_wrong_model_is_told():
    """Data by another drag law: chi-square is poor, and residuals have a pattern."""
    data = readings(["stroke_pp_deg", "pitch_amplitude_deg"], noise=0.02, drag_coefficient_min=1.5)
    result = flapwing.fit(PRESET, data, list(TRUE), sigma="2 %", starts=1, profile=False)
    assert result.goodness.p < 1e-6 and result.goodness.is_structured
    assert "POOR" in str(result) and "STRUCTURED" in str(result)


def test_readings_of_another_robot_are_told():
    """Data by the four-bar model."""
    points = {
        "drive_frequency": np.tile(np.linspace(60.0, 90.0, 20), 2),
        "drive_voltage_pp": np.repeat([120.0, 150.0], 20),
    }
    table = flapwing.evaluate("arabagi2013-75hz", points)
    draw = np.random.default_rng(1)
    data = {name: table[name] * (1 + draw.normal(0.0, 0.02, 40)) for name in ("stroke_pp_deg", "pitch_amplitude_deg")}
    free = {
        "hinge_stiffness": None,
        "wing_inertia_stroke": (1e-11, 1e-9),
        "drag_coefficient_max": None,
        "force_factor": (0.05, 3.0),
    }
    result = flapwing.fit(PRESET, {**points, **data}, free, sigma="2 %", starts=2, profile=False)
    assert result.goodness.p < 1e-6 and result.goodness.is_structured


def test_errors_that_are_not_known_are_estimated():
    data = readings(["stroke_pp_deg", "pitch_amplitude_deg"], noise=0.01)
    result = flapwing.fit(PRESET, data, list(TRUE), starts=1)
    assert not result.sigma_known and np.isnan(result.goodness.p)
    assert result.goodness.chi_square == pytest.approx(result.goodness.freedom, rel=0.05)
    assert "estimated from the residuals" in str(result)
    for name, value in TRUTH.items():
        assert abs(result.estimates[name].value - value) < 4 * result.estimates[name].error


def test_intervals_with_estimated_errors_have_the_quantiles_of_t():
    data = {name: values[:7] for name, values in readings(noise=0.01).items()}
    result = flapwing.fit(PRESET, data, ["hinge_stiffness"], starts=1, profile=False, **BESIDE)
    one = result.estimates["hinge_stiffness"]
    assert result.goodness.freedom == 6 and result._quantile == pytest.approx(2.4469, rel=1e-4)
    assert one.high - one.low == pytest.approx(2 * 2.4469 * one.error, rel=0.01)


def test_intervals_belong_to_the_last_standard_errors(monkeypatch):
    """The first guess of the standard error is about three times the noise."""
    monkeypatch.setattr(_fit, "_ROUNDS", 1)
    result = flapwing.fit(PRESET, readings(noise=0.01), ["hinge_stiffness"], starts=1, **BESIDE)
    one = result.estimates["hinge_stiffness"]
    assert result.goodness.chi_square == pytest.approx(29, rel=0.01)
    assert one.high - one.low == pytest.approx(2 * 2.0452 * one.error, rel=0.05)


@pytest.mark.parametrize(
    ("loss", "curvature", "variance"),
    [("linear", 1, 1), ("soft_l1", 0.5649, 1.0790), ("huber", 0.6827, 1.1073), ("cauchy", 0.3443, 1.3131),
     ("arctan", 0.2682, 2.0552)],
)  # fmt: skip
def test_errors_with_a_robust_loss_are_errors_of_m_estimators(loss, curvature, variance):
    """The expected values are integrals over the normal distribution."""
    residuals = norm.ppf((np.arange(20000) + 0.5) / 20000)
    assert _search.robust_factors(residuals, loss, 20000) == pytest.approx((curvature, variance), rel=1e-3)
    # With few residuals that are small, the variance is still the variance for normal residuals.
    assert _search.robust_factors(np.full(4, 0.1), loss, 3)[1] == pytest.approx(variance, rel=1e-3)


def test_outliers_widen_the_errors_of_a_robust_loss():
    """A share of 20 % has the derivatives 1 and the curvature 0."""
    residuals = np.concatenate([norm.ppf((np.arange(8000) + 0.5) / 8000), np.full(2000, 1e3)])
    curvature, variance = _search.robust_factors(residuals, "huber", 10000)
    assert curvature == pytest.approx(0.8 * 0.6827, rel=1e-3)
    assert variance == pytest.approx((0.8 * 0.5161 + 0.2) / (0.8 * 0.6827) ** 2, rel=1e-3)


@pytest.mark.parametrize(("loss", "variance"), [("cauchy", 1.3131), ("arctan", 2.0552)])
def test_intervals_of_a_robust_loss_have_the_width_of_its_errors(loss, variance):
    errors = {}
    for one in ("linear", loss):
        result = flapwing.fit(PRESET, readings(), ["hinge_stiffness"], sigma="3 %", loss=one, starts=1, **BESIDE)
        estimate = result.estimates["hinge_stiffness"]
        assert estimate.high - estimate.low == pytest.approx(2 * 1.96 * estimate.error, rel=0.2)
        errors[one] = estimate.error
    assert 0.95 * np.sqrt(variance) < errors[loss] / errors["linear"] < 1.4 * np.sqrt(variance)


@pytest.mark.parametrize("loss", ["huber", "arctan"])
def test_a_robust_loss_keeps_the_weight_of_priors(loss):
    """The readings and the prior have the same weight. Readings determine no other parameter than the first."""
    residuals = norm.ppf((np.arange(400) + 0.5) / 400)
    curvature, variance = _search.robust_factors(residuals, loss, 400)
    space = Space([Coordinate(name, None, name, "", False, -1.0, 1.0, 0.0, (0.0, 0.05)) for name in ("a", "b")])
    target = Target(np.zeros(400), np.ones(400), np.ones(400, np.bool_), loss)
    _, first, second = target.losses(np.array([*residuals**2, 9.0, 9.0]))
    assert list(first[-2:]) == [1.0, 1.0] and list(second[-2:]) == [0.0, 0.0]
    assert target.cost(np.array([*np.zeros(400), 3.0, 3.0])) == 9.0
    slopes, priors = np.tile([1.0, 0.0], (400, 1)), space.prior(np.zeros(2))[1]
    inverse, _ = _search.covariance_of(np.concatenate([np.sqrt(curvature) * slopes, priors]))
    errors = np.sqrt(np.diag(_search.m_covariance(inverse, inverse, priors, variance * curvature)))
    # The variance of the gradient, divided by the square of the curvature.
    expected = np.sqrt(variance * curvature**2 * 400 + 400) / (curvature * 400 + 400)
    assert errors == pytest.approx([expected, 0.05], rel=1e-6)


def test_a_parameter_with_a_prior_alone_has_the_error_of_the_prior():
    """The dielectric loss does not affect the stroke."""
    free = {"hinge_stiffness": None, "dielectric_loss": flapwing.FreeParameter(0.001, 0.1, prior=(0.02, 0.001))}
    result = flapwing.fit(PRESET, readings(), free, sigma="3 %", loss="arctan", starts=1, **BESIDE)
    one = result.estimates["dielectric_loss"]
    assert (one.value, one.error) == pytest.approx((0.02, 0.001), rel=1e-3)
    assert (one.low, one.high) == pytest.approx((0.02 - 0.00196, 0.02 + 0.00196), rel=5e-3) and one.is_known


def test_outliers_count_less_with_a_robust_loss():
    data = readings()
    data["stroke_pp_deg"] = data["stroke_pp_deg"].copy()
    data["stroke_pp_deg"][[3, 20]] *= 1.6
    off = {}
    for loss in ("linear", "cauchy"):
        result = flapwing.fit(PRESET, data, list(TRUE), sigma="3 %", loss=loss, starts=1, profile=False)
        off[loss] = sum(abs(np.log(result.values[name] / value)) for name, value in TRUTH.items())
    assert off["cauchy"] < 0.5 * off["linear"]
