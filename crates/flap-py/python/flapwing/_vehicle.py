"""Vehicles with one or more wings of one model, as entries of a grid."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from . import _arguments, _flapwing
from ._flapwing import Grid
from ._linear import LinearModel
from ._mistakes import refused
from ._types import Value

#: The axes of the body, and the angles of a stroke plane.
_AXES, _ANGLES = "x, y and z", ("roll", "pitch", "yaw")


class _Entries(Mapping[str, Any]):
    """Entries of a grid file, by key."""

    _entries: dict[str, Any]

    def __getitem__(self, key: str) -> Any:
        return self._entries[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)


class Wing(_Entries):
    """A wing of a `Vehicle`: the entries of a table ``[[vehicle.wings]]`` in a grid file.

    Parameters
    ----------
    name : str
        The name of the wing, which is the prefix of the wing's parameters and columns, as in ``left_drive_voltage_pp``
        and ``left_stroke_pp_deg``.
    position : sequence of three numbers or texts, optional
        The position of the wing's shoulder along x (forward), y (to the left) and z (up). The coordinates are numbers
        in metres, or text with units such as ``"4 mm"``. The default of `position` is zero.
    plane : dict, optional
        The angles `roll`, `pitch` and `yaw` of the stroke plane: numbers in radians, or text such as ``"10 deg"``.
    mirrored : bool, optional
        True for a wing on the right side of the vehicle. A mirrored wing is the mirror image of a wing at `position`,
        with the plane of x and z as the mirror.
    preset, device : str, path, optional
        The design of the wing, if this design differs from the vehicle's design: the name of a preset, or the path of a
        device file.
    params : dict, optional
        Parameters that apply only to the wing `name`.

    Raises
    ------
    TypeError
        Raised if an argument has the wrong type. All mistakes except wrong types are reported by `Vehicle`, with the
        place of each mistake.

    Examples
    --------
    >>> place = ["0 mm", "1.5 mm", "0 mm"]
    >>> wing = flapwing.Wing("right", position=place, mirrored=True, params={"hinge_stiffness": 1.4e-6})
    >>> wing["mirrored"], wing["position"]
    (True, ['0 mm', '1.5 mm', '0 mm'])
    """

    def __init__(
        self,
        name: str,
        *,
        position: Sequence[Value] | None = None,
        plane: Mapping[str, Value] | None = None,
        mirrored: bool = False,
        preset: str | None = None,
        device: str | os.PathLike[str] | None = None,
        params: Mapping[str, Value] | None = None,
    ) -> None:
        if not isinstance(name, str):
            raise refused("name", name, 'it must be the name of a wing, such as "left"')
        self._entries = {"name": name}
        if _arguments.flag("mirrored", mirrored):
            self._entries["mirrored"] = True
        if position is not None:
            self._entries["position"] = _vector("position", position)
        if plane is not None:
            self._entries["plane"] = _table("plane", plane, 'angles such as {"pitch": "10 deg"}', _ANGLES)
        if preset is not None:
            if not isinstance(preset, str):
                raise refused("preset", preset, "it must be the name of a preset")
            self._entries["preset"] = preset
        if device is not None:
            if not isinstance(device, (str, os.PathLike)):
                raise refused("device", device, "it must be the path of a device file")
            self._entries["device"] = os.fspath(device)
        if params is not None:
            self._entries["params"] = _table("params", params, 'parameters such as {"hinge_stiffness": 1.4e-6}')

    def __repr__(self) -> str:
        return f"flapwing.Wing({', '.join(f'{key}={value!r}' for key, value in self._entries.items())})"


class Vehicle(_Entries):
    """A vehicle with one or more wings of one model. Each mean force or torque of the vehicle is the sum over all
    wings.

    You can use a vehicle as the design in any call::

        vehicle = Vehicle("jafferis2016", [left, right], about=["0 mm", "0 mm", "-2 mm"])
        run(vehicle, drive_offset="10 V")["torque_pitch_unm"]
        evaluate(vehicle, {"difference_drive_voltage_pp": [-20.0, 0.0, 20.0]})
        sweep({**vehicle, "axes": {"left_drive_voltage_pp": ["180 V", "200 V"]}})

    A vehicle is a mapping with the entries of a grid file that has the table ``[vehicle]``. If you add tables such as
    ``axes`` to the mapping, the mapping is a grid. A parameter NAME of the model applies to all wings. The parameter
    ``left_NAME`` applies only to the wing with the name `left`. The parameter ``difference_NAME`` is the value of NAME
    for left wings minus the value of NAME for right wings. For wings that are not mirrored, half of ``difference_NAME``
    is added to NAME. For mirrored wings, half of ``difference_NAME`` is subtracted from NAME. The model leaves out
    aerodynamic interaction between wings. The body axes are x forward, y to the left, and z up.

    Parameters
    ----------
    design : str, path or dict
        The design of the wings: the name of a preset, the path of a device file, or entries of a grid, such as
        ``{"preset": "jafferis2016", "params": {"drive_voltage_pp": "180 V"}}``.
    wings : sequence of Wing or dict
        A list of one or more wings. Each wing is a `Wing`, or a dictionary with the entries of a `Wing`.
    about : sequence of three numbers or texts, optional
        The point about which torques are computed, such as the centre of mass: numbers in metres, or text with units.
        The default of `about` is the origin.
    total_mass : float or str, optional
        The mass of the whole vehicle, which determines the column `lift_to_weight`: a number in kilograms, or text such
        as ``"85 mg"``.
    trim : str, optional
        If `trim` is ``"hover"``, each design is computed at hover: flap searches for the inputs at which the lift
        equals the weight and all torques are zero. The rows of a trimmed vehicle also contain the values of the inputs
        at hover. The rows also have two columns about the fastest-growing mode of motion about hover: the growth rate
        and the period of this mode. `trim` requires `total_mass`.
    damping : bool
        If True, rows also have the 36 derivatives of mean force and torque with respect to the velocity and the angular
        rates of the body.

    Raises
    ------
    GridError
        Raised if the entries of the vehicle have mistakes. The error message lists each mistake with the place of the
        mistake, the allowed values and the most similar known name.
    ValueError
        Raised if `design` already has a vehicle.
    TypeError
        Raised if an argument has the wrong type.
    OSError
        Raised if a device file cannot be read.

    Examples
    --------
    >>> place = ["0 mm", "1.5 mm", "0 mm"]
    >>> wings = [flapwing.Wing("left", position=place), flapwing.Wing("right", position=place, mirrored=True)]
    >>> vehicle = flapwing.Vehicle("jafferis2016", wings, about=["0 mm", "0 mm", "-2 mm"], total_mass="85 mg")
    >>> vehicle
    <flapwing.Vehicle of jafferis2016: left, right (mirrored)>
    >>> row = flapwing.run(vehicle, difference_drive_voltage_pp="20 V")
    >>> row["torque_roll_unm"] > 0
    True
    """

    def __init__(
        self,
        design: str | os.PathLike[str] | Mapping[str, Any],
        wings: Iterable[Wing | Mapping[str, Any]],
        *,
        about: Sequence[Value] | None = None,
        total_mass: Value | None = None,
        trim: str | None = None,
        damping: bool = False,
    ) -> None:
        self._entries = _design(design)
        vehicle: dict[str, Any] = {}
        if about is not None:
            vehicle["about"] = _vector("about", about)
        if total_mass is not None:
            vehicle["total_mass"] = total_mass
        if trim is not None:
            vehicle["trim"] = trim
        if _arguments.flag("damping", damping):
            vehicle["damping"] = True
        vehicle["wings"] = [_wing(place, wing) for place, wing in enumerate(_listed(wings))]
        self._entries["vehicle"] = vehicle
        # This call reports mistakes with their place.
        self._preset = Grid(self._entries).preset

    def linear(
        self,
        *,
        inputs: Sequence[str] | None = None,
        point: int | None = None,
        trim: bool = False,
        positions: bool = False,
        **params: Value,
    ) -> LinearModel:
        """Compute the linear model of small motions about hover, and the eigenvalues of the model.

        The wings respond to the motion of the body, unless you give ``body_response="frozen"``. The argument `about` of
        `Vehicle` must be the centre of mass. The model requires `total_mass` and the parameters `body_inertia_roll`,
        `body_inertia_pitch` and `body_inertia_yaw`.

        Parameters
        ----------
        inputs : sequence of str, optional
            The inputs: parameters, or words such as ``"amplitude_difference"``. ``flap vehicle --help`` lists the words
            for inputs. The default of `inputs` is amplitude, bias, and the left-right differences of amplitude and
            bias.
        point : int, optional
            The index of a point, if the vehicle is a grid with several points.
        trim : bool
            If True, the vehicle is trimmed first: the inputs are changed until the lift equals the weight and all
            torques are zero.
        positions : bool
            If True, the states include the position.
        **params
            Values of parameters: numbers in SI units, or text with units.

        Returns
        -------
        LinearModel

        Raises
        ------
        ValueError
            Raised if a mass property is missing or impossible, an input is unknown or derived, or the motion of the
            wings is not periodic. Raised if `trim` is true, but no values of the inputs near the point make the vehicle
            hover.

        Examples
        --------
        >>> place = ["0 mm", "2 mm", "0 mm"]
        >>> wings = [flapwing.Wing("left", position=place), flapwing.Wing("right", position=place, mirrored=True)]
        >>> vehicle = flapwing.Vehicle("jafferis2016", wings, about=["0 mm", "0 mm", "-3 mm"], total_mass="69 mg")
        >>> inertia = {"body_inertia_roll": 1.5e-9, "body_inertia_pitch": 1.5e-9, "body_inertia_yaw": 0.5e-9}
        >>> model = vehicle.linear(drive_voltage_pp="140 V", drive_frequency="120 Hz", **inertia)
        >>> model.modes[0]
        'pitch and forward velocity (longitudinal oscillation)'
        """
        found = _flapwing.linear(
            self,
            dict(params),
            point=point,
            inputs=_arguments.name_list("inputs", inputs, "amplitude"),
            trim_to_hover=_arguments.flag("trim", trim),
            positions=_arguments.flag("positions", positions),
        )
        eigenvalues = found.pop("eigenvalues_real") + 1j * found.pop("eigenvalues_imag")
        return LinearModel(eigenvalues=eigenvalues, **found)

    def __repr__(self) -> str:
        wings = [
            f"{wing['name']} (mirrored)" if wing.get("mirrored") else str(wing["name"])
            for wing in self._entries["vehicle"]["wings"]
        ]
        return f"<flapwing.Vehicle of {self._preset}: {', '.join(wings)}>"


def _design(design: Any) -> dict[str, Any]:
    """Return the entries of a grid file for the design of the wings."""
    if isinstance(design, Mapping):
        if "vehicle" in design:
            raise ValueError("`design` already has a vehicle\nit must be the design of the wings, without a vehicle")
        return dict(design)
    if isinstance(design, str) and design in _flapwing.presets():
        return {"preset": design}
    if isinstance(design, os.PathLike) or (isinstance(design, str) and os.path.exists(design)):
        return {"device": os.fspath(design)}
    if isinstance(design, str):
        # An unknown name is reported as a mistake in a grid, and a missing path as a missing file.
        return {"device" if design.endswith(".toml") or os.path.basename(design) != design else "preset": design}
    allowed = "it must be the name of a preset, the path of a device file, or a dictionary of grid entries"
    raise refused("design", design, allowed)


def _listed(wings: Any) -> list[Any]:
    """Return the wings of a vehicle as a list."""
    if isinstance(wings, (str, bytes, Mapping)) or not isinstance(wings, Iterable):
        raise refused("wings", wings, "it must be a list of wings: flapwing.Wing, or dictionaries")
    listed = list(wings)
    if not listed:
        raise ValueError('`wings` is empty\na vehicle has at least one wing, such as flapwing.Wing("left")')
    return listed


def _wing(place: int, wing: Any) -> dict[str, Any]:
    """Return a wing as a dictionary of its entries in a grid file."""
    if not isinstance(wing, Mapping):
        raise refused(f"wings[{place}]", wing, "it must be a flapwing.Wing, or a dictionary of its entries")
    return dict(wing)


def _vector(name: str, given: Any) -> list[Any]:
    """Return a position as a list of three lengths along x, y and z."""
    allowed = f'it must be three lengths along {_AXES}, such as ["0 mm", "4 mm", "0 mm"]'
    if isinstance(given, (str, bytes, Mapping)) or not isinstance(given, Iterable):
        raise refused(name, given, allowed)
    listed = list(given)
    if len(listed) != 3:
        raise ValueError(f"`{name}` has {len(listed)} entries\n{allowed}")
    return listed


def _table(name: str, given: Any, example: str, keys: Sequence[str] | None = None) -> dict[str, Any]:
    """Return `given` as a dictionary. Raise ValueError if a key of the dictionary is not in `keys`."""
    if not isinstance(given, Mapping):
        raise refused(name, given, f"it must be a dictionary of {example}")
    for key in given:
        if keys is not None and key not in keys:
            raise ValueError(f"`{name}` has no entry {key!r}\nits entries are {', '.join(keys)}")
    return dict(given)
