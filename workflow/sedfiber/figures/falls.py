"""Falls as pictures: which samples to show, where each stands, in which colour.

A shape is the fiber seen from its centre bead; a row of shapes has them side by side, each at its own offset.
"""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colorbar import Colorbar
from matplotlib.colors import PowerNorm
from matplotlib.figure import Figure

from sedfiber.core.array_types import Array, Times
from sedfiber.core.errors import InputError
from sedfiber.figures.style import SEQUENTIAL
from sedfiber.simulation.trajectory import Trajectory

TIME_NORM = PowerNorm(0.5, 0.0, 1.0)  # of t/T: most of what happens happens early
TIME_TICKS = (0.0, 0.05, 0.2, 0.5, 1.0)


def plane_path(fall: Trajectory) -> Array:
    """The centre bead's path in the plane, (T, 2)."""
    return fall.centre[:, :2]


def plane_shapes(fall: Trajectory) -> Array:
    """The fiber in the plane, seen from its centre bead, (T, N, 2)."""
    return fall.shape[..., :2]


def settled_at(fall: Trajectory) -> int:
    """T in a/U_s: it lies in the last interval between samples, which is half a unit long."""
    return int(fall.t[-1])


def falls_where(falls: Sequence[Trajectory], key: str, value: float) -> list[Trajectory]:
    """The falls whose ``B`` or ``angle_index`` is ``value``; InputError, listing all there are, when none is."""
    chosen = [fall for fall in falls if getattr(fall, key) == value]
    if not chosen:
        there = sorted({getattr(fall, key) for fall in falls})
        raise InputError(f"{key}: {value:g} is not in the data set; give one of {', '.join(f'{v:g}' for v in there)}")
    return chosen


def snapshots(t: Times, shapes: Array, count: int) -> Array:
    """``count`` indices of samples, first and last among them: ``t`` (T,), ``shapes`` (T, N, d).

    Spaced evenly in ½ t/T + ½ s/S, where s is the root-mean-square path of the beads up to t: by
    time alone a quick turn would fall between two snapshots, by path alone a slow one would look quick.
    """
    steps = np.sqrt((np.diff(shapes, axis=0) ** 2).sum(axis=-1).mean(axis=-1))
    path = np.concatenate([[0.0], np.cumsum(steps)])
    pace = t / max(t[-1], 1e-300) + path / max(path[-1], 1e-300)
    return np.searchsorted(pace, np.linspace(0.0, pace[-1], count) * (1.0 - 1e-12))


def time_colors(t: Times) -> Array:
    """Colours (T, 4) from the first time to the last."""
    return SEQUENTIAL(TIME_NORM(np.asarray(t) / max(t[-1], 1e-300)))


def draw_shapes(
    axes: Axes, shapes: Iterable[Array], offsets: Iterable, colors: Iterable, linewidth: float = 1.2, **look: Any
) -> None:
    """Each shape (N, 2) as a line, moved by its offset (2,); lengths in a."""
    for shape, offset, color in zip(shapes, offsets, colors, strict=True):
        axes.plot(*(shape + np.asarray(offset)).T, color=color, linewidth=linewidth, solid_capstyle="round", **look)


def add_time_bar(figure: Figure, panels: Sequence[Axes], **place: Any) -> Colorbar:
    """The colours of `time_colors` as a bar beside or below the panels."""
    bar = figure.colorbar(ScalarMappable(TIME_NORM, SEQUENTIAL), ax=panels, ticks=TIME_TICKS, format="%g", **place)
    bar.ax.minorticks_off()
    bar.set_label("t / T")
    return bar
