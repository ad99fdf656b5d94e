"""Animations that you can save as files or show in notebooks."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, Protocol

from matplotlib.animation import FuncAnimation, HTMLWriter
from matplotlib.figure import Figure


class Scene(Protocol):
    """A figure for an animation, with parts that move from frame to frame."""

    figure: Figure
    #: Number of frames.
    frames: int

    def draw(self, frame: int) -> list[Any]:
        """Move all moving parts of the picture to their positions in a frame, and return these parts."""


class Animation(FuncAnimation):
    """An animation that a notebook shows with buttons to play and stop."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        super().__init__(scene.figure, scene.draw, frames=scene.frames, interval=40, blit=False)

    def save(  # type: ignore[override]  # the rest goes through `options`
        self, filename: str | os.PathLike[str], writer: Any = None, **options: Any
    ) -> None:
        """Save the animation.

        Parameters
        ----------
        filename : path
            The path of the file. The name must end in ``.gif``, ``.html`` (a page with buttons), or the ending of a
            format that the argument `writer` supports. By default, matplotlib writes formats other than ``.gif`` and
            ``.html`` with ffmpeg.
        writer, **options
            Arguments for the method ``Animation.save`` of matplotlib, such as ``fps`` and ``dpi``.
        """
        ending = Path(filename).suffix.lower()
        if writer is None and ending == ".gif":
            writer = "pillow"
        elif writer is None and ending in (".html", ".htm"):
            # matplotlib rejects `fps` beside a writer, so the writer takes it.
            writer = HTMLWriter(fps=options.pop("fps", 25), embed_frames=True, default_mode="loop")
        # The writer draws each frame. Without this, matplotlib draws each frame twice.
        canvas: Any = self._scene.figure.canvas
        canvas.draw_idle = lambda: None
        try:
            super().save(os.fspath(filename), writer=writer, **options)
        finally:
            del canvas.draw_idle

    def _repr_html_(self) -> str:
        return self.to_jshtml()
