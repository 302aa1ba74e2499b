"""``sedfiber plot_centre_paths``: paths of the centre bead at one elasto-gravitational number."""

import argparse
from pathlib import Path

from sedfiber.atomic_file import require_writable
from sedfiber.figures.centre_paths import draw_centre_paths
from sedfiber.figures.falls import falls_where, read_falls
from sedfiber.figures.style import save_figure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The data set, the ℬ to show, the two files to write."""
    parser.add_argument("dataset", type=Path, help="Parquet file of the falls")
    parser.add_argument("--B", type=float, required=True, help="elasto-gravitational number to show")
    parser.add_argument("--svg", type=Path, required=True, help="SVG file to write")
    parser.add_argument("--png", type=Path, required=True, help="PNG file to write")


def run(args: argparse.Namespace) -> None:
    """Draw and write both files."""
    for path in (args.svg, args.png):
        require_writable(path)
    falls = falls_where(read_falls(args.dataset), "B", args.B)
    save_figure(lambda: draw_centre_paths(falls), args.svg, args.png)
