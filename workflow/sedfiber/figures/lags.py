"""The lag of forecasts, and the error left without it."""

from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sedfiber.core.validation import one_of
from sedfiber.figures.model_legend import LegendEntry, legend_entries
from sedfiber.figures.style import (
    B_SYMBOL,
    GREY,
    PAGE_WIDTH,
    SET_TITLES,
    letter_panel,
    place_legend,
    set_plain_ticks,
)
from sedfiber.figures.table_input import in_set, select_columns

_LINEAR = 0.1  # a/U_s: lags within this are on the linear part of the axis
_DODGE = 1.05  # factor of ℬ between two forecasters' points
_SHARES = {1.0: ("-", "all"), 0.1: ((0, (6, 3)), "a tenth"), 0.01: ((0, (2, 2)), "a hundredth")}  # that is left
_POINT: dict[str, Any] = {"markersize": 3.2, "markerfacecolor": "none", "markeredgewidth": 0.7, "linestyle": ""}


def draw(table: pd.DataFrame, model: str) -> Figure:
    """Above: the lag at the largest E_shape over ℬ, of ``model`` and of the paper's recipe.  Below: E_shape
    at that moment with the lag taken out over E_shape as it is."""
    rows = select_columns(
        table, ("model", "recipe", "test_set"), ("latent_dim", "B", "lag", "E_shape_max", "E_shape_unlagged")
    )
    shown = _compared(rows, model)
    rows = rows[rows["model"].isin([entry.model for entry in shown])]
    figure = Figure(figsize=(PAGE_WIDTH, 5.6))
    panels = figure.subplots(2, 2, sharex="row", sharey="row")
    for test_set, letters, (above, below) in zip(SET_TITLES, ("ac", "bd"), panels.T, strict=True):
        own = in_set(rows, test_set)
        letter_panel(above, letters[0], SET_TITLES[test_set])
        letter_panel(below, letters[1], f"test set {test_set}: without the lag")
        _draw_lags(above, own, shown)
        _draw_errors(below, own, shown)
    panels[0, 0].set_ylabel(r"lag / (a/U$_s$) at the largest $E_\mathrm{shape}$")
    panels[1, 0].set_ylabel(r"$E_\mathrm{shape}$ there without the lag")
    panels[0, 0].plot([], [], color=GREY, label=f"median at each {B_SYMBOL}, in (a) and (b)")
    place_legend(figure, panels[0, 0], panels[1, 0], columns=3)
    return figure


def _compared(rows: pd.DataFrame, model: str) -> list[LegendEntry]:
    """The chosen model and those of the paper's recipe."""
    known = {entry.model: entry for entry in legend_entries(rows)}
    chosen = known.pop(one_of("model", model, known))
    return [chosen, *(other for other in known.values() if other.recipe == "source")]


def _draw_lags(axes: Axes, rows: pd.DataFrame, shown: list[LegendEntry]) -> None:
    """One point per trajectory that has a lag there; the line joins the medians at each ℬ."""
    axes.axhline(0.0, color=GREY, linewidth=0.8)
    for place, entry in enumerate(shown):
        own = rows[rows["model"] == entry.model]
        B = own["B"] * _DODGE ** (2 * place - len(shown) + 1)
        axes.plot(B, own["lag"], entry.marker, color=entry.color, label=entry.label, **_POINT)
        middle = own.groupby(B)["lag"].median()
        axes.plot(middle.index, middle, color=entry.color, linewidth=1.2)
    axes.set_yscale("symlog", linthresh=_LINEAR)
    axes.set(xscale="log", xlabel=f"elasto-gravitational number {B_SYMBOL}")
    set_plain_ticks(axes.xaxis)


def _draw_errors(axes: Axes, rows: pd.DataFrame, shown: list[LegendEntry]) -> None:
    """On the line of 1 a lag explains nothing, on that of 0.01 it explains 99 % of the error."""
    for entry in shown:
        own = rows[rows["model"] == entry.model]
        errors = own["E_shape_max"], own["E_shape_unlagged"]
        axes.plot(*errors, entry.marker, color=entry.color, **_POINT)
    axes.set(xscale="log", yscale="log", xlabel=r"largest $E_\mathrm{shape}$")
    start = rows["E_shape_max"].min()
    for share, (line, words) in _SHARES.items():
        ends = (start, share * start), (2.0 * start, 2.0 * share * start)
        axes.axline(*ends, color=GREY, linestyle=line, linewidth=0.8, label=f"{words} of it left")
