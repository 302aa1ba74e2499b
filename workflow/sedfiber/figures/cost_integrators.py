"""Work against precision: what every integrator takes for a fall, and how far it is off."""

from itertools import product
from string import ascii_lowercase
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator

from sedfiber.core.array_types import Array
from sedfiber.core.validation import one_of
from sedfiber.figures.cost_omissions import left_out
from sedfiber.figures.footer import place_legend_above_footer, write_footer
from sedfiber.figures.style import (
    B_SYMBOL,
    BLACK,
    BLUE,
    GREEN,
    ORANGE,
    PAGE_WIDTH,
    PURPLE,
    SKY,
    VERMILION,
    letter_panel,
)
from sedfiber.figures.table_input import select_columns

LOOKS = {  # method: colour, marker
    "LSODA": (BLACK, "o"),
    "LSODA (solve_ivp)": (SKY, "v"),
    "BDF": (BLUE, "s"),
    "Radau": (GREEN, "D"),
    "DOP853": (ORANGE, "^"),
    "RK45": (PURPLE, ">"),
    "source": (VERMILION, "*"),
}
STYLES: dict[str, Any] = {"analytic": "-", "differences": (0, (4, 1.5)), "none": (0, (1, 1.2))}
_WORDS = {"analytic": "analytic Jacobian", "differences": "Jacobian by differences", "none": "explicit"}
_DEFAULT = ("LSODA", "analytic")
_BARS = "Vertical bars: interquartile range of the repeats, drawn upwards from the least time."
_PANEL_HEIGHT = 1.9  # inches
_NUMBERS = ("B", "angle_index", "tolerance", "error", "seconds_whole_fall", "seconds_spread", "fraction_of_fall")


def draw(table: pd.DataFrame) -> Figure:
    """A row of panels for each starting angle, a column for each ℬ; a line for each method and Jacobian."""
    rows = select_columns(table, ("method", "jacobian", "status"), _NUMBERS)
    for name, known in (("method", LOOKS), ("jacobian", STYLES)):
        for value in rows[name].unique():
            one_of(name, value, known)
    cases = list(product(sorted(rows["angle_index"].unique()), sorted(rows["B"].unique())))
    height, width = rows["angle_index"].nunique(), rows["B"].nunique()
    figure = Figure(figsize=(PAGE_WIDTH, _PANEL_HEIGHT * height + 1.7))
    panels = figure.subplots(height, width, sharex=True, sharey=True, squeeze=False)
    falls = {letter: _fall(rows, *case) for letter, case in zip(ascii_lowercase, cases, strict=False)}
    for axes, (letter, own), (k, B) in zip(panels.flat, falls.items(), cases, strict=True):
        letter_panel(axes, letter, f"{B_SYMBOL} = {B:g}, θ₀ = {k:g}π/48")
        _draw_fall(axes, own[own["status"] == "ok"])
    _name_axes(figure, panels[-1], panels[:, 0])
    write_footer(figure, table, notes=[*left_out(falls), _BARS])
    place_legend_above_footer(figure, _legend(rows), columns=5)
    return figure


def _fall(rows: pd.DataFrame, k: float, B: float) -> pd.DataFrame:
    return rows[(rows["angle_index"] == k) & (rows["B"] == B)]


def _draw_fall(axes: Axes, rows: pd.DataFrame) -> None:
    axes.set(xscale="log", yscale="log")
    axes.margins(y=0.1)  # room for the words at the paper's set-up
    for (method, jacobian), own in rows.groupby(["method", "jacobian"], sort=False):
        if method == "source":
            _draw_source(axes, own)
            continue
        own = own.sort_values("tolerance")
        seconds, spread = own["seconds_whole_fall"], own["seconds_spread"].fillna(0.0)
        axes.plot(own["error"], seconds, **_look(method, jacobian))
        axes.vlines(own["error"], seconds, seconds + spread, color=LOOKS[method][0], linewidth=0.7)


def _draw_source(axes: Axes, rows: pd.DataFrame) -> None:
    """A big marker, and a word where its seconds are scaled up from a part of the fall."""
    axes.plot(rows["error"], rows["seconds_whole_fall"], **_look("source", "none"))
    for row in rows[rows["fraction_of_fall"] < 1.0].itertuples():
        words = f"timed over {100.0 * row.fraction_of_fall:.2g} %\nof the fall"
        place: dict[str, Any] = {"xytext": (7, 0), "textcoords": "offset points", "va": "center"}
        axes.annotate(words, (row.error, row.seconds_whole_fall), size=6.0, color=LOOKS["source"][0], **place)


def _look(method: str, jacobian: str) -> dict:
    color, marker = LOOKS[method]
    look = {"color": color, "marker": marker, "linestyle": STYLES[jacobian], "linewidth": 1.0, "markersize": 3.0}
    if jacobian == "differences":
        look |= {"markerfacecolor": "white", "markeredgewidth": 0.7}
    if method == "source":
        look |= {"linestyle": "none", "markersize": 10.0, "markeredgecolor": "white", "zorder": 4}
    if (method, jacobian) == _DEFAULT:
        look |= {"linewidth": 2.4, "markersize": 4.5, "zorder": 3}
    return look


def _name_axes(figure: Figure, bottom: Array, left: Array) -> None:
    for axes in bottom:
        axes.xaxis.set_major_locator(LogLocator(numticks=6))
    for axes in left:
        axes.set_ylabel("seconds of the whole fall")
    bottom[len(bottom) // 2].set_xlabel("← more accurate      largest bead distance from the reference / L      less →")


def _legend(rows: pd.DataFrame) -> list[Line2D]:
    """Methods by colour and marker, Jacobians by line; only what is in the table."""
    entries = []
    for method in (name for name in LOOKS if (rows["method"] == name).any()):
        look = _look(method, "analytic" if method == "LSODA" else "none") | {"zorder": 1}
        words = {"LSODA": "LSODA (thick: the default)", "source": "paper's set-up"}.get(method, method)
        entries.append(Line2D([], [], **(look | {"linestyle": "none"}), label=words))
    kinds = [kind for kind in STYLES if (rows.loc[rows["method"] != "source", "jacobian"] == kind).any()]
    return entries + [Line2D([], [], color=BLACK, linestyle=STYLES[kind], label=_WORDS[kind]) for kind in kinds]
