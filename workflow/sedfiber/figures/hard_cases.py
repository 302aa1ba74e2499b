"""The distance of every hard case from its bounds."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sedfiber.figures.style import BLUE, GREY, PAGE_WIDTH, VERMILION
from sedfiber.figures.table_input import select_columns

_LEAST = 1e-13  # of the bound: smaller values are drawn here
_COLOURS = {"right": BLUE, "wrong": VERMILION}
_COLUMNS = {"yes or no": 0.0, "all right": 0.42, "seconds": 0.76}  # of the table beside the numbers
_SPREAD = 0.3  # of a row, over which the numbers of a case are spread


def draw(table: pd.DataFrame) -> Figure:
    """One row a case: each number over its bound, and how many of its yes-or-no checks came out right."""
    rows = select_columns(table, ("case", "verdict"), ("value", "bound", "seconds"))
    cases = list(dict.fromkeys(rows["case"]))
    figure = Figure(figsize=(PAGE_WIDTH, 1.0 + 0.24 * len(cases)))
    axes, words = figure.subplots(1, 2, sharey=True, width_ratios=(3, 1))
    words.set_axis_off()
    axes.axvline(1.0, color=GREY, linewidth=1.0)
    for place, case in enumerate(cases):
        own = rows[rows["case"] == case]
        _draw_numbers(axes, place, own[own["bound"] > 0.0])
        _write_verdicts(words, place, own)
    most = max(10.0, 3.0 * _ratios(rows[rows["bound"] > 0.0]).max())
    axes.set(xscale="log", xlim=(_LEAST / 3.0, most), ylim=(len(cases) - 0.4, -0.9))
    axes.set(xlabel="value over its bound (0 and less at the left edge); right of the line a bound is broken")
    axes.set(yticks=range(len(cases)), yticklabels=[case.replace("_", " ") for case in cases])
    axes.tick_params(axis="y", length=0)
    for column in _COLUMNS:
        _write(words, column, -0.75, column, GREY)
    return figure


def _draw_numbers(axes: Axes, place: int, numbers: pd.DataFrame) -> None:
    offsets = np.linspace(-_SPREAD, _SPREAD, len(numbers)) if len(numbers) > 1 else np.zeros(len(numbers))
    ratios = _ratios(numbers)
    for verdict, colour in _COLOURS.items():
        chosen = (numbers["verdict"] == verdict).to_numpy()
        axes.plot(ratios[chosen], place + offsets[chosen], "o", color=colour, markersize=3.0, alpha=0.8)


def _write_verdicts(words: Axes, place: int, case: pd.DataFrame) -> None:
    right = case["verdict"] == "right"
    checks = right[~(case["bound"] > 0.0)]
    if len(checks):
        _write(words, "yes or no", place, f"{checks.sum()} of {len(checks)}", _tint(checks.all()))
    _write(words, "all right", place, "yes" if right.all() else "NO", _tint(right.all()))
    _write(words, "seconds", place, f"{case['seconds'].max():.3g}", GREY)


def _ratios(numbers: pd.DataFrame) -> np.ndarray:
    """Values over bounds, none below the left edge; what is not a number is drawn as broken."""
    ratios = (numbers["value"] / numbers["bound"]).fillna(1e3)
    return np.maximum(ratios, _LEAST).to_numpy()


def _tint(right: bool) -> str:
    return _COLOURS["right" if right else "wrong"]


def _write(axes: Axes, column: str, place: float, words: str, colour: str) -> None:
    where = axes.get_yaxis_transform()
    axes.text(_COLUMNS[column], place, words, color=colour, fontsize=7.0, transform=where, verticalalignment="center")
