"""The falls of one ℬ from every angle: how the fiber turns and bends, always to the same shape."""

import math
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sedfiber.figures.falls import (
    add_time_bar,
    draw_shapes,
    falls_where,
    plane_shapes,
    settled_at,
    snapshots,
    time_colors,
)
from sedfiber.figures.style import B_SYMBOL, BLACK, PAGE_WIDTH, VERMILION
from sedfiber.reduced.dataset_file import read_falls
from sedfiber.simulation.trajectory import Trajectory
from sedfiber.study.angles import ANGLES_PER_HALF_TURN

SNAPSHOTS = 12  # of each fall, the first and the last among them
COLUMNS = 6
_MARGIN = 2.5  # a, around the shapes


def draw(dataset: Path, B: float) -> Figure:
    """The falls of a data set at one ℬ."""
    return draw_shapes_by_angle(falls_where(read_falls(dataset), "B", B))


def draw_shapes_by_angle(falls: list[Trajectory]) -> Figure:
    """A panel for each angle, all at one scale: shapes over one another, seen from the centre bead."""
    columns = min(COLUMNS, len(falls))
    rows = math.ceil(len(falls) / columns)
    figure = Figure(figsize=(PAGE_WIDTH, 0.6 + 1.3 * rows * COLUMNS / columns))
    panels = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    for axes in panels.flat[len(falls) :]:
        axes.set_axis_off()
    for axes, fall in zip(panels.flat, falls, strict=False):
        _draw_fall(axes, fall)
    _label(figure, panels, falls[0])
    return figure


def _draw_fall(axes: Axes, fall: Trajectory) -> None:
    """Shapes coloured by their times, the start dashed, the last one thick."""
    shapes = plane_shapes(fall)
    chosen = snapshots(fall.t, shapes, SNAPSHOTS)
    middle = chosen[1:-1]
    axes.plot(*shapes[0].T, color=BLACK, linewidth=1.0, linestyle=(0, (3, 1.5)), label="start")
    draw_shapes(axes, shapes[middle], [(0.0, 0.0)] * len(middle), time_colors(fall.t)[middle])
    axes.plot(*shapes[-1].T, color=VERMILION, linewidth=1.8, label="terminal shape", solid_capstyle="round")
    degrees = 180.0 * fall.angle_index / ANGLES_PER_HALF_TURN
    axes.set_title(f"k = {fall.angle_index}, θ₀ = {degrees:g}°\nT ≈ {settled_at(fall)} a/U$_s$", fontsize=7.0)


def _label(figure: Figure, panels: np.ndarray, first: Trajectory) -> None:
    """One scale for all panels, the words at the edges, the keys below."""
    reach = 0.5 * first.length + _MARGIN
    panels[0, 0].set(xlim=(-reach, reach), ylim=(-reach, reach))
    for axes in panels.flat:
        axes.set_aspect("equal")
    figure.supylabel("y − y of the centre bead / a", fontsize="medium")
    figure.supxlabel("x − x of the centre bead / a", fontsize="medium")
    add_time_bar(figure, list(panels.flat), pad=0.01, aspect=35)
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower right", ncols=2)
    figure.suptitle(f"{B_SYMBOL} = {first.B:g}", fontsize="medium")
