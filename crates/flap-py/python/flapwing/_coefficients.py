"""Parameters of a model from a table of force coefficients over the attack angle."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np

from . import _flapwing
from ._data import Data
from ._types import Array, Design

#: Columns of a table that can be fitted.
_COLUMNS = ("lift_coefficient", "drag_coefficient", "pressure")

#: Columns of the attack angle, with their units (rad).
_ANGLES = {"attack_deg": np.pi / 180.0, "attack_rad": 1.0}

#: Smallest ratio of the singular values of a law at the angles of a table that determines the coefficients of the law.
_DETERMINED = 1e-5


@dataclass(frozen=True, eq=False)
class CoefficientFit:
    """Parameters of a model that reproduce a table of coefficients (see `fit_coefficients`).

    `print` shows the parameters as the section `[params]` of a grid file or a device.

    Attributes
    ----------
    params : dict of str to float
        Values of the parameters, in the units of the model. You can pass `params` as keywords to `run` and similar
        functions.
    attack : array of shape (n,)
        Attack angles of the table (rad).
    fitted : dict of str to array of shape (n,)
        Values that the model computes at the attack angles, one array for each fitted column of the table.
    largest_error : dict of str to float
        Largest magnitude of the difference between the table and the model, one number for each fitted column of the
        table.
    """

    params: dict[str, float]
    attack: Array
    fitted: dict[str, Array]
    largest_error: dict[str, float]

    def __str__(self) -> str:
        errors = [f"# largest error of {name}: {error:.2g}" for name, error in self.largest_error.items()]
        values = [f"{name} = {value:.6g}" for name, value in self.params.items()]
        return "\n".join([*errors, "[params]", *values])


def fit_coefficients(design: Design, table: Any, /) -> CoefficientFit:
    """Fit the laws of a model for lift, drag and centre of pressure to a table over the attack angle.

    All models use the same formulas of lift, drag and centre of pressure, so you can simulate one design with the
    coefficients of several papers. The fit is a linear least-squares fit. At the attack angle α, the laws are::

        C_L = sin 2α (b_L + l_1 cos 2α + l_2 cos² 2α)
        C_D = b_max sin² α + b_min cos² α + sin² 2α (d_0 + d_1 cos 2α)
        centre of pressure = constant + slope α + sin 2α (p_c0 + p_c1 cos 2α)

    The fitted lift is always zero at attack angles of 0 and 90°. If the table has a lift at 90° that is not zero, the
    fit cannot reproduce this lift. The fitted coefficients b_L, b_max and b_min are never negative.

    Parameters
    ----------
    design : str, path, dict or Grid
        A preset, a device, a grid, or the name of a model. The design determines the names of the fitted parameters.
    table : str, path, Table, data frame or mapping of columns
        The column `attack_deg` or `attack_rad` contains attack angles from 0 to 90°, at least four different angles. At
        least one of three columns is required: `lift_coefficient`, `drag_coefficient`, or `pressure`, the centre of
        pressure. In `bimorph`, the centre of pressure is the distance behind the hinge's axis in mean wing widths, like
        the parameter `pressure_min`. In `direct-drive` and `four-bar`, the centre of pressure is the distance behind
        the leading edge in chords, like the parameter `pressure_offset`. Columns with other names are ignored.

    Returns
    -------
    CoefficientFit
        The fitted parameters, and the largest differences between the table and the model.

    Raises
    ------
    ValueError
        Raised if the design is unknown, or if the model of the design does not use these laws of lift and drag. Raised
        if a column is missing, an angle is not between 0 and 90°, a number is not finite, or columns differ in length.
        Raised if the table has too few angles, or if the angles do not determine the coefficients of a law. To fit the
        lift, the table must contain three different angles that are more than 0 and less than 90°.
    TypeError
        Raised if the table is neither text, nor a path, nor a set of columns.

    Examples
    --------
    >>> attack = np.linspace(0, 90, 10)
    >>> lift = 1.8 * np.sin(2 * np.radians(attack)) ** 3
    >>> law = flapwing.fit_coefficients("bimorph", {"attack_deg": attack, "lift_coefficient": lift})
    >>> [round(value, 6) for value in law.params.values()]
    [1.8, 0.0, -1.8]
    """
    data = Data.of(table)
    attack = _attack(data)
    names = [name for name in _COLUMNS if name in data]
    if not names:
        raise ValueError(f"the table has no column to fit\nadd one of {', '.join(_COLUMNS)}")
    laws = _laws({str(one["name"]) for one in _flapwing.params(design)})
    params: dict[str, float] = {}
    fitted, errors = {}, {}
    for name in names:
        values = data.numbers(name)
        if not np.isfinite(values).all():
            raise ValueError(f"`{name}` must contain finite numbers only")
        functions, least, parameters = laws[name]
        columns = np.stack(functions(attack), axis=-1)
        _check_angles(name, columns)
        solution = _solve(columns, values, least)
        params |= parameters(*(float(number) for number in solution))
        fitted[name] = columns @ solution
        errors[name] = float(np.abs(fitted[name] - values).max())
    return CoefficientFit(params, attack, fitted, errors)


def _attack(data: Data) -> Array:
    """Return the attack angles of a table (rad)."""
    given = [name for name in _ANGLES if name in data]
    if len(given) != 1:
        raise ValueError("the table must have one column `attack_deg` or `attack_rad` with the attack angles")
    attack = data.numbers(given[0]) * _ANGLES[given[0]]
    # Conversion to radians rounds the ends of the range.
    if not ((attack >= -1e-9) & (attack <= 0.5 * np.pi + 1e-9)).all():
        raise ValueError(f"`{given[0]}` must contain attack angles from 0 to 90 deg only")
    if len(np.unique(attack)) < 4:
        raise ValueError(f"`{given[0]}` must contain at least four different attack angles")
    return attack


def _check_angles(name: str, columns: Array) -> None:
    """Raise ValueError if the attack angles do not determine the coefficients of a law."""
    sizes = np.linalg.svd(columns, compute_uv=False)
    if len(columns) < columns.shape[1] or sizes[-1] < _DETERMINED * sizes[0]:
        raise ValueError(
            f"the attack angles of the table do not determine the {columns.shape[1]} coefficients of `{name}`\n"
            "add rows: the lift requires three different angles between 0 and 90 deg, and other laws four from 0 to "
            "90 deg; the angles must not be close together"
        )


def _solve(columns: Array, values: Array, least: int) -> Array:
    """Return the least-squares solution under the constraint that the first `least` unknowns are not negative.

    In the constrained solution, some of the first `least` unknowns are zero, and the other unknowns solve the problem
    without constraints. Therefore `_solve` sets each combination of the first `least` unknowns to zero and returns the
    best allowed solution.
    """
    solutions = []
    for positive in product((True, False), repeat=least):
        free = np.array([*positive, *[True] * (columns.shape[1] - least)])
        solution = np.zeros(len(free))
        solution[free] = np.linalg.lstsq(columns[:, free], values, rcond=None)[0]
        if (solution[:least] >= 0.0).all():
            solutions.append(solution)
    return min(solutions, key=lambda one: float(np.linalg.norm(columns @ one - values)))


#: Functions of the attack angle, the number of unknowns that must not be negative, and the names of the parameters that
#: the unknowns determine.
_Law = tuple[Callable[[Array], list[Array]], int, Callable[..., dict[str, float]]]


def _laws(known: set[str]) -> dict[str, _Law]:
    """Return the law (the formula) for each column of a table of coefficients. The names in `known` are the parameters
    of the model and determine the form of the laws."""
    if not {"lift_term_1", "drag_term_0", "pressure_term_0"} <= known:
        raise ValueError("the model of the design does not have these laws\nuse bimorph, direct-drive or four-bar")
    sine = "lift_amplitude" in known
    at_ends = "pressure_min" in known

    def lift(b: float, l_1: float, l_2: float) -> dict[str, float]:
        law = {"lift_coefficient_max": b}
        if sine:
            law = {"lift_offset": 0.0, "lift_amplitude": b, "lift_slope": 2.0, "lift_phase": 0.0}
        return {**law, "lift_term_1": l_1, "lift_term_2": l_2}

    def drag(largest: float, smallest: float, d_0: float, d_1: float) -> dict[str, float]:
        law = {"drag_coefficient_max": largest, "drag_coefficient_min": smallest}
        if sine:
            mean, swing = 0.5 * (largest + smallest), 0.5 * (largest - smallest)
            law = {"drag_offset": mean, "drag_amplitude": swing, "drag_slope": 2.0, "drag_phase": 0.0}
        return {**law, "drag_term_0": d_0, "drag_term_1": d_1}

    def pressure(start: float, end: float, p_0: float, p_1: float) -> dict[str, float]:
        law = {"pressure_min": start, "pressure_max": end}
        if not at_ends:
            law = {"pressure_offset": start, "pressure_slope": (end - start) / (0.5 * np.pi)}
        return {**law, "pressure_term_0": p_0, "pressure_term_1": p_1}

    return {
        "lift_coefficient": (_lift_functions, 1, lift),
        "drag_coefficient": (_drag_functions, 2, drag),
        "pressure": (_pressure_functions, 0, pressure),
    }


def _lift_functions(attack: Array) -> list[Array]:
    sin, cos = np.sin(2.0 * attack), np.cos(2.0 * attack)
    return [sin, sin * cos, sin * cos**2]


def _drag_functions(attack: Array) -> list[Array]:
    sin, cos = np.sin(2.0 * attack), np.cos(2.0 * attack)
    return [np.sin(attack) ** 2, np.cos(attack) ** 2, sin**2, sin**2 * cos]


def _pressure_functions(attack: Array) -> list[Array]:
    sin, cos = np.sin(2.0 * attack), np.cos(2.0 * attack)
    share = attack / (0.5 * np.pi)
    return [1.0 - share, share, sin, sin * cos]
