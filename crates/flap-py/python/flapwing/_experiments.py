"""Experiments on single design points, and the motion of filmed wings."""

from __future__ import annotations

from typing import SupportsFloat, SupportsIndex

from . import _arguments, _flapwing
from ._table import Table
from ._types import Design, Record, Value


def chirp(
    design: Design,
    /,
    *,
    point: SupportsIndex | None = None,
    start: Value = 1.0,
    stop: Value | None = None,
    rate: Value = 15.0,
    samples: SupportsIndex | None = None,
    **keywords: Value,
) -> Table:
    """Simulate a chirp of one design point from rest: the drive frequency changes at a constant rate.

    Parameters
    ----------
    design, point
        The design, and the index of the point in a grid, as for `run`.
    start : float or str, optional
        Drive frequency at which the chirp begins (Hz, or text with a unit): more than 0. The default of `start` is 1
        Hz.
    stop : float or str, optional
        Drive frequency at the end of the chirp (Hz, or text with a unit): more than 0. The chirp ends after a whole
        number of cycles. The default of `stop` is twice the design's drive frequency.
    rate : float or str, optional
        Rate of change of the drive frequency (Hz/s, or text with a unit). With a negative rate, the drive frequency
        falls. The default of `rate` is 15 Hz/s.
    samples : int, optional
        Number of samples per cycle. If `samples` is given, the table contains the motion instead of the measures of
        each cycle.
    **keywords : float or str
        Parameters of the model and solver settings, as for `run`.

    Returns
    -------
    Table
        One row per cycle. The columns are `begin_s`, `end_s`, `frequency_hz` (cycles per second), and measures of the
        cycle such as `stroke_pp_deg`. If `samples` is given, the table has the samples of the motion, with the columns
        of `trajectory`.

    Raises
    ------
    ValueError
        Raised if an argument is invalid (see `run`). Raised if the drive frequency cannot reach `stop` from `start`
        with the given sign of `rate`, or the motion diverges.
    TypeError
        Raised if an argument has the wrong type.

    Examples
    --------
    >>> rows = flapwing.chirp("ozaki2018-small", start="150 Hz", stop="250 Hz", rate=400)
    >>> peak = rows["stroke_pp_deg"].argmax()
    >>> bool(180 < rows["frequency_hz"][peak] < 220)
    True
    """
    native = _flapwing.chirp(design, dict(keywords), point=point, start=start, stop=stop, rate=rate, samples=samples)
    return Table._of(native, keywords=keywords)


def impulse(
    design: Design,
    /,
    *,
    point: SupportsIndex | None = None,
    amplitude: Value = "20 deg",
    duration: Value | None = None,
    samples: SupportsIndex = 200,
    **keywords: Value,
) -> Table:
    """Simulate the free motion of one design point after an impulse that sets the stroke of the resting wing in motion.

    During the motion, the drive voltage has a constant value, at which a wing at rest has zero stroke and pitch.

    Parameters
    ----------
    design, point
        The design, and the index of the point in a grid, as for `run`.
    amplitude : float or str, optional
        Size of the impulse (rad, or text with a unit). The size of the impulse is the stroke amplitude that the impulse
        would cause in an undamped motion of only the first mode. The impulse must not be zero, and the magnitude of the
        impulse is at most 180 degrees. The default of `amplitude` is ``"20 deg"``.
    duration : float or str, optional
        Duration of the motion (s, or text with a unit): more than 0. The default of `duration` is ten periods of the
        first mode.
    samples : int, optional
        Smallest number of samples that the table has per period of the first mode. The default of `samples` is 200
        samples per period.
    **keywords : float or str
        Parameters of the model and solver settings, as for `run`.

    Returns
    -------
    Table
        The motion with the columns of `trajectory`. ``meta["mode_hz"]`` is the natural frequency of the first mode, and
        ``meta["stroke_rate_rad_s"]`` is the rate of the stroke immediately after the impulse.

    Raises
    ------
    ValueError
        Raised if an argument is invalid (see `run`). Raised if `amplitude` is zero or more than 180 degrees, or if the
        duration is zero.
    TypeError
        Raised if an argument has the wrong type.

    Examples
    --------
    >>> free = flapwing.impulse("ozaki2018-small", amplitude="10 deg", duration="50 ms")
    >>> bool(free["stroke_deg"].max() < 10)
    True
    """
    native = _flapwing.impulse(
        design, dict(keywords), point=point, amplitude=amplitude, duration=duration, samples=samples
    )
    return Table._of(native, keywords=keywords)


def forces_along(
    design: Design,
    motion: Record,
    /,
    *,
    point: SupportsIndex | None = None,
    periodic: bool = False,
    samples: SupportsIndex = 2000,
    **keywords: Value,
) -> Table:
    """Compute the forces on the wing of one design point along a given motion, such as a filmed motion.

    `forces_along` does not integrate equations of motion. Between samples, the given motion is a cubic spline. The
    acceleration of the spline amplifies noise, so smooth measured angles first.

    Parameters
    ----------
    design, point
        The design, and the index of the point in a grid, as for `run`.
    motion : path or columns
        Stroke and pitch over time: a CSV file, or columns (a dictionary, Table or DataFrame). The columns of `motion`
        are `time_s` (or `time_ms`), `stroke_deg` (or `stroke_rad`) and `pitch_deg` (or `pitch_rad`). Tables of
        `track_wing` and `trajectory` have the required columns. The motion has at least four samples at rising times.
    periodic : bool, optional
        True if the given motion is one period of a periodic motion. If `periodic` is true, the last sample of the given
        motion is also the first sample of the next period.
    samples : int, optional
        Number of equal time intervals into which the given motion is divided. Forces are computed at the ends of the
        intervals. The largest number is 5 million, and the default of `samples` is 2000 intervals.
    **keywords : float or str
        Parameters of the model, as for `run`.

    Returns
    -------
    Table
        ``samples + 1`` rows: `time_s`, stroke and pitch, lift and drag, and the parts of lift and drag. The table has
        no columns of the actuator, because the given motion does not determine the voltage of the actuator.

    Raises
    ------
    ValueError
        Raised if an argument is invalid (see `run`). Raised if a column is missing or has values that are not finite
        numbers, or the times do not increase.
    OSError
        Raised if the file cannot be read.
    TypeError
        Raised if an argument has the wrong type.

    Examples
    --------
    >>> motion = flapwing.trajectory("ozaki2018-small", cycles=1)
    >>> forces = flapwing.forces_along("ozaki2018-small", motion, periodic=True)
    >>> round(float(forces["lift_mn"].mean() / flapwing.run("ozaki2018-small")["lift_mean_mn"]), 2)
    1.0
    """
    native = _flapwing.forces_along(
        design,
        _arguments.record("motion", motion, "stroke_rad", "pitch_rad"),
        dict(keywords),
        point=point,
        periodic=_arguments.flag("periodic", periodic),
        samples=samples,
    )
    return Table._of(native, keywords=keywords)


def track_wing(points: Record, /, *, chord: SupportsFloat | None = None) -> Table:
    """Compute stroke and pitch of a filmed wing from points that were tracked in the images of the film.

    The stroke is the angle from the x-axis of the image to the leading edge, without jumps by 360°. The pitch is
    computed from the length of the chord in the image. The pitch is positive if the lower edge lags while the stroke
    rises. In the model `four-bar`, the pitch has the opposite sign, so multiply the pitch by -1 for this model. The
    centre of the stroke's rotation is the point nearest to the lines through all leading edges (Ozaki and Hamaguchi
    2018, eqs. 42 and 43).

    Parameters
    ----------
    points : path or columns
        The tracked points of every image: a CSV file, or columns (a dictionary, Table or DataFrame). The columns of
        `points` are `root_x`, `root_y`, `tip_x` and `tip_y`, which are the coordinates of two points of the leading
        edge. The column of the time is `time_s` (or `time_ms`). For the pitch, `points` also requires the columns
        `edge_x` and `edge_y`, which are the coordinates of a point on the lower edge of the wing.
    chord : float, optional
        Length of the chord from the leading edge to the point on the lower edge: more than 0. The unit of `chord` is
        the unit of the coordinates. The table has the column `pitch_deg` only if `chord` is given.

    Returns
    -------
    Table
        One row per image: `time_s`, `stroke_deg` and, if `chord` is given, `pitch_deg`. ``meta["centre"]`` is the
        centre of rotation (x, y) in the unit of the points.

    Raises
    ------
    ValueError
        Raised if a column is missing or has values that are not finite numbers, or the times do not increase. Raised
        if all leading edges are parallel. Raised if the distance between lower edge and leading edge in an image is
        larger than the chord.
    OSError
        Raised if the file cannot be read.
    TypeError
        Raised if an argument has the wrong type.

    Examples
    --------
    >>> import numpy as np
    >>> stroke = np.linspace(-0.5, 0.5, 5)
    >>> film = {"time_ms": np.arange(5.0), "root_x": 0 * stroke, "root_y": 0 * stroke,
    ...         "tip_x": 9 * np.cos(stroke), "tip_y": 9 * np.sin(stroke)}
    >>> flapwing.track_wing(film)["stroke_deg"].round(1)
    array([-28.6, -14.3,   0. ,  14.3,  28.6])
    """
    native = _flapwing.track_wing(
        _arguments.record("points", points, "root_x", "root_y", "tip_x", "tip_y"), chord=chord
    )
    return Table._of(native)
