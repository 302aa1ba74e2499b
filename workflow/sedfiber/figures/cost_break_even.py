"""Preparation before the first trajectory, and the number of queries that earns it back."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from sedfiber.figures.cost_choices import FORECAST, SIMULATION, TORCH, Choices, color_of
from sedfiber.figures.style import GREY, set_plain_ticks

_ROWS = 8  # of the small table, at most
_COLUMNS = (0.0, 0.64, 1.0)  # where the first begins and the others end
_SMALL = 6.5  # points


def draw_preparation(axes: Axes, shown: Choices) -> None:
    """Seconds of data and training, a line for each way to an answer."""
    ways = shown.rows[~shown.rows["name"].str.endswith(TORCH)].drop_duplicates(["family", "name"])
    ways = ways[(ways["family"] == FORECAST) | ~ways.duplicated("family")]
    for place, row in enumerate(ways.itertuples()):
        color = color_of(shown, row.family, row.name)
        if row.preparation_seconds > 0.0:
            axes.plot(row.preparation_seconds, place, "o", color=color)
        else:
            where: dict[str, Any] = {"transform": axes.get_yaxis_transform(), "va": "center"}
            axes.text(0.03, place, "nothing", color=GREY, size=_SMALL, **where)
    names = [row.name if row.family == FORECAST else row.family for row in ways.itertuples()]
    axes.set(xscale="log", xlabel="seconds of data and training", ylim=(len(ways) - 0.5, -0.5))
    axes.margins(x=0.1)
    set_plain_ticks(axes.xaxis)
    axes.set_yticks(range(len(names)), names)
    axes.tick_params(axis="y", length=0)


def write_break_even(axes: Axes, shown: Choices) -> None:
    """A row for each way: alone, and in the largest batch; "never" where an answer takes longer than a simulation."""
    axes.set_axis_off()
    most = max(shown.batches, default=1.0)
    _write(axes, 0, ("", "alone", f"{most:g} at once" if most > 1 else ""), GREY)
    for line, row in enumerate(_ways(shown), start=1):
        own = shown.rows[(shown.rows["family"] == row.family) & (shown.rows["name"] == row.name)]
        many = _cell(own[own["batch"] == most]) if most > 1 else ""
        _write(axes, line, (row.name, _cell(own[own["batch"] == 1]), many), color_of(shown, row.family, row.simple))


def _ways(shown: Choices) -> Iterator[Any]:
    """The choices to compare with a simulation: forecasts first, then those without training."""
    rows = shown.rows[(shown.rows["family"] != SIMULATION) & shown.rows["times_faster"].notna()]
    rows = rows.assign(last=rows["family"] != FORECAST).sort_values(["last", "dimension"], kind="stable")
    return rows.drop_duplicates(["family", "name"])[:_ROWS].itertuples()


def _cell(rows: pd.DataFrame) -> str:
    """The number of queries at the more favourable precision, in words."""
    compared = rows[rows["times_faster"].notna()].sort_values("pays")
    if compared.empty:
        return "—"
    pays, faster = compared.iloc[0][["pays", "times_faster"]]
    queries = f"{float(f'{pays:.2g}'):,.0f}".replace(",", " ") if np.isfinite(pays) else "never"
    return f"{queries} ({float(f'{faster:.2g}'):g}×)"


def _write(axes: Axes, line: int, words: tuple[str, str, str], color: str) -> None:
    y = 1.0 - (line + 0.5) / (_ROWS + 1.0)
    looks: tuple[dict[str, Any], ...] = ({"color": color, "ha": "left"}, {"ha": "right"}, {"ha": "right"})
    for x, text, look in zip(_COLUMNS, words, looks, strict=True):
        axes.text(x, y, text, size=_SMALL, transform=axes.transAxes, va="center", **look)
