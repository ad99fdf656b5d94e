"""Single design points, and lists of parameters and measures."""

from __future__ import annotations

from typing import Any, NamedTuple, SupportsFloat, SupportsIndex

from . import _flapwing
from ._table import Table

__all__ = ["Parameter", "measures", "params", "resonance", "run", "trajectory"]


class Parameter(NamedTuple):
    """A parameter of a model."""

    #: Name in grids, on the command line and as a keyword.
    name: str
    #: Value in the preset, in SI units, or the name of an option. None if it is not set and follows others.
    value: float | str | None
    #: SI unit; ``""`` for pure numbers and options.
    unit: str
    #: Symbol in the paper; ``""`` if it has none.
    symbol: str
    #: One line of meaning, with its source.
    doc: str
    #: The allowed values, in words.
    allowed: str
    #: Its options, if it is a choice; else empty.
    options: tuple[str, ...]


def params(name: str, /) -> dict[str, Parameter]:
    """The parameters of a preset, with their values, or of a model, without.

    Parameters
    ----------
    name : str
        A preset, such as ``"ozaki2018-large"``, or a model, such as ``"direct-drive"``.

    Returns
    -------
    dict of str to Parameter
        By name, in the order of the model's table.

    Raises
    ------
    ValueError
        There is no such preset or model.

    Examples
    --------
    >>> flapwing.params("ozaki2018-large")["drive_frequency"].unit
    'Hz'
    """
    listed = (Parameter(*row[:-1], options=tuple(row[-1])) for row in _flapwing.params(name))
    return {parameter.name: parameter for parameter in listed}


def measures(name: str, /) -> dict[str, tuple[str, str]]:
    """The measures in rows of a preset or a model: the unit and the meaning of each column.

    Parameters
    ----------
    name : str
        As for `params`.

    Returns
    -------
    dict of str to (str, str)
        Unit and meaning by column, in the order of the rows.

    Raises
    ------
    ValueError
        As for `params`.

    Examples
    --------
    >>> flapwing.measures("ozaki2018-large")["lift_mean_mn"][0]
    'mN'
    """
    return {column: (unit, doc) for column, unit, doc in _flapwing.measures(name)}


def run(
    preset: str,
    /,
    *,
    rtol: SupportsFloat | None = None,
    atol: SupportsFloat | None = None,
    settle_tol: SupportsFloat | None = None,
    max_cycles: SupportsIndex | None = None,
    max_steps: SupportsIndex | None = None,
    accuracy: SupportsFloat | None = None,
    newton: bool | None = None,
    progressive: bool | None = None,
    **parameters: SupportsFloat | str,
) -> dict[str, Any]:
    """Run one design point until its motion repeats with the drive, then measure one drive period.

    The preset's parameters hold except those given as keywords::

        run("ozaki2018-large", drive_voltage_pp="80 V", hinge_stiffness=9e-5, lift_sign="printed")

    The same call gives the same bits every time. Other Python threads go on meanwhile.

    Parameters
    ----------
    preset : str
        One of `presets()`. It names the model too.
    rtol : float, optional
        Relative tolerance of the integrator, per step and state: more than 0 and less than 0.1.
        Default 1e-6.
    atol : float, optional
        Absolute tolerance of the integrator, in units of each state's typical size: more than 0.
        Default rtol / 100.
    settle_tol : float, optional
        The point has settled when its state changes by less than this from one drive period to the
        next, in units of each state's typical size (of the motion's own size, if that is smaller):
        more than 0. Default 1e-6.
    max_cycles : int, optional
        Drive periods after which the point counts as unsettled: 1 or more. Default 1000.
    max_steps : int, optional
        Largest number of integration steps in one drive period: 1 or more.
        Default 20000.
    accuracy : float, optional
        Largest error_estimate and energy audit of a row: more than 0. A point whose row exceeds it is integrated
        again with tighter tolerances, up to a limit. Default 1e-3, or 1000 rtol if that is more.
    newton : bool, optional
        True to find the orbit that the motion approaches by Newton's iteration. If False, the motion is integrated
        until it settles on the same orbit, in more periods. Default True.
    progressive : bool, optional
        True to begin the search for the orbit at looser tolerances, and to end it at rtol. If False, the whole search
        is at rtol: to the same orbit, for about twice the work. Default True.
    **parameters : float or str
        Parameters of the model by name: a number in SI units, text with a unit such as
        ``"1.5 uN*m/rad"``, or the name of an option if the parameter is a choice.

    Returns
    -------
    dict
        One row of results; the keys and their order are the same for every point of a model:

        status : str
            ``"periodic"``; ``"subharmonic"`` (repeats every 2 to 8 drive periods); ``"unsettled"``
            (max_cycles reached); ``"diverged"``; ``"step_limit"`` (max_steps reached, or steps too small
            to advance time); ``"invalid"`` (each parameter is in range, but together they are
            impossible).
        measures : float or None
            Several keys, each named after its quantity, its kind of measure and its unit:
            ``stroke_pp_deg``, ``lift_mean_mn``, ``power_mean_mw``. All are None unless the point is periodic.
            A ratio of zero to zero, such as the efficiency without power, is nan.
        cycles : int
            Drive periods integrated, those of the measurement included.
        residual : float or None
            Change of the state over the last period of the motion, in the units of settle_tol. None if
            no period was completed.
        period : int
            Drive periods until the motion repeats: 1 if periodic, more if subharmonic, otherwise 0.
        floquet_max : float or None
            Factor by which a small change of the motion grows or decays per orbit after a long time. None if no
            orbit was found, and for a wing at rest.
        stable : bool or None
            True if floquet_max is below 1, so that motions near the orbit approach it, and for a wing at rest.
            None if no orbit was found.
        error_estimate : float or None
            Estimate of the largest relative error that the integration makes in stroke, pitch, mean lift and mean
            power; infinite if it cannot be estimated. None unless the point is periodic.
        rhs_evals : int
            Evaluations of the equations of motion.
        reason : str or None
            The cause if the point is invalid, else None.

    Raises
    ------
    ValueError
        Unknown preset, parameter, option or unit; a value out of range, infinite or not a number. The
        message gives the nearest name and the allowed values.
    TypeError
        A value of the wrong type, such as text for a tolerance or a number for an option.
    """
    solver = {"rtol": rtol, "atol": atol, "settle_tol": settle_tol, "accuracy": accuracy}
    steps = {"max_cycles": max_cycles, "max_steps": max_steps}
    search = {"newton": newton, "progressive": progressive}
    return _flapwing.run(preset, {**parameters, **solver, **steps, **search})


def trajectory(
    preset: str,
    /,
    *,
    cycles: SupportsIndex = 2,
    samples: SupportsIndex = 200,
    from_rest: bool = False,
    **keywords: SupportsFloat | str,
) -> Table:
    """The motion of one design point, sampled at equal times.

    Parameters
    ----------
    preset : str
        One of `presets()`.
    cycles : int, optional
        Drive periods. Default 2.
    samples : int, optional
        Samples per drive period; the end of the last period is sampled too. Default 200. `cycles` times `samples` is
        at most 5,000,000.
    from_rest : bool, optional
        Begin at rest. By default the motion begins once it has settled.
    **keywords : float or str
        Parameters of the model and solver settings, as for `run`.

    Returns
    -------
    Table
        ``cycles * samples + 1`` rows with the columns of ``flap run --trajectory``: `time_s` (s), then the states and
        signals of the model, named with their units.

    Raises
    ------
    ValueError
        As for `run`; also if the parameters are impossible together, or the motion does not settle.
    TypeError
        A value of the wrong type.

    Examples
    --------
    >>> motion = flapwing.trajectory("ozaki2018-large", cycles=1, samples=100)
    >>> len(motion), motion.columns[:3]
    (101, ['time_s', 'stroke_rad', 'pitch_rad'])
    """
    native = _flapwing.trajectory(preset, dict(keywords), cycles=cycles, samples=samples, from_rest=from_rest)
    return Table._of(native)


def resonance(
    preset: str,
    /,
    *,
    start: float | None = None,
    stop: float | None = None,
    tolerance: float = 0.05,
    impulse: float = 20.0,
    fit_cycles: SupportsIndex = 4,
    spectrum_window: float = 1.0,
    **keywords: SupportsFloat | str,
) -> dict[str, Any]:
    """The resonances of one design point: of small motions, after an impulse, and under the drive.

    Parameters
    ----------
    preset : str
        One of `presets()`.
    start, stop : float, optional
        Lowest and highest drive frequency (Hz) of the search for peaks of the settled stroke. Default: half of the lower
        natural frequency to one and a half times the upper one.
    tolerance : float, optional
        Largest error of the peaks' frequencies (Hz). Default 0.05.
    impulse : float, optional
        Impulse on the resting stroke, as the amplitude (deg) that the first mode alone would reach without damping.
        Default 20.
    fit_cycles : int, optional
        Number of periods of the first mode to which the damped sine is fitted. Default 4.
    spectrum_window : float, optional
        Length (s) of the motion whose spectrum is taken. Default 1.
    **keywords : float or str
        Parameters of the model and solver settings, as for `run`.

    Returns
    -------
    dict
        linear_hz : dict of str to float
            Small undamped motions: frequency (Hz) by name of the mode.
        impulse_fit : dict or None
            The damped sine through the stroke after the impulse: `frequency_hz`, `decay_1_s` (1/s) and
            `relative_rms`, the rms of the residuals over that of the stroke. None if no damped sine fits.
        stroke_spectrum_hz, pitch_spectrum_hz : list of float
            Highest peaks of the spectra after the impulse (Hz).
        driven : list of dict
            Peaks of the settled stroke over drive frequency, the highest first: `frequency_hz`, `stroke_pp_deg`,
            `pitch_pp_deg`.
        larger_at_hz : float or None
            The end of the range at which the stroke is larger than at any peak, if there is one.
        gaps : list of (float, float, str)
            Ranges of drive frequencies (Hz) without a periodic motion, each with a status: there may be a peak in them.

    Raises
    ------
    ValueError
        As for `run`; also if the parameters are impossible together.

    Examples
    --------
    >>> found = flapwing.resonance("ozaki2018-large")
    >>> round(found["driven"][0]["frequency_hz"], 1)
    110.7
    """
    return _flapwing.resonance(
        preset,
        dict(keywords),
        start=start,
        stop=stop,
        tolerance=tolerance,
        impulse=impulse,
        fit_cycles=fit_cycles,
        spectrum_window=spectrum_window,
    )
