"""The next readings of a fit: readings that `Fit.next_measurements` chooses, compared with random readings.

Each trial is a synthetic experiment with eight readings at random frequencies and voltages. A fit of three parameters
chooses two operating points for the next readings. The new readings are added to the fit, and the choice is repeated
until the error of the drag coefficient is halved. A second series of fits uses random operating points. Errors are
computed from derivatives at the true parameters, which the choice does not use.

    python benches/fit/next.py --trials 100

The script requires SciPy: pip install scipy
"""

import argparse
from typing import Any

import flapwing
import numpy as np

PRESET = "jafferis2016"
TRUE = {"hinge_stiffness": 1.15, "wing_inertia_stroke": 0.93, "drag_coefficient_max": 0.90}
TARGET = "drag_coefficient_max"
MEASURE = "stroke_pp_deg"
NOISE, FIRST, EACH, MOST = 0.03, 8, 2, 40

Array = np.ndarray[Any, np.dtype[np.float64]]
Rows = np.ndarray[Any, np.dtype[np.intp]]


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--trials", type=int, default=10)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()

    truth: dict[str, Any] = {name: ratio * float(flapwing.params(PRESET)[name].value) for name, ratio in TRUE.items()}
    frequency, voltage = np.meshgrid(np.linspace(70.0, 150.0, 33), [100.0, 120.0, 140.0, 160.0])
    candidates = {"drive_frequency": frequency.ravel(), "drive_voltage_pp": voltage.ravel()}
    table = flapwing.evaluate(PRESET, candidates, measures=[MEASURE], gradient=list(TRUE), **truth)
    exact = table[MEASURE]
    # Derivatives by the logarithms of the parameters, in standard errors of a reading.
    slopes = table.gradient[:, 0] * list(truth.values()) / (NOISE * exact)[:, np.newaxis]
    place = list(TRUE).index(TARGET)

    def error(rows: Rows) -> float:
        return float(np.sqrt(np.linalg.inv(slopes[rows].T @ slopes[rows])[place, place]))

    number = {point: row for row, point in enumerate(zip(*(values.tolist() for values in candidates.values())))}

    def plan(rows: Rows, readings: Array) -> Rows:
        """Return the operating points of the next readings."""
        data = {name: values[rows] for name, values in candidates.items()}
        found = flapwing.fit(PRESET, {**data, MEASURE: readings}, list(TRUE), sigma="3 %", starts=1, profile=False)
        points = found.next_measurements(candidates, TARGET, count=EACH, repeats=True).points
        return np.array([number[tuple(float(point[name]) for name in candidates)] for point in points])

    wins = 0
    planned, random = [], []
    for trial in range(arguments.trials):
        draw = np.random.default_rng(arguments.seed + trial)
        first = draw.choice(len(exact), FIRST, replace=False)
        goal = 0.5 * error(first)
        noise = 1 + draw.normal(0.0, NOISE, FIRST + MOST)
        order = draw.integers(0, len(exact), MOST)
        random.append(next((n for n in range(1, MOST) if error(np.concatenate([first, order[:n]])) <= goal), MOST))
        rows = first
        while error(rows) > goal and len(rows) < FIRST + MOST:
            rows = np.concatenate([rows, plan(rows, exact[rows] * noise[: len(rows)])])
        # The last of two may not have been needed.
        spare = error(rows[:-1]) <= goal
        planned.append(len(rows) - FIRST - spare)
        wins += planned[-1] < random[-1]
    print(f"planned readings halve the error of {TARGET} in fewer readings in {wins} of {arguments.trials} trials")
    print(f"readings needed (median): planned {np.median(planned):.0f}, at random {np.median(random):.0f}")


if __name__ == "__main__":
    main()
