"""The linear model of a vehicle about hover."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ._types import Array

Complexes = np.ndarray[Any, np.dtype[np.complex128]]


@dataclass(frozen=True, eq=False)
class LinearModel:
    """The linear model ``x' = A x + B s`` of small deviations `x` from hover, with changes `s` of the inputs.

    `Vehicle.linear` returns a `LinearModel`. All numbers are in SI units. The outputs of the model are the states. The
    body axes are x forward, y to the left, and z up.

    Attributes
    ----------
    A, B, C, D : arrays
        The matrices of the state-space model. `C` is the identity matrix, and `D` is the zero matrix.
    damping : array, 6 × 6
        The derivatives of mean force (N) and mean torque (N m) with respect to the velocity (m/s) and the rates (rad/s)
        of the body.
    control_matrix : array, 6 × inputs
        The derivatives of mean force and torque with respect to the inputs.
    W0 : array
        The mean force (N) and torque (N m) at the operating point.
    residual : array
        The mean force (N) and torque (N m) including the weight of the vehicle. All components are zero if the vehicle
        hovers.
    eigenvalues : complex array
        The eigenvalues of `A` (1/s), in falling order of the real part.
    modes : list of str
        Description of the motion of each eigenvalue's mode, such as ``"pitch and forward velocity (longitudinal
        oscillation)"``.
    states, state_units : list of str
        Names and units of the states: velocities, angular rates and angles. With ``positions=True``, the states include
        the position.
    inputs, input_units : list of str
        Names and units of the inputs.
    input_values : array
        The values of the inputs at the operating point.
    wrench : list of str
        The names of the components of force and torque.
    drive_frequency : float
        The drive frequency (Hz).
    floquet_max : float
        The largest magnitude of the Floquet multipliers of all wings.
    warnings : list of str
        Reasons why the linear model may be inaccurate.
    """

    A: Array
    B: Array
    C: Array
    D: Array
    damping: Array
    control_matrix: Array
    W0: Array
    residual: Array
    eigenvalues: Complexes
    modes: list[str]
    states: list[str]
    state_units: list[str]
    inputs: list[str]
    input_units: list[str]
    input_values: Array
    wrench: list[str]
    drive_frequency: float
    floquet_max: float
    warnings: list[str]

    def statespace(self) -> Any:
        """Return the model as a ``control.StateSpace`` of python-control, with names of states, inputs and outputs.

        Returns
        -------
        control.StateSpace

        Raises
        ------
        ImportError
            Raised if python-control is not installed.
        """
        try:
            import control
        except ImportError as missing:
            raise ImportError("statespace() requires python-control: pip install control") from missing
        return control.ss(self.A, self.B, self.C, self.D, states=self.states, inputs=self.inputs, outputs=self.states)

    def __repr__(self) -> str:
        fastest = self.eigenvalues[0] if len(self.eigenvalues) else float("nan")
        size = f"{len(self.states)} states, {len(self.inputs)} inputs"
        return f"<flapwing.LinearModel: {size}, first eigenvalue {fastest:.4g} 1/s>"
