"""Where the third dimension begins to matter: the out-of-plane rate against ℬ, and disturbances over time."""

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sedfiber.core.errors import InputError
from sedfiber.figures.style import (
    B_SYMBOL,
    BLACK,
    BLUE,
    GREY,
    PAGE_WIDTH,
    SEQUENTIAL,
    VERMILION,
    letter_panel,
    place_legend,
    set_plain_ticks,
)
from sedfiber.figures.table_input import select_columns


def draw(table: pd.DataFrame, growth: pd.DataFrame) -> Figure:
    """(a) rate of the terminal shape, curve and runs; (b) amplitude of the disturbance in each run."""
    numbers = ("B", "predicted_rate", "measured_rate", "amplitude_start")
    rows = select_columns(table, ("place",), numbers).sort_values("B")
    histories = select_columns(growth, (), ("B", "t", "amplitude"))
    turn = rows.loc[rows["place"] == "threshold", "B"]
    if turn.empty:
        raise InputError("input: the table has no row with place = threshold")
    figure = Figure(figsize=(PAGE_WIDTH, 3.3))
    left, right = figure.subplots(1, 2)
    _draw_rates(left, rows, float(turn.iloc[0]))
    _draw_growth(right, histories, rows)
    place_legend(figure, left, right, columns=5)
    return figure


def _draw_rates(axes: Axes, rows: pd.DataFrame, turn: float) -> None:
    letter_panel(axes, "a", f"it turns at {B_SYMBOL} = {turn:.1f}")
    axes.axhline(0.0, color=GREY, linewidth=0.8)
    axes.axvline(turn, color=BLACK, linestyle=(0, (2, 2)), linewidth=1.0)
    axes.plot(rows["B"], rows["predicted_rate"], color=BLUE, label="leading rate of the terminal shape")
    look: dict[str, Any] = {"color": VERMILION, "marker": "o", "linestyle": "none", "markerfacecolor": "none"}
    axes.plot(rows["B"], rows["measured_rate"], label="measured in volume", **look)
    axes.set(xscale="log", xlabel=f"elasto-gravitational number {B_SYMBOL}", ylabel="out-of-plane rate / (U$_s$/a)")
    set_plain_ticks(axes.xaxis)


def _draw_growth(axes: Axes, histories: pd.DataFrame, rows: pd.DataFrame) -> None:
    letter_panel(axes, "b", f"disturbances of {rows['amplitude_start'].iloc[0]:.1g} a (rms) in volume")
    values = sorted(rows.loc[rows["place"] != "threshold", "B"])
    for B, color in zip(values, SEQUENTIAL(np.linspace(0.0, 1.0, len(values))), strict=True):
        own = histories[(histories["B"] == B) & (histories["amplitude"] > 0.0)]
        axes.plot(own["t"], own["amplitude"], color=color, label=f"{B_SYMBOL} = {B:.6g}")
    axes.set(yscale="log", xlabel="time / (a/U$_s$)", ylabel="out-of-plane amplitude / a", ylim=(1e-10, None))
