"""The reference equations: a bimorph of Jafferis, Graule and Wood (2016) with constant stiffness and a sinusoidal
force, as in examples/own_equations.

The units of the states are the typical sizes `SCALE`, so that all states can have the same absolute tolerance.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

PERIODS = 40  # from rest
MEASURED = 5  # the last of them
SAMPLES_PER_PERIOD = 64

#: Displacement of the actuator's tip (m), velocity of the tip (m/s), pitch (rad), and pitch rate (rad/s).
SCALE = (1e-4, 0.1, 1.0, 1e3)

TRANSMISSION = 3333.0  # T (rad/m)
MASS = (51.1 + 10.22) * 1e-12 * TRANSMISSION**2  # at the tip (kg)
STIFFNESS = 395.0  # of the actuator (N/m)
INERTIA = 1.2255e-12  # I_xx (kg m²)
COUPLING = 0.812e-12  # I_xz (kg m²)
HINGE = 1.497e-6  # κ (N m/rad)
DRAG_MEAN = 0.5 * (4.25 + 0.156)
DRAG_SWING = 0.5 * (4.25 - 0.156)
LIFT = 1.8
ARM_LEAST, ARM_SWING = 0.132, 0.151 - 0.132
#: ½ ρ A r₂² (R T)²: pressure on the wing per squared tip speed (kg/m).
PRESSURE = 0.5 * 1.2 * 54.59e-6 * 0.564**2 * (0.017 * TRANSMISSION) ** 2
TIP_DRAG = PRESSURE * 13.58e-3 * TRANSMISSION
MOMENT = PRESSURE * 54.59e-6 / 0.017
HINGE_DRAG = 0.5 * 1.2 * 54.59e-6 * 0.753e-3 * 0.43**2 * 4.5e-3**2 * 4.25

Function = Callable[[Any], Any]


def equations(sin: Function, cos: Function, magnitude: Function) -> Callable[..., tuple[Any, Any, Any, Any]]:
    """Return the right-hand side. The functions `sin`, `cos` and `magnitude` determine the type of the arguments:
    numbers, arrays, or symbols of a compiler."""

    def rates(force: Any, x: Any, v: Any, psi: Any, w: Any) -> tuple[Any, Any, Any, Any]:
        v = v * SCALE[1]
        w = w * SCALE[3]
        sine, cosine = sin(psi), cos(psi)
        sin_2psi, cos_2psi = 2.0 * sine * cosine, 1.0 - 2.0 * sine * sine
        speed = v * magnitude(v)
        drag = DRAG_MEAN + DRAG_SWING * cos_2psi
        a = (force - STIFFNESS * SCALE[0] * x - TIP_DRAG * drag * speed) * (1.0 / MASS)
        arm = ARM_LEAST + ARM_SWING * magnitude(1.0 - magnitude(psi) * (2.0 / math.pi))
        air = MOMENT * arm * (drag * cosine + LIFT * sin_2psi * sine) * speed
        swing = (COUPLING * TRANSMISSION * a + INERTIA * TRANSMISSION**2 * v * v * sine) * cosine
        spring = HINGE * psi + HINGE_DRAG * w * magnitude(w)
        alpha = (air + swing - spring) * (1.0 / INERTIA)
        return v * (1.0 / SCALE[0]), a * (1.0 / SCALE[1]), w, alpha * (1.0 / SCALE[3])

    return rates
