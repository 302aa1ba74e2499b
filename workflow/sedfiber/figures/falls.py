"""Falls as pictures: which samples to show, where each stands, in which colour.

A fall is one trajectory of a data set. A shape is the fiber seen from its centre bead; a row of
shapes has them side by side, each at its own offset.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colorbar import Colorbar
from matplotlib.colors import PowerNorm
from matplotlib.figure import Figure

from sedfiber.core.array_types import Array, History, Times
from sedfiber.core.errors import InputError
from sedfiber.core.parquet_file import bead_count, coordinate_names
from sedfiber.figures.style import SEQUENTIAL

KEYS = ("split", "B", "angle_index", "theta0", "t")
TIME_NORM = PowerNorm(0.5, 0.0, 1.0)  # of t/T: most of what happens happens early
TIME_TICKS = (0.0, 0.05, 0.2, 0.5, 1.0)


@dataclass(frozen=True)
class Fall:
    """One trajectory: ``t`` (T,) in a/U_s, ``positions`` (T, N, 3) in a, true or forecast."""

    split: str
    B: float
    angle_index: int
    theta0: float
    t: Times
    positions: History

    @property
    def length(self) -> float:
        """L = 2N, in a."""
        return 2.0 * self.positions.shape[1]

    @property
    def settled(self) -> int:
        """T in a/U_s, rounded: it lies in the last interval between samples, which is half a unit long."""
        return int(self.t[-1])

    @property
    def centre(self) -> Array:
        """The centre bead's path in the plane, (T, 2)."""
        return self.positions[:, self.positions.shape[1] // 2, :2]

    @property
    def shapes(self) -> Array:
        """The fiber in the plane, seen from its centre bead, (T, N, 2)."""
        return self.positions[..., :2] - self.centre[:, None]


def read_falls(path: Path) -> list[Fall]:
    """Every trajectory of a data set or of forecasts of it, sorted by (ℬ, angle_index).

    Raises InputError when the file is missing, unreadable, empty or lacks a column.
    """
    try:
        table = pq.read_table(path, page_checksum_verification=True).to_pandas()
    except (OSError, ValueError, pa.ArrowException) as error:
        raise InputError(f"input: cannot read {str(path)!r} as Parquet ({str(error).splitlines()[0]})") from None
    missing = [name for name in KEYS if name not in table]
    if missing or not bead_count(list(table.columns)):
        raise InputError(f"input: {str(path)!r} lacks the columns {', '.join(missing) or 'x0, y0, z0, … of all beads'}")
    if table.empty:
        raise InputError(f"input: {str(path)!r} has no rows")
    return [_fall(group) for _, group in table.groupby(["B", "angle_index"], sort=True)]


def _fall(group: pd.DataFrame) -> Fall:
    first = group.iloc[0]
    flat = group[coordinate_names(bead_count(list(group.columns)))].to_numpy(dtype=float)
    return Fall(
        split=str(first["split"]),
        B=float(first["B"]),
        angle_index=int(first["angle_index"]),
        theta0=float(first["theta0"]),
        t=group["t"].to_numpy(dtype=float),
        positions=flat.reshape(len(group), -1, 3),
    )


def falls_where(falls: Sequence[Fall], key: str, value: float) -> list[Fall]:
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
    axes: Axes, shapes: Iterable[Array], offsets: Iterable, colors: Iterable, linewidth: float = 1.2, **look: object
) -> None:
    """Each shape (N, 2) as a line, moved by its offset (2,); lengths in a."""
    for shape, offset, color in zip(shapes, offsets, colors, strict=True):
        axes.plot(*(shape + np.asarray(offset)).T, color=color, linewidth=linewidth, solid_capstyle="round", **look)


def add_time_bar(figure: Figure, panels: Sequence[Axes], **place: object) -> Colorbar:
    """The colours of `time_colors` as a bar beside or below the panels."""
    bar = figure.colorbar(ScalarMappable(TIME_NORM, SEQUENTIAL), ax=panels, ticks=TIME_TICKS, format="%g", **place)
    bar.ax.minorticks_off()
    bar.set_label("t / T")
    return bar
