"""Eigenvalues of linear models about hover, for the rows of a sweep."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ._arguments import columns_of, numbers
from ._table import Table
from ._types import Array

#: Columns of force and torque without their derivatives, and the factors to SI units.
_WRENCH = {
    "force_forward_mn": 1e-3,
    "force_left_mn": 1e-3,
    "force_up_mn": 1e-3,
    "torque_roll_unm": 1e-6,
    "torque_pitch_unm": 1e-6,
    "torque_yaw_unm": 1e-6,
}

#: Velocities and rates of the body, in the order of the states.
_MOTION = ["velocity_forward", "velocity_left", "velocity_up", "rate_roll", "rate_pitch", "rate_yaw"]


def hover_eigenvalues(
    rows: Table | Mapping[str, Any],
    total_mass: Array | float,
    body_inertia: Sequence[Array | float],
    *,
    body_inertia_product: Array | float = 0.0,
    gravity: float = 9.80665,
) -> np.ndarray[Any, np.dtype[np.complex128]]:
    """Return the eigenvalues of the linear model about hover, for each row of a sweep of vehicles with ``damping =
    true``.

    The states are velocities, angular rates, roll angle and pitch angle. The reference point of the torques must be the
    centre of mass. `hover_eigenvalues` does not trim the rows. The eigenvalues are correct for rows that hover, such as
    rows with ``trim = "hover"``. For rows near hover, the eigenvalues are an estimate. `Vehicle.linear` trims one
    design and describes the modes.

    Parameters
    ----------
    rows : Table or mapping
        The rows of the sweep, which must have the columns of the damping matrix.
    total_mass : float or array
        The mass of the vehicle (kg): one value for all rows, or one value for each row.
    body_inertia : three floats or arrays
        The moments of inertia for roll, pitch and yaw (kg m^2).
    body_inertia_product : float or array
        The product of inertia (kg m^2): the integral of x z over the mass of the vehicle.
    gravity : float
        The gravitational acceleration (m/s^2).

    Returns
    -------
    complex array, rows × 8
        The eigenvalues (1/s) in falling order of the real part. The eigenvalues of a row without a damping matrix are
        NaN.

    Raises
    ------
    ValueError
        Raised if a column of the damping matrix is missing, or `body_inertia` has not three entries. Raised if an
        argument is neither a number nor an array with one number for each row. Raised if the inertia of the body is not
        positive definite.
    TypeError
        Raised if `rows` has no columns, or a column of the damping matrix is not a column of numbers.
    """
    columns = [[f"d_{of}_per_si_body_{by}" for by in _MOTION] for of in _WRENCH]
    given = columns_of("rows", rows)
    missing = [name for line in columns for name in line if name not in given]
    if missing:
        raise ValueError(
            f"the rows lack {len(missing)} of the 36 columns of the damping matrix, such as `{missing[0]}`\n"
            "set damping = true in the section [vehicle] of the grid file, and sweep again"
        )
    listed = [[numbers(f"rows[{name!r}]", given[name], unknown=True) for name in line] for line in columns]
    lengths = {len(values) for line in listed for values in line}
    if len(lengths) > 1:
        raise ValueError(
            f"the columns of the damping matrix have {min(lengths)} to {max(lengths)} rows\ngive each one cell per row"
        )
    damping = np.array(listed)
    damping = np.moveaxis(damping * np.array(list(_WRENCH.values()))[:, None, None], 2, 0)
    count = len(damping)
    if isinstance(body_inertia, (str, Mapping)) or not hasattr(body_inertia, "__len__") or len(body_inertia) != 3:
        raise ValueError("`body_inertia` must be a list of the three moments of inertia for roll, pitch and yaw")
    mass = np.zeros((count, 6, 6))
    mass[:, range(3), range(3)] = _of_rows("total_mass", total_mass, count)[:, None]
    mass[:, range(3, 6), range(3, 6)] = np.stack([_of_rows("body_inertia", one, count) for one in body_inertia], axis=1)
    mass[:, 3, 5] = mass[:, 5, 3] = -_of_rows("body_inertia_product", body_inertia_product, count)
    if not (np.linalg.eigvalsh(mass) > 0).all():
        raise ValueError(
            "the mass or the inertia of the body is not positive definite\n"
            "mass and moments must be positive, and the square of body_inertia_product smaller than roll times yaw"
        )
    known = np.isfinite(damping).all(axis=(1, 2))
    states = np.zeros((count, 8, 8))
    states[:, :6, :6] = np.linalg.solve(mass, np.where(known[:, None, None], damping, 0.0))
    # A lowered nose accelerates forward, and a lifted left side accelerates to the right.
    weight = _of_rows("gravity", gravity, count)
    states[:, 0, 7], states[:, 1, 6] = weight, -weight
    states[:, 6, 3] = states[:, 7, 4] = 1.0
    found = np.linalg.eigvals(states).astype(np.complex128)
    found = np.take_along_axis(found, np.argsort(-found.real, axis=1, kind="stable"), axis=1)
    found[~known] = np.nan
    return found


def _of_rows(name: str, given: Array | float, count: int) -> Array:
    """Return an argument as an array with a number for each row."""
    try:
        values = np.broadcast_to(np.asarray(given, dtype=np.float64), count)
    except (TypeError, ValueError):
        values = np.array([np.nan])
    if np.isfinite(values).all():
        return values
    raise ValueError(
        f"`{name}` must be a finite number in SI units, or an array with such a number for each of the {count} rows"
    )
