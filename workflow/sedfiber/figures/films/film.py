"""A film: a background drawn once, what moves drawn over it frame by frame, and the animated WebP.

Frames are a fixed number of pixels and the coding is lossless, so the same input gives the same bytes.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import EllipseCollection
from matplotlib.figure import Figure
from matplotlib.style import context
from PIL import Image

from sedfiber.core.array_types import Array, Times
from sedfiber.core.atomic_file import replaced_when_done
from sedfiber.figures.falls import snapshots
from sedfiber.figures.style import RC_PARAMS

WIDTH = 5.4  # inches
DPI = 100  # pixels an inch
FRAMES = 72  # at most
_FRAME_MS, _LAST_FRAME_MS = 60, 1000
_CODING = {"lossless": True, "quality": 0, "method": 4}  # quality is effort here: more gains little
_LEVELS = (np.round(np.arange(256) / 17.0) * 17.0).astype(np.uint8)  # 16 a channel: half the file, a third of the time


@dataclass(frozen=True)
class Film:
    """``show(sample)`` sets the ``moving`` artists to a sample; ``samples`` lists one for each frame."""

    figure: Figure
    moving: Sequence[Artist]
    samples: Array
    show: Callable[[int], None]


def write_film(build: Callable[[], Film], path: Path) -> None:
    """Build the film in the style of the figures alone, draw its frames and write them; it loops."""
    with context(["default", RC_PARAMS]):
        frames = _draw_frames(build())
    durations = [_FRAME_MS] * (len(frames) - 1) + [_LAST_FRAME_MS]
    with replaced_when_done(path) as partial:
        frames[0].save(partial, "WEBP", save_all=True, append_images=frames[1:], duration=durations, loop=0, **_CODING)


def _draw_frames(film: Film) -> list[Image.Image]:
    """Draw all frames; the background is drawn once and copied back before each."""
    canvas = FigureCanvasAgg(film.figure)
    for artist in film.moving:
        artist.set_animated(True)
    canvas.draw()
    background = canvas.copy_from_bbox(film.figure.bbox)
    frames = []
    for sample in film.samples:
        film.show(int(sample))
        canvas.restore_region(background)
        for artist in film.moving:
            film.figure.draw_artist(artist)
        frames.append(Image.fromarray(_LEVELS[np.asarray(canvas.buffer_rgba())[..., :3]]))
    return frames


def blank_film(height: float) -> Figure:
    """A figure of the width of every film, ``height`` inches high, on which panels are placed by hand."""
    figure = Figure(figsize=(WIDTH, height), dpi=DPI)
    figure.set_layout_engine("none")
    return figure


def add_panel(figure: Figure, left: float, bottom: float, width: float, height: float, **look: Any) -> Axes:
    """Axes placed in inches."""
    across, up = figure.get_size_inches()
    return figure.add_axes((left / across, bottom / up, width / across, height / up), **look)


def frame_samples(t: Times, shapes: Array) -> Array:
    """A sample for each frame, evenly half by time and half by how far the beads move, none twice."""
    return np.unique(snapshots(t, shapes, min(FRAMES, len(t))))


class Beads:
    """Beads of ``diameter`` a, to scale wherever the panel's axes put them: ``colors`` is one or one a bead."""

    def __init__(self, axes: Axes, count: int, diameter: float, colors: object) -> None:
        size = np.full(count, diameter)  # one a bead, or Agg would move each to the next whole pixel
        look: dict[str, Any] = {
            "units": "xy",
            "facecolors": colors,
            "linewidths": 0.0,
            "offset_transform": axes.transData,
        }
        self.artist = EllipseCollection(size, size, np.zeros(count), offsets=np.zeros((count, 2)), **look)
        axes.add_collection(self.artist, autolim=False)

    def show(self, places: Array) -> None:
        """The beads at ``places`` (count, 2)."""
        self.artist.set_offsets(places)


class RunningCurve:
    """A curve of which the past is bold; the whole is pale behind it."""

    def __init__(self, axes: Axes, t: Times, values: Array, color: str, **look: Any) -> None:
        axes.plot(t, values, color=color, linewidth=0.9, alpha=0.3)
        (self.line,) = axes.plot([], [], color=color, linewidth=1.5, **look)
        self._t, self._values = t, values

    def show(self, sample: int) -> None:
        """The curve up to this sample."""
        self.line.set_data(self._t[: sample + 1], self._values[: sample + 1])
