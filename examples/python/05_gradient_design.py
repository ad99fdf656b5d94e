"""The largest lift per watt over eight parameters, under limits. An optimiser with exact derivatives is compared with
differential evolution.

The script maximises the lift per watt of the bimorph of Jafferis et al. over parameters of drive, transmission, hinge
and actuator. The strain of the plates, the stroke and the pitch have limits, and two wings must carry the vehicle.
SLSQP, an optimiser of SciPy, uses the derivatives of the measures. Differential evolution (pymoo) uses only the values
of the measures. For each optimiser, the script counts the computed designs, the evaluations of the right-hand side, and
the seconds of computing time.

    python 05_gradient_design.py
    python 05_gradient_design.py --starts 8 --generations 120

The script requires SciPy and pymoo: pip install scipy pymoo

D. Kraft, "A software package for sequential quadratic programming", DFVLR-FB 88-28 (1988).
R. Storn and K. Price, "Differential evolution", J. Global Optim. 11 (1997) 341-359.
"""

import argparse
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import flapwing
import numpy as np
from pymoo.algorithms.soo.nonconvex.de import DE
from pymoo.core.problem import Problem
from pymoo.optimize import minimize as evolve
from scipy.optimize import minimize

PRESET = "jafferis2016-improved"
# Lowest and highest values, as shares of the preset's.
VARIABLES = {
    "drive_voltage_pp": (0.6, 1.3),
    "drive_frequency": (0.7, 1.3),
    "transmission_ratio": (0.8, 1.3),
    "transmission_stiffness": (0.7, 1.3),
    "hinge_stiffness": (0.6, 1.6),
    "piezo_thickness": (0.8, 1.25),
    "shim_thickness": (0.7, 1.4),
    "actuator_width": (0.8, 1.25),
}
# Largest values, and the least lift.
LIMITS = {"strain_surface_max": 8e-4, "stroke_pp_deg": 110.0, "pitch_peak_deg": 80.0}
LIFT_MGF = 200.0
MEASURES = ["efficiency_gf_per_w", *LIMITS, "vehicle_lift_mgf"]

# Rows with the measures, and with what they cost.
DESIGN = {"preset": PRESET, "output": {"columns": [*MEASURES, "rhs_evals"]}}

VALUES = flapwing.Grid({"preset": PRESET})[0]
BASE = {name: float(VALUES[name]) for name in VARIABLES}
LOWEST, HIGHEST = np.array(list(VARIABLES.values())).T


@dataclass
class Count:
    """The number of computed designs and the number of evaluations of the right-hand side in a search."""

    designs: int = 0
    rhs: int = 0


def rows(shares: Any, count: Count, gradient: bool) -> Any:
    """Compute designs and return one row for each design. Each line of the array `shares` is one design: each value is
    a parameter divided by the parameter of the preset."""
    columns = {name: BASE[name] * shares[:, place] for place, name in enumerate(VARIABLES)}
    table = flapwing.evaluate(DESIGN, columns, gradient=list(VARIABLES) if gradient else None)
    count.designs += len(table)
    count.rhs += int(np.nansum(table["rhs_evals"]))
    return table


def excesses(table: Any) -> Any:
    """Return the relative excess of each design over each limit, with one column per limit. An allowed design has no
    excess above zero."""
    columns = [table[name] / limit - 1 for name, limit in LIMITS.items()]
    return np.column_stack([*columns, 1 - table["vehicle_lift_mgf"] / LIFT_MGF])


class NoDerivative(Exception):
    """Exception that ends a search at a design without a settled motion or without derivatives."""


class Search:
    """The functions for SLSQP: the objective, the limits, and their derivatives. Each design is computed only once."""

    def __init__(self) -> None:
        self.count = Count()
        self.at: Any = None
        self.known: Any = None

    def row(self, x: Any) -> Any:
        """Return two arrays for a design. The first array contains the negative lift per watt and the distances to the
        limits. The second array contains the derivatives of these values."""
        if self.at is None or not np.array_equal(self.at, x):
            table = rows(x[None, :], self.count, gradient=True)
            slopes = table.gradient[0] * np.array([BASE[name] for name in VARIABLES])
            values = np.concatenate([-table["efficiency_gf_per_w"], -excesses(table)[0]])
            signs = np.array([-1.0, *(-1 / limit for limit in LIMITS.values()), 1 / LIFT_MGF])
            if not (np.isfinite(values).all() and np.isfinite(slopes).all()):
                raise NoDerivative
            self.at, self.known = x.copy(), (values, slopes * signs[:, None])
        return self.known

    def best(self, start: Any) -> Any:
        """Return the best design that SLSQP finds if the search begins at the design `start`. Return None if the search
        reaches a design without derivatives."""
        room = {"type": "ineq", "fun": lambda x: self.row(x)[0][1:], "jac": lambda x: self.row(x)[1][1:]}
        try:
            return minimize(
                lambda x: (self.row(x)[0][0], self.row(x)[1][0]),
                start,
                jac=True,
                bounds=np.column_stack([LOWEST, HIGHEST]),
                constraints=[room],
                method="SLSQP",
                options={"maxiter": 60, "ftol": 1e-4},
            )
        except NoDerivative:
            return None


class Wing(Problem):  # type: ignore[misc, unused-ignore]
    """The optimisation problem for differential evolution, which computes one generation of designs at a time."""

    def __init__(self) -> None:
        super().__init__(n_var=len(VARIABLES), n_obj=1, n_ieq_constr=len(LIMITS) + 1, xl=LOWEST, xu=HIGHEST)
        self.count = Count()

    def _evaluate(self, x: Any, out: dict[str, Any], *_args: Any, **_kwargs: Any) -> None:
        table = rows(x, self.count, gradient=False)
        # Motions that do not settle are as bad as can be.
        out["F"] = np.nan_to_num(-table["efficiency_gf_per_w"], nan=0.0)
        out["G"] = np.nan_to_num(excesses(table), nan=10.0)


def keeps_the_limits(end: Any) -> bool:
    """Return True if the result of a search satisfies all limits to within 0.1 %."""
    return bool((excesses(rows(end.x[None, :], Count(), gradient=False)) < 1e-3).all())


def by_derivatives(starts: int) -> tuple[Any, Count]:
    """Return the best result of several SLSQP searches, and the count of designs and evaluations. The searches begin at
    the preset and at random designs."""
    search = Search()
    spread = np.random.default_rng(1).uniform(0.25, 0.75, (starts - 1, len(VARIABLES)))
    begins = [np.ones(len(VARIABLES)), *(LOWEST + (HIGHEST - LOWEST) * spread)]
    ends = [end for end in map(search.best, begins) if end is not None and keeps_the_limits(end)]
    if not ends:
        raise SystemExit("no start ends at a design that keeps the limits: give more --starts")
    return min(ends, key=lambda end: float(end.fun)).x, search.count


def by_evolution(generations: int) -> tuple[Any, Count]:
    """Return the best design that differential evolution finds, and the count of designs and evaluations."""
    wing = Wing()
    found = evolve(wing, DE(pop_size=64), ("n_gen", generations), seed=1)
    if found.X is None:
        raise SystemExit("no design keeps the limits: give more --generations")
    return found.X, wing.count


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--starts", type=int, default=4, help="starts of SLSQP: the preset, and random designs")
    parser.add_argument("--generations", type=int, default=80, help="generations of 64 designs")
    arguments = parser.parse_args()

    searches: dict[str, Callable[[], tuple[Any, Count]]] = {
        "SLSQP with derivatives": lambda: by_derivatives(arguments.starts),
        "differential evolution": lambda: by_evolution(arguments.generations),
    }
    for name, search in searches.items():
        clock = time.perf_counter()
        shares, count = search()
        seconds = time.perf_counter() - clock
        table = rows(shares[None, :], Count(), gradient=False)
        print(f"{name}: {count.designs} designs, {count.rhs / 1e6:.2f} million right-hand sides, {seconds:.1f} s")
        told = {name: f"at most {limit:g}" for name, limit in LIMITS.items()}
        told["vehicle_lift_mgf"] = f"at least {LIFT_MGF:g}"
        for measure in MEASURES:
            print(f"  {measure:24} {table[measure][0]:10.5g} {table.units[measure]:5} {told.get(measure, '')}".rstrip())
        for variable, share in zip(VARIABLES, shares):
            print(f"  {variable:24} {BASE[variable] * share:10.4g} {share:6.3f} of the preset")


if __name__ == "__main__":
    main()
