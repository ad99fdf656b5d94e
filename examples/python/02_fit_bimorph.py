"""A fit of hinge stiffness, wing inertia and drag to a measured frequency response.

The data are a CSV file with the column `frequency_hz` and one or more measures such as `stroke_pp_deg`. If no file is
given, the script simulates the response of a bimorph with changed parameters, and adds noise. The script then compares
the fitted parameters with the parameters of the simulated bimorph.

    python 02_fit_bimorph.py measured.csv --voltage 160
    python 02_fit_bimorph.py

A frequency response does not determine all parameters. If the force, both stiffnesses, both inertias and the drag grow
by the same factor, the motion stays the same. The script therefore assumes that the force and the stiffness of the
transmission are known.

The script requires SciPy: pip install scipy
"""

import argparse
from typing import Any

import flapwing
import numpy as np

PRESET = "jafferis2016"
FITTED = ["hinge_stiffness", "wing_inertia_stroke", "drag_coefficient_max"]
# The true values of the data that the script makes, relative to the preset, and the noise of a reading.
TRUE_RATIOS = [1.15, 0.93, 0.90]
NOISE_DEG = 1.0


def synthetic(voltage: float) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return a response with noise, and the changed parameters of the simulated bimorph."""
    parameters = flapwing.params(PRESET)
    true: dict[str, Any] = {name: float(parameters[name].value) * ratio for name, ratio in zip(FITTED, TRUE_RATIOS)}
    frequency = np.linspace(70.0, 150.0, 21)
    stroke = flapwing.evaluate(PRESET, {"drive_frequency": frequency}, drive_voltage_pp=voltage, **true)[
        "stroke_pp_deg"
    ]
    noise = np.random.default_rng(1).normal(0.0, NOISE_DEG, len(frequency))
    return {"frequency_hz": frequency, "stroke_pp_deg": stroke + noise}, true


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("data", nargs="?", metavar="CSV", help="measured response; without it, the script makes one")
    parser.add_argument("--voltage", type=float, default=160.0, help="drive voltage, peak to peak (V)")
    arguments = parser.parse_args()

    true = None
    data: Any = arguments.data
    if data is None:
        data, true = synthetic(arguments.voltage)
    found = flapwing.fit(PRESET, data, FITTED, drive_voltage_pp=arguments.voltage)
    print(found)
    if true:
        print("\nparameter             estimate     true")
        for name, estimate in found.estimates.items():
            print(f"{name:20}  {estimate.value:<11.5g}  {true[name]:.5g}")


if __name__ == "__main__":
    main()
