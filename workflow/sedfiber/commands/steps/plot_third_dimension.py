"""``sedfiber plot_third_dimension``: where the third dimension begins to matter."""

import argparse
from pathlib import Path

from sedfiber.core.csv_file import read_csv
from sedfiber.figures.table_input import add_figure_arguments, write_figure
from sedfiber.figures.third_dimension import draw_third_dimension


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The two tables, the two files to write."""
    add_figure_arguments(parser, "third_dimension.csv")
    parser.add_argument("--growth", type=Path, required=True, help="CSV table of amplitudes over time")


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    growth = read_csv(args.growth)
    write_figure(args, lambda table: draw_third_dimension(table, growth))
