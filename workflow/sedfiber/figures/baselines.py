"""Worst and median forecast error of every forecaster at each ℬ, as a dot plot."""

from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from sedfiber.figures.model_legend import LegendEntry, legend_entries
from sedfiber.figures.style import B_SYMBOL, BLACK, GREY, PAGE_WIDTH, SET_TITLES, letter_panel, place_legend
from sedfiber.figures.table_input import in_set, select_columns
from sedfiber.study.targets import WORST_TARGETS

GROUP_HEIGHT = 0.75  # share of the distance between two ℬ that is taken by the forecasters' rows


def draw(table: pd.DataFrame) -> Figure:
    """Two panels, sets A and B: one group of rows for each ℬ, filled dot worst, open dot median."""
    rows = select_columns(table, ("test_set", "model", "recipe"), ("B", "latent_dim", "E_worst", "E_median"))
    shown = legend_entries(rows)
    figure = Figure(figsize=(PAGE_WIDTH, 5.6))
    panels = figure.subplots(1, 2, sharex=True)
    for axes, letter, (test_set, title) in zip(panels, "ab", SET_TITLES.items(), strict=True):
        letter_panel(axes, letter, title)
        _draw_set(axes, in_set(rows, test_set), shown)
        axes.axvline(
            WORST_TARGETS[test_set],
            color=BLACK,
            linestyle=(0, (2, 2)),
            linewidth=1.0,
            label="target for the worst, d = 4",
            zorder=1.5,
        )
        axes.set(xscale="log", xlabel="largest E(t) of a trajectory")
    panels[0].set_ylabel(f"elasto-gravitational number {B_SYMBOL}")
    _add_dot_keys(panels[1])
    place_legend(figure, *panels, columns=3)
    return figure


def _draw_set(axes: Axes, rows: pd.DataFrame, shown: list[LegendEntry]) -> None:
    values = sorted(rows["B"].unique())
    for place in range(0, len(values), 2):
        axes.axhspan(place - 0.5, place + 0.5, color="#f2f2f2", linewidth=0.0, zorder=0)
    for index, entry in enumerate(shown):
        shift = GROUP_HEIGHT * (0.5 - (index + 0.5) / len(shown))  # the first on top
        own = rows[rows["model"] == entry.model]
        _draw_model(axes, own, own["B"].map(values.index) + shift, entry)
    axes.set(yticks=range(len(values)), yticklabels=[f"{B:g}" for B in values], ylim=(-0.5, len(values) - 0.5))
    axes.grid(False, axis="y")
    axes.tick_params(axis="y", length=0)


def _draw_model(axes: Axes, rows: pd.DataFrame, places: pd.Series, entry: LegendEntry) -> None:
    look: dict[str, Any] = {"color": entry.color, "marker": entry.marker, "linestyle": "none", "markersize": 4.0}
    axes.hlines(places, rows["E_median"], rows["E_worst"], color=entry.color, linewidth=0.8)
    axes.plot(rows["E_worst"], places, label=entry.label, **look)
    axes.plot(rows["E_median"], places, markerfacecolor="white", **look)


def _add_dot_keys(axes: Axes) -> None:
    """Legend entries that say what filled and open dots are."""
    for label, fill in (("worst trajectory", GREY), ("median trajectory", "white")):
        axes.add_line(Line2D([], [], color=GREY, marker="o", linestyle="none", markerfacecolor=fill, label=label))
