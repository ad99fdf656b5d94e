"""Tolerances of a build: linear propagation with exact derivatives, compared with 2,048 sampled builds.

Six parameters of the bimorph of Jafferis et al. vary by 1 % and by 5 % (standard deviations). The linear standard
deviation of a measure is sqrt(sum of (derivative * deviation)^2), computed from one row with derivatives. The sampled
standard deviation is computed from the rows of all builds. The linear and the sampled standard deviation agree if the
measure is nearly linear over the deviations of the parameters. Near a peak, the two standard deviations differ, because
the derivatives are small but every deviation lowers the measure. On the flank of a resonance, the two standard
deviations differ, because some builds lose most of the lift.

    python 03_tolerance_linear.py
    python 03_tolerance_linear.py --deviation 0.02 --builds 4096

The script requires only flapwing.
"""

import argparse
from typing import Any

import flapwing
import numpy as np

PRESET = "jafferis2016"
VARIED = [
    "hinge_stiffness",
    "transmission_ratio",
    "transmission_stiffness",
    "piezo_thickness",
    "wing_inertia_stroke",
    "drive_voltage_pp",
]
MEASURES = ["lift_mean_mn", "stroke_pp_deg", "pitch_amplitude_deg", "power_mean_mw"]
# On the slope of the response, at the peak of small voltages, and near the largest stroke at 200 V.
FREQUENCIES = [95.0, 105.0, 120.0]
# Linear and sampled deviations part where they differ by more than this share.
PART = 0.1


def linear(frequency: float, deviation: float) -> Any:
    """Return the relative standard deviations of the measures, computed from one row with derivatives."""
    row = flapwing.evaluate(PRESET, {"drive_frequency": [frequency]}, measures=MEASURES, gradient=VARIED)
    values = flapwing.Grid({"preset": PRESET})[0]
    deviations = deviation * np.array([float(values[name]) for name in VARIED])
    spread = np.sqrt(((row.gradient[0] * deviations) ** 2).sum(axis=1))
    return spread / np.array([row[name][0] for name in MEASURES])


def sampled(frequency: float, deviation: float, builds: int) -> Any:
    """Return the relative standard deviations of the measures from sampled builds, and the share of builds without a
    periodic motion."""
    table = flapwing.sweep(
        {
            "preset": PRESET,
            "params": {"drive_frequency": frequency},
            "sample": {
                "method": "sobol",
                "n": builds,
                "parameters": {name: {"relative_sd": deviation} for name in VARIED},
            },
        },
        measures=MEASURES,
    )
    periodic = table[table["status"] == "periodic"]
    spread = np.array([periodic[name].std() / periodic[name].mean() for name in MEASURES])
    return spread, 1 - len(periodic) / len(table)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "--deviation",
        type=float,
        nargs="+",
        default=[0.01, 0.05],
        help="relative standard deviations of each parameter",
    )
    parser.add_argument("--builds", type=int, default=2048, help="number of sampled builds")
    arguments = parser.parse_args()
    for deviation in arguments.deviation:
        print(f"relative standard deviations for deviations of {deviation:.1%}")
        print(f"{'':11}{'':22}{'linear':>10}{'sampled':>10}{'ratio':>8}")
        for frequency in FREQUENCIES:
            by_slope = linear(frequency, deviation)
            by_sample, lost = sampled(frequency, deviation, arguments.builds)
            for name, one, other in zip(MEASURES, by_slope, by_sample):
                apart = "" if abs(one / other - 1) < PART else "  they part"
                print(f"{frequency:6.0f} Hz  {name:22}{one:10.2%}{other:10.2%}{one / other:8.2f}{apart}")
            if lost:
                print(f"           {lost:.1%} of the builds do not settle")


if __name__ == "__main__":
    main()
