"""``sedfiber plot_cost_models``: training time of every model against its errors."""

import argparse

from sedfiber.figures.cost_models import draw_cost_models
from sedfiber.figures.table_input import add_figure_arguments, write_figure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The table, the two files to write."""
    add_figure_arguments(parser, "cost_models.csv")


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    write_figure(args, draw_cost_models)
