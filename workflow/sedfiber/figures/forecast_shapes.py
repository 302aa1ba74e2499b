"""Best and worst forecast shapes over the true ones, and their E(t)."""

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.ticker import LogLocator, NullLocator

from sedfiber.figures.best_and_worst import LINES, Pair, best_and_worst, read_pairs, thinned
from sedfiber.figures.falls import draw_shapes, plane_shapes, snapshots
from sedfiber.figures.style import (
    B_SYMBOL,
    BLACK,
    PAGE_WIDTH,
    SET_TITLES,
    VERMILION,
    letter_panel,
    place_legend,
    scientific,
)

SNAPSHOTS = 9
TRUE_LINE, FORECAST_LINE = 2.6, 0.9  # points: where the two agree, the true line shows on both sides
_SPACING = 1.1  # L, from one shape to the next
_WORDS = 2.8  # L, the width left of the shapes
_LEAST_ROW, _GAP = 0.55, 0.1  # L, of a row's height, and between rows
_LEAST_E = 1e-16  # smaller errors are drawn here
_SHAPES_WIDTH, _PAD = 5.2, 0.06  # inches


def draw(truth: Path, forecasts: Path, errors: pd.DataFrame, latent_dim: int) -> Figure:
    """One test set as one model forecasts it."""
    return draw_forecast_shapes(read_pairs([truth], [forecasts], errors, latent_dim))


def draw_forecast_shapes(pairs: Sequence[Pair]) -> Figure:
    """Two rows per ℬ of a test set: nine shapes of the best forecast, nine of the worst; beside them E(t)."""
    blocks = [_Block(couple) for couple in best_and_worst(pairs).values()]
    heights = [block.inches for block in blocks]
    layout = ConstrainedLayoutEngine(h_pad=0.5 * _PAD, hspace=0.0)
    figure = Figure(figsize=(PAGE_WIDTH, sum(heights) + _PAD * len(blocks) + 0.95), layout=layout)
    widths: dict[str, Any] = {"width_ratios": (_SHAPES_WIDTH, PAGE_WIDTH - _SHAPES_WIDTH)}
    panels = figure.subplots(len(blocks), 2, squeeze=False, sharex="col", height_ratios=heights, **widths)
    for block, (left, right) in zip(blocks, panels, strict=True):
        block.draw(left)
        _draw_errors(right, block)
    _share_range(panels[:, 1])
    letter_panel(panels[0, 0], "a", f"shapes, {SET_TITLES[pairs[0].truth.split]}")
    letter_panel(panels[0, 1], "b", "E(t)")
    panels[-1, 1].set_xlabel("t / T")
    _add_keys(panels[0, 0], panels[-1, 1])
    place_legend(figure, panels[0, 0], panels[-1, 1], columns=5)
    return figure


class _Row:
    """One pair: the samples shown, and the height of its row below and above the centre beads, in a."""

    def __init__(self, name: str, pair: Pair):
        self.name, self.pair = name, pair
        shapes = plane_shapes(pair.truth)
        self.samples = snapshots(pair.truth.t, shapes, SNAPSHOTS)
        shown = shapes[self.samples, :, 1]
        slack = max(0.0, 0.5 * (_LEAST_ROW * pair.truth.length - np.ptp(shown)))
        self.below, self.above = float(shown.min()) - slack, float(shown.max()) + slack


class _Block:
    """Best above worst at one ℬ: where each row's centre beads are, in a, and how much page it takes."""

    def __init__(self, couple: tuple[Pair, Pair]):
        best, worst = self.rows = [_Row(*named) for named in zip(LINES, couple, strict=True)]
        self.B, self.length = couple[0].truth.B, couple[0].truth.length
        self.places = (0.0, best.below - _GAP * self.length - worst.above)
        self.limits = (self.places[1] + worst.below, best.above)
        width = (0.5 + _WORDS + SNAPSHOTS * _SPACING) * self.length
        self.inches = _SHAPES_WIDTH / width * (self.limits[1] - self.limits[0])

    def draw(self, axes: Axes) -> None:
        """Each row's shapes from left to right, its words before them."""
        left = -(0.5 + _WORDS) * self.length
        for row, place in zip(self.rows, self.places, strict=True):
            _draw_row(axes, row, place, self.length)
            words = _words(row)
            axes.text(left, place + 0.5 * (row.below + row.above), words, fontsize=6.5, verticalalignment="center")
        axes.set(xlim=(left, (SNAPSHOTS - 0.4) * _SPACING * self.length), ylim=self.limits)
        axes.set(aspect="equal", xticks=[], yticks=[], ylabel=f"{B_SYMBOL} = {self.B:g}")
        axes.spines[:].set_visible(False)


def _draw_row(axes: Axes, row: _Row, place: float, length: float) -> None:
    """True shapes wide and black, forecast shapes thin over them."""
    offsets = [(k * _SPACING * length, place) for k in range(SNAPSHOTS)]
    for fall, color, width in ((row.pair.truth, BLACK, TRUE_LINE), (row.pair.forecast, VERMILION, FORECAST_LINE)):
        draw_shapes(axes, thinned(plane_shapes(fall)[row.samples]), offsets, [color] * SNAPSHOTS, width, clip_on=False)


def _words(row: _Row) -> str:
    truth = row.pair.truth
    return f"{row.name}: k = {truth.angle_index}, θ₀ = {truth.theta0:.2f}\nmax E = {scientific(row.pair.E_max)}"


def _draw_errors(axes: Axes, block: _Block) -> None:
    """E(t) of both, with a dot at the time of each shape after the first."""
    for row in block.rows:
        t, E = row.pair.truth.t[1:] / row.pair.truth.t[-1], np.maximum(row.pair.E, _LEAST_E)
        axes.plot(t, E, color=VERMILION, linestyle=LINES[row.name], linewidth=0.9, label=f"E(t) of the {row.name}")
        shown = row.samples[1:] - 1  # E begins at the first sample after t = 0
        axes.plot(t[shown], E[shown], "o", color=BLACK, markersize=1.8)
    axes.set(yscale="log", xlim=(0.0, 1.0))


def _share_range(panels: Iterable[Axes]) -> None:
    """One range of E for all rows, with a tick at every second decade."""
    limits = np.array([axes.get_ylim() for axes in panels])
    for axes in panels:
        axes.set(ylim=(limits.min(), limits.max()))
        axes.yaxis.set_major_locator(LogLocator(100.0, numticks=20))
        axes.yaxis.set_minor_locator(NullLocator())


def _add_keys(left: Axes, right: Axes) -> None:
    """Legend entries of the two lines of each shape and of the dots on E(t)."""
    left.plot([], [], color=BLACK, linewidth=TRUE_LINE, label="true")
    left.plot([], [], color=VERMILION, linewidth=FORECAST_LINE, label="forecast")
    right.plot([], [], "o", color=BLACK, markersize=1.8, label="times of the shapes")
