"""The choice of a law by `flapwing.compare`, and of a missing term by `flapwing.select`, in synthetic experiments.

Each trial is a response of the bimorph of Jafferis et al. at three voltages and ten frequencies, with noise of 3 % on
stroke and pitch: 60 readings. The true law is the paper's law, or the paper's law with one further term or with a
different drag law. The trials use the laws in turn. Three parameters are unknown in all trials.

`compare` chooses among five fits, one for each law. `select` begins with the three parameters, and uses the candidates
of `flapwing.candidates`. A selection is correct if the parameter of the true law is freed first. A selection is exact
if no further parameter is freed.

    python benches/fit/laws.py --trials 20

The script requires SciPy: pip install scipy
"""

import argparse
import time
from collections import Counter
from typing import Any

import flapwing
import numpy as np

PRESET = "jafferis2016"
# Ratios of the true parameters to the preset.
TRUE = {"hinge_stiffness": 1.15, "wing_inertia_stroke": 0.93, "drag_coefficient_max": 0.90}
# The parameter of each law, with its true value and its bounds.
LAWS: dict[str, dict[str, tuple[float, float, float]]] = {
    "paper": {},
    "hinge damping": {"hinge_damping": (0.3e-9, 0.0, 1e-9)},
    "stroke loss factor": {"stroke_loss_factor": (0.2, 0.0, 0.5)},
    "transmission growth": {"transmission_growth": (1e10, -1e10, 2e10)},
    "drag law": {"drag_coefficient_min": (1.0, 0.05, 3.0)},
}
NOISE = 0.03
MEASURES = ["stroke_pp_deg", "pitch_amplitude_deg"]


def experiment(law: str, seed: int) -> dict[str, Any]:
    """Return readings with noise."""
    frequency, voltage = np.meshgrid(np.linspace(70.0, 150.0, 10), [100.0, 140.0, 180.0])
    points = {"drive_frequency": frequency.ravel(), "drive_voltage_pp": voltage.ravel()}
    truth: dict[str, Any] = {name: ratio * float(flapwing.params(PRESET)[name].value) for name, ratio in TRUE.items()}
    truth |= {name: value for name, (value, _, _) in LAWS[law].items()}
    exact = flapwing.evaluate(PRESET, points, measures=MEASURES, **truth)
    draw = np.random.default_rng(seed)
    return {**points, **{name: exact[name] * (1 + draw.normal(0.0, NOISE, len(exact))) for name in MEASURES}}


def free(law: str) -> dict[str, tuple[float, float] | None]:
    """Return the free parameters of a fit with a law."""
    return {**dict.fromkeys(TRUE), **{name: (low, high) for name, (_, low, high) in LAWS[law].items()}}


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--trials", type=int, default=10)
    parser.add_argument("--seed", type=int, default=1, help="of the first trial's noise")
    parser.add_argument("--estimate", action="store_true", help="estimate the standard errors from the residuals")
    arguments = parser.parse_args()
    sigma = None if arguments.estimate else f"{100 * NOISE:g} %"
    outcomes: Counter[tuple[str, str]] = Counter()
    undecided = right = exact = 0
    work = dict.fromkeys(("compare", "select"), 0.0)
    rhs_evals = 0
    for trial in range(arguments.trials):
        true = list(LAWS)[trial % len(LAWS)]
        data = experiment(true, arguments.seed + trial)
        worked = time.process_time()
        fits = [flapwing.fit(PRESET, data, free(law), sigma=sigma, starts=1, profile=False) for law in LAWS]
        compared = flapwing.compare(fits, names=list(LAWS))
        work["compare"] += time.process_time() - worked
        outcomes[true, compared.chosen] += 1
        undecided += not compared.is_decided
        worked = time.process_time()
        candidates = flapwing.candidates(PRESET)
        found = flapwing.select(PRESET, data, candidates, start=list(TRUE), sigma=sigma, starts=1, profile=False)
        work["select"] += time.process_time() - worked
        rhs_evals += found.rhs_evals
        wanted, freed = list(LAWS[true]), [step.freed for step in found.steps[1:]]
        right += freed[:1] == wanted
        exact += freed == wanted
        print(f"{true:20} compare: {compared.chosen:20} select: {', '.join(freed) or 'nothing'}", flush=True)
    count = arguments.trials
    chosen = sum(number for (true, law), number in outcomes.items() if true == law)
    print(f"compare chooses the true law in {chosen} of {count} trials; {undecided} have a second fit within 2 of AICc")
    for (true, law), number in sorted(outcomes.items()):
        if true != law:
            print(f"  {true}: {law} chosen in {number}")
    print(f"select frees the parameter of the true law first in {right} of {count} trials, and nothing else in {exact}")
    print(
        f"processor time of a trial: five fits {work['compare'] / count:.1f} s, select {work['select'] / count:.1f} s"
    )
    print(
        f"right-hand sides of a selection from {len(flapwing.candidates(PRESET))} candidates: {rhs_evals / count:.2g}"
    )


if __name__ == "__main__":
    main()
