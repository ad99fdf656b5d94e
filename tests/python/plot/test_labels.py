"""Labels and readable units."""

import flapwing
import numpy as np
import pytest
from flapwing import _labels, plot


@pytest.mark.parametrize(
    ("name", "unit", "expected"),
    [
        ("lift_mean_mn", None, "Lift, mean (mN)"),
        ("stroke_pp_deg", None, "Stroke, peak to peak (°)"),
        ("stroke_pp_deg_per_v", None, "Stroke, peak to peak (°/V)"),
        ("efficiency_gf_per_w", None, "Efficiency (gf/W)"),
        ("efficiency_capacitive_gf_per_w", None, "Capacitive efficiency (gf/W)"),
        ("power_translational_mean_mw", None, "Translational power, mean (mW)"),
        ("lift_added_mass_mean_mn", None, "Added mass lift, mean (mN)"),
        ("current_1_rms_ma", None, "Current 1, rms (mA)"),
        ("field_max_v_per_um", None, "Field, largest (V/µm)"),
        ("mode_1_hz", None, "Mode 1 (Hz)"),
        ("energy_audit", None, "Energy audit"),
        ("drive_voltage_pp", "V", "Drive voltage, peak to peak (V)"),
        ("hinge_stiffness", "N*m/rad", "Hinge stiffness (N·m/rad)"),
        ("air_density", "kg/m^3", "Air density (kg/m³)"),
        ("drag_coefficient_max", "", "Drag coefficient, largest"),
        ("force_factor", "", "Force factor"),
        ("lift_slope", "", "Lift slope"),
        ("strain_surface_max", "", "Surface strain, largest"),
    ],
)
def test_labels(name, unit, expected):
    assert plot.label(name, unit) == expected


def test_every_column_of_every_model_has_a_label_without_underscores():
    for preset in flapwing.presets():
        for name, measure in flapwing.measures(preset).items():
            unit = measure.unit
            text = plot.label(name, unit)
            assert "_" not in text and text[0].isupper()
            assert (f"({unit.replace('deg', '°').replace('um', 'µm')})" in text) == bool(unit), text
        for name, parameter in flapwing.params(preset).items():
            assert "_" not in plot.label(name, parameter.unit)


@pytest.mark.parametrize(
    ("value", "unit", "shown"),
    [
        (8.64e-5, "N*m/rad", (86.4, "µN·m/rad")),
        (1.4972e-6, "N*m/rad", (1.4972, "µN·m/rad")),
        (0.0324, "m", (32.4, "mm")),
        (5.459e-5, "m^2", (54.59, "mm²")),
        (5.11e-11, "kg*m^2", (51.1, "mg·mm²")),
        (8e-5, "kg", (80.0, "mg")),
        (6.2e10, "Pa", (62.0, "GPa")),
        (3.2e-10, "m/V", (320.0, "pm/V")),
        (197.7, "N/m", (197.7, "N/m")),
        (1.2, "kg/m^3", (1.2, "kg/m³")),
        (120.0, "Hz", (120.0, "Hz")),
        (np.pi / 6, "rad", (30.0, "°")),
        (0.0, "m", (0.0, "m")),
        (0.5, "", (0.5, "")),
        (4.2, "mN", (4.2, "mN")),
        (1e-3, "mW", (1e-3, "mW")),
    ],
)
def test_si_values_are_shown_in_readable_units(value, unit, shown):
    factor, text = _labels.readable([value], unit)
    assert text == shown[1]
    assert value * factor == pytest.approx(shown[0], rel=1e-12)
