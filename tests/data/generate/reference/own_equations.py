"""The simplified bimorph of examples/own_equations: Eqs. (1), (2) and (8) to (11) of Jafferis, Graule and Wood (2016),
with constant stiffness and a sinusoidal force.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, pi, sin

import numpy as np

from .motion import Motion, Results, Row, Surface, run

TRANSMISSION = 3333.0  # T (rad/m)
MASS = (51.1 + 10.22) * 1e-12 * TRANSMISSION**2  # kg
STIFFNESS = 395.0  # N/m
I_XX, I_XZ = 1.2255e-12, 0.812e-12  # kg m²
KAPPA = 1.497e-6  # N m/rad
B_1, B_2, B_LIFT = 0.5 * (4.25 + 0.156), 0.5 * (4.25 - 0.156), 1.8
HALF = 0.5 * 1.2 * 54.59e-6  # rho A / 2 (kg/m)
PRESSURE = HALF * 0.564**2 * (0.017 * TRANSMISSION) ** 2
R_CP = 13.58e-3  # m
C_C = HALF * 0.753e-3 * 0.43**2 * 4.5e-3**2 * 4.25
P_MIN, P_MAX = 0.132, 0.151
#: Periods from rest, and those at their end that are measured.
PERIODS, MEASURED = 40, 5


def row(given: Row) -> Results:
    """A row of own_equations.csv."""
    force, f = float(given["F0"]), float(given["f"])

    def bars(psi: float, side: float) -> float:
        return 1.0 - 2.0 / pi * side * psi

    def rates(t: float, y: Sequence[float], sides: Sequence[float]) -> Sequence[float]:
        _, v, psi, psi_dot = y
        v_v = sides[1] * v * v
        drag = B_1 + B_2 * cos(2.0 * psi)
        push = force * sin(2.0 * pi * f * t) - PRESSURE * R_CP * TRANSMISSION * drag * v_v
        x_ddot = (push - STIFFNESS * y[0]) / MASS
        arm = 54.59e-6 / 0.017 * (P_MIN + (P_MAX - P_MIN) * sides[4] * bars(psi, sides[2]))
        moment = PRESSURE * arm * (drag * cos(psi) + B_LIFT * sin(2.0 * psi) * sin(psi)) * v_v
        moment += I_XZ * TRANSMISSION * x_ddot * cos(psi) + 0.5 * I_XX * (TRANSMISSION * v) ** 2 * sin(2.0 * psi)
        return v, x_ddot, psi_dot, (moment - KAPPA * psi - C_C * sides[3] * psi_dot**2) / I_XX

    def lift(t: float, y: Sequence[float], sides: Sequence[float]) -> Sequence[float]:
        return (PRESSURE * B_LIFT * sides[1] * y[1] ** 2 * sin(2.0 * y[2]),)

    surfaces: list[Surface] = [
        lambda t, y: y[0],
        lambda t, y: y[1],
        lambda t, y: y[2],
        lambda t, y: y[3],
        lambda t, y: bars(y[2], float(np.sign(y[2]))),
    ]
    motion = Motion(rates, surfaces, scale=(1e-4, 0.1, 1.0, 1e3))
    settled = run(motion, 0.0, (PERIODS - MEASURED) / f, np.zeros(4)).y
    # The phase of the drive is that of time 0 again.
    last = run(motion, 0.0, MEASURED / f, settled, integrands=lift)
    x_min, x_max = last.extremes(1, lambda y: float(y[0]))
    psi_min, psi_max = last.extremes(3, lambda y: float(y[2]))
    return {
        "max_x": max(-x_min, x_max),
        "max_psi": max(-psi_min, psi_max),
        "lift": float(last.integrals[0]) * f / MEASURED,
    }
