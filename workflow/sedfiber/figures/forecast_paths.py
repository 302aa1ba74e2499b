"""Best and worst forecast paths of the centre bead over the true ones, and how far the two are apart."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from sedfiber.core.array_types import Array
from sedfiber.figures.best_and_worst import LINES, Pair, best_and_worst, pairs_of, read_pairs
from sedfiber.figures.falls import plane_path
from sedfiber.figures.style import (
    B_SYMBOL,
    BLACK,
    GREY,
    PAGE_WIDTH,
    SEQUENTIAL,
    SET_TITLES,
    VERMILION,
    letter_panel,
    place_legend,
    set_plain_ticks,
)
from sedfiber.figures.table_input import TEST_SETS

_INNER_GAP, _OUTER_GAP = 1.0, 1.9  # L, between the two paths of one ℬ, and between pairs
_HEADROOM = 1.6  # L, above the starts
_PATHS_WIDTH = 2.75  # inches, of one panel
_SAMPLES = 150  # of a path that are drawn
Couples = dict[float, tuple[Pair, Pair]]  # of each ℬ, best and worst
_SHARES = (1e-2, 1e-3, 1e-4)  # of the distance fallen: E_pos is the square


def draw(truth: Sequence[Path], forecasts: Sequence[Path], errors: pd.DataFrame, latent_dim: int) -> Figure:
    """Both test sets as one model forecasts them."""
    return draw_forecast_paths(read_pairs(truth, forecasts, errors, latent_dim))


def draw_forecast_paths(pairs: Sequence[Pair]) -> Figure:
    """Above: all paths of both test sets, side by side, at one scale. Below: |c − c̃| over the distance fallen."""
    chosen = [best_and_worst(pairs_of(pairs, test_set)) for test_set in TEST_SETS]
    every = [pair for couples in chosen for couple in couples.values() for pair in couple]
    norm = LogNorm(min(pair.truth.B for pair in every), max(pair.truth.B for pair in every))
    width, height = _extent(chosen)
    tall = _PATHS_WIDTH * height / width
    figure = Figure(figsize=(PAGE_WIDTH, tall + 3.4))
    panels = figure.subplots(2, 2, sharex="row", sharey="row", height_ratios=(tall, 2.0))
    for couples, letters, (test_set, title), (above, below) in zip(
        chosen, ("ac", "bd"), SET_TITLES.items(), panels.T, strict=True
    ):
        letter_panel(above, letters[0], title)
        letter_panel(below, letters[1], f"test set {test_set}: from true to forecast centre bead")
        _draw_paths(above, couples)
        _draw_distances(below, couples, norm)
    length = every[0].truth.length
    panels[0, 0].set(xlim=(-0.5 * _OUTER_GAP * length, width), ylim=(_HEADROOM * length - height, _HEADROOM * length))
    panels[0, 0].set_ylabel("y / a")
    panels[1, 0].set_ylabel("distance |c − c̃| / a")
    _add_keys(panels[0, 0])
    bar = figure.colorbar(ScalarMappable(norm, SEQUENTIAL), ax=panels[1, 1], pad=0.02, label=f"{B_SYMBOL} in (c), (d)")
    set_plain_ticks(bar.ax.yaxis)
    place_legend(figure, panels[0, 0], panels[1, 0], columns=4)
    return figure


def _extent(chosen: Sequence[Couples]) -> tuple[float, float]:
    """Width and height that hold the paths of either set, in a."""
    width = max(_places(couples)[1] for couples in chosen)
    ends = [pair.truth for couples in chosen for couple in couples.values() for pair in couple]
    return width, max(np.ptp(fall.centre[:, 1]) + (_HEADROOM + 0.8) * fall.length for fall in ends)


def _places(couples: Couples) -> tuple[list[tuple[float, float]], float]:
    """Where the least x of the best and of the worst path of each ℬ stands; where the last pair's place ends."""
    places, edge = [], 0.0
    for best, worst in couples.values():
        length = best.truth.length
        second = edge + np.ptp(best.truth.centre[:, 0]) + _INNER_GAP * length
        places.append((edge, second))
        edge = second + np.ptp(worst.truth.centre[:, 0]) + _OUTER_GAP * length
    return places, edge - 0.25 * _OUTER_GAP * length


def _draw_paths(axes: Axes, couples: Couples) -> None:
    """All start at y = 0: from left to right ℬ ascends, the best before the worst; x is offset."""
    for places, (B, couple) in zip(_places(couples)[0], couples.items(), strict=True):
        starts = [_draw_path(axes, *one) for one in zip(couple, places, LINES, strict=True)]
        axes.text(
            float(np.mean(starts)), 0.6 * couple[0].truth.length, f"{B:g}", fontsize=6.5, horizontalalignment="center"
        )
    axes.set(aspect="equal", xticks=[], xlabel=f"x, offset; above each pair its {B_SYMBOL}")


def _draw_path(axes: Axes, pair: Pair, left: float, name: str) -> float:
    """One true path and its forecast, the least x of the true one at ``left``; returns where it starts."""
    shown = _even(len(pair.truth.t))
    shift = np.array([left - pair.truth.centre[:, 0].min(), -pair.truth.centre[0, 1]])
    for fall, color, width, size in ((pair.truth, BLACK, 2.0, 6.0), (pair.forecast, VERMILION, 0.8, 3.5)):
        x, y = (plane_path(fall)[shown] + shift).T
        axes.plot(x, y, color=color, linestyle=_dashes(name, width), linewidth=width)
        axes.plot(x[0], y[0], "v", color=color, markersize=size, markeredgewidth=0.0)
        axes.plot(x[-1], y[-1], "x", color=color, markersize=size, markeredgewidth=0.4 * width + 0.4)
    return x[0]


def _dashes(name: str, width: float) -> str | tuple:
    """A line style whose dashes are of one length at every width, so that two lines coincide."""
    return "-" if name == "best" else (0, (6.0 / width, 2.5 / width))


def _draw_distances(axes: Axes, couples: Couples, norm: LogNorm) -> None:
    """|c − c̃| over the distance fallen; grey lines are equal shares of it."""
    for B, couple in couples.items():
        for line, pair in zip(LINES.values(), couple, strict=True):
            fallen, apart = _distances(pair)
            axes.plot(fallen, apart, color=SEQUENTIAL(norm(B)), linestyle=line, linewidth=0.9)
    for share in _SHARES:
        axes.axline((100.0, 100.0 * share), (200.0, 200.0 * share), color=GREY, linestyle=(0, (1, 2)), linewidth=0.8)
    axes.set(xscale="log", yscale="log", xlabel="distance fallen / a")


def _distances(pair: Pair) -> tuple[Array, Array]:
    """Distance fallen and |c − c̃|, in a, at the samples shown after t = 0."""
    shown = _even(len(pair.truth.t))[1:]
    truth, forecast = plane_path(pair.truth), plane_path(pair.forecast)
    return truth[0, 1] - truth[shown, 1], np.linalg.norm(truth[shown] - forecast[shown], axis=1)


def _even(count: int) -> Array:
    """Samples evenly in time, first and last among them."""
    return np.unique(np.linspace(0, count - 1, _SAMPLES).round().astype(int))


def _add_keys(axes: Axes) -> None:
    """Legend entries of colours, lines and signs."""
    axes.plot([], [], color=BLACK, linewidth=2.0, label="true")
    axes.plot([], [], color=VERMILION, linewidth=0.8, label="forecast")
    for name, line in LINES.items():
        axes.plot([], [], color=GREY, linestyle=line, label=name)
    axes.plot([], [], "v", color=GREY, label="start")
    axes.plot([], [], "x", color=GREY, label="end")
    axes.plot([], [], color=GREY, linestyle=(0, (1, 2)), linewidth=0.8, label="10⁻⁴, 10⁻³, 10⁻² of the distance fallen")
