"""``sedfiber plot_data_sets``: which fall belongs to which data set."""

import argparse

from sedfiber.figures.data_sets import draw_data_sets
from sedfiber.figures.table_input import add_figure_arguments, write_figure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The table, the two files to write."""
    add_figure_arguments(parser, "trajectories.csv")


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    write_figure(args, draw_data_sets)
