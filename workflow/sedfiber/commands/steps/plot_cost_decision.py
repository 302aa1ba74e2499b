"""``sedfiber plot_cost_decision``: error and seconds of every way to an answer, and when it pays."""

import argparse

from sedfiber.figures.cost_decision import draw_cost_decision
from sedfiber.figures.table_input import add_figure_arguments, write_figure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The table, the two files to write."""
    add_figure_arguments(parser, "cost_forecast.csv")


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    write_figure(args, draw_cost_decision)
