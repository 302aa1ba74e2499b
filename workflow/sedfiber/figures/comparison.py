"""E(t) of one trajectory against another, and its two parts."""

import numpy as np
from matplotlib.figure import Figure

from sedfiber.figures.style import BLACK, BLUE, ORANGE, PAGE_WIDTH, place_legend
from sedfiber.study.comparison import Comparison

_DECADES = 1e-8  # of the largest: what is less is not worth an axis


def draw_comparison(compared: Comparison, title: str) -> Figure:
    """One panel, logarithmic; 1e-4 of E_shape is 1 % of the length, of E_pos 1 % of the way."""
    figure = Figure(figsize=(PAGE_WIDTH, 2.8))
    axes = figure.add_subplot()
    error = compared.error
    lines = (
        (error.shape, BLUE, "$E_\\mathrm{shape}$"),
        (error.position, ORANGE, "$E_\\mathrm{pos}$"),
        (error.total, BLACK, "$E = E_\\mathrm{shape} + E_\\mathrm{pos}$"),
    )
    for values, color, label in lines:
        axes.plot(compared.t, values, color=color, label=label)
    largest = error.total.max()
    if largest > 0.0:
        axes.set_yscale("log")
        axes.set_ylim(bottom=max(_DECADES * largest, 0.5 * np.min(error.total[error.total > 0.0])))
    axes.set(xlabel="time / (a/U$_s$)", ylabel="E(t)", title=title)
    place_legend(figure, axes, columns=3)
    return figure
