"""The mean forces and torques of a vehicle with two wings, at 4,096 combinations of the drive inputs:

    pip install ./crates/flap-py
    python examples/python/08_wrench_map.py                 # 4 inputs, 8 levels each
    python examples/python/08_wrench_map.py --size small    # 4 levels each
    python examples/python/08_wrench_map.py --out map.csv

The inputs are the amplitude of both wings, the difference of the amplitudes, the bias, and the second harmonic. The
second harmonic has opposite signs on the two wings. The script template/sdab_num_wrenchmap.py of robobee3d
(https://github.com/avikde/robobee3d) varies the four inputs of this example, but simulates the combinations one at a
time."""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import flapwing
import numpy as np

FORCES = ["force_forward_mn", "force_left_mn", "force_up_mn"]
TORQUES = ["torque_roll_unm", "torque_pitch_unm", "torque_yaw_unm"]
#: The ends of each input.
INPUTS = {
    "drive_voltage_pp": (160.0, 220.0),
    "difference_drive_voltage_pp": (-40.0, 40.0),
    "drive_offset": (-20.0, 20.0),
    "difference_drive_second_harmonic": (-0.3, 0.3),
}
LEVELS = {"small": 4, "full": 8}


def vehicle() -> flapwing.Vehicle:
    """Return a vehicle with two wings of `jafferis2016`. The phase of the second harmonic is the phase with the largest
    yaw torque."""
    place = ["0 mm", "1.5 mm", "0 mm"]
    wings = [flapwing.Wing("left", position=place), flapwing.Wing("right", position=place, mirrored=True)]
    drive = {"drive_shape": "harmonics", "drive_second_phase": "315 deg"}
    return flapwing.Vehicle({"preset": "jafferis2016", "params": drive}, wings, about=["0 mm", "0 mm", "-2 mm"])


def grid(levels: int) -> dict[str, object]:
    """Return a grid of the vehicle with all combinations of the inputs."""
    return {**vehicle(), "axes": {name: np.linspace(*ends, levels) for name, ends in INPUTS.items()}}


def fitted(table: flapwing.Table) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Fit a quadratic map from inputs (-1 to 1) to lift and torques. Return the coefficients, the root mean square of
    the residuals, and the ranges of lift and torques."""
    there = table.periodic
    scaled = [(there[name] - np.mean(ends)) / np.ptp(ends) * 2 for name, ends in INPUTS.items()]
    terms = [np.ones(len(there)), *scaled]
    terms += [scaled[i] * scaled[j] for i in range(4) for j in range(i, 4)]
    outputs = np.column_stack([there[name] for name in ["force_up_mn", *TORQUES]])
    coefficients, *_ = np.linalg.lstsq(np.column_stack(terms), outputs, rcond=None)
    left_over = outputs - np.column_stack(terms) @ coefficients
    return coefficients, np.sqrt((left_over**2).mean(axis=0)), np.ptp(outputs, axis=0)


def main() -> None:
    """Compute the rows, fit a quadratic map, and print the linear part and the residuals of the map."""
    parser = argparse.ArgumentParser(description="Maps drives of a vehicle to forces and torques.")
    parser.add_argument("--size", choices=LEVELS, default="full", help="levels of each input (default: %(default)s)")
    parser.add_argument("--out", type=Path, help="write the rows to this file")
    arguments = parser.parse_args()

    begin = time.perf_counter()
    table = flapwing.sweep(grid(LEVELS[arguments.size]), measures=[*FORCES, *TORQUES], out=arguments.out)
    seconds = time.perf_counter() - begin
    print(f"{len(table)} combinations of 4 inputs in {seconds:.1f} s: {table.counts}")

    coefficients, errors, ranges = fitted(table)
    print("\nLinear part of a quadratic fit, over half the range of each input, and what the fit leaves over:\n")
    names = ["lift (mN)", "roll (uN*m)", "pitch (uN*m)", "yaw (uN*m)"]
    print(f"{'INPUT':<34}" + "".join(f"{name:>14}" for name in names))
    for name, row in zip(INPUTS, coefficients[1:5]):
        print(f"{name:<34}" + "".join(f"{round(value, 3) + 0.0:14.3f}" for value in row))
    print(f"{'left over (rms)':<34}" + "".join(f"{value:14.3f}" for value in errors))
    print(f"{'range':<34}" + "".join(f"{value:14.3f}" for value in ranges))


if __name__ == "__main__":
    main()
