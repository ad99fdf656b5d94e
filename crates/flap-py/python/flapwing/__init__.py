"""Simulation of insect-scale piezoelectric flapping-wing actuators.

`presets` lists published designs and `params` their parameters. `run` simulates one design, `trajectory` returns its
motion and `resonance` its resonances. `sweep` runs a whole grid and `evaluate` a batch of points. `respond` follows
designs up and down in frequency. `chirp` and `impulse` drive a design in other ways; `track` and `lift` are about wings
that were filmed. `fit` fits parameters to readings. `live` shows a page with curves that follow the parameters. Results are a `Table`, whose columns are NumPy arrays; it converts to pandas, polars, Arrow and xarray.

A design is the name of a preset, a grid file, its text, a dictionary, a `Grid`, or a `Vehicle` of several wings. Parameters and solver settings are
keywords of every call.

Pictures are in `flapwing.plot`, which needs matplotlib.
"""

from ._evaluate import evaluate
from ._experiments import chirp, impulse, lift, track
from ._fit import Fit, Free, Readings, fit
from ._flapwing import Diagnostic, Grid, GridError, __version__, presets
from ._listing import Parameter, measures, params, states
from ._live import Live, live
from ._point import resonance, run, trajectory
from ._respond import respond
from ._sweep import read, sweep
from ._table import Table
from ._vehicle import Vehicle, Wing

__all__ = [
    "Diagnostic",
    "Fit",
    "Free",
    "Grid",
    "GridError",
    "Live",
    "Parameter",
    "Readings",
    "Table",
    "Vehicle",
    "Wing",
    "__version__",
    "chirp",
    "evaluate",
    "fit",
    "impulse",
    "lift",
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
    "track",
    "trajectory",
]
