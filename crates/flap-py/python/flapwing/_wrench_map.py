"""Quadratic maps of the mean force and torque of a vehicle over its inputs, for model-predictive controllers."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, SupportsIndex

import numpy as np

from . import _flapwing, _mistakes, _workers
from ._native import NativeWrenchMap
from ._progress import Progress, one_step, shown
from ._types import Array, Design, Executor, Places, Value

__all__ = ["WrenchMap", "wrench_map"]


@dataclass(frozen=True, eq=False)
class WrenchMap:
    """A quadratic map of the mean force and torque of a vehicle over its inputs; see `wrench_map`.

    With m inputs, each component has ``1 + m + m * (m + 1) / 2`` coefficients: 15 for four inputs. Terms of two inputs
    have the order ``1, s1, s2, s1*s1, s1*s2, s2*s2``, where s is an input scaled from -1 to 1 over its range.

    Attributes
    ----------
    inputs : list of str
        Names of the inputs, as keys of `ranges`.
    parameters : list of str
        The parameter of the vehicle for each input, such as ``"drive_voltage_pp"``.
    units : list of str
        SI unit of each input.
    start, stop : array of shape (inputs,)
        Smallest and largest value of each input (SI). The map is valid between these values.
    components : list of str
        Columns of force and torque: ``"force_forward_mn"`` to ``"torque_yaw_unm"``, in mN and µN·m.
    powers : array of int of shape (terms, inputs)
        Power of each input in each term.
    scaled : array of shape (6, terms)
        Coefficients for scaled inputs, in mN and µN·m.
    physical : array of shape (6, terms)
        Coefficients for inputs in SI units.
    r_squared : array of shape (6,)
        Coefficient of determination of each component on the rows that were left out of the fit; nan if the component
        is constant.
    largest_error : array of shape (6,)
        Largest error of each component on the rows that were left out of the fit, in mN and µN·m.
    rows : dict of str to int
        Number of rows in the fit (``"fitted"``), number of rows left out of the fit (``"left_out"``), and numbers of
        rows without a periodic motion by status.
    floquet_max : float
        Largest Floquet multiplier of all rows. If it is more than 0.7, the map is near a steep flank of the response.
    """

    inputs: list[str]
    parameters: list[str]
    units: list[str]
    start: Array
    stop: Array
    components: list[str]
    powers: Places
    scaled: Array
    physical: Array
    r_squared: Array
    largest_error: Array
    rows: dict[str, int]
    floquet_max: float

    def evaluate(self, inputs: Any, /) -> Array:
        """Return force (mN) and torque (µN·m) at values of the inputs.

        Parameters
        ----------
        inputs : array_like of shape (..., inputs)
            Values of the inputs in SI units, in the order of `inputs`. Beyond `start` and `stop`, the result is an
            extrapolation.

        Returns
        -------
        array of shape (..., 6)
            Force and torque, in the order of `components`.

        Raises
        ------
        ValueError
            The last dimension is not the number of inputs.
        TypeError
            `inputs` are not numbers.
        """
        with _mistakes.reading("inputs", inputs, "it must be numbers in SI units, one for each input"):
            values = np.asarray(inputs, dtype=np.float64)
        if values.ndim == 0 or values.shape[-1] != len(self.inputs):
            count = f"{values.shape[-1]} values" if values.ndim else "one number"
            raise ValueError(
                f"`inputs` has {count}, not {len(self.inputs)}\nthe inputs of this map are {', '.join(self.inputs)}"
            )
        scaled = (2.0 * values - (self.start + self.stop)) / (self.stop - self.start)
        terms = np.prod(scaled[..., np.newaxis, :] ** self.powers, axis=-1)
        wrench: Array = terms @ self.scaled.T
        return wrench

    __call__ = evaluate


def wrench_map(
    design: Design,
    /,
    *,
    ranges: Mapping[str, Sequence[Value]],
    samples: SupportsIndex = 400,
    point: SupportsIndex | None = None,
    threads: SupportsIndex | None = None,
    progress: Progress = False,
    client: Executor | None = None,
    **keywords: Value,
) -> WrenchMap:
    """Fit a quadratic map of the mean force and torque of a vehicle over ranges of its inputs.

    Model-predictive controllers use such maps. The map is the least-squares fit to rows of the vehicle that are spread
    over the ranges. Every fifth row is left out of the fit and tests the map.

    A poor map, rows without a periodic motion, a steep response, or an input without effect is a UserWarning.

    Parameters
    ----------
    design : Vehicle, str, path, dict or Grid
        A vehicle, or a grid with a vehicle.
    ranges : dict of str to pair of float or str
        Smallest and largest value of each input: numbers in SI units, or text with units. The inputs are parameters of
        the vehicle, or the words ``"amplitude"``, ``"bias"``, ``"frequency"``, ``"second_harmonic"``,
        ``"second_phase"`` and ``"third_harmonic"``. A word alone changes all wings. With ``_difference`` appended, a
        word is the value of left wings minus the value of right wings. After the name of a wing, as in
        ``"left_bias"``, a word changes this wing.
    samples : int, optional
        Number of rows. Default 400.
    point : int, optional
        The point of a grid with axes, counted from 0. Default: a grid of one point.
    threads : int, optional
        Number of threads, 1 or more. Default: one per core. The number of threads does not change the map.
    progress : bool or function, optional
        Show a bar (with tqdm, in consoles and notebooks), or call a function with the numbers of rows done and in all.
        With `client`, the whole map is one step.
    client : executor, optional
        Compute the map on a worker of an executor, as for `sweep`.
    **keywords : float or str
        Parameters of the vehicle and solver settings, as for `run`.

    Returns
    -------
    WrenchMap
        The coefficients of the map, and its error on the rows that were left out of the fit.

    Raises
    ------
    ValueError
        The design is no vehicle; an input or a unit is unknown; a range is empty or upside down; there are fewer
        samples or periodic rows than the coefficients need. A grid with mistakes raises GridError.
    TypeError
        An argument has the wrong type.

    Examples
    --------
    >>> place = ["0 mm", "2 mm", "0 mm"]
    >>> wings = [flapwing.Wing("left", position=place), flapwing.Wing("right", position=place, mirrored=True)]
    >>> vehicle = flapwing.Vehicle("jafferis2016", wings, about=["0 mm", "0 mm", "-3 mm"])
    >>> ranges = {"amplitude": ("190 V", "210 V"), "bias": ("-5 V", "5 V")}
    >>> ranges |= {"amplitude_difference": (-10.0, 10.0), "bias_difference": (-5.0, 5.0)}
    >>> quadratic = flapwing.wrench_map(vehicle, ranges=ranges, samples=200, drive_frequency="100 Hz")
    >>> force_and_torque = quadratic([200.0, 0.0, 5.0, 0.0])
    >>> print(f"{force_and_torque[3]:.2f}")
    0.39
    >>> print(min(quadratic.r_squared) > 0.99)
    True
    """
    if not isinstance(ranges, Mapping):
        raise _mistakes.refused("ranges", ranges, _RANGES)
    options: dict[str, Any] = {
        "point": point,
        "ranges": [_range(name, ends) for name, ends in ranges.items()],
        "samples": samples,
        "threads": threads,
    }
    found: NativeWrenchMap
    if client is None:
        with shown(progress) as show:
            found = _flapwing.wrench_map(design, dict(keywords), progress=show, **options)
    else:
        with one_step(progress):
            found = _workers.call(client, _flapwing.wrench_map, design, dict(keywords), **options)
    for text in found["warnings"]:
        warnings.warn(text, stacklevel=2)
    return WrenchMap(
        inputs=found["inputs"],
        parameters=found["parameters"],
        units=found["units"],
        start=np.array(found["start"]),
        stop=np.array(found["stop"]),
        components=found["components"],
        powers=np.array(found["powers"], dtype=np.intp),
        scaled=np.array(found["scaled"]),
        physical=np.array(found["physical"]),
        r_squared=np.array(found["r_squared"]),
        largest_error=np.array(found["largest_error"]),
        rows=found["rows"],
        floquet_max=found["floquet_max"],
    )


#: The form of ranges, for messages.
_RANGES = 'it must be a dictionary of pairs, such as {"bias": ("-20 V", "20 V")}'


def _range(name: Any, ends: Any) -> tuple[str, Any, Any]:
    """Return the name of an input, with its smallest and its largest value."""
    if not isinstance(name, str):
        raise _mistakes.refused("ranges", name, _RANGES)
    if isinstance(ends, (str, bytes, Mapping)):
        raise _mistakes.refused(f"ranges[{name!r}]", ends, 'it must be two values, such as ("-20 V", "20 V")')
    with _mistakes.reading(f"ranges[{name!r}]", ends, 'it must be two values, such as ("-20 V", "20 V")'):
        listed = list(ends)
    if len(listed) != 2:
        raise ValueError(f'`ranges[{name!r}]` has {len(listed)} values\nit must have two, such as ("-20 V", "20 V")')
    return name, listed[0], listed[1]
