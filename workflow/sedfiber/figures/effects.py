"""Cost and influence of every effect on the study's scene, side by side."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sedfiber.figures.style import BLUE, GREEN, GREY, ORANGE, PAGE_WIDTH, VERMILION, letter_panel, place_legend
from sedfiber.figures.table_input import select_columns

COSTS = {
    "rhs_ratio": ("right-hand side", BLUE, "o"),
    "jacobian_ratio": ("Jacobian", ORANGE, "s"),
    "run_ratio": ("run", GREEN, "D"),
}
_LEAST = 1e-9  # of L: smaller changes are drawn here


def draw(table: pd.DataFrame) -> Figure:
    """(a) times over the study's; (b) change of the last shape; (c) change of the falling speed."""
    numbers = (*COSTS, "shape_change_L", "speed_change_percent")
    rows = select_columns(table, ("effect", "status"), numbers)[::-1].reset_index(drop=True)
    figure = Figure(figsize=(PAGE_WIDTH, 0.9 + 0.2 * len(rows)))
    panels = figure.subplots(1, 3, sharey=True)
    places = np.arange(len(rows))
    letter_panel(panels[0], "a", "time over the study's")
    for column, (label, color, marker) in COSTS.items():
        panels[0].plot(rows[column], places, color=color, marker=marker, linestyle="none", markersize=3.5, label=label)
    panels[0].set(xscale="log", xlabel="ratio", yticks=places, yticklabels=rows["effect"])
    letter_panel(panels[1], "b", "change of the last shape")
    _draw_changes(panels[1], rows["shape_change_L"], places, _LEAST, VERMILION)
    panels[1].set_xlabel("rms bead distance / L")
    letter_panel(panels[2], "c", "change of the speed")
    _draw_changes(panels[2], rows["speed_change_percent"].abs(), places, 1e-7, VERMILION)
    panels[2].set_xlabel("% (absolute)")
    for axes in panels:
        for place in np.flatnonzero(rows["status"] != "runs"):
            axes.axhspan(place - 0.5, place + 0.5, color="#eeeeee", zorder=0)
            axes.text(
                0.5,
                place,
                rows["status"][place],
                color=GREY,
                fontsize=6.5,
                transform=axes.get_yaxis_transform(),
                horizontalalignment="center",
                verticalalignment="center",
            )
        axes.set_ylim(-0.6, len(rows) - 0.4)
        axes.tick_params(axis="y", length=0)
    place_legend(figure, panels[0], columns=3)
    return figure


def _draw_changes(axes: Axes, changes: pd.Series, places: np.ndarray, least: float, color: str) -> None:
    """Bars from the least change that is drawn; none at all where nothing changes."""
    sizes = np.maximum(changes, least)
    axes.barh(places, sizes - least, left=least, height=0.55, color=color)
    axes.set(xscale="log", xlim=(least, 2.0 * max(sizes.max(), least * 10)))
