"""``sedfiber plot_baselines``: worst and median error of every forecaster at each ℬ."""

import argparse

from sedfiber.figures.baselines import draw_baselines
from sedfiber.figures.table_input import add_figure_arguments, write_figure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The table, the two files to write."""
    add_figure_arguments(parser, "baselines.csv")


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    write_figure(args, draw_baselines)
