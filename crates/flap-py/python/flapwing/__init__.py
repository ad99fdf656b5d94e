"""Simulation of insect-scale piezoelectric flapping-wing actuators.

`presets` lists published designs, and `params` lists their parameters.
`run` simulates one design, `trajectory` returns its motion, and `resonance` returns its resonances.
`sweep` runs a whole grid, and `evaluate` runs a batch of points.
`respond` follows designs up and down along the drive frequency or another parameter.
`chirp` simulates a drive with a changing frequency, and `impulse` a free motion.
`track_wing` and `forces_along` process the motion of a filmed wing.
`fit` fits parameters to readings.
`optimise` finds the best design within the axes of a grid.
`live` opens a page with sliders for the parameters and curves that follow them.

Results of many points are a `Table`, whose columns are NumPy arrays. It converts to pandas, polars, Arrow and xarray.
Results of one point are a `Row`. Unknown numbers are nan.

A design is the name of a preset, a grid file, the text of a grid file, a dictionary, a `Grid`, or a `Vehicle`.
Every call takes parameters and solver settings as keywords. A number without a unit is in SI units.

`flapwing.analysis` computes sensitivities and Pareto fronts, `flapwing.fitting` has the results of fits, and
`flapwing.plot` draws pictures, for which it requires matplotlib.
"""

from ._evaluate import evaluate
from ._experiments import chirp, forces_along, impulse, track_wing
from ._flapwing import Diagnostic, Exclusions, Grid, GridError, __version__, presets
from ._listing import measures, params, states
from ._live import Live, live
from ._optimise import optimise
from ._point import resonance, run, trajectory
from ._respond import respond
from ._results import (
    ActiveBound,
    BistableBand,
    ConditionValue,
    DampedSine,
    DrivenPeak,
    FrequencyGap,
    LocalOptimum,
    Measure,
    Optimum,
    Parameter,
    Resonances,
    Row,
    State,
    Verdict,
)
from ._sweep import read, sweep
from ._table import Table
from ._vehicle import Vehicle, Wing
from .fitting import Fit, FreeParameter, Readings, fit

__all__ = [
    "ActiveBound",
    "BistableBand",
    "ConditionValue",
    "DampedSine",
    "Diagnostic",
    "DrivenPeak",
    "Exclusions",
    "Fit",
    "FreeParameter",
    "FrequencyGap",
    "Grid",
    "GridError",
    "Live",
    "LocalOptimum",
    "Measure",
    "Optimum",
    "Parameter",
    "Readings",
    "Resonances",
    "Row",
    "State",
    "Table",
    "Vehicle",
    "Verdict",
    "Wing",
    "__version__",
    "chirp",
    "evaluate",
    "fit",
    "forces_along",
    "impulse",
    "live",
    "measures",
    "optimise",
    "params",
    "presets",
    "read",
    "resonance",
    "respond",
    "run",
    "states",
    "sweep",
    "track_wing",
    "trajectory",
]
