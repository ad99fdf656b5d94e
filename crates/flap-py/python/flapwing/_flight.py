"""Flights of vehicles over time."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from typing import Any, SupportsIndex

import numpy as np

from . import _arguments, _flapwing, _workers
from ._mistakes import reading, refused
from ._progress import Progress, one_step
from ._table import Table
from ._types import Design, Executor, Value


def fly(
    design: Design,
    /,
    *,
    seconds: Value,
    disturbance: Mapping[str, Value] | None = None,
    gains: Any = None,
    inputs: Sequence[str] | None = None,
    averaged: bool = False,
    samples: SupportsIndex | None = None,
    point: SupportsIndex | None = None,
    progress: Progress = False,
    client: Executor | None = None,
    **keywords: Value,
) -> Table:
    """Simulate the flight of a vehicle: the coupled motion of wings and body, with or without a controller.

    At the beginning of the flight, the motion of the wings has settled. The wings respond to the velocity and the
    angular rates of the body, but not to the acceleration of the body. The inertial forces of the wings do not act on
    the body, because the wings are light. The argument `about` of `Vehicle` must be the centre of mass. The flight
    requires `total_mass` and the parameters `body_inertia_roll`, `body_inertia_pitch` and `body_inertia_yaw`.

    At the beginning of each wing beat, a controller sets the inputs to their initial values minus ``gains @ x``. The
    vector x has nine states: the means of the body's velocities, angular rates and angles over the last wing beat.

    If the simulation cannot continue, the table ends early and a UserWarning gives the reason. For example, the table
    ends early if an input leaves its range.

    Parameters
    ----------
    design : Vehicle, str, path, dict or Grid
        A vehicle, or a grid with a vehicle.
    seconds : float or str
        Duration: a number in seconds, or text with a unit. The flight ends at the end of a wing beat.
    disturbance : dict of str to float or str, optional
        States of the body at the beginning, such as ``{"rate_pitch": 2.0}``, by the names of `LinearModel.states`.
        Values are numbers in SI units, or text with units. The states do not contain the vibration of the body within
        each wing beat. By default, the body begins at rest.
    gains : array_like of shape (inputs, 9), optional
        Gains of the controller in SI units, such as the result K of ``control.lqr``. By default, the flight has no
        controller.
    inputs : sequence of str, optional
        Names of the inputs: parameters, or the names such as ``"amplitude_difference"`` that `Vehicle.linear` accepts.
        If `gains` is given, `inputs` is required. The table has one column of values for each input.
    averaged : bool, optional
        If True, the linear model about hover is solved exactly, without the error of a numerical integration. By
        default, the coupled motion of wings and body is simulated.
    samples : int, optional
        Number of samples in each wing beat. The whole flight can have 5 million samples. By default, each row contains
        the means over one wing beat.
    point : int, optional
        The index of a point, if the vehicle is a grid with several points.
    progress : bool or function, optional
        If True, a progress bar is shown, as for `sweep`. The progress bar advances only once, at the end of the flight.
    client : executor, optional
        An executor, such as a process pool (see `sweep`). The flight is simulated on one of the workers of the
        executor.
    **keywords : float or str
        Parameters of the vehicle and solver settings, as for `run`.

    Returns
    -------
    Table
        One row for each wing beat, with the time at the middle of the wing beat. The columns of the table are `time_s`,
        the states including the position, the inputs in SI units, and the force and torque of the air. Velocities and
        angular rates are in body axes, and the position is in fixed axes. The attitude results from rotations about the
        body axes: by the yaw angle, then by the pitch angle, then by the roll angle. The attribute `meta` of the table
        also contains the argument `disturbance`.

    Raises
    ------
    ValueError
        Raised if the design is no vehicle, or a mass property is missing or impossible. Raised if a state or an input
        is unknown, an input is a derived parameter, or the shape of `gains` is wrong. Raised if the motion of the wings
        is not periodic.
    TypeError
        Raised if an argument has the wrong type.

    Examples
    --------
    >>> place = ["0 mm", "2 mm", "0 mm"]
    >>> wings = [flapwing.Wing("left", position=place), flapwing.Wing("right", position=place, mirrored=True)]
    >>> vehicle = flapwing.Vehicle("jafferis2016", wings, about=["0 mm", "0 mm", "-3 mm"], total_mass="69 mg")
    >>> inertia = {"body_inertia_roll": 1.5e-9, "body_inertia_pitch": 1.5e-9, "body_inertia_yaw": 0.5e-9}
    >>> point = {"drive_voltage_pp": "140 V", "drive_frequency": "120 Hz"}
    >>> flight = flapwing.fly(vehicle, seconds=0.05, disturbance={"velocity_forward": "0.1 m/s"}, **point, **inertia)
    >>> len(flight)
    6
    """
    if gains is not None and inputs is None:
        raise ValueError("`gains` require `inputs`\ngive the names of the inputs, one for each row of `gains`")
    names = _arguments.name_list("inputs", inputs, "amplitude")
    if disturbance is not None and not isinstance(disturbance, Mapping):
        raise refused("disturbance", disturbance, 'it must be a dictionary, such as {"velocity_forward": "0.1 m/s"}')
    with one_step(progress):
        native = _workers.call(
            client,
            _flapwing.fly,
            design,
            dict(keywords),
            point=point,
            seconds=seconds,
            disturbance=[] if disturbance is None else list(disturbance.items()),
            gains=None if gains is None else _matrix(gains),
            inputs=names or [],
            averaged=_arguments.flag("averaged", averaged),
            samples=samples,
        )
    for text in native["warnings"]:
        warnings.warn(text, stacklevel=2)
    table = Table._of(native, keywords=keywords)
    table.meta["disturbance"] = dict(disturbance or {})
    return table


def _matrix(gains: Any) -> list[list[float]]:
    """Return the gains of the controller as a list of the rows of the matrix."""
    allowed = "it must be a matrix of numbers: one row for each input, one column for each of nine states"
    with reading("gains", gains, allowed):
        given = np.asarray(gains)
        matrix = np.asarray(given.real, dtype=np.float64)
    if given.dtype.kind == "c":
        raise TypeError(f"`gains` has complex numbers\n{allowed}")
    if matrix.ndim != 2:
        raise ValueError(f"`gains` has {matrix.ndim} dimensions\n{allowed}")
    rows: list[list[float]] = matrix.tolist()
    return rows
