"""The falls from one angle at every ℬ: shapes, regimes, and the numbers that tell the regimes apart."""

from itertools import groupby, pairwise
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sedfiber.core.array_types import Array
from sedfiber.core.errors import InputError
from sedfiber.core.validation import one_of
from sedfiber.figures.falls import (
    add_time_bar,
    draw_shapes,
    falls_where,
    plane_shapes,
    settled_at,
    snapshots,
    time_colors,
)
from sedfiber.figures.style import (
    B_SYMBOL,
    BLACK,
    BLUE,
    GREY,
    ORANGE,
    PAGE_WIDTH,
    VERMILION,
    letter_panel,
    place_legend,
)
from sedfiber.figures.table_input import select_columns
from sedfiber.reduced.dataset_file import read_falls
from sedfiber.simulation.trajectory import Trajectory
from sedfiber.study.angles import ANGLES_PER_HALF_TURN
from sedfiber.study.regimes import REGIMES

SNAPSHOTS = 9
GAP = 0.08  # L, between shapes
COLORS = dict(zip(REGIMES, (BLUE, ORANGE, VERMILION), strict=True))
# column of the table: label, colour, marker, share of it that is shown
ANGLES = {
    "turned_whole": ("turn as a whole", BLUE, "o", 1.0),
    "bend_terminal": ("bend of each side, terminal", ORANGE, "s", 0.5),
    "turned_sliding": ("turn by sliding along itself", VERMILION, "^", 1.0),
}
_SHAPES_WIDTH = 3.75  # inches, a little less than there is: equal axes then leave space beside the shapes
_BAR = -0.19  # of the width of the shapes' panel: the regimes' bars, left of the words


def draw(dataset: Path, regimes: pd.DataFrame, angle_index: int) -> Figure:
    """The falls of a data set from one angle θ₀ = kπ/48."""
    return draw_shapes_by_flexibility(falls_where(read_falls(dataset), "angle_index", angle_index), regimes)


def draw_shapes_by_flexibility(falls: list[Trajectory], table: pd.DataFrame) -> Figure:
    """A row for each ℬ: shapes from start to end, angles by which the fiber turned and bent, slide once folded."""
    rows = _rows_of(falls, table)
    grid = _Grid(falls)
    figure = Figure(figsize=(PAGE_WIDTH, 1.5 + _SHAPES_WIDTH * grid.height / grid.width))
    shapes, angles, slides = figure.subplots(1, 3, sharey=True, width_ratios=[4.0, 1.2, 0.85])
    _draw_shapes(shapes, falls, grid)
    _draw_angles(angles, rows, grid)
    _draw_slides(slides, rows, grid)
    _name_regimes(shapes, rows["regime"], grid)
    for axes in (shapes, angles, slides):
        _part_regimes(axes, rows["regime"], grid)
    degrees = 180.0 * falls[0].angle_index / ANGLES_PER_HALF_TURN
    letter_panel(shapes, "a", f"shapes, θ₀ = {degrees:g}° (k = {falls[0].angle_index}), T in a/U$_s$")
    letter_panel(angles, "b", "angles")
    letter_panel(slides, "c", "slide")
    add_time_bar(figure, [shapes], location="bottom", shrink=0.7, aspect=35, pad=0.03)
    place_legend(figure, shapes, angles, slides, columns=3)
    return figure


class _Grid:
    """Where each shape stands, in a: one row a fall, the first on top, as close as no two can touch."""

    def __init__(self, falls: list[Trajectory]):
        self.samples = [snapshots(fall.t, plane_shapes(fall), SNAPSHOTS) for fall in falls]
        shown = np.array([plane_shapes(fall)[chosen] for fall, chosen in zip(falls, self.samples, strict=True)])
        gap = GAP * falls[0].length
        self.columns = np.arange(SNAPSHOTS) * (np.ptp(shown[..., 0], axis=-1).max() + gap)
        self.low, self.high = shown[..., 1].min() - gap, shown[..., 1].max() + gap
        self.rows = -np.arange(len(falls)) * (self.high - self.low)
        self.height = (self.high - self.low) * len(falls)
        self.width = np.ptp(self.columns) + np.ptp(shown[..., 0], axis=-1).max() + 2 * gap

    @property
    def middles(self) -> Array:
        """The middle of each row, in a."""
        return self.rows + 0.5 * (self.low + self.high)


def _rows_of(falls: list[Trajectory], table: pd.DataFrame) -> pd.DataFrame:
    """The table's row of each fall, in order."""
    known = select_columns(table, ("regime",), ("B", "angle_index", *ANGLES, "slid_folded", "bond"))
    for regime in known["regime"]:
        one_of("regime", regime, REGIMES)
    known = known.drop_duplicates(["B", "angle_index"]).set_index(["B", "angle_index"])
    for fall in falls:
        if (fall.B, fall.angle_index) not in known.index:
            raise InputError(f"input: the table has no row for B = {fall.B:g}, angle_index = {fall.angle_index}")
    return known.loc[[(fall.B, fall.angle_index) for fall in falls]]


def _draw_shapes(axes: Axes, falls: list[Trajectory], grid: _Grid) -> None:
    """Rows of shapes in the colours of their times, ℬ and T before each."""
    for fall, chosen, row in zip(falls, grid.samples, grid.rows, strict=True):
        offsets = [(column, row) for column in grid.columns]
        shapes = plane_shapes(fall)[chosen]
        draw_shapes(axes, shapes, offsets, time_colors(fall.t)[chosen], 1.5)
        ends = axes.plot(*(shapes[:, 0] + offsets).T, "o", color=BLACK, markersize=1.8)
    ends[0].set_label("first bead, lower at the start")
    names = [f"{B_SYMBOL} = {fall.B:g}\nT ≈ {settled_at(fall)}" for fall in falls]
    axes.set_yticks(grid.middles, names, fontsize=7.0)
    axes.margins(x=0.01)
    axes.set(ylim=(grid.rows[-1] + grid.low, grid.high), xticks=[], aspect="equal", adjustable="datalim")
    axes.grid(False)
    axes.spines[:].set_visible(False)
    axes.tick_params(left=False)


def _draw_angles(axes: Axes, rows: pd.DataFrame, grid: _Grid) -> None:
    """Draw how far each fiber turned and bent; where the curves cross, the regime changes."""
    for column, (label, color, marker, share) in ANGLES.items():
        axes.plot(np.degrees(share * rows[column]), grid.middles, marker=marker, color=color, label=label)
    axes.set(xlabel="degrees")
    axes.tick_params(left=False)


def _draw_slides(axes: Axes, rows: pd.DataFrame, grid: _Grid) -> None:
    """Draw how far each folded fiber slides, and the bond length that makes it snaking."""
    axes.barh(grid.middles, rows["slid_folded"], 0.3 * (grid.high - grid.low), color=VERMILION)
    axes.axvline(rows["bond"].iloc[0], color=GREY, linestyle=(0, (2, 2)), linewidth=1.0, label="a bond, L/N")
    axes.set(xlabel="L, once folded", xlim=(0.0, None))
    axes.tick_params(left=False)


def _name_regimes(axes: Axes, regimes: pd.Series, grid: _Grid) -> None:
    """A coloured bar and a name left of the rows of each regime."""
    beside = axes.get_yaxis_transform()
    half = 0.5 * (grid.high - grid.low)
    for regime, group in groupby(zip(regimes, grid.middles, strict=True), key=lambda pair: pair[0]):
        places = [place for _, place in group]
        ends = (places[0] + 0.8 * half, places[-1] - 0.8 * half)
        axes.plot([_BAR, _BAR], ends, color=COLORS[regime], linewidth=3.0, transform=beside, clip_on=False)
        axes.text(_BAR - 0.02, np.mean(ends), regime, rotation=90, transform=beside, ha="right", va="center")


def _part_regimes(axes: Axes, regimes: pd.Series, grid: _Grid) -> None:
    """A line between two rows of different regimes."""
    for place, (above, below) in enumerate(pairwise(regimes)):
        if above != below:
            axes.axhline(grid.middles[place : place + 2].mean(), color=GREY, linewidth=0.6)
