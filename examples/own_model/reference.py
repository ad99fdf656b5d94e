"""Reference motions of the motor-driven wing, computed by SciPy. The equations are written independently of the Rust
code.

    python examples/own_model/reference.py > tests/data/motor_wing.csv

Each point is described by the columns voltage (V), frequency (Hz), wing length (m) and spring stiffness (N m/rad). If
the stiffness is computed from the frequency, the cell of the stiffness is empty. Each point is
simulated for 100 drive periods, and the measures are computed over the last period. The first two measures are the
largest flap angle (deg) and the mean lift (mN). The next two measures are the mean and the mean magnitude of the
electrical power (mW). The last two measures are the mean power that the air absorbs (mW) and the root mean square of
the current (mA).
"""

import csv
import sys

import numpy as np
from scipy.integrate import quad, solve_ivp

RESISTANCE, INDUCTANCE, TORQUE, BACK_EMF = 9.0, 29e-3, 0.010, 0.010
ROTOR, BEARING = 1.5e-7, 3.6e-6
BASE, SECTION, WIDTH, HEIGHT = 10e-3, 1e-6, 5e-3, 1e-3
CARBON, MEMBRANE, THICKNESS, AIR, SLOPE = 1900.0, 1100.0, 25e-6, 1.225, 5e-3

POINTS = [
    (5.0, 23.89, 68.46e-3, None),
    (3.0, 35.67, 60.49e-3, None),
    (5.0, 20.0, 68.46e-3, 0.011),
    (5.0, 28.0, 68.46e-3, 0.011),
    (8.0, 24.0, 68.46e-3, 0.011),
    (1.0, 40.0, 50e-3, None),
    (2.0, 30.0, 40e-3, 0.02),
]


def integral(function):
    return quad(function, 0.0, 1.0, epsabs=0.0, epsrel=1e-12)[0]


def measures(voltage, frequency, length, stiffness):
    root, chord = BASE / 2, length / 3

    def radius(x):
        return root + length * x

    def c(x):
        return chord * np.sqrt(1 - x * x)

    r2c = length * integral(lambda x: radius(x) ** 2 * c(x))
    r3c = length * integral(lambda x: radius(x) ** 3 * c(x))
    i2, i3 = 0.5 * AIR * r2c, 0.5 * AIR * r3c
    i4 = 5 * 0.5 * AIR * length * integral(lambda x: c(x) ** 4) / 8
    added = np.pi / 4 * AIR * length * integral(lambda x: (c(x) * radius(x)) ** 2)
    wing = (
        CARBON * WIDTH * HEIGHT * BASE**3 / 3
        + CARBON * SECTION * length * (length + root) ** 2 / 3
        + CARBON * SECTION * chord * root**2 / 3
        + MEMBRANE * THICKNESS * np.pi / 4 * chord * length * (r3c / r2c) ** 2
    )
    inertia = ROTOR + wing + added
    omega = 2 * np.pi * frequency
    spring = inertia * omega**2 if stiffness is None else stiffness

    def air(rate):
        attack = np.maximum(np.pi / 4, np.pi / 2 - SLOPE * np.abs(rate))
        lift = 0.225 + 1.58 * np.sin(2.13 * attack - 0.1257)
        drag = 1.92 - 1.55 * np.cos(2.04 * attack - 0.1714)
        return i2 * lift * rate**2, (i3 * drag + i4) * rate * np.abs(rate)

    def slope(t, y):
        flap, rate, current = y
        torque = TORQUE * current - BEARING * rate - spring * flap - air(rate)[1]
        return (
            rate,
            torque / inertia,
            (voltage * np.sin(omega * t) - RESISTANCE * current - BACK_EMF * rate) / INDUCTANCE,
        )

    period = 1 / frequency
    run = solve_ivp(
        slope, (0, 100 * period), (0, 0, 0), "DOP853", rtol=1e-12, atol=1e-14, max_step=period / 100, dense_output=True
    )
    t = np.linspace(99 * period, 100 * period, 40_001)
    flap, rate, current = run.sol(t)
    power = voltage * np.sin(omega * t) * current
    lift, torque = air(rate)
    return (
        np.degrees(np.abs(flap).max()),
        1e3 * lift[:-1].mean(),
        1e3 * power[:-1].mean(),
        1e3 * np.abs(power)[:-1].mean(),
        1e3 * (torque * rate)[:-1].mean(),
        1e3 * np.sqrt((current**2)[:-1].mean()),
    )


out = csv.writer(sys.stdout, lineterminator="\n")
out.writerow(
    (
        "voltage frequency length stiffness stroke_max_deg lift_mean_mn power_mean_mw "
        "power_magnitude_mw power_air_mean_mw current_rms_ma"
    ).split()
)
for point in POINTS:
    given = ["" if value is None else value for value in point]
    out.writerow(given + [f"{value:.9g}" for value in measures(*point)])
