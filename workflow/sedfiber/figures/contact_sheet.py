"""Every test trajectory at a glance: true and forecast shapes, and the largest error."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from sedfiber.core.array_types import Array
from sedfiber.figures.best_and_worst import Pair, read_pairs, thinned
from sedfiber.figures.falls import plane_shapes, snapshots
from sedfiber.figures.style import B_SYMBOL, BLACK, PAGE_WIDTH, SEQUENTIAL, VERMILION, place_legend

SNAPSHOTS = 4
_STEP = np.array([0.31, -0.42])  # L, from one shape of a cell to the next
_CELL = np.array([2.2, 2.1])  # L, from one cell to the next; the first shape's centre bead is at _FIRST in it
_FIRST = np.array([0.56, -0.57])
_FILLED = 0.94  # of a cell
_TINT = 0.45  # opacity of a cell's background
TRUE_LINE, FORECAST_LINE = 1.8, 0.6  # points
_LEAST_E = 1e-16  # smaller errors, of forecasts as good as exact, are coloured as this


def draw(truth: Sequence[Path], forecasts: Sequence[Path], errors: pd.DataFrame, latent_dim: int) -> Figure:
    """Both test sets as one model forecasts them."""
    return draw_contact_sheet(read_pairs(truth, forecasts, errors, latent_dim))


def draw_contact_sheet(pairs: Sequence[Pair]) -> Figure:
    """One cell per trajectory, a row for each ℬ and a column for each k: four shapes along its fall, true in
    black and forecast over it; the background's colour is max E."""
    B_values = sorted({pair.truth.B for pair in pairs})
    angles = sorted({pair.truth.angle_index for pair in pairs})
    errors = np.clip([pair.E_max for pair in pairs], _LEAST_E, None)
    norm = LogNorm(np.nanmin(errors), np.nanmax(errors))
    figure = Figure(figsize=(PAGE_WIDTH, 1.15 + len(B_values) * _height(len(angles))))
    axes = figure.subplots()
    for pair, error in zip(pairs, errors, strict=True):
        place = np.array([angles.index(pair.truth.angle_index), -B_values.index(pair.truth.B)]) * _CELL
        _draw_cell(axes, pair, place, SEQUENTIAL(norm(error)))
    _label(axes, pairs, B_values, angles)
    place = {"location": "bottom", "pad": 0.01, "aspect": 50, "fraction": 0.05}
    bar = figure.colorbar(ScalarMappable(norm, SEQUENTIAL), ax=axes, alpha=_TINT, **place)
    bar.set_label("largest E(t) of each trajectory")
    place_legend(figure, axes, columns=2)
    return figure


def _height(n_columns: int) -> float:
    """Height of a row in inches."""
    return (PAGE_WIDTH - 0.8) / max(n_columns, 4) * _CELL[1] / _CELL[0]


def _draw_cell(axes: Axes, pair: Pair, place: Array, color: tuple) -> None:
    """Lengths in units of L, so that cells are alike for every fiber."""
    width, height = _FILLED * _CELL
    axes.add_patch(Rectangle(tuple(place), width, -height, facecolor=color, alpha=_TINT, linewidth=0.0))
    samples = snapshots(pair.truth.t, plane_shapes(pair.truth), SNAPSHOTS)
    places = place + _FIRST + np.arange(SNAPSHOTS)[:, None, None] * _STEP
    for fall, shade, width in ((pair.truth, BLACK, TRUE_LINE), (pair.forecast, VERMILION, FORECAST_LINE)):
        shapes = thinned(plane_shapes(fall)[samples]) / fall.length + places
        lines = np.concatenate([shapes, np.full_like(shapes[:, :1], np.nan)], axis=1)  # one path a cell: a small file
        axes.plot(*lines.reshape(-1, 2).T, color=shade, linewidth=width, solid_capstyle="round")


def _label(axes: Axes, pairs: Sequence[Pair], B_values: list[float], angles: list[int]) -> None:
    """ℬ with its test set beside each row, k above each column."""
    sets = {pair.truth.B: pair.truth.split for pair in pairs}
    width, height = _CELL
    axes.set(xlim=(-0.05 * width, len(angles) * width), ylim=(-len(B_values) * height, 0.05 * height), aspect="equal")
    axes.set_xticks((np.arange(len(angles)) + 0.5 * _FILLED) * width, [f"k = {k}" for k in angles])
    axes.set_yticks(-(np.arange(len(B_values)) + 0.5 * _FILLED) * height, [f"{B:g}  {sets[B]}" for B in B_values])
    axes.set_ylabel(f"{B_SYMBOL} and its test set")
    axes.tick_params(length=0, top=False, labeltop=True, bottom=False, labelbottom=False)
    axes.grid(False)
    axes.spines[:].set_visible(False)
    axes.plot([], [], color=BLACK, linewidth=TRUE_LINE, label="true")
    axes.plot([], [], color=VERMILION, linewidth=FORECAST_LINE, label="forecast")
