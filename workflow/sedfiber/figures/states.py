"""The steady states against ℬ: how they fall, what they look like, and how fast disturbances of them grow."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from sedfiber.core.array_types import Array
from sedfiber.core.validation import one_of
from sedfiber.figures.style import B_SYMBOL, BLACK, BLUE, GREEN, GREY, PAGE_WIDTH, PURPLE, VERMILION, letter_panel
from sedfiber.figures.table_input import select_columns

BRANCHES = {"U": BLUE, "W": VERMILION, "middle": GREEN, "vertical": PURPLE}
LABELLED_AT = {"U": 0.4, "W": 1.0, "middle": 0.45, "vertical": 0.4}  # of the way along the branch
STYLES: dict[str, Any] = {
    "stable in volume": "-",
    "stable in the plane alone": (0, (4, 1.5)),
    "unstable in the plane": (0, (1, 1.2)),
}
PANELS = {  # column: what it is over, title
    "speed": (None, "settling speed / U$_s$"),
    "height": ("length", "height / L"),
    "end_to_end": ("length", "end-to-end distance / L"),
    "in_plane_rate": (None, "leading in-plane growth rate / (U$_s$/a)"),
    "out_of_plane_rate": (None, "leading out-of-plane growth rate / (U$_s$/a)"),
}
NUMBERED = {  # kind of threshold: the panel that gives its ℬ
    "fold": "end_to_end",
    "in-plane rate changes sign": "in_plane_rate",
    "out-of-plane rate changes sign": "out_of_plane_rate",
    "number of unstable modes changes": "in_plane_rate",
}
FLAGS = ("stable_in_plane", "stable_in_volume")
_SMALL = 6.5  # points
_LINEAR = 0.01  # U_s/a: rates are drawn linearly below and logarithmically above
_RATE_TICKS = (-1.0, -0.1, -0.01, 0.0, 0.01, 0.1)


def draw(table: pd.DataFrame, thresholds: pd.DataFrame) -> Figure:
    """(a) speed, (b) height, (c) end-to-end distance; leading rates (d) in the plane and (e) out of it."""
    rows = select_columns(table, ("branch",), ("B", "length", *PANELS, *FLAGS)).sort_values("B")
    marks = thresholds  # of a narrow range there are none
    if len(thresholds):
        marks = select_columns(thresholds, ("branch", "threshold"), ("B",))
    for name in rows["branch"].unique():
        one_of("branch", name, BRANCHES)
    figure = Figure(figsize=(PAGE_WIDTH, 6.0))
    grid = figure.add_gridspec(6, 2)
    places = [grid[0:2, 0], grid[2:4, 0], grid[4:6, 0], grid[0:3, 1], grid[3:6, 1]]
    for letter, place, column in zip("abcde", places, PANELS, strict=True):
        axes = figure.add_subplot(place)
        _draw_panel(axes, rows, marks, column)
        letter_panel(axes, letter, PANELS[column][1])
        if letter in "ce":
            axes.set_xlabel(f"elasto-gravitational number {B_SYMBOL}")
    _place_legend(figure, rows["branch"].unique(), marks)
    return figure


def _draw_panel(axes: Axes, rows: pd.DataFrame, marks: pd.DataFrame, column: str) -> None:
    over = PANELS[column][0]
    axes.set_xscale("log")
    axes.margins(x=0.08)  # room for names at the end
    if column.endswith("rate"):
        axes.axhline(0.0, color=GREY, linewidth=0.8)
        axes.set_yscale("symlog", linthresh=_LINEAR)
        axes.set_yticks(_RATE_TICKS, [f"{tick:g}".replace("-", "−") for tick in _RATE_TICKS])
        axes.set_ylabel(f"linear within ±{_LINEAR:g}, logarithmic beyond", color=GREY, size=_SMALL)
    for name, own in rows.groupby("branch"):
        values = own[column] if over is None else own[column] / own[over]
        turns = marks[marks["branch"] == name]
        for style, B, y in _pieces(own, values.to_numpy(), turns["B"]):
            axes.plot(B, y, color=BRANCHES[name], linestyle=style)
        for kind, B in zip(turns["threshold"], turns["B"], strict=True):
            axes.plot(B, _between(B, own, values), color=BRANCHES[name], **_mark(kind))
            if NUMBERED.get(kind) == column:
                axes.annotate(f"{B:.0f}", (B, _between(B, own, values)), **_beside(B, own, values), **_small(name))
        if name != "middle" or column in ("speed", "end_to_end"):  # too short elsewhere for a name on it
            _name(axes, name, own, values)


def _beside(B: float, own: pd.DataFrame, values: Array) -> dict:
    """Place for the number of a threshold: below a rising line, above a falling one, outside a fold."""
    if (own["B"] >= B).all():
        return {"xytext": (-5, 3), "ha": "right"}
    ahead, behind = _between(np.array([1.01 * B, B / 1.01]), own, values)
    rising = ahead > behind and (own["B"] > B).any()
    return {"xytext": (4, -9) if rising else (3, 4), "ha": "left"}


def _name(axes: Axes, name: str, own: pd.DataFrame, values: Array) -> None:
    """The branch's name on its line, or at its end."""
    along = LABELLED_AT[name]
    B = float(np.exp(np.interp(along, [0.0, 1.0], np.log(own["B"].iloc[[0, -1]]))))
    place = {"xytext": (3, 0), "ha": "left"} if along == 1.0 else {"xytext": (0, 0), "ha": "center"}
    box = {"facecolor": "white", "edgecolor": "none", "pad": 0.8}
    axes.annotate(name, (B, _between(B, own, values)), va="center", bbox=box, **place, **_small(name))


def _small(name: str) -> dict:
    return {"textcoords": "offset points", "size": _SMALL, "color": BRANCHES[name]}


def _pieces(own: pd.DataFrame, values: Array, turns: pd.Series) -> Iterator[tuple[str | tuple, Array, Array]]:
    """Line style, ℬ and values of each stretch of a branch from one threshold to the next."""
    B = own["B"].to_numpy()
    for low, high in pairwise([B[0], *sorted(turns[(turns > B[0]) & (turns < B[-1])]), B[-1]]):
        inside = own.loc[own["B"].between(low, high, inclusive="neither"), "B"].to_numpy()
        stretch = np.array([low, *inside, high])
        # a row within tells the stability; of a stretch that no row falls into, the nearest
        witness = int(np.abs(B - (inside[len(inside) // 2] if len(inside) else low)).argmin())
        yield _style(own.iloc[witness]), stretch, _between(stretch, own, values)


def _style(row: pd.Series) -> str | tuple:
    solid, dashed, dotted = STYLES.values()
    if not row["stable_in_plane"]:
        return dotted
    return solid if row["stable_in_volume"] else dashed


def _between(B: Array | float, own: pd.DataFrame, values: Array) -> Array:
    """Values of a branch at ℬ, linear in its logarithm between two rows."""
    return np.interp(np.log(B), np.log(own["B"]), values)


def _mark(kind: str) -> dict:
    """Folds are squares, changes of stability circles."""
    return {"marker": "s" if kind == "fold" else "o", "markerfacecolor": "white", "linestyle": "none"}


def _place_legend(figure: Figure, branches: Array, marks: pd.DataFrame) -> None:
    """Branches by colour, stability by line, thresholds by marker; only what is drawn."""
    entries = [Line2D([], [], color=color, label=name) for name, color in BRANCHES.items() if name in branches]
    entries += [Line2D([], [], color=BLACK, linestyle=style, label=words) for words, style in STYLES.items()]
    kinds = {"fold" if kind == "fold" else "a rate changes sign" for kind in marks["threshold"]}
    entries += [Line2D([], [], color=BLACK, label=kind, **_mark(kind)) for kind in sorted(kinds)]
    figure.legend(handles=entries, loc="outside lower center", ncols=5)
