"""Pictures of results with matplotlib, each by one function call.

Every function takes a `flapwing.Table`, a data frame, a mapping of columns or the path of a file of results, and
returns the matplotlib Axes, the Figure if it has several Axes, or the animation. Settings of matplotlib do not change.

    >>> import numpy as np
    >>> from flapwing import plot
    >>> table = {"drive_frequency": np.array([100.0, 110.0, 120.0]), "lift_mean_mn": np.array([0.2, 0.5, 0.3])}
    >>> plot.response(table, "lift_mean_mn").get_ylabel()
    'Lift, mean (mN)'

Needs the extra: ``pip install "flapwing[plot]"``.
"""

from __future__ import annotations

try:
    import matplotlib as _matplotlib
except ImportError as _missing:
    raise ImportError(
        'flapwing.plot needs matplotlib: pip install "flapwing[plot]", or pip install "matplotlib>=3.7"'
    ) from _missing
del _matplotlib

from ._correlations import RankCorrelation, rank_correlations
from ._fit import fit
from ._front import non_dominated
from ._heatmap import heatmap
from ._histogram import histogram
from ._hysteresis import hysteresis
from ._labels import label
from ._pareto import pareto
from ._response import response
from ._scatter import scatter
from ._tornado import Sensitivity, sensitivities, tornado
from ._trajectory import trajectory
from ._wing_path import WingPath, wing_path
from ._wrench import wrench

__all__ = [
    "RankCorrelation",
    "Sensitivity",
    "WingPath",
    "fit",
    "heatmap",
    "histogram",
    "hysteresis",
    "label",
    "non_dominated",
    "pareto",
    "rank_correlations",
    "response",
    "scatter",
    "sensitivities",
    "tornado",
    "trajectory",
    "wing_path",
    "wrench",
]
