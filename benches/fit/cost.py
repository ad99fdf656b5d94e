"""The work of a fit with exact derivatives, compared with a fit with finite differences.

The fits determine four parameters of the bimorph of Jafferis et al. from 100 readings and eight starts. All fits use
`scipy.optimize.least_squares` with the same settings. A last search from the best end has a tighter tolerance. Exact
derivatives come from `flapwing.evaluate`, together with the rows. Finite differences require rows at a tolerance of
1e-8 for steps of 0.001, and one or two additional rows for each parameter. Forward differences reuse the row of the
previous step.

    python benches/fit/cost.py

The script requires SciPy: pip install scipy
"""

import argparse
import time
from typing import Any

import flapwing
import numpy as np
from scipy.optimize import least_squares

PRESET = "jafferis2016"
TRUE = {
    "hinge_stiffness": 1.15,
    "wing_inertia_stroke": 0.93,
    "drag_coefficient_max": 0.90,
    "transmission_stiffness": 1.05,
}
MEASURES = ["stroke_pp_deg", "pitch_amplitude_deg"]
NOISE = 0.02
STEP, RTOL = 1e-3, 1e-8

Array = np.ndarray[Any, np.dtype[np.float64]]


class Response:
    """The readings as a function of the logarithms of (parameter / value in the preset)."""

    def __init__(self, points: dict[str, Array]) -> None:
        self.points = points
        self.nominal = np.array([float(flapwing.params(PRESET)[name].value) for name in TRUE])
        self.measured, self.sigma = np.zeros(0), np.ones(1)
        self.rhs_evals = 0
        #: The latest arguments of `residuals`, and the computed values.
        self.last = np.zeros(0), np.zeros(0)
        self.seen: dict[tuple[bytes, float], tuple[Array, Array]] = {}

    def rows(self, logs: list[Array], rtol: float, gradient: bool) -> flapwing.Table:
        columns: dict[str, Any] = {name: np.tile(values, len(logs)) for name, values in self.points.items()}
        count = len(self.points["drive_frequency"])
        for place, name in enumerate(TRUE):
            columns[name] = np.repeat([np.exp(x[place]) * self.nominal[place] for x in logs], count)
        by = list(TRUE) if gradient else None
        table = flapwing.evaluate(PRESET, columns, measures=MEASURES, gradient=by, rtol=rtol)
        self.rhs_evals += table.meta["rhs_evals"]
        return table

    def values(self, logs: list[Array], rtol: float) -> Array:
        table = self.rows(logs, rtol, False)
        return np.concatenate([table[name].reshape(len(logs), -1) for name in MEASURES], axis=1)

    def residuals(self, x: Array) -> Array:
        self.last = x.copy(), np.nan_to_num(self.values([x], RTOL)[0])
        return np.asarray((self.last[1] - self.measured) / self.sigma)

    def residuals_and_slopes(self, x: Array, rtol: float) -> tuple[Array, Array]:
        """Return residuals and derivatives from one call of `flapwing.evaluate`, as in `flapwing.fit`."""
        key = (x.tobytes(), rtol)
        if key not in self.seen:
            table = self.rows([x], rtol, True)
            values = np.concatenate([table[name] for name in MEASURES])
            slopes = np.concatenate([table.gradient[:, place] for place in range(len(MEASURES))])
            slopes = np.nan_to_num(slopes) * np.exp(x) * self.nominal / self.sigma[:, np.newaxis]
            self.seen = {key: ((np.nan_to_num(values) - self.measured) / self.sigma, slopes)}
        return self.seen[key]

    def central(self, x: Array) -> Array:
        steps = STEP * np.eye(len(x))
        above, below = np.split(np.nan_to_num(self.values([*(x + steps), *(x - steps)], RTOL)), 2)
        return np.asarray((above - below).T / (2 * STEP) / self.sigma[:, np.newaxis])

    def forward(self, x: Array) -> Array:
        if not np.array_equal(x, self.last[0]):
            self.residuals(x)
        beside = np.nan_to_num(self.values(list(x + STEP * np.eye(len(x))), RTOL))
        return np.asarray((beside - self.last[1]).T / STEP / self.sigma[:, np.newaxis])


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--starts", type=int, default=8)
    arguments = parser.parse_args()
    frequency, voltage = np.tile(np.linspace(70, 150, 25), 2), np.repeat([120.0, 160.0], 25)
    response = Response({"drive_frequency": frequency, "drive_voltage_pp": voltage})
    exact = response.values([np.log(list(TRUE.values()))], 1e-8)[0]
    response.sigma = NOISE * np.abs(exact)
    response.measured = exact + response.sigma * np.random.default_rng(1).normal(size=len(exact))

    begun, worked = time.perf_counter(), time.process_time()
    data = dict(zip(MEASURES, np.split(response.measured, 2)))
    found = flapwing.fit(PRESET, {**response.points, **data}, list(TRUE), sigma="2 %", starts=arguments.starts)
    seconds, work = time.perf_counter() - begun, time.process_time() - worked
    print(found)
    effort = f"{found.effort.rhs_evals:.3g} right-hand sides, {seconds:.1f} s, {work:.1f} s of processor time"
    print(f"\nflapwing.fit with profiles and all: {effort}\n")

    draw = np.random.default_rng(2)
    begins = [np.zeros(4), *draw.uniform(np.log(0.5), np.log(2), (arguments.starts - 1, 4))]
    print(f"{'least_squares with':36} {'right-hand sides':>17} {'CPU s':>8} {'steps':>6} {'best cost':>10}")
    options = {"bounds": (np.log(1 / 3), np.log(3)), "x_scale": "jac", "xtol": 1e-6, "max_nfev": 40}

    def search(begin: Array, rtol: float, ftol: float) -> Any:
        residuals = lambda x: response.residuals_and_slopes(x, rtol)[0]  # noqa: E731
        slopes = lambda x: response.residuals_and_slopes(x, rtol)[1]  # noqa: E731
        return least_squares(residuals, begin, slopes, ftol=ftol, **options)

    def exact_ends() -> list[Any]:
        ends = [search(begin, 1e-5, 1e-3) for begin in begins]
        return [*ends, search(min(ends, key=lambda end: end.cost).x, 1e-6, 1e-8)]

    def ends_by(slopes: Any) -> list[Any]:
        ends = [least_squares(response.residuals, begin, slopes, ftol=1e-3, **options) for begin in begins]
        best = min(ends, key=lambda end: end.cost)
        return [*ends, least_squares(response.residuals, best.x, slopes, ftol=1e-8, **options)]

    for name, ends_of in [
        ("exact derivatives", exact_ends),
        ("central differences, rtol 1e-8", lambda: ends_by(response.central)),
        ("forward differences, rtol 1e-8", lambda: ends_by(response.forward)),
    ]:
        response.rhs_evals = 0
        worked = time.process_time()
        ends = ends_of()
        work = time.process_time() - worked
        steps, cost = sum(end.nfev for end in ends), ends[-1].cost
        print(f"{name:36} {response.rhs_evals:17.3g} {work:8.1f} {steps:6} {cost:10.4f}")


if __name__ == "__main__":
    main()
