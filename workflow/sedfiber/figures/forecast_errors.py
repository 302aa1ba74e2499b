"""Ensemble-mean forecast error over normalised time: each ℬ, all ℬ, and its two parts."""

from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from sedfiber.core.validation import one_of, positive_number
from sedfiber.figures.model_legend import LegendEntry, legend_entries
from sedfiber.figures.style import (
    B_SYMBOL,
    BLACK,
    GREY,
    PAGE_WIDTH,
    SEQUENTIAL,
    SET_TITLES,
    VERMILION,
    draw_level,
    letter_panel,
    place_legend,
    set_plain_ticks,
)
from sedfiber.figures.table_input import in_set, select_columns
from sedfiber.study.targets import ENSEMBLE_TARGETS, PAPER_BOUND

ALL = "all"  # in column B: the mean over every ℬ of a set
PARTS = {"E_shape": ("-", r"$E_\mathrm{shape}$"), "E_pos": (":", r"$E_\mathrm{pos}$")}


def draw(table: pd.DataFrame, model: str) -> Figure:
    """Above: E(t/T) of ``model``. Below: its parts. The paper's recipe and the lookup are drawn in."""
    rows = select_columns(
        table, ("model", "recipe", "test_set", "B"), ("latent_dim", "time_fraction", "E", "E_shape", "E_pos")
    )
    shown = _compared(rows, model)
    norm = _B_norm(rows[rows["model"] == model])
    figure = Figure(figsize=(PAGE_WIDTH, 5.6))
    panels = figure.subplots(2, 2, sharex=True, sharey=True)
    panels[0, 0].set(yscale="log", xlim=(0.0, 1.0), ylabel="ensemble mean of E(t)")
    panels[1, 0].set_ylabel("ensemble mean of each part")
    for test_set, letters, (above, below) in zip(SET_TITLES, ("ac", "bd"), panels.T, strict=True):
        letter_panel(above, letters[0], SET_TITLES[test_set])
        letter_panel(below, letters[1], f"test set {test_set}: the two parts, mean over all {B_SYMBOL}")
        _draw_totals(above, in_set(rows, test_set), shown, norm)
        _draw_levels(above, test_set)
        _draw_parts(below, in_set(rows, test_set), shown)
        below.set_xlabel("t / T")
        below.xaxis.set_major_formatter("{x:g}")
    _add_color_bar(figure, panels[0, 1], norm)
    _add_part_keys(panels[1, 1])
    place_legend(figure, *panels.flat, columns=3)
    return figure


def _compared(rows: pd.DataFrame, model: str) -> list[LegendEntry]:
    """The chosen model, in black, then the paper's recipe and the lookup."""
    known = {entry.model: entry for entry in legend_entries(rows)}
    chosen = known.pop(one_of("model", model, known))
    others = [other for other in known.values() if other.recipe != "rollout"]
    return [chosen._replace(color=BLACK), *others]


def _B_norm(rows: pd.DataFrame) -> LogNorm:
    """The colour scale of ℬ, one for both sets."""
    values = [positive_number("B", B, "a number above 0 or all") for B in rows["B"].unique() if B != ALL]
    return LogNorm(min(values, default=1.0), max(values, default=10.0))


def _draw_totals(axes: Axes, rows: pd.DataFrame, shown: list[LegendEntry], norm: LogNorm) -> None:
    """A thin line for each ℬ of the chosen model, a thick one for all, and the others' means."""
    chosen, *others = shown
    single = rows[(rows["model"] == chosen.model) & (rows["B"] != ALL)]
    for B, curve in single.groupby("B"):
        axes.plot(curve["time_fraction"], curve["E"], color=SEQUENTIAL(norm(float(B))), linewidth=0.8)
    _draw_mean(axes, rows, chosen, "E", color=chosen.color, linewidth=2.0, label=f"{chosen.label}, all {B_SYMBOL}")
    for other in others:
        _draw_mean(axes, rows, other, "E", color=other.color, linewidth=1.3, label=f"{other.label}, all {B_SYMBOL}")


def _draw_parts(axes: Axes, rows: pd.DataFrame, shown: list[LegendEntry]) -> None:
    for entry in shown:
        for part, (line, _) in PARTS.items():
            _draw_mean(axes, rows, entry, part, color=entry.color, linestyle=line, linewidth=1.3)


def _draw_mean(axes: Axes, rows: pd.DataFrame, entry: LegendEntry, column: str, **look: Any) -> None:
    mean = rows[(rows["model"] == entry.model) & (rows["B"] == ALL)]
    axes.plot(mean["time_fraction"], mean[column], **look)


def _draw_levels(axes: Axes, test_set: str) -> None:
    draw_level(axes, PAPER_BOUND, VERMILION, (0, (6, 3)), "paper's bound, 0.1")
    draw_level(
        axes, ENSEMBLE_TARGETS[test_set], BLACK, (0, (2, 2)), "this study's target, $10^{-4}$ on A, $10^{-3}$ on B"
    )


def _add_part_keys(axes: Axes) -> None:
    """Legend entries that say which line style is which part."""
    for line, label in PARTS.values():
        axes.plot([], [], color=GREY, linestyle=line, linewidth=1.3, label=f"{label} in (c) and (d)")


def _add_color_bar(figure: Figure, beside: Axes, norm: LogNorm) -> None:
    bar = figure.colorbar(ScalarMappable(norm, SEQUENTIAL), ax=beside, pad=0.02)
    bar.set_label(f"elasto-gravitational number {B_SYMBOL}")
    set_plain_ticks(bar.ax.yaxis)
