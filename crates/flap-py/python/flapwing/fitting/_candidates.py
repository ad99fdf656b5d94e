"""Parameters that `select` can fit: uncertain parameters, and terms that the equations in the papers leave out."""

from __future__ import annotations

from typing import Any, TypeGuard

from .. import _flapwing
from .._flapwing import Grid
from .._types import Design
from ._parameters import FreeParameter
from ._typical import typical_bounds

#: Parameters that are uncertain in most robots. The presets of `bimorph` contain values of some of these parameters
#: that were fitted to one vehicle.
_UNCERTAIN = (
    "hinge_stiffness",
    "transmission_stiffness",
    "wing_inertia_stroke",
    "wing_inertia_hinge",
    "wing_inertia_product",
    "drag_coefficient_max",
    "drag_coefficient_min",
    "lift_coefficient_max",
    "pressure_radius",
    "pressure_min",
    "pressure_max",
    "rotation_pressure_width",
    "force_factor",
    "stiffness_factor",
    "deflection_factor",
)

#: Terms that readings of stroke and pitch can hardly distinguish from other candidates.
_OF_FORCES = ("lift_term_1", "lift_term_2", "drag_term_0", "drag_term_1")


def candidates(design: Design, /) -> dict[str, FreeParameter]:
    """Return parameters that `select` can fit: uncertain parameters of a design, and terms that the equations in the
    papers leave out.

    The uncertain parameters have the default bounds of `fit`: a third of the design's value, and three times the
    design's value. The parameters in the list below have the bounds in the list instead of the default bounds. In the
    list, ω is the angular drive frequency, and J is the wing's inertia about the stroke axis. In the list, E is half of
    `drive_voltage_pp`, divided by the thickness of a piezoelectric plate. A parameter in the list has the default
    bounds if the design's value is outside of the bounds in the list. A parameter whose lower bound in the list is 0
    also has the default bounds if the design's value is not zero.

    - `drag_coefficient_min`: 0.05 to 2
    - `stroke_damping`: 0 to J ω
    - `stroke_loss_factor`, `hinge_loss_factor`: 0 to 0.5
    - `hinge_damping`: 0 to 0.5 times `hinge_stiffness` / ω
    - `transmission_growth`: -0.25 to 0.5 times the cube of `transmission_ratio`
    - `stroke_stiffening`: -0.2 J ω² to J ω²
    - `hinge_stiffening`: -0.2 to 1 times `hinge_stiffness`
    - `hinge_stop_stiffness`: 0 to 10 times `hinge_stiffness`
    - `modulus_decline`: 0 to 0.5 / E
    - `circulation_factor`, `rotation_force_factor`, `added_mass_factor`: 0 to 2
    - `plate_ratio`: 0.5 to 1.5
    - `pressure_term_0`, `pressure_term_1`: -0.2 to 0.2

    The result does not contain `lift_term_1`, `lift_term_2`, `drag_term_0` and `drag_term_1`. Readings of stroke and
    pitch can hardly distinguish the lift and drag terms from other parameters of the result. If your data contain
    readings of lift, add the lift and drag terms to the returned dictionary. The default bounds of the lift and drag
    terms are -1 and 1.

    Parameters
    ----------
    design : str, path, dict or Grid
        A preset, a device, or a grid without axes.

    Returns
    -------
    dict of str to FreeParameter
        The parameters that `select` can fit, with bounds in SI units. You can remove or add entries before you pass the
        dictionary to `select`.

    Raises
    ------
    ValueError
        Raised if the design is unknown.

    Examples
    --------
    >>> candidates = flapwing.candidates("jafferis2016")
    >>> candidates["hinge_loss_factor"].high
    0.5
    >>> terms = ["lift_term_1", "lift_term_2", "drag_term_0", "drag_term_1"]  # for data with lift
    >>> candidates |= dict.fromkeys(terms, flapwing.FreeParameter())
    """
    grid = Grid(design)
    listed = {one["name"]: one["value"] for one in _flapwing.params(grid)}
    found = {name: FreeParameter() for name in _UNCERTAIN if is_number(listed.get(name)) and listed[name] != 0}
    for name, (low, high) in typical_bounds(listed).items():
        value = listed[name]
        if is_number(value) and name not in _OF_FORCES:
            # A term that the design sets gets the default bounds of `fit`, around its value.
            is_set = low == 0.0 and value != 0.0
            found[name] = FreeParameter() if is_set or not low <= value <= high else FreeParameter(low, high)
    return found


def is_number(value: Any) -> TypeGuard[float]:
    """Return True if a value is a number, and False for a bool and for values of other types."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)
