"""Sobol' indices of lift and power, for parameters that are known to within 10 %.

A Sobol' index is the share of the variance of a result that one parameter causes. The first-order index S1 is the
effect of the parameter alone. The total index ST also includes all interactions of the parameter with other parameters.
If the first-order indices of all parameters add up to less than 1, interactions cause the missing part of the variance.
If the total index ST of a parameter is near 0, the parameter can have a fixed value.

One call of `flapwing.evaluate` computes all points of the sample.

    python 04_sobol_indices.py
    python 04_sobol_indices.py --size full
    python 04_sobol_indices.py --preset jafferis2016 --spread 25

The script requires SALib: pip install SALib

I. M. Sobol', "Global sensitivity indices for nonlinear mathematical models and their Monte Carlo estimates", Math.
Comput. Simul. 55 (2001) 271-280.
A. Saltelli et al., "Variance based sensitivity analysis of model output. Design and estimator for the total
sensitivity index", Comput. Phys. Commun. 181 (2010) 259-270.
T. Iwanaga, W. Usher and J. Herman, "Toward SALib 2.0", Socio-Environmental Systems Modelling 4 (2022) 18155.
"""

import argparse
from typing import Any

import flapwing
import numpy as np
from SALib.analyze import sobol as sobol_analyze
from SALib.sample import sobol as sobol_sample

# The uncertain parameters of each design: they are hard to measure or to make.
UNCERTAIN = {
    "ozaki2018-large": [
        "hinge_stiffness",
        "shim_thickness",
        "piezo_modulus",
        "piezo_coefficient",
        "leading_edge_inertia",
        "drag_coefficient_max",
    ],
    "jafferis2016": [
        "hinge_stiffness",
        "transmission_ratio",
        "wing_inertia_stroke",
        "piezo_thickness",
        "drag_coefficient_max",
        "lift_coefficient_max",
    ],
}
RESULTS = ["lift_mean_mn", "power_mean_mw"]
# Points of Saltelli's design that are moved in one parameter at a time: a power of 2.
BASES = {"small": 1024, "full": 8192}


def uncertain_parameters(preset: str, spread: float) -> dict[str, Any]:
    """Return the description of the parameters for SALib. Each parameter is distributed uniformly around the value in
    the preset."""
    names = UNCERTAIN[preset]
    values = [float(flapwing.params(preset)[name].value) for name in names]
    bounds = [[value * (1 - spread), value * (1 + spread)] for value in values]
    return {"num_vars": len(names), "names": names, "bounds": bounds}


def rows_of_whole_blocks(periodic: np.ndarray, parameters: int) -> np.ndarray:
    """Return an array that is True for each row whose block contains only periodic rows.

    Saltelli's sample consists of blocks of rows. A block contains two points, and copies of the first point in which
    one parameter is taken from the second point. The formulas for the Sobol' indices compare the rows of a block with
    each other. If one row of a block is not periodic, the row has no lift or power, and the whole block is left out.
    """
    blocks = periodic.reshape(-1, parameters + 2)
    whole = blocks.all(axis=1)
    return np.repeat(whole, parameters + 2)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--size", choices=list(BASES), default="small")
    parser.add_argument("--preset", choices=list(UNCERTAIN), default="ozaki2018-large")
    parser.add_argument("--spread", type=float, default=10.0, help="uncertainty of each parameter, in %% either way")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()

    problem = uncertain_parameters(arguments.preset, arguments.spread / 100)
    parameters = problem["num_vars"]
    sample = sobol_sample.sample(problem, BASES[arguments.size], calc_second_order=False, seed=arguments.seed)
    table = flapwing.evaluate(arguments.preset, dict(zip(problem["names"], sample.T)))

    used = rows_of_whole_blocks(table["status"] == "periodic", parameters)
    blocks, whole = len(used) // (parameters + 2), int(used.sum()) // (parameters + 2)
    statuses = ", ".join(f"{count} {status}" for status, count in table.counts.items())
    print(f"{arguments.preset}, {parameters} parameters within {arguments.spread:g} %: {len(table)} points, {statuses}")
    print(f"{whole} of {blocks} blocks of the design are used.")
    if whole < blocks:
        print(
            f"{blocks - whole} blocks hold a motion that is not periodic, which has no mean lift or power. They are\n"
            "left out: the indices are those of the periodic motions, and the sample is no longer a Sobol' sequence."
        )
    if whole < 0.9 * blocks:
        raise SystemExit("That is more than a tenth: indices would say little. Take a smaller --spread.")

    for name in RESULTS:
        values = table[name][used]
        indices = sobol_analyze.analyze(problem, values, calc_second_order=False, seed=arguments.seed)
        deviation = np.std(values, ddof=1)
        print(f"\n{name}: mean {np.mean(values):.4g} {table.units[name]}, standard deviation {deviation:.3g}")
        print(f"{'parameter':24} {'S1':>7} {'± 95 %':>8} {'ST':>7} {'± 95 %':>8}")
        for place in np.argsort(-indices["ST"]):
            first, total = indices["S1"][place], indices["ST"][place]
            first_error, total_error = indices["S1_conf"][place], indices["ST_conf"][place]
            print(f"{problem['names'][place]:24} {first:7.3f} {first_error:8.3f} {total:7.3f} {total_error:8.3f}")
        together = indices["S1"].sum()
        print(f"{'sum of S1':24} {together:7.3f}          the other {1 - together:.0%} come from interactions")


if __name__ == "__main__":
    main()
