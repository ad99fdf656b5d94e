"""The choice of a missing parameter by `flapwing.select` among all candidates: synthetic experiments.

Each trial is a response of the bimorph of Jafferis et al. at three voltages and ten frequencies, with noise of 3 % on
stroke and pitch. In each trial, another candidate of `flapwing.candidates` has a random value that differs from the
preset's value. With `--lift`, the readings also contain the lift, and the candidates also contain the terms of lift and
drag. Three parameters are unknown in all trials. A selection is correct if the first step frees the candidate of the
trial, or a candidate with an AICc that is higher or lower by less than 2.

    python benches/fit/terms.py --lift

The script requires SciPy: pip install scipy
"""

import argparse
import time

import flapwing
import numpy as np

PRESET = "jafferis2016"
# Ratios of the true parameters to the preset.
TRUE = {"hinge_stiffness": 1.15, "wing_inertia_stroke": 0.93, "drag_coefficient_max": 0.90}
TERMS = ["lift_term_1", "lift_term_2", "drag_term_0", "drag_term_1"]
NOISE = 0.03
#: Smallest and largest difference of a candidate's value from the preset's value, as a share of the distance from the
#: preset's value to the farther bound. A parameter with default bounds changes by a share of the preset's value.
CHANGE = (0.15, 0.5)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--seed", type=int, default=1, help="of the values and the noise")
    parser.add_argument("--lift", action="store_true", help="with readings of the lift, and the terms of lift and drag")
    arguments = parser.parse_args()
    measures = ["stroke_pp_deg", "pitch_amplitude_deg"] + ["lift_mean_mn"] * arguments.lift
    bounds = dict.fromkeys(TERMS, flapwing.FreeParameter(-1.0, 1.0)) if arguments.lift else {}
    candidates = flapwing.candidates(PRESET) | bounds
    preset = {name: float(flapwing.params(PRESET)[name].value) for name in [*candidates, *TRUE]}
    frequency, voltage = np.meshgrid(np.linspace(70.0, 150.0, 10), [100.0, 140.0, 180.0])
    points = {"drive_frequency": frequency.ravel(), "drive_voltage_pp": voltage.ravel()}
    counts = dict.fromkeys(("freed first", "within 2 of AICc", "freed alone", "not freed"), 0)
    work = []
    for trial, (name, one) in enumerate(candidates.items()):
        if name in TRUE:
            continue
        draw = np.random.default_rng([arguments.seed, trial])
        ends = (0.0, 2.0 * preset[name]) if one.low is None else (float(one.low), float(one.high or 0.0))
        reach = [abs(end - preset[name]) for end in ends]
        way = draw.choice([end for end, far in zip(ends, reach) if far > 0.9 * max(reach)])
        value = preset[name] + draw.uniform(*CHANGE) * (way - preset[name])
        truth = {**{given: ratio * preset[given] for given, ratio in TRUE.items()}, name: value}
        exact = flapwing.evaluate(PRESET, points, measures=measures, **truth)
        data = {**points, **{each: exact[each] * (1 + draw.normal(0.0, NOISE, len(exact))) for each in measures}}
        worked = time.process_time()
        found = flapwing.select(
            PRESET, data, candidates, start=list(TRUE), sigma=f"{100 * NOISE:g} %", starts=1, profile=False
        )
        work.append(time.process_time() - worked)
        first = found.steps[1:2]
        freed = [step.freed or f"{step.removed} removed" for step in found.steps[1:]]
        is_first = freed[:1] == [name]
        is_near = any(step.alternatives.get(name, np.inf) < 2.0 for step in first)
        counts["freed first"] += is_first
        counts["within 2 of AICc"] += is_near
        counts["not freed"] += not (is_first or is_near)
        counts["freed alone"] += freed == [name]
        others = ", ".join(f"{other} {more:+.1f}" for step in first for other, more in step.alternatives.items())
        print(f"{name:24} {value:<10.3g} freed: {', '.join(freed) or 'nothing'}; also fitted: {others}", flush=True)
    told = ", ".join(f"{how} {count}" for how, count in counts.items())
    print(f"the parameter of the trial, in {len(work)} trials with {len(candidates)} candidates: {told}")
    print(f"processor time of a selection: mean {np.mean(work):.1f} s, largest {max(work):.1f} s")


if __name__ == "__main__":
    main()
