"""Training time and error of the reduced models."""

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from sedfiber.core.validation import one_of
from sedfiber.figures.footer import place_legend_above_footer, write_footer
from sedfiber.figures.style import (
    B_SYMBOL,
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PAGE_WIDTH,
    SET_TITLES,
    VERMILION,
    letter_panel,
    set_plain_ticks,
)
from sedfiber.figures.table_input import in_set, select_columns

VARIANTS = {  # words and colour, as in the figure of reconstruction losses
    "none": (f"no {B_SYMBOL}", GREEN),
    "encoder": (f"encoder {B_SYMBOL}", ORANGE),
    "decoder": (f"decoder {B_SYMBOL}", BLUE),
    "double": (f"double {B_SYMBOL}", VERMILION),
}
RECIPES = {"study": ("o", True), "short": ("o", False), "source": ("s", False)}  # marker, and whether it is filled
_WORDS = {"study": "the study's recipe", "short": "a short training", "source": "the paper's recipe"}
_NUMBERS = ("latent_dim", "seed", "training_seconds", "reconstruction_loss", "E_worst", "E_median")
_ABOVE = 3.0  # of the largest error: where failures are drawn
_MODEL = ["variant", "latent_dim", "recipe"]
_TITLES = {"training_seconds": "training seconds", "reconstruction_loss": "reconstruction loss"}


def draw(table: pd.DataFrame) -> Figure:
    """Largest E over training seconds (above) and over reconstruction loss (below), for both test sets."""
    rows = select_columns(table, ("variant", "recipe", "test_set"), _NUMBERS)
    for name, known in (("variant", VARIANTS), ("recipe", RECIPES)):
        for value in rows[name].unique():
            one_of(name, value, known)
    top = _ABOVE * rows["E_worst"].max() if rows["E_worst"].notna().any() else 1.0
    figure = Figure(figsize=(PAGE_WIDTH, 6.6))
    panels = figure.subplots(2, 2, sharex="row", sharey=True)
    letters = iter("abcd")
    for line, (column, xlabel) in zip(panels, _TITLES.items(), strict=True):
        for axes, (test_set, title) in zip(line, SET_TITLES.items(), strict=True):
            letter_panel(axes, next(letters), title)
            axes.set(xscale="log", yscale="log", xlabel=xlabel)
            if column == "training_seconds":
                set_plain_ticks(axes.xaxis)
            _draw_set(axes, in_set(rows, test_set), column, top)
        line[0].set_ylabel("largest E(t): worst trajectory, dashes median")
    note = (
        "Numbers: latent dimension d. Crosses at the top edge: a forecast fails. Thin lines join the seeds of a model."
    )
    write_footer(figure, table, notes=[note])
    place_legend_above_footer(figure, _legend(rows), columns=4)
    return figure


def _draw_set(axes: Axes, rows: pd.DataFrame, column: str, top: float) -> None:
    rows = rows.assign(shown=rows["E_worst"].fillna(top))
    for _, own in rows.groupby(_MODEL, sort=False):
        seeds = own.sort_values("shown")
        axes.plot(seeds[column], seeds["shown"], color=VARIANTS[seeds["variant"].iloc[0]][1], linewidth=0.6)
    for zorder, row in enumerate(rows[rows[column].notna()].itertuples(), start=3):
        _draw_model(axes, getattr(row, column), row, zorder)


def _draw_model(axes: Axes, x: float, row: Any, zorder: int) -> None:
    """Median as a dash, worst as a marker with d in it; a cross with d beside it where a forecast fails."""
    color, fails = VARIANTS[row.variant][1], not np.isfinite(row.E_worst)
    axes.plot(x, row.E_median, "_", color=color, alpha=0.4, markersize=4.0)
    look = {"marker": "x", "color": color, "markersize": 8.0} if fails else _look(row.variant, row.recipe)
    axes.plot(x, row.shown, **look, zorder=zorder)
    tint = "white" if RECIPES[row.recipe][1] and not fails else color
    look = {"size": 5.0, "color": tint, "ha": "center", "va": "center_baseline", "zorder": zorder}
    aside = (7.0 if fails else 0.0, -0.2)
    axes.annotate(f"{row.latent_dim:g}", (x, row.shown), xytext=aside, textcoords="offset points", **look)


def _look(variant: str, recipe: str) -> dict:
    color, (marker, filled) = VARIANTS[variant][1], RECIPES[recipe]
    edge = {"markerfacecolor": color, "markeredgecolor": "white", "markeredgewidth": 0.4}
    if not filled:
        edge = {"markerfacecolor": "white", "markeredgecolor": color, "markeredgewidth": 0.8}
    return {"marker": marker, "linestyle": "none", "markersize": 7.0} | edge


def _legend(rows: pd.DataFrame) -> list[Line2D]:
    """Variants by colour, recipes by filling, and what the numbers are."""
    entries = [
        Line2D([], [], color=color, marker="s", linestyle="none", label=words)
        for name, (words, color) in VARIANTS.items()
        if (rows["variant"] == name).any()
    ]
    for recipe in (name for name in RECIPES if (rows["recipe"] == name).any()):
        marker, filled = RECIPES[recipe]
        fill, words = GREY if filled else "white", _WORDS[recipe]
        entries.append(Line2D([], [], color=GREY, marker=marker, linestyle="none", markerfacecolor=fill, label=words))
    return entries
