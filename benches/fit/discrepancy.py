"""Coverage of the bands of `flapwing.fit` for new readings, with a correct model and with wrong models.

Readings of stroke and pitch at four voltages are simulated with the fitted model, and with terms that the fitted model
leaves out. Readings at one voltage are held out and predicted. The 95 % bands should contain 90 to 98 % of the held-out
readings, for the correct model and for wrong models.

    python benches/fit/discrepancy.py --seeds 3

The script requires SciPy: pip install scipy
"""

import argparse
import time
from typing import Any

import flapwing
import numpy as np

PRESET = "jafferis2016"
TRUE = {"hinge_stiffness": 1.15, "wing_inertia_stroke": 0.93, "drag_coefficient_max": 0.90}
MEASURES = ["stroke_pp_deg", "pitch_amplitude_deg"]
VOLTAGES = [110.0, 130.0, 150.0, 170.0]
NOISE = 0.02
#: Parameters of the synthetic robot that differ from the design of the fit.
LAWS: dict[str, dict[str, Any]] = {
    "right model": {},
    "drag_coefficient_min": {"drag_coefficient_min": 1.5},
    "hinge_damping": {"hinge_damping": "0.2 nN*m*s"},
    "transmission_growth": {"transmission_growth": "4.4 rad/mm^3"},
}


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--seeds", type=int, default=2)
    arguments = parser.parse_args()
    begun = time.perf_counter()
    frequency = np.tile(np.linspace(75.0, 145.0, 15), len(VOLTAGES))
    points = {"drive_frequency": frequency, "drive_voltage_pp": np.repeat(VOLTAGES, 15)}
    truth: dict[str, Any] = {name: ratio * float(flapwing.params(PRESET)[name].value) for name, ratio in TRUE.items()}
    for law, terms in LAWS.items():
        exact = flapwing.evaluate(PRESET, points, measures=MEASURES, **{**truth, **terms})
        covered, inside, poor, listed = [], [], 0, []
        for seed in range(arguments.seeds):
            for voltage in VOLTAGES[1:]:
                noise = 1 + np.random.default_rng(seed).normal(0.0, NOISE, (len(MEASURES), len(frequency)))
                data = {**points, **{name: exact[name] * noise[place] for place, name in enumerate(MEASURES)}}
                found = flapwing.fit(
                    PRESET, data, list(TRUE), sigma=f"{100 * NOISE} %", starts=1, profile=False, seed=seed,
                    hold_out={"drive_voltage_pp": (voltage - 1, voltage + 1)},
                )  # fmt: skip
                assert found.held_out is not None
                covered.append(found.held_out.covered)
                inside += [found.estimates[name].low <= truth[name] <= found.estimates[name].high for name in TRUE]
                poor += found.goodness.p < 0.001
                listed += [f"{one.size:.2g} {one.unit} of {one.measure}" for one in found.discrepancy[:2]]
        print(
            f"{law:22} {100 * np.mean(covered):5.1f} % of the readings held out in their bands "
            f"(fits: {100 * min(covered):.0f} to {100 * max(covered):.0f} %), "
            f"{100 * np.mean(inside):.0f} % of the true values in their intervals, {poor} of {len(covered)} fits poor"
        )
        if listed:
            print(" " * 23 + f"discrepancies of the first fit: {', '.join(listed[:2])}")
    print(f"{time.perf_counter() - begun:.0f} s")


if __name__ == "__main__":
    main()
