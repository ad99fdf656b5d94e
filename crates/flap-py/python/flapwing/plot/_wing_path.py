"""An animation of one cycle of the motion of a wing."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from .. import _labels
from .._data import Data
from . import _style
from ._animation import Animation
from ._checks import checked

# Number of past chords that are shown, and their distance in cycles.
_PAST, _APART = 9, 1.0 / 36.0

# Possible distances of ticks, in degrees of the stroke.
_STEPS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 90)

# Smaller strokes, peak to peak (rad), are drawn enlarged.
_SMALL = np.radians(11.0)


@checked
def wing_path(
    table: Any,
    *,
    frames: int = 48,
    frequency: float | None = None,
    radius: float | None = None,
    lift: str | None = "lift_mn",
    pitch_sign: int | None = None,
    legend: bool | str = True,
    ax: Axes | None = None,
) -> Animation:
    """Animate the last cycle of a motion. The animation shows the chord as an observer at the wing's tip sees it, while
    the chord moves along the stroke.

    A line shows the chord from the leading edge, which is a dot at the upper edge of the wing, to the trailing edge.
    The length of an arrow shows the lift. If the lift is negative, the arrow points down. Below the wing, curves show
    stroke and pitch over the cycle. Store the returned `Animation` in a variable until you have saved or shown the
    animation: ``plot.wing_path(trajectory).save("cycle.gif")``.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        A trajectory of at least one cycle, with the columns ``time_s``, ``stroke_deg`` and ``pitch_deg``. The samples
        must be equally spaced in time.
    frames : int
        Number of frames in the cycle. The frames are evenly spaced in time.
    frequency : float, optional
        Frequency of the wing's cycles (Hz). By default, `frequency` is computed from the time after which the motion
        repeats.
    radius : float, optional
        Distance of the drawn chord from the stroke axis, as a multiple of the length of the chord. The default of
        `radius` is 3. If the peak-to-peak stroke is less than 11 degrees, the default of `radius` is so large that the
        leading edge moves by 2.5 chord lengths.
    lift : str or None
        The column that the length of the arrow shows. If `lift` is None, no arrow is drawn. If you do not give `lift`
        and the table has no column `lift_mn`, no arrow is drawn.
    pitch_sign : {1, -1}, optional
        Sign convention of the pitch. The sign describes a wing that moves towards positive stroke with a positive
        pitch: the trailing edge lags (1) or leads (-1). The default of `pitch_sign` is the convention of the table's
        model. If the table contains no model, the default is the sign for which the trailing edge lags on average.
    legend
        This argument has the same meaning as in `flapwing.plot.response`.
    ax : matplotlib Axes, optional
        Axes in which the wing is drawn. If you give `ax`, the curves of stroke and pitch are not drawn, and the legend
        is inside `ax`.

    Returns
    -------
    Animation
        A matplotlib ``FuncAnimation`` whose method `save` also writes ``.gif`` and ``.html`` files.

    Raises
    ------
    ValueError
        Raised if a column is unknown. Raised if the motion does not repeat, or if the trajectory is shorter than one
        cycle.
    """
    data = Data.of(table)
    if frames < 2:
        raise ValueError(f"an animation must have at least two frames, not {frames}")
    if pitch_sign not in (None, 1, -1):
        raise ValueError(f"`pitch_sign` must be 1 or -1, not {pitch_sign}")
    if lift is not None and lift != "lift_mn":
        data[lift]
    cycle = Cycle(data, frames, frequency, lift if lift is not None and lift in data else None)
    sign = pitch_sign_of(data, cycle) if pitch_sign is None else pitch_sign
    if radius is None:
        swept = float(np.radians(np.ptp(cycle.stroke)))
        radius = 2.5 / swept if 0.0 < swept < _SMALL else 3.0
    with _style.applied(ax):
        return Animation(_Scene(cycle, sign, radius, legend, ax))


class Cycle:
    """The last cycle of a trajectory, interpolated at the times of the frames. The phase rises from 0 to 1 during the
    cycle.
    """

    def __init__(self, data: Data, frames: int, frequency: float | None, lift: str | None) -> None:
        t, stroke, pitch = (data.numbers(name) for name in ("time_s", "stroke_deg", "pitch_deg"))
        if len(t) < 9:
            raise ValueError(f"a trajectory of {len(t)} samples is too short")
        self.seconds = _period(t, stroke, pitch) if frequency is None else 1.0 / frequency
        start = t[-1] - self.seconds
        if start < t[0] - 1e-6 * self.seconds:
            raise ValueError(f"the trajectory has less than one cycle of {self.seconds:g} s")
        self.phase = np.arange(frames) / frames
        self.frames = frames
        times = start + self.phase * self.seconds
        self.stroke, self.pitch = np.interp(times, t, stroke), np.interp(times, t, pitch)
        self.lift = None if lift is None else np.interp(times, t, data.numbers(lift))
        self.lift_words = "" if lift is None else data.shown(lift).words
        self.lift_unit = "" if lift is None else _labels.printed(data.unit(lift))


class _Scene:
    """The figure of the animation, with its fixed parts and the parts that move from frame to frame."""

    def __init__(self, cycle: Cycle, sign: int, radius: float, legend: bool | str, ax: Axes | None) -> None:
        self.cycle, self.frames = cycle, cycle.frames
        along = np.radians(cycle.stroke) * radius
        tilt = np.radians(cycle.pitch) * sign
        self.leading = np.column_stack([along, np.zeros_like(along)])
        self.trailing = np.column_stack([along - np.sin(tilt), -np.cos(tilt)])
        self.given = ax is not None
        below: Axes | None = None
        if ax is None:
            figure = _style.new_figure(6.4, 5.0)
            ax, below = figure.subplots(2, 1, height_ratios=[2.2, 1.0])
        self.figure: Figure = _style.figure_of(ax)
        self._set_up(ax, radius, legend)
        self.now = None if below is None else self._curves(below)
        if below is not None:
            # The layout is the same in all frames, and computing it takes longer than drawing a frame.
            self.figure.draw_without_rendering()
            self.figure.set_layout_engine(None)

    def _set_up(self, ax: Axes, radius: float, legend: bool | str) -> None:
        reach = np.abs(np.concatenate([self.leading[:, 0], self.trailing[:, 0]])).max() + 0.25
        ax.set_aspect("equal")
        ax.set_xlim(-max(reach, 2.0), max(reach, 2.0))
        ax.set_ylim(-1.2, 1.2 if self.cycle.lift is not None else 0.75)
        ax.grid(False)
        ax.spines[:].set_visible(False)
        ax.set_yticks([])
        low, high = self.cycle.stroke.min(), self.cycle.stroke.max()
        room = 0.12 * (ax.get_xlim()[1] - ax.get_xlim()[0])
        step = next((step for step in _STEPS if np.radians(step) * radius >= room), 180)
        degrees = np.arange(np.ceil(low / step) * step, high + 1e-9, step)
        ax.set_xticks(
            np.radians(degrees) * radius, labels=[f"{_labels.number(round(degree, 6) + 0.0)}°" for degree in degrees]
        )
        ax.set_xlabel("Stroke, at the leading edge")
        ends = [self.leading[:, 0].min(), self.leading[:, 0].max()]
        ax.plot(ends, [0.0, 0.0], color="#bbbbbb", linewidth=_style.width(0.6), linestyle=(0, (4, 3)))
        self.past = LineCollection([], colors=[], linewidths=_style.width(1.0), capstyle="round")
        ax.add_collection(self.past)
        (self.chord,) = ax.plot(
            [], [], color=_style.BLUE, linewidth=_style.width(2.0), solid_capstyle="round", label="chord"
        )
        (self.edge,) = ax.plot([], [], "o", color=_style.ink(ax), markersize=_style.size(1.15), label="leading edge")
        handles = [self.edge, self.chord]
        if self.cycle.lift is not None:
            peak = float(np.abs(self.cycle.lift).max())
            self.per_unit = 1.1 / peak if peak > 0 else 0.0
            text = f"{self.cycle.lift_words.lower()}, up to {_labels.number(peak)} {self.cycle.lift_unit}"
            (self.shaft,) = ax.plot([], [], color=_style.VERMILLION, linewidth=_style.width(1.25), label=text.strip())
            (self.head,) = ax.plot([], [], "^", color=_style.VERMILLION, markersize=_style.size(1.15))
            handles.append(self.shaft)
        above = {"loc": "lower center", "bbox_to_anchor": (0.5, 1.0)}
        look: dict[str, Any] = {"handles": handles, "ncols": 3, "borderaxespad": 0.1}
        _style.legend(ax, legend, self.given, inside="lower left", outside=above, **look)

    def _curves(self, ax: Axes) -> Any:
        phase = np.append(self.cycle.phase, 1.0)
        for values, name, colour in (
            (self.cycle.stroke, "stroke", _style.BLUE),
            (self.cycle.pitch, "pitch", _style.VERMILLION),
        ):
            ax.plot(phase, np.append(values, values[0]), color=colour, label=name)
        ax.set_xlim(0.0, 1.0)
        ax.set_xlabel(f"Cycle (of {_labels.number(self.cycle.seconds * 1e3)} ms)")
        ax.set_ylabel("Angle (°)")
        ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.2)
        return ax.axvline(0.0, color=_style.ink(ax), linewidth=_style.width(0.6))

    def draw(self, frame: int) -> list[Any]:
        """Move all moving parts of the picture to their positions in a frame, and return these parts."""
        cycle = self.cycle
        spacing = max(1, round(_APART * cycle.frames))
        ago = [(frame - i * spacing) % cycle.frames for i in range(_PAST, 0, -1)]
        self.past.set_segments([np.array([self.leading[i], self.trailing[i]]) for i in ago])
        self.past.set_color([(0.0, 0.447, 0.698, 0.06 + 0.3 * i / _PAST) for i in range(_PAST)])
        leading, trailing = self.leading[frame], self.trailing[frame]
        self.chord.set_data([leading[0], trailing[0]], [leading[1], trailing[1]])
        self.edge.set_data([leading[0]], [leading[1]])
        moved: list[Any] = [self.past, self.chord, self.edge]
        if cycle.lift is not None:
            # The arrow begins near the centre of pressure, a quarter of the chord behind the leading edge.
            foot = 0.75 * leading + 0.25 * trailing
            length = cycle.lift[frame] * self.per_unit
            self.shaft.set_data([foot[0], foot[0]], [foot[1], foot[1] + length])
            self.head.set_data([foot[0]], [foot[1] + length])
            self.head.set_marker("^" if length >= 0 else "v")
            self.head.set_visible(abs(length) > 0.05)
            moved += [self.shaft, self.head]
        if self.now is not None:
            self.now.set_xdata([cycle.phase[frame]] * 2)
            moved.append(self.now)
        return moved


def _period(t: np.ndarray, stroke: np.ndarray, pitch: np.ndarray) -> float:
    """Return the time (s) after which the motion repeats. The period of the motion is computed from the last part of
    the motion.
    """
    n = len(t)
    states = np.column_stack([stroke, pitch])
    size = np.ptp(states, axis=0)
    if not (size > 0).any():
        raise ValueError("the wing does not move")
    states = states[:, size > 0] / size[size > 0]
    error = np.zeros(n)
    for shift in range(1, n):
        overlap = min(shift, n - shift)
        error[shift] = np.abs(states[n - overlap :] - states[n - overlap - shift : n - shift]).max()
    # Neighbouring samples are also close, so the error must first rise.
    close = np.flatnonzero(np.logical_or.accumulate(error > 0.05) & (error < 0.01))
    if close.size == 0:
        raise ValueError("the motion does not repeat within the trajectory: give its `frequency`")
    shift = int(close[0])
    while shift + 1 < n and error[shift + 1] < error[shift]:
        shift += 1
    return float(t[-1] - t[n - 1 - shift])


def pitch_sign_of(data: Data, cycle: Cycle) -> int:
    """Return the sign convention of the pitch. With a positive pitch and a rising stroke, the trailing edge lags (1) or
    leads (-1).

    The sign convention is the convention of the table's model. If the table contains no model, the sign is chosen such
    that the trailing edge lags on average.
    """
    sign = data.meta.get("pitch_sign")
    if sign is not None:
        return int(sign)
    return -1 if np.sum(cycle.pitch * np.gradient(cycle.stroke)) < 0 else 1
