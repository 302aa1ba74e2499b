"""A scene's run: fibers and wall close up, seen along z and in volume along y too; and how extended each fiber is."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from sedfiber.core.array_types import Array
from sedfiber.figures.films.film import WIDTH, Beads, Film, RunningCurve, add_panel, blank_film, frame_samples
from sedfiber.figures.scene import FIBER_COLORS, Frames, draw_wall
from sedfiber.figures.style import BLACK
from sedfiber.simulation.trajectory import Trajectory

_VIEWS = ((0, 1), (0, 2))  # axes that are seen, in plane only the first
_WIDEST, _TALLEST = 4.9, 3.5  # inches, of all views together
_GAP = 0.25  # inches, between two views
_CURVES = (0.55, 0.42, 4.6, 0.75)  # left, bottom, width and height of the lower panel, in inches
_FLOOR, _HEAD = 1.45, 0.48  # inches, below and above the views


def film_scene(run: Trajectory, title: str) -> Film:
    """Above: views that follow the fibers, beads to scale, the first of each fiber black, the wall grey.
    Below: end-to-end distance over L."""
    views = _VIEWS if run.metadata["scene"]["space"] != "plane" else _VIEWS[:1]
    frames = [Frames(run.fibers[..., view]) for view in views]
    sizes = _sizes(frames)
    figure = blank_film(_FLOOR + sizes[:, 1].max() + _HEAD)
    panels = _place_views(figure, sizes)
    wall = run.metadata["scene"].get("wall")
    drawn = [_View(*parts, wall) for parts in zip(panels, frames, views, strict=True)]
    curves = _draw_extension(add_panel(figure, *_CURVES), run)
    top = 1.0 - 0.18 / figure.get_figheight()
    figure.text(0.02, top, title, fontsize=8.5)
    clock = figure.text(0.98, top, "", fontsize=8.5, horizontalalignment="right")
    height = run.fibers[..., 1].mean(axis=(1, 2))

    parts: list[Any] = [*drawn, *curves]

    def show(sample: int) -> None:
        clock.set_text(f"t = {run.t[sample]:.1f} a/U$_s$,  mean height {round(height[sample])} a")
        for part in parts:
            part.show(sample)

    moving = [clock, *(artist for view in drawn for artist in view.artists), *(curve.line for curve in curves)]
    return Film(figure, moving, _samples(run, frames), show)


class _View:
    """One view: everything is drawn relative to the frame's middle, so that the axes stand still."""

    def __init__(self, axes: Axes, frames: Frames, view: tuple[int, int], wall: dict | None) -> None:
        self._frames = frames
        _, n_fibers, n_beads, _ = frames.seen.shape
        (across, up), words = frames.reach, f"{'xyz'[view[1]]} over x, {2.0 * frames.reach[0]:.0f} a wide"
        axes.set(xlim=(-across, across), ylim=(-up, up), xticks=[], yticks=[])
        axes.set_title(words, loc="left", fontsize=7.5)
        draw_wall(axes, wall, view)
        self._walls = [(patch, patch.get_xy()) for patch in axes.patches if isinstance(patch, Polygon)]
        self._beads = Beads(axes, n_fibers * n_beads, 2.0, _bead_colors(n_fibers, n_beads))
        self.artists = [*axes.patches, self._beads.artist]

    def show(self, sample: int) -> None:
        """Beads and wall at this sample."""
        for patch, corners in self._walls:
            patch.set_xy(corners - self._frames.middle[sample])
        self._beads.show(self._frames.seen[sample].reshape(-1, 2))


def _bead_colors(n_fibers: int, n_beads: int) -> list[str]:
    colors = (FIBER_COLORS * n_fibers)[:n_fibers]
    return [color for own in colors for color in (BLACK, *[own] * (n_beads - 1))]


def _sizes(frames: list[Frames]) -> Array:
    """Width and height of each view in inches, (views, 2), all at one scale."""
    spans = 2.0 * np.array([one.reach for one in frames])
    room = _WIDEST - _GAP * (len(frames) - 1)
    return spans * min(room / spans[:, 0].sum(), _TALLEST / spans[:, 1].max())


def _place_views(figure: Figure, sizes: Array) -> list[Axes]:
    """Side by side in the middle of the width, their upper edges at one height."""
    left = 0.5 * (WIDTH - sizes[:, 0].sum() - _GAP * (len(sizes) - 1))
    edges = left + np.cumsum(np.concatenate([[0.0], sizes[:-1, 0] + _GAP]))
    top = _FLOOR + sizes[:, 1].max()
    return [add_panel(figure, edge, top - size[1], *size) for edge, size in zip(edges, sizes, strict=True)]


def _draw_extension(axes: Axes, run: Trajectory) -> list[RunningCurve]:
    ends = np.linalg.norm(run.fibers[:, :, -1] - run.fibers[:, :, 0], axis=-1).T / run.length
    last = max(run.t[-1], run.t[0] + 1e-9)  # a run of one sample has no duration
    axes.set(xlim=(run.t[0], last), ylim=(0.0, 1.05), xlabel="time / (a/U$_s$)")
    axes.set_title("end-to-end distance / L", loc="left", fontsize=7.5, pad=3.0)
    colors = FIBER_COLORS * len(ends)
    return [RunningCurve(axes, run.t, own, color) for own, color in zip(ends, colors, strict=False)]


def _samples(run: Trajectory, frames: list[Frames]) -> Array:
    """A sample for each frame of the film, by the motion within all views."""
    seen = np.concatenate([one.seen.reshape(len(run.t), -1, 2) for one in frames], axis=1)
    return frame_samples(run.t, seen)
