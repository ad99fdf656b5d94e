"""Parameters that no data of this kind tell apart, and combinations that they tell well or badly."""

from __future__ import annotations

from typing import Sequence

import numpy as np

from ._free import Coordinate, Space
from ._model import Model
from ._search import NOTHING, Target, sobol
from ._types import Array

#: Sets of parameters that are looked at, and those of them that count.
_LOOKS, _PLACES = 6, 4

#: The tolerance of the integration for it.
_RTOL = 1e-7

#: A parameter that changes all readings by less than this share of their standard errors over its whole range changes none.
_EFFECT = 1e-2

#: The share of the largest component below which one is left out of words.
_SHARE = 0.05


def indistinct(model: Model, target: Target, seed: int) -> list[str]:
    """Directions that the readings cannot tell at any values of the parameters: a sentence for each.

    Where the derivatives at each of several random sets of parameters have a null space, no data of this kind tell the
    parameters apart. A product of parameters has one and the same null space in logarithms at all of these sets, a sum in
    the parameters themselves: then derivatives under each other have it too.
    """
    space = model.space
    looks = sobol(space, _LOOKS, seed)
    answers = model.at(looks, rtol=_RTOL)
    # A motion that does not settle tells nothing: the sets with most readings.
    settled = sorted(range(len(looks)), key=lambda place: -np.isfinite(answers[place].values).sum())[:_PLACES]
    jacobians = [target.jacobian(space, looks[place], answers[place]) for place in settled]
    ranges = space.high - space.low
    idle = np.linalg.norm(np.concatenate(jacobians), axis=0) * ranges < _EFFECT
    told = [f"{label} changes no reading" for label, is_idle in zip(space.labels, idle) if is_idle]
    active = np.flatnonzero(~idle)
    jacobians = [jacobian[:, active] for jacobian in jacobians]
    if not len(active):
        return told
    wanted = min(len(_null(jacobian)) for jacobian in jacobians)
    slopes = [space.slopes(looks[place])[active] for place in settled]
    scales = np.array([one.slope(0.0) for one in space.coordinates])[active]
    linear = [jacobian / slope * scales for jacobian, slope in zip(jacobians, slopes)]
    for matrix, where in (
        (np.concatenate(jacobians), ""),
        (np.concatenate(linear), " of their values in the design"),
        (jacobians[0], " about where they are"),
    ):
        null = _null(matrix)
        if wanted and len(null) >= wanted:
            for direction in _sparse(null):
                whole = np.zeros(len(space))
                whole[active] = direction
                told.append(f"{together(space, whole)}{where} changes no reading")
            break
    return told


def _null(jacobian: Array) -> Array:
    """The directions that change nothing."""
    lengths = np.linalg.norm(jacobian, axis=0)
    lengths[lengths == 0.0] = 1.0
    _, sizes, directions = np.linalg.svd(jacobian / lengths, full_matrices=True)
    sizes = np.concatenate([sizes, np.zeros(len(directions) - len(sizes))])
    return np.asarray(directions[sizes < NOTHING * sizes[0]] / lengths)


def _sparse(directions: Array) -> list[Array]:
    """Combinations of directions with as few parameters as elimination makes them."""
    rows = [row / np.abs(row).max() for row in directions]
    for place in range(len(rows)):
        pivot = int(np.argmax(np.abs(rows[place])))
        rows[place] = rows[place] / rows[place][pivot]
        for other in range(len(rows)):
            if other != place:
                rows[other] = rows[other] - rows[other][pivot] * rows[place]
    return [row / np.abs(row).max() for row in rows if np.abs(row).max() > 0]


def together(space: Space, direction: Array) -> str:
    """A direction in words: what changes together, with the largest share 1 %."""
    largest = int(np.argmax(np.abs(direction)))
    scaled = direction / direction[largest]
    named = []
    for place in np.argsort(-np.abs(scaled), kind="stable"):
        if abs(scaled[place]) < _SHARE:
            continue
        way = "up" if scaled[place] > 0 else "down"
        one = space.coordinates[place]
        size = _size(one, 0.01 * abs(float(scaled[place])))
        named.append(f"{one.label} {way} by {size}")
    return " with ".join([named[0], ", ".join(named[1:])]) if len(named) > 1 else named[0]


def combinations(space: Space, jacobian: Array, labels: Sequence[str]) -> list[str]:
    """The best and the worst known combination of parameters, in words: the error is that of the parameter named first."""
    if len(space) < 2:
        return []
    _, sizes, directions = np.linalg.svd(jacobian, full_matrices=False)
    told = []
    for label, place in zip(labels, (0, -1)):
        direction = directions[place]
        if sizes[place] <= NOTHING * sizes[0]:
            error = "not known at all"
        else:
            largest = int(np.argmax(np.abs(direction)))
            error = f"known to {_size(space.coordinates[largest], abs(direction[largest]) / sizes[place])}"
        told.append(f"{label}: {together(space, direction)}, {error}")
    return told


def _size(one: Coordinate, change: float) -> str:
    """A change of a coordinate in words."""
    if not one.log:
        return f"{change * one.width:.2g} {one.unit}".rstrip()
    return f"{100 * change:.2g} %" if change < 1 else f"{100 * change:.0f} %"
