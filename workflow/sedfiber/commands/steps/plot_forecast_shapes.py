"""``sedfiber plot_forecast_shapes``: best and worst forecast shapes over the true ones."""

import argparse

from sedfiber.figures.best_and_worst import add_pair_arguments, pairs_of, write_pair_figure
from sedfiber.figures.forecast_shapes import draw_forecast_shapes
from sedfiber.figures.table_input import TEST_SETS


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """True falls and forecasts, which test set to show, the two files to write."""
    add_pair_arguments(parser)
    parser.add_argument("--test-set", choices=TEST_SETS, required=True, help="the test set to show")


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    write_pair_figure(args, lambda pairs: draw_forecast_shapes(pairs_of(pairs, args.test_set)))
