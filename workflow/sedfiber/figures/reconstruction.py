"""Reconstruction loss against latent dimension: the four variants and POD, both test sets."""

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sedfiber.errors import InputError
from sedfiber.figures.style import (
    B_SYMBOL,
    BLACK,
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PAGE_WIDTH,
    SET_TITLES,
    VERMILION,
    draw_level,
    letter_panel,
    place_legend,
)
from sedfiber.figures.table_input import in_set, select_columns

BAR = 1e-4  # the loss this study asks of decoder ℬ at d = 4
DODGE = 0.06  # shift of each curve along d, so that bars of one d stand side by side

# (method, variant): label, colour, marker
CURVES = {
    ("autoencoder", "none"): (f"no {B_SYMBOL}", GREEN, "^"),
    ("autoencoder", "encoder"): (f"encoder {B_SYMBOL}", ORANGE, "v"),
    ("autoencoder", "decoder"): (f"decoder {B_SYMBOL}", BLUE, "o"),
    ("autoencoder", "double"): (f"double {B_SYMBOL}", VERMILION, "s"),
    ("pod", ""): ("POD", BLACK, "x"),
}


def draw_reconstruction(table: pd.DataFrame) -> Figure:
    """Two panels, sets A and B: mean loss over seeds, bars from the least to the greatest."""
    rows = select_columns(table, ("method", "variant", "test_set"), ("latent_dim", "seed", "loss"))
    _require_known(rows)
    figure = Figure(figsize=(PAGE_WIDTH, 3.2))
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    for axes, letter, (test_set, title) in zip(panels, "ab", SET_TITLES.items(), strict=True):
        letter_panel(axes, letter, title)
        _draw_set(axes, in_set(rows, test_set))
        axes.set(yscale="log", xlabel="latent dimension d", xticks=sorted(rows["latent_dim"].unique()))
    panels[0].set_ylabel("reconstruction loss  ⟨‖X̌ − D(E(X̌))‖²⟩\n(lengths in units of L/2)")
    place_legend(figure, *panels, columns=6)
    return figure


def _draw_set(axes: Axes, rows: pd.DataFrame) -> None:
    draw_level(axes, BAR, GREY, (0, (2, 2)), "bar at d = 4, $10^{-4}$")
    for place, ((method, variant), (label, color, marker)) in enumerate(CURVES.items()):
        chosen = rows[(rows["method"] == method) & (rows["variant"] == variant)]
        if chosen.empty:
            continue
        loss = chosen.groupby("latent_dim")["loss"].agg(["mean", "min", "max"])
        spread = (loss["mean"] - loss["min"], loss["max"] - loss["mean"])
        shifted = loss.index + DODGE * (place - (len(CURVES) - 1) / 2)
        axes.errorbar(shifted, loss["mean"], spread, color=color, marker=marker, capsize=1.5, label=label)


def _require_known(rows: pd.DataFrame) -> None:
    for pair in rows[["method", "variant"]].drop_duplicates().itertuples(index=False, name=None):
        if pair not in CURVES:
            allowed = ", ".join(" ".join(known).strip() for known in CURVES)
            raise InputError(f"input: method and variant {' '.join(pair).strip()!r} are not allowed; give {allowed}")
