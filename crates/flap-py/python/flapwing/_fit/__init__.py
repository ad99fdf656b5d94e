"""Fits of parameters to readings, with their uncertainty.

- `_file`, `_columns`, `_cells`, `_readings`, `_noise`, `_errors`: data, in the units of the model, and their standard errors
- `_free`: free parameters, and the coordinates in which they are looked for
- `_model`, `_branch`: readings of the model at many sets of parameters, in batches; branches of hysteresis
- `_search`, `_together`: least squares from several starts, side by side
- `_identify`, `_profile`, `_goodness`: what the data tell, intervals, and whether the model is good
- `_estimate`, `_held`, `_predict`, `_device`, `_report`, `_result`, `_solution`: predictions, files and reports of the result
"""

from __future__ import annotations

from ._estimate import Estimate
from ._fit import fit
from ._free import Free
from ._predict import NextMeasurements, Prediction
from ._readings import Readings
from ._result import Fit

__all__ = ["Estimate", "Fit", "Free", "NextMeasurements", "Prediction", "Readings", "fit"]
