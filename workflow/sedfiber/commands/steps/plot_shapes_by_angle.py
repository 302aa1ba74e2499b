"""``sedfiber plot_shapes_by_angle``: shapes along the falls of one elasto-gravitational number."""

import argparse
from pathlib import Path

from sedfiber.figures.drawing import add_output_arguments, write_drawing
from sedfiber.figures.falls import falls_where
from sedfiber.figures.shapes_by_angle import draw_shapes_by_angle
from sedfiber.reduced.dataset_file import read_falls


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The data set, the ℬ to show, the two files to write."""
    parser.add_argument("dataset", type=Path, help="Parquet file of the falls")
    parser.add_argument("--B", type=float, required=True, help="elasto-gravitational number to show")
    add_output_arguments(parser)


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    write_drawing(args, lambda: draw_shapes_by_angle(falls_where(read_falls(args.dataset), "B", args.B)))
