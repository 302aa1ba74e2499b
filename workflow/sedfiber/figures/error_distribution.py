"""Where the model is weak: the largest error of every test trajectory over (ℬ, θ₀)."""

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from sedfiber.core.errors import InputError
from sedfiber.figures.style import (
    B_SYMBOL,
    PAGE_WIDTH,
    SEQUENTIAL,
    VERMILION,
    letter_panel,
    scientific,
)
from sedfiber.figures.table_input import TEST_SETS, in_set, select_columns

PANEL_HEIGHT = 1.85  # inches
LETTERS = "abcdefghijklmnopqrstuvwxyz"


def draw(table: pd.DataFrame) -> Figure:
    """A row of panels for each latent dimension, a column for each test set, one colour scale."""
    rows = select_columns(table, ("test_set",), ("latent_dim", "B", "angle_index", "E_max"))
    norm = _error_norm(rows["E_max"])
    latent_dims = sorted(rows["latent_dim"].unique())
    figure = Figure(figsize=(PAGE_WIDTH, 0.5 + PANEL_HEIGHT * len(latent_dims)))
    panels = figure.subplots(len(latent_dims), len(TEST_SETS), squeeze=False)
    places = [(latent_dim, test_set) for latent_dim in latent_dims for test_set in TEST_SETS]
    for axes, letter, (latent_dim, test_set) in zip(panels.flat, LETTERS, places, strict=False):
        chosen = _rows_of(rows, latent_dim, test_set)
        mesh = _draw_panel(axes, chosen, norm)
        missing = chosen["E_max"].isna().sum()
        remark = f"; {missing} without a value (grey)" if missing else ""
        letter_panel(axes, letter, f"test set {test_set}, d = {latent_dim:g}{remark}\n{_mark_worst(axes, chosen)}")
    figure.supxlabel("k, where θ₀ = kπ/48", fontsize="medium")
    figure.supylabel(f"elasto-gravitational number {B_SYMBOL}", fontsize="medium")
    figure.colorbar(mesh, ax=panels, label="E, largest over the trajectory", pad=0.01)
    return figure


def _error_norm(errors: pd.Series) -> LogNorm:
    positive = errors[errors > 0.0]
    if positive.empty:
        raise InputError("input: column E_max holds no value above 0")
    return LogNorm(positive.min(), positive.max())


def _rows_of(rows: pd.DataFrame, latent_dim: float, test_set: str) -> pd.DataFrame:
    """The trajectories of one panel; raises InputError when none has an error."""
    chosen = in_set(rows[rows["latent_dim"] == latent_dim], test_set)
    if chosen["E_max"].isna().all():
        raise InputError(f"input: the table has no E_max for latent_dim {latent_dim:g}, test_set {test_set}")
    return chosen


def _draw_panel(axes: Axes, rows: pd.DataFrame, norm: LogNorm) -> QuadMesh:
    """One cell a trajectory, rows ℬ, columns k; a cell without a value stays grey."""
    grid = rows.pivot_table(index="B", columns="angle_index", values="E_max", aggfunc="max", dropna=False)
    axes.set_facecolor("#bbbbbb")
    axes.grid(False)
    mesh = axes.pcolormesh(grid.to_numpy(), cmap=SEQUENTIAL, norm=norm, edgecolors="white", linewidth=0.4)
    axes.set_xticks([place + 0.5 for place in range(grid.shape[1])], [f"{k:g}" for k in grid.columns])
    axes.set_yticks([place + 0.5 for place in range(grid.shape[0])], [f"{B:g}" for B in grid.index])
    axes.tick_params(length=0)
    return mesh


def _mark_worst(axes: Axes, rows: pd.DataFrame) -> str:
    """Frame the cell with the largest error; returns the words that name it."""
    worst = rows.loc[rows["E_max"].idxmax()]
    row = sorted(rows["B"].unique()).index(worst["B"])
    column = sorted(rows["angle_index"].unique()).index(worst["angle_index"])
    axes.add_patch(Rectangle((column, row), 1, 1, fill=False, edgecolor=VERMILION, linewidth=1.8, zorder=3))
    return f"worst {scientific(worst['E_max'])} at {B_SYMBOL} = {worst['B']:g}, k = {worst['angle_index']:g}"
