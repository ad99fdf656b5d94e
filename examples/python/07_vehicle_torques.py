"""Roll, pitch and yaw torques of a vehicle with two bimorph wings, for drives that produce one of these torques:

    pip install ./crates/flap-py
    python examples/python/07_vehicle_torques.py
    python examples/python/07_vehicle_torques.py --preset jafferis2016-improved

A difference of the amplitudes produces a roll torque, and a bias produces a pitch torque. A second harmonic with
opposite signs on the two wings (split cycle) produces a yaw torque. The body axes are x forward, y to the left, and z
up. Positive roll lifts the left side, positive pitch lowers the nose, and positive yaw turns the nose to the left.

K. Y. Ma, S. M. Felton and R. J. Wood, "Design, fabrication, and modeling of the split actuator microrobotic bee", IROS
2012.
"""

from __future__ import annotations

import argparse
from typing import Any

import flapwing
import numpy as np

TORQUES = ["torque_roll_unm", "torque_pitch_unm", "torque_yaw_unm"]
#: Share of the amplitude by which each drive is changed.
SHARE = 0.2


def vehicle(preset: str) -> flapwing.Vehicle:
    """Return a vehicle with two wings beside each other, above the centre of mass."""
    place = ["0 mm", "1.5 mm", "0 mm"]
    wings = [flapwing.Wing("left", position=place), flapwing.Wing("right", position=place, mirrored=True)]
    # A second harmonic of zero leaves the sine as it is.
    design = {"preset": preset, "params": {"drive_shape": "harmonics"}}
    return flapwing.Vehicle(design, wings, about=["0 mm", "0 mm", "-2 mm"], total_mass="85 mg")


def best_phase(robot: flapwing.Vehicle) -> float:
    """Return the phase (degrees) of the second harmonic at which the yaw torque is largest."""
    degrees = np.arange(0.0, 360.0, 15.0)
    columns = {"drive_second_phase": np.radians(degrees)}
    rows = flapwing.evaluate(robot, columns, difference_drive_second_harmonic=2 * SHARE, measures=TORQUES)
    return float(degrees[np.nanargmax(rows["torque_yaw_unm"])])


def drives(preset: str, phase: float) -> dict[str, dict[str, Any]]:
    """Return a dictionary with the parameters of each drive. The keys are the names of the drives."""
    volts = flapwing.params(preset)["drive_voltage_pp"].value
    assert isinstance(volts, float)
    split = {"drive_second_phase": float(np.radians(phase))}
    return {
        "sine": {},
        "more on the left": {"difference_drive_voltage_pp": 2 * SHARE * volts},
        "more on the right": {"difference_drive_voltage_pp": -2 * SHARE * volts},
        "bias forward": {"drive_offset": SHARE * volts / 2},
        "bias backward": {"drive_offset": -SHARE * volts / 2},
        f"split cycle, {phase:.0f} deg": {"difference_drive_second_harmonic": 2 * SHARE, **split},
        "split cycle, swapped": {"difference_drive_second_harmonic": -2 * SHARE, **split},
    }


def main() -> None:
    """Print a table with the torques of each drive."""
    parser = argparse.ArgumentParser(description="Prints the torques of a vehicle of two wings for several drives.")
    parser.add_argument("--preset", default="jafferis2016", help="design of the wings (default: %(default)s)")
    preset = parser.parse_args().preset

    robot = vehicle(preset)
    print(f"{'DRIVE':<22}{'ROLL':>8}{'PITCH':>8}{'YAW':>8}  uN*m   LIFT/WEIGHT")
    for name, parameters in drives(preset, best_phase(robot)).items():
        row = flapwing.run(robot, **parameters)
        cells = "".join(f"{row[torque] + 0.0:8.3f}".replace("-0.000", " 0.000") for torque in TORQUES)
        print(f"{name:<22}{cells}         {row['lift_to_weight']:.2f}")


if __name__ == "__main__":
    main()
