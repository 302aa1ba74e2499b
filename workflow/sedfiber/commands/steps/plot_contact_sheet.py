"""``sedfiber plot_contact_sheet``: every test trajectory, true and forecast."""

import argparse

from sedfiber.figures.best_and_worst import add_pair_arguments, write_pair_figure
from sedfiber.figures.contact_sheet import draw_contact_sheet


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """True falls and forecasts of both test sets, the two files to write."""
    add_pair_arguments(parser)


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    write_pair_figure(args, draw_contact_sheet)
