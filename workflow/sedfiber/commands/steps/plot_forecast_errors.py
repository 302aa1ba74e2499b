"""``sedfiber plot_forecast_errors``: one model's ensemble-mean error over time."""

import argparse

from sedfiber.figures.forecast_errors import draw_forecast_errors
from sedfiber.figures.table_input import add_figure_arguments, write_figure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The table, the two files to write and the model to show."""
    add_figure_arguments(parser, "ensemble_errors.csv")
    parser.add_argument("--model", required=True, help="the model to show, as named in the table")


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    write_figure(args, lambda table: draw_forecast_errors(table, args.model))
