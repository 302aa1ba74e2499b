"""Cost and effect of bead number and hydrodynamics, and the bead number from which forecasts pay."""

from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sedfiber.core.validation import one_of
from sedfiber.figures.cost_growth import GROWING, draw_growing, draw_parts
from sedfiber.figures.footer import write_footer
from sedfiber.figures.style import B_SYMBOL, BLACK, BLUE, GREY, ORANGE, PAGE_WIDTH, VERMILION, letter_panel, scientific
from sedfiber.figures.table_input import select_columns

LOOKS = {  # mobility: colour, line; the first two lie on each other
    "RPY": (BLUE, "-"),
    "RPY-overlap": (ORANGE, (0, (1, 1.2))),
    "Oseen": (VERMILION, "-"),
    "none": (GREY, "-"),
}
NAMES = {"none": "none, each bead alone"}
CHANGES = {  # what changes: marker, words
    "shape": ("o", "terminal shape / L"),
    "speed": ("s", "speed, relative"),
    "settling": ("^", "settling time / (L/U$_s$), relative"),
}
_NUMBERS = (
    "B angle_index n_beads speed settling_time seconds_least rhs_s jacobian_s lu_s shape_from_finest_L shape_from_RPY_L"
)
_LEAST = 1e-8  # smaller changes are rounding


def draw(table: pd.DataFrame, growth: pd.DataFrame, models: pd.DataFrame) -> Figure:
    """(a) changes, (b) seconds of the parts, (c) of mobilities, (d) of simulation and forecast, all over N."""
    rows = select_columns(table, ("hydrodynamics", "status"), _NUMBERS.split()).sort_values("n_beads")
    for name in rows["hydrodynamics"].unique():
        one_of("hydrodynamics", name, LOOKS)
    own = rows[rows["status"] == "ok"]
    figure = Figure(figsize=(PAGE_WIDTH, 6.9))
    panels = figure.subplots(2, 2)
    titles = (
        f"change from N = {rows['n_beads'].max():g}",
        "one call, and a whole run, RPY",
        "a whole run, by mobility",
        _title(models),
    )
    for axes, letter, title in zip(panels.flat, "abcd", titles, strict=True):
        letter_panel(axes, letter, title)
        axes.set(xscale="log", yscale="log")
    _draw_changes(panels[0, 0], own)
    draw_parts(panels[0, 1], own[own["hydrodynamics"] == "RPY"], growth)
    _draw_mobilities(panels[1, 0], own)
    draw_growing(panels[1, 1], models)
    for axes, ylabel in zip(
        panels.flat, ("change, as a share", "seconds", "seconds", "seconds of a trajectory"), strict=True
    ):
        _finish(axes, ylabel)
    write_footer(figure, table, growth, models, notes=[_fall(rows), *_without(own), *_refused(rows)])
    return figure


def _title(models: pd.DataFrame) -> str:
    """Title of the last panel: the ℬ that was forecast."""
    B = select_columns(models, ("family", "precision"), ("B", *GROWING))["B"]
    return f"simulation and forecast, {B_SYMBOL} = {B.iloc[0]:.4g}"


def _fall(rows: pd.DataFrame) -> str:
    first = rows.iloc[0]
    return f"(a) to (c) are of the fall at {B_SYMBOL} = {first['B']:g} from θ₀ = {first['angle_index']:g}π/48."


def _changes(own: pd.DataFrame) -> dict[str, pd.Series]:
    """Distance of each N of one mobility from its finest."""
    finest, times = own.iloc[-1], own["settling_time"] / own["n_beads"]
    return {
        "shape": own["shape_from_finest_L"],
        "speed": (own["speed"] / finest["speed"] - 1.0).abs(),
        "settling": (times / times.iloc[-1] - 1.0).abs(),
    }


def _least(changes: dict[str, pd.Series]) -> bool:
    """Whether nothing changes but by rounding."""
    return not any((values > _LEAST).any() for values in changes.values())


def _draw_changes(axes: Axes, rows: pd.DataFrame) -> None:
    for name, own in rows.groupby("hydrodynamics", sort=False):
        color, line = LOOKS[name]
        changes = _changes(own)
        if _least(changes):
            continue
        axes.plot([], [], color=color, linestyle=line, label=name)
        for kind, values in changes.items():
            marker, _ = CHANGES[kind]
            seen = values > _LEAST
            size, fill = (5.0, color) if name == "RPY" else (2.5, "white")  # others lie on RPY
            look: dict[str, Any] = {"color": color, "linestyle": line, "markersize": size, "markerfacecolor": fill}
            axes.plot(own["n_beads"][seen], values[seen], marker, **look)

    for marker, words in CHANGES.values():
        axes.plot([], [], marker, color=BLACK, label=words)


def _draw_mobilities(axes: Axes, rows: pd.DataFrame) -> None:
    for name, own in rows.groupby("hydrodynamics", sort=False):
        color, line = LOOKS[name]
        off = scientific(own["shape_from_RPY_L"].max())
        label = name if name == "RPY" else f"{NAMES.get(name, name)}: shape up to {off} L from RPY's"
        axes.plot(own["n_beads"], own["seconds_least"], "o", color=color, linestyle=line, label=label)


def _finish(axes: Axes, ylabel: str) -> None:
    """Names of both axes; the legend below them, where it covers nothing."""
    axes.set(xlabel="beads N", ylabel=ylabel)
    axes.legend(loc="upper left", bbox_to_anchor=(-0.08, -0.2), fontsize=6.5, borderpad=0.0)
    ticks = [tick for tick in (11, 21, 31, 61, 121, 201, 301) if axes.get_xlim()[0] < tick < axes.get_xlim()[1]]
    axes.set_xticks(ticks, [str(tick) for tick in ticks])
    axes.set_xticks([], minor=True)


def _without(rows: pd.DataFrame) -> list[str]:
    """A sentence on the mobilities that (a) leaves out."""
    names = [name for name, own in rows.groupby("hydrodynamics", sort=False) if _least(_changes(own))]
    return [f"Not in (a), as nothing changes by more than {_LEAST:.0e}: {', '.join(names)}."] if names else []


def _refused(rows: pd.DataFrame) -> list[str]:
    """A sentence for each mobility that fails, with the first reason."""
    failed = rows[rows["status"] != "ok"]
    notes = []
    for name, own in failed.groupby("hydrodynamics", sort=False):
        reason = own["status"].iloc[0].removeprefix("hydrodynamics: ").split(" (")[0].split(";")[0]
        beads = ", ".join(f"{n:g}" for n in own["n_beads"])
        notes.append(f"Not shown: {name} at N = {beads} (at the first: {reason}).")
    return notes
