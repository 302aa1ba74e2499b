"""Reconstruction loss against latent dimension, and block diagrams of the variants that it compares."""

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure

from sedfiber.core.errors import InputError
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
from sedfiber.figures.variant_diagrams import draw_variant
from sedfiber.study.targets import RECONSTRUCTION_TARGET

DODGE = 0.06  # shift of each curve along d, so that bars of one d stand side by side
WORST = "loss_worst_sample"  # which the mean over samples hides
CHOSEN = "decoder"  # the variant whose worst sample is shown: the forecasts stand on it

# (method, variant): label, colour, marker
CURVES = {
    ("autoencoder", "none"): (f"no {B_SYMBOL}", GREEN, "^"),
    ("autoencoder", "encoder"): (f"encoder {B_SYMBOL}", ORANGE, "v"),
    ("autoencoder", "decoder"): (f"decoder {B_SYMBOL}", BLUE, "o"),
    ("autoencoder", "double"): (f"double {B_SYMBOL}", VERMILION, "s"),
    ("pod", ""): ("POD", BLACK, "x"),
}


def draw(table: pd.DataFrame) -> Figure:
    """(a) loss on sets A and B, mean over seeds with bars from the least to the greatest; (b)–(e) the variants."""
    numbers = ("latent_dim", "seed", "loss", *([WORST] if WORST in table else []))
    rows = select_columns(table, ("method", "variant", "test_set"), numbers)
    _require_known(rows)
    figure = Figure(figsize=(PAGE_WIDTH, 4.6))
    upper, lower = np.array(figure.subfigures(2, 1, height_ratios=(3.35, 1.25)))
    _draw_losses(upper, rows)
    _draw_variants(lower)
    return figure


def _draw_losses(figure: SubFigure, rows: pd.DataFrame) -> None:
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    for axes, (test_set, title) in zip(panels, SET_TITLES.items(), strict=True):
        axes.set_title(title, loc="left")
        _draw_set(axes, in_set(rows, test_set))
        axes.set(yscale="log", xlabel="latent dimension d", xticks=sorted(rows["latent_dim"].unique()))
    letter_panel(panels[0], "a", SET_TITLES["A"])
    panels[0].set_ylabel("reconstruction loss  ⟨‖X̌ − D(E(X̌))‖²⟩\n(lengths in units of L/2)")
    place_legend(figure, *panels, columns=4)


def _draw_variants(figure: SubFigure) -> None:
    variants = [(variant, *look) for (method, variant), look in CURVES.items() if method == "autoencoder"]
    for axes, letter, (variant, label, color, _) in zip(figure.subplots(1, 4), "bcde", variants, strict=True):
        letter_panel(axes, letter, label)
        draw_variant(axes, variant, color)


def _draw_set(axes: Axes, rows: pd.DataFrame) -> None:
    draw_level(axes, RECONSTRUCTION_TARGET, GREY, (0, (2, 2)), "target at d = 4, $10^{-4}$")
    for place, ((method, variant), (label, color, marker)) in enumerate(CURVES.items()):
        chosen = rows[(rows["method"] == method) & (rows["variant"] == variant)]
        if chosen.empty:
            continue
        loss = chosen.groupby("latent_dim")["loss"].agg(["mean", "min", "max"])
        spread = (loss["mean"] - loss["min"], loss["max"] - loss["mean"])
        shifted = loss.index + DODGE * (place - (len(CURVES) - 1) / 2)
        look: dict[str, Any] = {"marker": marker, "markersize": 3.8, "capsize": 2.0}
        axes.errorbar(shifted, loss["mean"], spread, color=color, label=label, **look)
        if variant == CHOSEN and WORST in chosen:
            worst = chosen.groupby("latent_dim")[WORST].max()
            axes.plot(shifted, worst, color=color, linewidth=0.9, linestyle=":", label=f"{label}, worst sample")


def _require_known(rows: pd.DataFrame) -> None:
    for pair in rows[["method", "variant"]].drop_duplicates().itertuples(index=False, name=None):
        if pair not in CURVES:
            allowed = ", ".join(" ".join(known).strip() for known in CURVES)
            raise InputError(f"input: method and variant {' '.join(pair).strip()!r} are not allowed; give {allowed}")
