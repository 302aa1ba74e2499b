"""The decision chart: error and seconds of every way to an answer, and what has to be paid before."""

from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from sedfiber.figures.cost_break_even import draw_preparation, write_break_even
from sedfiber.figures.cost_choices import BATCHES, FORECAST, GALERKIN, LOOKUP, SIMULATION, Choices, choices, color_of
from sedfiber.figures.footer import place_legend_above_footer, write_footer
from sedfiber.figures.style import BLACK, GREY, PAGE_WIDTH, letter_panel

_NOTES = (
    "Markers: error of the worst trajectory; bars reach to the median one's. At the dotted right edge an answer fails.",
    "Of each model the loosest tolerance at which its largest error is within a tenth of its least."
    " In (c) the better precision.",
)
_TITLES = ("a trajectory: time against error", "before the first answer", "queries until it pays (times faster)")
_OTHERS = {
    SIMULATION: ("o", "simulation, by tolerance"),
    LOOKUP: ("p", "spline lookup"),
    GALERKIN: ("o", "POD–Galerkin, by modes"),
}
_SMALL = 6.0  # points


def draw(table: pd.DataFrame) -> Figure:
    """(a) seconds over error, (b) seconds of preparation, (c) after how many queries these are earned back."""
    shown = choices(table)
    figure = Figure(figsize=(PAGE_WIDTH, 5.4))
    grid = figure.add_gridspec(2, 2, width_ratios=(1.4, 1.0), height_ratios=(1.0, 1.0))
    chart, before, words = (figure.add_subplot(grid[place]) for place in ((slice(None), 0), (0, 1), (1, 1)))
    for axes, letter, title in zip((chart, before, words), "abc", _TITLES, strict=True):
        letter_panel(axes, letter, title)
    _draw_chart(chart, shown)
    draw_preparation(before, shown)
    write_break_even(words, shown)
    write_footer(figure, table, notes=_NOTES)
    place_legend_above_footer(figure, _legend(shown), columns=4)
    return figure


def _draw_chart(axes: Axes, shown: Choices) -> None:
    axes.set(xscale="log", yscale="log", ylabel="seconds of one trajectory")
    axes.margins(x=0.08)
    axes.set_xlabel("largest root-mean-square bead distance / L\n← more accurate                              less →")
    if shown.rows["error_worst"].isna().any():
        axes.axvline(shown.edge, color=GREY, linestyle=(0, (1, 1.2)))
    _draw_ladder(axes, shown.family(SIMULATION).sort_values("tolerance"))
    lookup, galerkin = shown.family(LOOKUP), shown.family(GALERKIN)
    for family, own, size in ((LOOKUP, lookup, 6.0), (GALERKIN, galerkin, 8.0)):
        look: dict[str, Any] = {"marker": _OTHERS[family][0], "color": color_of(shown, family, ""), "markersize": size}
        _draw_bars(axes, own, look["color"])
        axes.plot(own["worst"], own["seconds_least"], linestyle="none", **look)
    for row in galerkin.itertuples():
        _write(axes, row, f"{row.dimension:g}", "white", within=True)
    for row in shown.torch.itertuples():
        color = shown.colors[row.simple]
        axes.plot(row.worst, row.seconds_least, "x", color=color, markersize=6.0, markeredgewidth=1.4)
    for (name, precision), own in shown.family(FORECAST).groupby(["name", "precision"], sort=False):
        _draw_batches(axes, own.sort_values("batch"), shown, shown.colors[name], precision)


def _draw_ladder(axes: Axes, rows: pd.DataFrame) -> None:
    axes.plot(rows["worst"], rows["seconds_least"], "-o", color=BLACK)
    _draw_bars(axes, rows, BLACK)
    for row in rows.itertuples():
        _write(axes, row, f"{row.tolerance:.0e}".replace("e-0", "e-"), BLACK)


def _draw_batches(axes: Axes, rows: pd.DataFrame, shown: Choices, color: str, precision: str) -> None:
    """A marker for each size of a batch, open for float32, with bars at the smallest and the largest."""
    axes.plot(rows["worst"], rows["seconds_least"], color=color, linewidth=0.7)
    _draw_bars(axes, rows.iloc[[0, -1]], color)
    fill = color if precision == "float64" else "white"
    for row in rows.itertuples():
        marker = BATCHES[shown.batches.index(row.batch) % len(BATCHES)]
        axes.plot(row.worst, row.seconds_least, marker, color=color, markerfacecolor=fill, markersize=5.0)


def _draw_bars(axes: Axes, rows: pd.DataFrame, color: str) -> None:
    axes.hlines(rows["seconds_least"], rows["median"], rows["worst"], color=color, linewidth=0.7, alpha=0.6)


def _write(axes: Axes, row: Any, words: str, color: str, within: bool = False) -> None:
    """A word right above a marker, or a number within it."""
    place: dict[str, Any] = {"xytext": (1.5, 4.0), "size": _SMALL}
    if within:
        place |= {"xytext": (0.0, -0.2), "size": 5.0, "ha": "center", "va": "center_baseline"}
    axes.annotate(words, (row.worst, row.seconds_least), textcoords="offset points", color=color, **place)


def _legend(shown: Choices) -> list[Line2D]:
    """Families by colour, sizes of batches by marker; only what is in the table."""
    entries = []
    for family, (marker, words) in _OTHERS.items():
        if len(shown.family(family)):
            entries.append(_entry(marker, color_of(shown, family, ""), words))
    entries += [_entry("s", color, f"forecast, {name}") for name, color in shown.colors.items()]
    for marker, batch in zip(BATCHES, shown.batches, strict=False):
        entries.append(_entry(marker, GREY, "alone" if batch == 1 else f"{batch:g} at once"))
    if (shown.family(FORECAST)["precision"] == "float32").any():
        entries.append(_entry("o", GREY, "open: float32", "white"))
    return entries + ([_entry("x", GREY, "through torch")] if len(shown.torch) else [])


def _entry(marker: str, color: str, label: str, fill: str | None = None) -> Line2D:
    return Line2D([], [], color=color, marker=marker, markerfacecolor=fill or color, linestyle="none", label=label)
