"""Tests of the residuals of a fit for patterns along the parameters of the operating points."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._types import Array, Places

#: Residuals have a pattern if the probability of the test is below this limit, divided by the number of tests of a fit
#: (Bonferroni).
_SIGNIFICANT = 0.01

#: Smallest number of pairs of neighbouring residuals, or of residuals, for a test.
_FEWEST = 8

#: Largest relative difference between values of a parameter that count as equal.
_EQUAL = 0.005

#: Largest difference between values that count as equal, as a share of the difference between the largest and the
#: smallest value of the parameter.
_EQUAL_SHARE = 0.02


@dataclass(frozen=True)
class Structure:
    """The result of a test: whether the residuals of a measure in all data sets have a pattern along a parameter.

    Attributes
    ----------
    measure, parameter : str
        The measure whose residuals are tested, and the parameter of the operating points along which neighbouring
        residuals are compared.
    p : float
        The probability that the neighbouring residuals of pure noise are at least as similar as the neighbouring
        residuals of the fit. Neighbours are readings that differ only in `parameter`. If several readings have the same
        value of `parameter`, the test also compares the mean residuals at different values (analysis of variance). Two
        values of a parameter count as equal if they differ by at most 0.5 %, and by at most 2 % of the parameter's
        range. If the whole range of a parameter is at most 0.5 % of its value, all its values count as equal.
    is_structured : bool
        True if the residuals have a pattern, which suggests that the model lacks an effect.
    """

    measure: str
    parameter: str
    p: float
    is_structured: bool = False


class Layout:
    """The operating points of all readings. For each parameter, the class contains the ranks of the parameter's
    values.
    """

    def __init__(self, points: Mapping[str, Any], rows: Places, branches: Places) -> None:
        ranks = {name: _ranks(np.asarray(values)[rows]) for name, values in points.items()}
        self.varied = [
            name for name, values in points.items() if isinstance(values, np.ndarray) and ranks[name].max(initial=0) > 0
        ]
        #: The ranks of the values of each parameter. Values that count as equal have equal ranks.
        self.ranks = ranks
        self._branches = branches

    def pairs(self, parameter: str, chosen: Places) -> tuple[Places, Places]:
        """Return pairs of readings that are neighbours along a parameter. The first array contains the first reading of
        each pair, and the second array the second reading. The two readings of a pair have the same values of all
        parameters except the given parameter.
        """
        others = [self._branches, *(ranks for name, ranks in self.ranks.items() if name != parameter)]
        keys = np.stack([one[chosen] for one in others])
        order = np.lexsort([self.ranks[parameter][chosen], *keys])
        same = (keys[:, order[1:]] == keys[:, order[:-1]]).all(axis=0)
        return chosen[order[:-1][same]], chosen[order[1:][same]]


def _ranks(values: np.ndarray[Any, Any]) -> Places:
    """Return the ranks of the values of a parameter. A value that counts as equal to the smallest value of a rank gets
    this rank. If the whole range of the values is at most 0.5 % of the largest value, all values count as equal.
    """
    if values.dtype.kind != "f":
        return np.unique(values, return_inverse=True)[1].astype(np.intp)
    order = np.argsort(values, kind="stable")
    span, tolerances = np.ptp(values), _EQUAL * np.abs(values)
    if span > tolerances.max():
        tolerances = np.minimum(tolerances, _EQUAL_SHARE * span)
    ranks = np.zeros(len(values), np.intp)
    rank, first = 0, values[order[0]]
    for place in order:
        if values[place] - first > tolerances[place]:
            rank, first = rank + 1, values[place]
        ranks[place] = rank
    return ranks


def tests(layout: Layout, measures: Mapping[str, Places], scaled: Array) -> list[Structure]:
    """Return the result of a test for each measure and each parameter that varies. `measures` contains the indices of
    the readings of each measure, and `scaled` contains the residuals in standard errors.
    """
    found = [
        Structure(measure, parameter, p)
        for measure, chosen in measures.items()
        for parameter in layout.varied
        if (p := _probability(layout, parameter, chosen, scaled)) is not None
    ]
    limit = _SIGNIFICANT / max(1, len(found))
    return [Structure(one.measure, one.parameter, one.p, one.p < limit) for one in found]


def _probability(layout: Layout, parameter: str, chosen: Places, scaled: Array) -> float | None:
    from scipy.stats import f_oneway

    found = []
    first, second = layout.pairs(parameter, chosen)
    if len(first) >= _FEWEST:
        found.append(_probability_of_pairs(scaled[first], scaled[second], scaled[chosen]))
    ranks = layout.ranks[parameter][chosen]
    count = len(np.unique(ranks))
    if len(chosen) >= _FEWEST and 2 <= count <= len(chosen) // 4 and np.ptp(scaled[chosen]) > 0.0:
        found.append(float(f_oneway(*(scaled[chosen][ranks == rank] for rank in np.unique(ranks))).pvalue))
    if not found and len(chosen) > _FEWEST:
        # No points share their other parameters, so all points are neighbours along the parameter.
        residuals = scaled[chosen][np.argsort(ranks, kind="stable")]
        found.append(_probability_of_pairs(residuals[:-1], residuals[1:], residuals))
    return min(1.0, len(found) * min(found)) if found else None


def _probability_of_pairs(first: Array, second: Array, residuals: Array) -> float:
    """Return the probability that neighbouring residuals of pure noise are at least as similar as the given pairs of
    residuals.

    The probability is computed from the number of pairs with residuals of different signs, and from the mean product of
    the residuals of a pair.
    """
    from scipy.stats import binom, norm

    products = first * second
    square = float(np.mean(residuals**2))
    signs = products[products != 0.0]
    if square == 0.0 or not len(signs):
        return 1.0
    p_signs = binom.cdf(np.count_nonzero(signs < 0), len(signs), 0.5)
    p_products = norm.sf(products.sum() / (square * np.sqrt(len(products))))
    return float(min(1.0, 2.0 * min(p_signs, p_products)))
