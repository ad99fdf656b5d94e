"""Disagreement between data sets, for example by a drift of the robot between experiments."""

from __future__ import annotations

import numpy as np

from .._types import Array, Places
from ._parameters import Space
from ._search import rank

#: Data sets disagree if the probability of the test is below this limit, divided by the number of tests of a fit
#: (Bonferroni).
_SIGNIFICANT = 1e-3


def between_sets(space: Space, of_set: Places, scaled: Array, jacobian: Array) -> str:
    """Return the name of the parameter that best explains a disagreement between the data sets. Return an empty text if
    the data sets agree. Parameters that already have a separate value for each data set are not tested.

    A parameter explains the disagreement if a separate value for each data set significantly reduces the sum of squares
    of the residuals (F test). The test approximates the residuals by linear functions of the parameters, with the
    derivatives at the estimate. `scaled` contains the residuals in standard errors, and `jacobian` contains the
    derivatives of `scaled`. `of_set` contains the index of the data set of each reading.
    """
    from scipy.stats import f

    count, known = len(np.unique(of_set)), rank(jacobian)
    shared = [place for place, one in enumerate(space.coordinates) if one.of_set is None]
    freedom = len(scaled) - known - (count - 1)
    if count < 2 or freedom < 1 or not shared:
        return ""
    others = np.stack([of_set == place for place in np.unique(of_set)[1:]], axis=1)
    before = _rest(jacobian, scaled)
    found = []
    for place in shared:
        after = _rest(np.hstack([jacobian, others * jacobian[:, [place]]]), scaled)
        ratio = (before - after) / (count - 1) / max(after / freedom, 1e-300)
        found.append((float(f.sf(ratio, count - 1, freedom)), space.labels[place]))
    p, label = min(found)
    return label if p < _SIGNIFICANT / len(found) else ""


def _rest(columns: Array, values: Array) -> float:
    """Return the sum of squares of `values` that remains after a least-squares fit by a linear combination of the
    columns.
    """
    lengths = np.linalg.norm(columns, axis=0)
    used = columns[:, lengths > 0.0] / lengths[lengths > 0.0]
    rest = values - used @ np.linalg.lstsq(used, values, rcond=1e-6)[0]
    return float(rest @ rest)
