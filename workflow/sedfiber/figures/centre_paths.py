"""Paths of the centre bead at one ℬ, from every angle: to scale, and how far each drifts."""

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sedfiber.core.array_types import Array
from sedfiber.figures.falls import falls_where, plane_path
from sedfiber.figures.style import B_SYMBOL, COLUMN_WIDTH, GREY, SEQUENTIAL, letter_panel, place_legend
from sedfiber.reduced.dataset_file import read_falls
from sedfiber.simulation.trajectory import Trajectory

MARKS = {"start": "v", "end": "x"}
_ABOVE: dict[str, Any] = {"textcoords": "offset points", "horizontalalignment": "right", "fontsize": 7.0}


def draw(dataset: Path, B: float) -> Figure:
    """The falls of a data set at one ℬ."""
    return draw_centre_paths(falls_where(read_falls(dataset), "B", B))


def draw_centre_paths(falls: list[Trajectory]) -> Figure:
    """Above: the paths side by side, axes equal. Below: drift against depth, the drift stretched."""
    figure = Figure(figsize=(COLUMN_WIDTH, 5.6))
    upper, lower = figure.subplots(2, 1, height_ratios=[3.2, 2.0])
    _draw_side_by_side(upper, falls)
    _draw_drifts(lower, falls)
    letter_panel(upper, "a", f"{B_SYMBOL} = {falls[0].B:g}: to scale, starts moved apart")
    letter_panel(lower, "b", "the same colours; drift stretched")
    place_legend(figure, upper, columns=2)
    return figure


def _draw_side_by_side(axes: Axes, falls: list[Trajectory]) -> None:
    """Every path begins at y = 0, below its k; all together are as wide as the longest is deep."""
    paths = [plane_path(fall) - plane_path(fall)[0] for fall in falls]
    spacing = -min(path[:, 1].min() for path in paths) / max(len(falls) - 1, 1)
    for place, (fall, color) in enumerate(_colored(falls)):
        path = paths[place] + [place * spacing, 0.0]
        _draw_path(axes, path, color)
        name = f"k = {fall.angle_index}" if place == 0 else f"{fall.angle_index}"
        axes.annotate(name, path[0], (2.5 * len(str(fall.angle_index)), 5.0), **_ABOVE)
    for label, marker in MARKS.items():
        axes.plot([], [], marker, color=GREY, label=label)
    axes.margins(x=0.12, y=0.1)
    axes.set(aspect="equal", xlabel="x / a", ylabel="y / a")


def _draw_drifts(axes: Axes, falls: list[Trajectory]) -> None:
    """x from the start, over the depth."""
    for fall, color in _colored(falls):
        path = plane_path(fall) - plane_path(fall)[0]
        _draw_path(axes, path[:, ::-1] * [-1.0, 1.0], color)
    axes.set(xlabel="depth (y(0) − y) / a", ylabel="drift (x − x(0)) / a")


def _colored(falls: list[Trajectory]) -> list[tuple[Trajectory, tuple]]:
    return [(fall, SEQUENTIAL(place / max(len(falls) - 1, 1))) for place, fall in enumerate(falls)]


def _draw_path(axes: Axes, path: Array, color: tuple) -> None:
    """A line from its start mark to its end mark: ``path`` (T, 2)."""
    axes.plot(*path.T, color=color)
    for sample, marker in zip((0, -1), MARKS.values(), strict=True):
        axes.plot(*path[sample], marker, color=color)
