"""Seconds over the number of beads: parts of a run with their power laws, simulation beside forecast."""

from collections.abc import Iterator

import pandas as pd
from matplotlib.axes import Axes

from sedfiber.figures.style import BLACK, BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION
from sedfiber.figures.table_input import select_columns

PARTS = {  # quantity: column, colour, marker
    "whole run": ("seconds_least", BLACK, "o"),
    "LU factorisation": ("lu_s", GREEN, "D"),
    "Jacobian": ("jacobian_s", BLUE, "s"),
    "right-hand side": ("rhs_s", ORANGE, "^"),
}
GROWING = ("n_beads", "tolerance", "batch", "error", "seconds_least")
ERROR = 1e-2  # of L: what the simulation beside the forecasts may be off


def draw_parts(axes: Axes, rows: pd.DataFrame, growth: pd.DataFrame) -> None:
    """Measured seconds as markers, fitted laws as lines with their exponents in the legend."""
    laws = _laws(growth)
    for quantity, (column, color, marker) in PARTS.items():
        label = quantity
        if quantity in laws.index:
            law = laws.loc[quantity]
            label = f"{quantity}: N$^{{{law['exponent']:.2f}}}$ ± {law['standard_error']:.2f}"
            ends = law[["N_from", "N_to"]].astype(float)
            axes.plot(ends, law["prefactor_s"] * ends ** law["exponent"], color=color)
        axes.plot(rows["n_beads"], rows[column], marker, color=color, label=label)


def draw_growing(axes: Axes, models: pd.DataFrame) -> None:
    """The cheapest simulation within the error, and the cheapest forecasts: alone, and many at once."""
    rows = select_columns(models, ("family", "precision"), GROWING)
    for label, look, own in _choices(rows):
        if own.empty:
            continue
        cheapest = own.loc[own.groupby("n_beads")["seconds_least"].idxmin()]
        wrong = " to ".join(dict.fromkeys(f"{e:.1g}" for e in (cheapest["error"].min(), cheapest["error"].max())))
        axes.plot(cheapest["n_beads"], cheapest["seconds_least"], **look, label=f"{label}, off by {wrong} L")


def _choices(rows: pd.DataFrame) -> Iterator[tuple[str, dict, pd.DataFrame]]:
    """Words, look and rows of each line."""
    timed = rows[rows["seconds_least"].notna()]
    simulated = timed[(timed["family"] == "simulation") & (timed["error"] <= ERROR)]
    yield "simulation", {"color": BLACK, "marker": "o"}, simulated
    forecast = timed[timed["family"] == "forecast"]
    yield "forecast alone", {"color": VERMILION, "marker": "s"}, forecast[forecast["batch"] == 1]
    together = forecast[forecast["batch"] > 1]
    for precision, color, fill in (("float64", PURPLE, PURPLE), ("float32", SKY, "white")):
        own = together[together["precision"] == precision]
        look = {"color": color, "marker": "D", "markerfacecolor": fill}
        many = f"{own['batch'].max():g}" if len(own) else ""
        yield f"{many} at once, {precision}", look, own[own["batch"] == own["batch"].max()]


def _laws(growth: pd.DataFrame) -> pd.DataFrame:
    """The power laws of RPY by quantity; few beads have none."""
    if growth.empty:
        return pd.DataFrame()
    numbers = ("exponent", "standard_error", "prefactor_s", "N_from", "N_to")
    laws = select_columns(growth, ("hydrodynamics", "quantity"), numbers)
    return laws[laws["hydrodynamics"] == "RPY"].set_index("quantity")
