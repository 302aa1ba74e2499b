"""``sedfiber plot_states``: the steady states against ℬ, and where they are stable."""

import argparse
from pathlib import Path

from sedfiber.core.csv_file import read_csv
from sedfiber.figures.states import draw_states
from sedfiber.figures.table_input import add_figure_arguments, write_figure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The two tables, the two files to write."""
    add_figure_arguments(parser, "states.csv")
    parser.add_argument("--thresholds", type=Path, required=True, help="CSV table of thresholds")


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    thresholds = read_csv(args.thresholds)
    write_figure(args, lambda table: draw_states(table, thresholds))
