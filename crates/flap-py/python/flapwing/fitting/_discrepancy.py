"""The discrepancy of a model: the part of the difference between model and readings that is not noise."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .._types import Array, Places
from ._noise import Noise
from ._structure import Layout

#: Largest correlation between the discrepancies at neighbouring points.
_MOST = 0.95

#: Smallest discrepancy that counts, in standard errors of the readings.
_LEAST = 0.1

#: Smallest share of the discrepancy's sum of squares that is assumed to remain in the residuals. At a smaller share,
#: the fit has too few readings to estimate the discrepancy.
_REST = 0.2

#: Number of rows of the correlation matrix that are computed together.
_CHUNK = 512


@dataclass(frozen=True)
class Discrepancy:
    """The discrepancy of a model for a measure: the part of the difference between model and readings that is not
    noise.

    Attributes
    ----------
    measure, unit : str
        The measure, and the unit of `size`: the unit of the measure, or ``"%"`` for per cent of the model's value.
    size : float
        The standard deviation of the discrepancy over the operating points of the data.
    readings : float
        The effective number of independent readings. Readings at neighbouring points have similar discrepancies, so the
        effective number is smaller than the number of readings in the data.
    """

    measure: str
    unit: str
    size: float
    readings: float


@dataclass(frozen=True)
class Discrepancies:
    """The discrepancies of all measures, and the covariance of the search coordinates, including the effect of the
    discrepancies."""

    listed: list[Discrepancy]
    #: The discrepancy of each measure, as a `Noise` object with the standard deviation of the discrepancy.
    noise: dict[str, Noise]
    covariance: Array
    #: Effective number of independent readings, less the number of parameters that the readings determine; infinite
    #: without discrepancy.
    freedom: float


def of_residuals(
    layout: Layout,
    measures: Mapping[str, Places],
    kinds: Mapping[str, str],
    units: Mapping[str, str],
    structured: set[str],
    values: Array,
    sigma: Array,
    scaled: Array,
    jacobian: Array,
    inverse: Array,
) -> Discrepancies:
    """Return the discrepancy of each measure, estimated such that noise and discrepancy together explain the squares of
    the residuals.

    For readings i and j of a measure, the covariance of the discrepancies is size² · s_i · s_j · ρ_ij. In the formula
    of the covariance, s is the model's value if standard errors are in per cent, and 1 if not. The correlation ρ of two
    points falls with the distance between the points. Along each parameter, the distance of two points is the
    difference between the ranks of their values. The products of the residuals of neighbouring points determine how
    fast the correlation ρ falls with the distance. The fitted parameters absorb a part of the noise and of the
    discrepancy, so the residuals are smaller than the sum of noise and discrepancy. The estimate of the discrepancy
    corrects for the absorbed part, as in a restricted maximum likelihood.

    `measures` contains the indices of the fitted readings of each measure, and `structured` contains the measures whose
    residuals have a pattern. Standard errors of the kind ``"unknown"`` are estimated from the residuals, so these
    standard errors contain the discrepancy. If standard errors are unknown and the residuals have a pattern, the whole
    estimated standard error counts as discrepancy. `inverse` is the covariance that the search coordinates have without
    a discrepancy.
    """
    base = np.ones(len(scaled))
    spread = np.zeros_like(inverse)
    listed, noises, independent = [], {}, []
    for measure, chosen in measures.items():
        residuals, slopes = scaled[chosen], jacobian[chosen]
        kind = kinds[measure]
        relative = kind == "relative"
        # The discrepancy is `shape` standard errors of each reading per unit of its size.
        shape = Noise("relative" if relative else "absolute").of(values[chosen], values[chosen], 1.0) / sigma[chosen]
        square = float(shape @ shape)
        likeness = _likeness(layout, chosen, scaled, shape)
        own = 0.0 if kind == "unknown" else 1.0
        if kind == "unknown" and measure not in structured:
            continue
        size = max(float(residuals @ residuals) - own * len(chosen), 0.0) / square
        if measure in structured:
            # The noise of readings does not contribute to products of neighbours.
            size = max(size, 0.0, *likeness.values())
        if size <= 0.0:
            continue
        declines = {name: float(np.clip(product / size, 0.0, _MOST)) for name, product in likeness.items()}
        by_slopes, total = _correlated(layout, chosen, declines, shape, slopes)
        noise = own * (len(chosen) - float(np.sum(inverse * (slopes.T @ slopes))))
        rest = max(square - float(np.sum(inverse * by_slopes)), _REST * square)
        size = max((float(residuals @ residuals) - noise) / rest, size)
        if np.sqrt(size * square / len(chosen)) < _LEAST:
            continue
        base[chosen] = own
        spread += size * by_slopes
        count = len(chosen) * square / max(total, square)
        unit = "%" if relative else units[measure]
        listed.append(Discrepancy(measure, unit, float(np.sqrt(size)) * (100.0 if relative else 1.0), count))
        noises[measure] = Noise("relative" if relative else "absolute", float(np.sqrt(size)))
        independent.append(count)
    if not listed:
        return Discrepancies([], {}, inverse, np.inf)
    kept = np.concatenate([*measures.values()])
    lost = (1.0 - base[kept])[:, np.newaxis] * jacobian[kept]
    covariance = inverse + inverse @ (spread - lost.T @ jacobian[kept]) @ inverse
    # The readings determine this number of coordinates. Priors determine the others.
    parameters = float(np.sum(inverse * (jacobian.T @ jacobian)))
    return Discrepancies(listed, noises, covariance, sum(independent) - parameters)


def _likeness(layout: Layout, chosen: Places, scaled: Array, shape: Array) -> dict[str, float]:
    """Return an estimate of the squared discrepancy for each parameter, from the products of residuals that are
    neighbours along the parameter. The sum of the products of residuals is divided by the sum of the products of the
    neighbouring values in `shape`.
    """
    whole = np.zeros(len(scaled))
    whole[chosen] = shape
    found = {}
    for parameter in layout.varied:
        first, second = layout.pairs(parameter, chosen)
        if len(first):
            found[parameter] = float(scaled[first] @ scaled[second]) / float(whole[first] @ whole[second])
    return found


def _correlated(
    layout: Layout, chosen: Places, declines: Mapping[str, float], shape: Array, slopes: Array
) -> tuple[Array, float]:
    """Return the matrix ``slopes.T @ C @ slopes``, and the sum of all elements of C. The matrix C is the correlation
    matrix of the discrepancies after the multiplication of its rows and its columns by `shape`.
    """
    weighted = shape[:, np.newaxis] * slopes
    ranks = {name: layout.ranks[name][chosen] for name in layout.varied}
    by_slopes, total = np.zeros((slopes.shape[1], slopes.shape[1])), 0.0
    for begin in range(0, len(chosen), _CHUNK):
        part = slice(begin, begin + _CHUNK)
        correlation = np.ones((len(shape[part]), len(shape)))
        for name, rank in ranks.items():
            distance = np.abs(rank[part, np.newaxis] - rank)
            correlation *= declines.get(name, 0.0) ** distance
        by_slopes += weighted[part].T @ (correlation @ weighted)
        total += float(shape[part] @ correlation @ shape)
    return by_slopes, total
