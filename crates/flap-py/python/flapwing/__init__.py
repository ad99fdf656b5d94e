"""Simulation of insect-scale piezoelectric flapping-wing actuators.

`presets` lists published designs and `params` their parameters. `run` simulates one design, `trajectory` returns its
motion and `resonance` its resonances. `sweep` runs a whole grid and `evaluate` a batch of points. `respond` follows
designs up and down in frequency. `chirp` and `impulse` drive a design in other ways; `track_wing` and `forces_along`
are for wings that were filmed. `fit` fits parameters to readings. `live` shows a page with curves that follow the
parameters.

Results of many points are a `Table`, whose columns are NumPy arrays; it converts to pandas, polars, Arrow and xarray.
Results of one point are a `Row`. Unknown numbers are nan.

A design is the name of a preset, a grid file, its text, a dictionary, a `Grid`, or a `Vehicle` of several wings.
Parameters and solver settings are keywords of every call; a number without a unit is in SI units.

`flapwing.analysis` has sensitivities and fronts, `flapwing.fitting` the results of fits, and `flapwing.plot` pictures,
which need matplotlib.
"""

from ._evaluate import evaluate
from ._experiments import chirp, forces_along, impulse, track_wing
from ._flapwing import Diagnostic, Exclusions, Grid, GridError, __version__, presets
from ._listing import measures, params, states
from ._live import Live, live
from ._point import resonance, run, trajectory
from ._respond import respond
from ._results import (
    BistableBand,
    DampedSine,
    DrivenPeak,
    FrequencyGap,
    Measure,
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
    "BistableBand",
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
    "Measure",
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
