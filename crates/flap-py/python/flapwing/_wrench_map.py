"""Quadratic maps from the inputs of a vehicle to the vehicle's mean force and mean torque, for model-predictive
controllers."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, SupportsIndex

import numpy as np

from . import _flapwing, _mistakes, _workers
from ._progress import Progress, one_step, shown
from ._types import Array, Design, Executor, Places, Value


@dataclass(frozen=True, eq=False)
class WrenchMap:
    """A quadratic map from the inputs of a vehicle to the vehicle's mean force and mean torque. `wrench_map` returns a
    `WrenchMap`.

    With m inputs, each force or torque has ``1 + m + m * (m + 1) / 2`` coefficients: 15 for four inputs. With two
    inputs, the order of the terms is ``1, s1, s2, s1*s1, s1*s2, s2*s2``. In these terms, s1 and s2 are the inputs,
    scaled from -1 to 1 over the range of each input.

    Attributes
    ----------
    inputs : list of str
        Names of the inputs, as keys of `ranges`.
    parameters : list of str
        The parameter of the vehicle for each input, such as ``"drive_voltage_pp"``.
    units : list of str
        SI unit of each input.
    start, stop : array of shape (inputs,)
        Smallest and largest value of each input (SI). The map is valid for inputs between the smallest and the largest
        value.
    components : list of str
        Columns of force and torque: ``"force_forward_mn"`` to ``"torque_yaw_unm"``, in mN and µN·m.
    powers : array of int of shape (terms, inputs)
        Exponent of each input in each term of the map.
    scaled : array of shape (6, terms)
        Coefficients of the map for inputs scaled from -1 to 1, in mN and µN·m.
    physical : array of shape (6, terms)
        Coefficients of the map for inputs in SI units.
    r_squared : array of shape (6,)
        Coefficient of determination (R²) of each component on the rows that were left out of the fit. R² is nan if a
        component is constant.
    largest_error : array of shape (6,)
        Largest error of each component on the rows that were left out of the fit, in mN and µN·m.
    rows : dict of str to int
        Number of rows in the fit (``"fitted"``), and number of rows that were left out of the fit (``"left_out"``). All
        other keys are statuses of rows without a periodic motion, each with the number of rows.
    floquet_max : float
        Largest Floquet multiplier of all rows. If the largest multiplier is more than 0.7, the ranges of the inputs are
        near a steep part of the response.
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
            Values of the inputs in SI units, in the order of `inputs`. For values outside of the ranges from `start` to
            `stop`, the result is an extrapolation.

        Returns
        -------
        array of shape (..., 6)
            Force and torque, in the order of `components`.

        Raises
        ------
        ValueError
            Raised if the last dimension is not the number of inputs.
        TypeError
            Raised if `inputs` contains values that are not numbers.
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
    """Fit a quadratic map from the inputs of a vehicle to the vehicle's mean force and mean torque.

    Model-predictive controllers can use the map. The map is a least-squares fit to computed rows of the vehicle. The
    rows are spread over the ranges of the inputs. Every fifth row is left out of the fit, and these left-out rows test
    the accuracy of the map.

    A UserWarning reports a map with large errors, rows without a periodic motion, a steep response, or an input without
    effect.

    Parameters
    ----------
    design : Vehicle, str, path, dict or Grid
        A vehicle, or a grid with a vehicle.
    ranges : dict of str to pair of float or str
        Smallest and largest value of each input: numbers in SI units, or text with units. The inputs are parameters of
        the vehicle, or the words ``"amplitude"``, ``"bias"``, ``"frequency"``, ``"second_harmonic"``,
        ``"second_phase"`` and ``"third_harmonic"``. If the name of an input has no prefix, such as ``"bias"``, the
        input acts on all wings. The input ``"bias_difference"`` is the bias of left wings minus the bias of right
        wings. The input ``"left_bias"`` changes only the wing with the name `left`.
    samples : int, optional
        Number of rows to compute, at most a million. The default of `samples` is 400 rows.
    point : int, optional
        The index of a point, counted from 0, if the grid has several points.
    threads : int, optional
        Number of threads, 1 or more. The default of `threads` is one thread per core. The number of threads does not
        change the map.
    progress : bool or function, optional
        If True, a progress bar (tqdm) is shown in consoles and notebooks. A progress function is called with two
        numbers: the number of finished rows, and the number of all rows. With `client`, the progress advances only
        once, when the whole map is computed.
    client : executor, optional
        An executor, such as a process pool (see `sweep`). The map is computed on one of the workers of the executor.
    **keywords : float or str
        Parameters of the vehicle and solver settings, as for `run`.

    Returns
    -------
    WrenchMap
        The coefficients of the map, and the error of the map on the rows that were left out of the fit.

    Raises
    ------
    ValueError
        Raised if the design is no vehicle. Raised if an input or a unit is unknown, or an input is derived. Raised if
        the smallest value of a range is not below the largest value of the range. Raised if the number of samples or of
        periodic rows is too small for the number of coefficients. A grid with mistakes raises GridError.
    TypeError
        Raised if an argument has the wrong type.

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
    if client is None:
        with shown(progress) as show:
            found = _flapwing.wrench_map(design, dict(keywords), progress=show, **options)
    else:
        with one_step(progress):
            found = _workers.call(client, _flapwing.wrench_map, design, dict(keywords), **options)
    for text in found.pop("warnings"):
        warnings.warn(text, stacklevel=2)
    for name in ("start", "stop", "scaled", "physical", "r_squared", "largest_error"):
        found[name] = np.array(found[name])
    found["powers"] = np.array(found["powers"], dtype=np.intp)
    return WrenchMap(**found)


#: The form of ranges, for messages.
_RANGES = 'it must be a dictionary of pairs, such as {"bias": ("-20 V", "20 V")}'


def _range(name: Any, ends: Any) -> tuple[str, Any, Any]:
    """Return the name, the smallest value and the largest value of an input."""
    if not isinstance(name, str):
        raise _mistakes.refused("ranges", name, _RANGES)
    if isinstance(ends, (str, bytes, Mapping)):
        raise _mistakes.refused(f"ranges[{name!r}]", ends, 'it must be two values, such as ("-20 V", "20 V")')
    with _mistakes.reading(f"ranges[{name!r}]", ends, 'it must be two values, such as ("-20 V", "20 V")'):
        listed = list(ends)
    if len(listed) != 2:
        raise ValueError(f'`ranges[{name!r}]` has {len(listed)} values\nit must have two, such as ("-20 V", "20 V")')
    return name, listed[0], listed[1]
