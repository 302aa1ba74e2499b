"""One look for every figure, and how a figure becomes files.

Figures are built from ``matplotlib.figure.Figure`` without pyplot, so there is no window, no
global state and no display. The same table gives the same bytes: SVG identifiers are hashed with
a fixed salt, text is drawn as paths of the font that matplotlib ships, and neither file holds a
date or the name of a program.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure, FigureBase
from matplotlib.style import context
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullLocator

from sedfiber.core.atomic_file import replaced_when_done

COLUMN_WIDTH = 3.4  # inches; one column of a two-column page
PAGE_WIDTH = 7.0  # inches; both columns

# Okabe and Ito's colours, told apart with any kind of colour vision
BLACK = "#000000"
ORANGE = "#e69f00"
SKY = "#56b4e9"
GREEN = "#009e73"
BLUE = "#0072b2"
VERMILION = "#d55e00"
PURPLE = "#cc79a7"
GREY = "#767676"

SEQUENTIAL = ListedColormap(colormaps["viridis"](np.linspace(0.0, 0.9, 256)), "sequential")  # no pale end

B_SYMBOL = r"$\mathcal{B}$"
SET_TITLES = {"A": f"test set A: trained {B_SYMBOL}, new θ₀", "B": f"test set B: new {B_SYMBOL}, new θ₀"}

WITHOUT_DATE = {"svg": {"Date": None, "Creator": None}, "png": {"Software": None}}

RC_PARAMS = {
    "font.family": "DejaVu Sans",
    "font.size": 8.0,
    "axes.titlesize": 8.0,
    "axes.labelsize": 8.0,
    "xtick.labelsize": 7.5,
    "ytick.labelsize": 7.5,
    "legend.fontsize": 7.5,
    "legend.frameon": False,
    "mathtext.fontset": "dejavusans",
    "axes.linewidth": 0.7,
    "axes.axisbelow": True,
    "axes.grid": True,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.5,
    "lines.linewidth": 1.2,
    "lines.markersize": 4.5,
    "figure.constrained_layout.use": True,
    "figure.dpi": 200,  # text is hinted to pixels: the layout must measure it as it will be drawn
    "savefig.dpi": 200,
    "svg.fonttype": "path",
    "svg.hashsalt": "sedfiber",
}


def save_figure(draw: Callable[[], Figure], svg: Path, png: Path) -> None:
    """Draw in this style alone, whatever the user's own settings, and write both files."""
    _save(draw, {"svg": svg, "png": png})


def save_picture(draw: Callable[[], Figure], path: Path) -> None:
    """The same for one file, whose suffix says what it is: .svg or .png."""
    _save(draw, {path.suffix.removeprefix("."): path})


def _save(draw: Callable[[], Figure], files: dict[str, Path]) -> None:
    with context(["default", RC_PARAMS]):
        figure = draw()
        _fix_layout(figure)
        for kind, path in files.items():
            with replaced_when_done(path) as partial:
                figure.savefig(partial, format=kind, metadata=WITHOUT_DATE[kind])


def _fix_layout(figure: Figure) -> None:
    """Lay out once, and round: the layout's solver differs in the last bits from run to run."""
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    for axes in figure.axes:
        axes.set_position(np.round(axes.get_position(original=True).bounds, 6))


def letter_panel(axes: Axes, letter: str, title: str) -> None:
    """Title a panel as “(a) …”, flush left."""
    axes.set_title(f"({letter}) {title}", loc="left")


def draw_level(axes: Axes, value: float, color: str, dashes: tuple, label: str) -> None:
    """A dashed horizontal line: a bound or a bar."""
    axes.axhline(value, color=color, linestyle=dashes, linewidth=1.0, label=label, zorder=1.5)


def set_plain_ticks(axis: Axis) -> None:
    """Ticks of a logarithmic axis as plain numbers, such as those of ℬ: 100, 200, 500, 1000 …"""
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter(FormatStrFormatter("%g"))
    axis.set_minor_locator(NullLocator())


def place_legend(figure: FigureBase, *panels: Axes, columns: int) -> None:
    """One legend below all panels, each label once, where it can cover no data."""
    entries: dict[str, Any] = {}
    for axes in panels:
        handles, labels = axes.get_legend_handles_labels()
        entries |= dict(zip(labels, handles, strict=True))
    figure.legend(list(entries.values()), list(entries), loc="outside lower center", ncols=columns)


def scientific(value: float) -> str:
    """2.13e-4 as 2.1×10⁻⁴, in mathtext."""
    mantissa, exponent = f"{value:.1e}".split("e")
    return rf"${mantissa}\times10^{{{int(exponent)}}}$"
