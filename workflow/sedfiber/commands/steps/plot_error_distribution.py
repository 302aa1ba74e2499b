"""``sedfiber plot_error_distribution``: largest error of every test trajectory over (ℬ, θ₀)."""

import argparse

from sedfiber.figures.error_distribution import draw_error_distribution
from sedfiber.figures.table_input import add_figure_arguments, write_figure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The table, the two files to write."""
    add_figure_arguments(parser, "forecast_errors.csv")


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    write_figure(args, draw_error_distribution)
