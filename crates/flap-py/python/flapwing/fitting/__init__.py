"""Fits of parameters to readings, with the uncertainty of the parameters.

`fit` takes `Readings` and `FreeParameter` objects, and returns a `Fit`. Most other classes are parts of a `Fit`, or
results of `compare` and `select`.

- `_names`, `_cells`, `_noise`: names, cells and standard errors in columns of readings
- `_data`, `_held`: readings in the units of the model, and readings that are not fitted
- `_typical`, `_parameters`: typical sizes of terms, free parameters, and the coordinates of the search
- `_model`, `_branches`: readings of the model at many sets of parameters, in batches, and branches of hysteresis
- `_search`: least squares from several starts at the same time
- `_intervals`: intervals by the profile likelihood, and combinations of parameters
- `_structure`, `_discrepancy`, `_drift`: patterns in residuals, discrepancy of the model, and disagreement of data sets
- `_spread`: scatter of a parameter between robots
- `_assess`: errors of an estimate, from the tests of `_structure`, `_discrepancy` and `_drift`
- `_solution`, `_result`: the estimates, the quality of the fit, and the predictions of the fit
- `_points`, `_plan`: operating points of predictions, and the next readings
- `_report`, `_device`: the result as text, and as a device
- `_fit`: the function `fit`
- `_criteria`: likelihood of readings, and information criteria
- `_compare`, `_deciding`: comparison of fits of the same readings, and readings that decide between two fits
- `_select`, `_subsets`: forward selection of free parameters, and fits of subsets of the parameters
"""

from __future__ import annotations

from ._candidates import candidates
from ._compare import ComparedFit, Comparison, compare
from ._data import Readings
from ._deciding import DecidingMeasurements, DecidingReading
from ._discrepancy import Discrepancy
from ._fit import fit
from ._intervals import Profile
from ._parameters import FreeParameter
from ._plan import NextMeasurements
from ._result import Fit, Prediction
from ._select import Selection, SelectionStep, select
from ._solution import Effort, Estimate, Goodness, HeldOut, Outlier, Residuals, Unsettled
from ._spread import Spread
from ._structure import Structure

__all__ = [
    "ComparedFit",
    "Comparison",
    "DecidingMeasurements",
    "DecidingReading",
    "Discrepancy",
    "Effort",
    "Estimate",
    "Fit",
    "FreeParameter",
    "Goodness",
    "HeldOut",
    "NextMeasurements",
    "Outlier",
    "Prediction",
    "Profile",
    "Readings",
    "Residuals",
    "Selection",
    "SelectionStep",
    "Spread",
    "Structure",
    "Unsettled",
    "candidates",
    "compare",
    "fit",
    "select",
]
