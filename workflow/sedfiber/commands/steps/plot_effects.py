"""``sedfiber plot_effects``: cost and influence of every effect."""

import argparse

from sedfiber.figures.effects import draw_effects
from sedfiber.figures.table_input import add_figure_arguments, write_figure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The table, the two files to write."""
    add_figure_arguments(parser, "effects.csv")


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    write_figure(args, draw_effects)
