"""Single design points: their rows, motions and resonances."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, SupportsFloat, SupportsIndex

from . import _arguments, _flapwing, _worker
from ._progress import Progress, one_step
from ._table import Table
from ._types import Design, Record, State, Value

if TYPE_CHECKING:
    from distributed import Client

__all__ = ["resonance", "run", "trajectory"]


def run(
    design: Design,
    /,
    *,
    point: SupportsIndex | None = None,
    begin: State | None = None,
    waveform: Record | None = None,
    stroke: Record | None = None,
    progress: Progress = False,
    client: Client | None = None,
    rtol: SupportsFloat | None = None,
    atol: SupportsFloat | None = None,
    settle_tol: SupportsFloat | None = None,
    max_cycles: SupportsIndex | None = None,
    max_steps: SupportsIndex | None = None,
    accuracy: SupportsFloat | None = None,
    newton: bool | None = None,
    progressive: bool | None = None,
    symmetry: bool | None = None,
    **parameters: Value,
) -> dict[str, Any]:
    """Run one design point until its motion repeats with the drive, then measure one drive period.

    The design's parameters hold except those given as keywords::

        run("ozaki2018-large", drive_voltage_pp="80 V", hinge_stiffness=9e-5, lift_sign="printed")
        run("grid.toml", point=17)

    The same call gives the same bits every time. Other Python threads go on meanwhile.

    Parameters
    ----------
    design : str, path, dict or Grid
        A preset, one of `presets()`; or a grid, see `Grid`, as a path, text, dictionary or Grid; or a model, all of whose
        parameters must then be given.
    point : int, optional
        The index of a point in the grid. Needed if it has more than one.
    begin : dict, Table or DataFrame, optional
        The state at the start of the first drive period: components by the names of `states(…)`, each a number in SI
        units or text with a unit, ``{"pitch": "10 deg"}``; those not given are zero. Or a row with the states among its
        columns, such as ``trajectory(…)[-1:]``, the same as a DataFrame or a dictionary, or a row of a DataFrame; a row
        with nan begins at rest. If the design has several orbits, it decides which is found. Default: rest.
    waveform : path, tuple or columns, optional
        One period of the drive in place of `drive_shape`: a CSV file or columns (a dictionary, Table or DataFrame) with
        `time_s` (or `time_ms`) and `wave`, or a pair of arrays (times in s, wave). Its duration is the drive period unless
        `drive_frequency` is given as a keyword. The voltage is bias + amplitude times wave.
    stroke : path, tuple or columns, optional
        One period of a prescribed stroke, likewise: `time_s` and `stroke_deg` (or `stroke_rad`), or a pair of arrays (s,
        rad). For models with the parameter `stroke_mode`.
    progress : bool or function, optional
        As for `sweep`: a point is one step.
    client : distributed.Client, optional
        Run the point on a worker of a Dask cluster, which needs the same build of flapwing. The result is the same.
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
    symmetry : bool, optional
        True to find and measure an orbit whose second half mirrors the first over half periods. If False, all periods
        are whole: the same orbit, for more work. Default True.
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
            ``stroke_pp_deg``, ``lift_mean_mn``, ``power_mean_mw``; then those of the grid's ``[measure]``. All are None
            unless the point is periodic. A ratio of zero to zero, such as the efficiency without power, is nan.
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
        Unknown preset, parameter, option or unit; a value out of range, infinite or not a number; a grid with several
        points, and no `point`. The message gives the nearest name and the allowed values.
    TypeError
        A value of the wrong type, such as text for a tolerance or a number for an option.
    IndexError
        The grid has no such point.

    Examples
    --------
    >>> grid = {"preset": "ozaki2018-large", "axes": {"drive_frequency": range(100, 120)}}
    >>> flapwing.run(grid, point=5, drive_voltage_pp="80 V")["status"]
    'periodic'
    """
    solver = {"rtol": rtol, "atol": atol, "settle_tol": settle_tol, "accuracy": accuracy}
    steps = {"max_cycles": max_cycles, "max_steps": max_steps}
    search = {"newton": newton, "progressive": progressive, "symmetry": symmetry}
    with one_step(progress):
        row: dict[str, Any] = _worker.call(
            client,
            _flapwing.run,
            design,
            {**parameters, **solver, **steps, **search},
            point=point,
            begin=_arguments.state(design, begin),
            **_arguments.waves(waveform, stroke),
        )
    return row


def trajectory(
    design: Design,
    /,
    *,
    point: SupportsIndex | None = None,
    cycles: SupportsIndex = 2,
    samples: SupportsIndex = 200,
    from_rest: bool = False,
    begin: State | None = None,
    waveform: Record | None = None,
    stroke: Record | None = None,
    once: bool = False,
    progress: Progress = False,
    client: Client | None = None,
    **keywords: Value,
) -> Table:
    """The motion of one design point, sampled at equal times.

    Parameters
    ----------
    design, point
        As for `run`.
    cycles : int, optional
        Drive periods. Default 2.
    samples : int, optional
        Samples per drive period; the end of the last period is sampled too. Default 200. `cycles` times `samples` is
        at most 5,000,000.
    from_rest : bool, optional
        Begin at rest. By default the motion begins once it has settled.
    begin : dict, Table or DataFrame, optional
        Begin in this state at the start of a drive period, see `run`.
    waveform, stroke : path, tuple or columns, optional
        A waveform of the drive or a prescribed stroke, see `run`.
    once : bool, optional
        Follow the waveform or the stroke once, from rest or from `begin`, instead of repeating it. It need not be
        closed, and `cycles` does not count.
    progress, client
        As for `run`.
    **keywords : float or str
        Parameters of the model and solver settings, as for `run`.

    Returns
    -------
    Table
        ``cycles * samples + 1`` rows with the columns of ``flap run --trajectory``: `time_s` (s), then the states and
        signals of the model, named with their units. `docs` has their meanings, `meta` the origin of the motion.

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
    >>> on = flapwing.trajectory("ozaki2018-large", begin=motion[-1:], drive_voltage_pp="80 V")
    """
    with one_step(progress):
        native = _worker.call(
            client,
            _flapwing.trajectory,
            design,
            dict(keywords),
            point=point,
            cycles=cycles,
            samples=samples,
            from_rest=_arguments.flag("from_rest", from_rest),
            begin=_arguments.state(design, begin),
            once=_arguments.flag("once", once),
            **_arguments.waves(waveform, stroke),
        )
    return Table._of(native, set=keywords)


def resonance(
    design: Design,
    /,
    *,
    point: SupportsIndex | None = None,
    start: Value | None = None,
    stop: Value | None = None,
    tolerance: Value = 0.05,
    impulse: Value = "20 deg",
    fit_cycles: SupportsIndex = 4,
    spectrum_window: Value = 1.0,
    progress: Progress = False,
    client: Client | None = None,
    **keywords: Value,
) -> dict[str, Any]:
    """The resonances of one design point: of small motions, after an impulse, and under the drive.

    Parameters
    ----------
    design, point
        As for `run`.
    start, stop : float or str, optional
        Lowest and highest drive frequency (Hz, or text with a unit) of the search for peaks of the settled stroke.
        Default: half of the lower natural frequency to one and a half times the upper one.
    tolerance : float or str, optional
        Largest error of the peaks' frequencies (Hz, or text with a unit). Default 0.05.
    impulse : float or str, optional
        Impulse on the resting stroke, as the amplitude (rad, or text with a unit) that the first mode alone would reach
        without damping: at most half a turn, not zero. Default ``"20 deg"``.
    fit_cycles : int, optional
        Number of periods of the first mode to which the damped sine is fitted. Default 4.
    spectrum_window : float or str, optional
        Length (s, or text with a unit) of the motion whose spectrum is taken. Default 1.
    progress, client
        As for `run`.
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
    TypeError
        A value of the wrong type.

    Examples
    --------
    >>> found = flapwing.resonance("ozaki2018-large")
    >>> round(found["driven"][0]["frequency_hz"], 1)
    110.7
    """
    with one_step(progress):
        found: dict[str, Any] = _worker.call(
            client,
            _flapwing.resonance,
            design,
            dict(keywords),
            point=point,
            start=start,
            stop=stop,
            tolerance=tolerance,
            impulse=impulse,
            fit_cycles=fit_cycles,
            spectrum_window=spectrum_window,
        )
    return found
