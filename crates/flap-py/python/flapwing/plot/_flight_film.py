"""An animation of a flight, which shows the vehicle and its flapping wings."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection

from .. import _flapwing
from .._data import Data, several
from .._mistakes import unknown
from . import _style
from ._animation import Animation
from ._checks import checked
from ._flight import GROUPS
from ._wing_path import Cycle, pitch_sign_of

#: The horizontal and the vertical coordinate of each view, with the labels of the axes.
VIEWS = {
    "side": (0, 2, "Forward (mm)", "Up (mm)"),
    "top": (0, 1, "Forward (mm)", "Left (mm)"),
    "front": (1, 2, "Left (mm)", "Up (mm)"),
}

#: Number of samples in a wing beat.
_SAMPLES = 240

#: Smallest number of frames of a wing beat.
_FRAMES_OF_BEAT = 10

#: Smallest size of the drawn vehicle, as a share of the flown distance.
_SMALLEST = 0.15


@checked
def flight_film(
    table: Any,
    motion: Any,
    *,
    vehicle: Any = None,
    views: Sequence[str] = ("side", "top"),
    frames: int = 100,
    scale: float | None = None,
) -> Animation:
    """Animate a flight of a vehicle: each frame shows the body with flapping wings, the trajectory up to the present
    time, and the time.

    The wings move as in `motion`, the motion of a wing on a body at rest. The animation does not show how the motion of
    the body or the controller changes the motion of the wings. If a wing beat would have fewer than ten frames, the
    animation slows the wings down to one beat in ten frames. The text above the picture shows the factor by which the
    wings are slower.

    A thick line shows the body. The thick line begins at the shoulders of the wings and passes through the centre of
    mass, which is a dot. The thick line is equally long on both sides of the centre of mass, and does not show the
    length of the real body. Store the returned `Animation` in a variable until you have saved or shown the animation:
    ``plot.flight_film(flight, motion).save("flight.gif")``.

    Parameters
    ----------
    table : Table, data frame, mapping of columns, or path
        A flight from `flapwing.fly` or ``flap vehicle --fly``.
    motion : Table, data frame, mapping of columns, or path
        A trajectory of one wing from `flapwing.trajectory`. The trajectory must contain at least one cycle and the
        columns ``time_s``, ``stroke_deg`` and ``pitch_deg``. If the wings have different motions, give a mapping from
        the name of each wing to its trajectory.
    vehicle : Vehicle, Grid, dict or path, optional
        The vehicle, from which the animation takes the positions and sizes of the wings. The default of `vehicle` is
        the vehicle of the flight. If the flight is a file, you must give `vehicle`.
    views : sequence of str
        One to three directions from which the animation shows the vehicle: ``"side"`` (from the right side), ``"top"``
        and ``"front"``. The default of `views` is ``("side", "top")``.
    frames : int
        Number of frames. The frames are evenly spaced in time, from the first to the last row of the flight. The
        computation of a frame takes about 0.1 s.
    scale : float, optional
        Factor by which the drawn vehicle is larger than the true vehicle on the scale of the trajectory. `scale` must
        be more than zero. The default of `scale` is 1. If the true vehicle is smaller than 15 % of the flown distance,
        the default of `scale` enlarges the vehicle to 15 % of this distance.

    Returns
    -------
    Animation
        A matplotlib ``FuncAnimation`` whose method `save` also writes ``.gif`` and ``.html`` files.

    Raises
    ------
    ValueError
        Raised if `table` is not a flight with at least two rows, or if the motion in `motion` does not repeat. Raised
        if the flight has no vehicle and `vehicle` is not given, or if the vehicle has no wings. Raised if a view or a
        wing is unknown.
    """
    data = Data.of(table)
    for name in ("time_s", *GROUPS["position"].columns, *GROUPS["angle"].columns):
        if name not in data:
            raise ValueError(f"the table has no column `{name}`\nit must be a flight, such as from flapwing.fly")
    if len(data) < 2:
        raise ValueError(f"the flight has {len(data)} rows, but an animation needs at least two")
    if frames < 2:
        raise ValueError(f"an animation must have at least two frames, not {frames}")
    if scale is not None and not 0.0 < scale < float("inf"):
        raise ValueError(f"`scale` must be more than 0, not {scale}")
    if not views:
        raise ValueError(f"`views` is empty\nname at least one of {', '.join(VIEWS)}")
    for view in views:
        if view not in VIEWS:
            raise unknown("view", view, VIEWS)
    wings = _wings(data, vehicle, motion)
    with _style.applied():
        return Animation(_Scene(data, wings, list(views), frames, scale))


class _Wing(NamedTuple):
    """The positions of one wing during one cycle of its motion."""

    #: Duration of a cycle (s).
    seconds: float
    #: The shoulder relative to the centre of mass (m).
    shoulder: np.ndarray
    #: Corners of the wing relative to the centre of mass (m), in body axes: samples × 4 × 3.
    corners: np.ndarray


def _wings(data: Data, vehicle: Any, motion: Any) -> list[_Wing]:
    """Return the wings of a vehicle, with the positions of each wing during one cycle."""
    if vehicle is None:
        if "grid" not in data.meta:
            raise ValueError("the flight has no vehicle\ngive the vehicle with the argument `vehicle`")
        entries = tomllib.loads(data.meta["grid"])
        solver = _flapwing.settings()
        changed = {name: value for name, value in data.meta.get("keywords", {}).items() if name not in solver}
        vehicle = {**entries, "params": {**entries.get("params", {}), **changed}}
    grid = vehicle if isinstance(vehicle, _flapwing.Grid) else _flapwing.Grid(vehicle)
    wings = tomllib.loads(grid.text).get("vehicle", {}).get("wings", [])
    if not wings:
        raise ValueError("`vehicle` has one wing\nit must be a vehicle, such as a flapwing.Vehicle")
    sides = {wing["name"]: -1.0 if wing.get("mirrored") else 1.0 for wing in wings}
    values = {one["name"]: one["value"] for one in _flapwing.params(grid)}
    motions = several(motion, None)
    if motions is None:
        motions = dict.fromkeys(sides, Data.of(motion))
    for name in motions:
        if name not in sides:
            raise unknown("wing", name, sides)
    for name in sides:
        if name not in motions:
            raise ValueError(f"`motion` has no trajectory of the wing `{name}`\ngive one trajectory for each wing")
    return [_wing(name, side, values, motions[name]) for name, side in sides.items()]


def _wing(name: str, side: float, values: Mapping[str, Any], motion: Data) -> _Wing:
    """Return the positions of one wing during one cycle. `side` is -1 for a mirrored wing, and 1 for other wings."""

    def value(parameter: str) -> float:
        # A parameter of one wing that is not set is NaN.
        own = values.get(f"{name}_{parameter}", np.nan)
        return float(values.get(parameter, np.nan) if np.isnan(own) else own)

    length = value("wing_length")
    # The name of the chord depends on the model.
    chords = [value("mean_chord"), value("wing_area") / length, value("root_chord"), length / 3.0]
    chord = next(chord for chord in chords if chord > 0.0)
    cycle = Cycle(motion, _SAMPLES, None, None)
    stroke, tilt = np.radians(cycle.stroke), np.radians(cycle.pitch) * pitch_sign_of(motion, cycle)
    zero = np.zeros_like(stroke)
    span = np.column_stack([np.sin(stroke), np.cos(stroke), zero])
    ahead = np.column_stack([np.cos(stroke), -np.sin(stroke), zero])
    behind = -np.sin(tilt)[:, np.newaxis] * ahead - np.cos(tilt)[:, np.newaxis] * np.array([0.0, 0.0, 1.0])
    corners = np.stack([zero[:, np.newaxis] * span, length * span, length * span + chord * behind, chord * behind], 1)
    turned = _attitude(*(np.array([value(f"plane_{angle}")]) for angle in ("roll", "pitch", "yaw")))[0]
    shoulder = np.array([value(f"position_{axis}") for axis in "xyz"])
    about = np.array([value(f"about_{axis}") for axis in "xyz"])
    image = np.array([1.0, side, 1.0])
    return _Wing(cycle.seconds, shoulder * image - about, (shoulder + corners @ turned.T) * image - about)


def _attitude(roll: np.ndarray, pitch: np.ndarray, yaw: np.ndarray) -> np.ndarray:
    """Return the rotation matrices Rz(yaw) Ry(pitch) Rx(roll). A matrix converts vectors from body axes to fixed
    axes.
    """
    (sr, sp, sy), (cr, cp, cy) = ([function(angle) for angle in (roll, pitch, yaw)] for function in (np.sin, np.cos))
    rows = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    return np.moveaxis(np.array(rows), -1, 0)


class _Scene:
    """The figure of the animation, with the positions of the vehicle and its wings in all frames."""

    def __init__(self, data: Data, wings: list[_Wing], views: list[str], frames: int, scale: float | None) -> None:
        self.frames = frames
        time = data.numbers("time_s")
        self.times = np.linspace(time[0], time[-1], frames)
        position = np.column_stack([data.numbers(name) for name in GROUPS["position"].columns])
        angles = [data.numbers(name) for name in GROUPS["angle"].columns]
        self.path = 1e3 * self._at(time, position)
        # Interpolated matrices have no jumps, unlike angles.
        self.attitude = self._at(time, _attitude(*angles).reshape(-1, 9)).reshape(-1, 3, 3)

        beat = wings[0].seconds
        per_beat = beat * (frames - 1) / (time[-1] - time[0])
        self.slower = max(1.0, _FRAMES_OF_BEAT / per_beat)
        phases = np.outer(self.times - time[0], [1.0 / (self.slower * wing.seconds) for wing in wings])
        samples = np.round(phases * _SAMPLES).astype(int) % _SAMPLES
        reach = 1e3 * max(float(np.linalg.norm(wing.corners, axis=-1).max()) for wing in wings)
        flown = float(np.ptp(self.path, axis=0).max())
        self.scale = max(1.0, _SMALLEST * flown / (2.0 * reach)) if scale is None else float(scale)
        #: Corners of the wings in each frame (mm): frames × wings × 4 × 3.
        self.wings = np.stack([self._placed(wing.corners[samples[:, i]]) for i, wing in enumerate(wings)], 1)
        shoulders = np.mean([wing.shoulder for wing in wings], axis=0)
        if 1e3 * np.linalg.norm(shoulders) < 0.1 * reach:
            shoulders = np.array([0.0, 0.0, 1e-4 * reach])
        #: Ends of the body in each frame (mm): frames × 2 × 3.
        self.body = self._placed(np.broadcast_to([shoulders, -shoulders], (frames, 2, 3)))

        self.figure = _style.new_figure(0.6 + 4.2 * len(views), 4.6)
        middle = 0.5 * (self.path.min(axis=0) + self.path.max(axis=0))
        half = 0.5 * flown + 1.05 * self.scale * reach
        self.title = self.figure.suptitle(self._caption(0), fontsize="medium", x=0.02, ha="left")
        self.views = [
            _View(ax, *VIEWS[view], middle, half)
            for ax, view in zip(self.figure.subplots(1, len(views), squeeze=False)[0], views)
        ]
        # The layout is the same in all frames, and computing it takes longer than drawing a frame.
        self.figure.draw_without_rendering()
        self.figure.set_layout_engine(None)

    def _at(self, time: np.ndarray, columns: np.ndarray) -> np.ndarray:
        """Return columns of the flight, interpolated at the times of the frames."""
        return np.column_stack([np.interp(self.times, time, column) for column in columns.T])

    def _placed(self, points: np.ndarray) -> np.ndarray:
        """Convert points from body axes (m) to fixed axes (mm), for every frame."""
        turned = np.einsum("fij,fpj->fpi", self.attitude, points)
        return np.asarray(self.path[:, np.newaxis] + 1e3 * self.scale * turned)

    def _caption(self, frame: int) -> str:
        """Return the text above the picture: the time, and the factors by which the vehicle is larger and the wings are
        slower.
        """
        parts = [f"{self.times[frame]:.3f} s"]
        if self.slower > 1.0:
            parts.append(f"wing beats {self.slower:.2g} times slower")
        if self.scale != 1.0:
            parts.append(f"vehicle {self.scale:.2g} times larger")
        return ", ".join(parts)

    def draw(self, frame: int) -> list[Any]:
        """Move all moving parts of the picture to their positions in a frame, and return these parts."""
        self.title.set_text(self._caption(frame))
        return [self.title, *(part for view in self.views for part in view.draw(self, frame))]


class _View:
    """The axes that show the vehicle from one direction."""

    def __init__(
        self, ax: Axes, across: int, up: int, xlabel: str, ylabel: str, middle: np.ndarray, half: float
    ) -> None:
        self.axes = [across, up]
        ax.set_aspect("equal")
        ax.set_xlim(middle[across] - half, middle[across] + half)
        ax.set_ylim(middle[up] - half, middle[up] + half)
        ax.set_xlabel(xlabel)
        ax.set_ylabel(ylabel)
        self.wings = PolyCollection(
            [], facecolors=_style.SKY, edgecolors=_style.BLUE, alpha=0.6, linewidths=_style.width(0.6), zorder=2.5
        )
        ax.add_collection(self.wings)
        (self.path,) = ax.plot([], [], color=_style.VERMILLION, linewidth=_style.width(0.8))
        (self.body,) = ax.plot([], [], color=_style.ink(ax), linewidth=_style.width(2.5), solid_capstyle="round")
        (self.centre,) = ax.plot([], [], "o", color=_style.VERMILLION, markersize=_style.size(0.7), zorder=3.0)

    def draw(self, scene: _Scene, frame: int) -> list[Any]:
        """Move the moving parts of this view to their positions in a frame, and return these parts."""
        self.wings.set_verts(scene.wings[frame][..., self.axes])
        self.path.set_data(*scene.path[: frame + 1, self.axes].T)
        self.body.set_data(*scene.body[frame][:, self.axes].T)
        self.centre.set_data(*scene.path[frame : frame + 1, self.axes].T)
        return [self.wings, self.path, self.body, self.centre]
