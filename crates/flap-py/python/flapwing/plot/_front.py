"""The Pareto front of points."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np


def non_dominated(costs: Any) -> np.ndarray:
    """Mark the points that are not dominated, where smaller is better in every column.

    A point is dominated if another is nowhere larger and somewhere smaller. Equal points do not dominate each other.

    Parameters
    ----------
    costs : array_like, shape (n, k)
        A row per point, a column per objective, k >= 1; negate what is to be large.

    Returns
    -------
    ndarray of bool, shape (n,)
        True for the points of the front; False where a cost is NaN.

    Raises
    ------
    ValueError
        `costs` is not two-dimensional.

    Examples
    --------
    >>> non_dominated([[1.0, 5.0], [2.0, 3.0], [2.0, 4.0], [3.0, 3.0]]).tolist()
    [True, True, False, False]
    """
    costs = np.asarray(costs, dtype=float)
    if costs.ndim != 2 or costs.shape[1] < 1:
        raise ValueError(f"costs must have shape (n, k), not {costs.shape}")
    front = np.zeros(len(costs), dtype=bool)
    known = np.flatnonzero(~np.isnan(costs).any(axis=1))
    if known.size == 0:
        return front
    points, inverse = np.unique(costs[known], axis=0, return_inverse=True)
    front[known] = _of_distinct(points)[inverse.reshape(-1)]
    return front


def _of_distinct(points: np.ndarray) -> np.ndarray:
    """The front of distinct points in lexicographic order: a point is dominated by earlier ones alone."""
    kept = np.ones(len(points), dtype=bool)
    if points.shape[1] == 1:
        kept[1:] = False
    elif points.shape[1] == 2:
        kept[1:] = points[1:, 1] < np.minimum.accumulate(points[:, 1])[:-1]
    else:
        kept = _by_library(points)
    return kept


#: Points of which the front of three and more objectives is found without moocore at once.
FEW = 5000


def _by_library(points: np.ndarray) -> np.ndarray:
    """The front of distinct points in lexicographic order with three and more columns."""
    try:
        import moocore
    except ImportError:
        if len(points) > FEW:
            warnings.warn(
                f"the front of {len(points)} points takes a while without moocore: pip install moocore", stacklevel=4
            )
        return _one_by_one(points)
    found: np.ndarray = moocore.is_nondominated(points)
    return found


def _one_by_one(points: np.ndarray) -> np.ndarray:
    """The same without the library: each point of the front against all that are left."""
    kept = np.zeros(len(points), dtype=bool)
    left = np.arange(len(points))
    while left.size:
        best = left[0]
        kept[best] = True
        left = left[(points[left] < points[best]).any(axis=1)]
    return kept
