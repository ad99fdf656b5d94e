"""Rows, motions and resonances of single design points."""

from __future__ import annotations

from typing import SupportsFloat, SupportsIndex

from . import _arguments, _flapwing, _workers
from ._progress import Progress, one_step
from ._results import DampedSine, DrivenPeak, FrequencyGap, Resonances, Row
from ._table import Table
from ._types import Design, Executor, InitialState, Record, Value


def run(
    design: Design,
    /,
    *,
    point: SupportsIndex | None = None,
    initial_state: InitialState | None = None,
    waveform: Record | None = None,
    stroke: Record | None = None,
    progress: Progress = False,
    client: Executor | None = None,
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
) -> Row:
    """Simulate one design point until the motion repeats every drive period, and compute the measures of one drive
    period.

    Keyword arguments replace the values of parameters of the design::

        run("ozaki2018-large", drive_voltage_pp="80 V", hinge_stiffness=9e-5, lift_sign="printed")
        run("grid.toml", point=17)

    The same call always returns the same numbers, equal to the last bit. Other Python threads of the program continue
    to run during the call.

    Parameters
    ----------
    design : str, path, dict or Grid
        The name of a preset (see `presets`), a grid (see `Grid`) as a path, text, dictionary or Grid, or the name of a
        model. For a model, give all parameters of the model.
    point : int, optional
        The index of a point in the grid, counted from 0. If the grid has more than one point, `point` is required.
    initial_state : dict, Table or DataFrame, optional
        The state at the start of the first drive period. A dictionary contains components of the state by name, such as
        ``{"pitch": "10 deg"}``: numbers in SI units or text with units. The function `states` lists the names of the
        components. Components of the state that are not given are zero. You can also give a row that has columns of the
        states, such as ``trajectory(…)[-1:]``. A row with states is a Table, a DataFrame, a dictionary or a row of a
        DataFrame. If a state in the given row is nan, the motion begins at rest. If the design has several orbits, the
        state determines the orbit that is found. By default, the motion begins at rest.
    waveform : path, tuple or columns, optional
        One period of the drive waveform, which replaces the parameter `drive_shape`. A CSV file or columns (a
        dictionary, Table or DataFrame) must contain the columns `time_s` (or `time_ms`) and `wave`. You can also give a
        pair of arrays: the times in s, and `wave`. The drive period is the duration of the waveform, unless the keyword
        `drive_frequency` is given. The drive voltage is the bias plus the amplitude times `wave`.
    stroke : path, tuple or columns, optional
        One period of a prescribed stroke: a CSV file or columns with `time_s` and `stroke_deg` (or `stroke_rad`). You
        can also give a pair of arrays: the times in s, and the stroke in rad. The model must have the parameter
        `stroke_mode`.
    progress : bool or function, optional
        If True, a progress bar is shown, as for `sweep`. The progress bar advances only once, at the end of the
        computation.
    client : executor, optional
        An executor, such as a process pool (see `sweep`). The point is computed on one of the workers of the executor.
        The argument `client` does not change the result.
    rtol : float, optional
        Relative tolerance of the integrator, per step and state: more than 0 and less than 0.1. The default of `rtol`
        is 1e-6.
    atol : float, optional
        Absolute tolerance of the integrator, as a multiple of the typical size of each state: more than 0. The default
        of `atol` is `rtol` divided by 100.
    settle_tol : float, optional
        A motion has settled when the state changes by less than `settle_tol` from one drive period to the next. The
        change of a state is divided by the typical size of the state. If the motion is smaller than the typical size,
        the change of the state is divided by the size of the motion. `settle_tol` is more than 0. The default of
        `settle_tol` is 1e-6.
    max_cycles : int, optional
        Largest allowed number of drive periods until the motion settles: 1 or more. A motion that needs more periods
        has the status ``"unsettled"``. The default of `max_cycles` is 1000 drive periods.
    max_steps : int, optional
        Largest number of integration steps in one drive period: 1 or more. The default of `max_steps` is 20000 steps.
    accuracy : float, optional
        Largest value of `error_estimate` and of the energy audit of a row: more than 0. If a row exceeds `accuracy`,
        the point is integrated again with tighter tolerances, up to a limit. The default of `accuracy` is the larger of
        1e-3 and 1000 `rtol`.
    newton : bool, optional
        If True, Newton's iteration finds the orbit that the motion approaches. If False, the motion is integrated until
        the motion settles. Newton's iteration needs fewer drive periods than an integration until the motion settles,
        and finds the orbit on which the motion would settle. The default of `newton` is True.
    progressive : bool, optional
        If True, the search for the orbit begins with tolerances that are larger than `rtol`, and ends with the
        tolerance `rtol`. If False, the whole search uses the tolerance `rtol`, and takes about twice as long as with
        True. The orbit does not depend on `progressive`. The default of `progressive` is True.
    symmetry : bool, optional
        If True, and if the second half of an orbit mirrors the first half, only half of each period is integrated. If
        False, whole periods are always integrated. The orbit does not depend on `symmetry`. The default of `symmetry`
        is True.
    **parameters : float or str
        Parameters of the model by name. A value is a number in SI units, text with a unit such as
        ``"1.5 uN*m/rad"``, or the name of an option of a choice.

    Returns
    -------
    Row
        The measures and attributes of the point. For example, `row["lift_mean_mn"]` is a measure. Unknown numbers are
        nan.

    Raises
    ------
    ValueError
        Raised if a preset, parameter, option or unit is unknown. Raised if a value is out of range, infinite or not a
        number. Raised if a grid has several points, but `point` is not given. The error message has the most similar
        known name and the allowed values.
    TypeError
        Raised if an argument has the wrong type, such as text for a tolerance or a number for an option.
    IndexError
        Raised if the grid has no point with the index `point`.

    Examples
    --------
    >>> grid = {"preset": "ozaki2018-large", "axes": {"drive_frequency": range(100, 120)}}
    >>> flapwing.run(grid, point=5, drive_voltage_pp="80 V").status
    'periodic'
    """
    solver = {"rtol": rtol, "atol": atol, "settle_tol": settle_tol, "accuracy": accuracy}
    steps = {"max_cycles": max_cycles, "max_steps": max_steps}
    search = {"newton": newton, "progressive": progressive, "symmetry": symmetry}
    with one_step(progress):
        row = _workers.call(
            client,
            _flapwing.run,
            design,
            {**parameters, **solver, **steps, **search},
            point=point,
            initial_state=_arguments.state(design, initial_state),
            **_arguments.waves(waveform, stroke),
        )
    return Row(**row)


def trajectory(
    design: Design,
    /,
    *,
    point: SupportsIndex | None = None,
    cycles: SupportsIndex = 2,
    samples: SupportsIndex = 200,
    from_rest: bool = False,
    initial_state: InitialState | None = None,
    waveform: Record | None = None,
    stroke: Record | None = None,
    once: bool = False,
    progress: Progress = False,
    client: Executor | None = None,
    **keywords: Value,
) -> Table:
    """Return the motion of one design point over time, at equally spaced times.

    Parameters
    ----------
    design, point
        The design, and the index of the point in a grid, as for `run`.
    cycles : int, optional
        Number of drive periods in the table. The default of `cycles` is 2 drive periods.
    samples : int, optional
        Number of samples of the motion per drive period. The table has one additional sample at the end of the last
        period. The default of `samples` is 200 samples per drive period. `cycles` times `samples` is at most 5,000,000.
    from_rest : bool, optional
        If True, the table begins with the motion from rest. By default, the table begins after the motion has settled.
    initial_state : dict, Table or DataFrame, optional
        The state in which the motion begins, at the start of a drive period (see `run`).
    waveform, stroke : path, tuple or columns, optional
        A waveform of the drive or a prescribed stroke (see `run`).
    once : bool, optional
        If True, the waveform or the prescribed stroke is not repeated, and the motion begins at rest or in
        `initial_state`. If `once` is True, the first and the last value of the waveform or the stroke may differ, and
        `cycles` has no effect.
    progress, client
        The progress report and the executor, as for `run`.
    **keywords : float or str
        Parameters of the model and solver settings, as for `run`.

    Returns
    -------
    Table
        ``cycles * samples + 1`` rows with the columns of ``flap run --trajectory``: first `time_s` (s), then the states
        of the model, and quantities such as the lift over time. Each name ends in the unit of the column. The attribute
        `docs` has the meanings of the columns, and `meta` has the origin of the motion.

    Raises
    ------
    ValueError
        Raised if an argument is invalid (see `run`). Raised if the combination of parameter values is impossible, or
        the motion does not settle.
    TypeError
        Raised if an argument has the wrong type.

    Examples
    --------
    >>> motion = flapwing.trajectory("ozaki2018-large", cycles=1, samples=100)
    >>> len(motion), motion.columns[:3]
    (101, ['time_s', 'stroke_rad', 'pitch_rad'])
    >>> on = flapwing.trajectory("ozaki2018-large", initial_state=motion[-1:], drive_voltage_pp="80 V")
    """
    with one_step(progress):
        native = _workers.call(
            client,
            _flapwing.trajectory,
            design,
            dict(keywords),
            point=point,
            cycles=cycles,
            samples=samples,
            from_rest=_arguments.flag("from_rest", from_rest),
            initial_state=_arguments.state(design, initial_state),
            once=_arguments.flag("once", once),
            **_arguments.waves(waveform, stroke),
        )
    return Table._of(native, keywords=keywords)


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
    client: Executor | None = None,
    **keywords: Value,
) -> Resonances:
    """Compute the resonances of one design point in small motions, in the free motion after an impulse, and in the
    driven motion.

    Parameters
    ----------
    design, point
        The design, and the index of the point in a grid, as for `run`.
    start, stop : float or str, optional
        Lowest and highest drive frequency (Hz, or text with a unit) of the search for peaks of the settled stroke. The
        default of `start` is half of the lower natural frequency. The default of `stop` is one and a half times the
        upper natural frequency.
    tolerance : float or str, optional
        Largest allowed error of the frequencies of the peaks (Hz, or text with a unit). The default of `tolerance` is
        0.05 Hz.
    impulse : float or str, optional
        Size of the impulse (rad, or text with a unit). The size of the impulse is the stroke amplitude that the impulse
        would cause in an undamped motion of only the first mode. The impulse must not be zero, and the magnitude of the
        impulse is at most 180 degrees. The default of `impulse` is ``"20 deg"``.
    fit_cycles : int, optional
        Duration of the free motion to which a damped sine is fitted, in periods of the first mode. The default of
        `fit_cycles` is 4 periods.
    spectrum_window : float or str, optional
        Duration (s, or text with a unit) of the free motion from which the spectrum is computed. The default of
        `spectrum_window` is 1 s.
    progress, client
        The progress report and the executor, as for `run`.
    **keywords : float or str
        Parameters of the model and solver settings, as for `run`.

    Returns
    -------
    Resonances
        The resonances in small motions, in the free motion after an impulse, and in the driven motion.

    Raises
    ------
    ValueError
        Raised if an argument is invalid (see `run`). Raised if the combination of parameter values is impossible.
    TypeError
        Raised if an argument has the wrong type.

    Examples
    --------
    >>> found = flapwing.resonance("ozaki2018-large")
    >>> round(found.driven[0].frequency_hz, 1)
    110.7
    """
    with one_step(progress):
        found = _workers.call(
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
    sine = found["impulse_fit"]
    found["impulse_fit"] = None if sine is None else DampedSine(**sine)
    found["driven"] = [DrivenPeak(**peak) for peak in found["driven"]]
    found["gaps"] = [FrequencyGap(**gap) for gap in found["gaps"]]
    return Resonances(**found)
