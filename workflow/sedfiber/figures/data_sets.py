"""The data sets as a grid: which fall belongs to which set, and when it settles."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from sedfiber.core.errors import InputError
from sedfiber.figures.style import B_SYMBOL, GREEN, ORANGE, PAGE_WIDTH, SKY
from sedfiber.figures.table_input import select_columns

# split: letter in the cell, colour, name
SETS = {
    "train": ("t", SKY, "training"),
    "A": ("A", ORANGE, "test set A"),
    "B": ("B", GREEN, "test set B"),
}
_SIZE = 5.8  # points, of the words in a cell, which is a quarter of an inch wide
_PALE = 0.4  # opacity: black words are read on every colour


def draw(table: pd.DataFrame) -> Figure:
    """A cell for each (ℬ, k): colour and letter say the set, the number is the settling time."""
    rows = select_columns(table, ("split",), ("B", "angle_index", "settling_time"))
    _require_known(rows)
    B_values = sorted(rows["B"].unique())
    angles = range(int(rows["angle_index"].max()) + 1)
    figure = Figure(figsize=(PAGE_WIDTH, 1.0 + 0.27 * len(B_values)))
    axes = figure.subplots()
    for row in rows.itertuples():
        _draw_cell(axes, (row.angle_index, B_values.index(row.B)), row.split, row.settling_time)
    axes.set_yticks(range(len(B_values)), [f"{B:g}" for B in B_values])
    axes.set_xticks(angles)
    axes.set(xlim=(-0.5, len(angles) - 0.5), ylim=(len(B_values) - 0.5, -0.5))
    axes.set(xlabel="k, where θ₀ = kπ/48", ylabel=f"elasto-gravitational number {B_SYMBOL}")
    axes.grid(False)
    axes.tick_params(length=0.0)
    _add_keys(figure, rows["split"].value_counts())
    return figure


def _require_known(rows: pd.DataFrame) -> None:
    """Every row has its place in the grid, no two the same one, and belongs to a known set."""
    if not np.isfinite(rows[["B", "angle_index"]]).all(axis=None):
        raise InputError("input: columns B and angle_index must hold a number in every row")
    strangers = sorted(set(rows["split"]) - set(SETS))
    if strangers:
        raise InputError(f"input: split: {strangers[0]!r} is not allowed; give one of {', '.join(SETS)}")
    twice = rows[rows.duplicated(["B", "angle_index"])]
    if not twice.empty:
        B, k = twice.iloc[0][["B", "angle_index"]]
        raise InputError(f"input: B = {B:g}, angle_index = {k:g} is in the table twice; give each fall once")


def _draw_cell(axes: Axes, place: tuple[float, float], split: str, settled: float) -> None:
    """Colour, letter and time of one fall, ``place`` being its column and row."""
    x, y = place
    letter, color, _ = SETS[split]
    axes.add_patch(Rectangle((x - 0.5, y - 0.5), 1.0, 1.0, facecolor=color, alpha=_PALE, linewidth=0.0))
    words = f"{letter}\n{settled:.0f}" if np.isfinite(settled) else f"{letter}\n–"
    axes.text(x, y, words, fontsize=_SIZE, ha="center", va="center", linespacing=1.05)


def _add_keys(figure: Figure, counts: pd.Series) -> None:
    patches = [Rectangle((0, 0), 1, 1, facecolor=color, alpha=_PALE) for _, color, _ in SETS.values()]
    names = [f"{letter}: {name}, {counts.get(split, 0)} falls" for split, (letter, _, name) in SETS.items()]
    figure.legend(
        patches, names, loc="outside lower center", ncols=3, title="below each letter: settling time T in a/U$_s$"
    )
