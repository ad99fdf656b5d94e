"""Simulation of insect-scale piezoelectric flapping-wing actuators.

`presets` lists published designs, and `params` lists the parameters of a design. `run` simulates one design,
`trajectory` returns the motion of a design, and `resonance` returns the resonances. `sweep` computes all points of a
grid, and `evaluate` computes points that you give as arrays. `respond` raises and lowers the drive frequency or another
parameter in steps, and follows the motion of a design. `chirp` simulates a drive with a changing frequency, and
`impulse` simulates a free motion. `track_wing` computes the stroke and pitch of a filmed wing, and `forces_along`
computes the forces of a given motion. `fit` fits parameters to readings, `compare` compares fits, and `select` chooses
the parameters to fit. `fit_coefficients` fits the laws of lift, drag and centre of pressure to a table. `optimise`
finds the best design within the axes of a grid. `wrench_map` fits a quadratic map of the forces and torques of a
vehicle, and `fly` simulates the flight of a vehicle. `live` opens a page in the browser, with sliders for the
parameters and curves that change with the sliders.

Functions for many points return a `Table`, whose columns are NumPy arrays. You can convert a `Table` to pandas, polars,
Arrow and xarray. Functions for one point return a `Row`. Unknown numbers in results are nan.

A design is the name of a preset, a grid file, the text of a grid file, a dictionary, a `Grid`, or a `Vehicle`.
Functions that simulate accept parameters of the design and solver settings as keyword arguments. A number without a
unit is in SI units.

`flapwing.analysis` computes sensitivities and Pareto fronts, and `flapwing.fitting` contains the classes for fits.
`flapwing.plot` draws pictures and requires matplotlib.
"""

from ._coefficients import CoefficientFit, fit_coefficients
from ._evaluate import evaluate
from ._experiments import chirp, forces_along, impulse, track_wing
from ._flapwing import Diagnostic, Exclusions, Grid, GridError, __version__, presets
from ._flight import fly
from ._linear import LinearModel
from ._listing import measures, params, states
from ._live import Live, live
from ._optimise import optimise
from ._point import resonance, run, trajectory
from ._respond import edges, respond
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
from ._stability import hover_eigenvalues
from ._sweep import read, sweep
from ._table import Table
from ._vehicle import Vehicle, Wing
from ._wrench_map import WrenchMap, wrench_map
from .fitting import Comparison, Fit, FreeParameter, Readings, Selection, candidates, compare, fit, select

__all__ = [
    "ActiveBound",
    "BistableBand",
    "CoefficientFit",
    "Comparison",
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
    "LinearModel",
    "Live",
    "LocalOptimum",
    "Measure",
    "Optimum",
    "Parameter",
    "Readings",
    "Resonances",
    "Row",
    "Selection",
    "State",
    "Table",
    "Vehicle",
    "Verdict",
    "Wing",
    "WrenchMap",
    "__version__",
    "candidates",
    "chirp",
    "compare",
    "edges",
    "evaluate",
    "fit",
    "fit_coefficients",
    "fly",
    "forces_along",
    "hover_eigenvalues",
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
    "select",
    "states",
    "sweep",
    "track_wing",
    "trajectory",
    "wrench_map",
]
