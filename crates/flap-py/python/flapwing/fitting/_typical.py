"""Default bounds of the parameters of terms that the papers leave out, computed from typical sizes of the terms."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

#: Bounds of the terms that the papers leave out, and of a number with wide bounds, as multiples of a typical size of
#: the design; see `_sizes`.
_BOUNDS = {
    "drag_coefficient_min": (0.05, 2.0, "one"),
    "stroke_damping": (0.0, 1.0, "stroke damping"),
    "stroke_loss_factor": (0.0, 0.5, "one"),
    "hinge_damping": (0.0, 0.5, "hinge damping"),
    "hinge_loss_factor": (0.0, 0.5, "one"),
    "transmission_growth": (-0.25, 0.5, "transmission"),
    "stroke_stiffening": (-0.2, 1.0, "stroke stiffness"),
    "hinge_stiffening": (-0.2, 1.0, "hinge stiffness"),
    "hinge_stop_stiffness": (0.0, 10.0, "hinge stiffness"),
    "modulus_decline": (0.0, 0.5, "per field"),
    "circulation_factor": (0.0, 2.0, "one"),
    "rotation_force_factor": (0.0, 2.0, "one"),
    "added_mass_factor": (0.0, 2.0, "one"),
    "plate_ratio": (0.5, 1.5, "one"),
    "pressure_term_0": (-0.2, 0.2, "one"),
    "pressure_term_1": (-0.2, 0.2, "one"),
    "lift_term_1": (-1.0, 1.0, "one"),
    "lift_term_2": (-1.0, 1.0, "one"),
    "drag_term_0": (-1.0, 1.0, "one"),
    "drag_term_1": (-1.0, 1.0, "one"),
}


def _sizes(values: Mapping[str, Any]) -> dict[str, float]:
    """Return typical sizes of the terms of a design's equations of motion, in SI units. A size is nan if the design has
    no value of a parameter from which the size is computed.
    """

    def of(name: str) -> float:
        value = values.get(name)
        return float(value) if isinstance(value, (int, float)) and value > 0 else np.nan

    rate = 2.0 * np.pi * of("drive_frequency")
    inertia = of("wing_inertia_stroke" if "wing_inertia_stroke" in values else "leading_edge_inertia")
    return {
        "one": 1.0,
        "stroke damping": inertia * rate,
        "stroke stiffness": inertia * rate**2,
        "hinge damping": of("hinge_stiffness") / rate,
        "hinge stiffness": of("hinge_stiffness"),
        "transmission": of("transmission_ratio") ** 3,
        "per field": 2.0 * of("piezo_thickness") / of("drive_voltage_pp"),
    }


def typical_bounds(values: Mapping[str, Any]) -> dict[str, tuple[float, float]]:
    """Return bounds in SI units for the parameters of terms that the papers leave out. `values` contains the parameters
    of the design.

    The bounds do not depend on the design's values of the bounded parameters, because these values are zero in most
    designs.
    """
    sizes = _sizes(values)
    found = {name: (low * sizes[size], high * sizes[size]) for name, (low, high, size) in _BOUNDS.items()}
    return {name: bounds for name, bounds in found.items() if name in values and np.isfinite(bounds[1])}
