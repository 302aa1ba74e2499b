"""``sedfiber plot_lags``: the lag of every forecast, and the error that it explains."""

import argparse

from sedfiber.figures.lags import draw_lags
from sedfiber.figures.table_input import add_figure_arguments, write_figure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The table, the two files to write and the model to show."""
    add_figure_arguments(parser, "lags.csv")
    parser.add_argument("--model", required=True, help="the model to show, as named in the table")


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    write_figure(args, lambda table: draw_lags(table, args.model))
