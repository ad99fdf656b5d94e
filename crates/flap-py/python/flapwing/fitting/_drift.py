"""Disagreement between data sets, for example by a drift of the robot between experiments."""

from __future__ import annotations

import numpy as np

from .._types import Array, Places
from ._parameters import Space
from ._search import rank

#: Limit of the probability below which data sets disagree. The limit is divided by the number of tests of a fit
#: (Bonferroni).
_SIGNIFICANT = 1e-3


def between_sets(space: Space, of_set: Places, scaled: Array, jacobian: Array) -> str:
    """Return the shared parameter that explains a disagreement between data sets best. Return an empty text if the data
    sets agree.

    A parameter explains the disagreement if separate values for the data sets significantly reduce the sum of squares
    of the residuals (F test). The residuals are linear in the parameters, with derivatives at the estimate. `scaled`
    has the residuals in standard errors, `jacobian` has the derivatives of `scaled`, and `of_set` has the data set of
    each reading.
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
    """Return the sum of squares that remains after the best linear combination of columns is subtracted."""
    lengths = np.linalg.norm(columns, axis=0)
    used = columns[:, lengths > 0.0] / lengths[lengths > 0.0]
    rest = values - used @ np.linalg.lstsq(used, values, rcond=1e-6)[0]
    return float(rest @ rest)
