"""Synthetic readings of the bimorph, with known parameters, for tests of fits."""

import flapwing
import numpy as np

PRESET = "jafferis2016"
TRUE = {"hinge_stiffness": 1.15, "wing_inertia_stroke": 0.93, "drag_coefficient_max": 0.90}
TRUTH = {name: ratio * flapwing.params(PRESET)[name].value for name, ratio in TRUE.items()}
FREQUENCY, VOLTAGE = np.tile(np.linspace(70.0, 150.0, 15), 2), np.repeat([120.0, 160.0], 15)
POINTS = {"drive_frequency": FREQUENCY, "drive_voltage_pp": VOLTAGE}


def readings(measures=("stroke_pp_deg",), noise=0.03, seed=1, points=POINTS, **truth):
    table = flapwing.evaluate(PRESET, points, measures=list(measures), **{**TRUTH, **truth})
    draw = np.random.default_rng(seed)
    return {**points, **{name: table[name] * (1 + draw.normal(0.0, noise, len(table))) for name in measures}}
