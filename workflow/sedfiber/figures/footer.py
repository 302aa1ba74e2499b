"""The small print below a figure of costs: what was left out, and the machine that the times are of."""

import textwrap
from collections.abc import Sequence
from typing import Any

import pandas as pd
from matplotlib.artist import Artist
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from sedfiber.figures.style import GREY
from sedfiber.figures.table_input import select_columns

_SIZE = 6.0  # points
_LINE = 1.3 * _SIZE  # from one line to the next
_LETTER = 0.535 * _SIZE  # a letter's width, at most on average
_PAD = 4.0  # points around the strip
_POINTS = 72.0  # in an inch


def write_footer(figure: Figure, *tables: pd.DataFrame, notes: Sequence[str] = ()) -> None:
    """Notes, then machine and versions of the tables, in a strip at the bottom that the layout leaves free.

    Raises InputError when a table does not have the columns ``machine`` and ``rhs_unit_s``.
    """
    width, height = figure.get_size_inches() * _POINTS
    lines = [line for text in (*notes, *_machines(tables)) for line in textwrap.wrap(text, int(width / _LETTER))]
    figure.text(
        _PAD / width,
        _PAD / height,
        "\n".join(lines),
        color=GREY,
        fontsize=_SIZE,
        linespacing=_LINE / _SIZE,
        verticalalignment="bottom",
        gid="footer",
    )
    strip = (len(lines) * _LINE + 2.0 * _PAD) / height
    _leave_free(figure, strip)


def place_legend_above_footer(figure: Figure, handles: Sequence[Artist], columns: int) -> None:
    """One legend for all panels, between them and the footer, which has to be there already."""
    strip = _layout(figure).get()["rect"][1]
    narrow: dict[str, Any] = {"columnspacing": 1.4, "handletextpad": 0.6, "borderpad": 0.2}
    legend = figure.legend(handles=handles, loc="lower center", ncols=columns, bbox_to_anchor=(0.5, strip), **narrow)
    gap = _PAD / _POINTS / figure.get_figheight()
    top = strip + legend.get_window_extent().height / figure.bbox.height + gap
    _leave_free(figure, top)


def _leave_free(figure: Figure, strip: float) -> None:
    """Panels keep out of the lowest part of the figure, a fraction of its height."""
    _layout(figure).set(rect=(0.0, strip, 1.0, 1.0 - strip))


def _layout(figure: Figure) -> ConstrainedLayoutEngine:
    engine = figure.get_layout_engine()
    assert isinstance(engine, ConstrainedLayoutEngine)  # the style's
    return engine


def _machines(tables: Sequence[pd.DataFrame]) -> list[str]:
    """A sentence for each machine; the unit as a range where it was timed more than once."""
    parts = [select_columns(table, ("machine",), ("rhs_unit_s",)) for table in tables if len(table)]
    return [_machine(name, 1e6 * own["rhs_unit_s"]) for name, own in pd.concat(parts).groupby("machine", sort=False)]


def _machine(name: str, microseconds: pd.Series) -> str:
    ends = dict.fromkeys(f"{value:.3g}" for value in (microseconds.min(), microseconds.max()))
    return f"Times: {name}; one right-hand side (N = 31) takes {' to '.join(ends)} µs here."
