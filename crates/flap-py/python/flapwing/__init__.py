"""Simulation of insect-scale piezoelectric flapping-wing actuators.

`presets` lists published designs and `params` their parameters. `run` simulates one design, `trajectory` returns its
motion and `resonance` its resonances. `sweep` runs a whole grid and `evaluate` a batch of points. `respond` follows
designs up and down in frequency. Results are a `Table`, whose columns are NumPy arrays; it converts to pandas, polars,
Arrow and xarray.

Pictures are in `flapwing.plot`, which needs matplotlib.
"""

from ._evaluate import evaluate
from ._flapwing import Diagnostic, Grid, GridError, __version__, presets
from ._point import Parameter, measures, params, resonance, run, trajectory
from ._respond import respond
from ._sweep import read, sweep
from ._table import Table

__all__ = [
    "Diagnostic",
    "Grid",
    "GridError",
    "Parameter",
    "Table",
    "__version__",
    "evaluate",
    "measures",
    "params",
    "presets",
    "read",
    "resonance",
    "respond",
    "run",
    "sweep",
    "trajectory",
]
