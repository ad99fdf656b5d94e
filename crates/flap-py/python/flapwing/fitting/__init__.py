"""Fits of parameters to readings, with their uncertainty.

`fit` takes `Readings` and `FreeParameter` objects, and returns a `Fit`. All other classes are parts of a `Fit`.

- `_data`: readings in the units of the model, with their standard errors
- `_parameters`: free parameters, and the coordinates of the search
- `_model`: readings of the model at many sets of parameters, in batches; branches of hysteresis
- `_search`: least squares from several starts at the same time
- `_intervals`: intervals by the profile likelihood, and combinations of parameters
- `_solution`, `_result`: the estimates and the quality of the fit; predictions of the fit
- `_report`, `_device`: the result as text, and as a device
- `_fit`: the function `fit`
"""

from __future__ import annotations

from ._data import Readings
from ._fit import fit
from ._intervals import Profile
from ._parameters import FreeParameter
from ._result import Fit, NextMeasurements, Prediction
from ._solution import Effort, Estimate, Goodness, HeldOut, Residuals, Unsettled

__all__ = [
    "Effort",
    "Estimate",
    "Fit",
    "FreeParameter",
    "Goodness",
    "HeldOut",
    "NextMeasurements",
    "Prediction",
    "Profile",
    "Readings",
    "Residuals",
    "Unsettled",
    "fit",
]
