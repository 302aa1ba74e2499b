"""The problem: a chain of beads let go at an angle, its centre bead, its path and its end."""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PatchCollection
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle

from sedfiber.core.array_types import Array
from sedfiber.core.errors import InputError
from sedfiber.figures.style import BLACK, COLUMN_WIDTH, GREY, SKY, VERMILION, letter_panel
from sedfiber.simulation.trajectory import Trajectory
from sedfiber.simulation.trajectory_file import read_trajectory

# all in L, in the sketch
DEPTHS = (0.48, 0.88)  # of the shapes between start and end
BREAK, LAST = 1.2, 1.74  # where a longer path is broken off, and the depth at which its end is drawn
_LENS = np.array([0.42, -0.28])  # where three beads are drawn larger
_LENS_RADIUS = 0.2
_HALF_WIDTH, _TOP = 0.64, 0.42  # of the sketch around the start's centre bead; a steep start needs more above

_ANGLE = 0.3  # radius of the arc of θ₀
_LINE = {"shrinkA": 0.0, "shrinkB": 0.0, "linewidth": 0.8}
_MEASURE: dict[str, Any] = {"arrowprops": _LINE | {"arrowstyle": "<->", "mutation_scale": 7.0}}
_ARROW: dict[str, Any] = {"arrowprops": _LINE | {"arrowstyle": "->", "mutation_scale": 7.0}}
_OFFSET: dict[str, Any] = {"textcoords": "offset points"}


def draw(fall: Path) -> Figure:
    """The fall of a trajectory file."""
    return draw_problem(read_trajectory(fall))


def draw_problem(run: Trajectory) -> Figure:
    """Left: what is defined, to one scale but for a break in the path. Right: the whole fall.

    Raises InputError for a run of several fibers, or one that does not settle.
    """
    if run.fibers.shape[1] != 1 or run.settling_time is None:
        raise InputError("input: the run must be of one fiber and end settled; give a fall of the study")
    fall = _Fall(run)
    figure = Figure(figsize=(COLUMN_WIDTH, 4.3))
    sketch, whole = figure.subplots(1, 2, width_ratios=[2.8, 0.6])
    _draw_fall(sketch, fall)
    _draw_start(sketch, fall)
    _draw_gravity(sketch)
    _magnify(sketch, fall)
    top = max(_TOP, fall.shapes[0, :, 1].max() + fall.radius)
    sketch.set(aspect="equal", xlim=(-_HALF_WIDTH, _HALF_WIDTH), ylim=(-LAST - 2.0 * fall.radius, top))
    sketch.set_axis_off()
    _draw_whole(whole, fall)
    letter_panel(sketch, "a", f"N = {run.n_beads} beads")
    letter_panel(whole, "b", "")
    return figure


class _Fall:
    """A run in the plane, seen from where its centre bead starts, lengths in L."""

    def __init__(self, run: Trajectory):
        self.path = (run.centre - run.centre[0])[:, :2] / run.length
        self.shapes = run.shape[..., :2] / run.length
        self.radius = 1.0 / run.length
        along = self.shapes[0, -1] - self.shapes[0, 0]
        self.along = along / np.hypot(*along)
        self.across = np.array([-self.along[1], self.along[0]])
        self.theta0 = float(np.arctan2(along[1], along[0]))

    def at_depth(self, depth: float) -> int:
        """The first sample with the centre bead that far below its start, or the last one."""
        deep = np.flatnonzero(-self.path[:, 1] >= depth)
        return int(deep[0]) if deep.size else len(self.path) - 1


def _draw_fall(axes: Axes, fall: _Fall) -> None:
    """The path, shapes along it and the terminal shape, pulled up when it is deeper than the sketch."""
    samples = [fall.at_depth(depth) for depth in DEPTHS]
    for sample in samples:
        axes.plot(*(fall.path[sample] + fall.shapes[sample]).T, color=GREY, linewidth=1.8, alpha=0.7)
        axes.plot(*fall.path[sample], "o", color=VERMILION, markersize=3.2)
    axes.annotate("$\\mathbf{c}(t)$", fall.path[samples[0]], (5, -9), **_OFFSET)
    end = _draw_path(axes, fall)
    _draw_beads(axes, end + fall.shapes[-1], fall.radius)
    axes.annotate("terminal\nshape", end + fall.shapes[-1, -1], (8, -16), **_OFFSET)


def _draw_path(axes: Axes, fall: _Fall) -> Array:
    """The centre bead's path, and where it ends in the sketch: a piece is left out if it would not fit."""
    left_out = -fall.path[-1, 1] - LAST
    if left_out <= 0.0:
        axes.plot(*fall.path.T, color=VERMILION, linewidth=0.9)
        return fall.path[-1]
    broken = fall.at_depth(BREAK)
    x, y = fall.path[broken]
    axes.plot(*fall.path[: broken + 1].T, color=VERMILION, linewidth=0.9)
    axes.plot([x, x], [y - 0.03, -LAST], color=VERMILION, linewidth=0.9)
    for stroke in (y, y - 0.03):
        axes.plot([x - 0.03, x + 0.03], [stroke - 0.01, stroke + 0.01], color=BLACK, linewidth=0.8)
    axes.annotate(f"{left_out:.1f} L left out", (x, y), (6, -3), **_OFFSET, fontsize=7.0)
    return np.array([x, -LAST])


def _draw_beads(axes: Axes, places: Array, radius: float) -> None:
    """Beads as circles of their size, the centre one in colour: ``places`` (N, 2)."""
    colors = [VERMILION if bead == len(places) // 2 else SKY for bead in range(len(places))]
    circles = [Circle(place, radius) for place in places]
    axes.add_collection(PatchCollection(circles, facecolor=colors, edgecolor=BLACK, linewidth=0.4, zorder=3))


def _draw_start(axes: Axes, fall: _Fall) -> None:
    """The straight fiber, its angle to the dashed x-axis and its length."""
    axes.plot([-0.08, 0.5], [0.0, 0.0], color=BLACK, linewidth=0.8, linestyle=(0, (4, 3)))
    _write(axes, (0.54, 0.0), "x")
    axes.add_patch(Arc((0.0, 0.0), 2 * _ANGLE, 2 * _ANGLE, theta2=np.degrees(fall.theta0), linewidth=0.8))
    middle = np.array([np.cos(0.5 * fall.theta0), np.sin(0.5 * fall.theta0)])
    _write(axes, (_ANGLE + 0.06) * middle, "θ₀")
    _draw_beads(axes, fall.shapes[0], fall.radius)
    ends = [end + (fall.radius + 0.05) * fall.across for end in (-0.5 * fall.along, 0.5 * fall.along)]
    axes.annotate("", *ends, **_MEASURE)
    along = {"rotation": np.degrees(fall.theta0), "rotation_mode": "anchor"}
    _write(axes, (fall.radius + 0.1) * fall.across, "L = 2aN", **along)
    axes.annotate("$\\mathbf{c}(0)$", (0.0, 0.0), (2, -19), **_OFFSET)


def _write(axes: Axes, place: Array | tuple[float, float], text: str, **look: Any) -> None:
    """Words around ``place`` (2,)."""
    axes.text(place[0], place[1], text, horizontalalignment="center", verticalalignment="center", **look)


def _draw_gravity(axes: Axes) -> None:
    axes.annotate("", (-0.55, 0.05), (-0.55, 0.35), arrowprops={"arrowstyle": "-|>", "linewidth": 1.2, "color": BLACK})
    _write(axes, (-0.46, 0.2), "$\\mathbf{F}_g$")


def _magnify(axes: Axes, fall: _Fall) -> None:
    """Three beads under a lens, with radius and bond."""
    n_beads = len(fall.shapes[0])
    first = min(n_beads // 2 + 2, n_beads - 3)
    beads = fall.shapes[0, first : first + 3]
    seen = 3.4 * fall.radius
    scale = _LENS_RADIUS / seen
    for middle, radius in ((beads[1], seen), (_LENS, _LENS_RADIUS)):
        axes.add_patch(Circle(tuple(middle), radius, facecolor="none", edgecolor=GREY, linewidth=0.7, zorder=4))
    sight = (_LENS - beads[1]) / np.hypot(*(_LENS - beads[1]))
    for aside in (np.array([-sight[1], sight[0]]), np.array([sight[1], -sight[0]])):
        axes.plot(*np.transpose([beads[1] + seen * aside, _LENS + _LENS_RADIUS * aside]), color=GREY, linewidth=0.5)
    places = _LENS + scale * (beads - beads[1])
    radius = scale * fall.radius
    circles = [Circle(place, radius) for place in places]
    axes.add_collection(PatchCollection(circles, facecolor=SKY, edgecolor=BLACK, linewidth=0.6, zorder=3))
    side = -1.35 * radius * fall.across
    axes.annotate("", places[0] + side, places[1] + side, **_MEASURE, zorder=5)
    _write(axes, places[:2].mean(axis=0) + 1.75 * side, "2a", fontsize=7.0)
    axes.annotate("", places[2] + radius * fall.across, places[2], **_ARROW, zorder=5)
    _write(axes, places[2] + 1.5 * radius * fall.across, "a", zorder=5, fontsize=7.0)


def _draw_whole(axes: Axes, fall: _Fall) -> None:
    """Start, path and end where they are."""
    axes.plot(*fall.path.T, color=VERMILION, linewidth=0.8)
    for sample in (0, len(fall.path) - 1):
        axes.plot(*(fall.path[sample] + fall.shapes[sample]).T, color=BLACK, linewidth=1.0)
    axes.set(aspect="equal", xticks=[], ylabel="y / L (the whole fall, to scale)")
    axes.margins(x=0.1, y=0.01)
