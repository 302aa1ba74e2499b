"""``sedfiber plot_hard_cases``: how far every hard case stays from its bounds."""

import argparse

from sedfiber.figures.hard_cases import draw_hard_cases
from sedfiber.figures.table_input import add_figure_arguments, write_figure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The table, the two files to write."""
    add_figure_arguments(parser, "hard_cases.csv")


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    write_figure(args, draw_hard_cases)
