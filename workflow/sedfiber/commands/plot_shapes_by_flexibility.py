"""``sedfiber plot_shapes_by_flexibility``: shapes along the falls from one angle, and their regimes."""

import argparse
from pathlib import Path

from sedfiber.angles import angle_index
from sedfiber.atomic_file import require_writable
from sedfiber.figures.falls import falls_where, read_falls
from sedfiber.figures.shapes_by_flexibility import draw_shapes_by_flexibility
from sedfiber.figures.style import save_figure
from sedfiber.tables import read_csv


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The data set, the table of regimes, the angle to show, the two files to write."""
    parser.add_argument("dataset", type=Path, help="Parquet file of the falls")
    parser.add_argument("regimes", type=Path, help="CSV table of their regimes (regimes.csv)")
    parser.add_argument("--angle-index", required=True, help="k of the angle to show, θ₀ = kπ/48")
    parser.add_argument("--svg", type=Path, required=True, help="SVG file to write")
    parser.add_argument("--png", type=Path, required=True, help="PNG file to write")


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    for path in (args.svg, args.png):
        require_writable(path)
    falls = falls_where(read_falls(args.dataset), "angle_index", angle_index(args.angle_index))
    table = read_csv(args.regimes)
    save_figure(lambda: draw_shapes_by_flexibility(falls, table), args.svg, args.png)
