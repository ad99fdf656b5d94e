"""Functions that draw pictures of results with matplotlib.

Most functions draw results in a `flapwing.Table`, a data frame, a mapping of columns or a results file. A function
returns matplotlib Axes, a Figure if the picture has several Axes, or an animation. `flapwing.analysis` computes
sensitivities, rank correlations and Pareto fronts. `flapwing.plot.style` sets the size of figures and letters. The
functions that draw pictures leave the settings of matplotlib unchanged.

    >>> import numpy as np
    >>> from flapwing import plot
    >>> table = {"drive_frequency": np.array([100.0, 110.0, 120.0]), "lift_mean_mn": np.array([0.2, 0.5, 0.3])}
    >>> plot.response(table, "lift_mean_mn").get_ylabel()
    'Lift, mean (mN)'

You can install matplotlib with the extra `plot` of flapwing: ``pip install "flapwing[plot]"``.
"""

from __future__ import annotations

try:
    import matplotlib as _matplotlib
except ImportError as _missing:
    raise ImportError(
        'flapwing.plot requires matplotlib: pip install "flapwing[plot]", or pip install "matplotlib>=3.8"'
    ) from _missing
del _matplotlib

from .._labels import label
from ._animation import Animation
from ._eigenvalues import eigenvalues
from ._fit import fit
from ._flight import flight
from ._flight_film import flight_film
from ._forces import control_matrix, force_panels
from ._heatmap import heatmap
from ._histogram import histogram
from ._hysteresis import hysteresis
from ._pareto import pareto
from ._response import response, response_panels
from ._scatter import scatter
from ._style import style
from ._tornado import tornado
from ._trajectory import trajectory
from ._wing_path import wing_path

__all__ = [
    "Animation",
    "control_matrix",
    "eigenvalues",
    "fit",
    "flight",
    "flight_film",
    "force_panels",
    "heatmap",
    "histogram",
    "hysteresis",
    "label",
    "pareto",
    "response",
    "response_panels",
    "scatter",
    "style",
    "tornado",
    "trajectory",
    "wing_path",
]
