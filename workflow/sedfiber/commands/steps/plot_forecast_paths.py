"""``sedfiber plot_forecast_paths``: best and worst forecast paths of the centre bead over the true ones."""

import argparse

from sedfiber.figures.best_and_worst import add_pair_arguments, write_pair_figure
from sedfiber.figures.forecast_paths import draw_forecast_paths


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """True falls and forecasts of both test sets, the two files to write."""
    add_pair_arguments(parser)


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    write_pair_figure(args, draw_forecast_paths)
