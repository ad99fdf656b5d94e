"""The bimorph of Jafferis, Graule and Wood (2016), with the preset jafferis2016. The page docs/models/bimorph.md has
the equations.

The time is the phase of the drive (rad), so that all points share the same times. The units of the states are the
typical sizes `TIP_SCALE` and `PITCH_SCALE`, and rates are per radian. All states can therefore have the same absolute
tolerance.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

TRANSMISSION = 3333.0  # T (rad/m)
TIP_SCALE, PITCH_SCALE = 0.1 / TRANSMISSION, 0.3  # m, rad

# Actuator. STRAIN: s_ε (1/m), TAPER: G for a width ratio of 1.556 and an extension ratio of 0.25.
LENGTH, WIDTH, PLATE, SHIM, EXTENSION = 9e-3, 1.125e-3, 135e-6, 50e-6, 1.5
TAPER = 0.8844130643539749
STRAIN = (PLATE + SHIM) / (LENGTH**2 * EXTENSION)
STIFFNESS_FACTOR = 0.79 * 0.8 * WIDTH * TAPER / (LENGTH**3 * EXTENSION)
PER_MODULUS = STIFFNESS_FACTOR * PLATE * (1.5 * SHIM**2 + 3.0 * SHIM * PLATE + 2.0 * PLATE**2)
STIFFENING = 8000.0 * STRAIN  # a₁ s_ε (1/m)
SOFT = PER_MODULUS * 38.5e9 + STIFFNESS_FACTOR * 340e9 / 4.0 * SHIM**3  # N/m
HARD = PER_MODULUS * 0.5 * (81e9 - 38.5e9) / STIFFENING  # force of the stiffening (N)
SIGMA = 0.022753943462804  # σ(a₁ε₀)
PER_STRESS = 3.0 * 0.7 * TAPER * WIDTH * PLATE * (PLATE + SHIM) / (4.0 * LENGTH)  # F_pre (N/Pa)
FORCE_SLOPE = -230.0 * STRAIN  # b (1/m)

# Transmission and wing.
SPRING = 197.7  # K_t (N/m)
MASS = (51.1 + 10.22) * 1e-12 * TRANSMISSION**2  # m_e (kg)
INERTIA, PRODUCT = 0.95 * 1.29e-12, 0.29 * 2.8e-12  # I_xx, I_xz (kg m²)
HINGE = 0.985 * 1.52e-6  # κ_wh (N m/rad)
AREA, WING = 54.59e-6, 17e-3
AIR = 0.5 * 1.2 * AREA
DRAG_MEAN, DRAG_SWING, LIFT = 0.5 * (1.25 * 3.4 + 0.39 * 0.4), 0.5 * (1.25 * 3.4 - 0.39 * 0.4), 1.8
PRESSURE = AIR * (0.564 * WING * TRANSMISSION) ** 2  # ½ρA_w r̂₂²R²T² (kg/m)
TIP_DRAG = PRESSURE * 1.42 * 9.56e-3 * TRANSMISSION
MOMENT = PRESSURE * AREA / WING
ARM_LEAST, ARM_SWING = 0.132, 0.151 - 0.132
HINGE_DRAG = AIR * 0.39 * 1.93e-3 * (0.43 * 4.5e-3) ** 2 * 1.25 * 3.4  # C_C (N m s²)


def push(volts_pp: Any, sine: Any, exp: Callable[[Any], Any] = math.exp) -> tuple[Any, Any]:
    """Return the difference and the sum of the forces of the two plates without strain (N), Eqs. (6) and (7). The
    arguments are the drive voltage and the sine of the phase of the drive."""
    first = (0.5 * volts_pp - 0.5 * volts_pp * sine) / PLATE
    second = (0.5 * volts_pp + 0.5 * volts_pp * sine) / PLATE
    turned_1 = 1.0 / (1.0 + exp(10e-6 * (0.4e6 - first)))
    turned_2 = 1.0 / (1.0 + exp(10e-6 * (0.4e6 - second)))
    force_1 = PER_STRESS * first * (14.0 + (29.0 - 29.0 * 69e-9 * first - 14.0) * turned_1)
    force_2 = PER_STRESS * second * (14.0 + (29.0 - 29.0 * 69e-9 * second - 14.0) * turned_2)
    return force_1 - force_2, force_1 + force_2


def rates(
    omega: float, difference: float, total: float, x: float, v: float, psi: float, w: float
) -> tuple[float, float, float, float]:
    """Return the right-hand side, Eqs. (1) and (2), from the drive's angular frequency (rad/s), the result of `push`,
    and the states."""
    tip, speed = TIP_SCALE * x, TIP_SCALE * omega * v
    pitch, turn = PITCH_SCALE * psi, PITCH_SCALE * omega * w
    sine, cosine = math.sin(pitch), math.cos(pitch)
    sin_2, cos_2 = 2.0 * sine * cosine, 2.0 * cosine * cosine - 1.0
    flow = speed * abs(speed)
    drag = DRAG_MEAN + DRAG_SWING * cos_2

    stiffening = math.log(1.0 + SIGMA * (math.exp(STIFFENING * abs(tip)) - 1.0))
    elastic = (SOFT + SPRING) * tip + math.copysign(HARD * stiffening, tip)
    force = difference - FORCE_SLOPE * tip * total
    a = (force - elastic - TIP_DRAG * drag * flow) * (1.0 / MASS)

    arm = ARM_LEAST + ARM_SWING * abs(1.0 - abs(pitch) * (2.0 / math.pi))
    air = MOMENT * arm * (drag * cosine + LIFT * sin_2 * sine) * flow
    swing = PRODUCT * TRANSMISSION * a * cosine + 0.5 * INERTIA * TRANSMISSION**2 * speed * speed * sin_2
    spring = HINGE * pitch + HINGE_DRAG * turn * abs(turn)
    alpha = (air + swing - spring) * (1.0 / INERTIA)
    square = omega * omega
    return v, a / (TIP_SCALE * square), w, alpha / (PITCH_SCALE * square)
