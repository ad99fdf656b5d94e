"""Fits of parameters to readings, with the uncertainty of the parameters.

`fit` takes `Readings` and `FreeParameter` objects, and returns a `Fit`. Most other classes of the package describe
parts of a `Fit`, or results of `compare` and `select`.

- `_names`, `_cells`, `_noise`: read the names, the cells and the standard errors in columns of readings
- `_data`, `_held`: convert readings to the units of the model, and choose the readings that are held out of the fit
- `_typical`, `_parameters`: bounds from typical sizes, free parameters, and the coordinates in which a fit searches
- `_model`, `_branches`: compute the predictions of the readings, and the motions on branches of hysteresis
- `_search`: minimise the sum of squares by several searches at the same time
- `_intervals`: confidence intervals by the profile likelihood, and combinations of parameters that the data determine
- `_structure`, `_discrepancy`, `_drift`: patterns in residuals, discrepancy of the model, disagreement of data sets
- `_spread`: scatter of a parameter between robots
- `_assess`: standard errors of the estimates, from the tests of `_structure`, `_discrepancy` and `_drift`
- `_solution`, `_result`: the estimates, the quality of the fit, and the predictions of the fit
- `_points`, `_plan`: operating points of predictions, and proposals for new readings
- `_report`, `_device`: write the result of a fit as text, and as a device file
- `_fit`: the function `fit`
- `_criteria`: likelihood of the readings, and information criteria (AICc, BIC)
- `_compare`, `_deciding`: comparison of fits of the same readings, and readings that show which of two fits is better
- `_select`, `_subsets`: forward selection of free parameters, and fits with subsets of the free parameters
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
