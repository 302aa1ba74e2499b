"""A scene's run: snapshots in space, and what changes along the way."""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon

from sedfiber.core.array_types import Array
from sedfiber.figures.falls import snapshots
from sedfiber.figures.style import BLACK, BLUE, GREY, ORANGE, PAGE_WIDTH, PURPLE, VERMILION, place_legend
from sedfiber.simulation.trajectory import Trajectory
from sedfiber.simulation.trajectory_file import read_trajectory

SNAPSHOTS = 8
FIBER_COLORS = (BLUE, VERMILION, ORANGE, PURPLE)
AXIS_STYLES: dict[str, Any] = dict(zip("xyz", ("-", "--", ":"), strict=True))
_MARGIN = 4.0  # a, around the beads
_STILL = 2.0  # fiber lengths: a run that stays within these is drawn in one fixed frame
_LEAST_EXTENT = 1e-8  # of L: what reaches less far is flat up to rounding
_DECADES = 100.0  # from the least to the largest extent out of the plane: more takes a logarithmic axis
_FLATTEST = 0.55  # height over width of a frame that still has room for the words beside it
_FRAME = PAGE_WIDTH / SNAPSHOTS  # inches


def draw(run: Path, scene: str) -> Figure:
    """The run of a trajectory file, titled by the name of its scene."""
    return draw_scene(read_trajectory(run), scene.replace("_", " "))


def draw_scene(run: Trajectory, title: str) -> Figure:
    """A row of snapshots, seen along z and, in volume, along y too; below, size and place over time."""
    views = [(0, 1)] if run.metadata["scene"]["space"] == "plane" else [(0, 1), (0, 2)]
    flat = [Frames(run.fibers[..., view]) for view in views]
    heights = [_FRAME * frames.shape for frames in flat]
    figure = Figure(figsize=(PAGE_WIDTH, sum(heights) + 0.25 * len(views) + 2.6))
    halves = figure.add_gridspec(2, 1, height_ratios=[sum(heights) + 0.25 * len(views), 2.0])
    grid = halves[0].subgridspec(len(views), SNAPSHOTS, height_ratios=heights)
    samples = snapshots(run.t, flat[0].seen.reshape(len(run.t), -1, 2), SNAPSHOTS)
    for k, (view, frames) in enumerate(zip(views, flat, strict=True)):
        row = [figure.add_subplot(grid[k, column]) for column in range(SNAPSHOTS)]
        _draw_snapshots(row, run, frames, view, samples, with_times=k == 0)
    history = halves[1].subgridspec(1, 2)
    left, right = (figure.add_subplot(history[column]) for column in range(2))
    _draw_history(left, right, run)
    place_legend(figure, left, right, columns=5)
    figure.suptitle(title, fontsize="medium")
    return figure


class Frames:
    """One view (T, fibers, N, 2) of a run: where each frame's middle is, and how far all of them reach."""

    def __init__(self, flat: Array):
        self.flat = flat
        length = 2.0 * flat.shape[2]
        self.middle = flat.mean(axis=(1, 2))
        if (np.ptp(flat, axis=(0, 1, 2)) < _STILL * length).all():
            still = 0.5 * (flat.max(axis=(0, 1, 2)) + flat.min(axis=(0, 1, 2)))
            self.middle = np.broadcast_to(still, self.middle.shape)
        self.seen = flat - self.middle[:, None, None]
        self.reach = np.maximum(np.abs(self.seen).max(axis=(0, 1, 2)) + _MARGIN, 0.15 * length)
        self.reach[1] = max(self.reach[1], _FLATTEST * self.reach[0])
        self.shape = float(self.reach[1] / self.reach[0])
        if self.shape > 1.6:  # no frame is drawn taller than that
            self.reach[0], self.shape = self.reach[1] / 1.6, 1.6


def _draw_snapshots(
    row: list[Axes], run: Trajectory, frames: Frames, view: tuple, samples: Array, with_times: bool
) -> None:
    """Frames of one size at one scale, without ticks; the words beside the first tell the scale."""
    for axes, k in zip(row, samples, strict=True):
        for fiber, color in zip(frames.flat[k], FIBER_COLORS * len(frames.flat[k]), strict=False):
            axes.plot(*fiber.T, color=color, linewidth=1.6, solid_capstyle="round")
            axes.plot(*fiber[0], color=color, marker="o", markersize=2.8)
        x, y = frames.middle[k]
        axes.set(xlim=(x - frames.reach[0], x + frames.reach[0]), ylim=(y - frames.reach[1], y + frames.reach[1]))
        axes.set(aspect="equal", xticks=[], yticks=[])
        draw_wall(axes, run.metadata["scene"].get("wall"), view)
        if with_times:
            axes.set_title(f"t = {run.t[k]:.4g}", fontsize=7)
    row[0].set_ylabel(f"{'xyz'[view[1]]} over x,\n{2.0 * frames.reach[0]:.0f} a wide", fontsize=6.5)


def draw_wall(axes: Axes, wall: dict | None, view: tuple) -> None:
    """The solid behind the wall, where the wall is seen edge-on."""
    if wall is None:
        return
    point, normal = (np.array(wall[key])[list(view)] for key in ("point", "normal"))
    if np.hypot(*normal) < 0.999:
        return
    along, behind = np.array([-normal[1], normal[0]]) * 1e4, -1e4 * normal
    corners = [point - along, point + along, point + along + behind, point - along + behind]
    axes.add_patch(Polygon(corners, facecolor="#d0d0d0", edgecolor=GREY, zorder=0.5))


def _draw_history(left: Axes, right: Axes, run: Trajectory) -> None:
    """Left: end-to-end distance, and the mean height where it changes; right: extents along the axes."""
    _draw_ends(left, run)
    _draw_extents(right, run)
    for axes in (left, right):
        axes.set_xlabel("time / (a/U$_s$)")


def _draw_ends(axes: Axes, run: Trajectory) -> None:
    fibers = run.fibers
    for k, color in zip(range(fibers.shape[1]), FIBER_COLORS * fibers.shape[1], strict=False):
        name = f"fiber {k + 1}" if fibers.shape[1] > 1 else "fiber"
        ends = np.linalg.norm(fibers[:, k, -1] - fibers[:, k, 0], axis=-1) / run.length
        axes.plot(run.t, ends, color=color, label=name)
    axes.set(ylabel="end-to-end distance / L", ylim=(0.0, 1.05))
    height = fibers.mean(axis=(1, 2))[:, 1]
    if np.ptp(height) > 1.0:
        other = axes.twinx()
        other.grid(False)
        other.plot(run.t, height, color=BLACK, linewidth=0.8, linestyle="-.")
        other.set_ylabel("mean height / a (dash-dotted)")


def _draw_extents(axes: Axes, run: Trajectory) -> None:
    """Along each axis that a fiber reaches along; logarithmic where it leaves the plane from next to nothing."""
    extents = np.ptp(run.fibers, axis=2) / run.length  # (T, fibers, 3)
    out_of_plane = extents[..., 2][extents[..., 2] > _LEAST_EXTENT]
    floor = 0.0
    if out_of_plane.size and out_of_plane.max() > _DECADES * out_of_plane.min():
        floor = out_of_plane.min()
        axes.set_yscale("log")
    for i, (axis, style) in enumerate(AXIS_STYLES.items()):
        reaching = extents[..., i].max(axis=0) > _LEAST_EXTENT
        for k in np.flatnonzero(reaching):
            color = FIBER_COLORS[k % len(FIBER_COLORS)]
            axes.plot(run.t, np.maximum(extents[:, k, i], floor), color=color, linestyle=style)
        if reaching.any():
            axes.add_line(Line2D([], [], color=GREY, linestyle=style, label=f"extent along {axis}"))
    axes.set_ylabel("extent / L")
    if not floor:
        axes.set_ylim(bottom=0.0)
