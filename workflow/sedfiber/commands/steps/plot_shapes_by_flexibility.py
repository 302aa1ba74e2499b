"""``sedfiber plot_shapes_by_flexibility``: shapes along the falls from one angle, and their regimes."""

import argparse
from pathlib import Path

from sedfiber.core.csv_file import read_csv
from sedfiber.figures.drawing import add_output_arguments, write_drawing
from sedfiber.figures.falls import falls_where
from sedfiber.figures.shapes_by_flexibility import draw_shapes_by_flexibility
from sedfiber.reduced.dataset_file import read_falls
from sedfiber.study.angles import angle_index


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The data set, the table of regimes, the angle to show, the two files to write."""
    parser.add_argument("dataset", type=Path, help="Parquet file of the falls")
    parser.add_argument("regimes", type=Path, help="CSV table of their regimes (regimes.csv)")
    parser.add_argument("--angle-index", required=True, help="k of the angle to show, θ₀ = kπ/48")
    add_output_arguments(parser)


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    falls = falls_where(read_falls(args.dataset), "angle_index", angle_index(args.angle_index))
    write_drawing(args, lambda: draw_shapes_by_flexibility(falls, read_csv(args.regimes)))
