"""The trade-off of lift and power, with a limit on the strain of the actuator.

The algorithm NSGA-II computes the Pareto front of lift and power for the bimorph of Jafferis et al. No computed design
has more lift and less power than a design of the front. Voltage and frequency of the drive, the transmission and the
hinge vary. The strain of the piezoelectric plates, the stroke and the pitch have limits, and two wings must carry the
vehicle. One call of `flapwing.evaluate` runs all designs of a generation.

    python 06_pareto_pymoo.py
    python 06_pareto_pymoo.py --size full --strain 0.0006 --out front.csv --picture front.png

The script requires pymoo, and `--picture` requires matplotlib: pip install pymoo matplotlib

K. Deb et al., "A fast and elitist multiobjective genetic algorithm: NSGA-II", IEEE Trans. Evol. Comput. 6 (2002)
182-197.
J. Blank and K. Deb, "pymoo: multi-objective optimization in Python", IEEE Access 8 (2020) 89497-89509.
"""

import argparse
from typing import Any

import flapwing
import numpy as np
from pymoo.algorithms.moo.nsga2 import NSGA2
from pymoo.core.problem import Problem
from pymoo.operators.sampling.lhs import LHS
from pymoo.optimize import minimize

# A transmission with another ratio has another stiffness too: section III-A of Jafferis et al.
DESIGN = {
    "preset": "jafferis2016",
    "derived": {
        "transmission_stiffness": "preset.transmission_stiffness"
        " * (transmission_ratio / preset.transmission_ratio)^-0.14",
    },
}
# Lowest and highest values, in SI units.
VARIABLES = {
    "drive_voltage_pp": (100.0, 300.0),
    "drive_frequency": (80.0, 180.0),
    "transmission_ratio": (2000.0, 3600.0),
    "hinge_stiffness": (0.7e-6, 4.0e-6),
}
# The plates' largest strain in the vehicle of the paper's Table II is 0.079 %.
STRAIN = 0.0008
STROKE_DEG = 120.0
PITCH_DEG = 90.0
VEHICLE_MG = 80.0
# Designs in a generation, and generations. The small front has about the quality of 16,000 random points; other seeds
# reach other ends, which the full one fills in.
SIZES = {"small": (100, 30), "full": (200, 200)}


class Wing(Problem):  # type: ignore[misc, unused-ignore]
    """An optimisation problem with two objectives: minimise the negative lift and the power. A design is allowed if no
    constraint is above 0."""

    def __init__(self, strain: float) -> None:
        lowest, highest = np.array(list(VARIABLES.values())).T
        super().__init__(n_var=len(VARIABLES), n_obj=2, n_ieq_constr=5, xl=lowest, xu=highest)
        self.strain = strain

    def _evaluate(self, x: Any, out: dict[str, Any], *_args: Any, **_kwargs: Any) -> None:
        table = flapwing.evaluate(DESIGN, dict(zip(VARIABLES, x.T)))
        periodic = table["status"] == "periodic"
        # Excesses over the limits, relative to them.
        excesses = [
            table["strain_surface_max"] / self.strain - 1,
            table["stroke_pp_deg"] / STROKE_DEG - 1,
            table["pitch_peak_deg"] / PITCH_DEG - 1,
            1 - table["vehicle_lift_mgf"] / VEHICLE_MG,
        ]
        # A motion that is not periodic has no mean lift. It breaks every limit, so it never gets into the front,
        # whatever stands for its objectives.
        failed = np.where(periodic, -1.0, 1.0)
        out["G"] = np.column_stack([np.where(periodic, excess, 1.0) for excess in excesses] + [failed])
        objectives = np.column_stack([-table["lift_mean_mn"], table["power_supply_mw"]])
        out["F"] = np.where(periodic[:, np.newaxis], objectives, 1e3)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--size", choices=list(SIZES), default="small")
    parser.add_argument("--strain", type=float, default=STRAIN, help="limit on strain_surface_max")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", metavar="FILE", help="write the front as CSV")
    parser.add_argument("--picture", metavar="FILE", help="draw the front")
    arguments = parser.parse_args()

    population, generations = SIZES[arguments.size]
    search = NSGA2(pop_size=population, sampling=LHS())
    found = minimize(Wing(arguments.strain), search, ("n_gen", generations), seed=arguments.seed)
    if found.X is None:
        raise SystemExit("No design keeps to the limits: raise --strain.")

    # The front once more with all its columns: the same points give the same bits.
    by_power = np.argsort(found.F[:, 1])
    front = flapwing.evaluate(DESIGN, dict(zip(VARIABLES, found.X[by_power].T)))
    assert front.counts == {"periodic": len(front)}

    print(f"{len(front)} designs on the front after {population * generations} points")
    print(
        f"limits: strain {arguments.strain:g}, stroke {STROKE_DEG:g} deg, pitch {PITCH_DEG:g} deg; "
        f"lift of both wings {VEHICLE_MG:g} mgf or more"
    )
    shown = ["lift_mean_mn", "power_supply_mw", "strain_surface_max", "stroke_pp_deg", "pitch_peak_deg", *VARIABLES]
    print(" ".join(f"{name:>18}" for name in shown))
    print(" ".join(f"{'(' + front.units[name] + ')' if front.units[name] else '':>18}" for name in shown))
    for row in range(0, len(front), max(1, len(front) // 12)):
        print(" ".join(f"{front[name][row]:18.5g}" for name in shown))

    if arguments.out:
        front.to_pandas()[shown].to_csv(arguments.out, index=False)
        print(f"wrote {arguments.out}")
    if arguments.picture:
        draw(front, arguments.picture)
        print(f"drew {arguments.picture}")


def draw(front: flapwing.Table, path: str) -> None:
    try:
        from matplotlib.figure import Figure
    except ImportError:
        raise SystemExit("--picture needs matplotlib: pip install matplotlib") from None

    figure = Figure(figsize=(6, 4), layout="constrained")
    axes = figure.subplots()
    points = axes.scatter(front["power_supply_mw"], front["lift_mean_mn"], c=100 * front["strain_surface_max"], s=16)
    axes.set_xlabel("power without recovery (mW)")
    axes.set_ylabel("mean lift of one wing (mN)")
    figure.colorbar(points, label="largest strain of the plates (%)")
    figure.savefig(path, dpi=150)


if __name__ == "__main__":
    main()
