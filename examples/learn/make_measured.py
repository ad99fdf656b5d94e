"""Makes measured.csv: synthetic readings of the tutorial's robot, which replace an experiment.

    python examples/learn/make_measured.py measured.csv

The simulated robot has the parameters of robot.toml, except for the values in `BUILT`. The readings are the
peak-to-peak stroke and the pitch amplitude of the settled motion. Normally distributed noise is added to the readings.
"""

import sys
from pathlib import Path
from typing import Any

import flapwing
import numpy as np

ROBOT = Path(__file__).with_name("robot.toml")
BUILT: dict[str, Any] = {
    "hinge_stiffness": "1.08 uN*m/rad",
    "rotation_pressure_width": "2.2 mm",
    "drag_coefficient_max": 3.7,
}
FREQUENCIES_HZ = np.arange(80.0, 131.0, 5.0)
VOLTAGES = [120.0, 160.0]
NOISE_DEG = 1.0
SEED = 1


def readings() -> str:
    """Return the contents of the file measured.csv as text."""
    voltage, frequency = np.repeat(VOLTAGES, len(FREQUENCIES_HZ)), np.tile(FREQUENCIES_HZ, len(VOLTAGES))
    points = {"drive_voltage_pp": voltage, "drive_frequency": frequency}
    rows = flapwing.evaluate(str(ROBOT), points, **BUILT)
    noise = np.random.default_rng(SEED).normal(0.0, NOISE_DEG, (2, len(frequency)))
    stroke, pitch = rows["stroke_pp_deg"] + noise[0], rows["pitch_amplitude_deg"] + noise[1]
    lines = ["drive_voltage_pp,frequency_hz,stroke_pp_deg,pitch_amplitude_deg"]
    for cells in zip(voltage, frequency, stroke, pitch):
        lines.append("{:.0f},{:.0f},{:.1f},{:.1f}".format(*cells))
    return "# Synthetic readings, made by make_measured.py\n" + "\n".join(lines) + "\n"


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(readings(), encoding="utf-8")
